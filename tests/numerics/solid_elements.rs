//! Solid elements of every kind against theory and against each other.

use crate::prelude::*;
use faer::sparse::{SparseColMat, Triplet};
use std::f64::consts::FRAC_PI_2;

fn skewed([x, y, z]: [f64; 3]) -> [f64; 3] {
    [0.10 * x + 0.02 * y - 0.01 * z, 0.01 * x + 0.08 * y + 0.02 * z, 0.06 * z - 0.01 * y]
}

/// Numbers spread over -0.5 to 0.5, always the same.
fn draws() -> impl FnMut() -> f64 {
    let mut draw = crate::draws::draws(2);
    move || draw() - 0.5
}

/// The skewed block with inner nodes out of place; edges stay straight unless `bend` moves the middles of inner edges too.
fn distorted(kind: ElementKind, bend: f64) -> FileMesh {
    let mut file = block(kind, [3, 2, 2], |place| place);
    let is_inner = |p: &[f64; 3]| p.iter().all(|&x| x > 1e-9 && x < 1.0 - 1e-9);
    let mut draw = draws();
    let before = file.points.clone();
    let corners = kind.corner_count();
    let mut is_corner = vec![false; before.len()];
    for element in &file.elements {
        element.nodes[..corners].iter().for_each(|&node| is_corner[node as usize] = true);
    }
    for node in (0..before.len()).filter(|&node| is_corner[node] && is_inner(&before[node])) {
        file.points[node].iter_mut().for_each(|x| *x += 0.1 * draw());
    }
    let mut is_done = vec![false; before.len()];
    for element in &file.elements {
        for (edge, ends) in kind.edges().iter().enumerate() {
            let Some(&middle) = element.nodes.get(corners + edge) else { continue };
            if std::mem::replace(&mut is_done[middle as usize], true) {
                continue;
            }
            let [p, q] = ends.map(|end| file.points[element.nodes[end] as usize]);
            let moved = if is_inner(&before[middle as usize]) { bend } else { 0.0 };
            file.points[middle as usize] =
                [0, 1, 2].map(|axis| 0.5 * (p[axis] + q[axis]) + moved * draw());
        }
    }
    file.points.iter_mut().for_each(|point| *point = skewed(*point));
    file
}

