//! Limit cycles of bodies without symmetry: periodic motions of the whole mesh.
//!
//! Independent: a transient that grows into its cycle from noise with a step of its own; rotating waves, found along their phase;
//! an oscillator integrated from event to event. The others are identities.

use frictionsim::case::Case;
use frictionsim::contact::ContactInterface;
use frictionsim::cycle::Verdict;
use frictionsim::fem::operator::SimdLevel;
use frictionsim::fem::{assemble_stiffness, lumped_masses};
use frictionsim::results::periodic::{FoundCycle, PeriodicResult};
use frictionsim::study::cycle::{CycleStudy, PeriodicStudy};
use frictionsim::study::transient::TransientStudy;

/// A shipped case under overrides.
fn shipped(name: &str, overrides: &[&str]) -> Case {
    let path = format!("{}/cases/{name}", env!("CARGO_MANIFEST_DIR"));
    let overrides: Vec<String> = overrides.iter().map(|text| text.to_string()).collect();
    Case::parse(&path, &std::fs::read(&path).unwrap(), &overrides).unwrap()
}

/// The block at a friction coefficient at which one mode grows.
fn block(overrides: &[&str]) -> Case {
    let own = [
        "contact.friction_coefficient=0.7",
        "cycle={ confirmation_periods = 20 }",
    ];
    shipped("sliding-block.toml", &[&own, overrides].concat())
}

fn cycles(case: &Case) -> Vec<PeriodicResult> {
    let study = PeriodicStudy::new(case, SimdLevel::detect()).unwrap();
    study.run(0, &|_| {}).unwrap()
}

fn found(result: &PeriodicResult) -> &FoundCycle {
    result.outcome.as_ref().unwrap()
}

/// Holds the first cycle of a case to the end of its transient, which has a step of its own: frequency 1e-3, statuses 0.02, powers
/// 2 % of the external one.
fn hold_to_transient(case: &Case) -> PeriodicResult {
    let result = cycles(case).remove(0);
    let motion = &found(&result).motion;
    let solved = TransientStudy::new(case, SimdLevel::detect()).unwrap();
    let end = solved.solve().unwrap().analysis.last_fifth;
    let frequency = end.main_frequency_hz.unwrap();
    assert!(
        (motion.frequency_hz / frequency - 1.0).abs() < 1e-3,
        "{} {frequency}",
        motion.frequency_hz
    );
    let fractions = motion.fractions.iter().zip(end.status);
    fractions.for_each(|(a, b)| assert!((a - b).abs() < 0.02, "{a} {b}"));
    let (own, other) = (motion.powers.contact, end.powers);
    for (a, b) in [
        (own.external, other.external),
        (own.stick, other.stick),
        (own.slide, other.slide),
        (motion.powers.material_damping, end.material_damping),
    ] {
        assert!((a - b).abs() < 0.02 * other.external, "{a} {b}");
    }
    result
}

/// A transient that grows from noise.
const FROM_NOISE: [&str; 3] = [
    "transient.duration=0.012",
    "transient.initial=\"steady-sliding\"",
    "transient.perturbation.noise=1e-2",
];

#[test]
fn the_cycle_of_a_block_is_that_of_its_transient() {
    let result = hold_to_transient(&block(&FROM_NOISE));
    let cycle = found(&result);
    // A stable cycle: perturbations decay, a transient beside it comes back.
    let multipliers = cycle.stability.as_ref().unwrap().as_ref().unwrap();
    assert_eq!(multipliers.verdict(), Verdict::Stable);
    let confirmation = cycle.confirmation.as_ref().unwrap();
    assert!(confirmation.agrees(&cycle.motion), "{confirmation:?}");
    // The shift in phase has the multiplier 1, but for the steps of time.
    let shift = multipliers.shift.unwrap();
    let off = (shift.re - 1.0).abs();
    assert!(
        off < 2.0 / cycle.motion.steps as f64 && shift.im.abs() < 1e-9,
        "{shift}"
    );
}

#[test]
fn springs_and_dashpots_of_the_contact_are_those_of_the_transient() {
    let springs = [
        "contact.normal_stiffness=2e13",
        "contact.tangential_damping=1e3",
    ];
    let result = hold_to_transient(&block(&[&FROM_NOISE[..], &springs].concat()));
    let powers = found(&result).motion.powers;
    assert!(powers.contact.damping > 0.0 && powers.balance_residual() < 1e-6);
}

