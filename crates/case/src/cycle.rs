//! `[cycle]`: limit cycles found directly; `[basin]`: which of two motions wins.

use super::{Contact, OnsetChoice, Spacing, StabilityChoice, keys, range_values, reader::declared};
use crate::*;
use frictionsim_physics::cycle::{BasinRequest, Parameter};

/// Shortest transient that puts a cycle to the test: its last fifth has the four periods that a frequency is read from,
/// and a wave that is no motion of the disc is gone by then.
const CONFIRMATION_PERIODS: usize = 20;

declared! {
    /// `[cycle]`: limit cycles.
    Cycle {
        onsets: OnsetChoice = choice, "Onsets of each harmonic.";
        phases: Option<usize> = optional_count, "Phases along the wave; `None` takes as many as the mesh asks for.";
        harmonic_count: Option<usize> = optional_count, "Harmonics in which the motion of a body without symmetry is \
            told; `None` takes as many as leave a thousandth of it.";
        frames: usize = count, "Times over one period at which the whole field is written.";
        confirmation_periods: usize = count, "Periods of the transient that puts a cycle to the test; 0 for none.";
        stability: StabilityChoice = choice, "What stability is worked out for.";
        two_frequencies: bool = flag, "Whether the motion of two frequencies is sought where a rotating wave loses its \
            stability to another.";
    } with {
        harmonics: Option<Vec<usize>>, "Circumferential harmonics; `None` takes those that are unstable.";
        continuation: Option<Continuation>, "Continuation over a parameter.";
    }
}

declared! {
    /// `[cycle.continuation]`.
    Continuation {
        from: f64 = number, "First value of the parameter, in units of its key.";
        to: f64 = number, "Its last value.";
        count: usize = count, "Values between them, ends included, at which cycles are reported.";
        spacing: Spacing = choice, "How those values are spaced.";
    } with {
        parameter: Parameter, "What the cycles are followed over.";
    }
}

impl Continuation {
    /// The values, SI, from first to last.
    pub fn values(&self) -> Vec<f64> {
        let values = range_values(self.from, self.to, self.count, self.spacing).into_iter();
        values.map(|value| value * self.parameter.unit()).collect()
    }
}

impl Case {
    /// The search for limit cycles.
    ///
    /// # Errors
    /// A case without `[cycle]`, a body that the transient cannot step, a counterface at rest, and of rotating waves a
    /// cylinder that turns backwards.
    pub fn require_cycle(&self) -> Result<&Cycle, CaseErrors> {
        self.refuse_losses_in_time("the search for limit cycles")?;
        self.refuse_what_has_no_cycle()?;
        // What no section would help against comes first.
        let has_waves = self.has_rotating_waves();
        let key = if has_waves { "harmonics = [1, 2]" } else { "onsets = \"all\"" };
        let remedy = &format!("[cycle]\n{key}");
        let cycle = self.required(&self.cycle, "cycle", "limit cycle", remedy)?;
        let speed = self.contact.sliding.rotation_speed;
        let is_moving = if has_waves { speed > 0.0 } else { speed != 0.0 };
        if is_moving {
            return Ok(cycle);
        }
        let key = self.speed_key();
        let value = self.raw.find(&key).map(|item| item.value.to_string()).unwrap_or_default();
        Err(match self.has_rotating_waves() {
            true => {
                refusal!(self, &key, "{key} = {value}: limit cycles need a cylinder that turns";
                "must be positive here"; "a cylinder turning backwards gives the mirror image")
            }
            false => refusal!(self, &key,
                "{key} = {value}: the contact sticks at rest, and no limit cycle lives there";
                "must not be zero here"; "give a speed; its sign is the sense of the sliding"),
        })
    }

    /// Refuses a body whose limit cycles cannot be motions of the transient.
    pub(super) fn refuse_what_has_no_cycle(&self) -> Result<(), CaseErrors> {
        self.require_steps(
            "limit cycles need \"quad4\"",
            "limit cycles need bricks of 8 nodes, \"quad4\": they are motions of the transient, which lumps the mass",
        )
    }

    /// Whether the limit cycles of the body are rotating waves: on the generated annulus around a rigid shaft, with a
    /// constant friction coefficient, in contact that does not stiffen with pressure. Those of any other plane body are
    /// motions of the whole mesh.
    pub fn has_rotating_waves(&self) -> bool {
        self.body.has_rotating_waves(&self.contact)
    }
}

impl Body {
    /// [`Case::has_rotating_waves`] of a body in some contact.
    pub(super) fn has_rotating_waves(&self, contact: &Contact) -> bool {
        self.annulus().is_some() && self.without_waves(contact).is_none()
    }

