//! Positions where a compensated tool cuts into its own contour: gaps narrower than the tool, loops over several blocks.
//!
//! As in the control, the compensation checks only the corners between neighbouring elements: a bottleneck anywhere else is not
//! detected there (source: TF5200 programming manual, limits of tool radius compensation), and the path is executed. Therefore
//! it is a warning here, once per program.

use super::item::Item;
use crate::exec::geometry::planar::{Side, intersections};
use crate::exec::geometry::point::{Point, norm, sub};
use crate::exec::step::SourceRef;
use rstar::{AABB, RTree, RTreeObject};
use std::collections::VecDeque;

/// Number of elements that are compared with a new one, the last ones of the contour and of the tool path each: limits the
/// memory.
const WINDOW: usize = 20_000;
/// Maximum number of elements near a new one that are checked: limits the time when many passes lie side by side.
const MOST_AROUND: usize = 200;
/// Distance in mm below which elements count as coincident: a pass that repeats another one gives no new information.
const SAME_MM: f64 = 1e-6;

/// Distance in mm by which the tool must come closer than its radius: the smallest increment of the language.
const TOLERANCE_MM: f64 = 1e-4;

/// An element of the contour or of the tool centre path.
#[derive(Clone, Copy, Debug)]
struct Part {
    side: Side,
    /// Bounding box.
    low: Point,
    high: Point,
    /// Bounding circle: the midpoint of its path and half of its length.
    middle: Point,
    half: f64,
    source: SourceRef,
    /// Number of the element of the contour; elements inserted after it by the compensation have the same number.
    number: u64,
    /// Number among all parts.
    place: u64,
}

impl RTreeObject for Part {
    type Envelope = AABB<Point>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.low, self.high)
    }
}

/// Compares the numbers of two parts.
impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number && self.place == other.place
    }
}

/// The last elements, indexed by position.
#[derive(Clone, Debug, Default)]
struct Parts {
    tree: RTree<Part>,
    order: VecDeque<Part>,
}

impl Parts {
    fn push(&mut self, part: Part) {
        if self.around(&part, SAME_MM).any(|other| other.side.is_at(&part.side)) {
            return;
        }
        if self.order.len() >= WINDOW
            && let Some(oldest) = self.order.pop_front()
        {
            self.tree.remove(&oldest);
        }
        self.order.push_back(part);
        self.tree.insert(part);
    }

    fn around(&self, part: &Part, gap: f64) -> impl Iterator<Item = &Part> {
        let around = AABB::from_corners(part.low.map(|x| x - gap), part.high.map(|x| x + gap));
        self.tree.locate_in_envelope_intersecting(around).take(MOST_AROUND)
    }

    /// The first nearby part for which the function returns a value.
    fn first<T>(&self, part: &Part, gap: f64, with: impl Fn(&Part) -> Option<T>) -> Option<T> {
        let near = self.around(part, gap);
        let found = near.filter_map(|other| Some((other.number, other.place, with(other)?)));
        found.min_by_key(|(number, place, _)| (*number, *place)).map(|(.., found)| found)
    }
}

/// Contour and tool path of the last elements.
#[derive(Clone, Debug, Default)]
pub(in crate::exec) struct Watch {
    contour: Parts,
    way: Parts,
    /// Number of the next element, and number of parts so far.
    next: u64,
    parts: u64,
}

/// The tool at one block cuts the contour of another block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Cut {
    pub(in crate::exec::contour) tool: SourceRef,
    pub(in crate::exec::contour) contour: SourceRef,
    /// Remaining distance between the tool centre and the contour, in mm.
    pub(in crate::exec::contour) distance_mm: f64,
}

impl Watch {
    /// Called when an element of the contour is complete: `way` is the tool path along it, including the elements inserted
    /// after it.
    pub(in crate::exec) fn element(
        &mut self,
        side: Side,
        source: SourceRef,
        way: &[Item],
        plane: [usize; 2],
        radius: f64,
    ) -> Option<Cut> {
        let mut found = self.contour(side, source, radius);
        for item in way {
            if let Item::Motion(motion) = item
                && let Some(side) = Side::of(&motion.block.path, plane)
            {
                found = found.or(self.way(side, motion.source, radius));
            }
        }
        self.next += 1;
        found
    }

    fn contour(&mut self, side: Side, source: SourceRef, radius: f64) -> Option<Cut> {
        let part = self.part(side, source);
        let found = self.way.first(&part, radius, |way| cut(way, &part, radius));
        self.contour.push(part);
        found
    }

    fn way(&mut self, side: Side, source: SourceRef, radius: f64) -> Option<Cut> {
        let part = self.part(side, source);
        let found = self.contour.first(&part, radius, |contour| cut(&part, contour, radius));
        self.way.push(part);
        found
    }

    fn part(&mut self, side: Side, source: SourceRef) -> Part {
        self.parts += 1;
        Part::new(side, source, (self.next, self.parts))
    }
}

impl Part {
    fn new(side: Side, source: SourceRef, (number, place): (u64, u64)) -> Self {
        let (middle, half) = side.middle();
        let (low, high) = side.extent();
        let low = [low[0].max(middle[0] - half), low[1].max(middle[1] - half)];
        let high = [high[0].min(middle[0] + half), high[1].min(middle[1] + half)];
        Self { side, low, high, middle, half, source, number, place }
    }

