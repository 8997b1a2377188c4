//! Feed, weights and modes of a block.

use super::insertions::inserts_after;
use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::{FeedType, LookAhead};
use crate::exec::block::collected::{GWord, Words};
use crate::exec::block::groups::Act;
use crate::exec::block::modes::{permits_tangential, weight_ratio};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::output::output;
use crate::exec::report::{Report, Subject};
use crate::exec::values::number::whole;
use crate::syntax::ast::Span;

/// Largest value of G115; larger ones are 20712 instead of 20151. Assumption: the data format has 16 bits.
const LOOK_AHEAD_FORMAT: u32 = 65535;

impl Decoder {
    /// Feed, modes and weights of a block.
    pub(super) fn feeds_and_modes(&mut self, words: &Words<'_>, takes_axes: Option<GWord>) {
        for g in &words.g {
            if let Act::FeedType(feed_type) = g.row.act {
                self.modal.feed_type = feed_type;
                if feed_type == FeedType::Time {
                    // one time value per use of G93
                    self.modal.feeds[feed_type as usize] = None;
                }
            }
        }
        if let Some(feed) = words.feed {
            let outcome = self.modal.program_feed(feed, &mut self.report);
            self.report.keep(outcome);
        }
        for g in &words.g {
            let outcome = self.mode(g, words);
            self.report.keep(outcome);
        }
        if let Some(g) = takes_axes {
            let outcome = match g.row.act {
                Act::WeightOfAxes(weight) => self.weights_of_axes(&g, weight, words),
                Act::FeedforwardWeights => {
                    self.motion.feedforward_weights(&g, words, output!(self))
                }
                _ => Ok(()),
            };
            self.report.keep(outcome);
        }
        if !inserts_after(words) {
            self.modal.insertions(words, &self.geometry, &self.motion, output!(self));
        }
    }

    /// Modes without axis words.
    fn mode(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        match g.row.act {
            Act::ExactStop(on) => {
                self.modal.exact_stop = on;
                self.modal.contouring &= !on;
            }
            Act::Contour(on) => {
                self.modal.contouring = on;
                self.modal.exact_stop &= !on;
            }
            Act::Manual => self.manual_mode(g, words)?,
            Act::Gear => self.change_gears(g, words)?,
            Act::CornerDeceleration(on) => {
                if on && self.motion.corner.is_none() {
                    return Err(no_corner_parameters(g.span));
                }
                self.modal.corner_deceleration = on;
            }
            Act::EngagementFeed(on) => {
                self.modal.engagement_feed = on;
                if on {
                    self.simplified(
                        g,
                        "arcs inserted at corners by the compensation keep the programmed feed",
                    );
                }
            }
            Act::Banding(on) => {
                self.motion.measuring.set_banding(
                    on,
                    g,
                    &self.machine.channel,
                    &mut self.report,
                )?;
            }
            Act::LateBraking(late) => self.modal.late_braking = late,
            Act::WeightOfAll(weight) => {
                let ratio = weight_ratio((g.value.unwrap_or_default(), g.span))?;
                self.set_weight(weight, None, ratio, g.span);
            }
            Act::Feedforward(on) => self.motion.switch_feedforward(on, output!(self), g.span),
            Act::StopAtTransitions(stop) => self.stop_at_transitions(stop, g, words)?,
            Act::LookAheadFunctions => look_ahead_functions(g, &mut self.report)?,
            Act::Ignored(why) => {
                let text = format!("G{:02} has no effect: {why}", g.row.number);
                let fault = Fault::new(Condition::Ignored, text, g.span);
                self.report.note_once(Subject::G(g.row.number), fault);
            }
            Act::Simplified(how) => {
                if g.row.number == 74 {
                    self.geometry.home(g, words, &self.motion.couplings)?;
                }
                self.simplified(g, how);
            }
            _ => self.mode_of_contour(g, words)?,
        }
        Ok(())
    }

    /// Modes of arcs, compensation and splines.
    fn mode_of_contour(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        match g.row.act {
            Act::CentreAbsolute(on) => self.modal.centre_absolute = on,
            Act::CentreCorrection(on) => self.modal.centre_correction = on,
            Act::Compensation(side) => self.compensation(side, g.span)?,
            Act::Diameter(false) => self.modal.diameter = None,
            Act::Diameter(true) => self.program_diameters(g.span)?,
            Act::Spline(false) if self.contour.hsc.spline().is_some() => {
                let text = "a spline is deselected (G150) while #HSC ON [BSPLINE] is active";
                return Err(Fault::new(Condition::SplineInSurface, text, g.span));
            }
            Act::Spline(on) => self.report.extend(self.contour.akima.select(on, g.span)),
            Act::Tangential => {
                permits_tangential(g, words, self.modal.selection)?;
                self.contour.tangential = true;
            }
            Act::Selection(selection) => self.modal.select_compensation_by(selection, g, words)?,
            Act::Radius => {
                let radius = g.value.unwrap_or_default() * self.modal.unit_mm();
                self.modal.radius_mm = Some(radius);
                self.modal.centre_mm = [None; 3];
            }
            _ => {}
        }
        Ok(())
    }

    /// A G function of which only a part is simulated, said once.
    fn simplified(&mut self, g: &GWord, how: &str) {
        let text = format!("G{}: {how}", g.row.number);
        let fault = Fault::new(Condition::Fallback, text, g.span);
        self.report.note_once(Subject::G(g.row.number), fault);
    }

    /// G116 and G117.
    ///
    /// Assumption: without axes, every transition is a stop; the pages do not define the values of the axes.
    fn stop_at_transitions(&mut self, stop: bool, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        if !words.axes.is_empty() {
            let what = format!("G{} with axes", g.row.number);
            return Err(Fault::unsupported(what, g.span));
        }
        let mode = if stop { LookAhead::StopAtTransitions } else { LookAhead::Complete };
        if std::mem::replace(&mut self.modal.look_ahead, mode) != mode {
            self.motion.limits.changed();
        }
        Ok(())
    }

    /// G51.
    fn program_diameters(&mut self, span: Span) -> Outcome<()> {
        let axis = self.geometry.diameter_axis(
            self.modal.plane,
            &self.machine,
            &self.names,
            &mut self.report,
            span,
        )?;
        self.modal.diameter = Some(axis);
        Ok(())
    }
}

/// G115.
fn look_ahead_functions(g: &GWord, report: &mut Report) -> Outcome<()> {
    let value = g.value.unwrap_or_default();
    let number = whole(value, 0, LOOK_AHEAD_FORMAT);
    if number.is_none_or(|number| number > 14) {
        let condition = match number {
            Some(_) => Condition::LookAheadRange,
            None => Condition::LookAheadFormat,
        };
        let text = format!("G115={value}, allowed: 0 to 14");
        return Err(
            Fault::new(condition, text, g.span).with(|d| d.value(ValueKind::Wrong, value, "-"))
        );
    }
    let text = "G115: single functions of the look-ahead cannot be switched off";
    report.note_once(Subject::G(115), Fault::new(Condition::Fallback, text, g.span));
    Ok(())
}

/// 20795.
fn no_corner_parameters(span: Span) -> Box<Fault> {
    let text = "G13 without the values of #CORNER PARAM";
    Fault::new(Condition::NoCornerParameters, text, span)
        .with(|d| d.value(ValueKind::Current, 13, "-"))
}