    /// Why there are none where the contact is not rigid with constant friction: what a search for them asks for, in
    /// short what is there, and the remedy.
    pub fn without_waves(&self, contact: &Contact) -> Option<[&'static str; 3]> {
        Some(if self.grid().is_some_and(|grid| grid.shaft.is_some()) {
            let remedy = "leave geometry.shaft_inner_radius out";
            ["takes the cylinder as rigid", "a deformable shaft", remedy]
        } else if contact.sliding.decay.is_some() {
            let needs = "needs a constant friction coefficient";
            [needs, "friction falls with speed", "set contact.static_friction_ratio = 1.0"]
        } else if contact.stiffness.law.is_some() {
            let is = "is a rotating wave of rigid contact, whose pressure is not that of a contact that stiffens";
            [is, "contact.normal_law is not linear", "leave contact.normal_law out"]
        } else {
            return None;
        })
    }
}

pub(super) fn cycle(section: &Section<'_>, body: Option<&Body>) -> Cycle {
    let harmonics = section.harmonics(body.and_then(Body::sector_count));
    let followed = section.read_section("continuation", |own| continuation(own, body));
    let own = Cycle::declared(section, harmonics, followed);
    if let periods @ 1..CONFIRMATION_PERIODS = own.confirmation_periods {
        refuse!(section, "confirmation_periods",
            "cycle.confirmation_periods = {periods} is too short to read a frequency from its last \
             fifth"; "0 for none, or {CONFIRMATION_PERIODS} and more");
    }
    let is_analysed = own.stability != StabilityChoice::None;
    refuse_if!(own.two_frequencies && !is_analysed; section, "two_frequencies",
        "cycle.two_frequencies needs to know which cycles lose their stability";
        "needs cycle.stability"; "cycle.stability = \"point\" or \"branch\"");
    let is_followed = own.continuation.is_some();
    refuse_if!(own.stability == StabilityChoice::Branch && !is_followed; section, "stability",
        "cycle.stability = \"branch\" needs [cycle.continuation]"; "needs [cycle.continuation]";
        "add that table, or use \"point\"");
    own
}

fn continuation(section: &Section<'_>, body: Option<&Body>) -> Continuation {
    let key = section.text("key");
    // Of a round or a plane counterface, or of solid bodies.
    let suits = |own: &Parameter| match body.map(|body| (&body.kind, body.imported())) {
        Some((BodyKind::Assembly(_), _)) => own.is_of_solid_bodies(),
        Some((_, plane)) => own.suits(plane.is_none_or(|own| own.mesh.has_round_contact())),
        None => true,
    };
    let known: Vec<Parameter> = Parameter::ALL.into_iter().filter(suits).collect();
    let parameter = known.iter().find(|own| own.key() == key);
    let is_numeric = keys::find(&key).is_some_and(CaseKey::is_numeric);
    if !is_numeric && section.is_some_text("key") {
        let message = format!("{} = \"{key}\" is not a numeric case key", section.name("key"));
        let hint = section.findings.scope.hint(&key, CaseKey::is_numeric);
        section.reject("key", message, "must name a key whose value is a number", hint);
    }
    let names = || known.iter().map(|own| own.key()).collect::<Vec<_>>().join(", ");
    refuse_if!(is_numeric && parameter.is_none(); section, "key",
        "limit cycles cannot be followed over {key}"; "not one of the parameters of a cycle";
        "one of {}", names());
    let parameter = parameter.copied().unwrap_or(Parameter::FrictionCoefficient); // Any, where its key is refused.
    let own = Continuation::declared(section, parameter);
    let Continuation { from, to, spacing, .. } = own;
    if from.min(to) < 0.0 {
        refuse!(section, if from < 0.0 { "from" } else { "to" },
            "{key} cannot be negative along a branch"; "must not be negative");
    } else if spacing == Spacing::Logarithmic && (from == 0.0 || to == 0.0) {
        refuse!(section, "spacing",
            "cycle.continuation.spacing = \"log\" needs two positive ends, not {from} and {to}";
            "both ends must be positive"; "use \"linear\"");
    }
    refuse_if!(from == to; section, "to", "cycle.continuation.to = {to} equals from";
        "must differ from `from`");
    own
}

pub(super) fn basin(section: &Section<'_>, body: Option<&Body>) -> BasinRequest {
    let pair = section.harmonics(body.and_then(Body::sector_count)).unwrap_or_default();
    let modes = section.counts("modes");
    let modes = modes.map(|own| own.into_iter().map(|(mode, _)| mode).collect::<Vec<usize>>());
    refuse_if!(modes.as_ref().is_some_and(|own| !(1..=2).contains(&own.len())); section, "modes",
        "basin.modes must name two different modes, or one that competes with steady sliding";
        "one or two of them");
    let request = BasinRequest {
        modes,
        harmonics: [pair.first(), pair.last()].map(|n| n.copied().unwrap_or(1)),
        seed_ratios: [section.number("seed_ratio_from"), section.number("seed_ratio_to")],
        tolerance: section.number("tolerance"),
        periods: section.count("periods"),
    };
    refuse_if!(pair.len() != 2 || pair[0] == pair[1]; section, "harmonics",
        "basin.harmonics must name two different harmonics"; "{} of them, two are compared",
        pair.len());
    let [from, to] = request.seed_ratios;
    refuse_if!(from >= to; section, "seed_ratio_from",
        "basin.seed_ratio_from = {from:?} is not below basin.seed_ratio_to = {to:?}";
        "below {to:?}");
    request
}
