//! What a mesh file holds beside the mesh, as the sections that a case would have for it, in SI units.

use super::{UnitsWord, value::quote};
use crate::*;
use frictionsim_physics::mesh::{
    FileConditionKind, FileContact, FileMaterial, MaterialAxes, ModelData,
};

/// A section as a mesh file gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct FileSection {
    /// The section of a case and the name in it, such as `materials` and `disc`.
    pub path: (&'static str, String),
    /// Its keys with their values, in SI units.
    pub keys: Vec<(&'static str, RawValue)>,
    /// Where the file says it.
    pub place: String,
    /// The name that the file has for it, where that is another one.
    pub name: String,
}

/// All that a file holds as sections of a case, in SI units, and what of it is not used.
pub(super) fn sections(file: &FileMesh, units: UnitsWord) -> (Vec<FileSection>, Vec<LeftOut>) {
    let (model, mut left_out) = (&file.model, file.model.left_out.clone());
    let own = model.materials.iter().map(|own| material(own, units, &mut left_out));
    let mut sections: Vec<FileSection> = own.collect();
    sections.extend(common_material(file, &sections));
    if file.dimension == 2 {
        refuse_in_plane(model, &mut left_out);
    } else {
        for tie in &model.ties {
            let keys = vec![("surface", text(&tie.surface)), ("counter", text(&tie.counter))];
            sections.push(section(("ties", &tie.name), keys, &tie.place));
        }
        for contact in &model.contacts {
            let keys = contact_keys(contact, units);
            sections.push(section(("contacts", &contact.name), keys, &contact.place));
        }
        for motion in &model.motions {
            let [from, to] = motion.axis;
            let axis = [0, 1, 2].map(|i| to[i] - from[i]);
            // 10.47197551 rad/s is 100 rpm.
            let rpm = rounded(motion.angular_velocity * 60.0 / std::f64::consts::TAU, 9);
            let mut keys = vec![
                ("axis", numbers(&axis)),
                ("center", list(from.map(|x| in_si(x, units, "m")).to_vec())),
                ("rotation_speed_rpm", RawValue::Float(rpm)),
            ];
            if motion.is_load {
                keys.push(("rotation_terms", RawValue::Boolean(true)));
                keys.push(("frame", text("turning")));
            }
            sections.push(section(("motion", &motion.region), keys, &motion.place));
        }
    }
    for condition in &model.conditions {
        let keys = match condition.kind {
            FileConditionKind::Pressure(pressure) => {
                vec![("condition", text("pressure")), ("pressure", in_si(pressure, units, "Pa"))]
            }
            FileConditionKind::Fixed(axes) => held(axes, file.dimension),
        };
        sections.push(section(("boundaries", &condition.boundary), keys, &condition.place));
    }
    (sections, left_out)
}

fn section(of: (&'static str, &str), keys: Vec<(&'static str, RawValue)>, at: &str) -> FileSection {
    let (path, place, name) = ((of.0, of.1.to_owned()), at.to_owned(), of.1.to_owned());
    FileSection { path, keys, place, name }
}

fn held(axes: [bool; 3], dimension: usize) -> Vec<(&'static str, RawValue)> {
    if axes[..dimension].iter().all(|&is_held| is_held) {
        return vec![("condition", text("clamped"))];
    }
    let letters = ["x", "y", "z"].into_iter().zip(axes);
    let letters = letters.filter(|(_, is_held)| *is_held).map(|(letter, _)| text(letter));
    vec![("condition", text("fixed")), ("directions", list(letters.collect()))]
}

fn contact_keys(contact: &FileContact, units: UnitsWord) -> Vec<(&'static str, RawValue)> {
    let mut keys = vec![("surface", text(&contact.surface)), ("counter", text(&contact.counter))];
    let numbers = [
        ("friction_coefficient", contact.friction_coefficient, ""),
        ("static_friction_ratio", contact.decay.map(|decay| decay.0), ""),
        ("decay_speed", contact.decay.map(|decay| decay.1), "m/s"),
        ("normal_stiffness", contact.normal_stiffness, "Pa/m"),
    ];
    let given =
        numbers.into_iter().filter_map(|(key, own, unit)| Some((key, in_si(own?, units, unit))));
    keys.extend(given);
    keys
}

/// What a plane body cannot take by itself: it has one contact, `[contact]`, and no ties.
fn refuse_in_plane(model: &ModelData, left_out: &mut Vec<LeftOut>) {
    let [no_tie, one_contact, one_speed] = [
        "plane bodies have no ties: let the parts share their nodes",
        "the contact of plane bodies is [contact] with counterface = \"body\"",
        "the speed of plane bodies is that of [contact]",
    ];
    let ties = model.ties.iter().map(|own| ("tie", &own.name, &own.place, no_tie));
    let contacts = model.contacts.iter();
    let contacts = contacts.map(|own| ("contact pair", &own.name, &own.place, one_contact));
    let motions = model.motions.iter().map(|own| ("motion of", &own.region, &own.place, one_speed));
    let refused = ties.chain(contacts).chain(motions).map(|(what, name, place, reason)| LeftOut {
        is_part: what == "tie",
        ..LeftOut::once(format!("{what} {name}"), place.clone(), reason)
    });
    left_out.extend(refused);
}

fn material(own: &FileMaterial, units: UnitsWord, left_out: &mut Vec<LeftOut>) -> FileSection {
    let stress = |value: f64| in_si(value, units, "Pa");
    let mut keys = Vec::new();
    match &own.elasticity {
        Some(FileElasticity::Isotropic { young_modulus, poisson_ratio }) => {
            keys.push(("young_modulus", stress(*young_modulus)));
            keys.push(("poisson_ratio", RawValue::Float(*poisson_ratio)));
        }
        Some(FileElasticity::Orthotropic { young_moduli, poisson_ratios, shear_moduli, axes }) => {
            keys.push(("young_moduli", list(young_moduli.map(stress).to_vec())));
            keys.push(("poisson_ratios", numbers(poisson_ratios)));
            keys.push(("shear_moduli", list(shear_moduli.map(stress).to_vec())));
            let axes = match axes {
                MaterialAxes::Global => text("global"),
                MaterialAxes::Vectors(both) => list(both.iter().map(|own| numbers(own)).collect()),
                MaterialAxes::Cylindrical([from, to]) => {
                    let what = format!("axis of the cylindrical orientation of {}", own.region);
                    let reason = format!(
                        "axes are about the motion's axis here, there through {from:?} and {to:?}: check it"
                    );
                    left_out.push(LeftOut::once(what, own.place.clone(), reason));
                    text("cylindrical")
                }
            };
            keys.push(("axes", axes));
        }
        None => {}
    }
    keys.extend(own.density.map(|value| ("density", in_si(value, units, "kg/m3"))));
    let plain = [
        ("mass_coefficient", own.mass_coefficient),
        ("stiffness_coefficient", own.stiffness_coefficient),
        ("loss_factor", own.loss_factor),
    ];
    let given = plain.into_iter().filter_map(|(key, value)| Some((key, RawValue::Float(value?))));
    keys.extend(given);
    FileSection { name: own.name.clone(), ..section(("materials", &own.region), keys, &own.place) }
}

/// `[material]` where the file gives every region one of its own: that of the region with most elements, which no
/// region uses. In the plane the formulation, too.
fn common_material(file: &FileMesh, own: &[FileSection]) -> Option<FileSection> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    file.elements.iter().for_each(|element| *counts.entry(&element.region).or_default() += 1);
    let of = |region: &str| own.iter().find(|section| section.path.1 == region);
    let common = ["young_modulus", "poisson_ratio", "density"];
    let is_isotropic = |own: &FileSection| common.iter().all(|key| own.get(key).is_some());
    let formulation = match (file.dimension, file.model.is_plane_strain) {
        (3, _) => Some("three-dimensional"),
        (_, Some(true)) => Some("plane-strain"),
        (_, Some(false)) => Some("plane-stress"),
        (_, None) => None,
    };
    let mut keys: Vec<(&'static str, RawValue)> = Vec::new();
    let mut place = String::new();
    let largest = counts.iter().max_by_key(|(_, count)| **count);
    if let (true, Some((region, _))) = (counts.keys().all(|region| of(region).is_some()), largest) {
        let isotropic = of(region).filter(|section| is_isotropic(section));
        let isotropic = isotropic.or_else(|| own.iter().find(|section| is_isotropic(section)))?;
        keys = isotropic.keys.iter().filter(|key| common.contains(&key.0)).cloned().collect();
        place.clone_from(&isotropic.place);
    }
    keys.extend(formulation.map(|word| ("formulation", text(word))));
    let is_useful = file.model.is_plane_strain.is_some() || !place.is_empty();
    is_useful.then(|| section(("material", ""), keys, &place))
}

impl FileSection {
    /// The value of a key.
    pub(super) fn get(&self, key: &str) -> Option<&RawValue> {
        self.keys.iter().find(|own| own.0 == key).map(|own| &own.1)
    }

    /// Its dotted name in a case.
    pub(super) fn dotted(&self) -> String {
        match self.path.0 {
            "material" => "material".to_owned(),
            group => format!("{group}.{}", self.path.1),
        }
    }

    /// Its head as TOML.
    pub fn head(&self) -> String {
        match self.path.0 {
            "material" => "[material]".to_owned(),
            group => format!("[{group}.{}]", quote(&self.path.1)),
        }
    }
}

pub(super) fn text(text: &str) -> RawValue {
    RawValue::String(text.to_owned())
}

pub(super) fn list(values: Vec<RawValue>) -> RawValue {
    let at = Location::default();
    RawValue::Array(values.into_iter().map(|value| RawItem::at(value, &at)).collect())
}

fn numbers(values: &[f64]) -> RawValue {
    list(values.iter().map(|&value| RawValue::Float(value)).collect())
}

/// A number in the SI unit of its kind, its decimal digits kept: 7.85e-9 times 10^12 is 7850.
fn in_si(value: f64, units: UnitsWord, unit: &str) -> RawValue {
    let power = units.power(unit);
    let parts = format!("{value:e}").split_once('e').and_then(|(digits, exponent)| {
        let exponent: i32 = exponent.parse().ok()?;
        format!("{digits}e{}", exponent + power).parse().ok()
    });
    RawValue::Float(parts.unwrap_or(value * 10f64.powi(power)))
}
