//! `frictionsim check`: is the case valid, and what would it cost?

use super::options::CaseChanges;
use super::profile::Profile;
use super::session::{gibibytes, machine_memory, read_case};
use super::{Failure, superelement, terminal};
use crate::case::{Case, Convergence, Cost, FreeSystem, StudyCost};
use crate::study::{Preflight, preflight};
use clap::{Args, ValueHint};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Time beyond which a run is hardly meant, s: 30 days.
const LONGEST_RUN: f64 = 30.0 * 86_400.0;

/// Validate a case without running it; estimate memory and time
#[derive(Args)]
pub struct Arguments {
    /// Case files
    #[arg(value_name = "CASE.toml", required = true, value_hint = ValueHint::FilePath)]
    cases: Vec<PathBuf>,
    #[command(flatten)]
    changes: CaseChanges,
    /// Print one object on stdout: `cases`, one entry for each file
    #[arg(long)]
    json: bool,
}

/// What the rest of the program asks of this command.
pub const PROFILE: Profile = Profile {
    files: &[],
    examples: &[("frictionsim check *.toml", "are these cases valid, and what do they cost?")],
};

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
        match check(path, arguments) {
            Ok(Checked::Bodies(case, found)) => {
                text.push_str(&describe(&name, &case, &found));
                reports.push(object(&name, &case, &found));
            }
            Ok(Checked::Superelement(system)) => {
                text.push_str(&describe_superelement(&name, &system));
                reports.push(superelement_object(&name, &system));
            }
            Err(failure) => {
                bad += 1;
                terminal::report(&failure);
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
            "{bad} of {} cannot run",
            plural(arguments.cases.len(), "case")
        ))),
    }
}

/// Whether a case is valid and what it would cost: the entry of `frictionsim check --json`.
///
/// # Errors
/// Those of the case.
pub fn examine(path: &Path, overrides: &[String]) -> Result<Value, Failure> {
    if let Some(system) = superelement::described(path, overrides)? {
        return Ok(superelement_object(&path.display().to_string(), &system));
    }
    let case = read_case(path, overrides)?;
    let found = preflight(&case, machine_memory())?;
    Ok(object(&path.display().to_string(), &case, &found))
}

/// A case that is valid.
enum Checked {
    Bodies(Box<Case>, Preflight),
    Superelement(FreeSystem),
}

fn check(path: &Path, arguments: &Arguments) -> Result<Checked, Failure> {
    let overrides = arguments.changes.overrides();
    if let Some(system) = superelement::described(path, &overrides)? {
        return Ok(Checked::Superelement(system));
    }
    let case = read_case(path, &overrides)?;
    let found = preflight(&case, machine_memory());
    if found.is_err() {
        // An implausible value is often the cause of what cannot run.
        for warning in &case.warnings {
            terminal::warn(warning);
        }
    }
    let found = found?;
    if arguments.changes.deny_warnings {
        case.deny_warnings(&found.warnings)?;
    }
    Ok(Checked::Bodies(Box::new(case), found))
}

fn describe_superelement(name: &str, system: &FreeSystem) -> String {
    let own = &system.superelement;
    let mut out = format!("{name}: valid");
    if !system.title.is_empty() {
        let _ = write!(out, " ({})", system.title);
    }
    let _ = writeln!(out, "\n  superelement {}: {}", own.name, plural(own.mass.rows, "unknown"));
    out
}

fn superelement_object(name: &str, system: &FreeSystem) -> Value {
    json!({
        "case": name,
        "valid": true,
        "title": system.title,
        "case_hash": system.hash,
        "dofs": system.superelement.mass.rows,
        "warnings": [],
    })
}

