//! Orthotropic linear elasticity: nine constants along three axes that lie fixed in space or about an axis of revolution.

use nalgebra::{Matrix3, Vector3};

/// Elasticity matrix over `(xx, yy, zz, xy, yz, zx)` with engineering shear strains, Pa.
pub type Elasticity = [[f64; 6]; 6];

/// The pairs of axes `(xx, yy, zz, xy, yz, zx)`.
pub(super) const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// Axes 1, 2 and 3 of an orthotropic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MaterialAxes {
    /// The same everywhere: unit vectors as columns.
    Fixed(Matrix3<f64>),
    /// Radial, circumferential and axial about an axis.
    Cylindrical {
        /// Unit vector along the axis.
        axis: [f64; 3],
        /// A point of the axis, m.
        center: [f64; 3],
    },
}

/// The direction across an axis nearest to that of x, y and z with the smallest share along it.
pub fn beside(axis: &Vector3<f64>) -> Vector3<f64> {
    let own = Vector3::ith(axis.iamin(), 1.0);
    (own - axis * axis.dot(&own)).normalize()
}

impl MaterialAxes {
    /// Along x, y and z.
    pub fn global() -> Self {
        Self::Fixed(Matrix3::identity())
    }

    /// Axis 1 along `first`, axis 2 in the plane of both on the side of `second`, axis 3 across them; `None` for vectors
    /// that are parallel to 1e-6, or zero.
    pub fn along(first: [f64; 3], second: [f64; 3]) -> Option<Self> {
        let [first, second] = [first, second].map(Vector3::from);
        let one = first.try_normalize(0.0)?;
        let rest = second - one * one.dot(&second);
        if rest.norm() <= 1e-6 * second.norm() {
            return None;
        }
        let two = rest.try_normalize(0.0)?;
        Some(Self::Fixed(Matrix3::from_columns(&[one, two, one.cross(&two)])))
    }

    /// The axes at a place, unit vectors as columns. On the axis of revolution, where no direction is radial, any pair is taken.
    pub fn at(&self, place: [f64; 3]) -> Matrix3<f64> {
        match self {
            Self::Fixed(axes) => *axes,
            Self::Cylindrical { axis, center } => {
                let axis = Vector3::from(*axis);
                let offset = Vector3::from(place) - Vector3::from(*center);
                let across = offset - axis * axis.dot(&offset);
                let radial = across.try_normalize(0.0).unwrap_or_else(|| beside(&axis));
                Matrix3::from_columns(&[radial, axis.cross(&radial), axis])
            }
        }
    }
}

/// The nine constants of an orthotropic material and where its axes lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orthotropy {
    /// `E_1`, `E_2`, `E_3`, Pa.
    pub young_moduli: [f64; 3],
    /// `nu_12`, `nu_13`, `nu_23`: `nu_ij` is the contraction along `j` under a stress along `i`.
    pub poisson_ratios: [f64; 3],
    /// `G_12`, `G_13`, `G_23`, Pa.
    pub shear_moduli: [f64; 3],
    /// The axes 1, 2, 3.
    pub axes: MaterialAxes,
}

/// A constant that leaves the strain energy of some strain negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indefinite {
    /// Its place among `nu_12`, `nu_13`, `nu_23`.
    pub which: usize,
    /// What it must lie strictly between, the other constants given.
    pub bounds: [f64; 2],
}

/// Names of the three ratios.
pub const RATIOS: [&str; 3] = ["nu_12", "nu_13", "nu_23"];