#[test]
fn the_cycle_of_a_disc_on_a_deformable_shaft_is_that_of_its_transient() {
    let result = hold_to_transient(&shipped(
        "deformable-shaft.toml",
        &[
            "mesh.circumferential_elements=48",
            "mesh.radial_elements=10",
            "mesh.shaft_radial_elements=2",
            "cea.max_frequency_hz=12000.0",
            "cycle={ onsets = \"lowest\", confirmation_periods = 0, stability = \"none\" }",
            "transient.duration=0.012",
            "transient.perturbation={ harmonics = [1], velocity = 0.05 }",
        ],
    ));
    assert!(found(&result).motion.powers.balance_residual() < 1e-6);
}

#[test]
fn energy_of_a_cycle_closes_and_its_parts_add_up() {
    let results = cycles(&block(&[
        "cycle={ confirmation_periods = 0, stability = \"none\" }",
    ]));
    let cycle = found(&results[0]);
    let motion = &cycle.motion;
    // The balance of the time loop closes to round-off; what the motion misses its start by is left, times the energies that
    // go to and fro, a few times those that are lost.
    assert!(motion.residual < 1e-8, "{}", motion.residual);
    let balance = motion.powers.balance_residual();
    assert!(balance < 1e-7, "{balance}");
    let contact = motion.powers.contact;
    let parts = contact.stick + contact.slide + contact.contact_dissipated;
    assert!((parts / contact.external - 1.0).abs() < 1e-12);

    // Statuses are those of the nodes, harmonics those of the motion, both sum to the whole.
    let mean = |k: usize| {
        let shares = motion.shares.iter().map(|share| share[k]);
        shares.sum::<f64>() / motion.shares.len() as f64
    };
    for k in 0..3 {
        assert!((mean(k) - motion.fractions[k]).abs() < 1e-12);
    }
    let told = &motion.harmonics[..cycle.harmonic_count];
    assert!(told.last().unwrap().remainder <= 1e-3);
    assert!(told.len() < motion.harmonics.len() && told.len() > 1);
    // Time begins where the node that moves most is farthest ahead.
    let ahead = motion
        .instants
        .iter()
        .map(|at| at.displacement[motion.node][1]);
    let farthest = ahead.fold(f64::NEG_INFINITY, f64::max);
    let first = motion.instants[0].displacement[motion.node][1];
    assert!((farthest - first).abs() < 1e-3 * motion.amplitude);
}

#[test]
fn a_branch_of_cycles_goes_from_neighbour_to_neighbour() {
    let range = "cycle={ confirmation_periods = 0, stability = \"none\", continuation = { key = \
                 \"contact.friction_coefficient\", from = 0.64, to = 0.7, count = 4 } }";
    let results = cycles(&block(&[range]));
    let branch = found(&results[0]).branch.as_ref().unwrap();
    let values: Vec<f64> = branch.motions.iter().map(|own| own.value).collect();
    assert_eq!(values.len(), 4, "{values:?} {:?}", branch.ends);
    assert!(values.is_sorted());
    // The first one is the cycle that is found from its own mode.
    let own = cycles(&block(&[
        "contact.friction_coefficient=0.64",
        "cycle={ confirmation_periods = 0, stability = \"none\" }",
    ]));
    let (a, b) = (&branch.motions[0].motion, &found(&own[0]).motion);
    assert!(
        (a.frequency_hz / b.frequency_hz - 1.0).abs() < 1e-4,
        "{} {}",
        a.frequency_hz,
        b.frequency_hz
    );
    let powers = [a, b].map(|motion| motion.powers.contact.external);
    assert!((powers[0] / powers[1] - 1.0).abs() < 1e-3, "{powers:?}");
}

#[test]
fn below_the_onset_steady_sliding_is_said_to_be_stable() {
    let case = block(&["contact.friction_coefficient=0.5"]);
    let study = PeriodicStudy::new(&case, SimdLevel::detect()).unwrap();
    let report = study.report(study.run(0, &|_| {}).unwrap(), 0.0);
    assert!(PeriodicStudy::refuse_nothing(&report).is_ok());
    let text = report.stable_sliding().unwrap();
    assert!(
        text.contains("none of 10 modes") && text.contains("friction_coefficient = 0.5"),
        "{text}"
    );
}

