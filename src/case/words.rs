//! The choices that a case names by a word, and their words.

use super::range::Spacing;
use crate::fem::{MassKind, PlaneFormulation, RotationFrame};
use crate::frf::{Direction, FrfBoundary};
use crate::mesh::ElementKind;
use crate::prestress::BaseChoice;
use crate::signal::ResponseQuantity;
use crate::transient::{InitialState, OperatorChoice};

/// A choice that a case names by a word.
pub(super) trait Choice: Copy + 'static {
    /// Every word with what it stands for, in the order of the documentation.
    const WORDS: &'static [(&'static str, Self)];
}

/// The words of a choice.
pub(super) fn words<T: Choice>() -> Vec<&'static str> {
    T::WORDS.iter().map(|pair| pair.0).collect()
}

/// The words of a choice with what they stand for.
pub(super) fn words_of<T: Choice>() -> impl Iterator<Item = (&'static str, T)> {
    T::WORDS.iter().copied()
}

/// What `improve` tries on a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ModificationKind {
    /// A point mass.
    Mass,
    /// A spring to the ground.
    Spring,
    /// A dashpot to the ground.
    Dashpot,
    /// A damping layer on some elements.
    Damping,
    /// Elements taken away.
    Removal,
    /// The hole of a plane body moved.
    Offset,
}

impl ModificationKind {
    /// Its word.
    pub fn word(self) -> &'static str {
        let own = Self::WORDS.iter().find(|pair| pair.1 == self);
        own.map_or("", |pair| pair.0)
    }

    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::WORDS.iter().map(|pair| pair.1)
    }
}

/// What holds a boundary, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ConditionWord {
    Clamped,
    Support,
    Guide,
    Fixed,
    Pressure,
    Free,
}

/// A direction that a boundary is held in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HeldAxis {
    X,
    Y,
    Z,
}

/// Units of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitsWord {
    /// m, kg, s, Pa.
    MKgS,
    /// mm, t, s, MPa.
    MmTS,
}

impl UnitsWord {
    /// Power of ten that takes a length or a speed to SI units.
    pub(super) fn length(self) -> i32 {
        [0, -3][usize::from(self == Self::MmTS)]
    }

    /// The same for a stress: t / (mm s2) = 1e6 Pa.
    pub(super) fn stress(self) -> i32 {
        [0, 6][usize::from(self == Self::MmTS)]
    }

    /// The same for a density: t / mm3 = 1e12 kg / m3.
    pub(super) fn density(self) -> i32 {
        [0, 12][usize::from(self == Self::MmTS)]
    }
}

/// A part of what a mesh file holds beside the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FilePart {
    Materials,
    Ties,
    Contacts,
    Boundaries,
    Motion,
    Nothing,
}

/// The shape of the counterface, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CounterfaceWord {
    Cylinder,
    Plane,
    Sphere,
    Body,
}

/// What presses the body in steady sliding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BaseContact {
    Rigid,
    Compliant,
}

/// Where the axes of an orthotropic material lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AxesWord {
    Global,
    Cylindrical,
}

/// Pressure over approach of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NormalLawWord {
    Linear,
    Cubic,
    Exponential,
}

/// Eigenvalue solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CeaMethod {
    /// Cyclic where mesh and base state have the symmetry, sparse elsewhere.
    Auto,
    /// One small problem for each circumferential harmonic.
    Cyclic,
    /// Shift-invert Krylov-Schur on the whole mesh.
    Sparse,
}

/// `cycle.onsets`: at which losses of stability of a harmonic the cycles are born.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnsetChoice {
    /// At every one below the case's friction coefficient; where there is none, at the lowest.
    All,
    /// At the lowest.
    Lowest,
}

/// `cycle.stability`: which cycles' stability is worked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StabilityChoice {
    /// Those at the case's own operating point.
    Point,
    /// Those along the branch, too.
    Branch,
    /// None.
    None,
}

/// How a frequency response is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrfMethod {
    /// The fastest that needs no tolerance: cyclic.
    Auto,
    /// Every circumferential harmonic at each frequency.
    Cyclic,
    /// A sparse solution of the whole mesh at each frequency.
    Direct,
    /// Rational Krylov reduction with its error stated.
    Reduced,
}

