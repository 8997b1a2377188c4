//! Durations of M, H, S and T functions: included in the run, or reported as not included.
//!
//! The vendor's production time calculation takes them from the channel list (TF5200 M and H functions, production time
//! calculation; P-CHAN-00026, 00040, 00042, 00044, 00046, 00048, 00072, 00080).

use super::state::{Function, MotionState};
use crate::diag::Condition;
use crate::exec::contour::Contour;
use crate::exec::decoder::Decoder;
use crate::exec::fault::Fault;
use crate::exec::step::{Event, SpindleState, Sync};
use crate::machine::table::channel as of;
use crate::machine::table::param::{Optional, Param};
use crate::machine::{Acknowledged, Channel, SpindleMoment};
use crate::syntax::ast::Span;

impl MotionState {
    /// Passes a function to the machine: the path waits for its duration ([`Decoder::technology_wait`]), or the function is
    /// reported once.
    pub(in crate::exec) fn takes_time(
        &mut self,
        function: Function,
        channel: &Channel,
        contour: &mut Contour,
    ) {
        // Assumption: functions without an entry in the list are waited for before the motion
        let listed = acknowledged(channel, function);
        let until = listed.unwrap_or(Acknowledged::BeforeMotion);
        if until == Acknowledged::Never {
            return;
        }
        let seconds = self.counted_time_s(function, channel, contour);
        if seconds > 0.0 {
            self.technology.pending.push((seconds, until, function));
        }
        self.technology.spindles.extend(waited_for(channel, function));
    }

    /// M00, M01 and the end of a program: only a declared duration applies; none is required.
    pub(in crate::exec) fn takes_declared_time(
        &mut self,
        function: Function,
        channel: &Channel,
        contour: &mut Contour,
    ) {
        if declared(channel, function).is_some() {
            self.takes_time(function, channel, contour);
        }
    }

    /// Time in s of a function; 0 if it is not included, with one report.
    pub(in crate::exec) fn counted_time_s(
        &mut self,
        function: Function,
        channel: &Channel,
        contour: &mut Contour,
    ) -> f64 {
        let declared = declared(channel, function);
        if self.technology.counted
            && let Some((seconds, _)) = declared
        {
            return seconds;
        }
        let simulated = matches!(function, Function::Spindle { .. } | Function::Speed { .. });
        if (simulated && declared.is_none()) || !self.technology.named.insert(function) {
            return 0.0;
        }
        let name = self.name_of(function);
        let function = match declared {
            Some((seconds, parameter)) => {
                format!("{name} ({seconds} s each by {})", parameter.place().row.id)
            }
            None => name,
        };
        contour.event(Event::Uncounted { function });
        0.0
    }

    /// M00, M01: the time until the operator continues is not counted.
    pub(in crate::exec) fn waits_for_operator(&mut self, number: u32, contour: &mut Contour) {
        if self.technology.named.insert(Function::M(number)) {
            let function = format!("M{number:02} (until the operator continues)");
            contour.event(Event::Uncounted { function });
        }
    }

    /// A function in messages.
    fn name_of(&self, function: Function) -> String {
        let spindle = |i: usize| self.spindles.get(i).map_or("", |s| s.name.as_str());
        match function {
            Function::M(number) => format!("M{number}"),
            Function::H(number) => format!("H{number}"),
            Function::Tool => "tool change (T)".to_owned(),
            Function::Spindle { spindle: i, m } => format!("M{m} of {}", spindle(i)),
            Function::Speed { spindle: i } => format!("S word of {}", spindle(i)),
        }
    }
}

