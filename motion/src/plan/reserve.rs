//! The reserve: what remains of the most recent plan, from the start to rest.
//!
//! It is driven only where no new plan can start from the present state. Otherwise the next plan replaces it, so entries far ahead
//! are made of its spans only once somebody needs them.

use crate::lookahead::Span;
use crate::queue::Queued;
use crate::timeline::{Entry, Moment};
use std::collections::VecDeque;
use std::sync::Arc;

/// The remaining entries of a plan, and the spans behind them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reserve {
    pub(crate) entries: VecDeque<Entry>,
    later: Later,
}

/// Spans of a plan that have not become entries. They follow each other without a stop, at the speeds of their blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Later {
    /// By the number of their blocks in the plan.
    spans: Vec<Span>,
    /// Start of the first one, as moment and as path length of the program in mm.
    at: Moment,
    s_mm: f64,
}

impl Later {
    /// The spans after a moment and a path length of the program in mm.
    pub(super) fn new(spans: &[Span], at: Moment, s_mm: f64) -> Self {
        Self { spans: spans.to_vec(), at, s_mm }
    }
}

impl From<Vec<Entry>> for Reserve {
    fn from(entries: Vec<Entry>) -> Self {
        Self { entries: entries.into(), later: Later::default() }
    }
}

impl Reserve {
    /// What remains of a plan after its first `passed` blocks.
    pub(crate) fn new(entries: VecDeque<Entry>, mut later: Later, passed: usize) -> Self {
        for span in &mut later.spans {
            (span.first, span.end) = (span.first - passed, span.end - passed);
        }
        Self { entries, later }
    }

    /// Makes entries of all spans; `blocks` are those of the reserve from the first one on, and possibly more.
    pub(super) fn place<'a>(&mut self, blocks: impl Iterator<Item = &'a Arc<Queued>>) {
        let Later { spans, mut at, mut s_mm } = std::mem::take(&mut self.later);
        let Some(last) = spans.last() else { return };
        let window: Vec<Arc<Queued>> = blocks.take(last.end).cloned().collect();
        for span in &spans {
            let entry = Entry::new(at, s_mm, span, &window, false);
            at = entry.end;
            s_mm += span.profile.length();
            self.entries.push_back(entry);
        }
    }
}
