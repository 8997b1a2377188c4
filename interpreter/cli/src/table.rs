//! Tables of results as CSV: one header line, decimal points, an empty cell where there is no number.

use crate::Error;

/// Rows of text under a header.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table.
    pub(crate) fn new(header: &[&str]) -> Self {
        Self { header: header.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    /// Adds a row; it has a cell for each column.
    pub(crate) fn push(&mut self, row: Vec<String>) {
        debug_assert_eq!(row.len(), self.header.len());
        self.rows.push(row);
    }

    /// The file: cells that hold commas or quotes are quoted.
    pub(crate) fn csv(&self) -> String {
        self.write().unwrap_or_default()
    }

    fn write(&self) -> Result<String, Error> {
        let wrong = |e: std::io::Error| Error::io("table", e);
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in std::iter::once(&self.header).chain(&self.rows) {
            writer.write_record(row).map_err(|e| wrong(e.into()))?;
        }
        let bytes = writer.into_inner().map_err(|e| wrong(e.into_error()))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// The readable form: columns of numbers aligned at their right ends, the others at their left.
    pub(crate) fn text(&self) -> String {
        let width = |i: usize| {
            let cells = self.rows.iter().map(|row| &row[i]).chain([&self.header[i]]);
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let numbers = |i: usize| {
            let first = self.rows.iter().find_map(|row| row[i].chars().next());
            i > 0 && first.is_some_and(|c| c.is_ascii_digit() || "+-".contains(c))
        };
        let columns: Vec<(usize, bool)> =
            (0..self.header.len()).map(|i| (width(i), numbers(i))).collect();
        let mut out = String::new();
        for row in std::iter::once(&self.header).chain(&self.rows) {
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

/// A number with so many decimals; nothing if it is not finite, and no minus before a zero.
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
