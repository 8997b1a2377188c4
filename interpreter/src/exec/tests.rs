//! Programs and their results. Expected values are from the language documents and plain geometry.

mod akima;
mod arcs;
mod bottlenecks;
mod calls;
mod compensation;
mod errors;
mod feed_course;
mod flow;
mod modes;
mod radius_change;
mod random;
mod said;
mod straight;
mod tables;
mod tangential;

use super::{
    EndReason, Event, Executor, Feedback, Options, SkipLevels, Step, Structures, Sync, check,
};
use crate::diag::Diagnostic;
use crate::machine::{Machine, Override};
use crate::source::{MemorySources, Sources};
use kontur_motion::block::Block;
use std::sync::Arc;

/// The machine compiled in: X, Y, Z and a spindle, 1 ms.
pub(super) fn machine(settings: &[&str]) -> Arc<Machine> {
    let settings: Vec<_> = settings.iter().map(|s| Override::parse(s).unwrap()).collect();
    Arc::new(Machine::builtin(&settings).unwrap().0)
}

/// Results of a program.
pub(super) struct Run {
    pub(super) steps: Vec<Step>,
    pub(super) diagnostics: Vec<Diagnostic>,
    pub(super) end: Vec<f64>,
}

impl Run {
    /// IDs, in the order in which they were raised.
    pub(super) fn ids(&self) -> Vec<String> {
        ids(&self.diagnostics)
    }

    /// Motion blocks.
    pub(super) fn blocks(&self) -> Vec<&Block> {
        self.steps
            .iter()
            .filter_map(|s| match s {
                Step::Motion { block, .. } => Some(&**block),
                _ => None,
            })
            .collect()
    }

    /// End points of the motions.
    pub(super) fn ends(&self) -> Vec<Vec<f64>> {
        self.blocks().iter().map(|b| b.path.end().to_vec()).collect()
    }

    pub(super) fn syncs(&self) -> Vec<&Sync> {
        self.steps
            .iter()
            .filter_map(|s| match s {
                Step::Sync { what, .. } => Some(what),
                _ => None,
            })
            .collect()
    }

    pub(super) fn events(&self) -> Vec<&Event> {
        self.steps
            .iter()
            .flat_map(|s| match s {
                Step::Motion { events, .. }
                | Step::Sync { events, .. }
                | Step::End { events, .. } => events,
            })
            .collect()
    }

    pub(super) fn reason(&self) -> EndReason {
        match self.steps.last() {
            Some(Step::End { reason, .. }) => *reason,
            _ => panic!("no end"),
        }
    }

    /// Texts of `#MSG`.
    pub(super) fn messages(&self) -> Vec<&str> {
        self.events()
            .into_iter()
            .filter_map(|e| match e {
                Event::Message { text, .. } => Some(text.as_str()),
                _ => None,
            })
            .collect()
    }
}

pub(super) fn ids(diagnostics: &[Diagnostic]) -> Vec<String> {
    diagnostics.iter().map(|d| d.id.to_string()).collect()
}

/// `ID line:column` of every diagnostic.
pub(super) fn places(diagnostics: &[Diagnostic]) -> Vec<String> {
    let place = |d: &Diagnostic| {
        d.source.as_ref().map_or(String::new(), |l| format!(" {}:{}", l.line, l.column))
    };
    diagnostics.iter().map(|d| format!("{}{}", d.id, place(d))).collect()
}

pub(super) fn run_with(
    sources: impl Sources + 'static,
    machine: Arc<Machine>,
    options: Options,
) -> Run {
    let mut executor =
        Executor::new(Arc::new(sources), "main.nc", machine, options, Structures::default());
    let mut steps = Vec::new();
    loop {
        let feedback = Feedback { actual_mm: executor.target().clone(), ..Feedback::default() };
        let step = executor.next(feedback.into());
        let ended = matches!(step, Step::End { .. });
        steps.push(step);
        if ended {
            break;
        }
    }
    let end = executor.target().to_vec();
    Run { steps, diagnostics: executor.take_diagnostics(), end }
}

/// Runs a text on the built-in machine.
pub(super) fn run(text: &str) -> Run {
    run_on(&[], text)
}

/// Runs a text on the built-in machine with different settings.
pub(super) fn run_on(settings: &[&str], text: &str) -> Run {
    run_with(MemorySources::new().with("main.nc", text), machine(settings), Options::default())
}

/// Runs a text without diagnostics; any diagnostic fails the test.
pub(super) fn clean(text: &str) -> Run {
    let run = run(text);
    assert!(run.diagnostics.is_empty(), "{text}: {:?}", shown(&run.diagnostics));
    run
}

pub(super) fn shown(diagnostics: &[Diagnostic]) -> Vec<String> {
    diagnostics.iter().map(|d| format!("{} {}", d.id, d.text)).collect()
}

/// Diagnostics of the syntax check.
pub(super) fn checked(text: &str) -> Vec<Diagnostic> {
    let sources = MemorySources::new().with("main.nc", text);
    check(Arc::new(sources), "main.nc", machine(&[]), Options::default()).0.diagnostics
}

#[track_caller]
pub(super) fn assert_near(actual: &[f64], expected: &[f64]) {
    let near = actual.len() == expected.len()
        && actual.iter().zip(expected).all(|(a, e)| (a - e).abs() < 1e-9);
    assert!(near, "{actual:?} instead of {expected:?}");
}

/// End position of a text, to which M30 is appended.
#[track_caller]
pub(super) fn assert_end(text: &str, expected: [f64; 3]) {
    assert_near(&clean(&format!("{text}\nM30\n")).end, &expected);
}

pub(super) fn skipping(text: &str, levels: &[u8]) -> Run {
    let skip = levels.iter().fold(SkipLevels::NONE, |s, l| s.with(*l));
    let options = Options { skip, ..Options::default() };
    run_with(MemorySources::new().with("main.nc", text), machine(&[]), options)
}
