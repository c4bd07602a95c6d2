//! Quantities compared between the levels of a convergence study.

use crate::*;
use frictionsim_physics::mesh::coincident_nodes;
use frictionsim_results::cea::{Branch, branch_of, branch_of_mode, mode_name};
use frictionsim_results::{Extent, convergence::Quantity};

/// The name of a mode, which its branch is known by on every mesh.
fn name_of((harmonic, branch, direction): Branch, has_harmonics: bool) -> String {
    mode_name(has_harmonics.then_some(harmonic), branch, direction)
}

/// Frequency and real part of every mode at the case's friction coefficient, and every first onset,
/// that all levels have; notes name those that some level lacks.
pub fn of_sweeps(
    (case, levels): (&Case, &[Case]),
    sizes: &[f64],
    mut sweeps: Vec<FrictionSweep>,
) -> Result<(Vec<Quantity>, Vec<String>), StudyError> {
    let friction = case.contact.sliding.friction_coefficient;
    if !case.body.has_sectors() {
        name_by_rank(levels, &mut sweeps, friction)?;
    }
    let modes: Vec<&[ComplexMode]> = sweeps.iter().map(|sweep| sweep.modes_at(friction)).collect();
    let everywhere = everywhere(&modes, branch_of_mode);
    let mut quantities = Vec::new();
    let parts = [ComplexMode::frequency_hz, ComplexMode::real_hz];
    for (part, value) in ["frequency", "real part"].into_iter().zip(parts) {
        for levels in &everywhere {
            let name =
                format!("{part}, {}", name_of(branch_of_mode(levels[0]), case.body.has_sectors()));
            let values = levels.iter().map(|mode| value(mode)).collect();
            quantities.push(Quantity {
                is_minor: !levels.last().is_some_and(|finest| finest.is_unstable()),
                ..Quantity::new(name, "Hz", sizes, values)
            });
        }
    }
    quantities.extend(onsets(sizes, &sweeps, case.body.has_sectors()));
    let mut notes = vec![format!("{} modes at friction coefficient {friction}", everywhere.len())];
    let most = modes.iter().map(|level| level.len()).max().unwrap_or(0);
    if most > everywhere.len() {
        notes.push(format!(
            "left out: {} of {most} modes, which some mesh does not have in the range asked for",
            most - everywhere.len()
        ));
    }
    Ok((quantities, notes))
}

/// Least likeness (modal assurance criterion) of the shapes of one mode on two meshes.
const SAME_MODE: f64 = 0.5;

/// First number of the modes that the finest mesh does not have.
const FOREIGN: usize = 1 << 20;

/// Gives the branches of a body without symmetry the rank that their mode has by frequency on the finest mesh, from 1;
/// from mesh to mesh the likest shapes at `friction` belong together.
fn name_by_rank(
    levels: &[Case],
    sweeps: &mut [FrictionSweep],
    friction: f64,
) -> Result<(), StudyError> {
    type Shapes = Vec<(Arc<[c64]>, usize)>;
    let own = |sweep: &FrictionSweep| -> Shapes {
        let modes = sweep.modes_at(friction).iter();
        modes.map(|mode| (mode.shape.clone().unwrap_or_default(), mode.branch)).collect()
    };
    let mut finer: Option<(Shapes, Arc<Mesh>)> = None;
    for (case, sweep) in levels.iter().zip(sweeps).rev() {
        let (modes, mesh) = (own(sweep), case.body.mesh()?);
        let mut rank_of = BTreeMap::new();
        let mut pairs = Vec::new();
        match &finer {
            None => rank_of.extend(modes.iter().enumerate().map(|(i, mode)| (mode.1, i + 1))),
            Some((finer, fine)) => {
                let common = common_dofs(&mesh, fine, 1e-6 * case.body.size());
                for (x, branch) in &modes {
                    let likeness = finer.iter().map(|(y, rank)| (likeness(x, y, &common), *rank));
                    pairs.extend(likeness.map(|(own, rank)| (-own, *branch, rank)));
                }
            }
        }
        // Likest pairs first, each mode once.
        pairs.retain(|pair| pair.0 < -SAME_MODE);
        rank_of.extend(order::each_once(pairs));
        for mode in sweep.points.iter_mut().flat_map(|point| &mut point.modes) {
            let rank = rank_of.get(&mode.branch).copied();
            (mode.harmonic, mode.direction) = (0, 0);
            mode.branch = rank.unwrap_or(FOREIGN + mode.branch);
        }
        // An onset without a mode at `friction` has no shape that tells its branch on other meshes.
        sweep.intervals.retain(|own| rank_of.contains_key(&own.branch));
        for own in &mut sweep.intervals {
            (own.harmonic, own.branch, own.direction) = (0, rank_of[&own.branch], 0);
        }
        finer = Some((own(sweep), mesh));
    }
    Ok(())
}

