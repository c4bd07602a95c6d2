//! Weighted nonlinear least squares for the poles and numerators of a modal model.

use super::NoiseModel;
use super::basis::{Lines, ModalModel, ModalShare, Pole, fill};
use super::normal_equations::{damped_step, gram, inverse};
use crate::{FrequencyResponse, SignalError};
use faer::{Mat, c64};
use nalgebra::{DMatrix, DVector};

/// Iterations of Levenberg and Marquardt.
const ITERATIONS: usize = 60;

/// Responses with weights, to which models with common poles are fitted.
pub(super) struct Problem<'a> {
    parts: Vec<Lines<'a>>,
    reference_hz: f64,
}

/// A model fitted to a problem, with what the fit knows about itself.
pub(super) struct Fitted {
    pub model: ModalModel,
    /// Sum of squared weighted residuals.
    pub chi_square: f64,
    /// Inverse of the normal matrix over `[ln f_k, ln zeta_k ...]` and, for each response,
    /// `[a_k, b_k ..., c_m ...]`.
    pub inverse_normal: DMatrix<f64>,
}

impl<'a> Problem<'a> {
    /// Responses, each with its noise and the moduli that this depends on.
    pub(super) fn new(
        responses: &'a [FrequencyResponse],
        noise: &[NoiseModel],
        moduli: &[Vec<f64>],
    ) -> Self {
        let last = |r: &FrequencyResponse| r.frequencies_hz()[r.frequencies_hz().len() - 1];
        let reference_hz = responses.iter().map(last).fold(0.0, f64::max);
        let parts = responses.iter().zip(noise).zip(moduli);
        let parts =
            parts.map(|((own, noise), moduli)| Lines::new(own, noise, moduli, reference_hz));
        Self { parts: parts.collect(), reference_hz }
    }

    /// Real numbers in the data: two for each line, one where the phase is unknown.
    pub(super) fn data_count(&self) -> usize {
        let count = |part: &Lines| {
            let components = if part.response.has_phase() { 2 } else { 1 };
            components * part.weights.len()
        };
        self.parts.iter().map(count).sum()
    }

    /// Squared length of the projection of weighted residuals on the functions of a pole, over the lines
    /// within `reach` bandwidths.
    pub(super) fn projection(&self, residuals: &[Vec<c64>], pole: Pole, reach: f64) -> f64 {
        let pairs = self.parts.iter().zip(residuals);
        pairs.map(|(part, residual)| part.projection(residual, pole, reach)).sum()
    }

    /// Noise of each response about a model, and the moduli of the model.
    pub(super) fn noise(&self, model: &ModalModel) -> (Vec<NoiseModel>, Vec<Vec<f64>>) {
        let pairs = self.parts.iter().zip(&model.shares);
        pairs.map(|(part, share)| part.noise(&part.values(&model.poles, share))).unzip()
    }

    /// Residuals in units of their standard deviation.
    pub(super) fn weighted_residuals(&self, model: &ModalModel) -> Vec<Vec<c64>> {
        let pairs = self.parts.iter().zip(&model.shares);
        pairs
            .map(|(part, share)| part.weighted_residuals(&part.values(&model.poles, share)))
            .collect()
    }

    /// Fits poles, numerators and a remainder of `remainder` terms.
    ///
    /// With phase, the numerators and the remainder are solved for exactly at every trial of the
    /// poles (variable projection in Ruhe and Wedin's second form). Without, the first ones come from
    /// lending the model's phase to the data a few times, and then all are iterated together.
    pub(super) fn fit(&self, poles: &[Pole], remainder: usize) -> Result<Fitted, SignalError> {
        let shares = self.parts.iter().map(|part| part.start(poles, remainder));
        let mut model = ModalModel {
            poles: poles.to_vec(),
            shares: shares.collect::<Result<_, _>>()?,
            reference_hz: self.reference_hz,
        };
        let mut chi_square = self.chi_square(&model);
        let mut damping = 1e-3;
        let mut equations = self.normal_equations(&model);
        for _ in 0..ITERATIONS {
            let mut gained = None;
            while damping < 1e8 {
                let step = damped_step(&equations.0, &equations.1, damping)?;
                let trial = self.moved(&model, &step, remainder)?;
                let value = self.chi_square(&trial);
                if value.is_finite() && value <= chi_square {
                    gained = Some(chi_square - value);
                    (model, chi_square) = (trial, value);
                    equations = self.normal_equations(&model);
                    damping = (damping * 0.1).max(1e-9);
                    break;
                }
                damping *= 10.0;
            }
            // A hundredth of chi-square is a tenth of a standard deviation, and the next step of a
            // method that converges this fast would gain far less.
            if !gained.is_some_and(|gain| gain > 1e-2 + 1e-12 * chi_square) {
                break;
            }
        }
        Ok(Fitted { model, chi_square, inverse_normal: inverse(&equations.0)? })
    }

