//! Universal, WAV and MATLAB files, and those that are not read.

use super::{read_response, read_signal};
use crate::prelude::*;
use frictionsim::signal::reader::*;

/// Channels of these names at 50 kHz, all of the same samples.
pub fn signal(names: &[&str], samples: &[f64]) -> SignalFile {
    let channel = |name: &&str| Channel { name: name.to_string(), samples: samples.to_vec() };
    let channels = names.iter().map(channel).collect();
    SignalFile { sampling_rate: 5e4, start: 0.0, channels, notes: Vec::new() }
}

/// A WAV file of one channel at 50 kHz.
pub fn wave(samples: &[f64]) -> Vec<u8> {
    write_wav(&signal(&[""], samples), 1).unwrap()
}

/// An element of a MATLAB file, filled up to eight bytes.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut out = kind.to_le_bytes().to_vec();
    out.extend((data.len() as u32).to_le_bytes());
    out.extend(data);
    out.resize(out.len().next_multiple_of(8), 0);
    out
}

/// A double array, `columns` of one length.
fn array(name: &str, columns: &[&[f64]], imaginary: Option<&[f64]>) -> Vec<u8> {
    let flags = 6 | if imaginary.is_some() { 0x800 } else { 0 };
    let numbers = |values: &mut dyn Iterator<Item = f64>| -> Vec<u8> {
        element(9, &values.flat_map(f64::to_le_bytes).collect::<Vec<u8>>())
    };
    let sizes = [columns[0].len() as u32, columns.len() as u32];
    let mut data = element(6, &[u32::to_le_bytes(flags), [0; 4]].concat());
    data.extend(element(5, &sizes.map(u32::to_le_bytes).concat()));
    data.extend(element(1, name.as_bytes()));
    data.extend(numbers(&mut columns.iter().flat_map(|c| c.iter().copied())));
    if let Some(parts) = imaginary {
        data.extend(numbers(&mut parts.iter().copied()));
    }
    element(14, &data)
}

fn matlab_file(variables: &[Vec<u8>], compressed: bool) -> Vec<u8> {
    let mut out = vec![b' '; 124];
    out[..10].copy_from_slice(b"MATLAB 5.0");
    out.extend([0, 1, b'I', b'M']);
    for variable in variables {
        if compressed {
            let mut zlib = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
            zlib.write_all(variable).unwrap();
            let data = zlib.finish().unwrap();
            out.extend(15u32.to_le_bytes());
            out.extend((data.len() as u32).to_le_bytes());
            out.extend(data);
        } else {
            out.extend(variable);
        }
    }
    out
}

/// A MATLAB file of a signal and its sampling rate.
pub fn matlab(samples: &[f64], compressed: bool) -> Vec<u8> {
    let variables = [array("fs", &[&[5e4]], None), array("acceleration", &[samples], None)];
    matlab_file(&variables, compressed)
}

fn named() -> NamedResponse {
    let f: Vec<f64> = (1..40).map(|k| 12.5 * f64::from(k)).collect();
    let h = f.iter().map(|f| 1.0 / c64::new(250.0 * 250.0 - f * f, 5.0 * f)).collect();
    let response = FrequencyResponse::new(f, h, ResponseQuantity::Mobility).unwrap();
    NamedResponse { name: "disc 12:+Z".into(), response }
}

/// The binary form of a dataset in text.
fn binary(text: &str, values: &[c64], is_big: bool) -> Vec<u8> {
    let (order, bytes): (u8, fn(f64) -> [u8; 8]) =
        if is_big { (2, f64::to_be_bytes) } else { (1, f64::to_le_bytes) };
    let (head, size) = (text.lines().collect::<Vec<_>>()[2..13].join("\r\n"), 16 * values.len());
    let head = format!("    -1\r\n    58b{order:>6}     2          11{size:>12}\r\n{head}\r\n");
    let numbers = values.iter().flat_map(|z| [z.re, z.im].map(bytes).concat());
    [head.as_bytes(), &numbers.collect::<Vec<u8>>(), b"    -1\r\n"].concat()
}

