//! Turns trees into text: the spelling used in messages, and in the check of the parser by parsing again.

use super::ast::{
    Binary, BinaryOp, Block, BlockNumber, Body, Call, CallKind, CodeNumber, Command, Control,
    ControlKind, Declaration, Expr, ExprKind, GValue, Group, Item, ItemKind, ItemValue, Jump,
    JumpKind, LabelKind, Name, ParameterIndex, Place, PlaceKind, Return, ReturnLevel, Sign, Word,
    WordKind,
};
use std::fmt::{Display, Formatter, Result};

impl Display for Block {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let mut gap = "";
        if let Some(level) = self.skip {
            write!(f, "/{level}")?;
            gap = " ";
        }
        if let Some(number) = &self.number {
            write!(f, "{gap}N")?;
            match number {
                BlockNumber::Literal(n) => write!(f, "{n}")?,
                BlockNumber::Computed(e) => write!(f, "[{e}]")?,
            }
            gap = " ";
        }
        match self.label.as_ref().map(|label| &label.kind) {
            Some(LabelKind::Number(_)) => f.write_str(":")?,
            Some(LabelKind::Name(name)) => {
                write!(f, "{gap}[{name}]")?;
                gap = " ";
            }
            None => {}
        }
        match &self.body {
            Body::Empty => Ok(()),
            Body::Words(words) => {
                for word in words {
                    write!(f, "{gap}{word}")?;
                    gap = " ";
                }
                Ok(())
            }
            Body::Command(command) => write!(f, "{gap}{command}"),
            Body::Control(control) => write!(f, "{gap}{control}"),
            Body::ProgramHead(head) => {
                write!(
                    f,
                    "{gap}%{}{}",
                    if head.local { "L " } else { "" },
                    spaced(head.local, &head.text)
                )
            }
            Body::Declarations(declarations) => {
                f.write_str(gap)?;
                list(f, declarations)
            }
        }
    }
}

/// `%L` would turn `% L x` into a local subroutine.
fn spaced(local: bool, text: &str) -> String {
    if local { text.to_owned() } else { format!(" {text}") }
}

/// Values separated by commas.
fn list<T: Display>(f: &mut Formatter<'_>, values: &[T]) -> Result {
    for (i, value) in values.iter().enumerate() {
        write!(f, "{}{value}", if i > 0 { ", " } else { "" })?;
    }
    Ok(())
}

/// A string with its quotes.
struct Quoted<'a>(&'a str);

impl Display for Quoted<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "\"{}\"", self.0.replace('"', "\\\""))
    }
}

/// A file name or identifier, with quotes if it needs them.
struct FileName<'a>(&'a str);

impl Display for FileName<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let bare = |b: u8| b.is_ascii_graphic() && !br#""[],#$=();{}`"#.contains(&b);
        if !self.0.is_empty() && self.0.bytes().all(bare) {
            f.write_str(self.0)
        } else {
            write!(f, "{}", Quoted(self.0))
        }
    }
}

impl Display for Name {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(self.as_str())
    }
}

impl Display for Jump {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.kind {
            JumpKind::Label(LabelKind::Number(n)) => write!(f, "N{n}"),
            JumpKind::Label(LabelKind::Name(name)) => write!(f, "[{name}]"),
            JumpKind::Number(expr) => match &expr.kind {
                ExprKind::Place(place) => write!(f, "N{place}"),
                _ => write!(f, "N[{expr}]"),
            },
            JumpKind::Name(place) => write!(f, "{place}"),
        }
    }
}

