//! The readers: what they understand, what they refuse and with which words, and that no bytes make them or the analyses behind them panic.

mod formats;
mod measured;
mod mutation;

use crate::prelude::*;
use frictionsim::signal::reader::{ReadError, SignalFile};

#[derive(Debug)]
struct Read {
    response: FrequencyResponse,
    notes: Vec<String>,
}

fn read_response(
    bytes: &[u8],
    source: &str,
    quantity: Option<ResponseQuantity>,
) -> Result<Read, ReadError> {
    let options = ResponseOptions { quantity, ..Default::default() };
    let file = reader::read_response(bytes, source, &options)?;
    Ok(Read { response: file.responses[0].response.clone(), notes: file.notes })
}

fn read_signal(bytes: &[u8], source: &str, rate: Option<f64>) -> Result<SignalFile, ReadError> {
    reader::read_signal(bytes, source, &SignalOptions { rate, ..SignalOptions::default() })
}

/// Ten rows `f, re, im` with a given field separator, decimal sign and line end.
fn rows(separator: &str, decimal: &str, end: &str) -> String {
    let row = |x: f64| {
        let fields = [10.0 * x, 0.5 - 0.1 * x, 0.25 * x - 1.0];
        fields.map(|v| format!("{v:.4}").replace('.', decimal)).join(separator) + end
    };
    (1..=10).map(|i| row(f64::from(i))).collect()
}

fn message(text: &str) -> String {
    read_response(text.as_bytes(), "FRF.csv", None).expect_err("must be refused").to_string()
}

