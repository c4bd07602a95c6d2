//! The case to start from that a mesh file suggests: everything that it holds, as sections with their places in the
//! file.

use super::file_sections::{sections, text};
use super::{FileSection, UnitsWord, inclusion, taken::drop_key, value::quote};
use crate::*;
use frictionsim_physics::mesh::{FileElement, SurfaceFace};

/// Densities below this are tonnes for each cubic millimetre: the lightest solid has 1 kg/m3, the heaviest 3e-8 t/mm3.
const TONNES: f64 = 1e-6;
/// Moduli above this are in pascals: diamond has 1.2e6 MPa, soft rubber 1e6 Pa is rarely the stiffest material of a
/// file.
const STIFFEST_MPA: f64 = 2e6;
/// Extent from which on a file without materials is in millimetres.
const MILLIMETRES: f64 = 10.0;
/// Modes that the case asks for.
const MODES: usize = 20;
/// What is written where the file does not say.
const FRICTION: f64 = 0.3;
const SPEED_RPM: f64 = 60.0;
const STEEL: &str = "young_modulus = 2.1e11\npoisson_ratio = 0.3\ndensity = 7850.0\n";

/// The text of a case for the mesh file at `path`, which the case, lying beside it, calls `shown`.
///
/// # Errors
/// What is wrong with the file, with its line.
pub fn case_from(path: &Path, shown: &str) -> Result<String, String> {
    let bytes = inclusion::mesh_file(path)?;
    let file = FileMesh::read_as(&path.to_string_lossy(), &bytes);
    let file = file.map_err(|error| format!("{}: {error}", path.display()))?;
    let (units, reason) = units_of(&file);
    let (sections, left_out) = sections(&file, units);
    let mut out = String::new();
    let title = file.model.title.clone().filter(|title| !title.is_empty());
    let title = title.unwrap_or_else(|| format!("Bodies of {shown}"));
    let title = RawValue::String(title.chars().filter(|c| !c.is_control()).take(80).collect());
    let _ = write!(
        out,
        "# Made from {shown} by `frictionsim init --from`. Values are in SI units; what stands \
        here wins over the file.\n\
         title = {title}\n\n[mesh]\nfile = {}\nunits = \"{}\"    # of the file: {reason}\n",
        text(shown),
        units.word()
    );
    let lost: Vec<LeftOut> = left_out.iter().filter(|own| own.is_part).cloned().collect();
    if !lost.is_empty() {
        let _ = writeln!(
            out,
            "# CHOOSE: the file holds, loads or joins parts by what is not understood (below). \
            Without it the answer is that of\n\
             # another structure: say it in this case in other words, or leave it out:\n# {}",
            drop_key(&lost)
        );
    }
    missing_materials(&file, &sections, &mut out);
    for section in sections.iter().filter(|section| section.path.0 != "material") {
        write_section(section, shown, &mut out);
    }
    proposed_motion(&file, units, &sections, &mut out);
    if file.dimension == 2 {
        out.push_str(&plane_contact(&file));
    }
    analysis(&file, &mut out);
    for line in &left_out {
        let _ = writeln!(out, "# Not used: {line}");
    }
    Ok(out)
}

/// The units that the file seems to be in, and why.
fn units_of(file: &FileMesh) -> (UnitsWord, String) {
    let judged = |is_mm, by: String| {
        let units = if is_mm { UnitsWord::MmTS } else { UnitsWord::MKgS };
        (units, format!("judged by the {by}; check it"))
    };
    let densities = file.model.materials.iter().filter_map(|material| material.density);
    let lightest = densities.fold(f64::INFINITY, f64::min);
    if lightest.is_finite() {
        return judged(lightest < TONNES, format!("density {lightest:e} of a material"));
    }
    let moduli =
        file.model.materials.iter().filter_map(|material| match material.elasticity.as_ref()? {
            FileElasticity::Isotropic { young_modulus, .. } => Some(*young_modulus),
            FileElasticity::Orthotropic { young_moduli, .. } => {
                Some(young_moduli.iter().copied().fold(0.0, f64::max))
            }
        });
    let stiffest = moduli.fold(0.0, f64::max);
    if stiffest > 0.0 {
        return judged(stiffest <= STIFFEST_MPA, format!("modulus {stiffest:e} of a material"));
    }
    let extent = (0..3).map(|axis| {
        let own = || file.points.iter().map(|point| point[axis]);
        own().fold(f64::NEG_INFINITY, f64::max) - own().fold(f64::INFINITY, f64::min)
    });
    let extent = extent.fold(0.0, f64::max);
    judged(extent > MILLIMETRES, format!("extent {extent:.4}"))
}

/// `[material]` of steel where some region has none in the file.
fn missing_materials(file: &FileMesh, sections: &[FileSection], out: &mut String) {
    let own = sections.iter().filter(|section| section.path.0 == "materials");
    let own: BTreeSet<&str> = own.map(|section| &*section.path.1).collect();
    let regions: BTreeSet<&str> = file.elements.iter().map(|element| &*element.region).collect();
    let bare: Vec<&str> = regions.difference(&own).copied().collect();
    if !bare.is_empty() {
        let _ = write!(
            out,
            "\n[material]    # CHOOSE: the file gives no material to {}; this is steel\n{STEEL}",
            bare.join(", ")
        );
    }
}