/// A displacement field sampled in nodal frames.
pub fn sample(mesh: &Mesh, field: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Vec<f64> {
    let at = |(node, &place)| mesh.frame(node).transpose() * field(Vector3::from(place));
    let moved = mesh.nodes.iter().enumerate().map(at);
    moved.flat_map(|u| u.iter().copied().take(mesh.dimension).collect::<Vec<f64>>()).collect()
}

/// The six rigid motions about a point inside.
fn rigid_motions(mesh: &Mesh) -> Vec<Vec<f64>> {
    let center = Vector3::new(0.05, 0.04, 0.03);
    let moved = (0..3).map(|axis| sample(mesh, |_| Vector3::ith(axis, 1.0)));
    let turned = (0..3).map(|axis| sample(mesh, |p| Vector3::ith(axis, 1.0).cross(&(p - center))));
    moved.chain(turned).collect()
}

/// Stiffness with supports and consistent mass over the free dofs of a mesh.
pub struct Pencil {
    stiffness: Vec<(usize, usize, f64)>,
    mass: Vec<(usize, usize, f64)>,
    unknowns: DofMap,
}

impl Pencil {
    pub fn of(mesh: &Mesh) -> Self {
        Self::of_material(mesh, &STEEL)
    }

    pub fn of_material(mesh: &Mesh, material: &ElasticMaterial) -> Self {
        let unknowns = DofMap::excluding(mesh.dof_count(), mesh.held_dofs());
        let free = |matrix: &Triplets| {
            let at = |dof: usize| unknowns.unknown_of[dof];
            let kept = |&(i, j, value): &(usize, usize, f64)| Some((at(i)?, at(j)?, value));
            matrix.entries.iter().filter_map(kept).collect()
        };
        let mut stiffness = assemble_stiffness(mesh, material);
        stiffness.entries.extend(assemble_supports(mesh)[0].entries.iter());
        Self {
            stiffness: free(&stiffness),
            mass: free(&assemble_mass(mesh, material, Consistent)),
            unknowns,
        }
    }

    fn multiply(&self, matrix: &[(usize, usize, f64)], vectors: &DMatrix<f64>) -> DMatrix<f64> {
        let mut product = DMatrix::zeros(vectors.nrows(), vectors.ncols());
        for &(row, column, value) in matrix {
            for k in 0..vectors.ncols() {
                product[(row, k)] += value * vectors[(column, k)];
            }
        }
        product
    }

    /// `(K - shift M)^-1` applied to columns.
    fn solve(&self, shift: f64) -> impl Fn(&DMatrix<f64>) -> DMatrix<f64> + use<> {
        let shifted = self.mass.iter().map(|&(i, j, value)| (i, j, -shift * value));
        let entries = self.stiffness.iter().copied().chain(shifted);
        let entries: Vec<_> = entries.map(|(i, j, value)| Triplet::new(i, j, value)).collect();
        let size = self.unknowns.len();
        let matrix = SparseColMat::try_new_from_triplets(size, size, &entries).unwrap();
        let factor = matrix.sp_lu().unwrap();
        move |columns| {
            let mut sides = Mat::from_fn(size, columns.ncols(), |i, j| columns[(i, j)]);
            factor.solve_in_place(&mut sides);
            DMatrix::from_fn(size, columns.ncols(), |i, j| sides[(i, j)])
        }
    }

    /// The lowest frequencies, Hz, by subspace iteration.
    pub fn frequencies(&self, count: usize) -> Vec<f64> {
        let (size, width) = (self.unknowns.len(), count + 8);
        let mut draw = draws();
        let mut vectors = DMatrix::from_fn(size, width, |_, _| draw());
        let solve = self.solve(-(2.0 * PI * 1000.0_f64).powi(2));
        let mut squares = Vec::new();
        for _ in 0..40 {
            let images = solve(&self.multiply(&self.mass, &vectors));
            let mass = images.transpose() * self.multiply(&self.mass, &images);
            let stiffness = images.transpose() * self.multiply(&self.stiffness, &images);
            let (found, turned) = pencil_modes(&stiffness, &mass);
            vectors = images * turned;
            squares = sorted(found.as_slice().to_vec());
        }
        squares[..count].iter().map(|square| square.max(0.0).sqrt() / (2.0 * PI)).collect()
    }

    /// Rayleigh's quotient of a column.
    fn quotient(&self, column: &DMatrix<f64>) -> f64 {
        let mass = column.dot(&self.multiply(&self.mass, column));
        column.dot(&self.multiply(&self.stiffness, column)) / mass
    }

    /// Square of the angular frequency of the mode that is most like a shape, by inverse iteration next to its quotient.
    fn like(&self, shape: &[f64]) -> f64 {
        let start = self.unknowns.restrict(shape);
        let mut column = DMatrix::from_vec(start.len(), 1, start);
        let solve = self.solve(self.quotient(&column));
        for _ in 0..3 {
            column = solve(&self.multiply(&self.mass, &column));
            column /= column.amax();
        }
        self.quotient(&column)
    }
}

fn frequencies(mesh: &Mesh, count: usize) -> Vec<f64> {
    Pencil::of(mesh).frequencies(count)
}

/// Independent check: a linear displacement has the constant stress of Hooke's law, and no force acts on inner nodes.
pub fn passes_the_patch_test(mesh: &Mesh, what: &str) {
    let gradient = Matrix3::new(1e-3, 4e-4, -2e-4, 3e-4, -7e-4, 5e-4, 2e-4, -1e-4, 6e-4);
    let strain: Matrix3<f64> = 0.5 * (gradient + gradient.transpose());
    let [lambda, shear] = STEEL.lame_constants();
    let exact = Matrix3::identity() * (lambda * strain.trace()) + 2.0 * shear * strain;
    let exact = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].map(|at| exact[at]);
    let displacement = sample(mesh, |p| gradient * p);
    let forces = assemble_stiffness(mesh, &STEEL).multiply(mesh.dof_count(), &displacement);
    let scale = forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    let outer: BTreeSet<u32> = mesh.outer_faces().into_iter().flat_map(|face| face.nodes).collect();
    let is_inner = |dof: &usize| !outer.contains(&((dof / 3) as u32));
    let inner: Vec<usize> = (0..mesh.dof_count()).filter(is_inner).collect();
    assert!(inner.len() >= 6, "{what}");
    assert!(inner.iter().all(|&dof| forces[dof].abs() < 1e-12 * scale), "{what}");
    for stress in solid_stress(mesh, &STEEL, &displacement) {
        within(&stress.0, &exact, 1e-10 * STEEL.young_modulus * 1e-3);
    }
}

