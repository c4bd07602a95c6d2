//! What a file of a finite-element program holds beside its mesh: materials, ties, contacts, conditions; and what of it was
//! left out.
//!
//! Values are in the units of the file, whatever those are.

use crate::prelude::*;
/// Everything beside the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModelData {
    /// Title of the file.
    pub title: Option<String>,
    /// Materials of regions, at most one each.
    pub materials: Vec<FileMaterial>,
    /// Surfaces that are glued.
    pub ties: Vec<FileTie>,
    /// Surfaces that slide on each other.
    pub contacts: Vec<FileContact>,
    /// What holds and loads boundaries.
    pub conditions: Vec<FileCondition>,
    /// Regions that turn.
    pub motions: Vec<FileMotion>,
    /// How a plane body extends across its plane: `Some(true)` in plane strain, `Some(false)` in plane stress.
    pub is_plane_strain: Option<bool>,
    /// What is not used, and why.
    pub left_out: Vec<LeftOut>,
    /// Where each keyword with its reason stands in that list.
    listed: BTreeMap<(String, String), usize>,
    /// What a user should know of how the file was read.
    pub remarks: Vec<String>,
}

/// The material of a region.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileMaterial {
    /// The region.
    pub region: String,
    /// Name of the material in the file.
    pub name: String,
    /// Its elasticity, where the file gives it.
    pub elasticity: Option<FileElasticity>,
    /// Mass by volume.
    pub density: Option<f64>,
    /// Rayleigh's alpha, 1/s.
    pub mass_coefficient: Option<f64>,
    /// Rayleigh's beta, s.
    pub stiffness_coefficient: Option<f64>,
    /// Structural damping eta.
    pub loss_factor: Option<f64>,
    /// Where the file defines it.
    pub place: String,
}

/// Elastic constants of a material.
#[derive(Clone, Debug, PartialEq)]
pub enum FileElasticity {
    /// The same in every direction.
    Isotropic {
        /// Young's modulus.
        young_modulus: f64,
        /// Poisson's ratio.
        poisson_ratio: f64,
    },
    /// Engineering constants along three axes.
    Orthotropic {
        /// `E_1, E_2, E_3`.
        young_moduli: [f64; 3],
        /// `nu_12, nu_13, nu_23`.
        poisson_ratios: [f64; 3],
        /// `G_12, G_13, G_23`.
        shear_moduli: [f64; 3],
        /// Their directions.
        axes: MaterialAxes,
    },
}

impl FileElasticity {
    /// Engineering constants of the stiffness over the normal strains; `None` of a singular one.
    pub(super) fn of_stiffness(
        normal: Matrix3<f64>,
        shear_moduli: [f64; 3],
        axes: MaterialAxes,
    ) -> Option<Self> {
        let compliance = normal.try_inverse()?;
        let young_moduli = [0, 1, 2].map(|i| 1.0 / compliance[(i, i)]);
        let ratio = |(i, j)| -compliance[(j, i)] * young_moduli[i];
        let poisson_ratios = [(0, 1), (0, 2), (1, 2)].map(ratio);
        Some(Self::Orthotropic { young_moduli, poisson_ratios, shear_moduli, axes })
    }
}

/// Directions of the axes of an orthotropic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MaterialAxes {
    /// Those of the coordinates.
    Global,
    /// Axis 1, and a vector in the plane of the axes 1 and 2.
    Vectors([[f64; 3]; 2]),
    /// Radial, circumferential and axial about the line through two points.
    Cylindrical([[f64; 3]; 2]),
}

/// Two surfaces that are glued.
#[derive(Clone, Debug, PartialEq)]
pub struct FileTie {
    /// Its name.
    pub name: String,
    /// The surface that follows.
    pub surface: String,
    /// The surface that it follows.
    pub counter: String,
    /// Where the file says so.
    pub place: String,
}