/// What runs at a point of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Analysis {
    /// The complex eigenvalue analysis.
    Cea,
    /// The explicit transient.
    Transient,
    /// The direct search for limit cycles.
    Cycle,
    /// Boundary between the basins of two limit cycles.
    Basin,
}

/// How several swept keys combine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    /// Every value of each with every value of the others, the last key fastest.
    Grid,
    /// The first value of each, then the second of each, and so on.
    Zip,
}

/// States the words of each choice.
macro_rules! choices {
    ($($choice:ty { $($word:literal = $value:expr),+ $(,)? })+) => {$(
        impl Choice for $choice {
            const WORDS: &'static [(&'static str, Self)] = &[$(($word, $value)),+];
        }
    )+};
}

choices! {
    ConditionWord {
        "clamped" = Self::Clamped,
        "support" = Self::Support,
        "guide" = Self::Guide,
        "fixed" = Self::Fixed,
        "pressure" = Self::Pressure,
        "free" = Self::Free,
    }
    UnitsWord { "m-kg-s" = Self::MKgS, "mm-t-s" = Self::MmTS }
    FilePart {
        "materials" = Self::Materials,
        "ties" = Self::Ties,
        "contacts" = Self::Contacts,
        "boundaries" = Self::Boundaries,
        "motion" = Self::Motion,
        "nothing" = Self::Nothing,
    }
    CounterfaceWord { "cylinder" = Self::Cylinder, "plane" = Self::Plane, "sphere" = Self::Sphere, "body" = Self::Body }
    ElementKind { "quad4" = Self::Quad4, "quad8" = Self::Quad8 }
    PlaneFormulation { "plane-strain" = Self::PlaneStrain, "plane-stress" = Self::PlaneStress, "three-dimensional" = Self::ThreeDimensional }
    MassKind { "consistent" = Self::Consistent, "lumped" = Self::Lumped }
    Spacing { "linear" = Self::Linear, "log" = Self::Logarithmic }
    CeaMethod { "auto" = Self::Auto, "cyclic" = Self::Cyclic, "sparse" = Self::Sparse }
    InitialState {
        "rest" = Self::Rest,
        "steady-sliding" = Self::SteadySliding,
        // Harmonic and onset are keys of their own.
        "limit-cycle" = Self::LimitCycle { harmonic: 1, onset: 1 },
    }
    OperatorChoice { "auto" = Self::Auto, "cyclic" = Self::Cyclic, "sparse" = Self::Sparse }
    Combination { "grid" = Self::Grid, "zip" = Self::Zip }
    Analysis { "transient" = Self::Transient, "cea" = Self::Cea, "cycle" = Self::Cycle, "basin" = Self::Basin }
    ModificationKind {
        "mass" = Self::Mass,
        "spring" = Self::Spring,
        "dashpot" = Self::Dashpot,
        "damping" = Self::Damping,
        "removal" = Self::Removal,
        "offset" = Self::Offset,
    }
    OnsetChoice { "all" = Self::All, "lowest" = Self::Lowest }
    StabilityChoice { "point" = Self::Point, "branch" = Self::Branch, "none" = Self::None }
    FrfBoundary { "free" = Self::Free, "clamped" = Self::Clamped, "sliding" = Self::Sliding }
    BaseChoice { "solved" = Self::Solved, "closed" = Self::Closed }
    NormalLawWord { "linear" = Self::Linear, "cubic" = Self::Cubic, "exponential" = Self::Exponential }
    RotationFrame { "rest" = Self::Rest, "turning" = Self::Turning }
    HeldAxis { "x" = Self::X, "y" = Self::Y, "z" = Self::Z }
    BaseContact { "rigid" = Self::Rigid, "compliant" = Self::Compliant }
    AxesWord { "global" = Self::Global, "cylindrical" = Self::Cylindrical }
    Direction {
        "radial" = Self::Radial,
        "tangential" = Self::Tangential,
        "axial" = Self::Axial,
        "x" = Self::X,
        "y" = Self::Y,
        "z" = Self::Z,
    }
    ResponseQuantity {
        "accelerance" = Self::Accelerance,
        "mobility" = Self::Mobility,
        "receptance" = Self::Receptance,
    }
    FrfMethod {
        "auto" = Self::Auto,
        "cyclic" = Self::Cyclic,
        "direct" = Self::Direct,
        "reduced" = Self::Reduced,
    }
}