    fn chi_square(&self, model: &ModalModel) -> f64 {
        let residuals = self.weighted_residuals(model);
        residuals.iter().flatten().map(|r| r.norm_sqr()).sum()
    }

    /// Normal matrix and gradient over the poles and what each response has of its own: the responses meet
    /// in the block of the poles alone.
    fn normal_equations(&self, model: &ModalModel) -> (DMatrix<f64>, DVector<f64>) {
        let common = 2 * model.poles.len();
        let own = common + model.shares[0].remainder.len();
        let size = common + self.parts.len() * own;
        let (mut normal, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        for (number, (part, share)) in self.parts.iter().zip(&model.shares).enumerate() {
            let (block, gradient) = part.normal_equations(&model.poles, share);
            let place = |k: usize| if k < common { k } else { k + number * own };
            for j in 0..common + own {
                right[place(j)] += gradient[j];
                for i in 0..common + own {
                    normal[(place(i), place(j))] += block[(i, j)];
                }
            }
        }
        (normal, right)
    }

    /// The model after a step of its parameters.
    fn moved(
        &self,
        model: &ModalModel,
        step: &DVector<f64>,
        remainder: usize,
    ) -> Result<ModalModel, SignalError> {
        let count = model.poles.len();
        let moved = |(k, p): (usize, &Pole)| Pole {
            frequency_hz: p.frequency_hz * step[2 * k].clamp(-0.05, 0.05).exp(),
            damping_factor: (p.damping_factor * step[2 * k + 1].clamp(-1.0, 1.0).exp())
                .clamp(1e-7, 0.9),
        };
        let poles: Vec<Pole> = model.poles.iter().enumerate().map(moved).collect();
        let numbered = self.parts.iter().zip(&model.shares).enumerate();
        let shares = numbered.map(|(number, (part, share))| {
            if part.response.has_phase() {
                return part.projected(&poles, remainder, part.response.values());
            }
            let first = 2 * count + number * (2 * count + remainder);
            let mut share = share.clone();
            for (k, ab) in share.numerators.iter_mut().enumerate() {
                ab[0] += step[first + 2 * k];
                ab[1] += step[first + 2 * k + 1];
            }
            for (m, c) in share.remainder.iter_mut().enumerate() {
                *c += step[first + 2 * count + m];
            }
            Ok(share)
        });
        Ok(ModalModel {
            shares: shares.collect::<Result<_, _>>()?,
            poles,
            reference_hz: self.reference_hz,
        })
    }
}

impl Lines<'_> {
    /// Noise about a model with these values, and their moduli.
    fn noise(&self, values: &[c64]) -> (NoiseModel, Vec<f64>) {
        let residuals = self.residuals(values);
        let pairs = residuals.iter().zip(self.response.variance_factors());
        let squares: Vec<f64> = pairs.map(|(r, factor)| r.norm_sqr() / factor).collect();
        let moduli: Vec<f64> = values.iter().map(|v| v.norm()).collect();
        (NoiseModel::from_squares(&squares, &moduli, self.response.has_phase()), moduli)
    }

    /// Residual of each line, data less model, not weighted; real where the phase is unknown.
    fn residuals(&self, values: &[c64]) -> Vec<c64> {
        let pairs = self.response.values().iter().zip(values);
        match self.response.has_phase() {
            true => pairs.map(|(d, m)| d - m).collect(),
            false => pairs.map(|(d, m)| c64::new(d.re - m.norm(), 0.0)).collect(),
        }
    }

