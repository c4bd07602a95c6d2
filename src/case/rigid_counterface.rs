//! The rigid counterface of solid bodies: of `[contact]`, and of a `[contacts.NAME]` without `counter`.

use super::interference::interference;
use super::reader::Section;
use super::words::CounterfaceWord;
use super::{caution, refuse};
use crate::contact::{RigidCounterface, RigidMotion, RigidShape};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Reads `counterface` with its place, motion and interference.
pub(super) fn rigid_counterface(section: &Section<'_>) -> RigidCounterface {
    let word: CounterfaceWord = section.choice("counterface");
    let radius = section.optional_number("radius");
    let shape = match word {
        CounterfaceWord::Plane => RigidShape::Plane,
        CounterfaceWord::Cylinder => RigidShape::Cylinder(radius),
        CounterfaceWord::Sphere => RigidShape::Sphere(radius),
        CounterfaceWord::Body => {
            refuse!(section, "counterface" => "= \"body\" is for two plane bodies";
                "the mesh is of solid elements";
                "name the surfaces that slide on each other under [contacts.NAME], as `surface` \
                 and `counter`");
            RigidShape::Plane
        }
    };
    if shape == RigidShape::Plane && radius.is_some() {
        caution!(section, "radius" => "is not used: the counterface is a plane"; "no effect");
    }
    RigidCounterface {
        shape,
        center: section.vector("center"),
        axis: unit(section, "axis"),
        motion: motion(section),
        interference: interference(section),
    }
}

/// Along a straight line where `speed` or `direction` is given, else about the axis.
fn motion(section: &Section<'_>) -> RigidMotion {
    let speed = section.optional_number("speed");
    if speed.is_none() && !section.has("direction") {
        return RigidMotion::Turning(section.number("rotation_speed_rpm") * TAU / 60.0);
    }
    for key in section.refused("rotation_speed_rpm") {
        refuse!(section, key,
            "the counterface turns about its axis or slides along a straight line, not both";
            "beside `speed` or `direction`";
            "leave rotation_speed_rpm out, or `speed` and `direction`");
    }
    let speed = speed.unwrap_or_else(|| section.number("speed"));
    if !section.has("direction") {
        section.no_vector::<3>("direction", "is missing beside `speed`");
    }
    RigidMotion::Sliding(unit(section, "direction").map(|x| x * speed))
}

/// The vector of length one along that of a key.
pub(super) fn unit(section: &Section<'_>, key: &str) -> [f64; 3] {
    let direction = Vector3::from(section.vector(key));
    if direction.norm() == 0.0 {
        refuse!(section, key => "= [0, 0, 0] points nowhere"; "must not be zero");
        return [0.0, 0.0, 1.0];
    }
    direction.normalize().into()
}
