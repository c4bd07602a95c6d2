//! What each analysis is held to.

use super::{Answer, Bench, Cell, Verdict};
use crate::prelude::*;

/// A cell of the table: the body's bench, and that of the same body described otherwise.
type Check = fn(&Bench, Option<&Bench>) -> Verdict;

pub const ALL: &[(&str, Check)] = &[
    ("`check`", |bench, _| done(bench.run("check", &[])).map(drop)),
    ("`mesh`", mesh),
    ("`cea`", cea),
    ("`cea`, cyclic", |bench, _| by_method(bench, "cyclic")),
    ("`cea`, sparse", |bench, _| by_method(bench, "sparse")),
    ("sensitivities", sensitivities),
    ("`transient`, cyclic", |bench, _| transient(bench, "cyclic")),
    ("`transient`, sparse", |bench, _| transient(bench, "sparse")),
    ("`frf`, free", |bench, _| reciprocal(bench, "free")),
    ("`frf`, clamped", |bench, _| reciprocal(bench, "clamped")),
    ("`frf`, sliding", frf_sliding),
    ("`cycle`", cycle),
    ("`basin`", basin),
    ("`sweep`", sweep),
    ("`fit`", fit),
    ("`uncertainty`", uncertainty),
    ("`convergence`", convergence),
    ("`plot`", plot),
    ("`compare`", compare),
];

/// Goes on with a run that is done; a refusal is the cell.
fn done(answer: Answer) -> Result<(Value, PathBuf), Cell> {
    answer.map_err(Cell::Refused)
}

/// The same for a run that another one of this body needs, which must not be refused.
fn needed(answer: Answer) -> Result<(Value, PathBuf), Cell> {
    answer.map_err(|reason| Cell::Wrong(format!("its reference is refused: {reason}")))
}

/// Right where `holds`, else wrong with what was found.
fn verdict(holds: bool, found: impl FnOnce() -> String) -> Verdict {
    if holds { Ok(()) } else { Err(Cell::Wrong(found())) }
}

fn is_close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs())
}

/// Frequency and growth rate of the modes at friction 0.3, by frequency.
fn spectrum(folder: &Path) -> Vec<[f64; 2]> {
    let rows = rows(&folder.join("eigenvalues.csv"));
    let rows = rows.iter().filter(|row| row.number("friction_coefficient") == 0.3);
    rows.map(|row| row.numbers(["frequency_hz", "growth_rate_per_s"])).collect()
}

/// Whether every mode of `a` below the last of both has its like in `b`: to `tolerance` of the circular frequency.
fn agree(a: &[[f64; 2]], b: &[[f64; 2]], tolerance: f64) -> Verdict {
    let highest = |modes: &[[f64; 2]]| modes.last().map_or(0.0, |mode| mode[0]);
    let limit = highest(a).min(highest(b)) * (1.0 - 1e-6);
    let below = |modes: &[[f64; 2]]| modes.iter().filter(|mode| mode[0] < limit).count();
    verdict(below(a) > 0 && below(a) == below(b), || {
        format!("{} modes beside {}: {a:?}, {b:?}", below(a), below(b))
    })?;
    let distance =
        |p: &[f64; 2], q: &[f64; 2]| (TAU * (p[0] - q[0])).hypot(p[1] - q[1]) / (TAU * p[0]);
    let nearest = |mode| b.iter().map(|other| distance(mode, other)).fold(f64::INFINITY, f64::min);
    let worst = a.iter().filter(|mode| mode[0] < limit).map(nearest).fold(0.0, f64::max);
    verdict(worst <= tolerance, || format!("spectra differ by {worst:e}"))
}

/// The spectrum at friction 0.3 alone, which does not depend on the other values; the second of few modes.
const ALONE: &str = "cea.friction_coefficients=[0.3]";
const FEW: [&str; 2] = [ALONE, "cea.modes=2"];

fn lowest_onset(summary: &Value) -> Option<f64> {
    let onsets = summary["critical_frictions"].as_array()?.iter();
    onsets.filter_map(|onset| onset["critical_friction"].as_f64()).min_by(f64::total_cmp)
}