impl Orthotropy {
    /// Checks that every strain has positive energy. The moduli must be positive.
    ///
    /// The compliances `S_ij = -nu_ij / E_i`, scaled to a unit diagonal, are `-r_ij` with `r_ij = nu_ij sqrt(E_j / E_i)`; they are positive
    /// definite where `|r_ij| < 1` and `-r_12 r_13 - w < r_23 < -r_12 r_13 + w`, `w^2 = (1 - r_12^2)(1 - r_13^2)`.
    ///
    /// # Errors
    /// The ratio that breaks it, the last of the three where each is possible but not all together.
    pub fn check(&self) -> Result<(), Indefinite> {
        let e = &self.young_moduli;
        let scale = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| (e[i] / e[j]).sqrt());
        for (which, (ratio, scale)) in self.poisson_ratios.iter().zip(scale).enumerate() {
            if ratio.abs() >= scale {
                let bounds = [-scale, scale];
                return Err(Indefinite { which, bounds });
            }
        }
        let r: [f64; 3] = std::array::from_fn(|k| self.poisson_ratios[k] / scale[k]);
        let (middle, width) = (-r[0] * r[1], ((1.0 - r[0] * r[0]) * (1.0 - r[1] * r[1])).sqrt());
        if (r[2] - middle).abs() >= width {
            let bounds = [middle - width, middle + width].map(|end| end * scale[2]);
            return Err(Indefinite { which: 2, bounds });
        }
        Ok(())
    }

    /// Elasticity over its own axes, the inverse of the compliance; zero where [`Self::check`] fails.
    pub fn own_elasticity(&self) -> Elasticity {
        let (e, nu) = (&self.young_moduli, &self.poisson_ratios);
        let [s12, s13, s23] = [-nu[0] / e[0], -nu[1] / e[0], -nu[2] / e[1]];
        #[rustfmt::skip]
        let compliance = Matrix3::new(
            1.0 / e[0], s12, s13,
            s12, 1.0 / e[1], s23,
            s13, s23, 1.0 / e[2],
        );
        let Some(factor) = compliance.cholesky() else {
            return [[0.0; 6]; 6];
        };
        let normal = factor.inverse();
        let mut law = [[0.0; 6]; 6];
        for i in 0..3 {
            (0..3).for_each(|j| law[i][j] = normal[(i.max(j), i.min(j))]);
        }
        // Shears in the order 12, 23, 31.
        let [g12, g13, g23] = self.shear_moduli;
        (law[3][3], law[4][4], law[5][5]) = (g12, g23, g13);
        law
    }

    /// Elasticity over global axes at a place.
    pub fn elasticity_at(&self, place: [f64; 3]) -> Elasticity {
        turned(&self.own_elasticity(), &self.axes.at(place))
    }

    /// Whether a rotation of the body about z leaves the material what it is, to 1e-9: cylindrical axes about z, or fixed ones
    /// along z with the same constants in every direction across.
    pub fn is_invariant_about_z(&self) -> bool {
        match self.axes {
            MaterialAxes::Cylindrical { axis, center } => {
                axis[0].hypot(axis[1]) <= 1e-9 && center[0] == 0.0 && center[1] == 0.0
            }
            MaterialAxes::Fixed(_) => {
                let law = self.elasticity_at([0.0; 3]);
                // Harmonics up to 4 of the angle: one that is no fraction of a turn tells.
                let (sin, cos) = 1.0f64.sin_cos();
                let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
                let other = turned(&law, &turn);
                let size = law.iter().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
                let pairs = law.iter().flatten().zip(other.iter().flatten());
                pairs.map(|(a, b)| (a - b).abs()).all(|difference| difference <= 1e-9 * size)
            }
        }
    }

    /// Whether the plane across z is one of symmetry everywhere, to 1e-9, so that motions in it cause none across.
    pub fn is_symmetric_across_z(&self) -> bool {
        let is_along = |cosine: f64| (cosine.abs() - 1.0).abs() <= 1e-9;
        match self.axes {
            MaterialAxes::Cylindrical { axis, .. } => is_along(axis[2]),
            MaterialAxes::Fixed(axes) => axes.row(2).iter().any(|&cosine| is_along(cosine)),
        }
    }

    /// Young's modulus, Pa, and Poisson's ratio of the isotropic material whose elasticity is the mean over all directions
    /// (Voigt): what estimates of cost and of plausible sizes take.
    pub fn mean_constants(&self) -> [f64; 2] {
        let law = self.own_elasticity();
        let trace = law[0][0] + law[1][1] + law[2][2];
        let mixed = law[0][1] + law[0][2] + law[1][2];
        let bulk = (trace + 2.0 * mixed) / 9.0;
        let shear = (trace - mixed) / 15.0 + self.shear_moduli.iter().sum::<f64>() / 5.0;
        [
            9.0 * bulk * shear / (3.0 * bulk + shear),
            (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear)),
        ]
    }
}

/// An elasticity over axes (columns) written over global ones: `D = T^T D' T` with `epsilon' = T epsilon`.
fn turned(law: &Elasticity, axes: &Matrix3<f64>) -> Elasticity {
    // Column k of T: a unit strain k over global axes, seen from the material's.
    let strains = PAIRS.map(|(i, j)| {
        let mut strain = Matrix3::zeros();
        strain[(i, j)] += 0.5;
        strain[(j, i)] += 0.5;
        let own = axes.transpose() * strain * axes;
        PAIRS.map(|(a, b)| own[(a, b)] * if a == b { 1.0 } else { 2.0 })
    });
    let stress = |strain: &[f64; 6]| -> [f64; 6] {
        std::array::from_fn(|row| (0..6).map(|k| law[row][k] * strain[k]).sum())
    };
    let mut global = [[0.0; 6]; 6];
    for (column, strain) in strains.iter().enumerate() {
        let stress = stress(strain);
        for row in 0..=column {
            let work: f64 = (0..6).map(|k| strains[row][k] * stress[k]).sum();
            global[row][column] = work;
            global[column][row] = work;
        }
    }
    global
}