/// The same cycle by two methods: a wave along its phase, and a motion of the whole mesh.
#[test]
fn rotating_waves_are_periodic_motions_of_the_whole_mesh() {
    let case = shipped(
        "limit-cycle.toml",
        &[
            "mesh.circumferential_elements=90",
            "mesh.radial_elements=18",
            "cycle={ harmonics = [2], onsets = \"lowest\", confirmation_periods = 0 }",
            "cea={ modes = 8, friction_coefficients = [0.3], geometric_stiffness = false }",
        ],
    );
    let waves = CycleStudy::new(&case, SimdLevel::detect()).unwrap();
    let waves = waves.run(0, &|| {});
    let wave = waves[0].cycle.as_ref().unwrap();
    let all = cycles(&shipped(
        "limit-cycle.toml",
        &[
            "mesh.circumferential_elements=90",
            "mesh.radial_elements=18",
            "cycle={ confirmation_periods = 0 }",
            "cea={ modes = 8, friction_coefficients = [0.3], geometric_stiffness = false }",
        ],
    ));
    let distance = |result: &PeriodicResult| {
        let motion = result
            .outcome
            .as_ref()
            .ok()
            .map(|found| found.motion.frequency_hz);
        (motion.unwrap_or(0.0) / wave.frequency_hz() - 1.0).abs()
    };
    let nearest = all
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let motion = &found(nearest.unwrap()).motion;
    // The phases of the wave's own search are the difference.
    assert!(
        (motion.frequency_hz / wave.frequency_hz() - 1.0).abs() < 5e-4,
        "{} {}",
        motion.frequency_hz,
        wave.frequency_hz()
    );
    let fractions = motion.fractions.iter().zip(wave.fractions);
    fractions.for_each(|(a, b)| assert!((a - b).abs() < 0.01, "{a} {b}"));
    let (own, other) = (motion.powers.contact, wave.powers);
    assert!(
        (own.external / other.external - 1.0).abs() < 0.01,
        "{} {}",
        own.external,
        other.external
    );
    for (a, b) in [(own.stick, other.stick), (own.slide, other.slide)] {
        assert!((a - b).abs() < 0.01 * other.external, "{a} {b}");
    }

    // Floquet exponents of the wave, from linearized contact, and multipliers, from differences of the motion.
    let own = found(nearest.unwrap()).stability.as_ref().unwrap().as_ref();
    let own = own.unwrap().leading().unwrap();
    let other = waves[0].stability.as_ref().unwrap().as_ref();
    let other = other.unwrap().leading().unwrap();
    let bound = own.uncertainty + other.uncertainty;
    assert!(
        (own.growth_rate - other.exponent.re).abs() < bound,
        "{own:?} {other:?}"
    );
}

/// A square of one element on a moving plane, its far side held: two contact nodes that stick and slip under friction that
/// falls with speed.
fn oscillator(folder: &std::path::Path) -> Case {
    let mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"face\"\n1 2 \"back\"\n2 3 \"body\"\n\
        $EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 0.01 0 0\n3 0.01 0.01 0\n4 0 0.01 0\n$EndNodes\n$Elements\n3\n\
        1 1 2 1 1 1 2\n2 1 2 2 2 3 4\n3 3 2 3 1 1 2 3 4\n$EndElements\n";
    let text = "[mesh]\nfile = \"square.msh\"\n[boundaries.back]\ncondition = \"clamped\"
[material]\nyoung_modulus = 2.5e9\npoisson_ratio = 0.38\ndensity = 1228.0\nformulation = \"plane-strain\"
[damping]\nmass_coefficient = 40.0\nstiffness_coefficient = 2e-7
[contact]\nboundary = \"face\"\ncounterface = \"plane\"\ndirection = [1.0, 0.0]\nspeed = 0.3
friction_coefficient = 0.3\nstatic_friction_ratio = 1.1\ndecay_speed = 0.5\ninterference = 1e-5
[cea]\nmodes = 2\n[transient]\nduration = 1e-3\ntime_step = 2.5e-9
[cycle]\nconfirmation_periods = 0\nstability = \"none\"\n";
    std::fs::write(folder.join("square.msh"), mesh).unwrap();
    let path = folder.join("case.toml");
    std::fs::write(&path, text).unwrap();
    Case::parse(path.to_str().unwrap(), text.as_bytes(), &[]).unwrap()
}

/// The two contact nodes of the oscillator by its matrices: `m v' = T - K u - load - D v`, pressed by `N = preload + B u + b v`.
struct EventDriven {
    masses: [f64; 2],
    stiffness: [[f64; 2]; 2],
    load: [f64; 2],
    preload: [f64; 2],
    pressing: [[f64; 2]; 2],
    damping: [f64; 2],
    speed: f64,
    friction: [f64; 3],
}

