//! The words by which a case names its choices.

use super::body::CounterfaceWord;
use super::boundaries::ConditionWord;
use super::key::Choice;
use super::{
    Analysis, CeaMethod, Combination, FrfMethod, InitialState, OnsetChoice, OperatorChoice,
    Spacing, StabilityChoice,
};
use crate::fem::{MassKind, PlaneFormulation};
use crate::frf::{Direction, FrfBoundary};
use crate::mesh::ElementKind;
use crate::signal::ResponseQuantity;

/// What presses the body in steady sliding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BaseContact {
    Rigid,
    Compliant,
}

/// States the words of each choice.
macro_rules! words {
    ($($choice:ty { $($word:literal = $value:expr),+ $(,)? })+) => {$(
        impl Choice for $choice {
            const WORDS: &'static [(&'static str, Self)] = &[$(($word, $value)),+];
        }
    )+};
}

words! {
    ConditionWord {
        "clamped" = Self::Clamped,
        "support" = Self::Support,
        "guide" = Self::Guide,
        "pressure" = Self::Pressure,
        "free" = Self::Free,
    }
    CounterfaceWord { "cylinder" = Self::Cylinder, "plane" = Self::Plane, "body" = Self::Body }
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
    OnsetChoice { "all" = Self::All, "lowest" = Self::Lowest }
    StabilityChoice { "point" = Self::Point, "branch" = Self::Branch, "none" = Self::None }
    FrfBoundary { "free" = Self::Free, "clamped" = Self::Clamped, "sliding" = Self::Sliding }
    BaseContact { "rigid" = Self::Rigid, "compliant" = Self::Compliant }
    Direction { "radial" = Self::Radial, "tangential" = Self::Tangential, "axial" = Self::Axial }
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