fn describe(name: &str, case: &Case, found: &Preflight) -> String {
    let mut out = format!("{name}: valid");
    if !case.title.is_empty() {
        let _ = write!(out, " ({})", case.title);
    }
    let Cost { nodes, elements, dofs, .. } = found.cost;
    let _ = writeln!(
        out,
        "\n  mesh: {nodes} nodes, {elements} elements, {dofs} unknowns, about {}",
        size(found.cost.mesh_memory_bytes)
    );
    let mut longest: f64 = 0.0;
    let mut line = |what: &str, text: String, bytes: f64, seconds: f64| {
        let (size, time) = (size(bytes), magnitude(seconds));
        longest = longest.max(seconds);
        let _ = writeln!(out, "  {what}: {text}, {size}, {time} on one thread");
    };
    let cost = &found.cost;
    if let Some(cea) = &cost.cea {
        let text = format!(
            "{}, about {} each",
            plural(cea.friction_values, "friction value"),
            plural(cea.modes, "mode")
        );
        line("cea", text, cea.memory_bytes, cea.seconds);
    }
    if let Some(run) = &cost.transient {
        let about = if found.is_step_exact { "" } else { "about " };
        let text = format!("time step {about}{:.4e} s, {:.0} steps", run.time_step, run.steps);
        line("transient", text, run.memory_bytes, run.seconds);
    }
    if let Some(cycle) = &cost.cycle {
        let families = match cycle.families {
            1 => "1 family".to_owned(),
            count => format!("{count} families"),
        };
        let text = format!("{families} of {}", plural(cycle.cycles, "cycle"));
        line("cycle", text, cycle.memory_bytes, cycle.seconds);
    }
    if case.basin.is_some() {
        let text = "one boundary between two limit cycles".to_owned();
        line("basin", text, cost.mesh_memory_bytes, cost.basin_seconds);
    }
    if let Some(frf) = &cost.frf {
        let text = match frf.lines {
            1 => "1 frequency".to_owned(),
            count => format!("{count} frequencies"),
        };
        line("frf", text, frf.memory_bytes, frf.seconds);
    }
    if let Some(study) = &found.convergence {
        let text = format!("{} ({})", plural(study.runs, "run"), meshes(case));
        line("convergence", text, study.memory_bytes, study.seconds);
    }
    if let Some(study) = &found.sweep {
        let text = plural(study.runs, "point");
        line("sweep", text, study.memory_bytes, study.seconds);
    }
    if let Some(study) = &found.uncertainty {
        let text = plural(study.runs, "run");
        line("uncertainty", text, study.memory_bytes, study.seconds);
    }
    if longest > LONGEST_RUN {
        let _ = writeln!(
            out,
            "  warning: a run of {} is hardly meant: use fewer elements, or a shorter duration",
            duration(longest)
        );
    }
    for note in &case.taken.notes {
        let _ = writeln!(out, "  {note}");
    }
    for warning in case.warnings.iter().chain(&found.warnings) {
        let _ = writeln!(out, "  warning: {warning}");
    }
    out
}

/// The meshes and time steps of a convergence study.
fn meshes(case: &Case) -> String {
    let Some(study) = &case.convergence else {
        return String::new();
    };
    let meshes = study.factors.iter().map(|factor| {
        let Some(grid) = case.body.grid() else {
            let elements = case.body.element_count() as f64 * factor * factor;
            return format!("{elements:.0} elements");
        };
        let mesh = Convergence::refined(grid, *factor);
        format!("{} x {}", mesh.circumferential_elements, mesh.radial_elements)
    });
    let mut text = meshes.collect::<Vec<_>>().join(", ");
    if !study.time_step_factors.is_empty() {
        let _ = write!(text, "; {} time steps", study.time_step_factors.len());
    }
    text
}

fn object(name: &str, case: &Case, found: &Preflight) -> Value {
    let cost = &found.cost;
    let study = |study: &StudyCost, runs: &str| json!({ runs: study.runs, "memory_bytes": study.memory_bytes, "estimated_s": study.seconds });
    let warnings = case.warnings.iter().chain(&found.warnings);
    json!({
        "case": name,
        "valid": true,
        "title": case.title,
        "case_hash": case.raw.hash(),
        "nodes": cost.nodes as u64,
        "elements": cost.elements as u64,
        "dofs": cost.dofs as u64,
        "memory_bytes": found.memory_bytes,
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
        "basin": case.basin.as_ref().map(|_| json!({ "estimated_s": cost.basin_seconds })),
        "frf": cost.frf.map(|frf| json!({
            "lines": frf.lines,
            "memory_bytes": frf.memory_bytes,
            "estimated_s": frf.seconds,
        })),
        "convergence": found.convergence.as_ref().map(|cost| study(cost, "runs")),
        "uncertainty": found.uncertainty.as_ref().map(|cost| study(cost, "runs")),
        "sweep": found.sweep.as_ref().map(|cost| study(cost, "points")),
        "sweep_points": found.sweep.map(|sweep| sweep.runs),
        "notes": case.taken.notes,
        "warnings": warnings.map(ToString::to_string).collect::<Vec<_>>(),
    })
}

/// A count with its noun.
fn plural(count: usize, noun: &str) -> String {
    match count {
        1 => format!("1 {noun}"),
        _ => format!("{count} {noun}s"),
    }
}

fn size(bytes: f64) -> String {
    if bytes < f64::from(1 << 30) {
        format!("{:.1} MiB", bytes / f64::from(1 << 20))
    } else {
        format!("{:.1} GiB", gibibytes(bytes))
    }
}

/// A time as it is estimated: to an order of magnitude.
fn magnitude(seconds: f64) -> &'static str {
    match seconds {
        s if s < 60.0 => "seconds",
        s if s < 3600.0 => "minutes",
        s if s < 2.0 * 86_400.0 => "hours",
        _ => "days",
    }
}

/// A time that is hardly meant.
fn duration(seconds: f64) -> String {
    const DAY: f64 = 86_400.0;
    const YEAR: f64 = 365.25 * DAY;
    match seconds {
        s if s < 2.0 * YEAR => format!("{:.0} days", s / DAY),
        s if s < 1000.0 * YEAR => format!("{:.0} years", s / YEAR),
        _ => "over 1000 years".to_owned(),
    }
}
