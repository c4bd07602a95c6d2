//! The points at which samples are drawn.

use crate::case::Uncertainty;
use crate::study::ScrambledSobol;

/// The points at which a model with uncertain parameters is solved.
///
/// Point `i` of a scrambled Sobol sequence in twice as many dimensions as there are parameters makes two samples: `A_i`
/// of its first half, which is the sample proper, and `B_i` of its second, which only the indices need.
#[derive(Clone, Debug)]
pub struct SamplePlan<'a> {
    uncertainty: &'a Uncertainty,
    sequence: ScrambledSobol,
}

impl<'a> SamplePlan<'a> {
    /// The plan of a case.
    pub fn new(uncertainty: &'a Uncertainty) -> Self {
        let dimensions = 2 * uncertainty.parameters.len();
        Self { sequence: ScrambledSobol::new(dimensions, uncertainty.seed), uncertainty }
    }

    /// Values of sample `index` (from 0).
    pub fn values(&self, index: usize) -> Vec<f64> {
        self.halves(index).0
    }

    /// The further points that the indices need of sample `index`: `B_i`, then `A_i` with the value of one parameter
    /// from `B_i`, parameter by parameter; none beyond the samples that they rest on.
    pub fn mixed(&self, index: usize) -> Vec<Vec<f64>> {
        if index >= self.uncertainty.index_samples {
            return Vec::new();
        }
        let (a, b) = self.halves(index);
        let with = |k: usize| {
            let mut values = a.clone();
            values[k] = b[k];
            values
        };
        let mixed: Vec<Vec<f64>> = (0..a.len()).map(with).collect();
        std::iter::once(b).chain(mixed).collect()
    }

    fn halves(&self, index: usize) -> (Vec<f64>, Vec<f64>) {
        let point = self.sequence.point(index as u32);
        let count = self.uncertainty.parameters.len();
        let of = |part: &[f64]| {
            let pairs = self.uncertainty.parameters.iter().zip(part);
            pairs.map(|(parameter, p)| parameter.value(*p)).collect()
        };
        (of(&point[..count]), of(&point[count..]))
    }
}
