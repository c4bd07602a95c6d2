//! Vectors on cache-line boundaries.

use std::ops::{Deref, DerefMut};

const LINE: usize = 8;

/// A fixed-length vector of `f64` that starts on a 64-byte boundary, so that no vector load crosses a cache line.
#[derive(Debug)]
pub struct AlignedVector {
    storage: Vec<f64>,
    start: usize,
    length: usize,
}

impl AlignedVector {
    /// All zeros.
    pub fn zeros(length: usize) -> Self {
        let storage = vec![0.0; length + LINE];
        // Alignment is speed only: an allocator that cannot tell gives offset 0.
        let offset = storage.as_ptr().align_offset(LINE * size_of::<f64>());
        let start = if offset < LINE { offset } else { 0 };
        Self { storage, start, length }
    }
}

impl Clone for AlignedVector {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.length);
        copy.copy_from_slice(self);
        copy
    }
}

impl Deref for AlignedVector {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        &self.storage[self.start..self.start + self.length]
    }
}

impl DerefMut for AlignedVector {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.storage[self.start..self.start + self.length]
    }
}

/// The fields that an explicit step carries, in an operator's layout.
#[derive(Clone, Debug)]
pub struct MotionFields {
    /// `u_n`, m.
    pub displacement: AlignedVector,
    /// `v_{n-1/2}`, m/s.
    pub velocity: AlignedVector,
    /// `q_n = M^-1 K u_n`, m/s2.
    pub elastic: AlignedVector,
    /// `z_{n-1/2} = M^-1 K v_{n-1/2}`, m/s3.
    pub elastic_rate: AlignedVector,
}

impl MotionFields {
    /// At rest, each of so many numbers.
    pub fn zeros(length: usize) -> Self {
        let zeros = || AlignedVector::zeros(length);
        Self { displacement: zeros(), velocity: zeros(), elastic: zeros(), elastic_rate: zeros() }
    }
}
