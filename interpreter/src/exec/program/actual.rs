//! The blocks that read actual positions of the machine: motion must come to rest before them.

use crate::exec::step::Sync;
use crate::exec::values::system;
use crate::syntax::ast::{
    Block, Body, CallKind, ControlKind, Expr, ExprKind, GValue, Group, ItemKind, ItemValue, Place,
    PlaceKind, ReturnLevel, WordKind,
};
use smallvec::{SmallVec, smallvec};

/// The event for which the block waits before it reads actual positions of the machine; `None` if it reads none.
pub(super) fn needs_actual(block: &Block) -> Option<Sync> {
    if let Body::Command(command) = &block.body
        && command.is("CHANNEL INIT")
        && command.groups.iter().any(|g| g.has("ACTPOS"))
    {
        return Some(Sync::TakeActual);
    }
    reads_actual(block).then_some(Sync::ReadActual)
}

fn reads_actual(block: &Block) -> bool {
    match &block.body {
        Body::Empty | Body::ProgramHead(_) => false,
        Body::Declarations(list) => {
            list.iter().any(|d| d.value.as_ref().is_some_and(item_needs_actual))
        }
        Body::Words(words) => words.iter().any(|word| match &word.kind {
            WordKind::G { value: Some(value), .. } => match &**value {
                GValue::Scalar(e) => expr_needs_actual(e),
                GValue::List(list) => list.iter().flatten().any(expr_needs_actual),
            },
            WordKind::Address { value, .. } => expr_needs_actual(value),
            WordKind::ComputedG(number) => expr_needs_actual(number),
            WordKind::Assign(assign) => {
                expr_needs_actual(&assign.value) || place_needs_actual(&assign.target)
            }
            WordKind::M(_, Some(value)) | WordKind::H(_, Some(value)) => expr_needs_actual(value),
            WordKind::Return(back) => {
                matches!(&back.level, ReturnLevel::Jumps(levels) if expr_needs_actual(levels))
            }
            WordKind::Bracket(bracket) => group_needs_actual(&bracket.group),
            WordKind::Hash(hash) => hash.value.as_ref().is_some_and(expr_needs_actual),
            WordKind::Call(call) => match &call.kind {
                CallKind::Cycle(group) | CallKind::Sequence(group) => group_needs_actual(group),
                CallKind::Program(_) | CallKind::Variable(_) => false,
            },
            _ => false,
        }),
        Body::Command(command) => {
            command.is("GET ACTPOS")
                || command.arguments.iter().any(expr_needs_actual)
                || command.groups.iter().any(group_needs_actual)
        }
        Body::Control(control) => match &control.kind {
            ControlKind::If { condition: e, .. }
            | ControlKind::ElseIf(e)
            | ControlKind::Switch { value: e, .. }
            | ControlKind::Case(e)
            | ControlKind::While(e)
            | ControlKind::EndDo(Some(e))
            | ControlKind::Until(e) => expr_needs_actual(e),
            ControlKind::For { start, end, step, .. } => {
                expr_needs_actual(start)
                    || expr_needs_actual(end)
                    || step.as_ref().is_some_and(expr_needs_actual)
            }
            _ => false,
        },
    }
}

fn group_needs_actual(group: &Group) -> bool {
    group.items.iter().any(|item| match &item.kind {
        ItemKind::Target { place, value } => place_needs_actual(place) || item_needs_actual(value),
        ItemKind::Pair { value, .. } | ItemKind::Value(value) => item_needs_actual(value),
        ItemKind::Flag(_) | ItemKind::Missing => false,
    })
}

fn item_needs_actual(value: &ItemValue) -> bool {
    match value {
        ItemValue::Expr(e) => expr_needs_actual(e),
        ItemValue::List(group) => group_needs_actual(group),
        ItemValue::Name(_) => false,
    }
}

fn place_needs_actual(place: &Place) -> bool {
    match &place.kind {
        PlaceKind::Variable(segments) => {
            system::needs_actual(segments)
                || segments.iter().flat_map(|s| &s.subscripts).any(expr_needs_actual)
        }
        PlaceKind::Parameter { subscripts, .. } => subscripts.iter().any(expr_needs_actual),
        PlaceKind::Cycle(_) => false,
    }
}

/// Without recursion along chains of operators.
fn expr_needs_actual(expr: &Expr) -> bool {
    if matches!(expr.kind, ExprKind::Number(_)) {
        return false;
    }
    let mut open: SmallVec<[&Expr; 8]> = smallvec![expr];
    while let Some(expr) = open.pop() {
        match &expr.kind {
            ExprKind::Place(place) if place_needs_actual(place) => return true,
            ExprKind::Negate(inner) => open.push(inner),
            ExprKind::Binary(binary) => open.extend([&binary.left, &binary.right]),
            ExprKind::Call(call) => open.extend(&call.arguments),
            _ => {}
        }
    }
    false
}
