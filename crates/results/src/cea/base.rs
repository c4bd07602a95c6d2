//! The steady sliding state that the eigenvalues belong to.

use crate::BodyStress;
use crate::common::*;

keys! {
    /// The steady sliding state at one friction coefficient in a few numbers.
    #[derive(Copy)]
    BaseState {
        friction_coefficient: f64 = "friction coefficient";
        slipping: usize = "contact nodes in slip";
        sticking: usize = "contact nodes that stick";
        open: usize = "contact nodes without contact";
        pressure_pa: [f64; 2] = "contact pressure, smallest and largest, Pa";
        shear_pa: [f64; 2] = "friction traction with the sign of that in `prestress.csv`, smallest and largest, Pa";
        torque_n_m?: f64 = "friction torque of all contacts that turn, of the whole thickness, N m";
        drag_n?: f64 = "friction force of all contacts that slide straight, of the whole thickness, N";
        power_w: f64 = "power that the counterface puts in, W";
        extent: Extent = "what torque, force and power are of";
    }
}

impl BaseState {
    /// Torque and drag with their names and units.
    pub(super) fn drive(&self) -> String {
        let all = [("torque", self.torque_n_m, "N m"), ("drag", self.drag_n, "N")];
        let all = all.into_iter().filter_map(|(name, value, unit)| {
            Some(format!("{name} {} {}", significant(value?, 6), self.extent.unit(unit)))
        });
        all.collect::<Vec<_>>().join(", ")
    }

    /// Whether no contact presses: closed ones without prestress, or none at all. Loads may stress the bodies.
    pub(super) fn is_without_pressure(&self) -> bool {
        let [low, high] = self.pressure_pa;
        low >= 0.0 && high <= 0.0
    }

    /// Its power with the unit.
    pub(super) fn power(&self) -> String {
        format!("{:.1} {}", self.power_w, self.extent.unit("W"))
    }
}

/// A place of the contact: a node of a plane edge, a ring of nodes of a body of revolution, or a point between the
/// nodes of solid bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactPlace {
    /// Name of its contact.
    pub contact: String,
    /// Where it is, m; of a ring radius, 0 and height.
    pub position: [f64; 3],
    /// Angle of a node of a plane edge, rad.
    pub angle: Option<f64>,
    /// Unit vector along which the other surface slides over a point of solid bodies.
    pub direction: Option<[f64; 3]>,
    /// Area that belongs to it, m2.
    pub area: f64,
    /// Nodes that it is among, with their shares in it.
    pub shares: Vec<(u32, f64)>,
}

/// The contact at one place in the base state.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactState {
    /// The place.
    pub place: ContactPlace,
    /// Sliding speed, m/s.
    pub speed: f64,
    /// Contact pressure, Pa.
    pub pressure: f64,
    /// Friction traction, Pa.
    pub shear: f64,
    /// Whether it is pressed; else it is open.
    pub is_pressed: bool,
}

columns! {
    /// A contact node and its angle, rad.
    pub(crate) NODES: row as (usize, Option<f64>);
    node: "number of the contact node" = row.0;
    angle_degrees: "its angle about the axis; none along a straight edge" = row.1.map(f64::to_degrees);

    /// A ring of contact nodes.
    pub(crate) RINGS: own as ContactState;
    radius_m: "radius of the ring of contact nodes, of bodies of revolution" = own.place.position[0];
    height_m: "its height" = own.place.position[2];

    /// A contact point of solid bodies.
    pub(crate) POINTS: own as ContactState;
    contact: "name of the contact" = own.place.contact.clone();
    x_m: "place of the contact node or point" = own.place.position[0];
    y_m: "place of the contact node or point" = own.place.position[1];
    z_m: "place of the contact point" = own.place.position[2];
    area_m2: "area that belongs to it" = own.place.area;

    /// Pressure and traction, and whether it presses.
    pub(crate) TRACTIONS: own as ContactState;
    pressure_pa: "contact pressure" = own.pressure;
    shear_pa: "friction traction on the body: in the plane along `u_theta` or the normal towards the body turned \
        by +90 degrees, else along the sliding" = own.shear;
    status: "slip, or open" = own.status().name();
}

/// The name of a contact, its place in the plane, and what else there is in three dimensions.
pub(crate) const NAME: &[Column<ContactState>] = parted(POINTS, "x_m").0;
pub(crate) const PLANE: &[Column<ContactState>] = parted(parted(POINTS, "x_m").1, "z_m").0;
pub(crate) const SPACE: &[Column<ContactState>] = parted(POINTS, "z_m").1;

impl ContactState {
    /// The status of a contact that slides where it is pressed.
    fn status(&self) -> ContactStatus {
        if self.is_pressed { ContactStatus::Slip } else { ContactStatus::Open }
    }
}

/// The same state place by place.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseField {
    /// The contact, along an edge in order.
    pub contact: Vec<ContactState>,
    /// Each contact of solid bodies with the boundary that has its points.
    pub surfaces: Vec<(String, usize)>,
    /// Displacement of every node in nodal frames, two or three values a node, m.
    pub displacement: Vec<f64>,
    /// Stress at every node.
    pub stress: BodyStress,
}

