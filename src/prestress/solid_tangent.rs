//! The matrices of small motions around steady sliding of a body of revolution, harmonic by harmonic.

use super::face_conditions::supports;
use super::{DampingModel, PrestressError, SolidSliding, TangentOptions};
use crate::contact::SlidingContact;
use crate::fem::sector::MirrorParity;
use crate::fem::solid::{self, FaceTerm, SolidMatrix, face_matrix, half_bandwidth, nodal_matrix};
use crate::fem::{DofMap, ElasticMaterial, RayleighDamping};
use crate::linalg::banded::BandedMatrix;
use crate::mesh::{FaceElement, SolidSector};

/// A matrix of the wave `U e^{i n theta}` by power of `i mu`, real.
type Powers = [BandedMatrix; 2];

/// Mass, damping and stiffness of one harmonic before the contact condition is put in.
///
/// Unknowns are `(u_r, -i u_theta, u_z)` of the nodes that nothing holds. In rigid contact the motion of pressed nodes along the
/// normal vanishes, and the force there drives the tangential equation of the same node: [`Self::rigid`].
#[derive(Clone, Debug)]
pub struct SolidHarmonic {
    /// `M`, kg.
    pub mass: BandedMatrix,
    /// `K`, N/m, by power of `i mu`.
    pub stiffness: Powers,
    /// `C` without the part across the sliding, N s/m, by power of `i mu`.
    pub damping: Powers,
    /// Dashpots to be multiplied by `mu`, N s/m: `p_0 / V` across the sliding, and along it where friction falls with the speed.
    pub across: BandedMatrix,
    /// Unknowns `(normal, tangential)` of each node in rigid contact, and the factor `s` times the sign of the inward normal
    /// with which the normal equation, times `i mu`, is added to the tangential one.
    pub rigid: Vec<(usize, Option<usize>, f64)>,
}

/// The tangent of a body of revolution in three dimensions.
///
/// ```text
/// M q'' + (alpha_R M + beta_R K + D + mu A) q' + K q = 0,   K = K_e + K_sigma + K_support + K_turning + contact
/// A = int p_0 / V d d^T dA,   V = |Omega| r
/// ```
///
/// `A` is Coulomb's law as a vector: the friction force opposes the relative velocity, which a motion across the sliding turns.
/// `d` is `e_z` on a cylinder and `e_r` on a face. The contact forces that turn with the node, `N e_theta / r` on a cylinder and
/// `-s mu N e_r / r` on both for each unit of `u_theta`, go with the geometric stiffness: a rigid rotation of everything costs
/// no force.
#[derive(Clone, Debug)]
pub struct SolidTangent {
    sector: SolidSector,
    options: TangentOptions,
    base: SolidSliding,
    elastic: SolidMatrix,
    mass: SolidMatrix,
    supports: [SolidMatrix; 2],
    /// Even and odd parts of prestress and turning forces.
    stress: [SolidMatrix; 2],
    /// Penalty stiffness at rest and its friction; empty for rigid contact.
    penalty: [SolidMatrix; 2],
    /// Contact dashpots at rest and their friction.
    dashpots: [SolidMatrix; 2],
    friction_dashpots: SolidMatrix,
    unknown_of: Vec<Option<usize>>,
}

