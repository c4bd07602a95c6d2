//! Complex vectors of modes in real matrices, for real arithmetic.

use crate::cea::sparse::*;
use crate::linalg::dense::{dot, product};
use std::ops::Range;

/// `w_i^T P x_j` of the left vectors of some modes and the right ones of others, by one product of real matrices.
pub fn forms(lefts: &[ReducedMode], p: &Mat<f64>, rights: &[ReducedMode]) -> Mat<c64> {
    let parts = |modes: &[ReducedMode], of: fn(&ReducedMode) -> &Vec<c64>| {
        side_by_side(p.nrows(), &modes.iter().map(of).collect::<Vec<_>>())
    };
    let image = product(p.as_ref(), parts(rights, |mode| &mode.right).as_ref());
    let all = transpose_product(parts(lefts, |mode| &mode.left).as_ref(), image.as_ref());
    Mat::from_fn(lefts.len(), rights.len(), |i, j| {
        let own = |a: usize, b: usize| all[(2 * i + a, 2 * j + b)];
        c64::new(own(0, 0) - own(1, 1), own(0, 1) + own(1, 0)) // (a + i b)^T (c + i d), nothing conjugated.
    })
}

/// Real and imaginary parts of complex vectors in neighbouring columns, continued by zeros.
pub fn side_by_side<V: AsRef<[c64]>>(rows: usize, vectors: &[V]) -> Mat<f64> {
    Mat::from_fn(rows, 2 * vectors.len(), |i, j| {
        let value = vectors[j / 2].as_ref().get(i);
        value.map_or(0.0, |v| if j % 2 == 0 { v.re } else { v.im })
    })
}

/// The `k`-th of complex vectors [`side_by_side`].
pub fn joined(columns: &Mat<f64>, k: usize) -> Vec<c64> {
    let [re, im] = [2 * k, 2 * k + 1].map(|j| column(columns.as_ref(), j).iter());
    re.zip(im).map(|(&re, &im)| c64::new(re, im)).collect()
}

/// `target += factor source` on one vector: a real column, or two columns of real and imaginary part.
pub fn add_complex_multiple(
    target: &mut Mat<f64>,
    factor: c64,
    source: &Mat<f64>,
    columns: &Range<usize>,
) {
    let j = columns.start;
    let real = column(source.as_ref(), j);
    if columns.len() == 1 {
        column_mut(target, j).iter_mut().zip(real).for_each(|(t, p)| *t += factor.re * p);
        return;
    }
    let imaginary = column(source.as_ref(), j + 1);
    let parts = || real.iter().zip(imaginary);
    let sum = column_mut(target, j).iter_mut().zip(parts());
    sum.for_each(|(t, (p, q))| *t += factor.re * p - factor.im * q);
    let sum = column_mut(target, j + 1).iter_mut().zip(parts());
    sum.for_each(|(t, (p, q))| *t += factor.re * q + factor.im * p);
}

/// Where the vector of a mode is among packed columns.
#[derive(Clone, Debug)]
pub struct PackedEntry {
    /// The eigenvalue `s` it belongs to.
    pub inverse_value: c64,
    /// One column of a real vector; real and imaginary part of a complex one.
    pub columns: Range<usize>,
}

impl PackedEntry {
    /// The vector among the columns, or among what was made of them.
    pub fn vector<'m>(&self, mapped: &'m Mat<f64>) -> PackedVector<'m> {
        let mut parts = self.columns.clone().map(|j| column(mapped.as_ref(), j));
        let real = parts.next().unwrap_or_default();
        PackedVector { real, imaginary: parts.next() }
    }

    /// Its entries.
    pub fn joined(&self, mapped: &Mat<f64>) -> Vec<c64> {
        let own = self.vector(mapped);
        (0..mapped.nrows()).map(|i| own.at(i)).collect()
    }
}

/// Vectors of modes packed in columns for real arithmetic.
pub struct PackedModes {
    /// Their coordinates, or entries.
    pub coordinates: Mat<f64>,
    /// Where each of them is.
    pub entries: Vec<PackedEntry>,
}

impl PackedModes {
    /// Packs the right vectors of `modes`, scaled to unit length.
    pub fn of(modes: &[ReducedMode], dimension: usize) -> Self {
        let unit = |ReducedMode { inverse_value, right, .. }: &ReducedMode| {
            let length = length(right);
            (*inverse_value, right.iter().map(|v| v / length).collect::<Vec<c64>>())
        };
        Self::of_vectors(dimension, modes.iter().map(unit))
    }

    /// Packs vectors, each with the inverse value of its mode: where both are real the problem is.
    pub fn of_vectors<V: AsRef<[c64]>>(
        dimension: usize,
        vectors: impl Iterator<Item = (c64, V)>,
    ) -> Self {
        let (mut entries, mut columns) = (Vec::new(), Vec::<Vec<f64>>::new());
        for (inverse_value, own) in vectors {
            let (first, own) = (columns.len(), own.as_ref());
            columns.push(own.iter().map(|v| v.re).collect());
            if inverse_value.im != 0.0 || own.iter().any(|v| v.im != 0.0) {
                columns.push(own.iter().map(|v| v.im).collect());
            }
            entries.push(PackedEntry { inverse_value, columns: first..columns.len() });
        }
        let coordinates = Mat::from_fn(dimension, columns.len(), |i, j| {
            columns[j].get(i).copied().unwrap_or(0.0)
        });
        Self { coordinates, entries }
    }

    /// The coordinates in groups of about `width` columns, so that vectors over the unknowns need memory for a group only; and where the
    /// vectors are in each.
    pub fn groups(&self, width: usize) -> Vec<(MatRef<'_, f64>, Vec<PackedEntry>)> {
        let mut first = 0;
        let groups = self.entries.chunk_by(|own, next| {
            let is_full = own.columns.end >= first + width;
            if is_full {
                first = next.columns.start;
            }
            !is_full
        });
        let relative = |own: &[PackedEntry]| {
            let (first, end) = (own[0].columns.start, own[own.len() - 1].columns.end);
            let moved = own.iter().map(|PackedEntry { inverse_value, columns }| PackedEntry {
                inverse_value: *inverse_value,
                columns: columns.start - first..columns.end - first, // Places within the group.
            });
            (self.coordinates.get(.., first..end), moved.collect())
        };
        groups.map(relative).collect()
    }
}

/// A complex vector in two real columns, or a real one in one.
#[derive(Clone, Copy)]
pub struct PackedVector<'m> {
    real: &'m [f64],
    imaginary: Option<&'m [f64]>,
}

impl PackedVector<'_> {
    /// Euclidean length.
    pub fn norm(&self) -> f64 {
        let square = |v: &[f64]| dot(v, v);
        (square(self.real) + self.imaginary.map_or(0.0, square)).sqrt()
    }

    /// Largest modulus of an entry.
    pub fn peak(&self) -> f64 {
        let squares = (0..self.real.len()).map(|i| self.at(i).norm_sqr());
        squares.fold(0.0, f64::max).sqrt()
    }

    /// Entry `i`.
    #[inline]
    pub fn at(&self, i: usize) -> c64 {
        c64::new(self.real[i], self.imaginary.map_or(0.0, |q| q[i]))
    }
}
