//! Commands with their groups, declarations and control statements.

use super::Builder;
use crate::diag::{Condition, Severity};
use crate::syntax::ast::{
    Block, Body, Command, Control, ControlKind, Declaration, Expr, Group, Item, ItemKind,
    ItemValue, Place, PlaceKind, Span,
};
use crate::syntax::grammar::Rule;
use crate::syntax::problem::Problem;
use pest::iterators::Pair;

impl Builder<'_> {
    /// `group` or `cycle_group`.
    pub(super) fn group(&mut self, pair: Pair<'_, Rule>) -> Group {
        self.contents(pair).0
    }

    /// `chain`: an expression, or a list if only one bracket is written.
    fn chain(&mut self, pair: Pair<'_, Rule>) -> ItemValue {
        let mut parts = pair.clone().into_inner();
        match (parts.next(), parts.next()) {
            (Some(only), None) if only.as_rule() == Rule::group => {
                self.bracket(only).map_or_else(ItemValue::List, ItemValue::Expr)
            }
            _ => ItemValue::Expr(self.expression(pair)),
        }
    }

    /// A bracket as an expression if it contains only one, otherwise as a list.
    pub(in crate::syntax) fn bracket(&mut self, pair: Pair<'_, Rule>) -> Result<Expr, Group> {
        let (mut group, separated) = self.contents(pair);
        if separated || group.items.len() != 1 {
            return Err(group);
        }
        match group.items.pop() {
            Some(Item { kind: ItemKind::Value(ItemValue::Expr(inner)), .. }) => {
                Ok(Expr { span: group.span, ..inner })
            }
            other => {
                group.items.extend(other);
                Err(group)
            }
        }
    }

    /// Groups of a command; 20186, 20675, 20876, 20880, 21252 if commas between their items are required but missing.
    fn command_group(&mut self, pair: Pair<'_, Rule>, command: &Command) -> Group {
        let of = |names: &[&str]| names.iter().any(|name| command.is(name));
        let needs = if of(&["GET CMDPOS", "GET ACTPOS", "SET IPO SOLLPOS"]) {
            Some((Condition::PositionRequest, "two positions"))
        } else if of(&["CS", "CS DEF", "CS ADD", "CS SET", "ACS", "ACS DEF"]) {
            Some((Condition::CoordinateSystemSyntax, "two values of a coordinate system"))
        } else if of(&["CALL AX", "SET AX"]) {
            Some((Condition::ExchangeNumber, "axis number and axis index"))
        } else if of(&["CAX"]) {
            Some((Condition::SpindleAxisComma, "spindle and axis"))
        } else if of(&["FACE", "CYL"]) {
            Some((Condition::BehindCommandAxis, "two axes"))
        } else {
            None
        };
        let of_system = of(&["CS", "CS DEF", "CS ADD", "CS SET"]);
        let commas = pair.clone().into_inner().filter(|p| p.as_rule() == Rule::comma).count();
        let mut group = self.group(pair);
        let inside =
            self.masked[..group.span.end() as usize].trim_end_matches(']').trim_ascii_end();
        if of(&["MSG"]) && inside.ends_with(',') {
            let span = Span { start: group.span.end() - 1, len: 0 };
            group.items.push(Item { kind: ItemKind::Missing, span });
        }
        if of_system {
            self.subtracted(group.span);
        }
        // `[X 1 0]` looks like a key with its value: 21251, when the command is carried out
        let keyed = matches!(group.items.first(), Some(Item { kind: ItemKind::Pair { .. }, .. }));
        // keys with values are separated by blanks
        let with_keys =
            matches!(needs, Some((Condition::ExchangeNumber | Condition::BehindCommandAxis, _)));
        let needs = needs.filter(|_| commas + 1 < group.items.len() && !(with_keys && keyed));
        if let Some((condition, what)) = needs {
            let text = format!("a comma is missing between {what}");
            self.report(Problem::new(condition, group.span, text));
        }
        group
    }

    /// Contents of a bracket, and whether commas or bars separate them.
    fn contents(&mut self, pair: Pair<'_, Rule>) -> (Group, bool) {
        let span = self.span(&pair);
        let mut separated = false;
        let mut items: Vec<Item> = Vec::new();
        // true where an item would be missing if a comma followed
        let mut bare = true;
        for part in pair.into_inner() {
            let place = self.span(&part);
            separated |= matches!(part.as_rule(), Rule::comma | Rule::bar);
            match part.as_rule() {
                Rule::comma => {
                    if bare {
                        items
                            .push(Item { kind: ItemKind::Missing, span: Span { len: 0, ..place } });
                    }
                    bare = true;
                }
                Rule::bar => {
                    let text = "`|` between two keys is notation of the manuals and is ignored";
                    self.report(Problem::syntax(place, text).severity(Severity::Note));
                }
                Rule::item | Rule::name_item => {
                    items.push(Item { kind: self.item(part), span: place });
                    bare = false;
                }
                _ => {}
            }
        }
        (Group { items, span }, separated)
    }

    fn item(&mut self, pair: Pair<'_, Rule>) -> ItemKind {
        let whole =
            if pair.as_rule() == Rule::name_item { Some(pair) } else { pair.into_inner().next() };
        let Some(whole) = whole else { return ItemKind::Missing };
        if matches!(whole.as_rule(), Rule::flag | Rule::directed) {
            return ItemKind::Flag(self.ident(&whole));
        }
        let mut key = None;
        let mut value = None;
        let mut target = None;
        for part in whole.into_inner() {
            match part.as_rule() {
                Rule::place => target = Some(self.place(part)),
                Rule::key
                | Rule::cycle_key
                | Rule::parameter_key
                | Rule::ordinal
                | Rule::number_key
                | Rule::name_key => {
                    key = Some(self.upper(&part));
                }
                Rule::equals => {}
                _ => value = Some(self.item_value(part)),
            }
        }
        if let (Some(place), Some(value)) = (target, &value) {
            return ItemKind::Target { place, value: value.clone() };
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
            Rule::chain => self.chain(pair),
            Rule::value => match pair.into_inner().next() {
                Some(inner) => self.item_value(inner),
                None => ItemValue::Expr(Self::zero()),
            },
            _ => ItemValue::Name(self.file(&pair)),
        }
    }

    pub(super) fn command(&mut self, pair: Pair<'_, Rule>) -> Command {
        let span = self.span(&pair);
        let (words, tail, arguments, groups) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut command =
            Command { words, on: None, tail, arguments, groups, behind: Vec::new(), span };
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
                Rule::group => {
                    let group = self.command_group(part, &command);
                    command.groups.push(group);
                }
                Rule::late_axis => {
                    let axis = self.upper(&part);
                    command.tail.push(axis);
                }
                Rule::late_switch => {
                    let of_vector = ["VECTORVEL", "VECTORACC"].iter().any(|name| command.is(name));
                    if of_vector && command.on.is_none() {
                        command.on = Some(part.as_str().eq_ignore_ascii_case("ON"));
                    } else {
                        let text = format!("{} after the bracket", part.as_str());
                        self.report(Problem::syntax(self.span(&part), text));
                    }
                }
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

    /// Checks of form for individual commands.
    pub(super) fn check_command(&mut self, command: &Command, block: &Block) {
        let words: Vec<&str> = command.words.iter().map(|word| &*word.text).collect();
        let bare =
            command.arguments.is_empty() && command.groups.is_empty() && command.tail.is_empty();
        match words.as_slice() {
            ["COMMENT", "BEGIN", rest @ ..] if !rest.is_empty() || !bare => {
                let text = "#COMMENT BEGIN is not alone in its block";
                self.report(Problem::new(Condition::CommentBeginNotAlone, command.span, text));
            }
            ["COMMENT", "END", rest @ ..] if !rest.is_empty() || !bare => {
                let text = "#COMMENT END is not alone in its block";
                self.report(Problem::new(Condition::CommentEndNotAlone, command.span, text));
            }
            ["IF" | "ELSE" | "ENDIF", ..] if block.number.is_some() || block.label.is_some() => {
                let text = format!("#{} after a block number", words.join(" "));
                let hint = "only a skip character may precede it";
                self.report(
                    Problem::new(Condition::ConditionalNotFirst, command.span, text).hint(hint),
                );
            }
            _ if bare => self.check_remark(command),
            _ => {}
        }
    }

    /// Warns of `#VIB GUARD ON (MODE=2 FREQ=40)`: the keys are in a remark.
    fn check_remark(&mut self, command: &Command) {
        let end = command.span.end() as usize;
        let Some(behind) = self.text.get(end..) else { return };
        let Some(remark) = behind.trim_ascii_start().strip_prefix('(') else { return };
        let remark = remark.trim_ascii_start();
        let key = remark.bytes().take_while(|b| b.is_ascii_alphanumeric() || *b == b'_').count();
        let is_key = remark.starts_with(|c: char| c.is_ascii_alphabetic());
        let keys = remark.split(')').next().unwrap_or_default();
        let has_value = |word: &str| {
            let name = word.split('=').next().unwrap_or_default();
            word.contains('=')
                && !name.is_empty()
                && name.bytes().all(|b| b.is_ascii_uppercase() || b == b'_')
        };
        // `(MODE=2)`, `(DEV PATH_DEV=0.1)`
        let after_flag = remark[..key].bytes().all(|b| b.is_ascii_uppercase())
            && keys.split_ascii_whitespace().nth(1).is_some_and(has_value);
        if is_key && (remark[key..].trim_ascii_start().starts_with('=') || after_flag) {
            let start = end + behind.len() - behind.trim_ascii_start().len();
            let text = "a remark that looks like keys: it has no effect";
            let problem = Problem::new(Condition::Odd, Span::new(start, start + 1), text)
                .severity(Severity::Warning)
                .hint("write keys of a command in square brackets");
            self.report(problem);
        }
    }

    pub(super) fn declaration(&mut self, pair: Pair<'_, Rule>) -> Declaration {
        let span = self.span(&pair);
        let place = Place { kind: PlaceKind::Variable(Vec::new()), span };
        let mut declaration =
            Declaration { place, type_name: None, length: None, value: None, span };
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::place => declaration.place = self.place(part),
                Rule::type_name => declaration.type_name = Some(self.upper(&part)),
                Rule::index => declaration.length = Some(self.index(part)),
                Rule::value => {
                    let list = self.span(&part);
                    declaration.value = Some(self.item_value(part));
                    // the bracket of a single value is one around an expression
                    let is_array = self.written(declaration.place.span).contains('[');
                    if is_array && self.written(list).starts_with('[') {
                        self.subtracted(list);
                    }
                }
                _ => {}
            }
        }
        if let Some(ItemValue::List(group)) = &declaration.value {
            self.separated_values(group);
        }
        declaration
    }

    /// 20904 where no comma separates two values of an array.
    fn separated_values(&mut self, group: &Group) {
        let joined = group.items.windows(2).find_map(|pair| {
            let (end, start) = (pair[0].span.end(), pair[1].span.start);
            (!self.masked.get(end as usize..start as usize)?.contains(',')).then_some(pair[1].span)
        });
        if let Some(at) = joined {
            let text = "a comma is missing between two values of an array";
            self.report(Problem::new(Condition::DeclarationCharacter, at, text));
        }
    }

    /// K-0109 for `[10 -2]`: a sign with a blank before it and none behind it, as before the next value of a list.
    fn subtracted(&mut self, list: Span) {
        let start = list.start as usize;
        let text = self.masked.get(start..list.end() as usize).unwrap_or_default();
        let is_value =
            |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b']' | b'_');
        let bytes = text.as_bytes();
        let found = (1..bytes.len().saturating_sub(1)).find(|i| {
            let before = text[..*i].trim_ascii_end().bytes().next_back();
            matches!(bytes[*i], b'+' | b'-')
                && matches!(bytes[i - 1], b' ' | b'\t')
                && is_value(bytes[i + 1])
                && before.is_some_and(is_value)
        });
        if let Some(at) = found {
            let text = "two values are added or subtracted here: a comma may be missing";
            let at = Span::new(start + at, start + at + 1);
            let hint = "write [10, -2] for two values, [10 - 2] for one";
            let problem = Problem::new(Condition::Odd, at, text).severity(Severity::Warning);
            self.report(problem.hint(hint));
        }
    }

    pub(super) fn control(&mut self, pair: Pair<'_, Rule>, span: Span) -> Body {
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
                    let hint = "use a P parameter or a writable variable as the counter";
                    self.report(Problem::new(Condition::ForCounter, at, text).hint(hint));
                    // the executor reports this place as well; once is enough
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
