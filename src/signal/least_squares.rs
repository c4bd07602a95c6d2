//! Weighted nonlinear least squares for the poles and numerators of a modal model.

use super::modal_basis::{Lines, ModalModel, Pole};
use super::{FrequencyResponse, NoiseModel, SignalError};
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, Par, c64};
use nalgebra::{DMatrix, DVector};

/// Iterations of Levenberg and Marquardt.
const ITERATIONS: usize = 60;

/// Data with weights, to which models are fitted.
pub(super) struct Problem<'a> {
    response: &'a FrequencyResponse,
    /// `1 / sigma` of one real component, for each line.
    weights: Vec<f64>,
    lines: Lines,
}

/// A model fitted to a problem, with what the fit knows about itself.
pub(super) struct Fitted {
    pub model: ModalModel,
    /// Sum of squared weighted residuals.
    pub chi_square: f64,
    /// Inverse of the normal matrix over `[ln f_k, ln zeta_k ..., a_k, b_k ..., c_m ...]`.
    pub inverse_normal: DMatrix<f64>,
}

impl<'a> Problem<'a> {
    /// Weights from a noise model and the moduli of a response (the data's own, or a model's).
    pub(super) fn new(response: &'a FrequencyResponse, noise: NoiseModel, moduli: &[f64]) -> Self {
        let f = response.frequencies_hz();
        let weights: Vec<f64> = moduli
            .iter()
            .map(|m| 1.0 / noise.variance(*m).sqrt())
            .collect();
        let lines = Lines::new(f, &weights, response.quantity(), f[f.len() - 1]);
        Self {
            response,
            weights,
            lines,
        }
    }

    /// Real numbers in the data: two for each line, one where the phase is unknown.
    pub(super) fn data_count(&self) -> usize {
        let lines = self.weights.len();
        if self.response.has_phase() {
            2 * lines
        } else {
            lines
        }
    }

    /// The frequency lines.
    pub(super) fn lines(&self) -> &Lines {
        &self.lines
    }

    /// Model values on every line.
    pub(super) fn values(&self, model: &ModalModel) -> Vec<c64> {
        let weighted = self.lines.weighted_values(model);
        let pairs = weighted.iter().zip(&self.weights);
        pairs.map(|(v, w)| v / *w).collect()
    }

    /// Residual of each line, data less model, not weighted; real where the phase is unknown.
    pub(super) fn residuals(&self, values: &[c64]) -> Vec<c64> {
        let data = self.response.values();
        let pairs = data.iter().zip(values);
        if self.response.has_phase() {
            pairs.map(|(d, m)| d - m).collect()
        } else {
            pairs.map(|(d, m)| c64::new(d.re - m.norm(), 0.0)).collect()
        }
    }

    /// Residuals in units of their standard deviation.
    pub(super) fn weighted_residuals(&self, values: &[c64]) -> Vec<c64> {
        let r = self.residuals(values);
        r.iter().zip(&self.weights).map(|(r, w)| r * *w).collect()
    }

