//! What is kept of one point.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A finished point: what was swept to which values, and what came out of it.
///
/// Holds no case text: the folder's manifest has it once, and `swept` is all that a point changes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointRecord {
    /// Number of the point, from 1.
    pub point: usize,
    /// Swept keys and their values, in the order of the keys.
    pub swept: Map<String, Value>,
    /// Why it failed; `None` if it did not.
    pub error: Option<String>,
    /// Summary of each analysis by its name; empty if the point failed.
    pub summaries: Map<String, Value>,
    /// Wall time on its worker, s.
    pub wall_s: f64,
    /// Time that it kept cores busy, s; less than the wall time where other programs had them too.
    pub core_s: f64,
    /// SHA-256 of the point's effective case, without its `[sweep]`.
    pub case_hash: String,
    /// SHA-256 of the effective case of the whole sweep.
    pub sweep_hash: String,
    /// Program version that made it.
    pub version: String,
    /// SIMD level that the kernels ran with.
    pub simd: String,
}
