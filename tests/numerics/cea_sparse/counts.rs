//! Counts by the argument principle against dense spectra and against lists that are short on purpose.

use super::{Entries, dense_eigenvalues, disc, problem};
use crate::prelude::*;
use frictionsim::cea::sparse::ModeCounter;

/// A chain of unit masses with dashpots at some, and with friction strong enough for flutter.
fn chain(count: usize) -> [Vec<Entries>; 3] {
    let mut elastic: Entries = (0..count).map(|i| (i, i, 2.01)).collect();
    for i in 0..count - 1 {
        elastic.extend([(i, i + 1, -1.0), (i + 1, i, -1.0)]);
    }
    let friction = (0..count / 2).map(|i| (2 * i + 1, 2 * i, 0.4)).collect();
    let dashpots = (0..count).map(|i| (i, i, if i % 7 == 0 { 0.02 } else { 1e-3 }));
    let mass = (0..count).map(|i| (i, i, 1.0)).collect();
    [vec![mass], vec![dashpots.collect()], vec![elastic, friction]]
}

/// `count` of the chain beside itself: every eigenvalue twice.
fn twice(count: usize) -> [Vec<Entries>; 3] {
    let copies = |&(i, j, v): &(usize, usize, f64)| [(i, j, v), (i + count, j + count, v)];
    chain(count)
        .map(|powers| powers.iter().map(|own| own.iter().flat_map(copies).collect()).collect())
}

/// Middle of the widest gap of the spectrum between two places.
fn gap(spectrum: &[c64], places: std::ops::Range<usize>) -> f64 {
    let pairs = spectrum[places].windows(2);
    let pair = pairs.max_by(|a, b| (a[1].im - a[0].im).total_cmp(&(b[1].im - b[0].im))).unwrap();
    0.5 * (pair[0].im + pair[1].im)
}

/// What is counted beyond `known` of the modes below `top`.
fn missing(of: &SlidingTangent, mu: f64, known: &[c64], top: f64) -> (i64, Option<c64>, usize) {
    let inside: Vec<c64> = known.iter().copied().filter(|own| own.im < top).collect();
    let region = CountedRegion::about(&inside, top, 1.0);
    let found = ModeCounter::new(of).unwrap().count(mu, known, &region);
    (found.missing.unwrap(), found.near, found.determinants)
}

/// Exact: with friction, flutter and dashpots as many modes are counted as a dense decomposition has, whichever are known; double ones twice.
#[test]
fn counts_are_those_of_a_dense_spectrum() {
    for (size, parts) in [(40, chain(40)), (60, twice(30))] {
        let tangent = problem(size, parts, None);
        for mu in [0.0, 0.3, 3.5] {
            let spectrum = dense_eigenvalues(&tangent, mu);
            let top = gap(&spectrum, 15..25);
            let below: Vec<c64> = spectrum.iter().copied().filter(|own| own.im < top).collect();
            let flutters = below.iter().any(|own| own.re > 1e-3);
            assert!(flutters || mu < 1.0, "no flutter: {below:?}");
            let (none, near, determinants) = missing(&tangent, mu, &spectrum, top);
            assert_eq!((none, near), (0, None), "{size} {mu}");
            assert!(determinants < 200, "{size} {mu} {determinants}");
            // Any one of them, and three; of double eigenvalues one of the two.
            let growing = |&k: &usize| below[k].re > 1e-3;
            let first_growing = (0..below.len()).find(growing).unwrap_or(7);
            for dropped in [vec![0], vec![first_growing], vec![2, 5, below.len() - 1]] {
                let kept = spectrum.iter().enumerate().filter(|(k, _)| !dropped.contains(k));
                let known: Vec<c64> = kept.map(|(_, own)| *own).collect();
                let (found, near, _) = missing(&tangent, mu, &known, top);
                assert_eq!(found, dropped.len() as i64, "{size} {mu} {dropped:?}");
                let sum: c64 = dropped.iter().map(|&k| below[k]).sum();
                let mean = sum / dropped.len() as f64;
                assert!((near.unwrap() - mean).norm() < 5e-3 * top, "{near:?} {mean}");
            }
            // What is no eigenvalue counts against the list.
            let strange = [spectrum.as_slice(), &[c64::new(-0.01, 0.4 * top)]].concat();
            assert_eq!(missing(&tangent, mu, &strange, top).0, -1);
        }
    }
}

