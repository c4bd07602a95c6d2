//! Search of a case for the basin boundary of two waves, or of two modes of a body without symmetry.
//! `cargo run --example studies` runs one.

use super::cycle::{Steady, disc_model, longest_step, operating_point};
use super::transient::SteppedMesh;
use crate::*;
use frictionsim_physics::cycle::periodic::{GrowingMode, ModeContest, PeriodMap};
use frictionsim_physics::cycle::{BasinBoundary, BasinRequest};
use frictionsim_physics::transient::OperatorChoice;
use frictionsim_results::basin::BasinSummary;

/// Bisects for the amplitude ratio at saturation that decides between the two rivals of `[basin]`.
///
/// # Errors
/// [`StudyError::Case`] for a case without `[basin]`; steady sliding of rotating waves that is stable; a transient that
/// cannot start.
pub fn boundary(case: &Case, simd: SimdLevel) -> Result<BasinBoundary, StudyError> {
    Ok(contest(case, simd)?.1)
}

/// The rivals, nodal diameters of waves or numbers of modes, and the boundary between them.
fn contest(case: &Case, simd: SimdLevel) -> Result<([usize; 2], BasinBoundary), StudyError> {
    let request = case.require_basin()?;
    if !case.has_rotating_waves() {
        return boundary_of_modes(case, request, simd);
    }
    Ok((request.harmonics, disc_model(case)?.basin(&operating_point(case), request, simd)?))
}

/// As [`boundary`], in the words of its results.
pub fn summary(case: &Case, manifest: &Manifest) -> Result<BasinSummary, StudyError> {
    let (rivals, found) = contest(case, SimdLevel::choose(&manifest.simd)?)?;
    Ok(BasinSummary::new(rivals, !case.has_rotating_waves(), found))
}

