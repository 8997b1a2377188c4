//! Axis and spindle commands in brackets: `X[OVERRIDE ..]`, `X[INDP_SYN ..]`, `X[M10]`, `S[M3 REV1000 M10]`,
//! `S[G135 G136=80]`.
//!
//! Source: TF5200 programming manual (M and H functions of spindles: user-specific functions); TF5200 feedforward control (spindles); 21301, 21736, 21738, 21867.

use super::collected::Words;
use super::modes::weight_ratio;
use crate::diag::Condition;
use crate::exec::commands::keys::{arguments, between};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::dynamics::Weight;
use crate::exec::motion::spindles::Turning;
use crate::exec::motion::state::Function;
use crate::exec::step::Event;
use crate::syntax::ast::{Bracket, Group, Item, ItemKind, ItemValue, Span};
use std::mem::discriminant;

/// Beginnings of further words of spindle brackets that the manual knows. Source: TF5200 programming manual, programming in
/// spindle-specific syntax.
const OTHER_WORDS: &[&str] = &[
    "OVERRIDE",
    "CALLAX",
    "PUTAX",
    "SYNC",
    "LINK",
    "FEED_LINK",
    "TRANS",
    "DYNAMIC",
    "MC_",
    "G74",
    "G112",
    "G131",
    "G132",
    "G133",
    "G134",
    "G230",
    "G231",
    "G233",
];

/// Words that belong to the functions of an axis and cannot come before them (21301).
const OF_FUNCTIONS: &[&str] = &[
    "POS",
    "FEED",
    "TIME",
    "FEED_MAX_WEIGHT",
    "SLOPE_TYPE",
    "ACC_WEIGHT",
    "RAPID_ACC_WEIGHT",
    "INCL_OFFSETS",
    "DRY_RUN",
    "G00",
    "G0",
    "G01",
    "G1",
    "G90",
    "G91",
    "G100",
    "1ST_POS",
    "2ND_POS",
    "ZERO_POS",
    "EXCUR",
    "FREQ",
    "NBR_OSC",
    "OFFSET",
];

/// What one item of a spindle bracket means.
enum SpindleItem {
    /// M3, M4, M5, M19.
    Turn(u32),
    /// REV=, SPEED=.
    Speed(f64),
    /// POS=.
    Position(f64),
    /// G130=.
    Acceleration(f64),
    /// G135, G137.
    Feedforward(bool),
    /// G136=.
    Weight(f64),
    /// M or H function of the user.
    Function(Function),
    /// G167.
    FullOverride,
}

arguments! {
    /// Keys of `#OVERRIDE` and `X[OVERRIDE]`.
    pub(in crate::exec) struct OverrideArguments {
        feed: Number "FEED_FACT" in between(0.1, 200.0), "%", "";
        rapid: Number "RAPID_FACT" in between(0.1, 200.0), "%", "";
    }
}

impl Decoder {
    pub(in crate::exec) fn bracket(&mut self, bracket: &Bracket, words: &Words<'_>) -> Outcome<()> {
        let name = bracket.name.as_str();
        if let Some(axis) = self.names.of_name(name) {
            return self.axis_bracket(axis, bracket, words);
        }
        if let Some(spindle) = self.spindle_of_name(name) {
            return self.spindle_bracket(spindle, bracket, words);
        }
        // `X100 [NAME]` reads like the bracket of an axis X100
        if let ([Item { kind: ItemKind::Flag(_), .. }], true) =
            (&bracket.group.items[..], name.ends_with(|c: char| c.is_ascii_digit()))
        {
            let text = "a label comes first in its block, not after words";
            return Err(Fault::new(Condition::LabelBehindWords, text, bracket.group.span));
        }
        Err(self.unknown_axis(name, bracket.group.span))
    }

