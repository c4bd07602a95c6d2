//! The matrices of small motions as files: Matrix Market, NPZ, and what multiplies what.

mod spectrum;

pub use spectrum::{FreeSpectrum, FreeSpectrumSummary};

use super::{framed::write_json, keys::keys, npz::NpzArchive, object};
use crate::common::*;
use frictionsim_output::Entry;
use frictionsim_physics::linalg::MarketMatrix;

/// Table of the unknowns.
pub const UNKNOWNS: &str = "unknowns.csv";
/// Table of the contact points, one for each row of the contact matrices.
pub const CONTACT: &str = "contact.csv";
/// What multiplies what.
pub const DESCRIPTION: &str = "matrices.json";

/// The equation that the matrices belong to.
const LOSSLESS: &str = "(lambda^2 M + lambda C + K) x = 0,";
/// The same with structural damping.
const LOSSY: &str = "(lambda^2 M + lambda C + K + i H) x = 0 where Im lambda > 0,";
/// What each matrix is.
const SUMS: &str = "each a sum over its entries in `matrices`: the file times (mu - \
friction_coefficient)^friction_power";

/// One exported matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportedMatrix {
    /// Name of its files.
    pub name: String,
    /// What it is.
    pub role: MatrixRole,
    /// Its entries.
    pub matrix: MarketMatrix,
}

/// Power of the distance from the friction coefficient of the export.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct FrictionPower {
    /// The power.
    pub friction_power: usize,
}

/// What a matrix is in the problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MatrixRole {
    /// Coefficient of `(mu - mu_0)^power`, `mu_0` the friction coefficient of the export, in the mass `M`, kg/m; of
    /// solid bodies kg.
    Mass(FrictionPower),
    /// In the damping `C`, Pa s; N s/m.
    Damping(FrictionPower),
    /// In the stiffness `K`, Pa; N/m.
    Stiffness(FrictionPower),
    /// In the imaginary part `H` of the stiffness, from structural damping: `K + i H` where `Im lambda > 0`, Pa; N/m.
    Structural(FrictionPower),
    /// Motion of each contact point along the normal of the counterface, out of the unknowns.
    ContactNormal,
    /// Motion of each contact point along the sliding.
    ContactSlip,
}

impl Described for MatrixRole {
    fn describe(path: &str, keys: &mut Vec<Entry>) {
        let meaning = "its `friction_power`: power of the distance from `friction_coefficient`";
        keys.push(Entry::new(format!("{path}.KEY"), meaning));
    }
}

keys! {
    /// One unknown. Its node has the number that the user knows, its direction is along global axes.
    ExportedUnknown, UNKNOWN {
        unknown: usize = "row and column of the matrices, from 0";
        node: usize = "number of its node";
        kind: &'static str = "displacement, or distance from the opposite body";
        direction_x: f64 = "direction of the motion";
        direction_y: f64 = "direction of the motion";
        direction_z: f64 = "direction of the motion";
        x_m: f64 = "place of the node";
        y_m: f64 = "place of the node";
        z_m: f64 = "place of the node";
    }
}

/// One contact point.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportedContactPoint {
    /// Number of its node; none of a point of a solid face.
    pub node: Option<usize>,
    /// Name of its contact, of solid bodies.
    pub contact: Option<String>,
    /// Where it is, m.
    pub place: [f64; 3],
    /// Whether it is pressed; an open one has no contact terms.
    pub is_pressed: bool,
    /// Its share of the surface: a length, m; of solid bodies an area, m2.
    pub weight: f64,
    /// Normal force at the case's friction coefficient, N/m; of solid bodies N.
    pub normal_force: f64,
}

/// Everything that the command exports.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportedSystem {
    /// 2 of plane bodies, whose matrices are for each metre of thickness; 3 of solid ones.
    pub dimension: usize,
    /// Friction coefficient about which the matrices are given: that of the case, or another one that was asked for.
    pub friction_coefficient: f64,
    /// Friction coefficients between which the same contact points are pressed, so that the matrices hold.
    pub friction_range: [f64; 2],
    /// `[alpha, beta]` where `C = alpha M + beta K` exactly.
    pub proportional_damping: Option<[f64; 2]>,
    /// Matrices by role.
    pub matrices: Vec<ExportedMatrix>,
    /// The unknowns, in the order of rows and columns.
    pub unknowns: Vec<ExportedUnknown>,
    /// The contact points, in the order of the rows of the contact matrices.
    pub contact: Vec<ExportedContactPoint>,
    /// Whether it is the sums at its friction coefficient alone.
    pub is_at_one_friction: bool,
}

