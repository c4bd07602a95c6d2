//! The cyclic eigenvalue analysis against theory, dense solutions and the paper.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};
use frictionsim::cea::cyclic::{
    CyclicModel, CyclicSweep, ModeBranch, ModeLimit, Sensitivity, SweepRequest, sensitivities,
    stability_map, sweep,
};
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
    let cyclic = sweep(specification, &polycarbonate(), options, contact, &request).unwrap();
    let mesh = AnnulusMesh::generate(specification).unwrap();
    let elastic = assemble_stiffness(&mesh.mesh, &polycarbonate());
    let base = SteadySliding::solve(&mesh.mesh, &elastic, contact).unwrap();
    let tangent = SlidingTangent::linearize(&mesh.mesh, &polycarbonate(), &elastic, &base, options);
    let sectors = mesh.sector_count() as i32;
    let against: i8 = if contact.rotation_speed < 0.0 { 1 } else { -1 };
    let mut worst = 0.0_f64;
    for (point, &mu) in cyclic.sweep.points.iter().zip(frictions) {
        for n in (1 - sectors) / 2..=sectors / 2 {
            let mut dense = dense_eigenvalues(&tangent, &mesh, mu, n);
            // Overdamped modes of the mesh come down again; nobody asks for them.
            dense.retain(|l| l.im < TAU * limit_hz && l.norm() < 2.0 * TAU * limit_hz);
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
            let modes: Vec<c64> = modes.map(|mode| mode.eigenvalue).collect();
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
                        &options,
                        &contact,
                        &[0.0, 0.3, 0.9],
                        17500.0,
                    );
                    println!(
                        "{element:?} {n_theta} {mass:?} {normal_stiffness:?} {geometric_stiffness} {worst:e}"
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
            let branch = eigenvalue_slope(&found, &s, friction);
            assert!((branch - s.friction).norm() < 1e-9 * s.eigenvalue.norm());
        }
    }
}

/// `d lambda / d mu` by central differences on solved points.
fn eigenvalue_slope(found: &CyclicSweep, like: &Sensitivity, friction: f64) -> c64 {
    let is_same = |b: &&ModeBranch| {
        (b.harmonic, b.branch, b.direction) == (like.harmonic, like.branch, like.direction)
    };
    let branch = found.branches.iter().find(is_same).unwrap();
    branch
        .points
        .iter()
        .find(|p| p.friction_coefficient == friction)
        .unwrap()
        .rate
}

#[test]
fn explore() {
    let model = CyclicModel {
        specification: annulus(ElementKind::Quad4, 180, 35),
        material: polycarbonate(),
        options: paper_options(),
        contact: paper_contact(),
    };
    let values: Vec<f64> = (0..16).map(|i| 1e12 * 10f64.powf(i as f64 / 8.0)).collect();
    let t = std::time::Instant::now();
    let map = stability_map(&values, ModeLimit::Lowest(30), 1.0, |k| {
        let mut m = model;
        m.options.contact.normal_stiffness = Some(k);
        m
    });
    println!("{:?}", t.elapsed());
    for p in map {
        println!(
            "{:e} {:?}",
            p.value,
            p.lowest_onset()
                .map(|i| (i.harmonic, i.branch, i.direction, i.critical_friction))
        );
    }
}
