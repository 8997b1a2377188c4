//! P parameters, self-defined variables (`V.P`, `V.L`, `V.S`, `V.CYC`), external variables and cycle parameters.
//!
//! A place is resolved first, which evaluates its indices and may read the whole state; the access itself needs the variables
//! alone.
//!
//! Source: TF5200 programming manual, parameters and variables. Assumptions: array indices begin at 0; a number written
//! to an integer variable is rounded; an index of a P parameter is at most [`resolve::INDEX_MAX`], and all arrays together
//! have at most [`storage::ELEMENTS_MAX`] elements, so that a program cannot exhaust memory.

mod access;
mod cycle;
mod declare;
pub(in crate::exec) mod external;
mod resolve;
pub(super) mod scopes;
mod storage;

use super::system;
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::syntax::ast::{Place, Span};
use resolve::{Resolved, Target, resolve};

impl Decoder {
    /// Value of a place.
    pub(in crate::exec) fn read(&self, place: &Place) -> Outcome<Value> {
        match resolve(self, place)? {
            Resolved::Variable(target) => {
                self.values.variables.read(&target, &self.machine.channel, place.span)
            }
            Resolved::System(segments) => system::read(self, segments, place.span),
        }
    }

    /// Writes a place; texts may be written to variables, not to P parameters.
    pub(in crate::exec) fn write(
        &mut self,
        place: &Place,
        value: Value,
        value_span: Span,
    ) -> Outcome<()> {
        match resolve(self, place)? {
            Resolved::Variable(target) => {
                let value = (value, value_span);
                self.values.variables.write(target, place, value, &mut self.report)
            }
            Resolved::System(segments) => system::write(self, segments, &value, place.span),
        }
    }

    /// Whether a variable or parameter exists.
    pub(in crate::exec) fn exists(&self, place: &Place) -> Outcome<bool> {
        Ok(match resolve(self, place)? {
            Resolved::Variable(target) => self.values.variables.exists(&target, place.span),
            Resolved::System(segments) => system::read(self, segments, place.span).is_ok(),
        })
    }

    /// Sizes of the dimensions of an array; none for a scalar.
    pub(in crate::exec) fn dimensions(&self, place: &Place) -> Outcome<Vec<usize>> {
        match resolve(self, place)? {
            Resolved::Variable(target) => Ok(self.values.variables.dimensions(&target)),
            Resolved::System(_) => {
                let text = "SIZEOF takes arrays of the program, not variables of the control";
                Err(Fault::new(Condition::SizeOfSystemVariable, text, place.span))
            }
        }
    }

    /// `#DELETE`.
    pub(in crate::exec) fn delete(&mut self, place: &Place) -> Outcome<()> {
        let target = match resolve(self, place)? {
            Resolved::Variable(target @ (Target::Parameter(..) | Target::Own(..))) => target,
            Resolved::Variable(_) | Resolved::System(_) => {
                let text = "only variables defined by the program can be deleted";
                return Err(Fault::new(Condition::DeletedNotOwn, text, place.span));
            }
        };
        self.values.variables.delete(&target, place.span, &mut self.report)
    }
}
