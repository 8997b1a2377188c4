//! `kontur diff` between a program and the recording of a machine, in the export format of TwinCAT Scope.

use kontur::Exit;
use kontur_tests::command::{Folder, near};
use serde_json::Value;
use std::fmt::Write as _;
use std::ops::Range;

/// Two axes, TRAPEZ, with a dwell in between.
const PROGRAM: &str = "%P\nN10 G90 G01 X20 Y-5 F6000\nN20 G04 0.1\nN30 X-3 Y7.5 F4000\nN40 M30\n";

struct Bench {
    folder: Folder,
    /// Set positions of X and Y in mm, one pair per millisecond.
    set: Vec<[f64; 2]>,
}

/// A recording made from the positions, and how it differs from them.
#[derive(Clone)]
struct Recorder {
    /// How much earlier it begins.
    lead_s: f64,
    step_s: f64,
    /// X in micrometres with the opposite sign, Y unchanged.
    noise_mm: f64,
    /// Samples that are missing.
    missing: Range<usize>,
}

const PLAIN: Recorder = Recorder { lead_s: 0.012, step_s: 0.001, noise_mm: 0.0, missing: 0..0 };

impl Bench {
    fn new() -> Self {
        let folder = Folder::new(&[("part.nc", PROGRAM)]);
        folder.summary(&["-o", "@part.csv", "--signals", "X_set_mm,Y_set_mm"]);
        let [x, y] = ["X_set_mm", "Y_set_mm"].map(|name| folder.table("part.csv").numbers(name));
        Self { folder, set: x.into_iter().zip(y).map(|(x, y)| [x, y]).collect() }
    }

    /// Position at a time, at rest before the beginning and after the end.
    fn at(&self, axis: usize, time_s: f64) -> f64 {
        let place = (time_s / 0.001).clamp(0.0, (self.set.len() - 1) as f64);
        let (k, part) = (place.floor() as usize, place.fract());
        let next = self.set[(k + 1).min(self.set.len() - 1)][axis];
        self.set[k][axis] + part * (next - self.set[k][axis])
    }

    /// An export in the layout of TwinCAT Scope, with German numbers; `change` may spoil a sample.
    fn export(&self, r: &Recorder, change: impl Fn(usize, &mut [f64; 2])) -> String {
        let ms = format!("{}", 1e3 * r.step_s).replace('.', ",");
        let mut text = format!(
            "Name\tAxes\nFile\tbench.svdx\n\nName\tX\tY\nSymbolName\tAxes.X.fSet\tAxes.Y.fSet\n\
             SampleTime[ms]\t{ms}\t{ms}\nData-Type\tREAL64\tREAL64\n\n"
        );
        let samples = ((self.set.len() as f64 * 0.001 + 2.0 * r.lead_s) / r.step_s) as usize;
        for i in (0..samples).filter(|i| !r.missing.contains(i)) {
            let time_s = i as f64 * r.step_s;
            // noise without a random generator: the fractions of the multiples of an irrational number
            let noise = |k: f64| r.noise_mm * (2.0 * (i as f64 * k).fract() - 1.0);
            let mut mm = [0, 1].map(|axis| self.at(axis, time_s - r.lead_s));
            mm[0] += noise(0.618_033_988_75);
            mm[1] += noise(0.414_213_562_37);
            change(i, &mut mm);
            let row = format!("{:.4}\t{:.6}\t{:.8}\n", 1e3 * time_s, -1e3 * mm[0], mm[1]);
            text.push_str(&row.replace('.', ","));
        }
        writeln!(text, "EOF").unwrap();
        text
    }

    fn diff(&self, export: &str) -> (Exit, Value) {
        self.diff_within(export, "0")
    }

    fn diff_within(&self, export: &str, tolerance_mm: &str) -> (Exit, Value) {
        let maps = ["X_set_mm=-0.001*Axes.X.fSet", "Y_set_mm=Axes.Y.fSet"];
        diff(&self.folder, export, &maps, tolerance_mm)
    }
}