    fn axis_bracket(&mut self, axis: usize, bracket: &Bracket, words: &Words<'_>) -> Outcome<()> {
        let group = &bracket.group;
        let functions: Vec<Option<(Function, Span)>> = group.items.iter().map(function).collect();
        if let Some(functions) = functions.into_iter().collect::<Option<Vec<_>>>()
            && !functions.is_empty()
        {
            once(&functions, bracket, words)?;
            for (function, _) in functions {
                self.call_function(function);
            }
            return Ok(());
        }
        match group.items.split_first() {
            Some((Item { kind: ItemKind::Flag(word), .. }, rest)) if word.is("OVERRIDE") => {
                let rest = Group { items: rest.to_vec(), span: group.span };
                let title = format!("{}[OVERRIDE]", self.names.name(axis));
                self.set_overrides(Some(axis), Some(&rest), &title, group.span)
            }
            Some((Item { kind: ItemKind::Flag(word), .. }, rest))
                if word.is("INDP_SYN") || word.is("INDP_ASYN") =>
            {
                if words.axes.iter().any(|(moved, _, _)| *moved == axis) {
                    return Err(self.axis_twice(axis, group.span));
                }
                self.independent_axis(axis, word.is("INDP_SYN"), rest, group.span)
            }
            // OSC_ON: as the diagnosis manual writes it, 120470
            Some((Item { kind: ItemKind::Flag(word), .. }, rest))
                if word.is("OSC") || word.is("OSC_ON") =>
            {
                if words.axes.iter().any(|(moved, _, _)| *moved == axis) {
                    return Err(self.axis_twice(axis, group.span));
                }
                let items = if word.is("OSC") { rest } else { &group.items[..] };
                self.oscillating_axis(axis, items, group.span)
            }
            Some((Item { kind: ItemKind::Flag(word), .. }, rest)) if word.is("SET_POSITION") => {
                if words.axes.iter().any(|(moved, _, _)| *moved == axis) {
                    return Err(self.axis_twice(axis, group.span));
                }
                self.set_position(axis, rest, group.span)
            }
            Some((
                Item { kind: ItemKind::Flag(word) | ItemKind::Pair { key: word, .. }, span },
                _,
            )) if OF_FUNCTIONS.iter().any(|other| word.is(other)) => {
                let name = self.names.name(axis);
                let text = format!("{name}[{} ..]: its function comes first", word.text);
                Err(Fault::new(Condition::AxisFunctionMissing, text, *span))
            }
            Some((
                Item { kind: ItemKind::Flag(word) | ItemKind::Pair { key: word, .. }, span },
                _,
            )) => {
                let name = self.names.name(axis);
                Err(Fault::unsupported(format!("{name}[{}]", word.text), *span))
            }
            _ => {
                let text = "an axis command is expected in the bracket";
                Err(Fault::new(Condition::Syntax, text, group.span))
            }
        }
    }

    /// `FEED_FACT` and `RAPID_FACT` in percent.
    pub(in crate::exec) fn set_overrides(
        &mut self,
        axis: Option<usize>,
        group: Option<&Group>,
        title: &str,
        span: Span,
    ) -> Outcome<()> {
        let keys = OverrideArguments::read(self, title, group)?;
        let ratio = |key: Option<(f64, Span)>| key.map(|(percent, _)| percent / 100.0);
        let (feed, rapid) = (ratio(keys.feed), ratio(keys.rapid));
        if feed.is_none() && rapid.is_none() {
            let text = format!("{title} needs FEED_FACT or RAPID_FACT");
            return Err(Fault::new(Condition::TokenUnknown, text, span));
        }
        self.motion.overrides.set(axis, feed, rapid);
        Ok(())
    }

    /// An M or H function of an axis or spindle: for the log, and for the time it takes.
    fn call_function(&mut self, function: Function) {
        self.takes_time(function);
        match function {
            Function::M(number) => self.contour.event(Event::MFunction { number, value: None }),
            Function::H(number) => self.contour.event(Event::HFunction { number, value: None }),
            Function::Tool | Function::Spindle { .. } | Function::Speed { .. } => {}
        }
    }

