//! Parse result of the grammar to the tree of a block.

use super::ast::{
    Assign, Block, BlockNumber, Body, Bracket, Call, CallKind, CodeNumber, Command, Control,
    ControlKind, Declaration, Expr, GValue, Group, HashWord, Ident, Item, ItemKind, ItemValue,
    Label, LabelKind, MacroDefinition, Name, Place, PlaceKind, ProgramHead, Sign, Span, Word,
    WordKind,
};
use super::grammar::Grammar;
use super::problem::{self, Context, Problem};
use super::{PROBLEMS_MAX, Rule};
use crate::diag::{Id, Severity};
use pest::Parser as _;
use pest::iterators::{Pair, Pairs};

/// Builds the tree of one block.
pub(super) struct Builder<'a> {
    /// Text as written.
    text: &'a str,
    /// Text as the grammar saw it, of the same length.
    masked: &'a str,
    problems: &'a mut Vec<Problem>,
    /// Binary operators so far.
    pub(super) operators: usize,
    /// Place of the last error of the grammar.
    reported: u32,
}

impl<'a> Builder<'a> {
    pub(super) fn new(text: &'a str, masked: &'a str, problems: &'a mut Vec<Problem>) -> Self {
        Self { text, masked, problems, operators: 0, reported: 0 }
    }

    pub(super) fn report(&mut self, problem: Problem) {
        if self.problems.len() < PROBLEMS_MAX {
            self.problems.push(problem);
        }
    }

    /// Reports what the grammar met with.
    pub(super) fn report_error(&mut self, problem: Problem) {
        let rest = self.masked.get(problem.span.start as usize..).unwrap_or_default();
        // Behind a misplaced command or control statement nothing is worth a second message.
        let last = rest.starts_with(['#', '$']);
        self.reported = if last { u32::MAX } else { problem.span.start };
        self.report(problem);
    }

    /// Place of a rule; the grammar's own spans may end in blanks.
    pub(super) fn span(&self, pair: &Pair<'_, Rule>) -> Span {
        let span = pair.as_span();
        let text = &self.masked[span.start()..span.end()];
        Span::new(span.start(), span.start() + text.trim_ascii_end().len())
    }

