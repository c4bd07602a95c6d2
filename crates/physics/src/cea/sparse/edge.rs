//! Circumferential harmonic and travelling direction from the displacement of the contact edge.

use crate::cea::sparse::*;

/// Discrete Fourier transform over the contact nodes.
///
/// A mode `phi e^{lambda t}`, `Im(lambda) > 0`, whose edge moves as `e^{-i n theta}` travels towards increasing angle.
pub struct ContactEdge {
    /// Unknowns of each displacement component along the edge, in order of angle.
    components: Vec<Vec<usize>>,
    angles: Vec<f64>,
    /// +1 if the rotor turns towards increasing angle.
    rotor: f64,
}

impl ContactEdge {
    /// The contact edge of `tangent`.
    pub fn of(tangent: &SlidingTangent) -> Self {
        let contact = &tangent.contact;
        let mut components = vec![contact.tangential.clone(), contact.normal.clone()];
        if !contact.angles.is_empty() {
            // Pairs of nodes: normal and tangential in turn.
            let opposite = |component: usize| contact.opposite.iter().skip(component);
            components.extend([0, 1].map(|c| opposite(c).step_by(2).copied().collect()));
        }
        components.retain(|component: &Vec<usize>| !component.is_empty());
        Self { components, angles: contact.angles.clone(), rotor: contact.sliding_direction }
    }

    /// Displacements of the edge nodes, component by component, from a vector over the unknowns.
    pub fn restrict(&self, value: impl Fn(usize) -> c64) -> Vec<c64> {
        self.components.iter().flatten().map(|&unknown| value(unknown)).collect()
    }

    /// The harmonic of largest amplitude.
    ///
    /// 0 where the edge is at rest against the `peak` of the mode: the edge of a rigid cylinder holds
    /// still in the radial modes, which are axisymmetric, and in no other.
    pub fn harmonic(&self, edge: &[c64], peak: f64) -> usize {
        let largest = edge.iter().fold(0.0_f64, |m, v| m.max(v.norm()));
        if largest <= HALF_THE_DIGITS * peak {
            return 0;
        }
        // Powers of e^{i theta}, one after the other: a sine and a cosine for each harmonic would cost more.
        let turns = self.angles.iter().map(|angle| c64::new(angle.cos(), angle.sin()));
        let turns: Vec<c64> = turns.collect();
        let mut phases = vec![c64::new(1.0, 0.0); turns.len()];
        let mut best = (0, -1.0);
        for n in 0..=self.angles.len() / 2 {
            let [forward, backward] = self.waves(edge, &phases);
            // e^{-i n theta} and e^{+i n theta} are one wave for n = 0 and at the Nyquist harmonic.
            let share = if self.is_paired(n) { 1.0 } else { 0.5 };
            let energy = share * (forward.powi(2) + backward.powi(2));
            if energy > best.1 {
                best = (n, energy);
            }
            phases.iter_mut().zip(&turns).for_each(|(phase, turn)| *phase *= turn); // e^{i (n + 1) theta}.
        }
        best.0
    }

    /// +1 if the wave of harmonic `n` travels with the rotor, -1 against it, 0 if it stands: neither way twice as much travels as the
    /// other way.
    pub fn direction(&self, edge: &[c64], harmonic: usize) -> i8 {
        if harmonic == 0 {
            return 0;
        }
        let angles = self.angles.iter().map(|angle| harmonic as f64 * angle);
        let phases: Vec<c64> = angles.map(|angle| c64::new(angle.cos(), angle.sin())).collect();
        let [forward, backward] = self.waves(edge, &phases);
        let sense = if forward > 2.0 * backward {
            1.0
        } else if backward > 2.0 * forward {
            -1.0
        } else {
            0.0
        };
        (sense * self.rotor) as i8
    }

    /// Whether modes of this harmonic come in pairs `e^{-i n theta}`, `e^{+i n theta}`.
    pub fn is_paired(&self, harmonic: usize) -> bool {
        harmonic > 0 && 2 * harmonic != self.angles.len() // At 0 and N / 2 both are one wave.
    }

    /// Amplitudes of the waves `e^{-i n theta}` and `e^{+i n theta}` of a mode's edge, whose `e^{i n theta}` at the nodes are `phases`.
    fn waves(&self, edge: &[c64], phases: &[c64]) -> [f64; 2] {
        let (mut forward, mut backward) = (0.0, 0.0);
        for component in edge.chunks(phases.len().max(1)) {
            let (mut f, mut b) = (c64::new(0.0, 0.0), c64::new(0.0, 0.0));
            for (value, phase) in component.iter().zip(phases) {
                f += value * phase; // The part that moves as e^{-i n theta}.
                b += value * phase.conj();
            }
            forward += f.norm_sqr();
            backward += b.norm_sqr();
        }
        [forward.sqrt(), backward.sqrt()]
    }
}
