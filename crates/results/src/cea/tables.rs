//! Tables and sentences of an eigenvalue analysis.

use super::branches::{branch_of, sentences};
use super::summary::{CriticalFriction, ModeSummary, ONSETS, onsets};
use super::{
    BRANCH, BaseField, BaseState, CeaReport, DIRECTION, HARMONIC, SensitivityReport, Solution,
    direction_name, feed,
};
use crate::common::*;

/// Longest table of the modes at one friction value on the terminal.
const MOST_MODES: usize = 40;
/// Modes whose sensitivities a report lists.
const SENSITIVE_MODES: usize = 4;
/// Unstable modes that the report puts into words, at most.
const READ_MODES: usize = 6;
/// Estimated relative error of a frequency above which a mesh is too coarse for the estimate.
const COARSE: f64 = 0.05;

/// A mode at a friction value.
pub(crate) struct ModeRow {
    friction: f64,
    number: usize,
    own: ModeSummary,
    mode: ComplexMode,
}

impl ModeRow {
    /// All modes at a friction value.
    fn all(report: &CeaReport<'_>, point: &FrictionPoint) -> Vec<Self> {
        let friction = point.friction_coefficient;
        let row = |(number, mode): (usize, &ComplexMode)| Self {
            friction,
            number,
            own: ModeSummary::of(mode, report.has_harmonics),
            mode: mode.clone(),
        };
        (1..).zip(&point.modes).map(row).collect()
    }
}

columns! {
    /// The friction value of a mode, its place there, and what it is; the last of bodies of revolution.
    pub(crate) MODES: row as ModeRow;
    friction_coefficient: "friction coefficient" = row.friction;
    mode: "number by frequency at that friction, from 1" = row.number, Always "mode" Count;
    real_hz: "real part of the eigenvalue over 2 pi" = row.own.real_hz;
    frequency_hz: "imaginary part of the eigenvalue over 2 pi" = row.own.frequency_hz, Always "frequency" Fixed(2);
    damping_factor: "damping factor; negative where the mode grows"
        = row.mode.damping_factor(), Always "damping factor" Scientific(3);
    growth_rate_per_s: "real part of the eigenvalue" = row.mode.growth_rate(), Always "growth rate" Fixed(2);
    harmonic: HARMONIC = row.own.harmonic, IfAny "n" Count;
    branch: BRANCH = row.own.branch, Always "branch" Count;
    direction: DIRECTION = row.own.direction;
    unstable: "whether the mode grows" = row.own.unstable;
    residual: "relative residual of the eigenpair" = row.mode.residual;
    contact_share: "share of the kinetic energy at the contact" = row.own.contact_share;
    mesh_error: "estimate of the frequency less that on an ever finer mesh, Hz" = row.own.mesh_error;
    axial_share: "share of the kinetic energy along the axis, of bodies of revolution" = row.own.axial_share;

    /// A mode in words.
    MODE_WORDS: row as ModeRow;
    travels = row.own.direction.map(direction_name), IfAny "travels" Plain;
    stability = row.own.unstable.then_some("unstable"), IfAny "stability" Plain;
}

/// Those of every body.
const COMMON: &[Column<ModeRow>] = parted(MODES, "axial_share").0;

/// What is to be said of an onset.
fn remark(onset: &CriticalFriction) -> Option<String> {
    let lost = onset.lost_after.map(|below| format!("lost: begins above {below}"));
    lost.or(onset.unstable_from_start.then(|| "from the start".to_owned()))
        .or((onset.branch == 0).then(|| "does not oscillate".to_owned()))
}

/// Where a document is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// On the page.
    Page,
    /// On the terminal.
    Short,
    /// On the terminal, with the unstable modes of every friction value.
    Whole,
}

/// `eigenvalues.csv`: one row for each mode and friction value, sorted by frequency within a value.
fn eigenvalues(report: &CeaReport<'_>) -> Table {
    let rows: Vec<ModeRow> =
        report.tabulated().flat_map(|point| ModeRow::all(report, point)).collect();
    let columns = if report.body.sector.is_some() { MODES } else { COMMON };
    Table::new("eigenvalues.csv", "").columns(columns, &rows)
}

/// `stability.csv`: one row for each crossing into instability.
fn stability(report: &CeaReport<'_>) -> Table {
    let intervals = report.solution.sweep.intervals.iter();
    let number = intervals.map(|own| report.mode_number(branch_of(own)));
    let rows = onsets(report);
    let table = Table::new("stability.csv", "Critical friction of each branch that turns unstable")
        .columns(ONSETS, &rows)
        .shown_column("travels", rows.iter().map(|onset| onset.direction.map(direction_name)))
        .shown_column("remark", rows.iter().map(remark));
    if report.has_harmonics { table } else { table.shown_column("mode", number) }
}

/// The table of modes at some friction values.
fn modes(caption: String, rows: &[ModeRow], with_friction: bool) -> Table {
    let table = Table::new("", caption);
    let friction = rows.iter().map(|row| row.friction);
    let look = Some(("friction", Format::Plain));
    let table = if with_friction { table.column("", look, friction) } else { table };
    table.columns(COMMON, rows).columns(MODE_WORDS, rows)
}

