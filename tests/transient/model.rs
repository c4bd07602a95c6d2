//! The disc of the paper on meshes that run in seconds.

use frictionsim::contact::SlidingContact;
use frictionsim::fem::{ElasticMaterial, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusMesh, AnnulusSpecification, ElementKind};
use frictionsim::transient::{
    InitialState, Observer, Perturbation, Sample, TimeStep, TransientModel, TransientSettings,
};
use std::f64::consts::TAU;
use std::ops::ControlFlow;

pub fn disc(circumferential_elements: usize, radial_elements: usize) -> AnnulusMesh {
    AnnulusMesh::generate(&AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements,
        radial_elements,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
    })
    .unwrap()
}

pub fn model(annulus: &AnnulusMesh, rotation_speed_rpm: f64) -> TransientModel<'_> {
    TransientModel {
        annulus,
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
            rotation_speed: rotation_speed_rpm * TAU / 60.0,
        },
    }
}

pub fn settings(duration: f64, harmonics: &[usize]) -> TransientSettings {
    TransientSettings {
        duration,
        time_step: TimeStep::Auto,
        sample_interval: 4e-6,
        expansion_time: 1e-4,
        initial: InitialState::Rest,
        perturbation: Perturbation {
            harmonics: harmonics.to_vec(),
            velocity: 1e-3,
        },
    }
}

/// Hands every sample to a closure.
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
