//! Output of `explain`, `response`, `tune`, `sweep` and `report --signals`.

use crate::kit::Folder;
use kontur::Exit;

#[test]
fn explain_has_a_page_for_each_word() {
    let f = Folder::new();
    let (exit, out, _) = f.call(&["explain", "22060", "P-AXIS-00013", "G1"]);
    assert_eq!(exit, Exit::Finished);
    let pages = [&["22060"][..], &["P-AXIS-00013"], &["G1"]];
    let pages = pages.map(|word| f.call(&[&["explain"][..], word].concat()).1);
    assert_eq!(out, pages.join("\n"));
}

#[test]
fn response_writes_tables_and_pictures() {
    let f = Folder::new();
    let filter = ["response", "--filter", "LOWPASS", "--prototype", "BUTTERWORTH,bessel"];
    let words = |rest: &[&'static str]| -> Vec<&'static str> { [&filter[..], rest].concat() };
    let (exit, out, err) = f.call(&words(&["--order", "4", "--f0", "15", "--range", "15..30"]));
    assert_eq!((exit, err.as_str()), (Exit::Finished, ""));
    assert!(out.starts_with("curve,f_hz,magnitude_db,phase_deg,group_delay_ms\n"), "{out}");
    // -3.01 dB and -180 degrees: a Butterworth filter of order 4 at its corner frequency
    let butterworth = out.lines().nth(1).unwrap();
    assert!(
        butterworth.contains("BUTTERWORTH 4, 15 Hz\",15.000000,-3.010300,-180.000000,"),
        "{butterworth}"
    );
    assert_eq!(out.lines().count(), 1 + 2 * 801);
    for view in [&["--step"][..], &["--corner", "F1000"], &["-o", "@extra.csv"]] {
        let first = f.call(&words(&[view, &["-o", "@a.svg", "-o", "@a.csv"]].concat()));
        assert_eq!(
            (first.0, first.1.as_str(), first.2.as_str()),
            (Exit::Finished, "", ""),
            "{view:?}"
        );
        let picture = f.read("a.svg");
        assert!(picture.starts_with("<svg") && picture.contains("LOWPASS BESSEL 2, 30 Hz"));
        assert!(f.read("a.csv").starts_with("curve,"));
        f.call(&words(&[view, &["-o", "@a.svg"]].concat()));
        assert!(picture == f.read("a.svg"), "{view:?}");
    }
}

#[test]
fn response_of_shapers_and_axes() {
    let f = Folder::new();
    // zero at the set frequency; one column per convention
    let guard = ["response", "--guard", "MODE=2,FREQ=40"];
    let residual = ["--residual", "--range", "40..80", "--damping", "0.1,0.2"];
    let (exit, out, _) = f.call(&[&guard[..], &residual].concat());
    assert_eq!(exit, Exit::Finished);
    let rows: Vec<&str> = out.lines().collect();
    assert_eq!(rows.len(), 1 + 2 * 601);
    assert!(rows[1].ends_with(",0.1,40,40.000000,1.000000,1.000000,0.000000000"), "{}", rows[1]);
    assert!(rows[601].contains(",80.000000,0.500000,2.000000,"), "{}", rows[601]);
    // contour error of the mean filter: N(N+2)/(8(N+1)) v T
    let (_, out, _) = f.call(&["response", "--hsc-mean", "10,50", "--corner", "F1000"]);
    assert!(out.contains("HSC mean 10,10,1000,0.022727273,0.032141217,5.000000"), "{out}");
    assert!(out.contains("HSC mean 50,50,1000,0.106209150,"), "{out}");
    // the lists of the built-in machine activate nothing; an option does
    let (exit, out, err) = f.call(&["response", "--axis", "X", "--step"]);
    assert_eq!(exit, Exit::Finished);
    assert!(err.contains("no filter") && out.contains("0.000000,1.000000000"), "{err}");
    let set = ["--set", "X.vib_guard.active=1", "--set", "X.vib_guard.freq=40"];
    let axis = ["response", "--axis", "X", "--corner", "F4000"];
    let (_, with_lists, _) = f.call(&[&axis[..], &set].concat());
    let (_, alone, _) = f.call(&["response", "--guard", "MODE=1,FREQ=40", "--corner", "F4000"]);
    let numbers = |out: &str| out.lines().nth(1).unwrap().rsplit('"').next().unwrap().to_owned();
    let numbers = [numbers(&with_lists), numbers(&alone)];
    assert!(numbers[0].ends_with(numbers[1].trim_start_matches(',')), "{numbers:?}");
}

#[test]
fn tune_judges_the_choices_on_a_program() {
    let f = Folder::new();
    let tune = |program: &str, max_dev: &str| {
        f.call(&["tune", "--freq", "38,42", "--program", program, "--max-dev", max_dev])
    };
    let program = |text: &str| std::fs::write(f.path("corner.nc"), text).unwrap();
    let square = "N10 G01 F3600\nX1\nY1\nX0\nY0\nM30\n";
    program(square);
    let (exit, out, err) = tune("@corner.nc", "1");
    assert_eq!((exit, err.as_str()), (Exit::Finished, ""));
    // the limits of the machine and the assumptions
    assert!(out.contains("machine   xyz, cycle 1 ms") && out.contains("v_max"), "{out}");
    assert!(out.contains("no AX_DEV in the program"), "{out}");
    let rows: Vec<&str> = out.lines().skip_while(|l| !l.contains("machining time")).collect();
    assert!(rows[1].starts_with("off") && rows[1].ends_with("no"), "{out}");
    let chosen = rows.iter().find_map(|l| l.strip_prefix("choice    ")).unwrap();
    // the shortest kernel that keeps 5 % has the shortest run-out at the end of a pass
    let times: Vec<f64> = rows[2..]
        .iter()
        .filter(|row| row.ends_with("yes"))
        .map(|row| row.split_whitespace().rev().nth(2).unwrap().parse().unwrap())
        .collect();
    let least = times.iter().copied().fold(f64::MAX, f64::min);
    assert!(times.len() > 2 && out.contains(&format!("1 mm: {least:.3} s")), "{out}");
    assert!(chosen.starts_with("#VIB GUARD ON [MODE="), "{chosen}");
    // settings that exceed the bound run again with it as AX_DEV, and keep it or not
    let (_, out, _) = tune("@corner.nc", "0.001");
    let again = |l: &&str| l.contains(" 0.001  ");
    assert!(out.lines().filter(again).count() > 2, "{out}");
    // the settings of the program
    program(&square.replace("N10", "N10 #VIB GUARD ON [AX_DEV=0.02]\nN20"));
    let (_, out, _) = tune("@corner.nc", "1");
    assert!(out.contains("AX_DEV=0.02 (line 1)") && out.contains(" AX_DEV=0.02]\n"), "{out}");
    let rows = |out: &str| -> Vec<String> {
        out.lines().skip_while(|l| !l.contains("machining time")).map(str::to_owned).collect()
    };
    // words to be varied are replaced, also if they are computed or in a subroutine
    let plain = rows(&out);
    let computed = "#VIB GUARD ON [MODE=P1 FREQ=[P1*20] AX_DEV=0.02]";
    program(&square.replace("N10", &format!("P1=2\n{computed}\nN20")));
    let (exit, out, _) = tune("@corner.nc", "1");
    assert_eq!(exit, Exit::Finished);
    assert!(out.contains("(line 2) are replaced"), "{out}");
    assert_eq!(rows(&out), plain);
    let sub = format!("%L SUB\nP1=2\n{computed}\nM17\n%MAIN\nLL SUB\n{square}");
    program(&sub);
    let (_, out, _) = tune("@corner.nc", "1");
    assert!(out.contains("(line 3) are replaced"), "{out}");
    assert_eq!(rows(&out), plain);
    assert_eq!(f.read("corner.nc"), sub);
    // a program that switches the guard off at once: none of the choices is active for long enough to compare
    program(&square.replace("N10", "N10 #VIB GUARD OFF\nN20"));
    let (_, out, _) = tune("@corner.nc", "1");
    assert!(out.contains("line 1 switches the guard off"), "{out}");
    assert!(out.contains("up to line 1: after it, vibration was not damped"), "{out}");
    // options for recordings have no effect on given frequencies
    for option in ["--column=a", "--rate=1000", "--range=1..2", "--window=0..1"] {
        assert_eq!(f.call(&["tune", "--freq", "6.9,6.0", option]).0, Exit::Usage, "{option}");
    }
    assert_eq!(tune("@bad.nc", "1").0, Exit::Aborted);
}

/// One row per combination in order; the same output for the same input, whatever the order in which the cores finish.
#[test]
fn sweep_has_a_row_for_every_combination() {
    let f = Folder::new();
    let words = |name: &'static str| {
        let vary = ["--vary", "X.vib_guard.mode=1..3", "--vary", "X.vib_guard.freq=20,40"];
        let more = ["--set", "X.vib_guard.active=1", "--amplitude", "X_vel_mm_s@1..100"];
        [&["sweep", "@listed.nc", "-o", name][..], &vary, &more].concat()
    };
    let (exit, out, err) = f.call(&words("@a.csv"));
    assert_eq!((exit, out.as_str(), err.as_str()), (Exit::Finished, "", ""));
    let first = f.read("a.csv");
    let mut reader = csv::Reader::from_reader(first.as_bytes());
    let header = reader.headers().unwrap().clone();
    let cell = |row: &csv::StringRecord, name: &str| {
        row[header.iter().position(|h| h == name).unwrap()].to_owned()
    };
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    let varied = rows.iter().map(|r| format!("{} {}", &r[0], &r[1])).collect::<Vec<_>>();
    assert_eq!(varied, ["1 20", "1 40", "2 20", "2 40", "3 20", "3 40"]);
    assert_eq!((&header[0], &header[1]), ("X.vib_guard.mode", "X.vib_guard.freq"));
    for row in &rows {
        assert_eq!((cell(row, "state"), cell(row, "error")), ("finished".into(), String::new()));
        // the output of `run` for the same settings
        let settings = [0, 1].map(|i| format!("{}={}", &header[i], &row[i]));
        let set = format!("--set X.vib_guard.active=1 --set {}", settings.join(" --set "));
        let (_, out, _) = f.line(&format!("run @listed.nc --summary json {set}"));
        let summary: serde_json::Value = serde_json::from_str(&out).unwrap();
        let number = |name: &str| cell(row, name).parse::<f64>().unwrap();
        let near = |a: f64, b: &serde_json::Value| (a - b.as_f64().unwrap()).abs() < 1e-6;
        assert!(near(number("duration_s"), &summary["duration_s"]));
        assert!(near(number("contour_err_mm"), &summary["max_contour_error"]["mm"]));
        assert!(near(number("X_vel_max_mm_s"), &summary["axes"][0]["max_vel"]));
        assert!(number("X_vel_mm_s@1..100") > 0.0);
    }
    assert_eq!(f.call(&words("@a.csv")).0, Exit::Finished);
    assert_eq!(f.read("a.csv"), first);
    assert_eq!(f.call(&words("@a.svg")).0, Exit::Finished);
    let picture = f.read("a.svg");
    assert!(
        picture.contains("freq = 40")
            && picture.contains(">duration_s<")
            && picture.contains(">duration in s<"),
        "{picture}"
    );
    #[cfg(feature = "parquet")]
    {
        assert_eq!(f.call(&words("@a.parquet")).0, Exit::Finished);
        assert!(std::fs::read(f.path("a.parquet")).unwrap().ends_with(b"PAR1"));
    }
}

