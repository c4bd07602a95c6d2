//! `frictionsim cea`: complex eigenvalues of steady sliding over the friction coefficient.

use super::profile::{Profile, Run};
use super::{Failure, RunOptions, Session, superelement, terminal};
use crate::case::Cea;
use crate::cea::{SweepProgress, SweepStage};
use crate::results::cea::{KeptSteps, View, document, draw, write, write_universal};
use crate::study::eigenvalues::{self, Progress, SlidingModel, Solution, Solver, refuse_no_modes};
use clap::Args;
use indicatif::ProgressBar;

/// Which modes turn unstable, at which friction and why
///
/// Solves complex eigenvalues over the friction coefficient. For a body that is solved on its whole mesh, Ctrl-C keeps
/// finished friction values; --resume continues. Needs a section `[cea]`.
#[derive(Args)]
pub struct Arguments {
    /// The case and how to run it.
    #[command(flatten)]
    pub options: RunOptions,
    /// Continue from what an interrupted run has finished, or start from the beginning
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
}

/// What an interrupted run leaves.
const KEPT: &str = "friction values that are done are kept: the same command with --resume goes on";

impl Run for Arguments {
    const PROFILE: Profile = Profile {
        files: &[
            ("eigenvalues.csv", "one row for each mode and friction value"),
            ("stability.csv", "one row for each crossing into instability"),
            ("sensitivities.csv", "derivatives of eigenvalues and onsets by parameters"),
            (
                "contributions.csv, coupling.csv",
                "what each part, support and contact adds to growth; which modes couple",
            ),
            ("feed.csv, feed.vtu", "where on the contact surfaces unstable modes are fed"),
            ("prestress.csv, prestress.vtu", "steady sliding, node by node"),
            ("modes.pvd, modes/*.vtu", "mode shapes, real and imaginary part"),
            ("modes.unv", "mesh and mode shapes as a universal file (output.universal)"),
        ],
        examples: &[
            ("frictionsim cea disc.toml", "critical friction of every branch"),
            (
                "frictionsim cea disc.toml --set contact.interference=30e-6 --json | jq .critical_frictions",
                "for scripts",
            ),
        ],
    };

    fn run(&self) -> Result<(), Failure> {
        let options = &self.options;
        if let Some(system) = superelement::described(&options.case, &options.changes.overrides())?
        {
            return superelement::run(options, &system);
        }
        run_with(self, |session, cea, model, watch| {
            Ok(eigenvalues::solve(&session.case, cea, model, watch)?)
        })
    }
}

/// Shows how far a sweep has come.
fn show(bar: &ProgressBar, progress: SweepProgress) {
    bar.set_message(match progress.stage {
        SweepStage::Blocks => "blocks of modes",
        SweepStage::Values => "friction values",
        SweepStage::Diameters => "nodal diameters",
    });
    bar.set_length(progress.total as u64);
    bar.set_position(progress.solved as u64);
}

