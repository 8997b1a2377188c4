//! External variables in a program: their values at its start, and the stop before one is read.

use crate::diag::{Condition, Diagnostic};
use crate::exec::block::choice::Compensation;
use crate::exec::contour::note_lost_corner;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::External;
use crate::exec::step::Sync;
use crate::exec::values::variables::resolve::external_name_of;
use crate::source::RawBlock;
use crate::syntax::Parser;
use crate::syntax::ast::{Assign, Body, Expr, ExprKind, Place, PlaceKind, Span, Word, WordKind};
use std::collections::BTreeMap;
use std::sync::Arc;

impl Decoder {
    /// The values of external variables at program start: the assignments of the list, then those given by the user.
    /// Messages: 21840, 21841; an error of the user's value.
    pub(in crate::exec) fn start_external(&mut self, given: BTreeMap<String, External>) {
        let machine = Arc::clone(&self.machine);
        for (text, at) in &machine.external.init {
            if let Err(mut diagnostic) = self.initialise(text) {
                diagnostic.source.clone_from(at);
                self.report.unplaced.push(*diagnostic);
            }
        }
        let externals = &mut self.values.variables.external;
        for (name, External { value, access }) in given {
            externals.given.insert(name.clone());
            let set = externals.store(name.clone(), value, Span::default(), &mut self.report);
            match (set, externals.values.get_mut(&name)) {
                (Ok(()), Some(known)) => known.access = access,
                (Err(fault), _) => {
                    let mut diagnostic = fault.diagnostic;
                    diagnostic.text = format!("--external {name}: {}", diagnostic.text);
                    self.report.unplaced.push(diagnostic);
                }
                (Ok(()), None) => {}
            }
        }
        let rounded = self.report.take_faults().into_iter().map(|fault| fault.diagnostic);
        self.report.unplaced.extend(rounded);
    }

    /// Executes an assignment of the list (P-EXTV-00013); one that fails leaves its variable at 0.
    fn initialise(&mut self, text: &str) -> Result<(), Box<Diagnostic>> {
        let refused = |condition, why: &str| {
            Box::new(Diagnostic::new(condition, format!("init {text}: {why}")))
        };
        let no_assignment = "no assignment to a variable of the list, no effect";
        let mut found = Vec::new();
        let raw = RawBlock::from_line(text);
        let block = Parser::new([]).block(&raw, &Arc::from("init"), &mut found);
        if let Some(error) = found.iter().find(|d| d.is_error()) {
            return Err(refused(Condition::ExternalNotInitialised, &error.text));
        }
        let words = match &block.body {
            Body::Words(words) => &words[..],
            _ => &[],
        };
        let assign = match words {
            [Word { kind: WordKind::Assign(assign), .. }]
                if assign.operator.is_none() && is_external(&assign.target) =>
            {
                assign
            }
            _ => return Err(refused(Condition::ExternalNotInitialised, no_assignment)),
        };
        let span = assign.target.span;
        let name = external_name_of(self, &assign.target).ok().filter(|name| {
            let externals = &self.values.variables.external;
            externals.declared(name, span).is_ok_and(|declared| declared.is_some())
        });
        let Some(name) = name else {
            return Err(refused(Condition::ExternalNotInitialised, no_assignment));
        };
        let failed = if let Some(other) = other_variable(assign) {
            let why = format!("{other} is no external variable, the variable is 0");
            refused(Condition::ExternalInitVariable, &why)
        } else {
            let outcome = self.value(&assign.value).and_then(|value| {
                let externals = &mut self.values.variables.external;
                externals.store(name.clone(), value, assign.value.span, &mut self.report)
            });
            let Err(fault) = outcome else { return Ok(()) };
            let why = format!("{}, the variable is 0", fault.diagnostic.text);
            refused(Condition::ExternalNotInitialised, &why)
        };
        self.values.variables.external.values.remove(&name);
        Err(failed)
    }

    /// Empties the channel before a block reads a synchronous external variable: an implicit `#FLUSH WAIT`.
    ///
    /// # Errors
    /// 20651 where that is not permitted: under tool radius compensation, contouring, `#HSC` and Akima splines; 90050 between
    /// G40 and the motion that ends the compensation; 21909 between two contour lines. K-0111 if G260 has ended contouring
    /// and the corner before it would still be rounded.
    pub(in crate::exec) fn flush_for_external(&mut self, read: Span) -> Outcome<()> {
        let active = if self.modal.compensation != Compensation::Off {
            Some(("tool radius compensation is", "G40"))
        } else if self.motion.is_contouring(&self.modal, &self.contour) {
            Some(("contouring is", "G260"))
        } else if self.contour.hsc.on {
            Some(("#HSC is", "#HSC OFF"))
        } else if self.contour.akima.selected {
            Some(("an Akima spline is", "G150"))
        } else {
            None
        };
        if let Some((active, end)) = active {
            let text = format!(
                "reading an external variable empties the channel, which is not permitted while {active} active"
            );
            let hint = format!(
                "read it into a P parameter before, or write {end} first; variables that the list of the machine declares with synchronisation FALSE are read without a stop"
            );
            return Err(Fault::new(Condition::FlushWithCompensation, text, read).hint(hint));
        }
        if self.contour.awaits_departure() {
            let text =
                "external variable read before the motion that ends tool radius compensation";
            return Err(Fault::new(Condition::FlushAfterCompensation, text, read));
        }
        self.motion.contour_line.may_flush("external variable read", read)?;
        if self.contour.has_contoured_corner() {
            note_lost_corner(&mut self.report);
        }
        self.sync(Sync::FlushWait);
        Ok(())
    }
}

fn is_external(place: &Place) -> bool {
    match &place.kind {
        PlaceKind::Variable(segments) => {
            segments.first().is_some_and(|first| first.name.eq_ignore_ascii_case("E"))
        }
        PlaceKind::Parameter { .. } | PlaceKind::Cycle(_) => false,
    }
}

/// The first variable of another class on the right side of an assignment.
fn other_variable(assign: &Assign) -> Option<&Place> {
    let mut open: Vec<&Expr> = vec![&assign.value];
    while let Some(expr) = open.pop() {
        match &expr.kind {
            ExprKind::Place(place) if !is_external(place) => return Some(place),
            ExprKind::Negate(inner) => open.push(inner),
            ExprKind::Binary(binary) => open.extend([&binary.right, &binary.left]),
            ExprKind::Call(call) => open.extend(&call.arguments),
            _ => {}
        }
    }
    None
}