/// Columns over time, and the variants of one program in one picture.
#[test]
fn report_draws_signals_and_variants() {
    let f = Folder::new();
    let drawn = |rest: &str| {
        let columns = "--signals X_set_mm,X_vel_mm_s --window 0.01..0.05";
        let vary = "--vary X.vib_guard.mode=1,4";
        assert_eq!(f.line(&format!("report @corner.nc {vary} {columns} {rest}")).0, Exit::Finished);
    };
    drawn("-o @a.svg");
    let picture = f.read("a.svg");
    for name in [">X_set_mm<", ">X_vel_mm_s<", "mode = 1", "mode = 4"] {
        assert!(picture.contains(name), "{name}");
    }
    drawn("-o @a.csv");
    let table = f.read("a.csv");
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows[0], "curve,t_s,X_set_mm,X_vel_mm_s");
    assert_eq!(rows.len(), 1 + 2 * 40, "40 cycles of either");
    drawn("-o @s.csv --spectrum 0..100");
    assert!(f.read("s.csv").starts_with("curve,f_hz,X_set_mm,X_vel_mm_s\n"));
    // a program that is named twice is two curves
    let twice = "report @corner.nc @corner.nc --signals X_set_mm --window 0.01..0.05 -o @t.csv";
    assert_eq!(f.line(twice).0, Exit::Finished);
    let table = f.read("t.csv");
    let second = table.lines().filter(|row| row.contains("corner.nc (2),")).count();
    assert_eq!((table.lines().count(), second), (1 + 2 * 40, 40));
    // without --signals the contours are overlaid
    let contours = "report @corner.nc --vary X.vib_guard.mode=1,4 -o @c.svg";
    assert_eq!(f.line(contours).0, Exit::Finished);
    assert!(f.read("c.svg").contains("mode = 4"));
}

