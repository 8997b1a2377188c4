//! Settings of `#OTC`.
//!
//! Source: TF5200 online tool compensation (213641867).

/// Source of the wear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum WearSource {
    /// DISC: external.
    Outside,
    /// CONT: from the distance travelled.
    Way,
    /// AUTO: the sum of both.
    Both,
}

/// Settings of `#OTC`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct OnlineCompensation {
    /// `#OTC ON`.
    pub(in crate::exec) on: bool,
    /// RADIUS instead of LENGTH.
    pub(in crate::exec) radius: bool,
    /// DISC, CONT, AUTO.
    pub(in crate::exec) source: WearSource,
    /// WEAR_CONST in mm of wear per mm of travel; `None`: the value of the tool.
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
