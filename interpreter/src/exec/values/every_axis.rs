//! `V.G.NP[1].ALL = V.G.NP_AKT.ALL`: zero offsets of all axes in one assignment.
//!
//! Source: TF5200 programming manual, access to the current zero offset (tccncprogramming 15556751499).

use crate::syntax::ast::{
    Assign, Binary, Expr, ExprKind, FunctionCall, Place, PlaceKind, Segment, Span,
};

/// Whether it is `V.G.NP[i].ALL` or `V.G.NP_AKT.ALL`.
pub(in crate::exec) fn is_all(place: &Place) -> bool {
    matches!(&place.kind, PlaceKind::Variable(segments) if names_all(segments))
}

/// The assignment for one axis, given by its index.
pub(in crate::exec) fn of_axis(assign: &Assign, axis: usize) -> Assign {
    let Assign { target, operator, value } = assign;
    let (target, value) = (place(target, axis), expression(value, axis));
    Assign { target, operator: *operator, value }
}

fn names_all(segments: &[Segment]) -> bool {
    let is = |segment: &Segment, name: &str| segment.name.eq_ignore_ascii_case(name);
    match segments {
        [g, np, all] => is(g, "G") && (is(np, "NP") || is(np, "NP_AKT")) && is(all, "ALL"),
        _ => false,
    }
}

fn place(place: &Place, axis: usize) -> Place {
    let mut place = place.clone();
    if let PlaceKind::Variable(segments) = &mut place.kind
        && names_all(segments)
        && let Some(last) = segments.last_mut()
    {
        let index = Expr { kind: ExprKind::Number(axis as f64), span: place.span };
        *last = Segment { name: "V".into(), subscripts: vec![index] };
    }
    place
}

fn expression(expr: &Expr, axis: usize) -> Expr {
    let of = |expr: &Expr| expression(expr, axis);
    let kind = match &expr.kind {
        ExprKind::Place(read) => ExprKind::Place(Box::new(place(read, axis))),
        ExprKind::Negate(inner) => ExprKind::Negate(Box::new(of(inner))),
        ExprKind::Binary(both) => {
            let Binary { op, left, right } = &**both;
            ExprKind::Binary(Box::new(Binary { op: *op, left: of(left), right: of(right) }))
        }
        ExprKind::Call(call) => {
            let FunctionCall { function, arguments } = &**call;
            let arguments = arguments.iter().map(of).collect();
            ExprKind::Call(Box::new(FunctionCall { function: *function, arguments }))
        }
        other => other.clone(),
    };
    let span: Span = expr.span;
    Expr { kind, span }
}
