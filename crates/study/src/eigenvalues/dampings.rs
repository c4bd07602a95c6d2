//! The damping of each region, as figures show it.

use super::SlidingModel;
use frictionsim_case::Case;
use frictionsim_chart::literal;
use frictionsim_results::cea::NamedDamping;

/// The different Rayleigh dampings that regions of the body have, each with the mark-up that names it.
pub fn dampings(case: &Case, model: &SlidingModel) -> Vec<NamedDamping> {
    let (materials, regions) = (case.materials(), &model.mesh.regions);
    let count = regions.len().max(1);
    let mut found: Vec<(Vec<usize>, _)> = Vec::new();
    for region in 0..count {
        let damping = materials.own_damping(region).unwrap_or(case.damping.rayleigh);
        match found.iter_mut().find(|(_, known)| *known == damping) {
            Some((regions, _)) => regions.push(region),
            None => found.push((vec![region], damping)),
        }
    }
    let is_one = found.len() == 1;
    let named = found.into_iter().map(|(own, damping)| {
        let formula = "damping *ζ* = (*α*_{R}/*ω* + *β*_{R}*ω*)/2";
        let names = own.iter().filter_map(|&region| regions.get(region));
        let names: Vec<String> = names.map(|name| literal(name)).collect();
        let name = match is_one {
            true => formula.to_owned(),
            false => format!("{formula} of {}", names.join(", ")),
        };
        (name, damping)
    });
    named.collect()
}
