//! From programmed motions to steps: a motion is held until the next one is known if an element may be inserted between them.

pub(super) mod akima;
pub(super) mod bottleneck;
pub(super) mod compensation;
pub(super) mod contouring;
mod cutting_feed;
mod feed_course;
mod guarded;
pub(super) mod insertion;
mod interim;
mod item;
mod motion;
mod output;
mod passing;

use self::akima::{Akima, Curve};
use self::compensation::Compensator;
use self::contouring::{ContourParameters, Hsc};
use self::insertion::{Inserted, Insertion};
use self::interim::Interim;
use self::item::{Item, Rest};
use super::fault::{Fault, Outcome};
use super::geometry::point::Point;
use super::report::Report;
use super::step::{AtCorner, EndReason, Event, SourceRef, Step, Sync};
use crate::diag::Condition;
use crate::syntax::ast::Span;
use kontur_motion::block::SplineSettings;
use kontur_motion::path::Path;
use passing::Passing;
use std::collections::VecDeque;

pub(super) use cutting_feed::CuttingFeed;
pub(super) use guarded::{Guarded, violated};
pub(super) use motion::{
    Compensated, Corner, CornerFeed, Driven, FeedCourse, Motion, PathOf, local_ends,
    programmed_time_s,
};

/// Motions and events to be sent to the simulation.
#[derive(Debug, Default)]
pub(super) struct Contour {
    /// `#CONTOUR MODE`.
    pub(super) contouring: ContourParameters,
    /// `#HSC`.
    pub(super) hsc: Hsc,
    /// Steps in order, without the numbers of their blocks yet.
    queue: VecDeque<Item>,
    /// The end, after the queue.
    end: Option<Box<Step>>,
    /// Items that the compensation has just completed.
    done: Vec<Item>,
    events: Vec<Event>,
    /// Events of motions that the compensation has removed, for the next step.
    stray: Vec<Event>,
    held: Option<Box<Motion>>,
    insertion: Option<Box<Insertion>>,
    compensator: Compensator,
    /// Whether the next motion starts or ends compensation with an arc (G05).
    pub(super) tangential: bool,
    /// G151.
    pub(super) akima: Akima,
    interim: Interim,
    driven: Vec<Driven>,
    /// Control areas violated by motions since the last call.
    violations: Vec<Fault>,
    blocks: u64,
    /// Whether the position of the tool at the contour must be reported (`#OTC`), and the last reported one.
    tells_engagement: bool,
    engaged: Option<([usize; 2], bool)>,
    /// Whether the last motion ended with an exact stop.
    stopped_exactly: bool,
    /// The corner at which the path waits, after the last motion has left.
    waits_at: Passing,
}

impl Contour {
    /// The state at program start, with the settings of `#HSC [BSPLINE]` of the channel list.
    pub(super) fn start(spline: SplineSettings) -> Self {
        let mut contour = Self::default();
        contour.hsc.spline = spline;
        contour
    }

    /// `#OTC`: from here on the simulation needs the position of the tool at the contour.
    pub(super) fn report_engagement(&mut self) {
        self.tells_engagement = true;
    }

    pub(super) fn event(&mut self, event: Event) {
        self.events.push(event);
    }

    /// Whether a chamfer or rounding is pending until the next motion.
    pub(super) fn inserts(&self) -> bool {
        self.insertion.is_some()
    }

    /// Number of events pending until the next step.
    pub(super) fn waiting(&self) -> usize {
        self.events.len()
    }

    /// Events pending until the next step.
    pub(super) fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Discards the last motion: its block has an error.
    pub(super) fn drop_held(&mut self) {
        if self.akima.drop_last() {
            return;
        }
        self.held = None;
        self.insertion = None;
    }

    /// G301, G302 and related functions: between the previous motion and the next one.
    pub(super) fn insert(&mut self, insertion: Insertion) -> Option<Box<Fault>> {
        let span = insertion.span;
        if self.akima.runs() {
            return Some(Fault::unsupported("a chamfer or rounding in a spline", span));
        }
        if self.stopped_exactly {
            // the pages do not say whether it is inserted, and where the path then stops
            return Some(Fault::unsupported("a chamfer or rounding at an exact stop", span));
        }
        if self.held.is_none() {
            let text = "no earlier motion to which a chamfer or rounding could be joined";
            return Some(Fault::new(Condition::InsertionWithoutMotion, text, span).warning());
        }
        let before = self.insertion.replace(Box::new(insertion));
        before.map(|_| {
            let text = "two insertions without a motion between them, the last one is used";
            Fault::new(Condition::InsertionsWithoutMotion, text, span).warning()
        })
    }

