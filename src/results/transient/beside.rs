//! The last shear stress field of several runs side by side, as figure 2 of the paper has it.

use crate::chart::{Axis, ColourMap, Figure, Side, significant};
use crate::fem::{MaterialField, RayleighDamping, nodal_stress};
use crate::mesh::Mesh;
use crate::results::charts::Disc;
use crate::transient::Snapshot;

/// The end of one run.
#[derive(Clone, Debug)]
pub struct RunEnd<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// The material.
    pub material: &'a dyn MaterialField,
    /// Its damping, which the figure names.
    pub damping: RayleighDamping,
    /// The last snapshot.
    pub snapshot: &'a Snapshot,
}

/// The shear stress at the last snapshot of each run, each with its own scale of colours.
pub fn shear_stress_beside(runs: &[RunEnd<'_>]) -> Figure {
    let panels = runs.iter().map(|run| {
        let stress = nodal_stress(run.mesh, run.material, &run.snapshot.displacement);
        let values = stress.iter().map(|node| node.shear).collect();
        let axis = Axis::new("shear stress *τ*_{rθ}", "MPa").times(1e-6);
        let disc = Disc::new(run.mesh);
        let [mass, stiffness] = [run.damping.mass_coefficient, run.damping.stiffness_coefficient];
        let damping = [significant(mass, 3), significant(stiffness, 3)];
        disc.panel(0.01)
            .heading(format!("*α*_{{R}} = {} 1/s", damping[0]))
            .heading(format!(
                "*β*_{{R}} = {} s, *t* = {:.2} ms",
                damping[1],
                run.snapshot.time * 1e3
            ))
            .layer(disc.field(values, axis, ColourMap::Diverging))
            .colour_bar(Side::Below)
    });
    Figure::new("shear-stress-beside", "Shear stress at the last snapshot of several runs.")
        .columns(runs.len().clamp(2, 4))
        .panels(panels)
}
