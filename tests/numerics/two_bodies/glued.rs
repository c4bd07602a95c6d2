//! Two bodies of one material, glued along their meshes, against the one body that they are.
//!
//! Glue is what the contact says of sticking pairs, `u_n = sum P u` and `u_t = sum P u`, for good and in both directions.

use super::*;
use crate::cea_sparse::bare;
use frictionsim::cea::sparse::FrictionlessModes;

/// `u = T y`: for each glued dof the dofs that it follows, with their weights.
type Glue = BTreeMap<usize, Vec<(usize, f64)>>;

fn glue(mesh: &Mesh) -> Glue {
    let interface = ContactInterface::of(mesh);
    let others = |own: usize, difference: Vec<(usize, f64)>| {
        let masters = difference.into_iter().filter(|&(dof, _)| dof != own);
        (own, masters.map(|(dof, part)| (dof, -part)).collect())
    };
    let points = interface.points(&contact(610.0)).into_iter();
    points.flat_map(|point| [point.normal, point.slip]).map(|row| others(row[0].0, row)).collect()
}

/// `T^T A T` over all dofs.
fn glued(matrix: &Triplets, glue: &Glue) -> Vec<(usize, usize, f64)> {
    let of = |dof: usize| glue.get(&dof).cloned().unwrap_or_else(|| vec![(dof, 1.0)]);
    let entries = matrix.entries.iter().flat_map(|&(row, column, value)| {
        let columns = of(column);
        of(row).into_iter().flat_map(move |(row, a)| {
            columns.clone().into_iter().map(move |(column, b)| (row, column, a * value * b))
        })
    });
    entries.collect()
}

/// Angular frequencies of what is glued and held, rad/s, the lowest `count`.
fn frequencies(mesh: &Mesh, glue: &Glue, held: Vec<usize>, count: usize) -> Vec<f64> {
    let prescribed = held.into_iter().chain(glue.keys().copied());
    let unknowns = DofMap::excluding(2 * mesh.node_count(), prescribed);
    let free = |matrix: &Triplets| -> Vec<(usize, usize, f64)> {
        let entries = glued(matrix, glue).into_iter();
        let at = |dof: usize| unknowns.unknown_of[dof];
        entries.filter_map(|(row, column, value)| Some((at(row)?, at(column)?, value))).collect()
    };
    let stiffness = free(&assemble_stiffness(mesh, &POLYCARBONATE));
    let mass = free(&assemble_mass(mesh, &POLYCARBONATE, Consistent));
    let positions = stiffness.iter().chain(&mass).map(|&(row, column, _)| (row, column));
    let pattern = Arc::new(SparsityPattern::from_positions(unknowns.len(), positions));
    let on_pattern = |terms| MatrixPolynomial::on_pattern(&pattern, &[terms]);
    let (stiffness, mass) = (on_pattern(stiffness), on_pattern(mass));
    let damping = MatrixPolynomial::combination(0.0, &mass, 0.0, &stiffness);
    let structure = bare([mass, damping, stiffness], None, unknowns);
    FrictionlessModes::compute(&structure, Lowest(count)).unwrap().frequencies[..count].to_vec()
}

/// Disc and shaft held at rim and bore, glued between them.
fn pair(mesh: &Mesh, count: usize) -> Vec<f64> {
    frequencies(mesh, &glue(mesh), mesh.held_dofs().collect(), count)
}

/// The ring that they are, held at both edges.
fn one(mesh: &Mesh, count: usize) -> Vec<f64> {
    let edges = mesh.boundaries.iter().flat_map(|edge| &edge.nodes);
    let held = edges.flat_map(|&node| [2 * node as usize, 2 * node as usize + 1]);
    frequencies(mesh, &Glue::new(), held.collect(), count)
}

