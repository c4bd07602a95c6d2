//! Modes as a run that goes on later finds them.

use crate::cea::sparse::mode::ReducedMode;
use crate::linalg::c64;

/// Modes as columns of numbers, bit by bit.
pub fn to_columns(modes: &[ReducedMode]) -> Vec<Vec<f64>> {
    let flat = |values: &[c64]| values.iter().flat_map(|v| [v.re, v.im]).collect::<Vec<f64>>();
    let columns = modes.iter().flat_map(|mode| {
        let scalars = [mode.eigenvalue, mode.inverse_value, mode.derivative];
        [flat(&scalars), flat(&mode.right), flat(&mode.left)]
    });
    columns.collect()
}

/// The modes that became these columns; nothing of columns that are no modes.
pub fn from_columns(columns: &[Vec<f64>]) -> Option<Vec<ReducedMode>> {
    let paired = |column: &Vec<f64>| -> Option<Vec<c64>> {
        let (pairs, rest) = column.as_chunks::<2>();
        let whole = pairs.iter().map(|[re, im]| c64::new(*re, *im)).collect();
        rest.is_empty().then_some(whole)
    };
    let (modes, rest) = columns.as_chunks::<3>();
    let mode = |[scalars, right, left]: &[Vec<f64>; 3]| {
        let [eigenvalue, inverse_value, derivative] = paired(scalars)?[..] else {
            return None;
        };
        let (right, left) = (paired(right)?, paired(left)?);
        Some(ReducedMode { eigenvalue, inverse_value, derivative, right, left })
    };
    modes.iter().map(mode).collect::<Option<_>>().filter(|_| rest.is_empty())
}