impl ExportedSystem {
    /// Mass, damping and stiffness at its friction coefficient, without what friction changes and without the contact
    /// rows.
    #[must_use]
    pub fn at_one_friction(mut self) -> Self {
        self.matrices.retain(|own| own.role.told().2 == Some(0));
        Self { is_at_one_friction: true, friction_range: [self.friction_coefficient; 2], ..self }
    }
}

keys! {
    /// Where a matrix is written, and how large it is.
    MatrixEntry {
        name: String = "its name";
        role: MatrixRole = "what it is";
        unit: String = "unit of its entries";
        rows: usize = "number of rows";
        columns: usize = "number of columns";
        entries: usize = "number of entries";
        matrix_market: String = "matrix Market file";
        npz: Option<String> = "file for `scipy.sparse.load_npz`; none of matrices at one friction coefficient";
    }

    /// `summary.json` of `frictionsim matrices`.
    MatricesSummary {
        dofs: usize = "number of unknowns";
        equation: String = "what the matrices are put together to";
        units: String = "what `lambda` is measured in, and what all of this is measured for";
        friction_coefficient: f64 = "friction coefficient about which the matrices are given";
        friction_range: [f64; 2] = "friction coefficients between which the matrices hold";
        proportional_damping: Option<[f64; 2]> = "`[alpha, beta]` where `C = alpha M + beta K` exactly";
        matrices: Vec<MatrixEntry> = "the files";
        unknowns: Option<String> = "table of the unknowns; none of matrices at one friction coefficient";
        contact: Option<String> = "table of the contact points; none of matrices at one friction coefficient";
    }
}

impl MatrixRole {
    /// What it is, its units of plane and of solid bodies, and the power of a part of the problem; none of contact
    /// rows.
    fn told(self) -> (&'static str, [&'static str; 2], Option<usize>) {
        let power = |own: FrictionPower| Some(own.friction_power);
        match self {
            Self::Mass(own) => ("mass", ["kg/m", "kg"], power(own)),
            Self::Damping(own) => ("damping", ["Pa s", "N s/m"], power(own)),
            Self::Stiffness(own) => ("stiffness", ["Pa", "N/m"], power(own)),
            Self::Structural(own) => ("structural damping", ["Pa", "N/m"], power(own)),
            Self::ContactNormal => {
                ("motion of the contact points along the normal", ["1"; 2], None)
            }
            Self::ContactSlip => ("motion of the contact points along the sliding", ["1"; 2], None),
        }
    }

    fn unit(self, dimension: usize) -> &'static str {
        self.told().1[usize::from(dimension == 3)]
    }

    /// What it is, in words, about a friction coefficient.
    fn meaning(self, friction: f64) -> String {
        let (what, _, power) = self.told();
        match power {
            None => what.to_owned(),
            Some(0) => format!("{what} at friction {friction}"),
            Some(power) => format!("{what}: coefficient of (mu - {friction})^{power}"),
        }
    }
}

impl MatricesSummary {
    /// The summary of an exported system.
    pub fn new(system: &ExportedSystem) -> Self {
        let entry = |own: &ExportedMatrix| MatrixEntry {
            name: own.name.clone(),
            role: own.role,
            unit: own.role.unit(system.dimension).to_owned(),
            rows: own.matrix.rows,
            columns: own.matrix.columns,
            entries: own.matrix.entries.len(),
            matrix_market: format!("{}.mtx", own.name),
            npz: (!system.is_at_one_friction).then(|| format!("{}.npz", own.name)),
        };
        let beside = |file: &str| (!system.is_at_one_friction).then(|| file.to_owned());
        let is_lossy = |own: &ExportedMatrix| matches!(own.role, MatrixRole::Structural(_));
        let is_lossy = system.matrices.iter().any(is_lossy);
        let equation = if is_lossy { LOSSY } else { LOSSLESS };
        Self {
            dofs: system.unknowns.len(),
            equation: match system.is_at_one_friction {
                true => format!("{equation} at mu = friction_coefficient"),
                false => format!("{equation} {SUMS}"),
            },
            units: match system.dimension {
                3 => "SI; lambda in rad/s".to_owned(),
                _ => "SI; lambda in rad/s; matrices per metre of thickness".to_owned(),
            },
            friction_coefficient: system.friction_coefficient,
            friction_range: system.friction_range,
            proportional_damping: system.proportional_damping,
            matrices: system.matrices.iter().map(entry).collect(),
            unknowns: beside(UNKNOWNS),
            contact: beside(CONTACT),
        }
    }
}

