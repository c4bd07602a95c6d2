//! `[convergence]`: the same case on several meshes and with several time steps.

use super::{Analysis, Contact, body::node_count};
use crate::*;
use frictionsim_physics::mesh::ShaftSpecification;

/// Fewest refinements that an order can be observed from.
const FEWEST: usize = 3;
/// Refinements of the two directions may differ by this much before the user hears of it.
const UNEVEN: f64 = 0.02;

/// `[convergence]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// Refinements of the element size, rising: factors on both element counts of the annulus, powers of two on an
    /// imported mesh, whose elements are split.
    pub factors: Vec<f64>,
    /// Factors on the transient's time step on the case's own mesh, falling; empty for no such study.
    pub time_step_factors: Vec<f64>,
    /// What is studied, each once, at least one.
    pub analyses: Vec<Analysis>,
}

impl Convergence {
    /// The mesh of a refinement: both element counts times `factor`, rounded; a graded mesh keeps its
    /// distribution of element sizes over the radius.
    pub fn refined(annulus: &AnnulusSpecification, factor: f64) -> AnnulusSpecification {
        let times = |count: usize| (count as f64 * factor).round() as usize;
        let radial_elements = times(annulus.radial_elements);
        // Element k of n begins at the same radius as element (factor k) of (factor n).
        let exponent = annulus.radial_elements as f64 / radial_elements.max(1) as f64;
        let shaft = annulus.shaft.map(|shaft| ShaftSpecification {
            radial_elements: times(shaft.radial_elements),
            ..shaft
        });
        AnnulusSpecification {
            shaft,
            circumferential_elements: times(annulus.circumferential_elements),
            radial_elements,
            radial_grading: annulus.radial_grading.powf(exponent),
            ..*annulus
        }
    }
}

impl super::Case {
    /// The case on a mesh whose elements are `factor` times as fine: a generated mesh has so many times as many
    /// elements in every direction, an imported one is split.
    ///
    /// # Errors
    /// An imported mesh that cannot be refined.
    pub fn refined(&self, factor: f64) -> Result<Self, super::CaseErrors> {
        let mut body = self.body.clone();
        let no_body = |error: BodyError| {
            let (key, label) = ("convergence.factors", "makes no body".to_owned());
            self.error_at(key, format!("{key} = {factor}: {error}"), label, None)
        };
        match &mut body.kind {
            BodyKind::Annulus(annulus) => *annulus = Convergence::refined(annulus, factor),
            BodyKind::Revolution(solid) => {
                solid.annulus = Convergence::refined(&solid.annulus, factor);
                solid.axial_elements = (solid.axial_elements as f64 * factor).round() as usize;
            }
            // A generated body on its whole mesh stays as round as it is.
            BodyKind::Assembly(AssemblyBody { made_of: Some(solid), .. }) => {
                body = self.with_counts(solid, factor)?.body;
            }
            BodyKind::Assembly(assembly) => {
                for _ in 0..factor.log2() as u32 {
                    assembly.mesh = Arc::new(assembly.mesh.refined_solids().map_err(no_body)?);
                }
            }
            BodyKind::Imported(imported) => {
                *imported = imported.refined(factor.log2() as u32).map_err(no_body)?;
            }
        }
        let mut finer = Self { body, ..self.clone() };
        // The nodes of a split mesh are not numbered by sectors: it is solved as a whole.
        if let Some(cea) = finer.cea.as_mut().filter(|_| self.body.is_of_sectors()) {
            cea.method = CeaMethod::Auto;
        }
        Ok(finer)
    }

    /// The case of a generated body with so many times as many elements in every direction.
    fn with_counts(&self, solid: &SolidSpecification, factor: f64) -> Result<Self, CaseErrors> {
        let annulus = Convergence::refined(&solid.annulus, factor);
        let finer = [
            format!("mesh.circumferential_elements={}", annulus.circumferential_elements),
            format!("mesh.radial_elements={}", annulus.radial_elements),
            format!("mesh.axial_elements={}", (solid.axial_elements as f64 * factor).round()),
            format!("mesh.radial_grading={:?}", annulus.radial_grading),
        ];
        Self::read(self.raw.with_overrides(&finer)?)
    }
}

