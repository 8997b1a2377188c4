//! Commands of spindles in brackets: `S[M3 REV1000 M10]`, `S[G135 G136=80]`, `S[OVERRIDE SPEED_FACT=50]`.
//!
//! Source: TF5200 programming manual (programming in spindle-specific syntax; programmable spindle override); TF5200
//! feedforward control (spindles); 21422, 21738, 21867.

mod item;

use super::{function, once};
use crate::diag::Condition;
use crate::exec::block::collected::Words;
use crate::exec::block::modes::{limited_weight, note_without_feedforward, weight_ratio};
use crate::exec::commands::keys::{SPINDLE_OVERRIDE, arguments};
use crate::exec::commands::range::between;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::spindles::Turning;
use crate::exec::motion::state::{Function, MotionState};
use crate::exec::output::{Output, output};
use crate::machine::Acknowledged;
use crate::syntax::ast::{Bracket, Group, Item, ItemKind, Span};
pub(super) use item::is_internal;
use item::{SpindleItem, tool_limits};
use std::mem::discriminant;

arguments! {
    /// Keys of `S[OVERRIDE ..]`.
    struct SpindleOverrideArguments {
        speed: Number "SPEED_FACT" in between(0.1, 200.0), "%", "";
    }
}

impl MotionState {
    /// Carries out one item. Whether the bracket contains M19, and any of M3, M4, M5 and M19: its synchronisation counts instead of
    /// that of the speed (208010763).
    fn spindle_action(
        &mut self,
        spindle: usize,
        item: &SpindleItem,
        [positions, turns]: [bool; 2],
        output: &mut Output<'_>,
        span: Span,
    ) -> Outcome<()> {
        match *item {
            SpindleItem::Turn(number) => {
                self.spindle_turns(spindle, number, positions, output, span)?;
            }
            SpindleItem::Function(function, value) => {
                self.call(function, value, &output.machine.channel, output.contour);
            }
            SpindleItem::FullOverride => {}
            SpindleItem::Home => {
                let text = "G74: the spindle is treated as homed at its position and does not turn";
                output.report.note_once("S[G74]", Fault::new(Condition::Fallback, text, span));
            }
            SpindleItem::Speed(rpm) => self.spindle_speed(spindle, rpm, turns, output, span)?,
            SpindleItem::Position(deg) => self.spindles[spindle].angle_deg = deg,
            SpindleItem::Acceleration(percent) => {
                let ratio = weight_ratio((percent, span))?;
                if ratio == 0.0 {
                    let text = "G130=0: the spindle would never reach its speed";
                    return Err(Fault::new(Condition::Range, text, span));
                }
                self.spindles[spindle].acceleration_ratio = ratio;
                if let Some(event) = self.spindles[spindle].acceleration_event() {
                    output.contour.event(event);
                }
            }
            SpindleItem::Feedforward(on) => {
                if on {
                    self.note_spindle_without_feedforward("G135", spindle, output, span);
                }
                self.spindles[spindle].feedforward = on;
                self.spindle_feedforward(spindle, output.contour);
            }
            SpindleItem::Weight(percent) if percent < 0.0 => {
                let text = format!("feedforward weight {percent} % is negative");
                return Err(Fault::new(Condition::FeedforwardNegative, text, span));
            }
            SpindleItem::Weight(percent) => {
                let percent = limited_weight(percent, span, output.report);
                self.spindles[spindle].weight_ratio = percent / 100.0;
                if percent > 0.0 {
                    self.note_spindle_without_feedforward("G136", spindle, output, span);
                }
                self.spindle_feedforward(spindle, output.contour);
            }
        }
        Ok(())
    }

    /// K-0075 for a configured spindle without feedforward.
    fn note_spindle_without_feedforward(
        &self,
        word: &str,
        spindle: usize,
        output: &mut Output<'_>,
        span: Span,
    ) {
        if let Some(index) = self.spindles[spindle].index {
            note_without_feedforward(word, &output.machine.spindles[index], span, output.report);
        }
    }

