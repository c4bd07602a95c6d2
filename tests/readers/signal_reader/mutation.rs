//! No bytes make a reader or an analysis panic: tables of random pieces, and mutations of whole files of each format.

use super::formats::{matlab, signal, wave};
use super::{read_response, read_signal};
use crate::prelude::*;
use frictionsim::signal::reader::{NamedResponse, write_signal};
use frictionsim::signal::*;
use proptest::prelude::*;

/// What is done with a file of responses and with one of signals, to the end.
fn analyse(bytes: &[u8]) {
    if let Ok(file) = reader::read_response(bytes, "x", &ResponseOptions::default()) {
        let responses = file.responses.into_iter().map(|named| named.response);
        if let Ok(found) = identify(&responses.collect::<Vec<_>>(), None) {
            assert!(found.rayleigh.mass_coefficient.value.is_finite());
            assert!(found.rayleigh.stiffness_coefficient.value.is_finite());
        }
    }
    for rate in [None, Some(5e4)] {
        let Ok(file) = read_signal(bytes, "x", rate) else { continue };
        for channel in file.channels.iter().take(3) {
            let (x, rate) = (&channel.samples, file.sampling_rate);
            let _ = exponential_stage(x, rate);
            let _ = spectrogram(x, rate, USUAL_WINDOW, f64::INFINITY);
            if let Ok(resolution) = SpectralResolution::of(x.len(), rate, None) {
                for line in spectral_lines(x, rate, resolution, 12).unwrap_or_default() {
                    assert!(line.frequency_hz.is_finite() && line.amplitude.is_finite());
                }
            }
        }
    }
}

/// Response of two modes, of receptance.
fn response(count: usize) -> FrequencyResponse {
    let f: Vec<f64> = (1..=count).map(|k| 10.0 * k as f64).collect();
    let mode = |f: f64, f0: f64| 1.0 / c64::new(f0 * f0 - f * f, 0.02 * f0 * f);
    let h = f.iter().map(|f| mode(*f, 200.0) + mode(*f, 410.0)).collect();
    FrequencyResponse::new(f, h, ResponseQuantity::Receptance).unwrap()
}

/// A whole file of each format.
fn corpus() -> Vec<Vec<u8>> {
    let response = response(60);
    let lines = response.frequencies_hz().iter().zip(response.values());
    let table: String =
        lines.clone().map(|(f, h)| format!("{f},{:e},{:e}\n", h.re, h.im)).collect();
    let complex = format!("frequency_hz,real,imaginary\n{table}");
    let mobility: String = lines
        .map(|(f, h)| format!("{f};{:.4};{:.2}\n", 20.0 * h.norm().log10(), h.arg().to_degrees()))
        .collect();
    let level = format!("Frequency;Level;Phase\nHz;dB re 1 m/N;deg\n{mobility}").replace('.', ",");
    let samples: Vec<f64> = (0..400)
        .map(|k| (1e-2 * f64::from(k)).exp() * f64::from(k).sin() + (f64::from(k * k) % 7.0))
        .collect();
    let rows = samples.iter().enumerate();
    let timed: String = rows.map(|(k, x)| format!("{:.6}\t{x}\n", 2e-5 * k as f64)).collect();
    let named = NamedResponse { name: "1:3".into(), response };
    vec![
        complex.into_bytes(),
        level.into_bytes(),
        format!("t\tx\n{timed}").into_bytes(),
        format!("Zeit [s]\tKanal 1\n{timed}").replace('.', ",").into_bytes(),
        samples.iter().map(|x| format!("{x}\n")).collect::<String>().into_bytes(),
        named.written([(5, 3), (70, 1)]).into_bytes(),
        write_signal(&signal(&["a"], &samples)).into_bytes(),
        wave(&samples),
        matlab(&samples, false),
        matlab(&samples, true),
    ]
}

#[test]
fn no_mutation_of_a_file_makes_a_reader_or_an_analysis_panic() {
    let corpus = corpus();
    corpus.iter().for_each(|file| analyse(file));
    hold("measurement", |random| either(random, &corpus, &corpus), analyse);
}

/// Nineteen, between bars.
const PIECES: &str = ",|;|\t| |\n|\r\n|\"|# |frequency_hz|real|imag|magnitude_db|phase|\
    time_ms|fs: 1e3 kHz|nan|1e999|1,5|-";

/// Text made of the pieces that tables are made of, so that the fuzzing gets past the first line.
fn table_like() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        19 => prop::sample::select(PIECES.split('|').collect::<Vec<_>>()).prop_map(str::to_owned),
        1 => "[0-9]{1,4}",
        1 => "[0-9]\\.[0-9]{1,3}",
        1 => "\\PC{0,3}",
    ];
    prop::collection::vec(piece, 0..200).prop_map(|v| v.concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_table_like_text_makes_the_reader_panic(text in table_like()) {
        let _ = read_response(text.as_bytes(), "x", None);
        let _ = read_signal(text.as_bytes(), "x", None);
    }

    #[test]
    fn written_numbers_come_back_bit_for_bit(
        values in prop::collection::vec((-1e6f64..1e6, -1e-6f64..1e-6), 8..40),
    ) {
        let rows: String = values.iter().enumerate().map(|(i, (a, b))| format!("{i},{a},{b:e}\n")).collect();
        let text = format!("frequency_hz,real,imaginary\n{rows}");
        let read = read_response(text.as_bytes(), "x", None).unwrap().response;
        for (z, (a, b)) in read.values().iter().zip(&values) {
            prop_assert_eq!((z.re, z.im), (*a, *b));
        }
    }
}
