//! Bodies on their contact points: sparse, for many thousands of points.

use super::joined_points::{Inverse, JoinedPoints};
use super::pressed_state::{ContactState, Pressing};
use super::{PrestressError, Result};
use crate::contact::{NormalLaw, Point};
use crate::linalg::LinearFamily;
use crate::linalg::dense::{add, difference, norm};
use std::collections::BTreeSet;

/// Stiffness of an open point beside a pressed one in the matrix that is factorized: bodies may be held by contact alone.
const OPEN_SHARE: f64 = 1e-6;

/// Stiffness of contact over that of the bodies from which on digits of `p_i - c_i` would be lost.
const FAR_STIFFER: f64 = 1e3;

/// Unknowns along normals up to which the columns of `P^-1` of all of them are held, once a share of as many was solved for one by one:
/// together they cost that much. Until then, and of more, products after which another matrix is factorized.
const MOST_HELD: usize = 4000;
const AT_ONCE: usize = 4;
const MOST_PRODUCTS: usize = 30;
/// Products after which that is done at once, and those with it.
const ENOUGH: usize = 100;
const AT_MOST: usize = 1000;

/// Points for each pressed one beyond which a state has a matrix of its own: bodies that few points hold magnify rounding near jamming.
const FEW_PRESSED: usize = 4;

/// Tangents of contact that stiffens that are tried, and the change of a force, over the largest, at which they have settled; that from
/// which on changes that fall no more are round-off.
const MOST_TANGENTS: usize = 60;
const SETTLED: f64 = 1e-11;
const NEARLY: f64 = 1e-6;

/// Residual of the penetrations, over those without friction: as small as rounding lets it become, for polynomials over a short range of
/// friction magnify it by up to a million.
const TOLERANCE: f64 = 1e-16;

/// Bodies whose contact points have springs `k_i`.
///
/// Pressed points push with `N_i = k_i (p_i - c_i)`, `c_i = n_i . u`, `p_i` the push, open ones not at all:
///
/// ```text
/// K u = f + sum_i N_i (n_i + mu drag_i t_i)
/// ```
///
/// With `P = K + sum r_i k_i n_i n_i^T`, symmetric and factorized once for a set of pressed points (`r_i` is one, and small at
/// open points), what moves along normals alone is unknown, `d`, from where it is without forces on, `d_0`:
///
/// ```text
/// d_0 = P^-1 (f + sum_i r_i k_i s_i p_i n_i),   y_0 = n . d_0 - s p,   c_i = s_i p_i + y_i,   y = y_0 + n . d
/// d + P^-1 E (n . d) = -P^-1 E y_0
/// E y = sum_i ((s_i - r_i) n_i + mu s_i drag_i t_i) k_i y_i,     s_i = 1 where pressed, else 0
/// ```
///
/// a system near the identity, as friction and the points that changed since are small beside `P`. Friction is in the matrix alone:
/// the systems of a set of pressed points share one space.
///
/// Of far stiffer contact `p_i - c_i` would be a small difference, that of rigid contact zero. It has `N_i = -k_i y_i` with another `k_i`:
/// that of the bodies leaves no digits lost. Then `y` itself is unknown:
///
/// ```text
/// e y + n . P^-1 E y = n . d_0 - s p,   c_i = s_i p_i + e_i y_i,   e_i = k_i over its own stiffness where pressed, else 1
/// E y = sum_i ((s_i - e_i r_i) n_i + mu s_i drag_i t_i) k_i y_i
/// ```
///
/// Contact that stiffens, `N_i = w_i p(p_i - c_i)`, is linear about the force found last, with the stiffness of its tangent
/// there and the push with which that passes through it: Newton's iteration on the approach as a function of the force, which
/// is concave, so that no step runs away.
pub(super) struct ContactSystem<'a> {
    points: JoinedPoints<'a>,
    /// Stiffness of the bodies at each point, that of its contact and `k_i`, N/m, and `p_i`, m: of the tangent where contact stiffens;
    /// whether there are more springs than unknowns that they move.
    bodies: Vec<f64>,
    are_many: bool,
    springs: Vec<f64>,
    even: Vec<f64>,
    pushed: Vec<f64>,
    /// `P^-1` with `r_i k_i` in it, and how many of its columns were solved for one by one.
    inverse: Inverse,
    asked: usize,
    /// Whether the last solution took too long.
    is_slow: bool,
    /// What moved along normals in the state found last.
    last: Vec<f64>,
    systems: Option<Systems>,
}

