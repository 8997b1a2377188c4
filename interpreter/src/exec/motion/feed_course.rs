//! Feed rates that change along a motion (G13, G193, G293), and the functions with which they cannot be combined.

use super::state::MotionState;
use crate::diag::Condition;
use crate::exec::block::choice::{Compensation, FeedType};
use crate::exec::block::collected::Words;
use crate::exec::block::groups::Act;
use crate::exec::contour::FeedCourse;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::report::Subject;
use crate::machine::Machine;
use crate::syntax::ast::Span;
use kontur_motion::block::{Feed, SlopeKind};
use kontur_motion::path::Path;

impl MotionState {
    /// Interpolates from the previous F word to that of the block.
    fn interpolated_feed(
        &self,
        machine: &Machine,
        path: &Path,
        number: u32,
        over_path: bool,
        span: Span,
    ) -> Outcome<Option<FeedCourse>> {
        let Some(from) = self.feed_before.filter(|word| word.value > 0.0) else {
            let text = format!("G{number}: no earlier F word to start the change of the feed from");
            return Err(Fault::new(Condition::FeedZero, text, span));
        };
        let course = if over_path { FeedCourse::OverPath } else { FeedCourse::OverTime };
        Ok(Some(course(from.per_minute(machine, path))))
    }
}

impl Decoder {
    /// How the feed rate changes along a motion. Assumption: not in rapid traverse, which has no feed rate.
    pub(super) fn feed_course(
        &mut self,
        words: &Words<'_>,
        path: &Path,
        feed: Feed,
        rounds: bool,
        span: Span,
    ) -> Outcome<Option<FeedCourse>> {
        let interpolated = words
            .g
            .iter()
            .find(|g| matches!(g.row.act, Act::FeedOverPath | Act::FeedOverTime))
            .map(|g| (g.row, g.span));
        let corner = self.motion.corner.filter(|_| self.modal.corner_deceleration);
        let (number, span) = match (interpolated, corner) {
            _ if feed == Feed::Rapid => return Ok(None),
            (None, None) => return Ok(None),
            (Some((_, at)), Some(_)) => {
                let what = "feed interpolation with corner deceleration (G13)";
                return Err(Fault::unsupported(what, at));
            }
            (Some((row, at)), None) => (row.number, at),
            (None, Some(_)) => (13, span),
        };
        let over_path = interpolated.is_some_and(|(row, _)| row.act == Act::FeedOverPath);
        match self.modal.commanded.slope.kind {
            SlopeKind::Step => {}
            SlopeKind::Hsc if over_path => {
                return Err(Fault::unsupported("G193 with the slope HSC", span));
            }
            SlopeKind::Trapez | SlopeKind::Sin2 | SlopeKind::Hsc => {
                let text = format!("G{number} has an effect only with the slope STEP");
                self.report
                    .note_once(Subject::G(number), Fault::new(Condition::Ignored, text, span));
                return Ok(None);
            }
        }
        let beside = if self.modal.feed_type != FeedType::PerMinute {
            "G93, G95 or G194"
        } else if rounds
            || self.contour.hsc.contour().is_some()
            || self.contour.has_contoured_corner()
        {
            "contouring"
        } else if self.contour.akima.selected || self.contour.hsc.spline().is_some() {
            "splines"
        } else if interpolated.is_some() && self.modal.compensation != Compensation::Off {
            "tool radius compensation"
        } else {
            return if interpolated.is_some() {
                self.motion.interpolated_feed(&self.machine, path, number, over_path, span)
            } else {
                Ok(corner.map(FeedCourse::Corner))
            };
        };
        Err(Fault::unsupported(format!("G{number} with {beside}"), span))
    }
}
