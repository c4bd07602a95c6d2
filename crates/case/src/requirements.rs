//! Sections that an analysis needs, and bodies and laws that it does not take. A `require_` refuses a case without its
//! section and says what to add.

use super::checks::material_key;
use super::value::table_of;
use super::{Analysis, Cea, Convergence, Fit, Frf, Sweep, Uncertainty};
use crate::*;

impl Case {
    /// Whether it has the section of an analysis.
    pub fn has(&self, analysis: Analysis) -> bool {
        match analysis {
            Analysis::Transient => self.transient.is_some(),
            Analysis::Cea => self.cea.is_some(),
            Analysis::Cycle => self.cycle.is_some(),
            Analysis::Basin => self.basin.is_some(),
        }
    }

    /// The complex eigenvalue analysis.
    pub fn require_cea(&self) -> Result<&Cea, CaseErrors> {
        let remedy = "[cea]\nmax_frequency_hz = 17500.0";
        self.required(&self.cea, "cea", "complex eigenvalue analysis", remedy)
    }

    /// The two waves that compete.
    ///
    /// # Errors
    /// A case without `[basin]`, a body that the transient cannot step, and keys of another kind of body.
    pub fn require_basin(&self) -> Result<&frictionsim_physics::cycle::BasinRequest, CaseErrors> {
        self.refuse_losses_in_time("the search for a basin")?;
        self.refuse_what_has_no_cycle()?;
        let found = self.required(&self.basin, "basin", "search for a basin", "[basin]")?;
        // Each kind of body has keys of its own.
        let (key, why, remedy) = match self.has_rotating_waves() {
            true => {
                ("basin.modes", "disc are rotating waves", "name two of them by basin.harmonics")
            }
            false => (
                "basin.harmonics",
                "body are motions of the whole mesh, born from its modes",
                "name one or two modes by basin.modes, as `cycle` numbers them",
            ),
        };
        match self.raw.find(key) {
            None => Ok(found),
            Some(_) => Err(refusal!(self, key,
                "{key} is not used: the limit cycles of this {why}"; "not used"; "{remedy}")),
        }
    }

    /// A body that the explicit transient can step; `plane` and `solid` say who needs linear elements of it.
    pub(super) fn require_steps(&self, plane: &str, solid: &str) -> Result<(), CaseErrors> {
        let label = match &self.body.kind {
            BodyKind::Annulus(_) => plane,
            BodyKind::Revolution(_) => solid,
            BodyKind::Imported(_) => return Ok(()),
            BodyKind::Assembly(own) if own.base == BaseChoice::Closed => {
                return Err(refusal!(self, "contacts",
                    "contacts with state = \"closed\" are free of stress: without a normal force there \
                     is no friction to step in time"; "steps in time need state = \"solved\"";
                    "press the bodies together (condition = \"pressure\"), or leave `state` out"));
            }
            BodyKind::Assembly(own) if own.motions.iter().any(|own| own.inertia.is_some()) => {
                return Err(refusal!(self, "motion",
                    "rotation_terms are not stepped in time: the gyroscopic forces of the last half \
                     step would feed the motion"; "with rotation_terms = false";
                    "use `frictionsim cea`, or leave rotation_terms out"));
            }
            BodyKind::Assembly(_) => return Ok(()),
        };
        if !self.body.is_quadratic() {
            return Ok(());
        }
        Err(refusal!(self, "mesh.element",
            "mesh.element = \"quad8\" is for the complex eigenvalue analysis only"; "{label}";
            "add --set mesh.element=quad4, and refine the mesh if need be"))
    }

    /// The parameter study.
    pub fn require_sweep(&self) -> Result<&Sweep, CaseErrors> {
        let key = self.contact_key("friction_coefficient");
        let remedy = format!("[sweep]\n{key} = [0.2, 0.3, 0.4]");
        self.required(&self.sweep, "sweep", "parameter study", &remedy)
    }

    /// The frequency response.
    pub fn require_frf(&self) -> Result<&Frf, CaseErrors> {
        let remedy =
            "[frf]\nforce_node = 36\nfrequencies_hz = { from = 1.0, to = 10000.0, count = 10000 }";
        self.required(&self.frf, "frf", "frequency response", remedy)
    }

