//! Bodies that are solved harmonic by harmonic, with all that their analysis is made from.

use super::prelude::*;
use frictionsim::cea::cyclic::{WaveSweep, wave_sweep};

/// A body with all that its analysis is made from.
#[derive(Clone, Debug, PartialEq)]
pub struct WaveModel<S, M = ElasticMaterial> {
    pub specification: S,
    pub material: M,
    pub options: TangentOptions,
    pub contact: SlidingContact,
}

pub type AnnulusModel<M = ElasticMaterial> = WaveModel<AnnulusSpecification, M>;

/// What a body is made from by equal sectors.
pub trait Sectors: Clone {
    /// The small motions of a model.
    fn waves<M: MaterialField>(model: &WaveModel<Self, M>) -> Result<WaveTangent, CeaError>;
}

impl Sectors for AnnulusSpecification {
    fn waves<M: MaterialField>(model: &WaveModel<Self, M>) -> Result<WaveTangent, CeaError> {
        let WaveModel { specification, material, options, contact } = model;
        let sector = Strip::of_annulus(specification)?;
        Ok(WaveTangent::of_annulus(&sector, material, options, contact)?)
    }
}

impl Sectors for SolidSpecification {
    fn waves<M: MaterialField>(model: &WaveModel<Self, M>) -> Result<WaveTangent, CeaError> {
        let WaveModel { specification, material, options, contact } = model;
        let sector = SolidSector::generate(specification)?;
        Ok(WaveTangent::of_revolution(&sector, material, options, contact)?)
    }
}

impl<S: Sectors, M: MaterialField + Clone> WaveModel<S, M> {
    /// Its small motions.
    pub fn tangent(&self) -> WaveTangent {
        S::waves(self).unwrap()
    }

    /// Its eigenvalues over friction.
    pub fn sweep(&self, request: &SweepRequest<'_>) -> Result<WaveSweep, CeaError> {
        wave_sweep(S::waves(self)?, request, &[])
    }

    /// The modes of a limit at some friction coefficients.
    pub fn swept(&self, frictions: &[f64], limit: ModeLimit) -> WaveSweep {
        self.sweep(&sweep_request(frictions, limit)).unwrap()
    }

    /// The same at one.
    pub fn modes(&self, friction: f64, limit: ModeLimit) -> Vec<ComplexMode> {
        self.swept(&[friction], limit).sweep.points.remove(0).modes
    }

    /// The same model with a change.
    pub fn with(&self, change: impl FnOnce(&mut Self)) -> Self {
        let mut changed = self.clone();
        change(&mut changed);
        changed
    }
}

impl<M: MaterialField> AnnulusModel<M> {
    /// Its small motions on the whole mesh, which knows nothing of the symmetry.
    pub fn whole(&self) -> SlidingTangent {
        let mesh = AnnulusMesh::generate(&self.specification).unwrap().mesh;
        linearized(&mesh, &self.material, &self.contact, &self.options)
    }
}
