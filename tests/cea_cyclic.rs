//! The cyclic eigenvalue analysis against theory, dense solutions and the paper.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};
use frictionsim::cea::cyclic::{
    CyclicModel, CyclicSweep, ModeBranch, ModeLimit, Sensitivity, SweepRequest, sensitivities,
    stability_map, sweep,
};
use frictionsim::cea::sparse::{self, EigenLimit, EigenRequest};
use frictionsim::cea::{ComplexMode, UnstableInterval};
use frictionsim::contact::{ContactStiffness, SlidingContact};
use frictionsim::fem::{
    ElasticMaterial, MassKind, PlaneFormulation, RayleighDamping, assemble_stiffness,
};
use frictionsim::linalg::MatrixPolynomial;
use frictionsim::mesh::{AnnulusMesh, AnnulusSpecification, ElementKind};
use frictionsim::prestress::{DampingModel, SlidingTangent, SteadySliding, TangentOptions};
use std::f64::consts::{PI, TAU};

fn annulus(element: ElementKind, circumferential: usize, radial: usize) -> AnnulusSpecification {
    AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: circumferential,
        radial_elements: radial,
        radial_grading: 1.0,
        element,
    }
}

fn polycarbonate() -> ElasticMaterial {
    ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.3805,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
    }
}

fn paper_options() -> TangentOptions {
    TangentOptions {
        mass: MassKind::Consistent,
        geometric_stiffness: true,
        damping: RayleighDamping {
            mass_coefficient: 40.0,
            stiffness_coefficient: 4.5e-7,
        },
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness {
            normal_stiffness: Some(7.4e12),
            normal_damping: 0.0,
            tangential_damping: 0.0,
        },
    }
}

fn paper_contact() -> SlidingContact {
    SlidingContact {
        friction_coefficient: 0.3,
        interference: 25e-6,
        rotation_speed: 610.0 * PI / 30.0,
    }
}

fn run(
    specification: &AnnulusSpecification,
    options: &TangentOptions,
    frictions: &[f64],
    limit: ModeLimit,
) -> CyclicSweep {
    let request = SweepRequest {
        friction_coefficients: frictions,
        limit,
        shapes_at: &[],
    };
    sweep(
        specification,
        &polycarbonate(),
        options,
        &paper_contact(),
        &request,
    )
    .unwrap()
}

/// Harmonic `n` of a matrix of the full mesh: couplings of the first sector's unknowns with everything,
/// weighted with the wave's phase.
fn fold(
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
    let count = tangent
        .unknowns
        .dofs
        .iter()
        .filter(|&&dof| in_first(dof))
        .count();
    let mut folded = Mat::zeros(count, count);
    for column in 0..pattern.dimension() {
        let dof = tangent.unknowns.dofs[column];
        let home = tangent.unknowns.unknown_of[dof % (2 * per_sector)].unwrap();
        for place in pattern.column_pointers()[column]..pattern.column_pointers()[column + 1] {
            let row = pattern.row_indices()[place];
            if row < count {
                let angle = |dof: usize| mesh.mesh.frame_angles[dof / 2];
                let phase = f64::from(n) * (angle(dof) - angle(tangent.unknowns.dofs[row]));
                folded[(row, home)] += c64::new(phase.cos(), phase.sin()) * values[place];
            }
        }
    }
    folded
}