fn mesh(bench: &Bench, twin: Option<&Bench>) -> Verdict {
    let (own, _) = done(bench.run("mesh", &[]))?;
    let area = own["mesh"]["area_m2"].as_f64().or(own["mesh"]["volume_m3"].as_f64());
    let Some(twin) = twin else {
        return verdict(area.is_some_and(|area| area > 0.0), || format!("{}", own["mesh"]));
    };
    let (other, _) = needed(twin.run("mesh", &[]))?;
    let (area, other) = (area.unwrap(), other["mesh"]["area_m2"].as_f64().unwrap());
    verdict(is_close(area, other, 1e-12), || format!("area {area} and {other}"))
}

/// Against the other description of the body, else against a full solution's residual.
fn cea(bench: &Bench, twin: Option<&Bench>) -> Verdict {
    let (summary, own) = done(bench.run("cea", &[]))?;
    let residual = summary["largest_residual"].as_f64().unwrap();
    verdict(residual <= 1e-8, || format!("residual {residual:e}"))?;
    let Some(twin) = twin else { return Ok(()) };
    let (_, other) = needed(twin.run("cea", &[]))?;
    agree(&spectrum(&own), &spectrum(&other), 1e-8)
}

fn by_method(bench: &Bench, method: &str) -> Verdict {
    let (_, own) = done(bench.run("cea", &[&format!("cea.method=\"{method}\""), ALONE]))?;
    let (_, other) = needed(bench.run("cea", &[]))?;
    agree(&spectrum(&own), &spectrum(&other), 1e-8)
}

/// Relative change of a parameter for a difference: small, since eigenvalues bend where two of them are about to meet.
const SMALL_CHANGE: f64 = 1e-6;

/// The derivative by Young's modulus is the difference of two analyses.
fn sensitivities(bench: &Bench, _: Option<&Bench>) -> Verdict {
    let (_, folder) = done(bench.run("cea", &["cea.sensitivities=true", ALONE]))?;
    if !folder.join("sensitivities.csv").exists() {
        return Err(Cell::Refused("not computed for this body yet".to_owned()));
    }
    let table = rows(&folder.join("sensitivities.csv"));
    let of = |name: &str| column(&table, name);
    let (frequencies, growths) = (of("frequency_hz"), of("growth_rate_per_s"));
    // Where several materials have the key, its whole name heads the column.
    let slopes_by = |key: &str| {
        let of_key = |kind: &str| {
            let both = [format!("{kind}_per_{key}"), format!("{kind}_per_material.{key}")];
            both.into_iter().find(|name| table[0].0.contains_key(name)).map(|name| of(&name))
        };
        Some([of_key("frequency_hz")?, of_key("growth_rate")?])
    };
    // An orthotropic material has no Young's modulus.
    let isotropic = slopes_by("young_modulus").filter(|slopes| slopes[0][0].is_finite());
    let (name, value, slopes) = match isotropic {
        Some(slopes) => ("young_modulus", 2.5e9, slopes),
        None => ("density", 1700.0, slopes_by("density").expect("a density")),
    };
    let step = SMALL_CHANGE * value;
    let at = |value: f64| bench.run("cea", &[&format!("material.{name}={value:?}"), ALONE]);
    let ((_, low), (_, high)) = (needed(at(value - step))?, needed(at(value + step))?);
    let (low, high) = (spectrum(&low), spectrum(&high));
    // Both waves of a pair have nearly one frequency: the growth rate tells them apart.
    let distance = |mode: &[f64; 2], [frequency, growth]: [f64; 2]| {
        (TAU * (mode[0] - frequency)).hypot(mode[1] - growth)
    };
    let nearest = |modes: &[[f64; 2]], place| nearest_by(modes, |mode| distance(mode, place))[0];
    // Waves that friction hardly tells apart cannot be recognised by their eigenvalues.
    let own = spectrum(&folder);
    let is_alone = |i: &usize| {
        own.iter().filter(|mode| distance(mode, [frequencies[*i], growths[*i]]) < 1.0).count() == 1
    };
    let alone: Vec<usize> = (0..frequencies.len()).filter(is_alone).take(4).collect();
    verdict(!alone.is_empty(), || "no mode stands alone".to_owned())?;
    for i in alone {
        let at = |share: f64| {
            [frequencies[i] + share * step * slopes[0][i], growths[i] + share * step * slopes[1][i]]
        };
        let change = 2.0 * step * slopes[0][i];
        let difference = nearest(&high, at(1.0)) - nearest(&low, at(-1.0));
        verdict((difference - change).abs() <= 1e-3 * frequencies[i] * SMALL_CHANGE, || {
            format!("{} Hz: {change} expected, {difference} found", frequencies[i])
        })?;
    }
    Ok(())
}

