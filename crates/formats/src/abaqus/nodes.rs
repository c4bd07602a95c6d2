//! `*NODE` and `*ELEMENT`.

use super::Reader;
use super::block::{Row, Scoped};
use crate::prelude::*;

/// An element type that has a counterpart here.
struct ElementType {
    kind: ElementKind,
    /// Plane strain (true) or plane stress.
    is_plane_strain: Option<bool>,
    /// What is different here from what the name asks for; empty for nothing.
    difference: &'static str,
}

/// The counterpart of an element type; none for types that are no solid or plane elements of first or second order.
fn element_type(name: &str) -> Option<ElementType> {
    let (dimension, is_plane_strain) = match name.get(..3)? {
        "C3D" => (3, None),
        "CPE" => (2, Some(true)),
        "CPS" => (2, Some(false)),
        _ => return None,
    };
    let mut kinds = ElementKind::ALL.into_iter().filter(|kind| kind.dimension() == dimension);
    kinds.find_map(|kind| {
        let mut own = kind.row().abaqus.iter().filter(|(names, _)| names.contains(&&name[3..]));
        own.next().map(|&(_, difference)| ElementType { kind, is_plane_strain, difference })
    })
}

impl Reader<'_, '_> {
    /// Reads blocks of a keyword by `read`, which returns their largest number. Numbers of each instance follow those of the
    /// instances before, those of the file as a whole come last.
    fn read_numbered(
        &mut self,
        keyword: &'static str,
        read: impl Fn(&mut Self, Scoped<'_, '_>, usize) -> Result<usize>,
    ) -> Result<()> {
        let mut offset: usize = 0;
        for scope in (1..self.scopes.len()).chain([0]) {
            let mut largest = 0;
            for block in self.blocks_of(keyword).filter(|block| block.scope == scope) {
                largest = largest.max(read(self, block, offset)?);
            }
            if keyword == "NODE" && largest > 0 && offset > 0 && scope > 0 {
                let (name, first) = (&self.scopes[scope].name, offset + 1);
                self.file.model.remarks.push(format!(
                    "nodes of instance {name} are numbered from {first} on: its node 1 is {first}"
                ));
            }
            offset = offset.saturating_add(largest);
        }
        Ok(())
    }

    /// Reads all nodes.
    pub(super) fn read_nodes(&mut self) -> Result<()> {
        self.read_numbered("NODE", |reader, block, offset| {
            let system = block.parameter("SYSTEM").unwrap_or("R");
            ensure!(system.eq_ignore_ascii_case("R"); block;
                "*NODE, SYSTEM= other than R is not supported: write Cartesian coordinates");
            let first = reader.file.points.len() as u32;
            let mut largest = 0;
            for row in block.rows() {
                largest = largest.max(reader.node(row, offset)?);
            }
            let items = (first..reader.file.points.len() as u32).collect();
            reader.nodes.add(reader.named_by(block, "NSET"), items, false);
            Ok(largest)
        })
    }

    fn node(&mut self, row: Row<'_>, offset: usize) -> Result<usize> {
        let mut fields = row.fields();
        let label = row.label(fields.next().unwrap_or_default(), "a node number")?;
        let mut point = [0.0; 3];
        for (coordinate, field) in point.iter_mut().zip(fields) {
            *coordinate = row.number(field, "a coordinate")?;
        }
        let point = self.scopes[row.scope].place(point);
        if let Some(&known) = self.nodes.known.get(&(row.scope, label)) {
            ensure!(self.file.points[known as usize] == point; row;
                "node {label} is given twice, at different places");
            return Ok(label);
        }
        self.nodes.known.insert((row.scope, label), self.file.points.len() as u32);
        self.file.points.push(point);
        self.file.labels.push(label.saturating_add(offset));
        Ok(label)
    }

    /// Reads all elements; of types that have no counterpart here the numbers alone.
    pub(super) fn read_elements(&mut self) -> Result<()> {
        let blocks = self.blocks_of("ELEMENT");
        let types =
            blocks.filter_map(|block| element_type(&block.parameter("TYPE")?.to_uppercase()));
        let dimension = types.map(|known| known.kind.dimension()).max();
        self.read_numbered("ELEMENT", |reader, block, offset| {
            let name = block.required("TYPE")?.to_uppercase();
            let known = element_type(&name);
            let is_solid = ["C3D", "CPE", "CPS"].iter().any(|solid| name.starts_with(solid));
            ensure!(known.is_some() || !is_solid; block;
                "elements of type {name} are not supported. Known are {} (C3D4, C3D10, C3D8, C3D20, C3D6, C3D15, C3D5, \
                 C3D13), and CPE and CPS with 3, 4, 6 or 8 nodes", ElementKind::SOLID_SHAPES);
            match known.filter(|known| Some(known.kind.dimension()) == dimension) {
                Some(known) => reader.element_block(block, &name, &known, offset),
                None => reader.skipped_block(block, &name),
            }
        })
    }

