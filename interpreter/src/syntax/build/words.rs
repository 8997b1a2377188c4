//! Words of a block: addresses with values, code numbers, calls and file names.

use super::Builder;
use crate::syntax::Problem;
use crate::syntax::ast::{
    Assign, BinaryOp, Bracket, Call, CallKind, CodeNumber, Expr, GValue, Group, HashWord, Ident,
    Jump, JumpKind, LabelKind, MacroDefinition, Name, Place, Return, ReturnLevel, Sign, Span, Word,
    WordKind,
};
use crate::syntax::grammar::Rule;
use pest::iterators::Pair;

/// What a word may consist of.
struct Parts<'t> {
    name: Option<&'t str>,
    place: Option<Place>,
    number: u32,
    code: CodeNumber,
    computed: Option<Expr>,
    value: Option<Expr>,
    /// First sign of the value.
    sign: Option<Sign>,
    operator: Option<BinaryOp>,
    /// Values of a list; `None`: left out.
    slots: Vec<Option<Expr>>,
    group: Option<Group>,
}

impl Default for Parts<'_> {
    fn default() -> Self {
        Self {
            name: None,
            place: None,
            number: 0,
            code: CodeNumber::Literal(0),
            computed: None,
            value: None,
            sign: None,
            operator: None,
            slots: Vec::new(),
            group: None,
        }
    }
}

impl<'a> Builder<'a> {
    pub(super) fn word(&mut self, pair: Pair<'_, Rule>, span: Span) -> Word {
        let rule = pair.as_rule();
        let kind = match rule {
            Rule::goto => {
                let target = pair.into_inner().next();
                let empty = Jump { kind: JumpKind::Label(LabelKind::Number(0)), span };
                WordKind::Goto(Box::new(target.map_or(empty, |p| self.target(p))))
            }
            Rule::return_word => WordKind::Return(Box::new(self.return_word(pair))),
            Rule::call => WordKind::Call(Box::new(self.call(pair))),
            Rule::macro_definition => {
                let mut texts = pair.into_inner().filter(|p| p.as_rule() == Rule::string);
                let mut text = || texts.next().map(|p| self.string(&p)).unwrap_or_default();
                let (name, text) = (text(), text());
                WordKind::MacroDefinition(Box::new(MacroDefinition { name, text }))
            }
            Rule::macro_use => {
                let name = pair.into_inner().next().map(|p| self.string(&p));
                WordKind::MacroUse(name.unwrap_or_default())
            }
            _ => self.valued_word(pair, rule),
        };
        Word { kind, span }
    }

    /// Words that consist of an address and at most one value.
    fn valued_word(&mut self, pair: Pair<'_, Rule>, rule: Rule) -> WordKind {
        let parts = self.parts(pair);
        let address = || parts.name.map_or(Name::Letter(b'?'), Name::new);
        let value = parts.value;
        match rule {
            Rule::g_cycle => WordKind::G {
                number: parts.number,
                value: Some(Box::new(GValue::List(parts.slots))),
            },
            Rule::g_word => WordKind::G {
                number: parts.number,
                value: value.map(|v| Box::new(GValue::Scalar(v))),
            },
            Rule::g_computed => {
                WordKind::ComputedG(Box::new(parts.computed.unwrap_or_else(Self::zero)))
            }
            Rule::m_word => WordKind::M(parts.code, value.map(Box::new)),
            Rule::h_word => WordKind::H(parts.code, value.map(Box::new)),
            Rule::bracket_word => WordKind::Bracket(Box::new(Bracket {
                name: address(),
                group: parts.group.unwrap_or_default(),
            })),
            Rule::hash_word => self.hash_word(parts.name.unwrap_or_default(), value, parts.group),
            _ => {
                let value = value.unwrap_or_else(Self::zero);
                match parts.place {
                    Some(target) => WordKind::Assign(Box::new(Assign {
                        target,
                        operator: parts.operator,
                        value,
                    })),
                    None => WordKind::Address { name: address(), sign: parts.sign, value },
                }
            }
        }
    }