    /// Fits poles, numerators and a remainder of `remainder` terms.
    ///
    /// With phase, the numerators and the remainder are solved for exactly at every trial of the
    /// poles (variable projection in Ruhe and Wedin's second form). Without, the first ones come from
    /// lending the model's phase to the data a few times, and then all are iterated together.
    pub(super) fn fit(&self, poles: &[Pole], remainder: usize) -> Result<Fitted, SignalError> {
        let mut model = self.start(poles, remainder)?;
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
            match gained {
                Some(gain) if gain > 1e-2 + 1e-12 * chi_square => {}
                _ => break,
            }
        }
        Ok(Fitted {
            model,
            chi_square,
            inverse_normal: inverse(&equations.0)?,
        })
    }

    fn chi_square(&self, model: &ModalModel) -> f64 {
        let r = self.weighted_residuals(&self.values(model));
        r.iter().map(|r| r.norm_sqr()).sum()
    }

    /// Numerators for given poles, before any iteration.
    fn start(&self, poles: &[Pole], remainder: usize) -> Result<ModalModel, SignalError> {
        if self.response.has_phase() {
            return self.projected(poles, remainder, self.response.values());
        }
        let mut model = ModalModel {
            quantity: self.response.quantity(),
            poles: poles.to_vec(),
            numerators: poles.iter().map(|_| [1.0, 0.0]).collect(),
            remainder: vec![0.0; remainder],
            reference_hz: self.lines.reference_hz(),
        };
        let (f, data) = (self.response.frequencies_hz(), self.response.values());
        for (k, pole) in poles.iter().enumerate() {
            let nearest = f
                .partition_point(|f| *f < pole.frequency_hz)
                .min(f.len() - 1);
            let mut alone = model.clone();
            (alone.poles, alone.numerators) = (vec![*pole], vec![[1.0, 0.0]]);
            model.numerators[k][0] = data[nearest].re / alone.evaluate(f[nearest]).norm();
        }
        for _ in 0..20 {
            let lent: Vec<c64> = self
                .values(&model)
                .iter()
                .zip(data)
                .map(|(m, d)| {
                    if m.norm() > 0.0 {
                        m * (d.re / m.norm())
                    } else {
                        *d
                    }
                })
                .collect();
            model = self.projected(poles, remainder, &lent)?;
        }
        Ok(model)
    }

    /// The model of given poles that is nearest to complex `data`.
    fn projected(
        &self,
        poles: &[Pole],
        remainder: usize,
        data: &[c64],
    ) -> Result<ModalModel, SignalError> {
        let columns = 2 * poles.len() + remainder;
        let count = self.weights.len();
        let mut matrix = Mat::<f64>::zeros(2 * count, columns + 1);
        self.lines.fill_linear(poles, remainder, 0, &mut matrix);
        for (i, (z, w)) in data.iter().zip(&self.weights).enumerate() {
            matrix[(i, columns)] = z.re * w;
            matrix[(count + i, columns)] = z.im * w;
        }
        let (normal, right) = gram(&matrix);
        let x = damped_step(&normal, &right, 0.0)?;
        Ok(ModalModel {
            quantity: self.response.quantity(),
            poles: poles.to_vec(),
            numerators: (0..poles.len()).map(|k| [x[2 * k], x[2 * k + 1]]).collect(),
            remainder: (2 * poles.len()..columns).map(|k| x[k]).collect(),
            reference_hz: self.lines.reference_hz(),
        })
    }

    /// Normal matrix and gradient over poles, numerators and remainder.
    fn normal_equations(&self, model: &ModalModel) -> (DMatrix<f64>, DVector<f64>) {
        let (poles, remainder) = (&model.poles, model.remainder.len());
        let columns = 4 * poles.len() + remainder;
        let count = self.weights.len();
        let mut matrix = Mat::<f64>::zeros(2 * count, columns + 1);
        self.lines.fill_pole_derivatives(model, &mut matrix);
        self.lines
            .fill_linear(poles, remainder, 2 * poles.len(), &mut matrix);
        let values = self.values(model);
        if !self.response.has_phase() {
            turn_to(&values, &mut matrix);
        }
        for (i, r) in self.weighted_residuals(&values).iter().enumerate() {
            matrix[(i, columns)] = r.re;
            matrix[(count + i, columns)] = r.im;
        }
        gram(&matrix)
    }

    /// The model after a step of its parameters.
    fn moved(
        &self,
        model: &ModalModel,
        step: &DVector<f64>,
        remainder: usize,
    ) -> Result<ModalModel, SignalError> {
        let count = model.poles.len();
        let poles: Vec<Pole> = model
            .poles
            .iter()
            .enumerate()
            .map(|(k, p)| Pole {
                frequency_hz: p.frequency_hz * step[2 * k].clamp(-0.05, 0.05).exp(),
                damping_factor: (p.damping_factor * step[2 * k + 1].clamp(-1.0, 1.0).exp())
                    .clamp(1e-7, 0.9),
            })
            .collect();
        if self.response.has_phase() {
            return self.projected(&poles, remainder, self.response.values());
        }
        let mut moved = model.clone();
        moved.poles = poles;
        for (k, ab) in moved.numerators.iter_mut().enumerate() {
            ab[0] += step[2 * count + 2 * k];
            ab[1] += step[2 * count + 2 * k + 1];
        }
        for (m, c) in moved.remainder.iter_mut().enumerate() {
            *c += step[4 * count + m];
        }
        Ok(moved)
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

/// Normal matrix `A^T A` and right side `A^T b` of `[A b]`, on one thread so that the bytes do not
/// depend on their number.
fn gram(matrix: &Mat<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let n = matrix.ncols();
    let mut out = Mat::<f64>::zeros(n, n);
    triangular::matmul(
        out.as_mut(),
        BlockStructure::TriangularLower,
        Accum::Replace,
        matrix.transpose(),
        BlockStructure::Rectangular,
        matrix.as_ref(),
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
    let normal = DMatrix::from_fn(n - 1, n - 1, |i, j| out[(i.max(j), i.min(j))]);
    let right = DVector::from_fn(n - 1, |i, _| out[(n - 1, i)]);
    (normal, right)
}

/// Column scales that give the normal matrix a unit diagonal.
fn scales(normal: &DMatrix<f64>) -> DVector<f64> {
    normal
        .diagonal()
        .map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 1.0 })
}

/// Cholesky factor of the equilibrated matrix with `damping` on its diagonal, raised until it exists.
fn factor(
    normal: &DMatrix<f64>,
    scale: &DVector<f64>,
    damping: f64,
) -> Result<nalgebra::Cholesky<f64, nalgebra::Dyn>, SignalError> {
    let n = normal.nrows();
    let mut ridge = damping.max(1e-14);
    while ridge < 1e-2 + 10.0 * damping {
        let scaled = DMatrix::from_fn(n, n, |i, j| {
            let value = normal[(i, j)] * scale[i] * scale[j];
            if i == j { value + ridge } else { value }
        });
        if let Some(factor) = scaled.cholesky() {
            return Ok(factor);
        }
        ridge *= 100.0;
    }
    Err(SignalError::Fit {
        reason: "the normal equations are singular; restrict the frequency range",
    })
}

fn damped_step(
    normal: &DMatrix<f64>,
    gradient: &DVector<f64>,
    damping: f64,
) -> Result<DVector<f64>, SignalError> {
    let scale = scales(normal);
    let right = gradient.component_mul(&scale);
    let step = factor(normal, &scale, damping)?.solve(&right);
    Ok(step.component_mul(&scale))
}

fn inverse(normal: &DMatrix<f64>) -> Result<DMatrix<f64>, SignalError> {
    let scale = scales(normal);
    let inner = factor(normal, &scale, 0.0)?.inverse();
    let n = normal.nrows();
    Ok(DMatrix::from_fn(n, n, |i, j| {
        inner[(i, j)] * scale[i] * scale[j]
    }))
}
