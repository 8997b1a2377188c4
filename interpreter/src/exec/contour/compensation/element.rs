//! An element of the compensated contour and the resulting motion.

use super::corner::{side_sweep, trimmed};
use super::ends::{ends, line};
use super::failure::{Fallible, too_tight};
use super::tangential::{self, Touch};
use crate::diag::Condition;
use crate::exec::contour::item::{Item, vanished};
use crate::exec::contour::motion::{Compensated, Motion};
use crate::exec::fault::Fault;
use crate::exec::geometry::planar::Side;
use crate::exec::geometry::point::{Point, cross, dot, sub};
use kontur_motion::block::Feed;
use kontur_motion::path::{ArcPath, ArcShape, Path};

/// An element with an end that is not known yet.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) motion: Box<Motion>,
    pub(super) side: Side,
    /// Start of the tool centre path.
    pub(super) start: Point,
    pub(super) course: Course,
}

/// How the tool follows an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Course {
    /// On the parallel.
    Parallel,
    /// The line that approaches the parallel: its direction differs from that of the contour.
    Approach,
    /// An approach on an arc that touches the parallel (G05).
    TangentialApproach,
    /// A line that leads from the parallel at this distance to that of the new tool radius.
    RadiusChange(f64),
    /// A tangent at the end of an element: only the corner after it is still to come, with the new tool radius.
    Corner,
}

impl Course {
    /// Whether the tool is not yet at the contour.
    pub(super) fn approaches(self) -> bool {
        matches!(self, Self::Approach | Self::TangentialApproach)
    }
}

impl Element {
    /// An element whose parallel the tool follows.
    pub(super) fn parallel(motion: Box<Motion>, side: Side, start: Point) -> Self {
        Self { motion, side, start, course: Course::Parallel }
    }

    /// The approach on an arc to the start of the parallel, with direction `tangent` there.
    pub(super) fn emit_arc(
        self,
        end: Point,
        tangent: Point,
        plane: [usize; 2],
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        let Self { mut motion, start, .. } = self;
        if let Some(path) = tangential::way(&motion, plane, (start, end), tangent, Touch::End)? {
            motion.block.path = path;
            out.push(Item::Motion(motion));
        } else {
            vanished(motion.events, out);
        }
        Ok(())
    }

    /// The element from its start to `end`, both on the parallel.
    pub(super) fn emit(
        self,
        end: Point,
        plane: [usize; 2],
        distance: f64,
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        let Self { mut motion, side, start, course } = self;
        let approach = course.approaches();
        let source = motion.source;
        motion.engaged = (!approach).then_some(distance > 0.0);
        let path = match &side {
            Side::Line { .. } => {
                let along = dot(sub(end, start), side.tangent(false));
                if along < 0.0 && !approach {
                    return Err(too_tight(Condition::LineRunsBack, &motion));
                }
                line(&motion, plane, start, end)
            }
            Side::Arc { centre, radius, sweep_rad, .. } => {
                let new_radius =
                    if *sweep_rad > 0.0 { radius - distance } else { radius + distance };
                if new_radius <= 0.0 {
                    let text = format!(
                        "tool radius {} mm is too large for an arc of radius {radius} mm",
                        distance.abs()
                    );
                    return Err(
                        Fault::new(Condition::ToolTooLarge, text, motion.span).in_block(source)
                    );
                }
                let sweep_rad = trimmed(&side, start, end);
                if sweep_rad * side_sweep(&side) <= 0.0 {
                    return Err(too_tight(Condition::ArcRunsBack, &motion));
                }
                if let Some(Compensated { engagement_radius_mm: Some(least), .. }) =
                    motion.compensation
                    && *radius >= least
                    && let Feed::PathVelocity(v) = &mut motion.block.feed
                {
                    // G11: F is the velocity on the contour
                    *v *= new_radius / radius;
                }
                let shape = ArcShape { plane, centre_mm: *centre, sweep_rad };
                let (from, to) = ends(&motion, plane, start, end);
                ArcPath::new(from, to, shape, &motion.block.dynamics.feed_axes).map(Path::Arc)
            }
        };
        if let Some(path) = path {
            motion.block.path = path;
            out.push(Item::Motion(motion));
        } else {
            vanished(motion.events, out);
        }
        Ok(())
    }
}

/// The part of a motion within the plane; `None` if it does not move there.
pub(super) fn moving_side(motion: &Motion, plane: [usize; 2]) -> Fallible<Option<Side>> {
    let path = &motion.block.path;
    let moves = plane.iter().any(|i| path.start()[*i].to_bits() != path.end()[*i].to_bits());
    if !moves && path.is_straight() {
        return Ok(None);
    }
    if let Some(side) = Side::of(path, plane) {
        Ok(Some(side))
    } else {
        let what = "an arc outside the plane with tool radius compensation";
        Err(Fault::unsupported(what, motion.span))
    }
}

/// Whether a contour runs back along the previous element: a line, or an arc in the opposite direction.
pub(super) fn runs_back(last: &Side, next: &Side) -> bool {
    let (u, w) = (last.tangent(true), next.tangent(false));
    let against = cross(u, w).abs() < 1e-9 && dot(u, w) < 0.0;
    against
        && match (last, next) {
            (Side::Line { .. }, Side::Line { .. }) => true,
            (Side::Arc { sweep_rad: a, .. }, Side::Arc { sweep_rad: b, .. }) => a * b < 0.0,
            _ => false,
        }
}

/// Steps between two motions, at the position of the tool.
pub(super) fn emit_between(between: Vec<Item>, at: Point, plane: [usize; 2], out: &mut Vec<Item>) {
    for item in between {
        match item {
            Item::Motion(mut motion) => {
                if let Some(path) = line(&motion, plane, at, at) {
                    motion.block.path = path;
                    out.push(Item::Motion(motion));
                } else {
                    vanished(motion.events, out);
                }
            }
            Item::Rest(_) | Item::Events(_) => out.push(item),
        }
    }
}
