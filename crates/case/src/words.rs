//! The choices that a case names by a word, and their words.

use crate::*;
use frictionsim_physics::{frf::Direction, mesh::ElementKind, transient::InitialState};

/// A choice that a case names by a word.
pub trait Choice: Copy + PartialEq + 'static {
    /// Every word with what it stands for, in the order of the documentation.
    const WORDS: &'static [(&'static str, Self)];

    /// All of them.
    fn all() -> impl Iterator<Item = Self> {
        Self::WORDS.iter().map(|pair| pair.1)
    }

    /// All words.
    fn words() -> Vec<&'static str> {
        Self::WORDS.iter().map(|pair| pair.0).collect()
    }

    /// What a word stands for.
    fn of(word: &str) -> Option<Self> {
        Self::WORDS.iter().find(|pair| pair.0 == word).map(|pair| pair.1)
    }

    /// Its word.
    fn word(self) -> &'static str {
        Self::WORDS.iter().find(|pair| pair.1 == self).map_or("", |pair| pair.0)
    }
}

/// Choices by the names of their types, each with its words.
type Named = &'static [(&'static str, fn() -> Vec<&'static str>)];

/// The words of the choice of a type, by its name.
pub(super) fn words_named(name: &str) -> Option<fn() -> Vec<&'static str>> {
    let mut all = [OWN, OTHERS, NAMED].into_iter().flatten();
    all.find(|pair| pair.0 == name).map(|pair| pair.1)
}

impl UnitsWord {
    /// Power of ten that takes numbers to an SI unit: t / (mm s2) = 1e6 Pa, t / mm3 = 1e12 kg / m3.
    pub(super) fn power(self, unit: &str) -> i32 {
        match (self, unit) {
            (Self::MmTS, "m" | "m/s") => -3,
            (Self::MmTS, "Pa") => 6,
            (Self::MmTS, "Pa/m") => 9,
            (Self::MmTS, "kg/m3") => 12,
            _ => 0,
        }
    }
}

