//! Fields on the mesh for ParaView: VTK XML unstructured grids, appended raw, zlib-compressed, and collections of them
//! by time.

use crate::prelude::*;
use flate2::write::ZlibEncoder;
use std::slice;

/// Bytes of one compressed block.
const BLOCK: usize = 1 << 18;

/// Values at nodes or in elements.
///
/// A name ends in the unit, as the columns of tables do: `displacement_m`, `von_mises_pa`.
#[derive(Clone, Debug)]
pub struct Field {
    /// Name that ParaView shows.
    name: String,
    /// Values of each node or element: 1 scalar, 3 vector.
    components: usize,
    /// VTK's name of their type.
    kind: &'static str,
    /// All values, those of one node or element together.
    bytes: Vec<u8>,
}

impl Field {
    /// One value for each node or element.
    pub fn scalars(name: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let values = values.into_iter();
        let mut bytes = Vec::with_capacity(8 * values.size_hint().0);
        // Adding zero turns -0.0 into 0.0.
        values.for_each(|value| bytes.extend_from_slice(&(value + 0.0).to_le_bytes()));
        Self { name: name.to_owned(), components: 1, kind: "Float64", bytes }
    }

    /// One whole number for each node or element: an id or a code.
    pub fn integers(name: &str, values: impl IntoIterator<Item = i64>) -> Self {
        let bytes = values.into_iter().flat_map(i64::to_le_bytes).collect();
        Self { name: name.to_owned(), components: 1, kind: "Int64", bytes }
    }

    /// The same compressed.
    fn compressed(&self) -> io::Result<Self> {
        let (name, bytes) = (self.name.clone(), compress(&self.bytes)?);
        Ok(Self { name, bytes, ..*self })
    }

    /// The same compressed, of so many nodes or elements.
    fn of(&self, count: usize) -> io::Result<Self> {
        let found = self.bytes.len() / 8;
        if found != count * self.components {
            let what = format!("field {} has {found} values", self.name);
            return Err(io::Error::new(io::ErrorKind::InvalidInput, what));
        }
        self.compressed()
    }

