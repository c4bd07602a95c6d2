//! `[modifications.*]`: what is added to a body, or taken away from it.

use super::reader::NodePlace;
use crate::*;

/// Keys that need a node, and keys that need elements.
const AT_NODES: [&str; 4] = ["mass", "stiffness", "damping", "direction"];
const IN_ELEMENTS: [&str; 3] = ["remove", "mass_coefficient", "stiffness_coefficient"];
/// Keys that change a body: at a node, in elements, or as a whole.
const EFFECTS: [&str; 7] = [
    "mass",
    "stiffness",
    "damping",
    "remove",
    "mass_coefficient",
    "stiffness_coefficient",
    "offset",
];

/// One modification as the case gives it.
#[derive(Clone, Debug)]
pub(super) struct Modification {
    /// Its name in the case.
    pub name: String,
    pub at: Option<(NodePlace, Location)>,
    pub mass: f64,
    pub stiffness: f64,
    pub damping: f64,
    pub direction: Option<[f64; 3]>,
    /// Centre and radius of the elements that it is about.
    pub within: Option<([f64; 3], f64)>,
    pub is_removed: bool,
    /// Damping of those elements beside that of their material: `alpha`, `beta`.
    pub coefficients: [f64; 2],
    /// Way of the contact curve.
    pub offset: Option<[f64; 2]>,
}

/// What of a modification does not fit the body: its key, and why.
pub(super) type Misfit = (String, String);

/// Reads every section.
pub(super) fn sections(root: &Section<'_>) -> Vec<Modification> {
    let read = root.each("modifications", modification);
    read.into_iter().map(|(name, own)| Modification { name, ..own }).collect()
}

/// One section, without its name.
fn modification(section: &Section<'_>) -> Modification {
    let list = |key: &str, counts: &[usize]| -> Option<[f64; 3]> {
        let numbers = section.numbers(key)?;
        if counts.contains(&numbers.len()) {
            let part = |k: usize| numbers.get(k).copied().unwrap_or(0.0);
            return Some([0, 1, 2].map(part));
        }
        refuse!(section, key => "has {} numbers", numbers.len();
            "must be [x, y], or [x, y, z] on solid bodies");
        None
    };
    let (center, direction) = (list("center", &[2, 3]), list("direction", &[2, 3]));
    let offset = list("offset", &[2]);
    let radius = section.optional_number("radius");
    let own = Modification {
        name: String::new(),
        at: section.node("at"),
        mass: section.number("mass"),
        stiffness: section.number("stiffness"),
        damping: section.number("damping"),
        direction,
        within: center.zip(radius),
        is_removed: section.flag("remove"),
        coefficients: [section.number("mass_coefficient"), section.number("stiffness_coefficient")],
        offset: offset.map(|[x, y, _]| [x, y]),
    };
    check(section, &own);
    own
}

/// Refuses keys without effect, and a section without any.
fn check(section: &Section<'_>, own: &Modification) {
    let needs = |keys: &[&str], needed: &str, help: &str| {
        for key in keys.iter().filter(|key| section.has(key)) {
            refuse!(section, key => "needs {needed}"; "has no effect by itself"; "{help}");
        }
    };
    let places =
        "give the node: at = 17, at = { x = .., y = .. } or { radius = .., angle_deg = .. }";
    let circles = "give center = [x, y] and radius, m: elements whose middle lies within it";
    if !section.has("at") {
        needs(&AT_NODES, "`at`", places);
    }
    if !(section.has("center") && section.has("radius")) {
        needs(&IN_ELEMENTS, "`center` and `radius`", circles);
        needs(&["center", "radius"], "the other of the two", circles);
    }
    let has_any = |keys: &[&str]| keys.iter().any(|key| section.has(key));
    let acts = has_any(&EFFECTS);
    if acts && section.has("at") {
        if !has_any(&EFFECTS[..3]) {
            needs(&["at"], "`mass`, `stiffness` or `damping`", "give one of them, or leave it out");
        }
        if !has_any(&EFFECTS[1..3]) {
            needs(&["direction"], "`stiffness` or `damping`", "a mass acts in every direction");
        }
    }
    if acts && !has_any(&IN_ELEMENTS) {
        let help = "give remove or a damping coefficient, or leave it out";
        needs(&["center", "radius"], "a change of elements", help);
    }
    refuse_if!(own.direction.is_some_and(|d| d.iter().all(|x| *x == 0.0)); section, "direction" =>
        "= 0 points nowhere"; "has no effect by itself";
        "give a vector, or leave it out: every direction");
    refuse_if!(!acts; section, "at", "{} changes nothing", section.name("").trim_end_matches('.');
        "has no effect by itself";
        "give mass, stiffness, damping, remove, a damping coefficient or offset");
}

/// The mesh file with what the modifications take away and move, and how far they move the counterface, m.
pub(super) fn reshaped(
    file: Arc<FileMesh>,
    scale: f64,
    contact: &str,
    modifications: &[Modification],
) -> Result<(Arc<FileMesh>, [f64; 2]), Misfit> {
    let (mut file, mut way) = (file, [0.0; 2]);
    for own in modifications {
        if let Some([x, y]) = own.offset {
            let key = format!("modifications.{}.offset", own.name);
            let moved = file.with_curve_moved(contact, [x / scale, y / scale]);
            let moved = moved.filter(|_| file.dimension == 2).ok_or_else(|| {
                let why = "it moves the contact curve of a plane body against its other curves, and there are none";
                (key, why.to_owned())
            })?;
            file = Arc::new(moved);
            way = [way[0] + x, way[1] + y];
        }
    }
    for own in modifications.iter().filter(|own| own.is_removed) {
        let Some((center, radius)) = own.within else { continue };
        let near = |middle: [f64; 3]| {
            let away = Vector3::from(middle.map(|x| scale * x)) - Vector3::from(center);
            away.norm() <= radius
        };
        let less = file.without(|element| near(file.element_middle(element)));
        let key = format!("modifications.{}.remove", own.name);
        if less.elements.len() == file.elements.len() {
            return Err((key, "no element has its middle within that radius".to_owned()));
        }
        if less.elements.is_empty() {
            return Err((key, "it takes the whole body away".to_owned()));
        }
        file = Arc::new(less);
    }
    Ok((file, way))
}
