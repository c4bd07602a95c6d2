//! Derivatives of growth rates by modifications of a body against differences of whole analyses run again with that
//! modification, small (independent check: the difference of two spectra knows nothing of vectors).

use crate::body_sensitivity::{Body, nearest};
use crate::prelude::*;
use frictionsim::results::improve::TargetFields;
use frictionsim::study::improve::improve;

/// What differences of second order leave, relative to the largest derivative of a kind over the body.
const TOLERANCE: f64 = 0.01;

impl Body {
    /// The eigenvalue nearest to one after some changes.
    fn nearest(&self, set: &[String], eigenvalue: c64) -> c64 {
        let case = self.case(set);
        let friction = case.contact.sliding.friction_coefficient;
        let sweep = modes_and_onsets(&case).unwrap_or_else(|e| panic!("{set:?}: {e}"));
        nearest(&(friction, sweep), eigenvalue)
    }

    /// `d growth / d p` at `p = 0`, near the given eigenvalue, by the difference over `0`, `h`, `2 h`; `keys` make a value of `p`.
    fn difference(&self, eigenvalue: c64, step: f64, keys: &dyn Fn(f64) -> Vec<String>) -> f64 {
        let [one, two] = [step, 2.0 * step].map(|p| self.nearest(&keys(p), eigenvalue).re);
        (4.0 * one - two - 3.0 * eigenvalue.re) / (2.0 * step)
    }

    /// Holds fields of the fastest mode to differences at some nodes and in the region `patch`; steps in kg, N/m and N s/m.
    fn check_fields(&self, nodes: &[usize], [mass, spring, dashpot]: [f64; 3]) {
        let found = improve(&self.case(&["improve.confirm=0", "improve.candidates=1"])).unwrap();
        let modes = found.summary.modes.iter().enumerate();
        let faster = modes.max_by(|a, b| a.1.growth_rate_per_s.total_cmp(&b.1.growth_rate_per_s));
        let (k, mode) = faster.unwrap();
        let own = c64::new(mode.growth_rate_per_s, TAU * mode.frequency_hz);
        let eigenvalue = self.nearest(&[], own);
        let (mesh, fields) = (&*found.mesh, &found.fields[k]);
        for &node in nodes {
            let label = mesh.node_label(node);
            let at = format!("modifications.t.at={label}");
            let with_mass = |p: f64| vec![format!("{at} ; modifications.t.mass={p:?}")];
            let by_mass = self.difference(eigenvalue, mass, &with_mass);
            near("mass", fields.mass[node], by_mass, &fields.mass);
            self.check_direction(eigenvalue, ("stiffness", spring), (mesh, node), &fields.spring);
            self.check_direction(eigenvalue, ("damping", dashpot), (mesh, node), &fields.dashpot);
        }
        self.check_patch(eigenvalue, mesh, fields);
    }

    /// The direction that helps most: no other one damps more, and it is as good as the field says.
    fn check_direction(
        &self,
        eigenvalue: c64,
        (key, step): (&str, f64),
        (mesh, node): (&Mesh, usize),
        field: &[f64],
    ) {
        let label = mesh.node_label(node);
        let along = |direction: [f64; 3]| {
            let listed = &direction[..mesh.dimension];
            let at = format!("modifications.t.at={label} ; modifications.t.direction={listed:?}");
            let with = |p| vec![format!("{at} ; modifications.t.{key}={p:?}")];
            self.difference(eigenvalue, step, &with)
        };
        // The quadratic form from its values along the axes and between them.
        let d = mesh.dimension;
        let unit = |i: usize| [0, 1, 2].map(|k| f64::from(u8::from(k == i)));
        let axes: Vec<f64> = (0..d).map(|i| along(unit(i))).collect();
        let mut form = DMatrix::from_fn(d, d, |i, _| axes[i]);
        for (i, j) in (0..d).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let (e, f) = (unit(i), unit(j));
            let between = [0, 1, 2].map(|k| e[k] + f[k]);
            // Along a unit vector the form has half of the sum of its four entries.
            form[(i, j)] = along(between) - 0.5 * (axes[i] + axes[j]);
            form[(j, i)] = form[(i, j)];
        }
        let least = form.symmetric_eigen().eigenvalues.min();
        near(key, field[node], least, field);
    }

    /// Damping of the region `patch`, and a share of it taken away.
    fn check_patch(&self, eigenvalue: c64, mesh: &Mesh, fields: &TargetFields) {
        let region = mesh.regions.iter().position(|name| name == "patch").unwrap();
        let own = || (0..mesh.element_count()).filter(|&e| mesh.region(e) == region);
        let size = |e: usize| mesh.element_measure(e);
        let sum = |field: &[f64]| own().map(|e| field[e] * size(e)).sum::<f64>();
        let case = self.case(AS_IT_IS);
        let elastic = *case.materials().of(region);
        let weaker = |p: f64| {
            let [e, rho] = [elastic.young_modulus, elastic.density].map(|own| own * (1.0 - p));
            vec![format!("materials.patch.young_modulus={e:?} ; materials.patch.density={rho:?}")]
        };
        let by_removal = self.difference(eigenvalue, 2e-3, &weaker);
        let removal = sum(&fields.removal);
        near("removal", removal, by_removal, &[by_removal]);
        let middle = own().map(|e| mesh.element_middle(e)).next().unwrap();
        let listed = &middle[..mesh.dimension];
        let place = format!("modifications.t.center={listed:?} ; modifications.t.radius=1e-6");
        let damped = |p| vec![format!("{place} ; modifications.t.stiffness_coefficient={p:?}")];
        let by_damping = self.difference(eigenvalue, 1e-8, &damped);
        let first = own().next().unwrap();
        near("damping", fields.damping[first] * size(first), by_damping, &[by_damping]);
    }
}

