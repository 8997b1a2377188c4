//! Tool radius compensation: the tool centre path at the distance of the tool radius from the contour.
//!
//! Outer corners are passed on arcs about the corner (G26) or on lines (G25); at inner corners the parallels intersect. The
//! first line after G41 or G42 ends perpendicular to the start of the next element, the first line after G40 returns to the
//! contour. With G237 both are lines perpendicular to the contour, and the contour may start and end with arcs. With G05 the
//! lines of approach and departure become arcs that touch the parallel. With G238 approach and departure of a closed contour
//! are at an inside corner; with G239 the tool keeps its position after G40.
//!
//! Source: TF5200 programming manual, tool radius compensation (G25, G26, G40 to G42, G138, G139, G237 to G239); generation
//! of compensation blocks; restrictions of inside corner selection; 90008, 90017, 90031, 90050, 90127, 20651. Derived: the lines
//! of G25 from the numbers of inserted blocks that the manual lists by angle.
//! Assumption: the approach is the same for every angle between approach and first element, with G139 as with G138; the figures
//! of the manual show more lines for G139 at outer corners.

mod active;
mod corner;
mod element;
mod ends;
mod failure;
mod inside;
mod radius;
mod tangential;

use super::bottleneck::{Cut, Watch};
use super::item::{Item, Rest, vanished};
use crate::diag::Condition;
use crate::exec::block::choice::Selection;
use crate::exec::contour::motion::{Compensated, Motion};
use crate::exec::fault::Fault;
use crate::exec::geometry::planar::Side;
use crate::exec::geometry::point::Point;
use crate::exec::step::{SourceRef, Sync};
use crate::syntax::ast::Span;
use active::Active;
use corner::{above, straight_before};
use element::{Course, Element, moving_side, runs_back};
use ends::line;
use failure::Fallible;
use inside::Closed;
use kontur_motion::path::Path;

use tangential::Touch;

/// The stage.
#[derive(Debug, Default)]
pub(in crate::exec) struct Compensator {
    active: Option<Box<Active>>,
    /// A closed contour that is still incomplete (G238).
    closed: Option<Box<Closed>>,
    /// The last motion.
    source: SourceRef,
    /// The first bottleneck, until it is reported.
    cut: Option<Cut>,
    told: bool,
    /// Whether the next motion in the plane starts or ends compensation with an arc (G05).
    tangential: bool,
    /// Whether G40 is programmed; the next motion in the plane is the departure.
    pub(in crate::exec::contour) deselected: bool,
}

impl Compensator {
    /// Processes a motion with its compensation; completed items are appended to `out`.
    pub(in crate::exec) fn motion(
        &mut self,
        motion: Box<Motion>,
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        self.source = motion.source;
        self.next(motion, out).map_err(|f| f.in_block(self.source))
    }

    /// Whether compensation is active: from G41 or G42 until the motion after G40.
    pub(in crate::exec) fn is_active(&self) -> bool {
        self.active.is_some() || self.closed.is_some()
    }

    /// Whether the departure is still to come after a motion along this path: it is the next motion in the plane. With G237 the
    /// tool has left before it.
    pub(in crate::exec::contour) fn awaits_departure(&self, path: Option<&Path>) -> bool {
        let departs = |plane: [usize; 2]| {
            path.is_some_and(|path| {
                plane.iter().any(|i| path.start()[*i].to_bits() != path.end()[*i].to_bits())
            })
        };
        self.deselected
            && self.active.as_ref().is_some_and(|a| !a.perpendicular && !departs(a.plane))
    }

    /// Motions without compensation pass unchanged.
    pub(in crate::exec) fn is_idle(&self) -> bool {
        !self.is_active() && !self.tangential && self.cut.is_none()
    }

    /// G40 with G239: axes of the plane, and the current position of the tool centre.
    pub(in crate::exec) fn leave(
        &mut self,
        out: &mut Vec<Item>,
    ) -> Fallible<Option<([usize; 2], Point)>> {
        let Some(active) = self.active.take() else { return Ok(None) };
        if active.tilt.is_some() {
            let what = "G239 in a plane askew to the axes";
            return Err(Fault::unsupported(what, Span::default()).in_block(self.source));
        }
        let plane = active.plane;
        let mut found = None;
        let at = active.finish(out, &mut found).map_err(|f| f.in_block(self.source))?;
        self.found(found);
        Ok(Some((plane, at)))
    }

    /// The first bottleneck of the program, returned once.
    pub(in crate::exec) fn take_cut(&mut self) -> Option<Cut> {
        let cut = self.cut.take();
        self.told |= cut.is_some();
        cut
    }

