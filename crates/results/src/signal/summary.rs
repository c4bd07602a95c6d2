//! Summary of `signal`, as it is written, printed and reported.

use frictionsim_output::Described;
use frictionsim_physics::cea::ComplexMode;
use frictionsim_signal::{ExponentialStage, NoGrowth, SpectralLine, SpectralResolution};
use serde::Serialize;

/// Largest distance of a line from a mode that it is said to belong to, relative to the line.
pub const MODE_TOLERANCE: f64 = 0.03;

/// What was found in a record.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct SignalSummary {
    /// Name of the table.
    pub source: String,
    /// Sampling rate, Hz.
    pub sampling_rate_hz: f64,
    /// Samples of each channel.
    pub samples: usize,
    /// Friction coefficient of the modes, where a case was given.
    pub friction_coefficient: Option<f64>,
    /// Largest relative distance of a line from a mode named beside it.
    pub mode_tolerance: f64,
    /// The channels.
    pub channels: Vec<ChannelSummary>,
    /// Decisions of the reader.
    pub notes: Vec<String>,
}

/// What was found in one channel.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct ChannelSummary {
    /// Name as in the table.
    pub name: String,
    /// Interval from which the peaks are taken, s.
    pub interval_s: [f64; 2],
    /// Smallest distance of two peaks, Hz.
    pub resolution_hz: f64,
    /// Blocks that the spectrum is a mean of.
    pub averages: usize,
    /// Strongest peak that is no superharmonic, Hz.
    pub main_frequency_hz: Option<f64>,
    /// Peaks, strongest first.
    pub peaks: Vec<PeakSummary>,
    /// The exponential stage, if there is one.
    pub growth: Option<ExponentialStage>,
    /// Why there is none.
    pub no_growth: Option<String>,
    /// The mode that the channel vibrates in: one that can squeal.
    pub mode: Option<ModeSummary>,
    /// The unstable mode nearest to the vibration, and its distance.
    pub nearest_unstable_mode: Option<NearestMode>,
}

/// A line of the spectrum, and the mode beside it.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct PeakSummary {
    /// The line.
    #[serde(flatten)]
    pub line: SpectralLine,
    /// Mode within the tolerance: an unstable one before a stable one.
    pub nearest_mode: Option<ModeSummary>,
}

/// A mode of the case.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct ModeSummary {
    /// Number by frequency, from 1.
    pub mode: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Growth rate, 1/s.
    pub growth_rate_per_s: f64,
    /// Circumferential harmonic; none on a body without symmetry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub harmonic: Option<usize>,
    /// Branch of that harmonic, or of the body.
    pub branch: usize,
    /// +1 with the rotor, -1 against it, 0 standing; none on a body without symmetry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<i8>,
    /// Whether it grows.
    pub unstable: bool,
}

/// A mode and how far it is away.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct NearestMode {
    /// The mode.
    #[serde(flatten)]
    pub mode: ModeSummary,
    /// Distance relative to the frequency of the vibration.
    pub distance: f64,
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
        let numbered = modes.iter().enumerate();
        numbered
            .map(|(number, mode)| Self {
                mode: number + 1,
                frequency_hz: mode.frequency_hz(),
                growth_rate_per_s: mode.growth_rate(),
                harmonic: mode.diameters(has_harmonics),
                branch: mode.branch,
                direction: has_harmonics.then_some(mode.direction),
                unstable: mode.is_unstable(),
            })
            .collect()
    }

    /// Number and harmonic, as figures name it.
    pub fn label(&self) -> String {
        let harmonic = self.harmonic.map_or(String::new(), |n| format!(", *n* = {n}"));
        format!("mode {}{harmonic}", self.mode)
    }

    /// The mode in words.
    pub fn described(&self) -> String {
        format!(
            "mode {} ({}branch {}, {:.1} Hz{})",
            self.mode,
            self.harmonic.map_or(String::new(), |n| format!("n = {n}, ")),
            self.branch,
            self.frequency_hz,
            if self.unstable { ", unstable" } else { "" }
        )
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
        let Some(frequency_hz) = growing.or(self.main_frequency_hz) else {
            return;
        };
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
        let (rate, f) = (stage.rate_per_s, stage.frequency_hz);
        format!(
            "{} from {:.4} to {:.4} s: rate {:.2} 1/s [{:.2}, {:.2}] at {:.2} Hz [{:.2}, {:.2}]",
            if rate.value > 0.0 { "grows" } else { "decays" },
            stage.start_s,
            stage.end_s,
            rate.value,
            rate.low,
            rate.high,
            f.value,
            f.low,
            f.high
        )
    }

    /// The mode that it vibrates in, or that there is none; `None` where no case was given.
    pub fn mode_text(&self, friction_coefficient: Option<f64>) -> Option<String> {
        let friction = friction_coefficient?;
        let percent = 100.0 * MODE_TOLERANCE;
        if let Some(mode) = &self.mode {
            let rate = mode.growth_rate_per_s;
            let verb = if rate > 0.0 { "grows" } else { "decays" };
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
            None => "the case has none in this range".to_owned(),
        };
        Some(format!(
            "no mode that is unstable at a friction coefficient of {friction} within {percent} %: {nearest}"
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
