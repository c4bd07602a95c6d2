//! Springs and dashpots of a contact that is not rigid.

use crate::contact::{ContactStiffness, NormalLaw};

/// Newton steps and halvings of one node at most: an interval of the largest numbers is halved away by then.
const NEWTON_STEPS: usize = 200;

/// The interface between edge and counterface at a point: a spring that pushes but never pulls, with a dashpot beside it.
///
/// ```text
/// N = max(0, k w p + c w p'),   p = s (delta + N_0 / (k w)) - g_0 - u_n
/// ```
///
/// `p` is the compression of a node's spring, `w` its tributary length, `N_0` its force in steady sliding, `s` the share of the
/// interference that is reached. The counterface goes as much further as the interface gives way under `N_0`, so that the base state is
/// that of rigid contact whatever its stiffness, and small motions about it are those of the eigenvalue analysis.
///
/// Force and motion obey the energy of the spring within each step: with `p` the mean compression at the half steps
/// before and after, `U = k w max(0, p)^2 / 2`,
///
/// ```text
/// N = (U_+ - U_-) / (p_+ - p_-) + c w (max(0, p_+) - max(0, p_-)) / dt
/// ```
///
/// (with the energy of the law where contact stiffens with pressure, whose base state is on its springs: there is nothing to go further
/// by), a scalar equation for each node, implicit in `p_+ = p* - dt^2 N / 2m` and in closed form (by Newton's method for a law). It is
/// stable for any stiffness, second order in time, and adds no damping of its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spring {
    /// The law of a unit of the share; of linear contact that of `k w` itself, with a share of one.
    law: NormalLaw,
    share: f64,
    /// `c w`, Pa s.
    damping: f64,
    /// What the interface gives way under the base state's force, `N_0 / (k w)`, m.
    pub compression: f64,
    /// Power of the dashpot in the last step, W/m.
    pub dissipation: f64,
}

/// Steady sliding at a contact point; nothing where its springs need none.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PressedPoint {
    /// Normal force, N (N/m in the plane).
    pub force: f64,
    /// Stiffness of contact that stiffens with pressure, N/m.
    pub spring: f64,
    /// How far the springs have given way in the displacement of the base state, m.
    pub given_way: f64,
}

/// One node before a step, as its spring sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct CompressedNode {
    /// Mass, kg/m.
    pub mass: f64,
    /// Mean compression half a step ago, m.
    pub before: f64,
    /// Mean compression half a step ahead without a normal force, m.
    pub free: f64,
}

impl Spring {
    /// That of a point of such a weight over its base state; `None` is rigid contact.
    pub fn of(contact: &ContactStiffness, weight: f64, base: &PressedPoint) -> Option<Self> {
        let (mut compression, damping) = (0.0, contact.normal_damping * weight);
        let (law, share) = match (contact.law, contact.normal_stiffness) {
            (Some(law), _) => (law, weight),
            (None, Some(stiffness)) => {
                let stiffness = stiffness * weight;
                if base.force > 0.0 {
                    compression = base.force / stiffness - base.given_way;
                }
                (NormalLaw::linear(stiffness), 1.0)
            }
            (None, None) => return None,
        };
        let damping = damping + contact.law_damping * base.spring;
        Some(Self { law, share, damping, compression, dissipation: 0.0 })
    }

    /// Energy at the mean compression `p`, J/m.
    pub fn energy(&self, compression: f64) -> f64 {
        self.share * self.law.energy(compression)
    }

    /// Normal force, N/m; keeps what the dashpot dissipates.
    pub fn force(&mut self, node: &CompressedNode, dt: f64) -> f64 {
        let (c, yielding) = (self.damping / dt, 0.5 * dt * dt / node.mass);
        let after = match self.law {
            NormalLaw::Cubic { stiffness, cubic_stiffness: 0.0 } => {
                compression_after(node, self.share * stiffness, c, yielding)
            }
            law => stiffening_after(node, (law, self.share), c, yielding),
        };
        let spring = self.share * self.law.mean_pressure(node.before, after);
        let change = after - node.before;
        let dashpot = c * (after.max(0.0) - node.before.max(0.0));
        // The interface does not stick to the body: a dashpot that would pull lets it go.
        let force = (spring + dashpot).max(0.0);
        self.dissipation = (force - spring) * change / dt;
        force
    }
}

/// The root `p_+` of `p_+ + a max(0, N(p_+)) = p*`, `a = dt^2 / 2m`: unique, since `N` never falls with `p_+`.
fn compression_after(node: &CompressedNode, k: f64, c: f64, yielding: f64) -> f64 {
    let (before, free) = (node.before, node.free);
    let closed = before.max(0.0);
    let spring = NormalLaw::linear(k).mean_pressure(before, free);
    if spring + c * (free.max(0.0) - closed) <= 0.0 {
        return free;
    }
    let (k, c) = (yielding * k, yielding * c);
    if before < 0.0 {
        // It closes: a quadratic equation for the way d = p_+ - p_- > -p_-.
        let a = 1.0 + 0.5 * k + c;
        let b = free - before - (k + c) * before;
        let way = (b + (b * b - 2.0 * a * k * before * before).max(0.0).sqrt()) / (2.0 * a);
        return before + way;
    }
    let after = (free - (0.5 * k - c) * before) / (1.0 + 0.5 * k + c);
    if after >= 0.0 {
        return after;
    }
    // It opens: one for the way d < -p_-.
    let b = before - free - c * before;
    before - 0.5 * (b + (b * b + 2.0 * k * before * before).sqrt())
}

