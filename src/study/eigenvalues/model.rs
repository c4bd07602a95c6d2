//! Models of the eigenvalue solvers, and the choice of the solver for a body.

use super::assembly::{self, AssemblyModel};
use super::states::{StatesSweep, WholeMesh};
use super::{Progress, StudyError};
use crate::case::{
    Annulus, Body, Case, CaseErrors, Cea, CeaMethod, ModeSelection, Revolution, refusal,
};
use crate::cea::cyclic::{self, Coverage, Overdamped, WaveSweep};
use crate::cea::{CeaError, FrictionSweep, ModeBranch, ModeLimit, SweepRequest};
use crate::mesh::{SectorMesh, SolidSector};
use crate::prestress::{SlidingTangent, TangentOptions, WaveTangent};
use crate::study::tangent_options;

/// The eigenvalue solver that a body gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// The harmonics of a body of equal sectors: a plane annulus, or a body of revolution.
    Waves,
    /// The whole mesh of a plane body.
    WholeMesh,
    /// The whole mesh of solid bodies.
    Assembly,
}

impl Solver {
    /// The solver that `method` means for the body of a case: `auto` uses the rotational symmetry where the body has
    /// it.
    ///
    /// # Errors
    /// A method that the body does not have; a counterface at rest, on which the body sticks.
    pub fn of(case: &Case, method: CeaMethod) -> Result<Self, CaseErrors> {
        refuse_rest(case)?;
        match (&case.body, method) {
            (Body::Imported(_) | Body::Assembly(_), CeaMethod::Cyclic)
                if !case.body.is_of_sectors() =>
            {
                Err(refusal!(case, "cea.method",
                    "cea.method = \"cyclic\" needs a body of equal sectors";
                    "the mesh file has the whole body";
                    "give a mesh of one sector with mesh.sectors, or use \"auto\" or \"sparse\""))
            }
            (Body::Annulus(_), CeaMethod::Sparse) => Ok(Self::WholeMesh),
            (_, _) => Ok(Self::by_symmetry(case)),
        }
    }

    /// [`Self::of`] for an analysis.
    ///
    /// # Errors
    /// As [`Self::of`]; counts of modes where the argument principle does not apply.
    pub fn of_analysis(case: &Case, cea: &Cea) -> Result<Self, CaseErrors> {
        let solver = Self::of(case, cea.method)?;
        let mut tables = (0..case.body.region_count()).filter_map(|r| case.materials().table(r));
        match tables.next() {
            Some(table) if cea.count_modes => Err(refusal!(case, "cea.count_modes",
                "cea.count_modes = true: {} is a table over frequency, and no analytic function \
                 of the eigenvalue", table.key();
                "modes cannot be counted"; "leave it out, or give the material one modulus")),
            _ => Ok(solver),
        }
    }

    /// The solver that uses all the symmetry of the body of a case.
    pub fn by_symmetry(case: &Case) -> Self {
        match &case.body {
            Body::Annulus(_) | Body::Revolution(_) => Self::Waves,
            Body::Imported(_) => Self::WholeMesh,
            Body::Assembly(_) => Self::Assembly,
        }
    }
}

/// Refuses a counterface at rest: a contact that sticks has no modes of sliding.
fn refuse_rest(case: &Case) -> Result<(), CaseErrors> {
    let has_contact = case.body.assembly().is_none_or(|body| !body.contacts.is_empty());
    // Bodies that touch nothing have modes whether they turn or not.
    if case.contact.sliding.rotation_speed != 0.0 || !has_contact {
        return Ok(());
    }
    let key = case.speed_key();
    Err(refusal!(case, &key,
        "{key} = 0: the contact sticks at rest, and there is no steady sliding whose eigenvalues \
         could be solved";
        "must not be zero for an eigenvalue analysis";
        "give a speed, however small; its sign is the sense of the sliding"))
}

/// A model whose spectrum can be asked for.
pub enum Model {
    /// The harmonics of a body of equal sectors.
    Waves(TangentOptions),
    /// The whole mesh of a plane body.
    Whole(Box<WholeMesh>),
    /// The whole mesh of solid bodies.
    Assembly(Box<AssemblyModel>),
}

/// The branches of a body that is solved harmonic by harmonic, and what their waves belong to.
pub struct Waves {
    /// The linearisation of a sector.
    pub tangent: WaveTangent,
    /// The branches of all modes that occur in the sweep.
    pub branches: Vec<ModeBranch>,
}