/// Every eigenvalue of `lambda^2 M + lambda C + K`, through the companion matrix scaled by `scale`.
fn dense_quadratic(m: &Mat<c64>, c: &Mat<c64>, k: &Mat<c64>, scale: f64) -> Vec<c64> {
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

/// Every `lambda` with `Im > 0` of one signed harmonic, by dense linear algebra on the folded matrices of
/// the full mesh.
fn dense_eigenvalues(tangent: &SlidingTangent, mesh: &AnnulusMesh, mu: f64, n: i32) -> Vec<c64> {
    let folded = |p: &MatrixPolynomial| fold(tangent, mesh, p, mu, n);
    let (m, k) = (folded(&tangent.mass), folded(&tangent.stiffness));
    let all = match tangent.proportional {
        Some(RayleighDamping {
            mass_coefficient: alpha,
            stiffness_coefficient: beta,
        }) => {
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
fn worst_difference(
    specification: &AnnulusSpecification,
    material: &ElasticMaterial,
    options: &TangentOptions,
    contact: &SlidingContact,
    frictions: &[f64],
    limit_hz: f64,
) -> f64 {
    let request = SweepRequest {
        friction_coefficients: frictions,
        limit: ModeLimit::MaxFrequency(limit_hz),
        shapes_at: &[],
    };
    let cyclic = sweep(specification, material, options, contact, &request).unwrap();
    let mesh = AnnulusMesh::generate(specification).unwrap();
    let elastic = assemble_stiffness(&mesh.mesh, material);
    let base = SteadySliding::solve(&mesh.mesh, &elastic, contact).unwrap();
    let tangent = SlidingTangent::linearize(&mesh.mesh, material, &elastic, &base, options);
    let sectors = mesh.sector_count() as i32;
    let against: i8 = if contact.rotation_speed < 0.0 { 1 } else { -1 };
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
            let direction = if is_standing {
                0
            } else {
                against * n.signum() as i8
            };
            let modes = point.modes.iter().filter(|mode| {
                mode.harmonic == n.unsigned_abs() as usize
                    && (mode.direction == direction || mu == 0.0)
            });
            let modes: Vec<c64> = modes
                .map(|mode| mode.eigenvalue)
                .filter(is_wanted)
                .collect();
            let copies = if mu == 0.0 && !is_standing { 2 } else { 1 };
            assert_eq!(
                modes.len(),
                copies * dense.len(),
                "{n} at {mu}: {modes:?} {dense:?}"
            );
            for lambda in &modes {
                let nearest = dense
                    .iter()
                    .map(|d| (d - lambda).norm())
                    .fold(f64::MAX, f64::min);
                worst = worst.max(nearest / lambda.norm());
            }
        }
    }
    worst
}

/// Independent check: dense solution of every harmonic, folded from the matrices of the full mesh.
#[test]
fn spectrum_equals_dense_solution_of_every_harmonic_of_the_full_mesh() {
    for (element, n_theta) in [
        (ElementKind::Quad4, 24),
        (ElementKind::Quad4, 17),
        (ElementKind::Quad8, 12),
    ] {
        for mass in [MassKind::Consistent, MassKind::Lumped] {
            for normal_stiffness in [None, Some(7.4e12)] {
                for geometric_stiffness in [false, true] {
                    let mut options = paper_options();
                    options.mass = mass;
                    options.contact.normal_stiffness = normal_stiffness;
                    options.geometric_stiffness = geometric_stiffness;
                    let mut contact = paper_contact();
                    if geometric_stiffness {
                        // A strong prestress, and the other sense of rotation.
                        contact.interference = 4e-4;
                        contact.rotation_speed = -60.0;
                    }
                    let specification = annulus(element, n_theta, 6);
                    let worst = worst_difference(
                        &specification,
                        &polycarbonate(),
                        &options,
                        &contact,
                        &[0.0, 0.3, 0.9],
                        17500.0,
                    );
                    // Dense solvers leave a few ulps of the mesh's largest eigenvalue, 1e3 times these.
                    assert!(
                        worst < 1e-10,
                        "{element:?} {mass:?} {normal_stiffness:?} {worst:e}"
                    );
                }
            }
        }
    }
}

/// Independent check: companion matrix of the quadratic problem, damping that is not proportional.
#[test]
fn quadratic_problem_equals_dense_companion_solution() {
    for damping_model in [DampingModel::WholeTangent, DampingModel::BodyOnly] {
        for (normal_stiffness, normal_damping, tangential_damping) in [
            (None, 0.0, 1e4),
            (Some(7.4e12), 2e6, 3e4),
            (Some(7.4e12), 0.0, 0.0),
        ] {
            let mut options = paper_options();
            options.damping_model = damping_model;
            options.contact = ContactStiffness {
                normal_stiffness,
                normal_damping,
                tangential_damping,
            };
            for element in [ElementKind::Quad4, ElementKind::Quad8] {
                let worst = worst_difference(
                    &annulus(element, 14, 5),
                    &polycarbonate(),
                    &options,
                    &paper_contact(),
                    &[0.0, 0.4, 1.0],
                    15000.0,
                );
                println!("{damping_model:?} {element:?} {worst:e}");
                assert!(worst < 1e-9, "{damping_model:?} {element:?} {worst:e}");
            }
        }
    }
}

/// Cross-method check: the sparse solver on the whole mesh, which knows nothing of the symmetry.
#[test]
fn spectrum_branches_and_onsets_equal_those_of_the_sparse_solver() {
    let frictions = [0.0, 0.3, 0.6];
    for (element, sectors, mass, normal_stiffness) in [
        (ElementKind::Quad4, 36, MassKind::Consistent, Some(7.4e12)),
        (ElementKind::Quad4, 36, MassKind::Lumped, None),
        (ElementKind::Quad8, 18, MassKind::Consistent, None),
        (ElementKind::Quad8, 18, MassKind::Lumped, Some(7.4e12)),
    ] {
        let mut options = paper_options();
        options.mass = mass;
        options.contact.normal_stiffness = normal_stiffness;
        let specification = annulus(element, sectors, 6);
        let cyclic = run(&specification, &options, &frictions, ModeLimit::Lowest(18)).sweep;
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let (material, contact) = (polycarbonate(), paper_contact());
        let elastic = assemble_stiffness(&mesh, &material);
        let base = SteadySliding::solve(&mesh, &elastic, &contact).unwrap();
        let tangent = SlidingTangent::linearize(&mesh, &material, &elastic, &base, &options);
        let request = EigenRequest {
            limit: EigenLimit::Lowest(18),
            shapes_at: Vec::new(),
        };
        let sparse = sparse::sweep(&tangent, &frictions, &request, &|_| {}).unwrap();
        for (ours, theirs) in cyclic.points.iter().zip(&sparse.points) {
            assert_eq!(ours.modes.len(), theirs.modes.len());
            for mode in &ours.modes {
                let distance = |m: &&ComplexMode| (m.eigenvalue - mode.eigenvalue).norm();
                let is_same = |m: &&ComplexMode| {
                    (m.harmonic, m.branch, m.direction)
                        == (mode.harmonic, mode.branch, mode.direction)
                };
                let same = theirs.modes.iter().filter(is_same);
                let nearest = same.map(|m| distance(&m)).fold(f64::MAX, f64::min);
                assert!(
                    nearest < 1e-9 * mode.eigenvalue.norm(),
                    "{element:?} {mass:?} {mode:?} {nearest:e}"
                );
            }
        }
        for (ours, theirs) in cyclic.intervals.iter().zip(&sparse.intervals) {
            assert_eq!(
                (ours.harmonic, ours.direction),
                (theirs.harmonic, theirs.direction)
            );
            assert!((ours.critical_friction - theirs.critical_friction).abs() < 1e-8);
        }
    }
}

/// One eigenvalue of a changed model, by following its branch.
fn eigenvalue_of(model: &CyclicModel, like: &Sensitivity, friction: f64) -> c64 {
    let request = SweepRequest {
        friction_coefficients: &[friction],
        limit: ModeLimit::MaxFrequency(17600.0),
        shapes_at: &[],
    };
    let found = sweep(
        &model.specification,
        &model.material,
        &model.options,
        &model.contact,
        &request,
    )
    .unwrap();
    let is_same = |b: &&ModeBranch| {
        (b.harmonic, b.branch, b.direction) == (like.harmonic, like.branch, like.direction)
    };
    found
        .branches
        .iter()
        .find(is_same)
        .unwrap()
        .interpolate(friction)
        .unwrap()
}

/// Independent check: central differences of the whole analysis, prestress included.
#[test]
fn sensitivities_equal_finite_differences() {
    let mut rigid = paper_options();
    rigid.contact.normal_stiffness = None;
    let mut dashpots = paper_options();
    dashpots.damping_model = DampingModel::BodyOnly;
    dashpots.contact.normal_damping = 1e5;
    for (options, formulation, element) in [
        (
            paper_options(),
            PlaneFormulation::PlaneStrain,
            ElementKind::Quad4,
        ),
        (rigid, PlaneFormulation::PlaneStress, ElementKind::Quad8),
        (dashpots, PlaneFormulation::PlaneStrain, ElementKind::Quad4),
    ] {
        let mut contact = paper_contact();
        // A strong prestress, so that its share cannot hide.
        contact.interference = 3e-4;
        let material = ElasticMaterial {
            formulation,
            ..polycarbonate()
        };
        let model = CyclicModel {
            specification: annulus(element, 24, 6),
            material,
            options,
            contact,
        };
        let friction = 0.35;
        let request = SweepRequest {
            friction_coefficients: &[0.0, friction],
            limit: ModeLimit::MaxFrequency(12000.0),
            shapes_at: &[],
        };
        let found = sweep(
            &model.specification,
            &model.material,
            &model.options,
            &model.contact,
            &request,
        )
        .unwrap();
        for s in sensitivities(&found, friction).unwrap() {
            let difference = |step: f64, change: &dyn Fn(&mut CyclicModel, f64)| {
                let at = |offset: f64| {
                    let mut changed = model;
                    change(&mut changed, offset);
                    eigenvalue_of(&changed, &s, friction)
                };
                // Fourth order, so that the step may stay far above round-off.
                ((at(step) - at(-step)) * 8.0 - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step)
            };
            let k_n = options.contact.normal_stiffness.unwrap_or(1.0);
            let checks = [
                (
                    "nu",
                    1.0,
                    s.poisson_ratio,
                    difference(1e-3, &|m, h| m.material.poisson_ratio += h),
                ),
                (
                    "E",
                    2.5e9,
                    s.young_modulus,
                    difference(2e7, &|m, h| m.material.young_modulus += h),
                ),
                (
                    "rho",
                    1228.0,
                    s.density,
                    difference(10.0, &|m, h| m.material.density += h),
                ),
                (
                    "alpha",
                    40.0,
                    s.mass_coefficient,
                    difference(1.0, &|m, h| m.options.damping.mass_coefficient += h),
                ),
                (
                    "beta",
                    4.5e-7,
                    s.stiffness_coefficient,
                    difference(1e-8, &|m, h| m.options.damping.stiffness_coefficient += h),
                ),
                (
                    "k_n",
                    k_n,
                    s.normal_stiffness.unwrap_or(c64::new(0.0, 0.0)),
                    difference(k_n * 0.01, &|m, h| {
                        if let Some(k) = &mut m.options.contact.normal_stiffness {
                            *k += h;
                        }
                    }),
                ),
            ];
            for (name, scale, analytic, numeric) in checks {
                // Relative to the change over the parameter's own size, and to |lambda| where that is tiny.
                let error = (analytic - numeric).norm() * scale;
                let size = (numeric * scale).norm() + 1e-3 * s.eigenvalue.norm();
                assert!(
                    error < 2e-7 * size,
                    "{element:?} {name} {s:?} {numeric} {:e}",
                    error / size
                );
            }
            let at = |mu: f64| eigenvalue_of(&model, &s, mu);
            let h = 1e-3;
            let numeric = ((at(friction + h) - at(friction - h)) * 8.0
                - (at(friction + 2.0 * h) - at(friction - 2.0 * h)))
                / (12.0 * h);
            assert!((numeric - s.friction).norm() < 1e-9 * s.eigenvalue.norm());
        }
    }
}

/// Independent check: models drawn from wide ranges, each against dense solutions of all its harmonics.
#[test]
fn random_models_lose_no_mode_and_gain_none() {
    let mut state = 1_234_567_891_234_567_u64;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for index in 0..40 {
        let mut choose = |count: usize| (random() * count as f64) as usize;
        let element = [ElementKind::Quad4, ElementKind::Quad8][choose(2)];
        let mut specification = annulus(element, 11 + choose(12), 2 + choose(5));
        let formulation = [PlaneFormulation::PlaneStrain, PlaneFormulation::PlaneStress][choose(2)];
        let mut options = paper_options();
        options.mass = [MassKind::Consistent, MassKind::Lumped][choose(2)];
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
        let material = ElasticMaterial {
            poisson_ratio: -0.2 + 0.69 * random(),
            formulation,
            ..polycarbonate()
        };
        let mut contact = paper_contact();
        contact.interference = 1e-3 * random();
        contact.rotation_speed = if random() < 0.5 { -3.0 } else { 9.0 };
        let frictions = [0.0, 0.5 * random(), 0.5 + 1.5 * random()];
        let limit = 6000.0 + 12000.0 * random();
        let worst = worst_difference(
            &specification,
            &material,
            &options,
            &contact,
            &frictions,
            limit,
        );
        assert!(worst < 1e-9, "model {index}: {worst:e}");
    }
}

/// Two real eigenvalues of the shortest wave of a coarse mesh meet and go on as a conjugate pair.
#[test]
fn branches_of_a_standing_harmonic_that_meet_are_followed_beyond() {
    let mut options = paper_options();
    options.mass = MassKind::Lumped;
    options.damping.stiffness_coefficient = 3.195e-6;
    options.contact.normal_stiffness = Some(3e11);
    let mut contact = paper_contact();
    contact.interference = 9.876e-5;
    let material = ElasticMaterial {
        poisson_ratio: 0.266,
        formulation: PlaneFormulation::PlaneStress,
        ..polycarbonate()
    };
    let mut specification = annulus(ElementKind::Quad8, 10, 4);
    specification.inner_radius = 0.0387;
    specification.radial_grading = 1.09;
    let frictions = [0.0, 0.1, 0.2, 0.25, 0.3, 0.5, 0.7];
    let worst = worst_difference(
        &specification,
        &material,
        &options,
        &contact,
        &frictions,
        19585.0,
    );
    assert!(worst < 1e-9, "{worst:e}");
    let found = run(
        &specification,
        &options,
        &frictions,
        ModeLimit::MaxFrequency(19585.0),
    );
    assert_eq!(found.coverage.largest_harmonic, 5);
}

/// Table 1 of Brunetti et al. at friction 0.3: mode, Re / 2 pi and Im / 2 pi in Hz, harmonic.
const TABLE_1: [(f64, f64, usize); 28] = [
    (-51.7, 5857.0, 0),
    (-207.1, 7655.0, 1),
    (34.9, 7660.0, 1),
    (-438.6, 9884.0, 2),
    (155.7, 9901.0, 2),
    (-556.3, 10502.0, 1),
    (237.8, 10525.0, 1),
    (-176.7, 11077.0, 0),
    (-330.9, 11258.0, 3),
    (-34.1, 11268.0, 3),
    (-281.8, 11770.0, 2),
    (-116.5, 11775.0, 2),
    (-285.7, 12915.0, 4),
    (-192.6, 12918.0, 4),
    (-318.8, 14673.0, 5),
    (-296.7, 14674.0, 5),
    (-366.7, 14777.0, 3),
    (-257.5, 14781.0, 3),
    (-314.3, 14832.0, 0),
    (-726.9, 16345.0, 1),
    (-36.4, 16377.0, 1),
    (-387.3, 16433.0, 6),
    (-383.0, 16434.0, 6),
    (-394.9, 16641.0, 0),
    (-842.6, 17145.0, 2),
    (3.1, 17186.0, 2),
    (-500.1, 17444.0, 4),
    (-367.5, 17451.0, 4),
];

#[test]
fn eigenvalues_equal_table_1_of_the_paper() {
    let specification = annulus(ElementKind::Quad8, 180, 35);
    let found = run(
        &specification,
        &paper_options(),
        &[0.3],
        ModeLimit::Lowest(28),
    );
    for ((real, frequency, harmonic), mode) in TABLE_1.iter().zip(&found.sweep.points[0].modes) {
        assert_eq!(mode.harmonic, *harmonic, "{mode:?}");
        assert!(
            (mode.frequency_hz() / frequency - 1.0).abs() < 3e-3,
            "{mode:?}"
        );
        // The paper's mesh is its own; 10 Hz is a tenth of a percent of the frequencies.
        assert!((mode.real_hz() - real).abs() < 10.0, "{real} {mode:?}");
        if mode.is_unstable() {
            assert_eq!(
                mode.direction, -1,
                "unstable waves travel against the rotor: {mode:?}"
            );
        }
    }
}

/// Onsets of the exact continuum model with the paper's data: 0.1224 (n = 1), 0.1382 (n = 2), 0.2121 (n = 1).
#[test]
fn critical_frictions_equal_those_of_the_continuum() {
    let specification = annulus(ElementKind::Quad8, 120, 24);
    let found = run(
        &specification,
        &paper_options(),
        &[0.0, 0.5, 1.0],
        ModeLimit::Lowest(28),
    );
    let onsets = [(0.1224, 1, 1), (0.1382, 2, 0), (0.2121, 1, 0)];
    for ((critical, harmonic, branch), interval) in onsets.iter().zip(&found.sweep.intervals) {
        assert_eq!(
            (interval.harmonic, interval.branch, interval.direction),
            (*harmonic, *branch, -1)
        );
        // Four digits are given; the continuum model has no geometric stiffness.
        assert!(
            (interval.critical_friction - critical).abs() < 1e-3,
            "{interval:?}"
        );
    }
}

/// One sweep straight to friction 5 and one in 1250 steps find the same intervals, also one that lies
/// between 0.0077 and 0.0142, and at each end the branch neither grows nor decays.
#[test]
fn unstable_intervals_do_not_depend_on_the_grid() {
    let mut options = paper_options();
    options.contact.normal_stiffness = Some(1e11);
    options.damping.stiffness_coefficient = 0.0;
    let material = ElasticMaterial {
        poisson_ratio: 0.45,
        ..polycarbonate()
    };
    let solve = |frictions: &[f64]| {
        let request = SweepRequest {
            friction_coefficients: frictions,
            limit: ModeLimit::MaxFrequency(20000.0),
            shapes_at: &[],
        };
        let specification = annulus(ElementKind::Quad4, 40, 10);
        sweep(
            &specification,
            &material,
            &options,
            &paper_contact(),
            &request,
        )
        .unwrap()
    };
    let steps: Vec<f64> = (0..=1250).map(|i| 0.004 * f64::from(i)).collect();
    let (fine, coarse) = (solve(&steps).sweep.intervals, solve(&[5.0]));
    let narrow = |i: &&UnstableInterval| i.restabilized.is_some_and(|(end, _)| end < 0.02);
    assert_eq!(fine.iter().filter(narrow).count(), 1);
    let mut compared = 0;
    for a in &coarse.sweep.intervals {
        let is_same = |b: &&UnstableInterval| {
            (b.harmonic, b.branch, b.direction) == (a.harmonic, a.branch, a.direction)
                && (b.critical_friction - a.critical_friction).abs() < 1e-10
        };
        let b = fine.iter().find(is_same).unwrap();
        assert_eq!(a.restabilized.is_some(), b.restabilized.is_some());
        let ends = [Some(a.critical_friction), a.restabilized.map(|r| r.0)];
        for end in ends.into_iter().flatten() {
            let is_branch = |b: &&ModeBranch| {
                (b.harmonic, b.branch, b.direction) == (a.harmonic, a.branch, a.direction)
            };
            let at = solve(&[end]);
            let lambda = at
                .branches
                .iter()
                .find(is_branch)
                .map(|b| b.interpolate(end).unwrap());
            let lambda = lambda.unwrap();
            assert!(lambda.re.abs() < 1e-10 * lambda.norm(), "{lambda}");
            compared += 1;
        }
    }
    assert!(compared > 8);
}

/// Consistency check on the whole mesh: shapes expanded from one sector satisfy the full problem.
#[test]
fn expanded_shapes_are_eigenvectors_of_the_full_mesh() {
    for (element, normal_stiffness) in [
        (ElementKind::Quad4, Some(7.4e12)),
        (ElementKind::Quad8, None),
    ] {
        let mut options = paper_options();
        options.contact.normal_stiffness = normal_stiffness;
        let specification = annulus(element, 24, 6);
        let request = SweepRequest {
            friction_coefficients: &[0.6, 0.0],
            limit: ModeLimit::Lowest(20),
            shapes_at: &[0.6],
        };
        let (material, contact) = (polycarbonate(), paper_contact());
        let found = sweep(&specification, &material, &options, &contact, &request).unwrap();
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let elastic = assemble_stiffness(&mesh, &material);
        let base = SteadySliding::solve(&mesh, &elastic, &contact).unwrap();
        let tangent = SlidingTangent::linearize(&mesh, &material, &elastic, &base, &options);
        let multiply = |p: &MatrixPolynomial, x: &[c64]| {
            let (values, pattern) = (p.evaluate(0.6), p.pattern());
            let mut y = vec![c64::new(0.0, 0.0); x.len()];
            for (column, x) in x.iter().enumerate() {
                for place in
                    pattern.column_pointers()[column]..pattern.column_pointers()[column + 1]
                {
                    y[pattern.row_indices()[place]] += values[place] * x;
                }
            }
            y
        };
        assert!(
            found.sweep.points[1]
                .modes
                .iter()
                .all(|mode| mode.shape.is_none())
        );
        for mode in &found.sweep.points[0].modes {
            let shape = mode.shape.as_ref().unwrap();
            let largest = shape
                .chunks(2)
                .map(|u| u[0].norm().hypot(u[1].norm()))
                .fold(0.0, f64::max);
            assert!((largest - 1.0).abs() < 1e-12);
            let x = tangent.unknowns.restrict(shape);
            let (m, c, k) = (
                multiply(&tangent.mass, &x),
                multiply(&tangent.damping, &x),
                multiply(&tangent.stiffness, &x),
            );
            let lambda = mode.eigenvalue;
            let scale = k.iter().map(|v| v.norm()).fold(0.0, f64::max);
            for i in 0..x.len() {
                let residual = lambda * lambda * m[i] + lambda * c[i] + k[i];
                // Forces at single nodes cancel entries about 1e3 times as large.
                assert!(residual.norm() < 1e-9 * scale, "{mode:?} {residual}");
            }
        }
    }
}

#[test]
fn every_other_harmonic_is_proven_to_hold_no_mode_of_the_range() {
    let mut rigid = paper_options();
    rigid.contact.normal_stiffness = None;
    for options in [paper_options(), rigid] {
        let found = run(
            &annulus(ElementKind::Quad4, 180, 35),
            &options,
            &[0.0, 1.0],
            ModeLimit::Lowest(30),
        );
        let coverage = found.coverage;
        assert_eq!(coverage.followed, (0..=8).collect::<Vec<_>>());
        assert_eq!(coverage.proven_empty, (9..=90).collect::<Vec<_>>());
        assert!(coverage.counted_empty.is_empty());
    }
}

#[test]
fn results_are_the_same_to_the_last_bit_on_any_number_of_threads() {
    let solve = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let specification = annulus(ElementKind::Quad4, 40, 8);
        let frictions = [0.0, 0.3, 0.7];
        pool.install(|| {
            run(
                &specification,
                &paper_options(),
                &frictions,
                ModeLimit::Lowest(30),
            )
        })
    };
    let (one, four) = (solve(1), solve(4));
    assert_eq!(one.sweep, four.sweep);
    assert_eq!(one.branches, four.branches);
}

/// A point of a map that has no sliding state is reported, the others are computed.
#[test]
fn stability_map_equals_single_sweeps_and_survives_failing_points() {
    let model = CyclicModel {
        specification: annulus(ElementKind::Quad4, 40, 10),
        material: polycarbonate(),
        options: paper_options(),
        contact: paper_contact(),
    };
    let limit = ModeLimit::Lowest(12);
    let models = [-1e-5, 2e-5, 2e-4].map(|interference| {
        let mut changed = model;
        changed.contact.interference = interference;
        (interference, changed)
    });
    let map = stability_map(&models, limit, 1.0);
    assert!(
        map[0]
            .outcome
            .as_ref()
            .unwrap_err()
            .to_string()
            .contains("contact.interference")
    );
    for point in &map[1..] {
        let mut contact = model.contact;
        contact.interference = point.value;
        let request = SweepRequest {
            friction_coefficients: &[1.0],
            limit,
            shapes_at: &[],
        };
        let single = sweep(
            &model.specification,
            &model.material,
            &model.options,
            &contact,
            &request,
        )
        .unwrap();
        let onset = point.lowest_onset().unwrap();
        let first = &single.sweep.intervals[0];
        assert!((onset.critical_friction - first.critical_friction).abs() < 1e-10);
        let of_branch = point.critical_friction(first.harmonic, first.branch, first.direction);
        assert_eq!(of_branch, Some(onset.critical_friction));
    }
}

#[test]
fn impossible_requests_name_their_key() {
    let specification = annulus(ElementKind::Quad4, 12, 2);
    for (frictions, limit, key) in [
        (vec![], ModeLimit::Lowest(3), "cea.friction_coefficients"),
        (
            vec![-0.1],
            ModeLimit::Lowest(3),
            "cea.friction_coefficients",
        ),
        (vec![0.1], ModeLimit::Lowest(0), "cea.modes"),
        (vec![0.1], ModeLimit::Lowest(1000), "cea.modes"),
        (
            vec![0.1],
            ModeLimit::MaxFrequency(-5.0),
            "cea.max_frequency_hz",
        ),
    ] {
        let request = SweepRequest {
            friction_coefficients: &frictions,
            limit,
            shapes_at: &[],
        };
        let (material, options) = (polycarbonate(), paper_options());
        let outcome = sweep(
            &specification,
            &material,
            &options,
            &paper_contact(),
            &request,
        );
        assert!(outcome.unwrap_err().to_string().contains(key));
    }
}
