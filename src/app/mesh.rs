//! `frictionsim mesh`: the mesh alone.

use super::prelude::*;
use crate::case::{AssemblyBody, ModeLimit};
use crate::mesh::{AnnulusMesh, SolidSector};
use crate::results::mesh::{
    MeshStatistics, MeshSummary, Roles, plane_figure, plane_roles, solid_figure, write_mesh,
    write_revolution,
};

pub(super) fn run(options: &RunOptions) -> Result<(), Failure> {
    let session = Session::start("mesh", options)?;
    let case = &session.case;
    let folder = session.begin()?;
    if let Some(assembly) = case.body.assembly() {
        return run_solid(&session, folder, assembly);
    }
    let mesh = case.body.mesh().map_err(Failure::usage)?;
    let revolution = case.body.revolution();
    let grid = revolution.map(|own| own.plane()).or(case.body.grid().copied());
    let annulus = grid.map(|grid| AnnulusMesh::generate(&grid)).transpose();
    let annulus = annulus.map_err(Failure::usage)?;
    let solid = revolution.map(SolidSector::generate).transpose().map_err(Failure::usage)?;
    match &solid {
        Some(sector) => write_revolution(&folder, sector)?,
        None => write_mesh(&folder, &mesh, &plane_roles(&mesh))?,
    }
    let mut statistics = MeshStatistics::new(&mesh, annulus.as_ref(), shortest_wave(case));
    if let Some(sector) = &solid {
        statistics.turn(sector);
    }
    let figures = || vec![plane_figure(&mesh, &case.title, &case.output.recorder.probes)];
    finish(&session, folder, (statistics, Vec::new()), figures)
}

/// The mesh of solid bodies.
fn run_solid(session: &Session, folder: OutputFolder, body: &AssemblyBody) -> Result<(), Failure> {
    let case = &session.case;
    let mesh = &body.mesh;
    let roles = roles(body);
    let materials = case.body.materials.iter();
    let densities: Vec<f64> = materials.map(|material| material.elastic.density).collect();
    write_mesh(&folder, mesh, &roles)?;
    let statistics = MeshStatistics::of_solids(mesh, &densities, &roles);
    let figures = || vec![solid_figure(mesh, &case.title, &roles)];
    finish(session, folder, (statistics, case.taken.notes.clone()), figures)
}

/// Draws, writes the summary and prints.
fn finish(
    session: &Session,
    folder: OutputFolder,
    (mesh, notes): (MeshStatistics, Vec<String>),
    figures: impl FnOnce() -> Vec<Figure>,
) -> Result<(), Failure> {
    let summary = MeshSummary { mesh, notes, not_used: session.case.taken.not_used() };
    session.finish_result(folder, summary.document(), &summary, figures)
}

/// Boundaries that slide or are glued, in a word.
fn roles(assembly: &AssemblyBody) -> Roles {
    let mut roles = Roles::new();
    for tie in &assembly.ties {
        roles.extend([(tie.surface, "tie"), (tie.counter, "tie")]);
    }
    for contact in &assembly.contacts {
        roles.extend(contact.counter.surface().map(|own| (own, "counterface")));
        roles.insert(contact.surface, "contact");
    }
    roles
}

/// Shear wavelength at the highest frequency that the case asks modes for, m.
fn shortest_wave(case: &Case) -> Option<f64> {
    let ModeLimit::MaxFrequency(frequency) = case.cea.as_ref()?.modes else { return None };
    let speeds = case.body.materials.iter().map(|material| {
        let material = &material.elastic;
        (material.lame_constants()[1] / material.density).sqrt()
    });
    let slowest = speeds.fold(f64::INFINITY, f64::min);
    Some(slowest / frequency)
}
