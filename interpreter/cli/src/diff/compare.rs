//! Compares two streams of rows and collects the findings.

use super::delay::Delays;
use crate::args::Tolerance;
use csv::ByteRecord;
use serde::Serialize;

/// One cell that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Difference {
    /// Row, from 0.
    pub(super) row: u64,
    /// Time as A prints it.
    pub(super) time_s: Option<String>,
    /// NC line active in A.
    pub(super) line: Option<String>,
    /// N number active in A.
    pub(super) block: Option<String>,
    /// File active in A.
    pub(super) file: Option<String>,
    /// Column.
    pub(super) column: String,
    /// Cell of A.
    pub(super) a: String,
    /// Cell of B.
    pub(super) b: String,
    /// Size of the difference, for numbers.
    pub(super) size: Option<f64>,
    /// The tolerance, for numbers.
    pub(super) tolerance: Option<f64>,
}

/// What differs in one column.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct ColumnOutcome {
    /// Column.
    pub(super) column: String,
    /// Rows that differ.
    pub(super) rows: u64,
    /// First difference.
    pub(super) first: Difference,
    /// Largest difference; `None` for texts.
    pub(super) worst: Option<Difference>,
}

/// The result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Outcome {
    /// No difference beyond the tolerances, same columns, same number of rows, and at least one row.
    pub(super) equal: bool,
    /// Rows of A that were compared.
    pub(super) rows_a: u64,
    /// Rows of B that were compared.
    pub(super) rows_b: u64,
    /// Of so many rows of A and B one was compared: more than 1 where the other trace has fewer rows in the same time.
    pub(super) every: [u64; 2],
    /// First differing cell.
    pub(super) first: Option<Difference>,
    /// Cell with the largest excess over its tolerance.
    pub(super) worst: Option<Difference>,
    /// Rows by which B is later than A (negative: earlier), if the numbers do not differ otherwise.
    pub(super) shift_cycles: Option<i64>,
    /// Lines, blocks, files or speed reasons differ even with that shift.
    pub(super) shift_leaves_texts: bool,
    /// Every column that differs.
    pub(super) columns: Vec<ColumnOutcome>,
    /// Columns of both traces that agree.
    pub(super) equal_columns: Vec<String>,
    /// Columns in A only.
    pub(super) only_a: Vec<String>,
    /// Columns in B only.
    pub(super) only_b: Vec<String>,
}

/// A column of both traces.
struct Pair {
    name: String,
    a: usize,
    b: usize,
    tolerance: Option<f64>,
    rows: u64,
    first: Option<Difference>,
    worst: Option<Difference>,
}

impl Pair {
    /// `None` if two cells of the column are equal.
    fn excess(&self, a: &[u8], b: &[u8]) -> Option<Excess> {
        if self.name == "file" && same_file(a, b) {
            return None;
        }
        excess(a, b, self.tolerance)
    }
}

/// A comparison under way.
pub(super) struct Comparison {
    pairs: Vec<Pair>,
    /// Positions of `t_s`, `line`, `block`, `file` in A.
    places: [Option<usize>; 4],
    same_layout: bool,
    /// Candidates for a delay, from the first difference on.
    delays: Delays,
    outcome: Outcome,
}

impl Comparison {
    /// A comparison of two tables with these headers.
    pub(super) fn new(a: &[String], b: &[String], tolerance: Tolerance) -> Self {
        let find = |header: &[String], name: &str| header.iter().position(|n| n == name);
        let only = |this: &[String], other: &[String]| -> Vec<String> {
            this.iter().filter(|n| !other.contains(n)).cloned().collect()
        };
        let pairs = a.iter().enumerate().filter_map(|(i, name)| {
            let (name, tolerance) = (name.clone(), tolerance.of(name));
            find(b, &name).map(|b| Pair {
                name,
                a: i,
                b,
                tolerance,
                rows: 0,
                first: None,
                worst: None,
            })
        });
        let outcome = Outcome {
            equal: true,
            rows_a: 0,
            rows_b: 0,
            every: [1, 1],
            first: None,
            worst: None,
            shift_cycles: None,
            shift_leaves_texts: false,
            columns: Vec::new(),
            equal_columns: Vec::new(),
            only_a: only(a, b),
            only_b: only(b, a),
        };
        Self {
            pairs: pairs.collect(),
            places: ["t_s", "line", "block", "file"].map(|name| find(a, name)),
            same_layout: a == b,
            delays: Delays::new(),
            outcome,
        }
    }

    /// Rows compared so far.
    pub(super) fn rows(&self) -> u64 {
        self.outcome.rows_a.max(self.outcome.rows_b)
    }

    /// Takes the next row of both; false if both have ended.
    pub(super) fn next(&mut self, a: Option<&ByteRecord>, b: Option<&ByteRecord>) -> bool {
        match (a, b) {
            (None, None) => return false,
            (Some(a), Some(b)) if !(self.same_layout && a == b) => self.compare(a, b),
            _ => {}
        }
        self.delay(a, b);
        self.outcome.rows_a += u64::from(a.is_some());
        self.outcome.rows_b += u64::from(b.is_some());
        true
    }

