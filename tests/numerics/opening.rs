//! Contact points that open one after the other between two friction values of a sweep, against analyses at single values (independent
//! checks): these know one contact state each, and follow no branch.

use crate::prelude::*;

/// A block on an elastic mounting, which the drag tilts: between friction 0.2 and 0.66 six of its nine contact nodes lift.
const CASE: &str = include_str!("../cases/mounted-block.toml");

fn block() -> TempDir {
    folder_with(&[("block.msh", &rectangle(0.04, 0.06, 8, 12))])
}

fn sweep_of(text: &str, folder: &TempDir, frictions: &[f64]) -> FrictionSweep {
    // The case's own friction value is solved, too.
    let own = frictions[frictions.len() - 1];
    let all = format!("cea.friction_coefficients={frictions:?}");
    let set = [all, format!("contact.friction_coefficient={own:?}")];
    modes_and_onsets(&case_of(folder.path().join("case.toml"), text, &set)).unwrap()
}

/// Intervals that do not begin beyond the wanted modes.
fn located(sweep: &FrictionSweep) -> Vec<&UnstableInterval> {
    sweep.intervals.iter().filter(|own| !own.unstable_from_start).collect()
}

/// The growth rate at a friction value of the mode nearest to a frequency, over that in rad/s.
fn growth(folder: &TempDir, friction: f64, frequency_hz: f64) -> f64 {
    let sweep = sweep_of(CASE, folder, &[friction]);
    let distance = |mode: &&ComplexMode| (mode.frequency_hz() / frequency_hz - 1.0).abs();
    let nearest = nearest_by(&sweep.points[0].modes, distance);
    nearest.growth_rate() / nearest.eigenvalue.norm()
}

/// Of the three branches that turn unstable two do so within a contact state, one of them stable again while another one holds, and one as
/// a node lifts.
#[test]
fn critical_friction_is_that_of_the_contact_state_there() {
    let folder = block();
    let coarse = sweep_of(CASE, &folder, &[0.1, 0.8]);
    let found = located(&coarse);
    assert_eq!([found.len(), coarse.intervals.len()], [4; 2], "{:?}", coarse.intervals);
    let ends = found.iter().filter_map(|own| own.restabilized.map(|(mu, hz)| (mu, hz, -1.0)));
    let onsets = found.iter().map(|own| (own.critical_friction, own.frequency_hz, 1.0));
    for (place, frequency_hz, sense) in onsets.chain(ends.clone()) {
        let sides = [-1e-6, 1e-6].map(|step| sense * growth(&folder, place + step, frequency_hz));
        assert!(sides[0] < 0.0 && sides[1] > 0.0, "{place} {frequency_hz} {sides:?}");
    }
    // A pair at 23.6 kHz grows from 0.211 to 0.287, where a node lifts, and from 0.364 on.
    assert_eq!(ends.count(), 1, "{found:?}");
    let longer = CASE.replace("modes = 10", "modes = 12");
    let beyond = sweep_of(&longer, &folder, &[0.7]);
    let mut growing = beyond.points[0].modes.iter().filter(|mode| mode.is_unstable());
    assert!(growing.any(|mode| (mode.frequency_hz() - 23_547.0).abs() < 10.0), "{beyond:?}");
}

#[test]
fn critical_friction_does_not_depend_on_the_friction_values_asked_for() {
    let folder = block();
    let coarse = sweep_of(CASE, &folder, &[0.1, 0.8]);
    // A branch that grows from 0.211 to 0.287 alone would be missed between values where it decays.
    let all = [&[0.1, 0.25, 0.8][..], &[0.1, 0.25, 0.35, 0.6, 0.7, 0.8]];
    for frictions in sized(&all[..1], &all) {
        let other = sweep_of(CASE, &folder, frictions);
        let [a, b] = [&coarse, &other].map(located);
        // To 1e-9 a change of the contact state is located; the base state is known to 1e-8.
        within(&criticals(a.clone()), &criticals(b.clone()), 1e-8);
        let [a, b] = [a, b].map(|all| all.iter().map(|own| own.frequency_hz).collect::<Vec<_>>());
        near_each(&a, &b, 1e-8);
    }
}

/// Between 0.1 and 0.8 states are found round after round; where each of them ends tells it from the others.
#[test]
fn a_contact_state_between_two_friction_values_is_swept_once() {
    let folder = block();
    let set = ["contact.friction_coefficient=0.8"];
    let case = case_of(folder.path().join("case.toml"), CASE, &set);
    let cea = case.require_cea().unwrap();
    let model = SlidingModel::new(&case, cea).unwrap();
    let kept = Kept::default();
    solve(&case, cea, &model, Some(&kept)).unwrap();
    // Names as `round-2-state-1-modes-0003-of-12-0.37`.
    let mut ends: BTreeMap<String, f64> = BTreeMap::new();
    for (name, _) in kept.steps.lock().unwrap().iter() {
        let Some((sweep, value)) = name.split_once("-modes-") else { continue };
        let friction: f64 = value.split('-').nth(3).unwrap().parse().unwrap();
        let end = ends.entry(sweep.to_owned()).or_default();
        *end = end.max(friction);
    }
    assert!(ends.keys().any(|sweep| sweep.starts_with("round-2")), "{ends:?}");
    let (asked, mut between): (Vec<f64>, Vec<f64>) = ends.values().partition(|end| **end == 0.8);
    // That of 0.8 once more, as another one is found to end where it begins.
    assert!(asked.len() <= 2, "{ends:?}");
    between.sort_by(f64::total_cmp);
    assert!(between.windows(2).all(|pair| pair[1] - pair[0] > 1e-6), "{ends:?}");
}

