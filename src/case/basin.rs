//! `[basin]`: which of two motions wins.

use super::body::Body;
use super::reader::Section;
use super::refuse;
use crate::cycle::BasinRequest;

pub(super) fn basin(root: &Section<'_>, body: Option<&Body>) -> Option<BasinRequest> {
    let section = root.section("basin", false);
    if !section.is_given() {
        return None;
    }
    let pair = section.harmonics(body.and_then(Body::sector_count)).unwrap_or_default();
    let modes = section.counts("modes");
    let modes: Option<Vec<usize>> =
        modes.map(|values| values.into_iter().map(|(mode, _)| mode).collect());
    if let Some(modes) = &modes
        && !(1..=2).contains(&modes.len())
    {
        refuse!(section, "modes",
            "basin.modes must name two different modes, or one that competes with steady sliding";
            "one or two of them");
    }
    let request = BasinRequest {
        modes,
        harmonics: [pair.first(), pair.last()].map(|n| n.copied().unwrap_or(1)),
        seed_ratios: [section.number("seed_ratio_from"), section.number("seed_ratio_to")],
        tolerance: section.number("tolerance"),
        periods: section.count("periods"),
    };
    if pair.len() != 2 || pair[0] == pair[1] {
        refuse!(section, "harmonics", "basin.harmonics must name two different harmonics";
            "{} of them, two are compared", pair.len());
    }
    let [from, to] = request.seed_ratios;
    if from >= to {
        refuse!(section, "seed_ratio_from",
            "basin.seed_ratio_from = {from:?} is not below basin.seed_ratio_to = {to:?}";
            "below {to:?}");
    }
    section.close();
    Some(request)
}