/// Declares choices, each variant with its word, in the order of the documentation.
macro_rules! words {
    ($($(#[$meta:meta])* $vis:vis $name:ident {
        $($(#[$of:meta])* $variant:ident $word:literal),+ $(,)?
    })+) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        $vis enum $name { $($(#[$of])* $variant),+ }

        impl Choice for $name {
            const WORDS: &'static [(&'static str, Self)] = &[$(($word, Self::$variant)),+];
        }
    )+
        const OWN: Named = &[$((stringify!($name), $name::words)),+];
    };
}

words! {
    /// What `improve` tries on a body.
    pub ModificationKind {
        /// A point mass.
        Mass "mass",
        /// A spring to the ground.
        Spring "spring",
        /// A dashpot to the ground.
        Dashpot "dashpot",
        /// A damping layer on some elements.
        Damping "damping",
        /// Elements taken away.
        Removal "removal",
        /// The hole of a plane body moved.
        Offset "offset",
    }

    /// What holds a boundary, in words.
    pub(super) ConditionWord {
        Clamped "clamped",
        Support "support",
        Guide "guide",
        Fixed "fixed",
        Pressure "pressure",
        Free "free",
    }

    /// A direction that a boundary is held in.
    pub(super) HeldAxis { X "x", Y "y", Z "z" }

    /// Units of a mesh file.
    pub UnitsWord {
        /// m, kg, s, Pa.
        MKgS "m-kg-s",
        /// mm, t, s, MPa.
        MmTS "mm-t-s",
    }

    /// A part of what a mesh file holds beside the mesh.
    pub(super) FilePart {
        Materials "materials",
        Ties "ties",
        Contacts "contacts",
        Boundaries "boundaries",
        Motion "motion",
        Nothing "nothing",
    }

    /// The shape of the counterface, in words.
    pub(super) CounterfaceWord { Cylinder "cylinder", Plane "plane", Sphere "sphere", Body "body" }

    /// What presses the body in steady sliding.
    pub(super) BaseContact { Rigid "rigid", Compliant "compliant" }

    /// Where the axes of an orthotropic material lie.
    pub(super) AxesWord { Global "global", Cylindrical "cylindrical" }

    /// Pressure over approach of a contact.
    pub(super) NormalLawWord { Linear "linear", Cubic "cubic", Exponential "exponential" }

    /// Eigenvalue solver.
    pub CeaMethod {
        /// Cyclic where mesh and base state have the symmetry, sparse elsewhere.
        Auto "auto",
        /// One small problem for each circumferential harmonic.
        Cyclic "cyclic",
        /// Shift-invert Krylov-Schur on the whole mesh.
        Sparse "sparse",
    }

    /// `cycle.onsets`: at which losses of stability of a harmonic the cycles are born.
    pub OnsetChoice {
        /// At every one below the case's friction coefficient; where there is none, at the lowest.
        All "all",
        /// At the lowest.
        Lowest "lowest",
    }

    /// `cycle.stability`: which cycles' stability is worked out.
    pub StabilityChoice {
        /// Those at the case's own operating point.
        Point "point",
        /// Those along the branch, too.
        Branch "branch",
        /// None.
        None "none",
    }

    /// How a frequency response is computed.
    pub FrfMethod {
        /// The fastest that needs no tolerance: cyclic.
        Auto "auto",
        /// Every circumferential harmonic at each frequency.
        Cyclic "cyclic",
        /// A sparse solution of the whole mesh at each frequency.
        Direct "direct",
        /// Rational Krylov reduction with its error stated.
        Reduced "reduced",
    }

    /// What runs at a point of a sweep.
    pub Analysis {
        /// The explicit transient.
        Transient "transient",
        /// The complex eigenvalue analysis.
        Cea "cea",
        /// The direct search for limit cycles.
        Cycle "cycle",
        /// Boundary between the basins of two limit cycles.
        Basin "basin",
    }

    /// How the values of a range are spaced.
    pub Spacing {
        /// Equal differences.
        Linear "linear",
        /// Equal ratios.
        Logarithmic "log",
    }
    /// How several swept keys combine.
    pub Combination {
        /// Every value of each with every value of the others, the last key fastest.
        Grid "grid",
        /// The first value of each, then the second of each, and so on.
        Zip "zip",
    }
}

/// States the words of each choice.
macro_rules! choices {
    ($($choice:ident { $($word:literal = $value:expr),+ $(,)? })+) => {$(
        impl Choice for $choice {
            const WORDS: &'static [(&'static str, Self)] = &[$(($word, $value)),+];
        }
    )+
        const OTHERS: Named = &[$((stringify!($choice), $choice::words)),+];
    };
}

choices! {
    ElementKind { "quad4" = Self::Quad4, "quad8" = Self::Quad8 }
    PlaneFormulation {
        "plane-strain" = Self::PlaneStrain, "plane-stress" = Self::PlaneStress,
        "three-dimensional" = Self::ThreeDimensional
    }
    MassKind { "consistent" = Self::Consistent, "lumped" = Self::Lumped }
    OperatorChoice { "auto" = Self::Auto, "cyclic" = Self::Cyclic, "sparse" = Self::Sparse }
    FrfBoundary { "free" = Self::Free, "clamped" = Self::Clamped, "sliding" = Self::Sliding }
    BaseChoice { "solved" = Self::Solved, "closed" = Self::Closed }
    RotationFrame { "rest" = Self::Rest, "turning" = Self::Turning }
}

/// Takes the words of choices from their names.
macro_rules! named {
    ($($choice:ident: $($value:expr),+;)+) => {$(
        impl Choice for $choice {
            const WORDS: &'static [(&'static str, Self)] = &[$(($value.name(), $value)),+];
        }
    )+
        const NAMED: Named = &[$((stringify!($choice), $choice::words)),+];
    };
}

named! {
    Direction: Self::Radial, Self::Tangential, Self::Axial, Self::X, Self::Y, Self::Z;
    ResponseQuantity: Self::Accelerance, Self::Mobility, Self::Receptance;
    // Harmonic and onset are keys of their own.
    InitialState: Self::Rest, Self::SteadySliding, Self::LimitCycle { harmonic: 1, onset: 1 };
}
