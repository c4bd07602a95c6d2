//! Results of `improve`: where a modification silences unstable modes, what it is predicted to do, and what it does.

use crate::common::*;

/// What `improve` finds.
pub struct Improvement {
    /// What there is to say of it.
    pub summary: ImproveSummary,
    /// The mesh of the fields.
    pub mesh: Arc<Mesh>,
    /// Derivatives of each target over the mesh.
    pub fields: Vec<TargetFields>,
}

/// Fields over the mesh of one target.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetFields {
    /// Its mode.
    pub mode: TargetMode,
    /// Derivative of the growth rate by a mass at each node, 1/s for each kg.
    pub mass: Vec<f64>,
    /// By a spring at each node along the direction that helps most, 1/s for each N/m.
    pub spring: Vec<f64>,
    /// By a dashpot alike, 1/s for each N s/m.
    pub dashpot: Vec<f64>,
    /// By taking each element away, 1/s for each m2 of area (m3 of solid bodies).
    pub removal: Vec<f64>,
    /// By stiffness damping of each element, 1/s for each s and m2 (m3).
    pub damping: Vec<f64>,
}

keys! {
    /// `summary.json` of `improve`.
    ImproveSummary {
        dofs: usize = "unknowns of the eigenproblem";
        friction_coefficient: f64 = "the friction coefficient at which modes are to be silenced";
        base: State = "what the case does as it is";
        modes: Vec<TargetMode> = "the modes that are to be silenced, by frequency";
        sizes: Sizes = "sizes of the modifications";
        extent: Extent = "what masses, stiffnesses and dashpots are of";
        candidates: Vec<Candidate> = "modifications, the best first";
        notes: Vec<String> = "what there is to say";
    }

    /// A mode that is to be silenced.
    #[derive(Copy)]
    TargetMode {
        mode: usize = "number by frequency, from 1";
        frequency_hz: f64 = "`Im(lambda) / 2 pi`, Hz";
        growth_rate_per_s: f64 = "`Re(lambda)`, 1/s";
    }

    /// What the modes of the window of frequencies come to.
    #[derive(Copy, Default)]
    State, STATES {
        growth_rate_per_s: Option<f64> = "growth rate of the fastest mode of the window",
            Always "growth" Significant(4);
        /// Its frequency, Hz.
        frequency_hz: Option<f64>;
        critical_friction: Option<f64> = "lowest critical friction of the window, of a run; empty \
            where none is below the case's own", Always "critical friction" Fixed(4);
        unstable: usize = "unstable modes there";
        unstable_beside: usize = "unstable modes at other frequencies";
        /// Frequency of the one of them that grows fastest, Hz.
        beside_hz: Option<f64>;
    }
}

/// Those that a prediction has too.
pub(super) const PREDICTED: &[Column<State>] = parted(STATES, "critical_friction").0;

keys! {
    /// Sizes of the modifications.
    #[derive(Copy)]
    Sizes {
        mass_kg: f64 = "mass at a node, kg";
        stiffness_n_per_m: f64 = "stiffness of a spring, N/m";
        damping_n_s_per_m: f64 = "damping of a dashpot, N s/m";
        patch_radius_m: f64 = "radius of a patch, m";
        patch_damping_s: f64 = "stiffness coefficient of its damping, s";
        offset_m: f64 = "largest shift of the contact curve, m";
    }

    /// One modification.
    Candidate {
        rank: usize = "place in the list, from 1";
        kind: String = "what it is";
        node: Option<usize> = "number of its node";
        position_m: [f64; 3] = "where it is, m; the way of the hole for an offset";
        direction: Option<[f64; 3]> = "direction of a spring or dashpot";
        added_mass_kg: f64 = "mass that it adds, kg; negative where material is taken away";
        first_order_growth_rate_per_s: Option<f64> = "largest growth rate of the targets to first order, 1/s";
        predicted: State = "what is predicted from all listed modes together";
        confirmed: Option<State> = "what the modified case does";
        verdict: String = "what that comes to, in words";
        keys: Vec<String> = "case keys that make it";
    }
}

