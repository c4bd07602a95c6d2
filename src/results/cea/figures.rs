//! The figures of an eigenvalue analysis.

use super::CeaReport;
use crate::fem::{NodalStress, RayleighDamping};
use crate::results::drawing::{DrawingError, render, write_figure};
use crate::results::figures::{
    EigenvalueLocus, FigureError, ModeShape, ModeShapes, PairSweep, PrestressedContact,
    draw_eigenvalue_locus, draw_mode_shapes, draw_pair_sweep, draw_prestress,
};
use crate::results::folder::OutputFolder;
use rayon::prelude::*;

/// A drawing and the name of its file.
type Drawing = (String, Result<String, FigureError>);

/// Draws every figure that the report has data for into `figures/`, each as SVG and PNG: eigenvalue
/// locus with stability bars, pairs that turn unstable, base state, mode shapes.
///
/// # Errors
/// Those of the folder; a figure that cannot be drawn although there is something to draw.
pub fn draw(
    folder: &OutputFolder,
    report: &CeaReport<'_>,
    damping: RayleighDamping,
) -> Result<(), DrawingError> {
    let mut jobs: Vec<Box<dyn Fn() -> Drawing + Sync + Send + '_>> = vec![
        Box::new(move || {
            let locus = EigenvalueLocus {
                sweep: report.sweep,
                mass_coefficient: damping.mass_coefficient,
                stiffness_coefficient: damping.stiffness_coefficient,
            };
            ("locus".to_owned(), draw_eigenvalue_locus(&locus))
        }),
        Box::new(|| {
            let sweep = report.sweep;
            ("pairs".to_owned(), draw_pair_sweep(&PairSweep { sweep }))
        }),
        Box::new(|| ("prestress".to_owned(), prestress(report))),
    ];
    for point in &report.sweep.points {
        let numbered = point.modes.iter().enumerate();
        let shapes: Vec<ModeShape<'_>> = numbered
            .filter(|(_, mode)| mode.shape.is_some())
            .map(|(index, mode)| ModeShape {
                number: index + 1,
                friction_coefficient: point.friction_coefficient,
                mode,
            })
            .collect();
        if shapes.is_empty() {
            continue;
        }
        let name = format!("modes-mu-{}", point.friction_coefficient);
        let data = ModeShapes {
            mesh: report.mesh,
            shapes,
        };
        jobs.push(Box::new(move || (name.clone(), draw_mode_shapes(&data))));
    }
    // Drawing is pure: side by side here, written in order below.
    let drawn: Vec<_> = jobs
        .par_iter()
        .map(|job| {
            let (name, drawing) = job();
            (name, render(drawing))
        })
        .collect();
    for (name, figure) in drawn {
        if let Some(figure) = figure? {
            write_figure(folder, &name, &figure)?;
        }
    }
    Ok(())
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
