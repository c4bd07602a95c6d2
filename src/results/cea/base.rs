//! The steady sliding state that the eigenvalues belong to.

use crate::contact::ContactStatus;
use crate::fem::NodalStress;
use crate::mesh::Mesh2d;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::table::{Table, format_number};
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
pub fn write_base(
    folder: &OutputFolder,
    mesh: &Mesh2d,
    base: &BaseField,
) -> Result<(), FolderError> {
    folder.write("prestress.csv", |out| {
        let mut columns = vec!["node", "angle_degrees", "pressure_pa", "shear_pa"];
        if base.is_pressed.is_some() {
            columns.extend(["status", "x_m", "y_m"]);
        }
        let mut table = Table::new(out, &columns)?;
        for (i, &node) in base.nodes.iter().enumerate() {
            let of_a_body = base.is_pressed.as_ref().map(|is_pressed| {
                let status = if is_pressed[i] {
                    ContactStatus::Slip
                } else {
                    ContactStatus::Open
                };
                let [x, y] = mesh.nodes[node as usize].map(format_number);
                [status.name().to_owned(), x, y]
            });
            let row = [
                mesh.node_label(node as usize).to_string(),
                format_number(base.angles[i].to_degrees()),
                format_number(base.pressures[i]),
                format_number(base.shears[i]),
            ];
            table.row(row.into_iter().chain(of_a_body.into_iter().flatten()))?;
        }
        table.finish()
    })?;
    let mut fields = vec![Field::vectors("displacement_m", mesh, &base.displacement)];
    fields.extend(Field::stresses(&base.stress));
    folder.write_bulk("prestress.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, &[])
    })?;
    Ok(())
}
