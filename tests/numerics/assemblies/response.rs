//! Frequency responses of assemblies against their eigenvalues (cross-method: the response knows no modes).

use super::rotation::{ring, spinning};
use super::*;

const DAMPED: TangentOptions = TangentOptions { damping: rayleigh_damping(30.0, 2e-8), ..OPTIONS };

fn node_at(mesh: &Mesh, place: [f64; 3]) -> usize {
    nearest_by(0..mesh.node_count(), |&node| {
        (0..3).map(|k| (mesh.nodes[node][k] - place[k]).powi(2)).sum()
    })
}

fn terminal(node: usize, direction: Direction) -> Terminal {
    Terminal { node, direction }
}

/// The pole of a response with one mode beside a smooth rest: `h = a + b / (x - p)`, `x = i omega`, from three lines.
fn pole(lines: [f64; 3], h: [c64; 3]) -> c64 {
    let x = lines.map(|f| c64::new(0.0, TAU * f));
    // Differences of `h (x - p) = a x + c`: two equations, linear in `a` and `p`.
    let difference = |k: usize| (h[k] * x[k] - h[0] * x[0], x[k] - x[0], h[k] - h[0]);
    let ((u1, v1, w1), (u2, v2, w2)) = (difference(1), difference(2));
    (u1 * v2 - u2 * v1) / (w1 * v2 - w2 * v1)
}

/// Pole and eigenvalue of the lowest mode agree at two friction coefficients, on a rigid contact and on springs.
#[test]
fn the_response_of_a_sliding_assembly_has_the_poles_of_its_eigenvalue_analysis() {
    let mesh = bar();
    let axis = Axis { center: [1.0, 0.3, 0.0], direction: [0.0, 0.0, 1.0] };
    for normal_stiffness in [None, Some(1e14)] {
        let assembly = pressed(&mesh, normal_stiffness);
        for friction in [0.2, 0.5] {
            let tangent = tangent_at(&assembly, friction, &DAMPED);
            let lambda = modes_at(&tangent, friction, Lowest(2))[0].eigenvalue;
            let system = FrfSystem::sliding(&tangent, friction);
            let port = |place, direction, key| {
                let terminal = terminal(node_at(&mesh, place), direction);
                system.port(&mesh, Some(axis), terminal, key).unwrap()
            };
            let force = port([0.05, 0.04, 0.035], Direction::Tangential, "force_node");
            let response = port([0.05, 0.04, 0.0], Direction::X, "response_node");
            let lines = [-1e-4, 0.0, 1e-4].map(|shift| lambda.im / TAU * (1.0 + shift));
            let h = direct_response(&system, &force, &response, &lines, &|_| {}).unwrap();
            let found = pole(lines, [h[0], h[1], h[2]]);
            // The other modes are a constant beside it to the square of the lines' distance, relative to theirs.
            near_each(&[found], &[lambda], 1e-6);
        }
    }
}

/// Cross-method: two tied halves respond like the whole, and a node that follows another can be observed, not excited.
#[test]
fn tied_halves_respond_like_the_whole() {
    let clamped = |name| [(name, Clamped)];
    let whole = [brick("bar", [0.0; 3], [0.12, 0.02, 0.02], [6, 2, 2])];
    let halves = [
        brick("left", [0.0; 3], [0.06, 0.02, 0.02], [3, 2, 2]),
        brick("right", [0.06, 0.0, 0.0], [0.06, 0.02, 0.02], [3, 2, 2]),
    ];
    let lines = [500.0, 1300.0, 4000.0];
    let responses = [(whole.as_slice(), "bar_x0"), (&halves, "left_x0")].map(|(blocks, held)| {
        let mesh = mesh_of(&file_of(blocks, |point| point), &clamped(held));
        let ties: Vec<TiedSurfaces> =
            (blocks.len() == 2).then(|| tie(&mesh, "right_x0", "left_x1")).into_iter().collect();
        let tied = Assembly::new(&mesh, &STEEL, (&ties, &[]), (&[], Closed), Consistent).unwrap();
        let tangent = tangent_at(&tied, 0.0, &DAMPED);
        let system = FrfSystem::sliding(&tangent, 0.0);
        let tip = terminal(node_at(&mesh, [0.12, 0.02, 0.02]), Direction::Z);
        let middle = terminal(node_at(&mesh, [0.08, 0.0, 0.0]), Direction::Y);
        let force = system.port(&mesh, None, tip, "force_node").unwrap();
        let response = system.port(&mesh, None, middle, "response_node").unwrap();
        if let [tie] = ties.as_slice() {
            let glued = terminal(mesh.boundaries[tie.surface].nodes[0] as usize, Direction::Z);
            let refused = system.port(&mesh, None, glued, "force_node").unwrap_err();
            assert!(refused.to_string().contains("slides on another, and follows it"), "{refused}");
            let observed = system.port(&mesh, None, glued, "response_node").unwrap();
            let there = direct_response(&system, &force, &observed, &lines, &|_| {});
            assert!(there.unwrap().iter().all(|h| h.norm() > 0.0));
        }
        direct_response(&system, &force, &response, &lines, &|_| {}).unwrap()
    });
    near_each(&responses[1], &responses[0], 1e-9);
}

