//! The figure of an identified damping.

use crate::charts::palette::UNSTABLE;
use frictionsim_chart::{
    Axis, Figure, Fill, INK, Line, Marker, Panel, Points, Rule, SERIES, Stroke, extremes,
    significant,
};
use frictionsim_signal::{
    Estimate, FittedMode, FrequencyResponse, Identification, ResponseQuantity,
};
use std::f64::consts::TAU;

/// Unit of a response.
pub fn unit_of(quantity: ResponseQuantity) -> &'static str {
    match quantity {
        ResponseQuantity::Accelerance => "m/s²/N",
        ResponseQuantity::Mobility => "m/s/N",
        ResponseQuantity::Receptance => "m/N",
    }
}

/// The first response with its fit and its half-power points, and the damping factors with the fitted curve of equation
/// (3).
pub fn identification(response: &FrequencyResponse, found: &Identification) -> Figure {
    let frequencies = response.frequencies_hz();
    let magnitude = response.magnitudes();
    let fitted =
        frequencies.iter().map(|f| found.fit.evaluate(0, *f).map_or(f64::NAN, |h| h.norm()));
    let fitted: Vec<f64> = fitted.collect();
    let highest = extremes(frequencies.iter().copied()).1;
    let at = |frequency: f64| {
        let index = frequencies.partition_point(|&f| f < frequency);
        magnitude.get(index).or(magnitude.last()).copied().unwrap_or(f64::NAN)
    };
    let bands = found.fit.modes.iter().filter_map(|mode| mode.half_power);
    let halves = bands.filter_map(|band| Some((band.frequency_hz, band.band_hz?)));
    let halves = halves.flat_map(|(peak, [low, high])| {
        // By definition they lie a factor sqrt(2) below the peak.
        [low, high].map(|f| (f, at(peak) / std::f64::consts::SQRT_2))
    });
    let place = |mode: &FittedMode| (mode.frequency_hz.value, mode.damping_factor.value);
    let tick = |mode: &FittedMode| {
        Rule::vertical(place(mode).0).stroke(Stroke::dotted(INK, 0.5)).name("fitted mode")
    };
    let response = Panel::new(
        Axis::kilohertz().tight(),
        Axis::new("|*H*|", unit_of(response.quantity())).logarithmic(),
    )
    .height(150.0)
    .layers(found.fit.modes.iter().map(tick))
    .layer(Line::new(frequencies, &magnitude).solid(SERIES[0], 0.9).name("measured"))
    .layer(Line::new(frequencies, &fitted).stroke(Stroke::dashed(SERIES[6], 0.7)).name("fitted"))
    .layer(Points::new(halves).marker(Marker::Diamond, 1.3, UNSTABLE).name("half-power points"));
    let (alpha, beta) = (found.rayleigh.mass_coefficient, found.rayleigh.stiffness_coefficient);
    let omegas = (1..=300).map(|i| TAU * highest * f64::from(i) / 300.0);
    let curve = |mass: f64, stiffness: f64| -> Vec<f64> {
        // (3)
        omegas.clone().map(|omega| 0.5 * (mass / omega + stiffness * omega)).collect()
    };
    let hertz: Vec<f64> = omegas.clone().map(|omega| omega / TAU).collect();
    let line = |mass: f64, stiffness: f64| Line::new(&hertz, &curve(mass, stiffness));
    let used = |is_used: bool| found.fit.modes.iter().filter(move |mode| mode.is_used() == is_used);
    let top = 1.35 * extremes(found.fit.modes.iter().map(|mode| place(mode).1)).1;
    let bars = used(true).map(|mode| {
        let ((f, factor), reach) = (place(mode), 1.96 * mode.standard_error);
        Line::through([(f, factor - reach), (f, factor + reach)]).solid(INK, 0.7)
    });
    let (low, high) = (curve(alpha.low, beta.low), curve(alpha.high, beta.high));
    let band = Fill::between(&hertz, &low, &high, SERIES[0]);
    // Bounds to a digit more than the coefficient, so that they do not round onto it.
    let named = |symbol: &str, own: Estimate, unit: &str| {
        let [low, high] = [own.low, own.high].map(|end| significant(end, 5));
        format!("{symbol} = {} [{low}, {high}] {unit}", significant(own.value, 4))
    };
    let dashed = |colour| Stroke::dashed(colour, 0.9);
    let damping = Panel::new(
        Axis::kilohertz().between(0.0, highest),
        Axis::new("damping factor *ζ*", "%").times(100.0).between(0.0, top),
    )
    .height(150.0)
    .layer(band.opacity(0.2))
    .layer(line(alpha.value, 0.0).stroke(dashed(SERIES[2])).name(named("*α*_{R}", alpha, "1/s")))
    .layer(line(0.0, beta.value).stroke(dashed(SERIES[1])).name(named("*β*_{R}", beta, "s")))
    .layer(
        line(alpha.value, beta.value)
            .solid(SERIES[0], 1.2)
            .name("*ζ* = (*α*_{R}/*ω* + *β*_{R}*ω*)/2"),
    )
    .layers(bars)
    .layer(
        Points::new(used(false).map(place))
            .marker(Marker::Circle, 1.8, INK)
            .name("factor not used"),
    )
    .layer(Points::new(used(true).map(place)).marker(Marker::Disc, 1.8, INK).name("fitted factor"));
    Figure::new(
        "identification",
        "Measured and fitted response with half-power points (a). Damping factors of the fitted \
         modes with 95 % intervals, and the curve of the identified coefficients (b).",
    )
    .columns(2)
    .panel(response)
    .panel(damping)
}
