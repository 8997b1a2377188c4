//! Positions where a compensated tool cuts into its own contour: gaps narrower than the tool, loops over several blocks.
//!
//! As in the control, the compensation checks only the corners between neighbouring elements: a bottleneck anywhere else is not
//! detected there (source: TF5200 programming manual, limits of tool radius compensation), and the path is executed. Therefore
//! it is a warning here, once per program.

use super::item::Item;
use super::motion::Motion;
use crate::exec::geometry::planar::{Side, intersections};
use crate::exec::geometry::point::{Point, cross, dot, norm, sub};
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
    /// Tool radius at its start and end in mm, linear in between; 0 for an element of the contour. It differs on lines only.
    radii: [f64; 2],
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
        let repeats = |other: &Part| other.side.is_at(&part.side) && other.has_radii_of(&part);
        if self.around(&part, SAME_MM).any(repeats) {
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
    /// The largest tool radius so far, in mm.
    largest: f64,
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
    /// Tool radius at this position, in mm.
    pub(in crate::exec::contour) radius_mm: f64,
}

impl Watch {
    /// Called when an element of the contour is complete: `way` is the tool path along it, including the elements inserted
    /// after it, with the tool radius at the start and end of the first one; the others have that of its end. Without `side`
    /// only the corner is new.
    pub(in crate::exec) fn element(
        &mut self,
        side: Option<Side>,
        source: SourceRef,
        way: &[Item],
        plane: [usize; 2],
        mut radii: [f64; 2],
    ) -> Option<Cut> {
        let mut found = side.and_then(|side| self.contour(side, source));
        for item in way {
            if let Item::Motion(motion) = item {
                found = found.or(self.motion(motion, plane, radii));
                radii = [radii[1]; 2];
            }
        }
        self.next += 1;
        found
    }

    /// A motion of the tool with its radius at start and end: part of the next element.
    pub(in crate::exec) fn motion(
        &mut self,
        motion: &Motion,
        plane: [usize; 2],
        radii: [f64; 2],
    ) -> Option<Cut> {
        let part = self.part(Side::of(&motion.block.path, plane)?, motion.source, radii);
        let radius = part.radius();
        self.largest = self.largest.max(radius);
        let found = self.contour.first(&part, radius, |contour| cut(&part, contour));
        self.way.push(part);
        found
    }

    fn contour(&mut self, side: Side, source: SourceRef) -> Option<Cut> {
        let part = self.part(side, source, [0.0; 2]);
        let found = self.way.first(&part, self.largest, |way| cut(way, &part));
        self.contour.push(part);
        found
    }

    fn part(&mut self, side: Side, source: SourceRef, radii: [f64; 2]) -> Part {
        self.parts += 1;
        Part::new(side, source, radii, (self.next, self.parts))
    }
}

impl Part {
    fn new(side: Side, source: SourceRef, radii: [f64; 2], (number, place): (u64, u64)) -> Self {
        let (middle, half) = side.middle();
        let (low, high) = side.extent();
        let low = [low[0].max(middle[0] - half), low[1].max(middle[1] - half)];
        let high = [high[0].min(middle[0] + half), high[1].min(middle[1] + half)];
        Self { side, radii, low, high, middle, half, source, number, place }
    }

    /// The largest tool radius along it.
    fn radius(&self) -> f64 {
        self.radii[0].max(self.radii[1])
    }

    fn has_radii_of(&self, other: &Self) -> bool {
        (0..2).all(|i| (self.radii[i] - other.radii[i]).abs() <= SAME_MM)
    }

    /// Whether the boxes are further apart than `gap`.
    fn is_beyond(&self, other: &Self, gap: f64) -> bool {
        (0..2).any(|i| self.low[i] > other.high[i] + gap || other.low[i] > self.high[i] + gap)
    }
}

/// Position where the tool on `way` comes closer to `contour` than its radius. Along its own element the distance is correct.
fn cut(way: &Part, contour: &Part) -> Option<Cut> {
    let radius = way.radius();
    let between = norm(sub(way.middle, contour.middle)) - way.half - contour.half;
    if way.number == contour.number || between >= radius || way.is_beyond(contour, radius) {
        return None;
    }
    let (distance_mm, radius_mm) = deepest(way, contour);
    let found = Cut { tool: way.source, contour: contour.source, distance_mm, radius_mm };
    (distance_mm < radius_mm - TOLERANCE_MM).then_some(found)
}

/// Distance and tool radius where the tool on `way` reaches furthest into an element of the contour: at an intersection, at an
/// end of one of them, or inside both where one of them is an arc.
fn deepest(way: &Part, contour: &Part) -> (f64, f64) {
    let (a, b) = (&way.side, &contour.side);
    let crossing = || {
        let points = intersections(&a.parallel(0.0), &b.parallel(0.0));
        points.into_iter().find(|p| a.contains(*p) && b.contains(*p))
    };
    let [first, last] = way.radii;
    let at_crossing = if way.is_beyond(contour, 0.0) { None } else { crossing() };
    if let Some(at) = at_crossing {
        return (0.0, first + a.share_of(at) * (last - first));
    }
    let ends = [b.start_point(), b.end_point()];
    match (a, b) {
        (Side::Line { from, to }, _) => {
            let centre = if let Side::Arc { centre, .. } = b { Some(*centre) } else { None };
            let shares = ends.into_iter().chain(centre).map(|p| nearest(*from, *to, way.radii, p));
            let at = |share: f64| {
                let p = [0, 1].map(|i| from[i] + share * (to[i] - from[i]));
                (b.distance(p), first + share * (last - first))
            };
            let all = shares.chain([0.0, 1.0]).map(at);
            let depth = |(distance, radius): &(f64, f64)| distance - radius;
            all.min_by(|p, q| depth(p).total_cmp(&depth(q))).unwrap_or((f64::INFINITY, last))
        }
        (Side::Arc { centre: p, .. }, _) => {
            let inside = match b {
                Side::Line { .. } => passing(b, a, b.foot(*p)),
                Side::Arc { centre: q, .. } => {
                    let near = a.foot(*q);
                    let far = [2.0 * p[0] - near[0], 2.0 * p[1] - near[1]];
                    passing(a, b, near).min(passing(a, b, far))
                }
            };
            let of_way = [a.start_point(), a.end_point()].map(|p| b.distance(p));
            let of_contour = ends.map(|p| a.distance(p));
            (of_way.into_iter().chain(of_contour).fold(inside, f64::min), last)
        }
    }
}

/// Share 0..1 of a line at which distance from a point less radius, which is linear along the line, is smallest.
fn nearest(from: Point, to: Point, [first, last]: [f64; 2], p: Point) -> f64 {
    let along = sub(to, from);
    let length = norm(along);
    let foot = dot(sub(p, from), along) / length;
    let aside = (cross(along, sub(p, from)) / length).abs();
    let growth = (last - first) / length;
    let at = if growth.abs() < 1.0 {
        foot + growth * aside / (1.0 - growth * growth).sqrt()
    } else {
        // the radius changes faster than any distance
        growth * f64::INFINITY
    };
    (at / length).clamp(0.0, 1.0)
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
