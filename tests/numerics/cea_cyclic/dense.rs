//! Independent checks: dense solutions of harmonics folded from the matrices of the full mesh.

use crate::prelude::*;

/// Harmonic `n` of a matrix of the full mesh: couplings of the first sector's unknowns with everything,
/// weighted with the wave's phase. Exact, because in polar frames every sector has the same rows.
pub fn fold(
    tangent: &SlidingTangent,
    mesh: &AnnulusMesh,
    polynomial: &MatrixPolynomial,
    mu: f64,
    n: i32,
) -> Mat<c64> {
    let values = polynomial.evaluate(mu);
    let pattern = polynomial.pattern();
    let per_sector = mesh.sector_node_count();
    let in_first = |dof: usize| dof / 2 < per_sector;
    let count = tangent.unknowns.dofs.iter().filter(|&&dof| in_first(dof)).count();
    let mut folded = Mat::zeros(count, count);
    for column in 0..pattern.dimension() {
        let dof = tangent.unknowns.dofs[column];
        let home = tangent.unknowns.unknown_of[dof % (2 * per_sector)].unwrap();
        for place in pattern.column_pointers()[column]..pattern.column_pointers()[column + 1] {
            let row = pattern.row_indices()[place];
            if row < count {
                let angle = |dof: usize| mesh.mesh.frame_angles()[dof / 2];
                let phase = f64::from(n) * (angle(dof) - angle(tangent.unknowns.dofs[row]));
                folded[(row, home)] += c64::new(phase.cos(), phase.sin()) * values[place];
            }
        }
    }
    folded
}

/// Every eigenvalue of `lambda^2 M + lambda C + K`, through the companion matrix scaled by `scale`.
pub fn dense_quadratic(m: &Mat<c64>, c: &Mat<c64>, k: &Mat<c64>, scale: f64) -> Vec<c64> {
    let n = m.nrows();
    let lu = m.partial_piv_lu();
    let (mk, mc) = (lu.solve(k), lu.solve(c));
    let companion = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => c64::new(0.0, 0.0),
        (true, false) => c64::new(if i == j - n { scale } else { 0.0 }, 0.0),
        (false, true) => -mk[(i - n, j)] / scale,
        (false, false) => -mc[(i - n, j - n)],
    });
    companion.eigenvalues().unwrap()
}

/// Every `lambda` with `Im > 0` of one signed harmonic, by dense linear algebra on the folded matrices of the full mesh.
fn dense_eigenvalues(tangent: &SlidingTangent, mesh: &AnnulusMesh, mu: f64, n: i32) -> Vec<c64> {
    let folded = |p: &MatrixPolynomial| fold(tangent, mesh, p, mu, n);
    let (m, k) = (folded(&tangent.mass), folded(&tangent.stiffness));
    let all = match tangent.proportional {
        Some(RayleighDamping { mass_coefficient: alpha, stiffness_coefficient: beta }) => {
            let kappas = m.partial_piv_lu().solve(&k).eigenvalues().unwrap();
            let roots = kappas.into_iter().flat_map(|kappa| {
                let half = (alpha + beta * kappa) * 0.5;
                let root = (half * half - kappa).sqrt();
                [root - half, -root - half]
            });
            roots.collect()
        }
        None => dense_quadratic(&m, &folded(&tangent.damping), &k, 1e6),
    };
    all.into_iter().filter(|lambda| lambda.im > 0.0).collect()
}

/// Largest relative distance of the cyclic modes to the dense ones of their signed harmonic; panics unless
/// both have equally many modes below the limit, for every harmonic of the mesh.
fn worst_difference(model: &AnnulusModel, frictions: &[f64], limit_hz: f64) -> f64 {
    let cyclic = model.swept(frictions, MaxFrequency(limit_hz));
    let mesh = AnnulusMesh::generate(&model.specification).unwrap();
    let tangent = model.whole();
    let sectors = mesh.sector_count() as i32;
    let against: i8 = if model.contact.rotation_speed < 0.0 { 1 } else { -1 };
    let mut worst = 0.0_f64;
    for (point, &mu) in cyclic.sweep.points.iter().zip(frictions) {
        for n in (1 - sectors) / 2..=sectors / 2 {
            let mut dense = dense_eigenvalues(&tangent, &mesh, mu, n);
            // Completeness holds for |Re| up to a fifth of the limit; beyond are overdamped motions.
            let limit = TAU * limit_hz;
            let is_wanted =
                |l: &c64| l.im < limit && l.im > 0.02 * limit && l.re.abs() < 0.2 * limit;
            dense.retain(is_wanted);
            let is_standing = n == 0 || 2 * n == sectors;
            let direction = if is_standing { 0 } else { against * n.signum() as i8 };
            let modes = point.modes.iter().filter(|mode| {
                mode.harmonic == n.unsigned_abs() as usize
                    && (mode.direction == direction || mu == 0.0)
            });
            let modes: Vec<c64> = modes.map(|mode| mode.eigenvalue).filter(is_wanted).collect();
            let copies = if mu == 0.0 && !is_standing { 2 } else { 1 };
            assert_eq!(modes.len(), copies * dense.len(), "{n} at {mu}: {modes:?} {dense:?}");
            worst = worst.max(largest_error(&dense, &modes));
        }
    }
    worst
}

