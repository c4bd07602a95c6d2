//! The figure of an identified damping.

use crate::chart::{
    Axis, Figure, Fill, INK, Line, Marker, Panel, Points, Rule, SERIES, Stroke, extremes,
    significant,
};
use crate::results::charts::palette::UNSTABLE;
use crate::signal::{FrequencyResponse, Identification, ResponseQuantity};
use std::f64::consts::TAU;

/// Everything that the figure shows.
#[derive(Clone, Debug, PartialEq)]
pub struct IdentificationRecord {
    /// Frequencies of the response, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Magnitude of the response.
    pub magnitude: Vec<f64>,
    /// Magnitude of the fitted response; `None` outside the range of the fit.
    pub fitted: Vec<Option<f64>>,
    /// Frequency (Hz), damping factor and its standard error of each fitted mode, and 1 if the coefficients rest on it.
    pub modes: Vec<[f64; 4]>,
    /// Its unit.
    pub magnitude_unit: String,
    /// Peak frequency, half-power frequencies (Hz) and damping factor of each resonance.
    pub resonances: Vec<[f64; 4]>,
    /// `alpha_R` and its 95 % interval, 1/s.
    pub mass_coefficient: [f64; 3],
    /// `beta_R` and its 95 % interval, s.
    pub stiffness_coefficient: [f64; 3],
}

impl IdentificationRecord {
    /// What the figure shows of the first response and what was found in it.
    pub fn of(response: &FrequencyResponse, found: &Identification) -> Self {
        let modes = found.modes.iter();
        let resonances = modes.filter_map(|mode| {
            let band = mode.half_power?;
            let (low, high) = band.band_hz?;
            let factor = mode.fitted.damping_factor.value;
            Some([band.frequency_hz, low, high, factor])
        });
        let (alpha, beta) = (found.rayleigh.mass_coefficient, found.rayleigh.stiffness_coefficient);
        let modes = found.modes.iter().map(|mode| {
            let (fit, used) = (mode.fitted, f64::from(u8::from(mode.is_used)));
            [fit.frequency_hz.value, fit.damping_factor.value, fit.standard_error, used]
        });
        Self {
            frequencies_hz: response.frequencies_hz().to_vec(),
            magnitude: response.magnitudes(),
            fitted: (response.frequencies_hz().iter())
                .map(|f| found.fit.evaluate(0, *f).map(|h| h.norm()))
                .collect(),
            modes: modes.collect(),
            magnitude_unit: unit_of(response.quantity()).to_owned(),
            resonances: resonances.collect(),
            mass_coefficient: [alpha.value, alpha.low, alpha.high],
            stiffness_coefficient: [beta.value, beta.low, beta.high],
        }
    }
}

/// Unit of a response.
pub fn unit_of(quantity: ResponseQuantity) -> &'static str {
    match quantity {
        ResponseQuantity::Accelerance => "m/s²/N",
        ResponseQuantity::Mobility => "m/s/N",
        ResponseQuantity::Receptance => "m/N",
    }
}

