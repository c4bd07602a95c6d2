//! Forces of Maxwell elements: what a stiffness that depends on frequency is in time.

use super::TransientError;
use super::force_rows::ForceRows;
use crate::fem::operator::{MotionFields, StiffnessOperator};
use crate::fem::{MaterialField, Triplets, region_stiffness};
use crate::mesh::Mesh;

/// Places of `z_n` and `z_{n-1}` among the stretches of an element.
const NOW: usize = 0;
const BEFORE: usize = 1;

/// The elements of all regions that have a chain ([`crate::fem::MaxwellChain`]).
///
/// Element `j` of a region with the stiffness `K` at rest has a motion `z_j` of its spring and the force `s_j K z_j`:
///
/// ```text
/// z_j' = v - z_j / tau_j
/// z_{n+1} - z_n = dt v_{n+1/2} - dt (z_{n+1} + z_n) / (2 tau)
/// ```
///
/// The force of `z_n` acts in step `n` beside `K u_n`. With the energy `1/2 s z_{n+1}^T K z_n` of a spring and
///
/// ```text
/// D_n = s / (4 tau) z_n^T K (z_{n+1} + 2 z_n + z_{n-1})
/// ```
///
/// for the power of its dashpot, `E_{n+1/2} - E_{n-1/2} = dt (v_n^T s K z_n - D_n)` holds exactly, as for the springs of the body.
#[derive(Debug, Default)]
pub(super) struct Relaxation {
    parts: Vec<Part>,
}

/// A region.
#[derive(Debug)]
struct Part {
    /// `K`.
    rows: ForceRows,
    elements: Vec<Element>,
}

#[derive(Debug)]
struct Element {
    time: f64,
    stiffness: f64,
    /// `z_n` and `z_{n-1}`.
    stretch: [Vec<f64>; 2],
    /// `K` times the older of the two that the last step had.
    image: Vec<f64>,
}

impl Relaxation {
    /// The elements of the regions of a mesh; `bound` takes its ties and held dofs out of a matrix.
    pub fn new(
        mesh: &Mesh,
        materials: &dyn MaterialField,
        operator: &dyn StiffnessOperator,
        bound: &dyn Fn(Triplets) -> Triplets,
    ) -> Self {
        let regions = 0..mesh.regions.len().max(1);
        let parts = regions.filter_map(|region| {
            let chain = materials.chain(region)?;
            let stiffness = region_stiffness(mesh, materials, region);
            let (dofs, rows) = ForceRows::of(bound(stiffness), operator);
            let still = vec![0.0; dofs.len()];
            let elements = chain.elements.iter().map(|own| Element {
                time: own.time,
                stiffness: own.stiffness,
                stretch: [still.clone(), still.clone()],
                image: still.clone(),
            });
            Some(Part { elements: elements.collect(), rows })
        });
        Self { parts: parts.collect() }
    }

    /// Adds the forces of the coming step to the elastic accelerations.
    pub fn apply(&mut self, fields: &mut MotionFields) {
        for part in &mut self.parts {
            part.look(NOW);
            part.rows.look(fields);
            let elements = &part.elements;
            let force = |i| elements.iter().map(|own| own.stiffness * own.image[i]).sum();
            part.rows.apply(fields, force);
        }
    }

    /// Takes them out again after the step and moves the elements on; the power of their dashpots, W/m.
    pub fn settle(&mut self, fields: &mut MotionFields, time_step: f64) -> f64 {
        let mut power = 0.0;
        for part in &mut self.parts {
            part.rows.settle(fields, time_step);
            for own in &mut part.elements {
                let [kept, gained] = own.factors(time_step);
                let mut lost = 0.0;
                for (i, &place) in part.rows.places.iter().enumerate() {
                    let (now, last) = (own.stretch[NOW][i], own.stretch[BEFORE][i]);
                    let next = kept * now + gained * fields.velocity[place];
                    lost += own.image[i] * (next + 2.0 * now + last);
                    (own.stretch[NOW][i], own.stretch[BEFORE][i]) = (next, now);
                }
                power += 0.25 * own.stiffness / own.time * lost;
            }
        }
        power
    }

    /// Energy of their springs at `n - 1/2`, `n` the next step, J/m.
    pub fn energy(&self) -> f64 {
        let energy = self.parts.iter().flat_map(|part| &part.elements).map(|own| {
            let pairs = own.image.iter().zip(&own.stretch[NOW]);
            0.5 * own.stiffness * pairs.map(|(force, z)| force * z).sum::<f64>()
        });
        energy.sum()
    }

    /// Lets the elements come to the next step with the velocity `v_{n-1/2}` that the fields have now, another one than they came with.
    pub fn rewind(&mut self, fields: &MotionFields, time_step: f64) {
        for part in &mut self.parts {
            for own in &mut part.elements {
                let [kept, gained] = own.factors(time_step);
                for (i, &place) in part.rows.places.iter().enumerate() {
                    own.stretch[BEFORE][i] =
                        (own.stretch[NOW][i] - gained * fields.velocity[place]) / kept;
                }
            }
            part.look(BEFORE);
        }
    }

    /// `z_n` and `z_{n-1}` of every element.
    pub fn state(&self) -> Vec<Vec<f64>> {
        let elements = self.parts.iter().flat_map(|part| &part.elements);
        elements.flat_map(|own| own.stretch.clone()).collect()
    }

    /// Takes up what [`Self::state`] gave.
    ///
    /// # Errors
    /// [`TransientError::ForeignState`] for the elements of another body.
    pub fn restore(&mut self, state: &[Vec<f64>]) -> Result<(), TransientError> {
        let sizes = |all: &[Vec<f64>]| all.iter().map(Vec::len).collect::<Vec<usize>>();
        let [expected, found] = [sizes(&self.state()), sizes(state)];
        if found != expected {
            let [expected, found] = [expected, found].map(|own| own.iter().sum());
            return Err(TransientError::ForeignState { found, expected });
        }
        let mut pairs = state.chunks_exact(2);
        for part in &mut self.parts {
            for (own, pair) in part.elements.iter_mut().zip(&mut pairs) {
                own.stretch.clone_from_slice(pair);
            }
            part.look(BEFORE);
        }
        Ok(())
    }
}

impl Element {
    /// What a step keeps of `z`, and what it takes of the velocity.
    fn factors(&self, time_step: f64) -> [f64; 2] {
        let half = 0.5 * time_step / self.time;
        [(1.0 - half) / (1.0 + half), time_step / (1.0 + half)]
    }
}

impl Part {
    /// `K z_n` or `K z_{n-1}` of every element.
    fn look(&mut self, at: usize) {
        for own in &mut self.elements {
            self.rows.multiply(|j| own.stretch[at][j], &mut own.image);
        }
    }
}
