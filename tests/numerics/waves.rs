//! Bodies that are solved harmonic by harmonic, and the derivatives of their branches.

use crate::common::waves::Sectors;
use crate::prelude::*;
use frictionsim::cea::cyclic::{Beside, WavePair, wave_pairs, wave_responses};

/// Step of a parameter relative to its value.
pub const STEP: f64 = 1e-3;

/// The eigenpairs of the branches that oscillate at a friction coefficient.
pub fn pairs(tangent: &WaveTangent, branches: &[ModeBranch], friction: f64) -> Vec<WavePair> {
    let there = branches.iter().filter(|branch| branch.interpolate(friction).is_some());
    let wanted: Vec<_> = there.map(|branch| (branch, friction)).collect();
    wave_pairs(tangent, &wanted).into_iter().map(Option::unwrap).collect()
}

/// Their derivatives by a parameter, of which `at` has the model where it is so much more.
pub fn rates(pairs: &[WavePair], step: f64, at: &dyn Fn(f64) -> WaveTangent) -> Vec<c64> {
    let sides = [(1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0)].map(|(steps, weight)| {
        Beside { weight: weight / (12.0 * step), tangent: at(steps * step), friction_shift: 0.0 }
    });
    wave_responses(&pairs.iter().collect::<Vec<_>>(), &sides).unwrap()
}

/// Whether a branch is that of a pair.
pub fn is_of(pair: &WavePair) -> impl Fn(&&ModeBranch) -> bool {
    let name = (pair.harmonic, pair.branch, pair.direction);
    move |branch| (branch.harmonic, branch.branch, branch.direction) == name
}

/// How derivatives are held to differences of whole analyses.
pub struct Differences {
    /// Below these the branches are compared, and looked for beside the value of a parameter, Hz.
    pub limits_hz: [f64; 2],
    /// Whether eigenvalues are those of whole harmonics: what a small space leaves out, up to 1e-5, changes with parameters.
    pub is_whole: bool,
    /// Steps over those of the table.
    pub factor: f64,
    /// Largest error relative to the change over the parameter's own size, or to a thousandth of `|lambda|` where that is less.
    pub tolerance: f64,
    /// Step of differences by friction, and the largest error of these relative to `|lambda|`.
    pub by_friction: [f64; 2],
}

/// Branch by harmonic, rank and direction.
type Name = (usize, usize, i8);