    fn parts(&mut self, pair: Pair<'_, Rule>) -> Parts<'a> {
        let mut parts = Parts::default();
        for part in pair.into_inner() {
            let span = self.span(&part);
            match part.as_rule() {
                Rule::g_number | Rule::g_cycle_number => {
                    parts.number = part.as_str()[1..].parse().unwrap_or(u32::MAX);
                }
                Rule::code_number => parts.code = self.code_number(part),
                Rule::index => parts.computed = Some(self.index(part)),
                Rule::parameter | Rule::variable => {
                    let place = Place { kind: self.place_kind(part), span };
                    parts.computed = Some(Expr { kind: place.into(), span });
                }
                Rule::marked_name
                | Rule::bracket_name
                | Rule::equals_name
                | Rule::position_name
                | Rule::letter
                | Rule::name_letters => parts.name = Some(self.written(span)),
                // a remark may stand between the words
                Rule::bracket_hash | Rule::hash_name => {
                    parts.name = self.masked.get(span.start as usize..span.end() as usize);
                }
                Rule::place => parts.place = Some(self.place(part)),
                Rule::compound => {
                    parts.operator = Some(BinaryOp::from_text(&part.as_str()[..1]));
                }
                rule @ (Rule::expression | Rule::signed_number) => {
                    parts.sign = match part.as_str().as_bytes().first() {
                        Some(b'+') => Some(Sign::Plus),
                        Some(b'-') => Some(Sign::Minus),
                        _ => None,
                    };
                    parts.value = Some(if rule == Rule::expression {
                        self.expression(part)
                    } else {
                        self.signed_number(part)
                    });
                }
                Rule::slot => {
                    parts.slots.push(part.into_inner().next().map(|p| self.expression(p)));
                }
                Rule::group => parts.group = Some(self.group(part)),
                _ => {}
            }
        }
        parts
    }

    /// A word that begins with `#`; without `=` before its value it is reported.
    fn hash_word(&mut self, name: &str, value: Option<Expr>, bracket: Option<Group>) -> WordKind {
        let words: Vec<&str> = name.trim_start_matches('#').split_ascii_whitespace().collect();
        let name: Box<str> = words.join(" ").to_ascii_uppercase().into();
        if let Some(value) = &value {
            let (before, size) = self.masked.split_at(value.span.start as usize);
            if before.ends_with(|c: char| c.is_ascii_alphabetic()) {
                let size = &size[..value.span.len as usize];
                let text = format!("#{name} without `=` before its value");
                let hint = format!("write #{name}={size}");
                self.report(Problem::syntax(value.span, text).hint(hint));
            }
        }
        WordKind::Hash(Box::new(HashWord { name, value, bracket }))
    }

    fn code_number(&mut self, pair: Pair<'_, Rule>) -> CodeNumber {
        let span = self.span(&pair);
        let Some(inner) = pair.into_inner().next() else { return CodeNumber::Literal(0) };
        match inner.as_rule() {
            Rule::code_digits => CodeNumber::Literal(inner.as_str().parse().unwrap_or(u32::MAX)),
            Rule::index => CodeNumber::Computed(Box::new(self.index(inner))),
            _ => {
                let place = Place { kind: self.place_kind(inner), span };
                CodeNumber::Computed(Box::new(Expr { kind: place.into(), span }))
            }
        }
    }

    fn return_word(&mut self, pair: Pair<'_, Rule>) -> Return {
        let mut word = Return { number: 17, level: ReturnLevel::Caller, target: None };
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::return_mark if part.as_str().ends_with("29") => word.number = 29,
                Rule::return_main => word.level = ReturnLevel::Main,
                Rule::return_jumps => {
                    let levels = part.into_inner().find(|p| p.as_rule() == Rule::expression);
                    word.level =
                        levels.map_or(word.level, |p| ReturnLevel::Jumps(self.expression(p)));
                }
                Rule::target => word.target = Some(self.target(part)),
                _ => {}
            }
        }
        word
    }

    fn call(&mut self, pair: Pair<'_, Rule>) -> Call {
        let mut local = false;
        let mut kind = None;
        let text = pair.as_str();
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::call_mark | Rule::joined_mark => {
                    local = part.as_str().len() > 1;
                    if local && text[part.as_str().len()..].starts_with('"') {
                        let problem =
                            Problem::syntax(self.span(&part), "LL without a blank after it");
                        self.report(problem.hint(
                            "write a blank between LL and the name of a subroutine or macro",
                        ));
                    }
                }
                Rule::variable_call => kind = self.variable_call(part),
                Rule::joined_variable => {
                    let call = part.into_inner().find(|p| p.as_rule() == Rule::variable_call);
                    kind = call.and_then(|p| self.variable_call(p));
                }
                Rule::cycle_call => {
                    kind = part.into_inner().next().map(|p| CallKind::Cycle(self.group(p)));
                }
                Rule::sequence_call => {
                    kind = part.into_inner().next().map(|p| CallKind::Sequence(self.group(p)));
                }
                Rule::digits_call => {
                    for inner in part.into_inner() {
                        match inner.as_rule() {
                            Rule::digits_mark => local = inner.as_str().len() > 1,
                            _ => kind = Some(CallKind::Program(self.ident(&inner))),
                        }
                    }
                }
                _ => kind = part.into_inner().next().map(|p| CallKind::Program(self.file(&p))),
            }
        }
        let empty = Ident { text: "".into(), span: Span::default() };
        Call { local, kind: kind.unwrap_or(CallKind::Program(empty)) }
    }

    /// A subroutine whose name is in a variable.
    fn variable_call(&mut self, pair: Pair<'_, Rule>) -> Option<CallKind> {
        pair.into_inner().next().map(|place| CallKind::Variable(self.place(place)))
    }

    /// A file name, with or without quotes.
    pub(super) fn file(&mut self, pair: &Pair<'_, Rule>) -> Ident {
        match pair.as_rule() {
            Rule::string => Ident { text: self.string(pair), span: self.span(pair) },
            _ => self.ident(pair),
        }
    }
}
