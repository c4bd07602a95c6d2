//! Sensitivities of bodies solved on their whole mesh against central differences of whole analyses run again (independent
//! checks): the difference of two spectra knows nothing of vectors.

use crate::prelude::*;
use frictionsim::study::eigenvalues::body_sensitivities;

/// What differences leave, relative: the square of their step where modes are about to meet, and the round-off of spectra over it.
const TOLERANCE: f64 = 1e-3;

/// A case beside its files.
pub struct Body {
    pub folder: TempDir,
    pub text: String,
}

impl Body {
    pub fn case<S: AsRef<str>>(&self, set: &[S]) -> Case {
        case_of(self.folder.path().join("case.toml"), &self.text, set)
    }

    /// The case's own friction coefficient and its spectrum.
    fn solve(&self, set: &[String]) -> (f64, FrictionSweep) {
        let case = self.case(set);
        let friction = case.contact.sliding.friction_coefficient;
        (friction, modes_and_onsets(&case).unwrap())
    }

    /// Holds the derivatives by some keys, ` ; ` between, to differences; how many onsets were among them. The table has the name of a
    /// key without what stands before a colon.
    fn check(&self, keys: &str) -> usize {
        let (case, (_, sweep)) = (self.case(AS_IT_IS), self.solve(&[]));
        let cea = case.require_cea().unwrap();
        let (report, missing) = body_sensitivities(&case, cea, &sweep, None).unwrap();
        assert_eq!(missing, Vec::<String>::new());
        let mut onsets = 0;
        for key in keys.split(" ; ") {
            let (name, key) = (key.split(':').next_back().unwrap(), key.replace(':', "."));
            let at = report.parameters.iter().position(|own| own.0 == name);
            let at = at.unwrap_or_else(|| panic!("no {name} in {:?}", report.parameters));
            let value = report.parameters[at].1;
            // Moduli run away with Poisson's ratio.
            let step = if key.ends_with("poisson_ratio") { 2e-4 } else { 2e-3 } * value;
            let sides = [1.0, -1.0].map(|s| self.solve(&[format!("{key}={:?}", value + s * step)]));
            let hold = |own: c64, derivative: c64, [above, below]: [c64; 2], rounding: f64| {
                let difference = (above - below) / (2.0 * step);
                let error = (derivative - difference).norm();
                let bound = TOLERANCE * difference.norm() + rounding * own.norm() / value;
                assert!(error < bound, "{key}, {own}: {derivative} {difference} {error:.1e}");
            };
            for row in &report.rows {
                let found = sides.each_ref().map(|s| nearest(s, row.eigenvalue));
                hold(row.eigenvalue, row.derivatives[at].unwrap(), found, 5e-7);
                let Some(onset) = &row.onset else { continue };
                onsets += 1;
                let friction = onset.critical_friction;
                let distance = |other: &f64| (other - friction).abs();
                let near = |own: &FrictionSweep| nearest_by(criticals(&own.intervals), distance);
                let found = sides.each_ref().map(|side| near(&side.1).into());
                hold(friction.into(), onset.derivatives[at].unwrap().into(), found, 1e-5);
            }
        }
        onsets
    }
}

/// The eigenvalue of a spectrum at a friction coefficient that is nearest to one.
pub fn nearest((friction, sweep): &(f64, FrictionSweep), eigenvalue: c64) -> c64 {
    let point = sweep.points.iter().filter(|point| point.friction_coefficient == *friction);
    let all = point.flat_map(|point| &point.modes).map(|mode| mode.eigenvalue);
    nearest_by(all, |other| (other - eigenvalue).norm())
}

/// Takes a disc to a body without symmetry: its hub stays round, its outer edge is an oval about another centre.
pub fn oval([x, y]: [f64; 2]) -> [f64; 2] {
    let outwards = (x.hypot(y) - 0.0205) / 0.07;
    [x * (1.0 + 0.3 * outwards) + 0.006 * outwards, y * (1.0 - 0.1 * outwards)]
}