/// The spectrum of a model over friction coefficients.
pub struct Spectrum {
    /// Modes at each of them, and where branches turn unstable.
    pub sweep: FrictionSweep,
    /// Unknowns of the eigenproblem.
    pub dofs: usize,
    /// What the solver has to say of the spectrum.
    pub notes: Vec<String>,
    /// Which harmonics were solved, of a body that has them.
    pub coverage: Option<Coverage>,
    /// Motions of a body of revolution that decay without oscillating, at each friction coefficient; none elsewhere.
    pub overdamped: Vec<Overdamped>,
    /// The branches with what they belong to; none of a body solved on its whole mesh.
    pub waves: Option<Waves>,
    /// Whether a body made of one sector was solved by waves around it.
    pub is_by_diameters: bool,
}

/// The spectrum of a body that was swept over its base states, with notes of its own.
fn spectrum_of(found: StatesSweep, mut notes: Vec<String>) -> Spectrum {
    let why = found.asymmetry.map(|why| {
        format!("the whole mesh was solved, not waves around it one number of nodal diameters after the other: {why}")
    });
    notes.extend(why);
    notes.extend(found.notes);
    Spectrum {
        dofs: found.dofs,
        notes,
        coverage: None,
        overdamped: Vec::new(),
        sweep: found.sweep,
        waves: None,
        is_by_diameters: found.is_by_diameters,
    }
}

/// The spectrum of a body that was solved harmonic by harmonic.
fn spectrum_of_waves(found: WaveSweep, notes: Vec<String>) -> Spectrum {
    Spectrum {
        dofs: found.dofs,
        notes,
        coverage: Some(found.coverage),
        overdamped: found.overdamped,
        sweep: found.sweep,
        waves: Some(Waves { tangent: found.tangent, branches: found.branches }),
        is_by_diameters: false,
    }
}

impl Model {
    /// The model of a case for its eigenvalue analysis.
    ///
    /// # Errors
    /// A method that the body does not have; those of [`Self::with_solver`].
    pub fn new(case: &Case, cea: &Cea) -> Result<Self, StudyError> {
        let solver = Solver::of_analysis(case, cea)?;
        let options = tangent_options(case, cea.mass);
        let frictions = cea.solved_friction_coefficients();
        Ok(Self::with_solver(case, solver, options, &frictions)?)
    }

    /// The model of a case for a solver, at some friction coefficients and its own.
    ///
    /// # Errors
    /// No state of steady sliding of a whole mesh; sectors say so when they are solved.
    pub fn with_solver(
        case: &Case,
        solver: Solver,
        options: TangentOptions,
        frictions: &[f64],
    ) -> Result<Self, CeaError> {
        Ok(match solver {
            Solver::Waves => Self::Waves(options),
            Solver::WholeMesh => Self::Whole(Box::new(WholeMesh::solve(case, options, frictions)?)),
            Solver::Assembly => {
                let body = case.body.assembly();
                let body = body.expect("the solver of an assembly is given to one alone");
                Self::Assembly(Box::new(AssemblyModel::solve(case, body, options, frictions)?))
            }
        })
    }

