//! The parameters of a machine after defaults, default lists, specific lists and overrides.

use super::parameters::Parameters;

/// The settled parameters of a whole machine.
#[derive(Debug)]
pub(super) struct Settled {
    pub(super) start_up: Parameters,
    pub(super) channel: Parameters,
    /// Axis lists in the order of the start-up list.
    pub(super) axes: Vec<AxisList>,
    pub(super) own: Parameters,
    pub(super) tools: Parameters,
    pub(super) zero: Parameters,
    pub(super) external: Parameters,
}

/// One axis list.
#[derive(Debug)]
pub(super) struct AxisList {
    pub(super) file: String,
    pub(super) parameters: Parameters,
}