/// The determinant of the tangent of a disc with friction is that of dense elimination.
#[test]
fn determinant_of_a_disc_is_that_of_dense_elimination() {
    let tangent = disc(24, 4, BodyOnly);
    let counter = ModeCounter::new(&tangent).unwrap();
    let (mu, size) = (0.6, tangent.mass.dimension());
    let [mass, damping, stiffness] =
        [&tangent.mass, &tangent.damping, &tangent.stiffness].map(|p| dense(p, mu));
    let random = random_columns(4, 2, 3);
    for k in 0..4 {
        let lambda = c64::new(2e4 * random[(k, 0)], TAU * 1e4 * (1.0 + random[(k, 1)].abs()));
        let matrix = Mat::from_fn(size, size, |i, j| {
            lambda * (lambda * mass[(i, j)] + damping[(i, j)]) + stiffness[(i, j)]
        });
        let lu = matrix.partial_piv_lu();
        let exact: c64 = (0..size).map(|i| lu.U()[(i, i)]).map(|pivot| pivot.ln()).sum();
        let rows = lu.P().arrays().0.to_vec();
        let mut cycles = 0;
        let mut is_seen = vec![false; size];
        for start in 0..size {
            let mut at = start;
            cycles += usize::from(!is_seen[at]);
            while !is_seen[at] {
                is_seen[at] = true;
                at = rows[at];
            }
        }
        let found = counter.ln_determinant(mu, lambda).unwrap();
        let half_turns = (found.im - exact.im) / (0.5 * TAU) - (size - cycles) as f64;
        let whole = 0.5 * half_turns;
        assert!((found.re - exact.re).abs() < 1e-7, "{found} {exact}");
        assert!((whole - whole.round()).abs() < 1e-7, "{whole}");
    }
}

/// The sweep of a disc with flutter counts its own modes: both models of damping, the lowest modes and those below a limit.
#[test]
fn sweep_of_a_disc_is_complete_by_count() {
    for damping_model in [WholeTangent, BodyOnly] {
        let [circumferential, radial] = sized([32, 6], [48, 10]);
        let tangent = disc(circumferential, radial, damping_model);
        for limit in [Lowest(13), MaxFrequency(15_000.0)] {
            let request =
                SweepRequest { count_modes: true, ..sweep_request(&[0.0, 0.3, 0.7], limit) };
            let result = sweep(&tangent, &request, &|_| {}).unwrap();
            assert_eq!(result.counts.len(), 3);
            for (count, point) in result.counts.iter().zip(&result.points) {
                assert!(count.is_complete(), "{count:?}");
                assert_eq!(count.counted(), Some(point.modes.len() as i64));
            }
            assert!(result.points[2].modes.iter().any(|mode| mode.is_unstable()));
            // Without one of the unstable modes one is missing; those above the region are known as well.
            let more = SweepRequest { limit: Lowest(40), ..request };
            let all = sweep(&tangent, &more, &|_| {}).unwrap();
            let modes = all.points[2].modes.iter();
            let known: Vec<c64> = modes.map(|mode| mode.eigenvalue).collect();
            let unstable = known.iter().position(|own| own.re > 0.0).unwrap();
            let lost = known[unstable];
            let rest: Vec<c64> = known.iter().copied().filter(|own| *own != lost).collect();
            let counter = ModeCounter::new(&tangent).unwrap();
            let region = &result.counts[2].region;
            let found = counter.count(0.7, &rest, region);
            assert_eq!(found.missing, Ok(1));
            let near = found.near.unwrap();
            let top = TAU * region.frequencies_hz[1];
            assert!((near - lost).norm() < 5e-3 * top, "{near} {lost}");
        }
    }
}

/// Bit for bit the same on any number of threads.
#[test]
fn counts_do_not_depend_on_the_number_of_threads() {
    let tangent = problem(40, chain(40), None);
    let spectrum = dense_eigenvalues(&tangent, 3.5);
    let top = gap(&spectrum, 15..25);
    let work = || missing(&tangent, 3.5, &spectrum[1..], top);
    let on = |threads: usize| on_threads(threads, work);
    let one = on(1);
    assert_eq!(one.0, 1);
    assert!([2, 5].iter().all(|&threads| on(threads) == one));
}