fn largest(found: &[f64], exact: &[f64]) -> f64 {
    found.iter().zip(exact).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

/// Theory: with their nodes in pairs the dual mortar is the identity, and the bodies are one, element by element.
#[test]
fn glued_bodies_whose_meshes_match_have_the_spectrum_of_one_body() {
    // Elements of one size on both sides, as in the one body.
    let (outer, radial) = (0.0205 + 9.0 * 0.00725, [2, 9]);
    for element in [Quad4, Quad8] {
        let two = pair(&rings_of(element, outer, [24, 24], radial, 0.0), 12);
        let one = one(&ring(element, [0.006, outer], 24, 11), 12);
        // Residuals of the iteration, 1e-11.
        below(largest(&two, &one), 1e-10, format_args!("{element:?}"));
    }
}

/// Theory: glue between meshes that do not match costs no order; the reference is one body of fine quadratic elements.
#[test]
fn glued_bodies_whose_meshes_do_not_match_converge_to_one_body_at_second_order() {
    let exact = one(&ring(Quad8, [0.006, 0.0905], 120, 30), 8);
    let of = |k: usize| {
        let mesh = rings([10 * k, 12 * k], [k, 3 * k], 0.05);
        largest(&pair(&mesh, 8), &exact)
    };
    let found = [4, 8].map(of);
    within(&[(found[0] / found[1]).log2()], &[2.0], 0.1);
}

/// Patch test: every state of constant strain passes glue between any two meshes: it is continuous, and with what it
/// pulls at the free sides no node between floor and top needs a force.
#[test]
fn every_constant_strain_passes_glue_between_meshes_that_do_not_match() {
    let [lambda, shear] = POLYCARBONATE.lame_constants();
    for along in [[6, 4], [7, 5], [13, 4], [5, 11]] {
        // A block on a block, one as wide as the other.
        let lower = rectangle([0.0, -0.02], [0.04, 0.02], [along[0], 3]);
        let upper = rectangle([0.0, 0.0], [0.04, 0.03], [along[1], 4]);
        let mesh = held_blocks([lower, upper], Clamped).unwrap();
        let glue = glue(&mesh);
        let stiffness = assemble_stiffness(&mesh, &POLYCARBONATE);
        // Into the frame of a node.
        let turned = |node: usize, [u, v]: [f64; 2]| {
            let (sin, cos) = mesh.frame_angles()[node].sin_cos();
            [cos * u + sin * v, cos * v - sin * u]
        };
        for [xx, yy, xy] in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            let at =
                |(node, &[x, y, _]): (usize, &[f64; 3])| turned(node, [xx * x + xy * y, yy * y]);
            let field: Vec<f64> = mesh.nodes.iter().enumerate().flat_map(at).collect();
            for (&dof, masters) in &glue {
                let followed: f64 = masters.iter().map(|&(m, part)| part * field[m]).sum();
                // Round-off of displacements of 0.04 m.
                assert!((field[dof] - followed).abs() < 1e-14, "{along:?}");
            }
            let mut forces = stiffness.multiply(field.len(), &field);
            let scale = forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            let traction = [(lambda + 2.0 * shear) * xx + lambda * yy, shear * xy];
            for (p, q, _) in mesh.outline_edges() {
                let [[x, y], [to, end]] = [p, q].map(|node| mesh.plane_node(node as usize));
                let side = if x == to && x == 0.0 { -1.0 } else { 1.0 };
                if x == to {
                    let pull = traction.map(|t| 0.5 * side * (end - y).abs() * t);
                    for node in [p, q].map(|node| node as usize) {
                        let [u, v] = turned(node, pull);
                        forces[2 * node] -= u;
                        forces[2 * node + 1] -= v;
                    }
                }
            }
            for (&dof, masters) in &glue {
                let force = std::mem::take(&mut forces[dof]);
                masters.iter().for_each(|&(m, part)| forces[m] += part * force);
            }
            for (node, &[_, y, _]) in mesh.nodes.iter().enumerate() {
                if y > -0.02 && y < 0.03 {
                    let force = forces[2 * node].hypot(forces[2 * node + 1]);
                    assert!(force < 1e-12 * scale, "{along:?} {node} {force:e}");
                }
            }
        }
    }
}