/// Degrees of freedom of nodes in the same place on the coarser and on the finer of two meshes: of a mesh that was
/// split the first ones.
fn common_dofs(coarse: &Mesh, fine: &Mesh, distance: f64) -> Vec<[usize; 2]> {
    let (count, dimension) = (coarse.node_count(), coarse.dimension);
    let nodes: Vec<[usize; 2]> = if fine.nodes.starts_with(&coarse.nodes) {
        (0..count).map(|i| [i, i]).collect()
    } else {
        let all = [&coarse.nodes[..], &fine.nodes].concat();
        let pairs = coincident_nodes(&all, distance).into_iter();
        let pairs = pairs.map(|(i, j)| [i as usize, j as usize]);
        pairs.filter(|&[i, j]| i < count && j >= count).map(|[i, j]| [i, j - count]).collect()
    };
    let dofs = |node: [usize; 2]| (0..dimension).map(move |k| node.map(|own| dimension * own + k));
    nodes.into_iter().flat_map(dofs).collect()
}

/// `|x^H y|^2 / (|x|^2 |y|^2)` over the entries that both have.
fn likeness(x: &[c64], y: &[c64], common: &[[usize; 2]]) -> f64 {
    let pairs = || common.iter().filter_map(|&[i, j]| Some((x.get(i)?, y.get(j)?)));
    let product: c64 = pairs().map(|(a, b)| a.conj() * b).sum();
    let size = |v: f64, part: c64| v + part.norm_sqr();
    let sizes = pairs().fold((0.0, 0.0), |(p, q), (a, b)| (size(p, *a), size(q, *b)));
    product.norm_sqr() / (sizes.0 * sizes.1).max(f64::MIN_POSITIVE)
}

/// What each entry of the finest level is on all levels, by key; of several of one key the first.
fn everywhere<'a, T>(levels: &[&'a [T]], key: impl Fn(&T) -> Branch) -> Vec<Vec<&'a T>> {
    let finest = levels.last().copied().unwrap_or_default();
    let same = |own: &T| {
        let found = levels.iter().map(|level| level.iter().find(|other| key(other) == key(own)));
        found.collect::<Option<Vec<&T>>>()
    };
    finest.iter().filter_map(same).collect()
}

/// Critical friction of every branch that turns unstable within the range of every level.
fn onsets(sizes: &[f64], sweeps: &[FrictionSweep], has_harmonics: bool) -> Vec<Quantity> {
    let levels: Vec<&[UnstableInterval]> =
        sweeps.iter().map(|sweep| &sweep.intervals[..]).collect();
    let mut found = everywhere(&levels, branch_of);
    found.retain(|levels| levels.iter().all(|own| own.is_located()));
    let mut seen: BTreeSet<Branch> = BTreeSet::new();
    found.retain(|levels| seen.insert(branch_of(levels[0])));
    let quantity = |levels: &Vec<&UnstableInterval>| {
        let name = name_of(branch_of(levels[0]), has_harmonics);
        let values = levels.iter().map(|own| own.critical_friction);
        Quantity::new(format!("critical friction, {name}"), "", sizes, values.collect())
    };
    found.iter().map(quantity).collect()
}

