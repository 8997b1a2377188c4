//! The command line from outside: files, forms, exit codes.

#![expect(clippy::unwrap_used, reason = "a test that fails here has failed")]

mod kit;

use kit::Folder;
use kontur::Exit;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;

#[test]
fn run_writes_trace_and_summary() {
    let f = Folder::new();
    let (exit, out, err) = f.call(&["run", "@corner.nc", "-o", "@a.csv", "--summary", "json"]);
    assert_eq!((exit, err.as_str()), (Exit::Finished, ""));
    let summary: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(summary["state"], "finished");
    assert_eq!(summary["cycle_us"], 1000);
    assert_eq!(summary["blocks"], 18);
    assert_eq!(summary["path_length_mm"], 12.0);
    let guard = VibGuardSettings { mode: 1, freq_hz: 30.0, ..VibGuardSettings::default() };
    let delay_cycles = guard.kernel(CycleTime::DEFAULT).unwrap().delay_cycles();
    let told = summary["axes"][0]["filter_delay_cycles"].as_f64().unwrap();
    assert!((told - delay_cycles).abs() < 1e-9, "{told} {delay_cycles}");
    let trace = f.read("a.csv");
    let rows: Vec<&str> = trace.lines().collect();
    assert_eq!(summary["cycles"], rows.len() as u64 - 1);
    // the time of the last row is the duration, and all of it is accounted for
    let last: f64 = rows.last().unwrap().split(',').next().unwrap().parse().unwrap();
    let duration = summary["duration_s"].as_f64().unwrap();
    assert!((last - duration).abs() < 1e-9);
    let shares = summary["time_by_v_limit_s"].as_object().unwrap();
    let sum: f64 = shares.values().map(|v| v.as_f64().unwrap()).sum();
    assert!((sum - duration).abs() < 1e-9);
    // the largest contour error of the summary stands in the trace, at its time and line
    let column = |name: &str| rows[0].split(',').position(|n| n == name).unwrap();
    let cell = |row: &str, name: &str| row.split(',').nth(column(name)).unwrap().to_owned();
    let most = &summary["max_contour_error"];
    let row = rows[1..]
        .iter()
        .find(|r| cell(r, "t_s") == format!("{:.6}", most["time_s"].as_f64().unwrap()))
        .unwrap();
    assert_eq!(cell(row, "contour_err_mm"), format!("{:.7}", most["mm"].as_f64().unwrap()));
    assert_eq!(cell(row, "line"), most["line"].to_string());
}

#[test]
fn a_trace_on_stdout_leaves_the_summary_to_stderr() {
    let f = Folder::new();
    f.call(&["run", "@corner.nc", "-o", "@a.csv"]);
    let (exit, out, err) = f.call(&["run", "@corner.nc", "-o", "-"]);
    assert_eq!((exit, out), (Exit::Finished, f.read("a.csv")));
    assert!(err.contains("corner.nc  finished"), "{err}");
    let (exit, _, err) = f.call(&["run", "@corner.nc", "-o", "-", "-o", "-"]);
    assert_eq!((exit, err.contains("two outputs into one file")), (Exit::Usage, true));
    let vary = ["sweep", "@corner.nc", "--vary", "X.getriebe[0].kv=1000,2000"];
    let words = [&vary[..], &["-o", "-"]].concat();
    assert_eq!(f.call(&words).1, f.call(&vary).1);
    assert!(!std::path::Path::new("-").exists());
}

#[test]
fn same_input_same_bytes() {
    let f = Folder::new();
    for name in ["@a.csv", "@a.svg", "@a.html"] {
        let words: Vec<&str> = if name.ends_with("csv") {
            vec!["run", "@corner.nc", "-o", name]
        } else {
            vec!["report", "@corner.nc", "-o", name]
        };
        assert_eq!(f.call(&words).0, Exit::Finished);
        let first = f.read(&name[1..]);
        assert_eq!(f.call(&words).0, Exit::Finished);
        assert!(first == f.read(&name[1..]), "{name}");
    }
}

