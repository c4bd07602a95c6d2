//! Where the growth of a mode comes from, and which modes couple.
//!
//! With `phi` a mode over all dofs, `m = phi^H M phi`, `c` and `k` alike, and `p` the power-like product of the contact
//! forces,
//!
//! ```text
//! lambda^2 m + lambda c + k + i h = p,     lambda = sigma + i omega
//! sigma = (Im p - omega c - h) / (2 omega m)
//! ```
//!
//! as `M`, `C`, `K` of the bodies are symmetric; `h` is `eta k` of each region and support with a
//! loss factor. `m`, `c`, `k` are sums over regions and supports, `p` over contacts. So the growth
//! rate is a sum of what each takes or feeds, without a remainder. Regions with the inertia of
//! their rotation add `lambda i g + s`, and with it `-sigma g / (2 omega m)` to the growth rate.

mod budget;
mod feed;
mod mesh_error;
mod parts;
mod shapes;
mod waves;

use super::{model::Model, sliding::SlidingModel};
use crate::*;
use frictionsim_results::cea::Reading;
pub(super) use mesh_error::lefts_needed;
use parts::Parts;
use shapes::Shapes;

/// Bytes of mode shapes over a sweep beyond which they are taken at the ends and at the case's own friction alone.
const MOST_SHAPES: f64 = 5e8;

/// Friction coefficients whose shapes the reading needs, of those that are solved: all of them on a whole mesh, or the
/// lowest and the case's own where they would fill the memory; none where the waves of one sector are enough.
pub(super) fn shapes_needed(case: &Case, model: &Model, frictions: &[f64], modes: f64) -> Vec<f64> {
    let dofs = case.body.dimension() as f64 * case.body.node_count() as f64;
    let own = case.contact.sliding.friction_coefficient;
    match model {
        Model::Waves(_) => Vec::new(),
        _ if 16.0 * dofs * modes * frictions.len() as f64 <= MOST_SHAPES => frictions.to_vec(),
        _ => {
            let lowest = frictions.first().copied();
            let own = frictions.contains(&own).then_some(own);
            lowest.into_iter().chain(own).collect()
        }
    }
}

/// Reads every mode that has a wave or a shape, and gives modes and critical frictions the error of the mesh; `None`
/// where there is none.
pub(super) fn read(
    case: &Case,
    model: &SlidingModel,
    tangent: Option<&WaveTangent>,
    sweep: &mut FrictionSweep,
) -> Option<Reading> {
    let parts = match &model.model {
        Model::Waves(_) => return waves::read(case, model, tangent?, sweep),
        Model::Whole(whole) => Parts::new(case, whole),
    };
    let shaped = |point: &&FrictionPoint| point.modes.iter().any(|mode| mode.shape.is_some());
    let points: Vec<&FrictionPoint> = sweep.points.iter().filter(shaped).collect();
    let (lowest, others) = points.split_first()?;
    let references = Shapes::of(lowest, case.body.has_sectors(), |_| true);
    let (contributions, images) = parts.contributions(&references);
    let couplings = references.couplings(&images, (&references, &images));
    let mut reading = Reading { contributions, couplings, ..Reading::default() };
    let read_point = |point: &&FrictionPoint| {
        let shapes = Shapes::of(point, case.body.has_sectors(), |_| true);
        let (contributions, own_images) = parts.contributions(&shapes);
        (contributions, shapes.couplings(&own_images, (&references, &images)))
    };
    for (contributions, couplings) in parallel::map::<_, _, Vec<_>>(others, read_point) {
        reading.contributions.extend(contributions);
        reading.couplings.extend(couplings);
    }
    reading.feed = feed::feed(&parts, &points);
    mesh_error::estimate(&parts, sweep);
    Some(reading)
}
