//! Quadrature rules of the parent elements.

/// A point of the parent element and its weight.
pub type QuadraturePoint = ([f64; 3], f64);

/// Place of the two Gauss points, `1 / sqrt(3)`.
pub(super) const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Two Gauss points on `-1 <= x <= 1`, with weights.
pub(super) const TWO: [(f64, f64); 2] = [(-GAUSS, 1.0), (GAUSS, 1.0)];

/// Three Gauss points.
pub(super) const THREE: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Gauss-Jacobi points of `∫ f(c) c^2 dc` over `0 <= c <= 1`, exact to degree 3: `c = 2/3 -+ sqrt(2/45)`.
pub(super) const TWO_TO_APEX: [(f64, f64); 2] = [
    (0.455_848_155_988_774_7, 0.100_785_882_079_825_43),
    (0.877_485_177_344_558_6, 0.232_547_451_253_507_9),
];

/// The same, exact to degree 5.
pub(super) const THREE_TO_APEX: [(f64, f64); 3] = [
    (0.294_997_790_111_501_6, 0.029_950_703_008_580_7),
    (0.652_996_233_961_648_1, 0.146_246_269_259_866_02),
    (0.927_005_975_926_850_3, 0.157_136_361_064_886_62),
];

/// Gauss points of a line.
pub(super) fn line(points: &[(f64, f64)]) -> Vec<QuadraturePoint> {
    points.iter().map(|&(x, w)| ([x, 0.0, 0.0], w)).collect()
}

/// Gauss points of a square.
pub(super) fn square(points: &[(f64, f64)]) -> Vec<QuadraturePoint> {
    points
        .iter()
        .flat_map(|&(y, v)| points.iter().map(move |&(x, w)| ([x, y, 0.0], w * v)))
        .collect()
}

/// Gauss points of a cube.
pub(super) fn cube(points: &[(f64, f64)]) -> Vec<QuadraturePoint> {
    prism(&square(points), points)
}

/// A rule of the section times one of the line.
pub(super) fn prism(section: &[QuadraturePoint], line: &[(f64, f64)]) -> Vec<QuadraturePoint> {
    line.iter()
        .flat_map(|&(z, v)| section.iter().map(move |&([x, y, _], w)| ([x, y, z], w * v)))
        .collect()
}

/// A rule of the square in each section of a pyramid times one over the distance `c` to the apex, whose weight is `c^2`.
pub(super) fn pyramid(section: &[(f64, f64)], to_apex: &[(f64, f64)]) -> Vec<QuadraturePoint> {
    let shrunk = |([x, y, c], w): QuadraturePoint| ([c * x, c * y, 1.0 - c], w);
    prism(&square(section), to_apex).into_iter().map(shrunk).collect()
}

/// The places of a rule.
pub(super) fn places(rule: Vec<QuadraturePoint>) -> Vec<[f64; 3]> {
    rule.into_iter().map(|point| point.0).collect()
}

/// Three points, exact for polynomials of degree 2.
pub(super) fn triangle_three() -> Vec<QuadraturePoint> {
    const SIX: f64 = 1.0 / 6.0;
    vec![([SIX, SIX, 0.0], SIX), ([4.0 * SIX, SIX, 0.0], SIX), ([SIX, 4.0 * SIX, 0.0], SIX)]
}

/// Two triples of points, each the orbit of one; exact for polynomials of degree 4 (Dunavant 1985).
pub(super) fn triangle_six() -> Vec<QuadraturePoint> {
    let root = 10.0_f64.sqrt();
    let spread = (38.0 - 44.0 * 0.4_f64.sqrt()).sqrt();
    let share = (213_125.0 - 53_320.0 * root).sqrt();
    let orbit = |sign: f64| {
        let a = (8.0 - root + sign * spread) / 18.0;
        let weight = 0.5 * (620.0 + sign * share) / 3720.0;
        [(a, a), (1.0 - 2.0 * a, a), (a, 1.0 - 2.0 * a)].map(|(xi, eta)| ([xi, eta, 0.0], weight))
    };
    [orbit(1.0), orbit(-1.0)].concat()
}

/// The centre, exact for degree 1.
pub(super) fn tetrahedron_one() -> Vec<QuadraturePoint> {
    vec![([0.25; 3], 1.0 / 6.0)]
}

/// The four points whose volume coordinates are `1 - 3 a` once and `a` thrice.
fn vertex_orbit(a: f64, weight: f64) -> [QuadraturePoint; 4] {
    let b = 1.0 - 3.0 * a;
    [[a, a, a], [b, a, a], [a, b, a], [a, a, b]].map(|place| (place, weight))
}

/// Four points, exact for degree 2.
pub(super) fn tetrahedron_four() -> Vec<QuadraturePoint> {
    vertex_orbit((5.0 - 5.0_f64.sqrt()) / 20.0, 1.0 / 24.0).to_vec()
}

/// Fourteen points with positive weights, exact for degree 5 (Walkington 2000, Grundmann and Moeller's count).
pub(super) fn tetrahedron_fourteen() -> Vec<QuadraturePoint> {
    const SIXTH: f64 = 1.0 / 6.0;
    let corners = vertex_orbit(0.092_735_250_310_891_23, SIXTH * 0.073_493_043_116_361_95);
    let faces = vertex_orbit(0.310_885_919_263_300_6, SIXTH * 0.112_687_925_718_015_85);
    // Volume coordinates `a` twice and `1/2 - a` twice.
    let (a, weight) = (0.045_503_704_125_649_65, SIXTH * 0.042_546_020_777_081_47);
    let b = 0.5 - a;
    let edges = [[a, a, b], [a, b, a], [b, a, a], [a, b, b], [b, a, b], [b, b, a]];
    let edges = edges.map(|place| (place, weight));
    [&corners[..], &faces, &edges].concat()
}
