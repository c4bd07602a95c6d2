//! Long tables of a sweep: one row for each onset, mode or limit cycle of each point, named by what it is.

use super::super::Table;
use super::PointRecord;
use super::table::cell;
use serde_json::{Map, Value};
use std::io::{self, Write};

/// One long table: where its rows come from in the points' summaries.
pub struct LongTable {
    /// File name.
    pub file: &'static str,
    /// Analysis whose summary has the rows.
    analysis: &'static str,
    /// Columns after the swept keys.
    columns: &'static [&'static str],
    /// The rows of one summary, as objects that have the columns.
    rows: fn(&Value) -> Vec<Map<String, Value>>,
}

/// Every long table of a sweep.
pub const LONG_TABLES: [LongTable; 4] = [
    LongTable {
        file: "stability.csv",
        analysis: "cea",
        columns: &[
            "harmonic",
            "branch",
            "direction",
            "critical_friction",
            "frequency_hz",
            "restabilized_friction",
            "restabilized_frequency_hz",
            "unstable_from_start",
        ],
        rows: |summary| objects(summary.get("critical_frictions")),
    },
    LongTable {
        file: "unstable_modes.csv",
        analysis: "cea",
        columns: &[
            "friction_coefficient",
            "mode",
            "harmonic",
            "branch",
            "direction",
            "frequency_hz",
            "growth_rate_per_s",
            "damping_factor",
            "critical_friction",
        ],
        rows: |summary| objects(summary.get("unstable_modes")),
    },
    LongTable {
        file: "modes.csv",
        analysis: "cea",
        columns: &[
            "harmonic",
            "branch",
            "direction",
            "real_hz",
            "frequency_hz",
            "unstable",
            "contact_share",
        ],
        rows: |summary| objects(summary.get("modes_at_friction")),
    },
    LongTable {
        file: "branches.csv",
        analysis: "cycle",
        columns: &[
            "mode",
            "harmonic",
            "onset",
            "key",
            "value",
            "main_frequency_hz",
            "amplitude_m",
            "stick",
            "slip",
            "open",
            "stable",
            "growth_rate_per_s",
        ],
        rows: cycles_of_branches,
    },
];

impl LongTable {
    /// Whether a sweep with these analyses has this table.
    pub fn is_of(&self, analyses: &[&str]) -> bool {
        analyses.contains(&self.analysis)
    }

    /// Writes the swept keys, the columns and the number of the point; failed points have no rows.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(
        &self,
        out: &mut dyn Write,
        keys: &[String],
        records: &[PointRecord],
    ) -> io::Result<()> {
        let swept = keys.iter().map(String::as_str);
        let header: Vec<&str> =
            swept.chain(self.columns.iter().copied()).chain(["point"]).collect();
        let mut table = Table::new(out, &header)?;
        let of = |object: &Map<String, Value>, name: &str| {
            object.get(name).map_or_else(String::new, cell)
        };
        for record in records {
            let rows = record.summaries.get(self.analysis).map(self.rows);
            for row in rows.unwrap_or_default() {
                let swept = keys.iter().map(|key| of(&record.swept, key));
                let own = self.columns.iter().map(|name| of(&row, name));
                table.row(swept.chain(own).chain([record.point.to_string()]))?;
            }
        }
        table.finish()
    }
}

fn objects(list: Option<&Value>) -> Vec<Map<String, Value>> {
    let items = list.and_then(Value::as_array).into_iter().flatten();
    items.filter_map(|item| item.as_object().cloned()).collect()
}

