//! What users write: cases, overrides, tables of responses and signals.

use crate::fuzz::hold;
use crate::fuzz::mutation::text;
use frictionsim::case::Case;
use frictionsim::signal::reader::{ResponseOptions, SignalOptions, read_response, read_signal};
use frictionsim::signal::{IdentificationOptions, identify};
use std::path::Path;

fn shipped_cases() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let cases = paths.iter().filter(|path| path.extension().is_some_and(|e| e == "toml"));
    cases.map(|path| std::fs::read(path).unwrap()).collect()
}

#[test]
fn no_case_makes_its_reader_panic() {
    let corpus = shipped_cases();
    hold(
        "case",
        |random| text(random, &corpus),
        |bytes| match Case::parse("case.toml", bytes, &[]) {
            Ok(case) => drop(case.cost()),
            Err(errors) => drop(errors.to_string()),
        },
    );
}

#[test]
fn no_override_makes_its_reader_panic_or_cost_much() {
    let case = shipped_cases().remove(0);
    let corpus: Vec<Vec<u8>> = [
        "contact.friction_coefficient=0.4",
        "cea.friction_coefficients={ from = 0.0, to = 1.0, count = 51 }",
        "cea.shapes_at=[0.1, 0.2]",
        "sweep.\"contact.rotation_speed_rpm\"={ from = 10, to = 6000, count = 24, spacing = \"log\" }",
        "transient.perturbation.harmonics=[2]",
        "output.snapshots={ from = 0.0, to = 0.01, count = 100 }",
        "title=\"x\"",
    ]
    .map(|text| text.as_bytes().to_vec())
    .to_vec();
    hold(
        "set",
        |random| text(random, &corpus),
        |bytes| {
            let set = [String::from_utf8_lossy(bytes).into_owned()];
            match Case::parse("case.toml", &case, &set) {
                Ok(case) => drop(case.cost()),
                Err(errors) => drop(errors.to_string()),
            }
        },
    );
}

/// Response of one oscillator in four notations.
fn responses() -> Vec<Vec<u8>> {
    let mut tables = vec![
        "frequency_hz,accelerance_real,accelerance_imaginary\n".to_owned(),
        "Frequency [Hz];Magnitude (dB);Phase (deg)\n".to_owned(),
        "Hz\tre\tim\n".to_owned(),
        "f,|H|\n".to_owned(),
    ];
    for i in 0..120 {
        let f = 900.0 + 2.0 * f64::from(i);
        let (a, b) = (1e6 - f * f, 2.0 * 0.01 * 1e3 * f);
        let scale = -f * f / (a * a + b * b);
        let (re, im) = (scale * a, -scale * b);
        let (size, phase) = (re.hypot(im), im.atan2(re).to_degrees());
        tables[0] += &format!("{f},{re},{im}\n");
        tables[1] += &format!("{f};{:.4};{phase:.3}\n", 20.0 * size.log10()).replace('.', ",");
        tables[2] += &format!("{f}\t{re:e}\t{im:e}\n");
        tables[3] += &format!("{f},{size}\n");
    }
    tables.into_iter().map(String::into_bytes).collect()
}

#[test]
fn no_table_of_a_response_makes_reader_or_identification_panic() {
    let corpus = responses();
    hold(
        "response",
        |random| text(random, &corpus),
        |bytes| {
            if let Ok(file) = read_response(bytes, "frf.csv", &ResponseOptions::default()) {
                let responses: Vec<_> = file.responses.into_iter().map(|r| r.response).collect();
                let _ = identify(&responses, &IdentificationOptions { range_hz: None });
            }
        },
    );
}

#[test]
fn no_table_of_a_signal_makes_its_reader_panic() {
    let mut tables = ["time_s,a,b\n", "Zeit [ms];Kanal 1\n", "x\n"].map(str::to_owned);
    for i in 0..200 {
        let t = 1e-4 * f64::from(i);
        let x = (4e3 * t).sin() * (50.0 * t).exp();
        tables[0] += &format!("{t},{x},{}\n", -x);
        tables[1] += &format!("{:.4};{x:.6}\n", 1e3 * t).replace('.', ",");
        tables[2] += &format!("{x}\n");
    }
    let corpus = tables.map(String::into_bytes).to_vec();
    hold(
        "signal",
        |random| text(random, &corpus),
        |bytes| {
            let mut options = SignalOptions::default();
            let _ = read_signal(bytes, "signal.csv", &options);
            options.rate = Some(51_200.0);
            let _ = read_signal(bytes, "signal.csv", &options);
        },
    );
}
