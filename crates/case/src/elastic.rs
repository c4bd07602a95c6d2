//! Elastic constants of a material, isotropic or orthotropic, and where its axes lie.

use super::tables::{TableFiles, modulus_table};
use super::words::AxesWord;
use crate::*;
use frictionsim_physics::fem::{MaterialAxes, Orthotropy, RATIOS};

/// The constants of an isotropic material.
const ISOTROPIC: [&str; 2] = ["young_modulus", "poisson_ratio"];
/// The constants of an orthotropic one.
pub(super) const ORTHOTROPIC: [&str; 3] = ["young_moduli", "poisson_ratios", "shear_moduli"];

/// About what the body is built, which decides where the axes of a material can lie.
pub(super) struct Surroundings {
    /// Direction and a point of the axis of the body or of its motion; else why there is none.
    pub axis: Result<[[f64; 3]; 2], &'static str>,
    pub is_plane: bool,
    /// Whether it consists of equal sectors about that axis.
    pub has_sectors: bool,
}

/// The loss factor of a section, at most 1.
pub(super) fn loss_factor(section: &Section<'_>) -> f64 {
    let loss_factor = section.number("loss_factor");
    refuse_if!(loss_factor > 1.0; section, "loss_factor" =>
        "= {loss_factor} is beyond any material's: at 1 half of the strain energy is lost in a \
         sixth of a cycle"; "at most 1";
        "steel has about 0.001, cast iron 0.002, a lining 0.01 to 0.1, rubber 0.1 to 1");
    loss_factor
}

/// Elasticity and density of `[material]` or of a section of `[materials.*]`. Cylindrical axes are about z until
/// [`place_axes`] knows the body. A table over frequency gives modulus and loss factor.
pub(super) fn material(
    section: &Section<'_>,
    formulation: PlaneFormulation,
    tables: &TableFiles<'_>,
) -> RegionMaterial {
    let table = modulus_table(section, tables);
    let density = section.number("density");
    let loss_factor = loss_factor(section);
    let plain = ElasticMaterial { density, loss_factor, formulation, ..ElasticMaterial::PLAIN };
    let elastic = if section.has("table") {
        // What is wrong with its file is said already.
        let harmless = ModulusTable::new("", "", vec![[0.0, 1.0, 0.0]]);
        tabled(section, plain, table.as_deref().unwrap_or(&harmless))
    } else if ORTHOTROPIC.iter().any(|key| section.has(key)) {
        for key in ISOTROPIC {
            let _ = section.optional_number(key);
            refuse_if!(section.has(key); section, key =>
                "beside the keys of an orthotropic material"; "isotropic or orthotropic";
                "leave out the constants of the one or of the other");
        }
        let own = orthotropy(section);
        let [young_modulus, poisson_ratio] = own.mean_constants();
        let orthotropy = Some(own);
        ElasticMaterial { young_modulus, poisson_ratio, orthotropy, ..plain }
    } else {
        // Known keys of the section, though none is given.
        let _ = ORTHOTROPIC.map(|key| section.numbers(key));
        refuse_if!(axes(section) != MaterialAxes::global(); section, "axes" =>
            "is for an orthotropic material"; "an isotropic material has no axes";
            "give young_moduli, poisson_ratios and shear_moduli, or leave it out");
        let [young_modulus, poisson_ratio] = ISOTROPIC.map(|key| section.number(key));
        ElasticMaterial { young_modulus, poisson_ratio, ..plain }
    };
    RegionMaterial { table, ..elastic.into() }
}

/// An isotropic material with the modulus of the lowest frequency of its table, which gives the loss factor too.
fn tabled(section: &Section<'_>, plain: ElasticMaterial, table: &ModulusTable) -> ElasticMaterial {
    let _ = ORTHOTROPIC.map(|key| section.numbers(key));
    let _ = (axes(section), section.optional_number("young_modulus"));
    let excluded = ["young_modulus", "loss_factor", "axes"];
    for key in excluded.iter().chain(&ORTHOTROPIC).filter(|key| section.has(key)) {
        refuse!(section, key => "beside {}", section.name("table");
            "the table gives modulus and loss factor";
            "leave out the one or the other; poisson_ratio and density stand beside a table");
    }
    section.needs("poisson_ratio");
    ElasticMaterial {
        young_modulus: table.static_modulus(),
        poisson_ratio: section.optional_number("poisson_ratio").unwrap_or(0.0),
        loss_factor: 0.0,
        ..plain
    }
}