    /// Elements of a type that is not used.
    fn skipped_block(&mut self, block: Scoped<'_, '_>, name: &str) -> Result<usize> {
        let mut largest = 0;
        let mut goes_on = false;
        for row in block.rows() {
            if std::mem::replace(&mut goes_on, row.line.trim_end().ends_with(',')) {
                continue;
            }
            let label = row.label(row.field(0), "an element number")?;
            self.elements.skipped.insert((row.scope, label));
            largest = largest.max(label);
            let keyword = format!("*ELEMENT, TYPE={name}");
            let reason = "elements other than solids (of plane bodies CPE and CPS) are not used";
            self.leave_out(&keyword, row.place, reason);
        }
        self.elements.add(self.named_by(block, "ELSET"), Vec::new(), false);
        Ok(largest)
    }

    /// Keeps what a type of elements says: what is different here, plane strain or plane stress.
    fn note_type(&mut self, block: Scoped<'_, '_>, name: &str, known: &ElementType) -> Result<()> {
        let model = &mut self.file.model;
        let remark = format!("elements {name} are {}", known.difference);
        if !known.difference.is_empty() && !model.remarks.contains(&remark) {
            model.remarks.push(remark);
        }
        if let Some(is_strain) = known.is_plane_strain {
            ensure!(model.is_plane_strain.is_none_or(|other| other == is_strain); block;
                "elements of plane strain (CPE) and of plane stress (CPS) in one file");
            model.is_plane_strain = Some(is_strain);
        }
        Ok(())
    }

    /// Elements of a type that is known; the largest number.
    fn element_block(
        &mut self,
        block: Scoped<'_, '_>,
        name: &str,
        known: &ElementType,
        offset: usize,
    ) -> Result<usize> {
        self.note_type(block, name, known)?;
        let region = block.parameter("ELSET");
        let region = region.map(|name| self.scopes[block.scope].full_name(name));
        let region: Arc<str> = region.map(Into::into).unwrap_or_default();
        let first = self.file.elements.len();
        let (kind, count) = (known.kind, known.kind.node_count());
        let mut largest = 0;
        let mut rows = block.rows();
        while let Some(start) = rows.next() {
            let (mut row, mut numbers) = (start, Vec::with_capacity(1 + count));
            loop {
                for field in row.fields() {
                    numbers.push(row.label(field, "the number of an element or node")?);
                }
                ensure!(numbers.len() <= 1 + count; start;
                    "element {} has {} nodes, {name} has {count}", numbers[0], numbers.len() - 1);
                if numbers.len() == 1 + count {
                    break;
                }
                row = found!(rows.next(); start;
                    "element {} has too few nodes for {name}, which has {count}", numbers[0]);
            }
            largest = largest.max(numbers[0]);
            let nodes = self.element_nodes(start, &numbers)?;
            let label = numbers[0].saturating_add(offset);
            let region = Arc::clone(&region);
            self.file.elements.push(FileElement { label, kind, region, entity: 0, nodes });
        }
        let items = (first..self.file.elements.len()).collect();
        self.elements.add(self.named_by(block, "ELSET"), items, false);
        Ok(largest)
    }

    /// Takes in the number of an element, and finds its nodes by those that follow.
    fn element_nodes(&mut self, row: Row<'_>, numbers: &[usize]) -> Result<Vec<u32>> {
        let (label, mut nodes) = (numbers[0], Vec::with_capacity(numbers.len() - 1));
        for node in &numbers[1..] {
            nodes.push(*found!(self.nodes.known.get(&(row.scope, *node)); row;
                "element {label} names node {node}, which the file does not have"));
        }
        let known = self.elements.known.insert((row.scope, label), self.file.elements.len());
        ensure!(known.is_none(); row; "element {label} is given twice");
        Ok(nodes)
    }
}
