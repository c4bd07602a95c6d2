//! The disc of the paper on meshes that run in seconds.

use crate::prelude::*;

pub fn disc(circumferential_elements: usize, radial_elements: usize) -> AnnulusMesh {
    let specification = annulus(ElementKind::Quad4, circumferential_elements, radial_elements);
    AnnulusMesh::generate(&specification).unwrap()
}

pub fn model(annulus: &AnnulusMesh, rotation_speed_rpm: f64) -> TransientModel<'_> {
    TransientModel::of_annulus(annulus, &POLYCARBONATE, DAMPING, contact(rotation_speed_rpm))
}

pub fn settings(duration: f64, harmonics: &[usize]) -> TransientSettings {
    transient_settings(duration, 4e-6, 1e-4, InitialState::Rest, Perturbation::of(harmonics, 1e-3))
}

pub struct Watch<F>(pub F);

impl<F: FnMut(&Sample<'_>)> Observer for Watch<F> {
    fn observe(&mut self, sample: &Sample<'_>) -> ControlFlow<()> {
        (self.0)(sample);
        ControlFlow::Continue(())
    }
}

pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

pub fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |m, (x, y)| m.max((x - y).abs()))
}