/// The response with its fit and its half-power points, and the damping factors with the fitted curve of equation (3).
pub fn identification(record: &IdentificationRecord) -> Figure {
    let (frequencies, magnitude) = (&record.frequencies_hz, &record.magnitude);
    let fitted: Vec<f64> = record.fitted.iter().map(|value| value.unwrap_or(f64::NAN)).collect();
    let highest = extremes(frequencies.iter().copied()).1;
    let at = |frequency: f64| {
        let index = frequencies.partition_point(|&f| f < frequency);
        magnitude.get(index).or(magnitude.last()).copied().unwrap_or(f64::NAN)
    };
    let halves = record.resonances.iter().flat_map(|&[peak, low, high, _]| {
        // By definition they lie a factor sqrt(2) below the peak.
        [low, high].map(|f| (f, at(peak) / std::f64::consts::SQRT_2))
    });
    let tick = |mode: &[f64; 4]| {
        Rule::vertical(mode[0]).stroke(Stroke::dotted(INK, 0.5)).name("fitted mode")
    };
    let response = Panel::new(
        Axis::kilohertz().tight(),
        Axis::new("|*H*|", &record.magnitude_unit).logarithmic(),
    )
    .height(150.0)
    .layers(record.modes.iter().map(tick).collect::<Vec<_>>())
    .layer(Line::new(frequencies, magnitude).solid(SERIES[0], 0.9).name("measured"))
    .layer(Line::new(frequencies, &fitted).stroke(Stroke::dashed(SERIES[6], 0.7)).name("fitted"))
    .layer(Points::new(halves).marker(Marker::Diamond, 1.3, UNSTABLE).name("half-power points"));
    let omegas = (1..=300).map(|i| TAU * highest * f64::from(i) / 300.0);
    let curve = |mass: f64, stiffness: f64| {
        // (3)
        let factor = move |omega: f64| (omega / TAU, 0.5 * (mass / omega + stiffness * omega));
        Line::through(omegas.clone().map(factor))
    };
    let ([alpha, alpha_low, alpha_high], [beta, beta_low, beta_high]) =
        (record.mass_coefficient, record.stiffness_coefficient);
    let factors =
        |wanted: f64| record.modes.iter().filter(move |m| m[3] == wanted).map(|m| (m[0], m[1]));
    let top = 1.35 * extremes(record.modes.iter().map(|mode| mode[1])).1;
    let bars = record.modes.iter().filter(|mode| mode[3] == 1.0).map(|&[f, factor, error, _]| {
        Line::through([(f, factor - 1.96 * error), (f, factor + 1.96 * error)]).solid(INK, 0.7)
    });
    let bounds = |mass: f64, stiffness: f64| -> Vec<f64> {
        omegas.clone().map(|omega| 0.5 * (mass / omega + stiffness * omega)).collect()
    };
    let hertz: Vec<f64> = omegas.clone().map(|omega| omega / TAU).collect();
    let band = Fill::between(
        &hertz,
        &bounds(alpha_low, beta_low),
        &bounds(alpha_high, beta_high),
        SERIES[0],
    );
    // Bounds to a digit more than the coefficient, so that they do not round onto it.
    let named = |symbol: &str, [value, low, high]: [f64; 3], unit: &str| {
        format!(
            "{symbol} = {} [{}, {}] {unit}",
            significant(value, 4),
            significant(low, 5),
            significant(high, 5)
        )
    };
    let damping = Panel::new(
        Axis::kilohertz().between(0.0, highest),
        Axis::new("damping factor *ζ*", "%").times(100.0).between(0.0, top),
    )
    .height(150.0)
    .layer(band.opacity(0.2))
    .layer(curve(alpha, 0.0).stroke(Stroke::dashed(SERIES[2], 0.9)).name(named(
        "*α*_{R}",
        [alpha, alpha_low, alpha_high],
        "1/s",
    )))
    .layer(curve(0.0, beta).stroke(Stroke::dashed(SERIES[1], 0.9)).name(named(
        "*β*_{R}",
        [beta, beta_low, beta_high],
        "s",
    )))
    .layer(curve(alpha, beta).solid(SERIES[0], 1.2).name("*ζ* = (*α*_{R}/*ω* + *β*_{R}*ω*)/2"))
    .layers(bars.collect::<Vec<_>>())
    .layer(Points::new(factors(0.0)).marker(Marker::Circle, 1.8, INK).name("factor not used"))
    .layer(Points::new(factors(1.0)).marker(Marker::Disc, 1.8, INK).name("fitted factor"));
    Figure::new(
        "identification",
        "Measured and fitted response with half-power points (a). Damping factors of the fitted \
         modes with 95 % intervals, and the curve of the identified coefficients (b).",
    )
    .columns(2)
    .panel(response)
    .panel(damping)
}