    /// M3, M4, M5 and M19; `positions`: beside M19.
    fn spindle_turns(
        &mut self,
        spindle: usize,
        number: u32,
        positions: bool,
        output: &mut Output<'_>,
        span: Span,
    ) -> Outcome<()> {
        if number == 19 && spindle == 0 {
            self.cutting.positions_main_spindle(span)?;
        }
        let state = &mut self.spindles[spindle];
        let directs =
            matches!((state.turning, number), (Turning::Positioned(_), 3 | 4)) && positions;
        state.turning =
            if directs { state.turning.with_direction(number) } else { Turning::of(number) };
        if let Some(index) = state.index {
            let function = Function::Spindle { spindle: index, m: number };
            self.takes_time(function, &output.machine.channel, output.contour);
        }
        Ok(())
    }

    /// S; `turns`: beside M3, M4, M5 or M19.
    fn spindle_speed(
        &mut self,
        spindle: usize,
        rpm: f64,
        turns: bool,
        output: &mut Output<'_>,
        span: Span,
    ) -> Outcome<()> {
        if !(0.0..=1e6).contains(&rpm) {
            let text = format!("spindle speed {rpm} is outside 0 to 1000000 rev/min");
            let condition =
                if rpm < 0.0 { Condition::SpindleSpeedNegative } else { Condition::Range };
            return Err(Fault::new(condition, text, span));
        }
        self.spindles[spindle].rpm = rpm;
        self.spindles[spindle].check_speed(output.machine, output.report, span);
        if let Some(index) = self.spindles[spindle].index.filter(|_| !turns) {
            let function = Function::Speed { spindle: index };
            self.takes_time(function, &output.machine.channel, output.contour);
        }
        Ok(())
    }
}

impl Decoder {
    pub(super) fn spindle_bracket(
        &mut self,
        spindle: usize,
        bracket: &Bracket,
        words: &Words<'_>,
    ) -> Outcome<()> {
        let group = &bracket.group;
        if let Some((Item { kind: ItemKind::Flag(word), .. }, rest)) = group.items.split_first()
            && word.is("OVERRIDE")
        {
            let rest = Group { items: rest.to_vec(), span: group.span };
            return self.spindle_override(spindle, &rest);
        }
        if let Some((default, span)) = group.items.iter().find_map(tool_limits) {
            if group.items.len() > 1 {
                let text = "the dynamic data of a tool need a separate bracket";
                return Err(Fault::new(Condition::SpindleCommandsExclude, text, span));
            }
            return if default {
                self.motion.default_limits(spindle, output!(self), span)
            } else {
                self.motion.take_tool_limits(spindle, output!(self), span)
            };
        }
        let functions: Vec<_> = group.items.iter().filter_map(function).collect();
        once(&functions, bracket, words)?;
        let mut items = self.spindle_items(spindle, group)?;
        if let Some((_, span)) =
            items.iter().find(|(i, _)| self.is_set_twice(spindle, i, bracket, words))
        {
            let text = "started, stopped or given a speed twice in one block";
            let text = format!("{} is {text}", self.motion.spindles[spindle].name);
            return Err(Fault::new(Condition::DuplicateGroup, text, *span));
        }
        let motion = |i: &SpindleItem| matches!(i, SpindleItem::Turn(_) | SpindleItem::Speed(_));
        let moves = items.iter().any(|(i, _)| motion(i));
        let turns = items.iter().any(|(i, _)| matches!(i, SpindleItem::Turn(_)));
        // one event for the whole bracket, regardless of the order of its words: M3 gives the direction of M19
        items.sort_by_key(|(i, _)| match i {
            SpindleItem::Turn(19) => 0,
            SpindleItem::Turn(_) => 1,
            _ => 2,
        });
        let positions = items.iter().any(|(i, _)| matches!(i, SpindleItem::Turn(19)));
        for (item, span) in items {
            self.motion.spindle_action(spindle, &item, [positions, turns], output!(self), span)?;
        }
        if moves && (turns || self.motion.spindles[spindle].turning != Turning::Stopped) {
            self.motion.move_spindle(spindle, output!(self), group.span)?;
        }
        self.motion.spindles[spindle].warn(&mut self.report, group.span);
        Ok(())
    }

