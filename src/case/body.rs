//! Bodies from mesh files: `mesh.file`, `[boundaries.*]`, `[materials.*]`, and where the counterface is.

use super::reader::Section;
use super::suggestion;
use crate::fem::{ElasticMaterial, MaterialField, RayleighDamping, RegionMaterial};
use crate::mesh::{
    AnnulusSpecification, BodySpecification, BoundaryCondition, Counterface,
    CounterfaceSpecification, ElasticSupport, ElementKind, GmshFile, Mesh2d,
};
use std::path::Path;
use std::sync::Arc;

/// A body that a mesh file describes.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedBody {
    /// Its mesh with boundaries and what holds them.
    pub mesh: Arc<Mesh2d>,
    /// The material of each of its regions.
    pub materials: Vec<RegionMaterial>,
}

/// What holds a boundary, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ConditionWord {
    Clamped,
    Support,
    Guide,
    Pressure,
    Free,
}

/// The shape of the counterface, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CounterfaceWord {
    Cylinder,
    Plane,
}

/// A boundary of the case with its condition.
pub(super) type NamedCondition = (String, BoundaryCondition);

/// `[boundaries.*]`, in the order given.
pub(super) fn boundaries(root: &Section<'_>) -> Vec<NamedCondition> {
    let all = root.section("boundaries", false);
    let names: Vec<&str> = all.remaining().into_iter().map(|(name, _)| name).collect();
    let named = names.into_iter().map(|name| {
        let section = all.section(name, false);
        let condition = condition(&section);
        section.close();
        (name.to_owned(), condition)
    });
    let named = named.collect();
    all.close();
    named
}

fn condition(section: &Section<'_>) -> BoundaryCondition {
    let word: ConditionWord = section.choice("condition");
    let support = ElasticSupport {
        normal_stiffness: section.number("normal_stiffness"),
        tangential_stiffness: section.number("tangential_stiffness"),
        normal_damping: section.number("normal_damping"),
        tangential_damping: section.number("tangential_damping"),
    };
    let pressure = section.optional_number("pressure");
    // A value without effect is a mistake.
    let reject = |key: &str, needs: &str| {
        section.reject(
            key,
            format!("{} has no effect here", section.name(key)),
            format!("needs condition = \"{needs}\""),
            Some(format!(
                "change the condition to \"{needs}\", or leave {key} out"
            )),
        );
    };
    if word != ConditionWord::Support {
        for key in [
            "normal_stiffness",
            "tangential_stiffness",
            "normal_damping",
            "tangential_damping",
        ] {
            if section.has(key) {
                reject(key, "support");
            }
        }
    }
    if word != ConditionWord::Pressure && section.has("pressure") {
        reject("pressure", "pressure");
    }
    match word {
        ConditionWord::Clamped => BoundaryCondition::Clamped,
        ConditionWord::Support => BoundaryCondition::Support(support),
        ConditionWord::Guide => BoundaryCondition::Guide,
        ConditionWord::Pressure => {
            BoundaryCondition::Pressure(pressure.unwrap_or_else(|| section.number("pressure")))
        }
        ConditionWord::Free => BoundaryCondition::Free,
    }
}

/// The condition of the annulus's outer edge; other names are errors.
pub(super) fn outer_edge(root: &Section<'_>, boundaries: &[NamedCondition]) -> BoundaryCondition {
    let section = root.section("boundaries", false);
    let mut outer = BoundaryCondition::Clamped;
    for (name, condition) in boundaries {
        let reject = |message: String, label: &str, help: &str| {
            section.reject(name, message, label.to_owned(), Some(help.to_owned()));
        };
        match (name.as_str(), condition) {
            ("inner", BoundaryCondition::Free) => {}
            ("inner", _) => reject(
                "boundaries.inner is the contact edge: it can have no condition of its own"
                    .to_owned(),
                "the contact is here",
                "leave the section out",
            ),
            ("outer", BoundaryCondition::Clamped) => {}
            ("outer", BoundaryCondition::Support(support))
                if support.tangential_stiffness > 0.0 =>
            {
                outer = *condition;
            }
            ("outer", _) => reject(
                "nothing holds the disc against the friction that turns it".to_owned(),
                "must hold the edge tangentially",
                "use condition = \"clamped\", or \"support\" with tangential_stiffness above 0",
            ),
            _ => reject(
                format!("the annulus has no boundary \"{name}\""),
                "it has \"inner\" and \"outer\"",
                "other boundaries come from an imported mesh (mesh.file)",
            ),
        }
    }
    outer
}