impl Candidate {
    /// Where it is, in words.
    pub fn place(&self) -> String {
        // No minus sign before a zero.
        let [x, y, z] = self.position_m.map(|value| (1e5 * value).round() / 1e2 + 0.0);
        let depth = if z == 0.0 { String::new() } else { format!(", {z:.2}") };
        match (self.kind.as_str(), self.node) {
            ("offset", _) => format!("hole moved by ({x:.2}, {y:.2}) mm"),
            (_, Some(node)) => format!("node {node} at ({x:.2}, {y:.2}{depth}) mm"),
            _ => format!("about ({x:.2}, {y:.2}{depth}) mm"),
        }
    }
}

/// A critical friction coefficient for people: none up to that of the case.
pub(super) fn critical(value: Option<f64>, friction: f64) -> String {
    value.map_or_else(|| format!("> {friction}"), |value| format!("{value:.4}"))
}

impl ImproveSummary {
    /// The first candidate that silences the window when it is run again, else the first that does what was predicted.
    pub fn best(&self) -> Option<&Candidate> {
        let of_verdict = |verdict: &str| self.candidates.iter().find(|own| own.verdict == verdict);
        of_verdict("silenced").or_else(|| of_verdict("confirmed"))
    }

    /// What was found, in a sentence.
    pub fn answer(&self) -> String {
        let friction = self.friction_coefficient;
        let onset = |state: State| critical(state.critical_friction, friction);
        let place = |own: &Candidate| format!("{} ({})", own.kind, own.place());
        match (self.best(), self.candidates.first()) {
            (Some(own), _) => {
                let [from, to] = [self.base, own.confirmed.unwrap_or_default()].map(onset);
                let change = format!("{}: critical friction {from} -> {to}", place(own));
                format!("{change}, run again and {}", own.verdict)
            }
            (None, Some(own)) if own.confirmed.is_none() => {
                let growth = significant(own.predicted.growth_rate_per_s.unwrap_or(0.0), 4);
                format!("{}: growth {growth} 1/s predicted; none was run again", place(own))
            }
            (None, Some(_)) => "none of the candidates that were run again holds".to_owned(),
            (None, None) => "no modification of these sizes helps".to_owned(),
        }
    }
}

columns! {
    /// A modification and its place.
    pub(crate) CANDIDATES: own as Candidate;
    rank: "place in the list, from 1" = own.rank, Always "rank" Count;
    kind: "mass, spring, dashpot, removal, damping or offset" = own.kind.clone(), Always "kind" Plain;
    node: "number of its node" = own.node;
    x_m: "where it is; the way of the hole for an offset" = own.position_m[0];
    y_m: "where it is; the way of the hole for an offset" = own.position_m[1];
    z_m: "where it is; the way of the hole for an offset" = own.position_m[2];

    /// The direction of a spring or dashpot, and what a modification weighs.
    pub(crate) EFFECTS: own as Candidate;
    direction_x: "direction of a spring or dashpot" = own.direction.map(|d| d[0]);
    direction_y: "direction of a spring or dashpot" = own.direction.map(|d| d[1]);
    direction_z: "direction of a spring or dashpot" = own.direction.map(|d| d[2]);
    added_mass_kg: "mass that it adds; negative where material is taken away"
        = own.added_mass_kg, Always "mass" Significant(4);
    first_order_growth_rate_per_s: "largest growth rate of the targets to first order"
        = own.first_order_growth_rate_per_s, IfAny "growth, first order" Significant(4);

    /// What a run comes to, and how to make it.
    pub(crate) VERDICTS: own as Candidate;
    verdict: "what the run with it comes to" = own.verdict.clone(), Always "verdict" Plain;
    keys: "keys of the case that make it" = own.keys.join("; ");
}

