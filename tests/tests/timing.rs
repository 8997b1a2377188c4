//! The tables of `tests/suite/timing`: short programs under real-time inputs, and what their axes do at given times. The form is
//! that of `interpreter/tests/language`, with three more heads: `inputs TIME SIGNAL VALUE, ..`, `machine NAME` for one of
//! `programs/machines` or `tests/suite/machines`, and `always with SETTING` for everything that follows. After the messages a row says
//!
//! ```text
//! at 0.5 X45 Y0        where the axes are interpolated to at this time in s
//! line 3 X45           the same in the last cycle of this line of the row
//! middle 3 X45         the same in the middle of this line
//! first 3 X45          the same in its first cycle
//! rest 3 X45           the same in the last cycle of this line in which the path rests before its end
//! end X100             the same in the last cycle
//! X8..8.2              between these positions
//! S2=45                an axis or spindle whose name may end with a digit
//! most 3 X45           the same in that cycle of this line in which it is largest, whatever its sign; 0 is the whole run
//! all 3 X40..45        the same in every cycle of this line
//! add X0.5             another quantity of the axes: set, act, load, lag, add, reference, err, dev, vel, acc, jerk, ff, cmd, vadd; rpm, the
//!                      speed of a spindle in rev/min; late, the cycles by which `set` follows `ipo` at constant speed; percent, the
//!                      lag in per cent of that without feedforward, speed / Kv with Kv 50/s; pitch, the way during a revolution of the spindle of the
//!                      built-in machine; turn, the set angle within a revolution; `ipo` leads back
//! arrives X100 1.6     the first time at which an axis has come to a position
//! steps X0.1           what an axis goes at most in a cycle
//! held 0.4             how long the path is held
//! by Stop              what limits the path at that time
//! within 0.6           the run does not last longer
//! aborted              the run ends with an error
//! 70082@3@X            a message, its line in the row, its axis
//! as X Y: PROGRAM      these axes move exactly as in another program, without the surroundings of the paragraph, and rest where only
//!                      one of them still runs; without axes all do, as long as it; the last words of a row
//! "text"               all texts of `#MSG`
//! ```

use kontur_interpreter::diag::{Condition, Diagnostic};
use kontur_interpreter::record::{CycleRecord, Rest};
use kontur_kit::pieces;
use kontur_kit::rows::{Row, fits, lines, rows, wrong};
use kontur_tests::suite::folder;
use kontur_tests::{Run, machine, programs, run_with_inputs, sample_machine, suite_machine};
use std::ops::RangeInclusive;

/// mm, deg or s.
const NEAR: f64 = 1e-9;

/// Axis and position, or the ends of a range of positions, from `X45`, `X8..8.2` or `S2=45`.
fn axis(word: &str, axes: &[String]) -> Option<(usize, RangeInclusive<f64>)> {
    let first = word.chars().next()?.len_utf8();
    let (name, value) = word.split_once('=').unwrap_or_else(|| word.split_at(first));
    let (low, high) = value.split_once("..").unwrap_or((value, value));
    let range = low.parse().ok()?..=high.parse().ok()?;
    Some((axes.iter().position(|axis| axis == name)?, range))
}

/// A quantity of an axis in a cycle.
fn quantity(run: &Run, name: &str, k: usize, axis: usize) -> f64 {
    let of = |k: usize| &run.records[k].axes[axis];
    match name {
        "ipo" => of(k).ipo,
        "set" => of(k).set,
        "act" => of(k).act,
        "load" => of(k).load,
        "lag" => of(k).lag,
        "add" => of(k).add,
        "reference" => of(k).reference,
        "err" => of(k).err,
        "dev" => of(k).dev,
        "vel" => of(k).vel,
        "acc" => of(k).acc,
        "jerk" => of(k).jerk,
        "ff" => of(k).ff,
        "cmd" => of(k).cmd,
        "vadd" => of(k).vadd,
        "turn" => of(k).set.rem_euclid(360.0),
        _ if k == 0 => 0.0,
        "late" => (of(k).ipo - of(k).set) / (of(k).ipo - of(k - 1).ipo),
        "percent" => {
            let way = of(k).reference - of(k - 1).reference;
            // a spindle begins again after each revolution
            let way = if way.abs() > 180.0 { way - 360.0 * way.signum() } else { way };
            100.0 * of(k).lag * 50.0 * run.cycle_s / way
        }
        "pitch" => {
            let spindle = run.records[k].axes[3].set - run.records[k - 1].axes[3].set;
            (of(k).set - of(k - 1).set) / spindle * 360.0
        }
        _ => (of(k).set - of(k - 1).set) / run.cycle_s / 6.0,
    }
}

