//! `frictionsim uncertainty`: how likely is squeal, and which parameter decides it.

use super::prelude::*;
use super::share::ShareOptions;
use super::sweep::{keep_piece, kept_pieces};
use crate::case::find_key;
use crate::results::uncertainty::{Sample, samples_table};
use crate::results::{Finding, declared, summary_of, write_table};
use crate::study::uncertainty::{BLOCK, Design, Sampler, curves, summarize};
use serde_json::Map;

/// Name of the samples in the file of a block.
const SAMPLES: &str = "samples";

/// How likely squeal is, and which parameter decides it
///
/// Draws samples of the keys of uncertainty.distributions and finds the critical frictions of each. Gives the
/// probability of an unstable mode at the case's friction coefficient and the distribution of the lowest critical
/// friction. Also gives each parameter's share of its variance. Finished blocks of samples are kept: a killed run
/// continues with --resume, and several processes may work on one folder.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
    #[command(flatten)]
    share: ShareOptions,
    /// Probability of squeal over a design parameter: KEY=FROM:TO or KEY=FROM:TO:COUNT (repeatable)
    #[arg(long, value_name = "KEY=FROM:TO")]
    robust: Vec<Design>,
    /// Probability that --robust asks to get below
    #[arg(long, value_name = "P", default_value = "0.05", requires = "robust")]
    bound: f64,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let session = Session::start("uncertainty", &asked.options)?;
    for design in &asked.robust {
        check(design, &session.case)?;
    }
    if !(asked.bound > 0.0 && asked.bound < 1.0) {
        let bound = asked.bound;
        return Err(Failure::usage(format!("--bound {bound}: a probability between 0 and 1")));
    }
    let case = session.case.clone();
    let uncertainty = case.require_uncertainty()?;
    let sampler = Sampler::new(&case)?;
    let workers = session.manifest.threads as f64;
    session.check_memory(workers * case.memory("cea").0)?;
    let count = uncertainty.samples.div_ceil(BLOCK);
    let blocks = asked.share.pieces(count);
    let output = &asked.options.output;
    let folder = asked.share.open(&session, count, &blocks)?;
    terminal::catch_signals("finished samples are kept: go on with --resume");

    let count_asked = (blocks.len() * BLOCK) as u64;
    let bar = terminal::progress(output.is_quiet(), count_asked, "samples");
    for &block in &blocks {
        keep_piece(&folder, (block, &Map::new()), || {
            let samples = serde_json::to_value(sampler.block(block)).map_err(Failure::run)?;
            let summaries = Map::from_iter([(SAMPLES.to_owned(), samples)]);
            Ok((session.manifest.case_hash.clone(), Ok(summaries)))
        })?;
        bar.inc(BLOCK as u64);
    }
    bar.finish_and_clear();
    let kept = kept_pieces(&folder, count)?;
    let missing = count - kept.len();
    let mut samples: Vec<Sample> = Vec::new();
    for mut record in kept {
        let own = record.summaries.remove(SAMPLES).unwrap_or_default();
        samples.extend(serde_json::from_value::<Vec<Sample>>(own).map_err(Failure::run)?);
    }
    samples.retain(|sample| sample.number <= uncertainty.samples);
    let mut summary = summarize(&case, &samples);
    if missing > 0 {
        summary.notes.push(format!(
            "{missing} of {count} blocks of samples are missing: run it again with --resume once \
             all shards have ended"
        ));
    } else if !asked.robust.is_empty() {
        let (designs, bound) = (&asked.robust, asked.bound);
        summary.robust = Some(curves(&case, &sampler, designs, bound)?);
    }
    for note in &summary.notes {
        tracing::warn!("{note}");
    }
    let folder = folder.output();
    let told = Told::of(session.head(), summary.document());
    if missing > 0 {
        let object = summary_of(&session.manifest, told.head, &summary).map_err(Failure::run)?;
        return output.print(&told.text, &object, folder.path());
    }
    write_table(folder, &samples_table(&uncertainty.keys(), &samples, summary.largest_friction))?;
    let mut failed = samples.iter().filter_map(|sample| sample.error.as_deref());
    if failed.clone().count() == samples.len() {
        let first = failed.next().unwrap_or_default();
        return Err(Failure::run(format!("no sample could be solved; the first: {first}")));
    }
    let figures = || declared(summary.figures());
    let (text, object) = output.write_result(folder, told, &summary, figures)?;
    output.print(&text, &object, folder.path())
}

/// Refuses what cannot be designed.
fn check(design: &Design, case: &Case) -> Result<(), Failure> {
    let key = &design.key;
    if !find_key(key).is_some_and(|known| known.is_numeric()) {
        return Err(Failure::usage(format!("--robust {key}: not a numeric case key")));
    }
    let mut uncertain = case.uncertainty.iter().flat_map(|u| &u.parameters);
    if uncertain.any(|p| p.parameter.names().any(|name| name == key)) {
        return Err(Failure::usage(format!(
            "--robust {key}: it is uncertain already; take it out of uncertainty.distributions"
        )));
    }
    for value in &design.values {
        design.case(case, *value)?;
    }
    Ok(())
}