/// Refinements of an imported mesh where none are given.
const SPLITS: [f64; 3] = [1.0, 2.0, 4.0];

pub(super) fn read(
    section: &Section<'_>,
    root: &Section<'_>,
    body: Option<&Body>,
    contact: &Contact,
) -> Convergence {
    refuse_if!(root.has("modifications"); root, "modifications",
        "[modifications] are places of one mesh: a finer one would have others";
        "not beside [convergence]";
        "leave one of the two sections out, and compare meshes by hand");
    let mut factors = section.numbers("factors").unwrap_or_default();
    let solid = body.and_then(Body::revolved);
    let grid = solid.map(|own| &own.annulus).or(body.and_then(Body::annulus));
    if body.is_some() && grid.is_none() && !section.has("factors") {
        factors = SPLITS.to_vec();
    }
    if is_series(section, "factors", &factors, 1.0) {
        match (grid, body.and_then(Body::whole_mesh)) {
            (Some(grid), _) => check_meshes(section, grid, solid, &factors),
            (None, Some(mesh)) => check_splits(section, mesh, &factors),
            (None, None) => {}
        }
    }
    let time_step_factors = section.numbers("time_step_factors").unwrap_or_default();
    if section.has("time_step_factors") {
        is_series(section, "time_step_factors", &time_step_factors, -1.0);
    }
    let is_linear = body.is_none_or(Body::suits_transient);
    // Cycles that are no rotating waves have no name that two meshes share.
    let has_waves = body.is_none_or(|body| body.has_rotating_waves(contact));
    let can_run = |analysis: Analysis| match analysis {
        Analysis::Cea => root.has("cea"),
        Analysis::Transient => root.has("transient") && is_linear,
        Analysis::Cycle => root.has("cycle") && is_linear && has_waves,
        // A boundary is no number that a mesh converges to within one step of its search.
        Analysis::Basin => false,
    };
    let analyses = analyses(section, can_run);
    refuse_if!(!time_step_factors.is_empty() && !analyses.contains(&Analysis::Transient); section,
        "time_step_factors", "convergence.time_step_factors needs a [transient]";
        "there is no transient in this case";
        "add a [transient] section of quad4 elements, or leave time_step_factors out");
    Convergence { factors, time_step_factors, analyses }
}

/// Refuses fewer than three values, and those that do not strictly rise (`sign` 1) or fall (-1).
fn is_series(section: &Section<'_>, key: &'static str, values: &[f64], sign: f64) -> bool {
    let given = section.list_length(key).unwrap_or(values.len());
    refuse_if!(given < FEWEST; section, key =>
        "has {given} values; observing an order takes {FEWEST} or more";
        "at least {FEWEST} values");
    if values.len() < FEWEST {
        return false;
    }
    let pair = values.windows(2).find(|pair| sign * (pair[1] - pair[0]) <= 0.0);
    if let Some(pair) = pair {
        let (word, why) = match sign > 0.0 {
            true => ("rise", "each mesh finer than the one before"),
            false => ("fall", "each step shorter than the one before"),
        };
        refuse!(section, key, "{} must {word}, but {} follows {}", section.name(key), pair[1],
            pair[0]; "{why}");
    }
    pair.is_none()
}

