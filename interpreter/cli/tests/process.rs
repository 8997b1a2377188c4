//! Behaviour that needs a process: standard input, and a reader that closes stdout.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Output, Stdio};

const PROGRAM: &str = "G01 X10 F1000\nY5\nM30\n";

fn start(words: &[&str], folder: &std::path::Path) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kontur"));
    command.args(words).current_dir(folder);
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    piped.spawn().unwrap()
}

fn with_input(words: &[&str], input: &str, folder: &std::path::Path) -> Output {
    let mut child = start(words, folder);
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn a_program_from_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.nc"), PROGRAM).unwrap();
    let from_file = with_input(&["run", "a.nc", "-o", "-"], "", folder.path());
    let piped = with_input(&["run", "-", "-o", "-"], PROGRAM, folder.path());
    assert_eq!((piped.status.code(), from_file.status.code()), (Some(0), Some(0)));
    assert_eq!(piped.stdout, from_file.stdout);
    assert!(piped.stdout.starts_with(b"t_s,"));
    assert!(String::from_utf8(piped.stderr).unwrap().starts_with("<stdin>  finished"));
    // an error is reported with its position
    let wrong = with_input(&["check", "-"], "G01 X10 F100\nG7\nM30\n", folder.path());
    assert_eq!(wrong.status.code(), Some(1));
    assert!(String::from_utf8(wrong.stderr).unwrap().contains("<stdin>:2:1"));
    assert!(!folder.path().join("-").exists());
}

#[test]
fn a_reader_that_has_seen_enough_ends_the_run_silently() {
    let folder = tempfile::tempdir().unwrap();
    // longer than any pipe
    std::fs::write(folder.path().join("a.nc"), "G01 X400 F600\nX0\nM30\n").unwrap();
    let mut child = start(&["run", "a.nc", "-o", "-", "--summary", "none"], folder.path());
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with("t_s,"));
    let ended = child.wait_with_output().unwrap();
    assert_eq!((ended.status.code(), ended.stderr), (Some(3), Vec::new()));
}

/// Two turns of a circle of 10 mm as chords, with the smallest tolerance that leaves the spline unchanged: a sixth of a chord
/// times the change of direction.
fn splined_circle(chord_mm: f64, feed: u32) -> String {
    use std::f64::consts::PI;
    use std::fmt::Write;
    let n = (2.0 * PI * 10.0 / chord_mm).round();
    let jump = 2.0 * libm::sin(PI / n);
    let path_dev = 1.02 * 10.0 * jump * jump / 6.0;
    let mut text =
        format!("#SLOPE [TYPE=HSC]\nG00 X10\n#HSC ON [BSPLINE PATH_DEV={path_dev:.7}]\n");
    for k in 1..=2 * n as u32 {
        let (sin, cos) = libm::sincos(2.0 * PI * f64::from(k) / n);
        writeln!(text, "G01 X{:.6} Y{:.6} F{feed}", 10.0 * cos, 10.0 * sin).unwrap();
    }
    text + "M30\n"
}

/// The ripple of the path velocity stays below 1 %, in the trace and in the summary, at half the velocity that the acceleration
/// of machine `xyz` allows on the circle (200 mm/s).
#[test]
fn a_splined_circle_has_no_ripple() {
    let machine = concat!(env!("CARGO_MANIFEST_DIR"), "/../../programs/machines/xyz");
    let folder = tempfile::tempdir().unwrap();
    let words = ["run", "-", "--machine", machine, "-o", "-", "--signals", "ipo"];
    let words = [&words[..], &["--summary", "json"]].concat();
    for chord in [0.05, 0.2, 0.5, 1.0, 2.0] {
        let out = with_input(&words, &splined_circle(chord, 6000), folder.path());
        assert_eq!(out.status.code(), Some(0));
        let summary: serde_json::Value = serde_json::from_slice(&out.stderr).unwrap();
        let stated = summary["speed_ripple"]["ratio"].as_f64().unwrap_or(0.0);
        assert!(stated < 0.01, "{chord}: {stated}");
        let trace = String::from_utf8(out.stdout).unwrap();
        let mut lines = trace.lines();
        let names: Vec<&str> = lines.next().unwrap().split(',').collect();
        let [x, y] = ["X_ipo_mm", "Y_ipo_mm"].map(|n| names.iter().position(|m| *m == n).unwrap());
        let points: Vec<[f64; 2]> = lines
            .map(|l| l.split(',').collect::<Vec<_>>())
            .map(|cells| [x, y].map(|i| cells[i].parse().unwrap()))
            .collect();
        let steps: Vec<f64> =
            points.windows(2).map(|w| libm::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1])).collect();
        // the second half of the path: after the rapid block, before the stop
        let middle = &steps[steps.len() / 2..steps.len() * 9 / 10];
        let high = middle.iter().copied().fold(0.0, f64::max);
        let low = middle.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(high > 0.09 && (high - low) / high < 0.01, "{chord}: {low} {high}");
    }
}