impl Display for Word {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.kind {
            WordKind::ComputedG(number) => write!(f, "G[{number}]"),
            WordKind::G { number, value } => {
                write!(f, "G{number}")?;
                match value.as_deref() {
                    None => Ok(()),
                    Some(GValue::Scalar(value)) => write!(f, "={value}"),
                    Some(GValue::List(slots)) => {
                        for (i, slot) in slots.iter().enumerate() {
                            f.write_str(if i > 0 { ", " } else { "[" })?;
                            if let Some(value) = slot {
                                write!(f, "{value}")?;
                            }
                        }
                        f.write_str("]")
                    }
                }
            }
            WordKind::M(number, value) => code(f, 'M', number, value.as_deref()),
            WordKind::Return(back) => write!(f, "{back}"),
            WordKind::H(number, value) => code(f, 'H', number, value.as_deref()),
            WordKind::Address { name, sign, value } => {
                // two signs cancel out, and only the first one is the direction
                let text = value.to_string();
                match (sign, text.starts_with('-')) {
                    (None, true) => write!(f, "{name}=[{text}]"),
                    (None, false) | (Some(Sign::Minus), true) => write!(f, "{name}={text}"),
                    (Some(Sign::Plus), _) => write!(f, "{name}=+{text}"),
                    (Some(Sign::Minus), false) => write!(f, "{name}=--{text}"),
                }
            }
            WordKind::Bracket(bracket) => write!(f, "{}{}", bracket.name, bracket.group),
            WordKind::Assign(assign) => {
                let operator = assign.operator.map_or("", BinaryOp::symbol);
                write!(f, "{}{operator}={}", assign.target, assign.value)
            }
            WordKind::MacroDefinition(m) => write!(f, "{}={}", Quoted(&m.name), Quoted(&m.text)),
            WordKind::MacroUse(name) => write!(f, "{}", Quoted(name)),
            WordKind::Hash(word) => {
                write!(f, "#{}", word.name)?;
                word.value.as_ref().map_or(Ok(()), |value| write!(f, "={value}"))
            }
            WordKind::Call(call) => write!(f, "{call}"),
            WordKind::Goto(target) => write!(f, "$GOTO {target}"),
        }
    }
}

fn code(f: &mut Formatter<'_>, letter: char, number: &CodeNumber, value: Option<&Expr>) -> Result {
    match number {
        CodeNumber::Literal(n) => write!(f, "{letter}{n}")?,
        CodeNumber::Computed(e) if matches!(e.kind, ExprKind::Place(_)) => {
            write!(f, "{letter}{e}")?;
        }
        CodeNumber::Computed(e) => write!(f, "{letter}[{e}]")?,
    }
    value.map_or(Ok(()), |value| write!(f, "={value}"))
}

impl Display for Return {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "M{} [", self.number)?;
        match &self.level {
            ReturnLevel::Caller => {}
            ReturnLevel::Main => f.write_str("MAIN ")?,
            ReturnLevel::Jumps(levels) => write!(f, "JUMPS={levels} ")?,
        }
        self.target.as_ref().map_or(Ok(()), |target| write!(f, "{target}"))?;
        f.write_str("]")
    }
}

impl Display for Call {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let letters = if self.local { "LL" } else { "L" };
        match &self.kind {
            CallKind::Program(name) => write!(f, "{letters} {}", FileName(&name.text)),
            CallKind::Variable(place) => write!(f, "{letters} {place}"),
            CallKind::Cycle(group) => write!(f, "{letters} CYCLE {group}"),
            CallKind::Sequence(group) => write!(f, "{letters} SEQUENCE {group}"),
        }
    }
}

impl Display for Command {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "#{}", self.name())?;
        if let Some(on) = self.on {
            f.write_str(if on { " ON" } else { " OFF" })?;
        }
        for word in &self.tail {
            write!(f, " {}", word.text)?;
        }
        for group in &self.groups {
            write!(f, " {group}")?;
        }
        if !self.arguments.is_empty() {
            f.write_str(" ")?;
            // a bracket would be read as a group
            if self.arguments.first().is_some_and(begins_with_bracket) {
                f.write_str("=")?;
            }
        }
        list(f, &self.arguments)
    }
}

impl Display for Group {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str("[")?;
        list(f, &self.items)?;
        let open = self.items.last().is_some_and(|item| item.kind == ItemKind::Missing);
        f.write_str(if open { ",]" } else { "]" })
    }
}

impl Display for Item {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.kind {
            ItemKind::Flag(flag) => f.write_str(&flag.text),
            ItemKind::Pair { key, value } => write!(f, "{}={value}", key.text),
            ItemKind::Target { place, value } => write!(f, "{place}={value}"),
            ItemKind::Value(value) => write!(f, "{value}"),
            ItemKind::Missing => Ok(()),
        }
    }
}

impl Display for ItemValue {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Expr(value) => write!(f, "{value}"),
            Self::Name(name) => write!(f, "{}", FileName(&name.text)),
            Self::List(group) => write!(f, "{group}"),
        }
    }
}

impl Display for Declaration {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{}", self.place)?;
        if let Some(name) = &self.type_name {
            write!(f, " : {}", name.text)?;
        }
        if let Some(length) = &self.length {
            write!(f, "[{length}]")?;
        }
        self.value.as_ref().map_or(Ok(()), |value| write!(f, " = {value}"))
    }
}

