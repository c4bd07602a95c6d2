//! What materials with loss factors and tables over frequency are in time.

use super::ModeLimit;
use crate::*;
use frictionsim_physics::fem::MaxwellChain;

/// Band of a constant loss factor: from this part of `cea.max_frequency_hz` up to that.
const LOWEST: f64 = 0.01;
/// Least part of the highest frequency of a table at which its chain begins.
const LOWEST_OF_TABLE: f64 = 1e-5;

/// The materials of a case in time; none where they are what they are in any case, and where there is no band to fit
/// them to.
pub(super) fn relaxed(case: &Case) -> Option<Vec<RegionMaterial>> {
    let materials = &case.body.materials;
    if case.transient.is_none() || !case.body.has_lossy_materials() {
        return None;
    }
    // A constant loss factor is kept over this band, Hz.
    let band = match case.cea.as_ref().map(|own| own.modes) {
        Some(ModeLimit::MaxFrequency(limit)) => Some([LOWEST * limit, limit]),
        Some(ModeLimit::Lowest(_)) | None => None,
    };
    let each = materials.iter().enumerate().map(|(k, own)| {
        let eta = own.elastic.loss_factor;
        let chain = match &own.table {
            Some(table) => {
                let [low, high] = table.range_hz();
                let ratio = |frequency_hz: f64| table.ratio(frequency_hz);
                Some(MaxwellChain::fit(&ratio, [low.max(LOWEST_OF_TABLE * high), high]))
            }
            None if eta == 0.0 => None,
            None => Some(MaxwellChain::fit(&|_| c64::new(1.0, eta), band?)),
        };
        Some(RegionMaterial::in_time(materials, k, chain))
    });
    each.collect()
}

impl Case {
    /// The material of each region of the mesh in time.
    pub fn materials_in_time(&self) -> &dyn MaterialField {
        self.relaxed.as_ref().map_or(self.materials(), |own| own)
    }

    /// Refuses losses that have no equivalent in time.
    pub(super) fn refuse_losses_without_chain(&self) -> Result<(), CaseErrors> {
        if self.body.has_lossy_supports() || self.has_lossy_contacts() {
            return self
                .refuse_losses_in_time("with loss factors of supports or contacts, a transient");
        }
        if self.relaxed.is_some() || !self.has_structural_damping() {
            return Ok(());
        }
        Err(self.loss_error(
            "a transient has a Maxwell chain in place of a loss factor. It is fitted from a \
             hundredth of cea.max_frequency_hz up to that, and the case has none",
            "needs a band of frequencies",
            "give [cea] with max_frequency_hz, or damping.stiffness_coefficient in place of loss_factor",
        ))
    }
}
