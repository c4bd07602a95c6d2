//! What is said beside the results of an eigenvalue analysis.

use super::{SlidingModel, contact::mean_friction};
use crate::*;
use frictionsim_physics::cea::ModeCount;
use frictionsim_physics::cea::cyclic::{Coverage, Overdamped};
use frictionsim_results::plural;

/// What the counts of modes say.
pub(super) fn count_notes(cea: &Cea, sweep: &FrictionSweep, is_by_harmonics: bool) -> Vec<String> {
    if cea.count_modes && is_by_harmonics {
        let said = "the modes of harmonics that were followed are not counted; with cea.method = \"sparse\" they are";
        return vec![format!("cea.count_modes: {said}")];
    }
    sweep.counts.iter().map(count_note).collect()
}

fn count_note(count: &ModeCount) -> String {
    let ModeCount { friction_coefficient: friction, region, known, recovered, .. } = count;
    let ([low, high], [left, right]) = (region.frequencies_hz, region.growth_rates);
    let searched = match recovered {
        0 => String::new(),
        _ => format!(" ({recovered} of them found by a search that the count gave rise to)"),
    };
    let near = |own: c64| format!(" near {:.0} Hz, growth rate {:.0} 1/s", own.im / TAU, own.re);
    let near = count.near.map(near).unwrap_or_default();
    let counted = count.counted().unwrap_or_default();
    let what = format!("counted {counted} modes below {high:.1} Hz at friction {friction}");
    let place = format!(
        "{low:.1} Hz and above, growth rates {left:.3e} to {right:.3e} 1/s, damping below 0.5"
    );
    match &count.missing {
        Ok(0) => format!("{what}: complete{searched}; {place}"),
        Ok(missing @ 1..) => format!(
            "ALARM: {what}, but {known} are listed: {missing} missing{near}, and a search did not \
            find them{searched}; {place}"
        ),
        Ok(excess) => format!(
            "ALARM: {what}, but {known} are listed: {} of them are none{near}; {place}",
            -excess
        ),
        Err(why) => format!("modes at friction {friction}: {why}"),
    }
}

/// Things of one kind that a note lists.
pub(super) const MISSING_SHOWN: usize = 4;

/// What the tables of moduli give to which part of the analysis.
pub(super) fn table_notes(case: &Case) -> Vec<String> {
    let notes = case.body.tables().map(|table| {
        let [low, high] = table.range_hz();
        format!(
            "{} = \"{}\": each mode is solved at its own frequency (Im / 2 pi), {low} to {high} Hz. The base state, \
             and what damping.stiffness_coefficient multiplies, have the modulus of the lowest one, {:e} Pa",
            table.key,
            table.file,
            table.static_modulus()
        )
    });
    notes.collect()
}

pub(super) fn instead_note(error: &CeaError) -> String {
    let why = match error {
        CeaError::LostHarmonic { harmonic, friction: 0.0 } => format!(
            "a motion of harmonic {harmonic} does not oscillate at friction 0: it diverges, or is \
             damped beyond the critical"
        ),
        CeaError::LostHarmonic { harmonic, friction } => format!(
            "a branch of harmonic {harmonic} could not be followed up to friction {friction}"
        ),
        CeaError::Unproven { harmonic, .. } => {
            format!("harmonic {harmonic} may hold further modes")
        }
        other => other.to_string(),
    };
    format!("{why}: the whole mesh was solved instead, as with cea.method = \"sparse\"")
}

/// Relative uncertainty of an eigenvalue from which on the digits that are printed are in doubt.
const DOUBTFUL: f64 = 1e-8;

/// What an ill-conditioned model does to its eigenvalues.
pub(super) fn uncertainty_note(case: &Case, sweep: &FrictionSweep) -> Option<String> {
    let modes = sweep.points.iter().flat_map(|point| &point.modes);
    let worst = modes.map(|mode| mode.uncertainty).fold(0.0, f64::max);
    if worst < DOUBTFUL {
        return None;
    }
    let penalty = case.contact.stiffness.normal_stiffness.map_or_else(String::new, |stiffness| {
        let size = stiffness * case.body.contact_length() / case.material.young_modulus;
        let lengths = ["the size of the contact", "geometry.inner_radius"];
        let length = lengths[usize::from(case.body.has_sectors())];
        format!(
            "contact.normal_stiffness times {length} is {size:.1e} times \
             material.young_modulus (from 1e6 on leave it out: rigid contact); "
        )
    });
    Some(format!(
        "rounding of the matrices alone leaves eigenvalues uncertain by up to {worst:.0e} (relative): \
         {penalty}material.poisson_ratio is {}, contact.friction_coefficient {}. Where branches meet no digit is safe",
        case.material.poisson_ratio, case.contact.sliding.friction_coefficient,
    ))
}

