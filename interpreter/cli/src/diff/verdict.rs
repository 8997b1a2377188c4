//! A comparison for test systems: a verdict on every signal.

use super::compare::{ColumnOutcome, Difference, Outcome};
use super::text::{brief, place, sentence, shift};
use crate::workflow::{self, Place};
use kontur_interpreter::diag::Severity;
use kontur_interpreter::diag::render::printable;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use std::path::Path;

/// The findings, signal by signal.
#[derive(Debug, Default)]
pub(super) struct Verdict {
    pub(super) signals: Vec<Signal>,
}

/// One signal, or another property of a trace.
#[derive(Debug)]
pub(super) struct Signal {
    pub(super) name: String,
    /// The difference; `None` if it agrees.
    pub(super) failure: Option<Failure>,
}

/// Difference in a signal.
#[derive(Debug)]
pub(super) struct Failure {
    /// Summary in one line.
    pub(super) message: String,
    /// Further information, line by line.
    pub(super) details: Vec<String>,
    /// Position of the first difference: NC file and line.
    pub(super) place: Option<(String, u32)>,
}

/// The verdict on two traces; `program` is the program that ran for one of them.
pub(super) fn of(outcome: &Outcome, program: Option<&Path>) -> Verdict {
    let mut signals = Vec::new();
    let rest = shift(outcome);
    for column in &outcome.columns {
        let mut failure = differs(column, program);
        failure.details.extend(rest.clone());
        signals.push(Signal { name: brief(&column.column), failure: Some(failure) });
    }
    let equal = outcome.equal_columns.iter();
    signals.extend(equal.map(|name| Signal { name: brief(name), failure: None }));
    let whole = |name: &str, message: Option<String>| Signal {
        name: name.to_owned(),
        failure: message.map(|message| Failure { message, details: Vec::new(), place: None }),
    };
    let rows = match [outcome.rows_a, outcome.rows_b] {
        [0, 0] => Some("no rows in A and B".to_owned()),
        [a, b] => (a != b).then(|| format!("{a} rows in A, {b} in B")),
    };
    signals.push(whole("number of rows", rows));
    let only = |side: &str, columns: &[String]| {
        let names: Vec<String> = columns.iter().map(|c| brief(c)).collect();
        (!names.is_empty()).then(|| format!("only in {side}: {}", names.join(", ")))
    };
    let missing: Vec<String> =
        [only("A", &outcome.only_a), only("B", &outcome.only_b)].into_iter().flatten().collect();
    signals.push(whole("columns", (!missing.is_empty()).then(|| missing.join("; "))));
    Verdict { signals }
}

fn differs(column: &ColumnOutcome, program: Option<&Path>) -> Failure {
    let first = &column.first;
    let details = column.worst.iter().filter(|worst| worst.row != first.row);
    Failure {
        message: format!("{} rows differ, first at {}", column.rows, place(first)),
        details: std::iter::once(sentence(first))
            .chain(details.map(|worst| format!("largest: {}", sentence(worst))))
            .collect(),
        place: nc_line(first, program),
    }
}

fn nc_line(d: &Difference, program: Option<&Path>) -> Option<(String, u32)> {
    let line = d.line.as_ref()?.parse().ok().filter(|line| *line > 0)?;
    let file = match (&d.file, program) {
        (Some(file), _) if !file.is_empty() => file.clone(),
        (_, Some(program)) => program.display().to_string(),
        _ => return None,
    };
    Some((file, line))
}

impl Verdict {
    /// Adds the verdict on the run of a program that has ended with an error.
    pub(super) fn aborted(&mut self, program: &str) {
        let message = "the program was refused, or ended with an error".to_owned();
        let failure = Failure { message, details: Vec::new(), place: None };
        self.signals.push(Signal { name: format!("run of {program}"), failure: Some(failure) });
    }

    /// `JUnit` XML: a test suite with a case for each signal. Valid by the schema `junit-10.xsd` of Jenkins' xUnit plugin, which does not know the
    /// attribute `skipped` of the whole report.
    pub(super) fn junit(&self, [a, b]: &[String; 2]) -> String {
        let mut suite = TestSuite::new(printable(&format!("{a} | {b}")));
        for signal in &self.signals {
            let status = match &signal.failure {
                None => TestCaseStatus::success(),
                Some(failure) => {
                    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                    status.set_message(&failure.message).set_type("difference");
                    status.set_description(failure.details.join("\n"));
                    status
                }
            };
            let mut case = TestCase::new(signal.name.clone(), status);
            case.set_classname("kontur diff");
            suite.add_test_case(case);
        }
        let mut report = Report::new("kontur diff");
        report.add_test_suite(suite);
        report.to_string().unwrap_or_default().replacen(" skipped=\"0\"", "", 1)
    }

    /// Commands of GitHub's workflow log, one for each signal that differs.
    pub(super) fn github(&self, [a, b]: &[String; 2]) -> String {
        let mut out = String::new();
        for signal in &self.signals {
            let Some(failure) = &signal.failure else { continue };
            let at = failure.place.as_ref();
            let at = at.map(|(file, line)| Place { file, line: *line, columns: None });
            let title = format!("{}: {}", signal.name, failure.message);
            let details = failure.details.iter().map(|line| format!("\n{line}"));
            let text = format!("{a} (A) and {b} (B){}", details.collect::<String>());
            out += &workflow::raise(Severity::Error, at, &title, &text);
            out.push('\n');
        }
        out
    }
}
