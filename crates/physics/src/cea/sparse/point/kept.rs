//! A solved point as a run that goes on later finds it.

use super::{ModeCheck, SolvedPoint};
use crate::cea::sparse::mode::ReducedMode;
use crate::linalg::c64;

impl SolvedPoint {
    /// The point as columns of numbers, bit by bit.
    pub fn to_columns(&self) -> Vec<Vec<f64>> {
        let pair = |v: &c64| [v.re, v.im];
        let flat = |values: &[c64]| values.iter().flat_map(pair).collect::<Vec<f64>>();
        let counts = [self.wanted, self.modes.len()].map(|count| count as f64);
        let mut columns = vec![[counts.as_slice(), &[self.range_end]].concat()];
        for mode in &self.modes {
            let scalars = [mode.eigenvalue, mode.inverse_value, mode.derivative];
            columns.extend([flat(&scalars), flat(&mode.right), flat(&mode.left)]);
        }
        for check in &self.checks {
            let scalars = [
                check.residual,
                check.force_residual,
                check.uncertainty,
                check.contact_share,
                check.peak,
            ];
            columns.extend([scalars.to_vec(), flat(&check.edge)]);
        }
        columns
    }

    /// The point at `mu` that became these columns; nothing of columns that are no point.
    pub fn from_columns(mu: f64, columns: &[Vec<f64>]) -> Option<Self> {
        let paired = |column: &Vec<f64>| -> Option<Vec<c64>> {
            let (pairs, rest) = column.as_chunks::<2>();
            let whole = pairs.iter().map(|[re, im]| c64::new(*re, *im)).collect();
            rest.is_empty().then_some(whole)
        };
        let (first, rest) = columns.split_first()?;
        let [wanted, count, range_end] = first[..] else {
            return None;
        };
        let (modes, checks) = rest.split_at_checked(3 * count as usize)?;
        let mode = |own: &[Vec<f64>]| {
            let [eigenvalue, inverse_value, derivative] = paired(&own[0])?[..] else {
                return None;
            };
            Some(ReducedMode {
                eigenvalue,
                inverse_value,
                derivative,
                right: paired(&own[1])?,
                left: paired(&own[2])?,
            })
        };
        let check = |own: &[Vec<f64>]| {
            let [residual, force_residual, uncertainty, contact_share, peak] = own[0][..] else {
                return None;
            };
            Some(ModeCheck {
                residual,
                force_residual,
                uncertainty,
                contact_share,
                edge: paired(own.get(1)?)?,
                peak,
            })
        };
        let point = Self {
            friction_coefficient: mu,
            modes: modes.chunks(3).map(mode).collect::<Option<_>>()?,
            wanted: wanted as usize,
            checks: checks.chunks(2).map(check).collect::<Option<_>>()?,
            range_end,
            solved_in: None,
            has_coarse_lefts: true,
        };
        (point.wanted <= point.checks.len()).then_some(point)
    }
}
