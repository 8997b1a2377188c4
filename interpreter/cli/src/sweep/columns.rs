//! The rows of a sweep: parameters, end of the run, results.

use super::rows::Outcome;
use crate::args::SweepArgs;
use crate::combinations::values;
use crate::table::Cell;
use kontur_interpreter::summary::Summary;

/// The columns of every row after its parameters.
pub(super) const STATE: [&str; 3] = ["state", "error", "warnings"];

/// The row of a run with its header: parameters, state, ID of the first error, number of warnings, and the requested
/// results.
///
/// # Errors
/// The names of all results, if an unknown one was requested.
pub(super) fn row(
    args: &SweepArgs,
    combination: &[usize],
    outcome: &Outcome,
) -> Result<(Vec<String>, Vec<Cell>), String> {
    let results = results(args, outcome);
    if let Some(unknown) =
        args.columns.iter().find(|wanted| !results.iter().any(|(name, _)| name == *wanted))
    {
        let known: Vec<&str> = results.iter().map(|(name, _)| name.as_str()).collect();
        let known = known.join(", ");
        return Err(format!("--columns: `{unknown}` is not a result; the results are {known}"));
    }
    let mut header: Vec<String> = args.vary.iter().map(|v| v.key.clone()).collect();
    header.extend(STATE.map(str::to_owned));
    let mut row: Vec<Cell> =
        values(&args.vary, combination).iter().map(|text| value(text)).collect();
    row.extend(state(&outcome.summary));
    // a result with a separate option is always included
    let measured = |name: &String| args.amplitude.iter().any(|a| a.text == *name);
    let wanted =
        |name: &String| args.columns.is_empty() || args.columns.contains(name) || measured(name);
    for (name, cell) in results.into_iter().filter(|(name, _)| wanted(name)) {
        header.push(name);
        row.push(cell);
    }
    Ok((header, row))
}

/// A parameter as a number if it is one, with the decimals as given.
fn value(text: &str) -> Cell {
    let decimals = text.split_once('.').map_or(0, |(_, behind)| behind.len());
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && !text.contains(['e', 'E']) => Cell::Number(x, decimals),
        _ => Cell::Word(text.to_owned()),
    }
}

fn state(summary: &Summary) -> [Cell; 3] {
    [
        Cell::Word(summary.state.name().to_owned()),
        Cell::Word(summary.first_error().map_or_else(String::new, |id| id.to_string())),
        Cell::Number(summary.warnings() as f64, 0),
    ]
}

/// All results of a run.
fn results(args: &SweepArgs, outcome: &Outcome) -> Vec<(String, Cell)> {
    let measures = outcome.summary.results().into_iter();
    let mut all: Vec<(String, Cell)> =
        measures.map(|m| (m.name, Cell::Number(m.value, m.decimals))).collect();
    let amplitudes = args.amplitude.iter().zip(&outcome.amplitudes);
    all.extend(amplitudes.map(|(a, &x)| (a.text.clone(), Cell::Number(x, 6))));
    all
}