/// A number of a summary; `NaN` where there is none.
fn number(summary: &Value, path: &str) -> f64 {
    summary.pointer(path).and_then(Value::as_f64).unwrap_or(f64::NAN)
}

/// The entries of a list of a summary.
fn listed<'a>(summary: &'a Value, name: &str) -> impl Iterator<Item = &'a Value> {
    summary[name].as_array().into_iter().flatten()
}

/// Frequency, harmonic, status, powers and growth rates of transients, from their summaries.
pub fn of_transients(sizes: &[f64], summaries: &[Value], extent: Extent) -> Vec<Quantity> {
    let harmonics = summaries.iter().map(|summary| number(summary, "/main_harmonic"));
    let harmonic = Quantity::count("main harmonic".to_owned(), harmonics.collect());
    let mut quantities = of_limit_cycles(sizes, summaries, extent);
    quantities.insert(1, harmonic);
    quantities.extend(growth_rates(sizes, summaries));
    quantities
}

/// Frequency, status and powers of limit cycles.
pub fn of_limit_cycles(sizes: &[f64], cycles: &[Value], extent: Extent) -> Vec<Quantity> {
    let each = |name: &str, unit: &str, path: &str| {
        let values = cycles.iter().map(|cycle| number(cycle, path));
        Quantity::new(name.to_owned(), unit, sizes, values.collect())
    };
    // A power as a share of the external one.
    let share = |name: &str, path: &str| {
        let external = |cycle: &Value| number(cycle, "/power_w/external");
        let values = cycles.iter().map(|cycle| number(cycle, path) / external(cycle));
        Quantity::new(format!("{name} / external power"), "", sizes, values.collect())
    };
    vec![
        each("main frequency", "Hz", "/main_frequency_hz"),
        each("stick fraction", "", "/status/stick"),
        each("slip fraction", "", "/status/slip"),
        each("open fraction", "", "/status/open"),
        each("external power", &extent.unit("W"), "/power_w/external"),
        share("stick", "/power_w/stick"),
        share("slide", "/power_w/slide"),
        share("contact dissipation", "/power_w/contact_dissipated"),
        share("material damping", "/power_w/material_damping"),
    ]
}

/// The limit cycles of each family that some search looked for, level by level; null where one did not.
pub fn by_family(summaries: &[Value]) -> Vec<(Family, Vec<Value>)> {
    let family = |cycle: &Value| {
        let part = |name: &str| Some(cycle[name].as_u64()? as usize);
        Some(Family { harmonic: part("harmonic")?, onset: part("onset")? })
    };
    let all = summaries.iter().flat_map(|summary| listed(summary, "cycles"));
    let families: BTreeSet<Family> = all.filter_map(family).collect();
    let of = |wanted: Family| {
        let own = |summary: &Value| {
            let mut cycles = listed(summary, "cycles");
            cycles.find(|cycle| family(cycle) == Some(wanted)).cloned().unwrap_or_default()
        };
        summaries.iter().map(own).collect()
    };
    families.into_iter().map(|f| (f, of(f))).collect()
}

/// Growth rate of each harmonic that some run has one of.
fn growth_rates(sizes: &[f64], summaries: &[Value]) -> Vec<Quantity> {
    let all = summaries.iter().flat_map(|summary| listed(summary, "growth"));
    let harmonics: BTreeSet<u64> = all.filter_map(|growth| growth["harmonic"].as_u64()).collect();
    let of = |harmonic: u64| {
        let rate = |summary: &Value| {
            let own = listed(summary, "growth").find(|growth| growth["harmonic"] == harmonic);
            own.map_or(f64::NAN, |growth| number(growth, "/rate_per_s"))
        };
        let name = format!("growth rate, n = {harmonic}");
        Quantity::new(name, "1/s", sizes, summaries.iter().map(rate).collect())
    };
    harmonics.into_iter().map(of).collect()
}