/// Energy closes, and both operators tell the same.
fn transient(bench: &Bench, operator: &str) -> Verdict {
    let operator = format!("transient.operator=\"{operator}\"");
    let (own, folder) = done(bench.run("transient", &[&operator]))?;
    let residual = own["max_balance_residual"].as_f64().unwrap();
    verdict(residual <= 1e-10, || format!("energy balance {residual:e}"))?;
    let (_, other) = needed(bench.run("transient", &[]))?;
    let strain = |out: &Path| *column(&rows(&out.join("energy.csv")), "strain_j").last().unwrap();
    let (own, other) = (strain(&folder), strain(&other));
    verdict(is_close(own, other, 1e-8), || format!("strain energy {own} and {other}"))
}

/// The response from one place to another, at three frequencies.
fn response(bench: &Bench, boundary: &str, terminals: [[f64; 2]; 2], method: &str) -> Answer {
    let place = |[x, y]: [f64; 2]| format!("{{x={x:?},y={y:?}}}");
    let frf = format!(
        "frf={{boundary=\"{boundary}\",force_node={},response_node={},force_direction=\"radial\",\
         response_direction=\"radial\",frequencies_hz=[2000.0,7000.0,9500.0],method=\"{method}\"}}",
        place(terminals[0]),
        place(terminals[1]),
    );
    bench.run("frf", &[&frf])
}

/// Two places within every body.
const PLACES: [[f64; 2]; 2] = [[0.038, 0.002], [0.005, 0.0325]];

/// Whether the magnitudes of two responses are the same.
fn respond_alike(own: &Path, other: &Path, tolerance: f64) -> Verdict {
    let (own, other) = (magnitudes(own), magnitudes(other));
    let same = own.iter().zip(&other).all(|(a, b)| is_close(*a, *b, tolerance));
    verdict(same, || format!("{own:?} and {other:?}"))
}

fn magnitudes(folder: &Path) -> Vec<f64> {
    let parts = ["accelerance_real", "accelerance_imaginary"];
    columns(&rows(&folder.join("frf.csv")), parts).iter().map(|[re, im]| re.hypot(*im)).collect()
}

/// Force and response change places without a change (Maxwell and Betti).
fn reciprocal(bench: &Bench, boundary: &str) -> Verdict {
    let (_, there) = done(response(bench, boundary, PLACES, "auto"))?;
    let (_, back) = needed(response(bench, boundary, [PLACES[1], PLACES[0]], "auto"))?;
    respond_alike(&there, &back, 1e-7)
}

/// In sliding contact friction breaks the symmetry: the twin or the direct solution is the other route.
fn frf_sliding(bench: &Bench, twin: Option<&Bench>) -> Verdict {
    let (_, own) = done(response(bench, "sliding", PLACES, "auto"))?;
    let (_, other) = match twin {
        Some(twin) => needed(response(twin, "sliding", PLACES, "auto"))?,
        // Bodies of revolution have no direct solution of the whole body.
        None => match response(bench, "sliding", PLACES, "direct") {
            Err(_) => needed(response(bench, "sliding", PLACES, "cyclic"))?,
            found => needed(found)?,
        },
    };
    respond_alike(&own, &other, 1e-6)
}

