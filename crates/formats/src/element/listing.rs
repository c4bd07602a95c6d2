//! Element kinds in mesh files: their numbers or names, and the order of their nodes.

/// Elements of a kind in one format.
pub(crate) struct Listing<T: 'static> {
    /// Its numbers or names in the format; none where the format has no such element. Of kinds that share one the first in
    /// [`super::ElementKind::ALL`] is read.
    pub names: &'static [T],
    /// For each node of the kind its place in the file; empty where the order is the same.
    pub order: &'static [usize],
}

impl<T> Listing<T> {
    /// The nodes of an element in the order of its kind, from that of the file.
    pub fn arranged(&self, listed: &[u32]) -> Vec<u32> {
        match self.order {
            [] => listed.to_vec(),
            order => order.iter().map(|&place| listed[place]).collect(),
        }
    }
}

/// What differs here from what an element type of Abaqus asks for.
pub(super) const FULL: &str = "fully integrated here";
pub(super) const DISPLACEMENTS: &str = "by displacements alone here";
pub(super) const BRICK: &str = "integrated with incompatible modes here";

/// The same order as here.
pub(super) const fn listed<T>(names: &'static [T]) -> Listing<T> {
    Listing { names, order: &[] }
}