/// The constants, nine or the five of a material that is isotropic across its axis 3, and the axes.
/// Every strain must have a positive energy.
fn orthotropy(section: &Section<'_>) -> Orthotropy {
    // As most of the lists are.
    let is_of_five = |k: &usize| section.list_length(ORTHOTROPIC[*k]) == Some([2, 2, 1][*k]);
    let (counts, label) = match (0..3).filter(is_of_five).count() > 1 {
        true => ([2, 2, 1], "[E_1, E_3], [nu_12, nu_13], [G_13] are isotropic across axis 3"),
        false => ([3; 3], "one for each of three axes"),
    };
    let [moduli, ratios, shears] = [0, 1, 2].map(|k| {
        let (key, count) = (ORTHOTROPIC[k], counts[k]);
        section.needs(key);
        let given = section.list_length(key).unwrap_or(1);
        refuse_if!(section.has(key) && given != count; section, key =>
            "has {given} of {count} numbers"; "{label}");
        section.numbers(key).unwrap_or_default()
    });
    let (young_moduli, poisson_ratios, shear_moduli) = match (&*moduli, &*ratios, &*shears) {
        (&[e, e3], &[nu, n3], &[g]) => ([e, e, e3], [nu, n3, n3], [e / (2.0 * (1.0 + nu)), g, g]),
        (&[a, b, c], &[ab, ac, bc], &[d, e, f]) => ([a, b, c], [ab, ac, bc], [d, e, f]),
        // Told above.
        _ => ([1.0; 3], [0.0; 3], [1.0; 3]),
    };
    let axes = axes(section);
    let orthotropy = Orthotropy { young_moduli, poisson_ratios, shear_moduli, axes };
    if let Err(broken) = orthotropy.check() {
        let (name, [low, high]) = (RATIOS[broken.which], broken.bounds);
        let value = orthotropy.poisson_ratios[broken.which];
        refuse!(section, "poisson_ratios",
            "{}: {name} = {value} would give some strain a negative energy; beside the other \
             constants it must lie between {low:.6} and {high:.6}", section.name("poisson_ratios");
            "{name} is too large";
            "nu_ij is the contraction along j under a stress along i: nu_ij / E_i = nu_ji / E_j; \
             are the axes swapped?");
    }
    orthotropy
}

/// `axes`: a word, or two vectors.
fn axes(section: &Section<'_>) -> MaterialAxes {
    let Some(vectors) = section.vectors("axes") else {
        return match section.choice("axes") {
            AxesWord::Global => MaterialAxes::global(),
            AxesWord::Cylindrical => {
                MaterialAxes::Cylindrical { axis: [0.0, 0.0, 1.0], center: [0.0; 3] }
            }
        };
    };
    let filled = |vector: &[f64]| match *vector {
        [x, y] => Some([x, y, 0.0]),
        [x, y, z] => Some([x, y, z]),
        _ => None,
    };
    let found = match vectors.as_slice() {
        [first, second] => filled(first).zip(filled(second)),
        _ => None,
    };
    let Some((first, second)) = found else {
        refuse!(section, "axes" => "needs two vectors"; "must be [[x, y, z], [x, y, z]]");
        return MaterialAxes::global();
    };
    MaterialAxes::along(first, second).unwrap_or_else(|| {
        refuse!(section, "axes", "the vectors of {} are parallel", section.name("axes");
            "span no plane"; "the first is axis 1, the second lies in the plane of axes 1 and 2");
        MaterialAxes::global()
    })
}

/// Lays cylindrical axes about the body's own, and refuses axes under which the body is not what its analyses take it
/// for. `path` is the material's section: `["material"]` or `["materials", NAME]`.
pub(super) fn place_axes(
    root: &Section<'_>,
    path: &[&str],
    material: &mut ElasticMaterial,
    body: &Surroundings,
) {
    let Some(orthotropy) = &mut material.orthotropy else { return };
    let reject = |message: String, label: &str, help: &str| {
        let outer = root.section(path[0], false);
        let inner = path.get(1).map(|name| outer.section(name, false));
        let section = inner.as_ref().unwrap_or(&outer);
        let key = if section.has("axes") { "axes" } else { "young_moduli" };
        refuse!(section, key, "{}: {message}", section.name(key); "{label}"; "{help}");
    };
    if let MaterialAxes::Cylindrical { axis, center } = &mut orthotropy.axes {
        match body.axis {
            Ok(found) => [*axis, *center] = found,
            Err(reason) => reject(
                format!("\"cylindrical\" axes lie about the axis of the motion: {reason}"),
                "no axis to lie about",
                "give two vectors, or \"global\"",
            ),
        }
    }
    if body.is_plane && !orthotropy.is_symmetric_across_z() {
        reject(
            "motions in the plane would cause others across it: a plane body needs one axis of the material along z"
                .to_owned(),
            "no plane of symmetry",
            "give two vectors in the plane, or one in it and [0, 0, 1]",
        );
    } else if body.has_sectors && !orthotropy.is_invariant_about_z() {
        reject(
            "fixed axes make the sectors of a body of revolution differ from one another, and its motions have no \
             circumferential harmonics then"
                .to_owned(),
            "not the same at every angle",
            "use axes = \"cylindrical\", describe the body by mesh.file, or give constants alike \
             across z: two young_moduli, two poisson_ratios and one of shear_moduli",
        );
    }
}