/// A parameter's name, its own size, the step of a difference, and the change of a model by so much.
type Parameter<S> = (&'static str, Option<f64>, f64, fn(&mut WaveModel<S>, f64));

/// Adds to both numbers of the law of a contact that stiffens.
fn add_to_law<S>(model: &mut WaveModel<S>, more: [f64; 2]) {
    if let Some(
        NormalLaw::Cubic { stiffness: first, cubic_stiffness: second }
        | NormalLaw::Exponential { reference_pressure: first, height: second },
    ) = &mut model.options.contact.law
    {
        *first += more[0];
        *second += more[1];
    }
}

/// The parameters that a model may have; of Poisson's ratio the size is about what is left to 1/2.
fn parameters<S: Sectors>(model: &WaveModel<S>) -> [Parameter<S>; 11] {
    let WaveModel { material, options, contact, .. } = model;
    let (cubic, exponential) = match options.contact.law {
        Some(NormalLaw::Cubic { cubic_stiffness, .. }) => (Some(cubic_stiffness), None),
        Some(NormalLaw::Exponential { reference_pressure, height }) => {
            (None, Some([reference_pressure, height]))
        }
        None => (None, None),
    };
    let k_n = options.contact.normal_stiffness.filter(|_| exponential.is_none());
    let [p_r, height] = [0, 1].map(|k| exponential.map(|own| own[k]));
    let [alpha, beta] = [options.damping.mass_coefficient, options.damping.stiffness_coefficient];
    let share = |value: Option<f64>, share: f64| share * value.unwrap_or(0.0);
    [
        ("nu", Some(1.0), 2.5e-4, |m, h| m.material.poisson_ratio += h),
        ("E", Some(material.young_modulus), 1e7, |m, h| m.material.young_modulus += h),
        ("rho", Some(material.density), 5.0, |m, h| m.material.density += h),
        ("alpha", Some(alpha), 1.0, |m, h| m.options.damping.mass_coefficient += h),
        ("beta", Some(beta), 1e-8, |m, h| m.options.damping.stiffness_coefficient += h),
        ("k_n", k_n, share(k_n, 0.004), |m, h| {
            if let Some(k) = &mut m.options.contact.normal_stiffness {
                *k += h;
            }
            add_to_law(m, [h, 0.0]);
        }),
        ("c", cubic, share(cubic, 0.004), |m, h| add_to_law(m, [0.0, h])),
        ("p_r", p_r, share(p_r, 0.004), |m, h| add_to_law(m, [h, 0.0])),
        ("h", height, share(height, 0.002), |m, h| add_to_law(m, [0.0, h])),
        ("q", contact.decay.map(|d| d.static_ratio), 5e-3, |m, h| {
            m.contact.decay.as_mut().unwrap().static_ratio += h;
        }),
        ("v_c", contact.decay.map(|d| d.decay_speed), 5e-3, |m, h| {
            m.contact.decay.as_mut().unwrap().decay_speed += h;
        }),
    ]
}

impl Differences {
    /// Friction coefficient of the derivatives.
    pub const FRICTION: f64 = 0.35;

    /// Eigenvalues of all branches at a friction coefficient.
    fn eigenvalues<S: Sectors>(&self, model: &WaveModel<S>, friction: f64) -> BTreeMap<Name, c64> {
        let limit = MaxFrequency(self.limits_hz[1]);
        let branches = model.swept(&[friction], limit).branches;
        if self.is_whole {
            let own = pairs(&model.tangent(), &branches, friction).into_iter();
            return own.map(|s| ((s.harmonic, s.branch, s.direction), s.eigenvalue)).collect();
        }
        let found = branches.iter().filter_map(|own| {
            Some(((own.harmonic, own.branch, own.direction), own.interpolate(friction)?))
        });
        found.collect()
    }

    /// The worst error of derivatives `own` by a parameter of a size, with the derivative, the difference of fourth order over
    /// steps, both over that size, and their branch; and the largest error relative to `|lambda|`.
    fn worst(
        &self,
        (all, own): (&[WavePair], &[c64]),
        [scale, step]: [f64; 2],
        at: &dyn Fn(f64) -> BTreeMap<Name, c64>,
    ) -> ((f64, c64, c64, Name), f64) {
        let sides = [-2.0, -1.0, 1.0, 2.0].map(|k| at(k * step));
        let (mut missing, mut largest) = (0, 0.0_f64);
        let mut worst = (0.0, c64::default(), c64::default(), (0, 0, 0));
        for (s, own) in all.iter().zip(own) {
            let branch = (s.harmonic, s.branch, s.direction);
            let sides = sides.each_ref().map(|side| side.get(&branch));
            let [Some(a), Some(b), Some(c), Some(d)] = sides else {
                missing += 1;
                continue;
            };
            let numeric = ((c - b) * 8.0 - (d - a)) / (12.0 * step);
            let size = (numeric * scale).norm() + 1e-3 * s.eigenvalue.norm();
            let error = (own - numeric).norm() * scale / size;
            if error.is_nan() || error > worst.0 {
                worst = (error, own * scale, numeric * scale, branch);
            }
            largest = largest.max((own - numeric).norm() / s.eigenvalue.norm());
        }
        // At the limit of frequency, where nothing is looked for above it.
        let is_at_limit = self.limits_hz[0] == self.limits_hz[1];
        assert!(missing <= if is_at_limit { 2 } else { 0 }, "{missing} branches are lost");
        (worst, largest)
    }

    /// Holds the derivatives of every branch, by every parameter that the model has and by friction, to differences of whole
    /// analyses, base state included, so that the step may stay far above round-off. How many branches there are.
    pub fn hold<S: Sectors>(&self, model: &WaveModel<S>, what: &str) -> usize {
        let limit = MaxFrequency(self.limits_hz[0]);
        let found = model.swept(&[0.0, Self::FRICTION], limit);
        let all = pairs(&model.tangent(), &found.branches, Self::FRICTION);
        assert!(all.len() >= 5, "{what}: {}", all.len());
        for (name, scale, step, change) in parameters(model) {
            let Some(scale) = scale else { continue };
            let changed = |offset: f64| model.with(|own| change(own, offset));
            let step_of_rate = STEP * if name == "nu" { 0.1 } else { scale };
            let own = rates(&all, step_of_rate, &|offset| changed(offset).tangent());
            let (worst, _) = self.worst((&all, &own), [scale, self.factor * step], &|offset| {
                self.eigenvalues(&changed(offset), Self::FRICTION)
            });
            assert!(worst.0 < self.tolerance, "{what}, {name}: {worst:?}");
        }
        let own: Vec<c64> = all.iter().map(|pair| pair.derivative).collect();
        let at = |more: f64| self.eigenvalues(model, Self::FRICTION + more);
        let [step, bound] = self.by_friction;
        let (worst, largest) = self.worst((&all, &own), [Self::FRICTION, step], &at);
        assert!(worst.0 < self.tolerance, "{what}, friction: {worst:?}");
        assert!(largest < bound, "{what}, friction: {largest:e}");
        all.len()
    }
}
