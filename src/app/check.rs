//! `frictionsim check`: is the case valid, and what would it cost?

use super::prelude::*;
use super::session::{machine_memory, read_case};
use super::{cea::described_system, options::CaseChanges};
use crate::case::{Convergence, Cost, FreeSystem, RunCost, StudyCost};
use crate::results::plural;
use crate::study::{Preflight, preflight};
use std::fmt::Write as _;

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

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let mut reports = Vec::new();
    let mut text = String::new();
    let mut bad = 0;
    for path in &asked.cases {
        let name = path.display().to_string();
        match check(path, &name, &asked.changes) {
            Ok((described, report)) => {
                text.push_str(&described);
                reports.push(report);
            }
            Err(failure) => {
                bad += 1;
                terminal::report(&failure);
                let errors = failure.messages();
                reports.push(json!({ "case": name, "valid": false, "errors": errors }));
            }
        }
    }
    match asked.json {
        true => terminal::print_json(&json!({ "command": "check", "cases": reports }))?,
        false => terminal::print(&text)?,
    }
    let all = plural(asked.cases.len(), ["case", "cases"]);
    if bad == 0 { Ok(()) } else { Err(Failure::usage(format!("{bad} of {all} cannot run"))) }
}

/// Whether a case is valid and what it would cost: the entry of `frictionsim check --json`.
///
/// # Errors
/// Those of the case.
pub fn examine(path: &Path, overrides: &[String]) -> Result<Value, Failure> {
    let changes = CaseChanges { set: overrides.to_vec(), ..CaseChanges::default() };
    Ok(check(path, &path.display().to_string(), &changes)?.1)
}

/// What is said of a case that is valid, for people and as an object.
fn check(path: &Path, name: &str, changes: &CaseChanges) -> Result<(String, Value), Failure> {
    let overrides = changes.overrides();
    if let Some(system) = described_system(path, &overrides)? {
        return Ok(superelement(name, &system));
    }
    let case = read_case(path, &overrides)?;
    let found = preflight(&case, machine_memory());
    let found = found.map_err(Failure::from).inspect_err(|failure| {
        // An implausible value is often the cause of what cannot run.
        let said = failure.messages().join("\n");
        let unsaid = case.warnings.iter().filter(|warning| !said.contains(&warning.message));
        unsaid.for_each(terminal::warn);
    })?;
    if changes.deny_warnings {
        case.deny_warnings(&found.warnings)?;
    }
    Ok((describe(name, &case, &found), object(name, &case, &found)))
}

/// The first line on a valid case.
fn valid(name: &str, title: &str) -> String {
    let title = if title.is_empty() { String::new() } else { format!(" ({title})") };
    format!("{name}: valid{title}\n")
}

fn superelement(name: &str, system: &FreeSystem) -> (String, Value) {
    let own = &system.superelement;
    let unknowns = plural(own.mass.rows, ["unknown", "unknowns"]);
    let text = valid(name, &system.title) + &format!("  superelement {}: {unknowns}\n", own.name);
    let object = json!({
        "case": name,
        "valid": true,
        "title": system.title,
        "case_hash": system.hash,
        "dofs": own.mass.rows,
        "warnings": [],
    });
    (text, object)
}

fn describe(name: &str, case: &Case, found: &Preflight) -> String {
    let mut out = valid(name, &case.title);
    let Cost { nodes, elements, dofs, .. } = found.cost;
    let _ = writeln!(
        out,
        "  mesh: {nodes} nodes, {elements} elements, {dofs} unknowns, about {}",
        size(found.cost.mesh_memory_bytes)
    );
    let lines = lines(case, found);
    for (command, text, run) in &lines {
        let (size, time) = (size(run.memory_bytes), run.time());
        let _ = writeln!(out, "  {command}: {text}, {size}, {time} on one thread");
    }
    if lines.iter().any(|(_, _, run)| run.seconds() > LONGEST_RUN) {
        out.push_str(
            "  warning: a run of more than a month is hardly meant: use fewer elements, or a shorter duration\n",
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

/// What each command of a case does, and what it takes.
fn lines(case: &Case, found: &Preflight) -> Vec<(&'static str, String, RunCost)> {
    let Cost { cea, transient, cycle, basin, frf, .. } = found.cost;
    let study = |name, study: Option<StudyCost>, text: &dyn Fn(usize) -> String| {
        study.map(|own| (name, text(own.runs), own.run))
    };
    let about = if found.is_step_exact { "" } else { "about " };
    let all = [
        cea.map(|own| {
            let (values, modes) = (own.friction_values, own.modes);
            let values = plural(values, ["friction value", "friction values"]);
            ("cea", format!("{values}, about {} each", plural(modes, ["mode", "modes"])), own.run)
        }),
        transient.map(|own| {
            let text = format!("time step {about}{:.4e} s, {} steps", own.time_step, own.steps);
            ("transient", text, own.run)
        }),
        cycle.map(|own| {
            let families = plural(own.families, ["family", "families"]);
            let cycles = plural(own.cycles, ["cycle", "cycles"]);
            ("cycle", format!("about {families} of {cycles}"), own.run)
        }),
        basin.map(|own| {
            let run = RunCost { memory_bytes: found.cost.mesh_memory_bytes, ..own };
            ("basin", "one boundary between two limit cycles".to_owned(), run)
        }),
        frf.map(|own| ("frf", plural(own.lines, ["frequency", "frequencies"]), own.run)),
        study("convergence", case.convergence_cost(), &|runs| {
            format!("{} ({})", plural(runs, ["run", "runs"]), meshes(case))
        }),
        study("sweep", case.sweep_cost(), &|runs| plural(runs, ["point", "points"])),
        study("uncertainty", case.uncertainty_cost(), &|runs| plural(runs, ["run", "runs"])),
    ];
    all.into_iter().flatten().collect()
}

/// The meshes and time steps of a convergence study.
fn meshes(case: &Case) -> String {
    let Some(study) = &case.convergence else { return String::new() };
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
    let (cost, sweep) = (&found.cost, case.sweep_cost());
    let warnings = case.warnings.iter().chain(&found.warnings);
    json!({
        "case": name,
        "valid": true,
        "title": case.title,
        "case_hash": case.raw.hash(),
        "nodes": cost.nodes as u64,
        "elements": cost.elements as u64,
        "dofs": cost.dofs as u64,
        "memory_bytes": found.memory_bytes as u64,
        "cea": cost.cea,
        "transient": cost.transient,
        "cycle": cost.cycle,
        "basin": cost.basin,
        "frf": cost.frf,
        "convergence": case.convergence_cost(),
        "uncertainty": case.uncertainty_cost(),
        "sweep": sweep.map(|own| json!({
            "points": own.runs,
            "memory_bytes": own.run.memory_bytes as u64,
            "time": own.run.time(),
        })),
        "sweep_points": sweep.map(|sweep| sweep.runs),
        "notes": case.taken.notes,
        "warnings": warnings.map(ToString::to_string).collect::<Vec<_>>(),
    })
}

fn size(bytes: f64) -> String {
    let size = bytes / f64::from(1 << 20);
    if size < 1024.0 { format!("{size:.1} MiB") } else { format!("{:.1} GiB", size / 1024.0) }
}
