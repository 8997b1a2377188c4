//! M functions, spindle words and the actions at the end of a block.

use super::{After, CallAfter, Then};
use crate::diag::{Condition, rounded};
use crate::exec::block::collected::{Code, Words};
use crate::exec::decoder::Decoder;
use crate::exec::fault::Fault;
use crate::exec::motion::spindles::Turning;
use crate::exec::motion::state::Function;
use crate::exec::step::{Event, Sync};
use crate::machine::{Acknowledged, SpindleMoment, SpindleWaits};
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

impl Decoder {
    /// Whether the S word of a spindle takes effect after the motion of its block (MNS_SNS).
    pub(super) fn speeds_up_late(&self, index: usize) -> bool {
        let listed = self.motion.spindles[index].index;
        let waits = listed.and_then(|i| self.machine.channel.spindle_waits.get(i));
        waits.is_some_and(|waits| waits.speed == Some(Acknowledged::AfterMotion))
    }

    pub(super) fn speed(&mut self, index: usize, value: f64, span: Span) {
        if !(0.0..=1e6).contains(&value) {
            let text = format!("spindle speed {value} is outside 0 to 1000000 rev/min");
            self.report.note(Fault::new(Condition::Range, text, span));
            return;
        }
        self.set_spindle_speed(index, value, span);
        if let Some(spindle) = self.motion.spindles[index].index {
            self.takes_time(Function::Speed { spindle });
        }
        if self.motion.spindles[index].is_turning() {
            let outcome = self.move_spindle(index, span);
            self.report.keep(outcome);
        }
        self.spindle_warning(index, span);
    }

    /// Sets the speed of a spindle in rev/min; K-0131 if it exceeds the maximum speed.
    pub(in crate::exec) fn set_spindle_speed(&mut self, index: usize, rpm: f64, span: Span) {
        self.motion.spindles[index].rpm = rpm;
        self.check_spindle_speed(index, span);
    }

    /// Reports a speed above the maximum of the spindle (K-0131).
    pub(in crate::exec) fn check_spindle_speed(&mut self, index: usize, span: Span) {
        let rpm = self.motion.spindles[index].overridden_rpm();
        let most = self.most_rpm(index);
        if rpm > most {
            let name = &self.motion.spindles[index].name;
            let text = format!(
                "spindle speed {} rev/min of {name} is above its limit (P-AXIS-00212): {} rev/min is used",
                rounded(rpm),
                rounded(most)
            );
            self.report.note(Fault::new(Condition::SpindleLimit, text, span));
        }
    }

    /// Maximum speed of a spindle in rev/min (P-AXIS-00212); infinite for a spindle without a list.
    pub(in crate::exec) fn most_rpm(&self, index: usize) -> f64 {
        let listed = self.motion.spindles[index].index.and_then(|i| self.machine.spindles.get(i));
        listed.map_or(f64::INFINITY, |s| s.dynamics().v_max_mm_s / 6.0)
    }

    pub(in crate::exec) fn spindle_warning(&mut self, index: usize, span: Span) {
        if self.motion.spindles[index].index.is_none() {
            let text = "the machine has no spindle: speeds are stored without effect";
            self.report.note_once("spindle", Fault::new(Condition::Ignored, text, span));
        } else if self.motion.spindles[index].is_turning() && self.motion.spindles[index].rpm == 0.0
        {
            let text = "M03 and M04 have no effect at speed 0 before an S word";
            self.report.note_once("spindle speed", Fault::new(Condition::Odd, text, span));
        } else if matches!(self.motion.spindles[index].turning, Turning::Positioned(_))
            && self.motion.spindles[index].rpm == 0.0
        {
            // TF5200 programming manual, M19 (208038923, 208198923): a speed above 0 must be set
            let text = "M19 requires a spindle speed on the control; here the spindle positions at its maximum speed";
            let fault = Fault::new(Condition::Odd, text, span).hint("write S or REV before it");
            self.report.note_once("M19 speed", fault.warning());
        }
    }

    pub(super) fn functions_before(&mut self, words: &Words<'_>) {
        for (spindle, deg, _) in &words.angles {
            self.motion.spindles[*spindle].angle_deg = *deg;
        }
        let of_spindle = |m: &&Code| m_kind(m.number) == MKind::Spindle;
        let mut spindle = words.m.iter().filter(of_spindle).filter(|m| {
            !is_direction(words, m) || words.m.iter().any(|n| n.number == 7 - m.number)
        });
        if let (Some(first), Some(second)) = (spindle.next(), spindle.next()) {
            let (m, n) = (first.number, second.number);
            let text = format!("M{m:02} and M{n:02} in one block: both set the spindle");
            self.report.note(Fault::new(Condition::DuplicateGroup, text, second.span));
        }
        self.turn_main_spindle(words, SpindleMoment::BeforeMotion);
        for m in &words.m {
            match m_kind(m.number) {
                MKind::Plain => self.m_function(m),
                // Assumption: waited for before the motion, as for every function; m_synch is not simulated
                MKind::Stop { .. } => self.takes_declared_time(Function::M(m.number)),
                MKind::ToolChange if self.calls.tool_change_file.is_none() => self.m_function(m),
                _ => {}
            }
        }
        for h in &words.h {
            self.contour.event(Event::HFunction { number: h.number, value: h.value });
            self.takes_time(Function::H(h.number));
        }
    }

