//! Bodies on their contact points: sparse, for many thousands of points.

use super::joined_points::JoinedPoints;
use super::pressed_state::{
    ContactState, LEAST_RANGE, PressedBodies, Pressing, SHORT_RANGE, widened,
};
use super::{PrestressError, Result};
use crate::contact::Row;
use crate::linalg::dense::{add, difference, norm};
use crate::linalg::{LinearFamily, Mat, SparseLu};

/// Stiffness of an open point beside a pressed one in the matrix that is factorized: bodies may be held by contact alone.
const OPEN_SHARE: f64 = 1e-6;

/// Unknowns along normals up to which the columns of `P^-1` of all of them are held, once a share of as many was solved for one by one:
/// together they cost that much. Until then, and of more, products after which another matrix is factorized.
const MOST_HELD: usize = 4000;
const AT_ONCE: usize = 4;
const MOST_PRODUCTS: usize = 30;

/// Tangents of contact that stiffens that are tried, and the change of a force, over the largest, at which they have settled.
const MOST_TANGENTS: usize = 60;
const SETTLED: f64 = 1e-11;

/// Residual of the penetrations, over those without friction: as small as rounding lets it become, for polynomials over a short range of
/// friction magnify it by up to a million.
const TOLERANCE: f64 = 1e-16;

/// Points through which the polynomial of a state goes, in a short range between two changes of the pressed points and in a
/// longer one: about `2 (range / 6)^n` is left out, as the state has poles beyond friction 1.
const NODES: [usize; 2] = [6, 8];
/// The same from friction 0 on of rigid contact.
const RIGID_NODES: usize = 7;

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
/// Rigid contact, `c_i = p_i` where pressed, has `N_i = -k_i y_i` with any `k_i`; that about as stiff as the bodies leaves no digits lost.
/// Then `y` itself is unknown:
///
/// ```text
/// e y + n . P^-1 E y = n . d_0 - s p,   c_i = s_i p_i + e_i y_i,   e_i = 0 where rigid contact is pressed, else 1
/// E y = sum_i ((s_i - e_i r_i) n_i + mu s_i drag_i t_i) k_i y_i
/// ```
///
/// Contact that stiffens, `N_i = w_i p(p_i - c_i)`, is linear about the force found last, with the stiffness of its tangent
/// there and the push with which that passes through it: Newton's iteration on the approach as a function of the force, which
/// is concave, so that no step runs away.
pub(super) struct ContactSystem<'a> {
    points: JoinedPoints<'a>,
    /// Points without springs of their own, `e_i = 0` where they are pressed.
    is_rigid: Vec<bool>,
    /// `k_i`, N/m, and `p_i`, m: of the tangent where contact stiffens; about those of the bodies of rigid contact.
    springs: Vec<f64>,
    pushed: Vec<f64>,
    /// `P`, and `r_i k_i` in it, N/m.
    solver: SparseLu,
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

/// The systems of the springs as they are and of a set of pressed points, from `d_0` and `y_0` on.
struct Systems {
    is_pressed: Vec<bool>,
    unmoved: Vec<f64>,
    free: Vec<f64>,
    family: LinearFamily,
}

/// What the equations of a set of pressed points are made of.
struct Equations<'a> {
    points: &'a JoinedPoints<'a>,
    /// `P`, and columns of its inverse.
    inverse: (&'a SparseLu, Option<&'a Mat<f64>>),
    /// `s k`, `(s - e r) k`, `s p` and `e`.
    own: Vec<f64>,
    normal: Vec<f64>,
    origin: Vec<f64>,
    yields: Vec<f64>,
    has_rigid: bool,
}

impl Equations<'_> {
    /// `P^-1 E y` along normals, the part with `mu` by itself.
    fn moved(&self, y: &[f64]) -> Vec<Vec<f64>> {
        let fixed = self.normal.iter().zip(y).map(|(k, y)| [k * y, 0.0]).collect();
        let moving = self.own.iter().zip(y).map(|(k, y)| [0.0, k * y]).collect();
        self.points.moved_under(self.inverse, &[fixed, moving])
    }

    fn separations(&self, moved: &[f64]) -> Vec<f64> {
        self.points.separations(&self.points.along_normals.expand(moved))
    }

    /// `n . d`; what is unknown with rigid points is `y`.
    fn lifted(&self, x: &[f64]) -> Vec<f64> {
        if self.has_rigid { x.to_vec() } else { self.separations(x) }
    }

    /// What is unknown, `x`, in the equations: `d + P^-1 E (n . d)`, or `e y + n . P^-1 E y`.
    fn apply(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let mut found = self.moved(&self.lifted(x));
        if self.has_rigid {
            found.iter_mut().for_each(|own| *own = self.separations(own));
            found[0].iter_mut().zip(x).zip(&self.yields).for_each(|((own, x), e)| *own += e * x);
        } else {
            add(&mut found[0], 1.0, x);
        }
        found
    }
}