impl Decoder {
    /// The path waits for the functions called since the last wait, before or after the motion of the block.
    pub(in crate::exec) fn technology_wait(&mut self, now: SpindleMoment) {
        // Assumption: the functions of a block are output to the machine together, so the longest one determines the wait
        let mut seconds = 0.0_f64;
        let pending = std::mem::take(&mut self.motion.technology.pending);
        for (time_s, until, function) in pending {
            match (until, now) {
                (Acknowledged::Never, _) => {}
                (Acknowledged::Elsewhere(kind, place), _) => {
                    let name = self.motion.name_of(function);
                    let text = format!(
                        "{name} ({kind}): the path waits {time_s} s here; that of the control waits {place}"
                    );
                    let fault = Fault::new(Condition::Fallback, text, Span::default());
                    self.report.note_once(name.as_str(), fault);
                    seconds = seconds.max(time_s);
                }
                (Acknowledged::BeforeMotion, _)
                | (Acknowledged::AfterMotion, SpindleMoment::AfterMotion) => {
                    seconds = seconds.max(time_s);
                }
                // Assumption: the motion takes the time given by its feed rate
                (Acknowledged::DuringMotion, SpindleMoment::AfterMotion) => {
                    seconds = seconds.max(time_s - self.contour.time_of_s(self.report.source));
                }
                (_, SpindleMoment::BeforeMotion) => {
                    self.motion.technology.pending.push((time_s, until, function));
                }
            }
        }
        if seconds > 0.0 {
            self.sync(Sync::Technology { seconds });
        }
        // spindles accelerate in the meantime: the later of the two determines the wait (M and H functions 286068747)
        let spindles = std::mem::take(&mut self.motion.technology.spindles);
        for (spindle, moment) in spindles {
            if moment == now || now == SpindleMoment::AfterMotion {
                self.sync(Sync::Spindle { spindle, state: SpindleState::Reached });
            } else {
                self.motion.technology.spindles.push((spindle, moment));
            }
        }
    }
}

/// The list entry of a function; `None` without an entry.
fn acknowledged(channel: &Channel, function: Function) -> Option<Acknowledged> {
    let listed =
        |spindle: usize| channel.functions.spindle_waits.get(spindle).copied().unwrap_or_default();
    match function {
        Function::M(number) => channel.functions.m_waits.get(&number).copied(),
        Function::H(number) => channel.functions.h_waits.get(&number).copied(),
        Function::Spindle { spindle, m } => listed(spindle).of_m(m),
        Function::Speed { spindle } => listed(spindle).speed,
        Function::Tool => None,
    }
}

/// The spindle that the path waits for after a function, and when.
fn waited_for(channel: &Channel, function: Function) -> Option<(usize, SpindleMoment)> {
    let (Function::Spindle { spindle, .. } | Function::Speed { spindle }) = function else {
        return None;
    };
    let moment = match acknowledged(channel, function)? {
        Acknowledged::Never => return None,
        Acknowledged::BeforeMotion | Acknowledged::Elsewhere(..) => SpindleMoment::BeforeMotion,
        Acknowledged::DuringMotion | Acknowledged::AfterMotion => SpindleMoment::AfterMotion,
    };
    Some((spindle, moment))
}

/// Duration in s, above 0, and the parameter that declares it.
fn declared(channel: &Channel, function: Function) -> Option<(f64, Param<Optional>)> {
    let listed = |spindle: usize| {
        channel.functions.spindle_durations_s.get(spindle).copied().unwrap_or_default()
    };
    let (seconds, parameter) = match function {
        Function::M(number) => {
            (channel.functions.m_durations_s.get(&number).copied(), of::M_DURATION)
        }
        Function::H(number) => {
            (channel.functions.h_durations_s.get(&number).copied(), of::H_DURATION)
        }
        Function::Tool => (channel.functions.tool_duration_s, of::TOOL_DURATION),
        Function::Spindle { spindle, m: 3 } => (listed(spindle).m3, of::SPINDLE_M3_DURATION),
        Function::Spindle { spindle, m: 4 } => (listed(spindle).m4, of::SPINDLE_M4_DURATION),
        Function::Spindle { spindle, m: 5 } => (listed(spindle).m5, of::SPINDLE_M5_DURATION),
        Function::Spindle { spindle, .. } => (listed(spindle).m19, of::SPINDLE_M19_DURATION),
        Function::Speed { spindle } => (listed(spindle).speed, of::SPINDLE_SPEED_DURATION),
    };
    seconds.filter(|s| *s > 0.0).map(|s| (s, parameter))
}
