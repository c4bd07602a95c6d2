//! A measured surface: gaps at scattered points, between which they are interpolated.

use super::PairError;
use super::surface::SurfacePair;
use crate::mesh::Grid;
use nalgebra::{Matrix3, Vector3};

/// Share of a surface's size within which a contact point needs a measured one.
const REACH: f64 = 0.1;
/// Measured points taken of each quadrant around a contact point.
const IN_QUADRANT: usize = 3;
/// Determinant of the moments over their sum of weights below which points lie on a line and give no slope.
const FLAT: f64 = 1e-6;
/// Part of the farthest point's distance at which a measured point is the contact point.
const SAME_PLACE: f64 = 1e-9;
/// Points in a cell on average up to which a grid is fine enough, and grids at most.
const IN_CELL: usize = 8;
const MOST_GRIDS: usize = 16;

/// Gaps that add to those of a mesh: positive where material is missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Topography {
    /// The file that it was read from.
    file: String,
    /// Where it was measured, m, and the gap there, m.
    points: Vec<([f64; 3], f64)>,
}

impl Topography {
    /// From the points of a file: place and gap, m.
    pub fn new(file: &str, points: Vec<([f64; 3], f64)>) -> Self {
        Self { file: file.to_owned(), points }
    }

    /// Adds the measured gap to that of each point of a pair.
    pub(super) fn widen(&self, pair: &mut SurfacePair, surface: &str) -> Result<(), PairError> {
        let reach = pair.reach.max(REACH * pair.area.sqrt());
        let grids = self.grids(reach);
        for point in pair.points.iter_mut().map(|point| &mut point.at) {
            let (position, normal) = (point.position.into(), Vector3::from(point.normal));
            let first = Vector3::ith(normal.iamin(), 1.0);
            let first = (first - normal * normal.dot(&first)).normalize();
            let axes = [first, normal.cross(&first)];
            let chosen = self.around(&grids, &position, &axes);
            if chosen.is_empty() {
                let away = |(place, _): &([f64; 3], f64)| (Vector3::from(*place) - position).norm();
                let nearest = self.points.iter().map(away).fold(f64::INFINITY, f64::min);
                let ([x, y, z], file) = (point.position, &self.file);
                return Err(PairError(format!(
                    "no measured point of {file} lies within {reach:.3e} m of ({x:.6}, {y:.6}, {z:.6}) m on surface \"{surface}\". The \
                     nearest is {nearest:.3e} m away. Give x, y, z in metres, in the coordinates of the mesh, and points over the whole \
                     surface"
                )));
            }
            point.gap += self.fitted(&chosen, &position, &axes);
        }
        Ok(())
    }

    /// Grids of the measured points, the finest first: the coarsest has cells of `reach`, the finest few points in each.
    fn grids(&self, reach: f64) -> Vec<Grid> {
        let points = self.points.iter().map(|(place, _)| (Vector3::from(*place), 0.0));
        let mut grids = vec![Grid::of(reach, points.clone())];
        while let Some(last) = grids.last()
            && self.points.len() > IN_CELL * last.members.len()
            && grids.len() < MOST_GRIDS
        {
            grids.push(Grid::of(0.5 * last.size, points.clone()));
        }
        grids.reverse();
        grids
    }

    /// The nearest three points of each quadrant around a place, so that scan lines far from each other are still joined; fewer
    /// where the coarsest grid has no more.
    fn around(
        &self,
        grids: &[Grid],
        position: &Vector3<f64>,
        axes: &[Vector3<f64>; 2],
    ) -> Vec<usize> {
        let mut chosen = Vec::new();
        for grid in grids {
            let mut quadrants: [Vec<(f64, usize)>; 4] = Default::default();
            for i in grid.near(position, grid.size) {
                let arm = Vector3::from(self.points[i].0) - position;
                if arm.norm() <= grid.size {
                    let [along, across] = axes.map(|axis| usize::from(arm.dot(&axis) < 0.0));
                    quadrants[2 * along + across].push((arm.norm(), i));
                }
            }
            for quadrant in &mut quadrants {
                quadrant.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                quadrant.truncate(IN_QUADRANT);
            }
            chosen = quadrants.concat();
            if chosen.len() == 4 * IN_QUADRANT {
                break;
            }
        }
        chosen.into_iter().map(|(_, i)| i).collect()
    }

    /// The gap at a place by moving least squares over measured points around it,
    ///
    /// ```text
    /// min over (a, b, c) of sum_i w_i (a + b xi_i + c eta_i - g_i)^2,   w_i = 1 / |x_i - x|^2,   gap = a
    /// ```
    ///
    /// with `(xi, eta)` along the surface: a plane of gaps is exact, and a measured point keeps its own. Where all lie on one line
    /// `a` is the weighted mean.
    fn fitted(&self, chosen: &[usize], position: &Vector3<f64>, axes: &[Vector3<f64>; 2]) -> f64 {
        let arm = |i: usize| Vector3::from(self.points[i].0) - position;
        let size = chosen.iter().map(|&i| arm(i).norm()).fold(0.0, f64::max);
        let (mut moments, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for &i in chosen {
            let gap = self.points[i].1;
            let arm = arm(i) / size.max(f64::MIN_POSITIVE);
            if arm.norm() <= SAME_PLACE {
                return gap;
            }
            let basis = Vector3::new(1.0, arm.dot(&axes[0]), arm.dot(&axes[1]));
            let weight = arm.norm_squared().recip();
            moments += basis * basis.transpose() * weight;
            right += basis * (weight * gap);
        }
        let total = moments[(0, 0)];
        let is_flat = moments.determinant() < FLAT * total;
        let factors = moments.cholesky().filter(|_| !is_flat);
        factors.map_or(right[0] / total, |factors| factors.solve(&right)[0])
    }
}