/// Runs the subcommand with a solver.
fn run_with(
    arguments: &Arguments,
    solve: impl FnOnce(&Session, &Cea, &SlidingModel, &Progress<'_>) -> Result<Solution, Failure>,
) -> Result<(), Failure> {
    let session = Session::start("cea", &arguments.options)?;
    let case = &session.case;
    let cea = case.require_cea()?;
    let solver = Solver::of_analysis(case, cea)?;
    session.check_memory(case.memory("cea").0)?;
    let folder = session.open_folder(arguments.resume)?;
    let bar = terminal::progress(session.options.output.is_quiet(), 0, "modes at rest");
    let heard = |progress| show(&bar, progress);
    let steps = KeptSteps::new(&folder, arguments.resume, &heard)?;
    terminal::catch_signals(match solver {
        Solver::WholeMesh | Solver::Assembly => KEPT,
        _ => terminal::NOTHING_KEPT,
    });

    let model = SlidingModel::new(case, cea)?;
    let solution = solve(&session, cea, &model, &steps)?;
    refuse_no_modes(case, cea, &solution.sweep)?;

    bar.finish_and_clear();
    let field = model.base_field(case);
    let wall_s = session.wall_seconds();
    let report = eigenvalues::report(case, cea, &model, &solution, &field, wall_s);
    let summary = write(&folder, &report)?;
    if case.output.universal {
        write_universal(&folder, &report)?;
    }
    if let Some(drawing) = session.options.output.drawing() {
        draw(&folder, &report, &eigenvalues::dampings(case, &model), &drawing)?;
    }
    steps.discard()?;
    let view = if session.options.output.verbose > 0 { View::Whole } else { View::Short };
    session.options.output.finish(folder, &document(&report, view).to_text(), &summary)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::options::CaseChanges;
    use crate::app::{OutputOptions, SimdChoice};
    use crate::cea::{ComplexMode, FrictionPoint, FrictionSweep};
    use crate::linalg::c64;
    use crate::study::eigenvalues::SteadyState;
    use std::f64::consts::TAU;
    use std::path::Path;

    fn arguments(out: &Path, set: &[&str]) -> Arguments {
        let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
        let coarse = ["mesh.circumferential_elements=24", "mesh.radial_elements=4"];
        let all = coarse.iter().chain(set);
        Arguments {
            options: RunOptions {
                case: cases.join("polycarbonate-disc.toml"),
                changes: CaseChanges {
                    set: all.map(|text| text.to_string()).collect(),
                    ..CaseChanges::default()
                },
                threads: None,
                simd: SimdChoice::Auto,
                output: OutputOptions {
                    out: Some(out.to_owned()),
                    quiet: 2,
                    ..OutputOptions::default()
                },
            },
            resume: false,
        }
    }

    /// A spectrum of one made-up standing wave at every friction value.
    fn made_up(cea: &Cea, model: &SlidingModel) -> Solution {
        let shape = vec![c64::new(1.0, 0.0); 2 * model.mesh.node_count()];
        let mode = ComplexMode {
            eigenvalue: c64::new(-100.0, TAU * 5000.0),
            harmonic: 0,
            branch: 0,
            direction: 0,
            residual: 1e-14,
            uncertainty: 1e-13,
            contact_share: 0.1,
            axial_share: None,
            shape: Some(shape),
            left: None,
            nodal_diameters: None,
            wave: None,
        };
        let values = cea.solved_friction_coefficients();
        let points = values.into_iter().map(|friction_coefficient| FrictionPoint {
            friction_coefficient,
            modes: vec![mode.clone()],
            above: Vec::new(),
        });
        Solution {
            sweep: FrictionSweep {
                points: points.collect(),
                intervals: Vec::new(),
                crossings: Vec::new(),
                ..FrictionSweep::default()
            },
            dofs: 100,
            method: "sparse",
            sensitivities: None,
            reading: None,
            notes: Vec::new(),
        }
    }

    fn run(arguments: &Arguments) -> Result<(), Failure> {
        run_with(arguments, |_, cea, model, _| Ok(made_up(cea, model)))
    }

    #[test]
    fn a_run_leaves_tables_fields_figures_and_its_manifest() {
        let folder = tempfile::tempdir().unwrap();
        run(&arguments(folder.path(), &["cea.friction_coefficients=[0.1, 0.2]"])).unwrap();
        for name in [
            "eigenvalues.csv",
            "stability.csv",
            "summary.json",
            "manifest.json",
            "modes.pvd",
            "modes/mu-0.3-mode-001.vtu",
            "prestress.csv",
            "prestress.vtu",
            "figures/locus.svg",
            "figures/prestress.png",
            "figures/modes-mu-0.3.png",
        ] {
            assert!(folder.path().join(name).exists(), "{name}");
        }
        let table = std::fs::read_to_string(folder.path().join("eigenvalues.csv")).unwrap();
        // The values asked for, and the case's own, 0.3.
        assert_eq!(table.lines().count(), 4);
        let elsewhere = ["cea.friction_coefficients=[0.1, 0.2]", "cea.shapes_at=[0.1]"];
        let arguments = arguments(&folder.path().join("elsewhere"), &elsewhere);
        run(&arguments).unwrap();
        let table = folder.path().join("elsewhere/eigenvalues.csv");
        assert_eq!(std::fs::read_to_string(table).unwrap().lines().count(), 4);
    }

    #[test]
    fn the_reported_torque_and_power_are_those_of_the_whole_thickness() {
        let folder = tempfile::tempdir().unwrap();
        let arguments = arguments(folder.path(), &[]);
        run_with(&arguments, |session, cea, model, _| {
            let (case, base) = (&session.case, model.base_state(&session.case));
            let field = model.base_field(case);
            // Torque = thickness * radius * sum of traction times tributary length.
            let SteadyState::Plane(steady) = &model.state else {
                panic!("a plane annulus");
            };
            let lengths = &steady.interface.tributary_lengths;
            let force: f64 = field.shears.iter().zip(lengths).map(|(t, w)| t * w).sum();
            let torque = 0.009 * 0.0205 * force;
            assert!((base.torque_n_m.unwrap() / torque - 1.0).abs() < 1e-12);
            assert!((base.power_w / (torque * 610.0 * TAU / 60.0) - 1.0).abs() < 1e-12);
            // Lame's pressure for this interference: 2.827 MPa at nu = 0.38, a coarse mesh within 2 %.
            assert!((base.pressure_pa[0] / 2.827e6 - 1.0).abs() < 0.02, "{base:?}");
            Ok(made_up(cea, model))
        })
        .unwrap();
    }

    #[test]
    fn a_limit_below_the_first_mode_is_an_error_of_the_case() {
        let folder = tempfile::tempdir().unwrap();
        let failure = run_with(&arguments(folder.path(), &[]), |_, cea, model, _| {
            let mut solution = made_up(cea, model);
            solution.sweep.points.iter_mut().for_each(|point| point.modes.clear());
            Ok(solution)
        })
        .unwrap_err();
        let Failure::Case(errors) = failure else {
            panic!("{failure:?}");
        };
        let text = errors.to_string();
        assert!(text.contains("no modes below it") && text.contains("modes = 10"), "{text}");
    }
}
