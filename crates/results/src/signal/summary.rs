//! Summary of `signal`, as it is written, printed and reported.

use crate::common::*;
use frictionsim_signal::{ExponentialStage, NoGrowth, SpectralLine, SpectralResolution};

/// Largest distance of a line from a mode that it is said to belong to, relative to the line.
pub const MODE_TOLERANCE: f64 = 0.03;

keys! {
    /// What was found in a record.
    SignalSummary {
        source: String = "name of the table";
        sampling_rate_hz: f64 = "sampling rate, Hz";
        samples: usize = "samples of each channel";
        friction_coefficient: Option<f64> = "friction coefficient of the modes, where a case was given";
        mode_tolerance: f64 = "largest relative distance of a line from a mode named beside it";
        channels: Vec<ChannelSummary> = "the channels";
        notes: Vec<String> = "decisions of the reader";
    }

    /// What was found in one channel.
    ChannelSummary {
        name: String = "name as in the table";
        interval_s: [f64; 2] = "interval from which the peaks are taken, s";
        resolution_hz: f64 = "smallest distance of two peaks, Hz";
        averages: usize = "blocks that the spectrum is a mean of";
        main_frequency_hz: Option<f64> = "strongest peak that is no superharmonic, Hz";
        peaks: Vec<PeakSummary> = "peaks, strongest first";
        growth: Option<ExponentialStage> = "the exponential stage, if there is one";
        no_growth: Option<String> = "why there is none";
        mode: Option<ModeSummary> = "the mode that the channel vibrates in: one that can squeal";
        nearest_unstable_mode: Option<NearestMode> = "the unstable mode nearest to the vibration, and its distance";
    }

    /// A line of the spectrum, and the mode beside it.
    PeakSummary {
        #[serde(flatten)]
        line: SpectralLine = "the line";
        nearest_mode: Option<ModeSummary> = "mode within the tolerance: an unstable one before a stable one";
    }

    /// A mode of the case.
    ModeSummary {
        mode: usize = "number by frequency, from 1";
        frequency_hz: f64 = "frequency, Hz";
        growth_rate_per_s: f64 = "growth rate, 1/s";
        harmonic?: usize = "circumferential harmonic; none on a body without symmetry";
        branch: usize = "branch of that harmonic, or of the body";
        direction?: i8 = "+1 with the rotor, -1 against it, 0 standing; none on a body without symmetry";
        unstable: bool = "whether it grows";
    }

    /// A mode and how far it is away.
    NearestMode {
        #[serde(flatten)]
        mode: ModeSummary = "the mode";
        distance: f64 = "distance relative to the frequency of the vibration";
    }
}

impl NearestMode {
    /// The mode nearest to a frequency among those of a kind.
    fn of(
        modes: &[ModeSummary],
        frequency_hz: f64,
        kind: impl Fn(&ModeSummary) -> bool,
    ) -> Option<Self> {
        let distance = |mode: &ModeSummary| (mode.frequency_hz / frequency_hz - 1.0).abs();
        let candidates = modes.iter().filter(|mode| kind(mode));
        let mode = candidates.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        Some(Self { mode: mode.clone(), distance: distance(mode) })
    }

    /// The mode if it is within the tolerance.
    fn within(self) -> Option<ModeSummary> {
        (self.distance <= MODE_TOLERANCE).then_some(self.mode)
    }
}

/// The mode beside a frequency: the nearest unstable one within the tolerance, else the nearest stable one.
fn mode_beside(modes: &[ModeSummary], frequency_hz: f64) -> Option<ModeSummary> {
    let near =
        |kind: fn(&ModeSummary) -> bool| NearestMode::of(modes, frequency_hz, kind)?.within();
    near(|mode| mode.unstable).or_else(|| near(|_| true))
}

impl ModeSummary {
    /// All modes of a case, numbered; those of a body without symmetry have no harmonics.
    pub fn all(modes: &[ComplexMode], has_harmonics: bool) -> Vec<Self> {
        let own = |(number, mode): (usize, &ComplexMode)| Self {
            mode: number + 1,
            frequency_hz: mode.frequency_hz(),
            growth_rate_per_s: mode.growth_rate(),
            harmonic: mode.diameters(has_harmonics),
            branch: mode.branch,
            direction: has_harmonics.then_some(mode.direction),
            unstable: mode.is_unstable(),
        };
        modes.iter().enumerate().map(own).collect()
    }

    /// Number and harmonic, as figures name it.
    pub fn label(&self) -> String {
        let harmonic = self.harmonic.map_or(String::new(), |n| format!(", *n* = {n}"));
        format!("mode {}{harmonic}", self.mode)
    }

