//! The parameters of a sweep, and its parts.

use super::*;

/// Rows of a sweep over a square, with the given columns.
fn sweep(program: &str, vary: &[&str]) -> (Vec<Vec<String>>, String) {
    let folder = Folder::new(&[("part.nc", program)]);
    let mut words = vec!["sweep", "@part.nc", "--columns", "duration_s,contour_err_mm"];
    words.extend(vary.iter().flat_map(|v| ["--vary", v]));
    let done = folder.call(&words);
    assert_eq!(done.exit, Exit::Finished, "{}", done.err);
    let rows = done.out.lines().skip(1);
    (rows.map(|l| l.split(',').map(str::to_owned).collect()).collect(), done.err)
}

const SQUARE: &str = "G01 X1 F4000\nY1\nX0\nY0\nM30\n";

/// All axes vary together with `*` and with a list of names, as with one `--set` for each.
#[test]
fn axes_vary_together() {
    let square = format!("#VIB GUARD ON\n{SQUARE}");
    let (rows, err) = sweep(&square, &["*.vib_guard.freq=20,40"]);
    assert!(!err.contains("every value gives the same"), "{err}");
    for (row, hz) in rows.iter().zip(["20", "40"]) {
        let each: Vec<String> = ["X", "Y", "Z"].map(|a| format!("{a}.vib_guard.freq={hz}")).into();
        let (one, _) = sweep(&square, &each.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(row[1..], one[0][3..], "{hz} Hz");
        let (named, _) = sweep(&square, &[&format!("X,Y,Z.vib_guard.freq={hz}")]);
        // the key contains commas: its cell is quoted, the results are the last cells
        assert_eq!(row[1..], named[0][named[0].len() - row.len() + 1..], "{hz} Hz");
    }
    assert_ne!(rows[0][1..], rows[1][1..]);
}

/// What a program sets itself does not vary: the sweep says so.
#[test]
fn a_value_that_the_program_sets_itself_is_reported() {
    let own = format!("#VIB GUARD ON [MODE=1 FREQ=30]\n{SQUARE}");
    let (rows, err) = sweep(&own, &["*.vib_guard.freq=20,40"]);
    assert_eq!(rows[0][1..], rows[1][1..]);
    assert!(
        err.contains("*.vib_guard.freq: all values give the same results in these columns"),
        "{err}"
    );
    // in every row as well
    assert!(rows.iter().all(|row| row.last().unwrap() == "*.vib_guard.freq"), "{rows:?}");
}

/// A number in the program varies as if another program had been written; one name can occur in several places.
#[test]
fn numbers_in_a_program_vary() {
    let part = |x: &str, hz: &str| {
        format!("P1={x} (P1=3)\n#VIB GUARD ON [MODE=1 FREQ={hz}]\nG01 X=P1 F4000\nY1\nM30\n")
    };
    let (rows, err) = sweep(&part("7", "30"), &["program.P1=1,2", "program.FREQ=20,40"]);
    assert!(!err.contains("every value gives the same"), "{err}");
    let places = [("1", "20"), ("1", "40"), ("2", "20"), ("2", "40")];
    assert_eq!(rows.len(), places.len());
    for (row, (x, hz)) in rows.iter().zip(places) {
        let (written, _) = sweep(&part(x, hz), &["X.vib_guard.mode=1"]);
        assert_eq!((&*row[0], &*row[1], &row[2..]), (x, hz, &written[0][1..]), "{x} {hz}");
    }
    let (named, _) =
        sweep(&part("2", "30"), &["F=20,40", "program[2].FREQ={F}", "X.vib_guard.freq={F}"]);
    for (row, of) in named.iter().zip(&rows[2..]) {
        assert_eq!((&row[1], &row[2], &row[3..]), (&row[0], &row[0], &of[2..]));
    }
}

/// External variables hold the words of a command.
#[test]
fn values_of_a_program_vary() {
    let with = |value: &str| format!("#VIB GUARD ON [MODE=1 FREQ={value}]\n{SQUARE}");
    let (rows, err) = sweep(&with("V.E.HZ"), &["V.E.HZ=20,40"]);
    assert!(!err.contains("all values"), "{err}");
    for (row, hz) in rows.iter().zip(["20", "40"]) {
        let (fixed, _) = sweep(&with(hz), &["X.vib_guard.freq=33"]);
        assert_eq!(row[1..], fixed[0][1..]);
    }
}

/// Part by part, in any order: the rows of the parts, one after the other, are the table. If there are more parts than runs, all parts
/// are refused alike.
#[test]
fn shards_together_are_the_sweep() {
    let folder = Folder::new(&[("part.nc", SQUARE)]);
    let words = ["sweep", "@part.nc", "--vary", "*.vib_guard.freq=20..24", "--vary", "V.E.A=1,2"];
    let with = |more: &[&str]| folder.call(&[&words[..], more].concat());
    let whole = with(&[]).out;
    // the last column is what a part knows from its own rows alone
    assert!(whole.lines().next().is_some_and(|header| header.ends_with(",without_effect")));
    let known = |table: &str| -> String {
        table.lines().map(|line| format!("{}\n", line.rsplit_once(',').unwrap().0)).collect()
    };
    let (header, rows) = whole.split_once('\n').unwrap();
    for parts in [1, 3, 10] {
        let mut all = vec![String::new(); parts];
        for i in (0..parts).rev() {
            let done = with(&["--shard", &format!("{}/{parts}", i + 1)]);
            assert_eq!(done.exit, Exit::Finished, "{}", done.err);
            let (head, part) = done.out.split_once('\n').unwrap();
            assert_eq!(head, header);
            // rows of one frequency and of the next, of V.E.A 1 and 2, or a single row, which says nothing
            let expected: &[&str] = match (parts, i) {
                (10, _) => &[],
                _ => &["*.vib_guard.freq", "V.E.A"],
            };
            for key in expected {
                let said = format!(
                    "{key}: in this part all values give the same results in these columns"
                );
                assert!(done.err.contains(&said), "{}", done.err);
            }
            let noted = part.lines().all(|row| row.ends_with(&format!(",{}", expected.join(" "))));
            assert!(noted && expected.is_empty() != done.err.contains("all values"), "{part}");
            all[i] = part.to_owned();
        }
        assert_eq!(known(&all.concat()), known(rows), "{parts} parts");
    }
    for wrong in ["1/11", "11/11"] {
        let done = with(&["--shard", wrong]);
        assert_eq!(done.exit, Exit::Usage);
        assert!(done.err.contains("11 parts of 10 combinations"), "{}", done.err);
    }
    assert_eq!(with(&["--shard", "1/2", "-o", "@a.svg"]).exit, Exit::Usage);
}
