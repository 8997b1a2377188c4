//! What lies between programmed coordinates and the positions of the axes.

use super::layer::Layer;
use crate::exec::geometry::frame::Frame;
use kontur_motion::axis::AxisVec;

/// Contour rotation (G68, `#ROTATION`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Rotation {
    /// Main axes of the plane.
    pub(in crate::exec::geometry) plane: [usize; 2],
    pub(in crate::exec) deg: f64,
    /// Centre in mm in the plane.
    pub(in crate::exec) centre: [f64; 2],
}

/// Frames and offsets that act; `#MCS ON` suspends them together.
#[derive(Clone, Debug)]
pub(super) struct Active {
    /// Offset contained in the target of each axis.
    pub(super) applied: AxisVec,
    /// Offsets below all coordinate systems.
    pub(super) lowest: Layer,
    /// Active coordinate systems, the last one innermost.
    pub(super) systems: Vec<Layer>,
    /// Zero-offset group of the axes that are not main axes, if their offsets belong to the channel instead of a coordinate
    /// system (P-CHAN-00397 = 0).
    pub(super) channel_group: Option<u32>,
    /// Measuring offsets (G101).
    pub(super) measuring: AxisVec,
    pub(super) mirrored: Vec<bool>,
    pub(super) rotation: Option<Rotation>,
}

impl Active {
    /// Neither frames nor offsets.
    pub(super) fn none(axes: usize) -> Self {
        Self {
            applied: AxisVec::zeros(axes),
            lowest: Layer::new(Frame::IDENTITY, axes),
            systems: Vec::new(),
            channel_group: None,
            measuring: AxisVec::zeros(axes),
            mirrored: vec![false; axes],
            rotation: None,
        }
    }
}

/// What `#MCS OFF` restores.
#[derive(Clone, Debug)]
pub(super) struct Suspended {
    pub(super) active: Active,
    /// EX TOOL: a tool change takes effect only after `#MCS OFF`.
    pub(super) without_tools: bool,
    /// Offsets of the tool that was selected before; those of a newly selected tool apply.
    pub(super) tool_aside: bool,
}
