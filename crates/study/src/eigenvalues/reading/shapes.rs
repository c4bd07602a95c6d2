//! Mode shapes of one friction value side by side, and quadratic forms of them.

use crate::*;
use frictionsim_physics::prestress::Kind;
use frictionsim_results::cea::{Coupling, ModeName};

/// Share below which a mode of the lowest friction value is left out of the couplings.
const LEAST_SHARE: f64 = 0.01;

/// The name of a mode with its number at a friction coefficient.
pub(super) fn name_of(
    friction_coefficient: f64,
    (number, mode): (usize, &ComplexMode),
    has_harmonics: bool,
) -> ModeName {
    ModeName {
        friction_coefficient,
        mode: number,
        frequency_hz: mode.frequency_hz(),
        harmonic: mode.diameters(has_harmonics),
        branch: mode.branch,
        direction: has_harmonics.then_some(mode.direction),
    }
}

/// The modes of the lowest friction value in an unstable one by their shares in it, the largest first; small ones are
/// left out.
pub(super) fn couplings(
    mode: ModeName,
    growth_rate: f64,
    shares: impl Iterator<Item = (ModeName, f64)>,
) -> Vec<Coupling> {
    let rows = shares.filter(|own| own.1 >= LEAST_SHARE);
    let rows = rows.map(|(reference, share)| Coupling { mode, growth_rate, reference, share });
    sorted(rows, |own| -own.share)
}

/// `a^T b`.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The shapes of one friction value, real and imaginary part of each in two columns.
pub(super) struct Shapes<'a> {
    /// Friction coefficient.
    pub friction: f64,
    has_harmonics: bool,
    /// Number of each mode by frequency, from 1.
    pub modes: Vec<(usize, &'a ComplexMode)>,
    /// Over all dofs.
    pub columns: Mat<f64>,
}

impl<'a> Shapes<'a> {
    /// Those of the modes that have one and are wanted.
    pub fn of(
        point: &'a FrictionPoint,
        has_harmonics: bool,
        is_wanted: impl Fn(&ComplexMode) -> bool,
    ) -> Self {
        let numbered = point.modes.iter().enumerate();
        let modes: Vec<(usize, &ComplexMode)> = numbered
            .filter(|(_, mode)| mode.shape.is_some() && is_wanted(mode))
            .map(|(index, mode)| (index + 1, mode))
            .collect();
        let shape = |column: usize| modes[column / 2].1.shape.as_deref().unwrap_or_default();
        let rows = modes.first().map_or(0, |_| shape(0).len());
        let columns = Mat::from_fn(rows, 2 * modes.len(), |row, column| {
            let value = shape(column)[row];
            if column % 2 == 0 { value.re } else { value.im }
        });
        Self { friction: point.friction_coefficient, has_harmonics, modes, columns }
    }

    /// The name of a mode.
    pub fn name(&self, i: usize) -> ModeName {
        name_of(self.friction, self.modes[i], self.has_harmonics)
    }

    /// `phi^H A phi` of each mode, from the product of a symmetric `A` with the columns.
    pub fn forms(&self, image: &Mat<f64>) -> Vec<f64> {
        let product =
            |column: usize| dot(self.columns.col_as_slice(column), image.col_as_slice(column));
        (0..self.modes.len()).map(|i| product(2 * i) + product(2 * i + 1)).collect()
    }

    /// `phi^H A phi` of each mode for a matrix of some kind: `i g` of a skew one, real of all others.
    pub fn forms_of(&self, kind: Kind, image: &Mat<f64>) -> Vec<c64> {
        if kind != Kind::Gyroscopic {
            return self.forms(image).into_iter().map(c64::from).collect();
        }
        let product = |left: usize, right: usize| {
            dot(self.columns.col_as_slice(left), image.col_as_slice(right))
        };
        let form = |i: usize| product(2 * i, 2 * i + 1) - product(2 * i + 1, 2 * i);
        (0..self.modes.len()).map(|i| c64::new(0.0, form(i))).collect()
    }

    /// A mode over all dofs.
    pub fn column(&self, i: usize) -> Vec<c64> {
        let [re, im] = [2 * i, 2 * i + 1].map(|column| self.columns.col_as_slice(column));
        re.iter().zip(im).map(|(&re, &im)| c64::new(re, im)).collect()
    }

    /// Adds `factor A phi` of each mode to its balance.
    pub fn add(&self, balance: &mut [Vec<c64>], image: &Mat<f64>, factor: impl Fn(c64) -> c64) {
        for (i, ((_, mode), sum)) in self.modes.iter().zip(balance).enumerate() {
            let factor = factor(mode.eigenvalue);
            let (re, im) = (image.col_as_slice(2 * i), image.col_as_slice(2 * i + 1));
            for (sum, (re, im)) in sum.iter_mut().zip(re.iter().zip(im)) {
                *sum += factor * c64::new(*re, *im);
            }
        }
    }

    /// Shares of the reference modes in every unstable mode, the largest first: `|phi_ref^H M phi|^2` over the product
    /// of both modes' `phi^H M phi`, with `M phi` of these shapes and of the references.
    pub fn couplings(
        &self,
        own_images: &Mat<f64>,
        (references, images): (&Shapes<'_>, &Mat<f64>),
    ) -> Vec<Coupling> {
        let (own, of_references) = (self.forms(own_images), references.forms(images));
        let mut all = Vec::new();
        let modes = self.modes.iter().enumerate();
        for (i, (_, mode)) in modes.filter(|(_, (_, mode))| mode.is_unstable()) {
            let phi = [2 * i, 2 * i + 1].map(|column| self.columns.col_as_slice(column));
            let shares = (0..references.modes.len()).map(|j| {
                let image = [2 * j, 2 * j + 1].map(|column| images.col_as_slice(column));
                let re = dot(image[0], phi[0]) + dot(image[1], phi[1]);
                let im = dot(image[0], phi[1]) - dot(image[1], phi[0]);
                (references.name(j), (re * re + im * im) / (own[i] * of_references[j]))
            });
            all.extend(couplings(self.name(i), mode.growth_rate(), shares));
        }
        all
    }
}
