//! Compares two streams of rows and remembers what to report.

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
    /// What would have been equal, for numbers.
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
    /// Largest difference; none for texts.
    pub(super) worst: Option<Difference>,
}

/// The result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Outcome {
    /// No difference beyond the tolerances, same columns, same number of rows.
    pub(super) equal: bool,
    /// Rows of A.
    pub(super) rows_a: u64,
    /// Rows of B.
    pub(super) rows_b: u64,
    /// First differing cell.
    pub(super) first: Option<Difference>,
    /// Cell that exceeds its tolerance most.
    pub(super) worst: Option<Difference>,
    /// Rows by which B comes later than A (negative: earlier), if that alone makes the difference of the numbers.
    pub(super) shift_cycles: Option<i64>,
    /// With such a shift lines, blocks, files or reasons of the speed still differ.
    pub(super) shift_leaves_texts: bool,
    /// Every column that differs.
    pub(super) columns: Vec<ColumnOutcome>,
    /// Columns of both that agree.
    pub(super) equal_columns: Vec<String>,
    /// Columns that only A has.
    pub(super) only_a: Vec<String>,
    /// Columns that only B has.
    pub(super) only_b: Vec<String>,
}

/// A column that both have.
struct Pair {
    name: String,
    a: usize,
    b: usize,
    tolerance: Option<f64>,
    rows: u64,
    first: Option<Difference>,
    worst: Option<Difference>,
}