/// Independent check: dense solution of every harmonic, folded from the matrices of the full mesh.
#[test]
fn spectrum_equals_dense_solution_of_every_harmonic_of_the_full_mesh() {
    for (element, n_theta) in [(Quad4, 24), (Quad4, 17), (Quad8, 12)] {
        for mass in [Consistent, Lumped] {
            for normal_stiffness in [None, Some(7.4e12)] {
                for geometric_stiffness in [false, true] {
                    let mut model = paper(element, n_theta, 6);
                    model.options.mass = mass;
                    model.options.contact.normal_stiffness = normal_stiffness;
                    model.options.geometric_stiffness = geometric_stiffness;
                    if geometric_stiffness {
                        // A strong prestress, and the other sense of rotation.
                        model.contact.interference = 4e-4;
                        model.contact.rotation_speed = -60.0;
                    }
                    let worst = worst_difference(&model, &[0.0, 0.3, 0.9], 17500.0);
                    // Dense solvers leave a few ulps of the mesh's largest eigenvalue, 1e3 times these.
                    assert!(worst < 1e-10, "{element:?} {mass:?} {normal_stiffness:?} {worst:e}");
                }
            }
        }
    }
}

/// Independent check: models drawn from wide ranges, each against dense solutions of all its harmonics.
#[test]
fn random_models_lose_no_mode_and_gain_none() {
    let mut random = crate::draws::draws(1_234_567_891_234_567);
    for index in 0..40 {
        let mut choose = |count: usize| (random() * count as f64) as usize;
        let element = [Quad4, Quad8][choose(2)];
        let mut model = paper(element, 11 + choose(12), 2 + choose(5));
        let AnnulusModel { specification, material, options, contact } = &mut model;
        material.formulation = [PlaneStrain, PlaneStress][choose(2)];
        options.mass = [Consistent, Lumped][choose(2)];
        options.geometric_stiffness = choose(3) > 0;
        let is_penalty = choose(5) > 1;
        let has_dashpots = choose(3) == 0;
        options.contact.normal_stiffness = is_penalty.then(|| 10_f64.powf(9.0 + 5.0 * random()));
        if has_dashpots {
            options.contact.tangential_damping = 1e5 * random();
            options.contact.normal_damping = if is_penalty { 1e6 * random() } else { 0.0 };
        }
        options.damping.stiffness_coefficient = 4.5e-6 * random();
        specification.radial_grading = 0.8 + 0.5 * random();
        specification.inner_radius = 0.01 + 0.06 * random();
        material.poisson_ratio = -0.2 + 0.69 * random();
        contact.interference = 1e-3 * random();
        contact.rotation_speed = if random() < 0.5 { -3.0 } else { 9.0 };
        let frictions = [0.0, 0.5 * random(), 0.5 + 1.5 * random()];
        let limit = 6000.0 + 12000.0 * random();
        below(worst_difference(&model, &frictions, limit), 1e-9, format_args!("model {index}"));
    }
}

/// Two real eigenvalues of the shortest wave of a coarse mesh meet and go on as a conjugate pair.
#[test]
fn branches_of_a_standing_harmonic_that_meet_are_left_to_the_whole_mesh() {
    let mut model = paper(Quad8, 10, 4);
    model.options.mass = Lumped;
    model.options.damping.stiffness_coefficient = 3.195e-6;
    model.options.contact.normal_stiffness = Some(3e11);
    model.contact.interference = 9.876e-5;
    model.material.poisson_ratio = 0.266;
    model.material.formulation = PlaneStress;
    model.specification.inner_radius = 0.0387;
    model.specification.radial_grading = 1.09;
    let frictions = [0.0, 0.1, 0.2, 0.25, 0.3, 0.5, 0.7];
    let lost = model.sweep(&sweep_request(&frictions, MaxFrequency(19585.0))).unwrap_err();
    assert!(matches!(lost, CeaError::LostHarmonic { harmonic: 5, .. }), "{lost}");
    let plain = WaveModel { material: POLYCARBONATE, contact: contact(610.0), ..model };
    let found = plain.swept(&frictions, MaxFrequency(19585.0));
    assert_eq!(found.coverage.largest_harmonic, 5);
}
