//! The stick-slip oscillator: a stiff block on a moving plane, held by a spring and a dashpot.
//!
//! `M u'' + (c + N mu'(V)) u' + k u = 0` about steady sliding: unstable below `V = v_c ln(N mu (q - 1) / (v_c c))`.

use crate::prelude::*;

/// So stiff that the block moves as one: its own modes lie above 30 kHz.
pub const STEEL: ElasticMaterial = elastic(2.1e11, 0.3, 7850.0, PlaneStrain);
pub const WIDTH: f64 = 0.04;
const HEIGHT: f64 = 0.03;
pub const MASS: f64 = 7850.0 * WIDTH * HEIGHT;
const NORMAL: f64 = 1e6 * WIDTH;
const SPRING: f64 = 3e10 * HEIGHT;
const DASHPOT: f64 = 6e5 * HEIGHT;
const DECAY: FrictionDecay = FrictionDecay { static_ratio: 1.5, decay_speed: 0.1 };

fn critical_speed() -> f64 {
    let excess = NORMAL * 0.3 * (DECAY.static_ratio - 1.0);
    DECAY.decay_speed * (excess / (DECAY.decay_speed * DASHPOT)).ln()
}

fn contact(speed: f64) -> SlidingContact {
    SlidingContact { decay: Some(DECAY), ..sliding_at(0.3, 0.0, speed) }
}

/// 4 by 3 square elements; the plane below, the spring on the right, the pressure above.
pub fn block(pressure: f64) -> Mesh {
    let mounting = springs([SPRING / HEIGHT, 0.0, 0.0], [DASHPOT / HEIGHT, 0.0]);
    let held = [("right", Support(mounting)), ("top", Pressure(pressure))];
    let specification = plane_body("bottom", ALONG_X, None, &held);
    Mesh::from_gmsh(&FileMesh::read(&rectangle(0.04, 0.03, 4, 3)).unwrap(), &specification).unwrap()
}

/// Growth rate of the block on its spring by the eigenvalue analysis, 1/s.
fn growth_rate(mesh: &Mesh, speed: f64) -> f64 {
    let options = TangentOptions { damping: RayleighDamping::default(), ..TANGENT };
    let tangent = linearized(mesh, &STEEL, &contact(speed), &options);
    let mode = &modes_at(&tangent, 0.3, Lowest(1))[0];
    // The block on its spring.
    near(mode.eigenvalue.norm(), (SPRING / MASS).sqrt(), 0.02);
    mode.growth_rate()
}

/// Closed form of the rigid block; the steel one is softer by the per mille.
#[test]
fn a_block_on_a_spring_turns_unstable_at_the_critical_speed_of_the_stick_slip_oscillator() {
    let mesh = block(1e6);
    let critical = critical_speed();
    for share in [0.5, 0.8, 1.2, 2.0] {
        let speed = share * critical;
        let exact =
            -(DASHPOT + NORMAL * 0.3 * SteadyFriction::at(Some(DECAY), speed).slope) / (2.0 * MASS);
        let found = growth_rate(&mesh, speed);
        let scale = DASHPOT / (2.0 * MASS);
        assert!((found - exact).abs() < 0.02 * scale, "{share} {found} {exact}");
    }
    assert!(growth_rate(&mesh, 0.98 * critical) > 0.0);
    assert!(growth_rate(&mesh, 1.02 * critical) < 0.0);
}

/// Samples of a transient of forty periods that starts from a push.
fn samples(mesh: &Mesh, speed: f64) -> Vec<SampleRow> {
    let body = SteppedBody::Plane { mesh, annulus: None };
    let damping = rayleigh_damping(0.0, 3e-7);
    let model = TransientModel::new(body, &STEEL, damping, contact(speed));
    let period = TAU * (MASS / SPRING).sqrt();
    let noise = Perturbation { noise: 1e-2 * speed, ..Perturbation::default() };
    let [duration, interval] = [40.0, 0.02].map(|periods| periods * period);
    let settings =
        transient_settings([duration, interval, 0.0], InitialState::SteadySliding, noise);
    let (record, residual) = recorded(model, OperatorChoice::Auto, &settings);
    assert!(residual < 1e-10, "{:e}", residual);
    record.rows
}

/// Theory: below the critical speed the oscillation grows until the block sticks to the plane once in each period; above it dies out.
#[test]
fn a_block_sticks_and_slips_below_its_critical_speed_and_slides_above() {
    let mesh = block(1e6);
    let last = |share: f64| {
        let rows = samples(&mesh, share * critical_speed());
        let tail = &rows[rows.len() - 200..];
        let stuck: u64 = tail.iter().map(|row| row.counts.stick).sum();
        let all: u64 = tail.iter().map(|row| row.counts.stick + row.counts.slip).sum();
        assert!(rows.iter().all(|row| row.counts.ambiguous == 0));
        stuck as f64 / all as f64
    };
    let slow = last(0.5);
    assert!((0.03..0.9).contains(&slow), "{slow}");
    assert_eq!(last(1.3), 0.0);
}
