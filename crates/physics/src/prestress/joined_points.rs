//! Bodies over their unknowns, with springs at their contact points.

use super::Result;
use super::elimination::factorized;
use super::pressed_state::{ContactState, Pressing};
use crate::contact::{Row, scaled};
use crate::fem::{DofMap, Triplets};
use crate::linalg::dense::{column, column_mut};
use crate::linalg::{Mat, SparseLu};
use std::collections::BTreeSet;

/// Bodies and the rows of their contact points over the unknowns. Bodies may be held by contact alone: what is factorized has
/// springs at the points,
///
/// ```text
/// P = K + sum_i r_i n_i n_i^T,   P u = f + sum_i (N_i + r_i c_i) n_i + mu N_i drag_i t_i,   c_i = n_i . u
/// ```
pub(super) struct JoinedPoints<'a> {
    pub pressing: &'a Pressing<'a>,
    pub unknowns: DofMap,
    /// `K` over the unknowns, numbered by dof.
    pub stiffness: Triplets,
    /// Rows `n` and `drag t`.
    pub normals: Vec<Row>,
    pub drags: Vec<Row>,
    /// The unknowns that normals touch, and those that any of both does.
    pub along_normals: DofMap,
    pub touched: DofMap,
}

/// `P^-1`.
pub(super) struct Inverse {
    solver: SparseLu,
    /// `r_i`, N/m.
    pub springs: Vec<f64>,
    /// Its columns of the unknowns that normals touch, at those that contact touches, once they are held.
    pub columns: Option<Mat<f64>>,
    /// `P`, numbered by dof, and its unknowns, of few points: what round-off leaves is solved for, too, as slender bodies multiply it.
    refined_by: Option<(Triplets, DofMap)>,
}

impl Inverse {
    /// Solves `P x = b` for each column of `block`, in place.
    fn solve_in_place(&self, block: &mut Mat<f64>) {
        let right = self.refined_by.is_some().then(|| block.clone());
        self.solver.solve_in_place(block.as_mut());
        if let (Some((matrix, unknowns)), Some(mut left)) = (&self.refined_by, right) {
            for j in 0..left.ncols() {
                let [b, x] = [&left, &*block].map(|own| unknowns.expand(column(own.as_ref(), j)));
                let residual = unknowns.restrict(&matrix.residual(&b, &x));
                column_mut(&mut left, j).copy_from_slice(&residual);
            }
            self.solver.solve_in_place(left.as_mut());
            *block += left;
        }
    }
}

/// Unknowns along normals up to which solutions are refined: there are few of these, as of one sector.
const REFINED: usize = 64;

/// Columns that are solved for together.
const BLOCK: usize = 32;

/// The rows of some unknowns.
fn picked(block: &Mat<f64>, own: &DofMap) -> Mat<f64> {
    Mat::from_fn(own.len(), block.ncols(), |i, j| block[(own.dofs[i], j)])
}

impl<'a> JoinedPoints<'a> {
    pub fn new(pressing: &'a Pressing<'a>) -> Self {
        let unknowns = pressing.elimination.unknowns();
        let Pressing { elimination, points, .. } = pressing;
        let normals = points.iter().map(|point| elimination.over(&unknowns, &point.normal));
        let drags = points
            .iter()
            .map(|point| scaled(&elimination.over(&unknowns, &point.slip), point.friction.drag));
        let (normals, drags): (Vec<Row>, Vec<Row>) = (normals.collect(), drags.collect());
        let touched = |rows: &mut dyn Iterator<Item = &Row>| {
            let own: BTreeSet<usize> = rows.flatten().map(|own| own.0).collect();
            DofMap::of(unknowns.len(), own.into_iter().collect())
        };
        Self {
            along_normals: touched(&mut normals.iter()),
            touched: touched(&mut normals.iter().chain(&drags)),
            normals,
            drags,
            stiffness: elimination.congruent(pressing.stiffness).into_owned(),
            pressing,
            unknowns,
        }
    }

    /// Factorizes `P` with springs `r_i`, N/m.
    ///
    /// # Errors
    /// [`super::PrestressError::Singular`] where a body is held by nothing, not even by contact.
    pub fn factorize(&self, springs: Vec<f64>) -> Result<Inverse> {
        let mut held = self.stiffness.clone(); // K + sum_i r_i n_i n_i^T.
        for (row, spring) in self.normals.iter().zip(&springs) {
            let row = row.iter().map(|&(unknown, along)| (self.unknowns.dofs[unknown], along));
            let row: Row = row.collect();
            held.push_product(*spring, &row, &row);
        }
        let solver = factorized(&held, &self.unknowns)?;
        let is_refined = self.along_normals.len() <= REFINED;
        let refined_by = is_refined.then(|| (held, self.unknowns.clone()));
        Ok(Inverse { solver, springs, columns: None, refined_by })
    }