    /// Whether the boxes are further apart than `gap`.
    fn is_beyond(&self, other: &Self, gap: f64) -> bool {
        (0..2).any(|i| self.low[i] > other.high[i] + gap || other.low[i] > self.high[i] + gap)
    }
}

/// Position where the tool on `way` comes closer to `contour` than its radius. Along its own element the distance is correct.
fn cut(way: &Part, contour: &Part, radius: f64) -> Option<Cut> {
    let between = norm(sub(way.middle, contour.middle)) - way.half - contour.half;
    if way.number == contour.number || between >= radius || way.is_beyond(contour, radius) {
        return None;
    }
    let distance_mm = distance(way, contour);
    let found = Cut { tool: way.source, contour: contour.source, distance_mm };
    (distance_mm < radius - TOLERANCE_MM).then_some(found)
}

/// The smallest distance between two elements: at an intersection, at an end of one of them, or inside both where a line passes
/// an arc or an arc passes another one.
fn distance(first: &Part, second: &Part) -> f64 {
    let (a, b) = (&first.side, &second.side);
    let crosses = || {
        let points = intersections(&a.parallel(0.0), &b.parallel(0.0));
        points.into_iter().any(|p| a.contains(p) && b.contains(p))
    };
    if !first.is_beyond(second, 0.0) && crosses() {
        return 0.0;
    }
    let ends = [
        b.distance(a.start_point()),
        b.distance(a.end_point()),
        a.distance(b.start_point()),
        a.distance(b.end_point()),
    ];
    let passing = match (a, b) {
        (Side::Line { .. }, Side::Line { .. }) => f64::INFINITY,
        (line @ Side::Line { .. }, arc @ Side::Arc { centre, .. })
        | (arc @ Side::Arc { centre, .. }, line @ Side::Line { .. }) => {
            passing(line, arc, line.foot(*centre))
        }
        (Side::Arc { centre: p, .. }, Side::Arc { centre: q, .. }) => {
            let near = a.foot(*q);
            let far = [2.0 * p[0] - near[0], 2.0 * p[1] - near[1]];
            passing(a, b, near).min(passing(a, b, far))
        }
    };
    ends.into_iter().fold(passing, f64::min)
}

/// Distance of a point of the curve of `a` from `b`, if the point is on the element `a`.
fn passing(a: &Side, b: &Side, p: Point) -> f64 {
    if a.contains(p) { b.distance(p) } else { f64::INFINITY }
}

impl Side {
    /// Whether another element coincides with this one.
    fn is_at(&self, other: &Self) -> bool {
        let same = |a: f64, b: f64| (a - b).abs() <= SAME_MM;
        let at = |p: Point, q: Point| same(p[0], q[0]) && same(p[1], q[1]);
        match (self, other) {
            (Self::Line { from, to }, Self::Line { from: other_from, to: other_to }) => {
                at(*from, *other_from) && at(*to, *other_to)
            }
            (
                Self::Arc { centre, radius, sweep_rad, .. },
                Self::Arc { centre: c, radius: r, sweep_rad: s, .. },
            ) => {
                at(*centre, *c)
                    && same(*radius, *r)
                    && same(radius * sweep_rad, r * s)
                    && at(self.start_point(), other.start_point())
            }
            _ => false,
        }
    }

    /// Whether a point of the curve of the element lies between its ends.
    fn contains(&self, p: Point) -> bool {
        (0.0..=1.0).contains(&self.share_of(p))
    }

    /// Distance of a point from the element.
    pub(super) fn distance(&self, p: Point) -> f64 {
        let share = self.share_of(p);
        match self {
            Self::Line { .. } if (0.0..=1.0).contains(&share) => norm(sub(p, self.foot(p))),
            Self::Arc { centre, radius, .. } if share <= 1.0 => {
                (norm(sub(p, *centre)) - radius).abs()
            }
            Self::Line { .. } | Self::Arc { .. } => {
                norm(sub(p, self.start_point())).min(norm(sub(p, self.end_point())))
            }
        }
    }

    /// Half of its length.
    pub(super) fn reach(&self) -> f64 {
        self.middle().1
    }

    /// The midpoint of the element, and half of its length.
    fn middle(&self) -> (Point, f64) {
        match self {
            Self::Line { from, to } => {
                let middle = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
                (middle, 0.5 * norm(sub(*to, *from)))
            }
            Self::Arc { centre, radius, start_rad, sweep_rad } => {
                let (sin, cos) = libm::sincos(start_rad + 0.5 * sweep_rad);
                let middle = [centre[0] + radius * cos, centre[1] + radius * sin];
                (middle, 0.5 * radius * sweep_rad.abs())
            }
        }
    }

    /// Bounding box of the element; for an arc that of its circle.
    fn extent(&self) -> (Point, Point) {
        match self {
            Self::Line { from, to } => {
                ([from[0].min(to[0]), from[1].min(to[1])], [from[0].max(to[0]), from[1].max(to[1])])
            }
            Self::Arc { centre: [x, y], radius: r, .. } => ([x - r, y - r], [x + r, y + r]),
        }
    }
}
