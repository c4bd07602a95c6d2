//! `frictionsim frf`: frequency response of the model between two nodes.

use super::{Failure, RunOptions, Session, terminal};
use crate::case::{Case, Frf, FrfMethod};
use crate::fem::assemble_stiffness;
use crate::frf::{
    CyclicSystem, FrfBoundary, FrfSystem, ReductionSettings, Terminal, cyclic_response,
    direct_response_with, reduced_response,
};
use crate::linalg::GaussianNoise;
use crate::linalg::c64;
use crate::mesh::SectorMesh;
use crate::prestress::{SectorTangent, SlidingTangent, SteadySliding};
use crate::results::{
    DrawingOptions, OutputFolder, RESPONSE_TABLE, ResponseSummary, draw_response_report,
    read_response_table, read_summary, write_response, write_summary,
};
use crate::signal::FrequencyResponse;
use crate::signal::reader::{ResponseOptions, read_response};
use crate::study::tangent_options;
use clap::Args;
use indicatif::ProgressBar;
use std::f64::consts::TAU;

/// Frequency response of the model between two nodes
///
/// Writes frf.csv, which `frictionsim identify` reads: identification checked against known damping,
/// or a model held against a hammer test. Needs a [frf] section in the case.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
}

/// A computed response and how it came about.
struct Computed {
    receptance: Vec<c64>,
    dofs: usize,
    method: &'static str,
    /// Largest relative error found at the check lines of a reduction.
    error: Option<f64>,
    vectors: Option<usize>,
    /// Largest backward error of the solutions, harmonic by harmonic.
    backward_error: Option<f64>,
}

/// Runs the subcommand.
///
/// # Errors
/// A bad case (exit code 2), contact that opens or a system at undamped resonance (1).
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("frf", &arguments.options)?;
    let case = &session.case;
    let frf = case.require_frf()?;
    session.check_memory(case.memory("frf").0)?;
    let folder = session.open_folder()?;
    terminal::catch_signals(terminal::NOTHING_KEPT);
    let bar = terminal::progress(session.options.output.is_quiet(), 0, "frequencies");
    let computed = compute(case, frf, &bar)?;
    bar.finish_and_clear();
    let values = observed(case, frf, &computed.receptance);
    write_response(&folder, frf.quantity, &frf.frequencies_hz, &values)?;
    let summary = ResponseSummary {
        command: "frf".to_owned(),
        title: case.title.clone(),
        description: described(case, frf, &computed),
        dofs: computed.dofs,
        lines: frf.frequencies_hz.len(),
        method: computed.method.to_owned(),
        largest_error: computed.error,
        basis_vectors: computed.vectors,
        backward_error: computed.backward_error,
        quantity: frf.quantity.name().to_owned(),
        noise: frf.noise,
        wall_s: session.wall_seconds(),
        manifest: session.manifest.clone(),
    };
    let object = write_summary(&folder, &summary)?;
    if !session.options.output.no_figures {
        let response = FrequencyResponse::new(frf.frequencies_hz.clone(), values, frf.quantity);
        let response = response.map_err(Failure::run)?;
        draw_response_report(
            &folder,
            &response,
            &summary,
            &session.options.output.figures.drawing(),
        )?;
    }
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&format!("{}\n", summary.description), &object, &path)
}

/// Draws the figure and the report of a folder from its `frf.csv` and its summary.
///
/// # Errors
/// A folder without a whole table and summary; those of the drawing and of the folder.
pub fn redraw(folder: &OutputFolder, options: &DrawingOptions) -> Result<(), Failure> {
    let summary: ResponseSummary = read_summary(folder.path())?;
    let name = folder.path().join(RESPONSE_TABLE).display().to_string();
    let reading = ResponseOptions::default();
    let file = read_response(&read_response_table(folder)?, &name, &reading)?;
    draw_response_report(folder, &file.responses[0].response, &summary, options)?;
    Ok(())
}

/// Receptance by the method of the case.
fn compute(case: &Case, frf: &Frf, bar: &ProgressBar) -> Result<Computed, Failure> {
    match frf.method {
        FrfMethod::Auto if !case.is_annulus() => reduced(case, frf),
        FrfMethod::Auto | FrfMethod::Cyclic => cyclic(case, frf),
        FrfMethod::Direct => direct(case, frf, bar),
        FrfMethod::Reduced => reduced(case, frf),
    }
}

/// Finds out whether force and response act where the boundary leaves the body free.
///
/// # Errors
/// A node that does not exist or is held; a base state that does not exist.
pub fn preflight(case: &Case, frf: &Frf) -> Result<(), Failure> {
    if case.is_annulus() {
        cyclic_system(case, frf).map(|_| ())
    } else {
        whole_mesh(case, frf).map(|_| ())
    }
}

