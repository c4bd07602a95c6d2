//! The steady sliding state that the eigenvalues belong to.

use crate::extent::Extent;
use crate::vtu::Field;
use frictionsim_output::{Described, Table, columns};
use frictionsim_physics::contact::ContactStatus;
use frictionsim_physics::fem::NodalStress;
use frictionsim_physics::mesh::{Counterface, Mesh};
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// The steady sliding state at one friction coefficient in a few numbers.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
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
    /// What torque, force and power are of.
    pub extent: Extent,
}

impl BaseState {
    /// Torque or drag with its name and unit.
    pub(super) fn drive(&self) -> String {
        match (self.torque_n_m, self.drag_n) {
            (Some(torque), _) => format!("torque {torque:.4} {}", self.extent.unit("N m")),
            (None, Some(drag)) => format!("drag {drag:.4} {}", self.extent.unit("N")),
            (None, None) => String::new(),
        }
    }

    /// Its numbers of the whole file.
    pub(super) fn whole(&self) -> [Field; 2] {
        [
            Field::number("friction_coefficient", self.friction_coefficient),
            Field::number("power_w", self.power_w),
        ]
    }

    /// Its power with the unit.
    pub(super) fn power(&self) -> String {
        format!("{:.1} {}", self.power_w, self.extent.unit("W"))
    }
}

columns! {
    /// A contact node and its angle, rad.
    pub(crate) NODES: row as (usize, f64);
    node: "number of the contact node" = row.0;
    angle_degrees: "its angle about the axis; along a straight edge its place" = row.1.to_degrees();
}

columns! {
    /// Pressure and traction.
    pub(crate) TRACTIONS: row as (f64, f64);
    pressure_pa: "contact pressure" = row.0;
    shear_pa: "friction traction" = row.1;
}

columns! {
    /// Whether it presses.
    pub(crate) STATUS: is_pressed as bool;
    status: "slip, or open" = sliding_status(*is_pressed).name();
}

/// The status of a contact that slides where it is pressed.
pub(super) fn sliding_status(is_pressed: bool) -> ContactStatus {
    if is_pressed { ContactStatus::Slip } else { ContactStatus::Open }
}

columns! {
    /// Where it is in the plane.
    pub(crate) PLANE: place as [f64; 2];
    x_m: "place of the contact node" = place[0];
    y_m: "place of the contact node" = place[1];
}

/// The same state node by node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BaseField {
    /// Contact nodes, 0-based, in order along the edge.
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

impl BaseField {
    /// The contact nodes as figures and tables list them: place in the fields of this struct and angle, rad.
    ///
    /// Around a whole circle the angles rise from 0 to `2 pi`; along an arc they go on from that of its first node
    /// without a jump by a turn. Shares of a straight edge stay as they are.
    pub fn along_contact(&self, mesh: &Mesh) -> Vec<(usize, f64)> {
        let mut places: Vec<(usize, f64)> = self.angles.iter().copied().enumerate().collect();
        if matches!(mesh.counterface, Counterface::Plane { .. }) {
            return places;
        }
        if mesh.contact_edge().is_closed {
            for (_, angle) in &mut places {
                let turned = angle.rem_euclid(TAU);
                // The angle of round-off below zero is zero.
                *angle = if TAU - turned < 1e-9 { 0.0 } else { turned };
            }
            frictionsim_physics::order::sort_by_number(&mut places, |a| a.1);
            return places;
        }
        for i in 1..places.len() {
            let step = places[i].1 - places[i - 1].1;
            places[i].1 -= TAU * ((step + PI) / TAU).floor();
        }
        places
    }

    /// The contact nodes.
    pub(super) fn table(&self, mesh: &Mesh) -> Table {
        let along = self.along_contact(mesh);
        let places = || along.iter().map(|own| own.0);
        let label = |i: usize| mesh.node_label(self.nodes[i] as usize);
        let table = Table::new("prestress.csv", "")
            .columns(NODES, along.iter().map(|&(i, angle)| (label(i), angle)))
            .columns(TRACTIONS, places().map(|i| (self.pressures[i], self.shears[i])));
        // On an annulus every node slips, at its angle.
        let Some(is_pressed) = &self.is_pressed else {
            return table;
        };
        let place = |i: usize| mesh.plane_node(self.nodes[i] as usize);
        table.columns(STATUS, places().map(|i| is_pressed[i])).columns(PLANE, places().map(place))
    }

    /// Displacement and stress of all nodes; status, pressure and friction traction of the contact edge.
    pub(super) fn fields(&self, mesh: &Mesh) -> Vec<Field> {
        let is_pressed = |i: usize| self.is_pressed.as_ref().is_none_or(|pressed| pressed[i]);
        let statuses = (0..self.nodes.len()).map(|i| sliding_status(is_pressed(i)));
        let tractions = [&self.pressures[..], &self.shears];
        let mut fields = vec![Field::vectors("displacement_m", mesh, &self.displacement)];
        fields.extend(Field::stresses(&self.stress));
        fields.extend(Field::cartesian_stresses(mesh, &self.stress));
        fields.extend(Field::contact(mesh.node_count(), &self.nodes, statuses, tractions));
        fields
    }
}
