//! Steady sliding, reported beside the modes of an eigenvalue analysis.

use super::contact::{SolidState, contact_of};
use super::model::Model;
use crate::*;
use frictionsim_chart::literal;
use frictionsim_physics::prestress::{PressedState, SectorSliding, SolidSliding};
use frictionsim_results::cea::{BaseField, BaseState, ContactState, NamedDamping};
use frictionsim_results::grouped;

/// Share of the stress where a body alone gives way, or of its modulus, below which a contact pressure is round-off.
const NO_PRESSURE: f64 = 1e-13;

/// A model with its mesh and its steady sliding.
pub struct SlidingModel {
    /// The mesh, of a body in three dimensions that of its section across the axis.
    pub mesh: Arc<Mesh>,
    /// What the solver takes.
    pub model: Model,
    /// The contacts with their points, of a plane body its edge; none of a body of revolution, whose contact is rings.
    contacts: Arc<[(SlidingSurfaces, ContactSurface)]>,
    /// Base state at the case's own friction coefficient, of a body of revolution that of a sector.
    state: PressedState,
    /// The body of revolution in three dimensions, if it is one.
    pub solid: Option<SolidState>,
    /// The contact in the base state.
    pub contact: Vec<ContactState>,
}

impl SlidingModel {
    /// Builds the model of a case up to its base states.
    ///
    /// # Errors
    /// A mesh that cannot be built; contact that would open on an annulus; no state of sliding; a method that needs a
    /// symmetry which is not there.
    pub fn new(case: &Case, cea: &Cea) -> Result<Self, StudyError> {
        let (sliding, materials) = (&case.contact.sliding, &case.body.materials);
        let model = Model::new(case, cea)?;
        let mesh = match &model {
            Model::Whole(whole) => Arc::clone(&whole.mesh),
            Model::Waves(_) => case.body.mesh()?,
        };
        let (mut contacts, mut solid): (Arc<[_]>, _) = ([].into(), None);
        let state = match (&model, &case.body.kind) {
            (Model::Whole(whole), _) => {
                contacts = Arc::clone(&whole.joined.contacts);
                whole.state().clone()
            }
            (Model::Waves(options), BodyKind::Annulus(specification)) => {
                let sector = Strip::of_annulus(specification)?;
                let elastic = sector.stiffness_alike(materials);
                let base = SectorSliding::solve(&sector, &elastic, sliding, options.contact.law)?;
                let edge = SlidingSurfaces::of_edge(&mesh, sliding, options.contact);
                contacts = Arc::new([(edge, ContactSurface::of_edge(&mesh, sliding))]);
                base.repeated(sector.count)
            }
            (Model::Waves(_), BodyKind::Revolution(specification)) => {
                let sector = SolidSector::generate(specification)?;
                let elastic = sector.strip.stiffness_alike(materials);
                let stiffness = &case.contact.stiffness;
                let base = SolidSliding::solve(&sector, &elastic, sliding, stiffness, case.mass())?;
                solid.insert(SolidState { sector, base }).base.sliding.state.clone()
            }
            (Model::Waves(_), BodyKind::Imported(_) | BodyKind::Assembly(_)) => {
                unreachable!("a body of equal sectors has waves")
            }
        };
        let contact = match &solid {
            Some(solid) => solid.contact(sliding.friction_coefficient),
            None => contact_of(case, &mesh, (&contacts, &state)),
        };
        let model = Self { mesh, model, contacts, state, solid, contact };
        model.refuse_no_pressure(case)?;
        Ok(model)
    }

    /// Refuses a contact that nothing presses: friction does nothing there; critical frictions would be those of none.
    fn refuse_no_pressure(&self, case: &Case) -> Result<(), StudyError> {
        let assembly = case.body.assembly();
        let is_free =
            |body: &AssemblyBody| body.base == BaseChoice::Closed || body.contacts.is_empty();
        let largest = self.base_state(case).pressure_pa[1];
        let strain = case.contact.sliding.interference / case.body.size();
        let strain = if strain > 0.0 { strain.min(1.0) } else { 1.0 };
        let least = NO_PRESSURE * strain * case.material.young_modulus;
        if largest > least || assembly.is_some_and(is_free) {
            return Ok(());
        }
        let is_short = case.raw.find("contact").is_some();
        let key = case.contact_key(if is_short { "interference" } else { "surface" });
        let friction = case.contact.sliding.friction_coefficient;
        let message = format!(
            "nothing presses the contact: its pressure is zero everywhere at friction {friction}"
        );
        Err(StudyError::Case(refusal!(case, &key, "{message}"; "no pressure";
                "give an interference above zero, or a boundary with condition = \"pressure\"")))
    }