/// Two surfaces that slide on each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileContact {
    /// Its name.
    pub name: String,
    /// The finer, softer surface.
    pub surface: String,
    /// The other one.
    pub counter: String,
    /// Kinetic friction coefficient, where the file gives one.
    pub friction_coefficient: Option<f64>,
    /// Static over kinetic friction, and the slip speed over which it falls.
    pub decay: Option<(f64, f64)>,
    /// Pressure by overclosure.
    pub normal_stiffness: Option<f64>,
    /// Where the file says so.
    pub place: String,
}

/// What a boundary bears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FileConditionKind {
    /// No motion along some of the axes.
    Fixed([bool; 3]),
    /// A pressure that pushes onto the body.
    Pressure(f64),
}

/// A boundary and what it bears.
#[derive(Clone, Debug, PartialEq)]
pub struct FileCondition {
    /// The boundary.
    pub boundary: String,
    /// What it bears.
    pub kind: FileConditionKind,
    /// Where the file says so.
    pub place: String,
}

/// A region that turns.
#[derive(Clone, Debug, PartialEq)]
pub struct FileMotion {
    /// The region.
    pub region: String,
    /// Two points of its axis.
    pub axis: [[f64; 3]; 2],
    /// Speed about the axis, rad/s.
    pub angular_velocity: f64,
    /// Whether it stands for a load that turns with the region: the inertia of its rotation, in its own frame.
    pub is_load: bool,
    /// Where the file says so.
    pub place: String,
}

/// Lines of a file that are not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Keyword or card.
    pub keyword: String,
    /// Where it stands first.
    pub place: String,
    /// How often.
    pub count: usize,
    /// Why it is not used; empty where it is simply not known here.
    pub reason: String,
    /// Whether it would hold, load or join parts: without it the answer is that of another structure.
    pub is_part: bool,
}

/// Characters of a keyword that is listed.
const LONGEST_KEYWORD: usize = 100;

impl ModelData {
    /// Notes that something is not used, `is_part` of what would hold, load or join parts; what is left out for the same reason is
    /// counted together.
    pub(super) fn leave_out(
        &mut self,
        keyword: &str,
        place: impl FnOnce() -> String,
        (reason, is_part): (&str, bool),
    ) {
        let key = (shortened(keyword, LONGEST_KEYWORD), reason.to_owned());
        let next = self.left_out.len();
        let at = *self.listed.entry(key.clone()).or_insert(next);
        if at == next {
            let (keyword, reason) = key;
            let (place, count, is_part) = (place(), 0, false);
            self.left_out.push(LeftOut { keyword, place, count, reason, is_part });
        }
        self.left_out[at].count += 1;
        self.left_out[at].is_part |= is_part;
    }
}

impl LeftOut {
    /// What stands once in the file and is no part of the structure.
    pub fn once(keyword: String, place: String, reason: impl Into<String>) -> Self {
        Self { keyword, place, count: 1, reason: reason.into(), is_part: false }
    }

    /// The keyword or card alone, as `mesh.drop` names it.
    pub fn card(&self) -> &str {
        let ends = [" of ", " with ", " without "].into_iter();
        let end = ends.filter_map(|word| self.keyword.find(word)).min();
        &self.keyword[..end.unwrap_or(self.keyword.len())]
    }

    /// Whether an entry of `mesh.drop` names it: its keyword, with or without parameters.
    pub fn is_named(&self, entry: &str) -> bool {
        let (own, entry) = (self.keyword.to_uppercase(), entry.trim().to_uppercase());
        let rest = own.strip_prefix(entry.as_str());
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric()))
            && !entry.is_empty()
    }
}

impl std::fmt::Display for LeftOut {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({}", self.keyword, self.place)?;
        if self.count > 1 {
            write!(f, ", {} times", self.count)?;
        }
        let colon = if self.reason.is_empty() { "" } else { ": " };
        write!(f, "){colon}{}", self.reason)
    }
}
