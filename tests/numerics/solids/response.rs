//! Frequency responses of bodies of revolution.

use super::*;
use crate::solids::whole_ring::WholeRing;

pub fn body(model: &SolidModel, is_clamped: bool) -> CyclicSystem {
    let sector = SolidSector::generate(&model.specification).unwrap();
    let (mass, damping) = (model.options.mass, model.options.damping);
    let tangent = WaveTangent::of_free(&sector.strip, &model.material, mass, damping, is_clamped);
    CyclicSystem::sliding(&tangent, 0.0)
}

pub fn sliding(model: &SolidModel, friction: f64) -> CyclicSystem {
    CyclicSystem::sliding(&model.tangent(), friction)
}

fn small(element: ElementKind) -> SolidModel {
    let (divisions, mass) =
        if element == Quad4 { ([11, 3, 2], Lumped) } else { ([8, 2, 1], Consistent) };
    let mut model = disc(element, divisions);
    model.options.mass = mass;
    model.specification.annulus.radial_grading = 1.2;
    model
}

/// The terminal at a place of a sheet, in halves of an element, `half_step` halves of a sector ahead.
pub fn at(
    sector: &SolidSector,
    s: usize,
    place: [usize; 2],
    half_step: usize,
    direction: Direction,
) -> Terminal {
    let mut all = sector.nodes.iter();
    let node = all.position(|node| node.place == place && node.half_step == half_step);
    Terminal { node: s * sector.node_count() + node.unwrap(), direction }
}

pub const FREQUENCIES: [f64; 6] = [700.0, 1999.0, 4321.0, 7000.0, 9100.0, 15_000.0];

/// A force and several motions by harmonics and by a dense solution of the ring; on the top only motions that it leaves free.
fn agrees(cyclic: &CyclicSystem, whole: &WholeRing, force: Terminal, is_free: bool, what: &str) {
    let sector = &whole.sector;
    let quadratic = usize::from(sector.is_quadratic());
    let [_, nz] = sector.specification.divisions();
    let top = [
        at(sector, 3, [0, 2 * nz], 0, Axial),
        at(sector, 2, [2 - quadratic, 2 * nz], 0, Axial),
        at(sector, 1, [2, 2 * nz], quadratic, Tangential),
    ];
    let responses = [
        force,
        at(sector, 5, [2, 0], quadratic, Radial),
        at(sector, 2, [2 - quadratic, 2], 0, Axial),
        at(sector, 6, [0, 0], 0, Tangential),
    ];
    let responses = [&responses, &top[..if is_free { 3 } else { 0 }]].concat();
    let dof = |t: &Terminal| 3 * t.node + t.direction.component().unwrap();
    let dofs: Vec<usize> = responses.iter().map(dof).collect();
    let dense = FREQUENCIES.map(|f| whole.respond(f, dof(&force), &dofs));
    let mut worst = 0.0_f64;
    for (k, response) in responses.into_iter().enumerate() {
        let found = cyclic_response(cyclic, force, response, &FREQUENCIES).unwrap();
        assert!(found.backward_error <= 1e-14);
        for (h, dense) in found.receptance.iter().zip(&dense) {
            let top = dense.iter().fold(0.0_f64, |m, h| m.max(h.norm()));
            worst = worst.max((h - dense[k]).norm() / top);
        }
    }
    // Backward errors of 1e-14 or less, condition numbers below 1e4 from 700 Hz up.
    assert!(worst < 1e-10, "{what}: {worst:e}");
}

/// Independent check: no harmonics, other elements or another operator, dense factorization.
#[test]
fn harmonics_of_a_free_and_a_held_body_sum_to_the_response_of_a_whole_ring_of_bricks() {
    for (element, is_free) in [(Quad4, true), (Quad4, false), (Quad8, true), (Quad8, false)] {
        let model = small(element);
        let whole = WholeRing::new(&model, is_free);
        let system = body(&model, !is_free);
        for direction in [Radial, Tangential, Axial] {
            let force = at(&whole.sector, 1, [0, 0], 0, direction);
            let what = format!("{element:?}, free {is_free}, {direction:?}");
            agrees(&system, &whole, force, true, &what);
        }
    }
}

#[test]
fn a_body_on_springs_responds_like_the_whole_ring() {
    let mut model = small(Quad4);
    model.specification.conditions = [Free, support([1e11, 3e10, 2e10], [0.0, 0.0]), Free, Guide];
    // The operator's stiffness has the springs in it, on which beta_R does not act.
    model.options.damping.stiffness_coefficient = 0.0;
    let whole = WholeRing::new(&model, false);
    let force = at(&whole.sector, 1, [6, 4], 0, Axial);
    agrees(&body(&model, true), &whole, force, true, "springs");
}

/// Independent check: contact conditions put in by hand, rigid and with springs, on the inner edge and under a ring.
#[test]
fn harmonics_in_sliding_contact_sum_to_the_response_of_a_whole_ring_of_bricks() {
    let rigid = ContactStiffness::default();
    let springs = compliant(1e12, [3e4, 2e4]);
    let ring = SolidContact::Ring { inner_radius: 0.03, outer_radius: 0.06 };
    for (element, contact, place) in [
        (Quad4, rigid, SolidContact::Inner),
        (Quad8, rigid, SolidContact::Inner),
        (Quad4, springs, SolidContact::Inner),
        (Quad4, rigid, ring),
        (Quad4, springs, ring),
    ] {
        let mut model = small(element);
        model.options.contact = contact;
        model.options.damping_model = BodyOnly;
        model.specification.contact = place;
        if place != SolidContact::Inner {
            model.specification.conditions[3] = Guide;
        }
        let whole = WholeRing::sliding(&model, 0.3);
        let system = sliding(&model, 0.3);
        // Inside the thickness where the ring holds the top.
        let own = if place == SolidContact::Inner { [0, 0] } else { [2, 2] };
        for direction in [Tangential, Axial] {
            let force = at(&whole.sector, 1, own, 0, direction);
            let what = format!("{element:?}, {contact:?}, {place:?}, {direction:?}");
            agrees(&system, &whole, force, false, &what);
        }
    }
}

#[test]
fn the_response_has_the_same_bits_on_any_number_of_threads() {
    let model = disc(Quad4, [12, 3, 2]);
    let system = sliding(&model, 0.3);
    let sector = SolidSector::generate(&model.specification).unwrap();
    let (a, b) = (at(&sector, 1, [0, 0], 0, Axial), at(&sector, 5, [2, 4], 0, Radial));
    let f: Vec<f64> = (1..=77).map(|line| 100.0 * f64::from(line)).collect();
    let work = || cyclic_response(&system, a, b, &f).unwrap();
    assert_eq!(on_threads(1, work), on_threads(3, work));
}
