//! Addresses of a block: axes, spindles, centre, feed rate, radius, tools, and all others.

use super::collected::Words;
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::names::AxisNames;
use crate::exec::values::number::{as_number, whole};
use crate::syntax::ast::{
    Assign, BinaryOp, Expr, ExprKind, Name, ParameterIndex, Place, PlaceKind, Sign, Span,
};

/// Letters I, J, K.
fn centre_index(letter: u8) -> Option<usize> {
    (b'I'..=b'K').contains(&letter).then(|| usize::from(letter - b'I'))
}

/// A note where the value of an address is a comparison.
fn truth_value(name: &Name, value: &Expr) -> Option<Box<Fault>> {
    let ExprKind::Binary(binary) = &value.kind else { return None };
    // in brackets it is meant
    let bare = binary.left.span.start == value.span.start;
    (bare && binary.op <= BinaryOp::GreaterEqual).then(|| {
        let text = format!("the value of {} is a truth value here, 1 or 0", name.as_str());
        let hint = "a second `=`, a comparison, AND and OR make one; write the number alone";
        Fault::new(Condition::Dialect, text, value.span).hint(hint)
    })
}

impl Decoder {
    pub(super) fn address(
        &mut self,
        name: &Name,
        sign: Option<Sign>,
        value: &Expr,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        if let Some(fault) = truth_value(name, value) {
            self.report.note(fault);
        }
        let axis = match name {
            Name::Letter(letter) => self.names.of_letter(*letter),
            Name::Long(name) => self.names.of_name(name),
        };
        if let Some(axis) = axis {
            return self.axis_word(axis, sign, value, span, block);
        }
        if let Some(spindle) = self.motion.spindle_of_name(name.as_str(), &self.machine.channel) {
            let value = self.number(value)?;
            return spindle_word(block, spindle, value, span);
        }
        if let Some((spindle, what)) = name.as_str().split_once('.') {
            return self.spindle_angle(spindle, what, value, span, block);
        }
        // the index 1 (R1) is the only valid one of the radius
        let written = name.as_str().eq_ignore_ascii_case("R1");
        let radius =
            (written || is_radius_of_parameter(self, name.as_str(), span)?).then_some(b'R');
        let Some(letter) = name.letter().or(radius) else {
            return Err(unknown_name(&self.names, name.as_str(), value, span));
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
            b'O' => return Err(o_word(self.number(value)?, span)),
            _ => return Err(unknown_letter(&self.names, letter, span)),
        };
        let twice = slot.is_some();
        *slot = Some((self.number(value)?, span));
        if twice {
            let text = format!("{} twice in one block", name.as_str());
            return Err(match letter {
                b'F' => Fault::new(Condition::FeedTwice, text, span),
                b'I'..=b'K' => Fault::new(Condition::CentreTwice, text, span),
                b'D' => Fault::new(Condition::ToolDataTwice, text, span),
                _ => Fault::new(Condition::Syntax, text, span).hint("remove one of the two"),
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
        let Some(spindle) = self.motion.spindle_of_name(name, &self.machine.channel) else {
            let text = format!("{name}.{what}: the channel has no spindle {name}");
            return Err(Fault::new(Condition::AxisOrCommandExpected, text, span));
        };
        let angle = self.number(value)?;
        let (angles, condition) = if what == "POS" {
            (&mut block.angles, Condition::SpindlePositionTwice)
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
            // in a sum in brackets the last term ends before the bracket
            let sum = match &value.kind {
                ExprKind::Binary(binary) => binary.right.span.end() == value.span.end(),
                _ => false,
            };
            block.turns.push((axis, if sum { Err(value.span) } else { Ok(sign) }));
        } else if sign.is_some_and(|sign| has_another_sign(sign, value)) {
            let text = format!("{} has several signs", self.names.name(axis));
            let hint = "write a single sign: X--5 is X5, X+-5 is X-5";
            self.report.note(Fault::new(Condition::Odd, text, span).hint(hint));
        }
        let value = self.number(value)?;
        // a direction of a modulo axis applies to a single word
        let several =
            self.machine.channel.language.several_words && !self.machine.axes[axis].is_modulo();
        if !several && block.axes.iter().any(|(a, _, _)| *a == axis) {
            return Err(self.names.twice(axis, span));
        }
        block.axes.push((axis, value, span));
        Ok(())
    }

    /// `@X=..`, `@I=..`, `@S=..`: words of cycles for the main axes, the centre and the main spindle, regardless of their names
    /// in the channel.
    ///
    /// Source: TF5200 programming manual, cycles (a cycle does not depend on the plane and the names of axes); diagnosis
    /// 21383 to 21385. Assumption: `@X` and `@Y` are the first and second axis of the active plane, `@Z` is perpendicular to
    /// it.
    pub(super) fn cycle_address(
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
                let text = format!("@{name} is not a word of a cycle");
                let hint = "use @P1 to @P200, @X, @Y, @Z, @I, @J, @K or @S";
                return Err(Fault::new(Condition::Syntax, text, assign.target.span).hint(hint));
            }
        };
        if !self.values.variables.is_cycle() {
            let text = format!("@{name} is used outside a cycle");
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
                    let text = format!("@{name}: the channel has no such main axis");
                    return Err(Fault::new(Condition::AxisOrCommandExpected, text, span)
                        .hint(self.names.hint()));
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
}

/// The speed of a spindle, only once in a block.
fn spindle_word(block: &mut Words<'_>, spindle: usize, rpm: f64, span: Span) -> Outcome<()> {
    if block.speeds.iter().any(|(other, _, _)| *other == spindle) {
        let text = "spindle speed twice in one block";
        return Err(Fault::new(Condition::SpindleTwice, text, span));
    }
    block.speeds.push((spindle, rpm, span));
    Ok(())
}

/// O words are not supported: 20192, or 20191 for a number outside SGN32.
fn o_word(value: f64, span: Span) -> Box<Fault> {
    let condition = if (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value) {
        Condition::ONotImplemented
    } else {
        Condition::OFormat
    };
    let text = "the O word does not exist in this dialect: it numbers programs of Fanuc controls";
    Fault::new(condition, text, span).with(|d| d.value(ValueKind::Wrong, value, "-"))
}

fn unknown_letter(names: &AxisNames, letter: u8, span: Span) -> Box<Fault> {
    let name = char::from(letter);
    match letter {
        b'S' => Fault::unsupported("S: the machine has no spindle of that name", span),
        b'A'..=b'C' | b'U'..=b'Z' | b'Q' => names.unknown(&name.to_string(), span),
        _ => Fault::new(
            Condition::AxisOrCommandExpected,
            format!("{name} is not a word of this dialect"),
            span,
        )
        .hint(super::dialect::letter(letter)),
    }
}

fn unknown_name(names: &AxisNames, name: &str, value: &Expr, span: Span) -> Box<Fault> {
    if let Some(fault) = super::dialect::sinumerik(name, value, span) {
        return fault;
    }
    match name.as_bytes().first() {
        Some(b'R' | b'r') if name[1..].bytes().all(|b| b.is_ascii_digit()) => {
            let text = format!("the radius only has the index 1, not {}", &name[1..]);
            Fault::new(Condition::RadiusIndex, text, span)
        }
        Some(b'R' | b'r') => {
            Fault::new(Condition::RadiusName, format!("unknown radius name {name}"), span)
                .hint("write R=..")
        }
        // names of spindles begin with S, those of axes must not (20524)
        Some(b'S' | b's') => {
            let text = format!("the channel has no spindle {name}");
            Fault::new(Condition::SpindleUnknown, text, span)
        }
        _ => {
            let fault = names.unknown(name, span);
            match name.as_bytes() {
                [axis, b'O'] if names.of_letter(*axis).is_some() => {
                    fault.hint("check whether the letter O was written for the digit 0")
                }
                [axis, b'L'] if names.of_letter(*axis).is_some() => {
                    fault.hint("check whether the letter l was written for the digit 1")
                }
                _ => fault,
            }
        }
    }
}

/// Whether it is `RP2` with P2 = 1, the only valid index of the radius.
fn is_radius_of_parameter(decoder: &Decoder, name: &str, span: Span) -> Outcome<bool> {
    let digits = name.strip_prefix(['R', 'r']).and_then(|rest| rest.strip_prefix(['P', 'p']));
    let Some(index) = digits.and_then(|digits| digits.parse().ok()) else { return Ok(false) };
    let index = ParameterIndex::Literal(index);
    let kind = PlaceKind::Parameter { indirections: 0, index, subscripts: Vec::new() };
    let index = as_number(&decoder.read(&Place { kind, span })?, span)?;
    if whole(index, 1, 1).is_none() {
        let text = format!("the radius only has the index 1, not {index}");
        return Err(Fault::new(Condition::RadiusIndex, text, span));
    }
    Ok(true)
}

/// Whether a value of which `sign` is the first character has a sign after it.
fn has_another_sign(sign: Sign, value: &Expr) -> bool {
    let negative = match &value.kind {
        ExprKind::Number(x) => x.is_sign_negative(),
        ExprKind::Negate(_) => true,
        // the signs belong to the first term of a sum
        ExprKind::Binary(_) => return false,
        _ => false,
    };
    negative != (sign == Sign::Minus)
}
