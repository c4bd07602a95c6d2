//! Stability of limit cycles: tables, summary and words.

use super::CycleResult;
use crate::cycle::{CycleBranch, CycleStability, FloquetExponent, LimitCycle, Verdict};
use crate::results::summary::present;
use crate::results::table::{Column, write_rows};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::io::{self, Write};

/// What is known of the stability of a cycle.
pub type Finding = Option<Result<CycleStability, String>>;

/// Its analysis, where there is one.
pub fn known(finding: &Finding) -> Option<&CycleStability> {
    finding.as_ref().and_then(|finding| finding.as_ref().ok())
}

/// Writes the leading exponents, one row each: for the cycle at the case's own operating point, then along the
/// branch.
///
/// # Errors
/// Those of the writer.
pub fn write_stability(out: &mut dyn Write, result: &CycleResult) -> io::Result<()> {
    let key = result.branch.as_ref().map(|branch| branch.parameter.key());
    let columns: &[Column<'_, (f64, &FloquetExponent)>] = &[
        (key.unwrap_or("point"), &|row| row.0.into()),
        ("class", &|row| row.1.class.into()),
        ("growth_rate_per_s", &|row| row.1.exponent.re.into()),
        ("wave_frequency_rad_per_s", &|row| row.1.exponent.im.into()),
        ("harmonic", &|row| row.1.harmonic.into()),
        ("frequency_hz", &|row| row.1.frequency_hz.into()),
        ("uncertainty_per_s", &|row| row.1.uncertainty.into()),
    ];
    let mut findings: Vec<(f64, &Finding)> = Vec::new();
    match (&result.branch, &result.cycle) {
        (Some(branch), Ok(own)) => {
            findings.push((value(branch, own), &result.stability));
            let along = branch.cycles.iter().map(|cycle| value(branch, cycle));
            findings.extend(along.zip(&result.branch_stability));
        }
        _ => findings.push((0.0, &result.stability)),
    }
    let rows = findings.into_iter().flat_map(|(at, finding)| {
        let exponents = known(finding).into_iter().flat_map(|found| &found.exponents);
        exponents.map(move |exponent| (at, exponent))
    });
    write_rows(out, columns, rows)
}

fn value(branch: &CycleBranch, cycle: &LimitCycle) -> f64 {
    let value = branch.parameter.of(&cycle.state.point);
    branch.parameter.in_key_units(value)
}

/// Stability of a cycle, in the summary.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum StabilitySummary {
    /// It is known.
    Known {
        /// `stable`, `unstable` or `undecided`.
        verdict: String,
        /// The same as a boolean; none if undecided.
        is_stable: Option<bool>,
        /// Circumferential harmonics that grow.
        growing_harmonics: Vec<usize>,
        /// The leading perturbation.
        leading: Option<ExponentSummary>,
    },
    /// It could not be found.
    Failed {
        /// Why.
        error: String,
    },
}

/// An exponent of a perturbation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExponentSummary {
    /// Growth rate, 1/s.
    pub growth_rate_per_s: f64,
    /// Frequency in the frame of the wave, rad/s.
    pub wave_frequency_rad_per_s: f64,
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// Frequency in the fixed frame, Hz.
    pub frequency_hz: f64,
    /// Uncertainty of the growth rate, 1/s.
    pub uncertainty_per_s: Option<f64>,
}

impl StabilitySummary {
    /// Of a finding; none where it was not asked for.
    pub fn of(finding: &Finding) -> Option<Self> {
        let stability = match finding.as_ref()? {
            Ok(stability) => stability,
            Err(error) => {
                return Some(Self::Failed { error: error.clone() });
            }
        };
        let leading = stability.leading().map(|leading| ExponentSummary {
            growth_rate_per_s: leading.exponent.re,
            wave_frequency_rad_per_s: leading.exponent.im,
            harmonic: leading.harmonic,
            frequency_hz: leading.frequency_hz,
            uncertainty_per_s: present(leading.uncertainty),
        });
        let verdict = stability.verdict();
        Some(Self::Known {
            verdict: verdict.word().to_owned(),
            is_stable: (verdict != Verdict::Undecided).then_some(verdict == Verdict::Stable),
            growing_harmonics: stability.growing_harmonics(),
            leading,
        })
    }
}

/// One line on the cycle at the case's own operating point, and one for each change along the branch.
pub fn print_stability(out: &mut String, result: &CycleResult) {
    let family = result.family;
    match &result.stability {
        None => {}
        Some(Err(error)) => {
            let _ = writeln!(out, "{family}: {error}");
        }
        Some(Ok(stability)) => {
            let _ = match stability.leading() {
                Some(leading) => writeln!(
                    out,
                    "{family}: {}; the leading perturbation, {} at {:.0} Hz, {} at {:.0} +- {:.0} 1/s",
                    match stability.verdict() {
                        Verdict::Unstable => "UNSTABLE",
                        verdict => verdict.word(),
                    },
                    diameters(leading.harmonic),
                    leading.frequency_hz,
                    if leading.exponent.re > 0.0 { "grows" } else { "decays" },
                    leading.exponent.re.abs(),
                    leading.uncertainty,
                ),
                None => writeln!(out, "{family}: stable; every perturbation decays fast"),
            };
        }
    }
    let key = result.branch.as_ref().map_or("", |branch| branch.parameter.key());
    for change in &result.stability_changes {
        let value = result
            .branch
            .as_ref()
            .map_or(f64::NAN, |branch| branch.parameter.in_key_units(change.value));
        let _ = writeln!(
            out,
            "{family}: stability changes at {key} = {value:.1} ({} at {:.0} Hz: {})",
            diameters(change.harmonic),
            change.frequency_hz,
            change.kind(family.harmonic),
        );
    }
}

fn diameters(harmonic: usize) -> String {
    match harmonic {
        1 => "1 nodal diameter".to_owned(),
        n => format!("{n} nodal diameters"),
    }
}
