//! Dense matrices of a whole ring of bricks, put together without harmonics.

use super::*;

/// `M`, `C`, `K` over the dofs `3 (s n + k) + c` in nodal frames, and the dofs that move.
pub struct WholeRing {
    pub sector: SolidSector,
    mass: Mat<f64>,
    damping: Mat<f64>,
    stiffness: Mat<f64>,
    moving: Vec<usize>,
}

impl WholeRing {
    /// The body: 8 nodes by the operator of the transient, which knows no harmonics, with lumped mass; 20 nodes, without
    /// supports, by an element in global coordinates written here, with consistent mass.
    pub fn new(model: &SolidModel, is_free: bool) -> Self {
        let mut specification = model.specification.clone();
        if is_free {
            specification.conditions = [Free; 4];
        }
        let sector = SolidSector::generate(&specification).unwrap();
        let of = if sector.is_quadratic() { assembled } else { operated };
        let [mass, stiffness] = of(&sector, model);
        let rayleigh = model.options.damping;
        let damping = Mat::from_fn(mass.nrows(), mass.nrows(), |i, j| {
            let (m, k) = (mass[(i, j)], stiffness[(i, j)]);
            rayleigh.mass_coefficient * m + rayleigh.stiffness_coefficient * k
        });
        let per_sector = 3 * sector.node_count();
        let moving = (0..mass.nrows()).filter(|dof| !sector.is_held(dof % per_sector));
        Self { moving: moving.collect(), sector, mass, damping, stiffness }
    }

    /// In sliding contact at a friction coefficient: springs `k_n` or `u_n = 0`, Coulomb's force along the sliding, `mu p / V`
    /// across it. All by hand; `beta_R` acts on the body alone.
    pub fn sliding(model: &SolidModel, friction: f64) -> Self {
        let mut ring = Self::new(model, false);
        let sector = ring.sector.clone();
        let (material, contact, mass) = (&model.material, &model.contact, model.options.mass);
        let alike = sector.strip.stiffness_alike(material);
        let base = SolidSliding::solve(&sector, &alike, contact, &RIGID, mass).unwrap();
        let face = sector.specification.contact.face();
        let (normal, across) = (face.normal_component(), face.across_component());
        // T = mu N along +e_theta for a rotor that turns counter-clockwise.
        let drag = friction * face.inward_sign();
        let per_sector = sector.node_count();
        ring.add_dashpots(&base, across, friction * model.contact.rotation_speed.recip());
        let rings = sector.rings.iter().zip(&base.sliding.is_pressed);
        let pressed = rings.filter(|(_, pressed)| **pressed).flat_map(|(ring, _)| {
            let share = ring.area / ring.nodes.len() as f64;
            ring.nodes.iter().map(move |node| (*node, share))
        });
        for (node, area) in pressed.collect::<Vec<_>>() {
            for s in 0..sector.sector_count() {
                let dof = |c: usize| 3 * (s * per_sector + node) + c;
                let contact = model.options.contact;
                if let Some(stiffness) = contact.normal_stiffness {
                    assert!(!sector.is_quadratic());
                    for (matrix, value) in [
                        (&mut ring.stiffness, stiffness * area),
                        (&mut ring.damping, contact.normal_damping * area),
                    ] {
                        matrix[(dof(normal), dof(normal))] += value;
                        matrix[(dof(1), dof(normal))] += drag * value;
                    }
                    for c in [1, across] {
                        ring.damping[(dof(c), dof(c))] += contact.tangential_damping * area;
                    }
                } else {
                    for matrix in [&mut ring.mass, &mut ring.damping, &mut ring.stiffness] {
                        for column in 0..matrix.ncols() {
                            let force = matrix[(dof(normal), column)];
                            matrix[(dof(1), column)] -= drag * force;
                        }
                    }
                    ring.moving.retain(|moving| *moving != dof(normal));
                }
            }
        }
        ring
    }

    /// `∫ c p / r dA` across the sliding: at the nodes for 8, consistent for 20.
    fn add_dashpots(&mut self, base: &SolidSliding, across: usize, factor: f64) {
        let sector = self.sector.clone();
        for element in sector.contact_elements() {
            for point in face_quadrature(sector.is_quadratic()) {
                let (values, area) = element.values_at(&sector, point);
                let weight = |[around, along]: [f64; 2]| {
                    let pressure = base.pressure_along(&sector, &element, along);
                    factor * area * pressure / element.radius_at(&sector, [around, along])
                };
                for s in 0..sector.sector_count() {
                    let nodes = element.nodes.iter();
                    let dofs = nodes.map(|own| 3 * global(&sector, s, own.0, own.1) + across);
                    let dofs: Vec<usize> = dofs.collect();
                    for (a, &from) in dofs.iter().enumerate() {
                        if !sector.is_quadratic() {
                            // Corners 0 and 1 lie at the beginning of the element.
                            let node = [0.0, [-1.0, 1.0][a / 2]];
                            self.damping[(from, from)] += weight(node) * values[a];
                            continue;
                        }
                        for (b, &to) in dofs.iter().enumerate() {
                            self.damping[(from, to)] += weight(point.0) * values[a] * values[b];
                        }
                    }
                }
            }
        }
    }