    fn found(&mut self, cut: Option<Cut>) {
        if !self.told {
            self.cut = self.cut.or(cut);
        }
    }

    fn next(&mut self, motion: Box<Motion>, out: &mut Vec<Item>) -> Fallible<()> {
        self.tangential |= motion.tangential;
        if let Some(closed) = self.closed.take() {
            return self.next_of_closed(closed, motion, out);
        }
        match self.active.take() {
            Some(active) => self.next_of(active, motion, out),
            None => self.select(motion, None, out),
        }
    }

    /// A motion of a closed contour, or the first one after it.
    fn next_of_closed(
        &mut self,
        mut closed: Box<Closed>,
        motion: Box<Motion>,
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        let Some(motion) = closed.gather(motion)? else {
            self.closed = Some(closed);
            return Ok(());
        };
        if !motion.block.path.is_straight() {
            return Err(circular(&motion));
        }
        let (at, cut) = closed.close(out)?;
        self.found(cut);
        self.select(motion, Some((at, None)), out)
    }

    /// A motion while compensation is active.
    fn next_of(
        &mut self,
        active: Box<Active>,
        motion: Box<Motion>,
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        if active.tilt != motion.tilt {
            let what = "a change of the coordinate system during tool radius compensation";
            return Err(Fault::unsupported(what, motion.span));
        }
        let Some(side) = moving_side(&motion, active.plane)? else {
            return self.outside_plane(active, motion);
        };
        let tangential = std::mem::take(&mut self.tangential);
        if tangential && (motion.compensation.is_some() || active.perpendicular) {
            let what = "G05 with a change of side or radius, or after G237";
            return Err(Fault::unsupported(what, motion.span));
        }
        let mut found = None;
        let next = match motion.compensation {
            Some(c) if c.distance_mm.to_bits() == active.distance.to_bits() => {
                active.join(motion, side, out, &mut found)?
            }
            Some(c)
                if c.reverse
                    && c.distance_mm.to_bits() == (-active.distance).to_bits()
                    && !active.last.course.approaches()
                    && runs_back(&active.last.side, &side) =>
            {
                active.turn_back(motion, side, out, &mut found)?
            }
            Some(c) if c.distance_mm * active.distance >= 0.0 => {
                let distance = c.distance_mm;
                if c.perpendicular_change {
                    active.change_across(motion, side, distance, out, &mut found)?
                } else if matches!(side, Side::Line { .. }) {
                    active.change_along(motion, side, distance, out, &mut found)?
                } else {
                    let text =
                        "the tool radius changes before an arc: a straight motion must lead to it";
                    return Err(Fault::new(Condition::RadiusChangeInArc, text, motion.span)
                        .in_block(motion.source));
                }
            }
            _ => return self.connect(active, motion, &side, tangential, out),
        };
        self.active = Some(Box::new(next));
        self.found(found);
        Ok(())
    }

    /// Leaves the contour for another side of it, or for none: connected by a line.
    fn connect(
        &mut self,
        active: Box<Active>,
        motion: Box<Motion>,
        side: &Side,
        tangential: bool,
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        let mut found = None;
        let across = motion.compensation.is_some_and(|c| c.selection == Selection::Perpendicular);
        if active.perpendicular || across {
            active.return_to_contour(out, &mut found)?;
            self.found(found);
            return self.select(motion, None, out);
        }
        if !matches!(side, Side::Line { .. }) {
            return Err(circular(&motion));
        }
        let away = tangential.then(|| active.last.side.tangent(true));
        let at = active.finish(out, &mut found)?;
        self.found(found);
        self.select(motion, Some((at, away)), out)
    }

    /// A step at standstill between motions.
    pub(in crate::exec) fn sync(&mut self, rest: Rest, out: &mut Vec<Item>) -> Fallible<()> {
        if self.active.is_none() && self.closed.is_none() {
            out.push(Item::Rest(Box::new(rest)));
            return Ok(());
        }
        let flushes = matches!(
            rest.what,
            Sync::Stop
                | Sync::Halt
                | Sync::FlushWait
                | Sync::ReadActual
                | Sync::TakeActual
                | Sync::SetPosition { .. }
        );
        if flushes {
            let (condition, text) = if self.deselected {
                let text = "the channel cannot be flushed before the motion that ends tool radius compensation";
                (Condition::FlushAfterCompensation, text)
            } else {
                let text = "the channel cannot be flushed while tool radius compensation is active";
                (Condition::FlushWithCompensation, text)
            };
            return Err(Fault::new(condition, text, Span::default()).in_block(rest.source));
        }
        let item = Item::Rest(Box::new(rest));
        match (&mut self.active, &mut self.closed) {
            (_, Some(closed)) => closed.hold(item, Span::default()),
            (Some(active), None) => active.hold(item, Span::default()),
            (None, None) => Ok(()),
        }
    }

