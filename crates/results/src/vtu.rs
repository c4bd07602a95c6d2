//! Fields on the mesh for ParaView: VTK XML unstructured grids, appended raw, zlib-compressed, and collections of them
//! by time.

use crate::prelude::*;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use frictionsim_physics::fem::{NodalStress, SolidStress};
use nalgebra::Vector3;
use std::io::{self, Write};
use std::slice;

/// Bytes of one compressed block.
const BLOCK: usize = 1 << 18;

/// Numbers of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Quantities.
    Real(Vec<f64>),
    /// Ids and codes.
    Integer(Vec<i64>),
}

impl Values {
    fn len(&self) -> usize {
        match self {
            Self::Real(values) => values.len(),
            Self::Integer(values) => values.len(),
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Self::Real(_) => "Float64",
            Self::Integer(_) => "Int64",
        }
    }

    fn bytes(&self) -> Vec<u8> {
        match self {
            // Adding zero turns -0.0 into 0.0.
            Self::Real(values) => {
                let mut bytes = vec![0; 8 * values.len()];
                for (place, v) in bytes.chunks_exact_mut(8).zip(values) {
                    place.copy_from_slice(&(v + 0.0).to_le_bytes());
                }
                bytes
            }
            Self::Integer(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }
}

/// Values at nodes or in elements, or of the whole file.
///
/// A name ends in the unit, as the columns of tables do: `displacement_m`, `von_mises_pa`.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Name that ParaView shows.
    pub name: String,
    /// Values of each node or element: 1 scalar, 3 vector.
    pub components: usize,
    /// All values, those of one node or element together.
    pub values: Values,
}

impl Field {
    /// One value for each node or element.
    pub fn scalars(name: &str, values: Vec<f64>) -> Self {
        Self { name: name.to_owned(), components: 1, values: Values::Real(values) }
    }

    /// One whole number for each node or element: an id or a code.
    pub fn integers(name: &str, values: Vec<i64>) -> Self {
        Self { name: name.to_owned(), components: 1, values: Values::Integer(values) }
    }

    /// Its quantities; none of whole numbers.
    pub fn reals(&self) -> &[f64] {
        match &self.values {
            Values::Real(values) => values,
            Values::Integer(_) => &[],
        }
    }

    /// Its values, compressed, of so many nodes or elements.
    fn encoded(&self, count: usize) -> io::Result<Array> {
        if self.values.len() != count * self.components {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("field {} has {} values", self.name, self.values.len()),
            ));
        }
        Array::new(self.values.kind(), &self.name, self.components, &self.values.bytes())
    }

    /// One number of the whole file.
    pub fn number(name: &str, value: f64) -> Self {
        Self::scalars(name, vec![rounded(value, 12)])
    }

    /// The stresses at the nodes: `von_mises_pa`, `hydrostatic_pressure_pa`, and the components in nodal frames.
    pub fn stresses(stresses: &[NodalStress]) -> Vec<Self> {
        let field = |name: &str, of: fn(&NodalStress) -> f64| {
            Self::scalars(name, stresses.iter().map(of).collect())
        };
        vec![
            field("von_mises_pa", NodalStress::von_mises),
            field("hydrostatic_pressure_pa", NodalStress::pressure),
            field("stress_rr_pa", |stress| stress.radial),
            field("stress_tt_pa", |stress| stress.hoop),
            field("stress_rt_pa", |stress| stress.shear),
        ]
    }

    /// The stresses at the nodes of a solid body: `von_mises_pa`, `hydrostatic_pressure_pa`, and the components along
    /// `axes`, one letter each.
    pub fn solid_stresses(stresses: &[SolidStress], axes: &str) -> Vec<Self> {
        let field = |name: &str, of: &dyn Fn(&SolidStress) -> f64| {
            Self::scalars(name, stresses.iter().map(of).collect())
        };
        let axes: Vec<char> = axes.chars().collect();
        let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
        let components = pairs.into_iter().enumerate().map(|(k, (one, other))| {
            field(&format!("stress_{}{}_pa", axes[one], axes[other]), &|stress| stress.0[k])
        });
        let scalars = [
            field("von_mises_pa", &SolidStress::von_mises),
            field("hydrostatic_pressure_pa", &SolidStress::pressure),
        ];
        scalars.into_iter().chain(components).collect()
    }

    /// The stress components along `x` and `y` of a body that is no annulus about the origin, where polar ones say
    /// little.
    pub fn cartesian_stresses(mesh: &Mesh, stresses: &[NodalStress]) -> Vec<Self> {
        if mesh.is_cyclic {
            return Vec::new();
        }
        // sigma_xy = T^T sigma_rt T with the turn T by the angle of the node's axes.
        let turned = |(node, stress): (usize, &NodalStress)| {
            let (sin, cos) = mesh.reported_angle(node).sin_cos();
            let (rr, tt, rt) = (stress.radial, stress.hoop, stress.shear);
            let twice = 2.0 * sin * cos * rt;
            [
                cos * cos * rr + sin * sin * tt - twice,
                sin * sin * rr + cos * cos * tt + twice,
                sin * cos * (rr - tt) + (cos * cos - sin * sin) * rt,
            ]
        };
        let turned: Vec<[f64; 3]> = stresses.iter().enumerate().map(turned).collect();
        let field = |name: &str, k: usize| {
            Self::scalars(name, turned.iter().map(|stress| stress[k]).collect())
        };
        vec![field("stress_xx_pa", 0), field("stress_yy_pa", 1), field("stress_xy_pa", 2)]
    }

    /// The contact at the nodes of its edge among `count` nodes: `status` (0 open, 1 stick, 2 slip; -1 off the edge),
    /// `pressure_pa` and `shear_pa`.
    pub fn contact(
        count: usize,
        edge: &[u32],
        statuses: impl IntoIterator<Item = ContactStatus>,
        [pressures, shears]: [&[f64]; 2],
    ) -> [Self; 3] {
        let mut codes = vec![-1; count];
        for (&node, status) in edge.iter().zip(statuses) {
            codes[node as usize] = status as i64;
        }
        [
            Self::integers("status", codes),
            Self::on_edge("pressure_pa", count, edge, pressures),
            Self::on_edge("shear_pa", count, edge, shears),
        ]
    }

    /// Values at the nodes of the contact edge among `count` nodes, zero off it.
    pub fn on_edge(name: &str, count: usize, edge: &[u32], values: &[f64]) -> Self {
        let mut all = vec![0.0; count];
        for (&node, value) in edge.iter().zip(values) {
            all[node as usize] = *value;
        }
        Self::scalars(name, all)
    }

    /// A vector of each node from its nodal frame, as Cartesian `(x, y, z)`.
    pub fn vectors(name: &str, mesh: &Mesh, nodal: &[f64]) -> Self {
        Self { components: 3, ..Self::scalars(name, cartesian_vectors(mesh, nodal)) }
    }
}

