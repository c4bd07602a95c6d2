//! A measured surface: gaps at scattered points, between which they are interpolated.

use super::PairError;
use super::surface::SurfacePair;
use crate::fem::beside;
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
            let first = beside(&normal);
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
    /// where the coarsest grid has no more. The nearest of all lies in the middle of a quadrant: the axes of the mesh turn none.
    fn around(
        &self,
        grids: &[Grid],
        position: &Vector3<f64>,
        axes: &[Vector3<f64>; 2],
    ) -> Vec<usize> {
        let mut chosen = Vec::new();
        for grid in grids {
            let near = grid.near(position, grid.size).into_iter();
            let near = near.map(|i| (Vector3::from(self.points[i].0) - position, i));
            let near: Vec<_> = near.filter(|(arm, _)| arm.norm() <= grid.size).collect();
            let nearest = near.iter().map(|own| own.0).min_by(|a, b| a.norm().total_cmp(&b.norm()));
            let [x, y] = axes.map(|axis| nearest.map_or(0.0, |arm| arm.dot(&axis)));
            let halves = [[x - y, x + y], [x + y, y - x]]; // The nearest turned by an eighth to either side.
            let mut quadrants: [Vec<(f64, usize)>; 4] = Default::default();
            for (arm, i) in near {
                let [along, across] = halves
                    .map(|[x, y]| usize::from(x * arm.dot(&axes[0]) + y * arm.dot(&axes[1]) < 0.0));
                quadrants[2 * along + across].push((arm.norm(), i));
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

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn gaps_between_measured_points_do_not_depend_on_the_axes_of_the_mesh() {
        // Scattered places, always the same, and a surface that waves more than they tell.
        let place = |i: u32| {
            [2654435761_u32, 2246822519].map(|k| f64::from(i.wrapping_mul(k)) / f64::from(u32::MAX))
        };
        let points: Vec<_> = (1..=400)
            .map(place)
            .map(|[x, y]| ([x, y, 0.0], (40.0 * x).sin() * (30.0 * y).cos()))
            .collect();
        let axes = [Vector3::x(), Vector3::y()];
        let gaps_turned_by = |angle: f64| -> Vec<f64> {
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
            let turned =
                points.iter().map(|&(place, gap)| ((turn * Vector3::from(place)).into(), gap));
            let own = Topography::new("", turned.collect());
            let at = (401..450).map(|i| turn * Vector3::new(place(i)[0], place(i)[1], 0.0));
            let grids = own.grids(0.3);
            at.map(|at| own.fitted(&own.around(&grids, &at, &axes), &at, &axes)).collect()
        };
        let as_it_lies = gaps_turned_by(0.0);
        for (turned, gap) in gaps_turned_by(0.4).iter().zip(&as_it_lies) {
            assert!((turned - gap).abs() < 1e-10, "{turned} {gap}");
        }
    }
}