/// A comparison under way.
pub(super) struct Comparison {
    pairs: Vec<Pair>,
    /// Positions of `t_s`, `line`, `block`, `file` in A.
    places: [Option<usize>; 4],
    same_layout: bool,
    /// From the first difference on.
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
            let Some(excess) = excess(cell_a, cell_b, pair.tolerance) else { continue };
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
                match (excess(a, b, p.tolerance), p.tolerance) {
                    (None, _) => {}
                    (Some(_), None) => texts = false,
                    (Some(_), Some(_)) => return None,
                }
            }
            Some(texts)
        };
        self.delays.take(a, b, equal);
    }

    /// The result.
    pub(super) fn finish(mut self) -> Outcome {
        let o = &mut self.outcome;
        let same_columns = o.only_a.is_empty() && o.only_b.is_empty();
        o.equal = o.first.is_none() && o.rows_a == o.rows_b && same_columns;
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

/// None if two cells are equal within the tolerance.
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
            // a difference of 1e-6 between printed numbers is a little more or less in binary
            let within =
                difference <= tolerance * (1.0 + 1e-9) + f64::EPSILON * a.abs().max(b.abs());
            (!within).then_some(Excess { size: Some(difference) })
        }
        _ => Some(Excess { size: None }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::delay::MOST_ROWS;
    use super::*;

    const TOLERANCE: Tolerance =
        Tolerance { mm: 1e-6, mm_s: 1e-3, mm_s2: 1.0, mm_s3: 1e3, other: 1e-3 };

    fn header(names: &str) -> Vec<String> {
        names.split(',').map(str::to_owned).collect()
    }

    fn outcome(header_a: &str, a: &[String], header_b: &str, b: &[String]) -> Outcome {
        let record = |row: &String| ByteRecord::from(row.split(',').collect::<Vec<_>>());
        let (a, b): (Vec<_>, Vec<_>) =
            (a.iter().map(record).collect(), b.iter().map(record).collect());
        let mut c = Comparison::new(&header(header_a), &header(header_b), TOLERANCE);
        let mut i = 0;
        while c.next(a.get(i), b.get(i)) {
            i += 1;
        }
        c.finish()
    }

    const HEADER: &str = "t_s,line,block,X_set_mm,v_mm_s";

    fn row(k: usize, line: u32, x: f64, v: f64) -> String {
        format!("{:.6},{line},{},{x:.7},{v:.6}", k as f64 * 1e-3, line * 10)
    }

    fn ramp(from: usize, n: usize) -> Vec<String> {
        (0..n)
            .map(|k| {
                let at = k.saturating_sub(from);
                row(k, 3 + u32::from(at > 40), at as f64 * 0.01, if at > 0 { 10.0 } else { 0.0 })
            })
            .collect()
    }

    #[test]
    fn equal_within_tolerance() {
        let a = vec![row(0, 3, 0.0, 1.0), row(1, 3, 0.5, 1.0)];
        let b = vec![row(0, 3, 0.000001, 1.001), row(1, 3, 0.500001, 0.999)];
        let o = outcome(HEADER, &a, HEADER, &b);
        assert!(o.equal && o.first.is_none() && o.rows_a == 2, "{o:?}");
    }

    #[test]
    fn first_and_worst_with_time_line_and_block() {
        let a = ramp(0, 60);
        let mut b = a.clone();
        b[20] = row(20, 3, 0.2 + 2e-6, 10.0);
        b[50] = row(50, 4, 0.5, 9.0);
        let o = outcome(HEADER, &a, HEADER, &b);
        let first = o.first.unwrap();
        assert_eq!((first.row, first.column.as_str()), (20, "X_set_mm"));
        assert_eq!(first.time_s.as_deref(), Some("0.020000"));
        assert_eq!((first.line.as_deref(), first.block.as_deref()), (Some("3"), Some("30")));
        assert!((first.size.unwrap() - 2e-6).abs() < 1e-12);
        let worst = o.worst.unwrap();
        assert_eq!(
            (worst.row, worst.column.as_str(), worst.line.as_deref()),
            (50, "v_mm_s", Some("4"))
        );
        assert_eq!(o.columns.len(), 2);
        assert_eq!(o.shift_cycles, None);
    }

    #[test]
    fn delays_are_recognised() {
        for (n, rows) in [(1, 1), (2, 2), (3, 3), (9, 9), (50, 50)] {
            for (from_a, from_b, expected) in [(5, 5 + n, rows), (5 + n, 5, -rows)] {
                let o = outcome(HEADER, &ramp(from_a, 200), HEADER, &ramp(from_b, 200));
                assert_eq!(o.shift_cycles, Some(expected));
                assert!(!o.equal);
            }
        }
        // more rows than are looked back
        let n = MOST_ROWS + 1;
        let o = outcome(HEADER, &ramp(5, 3 * n), HEADER, &ramp(5 + n, 3 * n));
        assert_eq!(o.shift_cycles, None);
    }

    /// A pause of another length between two motions, with the columns in another order.
    #[test]
    fn a_longer_pause_is_a_delay_of_the_rest() {
        let trace = |pause: usize, columns: [usize; 3]| -> Vec<String> {
            let xs = (0..50).map(|k| k * k).chain(std::iter::repeat_n(49 * 49, pause));
            let xs = xs.chain((0..60).map(|k| 49 * 49 + 3 * k));
            let cells = |(k, x): (usize, usize)| {
                let all =
                    [format!("{:.3}", k as f64 * 1e-3), (1 + x / 500).to_string(), x.to_string()];
                columns.map(|i| all[i].clone()).join(",")
            };
            xs.enumerate().map(cells).collect()
        };
        let (plain, turned) = ([0, 1, 2], [2, 0, 1]);
        for (a, b, expected) in [(10, 37, 27), (37, 10, -27)] {
            let o = outcome(
                "t_s,line,X_set_mm",
                &trace(a, plain),
                "X_set_mm,t_s,line",
                &trace(b, turned),
            );
            assert_eq!(o.shift_cycles, Some(expected));
            assert_eq!(o.equal_columns, ["t_s"]);
        }
    }

    /// Two traces that differ at their very end stand still afterwards: no delay explains that.
    #[test]
    fn a_standstill_is_no_delay() {
        let rows = |end: f64| -> Vec<String> {
            (0..50).map(|k| row(k, 3, if k < 20 { 0.0 } else { end }, 0.0)).collect()
        };
        let o = outcome(HEADER, &rows(1.0), HEADER, &rows(2.0));
        assert_eq!((o.shift_cycles, o.columns.len()), (None, 1));
        let late: Vec<String> = (0..50).map(|k| row(k, 3 + u32::from(k == 49), 0.0, 0.0)).collect();
        let o = outcome(HEADER, &rows(0.0), HEADER, &late);
        assert_eq!(o.shift_cycles, None);
    }

    /// A line added to a program that only waits shifts all lines after it, and what the speed was held by before it.
    #[test]
    fn a_new_line_is_a_delay_of_the_numbers() {
        let trace = |pause: usize, line: u32, reason: &str| -> Vec<String> {
            let xs = (0..50).chain(std::iter::repeat_n(49, pause)).chain(50..110).enumerate();
            let cells = |(k, x): (usize, i32)| {
                let line = if x < 50 { 3 } else { line };
                let reason = if (30..50).contains(&x) { reason } else { "feed" };
                format!("{:.3},{line},{x},{reason}", k as f64 * 1e-3)
            };
            xs.map(cells).collect()
        };
        let header = "t_s,line,X_set_mm,v_limit";
        let (a, b) = (trace(10, 4, "corner"), trace(35, 5, "stop"));
        let o = outcome(header, &a, header, &b);
        assert_eq!((o.shift_cycles, o.shift_leaves_texts), (Some(25), true));
        assert_eq!(o.first.unwrap().column, "v_limit");
        // without another line nothing is left
        let o = outcome(header, &a, header, &trace(35, 4, "corner"));
        assert_eq!((o.shift_cycles, o.shift_leaves_texts), (Some(25), false));
        // a line alone is not a delay
        let o = outcome(header, &a, header, &trace(10, 5, "corner"));
        assert_eq!((o.shift_cycles, o.columns.len()), (None, 1));
    }

    #[test]
    fn a_longer_trace_that_is_only_shifted() {
        let o = outcome(HEADER, &ramp(5, 100), HEADER, &ramp(7, 102));
        assert_eq!((o.rows_a, o.rows_b, o.shift_cycles), (100, 102, Some(2)));
    }

    #[test]
    fn rows_and_columns_count() {
        let o = outcome(HEADER, &ramp(0, 10), HEADER, &ramp(0, 12));
        assert!(!o.equal && o.first.is_none());
        let wide = ["t_s,v_mm_s,line".to_owned(), "t_s,line".to_owned()];
        let o = outcome(&wide[0], &["0,1,2".to_owned()], &wide[1], &["0,2".to_owned()]);
        assert!(!o.equal);
        assert_eq!(o.only_a, ["v_mm_s"]);
        let o =
            outcome("t_s,a_mm,b_mm", &["0,1,2".to_owned()], "t_s,b_mm,a_mm", &["0,2,1".to_owned()]);
        assert!(o.equal, "order does not matter");
    }

    #[test]
    fn what_is_no_number_equals_itself_alone() {
        let values = ["1", "1e300", "inf", "-inf", "nan", "NaN", ""];
        for a in values {
            for b in values {
                let o = outcome("v_mm_s", &[a.to_owned()], "v_mm_s", &[b.to_owned()]);
                assert_eq!(o.equal, a.eq_ignore_ascii_case(b), "{a} {b}");
            }
        }
    }

    #[test]
    fn texts_and_empty_cells() {
        let header = "t_s,line,block,v_limit";
        let o = outcome(header, &["0,1,,feed".to_owned()], header, &["0,1,10,corner".to_owned()]);
        assert_eq!(o.first.unwrap().column, "block");
        assert_eq!(o.columns.len(), 2);
        assert!(o.worst.is_none());
    }
}