    fn spindle_bracket(
        &mut self,
        spindle: usize,
        bracket: &Bracket,
        words: &Words<'_>,
    ) -> Outcome<()> {
        let group = &bracket.group;
        let functions: Vec<_> = group.items.iter().filter_map(function).collect();
        once(&functions, bracket, words)?;
        let mut items = Vec::new();
        let mut unknown = None;
        for item in &group.items {
            match self.spindle_item(item) {
                _ if matches!(item.kind, ItemKind::Missing) => {}
                Ok(known) => items.push((known, item.span)),
                Err(fault) => unknown = unknown.or(Some(fault)),
            }
        }
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
            let text = "feedforward and G130 in one bracket exclude each other";
            return Err(Fault::new(Condition::SpindleCommandsExclude, text, *span));
        }
        if let (Some(_), Some((_, span))) = (some, other) {
            let text = "feedforward needs a separate bracket, without other commands";
            return Err(Fault::new(Condition::SpindleFeedforward, text, *span));
        }
        for (i, (item, span)) in items.iter().enumerate() {
            let same = |(other, _): &(SpindleItem, Span)| discriminant(other) == discriminant(item);
            let several = matches!(item, SpindleItem::Function(_));
            // M3 and M4 are the direction of M19
            let directs = |(other, _): &(SpindleItem, Span)| {
                matches!(
                    (item, other),
                    (SpindleItem::Turn(19), SpindleItem::Turn(3 | 4))
                        | (SpindleItem::Turn(3 | 4), SpindleItem::Turn(19))
                )
            };
            if !several && items[..i].iter().any(|other| same(other) && !directs(other)) {
                let text = "two words of a spindle bracket that set the same";
                let condition = match item {
                    SpindleItem::Turn(_) => Condition::SpindleMTwice,
                    SpindleItem::Speed(_) => Condition::SpindleSpeedTwice,
                    SpindleItem::Position(_) => Condition::SpindlePositionTwice,
                    _ => Condition::DuplicateGroup,
                };
                return Err(Fault::new(condition, text, *span));
            }
        }
        // M3 beside M4 is wrong whatever else there is (20155 prints an unknown word beside them)
        if let Some(unknown) = unknown {
            return Err(unknown);
        }
        let motion = |i: &SpindleItem| matches!(i, SpindleItem::Turn(_) | SpindleItem::Speed(_));
        let moves = items.iter().any(|(i, _)| motion(i));
        let turns = items.iter().any(|(i, _)| matches!(i, SpindleItem::Turn(_)));
        // one event for the whole bracket, in whatever order its words come: M3 is the direction of M19
        items.sort_by_key(|(i, _)| match i {
            SpindleItem::Turn(19) => 0,
            SpindleItem::Turn(_) => 1,
            _ => 2,
        });
        let positions = items.iter().any(|(i, _)| matches!(i, SpindleItem::Turn(19)));
        for (item, span) in items {
            self.spindle_action(spindle, &item, positions, span)?;
        }
        let state = &self.motion.spindles[spindle];
        if moves
            && (turns || state.turning != Turning::Stopped)
            && let Some(event) = state.motion_event()
        {
            self.contour.event(event);
        }
        self.spindle_warning(spindle, group.span);
        Ok(())
    }

    fn spindle_item(&self, item: &Item) -> Outcome<SpindleItem> {
        let unknown = |shown: &str| {
            let text = format!("unknown word `{shown}` in a spindle bracket");
            Fault::new(Condition::SpindleToken, text, item.span)
        };
        if let Some((function, _)) = function(item) {
            return Ok(SpindleItem::Function(function));
        }
        let (word, value) = match &item.kind {
            ItemKind::Flag(word) => match word.split_number() {
                Some((name, number))
                    if ["REV", "SPEED", "POS"].iter().any(|n| name.eq_ignore_ascii_case(n)) =>
                {
                    (name.to_ascii_uppercase(), Some(number))
                }
                _ => (word.text.to_ascii_uppercase(), None),
            },
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } => {
                (key.text.to_ascii_uppercase(), Some(self.number(expr)?))
            }
            ItemKind::Pair { key, .. } => return Err(unknown(&key.text)),
            ItemKind::Value(_) | ItemKind::Target { .. } | ItemKind::Missing => {
                return Err(unknown("value"));
            }
        };
        Ok(match (word.as_str(), value) {
            ("M3" | "M03", None) => SpindleItem::Turn(3),
            ("M4" | "M04", None) => SpindleItem::Turn(4),
            ("M5" | "M05", None) => SpindleItem::Turn(5),
            ("M19", None) => SpindleItem::Turn(19),
            ("REV" | "SPEED", Some(x)) => SpindleItem::Speed(x),
            ("POS", Some(x)) => SpindleItem::Position(x),
            ("G135", None) => SpindleItem::Feedforward(true),
            ("G137", None) => SpindleItem::Feedforward(false),
            ("G136", Some(x)) => SpindleItem::Weight(x),
            ("G130", Some(x)) => SpindleItem::Acceleration(x),
            // no override from outside acts on spindles
            ("G167", None) => SpindleItem::FullOverride,
            (other, _) if OTHER_WORDS.iter().any(|w| other.starts_with(w)) => {
                let name = format!("{other} in a spindle bracket");
                return Err(Fault::unsupported(name, item.span));
            }
            (other, _) => return Err(unknown(other)),
        })
    }

    /// `positions`: the bracket contains M19.
    fn spindle_action(
        &mut self,
        spindle: usize,
        item: &SpindleItem,
        positions: bool,
        span: Span,
    ) -> Outcome<()> {
        match *item {
            SpindleItem::Turn(number) => {
                let state = &mut self.motion.spindles[spindle];
                let directs =
                    matches!((state.turning, number), (Turning::Positioned(_), 3 | 4)) && positions;
                state.turning = if directs {
                    state.turning.with_direction(number)
                } else {
                    Turning::of(number)
                };
                if let Some(index) = self.motion.spindles[spindle].index {
                    self.takes_time(Function::Spindle { spindle: index, m: number });
                }
            }
            SpindleItem::Function(function) => self.call_function(function),
            SpindleItem::FullOverride => {}
            SpindleItem::Speed(rpm) if !(0.0..=1e6).contains(&rpm) => {
                let text = format!("spindle speed {rpm} is outside 0 to 1000000 rev/min");
                let condition =
                    if rpm < 0.0 { Condition::SpindleSpeedNegative } else { Condition::Range };
                return Err(Fault::new(condition, text, span));
            }
            SpindleItem::Speed(rpm) => {
                self.set_spindle_speed(spindle, rpm, span);
                if let Some(index) = self.motion.spindles[spindle].index {
                    self.takes_time(Function::Speed { spindle: index });
                }
            }
            SpindleItem::Position(deg) => {
                self.motion.spindles[spindle].angle_deg = deg;
            }
            SpindleItem::Acceleration(percent) => {
                let ratio = weight_ratio(Weight::Acceleration, (percent, span))?;
                if ratio == 0.0 {
                    let text = "G130=0: the spindle would never reach its speed";
                    return Err(Fault::new(Condition::Range, text, span));
                }
                self.motion.spindles[spindle].acceleration_ratio = ratio;
                if let Some(event) = self.motion.spindles[spindle].acceleration_event() {
                    self.contour.event(event);
                }
            }
            SpindleItem::Feedforward(on) => {
                self.motion.spindles[spindle].feedforward = on;
                if let Some(event) = self.motion.spindles[spindle].feedforward_event() {
                    self.contour.event(event);
                }
            }
            SpindleItem::Weight(percent) if percent < 0.0 => {
                let text = format!("feedforward weight {percent} % is negative");
                return Err(Fault::new(Condition::FeedforwardNegative, text, span));
            }
            SpindleItem::Weight(percent) => {
                let percent = self.limited_weight(percent, span);
                self.motion.spindles[spindle].weight_ratio = percent / 100.0;
                if let Some(event) = self.motion.spindles[spindle].feedforward_event() {
                    self.contour.event(event);
                }
            }
        }
        Ok(())
    }
}