/// A strip on soft springs. Where its first node opens, near friction 0.514, the tenth and eleventh mode couple at 4.94 kHz; the list
/// ends between them, before with the one that decays, beyond with the one that grows.
const STRIP: &str = include_str!("../cases/strip-on-soft-springs.toml");

/// A branch that leaves the list where the state changes is no other one: with one mode more nothing jumps there.
#[test]
fn a_branch_that_leaves_the_list_as_contact_opens_keeps_its_name() {
    let mesh = rectangle(0.0432, 0.00905, 9, 2);
    let folder = folder_with(&[("strip.msh", &mesh)]);
    let frictions = [0.0, 0.002, 0.13, 0.519, 0.665];
    let listed = sweep_of(STRIP, &folder, &frictions);
    let longer = STRIP.replace("modes = 11", "modes = 12");
    let all = sweep_of(&longer, &folder, &frictions);
    let [found, expected] = [listed, all].map(|sweep| criticals(&sweep.intervals));
    assert_eq!(found.len(), 2, "{found:?}");
    within(&found, &expected, 1e-8);
    assert!((found[1] - 0.2268).abs() < 1e-4, "{found:?}");
}

/// A rubber strut that leans against the sliding: its foot is pressed the more, the larger friction is, until it buckles or digs in.
const STRUT: &str = include_str!("../cases/leaning-strut.toml");

/// It, or one that leans less.
fn strut(lean: f64) -> TempDir {
    let (xs, ys) = (even(0.01, 2), even(0.06, 10));
    let mesh = quadrilaterals(&xs, &ys, ["foot", "head", "strut"], |x, y| [x + lean * y, y]);
    folder_with(&[("strut.msh", &mesh)])
}

/// Positive real eigenvalues of the matrices at one friction coefficient, 1/s, by a dense decomposition (independent check).
fn static_growth(text: &str, folder: &TempDir, friction: f64) -> Vec<f64> {
    let set = [format!("contact.friction_coefficient={friction:?}")];
    let case = case_of(folder.path().join("case.toml"), text, &set);
    let values = lossy_eigenvalues(sums(&matrices(&case, Some(friction)).unwrap()).each_ref());
    let real = values.iter().filter(|own| own.re > 0.0 && own.im.abs() < 1e-6 * own.re);
    real.map(|own| own.re).collect()
}

/// There a mode has come to frequency zero; beyond 0.376 so has a second, and the determinant of the stiffness has its sign again.
#[test]
fn static_stability_is_lost_where_a_real_eigenvalue_passes_zero() {
    let folder = strut(0.3);
    let mut places = Vec::new();
    for last in [0.34, 0.38] {
        let found = sweep_of(STRUT, &folder, &[0.0, 0.2, last]);
        let statically = found.intervals.iter().find(|own| own.branch == 0).unwrap();
        assert_eq!((statically.frequency_hz, statically.restabilized), (0.0, None));
        places.push(statically.critical_friction);
        // What does not oscillate takes no places of modes.
        let lists = found.points.iter().map(|point| point.modes.len());
        assert!(lists.clone().all(|count| count == 8), "{:?}", lists.collect::<Vec<_>>());
    }
    assert!((places[0] - places[1]).abs() < 1e-8, "{places:?}");
    let around = [-1e-6, 1e-6].map(|step| static_growth(STRUT, &folder, places[0] + step).len());
    assert_eq!(around, [0, 1]);
    assert_eq!(static_growth(STRUT, &folder, 0.38).len(), 2);
    // Below, there is nothing to tell.
    let below = sweep_of(STRUT, &folder, &[0.0, 0.2, 0.3]);
    assert!(below.intervals.is_empty(), "{:?}", below.intervals);
}

/// A straight strut that is pressed beyond its buckling load: no branch leads to what grows there.
#[test]
fn what_is_statically_unstable_without_friction_is_told_from_the_first_value_on() {
    let folder = strut(0.0);
    let struts = [("5e-4", 0, [0.0, 0.05]), ("2e-3", 1, [0.0, 0.05]), ("2e-3", 1, [0.03, 0.05])];
    for (interference, growing, frictions) in struts {
        let text = STRUT.replace("1e-3", interference);
        let found = sweep_of(&text, &folder, &frictions);
        let statically = found.intervals.iter().filter(|own| own.branch == 0);
        let from: Vec<f64> = statically.map(|own| own.critical_friction).collect();
        assert_eq!(static_growth(&text, &folder, frictions[0]).len(), growing);
        assert_eq!(from, vec![frictions[0]; growing], "{interference}");
    }
}
