//! The matrices of small motions around steady sliding.

use super::elimination::{Elimination, RigidFriction};
use super::terms::{Kind, Term, Terms, of_kind};
use super::{LossGain, PrestressError, TabledGain, TangentOptions};
use crate::contact::{ContactStiffness, Point, PressedState, Row, Turning, linearized, turned};
use crate::fem::{DofMap, ModulusTable, RayleighDamping, Triplets};
use crate::linalg::{FrictionWeights, MatrixPolynomial, SparsityPattern, c64};
use std::borrow::Cow;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Mass, damping and stiffness of small motions around steady sliding, polynomials in `mu`.
///
/// With `q` the displacement from the base state, in nodal frames,
///
/// ```text
/// M q'' + C q' + (K_e + K_sigma) q = dF,
/// dF_n = dN - (T / a) q_t,   dF_t = s mu dN + (N / a) q_t - N mu' q_t'   at each pressed contact node:
/// ```
///
/// with `mu` that at the sliding speed `V` and `mu'` its slope there: where friction falls, the last term feeds the motion. The contact
/// forces `N` and `T = s mu N` of the base state turn with the node on the curved edge (a rigid rotation of everything leaves the edge in
/// balance), and friction follows the normal force. `1 / a` is the curvature of the counterface, negative around the body and zero for a
/// plane. Open nodes are free. Penalty contact has `dN = -w (k_n q_n + c_n q_n')`, `w` the node's tributary length. Rigid contact has
/// `q_n = 0` and unknown `dN`, eliminated by adding `-s mu` times each normal row to its tangential row, in `M`, `C` and `K` alike: the
/// contact force balances inertia and damping too.
///
/// `K_sigma` is a polynomial in `mu` like the base state (affine on the annulus), so every matrix is one too, all
/// on one sparsity pattern. Supports add their springs and dashpots, which `beta_R` does not multiply. Source: Brunetti et al., section 4, which leaves the
/// linearisation to a commercial code; the follower terms and the projection are written out here.
#[derive(Clone, Debug)]
pub struct SlidingTangent {
    /// `M(mu)`, kg/m.
    pub mass: MatrixPolynomial,
    /// `C(mu)`, Pa s.
    pub damping: MatrixPolynomial,
    /// `K_t(mu)`, Pa.
    pub stiffness: MatrixPolynomial,
    /// Stiffness of loss factors and of tables over frequency, which `K_t` has beside it with these factors, Pa: first, where there
    /// is one, structural damping `H(mu)`, whose force is `i H q` at positive frequencies.
    pub losses: Vec<(LossGain, MatrixPolynomial)>,
    /// Coefficients with which `C = alpha_R M + beta_R K_t` exactly; `None` where damping is not proportional.
    pub proportional: Option<RayleighDamping>,
    /// Whether `C(0)` has a skew part: bodies that turn.
    pub is_gyroscopic: bool,
    /// Which full dofs the unknowns are.
    pub unknowns: DofMap,
    /// Unknowns that the contact touches, in the order of the interface; no normal ones of rigid contact.
    pub contact: ContactDofs,
    /// Dofs that are combinations of the unknowns (as full dofs): a contact normal whose unknown is the separation there, a
    /// dof of a tied surface.
    pub distances: Vec<(usize, Row)>,
    /// Friction of rigid contact, point by point.
    pub friction: Vec<RigidFriction>,
}

impl SlidingTangent {
    /// Whether damping is not viscous alone.
    pub fn is_lossy(&self) -> bool {
        !self.losses.is_empty()
    }

    /// Structural damping `H(mu)`, Pa.
    pub fn structural(&self) -> Option<&MatrixPolynomial> {
        let mut own = self.losses.iter().filter(|(gain, _)| gain.0.is_none());
        own.next().map(|(_, own)| own)
    }

    /// Parts whose stiffness depends on frequency.
    pub fn tabled(&self) -> impl Iterator<Item = (&TabledGain, &MatrixPolynomial)> {
        self.losses.iter().filter_map(|(gain, own)| Some((gain.0.as_ref()?, own)))
    }

    /// Whether there are any.
    pub fn is_tabled(&self) -> bool {
        self.tabled().next().is_some()
    }

