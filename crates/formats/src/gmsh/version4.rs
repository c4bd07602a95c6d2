//! Entities, nodes and elements of MSH 4.1.

use super::cursor::Cursor;
use super::{MeshFileError, Reader, shape_of};

/// Physical groups that one entity may belong to: every element of it is kept in each.
const MOST_GROUPS: usize = 64;

impl Reader {
    pub(super) fn entities(&mut self, cursor: &mut Cursor<'_>) -> Result<(), MeshFileError> {
        let mut counts = [0; 4];
        for (count, what) in counts.iter_mut().zip(["points", "curves", "surfaces", "volumes"]) {
            *count = cursor.count(what, 8)?;
        }
        for (dimension, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                let tag = cursor.int("entity tag")?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    cursor.number("bound")?;
                }
                let groups = cursor.count("physical tags", 2)?;
                if groups > MOST_GROUPS {
                    refuse!(cursor; "an entity in {groups} physical groups is not valid");
                }
                let groups: Result<Vec<i64>, _> =
                    (0..groups).map(|_| cursor.int("physical tag")).collect();
                // A negative tag says that the entity is reversed in its group.
                let groups = groups?.into_iter().map(i64::abs).collect();
                self.physical.insert((dimension as i64, tag), groups);
                if dimension > 0 {
                    for _ in 0..cursor.count("bounding entities", 2)? {
                        cursor.int("bounding entity")?;
                    }
                }
            }
        }
        Ok(())
    }

    pub(super) fn nodes_4(&mut self, cursor: &mut Cursor<'_>) -> Result<(), MeshFileError> {
        let blocks = cursor.count("node blocks", 6)?;
        for what in ["nodes", "smallest node", "largest node"] {
            cursor.size(what)?;
        }
        for _ in 0..blocks {
            let dimension = cursor.int("entity dimension")?;
            cursor.int("entity tag")?;
            let is_parametric = cursor.int("parametric flag")? != 0;
            let count = cursor.count("nodes of a block", 8)?;
            let labels: Result<Vec<usize>, _> =
                (0..count).map(|_| cursor.size("node number")).collect();
            for label in labels? {
                let point = [0; 3].map(|_| cursor.number("coordinate"));
                let [x, y, z] = point;
                if is_parametric {
                    for _ in 0..dimension.clamp(0, 3) {
                        cursor.number("parameter")?;
                    }
                }
                self.node(cursor, label, [x?, y?, z?])?;
            }
        }
        Ok(())
    }

    pub(super) fn elements_4(&mut self, cursor: &mut Cursor<'_>) -> Result<(), MeshFileError> {
        let blocks = cursor.count("element blocks", 8)?;
        for what in ["elements", "smallest element", "largest element"] {
            cursor.size(what)?;
        }
        for _ in 0..blocks {
            let dimension = cursor.int("entity dimension")?;
            let entity = cursor.int("entity tag")?;
            let kind = cursor.int("element type")?;
            let count = cursor.count("elements of a block", 4)?;
            let groups = self.physical.get(&(dimension, entity)).cloned().unwrap_or_default();
            for _ in 0..count {
                let label = cursor.size("element number")?;
                let (_, node_count, _) = shape_of(cursor, kind, label)?;
                let nodes: Result<Vec<usize>, _> =
                    (0..node_count).map(|_| cursor.size("node number")).collect();
                self.element(cursor, kind, label, entity, &groups, &nodes?)?;
            }
        }
        Ok(())
    }
}
