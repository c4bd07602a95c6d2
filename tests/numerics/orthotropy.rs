//! Orthotropic materials against closed forms, a Rayleigh-Ritz series and the isotropic material.

use crate::prelude::*;
use frictionsim::fem::MaterialAxes;
use frictionsim::fem::element::ElementGeometry;

/// A lining: soft across its plane.
fn lining(axes: MaterialAxes) -> Orthotropy {
    Orthotropy {
        young_moduli: [8e9, 6e9, 1.5e9],
        poisson_ratios: [0.25, 0.3, 0.2],
        shear_moduli: [3e9, 1e9, 1.2e9],
        axes,
    }
}

fn solid(orthotropy: Orthotropy) -> ElasticMaterial {
    ElasticMaterial {
        density: 2500.0,
        formulation: ThreeDimensional,
        orthotropy: Some(orthotropy),
        ..ElasticMaterial::PLAIN
    }
}

/// Legendre's polynomials of degree 0 to `degree` at `x` with their derivatives.
fn legendre(degree: usize, x: f64) -> Vec<[f64; 2]> {
    let mut found = vec![[1.0, 0.0], [x, 1.0]];
    for n in 1..degree {
        let (a, b, n) = (found[n], found[n - 1], n as f64);
        let twice = 2.0 * n + 1.0;
        found.push([(twice * x * a[0] - n * b[0]) / (n + 1.0), twice * a[0] + b[1]]);
    }
    found
}

/// Frequencies of a free box with edges along the material's axes, Hz, by Ritz's method on products of Legendre polynomials
/// up to a total degree (Demarest 1971): the stiffness `int c_ikjl phi_a,k phi_b,l dV` from the nine constants.
fn ritz(orthotropy: &Orthotropy, density: f64, size: [f64; 3], degree: usize) -> Vec<f64> {
    // int P_m^(p) P_n^(q) dx over -1 to 1 for derivatives p, q.
    let mut line = vec![[[0.0; 2]; 2]; (degree + 1) * (degree + 1)];
    for (x, weight) in gauss_legendre(degree + 2) {
        let values = legendre(degree, x);
        for (at, sums) in line.iter_mut().enumerate() {
            let (m, n) = (at / (degree + 1), at % (degree + 1));
            for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                sums[p][q] += weight * values[m][p] * values[n][q];
            }
        }
    }
    let all = (0..=degree).flat_map(|l| {
        (0..=degree - l).flat_map(move |m| (0..=degree - l - m).map(move |n| [l, m, n]))
    });
    let functions: Vec<[usize; 3]> = all.collect();
    // int phi_a,k phi_b,l dV in the box; k = 3 stands for no derivative.
    let integral = |a: &[usize; 3], b: &[usize; 3], k: usize, l: usize| -> f64 {
        let of_axis = |axis: usize| {
            let [p, q] = [k, l].map(|derivative| usize::from(derivative == axis));
            let half = 0.5 * size[axis];
            line[a[axis] * (degree + 1) + b[axis]][p][q] * half.powi(1 - (p + q) as i32)
        };
        (0..3).map(of_axis).product()
    };
    let e = orthotropy.young_moduli;
    let [n12, n13, n23] = orthotropy.poisson_ratios;
    #[rustfmt::skip]
    let compliance = Matrix3::new(
        1.0 / e[0], -n12 / e[0], -n13 / e[0],
        -n12 / e[0], 1.0 / e[1], -n23 / e[1],
        -n13 / e[0], -n23 / e[1], 1.0 / e[2],
    );
    let normal = compliance.try_inverse().unwrap();
    let shear = |i: usize, j: usize| orthotropy.shear_moduli[i + j - 1];
    // A mirror of the box is one of the material: even and odd motions along each axis are problems of their own.
    let mut squares: Vec<f64> = Vec::new();
    for class in 0..8 {
        let is_own = |i: usize, function: &[usize; 3]| {
            let parity = |axis: usize| (class >> axis & 1) + usize::from(axis == i);
            (0..3).all(|axis| (function[axis] + parity(axis)).is_multiple_of(2))
        };
        let all = (0..3).flat_map(|i| functions.iter().map(move |function| (i, *function)));
        let own: Vec<(usize, [usize; 3])> = all.filter(|(i, own)| is_own(*i, own)).collect();
        // Legendre's polynomials are orthogonal: the mass is diagonal.
        let scale: Vec<f64> =
            own.iter().map(|(_, a)| 1.0 / (density * integral(a, a, 3, 3)).sqrt()).collect();
        let entry = |at: usize, beside: usize| {
            let ((i, a), (j, b)) = (own[at], own[beside]);
            // c_iijj, and c_ijij = c_ijji = G_ij.
            let sheared = (0..3).filter(|&k| k != i && (i == j || k == j)).map(|k| {
                let (p, q) = if i == j { (k, k) } else { (j, i) };
                shear(i, k) * integral(&a, &b, p, q)
            });
            let sum = normal[(i, j)] * integral(&a, &b, i, j) + sheared.sum::<f64>();
            sum * scale[at] * scale[beside]
        };
        let scaled = DMatrix::from_fn(own.len(), own.len(), entry);
        let symmetric = (&scaled + scaled.transpose()) * 0.5;
        squares.extend(symmetric.symmetric_eigenvalues().iter());
    }
    sorted(squares.into_iter().map(|square| square.max(0.0).sqrt() / (2.0 * PI)))
}