/// How far a quantity may be from its number.
fn tolerance(quantity: &str) -> f64 {
    match quantity {
        "rpm" | "late" | "pitch" => 1e-6,
        "percent" => 0.01,
        _ => NEAR,
    }
}

/// First time at which an axis has been away from a position and is there.
fn arrival_s(run: &Run, axis: usize, target: f64) -> f64 {
    let at = |k: usize| (run.records[k].axes[axis].ipo - target).abs() < NEAR;
    (1..run.records.len())
        .find(|k| at(*k) && !at(k - 1))
        .map_or(f64::INFINITY, |k| k as f64 * run.cycle_s)
}

/// Where a run differs from that of another program: `X Y: PROGRAM`, or `: PROGRAM` for all that its cycles show.
fn other_motion(
    run: &Run,
    other: &str,
    axes: &[String],
    drive: impl FnOnce(&str) -> Run,
) -> Option<String> {
    let (names, program) = other.split_once(':')?;
    let other = drive(&format!("%P\n{}M30\n", lines(program.trim())));
    let named: Vec<usize> =
        (0..axes.len()).filter(|i| names.split(' ').any(|name| name == axes[*i])).collect();
    let moved = |r: &CycleRecord| -> String {
        let positions = |i: &usize| format!("{} {} ", r.axes[*i].ipo, r.axes[*i].set);
        match &named[..] {
            [] => format!("{:?} {:?} {}", r.path, r.axes, r.contour_err_mm),
            _ => named.iter().map(positions).collect(),
        }
    };
    if named.is_empty() && run.records.len() != other.records.len() {
        return Some(format!("{} cycles, the other {}", run.records.len(), other.records.len()));
    }
    // beyond the end of the shorter run the axes rest
    let held = |run: &Run, k: usize| run.records.get(k).or(run.records.last()).map(moved);
    let cycles = run.records.len().max(other.records.len());
    let k = (0..cycles).find(|k| held(run, *k) != held(&other, *k))?;
    Some(format!("cycle {k}: {:?}, the other {:?}", held(run, k), held(&other, k)))
}

