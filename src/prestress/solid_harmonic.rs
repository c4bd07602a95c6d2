//! The matrices of one harmonic of a body of revolution, and Coulomb's law put into them.

use crate::fem::DofMap;
use crate::linalg::banded::BandedMatrix;
use crate::linalg::c64;

/// A matrix of the wave `U e^{i n theta}` by power of `i mu`, real.
type Powers = [BandedMatrix; 2];

/// Mass, damping and stiffness of one harmonic before the contact condition is put in.
///
/// Unknowns are `(u_r, -i u_theta, u_z)` of the nodes that nothing holds. In rigid contact the motion of pressed nodes along the
/// normal vanishes, and the force there drives the tangential equation of the same node: [`Self::rigid`]. In the weak form a
/// pressed node has the force `N` along `n + s mu t`, which does no work on virtual motions
///
/// ```text
/// v_t t - s mu v_t n:   (row of t) - s mu (row of n) = 0,   rows of lambda^2 M + lambda (C + mu A) + K
/// ```
///
/// Whatever loads the normal equation takes part, for `N` balances it. So do the dashpots `mu A` of friction: on bricks of 20 nodes
/// the traction of one point acts on nodes at other angles, whose normals it has a part along, and that part comes back times
/// `s mu`: a term of `mu^2`. (Nodes that carry the traction lumped, those of 8-node bricks and of the plane, have none.)
#[derive(Clone, Debug)]
pub struct SolidHarmonic {
    /// `M`, kg.
    pub mass: BandedMatrix,
    /// `K`, N/m, by power of `i mu`.
    pub stiffness: Powers,
    /// `C` without the part across the sliding, N s/m, by power of `i mu`.
    pub damping: Powers,
    /// `A`, dashpots to be multiplied by `mu`, N s/m: `p_0 / V` across the sliding, and along it where friction falls with the speed.
    pub across: BandedMatrix,
    /// Unknowns `(normal, tangential)` of each node in rigid contact, and the factor `s` times the sign of the inward normal
    /// with which the normal equation, times `i mu`, is added to the tangential one.
    pub rigid: Vec<(usize, Option<usize>, f64)>,
}

/// [`SolidHarmonic`] at one friction coefficient over the unknowns that move, as bands laid out like [`BandedMatrix::values`].
#[derive(Clone, Debug)]
pub struct MovingHarmonic {
    /// Off-diagonals on either side.
    pub half_bandwidth: usize,
    /// `M`, kg.
    pub mass: Vec<c64>,
    /// `C`, N s/m.
    pub damping: Vec<c64>,
    /// `K`, N/m.
    pub stiffness: Vec<c64>,
}

impl SolidHarmonic {
    /// Unknowns that may move, ascending.
    pub fn moving(&self) -> Vec<usize> {
        moving_unknowns(self.mass.dimension(), &self.rigid)
    }

    /// The matrices at a friction coefficient, over [`Self::moving`]: the row of the normal of a node in rigid contact, times
    /// `i mu s` in the basis `(u_r, -i u_theta, u_z)`, goes to that of its tangent, in `M`, `C` and `K` alike, before it is dropped
    /// with the normal motion.
    pub fn at(&self, friction_coefficient: f64) -> MovingHarmonic {
        let mu = friction_coefficient;
        let turn = c64::new(0.0, mu);
        let sum = |powers: &[&BandedMatrix]| {
            let mut power = c64::new(1.0, 0.0);
            let mut band = vec![c64::new(0.0, 0.0); powers[0].values().len()];
            for matrix in powers {
                for (sum, value) in band.iter_mut().zip(matrix.values()) {
                    *sum += power * *value;
                }
                power *= turn;
            }
            band
        };
        let [c0, c1] = &self.damping;
        let mut damping = sum(&[c0, c1]);
        let across = self.across.values().iter();
        damping.iter_mut().zip(across).for_each(|(c, a)| *c += mu * a);
        let [k0, k1] = &self.stiffness;
        let moving = self.moving();
        let h = self.mass.half_bandwidth();
        let condensed = |mut band: Vec<c64>| {
            for &(normal, tangential, factor) in &self.rigid {
                if let Some(tangential) = tangential {
                    let factor = c64::new(0.0, mu * factor);
                    add_row(&mut band, h, [normal, tangential], factor);
                }
            }
            restricted(&band, h, &moving)
        };
        MovingHarmonic {
            half_bandwidth: h,
            mass: condensed(sum(&[&self.mass])),
            damping: condensed(damping),
            stiffness: condensed(sum(&[k0, k1])),
        }
    }
}

/// Unknowns of a harmonic that may move, ascending: all of `count` but the normals of [`SolidHarmonic::rigid`].
pub fn moving_unknowns(count: usize, rigid: &[(usize, Option<usize>, f64)]) -> Vec<usize> {
    let normals = rigid.iter().map(|(normal, ..)| *normal);
    DofMap::excluding(count, normals).dofs
}

/// Adds `factor` times row `from` to row `to` of a band laid out like [`BandedMatrix::values`]; both belong to one node, whose
/// neighbours lie within the band of either.
fn add_row(band: &mut [c64], h: usize, [from, to]: [usize; 2], factor: c64) {
    let width = 2 * h + 1;
    for k in 0..width {
        let value = band[from * width + k];
        if value != c64::new(0.0, 0.0) {
            // Column `from + k - h` in both rows.
            band[to * width + k + from - to] += factor * value;
        }
    }
}

/// Rows and columns `kept` (ascending) of a band alone.
fn restricted(band: &[c64], h: usize, kept: &[usize]) -> Vec<c64> {
    let width = 2 * h + 1;
    let mut result = vec![c64::new(0.0, 0.0); kept.len() * width];
    for (row, &old_row) in kept.iter().enumerate() {
        for column in row.saturating_sub(h)..(row + h + 1).min(kept.len()) {
            let old_column = kept[column];
            if old_row.abs_diff(old_column) <= h {
                result[row * width + column + h - row] =
                    band[old_row * width + old_column + h - old_row];
            }
        }
    }
    result
}
