//! Maxwell chains in time: growth against the eigenvalue, energy to round-off, restart to the bit.

use crate::prelude::*;

const BAND: [f64; 2] = [300.0, 30_000.0];
const HARMONIC: usize = 2;

fn chain() -> MaxwellChain {
    MaxwellChain::fit(&|_| c64::new(1.0, 0.02), BAND)
}

fn relaxed() -> Vec<RegionMaterial> {
    vec![RegionMaterial::in_time(&POLYCARBONATE, 0, Some(chain()))]
}

/// Friction at which the wave grows slowly enough for a long linear stage.
fn sliding() -> SlidingContact {
    SlidingContact { friction_coefficient: 0.15, ..contact(610.0) }
}

fn disc() -> AnnulusMesh {
    AnnulusMesh::generate(&annulus(Quad4, 60, 12)).unwrap()
}

fn settings(duration: f64, kick: Perturbation) -> TransientSettings {
    transient_settings([duration, 4e-6, 1e-4], InitialState::SteadySliding, kick)
}

/// The largest growth rate of the body (1/s), its modulus a table that the chain fills, lumped as the time loop has it.
fn eigenvalue() -> f64 {
    let table = modulus_table(&chain(), POLYCARBONATE.young_modulus, BAND);
    let elastic = ElasticMaterial { young_modulus: table.static_modulus(), ..POLYCARBONATE };
    let table = Some(Arc::new(table));
    let materials = vec![RegionMaterial { table, ..elastic.into() }];
    let mesh = disc().mesh;
    let options = TangentOptions { mass: Lumped, damping: RayleighDamping::default(), ..TANGENT };
    let tangent = linearized(&mesh, &materials, &sliding(), &options);
    let modes = modes_at(&tangent, sliding().friction_coefficient, Lowest(8));
    fastest(modes.iter().filter(|mode| mode.harmonic == HARMONIC)).growth_rate()
}

/// Cross-method: a seeded wave grows as the eigenvalue at its frequency says; springs and dashpots are in the balance of energy.
#[test]
fn a_wave_grows_as_its_eigenvalue_says_with_a_chain_in_place_of_a_loss_factor() {
    let (disc, materials) = (disc(), relaxed());
    let model =
        TransientModel::of_annulus(&disc, &materials, RayleighDamping::default(), sliding());
    let settings = settings(0.020, Perturbation::of(&[HARMONIC], 1e-8));
    let (record, residual) = recorded(model, OperatorChoice::Auto, &settings);
    below(residual, 1e-10, "balance");
    let analysis = TransientAnalysis::of(&record, &[HARMONIC]);
    let found = analysis.growth[0].stage.as_ref().unwrap().rate_per_s.value;
    // The eigenvalue has the stiffness of its frequency, the chain that of its growth too: sigma / omega times the rise of the
    // modulus a factor e, over the growth.
    near(found, eigenvalue(), 0.02);
}

/// Consistency check: elements come to a kick with another velocity than before it, and to a run that goes on with their stretch.
#[test]
fn a_kick_keeps_the_balance_and_a_run_goes_on_to_the_same_bits() {
    let (disc, materials) = (disc(), relaxed());
    let model =
        TransientModel::of_annulus(&disc, &materials, RayleighDamping::default(), sliding());
    // Stopped after the kick and gone on with.
    let kick = Perturbation { time: 2e-4, ..Perturbation::of(&[HARMONIC], 1e-2) };
    let [first, whole] = [5e-4, 1e-3].map(|duration| settings(duration, kick.clone()));
    let (_, residual) = recorded(model, OperatorChoice::Auto, &whole);
    below(residual, 1e-10, "balance");
    let half = goes_on(model, OperatorChoice::Auto, [&first, &whole]);
    assert!(half.relaxation.iter().flatten().any(|z| *z != 0.0));
}