/// A comparison of `part.nc` with a recording of X and Y: exit code and answer.
fn diff(folder: &Folder, recording: &str, maps: &[&str; 2], tolerance_mm: &str) -> (Exit, Value) {
    std::fs::write(folder.path("scope.csv"), recording).unwrap();
    let words = ["diff", "@part.nc", "@scope.csv", "--format", "json", "--tol-mm", tolerance_mm];
    let maps = ["--map", maps[0], "--map", maps[1]];
    let done = folder.call(&[&words[..], &maps].concat());
    (done.exit, serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{}", done.err)))
}

/// Another unit and sign, a beginning 12 cycles earlier or 3.4 ms later, other sampling times, noise below 0.1 um: equal.
#[test]
fn a_recording_of_the_same_motion_is_equal() {
    let bench = Bench::new();
    for (lead_s, step_s, noise_mm, shift, tolerance) in [
        (0.012, 0.001, 0.0, 12.0, "0"),
        (0.012, 0.001, 4e-5, 12.0, "0"),
        (0.5, 0.001, 0.0, 500.0, "0"),
        (0.0035, 0.000_25, 0.0, 3.5, "0"),
        // no sample at the set points: at their corners the polyline loses at most a T^2 / 8
        (0.0034, 0.000_25, 0.0, 3.4, "0.0003"),
    ] {
        let recorder = Recorder { lead_s, step_s, noise_mm, ..PLAIN };
        let (exit, found) = bench.diff_within(&bench.export(&recorder, |_, _| {}), tolerance);
        assert_eq!(exit, Exit::Finished, "{found}");
        near(&found["result"]["shift_cycles"], shift, 1e-3);
        for pair in 0..2 {
            near(&found["result"]["pairs"][pair]["rows"], bench.set.len() as f64, 1.0);
        }
    }
}

/// A micrometre in one sample of one axis: reported with time, line and size. An offset of the zero points is the mean.
#[test]
fn what_differs_is_named() {
    let bench = Bench::new();
    let (exit, found) = bench.diff(&bench.export(&PLAIN, |i, mm| {
        if i == 112 {
            mm[1] += 1e-3;
        }
    }));
    assert_eq!(exit, Exit::Aborted);
    let pairs = &found["result"]["pairs"];
    assert_eq!(pairs[0]["different"], 0);
    assert_eq!(pairs[1]["different"], 1);
    near(&pairs[1]["worst"]["time_s"], 0.1, 1e-9);
    assert_eq!(pairs[1]["first"]["line"], "2");
    let (b, a) = (&pairs[1]["worst"]["b"], &pairs[1]["worst"]["a"]);
    near(b, a.as_f64().unwrap() + 1e-3, 1e-7);
    let (exit, found) = bench.diff(&bench.export(&PLAIN, |_, mm| mm[0] += 2.5));
    assert_eq!(exit, Exit::Aborted);
    near(&found["result"]["pairs"][0]["mean"], 2.5, 1e-6);
    near(&found["result"]["pairs"][0]["rms"], 0.0, 1e-6);
}

/// Missing samples are reported and not compared; whatever happens beyond the ends of either one is a difference.
#[test]
fn drop_outs_and_ends() {
    let bench = Bench::new();
    let gap = Recorder { missing: 100..103, ..PLAIN };
    let (exit, found) = bench.diff(&bench.export(&gap, |_, _| {}));
    assert_eq!(exit, Exit::Finished, "{found}");
    let pair = &found["result"]["pairs"][0];
    assert_eq!(pair["drop_outs"][0][1], 3);
    near(&pair["drop_outs"][0][0], 0.099, 1e-9);
    near(&pair["rows"], bench.set.len() as f64 - 3.0, 0.0);
    let stopped = Recorder { missing: 300..usize::MAX, ..PLAIN };
    let (exit, found) = bench.diff(&bench.export(&stopped, |_, _| {}));
    assert_eq!(exit, Exit::Aborted);
    assert_eq!(found["result"]["pairs"][0]["different"], 0, "{found}");
    assert_eq!(found["result"]["pairs"][0]["trace_goes_on"], true);
    // the machine moved on after the program
    let end = bench.set.len() + 12 + 3;
    let (exit, found) = bench.diff(&bench.export(&PLAIN, |i, mm| {
        if i > end {
            mm[0] += 0.01 * (i - end) as f64;
        }
    }));
    assert_eq!(exit, Exit::Aborted);
    assert_eq!(found["result"]["pairs"][0]["recording_goes_on"], true);
    assert_eq!(found["result"]["pairs"][1]["recording_goes_on"], false);
}

/// Nothing moves in either one: they agree, and no shift is invented. Every tenth sample is missing: the text lists ten of the drop-outs
/// and counts the rest.
#[test]
fn rest_and_many_drop_outs() {
    let rows: Vec<String> = (0..400).filter(|k| k % 10 != 5).map(|k| format!("{k}\t0\n")).collect();
    let recording = format!("time_ms\tX\n{}", rows.concat());
    let folder = Folder::new(&[("part.nc", "G04 0.2\nM30\n"), ("scope.txt", &recording)]);
    let done = folder.call(&["diff", "@part.nc", "@scope.txt", "--map", "X_set_mm=X"]);
    assert_eq!(done.exit, Exit::Finished, "{}{}", done.out, done.err);
    assert!(done.out.contains("  shift  none\n"), "{}", done.out);
    assert_eq!(done.out.matches("drop-out  1 sample missing").count(), 10, "{}", done.out);
    assert!(done.out.contains("    drop-outs  30 more\n"), "{}", done.out);
}

/// A plain table of the motion itself: times printed with a given number of decimals, Y from a given time on.
fn table(bench: &Bench, step_s: f64, decimals: usize, y_from_s: f64) -> String {
    let samples = ((bench.set.len() - 1) as f64 * 0.001 / step_s) as usize;
    let row = |i: usize| {
        let time_s = i as f64 * step_s;
        let [x, y] = [0, 1].map(|axis| bench.at(axis, time_s));
        let y = if time_s < y_from_s { String::new() } else { format!("{y:.7}") };
        format!("{time_s:.decimals$},{x:.7},{y}\n")
    };
    let rows: Vec<String> = (0..=samples).map(row).collect();
    format!("t_s,x,y\n{}", rows.concat())
}

/// The recording of the motion itself is equal to it, also where one channel begins later than the other and where the times are rounded:
/// 3 kHz with four decimals, 2.5 ms with three.
#[test]
fn clocks_and_rounded_times() {
    let bench = Bench::new();
    for (step_s, decimals, y_from_s, tolerance_mm) in [
        (0.001, 4, 0.0, "0"),
        (0.001, 4, 0.1, "0"),
        // between the samples a polyline loses a T^2 / 8, about 0.4 um per ms^2 with 3.5 m/s2
        (1.0 / 3000.0, 4, 0.05, "0.002"),
        (0.0025, 3, 0.0, "0.005"),
    ] {
        let recording = table(&bench, step_s, decimals, y_from_s);
        let maps = ["X_set_mm=x", "Y_set_mm=y"];
        let (_, found) = diff(&bench.folder, &recording, &maps, tolerance_mm);
        let result = &found["result"];
        near(&result["shift_cycles"], 0.0, 0.1);
        for pair in 0..2 {
            assert_eq!(result["pairs"][pair]["different"], 0, "{step_s} {y_from_s}: {found}");
            assert_eq!(result["pairs"][pair]["drop_outs"], serde_json::json!([]));
        }
        // the trace moves Y where the recording does not contain Y yet
        assert_eq!(result["pairs"][1]["trace_goes_on"], y_from_s > 0.0);
    }
    // 1.5 ms rounded to milliseconds: off by a third of a step
    let recording = table(&bench, 0.0015, 3, 0.0);
    let folder = bench.folder.with("t.csv", recording);
    let done = folder.call(&["diff", "@part.nc", "@t.csv", "--map", "X_set_mm=x"]);
    assert!(done.exit == Exit::Usage && done.err.contains("equal steps"), "{}", done.err);
}

/// A recording of every second or fourth row, copied digit by digit, is equal to the trace; an added step of 1 um is found.
#[test]
fn a_recording_with_fewer_samples_is_compared_at_its_samples() {
    let bench = Bench::new();
    for each in [2, 4, 10] {
        for spoiled in [false, true] {
            let mut text = String::from("time,x,y\n");
            for (k, [x, y]) in bench.set.iter().enumerate().step_by(each) {
                let x = if spoiled && k / each == 20 { x + 1e-3 } else { *x };
                let _ = writeln!(text, "{},{x},{y}", k as f64 * 1e-3);
            }
            std::fs::write(bench.folder.path("coarse.csv"), text).unwrap();
            let words = ["diff", "@part.nc", "@coarse.csv", "--map", "X_set_mm=x"];
            let said = bench.folder.call(&words);
            let expected = if spoiled { Exit::Aborted } else { Exit::Finished };
            assert_eq!(said.exit, expected, "{each}: {}", said.out);
            let differ = format!("{} differ by", u32::from(spoiled));
            assert!(said.out.contains(&differ), "{each}: {}", said.out);
        }
    }
}

/// A run ends while its axis is still creeping into its window. A coarse recording of it is equal whatever the phase of its samples,
/// although the last rows lie between two of them; a recording that ends two samples earlier is not.
#[test]
fn the_phase_of_the_samples_does_not_matter() {
    let folder = Folder::new(&[("part.nc", "N10 G01 X10 F6000\nN20 Y10\nM30\n")]);
    folder.summary(&["-o", "@part.csv", "--signals", "Y_act_mm"]);
    let trace = folder.table("part.csv");
    let y = trace.texts("Y_act_mm");
    let end = y.len() - 1;
    assert!((y[end].parse::<f64>().unwrap() - y[end - 2].parse::<f64>().unwrap()).abs() > 1e-3);
    for each in [2, 3, 4, 10] {
        for lead in 20..20 + each {
            for short in [false, true] {
                let last = if short { end + lead - 2 * each } else { end + lead + 3 * each };
                let mut text = String::from("t_s,y\n");
                for k in (0..=last).step_by(each) {
                    let row = y[k.saturating_sub(lead).min(end)];
                    let _ = writeln!(text, "{:.3},{row}", k as f64 * 1e-3);
                }
                std::fs::write(folder.path("coarse.csv"), text).unwrap();
                let words = ["diff", "@part.nc", "@coarse.csv", "--map", "Y_act_mm=y"];
                let said = folder.call(&words);
                let expected = if short { Exit::Aborted } else { Exit::Finished };
                assert_eq!(said.exit, expected, "{each} {lead} {short}: {}", said.out);
            }
        }
    }
}

/// Thirty turns of a circle, recorded from the second, third or fifth second on: one shift makes all rows equal; others are off by whole
/// turns and differ only where the motion begins or ends.
#[test]
fn a_motion_that_repeats_itself_is_not_shifted_by_a_turn() {
    let turns = "G03 I-10 X10 Y0\n".repeat(30);
    let folder = Folder::new(&[("part.nc", &format!("G01 X10 F6000\n{turns}M30\n"))]);
    folder.summary(&["-o", "@part.csv", "--signals", "X_act_mm,Y_act_mm"]);
    let trace = folder.table("part.csv");
    let rows: Vec<_> = trace.texts("X_act_mm").into_iter().zip(trace.texts("Y_act_mm")).collect();
    for begin in [1000, 2000, 3000, 5000] {
        let mut text = String::from("t_s,x,y\n");
        for (k, (x, y)) in rows[begin..].iter().enumerate() {
            let _ = writeln!(text, "{:.3},{x},{y}", k as f64 * 1e-3);
        }
        let (exit, found) = diff(&folder, &text, &["X_act_mm=x", "Y_act_mm=y"], "0");
        near(&found["result"]["shift_cycles"], -(begin as f64), 1e-3);
        for pair in 0..2 {
            assert_eq!(found["result"]["pairs"][pair]["different"], 0, "{begin}: {found}");
        }
        // the trace moves before the recording begins
        assert_eq!(exit, Exit::Aborted);
    }
}
