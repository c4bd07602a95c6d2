use super::*;

#[test]
fn shape_functions_are_one_at_their_node_and_sum_to_one() {
    for kind in ElementKind::ALL {
        for (node, place) in kind.node_places().into_iter().enumerate() {
            for (other, (value, _)) in kind.shape_functions(place).into_iter().enumerate() {
                let expected = f64::from(u8::from(node == other));
                assert!((value - expected).abs() < 1e-14, "{kind:?} {node} {other}");
            }
        }
        let shapes = kind.shape_functions([0.3, 0.2, 0.1]);
        assert_eq!(shapes.len(), kind.node_count());
        let sum: f64 = shapes.iter().map(|s| s.0).sum();
        let slopes = [0, 1, 2].map(|axis| shapes.iter().map(|s| s.1[axis]).sum::<f64>());
        assert!((sum - 1.0).abs() < 1e-14 && slopes.iter().all(|s| s.abs() < 1e-13));
    }
}

#[test]
fn slopes_of_shape_functions_are_their_derivatives() {
    for kind in ElementKind::ALL {
        let (at, step) = ([0.3, 0.2, 0.1], 1e-6);
        for axis in 0..kind.dimension() {
            let (mut before, mut after) = (at, at);
            (before[axis], after[axis]) = (at[axis] - step, at[axis] + step);
            let ends = [before, after].map(|place| kind.shape_functions(place));
            for (node, shape) in kind.shape_functions(at).into_iter().enumerate() {
                let difference = (ends[1][node].0 - ends[0][node].0) / (2.0 * step);
                assert!((difference - shape.1[axis]).abs() < 1e-9, "{kind:?} {node}");
            }
        }
    }
}

/// Independent check: `∫ xi^p eta^q zeta^r = p! q! r! / (p + q + r + d)!` over the unit simplex of dimension `d`.
#[test]
fn quadrature_of_simplices_is_exact_to_its_degree() {
    let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
    let rules = [
        (2, ElementKind::Tri3.quadrature(), 2),
        (2, ElementKind::Tri6.quadrature(), 4),
        (3, ElementKind::Tet4.stiffness_quadrature(), 1),
        (3, ElementKind::Tet4.quadrature(), 2),
        (3, ElementKind::Tet10.quadrature(), 5),
    ];
    for (dimension, points, degree) in rules {
        let deepest = if dimension == 3 { degree } else { 0 };
        for (p, q, r) in (0..=degree)
            .flat_map(|p| (0..=degree - p).flat_map(move |q| (0..=deepest).map(move |r| (p, q, r))))
        {
            if p + q + r > degree {
                continue;
            }
            let term = |&([x, y, z], w): &QuadraturePoint| {
                w * x.powi(p as i32) * y.powi(q as i32) * z.powi(r as i32)
            };
            let sum: f64 = points.iter().map(term).sum();
            let exact =
                factorial(p) * factorial(q) * factorial(r) / factorial(p + q + r + dimension);
            assert!((sum - exact).abs() < 1e-15, "{dimension} {degree} {p} {q} {r}: {sum} {exact}");
        }
    }
}

/// The faces of an element close: the sum of their area vectors is zero, and each points away from its middle.
#[test]
fn faces_point_outwards_and_close_around_every_element() {
    for kind in ElementKind::ALL {
        let places = kind.node_places();
        let count = kind.corner_count() as f64;
        let center: [f64; 3] = std::array::from_fn(|axis| {
            places[..kind.corner_count()].iter().map(|p| p[axis]).sum::<f64>() / count
        });
        let mut sum = [0.0; 3];
        for (face, nodes) in kind.faces() {
            assert_eq!(face.node_count(), nodes.len());
            let points: Vec<[f64; 3]> = nodes.iter().map(|&node| places[node]).collect();
            // Mid-side nodes of a straight face lie at the middle of their edges.
            for (middle, ends) in face.middles().map(|(m, ends)| (points[m], ends)) {
                let ends = ends.map(|end| points[end]);
                for axis in 0..3 {
                    assert_eq!(middle[axis], 0.5 * (ends[0][axis] + ends[1][axis]));
                }
            }
            for point in face.quadrature() {
                let place = face.at(&points, point);
                let outward: f64 = (0..3)
                    .map(|axis| place.area[axis] * (place.position[axis] - center[axis]))
                    .sum();
                assert!(outward > 0.0, "{kind:?} {nodes:?}");
                (0..3).for_each(|axis| sum[axis] += place.area[axis]);
            }
        }
        assert!(sum.iter().all(|s| s.abs() < 1e-14), "{kind:?} {sum:?}");
    }
}

/// Independent check: `∫ xi^p eta^q zeta^r` over the pyramid is `4 B(r + 1, p + q + 3) / ((p + 1)(q + 1))` for even powers.
#[test]
fn quadrature_of_pyramids_is_exact_to_its_degree() {
    let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
    for (kind, degree) in [(ElementKind::Pyramid5, 3), (ElementKind::Pyramid13, 5)] {
        let points = kind.quadrature();
        for (p, q) in (0..=degree).flat_map(|p| (0..=degree - p).map(move |q| (p, q))) {
            for r in 0..=degree - p - q {
                let term = |&([x, y, z], w): &QuadraturePoint| {
                    w * x.powi(p as i32) * y.powi(q as i32) * z.powi(r as i32)
                };
                let sum: f64 = points.iter().map(term).sum();
                let is_even = p % 2 == 0 && q % 2 == 0;
                let beta = factorial(r) * factorial(p + q + 2) / factorial(p + q + r + 3);
                let exact =
                    4.0 * beta * f64::from(u8::from(is_even)) / f64::from((p + 1) * (q + 1));
                assert!((sum - exact).abs() < 1e-15, "{kind:?} {p} {q} {r}: {sum} {exact}");
            }
        }
    }
}

#[test]
fn elements_written_to_universal_files_are_read_as_they_were() {
    for kind in ElementKind::ALL {
        let nodes: Vec<u32> = (10..).take(kind.node_count()).collect();
        let Some((descriptor, listed)) = kind.universal(&nodes) else {
            assert!(kind.dimension() == 1 || kind.name().starts_with("pyramid"), "{kind:?}");
            continue;
        };
        let found = ElementKind::listed(|row| row.universal.names.contains(&descriptor));
        let found = found.unwrap();
        assert_eq!(found.node_count(), kind.node_count(), "{kind:?}");
        assert_eq!(found.row().universal.arranged(&listed), nodes, "{kind:?}");
    }
}
