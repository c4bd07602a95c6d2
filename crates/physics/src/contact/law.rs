//! Coulomb's law of friction, and the status that it gives a contact node.

/// Status of a contact node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum ContactStatus {
    /// No contact.
    #[default]
    Open = 0,
    /// In contact, moving with the counterface.
    Stick = 1,
    /// In contact, sliding over the counterface.
    Slip = 2,
}

impl ContactStatus {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Stick => "stick",
            Self::Slip => "slip",
        }
    }
}

/// How friction falls with the slip speed `v`: `mu(v) / mu = 1 + (q - 1) exp(-|v| / v_c)`.
///
/// `mu` is the kinetic coefficient at high speed, `q mu` the static one. Nothing but the speed of the moment enters:
/// no memory, no time of rest.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct FrictionDecay {
    /// `q`, 1 or more.
    pub static_ratio: f64,
    /// `v_c`, m/s.
    pub decay_speed: f64,
}

impl FrictionDecay {
    /// `mu(v) / mu`.
    pub fn share(&self, slip_speed: f64) -> f64 {
        1.0 + self.excess(1.0, slip_speed)[0]
    }

    /// Largest fall of `mu(v) / mu` with `|v|`, s/m.
    pub fn steepest_fall(&self) -> f64 {
        -self.excess(1.0, 0.0)[1]
    }

    /// `c (mu(v) / mu - 1)` with its first two derivatives with respect to `|v|`: it falls, and is convex.
    fn excess(&self, c: f64, slip_speed: f64) -> [f64; 3] {
        let v_c = self.decay_speed;
        let excess = c * ((self.static_ratio - 1.0) * (-slip_speed.abs() / v_c).exp());
        [excess, -excess / v_c, excess / (v_c * v_c)]
    }

    /// The slip `w >= 0` at which `w + c mu(w) / mu` is least, m/s: zero where it rises everywhere.
    fn least(&self, c: f64) -> f64 {
        let fall = c * (self.static_ratio - 1.0) / self.decay_speed;
        self.decay_speed * fall.max(1.0).ln()
    }
}

/// Friction of steady sliding for each unit of friction coefficient and of normal force.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SteadyFriction {
    /// `s mu(V) / mu`: the drag of the counterface, `s` its sense.
    pub drag: f64,
    /// `mu'(V) / mu`, s/m: with the normal force a dashpot on the body's velocity, negative where friction falls.
    pub slope: f64,
}

impl SteadyFriction {
    /// That of a law at the speed `V`, `s = 1`.
    pub fn at(law: Option<FrictionDecay>, speed: f64) -> Self {
        let [excess, slope, _] = law.map_or([0.0; 3], |law| law.excess(1.0, speed));
        Self { drag: 1.0 + excess, slope }
    }
}

/// Coulomb's law `|T| <= mu(0) N` of a node that sticks, `T = mu(v) N` against the slip of one that slips at `v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoulombFriction {
    /// Friction coefficient `mu`, at high speed.
    pub friction_coefficient: f64,
    /// How friction falls with the slip speed; `None` is a constant coefficient.
    pub decay: Option<FrictionDecay>,
}

/// A contact node whose tangential motion friction is to decide within one time step: along a line or, as vectors along the sliding
/// and across it, over a surface.
#[derive(Clone, Copy, Debug)]
pub struct Slipping<V> {
    /// Tangential force that changes its velocity by one within the step, `m / dt`, N s/m2 (N s/m of a surface).
    pub inertia: f64,
    /// Slip velocity `V - v_t` that it would reach without friction, m/s.
    pub free_slip: V,
    /// Slip velocity half a step ago, m/s.
    pub slip_before: V,
}

/// What friction does to a contact node within one time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction<V> {
    /// Tangential force on the body, N/m (N of a surface).
    pub force: V,
    /// Whether it sticks or slips.
    pub status: ContactStatus,
    /// Whether both would have obeyed the law: friction falls faster than the node's inertia allows.
    pub is_ambiguous: bool,
}