    /// An error ends the program: items that need the end of their contour are not executed.
    pub(in crate::exec) fn abandon(&mut self) {
        self.closed = None;
    }

    /// End of the program: the last element ends perpendicular to its end.
    pub(in crate::exec) fn end(&mut self, out: &mut Vec<Item>) -> Fallible<()> {
        let mut found = None;
        let ended = match (self.closed.take(), self.active.take()) {
            (Some(closed), _) => closed.close(out).map(|(_, cut)| found = cut),
            (None, Some(active)) => active.finish(out, &mut found).map(|_| ()),
            (None, None) => Ok(()),
        };
        self.found(found);
        ended.map_err(|f| f.in_block(self.source))
    }

    /// A motion without active compensation; `at` is the position left by an earlier one, with its direction there if the
    /// departure is an arc (G05).
    fn select(
        &mut self,
        mut motion: Box<Motion>,
        at: Option<(Point, Option<Point>)>,
        out: &mut Vec<Item>,
    ) -> Fallible<()> {
        let plane = motion.plane;
        // the element as programmed: its direction applies, not that of the tool from its current position
        let programmed = match motion.compensation {
            Some(_) => moving_side(&motion, plane)?,
            None => None,
        };
        if let Some(left) = at {
            let Some(path) = from_tool(&motion, left)? else {
                vanished(motion.events, out);
                return Ok(());
            };
            motion.block.path = path;
        }
        let Some(Compensated { distance_mm: distance, selection, .. }) = motion.compensation else {
            self.tangential = false;
            out.push(Item::Motion(motion));
            return Ok(());
        };
        let Some(side) = programmed else {
            // the approach is still incomplete
            out.push(Item::Motion(motion));
            return Ok(());
        };
        let perpendicular = selection == Selection::Perpendicular;
        let tangential = std::mem::take(&mut self.tangential);
        if tangential && perpendicular {
            return Err(Fault::unsupported("G05 with G237", motion.span));
        }
        if selection == Selection::InsideCorner {
            if !matches!(side, Side::Line { .. }) {
                return Err(circular(&motion));
            }
            self.closed = Some(Box::new(Closed::new(motion, distance)));
            return Ok(());
        }
        let tilt = motion.tilt.clone();
        let (start, course) = if perpendicular {
            (onto_parallel(&mut motion, side, distance, out), Course::Parallel)
        } else if let Side::Line { from, .. } = side {
            let course = if tangential { Course::TangentialApproach } else { Course::Approach };
            (at.map_or(from, |(tool, _)| tool), course)
        } else {
            return Err(circular(&motion));
        };
        let watch = Watch::default();
        let last = Element { motion, side, start, course };
        let between = Vec::new();
        let active = Active { distance, perpendicular, plane, tilt, last, between, watch };
        self.active = Some(Box::new(active));
        Ok(())
    }

    /// A motion of other axes only, executed at the corner.
    fn outside_plane(&mut self, mut active: Box<Active>, motion: Box<Motion>) -> Fallible<()> {
        let span = motion.span;
        // G40 takes effect with the next motion in the plane
        let held = active.hold(Item::Motion(motion), span);
        self.active = Some(active);
        held
    }
}

/// The path of a motion from the position at which the tool was left, along an arc if it was left on one (G05); `None` if nothing is
/// left of it.
fn from_tool(motion: &Motion, (at, away): (Point, Option<Point>)) -> Fallible<Option<Path>> {
    let (plane, path) = (motion.plane, &motion.block.path);
    let end = [path.end()[plane[0]], path.end()[plane[1]]];
    Ok(match away {
        Some(tangent) => tangential::way(motion, plane, (at, end), tangent, Touch::Start)?,
        None => line(motion, plane, at, end),
    })
}

/// G237: a straight motion to the point above the start of the contour, which the function returns.
fn onto_parallel(motion: &mut Motion, side: Side, distance: f64, out: &mut Vec<Item>) -> Point {
    let from = side.start_point();
    let start = above(from, side.tangent(false), distance);
    let there = straight_before(motion, motion.block.path.start(), motion.plane, from, start);
    if let Some(mut there) = there {
        there.events = std::mem::take(&mut motion.events);
        out.push(Item::Motion(there));
    }
    start
}

fn circular(motion: &Motion) -> Box<Fault> {
    let text =
        "tool radius compensation is selected, changed and cancelled in straight motions only";
    Fault::new(Condition::CompensationInArc, text, motion.span).in_block(motion.source)
}
