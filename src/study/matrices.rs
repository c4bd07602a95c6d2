//! The matrices that the eigenvalue analysis of a case solves, by power of the friction coefficient.

use super::StudyError;
use super::eigenvalues::{Solver, WholeMesh};
use super::tangent_options;
use crate::case::{Case, CeaMethod};
use crate::linalg::{MarketMatrix, MatrixPolynomial};
use crate::prestress::SlidingTangent;
use crate::results::matrices::{
    ExportedContactPoint, ExportedMatrix, ExportedSystem, ExportedUnknown, MatrixRole,
};
use std::f64::consts::FRAC_PI_2;

/// Mass, damping, stiffness and contact rows of a case's body around steady sliding at its own friction coefficient.
///
/// # Errors
/// A case without `[cea]`, a body of revolution, whose problem is one of complex matrices for each harmonic; solid bodies from a mesh
/// file; no steady sliding.
pub fn matrices(case: &Case) -> Result<ExportedSystem, StudyError> {
    let cea = case.require_cea()?;
    if case.body.revolution().is_some() {
        return Err(StudyError::Case(case.error_at(
            "material.formulation",
            "the matrices of a body of revolution in three dimensions are complex, one set for each harmonic: there is no one real \
             problem to write"
                .to_owned(),
            "a body of revolution".to_owned(),
            Some("use a plane formulation, or an imported mesh".to_owned()),
        )));
    }
    if case.body.assembly().is_some() {
        return Err(StudyError::Case(case.error_at(
            "mesh.file",
            "the files name unknowns and contact points of one plane body; those of solid bodies that are tied and slide on each other \
             are combinations of theirs"
                .to_owned(),
            "solid bodies".to_owned(),
            Some("use a plane body; `cea` and `frf` solve solid bodies themselves".to_owned()),
        )));
    }
    if case.has_structural_damping() {
        let refusal = case.loss_error(
            "the files hold one real problem, and structural damping makes the stiffness complex"
                .to_owned(),
            "not written",
            "set loss_factor = 0, and multiply the stiffness of the region by 1 + i eta",
        );
        return Err(StudyError::Case(refusal));
    }
    // The whole mesh, whatever the case's own method; what no method solves is refused.
    Solver::of(case, CeaMethod::Auto)?;
    let frictions = cea.solved_friction_coefficients();
    let model = WholeMesh::solve(case, tangent_options(case, cea.mass), &frictions)?;
    let state = model.base();
    let tangent = model.tangent(case, state);
    let friction = case.contact.sliding.friction_coefficient;
    let largest = frictions.iter().copied().fold(friction, f64::max);
    let smallest = frictions.iter().copied().fold(friction, f64::min);
    // The polynomials are those of one set of pressed points, which changes at `changes`.
    let changes = &model.range.changes;
    let below = changes.iter().copied().filter(|change| *change <= friction);
    let above = changes.iter().copied().filter(|change| *change > friction);
    let mut system = ExportedSystem {
        friction_coefficient: friction,
        friction_range: [
            below.fold(smallest, f64::max),
            above.fold(largest, f64::min),
        ],
        proportional_damping: tangent
            .proportional
            .map(|rayleigh| [rayleigh.mass_coefficient, rayleigh.stiffness_coefficient]),
        matrices: Vec::new(),
        unknowns: unknowns(&model, &tangent),
        contact: Vec::new(),
    };
    let matrices = &mut system.matrices;
    matrices.extend(powers("M", &tangent.mass, |friction_power| {
        MatrixRole::Mass { friction_power }
    }));
    matrices.extend(powers("C", &tangent.damping, |friction_power| {
        MatrixRole::Damping { friction_power }
    }));
    matrices.extend(powers("K", &tangent.stiffness, |friction_power| {
        MatrixRole::Stiffness { friction_power }
    }));
    contact_rows(&model, &tangent, &mut system);
    Ok(system)
}

/// The coefficients of a polynomial that are not zero, and always the one without friction.
fn powers<'a>(
    name: &'a str,
    polynomial: &'a MatrixPolynomial,
    role: fn(usize) -> MatrixRole,
) -> impl Iterator<Item = ExportedMatrix> + 'a {
    let size = polynomial.dimension();
    let coefficients = polynomial.coefficients().iter().enumerate();
    coefficients.filter_map(move |(power, values)| {
        let pattern = polynomial.pattern();
        let entries = (0..size).flat_map(|column| {
            let nonzeros = pattern.column(column);
            nonzeros.map(move |(position, row)| (row, column, values[position]))
        });
        let matrix = MarketMatrix {
            rows: size,
            columns: size,
            entries: entries.filter(|entry| entry.2 != 0.0).collect(),
        };
        (power == 0 || !matrix.entries.is_empty()).then(|| ExportedMatrix {
            name: match power {
                0 => name.to_owned(),
                power => format!("{name}_mu{power}"),
            },
            role: role(power),
            matrix,
        })
    })
}

/// Node, direction and place of every unknown.
fn unknowns(model: &WholeMesh, tangent: &SlidingTangent) -> Vec<ExportedUnknown> {
    let mesh = &model.mesh;
    let unknown = |&dof: &usize| {
        let (node, axis) = (dof / 2, dof % 2);
        let angle = mesh.frame_angles()[node] + FRAC_PI_2 * axis as f64;
        let [x, y] = mesh.plane_node(node);
        ExportedUnknown {
            node: mesh.node_label(node),
            is_distance: tangent.distances.iter().any(|(normal, _)| *normal == dof),
            direction: [angle.cos(), angle.sin(), 0.0],
            place: [x, y, 0.0],
        }
    };
    tangent.unknowns.dofs.iter().map(unknown).collect()
}

/// The contact points and their motion along the normal and along the sliding. In rigid contact the normal motion of a pressed point
/// is no unknown: its row is empty.
fn contact_rows(model: &WholeMesh, tangent: &SlidingTangent, system: &mut ExportedSystem) {
    let (base, interface) = (model.base(), &model.base().interface);
    let normal_forces = base.normal_forces(system.friction_coefficient);
    let unknown_of = &tangent.unknowns.unknown_of;
    let (mut normal, mut slip) = (Vec::new(), Vec::new());
    for (i, &node) in interface.nodes.iter().enumerate() {
        normal.extend(unknown_of[interface.normal_dof(i)].map(|unknown| (i, unknown, 1.0)));
        let along = interface.slip(i);
        slip.extend(along.filter_map(|(dof, share)| Some((i, unknown_of[dof]?, share))));
        system.contact.push(ExportedContactPoint {
            node: model.mesh.node_label(node as usize),
            is_pressed: base.is_pressed[i],
            length: interface.tributary_lengths[i],
            normal_force: normal_forces[i],
        });
    }
    for (name, role, entries) in [
        ("contact_normal", MatrixRole::ContactNormal, normal),
        ("contact_slip", MatrixRole::ContactSlip, slip),
    ] {
        system.matrices.push(ExportedMatrix {
            name: name.to_owned(),
            role,
            matrix: MarketMatrix {
                rows: interface.len(),
                columns: system.unknowns.len(),
                entries,
            },
        });
    }
}
