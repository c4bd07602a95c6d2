//! Poles of the response of sliding bodies of revolution against eigenvalues of `cea`. Cross-method: the response knows no modes.

use super::*;
use crate::solids::response::{at, sliding};

/// Distance of the response's nearest pole from `lambda / 2 pi`, Hz, from lines up to `range` (Hz) around `Im lambda / 2 pi`.
///
/// Beside `poles` poles `h q(x) = p(x)`, `x = i (f - f_0)`, of that degree, `q` with leading one: as many equations as lines.
fn pole_beside(model: &SolidModel, mu: f64, lambda: c64, (poles, range): (usize, f64)) -> c64 {
    let sector = SolidSector::generate(&model.specification).unwrap();
    let [_, nz] = sector.specification.divisions();
    let node = at(&sector, 2, [0, 2 * nz], 0, Tangential);
    let count = 2 * poles + 1;
    // None of the lines is at the eigenvalue itself: at an onset there is no response.
    let steps: Vec<f64> = (0..count).map(|k| (k as f64 + 0.25) / poles as f64 - 1.0).collect();
    let lines: Vec<f64> = steps.iter().map(|d| lambda.im / TAU + d * range).collect();
    let h = cyclic_response(&sliding(model, mu), node, node, &lines).unwrap();
    let largest = h.receptance.iter().fold(0.0_f64, |m, h| m.max(h.norm()));
    let h: Vec<c64> = h.receptance.iter().map(|h| h * largest.recip()).collect();
    let power = |k: usize, j: usize| c64::new(0.0, steps[k]).powu(j as u32);
    let entry = |k, j| if j < poles { h[k] * power(k, j) } else { -power(k, j - poles) };
    let matrix = Mat::from_fn(count, count, entry);
    let mut q = Mat::from_fn(count, 1, |k, _| -h[k] * power(k, poles));
    ComplexDenseLu::factorize(matrix).solve_in_place(q.as_mut());
    // Newton's method from the eigenvalue.
    let mut x = c64::new(lambda.re / (TAU * range), 0.0);
    for _ in 0..20 {
        let (mut value, mut slope) = (c64::new(1.0, 0.0), c64::new(0.0, 0.0));
        for j in (0..poles).rev() {
            slope = slope * x + value;
            value = value * x + q[(j, 0)];
        }
        x -= value / slope;
    }
    x * range - lambda.re / TAU
}

/// At every onset below 12 kHz: on rigid contact, on springs that carry the base state, on which all of the tangent rests, and on contact
/// that stiffens, which carries it too and whose tangent has the stiffness at the pressure there.
#[test]
fn the_response_has_its_pole_on_the_axis_at_every_critical_friction_of_the_eigenvalue_analysis() {
    let both = [(Quad4, [24, 6, 2]), (Quad8, [16, 4, 1])];
    let springs =
        ContactStiffness { normal_stiffness: Some(1e12), is_base_compliant: true, ..RIGID };
    let law = exponential(2e5, 2e-6);
    for (contact, bricks) in [(RIGID, &both[..1]), (springs, &both), (stiffening(law), &both)] {
        for &(element, divisions) in bricks {
            let mut model = disc(element, divisions);
            model.options.geometric_stiffness = true;
            model.options.contact = contact;
            let frictions = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];
            let mut onsets = model.swept(&frictions, MaxFrequency(12e3)).sweep.intervals;
            onsets.retain(|own| !own.unstable_from_start);
            assert!(onsets.len() >= 2, "{onsets:?}");
            for onset in onsets {
                let lambda = c64::new(0.0, TAU * onset.frequency_hz);
                let pole = pole_beside(&model, onset.critical_friction, lambda, (1, 1.0));
                // Onsets are located to 1e-9; what the reduced space of the eigenvalue analysis leaves out of a mesh that fine.
                assert!(pole.norm() < 1e-6 * onset.frequency_hz, "{onset:?}: {pole}");
            }
        }
    }
}

/// Around, bricks of 20 nodes have the traction of a point act along the normals of nodes beside it: a term of `mu^2`.
#[test]
fn friction_that_falls_with_speed_gives_the_response_the_poles_of_the_eigenvalue_analysis() {
    for (element, divisions) in [(Quad4, [16, 3, 2]), (Quad8, [8, 3, 1])] {
        let mut model = disc(element, divisions);
        model.contact.decay = Some(FrictionDecay { static_ratio: 2.0, decay_speed: 1.0 });
        let friction = 0.8;
        let found = modes(&model, friction, 10e3);
        // The others hardly oscillate across the sliding.
        let sharp = found.iter().filter(|mode| mode.damping_factor().abs() < 0.05);
        let distances = sharp.map(|mode| {
            let lambda = mode.eigenvalue;
            let pole = pole_beside(&model, friction, lambda, (8, 0.06 * lambda.im / TAU));
            pole.norm() / lambda.norm() * TAU
        });
        let distances: Vec<f64> = distances.collect();
        assert!(distances.len() >= 4);
        let worst = distances.into_iter().fold(0.0, f64::max);
        // Of the sharpest mode 1e-12; the broadest, damped by a factor of 0.04, is told from its neighbours less well. Without the
        // term of mu^2 the bricks of 20 nodes are 1.7e-4 off.
        below(worst, 5e-6, format_args!("{element:?}"));
    }
}