#[test]
fn every_kind_passes_the_patch_test_on_a_distorted_block() {
    for kind in SOLIDS {
        // Curved inner edges too where the quadrature is exact on them.
        let bends = if kind == Tet10 { vec![0.0, 0.03] } else { vec![0.0] };
        for bend in bends {
            let mesh = solids_of(&distorted(kind, bend), &[]);
            passes_the_patch_test(&mesh, &format!("{kind:?} {bend}"));
        }
    }
}

/// Theory: a free body has six rigid motions, which cost no force, and no other motion without strain.
#[test]
fn free_blocks_of_every_kind_have_six_rigid_motions_and_no_other() {
    for kind in SOLIDS {
        let mesh = solids_of(&distorted(kind, 0.02), &[]);
        let stiffness = assemble_stiffness(&mesh, &STEEL);
        let largest = stiffness.entries.iter().fold(0.0_f64, |m, e| m.max(e.2.abs()));
        for motion in rigid_motions(&mesh) {
            let forces = stiffness.multiply(mesh.dof_count(), &motion);
            assert!(forces.iter().all(|force| force.abs() < 1e-13 * largest), "{kind:?}");
        }
        let found = frequencies(&mesh, 7);
        assert!(found[5] < 1e-4 * found[6], "{kind:?} {found:?}");
    }
}

/// Theory: mass and moments of inertia of a parallelepiped, from the kinetic energy of rigid motions.
#[test]
fn masses_have_the_volume_and_inertia_of_the_block() {
    // Volume and moments of the unit cube, taken through the linear map.
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(skewed);
    let map = Matrix3::from_columns(&columns.map(Vector3::from));
    let volume = map.determinant();
    let second = map * (Matrix3::identity() / 12.0) * map.transpose();
    let offset = map * Vector3::repeat(0.5) - Vector3::new(0.05, 0.04, 0.03);
    let second = (second + offset * offset.transpose()) * volume;
    let inertia = Matrix3::identity() * second.trace() - second;
    for kind in SOLIDS {
        let mesh = solids_of(&distorted(kind, 0.0), &[]);
        near(mesh.region_measures()[0], volume, 1e-13);
        let mass = assemble_mass(&mesh, &STEEL, Consistent);
        let motions = rigid_motions(&mesh);
        let energy = |i: usize, j: usize| -> f64 {
            let momentum = mass.multiply(mesh.dof_count(), &motions[j]);
            motions[i].iter().zip(momentum).map(|(u, p)| u * p).sum()
        };
        for axis in 0..3 {
            near(energy(axis, axis), STEEL.density * volume, 1e-12);
            let found = [0, 1, 2].map(|other| energy(3 + axis, 3 + other) / STEEL.density);
            let exact = [0, 1, 2].map(|other| inertia[(axis, other)]);
            within(&found, &exact, 1e-12 * inertia.amax());
        }
        let lumped = lumped_masses(&mesh, &STEEL);
        assert!(lumped.iter().all(|&mass| mass > 0.0), "{kind:?}");
        near(lumped.iter().sum(), STEEL.density * volume, 1e-12);
    }
}

/// Theory: Lamé's mode of a free cube of side `L`, `u = (cos(pi x / L) sin(pi y / L), - sin(pi x / L) cos(pi y / L), 0)`, has
/// `omega = sqrt(2) pi c_t / L` exactly. Frequencies converge with order 2 on linear kinds, 4 on quadratic ones.
#[test]
fn the_lame_mode_of_a_cube_converges_with_the_order_of_the_kind() {
    const SIDE: f64 = 0.05;
    let [_, shear] = STEEL.lame_constants();
    let exact = PI / SIDE * (shear / STEEL.density / 2.0).sqrt();
    // A quarter of the cube between its planes of symmetry: Lamé's mode stands alone there, on meshes without symmetry too.
    let guided = ["x1", "y1", "z0", "z1"].map(|face| (face, Guide));
    let error = |kind: ElementKind, cells: usize| {
        let file = block(kind, [cells; 3], |p| p.map(|x| SIDE * x));
        let mesh = solids_of(&file, &guided);
        let lame = sample(&mesh, |p| {
            let (x, y) = (FRAC_PI_2 * p.x / SIDE, FRAC_PI_2 * p.y / SIDE);
            Vector3::new(x.cos() * y.sin(), -x.sin() * y.cos(), 0.0)
        });
        (Pencil::of(&mesh).like(&lame).sqrt() / exact - 1.0).abs()
    };
    for kind in SOLIDS {
        let linear = sized([6, 10], [8, 14]);
        let (cells, expected) = if kind.is_quadratic() { ([4, 6], 4.0) } else { (linear, 2.0) };
        let errors = cells.map(|cells| error(kind, cells));
        let order = (errors[0] / errors[1]).ln() / (cells[1] as f64 / cells[0] as f64).ln();
        // Split cells have not lost their next term yet (1.60 and 3.62 here, 1.37 and 3.2 with half as many); bricks have.
        let shortfall = if [Hex8, Hex20].contains(&kind) { 0.02 } else { 0.4 };
        assert!(order > expected - shortfall, "{kind:?} {errors:?} order {order}");
    }
}

