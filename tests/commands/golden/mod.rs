//! Consistency check: every command gives the keys, columns and numbers that version 0.1.0 gave, but for the listed
//! changes, each with its reason.
//!
//! `frozen.json` was written by the 0.1.0 program: `GOLDEN_FREEZE=path/to/frictionsim cargo test --test commands golden`.
//! Numbers agree to 1e-12 of the largest of their column or list (onsets, whose search ends at a tolerance, to 1e-9).
//! Keys and columns may be added, never lost. Kernels run without vector instructions, so that the machine does not matter.

mod changes;

use crate::columns::visit_all;
use crate::prelude::*;
use serde::{Deserialize, Serialize};

/// A list of numbers, by its size and three values that a change would move.
#[derive(Serialize, Deserialize, Clone, Debug, Default, PartialEq)]
struct Numbers {
    count: usize,
    first: f64,
    last: f64,
    sum_of_magnitudes: f64,
    largest: f64,
}

impl Numbers {
    fn add(&mut self, value: f64) {
        if self.count == 0 {
            self.first = value;
        }
        self.count += 1;
        self.last = value;
        self.sum_of_magnitudes += value.abs();
        self.largest = self.largest.max(value.abs());
    }

    fn differs(&self, now: &Self, tolerance: f64) -> Option<String> {
        if self.count != now.count {
            return Some(format!("{} numbers instead of {}", now.count, self.count));
        }
        let scale = self.largest.max(f64::MIN_POSITIVE);
        let sums = (self.sum_of_magnitudes - now.sum_of_magnitudes) / self.count.max(1) as f64;
        let all = [self.first - now.first, self.last - now.last, sums];
        let worst = all.into_iter().map(f64::abs).fold(0.0, f64::max);
        let far = worst > tolerance * scale;
        far.then(|| format!("differs by {:.1e} of its scale", worst / scale))
    }
}

/// What a command wrote: for each file, its columns or keys with their numbers (none where they hold text).
type Result = BTreeMap<String, BTreeMap<String, Numbers>>;

/// Rows of a table, up to four fields each; headings stand in brackets.
fn rows(table: &str) -> impl Iterator<Item = [&str; 4]> {
    table.lines().filter(|line| !line.is_empty() && !line.starts_with(['#', '['])).map(|line| {
        let mut fields = line.split(" | ");
        [(); 4].map(|()| fields.next().unwrap_or_default())
    })
}

fn run(binary: &Path, [name, command, input, changes]: [&str; 4], folder: &Path) -> Result {
    let out = folder.join(name);
    let mut program = Command::new(binary);
    let shipped = repository().join(input);
    let input = if shipped.exists() { shipped } else { folder.join(input) };
    program.current_dir(folder).arg(command).arg(input).args(["--no-figures", "--quiet", "--out"]);
    program.arg(&out);
    for change in changes.split(" ; ").filter(|change| !change.is_empty()) {
        program.args(["--set", change]);
    }
    // These two read tables and know no kernels.
    if !["identify", "signal"].contains(&command) {
        program.args(["--simd", "scalar"]);
    }
    let output = program.output().expect("the program starts");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    read_folder(&out)
}

fn read_folder(folder: &Path) -> Result {
    let mut result = Result::new();
    for path in files_below(folder) {
        let name = path.strip_prefix(folder).unwrap().to_string_lossy().replace('\\', "/");
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("csv") => {
                result.insert(name, read_table(&path));
            }
            Some("json") if !name.contains("manifest") => {
                let text = fs::read_to_string(&path).unwrap();
                let keys = result.entry(name).or_default();
                visit_all("", &serde_json::from_str(&text).unwrap(), &mut |path, own| match own {
                    Value::Object(_) => {}
                    Value::Array(_) => _ = keys.entry(format!("{path}[]")).or_default(),
                    _ => {
                        let numbers = keys.entry(path.to_owned()).or_default();
                        own.as_f64().into_iter().for_each(|number| numbers.add(number));
                    }
                });
            }
            _ => {}
        }
    }
    result
}

fn read_table(path: &Path) -> BTreeMap<String, Numbers> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut columns: Vec<Numbers> = vec![Numbers::default(); names.len()];
    for row in reader.records() {
        for (column, text) in columns.iter_mut().zip(row.unwrap().iter()) {
            if let Ok(value) = text.parse() {
                column.add(value);
            }
            // A flag has one spelling, `true` or `false`.
            assert!(!["yes", "no", "True", "False"].contains(&text), "{}: {text}", path.display());
        }
    }
    names.into_iter().zip(columns).collect()
}

fn compare(case: &str, frozen: &Result, now: &Result) -> Vec<String> {
    let mut differences = Vec::new();
    let mut note = |file: &str, key: &str, text: String| {
        if !changes::explains(case, file, key) {
            differences.push(format!("{case}: {file}: {key}: {text}"));
        }
    };
    for (file, keys) in frozen {
        let Some(found) = now.get(file) else {
            note(file, "", "the file is missing".to_owned());
            continue;
        };
        for (key, numbers) in keys {
            match found.get(key) {
                None => note(file, key, "is missing".to_owned()),
                Some(_) if changes::depends_on_the_clock(key) => {}
                Some(found) => {
                    let far = numbers.differs(found, changes::tolerance(case, file, key));
                    far.into_iter().for_each(|text| note(file, key, text));
                }
            }
        }
    }
    differences
}

#[test]
fn every_command_gives_the_keys_columns_and_numbers_of_version_0_1_0() {
    let folder = folder();
    let frozen_path = repository().join("tests/commands/golden/frozen.json");
    let freezing = std::env::var_os("GOLDEN_FREEZE").map(PathBuf::from);
    let binary = freezing.clone().unwrap_or_else(|| env!("CARGO_BIN_EXE_frictionsim").into());
    let with_slow = freezing.is_some() || std::env::var_os("GOLDEN_SLOW").is_some();
    let mut now = BTreeMap::new();
    let (usual, slow) = include_str!("cases.txt").split_once("[slow]").unwrap();
    for case in rows(usual).chain(rows(slow).filter(|_| with_slow)) {
        now.insert(case[0].to_owned(), run(&binary, case, folder.path()));
    }
    if freezing.is_some() {
        let text = serde_json::to_string(&now).unwrap();
        fs::write(&frozen_path, text.replace("},\"", "},\n\"") + "\n").unwrap();
        return;
    }
    let text = fs::read_to_string(&frozen_path).unwrap();
    let frozen: BTreeMap<String, Result> = serde_json::from_str(&text).unwrap();
    let differences: Vec<String> =
        now.iter().flat_map(|(name, result)| compare(name, &frozen[name], result)).collect();
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}
