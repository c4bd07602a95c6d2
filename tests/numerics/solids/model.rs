//! The polycarbonate disc in three dimensions.

use crate::prelude::*;

pub type SolidModel<M = ElasticMaterial> = WaveModel<SolidSpecification, M>;

/// Its base state, with the sector that it is solved on.
pub fn base(model: &SolidModel) -> Result<(SolidSector, SolidSliding), PrestressError> {
    let sector = SolidSector::generate(&model.specification).unwrap();
    let (material, options) = (&model.material, &model.options);
    let base = SolidSliding::solve(
        &sector,
        &sector.strip.stiffness_alike(material),
        &model.contact,
        &options.contact,
        options.mass,
    )?;
    Ok((sector, base))
}

/// Whether some of its contact is pressed, and some open.
pub fn opens_in_part(base: &SolidSliding) -> bool {
    [true, false].iter().all(|own| base.sliding.is_pressed.contains(own))
}

/// A disc clamped at its bore, under a ring in the middle of its face, from which it bends away.
pub fn bending(element: ElementKind, divisions: [usize; 3]) -> SolidModel {
    let mut model = disc(element, divisions);
    let specification = &mut model.specification;
    specification.annulus.inner_radius = 0.045;
    specification.annulus.outer_radius = 0.12;
    specification.thickness = 0.008;
    specification.contact = SolidContact::Ring { inner_radius: 0.075, outer_radius: 0.11 };
    specification.conditions = [Free; 4];
    specification.conditions[0] = Clamped;
    model.contact.interference = 1e-5;
    model
}

/// Clamped outside, pressed inside by 25 um, 610 rpm, friction 0.3, without geometric stiffness.
pub fn disc(element: ElementKind, [around, radial, axial]: [usize; 3]) -> SolidModel {
    SolidModel {
        specification: SolidSpecification {
            annulus: annulus(element, around, radial),
            thickness: 0.009,
            axial_elements: axial,
            contact: SolidContact::Inner,
            conditions: [Free, Clamped, Free, Free],
            parts: Vec::new(),
        },
        material: elastic(2.5e9, 0.3805, 1228.0, ThreeDimensional),
        options: TANGENT,
        contact: contact(610.0),
    }
}

/// Its faces held along the axis.
pub fn guided(element: ElementKind, divisions: [usize; 3]) -> SolidModel {
    let mut model = disc(element, divisions);
    model.specification.conditions = [Free, Clamped, Guide, Guide];
    model
}

pub fn modes(model: &SolidModel, friction: f64, limit_hz: f64) -> Vec<ComplexMode> {
    model.modes(friction, MaxFrequency(limit_hz))
}

pub fn body<'a>(
    model: &'a SolidModel,
    (sector, mesh): (&'a SolidSector, &'a Mesh),
) -> TransientModel<'a> {
    TransientModel {
        stiffness: model.options.contact,
        ..TransientModel::new(
            SteppedBody::Revolution { sector, mesh },
            &model.material,
            model.options.damping,
            model.contact,
        )
    }
}
