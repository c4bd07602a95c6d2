//! Analytic stand-ins for solver results: waves on an annulus, a growing signal that saturates.

use faer::c64;
use frictionsim::cea::{ComplexMode, FrictionPoint, FrictionSweep, UnstableInterval};
use frictionsim::contact::ContactStatus;
use frictionsim::mesh::{AnnulusMesh, AnnulusSpecification, ElementKind, Mesh2d};
use std::f64::consts::{PI, TAU};

pub const MASS_COEFFICIENT: f64 = 40.0;
pub const STIFFNESS_COEFFICIENT: f64 = 4.5e-7;

/// Frequency (Hz), harmonic, branch, split of the real part at friction 0.3 (Hz).
const PAIRS: [(f64, usize, usize, f64); 16] = [
    (5857.0, 0, 0, 0.0),
    (7657.0, 3, 0, 121.0),
    (9892.0, 2, 0, 297.0),
    (10513.0, 1, 0, 397.0),
    (11077.0, 0, 1, 0.0),
    (11263.0, 4, 0, 148.0),
    (11772.0, 1, 1, 83.0),
    (12916.0, 2, 1, 46.0),
    (14673.0, 5, 0, 11.0),
    (14779.0, 3, 1, 55.0),
    (14832.0, 0, 2, 0.0),
    (16361.0, 4, 1, 345.0),
    (16433.0, 6, 0, 2.0),
    (16641.0, 0, 3, 0.0),
    (17165.0, 1, 2, 423.0),
    (17447.0, 2, 2, 66.0),
];

pub fn mesh(circumferential_elements: usize, radial_elements: usize) -> Mesh2d {
    AnnulusMesh::generate(&AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements,
        radial_elements,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
    })
    .unwrap()
    .mesh
}

fn rayleigh(omega: f64) -> f64 {
    -0.5 * (MASS_COEFFICIENT + STIFFNESS_COEFFICIENT * omega * omega)
}

/// All modes at one friction value; pairs split symmetrically, the wave against the rotor gains.
pub fn modes(friction: f64, mesh: Option<&Mesh2d>) -> Vec<ComplexMode> {
    let mut modes = Vec::new();
    for (frequency, harmonic, branch, split) in PAIRS {
        let directions: &[i8] = if harmonic == 0 { &[0] } else { &[1, -1] };
        for &direction in directions {
            let sign = -f64::from(direction);
            let omega = TAU * frequency;
            let real = rayleigh(omega) + sign * TAU * split * friction / 0.3;
            let imaginary = omega + sign * TAU * 0.03 * split * (friction / 0.3).powi(2);
            modes.push(ComplexMode {
                eigenvalue: c64::new(real, imaginary),
                harmonic,
                branch,
                direction: if friction == 0.0 { 0 } else { direction },
                residual: 1e-12,
                uncertainty: 1e-12,
                contact_share: 0.1,
                shape: mesh.map(|mesh| shape(mesh, harmonic, branch, direction, friction)),
            });
        }
    }
    modes.sort_by(|a, b| a.eigenvalue.im.total_cmp(&b.eigenvalue.im));
    modes
}

pub fn sweep(count: usize) -> FrictionSweep {
    let points = (0..count)
        .map(|i| {
            let friction_coefficient = i as f64 / (count - 1) as f64;
            FrictionPoint {
                friction_coefficient,
                modes: modes(friction_coefficient, None),
            }
        })
        .collect();
    let mut intervals = Vec::new();
    for (frequency, harmonic, branch, split) in PAIRS {
        let critical = -0.3 * rayleigh(TAU * frequency) / (TAU * split);
        if split > 0.0 && critical < 1.0 {
            intervals.push(UnstableInterval {
                harmonic,
                branch,
                direction: -1,
                critical_friction: critical,
                frequency_hz: frequency,
                restabilized: (harmonic == 1 && branch == 2).then_some((0.8, frequency)),
                unstable_from_start: false,
            });
        }
    }
    intervals.sort_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
    FrictionSweep { points, intervals }
}

