//! The explicit contact transient against theory, other methods and itself.

mod contact;
mod energy;
mod linear_stage;
mod operators;
mod restart;
mod seeds;
mod settling;
mod steps;

use crate::prelude::*;

pub fn disc(circumferential_elements: usize, radial_elements: usize) -> AnnulusMesh {
    let specification = annulus(Quad4, circumferential_elements, radial_elements);
    AnnulusMesh::generate(&specification).unwrap()
}

pub fn model(annulus: &AnnulusMesh, rotation_speed_rpm: f64) -> TransientModel<'_> {
    TransientModel::of_annulus(annulus, &POLYCARBONATE, DAMPING, contact(rotation_speed_rpm))
}

/// The same under another contact.
pub fn on_contact<'a>(
    annulus: &'a AnnulusMesh,
    contact: SlidingContact,
    stiffness: ContactStiffness,
) -> TransientModel<'a> {
    let rigid = TransientModel::of_annulus(annulus, &POLYCARBONATE, DAMPING, contact);
    TransientModel { stiffness, ..rigid }
}

/// A disc without damping, from which the cylinder shrinks away and never touches it.
pub fn free(annulus: &AnnulusMesh) -> TransientModel<'_> {
    let mut model = model(annulus, 0.0);
    model.damping = RayleighDamping::default();
    model.contact.interference = -1.0;
    model
}

/// Contact that stiffens with pressure.
pub const LAWS: [NormalLaw; 2] = [exponential(2e5, 2e-6), cubic(5e11, 2e23)];

pub fn settings(duration: f64, harmonics: &[usize]) -> TransientSettings {
    let seeds = Perturbation::of(harmonics, 1e-3);
    transient_settings([duration, 4e-6, 1e-4], InitialState::Rest, seeds)
}

/// The same, the body kicked with a velocity of its own.
pub fn kicked(duration: f64, harmonics: &[usize], velocity: f64) -> TransientSettings {
    let perturbation = Perturbation::of(harmonics, velocity);
    TransientSettings { perturbation, ..settings(duration, harmonics) }
}

pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

pub fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |m, (x, y)| m.max((x - y).abs()))
}
