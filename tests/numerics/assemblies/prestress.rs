//! The stress of the base state in small motions of solid bodies: geometric stiffness, and contact forces that turn.

use super::rigid_counterface::plane;
use super::*;
use crate::solids::parts::SOLID_RING;

const STRESSED: TangentOptions = TangentOptions { geometric_stiffness: true, ..OPTIONS };

const SPRINGS: ElasticSupport = springs([1e12, 1e12, 0.0], [0.0; 2]);

/// What a rotation about the axis of the sliding costs inner nodes beside elastic forces, over what the stress alone has there.
fn forces_of_a_rotation(mesh: &Mesh, contact: SlidingSurfaces, motions: &[Motion]) -> f64 {
    let friction = 0.3;
    let axis = match (&contact.counter, motions) {
        (Counterpart::Rigid(rigid), _) => (rigid.axis, rigid.center),
        (_, motions) => (motions[0].axis, motions[0].center),
    };
    let assembly = assembled(mesh, contact, motions).unwrap();
    let state = assembly.state(friction).unwrap();
    let [without, tangent] = [OPTIONS, STRESSED].map(|own| assembly.tangent(&state, &own).unwrap());
    let (axis, center) = (Vector3::from(axis.0), Vector3::from(axis.1));
    let rotation = sample(mesh, |place| axis.cross(&(place - center)));
    // Springs and loads stay where they are: their nodes are left out, and those that move them through rigid contact.
    let bound = mesh.boundaries.iter().filter(|own| own.condition != Free);
    let loaded: BTreeSet<usize> =
        bound.flat_map(|own| own.nodes.iter().map(|&node| node as usize)).collect();
    let rows = tangent.distances.iter().filter(|(dof, _)| loaded.contains(&(dof / 3)));
    let moving = rows.flat_map(|(_, row)| row.iter().map(|(dof, _)| dof / 3));
    let is_loaded = |own: &&RigidFriction| own.lift.iter().any(|(k, _)| loaded.contains(&(k / 3)));
    let dragged = tangent.friction.iter().filter(is_loaded);
    let moving = moving.chain(dragged.flat_map(|own| own.slip.iter().map(|(dof, _)| dof / 3)));
    let outer: BTreeSet<usize> = moving.chain(loaded.iter().copied()).collect();
    let is_inner = |dof: &usize| !outer.contains(&(dof / 3));
    let largest = |forces: &dyn Fn(usize) -> f64| {
        let inner = tangent.unknowns.dofs.iter().enumerate().filter(|(_, dof)| is_inner(dof));
        inner.map(|(unknown, _)| forces(unknown).abs()).fold(0.0, f64::max)
    };
    // The unknown of an open point of rigid contact is its separation, which rows of others may hold.
    let mut free = rotation.clone();
    for _ in 0..40 {
        for (dof, row) in &tangent.distances {
            let others = row.iter().filter(|(other, _)| other != dof);
            let others: f64 = others.map(|&(other, share)| free[other] * share).sum();
            if let Some((_, own)) = row.iter().find(|(other, _)| other == dof) {
                free[*dof] = (rotation[*dof] - others) / own;
            }
        }
    }
    let unknowns = tangent.unknowns.restrict(&free);
    let unknowns = Mat::from_fn(unknowns.len(), 1, |i, _| unknowns[i]);
    let [whole, elastic] = [&tangent, &without].map(|own| {
        let values = own.stiffness.evaluate(friction);
        own.stiffness.pattern().multiply(&values, unknowns.as_ref())
    });
    let whole = whole - elastic;
    let displacement = state.displacement(friction);
    let of = ElementGeometry::geometric_stiffnesses;
    let stress = assemble_around((mesh, &STEEL), &[displacement], None, of);
    let alone = stress[0].multiply(mesh.dof_count(), &rotation);
    largest(&|k| whole[(k, 0)]) / largest(&|k| alone[tangent.unknowns.dofs[k]])
}

/// Blocks as they are, or bent around the axis z at a radius of 50 mm.
fn bent(is_bent: bool) -> impl Fn([f64; 3]) -> [f64; 3] {
    let turned = |[x, y, z]: [f64; 3]| polar([0.05 + z, x / 0.05 - 0.5 * PI, y]);
    move |place| if is_bent { turned(place) } else { place }
}

/// Independent check (objectivity): bodies that turn with everything about the axis of the sliding cost no force, flat ones to
/// round-off, and curved ones as closely as their faces meet.
#[test]
fn a_rotation_of_everything_costs_no_force() {
    let conditions = [
        ("lower_z0", Support(SPRINGS)),
        ("upper_x0", Support(SPRINGS)),
        ("upper_x1", Support(SPRINGS)),
        ("upper_z1", Pressure(1e8)),
    ];
    let bodies = [(false, 1, 1e-8), (false, 2, 1e-8), (true, 1, 3e-2), (true, 2, 3e-2)];
    for (is_bent, order, bound) in bodies {
        let mut blocks = stacked(0.0);
        // Flat faces meet on any mesh.
        let along = if is_bent { [5, 4] } else { sized([3, 2], [5, 4]) };
        blocks.iter_mut().zip(along).for_each(|(own, along)| own.counts = [along, 2, 2]);
        let bytes = file_of_order(&blocks, order, bent(is_bent));
        let mesh = mesh_of(&bytes, &conditions);
        let center = if is_bent { [0.0; 3] } else { [1.0, 0.3, 0.0] };
        let motion = turning(&mesh, [0.0, 0.0, 1.0], center);
        for normal_stiffness in [None, Some(1e14)] {
            let contact = sliding(&mesh, normal_stiffness);
            let left = forces_of_a_rotation(&mesh, contact, std::slice::from_ref(&motion));
            below(left, bound, format_args!("bent {is_bent} {order} {normal_stiffness:?}"));
        }
    }
}

