//! Linear systems of operators near the identity.

use super::dense::{add, difference, dot, orthogonalize};

/// Directions that are kept before the iteration begins anew.
const MOST_DIRECTIONS: usize = 100;

/// Solves `A x = b` from the start `x` by the generalized minimal residual method (Saad and Schultz 1986), until the residual
/// is below `tolerance` of `b` or does not fall any more; returns the number of products with `A` and the residual reached
/// over `b`.
pub fn gmres(
    mut apply: impl FnMut(&[f64]) -> Vec<f64>,
    right_side: &[f64],
    x: &mut [f64],
    tolerance: f64,
) -> (usize, f64) {
    let norm = |v: &[f64]| dot(v, v).sqrt();
    let size = norm(right_side);
    let mut products = 0;
    let mut last = f64::INFINITY;
    loop {
        // The true residual, not that of the recurrence, decides.
        let image = apply(x);
        products += 1;
        let mut residual = difference(right_side, &image);
        let left = norm(&residual);
        // A residual that does not fall to a tenth has reached round-off.
        if left <= tolerance * size || !(left < 0.1 * last) {
            return (products, left.min(last) / size.max(f64::MIN_POSITIVE));
        }
        last = left;
        residual.iter_mut().for_each(|r| *r /= left);
        let mut basis = vec![residual];
        // Columns of the Hessenberg matrix, made triangular by rotations as they come.
        let mut triangle: Vec<Vec<f64>> = Vec::new();
        let mut rotations: Vec<[f64; 2]> = Vec::new();
        let mut reduced = vec![left];
        for k in 0..MOST_DIRECTIONS {
            let mut direction = apply(&basis[k]);
            products += 1;
            let mut column = orthogonalize(&mut direction, &basis);
            let length = norm(&direction);
            for (i, [c, s]) in rotations.iter().enumerate() {
                let (upper, lower) = (column[i], column[i + 1]);
                column[i] = c * upper + s * lower;
                column[i + 1] = c * lower - s * upper;
            }
            let turned = column[k].hypot(length);
            let rotation = [column[k] / turned, length / turned];
            column[k] = turned;
            reduced.push(-rotation[1] * reduced[k]);
            reduced[k] *= rotation[0];
            rotations.push(rotation);
            triangle.push(column);
            if reduced[k + 1].abs() <= 0.1 * tolerance * size || length <= 1e-14 * turned {
                break;
            }
            direction.iter_mut().for_each(|d| *d /= length);
            basis.push(direction);
        }
        // Back substitution.
        let count = triangle.len();
        let mut shares = reduced[..count].to_vec();
        for k in (0..count).rev() {
            shares[k] /= triangle[k][k];
            for i in 0..k {
                shares[i] -= triangle[k][i] * shares[k];
            }
        }
        for (direction, share) in basis.iter().zip(&shares) {
            add(x, *share, direction);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Consistency check: the residual of a system that is not symmetric is as small as asked, from any start.
    #[test]
    fn a_system_near_the_identity_is_solved_to_round_off() {
        let count = 60;
        let entry = |i: usize, j: usize| {
            let near = f64::from(u8::from(i == j));
            near + 0.3 * ((3 * i + 7 * j) as f64).sin() / (1.0 + (i as f64 - j as f64).abs())
        };
        let apply = |x: &[f64]| -> Vec<f64> {
            let row = |i: usize| (0..count).map(|j| entry(i, j) * x[j]).sum();
            (0..count).map(row).collect()
        };
        let expected: Vec<f64> = (0..count).map(|i| (i as f64).cos()).collect();
        let right_side = apply(&expected);
        for start in [0.0, 5.0] {
            let mut x = vec![start; count];
            let (products, left) = gmres(apply, &right_side, &mut x, 1e-14);
            assert!(products < 80 && left < 1e-13, "{products}, {left:e}");
            let away = x.iter().zip(&expected).map(|(a, b)| (a - b).abs());
            assert!(away.fold(0.0, f64::max) < 1e-12);
        }
    }
}