/// Energy closes over the period; a transient stays on what is stable; where nothing grows `cea` knows no mode that does.
fn cycle(bench: &Bench, _: Option<&Bench>) -> Verdict {
    // The wave of the lowest onset may be none on a mesh as coarse as this one: others are.
    let lowest = "cycle={harmonics=[2],onsets=\"lowest\"}";
    let answer = match bench.run("cycle", &[lowest]) {
        Err(reason) if reason.starts_with("no limit cycle found") => {
            bench.run("cycle", &["cycle={harmonics=[1]}"])
        }
        answer => answer,
    };
    let (summary, _) = done(answer)?;
    let (text, own) = (summary.to_string(), &summary["cycles"][0]);
    if own["mode"].is_null() && !own.is_null() {
        return verdict(text.contains("balance_residual"), || text.clone());
    }
    if summary["steady_sliding_stable"] == true {
        let lumped = [ALONE, "cea.mass=\"lumped\"", "cea.geometric_stiffness=false"];
        let (_, folder) = needed(bench.run("cea", &lumped))?;
        let growth = column(&rows(&folder.join("eigenvalues.csv")), "growth_rate_per_s");
        return verdict(growth.iter().all(|rate| *rate <= 0.0), || text.clone());
    }
    let closes = own["balance_residual"].as_f64().is_some_and(|left| left < 1e-5);
    let stays = own["confirmation"]["agrees"] == true || own["stability"]["is_stable"] != true;
    verdict(closes && stays, || text.clone())
}

/// The bounds of the boundary hold it between them.
fn basin(bench: &Bench, _: Option<&Bench>) -> Verdict {
    let request = "seed_ratio_from=0.5,seed_ratio_to=2.0,tolerance=3.0,periods=50}";
    let answer = match bench.run("basin", &[&format!("basin={{harmonics=[1,2],{request}")]) {
        // Of a body without rotating waves two modes compete, or one with steady sliding.
        Err(reason) if reason.starts_with("basin.harmonics is not used") => {
            bench.run("basin", &[&format!("basin={{{request}")])
        }
        answer => answer,
    };
    let (summary, _) = done(answer)?;
    verdict(is_boundary(&summary), || summary.to_string())
}

/// Whether both ends of the range were tried, the larger seed of the second rival leaves it with the larger share at saturation, and
/// winner and bounds are those of the runs.
fn is_boundary(summary: &Value) -> bool {
    let runs = summary["runs"].as_array().cloned().unwrap_or_default();
    let rivals = &summary["harmonics"];
    let [Some(first), Some(last)] = [runs.first(), runs.get(1)] else { return false };
    let is_whole = [first, last].map(|run| &run["seed_ratio"]) == [&json!(0.5), &json!(2.0)];
    let is_known = |run: &Value| [&rivals[0], &rivals[1]].contains(&&run["winner"]);
    let ratios = [first, last].map(|run| run["saturation_ratio"].as_f64());
    let is_seeded = ratios[0].zip(ratios[1]).is_none_or(|(low, high)| high > low);
    // The last run that either rival has won, from its end of the range.
    let won = |rival: &Value| {
        let seed = |run: &Value| run["seed_ratio"].as_f64().unwrap();
        let mut own: Vec<&Value> = runs.iter().filter(|run| run["winner"] == *rival).collect();
        own.sort_by(|a, b| seed(a).total_cmp(&seed(b)));
        own
    };
    let (firsts, seconds) = (won(&rivals[0]), won(&rivals[1]));
    let bound = |of: Option<&&Value>| of.map_or(Value::Null, |of| of["saturation_ratio"].clone());
    let bounds = &summary["boundary"];
    let alone = match (firsts.is_empty(), seconds.is_empty()) {
        (true, _) => rivals[1].clone(),
        (_, true) => rivals[0].clone(),
        _ => Value::Null,
    };
    is_whole
        && is_seeded
        && runs.iter().all(is_known)
        && summary["transients"] == json!(runs.len())
        && summary["winner"] == alone
        && bounds["low"] == bound(firsts.last())
        && bounds["high"] == bound(seconds.first())
}

/// A point of the sweep is the analysis alone.
fn sweep(bench: &Bench, _: Option<&Bench>) -> Verdict {
    let sweep = "sweep={\"damping.stiffness_coefficient\"=[3e-7,4.5e-7],analyses=[\"cea\"]}";
    let (_, folder) = done(bench.run("sweep", &[&[sweep], &FEW[..]].concat()))?;
    let (alone, _) = needed(bench.run("cea", &FEW))?;
    let keys = ["modes", "largest_residual"];
    let points = columns(&rows(&folder.join("points.csv")), keys);
    let own = keys.map(|key| alone[key].as_f64().unwrap());
    verdict(points[1] == own, || format!("{points:?} {own:?}"))
}

