//! The points of a sweep, each a case of its own, and the shards they are dealt out to.

use crate::*;
use frictionsim_case::Sweep;
use serde_json::Map;
use std::str::FromStr;

/// Part `number` of `count` parts that a sweep is dealt out to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    count: usize,
}

impl Shard {
    /// Numbers of those of `count` points that belong to a shard, ascending from 1; all without one. Points are dealt
    /// out in turn, so that neighbours, which cost alike, go to different shards.
    pub fn points(shard: Option<Self>, count: usize) -> Vec<usize> {
        let shard = shard.unwrap_or(Self { number: 1, count: 1 });
        (shard.number..=count).step_by(shard.count).collect()
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let hint = "a shard is K/N, part K of N, for example 2/8";
        let (number, count) = text.split_once('/').ok_or(hint)?;
        let parse = |part: &str| part.parse::<usize>().map_err(|_| hint.to_owned());
        let (number, count) = (parse(number)?, parse(count)?);
        if number == 0 || number > count {
            return Err(format!("K must be from 1 to N = {count}: {hint}"));
        }
        Ok(Self { number, count })
    }
}

/// The points of a sweep.
#[derive(Clone, Debug)]
pub struct SweepPlan<'a> {
    case: &'a Case,
    sweep: &'a Sweep,
    /// What runs at each point.
    pub analyses: Vec<Analysis>,
}

impl<'a> SweepPlan<'a> {
    /// The plan of a case. What runs at each point is `sweep.analyses`, or else whatever the first
    /// point has a section for.
    ///
    /// # Errors
    /// A case without `[sweep]`, and one without the section of an analysis that it asks for.
    pub fn new(case: &'a Case) -> Result<Self, CaseErrors> {
        let mut plan = Self { case, sweep: case.require_sweep()?, analyses: Vec::new() };
        // Sections may exist at the points only, made by swept keys. A first point that is invalid
        // as a combination of values is a failed point, not a bad sweep.
        let first = plan.point_case(1);
        let first = first.as_ref().unwrap_or(case);
        plan.analyses = match plan.sweep.analyses.as_slice() {
            [] => Analysis::all().filter(|analysis| first.has(*analysis)).collect(),
            given => given.to_vec(),
        };
        let lacks = |analysis| plan.analyses.contains(&analysis) && !first.has(analysis);
        if lacks(Analysis::Cea) {
            first.require_cea()?;
        }
        if lacks(Analysis::Basin) {
            first.require_basin()?;
        }
        if lacks(Analysis::Cycle) {
            first.require_cycle()?;
        }
        if lacks(Analysis::Transient) || plan.analyses.is_empty() {
            first.require_transient()?;
        }
        Ok(plan)
    }

    /// Number of points.
    pub fn count(&self) -> usize {
        self.sweep.point_count()
    }

    /// Swept keys, with those that take the same values.
    pub fn keys(&self) -> Vec<String> {
        self.sweep.keys.iter().flat_map(|key| key.varied.names().cloned()).collect()
    }

    /// Names of the analyses.
    pub fn analysis_names(&self) -> Vec<String> {
        self.analyses.iter().map(|analysis| analysis.word().to_owned()).collect()
    }

    /// Swept keys and their values at a point.
    pub fn swept(&self, point: usize) -> Map<String, Value> {
        let overrides = self.sweep.overrides(point - 1);
        let pairs = overrides.iter().filter_map(|text| text.split_once('='));
        // Numbers, strings, booleans and lists of them are written alike in TOML and JSON.
        let json = |toml: &str| {
            serde_json::from_str(toml).unwrap_or_else(|_| Value::String(toml.to_owned()))
        };
        pairs.map(|(key, value)| (key.to_owned(), json(value))).collect()
    }

    /// The case of a point: the sweep's with the swept values as overrides, and no `[sweep]`.
    ///
    /// # Errors
    /// Values that do not go together, in one line.
    pub fn point_case(&self, point: usize) -> Result<Case, String> {
        let overrides = self.sweep.overrides(point - 1);
        let one_line = |errors: CaseErrors| one_line(&errors.line());
        self.case.raw.sweep_point(&overrides).and_then(Case::read).map_err(one_line)
    }
}

/// A message as the text of a table cell.
pub fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}
