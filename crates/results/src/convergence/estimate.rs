//! Observed order and limit of one quantity over refinements.

/// Smallest order that counts as convergence: below it, halving the error takes a resolution sixteen times
/// as fine, and the limit is mostly extrapolation.
const LOWEST_ORDER: f64 = 0.25;

/// Largest order that is looked for: beyond it the differences say nothing of an order.
const HIGHEST_ORDER: f64 = 20.0;

/// Differences below this fraction of the value are round-off of what computed it.
const ROUND_OFF: f64 = 1e-9;

/// What the values of a quantity say of its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The last two differences have one sign and shrink as those of `value + constant h^order` do.
    Converging {
        /// Observed order.
        order: f64,
        /// Value at `h = 0` by Richardson's extrapolation.
        limit: f64,
    },
    /// The last two differences shrink and change sign: no order can be told from them.
    Oscillating,
    /// The last two values agree to round-off.
    Settled,
    /// The differences do not shrink, or more slowly than order 1/4 does.
    NotConverging,
    /// A value is missing or not finite.
    Missing,
}

impl Verdict {
    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Converging { .. } => "converging",
            Self::Oscillating => "oscillating",
            Self::Settled => "settled",
            Self::NotConverging => "not converging",
            Self::Missing => "missing",
        }
    }
}

/// Reads order and limit from the three finest resolutions.
///
/// `f(h) = f_0 + c h^p` through three points gives `(f_1 - f_2) / (f_2 - f_3) = (h_1^p - h_2^p) / (h_2^p - h_3^p)`,
/// whose right side rises with `p`: there is one order or none. Coarser values play no part. `sizes` fall strictly and
/// are positive; `values` has one entry for each. It does not tell whether the finest three lie in the
/// asymptotic range.
///
/// Source: Roache, "Verification and Validation in Computational Science and Engineering", section 5.
pub fn estimate(sizes: &[f64], values: &[f64]) -> Verdict {
    let (&[.., h1, h2, h3], &[.., f1, f2, f3]) = (sizes, values) else { return Verdict::Missing };
    if !values.iter().all(|value| value.is_finite()) {
        return Verdict::Missing;
    }
    let (coarse, fine) = (f1 - f2, f2 - f3);
    if fine.abs() <= ROUND_OFF * f3.abs() {
        return Verdict::Settled;
    }
    let ratio = coarse / fine;
    if ratio < -1.0 {
        return Verdict::Oscillating;
    }
    // Sizes relative to the coarsest keep the powers within range.
    let (r2, r3) = (h2 / h1, h3 / h1);
    let expected = |p: f64| (1.0 - r2.powf(p)) / (r2.powf(p) - r3.powf(p));
    let (mut low, mut high) = (LOWEST_ORDER, HIGHEST_ORDER);
    if !(ratio > expected(low) && ratio < expected(high)) {
        return Verdict::NotConverging;
    }
    // Sixty halvings reach the last bit.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if expected(middle) < ratio {
            low = middle;
        } else {
            high = middle;
        }
    }
    let order = 0.5 * (low + high);
    let slope = fine / (r2.powf(order) - r3.powf(order));
    Verdict::Converging { order, limit: f3 - slope * r3.powf(order) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_gives_back_its_order_and_limit_for_uneven_refinements() {
        let sizes = [1.0, 0.7, 0.5, 0.2];
        for exact in [0.5, 1.0, 2.0, 4.0] {
            let values = sizes.map(|h: f64| 7.0 - 3.0 * h.powf(exact));
            let Verdict::Converging { order, limit } = estimate(&sizes, &values) else {
                panic!("order {exact}");
            };
            assert!((order / exact - 1.0).abs() < 1e-9, "{order}");
            assert!((limit / 7.0 - 1.0).abs() < 1e-12, "{limit}");
        }
    }

    #[test]
    fn values_without_a_limit_get_none() {
        let sizes = [4.0, 2.0, 1.0];
        let cases = [
            ([1.0, 2.0, 3.0], Verdict::NotConverging),
            ([1.0, 2.0, 1.0], Verdict::NotConverging),
            ([1.0, 2.0, 4.0], Verdict::NotConverging),
            ([1.0, 1.0, 2.0], Verdict::NotConverging),
            ([1.0, 2.0, 1.5], Verdict::Oscillating),
            ([1.0, 2.0, 2.0], Verdict::Settled),
            ([0.0, 0.0, 0.0], Verdict::Settled),
            ([f64::NAN, 2.0, 2.0], Verdict::Missing),
        ];
        for (values, verdict) in cases {
            assert_eq!(estimate(&sizes, &values), verdict, "{values:?}");
        }
        assert_eq!(estimate(&[2.0, 1.0], &[1.0, 2.0]), Verdict::Missing);
    }
}
