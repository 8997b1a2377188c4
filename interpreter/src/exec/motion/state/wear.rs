//! What `#OTC` has set.
//!
//! Source: TF5200 online tool compensation (213641867).

/// mm of wear for a mm of way in one unit of WEAR_CONST, 0.1 um for a metre.
pub(in crate::exec) const WEAR_UNIT: f64 = 1e-7;

/// Where the wear comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum WearSource {
    /// DISC: from outside.
    Outside,
    /// CONT: by the distance driven.
    Way,
    /// AUTO: the sum.
    Both,
}

/// What `#OTC` has set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct OnlineCompensation {
    /// `#OTC ON`.
    pub(in crate::exec) on: bool,
    /// RADIUS; otherwise LENGTH.
    pub(in crate::exec) radius: bool,
    /// DISC, CONT, AUTO.
    pub(in crate::exec) source: WearSource,
    /// WEAR_CONST in mm of wear for a mm of way; `None`: that of the tool.
    pub(in crate::exec) ratio: Option<f64>,
    /// ACC_WEIGHT, above 0.
    pub(in crate::exec) acceleration_ratio: f64,
}

impl Default for OnlineCompensation {
    fn default() -> Self {
        Self {
            on: false,
            radius: false,
            source: WearSource::Both,
            ratio: None,
            acceleration_ratio: 1.0,
        }
    }
}