/// Displacement and velocity of both nodes.
type Motion = [f64; 4];

impl EventDriven {
    fn new(case: &Case) -> Self {
        let mesh = case.mesh().unwrap();
        let interface = ContactInterface::of(&mesh);
        let contact = case.contact.sliding;
        let masses = lumped_masses(&mesh, case.materials());
        let mut dense = [[0.0; 8]; 8];
        for (i, j, value) in assemble_stiffness(&mesh, case.materials()).entries {
            dense[i][j] += value;
        }
        let n = |i: usize| interface.normal_dof(i);
        let t = |i: usize| interface.tangential_dof(i);
        let pushed = |i: usize| contact.interference - interface.gaps[i];
        let both = |of: &dyn Fn(usize) -> f64| [of(0), of(1)];
        let block = |row: &dyn Fn(usize) -> usize, column: &dyn Fn(usize) -> usize| {
            [0, 1].map(|i| [0, 1].map(|j| dense[row(i)][column(j)]))
        };
        let (normal, cross) = (block(&n, &n), block(&t, &n));
        let decay = contact.decay.unwrap();
        Self {
            masses: both(&|i| masses[interface.nodes[i] as usize]),
            stiffness: block(&t, &t),
            load: both(&|i| cross[i][0] * pushed(0) + cross[i][1] * pushed(1)),
            preload: both(&|i| normal[i][0] * pushed(0) + normal[i][1] * pushed(1)),
            pressing: block(&n, &t),
            damping: [
                case.damping.rayleigh.mass_coefficient,
                case.damping.rayleigh.stiffness_coefficient,
            ],
            speed: interface.surface_speed(contact.rotation_speed),
            friction: [
                contact.friction_coefficient,
                decay.static_ratio,
                decay.decay_speed,
            ],
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
        let acceleration = |i: usize| match states[i] {
            0.0 => 0.0,
            sign => {
                let friction = sign * self.limit(i, x, self.speed - x[2 + i]);
                (friction - self.holding(i, x)) / self.masses[i]
            }
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
    /// of the first node's sticking to the next.
    fn run(&self, mut x: Motion, step: f64, periods: usize, kept: usize) -> (f64, f64) {
        let mut states = [self.speed.signum(); 2];
        let (mut time, mut stuck) = (0.0, 0.0);
        let mut starts: Vec<(f64, f64)> = Vec::new();
        while starts.len() <= periods {
            let next = self.step(&x, states, step);
            let leaves = |i: usize, at: &Motion| self.overrun(i, at, states) > 0.0;
            let event = (0..2).any(|i| leaves(i, &next));
            let mut h = step;
            if event {
                let (mut low, mut high) = (0.0, step);
                for _ in 0..60 {
                    h = 0.5 * (low + high);
                    let middle = self.step(&x, states, h);
                    match (0..2).any(|i| leaves(i, &middle)) {
                        true => high = h,
                        false => low = h,
                    }
                }
                h = high;
            }
            stuck += h * states.iter().filter(|state| **state == 0.0).count() as f64 / 2.0;
            x = self.step(&x, states, h);
            time += h;
            if !event {
                continue;
            }
            let left: Vec<usize> = (0..2)
                .filter(|&i| self.overrun(i, &x, states) > 0.0)
                .collect();
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
        (kept as f64 / duration, (last.1 - first.1) / duration)
    }
}

#[test]
fn an_oscillator_that_sticks_and_slips_agrees_with_integration_from_event_to_event() {
    let folder = tempfile::tempdir().unwrap();
    let case = oscillator(folder.path());
    let results = cycles(&case);
    assert_eq!(results.len(), 1);
    let motion = &found(&results[0]).motion;
    let reference = EventDriven::new(&case);
    let (frequency, stick) = reference.run([1e-6, 1e-6, 0.0, 0.0], 1.2e-8, 120, 20);
    // A node comes to rest or leaves it at a step of 2.5e-9 s, half a step late each time.
    assert!(
        (motion.frequency_hz / frequency - 1.0).abs() < 1e-4,
        "{} {frequency}",
        motion.frequency_hz
    );
    assert!(
        (motion.fractions[0] - stick).abs() < 1e-3,
        "{:?} {stick}",
        motion.fractions
    );
    assert!(stick > 0.02, "{stick}");
}
