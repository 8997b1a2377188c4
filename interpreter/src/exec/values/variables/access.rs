//! Reading, writing and deleting a variable of the program.

use super::resolve::{Target, undefined_parameter};
use super::scopes::{Class, Variables};
use super::storage::{Owner, Variable, note_rounded};
use crate::diag::{Condition, Diagnostic};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::report::Report;
use crate::exec::values::number::as_number;
use crate::machine::Channel;
use crate::suggest;
use crate::syntax::ast::{Place, Span};

impl Variables {
    /// Value of a variable.
    pub(super) fn read(
        &self,
        target: &Target<'_>,
        channel: &Channel,
        span: Span,
    ) -> Outcome<Value> {
        match target {
            Target::Parameter(index, subscripts) => match self.parameters().get(index) {
                Some(variable) => variable.get(subscripts, Owner::Parameter, span),
                None if !subscripts.is_empty() => Err(undeclared_array(*index, span)),
                None if channel.variables.keep_p_parameters => {
                    let hint = "P-CHAN-00067 keeps parameters of earlier programs; here no earlier program has run";
                    Err(undefined_parameter(*index, span).hint(hint))
                }
                None => Err(undefined_parameter(*index, span)),
            },
            Target::Own(class, name, subscripts) => match self.find(*class, name) {
                Some(variable) => variable.get(subscripts, Owner::Variable, span),
                None => Err(self.unknown(*class, name, "has no value", span)),
            },
            Target::External(name) => self.external.read(name, span),
            Target::Cycle(name) => {
                self.cycle_parameter(name, channel.variables.creates_cycle_parameters, span)
            }
        }
    }

    /// Writes a variable, which `place` names in messages.
    pub(super) fn write(
        &mut self,
        target: Target<'_>,
        place: &Place,
        (value, value_span): (Value, Span),
        report: &mut Report,
    ) -> Outcome<()> {
        let span = place.span;
        match target {
            Target::Parameter(index, subscripts) => {
                let number = Value::Number(as_number(&value, value_span)?);
                let table = self.parameters_mut();
                match table.get_mut(&index) {
                    Some(variable) => variable.set(&subscripts, number, Owner::Parameter, span),
                    None if !subscripts.is_empty() => Err(undeclared_array(index, span)),
                    None => {
                        table.insert(index, Variable::created(number));
                        Ok(())
                    }
                }
            }
            Target::Own(class, name, subscripts) => {
                if let Some(variable) = self.find_mut(class, &name) {
                    let rounded = variable.kind.and_then(|kind| kind.rounds(&value));
                    variable.set(&subscripts, value, Owner::Variable, value_span)?;
                    if let Some(x) = rounded {
                        note_rounded(report, &place.to_string(), x, value_span);
                    }
                    return Ok(());
                }
                let by_write = matches!(class, Class::Program | Class::Shared);
                if !by_write || !subscripts.is_empty() {
                    let fault = self.unknown(class, &name, "is not declared", span);
                    return Err(fault.hint("declare it between #VAR and #ENDVAR"));
                }
                if let Some(table) = self.table(class) {
                    table.insert((&*name).into(), Variable::created(value));
                }
                Ok(())
            }
            Target::External(name) => self.external.write(name, value, span, report),
            Target::Cycle(name) => self.set_cycle_parameter(name, value, span),
        }
    }

    /// Whether a variable exists; an element outside the array does not.
    pub(super) fn exists(&self, target: &Target<'_>, span: Span) -> bool {
        let has = |variable: Option<&Variable>, subscripts: &[f64], owner: Owner| {
            variable.is_some_and(|variable| {
                subscripts.is_empty() || variable.get(subscripts, owner, span).is_ok()
            })
        };
        match target {
            Target::Parameter(index, subscripts) => {
                has(self.parameters().get(index), subscripts, Owner::Parameter)
            }
            Target::Own(class, name, subscripts) => {
                has(self.find(*class, name), subscripts, Owner::Variable)
            }
            Target::External(name) => self.external.exists(name, span),
            Target::Cycle(name) => self.passed(name).unwrap_or(false),
        }
    }

    /// Sizes of the dimensions of an array; none for a scalar.
    pub(super) fn dimensions(&self, target: &Target<'_>) -> Vec<usize> {
        let found = match target {
            Target::Parameter(index, _) => self.parameters().get(index),
            Target::Own(class, name, _) => self.find(*class, name),
            Target::External(name) => return self.external.dimensions(name),
            Target::Cycle(_) => None,
        };
        found.map(|v| v.sizes.to_vec()).unwrap_or_default()
    }

    /// Removes a P parameter or a self-defined variable; others stay.
    pub(super) fn delete(
        &mut self,
        target: &Target<'_>,
        span: Span,
        report: &mut Report,
    ) -> Outcome<()> {
        let removed = match target {
            Target::Parameter(index, _) => {
                let gone = self.parameters_mut().remove(index);
                if gone.is_none() {
                    let text = format!("P{index} does not exist");
                    let hint = format!("EXIST[P{index}] checks whether it exists");
                    return Err(Fault::new(Condition::DeletedUnknown, text, span).hint(hint));
                }
                gone
            }
            Target::Own(class, name, _) => {
                let gone = self.table(*class).and_then(|table| table.remove(&**name));
                if gone.is_none() {
                    return self.absent(*class, name, span, report);
                }
                gone
            }
            Target::External(_) | Target::Cycle(_) => None,
        };
        self.elements -= removed.map_or(0, |v| v.elements());
        Ok(())
    }

    /// A variable to be deleted that this level does not have.
    ///
    /// Without a V.CYC variable nothing is done; 20933 if it belongs to a level above (486167307).
    fn absent(&self, class: Class, name: &str, span: Span, report: &mut Report) -> Outcome<()> {
        match class {
            Class::Cycle if self.find(Class::Cycle, name).is_none() => Ok(()),
            Class::Cycle => {
                let text = format!("V.CYC.{name} was created on a higher level");
                Err(Fault::new(Condition::DeletedAbove, text, span))
            }
            Class::Shared => {
                // on the control they outlive programs, so a program may delete those of another one
                let text = format!(
                    "V.S.{name} does not exist: a run starts without variables of earlier programs"
                );
                let hint = "on the control, a missing variable is error 20932";
                let fault = Fault::new(Condition::Ignored, text, span).hint(hint);
                report.note_once("V.S", fault);
                Ok(())
            }
            Class::Program | Class::Local => {
                let unknown = self.unknown(class, name, "does not exist", span);
                Err(unknown.with(|d| Diagnostic { id: Condition::DeletedUnknown.id(), ..d }))
            }
        }
    }

    fn unknown(&self, class: Class, name: &str, what: &str, span: Span) -> Box<Fault> {
        let letter = match class {
            Class::Program => "P",
            Class::Local => "L",
            Class::Shared => "S",
            Class::Cycle => "CYC",
        };
        let text = format!("V.{letter}.{name} {what}");
        let fault = Fault::new(Condition::Undefined, text, span);
        match suggest::nearest(name, self.names(class)) {
            Some(near) => fault.hint(format!("did you mean `V.{letter}.{near}`?")),
            None => fault,
        }
    }
}

fn undeclared_array(index: u32, span: Span) -> Box<Fault> {
    Fault::new(Condition::ArrayNotDeclared, format!("P{index} is not declared as an array"), span)
        .hint(format!("declare it between #VAR and #ENDVAR: P{index}[size]"))
}
