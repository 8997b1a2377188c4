//! The tables of `interpreter/tests/language`: programs, one per line, with their expected results. Their README describes the
//! format.

use super::{Event, Options, Run, Step, Sync, machine, places, run_with, shown};
use crate::diag::Diagnostic;
use crate::exec::SpindleMotion;
use crate::exec::step::ShapingSettings;
use crate::machine::Machine;
use crate::source::MemorySources;
use kontur_kit::pieces;
use kontur_kit::rows::{Row, fits, is, lines, rows, wrong};
use kontur_motion::block::{Block, ContourMode, Feed};
use kontur_motion::path::Path;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Words that begin a list in a row.
const LISTS: &str = "path length arc feed end ratio late slope acc vector contour spline angle tolerance guard steps does";

/// Results of a run, by the word that introduces them in a row; messages have no such word.
fn found(word: &str, run: &Run) -> Vec<String> {
    let blocks = run.blocks().into_iter();
    let list = |x: &[f64]| x.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    match word {
        "path" => run.ends().iter().map(|end| list(end)).collect(),
        "length" => blocks.map(|block| block.path.length().to_string()).collect(),
        "arc" => blocks.map(|block| arc(&block.path)).collect(),
        "feed" => blocks.map(|block| feed(&block.feed)).collect(),
        "end" => blocks.map(|block| value(block.end_velocity_mm_s)).collect(),
        "ratio" => blocks.map(|block| block.feed_ratio.to_string()).collect(),
        "late" => blocks.map(|block| block.late_braking.to_string()).collect(),
        "slope" => {
            let slope = |block: &Block| format!("{:?},{}", block.slope.kind, block.slope.optimised);
            blocks.map(slope).collect()
        }
        "acc" => {
            let feed = |block: &Block| block.dynamics.axes[0].feed;
            blocks.map(|b| list(&[feed(b).acc_mm_s2, feed(b).dec_mm_s2])).collect()
        }
        "vector" => {
            let limits = |block: &Block| block.dynamics.vector;
            blocks.map(|b| value(limits(b).vel_mm_s) + "," + &value(limits(b).acc_mm_s2)).collect()
        }
        "contour" => blocks.map(|block| contour(block.contour.map(|c| c.mode))).collect(),
        "angle" => blocks.map(|block| value(block.spline.map(|s| s.max_angle_deg))).collect(),
        "spline" => blocks.map(|block| value(block.spline.map(|s| s.path_dev_mm))).collect(),
        "tolerance" => blocks.map(|block| value(block.tolerance.ax_dev_mm)).collect(),
        "guard" => run.steps.iter().filter_map(guard).collect(),
        "steps" => run.steps.iter().filter_map(step).collect(),
        "does" => run.events().into_iter().filter_map(done).collect(),
        _ => places(&run.diagnostics).iter().map(|place| place.replace(' ', "@")).collect(),
    }
}

/// Centre and swept angle in deg.
fn arc(path: &Path) -> String {
    match path {
        Path::Arc(arc) => {
            let [x, y] = arc.shape().centre_mm;
            format!("{x},{y},{}", arc.shape().sweep_rad.to_degrees())
        }
        _ if path.is_straight() => "line".to_owned(),
        _ => "curve".to_owned(),
    }
}

/// mm/s, s or a ratio.
fn feed(feed: &Feed) -> String {
    match *feed {
        Feed::Rapid => "rapid".to_owned(),
        Feed::PathVelocity(v) => v.to_string(),
        Feed::Duration(t) => format!("{t}s"),
        Feed::ShareOfMaximum(share) => format!("{share}max"),
    }
}

/// A number, if there is one.
fn value(value: Option<f64>) -> String {
    value.map_or("-".to_owned(), |value| value.to_string())
}

/// Deviation, or distances before and after the corner, in mm.
fn contour(mode: Option<ContourMode>) -> String {
    match mode {
        None => "-".to_owned(),
        Some(ContourMode::Dev { path_dev_mm }) => format!("dev,{path_dev_mm}"),
        Some(ContourMode::Dist { pre_mm, post_mm }) => format!("dist,{pre_mm},{post_mm}"),
        Some(other) => format!("{other:?}"),
    }
}

