//! A comparison as text.

use super::compare::{Difference, Outcome};
use kontur_interpreter::diag::render::printable;
use kontur_interpreter::source::text::beginning;
use std::fmt::Write as _;

pub(super) fn text(names: &[String; 2], outcome: &Outcome) -> String {
    let mut out = String::new();
    // writing to a String cannot fail
    let _ = write_text(&mut out, names, outcome);
    out
}

/// Says which rows were left out because the other side has none at their times.
fn write_thinned(out: &mut String, o: &Outcome) -> std::fmt::Result {
    for (side, every) in ["A", "B"].into_iter().zip(o.every) {
        if every > 1 {
            writeln!(
                out,
                "  rows   compared at equal times: one of every {every} rows of {side}, which has more in the same time"
            )?;
        }
    }
    Ok(())
}

fn write_text(out: &mut String, [a, b]: &[String; 2], o: &Outcome) -> std::fmt::Result {
    if o.equal {
        writeln!(out, "equal: {} rows", o.rows_a)?;
        return write_thinned(out, o);
    }
    writeln!(out, "different: {a} (A) and {b} (B)")?;
    if let Some(first) = &o.first {
        writeln!(out, "  first  {}", sentence(first))?;
    }
    if let Some(worst) = &o.worst {
        writeln!(out, "  worst  {}", sentence(worst))?;
    }
    match [o.rows_a, o.rows_b] {
        [0, 0] => writeln!(out, "  rows   none in A and B, nothing is compared")?,
        [a, b] if a != b => writeln!(out, "  rows   {a} in A, {b} in B")?,
        _ => {}
    }
    write_thinned(out, o)?;
    if let Some(times) = o.columns.iter().find(|c| c.column == "t_s") {
        let Difference { row, a, b, .. } = &times.first;
        let (a, b) = (brief(a), brief(b));
        writeln!(
            out,
            "  times  row {row} is at {a} s in A and at {b} s in B: rows are compared by number, write both with the same cycle time and --decimate"
        )?;
    }
    for (side, columns) in [("A", &o.only_a), ("B", &o.only_b)] {
        if !columns.is_empty() {
            let columns: Vec<String> = columns.iter().map(|c| brief(c)).collect();
            writeln!(out, "  only in {side}: {}", columns.join(", "))?;
        }
    }
    if let Some(words) = shift(o) {
        writeln!(out, "  shift  {words}")?;
    }
    if !o.columns.is_empty() {
        writeln!(out, "  column               rows    largest difference, and the first")?;
    }
    for c in &o.columns {
        write!(out, "  {:<18} {:>6}", brief(&c.column), c.rows)?;
        match &c.worst {
            Some(d) if d.row == c.first.row => {
                writeln!(out, "    {} at {}", number(d.size), place(d))?;
            }
            Some(d) => {
                writeln!(out, "    {} at {}; from {}", number(d.size), place(d), place(&c.first))?;
            }
            None => writeln!(out, "    from {}", place(&c.first))?,
        }
    }
    Ok(())
}

/// A cell, shortened for a line of text.
pub(super) fn brief(cell: &str) -> String {
    beginning(&printable(cell).replace('\n', "\u{FFFD}"))
}

pub(super) fn number(difference: Option<f64>) -> String {
    difference.map_or_else(|| "-".to_owned(), |d| format!("{d:.3e}"))
}

pub(super) fn place(d: &Difference) -> String {
    let mut out = d
        .time_s
        .as_ref()
        .map_or_else(|| format!("row {}", d.row), |t| format!("t = {} s", brief(t)));
    if let Some(line) = &d.line {
        let _ = write!(out, ", line {}", brief(line));
    }
    if let Some(block) = d.block.as_ref().filter(|b| !b.is_empty()) {
        let _ = write!(out, " N{}", brief(block));
    }
    if let Some(file) = &d.file {
        let _ = write!(out, " of {}", brief(file));
    }
    out
}

pub(super) fn sentence(d: &Difference) -> String {
    let [column, a, b] = [&d.column, &d.a, &d.b].map(|text| brief(text));
    let mut out = format!("{}: {column} is {a} in A, {b} in B", place(d));
    if let (Some(difference), Some(tolerance)) = (d.size, d.tolerance) {
        let _ = write!(out, " (difference {difference:.3e}, tolerance {tolerance:e})");
    }
    out
}

/// The shift with which the rest is equal, as text.
pub(super) fn shift(o: &Outcome) -> Option<String> {
    let n = o.shift_cycles?;
    let side = if n > 0 { "earlier" } else { "later" };
    let rows = if n.abs() == 1 { "row" } else { "rows" };
    let but = if o.shift_leaves_texts { ", but for line, block, file or v_limit" } else { "" };
    let n = n.abs();
    Some(format!(
        "from the first difference of a number on equal if B is taken {n} {rows} {side}{but}"
    ))
}
