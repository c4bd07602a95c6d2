//! Derivatives as fields over the mesh, and the mass of a modification.

use super::base::target_modes;
use super::fields::Derivatives;
use super::trial::{Search, Target, Trial};
use frictionsim_case::ModificationKind;
use frictionsim_physics::fem::element::ElementGeometry;
use frictionsim_results::improve::{TargetFields, TargetMode};
use nalgebra::{Matrix3, SymmetricEigen};

/// Mass of an element and its area or volume.
fn element_size(search: &Search<'_>, element: usize) -> [f64; 2] {
    let (base, mesh) = (search.base, &search.base.mesh);
    let material = base.case.materials().of(mesh.region(element));
    let mass: f64 = ElementGeometry::new(mesh, element).lumped_mass(material).iter().sum();
    [mass, mass / material.density]
}

/// Mass that a modification adds, kg.
pub(super) fn added_mass(search: &Search<'_>, trial: &Trial) -> f64 {
    match (&trial.target, trial.kind) {
        (_, ModificationKind::Mass) => search.sizes.mass_kg,
        (Target::Patch(_, elements), ModificationKind::Removal) => {
            let masses = elements.iter().map(|&e| element_size(search, e as usize)[0]);
            -search.base.case.depth() * masses.sum::<f64>()
        }
        _ => 0.0,
    }
}

/// The derivatives of all targets, for each unit of mass, stiffness and damping of the whole thickness.
pub(super) fn fields(search: &Search<'_>) -> Vec<TargetFields> {
    let modes = target_modes(search.base);
    let sizes = (0..search.base.mesh.element_count()).map(|e| element_size(search, e)[1]);
    let sizes: Vec<f64> = sizes.collect();
    let of = |(own, mode): (&Derivatives, TargetMode)| {
        let alpha = search.base.options.damping.mass_coefficient;
        let extent = search.base.case.depth();
        let nodes = || 0..own.nodes.len();
        let least = |form: Matrix3<f64>| match search.base.mesh.dimension {
            2 => {
                let plane = form.fixed_view::<2, 2>(0, 0).into_owned();
                SymmetricEigen::new(plane).eigenvalues.min() / extent
            }
            _ => SymmetricEigen::new(form).eigenvalues.min(),
        };
        TargetFields {
            mode,
            mass: nodes().map(|n| own.by_mass(n, alpha).re / extent).collect(),
            spring: nodes().map(|n| least(own.by_spring(n))).collect(),
            dashpot: nodes().map(|n| least(own.by_dashpot(n))).collect(),
            removal: own.removal.iter().zip(&sizes).map(|(d, v)| d.re / v).collect(),
            damping: own.damping.iter().zip(&sizes).map(|(d, v)| d.re / v).collect(),
        }
    };
    search.derivatives.iter().zip(modes).map(of).collect()
}