/// Fitted to its own frequencies, in the digits that a measurement has, the body gives its modulus back.
fn fit(bench: &Bench, _: Option<&Bench>) -> Verdict {
    let (_, folder) = needed(bench.run("cea", &[]))?;
    let modes = spectrum(&folder);
    let lines: Vec<String> = modes.iter().take(3).map(|mode| format!("{:.3}\n", mode[0])).collect();
    let lines = bench.write("lines.csv", &format!("frequency_hz\n{}", lines.concat()));
    let overrides = [
        "fit={starts=1,parameters={\"material.young_modulus\"=[2.48e9,2.52e9]}}",
        "material.young_modulus=2.499e9",
    ];
    let (summary, _) = done(bench.run_with("fit", &overrides, &[&lines]))?;
    let value = summary["parameters"]["material.young_modulus"]["value"].as_f64().unwrap();
    verdict(is_close(value, 2.5e9, 1e-4), || format!("modulus {value}"))
}

/// Where next to nothing is uncertain the lowest critical friction is that of the analysis.
fn uncertainty(bench: &Bench, _: Option<&Bench>) -> Verdict {
    let overrides = [
        "uncertainty={samples=2,index_samples=0,seed=1}",
        "uncertainty.distributions={\"damping.stiffness_coefficient\"={uniform=[4.4999999e-7,4.5000001e-7]}}",
    ];
    let (summary, _) = done(bench.run("uncertainty", &overrides))?;
    let (alone, _) = needed(bench.run("cea", &[]))?;
    let (own, single) = (summary["critical_friction"]["median"].as_f64(), lowest_onset(&alone));
    let none = summary["critical_friction"]["without_onset"].as_f64();
    match single {
        Some(single) => verdict(own.is_some_and(|own| is_close(own, single, 1e-5)), || {
            format!("{own:?} in the samples, {single} alone")
        }),
        None => verdict(none == Some(1.0), || format!("{own:?} in the samples, none alone")),
    }
}

/// The frequencies of the coarsest mesh are those of the analysis.
fn convergence(bench: &Bench, _: Option<&Bench>) -> Verdict {
    let factors = "convergence={factors=[1,2,4],analyses=[\"cea\"]}";
    let (_, folder) = done(bench.run("convergence", &[&[factors], &FEW[..]].concat()))?;
    let (_, alone) = needed(bench.run("cea", &FEW))?;
    let values = column(&rows(&folder.join("convergence.csv")), "value");
    let lowest = spectrum(&alone)[0][0];
    let found = values.iter().any(|value| is_close(*value, lowest, 1e-9));
    verdict(found, || format!("{lowest} is not among {values:?}"))
}

fn plot(bench: &Bench, _: Option<&Bench>) -> Verdict {
    let few = ["cea.friction_coefficients=[0.0,0.3]", "cea.modes=2"];
    let case = bench.folder.path().join("case.toml");
    let (_, folder) = needed(bench.run_on("cea", &[&case], &few, "--format=svg"))?;
    bench.redraw(&folder).map_err(Cell::Refused)?;
    let is_drawn = folder.join("locus.svg").exists() || folder.join("figures").exists();
    verdict(is_drawn, || "no figure is drawn".to_owned())
}

fn compare(bench: &Bench, _: Option<&Bench>) -> Verdict {
    let (_, a) = needed(bench.run("cea", &FEW))?;
    let (_, b) = needed(bench.run_with("cea", &FEW, &[]))?;
    let (summary, _) = done(bench.run_on("compare", &[&a, &b], &[], "--no-figures"))?;
    let mut quantities = summary["quantities"].as_array().unwrap().iter();
    let same = quantities.all(|q| q["path"] == "wall_s" || q["values"][0] == q["values"][1]);
    verdict(same, || format!("{summary}"))
}
