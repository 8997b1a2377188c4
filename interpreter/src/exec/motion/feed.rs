//! Feed rate and end velocity of a block.

use crate::diag::Condition;
use crate::exec::block::choice::{FeedType, PathMode};
use crate::exec::block::collected::Placed;
use crate::exec::block::modal::{FeedWord, Modal};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::motion::spindles::Turning;
use crate::exec::motion::state::MotionState;
use crate::exec::output::Output;
use crate::exec::report::{Report, Subject};
use crate::machine::{INCH_MM, Machine};
use crate::syntax::ast::Span;
use kontur_motion::block::{Block, Feed};
use kontur_motion::limits::{PathExtremes, PathSpeeds};
use kontur_motion::path::Path;

/// Hint for E with another feed than that of G94.
const END_FEED: &str = "write G94 and a motion at feed rate: G94 G01 X10 F2000 E500";

impl Modal {
    pub(super) fn end_velocity(
        &self,
        (value, span): Placed,
        feed: Feed,
        machine: &Machine,
        path: &Path,
    ) -> Outcome<Option<f64>> {
        let Feed::PathVelocity(v) = feed else {
            let text = "E is only valid with G94 and not in rapid traverse";
            return Err(Fault::new(Condition::Syntax, text, span).hint(END_FEED));
        };
        if self.feed_type != FeedType::PerMinute {
            return Err(
                Fault::new(Condition::Syntax, "E is only valid with G94", span).hint(END_FEED)
            );
        }
        if value < 0.0 {
            let text = format!("E{value} is negative: E is the feed at the end of the block");
            return Err(Fault::new(Condition::Syntax, text, span)
                .hint("numbers cannot have an exponent in this dialect: write 0.00001 for 1e-05"));
        }
        let word = FeedWord { value, inch: self.inch };
        Ok(Some(word.per_minute(machine, path).min(v)))
    }
}

impl MotionState {
    /// Feed rate of a block with this path.
    pub(super) fn feed_of(
        &self,
        path: &Path,
        coordinates: &Coordinates,
        modal: &Modal,
        output: &mut Output<'_>,
        span: Span,
    ) -> Outcome<Feed> {
        if modal.path == PathMode::Rapid {
            return Ok(Feed::Rapid);
        }
        if let Some(feed) = self.measuring.feed {
            return Ok(feed);
        }
        let Some(word) = modal.feed().filter(|f| f.value > 0.0) else {
            let text = match modal.feed() {
                Some(_) => "the feed is 0: value of the last F word",
                None if modal.feed_type == FeedType::Time => {
                    "the time is 0: G93 needs an F word each time it is programmed"
                }
                None => "the feed is 0: no F word has been programmed",
            };
            output.report.note_once(Subject::Only, Fault::new(Condition::FeedZero, text, span));
            // the block is skipped, the positions continue
            return Ok(Feed::PathVelocity(1.0));
        };
        if output.contour.hsc.feed_type(modal.feed_type) != modal.feed_type {
            let text = "G93 in a B-spline: F is taken in mm/min";
            output.report.note_once(Subject::Only, Fault::new(Condition::TimeInSpline, text, span));
        }
        let main = &self.spindles[0];
        if modal.feed_type == FeedType::PerRevolution
            && main.index.is_some()
            && !main.is_turning()
            && self.spindle_rpm(coordinates, output.machine) != 0.0
        {
            let text = "feed per revolution while the main spindle is stopped: its S word is used";
            let fault = Fault::new(Condition::Odd, text, span).hint("write M03 or M04 before it");
            output.report.note_once(Subject::G(95), fault);
        }
        self.feed_from(
            (word.value, word.unit_mm(output.machine, path)),
            coordinates,
            modal,
            output,
            span,
        )
    }

    /// Feed rate for a value above 0 with the active feed type; the unit of a distance in mm is given.
    pub(in crate::exec) fn feed_from(
        &self,
        (value, unit_mm): (f64, f64),
        coordinates: &Coordinates,
        modal: &Modal,
        output: &mut Output<'_>,
        span: Span,
    ) -> Outcome<Feed> {
        Ok(match output.contour.hsc.feed_type(modal.feed_type) {
            FeedType::PerMinute => {
                Feed::PathVelocity(value * unit_mm * output.machine.channel.feed.unit_mm_min / 60.0)
            }
            FeedType::Time => Feed::Duration(value),
            FeedType::ShareOfMaximum => Feed::ShareOfMaximum(value / 100.0),
            FeedType::PerRevolution => {
                self.no_spindle_override("G95", span)?;
                self.no_tool_limit("G95", 0, span)?;
                let rpm = self.spindle_rpm(coordinates, output.machine);
                if rpm == 0.0 {
                    let (condition, what) = match self.spindles[0].turning {
                        Turning::Stopped => (Condition::SpindleAtRestAtFeed, "is at rest"),
                        _ => (Condition::SpindleSpeedZeroAtFeed, "has no speed"),
                    };
                    let text = format!("feed per revolution, but the main spindle {what}");
                    return Err(Fault::new(condition, text, span));
                }
                Feed::PathVelocity(value * unit_mm * rpm / 60.0)
            }
        })
    }
}

/// Reports a time (G93) that the limits of the axes do not allow; the limits apply.
pub(super) fn check_time(block: &Block, span: Span, report: &mut Report) {
    let Feed::Duration(time_s) = block.feed else { return };
    let speeds = PathSpeeds::of(block, &PathExtremes::of(&block.path));
    let least_s = block.path.length() / speeds.highest();
    if time_s < least_s * (1.0 - 1e-9) {
        let text = format!(
            "the block cannot be executed in F{time_s} s (G93): its velocity limits require {least_s:.6} s"
        );
        report.note(Fault::new(Condition::TimeNotKept, text, span));
    }
}

impl FeedWord {
    /// The speed of G94 on this path in mm/s (deg/s).
    pub(super) fn per_minute(self, machine: &Machine, path: &Path) -> f64 {
        self.value * (self.unit_mm(machine, path) * machine.channel.feed.unit_mm_min / 60.0)
    }

    /// Unit of length in mm on this path: 1 if only rotary axes move.
    pub(super) fn unit_mm(self, machine: &Machine, path: &Path) -> f64 {
        let moves = |i: usize| path.start()[i].to_bits() != path.end()[i].to_bits();
        let is_linear = !path.is_straight()
            || (0..path.start().len()).any(|i| machine.axes[i].is_linear() && moves(i));
        if self.inch && is_linear { INCH_MM } else { 1.0 }
    }
}