/// Turns nodal-frame vectors (`dimension * node_count` values) into Cartesian `(x, y, z)` triples.
pub fn cartesian_vectors(mesh: &Mesh, nodal: &[f64]) -> Vec<f64> {
    if mesh.dimension == 3 {
        let nodes = nodal.chunks_exact(3).enumerate();
        let turned = nodes.map(|(node, u)| mesh.frame(node) * Vector3::from_column_slice(u));
        return turned.flat_map(|vector| [vector.x, vector.y, vector.z]).collect();
    }
    let pairs = nodal.chunks_exact(2).zip(mesh.frame_angles());
    pairs
        .flat_map(|(pair, angle)| {
            let (sine, cosine) = angle.sin_cos();
            [pair[0] * cosine - pair[1] * sine, pair[0] * sine + pair[1] * cosine, 0.0]
        })
        .collect()
}

/// An array of a file, compressed.
#[derive(Clone, Debug)]
struct Array {
    kind: &'static str,
    name: String,
    components: usize,
    bytes: Vec<u8>,
}

impl Array {
    fn new(kind: &'static str, name: &str, components: usize, bytes: &[u8]) -> io::Result<Self> {
        Ok(Self { kind, name: name.to_owned(), components, bytes: compress(bytes)? })
    }
}

/// The geometry of a mesh, compressed once for any number of files.
#[derive(Clone, Debug)]
pub struct EncodedMesh {
    node_count: usize,
    element_count: usize,
    points: Array,
    /// Connectivity, offsets and types.
    cells: [Array; 3],
}

impl EncodedMesh {
    /// Compresses a mesh.
    pub fn new(mesh: &Mesh) -> io::Result<Self> {
        let integers = |values: &mut dyn Iterator<Item = i64>| -> Vec<u8> {
            values.flat_map(i64::to_le_bytes).collect()
        };
        let points = mesh.nodes.iter().flatten().copied();
        let points: Vec<u8> = points.flat_map(f64::to_le_bytes).collect();
        let ends = mesh.element_kinds.iter().scan(0, |end, kind| {
            *end += kind.node_count() as i64;
            Some(*end)
        });
        let types: Vec<u8> = mesh.element_kinds.iter().map(|kind| kind.vtk_type()).collect();
        let nodes = mesh.elements.iter().map(|node| i64::from(*node));
        Ok(Self {
            node_count: mesh.node_count(),
            element_count: mesh.element_count(),
            points: Array::new("Float64", "Points", 3, &points)?,
            cells: [
                Array::new("Int64", "connectivity", 1, &integers(&mut { nodes }))?,
                Array::new("Int64", "offsets", 1, &integers(&mut { ends }))?,
                Array::new("UInt8", "types", 1, &types)?,
            ],
        })
    }
}

