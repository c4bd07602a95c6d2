//! Pressed equilibrium of a body of revolution in steady sliding: rigid contact ring by ring, or springs over the face.

use super::{PrestressError, pressure_load};
use crate::contact::{NormalLaw, SlidingContact};
use crate::fem::fold::{MirrorParity, SectorMatrix, WaveDofs};
use crate::fem::sector::Sectored;
use crate::fem::solid::{FaceTerm, face_matrix};
use crate::linalg::banded::{BandedFactor, BandedMatrix};
use crate::mesh::{FaceElement, SolidSector};

/// Choices of what is pressed that are tried before the search is given up.
const SETS: usize = 200;

/// Approach at which every ring begins pressed where nothing is pushed in, m: any positive one.
const LEAST_APPROACH: f64 = 1e-9;

/// Change of `delta - u_n` relative to the largest at which springs are settled: Newton's method, whose next change is its square.
const SETTLED: f64 = 1e-10;

/// The values of the rings at the beginning, in the middle (of a quadratic element) and at the end of an element of the face.
fn of_element(sector: &SolidSector, values: &[f64], element: &FaceElement) -> [f64; 3] {
    let at = |node: usize| {
        let mut rings = sector.rings.iter().zip(values);
        let own = rings.find(|(ring, _)| ring.nodes.contains(&node));
        own.map_or(0.0, |(_, value)| *value)
    };
    let [from, to] = [0, 2].map(|corner| at(element.nodes[corner].0));
    match sector.is_quadratic() {
        true => [from, at(element.nodes[5].0), to],
        false => [from, 0.5 * (from + to), to],
    }
}

/// What the rings have, along an element of the face from -1 to 1.
pub(super) fn along_element(
    sector: &SolidSector,
    values: &[f64],
    element: &FaceElement,
    along: f64,
) -> f64 {
    let [from, middle, to] = of_element(sector, values, element);
    let linear = 0.5 * ((1.0 - along) * from + (1.0 + along) * to);
    if !sector.is_quadratic() {
        return linear;
    }
    linear + (1.0 - along * along) * (middle - 0.5 * (from + to))
}

