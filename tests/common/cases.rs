//! Cases that are read from a text, under changes of which several stand in one with ` ; ` between.

use super::prelude::*;
pub use frictionsim::signal::reader::MeasuredMode;

/// A case whose files lie beside `path`, or what is said of it.
pub fn read_case<S: AsRef<str>>(
    path: impl AsRef<Path>,
    text: &str,
    changes: &[S],
) -> Result<Case, CaseErrors> {
    let changes = changes.iter().flat_map(|text| text.as_ref().split(" ; "));
    let changes: Vec<String> = changes.map(str::to_owned).collect();
    Case::parse(path.as_ref().to_str().unwrap(), text.as_bytes(), &changes)
}

/// A case that must be valid.
#[track_caller]
pub fn case_of<S: AsRef<str>>(path: impl AsRef<Path>, text: &str, changes: &[S]) -> Case {
    read_case(path, text, changes).unwrap_or_else(|errors| panic!("{errors}"))
}

#[track_caller]
pub fn shipped_case<S: AsRef<str>>(name: &str, changes: &[S]) -> Case {
    let path = format!("{}/cases/{name}", env!("CARGO_MANIFEST_DIR"));
    case_of(&path, &std::fs::read_to_string(&path).unwrap(), changes)
}

/// A folder of a name, which stays.
pub fn kept(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// A case that must be valid, beside files in a folder of a name, which stays.
#[track_caller]
pub fn case_beside<S: AsRef<str>>(
    name: &str,
    files: &[(&str, &[u8])],
    text: &str,
    changes: &[S],
) -> Case {
    let folder = kept(name);
    for (file, bytes) in files {
        std::fs::write(folder.join(file), bytes).unwrap();
    }
    case_of(folder.join("case.toml"), text, changes)
}

/// What a case is warned of, a line each.
pub fn warnings(case: &Case) -> String {
    case.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// A table of sines, each of a channel and its frequency, Hz: so many samples at a rate, Hz.
pub fn tones(rate: f64, count: u32, channels: &[(&str, f64)]) -> String {
    let names: String = channels.iter().map(|(name, _)| format!(",{name}")).collect();
    let row = |k: u32| {
        let time = f64::from(k) / rate;
        let value = |(_, frequency): &(&str, f64)| format!(",{}", (TAU * frequency * time).sin());
        format!("{time}{}\n", channels.iter().map(value).collect::<String>())
    };
    format!("time_s{names}\n{}", (0..count).map(row).collect::<String>())
}

/// A measured mode of a line of a table.
pub fn measured_mode(line: usize, frequency_hz: f64, real_hz: Option<f64>) -> MeasuredMode {
    MeasuredMode { line, frequency_hz, real_hz, harmonic: None, sigma_hz: None, is_unstable: false }
}

/// By waves around the body, and on its whole mesh.
pub const METHODS: [&str; 2] = ["cea.method=cyclic", "cea.method=sparse"];

/// No changes.
pub const AS_IT_IS: &[&str] = &[];
