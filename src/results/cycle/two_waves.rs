//! Motions of two frequencies: words, tables, summary.

use super::{CycleFrame, CycleReport};
use crate::cycle::{BranchEnd, Measured, TwoWaveBranch, TwoWaveMotion};
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::quantity::significant;
use crate::results::table::{Column, write_rows};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// What two waves that may live together come to.
#[derive(Clone, Debug)]
pub struct TwoWaveResult {
    /// Harmonics of the wave that loses its stability and of the one that grows on it.
    pub harmonics: [usize; 2],
    /// Their motion, or why there is none.
    pub outcome: Result<FoundTwoWaves, String>,
}

/// A motion of two frequencies, and its branch.
#[derive(Clone, Debug)]
pub struct FoundTwoWaves {
    /// The motion.
    pub motion: TwoWaveMotion,
    /// Points along both phases.
    pub sides: [usize; 2],
    /// A transient that started on it.
    pub confirmation: Option<Measured>,
    /// Whether that still has both frequencies within a thousandth.
    pub is_confirmed: bool,
    /// Its branch over the case's parameter.
    pub branch: Option<TwoWaveBranch>,
    /// The whole field over one period of the first wave; the second is elsewhere by then.
    pub frames: Vec<CycleFrame>,
}

/// A motion of two frequencies in the summary.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoWaveSummary {
    /// Harmonics of both waves.
    pub harmonics: [usize; 2],
    /// Frequencies, Hz.
    pub frequencies_hz: Option<[f64; 2]>,
    /// Amplitudes of the tangential displacement of the edge, m.
    pub amplitudes_m: Option<[f64; 2]>,
    /// Fractions of the edge that stick, slip, are open, over time.
    pub status: Option<[f64; 3]>,
    /// Points along both phases.
    pub points: Option<[usize; 2]>,
    /// Power of the rotor, W.
    pub external_w: Option<f64>,
    /// Residual of the energy balance, relative to it.
    pub balance_residual: Option<f64>,
    /// Frequencies of a transient that started on it, Hz.
    pub transient_frequencies_hz: Option<[f64; 2]>,
    /// Whether these are its own within a thousandth.
    pub is_confirmed: Option<bool>,
    /// Values of the parameter at which the weaker wave vanishes, in units of its key.
    pub births: Vec<f64>,
    /// Why the branch ends, at either end.
    pub ends: Option<[String; 2]>,
    /// Why there is none.
    pub error: Option<String>,
}

impl TwoWaveSummary {
    /// Of a result.
    pub fn of(report: &CycleReport<'_>, result: &TwoWaveResult) -> Self {
        let found = result.outcome.as_ref().ok();
        let motion = found.map(|found| &found.motion);
        let branch = found.and_then(|found| found.branch.as_ref());
        let births = branch.map_or(Vec::new(), |branch| {
            let births = branch.births.iter();
            births.map(|&value| branch.parameter.in_key_units(value)).collect()
        });
        Self {
            harmonics: result.harmonics,
            frequencies_hz: motion.map(TwoWaveMotion::frequencies_hz),
            amplitudes_m: motion.map(|motion| motion.amplitudes),
            status: motion.map(|motion| motion.fractions),
            points: found.map(|found| found.sides),
            external_w: motion.map(|motion| motion.powers.external * report.thickness),
            balance_residual: motion.map(|motion| motion.powers.balance_residual()),
            transient_frequencies_hz: found
                .and_then(|found| found.confirmation)
                .map(|own| own.frequencies.map(|omega| omega / TAU)),
            is_confirmed: found.map(|found| found.is_confirmed),
            births,
            ends: branch.map(|branch| branch.ends.map(|end| described(end).to_owned())),
            error: result.outcome.as_ref().err().cloned(),
        }
    }
}

/// Why a branch of two waves ends, in words.
fn described(end: BranchEnd) -> &'static str {
    match end {
        BranchEnd::Birth => "one wave vanishes",
        other => other.describe(),
    }
}

/// Writes one table for each pair of waves.
///
/// # Errors
/// Those of the folder.
pub fn write_two_waves(folder: &OutputFolder, report: &CycleReport<'_>) -> Result<(), FolderError> {
    for result in &report.two_waves {
        let Ok(found) = &result.outcome else {
            continue;
        };
        let [first, second] = result.harmonics;
        let parameter = found.branch.as_ref().map(|branch| branch.parameter);
        let value = |motion: &TwoWaveMotion| {
            parameter.map_or(0.0, |own| own.in_key_units(own.of(&motion.state.point)))
        };
        let columns: &[Column<'_, &TwoWaveMotion>] = &[
            (parameter.map_or("point", |own| own.key()), &|m| value(m).into()),
            ("frequency_1_hz", &|m| m.frequencies_hz()[0].into()),
            ("frequency_2_hz", &|m| m.frequencies_hz()[1].into()),
            ("amplitude_1_m", &|m| m.amplitudes[0].into()),
            ("amplitude_2_m", &|m| m.amplitudes[1].into()),
            ("stick", &|m| m.fractions[0].into()),
            ("slip", &|m| m.fractions[1].into()),
            ("open", &|m| m.fractions[2].into()),
            ("external_w", &|m| (m.powers.external * report.thickness).into()),
            ("balance_residual", &|m| m.powers.balance_residual().into()),
        ];
        let rows: Vec<&TwoWaveMotion> = match &found.branch {
            Some(branch) => branch.motions.iter().collect(),
            None => vec![&found.motion],
        };
        let name = format!("two-waves-n{first}-n{second}.csv");
        folder.write(&name, |out| write_rows(out, columns, rows))?;
    }
    Ok(())
}

/// What is printed of two waves.
pub fn print_two_waves(out: &mut String, result: &TwoWaveResult) {
    let [first, second] = result.harmonics;
    let name = format!("n = {first} and {second} together");
    let found = match &result.outcome {
        Ok(found) => found,
        Err(reason) => {
            let _ = writeln!(out, "{name}: {reason}");
            return;
        }
    };
    let ([a, b], [stick, slip, open]) = (found.motion.frequencies_hz(), found.motion.fractions);
    let share = found.motion.amplitudes[1] / found.motion.amplitudes[0];
    let _ = writeln!(
        out,
        "{name}: {a:.2} and {b:.2} Hz, the second with {share:.2} of the first, stick {stick:.3}, slip {slip:.3}, open {open:.3} \
         ({} x {} phases)",
        found.sides[0], found.sides[1],
    );
    if let Some(own) = found.confirmation {
        let [a, b] = own.frequencies.map(|omega| omega / TAU);
        let verdict = match found.is_confirmed {
            true => "stays on it",
            false => "has OTHER frequencies",
        };
        let _ = writeln!(out, "{name}: a transient {verdict}: {a:.2} and {b:.2} Hz");
    }
    if let Some(branch) = &found.branch {
        let key = branch.parameter.key();
        let births = branch.births.iter();
        let births = births.map(|&value| significant(branch.parameter.in_key_units(value), 5));
        let births: Vec<String> = births.collect();
        let born = match births.is_empty() {
            true => String::new(),
            false => format!(", one wave alone at {key} = {}", births.join(", ")),
        };
        let _ = writeln!(
            out,
            "{name}: {} motions over {key} ({}; {}){born}",
            branch.motions.len(),
            described(branch.ends[0]),
            described(branch.ends[1]),
        );
    }
}