    /// The tangent with all its stiffness as it is at one frequency, structural damping included, and no tables: the same where
    /// it has none.
    pub fn at_frequency(&self, frequency_hz: f64) -> Cow<'_, Self> {
        if !self.is_tabled() {
            return Cow::Borrowed(self);
        }
        let mut frozen = self.referred_to(frequency_hz); // Their factors are imaginary there.
        let lost = frozen.losses.iter().map(|(gain, part)| {
            let gain = gain.at(c64::new(0.0, TAU * frequency_hz));
            MatrixPolynomial::combination(0.0, part, gain.im, part)
        });
        let lost = lost.reduce(|sum, own| MatrixPolynomial::combination(1.0, &sum, 1.0, &own)); // H + sum_p Im g_p K_p.
        frozen.losses = lost.into_iter().map(|own| (LossGain(None), own)).collect();
        Cow::Owned(frozen)
    }

    /// The same tangent with its real stiffness referred to another frequency, from which the parts of tables differ less there.
    pub fn referred_to(&self, frequency_hz: f64) -> Self {
        let mut other = self.clone();
        for (gain, part) in &mut other.losses {
            let Some(gain) = &mut gain.0 else { continue };
            let before = gain.reference();
            gain.reference_hz = frequency_hz;
            // K + (r(f) - r(f_0)) K_p, with r what the table has at its reference.
            let change = gain.reference() - before;
            other.stiffness = MatrixPolynomial::combination(1.0, &other.stiffness, change, part);
        }
        other
    }

    /// The first table that does not hold a frequency, Hz.
    pub fn table_without(&self, frequency_hz: f64) -> Option<&Arc<ModulusTable>> {
        self.tabled().map(|(gain, _)| &gain.table).find(|table| !table.covers(frequency_hz))
    }

    /// Displacement of every dof from a vector over the unknowns.
    pub fn displacement(&self, unknowns: &[c64]) -> Vec<c64> {
        let free = self.unknowns.expand(unknowns);
        let mut full = free.clone();
        for (dof, row) in &self.distances {
            full[*dof] = row.iter().map(|&(other, share)| free[other] * share).sum(); // Separations and ties: u_p = sum_j T_pj y_j.
        }
        full
    }

    /// The vector `v` over all dofs with `v^T A u = w^T P x` for a matrix `A` of the bodies over all dofs, `P` what it is over
    /// the unknowns at friction `mu`, `x` a vector over these and `u` its displacement: that of `w` less, at each point of rigid
    /// contact, what the normal force does along its slip,
    ///
    /// ```text
    /// v = T w - mu sum_i (slip_i . T w) lift_i
    /// ```
    pub fn left_displacement(&self, unknowns: &[c64], mu: f64) -> Vec<c64> {
        let own = self.displacement(unknowns);
        let mut full = own.clone();
        for point in &self.friction {
            let slip: c64 = point.slip.iter().map(|&(dof, a)| own[dof] * a).sum(); // v = T w - mu (slip . T w) lift.
            for &(dof, value) in &point.lift {
                full[dof] -= slip * (mu * value);
            }
        }
        full
    }
}

/// The surfaces of one contact and their state.
#[derive(Clone, Copy, Debug)]
pub struct ContactPart<'a> {
    /// Its points.
    pub points: &'a [Point],
    /// How they turn; not read where nothing turns with the geometric stiffness.
    pub turnings: &'a [Turning],
    /// Which are pressed, with what forces.
    pub state: &'a PressedState,
    /// Place of its first point among those of the state.
    pub first: usize,
    /// Penalty or rigid, and dashpots.
    pub stiffness: ContactStiffness,
    /// Whether each point has a dof of its own, in place of which its separation is an unknown: rigid contact needs it.
    pub has_own_dofs: bool,
}

/// Dofs, or unknowns, that the contact touches, for the harmonic of a mode and its share there.
#[derive(Clone, Debug, Default)]
pub struct ContactDofs {
    /// Along the sliding.
    pub tangential: Vec<usize>,
    /// Along the normals.
    pub normal: Vec<usize>,
    /// Of the opposite body, two for each contact node of an annulus; none on a rigid counterface.
    pub opposite: Vec<usize>,
    /// Angle of each contact node, rad; empty for a body without rotational symmetry, whose modes have no circumferential harmonic.
    pub angles: Vec<f64>,
    /// Sense of the friction force `s`.
    pub sliding_direction: f64,
}