/// Independent check: free modes of a cube of lining, whose axes and edges are turned in space together, on 20-node bricks.
#[test]
fn free_modes_of_an_orthotropic_cube_are_those_of_a_ritz_series() {
    const SIDE: f64 = 0.02;
    let turn = Rotation3::from_euler_angles(0.9, -0.4, 0.6);
    let columns = turn.matrix();
    let along = |k: usize| [columns[(0, k)], columns[(1, k)], columns[(2, k)]];
    let straight = lining(MaterialAxes::global());
    let axes = MaterialAxes::along(along(0), along(1)).unwrap();
    let series = ritz(&straight, 2500.0, [SIDE; 3], 13);
    // The series has converged: two degrees fewer change its lowest ten elastic modes by less than is asked of the elements.
    let shorter = ritz(&straight, 2500.0, [SIDE; 3], 11);
    near_each(&shorter[6..16], &series[6..16], 2e-4);
    let cube = |cells: usize, place: &dyn Fn([f64; 3]) -> [f64; 3]| {
        let file = block(Hex20, [cells; 3], |p| place(p.map(|x| SIDE * x)));
        solids_of(&file, &[])
    };
    let turned = |cells: usize| {
        let mesh = cube(cells, &|p| (turn * Vector3::from(p)).into());
        Pencil::of_material(&mesh, &solid(lining(axes))).frequencies(12)
    };
    let found = turned(6);
    // Of fourth order in the elements for each wavelength.
    near_each(&found[6..9], &series[6..9], 1e-3);
    near_each(&found[9..], &series[9..12], 3e-3);
    // Turning body and axes together changes nothing, whatever the mesh.
    let plain = Pencil::of_material(&cube(3, &|p| p), &solid(straight)).frequencies(12);
    near_each(&turned(3)[6..], &plain[6..], 1e-9);
    // Turning the axes alone does.
    let wrong = Pencil::of_material(&cube(3, &|p| p), &solid(lining(axes))).frequencies(8);
    let mut pairs = wrong.iter().zip(&plain).skip(6);
    assert!(pairs.any(|(a, b)| (a / b - 1.0).abs() > 1e-3));
}