    /// Text of a rule as written.
    fn written(&self, span: Span) -> &'a str {
        self.text.get(span.start as usize..span.end() as usize).unwrap_or_default()
    }

    /// A block from one of the rules `block`, `var_line`, `inactive`, `tolerant`, `head_only`.
    pub(super) fn block(&mut self, pairs: Pairs<'_, Rule>) -> Block {
        let mut block = Block::default();
        let mut words = Vec::new();
        let mut declarations = Vec::new();
        let mut junk: Vec<(Span, bool)> = Vec::new();
        for pair in pairs.flat_map(Pair::into_inner) {
            let span = self.span(&pair);
            match pair.as_rule() {
                Rule::skip => block.skip = self.skip(&pair),
                Rule::number | Rule::number_label => self.number(pair, &mut block),
                Rule::label_name => block.label = Some(self.label(pair)),
                Rule::program_head => block.body = self.program_head(pair),
                Rule::command => {
                    let command = self.command(pair);
                    self.check_command(&command, &block);
                    block.body = Body::Command(Box::new(command));
                }
                Rule::control => block.body = self.control(pair, span),
                Rule::declaration => declarations.push(self.declaration(pair)),
                Rule::junk => {
                    let after_word = words.last().is_some_and(|word: &Word| {
                        junk.last().is_some_and(|(last, _)| last.start < word.span.start)
                    });
                    junk.push((span, after_word));
                }
                Rule::EOI | Rule::comma | Rule::rest => {}
                _ => words.push(self.word(pair, span)),
            }
        }
        // The first piece is the error that the grammar itself reported.
        for (span, after_word) in junk.into_iter().skip(1) {
            if span.start >= self.reported && (after_word || self.begins_word(span)) {
                self.explain_junk(span);
            }
        }
        if !words.is_empty() {
            block.body = Body::Words(words);
        }
        if !declarations.is_empty() {
            block.body = Body::Declarations(declarations);
        }
        let start = self.masked.len() - self.masked.trim_ascii_start().len();
        let end = self.masked.trim_ascii_end().len();
        block.span = Span::new(start.min(end), end);
        block
    }

    /// True if a piece of junk, not seen by the last error, looks like the beginning of a word.
    fn begins_word(&self, span: Span) -> bool {
        let at = span.start as usize;
        let bytes = self.masked.as_bytes();
        let blank_before = at > 0 && matches!(bytes[at - 1], b' ' | b'\t');
        // The error already names a longer word that stands where it was met.
        bytes[at].is_ascii_alphabetic()
            && blank_before
            && (span.start > self.reported || span.len == 1)
    }

    /// What is wrong with a later piece of a block with several errors.
    fn explain_junk(&mut self, span: Span) {
        let start = span.start as usize;
        if let Err(error) = Grammar::parse(Rule::words_only, &self.masked[start..]) {
            self.report_error(problem::from_error(&error, self.masked, Context::Words, start));
        }
    }

    fn skip(&mut self, pair: &Pair<'_, Rule>) -> Option<u8> {
        let digits = &pair.as_str()[1..];
        if digits.is_empty() {
            return Some(1);
        }
        let level = digits.parse().ok().filter(|level| (1..=10).contains(level));
        if level.is_none() {
            let span = self.span(pair);
            self.report(Problem::syntax(span, format!("skip level {digits}, expected 1 to 10")));
        }
        level
    }

    fn number(&mut self, pair: Pair<'_, Rule>, block: &mut Block) {
        let span = self.span(&pair);
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::index => {
                    block.number = Some(BlockNumber::Computed(Box::new(self.index(part))));
                }
                rule => {
                    let digits = part.as_str().trim_end_matches(':');
                    let value = digits.parse().unwrap_or_else(|_| {
                        self.report(Problem::syntax(span, "block number with too many digits"));
                        u64::MAX
                    });
                    block.number = Some(BlockNumber::Literal(value));
                    if rule == Rule::label_number {
                        block.label = Some(Label { kind: LabelKind::Number(value), span });
                    }
                }
            }
        }
    }

    /// `label_name`, or what stands in `target`.
    fn label(&mut self, pair: Pair<'_, Rule>) -> Label {
        let span = self.span(&pair);
        let kind = if pair.as_rule() == Rule::label_name {
            let text = pair.into_inner().as_str().trim_ascii().to_ascii_uppercase();
            LabelKind::Name(text.into())
        } else {
            let digits = pair.as_str().trim_end_matches(':');
            LabelKind::Number(digits.parse().unwrap_or(u64::MAX))
        };
        Label { kind, span }
    }

    fn target(&mut self, pair: Pair<'_, Rule>) -> Label {
        let span = self.span(&pair);
        match pair.into_inner().next() {
            Some(inner) => Label { span, ..self.label(inner) },
            None => Label { kind: LabelKind::Number(0), span },
        }
    }

    fn program_head(&mut self, pair: Pair<'_, Rule>) -> Body {
        let whole = self.span(&pair);
        let mut head = ProgramHead { local: false, name: None, text: "".into() };
        for part in pair.into_inner() {
            if part.as_rule() == Rule::local_mark {
                head.local = true;
                continue;
            }
            let span = part.as_span();
            let text = part.as_str();
            head.text = text.trim_ascii().into();
            if let Some(name) = text.split_ascii_whitespace().next() {
                let start = span.start() + text.len() - text.trim_ascii_start().len();
                head.name =
                    Some(Ident { text: name.into(), span: Span::new(start, start + name.len()) });
            }
        }
        if head.local && head.name.is_none() {
            let text = "%L without the name of a local subroutine";
            self.report(Problem::new(Id::Kontur(5), whole, text));
        }
        Body::ProgramHead(Box::new(head))
    }

    fn word(&mut self, pair: Pair<'_, Rule>, span: Span) -> Word {
        let rule = pair.as_rule();
        let kind = match rule {
            Rule::goto => {
                let target = pair.into_inner().next();
                let empty = Label { kind: LabelKind::Number(0), span };
                WordKind::Goto(Box::new(target.map_or(empty, |p| self.target(p))))
            }
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
        let mut name = None;
        let mut place = None;
        let mut number = 0;
        let mut code = CodeNumber::Literal(0);
        let mut value = None;
        let mut sign = None;
        let mut slots = Vec::new();
        let mut group = Group::default();
        for part in pair.into_inner() {
            let span = self.span(&part);
            match part.as_rule() {
                Rule::g_number | Rule::g_cycle_number => {
                    number = part.as_str()[1..].parse().unwrap_or(u32::MAX);
                }
                Rule::code_number => code = self.code_number(part),
                Rule::marked_name
                | Rule::bracket_name
                | Rule::equals_name
                | Rule::letter
                | Rule::name_letters
                | Rule::hash_name => name = Some(self.written(span)),
                Rule::place => place = Some(self.place(part)),
                Rule::expression | Rule::signed_number => {
                    sign = match part.as_str().as_bytes().first() {
                        Some(b'+') => Some(Sign::Plus),
                        Some(b'-') => Some(Sign::Minus),
                        _ => None,
                    };
                    value = Some(if part.as_rule() == Rule::expression {
                        self.expression(part)
                    } else {
                        self.signed_number(part)
                    });
                }
                Rule::slot => slots.push(part.into_inner().next().map(|p| self.expression(p))),
                Rule::group => group = self.group(part),
                _ => {}
            }
        }
        let address = || name.map_or(Name::Letter(b'?'), Name::new);
        match (rule, value) {
            (Rule::g_cycle, _) => {
                WordKind::G { number, value: Some(Box::new(GValue::List(slots))) }
            }
            (Rule::g_word, value) => {
                WordKind::G { number, value: value.map(|v| Box::new(GValue::Scalar(v))) }
            }
            (Rule::m_word, value) => WordKind::M(code, value.map(Box::new)),
            (Rule::h_word, value) => WordKind::H(code, value.map(Box::new)),
            (Rule::bracket_word, _) => {
                WordKind::Bracket(Box::new(Bracket { name: address(), group }))
            }
            (Rule::hash_word, value) => {
                let words: Vec<&str> = name
                    .unwrap_or_default()
                    .trim_start_matches('#')
                    .split_ascii_whitespace()
                    .collect();
                let name = words.join(" ").to_ascii_uppercase().into();
                WordKind::Hash(Box::new(HashWord { name, value }))
            }
            (_, value) => {
                let value = value.unwrap_or_else(Self::zero);
                match place {
                    Some(target) => WordKind::Assign(Box::new(Assign { target, value })),
                    None => WordKind::Address { name: address(), sign, value },
                }
            }
        }
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

    /// `string`: text between the quotes.
    pub(super) fn string(&mut self, pair: &Pair<'_, Rule>) -> Box<str> {
        let written = self.written(self.span(pair));
        let inner = written.get(1..written.len().saturating_sub(1)).unwrap_or_default();
        inner.replace("\\\"", "\"").into()
    }

    fn ident(&self, pair: &Pair<'_, Rule>) -> Ident {
        let span = self.span(pair);
        Ident { text: self.written(span).into(), span }
    }

    fn upper(&self, pair: &Pair<'_, Rule>) -> Ident {
        let ident = self.ident(pair);
        Ident { text: ident.text.to_ascii_uppercase().into(), ..ident }
    }

    fn call(&mut self, pair: Pair<'_, Rule>) -> Call {
        let mut local = false;
        let mut kind = None;
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::call_mark => local = part.as_str().len() > 1,
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

    /// A file name, with or without quotes.
    fn file(&mut self, pair: &Pair<'_, Rule>) -> Ident {
        match pair.as_rule() {
            Rule::string => Ident { text: self.string(pair), span: self.span(pair) },
            _ => self.ident(pair),
        }
    }

    /// `group` or `cycle_group`.
    fn group(&mut self, pair: Pair<'_, Rule>) -> Group {
        let span = self.span(&pair);
        let mut items: Vec<Item> = Vec::new();
        // True where an item would be missing if a comma came now.
        let mut bare = true;
        for part in pair.into_inner() {
            let place = self.span(&part);
            match part.as_rule() {
                Rule::comma => {
                    if bare {
                        items
                            .push(Item { kind: ItemKind::Missing, span: Span { len: 0, ..place } });
                    }
                    bare = true;
                }
                Rule::bar => {
                    let text =
                        "`|` between two keys belongs to the notation of manuals, it is ignored";
                    self.report(Problem::syntax(place, text).severity(Severity::Note));
                }
                Rule::item | Rule::name_item => {
                    items.push(Item { kind: self.item(part), span: place });
                    bare = false;
                }
                _ => {}
            }
        }
        Group { items, span }
    }

    fn item(&mut self, pair: Pair<'_, Rule>) -> ItemKind {
        let whole =
            if pair.as_rule() == Rule::name_item { Some(pair) } else { pair.into_inner().next() };
        let Some(whole) = whole else { return ItemKind::Missing };
        if whole.as_rule() == Rule::flag {
            return ItemKind::Flag(self.ident(&whole));
        }
        let mut key = None;
        let mut value = None;
        for part in whole.into_inner() {
            match part.as_rule() {
                Rule::key | Rule::cycle_key | Rule::name_key => key = Some(self.upper(&part)),
                Rule::equals => {}
                _ => value = Some(self.item_value(part)),
            }
        }
        match (key, value) {
            (Some(key), Some(value)) => ItemKind::Pair { key, value },
            (Some(key), None) => ItemKind::Flag(key),
            (None, Some(value)) => ItemKind::Value(value),
            (None, None) => ItemKind::Missing,
        }
    }

    fn item_value(&mut self, pair: Pair<'_, Rule>) -> ItemValue {
        match pair.as_rule() {
            Rule::expression => ItemValue::Expr(self.expression(pair)),
            Rule::group => ItemValue::List(self.group(pair)),
            Rule::value => match pair.into_inner().next() {
                Some(inner) => self.item_value(inner),
                None => ItemValue::Expr(Self::zero()),
            },
            _ => ItemValue::Name(self.file(&pair)),
        }
    }

    fn command(&mut self, pair: Pair<'_, Rule>) -> Command {
        let span = self.span(&pair);
        let (words, tail, arguments, groups) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut command = Command { words, on: None, tail, arguments, groups, span };
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::command_word => {
                    let word = self.upper(&part);
                    match (&*word.text, command.on) {
                        ("ON", None) if !command.words.is_empty() => command.on = Some(true),
                        ("OFF", None) if !command.words.is_empty() => command.on = Some(false),
                        (_, None) => command.words.push(word),
                        (_, Some(_)) => command.tail.push(word),
                    }
                }
                Rule::group => command.groups.push(self.group(part)),
                Rule::arguments => {
                    for argument in part.into_inner() {
                        if argument.as_rule() == Rule::expression {
                            command.arguments.push(self.expression(argument));
                        }
                    }
                }
                _ => {}
            }
        }
        command
    }

    /// Rules of shape for single commands.
    fn check_command(&mut self, command: &Command, block: &Block) {
        let words: Vec<&str> = command.words.iter().map(|word| &*word.text).collect();
        let bare =
            command.arguments.is_empty() && command.groups.is_empty() && command.tail.is_empty();
        match words.as_slice() {
            ["COMMENT", "BEGIN", rest @ ..] if !rest.is_empty() || !bare => {
                let text = "#COMMENT BEGIN does not stand alone in its block";
                self.report(Problem::vendor(20566, command.span, text));
            }
            ["COMMENT", "END", rest @ ..] if !rest.is_empty() || !bare => {
                let text = "#COMMENT END does not stand alone in its block";
                self.report(Problem::vendor(20569, command.span, text));
            }
            ["IF" | "ELSE" | "ENDIF", ..] if block.number.is_some() || block.label.is_some() => {
                let text = format!("#{} behind a block number", words.join(" "));
                let hint = "only a skip mark may stand before it";
                self.report(Problem::vendor(20593, command.span, text).hint(hint));
            }
            _ => {}
        }
    }

    fn declaration(&mut self, pair: Pair<'_, Rule>) -> Declaration {
        let span = self.span(&pair);
        let place = Place { kind: PlaceKind::Variable(Vec::new()), span };
        let mut declaration =
            Declaration { place, type_name: None, length: None, value: None, span };
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::place => declaration.place = self.place(part),
                Rule::type_name => declaration.type_name = Some(self.upper(&part)),
                Rule::index => declaration.length = Some(self.index(part)),
                Rule::value => declaration.value = Some(self.item_value(part)),
                _ => {}
            }
        }
        declaration
    }

    fn control(&mut self, pair: Pair<'_, Rule>, span: Span) -> Body {
        let Some(inner) = pair.into_inner().next() else { return Body::Empty };
        let rule = inner.as_rule();
        let mut values = Vec::new();
        let mut place = None;
        let mut goto = None;
        for part in inner.into_inner() {
            match part.as_rule() {
                Rule::expression => values.push(self.expression(part)),
                Rule::place => place = Some(self.place(part)),
                Rule::target => goto = Some(self.target(part)),
                Rule::bad_counter => {
                    let at = self.span(&part);
                    let text = format!("`{}` cannot count a $FOR loop", part.as_str());
                    let hint = "the counter is a P parameter or a variable that may be written";
                    self.report(Problem::vendor(20227, at, text).hint(hint));
                    // the executor says the same of this place, once is enough
                    place = Some(Place { kind: PlaceKind::Variable(Vec::new()), span: at });
                }
                _ => {}
            }
        }
        let mut values = values.into_iter();
        let mut value = || values.next().unwrap_or_else(Self::zero);
        let kind = match rule {
            Rule::c_if => ControlKind::If { condition: value(), goto },
            Rule::c_elseif => ControlKind::ElseIf(value()),
            Rule::c_else => ControlKind::Else,
            Rule::c_endif => ControlKind::EndIf,
            Rule::c_switch => ControlKind::Switch { target: place, value: value() },
            Rule::c_case => ControlKind::Case(value()),
            Rule::c_default => ControlKind::Default,
            Rule::c_endswitch => ControlKind::EndSwitch,
            Rule::c_for => {
                let counter =
                    place.unwrap_or(Place { kind: PlaceKind::Variable(Vec::new()), span });
                ControlKind::For { counter, start: value(), end: value(), step: values.next() }
            }
            Rule::c_endfor => ControlKind::EndFor,
            Rule::c_while => ControlKind::While(value()),
            Rule::c_endwhile => ControlKind::EndWhile,
            Rule::c_do => ControlKind::Do,
            Rule::c_enddo => ControlKind::EndDo(values.next()),
            Rule::c_repeat => ControlKind::Repeat,
            Rule::c_until => ControlKind::Until(value()),
            Rule::c_break => ControlKind::Break,
            _ => ControlKind::Continue,
        };
        Body::Control(Box::new(Control { kind, span }))
    }
}

impl From<Place> for super::ast::ExprKind {
    fn from(place: Place) -> Self {
        Self::Place(Box::new(place))
    }
}
