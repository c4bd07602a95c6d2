//! Derivatives of the free modes of undamped parts.

use crate::*;
use frictionsim_case::VariedKey;
use frictionsim_physics::fem::{assemble_mass, assemble_stiffness};

/// Step of a parameter for the differences of the matrices, relative to its value, or of a Poisson's ratio of 0.
pub(super) const STEP: f64 = 1e-4;

/// The body of a case, where it is a part that nothing holds, damps or touches.
pub(super) fn free_part(case: &Case) -> Option<&AssemblyBody> {
    let body = case.body.assembly()?;
    let rayleigh = case.damping.rayleigh;
    let is_damped = rayleigh.mass_coefficient != 0.0 || rayleigh.stiffness_coefficient != 0.0;
    let has_own = case.body.materials.iter().any(|material| material.damping.is_some());
    let is_plain = !is_damped && !has_own && !case.has_structural_damping();
    let is_plain = is_plain && (body.ties.is_empty() || case.mass() == MassKind::Consistent);
    let is_plain = is_plain && body.mesh.attachments.is_empty() && body.mesh.patches.is_empty();
    let assembled = || body.assembled(case.materials(), MassKind::Consistent);
    (is_plain && assembled().is_ok_and(|own| own.is_free())).then_some(body)
}

/// Derivatives of the eigenvalues of modes with shapes by each parameter,
///
/// ```text
/// d omega / d p = phi^T (dK/dp - omega^2 dM/dp) phi / (2 omega phi^T M phi)
/// ```
///
/// with central differences of the matrices, for which the case is read with the parameter a little larger and smaller;
/// `None` where it cannot be.
pub(super) fn rates<'p>(
    case: &Case,
    kind: MassKind,
    modes: &[ComplexMode],
    parameters: impl Iterator<Item = (&'p VariedKey, f64)>,
) -> Vec<Vec<Option<c64>>> {
    let forms = |case: &Case, mode: &ComplexMode, [mass, stiffness]: &[Triplets; 2]| {
        let shape = mode.shape.as_ref()?;
        let count = case.body.assembly()?.mesh.dof_count();
        let x: Vec<f64> = shape.iter().map(|v| v.re).collect();
        let form = |matrix: &Triplets| -> f64 {
            let image = matrix.multiply(count, &x);
            x.iter().zip(image).map(|(a, b)| a * b).sum()
        };
        Some([form(mass), form(stiffness)])
    };
    let matrices = |case: &Case| -> Option<[Triplets; 2]> {
        let (mesh, materials) = (&case.body.assembly()?.mesh, case.materials());
        Some([assemble_mass(mesh, materials, kind), assemble_stiffness(mesh, materials)])
    };
    let own = matrices(case);
    let by_parameter = parameters.map(|(parameter, value)| {
        let step = STEP * if value == 0.0 { 1.0 } else { value };
        let side =
            |sign: f64| matrices(&case.with_parameters([(parameter, value + sign * step)]).ok()?);
        let sides = side(1.0).zip(side(-1.0));
        let rate = |mode: &ComplexMode| {
            let (above, below) = sides.as_ref()?;
            let [m, _] = forms(case, mode, own.as_ref()?)?;
            let [above, below] = [forms(case, mode, above)?, forms(case, mode, below)?];
            let [dm, dk] = [0, 1].map(|k| (above[k] - below[k]) / (2.0 * step));
            let omega = mode.eigenvalue.im;
            Some(c64::new(0.0, (dk - omega * omega * dm) / (2.0 * omega * m)))
        };
        modes.iter().map(rate).collect::<Vec<_>>()
    });
    by_parameter.collect()
}
