//! Reading the reference data; comparing with what it prints.

use std::collections::BTreeMap;

/// One row of a CSV file, by column name.
#[derive(Debug)]
pub(crate) struct Row(BTreeMap<String, String>);

impl Row {
    /// The text of a column.
    pub(crate) fn text(&self, column: &str) -> &str {
        self.0.get(column).unwrap_or_else(|| panic!("no column {column}"))
    }

    /// The number of a column.
    pub(crate) fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or_else(|_| panic!("{column} of {self:?} is no number"))
    }

    /// The number of a column, `None` if it is empty.
    pub(crate) fn optional(&self, column: &str) -> Option<f64> {
        (!self.text(column).is_empty()).then(|| self.number(column))
    }
}

/// All rows of `tests/data/<name>.csv`.
pub(crate) fn rows(name: &str) -> Vec<Row> {
    let path = format!("{}/tests/data/{name}.csv", env!("CARGO_MANIFEST_DIR"));
    let mut reader = csv::Reader::from_path(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let rows: Vec<Row> = reader.deserialize().map(|row| Row(row.unwrap())).collect();
    assert!(!rows.is_empty(), "{path} is empty");
    rows
}

/// Fails with `what` unless `|is - want| <= tolerance`.
#[track_caller]
pub(crate) fn assert_close(is: f64, want: f64, tolerance: f64, what: &dyn std::fmt::Debug) {
    assert!((is - want).abs() <= tolerance, "{is:e} is not {want:e} +- {tolerance:e}: {what:?}");
}
