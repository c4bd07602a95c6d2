//! Start of a run: from rest, from given fields, or from where another one stopped.

use super::{CentralDifference, EnergyAccount, StepSums, TransientState};
use crate::contact::SlidingContact;
use crate::fem::operator::{
    AlignedVector, MotionFields, StepCoefficients, StiffnessOperator, scatter,
};
use crate::linalg::dense::add;
use crate::transient::{InitialState, TransientError, TransientModel, TransientSettings};

impl<'a> CentralDifference<'a> {
    /// A run from its initial state.
    ///
    /// # Errors
    /// [`TransientError`] names the setting that does not fit, with its bound;
    /// [`TransientError::FieldsMissing`] for a limit cycle, which [`Self::start_from`] takes.
    pub fn start(
        model: TransientModel<'a>,
        operator: &'a dyn StiffnessOperator,
        settings: &TransientSettings,
    ) -> Result<Self, TransientError> {
        let still = vec![0.0; operator.dof_count()];
        let displacement = match settings.initial {
            InitialState::Rest => still.clone(),
            InitialState::SteadySliding => model.sliding_displacement()?,
            InitialState::LimitCycle { harmonic, .. } => {
                Err(TransientError::FieldsMissing(harmonic))?
            }
        };
        Self::start_from(model, operator, settings, &displacement, still)
    }

    /// A run from given fields, `u_0` (m) and `v_{-1/2}` (m/s) over all dofs in nodal frames; a perturbation at the
    /// start is added to the velocity.
    ///
    /// # Errors
    /// [`TransientError`] names the setting that does not fit, with its bound; [`TransientError::ForeignState`] for fields of another size.
    pub fn start_from(
        model: TransientModel<'a>,
        operator: &'a dyn StiffnessOperator,
        settings: &TransientSettings,
        displacement: &[f64],
        mut velocity: Vec<f64>,
    ) -> Result<Self, TransientError> {
        let fields = [displacement, &velocity];
        let mut run = Self::new(model, operator, settings, &fields)?;
        if let Some((_, added)) = run.kick.take_if(|(step, _)| *step == 0) {
            add(&mut velocity, 1.0, &added);
        }
        run.fields.displacement = scatter(operator, displacement);
        run.fields.velocity = scatter(operator, &velocity);
        run.open_account();
        Ok(run)
    }

    /// A run that goes on from a saved state, bit by bit as if it had never stopped.
    ///
    /// # Errors
    /// As [`Self::start`], and [`TransientError::ForeignState`] for a state of another size.
    pub fn resume(
        model: TransientModel<'a>,
        operator: &'a dyn StiffnessOperator,
        settings: &TransientSettings,
        state: &TransientState,
    ) -> Result<Self, TransientError> {
        let TransientState { displacement, velocity, elastic, elastic_rate, .. } = state;
        let fields = [displacement, velocity, elastic, elastic_rate].map(Vec::as_slice);
        let mut run = Self::new(model, operator, settings, &fields)?;
        // What was added at the start is in the state.
        run.kick.take_if(|(step, _)| *step == 0);
        let [displacement, velocity, elastic, elastic_rate] =
            fields.map(|field| scatter(operator, field));
        run.fields = MotionFields { displacement, velocity, elastic, elastic_rate };
        run.relaxation.restore(&state.relaxation)?;
        run.next_step = state.step;
        run.account = state.account;
        Ok(run)
    }

    /// Starts anew with another time step, from the displacement `u_0` and the velocity `v_{-1/2}` that `place` writes into
    /// the fields of the operator's layout; a perturbation is not added again.
    ///
    /// The step is the caller's to keep below the limit of [`Self::plan`]. Nothing else of the body is set up again: for those
    /// who step many short runs of one body.
    pub fn restart(&mut self, time_step: f64, place: impl FnOnce(&mut MotionFields)) {
        debug_assert!(time_step > 0.0 && time_step <= self.plan.limit);
        (self.plan.time_step, self.coefficients.time_step) = (time_step, time_step);
        (self.kick, self.next_step) = (None, 0);
        place(&mut self.fields);
        self.take_sums();
        self.open_account();
    }

    /// Another contact for the same body: friction law, speed and interference, of an assembly the friction of its first contact, to which
    /// the others keep their ratio; for those who step one body at many operating points. What it touches with stays what it is.
    ///
    /// # Errors
    /// [`TransientError::Prestress`] where the springs of a compliant contact have no base state.
    pub fn retune(&mut self, contact: SlidingContact) -> Result<(), TransientError> {
        if self.model.contact == contact {
            return Ok(());
        }
        self.model.contact = contact;
        self.contact = self.model.lagrange_contact(self.operator, &self.interface)?;
        Ok(())
    }

    /// A run at rest that is to start from `fields` over all dofs.
    fn new(
        model: TransientModel<'a>,
        operator: &'a dyn StiffnessOperator,
        settings: &TransientSettings,
        fields: &[&[f64]],
    ) -> Result<Self, TransientError> {
        let plan = model.plan(operator, settings)?;
        let expected = operator.dof_count();
        if let Some(found) = fields.iter().map(|field| field.len()).find(|&own| own != expected) {
            return Err(TransientError::ForeignState { found, expected });
        }
        let interface = model.interface();
        let zeros = || AlignedVector::zeros(operator.field_length());
        let kicked = (settings.perturbation.time / plan.time_step).round() as u64;
        let kick = (kicked, model.perturbed(&settings.perturbation)?);
        Ok(Self {
            coefficients: StepCoefficients::of(&model.damping, plan.time_step),
            fields: MotionFields::zeros(operator.field_length()),
            contact: model.lagrange_contact(operator, &interface)?,
            boundary: model.boundary_forces(operator),
            relaxation: model.relaxation(operator),
            interface,
            next_step: 0,
            account: EnergyAccount::default(),
            sums: StepSums::default(),
            displacement_before: zeros(),
            velocity_before: zeros(),
            model,
            operator,
            plan,
            expansion_time: settings.ramp_time(),
            kick: Some(kick),
            perturbation: settings.perturbation.clone(),
        })
    }
}
