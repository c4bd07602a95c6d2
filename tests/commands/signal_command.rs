//! `frictionsim signal` on a synthetic squeal, beside the modes of a case.

use crate::draws::draws;
use crate::prelude::*;

/// What is measured, beside the disc.
fn beside(name: &str, measured: &str) -> TempDir {
    let disc = disc_of([90, 18], "");
    folder_with(&[(name, measured.as_bytes()), ("disc.toml", disc.as_bytes())])
}

/// Grows at 600 1/s and 9.87 kHz into a limit cycle at 9.44 kHz with superharmonics; sampled each 2 us.
fn squeal() -> String {
    let rate = 5e5;
    let (mut phase, mut amplitude): (f64, f64) = (0.0, 1e-3);
    let mut text = "time_s,a_r_m_per_s2\n".to_string();
    for j in 0..25_000 {
        let saturation = amplitude * amplitude;
        amplitude += 600.0 * amplitude * (1.0 - saturation) / rate;
        phase += TAU * (9870.0 - 430.0 * saturation) / rate;
        let bent = amplitude * saturation;
        let a = amplitude * phase.sin()
            + 0.4 * bent * (2.0 * phase).sin()
            + 0.2 * bent * (3.0 * phase).cos();
        text += &format!("{:.6e},{a:.9e}\n", f64::from(j) / rate);
    }
    text
}

#[test]
fn a_squeal_is_named_by_its_mode_with_superharmonics_and_growth_rate() {
    let folder = beside("probe.csv", &squeal());
    let words = ["signal", "probe.csv", "--case", "disc.toml", "--json", "--quiet"];
    let summary = Run::new(&words).within(&folder).done().value();
    let channel = &summary["channels"][0];
    let main = channel["main_frequency_hz"].as_f64().unwrap();
    // 0.1 %: what the comparison of limit cycles asks for.
    assert!((main / 9440.0 - 1.0).abs() < 1e-3, "{main}");
    let peaks = channel["peaks"].as_array().unwrap().iter();
    assert!(peaks.filter_map(|p| p["superharmonic"]["order"].as_u64()).eq([2, 3]), "{channel}");
    let rate = channel["growth"]["rate_per_s"]["value"].as_f64().unwrap();
    assert!((rate / 600.0 - 1.0).abs() < 0.02, "{rate}");
    // The growing mode near 9.87 kHz is the lowest of n = 2 and travels against the rotor.
    let own = ["harmonic", "branch", "direction"].map(|key| &channel["mode"][key]);
    assert_eq!(own, [2, 1, -1]);
    let figures = folder.path().join("results/probe/signal/figures");
    assert!(figures.join("signal-1.svg").exists() && figures.join("spectrum-1.png").exists());
}

/// The run ended with an error: no mode lies below 1.3 times the frequency of the tone.
#[test]
fn lines_far_below_every_mode_are_lines_all_the_same() {
    let case = include_str!("../cases/pressed-block.toml").to_owned() + "interference = 1e-5\n";
    let folder = folder_with(&[
        ("block.msh", &plane_block([0.04, 0.03], [6, 4], ["face", "back", "block"])),
        ("block.toml", case.as_bytes()),
        ("tone.csv", tones(2.5e4, 4_000, &[("x", 433.0)]).as_bytes()),
    ]);
    let run = Run::of("signal", "tone.csv").within(&folder).args(&["--case", "block.toml"]);
    run.done().says(&["433.00", "the lowest mode of the case lies far above every line"]);
}

#[test]
fn a_steady_tone_beside_no_unstable_mode_is_given_none_and_can_be_heard() {
    let folder = beside("tone.csv", &tones(2.5e5, 20_000, &[("x", 9433.0)]));
    let run = |more: &[&str]| {
        Run::of("signal", "tone.csv").within(&folder).args(&["--case", "disc.toml"]).args(more)
    };
    let summary = run(&["--json", "--quiet", "--wav", "tone.wav"]).done().value();
    let channel = &summary["channels"][0];
    assert!(channel["mode"].is_null(), "{channel}");
    // The unstable mode of two nodal diameters lies more than 3 % above: too far to be named.
    let nearest = &channel["nearest_unstable_mode"];
    assert_eq!(nearest["harmonic"], 2);
    let [distance, frequency] =
        ["distance", "frequency_hz"].map(|key| nearest[key].as_f64().unwrap());
    // The line is located to a small part of the resolution, a few hertz.
    assert!(distance > 0.03 && (distance - (frequency / 9433.0 - 1.0)).abs() < 1e-3, "{nearest}");
    assert!(channel["growth"].is_null() && channel["no_growth"].is_string());
    // 250 kHz is played five times slower.
    let sound = fs::read(folder.path().join("tone.wav")).unwrap();
    assert_eq!(&sound[24..28], 50_000u32.to_le_bytes());
    for nonsense in [["--window", "0"], ["--resolution", "1"], ["--max-frequency", "0"]] {
        run(&nonsense).refused(&[nonsense[0]]);
    }
}

