//! The steady sliding state that the eigenvalues belong to.

use crate::contact::ContactStatus;
use crate::fem::NodalStress;
use crate::mesh::Mesh;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::table::{Column, write_rows};
use crate::results::vtu::{EncodedMesh, Field, write_vtu};
use serde::{Deserialize, Serialize};

/// The steady sliding state at one friction coefficient in a few numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BaseState {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Contact nodes in slip.
    pub slipping: usize,
    /// Contact nodes that stick.
    pub sticking: usize,
    /// Contact nodes without contact.
    pub open: usize,
    /// Contact pressure, smallest and largest, Pa.
    pub pressure_pa: [f64; 2],
    /// Friction traction, smallest and largest, Pa.
    pub shear_pa: [f64; 2],
    /// Friction torque on a cylinder, of the whole thickness, N m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_n_m: Option<f64>,
    /// Friction force on a plane, of the whole thickness, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drag_n: Option<f64>,
    /// Power that the counterface puts in, W.
    pub power_w: f64,
}

impl BaseState {
    /// Torque or drag with its name and unit.
    pub(super) fn drive(&self) -> String {
        let torque = self
            .torque_n_m
            .map(|torque| format!("torque {torque:.4} N m"));
        let drag = || format!("drag {:.4} N", self.drag_n.unwrap_or(f64::NAN));
        torque.unwrap_or_else(drag)
    }
}

/// The same state node by node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BaseField {
    /// Contact nodes, 0-based, in order of rising angle.
    pub nodes: Vec<u32>,
    /// Angle of each contact node, rad.
    pub angles: Vec<f64>,
    /// Contact pressure at each contact node, Pa.
    pub pressures: Vec<f64>,
    /// Friction traction at each contact node, Pa.
    pub shears: Vec<f64>,
    /// Whether each contact node is pressed, on bodies where some may be open.
    pub is_pressed: Option<Vec<bool>>,
    /// Displacement of every node in nodal frames, `2 * node_count` values, m.
    pub displacement: Vec<f64>,
    /// Stress at every node.
    pub stress: Vec<NodalStress>,
}

/// Writes `prestress.csv` (contact nodes) and `prestress.vtu` (displacement and stress).
///
/// # Errors
/// Those of the folder.
pub fn write_base(folder: &OutputFolder, mesh: &Mesh, base: &BaseField) -> Result<(), FolderError> {
    folder.write("prestress.csv", |out| {
        let status = |i: usize| {
            let is_pressed = base.is_pressed.as_ref()?[i];
            let status = [ContactStatus::Open, ContactStatus::Slip][usize::from(is_pressed)];
            Some(status.name())
        };
        let place = |i: usize| mesh.plane_node(base.nodes[i] as usize);
        let columns: &[Column<'_, usize>] = &[
            ("node", &|i| mesh.node_label(base.nodes[*i] as usize).into()),
            ("angle_degrees", &|i| base.angles[*i].to_degrees().into()),
            ("pressure_pa", &|i| base.pressures[*i].into()),
            ("shear_pa", &|i| base.shears[*i].into()),
            ("status", &|i| status(*i).into()),
            ("x_m", &|i| place(*i)[0].into()),
            ("y_m", &|i| place(*i)[1].into()),
        ];
        // On an annulus every node slips, at its angle.
        let shown = if base.is_pressed.is_some() { 7 } else { 4 };
        write_rows(out, &columns[..shown], 0..base.nodes.len())
    })?;
    let mut fields = vec![Field::vectors("displacement_m", mesh, &base.displacement)];
    fields.extend(Field::stresses(&base.stress));
    folder.write_bulk("prestress.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, &[])
    })?;
    Ok(())
}