impl<'a> ContactSystem<'a> {
    /// Bodies on springs at all their points.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] where a body is held by nothing, not even by contact.
    pub fn new(pressing: &'a Pressing<'a>) -> Result<Self> {
        let points = JoinedPoints::new(pressing);
        let own = pressing.stiffnesses.iter().zip(points.own_stiffnesses());
        let springs: Vec<f64> = own.map(|(given, own)| given.unwrap_or(own)).collect();
        let is_rigid = pressing.stiffnesses.iter().map(Option::is_none).collect();
        Ok(Self {
            last: Vec::new(),
            pushed: pressing.pushed.clone(),
            held: springs.clone(),
            solver: points.factorize(&springs)?,
            points,
            springs,
            columns: None,
            asked: 0,
            is_slow: false,
            systems: None,
            is_rigid,
        })
    }

    /// Factorizes `P` of other pressed points where the last solution took long, or holds its columns.
    fn follow(&mut self, is_pressed: &[bool]) -> Result<()> {
        let shares = is_pressed.iter().zip(&self.springs);
        let held: Vec<f64> = shares
            .map(|(&is_pressed, spring)| if is_pressed { *spring } else { OPEN_SHARE * spring })
            .collect();
        let own = &self.points.along_normals;
        if self.columns.is_some() {
            return Ok(());
        }
        if self.asked > own.len() / AT_ONCE && own.len() <= MOST_HELD {
            let rows: Vec<Row> = own.dofs.iter().map(|&unknown| vec![(unknown, 1.0)]).collect();
            self.columns = Some(self.points.columns(&self.solver, &rows));
        } else if self.is_slow && held != self.held {
            self.solver = self.points.factorize(&held)?;
            (self.held, self.systems) = (held, None);
        }
        Ok(())
    }

    /// Separations and normal forces on the springs as they are, and what moves along normals.
    fn linear_state(&mut self, friction_coefficient: f64, is_pressed: &[bool]) -> [Vec<f64>; 3] {
        let known = self.systems.take().filter(|systems| systems.is_pressed == is_pressed);
        let equations = self.equations(is_pressed);
        let Equations { own, origin, yields, .. } = &equations;
        let mut systems = known.unwrap_or_else(|| self.begin(&equations, is_pressed));
        let apply = |x: &[f64]| equations.apply(x);
        let (mut moved, products) = systems.family.solve(friction_coefficient, apply, TOLERANCE);
        let mut y = equations.lifted(&moved);
        add(&mut y, 1.0, &systems.free);
        // N = - s k y, and c = s p + e y; 0 - 0 has no sign.
        let forces = own.iter().zip(&y).map(|(spring, y)| 0.0 - spring * y).collect();
        let separations = (0..y.len()).map(|i| origin[i] + yields[i] * y[i]).collect();
        (self.is_slow, self.asked) = (products > MOST_PRODUCTS, self.asked + 2 * products);
        add(&mut moved, 1.0, &systems.unmoved);
        self.systems = Some(systems);
        [separations, forces, moved]
    }

    /// The equations of a set of pressed points.
    fn equations(&self, is_pressed: &[bool]) -> Equations<'_> {
        let pressed = |values: &[f64]| -> Vec<f64> {
            let both = values.iter().zip(is_pressed);
            both.map(|(value, is_pressed)| if *is_pressed { *value } else { 0.0 }).collect()
        };
        let own = pressed(&self.springs);
        let stands =
            self.is_rigid.iter().zip(is_pressed).map(|(rigid, pressed)| *rigid && *pressed);
        let yields: Vec<f64> = stands.map(|stands| f64::from(u8::from(!stands))).collect();
        Equations {
            points: &self.points,
            inverse: (&self.solver, self.columns.as_ref()),
            normal: (0..own.len()).map(|i| own[i] - yields[i] * self.held[i]).collect(),
            own,
            origin: pressed(&self.pushed),
            yields,
            has_rigid: self.is_rigid.contains(&true),
        }
    }

    /// The systems of a set of pressed points.
    fn begin(&self, equations: &Equations<'_>, is_pressed: &[bool]) -> Systems {
        let (points, origin, is_pressed) = (&self.points, &equations.origin, is_pressed.to_vec());
        let pushes = self.held.iter().zip(origin).map(|(held, origin)| [held * origin, 0.0]);
        let pushes: Vec<[f64; 2]> = pushes.collect();
        let loaded = points.along_normals.restrict(&points.respond(&self.solver, &pushes)); // d_0.
        if equations.has_rigid {
            let (free, none) = (equations.separations(&loaded), vec![0.0; origin.len()]);
            let left = difference(&free, origin);
            let scale = norm(&left);
            let family = LinearFamily::new(vec![left, none.clone()], scale);
            return Systems { is_pressed, unmoved: none.clone(), free: none, family };
        }
        // From the state found last where contact stiffens: what is left of the equations there.
        let unmoved = if self.last.is_empty() { loaded.clone() } else { self.last.clone() };
        let free = difference(&equations.separations(&unmoved), origin); // y_0.
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

impl PressedBodies for ContactSystem<'_> {
    fn pressing(&self) -> &Pressing<'_> {
        self.points.pressing
    }

    fn stiffness_at(&self, point: usize) -> f64 {
        self.springs[point]
    }

    fn usual_points(&self, [lower, upper]: [f64; 2]) -> ([f64; 2], usize) {
        if self.is_rigid.contains(&true) {
            return ([0.0, upper.max(LEAST_RANGE)], RIGID_NODES);
        }
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