/// The user's M or H function that an item names: not those that end programs or turn spindles.
fn function(item: &Item) -> Option<(Function, Span)> {
    let ItemKind::Flag(word) = &item.kind else { return None };
    let digits = word.text.get(1..).filter(|d| d.bytes().all(|b| b.is_ascii_digit()))?;
    let number: u32 = digits.parse().ok().filter(|n| *n <= 65535)?;
    let function = match word.text.as_bytes().first()? {
        b'H' | b'h' => Function::H(number),
        b'M' | b'm' if !matches!(number, 0..=6 | 17 | 19 | 29 | 30) => Function::M(number),
        _ => return None,
    };
    Some((function, item.span))
}

/// 20765, 20766: a function may appear once for each axis and spindle of a block.
fn once(functions: &[(Function, Span)], bracket: &Bracket, words: &Words<'_>) -> Outcome<()> {
    let before = words.brackets.iter().take_while(|other| !std::ptr::eq(**other, bracket));
    let same = |name: &str| name.eq_ignore_ascii_case(bracket.name.as_str());
    let mut known: Vec<Function> = before
        .filter(|other| same(other.name.as_str()))
        .flat_map(|other| other.group.items.iter().filter_map(function))
        .map(|(function, _)| function)
        .collect();
    for (function, span) in functions {
        if known.contains(function) {
            let (condition, shown) = match function {
                Function::H(number) => (Condition::HTwice, format!("H{number}")),
                Function::M(number) => (Condition::MTwice, format!("M{number}")),
                Function::Tool | Function::Spindle { .. } | Function::Speed { .. } => continue,
            };
            let name = bracket.name.as_str();
            let text = format!("{shown} twice for {name} in one block");
            return Err(Fault::new(condition, text, *span));
        }
        known.push(*function);
    }
    Ok(())
}
