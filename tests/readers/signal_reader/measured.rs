//! Tables as analysers and other programs write them.

use super::{message, read_response, read_signal, rows};
use crate::prelude::*;
use frictionsim::signal::reader::ResponseFile;

fn read(text: &str, columns: &[&str], channels: &[&str]) -> ResponseFile {
    let owned = |names: &[&str]| names.iter().map(ToString::to_string).collect();
    let (columns, channels) = (owned(columns), owned(channels));
    let quantity = Some(ResponseQuantity::Accelerance);
    let options = ResponseOptions { quantity, columns, channels };
    let file = reader::read_response(text.as_bytes(), "x", &options);
    file.unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Rows of a frequency and what a function makes of a complex response of one mode at 60 Hz.
fn table(header: &str, row: impl Fn(f64, c64) -> String) -> String {
    let rows = (1..=12).map(|k| {
        let f = 10.0 * f64::from(k);
        row(f, 1e3 / c64::new(3600.0 - f * f, 12.0 * f))
    });
    format!("{header}\n{}\n", rows.collect::<Vec<String>>().join("\n"))
}

/// Exact: two responses whose parts stand in any order are those whose parts stand side by side.
#[test]
fn parts_of_several_responses_are_paired_by_their_names() {
    let other = |h: c64| h * -2.0;
    let beside = |f: f64, h: c64| format!("{f};{};{};{};{}", h.re, h.im, other(h).re, other(h).im);
    let want = read(&table("f;P1 re;P1 im;P2 re;P2 im", beside), &[], &[]).responses;
    let crossed = |f: f64, h: c64| format!("{f};{};{};{};{}", h.re, other(h).re, other(h).im, h.im);
    let polar = |f: f64, h: c64| {
        let [a, b] = [h, other(h)].map(|h| (h.norm(), h.arg().to_degrees() + 360.0));
        format!("{f};{};{};{};{}", a.0, b.0, b.1, a.1)
    };
    for text in [
        table("f;re P1;re P2;im P2;im P1", crossed),
        table("f;mag P1;mag P2;phase_deg P2;phase_deg P1", polar),
    ] {
        let found = read(&text, &[], &[]).responses;
        assert_eq!(found.len(), 2);
        for (found, want) in found.iter().zip(&want) {
            assert_eq!(found.name, want.name);
            near_each(found.response.values(), want.response.values(), 1e-9);
        }
    }
}

#[test]
fn every_notation_of_a_complex_response_reads_as_real_and_imaginary_part() {
    let want = read(&table("f,re,im", |f, h| format!("{f},{},{}", h.re, h.im)), &[], &[]);
    let want = &want.responses[0].response;
    let level = |h: c64, reference: f64| 20.0 * (h.norm() / reference).log10();
    let degrees = |h: c64| h.arg().to_degrees();
    let polar = |reference: f64| {
        move |f: f64, h: c64| format!("{f};{};{}", level(h, reference), degrees(h))
    };
    let lbf = 4.448_221_615_260_5;
    let parts = |f: f64, h: c64| format!("{f};{};{}", h.re, h.im);
    let scaled = |scale: f64| move |f: f64, h: c64| parts(f, h / scale);
    let tables = [
        table("Frequency (Hz);Real (mm/s2/N);Imag (mm/s2/N)", scaled(1e-3)),
        table("Frequency;Real;Imag\nHz;(m/s^2)/kN;(m/s^2)/kN", scaled(1e-3)),
        table("f_hz;re_in_per_s2_per_lbf;im_in_per_s2_per_lbf", scaled(0.0254 / lbf)),
        table("# unit: g/N\nf [Hz];Re;Im", scaled(9.806_65)),
        table("f [Hz];H (dB re 1 mm/s^2/N);Phase (deg)", polar(1e-3)),
        table("f [Hz];Magnitude;Phase", |f, h| format!("{f};{};{}", h.norm(), h.arg())),
        table("Frequency (Hz);Magnitude (dB re 1 m/s2/N);Phase (deg)", polar(1.0)),
        table("Frequency (Hz);Magnitude (dB re 1e-6 m/s2/N);Phase (deg)", polar(1e-6)),
        table("Frequency;Real;Imaginary\nHz;m/s2/N;m/s2/N", parts),
        table("Frequency;Real;Imaginary\nHz;(m/s^2)/N;(m/s^2)/N", parts),
        table("Fr\u{e9}quence (Hz);Partie r\u{e9}elle;Partie imaginaire", parts),
        table("Fr\u{e9}quence (Hz);Module;Phase (\u{b0})", |f, h| {
            format!("{f};{};{}", h.norm(), degrees(h))
        }),
        table("Frequency (Hz),H1", |f, h| format!("{f},{}{:+}j", h.re, h.im)),
        table("f,H", |f, h| format!("{f},({}{:+}i)", h.re, h.im)),
        table(
            "\n ***** ANSYS POST26 VARIABLE LISTING *****\n\n     FREQ     2 UZ\n              UZ_2\n        \
             REAL    IMAGINARY",
            |f, h| format!("  {f:.4}   {:.15E}   {:.15E}", h.re, h.im),
        ),
        table(
            "\n ***** ANSYS POST26 VARIABLE LISTING *****\n     FREQ     2 UZ\n      AMPLITUDE    PHASE",
            |f, h| format!("  {f:.4}   {:.15E}   {:.13}", h.norm(), degrees(h)),
        ),
    ];
    let named = read(&table("", parts), &["f", "re", "im"], &[]);
    for file in tables.iter().map(|text| read(text, &[], &[])).chain([named]) {
        let got = &file.responses[0].response;
        assert_eq!(got.frequencies_hz(), want.frequencies_hz());
        // Fifteen digits, and the logarithm of a level.
        near_each(got.values(), want.values(), 1e-11);
    }
}

#[test]
fn a_listing_of_ansys_has_its_errors_at_their_lines() {
    let page = " ***** ANSYS POST26 VARIABLE LISTING *****\n  FREQ   2 UZ\n  REAL   IMAGINARY\n";
    let rows = rows("  ", ".", "\n");
    let said = message(&format!("{page}{rows}{page}  20.0000  1.0  2.0\n"));
    let begin = "FRF.csv:17:3: frequency 20 Hz is already in line 5 with another value";
    assert!(said.starts_with(begin), "{said}");
}

#[test]
fn responses_of_one_table_are_all_read_and_one_is_picked_by_name_or_number() {
    let text = table("f,H11 re,H11 im,H21 re,H21 im,coherence", |f, h| {
        format!("{f},{},{},{},{},{}", h.re, h.im, -h.re, -h.im, if f < 50.0 { 0.5 } else { 0.99 })
    });
    let file = read(&text, &[], &[]);
    let names: Vec<&str> = file.responses.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["H11", "H21"]);
    assert!(file.notes.iter().any(|note| note.contains("coherence")), "{:?}", file.notes);
    for named in &file.responses {
        let factors = named.response.variance_factors();
        // (1 - c)/c of 1 over that of 0.99.
        assert!((factors[0] - 99.0).abs() < 1e-9 && factors[6] == 1.0, "{factors:?}");
    }
    for wanted in ["H21", "2"] {
        let file = read(&text, &[], &[wanted]);
        assert_eq!((file.responses.len(), file.responses[0].name.as_str()), (1, "H21"));
    }
    let options = ResponseOptions { channels: vec!["H31".into()], ..Default::default() };
    let error = reader::read_response(text.as_bytes(), "x", &options);
    has(&error.unwrap_err().to_string(), &["there is no channel H31: the file has H11, H21"]);
}