/// The boundary between the basins of two modes that grow, or of one and steady sliding; their numbers (0: sliding).
pub fn boundary_of_modes(
    case: &Case,
    request: &BasinRequest,
    simd: SimdLevel,
) -> Result<([usize; 2], BasinBoundary), StudyError> {
    let stepped = SteppedMesh::of(case)?;
    let steady = Steady::of(case, &stepped)?;
    let places = rivals(case, request, &steady)?;
    let modes: Vec<(usize, GrowingMode<'_>)> =
        places.into_iter().map(|place| (place + 1, steady.mode(place))).collect();
    let body = stepped.body(case);
    let operator = body.operator(OperatorChoice::Auto, simd)?;
    let fastest = modes.iter().map(|(_, mode)| mode.eigenvalue.im).fold(0.0, f64::max);
    let map = PeriodMap::new(body, operator.as_ref(), fastest, longest_step(case))?;
    let mut contest = ModeContest::new(map, &modes, request);
    let rivals = contest.rivals();
    Ok((rivals, request.boundary(rivals, |ratio| Ok::<_, StudyError>(contest.run(ratio)))?))
}

/// Places of the modes that compete: those asked for, else the two that grow fastest, else the least stable one.
fn rivals(case: &Case, request: &BasinRequest, steady: &Steady) -> Result<Vec<usize>, StudyError> {
    let growing = steady.growing();
    if let (true, Some(above)) = (growing.is_empty(), steady.above_hz) {
        return Err(StudyError::Case(refusal!(case, "basin",
            "a mode of {above:.0} Hz, above the {} looked at, grows, and none of these does", steady.modes.len();
            "among modes that decay"; "raise cea.modes, or cea.max_frequency_hz")));
    }
    let Some(asked) = &request.modes else {
        return Ok(match growing.len() {
            0 => steady.least_stable().into_iter().collect(),
            _ => growing.into_iter().take(2).collect(),
        });
    };
    let count = steady.modes.len();
    if let Some(beyond) = asked.iter().find(|&&mode| mode > count) {
        return Err(StudyError::Case(refusal!(case, "basin.modes",
            "basin.modes: there is no mode {beyond}, {count} are looked at"; "1 to {count}";
            "raise cea.modes, or cea.max_frequency_hz")));
    }
    let still = asked.iter().find(|&&mode| !growing.contains(&(mode - 1)));
    if let ([_, _], Some(still)) = (&asked[..], still) {
        let numbers = number_ranges(&growing.iter().map(|place| place + 1).collect::<Vec<_>>());
        return Err(StudyError::Case(refusal!(case, "basin.modes",
            "basin.modes: mode {still} does not grow at contact.friction_coefficient = {}, and wins from no small \
             start (modes that grow: {})", case.contact.sliding.friction_coefficient,
            if growing.is_empty() { "none" } else { &numbers };
            "two modes that grow"; "name others, or one mode alone against steady sliding")));
    }
    Ok(asked.iter().map(|mode| mode - 1).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use frictionsim_physics::cycle::periodic::{ACCEPTED, find_from, shortest};
    use std::fmt::Write;

    /// A block of 35 unknowns under friction that falls with speed; three times the frequency of mode 1 is near that of
    /// mode 2.
    fn block(overrides: &[&str]) -> Case {
        let mut mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n".to_owned();
        mesh += "$PhysicalNames\n3\n2 1 \"body\"\n1 2 \"face\"\n1 3 \"back\"\n$EndPhysicalNames\n$Nodes\n20\n";
        for i in 0..20 {
            let (x, y) = (0.01 * f64::from(i % 5), 0.01 * f64::from(i / 5));
            writeln!(mesh, "{} {x} {y} 0", i + 1).unwrap();
        }
        mesh += "$EndNodes\n$Elements\n20\n";
        for e in 0..12 {
            let corner = 1 + e % 4 + 5 * (e / 4);
            let corners = [corner, corner + 1, corner + 6, corner + 5].map(|n| n.to_string());
            writeln!(mesh, "{} 3 2 1 1 {}", e + 1, corners.join(" ")).unwrap();
        }
        for e in 0..8 {
            let (group, corner) = if e < 4 { (2, e + 1) } else { (3, e + 12) };
            writeln!(mesh, "{} 1 2 {group} {group} {corner} {}", e + 13, corner + 1).unwrap();
        }
        let path =
            std::env::temp_dir().join(format!("block-{:?}.msh", std::thread::current().id()));
        std::fs::write(&path, mesh + "$EndElements\n").unwrap();
        let text = format!(
            "mesh.file = {path:?}\n\
             boundaries.back = {{ condition = \"support\", normal_stiffness = 1e12, tangential_stiffness = 1e12 }}\n\
             material = {{ young_modulus = 2.5e9, poisson_ratio = 0.38, density = 1228.0 }}\n\
             damping = {{ mass_coefficient = 40.0, stiffness_coefficient = 1e-6 }}\n\
             contact = {{ boundary = \"face\", counterface = \"plane\", direction = [1.0, 0.0], speed = 1.5, \
                 friction_coefficient = 0.3, static_friction_ratio = 1.6, decay_speed = 1.0, interference = 3e-5 }}\n\
             cea = {{ friction_coefficients = [0.3], modes = 10, mass = \"lumped\", geometric_stiffness = false }}\n"
        );
        let overrides: Vec<String> = overrides.iter().map(|own| (*own).to_owned()).collect();
        let case = Case::parse("block", text.as_bytes(), &overrides);
        std::fs::remove_file(path).unwrap();
        case.unwrap()
    }

    /// Whole multiples of a period are none of their own, though the motion repeats itself over them.
    #[test]
    fn a_cycle_is_told_over_its_shortest_period() {
        let case = block(&[]);
        let stepped = SteppedMesh::of(&case).unwrap();
        let steady = Steady::of(&case, &stepped).unwrap();
        let mode = steady.mode(steady.growing()[0]);
        let body = stepped.body(&case);
        let operator = body.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
        let mut map = PeriodMap::new(body, operator.as_ref(), mode.eigenvalue.im, None).unwrap();
        let own = find_from(&mut map, &mode).unwrap();
        for count in 2..=5 {
            let mut told = own.clone();
            (told.state.period, told.steps) = (count as f64 * own.state.period, count * own.steps);
            map.step_in(told.steps);
            let found = shortest(&mut map, told);
            assert!((found.state.period / own.state.period - 1.0).abs() < 1e-6, "{count}");
            assert!(found.residual <= ACCEPTED && map.steps() == found.steps, "{count}");
        }
    }

    /// The third harmonic of the cycle of mode 1 has the shape of mode 2, whose amplitude stays at 12 % and goes up and
    /// down with where looks fall: that is an end. It ran for all 2000 periods, 0.32 s.
    #[test]
    fn an_overtone_of_the_winner_leaves_nothing_open() {
        let case = block(&["basin.modes=[1,2]"]);
        let found = boundary(&case, SimdLevel::detect()).unwrap();
        for run in found.runs {
            assert!(run.winner == 1 && run.is_settled && run.duration_s < 0.1, "{run:?}");
        }
        // Its eigenvalue analysis takes 22 MB, measured; 125 were announced.
        let (bytes, _) = case.memory("cea");
        assert!((2e7..4.5e7).contains(&bytes), "{bytes}");
    }
}
