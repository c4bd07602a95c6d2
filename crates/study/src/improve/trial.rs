//! Candidates: where a modification of the size allowed helps most, to first order.

use super::base::Base;
use super::fields::Derivatives;
use super::places::Places;
use frictionsim_case::ModificationKind;
use frictionsim_physics::linalg::c64;
use frictionsim_results::improve::Sizes;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Blocks of a derivative at a node.
type Blocks = fn(&Derivatives, usize) -> Matrix3<f64>;

/// Places of each kind that are kept for a closer look, for each one that is listed.
const KEPT: usize = 6;

/// What is modified.
#[derive(Clone, Debug)]
pub(super) enum Target {
    /// A node, along a direction of a spring or dashpot.
    Node(usize, Option<[f64; 3]>),
    /// The elements of a patch about the middle of the first.
    Patch(usize, Vec<u32>),
    /// The hole, along a vector, m.
    Hole([f64; 2]),
}

/// One modification.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub kind: ModificationKind,
    pub target: Target,
    /// Largest growth rate of the targets to first order, 1/s; none of what has no first order.
    pub first_order: Option<f64>,
}

/// Looks for the best places of each kind.
pub(super) struct Search<'a> {
    pub base: &'a Base<'a>,
    pub sizes: Sizes,
    pub places: Places,
    pub derivatives: &'a [Derivatives],
}

impl Search<'_> {
    /// The best places of a kind by first order, apart from each other; those that do not help are left out.
    pub fn best(&self, kind: ModificationKind) -> Vec<Trial> {
        let mut found = match kind {
            ModificationKind::Mass | ModificationKind::Spring | ModificationKind::Dashpot => {
                self.at_nodes(kind)
            }
            ModificationKind::Damping | ModificationKind::Removal => self.in_patches(kind),
            ModificationKind::Offset => return self.of_hole(),
        };
        let before = self.growth(&|_| c64::ZERO);
        found.retain(|trial| trial.first_order.is_some_and(|growth| growth < before));
        let growth = |own: &Trial| own.first_order.unwrap_or(f64::INFINITY);
        frictionsim_physics::order::sort_by_number(&mut found, growth);
        self.apart(found, KEPT * self.base.case.improve.candidates)
    }

    /// Largest growth rate of the targets with changes of their eigenvalues.
    fn growth(&self, change: &dyn Fn(&Derivatives) -> c64) -> f64 {
        let growth = self.derivatives.iter().map(|own| own.eigenvalue.re + change(own).re);
        growth.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The target that grows fastest.
    fn fastest(&self) -> &Derivatives {
        self.derivatives
            .iter()
            .max_by(|a, b| a.eigenvalue.re.total_cmp(&b.eigenvalue.re))
            .expect("there are targets, or nothing would be improved")
    }

    /// The key of what a kind attaches to a node, and its size: kg, N/m, N s/m.
    pub fn attached(&self, kind: ModificationKind) -> (&'static str, f64) {
        match kind {
            ModificationKind::Mass => ("mass", self.sizes.mass_kg),
            ModificationKind::Spring => ("stiffness", self.sizes.stiffness_n_per_m),
            _ => ("damping", self.sizes.damping_n_s_per_m),
        }
    }

    fn at_nodes(&self, kind: ModificationKind) -> Vec<Trial> {
        let alpha = self.base.options.damping.mass_coefficient;
        let amount = self.attached(kind).1 / self.base.case.depth();
        let of: Blocks = match kind {
            ModificationKind::Spring => Derivatives::by_spring,
            _ => Derivatives::by_dashpot,
        };
        let trial = |&node: &usize| {
            let (direction, first_order) = match kind {
                ModificationKind::Mass => {
                    (None, self.growth(&|own| own.by_mass(node, alpha) * amount))
                }
                _ => {
                    let along = steepest(&of(self.fastest(), node), self.base.mesh.dimension);
                    let change = |own: &Derivatives| {
                        let rate = along.dot(&(of(own, node) * along));
                        c64::new(rate * amount, 0.0)
                    };
                    (Some([along.x, along.y, along.z]), self.growth(&change))
                }
            };
            Trial { kind, target: Target::Node(node, direction), first_order: Some(first_order) }
        };
        frictionsim_physics::parallel::map(&self.places.nodes, trial)
    }

    fn in_patches(&self, kind: ModificationKind) -> Vec<Trial> {
        let beta = self.sizes.patch_damping_s;
        let trial = |(element, patch): &(usize, Vec<u32>)| {
            let change = |own: &Derivatives| {
                let each = patch.iter().map(|&e| match kind {
                    ModificationKind::Removal => own.removal[e as usize],
                    _ => own.damping[e as usize] * beta,
                });
                each.fold(c64::ZERO, |sum, value| sum + value)
            };
            Trial {
                kind,
                first_order: Some(self.growth(&change)),
                target: Target::Patch(*element, patch.clone()),
            }
        };
        frictionsim_physics::parallel::map(&self.places.patches, trial)
    }

    /// Half and whole ways along the axes; a disc whose sectors are alike has no preferred one.
    fn of_hole(&self) -> Vec<Trial> {
        let ways: &[[f64; 2]] = match self.base.mesh.is_cyclic {
            true => &[[1.0, 0.0]],
            false => &[[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]],
        };
        let lengths = [0.5, 1.0].map(|share| share * self.sizes.offset_m);
        let all = ways.iter().flat_map(|&[x, y]| {
            lengths.map(|length| Trial {
                kind: ModificationKind::Offset,
                target: Target::Hole([length * x, length * y]),
                first_order: None,
            })
        });
        if self.places.has_hole { all.collect() } else { Vec::new() }
    }

    /// The first of some trials that lie at least a patch's width from each other.
    fn apart(&self, trials: Vec<Trial>, count: usize) -> Vec<Trial> {
        let mut kept: Vec<(Trial, Vector3<f64>)> = Vec::new();
        for trial in trials {
            let place = Vector3::from(self.place(&trial));
            let is_near = |(_, other): &(Trial, Vector3<f64>)| {
                (place - other).norm() < 2.0 * self.sizes.patch_radius_m
            };
            if kept.len() < count && !kept.iter().any(is_near) {
                kept.push((trial, place));
            }
        }
        kept.into_iter().map(|(trial, _)| trial).collect()
    }

    /// Where a trial is, m.
    pub fn place(&self, trial: &Trial) -> [f64; 3] {
        match &trial.target {
            Target::Node(node, _) => self.base.mesh.nodes[*node],
            Target::Patch(element, _) => self.base.mesh.element_middle(*element),
            Target::Hole([x, y]) => [*x, *y, 0.0],
        }
    }
}

/// The unit vector along which a quadratic form is least, its first component that is not small positive.
fn steepest(form: &Matrix3<f64>, dimension: usize) -> Vector3<f64> {
    let mut own = *form;
    if dimension == 2 {
        // Nothing moves across the plane: that direction is the last to be chosen.
        own[(2, 2)] = 1.0 + form.abs().sum();
    }
    let eigen = SymmetricEigen::new(own);
    let vector: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
    let first = vector.iter().find(|x| x.abs() > 0.1).copied();
    vector * first.unwrap_or(1.0).signum()
}