    fn compare(&mut self, a: &ByteRecord, b: &ByteRecord) {
        for pair in &mut self.pairs {
            let (Some(cell_a), Some(cell_b)) = (a.get(pair.a), b.get(pair.b)) else { continue };
            let Some(excess) = pair.excess(cell_a, cell_b) else { continue };
            pair.rows += 1;
            let is_worst = |other: &Option<Difference>| match (excess.size, other) {
                (None, _) => false,
                (Some(_), None) => true,
                (Some(d), Some(other)) => other.size.is_none_or(|o| d > o),
            };
            let new_worst = is_worst(&pair.worst);
            if pair.first.is_some() && !new_worst {
                continue;
            }
            let text = |cell: &[u8]| String::from_utf8_lossy(cell).into_owned();
            let [time_s, line, block, file] =
                self.places.map(|place| place.and_then(|i| a.get(i)).map(text));
            let difference = Difference {
                row: self.outcome.rows_a,
                time_s,
                line,
                block,
                file,
                column: pair.name.clone(),
                a: text(cell_a),
                b: text(cell_b),
                size: excess.size,
                tolerance: pair.tolerance,
            };
            if new_worst {
                pair.worst = Some(difference.clone());
            }
            if self.outcome.first.is_none() {
                self.outcome.first = Some(difference.clone());
            }
            pair.first.get_or_insert(difference);
        }
    }

    fn delay(&mut self, a: Option<&ByteRecord>, b: Option<&ByteRecord>) {
        if !self.pairs.iter().any(|p| p.tolerance.is_some() && p.first.is_some()) {
            return;
        }
        let timeless = || self.pairs.iter().filter(|p| p.name != "t_s");
        let cells = |row: &ByteRecord, place: fn(&Pair) -> usize| -> ByteRecord {
            timeless().map(|p| row.get(place(p)).unwrap_or_default()).collect()
        };
        let (a, b) = (a.map(|row| cells(row, |p| p.a)), b.map(|row| cells(row, |p| p.b)));
        let equal = |a: &ByteRecord, b: &ByteRecord| {
            let mut texts = true;
            for (p, (a, b)) in timeless().zip(a.iter().zip(b)) {
                match (p.excess(a, b), p.tolerance) {
                    (None, _) => {}
                    (Some(_), None) => texts = false,
                    (Some(_), Some(_)) => return None,
                }
            }
            Some(texts)
        };
        self.delays.take(a, b, equal);
    }

    /// Completes the comparison; `every`: see [`Outcome::every`].
    pub(super) fn finish(mut self, every: [u64; 2]) -> Outcome {
        let o = &mut self.outcome;
        o.every = every;
        let same_columns = o.only_a.is_empty() && o.only_b.is_empty();
        // two empty traces show nothing that could agree
        let rows = o.rows_a == o.rows_b && o.rows_a > 0;
        o.equal = o.first.is_none() && rows && same_columns;
        if let Some(delay) = self.delays.found().filter(|_| !o.equal) {
            o.shift_cycles = Some(delay.rows);
            o.shift_leaves_texts = !delay.texts;
        }
        let ratio = |d: &Difference| match (d.size, d.tolerance) {
            (Some(d), Some(t)) if t > 0.0 => d / t,
            _ => 0.0,
        };
        for pair in self.pairs {
            let Some(first) = pair.first else {
                o.equal_columns.push(pair.name);
                continue;
            };
            if let Some(d) = &pair.worst
                && o.worst.as_ref().is_none_or(|w| ratio(d) > ratio(w))
            {
                o.worst = Some(d.clone());
            }
            let (rows, worst) = (pair.rows, pair.worst);
            o.columns.push(ColumnOutcome { column: pair.name, rows, first, worst });
        }
        self.outcome
    }
}

/// A difference beyond the tolerance.
struct Excess {
    size: Option<f64>,
}

/// Whether two cells of the column `file` name the same file: how its folder is written depends on where a program was
/// started, so the shorter path has to be the end of the longer one.
fn same_file(a: &[u8], b: &[u8]) -> bool {
    let parts = |cell: &[u8]| -> Vec<Vec<u8>> {
        let parts = cell.split(|byte| matches!(byte, b'/' | b'\\'));
        parts.filter(|part| !matches!(*part, b"" | b"." | b"..")).map(<[u8]>::to_vec).collect()
    };
    let (a, b) = (parts(a), parts(b));
    !a.is_empty() && !b.is_empty() && (a.ends_with(&b) || b.ends_with(&a))
}

/// `None` if two cells are equal within the tolerance.
fn excess(a: &[u8], b: &[u8], tolerance: Option<f64>) -> Option<Excess> {
    if a == b {
        return None;
    }
    let number = |cell: &[u8]| std::str::from_utf8(cell).ok()?.parse::<f64>().ok();
    match (tolerance, number(a), number(b)) {
        (Some(_), Some(a), Some(b)) if !(a.is_finite() && b.is_finite()) => {
            let same = a.is_nan() && b.is_nan() || a.total_cmp(&b).is_eq();
            (!same).then_some(Excess { size: None })
        }
        (Some(tolerance), Some(a), Some(b)) => {
            let difference = (a - b).abs();
            // in binary a difference of 1e-6 between printed numbers is slightly more or less
            let within =
                difference <= tolerance * (1.0 + 1e-9) + f64::EPSILON * a.abs().max(b.abs());
            (!within).then_some(Excess { size: Some(difference) })
        }
        _ => Some(Excess { size: None }),
    }
}

#[cfg(test)]
mod tests;
