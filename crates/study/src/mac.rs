//! Modal assurance of measured shapes against the modes of a case.

use super::eigenvalues::{SlidingModel, solve};
use super::fit::least_cost;
use crate::*;
use frictionsim_results::mac::{MacMode, MacPair, MacShape, MacSummary};
use frictionsim_signal::reader::MeasuredShape;

/// Distance from the nearest node, as a share of half the body's size, beyond which a point lies off the body.
const FAR: f64 = 0.05;
/// Relative distance of eigenvalues that are one.
const EQUAL: f64 = 1e-6;
/// Factors to metres that a file may have been written without, with the units.
const UNITS: [(f64, &str); 4] =
    [(1e-3, "millimetres"), (1e-2, "centimetres"), (0.0254, "inches"), (1e3, "kilometres")];

/// Measured shapes, and the factor that takes their coordinates to metres.
#[derive(Clone, Debug)]
pub struct MeasuredShapes {
    /// The shapes.
    pub shapes: Vec<MeasuredShape>,
    /// The factor.
    pub scale: f64,
}

/// Modal assurance criterion
///
/// ```text
/// MAC = |phi^H y|^2 / (phi^H phi  y^H y)
/// ```
///
/// of every measured shape `y` with every mode `phi` at the case's friction coefficient, of modes with one eigenvalue,
/// as of a disc at rest, with the space of all of them, over the measured points,
/// each at its nearest node, and directions; each shape is paired with one mode so that the sum is largest. Points
/// off the body are left out, and said. The source of the shapes is left open.
///
/// Source: R. J. Allemang, The modal assurance criterion: twenty years of use and abuse, Sound and Vibration 37 (2003).
///
/// # Errors
/// Points none of which lie on the body; those of the solver.
pub fn assurance(case: &Case, shapes: &MeasuredShapes) -> Result<MacSummary, StudyError> {
    let cea = case.require_cea()?;
    let mut notes = whole_mesh_note(case);
    let case = &*case.on_whole_mesh()?;
    let friction = case.contact.sliding.friction_coefficient;
    let own = Cea {
        friction_coefficients: vec![friction],
        shapes_at: vec![friction],
        sensitivities: Some(false),
        count_modes: false,
        ..cea.clone()
    };
    let model = SlidingModel::new(case, &own)?;
    // Before anything is solved.
    let placed = shapes.placed(case, &model.mesh)?;
    let solution = solve(case, &own, &model, None)?;
    let modes = solution.sweep.modes_at(friction).iter();
    let modes: Vec<_> = modes.filter(|mode| mode.shape.is_some()).collect();

    let listed = |(index, mode): (usize, &&ComplexMode)| MacMode {
        mode: index + 1,
        frequency_hz: mode.frequency_hz(),
        real_hz: mode.real_hz(),
        harmonic: mode.diameters(case.body.has_sectors()),
    };

    // The matrix and the pairs.
    let matrix = shapes.criteria(&model.mesh, &modes, &placed);
    notes.extend(placed.iter().filter_map(|own| own.note(case.body.size())));
    Ok(MacSummary {
        measurement: String::new(),
        friction_coefficient: friction,
        pairs: paired(&matrix),
        shapes: placed.into_iter().map(|own| own.shape).collect(),
        modes: modes.iter().enumerate().map(listed).collect(),
        mac: matrix,
        notes,
    })
}

/// Says of a body of revolution that its whole mesh is solved.
pub(crate) fn whole_mesh_note(case: &Case) -> Vec<String> {
    let note =
        "this body of revolution was solved on its whole mesh, as with cea.method = \"sparse\"";
    case.body.revolution().map(|_| note.to_owned()).into_iter().collect()
}

/// Measured points that a fit compares with its own modes are nodes of the whole mesh.
pub(crate) fn refuse_revolution(case: &Case) -> Result<(), StudyError> {
    if case.body.revolution().is_none() {
        return Ok(());
    }
    Err(refusal!(case, "material.formulation",
        "measured points are compared node by node, and the modes of this body are solved harmonic \
         by harmonic, either sense of travel alone";
        "a body of revolution in three dimensions"; "take its whole mesh: cea.method = \"sparse\"")
    .into())
}

impl MeasuredShapes {
    /// The nodes of the points of each shape.
    pub(crate) fn placed(&self, case: &Case, mesh: &Mesh) -> Result<Vec<Placed>, StudyError> {
        self.shapes.iter().map(|shape| Placed::of(case, mesh, shape, self.scale)).collect()
    }