/// Theory: a simply supported thin plate, `omega^2 rho h = pi^4 (D_1 m^4/a^4 + 2 (D_12 + 2 D_66) m^2 n^2/(a b)^2 + D_2 n^4/b^4)`.
#[test]
fn a_thin_orthotropic_plate_has_the_frequencies_of_kirchhoffs_theory() {
    let (a, b, h) = (0.2_f64, 0.15_f64, 0.001_f64);
    let orthotropy = lining(MaterialAxes::global());
    let [e1, e2, _] = orthotropy.young_moduli;
    let (n12, g12) = (orthotropy.poisson_ratios[0], orthotropy.shear_moduli[0]);
    let n21 = n12 * e2 / e1;
    let bending = h.powi(3) / 12.0;
    let [d1, d2] = [e1, e2].map(|e| e / (1.0 - n12 * n21) * bending);
    let (d12, d66) = (n12 * d2, g12 * bending);
    let exact = |m: f64, n: f64| {
        let sum = d1 * (m / a).powi(4)
            + 2.0 * (d12 + 2.0 * d66) * (m * n / (a * b)).powi(2)
            + d2 * (n / b).powi(4);
        PI * PI * (sum / (2500.0 * h)).sqrt() / (2.0 * PI)
    };
    let waves = [(1.0, 1.0), (2.0, 1.0), (1.0, 2.0), (2.0, 2.0)];
    let expected = sorted(waves.map(|(m, n)| exact(m, n)));
    let edges = [("x0", true), ("x1", true), ("y0", false), ("y1", false)];
    let edges = edges.map(|(face, along_x)| (face, Fixed([!along_x, along_x, true])));
    let file = block(Hex20, [20, 16, 1], |[x, y, z]| [a * x, b * y, h * z]);
    let mesh = solids_of(&file, &edges);
    let found = Pencil::of_material(&mesh, &solid(orthotropy)).frequencies(4);
    // Shear and rotatory inertia lower them by about (pi h / a)^2 E / G.
    near_each(&found, &expected, 5e-3);
}

fn as_nine(material: &ElasticMaterial, axes: MaterialAxes) -> ElasticMaterial {
    let (e, nu) = (material.young_modulus, material.poisson_ratio);
    let (young_moduli, shear_moduli) = ([e; 3], [e / (2.0 * (1.0 + nu)); 3]);
    let nine = Orthotropy { young_moduli, poisson_ratios: [nu; 3], shear_moduli, axes };
    ElasticMaterial { orthotropy: Some(nine), ..*material }
}

/// One plane element about the origin, sheared.
fn flat_element(kind: ElementKind) -> Mesh {
    let (nodes, corners) = (kind.node_count(), kind.corner_count());
    let turn = 2.0 * PI / corners as f64;
    let around = |i: usize| {
        let (half, radius) = if i < corners { (0.0, 1.0) } else { (0.5, (0.5 * turn).cos()) };
        let (sin, cos) = (turn * ((i % corners) as f64 + half)).sin_cos();
        [radius * cos, 1.2 * radius * sin + 0.1 * radius * cos, 0.0]
    };
    Mesh {
        dimension: 2,
        nodes: (0..nodes).map(around).collect(),
        frames: NodalFrames::global(2, nodes),
        element_kinds: vec![kind],
        element_starts: vec![0, nodes as u32],
        elements: (0..nodes as u32).collect(),
        ..Mesh::default()
    }
}

#[test]
fn isotropic_constants_given_as_orthotropic_have_the_isotropic_stiffness() {
    let (axis, center) = ([2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0], [0.3, -0.1, 0.2]);
    let along = MaterialAxes::along([1.0, 2.0, 0.5], [0.0, 1.0, -1.0]).unwrap();
    let all_axes = [MaterialAxes::global(), along, MaterialAxes::Cylindrical { axis, center }];
    for formulation in [PlaneStrain, PlaneStress, ThreeDimensional] {
        let plain = ElasticMaterial { formulation, ..POLYCARBONATE };
        let is_flat = formulation != ThreeDimensional;
        let kinds: &[ElementKind] = if is_flat { &[Tri3, Quad8] } else { &SOLIDS };
        for (&kind, axes) in kinds.iter().flat_map(|kind| all_axes.map(|axes| (kind, axes))) {
            let mesh = if is_flat {
                flat_element(kind)
            } else {
                let file = block(kind, [1; 3], |[x, y, z]| [x + 0.2 * y, y, 0.8 * z - 0.1 * x]);
                solids_of(&file, &[])
            };
            let geometry = ElementGeometry::new(&mesh, 0);
            let expected = geometry.stiffness(&plain);
            let found = geometry.stiffness(&as_nine(&plain, axes));
            let error = (&found - &expected).amax() / expected.amax();
            below(error, 1e-12, format_args!("{kind:?} {formulation:?} {axes:?}"));
        }
    }
    let [e, nu] = as_nine(&POLYCARBONATE, all_axes[0]).orthotropy.unwrap().mean_constants();
    near_each(&[e, nu], &[2.5e9, 0.3805], 1e-12);
}