impl SlidingTangent {
    /// The matrices of bodies, `terms` over all dofs, and their contacts over what `basis` (held dofs, ties) and rigid contact leave.
    ///
    /// # Errors
    /// [`PrestressError::Asked`] where a rigid contact has no free dof to hold.
    pub fn assemble(
        mut terms: Terms<Triplets>,
        contacts: &[ContactPart<'_>],
        mut basis: Elimination,
        dofs: ContactDofs,
        options: &TangentOptions,
    ) -> Result<Self, PrestressError> {
        // Separations as unknowns; those of rigid contact vanish, and their forces follow the slip.
        let friction = hold_rigid(contacts, &mut basis)?;
        contacts.iter().for_each(|part| part.add_to(&mut terms));

        // Every term over the unknowns, on one pattern for all.
        let unknowns = basis.unknowns();
        let frozen = contacts.iter().map(|part| part.state.frozen_below).fold(0.0, f64::max);
        let follows = (&friction[..], FrictionWeights::frozen_below(frozen));
        let terms = terms.map(|power, own| basis.project((power, &own), &unknowns, follows));
        let entries = terms.all.iter().flat_map(|term| &term.matrix).flat_map(|own| &own.entries);
        let positions = entries.map(|&(row, column, _)| (row, column));
        let pattern = Arc::new(SparsityPattern::from_positions(unknowns.len(), positions));
        let terms = terms.map(|_, own| placed(&pattern, own));

        // The sums.
        let sum = |factor: &dyn Fn(&Term<Placed>) -> f64| {
            let all = terms.all.iter().map(|term| (factor(term), &term.matrix));
            MatrixPolynomial::from_coefficients(&pattern, summed(pattern.nonzero_count(), all))
                .frozen_below(frozen)
        };
        Ok(Self {
            mass: sum(&of_kind(Kind::Mass)),
            damping: sum(&|term| terms.factors(term)[1]),
            stiffness: sum(&|term| terms.factors(term)[0]),
            losses: terms.losses(sum),
            proportional: terms.is_proportional(options).then_some(options.damping),
            is_gyroscopic: terms.all.iter().any(|term| term.kind == Kind::Gyroscopic),
            contact: ContactDofs {
                tangential: unknowns.among(&dofs.tangential),
                normal: unknowns.among(&dofs.normal),
                opposite: unknowns.among(&dofs.opposite),
                ..dofs
            },
            distances: basis.combinations().map(|(dof, row)| (dof, row.clone())).collect(),
            friction,
            unknowns,
        })
    }
}

impl ContactPart<'_> {
    /// Adds what it does around its state.
    pub(super) fn add_to(&self, terms: &mut Terms<Triplets>) {
        let state = (self.state, self.first);
        let [stiffness, dashpots, friction] = linearized(self.points, state, &self.stiffness);
        let part = terms.add_contact(self.stiffness.loss_factor);
        terms.add(part, Kind::Stiffness, stiffness);
        terms.add(part, Kind::Dashpots, dashpots);
        terms.add(part, Kind::FrictionDashpots, friction);
        terms.add(part, Kind::Prestress, turned(self.points, self.turnings, state)); // Forces of the base state turn with their points.
    }
}

/// Nonzeros of a term by power of friction: their places on the pattern, and values.
type Placed = Vec<Vec<(usize, f64)>>;

fn placed(pattern: &SparsityPattern, polynomial: Vec<Triplets>) -> Placed {
    // Entries come row by row: the places of one row by their columns.
    let (mut places, mut known) = (vec![0; pattern.dimension()], usize::MAX);
    let mut place = |(row, column, value): (usize, usize, f64)| {
        if row != known {
            pattern.row(row).for_each(|(place, column)| places[column] = place);
            known = row;
        }
        (places[column], value)
    };
    polynomial.into_iter().map(|own| own.entries.into_iter().map(&mut place).collect()).collect()
}

/// The sum of terms, each times its factor, by power of friction.
fn summed<'a>(nonzeros: usize, terms: impl Iterator<Item = (f64, &'a Placed)>) -> Vec<Vec<f64>> {
    let mut sums = vec![vec![0.0; nonzeros]];
    for (factor, powers) in terms.filter(|(factor, _)| *factor != 0.0) {
        sums.resize(sums.len().max(powers.len()), vec![0.0; nonzeros]);
        for (sum, own) in sums.iter_mut().zip(powers) {
            own.iter().for_each(|&(place, value)| sum[place] += factor * value);
        }
    }
    sums
}

/// Takes separations for unknowns and drops those of rigid contact; the friction of its forces.
fn hold_rigid(
    contacts: &[ContactPart<'_>],
    basis: &mut Elimination,
) -> Result<Vec<RigidFriction>, PrestressError> {
    let mut friction = Vec::new();
    for part in contacts.iter().filter(|part| part.has_own_dofs) {
        let is_rigid = part.stiffness.normal_stiffness.is_none();
        let own = &part.state.is_pressed[part.first..];
        for (point, &is_pressed) in part.points.iter().zip(own) {
            let pivot = basis.take(&point.normal).ok_or_else(|| {
                let problem = "contact holds nodes that are already held or tied: leave one of the conditions out there";
                PrestressError::Asked(problem.to_owned())
            })?;
            // A pressed point of rigid contact keeps its separation: c = 0.
            if is_rigid && is_pressed {
                basis.drop_unknown(pivot);
                friction.push(RigidFriction::of(point));
            }
        }
    }
    Ok(friction)
}

#[cfg(test)]
mod tests;