    /// The mode in words.
    pub fn described(&self) -> String {
        let Self { mode, branch, frequency_hz, .. } = self;
        let harmonic = self.harmonic.map_or(String::new(), |n| format!("n = {n}, "));
        let unstable = if self.unstable { ", unstable" } else { "" };
        format!("mode {mode} ({harmonic}branch {branch}, {frequency_hz:.1} Hz{unstable})")
    }
}

impl ChannelSummary {
    /// Lines and stage of a channel, without modes.
    pub fn new(
        name: &str,
        interval_s: [f64; 2],
        (resolution, averages): (SpectralResolution, usize),
        lines: &[SpectralLine],
        stage: Result<ExponentialStage, NoGrowth>,
    ) -> Self {
        let main = lines.iter().find(|line| line.superharmonic.is_none());
        let peaks = lines.iter().map(|&line| PeakSummary { line, nearest_mode: None });
        let no_growth = stage.as_ref().err().map(ToString::to_string);
        Self {
            name: name.to_owned(),
            interval_s,
            resolution_hz: resolution.resolution_hz,
            averages,
            main_frequency_hz: main.map(|line| line.frequency_hz),
            peaks: peaks.collect(),
            growth: stage.ok(),
            no_growth,
            mode: None,
            nearest_unstable_mode: None,
        }
    }

    fn grows(&self) -> Option<&ExponentialStage> {
        self.growth.as_ref().filter(|g| g.rate_per_s.low > 0.0)
    }

    /// Names the modes beside the peaks, and the one that the channel vibrates in: a mode that grows in the
    /// record, or else an unstable one beside the main line, within the tolerance.
    pub fn name_modes(&mut self, modes: &[ModeSummary]) {
        for peak in self.peaks.iter_mut().filter(|p| p.line.superharmonic.is_none()) {
            peak.nearest_mode = mode_beside(modes, peak.line.frequency_hz);
        }
        let growing = self.grows().map(|g| g.frequency_hz.value);
        let Some(frequency_hz) = growing.or(self.main_frequency_hz) else { return };
        self.nearest_unstable_mode = NearestMode::of(modes, frequency_hz, |mode| mode.unstable);
        self.mode = match growing {
            Some(frequency_hz) => mode_beside(modes, frequency_hz),
            None => self.nearest_unstable_mode.clone().and_then(NearestMode::within),
        };
    }

    /// What the channel does in time.
    pub fn growth_text(&self) -> String {
        let Some(stage) = &self.growth else {
            let reason = self.no_growth.as_deref().unwrap_or("not looked for");
            return format!("no growth rate: {reason}");
        };
        let does = if stage.rate_per_s.value > 0.0 { "grows" } else { "decays" };
        let [rate, frequency] =
            [(stage.rate_per_s, "1/s"), (stage.frequency_hz, "Hz")].map(|(own, unit)| {
                format!("{:.2} {unit} [{:.2}, {:.2}]", own.value, own.low, own.high)
            });
        let (start, end) = (stage.start_s, stage.end_s);
        format!("{does} from {start:.4} to {end:.4} s: rate {rate} at {frequency}")
    }

    /// The mode that it vibrates in, or that there is none; `None` where no case was given.
    pub fn mode_text(&self, friction_coefficient: Option<f64>) -> Option<String> {
        let friction = friction_coefficient?;
        let percent = 100.0 * MODE_TOLERANCE;
        if let Some(mode) = &self.mode {
            let rate = mode.growth_rate_per_s;
            let (verb, rate) = if rate > 0.0 { ("grows", rate) } else { ("decays", -rate) };
            return Some(format!(
                "vibrates in {}, which {verb} at {rate:.2} 1/s in the eigenvalue analysis",
                mode.described()
            ));
        }
        self.main_frequency_hz?;
        let nearest = match &self.nearest_unstable_mode {
            Some(near) => format!(
                "the nearest is {}, {:.1} % away; a limit cycle may lie that far below its mode",
                near.mode.described(),
                100.0 * near.distance
            ),
            None => "none in this range is".to_owned(),
        };
        Some(format!(
            "no mode within {percent} % is unstable at a friction coefficient of {friction}: {nearest}"
        ))
    }

    /// The name of a peak: a superharmonic, or the mode beside it.
    pub fn peak_text(&self, peak: &PeakSummary) -> String {
        match (&peak.line.superharmonic, &peak.nearest_mode) {
            (Some(line), _) => format!("{} x peak {}", line.order, line.of_peak),
            (None, Some(mode)) => format!("near {}", mode.described()),
            (None, None) => String::new(),
        }
    }
}