#[test]
fn the_other_sign_of_time_is_seen_said_and_turned() {
    let plain = read(&table("f,re,im", |f, h| format!("{f},{},{}", h.re, h.im)), &[], &[]);
    let turned = read(&table("f,re,im", |f, h| format!("{f},{},{}", h.re, -h.im)), &[], &[]);
    assert_eq!(turned.responses, plain.responses);
    assert!(turned.notes[0].contains("exp(-i omega t)"), "{:?}", turned.notes);
    assert!(plain.notes.is_empty(), "{:?}", plain.notes);
}

#[test]
fn frequencies_that_look_like_kilohertz_are_doubted_where_no_unit_is_written() {
    let small = |header: &str| table(header, |f, h| format!("{},{},{}", f / 12.0, h.re, h.im));
    assert!(read(&small("Frequency,re,im"), &[], &[]).notes[0].contains("if they are kHz"));
    assert!(read(&small("Frequency (Hz),re,im"), &[], &[]).notes.is_empty());
    assert!(read(&small("x,y,z"), &["f_khz", "re", "im"], &[]).notes.is_empty());
}

#[test]
fn phases_that_look_like_radians_and_units_of_no_response_are_doubted() {
    let polar = |header: &str, unit: f64| {
        read(&table(header, |f, h| format!("{f};{};{}", h.norm(), h.arg() * unit)), &[], &[]).notes
    };
    has(&polar("f_hz;mag;phase", 1.0).join(" "), &["taken as radians ; `phase_deg`"]);
    has(&polar("f_hz;mag (mV/N);phase_rad", 1.0).join(" "), &["`mV/N` is no unit"]);
    for (header, unit) in [("f_hz;mag (m/s2/N);phase_rad", 1.0), ("f_hz;mag;phase", 57.3)] {
        assert!(polar(header, unit).is_empty(), "{header}");
    }
}