/// The part of an element along which the values of the rings are positive: between the roots of the parabola through them; of a
/// linear element the ends that have positive values.
pub(super) fn pressed_span(
    sector: &SolidSector,
    values: &[f64],
    element: &FaceElement,
) -> [f64; 2] {
    let [from, middle, to] = of_element(sector, values, element);
    let ends = [(-1.0, from), (1.0, to)].map(|(end, value)| if value > 0.0 { end } else { 0.0 });
    if !sector.is_quadratic() || (from > 0.0 && to > 0.0) {
        return ends;
    }
    // c + b s + a s^2
    let (a, b, c) = (0.5 * (from + to) - middle, 0.5 * (to - from), middle);
    let discriminant = b * b - 4.0 * a * c;
    if discriminant <= 0.0 {
        return [0.0; 2];
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    let roots = [q / a, c / q];
    let within = |root: &&f64| root.abs() <= 1.0;
    match (from > 0.0, to > 0.0) {
        (true, _) => [-1.0, *roots.iter().find(within).unwrap_or(&-1.0)],
        (_, true) => [*roots.iter().find(within).unwrap_or(&1.0), 1.0],
        // Pressed in the middle alone.
        _ if roots.iter().filter(within).count() == 2 => {
            [roots[0].min(roots[1]), roots[0].max(roots[1])]
        }
        _ => [0.0; 2],
    }
}

/// The body pressed without friction.
pub(super) struct Pressing {
    pub displacement: Vec<f64>,
    pub normal_forces: Vec<(usize, f64)>,
    pub is_pressed: Vec<bool>,
    pub pressures: Vec<f64>,
    pub approaches: Vec<f64>,
}

/// `delta - u_n` at each ring, the mean over its nodes, m.
pub(super) fn approaches(
    sector: &SolidSector,
    interference: f64,
    displacement: &[f64],
) -> Vec<f64> {
    let face = sector.specification.contact.face();
    let mean = |nodes: &[usize]| {
        let normals = nodes.iter().map(|node| displacement[3 * node + face.normal_component()]);
        face.inward_sign() * normals.sum::<f64>() / nodes.len() as f64
    };
    let rings = sector.rings.iter();
    rings.map(|ring| interference - mean(&ring.nodes)).collect()
}

/// Signorini's conditions ring by ring: the set of pressed ones.
pub(super) fn press_rigidly(
    sector: &SolidSector,
    system: &System,
    contact: &SlidingContact,
) -> Result<Pressing, PrestressError> {
    let face = sector.specification.contact.face();
    let (inward, component) = (face.inward_sign(), face.normal_component());
    let load = pressure_load(sector);
    let rings = &sector.rings;
    let mut is_pressed = vec![true; rings.len()];
    for _ in 0..SETS {
        let mut prescribed = vec![None; system.dofs];
        for (ring, _) in rings.iter().zip(&is_pressed).filter(|(_, p)| **p) {
            for node in &ring.nodes {
                prescribed[3 * node + component] = Some(inward * contact.interference);
            }
        }
        let displacement = system.solve(&load, &prescribed)?;
        let reaction = system.reaction(&displacement, &load);
        let force = |node: &usize| inward * reaction[3 * node + component];
        let ring_forces = rings.iter().map(|ring| ring.nodes.iter().map(force).sum());
        let ring_forces: Vec<f64> = ring_forces.collect();
        let scale = ring_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        let approaches = approaches(sector, contact.interference, &displacement);
        let next: Vec<bool> = (0..rings.len())
            .map(|k| match is_pressed[k] {
                true => ring_forces[k] > 1e-12 * scale,
                false => approaches[k] > 1e-12 * contact.interference.abs(),
            })
            .collect();
        if next != is_pressed {
            is_pressed = next;
            continue;
        }
        let pressed = rings.iter().zip(&is_pressed).filter(|(_, p)| **p);
        let nodes = pressed.flat_map(|(ring, _)| &ring.nodes);
        let pressures = rings.iter().zip(&ring_forces).zip(&is_pressed);
        return Ok(Pressing {
            normal_forces: nodes.map(|node| (*node, force(node))).collect(),
            pressures: pressures
                .map(|((ring, force), pressed)| if *pressed { force / ring.area } else { 0.0 })
                .collect(),
            displacement,
            is_pressed,
            approaches,
        });
    }
    Err(PrestressError::NoState { friction_coefficient: contact.friction_coefficient })
}

/// Springs that push and do not pull, `K u + int k (u_n - delta + g) n dA = f + int s g n dA` over the points of the face where
/// they are pressed, `s g = p(g)`: Newton's method on the approach `g` of the rings, so that the tangent of the eigenvalue analysis
/// is the derivative of this state.
pub(super) fn press_on_springs(
    sector: &SolidSector,
    terms: &[&SectorMatrix],
    contact: &SlidingContact,
    law: NormalLaw,
) -> Result<Pressing, PrestressError> {
    let face = sector.specification.contact.face();
    let (inward, component) = (face.inward_sign(), face.normal_component());
    let load = pressure_load(sector);
    let rings = sector.rings.len();
    let pushed = field(sector, &vec![contact.interference; rings]);
    let start = contact.interference.max(LEAST_APPROACH);
    let mut values = vec![start.min(law.soft_approach()); rings];
    for _ in 0..SETS {
        // The tangent at the approaches found last, and what it pushes with.
        let springs = Springs { sector, law, approaches: &values };
        let tangent = springs.tangent();
        let spring = System::new(sector, &[&tangent]);
        let own = springs.push();
        let system = System::new(sector, &[terms, &[&tangent]].concat());
        let known = spring.stiffness.multiply(&distance(sector, &pushed, &field(sector, &values)));
        let loads = load.iter().zip(&own).zip(&known);
        let loads: Vec<f64> = loads.map(|((a, b), c)| a + b + c).collect();
        let displacement = system.solve(&loads, &vec![None; system.dofs])?;

        // The approaches of the forces there.
        let found = approaches(sector, contact.interference, &displacement);
        let pairs = values.iter().zip(&found);
        let next: Vec<f64> = pairs.map(|(a, b)| law.newton_approach(*a, *b)).collect();
        let changes = next.iter().zip(&values).map(|(a, b)| (a - b).abs());
        let change = changes.fold(0.0, f64::max);
        let scale = next.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if change > SETTLED * scale {
            values = next;
            continue;
        }
        let left = distance(sector, &pushed, &displacement);
        let left = distance(sector, &left, &field(sector, &values));
        let forces = own.iter().zip(spring.stiffness.multiply(&left));
        let forces: Vec<f64> = forces.map(|(own, more)| own + more).collect();
        let nodes = sector.rings.iter().flat_map(|ring| &ring.nodes);
        let nodes = nodes.map(|&node| (node, inward * forces[3 * node + component]));
        return Ok(Pressing {
            normal_forces: nodes.filter(|(_, force)| *force != 0.0).collect(),
            is_pressed: found.iter().map(|approach| *approach > 0.0).collect(),
            pressures: found.iter().map(|g| law.pressure(g.max(0.0))).collect(),
            approaches: found,
            displacement,
        });
    }
    Err(PrestressError::NoState { friction_coefficient: contact.friction_coefficient })
}

/// The springs of the face where the rings' approaches are positive.
pub(super) struct Springs<'a> {
    pub sector: &'a SolidSector,
    pub law: NormalLaw,
    pub approaches: &'a [f64],
}