/// Cross-method: bending, torsion and stretching of a clamped beam that is not symmetric.
#[test]
fn quadratic_kinds_and_incompatible_bricks_agree_on_a_clamped_beam() {
    let clamped = [("x0", Clamped)];
    let beam = |kind: ElementKind, cells: [usize; 3]| {
        let map = |[x, y, z]: [f64; 3]| {
            let taper = 1.0 - 0.3 * x;
            [0.12 * x, 0.02 * taper * y, 0.012 * taper * z + 0.02 * x * x]
        };
        let mesh = solids_of(&block(kind, cells, map), &clamped);
        frequencies(&mesh, 6)
    };
    let reference = beam(Hex20, [8, 2, 2]);
    for (kind, cells, tolerance) in [
        (Tet10, [10, 2, 2], 0.01),
        (Wedge15, [8, 2, 2], 0.005),
        (Pyramid13, [8, 2, 2], 0.005),
        (Hex8, [16, 4, 4], 0.02),
    ] {
        near_each(&beam(kind, cells), &reference, tolerance);
    }
}

/// Theory: a bar pressed onto springs: stress `-p` along it, the springs give way by `p / k`; turned by any angle, too.
#[test]
fn pressure_guides_and_springs_on_faces_hold_a_uniform_stress_at_any_angle() {
    const PRESSURE: f64 = 3e6;
    const SPRING: f64 = 2e11;
    let turn = Rotation3::from_euler_angles(0.3, -0.5, 0.8);
    let support = ElasticSupport { normal_stiffness: SPRING, ..ElasticSupport::default() };
    let conditions =
        [("x0", Support(support)), ("x1", Pressure(PRESSURE)), ("y0", Guide), ("z0", Guide)];
    for kind in SOLIDS {
        let map = |[x, y, z]: [f64; 3]| (turn * Vector3::new(0.1 * x, 0.05 * y, 0.04 * z)).into();
        let mesh = solids_of(&block(kind, [2, 2, 1], map), &conditions);
        let unknowns = DofMap::excluding(mesh.dof_count(), mesh.held_dofs());
        let load = unknowns.restrict(&assemble_pressures(&mesh).unwrap());
        let pencil = Pencil::of(&mesh);
        let load = DMatrix::from_vec(load.len(), 1, load);
        let found = unknowns.expand(pencil.solve(0.0)(&load).as_slice());
        let strain = PRESSURE / STEEL.young_modulus;
        let exact = sample(&mesh, |p| {
            let q = turn.inverse() * p;
            let across = STEEL.poisson_ratio * strain;
            let local = Vector3::new(-strain * q.x - PRESSURE / SPRING, across * q.y, across * q.z);
            turn * local
        });
        within(&found, &exact, 1e-11 * 1e-3);
        for stress in solid_stress(&mesh, &STEEL, &found) {
            near(stress.von_mises(), PRESSURE, 1e-8);
            near(stress.pressure(), PRESSURE / 3.0, 1e-8);
        }
    }
}