/// Where the counterface is, as `[contact]` says.
pub(super) struct ContactPlace {
    pub boundary: String,
    pub counterface: CounterfaceSpecification,
    /// Speed of a plane, m/s.
    pub plane_speed: Option<f64>,
}

/// Reads the keys of `[contact]` that only an imported body has.
pub(super) fn contact_place(section: &Section<'_>) -> ContactPlace {
    let pair = |key: &str, default: [f64; 2]| match section.numbers(key).as_deref() {
        None => default,
        Some(&[x, y]) => [x, y],
        Some(_) => {
            section.reject(
                key,
                format!("{} needs two numbers", section.name(key)),
                "must be [x, y]".to_owned(),
                None,
            );
            default
        }
    };
    let boundary = section
        .optional_text("boundary")
        .unwrap_or_else(|| "inner".to_owned());
    let (center, radius) = (pair("center", [0.0; 2]), section.optional_number("radius"));
    let direction = pair("direction", [1.0, 0.0]);
    let speed = section.optional_number("speed");
    let word: CounterfaceWord = section.choice("counterface");
    let (counterface, plane_speed) = match word {
        CounterfaceWord::Cylinder => (CounterfaceSpecification::Cylinder { center, radius }, None),
        CounterfaceWord::Plane => {
            if direction == [0.0; 2] {
                section.reject(
                    "direction",
                    "contact.direction = [0, 0] points nowhere".to_owned(),
                    "must not be zero".to_owned(),
                    None,
                );
            }
            let plane = CounterfaceSpecification::Plane { direction };
            (
                plane,
                Some(speed.unwrap_or_else(|| section.number("speed"))),
            )
        }
    };
    let is_plane = plane_speed.is_some();
    let idle: &[&str] = if is_plane {
        &["center", "radius", "rotation_speed_rpm"]
    } else {
        &["direction", "speed"]
    };
    for key in idle.iter().filter(|key| section.has(key)) {
        section.warn(
            key,
            format!(
                "{} is not used: the counterface is a {}",
                section.name(key),
                if is_plane { "plane" } else { "cylinder" }
            ),
            "no effect",
        );
    }
    ContactPlace {
        boundary,
        counterface,
        plane_speed,
    }
}

/// The annulus has one material: sections for others are errors.
pub(super) fn no_materials(root: &Section<'_>) {
    let all = root.section("materials", false);
    for (name, _) in all.remaining() {
        all.reject(
            name,
            format!("[materials.{name}] is for a physical surface of a mesh file (mesh.file)"),
            "the annulus has one material".to_owned(),
            Some("describe it in [material]".to_owned()),
        );
        let _ = all.section(name, false);
    }
    all.close();
}

/// `[materials.*]`: elasticity in place of the common one, and damping of its own.
pub(super) fn materials(
    root: &Section<'_>,
    common: &ElasticMaterial,
) -> Vec<(String, RegionMaterial)> {
    let all = root.section("materials", false);
    let names: Vec<&str> = all.remaining().into_iter().map(|(name, _)| name).collect();
    let read = names.into_iter().map(|name| {
        let section = all.section(name, false);
        let coefficients = [
            section.optional_number("mass_coefficient"),
            section.optional_number("stiffness_coefficient"),
        ];
        let elastic = ElasticMaterial {
            young_modulus: section.number("young_modulus"),
            poisson_ratio: section.number("poisson_ratio"),
            density: section.number("density"),
            formulation: common.formulation,
        };
        let damping = match coefficients {
            [None, None] => None,
            [mass, stiffness] => Some(RayleighDamping {
                mass_coefficient: mass.unwrap_or(0.0),
                stiffness_coefficient: stiffness.unwrap_or(0.0),
            }),
        };
        section.close();
        (name.to_owned(), RegionMaterial { elastic, damping })
    });
    let read = read.collect();
    all.close();
    read
}

/// Everything that makes a body of a mesh file but the file.
pub(super) struct BodyParts {
    pub scale: f64,
    pub place: ContactPlace,
    pub boundaries: Vec<NamedCondition>,
    pub materials: Vec<(String, RegionMaterial)>,
    pub common: ElasticMaterial,
}