/// Compresses one array as VTK reads it: block count, block size, size of the last partial block,
/// compressed sizes (64-bit little-endian each), then the blocks.
fn compress(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let blocks: Vec<Vec<u8>> = bytes
        .chunks(BLOCK)
        .map(|block| {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
            encoder.write_all(block)?;
            encoder.finish()
        })
        .collect::<io::Result<_>>()?;
    let mut out = Vec::new();
    let partial = bytes.len() % BLOCK;
    let header = [blocks.len(), BLOCK, partial].into_iter();
    for value in header.chain(blocks.iter().map(Vec::len)) {
        out.extend((value as u64).to_le_bytes());
    }
    blocks.iter().for_each(|block| out.extend(block));
    Ok(out)
}

/// Writes a VTU file, lossless: `whole` are numbers of the whole file (FieldData: time, frequency, friction).
///
/// # Errors
/// Those of the writer; [`io::ErrorKind::InvalidInput`] for a field whose length does not fit.
pub fn write_vtu(
    out: &mut dyn Write,
    mesh: &EncodedMesh,
    whole: &[Field],
    point_fields: &[Field],
    cell_fields: &[Field],
) -> io::Result<()> {
    let encoded = |fields: &[Field], count: usize| -> io::Result<Vec<Array>> {
        fields.iter().map(|field| field.encoded(count)).collect()
    };
    let at_nodes = encoded(point_fields, mesh.node_count)?;
    let in_elements = encoded(cell_fields, mesh.element_count)?;
    let groups = [
        ("PointData", &at_nodes[..]),
        ("CellData", &in_elements[..]),
        ("Points", slice::from_ref(&mesh.points)),
        ("Cells", &mesh.cells[..]),
    ];
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(
        out,
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">"
    )?;
    writeln!(out, "<UnstructuredGrid>")?;
    write_whole(out, whole)?;
    writeln!(
        out,
        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">",
        mesh.node_count, mesh.element_count
    )?;
    let mut offset = 0;
    for (tag, arrays) in groups {
        writeln!(out, "<{tag}>")?;
        for Array { kind, name, components, bytes } in arrays {
            writeln!(
                out,
                "<DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{components}\" \
                 format=\"appended\" offset=\"{offset}\"/>",
                escape(name)
            )?;
            offset += bytes.len();
        }
        writeln!(out, "</{tag}>")?;
    }
    write!(out, "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
    for array in groups.iter().flat_map(|group| group.1) {
        out.write_all(&array.bytes)?;
    }
    write!(out, "\n</AppendedData>\n</VTKFile>\n")
}

fn write_whole(out: &mut dyn Write, fields: &[Field]) -> io::Result<()> {
    if fields.is_empty() {
        return Ok(());
    }
    writeln!(out, "<FieldData>")?;
    for field in fields {
        let (count, name) = (field.values.len(), escape(&field.name));
        write!(
            out,
            "<DataArray type=\"{}\" Name=\"{name}\" NumberOfTuples=\"{count}\" format=\"ascii\">",
            field.values.kind()
        )?;
        match &field.values {
            Values::Real(values) => values.iter().try_for_each(|v| write!(out, "{v:?} "))?,
            Values::Integer(values) => values.iter().try_for_each(|v| write!(out, "{v} "))?,
        }
        writeln!(out, "</DataArray>")?;
    }
    writeln!(out, "</FieldData>")
}

/// Text inside an XML attribute.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

/// One file of a collection.
#[derive(Clone, Debug, PartialEq)]
pub struct PvdEntry {
    /// Time, or whatever the collection is ordered by.
    pub time: f64,
    /// Group that the file belongs to.
    pub group: String,
    /// File name relative to the collection.
    pub file: String,
}

/// Writes a ParaView collection.
pub fn write_pvd(out: &mut dyn Write, entries: &[PvdEntry]) -> io::Result<()> {
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(
        out,
        "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>"
    )?;
    for entry in entries {
        writeln!(
            out,
            "<DataSet timestep=\"{:?}\" group=\"{}\" part=\"0\" file=\"{}\"/>",
            rounded(entry.time, 12),
            escape(&entry.group),
            escape(&entry.file)
        )?;
    }
    writeln!(out, "</Collection>\n</VTKFile>")
}
