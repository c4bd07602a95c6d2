//! `frictionsim check`: is the case valid, and what would it cost?

use super::session::{available_memory, gibibytes, read_case};
use super::{Failure, terminal};
use crate::case::{Case, Cost};
use clap::{Args, ValueHint};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Validate without running; say cost (unknowns, step, steps, memory, estimated time)
#[derive(Args)]
pub struct Arguments {
    /// Case files
    #[arg(value_name = "CASE.toml", required = true, value_hint = ValueHint::FilePath)]
    cases: Vec<PathBuf>,
    /// Override a case key (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Print one object on stdout: `cases`, one entry for each file
    #[arg(long)]
    json: bool,
}

/// Runs the subcommand: every case is checked, whatever the others are like.
///
/// # Errors
/// The errors of all bad cases.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut reports = Vec::new();
    let mut text = String::new();
    let mut bad = 0;
    for path in &arguments.cases {
        let name = path.display().to_string();
        match read_case(path, &arguments.set).and_then(fits_memory) {
            Ok(case) => {
                let cost = case.cost();
                text.push_str(&describe(&name, &case, &cost));
                reports.push(object(&name, &case, &cost));
            }
            Err(failure) => {
                bad += 1;
                failure.report();
                let errors = failure.messages();
                reports.push(json!({ "case": name, "valid": false, "errors": errors }));
            }
        }
    }
    if arguments.json {
        terminal::print_json(&json!({ "command": "check", "cases": reports }))?;
    } else {
        terminal::print(&text)?;
    }
    match bad {
        0 => Ok(()),
        _ => Err(Failure::usage(format!(
            "{bad} of {} cases cannot run",
            arguments.cases.len()
        ))),
    }
}

fn memory(cost: &Cost) -> f64 {
    let cea = cost.cea.map_or(0.0, |cea| cea.memory_bytes);
    let transient = cost
        .transient
        .map_or(0.0, |transient| transient.memory_bytes);
    let cycle = cost.cycle.map_or(0.0, |cycle| cycle.memory_bytes);
    cost.mesh_memory_bytes + cea.max(transient).max(cycle)
}

fn fits_memory(case: Case) -> Result<Case, Failure> {
    let needed = memory(&case.cost());
    match available_memory() {
        Some(available) if needed > available => Err(Failure::Case(case.error_at(
            "mesh.circumferential_elements",
            format!(
                "the case needs about {:.1} GiB of memory, {:.1} GiB are available",
                gibibytes(needed),
                gibibytes(available)
            ),
            "too many elements for this machine".to_owned(),
            Some("lower mesh.circumferential_elements or mesh.radial_elements".to_owned()),
        ))),
        _ => Ok(case),
    }
}

fn describe(name: &str, case: &Case, cost: &Cost) -> String {
    let mut out = format!("{name}: valid");
    if !case.title.is_empty() {
        let _ = write!(out, " ({})", case.title);
    }
    let _ = writeln!(
        out,
        "\n  mesh: {} nodes, {} elements, {} unknowns, about {}",
        cost.nodes,
        cost.elements,
        cost.dofs,
        size(cost.mesh_memory_bytes)
    );
    if let Some(cea) = &cost.cea {
        let _ = writeln!(
            out,
            "  cea: {} friction values, about {} modes each, {}, {} on one thread",
            cea.friction_values,
            cea.modes,
            size(cea.memory_bytes),
            duration(cea.seconds)
        );
    }
    if let Some(transient) = &cost.transient {
        let _ = writeln!(
            out,
            "  transient: time step about {:.3e} s, {:.0} steps, {}, {} on one thread",
            transient.time_step,
            transient.steps,
            size(transient.memory_bytes),
            duration(transient.seconds)
        );
    }
    if let Some(cycle) = &cost.cycle {
        let _ = writeln!(
            out,
            "  cycle: {} families of {} cycles, {}, {} on one thread",
            cycle.families,
            cycle.cycles,
            size(cycle.memory_bytes),
            duration(cycle.seconds)
        );
    }
    if let Some(points) = cost.sweep_points {
        let _ = writeln!(out, "  sweep: {points} points");
    }
    for warning in &case.warnings {
        let _ = writeln!(out, "  warning: {warning}");
    }
    out
}

fn object(name: &str, case: &Case, cost: &Cost) -> Value {
    json!({
        "case": name,
        "valid": true,
        "title": case.title,
        "case_hash": case.raw.hash(),
        "nodes": cost.nodes as u64,
        "elements": cost.elements as u64,
        "dofs": cost.dofs as u64,
        "memory_bytes": memory(cost),
        "cea": cost.cea.map(|cea| json!({
            "friction_values": cea.friction_values,
            "estimated_modes": cea.modes,
            "memory_bytes": cea.memory_bytes,
            "estimated_s": cea.seconds,
        })),
        "transient": cost.transient.map(|transient| json!({
            "time_step_s": transient.time_step,
            "steps": transient.steps,
            "memory_bytes": transient.memory_bytes,
            "estimated_s": transient.seconds,
        })),
        "cycle": cost.cycle.map(|cycle| json!({
            "families": cycle.families,
            "cycles": cycle.cycles,
            "memory_bytes": cycle.memory_bytes,
            "estimated_s": cycle.seconds,
        })),
        "sweep_points": cost.sweep_points,
        "warnings": case.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

fn size(bytes: f64) -> String {
    if bytes < f64::from(1 << 30) {
        format!("{:.1} MiB", bytes / f64::from(1 << 20))
    } else {
        format!("{:.1} GiB", gibibytes(bytes))
    }
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "under 1 s".to_owned(),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