/// Writes every matrix in both formats, the two tables and what multiplies what; at one friction coefficient the Matrix
/// Market files alone.
pub fn write_matrices(
    folder: &OutputFolder,
    system: &ExportedSystem,
    head: Head<'_>,
    summary: &MatricesSummary,
) -> Result<(), FolderError> {
    for own in &system.matrices {
        let meaning = own.role.meaning(system.friction_coefficient);
        let comment = format!("{meaning}, {}", own.role.unit(system.dimension));
        folder.write_bulk(&format!("{}.mtx", own.name), |out| own.matrix.write(&comment, out))?;
        if system.is_at_one_friction {
            continue;
        }
        folder.write_bulk(&format!("{}.npz", own.name), |out| {
            out.write_all(&compressed_rows(&own.matrix)?)
        })?;
    }
    if system.is_at_one_friction {
        return Ok(());
    }
    let unknowns = system.unknowns.iter().cloned();
    folder.write(UNKNOWNS, |out| write_rows(out, UNKNOWN, unknowns))?;
    let points = if system.dimension == 3 { SOLID_POINT } else { PLANE_POINT };
    let contact = system.contact.iter().cloned().enumerate();
    folder.write(CONTACT, |out| write_rows(out, points, contact))?;
    folder.write(DESCRIPTION, |out| {
        let mut description = object("", head, summary)?;
        if let Some(fields) = description.as_object_mut() {
            for key in ["wall_s", "command"] {
                fields.remove(key);
            }
        }
        write_json(out, &description)
    })
}

/// Its place among all, from 0, and a contact point.
type PointRow = (usize, ExportedContactPoint);

fn status(row: &PointRow) -> &'static str {
    if row.1.is_pressed { "slip" } else { "open" }
}

columns! {
    /// A contact point of a plane body: a node.
    pub(super) PLANE_POINT: row as PointRow;
    point: "row of the contact matrices, from 0" = row.0;
    node: "number of the node" = row.1.node;
    status: "slip, or open without contact terms" = status(row);
    length_m: "its share of the contact" = row.1.weight;
    normal_force_n_per_m: "normal force at the friction coefficient of the case" = row.1.normal_force;

    /// A contact point of solid bodies: a point of a face.
    pub(super) SOLID_POINT: row as PointRow;
    point: "row of the contact matrices, from 0" = row.0;
    contact: "name of the contact, or number of the node"
        = row.1.contact.clone().or(row.1.node.map(|node| node.to_string()));
    status: "slip, or open without contact terms" = status(row);
    area_m2: "its share of the contact" = row.1.weight;
    normal_force_n: "normal force at the friction coefficient of the case" = row.1.normal_force;
    x_m: "its place" = row.1.place[0];
    y_m: "its place" = row.1.place[1];
    z_m: "its place" = row.1.place[2];
}

/// An archive that `scipy.sparse.load_npz` reads as compressed rows.
fn compressed_rows(matrix: &MarketMatrix) -> io::Result<Vec<u8>> {
    let (pointers, columns, values) = matrix.compressed_rows();
    let mut archive = NpzArchive::default();
    let whole = |values: Vec<usize>| values.into_iter().map(|value| value as i64);
    archive.array("indices", &[columns.len()], whole(columns))?;
    archive.array("indptr", &[pointers.len()], whole(pointers))?;
    archive.word("format", "csr")?;
    archive.array("shape", &[2], [matrix.rows as i64, matrix.columns as i64].into_iter())?;
    archive.array("data", &[values.len()], values.into_iter())?;
    archive.finish()
}

/// What is printed.
pub fn print(summary: &MatricesSummary) -> String {
    let mut text = format!("{} unknowns; {}\n\n", summary.dofs, summary.units);
    for entry in &summary.matrices {
        let MatrixEntry { name, entries, unit, .. } = entry;
        let size = format!("{} x {}", entry.rows, entry.columns);
        let means = entry.role.meaning(summary.friction_coefficient);
        let _ = writeln!(text, "  {name:<16} {size:>15} {entries:>9} entries  {means} ({unit})");
    }
    let _ = writeln!(text, "\n{}", summary.equation);
    let [from, to] = summary.friction_range;
    if from < to {
        let [from, to] = [from, to].map(|friction| significant(friction, 5));
        let _ = writeln!(text, "They hold for friction coefficients from {from} to {to}.");
    }
    text
}