impl SolidTangent {
    /// Finds the steady sliding state and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist, [`PrestressError::AtRest`] where the rotor does not turn.
    pub fn linearize(
        sector: &SolidSector,
        material: &ElasticMaterial,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        if contact.rotation_speed == 0.0 {
            return Err(PrestressError::AtRest);
        }
        let elastic = solid::stiffness(sector, material);
        let base =
            SolidSliding::solve_with(sector, &elastic, contact, options.contact.base_stiffness())?;
        let faces = sector.contact_elements();
        let face = sector.specification.contact.face();
        let (normal, side) = (face.normal_component(), face.across_component());
        let pressure =
            |element: &FaceElement, along: f64| base.pressure_along(sector, element, along);
        let term = |row, column, weight: &dyn Fn(&FaceElement, f64, f64) -> f64| {
            face_matrix(
                sector,
                &faces,
                &FaceTerm {
                    row,
                    column,
                    weight,
                    span: &|element| base.pressed_span(sector, element),
                },
            )
        };
        let pressed = |row, column, value: f64, factor: &dyn Fn(f64) -> f64| {
            let weight =
                |element: &FaceElement, radius: f64, along: f64| match pressure(element, along)
                    > 0.0
                {
                    true => value * factor(radius),
                    false => 0.0,
                };
            term(row, column, &weight)
        };
        let drag = |radius: f64| face.inward_sign() * base.friction(radius).1.drag;
        let law = |value: f64| match value {
            0.0 => [SolidMatrix::default(), SolidMatrix::default()],
            value => [
                pressed(normal, normal, value, &|_| 1.0),
                pressed(1, normal, value, &drag),
            ],
        };
        let mut dashpots = law(options.contact.normal_damping);
        let tangential = options.contact.tangential_damping;
        if tangential != 0.0 {
            for component in [1, side] {
                dashpots[0].extend(pressed(component, component, tangential, &|_| 1.0));
            }
        }
        let stress = match options.geometric_stiffness {
            true => prestress(sector, material, &base),
            false => Default::default(),
        };
        let mut friction_dashpots = term(side, side, &|element, radius, along| {
            let (speed, friction) = base.friction(radius);
            pressure(element, along) * friction.drag.abs() / speed
        });
        if contact.decay.is_some() {
            friction_dashpots.extend(term(1, 1, &|element, radius, along| {
                pressure(element, along) * base.friction(radius).1.slope
            }));
        }
        Ok(Self {
            unknown_of: sector_unknowns(sector),
            mass: solid::mass(sector, material, options.mass),
            supports: supports(sector),
            stress,
            penalty: law(options.contact.normal_stiffness.unwrap_or(0.0)),
            dashpots,
            friction_dashpots,
            sector: sector.clone(),
            options: *options,
            elastic,
            base,
        })
    }

    /// The sector it was built from.
    pub fn sector(&self) -> &SolidSector {
        &self.sector
    }

    /// The steady sliding state.
    pub fn base(&self) -> &SolidSliding {
        &self.base
    }

    /// Rayleigh coefficients.
    pub fn rayleigh(&self) -> RayleighDamping {
        self.options.damping
    }

    /// Unknown of each dof, `None` for those held.
    pub fn unknown_of(&self) -> &[Option<usize>] {
        &self.unknown_of
    }

    /// Whether harmonic `n` stands: `+n` and `-n` are one and the same.
    pub fn is_standing(&self, n: usize) -> bool {
        n == 0 || 2 * n == self.sector.sector_count()
    }

    /// `M` and `K` without friction, all unknowns.
    pub fn at_rest(&self, n: usize) -> [BandedMatrix; 2] {
        let stiffness = [
            &self.elastic,
            &self.stress[0],
            &self.penalty[0],
            &self.supports[0],
        ];
        [
            self.sum(n, MirrorParity::Even, &[&self.mass]),
            self.sum(n, MirrorParity::Even, &stiffness),
        ]
    }