/// Tables and sentences.
pub fn document(summary: &ImproveSummary) -> Document {
    Document::new("Modifications")
        .section(Section::new("Results").facts(facts(summary)).text([summary.answer()]))
        .section(Section::new("Candidates").tables([candidates(summary)]))
        .notes(&summary.notes)
        .section(Section::new("Where it helps").figures([""]))
}

fn candidates(summary: &ImproveSummary) -> Table {
    let all = || &summary.candidates;
    Table::new(
        "candidates.csv",
        "Modifications, best first. Without critical friction: not run again, or stable up to the case's",
    )
    .columns(CANDIDATES, all())
    .column("", Some(("where", Format::Plain)), all().iter().map(Candidate::place))
    .columns(EFFECTS, all())
    .group("predicted_", "predicted ", PREDICTED, all().iter().map(|own| Some(own.predicted)))
    .group("confirmed_", "confirmed ", STATES, all().iter().map(|own| own.confirmed))
    .columns(VERDICTS, all())
}

/// Name and value of what decides.
fn facts(summary: &ImproveSummary) -> Vec<(String, String)> {
    let friction = summary.friction_coefficient;
    let sizes = &summary.sizes;
    let text = |name: &str, value: f64, unit: &str| {
        (name.to_owned(), format!("{} {unit}", significant(value, 4)))
    };
    let onset = critical(summary.base.critical_friction, friction);
    let mut rows = vec![
        ("friction coefficient".to_owned(), friction.to_string()),
        ("critical friction as it is".to_owned(), onset),
    ];
    rows.extend(summary.modes.iter().map(|mode| {
        let name =
            format!("growth of mode {}, {} Hz", mode.mode, significant(mode.frequency_hz, 6));
        text(&name, mode.growth_rate_per_s, "1/s")
    }));
    let unit = |unit: &str| summary.extent.unit(unit);
    rows.extend([
        text("added mass", sizes.mass_kg, &unit("kg")),
        text("spring", sizes.stiffness_n_per_m, &unit("N/m")),
        text("dashpot", sizes.damping_n_s_per_m, &unit("N s/m")),
        text("patch radius", sizes.patch_radius_m, "m"),
        text("patch damping", sizes.patch_damping_s, "s"),
        text("largest shift of the hole", sizes.offset_m, "m"),
    ]);
    rows
}

/// Writes the fields over the mesh, and the keys of the best candidate.
pub fn write(folder: &OutputFolder, found: &Improvement) -> Result<(), FolderError> {
    write_fields(folder, found)?;
    if let Some(best) = found.summary.best() {
        folder.write("improved.toml", |out| {
            writeln!(out, "# {}", best.place())?;
            best.keys.iter().try_for_each(|key| writeln!(out, "{}", key.replacen('=', " = ", 1)))
        })?;
    }
    Ok(())
}

/// Writes the derivatives of each target as fields.
fn write_fields(folder: &OutputFolder, found: &Improvement) -> Result<(), FolderError> {
    let power = if found.mesh.dimension == 2 { "m2" } else { "m3" };
    let (mut nodal, mut in_elements) = (Vec::new(), Vec::new());
    for own in &found.fields {
        let field = |what: &str, unit: &str, values: &[f64]| {
            let name = format!("mode_{}_growth_by_{what}_{unit}", own.mode.mode);
            Field::scalars(&name, values.iter().copied())
        };
        nodal.extend([
            field("mass", "1_per_s_kg", &own.mass),
            field("spring", "m_per_n_s", &own.spring),
            field("dashpot", "m_per_n_s2", &own.dashpot),
        ]);
        in_elements.extend([
            field("removal", &format!("1_per_s_{power}"), &own.removal),
            field("damping", &format!("1_per_s2_{power}"), &own.damping),
        ]);
    }
    folder.write_bulk("improve.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(&found.mesh)?, &[], &nodal, &in_elements)
    })
}

