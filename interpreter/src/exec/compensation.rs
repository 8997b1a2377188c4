//! Tool radius compensation: the path of the tool's centre at the distance of its radius from the contour.
//!
//! Outer corners are rounded by arcs about the corner, inner corners are the intersection of the parallels. The first
//! line behind G41 or G42 leads to the point perpendicular above the beginning of the next element, the first line
//! behind G40 leads back to the contour.
//!
//! Source: TF5200 programming manual, tool radius compensation (G26, G40 to G42, G139); 90008, 90031, 20651.
//! Assumption: the approach for every angle between approach and first element.

use super::arc::Point;
use super::contour::Motion;
use super::fault::{Fault, own};
use super::planar::{Curve, Side, cross, dot, intersections, norm, sub};
use super::step::{Event, SourceRef, Sync};
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::path::{ArcPath, ArcShape, LinePath, Path};
use std::f64::consts::{PI, TAU};

/// Steps between two motions that a corner may wait for.
const BETWEEN_MAX: usize = 1000;

/// What runs through the stages of the contour.
#[derive(Debug)]
pub(super) enum Item {
    Motion(Box<Motion>),
    Sync { what: Sync, source: SourceRef, events: Vec<Event> },
}

/// An element whose end is not known yet.
#[derive(Debug)]
struct Element {
    motion: Box<Motion>,
    side: Side,
    /// Where the tool's centre begins.
    start: Point,
    /// The line that leads to the parallel: its direction is not that of the contour.
    approach: bool,
}

/// Compensation in force.
#[derive(Debug)]
struct Active {
    /// Distance to the left of the contour, negative to the right.
    distance: f64,
    plane: [usize; 2],
    last: Element,
    between: Vec<Item>,
}

/// The stage.
#[derive(Debug, Default)]
pub(super) struct Compensator {
    active: Option<Box<Active>>,
    span: Span,
}

type Fallible<T> = Result<T, Box<Fault>>;

impl Compensator {
    /// A motion with its compensation; what is complete goes to `out`.
    pub(super) fn motion(&mut self, motion: Box<Motion>, out: &mut Vec<Item>) -> Fallible<()> {
        self.span = motion.span;
        let Some(active) = self.active.take() else {
            return self.select(motion, None, out);
        };
        let plane = active.plane;
        let Some(side) = moving_side(&motion.block.path, plane)? else {
            return self.outside_plane(active, motion);
        };
        let same = motion.compensation.is_some_and(|d| d.to_bits() == active.distance.to_bits());
        if same {
            let next = active.join(motion, side, out)?;
            self.active = Some(Box::new(next));
            return Ok(());
        }
        // another side or radius, or none: a line leads there
        if !matches!(side, Side::Line { .. }) {
            return Err(circular(&motion));
        }
        let at = active.finish(out)?;
        self.select(motion, Some(at), out)
    }

    /// A step at rest between motions.
    pub(super) fn sync(&mut self, item: Item, out: &mut Vec<Item>) -> Fallible<()> {
        let Some(active) = &mut self.active else {
            out.push(item);
            return Ok(());
        };
        if let Item::Sync {
            what: Sync::Stop | Sync::FlushWait | Sync::ReadActual, source, ..
        } = item
        {
            let text = "the channel cannot be flushed while tool radius compensation is active";
            return Err(Fault::vendor(20651, text, Span::default()).in_block(source));
        }
        active.hold(item, self.span)
    }

    /// The program ends: the last element ends perpendicular above its end.
    pub(super) fn end(&mut self, out: &mut Vec<Item>) -> Fallible<()> {
        match self.active.take() {
            Some(active) => active.finish(out).map(|_| ()),
            None => Ok(()),
        }
    }

    /// A motion without active compensation, `at` the place that an earlier one has left.
    fn select(
        &mut self,
        mut motion: Box<Motion>,
        at: Option<Point>,
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        let plane = motion.plane;
        if let Some(at) = at {
            let path = &motion.block.path;
            let end = [path.end()[plane[0]], path.end()[plane[1]]];
            match line(&motion, plane, at, end) {
                Some(path) => motion.block.path = path,
                None => return Ok(()),
            }
        }
        let Some(distance) = motion.compensation else {
            out.push(Item::Motion(motion));
            return Ok(());
        };
        let Some(side) = moving_side(&motion.block.path, plane)? else {
            // the approach is still to come
            out.push(Item::Motion(motion));
            return Ok(());
        };
        let Side::Line { from, .. } = side else { return Err(circular(&motion)) };
        let last = Element { motion, side, start: from, approach: true };
        self.active = Some(Box::new(Active { distance, plane, last, between: Vec::new() }));
        Ok(())
    }

