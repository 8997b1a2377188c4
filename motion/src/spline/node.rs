//! The control points that the spline is made of.

use crate::axis::AxisVec;

/// A control point.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) knot: f64,
    pub(super) point: AxisVec,
    /// The point of the run that it belongs to, or the last one before it, and the number after that.
    pub(super) place: (usize, usize),
    /// Whether it is a programmed point that stays a control point.
    pub(super) is_corner: bool,
    /// Whether the leg after it is part of a fit.
    pub(super) fitted: bool,
    /// At a corner: how far fits next to it are from the polygon, in either group.
    pub(super) off: [f64; 2],
}