fn write_section(section: &FileSection, shown: &str, out: &mut String) {
    let _ = write!(out, "\n{}    # {shown}, {}", section.head(), section.place);
    if section.name != section.path.1 {
        let _ = write!(out, ": {}", section.name);
    }
    out.push('\n');
    for (key, value) in &section.keys {
        let unit = match *key {
            "young_modulus" | "young_moduli" | "shear_moduli" | "pressure" => "    # Pa",
            "density" => "    # kg/m3",
            "normal_stiffness" => "    # Pa/m",
            "center" => "    # m",
            _ => "",
        };
        let _ = match value {
            // Moduli are read by their powers of ten.
            RawValue::Float(x) if x.abs() >= 1e6 => writeln!(out, "{key} = {x:e}{unit}"),
            _ => writeln!(out, "{key} = {value}{unit}"),
        };
    }
    let lacks = |key: &str| section.get(key).is_none();
    if section.path.0 == "contacts" && lacks("friction_coefficient") {
        let _ = writeln!(out, "friction_coefficient = {FRICTION}    # CHOOSE: the file gives none");
    }
    if section.path.0 == "materials" && lacks("density") {
        out.push_str("density = 7850.0    # CHOOSE: the file gives none\n");
    }
}

/// A motion of the counter surface's region where the file has contacts and none turns: about the mean normal of that
/// surface.
fn proposed_motion(file: &FileMesh, units: UnitsWord, sections: &[FileSection], out: &mut String) {
    let has = |group: &str| sections.iter().any(|section| section.path.0 == group);
    let Some(contact) = file.model.contacts.first() else { return };
    let faces = file.surfaces.get(&contact.counter);
    let (true, false, Some(faces)) = (has("contacts"), has("motion"), faces) else { return };
    let Some((_, corners)) = faces.first() else { return };
    let has_all = |own: &&FileElement| corners.iter().all(|node| own.nodes.contains(node));
    let Some(region) = file.elements.iter().find(has_all).map(|own| &own.region) else { return };
    let normal = faces.iter().map(|face| area_of(file, face)).sum::<Vector3<f64>>();
    let axis = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
    // Round-off is no part of a proposal.
    let rounded = |vector: Vector3<f64>| {
        let [x, y, z] = [0, 1, 2].map(|i| (1e6 * vector[i]).round() / 1e6 + 0.0);
        format!("[{x}, {y}, {z}]")
    };
    let own = file.elements.iter().filter(|element| element.region == *region);
    let nodes: BTreeSet<u32> = own.flat_map(|element| element.nodes.iter().copied()).collect();
    let sum: Vector3<f64> =
        nodes.iter().map(|&node| Vector3::from(file.points[node as usize])).sum();
    let center = sum / nodes.len() as f64 * 10f64.powi(units.power("m"));
    let _ = write!(
        out,
        "\n[motion.{}]    # CHOOSE: the file has none; about the mean normal of {}, through the \
        mean of the region's nodes\n\
         axis = {}\ncenter = {}    # m\nrotation_speed_rpm = {SPEED_RPM:?}\n",
        quote(region),
        contact.counter,
        rounded(axis),
        rounded(center),
    );
}

fn area_of(file: &FileMesh, (kind, nodes): &SurfaceFace) -> Vector3<f64> {
    let points: Vec<[f64; 3]> = nodes.iter().map(|&node| file.points[node as usize]).collect();
    kind.quadrature().into_iter().map(|point| Vector3::from(kind.at(&points, point).area)).sum()
}

/// `[contact]` of a plane body, which has one.
fn plane_contact(file: &FileMesh) -> String {
    let names: Vec<&str> = file.curves.keys().map(String::as_str).collect();
    match file.model.contacts.first() {
        Some(contact) => format!(
            "\n[contact]\nboundary = {}\ncounterface = \"body\"\ncounter_boundary = {}\nfriction_coefficient = {}\n\
             interference = 1e-6    # CHOOSE\nspeed = 1.0    # CHOOSE: m/s along a straight \
             contact, or rotation_speed_rpm\n",
            text(&contact.surface),
            text(&contact.counter),
            contact.friction_coefficient.unwrap_or(FRICTION)
        ),
        None => format!(
            "\n[contact]    # CHOOSE: the curve that touches, of {}, and what it slides \
            on\nboundary = {}\ncounterface = \"plane\"\n\
             friction_coefficient = {FRICTION}\ninterference = 1e-6\nspeed = 1.0\n",
            names.join(", "),
            text(names.first().copied().unwrap_or_default())
        ),
    }
}

fn analysis(file: &FileMesh, out: &mut String) {
    let is_sliding = !file.model.contacts.is_empty() || file.dimension == 2;
    if is_sliding {
        let _ = write!(
            out,
            "\n[cea]\nmodes = {MODES}\nfriction_coefficients = {{ from = 0.0, to = 0.6, count = 7 }}\n"
        );
    }
    if file.dimension == 3 && file.model.contacts.is_empty() {
        let surfaces: Vec<&str> = file.surfaces.keys().map(String::as_str).collect();
        let _ = write!(
            out,
            "\n# A contact: the file names none. Its surfaces are {}.\n# [contacts.NAME]\n# \
            surface = \"...\"    # the finer, softer one\n\
             # counter = \"...\"\n# friction_coefficient = {FRICTION}\n# [motion.REGION]\n# axis = [0.0, 0.0, 1.0]\n\
             # rotation_speed_rpm = {SPEED_RPM:?}\n",
            surfaces.join(", ")
        );
    }
    out.push('\n');
}