/// What a command makes of the filters of X: mode, frequency and damping of its guard, the length of another kernel, or no kernel.
fn guard(step: &Step) -> Option<String> {
    let Step::Sync { what: Sync::Shaping(setup), .. } = step else { return None };
    Some(match (&setup.axes[0].kernel, setup.axes[0].settings) {
        (None, _) => "-".to_owned(),
        (_, ShapingSettings::VibGuard(of)) => format!("{},{},{}", of.mode, of.freq_hz, of.damping),
        (Some(kernel), _) => kernel.length().to_string(),
    })
}

/// A motion, or the reason for a stop of the path: s, or the axis with a changed list.
fn step(step: &Step) -> Option<String> {
    match step {
        Step::Motion { .. } => Some("move".to_owned()),
        Step::Sync { what: Sync::Dwell { seconds }, .. } => Some(format!("{seconds}s")),
        Step::Sync { what: Sync::ExactStop { alone: true }, .. } => Some("StopOfAll".to_owned()),
        Step::Sync { what: Sync::MachineData { axis, .. }, .. } => {
            Some(format!("MachineData,{axis}"))
        }
        Step::Sync { what, .. } => format!("{what:?}").split([' ', '(']).next().map(str::to_owned),
        Step::End { .. } => None,
    }
}

/// Functions, and speeds of spindles in 1/min.
fn done(event: &Event) -> Option<String> {
    match event {
        Event::MFunction { number, .. } => Some(format!("M{number}")),
        Event::HFunction { number, .. } => Some(format!("H{number}")),
        Event::Spindle { motion: SpindleMotion::Clockwise { rpm }, .. } => Some(format!("S{rpm}")),
        Event::Spindle { motion: SpindleMotion::CounterClockwise { rpm }, .. } => {
            Some(format!("S-{rpm}"))
        }
        Event::Feedforward { on, weight_ratios } => {
            let weights: Vec<String> = weight_ratios.iter().map(f64::to_string).collect();
            Some(format!("feedforward,{on},{}", weights.join(",")))
        }
        Event::SpindleFeedforward { on, weight_ratio, .. } => {
            Some(format!("feedforward,{on},{weight_ratio}"))
        }
        Event::Spindle { motion: SpindleMotion::Stop, .. } => Some("S0".to_owned()),
        _ => None,
    }
}

/// Everything that a program does, but for the places in its text.
fn whole(run: &Run) -> Vec<String> {
    let step = |step: &Step| match step {
        Step::Motion { block, events, .. } => format!("{block:?} {events:?}"),
        Step::Sync { what, events, .. } => format!("{what:?} {events:?}"),
        Step::End { reason, events, .. } => format!("{reason:?} {events:?}"),
    };
    run.steps.iter().map(step).collect()
}

/// Compares a run with the right side of its row; returns the actual results if they differ.
fn compare(run: &Run, expected: &str) -> Result<(), String> {
    let (words, texts) = expected.split_at(expected.find('"').unwrap_or(expected.len()));
    let (words, is_about) =
        words.trim_end().strip_suffix("about").map_or((words, false), |w| (w, true));
    let mut lists = vec![("says", Vec::new())];
    let mut wrong = Vec::new();
    for word in words.split_whitespace() {
        let axis = ["X", "Y", "Z"].iter().position(|axis| word.starts_with(axis));
        match (word, axis) {
            ("ok", _) => {}
            _ if LISTS.split(' ').any(|list| list == word) => lists.push((word, Vec::new())),
            (_, Some(axis)) if is(&word[1..], &run.end[axis].to_string()) => {}
            (_, Some(_)) => wrong.push(format!("ends at {:?}", run.end)),
            _ => lists.last_mut().unwrap().1.push(word),
        }
    }
    for (word, wanted) in lists {
        let found = found(word, run);
        if !fits(&wanted, &found) {
            wrong.push(format!("{word} {}", found.join(" ")));
        }
    }
    let texts: Vec<&str> = texts.trim_matches('"').split("\" \"").collect();
    let of = |d: &Diagnostic| {
        let block = d.source.as_ref().and_then(|at| at.block).unwrap_or_default();
        format!("{} {:?} {:?} N{block}", d.text, d.hint, d.parameter)
    };
    let said: Vec<String> = run.diagnostics.iter().map(of).collect();
    if is_about && !texts.iter().all(|text| said.iter().any(|d| d.contains(text))) {
        wrong.push(format!("does not say {texts:?}"));
    }
    if !is_about && texts != [""] && texts != run.messages() {
        wrong.push(format!("writes {:?}", run.messages()));
    }
    if wrong.is_empty() {
        return Ok(());
    }
    wrong.extend(shown(&run.diagnostics));
    Err(wrong.join("; "))
}