    /// Responses of some dofs to a unit force on another.
    pub fn respond(&self, frequency_hz: f64, force: usize, responses: &[usize]) -> Vec<c64> {
        let omega = TAU * frequency_hz;
        let kept = &self.moving;
        let matrix = Mat::from_fn(kept.len(), kept.len(), |i, j| {
            let at = (kept[i], kept[j]);
            let real = self.stiffness[at] - omega * omega * self.mass[at];
            c64::new(real, omega * self.damping[at])
        });
        let unknown = |dof: usize| kept.binary_search(&dof).expect("a dof that moves");
        let mut x = Mat::<c64>::zeros(kept.len(), 1);
        x[(unknown(force), 0)] = c64::new(1.0, 0.0);
        ComplexDenseLu::factorize(matrix).solve_in_place(x.as_mut());
        responses.iter().map(|dof| x[(unknown(*dof), 0)]).collect()
    }
}

/// Node of the ring at `half` halves of a sector from the start of sector `s`.
fn global(sector: &SolidSector, s: usize, node: usize, half: usize) -> usize {
    let ahead = (half - sector.nodes[node].half_step) / 2;
    ((s + ahead) % sector.sector_count()) * sector.node_count() + node
}

/// `M` and `K` column by column.
fn operated(sector: &SolidSector, model: &SolidModel) -> [Mat<f64>; 2] {
    assert_eq!(model.options.mass, Lumped);
    let whole = sector.whole();
    let body = body(model, (sector, &whole));
    let operator = body.operator(OperatorChoice::Auto, SimdLevel::Scalar).unwrap();
    let count = operator.dof_count();
    let masses = operator.masses();
    let (mut mass, mut stiffness) = (Mat::zeros(count, count), Mat::zeros(count, count));
    for column in 0..count {
        let mut x = vec![0.0; operator.field_length()];
        let mut y = x.clone();
        x[operator.position(column)] = 1.0;
        operator.multiply(&mut x, &mut y);
        for row in 0..count {
            let place = operator.position(row);
            stiffness[(row, column)] = masses[place] * y[place];
        }
        mass[(column, column)] = masses[operator.position(column)];
    }
    [mass, stiffness]
}

/// Consistent `M` and `K` of bricks of 20 nodes in global coordinates, turned into nodal frames at the end.
fn assembled(sector: &SolidSector, model: &SolidModel) -> [Mat<f64>; 2] {
    assert_eq!(model.options.mass, Consistent);
    let [lambda, shear] = model.material.lame_constants();
    let nodes = sector.node_count() * sector.sector_count();
    let mut result = [0, 1].map(|_| Mat::<f64>::zeros(3 * nodes, 3 * nodes));
    for s in 0..sector.sector_count() {
        for element in &sector.elements {
            let element = &element.nodes;
            let numbers = element.iter();
            let numbers: Vec<usize> = numbers.map(|&(n, h)| global(sector, s, n, h)).collect();
            // Unit vectors of each node's frame.
            let frames = element.iter().map(|&(_, half)| {
                let (sin, cos) = (sector.half_angle() * (2 * s + half) as f64).sin_cos();
                [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]
            });
            let frames: Vec<[[f64; 3]; 3]> = frames.collect();
            let places = element.iter().zip(&frames).map(|(&(node, _), [out, ..])| {
                let node = &sector.nodes[node];
                [node.radius * out[0], node.radius * out[1], node.height]
            });
            let places: Vec<[f64; 3]> = places.collect();
            for (at, weight) in Hex20.quadrature() {
                let shapes = Hex20.shape_functions(at);
                let jacobian = nalgebra::Matrix3::from_fn(|i, j| {
                    places.iter().zip(&shapes).map(|(x, shape)| x[i] * shape.1[j]).sum::<f64>()
                });
                let volume = weight * jacobian.determinant();
                let inverse = jacobian.try_inverse().unwrap();
                let gradients = shapes.iter().map(|(_, slope)| {
                    [0, 1, 2].map(|i| (0..3).map(|j| inverse[(j, i)] * slope[j]).sum())
                });
                let gradients: Vec<[f64; 3]> = gradients.collect();
                let dot = |x: [f64; 3], y: [f64; 3]| -> f64 { (0..3).map(|i| x[i] * y[i]).sum() };
                let mass = volume * model.material.density;
                // Two nodes of an element and a direction of each.
                let n = numbers.len();
                let pairs = (0..9 * n * n).map(|k| (k / 9 / n, k / 9 % n, k / 3 % 3, k % 3));
                for (a, b, c, f) in pairs {
                    let (g, h, d, e) = (gradients[a], gradients[b], frames[a][c], frames[b][f]);
                    // sigma(h, e) : grad(g d) of an isotropic body.
                    let turned = dot(g, h) * dot(d, e) + dot(g, e) * dot(h, d);
                    let at = (3 * numbers[a] + c, 3 * numbers[b] + f);
                    result[1][at] += volume * (lambda * dot(g, d) * dot(h, e) + shear * turned);
                    result[0][at] += mass * shapes[a].0 * shapes[b].0 * dot(d, e);
                }
            }
        }
    }
    result
}