#[test]
fn decimated_traces_keep_the_rows_they_show() {
    let f = Folder::new();
    f.call(&["run", "@corner.nc", "-o", "@all.csv", "--summary", "none"]);
    f.call(&["run", "@corner.nc", "-o", "@some.csv", "--decimate", "10"]);
    let all = f.read("all.csv");
    let every_tenth: Vec<&str> =
        all.lines().take(1).chain(all.lines().skip(1).step_by(10)).collect();
    assert_eq!(f.read("some.csv").lines().collect::<Vec<_>>(), every_tenth);
}

#[test]
#[cfg(feature = "parquet")]
fn parquet_and_csv_side_by_side() {
    let f = Folder::new();
    let files = ["-o", "@a.parquet", "-o", "@a.csv"];
    let words = [&["run", "@corner.nc", "--max-time", "0.1"][..], &files].concat();
    assert_eq!(f.call(&words).0, Exit::Aborted);
    let bytes = std::fs::read(f.path("a.parquet")).unwrap();
    assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"), "complete after an abort");
    // every bit against seven decimals, and all of it against a fresh run
    for words in [["@a.parquet", "@a.csv"], ["@a.csv", "@a.parquet"]] {
        let (exit, out, _) = f.call(&[&["diff"][..], &words].concat());
        assert_eq!((exit, out.as_str()), (Exit::Finished, "equal: 101 rows\n"));
    }
    assert_eq!(f.call(&["run", "@corner.nc", "-o", "@whole.parquet"]).0, Exit::Finished);
    assert_eq!(f.call(&["diff", "@corner.nc", "@whole.parquet"]).0, Exit::Finished);
    let (exit, out, _) = f.call(&["diff", "@whole.parquet", "@slow.nc"]);
    assert!(exit == Exit::Aborted && out.contains(" s, line 7 N70: "), "{out}");
    // a table that is no trace, and what is cut off
    std::fs::write(f.path("cut.parquet"), &bytes[..bytes.len() / 2]).unwrap();
    assert_eq!(f.call(&["diff", "@cut.parquet", "@a.csv"]).0, Exit::Io);
    std::fs::write(f.path("no.parquet"), "t_s,line\n0,1\n").unwrap();
    let (exit, _, err) = f.call(&["diff", "@no.parquet", "@a.csv"]);
    assert_eq!((exit, err.contains("no Parquet file")), (Exit::Usage, true));
}

#[test]
fn an_aborted_run_leaves_a_whole_trace() {
    let f = Folder::new();
    let forms = ["--summary", "json", "--diagnostics", "json"];
    let words = ["run", "@corner.nc", "-o", "@short.csv", "--max-time", "0.1"];
    let (exit, out, err) = f.call(&[&words[..], &forms].concat());
    assert_eq!(exit, Exit::Aborted);
    assert!(out.contains("\"state\":\"aborted\"") && out.contains("K-0017"), "{out}");
    let message: serde_json::Value = serde_json::from_str(err.trim()).unwrap();
    assert_eq!((&message["kontur_id"], &message["time_s"]), (&"K-0017".into(), &0.1.into()));
    let trace = f.read("short.csv");
    assert_eq!(
        trace.lines().count(),
        1 + 101,
        "the row of time zero, and a hundred cycles of 1 ms"
    );
    assert!(trace.ends_with('\n'));
}

#[test]
fn what_a_check_sees_refuses_a_run() {
    let f = Folder::new();
    let (exit, out, err) = f.call(&["run", "@bad.nc", "-o", "@bad.csv", "--diagnostics", "json"]);
    assert_eq!((exit, out.contains("aborted")), (Exit::Aborted, true), "{out}");
    let message: serde_json::Value = serde_json::from_str(err.trim()).unwrap();
    assert_eq!((&message["id"], &message["source"]["line"]), (&20131.into(), &6.into()));
    assert!(!f.path("bad.csv").exists());
    let (exit, _, err) = f.call(&["check", "@bad.nc", "@corner.nc"]);
    assert_eq!(exit, Exit::Aborted);
    assert!(err.contains("6 | N60 G777 X0\n  |     ^^^^"), "{err}");
    assert_eq!(f.call(&["check", "@corner.nc"]).0, Exit::Finished);
}

