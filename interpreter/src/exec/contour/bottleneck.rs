//! Places where a compensated tool cuts into its own contour: gaps narrower than the tool, loops over several blocks.
//!
//! Compensation looks at neighbouring elements only, as the control does: a bottleneck between elements that are further
//! apart goes unnoticed there (source: TF5200 programming manual, limits of tool radius compensation) and is driven. So
//! it is a warning here, once per program.

use crate::exec::geometry::arc::Point;
use crate::exec::geometry::planar::{Side, norm, sub};
use crate::exec::step::SourceRef;
use std::collections::VecDeque;

/// Elements that are compared with a new one.
const WINDOW: usize = 50;

/// How much closer than its radius the tool must come, in mm: the smallest increment of the language.
const TOLERANCE_MM: f64 = 1e-4;

/// Points of an element that are tried.
const SAMPLES_MAX: f64 = 64.0;

/// An element of the contour or of the way of the tool's centre.
#[derive(Clone, Copy, Debug)]
struct Part {
    side: Side,
    /// Smallest box around it.
    low: Point,
    high: Point,
    source: SourceRef,
    /// Number of the element of the contour; what compensation inserts has that of the element before it.
    number: u64,
}

/// Contour and tool path of the last elements.
#[derive(Clone, Debug, Default)]
pub(in crate::exec) struct Watch {
    contour: VecDeque<Part>,
    way: VecDeque<Part>,
    /// Number of the next element of the contour.
    next: u64,
}

/// The tool at one block cuts the contour of another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Cut {
    pub(in crate::exec) tool: SourceRef,
    pub(in crate::exec) contour: SourceRef,
    /// What is left between the tool's centre and the contour, in mm.
    pub(in crate::exec) distance_mm: f64,
}

impl Watch {
    /// A new element of the contour, for a tool of this radius.
    pub(in crate::exec) fn contour(
        &mut self,
        side: Side,
        source: SourceRef,
        radius: f64,
    ) -> Option<Cut> {
        let part = Part::new(side, source, self.next);
        self.next += 1;
        let found = self.way.iter().find_map(|way| cut(way, &part, radius));
        push(&mut self.contour, part);
        found
    }

    /// A new element of the way of the tool's centre: it belongs to the element of the contour before the last one.
    pub(in crate::exec) fn way(
        &mut self,
        side: Side,
        source: SourceRef,
        radius: f64,
    ) -> Option<Cut> {
        let part = Part::new(side, source, self.next.saturating_sub(2));
        let found = self.contour.iter().find_map(|contour| cut(&part, contour, radius));
        push(&mut self.way, part);
        found
    }
}

impl Part {
    fn new(side: Side, source: SourceRef, number: u64) -> Self {
        let (low, high) = side.extent();
        Self { side, low, high, source, number }
    }
}

fn push(parts: &mut VecDeque<Part>, part: Part) {
    if parts.len() >= WINDOW {
        parts.pop_front();
    }
    parts.push_back(part);
}

/// Where the tool on `way` comes closer to `contour` than its radius. Neighbours are the business of the corner.
fn cut(way: &Part, contour: &Part, radius: f64) -> Option<Cut> {
    let apart = (0..2)
        .any(|i| way.low[i] > contour.high[i] + radius || contour.low[i] > way.high[i] + radius);
    if apart || way.number.abs_diff(contour.number) < 2 {
        return None;
    }
    let samples = (way.side.length() / (0.25 * radius)).ceil().clamp(2.0, SAMPLES_MAX);
    let distance_mm = (0..=samples as u32)
        .map(|k| contour.side.distance(way.side.at(f64::from(k) / samples)))
        .fold(f64::INFINITY, f64::min);
    let found = Cut { tool: way.source, contour: contour.source, distance_mm };
    (distance_mm < radius - TOLERANCE_MM).then_some(found)
}

impl Side {
    fn length(&self) -> f64 {
        match self {
            Self::Line { from, to } => norm(sub(*to, *from)),
            Self::Arc { radius, sweep_rad, .. } => radius * sweep_rad.abs(),
        }
    }

    /// The point at a share 0..1 of the way.
    fn at(&self, share: f64) -> Point {
        match self {
            Self::Line { from, to } => {
                let d = sub(*to, *from);
                [from[0] + share * d[0], from[1] + share * d[1]]
            }
            Self::Arc { centre, radius, start_rad, sweep_rad } => {
                let (sin, cos) = libm::sincos(start_rad + share * sweep_rad);
                [centre[0] + radius * cos, centre[1] + radius * sin]
            }
        }
    }

    /// Distance of a point from the element.
    fn distance(&self, p: Point) -> f64 {
        let share = self.share_of(p);
        match self {
            Self::Line { .. } => norm(sub(p, self.at(share.clamp(0.0, 1.0)))),
            Self::Arc { centre, radius, .. } if share <= 1.0 => {
                (norm(sub(p, *centre)) - radius).abs()
            }
            Self::Arc { .. } => norm(sub(p, self.at(0.0))).min(norm(sub(p, self.at(1.0)))),
        }
    }

    /// A box around the element; of an arc the one around its circle.
    fn extent(&self) -> (Point, Point) {
        match self {
            Self::Line { from, to } => {
                ([from[0].min(to[0]), from[1].min(to[1])], [from[0].max(to[0]), from[1].max(to[1])])
            }
            Self::Arc { centre: [x, y], radius: r, .. } => ([x - r, y - r], [x + r, y + r]),
        }
    }
}
