//! Choice of instruction set.

use std::fmt;

/// Instruction set of the kernels.
///
/// AVX2 and AVX-512 give the same bits; the scalar kernels do not fuse multiply and add, so theirs differ in the last place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SimdLevel {
    /// What the build's target guarantees, without fused multiply-add.
    Scalar,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512 (F, VL, DQ).
    Avx512,
}

/// Why an instruction set cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct SimdError(String);

impl SimdLevel {
    /// Best level of this processor.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            let fma = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            let wide = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq");
            if fma && wide {
                return Self::Avx512;
            }
            if fma {
                return Self::Avx2;
            }
        }
        Self::Scalar
    }

    /// The level if this processor has it.
    ///
    /// # Errors
    /// [`SimdError`] if it has not.
    pub fn available(self) -> Result<Self, SimdError> {
        let best = Self::detect();
        match self <= best {
            true => Ok(self),
            false => Err(SimdError(format!(
                "this processor does not have {self}; the best it has is {best}: choose --simd auto"
            ))),
        }
    }

    /// Level of a name: `auto` (the best this processor has), `scalar`, `avx2`, `avx512`.
    ///
    /// # Errors
    /// [`SimdError`] for another name or a level that this processor has not.
    pub fn choose(name: &str) -> Result<Self, SimdError> {
        if name == "auto" {
            return Ok(Self::detect());
        }
        let mut all = [Self::Scalar, Self::Avx2, Self::Avx512].into_iter();
        let found = all.find(|level| level.to_string() == name).ok_or_else(|| {
            SimdError(format!("simd level \"{name}\" is none of auto, scalar, avx2, avx512"))
        });
        found?.available()
    }
}

impl fmt::Display for SimdLevel {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Scalar => "scalar",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        })
    }
}
