//! The rows of a sweep: parameters, how the run ended, results.

use super::args::SweepArgs;
use super::{Outcome, Rows};
use crate::Error;
use crate::summary::{AxisSummary, State, Summary};
use crate::table::number;
use kontur_interpreter::diag::{Diagnostic, Severity};

/// A value of a row.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cell {
    /// Not finite: nothing.
    Number(f64, usize),
    Word(String),
}

impl Cell {
    /// As it stands in a text table.
    pub(super) fn text(&self) -> String {
        match self {
            Self::Number(value, decimals) => number(*value, *decimals),
            Self::Word(word) => word.clone(),
        }
    }

    /// The number, if it is one.
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value, _) => Some(*value),
            Self::Word(_) => None,
        }
    }
}

/// What every row has behind its parameters.
const STATE: [&str; 3] = ["state", "error", "warnings"];

/// A result of an axis: word, suffix behind the unit, value, decimals.
type OfAxis = (&'static str, &'static str, fn(&AxisSummary) -> f64, usize);

const OF_AXIS: [OfAxis; 6] = [
    ("vel", "_s", |a| a.max_vel, 6),
    ("acc", "_s2", |a| a.max_acc, 4),
    ("jerk", "_s3", |a| a.max_jerk, 2),
    ("err", "", |a| a.max_err, 7),
    ("dev", "", |a| a.max_dev, 7),
    ("lag", "", |a| a.max_lag, 7),
];

/// The rows: parameters, state, ID of the first error, number of warnings, and the results that were asked for.
///
/// # Errors
/// [`Error::Usage`] for the name of a result that does not exist.
pub(super) fn rows(
    args: &SweepArgs,
    combinations: &[Vec<usize>],
    outcomes: &[Outcome],
) -> Result<Rows, Error> {
    let results: Vec<Vec<(String, Cell)>> = outcomes.iter().map(|o| results(args, o)).collect();
    let names: Vec<&String> = results
        .first()
        .map(|first| first.iter().map(|(name, _)| name).collect())
        .unwrap_or_default();
    if let Some(unknown) = args.columns.iter().find(|wanted| !names.contains(wanted)) {
        let known: Vec<&str> = names.iter().map(|n| n.as_str()).collect();
        let text = format!("--columns: `{unknown}` is no result; they are {}", known.join(", "));
        return Err(Error::Usage(text));
    }
    let wanted = |name: &String| args.columns.is_empty() || args.columns.contains(name);
    let mut header: Vec<String> = args.vary.iter().map(|v| v.key.clone()).collect();
    header.extend(STATE.map(str::to_owned));
    header.extend(names.into_iter().filter(|name| wanted(name)).cloned());
    let mut cells = Vec::with_capacity(outcomes.len());
    for ((combination, outcome), results) in combinations.iter().zip(outcomes).zip(&results) {
        let values = args.vary.iter().zip(combination).map(|(v, &i)| value(&v.values[i]));
        let mut row: Vec<Cell> = values.collect();
        row.extend(state(&outcome.summary));
        row.extend(results.iter().filter(|(name, _)| wanted(name)).map(|(_, cell)| cell.clone()));
        cells.push(row);
    }
    Ok(Rows { header, cells })
}

/// A parameter as a number if it is one, with the decimals that it was given with.
fn value(text: &str) -> Cell {
    let decimals = text.split_once('.').map_or(0, |(_, behind)| behind.len());
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && !text.contains(['e', 'E']) => Cell::Number(x, decimals),
        _ => Cell::Word(text.to_owned()),
    }
}

fn state(summary: &Summary) -> [Cell; 3] {
    let word = if summary.state == State::Finished { "finished" } else { "aborted" };
    let error = summary.messages.iter().find(|m| m.is_error());
    let warnings = summary.messages.iter().filter(|m| m.severity == Severity::Warning).count();
    [
        Cell::Word(word.to_owned()),
        Cell::Word(error.map_or_else(String::new, |m: &Diagnostic| m.id.to_string())),
        Cell::Number(warnings as f64, 0),
    ]
}

/// Everything that a run results in.
fn results(args: &SweepArgs, outcome: &Outcome) -> Vec<(String, Cell)> {
    let s = &outcome.summary;
    let mut all = vec![
        ("cycles".to_owned(), Cell::Number(s.cycles as f64, 0)),
        ("duration_s".to_owned(), Cell::Number(s.duration_s, 6)),
        ("ideal_duration_s".to_owned(), Cell::Number(s.ideal_duration_s, 6)),
        ("path_mm".to_owned(), Cell::Number(s.path_length_mm, 7)),
    ];
    let error = s.max_contour_error.as_ref().map_or(f64::NAN, |e| e.mm);
    all.push(("contour_err_mm".to_owned(), Cell::Number(error, 7)));
    for axis in &s.axes {
        for (word, suffix, of, decimals) in OF_AXIS {
            let name = format!("{}_{word}_max_{}{suffix}", axis.name, axis.unit);
            all.push((name, Cell::Number(of(axis), decimals)));
        }
    }
    let limits = s.time_by_v_limit_s.iter();
    all.extend(limits.map(|(name, time)| (format!("{name}_time_s"), Cell::Number(*time, 6))));
    let amplitudes = args.amplitude.iter().zip(&outcome.amplitudes);
    all.extend(amplitudes.map(|(a, &x)| (a.text.clone(), Cell::Number(x, 6))));
    all
}