/// [`compression_after`] of a contact that stiffens, with its share `w` of the edge: the force never falls with `p_+` and is
/// convex in it, so that Newton's method kept between bounds finds the root to the last bits.
fn stiffening_after(
    node: &CompressedNode,
    (law, w): (NormalLaw, f64),
    c: f64,
    yielding: f64,
) -> f64 {
    let (before, free) = (node.before, node.free);
    let closed = before.max(0.0);
    let force = |after: f64| w * law.mean_pressure(before, after) + c * (after.max(0.0) - closed);
    if force(free) <= 0.0 {
        return free;
    }
    // p_+ + y F(p_+) = p_free, with its slope 1 + y F'.
    let excess = |after: f64| after + yielding * force(after).max(0.0) - free;
    let slope = |after: f64| {
        let way = after - before;
        let change = law.pressure(after.max(0.0)) - law.mean_pressure(before, after);
        let is_far = way.abs() > 1e-6 * (before.abs() + after.abs());
        let rise = if is_far { change / way } else { 0.5 * law.stiffness(after.max(0.0)) };
        1.0 + yielding * (w * rise + c)
    };

    // Bounds, of which the upper one may be far beyond.
    let (mut lower, mut upper) = (before.min(free), free);
    let mut step = (upper - lower).max(f64::EPSILON * free.abs());
    while excess(lower) > 0.0 {
        upper = lower;
        lower -= step;
        step *= 2.0;
    }
    let (mut after, mut moved) = (lower, upper - lower);
    let round_off = 2.0 * f64::EPSILON * before.abs().max(free.abs());
    for _ in 0..NEWTON_STEPS {
        let value = excess(after);
        *if value > 0.0 { &mut upper } else { &mut lower } = after;
        let mut next = after - value / slope(after);
        // Beyond the bounds, or far up an exponential, where the steps do not shrink.
        let is_slow = 2.0 * (next - after).abs() > moved;
        if !(next >= lower && next <= upper) || is_slow {
            next = 0.5 * (lower + upper);
        }
        moved = (next - after).abs();
        after = next;
        if moved <= round_off {
            break;
        }
    }
    after
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spring(law: NormalLaw, share: f64, damping: f64) -> Spring {
        Spring { law, share, damping, compression: 0.0, dissipation: 0.0 }
    }

    /// Theory: the force obeys its own equation, and spring, dashpot and work of the force close their balance, through
    /// closing, opening and dashpots that let go.
    #[test]
    fn force_motion_and_energy_of_a_node_agree_whatever_its_status() {
        let (dt, mass) = (1e-7, 1e-3);
        let mut seen = [false; 5];
        for stiffness in [1e8, 5e9, 1e13] {
            for damping in [0.0, 2e3] {
                let mut contact = spring(NormalLaw::linear(stiffness), 1.0, damping);
                for before in [-1e-6, -1e-8, 0.0, 1e-8, 1e-6] {
                    for free in [-2e-6, -1e-8, 1e-9, 3e-8, 2e-6] {
                        let node = CompressedNode { mass, before, free };
                        let force = contact.force(&node, dt);
                        let after = free - 0.5 * dt * dt / mass * force;
                        let energy = contact.energy(after) - contact.energy(before);
                        let work = force * (after - before);
                        let lost = dt * contact.dissipation;
                        // A few roundings of positions of the size of both.
                        let size = before.abs().max(free.abs());
                        let scale = work.abs() + stiffness * size * size * 1e-2;
                        assert!((work - energy - lost).abs() < 1e-11 * scale, "{node:?}");
                        assert!(force >= 0.0 && lost >= -1e-12 * scale);
                        let case = match (before > 0.0, after > 0.0, force > 0.0) {
                            (_, _, false) if before > 0.0 => 4,
                            (false, false, _) => 0,
                            (false, true, _) => 1,
                            (true, false, _) => 2,
                            (true, true, _) => 3,
                        };
                        seen[case] = true;
                    }
                }
            }
        }
        assert_eq!(seen, [true; 5]);
    }

    /// Theory: the same of laws that stiffen, whose energy is that of the law: nothing is won or lost over a step.
    #[test]
    fn stiffening_contact_closes_its_balance_at_every_step() {
        let laws = [
            NormalLaw::Cubic { stiffness: 1e13, cubic_stiffness: 1e26 },
            NormalLaw::Exponential { reference_pressure: 1e5, height: 5e-8 },
        ];
        let (dt, mass, share) = (1e-7, 1e-3, 7e-4);
        for law in laws {
            for damping in [0.0, 2e3] {
                let mut contact = spring(law, share, damping);
                for before in [-1e-6, -1e-8, 0.0, 1e-8, 3e-7, 1e-6] {
                    for free in [-2e-6, -1e-8, 1e-9, 3e-8, 2e-6, 1e-3] {
                        let node = CompressedNode { mass, before, free };
                        let force = contact.force(&node, dt);
                        let after = free - 0.5 * dt * dt / mass * force;
                        let energy = contact.energy(after) - contact.energy(before);
                        let work = force * (after - before);
                        let lost = dt * contact.dissipation;
                        // Positions are rounded by the size of both, energies by the stiffness there.
                        let size = before.abs().max(free.abs());
                        let spring = share * law.stiffness(before.max(after).max(0.0));
                        let rounded = 1e-15 * size * (spring * size + force);
                        assert!((work - energy - lost).abs() < 16.0 * rounded, "{law:?} {node:?}");
                        assert!(force >= 0.0 && lost >= -16.0 * rounded);
                    }
                }
            }
        }
    }
}