/// A derivative beside a difference, to a share of the largest derivative of its field.
fn near(what: &str, derivative: f64, difference: f64, field: &[f64]) {
    let largest = field.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let bound = TOLERANCE * difference.abs().max(0.02 * largest);
    assert!((derivative - difference).abs() < bound, "{what}: {derivative} {difference} {bound}");
}

/// A disc as a mesh file, some of whose elements are the region `patch`; its points moved by `place`.
fn disc(place: impl Fn([f64; 2]) -> [f64; 2], rest: &str) -> Body {
    let mut mesh = AnnulusMesh::generate(&annulus(Quad4, 24, 4)).unwrap().mesh;
    mesh.regions.push("patch".to_owned());
    // Two elements on one ray, away from both edges.
    for element in [4 * 5 + 1, 4 * 5 + 2] {
        mesh.element_regions[element] = 1;
    }
    let bytes = write_msh(&mesh, FORMS[2], &[], place);
    let folder = folder_with(&[("disc.msh", &bytes)]);
    let text = format!("{}{rest}", include_str!("../cases/patched-disc.toml"));
    Body { folder, text }
}

/// Rigid contact, clamped, undamped but for the material: the annulus, as the program meshes it.
#[test]
fn fields_of_the_disc_are_differences_of_its_spectra() {
    let body = disc(|point| point, "[boundaries.outer]\ncondition = \"clamped\"\n");
    body.check_fields(&[7, 23], [1e-5, 1e3, 1e-2]);
}

/// An oval on springs and dashpots under a compliant contact: nothing is proportional.
#[test]
fn fields_of_an_oval_on_supports_are_differences_of_its_spectra() {
    let place = |[x, y]: [f64; 2]| {
        let outwards = (x.hypot(y) - 0.0205) / 0.07;
        [x * (1.0 + 0.1 * outwards) + 0.004 * outwards, y]
    };
    let rest = "normal_stiffness = 1e14\n[boundaries.outer]\ncondition = \"support\"\n\
        normal_stiffness = 2e13\ntangential_stiffness = 2e13\nnormal_damping = 2e3\n";
    disc(place, rest).check_fields(&[7], [1e-5, 1e3, 1e-2]);
}

/// A pad on a slab of so many layers of bricks, free of stress.
fn pad_on_a_slab(layers: usize, text: String) -> Body {
    let blocks = [
        brick("slab", [0.0; 3], [0.06, 0.03, 0.01], [6, 3, layers]),
        brick("patch", [0.005, 0.005, 0.01], [0.02, 0.02, 0.02], [3, 3, 2]),
    ];
    Body { folder: folder_with(&[("pads.msh", &file_of(&blocks, |point| point))]), text }
}

/// What is removed takes the springs on its faces with it, as in the run again: without that, changes were off by 30 to 50 %.
#[test]
fn removals_from_a_slab_on_springs_are_predicted_as_they_run() {
    let springs = "\"support\"\nnormal_stiffness = 1e12\ntangential_stiffness = 1e12";
    let text = include_str!("../cases/pad-on-a-slab.toml").replacen("\"clamped\"", springs, 1);
    let case = pad_on_a_slab(2, text).case(&["improve={ modifications = [\"removal\"], \
         forbidden = [\"patch\"], candidates = 4, confirm = 4 }"]);
    let summary = improve(&case).unwrap().summary;
    let before = summary.base.growth_rate_per_s.unwrap();
    assert_eq!(summary.candidates.len(), 4);
    for own in &summary.candidates {
        let after = own.confirmed.unwrap().growth_rate_per_s.unwrap();
        let predicted = own.predicted.growth_rate_per_s.unwrap();
        within(&[predicted], &[after], 0.1 * (before - after).abs());
    }
}

#[test]
fn fields_of_an_assembly_are_differences_of_its_spectra() {
    let body = pad_on_a_slab(1, include_str!("../cases/pad-on-a-slab.toml").to_owned());
    let mesh = body.case(AS_IT_IS).body.mesh().unwrap();
    let free = (0..mesh.node_count()).find(|&n| {
        let [x, y, z] = mesh.nodes[n];
        x > 0.02 && y < 0.006 && (z - 0.02).abs() < 1e-9
    });
    body.check_fields(&[free.unwrap()], [1e-6, 1e2, 1e-3]);
}
