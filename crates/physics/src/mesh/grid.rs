//! Spheres by the cells of a grid that they touch.

use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Spheres, or points, by number.
pub(crate) struct Grid {
    /// Edge of a cell, m.
    pub size: f64,
    /// Those that touch each cell, of cells that any touches.
    pub members: BTreeMap<[i64; 3], Vec<usize>>,
}

impl Grid {
    /// Of spheres with their centers and radii, m.
    pub fn of(size: f64, spheres: impl Iterator<Item = (Vector3<f64>, f64)>) -> Self {
        let mut grid = Self { size, members: BTreeMap::new() };
        for (i, (center, radius)) in spheres.enumerate() {
            for cell in grid.cells(&center, radius) {
                grid.members.entry(cell).or_default().push(i);
            }
        }
        grid
    }

    fn cells(&self, center: &Vector3<f64>, radius: f64) -> Vec<[i64; 3]> {
        let bound = |axis: usize, sign: f64| ((center[axis] + sign * radius) / self.size).floor();
        let range = |axis: usize| bound(axis, -1.0) as i64..=bound(axis, 1.0) as i64;
        let pairs = range(0).flat_map(|i| range(1).map(move |j| [i, j]));
        pairs.flat_map(|[i, j]| range(2).map(move |k| [i, j, k])).collect()
    }

    /// Those that share a cell with a sphere, ascending.
    pub fn near(&self, center: &Vector3<f64>, radius: f64) -> Vec<usize> {
        let cells = self.cells(center, radius);
        let lists = cells.iter().filter_map(|cell| self.members.get(cell));
        let mut found: Vec<usize> = lists.flatten().copied().collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}