#[test]
fn a_signal_without_time_needs_a_rate_and_says_so() {
    let rows: String = (0..200).map(|i| format!("{}\n", (0.5 * f64::from(i)).sin())).collect();
    let folder = folder_with(&[("bare.txt", rows.as_bytes())]);
    let run = || Run::new(&["signal", "bare.txt"]).within(&folder);
    run().refused(&["--rate HZ"]);
    // One channel is told once, by one table.
    let said = run().args(&["--rate", "1000"]).done().says(&["peak  frequency (Hz)"]).stdout;
    for once in ["samples at", "peaks between", "peak  frequency"] {
        assert_eq!(said.matches(once).count(), 1, "{once}: {said}");
    }
}

/// A vibration at 2345.6 Hz of an amplitude over time, in noise of 2e-3: so many seconds at 20 kHz, without times.
fn heard(seconds: f64, amplitude: impl Fn(f64) -> f64) -> String {
    let mut draw = draws(7);
    let sample = |k: u32| {
        let time = f64::from(k) / 2e4;
        let noise = 2e-3 * ((0..12).map(|_| draw()).sum::<f64>() - 6.0);
        format!("{:.6e}\n", amplitude(time) * (TAU * 2345.6 * time).sin() + noise)
    };
    (0..(seconds * 2e4) as u32).map(sample).collect()
}

/// What is found in the channel of such a record, which lies in the folder as `heard.txt`.
fn found(folder: &TempDir, options: &[&str]) -> serde_json::Value {
    let run = Run::of("signal", "heard.txt").within(folder).args(options);
    run.args(&["--rate", "20000", "--json", "--quiet"]).done().value()["channels"][0].take()
}

#[test]
fn the_peaks_of_a_squeal_that_is_over_are_those_of_the_squeal() {
    let grown = |t: f64| 1e-4 * (147.0 * (t - 1.0)).exp().min(1000.0);
    let record = heard(4.0, |t| if (1.0..1.6).contains(&t) { grown(t) } else { 0.0 });
    let folder = folder_with(&[("heard.txt", record.as_bytes())]);
    let channel = found(&folder, &[]);
    let main = channel["main_frequency_hz"].as_f64().unwrap();
    assert!((main - 2345.6).abs() < 0.5, "{channel}");
    let amplitude = channel["peaks"][0]["amplitude"].as_f64().unwrap();
    assert!((amplitude / 0.1 - 1.0).abs() < 0.05, "{channel}");
    let [from, to] = [0, 1].map(|k| channel["interval_s"][k].as_f64().unwrap());
    // It has grown a thousandfold after 47 ms.
    assert!((1.03..1.05).contains(&from) && (1.59..1.61).contains(&to), "{channel}");
    // An interval that is asked for is taken, and named where nothing stands out in it.
    let run = Run::of("signal", "heard.txt").within(&folder).out("late");
    let silent = run.args(&["--rate", "20000", "--from", "3", "--to", "3.5"]).done();
    silent.says(&["no peak stands out from the noise between 3.0000 and 3.5000 s", "rate 147"]);
    let noise = Run::of("signal", "noise.txt").beside(&[("noise.txt", heard(1.0, |_| 0.0))]);
    let noise = noise.args(&["--rate", "20000", "--wav", "noise.wav"]).done();
    noise.says(&[
        "no growth rate: no line stands out from the noise between 0 and 1.0000 s",
        "noise.wav: played at its own speed; 1.00 s",
    ]);
}

#[test]
fn a_burst_without_a_line_in_the_mean_spectrum_has_peak_and_rate_and_so_has_its_interval() {
    let record = heard(2.0, |t| 0.5 * (-120.0 * t).exp());
    let folder = folder_with(&[("heard.txt", record.as_bytes())]);
    let channel = found(&folder, &[]);
    let rate = |channel: &serde_json::Value| channel["growth"]["rate_per_s"]["value"].as_f64();
    assert!((rate(&channel).unwrap() / -120.0 - 1.0).abs() < 0.02, "{channel}");
    assert!(channel["interval_s"][1].as_f64() < Some(0.1));
    let part = found(&folder, &["--to", "0.1", "--out", "part"]);
    assert!((rate(&part).unwrap() / -120.0 - 1.0).abs() < 0.02, "{part}");
    assert_eq!(part["interval_s"], serde_json::json!([0.0, 0.1]));
}
