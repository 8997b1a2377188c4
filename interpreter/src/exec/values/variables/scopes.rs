//! The variables that exist at a position in the program: by class, level and cycle.

use super::external::Externals;
use super::storage::Variable;
use crate::diag::Condition;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::machine::ExternalVariables;
use crate::syntax::ast::Span;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

type Table = BTreeMap<Box<str>, Variable>;

/// Variables of one call of a cycle.
#[derive(Clone, Debug, Default)]
pub(super) struct CycleScope {
    /// P parameters of the cycle.
    parameters: BTreeMap<u32, Variable>,
    /// `@P1`, `@X`, ... by the name after `@`.
    pub(super) passed: BTreeMap<Box<str>, Value>,
}

/// All variables of a program.
#[derive(Clone, Debug, Default)]
pub(in crate::exec) struct Variables {
    parameters: BTreeMap<u32, Variable>,
    program: Table,
    shared: Table,
    /// One table per program level: V.L.
    locals: Vec<Table>,
    /// The same for V.CYC, which any program may declare. Source: TF5200 programming manual, cycle variables.
    cycle: Vec<Table>,
    pub(super) cycles: Vec<CycleScope>,
    pub(super) external: Externals,
    /// External variables named by the program, in an expression or as a target.
    named: RefCell<BTreeSet<String>>,
    pub(super) elements: usize,
    /// Cycle parameters created by reading and not reported yet: an expression is evaluated without changing anything
    /// else.
    pub(super) created: RefCell<Vec<(Box<str>, Span)>>,
}

impl Variables {
    pub(in crate::exec) fn new(external: &ExternalVariables) -> Self {
        let (locals, cycle) = (vec![Table::new()], vec![Table::new()]);
        Self { locals, cycle, external: Externals::new(external), ..Self::default() }
    }

    /// Records that the program names an external variable.
    pub(super) fn uses_external(&self, name: &str) {
        let mut named = self.named.borrow_mut();
        if !named.contains(name) {
            named.insert(name.to_owned());
        }
    }

    /// External variables given by the user and not named by the program, each with a similar name that the program does
    /// use.
    pub(in crate::exec) fn unused_external(&self) -> Vec<(String, Option<String>)> {
        self.external.unused(&self.named.borrow())
    }

    /// Enters a program level.
    pub(in crate::exec) fn enter_level(&mut self) {
        self.locals.push(Table::new());
        self.cycle.push(Table::new());
    }

    /// Leaves a program level, and drops its local variables.
    pub(in crate::exec) fn leave_level(&mut self) {
        for gone in [self.locals.pop(), self.cycle.pop()].into_iter().flatten() {
            self.elements -= gone.values().map(Variable::elements).sum::<usize>();
        }
    }

    /// Enters a cycle with the parameters passed to it.
    pub(in crate::exec) fn enter_cycle(&mut self, passed: BTreeMap<Box<str>, Value>) {
        self.cycles.push(CycleScope { passed, ..CycleScope::default() });
    }

    pub(in crate::exec) fn leave_cycle(&mut self) {
        let gone = self.cycles.pop().unwrap_or_default();
        self.elements -= gone.parameters.values().map(Variable::elements).sum::<usize>();
    }

    /// Whether the program is inside a cycle.
    pub(in crate::exec) fn is_cycle(&self) -> bool {
        !self.cycles.is_empty()
    }

    /// Whether a cycle parameter was passed; `None` outside cycles.
    pub(in crate::exec) fn passed(&self, name: &str) -> Option<bool> {
        Some(self.cycles.last()?.passed.contains_key(name))
    }

    pub(super) fn parameters(&self) -> &BTreeMap<u32, Variable> {
        self.cycles.last().map_or(&self.parameters, |c| &c.parameters)
    }

    pub(super) fn parameters_mut(&mut self) -> &mut BTreeMap<u32, Variable> {
        self.cycles.last_mut().map_or(&mut self.parameters, |c| &mut c.parameters)
    }

    pub(super) fn find(&self, class: Class, name: &str) -> Option<&Variable> {
        match class {
            Class::Program => self.program.get(name),
            Class::Shared => self.shared.get(name),
            Class::Cycle => self.cycle.iter().rev().find_map(|table| table.get(name)),
            Class::Local => self.locals.iter().rev().find_map(|table| table.get(name)),
        }
    }

    pub(super) fn find_mut(&mut self, class: Class, name: &str) -> Option<&mut Variable> {
        match class {
            Class::Program => self.program.get_mut(name),
            Class::Shared => self.shared.get_mut(name),
            Class::Cycle => self.cycle.iter_mut().rev().find_map(|table| table.get_mut(name)),
            Class::Local => self.locals.iter_mut().rev().find_map(|table| table.get_mut(name)),
        }
    }

    /// The table that currently receives declarations.
    pub(super) fn table(&mut self, class: Class) -> Option<&mut Table> {
        match class {
            Class::Program => Some(&mut self.program),
            Class::Shared => Some(&mut self.shared),
            Class::Cycle => self.cycle.last_mut(),
            Class::Local => self.locals.last_mut(),
        }
    }

    /// Declares or replaces a P parameter.
    pub(super) fn insert_parameter(&mut self, index: u32, variable: Variable) {
        self.elements += variable.elements();
        if let Some(old) = self.parameters_mut().insert(index, variable) {
            self.elements -= old.elements();
        }
    }

    /// Declares a variable; true if it already existed.
    pub(super) fn insert(
        &mut self,
        class: Class,
        name: &str,
        variable: Variable,
        span: Span,
    ) -> Outcome<bool> {
        let elements = variable.elements();
        let Some(table) = self.table(class) else {
            let text = "V.CYC variables exist only inside a cycle";
            return Err(Fault::new(Condition::VariableType, text, span));
        };
        if table.contains_key(name) {
            return Ok(true);
        }
        table.insert(name.into(), variable);
        self.elements += elements;
        Ok(false)
    }

    pub(super) fn names(&self, class: Class) -> Vec<&str> {
        let tables: Vec<&Table> = match class {
            Class::Program => vec![&self.program],
            Class::Shared => vec![&self.shared],
            Class::Cycle => self.cycle.iter().collect(),
            Class::Local => self.locals.iter().collect(),
        };
        tables.into_iter().flat_map(|t| t.keys().map(|k| &**k)).collect()
    }
}

/// Class of self-defined variables.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Class {
    Program,
    Local,
    Shared,
    Cycle,
}

/// Class of the first segment, if it denotes self-defined variables.
pub(super) fn class(segment: &str) -> Option<(Class, &'static str)> {
    const CLASSES: [(&str, Class); 4] =
        [("P", Class::Program), ("L", Class::Local), ("S", Class::Shared), ("CYC", Class::Cycle)];
    CLASSES.iter().find(|(n, _)| n.eq_ignore_ascii_case(segment)).map(|(n, c)| (*c, *n))
}
