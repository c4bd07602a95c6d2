//! `frictionsim mesh`: the mesh alone.

use super::{Failure, RunOptions, Session};
use crate::mesh::AnnulusMesh;
use crate::results::{MeshStatistics, write_mesh, write_mesh_picture};
use clap::Args;
use serde_json::json;

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
    session.check_memory(session.case.cost().mesh_memory_bytes)?;
    let folder = session.open_folder()?;
    let annulus = AnnulusMesh::generate(&session.case.annulus).map_err(Failure::usage)?;
    let statistics = MeshStatistics::new(&annulus);
    write_mesh(&folder, &annulus.mesh)?;
    if !session.options.no_figures {
        write_mesh_picture(
            &folder,
            &annulus,
            &session.case.title,
            &session.options.figures.drawing(),
        )?;
    }
    let summary = json!({
        "command": "mesh",
        "title": session.case.title,
        "wall_s": session.wall_seconds(),
        "mesh": statistics,
        "manifest": session.manifest,
    });
    folder.write("summary.json", |out| {
        serde_json::to_writer_pretty(&mut *out, &summary)?;
        out.write_all(b"\n")
    })?;
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&table(&statistics), &summary, &path)
}

fn table(mesh: &MeshStatistics) -> String {
    format!(
        "{} nodes, {} elements, {} unknowns, {} contact nodes\n\
         edges {:.4e} to {:.4e} m, aspect ratio up to {:.2}\n\
         area {:.6e} m2, {:.1e} off the annulus\n\
         node ids: 1 + j {} + i, i outwards along a ray, j around from +x\n",
        mesh.nodes,
        mesh.elements,
        mesh.dofs,
        mesh.contact_nodes,
        mesh.smallest_edge_m,
        mesh.largest_edge_m,
        mesh.largest_aspect_ratio,
        mesh.area_m2,
        mesh.area_error,
        mesh.nodes_per_sector,
    )
}
