//! M functions, spindle words and the actions at the end of a block.

use super::{After, CallAfter, Then};
use crate::diag::Condition;
use crate::exec::block::collected::{Code, Placed, Words};
use crate::exec::block::modal::Modal;
use crate::exec::decoder::Decoder;
use crate::exec::fault::Fault;
use crate::exec::geometry::Geometry;
use crate::exec::motion::spindles::Turning;
use crate::exec::motion::state::{Function, MotionState};
use crate::exec::output::{Output, output};
use crate::exec::program::state::Calls;
use crate::exec::report::{Report, Subject};
use crate::exec::step::{Event, Sync};
use crate::machine::{Acknowledged, Channel, SpindleMoment, SpindleWaits};
use crate::syntax::ast::Span;

/// Effect of M functions that are more than a number in the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MKind {
    Plain,
    Stop { optional: bool },
    End,
    Return,
    Spindle,
    ToolChange,
}

/// Whether a block has M3, M4, M5 or M19.
fn turns_spindle(words: &Words<'_>) -> bool {
    words.m.iter().any(|m| m_kind(m.number) == MKind::Spindle)
}

fn m_kind(number: u32) -> MKind {
    match number {
        0 => MKind::Stop { optional: false },
        1 => MKind::Stop { optional: true },
        2 | 30 => MKind::End,
        17 | 29 => MKind::Return,
        3 | 4 | 5 | 19 => MKind::Spindle,
        6 => MKind::ToolChange,
        _ => MKind::Plain,
    }
}

/// M3 and M4 give the direction of M19 in the same block.
fn is_direction(words: &Words<'_>, m: &Code) -> bool {
    matches!(m.number, 3 | 4) && words.m.iter().any(|m| m.number == 19)
}

impl Calls {
    /// The one call at the end of a block.
    fn call_after<'b>(
        &self,
        words: &Words<'b>,
        channel: &Channel,
        report: &mut Report,
    ) -> Option<CallAfter<'b>> {
        let tool_change = words
            .m
            .iter()
            .find(|m| m_kind(m.number) == MKind::ToolChange && self.tool_change_file.is_some());
        let tool_data = tool_data_word(channel, words).filter(|_| self.tool_data_file.is_some());
        let called = words.call.is_some() || words.cycle.is_some();
        if let (Some(m), true) = (tool_change, called || tool_data.is_some()) {
            let text = "M06 calls a subroutine: a second call in its block";
            report.note(Fault::new(Condition::SeveralCalls, text, m.span));
        } else if let (Some(at), true) = (tool_data, called) {
            let text = "D calls a subroutine: a second call in its block";
            report.note(Fault::new(Condition::SeveralCalls, text, at));
        }
        if let (Some(cycle), Some(_)) = (&words.cycle, words.call) {
            let text = format!("G{} calls a subroutine: a second call in its block", cycle.number);
            report.note(Fault::new(Condition::SeveralCalls, text, cycle.span));
        }
        if let Some((call, span)) = words.call {
            return Some(CallAfter::Written(call, span));
        }
        let cycle = words.cycle.clone().map(CallAfter::Cycle);
        cycle
            .or_else(|| tool_change.map(|m| CallAfter::ToolChange(m.span)))
            .or_else(|| tool_data.map(CallAfter::ToolData))
    }
}

