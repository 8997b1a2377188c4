//! Commands of axes in brackets: `X[OVERRIDE ..]`, `X[INDP_SYN ..]`, `X[M10]`. Those of spindles are in [`spindle`].
//!
//! Source: TF5200 programming manual (M and H functions of spindles: user-specific functions); 21301, 21736.

mod axis_compensation;
mod spindle;

use super::collected::Words;
use crate::diag::Condition;
use crate::exec::commands::keys::arguments;
use crate::exec::commands::range::between;
use crate::exec::contour::Contour;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::state::{Function, MotionState};
use crate::exec::names::AxisNames;
use crate::exec::step::Event;
use crate::machine::Channel;
use crate::machine::table::channel as of;
use crate::syntax::ast::{Bracket, Group, Ident, Item, ItemKind, ItemValue, Span};
use std::collections::BTreeMap;

/// Words that belong to the functions of an axis and must not precede them (21301).
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

/// Functions of axes in the manual that are not built.
const REFUSED: &[&str] = &[
    "LIFT",
    "LIFT_START",
    "LIFT_END",
    "SYNC",
    "DIST_CTRL",
    "GANTRY",
    "CALLAX",
    "PUTAX",
    "MODULO",
    "FIXED_STOP",
    "POS_LIMIT",
    "DYNAMIC",
    "POLY",
];

arguments! {
    /// Keys of `#OVERRIDE` and `X[OVERRIDE]`.
    pub(in crate::exec) struct OverrideArguments {
        feed: Number "FEED_FACT" in between(0.1, 200.0), "%", "";
        rapid: Number "RAPID_FACT" in between(0.1, 200.0), "%", "";
    }
}

/// `OFF`, `OFF NO_MOVE` of `Z[DIST_CTRL ..]`: without distance control there is no offset to be moved out (290203275).
fn switches_off(items: &[Item]) -> bool {
    let is = |item: &Item, name: &str| matches!(&item.kind, ItemKind::Flag(word) if word.is(name));
    match items {
        [off] => is(off, "OFF"),
        [off, stay] => is(off, "OFF") && is(stay, "NO_MOVE"),
        _ => false,
    }
}

impl MotionState {
    /// `Z[LIFT_START ..]`, `Z[LIFT_END]`: 21558 and 21559 (diagnosis 255193483, 255197835) come before the refusal.
    fn lifting(&mut self, word: &Ident, span: Span) -> Outcome<()> {
        if word.is("LIFT_START") && std::mem::replace(&mut self.lifts, true) {
            return Err(Fault::new(Condition::LiftTwice, "LIFT_START without LIFT_END", span));
        }
        if word.is("LIFT_END") && !std::mem::take(&mut self.lifts) {
            return Err(Fault::new(Condition::LiftNotBegun, "LIFT_END without LIFT_START", span));
        }
        Ok(())
    }

    /// An M or H function of an axis or spindle: written to the log, with its duration included.
    pub(in crate::exec::block) fn call(
        &mut self,
        function: Function,
        value: Option<f64>,
        channel: &Channel,
        contour: &mut Contour,
    ) {
        self.takes_time(function, channel, contour);
        match function {
            Function::M(number) => contour.event(Event::MFunction { number, value }),
            Function::H(number) => contour.event(Event::HFunction { number, value }),
            Function::Tool | Function::Spindle { .. } | Function::Speed { .. } => {}
        }
    }
}

impl Decoder {
    pub(in crate::exec) fn bracket(&mut self, bracket: &Bracket, words: &Words<'_>) -> Outcome<()> {
        let name = bracket.name.as_str();
        if let Some(axis) = self.names.of_name(name) {
            return self.axis_bracket(axis, bracket, words);
        }
        if let Some(spindle) = self.motion.spindle_of_name(name, &self.machine.channel) {
            return self.spindle_bracket(spindle, bracket, words);
        }
        // `X100 [NAME]` looks like a bracket of an axis X100, unlike `S1[G135]`
        let is_function = |word: &str| {
            let number = word.strip_prefix(['G', 'M', 'H', 'g', 'm', 'h']);
            number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
        };
        if let ([Item { kind: ItemKind::Flag(word), .. }], true) =
            (&bracket.group.items[..], name.ends_with(|c: char| c.is_ascii_digit()))
            && !is_function(&word.text)
        {
            let text = "a label must be first in its block, not after other words";
            return Err(Fault::new(Condition::LabelBehindWords, text, bracket.group.span));
        }
        if name.strip_prefix(['S', 's']).is_some_and(|n| n.bytes().all(|b| b.is_ascii_digit())) {
            let text = format!("the channel has no spindle {name}");
            return Err(Fault::new(Condition::SpindleUnknown, text, bracket.group.span));
        }
        Err(self.names.unknown(name, bracket.group.span))
    }

    fn axis_bracket(&mut self, axis: usize, bracket: &Bracket, words: &Words<'_>) -> Outcome<()> {
        let group = &bracket.group;
        let functions: Vec<Option<(Function, Span)>> = group.items.iter().map(function).collect();
        if let Some(functions) = functions.into_iter().collect::<Option<Vec<_>>>()
            && !functions.is_empty()
        {
            once(&functions, bracket, words)?;
            for ((function, _), item) in functions.into_iter().zip(&group.items) {
                let value = value_of_function(self, item)?;
                self.motion.call(function, value, &self.machine.channel, &mut self.contour);
            }
            return Ok(());
        }
        if words.brackets_before(bracket).any(|other| excludes(&self.names, other, axis, bracket)) {
            return Err(self.names.twice(axis, group.span));
        }
        let Some((
            Item { kind: ItemKind::Flag(word) | ItemKind::Pair { key: word, .. }, span },
            rest,
        )) = group.items.split_first()
        else {
            let text = "an axis command is expected in the bracket";
            return Err(Fault::new(Condition::Syntax, text, group.span));
        };
        if matches!(group.items[0].kind, ItemKind::Flag(_))
            && let Some(outcome) = self.axis_command(axis, word, rest, group, words)
        {
            return outcome;
        }
        if OF_FUNCTIONS.iter().any(|other| word.is(other)) {
            let name = self.names.name(axis);
            let text = format!("{name}[{} ..]: its function must come first", word.text);
            return Err(Fault::new(Condition::AxisFunctionMissing, text, *span));
        }
        self.motion.lifting(word, *span)?;
        Err(no_function(self.names.name(axis), word, *span))
    }

