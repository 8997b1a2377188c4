//! A system variable as written, and what its parts mean.

use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::tools::Tool;
use crate::exec::options::Value;
use crate::exec::values::number::whole;
use crate::syntax::ast::{Segment, Span};

/// A variable as written, split into its parts.
pub(super) struct Path<'a> {
    pub(super) segments: &'a [Segment],
    pub(super) span: Span,
}

impl Path<'_> {
    /// A position of an axis in the unit of the program.
    pub(super) fn position(
        &self,
        d: &Decoder,
        at: usize,
        f: impl Fn(&Decoder, usize) -> f64,
    ) -> Outcome<Value> {
        let axis = self.axis(d, at)?;
        Ok(Value::Number(f(d, axis) / d.modal.axis_unit(&d.machine.axes[axis])))
    }

    /// A position, of a modulo axis within its range.
    pub(super) fn wrapped(
        &self,
        d: &Decoder,
        at: usize,
        f: impl Fn(&Decoder, usize) -> f64,
    ) -> Outcome<Value> {
        self.position(d, at, |d, a| d.machine.axes[a].in_modulo_range(f(d, a)))
    }

    /// A coordinate of the program, of a modulo axis within its range. Refused for a scaled axis, because the documents do not
    /// specify whether it is the coordinate before or after scaling.
    pub(super) fn coordinate(
        &self,
        d: &Decoder,
        at: usize,
        f: impl Fn(&Decoder, usize) -> f64,
    ) -> Outcome<Value> {
        let axis = self.axis(d, at)?;
        if d.geometry.scale.changes(axis) {
            let name = written(self.segments);
            return Err(Fault::unsupported(format!("V.{name} with #SCALE"), self.span));
        }
        self.wrapped(d, at, f)
    }

    /// Position of an axis with all offsets, of a modulo axis within its range; 21784 for an axis that follows a master.
    pub(super) fn axis_position(&self, d: &Decoder) -> Outcome<Value> {
        let axis = self.axis(d, 3)?;
        if d.motion.couplings.is_slave(axis) {
            let text = format!("axis {} follows a master", d.names.name(axis));
            return Err(Fault::new(Condition::AxisPositionOfSlave, text, self.span));
        }
        self.wrapped(d, 3, |d, a| d.geometry.coordinates.target()[a])
    }

    /// Axis by its name in the segment `at`, or by the index after the segment before.
    pub(super) fn axis(&self, d: &Decoder, at: usize) -> Outcome<usize> {
        if let Some(segment) = self.segments.get(at) {
            return d.names.of_name(&segment.name).ok_or_else(|| {
                let text = format!("unknown axis `{}`", segment.name);
                Fault::new(Condition::AxisIdentifier, text, self.span).hint(d.names.hint())
            });
        }
        let high = u32::try_from(d.machine.axes.len().saturating_sub(1)).unwrap_or(0);
        let index = self.index(d, at - 1, high)? as usize;
        Ok(index)
    }

    pub(super) fn spindle(&self, d: &Decoder, at: usize) -> Outcome<usize> {
        let name = self.segments.get(at).map_or("", |s| &*s.name);
        d.motion.spindle_of_name(name, &d.machine.channel).ok_or_else(|| {
            let text = format!("unknown spindle `{name}`");
            Fault::new(Condition::AxisIdentifier, text, self.span)
        })
    }

    /// A value that exists only for the main spindle; 0 for any other.
    pub(super) fn of_main_spindle(&self, d: &Decoder, value: f64) -> Outcome<Value> {
        Ok(Value::Number(if self.spindle(d, 2)? == 0 { value } else { 0.0 }))
    }

    /// Index after a segment.
    pub(super) fn index(&self, d: &Decoder, at: usize, high: u32) -> Outcome<u32> {
        let subscripts = self.segments.get(at).map(|s| &s.subscripts[..]);
        match subscripts {
            Some([expr]) => {
                let x = d.number(expr)?;
                whole(x, 0, high).ok_or_else(|| {
                    let tool =
                        self.segments.get(1).is_some_and(|s| s.name.eq_ignore_ascii_case("WZ"));
                    let condition =
                        if tool { Condition::ToolIndex } else { Condition::VariableNumber };
                    let text = format!("the index is {x}, allowed: whole numbers 0 to {high}");
                    Fault::new(condition, text, expr.span).with(|d| {
                        d.value(ValueKind::Wrong, x, "-")
                            .value(ValueKind::LowerLimit, 0, "-")
                            .value(ValueKind::UpperLimit, high, "-")
                    })
                })
            }
            _ => Err(Fault::new(Condition::Syntax, "one index is expected", self.span)),
        }
    }

    pub(super) fn tool(&self, d: &Decoder) -> Outcome<Tool> {
        let index = self.index(d, 1, u32::MAX)?;
        Ok(d.geometry.tools.table.get(&index).cloned().unwrap_or_default())
    }

    /// `V.G.@P[i].VALID`.
    pub(super) fn passed(&self, d: &Decoder) -> Outcome<Value> {
        let name = format!("P{}", self.index(d, 1, 200)?);
        if let Some(passed) = d.values.variables.passed(&name) {
            Ok(Value::truth(passed))
        } else {
            let text = "V.G.@P[i].VALID only exists inside a cycle";
            Err(Fault::new(Condition::ParameterOutsideCycle, text, self.span))
        }
    }
}

/// The parts as one name.
pub(super) fn written(segments: &[Segment]) -> String {
    segments.iter().map(|s| &*s.name).collect::<Vec<_>>().join(".")
}