/// What damping near the critical one hides.
pub(super) fn damping_note(case: &Case, sweep: &FrictionSweep) -> Option<String> {
    let modes = || sweep.points.iter().flat_map(|point| &point.modes);
    if modes().next().is_none() {
        let all = "no mode oscillates: every motion is damped beyond the critical. Is a damping \
            coefficient, a loss factor or a dashpot too large, or the sliding too slow?";
        return sweep.unconverged.is_empty().then(|| all.to_owned());
    }
    let largest = modes().map(|mode| mode.damping_factor()).fold(0.0, f64::max);
    let size = modes().map(|mode| mode.eigenvalue.norm()).fold(0.0, f64::max);
    let at_limit = case.damping.rayleigh.damping_factor(size);
    let factor = largest.max(at_limit);
    if factor <= 0.5 {
        return None;
    }
    let cause = match case.body.kind {
        BodyKind::Revolution(_) if at_limit <= 0.5 => {
            "the dashpot of friction across the sliding, mu p / V, causes it, and grows as the sliding slows down"
        }
        BodyKind::Assembly(_) if at_limit <= 0.5 => {
            "damping of regions, losses, dashpots, or friction across a slow sliding (a dashpot of mu p / V) causes it"
        }
        _ => "damping.mass_coefficient and damping.stiffness_coefficient set it",
    };
    Some(format!(
        "one mode has a damping factor of {factor:.2}. Motions beyond critical damping (1) do not oscillate and are \
         not listed: {cause}"
    ))
}

/// The modes of a whole mesh that friction across slow sliding damps beyond the critical, that change too fast to be
/// followed, that did not converge or grow just above the list, and its rigid motions.
pub(super) fn ended_notes(sweep: &FrictionSweep) -> Vec<String> {
    let (mut damped, mut lost) = (Vec::new(), Vec::new());
    let between =
        |hz: f64, [from, to]: [f64; 2]| format!("{hz:.0} Hz between friction {from} and {to}");
    for mode in &sweep.ended {
        let (frequency, friction) = (mode.frequency_hz, mode.friction_coefficient);
        match mode.lost_before {
            None => damped.push(format!("{frequency:.0} Hz from friction {friction} on")),
            Some(next) => lost.push(between(frequency, [friction, next])),
        }
    }
    lost.extend(sweep.intervals.iter().filter_map(|own| {
        Some(between(own.frequency_hz, [own.lost_after?, own.critical_friction]))
    }));
    let open = sweep.unconverged.iter().map(|mode| {
        format!("{:.0} Hz at friction {}", mode.frequency_hz, mode.friction_coefficient)
    });
    let which = ["mode near critical damping is", "modes near critical damping are"];
    let damped = listed(damped, which).map(|(which, places)| {
        format!(
            "{which} not followed beyond it ({places}). What damps them is a dashpot of the case, or friction across \
             the sliding. That is a dashpot mu p / V, which grows without bound as the sliding slows down"
        )
    });
    let lost = listed(lost, ["branch changes", "branches change"]).map(|(which, places)| {
        format!(
            "{which} too fast to be followed ({places}): branches beyond have new numbers. If one is unstable there, \
             its critical friction lies in between. Ask for friction coefficients closer together there, or for a \
             faster sliding. cea.count_modes says whether a mode is missing"
        )
    });
    let open = listed(open.collect(), ["mode has", "modes have"])
        .map(|(which, places)| format!("{which} not converged: left out is what lies at {places}"));
    let rigid = (sweep.rigid_motions > 0).then(|| {
        let which = plural(sweep.rigid_motions, ["rigid motion", "rigid motions"]);
        format!(
            "{which}, at frequency zero, not listed: nothing holds the body in those directions"
        )
    });
    let beyond = sweep.beyond().map(|(friction, mode)| {
        format!(
            "an unstable mode lies above those listed: {:.0} Hz at friction {friction}, growing at \
             {:.2} 1/s. Raise cea.modes or cea.max_frequency_hz to list it",
            mode.frequency_hz(),
            mode.growth_rate(),
        )
    });
    let statically = sweep.intervals.iter().find(|own| own.branch == 0).map(|own| {
        format!(
            "steady sliding is statically unstable from friction {:.6} on: a motion grows without oscillating, as in a \
             part that digs in or buckles. It is branch 0 at 0 Hz, and none of the modes listed",
            own.critical_friction
        )
    });
    let ended = damped.into_iter().chain(lost).chain(statically);
    ended.chain(open).chain(beyond).chain(rigid).collect()
}

/// Damping factor of a growing mode that the damping of any real part exceeds.
const WEAK: f64 = 1e-6;

/// Branches that count as unstable while they hardly grow, as where friction hardly feeds a mode that nothing damps.
pub(super) fn weak_note(sweep: &FrictionSweep) -> Option<String> {
    let growth = |own: &UnstableInterval| {
        let own = sweep.points.iter().flat_map(|point| &point.modes).filter(|mode| own.is_of(mode));
        own.map(|mode| -mode.damping_factor()).filter(|growth| *growth > 0.0).reduce(f64::max)
    };
    let weak = sweep.intervals.iter().filter(|own| growth(own).is_some_and(|most| most < WEAK));
    let places = weak.map(|own| {
        format!("{:.0} Hz from friction {:.4} on", own.frequency_hz, own.critical_friction)
    });
    let which = ["unstable branch hardly grows", "unstable branches hardly grow"];
    listed(places.collect(), which).map(|(which, places)| {
        format!(
            "{which} ({places}): by less than {WEAK:.0e} of critical damping at every friction \
             value. Any real part damps more: give the case its damping"
        )
    })
}