#[test]
fn diff_names_line_and_recognises_a_shift() {
    let f = Folder::new();
    for name in ["corner", "slow"] {
        f.call(&["run", &format!("@{name}.nc"), "-o", &format!("@{name}.csv")]);
    }
    // the same trace, at rest for two cycles first
    let trace = f.read("corner.csv");
    let (header, rows) = trace.split_once('\n').unwrap();
    let cells = |row: &str| row.split_once(',').unwrap().1.to_owned();
    let first = rows.lines().next().unwrap();
    let late = [first, first].into_iter().chain(rows.lines()).enumerate();
    let late = late.map(|(k, row)| format!("{:.6},{}\n", k as f64 * 1e-3, cells(row)));
    let late = format!("{header}\n{}", late.collect::<String>());
    std::fs::write(f.path("late.csv"), late).unwrap();
    let (exit, out, _) = f.call(&["diff", "@corner.csv", "@corner.csv"]);
    assert_eq!((exit, out.starts_with("equal")), (Exit::Finished, true));
    let (exit, out, _) = f.call(&["diff", "@corner.csv", "@slow.csv"]);
    assert_eq!(exit, Exit::Aborted);
    // the fourth edge of the first pass, line 7, is the first that is slower
    assert!(out.contains(" s, line 7 N70: "), "{out}");
    let rows = |name: &str| f.read(name).lines().count() - 1;
    let counts = format!("rows   {} in A, {} in B", rows("corner.csv"), rows("slow.csv"));
    assert!(rows("corner.csv") < rows("slow.csv") && out.contains(&counts), "{out}");
    let (exit, out, _) = f.call(&["diff", "@corner.csv", "@late.csv", "--format", "json"]);
    assert_eq!(exit, Exit::Aborted);
    let json: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(json["result"]["shift_cycles"], 2);
    let (exit, out, _) = f.call(&["diff", "@late.csv", "@corner.csv"]);
    assert_eq!(exit, Exit::Aborted);
    assert!(out.contains("equal if B is taken 2 rows later"), "{out}");
}

#[test]
fn diff_runs_a_program_with_the_columns_of_the_trace() {
    let f = Folder::new();
    f.call(&["run", "@corner.nc", "-o", "@a.csv", "--signals", "set,X_lag_mm"]);
    assert_eq!(f.call(&["diff", "@a.csv", "@corner.nc"]).0, Exit::Finished);
    assert_eq!(f.call(&["diff", "@corner.nc", "@a.csv"]).0, Exit::Finished);
    assert_eq!(f.call(&["diff", "@a.csv", "@slow.nc"]).0, Exit::Aborted);
    assert_eq!(f.call(&["diff", "@corner.nc", "@corner.nc"]).0, Exit::Finished);
}

