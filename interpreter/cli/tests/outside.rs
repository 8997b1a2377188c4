//! The command line from outside: files, formats, exit codes.

use crate::kit::Folder;
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
    // the largest contour error of the summary is in the trace, at its time and line
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
    assert_eq!((exit, err.contains("two outputs to the same file")), (Exit::Usage, true));
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
    // every bit against seven decimals, and all of it against a new run
    for words in [["@a.parquet", "@a.csv"], ["@a.csv", "@a.parquet"]] {
        let (exit, out, _) = f.call(&[&["diff"][..], &words].concat());
        assert_eq!((exit, out.as_str()), (Exit::Finished, "equal: 101 rows\n"));
    }
    assert_eq!(f.call(&["run", "@corner.nc", "-o", "@whole.parquet"]).0, Exit::Finished);
    assert_eq!(f.call(&["diff", "@corner.nc", "@whole.parquet"]).0, Exit::Finished);
    let (exit, out, _) = f.call(&["diff", "@whole.parquet", "@slow.nc"]);
    assert!(exit == Exit::Aborted && out.contains(" s, line 7 N70: "), "{out}");
    // a table that is not a trace, and a truncated one
    std::fs::write(f.path("cut.parquet"), &bytes[..bytes.len() / 2]).unwrap();
    assert_eq!(f.call(&["diff", "@cut.parquet", "@a.csv"]).0, Exit::Io);
    std::fs::write(f.path("no.parquet"), "t_s,line\n0,1\n").unwrap();
    let (exit, _, err) = f.call(&["diff", "@no.parquet", "@a.csv"]);
    assert_eq!((exit, err.contains("not a Parquet file")), (Exit::Usage, true));
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
fn diff_names_line_and_recognises_a_shift() {
    let f = Folder::new();
    for name in ["corner", "slow"] {
        f.call(&["run", &format!("@{name}.nc"), "-o", &format!("@{name}.csv")]);
    }
    // the same trace after two cycles at standstill
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
    // the fourth edge of the first pass, line 7, is the first slower one
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
    // another cycle time is compared at the times of both, or not at all
    f.call(&["run", "@corner.nc", "-o", "@two.csv", "--cycle-us", "2000"]);
    let (exit, out, _) = f.call(&["diff", "@corner.csv", "@two.csv"]);
    assert_eq!(exit, Exit::Aborted);
    assert!(out.contains("compared at equal times: one of every 2 rows of A"), "{out}");
    f.call(&["run", "@corner.nc", "-o", "@other.csv", "--cycle-us", "1500"]);
    let (exit, out, _) = f.call(&["diff", "@corner.csv", "@other.csv"]);
    assert_eq!(exit, Exit::Aborted);
    assert!(out.contains("  times  row 1 is at 0.001000 s in A and at 0.001500 s in B: "), "{out}");
}

/// An approved trace of a program that does not reach its end must not stay approved.
#[test]
fn diff_fails_with_the_program_that_it_runs() {
    let f = Folder::new();
    let limit = ["--max-time", "0.5"];
    let run = [&["run", "@corner.nc", "-o", "@a.csv"][..], &limit].concat();
    assert_eq!(f.call(&run).0, Exit::Aborted);
    let words = [
        ("text", "equal: "),
        ("text", "corner.nc was refused, or ended"),
        ("json", "corner.nc\"]"),
        ("junit", "name=\"run of"),
        ("github", "::error title=run of"),
    ];
    for (format, word) in words {
        let call = [&["diff", "@a.csv", "@corner.nc", "--format", format][..], &limit].concat();
        let (exit, out, _) = f.call(&call);
        assert_eq!((exit, out.contains(word)), (Exit::Aborted, true), "{format}: {out}");
    }
}

#[test]
fn report_is_one_self_contained_file() {
    let f = Folder::new();
    assert_eq!(f.call(&["report", "@corner.nc", "@slow.nc", "-o", "@two.html"]).0, Exit::Finished);
    // the name of a namespace is not a link
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
    // the corners of the second pass have the largest deviation
    let most = format!("{:.4} mm", summary["max_contour_error"]["mm"].as_f64().unwrap());
    assert!(svg.contains(&format!("pass 2, lines 9 to 12: contour error at most {most}")), "{svg}");
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    // a part of the run, and a part beyond its end
    let window =
        |span: &str| f.call(&["report", "@corner.nc", "-o", "@part.html", "--window", span]);
    assert_eq!(window("0.1..0.2").0, Exit::Finished);
    assert!(f.read("part.html").len() < f.read("two.html").len() / 3);
    let (exit, _, err) = window("99..100");
    assert!(exit == Exit::Usage && err.contains("the run ends at"), "{err}");
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