#[test]
fn universal_files_in_text_and_binary_give_back_the_response() {
    let want = named();
    let text = want.written([(0, 0); 2]);
    let check = |bytes: &[u8], tolerance: f64| {
        let file = reader::read_response(bytes, "x", &ResponseOptions::default()).unwrap();
        assert_eq!(file.responses[0].name, want.name);
        let got = &file.responses[0].response;
        assert_eq!(got.quantity(), ResponseQuantity::Mobility);
        near_each(got.values(), want.response.values(), tolerance);
        near_each(got.frequencies_hz(), want.response.frequencies_hz(), 1e-9);
    };
    // Twelve decimals in text; eight bytes in binary.
    check(text.as_bytes(), 1e-12);
    check(&binary(&text, want.response.values(), false), 0.0);
    check(&binary(&text, want.response.values(), true), 0.0);
    // Other datasets around it, and a sign as the only separator.
    let crowded = format!("    -1\n   151\nheader\n    -1\n{}", text.replace("E-05 -", "E-05-"));
    check(crowded.as_bytes(), 1e-12);
    let cut = &text[..text.len() - 200];
    let error = read_response(cut.as_bytes(), "cut.uff", None).err().unwrap().to_string();
    assert!(error.starts_with("cut.uff: universal file: dataset 58 number 1"), "{error}");
    has(&read_signal(text.as_bytes(), "x", None).unwrap_err().to_string(), &["no time response"]);
}

/// Several functions in one file, binary ones too, in the units of the file or those of their axes.
#[test]
fn every_function_of_a_universal_file_is_read_in_its_units() {
    let want = named();
    let text = want.written([(0, 0); 2]);
    let bytes = binary(&text, want.response.values(), false);
    let read = |bytes: &[u8]| reader::read_response(bytes, "x", &ResponseOptions::default());
    for bytes in [text.as_bytes(), &bytes] {
        let file = read(&[bytes, text.as_bytes(), bytes].concat()).unwrap();
        assert_eq!((file.responses.len(), file.notes.len()), (3, 0), "{:?}", file.notes);
    }
    let units = |length: &str, force: &str| {
        format!("    -1\n   164\n         5mm\n  {length}  {force}  1.0D+00\n  0.0D+00\n    -1\n")
    };
    // Labels of the ordinate's numerator and denominator, the second and third of the axes.
    let labelled = |[motion, force]: [&str; 2]| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for (line, label) in [(10, motion), (11, force)] {
            lines[line].replace_range(47..67, &format!("{label:<20}"));
        }
        lines.join("\n") + "\n"
    };
    let lbf = 4.448_221_615_260_5;
    for (file, factor) in [
        (units("1.0D+03", "1.0D+00") + &text, 1e-3),
        (units("1.0D+03", "1.0D+03") + &text, 1.0),
        // What the axis says counts.
        (units("1.0D+03", "1.0D+00") + &labelled(["m/s", "N"]), 1.0),
        (labelled(["mm/s", "NONE"]), 1e-3),
        (labelled(["(in/s)/lbf", "NONE"]), 0.0254 / lbf),
        (labelled(["m/s", "kN"]), 1e-3),
    ] {
        let file = read(file.as_bytes()).unwrap();
        let expected: Vec<c64> = want.response.values().iter().map(|z| z * factor).collect();
        near_each(file.responses[0].response.values(), &expected, 1e-11);
        assert!(file.notes.is_empty(), "{:?}", file.notes);
    }
    has(&read(labelled(["V", "NONE"]).as_bytes()).unwrap().notes[0], &["its unit is not known"]);
    // A ratio of two motions is no response to a force.
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    lines[11].replace_range(..10, &format!("{:>10}", 12));
    let ratio = lines.join("\n") + "\n";
    let left = read((ratio.clone() + &text).as_bytes()).unwrap();
    assert_eq!(left.responses.len(), 1);
    has(&left.notes[0], &["left out: disc 12:+Z ; not over a force"]);
    has(&read(ratio.as_bytes()).unwrap_err().to_string(), &["no frequency response to a force"]);
}