/// The same on rigid counterfaces of each shape.
#[test]
fn a_rotation_about_a_rigid_counterface_costs_no_force() {
    let shapes = [
        (RigidShape::Plane, false, [1.0, 0.3, 0.0]),
        (RigidShape::Cylinder(None), true, [0.0; 3]),
        (RigidShape::Sphere(Some(0.07)), true, [0.0, 0.0, 0.02]),
    ];
    for (shape, is_bent, center) in shapes {
        let [_, upper] = stacked(0.0);
        let bytes = file_of(&[upper], bent(is_bent));
        let conditions = [("upper_x0", Support(SPRINGS)), ("upper_z1", Support(SPRINGS))];
        let mesh = mesh_of(&bytes, &conditions);
        let motion = RigidMotion::Turning(10.0);
        let rigid = RigidCounterface { shape, interference: 2e-4, ..plane(motion, center) };
        for normal_stiffness in [None, Some(1e14)] {
            let contact = on_rigid(&mesh, "upper_z0", rigid, normal_stiffness);
            let left = forces_of_a_rotation(&mesh, contact, &[]);
            below(left, 1e-8, format_args!("{shape:?} {normal_stiffness:?}"));
        }
    }
}

/// Theory (Euler): a column clamped at one end carries `pi^2 E I / 4 L^2` at the other; its frequency falls to zero there.
#[test]
fn a_column_buckles_under_the_load_of_euler() {
    let (length, side) = (0.2, 0.01);
    let column = [brick("column", [0.0; 3], [side, side, length], [1, 1, 8])];
    let bytes = file_of_order(&column, 2, |point| point);
    let inertia = side.powi(4) / 12.0;
    let euler = PI.powi(2) * STEEL.young_modulus * inertia / (4.0 * length * length);
    let stiffness = [0.9, 0.95].map(|share| {
        let pressure = Pressure(share * euler / (side * side));
        let conditions = [("column_z0", Clamped), ("column_z1", pressure)];
        let mesh = mesh_of(&bytes, &conditions);
        let assembly = Assembly::new(&mesh, &STEEL, (&[], &[]), (&[], Solved), Consistent).unwrap();
        let tangent = tangent_at(&assembly, 0.0, &STRESSED);
        modes_at(&tangent, 0.0, Lowest(2))[0].eigenvalue.im.powi(2)
    });
    // The square of the frequency falls almost in proportion to the load there.
    near(0.9 + 0.05 * stiffness[0] / (stiffness[0] - stiffness[1]), 1.0, 0.02);
}

/// Independent check: the whole mesh of a body of revolution against its harmonics, with stress and turning forces, the contact
/// rigid and on springs that carry the base state.
#[test]
fn the_whole_mesh_of_a_disc_has_the_prestress_of_its_harmonics() {
    let rigid = "contact.friction_coefficient=0.4 ; contact.interference=1e-4 ; cea.modes=12 ; \
                 cea.friction_coefficients=[0.4] ; mesh.circumferential_elements=24 ; \
                 mesh.radial_elements=2";
    let compliant = "contact.normal_stiffness=1e13 ; contact.base_state=compliant";
    for (contact, bound) in [(&[rigid][..], 5e-4), (&[rigid, compliant], 2e-2)] {
        // Frequencies of the modes of the section's plane: to others belongs friction across the sliding, distributed in another way.
        let frequencies = |method: &str, stressed: bool| -> Vec<f64> {
            let how = format!("cea.method={method} ; cea.geometric_stiffness={stressed}");
            let case = case_of("disc.toml", SOLID_RING, &[contact, &[&how]].concat());
            let points = modes_and_onsets(&case).unwrap().points;
            let all = points[0].modes.iter().map(|mode| mode.eigenvalue.im / TAU);
            all.filter(|own| (10e3..15e3).contains(own)).collect()
        };
        let shifts = ["cyclic", "sparse"].map(|method| -> Vec<f64> {
            let [with, without] = [true, false].map(|stressed| frequencies(method, stressed));
            assert_eq!(with.len(), without.len());
            with.iter().zip(&without).map(|(a, b)| a - b).collect()
        });
        let [cyclic, sparse] = &shifts;
        assert!(cyclic.len() >= 3 && cyclic.len() == sparse.len(), "{shifts:?}");
        for (a, b) in cyclic.iter().zip(sparse) {
            assert!(a.abs() > 10.0 && (a / b - 1.0).abs() < bound, "{contact:?} {shifts:?}");
        }
    }
}