    /// The items of a bracket, checked against each other.
    fn spindle_items(&self, spindle: usize, group: &Group) -> Outcome<Vec<(SpindleItem, Span)>> {
        let mut items = Vec::new();
        let mut unknown = None;
        for item in &group.items {
            match SpindleItem::read(self, item) {
                _ if matches!(item.kind, ItemKind::Missing) => {}
                Ok(known) => items.push((known, item.span)),
                Err(fault) => unknown = unknown.or(Some(fault)),
            }
        }
        let of_plc = self.motion.spindles[spindle]
            .index
            .and_then(|i| self.machine.channel.spindles.of_plc.get(i));
        let own = |i: &SpindleItem| {
            matches!(i, SpindleItem::Turn(_) | SpindleItem::Speed(_) | SpindleItem::Position(_))
        };
        if let (Some(true), Some((_, span))) = (of_plc, items.iter().find(|(i, _)| !own(i))) {
            let text = "a spindle controlled by the PLC only takes M3, M4, M5, M19, REV and POS";
            return Err(Fault::new(Condition::PlcSpindle, text, *span));
        }
        exclude_each_other(&items)?;
        set_twice(&items)?;
        // M3 together with M4 is an error whatever else the bracket contains (20155 prints an unknown word beside them)
        if let Some(unknown) = unknown {
            return Err(unknown);
        }
        Ok(items)
    }

    /// Whether a bracket before this one, or a word without a bracket, rotates the spindle or sets its speed as `item` does.
    fn is_set_twice(
        &self,
        spindle: usize,
        item: &SpindleItem,
        bracket: &Bracket,
        words: &Words<'_>,
    ) -> bool {
        let same = |other: &SpindleItem| discriminant(other) == discriminant(item);
        let of_words = match item {
            SpindleItem::Turn(_) => {
                spindle == 0 && words.m.iter().any(|m| matches!(m.number, 3..=5 | 19))
            }
            SpindleItem::Speed(_) => words.speeds.iter().any(|(other, _, _)| *other == spindle),
            _ => return false,
        };
        of_words
            || words.brackets_before(bracket).any(|other| {
                let mut items =
                    other.group.items.iter().filter_map(|i| SpindleItem::read(self, i).ok());
                self.motion.spindle_of_name(other.name.as_str(), &self.machine.channel)
                    == Some(spindle)
                    && items.any(|other| same(&other))
            })
    }

    /// `S[OVERRIDE SPEED_FACT=..]`: the speed of a spindle in percent of the programmed one, modal.
    ///
    /// Assumption: it also applies to the speed of M19, as the external override does.
    fn spindle_override(&mut self, spindle: usize, group: &Group) -> Outcome<()> {
        let keys = SpindleOverrideArguments::read(self, SPINDLE_OVERRIDE, Some(group))?;
        let Some((percent, span)) = keys.speed else {
            let text = format!("{SPINDLE_OVERRIDE} needs SPEED_FACT");
            return Err(Fault::new(Condition::SpindleToken, text, group.span));
        };
        self.motion.spindles[spindle].override_ratio = percent / 100.0;
        if spindle == 0 && self.motion.cutting.is_on() {
            self.motion.no_spindle_override("G96", span)?;
        }
        if self.motion.spindles[spindle].is_turning() {
            self.motion.move_spindle(spindle, output!(self), span)?;
        }
        self.motion.spindles[spindle].check_speed(&self.machine, &mut self.report, span);
        Ok(())
    }

