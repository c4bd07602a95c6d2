//! Analytic stand-ins for solver results: waves on an annulus.

use crate::prelude::*;
use frictionsim::results::cea::Solution;

pub const MASS_COEFFICIENT: f64 = 40.0;
pub const STIFFNESS_COEFFICIENT: f64 = 4.5e-7;

/// Frequency (Hz), harmonic, branch, split of the real part at friction 0.3 (Hz).
const PAIRS: &str = "\
    5857 0 0 0 ; 7657 3 0 121 ; 9892 2 0 297 ; 10513 1 0 397 ; 11077 0 1 0 ; \
    11263 4 0 148 ; 11772 1 1 83 ; 12916 2 1 46 ; 14673 5 0 11 ; 14779 3 1 55 ; \
    14832 0 2 0 ; 16361 4 1 345 ; 16433 6 0 2 ; 16641 0 3 0 ; 17165 1 2 423 ; 17447 2 2 66";

pub fn mesh(circumferential_elements: usize, radial_elements: usize) -> Mesh {
    AnnulusMesh::generate(&annulus(Quad4, circumferential_elements, radial_elements)).unwrap().mesh
}

fn rayleigh(omega: f64) -> f64 {
    -0.5 * (MASS_COEFFICIENT + STIFFNESS_COEFFICIENT * omega * omega)
}

/// A mode without a shape, of the first branch.
pub fn mode(eigenvalue: c64, harmonic: usize, direction: i8) -> ComplexMode {
    ComplexMode {
        eigenvalue,
        harmonic,
        branch: 0,
        direction,
        residual: 1e-13,
        uncertainty: 1e-12,
        contact_share: 0.2,
        axial_share: None,
        mesh_error: None,
        shape: None,
        left: None,
        nodal_diameters: None,
        wave: None,
    }
}

/// Where a wave against the rotor begins to grow.
pub fn onset((n, branch): (usize, usize), critical: f64, frequency_hz: f64) -> UnstableInterval {
    UnstableInterval {
        harmonic: n,
        branch,
        direction: -1,
        critical_friction: critical,
        frequency_hz,
        ..UnstableInterval::default()
    }
}

/// A steady state that slips everywhere.
pub const SLIDING: BaseState = BaseState {
    friction_coefficient: 0.3,
    slipping: 180,
    sticking: 0,
    open: 0,
    pressure_pa: [2.827e6; 2],
    shear_pa: [0.848e6; 2],
    torque_n_m: Some(20.15),
    drag_n: None,
    power_w: 1287.0,
    extent: Extent::WholeBody,
};

/// A state whose contact nodes have these angles, with pressure and friction traction by angle, and one stress.
pub fn field(
    mesh: &Mesh,
    angles: &[(u32, f64)],
    tractions: impl Fn(f64) -> [f64; 2],
    stress: Vec<NodalStress>,
) -> BaseField {
    let contact = angles.iter().map(|&(node, angle)| {
        let [pressure, shear] = tractions(angle);
        let place = ContactPlace {
            contact: "contact".to_owned(),
            position: mesh.nodes[node as usize],
            angle: Some(angle),
            area: 1e-6,
            shares: vec![(node, 1.0)],
            ..ContactPlace::default()
        };
        ContactState { place, speed: 1.0, pressure, shear, is_pressed: true }
    });
    BaseField {
        contact: contact.collect(),
        surfaces: Vec::new(),
        displacement: vec![0.0; 2 * mesh.node_count()],
        stress: BodyStress::Plane(stress),
    }
}

/// A sweep as a solver gives it back.
pub fn solution(sweep: FrictionSweep) -> Solution {
    Solution { sweep, dofs: 12_420, method: "cyclic", ..Solution::default() }
}

/// A report of the disc with such a state.
pub fn report<'a>(mesh: &'a Mesh, solution: &'a Solution) -> CeaReport<'a> {
    CeaReport {
        title: "Polycarbonate disc",
        body: ShownBody { mesh, sector: None },
        has_harmonics: true,
        selection: "below 17500 Hz".to_owned(),
        friction_coefficients: &[],
        solution,
        contact_changes: &[],
        base: SLIDING,
        wall_s: 1.2,
    }
}

/// All modes at one friction value; pairs split symmetrically, the wave against the rotor gains.
pub fn modes(friction: f64, mesh: Option<&Mesh>) -> Vec<ComplexMode> {
    let mut modes = Vec::new();
    for [frequency, harmonic, branch, split] in rows_of(PAIRS) {
        let (harmonic, branch) = (harmonic as usize, branch as usize);
        let directions: &[i8] = if harmonic == 0 { &[0] } else { &[1, -1] };
        for &direction in directions {
            let sign = -f64::from(direction);
            let omega = TAU * frequency;
            let real = rayleigh(omega) + sign * TAU * split * friction / 0.3;
            let imaginary = omega + sign * TAU * 0.03 * split * (friction / 0.3).powi(2);
            let travels = if friction == 0.0 { 0 } else { direction };
            modes.push(ComplexMode {
                branch,
                shape: mesh.map(|mesh| shape(mesh, harmonic, branch, direction, friction).into()),
                ..mode(c64::new(real, imaginary), harmonic, travels)
            });
        }
    }
    modes.sort_by(|a, b| a.eigenvalue.im.total_cmp(&b.eigenvalue.im));
    modes
}

pub fn sweep(count: usize) -> FrictionSweep {
    let points = (0..count).map(|i| {
        let friction_coefficient = i as f64 / (count - 1) as f64;
        let modes = modes(friction_coefficient, None);
        FrictionPoint { friction_coefficient, modes, above: Vec::new() }
    });
    let mut intervals = Vec::new();
    for [frequency, harmonic, branch, split] in rows_of(PAIRS) {
        let (harmonic, branch) = (harmonic as usize, branch as usize);
        let critical = -0.3 * rayleigh(TAU * frequency) / (TAU * split);
        if split > 0.0 && critical < 1.0 {
            intervals.push(UnstableInterval {
                restabilized: (harmonic == 1 && branch == 2).then_some((0.8, frequency)),
                ..onset((harmonic, branch), critical, frequency)
            });
        }
    }
    intervals.sort_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
    FrictionSweep { points: points.collect(), intervals, ..FrictionSweep::default() }
}

/// A wave of one harmonic, clamped outside, with an arbitrary solver phase; friction shears it.
pub fn shape(mesh: &Mesh, harmonic: usize, branch: usize, direction: i8, mu: f64) -> Vec<c64> {
    let mut out = Vec::with_capacity(2 * mesh.node_count());
    let phase = c64::new(0.3, 0.9);
    for (&[x, y, _], &angle) in mesh.nodes.iter().zip(mesh.frame_angles()) {
        let s = ((x.hypot(y) - 0.0205) / 0.07).clamp(0.0, 1.0);
        let profile = (PI * (branch as f64 + 0.5) * s).cos() * (1.0 - s);
        let swirl = if direction == 0 { 0.0 } else { 1.2 * mu };
        let argument = f64::from(direction) * (harmonic as f64 * angle + swirl * s * 3.0);
        let wave = c64::new(argument.cos(), -argument.sin()) * phase;
        let radial = if harmonic == 0 { 0.0 } else { 0.5 * s * profile };
        out.push(wave * c64::new(0.0, radial));
        out.push(wave * c64::new(profile, 0.0));
    }
    out
}
