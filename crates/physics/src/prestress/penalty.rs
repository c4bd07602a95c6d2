//! Bodies on the springs of their contact points: sparse, for many thousands of points.

use super::joined_points::JoinedPoints;
use super::pressed_state::{ContactState, PressedBodies, Pressing, SHORT_RANGE, widened};
use super::{PrestressError, Result};
use crate::contact::Row;
use crate::linalg::dense::{add, difference, norm};
use crate::linalg::{LinearFamily, Mat, SparseLu};

/// Stiffness of an open point beside a pressed one in the matrix that is factorized: bodies may be held by contact alone.
const OPEN_SHARE: f64 = 1e-6;

/// Products after which another matrix is factorized, and the share of points that differ from it.
const MOST_PRODUCTS: usize = 30;
const MOST_CHANGED: f64 = 0.1;

/// Unknowns along normals up to which the columns of `P^-1` of all of them are held, once a share of as many was solved for one by one:
/// together they cost that much. And products after which another matrix is factorized then.
const MOST_HELD: usize = 4000;
const AT_ONCE: usize = 4;
const MOST_HELD_PRODUCTS: usize = 150;

/// Tangents of contact that stiffens that are tried, and the change of a force, over the largest, at which they have settled.
const MOST_TANGENTS: usize = 60;
const SETTLED: f64 = 1e-11;

/// Residual of the penetrations, over those without friction: as small as rounding lets it become, for polynomials over a short range of
/// friction magnify it by up to a million.
const TOLERANCE: f64 = 1e-16;

/// Points through which the polynomial of a state goes, in a short range between two changes of the pressed points and in a
/// longer one: about `2 (range / 6)^n` is left out, as the state has poles beyond friction 1.
const NODES: [usize; 2] = [6, 8];

/// Bodies whose contact points have springs `k_i`.
///
/// Pressed points push with `N_i = k_i (p_i - c_i)`, `c_i = n_i . u`, `p_i` the push, open ones not at all:
///
/// ```text
/// K u = f + sum_i N_i (n_i + mu drag_i t_i)
/// ```
///
/// With `P = K + sum r_i k_i n_i n_i^T`, symmetric and factorized once for a set of pressed points (`r_i` is one, and small at
/// open points), what moves along normals alone is unknown, `d`, from where loads and pushes alone have it, `d_0`:
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
/// Contact that stiffens, `N_i = w_i p(p_i - c_i)`, is linear about the force found last, with the stiffness of its tangent
/// there and the push with which that passes through it: Newton's iteration on the approach as a function of the force, which
/// is concave, so that no step runs away.
pub(super) struct PenaltyContact<'a> {
    points: JoinedPoints<'a>,
    /// `k_i`, N/m, and `p_i`, m: of the tangent where contact stiffens.
    springs: Vec<f64>,
    pushed: Vec<f64>,
    /// `P`, the points pressed in it, and `r_i k_i` in it, N/m.
    solver: SparseLu,
    factorized: Vec<bool>,
    held: Vec<f64>,
    /// Columns of `P^-1` at the contact, once those solved for alone, `asked`, are many.
    columns: Option<Mat<f64>>,
    asked: usize,
    /// Whether the last solution took too long.
    is_slow: bool,
    /// What moved along normals in the state found last.
    last: Vec<f64>,
    systems: Option<Systems>,
}

/// The systems of the springs as they are and of a set of pressed points: `d_0`, `y_0`, and those of what friction and `E` do beside.
struct Systems {
    is_pressed: Vec<bool>,
    unmoved: Vec<f64>,
    free: Vec<f64>,
    family: LinearFamily,
}

impl<'a> PenaltyContact<'a> {
    /// Bodies on springs at all their points; `None` where a point is rigid.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] where a body is held by nothing, not even by contact.
    pub fn new(pressing: &'a Pressing<'a>) -> Result<Option<Self>> {
        let springs: Option<Vec<f64>> = pressing.stiffnesses.iter().copied().collect();
        let Some(springs) = springs else {
            return Ok(None);
        };
        let points = JoinedPoints::new(pressing);
        Ok(Some(Self {
            last: Vec::new(),
            pushed: pressing.pushed.clone(),
            held: springs.clone(),
            solver: points.factorize(&springs)?,
            factorized: vec![true; springs.len()],
            points,
            springs,
            columns: None,
            asked: 0,
            is_slow: false,
            systems: None,
        }))
    }

    /// Factorizes `P` of other pressed points where they differ too much from those in it, or the last solution took long.
    fn follow(&mut self, is_pressed: &[bool]) -> Result<()> {
        let changed = is_pressed.iter().zip(&self.factorized).filter(|(a, b)| a != b).count();
        let is_far = changed as f64 > MOST_CHANGED * is_pressed.len() as f64;
        let is_far = is_far && self.columns.is_none();
        let shares = is_pressed.iter().zip(&self.springs);
        let held: Vec<f64> = shares
            .map(|(&is_pressed, spring)| if is_pressed { *spring } else { OPEN_SHARE * spring })
            .collect();
        if is_far || self.is_slow && held != self.held {
            self.solver = self.points.factorize(&held)?;
            self.factorized = is_pressed.to_vec();
            self.held = held;
            (self.columns, self.systems) = (None, None);
        }
        let own = &self.points.along_normals;
        if self.columns.is_none() && self.asked > own.len() / AT_ONCE && own.len() <= MOST_HELD {
            let rows: Vec<Row> = own.dofs.iter().map(|&unknown| vec![(unknown, 1.0)]).collect();
            self.columns = Some(self.points.columns(&self.solver, &rows));
        }
        Ok(())
    }