/// The systems of the springs as they are and of a set of pressed points, from `d_0` and `y_0` on.
struct Systems {
    is_pressed: Vec<bool>,
    unmoved: Vec<f64>,
    free: Vec<f64>,
    family: LinearFamily,
}

/// `k_i` of a contact on bodies of some stiffness, N/m. Forces of more springs than unknowns that they move depend on each other: the
/// motion is unknown then.
fn even(spring: f64, bodies: f64, are_many: bool) -> f64 {
    let is_own = are_many && spring.is_finite();
    if spring > FAR_STIFFER * bodies && !is_own { bodies } else { spring }
}

/// What the equations of a set of pressed points are made of.
struct Equations<'a> {
    points: &'a JoinedPoints<'a>,
    inverse: &'a Inverse,
    /// `s k`, `(s - e r) k`, `s p` and `e`.
    own: Vec<f64>,
    normal: Vec<f64>,
    origin: Vec<f64>,
    yields: Vec<f64>,
    is_stiff: bool,
}

impl Equations<'_> {
    /// `P^-1 E y` along normals, the part with `mu` by itself.
    fn moved(&self, y: &[f64]) -> Vec<Vec<f64>> {
        let fixed = self.normal.iter().zip(y).map(|(k, y)| [k * y, 0.0]).collect();
        let moving = self.own.iter().zip(y).map(|(k, y)| [0.0, k * y]).collect();
        self.points.moved_under(self.inverse, &[fixed, moving])
    }

    /// `n . d`; what is unknown with stiff contact is `y`.
    fn lifted(&self, x: &[f64]) -> Vec<f64> {
        if self.is_stiff { x.to_vec() } else { self.points.separations(x) }
    }

    /// What is unknown, `x`, in the equations: `d + P^-1 E (n . d)`, or `e y + n . P^-1 E y`.
    fn apply(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let mut found = self.moved(&self.lifted(x));
        if self.is_stiff {
            found.iter_mut().for_each(|own| *own = self.points.separations(own));
            found[0].iter_mut().zip(x).zip(&self.yields).for_each(|((own, x), e)| *own += e * x);
        } else {
            add(&mut found[0], 1.0, x);
        }
        found
    }
}

impl<'a> ContactSystem<'a> {
    /// # Errors
    /// [`PrestressError::Singular`] where a body is held by nothing, not even by contact.
    pub fn new(pressing: &'a Pressing<'a>) -> Result<Self> {
        let points = JoinedPoints::new(pressing);
        let spring = |(law, point): (&Option<NormalLaw>, &Point)| match law {
            Some(law) => point.weight * law.stiffness(0.0), // Without pressure where it stiffens.
            None => f64::INFINITY,
        };
        let springs: Vec<f64> = pressing.laws.iter().zip(pressing.points).map(spring).collect();
        let of_springs = points.normals.iter().zip(&springs).filter(|own| own.1.is_finite());
        let moved = of_springs.clone().flat_map(|own| own.0).map(|own| own.0);
        let are_many = of_springs.count() > moved.collect::<BTreeSet<usize>>().len();
        let bodies: Vec<f64> = points.own_stiffnesses().collect();
        let pairs = springs.iter().zip(&bodies);
        let even: Vec<f64> = pairs.map(|(k, own)| even(*k, *own, are_many)).collect();
        Ok(Self {
            last: Vec::new(),
            pushed: pressing.pushed.clone(),
            inverse: points.factorize(even.clone())?,
            points,
            bodies,
            are_many,
            springs,
            even,
            asked: 0,
            is_slow: false,
            systems: None,
        })
    }

    /// What presses the bodies together.
    pub fn pressing(&self) -> &'a Pressing<'a> {
        self.points.pressing
    }

    /// What the bodies would take where they are pushed in if nothing else gave way, N.
    pub fn push(&self) -> f64 {
        self.bodies.iter().zip(&self.points.pressing.pushed).map(|(k, push)| k * push.abs()).sum()
    }

    /// Stiffness against the penetration of a point, N/m.
    pub fn stiffness_at(&self, point: usize) -> f64 {
        self.even[point]
    }