    /// The criterion of every shape with every mode, `[shape][mode]`.
    pub(crate) fn criteria(
        &self,
        mesh: &Mesh,
        modes: &[&ComplexMode],
        placed: &[Placed],
    ) -> Vec<Vec<f64>> {
        // The shapes of the modes that have one eigenvalue with each.
        let alike = modes.iter().map(|own| {
            let away = |other: &&&ComplexMode| (other.eigenvalue - own.eigenvalue).norm();
            let alike = modes.iter().filter(|other| away(other) <= EQUAL * own.eigenvalue.norm());
            alike.map(|other| other.shape.as_deref().unwrap_or_default()).collect()
        });
        let alike: Vec<Vec<&[c64]>> = alike.collect();
        let row = |(shape, placed): (&MeasuredShape, &Placed)| -> Vec<f64> {
            alike.iter().map(|modes| criterion(mesh, modes, shape, placed)).collect()
        };
        self.shapes.iter().zip(placed).map(row).collect()
    }
}

/// The nodes of a shape's points.
pub(crate) struct Placed {
    /// Node of each point; none where it lies off the body.
    nodes: Vec<Option<usize>>,
    /// What there is to say of them.
    shape: MacShape,
}

impl Placed {
    fn of(case: &Case, mesh: &Mesh, shape: &MeasuredShape, scale: f64) -> Result<Self, StudyError> {
        let reach = FAR * case.body.size();
        let nearest = |factor: f64| -> Vec<(usize, f64)> {
            shape.points.iter().map(|point| nearest_node(mesh, point.map(|x| factor * x))).collect()
        };
        let own = nearest(scale);
        let off = own.iter().filter(|(_, away)| *away > reach).count();
        if 2 * off > own.len() {
            let fits = |(factor, _): &&(f64, &str)| {
                let there = nearest(scale * factor);
                let near = there.iter().filter(|(_, away)| *away <= reach).count();
                // Points shrunk into one place are near to anything.
                let nodes: BTreeSet<usize> = there.iter().map(|(node, _)| *node).collect();
                10 * near >= 9 * there.len() && 2 * nodes.len() > there.len()
            };
            return Err(off_body(case, shape, (off, &own), UNITS.iter().find(fits)).into());
        }
        Ok(Self {
            nodes: own.iter().map(|(node, away)| (*away <= reach).then_some(*node)).collect(),
            shape: MacShape {
                name: shape.name.clone(),
                frequency_hz: shape.frequency_hz,
                points: own.len(),
                off_body: off,
                largest_distance_m: own.iter().fold(0.0, |m, (_, away)| m.max(*away)),
            },
        })
    }

    /// What is to be said of its points.
    fn note(&self, size: f64) -> Option<String> {
        let MacShape { name, points, off_body, largest_distance_m: farthest, .. } = &self.shape;
        (*off_body > 0).then(|| {
            format!(
                "shape {name}: {off_body} of {points} points lie off the body, up to \
                 {farthest:.3e} m from it (more than {:.1e} m), and are left out",
                FAR * size
            )
        })
    }
}

/// Most points lie off the body: in which unit they would not.
fn off_body(
    case: &Case,
    shape: &MeasuredShape,
    (off, own): (usize, &[(usize, f64)]),
    unit: Option<&(f64, &str)>,
) -> CaseErrors {
    let farthest = own.iter().fold(0.0_f64, |m, (_, away)| m.max(*away));
    let other =
        "give the points in metres in the coordinates of the case's mesh, or --scale FACTOR";
    let help = unit.map_or_else(
        || other.to_owned(),
        |(factor, unit)| format!("the points would lie on it in {unit}: add --scale {factor}"),
    );
    let key = if case.raw.find("mesh.file").is_some() { "mesh.file" } else { "geometry" };
    refusal!(case, key,
        "shape {}: {off} of {} points lie off the body, up to {farthest:.3e} m from its nearest \
         node", shape.name, own.len(); "half its size is {:.3e} m", case.body.size(); "{help}")
}

fn nearest_node(mesh: &Mesh, point: [f64; 3]) -> (usize, f64) {
    let d = mesh.dimension;
    let away = |node: &[f64; 3]| -> f64 { (0..d).map(|k| (node[k] - point[k]).powi(2)).sum() };
    let nearest = mesh.nodes.iter().map(away).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map_or((0, f64::INFINITY), |(node, square)| (node, square.sqrt()))
}