    /// A motion of other axes only: it happens at the corner.
    fn outside_plane(&mut self, mut active: Box<Active>, motion: Box<Motion>) -> Fallible<()> {
        let span = motion.span;
        // G40 acts with the next motion in the plane
        let held = active.hold(Item::Motion(motion), span);
        self.active = Some(active);
        held
    }
}

impl Active {
    fn hold(&mut self, item: Item, span: Span) -> Fallible<()> {
        if self.between.len() >= BETWEEN_MAX {
            let text = format!("more than {BETWEEN_MAX} blocks without motion in the plane");
            return Err(Fault::kontur(own::COMPENSATION, text, span));
        }
        self.between.push(item);
        Ok(())
    }

    /// Completes the last element at the corner to the next one.
    fn join(self, motion: Box<Motion>, side: Side, out: &mut Vec<Item>) -> Fallible<Self> {
        let Self { distance, plane, last, between } = self;
        let (span, source) = (motion.span, motion.source);
        let corner = side.start_point();
        let after = above(corner, side.tangent(false), distance);
        if last.approach {
            let at = after;
            last.emit(at, plane, distance, out)?;
            emit_between(between, at, plane, out);
            let last = Element { motion, side, start: at, approach: false };
            return Ok(Self { distance, plane, last, between: Vec::new() });
        }
        let (u, w) = (last.side.tangent(true), side.tangent(false));
        let before = above(corner, u, distance);
        let turn = cross(u, w);
        let smooth = turn.abs() < 1e-9 && dot(u, w) > 0.0;
        let start = if smooth {
            last.emit(before, plane, distance, out)?;
            emit_between(between, before, plane, out);
            before
        } else if turn * distance < 0.0 || (turn.abs() < 1e-9 && dot(u, w) < 0.0) {
            let template = last.motion.clone();
            last.emit(before, plane, distance, out)?;
            emit_between(between, before, plane, out);
            out.extend(corner_arc(&template, &motion, plane, corner, before, after, distance));
            after
        } else {
            let at = inner_corner(&last.side, &side, corner, distance)
                .ok_or_else(|| too_tight(span, source))?;
            last.emit(at, plane, distance, out)?;
            emit_between(between, at, plane, out);
            at
        };
        let last = Element { motion, side, start, approach: false };
        Ok(Self { distance, plane, last, between: Vec::new() })
    }

    /// Completes the last element perpendicular above its end and tells where that is.
    fn finish(self, out: &mut Vec<Item>) -> Fallible<Point> {
        let Self { distance, plane, last, between } = self;
        let at = above(last.side.end_point(), last.side.tangent(true), distance);
        last.emit(at, plane, distance, out)?;
        emit_between(between, at, plane, out);
        Ok(at)
    }
}

impl Element {
    /// The element from its start to `end`, both on the parallel.
    fn emit(
        self,
        end: Point,
        plane: [usize; 2],
        distance: f64,
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        let Self { mut motion, side, start, approach } = self;
        let path = match &side {
            Side::Line { .. } => {
                let along = dot(sub(end, start), side.tangent(false));
                if along < 0.0 && !approach {
                    return Err(too_tight(motion.span, motion.source));
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
                    let fault = Fault::vendor(90031, text, motion.span);
                    return Err(fault.in_block(motion.source));
                }
                let sweep_rad = trimmed(&side, start, end);
                if sweep_rad * side_sweep(&side) <= 0.0 {
                    return Err(too_tight(motion.span, motion.source));
                }
                let shape = ArcShape { plane, centre_mm: *centre, sweep_rad };
                let (from, to) = ends(&motion, plane, start, end);
                ArcPath::new(from, to, shape, &motion.block.dynamics.feed_axes).map(Path::Arc)
            }
        };
        if let Some(path) = path {
            motion.block.path = path;
            out.push(Item::Motion(motion));
        }
        Ok(())
    }
}

/// Start and end of a motion with other places in the plane.
fn ends(motion: &Motion, plane: [usize; 2], start: Point, end: Point) -> (AxisVec, AxisVec) {
    let place = |v: &AxisVec, p: Point| {
        let mut v = v.clone();
        (v[plane[0]], v[plane[1]]) = (p[0], p[1]);
        v
    };
    (place(motion.block.path.start(), start), place(motion.block.path.end(), end))
}