impl BaseField {
    /// The contact as figures and tables list it: place in the fields of this struct and angle, rad, of a plane edge.
    ///
    /// Around a whole circle the angles rise from 0 to `2 pi`; along an arc they go on from that of its first node
    /// without a jump by a turn. Shares of a straight edge stay as they are.
    pub fn along_contact(&self, mesh: &Mesh) -> Vec<(usize, f64)> {
        let angles = self.contact.iter().map(|own| own.place.angle.unwrap_or_default());
        let mut places: Vec<(usize, f64)> = angles.enumerate().collect();
        if matches!(mesh.counterface, Counterface::Plane { .. }) {
            return places;
        }
        if mesh.contact_edge().is_closed {
            for (_, angle) in &mut places {
                let turned = angle.rem_euclid(TAU);
                // The angle of round-off below zero is zero.
                *angle = if TAU - turned < 1e-9 { 0.0 } else { turned };
            }
            return sorted(places, |own| own.1);
        }
        for i in 1..places.len() {
            let step = places[i].1 - places[i - 1].1;
            places[i].1 -= TAU * ((step + PI) / TAU).floor();
        }
        places
    }

    /// `prestress.csv`: the contact place by place.
    pub(super) fn table(&self, body: &ShownBody<'_>, has_harmonics: bool) -> Table {
        let table = Table::new("prestress.csv", "");
        let all = &self.contact;
        if body.is_solid() {
            let places = if body.is_assembly() { POINTS } else { RINGS };
            return table.columns(places, all).columns(TRACTIONS, all);
        }
        let along = self.along_contact(body.mesh);
        let all = || along.iter().map(|own| &all[own.0]);
        let label = |own: &ContactState| body.mesh.node_label(own.place.shares[0].0 as usize);
        // The places along a straight edge are no angles.
        let is_round = !matches!(body.mesh.counterface, Counterface::Plane { .. });
        let angles = along.iter().map(|own| is_round.then_some(own.1));
        let nodes = all().map(label).zip(angles);
        let table = table.columns(NODES, nodes).columns(TRACTIONS, all());
        // On an annulus the angle is the place.
        if has_harmonics { table } else { table.columns(PLANE, all()) }
    }

    /// Displacement and stress of all nodes, and the contact: of solid bodies pressure, traction and closed share of
    /// the points around each node, of others status, pressure and friction traction of the contact nodes.
    pub(super) fn fields(&self, body: &ShownBody<'_>) -> Vec<Field> {
        let mut fields = vec![body.vectors("displacement_m", &self.displacement)];
        if body.is_assembly() {
            let around = |name: &str, value| {
                Field::scalars(name, or_zero(self.around_nodes(body.mesh.node_count(), value)))
            };
            fields.push(around("pressure_pa", |own| own.pressure));
            fields.push(around("shear_pa", |own| own.shear));
            fields.push(around("closed_share", closed_share));
        }
        fields.extend(body.stress_fields(&self.stress));
        if !body.is_assembly() {
            fields.extend(self.at_nodes(body));
        }
        fields
    }

    /// Status, pressure and friction traction at the contact nodes.
    fn at_nodes(&self, body: &ShownBody<'_>) -> [Field; 3] {
        let states = self.contact.iter().flat_map(|own| {
            let state = (own.status(), [own.pressure, own.shear]);
            own.place.shares.iter().map(move |&(node, _)| (node, state.0, state.1))
        });
        Field::contact(self.displacement.len() / body.dimension(), states)
    }

    /// Mean over the contact points around each node, weighted by area and share; NaN where there is none.
    pub(super) fn around_nodes(&self, count: usize, value: fn(&ContactState) -> f64) -> Vec<f64> {
        let all = self.contact.iter().map(|own| (&own.place, value(own)));
        means_around(count, all, |value, area, share| area * share * value)
    }
}

/// 1 where it is closed, else 0.
pub(super) fn closed_share(own: &ContactState) -> f64 {
    f64::from(u8::from(own.is_pressed))
}

/// Zero where there is no contact point.
pub(super) fn or_zero(means: Vec<f64>) -> Vec<f64> {
    means.into_iter().map(|mean| if mean.is_nan() { 0.0 } else { mean }).collect()
}

/// Sums over the contact points around each node, of what each has there by its value, area and share, over that of the
/// area; NaN where there is none.
pub(super) fn means_around<'a>(
    count: usize,
    points: impl Iterator<Item = (&'a ContactPlace, f64)>,
    term: fn(f64, f64, f64) -> f64,
) -> Vec<f64> {
    let mut sums = vec![[0.0; 2]; count];
    for (place, value) in points {
        for &(node, share) in &place.shares {
            // Shape functions of corners of quadratic faces may be negative.
            let sum = &mut sums[node as usize];
            sum[0] += term(value, place.area, share.abs());
            sum[1] += place.area * share.abs();
        }
    }
    let mean = |[sum, area]: [f64; 2]| if area > 0.0 { sum / area } else { f64::NAN };
    sums.into_iter().map(mean).collect()
}
