//! Parameters of cycles: `@P1`, `@X`.

use super::scopes::Variables;
use super::storage::undefined;
use crate::diag::{Condition, ValueKind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::report::{Report, Subject};
use crate::machine::table::channel as of;
use crate::syntax::ast::Span;

impl Variables {
    /// Value of `@name`; `creates`: reading a `@P` that was not passed creates it (P-CHAN-00463).
    ///
    /// Assumption: its initial value is 0, and `V.G.@P[i].VALID` remains FALSE.
    pub(super) fn cycle_parameter(&self, name: &str, creates: bool, span: Span) -> Outcome<Value> {
        let Some(scope) = self.cycles.last() else {
            return Err(outside_cycle(name, span));
        };
        if let Some(value) = scope.passed.get(name) {
            return Ok(value.clone());
        }
        let numbered = number_of(name);
        match numbered {
            Some(_) if creates => {
                self.created.borrow_mut().push((name.into(), span));
                Ok(Value::Number(0.0))
            }
            Some(number) => {
                let text = format!("@{name} was not passed to the cycle");
                Err(Fault::new(Condition::CycleParameterMissing, text, span)
                    .hint(pass_it(name))
                    .with(|d| d.value(ValueKind::Wrong, number, "-")))
            }
            None => Err(undefined(&format!("@{name}"), span).hint(pass_it(name))),
        }
    }

    /// Sets a parameter of the active cycle; 21382 outside cycles.
    pub(super) fn set_cycle_parameter(
        &mut self,
        name: &str,
        value: Value,
        span: Span,
    ) -> Outcome<()> {
        match self.cycles.last_mut() {
            Some(scope) => {
                scope.passed.insert(name.into(), value);
                Ok(())
            }
            None => Err(outside_cycle(name, span)),
        }
    }

    /// Reports each `@P` that the block has created by reading, once per program.
    pub(in crate::exec) fn report_created(&self, report: &mut Report) {
        for (name, span) in self.created.take() {
            let text = format!(
                "@{name} was not passed to the cycle: reading it creates it with the value 0"
            );
            let fault = Fault::new(Condition::Odd, text, span)
                .warning()
                .hint(pass_it(&name))
                .with(|d| d.parameter(of::CREATES_PARAMETERS));
            report.note_once(Subject::Created(name), fault);
        }
    }
}

/// 21382.
fn outside_cycle(name: &str, span: Span) -> Box<Fault> {
    let text = format!("@{name} exists only inside a cycle");
    Fault::new(Condition::CycleParameterOutside, text, span)
}

/// Number of a parameter `@P`.
fn number_of(name: &str) -> Option<u32> {
    name.strip_prefix(['P', 'p']).and_then(|rest| rest.parse().ok())
}

/// Advice for a parameter that was not passed to a cycle.
fn pass_it(name: &str) -> String {
    match number_of(name) {
        Some(number) => format!("pass it, or test V.G.@P[{number}].VALID first"),
        None => format!("pass it in the call: L CYCLE [NAME=.. @{name}=..]"),
    }
}