/// Targets that have a figure, the fastest first.
const MOST: usize = 4;

/// A figure for each target, the fastest first.
pub fn figures(found: &Improvement) -> Vec<Figure> {
    let order = sorted(&found.fields, |own| -own.mode.growth_rate_per_s).into_iter();
    let figures = order.take(MOST).map(|own| -> Declaration<'_> {
        Box::new(move || Some(target_figure(&found.summary, &found.mesh, own)))
    });
    declared(figures.collect())
}

/// The derivatives of one growth rate over the body, a panel for each kind of modification.
fn target_figure(summary: &ImproveSummary, mesh: &Mesh, own: &TargetFields) -> Figure {
    let Sizes { mass_kg, stiffness_n_per_m, damping_n_s_per_m, patch_radius_m: radius, .. } =
        summary.sizes;
    let unit = |unit: &str| summary.extent.unit(unit);
    let patch = match mesh.dimension {
        2 => PI * radius.powi(2),
        _ => 4.0 / 3.0 * PI * radius.powi(3),
    };
    let damped = patch * summary.sizes.patch_damping_s;
    let text = |what: &str, size: f64, unit: &str| {
        format!("{what} {} {unit}", frictionsim_chart::significant(size, 3))
    };
    let mass = text("mass of", mass_kg, &unit("kg"));
    let spring = text("spring to the ground of", stiffness_n_per_m, &unit("N/m"));
    let dashpot = text("dashpot to the ground of", damping_n_s_per_m, &unit("N s/m"));
    let (removal, damping) = (nodal(mesh, &own.removal), nodal(mesh, &own.damping));
    let panels = [
        ("mass", mass, mass_kg, &own.mass),
        ("spring", spring, stiffness_n_per_m, &own.spring),
        ("dashpot", dashpot, damping_n_s_per_m, &own.dashpot),
        ("removal", text("removal within", radius, "m"), patch, &removal),
        ("damping", text("damping layer within", radius, "m"), damped, &damping),
    ];
    let panels = panels.map(|(kind, caption, size, values)| {
        let axis = Axis::new("change of growth, first order", "1/s").symmetric();
        let values: Vec<f64> = values.iter().map(|value| size * value).collect();
        let candidates = summary.candidates.iter().filter(|own| own.kind == kind);
        let places: Vec<(f64, f64)> =
            candidates.map(|own| (own.position_m[0], own.position_m[1])).collect();
        let panel = match mesh.dimension {
            2 => {
                let disc = Disc::new(mesh);
                let field = disc.field(values, axis, ColourMap::Diverging);
                let circles = (!places.is_empty())
                    .then(|| Points::new(places).marker(Marker::Circle, 3.0, INK));
                disc.panel(0.03).layer(field).layers(circles)
            }
            _ => SolidView::new(mesh).panel(&values, axis, ColourMap::Diverging, 0.04),
        };
        panel.caption(caption).height(150.0).colour_bar(Side::Right)
    });
    let caption = format!(
        "Change of the growth rate of mode {} ({:.1} Hz) at friction {} by a modification at each \
         place, to first order. Blue damps the mode, red feeds it; circles are the candidates.",
        own.mode.mode, own.mode.frequency_hz, summary.friction_coefficient
    );
    let name = format!("improve-mode-{}", own.mode.mode);
    Figure::new(name, caption).columns(2).panels(panels)
}

/// Means at the nodes of values in the elements around them.
fn nodal(mesh: &Mesh, values: &[f64]) -> Vec<f64> {
    let mut sums = vec![[0.0; 2]; mesh.node_count()];
    for (element, value) in values.iter().enumerate() {
        for &node in mesh.element_nodes(element) {
            sums[node as usize][0] += value;
            sums[node as usize][1] += 1.0;
        }
    }
    sums.into_iter().map(|[sum, count]: [f64; 2]| sum / count.max(1.0)).collect()
}
