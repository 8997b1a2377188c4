//! What a block reads of the machine: motion must come to rest before it.

use crate::exec::step::Sync;
use crate::exec::values::system;
use crate::exec::values::variables::external;
use crate::syntax::ast::{
    Block, BlockNumber, Body, CallKind, CodeNumber, Command, Control, ControlKind, Expr, ExprKind,
    Function, GValue, Group, ItemKind, ItemValue, Jump, JumpKind, ParameterIndex, Place, PlaceKind,
    ReturnLevel, Span, Word, WordKind,
};
use smallvec::{SmallVec, smallvec};

/// What a block reads before it is executed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::exec) struct Reads {
    /// The event for which the block waits before it reads actual positions of the machine; `None` if it reads none.
    pub(super) actual: Option<Sync>,
    /// The first external variable that it reads synchronously.
    pub(super) external: Option<Span>,
}

impl Reads {
    /// What a block reads, apart from a jump that depends on a condition.
    pub(super) fn of(block: &Block, asynchronous: &external::Names) -> Self {
        let mut walk = Walk { asynchronous, reads: Self::default() };
        walk.block(block);
        walk.reads
    }

    /// What the target of a jump reads.
    pub(super) fn of_jump(jump: &Jump, asynchronous: &external::Names) -> Self {
        let mut walk = Walk { asynchronous, reads: Self::default() };
        walk.jump(jump);
        walk.reads
    }

    /// What a place reads.
    pub(super) fn of_place(place: &Place, asynchronous: &external::Names) -> Self {
        let mut walk = Walk { asynchronous, reads: Self::default() };
        walk.place(place);
        walk.reads
    }
}

struct Walk<'a> {
    asynchronous: &'a external::Names,
    reads: Reads,
}

