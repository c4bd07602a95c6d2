//! Tables of measured modes: one row for each, cells left empty where something is not known.

use super::error::{ReadError, not_a_number};
use super::field::number;
use super::headed::{Row, headed};
use super::text::{decode, first_of, shortened};

/// A measured mode, or a line of a squeal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredMode {
    /// Line of the table, from 1.
    pub line: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Real part, Hz: as given, or from a damping factor, `-zeta f / sqrt(1 - zeta^2)`.
    pub real_hz: Option<f64>,
    /// Nodal diameters.
    pub harmonic: Option<usize>,
    /// Standard deviation of frequency and real part, Hz.
    pub sigma_hz: Option<f64>,
    /// Whether it was heard: only an unstable mode can be it.
    pub is_unstable: bool,
}

/// The columns that are known; others are passed over.
const COLUMNS: [&[&str]; 8] = [
    &["frequency_hz", "frequency", "f_hz", "f"],
    &["frequency_khz", "f_khz"],
    &["real_hz", "real"],
    &["damping_factor", "damping_ratio", "zeta"],
    &["harmonic", "n", "nodal_diameters"],
    &["sigma_hz", "sigma"],
    &["unstable"],
    &["damping_%", "damping_factor_%", "damping_ratio_%", "zeta_%", "damping_percent"],
];

/// Words in the name of a column that holds damping.
const DAMPING: [&str; 6] = ["damp", "zeta", "q_factor", "quality", "loss", "decrement"];

/// Reads a table with a head of names, of which `frequency_hz` must be one and `real_hz`, `damping_factor`, `harmonic`,
/// `sigma_hz` and `unstable` (1 or 0) may be; units may stand in brackets, damping in per cent.
///
/// # Errors
/// [`ReadError`] with the place: no such column, a cell that is no number or no possible value.
pub fn read_modes(bytes: &[u8], source: &str) -> Result<Vec<MeasuredMode>, ReadError> {
    modes(bytes).map_err(|error| error.of(source))
}

fn modes(bytes: &[u8]) -> Result<Vec<MeasuredMode>, ReadError> {
    let text = decode(bytes);
    let (names, rows) = headed(&text)?;
    let place = |known: &&[&str]| names.iter().position(|name| known.contains(&name.as_str()));
    let places = COLUMNS.each_ref().map(place);
    if places[0].is_none() && places[1].is_none() {
        let remedy = "the first line names the columns: frequency_hz, and where known real_hz, \
            damping_factor, harmonic, sigma_hz, unstable";
        return Err(ReadError::missing("frequencies", &first_of(&names), remedy));
    }
    // What is damping by another name, or in a unit that is not said, would be left out of the fit.
    let is_damping = |name: &&String| DAMPING.iter().any(|word| name.contains(word));
    if let Some(name) = names.iter().find(is_damping)
        && [2, 3, 7].iter().all(|&column| places[column].is_none())
    {
        let remedy =
            "give it as `damping_factor` (zeta), in per cent as `damping_%`, or as `real_hz`";
        return Err(ReadError::whole(format!(
            "the damping in column `{name}` is not read; {remedy}"
        )));
    }
    let modes = rows.map(|row| mode(&row, &places)).collect::<Result<Vec<_>, ReadError>>()?;
    if modes.is_empty() {
        return Err(ReadError::no_numbers());
    }
    if modes.len() > MOST_MODES {
        let problem = format!(
            "{} rows, one for each mode, are too many; is this a frequency response? `frictionsim \
             identify` finds its modes",
            modes.len()
        );
        return Err(ReadError::whole(problem));
    }
    Ok(modes)
}

/// Most lines of a list of modes: every one is compared with every mode of the model in each step of a fit.
const MOST_MODES: usize = 1000;
/// Frequencies that a mode has, Hz.
const LOWEST_HZ: f64 = 1e-3;
const HIGHEST_HZ: f64 = 1e9;