impl Display for Control {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.kind {
            ControlKind::If { condition, goto } => {
                write!(f, "$IF {condition}")?;
                goto.as_ref().map_or(Ok(()), |target| write!(f, " $GOTO {target}"))
            }
            ControlKind::ElseIf(condition) => write!(f, "$ELSEIF {condition}"),
            ControlKind::Else => f.write_str("$ELSE"),
            ControlKind::EndIf => f.write_str("$ENDIF"),
            ControlKind::Switch { target: Some(target), value } => {
                write!(f, "$SWITCH {target}={value}")
            }
            ControlKind::Switch { target: None, value } => write!(f, "$SWITCH {value}"),
            ControlKind::Case(value) => write!(f, "$CASE {value}"),
            ControlKind::Default => f.write_str("$DEFAULT"),
            ControlKind::EndSwitch => f.write_str("$ENDSWITCH"),
            ControlKind::For { counter, start, end, step } => {
                write!(f, "$FOR {counter} = {start}, {end}")?;
                step.as_ref().map_or(Ok(()), |step| write!(f, ", {step}"))
            }
            ControlKind::EndFor => f.write_str("$ENDFOR"),
            ControlKind::While(condition) => write!(f, "$WHILE {condition}"),
            ControlKind::EndWhile => f.write_str("$ENDWHILE"),
            ControlKind::Do => f.write_str("$DO"),
            ControlKind::EndDo(None) => f.write_str("$ENDDO"),
            ControlKind::EndDo(Some(condition)) => write!(f, "$ENDDO {condition}"),
            ControlKind::Repeat => f.write_str("$REPEAT"),
            ControlKind::Until(condition) => write!(f, "$UNTIL {condition}"),
            ControlKind::Break => f.write_str("$BREAK"),
            ControlKind::Continue => f.write_str("$CONTINUE"),
        }
    }
}

impl Display for Expr {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.kind {
            ExprKind::Number(v) => write!(f, "{v}"),
            ExprKind::Bool(true) => f.write_str("TRUE"),
            ExprKind::Bool(false) => f.write_str("FALSE"),
            ExprKind::Pi => f.write_str("PI"),
            ExprKind::Radius => f.write_str("R1"),
            ExprKind::Text(text) => write!(f, "{}", Quoted(text)),
            ExprKind::MFunction(number) => write!(f, "M{number}"),
            ExprKind::HFunction(number) => write!(f, "H{number}"),
            ExprKind::Place(place) => write!(f, "{place}"),
            ExprKind::Negate(inner) if matches!(inner.kind, ExprKind::Binary(_)) => {
                write!(f, "-[{inner}]")
            }
            ExprKind::Negate(inner) => write!(f, "-{inner}"),
            ExprKind::Binary(binary) => write!(f, "{binary}"),
            ExprKind::Call(call) => {
                write!(f, "{}[", call.function.name())?;
                list(f, &call.arguments)?;
                f.write_str("]")
            }
        }
    }
}

impl Display for Binary {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let level = self.op.precedence();
        let left = level + u8::from(self.op.is_comparison());
        operand(f, &self.left, left)?;
        write!(f, " {} ", self.op.symbol())?;
        operand(f, &self.right, level + 1)
    }
}

/// An operand, in brackets if its precedence is lower than `level`.
fn operand(f: &mut Formatter<'_>, expr: &Expr, level: u8) -> Result {
    match &expr.kind {
        ExprKind::Binary(inner) if inner.op.precedence() < level => write!(f, "[{expr}]"),
        _ => write!(f, "{expr}"),
    }
}

/// Whether the printed expression begins with a bracket.
fn begins_with_bracket(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Binary(binary) => match &binary.left.kind {
            ExprKind::Binary(left) => {
                left.op.precedence() < binary.op.precedence() || begins_with_bracket(&binary.left)
            }
            _ => false,
        },
        _ => false,
    }
}

impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.kind {
            PlaceKind::Parameter { indirections, index, subscripts } => {
                for _ in 0..=*indirections {
                    f.write_str("P")?;
                }
                match index {
                    ParameterIndex::Literal(n) => write!(f, "{n}")?,
                    ParameterIndex::Computed(e) => write!(f, "[{e}]")?,
                }
                subscripts.iter().try_for_each(|e| write!(f, "[{e}]"))
            }
            PlaceKind::Variable(segments) => {
                f.write_str("V")?;
                for segment in segments {
                    write!(f, ".{}", segment.name)?;
                    segment.subscripts.iter().try_for_each(|e| write!(f, "[{e}]"))?;
                }
                Ok(())
            }
            PlaceKind::Cycle(name) => write!(f, "@{name}"),
        }
    }
}
