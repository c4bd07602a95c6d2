//! What there is to improve: the unstable modes of a case with their left and right vectors.

use crate::*;
use frictionsim_physics::cea::sparse::{ModePair, mode_pairs};
use frictionsim_physics::fem::{RotationFrame, element_supports};
use frictionsim_results::improve::{State, TargetMode};

/// Steps of friction from 0 to that of the case, over which branches are followed.
pub(super) const STEPS: usize = 4;

/// Distance beyond the highest mode, relative to it, up to which modes before and after a change are listed.
pub(super) const REACH: f64 = 1.02;

/// A mode with its vectors over the unknowns and over all dofs.
pub(super) struct PairedMode {
    /// Vectors over the unknowns.
    pub pair: ModePair,
    /// Displacement of every dof.
    pub right: Vec<c64>,
    /// What a change of a body's matrix over all dofs is seen by, see [`SlidingTangent::left_displacement`].
    pub left: Vec<c64>,
}

impl PairedMode {
    /// `lambda`.
    pub fn eigenvalue(&self) -> c64 {
        self.pair.eigenvalue
    }
}

/// The frequencies of the modes that are to be silenced, Hz.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window(pub [f64; 2]);

impl Window {
    /// Whether a mode is one of them.
    pub fn holds(&self, eigenvalue: c64) -> bool {
        let frequency = eigenvalue.im / TAU;
        (self.0[0]..=self.0[1]).contains(&frequency)
    }

    /// What some modes come to; their critical friction is left open.
    pub fn outlook(&self, modes: impl IntoIterator<Item = c64>) -> State {
        let (own, others): (Vec<c64>, Vec<c64>) =
            modes.into_iter().partition(|mode| self.holds(*mode));
        let count = |modes: &[c64]| modes.iter().filter(|mode| mode.re > 0.0).count();
        let (worst, beside) = (fastest(&own), fastest(&others).filter(|mode| mode.re > 0.0));
        State {
            growth_rate_per_s: worst.map(|mode| mode.re),
            frequency_hz: worst.map(|mode| mode.im / TAU),
            critical_friction: None,
            unstable: count(&own),
            unstable_beside: count(&others),
            beside_hz: beside.map(|mode| mode.im / TAU),
        }
    }
}

/// The mode that grows fastest, or decays slowest.
fn fastest<'m>(modes: impl IntoIterator<Item = &'m c64>) -> Option<c64> {
    modes.into_iter().copied().max_by(|a, b| a.re.total_cmp(&b.re))
}

/// The model of a case over its whole mesh, at its own friction coefficient.
pub(super) struct Base<'a> {
    pub case: &'a Case,
    pub mesh: Arc<Mesh>,
    pub options: TangentOptions,
    pub tangent: SlidingTangent,
    /// The case's own friction coefficient.
    pub friction: f64,
    /// Displacement of the base state there, with which elements have a geometric stiffness; none where they have none.
    pub displacement: Option<Vec<f64>>,
    /// Coriolis and centrifugal terms of a unit mass where the frame turns with the bodies, else zero.
    pub turning: [Matrix3<f64>; 2],
    /// Springs and dashpots of supports on the faces of each element.
    pub supports: BTreeMap<u32, [Triplets; 2]>,
    pub window: Window,
    /// Which modes are listed, of the case as of its changes.
    pub reach: ModeLimit,
    /// Eigenvalues of all listed modes, by frequency.
    pub listed: Vec<c64>,
    /// Those of them that have vectors.
    pub modes: Vec<PairedMode>,
    /// What they come to, with the lowest critical friction coefficient of a mode in the window.
    pub state: State,
}

/// The model and the spectrum of a case over its whole mesh, in so many of [`STEPS`] up to the friction of the case.
pub(super) fn spectrum_of(
    case: &Case,
    mass: MassKind,
    modes: ModeLimit,
    steps: usize,
) -> Result<(WholeMesh, FrictionSweep), CeaError> {
    let own = case.contact.sliding.friction_coefficient;
    let steps = STEPS - steps..=STEPS;
    let frictions: Vec<f64> = steps.map(|i| own * i as f64 / STEPS as f64).collect();
    let whole = WholeMesh::solve(case, tangent_options(case, mass), &frictions)?;
    let request = SweepRequest::new(&frictions, modes);
    let sweep = whole.sweep(case, &request, &Unwatched)?.sweep;
    Ok((whole, sweep))
}

/// What a case is to list with and without a change: as many modes would be others, some of which may grow as it is.
fn reach(case: &Case, cea: &Cea) -> Result<ModeLimit, CeaError> {
    let ModeLimit::Lowest(_) = cea.modes else { return Ok(cea.modes) };
    let (_, sweep) = spectrum_of(case, cea.mass, cea.modes, 0)?;
    let modes = sweep.modes_at(case.contact.sliding.friction_coefficient).iter();
    let highest = modes.map(|mode| mode.eigenvalue.im).fold(0.0, f64::max);
    Ok(ModeLimit::MaxFrequency(REACH * highest / TAU))
}