    /// Friction coefficients at which contact nodes open or close, rising.
    pub fn contact_changes(&self) -> &[f64] {
        if let Model::Whole(whole) = &self.model { &whole.range.changes } else { &[] }
    }

    /// What the report says of the base state, scaled to the case's thickness.
    pub fn base_state(&self, case: &Case) -> BaseState {
        let sliding = &case.contact.sliding;
        let (friction, speed) = (sliding.friction_coefficient, sliding.rotation_speed);
        let contact = || self.contact.iter();
        // Torque, drag, and their power.
        let [torque_n_m, drag_n, power_w] = match (&self.solid, self.mesh.dimension) {
            (Some(solid), _) => {
                let torque = solid.base.torque(&solid.sector, friction);
                [Some(torque), None, Some(torque * speed)]
            }
            (None, 2) => {
                let edge = ContactInterface::of(&self.mesh);
                let forces = self.state.normal_forces(friction);
                let drive = Some(case.thickness * edge.torque(sliding, friction, &forces));
                let [torque, drag] =
                    [false, true].map(|own| drive.filter(|_| case.body.slides_straight() == own));
                [torque, drag, drive.map(|drive| drive * speed)]
            }
            (None, _) => self.drives(speed),
        };
        // Points of a mesh lie at nodes or between them, a ring has many.
        let nodes = |own: &ContactState| self.solid.as_ref().map_or(1, |_| own.place.shares.len());
        let count = |is_pressed: bool| {
            contact().filter(|own| own.is_pressed == is_pressed).map(nodes).sum()
        };
        BaseState {
            friction_coefficient: friction,
            slipping: count(true),
            sticking: 0,
            open: count(false),
            pressure_pa: order::range(contact().map(|own| own.pressure)),
            shear_pa: order::range(contact().map(|own| own.shear)),
            torque_n_m,
            drag_n,
            power_w: power_w.unwrap_or(0.0),
            extent: extent_of(case),
        }
    }

    /// Torque of the contacts of solid bodies that turn, N m, drag of those that slide straight, N: of each its power
    /// over its own speed. The power of all, W. Between bodies the torque has the sign of `speed`.
    fn drives(&self, speed: f64) -> [Option<f64>; 3] {
        let mut drives = [None; 3];
        for (contact, surface) in self.contacts.iter() {
            let own = self.contact.iter().filter(|own| own.place.contact == contact.name);
            let power: f64 = own.map(|own| own.shear * own.place.area * own.speed).sum();
            let rigid = contact.counter.rigid().filter(|rigid| rigid.motion.speed() != 0.0);
            let sense = rigid.map_or(speed, |rigid| surface.spin.dot(&Vector3::from(rigid.axis)));
            let (kind, own_speed) = match (surface.spin.norm(), rigid) {
                (0.0, Some(rigid)) => (1, rigid.motion.speed()),
                (turning, _) => (0, turning.copysign(sense)),
            };
            *drives[kind].get_or_insert(0.0) += power / own_speed;
            *drives[2].get_or_insert(0.0) += power;
        }
        drives
    }

    /// The body as results show it.
    pub fn body(&self) -> ShownBody<'_> {
        ShownBody { mesh: &self.mesh, sector: self.solid.as_ref().map(|own| &own.sector) }
    }

    /// The base state place by place.
    pub fn base_field(&self, case: &Case) -> BaseField {
        let friction = case.contact.sliding.friction_coefficient;
        let displacement = self.state.displacement(friction);
        let surfaces = self.contacts.iter().filter(|(own, _)| !own.is_edge());
        let surfaces = surfaces.map(|(own, _)| (own.name.clone(), own.surface)).collect();
        let sectors = self.solid.as_ref().map_or(1, |own| own.sector.sector_count());
        BaseField {
            contact: self.contact.clone(),
            surfaces,
            stress: self.body().stress(case.materials(), &displacement),
            displacement: displacement.repeat(sectors),
        }
    }
}

/// The different Rayleigh dampings that regions of the body have, each with the mark-up that names it.
pub fn dampings(case: &Case, model: &SlidingModel) -> Vec<NamedDamping> {
    let (materials, regions) = (case.materials(), &model.mesh.regions);
    let damping = |region: usize| materials.own_damping(region).unwrap_or(case.damping.rayleigh);
    let found = grouped((0..regions.len().max(1)).map(|region| (damping(region), region)));
    let is_one = found.len() == 1;
    let named = found.into_iter().map(|(damping, own)| {
        let formula = "damping *ζ* = (*α*_{R}/*ω* + *β*_{R}*ω*)/2";
        let names = own.iter().filter_map(|&region| regions.get(region));
        let names: Vec<String> = names.map(|name| literal(name)).collect();
        let name = match is_one {
            true => formula.to_owned(),
            false => format!("{formula} of {}", names.join(", ")),
        };
        (name, damping)
    });
    named.collect()
}
