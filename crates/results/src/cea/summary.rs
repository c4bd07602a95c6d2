//! `summary.json` of a complex eigenvalue analysis.

use super::branches::{branch_of, branch_of_mode};
use super::{BaseState, CeaReport, Solution};
use crate::common::*;
use frictionsim_physics::cea::ModeCount;

keys! {
    /// `summary.json` of `frictionsim cea`.
    CeaSummary {
        dofs: usize = "unknowns of the eigenproblem";
        method: String = "`cyclic` or `sparse`";
        selection: String = "what was asked for, in words";
        modes: usize = "most modes at one friction value";
        friction_values: usize = "friction values of the tables";
        unstable_counts: Vec<UnstableCount> = "modes and unstable modes at each";
        critical_frictions: Vec<CriticalFriction> = "crossings into instability, lowest first";
        largest_residual: Option<f64> = "largest relative residual of any eigenpair";
        modes_at_friction: Option<Vec<ModeSummary>>
            = "the modes at the case's own friction coefficient, where it is one of those solved";
        unstable_modes: Vec<UnstableMode> = "the modes that grow at each friction value of the tables";
        base_state: BaseState = "steady sliding at the case's own friction coefficient";
        notes: Vec<String> = "what the solver has to say";
        contact_open_fraction?: f64 = "fraction of the contact nodes that are open, where some may be";
        #[serde(skip_serializing_if = "Vec::is_empty")]
        mode_counts: Vec<CountSummary> = "counts of the modes by the argument principle, where they were asked for";
    }

    /// The modes at one friction value, counted independently of the list.
    CountSummary {
        friction_coefficient: f64 = "the friction coefficient";
        frequencies_hz: [f64; 2] = "frequencies between which was counted, Hz";
        growth_rates: [f64; 2] = "growth rates between which was counted, 1/s";
        counted: Option<i64> = "eigenvalues counted; none where that failed";
        known: usize = "modes known there";
        recovered: usize = "those of them that only a search found that the count gave rise to";
        is_complete: bool = "whether the two are the same";
        missing_near: Option<[f64; 2]> = "frequency and growth rate (Hz, 1/s) about which the missing ones lie";
        failure: Option<String> = "why there is no count";
        determinants: usize = "determinants that were taken";
    }
}

impl CountSummary {
    fn of(count: &ModeCount) -> Self {
        Self {
            friction_coefficient: count.friction_coefficient,
            frequencies_hz: count.region.frequencies_hz,
            growth_rates: count.region.growth_rates,
            counted: count.counted(),
            known: count.known,
            recovered: count.recovered,
            is_complete: count.is_complete(),
            missing_near: count.near.map(|near| [near.im / TAU, near.re]),
            failure: count.missing.as_ref().err().cloned(),
            determinants: count.determinants,
        }
    }
}

keys! {
    /// Modes at one friction value.
    #[derive(Copy, Deserialize)]
    UnstableCount {
        friction_coefficient: f64 = "the friction coefficient";
        modes: usize = "modes";
        unstable: usize = "those that grow";
    }

    /// Where a branch turns unstable, and where it is stable again.
    #[derive(Copy, Deserialize)]
    CriticalFriction, ONSETS {
        harmonic: Option<usize> = "number of nodal diameters; none without symmetry", IfAny "n" Count;
        branch: usize = "0 of a motion that grows without oscillating; rank within the harmonic, \
            else among all, from 1", Always "branch" Count;
        direction: Option<i8> = "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";
        critical_friction: Option<f64> = "friction coefficient above which the branch is unstable",
            Always "unstable above" Fixed(6);
        frequency_hz: Option<f64> = "frequency there", Always "frequency" Fixed(2);
        restabilized_friction: Option<f64> = "friction coefficient above which it is stable again",
            IfAny "stable again above" Fixed(6);
        restabilized_frequency_hz: Option<f64> = "frequency there", IfAny "frequency there" Fixed(2);
        unstable_from_start: bool = "whether it is unstable at the lowest friction solved already";
        lost_after?: f64 = "friction coefficient between which and critical_friction it \
            turns unstable, where it was lost";
        mesh_error?: f64 = "estimate of the critical friction less that on an ever finer mesh",
            IfAny "error of the mesh" Scientific(1);
    }
}

/// Those that a sweep lists too.
pub(crate) const SWEPT_ONSETS: &[Column<CriticalFriction>] = parted(ONSETS, "mesh_error").0;

keys! {
    /// A mode at the friction coefficient of the case.
    #[derive(Copy, Deserialize)]
    ModeSummary, OWN_MODES {
        harmonic: Option<usize> = "number of nodal diameters; none without symmetry";
        branch: usize = "rank within the harmonic, else among all, from 1";
        direction: Option<i8> = "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";
        real_hz: f64 = "real part of the eigenvalue over 2 pi";
        frequency_hz: f64 = "imaginary part over 2 pi";
        unstable: bool = "whether it grows";
        contact_share: Option<f64> = "share of the kinetic energy at the contact";
        axial_share?: f64 = "share of the kinetic energy along the axis, of a body in three dimensions";
        mesh_error?: f64 = "estimate of the frequency less that on an ever finer mesh, Hz";
    }
}

