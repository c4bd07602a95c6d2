//! `[boundaries.*]`: what holds each boundary.

use super::elastic::loss_factor;
use super::words::{ConditionWord, HeldAxis};
use crate::*;
use frictionsim_physics::mesh::ElasticSupport;

/// A boundary of the case with its condition.
pub(super) type NamedCondition = (String, BoundaryCondition);

/// One section.
pub(super) fn condition(section: &Section<'_>) -> BoundaryCondition {
    let word: ConditionWord = section.choice("condition");
    let support = ElasticSupport {
        normal_stiffness: section.number("normal_stiffness"),
        tangential_stiffness: section.number("tangential_stiffness"),
        axial_stiffness: section.optional_number("axial_stiffness"),
        normal_damping: section.number("normal_damping"),
        tangential_damping: section.number("tangential_damping"),
        loss_factor: loss_factor(section),
    };
    let tangents = support.tangential_stiffness + support.axial_stiffness.unwrap_or(0.0);
    let has_springs = support.normal_stiffness + tangents > 0.0;
    refuse_if!(word == ConditionWord::Support && support.loss_factor > 0.0 && !has_springs; section,
        "loss_factor" => "has no effect on a support without springs"; "nothing is lost";
        "give a stiffness, or leave loss_factor out");
    let pressure = section.optional_number("pressure");
    let axes: Vec<HeldAxis> = section.choices("directions");
    // A value without effect is a mistake.
    let springs = "normal_stiffness tangential_stiffness axial_stiffness normal_damping tangential_damping loss_factor";
    for (needed, needs, keys) in [
        (ConditionWord::Support, "support", springs),
        (ConditionWord::Fixed, "fixed", "directions"),
        (ConditionWord::Pressure, "pressure", "pressure"),
    ] {
        if word != needed {
            refuse_each!(section, keys; key => "has no effect here";
                "needs condition = \"{needs}\"";
                "change the condition to \"{needs}\", or leave {key} out");
        }
    }
    match word {
        ConditionWord::Clamped => BoundaryCondition::Clamped,
        ConditionWord::Support => BoundaryCondition::Support(support),
        ConditionWord::Guide => BoundaryCondition::Guide,
        ConditionWord::Fixed => {
            if axes.is_empty() {
                section.missing("directions");
            }
            let all = [HeldAxis::X, HeldAxis::Y, HeldAxis::Z];
            BoundaryCondition::Fixed(all.map(|axis| axes.contains(&axis)))
        }
        ConditionWord::Pressure => {
            BoundaryCondition::Pressure(pressure.unwrap_or_else(|| section.number("pressure")))
        }
        ConditionWord::Free => BoundaryCondition::Free,
    }
}

/// Support along the axis is for bodies of revolution; others have a plane, or no axis.
pub(super) fn no_axial_support(root: &Section<'_>, given: &mut [NamedCondition], is_file: bool) {
    let section = root.section("boundaries", false);
    let [body, label, help] = match is_file {
        false => ["a plane body", "the body is plane", "leave axial_stiffness out"],
        true => [
            "a body from a mesh file",
            "for generated bodies",
            "leave axial_stiffness out: tangential_stiffness acts along all tangents",
        ],
    };
    for (name, condition) in given {
        let BoundaryCondition::Support(support) = condition else { continue };
        refuse_if!(support.axial_stiffness.is_some_and(|own| own > 0.0); section, name,
            "boundaries.{name}.axial_stiffness has no effect on {body}"; "{label}"; "{help}");
        support.axial_stiffness = None;
    }
}

/// The condition of the annulus's outer edge; other names are errors.
pub(super) fn outer_edge(
    root: &Section<'_>,
    boundaries: &[NamedCondition],
    has_shaft: bool,
) -> BoundaryCondition {
    let section = root.section("boundaries", false);
    let mut outer = BoundaryCondition::Clamped;
    for (name, condition) in boundaries {
        match (name.as_str(), condition) {
            ("inner", BoundaryCondition::Free) => {}
            ("inner", _) => refuse!(section, name,
                "boundaries.inner is the contact edge: it can have no condition of its own";
                "the contact is here"; "leave the section out"),
            ("shaft", _) => refuse!(section, name,
                "boundaries.shaft is the contact edge of the shaft: it can have no condition of \
                 its own"; "the contact is here";
                "leave the section out; what holds the shaft is boundaries.bore"),
            ("bore", _) if has_shaft => {}
            ("outer", _) if condition.holds_turning() => outer = *condition,
            ("outer", _) => refuse!(section, name,
                "nothing holds the disc against the friction that turns it";
                "must hold the edge tangentially";
                "use condition = \"clamped\", or \"support\" with tangential_stiffness above 0"),
            _ => refuse!(section, name, "the annulus has no boundary \"{name}\"";
                "it has \"inner\" and \"outer\", and \"bore\" with geometry.shaft_inner_radius";
                "other boundaries come from an imported mesh (mesh.file)"),
        }
    }
    outer
}
