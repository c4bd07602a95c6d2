//! Models of the eigenvalue solvers, and the choice of the solver for a body.

use super::Solution;
use crate::*;
use frictionsim_physics::cea::cyclic;

/// The eigenvalue solver that a body gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// The harmonics of a body of equal sectors: a plane annulus, or a body of revolution.
    Waves,
    /// The whole mesh of a plane body, or of solid bodies.
    WholeMesh,
}

impl Solver {
    /// The solver that `method` means for the body of a case: `auto` uses the rotational symmetry, where it has one.
    ///
    /// # Errors
    /// A method that the body does not have; a counterface at rest, on which the body sticks.
    pub fn of(case: &Case, method: CeaMethod) -> Result<Self, CaseErrors> {
        refuse_rest(case)?;
        match (&case.body.kind, method) {
            (BodyKind::Imported(_) | BodyKind::Assembly(_), CeaMethod::Cyclic)
                if !case.body.is_of_sectors() =>
            {
                Err(refusal!(case, "cea.method",
                    "cea.method = \"cyclic\" needs a body of equal sectors";
                    "the mesh file has the whole body";
                    "give a mesh of one sector with mesh.sectors, or use \"auto\" or \"sparse\""))
            }
            (BodyKind::Annulus(_), CeaMethod::Sparse) => Ok(Self::WholeMesh),
            _ if case.body.has_sectors() => Ok(Self::Waves),
            _ => Ok(Self::WholeMesh),
        }
    }

    /// [`Self::of`] for an analysis.
    ///
    /// # Errors
    /// As [`Self::of`]; counts of modes where the argument principle does not apply.
    pub fn of_analysis(case: &Case, cea: &Cea) -> Result<Self, CaseErrors> {
        let solver = Self::of(case, cea.method)?;
        match case.body.tables().next() {
            Some(table) if cea.count_modes => Err(refusal!(case, "cea.count_modes",
                "cea.count_modes = true: {} is a table over frequency, and no analytic function \
                 of the eigenvalue", table.key;
                "modes cannot be counted"; "leave it out, or give the material one modulus")),
            _ => Ok(solver),
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
    let (key, why) = match case.speed_key() {
        none if none == "motion" => ("contacts".to_owned(), "no [motion.*] moves a body".into()),
        key => (key.clone(), format!("{key} = 0")),
    };
    Err(refusal!(case, &key,
        "{why}: the contact sticks at rest, and there is no steady sliding whose eigenvalues could be solved";
        "must not be zero for an eigenvalue analysis";
        "give a speed, however small; its sign is the sense of the sliding"))
}

/// A model whose spectrum can be asked for.
pub enum Model {
    /// The harmonics of a body of equal sectors.
    Waves(TangentOptions),
    /// The whole mesh of a plane body, or of solid bodies.
    Whole(Box<WholeMesh>),
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
        })
    }

    /// The spectrum at the friction coefficients that the model was made for.
    pub fn spectrum(&self, case: &Case, request: &SweepRequest<'_>) -> Result<Solution, CeaError> {
        Ok(self.spectrum_with_waves(case, (request, &[]), &Unwatched)?.0)
    }

    /// [`Self::spectrum`] that keeps the waves of one sector at some of the friction coefficients, beside what else the
    /// symmetry of sectors reveals, where there are sectors; `progress` hears of every friction coefficient solved.
    pub fn spectrum_with_waves(
        &self,
        case: &Case,
        (request, waves_at): (&SweepRequest<'_>, &[f64]),
        progress: &dyn SweepWatch,
    ) -> Result<(Solution, Option<WaveSweep>), CeaError> {
        match self {
            Self::Waves(options) => {
                let tangent = wave_tangent(case, options)?.expect("a body of sectors");
                let mut found = cyclic::wave_sweep(tangent, request, waves_at)?;
                let is_reduced = found.reduction_error > 0.0;
                let notes = is_reduced.then(|| reduction_note(&found, request));
                let solution = Solution {
                    sweep: std::mem::take(&mut found.sweep),
                    dofs: found.dofs,
                    notes: notes.into_iter().collect(),
                    method: "cyclic",
                    ..Solution::default()
                };
                Ok((solution, Some(found)))
            }
            Self::Whole(whole) => Ok((whole.sweep(case, request, progress)?, None)),
        }
    }
}

/// The linearisation of a body that is solved harmonic by harmonic; `None` of one that has no sectors.
///
/// # Errors
/// A sector that cannot be built; no state of steady sliding.
pub fn wave_tangent(
    case: &Case,
    options: &TangentOptions,
) -> Result<Option<WaveTangent>, CeaError> {
    let (sliding, materials) = (&case.contact.sliding, &case.body.materials);
    Ok(Some(match &case.body.kind {
        BodyKind::Annulus(own) => {
            WaveTangent::of_annulus(&Strip::of_annulus(own)?, materials, options, sliding)?
        }
        BodyKind::Revolution(own) => {
            WaveTangent::of_revolution(&SolidSector::generate(own)?, materials, options, sliding)?
        }
        BodyKind::Imported(_) | BodyKind::Assembly(_) => return Ok(None),
    }))
}

/// What the reduction of the harmonics leaves out.
fn reduction_note(found: &WaveSweep, request: &SweepRequest<'_>) -> String {
    let frictions = request.friction_coefficients.iter();
    format!(
        "each harmonic is solved in a small space (residuals are those there): relative error of an eigenvalue up to \
        {:.1e}, estimated at friction {}",
        found.reduction_error,
        frictions.fold(0.0_f64, |m, &mu| m.max(mu)),
    )
}

/// The modes of the case's own eigenvalue analysis, else so many of the lowest.
pub fn asked_modes(case: &Case, otherwise: usize) -> ModeLimit {
    case.cea.as_ref().map_or(ModeLimit::Lowest(otherwise), |cea| cea.modes)
}
