//! What a file of a finite-element program holds beside its mesh: materials, ties, contacts, conditions; and what of it was
//! left out.
//!
//! Values are in the units of the file, whatever those are.

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
    /// What a user should know of how the file was read.
    pub remarks: Vec<String>,
}

/// The material of a region.
#[derive(Clone, Debug, PartialEq)]
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
#[derive(Clone, Debug, PartialEq)]
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
}

impl ModelData {
    /// Notes that something is not used; what is left out for the same reason is counted together.
    pub(super) fn leave_out(&mut self, keyword: &str, place: impl Fn() -> String, reason: &str) {
        let known = self
            .left_out
            .iter_mut()
            .find(|known| known.keyword == keyword && known.reason == reason);
        match known {
            Some(known) => known.count += 1,
            None => self.left_out.push(LeftOut {
                keyword: keyword.to_owned(),
                place: place(),
                count: 1,
                reason: reason.to_owned(),
            }),
        }
    }
}

impl std::fmt::Display for LeftOut {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({}", self.keyword, self.place)?;
        if self.count > 1 {
            write!(f, ", {} times", self.count)?;
        }
        write!(f, ")")?;
        if !self.reason.is_empty() {
            write!(f, ": {}", self.reason)?;
        }
        Ok(())
    }
}