impl MotionState {
    /// S words: speeds, cutting speeds, or signed speeds of tapping. Returns a speed that takes effect after the motion.
    pub(super) fn spindle_speeds(
        &mut self,
        words: &Words<'_>,
        geometry: &Geometry,
        modal: &Modal,
        output: &mut Output<'_>,
    ) -> Option<Placed> {
        let mut late = None;
        let taps = modal.path_mode(words).is_tapping();
        let outcome = self.cutting_words(words, geometry, modal, output);
        output.report.keep(outcome);
        let cuts = self.cutting.takes_s_words(words);
        for (i, speed, span) in &words.speeds {
            // for the main spindle, tapping and constant cutting speed process it
            if *i == 0 {
                self.threads.speed(taps.then_some(*speed));
                if taps {
                    // the S word is modal: it counts for M3 after the thread, the sign is that of the thread
                    self.spindles[0].rpm = speed.abs();
                    self.spindles[0].check_speed(output.machine, output.report, *span);
                }
            }
            if *i != 0 {
                let name = self.spindles[*i].name.clone();
                let text =
                    format!("{name} is not the main spindle: its speed must be in a bracket");
                let hint = format!("write {name}[REV{speed}], or #MAIN SPINDLE [{name}] before it");
                output.report.note(Fault::new(Condition::NotMainSpindle, text, *span).hint(hint));
            } else if !(taps || cuts) {
                let alone = !turns_spindle(words);
                if alone && self.spindles[0].speeds_up_late(&output.machine.channel) {
                    late = Some((*speed, *span));
                } else {
                    self.s_word(0, *speed, alone, output, *span);
                }
            }
        }
        late
    }

    /// An S word; `alone`: the block has no M function of the spindle, whose synchronisation counts instead of that of the speed (M19, then M3
    /// to M5, then S: 208010763).
    pub(super) fn s_word(
        &mut self,
        index: usize,
        value: f64,
        alone: bool,
        output: &mut Output<'_>,
        span: Span,
    ) {
        if !(0.0..=1e6).contains(&value) {
            let text = format!("spindle speed {value} is outside 0 to 1000000 rev/min");
            output.report.note(Fault::new(Condition::Range, text, span));
            return;
        }
        self.spindles[index].rpm = value;
        self.spindles[index].check_speed(output.machine, output.report, span);
        if let Some(spindle) = self.spindles[index].index.filter(|_| alone) {
            self.takes_time(Function::Speed { spindle }, &output.machine.channel, output.contour);
        }
        if self.spindles[index].is_turning() {
            let outcome = self.move_spindle(index, output, span);
            output.report.keep(outcome);
        }
        self.spindles[index].warn(output.report, span);
    }

    pub(super) fn functions_before(
        &mut self,
        words: &Words<'_>,
        calls: &Calls,
        output: &mut Output<'_>,
    ) {
        for (spindle, deg, _) in &words.angles {
            self.spindles[*spindle].angle_deg = *deg;
        }
        let of_spindle = |m: &&Code| m_kind(m.number) == MKind::Spindle;
        let mut spindle = words.m.iter().filter(of_spindle).filter(|m| {
            !is_direction(words, m) || words.m.iter().any(|n| n.number == 7 - m.number)
        });
        if let (Some(first), Some(second)) = (spindle.next(), spindle.next()) {
            let (m, n) = (first.number, second.number);
            let text = format!("M{m:02} and M{n:02} in one block: both set the spindle");
            output.report.note(Fault::new(Condition::DuplicateGroup, text, second.span));
        }
        self.turn_main_spindle(words, SpindleMoment::BeforeMotion, output);
        for m in &words.m {
            match m_kind(m.number) {
                MKind::Plain => self.m_function(m, output),
                // Assumption: waited for before the motion, as for every function; m_synch is not simulated
                MKind::Stop { .. } => {
                    self.takes_declared_time(
                        Function::M(m.number),
                        &output.machine.channel,
                        output.contour,
                    );
                    self.waits_for_operator(m.number, output.contour);
                }
                MKind::ToolChange if calls.tool_change_file.is_none() => self.m_function(m, output),
                _ => {}
            }
        }
        for h in &words.h {
            output.contour.event(Event::HFunction { number: h.number, value: h.value });
            self.takes_time(Function::H(h.number), &output.machine.channel, output.contour);
        }
    }

    fn m_function(&mut self, m: &Code, output: &mut Output<'_>) {
        if self.measuring.banding
            && output.machine.channel.functions.m_at_signal.contains(&m.number)
        {
            // processed with the motion
            return;
        }
        if let Some(text) = crate::exec::block::dialect::m_function(m.number) {
            let fault = Fault::new(Condition::Dialect, text, m.span);
            output.report.note_once(Subject::M(m.number), fault);
        }
        output.contour.event(Event::MFunction { number: m.number, value: m.value });
        self.takes_time(Function::M(m.number), &output.machine.channel, output.contour);
    }

