//! Measured mode shapes: tables of points with complex displacements, and universal files with datasets 55.
//!
//! Source of the datasets: SDRC, "Universal file datasets", numbers 15, 55, 2411.

use super::error::{EMPTY, ReadError, not_a_number, not_finite};
use super::field::{Value, parse};
use super::headed::{Row, headed};
use super::text::{decode, first_of, shortened};
use super::uff::{Lines, numbers};
use faer::c64;
use frictionsim_bounds::{LARGEST_COORDINATE, LARGEST_DISPLACEMENT};
use frictionsim_formats::universal_node;
use std::collections::BTreeMap;

/// A measured shape.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredShape {
    /// What the file calls it.
    pub name: String,
    /// Its frequency, Hz, where the file says it.
    pub frequency_hz: Option<f64>,
    /// Points, in the unit of the file.
    pub points: Vec<[f64; 3]>,
    /// Displacement of each point along x, y, z, up to a factor; none in directions that were not measured.
    pub motion: Vec<[Option<c64>; 3]>,
}

/// Reads all shapes of a file: a universal file with datasets 55 and nodes, or a table with a head of names.
///
/// A table has the columns `x`, `y`, `z` (left out in the plane) and, of those measured, `ux`, `uy`, `uz`: complex
/// numbers `0.1+0.2j`, or two columns `ux_re`, `ux_im` each. `mode` tells several shapes apart, `frequency_hz` is each
/// one's frequency.
///
/// # Errors
/// [`ReadError`] with the place: no such column, a cell that is no number, a dataset that ends early.
pub fn read_shapes(bytes: &[u8], source: &str) -> Result<Vec<MeasuredShape>, ReadError> {
    shapes(bytes).map_err(|error| error.of(source))
}

fn shapes(bytes: &[u8]) -> Result<Vec<MeasuredShape>, ReadError> {
    let begin = bytes.iter().position(|b| !b.is_ascii_whitespace());
    let shapes = match begin.is_some_and(|at| bytes[at..].starts_with(b"-1")) {
        true => universal(bytes)?,
        false => table(bytes)?,
    };
    let moves = |u: &c64| u.norm_sqr() > 0.0;
    match shapes.iter().find(|shape| !shape.motion.iter().flatten().flatten().any(moves)) {
        Some(_) => Err(ReadError::no_numbers()),
        None if shapes.is_empty() => Err(ReadError::whole(EMPTY)),
        None => Ok(shapes),
    }
}

/// What each column may be called: places, displacements along each axis (whole or real,
/// imaginary), the mode and its frequency.
const COLUMNS: [&[&str]; 11] = [
    &["x", "x_m"],
    &["y", "y_m"],
    &["z", "z_m"],
    &["ux", "ux_re", "ux_real"],
    &["ux_im", "ux_imag"],
    &["uy", "uy_re", "uy_real"],
    &["uy_im", "uy_imag"],
    &["uz", "uz_re", "uz_real"],
    &["uz_im", "uz_imag"],
    &["mode", "shape"],
    &["frequency_hz", "frequency", "f_hz"],
];

/// The shapes of a table, in the order in which their names come.
fn table(bytes: &[u8]) -> Result<Vec<MeasuredShape>, ReadError> {
    let text = decode(bytes);
    let (names, rows) = headed(&text)?;
    let place = |known: &&[&str]| names.iter().position(|name| known.contains(&name.as_str()));
    let [x, y, z, ux, ux_im, uy, uy_im, uz, uz_im, mode, frequency] = COLUMNS.each_ref().map(place);
    if x.is_none() || y.is_none() || ux.or(uy).or(uz).is_none() {
        let remedy = "the first line names the columns: x, y, z in metres, and of ux, uy, uz those measured. Complex \
            ones are 0.1+0.2j, or two columns ux_re, ux_im. Several shapes have mode and frequency_hz";
        return Err(ReadError::missing("points and displacements", &first_of(&names), remedy));
    }
    let mut shapes: Vec<MeasuredShape> = Vec::new();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    for row in rows {
        let name = row.cell(mode).unwrap_or("1").to_owned();
        let count = shapes.len();
        let place = *known.entry(name.clone()).or_insert(count);
        if place == count {
            let frequency_hz = row.number(frequency, "frequency_hz")?;
            let (points, motion) = (Vec::new(), Vec::new());
            shapes.push(MeasuredShape { name, frequency_hz, points, motion });
        }
        let mut point = [0.0; 3];
        for (value, (column, name)) in point.iter_mut().zip([(x, "x"), (y, "y"), (z, "z")]) {
            if column.is_some() {
                *value = row.number(column, name)?.ok_or_else(|| row.missing(name))?;
            }
        }
        let motion = [
            row.complex([ux, ux_im], "ux")?,
            row.complex([uy, uy_im], "uy")?,
            row.complex([uz, uz_im], "uz")?,
        ];
        shapes[place].points.push(point);
        shapes[place].motion.push(motion);
    }
    Ok(shapes)
}

