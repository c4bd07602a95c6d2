//! Maxwell chains in time: growth against the eigenvalue, energy to round-off, restart to the bit.

use crate::prelude::*;
use frictionsim::fem::{MaxwellChain, ModulusTable, RelaxedMaterials, TabledMaterial};

const BAND: [f64; 2] = [300.0, 30_000.0];
const HARMONIC: usize = 2;

fn chain() -> MaxwellChain {
    MaxwellChain::fit(&|_| c64::new(1.0, 0.02), BAND)
}

fn relaxed() -> RelaxedMaterials {
    RelaxedMaterials::of(&POLYCARBONATE, 1, |_| Some(chain()))
}

/// Friction at which the wave grows slowly enough for a long linear stage.
fn sliding() -> SlidingContact {
    SlidingContact { friction_coefficient: 0.15, ..contact(610.0) }
}

fn disc() -> AnnulusMesh {
    AnnulusMesh::generate(&annulus(ElementKind::Quad4, 60, 12)).unwrap()
}

fn settings(duration: f64, at: f64) -> TransientSettings {
    transient_settings(
        duration,
        4e-6,
        1e-4,
        InitialState::SteadySliding,
        Perturbation { time: at, ..Perturbation::of(&[HARMONIC], 1e-8) },
    )
}

/// The largest growth rate of the body (1/s), its modulus a table that the chain fills, lumped as the time loop has it.
fn eigenvalue() -> f64 {
    let chain = chain();
    let rows = (0..=400).map(|i| {
        let frequency = BAND[0] * (BAND[1] / BAND[0]).powf(f64::from(i) / 400.0);
        let ratio = chain.ratio(frequency);
        let modulus = POLYCARBONATE.young_modulus * ratio.re;
        [frequency, modulus, ratio.im / ratio.re]
    });
    let table = ModulusTable::new("materials.disc.table", "chain.csv", rows.collect());
    let own = RegionMaterial {
        elastic: ElasticMaterial { young_modulus: table.static_modulus(), ..POLYCARBONATE },
        damping: None,
    };
    let table = Some(Arc::new(table));
    let materials = vec![TabledMaterial { own, table }];
    let mesh = disc().mesh;
    let options =
        TangentOptions { mass: MassKind::Lumped, damping: RayleighDamping::default(), ..TANGENT };
    let tangent = linearized(&mesh, &materials, &sliding(), &options);
    let modes =
        modes_at(&tangent, sliding().friction_coefficient, ModeLimit::Lowest(8)).into_iter();
    let own = modes.filter(|mode| mode.harmonic == HARMONIC);
    own.map(|mode| mode.growth_rate()).fold(f64::NEG_INFINITY, f64::max)
}

/// Cross-method: a seeded wave grows as the eigenvalue at its own frequency says; the energy of springs and what dashpots take of it
/// are in the balance.
#[test]
fn a_wave_grows_as_its_eigenvalue_says_with_a_chain_in_place_of_a_loss_factor() {
    let (disc, materials) = (disc(), relaxed());
    let undamped = RayleighDamping::default();
    let model = TransientModel::of_annulus(&disc, &materials, undamped, sliding());
    let settings = settings(0.020, 0.0);
    let (record, residual) = recorded(model, OperatorChoice::Auto, &settings);
    println!("balance {:e}", residual);
    assert!(residual < 1e-10);
    let analysis = TransientAnalysis::of(&record, &[HARMONIC]);
    let found = analysis.growth[0].stage.as_ref().unwrap().rate_per_s.value;
    let exact = eigenvalue();
    println!("{found} 1/s, eigenvalue {exact} 1/s");
    // The eigenvalue has the stiffness of its frequency, the chain that of its growth too: sigma / omega times the rise of the
    // modulus a factor e, over the growth.
    assert!((found / exact - 1.0).abs() < 0.02, "{found} {exact}");
}

/// Consistency check: elements come to a kick with another velocity than before it, and to a run that goes on with their stretch.
#[test]
fn a_kick_keeps_the_balance_and_a_run_goes_on_to_the_same_bits() {
    let (disc, materials) = (disc(), relaxed());
    let undamped = RayleighDamping::default();
    let model = TransientModel::of_annulus(&disc, &materials, undamped, sliding());
    let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let settings = TransientSettings {
        perturbation: Perturbation { time: 2e-4, ..Perturbation::of(&[HARMONIC], 1e-2) },
        ..settings(1e-3, 0.0)
    };
    let start = || CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
    let mut whole = start();
    let mut record = Recorder::new(&whole, &RecorderSettings::default()).unwrap();
    whole.run(&mut record).unwrap();
    println!("balance {:e}", whole.largest_residual());
    assert!(whole.largest_residual() < 1e-10);
    assert!(whole.state().relaxation.iter().flatten().any(|z| *z != 0.0));

    // Steps alone, stopped after the kick and gone on with.
    let steps = whole.plan().total_steps();
    let mut first = start();
    let mut state = None;
    let mut record = Recorder::new(&first, &RecorderSettings::default()).unwrap();
    let mut stop = |sample: &frictionsim::transient::Sample<'_>| {
        if state.is_none() && sample.time > 5e-4 {
            state = Some(sample.state());
        }
        frictionsim::transient::Observer::observe(&mut record, sample)
    };
    struct Watch<'w>(
        &'w mut dyn FnMut(&frictionsim::transient::Sample<'_>) -> std::ops::ControlFlow<()>,
    );
    impl frictionsim::transient::Observer for Watch<'_> {
        fn observe(
            &mut self,
            sample: &frictionsim::transient::Sample<'_>,
        ) -> std::ops::ControlFlow<()> {
            (self.0)(sample)
        }
    }
    first.run(&mut Watch(&mut stop)).unwrap();
    let state = state.unwrap();
    let mut second =
        CentralDifference::resume(model, operator.as_ref(), &settings, &state).unwrap();
    while second.steps_done() < steps {
        second.advance();
    }
    let (one, other) = (second.state(), whole.state());
    assert!(one.displacement == other.displacement && one.velocity == other.velocity);
    assert!(one.relaxation == other.relaxation);
}