fn cyclic_system(case: &Case, frf: &Frf) -> Result<CyclicSystem, Failure> {
    if !case.is_annulus() {
        return Err(Failure::Case(case.error_at(
            "frf.method",
            "frf.method = \"cyclic\" needs the symmetry of the built-in annulus".to_owned(),
            "an imported mesh has no sectors".to_owned(),
            Some("use \"auto\", \"direct\" or \"reduced\"".to_owned()),
        )));
    }
    let sector = SectorMesh::generate(&case.annulus).map_err(Failure::usage)?;
    let contact = &case.contact.sliding;
    let system = if frf.boundary == FrfBoundary::Sliding {
        let options = tangent_options(case, frf.mass);
        let tangent = SectorTangent::linearize(&sector, case.materials(), &options, contact)?;
        CyclicSystem::sliding(&tangent, contact.friction_coefficient)
    } else {
        let is_clamped = frf.boundary == FrfBoundary::Clamped;
        let rayleigh = case.damping.rayleigh;
        CyclicSystem::body(&sector, &case.material, frf.mass, rayleigh, is_clamped)
    };
    for (terminal, key) in [(frf.force, "force_node"), (frf.response, "response_node")] {
        system.check(terminal, key).map_err(Failure::usage)?;
    }
    Ok(system)
}

fn cyclic(case: &Case, frf: &Frf) -> Result<Computed, Failure> {
    let system = cyclic_system(case, frf)?;
    let solved = cyclic_response(&system, frf.force, frf.response, &frf.frequencies_hz)
        .map_err(Failure::run)?;
    Ok(Computed {
        receptance: solved.receptance,
        dofs: system.dimension(),
        method: "cyclic",
        error: None,
        vectors: None,
        backward_error: Some(solved.backward_error),
    })
}

fn direct(case: &Case, frf: &Frf, bar: &ProgressBar) -> Result<Computed, Failure> {
    let (system, force, response) = whole_mesh(case, frf)?;
    bar.set_length(frf.frequencies_hz.len() as u64);
    let done = |lines: usize| bar.inc(lines as u64);
    let lines = &frf.frequencies_hz;
    let solved =
        direct_response_with(&system, force, response, lines, &done).map_err(Failure::run)?;
    Ok(Computed {
        receptance: solved.receptance,
        dofs: system.dimension(),
        method: "direct",
        error: None,
        vectors: None,
        backward_error: None,
    })
}

fn reduced(case: &Case, frf: &Frf) -> Result<Computed, Failure> {
    let (system, force, response) = whole_mesh(case, frf)?;
    let settings = ReductionSettings::default();
    let reduced = reduced_response(&system, force, response, &frf.frequencies_hz, &settings)
        .map_err(Failure::run)?;
    Ok(Computed {
        receptance: reduced.receptance,
        dofs: system.dimension(),
        method: "reduced",
        error: Some(reduced.largest_error),
        vectors: Some(reduced.vectors),
        backward_error: None,
    })
}

/// Matrices of the body as it is held, and the unknowns of force and response.
fn whole_mesh(case: &Case, frf: &Frf) -> Result<(FrfSystem, usize, usize), Failure> {
    let mesh = &*case.mesh().map_err(Failure::usage)?;
    let system = if frf.boundary == FrfBoundary::Sliding {
        let stiffness = assemble_stiffness(mesh, case.materials());
        let base = SteadySliding::solve(mesh, &stiffness, &case.contact.sliding)?;
        let options = tangent_options(case, frf.mass);
        let tangent =
            SlidingTangent::linearize(mesh, case.materials(), &stiffness, &base, &options);
        FrfSystem::sliding(&tangent, case.contact.sliding.friction_coefficient)
    } else {
        let is_clamped = frf.boundary == FrfBoundary::Clamped;
        let rayleigh = case.damping.rayleigh;
        FrfSystem::body(mesh, case.materials(), frf.mass, rayleigh, is_clamped)
    };
    let unknown = |terminal, key| system.unknown(terminal, key).map_err(Failure::usage);
    let force = unknown(frf.force, "force_node")?;
    let response = unknown(frf.response, "response_node")?;
    Ok((system, force, response))
}

/// The quantity asked for, for the disc's thickness, with noise.
fn observed(case: &Case, frf: &Frf, receptance: &[c64]) -> Vec<c64> {
    let mut noise = GaussianNoise::new(frf.noise_seed as u64);
    frf.frequencies_hz
        .iter()
        .zip(receptance)
        .map(|(f, h)| {
            let rate = c64::new(0.0, TAU * f).powi(frf.quantity.derivatives());
            let value = h * rate / case.thickness;
            value + noise.draw() * (frf.noise * value.norm())
        })
        .collect()
}

fn described(case: &Case, frf: &Frf, computed: &Computed) -> String {
    let place = |t: Terminal| {
        let direction = if t.is_tangential {
            "tangential"
        } else {
            "radial"
        };
        format!("node {} {direction}", case.node_label(t.node))
    };
    let error = match (computed.error, computed.vectors, computed.backward_error) {
        (Some(error), Some(vectors), _) => {
            format!(" ({vectors} vectors, largest relative error at the check lines {error:.1e})")
        }
        (_, _, Some(error)) => format!(" (largest backward error {error:.1e})"),
        _ => String::new(),
    };
    format!(
        "{} from {} to {}: {} lines, {} unknowns, {}{error}",
        frf.quantity.name(),
        place(frf.force),
        place(frf.response),
        frf.frequencies_hz.len(),
        computed.dofs,
        computed.method,
    )
}
