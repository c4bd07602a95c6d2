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
    /// The small motions of one sector of a model.
    fn sector<M: MaterialField>(model: &WaveModel<Self, M>) -> Result<SectorTangent, CeaError>;
}

impl Sectors for AnnulusSpecification {
    fn sector<M: MaterialField>(model: &WaveModel<Self, M>) -> Result<SectorTangent, CeaError> {
        let WaveModel { specification, material, options, contact } = model;
        let sector = Strip::of_annulus(specification)?;
        Ok(SectorTangent::of_annulus(&sector, material, options, contact)?)
    }
}

impl Sectors for SolidSpecification {
    fn sector<M: MaterialField>(model: &WaveModel<Self, M>) -> Result<SectorTangent, CeaError> {
        let WaveModel { specification, material, options, contact } = model;
        let sector = SolidSector::generate(specification)?;
        Ok(SectorTangent::of_revolution(&sector, material, options, contact)?)
    }
}

impl<S: Sectors, M: MaterialField + Clone> WaveModel<S, M> {
    /// The small motions of one sector of it.
    pub fn sector(&self) -> SectorTangent {
        S::sector(self).unwrap()
    }

    /// Its small motions.
    pub fn tangent(&self) -> WaveTangent {
        self.sector().waves()
    }

    /// Its eigenvalues over friction.
    pub fn sweep(&self, request: &SweepRequest<'_>) -> Result<WaveSweep, CeaError> {
        wave_sweep(S::sector(self)?.waves(), request, &[])
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