/// All modes at the friction values that have shapes, or at the last value of the sweep.
fn page_modes(report: &CeaReport<'_>) -> Vec<Table> {
    let points = &report.solution.sweep.points;
    let with_shapes = |point: &&FrictionPoint| point.modes.iter().any(|m| m.shape.is_some());
    let mut chosen: Vec<&FrictionPoint> = points.iter().filter(with_shapes).collect();
    if chosen.is_empty() {
        chosen.extend(points.last());
    }
    let table = |point: &FrictionPoint| {
        let caption = format!("Eigenvalues at friction coefficient {}", point.friction_coefficient);
        modes(caption, &ModeRow::all(report, point), false)
    };
    chosen.into_iter().map(table).collect()
}

/// The modes at the solved friction value nearest to the case's own; of many only the unstable ones.
fn own_modes(report: &CeaReport<'_>) -> Option<Table> {
    let point = report.own_point()?;
    let mut rows = ModeRow::all(report, point);
    let unstable = rows.iter().filter(|row| row.own.unstable).count();
    let mut caption = format!(
        "friction {}: {} modes, {unstable} unstable",
        point.friction_coefficient,
        rows.len()
    );
    if rows.len() > MOST_MODES {
        rows.retain(|row| row.own.unstable);
        caption += " (listed; --verbose lists those of every friction value)";
    }
    Some(modes(caption, &rows, false))
}

/// The unstable modes of every friction value, and between which values there are none.
fn unstable_modes(report: &CeaReport<'_>) -> Section {
    let points = report.tabulated().map(|point| ModeRow::all(report, point));
    let rows: Vec<ModeRow> = points.flatten().filter(|row| row.own.unstable).collect();
    let points: Vec<&FrictionPoint> = report.tabulated().collect();
    let is_stable = |point: &&FrictionPoint| !point.modes.iter().any(|mode| mode.is_unstable());
    let ranges = points.chunk_by(|a, b| is_stable(a) == is_stable(b));
    let stable = ranges.filter(|range| is_stable(&range[0])).map(|range| {
        let [first, last] = [range[0], range[range.len() - 1]].map(|p| p.friction_coefficient);
        match first == last {
            true => format!("friction {first}: stable"),
            false => format!("friction {first}: stable up to {last}"),
        }
    });
    let table = modes("Unstable modes of every friction value".to_owned(), &rows, true);
    Section::new("Eigenvalues").text(stable).tables([table])
}

/// The document of an analysis.
pub fn document(report: &CeaReport<'_>, view: View) -> Document {
    let results = Section::new("Results")
        .text(words(report, view))
        .facts(facts(report))
        .tables([stability(report)]);
    let modes = match view {
        View::Page => Section::new("Eigenvalues").tables(page_modes(report)),
        View::Short => Section::new("Eigenvalues").tables(own_modes(report)),
        View::Whole => unstable_modes(report),
    };
    Document::new("Complex eigenvalues")
        .titled(report.title)
        .section(results)
        .section(Section::new("Stability of steady sliding").figures([""]))
        .section(decisive(report, view))
        .section(modes)
        .notes(&report.solution.notes)
}

/// The page of an analysis, with the tables that are files.
pub fn page(report: &CeaReport<'_>, field: &BaseField) -> Document {
    let Solution { sensitivities, reading, .. } = report.solution;
    let read = reading.iter().flat_map(|own| {
        let feed = (!own.feed.is_empty()).then(|| feed::table(field, &own.feed));
        [own.contributions(), own.couplings()].into_iter().chain(feed)
    });
    let solved = [eigenvalues(report), field.table(&report.body, report.has_harmonics)];
    let files = solved.into_iter().chain(sensitivities.iter().map(SensitivityReport::table));
    files.chain(read).fold(document(report, View::Page), Document::file)
}

/// What was solved, and the base state.
fn words(report: &CeaReport<'_>, view: View) -> Vec<String> {
    let (fewest, most) = report.mode_counts();
    let count = if fewest == most { most.to_string() } else { format!("{fewest} to {most}") };
    let base = &report.base;
    let (selection, residual) = (&report.selection, report.largest_residual());
    let Solution { dofs, method, .. } = report.solution;
    let values = plural(report.tabulated().count(), ["friction value", "friction values"]);
    let solved = format!(
        "{count} modes ({selection}) at {values}, {dofs} unknowns, {method} method; largest residual {residual:.1e}."
    );
    let free = report.body.is_assembly() && base.is_without_pressure();
    let [low, high] = base.pressure_pa.map(|pressure| fixed(1e-6 * pressure, 4));
    let state = match free {
        true => "no contact pressure".to_owned(),
        false => format!("pressure {low} to {high} MPa; {}, {}", base.drive(), base.power()),
    };
    // Solid bodies touch at points between their nodes.
    let nodes = if report.body.is_assembly() { "points" } else { "nodes" };
    let BaseState { friction_coefficient: friction, slipping, sticking, open, .. } = base;
    let steady = format!(
        "Steady sliding at friction {friction}: {slipping} contact {nodes} slipping, {sticking} sticking, {open} open; \
         {state}."
    );
    let none = report.solution.sweep.intervals.is_empty().then(|| {
        let values = report.tabulated().map(|point| point.friction_coefficient);
        let (first, last) = extremes(values);
        let range = format!("turns unstable for friction from {first} to {last}.");
        if report.solution.sweep.unconverged.is_empty() {
            format!("No listed mode {range}")
        } else {
            format!("No listed mode that converged {range} What did not converge may.")
        }
    });
    // Pages of the same case are the same bytes.
    let time = (view != View::Page).then(|| format!("{:.3} s.", report.wall_s));
    let extent = base.extent.sentence();
    let all = [Some(solved), time, Some(steady), extent, mesh_errors(report), none];
    all.into_iter().flatten().collect()
}