/// The criterion of one shape with the space of modes over all dofs in nodal frames, `b^H G^-1 b / y^H y` of
/// `b = Phi^H y` and `G = Phi^H Phi`.
fn criterion(mesh: &Mesh, modes: &[&[c64]], shape: &MeasuredShape, placed: &Placed) -> f64 {
    let (d, count) = (mesh.dimension, modes.len());
    let (mut products, mut own) = (DVector::zeros(count), DMatrix::zeros(count, count));
    let mut measured = 0.0;
    let points = shape.motion.iter().zip(&placed.nodes);
    for (motion, node) in points.filter_map(|(motion, node)| Some((motion, (*node)?))) {
        let frame = mesh.frame(node);
        let part = |mode: &[c64], of: fn(&c64) -> f64| {
            let mut local = Vector3::zeros();
            (0..d).for_each(|k| local[k] = of(&mode[d * node + k]));
            frame * local
        };
        let moved = modes.iter().map(|mode| [part(mode, |z| z.re), part(mode, |z| z.im)]);
        let moved: Vec<[Vector3<f64>; 2]> = moved.collect();
        for (axis, y) in motion.iter().enumerate() {
            let Some(y) = y else { continue };
            let along = moved.iter().map(|[re, im]| c64::new(re[axis], im[axis]));
            let phi = DVector::from_iterator(count, along).conjugate();
            products += &phi * *y;
            own += &phi * phi.adjoint();
            measured += y.norm_sqr();
        }
    }
    // Modes that are one at the measured points span less.
    let least = f64::EPSILON * own.norm();
    let found = own.pseudo_inverse(least).map(|inverse| products.dotc(&(inverse * &products)).re);
    if measured > 0.0 { found.unwrap_or(0.0) / measured } else { 0.0 }
}

/// Pairs of shapes and modes with the largest sum of the criterion.
fn paired(matrix: &[Vec<f64>]) -> Vec<MacPair> {
    let (rows, columns) = (matrix.len(), matrix.first().map_or(0, Vec::len));
    // Those of which there are fewer each find one of the others.
    let places = |few: usize, many: usize| if rows <= columns { (few, many) } else { (many, few) };
    let cost = |(shape, mode): (usize, usize)| 1.0 - matrix[shape][mode];
    let row = |few: usize| (0..rows.max(columns)).map(|many| cost(places(few, many))).collect();
    let costs: Vec<Vec<f64>> = (0..rows.min(columns)).map(row).collect();
    let pairs = least_cost(&costs).into_iter().enumerate().map(|(few, many)| places(few, many));
    let mut pairs: Vec<MacPair> = pairs
        .map(|(shape, mode)| MacPair { shape: shape + 1, mode: mode + 1, mac: matrix[shape][mode] })
        .collect();
    pairs.sort_by_key(|pair| pair.shape);
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form: a standing wave is wholly in the space of two travelling ones of a disc at rest, and half in each.
    #[test]
    fn a_standing_wave_agrees_with_the_two_travelling_ones_together() {
        let cases = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases");
        let bytes = std::fs::read(format!("{cases}/polycarbonate-disc.toml")).unwrap();
        let sets = ["mesh.circumferential_elements=24", "mesh.radial_elements=2"];
        let case = Case::parse("disc", &bytes, &sets.map(str::to_owned)).unwrap();
        let mesh = case.body.mesh().unwrap();
        let angle = |node: &[f64; 3]| node[1].atan2(node[0]);
        let travelling = [2.0, -2.0].map(|n: f64| -> Vec<c64> {
            let nodes = mesh.nodes.iter();
            nodes.flat_map(|node| [c64::from_polar(1.0, n * angle(node)), c64::ZERO]).collect()
        });
        let standing = |node: &[f64; 3]| {
            let radial = (2.0 * angle(node) + 0.3).cos();
            [radial * angle(node).cos(), radial * angle(node).sin(), 0.0].map(|u| Some(u.into()))
        };
        let shape = MeasuredShape {
            name: String::new(),
            frequency_hz: None,
            points: mesh.nodes.clone(),
            motion: mesh.nodes.iter().map(standing).collect(),
        };
        let placed = Placed::of(&case, &mesh, &shape, 1.0).unwrap();
        let [one, other] = travelling.each_ref().map(Vec::as_slice);
        for (modes, expected) in [(vec![one], 0.5), (vec![one, other], 1.0), (vec![one, one], 0.5)]
        {
            let found = criterion(&mesh, &modes, &shape, &placed);
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }
}