/// Those that a sweep lists too.
pub(crate) const SWEPT_MODES: &[Column<ModeSummary>] = parted(OWN_MODES, "axial_share").0;

impl ModeSummary {
    /// That of a mode.
    pub(super) fn of(mode: &ComplexMode, has_harmonics: bool) -> Self {
        Self {
            harmonic: mode.diameters(has_harmonics),
            branch: mode.branch,
            direction: has_harmonics.then_some(mode.direction),
            real_hz: mode.real_hz(),
            frequency_hz: mode.frequency_hz(),
            unstable: mode.is_unstable(),
            contact_share: present(mode.contact_share),
            axial_share: mode.axial_share,
            mesh_error: mode.mesh_error,
        }
    }
}

keys! {
    /// A mode that grows, where it was found, and from when it does.
    #[derive(Copy, Deserialize)]
    UnstableMode, UNSTABLE {
        friction_coefficient: f64 = "friction coefficient", Always "friction" Plain;
        mode: usize = "number by frequency at that friction, from 1", Always "mode" Count;
        harmonic: Option<usize> = "number of nodal diameters; none without symmetry", IfAny "n" Count;
        branch: usize = "rank within the harmonic, else among all, from 1";
        direction: Option<i8> = "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";
        frequency_hz: f64 = "frequency", Always "frequency" Fixed(2);
        growth_rate_per_s: f64 = "growth rate", Always "growth rate" Fixed(2);
        damping_factor: f64 = "damping factor, below 0";
        critical_friction: Option<f64> = "friction at which its branch turned unstable last",
            IfAny "critical friction" Fixed(6);
    }
}

impl UnstableMode {
    /// The unstable modes of a report in the order of its tables.
    fn all(report: &CeaReport<'_>) -> Vec<Self> {
        let modes = report.tabulated().flat_map(|point| {
            let unstable = (1..).zip(&point.modes).filter(|(_, mode)| mode.is_unstable());
            unstable.map(move |own| Self::of(report, point.friction_coefficient, own))
        });
        modes.collect()
    }

    fn of(report: &CeaReport<'_>, friction: f64, (number, mode): (usize, &ComplexMode)) -> Self {
        let own = |interval: &&UnstableInterval| {
            branch_of(interval) == branch_of_mode(mode) && interval.critical_friction <= friction
        };
        let crossings = report.solution.sweep.intervals.iter().filter(own);
        let last = crossings.max_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
        Self {
            friction_coefficient: friction,
            mode: number,
            harmonic: mode.diameters(report.has_harmonics),
            branch: mode.branch,
            direction: report.has_harmonics.then_some(mode.direction),
            frequency_hz: mode.frequency_hz(),
            growth_rate_per_s: mode.growth_rate(),
            damping_factor: mode.damping_factor(),
            critical_friction: last
                .filter(|own| own.is_located())
                .and_then(|own| present(own.critical_friction)),
        }
    }
}

/// The crossings into instability.
pub(super) fn onsets(report: &CeaReport<'_>) -> Vec<CriticalFriction> {
    let onset = |interval: &UnstableInterval| CriticalFriction {
        harmonic: interval.diameters(report.has_harmonics),
        branch: interval.branch,
        direction: report.has_harmonics.then_some(interval.direction),
        critical_friction: present(interval.critical_friction),
        frequency_hz: present(interval.frequency_hz),
        restabilized_friction: interval.restabilized.map(|end| end.0),
        restabilized_frequency_hz: interval.restabilized.map(|end| end.1),
        unstable_from_start: interval.unstable_from_start,
        lost_after: interval.lost_after,
        mesh_error: interval.mesh_error,
    };
    report.solution.sweep.intervals.iter().map(onset).collect()
}

/// The summary of an analysis.
pub fn summary(report: &CeaReport<'_>) -> CeaSummary {
    let of_point = |point: &FrictionPoint| UnstableCount {
        friction_coefficient: point.friction_coefficient,
        modes: point.modes.len(),
        unstable: point.modes.iter().filter(|mode| mode.is_unstable()).count(),
    };
    let base = report.base;
    let Solution { sweep, dofs, method, notes, .. } = report.solution;
    let modes_at = |point: &FrictionPoint| -> Vec<ModeSummary> {
        point.modes.iter().map(|mode| ModeSummary::of(mode, report.has_harmonics)).collect()
    };
    let may_open = !report.has_harmonics || report.body.sector.is_some();
    let nodes = (base.slipping + base.sticking + base.open).max(1);
    CeaSummary {
        dofs: *dofs,
        method: (*method).to_owned(),
        selection: report.selection.clone(),
        modes: report.mode_counts().1,
        friction_values: report.tabulated().count(),
        unstable_counts: report.tabulated().map(of_point).collect(),
        critical_frictions: onsets(report),
        largest_residual: present(report.largest_residual()),
        modes_at_friction: report.solved_point().map(modes_at),
        unstable_modes: UnstableMode::all(report),
        base_state: base,
        notes: notes.clone(),
        contact_open_fraction: may_open.then(|| base.open as f64 / nodes as f64),
        mode_counts: sweep.counts.iter().map(CountSummary::of).collect(),
    }
}