    /// A motion.
    pub(super) fn motion(&mut self, motion: Box<Motion>) -> Vec<Fault> {
        self.stopped_exactly = false;
        if !motion.akima && !self.akima.runs() {
            self.akima.pass(&motion);
            return self.joined(motion);
        }
        let mut curves = Vec::new();
        let unused = motion.akima.then(|| self.akima.unused_start(&motion)).flatten();
        let (outcome, behind) = if motion.akima {
            (self.akima.point(motion, self.held.as_deref(), &mut curves), None)
        } else {
            self.akima.moved = true;
            (self.akima.finish(Some(&motion), &mut curves), Some(motion))
        };
        let mut faults = self.splined(curves, outcome);
        faults.extend(unused);
        faults.extend(behind.into_iter().flat_map(|behind| self.joined(behind)));
        faults
    }

    /// Segments of splines continue.
    fn splined(&mut self, curves: Vec<Curve>, outcome: Outcome<()>) -> Vec<Fault> {
        let mut faults = Vec::new();
        for curve in curves {
            let (driven, motion) = curve.parts();
            self.driven.push(driven);
            faults.extend(self.joined(motion));
        }
        faults.extend(outcome.err().map(|fault| *fault));
        faults
    }

    /// Used while a program is only examined: a straight motion with the settings of the held one may replace it, because the
    /// held one would be output unchanged.
    pub(super) fn lets_by(&self) -> bool {
        let nothing_waits = self.queue.is_empty() && self.end.is_none() && self.events.is_empty();
        nothing_waits
            && self
                .held
                .as_ref()
                .is_some_and(|held| self.goes_out_as_it_is(held) && self.interim.lets_by(held))
            && !self.akima.runs()
            && !self.tangential
    }

    /// Replaces the held motion by a line, and returns the time in s of the held one; `None`, without an effect, if no axis
    /// moves along the line.
    pub(super) fn pass_by(
        &mut self,
        (start, end): (&[f64], &[f64]),
        feed_axes: &[bool],
        source: SourceRef,
        span: Span,
    ) -> Option<f64> {
        let held = self.held.as_mut()?;
        let time_s = programmed_time_s(&held.block);
        let Path::Line(line) = &mut held.block.path else { return None };
        if !line.lead(start, end, feed_axes) {
            return None;
        }
        (held.source, held.span) = (source, span);
        held.events.clear();
        self.blocks += 1;
        Some(time_s)
    }

    /// Whether nothing is inserted between a motion and the next one, and nothing changes it.
    fn goes_out_as_it_is(&self, motion: &Motion) -> bool {
        self.insertion.is_none() && self.compensator.is_idle() && motion.is_complete()
    }

    fn joined(&mut self, mut motion: Box<Motion>) -> Vec<Fault> {
        let mut faults = Vec::new();
        if let Some(mut before) = self.held.take() {
            if self.goes_out_as_it_is(&before) {
                self.go_out(Item::Motion(before));
                self.held = Some(motion);
                return faults;
            }
            let inserted = match self.insertion.take() {
                Some(insertion) => {
                    before.enter_tilt();
                    motion.enter_tilt();
                    insertion::between(&mut before, &mut motion, &insertion)
                        .map_err(|f| f.in_block(insertion.source))
                }
                None => Ok(None),
            };
            let Inserted { motion: mut element, leaves } = match inserted {
                Ok(Some(inserted)) => inserted,
                nothing => {
                    faults.extend(self.compensate(before).map(|f| *f));
                    faults.extend(nothing.err().map(|f| *f));
                    self.held = Some(motion);
                    return faults;
                }
            };
            if leaves[0] {
                faults.extend(self.compensate(before).map(|f| *f));
            } else {
                element.events.splice(0..0, before.events);
            }
            if leaves[1] {
                faults.extend(self.compensate(element).map(|f| *f));
            } else {
                motion = element;
            }
        }
        self.held = Some(motion);
        faults
    }

    /// Stops the path after the last motion, with K-0111 once if that keeps a corner which would be rounded.
    pub(super) fn stop(&mut self, what: Sync, report: &mut Report) {
        if self.loses_corner(&what) {
            note_lost_corner(report);
        }
        report.extend(self.sync(what, report.source));
    }

    /// A step at standstill.
    pub(super) fn sync(&mut self, what: Sync, source: SourceRef) -> Vec<Fault> {
        if self.akima.runs() && self.akima.selected {
            return vec![*akima::rest_inside().in_block(source)];
        }
        let mut faults = self.end_spline();
        // a contoured corner is kept open by waits alone
        let corner = self.corner();
        let waits = what.at_corner() == AtCorner::Waits;
        self.waits_at = match corner {
            Passing::Contoured if waits => corner,
            _ => Passing::Sharp,
        };
        self.stopped_exactly |= self.held.is_some() && matches!(what, Sync::ExactStop { .. });
        faults.extend(self.flush());
        let events = self.take_events();
        let rest = Rest { what, source, events };
        faults.extend(self.compensator.sync(rest, &mut self.done).err().map(|f| *f));
        self.emit();
        faults
    }

    /// Time in s of the motion of a block at its feed rate; 0 without a motion.
    pub(super) fn time_of_s(&self, block: SourceRef) -> f64 {
        let held = self.held.as_ref().filter(|held| held.source == block);
        held.map_or(0.0, |held| programmed_time_s(&held.block))
    }

