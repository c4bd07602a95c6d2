//! The figures of limit cycles and of their branches, from their record.

mod record;
mod report;

pub use record::{BranchRecord, CycleRecord, FamilyRecord, WaveRecord};
pub use report::draw;

use super::drawing::{FigureJob, draw_figures};
use super::figures::{
    BranchCurve, BranchCurves, ContactState, FigureError, NodeCycle, ReferenceFrequency, Snapshot,
    Snapshots, Stability, draw_branch_frequencies, draw_branch_shares, draw_contact_state,
    draw_node_cycle, draw_node_orbit, draw_snapshots,
};
use super::parameter::parameter_title;
use super::report::NamedFigure;
use crate::contact::{ContactStatus, SlidingContact};
use crate::cycle::Family;
use crate::fem::{ElasticMaterial, nodal_stress};
use crate::mesh::Mesh2d;
use std::f64::consts::TAU;

/// Whole-field pictures of one kind, at most.
const FIELD_LIMIT: usize = 8;

/// Limit cycles and what their figures show besides.
#[derive(Clone, Copy, Debug)]
pub struct CycleFigures<'a> {
    /// The record.
    pub record: &'a CycleRecord,
    /// The mesh.
    pub mesh: &'a Mesh2d,
    /// The material, for the stress fields.
    pub material: &'a ElasticMaterial,
    /// The contact at the case's own operating point.
    pub contact: SlidingContact,
    /// Radius of the contact edge, m.
    pub inner_radius: f64,
}

impl CycleFigures<'_> {
    fn peripheral_speed(&self) -> f64 {
        self.contact.rotation_speed * self.inner_radius
    }

    /// Families that have a cycle.
    fn cycles(&self) -> impl Iterator<Item = (Family, &WaveRecord)> {
        let families = self.record.families.iter();
        families.filter_map(|family| Some((family.family(), family.cycle.as_ref()?)))
    }
}

/// Draws the cycles at the case's own operating point: contact around the circle, history and closed curves of a contact
/// node for each harmonic, then the fields of all.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw_cycles(data: &CycleFigures<'_>) -> Result<Vec<NamedFigure>, FigureError> {
    let mut jobs: Vec<FigureJob<'_>> = Vec::new();
    for (family, wave) in data.cycles() {
        let (n, tag) = (family.harmonic, family.tag());
        jobs.push((
            format!("contact-{tag}"),
            format!(
                "Limit cycle of {n} nodal diameters at one instant: status around the circle (a), tractions \
                 (b), velocity (c); the pattern turns against the rotor at 1/{n} of the frequency."
            ),
            Box::new(move || contact_state(data, n, wave)),
        ));
        jobs.push((
            format!("history-{tag}"),
            format!(
                "A contact node through two periods of the limit cycle of {n} nodal diameters."
            ),
            Box::new(move || draw_node_cycle(&node_cycle(data, wave, &wave.statuses()))),
        ));
        jobs.push((
            format!("orbit-{tag}"),
            format!(
                "Phase plots, tangential (a) and radial (b), and path (c) of a contact node in the limit \
                 cycle of {n} nodal diameters."
            ),
            Box::new(move || draw_node_orbit(&node_cycle(data, wave, &wave.statuses()))),
        ));
    }
    jobs.push((
        "velocity".into(),
        "Velocity modulus and contact status of the waves at one instant.".into(),
        Box::new(move || velocity_fields(data)),
    ));
    jobs.push((
        "shear-stress".into(),
        "Shear stress of the waves at one instant.".into(),
        Box::new(move || stress_fields(data)),
    ));
    draw_figures(jobs)
}

/// Draws frequency, amplitude, statuses and powers along the branches.
///
/// # Errors
/// As [`draw_cycles`].
pub fn draw_branches(curves: &BranchCurves) -> Result<Vec<NamedFigure>, FigureError> {
    draw_figures(vec![
        (
            "branch-frequencies".into(),
            "Main frequency (a) and amplitude (b) of the limit cycles along their branches; dotted: where \
             linear theory has them begin; diamonds: folds wider than the spacing of the cycles."
                .into(),
            Box::new(move || draw_branch_frequencies(curves)),
        ),
        (
            "branch-shares".into(),
            "Contact status, and powers relative to the external one, along the branch of each family."
                .into(),
            Box::new(move || draw_branch_shares(curves)),
        ),
    ])
}

/// The wave at time zero around the whole circle: a node at angle `theta` is in phase `n theta`.
fn contact_state(
    data: &CycleFigures<'_>,
    n: usize,
    wave: &WaveRecord,
) -> Result<String, FigureError> {
    let count = n * wave.status.len();
    let around =
        |values: &[f64]| -> Vec<f64> { values.iter().copied().cycle().take(count).collect() };
    let angles: Vec<f64> = (0..count).map(|i| TAU * i as f64 / count as f64).collect();
    let status: Vec<ContactStatus> = wave.statuses().into_iter().cycle().take(count).collect();
    draw_contact_state(&ContactState {
        name: format!("{}, wave ↻", caption(n, wave)),
        angles: &angles,
        status: &status,
        pressure: &around(&wave.pressure),
        shear: &around(&wave.shear),
        tangential_velocity: &around(&wave.velocity[1]),
        peripheral_speed: data.peripheral_speed(),
    })
}