#[test]
fn every_common_dialect_gives_the_same_response() {
    let plain = format!("frequency_hz,real,imag\n{}", rows(",", ".", "\n"));
    let want = read_response(plain.as_bytes(), "a", None).unwrap().response;
    let dialects = [
        format!("frequency_hz;real;imag\r\n{}", rows(";", ",", "\r\n")),
        format!("frequency_hz\treal\timag\n{}", rows("\t", ",", "\n")),
        format!("frequency_hz  real  imag\n{}", rows("  ", ".", "\n")),
        format!("frequency_hz real imag\n{}", rows(" ", ",", "\n")),
        format!("# hammer test\n# frequency_hz, real, imag\n{}", rows(", ", ".", "\n")),
        format!("# frequency real imag\n% [Hz] [m/s2/N] [m/s2/N]\n{}", rows(" ", ",", "\n")),
        format!("Disc 3\nFrequency;Real;Imag\n[Hz];[m/s2/N];[m/s2/N]\n{}", rows(";", ".", "\n")),
        format!("\u{feff}frequency_hz,real,imag\n{}", rows(",", ".", "\n")),
        format!("frequency_hz,real,imag,\n{}", rows(",", ".", ",\n")),
        format!("\"frequency_hz\",\"real\",\"imag\"\r{}", rows(",", ".", "\r")),
        format!("\n\nfrequency_hz,real,imag\n\n{}\n", rows(",", ".", "\n\n")),
    ];
    for text in &dialects {
        let got = read_response(text.as_bytes(), "b", None);
        let got = got.unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!(got.response, want, "{text}");
    }
    let wide: Vec<u8> =
        [0xff, 0xfe].into_iter().chain(plain.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    assert_eq!(read_response(&wide, "c", None).unwrap().response, want);
}

#[test]
fn decibel_with_degrees_and_kilohertz_equal_real_with_imaginary() {
    let mut polar = "Frequency [kHz];Magnitude [dB];Phase [deg]\n".to_string();
    let mut radians = "omega (rad/s)\tabs\tphase (rad)\n".to_string();
    let mut parts = "f,re,im\n".to_string();
    for i in 1..=12 {
        let (f, m, p) = (100.0 * f64::from(i), 0.3 + 0.1 * f64::from(i), 20.0 * f64::from(i));
        polar += &format!("{};{};{}\n", f / 1e3, 20.0 * m.log10(), p);
        radians += &format!("{}\t{}\t{}\n", TAU * f, m, p.to_radians());
        parts += &format!("{f},{},{}\n", m * p.to_radians().cos(), m * p.to_radians().sin());
    }
    let read = |t: &str| read_response(t.as_bytes(), "x", None).unwrap().response;
    let (a, b, c) = (read(&polar), read(&radians), read(&parts));
    within(a.frequencies_hz(), c.frequencies_hz(), 1e-9);
    for (own, wanted) in a.values().iter().chain(b.values()).zip(c.values().iter().cycle()) {
        assert!((own - wanted).norm() < 1e-12);
    }
}

#[test]
fn quantity_comes_from_option_name_unit_or_assumption_in_this_order() {
    use ResponseQuantity::*;
    for (header, option, expected) in [
        ("frequency_hz,mobility_real,mobility_imag", None, (Mobility, 0)),
        ("# receptance\nfrequency_hz,real,imag", None, (Receptance, 0)),
        ("f (Hz),Re (m/N),Im (m/N)", None, (Receptance, 0)),
        ("f (Hz),Re (m/s/N),Im (m/s/N)", None, (Mobility, 0)),
        ("f (Hz),Re ((m/s^2)/N),Im ((m/s^2)/N)", None, (Accelerance, 0)),
        ("frequency_hz,real,imag", None, (Accelerance, 1)),
        ("frequency_hz,real,imag", Some(Mobility), (Mobility, 0)),
        ("f (Hz),Re (m/N),Im (m/N)", Some(Mobility), (Mobility, 1)),
    ] {
        let text = format!("{header}\n{}", rows(",", ".", "\n"));
        let file = read_response(text.as_bytes(), "x", option).unwrap();
        assert_eq!((file.response.quantity(), file.notes.len()), expected, "{header}");
    }
}

#[test]
fn rows_out_of_order_are_sorted_and_equal_repeats_dropped_with_a_note() {
    let mut lines: Vec<String> = rows(",", ".", "\n").lines().map(String::from).collect();
    lines.swap(2, 7);
    lines.push(lines[4].clone());
    let text = format!("frequency_hz,real,imag,\n{}", lines.join("\n"));
    let file = read_response(text.as_bytes(), "x", Some(ResponseQuantity::Mobility)).unwrap();
    assert_eq!(file.notes.len(), 2, "{:?}", file.notes);
    let want = format!("frequency_hz,real,imag\n{}", rows(",", ".", "\n"));
    let want = read_response(want.as_bytes(), "x", Some(ResponseQuantity::Mobility)).unwrap();
    assert_eq!(file.response, want.response);
}

#[test]
fn every_refusal_names_file_line_column_and_remedy() {
    let head = "frequency_hz,real,imag\n";
    let body = rows(",", ".", "\n");
    let last = |row: &str| message(&format!("{head}{body}{row}\n"));
    assert_eq!(
        last("110,nan,1"),
        "FRF.csv:12:5: `nan` in column `real` is not finite (or beyond 1e100); remove the row, or export without \
         missing values"
    );
    for (row, begin) in [
        ("110,1,inf", "7: `inf`"),
        ("110,1,", "5: 2 fields where"),
        ("110,,1", "5: `` in column `real`"),
        ("110,one,1", "5: `one` in column `real`"),
        ("110,1,2,3", "9: 4 fields where"),
        ("-5,1,2", "1: frequency -5 is negative"),
        ("20,1,2", "1: frequency 20 Hz is already in line 3"),
    ] {
        let said = last(row);
        assert!(said.starts_with(&format!("FRF.csv:12:{begin}")), "{said}");
    }
    let commas = rows(",", ",", "\n");
    let texts = [("10,x,2\n20,1,2\n", "4: `x`"), (&commas, "1: 6 fields separated by commas")];
    for (rows, begin) in texts {
        let said = message(&format!("{head}{rows}"));
        assert!(said.starts_with(&format!("FRF.csv:2:{begin}")), "{said}");
    }
    let negative: String = (1..10).map(|i| format!("{i},-{i}\n")).collect();
    for (header, rows, part) in [
        ("# nothing", "\n", "no data"),
        ("words", "more words\n", "no row of numbers"),
        ("frequency_hz,real,other", &body, "no column of imaginary part"),
        ("x,real,imag", &body, "no column of frequency"),
        ("frequency_hz,x,y", &body, "no column of response"),
        ("frequency_hz,real,imag", "10,1,2\n", "1 samples; 8 or more are needed"),
        ("f;re;im", "1.000,5;1;2\n", "comma and point"),
        ("f,magnitude", &negative, "decibels"),
    ] {
        has(&message(&format!("{header}\n{rows}")), &[part]);
    }
    has(&message(""), &["no data"]);
}

#[test]
fn columns_without_names_are_read_only_where_the_numbers_leave_no_doubt() {
    let complex = rows(",", ".", "\n");
    assert!(read_response(complex.as_bytes(), "x", None).unwrap().response.has_phase());
    let magnitude: String = (1..12).map(|i| format!("{i} {}\n", 0.1 * f64::from(i))).collect();
    assert!(!read_response(magnitude.as_bytes(), "x", None).unwrap().response.has_phase());
    let doubtful: String = (1..12).map(|i| format!("{i} {i} {i}\n")).collect();
    has(&message(&doubtful), &["add a first line such as"]);
}

#[test]
fn signals_are_read_with_time_column_or_rate() {
    let read = |text: &str, rate| read_signal(text.as_bytes(), "x", rate).unwrap();
    let tone = |i: usize| (0.3 * i as f64).sin();
    let timed: String =
        (0..40).map(|i| format!("{:.6},{},{i}\n", 2e-6 * i as f64, tone(i))).collect();
    let file = read(&format!("time_s,a_r_m_per_s2,other\n{timed}"), None);
    assert!((file.sampling_rate / 5e5 - 1.0).abs() < 1e-9);
    let [first, second] = &file.channels[..] else { panic!("two channels") };
    assert_eq!((first.name.as_str(), second.samples[39]), ("a_r_m_per_s2", 39.0));
    // Without names: the first column advances evenly, so it is the time.
    assert!((read(&timed, None).sampling_rate / 5e5 - 1.0).abs() < 1e-9);
    let milli: String =
        (0..40).map(|i| format!("{}\t{}\n", 0.02 * f64::from(i), tone(i as usize))).collect();
    let file = read(&format!("Time (ms)\tacc\n{milli}"), None);
    assert!((file.sampling_rate / 5e4 - 1.0).abs() < 1e-9);
    let bare: String = (0..40).map(|i| format!("{}\n", tone(i))).collect();
    assert_eq!(read(&bare, Some(51_200.0)).sampling_rate, 51_200.0);
    assert_eq!(read(&format!("# Sampling rate: 51.2 kHz\n{bare}"), None).sampling_rate, 51_200.0);
    let error = read_signal(bare.as_bytes(), "x", None).unwrap_err();
    assert!(error.problem.starts_with("no time column and no sampling rate"), "{error}");
}

#[test]
fn gaps_and_disorder_in_time_are_refused_at_their_line() {
    let refused = |milliseconds: Vec<u32>, rate| {
        let row = |i: u32| format!("{},{}\n", 0.001 * f64::from(i), i);
        let rows: String = milliseconds.into_iter().map(row).collect();
        read_signal(format!("t,x\n{rows}").as_bytes(), "s.csv", rate).unwrap_err()
    };
    let gap = refused((0..40).filter(|i| *i != 20).collect(), None).to_string();
    assert!(gap.starts_with("s.csv:22:1: time 0.021 s is not on the grid"), "{gap}");
    let back = refused((0..40).map(|i| if i == 20 { 3 } else { i }).collect(), None).to_string();
    assert!(back.starts_with("s.csv:22:1: time 0.003 s does not follow"), "{back}");
    has(&refused((0..40).collect(), Some(500.0)).problem, &["the option 500 Hz"]);
}
