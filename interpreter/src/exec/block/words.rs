//! One block of DIN words: collecting them with their values, left to right.
//!
//! Assignments act while the words are collected, so that a value sees the assignments written before it. Everything
//! else acts afterwards, in the order that [`super::din`] keeps.

use super::groups::{self, Act, Group, Row, ValueRule};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::suggest;
use crate::exec::values::system;
use crate::syntax::ast::{
    Assign, Bracket, Call, CodeNumber, Expr, ExprKind, GValue, HashWord, Label, Name, PlaceKind,
    Sign, Span, Word, WordKind,
};
use smallvec::SmallVec;

/// Number and place of a value.
pub(in crate::exec) type Placed = (f64, Span);

/// A G function of the block.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct GWord {
    pub(in crate::exec) row: &'static Row,
    pub(in crate::exec) value: Option<f64>,
    pub(in crate::exec) span: Span,
}

/// An M or H function of the block.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct Code {
    pub(in crate::exec) number: u32,
    pub(in crate::exec) value: Option<f64>,
    pub(in crate::exec) span: Span,
}

/// An implicit subroutine call.
#[derive(Clone, Debug)]
pub(in crate::exec) struct CycleCall {
    pub(in crate::exec) number: u32,
    /// Values in written order; `None` for an empty place.
    pub(in crate::exec) values: Vec<Option<Value>>,
    pub(in crate::exec) span: Span,
}