impl Row<'_> {
    fn value(&self, column: Option<usize>, name: &str) -> Result<Option<c64>, ReadError> {
        let Some(cell) = self.cell(column) else { return Ok(None) };
        let (field, name) = (shortened(cell), format!("`{name}`"));
        let refuse = |problem: String| Err(self.error(cell, problem));
        let value = match parse(cell) {
            Some(Value::Real(value)) => c64::new(value, 0.0),
            Some(Value::Complex(re, im)) => c64::new(re, im),
            _ => return refuse(not_a_number(&field, &name)),
        };
        if value.re.is_nan() {
            return Ok(None);
        }
        match value.norm() < LARGEST_DISPLACEMENT {
            true => Ok(Some(value)),
            false => refuse(not_finite(&field, &name)),
        }
    }

    fn number(&self, column: Option<usize>, name: &str) -> Result<Option<f64>, ReadError> {
        Ok(self.value(column, name)?.map(|value| value.re))
    }

    fn complex(&self, parts: [Option<usize>; 2], name: &str) -> Result<Option<c64>, ReadError> {
        let [real, imaginary] = [self.value(parts[0], name)?, self.value(parts[1], name)?];
        let i = c64::new(0.0, 1.0);
        Ok(real.map(|real| real + i * imaginary.map_or(0.0, |value| value.re)))
    }
}

/// The shapes of a universal file.
fn universal(bytes: &[u8]) -> Result<Vec<MeasuredShape>, ReadError> {
    let mut lines = Lines::of(bytes);
    let mut nodes: BTreeMap<usize, [f64; 3]> = BTreeMap::new();
    let mut found: Vec<Unplaced> = Vec::new();
    while let Some(words) = lines.dataset() {
        let (number, first) = (words.join(" "), lines.count);
        let body = lines.body();
        let damaged = |line: usize, reason: &str| {
            let problem = format!("universal file: dataset {number}: {reason}");
            ReadError::at(first + line + 1, 1, problem)
        };
        let lines = match number.as_str() {
            "15" => 1,
            "2411" | "781" => 2,
            "55" => {
                found.push(shape_of(&body).map_err(|(line, reason)| damaged(line, reason))?);
                continue;
            }
            _ => continue,
        };
        for (k, record) in body.chunks(lines).enumerate() {
            let node = universal_node(record).map_err(|reason| damaged(k * lines, &reason))?;
            if !node.1.iter().all(|x| x.abs() <= LARGEST_COORDINATE) {
                return Err(damaged(k * lines, "a coordinate is beyond 1e12"));
            }
            nodes.extend([node]);
        }
    }
    let placed = |(number, (mut shape, labels)): (usize, Unplaced)| {
        let point = |node: &usize| {
            nodes.get(node).copied().ok_or_else(|| {
                let reason =
                    format!("shape {number} moves node {node}, which no dataset 15 or 2411 places");
                ReadError::damaged("universal file", reason)
            })
        };
        shape.points = labels.iter().map(point).collect::<Result<_, _>>()?;
        Ok(shape)
    };
    (1..).zip(found).map(placed).collect()
}

/// A shape without its points, and the labels of these.
type Unplaced = (MeasuredShape, Vec<usize>);

/// Dataset 55: five lines of text, the form of the data, the mode, then nodes.
fn shape_of(body: &[String]) -> Result<Unplaced, (usize, &'static str)> {
    if body.len() < 8 {
        return Err((body.len(), "it ends within its header"));
    }
    let form = numbers(&body[5]);
    let word = |k: usize| form.get(k).map_or(0, |value| *value as u32);
    let (analysis, characteristic, is_complex) = (word(1), word(2), word(4) == 5);
    if ![2, 3].contains(&characteristic) || ![2, 5].contains(&word(4)) {
        let wanted = "no displacements of three directions, real or complex, in single precision";
        return Err((5, wanted));
    }
    let each = match word(5) {
        0 => [3, 6][usize::from(characteristic == 3)],
        each => each as usize,
    };
    let (of_mode, values) = (numbers(&body[6]), numbers(&body[7]));
    let mode = of_mode.get(3).map_or(1.0, |mode| *mode);
    // Frequency of a real mode, eigenvalue of a complex one.
    let frequency = match analysis {
        2 => values.first().copied(),
        3 | 7 => values.get(1).map(|omega| omega.abs() / std::f64::consts::TAU),
        _ => None,
    };
    let count = each * if is_complex { 2 } else { 1 };
    let (mut labels, mut motion, mut at) = (Vec::new(), Vec::new(), 8);
    while at < body.len() {
        let label = numbers(&body[at]);
        let [label] = label[..] else { return Err((at, "the number of a node is expected")) };
        at += 1;
        let mut own = Vec::new();
        while own.len() < count {
            let line = body.get(at).ok_or((at, "a node ends early"))?;
            let more = numbers(line);
            if more.is_empty() {
                return Err((at, "numbers are expected"));
            }
            if more.iter().any(|value| !(value.abs() < LARGEST_DISPLACEMENT)) {
                return Err((at, "a displacement is not finite, or beyond 1e100"));
            }
            own.extend(more);
            at += 1;
        }
        let value = |axis: usize| match is_complex {
            true => c64::new(own[2 * axis], own[2 * axis + 1]),
            false => c64::new(own[axis], 0.0),
        };
        labels.push(label as usize);
        motion.push([0, 1, 2].map(|axis| (axis < each).then(|| value(axis))));
    }
    let (frequency_hz, points) = (frequency.filter(|f| *f > 0.0), Vec::new());
    Ok((MeasuredShape { name: format!("{mode}"), frequency_hz, points, motion }, labels))
}