    /// The convergence study.
    pub fn require_convergence(&self) -> Result<&Convergence, CaseErrors> {
        self.required(&self.convergence, "convergence", "convergence study", "[convergence]")
    }

    /// The parameters to fit.
    pub fn require_fit(&self) -> Result<&Fit, CaseErrors> {
        let key = material_key(self, "poisson_ratio");
        let remedy = format!("[fit.parameters]\n{key} = [0.2, 0.45]");
        self.required(&self.fit, "fit", "parameter to fit", &remedy)
    }

    /// The parameters that are uncertain.
    pub fn require_uncertainty(&self) -> Result<&Uncertainty, CaseErrors> {
        let key = self.contact_key("friction_coefficient");
        let remedy = format!("[uncertainty.distributions]\n{key} = {{ log_normal = [0.3, 0.1] }}");
        self.required(&self.uncertainty, "uncertainty", "uncertain parameter", &remedy)
    }

    /// The plane annulus, which alone has rotating waves.
    ///
    /// # Errors
    /// A body from a mesh file, and one in three dimensions.
    pub fn require_annulus(&self) -> Result<&AnnulusSpecification, CaseErrors> {
        match &self.body.kind {
            BodyKind::Annulus(annulus) => Ok(annulus),
            BodyKind::Revolution(_) | BodyKind::Assembly(_) => {
                Err(refusal!(self, "material.formulation",
                "material.formulation = \"three-dimensional\": limit cycles are sought in plane bodies only";
                "a three-dimensional body";
                "`cea`, `transient`, `cycle`, `basin`, `frf`, `sweep` and `convergence` take it; \
                 else use \"plane-stress\" or \"plane-strain\""))
            }
            BodyKind::Imported(_) => Err(refusal!(self, "mesh.file",
                "limit cycles are rotating waves, which need the rotational symmetry of the built-in annulus";
                "an imported mesh has no sectors";
                "describe the disc by [geometry] and element counts instead of mesh.file")),
        }
    }

    /// An error at the first loss factor of the case.
    pub fn loss_error(&self, message: &str, label: &str, help: &str) -> CaseErrors {
        let keys = |section: &str| -> Vec<String> {
            let names = table_of(&self.raw.root, section).into_iter().flatten();
            names.map(|(name, _)| format!("{section}.{name}.loss_factor")).collect()
        };
        let shared = ["material.loss_factor", "contact.loss_factor"].map(str::to_owned);
        let own = ["materials", "boundaries", "contacts"].map(keys);
        let mut keys = shared.into_iter().chain(own.into_iter().flatten());
        let is_lossy = |key: &String| self.number(key).is_some_and(|value| value > 0.0);
        let key = keys.find(is_lossy);
        let key = key.or_else(|| self.body.tables().next().map(|table| table.key.clone()));
        let key = key.unwrap_or_else(|| "material.loss_factor".to_owned());
        refusal!(self, &key, "{key}: {message}"; "{label}"; "{help}")
    }

    /// Refuses structural damping in an analysis over time.
    pub(super) fn refuse_losses_in_time(&self, what: &str) -> Result<(), CaseErrors> {
        if !self.has_structural_damping() {
            return Ok(());
        }
        Err(self.loss_error(
            &format!(
                "{what} is over time, and a stiffness K (1 + i eta) belongs to one frequency: in \
                time it would act before its cause"
            ),
            "for `cea` and `frf`",
            "use damping.stiffness_coefficient = eta / (2 pi f), which loses as much at the \
            frequency f, and set loss_factor = 0",
        ))
    }

    /// What a section says; an error with what to add where there is none.
    pub(super) fn required<'a, T>(
        &self,
        own: &'a Option<T>,
        section: &str,
        analysis: &str,
        remedy: &str,
    ) -> Result<&'a T, CaseErrors> {
        own.as_ref().ok_or_else(|| {
            self.raw.errors(vec![placed!(self.raw.end(),
                "the case has no [{section}] section, so it asks for no {analysis}";
                "the case ends here"; "add\n{remedy}")])
        })
    }
}