    /// Whether a bracket belongs to a spindle with functions after the motion of their block (MNS_SNS); this applies to the
    /// whole bracket.
    pub(in crate::exec) fn acts_late(&self, bracket: &Bracket) -> bool {
        let Some(spindle) =
            self.motion.spindle_of_name(bracket.name.as_str(), &self.machine.channel)
        else {
            return false;
        };
        let listed = self.motion.spindles[spindle].index;
        let Some(waits) = listed.and_then(|i| self.machine.channel.functions.spindle_waits.get(i))
        else {
            return false;
        };
        let read = |item| SpindleItem::read(self, item).ok();
        let items: Vec<_> = bracket.group.items.iter().filter_map(read).collect();
        let turns = items.iter().any(|item| matches!(item, SpindleItem::Turn(_)));
        items.iter().any(|item| {
            let until = match item {
                SpindleItem::Turn(number) => waits.of_m(*number),
                SpindleItem::Speed(_) if !turns => waits.speed,
                _ => None,
            };
            until == Some(Acknowledged::AfterMotion)
        })
    }
}

/// Items that need a bracket without certain others.
fn exclude_each_other(items: &[(SpindleItem, Span)]) -> Outcome<()> {
    let feedforward =
        |i: &SpindleItem| matches!(i, SpindleItem::Feedforward(_) | SpindleItem::Weight(_));
    let mut weights = items.iter().filter(|(i, _)| matches!(i, SpindleItem::Weight(_)));
    if let (Some(_), Some((_, span))) = (weights.next(), weights.next()) {
        return Err(Fault::new(
            Condition::SpindleFeedforwardTwice,
            "G136 twice for one spindle",
            *span,
        ));
    }
    let some = items.iter().find(|(i, _)| feedforward(i));
    let other = items.iter().find(|(i, _)| !feedforward(i));
    let weight = items.iter().find(|(i, _)| matches!(i, SpindleItem::Acceleration(_)));
    if let (Some(_), Some((_, span))) = (some, weight) {
        let text = "feedforward and G130 cannot be in one bracket";
        return Err(Fault::new(Condition::SpindleCommandsExclude, text, *span));
    }
    let homes = items.iter().any(|(i, _)| matches!(i, SpindleItem::Home));
    let turns = items.iter().find(|(i, _)| matches!(i, SpindleItem::Turn(_)));
    if let (true, Some((_, span))) = (homes, turns) {
        let text = "G74 and M3, M4, M5 or M19 cannot be in one bracket";
        return Err(Fault::new(Condition::SpindleCommandsExclude, text, *span));
    }
    if let (Some(_), Some((_, span))) = (some, other) {
        let text = "feedforward needs a separate bracket, without other commands";
        return Err(Fault::new(Condition::SpindleFeedforward, text, *span));
    }
    Ok(())
}

/// Items that set the same value.
fn set_twice(items: &[(SpindleItem, Span)]) -> Outcome<()> {
    for (i, (item, span)) in items.iter().enumerate() {
        let same = |(other, _): &(SpindleItem, Span)| discriminant(other) == discriminant(item);
        let several = matches!(item, SpindleItem::Function(..));
        // M3 and M4 give the direction of M19
        let directs = |(other, _): &(SpindleItem, Span)| {
            matches!(
                (item, other),
                (SpindleItem::Turn(19), SpindleItem::Turn(3 | 4))
                    | (SpindleItem::Turn(3 | 4), SpindleItem::Turn(19))
            )
        };
        if !several && items[..i].iter().any(|other| same(other) && !directs(other)) {
            let text = "two words of the spindle bracket set the same value";
            let condition = match item {
                SpindleItem::Turn(_) => Condition::SpindleMTwice,
                SpindleItem::Speed(_) => Condition::SpindleSpeedTwice,
                SpindleItem::Position(_) => Condition::SpindlePositionTwice,
                _ => Condition::DuplicateGroup,
            };
            return Err(Fault::new(condition, text, *span));
        }
    }
    Ok(())
}