/// Theory: in the plane the compliance is that of the solid (plane stress), or `S_ij - S_i3 S_j3 / S_33` (plane strain), and
/// at an angle to the axes `1 / E_x = c^4 / E_1 + (1 / G_12 - 2 nu_12 / E_1) s^2 c^2 + s^4 / E_2`.
#[test]
fn plane_formulations_reduce_the_compliance_of_the_solid() {
    let angle: f64 = 0.7;
    let (sin, cos) = angle.sin_cos();
    let axes = MaterialAxes::along([cos, sin, 0.0], [-sin, cos, 0.0]).unwrap();
    let constants = lining(axes);
    let [e1, e2, e3] = constants.young_moduli;
    let [n12, n13, n23] = constants.poisson_ratios;
    let in_plane = |formulation| {
        let material = ElasticMaterial { formulation, ..solid(constants) };
        let law = material.elasticity_at([0.1, 0.2, 0.0]);
        let at = [0, 1, 3];
        Matrix3::from_fn(|i, j| law[at[i]][at[j]]).try_inverse().unwrap()
    };
    // Compliances over the material's axes, turned by the fourth-order tensor's rule.
    let along_x = |s11: f64, s22: f64, s12: f64, s66: f64| {
        cos.powi(4) * s11 + (2.0 * s12 + s66) * (sin * cos).powi(2) + sin.powi(4) * s22
    };
    let s66 = 1.0 / constants.shear_moduli[0];
    let stress = along_x(1.0 / e1, 1.0 / e2, -n12 / e1, s66);
    near(in_plane(PlaneStress)[(0, 0)], stress, 1e-12);
    let [s13, s23] = [-n13 / e1, -n23 / e2];
    let (s11, s22) = (1.0 / e1 - s13 * s13 * e3, 1.0 / e2 - s23 * s23 * e3);
    let strain = along_x(s11, s22, -n12 / e1 - s13 * s23 * e3, s66);
    near(in_plane(PlaneStrain)[(0, 0)], strain, 1e-12);
}

/// Theory: the bounds that the check names are those at which the compliance becomes singular.
#[test]
fn the_check_names_the_ratio_that_costs_positive_energy() {
    let broken = |ratios: [f64; 3]| {
        let constants = Orthotropy { poisson_ratios: ratios, ..lining(MaterialAxes::global()) };
        constants.check().err()
    };
    assert!(broken([0.25, 0.3, 0.2]).is_none());
    // nu_12^2 < E_1 / E_2, nu_13^2 < E_1 / E_3.
    let limit = (8.0_f64 / 6.0).sqrt();
    assert_eq!(broken([1.2, 0.3, 0.2]).unwrap().which, 0);
    assert!((broken([1.2, 0.3, 0.2]).unwrap().bounds[1] - limit).abs() < 1e-15);
    assert!(broken([1.1, 0.0, 0.0]).is_none());
    assert_eq!(broken([0.2, 2.4, 0.2]).unwrap().which, 1);
    // Each is possible, not all together: just inside and outside of the bound that is named.
    let [low, high] = broken([0.9, 1.6, 1.9]).unwrap().bounds;
    let beside = [low + 1e-9, low - 1e-9, high - 1e-9, high + 1e-9];
    let holds = beside.map(|value| broken([0.9, 1.6, value]).is_none());
    assert_eq!(holds, [true, false, true, false]);
}
