//! The commands of `interpreter/cli/docs/figures.md` draw what the figures of the documents show.

use kontur::console::Console;
use kontur::simulator::Kontur;
use kontur::{Exit, run_with};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::Path;

/// Numbers of a curve, by column.
type Curve = Vec<BTreeMap<String, f64>>;

/// Runs the command that is listed with a file name and gives its curves in their order.
fn figure(name: &str) -> Vec<Curve> {
    let list = Path::new(env!("CARGO_MANIFEST_DIR")).join("../interpreter/cli/docs/figures.md");
    let text = std::fs::read_to_string(list).unwrap();
    let svg = format!(" -o {name}.svg");
    let command = text.split('`').find(|part| part.ends_with(&svg)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let (picture, table) = (folder.path().join("a.svg"), folder.path().join("a.csv"));
    let words = command.strip_suffix(&svg).unwrap().split_whitespace().map(OsString::from);
    let files = ["-o".into(), picture.clone().into(), "-o".into(), table.clone().into()];
    let mut console = Console::new(Vec::new(), Vec::new());
    assert_eq!(
        run_with(words.chain(files), &mut Kontur, &mut console),
        Exit::Finished,
        "{command}"
    );
    assert!(std::fs::read_to_string(picture).unwrap().starts_with("<svg"));
    let mut reader = csv::Reader::from_path(table).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut curves: Vec<(String, Curve)> = Vec::new();
    for record in reader.records() {
        let record = record.unwrap();
        if curves.last().is_none_or(|(curve, _)| *curve != record[0]) {
            curves.push((record[0].to_owned(), Vec::new()));
        }
        let cells = names.iter().zip(&record).skip(1);
        let row =
            cells.filter_map(|(name, cell)| Some((name.clone(), cell.parse().ok()?))).collect();
        curves.last_mut().unwrap().1.push(row);
    }
    curves.into_iter().map(|(_, curve)| curve).collect()
}

/// Value of a column where another one is nearest to `at`.
fn at(curve: &Curve, x: &str, at: f64, y: &str) -> f64 {
    curve.iter().min_by(|a, b| (a[x] - at).abs().total_cmp(&(b[x] - at).abs())).unwrap()[y]
}

/// The step response from time 0 on, sample by sample.
fn step(curve: &Curve) -> Vec<f64> {
    curve.iter().filter(|row| row["t_s"] >= 0.0).map(|row| row["output"]).collect()
}

fn near(is: f64, want: f64, tolerance: f64) {
    assert!((is - want).abs() <= tolerance, "{is} is not {want} +- {tolerance}");
}

/// Conformance: A030.
#[test]
fn steps_of_the_prototypes() {
    let curves = figure("figure2");
    assert_eq!(curves.len(), 3);
    for (curve, want) in curves.iter().zip([1.0, 1.00858, 1.10859]) {
        near(step(curve).into_iter().fold(0.0, f64::max), want, 6e-6);
    }
}

/// Conformance: A039.
#[test]
fn band_passes() {
    let curves = figure("figure5");
    assert_eq!(curves.len(), 3);
    for curve in &curves {
        near(at(curve, "f_hz", 15.0, "magnitude_db"), 0.0, 0.01);
        for edge in [0.618 * 15.0, 1.618 * 15.0] {
            near(at(curve, "f_hz", edge, "magnitude_db"), -3.01, 0.15);
        }
    }
}

/// Conformance: A052.
#[test]
fn an_all_pass() {
    let curves = figure("figure9");
    let curve = &curves[0];
    assert!(curve.iter().all(|row| row["magnitude_db"].abs() < 1e-6));
    near(at(curve, "f_hz", 1.0, "phase_deg"), 0.0, 15.0);
    near(at(curve, "f_hz", 200.0, "phase_deg"), -360.0, 20.0);
    assert!(curve.windows(2).all(|pair| pair[1]["phase_deg"] < pair[0]["phase_deg"]));
}

/// Conformance: A058, A061.
#[test]
fn lags_over_their_time_constant() {
    for (name, db) in [("figure10", -3.01), ("figure11", -6.02)] {
        let curves = figure(name);
        assert_eq!(curves.len(), 3);
        for (curve, time_s) in curves.iter().zip([0.005, 0.010, 0.020]) {
            let corner = 1.0 / (2.0 * std::f64::consts::PI * time_s);
            near(at(curve, "f_hz", corner, "magnitude_db"), db, 0.05);
        }
    }
    for curve in figure("figure12") {
        assert!(step(&curve).iter().all(|y| *y <= 1.0 + 1e-9));
    }
}

/// Conformance: A067.
#[test]
fn time_delays() {
    let curves = figure("figure13");
    assert_eq!(curves.len(), 5);
    for (delay, curve) in (1..).zip(&curves) {
        let y = step(curve);
        assert!(y[..delay].iter().all(|y| y.abs() <= 0.0));
        assert!(y[delay..].iter().all(|y| (y - 1.0).abs() <= 0.0));
    }
}

/// Conformance: A119.
#[test]
fn steps_of_several_orders() {
    let curves = figure("figure16");
    assert_eq!(curves.len(), 6);
    let steepest = |curve: &Curve| {
        let y = step(curve);
        let slope = y.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
        slope / 0.001 / (2.0 * std::f64::consts::PI)
    };
    near(steepest(&curves[1]), 0.572, 0.002);
    near(steepest(&curves[5]), 0.501, 0.002);
}

/// At most 5 % within the printed limits of every mode. Conformance: V016.
#[test]
fn sensitivity_of_the_modes() {
    let curves = figure("sensitivity");
    assert_eq!(curves.len(), 4);
    let printed = [(-3.0, 3.0), (-13.0, 19.0), (-20.0, 33.0), (-10.0, 13.0)];
    for (curve, (low, high)) in curves.iter().zip(printed) {
        for percent in [low, 0.0, high] {
            let left = at(curve, "f_set_over_f_real", 1.0 + percent / 100.0, "residual_ratio");
            assert!(left <= 0.0505, "{percent} %: {left}");
        }
        // outside it grows
        assert!(at(curve, "f_set_over_f_real", 1.0 + 1.6 * high / 100.0, "residual_ratio") > 0.05);
    }
}

/// Every command of the list, as it stands there.
#[test]
fn every_command_of_the_list_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let list = std::fs::read_to_string(root.join("interpreter/cli/docs/figures.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let commands: Vec<&str> =
        list.split('`').skip(1).step_by(2).filter(|part| part.starts_with("kontur ")).collect();
    assert!(commands.len() >= 24, "{commands:?}");
    for command in commands {
        let mut output = None;
        let words: Vec<OsString> = command
            .split_whitespace()
            .map(|word| {
                let file = Path::new(word);
                if word.starts_with("programs/") {
                    root.join(file).into()
                } else if file.extension().is_some_and(|e| e == "svg" || e == "html") {
                    output = Some(folder.path().join(file));
                    folder.path().join(file).into()
                } else {
                    word.into()
                }
            })
            .collect();
        let mut console = Console::new(Vec::new(), Vec::new());
        assert_eq!(run_with(words, &mut Kontur, &mut console), Exit::Finished, "{command}");
        if let Some(file) = output {
            assert!(std::fs::metadata(file).unwrap().len() > 1000, "{command}");
        }
    }
}