impl Walk<'_> {
    fn block(&mut self, block: &Block) {
        if let Some(BlockNumber::Computed(number)) = &block.number {
            self.expr(number);
        }
        match &block.body {
            Body::Empty | Body::ProgramHead(_) => {}
            Body::Declarations(list) => {
                for value in list.iter().filter_map(|d| d.value.as_ref()) {
                    self.item(value);
                }
            }
            Body::Words(words) => {
                for word in words {
                    self.word(word);
                }
            }
            Body::Command(command) => self.command(command),
            Body::Control(control) => self.control(control),
        }
    }

    fn word(&mut self, word: &Word) {
        match &word.kind {
            WordKind::G { value: Some(value), .. } => match &**value {
                GValue::Scalar(e) => self.expr(e),
                GValue::List(list) => {
                    for e in list.iter().flatten() {
                        self.expr(e);
                    }
                }
            },
            WordKind::Address { value, .. } => self.expr(value),
            WordKind::ComputedG(number) => self.expr(number),
            WordKind::Assign(assign) => {
                self.expr(&assign.value);
                match assign.operator {
                    Some(_) => self.place(&assign.target),
                    None => self.subscripts(&assign.target),
                }
            }
            WordKind::M(number, value) | WordKind::H(number, value) => {
                if let CodeNumber::Computed(number) = number {
                    self.expr(number);
                }
                if let Some(value) = value {
                    self.expr(value);
                }
            }
            WordKind::Return(back) => {
                if let ReturnLevel::Jumps(levels) = &back.level {
                    self.expr(levels);
                }
                if let Some(target) = &back.target {
                    self.jump(target);
                }
            }
            WordKind::Bracket(bracket) => self.group(&bracket.group),
            WordKind::Hash(hash) => {
                if let Some(value) = &hash.value {
                    self.expr(value);
                }
                if let Some(bracket) = &hash.bracket {
                    self.group(bracket);
                }
            }
            WordKind::Call(call) => match &call.kind {
                CallKind::Cycle(group) | CallKind::Sequence(group) => self.group(group),
                CallKind::Variable(place) => self.place(place),
                CallKind::Program(_) => {}
            },
            WordKind::Goto(jump) => self.jump(jump),
            WordKind::G { value: None, .. }
            | WordKind::MacroDefinition(_)
            | WordKind::MacroUse(_) => {}
        }
    }

    fn command(&mut self, command: &Command) {
        let before = self.reads.external;
        if command.is("CHANNEL INIT") && command.groups.iter().any(|g| g.has("ACTPOS")) {
            self.reads.actual = Some(Sync::TakeActual);
        } else if command.is("GET ACTPOS") {
            self.reads.actual = Some(Sync::ReadActual);
        }
        for e in &command.arguments {
            self.expr(e);
        }
        for group in &command.groups {
            self.group(group);
        }
        // decoding waits until the value changes, without a stop of the path (207058059)
        if command.is("WAIT FOR") {
            self.reads.external = before;
        }
    }

    /// The clauses after `$IF` and `$SWITCH` are read when they are reached, and so is the target of `$IF .. $GOTO`.
    fn control(&mut self, control: &Control) {
        match &control.kind {
            ControlKind::If { condition: e, .. }
            | ControlKind::ElseIf(e)
            | ControlKind::Case(e)
            | ControlKind::While(e)
            | ControlKind::EndDo(Some(e))
            | ControlKind::Until(e) => self.expr(e),
            ControlKind::Switch { target, value } => {
                self.expr(value);
                if let Some(target) = target {
                    self.subscripts(target);
                }
            }
            ControlKind::For { start, end, step, .. } => {
                self.expr(start);
                self.expr(end);
                if let Some(step) = step {
                    self.expr(step);
                }
            }
            ControlKind::Else
            | ControlKind::EndIf
            | ControlKind::Default
            | ControlKind::EndSwitch
            | ControlKind::EndFor
            | ControlKind::EndWhile
            | ControlKind::Do
            | ControlKind::EndDo(None)
            | ControlKind::Repeat
            | ControlKind::Break
            | ControlKind::Continue => {}
        }
    }

    fn jump(&mut self, jump: &Jump) {
        match &jump.kind {
            JumpKind::Label(_) => {}
            JumpKind::Number(number) => self.expr(number),
            JumpKind::Name(place) => self.place(place),
        }
    }

    fn group(&mut self, group: &Group) {
        for item in &group.items {
            match &item.kind {
                ItemKind::Target { place, value } => {
                    self.subscripts(place);
                    self.item(value);
                }
                ItemKind::Pair { value, .. } | ItemKind::Value(value) => self.item(value),
                ItemKind::Flag(_) | ItemKind::Missing => {}
            }
        }
    }

    fn item(&mut self, value: &ItemValue) {
        match value {
            ItemValue::Expr(e) => self.expr(e),
            ItemValue::List(group) => self.group(group),
            ItemValue::Name(_) => {}
        }
    }

    fn place(&mut self, place: &Place) {
        if let PlaceKind::Variable(segments) = &place.kind {
            if system::needs_actual(segments) && self.reads.actual.is_none() {
                self.reads.actual = Some(Sync::ReadActual);
            }
            if external::is_synchronous(segments, self.asynchronous) {
                self.reads.external.get_or_insert(place.span);
            }
        }
        self.subscripts(place);
    }

    /// The indices of a place, which are read even if it is written.
    fn subscripts(&mut self, place: &Place) {
        match &place.kind {
            PlaceKind::Variable(segments) => {
                for e in segments.iter().flat_map(|s| &s.subscripts) {
                    self.expr(e);
                }
            }
            PlaceKind::Parameter { index, subscripts, .. } => {
                if let ParameterIndex::Computed(index) = index {
                    self.expr(index);
                }
                for e in subscripts {
                    self.expr(e);
                }
            }
            PlaceKind::Cycle(_) => {}
        }
    }

    /// Without recursion along chains of operators.
    fn expr(&mut self, expr: &Expr) {
        if matches!(expr.kind, ExprKind::Number(_)) {
            return;
        }
        let mut open: SmallVec<[&Expr; 8]> = smallvec![expr];
        while let Some(expr) = open.pop() {
            match &expr.kind {
                ExprKind::Place(place) => self.place(place),
                ExprKind::Negate(inner) => open.push(inner),
                // the left operand first, so that messages mark it
                ExprKind::Binary(binary) => open.extend([&binary.right, &binary.left]),
                // these ask for the variable, not for its value
                ExprKind::Call(call)
                    if matches!(call.function, Function::Exist | Function::SizeOf) => {}
                ExprKind::Call(call) => open.extend(call.arguments.iter().rev()),
                _ => {}
            }
        }
    }
}