    /// Name of the solver.
    pub fn method(&self) -> &'static str {
        match self {
            Self::Waves(_) => "cyclic",
            Self::Whole(_) | Self::Assembly(_) => "sparse",
        }
    }

    /// The spectrum at the friction coefficients that the model was made for; `progress` hears of every one that is
    /// solved.
    pub fn spectrum(
        &self,
        case: &Case,
        request: &SweepRequest<'_>,
        progress: &Progress<'_>,
    ) -> Result<Spectrum, CeaError> {
        self.spectrum_with_waves(case, (request, &[]), progress)
    }

    /// [`Self::spectrum`] that keeps the waves of one sector at some of the friction coefficients, where there are
    /// sectors.
    pub fn spectrum_with_waves(
        &self,
        case: &Case,
        (request, waves_at): (&SweepRequest<'_>, &[f64]),
        progress: &Progress<'_>,
    ) -> Result<Spectrum, CeaError> {
        match self {
            Self::Waves(_) => {
                let tangent = self.wave_tangent(case)?.expect("a body of sectors has waves");
                let found = cyclic::wave_sweep(tangent, request, waves_at)?;
                let is_reduced = found.reduction_error > 0.0;
                let notes = is_reduced.then(|| reduction_note(&found, request));
                Ok(spectrum_of_waves(found, notes.into_iter().collect()))
            }
            Self::Whole(whole) => {
                let found = whole.sweep(case, request, progress)?;
                Ok(spectrum_of(found, Vec::new()))
            }
            Self::Assembly(model) => {
                let found = model.sweep(request, progress)?;
                Ok(spectrum_of(found, assembly::notes(model)))
            }
        }
    }

    /// The model of a case with the base states of this one, of a body solved on its whole mesh: for a case that
    /// differs in nothing that these depend on.
    pub(super) fn with_its_states(&self, case: &Case, options: TangentOptions) -> Option<Self> {
        match self {
            Self::Whole(whole) => Some(Self::Whole(Box::new(WholeMesh {
                // Its boundaries have supports.
                mesh: case.mesh().ok()?,
                range: whole.range.clone(),
                symmetry: whole.symmetry,
                options,
            }))),
            // A centrifugal load depends on the density.
            Self::Assembly(assembly) if assembly.body.rotors().next().is_some() => None,
            Self::Assembly(assembly) => {
                let body = case.body.assembly()?;
                Some(Self::Assembly(Box::new(AssemblyModel {
                    joined: body.assembled().ok()?.joined(),
                    body: body.clone(),
                    range: assembly.range.clone(),
                    symmetry: assembly.symmetry,
                    options,
                })))
            }
            Self::Waves(_) => None,
        }
    }

    /// How many base states there are over the whole mesh; none of a body solved harmonic by harmonic.
    pub(super) fn state_count(&self) -> usize {
        match self {
            Self::Whole(whole) => whole.range.states.len(),
            Self::Assembly(assembly) => assembly.range.states.len(),
            Self::Waves(_) => 0,
        }
    }

    /// Which of them belongs to each friction coefficient that the model was made for.
    pub(in crate::study) fn state_of(&self) -> &[usize] {
        match self {
            Self::Whole(whole) => &whole.range.state_of,
            Self::Assembly(assembly) => &assembly.range.state_of,
            Self::Waves(_) => &[],
        }
    }

    /// Which contact points are pressed in one of them.
    pub(super) fn pressed(&self, state: usize) -> &[bool] {
        match self {
            Self::Whole(whole) => &whole.range.states[state].is_pressed,
            Self::Assembly(assembly) => &assembly.range.states[state].is_pressed,
            Self::Waves(_) => &[],
        }
    }

    /// The tangent of one of them.
    /// # Panics
    /// Of a body solved harmonic by harmonic, which has none.
    pub(in crate::study) fn tangent(
        &self,
        case: &Case,
        state: usize,
    ) -> Result<SlidingTangent, CeaError> {
        match self {
            Self::Whole(whole) => Ok(whole.tangent(case, &whole.range.states[state])),
            Self::Assembly(assembly) => assembly.tangent(state),
            Self::Waves(_) => panic!("no whole mesh"),
        }
    }

    /// The linearisation of a body solved harmonic by harmonic; `None` of one solved on its whole mesh.
    ///
    /// # Errors
    /// A sector that cannot be built; no state of steady sliding.
    pub fn wave_tangent(&self, case: &Case) -> Result<Option<WaveTangent>, CeaError> {
        let (Self::Waves(options), sliding) = (self, &case.contact.sliding) else {
            return Ok(None);
        };
        Ok(match &case.body {
            Body::Annulus(Annulus { specification, materials }) => {
                let sector = SectorMesh::generate(specification)?;
                Some(WaveTangent::of_annulus(&sector, materials, options, sliding)?)
            }
            Body::Revolution(Revolution { specification, materials }) => {
                let sector = SolidSector::generate(specification)?;
                Some(WaveTangent::of_revolution(&sector, materials, options, sliding)?)
            }
            Body::Imported(_) | Body::Assembly(_) => None,
        })
    }

    /// The spectrum of some harmonics of a plane annulus, without a proof that none is missed; `None` for another body,
    /// and where a branch meets one that only the whole spectrum has.
    pub fn sweep_in(
        &self,
        harmonics: &[usize],
        case: &Case,
        request: &SweepRequest<'_>,
    ) -> Option<FrictionSweep> {
        cyclic::onsets(self.wave_tangent(case).ok()??, request, harmonics).ok().flatten()
    }
}

/// What the reduction of the harmonics leaves out.
fn reduction_note(found: &WaveSweep, request: &SweepRequest<'_>) -> String {
    let frictions = request.friction_coefficients.iter();
    format!(
        "each harmonic is solved in a small space (residuals are those there): relative error of \
        an eigenvalue up to {:.1e}, \
         estimated at friction {}",
        found.reduction_error,
        frictions.fold(0.0_f64, |m, &mu| m.max(mu)),
    )
}

/// The modes that a case asks for.
pub fn mode_limit(cea: &Cea) -> ModeLimit {
    match cea.modes {
        ModeSelection::BelowHz(limit) => ModeLimit::MaxFrequency(limit),
        ModeSelection::Lowest(count) => ModeLimit::Lowest(count),
    }
}

/// The modes of the case's own eigenvalue analysis, else so many of the lowest.
pub fn asked_modes(case: &Case, otherwise: usize) -> ModeLimit {
    case.cea.as_ref().map(mode_limit).unwrap_or(ModeLimit::Lowest(otherwise))
}