/// A wave of one harmonic, clamped outside, with an arbitrary solver phase; friction shears it.
pub fn shape(
    mesh: &Mesh2d,
    harmonic: usize,
    branch: usize,
    direction: i8,
    friction: f64,
) -> Vec<c64> {
    let mut out = Vec::with_capacity(2 * mesh.node_count());
    let phase = c64::new(0.3, 0.9);
    for (&[x, y], &angle) in mesh.nodes.iter().zip(&mesh.frame_angles) {
        let s = ((x.hypot(y) - 0.0205) / 0.07).clamp(0.0, 1.0);
        let profile = (PI * (branch as f64 + 0.5) * s).cos() * (1.0 - s);
        let swirl = if direction == 0 { 0.0 } else { 1.2 * friction };
        let argument =
            f64::from(direction) * harmonic as f64 * angle + f64::from(direction) * swirl * s * 3.0;
        let wave = c64::new(argument.cos(), -argument.sin()) * phase;
        let radial = if harmonic == 0 {
            0.0
        } else {
            0.5 * s * profile
        };
        out.push(wave * c64::new(0.0, radial));
        out.push(wave * c64::new(profile, 0.0));
    }
    out
}

/// A run of 50 ms: a torsional mode rings down while a wave of harmonic 2 grows and saturates.
pub struct Run {
    pub times: Vec<f64>,
    pub acceleration: Vec<f64>,
    pub node_count: usize,
    pub status: Vec<ContactStatus>,
}

pub const GROWTH_RATE: f64 = 978.0;
const WAVE: f64 = TAU * 9600.0;

/// Relative size of the limit cycle reached at a time, 0 to 1.
pub fn saturation(time: f64) -> f64 {
    1.0 / (1.0 + (-GROWTH_RATE * (time - 0.018)).exp())
}

pub fn status_at(time: f64, angle: f64) -> ContactStatus {
    let wave = (2.0 * angle + WAVE * time).cos() * saturation(time);
    if wave > 0.45 {
        ContactStatus::Stick
    } else if wave < -0.3 {
        ContactStatus::Open
    } else {
        ContactStatus::Slip
    }
}

pub fn run(samples: usize, node_count: usize) -> Run {
    let times: Vec<f64> = (0..samples)
        .map(|i| 0.05 * i as f64 / (samples - 1) as f64)
        .collect();
    let acceleration = times
        .iter()
        .map(|&t| {
            let size = saturation(t);
            let ring_down = 900.0 * (-325.0 * t).exp() * (TAU * 5857.0 * t).sin();
            let wave = (WAVE * t).sin()
                + 0.3 * size * (2.0 * WAVE * t).sin()
                + 0.12 * size * (3.0 * WAVE * t).cos();
            ring_down + 3.0e4 * size * wave
        })
        .collect();
    let status = times
        .iter()
        .flat_map(|&t| {
            (0..node_count).map(move |j| status_at(t, TAU * j as f64 / node_count as f64))
        })
        .collect();
    Run {
        times,
        acceleration,
        node_count,
        status,
    }
}

/// Window centres, frequencies and amplitudes of windows of 0.5 ms (a plain Fourier sum).
pub fn spectrogram(run: &Run, max_frequency_hz: f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let step = run.times[1] - run.times[0];
    let window = (5e-4 / step).round() as usize;
    let frequencies: Vec<f64> = (0..)
        .map(|i| f64::from(i) * 400.0)
        .take_while(|&f| f <= max_frequency_hz)
        .collect();
    let (mut centres, mut amplitude) = (Vec::new(), Vec::new());
    let mut start = 0;
    while start + window <= run.times.len() {
        centres.push(run.times[start] + 0.5 * window as f64 * step);
        for &frequency in &frequencies {
            let mut sum = c64::new(0.0, 0.0);
            let turn = c64::new(0.0, -TAU * frequency * step).exp();
            let mut factor = c64::new(1.0, 0.0);
            for i in 0..window {
                let taper = 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / window as f64).cos();
                sum += factor * (run.acceleration[start + i] * taper);
                factor *= turn;
            }
            amplitude.push(4.0 * sum.norm() / window as f64);
        }
        start += window / 5;
    }
    (centres, frequencies, amplitude)
}
