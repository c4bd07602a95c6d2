//! `frictionsim frf`: frequency response of the model between two nodes.

use super::{Failure, RunOptions, Session};
use crate::case::{Case, Frf, FrfMethod};
use crate::fem::assemble_stiffness;
use crate::frf::{
    FrfBoundary, FrfError, FrfSystem, ReductionSettings, Terminal, direct_response,
    reduced_response,
};
use crate::mesh::AnnulusMesh;
use crate::prestress::{DampingModel, SlidingTangent, SteadySliding, TangentOptions};
use crate::results::Table;
use clap::Args;
use faer::c64;
use serde_json::json;
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
    method: &'static str,
    /// Largest relative error found at the check lines of a reduction.
    error: Option<f64>,
    vectors: Option<usize>,
}

/// Runs the subcommand.
///
/// # Errors
/// A bad case (exit code 2), contact that opens or a system at undamped resonance (1).
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("frf", &arguments.options)?;
    let case = &session.case;
    let frf = case.require_frf()?;
    session.check_memory(case.cost().mesh_memory_bytes)?;
    let folder = session.open_folder()?;
    let system = system(case, frf)?;
    let computed = compute(&system, frf)?;
    let values = observed(case, frf, &computed.receptance);
    folder.write("frf.csv", |out| write_table(out, frf, &values))?;
    let summary = json!({
        "command": "frf",
        "title": case.title,
        "dofs": system.dimension(),
        "lines": frf.frequencies_hz.len(),
        "method": computed.method,
        "largest_error": computed.error,
        "basis_vectors": computed.vectors,
        "quantity": frf.quantity.name(),
        "noise": frf.noise,
        "wall_s": session.wall_seconds(),
        "manifest": session.manifest,
    });
    folder.write("summary.json", |out| {
        serde_json::to_writer_pretty(&mut *out, &summary)?;
        out.write_all(b"\n")
    })?;
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&described(&system, frf, &computed), &summary, &path)
}

/// Matrices of the body as it is held.
fn system(case: &Case, frf: &Frf) -> Result<FrfSystem, Failure> {
    let annulus = AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?;
    let mesh = &annulus.mesh;
    let rayleigh = case.damping.rayleigh;
    if frf.boundary != FrfBoundary::Sliding {
        let is_clamped = frf.boundary == FrfBoundary::Clamped;
        return Ok(FrfSystem::body(
            mesh,
            &case.material,
            frf.mass,
            rayleigh,
            is_clamped,
        ));
    }
    let stiffness = assemble_stiffness(mesh, &case.material);
    let base = SteadySliding::solve(mesh, &stiffness, &case.contact.sliding)?;
    let options = TangentOptions {
        mass: frf.mass,
        geometric_stiffness: case.cea.as_ref().is_none_or(|cea| cea.geometric_stiffness),
        damping: rayleigh,
        damping_model: if case.damping.include_contact {
            DampingModel::WholeTangent
        } else {
            DampingModel::BodyOnly
        },
        contact: case.contact.stiffness,
    };
    let tangent = SlidingTangent::linearize(mesh, &case.material, &stiffness, &base, &options);
    Ok(FrfSystem::sliding(
        &tangent,
        case.contact.sliding.friction_coefficient,
    ))
}

/// Receptance by the method of the case.
fn compute(system: &FrfSystem, frf: &Frf) -> Result<Computed, Failure> {
    let force = system
        .unknown(frf.force, "force_node")
        .map_err(Failure::usage)?;
    let response = system
        .unknown(frf.response, "response_node")
        .map_err(Failure::usage)?;
    let f = &frf.frequencies_hz;
    if frf.method != FrfMethod::Direct {
        let settings = ReductionSettings::default();
        match reduced_response(system, force, response, f, &settings) {
            Ok(reduced) => {
                return Ok(Computed {
                    receptance: reduced.receptance,
                    method: "reduced",
                    error: Some(reduced.largest_error),
                    vectors: Some(reduced.vectors),
                });
            }
            Err(error @ FrfError::NotReduced { .. }) if frf.method == FrfMethod::Auto => {
                tracing::warn!("{error}; solved directly instead");
            }
            Err(error) => return Err(Failure::run(error)),
        }
    }
    let direct = direct_response(system, force, response, f).map_err(Failure::run)?;
    Ok(Computed {
        receptance: direct.receptance,
        method: "direct",
        error: None,
        vectors: None,
    })
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
            value + noise.next() * (frf.noise * value.norm())
        })
        .collect()
}

/// Pairs of independent standard normal numbers (Box and Muller over splitmix64).
struct GaussianNoise(u64);

impl GaussianNoise {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn next(&mut self) -> c64 {
        // 1 - u lies in (0, 1], where the logarithm exists.
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        c64::from_polar(radius, TAU * self.uniform())
    }
}

fn write_table(out: &mut dyn std::io::Write, frf: &Frf, values: &[c64]) -> std::io::Result<()> {
    let name = frf.quantity.name();
    let columns = [
        "frequency_hz",
        &format!("{name}_real"),
        &format!("{name}_imaginary"),
    ];
    let mut table = Table::new(out, &columns)?;
    for (f, h) in frf.frequencies_hz.iter().zip(values) {
        table.numbers(&[*f, h.re, h.im])?;
    }
    table.finish()
}

fn described(system: &FrfSystem, frf: &Frf, computed: &Computed) -> String {
    let place = |t: Terminal| {
        let direction = if t.is_tangential {
            "tangential"
        } else {
            "radial"
        };
        format!("node {} {direction}", t.node + 1)
    };
    let error = match (computed.error, computed.vectors) {
        (Some(error), Some(vectors)) => {
            format!(" ({vectors} vectors, largest relative error at the check lines {error:.1e})")
        }
        _ => String::new(),
    };
    format!(
        "{} from {} to {}: {} lines, {} unknowns, {}{error}\n",
        frf.quantity.name(),
        place(frf.force),
        place(frf.response),
        frf.frequencies_hz.len(),
        system.dimension(),
        computed.method,
    )
}