/// The words of one block.
#[derive(Debug, Default)]
pub(in crate::exec) struct Words<'b> {
    pub(in crate::exec) g: SmallVec<[GWord; 6]>,
    /// Axis, value as written, place.
    pub(in crate::exec) axes: SmallVec<[(usize, f64, Span); 8]>,
    /// First sign of the words of modulo axes: the direction of rotation; or the place of a sum whose first sign may
    /// also belong to its first term.
    pub(in crate::exec) turns: SmallVec<[(usize, Result<Sign, Span>); 1]>,
    /// G90 and G91 that act from their place on (P-CHAN-00116): number of axis words before, and whether absolute.
    pub(in crate::exec) dimensions: SmallVec<[(usize, bool); 2]>,
    /// I, J, K.
    pub(in crate::exec) centre: [Option<Placed>; 3],
    pub(in crate::exec) radius: Option<Placed>,
    pub(in crate::exec) feed: Option<Placed>,
    pub(in crate::exec) end_feed: Option<Placed>,
    /// Spindle and speed.
    pub(in crate::exec) speeds: SmallVec<[(usize, f64, Span); 1]>,
    /// Spindle and angle of M19 (`S.POS=180`).
    pub(in crate::exec) angles: SmallVec<[(usize, f64, Span); 1]>,
    /// Spindle and angle at which a thread begins (`S.OFFSET=90`).
    pub(in crate::exec) offsets: SmallVec<[(usize, f64, Span); 1]>,
    pub(in crate::exec) tool: Option<Placed>,
    pub(in crate::exec) tool_data: Option<Placed>,
    /// A write to `V.G.WZ_AKT`.
    pub(in crate::exec) tool_written: Option<Span>,
    pub(in crate::exec) m: SmallVec<[Code; 4]>,
    pub(in crate::exec) h: SmallVec<[Code; 1]>,
    pub(in crate::exec) cycle: Option<CycleCall>,
    pub(in crate::exec) brackets: SmallVec<[&'b Bracket; 1]>,
    pub(in crate::exec) hashes: SmallVec<[(&'b HashWord, Option<f64>, Span); 1]>,
    pub(in crate::exec) call: Option<(&'b Call, Span)>,
    pub(in crate::exec) goto: Option<&'b Label>,
}

impl Words<'_> {
    /// True if the axis word in place `i` is absolute; `modal` is the dimension that the block leaves behind.
    pub(in crate::exec) fn is_absolute(&self, i: usize, modal: bool) -> bool {
        let last = self.dimensions.iter().rfind(|(place, _)| *place <= i);
        last.map_or(modal, |(_, absolute)| *absolute)
    }

    /// The G function of a group.
    pub(in crate::exec) fn group(&self, group: Group) -> Option<&GWord> {
        self.g.iter().find(|g| g.row.group == group)
    }
}

/// Letters I, J, K.
fn centre_index(letter: u8) -> Option<usize> {
    (b'I'..=b'K').contains(&letter).then(|| usize::from(letter - b'I'))
}

impl Decoder {
    /// Collects the words of a block and carries out its assignments. What cannot be used is reported and left out.
    pub(in crate::exec) fn collect<'b>(&mut self, words: &'b [Word], block: &mut Words<'b>) {
        for word in words {
            if let Err(fault) = self.collect_word(word, block) {
                self.note(fault);
                if block.call.is_some() {
                    break;
                }
            }
        }
        if let (Some(_), Some(span)) = (block.tool_data, block.tool_written) {
            let text = "D and a write to V.G.WZ_AKT in one block: both set the tool data in use";
            self.note(Fault::new(Condition::ToolTwice, text, span));
        }
    }

    fn collect_word<'b>(&mut self, word: &'b Word, block: &mut Words<'b>) -> Outcome<()> {
        let span = word.span;
        if block.call.is_some() && !matches!(word.kind, WordKind::Call(_)) {
            let text = "nothing stands behind a subroutine or cycle call in its block";
            return Err(Fault::new(Condition::BehindCall, text, span));
        }
        match &word.kind {
            WordKind::Address { name, sign, value } => {
                self.address(name, *sign, value, span, block)
            }
            WordKind::G { number, value } => self.g_word(*number, value.as_deref(), span, block),
            WordKind::M(number, value) => {
                let code = self.code(number, value.as_deref(), "M", span)?;
                once(&block.m, &code, "M", Condition::MTwice)?;
                block.m.push(code);
                Ok(())
            }
            WordKind::H(number, value) => {
                let code = self.code(number, value.as_deref(), "H", span)?;
                once(&block.h, &code, "H", Condition::HTwice)?;
                block.h.push(code);
                Ok(())
            }
            WordKind::Bracket(bracket) => {
                block.brackets.push(bracket);
                Ok(())
            }
            WordKind::Assign(assign) => {
                if let PlaceKind::Cycle(name) = &assign.target.kind
                    && !name.starts_with('P')
                {
                    return self.cycle_address(name, assign, span, block);
                }
                if let PlaceKind::Variable(segments) = &assign.target.kind
                    && system::is_active_tool(segments)
                {
                    block.tool_written = Some(span);
                }
                self.assign(assign)
            }
            WordKind::MacroDefinition(definition) => {
                self.calls.macros.insert(definition.name.clone(), definition.text.clone());
                Ok(())
            }
            WordKind::MacroUse(name) => {
                let text = format!("macro \"{name}\" is not defined");
                let known = self.calls.macros.keys().map(|k| &**k);
                let fault = Fault::new(Condition::Undefined, text, span);
                Err(match suggest::hint(name, known) {
                    Some(hint) => fault.hint(hint),
                    None => fault,
                })
            }
            WordKind::Hash(hash) => {
                let value = match &hash.value {
                    Some(expr) => Some(self.number(expr)?),
                    None => None,
                };
                block.hashes.push((hash, value, span));
                Ok(())
            }
            WordKind::Call(call) => {
                if block.call.replace((call, span)).is_some() {
                    let text = "two subroutine calls in one block";
                    return Err(Fault::new(Condition::SeveralCalls, text, span));
                }
                Ok(())
            }
            WordKind::Goto(label) => {
                block.goto = Some(label);
                Ok(())
            }
        }
    }

    /// `@X=..`, `@I=..`, `@S=..`: words of cycles for the main axes, the centre and the main spindle, whatever their
    /// names in the channel are.
    ///
    /// Source: TF5200 programming manual, cycles (a cycle does not depend on the plane and the names of axes); diagnosis
    /// 21383 to 21385. Assumption: so `@X` and `@Y` are the first and second axis of the active plane, `@Z` stands on it.
    fn cycle_address(
        &mut self,
        name: &str,
        assign: &Assign,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        let condition = match name {
            "X" | "Y" | "Z" => Condition::CycleAxisOutside,
            "I" | "J" | "K" => Condition::CycleCentreOutside,
            "S" => Condition::CycleSpindleOutside,
            _ => {
                let text = format!("@{name} is no word of a cycle");
                let hint = "cycles have @P1 to @P200, @X, @Y, @Z, @I, @J, @K and @S";
                return Err(Fault::new(Condition::Syntax, text, assign.target.span).hint(hint));
            }
        };
        if !self.values.variables.is_cycle() {
            let text = format!("@{name} stands outside of a cycle");
            return Err(Fault::new(condition, text, assign.target.span));
        }
        let letter = name.as_bytes().first().copied().unwrap_or_default();
        match letter {
            b'S' => {
                let value = self.number(&assign.value)?;
                spindle_word(block, 0, value, span)
            }
            b'X'..=b'Z' => {
                let main = self.modal.plane.main_axes()[usize::from(letter - b'X')];
                let Some(axis) = self.geometry.coordinates.main_axis(main) else {
                    let text = format!("@{name}: the channel has no main axis of that place");
                    return Err(Fault::new(Condition::AxisOrCommandExpected, text, span)
                        .hint(self.axis_hint()));
                };
                self.axis_word(axis, None, &assign.value, span, block)
            }
            _ => {
                let main = self.modal.plane.main_axes()[usize::from(letter.saturating_sub(b'I'))];
                let letter = [b'I', b'J', b'K'][main];
                self.address(&Name::Letter(letter), None, &assign.value, span, block)
            }
        }
    }

    fn assign(&mut self, assign: &Assign) -> Outcome<()> {
        let value = self.value(&assign.value)?;
        self.write(&assign.target, value, assign.value.span)
    }

    fn code(
        &mut self,
        number: &CodeNumber,
        value: Option<&Expr>,
        letter: &str,
        span: Span,
    ) -> Outcome<Code> {
        /// Highest number of M and H functions.
        const HIGHEST: u32 = 65535;
        let number = match number {
            CodeNumber::Literal(n) if *n <= HIGHEST => *n,
            CodeNumber::Literal(_) => {
                let text = format!("the number of the {letter} function is above {HIGHEST}");
                return Err(Fault::new(Condition::Range, text, span));
            }
            CodeNumber::Computed(expr) => {
                self.whole(expr, "the number of a function", 0, HIGHEST)?
            }
        };
        let value = match value {
            Some(expr) => Some(self.number(expr)?),
            None => None,
        };
        Ok(Code { number, value, span })
    }

    fn g_word(
        &mut self,
        number: u32,
        value: Option<&GValue>,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        if groups::is_cycle_call(number) {
            return self.cycle_word(number, value, span, block);
        }
        if number > groups::NUMBER_MAX {
            let text = format!("the number of the G function is above {}", groups::NUMBER_MAX);
            return Err(Fault::new(Condition::GNumberTooLarge, text, span).with(|d| {
                // more digits than a number of the tree holds
                let known = number < u32::MAX;
                let d = if known { d.value(ValueKind::Wrong, number, "-") } else { d };
                d.value(ValueKind::UpperLimit, groups::NUMBER_MAX, "-")
            }));
        }
        let Some(row) = groups::row(number) else {
            let fault =
                Fault::new(Condition::GUnknown, format!("unknown G function G{number:02}"), span)
                    .with(|d| d.value(ValueKind::Current, number, "-"));
            return Err(match super::dialect::unknown_g(number) {
                Some(hint) => fault.hint(hint),
                None => fault,
            });
        };
        if self.machine.channel.several_dimensions
            && let Act::Absolute(absolute) = row.act
        {
            if block.dimensions.is_empty() {
                block.dimensions.push((0, self.modal.absolute));
            }
            block.dimensions.push((block.axes.len(), absolute));
        } else if row.group != Group::None
            && let Some(first) = block.group(row.group)
        {
            return Err(duplicate(first.row, row, span));
        }
        if let Act::Unsupported(what) = row.act {
            // it takes its axis words and the place of its group all the same
            block.g.push(GWord { row, value: None, span });
            return Err(Fault::unsupported(format!("G{number:02} ({what})"), span));
        }
        let value = match (value, row.value) {
            (None, ValueRule::Required) => {
                let text = format!("G{number} needs a value");
                return Err(Fault::new(Condition::Syntax, text, span));
            }
            (Some(GValue::Scalar(expr)), ValueRule::Required | ValueRule::Optional) => {
                Some(self.number(expr)?)
            }
            (Some(GValue::Scalar(expr)), ValueRule::Never) => {
                let text = format!("G{number:02} takes no value");
                return Err(Fault::new(Condition::Syntax, text, expr.span));
            }
            (Some(GValue::List(_)), _) => {
                let text = format!("G{number:02} takes no list");
                return Err(Fault::new(Condition::Syntax, text, span));
            }
            (None, _) => None,
        };
        block.g.push(GWord { row, value, span });
        Ok(())
    }

    fn cycle_word(
        &mut self,
        number: u32,
        value: Option<&GValue>,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        if !self.calls.cycle_files.contains_key(&number) {
            let text = format!("G{number}: no subroutine is configured");
            let hint = "P-CHAN-00160 to 00169 or #FILE NAME [G80=\"file\"] configure one";
            let fault = Fault::new(Condition::GUnknown, text, span)
                .with(|d| d.value(ValueKind::Current, number, "-"));
            return Err(fault.hint(hint));
        }
        let mut values = Vec::new();
        match value {
            None => {}
            Some(GValue::Scalar(expr)) => values.push(Some(self.value(expr)?)),
            Some(GValue::List(list)) => {
                for entry in list {
                    values.push(match entry {
                        Some(expr) => Some(self.value(expr)?),
                        None => None,
                    });
                }
            }
        }
        if values.len() > 50 {
            let text = format!("{} values, a call takes up to 50", values.len());
            return Err(Fault::new(Condition::Range, text, span));
        }
        if block.cycle.replace(CycleCall { number, values, span }).is_some() {
            return Err(Fault::new(
                Condition::SeveralCalls,
                "two implicit calls in one block",
                span,
            ));
        }
        Ok(())
    }

    fn address(
        &mut self,
        name: &Name,
        sign: Option<Sign>,
        value: &Expr,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        let axis = match name {
            Name::Letter(letter) => self.axis_of_letter(*letter),
            Name::Long(name) => self.axis_of_name(name),
        };
        if let Some(axis) = axis {
            return self.axis_word(axis, sign, value, span, block);
        }
        if let Some(spindle) = self.spindle_of_name(name.as_str()) {
            let value = self.number(value)?;
            return spindle_word(block, spindle, value, span);
        }
        if let Some((spindle, what)) = name.as_str().split_once('.') {
            return self.spindle_angle(spindle, what, value, span, block);
        }
        // R1 is the only index of the radius
        let radius = name.as_str().eq_ignore_ascii_case("R1").then_some(b'R');
        let Some(letter) = name.letter().or(radius) else {
            return Err(self.unknown_name(name.as_str(), span));
        };
        let slot = match letter {
            b'F' => &mut block.feed,
            b'R' => &mut block.radius,
            b'E' => &mut block.end_feed,
            b'T' => &mut block.tool,
            b'D' => &mut block.tool_data,
            b'I'..=b'K' => match centre_index(letter) {
                Some(i) => &mut block.centre[i],
                None => return Ok(()),
            },
            _ => return Err(self.unknown_letter(letter, span)),
        };
        let twice = slot.is_some();
        *slot = Some((self.number(value)?, span));
        if twice {
            let text = format!("{} twice in one block", name.as_str());
            return Err(match letter {
                b'F' => Fault::new(Condition::FeedTwice, text, span),
                b'I'..=b'K' => Fault::new(Condition::CentreTwice, text, span),
                b'D' => Fault::new(Condition::ToolDataTwice, text, span),
                _ => Fault::new(Condition::Syntax, text, span),
            });
        }
        Ok(())
    }

    /// `S.POS=180`, `S.OFFSET=90`.
    fn spindle_angle(
        &self,
        name: &str,
        what: &str,
        value: &Expr,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        let Some(spindle) = self.spindle_of_name(name) else {
            let text = format!("{name}.{what}: the channel has no spindle {name}");
            return Err(Fault::new(Condition::AxisOrCommandExpected, text, span));
        };
        let angle = self.number(value)?;
        let (angles, condition) = if what == "POS" {
            (&mut block.angles, Condition::SpindleTwice)
        } else {
            (&mut block.offsets, Condition::ThreadOffsetTwice)
        };
        if angles.iter().any(|(other, _, _)| *other == spindle) {
            return Err(Fault::new(condition, format!("{name}.{what} twice in one block"), span));
        }
        angles.push((spindle, angle, span));
        Ok(())
    }

    /// The value of an axis of the channel.
    fn axis_word(
        &mut self,
        axis: usize,
        sign: Option<Sign>,
        value: &Expr,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        if let Some(sign) = sign
            && self.machine.axes[axis].is_modulo()
        {
            let sum = matches!(value.kind, ExprKind::Binary(_));
            block.turns.push((axis, if sum { Err(value.span) } else { Ok(sign) }));
        }
        let value = self.number(value)?;
        if block.axes.iter().any(|(a, _, _)| *a == axis) {
            return Err(self.axis_twice(axis, span));
        }
        block.axes.push((axis, value, span));
        Ok(())
    }

    /// An axis that one block moves twice.
    pub(in crate::exec) fn axis_twice(&self, axis: usize, span: Span) -> Box<Fault> {
        let number = self.machine.axes[axis].number();
        let name = self.axis_name(axis).to_owned();
        let text = format!("axis {name} twice in one block");
        Fault::new(Condition::AxisTwice, text, span)
            .with(|d| d.axis(number, name).value(ValueKind::AxisNumber, number, "-"))
    }

    fn unknown_letter(&self, letter: u8, span: Span) -> Box<Fault> {
        let name = char::from(letter);
        match letter {
            b'O' => Fault::new(
                Condition::ONotImplemented,
                "the O word does not exist in this dialect",
                span,
            )
            .hint("a program begins with %NAME, a subroutine is called by L or LL"),
            b'S' => Fault::unsupported("S: the machine has no spindle of that name", span),
            b'A'..=b'C' | b'U'..=b'Z' | b'Q' => self.unknown_axis(&name.to_string(), span),
            _ => Fault::new(
                Condition::AxisOrCommandExpected,
                format!("{name} is no word of this dialect"),
                span,
            )
            .hint(super::dialect::letter(letter)),
        }
    }

    fn unknown_name(&self, name: &str, span: Span) -> Box<Fault> {
        match name.as_bytes().first() {
            Some(b'R' | b'r') if name[1..].bytes().all(|b| b.is_ascii_digit()) => {
                let text = format!("the radius has the index 1 only, not {}", &name[1..]);
                Fault::new(Condition::RadiusIndex, text, span)
            }
            Some(b'R' | b'r') => {
                Fault::new(Condition::RadiusName, format!("unknown radius name {name}"), span)
                    .hint("write R=..")
            }
            _ => self.unknown_axis(name, span),
        }
    }

    pub(in crate::exec) fn unknown_axis(&self, name: &str, span: Span) -> Box<Fault> {
        let text = format!("the channel has no axis {name}");
        Fault::new(Condition::AxisOrCommandExpected, text, span).hint(self.axis_hint())
    }
}

/// The speed of a spindle, once in a block.
fn spindle_word(block: &mut Words<'_>, spindle: usize, rpm: f64, span: Span) -> Outcome<()> {
    if block.speeds.iter().any(|(other, _, _)| *other == spindle) {
        let text = "the speed of a spindle twice in one block";
        return Err(Fault::new(Condition::SpindleTwice, text, span));
    }
    block.speeds.push((spindle, rpm, span));
    Ok(())
}

/// A function stands once in a block.
fn once(written: &[Code], code: &Code, letter: &str, condition: Condition) -> Outcome<()> {
    if !written.iter().any(|other| other.number == code.number) {
        return Ok(());
    }
    let text = format!("{letter}{} twice in one block", code.number);
    Err(Fault::new(condition, text, code.span)
        .with(|d| d.value(ValueKind::Current, code.number, "-")))
}

fn duplicate(first: &Row, second: &Row, span: Span) -> Box<Fault> {
    let text = format!(
        "G{:02} and G{:02} in one block: both set {}",
        first.number,
        second.number,
        second.group.name()
    );
    Fault::new(second.group.duplicate(), text, span)
        .with(|d| d.value(ValueKind::Wrong, second.number, "-"))
}