/// The lowest critical friction coefficient of a mode in a window.
pub(super) fn lowest_onset(sweep: &FrictionSweep, window: Window) -> Option<f64> {
    let intervals = sweep.intervals.iter();
    let own = intervals.filter(|own| window.holds(c64::new(0.0, TAU * own.frequency_hz)));
    own.map(|own| own.critical_friction).min_by(f64::total_cmp)
}

impl<'a> Base<'a> {
    /// Solves the modes of a case over friction, and the vectors of those at its own.
    pub fn solve(case: &'a Case, cea: &Cea) -> Result<Self, StudyError> {
        refuse_bodies(case)?;
        let friction = case.contact.sliding.friction_coefficient;
        let window = Window(case.improve.frequencies_hz);
        let reach = reach(case, cea)?;
        let (whole, sweep) = spectrum_of(case, cea.mass, reach, STEPS)?;
        let own = sweep.modes_at(friction).iter();
        let targets: Vec<c64> = own.map(|mode| mode.eigenvalue).collect();
        let outlook = window.outlook(targets.iter().copied());
        if outlook.unstable == 0 {
            return Err(nothing_grows(case, outlook.unstable_beside, window).into());
        }

        // Left and right vectors of all listed modes.
        let tangent = whole.own_tangent(case)?;
        let pairs = mode_pairs(&tangent, friction, &targets);
        let modes = pairs.into_iter().flatten().map(|pair| PairedMode {
            right: tangent.displacement(&pair.right),
            left: tangent.left_displacement(&pair.left, friction),
            pair,
        });
        let is_stressed = whole.options.geometric_stiffness;
        let stressing = whole.assembly(case).stressing(whole.state()).filter(|_| is_stressed);
        let spin = case.body.assembly().and_then(|body| body.motions.first()?.spin());
        let spin = spin.filter(|own| own.frame == RotationFrame::Turning);
        Ok(Self {
            turning: spin.map_or([Matrix3::zeros(); 2], |own| own.of_mass(1.0)),
            supports: element_supports(&whole.mesh),
            displacement: stressing.map(|state| state.displacement(friction)),
            mesh: whole.mesh,
            options: whole.options,
            state: State { critical_friction: lowest_onset(&sweep, window), ..outlook },
            case,
            modes: modes.collect(),
            tangent,
            friction,
            window,
            reach,
            listed: targets,
        })
    }

    /// Places of the dofs that are unknowns.
    pub fn free(&self, dofs: &[usize]) -> Vec<usize> {
        let unknown_of = &self.tangent.unknowns.unknown_of;
        (0..dofs.len()).filter(|&i| unknown_of[dofs[i]].is_some()).collect()
    }

    /// The modes that are to be silenced.
    pub fn targets(&self) -> Vec<&PairedMode> {
        let modes = self.modes.iter();
        let grows =
            |mode: &&PairedMode| self.window.holds(mode.eigenvalue()) && mode.eigenvalue().re > 0.0;
        modes.filter(grows).collect()
    }
}

/// The modes that are to be silenced, numbered as `cea` numbers them.
pub(super) fn target_modes(base: &Base<'_>) -> Vec<TargetMode> {
    let number = |mode: &PairedMode| {
        1 + base.listed.iter().filter(|other| other.im < mode.eigenvalue().im).count()
    };
    let target = |mode: &PairedMode| TargetMode {
        mode: number(mode),
        frequency_hz: mode.eigenvalue().im / TAU,
        growth_rate_per_s: mode.eigenvalue().re,
    };
    base.targets().into_iter().map(target).collect()
}

/// Bodies whose changes break the symmetry that they are solved by, and damping without linear derivatives.
pub(crate) fn refuse_bodies(case: &Case) -> Result<(), CaseErrors> {
    if case.has_structural_damping() {
        return Err(case.loss_error(
            "improve takes derivatives of conjugate pairs of modes, which structural damping K (1 \
            + i eta) does not leave",
            "not in improve",
            "set it to 0 and give the damping by damping.stiffness_coefficient: beta = eta / omega \
            at the frequency of the mode",
        ));
    }
    match case.body.annulus() {
        Some(annulus) if annulus.shaft.is_some() => {
            Err(refusal!(case, "geometry.shaft_inner_radius",
                "improve adds to, or takes from, one place of a body, which breaks the symmetry \
                 that disc and shaft are solved by";
                "a deformable shaft"; "give both bodies as a mesh file (mesh.file)"))
        }
        _ => Ok(()),
    }
}

/// No mode of the window grows.
fn nothing_grows(case: &Case, beside: usize, window: Window) -> CaseErrors {
    let friction = case.contact.sliding.friction_coefficient;
    let [low, high] = window.0;
    let place = match (low > 0.0, high.is_finite()) {
        (false, false) => "of [cea]".to_owned(),
        (true, false) => format!("above {low} Hz"),
        (false, true) => format!("below {high} Hz"),
        (true, true) => format!("from {low} to {high} Hz"),
    };
    let beside = match beside {
        0 => String::new(),
        count => format!("; {count} beside these frequencies do"),
    };
    refusal!(case, &case.contact_key("friction_coefficient"),
        "no mode {place} grows at friction {friction}: there is nothing to improve{beside}";
        "every mode decays";
        "raise the friction coefficient above the lowest critical one that `cea` prints, or widen \
         improve.min_frequency_hz and max_frequency_hz")
}
