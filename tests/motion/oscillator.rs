//! An oscillator of two contact nodes, and its motion integrated from event to event.

use crate::prelude::*;

/// A square of one element on a moving plane, its far side held: two nodes stick and slip under friction that falls with speed.
pub fn oscillator(folder: &Path, overrides: &[&str]) -> Case {
    let mesh = plane_block([0.01; 2], [1; 2], ["face", "back", "body"]);
    let text = include_str!("../cases/oscillator.toml");
    fs::write(folder.join("square.msh"), mesh).unwrap();
    case_of(folder.join("case.toml"), text, overrides)
}

/// The periodic motions that a case's study finds.
pub fn cycles(case: &Case) -> Vec<PeriodicResult> {
    PeriodicStudy::new(case, SimdLevel::detect()).unwrap().run(0, &Unwatched, &|_| {}).unwrap()
}

/// Holds a number to another, to a share of it.
#[track_caller]
pub fn near(found: f64, expected: f64, share: f64) {
    assert!((found / expected - 1.0).abs() < share, "{found} {expected}");
}

/// The two contact nodes of the oscillator by its matrices: `m v' = T - K u - load - D v`, pressed by `N = preload + B u + b v`.
pub struct EventDriven {
    masses: [f64; 2],
    stiffness: [[f64; 2]; 2],
    load: [f64; 2],
    preload: [f64; 2],
    pressing: [[f64; 2]; 2],
    damping: [f64; 2],
    speed: f64,
    friction: [f64; 3],
}

pub type Motion = [f64; 4];

impl EventDriven {
    /// The oscillator of a case.
    pub fn new(case: &Case) -> Self {
        let mesh = case.body.mesh().unwrap();
        let interface = ContactInterface::of(&mesh);
        let contact = case.contact.sliding;
        let masses = lumped_masses(&mesh, case.materials());
        let mut dense = [[0.0; 8]; 8];
        for (i, j, value) in assemble_stiffness(&mesh, case.materials()).entries {
            dense[i][j] += value;
        }
        let n = |i: usize| 2 * interface.nodes[i] as usize;
        let t = |i: usize| n(i) + 1;
        let pushed = |i: usize| contact.interference - interface.gaps[i];
        let both = |of: &dyn Fn(usize) -> f64| [of(0), of(1)];
        let block = |row: &dyn Fn(usize) -> usize, column: &dyn Fn(usize) -> usize| {
            [0, 1].map(|i| [0, 1].map(|j| dense[row(i)][column(j)]))
        };
        let (normal, cross) = (block(&n, &n), block(&t, &n));
        let (decay, damping) = (contact.decay.unwrap(), case.damping.rayleigh);
        Self {
            masses: both(&|i| masses[interface.nodes[i] as usize]),
            stiffness: block(&t, &t),
            load: both(&|i| cross[i][0] * pushed(0) + cross[i][1] * pushed(1)),
            preload: both(&|i| normal[i][0] * pushed(0) + normal[i][1] * pushed(1)),
            pressing: block(&n, &t),
            damping: [damping.mass_coefficient, damping.stiffness_coefficient],
            speed: interface.surface_speed(contact.rotation_speed),
            friction: [contact.friction_coefficient, decay.static_ratio, decay.decay_speed],
        }
    }

    fn normal(&self, i: usize, x: &Motion) -> f64 {
        let beta = self.damping[1];
        let part = |j: usize| self.pressing[i][j] * (x[j] + beta * x[2 + j]);
        self.preload[i] + part(0) + part(1)
    }

    /// What a node needs of friction to keep its velocity.
    fn holding(&self, i: usize, x: &Motion) -> f64 {
        let [alpha, beta] = self.damping;
        let part = |j: usize| self.stiffness[i][j] * (x[j] + beta * x[2 + j]);
        self.load[i] + part(0) + part(1) + alpha * self.masses[i] * x[2 + i]
    }

    fn limit(&self, i: usize, x: &Motion, slip: f64) -> f64 {
        let [mu, ratio, decay] = self.friction;
        mu * (1.0 + (ratio - 1.0) * (-slip.abs() / decay).exp()) * self.normal(i, x)
    }

    /// Rates in given states: 0 sticks, else the sign of the friction force.
    fn rate(&self, x: &Motion, states: [f64; 2]) -> Motion {
        let acceleration = |i: usize| {
            let friction = states[i] * self.limit(i, x, self.speed - x[2 + i]);
            states[i].abs() * (friction - self.holding(i, x)) / self.masses[i]
        };
        [x[2], x[3], acceleration(0), acceleration(1)]
    }

    /// Runge and Kutta's step of fourth order.
    fn step(&self, x: &Motion, states: [f64; 2], h: f64) -> Motion {
        let along = |k: &Motion, h: f64| -> Motion { [0, 1, 2, 3].map(|i| x[i] + h * k[i]) };
        let a = self.rate(x, states);
        let b = self.rate(&along(&a, 0.5 * h), states);
        let c = self.rate(&along(&b, 0.5 * h), states);
        let d = self.rate(&along(&c, h), states);
        [0, 1, 2, 3].map(|i| x[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
    }

    /// Positive where a node has left its state: reversed its slip, or overcome static friction.
    fn overrun(&self, i: usize, x: &Motion, states: [f64; 2]) -> f64 {
        match states[i] {
            0.0 => self.holding(i, x).abs() - self.limit(i, x, 0.0),
            sign => sign * (x[2 + i] - self.speed),
        }
    }

    /// Mean frequency, and mean share of the time that nodes stick, over the last `kept` of `periods` periods, from one start
    /// of the first node's sticking to the next; none where the node ceases to stick.
    pub fn run(&self, mut x: Motion, step: f64, periods: usize, kept: usize) -> Option<(f64, f64)> {
        let mut states = [self.speed.signum(); 2];
        let (mut time, mut stuck) = (0.0, 0.0);
        let mut starts: Vec<(f64, f64)> = Vec::new();
        while starts.len() <= periods {
            // Forty thousand steps are many periods.
            if time - starts.last().map_or(0.0, |last| last.0) > 4e4 * step {
                return None;
            }
            let next = self.step(&x, states, step);
            let leaves = |at: &Motion| (0..2).any(|i| self.overrun(i, at, states) > 0.0);
            let event = leaves(&next);
            let mut h = step;
            if event {
                let (mut low, mut high) = (0.0, step);
                for _ in 0..60 {
                    h = 0.5 * (low + high);
                    let is_beyond = leaves(&self.step(&x, states, h));
                    (low, high) = if is_beyond { (low, h) } else { (h, high) };
                }
                h = high;
            }
            stuck += h * states.iter().filter(|state| **state == 0.0).count() as f64 / 2.0;
            x = self.step(&x, states, h);
            time += h;
            if !event {
                continue;
            }
            let left: Vec<usize> = (0..2).filter(|&i| self.overrun(i, &x, states) > 0.0).collect();
            for i in left {
                let force = self.holding(i, &x);
                if states[i] != 0.0 && force.abs() <= self.limit(i, &x, 0.0) {
                    (states[i], x[2 + i]) = (0.0, self.speed);
                    if i == 0 {
                        starts.push((time, stuck));
                    }
                } else {
                    states[i] = force.signum();
                }
                assert!(self.normal(i, &x) > 0.0, "a node lifts off");
            }
        }
        let (first, last) = (starts[periods - kept], starts[periods]);
        let duration = last.0 - first.0;
        Some((kept as f64 / duration, (last.1 - first.1) / duration))
    }
}
