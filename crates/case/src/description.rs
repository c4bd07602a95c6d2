//! The sections that describe the body of a case, of whichever kind it is.

use super::boundaries::NamedCondition;
use super::modifications::Modification;
use super::{UnitsWord, boundaries, elastic, modifications};
use super::{reader::declared, tables::TableFiles, words::FilePart};
use crate::*;

declared! {
    /// `[damping]`.
    #[derive(Copy)]
    Damping {
        include_contact: bool = flag, "Whether `beta_R` multiplies the whole tangent, contact and friction terms \
            included, or the body's stiffness alone.";
    } with {
        rayleigh: RayleighDamping, "Rayleigh's coefficients.";
    }
}

/// What describes the body of a case.
pub(super) struct Description<'a> {
    pub raw: &'a RawCase,
    pub root: &'a Section<'a>,
    pub geometry: Section<'a>,
    pub mesh: Section<'a>,
    pub tables: TableFiles<'a>,
    /// The mesh file, and the factor on its coordinates.
    pub file: Option<String>,
    pub scale: f64,
    /// The common material, whose axes are laid into the body once that is known.
    pub common: RegionMaterial,
    /// What holds its boundaries.
    pub conditions: Vec<NamedCondition>,
    /// What is added to it or taken away.
    pub modifications: Vec<Modification>,
    pub thickness: f64,
}

impl<'a> Description<'a> {
    pub fn read(root: &'a Section<'a>, raw: &'a RawCase) -> Self {
        let tables = TableFiles::of(raw);
        let mesh = root.section("mesh", true);
        // One that cannot be read is a file all the same.
        let file = mesh.optional_text("file").or_else(|| mesh.has("file").then(String::new));
        let common = material(root, &tables);
        let modifications = modifications::sections(root);
        let mut conditions = root.each("boundaries", boundaries::condition);
        let (units, scale): (UnitsWord, _) = (mesh.choice("units"), mesh.number("scale"));
        let (_, _): (Vec<FilePart>, _) = (mesh.choices("take"), mesh.texts("drop"));
        refuse_if!(mesh.has("units") && mesh.has("scale"); mesh, "scale",
            "mesh.units and mesh.scale both scale the coordinates"; "beside mesh.units";
            "leave one of them out");
        let scale = if mesh.has("units") { 10f64.powi(units.power("m")) } else { scale };
        if file.is_none() {
            refuse_each!(mesh, "units scale take drop"; key => "is for a mesh file (mesh.file)";
                "the body is generated";
                "leave it out: the lengths of a generated body are in metres");
        }
        let geometry = root.section("geometry", file.is_none());
        let thickness = geometry.number("thickness");
        let is_solid = common.elastic.formulation == PlaneFormulation::ThreeDimensional;
        if file.is_some() || !is_solid {
            boundaries::no_axial_support(root, &mut conditions, file.is_some());
        }
        if file.is_none() && !is_solid {
            // A boundary that is held along x and y is clamped.
            for (_, condition) in &mut conditions {
                if let BoundaryCondition::Fixed([true, true, _]) = condition {
                    *condition = BoundaryCondition::Clamped;
                }
            }
        }
        Self {
            raw,
            root,
            geometry,
            mesh,
            tables,
            file,
            scale,
            common,
            conditions,
            modifications,
            thickness,
        }
    }

    /// Whether the body has a thickness of its own.
    pub fn is_solid(&self) -> bool {
        self.common.elastic.formulation == PlaneFormulation::ThreeDimensional
    }

    /// Whether a boundary has a pressure of its own.
    pub fn is_pressed(&self) -> bool {
        let is_pressure = |own: &BoundaryCondition| matches!(own, BoundaryCondition::Pressure(_));
        self.conditions.iter().any(|(_, condition)| is_pressure(condition))
    }
}

/// Whether `[material]` has the constants of regions without a section of their own; a formulation alone gives them
/// none.
pub(super) fn has_common_constants(root: &Section<'_>) -> bool {
    root.section("material", false).remaining().iter().any(|(key, _)| *key != "formulation")
}

/// `[material]`. Where every region of a mesh file may have a section of its own, it can be left out: the constants are
/// then those of the first region, once it is read.
fn material(root: &Section<'_>, tables: &TableFiles<'_>) -> RegionMaterial {
    let has_regions = root.section("mesh", false).has("file")
        && !root.section("materials", false).remaining().is_empty();
    let is_needed = !has_regions || has_common_constants(root);
    let section = root.section("material", is_needed);
    let formulation = section.choice("formulation");
    let material = match is_needed {
        true => elastic::material(&section, formulation, tables),
        false => ElasticMaterial { formulation, ..ElasticMaterial::PLAIN }.into(),
    };
    section.close();
    material
}

pub(super) fn damping(section: &Section<'_>) -> Damping {
    let [mass_coefficient, stiffness_coefficient] =
        ["mass_coefficient", "stiffness_coefficient"].map(|key| section.number(key));
    Damping::declared(section, RayleighDamping { mass_coefficient, stiffness_coefficient })
}