/// What a row states and the run does not fulfil.
fn faults(row: &Row) -> Vec<String> {
    let inputs: Vec<_> = row.inputs.iter().map(|(t, name, x)| (*t, name.as_str(), *x)).collect();
    let built = match row.machine.as_deref() {
        None => machine(&row.settings),
        Some(name) if programs().join("machines").join(name).is_dir() => {
            sample_machine(name, &row.settings)
        }
        Some(name) => suite_machine(name, &row.settings),
    };
    let axes: Vec<String> = built.0.all_axes().map(|axis| axis.name().to_owned()).collect();
    let run = run_with_inputs(built.clone(), &format!("%P\n{}", row.program), &inputs);
    let (mut wrong, mut ids, mut aborted) = (Vec::new(), Vec::new(), false);
    let mut found = Vec::new();
    let (mut at, mut what, mut every) = (vec![run.records.len().saturating_sub(1)], "ipo", false);
    let (words, texts) = row.words_and_texts();
    let (words, other) =
        words.split_once(" as").filter(|(_, o)| o.contains(':')).unwrap_or((words, ""));
    wrong.extend(other_motion(&run, other, &axes, |program| {
        run_with_inputs(built.clone(), program, &inputs)
    }));
    let mut words = words.split_whitespace();
    while let Some(word) = words.next() {
        let mut number = || -> f64 { words.next().and_then(|w| w.parse().ok()).expect(&row.text) };
        match word {
            "ok" => {}
            "at" => (at, every) = (vec![(number() / run.cycle_s).round() as usize], false),
            "line" | "first" | "middle" | "rest" | "most" | "all" => {
                every = word == "all";
                // %P is before the first line of a row
                let line = number() as u32 + 1;
                at = (0..run.records.len())
                    .filter(|k| line == 1 || run.records[*k].line == line)
                    .collect();
                if word == "rest" {
                    let ends = at.last().map(|k| run.records[*k].path.s_mm);
                    at.retain(|k| {
                        let path = &run.records[*k].path;
                        path.v_mm_s <= 0.0 && Some(path.s_mm) != ends
                    });
                }
                let last = at.len().saturating_sub(1);
                match word {
                    _ if at.is_empty() => wrong.push(format!("line {} has no cycle", line - 1)),
                    "line" | "rest" => at = vec![at[last]],
                    "first" => at = vec![at[0]],
                    "middle" => at = vec![at[last / 2]],
                    _ => {}
                }
            }
            "end" => (at, every) = (vec![run.records.len().saturating_sub(1)], false),
            "ipo" | "set" | "act" | "load" | "lag" | "add" | "reference" | "err" | "dev"
            | "vel" | "acc" | "jerk" | "ff" | "cmd" | "vadd" | "late" | "percent" | "pitch"
            | "turn" | "rpm" => what = word,
            "held" => found.push((word, run.rested(Rest::Held) as f64 * run.cycle_s, number())),
            "within" => {
                let limit_s = number();
                found.push((word, (run.records.len() as f64 * run.cycle_s).max(limit_s), limit_s));
            }
            "by" => {
                let limit = format!("{:?}", run.records[at[0]].path.limit);
                if words.next() != Some(&limit) {
                    wrong.push(format!("limited by {limit}"));
                }
            }
            "aborted" => aborted = true,
            "steps" => {
                let (i, limit) = words.next().and_then(|w| axis(w, &axes)).expect(&row.text);
                let steps =
                    run.records.windows(2).map(|w| (w[1].axes[i].ipo - w[0].axes[i].ipo).abs());
                found.push((word, steps.fold(*limit.end(), f64::max), *limit.end()));
            }
            "arrives" => {
                let target = words.next().expect(&row.text);
                let (i, position) = axis(target, &axes).expect(&row.text);
                let time_s = words.next().and_then(|w| w.parse().ok()).expect(&row.text);
                found.push((target, arrival_s(&run, i, *position.end()), time_s));
            }
            _ => match axis(word, &axes) {
                Some((i, want)) if at.iter().all(|k| *k < run.records.len()) => {
                    let values = at.iter().map(|k| quantity(&run, what, *k, i));
                    let larger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
                    let off = |x: &f64| (want.start() - x).max(x - want.end());
                    let is = if every {
                        values.max_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or_default()
                    } else if at.len() > 1 {
                        values.fold(0.0, larger).abs()
                    } else {
                        values.fold(0.0, larger)
                    };
                    let near = tolerance(what);
                    if is < want.start() - near || is > want.end() + near {
                        wrong.push(format!("{what} {word}: {is}"));
                    }
                }
                Some(_) => wrong.push("nothing moves".to_owned()),
                None => ids.push(word),
            },
        }
    }
    let differs = |(_, is, want): &(&str, f64, f64)| (is - want).abs() > NEAR;
    wrong.extend(found.into_iter().filter(differs).map(|(what, is, _)| format!("{what}: {is}")));
    let (said, written): (Vec<_>, Vec<_>) =
        run.diagnostics.iter().partition(|d| d.id != Condition::Message);
    let place = |d: &Diagnostic| {
        let line = d.source.as_ref().map_or(0, |at| at.line.saturating_sub(1));
        format!("{}@{line}@{}", d.id, d.axis.as_ref().map_or("", |axis| &axis.name))
    };
    let said: Vec<String> = said.into_iter().map(place).collect();
    if !fits(&ids, &said) || aborted != run.totals.aborted {
        wrong.push(format!("says {said:?}, aborted {}", run.totals.aborted));
    }
    let written: Vec<&str> = written.into_iter().map(|d| d.text.as_str()).collect();
    let texts: Vec<&str> = texts.trim_matches('"').split("\" \"").collect();
    if texts != [""] && texts != written {
        wrong.push(format!("writes {written:?}"));
    }
    wrong
}

#[test]
fn axes_are_where_the_rows_say() {
    let wrong = wrong(folder("timing"), faults).unwrap();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
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
    assert!(of(
        "all 2 X0..10 Y0 at 0.1 X4.9..5.1 Y=0 set X5 lag X0.1..9 end act X9.98..10.02 rpm S=0 middle 2 ipo X1..9"
    ));
    assert!(of("ok as: #SLOPE [TYPE=STEP] | F6000 G01 X10") && of("ok as Y: G04 1"));
    for wrong in pieces(
        "ok as: #SLOPE [TYPE=STEP] | F5900 G01 X10 ¦ ok as X Y: G04 1 ¦ all 2 X0..9.9 ¦ all 2 X0.1..10 ¦ turn X9
at 0.1 X5.1 ¦ at 0.1 X5.01..5.1 ¦ X=9 ¦ at 0.1 act X5 ¦ line 1 X9 ¦ middle 2 X10 ¦ rpm S=1 ¦ most 0 X9 ¦ vel most 1 X9
percent middle 2 X10 ¦ pitch middle 2 X1 ¦ first 2 X1 ¦ rest 2 X10 ¦ K-0009@3 ¦ \"text\" ¦ arrives X10 0.201 ¦ arrives X11 0.2
end X9 ¦ held 0.1 ¦ K-0009 ¦ ok aborted",
    ) {
        assert!(!of(wrong), "{wrong}");
    }
}