/// One object for each cycle of each branch, from the arrays along the branches.
fn cycles_of_branches(summary: &Value) -> Vec<Map<String, Value>> {
    let mut rows = Vec::new();
    for family in objects(summary.get("curves")) {
        let Some(Value::Object(branch)) = family.get("branch") else {
            continue;
        };
        let mode = family.get("mode").filter(|mode| !mode.is_null());
        let count = branch.get("values").and_then(Value::as_array).map_or(0, Vec::len);
        for i in 0..count {
            let at = |name: &str| branch.get(name).and_then(|list| list.get(i)).cloned();
            let status = |k: usize| branch.get("status").and_then(|s| s.get(k)?.get(i)).cloned();
            // Cycles of a mode are no waves.
            let of_wave = |name: &str| family.get(name).filter(|_| mode.is_none()).cloned();
            let cells = [
                ("mode", mode.cloned()),
                ("harmonic", of_wave("harmonic")),
                ("onset", of_wave("onset")),
                ("key", branch.get("key").cloned()),
                ("value", at("values")),
                ("main_frequency_hz", at("frequency_hz")),
                ("amplitude_m", at("amplitude")),
                ("stick", status(0)),
                ("slip", status(1)),
                ("open", status(2)),
                ("stable", at("stable")),
                ("growth_rate_per_s", at("growth_rate")),
            ];
            let known = cells.into_iter().filter_map(|(name, v)| Some((name.to_owned(), v?)));
            rows.push(known.collect());
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn record(point: usize, radius: f64, analysis: &str, summary: Value) -> PointRecord {
        PointRecord {
            point,
            swept: Map::from_iter([("geometry.inner_radius".to_owned(), json!(radius))]),
            error: None,
            summaries: Map::from_iter([(analysis.to_owned(), summary)]),
            case_hash: String::new(),
            sweep_hash: String::new(),
            version: String::new(),
            simd: String::new(),
        }
    }

    fn written(file: &str, records: &[PointRecord]) -> String {
        let table = LONG_TABLES.iter().find(|table| table.file == file).unwrap();
        let mut out = Vec::new();
        table.write(&mut out, &["geometry.inner_radius".into()], records).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn each_onset_of_each_point_is_a_row_named_by_its_branch() {
        let onset = |n: u32, branch: u32, mu: f64| {
            json!({ "harmonic": n, "branch": branch, "direction": -1, "critical_friction": mu,
                    "frequency_hz": 1e4, "restabilized_friction": null, "unstable_from_start": false })
        };
        let first = json!({ "critical_frictions": [onset(1, 1, 0.12), onset(2, 0, 0.14)] });
        let second = json!({ "critical_frictions": [onset(2, 0, 0.11)] });
        let records = [record(1, 0.02, "cea", first), record(2, 0.03, "cea", second)];
        assert_eq!(
            written("stability.csv", &records),
            "geometry.inner_radius,harmonic,branch,direction,critical_friction,frequency_hz,\
             restabilized_friction,restabilized_frequency_hz,unstable_from_start,point\n\
             0.02,1,1,-1,0.12,10000.0,,,false,1\n0.02,2,0,-1,0.14,10000.0,,,false,1\n\
             0.03,2,0,-1,0.11,10000.0,,,false,2\n"
        );
    }

    #[test]
    fn each_limit_cycle_of_a_branch_is_a_row() {
        let branch = json!({ "key": "contact.rotation_speed_rpm", "values": [10.0, 20.0],
            "frequency_hz": [9e3, 8e3], "amplitude": [1e-6, 2e-6],
            "status": [[0.5, 0.4], [0.5, 0.4], [0.0, 0.2]],
            "stable": [true, null], "growth_rate": [-3.5, null] });
        let summary = json!({ "curves": [{ "harmonic": 2, "onset": 1, "branch": branch },
            { "harmonic": 0, "onset": 0, "mode": 4, "branch": branch }] });
        let text = written("branches.csv", &[record(1, 0.02, "cycle", summary)]);
        let rows: Vec<&str> = text.lines().skip(1).collect();
        let key = "contact.rotation_speed_rpm";
        assert_eq!(
            rows,
            [
                format!("0.02,,2,1,{key},10.0,9000.0,1e-6,0.5,0.5,0.0,true,-3.5,1"),
                format!("0.02,,2,1,{key},20.0,8000.0,2e-6,0.4,0.4,0.2,,,1"),
                format!("0.02,4,,,{key},10.0,9000.0,1e-6,0.5,0.5,0.0,true,-3.5,1"),
                format!("0.02,4,,,{key},20.0,8000.0,2e-6,0.4,0.4,0.2,,,1"),
            ]
        );
    }
}