/// How many there are, and the first of them; nothing of none.
fn listed(all: Vec<String>, nouns: [&str; 2]) -> Option<(String, String)> {
    let (shown, rest) = all.split_at(all.len().min(MISSING_SHOWN));
    let more = if rest.is_empty() { "" } else { ", ..." };
    (!all.is_empty()).then(|| (plural(all.len(), nouns), shown.join(", ") + more))
}

/// The motions that friction across the sliding keeps from oscillating, and those that it damps.
pub(super) fn overdamped_note(
    case: &Case,
    model: &SlidingModel,
    overdamped: &[Overdamped],
) -> Option<String> {
    let most = overdamped.iter().max_by_key(|own| own.count);
    let (most, solid) = (most.filter(|own| own.count > 0)?, model.solid.as_ref()?);
    let [slowest, fastest] = most.decay;
    let grows = match slowest < 0.0 {
        true => " (a negative one grows: steady sliding is statically unstable)",
        false => "",
    };
    let friction = most.friction_coefficient;
    let (speed, law, pressure) = mean_friction(solid);
    Some(format!(
        "at friction {friction} {} motions (each wave of a pair counted) hardly oscillate. They decay at {slowest:.3e} \
         to {fastest:.3e} 1/s{grows}, and are not listed. Friction across the sliding overdamps them: it is a dashpot \
         of mu p / V = {:.3e} Pa s/m at the mean pressure and radius. It grows as contact.rotation_speed_rpm = {} \
         falls, and holds that motion in the limit",
        most.count,
        friction * law.drag.abs() * pressure / speed,
        case.number("contact.rotation_speed_rpm")
            .unwrap_or(case.contact.sliding.rotation_speed * 60.0 / TAU),
    ))
}

/// Whose friction is varied where contacts have different ones.
pub(super) fn ratio_note(case: &Case) -> Option<String> {
    let [first, others @ ..] = &case.body.assembly()?.contacts[..] else { return None };
    let others = others.iter().map(|own| (&own.name, rounded(own.friction.ratio, 6)));
    let others =
        others.filter(|own| own.1 != 1.0).map(|(name, by)| format!("contacts.{name} {by}"));
    let others = others.collect::<Vec<_>>().join(", ");
    let said =
        format!("friction coefficients are those of contacts.{}; times as much have", first.name);
    (!others.is_empty()).then(|| format!("{said}: {others}"))
}

/// What a friction law does at the speed of sliding.
pub(super) fn friction_note(case: &Case, model: &SlidingModel) -> Option<String> {
    case.contact.sliding.decay?;
    let friction = case.contact.sliding.friction_coefficient;
    let (law, pressure) = match (&model.solid, model.mesh.dimension) {
        (Some(solid), _) => {
            let (_, law, pressure) = mean_friction(solid);
            (law, pressure)
        }
        // Each contact of solid bodies has its own.
        (None, 3) => return None,
        (None, _) => {
            let area: f64 = model.contact.iter().map(|own| own.place.area).sum();
            let force: f64 = model.contact.iter().map(|own| own.pressure * own.place.area).sum();
            let edge = ContactInterface::of(&model.mesh);
            (edge.steady_friction(&case.contact.sliding), force / area)
        }
    };
    Some(format!(
        "friction falls with speed: friction coefficients are those of high speed. In steady sliding friction is {:.4} \
         times as large. At contact.friction_coefficient = {friction} its fall is a dashpot of {:.3e} Pa s/m on the \
         tangential motion of the edge (mean pressure {pressure:.3e} Pa)",
        law.drag.abs(),
        friction * pressure * law.slope,
    ))
}

/// Which harmonics were solved, and why no other can hold a mode of the range.
pub(super) fn coverage_note(coverage: &Coverage) -> String {
    let followed = number_ranges(&coverage.followed);
    let Coverage { largest_harmonic: largest, margin_hz, limit_hz, .. } = coverage;
    if !coverage.is_verified {
        return format!(
            "harmonics {followed} hold modes at rest (by inertia counts, up to {} of {largest}) and were followed \
            from {margin_hz:.0} Hz downwards",
            coverage.counted_empty.last().unwrap_or(largest),
        );
    }
    let empty = [
        (&coverage.proven_empty, "are proven to have none"),
        (&coverage.counted_empty, "have none by count at quarters of the friction range"),
    ];
    let empty = empty.iter().filter(|own| !own.0.is_empty());
    let empty: String = empty.map(|(own, why)| format!("; {} {why}", number_ranges(own))).collect();
    format!(
        "harmonics 0 to {largest}: {followed} have modes and were followed from {margin_hz:.0} Hz down{empty} \
         below {limit_hz:.0} Hz"
    )
}
