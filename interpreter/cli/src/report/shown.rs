//! Content of a view of the report, and names and colours of its lines.

use super::drawn::Drawn;
use crate::chart::style::{DASHES, Style};
use crate::chart::view::{Points, View};
use serde::Serialize;

/// Kind of contour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Contour {
    Programmed,
    Set,
    Act,
}

/// Source of the points of a line.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Source {
    /// A contour of a run, or of one pass of it.
    Contour { what: Contour, run: usize, pass: Option<usize> },
    /// A curve of a run over time.
    Curve { run: usize, curve: usize, pass: Option<usize> },
    /// The deflection of the spring-mass model of an axis.
    Spring { run: usize, axis: usize },
    /// The points themselves.
    Given { run: usize, axis: usize, points: Points },
}

/// A view with its initial state on a page.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Shown {
    pub(super) kind: &'static str,
    pub(super) open: bool,
    /// Text below it.
    pub(super) note: String,
    pub(super) view: View<Source>,
}

/// Time in s of the first and the last drawn cycle.
pub(super) fn span(runs: &[Drawn]) -> (f64, f64) {
    let times = runs
        .iter()
        .map(|r| &r.recording)
        .filter_map(|r| Some((r.seconds(r.buckets.first()?.k), r.seconds(r.buckets.last()?.last))));
    let (from, to) =
        times.fold((f64::INFINITY, 0.0), |m: (f64, f64), t| (m.0.min(t.0), m.1.max(t.1)));
    if from < to { (from, to) } else { (0.0, 1e-6) }
}

/// Colour and dashes of an axis of a run.
pub(super) fn style(runs: &[Drawn], run: usize, axis: Option<usize>) -> Style {
    let Some(axis) = axis else { return Style::series(run) };
    // the contour of a single run has the first colour
    let colour = if runs.len() > 1 { run } else { axis + 1 };
    Style::series(colour).dashed(DASHES[axis % DASHES.len()])
}

/// A name, with its run if there are several.
pub(super) fn name(runs: &[Drawn], run: usize, name: &str) -> String {
    if runs.len() > 1 { format!("{} {name}", short(runs, run)) } else { name.to_owned() }
}

/// The part of a name that distinguishes a run from the others: without folders, program or parameters with which all
/// of them begin.
pub(super) fn short(runs: &[Drawn], run: usize) -> &str {
    let names: Vec<&str> = runs.iter().map(|r| r.summary.program.as_str()).collect();
    names.get(run).map_or("", |name| &name[common(&names)..])
}

/// Length in bytes of the whole parts with which all names begin, unless a name consists of nothing else.
fn common(names: &[&str]) -> usize {
    let Some((first, others)) = names.split_first() else { return 0 };
    // a blank inside `kv = 5` is not a separator
    let ends = first.char_indices().filter(|(i, c)| match c {
        '/' | '\\' => true,
        c => *c == ' ' && first[..*i].ends_with(','),
    });
    let shared = |end: &usize| others.iter().all(|o| o.starts_with(&first[..*end]));
    ends.map(|(i, _)| i + 1).rfind(shared).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_named_by_what_tells_them_apart() {
        let rest = |names: [&'static str; 2]| names.map(|name| &name[common(&names)..]);
        for (names, short) in [
            (["p/a.nc, HZ = 20", "p/a.nc, HZ = 40"], ["HZ = 20", "HZ = 40"]),
            (["p/a.nc, m = 1, f = 2", "p/a.nc, m = 1, f = 3"], ["f = 2", "f = 3"]),
            (["p/a.nc", "p/b.nc"], ["a.nc", "b.nc"]),
            (["p\\a.nc", "q\\a.nc"], ["p\\a.nc", "q\\a.nc"]),
            (["a.nc", "a.nc"], ["a.nc", "a.nc"]),
        ] {
            assert_eq!(rest(names), short);
        }
    }
}
