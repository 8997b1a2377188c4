//! The tables of `tests/suite/timing`: short programs under real-time inputs, and the positions of their axes at given times. The form is
//! that of `interpreter/tests/language`, with the heads `inputs TIME SIGNAL VALUE, ..` and `always with SETTING` for everything that
//! follows. After the messages a row says
//!
//! ```text
//! at 0.5 X45 Y0        where the axes are interpolated to at this time in s
//! end X100             the same for the last cycle
//! arrives X100 1.6     the first time at which an axis has come to a position
//! steps X0.1           what an axis goes at most in a cycle
//! held 0.4             how long the path is held
//! by Stop              what limits the path at that time
//! within 0.6           the run does not last longer
//! aborted              the run ends with an error
//! ```

use kontur_interpreter::record::Rest;
use kontur_kit::rows::{Row, fits, rows};
use kontur_tests::suite::{files, folder, name};
use kontur_tests::{Run, machine, run_with_inputs};
use std::fmt::Write as _;

/// mm, deg or s.
const NEAR: f64 = 1e-9;

fn axis(word: &str) -> (usize, f64) {
    let axis = ["X", "Y", "Z"].iter().position(|name| word.starts_with(name)).expect(word);
    (axis, word[1..].parse().expect(word))
}

/// First time at which an axis has been away from a position and is there.
fn arrival_s(run: &Run, axis: usize, target: f64) -> f64 {
    let at = |k: usize| (run.records[k].axes[axis].ipo - target).abs() < NEAR;
    (1..run.records.len())
        .find(|k| at(*k) && !at(k - 1))
        .map_or(f64::INFINITY, |k| k as f64 * run.cycle_s)
}

/// What a row states and the run does not fulfil.
fn faults(row: &Row) -> Vec<String> {
    let settings: Vec<&str> = row.settings.iter().map(String::as_str).collect();
    let inputs: Vec<_> = row.inputs.iter().map(|(t, name, x)| (*t, name.as_str(), *x)).collect();
    let run = run_with_inputs(machine(&settings), &format!("%P\n{}", row.program), &inputs);
    let (mut wrong, mut ids, mut aborted) = (Vec::new(), Vec::new(), false);
    let mut found = Vec::new();
    let mut at = run.records.len() - 1;
    let mut words = row.expected.split_whitespace();
    while let Some(word) = words.next() {
        let mut number = || -> f64 { words.next().and_then(|w| w.parse().ok()).expect(&row.text) };
        match word {
            "ok" => {}
            "at" => at = (number() / run.cycle_s).round() as usize,
            "end" => at = run.records.len() - 1,
            "held" => found.push((word, run.rested(Rest::Held) as f64 * run.cycle_s, number())),
            "within" => {
                let limit_s = number();
                found.push((word, (run.records.len() as f64 * run.cycle_s).max(limit_s), limit_s));
            }
            "by" => {
                let limit = format!("{:?}", run.records[at].path.limit);
                if words.next() != Some(&limit) {
                    wrong.push(format!("limited by {limit}"));
                }
            }
            "aborted" => aborted = true,
            "steps" => {
                let (i, limit) = axis(words.next().expect(&row.text));
                let steps =
                    run.records.windows(2).map(|w| (w[1].axes[i].ipo - w[0].axes[i].ipo).abs());
                found.push((word, steps.fold(limit, f64::max), limit));
            }
            "arrives" => {
                let target = words.next().expect(&row.text);
                let (i, position) = axis(target);
                let time_s = words.next().and_then(|w| w.parse().ok()).expect(&row.text);
                found.push((target, arrival_s(&run, i, position), time_s));
            }
            _ if word.starts_with(['X', 'Y', 'Z']) => {
                let (i, want) = axis(word);
                found.push((word, run.records[at].axes[i].ipo, want));
            }
            id => ids.push(id),
        }
    }
    let differs = |(_, is, want): &(&str, f64, f64)| (is - want).abs() > NEAR;
    wrong.extend(found.into_iter().filter(differs).map(|(what, is, _)| format!("{what}: {is}")));
    if !fits(&ids, &run.said()) || aborted != run.totals.aborted {
        wrong.push(format!("says {:?}, aborted {}", run.said(), run.totals.aborted));
    }
    wrong
}

#[test]
fn axes_are_where_the_rows_say() {
    let mut wrong = String::new();
    for file in files(&folder("timing"), "txt") {
        let rows = rows(&std::fs::read_to_string(&file).unwrap());
        assert!(rows.len() > 5, "{}", name(&file));
        for row in rows {
            let faults = faults(&row);
            if !faults.is_empty() {
                let _ = writeln!(wrong, "{}: {}\n    {}", name(&file), row.text, faults.join("; "));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// A wrong row is found, whatever is wrong in it. 10 mm at 100 mm/s with 1000 mm/s2 take 0.2 s.
#[test]
fn wrong_rows_are_found() {
    let of = |expected: &str| {
        let table = format!(
            "with X.getriebe[0].lslope_profil.a_stufe_1=1000\nwith X.getriebe[0].lslope_profil.a_stufe_2=1000\n\
             #SLOPE [TYPE=STEP] | G01 X10 F6000 -> {expected}"
        );
        faults(&rows(&table)[0]).is_empty()
    };
    assert!(of("ok at 0.1 X5 Y0 arrives X10 0.2 end X10 held 0"));
    for wrong in [
        "at 0.1 X5.1",
        "arrives X10 0.201",
        "arrives X11 0.2",
        "end X9",
        "held 0.1",
        "K-0009",
        "ok aborted",
    ] {
        assert!(!of(wrong), "{wrong}");
    }
}
