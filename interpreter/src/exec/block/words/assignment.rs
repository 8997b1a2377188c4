//! Assignments in a block: variables, parameters and `@` words of cycles.

use crate::diag::Condition;
use crate::exec::block::collected::Words;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::values::{every_axis, system};
use crate::syntax::ast::{Assign, Binary, BinaryOp, Expr, ExprKind, PlaceKind, Segment, Span};

impl Words<'_> {
    /// Notes an assignment to the tool data in use (`V.G.WZ_AKT`), which D in the same block would set, too.
    fn tool_assigned(&mut self, segments: &[Segment], span: Span) -> Outcome<()> {
        if !system::is_active_tool(segments) {
            return Ok(());
        }
        let condition = match segments {
            [_, _, offset, ..] if offset.name.eq_ignore_ascii_case("V") => {
                Condition::ToolOffsetTwice
            }
            [_, _, radius, ..] if radius.name.eq_ignore_ascii_case("R") => {
                Condition::ToolRadiusTwice
            }
            _ => Condition::ToolTwice,
        };
        let radius = Condition::ToolRadiusTwice;
        let before = self.tool_written.replace((condition, span));
        if condition == radius && before.is_some_and(|(before, _)| before == radius) {
            let text = "V.G.WZ_AKT.R is written twice in one block";
            return Err(Fault::new(Condition::ToolRadiusWrittenTwice, text, span));
        }
        Ok(())
    }
}

impl Decoder {
    /// Executes an assignment; a word `@..` of a cycle becomes a word of the block.
    pub(super) fn assignment<'b>(
        &mut self,
        assign: &'b Assign,
        span: Span,
        block: &mut Words<'b>,
    ) -> Outcome<()> {
        if let PlaceKind::Cycle(name) = &assign.target.kind
            && !name.starts_with('P')
        {
            if let Some(operator) = assign.operator {
                let text =
                    format!("@{name} takes a value with `=`, not with `{}=`", operator.symbol());
                return Err(Fault::new(Condition::Syntax, text, span));
            }
            return self.cycle_address(name, assign, span, block);
        }
        block.assigned_to = Some(span.end());
        if let PlaceKind::Variable(segments) = &assign.target.kind {
            block.tool_assigned(segments, span)?;
        }
        let outcome = self.assign(assign);
        // a check continues, and words that read the parameter have no error themselves
        if outcome.is_err()
            && let PlaceKind::Parameter { indirections: 0, subscripts, .. } = &assign.target.kind
            && subscripts.is_empty()
            && self.read(&assign.target).is_err()
        {
            let _ = self.write(&assign.target, Value::Number(0.0), span);
        }
        outcome
    }

    fn assign(&mut self, assign: &Assign) -> Outcome<()> {
        if every_axis::is_all(&assign.target) {
            return (0..self.machine.axes.len())
                .try_for_each(|axis| self.assign_one(&every_axis::of_axis(assign, axis)));
        }
        self.assign_one(assign)
    }

    fn assign_one(&mut self, assign: &Assign) -> Outcome<()> {
        let Assign { target, operator, value } = assign;
        let span = value.span;
        let result = match operator {
            None => self.value(value)?,
            Some(BinaryOp::Divide) if self.number(value)? == 0.0 => {
                let text = "division by zero with /=";
                return Err(Fault::new(Condition::DividedByZero, text, span));
            }
            Some(op) => {
                let left = Expr { kind: target.clone().into(), span: target.span };
                let both = Binary { op: *op, left, right: value.clone() };
                let whole = Expr { kind: ExprKind::Binary(Box::new(both)), span };
                self.value(&whole)?
            }
        };
        self.write(target, result, span)
    }
}