/// Such a body on an elastic support.
fn supported_oval(contact: &str) -> Body {
    let mesh = AnnulusMesh::generate(&annulus(Quad4, 24, 4)).unwrap().mesh;
    let folder = folder_with(&[("oval.msh", &write_msh(&mesh, FORMS[2], &[], oval))]);
    let text = format!("{}{contact}", include_str!("../cases/supported-oval.toml"));
    Body { folder, text }
}

/// Supports with dashpots, falling friction, prestress: nothing is proportional, and the base state moves.
#[test]
fn sensitivities_of_an_oval_on_supports_are_differences_of_its_spectra() {
    let falls = "static_friction_ratio = 1.3\ndecay_speed = 1.0\ntangential_damping = 200.0\n";
    let onsets = supported_oval(falls).check(
        "material:young_modulus ; material:poisson_ratio ; material:density ; \
         contact:interference ; contact:decay_speed ; contact:rotation_speed_rpm",
    );
    assert!(onsets > 0, "no onset");
}

/// Springs and dashpots in the contact and on the support.
#[test]
fn sensitivities_of_an_oval_on_springs_are_differences_of_its_spectra() {
    supported_oval("normal_stiffness = 5e12\nnormal_damping = 1e3\n").check(
        "contact:normal_stiffness ; damping:stiffness_coefficient ; \
         boundaries.outer.normal_stiffness ; boundaries.outer.normal_damping",
    );
    // Losses of the body and of the contact: two keys that end in one word.
    let mut lossy = supported_oval("normal_stiffness = 5e12\nloss_factor = 0.05\n");
    lossy.text = lossy.text.replace("density = 1228.0\n", "density = 1228.0\nloss_factor = 0.02\n");
    lossy.check("material.loss_factor ; contact.loss_factor");
}

/// Some contact nodes are open at friction 0.5.
#[test]
fn sensitivities_of_a_block_whose_corner_lifts_are_differences_of_its_spectra() {
    let folder = folder();
    let text = fs::read_to_string(shipped("sliding-block.toml")).unwrap();
    let text = text
        .replace("meshes/block.msh", &shipped("meshes/block.msh"))
        .replace("[0.1, 0.3, 0.5]", "[0.5]")
        .replace("modes = 10", "modes = 3");
    Body { folder, text }.check("material:poisson_ratio");
}

/// Two blocks of bricks whose meshes do not match; the dashpot of friction across the sliding follows the pressure.
#[test]
fn sensitivities_of_an_assembly_are_differences_of_its_spectra() {
    let blocks = [
        brick("lower", [0.0; 3], [0.05, 0.04, 0.02], [3, 2, 1]),
        brick("upper", [0.005, 0.004, 0.02], [0.04, 0.03, 0.015], [2, 2, 1]),
    ];
    let folder = folder_with(&[("blocks.msh", &file_of(&blocks, |point| point))]);
    let text = include_str!("../cases/two-blocks-under-pressure.toml").to_owned();
    let isotropic = "young_modulus = 8e9\npoisson_ratio = 0.25\n";
    let orthotropic = "young_moduli = [8e9, 7e9, 3e9]\npoisson_ratios = [0.25, 0.15, 0.2]\n\
         shear_moduli = [3e9, 1.2e9, 1e9]\n";
    let mut body = Body { folder, text };
    body.check(
        "materials.upper.young_modulus ; boundaries.upper_z1.pressure ; \
         motion.lower.rotation_speed_rpm ; contacts.pad.normal_stiffness ; \
         contacts.pad.friction_coefficient",
    );
    // The entries of lists.
    body.text = body.text.replace(isotropic, orthotropic);
    let entries = ["young_moduli[3]", "poisson_ratios[1]", "shear_moduli[2]"];
    body.check(&entries.map(|entry| format!("materials.upper.{entry}")).join(" ; "));
}
