//! Parameters without influence on any row.

use super::columns;
use crate::args::Vary;
use crate::combinations::without_effect;
use crate::table::Cell;
use kontur_interpreter::summary::State;

/// Whether the run of a row finished.
pub(super) fn is_finished(vary: &[Vary], row: &[Cell]) -> bool {
    matches!(&row[vary.len()], Cell::Word(state) if state == State::Finished.name())
}

/// Keys of parameters without influence on any row. Empty if every run has ended with an error, since such rows are
/// alike for that reason.
pub(super) fn idle<'v>(
    vary: &'v [Vary],
    combinations: &[Vec<usize>],
    rows: &[Vec<Cell>],
) -> Vec<&'v str> {
    if !rows.iter().any(|row| is_finished(vary, row)) {
        return Vec::new();
    }
    // a result that is missing in every row is not informative; missing in some rows it is a result like any other
    let first = vary.len() + columns::STATE.len();
    let told: Vec<usize> =
        (first..rows[0].len()).filter(|c| rows.iter().any(|row| is_there(&row[*c]))).collect();
    if told.is_empty() {
        return Vec::new();
    }
    let result = |cell: &Cell| match cell.number() {
        Some(x) => (Some(x).filter(|x| x.is_finite()), String::new()),
        None => (None, cell.text()),
    };
    let state = vary.len()..first;
    let columns = || state.clone().chain(told.iter().copied());
    let results: Vec<Vec<_>> =
        rows.iter().map(|row| columns().map(|c| result(&row[c])).collect()).collect();
    without_effect(vary, combinations, &results).iter().map(|v| v.key.as_str()).collect()
}

/// Whether a run has this result: a text, or a number.
pub(super) fn is_there(cell: &Cell) -> bool {
    cell.number().is_none_or(f64::is_finite)
}