/// The largest error of the mesh in a frequency, and that of the lowest critical friction, where they were estimated.
fn mesh_errors(report: &CeaReport<'_>) -> Option<String> {
    let known = report.modes().filter_map(|(friction, number, mode)| {
        let error = mode.mesh_error?;
        Some(((error / mode.frequency_hz()).abs(), error, number, friction))
    });
    let (share, error, number, friction) = known.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let text = format!(
        "Error of the mesh, estimated: frequencies up to {error:+.2} Hz ({:.2} %, mode {number} at \
         friction {friction})",
        100.0 * share,
    );
    if share > COARSE {
        return Some(text + ": the mesh is so coarse that this is an order of magnitude.");
    }
    let mut intervals = report.solution.sweep.intervals.iter();
    let first = intervals.find_map(|own| Some((own.critical_friction, own.mesh_error?)));
    Some(match first {
        Some((critical, error)) => {
            format!("{text}, critical friction {error:+.1e} of {critical:.6}.")
        }
        None => text + ".",
    })
}

/// Which modes couple and which parameter decides, as far as that is known.
fn decisive(report: &CeaReport<'_>, view: View) -> Section {
    let own = report.base.friction_coefficient;
    let most = if view == View::Page { READ_MODES } else { 1 };
    let (reading, sensitivities) = (&report.solution.reading, &report.solution.sensitivities);
    let read = reading.as_ref().map_or(Vec::new(), |reading| reading.sentences(own, most));
    let section = Section::new("What couples, and what decides");
    if view != View::Page {
        return section.text(sensitivities.as_ref().map(SensitivityReport::print)).text(read);
    }
    // Waves of a pair are one mode without friction: that they couple is told apart.
    let coupled = match read.is_empty() || report.has_harmonics {
        true => sentences(report),
        false => Vec::new(),
    };
    let tables = sensitivities.as_ref().map_or(Vec::new(), |all| all.tables(SENSITIVE_MODES));
    let explained = (!tables.is_empty()).then(|| {
        "Sensitivities: a positive change of the growth rate brings a mode nearer to squeal or makes it grow faster. A \
         negative one holds it back. They hold for small changes; sensitivities.csv has those of every mode."
            .to_owned()
    });
    section.text(coupled).text(read).text(explained).tables(tables)
}

/// What decides: where stability ends, and what grows at the case's own friction.
fn facts(report: &CeaReport<'_>) -> Vec<(String, String)> {
    let intervals = &report.solution.sweep.intervals;
    let lowest =
        intervals.iter().min_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
    let onset = match lowest {
        Some(own) if !own.is_located() => format!("below {}", own.critical_friction),
        Some(interval) => fixed(interval.critical_friction, 6),
        None if report.solution.sweep.unconverged.is_empty() => {
            "none: the modes listed are stable".to_owned()
        }
        None => "none of the modes that converged".to_owned(),
    };
    let hertz = |frequency: f64| format!("{} Hz", fixed(frequency, 2));
    let mut rows = vec![("lowest critical friction".to_owned(), onset)];
    rows.extend(lowest.map(|own| ("its frequency".to_owned(), hertz(own.frequency_hz))));
    let own = report.base.friction_coefficient;
    if let Some(point) = report.solved_point() {
        let unstable = point.modes.iter().filter(|mode| mode.is_unstable());
        let name = format!("unstable modes at friction {own}");
        let of_all = format!("{} of {}", unstable.clone().count(), point.modes.len());
        let is_static = intervals.iter().any(|interval| {
            let end = interval.restabilized.map_or(f64::INFINITY, |(mu, _)| mu);
            interval.branch == 0 && (interval.critical_friction..end).contains(&own)
        });
        let beside = if is_static { ", and a motion that does not oscillate" } else { "" };
        rows.push((name, of_all + beside));
        let fastest = unstable.max_by(|a, b| a.real_hz().total_cmp(&b.real_hz()));
        rows.extend(fastest.map(|mode| {
            let rate = fixed(TAU * mode.real_hz(), 2);
            (
                "fastest growth there".to_owned(),
                format!("{rate} 1/s at {}", hertz(mode.frequency_hz())),
            )
        }));
    }
    rows
}