    /// Whether G40 is programmed, and the motion that ends compensation is still to come (G05, G138, G139).
    pub(super) fn awaits_departure(&self) -> bool {
        // the last motion is on its way through the stages
        let held = self.held.as_ref().filter(|held| held.compensation.is_none());
        self.compensator.awaits_departure(held.map(|held| &held.block.path))
    }

    /// Whether G40 is programmed, and the next motion in the plane begins where the tool is.
    pub(super) fn departure_follows(&self) -> bool {
        let departs = |motion: &Motion| {
            let path = &motion.block.path;
            let moves = |i: &usize| path.start()[*i].to_bits() != path.end()[*i].to_bits();
            motion.tilt.is_some() || motion.plane.iter().any(moves)
        };
        self.compensator.deselected
            && match &self.held {
                Some(held) if held.compensation.is_some() => true,
                held => self.compensator.is_active() && !held.as_deref().is_some_and(departs),
            }
    }

    /// An exact stop ends a B-spline: K-0111 unless AUTO_OFF_G60 asks for it.
    pub(super) fn spline_stops(&self, span: Span, report: &mut Report) {
        if self.hsc.off_at_stop || self.hsc.spline().is_none() {
            return;
        }
        let text = "an exact stop in a B-spline ends it here, as with AUTO_OFF_G60";
        let fault = Fault::new(Condition::Fallback, text, span)
            .hint("without this key, the default, it does not end the spline of the control");
        report.note_once("AUTO_OFF_G60", fault);
    }

    /// 120102: a B-spline ends only at its own commands.
    ///
    /// Source: TF5200 programming manual 207042443, diagnosis 264284811.
    pub(super) fn may_flush(&self, what: &str, span: Span) -> Outcome<()> {
        if self.hsc.on && !self.hsc.rounds_corners {
            let text = format!("{what} while #HSC [BSPLINE] is active");
            return Err(Fault::new(Condition::FlushInSpline, text, span));
        }
        Ok(())
    }

    /// G40 (true), G41, G42.
    pub(super) fn deselect(&mut self, off: bool) {
        self.compensator.deselected = off;
    }

    /// Whether the tool is in the approach to a compensated contour, on it, or in the departure from it.
    pub(super) fn compensates(&self) -> bool {
        self.compensator.is_active()
            || self.held.as_ref().is_some_and(|motion| motion.compensation.is_some())
    }

    /// G40 with G239: axes of the plane and position of the tool centre, if compensation was active.
    pub(super) fn deselect_in_place(&mut self) -> (Option<([usize; 2], Point)>, Vec<Fault>) {
        let mut faults = self.flush();
        let left = self.compensator.leave(&mut self.done);
        self.emit();
        let left = left.unwrap_or_else(|fault| {
            faults.push(*fault);
            None
        });
        faults.extend(self.cut());
        (left, faults)
    }

    /// End of the program.
    pub(super) fn end(&mut self, reason: EndReason, source: SourceRef) -> Vec<Fault> {
        let mut faults = self.end_spline();
        faults.extend(self.flush());
        if reason == EndReason::Aborted {
            self.compensator.abandon();
        }
        faults.extend(self.compensator.end(&mut self.done).err().map(|f| *f));
        faults.extend(self.cut());
        self.emit();
        let events = self.take_events();
        self.end = Some(Box::new(Step::End { reason, source, events }));
        faults
    }

    /// Ends a spline at its last point.
    fn end_spline(&mut self) -> Vec<Fault> {
        let mut curves = Vec::new();
        let outcome = self.akima.finish(None, &mut curves);
        self.splined(curves, outcome)
    }

    /// The path stops after the held motion: no element can be inserted any more.
    fn flush(&mut self) -> Vec<Fault> {
        let mut faults = Vec::new();
        if let Some(motion) = self.held.take() {
            faults.extend(self.compensate(motion).map(|f| *f));
        }
        if let Some(insertion) = self.insertion.take() {
            let text = "the path stops here: the chamfer or rounding is not inserted";
            let fault = Fault::new(Condition::InsertionFlushed, text, insertion.span);
            faults.push(*fault.in_block(insertion.source));
        }
        faults
    }

    /// Whether there are extents or violations that have not been taken, as few motions have them.
    pub(super) fn has_to_report(&self) -> bool {
        !self.driven.is_empty() || !self.violations.is_empty()
    }

    /// Extents of compensated motions since the last call.
    pub(super) fn take_driven(&mut self) -> Vec<Driven> {
        std::mem::take(&mut self.driven)
    }

    /// Control areas violated by motions since the last call.
    pub(super) fn take_violations(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.violations)
    }
}

/// K-0111 once: the stop that follows keeps a corner which would be rounded.
pub(super) fn note_lost_corner(report: &mut Report) {
    let text = "the path stops here, so that the corner before it is not rounded";
    let fault = Fault::new(Condition::Fallback, text, Span::default());
    report.note_once("corner", fault);
}
