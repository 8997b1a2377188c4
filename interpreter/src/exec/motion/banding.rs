//! Edge banding: G108 and an M function that waits for the signal of the probe (MNE_SNS).
//!
//! The block of a motion contains the M function. Where the probe signals during this motion, the path continues for the
//! distance `V.G.RW`, stops, waits until the axes are in their windows, executes the function, and continues to the target.
//! Motion does not proceed beyond the block before that. G108 ends with this block.
//!
//! Source: TF5200 programming manual, edge banding (206213899, 206219787, 206230027), M and H functions (285989771), channel
//! parameters (148909195, 149011467), diagnosis (250932875, 257774219, 257878667, 258470539).
//! Assumptions, where they are silent: the distance is measured from the point of the path that is nearest to the measured
//! actual position; the path stops at the end of this distance, not after it.

use super::state::measuring::Measuring;
use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::Compensation;
use crate::exec::block::collected::{GWord, Words};
use crate::exec::block::groups::{Act, Group};
use crate::exec::block::modal::Modal;
use crate::exec::contour::Contour;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::motion::state::{Function, MotionState};
use crate::exec::names::AxisNames;
use crate::exec::output::Output;
use crate::exec::report::Report;
use crate::exec::step::{BandingRun, Event};
use crate::machine::{Channel, Machine};
use crate::syntax::ast::Span;

/// G108 that was not used.
fn unused(span: Span) -> Box<Fault> {
    let text = "G108 ends here without a motion that has waited for the signal";
    let hint = "write an M function that is MNE_SNS in P-CHAN-00041 in the block of the motion";
    Fault::new(Condition::Odd, text, span).warning().hint(hint)
}

impl Measuring {
    /// G108, G107.
    pub(in crate::exec) fn set_banding(
        &mut self,
        on: bool,
        g: &GWord,
        channel: &Channel,
        report: &mut Report,
    ) -> Outcome<()> {
        if on && channel.banding.over_blocks {
            return Err(Fault::unsupported(
                "edge banding over several blocks (P-CHAN-00029)",
                g.span,
            ));
        }
        if on && channel.banding.rejects_rest {
            return Err(Fault::unsupported(
                "edge banding that skips the rest of its block (P-CHAN-00149)",
                g.span,
            ));
        }
        if std::mem::replace(&mut self.banding, on) && !on {
            report.note(unused(g.span));
        }
        Ok(())
    }

    /// End of the program.
    pub(in crate::exec) fn banding_ends(&mut self, report: &mut Report) {
        if std::mem::take(&mut self.banding) {
            report.note(unused(Span::default()));
        }
    }
}

impl Geometry {
    /// Marks the axes of the motion for edge banding.
    fn banding_axes(
        &self,
        words: &Words<'_>,
        machine: &Machine,
        names: &AxisNames,
        span: Span,
    ) -> Outcome<()> {
        let coordinates = &self.coordinates;
        let main = (0..3).filter_map(|i| coordinates.main_axis(i));
        if !main.into_iter().any(|axis| machine.axes[axis].bands()) {
            let text = "edge banding: none of the main axes takes part in it";
            return Err(Fault::new(Condition::NoBandingAxis, text, span));
        }
        for (axis, _, at) in &words.axes {
            let listed = &machine.axes[*axis];
            if coordinates.main_index(*axis).is_some() && !listed.bands() {
                let name = names.name(*axis).to_owned();
                let number = listed.number();
                let text = format!("axis {name} moves but does not take part in edge banding");
                return Err(Fault::new(Condition::MovedWithoutBanding, text, *at)
                    .with(|d| d.axis(number, name).value(ValueKind::AxisNumber, number, "-")));
            }
        }
        Ok(())
    }
}

impl Contour {
    /// Functions that cannot be combined with edge banding.
    fn banding_fits(&self, words: &Words<'_>, modal: &Modal, span: Span) -> Outcome<()> {
        let what = if modal.compensation != Compensation::Off {
            "edge banding with tool radius compensation"
        } else if self.akima.selected || self.hsc.spline().is_some() {
            "edge banding in a spline"
        } else if modal.contouring || words.has(Act::ContourOnce) {
            "edge banding with contouring"
        } else if self.inserts() || words.group(Group::Insertion).is_some() {
            "edge banding with chamfers and roundings"
        } else if modal.path_mode(words).is_thread() {
            "edge banding in a thread"
        } else if modal.corner_deceleration
            || words.g.iter().any(|g| matches!(g.row.act, Act::FeedOverPath | Act::FeedOverTime))
        {
            "edge banding with a feed that changes along the block (G13, G193, G293)"
        } else {
            return Ok(());
        };
        Err(Fault::unsupported(what, span))
    }
}

impl MotionState {
    /// If edge banding is on and the block of the motion has an M function for it, the motion waits for the signal. Returns the
    /// position of that function in the program text.
    pub(in crate::exec) fn banding_run(
        &mut self,
        words: &Words<'_>,
        geometry: &Geometry,
        modal: &Modal,
        names: &AxisNames,
        output: &mut Output<'_>,
    ) -> Outcome<Option<Span>> {
        let at_signal = &output.machine.channel.functions.m_at_signal;
        let mut functions = words.m.iter().filter(|m| at_signal.contains(&m.number));
        let Some(m) = functions.next() else { return Ok(None) };
        if let Some(second) = functions.next() {
            let text = format!("M{} with M{}: both wait for a signal", second.number, m.number);
            return Err(Fault::new(Condition::TwoSignalFunctions, text, second.span)
                .with(|d| d.value(ValueKind::Current, second.number, "-")));
        }
        if !std::mem::take(&mut self.measuring.banding) {
            return Ok(None);
        }
        output.contour.banding_fits(words, modal, m.span)?;
        geometry.banding_axes(words, output.machine, names, m.span)?;
        let seconds =
            self.counted_time_s(Function::M(m.number), &output.machine.channel, output.contour);
        let way_mm = self.measuring.residual_path_mm;
        let run = BandingRun { way_mm, number: m.number, value: m.value, seconds };
        output.contour.event(Event::Banding(run));
        Ok(Some(m.span))
    }
}

/// K-0135 for a block of edge banding without a motion.
pub(in crate::exec) fn banding_without_motion(words: &Words<'_>, span: Span) -> Box<Fault> {
    let selected = words.has(Act::Banding(true));
    if selected && !words.axes.is_empty() {
        let text = "G108 in the block of the motion: axis words do not move in its block";
        Fault::new(Condition::MeasuringWay, text, span).hint("write G108 in a block before it")
    } else {
        let text = "edge banding in a block without travel";
        Fault::new(Condition::MeasuringWay, text, span)
    }
}
