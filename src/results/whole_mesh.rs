//! Nodes and elements of a body as files list them.

use crate::linalg::c64;
use crate::mesh::{ElementKind, Mesh, SolidSector};
use crate::signal::reader::{ModeData, write_mesh, write_mode};
use std::io::{self, Write};

/// The nodes and elements of a mesh, or of all sectors of a body of revolution.
pub struct WholeMesh {
    /// Numbers of the nodes in other files: those of the mesh file, or from 1.
    pub labels: Vec<usize>,
    /// Places of the nodes, m.
    pub points: Vec<[f64; 3]>,
    /// Kind of each element.
    pub kinds: Vec<ElementKind>,
    /// Nodes of each element, one after the other.
    pub nodes: Vec<u32>,
}

impl WholeMesh {
    /// The nodes and elements of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        Self {
            labels: (0..mesh.node_count()).map(|node| mesh.node_label(node)).collect(),
            points: mesh.nodes.clone(),
            kinds: mesh.element_kinds.clone(),
            nodes: mesh.elements.clone(),
        }
    }

    /// The bricks of a whole body of revolution, its nodes sector by sector.
    pub fn of_revolution(sector: &SolidSector) -> Self {
        let (sectors, per_sector) = (sector.sector_count(), sector.node_count());
        let place = |j: usize| {
            let nodes = sector.nodes.iter().enumerate();
            nodes.map(move |(k, node)| {
                let (sin, cos) = sector.angle(k, j).sin_cos();
                [node.radius * cos, node.radius * sin, node.height]
            })
        };
        let nodes = (0..sectors).flat_map(|j| {
            let all = sector.elements.iter().flatten();
            all.map(move |&(node, half)| ((j + half / 2) % sectors * per_sector + node) as u32)
        });
        let kind = if sector.is_quadratic() { ElementKind::Hex20 } else { ElementKind::Hex8 };
        Self {
            labels: (1..=sectors * per_sector).collect(),
            points: (0..sectors).flat_map(place).collect(),
            kinds: vec![kind; sectors * sector.elements.len()],
            nodes: nodes.collect(),
        }
    }

    /// The nodes of each element.
    pub fn elements(&self) -> impl Iterator<Item = (ElementKind, &[u32])> {
        let mut rest = &self.nodes[..];
        self.kinds.iter().map(move |kind| {
            let (own, others) = rest.split_at(kind.node_count());
            rest = others;
            (*kind, own)
        })
    }

    /// Writes units, nodes and elements as a universal file.
    ///
    /// # Errors
    /// Those of the writer; an element that universal files do not have (a pyramid).
    pub fn write_universal(&self, out: &mut dyn Write) -> io::Result<()> {
        let listed = self.elements().map(|(kind, nodes)| {
            let (descriptor, nodes) = kind.universal(nodes).ok_or_else(|| {
                let name = kind.name();
                io::Error::other(format!("universal files have no element like {name}"))
            })?;
            let labels = nodes.iter().map(|&node| self.labels[node as usize]);
            Ok((descriptor, labels.collect()))
        });
        let elements = listed.collect::<io::Result<Vec<_>>>()?;
        let nodes = self.labels.iter().copied().zip(self.points.iter().copied());
        write_mesh(out, &mut { nodes }, &mut elements.into_iter())
    }

    /// Writes a mode by the real and imaginary displacements of its nodes, each along x, y and z.
    pub fn write_universal_mode(
        &self,
        out: &mut dyn Write,
        (name, number): (&str, usize),
        eigenvalue: c64,
        [real, imaginary]: [&[f64]; 2],
    ) -> io::Result<()> {
        let pairs = real.chunks_exact(3).zip(imaginary.chunks_exact(3));
        let shape: Vec<[c64; 3]> =
            pairs.map(|(re, im)| [0, 1, 2].map(|k| c64::new(re[k], im[k]))).collect();
        let labels = &self.labels;
        write_mode(out, &ModeData { name, number, eigenvalue, labels, shape: &shape })
    }
}