/// Theory: under a uniform stress the geometric stiffness of a translation is zero, and of a rotation about an axis the work
/// of the stress on the square of the rotation, `V (sigma_yy + sigma_zz)` about x.
#[test]
fn geometric_stiffness_of_rigid_rotations_is_the_work_of_the_stress() {
    let gradient = Matrix3::from_diagonal(&Vector3::new(1e-3, -4e-4, 6e-4));
    let [lambda, shear] = STEEL.lame_constants();
    let stress = Matrix3::identity() * (lambda * gradient.trace()) + 2.0 * shear * gradient;
    for kind in SOLIDS {
        let mesh = solids_of(&distorted(kind, 0.0), &[]);
        let base = sample(&mesh, |p| gradient * p);
        let of = ElementGeometry::geometric_stiffnesses;
        let matrix = &assemble_around((&mesh, &STEEL), &[base], None, of)[0];
        let volume = mesh.region_measures()[0];
        for (k, motion) in rigid_motions(&mesh).iter().enumerate() {
            let force = matrix.multiply(mesh.dof_count(), motion);
            let work: f64 = force.iter().zip(motion).map(|(f, u)| f * u).sum();
            let of_axis = |axis: usize| volume * (stress.trace() - stress[(axis, axis)]);
            let exact = k.checked_sub(3).map_or(0.0, of_axis);
            assert!((work - exact).abs() < 1e-11 * volume * stress.amax(), "{kind:?} {k}");
        }
    }
}

#[test]
fn a_turned_block_has_the_same_frequencies() {
    let turn = Rotation3::from_euler_angles(1.1, 0.4, -0.7);
    let clamped = [("z0", Clamped)];
    for kind in SOLIDS {
        let plain = solids_of(&distorted(kind, 0.02), &clamped);
        let mut file = distorted(kind, 0.02);
        file.points.iter_mut().for_each(|p| *p = (turn * Vector3::from(*p)).into());
        let turned = solids_of(&file, &clamped);
        near_each(&frequencies(&plain, 8), &frequencies(&turned, 8), 1e-10);
    }
}

/// Holds a mesh to the volumes of its regions and the areas of its surfaces, each to a share of its own.
fn measures(bytes: &[u8], exact: &[(&str, f64)], tolerance: impl Fn(&str) -> f64) {
    let mesh = mesh_of(bytes, &[]);
    let regions = mesh.regions.iter().cloned().zip(mesh.region_measures());
    let surfaces = mesh.boundaries.iter().map(|b| (b.name.clone(), mesh.face_area(&b.faces)));
    let found: Vec<(String, f64)> = regions.chain(surfaces).collect();
    assert_eq!(found.len(), exact.len());
    for ((name, found), (expected, exact)) in found.iter().zip(exact) {
        assert_eq!(name, expected);
        assert!((found / exact - 1.0).abs() < tolerance(name), "{name} {found} {exact}");
    }
}

/// Independent check: volumes and areas of a quarter ring of curved bricks and wedges, whose nodes Gmsh numbers in its own way.
#[test]
fn curved_bricks_and_wedges_of_gmsh_have_the_volume_and_surfaces_of_their_ring() {
    let (inner, outer, height) = (0.05_f64, 0.08_f64, 0.02);
    let exact = [
        ("ring", PI / 4.0 * (outer * outer - inner * inner) * height),
        ("inner", PI / 2.0 * inner * height),
        ("outer", PI / 2.0 * outer * height),
    ];
    // Parabolas for arcs of 22.5 degrees: 2e-5 of the area beneath.
    measures(include_bytes!("meshes/ring-hex20.msh"), &exact, |_| 1e-4);
    measures(include_bytes!("meshes/ring-wedge15.msh"), &exact, |_| 1e-4);
}

/// Independent check: the volumes that the geometry kernel gives for the parts of the ventilated disc, pads in closed form.
#[test]
fn the_ventilated_disc_has_the_volumes_and_pad_faces_of_its_geometry() {
    let pad = PI / 6.0 * (0.1675_f64.powi(2) - 0.13_f64.powi(2));
    // At the bottom the hat is flush with the cheek: one face.
    let ring = PI * (0.175_f64.powi(2) - 0.105_f64.powi(2));
    let exact = [
        ("disc", 2.153_222_5e-3),
        ("pad_bottom", 0.015 * pad),
        ("pad_top", 0.015 * pad),
        ("back_bottom", pad),
        ("back_top", pad),
        ("bolts", 2.0 * PI * 0.01 * (0.04 + 5.0 * 0.01)),
        ("disc_bottom", ring),
        ("disc_top", PI * (0.175_f64.powi(2) - 0.125_f64.powi(2))),
        ("lining_bottom", pad),
        ("lining_top", pad),
    ];
    // Quadratic edges of 25 mm on circles of 10 mm and more.
    let tolerance = |name: &str| if name == "bolts" { 2e-2 } else { 2e-3 };
    measures(include_bytes!("../../cases/meshes/ventilated-disc.msh"), &exact, tolerance);
}
