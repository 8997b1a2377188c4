//! The places at which the last plan exceeded the tolerance, where the next plan is measured first.
//!
//! A round of planning answers the excesses of the last plan, and most answers are not sufficient at once. As long as one
//! of these places still exceeds the tolerance, the remainder of the plan need not be known: its measurement would take
//! most of the time, because a new speed of one block changes the whole profile, and with filters that differ between
//! the axes every set point can leave the contour.

use super::Trial;
use super::ranges::joined;
use super::set_points::SetPoints;
use super::view::View;
use super::violation::{Record, Violation};
use crate::deviation::Unkept;
use crate::timeline::Entry;

/// How many plans in a row are measured at these places only; then the whole plan is measured again.
const ROUNDS: u32 = 12;
/// How much shorter these places have to be than the changes of the plan.
const SHORTER: u64 = 4;

/// Places at which a plan exceeded the tolerance.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    /// First and last path length in mm that the filters held at each excess.
    held: Vec<(f64, f64)>,
    /// How many plans in a row have been measured at these places only.
    rounds: u32,
}

impl Places {
    /// Adds the place of an excess.
    pub(super) fn add(&mut self, v: &Violation, record: &Record, length: u32) {
        let oldest = v.cycle.saturating_sub(u64::from(length) + 1);
        self.held.push((record.s(oldest), record.s(v.cycle)));
    }

    /// Replaces these places by those of the next plan; `only`: it has not been measured elsewhere.
    pub(super) fn follow(&mut self, next: Vec<(f64, f64)>, only: bool) {
        self.rounds = if only { self.rounds + 1 } else { 0 };
        self.held = next;
    }

    /// The path lengths of the places.
    pub(super) fn take(self) -> Vec<(f64, f64)> {
        self.held
    }
}

impl View<'_> {
    /// Measures a plan where the last one exceeded the tolerance; otherwise as [`Self::search`]. `None` as well if that
    /// is most of the changes.
    pub(super) fn search_again<'v>(
        &'v self,
        places: &Places,
        is_new: impl Fn(&Entry) -> bool,
        points: &mut SetPoints<'v>,
        found: impl FnMut(&Violation, &Record),
    ) -> Option<Unkept> {
        let Self { trial, .. } = self;
        if places.held.is_empty() || places.rounds >= ROUNDS || !trial.kernels.differ() {
            return None;
        }
        let reach = 2 * u64::from(trial.kernels.length()) + 5;
        let cycles = places.held.iter().map(|held| {
            let (from, to) = trial.passes(*held);
            ((from as u64).saturating_sub(3).max(trial.now + 1), to.ceil() as u64 + reach)
        });
        let among = joined(cycles.filter(|(from, to)| from <= to).collect(), 0);
        let total = |ranges: &[(u64, u64)]| ranges.iter().map(|(a, b)| b - a + 1).sum::<u64>();
        if SHORTER * total(&among) > total(&trial.shown_by(is_new)) {
            return None;
        }
        self.search(&among, points, found)
    }
}

impl Trial<'_> {
    /// Times in cycles at which the path reaches the first of two path lengths and leaves the second one.
    fn passes(&self, (from, to): (f64, f64)) -> (f64, f64) {
        let at = |e: &Entry, s: f64| {
            e.start.cycles(self.cycle)
                + e.profile.time_at((s - e.s0).max(0.0)) / self.cycle.seconds()
        };
        let entries = || self.timeline.entries().chain(self.plan);
        let first = entries().find(|e| e.s0 + e.profile.length() >= from);
        let last = entries().take_while(|e| e.s0 <= to).last();
        let [first, last] =
            [(first, from), (last, to)].map(|(e, s)| e.map_or(self.now as f64, |e| at(e, s)));
        (first, last.max(first))
    }
}
