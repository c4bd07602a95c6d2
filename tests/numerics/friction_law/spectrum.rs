//! Eigenvalues, onsets, responses and sensitivities of the disc.

use crate::friction_law::falling;
use crate::prelude::*;
use crate::waves::{STEP, is_of, pairs, rates};

fn options(normal_stiffness: Option<f64>) -> TangentOptions {
    TangentOptions {
        geometric_stiffness: true,
        contact: ContactStiffness { normal_stiffness, ..RIGID },
        ..TANGENT
    }
}

fn swept(
    specification: &AnnulusSpecification,
    material: &ElasticMaterial,
    options: &TangentOptions,
    contact: &SlidingContact,
    frictions: &[f64],
) -> WaveSweep {
    let request = sweep_request(frictions, ModeLimit::Lowest(18));
    cyclic::sweep(specification, material, options, contact, &request).unwrap()
}

fn whole(
    specification: &AnnulusSpecification,
    options: &TangentOptions,
    contact: &SlidingContact,
) -> SlidingTangent {
    let mesh = AnnulusMesh::generate(specification).unwrap().mesh;
    linearized(&mesh, &POLYCARBONATE, contact, options)
}

fn assert_same(ours: &FrictionSweep, theirs: &FrictionSweep) {
    for (ours, theirs) in ours.points.iter().zip(&theirs.points) {
        assert_eq!(ours.modes.len(), theirs.modes.len());
        for mode in &ours.modes {
            let distance = |m: &ComplexMode| (m.eigenvalue - mode.eigenvalue).norm();
            let nearest = theirs.modes.iter().map(distance).fold(f64::MAX, f64::min);
            assert!(nearest < 1e-9 * mode.eigenvalue.norm(), "{mode:?} {nearest:e}");
        }
    }
    assert_eq!(ours.intervals.len(), theirs.intervals.len());
    for (ours, theirs) in ours.intervals.iter().zip(&theirs.intervals) {
        assert!((ours.critical_friction - theirs.critical_friction).abs() < 1e-8);
    }
}

/// Cross-method: harmonics of one sector against the matrices of the whole mesh, at both senses of rotation.
#[test]
fn harmonics_and_the_whole_mesh_have_one_spectrum_under_a_falling_law() {
    for (rpm, normal_stiffness, element, sectors) in
        [(610.0, None, ElementKind::Quad4, 36), (-300.0, Some(7.4e12), ElementKind::Quad8, 18)]
    {
        let (options, contact) = (options(normal_stiffness), falling(rpm));
        let specification = annulus(element, sectors, 6);
        let frictions = [0.0, 0.2, 0.4];
        let ours = swept(&specification, &POLYCARBONATE, &options, &contact, &frictions);
        let request = sweep_request(&frictions, ModeLimit::Lowest(18));
        let tangent = whole(&specification, &options, &contact);
        let theirs = sparse::sweep(&tangent, &request, &|_| {}).unwrap();
        assert_same(&ours.sweep, &theirs);
    }
}

/// Theory: far above the decay speed friction is constant; far below it is static, with a dashpot.
#[test]
fn far_above_the_decay_speed_the_spectrum_is_that_of_constant_friction() {
    let specification = annulus(ElementKind::Quad4, 36, 6);
    let mut fast = falling(610.0);
    fast.decay = Some(FrictionDecay { static_ratio: 1.5, decay_speed: 0.03 });
    let constant = SlidingContact { decay: None, ..fast };
    let of = |contact: &SlidingContact| {
        swept(&specification, &POLYCARBONATE, &options(None), contact, &[0.2, 0.4]).sweep
    };
    assert_same(&of(&fast), &of(&constant));
}

#[test]
fn responses_by_harmonics_and_of_the_whole_mesh_agree_under_a_falling_law() {
    let specification = annulus(ElementKind::Quad4, 24, 5);
    let (options, contact) = (options(None), falling(610.0));
    let sector = SectorMesh::generate(&specification).unwrap();
    let tangent = WaveTangent::of_annulus(&sector, &POLYCARBONATE, &options, &contact).unwrap();
    let terminal = Terminal { node: 3, direction: Direction::Tangential };
    let frequencies = [3000.0, 9000.0];
    let by_harmonics =
        cyclic_response(&CyclicSystem::sliding(&tangent, 0.3), terminal, terminal, &frequencies)
            .unwrap();
    let system = FrfSystem::sliding(&whole(&specification, &options, &contact), 0.3);
    let unknown = system.unknown(terminal, "node").unwrap();
    let direct = direct_response(&system, unknown, unknown, &frequencies).unwrap();
    for (a, b) in by_harmonics.receptance.iter().zip(&direct.receptance) {
        assert!((a - b).norm() < 1e-9 * b.norm());
    }
}

/// Central differences of the whole analysis, the base state's pressure included.
#[test]
fn sensitivities_to_the_law_equal_finite_differences() {
    let specification = annulus(ElementKind::Quad4, 24, 6);
    let sector = SectorMesh::generate(&specification).unwrap();
    let friction = 0.35;
    let mut contact = falling(300.0);
    contact.interference = 3e-4;
    for normal_stiffness in [None, Some(7.4e12)] {
        let options = options(normal_stiffness);
        let of = |material: &ElasticMaterial, contact: &SlidingContact| {
            swept(&specification, material, &options, contact, &[0.0, friction])
        };
        let changed = |index: usize, step: f64| {
            let (mut material, mut contact) = (POLYCARBONATE, contact);
            let decay = contact.decay.as_mut().unwrap();
            match index {
                0 => decay.static_ratio += step,
                1 => decay.decay_speed += step,
                2 => material.young_modulus += 2e9 * step,
                _ => material.poisson_ratio += step,
            }
            (material, contact)
        };
        let tangent = |(material, contact): (ElasticMaterial, SlidingContact)| {
            WaveTangent::of_annulus(&sector, &material, &options, &contact).unwrap()
        };
        let found = of(&POLYCARBONATE, &contact);
        let pairs = pairs(&tangent(changed(0, 0.0)), &found.branches, friction);
        let step = 1e-3;
        for index in 0..4 {
            let moved = [-2.0, -1.0, 1.0, 2.0].map(|times| {
                let (material, contact) = changed(index, times * step);
                of(&material, &contact)
            });
            let rates = rates(&pairs, STEP, &|offset| tangent(changed(index, offset)));
            for (pair, rate) in pairs.iter().zip(rates) {
                let [a, b, c, d] = moved.each_ref().map(|sweep| {
                    let branch = sweep.branches.iter().find(is_of(pair)).unwrap();
                    branch.interpolate(friction).unwrap()
                });
                let numeric = ((c - b) * 8.0 - (d - a)) / (12.0 * step);
                let size = numeric.norm() + 1e-3 * pair.eigenvalue.norm();
                let error = (rate - numeric).norm() / size;
                assert!(error < 1e-6, "{index} {pair:?} {numeric} {error:e}");
            }
        }
    }
}
