//! `frictionsim signal` on a synthetic squeal, beside the modes of a case.

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