/// Independent: all unknowns as one dense system of real numbers, `[A -B; B A] [x; y] = [f; 0]` with `A = K - omega^2 M` and
/// `B = omega C`, for a ring that its bore holds in both frames. Undamped and gyroscopic, its matrix is Hermitian: each port answers its own
/// force with a real figure, and two ports each other with conjugate ones.
#[test]
fn a_turning_ring_responds_like_the_dense_system_of_its_matrices() {
    for frame in [RotationFrame::Rest, RotationFrame::Turning] {
        let (mesh, seam) = ring([2, 24, 1], Clamped);
        let tangent = tangent_at(&spinning(&mesh, &seam, 300.0, frame), 0.0, &OPTIONS);
        let system = FrfSystem::sliding(&tangent, 0.0);
        let node = node_at(&mesh, [0.0, 0.15, 0.005]);
        let ports = [Direction::X, Direction::Y].map(|direction| {
            let terminal = terminal(node, direction);
            system.port(&mesh, None, terminal, "force_node").unwrap()
        });
        let unknowns = [0, 1].map(|axis| tangent.unknowns.unknown_of[3 * node + axis].unwrap());
        for line in [400.0, 850.0, 2000.0] {
            let mut found = [[c64::new(0.0, 0.0); 2]; 2];
            for ((force, unknown), row) in ports.iter().zip(unknowns).zip(&mut found) {
                let exact = dense_response(&tangent, TAU * line, unknown);
                let exact = unknowns.map(|unknown| exact[unknown]);
                let largest = exact[0].norm().max(exact[1].norm());
                for ((observed, exact), place) in ports.iter().zip(exact).zip(row) {
                    let response = direct_response(&system, force, observed, &[line], &|_| {});
                    *place = response.unwrap()[0];
                    let error = (*place - exact).norm() / largest;
                    below(error, 1e-9, format!("{frame:?} {line} Hz: {place} {exact}"));
                }
            }
            let [[xx, xy], [yx, yy]] = found;
            let scale = xx.norm();
            assert!(xx.im.abs() < 1e-9 * scale && yy.im.abs() < 1e-9 * scale);
            assert!((xy - yx.conj()).norm() < 1e-9 * scale && xy.im.abs() > 1e-5 * scale);
        }
    }
}

/// All unknowns under a force of 1 N on one of them, by LU of the whole real system.
fn dense_response(tangent: &SlidingTangent, omega: f64, force: usize) -> Vec<c64> {
    let n = tangent.mass.dimension();
    let [mass, damping, stiffness] =
        [&tangent.mass, &tangent.damping, &tangent.stiffness].map(|p| dense(p, 0.0));
    let whole = Mat::from_fn(2 * n, 2 * n, |i, j| {
        let at = (i % n, j % n);
        match (i < n, j < n) {
            (true, false) => -omega * damping[at],
            (false, true) => omega * damping[at],
            _ => stiffness[at] - omega * omega * mass[at],
        }
    });
    let load = Mat::from_fn(2 * n, 1, |i, _| f64::from(u8::from(i == force)));
    let x = whole.partial_piv_lu().solve(&load);
    (0..n).map(|k| c64::new(x[(k, 0)], x[(n + k, 0)])).collect()
}
