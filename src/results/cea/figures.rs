//! The figures of an eigenvalue analysis.

use super::{CeaReport, direction_name, html_report};
use crate::cea::{ComplexMode, FrictionPoint};
use crate::fem::{NodalStress, RayleighDamping};
use crate::results::drawing::{DrawingError, FigureJob, draw_figures, write_report};
use crate::results::figures::{
    EigenvalueLocus, FigureError, ModeShape, ModeShapes, PairSweep, PrestressedContact,
    draw_eigenvalue_locus, draw_mode_over_friction, draw_mode_shapes, draw_pair_sweep,
    draw_prestress,
};
use crate::results::folder::OutputFolder;

/// Branches whose shape is followed over friction, at most.
const FOLLOWED_BRANCHES: usize = 4;

/// Draws every figure that the report has data for into `figures/`, each as SVG and PNG, and writes
/// `report.html`: eigenvalue locus with stability bars, pairs that turn unstable, base state, mode
/// shapes, and the branches that turn unstable at every friction value that has shapes.
///
/// # Errors
/// Those of the folder; a figure that cannot be drawn although there is something to draw.
pub fn draw(
    folder: &OutputFolder,
    report: &CeaReport<'_>,
    damping: RayleighDamping,
    dots_per_inch: f64,
) -> Result<(), DrawingError> {
    let mut jobs = sweep_jobs(report, damping);
    jobs.extend(
        report
            .sweep
            .points
            .iter()
            .filter_map(|p| shapes_job(report, p)),
    );
    jobs.extend(branch_jobs(report));
    if let Some(map) = report.map {
        let caption = format!("Critical friction of each branch over {}", map.key);
        jobs.push(("map".to_owned(), caption, Box::new(|| map.draw())));
    }
    let figures = draw_figures(jobs)?;
    let report = html_report(report, figures, folder.manifest());
    write_report(folder, &report, dots_per_inch)
}

fn sweep_jobs<'a>(report: &'a CeaReport<'a>, damping: RayleighDamping) -> Vec<FigureJob<'a>> {
    let sweep = report.sweep;
    vec![
        (
            "locus".into(),
            "Eigenvalues in the complex plane as friction rises (a), and the friction interval in \
             which each branch is unstable, with its critical friction (b)."
                .into(),
            Box::new(move || {
                draw_eigenvalue_locus(&EigenvalueLocus {
                    sweep,
                    mass_coefficient: damping.mass_coefficient,
                    stiffness_coefficient: damping.stiffness_coefficient,
                })
            }),
        ),
        (
            "pairs".into(),
            "Frequency and damping factor over friction of the pairs of waves that turn unstable."
                .into(),
            Box::new(move || draw_pair_sweep(&PairSweep { sweep })),
        ),
        (
            "prestress".into(),
            "Steady sliding: contact pressure (a) and friction traction (b) around the contact edge, \
             von Mises stress (c)."
                .into(),
            Box::new(move || prestress(report)),
        ),
    ]
}

fn prestress(report: &CeaReport<'_>) -> Result<String, FigureError> {
    let field = report.field;
    let von_mises: Vec<f64> = field.stress.iter().map(NodalStress::von_mises).collect();
    draw_prestress(&PrestressedContact {
        mesh: report.mesh,
        angles: &field.angles,
        pressure: &field.pressures,
        shear: &field.shears,
        von_mises: &von_mises,
    })
}

/// Modes of one friction value that carry shapes.
fn shapes_of(point: &FrictionPoint) -> Vec<ModeShape<'_>> {
    let numbered = point.modes.iter().enumerate();
    numbered
        .filter(|(_, mode)| mode.shape.is_some())
        .map(|(index, mode)| ModeShape {
            number: index + 1,
            friction_coefficient: point.friction_coefficient,
            mode,
        })
        .collect()
}

/// All modes of one friction value.
fn shapes_job<'a>(report: &'a CeaReport<'a>, point: &'a FrictionPoint) -> Option<FigureJob<'a>> {
    let shapes = shapes_of(point);
    if shapes.is_empty() {
        return None;
    }
    let friction = point.friction_coefficient;
    let mesh = report.mesh;
    let data = ModeShapes { mesh, shapes };
    Some((
        format!("modes-mu-{friction}"),
        format!(
            "Mode shapes at friction coefficient {friction}: the deformed disc, coloured by \
             displacement amplitude; unstable modes in red."
        ),
        Box::new(move || draw_mode_shapes(&data)),
    ))
}

/// The first branches that turn unstable, each at every friction value that has shapes.
fn branch_jobs<'a>(report: &'a CeaReport<'a>) -> Vec<FigureJob<'a>> {
    let (sweep, mesh) = (report.sweep, report.mesh);
    let mut drawn: Vec<(usize, usize, i8)> = Vec::new();
    let mut jobs: Vec<FigureJob<'a>> = Vec::new();
    for interval in &sweep.intervals {
        let branch = (interval.harmonic, interval.branch, interval.direction);
        let of_branch = |point: &'a FrictionPoint| {
            let mut shapes = shapes_of(point).into_iter();
            shapes.find(|shape| is_branch(shape.mode, branch))
        };
        let shapes: Vec<ModeShape<'a>> = sweep.points.iter().filter_map(of_branch).collect();
        if shapes.len() < 2 || drawn.contains(&branch) || drawn.len() == FOLLOWED_BRANCHES {
            continue;
        }
        drawn.push(branch);
        let data = ModeShapes { mesh, shapes };
        let way = direction_name(branch.2);
        jobs.push((
            format!("branch-n{}-{}-{way}", branch.0, branch.1),
            format!(
                "Harmonic {}, branch {}, travelling {way} the rotor, at several friction \
                 coefficients.",
                branch.0, branch.1
            ),
            Box::new(move || draw_mode_over_friction(&data)),
        ));
    }
    jobs
}

/// Whether a mode belongs to a branch; a degenerate pair stands at the start of both its waves.
fn is_branch(mode: &ComplexMode, (harmonic, branch, direction): (usize, usize, i8)) -> bool {
    mode.harmonic == harmonic
        && mode.branch == branch
        && (mode.direction == direction || mode.direction == 0)
}