    /// The stresses at the nodes of a plane body: `von_mises_pa`, `hydrostatic_pressure_pa`, the components in nodal
    /// frames, and of a body that is no annulus about the origin, where these say little, those along `x` and `y`.
    pub fn plane_stresses(mesh: &Mesh, stresses: &[NodalStress]) -> Vec<Self> {
        let field =
            |name: &str, of: fn(&NodalStress) -> f64| Self::scalars(name, stresses.iter().map(of));
        let mut fields = vec![
            field("von_mises_pa", NodalStress::von_mises),
            field("hydrostatic_pressure_pa", NodalStress::pressure),
            field("stress_rr_pa", |stress| stress.radial),
            field("stress_tt_pa", |stress| stress.hoop),
            field("stress_rt_pa", |stress| stress.shear),
        ];
        if mesh.is_cyclic {
            return fields;
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
        let names = ["stress_xx_pa", "stress_yy_pa", "stress_xy_pa"].into_iter().enumerate();
        fields.extend(names.map(|(k, name)| Self::scalars(name, turned.iter().map(|own| own[k]))));
        fields
    }

    /// The stresses at the nodes of a solid body: `von_mises_pa`, `hydrostatic_pressure_pa`, and the components along
    /// `axes`.
    pub fn solid_stresses(stresses: &[SolidStress], axes: [&str; 3]) -> Vec<Self> {
        let all = || stresses.iter();
        let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
        let components = pairs.into_iter().enumerate().map(|(k, (one, other))| {
            let name = format!("stress_{}{}_pa", axes[one], axes[other]);
            Self::scalars(&name, all().map(|stress| stress.0[k]))
        });
        let scalars = [
            Self::scalars("von_mises_pa", all().map(SolidStress::von_mises)),
            Self::scalars("hydrostatic_pressure_pa", all().map(SolidStress::pressure)),
        ];
        scalars.into_iter().chain(components).collect()
    }

    /// The contact at some of `count` nodes by status, pressure and friction traction (Pa): `status` (0 open, 1 stick,
    /// 2 slip; -1 elsewhere), `pressure_pa` and `shear_pa`.
    pub fn contact(
        count: usize,
        states: impl Iterator<Item = (u32, ContactStatus, [f64; 2])>,
    ) -> [Self; 3] {
        let (mut codes, mut pressures, mut shears) =
            (vec![-1; count], vec![0.0; count], vec![0.0; count]);
        for (node, status, tractions) in states {
            codes[node as usize] = status as i64;
            [pressures[node as usize], shears[node as usize]] = tractions;
        }
        [
            Self::integers("status", codes),
            Self::scalars("pressure_pa", pressures),
            Self::scalars("shear_pa", shears),
        ]
    }

    /// Values at the nodes of the contact edge among `count` nodes, zero off it.
    pub fn on_edge(name: &str, count: usize, values: impl Iterator<Item = (u32, f64)>) -> Self {
        let mut all = vec![0.0; count];
        values.for_each(|(node, value)| all[node as usize] = value);
        Self::scalars(name, all)
    }

    /// A vector of each node from its nodal frame, as Cartesian `(x, y, z)`.
    pub fn vectors(name: &str, mesh: &Mesh, nodal: &[f64]) -> Self {
        Self { components: 3, ..Self::scalars(name, cartesian_vectors(mesh, nodal)) }
    }
}

/// Turns nodal-frame vectors (`dimension * node_count` values) into Cartesian `(x, y, z)` triples.
pub fn cartesian_vectors(mesh: &Mesh, nodal: &[f64]) -> Vec<f64> {
    let nodes = nodal.chunks_exact(mesh.dimension).enumerate();
    let turned = nodes.map(|(node, u)| {
        let along = |k: usize| u.get(k).copied().unwrap_or(0.0);
        mesh.frame(node) * Vector3::new(along(0), along(1), along(2))
    });
    turned.flat_map(|vector| [vector.x, vector.y, vector.z]).collect()
}

/// The geometry of a mesh, compressed once for any number of files.
#[derive(Clone, Debug)]
pub struct EncodedMesh {
    node_count: usize,
    element_count: usize,
    points: Field,
    /// Connectivity, offsets and types.
    cells: [Field; 3],
}

impl EncodedMesh {
    /// Compresses a mesh.
    pub fn new(mesh: &Mesh) -> io::Result<Self> {
        let array = |name: &str, kind: &'static str, components: usize, bytes: Vec<u8>| {
            Field { name: name.to_owned(), components, kind, bytes }.compressed()
        };
        let points = mesh.nodes.iter().flatten().copied();
        let ends = mesh.element_kinds.iter().scan(0, |end, kind| {
            *end += kind.node_count() as i64;
            Some(*end)
        });
        let types = mesh.element_kinds.iter().map(|kind| kind.vtk_type());
        let nodes = mesh.elements.iter().map(|node| i64::from(*node));
        Ok(Self {
            node_count: mesh.node_count(),
            element_count: mesh.element_count(),
            points: array("Points", "Float64", 3, points.flat_map(f64::to_le_bytes).collect())?,
            cells: [
                Field::integers("connectivity", nodes).compressed()?,
                Field::integers("offsets", ends).compressed()?,
                array("types", "UInt8", 1, types.collect())?,
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

/// Writes a VTU file, lossless: `whole` are names and numbers of the whole file (FieldData: time, frequency, friction).
///
/// # Errors
/// Those of the writer; [`io::ErrorKind::InvalidInput`] for a field whose length does not fit.
pub fn write_vtu(
    out: &mut dyn io::Write,
    mesh: &EncodedMesh,
    whole: &[(&str, f64)],
    point_fields: &[Field],
    cell_fields: &[Field],
) -> io::Result<()> {
    let encoded = |fields: &[Field], count: usize| -> io::Result<Vec<Field>> {
        fields.iter().map(|field| field.of(count)).collect()
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
        for Field { kind, name, components, bytes } in arrays {
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

fn write_whole(out: &mut dyn io::Write, numbers: &[(&str, f64)]) -> io::Result<()> {
    if numbers.is_empty() {
        return Ok(());
    }
    writeln!(out, "<FieldData>")?;
    for (name, value) in numbers {
        writeln!(
            out,
            "<DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{:?} </DataArray>",
            escape(name),
            rounded(*value, 12)
        )?;
    }
    writeln!(out, "</FieldData>")
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
pub fn write_pvd(out: &mut dyn io::Write, entries: &[PvdEntry]) -> io::Result<()> {
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