    fn weighted_residuals(&self, values: &[c64]) -> Vec<c64> {
        let r = self.residuals(values);
        r.iter().zip(&self.weights).map(|(r, w)| r * *w).collect()
    }

    /// Numerators for given poles, before any iteration.
    fn start(&self, poles: &[Pole], remainder: usize) -> Result<ModalShare, SignalError> {
        if self.response.has_phase() {
            return self.projected(poles, remainder, self.response.values());
        }
        // Each pole alone has the height of the data at its frequency.
        let quantity = self.response.quantity();
        let mut share =
            ModalShare { quantity, numerators: Vec::new(), remainder: vec![0.0; remainder] };
        let (f, data) = (self.response.frequencies_hz(), self.response.values());
        for pole in poles {
            let nearest = f.partition_point(|f| *f < pole.frequency_hz).min(f.len() - 1);
            let own = ModalShare { quantity, numerators: vec![[1.0, 0.0]], remainder: Vec::new() };
            let (poles, shares) = (vec![*pole], vec![own]);
            let alone = ModalModel { poles, shares, reference_hz: self.reference_hz };
            let height = data[nearest].re / alone.evaluate(0, f[nearest]).norm();
            share.numerators.push([height, 0.0]);
        }
        // The phase of the model is lent to the data.
        for _ in 0..20 {
            let values = self.values(poles, &share);
            let pairs = values.iter().zip(data);
            let lent: Vec<c64> = pairs
                .map(|(m, d)| if m.norm() > 0.0 { m * (d.re / m.norm()) } else { *d })
                .collect();
            share = self.projected(poles, remainder, &lent)?;
        }
        Ok(share)
    }

    /// What is nearest to complex `data` with given poles.
    fn projected(
        &self,
        poles: &[Pole],
        remainder: usize,
        data: &[c64],
    ) -> Result<ModalShare, SignalError> {
        let columns = 2 * poles.len() + remainder;
        let count = self.weights.len();
        let mut matrix = Mat::<f64>::zeros(2 * count, columns + 1);
        self.fill_linear(poles, remainder, 0, &mut matrix);
        fill(&mut matrix, columns, data.iter().zip(&self.weights).map(|(z, w)| z * *w));
        let (normal, right) = gram(&matrix);
        let x = damped_step(&normal, &right, 0.0)?;
        Ok(ModalShare {
            quantity: self.response.quantity(),
            numerators: (0..poles.len()).map(|k| [x[2 * k], x[2 * k + 1]]).collect(),
            remainder: (2 * poles.len()..columns).map(|k| x[k]).collect(),
        })
    }

    /// Normal matrix and gradient over poles, numerators and remainder.
    fn normal_equations(&self, poles: &[Pole], share: &ModalShare) -> (DMatrix<f64>, DVector<f64>) {
        let remainder = share.remainder.len();
        let columns = 4 * poles.len() + remainder;
        let count = self.weights.len();
        let mut matrix = Mat::<f64>::zeros(2 * count, columns + 1);
        self.fill_pole_derivatives(poles, share, &mut matrix);
        self.fill_linear(poles, remainder, 2 * poles.len(), &mut matrix);
        let values = self.values(poles, share);
        if !self.response.has_phase() {
            turn_to(&values, &mut matrix);
        }
        fill(&mut matrix, columns, self.weighted_residuals(&values).into_iter());
        gram(&matrix)
    }
}

/// Without phase only the change along the model's own direction is seen: every column is turned by
/// the conjugate direction of the model, and its imaginary part dropped.
fn turn_to(values: &[c64], matrix: &mut Mat<f64>) {
    let count = values.len();
    for k in 0..matrix.ncols() {
        for (i, value) in values.iter().enumerate() {
            let turn = value.conj() / value.norm().max(f64::MIN_POSITIVE);
            let z = c64::new(matrix[(i, k)], matrix[(count + i, k)]) * turn;
            matrix[(i, k)] = z.re;
            matrix[(count + i, k)] = 0.0;
        }
    }
}