fn line(motion: &Motion, plane: [usize; 2], start: Point, end: Point) -> Option<Path> {
    let (from, to) = ends(motion, plane, start, end);
    LinePath::new(from, to, &motion.block.dynamics.feed_axes).map(Path::Line)
}

/// The part of a path within the plane; `None` if it does not move there.
fn moving_side(path: &Path, plane: [usize; 2]) -> Fallible<Option<Side>> {
    let moves = plane.iter().any(|i| path.start()[*i].to_bits() != path.end()[*i].to_bits());
    if !moves && path.is_straight() {
        return Ok(None);
    }
    if let Some(side) = Side::of(path, plane) {
        Ok(Some(side))
    } else {
        let what = "an arc outside the plane with tool radius compensation";
        Err(Fault::unsupported(what, Span::default()))
    }
}

/// The point at a distance to the left of a direction.
fn above(p: Point, direction: Point, distance: f64) -> Point {
    [p[0] - distance * direction[1], p[1] + distance * direction[0]]
}

/// Steps between two motions, at the place of the tool.
fn emit_between(between: Vec<Item>, at: Point, plane: [usize; 2], out: &mut Vec<Item>) {
    for item in between {
        match item {
            Item::Motion(mut motion) => {
                if let Some(path) = line(&motion, plane, at, at) {
                    motion.block.path = path;
                    out.push(Item::Motion(motion));
                }
            }
            Item::Sync { .. } => out.push(item),
        }
    }
}

/// Arc about an outer corner.
fn corner_arc(
    before: &Motion,
    after: &Motion,
    plane: [usize; 2],
    corner: Point,
    from: Point,
    to: Point,
    distance: f64,
) -> Option<Item> {
    let (a, b) = (sub(from, corner), sub(to, corner));
    let angle = libm::atan2(cross(a, b), dot(a, b));
    // to the left of the contour the tool turns clockwise about the corner
    let sweep_rad = match (distance > 0.0, angle > 0.0) {
        (true, true) => angle - TAU,
        (false, false) => angle + TAU,
        _ => angle,
    };
    let shape = ArcShape { plane, centre_mm: corner, sweep_rad };
    let place = |p: Point| {
        let mut v = after.block.path.start().clone();
        (v[plane[0]], v[plane[1]]) = (p[0], p[1]);
        v
    };
    let feed_axes = &after.block.dynamics.feed_axes;
    let path = ArcPath::new(place(from), place(to), shape, feed_axes)?;
    let mut arc = before.clone();
    arc.block.path = Path::Arc(path);
    arc.events.clear();
    Some(Item::Motion(Box::new(arc)))
}

/// Intersection of the parallels nearest to the corner, if it lies on both elements.
fn inner_corner(a: &Side, b: &Side, corner: Point, distance: f64) -> Option<Point> {
    let (p, q): (Curve, Curve) = (a.parallel(distance), b.parallel(distance));
    intersections(&p, &q)
        .into_iter()
        .filter(|x| on(a, a.foot(*x)) && on(b, b.foot(*x)))
        .min_by(|x, y| norm(sub(*x, corner)).total_cmp(&norm(sub(*y, corner))))
}

fn on(side: &Side, foot: Point) -> bool {
    (-1e-9..=1.0 + 1e-9).contains(&side.share_of(foot))
}

fn side_sweep(side: &Side) -> f64 {
    match side {
        Side::Line { .. } => 0.0,
        Side::Arc { sweep_rad, .. } => *sweep_rad,
    }
}

/// Swept angle of an arc between other ends; a trim is less than half a turn.
fn trimmed(side: &Side, start: Point, end: Point) -> f64 {
    let Side::Arc { centre, start_rad, sweep_rad, .. } = side else { return 0.0 };
    let angle = |p: Point| {
        let r = sub(p, *centre);
        libm::atan2(r[1], r[0])
    };
    let small = |x: f64| x - TAU * ((x + PI) / TAU).floor();
    let at_start = small(angle(start) - start_rad);
    let at_end = small(angle(end) - (start_rad + sweep_rad));
    sweep_rad - at_start + at_end
}

fn circular(motion: &Motion) -> Box<Fault> {
    let text =
        "tool radius compensation is selected, changed and cancelled in straight motions only";
    Fault::vendor(90008, text, motion.span).in_block(motion.source)
}

fn too_tight(span: Span, source: SourceRef) -> Box<Fault> {
    let text = "the contour is too tight for the radius of the tool";
    Fault::kontur(own::COMPENSATION, text, span).in_block(source)
}