#[test]
fn signals_come_back_from_universal_wav_and_matlab_files() {
    let samples: Vec<f64> = (0..300).map(|k| (0.37 * f64::from(k)).sin()).collect();
    let file = write_signal(&signal(&["a", "b"], &samples));
    let universal = read_signal(file.as_bytes(), "x", None).unwrap();
    assert_eq!(universal.channels.len(), 2);
    assert_eq!(universal.channels[1].name, "b");
    for bytes in [matlab(&samples, false), matlab(&samples, true)] {
        let matlab = read_signal(&bytes, "x", None).unwrap();
        assert_eq!(matlab.channels[0].name, "acceleration");
        assert_eq!(matlab.channels[0].samples, samples);
        assert_eq!(matlab.sampling_rate, 5e4);
    }
    for read in [&universal, &read_signal(&wave(&samples), "x", None).unwrap()] {
        assert!((read.sampling_rate / 5e4 - 1.0).abs() < 1e-5);
        assert_eq!(read.channels[0].samples.len(), samples.len());
    }
    let overruled = read_signal(&wave(&samples), "x", Some(1e5)).unwrap();
    assert_eq!((overruled.sampling_rate, overruled.notes.len()), (1e5, 1));
}

#[test]
fn a_universal_file_keeps_the_step_of_its_axis() {
    for sampling_rate in [44_100.0, 51_200.0, 5e4, 1.0 / 3.0] {
        let file = SignalFile { sampling_rate, start: -1.0 / 3.0, ..signal(&["a"], &[1.0; 20]) };
        let read = read_signal(write_signal(&file).as_bytes(), "x", None).unwrap();
        assert!((read.sampling_rate / sampling_rate - 1.0).abs() < 5e-8, "{sampling_rate}");
        assert!((read.start * 3.0 + 1.0).abs() < 5e-7, "{}", read.start);
    }
    // What five decimals hold is written as before.
    let as_before = "  0.00000E+00  2.00000E-05  0.00000E+00\n";
    assert!(write_signal(&signal(&["a"], &[1.0; 20])).contains(as_before));
}

#[test]
fn matlab_responses_are_complex_columns_beside_a_frequency() {
    let want = named().response;
    let parts = |part: fn(&c64) -> f64| want.values().iter().map(part).collect::<Vec<f64>>();
    let (re, im) = (parts(|z| z.re), parts(|z| z.im));
    let variables = [array("freq", &[want.frequencies_hz()], None), array("H", &[&re], Some(&im))];
    let bytes = matlab_file(&variables, true);
    let read = read_response(&bytes, "x", Some(ResponseQuantity::Mobility)).unwrap();
    assert_eq!(read.response, want);
    // A matrix alone is a table without names.
    let matrix = matlab_file(&[array("data", &[want.frequencies_hz(), &re, &im], None)], false);
    let options = ResponseOptions {
        quantity: Some(ResponseQuantity::Mobility),
        columns: ["f", "re", "im"].map(String::from).to_vec(),
        ..Default::default()
    };
    let read = reader::read_response(&matrix, "x", &options);
    assert_eq!(read.unwrap().responses[0].response, want);
}

#[test]
fn a_file_of_another_format_is_named_with_the_formats_that_are_read() {
    for (bytes, name) in
        [(&b"\x89HDF\r\n\x1a\n"[..], "HDF5"), (b"PK\x03\x04....", "ZIP"), (b"\x93NUMPY", "NumPy")]
    {
        for error in [read_response(bytes, "x", None).err(), read_signal(bytes, "x", None).err()] {
            has(&error.unwrap().to_string(), &[name, "UFF/UNV, dataset 58"]);
        }
    }
    let error = read_response(&wave(&[0.0; 20]), "x", None).err().unwrap().to_string();
    has(&error, &["frictionsim signal"]);
}

/// A compressed array of zeros, a byte each.
#[test]
fn a_small_file_that_inflates_to_a_huge_one_is_refused() {
    let count = 100 << 20;
    let parts = [
        element(6, &[9, 0, 0, 0, 0, 0, 0, 0]),
        element(5, &[count, 1].map(u32::to_le_bytes).concat()),
        element(1, b"zeros"),
        element(2, &vec![0; count as usize]),
    ];
    let bytes = matlab_file(&[element(14, &parts.concat())], true);
    assert!(bytes.len() < 1 << 20);
    let error = read_signal(&bytes, "bomb.mat", Some(1e3)).unwrap_err().to_string();
    has(&error, &["MATLAB file ; million numbers, the limit"]);
}
