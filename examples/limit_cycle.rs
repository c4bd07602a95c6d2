//! Runs the polycarbonate disc into its friction-induced limit cycle and prints what it settles on.
//!
//! `cargo run --release --example limit_cycle -- [rpm] [duration] [step] [circumferential] [radial]
//! [operator] [harmonic ...]`

use frictionsim::contact::SlidingContact;
use frictionsim::fem::operator::SimdLevel;
use frictionsim::fem::{ElasticMaterial, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusMesh, AnnulusSpecification, ElementKind};
use frictionsim::transient::{
    CentralDifference, InitialState, OperatorChoice, Perturbation, Recorder, RecorderSettings,
    TimeStep, TransientAnalysis, TransientModel, TransientSettings, build_operator,
};
use std::error::Error;
use std::f64::consts::TAU;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize, default: f64| -> Result<f64, Box<dyn Error>> {
        Ok(arguments.get(i).map_or(Ok(default), |text| text.parse())?)
    };
    let annulus = AnnulusMesh::generate(&AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: number(3, 180.0)? as usize,
        radial_elements: number(4, 35.0)? as usize,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
    })?;
    let model = TransientModel {
        annulus: &annulus,
        material: ElasticMaterial {
            young_modulus: 2.5e9,
            poisson_ratio: 0.3805,
            density: 1228.0,
            formulation: PlaneFormulation::PlaneStrain,
        },
        damping: RayleighDamping {
            mass_coefficient: 40.0,
            stiffness_coefficient: 4.5e-7,
        },
        contact: SlidingContact {
            friction_coefficient: 0.3,
            interference: 25e-6,
            rotation_speed: number(0, 610.0)? * TAU / 60.0,
        },
    };
    let choice = match arguments.get(5).map(String::as_str) {
        Some("sparse") => OperatorChoice::Sparse,
        _ => OperatorChoice::Auto,
    };
    let step = number(2, 1e-7)?;
    let harmonics: Vec<usize> = match arguments.get(6..) {
        Some(list) if !list.is_empty() => {
            list.iter().map(|n| n.parse()).collect::<Result<_, _>>()?
        }
        _ => vec![2],
    };
    let settings = TransientSettings {
        duration: number(1, 0.05)?,
        time_step: if step > 0.0 {
            TimeStep::Seconds(step)
        } else {
            TimeStep::Auto
        },
        sample_interval: 2e-6,
        expansion_time: 5e-4,
        initial: InitialState::Rest,
        perturbation: Perturbation {
            harmonics: harmonics.clone(),
            velocity: 1e-3,
        },
    };
    let operator = build_operator(&model, choice, SimdLevel::detect())?;
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings)?;
    let mut record = Recorder::new(&run, &RecorderSettings::default())?;
    println!(
        "{} operator, {}, {:?}",
        operator.name(),
        operator.simd(),
        run.plan()
    );
    let clock = Instant::now();
    run.run(&mut record)?;
    let seconds = clock.elapsed().as_secs_f64();
    println!("{:.2} us a step", 1e6 * seconds / run.steps_done() as f64);
    print(&TransientAnalysis::of(&record, &harmonics));
    Ok(())
}

fn print(analysis: &TransientAnalysis) {
    let cycle = &analysis.limit_cycle;
    let powers = &cycle.powers;
    let [stick, slip, open] = cycle.status;
    println!(
        "main frequency {:?} Hz, harmonic {:?}",
        cycle.main_frequency_hz, cycle.main_harmonic
    );
    println!("stick {stick:.4}  slip {slip:.4}  open {open:.4}");
    println!(
        "external {:.2} kW/m: stick {:.4}, slide {:.4}, contact-dissipated {:.4}; material damping {:.2}, normal {:.4} kW/m",
        powers.external / 1e3,
        powers.stick / powers.external,
        powers.slide / powers.external,
        powers.contact_dissipated / powers.external,
        cycle.material_damping / 1e3,
        powers.normal / 1e3,
    );
    println!("harmonics {:.3e}", Amplitudes(&cycle.harmonics));
    println!("growth {:?}", analysis.growth);
    println!("first nonlinearity {:?} s", analysis.first_nonlinearity);
    println!("largest balance residual {:.1e}", analysis.largest_residual);
}

struct Amplitudes<'a>(&'a [f64]);

impl std::fmt::LowerExp for Amplitudes<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_list()
            .entries(self.0.iter().map(|a| format!("{a:.3e}")))
            .finish()
    }
}