    /// The command of an axis with this word; `None` if it is none.
    fn axis_command(
        &mut self,
        axis: usize,
        word: &Ident,
        rest: &[Item],
        group: &Group,
        words: &Words<'_>,
    ) -> Option<Outcome<()>> {
        let alone = no_word_of(&self.names, axis, words, group.span);
        if word.is("OVERRIDE") {
            let rest = Group { items: rest.to_vec(), span: group.span };
            let title = format!("{}[OVERRIDE]", self.names.name(axis));
            Some(self.set_overrides(Some(axis), Some(&rest), &title, group.span))
        } else if word.is("INDP_SYN") || word.is("INDP_ASYN") {
            let outputs = &self.machine.channel.functions.m_outputs;
            let fits = alone.and_then(|()| no_function_of(self.names.name(axis), outputs, words));
            Some(
                fits.and_then(|()| {
                    self.independent_axis(axis, word.is("INDP_SYN"), rest, group.span)
                }),
            )
        } else if word.is("OSC") || word.is("OSC_ON") {
            // OSC_ON: the spelling of the diagnosis manual, 120470
            let items = if word.is("OSC") { rest } else { &group.items[..] };
            Some(alone.and_then(|()| self.oscillating_axis(axis, items, group.span)))
        } else if word.is("DIST_CTRL") && switches_off(rest) {
            Some(Ok(()))
        } else if word.is("COMP") {
            Some(self.axis_compensation(axis, rest, group.span))
        } else if word.is("SET_POSITION") {
            Some(alone.and_then(|()| self.set_position(axis, rest, group.span)))
        } else {
            None
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
}

/// An axis that its bracket moves has no word in the block.
fn no_word_of(names: &AxisNames, axis: usize, words: &Words<'_>, at: Span) -> Outcome<()> {
    if words.axes.iter().any(|(moved, _, _)| *moved == axis) {
        return Err(names.twice(axis, at));
    }
    Ok(())
}

/// The M functions of the block must not be outputs of an axis that moves independently; `outputs`: axis names by number.
fn no_function_of(name: &str, outputs: &BTreeMap<u32, Box<str>>, words: &Words<'_>) -> Outcome<()> {
    let of_axis = words
        .m
        .iter()
        .find(|m| outputs.get(&m.number).is_some_and(|output| output.eq_ignore_ascii_case(name)));
    let Some(m) = of_axis else { return Ok(()) };
    let text =
        format!("M{} is assigned to {name} by the list, and {name} moves independently", m.number);
    Err(Fault::new(Condition::FunctionOfIndependent, text, m.span)
        .with(|d| d.parameter(of::M_OUTPUT)))
}

/// The error of a word that is not a function of an axis here.
fn no_function(name: &str, word: &Ident, at: Span) -> Box<Fault> {
    if spindle::is_internal(&word.text) {
        let text = format!("{} in the bracket of an axis", word.text);
        return Fault::new(Condition::InternalFunction, text, at);
    }
    let is_function =
        matches!(word.text.as_bytes(), [b'G' | b'g', ..] | [b'M' | b'm', b'C' | b'c', b'_', ..]);
    if !REFUSED.iter().any(|known| word.is(known)) && !is_function {
        let text = format!("{name}[{}]: not a function of an axis", word.text);
        return Fault::new(Condition::AxisFunctionMissing, text, at);
    }
    Fault::unsupported(format!("{name}[{}]", word.text), at)
}

/// The M or H function of the user that an item names: not one that ends programs or controls spindles.
fn function(item: &Item) -> Option<(Function, Span)> {
    let (ItemKind::Flag(word) | ItemKind::Pair { key: word, value: ItemValue::Expr(_) }) =
        &item.kind
    else {
        return None;
    };
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
    let before = words.brackets_before(bracket);
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

/// Another bracket of the same axis that moves it, or sets the same value.
fn excludes(names: &AxisNames, other: &Bracket, axis: usize, bracket: &Bracket) -> bool {
    const MOVES: [&str; 5] = ["INDP_SYN", "INDP_ASYN", "OSC", "OSC_ON", "SET_POSITION"];
    fn first(bracket: &Bracket) -> Option<&Ident> {
        match &bracket.group.items.first()?.kind {
            ItemKind::Flag(word) => Some(word),
            _ => None,
        }
    }
    let moves = |word: &Ident| MOVES.iter().any(|name| word.is(name));
    names.of_name(other.name.as_str()) == Some(axis)
        && match (first(other), first(bracket)) {
            (Some(a), Some(b)) => moves(a) && moves(b) || a.is(&b.text),
            _ => false,
        }
}

/// The value of `M54=567`.
///
/// Source: TF5200 programming manual, M and H functions with additional information (15556839051).
fn value_of_function(decoder: &Decoder, item: &Item) -> Outcome<Option<f64>> {
    match &item.kind {
        ItemKind::Pair { value: ItemValue::Expr(expr), .. } => decoder.number(expr).map(Some),
        _ => Ok(None),
    }
}