impl Springs<'_> {
    /// `int k(g) n n^T dA`, N/m.
    pub fn tangent(&self) -> SectorMatrix {
        self.matrix(&|approach| self.law.stiffness(approach))
    }

    /// `int s g n dA`, N, with the secant `s(g)`, whose force at the approaches is that of the pressure.
    fn push(&self) -> Vec<f64> {
        let secant = self.matrix(&|approach| self.law.secant(approach));
        let system = System::new(self.sector, &[&secant]);
        system.stiffness.multiply(&field(self.sector, self.approaches))
    }

    /// A normal term with a weight that follows the approach.
    fn matrix(&self, weight: &dyn Fn(f64) -> f64) -> SectorMatrix {
        let at = |element: &FaceElement, _: f64, along: f64| weight(self.approach(element, along));
        let faces = self.sector.contact_elements();
        face_matrix(self.sector, &faces, &self.term(&at, &|element| self.span(element)))
    }

    /// A normal term on some part of each element.
    pub fn term<'a>(
        &self,
        weight: &'a dyn Fn(&FaceElement, f64, f64) -> f64,
        span: &'a dyn Fn(&FaceElement) -> [f64; 2],
    ) -> FaceTerm<'a> {
        let component = self.sector.specification.contact.face().normal_component();
        FaceTerm { row: component, column: component, weight, span, is_nodal: true }
    }

    /// The approach at a point of an element, zero where it is open, m.
    pub fn approach(&self, element: &FaceElement, along: f64) -> f64 {
        along_element(self.sector, self.approaches, element, along).max(0.0)
    }

    /// See [`pressed_span`].
    pub fn span(&self, element: &FaceElement) -> [f64; 2] {
        pressed_span(self.sector, self.approaches, element)
    }
}

/// A normal displacement of the face, towards the body, that is the same all over each ring.
pub(super) fn field(sector: &SolidSector, values: &[f64]) -> Vec<f64> {
    let face = sector.specification.contact.face();
    let mut field = vec![0.0; 3 * sector.node_count()];
    for (ring, value) in sector.rings.iter().zip(values) {
        for node in &ring.nodes {
            field[3 * node + face.normal_component()] = face.inward_sign() * value;
        }
    }
    field
}

/// What is left to `pushed` along the normal.
pub(super) fn distance(sector: &SolidSector, pushed: &[f64], displacement: &[f64]) -> Vec<f64> {
    let component = sector.specification.contact.face().normal_component();
    let pairs = pushed.iter().zip(displacement).enumerate();
    pairs
        .map(|(dof, (pushed, u))| (pushed - u) * f64::from(u8::from(dof % 3 == component)))
        .collect()
}

/// Harmonic zero of the supported body.
pub(super) struct System {
    pub dofs: usize,
    is_held: Vec<bool>,
    pub stiffness: BandedMatrix,
}

impl System {
    pub fn new(sector: &SolidSector, terms: &[&SectorMatrix]) -> Self {
        let dofs = 3 * sector.node_count();
        let WaveDofs { half_bandwidth, sectors, .. } = sector.wave_dofs();
        let all = WaveDofs::new(dofs, |_| false, half_bandwidth, sectors);
        let stiffness = all.fold(0, MirrorParity::Even, terms);
        Self { dofs, is_held: (0..dofs).map(|dof| sector.is_held(dof)).collect(), stiffness }
    }

    /// Displacement under a load with some dofs prescribed and without tangential motion.
    pub fn solve(
        &self,
        load: &[f64],
        prescribed: &[Option<f64>],
    ) -> Result<Vec<f64>, PrestressError> {
        self.part(load, prescribed, |component| component != 1)
    }

    /// Tangential displacement under a tangential load.
    pub fn torsion(
        &self,
        load: &[f64],
        prescribed: &[Option<f64>],
    ) -> Result<Vec<f64>, PrestressError> {
        self.part(load, prescribed, |component| component == 1)
    }

    fn part(
        &self,
        load: &[f64],
        prescribed: &[Option<f64>],
        is_in: impl Fn(usize) -> bool,
    ) -> Result<Vec<f64>, PrestressError> {
        let mut displacement: Vec<f64> =
            prescribed.iter().map(|value| value.unwrap_or(0.0)).collect();
        let unknowns: Vec<usize> = (0..self.dofs)
            .filter(|&dof| is_in(dof % 3) && !self.is_held[dof] && prescribed[dof].is_none())
            .collect();
        let force = self.stiffness.multiply(&displacement);
        let mut right: Vec<f64> = unknowns.iter().map(|&dof| load[dof] - force[dof]).collect();
        let reduced = self.stiffness.restricted_to(&unknowns);
        let none = BandedMatrix::zeros(reduced.dimension(), reduced.half_bandwidth());
        let factor = BandedFactor::new(&reduced, &none, 0.0);
        if factor.negative_count() > 0 || !factor.is_regular() {
            return Err(PrestressError::Singular);
        }
        factor.solve(&mut right);
        for (&dof, value) in unknowns.iter().zip(right) {
            displacement[dof] = value;
        }
        Ok(displacement)
    }

    /// Force that holds a displacement beside the load, N.
    fn reaction(&self, displacement: &[f64], load: &[f64]) -> Vec<f64> {
        let force = self.stiffness.multiply(displacement);
        force.iter().zip(load).map(|(f, l)| f - l).collect()
    }
}