/// Refuses factors that no splitting of elements gives, and meshes that are too large.
fn check_splits(section: &Section<'_>, mesh: &Mesh, factors: &[f64]) {
    let is_power = |factor: f64| (1.0..1e6).contains(&factor) && factor.log2().fract() == 0.0;
    if let Some(factor) = factors.iter().find(|factor| !is_power(**factor)) {
        refuse!(section, "factors",
            "convergence.factors holds {factor}: an imported mesh is refined by splitting each \
             element into four, a solid one into eight";
            "powers of two: 1, 2, 4, ..."; "leave it out for [1, 2, 4]");
        return;
    }
    let finest = factors.last().copied().unwrap_or(1.0);
    let limit = f64::from(u32::MAX / mesh.dimension as u32);
    let nodes = mesh.node_count() as f64 * finest.powi(mesh.dimension as i32);
    refuse_if!(nodes > limit; section, "factors",
        "the mesh of convergence.factors = {finest} would have {nodes:.0} nodes, above the limit \
         of {limit}"; "too many elements");
}

/// Refuses factors whose rounded meshes are none, too large, or not refinements of each other.
fn check_meshes(
    section: &Section<'_>,
    annulus: &AnnulusSpecification,
    solid: Option<&SolidSpecification>,
    factors: &[f64],
) {
    if annulus.circumferential_elements == 0 || annulus.radial_elements == 0 {
        return;
    }
    let mut previous: Option<(f64, AnnulusSpecification)> = None;
    for &factor in factors {
        let mesh = Convergence::refined(annulus, factor);
        let (around, radial) = (mesh.circumferential_elements, mesh.radial_elements);
        let name = format!("the mesh of convergence.factors = {factor}, {around} x {radial}");
        if around < 3 || radial < 1 {
            refuse!(section, "factors", "{name}, has too few elements";
                "at least 3 around and 1 along the radius");
            return;
        }
        let (nodes, limit) = (node_count(&mesh), u128::from(u32::MAX / 2));
        if nodes > limit {
            refuse!(section, "factors",
                "{name}, would have {nodes} nodes, above the limit of {limit}";
                "too many elements");
            return;
        }
        if let Some((other, coarser)) = &previous
            && (around <= coarser.circumferential_elements || radial <= coarser.radial_elements)
        {
            refuse!(section, "factors",
                "{name}, does not refine that of {other}, {} x {}, in both directions",
                coarser.circumferential_elements, coarser.radial_elements;
                "factors further apart, or a finer mesh to start from");
            return;
        }
        let a = around as f64 / annulus.circumferential_elements as f64;
        let r = radial as f64 / annulus.radial_elements as f64;
        let layers = solid.map(|solid| solid.axial_elements as f64);
        let z = layers.map_or(a, |layers| (layers * factor).round() / layers);
        for (other, ratio, along) in
            [(r, a / r, "along the radius"), (z, z / a, "over the thickness")]
        {
            caution_if!((ratio - 1.0).abs() > UNEVEN; section, "factors",
                "{name}, refines by {a:.3} around and {other:.3} {along} after rounding: the \
                 observed order suffers from that"; "uneven after rounding");
        }
        previous = Some((factor, mesh));
    }
}

/// What is studied: what the section names, else what the case has sections for and its elements can run.
fn analyses(section: &Section<'_>, can_run: impl Fn(Analysis) -> bool) -> Vec<Analysis> {
    let all = [Analysis::Cea, Analysis::Transient, Analysis::Cycle, Analysis::Basin];
    let named = section.choices("analyses");
    if named.is_empty() {
        let all: Vec<Analysis> = all.into_iter().filter(|own| can_run(*own)).collect();
        refuse_if!(all.is_empty() && !section.has("analyses"); section, "analyses",
            "[convergence] has nothing to study: the case has neither [cea] nor a [transient] or a \
             [cycle] that its elements can run"; "no analysis in the case";
            "add\n[cea]\nmax_frequency_hz = 17500.0");
        return all;
    }
    let named: Vec<Analysis> = all.into_iter().filter(|own| named.contains(own)).collect();
    for analysis in &named {
        refuse_if!(!can_run(*analysis); section, "analyses",
            "convergence.analyses names \"{}\", which this case cannot run", analysis.word();
            "an analysis needs its own section. A transient also needs quad4 elements, a cycle \
             quad4 elements and the built-in annulus on a rigid cylinder, with constant friction");
    }
    named
}
