//! The picture of a sweep: results over the first parameter, one curve for each combination of the others.

use super::Vary;
use super::rows::Rows;
use crate::args::SweepArgs;
use crate::chart::plot::Plot;
use crate::chart::scale::{Scale, around, of_column};
use crate::chart::view::{Line, Points, View};
use crate::error::Error;
use crate::table::Cell;
use kontur_interpreter::summary::State;

/// Results that are drawn if none are given.
const USUAL: [&str; 2] = ["duration_s", "contour_err_mm"];
/// More curves than this cannot be distinguished.
const MOST_CURVES: usize = 18;

/// A combination of all parameters except the first.
struct Series<'a> {
    rest: &'a [usize],
    /// Value of the first parameter, and the row, in increasing order of the value.
    points: Vec<(f64, usize)>,
}

/// Draws the results.
///
/// # Errors
/// [`Error::Usage`] if there are too many curves.
pub(super) fn draw(
    args: &SweepArgs,
    combinations: &[Vec<usize>],
    rows: &Rows,
) -> Result<String, Error> {
    let (first, others) = args.vary.split_first().ok_or_else(|| {
        Error::Usage("use --vary to select the horizontal axis of the picture".to_owned())
    })?;
    // a mode is not a quantity, even if it has a number
    let numbers = first.numbers().filter(|_| !first.is_choice());
    let is_choice = numbers.is_none();
    let values =
        numbers.unwrap_or_else(|| (0_u32..).map(f64::from).take(first.values.len()).collect());
    let series = series_of(combinations, &values);
    if series.len() > MOST_CURVES {
        let text = format!("--vary: {} curves in a picture, maximum: {MOST_CURVES}", series.len());
        return Err(Error::Usage(text));
    }
    // the first result column follows the parameters
    let state = args.vary.len();
    let finished =
        |row: usize| rows.cells[row][state] == Cell::Word(State::Finished.name().to_owned());
    let legend = legend(&series, others, finished);
    let panels = rows.header.iter().enumerate().filter(|(_, name)| is_drawn(args, name)).map(
        |(column, name)| {
            // values of an aborted run are not results
            let value = |row: usize| {
                rows.cells[row][column].number().filter(|_| finished(row)).unwrap_or(f64::NAN)
            };
            let line = |(number, s): (usize, &Series<'_>)| {
                let points = s.points.iter().map(|&(x, row)| [x, value(row)]).collect();
                Line::series(number, points)
            };
            let lines: Vec<Line<Points>> = series.iter().enumerate().map(line).collect();
            let x = if is_choice {
                Scale::categories(first.key.clone(), first.values.clone())
            } else {
                Scale::linear(first.label(), around(values.iter().copied(), 1e-9))
            };
            let y = around(lines.iter().flat_map(|l| &l.points).map(|p| p[1]).chain([0.0]), 1e-9);
            View {
                title: name.clone(),
                x,
                y: Scale::linear(of_column(name), y),
                lines,
                ..View::default()
            }
        },
    );
    let panels = panels.collect();
    let plot = Plot {
        title: rows.title.clone(),
        subtitle: format!("over {}; {} runs", first.key, rows.cells.len()),
        legend,
        columns: 1,
        row_height: 340.0,
        panels,
    };
    Ok(plot.draw())
}

/// Whether a column has a panel.
fn is_drawn(args: &SweepArgs, name: &String) -> bool {
    if args.columns.is_empty() {
        USUAL.contains(&name.as_str()) || args.amplitude.iter().any(|a| a.text == *name)
    } else {
        args.columns.contains(name)
    }
}

/// The runs by the values of all parameters but the first one, whose `values` are the abscissas.
fn series_of<'a>(combinations: &'a [Vec<usize>], values: &[f64]) -> Vec<Series<'a>> {
    let mut series: Vec<Series<'_>> = Vec::new();
    for (row, combination) in combinations.iter().enumerate() {
        let (&i, rest) = combination.split_first().unwrap_or((&0, &[]));
        let point = (values[i], row);
        match series.iter_mut().find(|s| s.rest == rest) {
            Some(s) => s.points.push(point),
            None => series.push(Series { rest, points: vec![point] }),
        }
    }
    for s in &mut series {
        s.points.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    series
}

/// Names of the series by the values of their parameters, and where their runs end; none if there is nothing to name.
fn legend(
    series: &[Series<'_>],
    others: &[Vary],
    finished: impl Fn(usize) -> bool + Copy,
) -> Vec<String> {
    let name = |s: &Series<'_>| {
        let names =
            others.iter().zip(s.rest).map(|(v, &i)| format!("{} = {}", v.short(), v.values[i]));
        let name = names.collect::<Vec<_>>().join(", ");
        let Some(end) = end(s, finished) else { return name };
        let comma = if name.is_empty() { "" } else { ": " };
        format!("{name}{comma}{end}")
    };
    let legend: Vec<String> = series.iter().map(name).collect();
    if legend.iter().all(String::is_empty) { Vec::new() } else { legend }
}

/// The value up to which the runs of a series finish, if some do not.
fn end(series: &Series<'_>, finished: impl Fn(usize) -> bool) -> Option<String> {
    let aborted = series.points.iter().find(|p| !finished(p.1))?;
    let last = series.points.iter().rev().find(|p| finished(p.1));
    Some(match last {
        None => "every run aborted".to_owned(),
        Some(last) if last.0 < aborted.0 => {
            format!("finished up to {}, aborted from {} on", last.0, aborted.0)
        }
        Some(last) => format!("finished up to {}, some runs below aborted", last.0),
    })
}