/// The data kept of a long run are bounded: 262,144 cycles of one column with its spectrum, fewer of ten columns. Larger
/// requests are refused, whatever the kind of plot.
#[test]
fn signals_of_long_runs_have_a_bound() {
    let f = Folder::new();
    std::fs::write(f.path("long.nc"), "G01 X40 F7\nM30\n").unwrap();
    let words = |names: &'static str, more: &[&'static str]| {
        let words = ["report", "@long.nc", "--signals", names, "-o", "@a.csv", "--window"];
        let all = [&words[..], more].concat();
        let (exit, _, err) = f.call(&all);
        assert!(exit == Exit::Finished || err.contains("use --window to show a part"), "{err}");
        exit == Exit::Finished
    };
    assert!(words("X_set_mm", &["0..300"]));
    assert!(words("X_set_mm", &["0..262", "--spectrum", "1..2"]));
    assert!(!words("X_set_mm", &["0..263", "--spectrum", "1..2"]));
    let ten = "ipo,set,X_err_mm,Y_err_mm,Z_err_mm,contour_err_mm";
    assert!(words(ten, &["0..209", "--spectrum", "1..2"]));
    assert!(!words(ten, &["0..210", "--spectrum", "1..2"]));
    // every line of ten spectra up to half of the sampling rate is in its row
    assert!(words(ten, &["0..0.512", "--spectrum", "0..500"]));
    let rows: Vec<String> = f.read("a.csv").lines().map(str::to_owned).collect();
    assert_eq!(rows.len(), 1 + 2048 + 1, "8 * 512 points make a line for every second of them");
    assert!(rows.iter().all(|row| row.split(',').count() == 12), "{}", rows[0]);
}