#[test]
fn report_is_one_self_contained_file() {
    let f = Folder::new();
    assert_eq!(f.call(&["report", "@corner.nc", "@slow.nc", "-o", "@two.html"]).0, Exit::Finished);
    // the name of a name space is no address to go to
    let page = f.read("two.html").replace("http://www.w3.org/2000/svg", "");
    assert!(!page.contains("http://") && !page.contains("https://"), "works offline");
    assert!(!page.contains("/*"), "every place of the template is filled");
    let data = page.split("type=\"application/json\">").nth(1).unwrap().split("</script>").next();
    let data: serde_json::Value = serde_json::from_str(data.unwrap()).unwrap();
    let data = &data["runs"];
    assert_eq!(data.as_array().unwrap().len(), 2);
    let (_, out, _) = f.call(&["run", "@corner.nc", "--summary", "json"]);
    let summary: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(data[0]["k"].as_array().unwrap().len() as u64, summary["cycles"]);
    assert_eq!(data[0]["passes"], 3);
    assert_eq!(f.call(&["report", "@corner.nc", "-o", "@a.svg"]).0, Exit::Finished);
    let svg = f.read("a.svg");
    // the second pass cuts the corners most
    let most = format!("{:.4} mm", summary["max_contour_error"]["mm"].as_f64().unwrap());
    assert!(svg.contains(&format!("pass 2, lines 9 to 12: contour error at most {most}")), "{svg}");
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    // a part of the run, and one that lies beyond its end
    let window =
        |span: &str| f.call(&["report", "@corner.nc", "-o", "@part.html", "--window", span]);
    assert_eq!(window("0.1..0.2").0, Exit::Finished);
    assert!(f.read("part.html").len() < f.read("two.html").len() / 3);
    let (exit, _, err) = window("99..100");
    assert!(exit == Exit::Usage && err.contains("the run ends at"), "{err}");
    let (exit, _, err) = f.call(&["report", "@corner.nc", "-o", "@a.png"]);
    assert_eq!(exit, Exit::Usage);
    assert!(err.contains(".html"), "{err}");
}

