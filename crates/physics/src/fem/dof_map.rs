//! The unknowns of a problem among the degrees of freedom of a mesh.

use std::collections::BTreeSet;

/// Which dofs are unknowns of a problem and where each stands among them.
#[derive(Clone, Debug, PartialEq)]
pub struct DofMap {
    /// Position of each full dof among the unknowns; `None` where it is prescribed.
    pub unknown_of: Vec<Option<usize>>,
    /// Full dof of each unknown.
    pub dofs: Vec<usize>,
}

impl DofMap {
    /// The unknowns among some dofs, each once, in their order.
    pub fn among(&self, dofs: &[usize]) -> Vec<usize> {
        let mut seen = BTreeSet::new();
        let free = dofs.iter().filter_map(|&dof| self.unknown_of[dof]);
        free.filter(|&unknown| seen.insert(unknown)).collect()
    }

    /// All dofs but the given ones, of `total`, ascending.
    pub fn excluding(total: usize, prescribed: impl IntoIterator<Item = usize>) -> Self {
        let mut free = vec![true; total];
        prescribed.into_iter().for_each(|dof| free[dof] = false);
        Self::of(total, (0..total).filter(|&dof| free[dof]).collect())
    }

    /// Some dofs of `total` in this order.
    pub fn of(total: usize, dofs: Vec<usize>) -> Self {
        let mut unknown_of = vec![None; total];
        dofs.iter().enumerate().for_each(|(unknown, &dof)| unknown_of[dof] = Some(unknown));
        Self { unknown_of, dofs }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.dofs.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.dofs.is_empty()
    }

    /// Writes unknowns into a vector over all dofs, zero elsewhere.
    pub fn expand<T: Copy + Default>(&self, unknowns: &[T]) -> Vec<T> {
        let mut full = vec![T::default(); self.unknown_of.len()];
        self.dofs.iter().zip(unknowns).for_each(|(&dof, &value)| full[dof] = value);
        full
    }

    /// The unknowns among a vector over all dofs.
    pub fn restrict<T: Copy>(&self, full: &[T]) -> Vec<T> {
        self.dofs.iter().map(|&dof| full[dof]).collect()
    }
}
