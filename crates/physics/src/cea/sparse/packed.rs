//! Complex vectors of modes in real matrices, for real arithmetic.

use super::mode::ReducedMode;
use crate::linalg::dense::{column, column_mut, dot, product, transpose_product};
use crate::linalg::vectors::length;
use crate::linalg::{Mat, c64};
use std::ops::Range;

/// `w_i^T P x_j` of the left vectors of some modes and the right ones of others, by one product of real matrices.
pub fn forms(lefts: &[ReducedMode], p: &Mat<f64>, rights: &[ReducedMode]) -> Mat<c64> {
    // Real parts of all, then imaginary ones; coordinates go on with zeros.
    let parts = |modes: &[ReducedMode], of: fn(&ReducedMode) -> &Vec<c64>| {
        let count = modes.len();
        Mat::from_fn(p.nrows(), 2 * count, |i, j| {
            let value = of(&modes[j % count]).get(i);
            value.map_or(0.0, |v| if j < count { v.re } else { v.im })
        })
    };
    let image = product(p.as_ref(), parts(rights, |mode| &mode.right).as_ref());
    let all = transpose_product(parts(lefts, |mode| &mode.left).as_ref(), image.as_ref());
    let (a, b) = (lefts.len(), rights.len());
    Mat::from_fn(a, b, |i, j| {
        c64::new(all[(i, j)] - all[(a + i, b + j)], all[(i, b + j)] + all[(a + i, j)])
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
    columns: Range<usize>,
) {
    let j = columns.start;
    let real = column(source.as_ref(), j);
    if columns.len() == 1 {
        let sum = column_mut(target, j).iter_mut().zip(real);
        sum.for_each(|(t, p)| *t += factor.re * p);
        return;
    }
    let imaginary = column(source.as_ref(), j + 1);
    let parts = || real.iter().zip(imaginary);
    let sum = column_mut(target, j).iter_mut().zip(parts());
    sum.for_each(|(t, (p, q))| *t += factor.re * p - factor.im * q);
    let sum = column_mut(target, j + 1).iter_mut().zip(parts());
    sum.for_each(|(t, (p, q))| *t += factor.re * q + factor.im * p);
}

/// Where a vector is among packed columns.
#[derive(Clone, Copy, Debug)]
pub struct PackedEntry {
    /// The eigenvalue `s` it belongs to.
    pub inverse_value: c64,
    /// Its first column, the real part.
    pub column: usize,
    /// Whether the next column is its imaginary part.
    pub is_complex: bool,
}

impl PackedEntry {
    /// Its columns.
    pub fn columns(&self) -> Range<usize> {
        self.column..self.column + 1 + usize::from(self.is_complex)
    }
}

/// Neighbouring packed columns that are worked on together.
pub struct PackedGroup {
    /// Their range among all packed columns.
    pub columns: Range<usize>,
    /// Their entries, columns counted from the first of the group.
    pub entries: Vec<PackedEntry>,
    /// The modes, stored or conjugate, whose vectors they hold.
    pub modes: Vec<usize>,
}

/// Real and imaginary parts of right vectors, packed for real arithmetic.
///
/// Of two modes with conjugate `s` only the first is stored: the other's vector is its conjugate.
pub struct PackedModes {
    /// Coordinates, of unit length; one column for a real vector, two for a complex one.
    pub coordinates: Mat<f64>,
    /// The stored vectors.
    pub entries: Vec<PackedEntry>,
    /// For each mode its entry, and whether it is the conjugate of it.
    places: Vec<(usize, bool)>,
}

impl PackedModes {
    /// Packs the right vectors of `modes`.
    pub fn of(modes: &[ReducedMode], dimension: usize) -> Self {
        let mut entries: Vec<PackedEntry> = Vec::new();
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let mut places = Vec::new();
        for mode in modes {
            let s = mode.inverse_value;
            let twin = entries.iter().position(|e| s.im != 0.0 && e.inverse_value == s.conj());
            if let Some(entry) = twin {
                places.push((entry, true));
                continue;
            }
            let vector = &mode.right;
            let length = length(vector);
            places.push((entries.len(), false));
            let is_complex = vector.iter().any(|v| v.im != 0.0);
            entries.push(PackedEntry { inverse_value: s, column: columns.len(), is_complex });
            columns.push(vector.iter().map(|v| v.re / length).collect());
            if is_complex {
                columns.push(vector.iter().map(|v| v.im / length).collect());
            }
        }
        let coordinates = Mat::from_fn(dimension, columns.len(), |i, j| {
            columns[j].get(i).copied().unwrap_or(0.0)
        });
        Self { coordinates, entries, places }
    }

    /// All columns in groups of about `width`, so that vectors over the unknowns need memory for a group only.
    pub fn groups(&self, width: usize) -> Vec<PackedGroup> {
        let mut groups: Vec<PackedGroup> = Vec::new();
        for (index, entry) in self.entries.iter().enumerate() {
            if groups.last().is_none_or(|g| g.columns.len() >= width) {
                groups.push(PackedGroup {
                    columns: entry.column..entry.column,
                    entries: Vec::new(),
                    modes: Vec::new(),
                });
            }
            let group = groups.last_mut().expect("one was added");
            group.columns.end = entry.columns().end;
            group
                .entries
                .push(PackedEntry { column: entry.column - group.columns.start, ..*entry });
            let modes = (0..self.places.len()).filter(|&mode| self.places[mode].0 == index);
            group.modes.extend(modes);
        }
        groups
    }

    /// A mode's complex vector among the expanded (or otherwise mapped) columns of its group.
    pub fn vector<'m>(
        &self,
        mode: usize,
        group: &PackedGroup,
        mapped: &'m Mat<f64>,
    ) -> PackedVector<'m> {
        let (entry, is_conjugate) = self.places[mode];
        let entry = self.entries[entry];
        let real = entry.column - group.columns.start;
        let imaginary = real + 1;
        PackedVector {
            real: column(mapped.as_ref(), real),
            imaginary: entry.is_complex.then(|| column(mapped.as_ref(), imaginary)),
            sign: if is_conjugate { -1.0 } else { 1.0 },
        }
    }
}

/// A complex vector in two real columns.
#[derive(Clone, Copy)]
pub struct PackedVector<'m> {
    real: &'m [f64],
    imaginary: Option<&'m [f64]>,
    sign: f64,
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
        c64::new(self.real[i], self.imaginary.map_or(0.0, |q| self.sign * q[i]))
    }
}
