//! Dwells: G04 and its time.

use crate::diag::{Condition, ValueKind};
use crate::exec::block::collected::{GWord, Words};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::Sync;
use crate::syntax::ast::Span;

/// Longest dwell in s: 32 bits of microseconds. Source: TF5200 diagnosis, 20752.
const DWELL_MAX_S: f64 = 4294.967295;

impl Decoder {
    pub(super) fn dwell(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        words.must_be_alone(g, &mut self.report);
        let main = self.geometry.coordinates.main_axis(0);
        let of_axis = words.axes.iter().find(|(axis, _, _)| Some(*axis) == main);
        let revolutions = words.speeds.first();
        let forms = [g.value.is_some(), of_axis.is_some(), revolutions.is_some()];
        if forms.iter().filter(|f| **f).count() > 1 {
            let text = "G04 with two times: write G04 2.5 or G04 X2.5";
            return Err(Fault::new(Condition::DwellTwoTimes, text, g.span));
        }
        let (seconds, span) = if let Some(value) = g.value {
            (value, g.span)
        } else if let Some((_, value, span)) = of_axis {
            (*value, *span)
        } else if let Some((spindle, turns, span)) = revolutions {
            let rpm = self.motion.spindles[*spindle]
                .overridden_rpm()
                .min(self.motion.spindles[*spindle].most_rpm(&self.machine));
            if rpm == 0.0 {
                let text = "G04 S: the spindle has no speed";
                return Err(Fault::new(Condition::SpindleSpeedZero, text, *span));
            }
            self.motion.no_tool_limit("G04 S", *spindle, *span)?;
            self.motion.dwell_revolutions = *turns;
            (turns * 60.0 / rpm, *span)
        } else if let Some((_, _, span)) = words.axes.first() {
            let text = "G04: the time must follow the first main axis";
            return Err(Fault::new(Condition::DwellWrongAxis, text, *span));
        } else {
            return Err(Fault::new(Condition::DwellWithoutTime, "G04 without a time", g.span));
        };
        let others: Vec<(usize, Span)> = words
            .axes
            .iter()
            .filter(|(axis, _, _)| of_axis.is_none() || Some(*axis) != main)
            .map(|(axis, _, span)| (*axis, *span))
            .collect();
        for (axis, span) in others {
            let number = self.machine.axes[axis].number();
            let name = self.names.name(axis).to_owned();
            let text = format!("G04 with the additional axis {name}, which does not move");
            self.report.note(
                Fault::new(Condition::DwellOtherAxes, text, span).with(|d| d.axis(number, name)),
            );
        }
        self.dwell_for(seconds, Condition::DwellRange, span)
    }

    /// Dwells at standstill for a time; `range`: the condition for a time outside its range.
    pub(in crate::exec) fn dwell_for(
        &mut self,
        seconds: f64,
        range: Condition,
        span: Span,
    ) -> Outcome<()> {
        if !(0.0..=DWELL_MAX_S).contains(&seconds) {
            let text = format!("dwell of {seconds} s is outside 0 to {DWELL_MAX_S} s");
            return Err(Fault::new(range, text, span).with(|d| {
                d.value(ValueKind::Wrong, seconds * 1e6, "us")
                    .value(ValueKind::LowerLimit, 0.0, "us")
                    .value(ValueKind::UpperLimit, DWELL_MAX_S * 1e6, "us")
            }));
        }
        self.sync(Sync::Dwell { seconds });
        Ok(())
    }
}
