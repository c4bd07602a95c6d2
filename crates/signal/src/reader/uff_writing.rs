//! Universal files: responses and signals (dataset 58 in text), meshes (164, 2411, 2412), complex mode shapes (55).
//!
//! Source: SDRC, "Universal file datasets", by their numbers.

use super::time_signal::SignalFile;
use super::uff::{FREQUENCY_RESPONSE, ORDINATES, TIME, TIME_AXIS};
use crate::ResponseQuantity;
use faer::c64;
use std::fmt::Write as _;
use std::io::{self, Write};

/// A node by its label and a direction there, 1 to 3 for x, y, z; zeros where they are not known.
pub type Place = (usize, u32);

/// A frequency response as dataset 58 in text, complex double precision, with the places of motion and force.
pub fn write_response(
    name: &str,
    quantity: ResponseQuantity,
    (f, values): (&[f64], &[c64]),
    places: [Place; 2],
) -> String {
    let (ordinate, _) = ORDINATES[quantity as usize];
    let step = (f[f.len() - 1] - f[0]) / (f.len() - 1) as f64;
    let mut numbered = f.iter().enumerate();
    let is_even = numbered.all(|(k, f_k)| (f_k - f[0] - k as f64 * step).abs() <= 1e-6 * step);
    let axis = if is_even { [f[0], step] } else { [0.0; 2] };
    let form = [6, values.len(), usize::from(is_even)];
    let mut out = header(name, (FREQUENCY_RESPONSE, places), form, axis, [18, ordinate, 13]);
    if is_even {
        for two in values.chunks(2) {
            out += &(complex_row(two, 20, 12) + "\n");
        }
    } else {
        for (f, z) in f.iter().zip(values) {
            out += &(axis_value(*f) + &complex_row(&[*z], 20, 12) + "\n");
        }
    }
    out + "    -1\n"
}

/// The channels of a signal as datasets 58 in text, double precision.
pub fn write_signal(file: &SignalFile) -> String {
    let mut out = String::new();
    for channel in &file.channels {
        let axis = [file.start, 1.0 / file.sampling_rate];
        let (kind, form) = ((TIME, [(0, 0); 2]), [4, channel.samples.len(), 1]);
        out += &header(&channel.name, kind, form, axis, [TIME_AXIS, 0, 0]);
        for four in channel.samples.chunks(4) {
            out.extend(four.iter().map(|v| fortran(*v, 20, 12)));
            out.push('\n');
        }
        out += "    -1\n";
    }
    out
}

/// A mesh: units (164, SI), nodes (2411) by label and place (m), elements (2412) by descriptor and
/// labels of nodes in the order of the descriptor, numbered from 1.
pub fn write_mesh(
    out: &mut dyn Write,
    nodes: &mut dyn Iterator<Item = (usize, [f64; 3])>,
    elements: &mut dyn Iterator<Item = (usize, Vec<usize>)>,
) -> io::Result<()> {
    let units = [1.0, 1.0, 1.0].map(|factor| fortran(factor, 25, 17)).concat();
    writeln!(out, "    -1\n   164\n         1SI: metre (newton)           2\n{units}")?;
    writeln!(out, "{}\n    -1\n    -1\n  2411", fortran(273.15, 25, 17))?;
    for (label, place) in nodes {
        writeln!(out, "{label:>10}{:>10}{:>10}{:>10}", 1, 1, 11)?;
        writeln!(out, "{}", place.map(|x| fortran(x, 25, 16)).concat())?;
    }
    writeln!(out, "    -1\n    -1\n  2412")?;
    for (number, (descriptor, labels)) in elements.enumerate() {
        let count = labels.len();
        writeln!(out, "{:>10}{descriptor:>10}{:>10}{:>10}{:>10}{count:>10}", number + 1, 1, 1, 7)?;
        for eight in labels.chunks(8) {
            writeln!(out, "{}", whole_row(eight))?;
        }
    }
    writeln!(out, "    -1")
}

/// A complex mode as dataset 55: displacements at nodes in single precision, which is what its form
/// `6E13.5` holds.
///
/// Its name of up to 80 characters of ASCII, its number in the file, from 1, its eigenvalue, 1/s, and of each node the
/// label and the displacement along x, y, z.
pub fn write_mode(
    out: &mut dyn Write,
    (name, number): (&str, usize),
    eigenvalue: c64,
    shape: impl Iterator<Item = (usize, [c64; 3])>,
) -> io::Result<()> {
    let row = |values: &[c64]| complex_row(values, 13, 5);
    writeln!(out, "    -1\n    55\n{name}\nNONE\nNONE\nNONE\nNONE")?;
    // Structural, complex eigenvalue, three translations, displacement, complex, three values a node.
    writeln!(out, "{}\n{}", whole_row(&[1, 3, 2, 8, 5, 3]), whole_row(&[2, 6, 1, number]))?;
    // The eigenvalue; factors of modal mass and damping are not scaled.
    let one = c64::new(1.0, 0.0);
    writeln!(out, "{}", row(&[eigenvalue, one, one]))?;
    for (label, displacement) in shape {
        writeln!(out, "{label:>10}\n{}", row(&displacement))?;
    }
    writeln!(out, "    -1")
}

/// Opening lines and the eleven records of a dataset.
fn header(
    name: &str,
    (kind, places): (u32, [Place; 2]),
    [form, count, even]: [usize; 3],
    [first, step]: [f64; 2],
    [axis, ordinate, divided_by]: [u32; 3],
) -> String {
    let name: String = name.chars().filter(char::is_ascii).take(80).collect();
    let mut out = format!("    -1\n    58\n{name}\nNONE\nNONE\nNONE\nNONE\n");
    let places = places.map(|(node, along)| format!(" {:<10}{node:>10}{along:>4}", "NONE"));
    let _ = writeln!(out, "{kind:>5}{:>10}{:>5}{:>10}{}", 0, 0, 0, places.concat());
    let numbers = [first, step, 0.0].map(axis_value).concat();
    let _ = writeln!(out, "{form:>10}{count:>10}{even:>10}{numbers}");
    for kind in [axis, ordinate, divided_by, 0] {
        let _ = writeln!(out, "{kind:>10}{:>5}{:>5}{:>5} {:<20} {:<20}", 0, 0, 0, "NONE", "NONE");
    }
    out
}

/// Whole numbers side by side.
fn whole_row(numbers: &[usize]) -> String {
    numbers.iter().map(|number| format!("{number:>10}")).collect()
}

/// Complex numbers side by side, see [`fortran`].
fn complex_row(values: &[c64], width: usize, decimals: usize) -> String {
    let parts = values.iter().flat_map(|z| [z.re, z.im]);
    parts.map(|part| fortran(part, width, decimals)).collect()
}

/// A number of an axis in 13 columns: with 5 decimals where these are all, else with what has room behind a blank.
fn axis_value(value: f64) -> String {
    let short = fortran(value, 13, 5);
    let mut longer = (5..11).rev().map(|decimals| format!("{value:.decimals$E}"));
    match short.trim().parse() == Ok(value) {
        true => short,
        false => longer.find(|text| text.len() < 13).map_or(short, |text| format!("{text:>13}")),
    }
}

/// A number as Fortran writes it with `Ew.d`.
fn fortran(value: f64, width: usize, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{:>width$}", format!("{mantissa}E{sign}{:02}", exponent.abs()))
}
