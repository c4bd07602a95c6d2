//! Figures of a real run: the polycarbonate disc on a coarse mesh, seeded with harmonic 2.

use crate::figures::check;
use crate::prelude::*;
use frictionsim::chart::Figure;
use frictionsim::results::charts::ModeLine;
use frictionsim::results::transient::{LinearStage, RecordedRun, SolvedTransient, draw_run};

#[test]
fn a_run_gets_every_figure_of_its_record() {
    let annulus = AnnulusMesh::generate(&annulus(Quad4, 60, 12)).unwrap();
    let contact = SlidingContact { decay: None, friction_coefficient: 0.4, ..contact(610.0) };
    let rotation_speed = contact.rotation_speed;
    let model = TransientModel::of_annulus(&annulus, &POLYCARBONATE, DAMPING, contact);
    let settings =
        transient_settings([0.02, 2e-6, 5e-4], InitialState::Rest, Perturbation::of(&[2], 1e-2));
    let mut run = started(model, OperatorChoice::Auto, &settings);
    // Node 1 + 15 * 13 lies on the contact edge at 90 degrees, seven nodes further out on its ray.
    let (probes, snapshots) = (vec![196, 203], vec![0.001, 0.006, 0.0195]);
    let wanted = RecorderSettings { probes, snapshots, ..RecorderSettings::default() };
    let mut record = Recorder::new(&run, &wanted).unwrap();
    run.run(&mut record).unwrap();
    let analysis = TransientAnalysis::of(&record, &[2]);
    let rate = |own: &Growth| Some((own.harmonic?, own.stage.as_ref().ok()?.rate_per_s.value));
    let growth_rates = analysis.growth.iter().filter_map(rate).collect();
    let solved = SolvedTransient {
        record,
        analysis,
        plan: *run.plan(),
        operator: "cyclic",
        steps: run.steps_done(),
        steps_timed: run.steps_done(),
        stepping_s: 1.0,
        is_finished: true,
    };
    let data = RecordedRun {
        head: Head::default(),
        solved: &solved,
        settings: &settings,
        friction_coefficient: contact.friction_coefficient,
        places: Vec::new(),
        notes: Vec::new(),
        body: ShownBody { mesh: &annulus.mesh, sector: None },
        interface: model.interface(),
        has_harmonics: true,
        material: model.material,
        thickness: 0.009,
        extent: Extent::MetreOfThickness,
        peripheral_speed: rotation_speed * 0.0205,
        stage: LinearStage {
            references: vec![ModeLine { frequency_hz: 9901.0, label: "mode 5, *n* = 2".into() }],
            growth_rates,
            mode_rates: Vec::new(),
        },
    };
    let figures = draw_run(&data);
    let expected: [(&str, &[&str]); 10] = [
        ("overview-196", &["node 196", "time t (ms)"]),
        ("spectrum-196", &["frequency f (kHz)"]),
        ("overview-203", &["contact status", "mode 5", "angle θ (°)"]),
        ("spectrum-203", &["accelerations of node 203", "mode 5", "2f"]),
        ("growth", &["n = 2", "amplitude of uθ (m)"]),
        ("velocity", &["velocity |v| (m/s)", "t = 19.50 ms"]),
        ("shear-stress", &["shear stress τrθ (MPa)"]),
        ("trajectories", &["contact node 196", "radial ur"]),
        ("contact", &["traction (", "cylinder Ωa"]),
        ("energy", &["power (kW/m)", "stored energy", "J/m)"]),
    ];
    assert_eq!(figures.len(), expected.len());
    for (figure, (name, labels)) in figures.iter().zip(expected) {
        assert_eq!(figure.name, name);
        check(&format!("run-{name}"), &figure.to_svg(None).unwrap(), labels);
    }
    // One column of a page.
    for figure in &figures {
        check(&format!("run-{}-column", figure.name), &figure.to_svg(Some(85.0)).unwrap(), &[]);
    }
    let drawn = |figures: &[Figure]| -> Vec<String> {
        figures.iter().map(|figure| figure.to_svg(None).unwrap()).collect()
    };
    assert_eq!(drawn(&figures), drawn(&draw_run(&data)));
}
