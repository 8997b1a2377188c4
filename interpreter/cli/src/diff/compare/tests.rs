use super::super::delay::MOST_ROWS;
use super::*;

const TOLERANCE: Tolerance =
    Tolerance { mm: 1e-6, mm_s: 1e-3, mm_s2: 1.0, mm_s3: 1e3, other: 1e-3 };

fn header(names: &str) -> Vec<String> {
    names.split(',').map(str::to_owned).collect()
}

fn outcome(header_a: &str, a: &[String], header_b: &str, b: &[String]) -> Outcome {
    let record = |row: &String| ByteRecord::from(row.split(',').collect::<Vec<_>>());
    let (a, b): (Vec<_>, Vec<_>) = (a.iter().map(record).collect(), b.iter().map(record).collect());
    let mut c = Comparison::new(&header(header_a), &header(header_b), TOLERANCE);
    let mut i = 0;
    while c.next(a.get(i), b.get(i)) {
        i += 1;
    }
    c.finish([1, 1])
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
    // one row more than the comparison looks back
    let n = MOST_ROWS + 1;
    let o = outcome(HEADER, &ramp(5, 3 * n), HEADER, &ramp(5 + n, 3 * n));
    assert_eq!(o.shift_cycles, None);
}

/// A pause of different length between two motions, with the columns in a different order.
#[test]
fn a_longer_pause_is_a_delay_of_the_rest() {
    let trace = |pause: usize, columns: [usize; 3]| -> Vec<String> {
        let xs = (0..50).map(|k| k * k).chain(std::iter::repeat_n(49 * 49, pause));
        let xs = xs.chain((0..60).map(|k| 49 * 49 + 3 * k));
        let cells = |(k, x): (usize, usize)| {
            let all = [format!("{:.3}", k as f64 * 1e-3), (1 + x / 500).to_string(), x.to_string()];
            columns.map(|i| all[i].clone()).join(",")
        };
        xs.enumerate().map(cells).collect()
    };
    let (plain, turned) = ([0, 1, 2], [2, 0, 1]);
    for (a, b, expected) in [(10, 37, 27), (37, 10, -27)] {
        let o =
            outcome("t_s,line,X_set_mm", &trace(a, plain), "X_set_mm,t_s,line", &trace(b, turned));
        assert_eq!(o.shift_cycles, Some(expected));
        assert_eq!(o.equal_columns, ["t_s"]);
    }
}

/// Two traces that differ at their very end and rest afterwards: this is not a delay.
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

/// A line inserted before a wait shifts the numbers of all later lines, and the speed reason before it differs.
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
    // without the additional line there is no difference
    let o = outcome(header, &a, header, &trace(35, 4, "corner"));
    assert_eq!((o.shift_cycles, o.shift_leaves_texts), (Some(25), false));
    // a difference in the line alone is not a delay
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
    let o = outcome("t_s,a_mm,b_mm", &["0,1,2".to_owned()], "t_s,b_mm,a_mm", &["0,2,1".to_owned()]);
    assert!(o.equal, "order does not matter");
}

/// The folder of a file depends on where the program was started.
#[test]
fn files_are_compared_by_the_ends_of_their_paths() {
    let header = "t_s,line,block,file";
    for (a, b, equal) in [
        ("nc/part.nc", "./nc/part.nc", true),
        ("nc/part.nc", "D:\\jobs\\nc\\part.nc", true),
        ("sub/s.nc", "../jobs/sub/s.nc", true),
        ("sub/a.nc", "lib/a.nc", false),
        ("part.nc", "other_part.nc", false),
        ("part.nc", "", false),
    ] {
        let row = |file: &str| [format!("0,1,,{file}")];
        assert_eq!(outcome(header, &row(a), header, &row(b)).equal, equal, "{a} {b}");
    }
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