    fn m_function(&mut self, m: &Code) {
        if self.motion.measuring.banding && self.machine.channel.m_at_signal.contains(&m.number) {
            // processed with the motion
            return;
        }
        if let Some(text) = crate::exec::block::dialect::m_function(m.number) {
            let key = format!("M{}", m.number);
            self.report.note_once(&key, Fault::new(Condition::Dialect, text, m.span));
        }
        self.contour.event(Event::MFunction { number: m.number, value: m.value });
        self.takes_time(Function::M(m.number));
    }

    /// Starts or stops the main spindle as programmed on one side of the motion of the block: before it, or after it with
    /// MNS_SNS. Assumption: M5 without an entry in the list also takes effect after it.
    fn turn_main_spindle(&mut self, words: &Words<'_>, now: SpindleMoment) {
        let listed = self.motion.spindles[0].index.and_then(|i| {
            let waits: Option<&SpindleWaits> = self.machine.channel.spindle_waits.get(i);
            waits.copied()
        });
        let acts = |number: u32| match listed.unwrap_or_default().of_m(number) {
            Some(Acknowledged::AfterMotion) => SpindleMoment::AfterMotion,
            None if number == 5 => SpindleMoment::AfterMotion,
            Some(_) | None => SpindleMoment::BeforeMotion,
        };
        let of_spindle = words.m.iter().filter(|m| m_kind(m.number) == MKind::Spindle);
        for m in of_spindle.filter(|m| !is_direction(words, m) && acts(m.number) == now) {
            self.turn(m, words.m.iter().find(|m| is_direction(words, m)).map(|m| m.number));
        }
    }

    fn turn(&mut self, m: &Code, direction: Option<u32>) {
        let Some(spindle) = self.motion.spindles[0].index else {
            let text = format!("M{:02}: the channel has no spindle", m.number);
            self.report.note(Fault::new(Condition::MFunctionWithoutSpindle, text, m.span));
            return;
        };
        if let (19, Some(deg)) = (m.number, m.value) {
            self.motion.spindles[0].angle_deg = deg;
        }
        let turning = Turning::of(m.number);
        self.motion.spindles[0].turning = match direction {
            Some(number) => turning.with_direction(number),
            None => turning,
        };
        let outcome = self.move_spindle(0, m.span);
        self.report.keep(outcome);
        self.takes_time(Function::Spindle { spindle, m: m.number });
        if m.number != 5 {
            self.spindle_warning(0, m.span);
        }
    }

    pub(super) fn functions_after<'b>(&mut self, words: &Words<'b>) -> After<'b> {
        let mut then = Then::Next;
        self.turn_main_spindle(words, SpindleMoment::AfterMotion);
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
                    self.takes_declared_time(Function::M(m.number));
                    then = Then::End;
                }
                MKind::Return => then = Then::Return(words.back),
                _ => {}
            }
        }
        let call = self.call_after(words);
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

    /// The one call at the end of a block.
    fn call_after<'b>(&mut self, words: &Words<'b>) -> Option<CallAfter<'b>> {
        let tool_change = words.m.iter().find(|m| {
            m_kind(m.number) == MKind::ToolChange && self.calls.tool_change_file.is_some()
        });
        let tool_data = self.tool_data_word(words).filter(|_| self.calls.tool_data_file.is_some());
        let called = words.call.is_some() || words.cycle.is_some();
        if let (Some(m), true) = (tool_change, called || tool_data.is_some()) {
            let text = "M06 calls a subroutine: a second call in its block";
            self.report.note(Fault::new(Condition::SeveralCalls, text, m.span));
        } else if let (Some(at), true) = (tool_data, called) {
            let text = "D calls a subroutine: a second call in its block";
            self.report.note(Fault::new(Condition::SeveralCalls, text, at));
        }
        if let (Some(cycle), Some(_)) = (&words.cycle, words.call) {
            let text = format!("G{} calls a subroutine: a second call in its block", cycle.number);
            self.report.note(Fault::new(Condition::SeveralCalls, text, cycle.span));
        }
        if let Some((call, span)) = words.call {
            return Some(CallAfter::Written(call, span));
        }
        let cycle = words.cycle.clone().map(CallAfter::Cycle);
        cycle
            .or_else(|| tool_change.map(|m| CallAfter::ToolChange(m.span)))
            .or_else(|| tool_data.map(CallAfter::ToolData))
    }

    /// The D word, or the T word if it also selects tool data (P-CHAN-00014).
    fn tool_data_word(&self, words: &Words<'_>) -> Option<Span> {
        let with_tool = words.tool.filter(|_| self.machine.channel.tool_data_with_tool);
        words.tool_data.or(with_tool).map(|(_, span)| span)
    }
}
