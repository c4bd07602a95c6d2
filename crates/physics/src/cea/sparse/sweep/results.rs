//! What a sweep found: points, unstable intervals, shapes.

use super::onset::{FoundInterval, doubt};
use crate::cea::sparse::*;

impl SparseSweep<'_> {
    /// The result, with shapes and critical friction coefficients.
    pub fn finish(
        &mut self,
        request: &SweepRequest<'_>,
        branches: &[TrackedBranch],
    ) -> Result<FrictionSweep, CeaError> {
        let lefts_at = request.lefts_at.and_then(|mu| self.grid.iter().position(|&own| own == mu));
        lefts_at.into_iter().for_each(|k| self.sharpen_lefts(k));
        let frictions = request.friction_coefficients.iter();
        let points: Vec<FrictionPoint> = frictions
            .map(|&mu| {
                let k = self.grid.partition_point(|&g| g < mu);
                let wanted = [request.shapes_at.contains(&mu), request.lefts_at == Some(mu)];
                self.friction_point(k, wanted, branches)
            })
            .collect();
        let mut found = self.intervals(branches)?;
        // What grows by no more than rounded matrices leave open, wherever that was asked for, is told where it goes on alone: two branches
        // that meet may have one onset, of which one grows on, or one of them has no end.
        let is_told = |own: &UnstableInterval| {
            let end = own.restabilized.map_or(f64::INFINITY, |(mu, _)| mu);
            let (range, name) = (own.critical_friction..=end, (own.harmonic, own.branch));
            let inside = points.iter().filter(|point| range.contains(&point.friction_coefficient));
            let modes = inside.flat_map(|point| &point.modes);
            let mut modes = modes.filter(|mode| (mode.harmonic, mode.branch) == name).peekable();
            modes.peek().is_none() || modes.any(ComplexMode::is_unstable)
        };
        let onset = |own: &UnstableInterval| [own.critical_friction, own.frequency_hz];
        let known = found.iter().map(|own| &own.interval);
        let known = known.filter(|own| own.restabilized.is_some() || is_told(own));
        let known: Vec<[f64; 2]> = known.map(onset).collect();
        let highest = self.grid[self.grid.len() - 1];
        found.retain(|FoundInterval { interval: own, .. }| {
            let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME_EIGENVALUE * b;
            let mut others = known.iter().map(|other| other.iter().zip(&onset(own)).all(is_near));
            let goes_on = own.is_located() && own.restabilized.is_none();
            let is_alone = own.critical_friction * (1.0 + SAME_EIGENVALUE) < highest; // Where the range ends nothing goes on.
            is_told(own) || goes_on && is_alone && !others.any(|is_same| is_same)
        });
        let vectors = |own: &FoundInterval| {
            let ModeAt { mu, mode } = own.onset().filter(|_| request.lefts_at.is_some())?;
            self.vectors((*mu, true), std::slice::from_ref(mode)).pop()
        };
        let crossed = |own: &FoundInterval| UnstableInterval {
            crossing: vectors(own),
            ..own.interval.clone()
        };
        let mut found: Vec<UnstableInterval> = crate::parallel::map(&found, crossed);
        found.extend(self.divergence(branches)?);
        Ok(FrictionSweep {
            unconverged: self.unconverged.clone(),
            rigid_motions: self.builder.rigid,
            ..FrictionSweep::joined(points, found, self.ended(branches))
        })
    }

    /// The modes whose branches end.
    fn ended(&self, branches: &[TrackedBranch]) -> Vec<EndedMode> {
        let ended = branches.iter().filter_map(|branch| {
            let end = branch.end.as_ref().filter(|end| end.diverges_at.is_none())?;
            let point = &self.points[end.after];
            let last = branch.modes[end.after]?;
            let next = &self.points[end.after + 1];
            Some(EndedMode {
                frequency_hz: point.modes[last].eigenvalue.im / TAU,
                friction_coefficient: point.friction_coefficient,
                lost_before: (!end.is_damped).then_some(next.friction_coefficient),
            })
        });
        ended.collect()
    }

    /// Unstable intervals of all branches. The basis holds the modes of a few friction coefficients only, or of all that were asked for:
    /// the modes at crossings are corrected by the full problem there until these settle.
    fn intervals(&mut self, branches: &[TrackedBranch]) -> Result<Vec<FoundInterval>, CeaError> {
        let all = || (0..branches.len()).collect::<Vec<usize>>();
        let mut found: Vec<Vec<FoundInterval>> = branches.iter().map(|_| Vec::new()).collect();
        let (mut sought, mut searches, mut last) = (all(), true, f64::INFINITY);
        for round in 0.. {
            let own: Result<Vec<_>, LinalgError> =
                crate::parallel::map(&sought, |&i| match searches {
                    true => self.intervals_of(&branches[i]),
                    false => self.intervals_again(&branches[i], &found[i]),
                });
            // Crossings that moved since the last round, all in the first one.
            let (mut open, mut moved): (Vec<ModeAt>, Vec<usize>) = Default::default();
            let mut largest = 0.0_f64;
            for (&i, own) in sought.iter().zip(own?) {
                let before = std::mem::replace(&mut found[i], own);
                let before: Vec<f64> =
                    before.iter().flat_map(FoundInterval::crossings).map(|own| own.mu).collect();
                let own: Vec<&ModeAt> =
                    found[i].iter().flat_map(FoundInterval::crossings).collect();
                let is_same = round > 0 && before.len() == own.len();
                let moving = own.into_iter().enumerate().filter(|(k, state)| {
                    let change =
                        if is_same { (state.mu - before[*k]).abs() } else { f64::INFINITY };
                    largest = largest.max(change);
                    change > SETTLED.max(doubt(state))
                });
                let known = open.len();
                open.extend(moving.filter(|_| !self.builder.is_whole).map(|(_, own)| own.clone())); // Nothing is beyond all motions.
                if open.len() > known {
                    moved.push(i);
                }
            }
            // Then those whose residual is too large: what that basis says about other branches is worth no more.
            let missed = || found.iter().flatten().filter_map(FoundInterval::missed);
            searches = open.is_empty();
            if searches {
                open.extend(missed().cloned());
                moved = all();
            }
            if round == MOST_ATTEMPTS {
                open.clear();
            }
            // By the factors at rest as long as that helps, else by those beside a mode: there is memory for one's at a time.
            let is_at_rest = !searches && largest <= LITTLE * std::mem::replace(&mut last, largest);
            let mut has_grown = false;
            for states in open.chunks(if is_at_rest { open.len().max(1) } else { 1 }) {
                let states: Vec<ModesAt<'_>> =
                    states.iter().map(|own| (own.mu, std::slice::from_ref(&own.mode))).collect();
                has_grown |= self.builder.correct(&states, &[false, true], is_at_rest);
            }
            if !has_grown {
                let open = missed().map(|s| UnconvergedMode::of(s.mu, s.mode.eigenvalue.im));
                self.unconverged.extend(open);
                return Ok(found.into_iter().flatten().collect());
            }
            sought = moved;
        }
        unreachable!("rounds end")
    }

    fn friction_point(
        &self,
        k: usize,
        [with_shapes, with_lefts]: [bool; 2],
        branches: &[TrackedBranch],
    ) -> FrictionPoint {
        let point = &self.points[k];
        let wanted = &point.modes[..point.wanted];
        let mu = point.friction_coefficient;
        let vectors = if with_shapes { self.vectors((mu, with_lefts), wanted) } else { Vec::new() };
        let mut vectors = vectors.into_iter();
        let modes = point.modes.iter().zip(&point.checks).enumerate().map(|(i, (mode, check))| {
            let branch = branches.iter().find(|b| b.modes[k] == Some(i));
            let nameless = usize::from(i < point.wanted); // 1 of a listed mode, 0 of one above.
            let label = branch.map_or_else(
                || BranchLabel {
                    harmonic: self.edge.harmonic(&check.edge, check.peak),
                    branch: nameless,
                },
                |b| b.label,
            );
            // Without friction any combination of a degenerate pair is a mode: it has no direction.
            let direction = match mu {
                0.0 => 0,
                _ => self.edge.direction(&check.edge, label.harmonic),
            };
            // A body that turns without damping neither grows nor decays but by round-off.
            let is_round_off = self.tangent.is_gyroscopic
                && mode.eigenvalue.re.abs() <= check.uncertainty * mode.eigenvalue.norm();
            let own = vectors.next();
            let (shape, left) = own.map(|own| (own.right.into(), own.left.into())).unzip();
            let left = left.filter(|_| with_lefts);
            ComplexMode {
                eigenvalue: match is_round_off {
                    true => c64::new(0.0, mode.eigenvalue.im), // Neutral.
                    false => mode.eigenvalue,
                },
                harmonic: label.harmonic,
                branch: label.branch,
                direction,
                nodal_diameters: None,
                residual: check.residual,
                uncertainty: check.uncertainty,
                contact_share: check.contact_share,
                axial_share: None,
                mesh_error: None,
                shape,
                left,
                wave: None,
            }
        });
        let mut modes: Vec<ComplexMode> = modes.collect();
        let mut above = modes.split_off(point.wanted); // Those beyond the list.
        above.retain(|mode| mode.residual <= RESIDUAL_BOUND);
        FrictionPoint { friction_coefficient: mu, modes, above }
    }
}