/// The contact node at angle zero, which goes through the phases in their order.
fn node_cycle<'a>(
    data: &CycleFigures<'_>,
    wave: &'a WaveRecord,
    status: &'a [ContactStatus],
) -> NodeCycle<'a> {
    let [u_r, u_t] = &wave.displacement;
    let [v_r, v_t] = &wave.velocity;
    NodeCycle {
        period: 1.0 / wave.frequency_hz,
        status,
        displacement: [u_r, u_t],
        velocity: [v_r, v_t],
        pressure: &wave.pressure,
        shear: &wave.shear,
        friction_coefficient: data.contact.friction_coefficient,
        peripheral_speed: data.peripheral_speed(),
    }
}

fn caption(n: usize, wave: &WaveRecord) -> String {
    format!("*n* = {n}, {:.2} kHz", wave.frequency_hz * 1e-3)
}

fn velocity_fields(data: &CycleFigures<'_>) -> Result<String, FigureError> {
    let cycles = || data.cycles().take(FIELD_LIMIT);
    let fields: Vec<Vec<f64>> = cycles()
        .map(|(_, wave)| {
            let pairs = wave.velocity_field.chunks_exact(2);
            pairs.map(|v| v[0].hypot(v[1])).collect()
        })
        .collect();
    let nodes = data.mesh.inner_edge.nodes.len();
    let status: Vec<Vec<ContactStatus>> = cycles()
        .map(|(family, wave)| {
            let n = family.harmonic;
            let (all, points) = (wave.statuses(), wave.status.len());
            // The phase nearest to that of each node.
            let nearest = |node: usize| (2 * n * node * points + nodes) / (2 * nodes) % points;
            (0..nodes).map(|node| all[nearest(node)]).collect()
        })
        .collect();
    draw_snapshots(&Snapshots {
        name: "velocity",
        quantity: "velocity modulus |*v*| (m/s)".into(),
        signed: false,
        mesh: data.mesh,
        frames: cycles()
            .zip(fields.iter().zip(&status))
            .map(|((family, wave), (values, status))| Snapshot {
                caption: caption(family.harmonic, wave),
                values,
                status: Some(status),
            })
            .collect(),
    })
}

fn stress_fields(data: &CycleFigures<'_>) -> Result<String, FigureError> {
    let cycles = || data.cycles().take(FIELD_LIMIT);
    let fields: Vec<Vec<f64>> = cycles()
        .map(|(_, wave)| {
            let stress = nodal_stress(data.mesh, data.material, &wave.displacement_field);
            stress.iter().map(|node| node.shear * 1e-6).collect()
        })
        .collect();
    draw_snapshots(&Snapshots {
        name: "shear-stress",
        quantity: "shear stress *τ*_{rθ} (MPa)".into(),
        signed: true,
        mesh: data.mesh,
        frames: cycles()
            .zip(&fields)
            .map(|((family, wave), values)| Snapshot {
                caption: caption(family.harmonic, wave),
                values,
                status: None,
            })
            .collect(),
    })
}

/// The branches of several families as curves, each with what its name says besides the harmonic.
pub fn branch_curves(families: &[(String, &FamilyRecord)]) -> BranchCurves {
    // A branch of a single cycle is no curve.
    let curves: Vec<(&String, &FamilyRecord, &BranchRecord)> = families
        .iter()
        .filter_map(|(suffix, family)| Some((suffix, *family, family.branch.as_ref()?)))
        .filter(|(_, _, branch)| branch.values.len() > 1)
        .collect();
    let mut references: Vec<ReferenceFrequency> = curves
        .iter()
        .filter_map(|(_, family, _)| reference(family))
        .collect();
    references.dedup();
    BranchCurves {
        parameter_title: parameter_title(curves.first().map_or("", |(_, _, branch)| &branch.key)),
        curves: curves
            .iter()
            .map(|(suffix, family, branch)| branch_curve(suffix, family, branch))
            .collect(),
        references,
    }
}

fn branch_curve(suffix: &str, family: &FamilyRecord, branch: &BranchRecord) -> BranchCurve {
    let stability = |stable: &Option<bool>| match stable {
        None => Stability::Unknown,
        Some(true) => Stability::Stable,
        Some(false) => Stability::Unstable,
    };
    let own = family.cycle.as_ref();
    BranchCurve {
        name: format!(
            "*{}{suffix}",
            family.family().to_string().replacen(' ', "* ", 1)
        ),
        values: branch.values.clone(),
        frequency_hz: branch.frequency_hz.clone(),
        amplitude: branch.amplitude.clone(),
        status: branch.status.clone(),
        shares: branch.shares.clone(),
        stability: branch.stable.iter().map(stability).collect(),
        growth_rate: branch
            .growth_rate
            .iter()
            .map(|rate| rate.unwrap_or(f64::NAN))
            .collect(),
        folds: branch.folds.clone(),
        marked: own.map(|wave| [branch.own_value, wave.frequency_hz, wave.amplitude]),
    }
}

/// The onset that the family is born at, drawn as a line.
fn reference(family: &FamilyRecord) -> Option<ReferenceFrequency> {
    let [critical, frequency_hz] = *family.onsets.get(family.onset - 1)?;
    Some(ReferenceFrequency {
        frequency_hz,
        label: format!("*n* = {} at *μ* = {critical:.3}", family.harmonic),
    })
}
