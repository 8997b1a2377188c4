//! Tables of results, and their form as CSV: one header line, decimal points, an empty cell where there is no number.
//!
//! Returned by [`response`](crate::response::table) and [`tune`](crate::tune::answer), read row by row.
//!
//! ```
//! use clap::Parser as _;
//! use kontur::args::{Args, Command};
//! use kontur::console::Console;
//!
//! let words = ["kontur", "response", "--guard", "FREQ=40"];
//! let Command::Response(args) = Args::try_parse_from(words)?.command else { unreachable!() };
//! let mut console = Console::new(std::io::sink(), std::io::sink());
//! let table = kontur::response::table(&args, &mut console).unwrap();
//! assert!(table.rows().iter().all(|row| row.len() == table.header().len()));
//! # Ok::<(), clap::Error>(())
//! ```

use crate::error::Error;
use serde::{Deserialize, Serialize};

/// A value of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Cell {
    /// With its decimals in a text table; empty if not finite.
    Number(#[serde(with = "bits")] f64, usize),
    /// A number as given, with its digits.
    Given(#[serde(with = "bits")] f64),
    /// A text.
    Word(String),
}

impl Cell {
    /// No number.
    pub(crate) const NOTHING: Self = Self::Number(f64::NAN, 0);

    /// As it appears in a text table.
    pub fn text(&self) -> String {
        match self {
            Self::Number(value, decimals) => number(*value, *decimals),
            Self::Given(value) => value.to_string(),
            Self::Word(word) => word.clone(),
        }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value, _) | Self::Given(value) => Some(*value),
            Self::Word(_) => None,
        }
    }
}

impl From<u32> for Cell {
    fn from(count: u32) -> Self {
        Self::Given(f64::from(count))
    }
}

impl From<String> for Cell {
    fn from(word: String) -> Self {
        Self::Word(word)
    }
}

/// A number as its bits, because its text need not give the same number again.
mod bits {
    use serde::{Deserialize as _, Deserializer, Serializer};

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "the form that serde asks for")]
    pub(super) fn serialize<S: Serializer>(x: &f64, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_u64(x.to_bits())
    }

    pub(super) fn deserialize<'d, D: Deserializer<'d>>(from: D) -> Result<f64, D::Error> {
        u64::deserialize(from).map(f64::from_bits)
    }
}

/// Rows under a header.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table.
    pub(crate) fn new(header: &[&str]) -> Self {
        Self { header: header.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    /// Adds a row; it has a cell for each column.
    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = impl Into<Cell>>) {
        let row: Vec<Cell> = row.into_iter().map(Into::into).collect();
        debug_assert_eq!(row.len(), self.header.len());
        self.rows.push(row);
    }

    /// Names of the columns.
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// The rows; each has a cell for every column.
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// Every cell as text.
    fn texts(&self) -> Vec<Vec<String>> {
        self.rows.iter().map(|row| row.iter().map(Cell::text).collect()).collect()
    }

    /// The table as CSV; cells with commas or quotes are quoted.
    pub(crate) fn csv(&self) -> String {
        self.write().unwrap_or_default()
    }

    fn write(&self) -> Result<String, Error> {
        let wrong = |e: std::io::Error| Error::io("table", e);
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.header).map_err(|e| wrong(e.into()))?;
        for row in &self.rows {
            writer.write_record(row.iter().map(Cell::text)).map_err(|e| wrong(e.into()))?;
        }
        let bytes = writer.into_inner().map_err(|e| wrong(e.into_error()))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// The table as text: columns of numbers are right-aligned, the others left-aligned.
    pub(crate) fn text(&self) -> String {
        let rows = self.texts();
        let width = |i: usize| {
            let cells = rows.iter().map(|row| &row[i]).chain([&self.header[i]]);
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let numbers = |i: usize| {
            let first = rows.iter().find_map(|row| row[i].chars().next());
            i > 0 && first.is_some_and(|c| c.is_ascii_digit() || "+-".contains(c))
        };
        let columns: Vec<(usize, bool)> =
            (0..self.header.len()).map(|i| (width(i), numbers(i))).collect();
        let mut out = String::new();
        for row in std::iter::once(&self.header).chain(&rows) {
            let cells = row.iter().zip(&columns).map(|(cell, (width, right))| {
                let padding = " ".repeat(width - cell.chars().count());
                if *right { format!("{padding}{cell}") } else { format!("{cell}{padding}") }
            });
            out.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
            out.push('\n');
        }
        out
    }
}

/// A number with this number of decimals; empty if it is not finite, and without a minus before zero.
pub(crate) fn number(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return String::new();
    }
    let text = format!("{value:.decimals$}");
    let zero = text.trim_start_matches(['-', '0', '.']).is_empty();
    if zero { text.trim_start_matches('-').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_with_commas_are_quoted() {
        let mut table = Table::new(&["name", "value"]);
        table.push(vec!["a, b".to_owned(), number(-0.0001, 2)]);
        table.push(vec!["c".to_owned(), number(f64::NEG_INFINITY, 2)]);
        assert_eq!(table.csv(), "name,value\n\"a, b\",0.00\nc,\n");
        assert_eq!(table.text(), "name  value\na, b   0.00\nc\n");
    }
}
