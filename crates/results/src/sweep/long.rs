//! Long tables of a sweep: one row for each onset, mode or limit cycle of each point, named by what it is.

use super::record::{PointRecord, listed};
use super::table::{points, swept};
use crate::cea::{SWEPT_MODES, SWEPT_ONSETS, UNSTABLE};
use crate::cycle::{BranchRecord, FamilyRecord};
use frictionsim_output::{Column, Table, columns};
use serde::de::DeserializeOwned;

/// A cycle of a branch: its family, and its place along the branch.
type BranchPoint = (FamilyRecord, usize);

/// A quantity of the branch at a point.
fn at<T: Copy>((family, place): &BranchPoint, of: impl Fn(&BranchRecord) -> &Vec<T>) -> Option<T> {
    of(family.branch.as_ref()?).get(*place).copied()
}

columns! {
    /// A limit cycle along a branch.
    pub(crate) BRANCHES: own as BranchPoint;
    mode: "mode that leads to it, of a body without rotating waves" = own.0.mode;
    harmonic: "nodal diameters of a wave" = own.0.mode.is_none().then_some(own.0.harmonic);
    onset: "onset at which the wave is born, from 1" = own.0.mode.is_none().then_some(own.0.onset);
    key: "key of the parameter" = own.0.branch.as_ref().map(|branch| branch.key.clone());
    value: "its value" = at(own, |branch| &branch.values);
    main_frequency_hz: "frequency" = at(own, |branch| &branch.frequency_hz);
    amplitude_m: "amplitude along the counterface" = at(own, |branch| &branch.amplitude);
    stick: "fraction of the contact that sticks" = at(own, |branch| &branch.status[0]);
    slip: "fraction that slips" = at(own, |branch| &branch.status[1]);
    open: "fraction that is open" = at(own, |branch| &branch.status[2]);
    stable: "whether it is stable, where that is known"
        = at(own, |branch| &branch.stable).flatten();
    growth_rate_per_s: "growth rate of its leading perturbation, where it is known"
        = at(own, |branch| &branch.growth_rate).flatten();
}

/// The tables of a sweep with these analyses: its points, and the long tables, in which failed points have no rows.
pub fn tables(
    keys: &[String],
    analyses: &[impl AsRef<str>],
    records: &[PointRecord],
) -> Vec<Table> {
    let has = |name: &str| analyses.iter().any(|own| own.as_ref() == name);
    let mut tables = vec![points(keys, records)];
    if has("cea") {
        let of = ("stability.csv", "cea", "critical_frictions");
        tables.push(long(of, keys, records, SWEPT_ONSETS, |own| vec![own]));
        let of = ("unstable_modes.csv", "cea", "unstable_modes");
        tables.push(long(of, keys, records, UNSTABLE, |own| vec![own]));
        let of = ("modes.csv", "cea", "modes_at_friction");
        tables.push(long(of, keys, records, SWEPT_MODES, |own| vec![own]));
    }
    if has("cycle") {
        let cycles = |family: FamilyRecord| -> Vec<BranchPoint> {
            let count = family.branch.as_ref().map_or(0, |branch| branch.values.len());
            (0..count).map(|place| (family.clone(), place)).collect()
        };
        let of = ("branches.csv", "cycle", "curves");
        tables.push(long(of, keys, records, BRANCHES, cycles));
    }
    tables
}

/// The swept keys, the columns and the number of the point, with the rows of each entry of a list of an analysis; an
/// entry of another version has none.
fn long<S: DeserializeOwned, T>(
    (file, analysis, list): (&str, &str, &str),
    keys: &[String],
    records: &[PointRecord],
    columns: &[Column<T>],
    rows_of: impl Fn(S) -> Vec<T>,
) -> Table {
    let mut rows: Vec<(&PointRecord, T)> = Vec::new();
    for record in records {
        let found = record.summaries.get(analysis).and_then(|summary| summary.get(list));
        let own = listed(found).into_iter().flat_map(&rows_of);
        rows.extend(own.map(|row| (record, row)));
    }
    let table = swept(file, keys, rows.iter().map(|row| row.0));
    let table = table.columns(columns, rows.iter().map(|row| &row.1));
    table.column("point", None, rows.iter().map(|row| row.0.point))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Map, Value, json};

    fn record(point: usize, radius: f64, analysis: &str, summary: Value) -> PointRecord {
        PointRecord {
            point,
            swept: Map::from_iter([("geometry.inner_radius".to_owned(), json!(radius))]),
            summaries: Map::from_iter([(analysis.to_owned(), summary)]),
            ..PointRecord::default()
        }
    }

    fn written(file: &str, records: &[PointRecord]) -> String {
        let keys = ["geometry.inner_radius".to_owned()];
        let tables = tables(&keys, &["cea", "cycle"], records);
        let mut out = Vec::new();
        tables.iter().find(|table| table.file == file).unwrap().write_csv(&mut out).unwrap();
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
             restabilized_friction,restabilized_frequency_hz,unstable_from_start,lost_after,point\n\
             0.02,1,1,-1,0.12,10000.0,,,false,,1\n0.02,2,0,-1,0.14,10000.0,,,false,,1\n\
             0.03,2,0,-1,0.11,10000.0,,,false,,2\n"
        );
    }

    #[test]
    fn each_limit_cycle_of_a_branch_is_a_row() {
        let branch = BranchRecord {
            key: "contact.rotation_speed_rpm".into(),
            values: vec![10.0, 20.0],
            frequency_hz: vec![9e3, 8e3],
            amplitude: vec![1e-6, 2e-6],
            status: [vec![0.5, 0.4], vec![0.5, 0.4], vec![0.0, 0.2]],
            stable: vec![Some(true), None],
            growth_rate: vec![Some(-3.5), None],
            ..BranchRecord::default()
        };
        let family = |harmonic, onset, mode| FamilyRecord {
            harmonic,
            onset,
            mode,
            onsets: Vec::new(),
            cycle: None,
            branch: Some(branch.clone()),
        };
        let summary = json!({ "curves": [family(2, 1, None), family(0, 0, Some(4))] });
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