    /// All matrices of harmonic `n`.
    pub fn harmonic(&self, n: usize) -> SolidHarmonic {
        let mass = self.sum(n, MirrorParity::Even, &[&self.mass]);
        let body = [&self.elastic, &self.stress[0], &self.penalty[0]];
        let body = self.sum(n, MirrorParity::Even, &body);
        let mut rest = body.clone();
        self.add(&mut rest, n, MirrorParity::Even, &[&self.supports[0]]);
        let friction = self.sum(n, MirrorParity::Odd, &[&self.stress[1], &self.penalty[1]]);
        let damped = match self.options.damping_model {
            DampingModel::WholeTangent => [body, friction.clone()],
            DampingModel::BodyOnly => [
                self.sum(n, MirrorParity::Even, &[&self.elastic]),
                self.sum(n, MirrorParity::Odd, &[]),
            ],
        };
        let rayleigh = self.options.damping;
        let mut damping = damped.map(|mut matrix| {
            matrix.scale(rayleigh.stiffness_coefficient);
            matrix
        });
        damping[0].add_scaled(rayleigh.mass_coefficient, &mass);
        let even = self.sum(
            n,
            MirrorParity::Even,
            &[&self.supports[1], &self.dashpots[0]],
        );
        damping[0].add_scaled(1.0, &even);
        damping[1].add_scaled(1.0, &self.sum(n, MirrorParity::Odd, &[&self.dashpots[1]]));
        SolidHarmonic {
            mass,
            stiffness: [rest, friction],
            damping,
            across: self.sum(n, MirrorParity::Even, &[&self.friction_dashpots]),
            rigid: self.rigid(),
        }
    }

    fn sum(&self, n: usize, parity: MirrorParity, terms: &[&SolidMatrix]) -> BandedMatrix {
        let count = self.unknown_of.iter().flatten().count();
        let mut sum = BandedMatrix::zeros(count, half_bandwidth(&self.sector));
        self.add(&mut sum, n, parity, terms);
        sum
    }

    fn add(&self, sum: &mut BandedMatrix, n: usize, parity: MirrorParity, terms: &[&SolidMatrix]) {
        let at = (self.sector.sector_count(), n);
        for term in terms {
            term.add_harmonic(sum, &self.unknown_of, at, (parity, 1.0));
        }
    }

    /// See [`SolidHarmonic::rigid`].
    pub fn rigid(&self) -> Vec<(usize, Option<usize>, f64)> {
        if self.options.contact.normal_stiffness.is_some() {
            return Vec::new();
        }
        let face = self.sector.specification.contact.face();
        let nodes = self.base.normal_forces.iter();
        nodes
            .filter_map(|(node, _)| {
                let normal = self.unknown_of[3 * node + face.normal_component()]?;
                let drag = self.base.friction(self.sector.nodes[*node].radius).1.drag;
                Some((
                    normal,
                    self.unknown_of[3 * node + 1],
                    face.inward_sign() * drag,
                ))
            })
            .collect()
    }
}

/// Unknown of each dof of a sector, `None` for those that a boundary holds.
pub fn sector_unknowns(sector: &SolidSector) -> Vec<Option<usize>> {
    let dofs = 3 * sector.node_count();
    DofMap::excluding(dofs, (0..dofs).filter(|&dof| sector.is_held(dof))).unknown_of
}

/// Unknowns of a harmonic that may move, ascending: all of `count` but the normals of [`SolidHarmonic::rigid`].
pub fn moving_unknowns(count: usize, rigid: &[(usize, Option<usize>, f64)]) -> Vec<usize> {
    let normals = rigid.iter().map(|(normal, ..)| *normal);
    DofMap::excluding(count, normals).dofs
}

/// Geometric stiffness of the pressed and of the sheared state with the contact forces that turn with their nodes.
fn prestress(
    sector: &SolidSector,
    material: &ElasticMaterial,
    base: &SolidSliding,
) -> [SolidMatrix; 2] {
    let mut pressed = solid::geometric_stiffness(sector, material, &base.pressed_displacement);
    let mut sheared = solid::geometric_stiffness(sector, material, &base.sheared_displacement);
    let is_cylinder = sector.specification.contact.face().normal_component() == 0;
    let (mut turning, mut dragging) = (Vec::new(), Vec::new());
    for (node, force) in &base.normal_forces {
        let force = force / sector.nodes[*node].radius;
        if is_cylinder {
            turning.push((*node, 1, 1, -force));
        }
        let drag = base.friction(sector.nodes[*node].radius).1.drag;
        dragging.push((*node, 0, 1, drag * force));
    }
    pressed.extend(nodal_matrix(&turning));
    sheared.extend(nodal_matrix(&dragging));
    [pressed, sheared]
}