/// Reads the mesh file that `mesh.file` names, relative to the case `case_name`. An error is a message and
/// a label.
pub(super) fn import(
    case_name: &str,
    file: &str,
    parts: &BodyParts,
) -> Result<ImportedBody, (String, String)> {
    let folder = Path::new(case_name).parent().unwrap_or(Path::new(""));
    let path = folder.join(file);
    let shown = path.display();
    let bytes = std::fs::read(&path).map_err(|error| {
        (
            format!("cannot read the mesh file {shown}: {error}"),
            "not readable".to_owned(),
        )
    })?;
    let unusable = |error: crate::mesh::MeshFileError| {
        (format!("{shown}: {error}"), "makes no body".to_owned())
    };
    let read = GmshFile::read(&bytes).map_err(unusable)?;
    let specification = BodySpecification {
        scale: parts.scale,
        contact: parts.place.boundary.clone(),
        counterface: parts.place.counterface,
        conditions: parts.boundaries.clone(),
    };
    let mesh = Mesh2d::from_gmsh(&read, &specification).map_err(unusable)?;
    for (name, _) in &parts.materials {
        if !mesh.regions.contains(name) {
            let known = mesh.regions.iter().map(String::as_str);
            let hint = suggestion::nearest(name, known)
                .map_or_else(String::new, |near| format!("; did you mean \"{near}\"?"));
            let list: Vec<String> = mesh
                .regions
                .iter()
                .map(|region| format!("\"{region}\""))
                .collect();
            return Err((
                format!(
                    "[materials.{name}]: {shown} has no physical surface \"{name}\"; it has {}{hint}",
                    list.join(", ")
                ),
                "its surfaces are others".to_owned(),
            ));
        }
    }
    let material = |region: &String| {
        let own = parts.materials.iter().find(|(name, _)| name == region);
        own.map_or(
            RegionMaterial {
                elastic: parts.common,
                damping: None,
            },
            |(_, material)| *material,
        )
    };
    Ok(ImportedBody {
        materials: mesh.regions.iter().map(material).collect(),
        mesh: Arc::new(mesh),
    })
}

impl ImportedBody {
    /// An annulus of about its size and fineness: what estimates of cost and plausibility need to know.
    pub(super) fn equivalent_annulus(&self) -> AnnulusSpecification {
        let mesh = &self.mesh;
        let (low, high) = mesh.nodes.iter().fold(
            ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]),
            |(low, high), p| {
                let pick = |f: fn(f64, f64) -> f64, a: [f64; 2]| [f(a[0], p[0]), f(a[1], p[1])];
                (pick(f64::min, low), pick(f64::max, high))
            },
        );
        let size = 0.5 * (high[0] - low[0]).max(high[1] - low[1]);
        let inner = match mesh.counterface {
            Counterface::Cylinder {
                radius,
                is_inside: true,
                ..
            } => radius.min(0.9 * size),
            _ => 0.1 * size,
        };
        let contact = mesh.contact_edge().nodes.len();
        let is_quadratic = mesh.element_kinds.iter().any(|kind| kind.is_quadratic());
        let per_contact = if is_quadratic { 2 } else { 1 };
        let around = (contact / per_contact).max(3);
        AnnulusSpecification {
            inner_radius: inner,
            outer_radius: size,
            circumferential_elements: around,
            radial_elements: mesh.element_count().div_ceil(around).max(1),
            radial_grading: 1.0,
            element: if is_quadratic {
                ElementKind::Quad8
            } else {
                ElementKind::Quad4
            },
            outer: BoundaryCondition::Clamped,
        }
    }
}

impl super::Case {
    /// Whether the body is the built-in annulus, whose symmetry the cyclic methods need.
    pub fn is_annulus(&self) -> bool {
        self.body.is_none()
    }

    /// The body's mesh.
    ///
    /// # Errors
    /// [`crate::mesh::MeshError`] of the generated annulus.
    pub fn mesh(&self) -> Result<Arc<Mesh2d>, crate::mesh::MeshError> {
        match &self.body {
            Some(body) => Ok(Arc::clone(&body.mesh)),
            None => Ok(Arc::new(
                crate::mesh::AnnulusMesh::generate(&self.annulus)?.mesh,
            )),
        }
    }

    /// The material of each region of the mesh.
    pub fn materials(&self) -> &dyn MaterialField {
        match &self.body {
            Some(body) => &body.materials,
            None => &self.material,
        }
    }
}