    /// Separations and normal forces on the springs as they are, and what moves along normals.
    fn linear_state(&mut self, friction_coefficient: f64, is_pressed: &[bool]) -> [Vec<f64>; 3] {
        let known = self.systems.take().filter(|systems| systems.is_pressed == is_pressed);
        let Self { points, springs, held, solver, columns, .. } = &*self;
        let pressed = |values: &[f64]| -> Vec<f64> {
            let both = values.iter().zip(is_pressed);
            both.map(|(value, is_pressed)| if *is_pressed { *value } else { 0.0 }).collect()
        };
        let (own, origin) = (pressed(springs), pressed(&self.pushed)); // s k and s p.
        let along = |own: &dyn Fn(usize) -> [f64; 2]| (0..springs.len()).map(own).collect();
        // P^-1 times ((s - r) n + mu s drag t) k y, the part with mu by itself.
        let apart = |y: &[f64]| {
            let parts =
                [along(&|i| [(own[i] - held[i]) * y[i], 0.0]), along(&|i| [0.0, own[i] * y[i]])];
            points.moved_under((solver, columns.as_ref()), &parts)
        };
        // What the loads and the pushes alone do: d_0 of f + sum_i r_i k_i s_i p_i n_i, y_0, and -P^-1 E y_0.
        let mut systems = known.unwrap_or_else(|| {
            let pushes = along(&|i| [held[i] * origin[i], 0.0]);
            let unmoved = points.along_normals.restrict(&points.respond(solver, pushes));
            let free = difference(&points.separations_of(&unmoved), &origin);
            let mut sides = apart(&free);
            sides.iter_mut().flatten().for_each(|value| *value = -*value);
            let scale = norm(&free) * (unmoved.len() as f64 / free.len() as f64).sqrt();
            let family = LinearFamily::new(sides, scale);
            Systems { is_pressed: is_pressed.to_vec(), unmoved, free, family }
        });

        // With what `P` has not: (1 + P^-1 E n) d = -P^-1 E y_0, y = y_0 + n . d.
        let apply = |moved: &[f64]| {
            let mut found = apart(&points.separations_of(moved));
            add(&mut found[0], 1.0, moved);
            found
        };
        let start = match self.last.is_empty() {
            true => Vec::new(),
            false => difference(&self.last, &systems.unmoved),
        };
        let (mut moved, products) =
            systems.family.solve(friction_coefficient, &start, apply, TOLERANCE);
        let mut y = points.separations_of(&moved);
        add(&mut y, 1.0, &systems.free);
        // N = s k (p - c) = - s k y, and c = s p + y; 0 - 0 has no sign.
        let forces = own.iter().zip(&y).map(|(spring, y)| 0.0 - spring * y).collect();
        let separations = origin.iter().zip(&y).map(|(p, y)| p + y).collect();
        let most = [MOST_PRODUCTS, MOST_HELD_PRODUCTS][usize::from(columns.is_some())];
        (self.is_slow, self.asked) = (products > most, self.asked + 2 * products);
        add(&mut moved, 1.0, &systems.unmoved);
        self.systems = Some(systems);
        [separations, forces, moved]
    }

    /// Springs and pushes of the tangents at some forces; whether any contact stiffens.
    fn follow_laws(&mut self, normal_forces: &[f64]) -> bool {
        let (pressing, mut stiffens) = (self.points.pressing, false);
        for (i, (law, point)) in pressing.laws.iter().zip(pressing.points).enumerate() {
            if let Some(law) = law {
                stiffens = true;
                let force = normal_forces[i].max(0.0);
                // The tangent N = k (p' - c) at the approach g of the force, p' = p - g + N / k.
                let approach = law.approach(force / point.weight);
                self.springs[i] = point.weight * law.stiffness(approach);
                self.pushed[i] = pressing.pushed[i] - approach + force / self.springs[i];
            }
        }
        self.systems.take_if(|_| stiffens); // Other springs are another family.
        stiffens
    }
}

impl PressedBodies for PenaltyContact<'_> {
    fn pressing(&self) -> &Pressing<'_> {
        self.points.pressing
    }

    fn stiffness_at(&self, point: usize) -> f64 {
        self.springs[point]
    }

    fn usual_points(&self, [lower, upper]: [f64; 2]) -> ([f64; 2], usize) {
        (widened([lower, upper]), NODES[usize::from(upper - lower > SHORT_RANGE)])
    }

    fn state_of(&mut self, friction_coefficient: f64, is_pressed: &[bool]) -> Result<ContactState> {
        let mut before: Option<Vec<f64>> = None;
        for _ in 0..MOST_TANGENTS {
            self.follow(is_pressed)?;
            let [separations, normal_forces, moved] =
                self.linear_state(friction_coefficient, is_pressed);
            let is_linear = !self.follow_laws(&normal_forces);
            let largest = normal_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            // Newton's method: settled where the forces are those of the tangents' own places.
            let is_settled = before.as_ref().is_some_and(|before| {
                let moved = before.iter().zip(&normal_forces).map(|(a, b)| (a - b).abs());
                moved.fold(0.0, f64::max) <= SETTLED * largest
            });
            if is_linear || is_settled {
                return Ok(ContactState {
                    separations,
                    normal_forces,
                    stiffnesses: (!is_linear).then(|| self.springs.clone()),
                });
            }
            (before, self.last) = (Some(normal_forces), moved);
        }
        Err(PrestressError::NoState { friction_coefficient })
    }

    fn whole_displacement(&self, friction_coefficient: f64, state: &ContactState) -> Vec<f64> {
        self.points.displacement((&self.solver, &self.held), friction_coefficient, state)
    }
}
