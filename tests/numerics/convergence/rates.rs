//! Families of meshes and the rate at which errors fall over them.

use crate::prelude::*;

pub const DISC: Annulus = Annulus {
    inner_radius: 0.0205,
    outer_radius: 0.0905,
    young_modulus: 2.5e9,
    poisson_ratio: 0.3805,
    density: 1228.0,
    plane_strain: true,
};

/// Contact stiffness that fits Table 1, Pa/m.
pub const NORMAL_STIFFNESS: f64 = 7.4e12;

/// `alpha_R` and `beta_R` of the paper.
pub const RAYLEIGH: Rayleigh = (40.0, 4.5e-7);

pub fn coarsest(element: ElementKind) -> (usize, usize) {
    if element.is_quadratic() { (64, 16) } else { (120, 30) }
}

pub const SIZES: [f64; 3] = [1.0, 2.0 / 3.0, 1.0 / 2.0];

/// Three meshes that are images of three uniform ones under one smooth map: the outermost element of
/// each is about four times as long as the innermost, which keeps all of them nearly square.
pub fn refinements(element: ElementKind) -> [AnnulusSpecification; 3] {
    let (sectors, layers) = coarsest(element);
    SIZES.map(|size| {
        let finer = |count: usize| (count as f64 / size).round() as usize;
        let radial_elements = finer(layers);
        let radial_grading = 4.0_f64.powf(1.0 / radial_elements as f64);
        AnnulusSpecification { radial_grading, ..annulus(element, finer(sectors), radial_elements) }
    })
}

/// Slope of the least-squares line through `ln |error|` over `ln` of the mesh size.
pub fn rate(errors: [f64; 3]) -> f64 {
    let x = SIZES.map(f64::ln);
    let y = errors.map(|error| error.abs().ln());
    let mean = |values: [f64; 3]| values.iter().sum::<f64>() / 3.0;
    let (x_mean, y_mean) = (mean(x), mean(y));
    let product = |u: [f64; 3], u_mean: f64| -> f64 {
        x.iter().zip(u).map(|(x, u)| (x - x_mean) * (u - u_mean)).sum()
    };
    product(y, y_mean) / product(x, x_mean)
}

pub fn assert_rate(element: ElementKind, what: &str, errors: [f64; 3]) {
    // In theory twice that of the strains.
    let expected = if element.is_quadratic() { 4.0 } else { 2.0 };
    let slope = rate(errors);
    let said = format!("{element:?} {what}: slope {slope:.3}, errors {errors:.3?}");
    assert!((slope - expected).abs() <= 0.1, "{said}");
}