    /// Starts or stops the main spindle as programmed on one side of the motion of the block: before it, or after it with
    /// MNS_SNS. Assumption: M5 without an entry in the list also takes effect after it.
    fn turn_main_spindle(
        &mut self,
        words: &Words<'_>,
        now: SpindleMoment,
        output: &mut Output<'_>,
    ) {
        let listed = self.spindles[0].index.and_then(|i| {
            let waits: Option<&SpindleWaits> =
                output.machine.channel.functions.spindle_waits.get(i);
            waits.copied()
        });
        let acts = |number: u32| match listed.unwrap_or_default().of_m(number) {
            Some(Acknowledged::AfterMotion) => SpindleMoment::AfterMotion,
            None if number == 5 => SpindleMoment::AfterMotion,
            Some(_) | None => SpindleMoment::BeforeMotion,
        };
        let of_spindle = words.m.iter().filter(|m| m_kind(m.number) == MKind::Spindle);
        for m in of_spindle.filter(|m| !is_direction(words, m) && acts(m.number) == now) {
            self.turn(m, words.m.iter().find(|m| is_direction(words, m)).map(|m| m.number), output);
        }
    }

    fn turn(&mut self, m: &Code, direction: Option<u32>, output: &mut Output<'_>) {
        let Some(spindle) = self.spindles[0].index else {
            let text = format!("M{:02}: the channel has no spindle", m.number);
            output.report.note(Fault::new(Condition::MFunctionWithoutSpindle, text, m.span));
            return;
        };
        if let (19, Some(deg)) = (m.number, m.value) {
            self.spindles[0].angle_deg = deg;
        }
        let turning = Turning::of(m.number);
        self.spindles[0].turning = match direction {
            Some(number) => turning.with_direction(number),
            None => turning,
        };
        let outcome = self.move_spindle(0, output, m.span);
        output.report.keep(outcome);
        self.takes_time(
            Function::Spindle { spindle, m: m.number },
            &output.machine.channel,
            output.contour,
        );
        if m.number != 5 {
            self.spindles[0].warn(output.report, m.span);
        }
    }
}

impl Decoder {
    pub(super) fn functions_after<'b>(&mut self, words: &Words<'b>) -> After<'b> {
        let mut then = Then::Next;
        self.motion.turn_main_spindle(words, SpindleMoment::AfterMotion, output!(self));
        for m in &words.m {
            match m_kind(m.number) {
                MKind::Stop { optional } => self.sync(Sync::ProgramStop { optional }),
                MKind::End | MKind::Return if !matches!(then, Then::Next) => {
                    let text = format!(
                        "M{:02} with another end of the program level in one block",
                        m.number
                    );
                    self.report.note(Fault::new(Condition::DuplicateGroup, text, m.span));
                }
                MKind::End => {
                    self.motion.takes_declared_time(
                        Function::M(m.number),
                        &self.machine.channel,
                        &mut self.contour,
                    );
                    then = Then::End;
                }
                MKind::Return => then = Then::Return(words.back),
                _ => {}
            }
        }
        let call = self.calls.call_after(words, &self.machine.channel, &mut self.report);
        match words.goto {
            // in a measuring run, the signal decides
            Some(_) if words.jumps_on_signal() => {}
            Some(label) if call.is_some() => {
                let text = "$GOTO in a block that calls a subroutine at its end";
                self.report.note(Fault::new(Condition::BehindCall, text, label.span));
            }
            Some(label) if !matches!(then, Then::Next) => {
                let text = "$GOTO in a block that ends its level";
                self.report.note(Fault::new(Condition::DuplicateGroup, text, label.span));
            }
            Some(label) => then = Then::Goto(label),
            None => {}
        }
        After { call, then }
    }
}

/// The D word, or the T word if it also selects tool data (P-CHAN-00014).
fn tool_data_word(channel: &Channel, words: &Words<'_>) -> Option<Span> {
    let with_tool = words.tool.filter(|_| channel.offsets.tool_data_with_tool);
    words.tool_data.or(with_tool).map(|(_, span)| span)
}