    /// Factorizes `P` of other pressed points where the last solution took long, or holds its columns. Of many springs that are far stiffer
    /// it is that of the pressed points: what the others have in it, taken off again, would leave few digits of `p_i - c_i`.
    fn follow(&mut self, is_pressed: &[bool]) -> Result<()> {
        let is_far = |(k, own): (&f64, &f64)| k.is_finite() && *k > FAR_STIFFER * own;
        if self.are_many && self.springs.iter().zip(&self.bodies).any(is_far) {
            return self.factorize(is_pressed);
        }
        let most = self.points.along_normals.len();
        let has_many = self.asked > most / AT_ONCE && most <= MOST_HELD;
        if self.inverse.columns.is_none() && has_many {
            self.points.hold_columns(&mut self.inverse);
        } else if self.inverse.columns.is_none() && self.is_slow {
            self.factorize(is_pressed)?;
        }
        Ok(())
    }

    /// Factorizes `P` of a set of pressed points whose state becomes a polynomial, if they are few.
    pub fn begin(&mut self, is_pressed: &[bool]) -> Result<()> {
        let pressed = is_pressed.iter().filter(|is_pressed| **is_pressed).count();
        if FEW_PRESSED * pressed < is_pressed.len() { self.factorize(is_pressed) } else { Ok(()) }
    }

    /// Factorizes `P` of these pressed points.
    fn factorize(&mut self, is_pressed: &[bool]) -> Result<()> {
        let mut held = self.even.clone();
        held.iter_mut().zip(is_pressed).filter(|own| !own.1).for_each(|own| *own.0 *= OPEN_SHARE);
        if held != self.inverse.springs {
            self.inverse = self.points.factorize(held)?;
            (self.systems, self.asked) = (None, 0);
        }
        Ok(())
    }

    /// Separations and normal forces on the springs as they are, and what moves along normals; none where `most` products are too few.
    fn linear_state(&mut self, mu: f64, set: &[bool], most: usize) -> Option<[Vec<f64>; 3]> {
        let known = self.systems.take().filter(|systems| systems.is_pressed == set);
        let equations = self.equations(set);
        let Equations { own, origin, yields, .. } = &equations;
        let mut systems = known.unwrap_or_else(|| self.systems_of(&equations, set));
        let apply = |x: &[f64]| equations.apply(x);
        let (mut moved, products) = systems.family.solve(mu, apply, (TOLERANCE, most))?;
        let mut y = equations.lifted(&moved);
        add(&mut y, 1.0, &systems.free);
        // N = - s k y, and c = s p + e y; 0 - 0 has no sign.
        let forces = own.iter().zip(&y).map(|(spring, y)| 0.0 - spring * y).collect();
        let separations = (0..y.len()).map(|i| origin[i] + yields[i] * y[i]).collect();
        if equations.is_stiff {
            moved.clear(); // It is no displacement.
        }
        add(&mut moved, 1.0, &systems.unmoved);
        (self.is_slow, self.asked) = (products > MOST_PRODUCTS, self.asked + 2 * products);
        self.systems = Some(systems);
        Some([separations, forces, moved])
    }