    /// About `1 / n_i . K^-1 n_i`, by the diagonal of `K`, N/m: the softer of two sides counts.
    pub fn own_stiffnesses(&self) -> impl Iterator<Item = f64> {
        let mut diagonal = vec![0.0; self.unknowns.len()];
        for &(row, _, value) in self.stiffness.entries.iter().filter(|own| own.0 == own.1) {
            self.unknowns.unknown_of[row].into_iter().for_each(|at| diagonal[at] += value);
        }
        self.normals.iter().map(move |row| {
            let compliance: f64 = row.iter().map(|&(at, along)| along * along / diagonal[at]).sum();
            if compliance > 0.0 { compliance.recip() } else { 1.0 } // Any where all is held.
        })
    }

    /// Holds the columns of `P^-1`.
    pub fn hold_columns(&self, inverse: &mut Inverse) {
        let own = &self.along_normals.dofs;
        let solved: Vec<Mat<f64>> = crate::parallel::map(own.chunks(BLOCK), |own| {
            let mut block = Mat::zeros(self.unknowns.len(), own.len());
            own.iter().enumerate().for_each(|(j, &unknown)| block[(unknown, j)] = 1.0);
            inverse.solve_in_place(&mut block);
            picked(&block, &self.touched)
        });
        let entry = |i: usize, j: usize| solved[j / BLOCK][(i, j % BLOCK)];
        inverse.columns = Some(Mat::from_fn(self.touched.len(), own.len(), entry));
    }

    /// What forces along the normals and drags of the points alone move along normals, for each of some forces.
    pub fn moved_under(&self, inverse: &Inverse, along: &[Vec<[f64; 2]>]) -> Vec<Vec<f64>> {
        let mut block = Mat::zeros(self.unknowns.len(), along.len());
        (along.iter().enumerate()).for_each(|(j, own)| self.push(column_mut(&mut block, j), own));
        let moved = match &inverse.columns {
            Some(columns) => columns.transpose() * picked(&block, &self.touched), // P^-1 is symmetric.
            None => {
                inverse.solve_in_place(&mut block);
                picked(&block, &self.along_normals)
            }
        };
        (0..along.len()).map(|j| column(moved.as_ref(), j).to_vec()).collect()
    }

    /// `P^-1` times the load and forces along the normals and drags of the points.
    pub fn respond(&self, solver: &Inverse, along: &[[f64; 2]]) -> Vec<f64> {
        let Pressing { elimination, load, .. } = self.pressing;
        let load = self.unknowns.restrict(&elimination.transposed_forces(load)); // T^T f.
        let mut block = Mat::from_fn(load.len(), 1, |i, _| load[i]);
        self.push(column_mut(&mut block, 0), along); // f + sum_i F_i n_i + G_i drag_i t_i.
        solver.solve_in_place(&mut block);
        column(block.as_ref(), 0).to_vec()
    }

    /// Adds forces along the normals and drags of the points.
    fn push(&self, load: &mut [f64], along: &[[f64; 2]]) {
        for (rows, forces) in self.normals.iter().zip(&self.drags).zip(along) {
            for (row, force) in [rows.0, rows.1].into_iter().zip(forces) {
                row.iter().for_each(|&(dof, a)| load[dof] += force * a);
            }
        }
    }

    /// `c_i` of what moves along normals.
    pub fn separations(&self, moved: &[f64]) -> Vec<f64> {
        let displacement = self.along_normals.expand(moved);
        let form = |row: &Row| -> f64 { row.iter().map(|&(dof, a)| a * displacement[dof]).sum() };
        self.normals.iter().map(form).collect()
    }

    /// Displacement of every dof from the state of the points.
    pub fn displacement(
        &self,
        inverse: &Inverse,
        friction_coefficient: f64,
        state: &ContactState,
    ) -> Vec<f64> {
        let along = inverse.springs.iter().enumerate().map(|(i, spring)| {
            let force = state.normal_forces[i];
            // (N_i + r_i c_i) n_i + mu N_i drag_i t_i.
            [force + spring * state.separations[i], friction_coefficient * force]
        });
        let y = self.unknowns.expand(&self.respond(inverse, &along.collect::<Vec<_>>()));
        self.pressing.elimination.displacement(&y)
    }
}