fn mode(row: &Row<'_>, places: &[Option<usize>; 8]) -> Result<MeasuredMode, ReadError> {
    // The number in a column, if the row has one there and `admits` takes it.
    let cell = |column: usize, admits: fn(f64) -> bool| {
        let Some(cell) = row.cell(places[column]) else { return Ok(None) };
        let (field, name) = (shortened(cell), format!("`{}`", COLUMNS[column][0]));
        let value = match cell {
            // As the tables of the program's own say it.
            "true" => Some(1.0),
            "false" => Some(0.0),
            cell => number(cell),
        };
        match value {
            None => Err(row.error(cell, not_a_number(&field, &name))),
            Some(value) if value.is_nan() => Ok(None),
            Some(value) if !admits(value) => {
                let remedy = "correct it, or leave the cell empty";
                let problem = format!("`{field}` is not a valid value of column {name}; {remedy}");
                Err(row.error(cell, problem))
            }
            Some(value) => Ok(Some(value)),
        }
    };
    let positive = |value: f64| value > 0.0 && value.is_finite();
    let plausible = |value: f64| (LOWEST_HZ..=HIGHEST_HZ).contains(&value);
    let hertz = cell(0, plausible)?;
    let kilohertz = cell(1, plausible)?.map(|value| 1e3 * value);
    let frequency_hz = hertz.or(kilohertz).ok_or_else(|| row.missing("frequency_hz"))?;
    let percent = cell(7, |zeta| zeta.abs() < 100.0)?;
    let damping = cell(3, |zeta| zeta.abs() < 1.0)?.or(percent.map(|value| value / 100.0));
    let damped = damping.map(|zeta| -zeta * frequency_hz / (1.0 - zeta * zeta).sqrt());
    let harmonic = cell(4, |n| n >= 0.0 && n.fract() == 0.0 && n < 1e6)?;
    Ok(MeasuredMode {
        line: row.line,
        frequency_hz,
        real_hz: cell(2, f64::is_finite)?.or(damped),
        harmonic: harmonic.map(|n| n as usize),
        sigma_hz: cell(5, positive)?,
        is_unstable: cell(6, |flag| flag == 0.0 || flag == 1.0)? == Some(1.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_may_be_empty_and_columns_in_any_order() {
        let text = "# bench\nunstable;frequency_khz;harmonic;note\ntrue;6,0;;loud\n;7,5;2;\n";
        let modes = read_modes(text.as_bytes(), "modes.csv").unwrap();
        assert_eq!(modes.len(), 2);
        assert_eq!(modes[0].frequency_hz, 6000.0);
        assert_eq!((modes[0].is_unstable, modes[0].harmonic), (true, None));
        assert_eq!((modes[1].is_unstable, modes[1].harmonic), (false, Some(2)));
        assert_eq!(modes[1].line, 4);
    }

    #[test]
    fn a_damping_factor_is_a_real_part_and_units_stand_in_names() {
        for text in [
            "frequency_hz,damping_factor\n1000,0.6\n",
            "\u{feff}Frequency [Hz];Damping ratio (%)\r\n1000,0;60,0\r\n",
            "f [kHz]\tZeta\n1\t0.6\n",
        ] {
            let modes = read_modes(text.as_bytes(), "modes.csv").unwrap();
            // tan(asin(0.6)) = 0.75.
            assert_eq!(modes[0].frequency_hz, 1000.0);
            assert!((modes[0].real_hz.unwrap() + 750.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_response_in_place_of_a_list_of_modes_is_refused_by_its_length() {
        let rows: String = (1..=1001).map(|i| format!("{i},0.1\n")).collect();
        let error = read_modes(format!("f,real_hz\n{rows}").as_bytes(), "frf.csv").unwrap_err();
        assert!(error.problem.starts_with("1001 rows"), "{error}");
        assert!(error.to_string().contains("frictionsim identify"));
    }

    #[test]
    fn bad_cells_are_named_with_their_place() {
        for (text, parts) in [
            ("f,real_hz\n1000,x\n", ["modes.csv:2:6", "`x`"]),
            ("f,harmonic\n1000,1.5\n", ["modes.csv:2:6", "`1.5`"]),
            ("f,sigma_hz\n-5,1\n", ["modes.csv:2:1", "`-5`"]),
            ("f\n1e-320\n", ["modes.csv:2:1", "`1e-320`"]),
            ("hertz\n5\n", ["modes.csv: ", "frequency_hz"]),
            ("f,Damping\n5,1\n", ["`damping` is not read", "damping_%"]),
            ("f,q_factor\n5,1\n", ["`q_factor` is not read", "damping_factor"]),
            ("f\n", ["modes.csv", "no row of numbers"]),
            ("# nothing\n", ["modes.csv", "empty"]),
            ("f,n\n,1\n", ["modes.csv:2", "`frequency_hz`"]),
        ] {
            let error = read_modes(text.as_bytes(), "modes.csv").unwrap_err().to_string();
            assert!(parts.iter().all(|part| error.contains(part)), "{error}");
        }
    }
}