    /// The equations of a set of pressed points.
    fn equations(&self, is_pressed: &[bool]) -> Equations<'_> {
        let pressed = |values: &[f64]| -> Vec<f64> {
            let both = values.iter().zip(is_pressed);
            both.map(|(value, is_pressed)| if *is_pressed { *value } else { 0.0 }).collect()
        };
        let yields = |i: usize| if is_pressed[i] { self.even[i] / self.springs[i] } else { 1.0 };
        let (own, yields) = (pressed(&self.even), (0..is_pressed.len()).map(yields));
        let yields: Vec<f64> = yields.collect();
        Equations {
            points: &self.points,
            inverse: &self.inverse,
            normal: (0..own.len()).map(|i| own[i] - yields[i] * self.inverse.springs[i]).collect(),
            own,
            origin: pressed(&self.pushed),
            yields,
            is_stiff: self.even != self.springs,
        }
    }

    /// The systems of a set of pressed points.
    fn systems_of(&self, equations: &Equations<'_>, is_pressed: &[bool]) -> Systems {
        let (points, origin, is_pressed) = (&self.points, &equations.origin, is_pressed.to_vec());
        let pushes = self.inverse.springs.iter().zip(origin);
        let pushes: Vec<[f64; 2]> = pushes.map(|(k, push)| [k * push, 0.0]).collect();
        let loaded = points.along_normals.restrict(&points.respond(&self.inverse, &pushes)); // d_0.
        if equations.is_stiff {
            let left = difference(&points.separations(&loaded), origin);
            let (none, scale) = (vec![0.0; origin.len()], norm(&left));
            let family = LinearFamily::new(vec![left, none.clone()], scale);
            return Systems { is_pressed, unmoved: none.clone(), free: none, family };
        }
        // From the state found last where contact stiffens: what is left of the equations there.
        let unmoved = if self.last.is_empty() { loaded.clone() } else { self.last.clone() };
        let free = difference(&points.separations(&unmoved), origin); // y_0.
        let mut sides = equations.moved(&free);
        sides.iter_mut().flatten().for_each(|value| *value = -*value);
        add(&mut sides[0], 1.0, &difference(&loaded, &unmoved));
        let scale = norm(&free) * (unmoved.len() as f64 / free.len() as f64).sqrt();
        Systems { is_pressed, unmoved, free, family: LinearFamily::new(sides, scale) }
    }

    /// Springs and pushes of the tangents at some forces; whether any contact stiffens.
    fn follow_laws(&mut self, normal_forces: &[f64]) -> bool {
        let (pressing, mut stiffens) = (self.points.pressing, false);
        for (i, (law, point)) in pressing.laws.iter().zip(pressing.points).enumerate() {
            if let Some(law) = law.filter(|law| *law != NormalLaw::linear(law.stiffness(0.0))) {
                stiffens = true;
                let force = normal_forces[i].max(0.0);
                // The tangent N = k (p' - c) at the approach g of the force, p' = p - g + N / k.
                let approach = law.approach(force / point.weight);
                self.springs[i] = point.weight * law.stiffness(approach);
                self.even[i] = even(self.springs[i], self.bodies[i], self.are_many);
                self.pushed[i] = pressing.pushed[i] - approach + force / self.springs[i];
            }
        }
        self.systems.take_if(|_| stiffens); // Other springs are another family.
        stiffens
    }

    /// The state in which exactly the points of `is_pressed` touch, whatever sign their forces have.
    ///
    /// # Errors
    /// [`PrestressError::NoState`] where none is found, [`PrestressError::Singular`].
    pub fn state_of(
        &mut self,
        friction_coefficient: f64,
        is_pressed: &[bool],
    ) -> Result<ContactState> {
        let (mut before, mut last) = (None::<Vec<f64>>, f64::INFINITY); // Forces, and their change.
        for _ in 0..MOST_TANGENTS {
            self.follow(is_pressed)?;
            let mut found = self.linear_state(friction_coefficient, is_pressed, ENOUGH);
            if found.is_none() {
                self.factorize(is_pressed)?; // Other points were pressed where that was done last.
                found = self.linear_state(friction_coefficient, is_pressed, AT_MOST);
            }
            let [separations, normal_forces, moved] =
                found.ok_or(PrestressError::NoState { friction_coefficient })?;
            let is_linear = !self.follow_laws(&normal_forces);
            let largest = normal_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            // Newton's method: settled where the forces are those of the tangents' own places, or move by round-off alone.
            let change = before.as_ref().map_or(f64::INFINITY, |before| {
                let moved = before.iter().zip(&normal_forces).map(|(a, b)| (a - b).abs());
                moved.fold(0.0, f64::max)
            });
            if is_linear || change <= largest * if change < 0.5 * last { SETTLED } else { NEARLY } {
                let pairs = self.springs.iter().zip(&self.even);
                let finite = pairs.map(|(own, even)| if own.is_finite() { *own } else { *even });
                return Ok(ContactState {
                    separations,
                    normal_forces,
                    stiffnesses: (!is_linear).then(|| finite.collect()),
                });
            }
            (before, last, self.last) = (Some(normal_forces), change, moved);
        }
        Err(PrestressError::NoState { friction_coefficient })
    }

    /// Displacement of every dof from the state of the contact points.
    pub fn whole_displacement(&self, friction_coefficient: f64, state: &ContactState) -> Vec<f64> {
        self.points.displacement(&self.inverse, friction_coefficient, state)
    }
}