impl<V> Friction<V> {
    /// The same with another force.
    #[inline(always)]
    pub fn with<W>(self, force: W) -> Friction<W> {
        Friction { force, status: self.status, is_ambiguous: self.is_ambiguous }
    }
}

/// Newton steps of one node at most; from the right of a convex function's root they cannot overshoot.
const NEWTON_STEPS: usize = 50;

impl CoulombFriction {
    /// Largest tangential force `mu N` under the normal force `normal`, N/m, of a constant coefficient.
    pub fn cone(&self, normal: f64) -> f64 {
        self.friction_coefficient * normal
    }

    /// The tangential force of a node that `trial` would make stick, and its status, under a constant coefficient: the
    /// projection of `trial` onto the cone.
    pub fn project(&self, trial: f64, normal: f64) -> (f64, ContactStatus) {
        let cone = self.cone(normal);
        let status = if trial.abs() <= cone { ContactStatus::Stick } else { ContactStatus::Slip };
        (trial.clamp(-cone, cone), status)
    }

    /// The tangential force under the normal force `normal` (N/m), implicit in the slip velocity `w` that it leads to:
    ///
    /// ```text
    /// T = (m / dt) (w* - w),   T = N mu(v) sign(v) where w != 0,   |T| <= N mu(0) where w = 0
    /// ```
    ///
    /// with `v` the mean of `w` and of the slip velocity half a step ago (second order in time, and the dissipation
    /// `T v` is the law's), or of `w` and zero where the node stuck or the slip turns round: both are one at rest, so
    /// that rounding of a node that stuck does not choose the law.
    ///
    /// `w* = free_slip`. With `c = N mu dt / m` slip solves `w + c mu(v) / mu = |w*|`, convex in `w` as the law is:
    /// monotone, with one root at most, where `N |mu'(0)| < m / dt`. Beyond that a node can obey the law in stick and
    /// in slip at once; it keeps to the side that it is on, and says so.
    pub fn resolve(&self, node: &Slipping<f64>, normal: f64) -> Friction<f64> {
        let (inertia, free) = (node.inertia, node.free_slip.abs());
        let sense = node.free_slip.signum();
        let Some(decay) = self.decay else {
            let (force, status) = self.project(inertia * node.free_slip, normal);
            return Friction { force, status, is_ambiguous: false };
        };
        let pull = self.cone(normal) / inertia;
        let value = |slip: f64| slip + pull * decay.share(slip) - free;
        // Left of where the function of slip is least no root is stable.
        let least = decay.least(pull);
        let may_stick = free <= pull * decay.static_ratio;
        let may_slip = !may_stick || (least > 0.0 && value(least) < 0.0);
        let is_slipping = node.slip_before * sense > least;
        if may_stick && !(may_slip && is_slipping) {
            return Friction {
                force: inertia * node.free_slip,
                status: ContactStatus::Stick,
                is_ambiguous: may_slip,
            };
        }
        // The mean velocity obeys the same equation with twice the inertia.
        let before = (node.slip_before * sense).max(0.0);
        let is_monotone = least == 0.0;
        let (inertia, free) =
            if is_monotone { (2.0 * inertia, 0.5 * (free + before)) } else { (inertia, free) };
        let pull = self.cone(normal) / inertia;
        let highest = free - pull;
        // From the last slip where the function is monotone, else from the right of its largest root.
        let mut slip = if is_monotone { before.min(highest).max(0.0) } else { highest };
        for _ in 0..NEWTON_STEPS {
            let [excess, fall, curvature] = decay.excess(pull, slip);
            let slope = 1.0 + fall;
            let step = (slip + pull + excess - free) / slope;
            slip = (slip - step).min(highest).max(least);
            // What is left is of second order.
            if curvature * step * step <= f64::EPSILON * free * slope {
                break;
            }
        }
        Friction {
            force: sense * inertia * (free - slip),
            status: ContactStatus::Slip,
            is_ambiguous: may_stick,
        }
    }
}