#[test]
fn exit_codes_of_wrong_usage_and_files() {
    let f = Folder::new();
    assert_eq!(f.call(&["run", "@absent.nc"]).0, Exit::Io);
    assert_eq!(f.call(&["run", "@corner.nc", "-o", "@no/such/folder/a.csv"]).0, Exit::Io);
    assert_eq!(f.call(&["diff", "@absent.csv", "@absent.csv"]).0, Exit::Io);
    for (name, text, expected) in [
        ("empty.csv", "", Exit::Usage),
        ("foreign.csv", "a,b\n1,2\n", Exit::Usage),
        ("torn.csv", "t_s,line,block\n0.000000,1,10\n0.001000,1", Exit::Io),
    ] {
        std::fs::write(f.path(name), text).unwrap();
        let file = format!("@{name}");
        assert_eq!(f.call(&["diff", &file, "@corner.nc"]).0, expected, "{name}");
    }
    for name in ["@a.html", "@a.SVG"] {
        let (exit, _, err) = f.call(&["run", "@corner.nc", "-o", name]);
        assert!(exit == Exit::Usage && err.contains("kontur report"), "{err}");
        assert!(!f.path(&name[1..]).exists());
    }
    let (exit, _, err) = f.call(&["run", "@corner.nc", "-o", "@a.csv", "--signals", "bogus"]);
    assert_eq!(exit, Exit::Usage);
    assert!(
        err.contains("`bogus`") && err.contains("spindle") && err.contains("X_set_mm"),
        "{err}"
    );
    // a slip of the hand must not cost the program
    for words in [
        ["run", "@corner.nc", "-o", "@corner.nc"].as_slice(),
        &["run", "@corner.nc", "-o", "@a.csv", "-o", "@a.csv"],
        &["run", "@corner.nc", "-o", "@./corner.nc"],
    ] {
        assert_eq!(f.call(words).0, Exit::Usage, "{words:?}");
    }
    assert_eq!(f.read("corner.nc"), kit::CORNER);
    assert_eq!(f.call(&["run"]).0, Exit::Usage);
    let (exit, out, _) = f.call(&["--help"]);
    assert_eq!(exit, Exit::Finished);
    for command in ["run", "check", "diff", "report", "sweep", "explain"] {
        assert!(out.contains(command), "{out}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_ends_with_three() {
    let f = Folder::new();
    f.call(&["run", "@corner.nc", "-o", "@a.csv"]);
    let (exit, _, err) = f.call(&["run", "@corner.nc", "-o", "/dev/full", "-o", "@whole.csv"]);
    assert_eq!(exit, Exit::Io);
    assert!(err.contains("/dev/full"), "{err}");
    let (whole, all) = (f.read("whole.csv"), f.read("a.csv"));
    assert!(
        all.starts_with(&whole) && whole.ends_with('\n'),
        "the other trace is good up to there"
    );
}

#[test]
fn explain_knows_ids_and_commands() {
    let f = Folder::new();
    let (exit, out, _) = f.call(&["explain", "P-ERR-70082"]);
    assert_eq!(exit, Exit::Finished);
    assert!(out.contains("70082") && out.contains("class 5"), "{out}");
    let (exit, out, _) = f.call(&["explain", "#VIB", "GUARD"]);
    assert_eq!((exit, out.contains("AX_DEV")), (Exit::Finished, true), "{out}");
    let (exit, _, err) = f.call(&["explain", "#VIB GARD"]);
    assert_eq!(exit, Exit::Usage);
    assert!(err.contains("did you mean #VIB GUARD"), "{err}");
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
    // at the set frequency nothing is left; a column per convention
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
    // the lists of the built-in machine switch nothing on; a setting does
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
fn response_refuses_what_it_cannot_show() {
    let f = Folder::new();
    for (words, hint) in [
        (&["response"][..], "--filter"),
        (&["response", "--filter", "LOWPAS"], "LOWPASS"),
        (&["response", "--filter", "LOWPASS", "--order", "0"], "order 0"),
        (&["response", "--filter", "LOWPASS", "--order", "1.5"], "whole number"),
        (&["response", "--filter", "LOWPASS", "--f0", "500"], "to below 500 Hz"),
        (&["response", "--filter", "LOWPASS", "--step", "--corner", "F1000"], "--corner"),
        (&["response", "--filter", "LOWPASS", "--residual"], "standard filters"),
        (&["response", "--filter", "HIGHPASS", "--corner", "F1000"], "does not follow"),
        (&["response", "--filter", "TIME_DELAY", "--time", "9000"], "50663"),
        (&["response", "--guard", "MODE=5"], "mode 5"),
        (&["response", "--guard", "DAMPING=1"], "damping 1"),
        (&["response", "--guard", "HZ=5"], "MODE, FREQ, DAMPING"),
        (&["response", "--fir", "MEAN"], "50989"),
        (&["response", "--fir", "HANN,ORDER=4"], "GAUSS"),
        (&["response", "--axis", "Q"], "X, Y, Z"),
        (&["response", "--hsc-mean", "10", "-o", "@a.png"], ".svg"),
        (&["response", "--hsc-mean", "10", "--range", "1..900"], "500 Hz"),
    ] {
        let (exit, _, err) = f.call(words);
        assert_eq!(exit, Exit::Usage, "{words:?}");
        assert!(err.contains(hint), "{words:?}: {err}");
    }
    assert_eq!(f.call(&["response", "--hsc-mean", "10", "-o", "@no/a.csv"]).0, Exit::Io);
}

/// Conformance: A083, V018, V021.
#[test]
fn tune_answers_the_vendors_questions() {
    let f = Folder::new();
    let (exit, out, _) = f.call(&["tune", "--freq", "6.9,6.0,5.4"]);
    assert_eq!(exit, Exit::Finished);
    assert!(out.contains("proposal  #VIB GUARD ON [MODE=2 FREQ=6."), "{out}");
    assert!(out.contains("#VIB GUARD ON [MODE=2 FREQ=6 DAMPING=0.1]"), "{out}");
    let (exit, out, _) = f.call(&["tune", "--order-for", "0.1", "--feed", "F2000"]);
    assert_eq!(exit, Exit::Finished);
    assert!(out.contains("[ORDER=23]") && out.contains("[ORDER=22]"), "{out}");
    for words in [
        &["tune"][..],
        &["tune", "--freq", "0"],
        &["tune", "--freq", "6", "--damping", "1"],
        &["tune", "--freq", "6", "--order-for", "0.1"],
        &["tune", "--freq", "6", "--program", "@corner.nc"],
        &["tune", "--recording", "@corner.nc"],
    ] {
        assert_eq!(f.call(words).0, Exit::Usage, "{words:?}");
    }
    assert_eq!(f.call(&["tune", "--recording", "@absent.csv"]).0, Exit::Io);
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
    // the limits of the machine and what was assumed
    assert!(out.contains("machine   xyz, cycle 1 ms") && out.contains("v_max"), "{out}");
    assert!(out.contains("no AX_DEV in the program"), "{out}");
    let rows: Vec<&str> = out.lines().skip_while(|l| !l.contains("machining time")).collect();
    assert!(rows[1].starts_with("off") && rows[1].ends_with("no"), "{out}");
    let chosen = rows.iter().find_map(|l| l.strip_prefix("choice    ")).unwrap();
    // the shortest kernel that keeps 5 % has the least to flush at the end of a pass
    let times: Vec<f64> = rows[2..]
        .iter()
        .filter(|row| row.ends_with("yes"))
        .map(|row| row.split_whitespace().rev().nth(2).unwrap().parse().unwrap())
        .collect();
    let least = times.iter().copied().fold(f64::MAX, f64::min);
    assert!(times.len() > 2 && out.contains(&format!("1 mm: {least:.3} s")), "{out}");
    assert!(chosen.starts_with("#VIB GUARD ON [MODE="), "{chosen}");
    // what leaves the bound runs again with it as AX_DEV, and keeps it or not
    let (_, out, _) = tune("@corner.nc", "0.001");
    let again = |l: &&str| l.contains(" 0.001  ");
    assert!(out.lines().filter(again).count() > 2, "{out}");
    // what the program says itself
    program(&square.replace("N10", "N10 #VIB GUARD ON [AX_DEV=0.02]\nN20"));
    let (_, out, _) = tune("@corner.nc", "1");
    assert!(out.contains("AX_DEV=0.02 (line 1)") && out.contains(" AX_DEV=0.02]\n"), "{out}");
    let rows = |out: &str| -> Vec<String> {
        out.lines().skip_while(|l| !l.contains("machining time")).map(str::to_owned).collect()
    };
    // words that are to be chosen give way, also where they are computed or stand in a subroutine
    let plain = rows(&out);
    let computed = "#VIB GUARD ON [MODE=P1 FREQ=[P1*20] AX_DEV=0.02]";
    program(&square.replace("N10", &format!("P1=2\n{computed}\nN20")));
    let (exit, out, _) = tune("@corner.nc", "1");
    assert_eq!(exit, Exit::Finished);
    assert!(out.contains("(line 2) give way"), "{out}");
    assert_eq!(rows(&out), plain);
    let sub = format!("%L SUB\nP1=2\n{computed}\nM17\n%MAIN\nLL SUB\n{square}");
    program(&sub);
    let (_, out, _) = tune("@corner.nc", "1");
    assert!(out.contains("(line 3) give way"), "{out}");
    assert_eq!(rows(&out), plain);
    assert_eq!(f.read("corner.nc"), sub);
    // a program that ends the guard at once: none of the choices acts for long enough to compare
    program(&square.replace("N10", "N10 #VIB GUARD OFF\nN20"));
    let (_, out, _) = tune("@corner.nc", "1");
    assert!(out.contains("line 1 switches the guard off"), "{out}");
    assert_eq!(tune("@bad.nc", "1").0, Exit::Aborted);
}

/// One row per combination in their order, the same from the same input, whatever core was first.
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
        // what `run` says of the same settings
        let settings = [0, 1].map(|i| format!("{}={}", &header[i], &row[i]));
        let (_, out, _) = f.call(&[
            "run",
            "@listed.nc",
            "--summary",
            "json",
            "--set",
            "X.vib_guard.active=1",
            "--set",
            &settings[0],
            "--set",
            &settings[1],
        ]);
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

/// Runs that an error ends have their rows; only if no run finishes, neither does the command.
#[test]
fn sweep_of_aborted_runs_and_wrong_words() {
    let f = Folder::new();
    let vary = "X.vib_guard.mode=1,2";
    let (exit, out, _) = f.call(&["sweep", "@bad.nc", "--vary", vary, "--columns", "cycles"]);
    assert_eq!(exit, Exit::Aborted);
    let rows: Vec<&str> = out.lines().collect();
    assert_eq!(rows[0], "X.vib_guard.mode,state,error,warnings,cycles");
    assert!(rows[1].starts_with("1,aborted,20131,0,") && rows.len() == 3, "{out}");
    for words in [
        &["sweep", "@corner.nc"][..],
        &["sweep", "@corner.nc", "--vary", "X.vib_guard.mode"],
        &["sweep", "@corner.nc", "--vary", "X.vib_guard.mode=3..1"],
        &["sweep", "@corner.nc", "--vary", vary, "--columns", "bogus"],
        &["sweep", "@corner.nc", "--vary", vary, "--amplitude", "X_bogus_mm@1..2"],
        &["sweep", "@corner.nc", "--vary", vary, "--amplitude", "v_limit@1..2"],
        &["sweep", "@corner.nc", "--vary", "X.a.b=ON,OFF", "-o", "@a.svg"],
        &["sweep", "@corner.nc", "--vary", vary, "-o", "@corner.nc"],
    ] {
        assert_eq!(f.call(words).0, Exit::Usage, "{words:?}");
    }
    assert_eq!(f.call(&["sweep", "@absent.nc", "--vary", vary]).0, Exit::Io);
}

/// Columns over time, and the variants of one program in one picture.
#[test]
fn report_draws_signals_and_variants() {
    let f = Folder::new();
    // beyond the end of the run, and beyond what the cycle can show, there is nothing to draw
    for part in [["--window", "7000..9000"], ["--spectrum", "600..900"]] {
        let words = ["report", "@corner.nc", "--signals", "set", "-o", "@a.svg"];
        let (exit, _, err) = f.call(&[&words[..], &part].concat());
        assert_eq!((exit, err.contains(part[0])), (Exit::Usage, true), "{err}");
    }
    let words = |name: &'static str| {
        [
            "report",
            "@corner.nc",
            "--vary",
            "X.vib_guard.mode=1,4",
            "--signals",
            "X_set_mm,X_vel_mm_s",
            "--window",
            "0.01..0.05",
            "-o",
            name,
        ]
    };
    assert_eq!(f.call(&words("@a.svg")).0, Exit::Finished);
    let picture = f.read("a.svg");
    for name in [">X_set_mm<", ">X_vel_mm_s<", "mode = 1", "mode = 4"] {
        assert!(picture.contains(name), "{name}");
    }
    assert_eq!(f.call(&words("@a.csv")).0, Exit::Finished);
    let table = f.read("a.csv");
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows[0], "curve,t_s,X_set_mm,X_vel_mm_s");
    assert_eq!(rows.len(), 1 + 2 * 40, "40 cycles of either");
    let spectrum = [&words("@s.csv")[..], &["--spectrum", "0..100"]].concat();
    assert_eq!(f.call(&spectrum).0, Exit::Finished);
    assert!(f.read("s.csv").starts_with("curve,f_hz,X_set_mm,X_vel_mm_s\n"));
    for wrong in [
        &["report", "@corner.nc", "--signals", "bogus", "-o", "@b.svg"][..],
        &["report", "@corner.nc", "--signals", "time", "-o", "@b.svg"],
        &["report", "@corner.nc", "--signals", "X_set_mm", "-o", "@b.html"],
        &["report", "@corner.nc", "--spectrum", "0..100", "-o", "@b.svg"],
    ] {
        assert_eq!(f.call(wrong).0, Exit::Usage, "{wrong:?}");
    }
    // without --signals the contours overlay
    let contours = ["report", "@corner.nc", "--vary", "X.vib_guard.mode=1,4", "-o", "@c.svg"];
    assert_eq!(f.call(&contours).0, Exit::Finished);
    assert!(f.read("c.svg").contains("mode = 4"));
}
