//! Responses and signals as universal files, dataset 58 in text.

use super::contents::{NamedResponse, SignalFile};
use super::uff::{FREQUENCY_RESPONSE, TIME, TIME_AXIS};
use crate::ResponseQuantity;
use faer::c64;
use std::fmt::Write as _;

/// A frequency response as dataset 58 in text, complex double precision.
pub fn write_response(named: &NamedResponse) -> String {
    let response = &named.response;
    let ordinate = match response.quantity() {
        ResponseQuantity::Receptance => 8,
        ResponseQuantity::Mobility => 11,
        ResponseQuantity::Accelerance => 12,
    };
    let (f, values) = (response.frequencies_hz(), response.values());
    let step = (f[f.len() - 1] - f[0]) / (f.len() - 1) as f64;
    let mut numbered = f.iter().enumerate();
    let is_even = numbered.all(|(k, f_k)| (f_k - f[0] - k as f64 * step).abs() <= 1e-6 * step);
    let axis = if is_even { [f[0], step] } else { [0.0; 2] };
    let form = [6, values.len(), usize::from(is_even)];
    let mut out = header(&named.name, FREQUENCY_RESPONSE, form, axis, [18, ordinate, 13]);
    let number = |z: &c64| fortran(z.re, 20, 12) + &fortran(z.im, 20, 12);
    if is_even {
        for two in values.chunks(2) {
            out += &two.iter().map(number).collect::<String>();
            out.push('\n');
        }
    } else {
        for (f, z) in f.iter().zip(values) {
            out += &(fortran(*f, 13, 5) + &number(z) + "\n");
        }
    }
    out + "    -1\n"
}

/// The channels of a signal as datasets 58 in text, double precision.
pub fn write_signal(file: &SignalFile) -> String {
    let mut out = String::new();
    for channel in &file.channels {
        let axis = [file.start, 1.0 / file.sampling_rate];
        out += &header(&channel.name, TIME, [4, channel.samples.len(), 1], axis, [TIME_AXIS, 0, 0]);
        for four in channel.samples.chunks(4) {
            let row: String = four.iter().map(|v| fortran(*v, 20, 12)).collect();
            out += &row;
            out.push('\n');
        }
        out += "    -1\n";
    }
    out
}

/// Opening lines and the eleven records of a dataset.
fn header(
    name: &str,
    kind: u32,
    [form, count, even]: [usize; 3],
    [first, step]: [f64; 2],
    [axis, ordinate, divided_by]: [u32; 3],
) -> String {
    let name: String = name.chars().filter(char::is_ascii).take(80).collect();
    let mut out = format!("    -1\n    58\n{name}\nNONE\nNONE\nNONE\nNONE\n");
    let place = format!(" {:<10}{:>10}{:>4}", "NONE", 0, 0);
    let _ = writeln!(out, "{kind:>5}{:>10}{:>5}{:>10}{place}{place}", 0, 0, 0);
    let numbers = [first, step, 0.0].map(|v| fortran(v, 13, 5)).concat();
    let _ = writeln!(out, "{form:>10}{count:>10}{even:>10}{numbers}");
    for kind in [axis, ordinate, divided_by, 0] {
        let _ = writeln!(out, "{kind:>10}{:>5}{:>5}{:>5} {:<20} {:<20}", 0, 0, 0, "NONE", "NONE");
    }
    out
}

/// A number as Fortran writes it with `Ew.d`.
fn fortran(value: f64, width: usize, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{:>width$}", format!("{mantissa}E{sign}{:02}", exponent.abs()))
}