/// Machines by their settings.
type Machines = BTreeMap<String, Arc<Machine>>;

/// What a row states and the program does not do.
fn faults(row: &Row, machines: &mut Machines) -> Vec<String> {
    let settings: Vec<&str> = row.settings.iter().map(String::as_str).collect();
    let machine = machines.entry(settings.join(" ")).or_insert_with(|| machine(&settings));
    let run = |program: &str| {
        let main = MemorySources::new().with("main.nc", program);
        let files = row.files.iter().fold(main, |s, (name, text)| s.with(name, text.as_str()));
        run_with(files, Arc::clone(machine), Options::default())
    };
    let found = run(&row.program);
    let (expected, other) = row.expected.split_once(" as: ").unwrap_or((row.expected.as_str(), ""));
    let mut wrong: Vec<String> = compare(&found, expected).err().into_iter().collect();
    if !other.is_empty() {
        let (found, other) = (whole(&found), whole(&run(&(lines(other) + "M30\n"))));
        let differ = found.iter().zip(&other).find(|(found, other)| found != other);
        if differ.is_some() || found.len() != other.len() {
            wrong.push(format!("not so: {differ:?}"));
        }
    }
    wrong
}

#[test]
fn programs_do_what_their_rows_say() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/language");
    let mut machines = Machines::new();
    let wrong = wrong(folder, |row| faults(row, &mut machines)).unwrap();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A wrong row is detected, whatever kind of result is wrong.
#[test]
fn wrong_rows_are_found() {
    let row = |row: &str| faults(&rows(row)[0], &mut Machines::new()).is_empty();
    assert!(row("X1 F100 | Y2 -> X1 Y2 Z0 path (1,0,0) (1,2)"));
    assert!(row("#MSG [\"a b\"] | #MSG [\"c\"] -> \"a b\" \"c\""));
    assert!(row("X1 F100 | Y=P5 -> 20925@2:3 X1"));
    assert!(row("X1 F600 | G00 X2 | X3 -> path .. (2,0,0) _ feed 10 rapid rapid"));
    assert!(row("G137 G93 F2 X1 | G194 F50 X2 -> ok feed 2s 0.5max"));
    assert!(row("G02 X10 I5 F100 | G01 X13 Y4 -> arc (5,0,-180) line length _ 5"));
    assert!(row(
        "X1 F100 | G04 1 | G60 X2 | M10 H5 | M3 S50 -> steps move 1s move ExactStop does M10 H5 S50"
    ));
    assert!(row("X1 F100 | X2 -> ok as: F100 X1 | G91 X1"));
    assert!(row("G01 X1 -> 20008 about \"no F word\""));
    for wrong in pieces(
        "X1 F100 | X2 -> ok as: F100 X1 | X3 ¦ X1 F100 -> ok as: X1 F100 | X2 ¦ X1 F100 -> X1.00000001 ¦ X1 F100 -> K-0009
G01 X1 -> 20008 about \"no F word\" \"never said\" ¦ X1 F100 | Y=P5 -> X1 ¦ X1 F100 | Y=P5 -> 20925@2:4
X1 F100 | Y=P5 -> 20925 ..  20925 ¦ X1 F100 | Y2 -> path (1,0,0) ¦ X1 F100 | Y2 -> path (1,1,0) (1,2) ¦ X1 F100 | Y2 -> path _
X1 F100 | Y2 -> path (2) .. ¦ X1 F600 -> feed rapid ¦ X1 F600 -> feed 10s ¦ G137 G93 F2 X1 -> feed 2
X10 F100 | Y10 -> length 10 11 ¦ G02 X10 I5 F100 -> arc (5,0,180) ¦ G02 X10 I5 F100 -> arc line
X1 F100 | G04 1 -> steps move 2s ¦ X1 F100 | M5 -> does M3 ¦ #MSG [\"a b\"] -> \"a\" ¦ #MSG [\"a\"] | #MSG [\"b\"] -> \"a\"",
    ) {
        assert!(!row(wrong), "{wrong}");
    }
}
