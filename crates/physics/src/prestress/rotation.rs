//! Rotation of regions of an assembly.

use super::elimination::Elimination;
use super::{PrestressError, Result};
use crate::contact::Motion;
use crate::fem::{
    ElementGeometry, MassKind, MaterialField, RotationFrame, RotationTerms, Spin, Triplets,
    assemble_around, assemble_mass, assemble_rotation,
};
use crate::mesh::Mesh;
use std::collections::BTreeSet;

/// Largest share of the velocity that may stand across the sides of a body of revolution: a mesh of a circle has flat faces,
/// `pi / 2 N` of them with `N` around.
const MOST_ACROSS: f64 = 0.1;

/// Springs to the ground over the stiffest motion, against which a free body is turned: a centrifugal load is in balance by
/// itself, and what is left of it moves the body as a whole.
const GROUND: f64 = 1e-12;

/// The inertia of all regions that turn with their rotation terms.
#[derive(Clone, Debug)]
pub(super) struct Rotation {
    /// Over all dofs; the stiffness has the centrifugal stress, too, and the strain that comes with it.
    pub terms: RotationTerms,
    /// What the centrifugal load does alone, m.
    pub displacement: Vec<f64>,
}

impl Rotation {
    /// The terms of the motions that ask for them; `held` gives the stiffness over the unknowns of `basis`, in which the
    /// boundaries `seams` are glued.
    ///
    /// # Errors
    /// [`PrestressError::Asked`] for bodies that are none of revolution, or do not turn with a frame that does.
    pub fn of(
        mesh: &Mesh,
        materials: &dyn MaterialField,
        motions: &[Motion],
        (basis, seams): (&Elimination, &[usize]),
        held: impl FnOnce() -> Triplets,
    ) -> Result<Option<Self>> {
        let spins = |motion: &Motion| motion.spin().filter(|spin| spin.velocity.norm() > 0.0);
        if motions.iter().all(|motion| spins(motion).is_none()) {
            return Ok(None);
        }
        let own = |region| motions.iter().find(|motion| motion.regions.contains(&region));
        let of_region = |region: usize| own(region).and_then(spins);
        check_frames(mesh, &of_region)?;
        let is_at_rest = |spin: Spin| spin.frame == RotationFrame::Rest;
        let mut at_rest = motions.iter().filter(|own| spins(own).is_some_and(is_at_rest));
        at_rest.try_for_each(|motion| check_revolution(mesh, motion, seams))?;
        let mut terms = assemble_rotation(mesh, materials, &of_region);

        // The stress of the centrifugal load alone.
        let held = grounded(held(), (mesh, materials), basis);
        let bases = [basis.displacement_under(&terms.centrifugal, &held)?];
        // Stress stiffens, and the strain that comes with it changes the centrifugal load itself.
        let of =
            [ElementGeometry::geometric_stiffnesses, ElementGeometry::displacement_stiffnesses];
        let added = of.map(|of| assemble_around((mesh, materials), &bases, None, of));
        let added = added.into_iter().flatten().flat_map(|own| own.entries);
        terms.transport.entries.extend(added);
        let [displacement] = bases;
        Ok(Some(Self { terms, displacement }))
    }
}

/// A stiffness over the unknowns of `basis` with springs of [`GROUND`] in proportion to the mass.
fn grounded(
    mut stiffness: Triplets,
    (mesh, materials): (&Mesh, &dyn MaterialField),
    basis: &Elimination,
) -> Triplets {
    let mass = basis.congruent(&assemble_mass(mesh, materials, MassKind::Lumped)).into_owned();
    let largest = |matrix: &Triplets| {
        let diagonal = matrix.entries.iter().filter(|entry| entry.0 == entry.1);
        diagonal.fold(0.0_f64, |largest, entry| largest.max(entry.2))
    };
    // K + g M: all rigid motions are held, and in balance hardly any force meets that.
    let ground = GROUND * largest(&stiffness) / largest(&mass);
    let springs = mass.entries.into_iter();
    stiffness.entries.extend(springs.map(|(row, column, value)| (row, column, ground * value)));
    stiffness
}

/// Refuses a frame that turns with some regions while others do not turn with them.
fn check_frames(mesh: &Mesh, of: &dyn Fn(usize) -> Option<Spin>) -> Result<()> {
    let spins: Vec<Option<Spin>> = (0..mesh.regions.len()).map(of).collect();
    let is_turning = |spin: &Option<Spin>| spin.is_some_and(|s| s.frame == RotationFrame::Turning);
    let Some(first) = spins.iter().position(is_turning) else {
        return Ok(());
    };
    match spins.iter().position(|spin| *spin != spins[first]) {
        None => Ok(()),
        Some(other) => Err(PrestressError::Asked(format!(
            "motion.{}.frame = \"turning\", but \"{}\" does not turn so: in that frame it would move. Give both the same axis, speed and \
             frame, or describe bodies of revolution with frame = \"rest\"",
            mesh.regions[first], mesh.regions[other]
        ))),
    }
}

/// Refuses a region whose sides, the parts of its surface along the axis, are carried along by its motion.
fn check_revolution(mesh: &Mesh, motion: &Motion, seams: &[usize]) -> Result<()> {
    let glued = seams.iter().flat_map(|&seam| &mesh.boundaries[seam].faces);
    let glued: BTreeSet<(u32, &[u32])> = glued.map(|f| (f.element, f.nodes.as_slice())).collect();
    let (mut across, mut whole) = (0.0, 0.0);
    for face in mesh.outer_faces() {
        let is_own = motion.regions.contains(&mesh.region(face.element as usize));
        if !is_own || glued.contains(&(face.element, face.nodes.as_slice())) {
            continue;
        }
        for there in mesh.quadrature(&face) {
            let velocity = motion.velocity(there.position);
            let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
            let along = dot(there.area, motion.axis);
            let side = (dot(there.area, there.area) - along * along).max(0.0).sqrt(); // |dA| without its part along the axis.
            across += dot(velocity, there.area).abs();
            whole += dot(velocity, velocity).sqrt() * side;
        }
    }
    let share = across / whole; // int |v . n| dA / int |v| dA over what faces across the axis.
    if share > MOST_ACROSS {
        let region = motion.regions.first().map_or("", |&region| &mesh.regions[region]);
        return Err(PrestressError::Asked(format!(
            "motion.{region}.rotation_terms = true, but \"{region}\" is no body of revolution about that axis: {:.0} % of the velocity on \
             its sides stands across them. Such sides move in the frame at rest. Where everything turns with it give frame = \"turning\", \
             else leave rotation_terms out",
            100.0 * share
        )));
    }
    Ok(())
}
