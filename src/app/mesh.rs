//! `frictionsim mesh`: the mesh alone.

use super::{Failure, RunOptions, Session};
use crate::case::Case;
use crate::mesh::AnnulusMesh;
use crate::results::mesh::{MeshStatistics, MeshSummary, print, write_mesh, write_mesh_picture};
use crate::results::{DrawingOptions, OutputFolder, write_summary};
use clap::Args;

/// Mesh only: statistics, VTU, picture
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
}

/// Runs the subcommand.
///
/// # Errors
/// A bad case, or an output folder that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("mesh", &arguments.options)?;
    let case = &session.case;
    session.check_memory(case.cost().mesh_memory_bytes)?;
    let folder = session.open_folder()?;
    let annulus = AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?;
    write_mesh(&folder, &annulus.mesh)?;
    if !session.options.output.no_figures {
        redraw(&folder, case, &session.options.output.figures.drawing())?;
    }
    let summary = MeshSummary {
        command: "mesh".to_owned(),
        title: case.title.clone(),
        wall_s: session.wall_seconds(),
        mesh: MeshStatistics::new(&annulus),
        manifest: session.manifest.clone(),
    };
    let object = write_summary(&folder, &summary)?;
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&print(&summary), &object, &path)
}

/// Draws the picture of a folder again.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn redraw(folder: &OutputFolder, case: &Case, options: &DrawingOptions) -> Result<(), Failure> {
    let annulus = AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?;
    write_mesh_picture(
        folder,
        &annulus,
        (&case.title, &case.output.probes),
        options,
    )?;
    Ok(())
}