#[test]
fn columns_without_names_ask_for_them_and_a_wrong_number_of_names_is_refused() {
    let doubtful: String = (1..12).map(|i| format!("{i} {i} {i}\n")).collect();
    has(&message(&doubtful), &["--columns f,re,im"]);
    let options = ResponseOptions { columns: vec!["f".into(), "re".into()], ..Default::default() };
    let error = reader::read_response(rows(",", ".", "\n").as_bytes(), "x", &options);
    has(&error.unwrap_err().to_string(), &["names 2 columns, the table has 3"]);
    let no_unit = read_response(b"10,0.1+0.2j,x\n20,0.1+0.2j,y\n", "x", None).err().unwrap();
    assert!(no_unit.to_string().starts_with("x:1:13: `x` in column 3"), "{no_unit}");
}

#[test]
fn time_stamps_are_seconds_from_the_first_also_past_midnight() {
    let stamp = |k: u32| match k {
        0..200 => format!("2024-05-01 23:59:{:05.2}", 58.0 + 0.01 * f64::from(k)),
        _ => format!("2024-05-02 00:00:{:05.2}", 0.01 * f64::from(k - 200)),
    };
    for separator in [",", "\t", " "] {
        let row = |k| format!("{}{separator}{}\n", stamp(k), (0.3 * f64::from(k)).sin());
        let rows: String = (0..400).map(row).collect();
        for text in [rows.clone(), format!("date time{separator}x\n{rows}")] {
            let file = read_signal(text.as_bytes(), "x", None).unwrap();
            assert!((file.sampling_rate / 100.0 - 1.0).abs() < 1e-6, "{}", file.sampling_rate);
            assert_eq!(file.channels.len(), 1);
        }
    }
    let clock = |k: u32| format!("12:00:00,{k:02};{k}\n");
    let file = read_signal((0..40).map(clock).collect::<String>().as_bytes(), "x", None).unwrap();
    assert!((file.sampling_rate / 100.0 - 1.0).abs() < 1e-6);
}

#[test]
fn a_rounded_time_column_asks_for_the_rate_and_is_overruled_by_it() {
    let row = |k: f64| format!("{:.4},{}\n", k / 51_200.0, (TAU * 0.1 * k).sin());
    let text = format!("t,x\n{}", (0..400).map(|k| row(f64::from(k))).collect::<String>());
    let error = read_signal(text.as_bytes(), "x", None).unwrap_err().to_string();
    has(&error, &["rounded to 0.0001 s ; --rate HZ"]);
    let file = read_signal(text.as_bytes(), "x", Some(51_200.0)).unwrap();
    assert_eq!(file.sampling_rate, 51_200.0);
    assert!(file.notes[0].contains("replaces the time column"), "{:?}", file.notes);
    // Half the rate is no rounding.
    assert!(read_signal(text.as_bytes(), "x", Some(25_600.0)).is_err());
}

#[test]
fn signal_columns_are_named_and_skipped_on_request() {
    let rows: String = (0..40).map(|k| format!("{k},{},{}\n", 2 * k, 3 * k)).collect();
    let columns = ["t_ms", "-", "mic"].map(String::from).to_vec();
    let options = SignalOptions { columns, ..SignalOptions::default() };
    let file = reader::read_signal(rows.as_bytes(), "x", &options).unwrap();
    assert_eq!(file.sampling_rate, 1e3);
    assert_eq!((file.channels.len(), file.channels[0].name.as_str()), (1, "mic"));
}
