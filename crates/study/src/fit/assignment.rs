//! The assignment problem: which row has which column.

/// Cost above which a match counts as one that is no number: sums of several would lose the others to round-off.
const LARGEST_COST: f64 = 1e150;

/// The column of each row, all different, at the smallest sum of costs; no more rows than columns. A cost that is no
/// finite number is dearer than all the others together.
///
/// Shortest augmenting paths with potentials: R. Jonker, A. Volgenant, "A shortest augmenting path algorithm for dense
/// and sparse linear assignment problems", Computing 38 (1987) 325.
pub(crate) fn least_cost(costs: &[Vec<f64>]) -> Vec<usize> {
    let columns = costs.first().map_or(0, Vec::len);
    let finite = costs.iter().flatten().copied().filter(|cost| cost.abs() <= LARGEST_COST);
    let dearest = 1.0 + 2.0 * costs.len() as f64 * finite.fold(0.0, |m: f64, c| m.max(c.abs()));
    let cost = |row: usize, column: usize| {
        let own: f64 = costs[row - 1][column - 1];
        if own.abs() <= LARGEST_COST { own } else { dearest }
    };
    // Column 0 stands for "no column yet"; row 0 likewise.
    let (mut row_price, mut column_price) = (vec![0.0; costs.len() + 1], vec![0.0; columns + 1]);
    let mut row_of = vec![0; columns + 1];
    for row in 1..=costs.len() {
        row_of[0] = row;
        let mut last = 0;
        let mut slack = vec![f64::INFINITY; columns + 1];
        let (mut way, mut is_used) = (vec![0; columns + 1], vec![false; columns + 1]);
        while row_of[last] != 0 {
            is_used[last] = true;
            let (own, mut least, mut next) = (row_of[last], f64::INFINITY, 0);
            for column in 1..=columns {
                if is_used[column] {
                    continue;
                }
                let reduced = cost(own, column) - row_price[own] - column_price[column];
                if reduced < slack[column] {
                    (slack[column], way[column]) = (reduced, last);
                }
                if slack[column] < least {
                    (least, next) = (slack[column], column);
                }
            }
            for column in 0..=columns {
                if is_used[column] {
                    row_price[row_of[column]] += least;
                    column_price[column] -= least;
                } else {
                    slack[column] -= least;
                }
            }
            last = next;
        }
        while last != 0 {
            row_of[last] = row_of[way[last]];
            last = way[last];
        }
    }
    let mut column_of = vec![0; costs.len()];
    for column in 1..=columns {
        if row_of[column] > 0 {
            column_of[row_of[column] - 1] = column - 1;
        }
    }
    column_of
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_that_are_no_numbers_are_taken_last() {
        let (no, far) = (f64::NAN, f64::INFINITY);
        assert_eq!(least_cost(&[vec![no, 2.0, 1.0], vec![3.0, far, 1.0]]), [1, 2]);
        let mut all = least_cost(&[vec![no; 2], vec![far; 2]]);
        all.sort_unstable();
        assert_eq!(all, [0, 1]);
    }

    #[test]
    fn the_assignment_is_the_cheapest_of_all_permutations() {
        let mut state = 7u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f64
        };
        for _ in 0..50 {
            let costs: Vec<Vec<f64>> = (0..4).map(|_| (0..6).map(|_| draw()).collect()).collect();
            let found = least_cost(&costs);
            let sum = |columns: &[usize]| -> f64 {
                columns.iter().zip(&costs).map(|(&c, row)| row[c]).sum()
            };
            let mut best = f64::INFINITY;
            for code in 0..6usize.pow(4) {
                let columns: Vec<usize> = (0..4).map(|i| code / 6usize.pow(i) % 6).collect();
                let mut sorted = columns.clone();
                sorted.sort_unstable();
                sorted.dedup();
                if sorted.len() == 4 {
                    best = best.min(sum(&columns));
                }
            }
            assert_eq!(sum(&found), best);
        }
    }
}
