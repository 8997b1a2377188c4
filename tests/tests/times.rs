//! `run --times`: every cycle belongs to one line and has one reason.

use kontur::Exit;
use kontur_kit::{Random, count, seed};
use kontur_tests::command::{Folder, set};
use kontur_tests::{machine, run_with_inputs};
use serde_json::Value;
use std::collections::BTreeMap;

/// A run with `--times`: the summary, and the table of all lines by line and column.
struct Run {
    summary: Value,
    lines: BTreeMap<u32, BTreeMap<String, String>>,
}

impl Run {
    /// With settings.
    fn new(program: &str, settings: &str) -> Self {
        let folder = Folder::new(&[("part.nc", program)]);
        let times = folder.path("times.csv");
        let summary = folder.summary(&[vec![format!("--times={times}")], set(settings)].concat());
        let mut table = csv::Reader::from_path(times).unwrap();
        let rows = table.deserialize().map(|row| row.unwrap());
        let lines = rows.map(|row: BTreeMap<String, String>| (row["line"].parse().unwrap(), row));
        Self { summary, lines: lines.collect() }
    }

    fn seconds(&self, line: u32, column: &str) -> f64 {
        self.lines.get(&line).map_or(0.0, |row| row[&format!("{column}_s")].parse().unwrap())
    }

    fn duration(&self) -> f64 {
        self.summary["duration_s"].as_f64().unwrap()
    }

    /// Seconds of a reason, over all axes and limits.
    fn reason(&self, name: &str) -> f64 {
        let reasons = self.summary["times"]["reasons"].as_array().unwrap().iter();
        let of = reasons.filter(|r| r["reason"] == name);
        of.map(|r| r["seconds"].as_f64().unwrap()).sum()
    }

    fn axis_of(&self, name: &str) -> Vec<&str> {
        let reasons = self.summary["times"]["reasons"].as_array().unwrap().iter();
        reasons.filter(|r| r["reason"] == name).map(|r| r["axis"].as_str().unwrap()).collect()
    }
}

/// The acceleration of a trapezoidal profile with separate ramps is known in closed form. 100 mm at F6000 with 1000 mm/s2 and ramp times
/// of 50 ms: 50 ms build-up, 50 ms constant, 50 ms reduction; two such ramps cover 15 mm, the feed covers the other 85 mm in 0.85 s.
#[test]
fn a_straight_line_in_closed_form() {
    let slope = "X.getriebe[0].slope_profil: a_beschl=1000, a_brems=1000, tr_beschl_zu=50000, tr_beschl_ab=50000, \
                 tr_brems_zu=50000, tr_brems_ab=50000; Kontur.cycle_time_us=1000";
    let run = Run::new("#SLOPE [TYPE=TRAPEZ]\nG01 X100 F6000\nG04 0.25\nM30\n", slope);
    let near = |is: f64, want: f64| {
        assert!((is - want).abs() < 2.1e-3, "{is}, not {want}: {}", run.summary)
    };
    near(run.seconds(2, "axis_a"), 0.1);
    near(run.seconds(2, "slope"), 0.2);
    near(run.seconds(2, "feed"), 0.85);
    near(run.seconds(3, "dwell"), 0.25);
    assert_eq!(run.lines[&3]["kind"], "none");
    assert_eq!(run.axis_of("axis_a"), ["X"]);
}

/// The axis that is at its limit is named: Y, with a tenth of the speed of X.
#[test]
fn the_axis_at_its_limit_is_named() {
    let run = Run::new("G01 X50 Y50 F60000\nM30\n", "Y.getriebe[0].dynamik.vb_max=10000");
    assert_eq!(run.axis_of("axis_v"), ["Y"], "{}", run.summary);
    // 10 mm/s over 50 mm
    assert!(run.reason("axis_v") > 4.5, "{}", run.summary);
}

/// In tapping the spindle may reach its limit before the axis: with 60000 deg/s2 and 1.5 mm per revolution Z has 250 mm/s2, a fourteenth
/// of its 3500. A spindle that only runs up meanwhile is not part of the path.
#[test]
fn the_spindle_that_limits_a_thread_is_named() {
    let run = Run::new("G331 Z-20 K1.5 S6000\nG332 Z0\nM30\n", "");
    assert_eq!(run.axis_of("axis_a"), ["S"], "{}", run.summary);
    let proposals = run.summary["times"]["proposals"].as_array().unwrap();
    let of_spindle = proposals.iter().find(|p| p["what"] == "accelerations +10 % of S").unwrap();
    // two moves of 20 mm from rest to rest: 2 sqrt(20 / 250) each, reduced by the root of 1.1
    let want = 4.0 * (20.0_f64 / 250.0).sqrt() * (1.0 - 1.0 / 1.1_f64.sqrt());
    assert!((of_spindle["saves_s"].as_f64().unwrap() - want).abs() < 0.01, "{of_spindle}");
    let milled = Run::new("#SLOPE [TYPE=STEP]\nS6000 M3\nG01 X100 F6000\nM30\n", "");
    let reasons = milled.summary["times"]["reasons"].as_array().unwrap();
    assert!(reasons.iter().any(|r| r["axis"] == "X"), "{}", milled.summary);
    assert!(reasons.iter().all(|r| r["axis"] != "S"), "{}", milled.summary);
}

/// Moves of 0.1 mm from rest to rest never reach their acceleration, but its ramps become steeper with it: each of them takes
/// 4 (s / 2 j)^(1/3), so it gains with the third root of the jerk.
#[test]
fn accelerations_are_proposed_where_ramps_take_the_time() {
    let moves = 40;
    let back_and_forth = "G01 X0.1 F6000\nX0\n".repeat(moves / 2);
    let run = Run::new(&format!("#SLOPE [TYPE=TRAPEZ]\n{back_and_forth}M30\n"), "");
    let proposals = run.summary["times"]["proposals"].as_array().unwrap();
    for (what, root) in
        [("accelerations +10 % of all axes", 1.1), ("ramp times -10 % of all axes", 1.0 / 0.9)]
    {
        let found = proposals.iter().find(|p| p["what"] == what).expect(what);
        let want = run.duration() * (1.0 - 1.0 / libm::cbrt(root));
        let saves_s = found["saves_s"].as_f64().unwrap();
        assert!((saves_s - want).abs() < 0.004, "{what}: {saves_s}, not {want}");
    }
}

/// Whatever the path waits for is named; the total is the sum of the lines, and each line is the sum of its reasons.
#[test]
fn random_programs_add_up() {
    let mut random = Random::new(11);
    for case in 0..25 {
        let mut program =
            String::from(["", "#SLOPE [TYPE=HSC]\n", "#SLOPE [TYPE=SIN2]\n"][case % 3]);
        let mut dwells = 0.0;
        for _ in 0..2 + random.below(10) {
            let (x, y) = (random.between(-30.0, 30.0), random.between(-30.0, 30.0));
            program += &match random.below(6) {
                0 => format!("G00 X{x:.3} Y{y:.3}\n"),
                1 => {
                    dwells += 0.12;
                    "G04 0.12\n".to_owned()
                }
                2 => format!("G60 G01 X{x:.3} F{:.0}\n", random.between(500.0, 9000.0)),
                _ => format!("G01 X{x:.3} Y{y:.3} F{:.0}\n", random.between(500.0, 20000.0)),
            };
        }
        program += "M30\n";
        let run = Run::new(&program, "");
        let lines: f64 = run.lines.keys().map(|l| run.seconds(*l, "total")).sum();
        assert!((lines - run.duration()).abs() < 1e-9, "{program}");
        for (line, row) in &run.lines {
            let reasons = row.iter().filter(|(c, _)| c.ends_with("_s") && *c != "total_s");
            let sum: f64 = reasons.map(|(_, s)| s.parse::<f64>().unwrap()).sum();
            assert!((sum - run.seconds(*line, "total")).abs() < 1e-9, "{line}: {program}");
        }
        assert!((run.reason("dwell") - dwells).abs() < 1e-9, "{program}");
        let arrival = run.summary["arrival_s"].as_f64().unwrap();
        assert!((run.reason("arrival") - arrival).abs() < 1e-9, "{program}");
    }
}

/// The readable form quotes the lines; those of subroutines from their own file.
#[test]
fn the_most_expensive_lines_are_quoted() {
    let folder = Folder::new(&[
        ("part.nc", "L slow.nc\nG01 X0 F6000\nM30\n"),
        ("slow.nc", "(slow)\nG01 X20 F60 (this one)\nM17\n"),
    ]);
    let done = folder.call(&["run", "@part.nc", "--times"]);
    assert_eq!(done.exit, Exit::Finished, "{}", done.err);
    let behind = done.out.split("lines that take the most time\n").nth(1).unwrap();
    let mut lines = behind.lines();
    assert!(lines.next().unwrap().contains(&format!("{}:2 ", folder.path("slow.nc"))), "{behind}");
    assert_eq!(lines.next().unwrap().trim(), "G01 X20 F60 (this one)");
}

/// A proposal saves what a run with its settings saves; for a line at the speed limit of an axis this is known in closed form.
#[test]
fn proposals_save_what_they_say() {
    // 10 mm/s over 50 mm, and with 10 % more
    let limit = "Y.getriebe[0].dynamik.vb_max=10000";
    let program = "#SLOPE [TYPE=TRAPEZ]\nG01 Y50 F60000\nX20\nX0 Y45\nM30\n";
    let run = Run::new(program, limit);
    let proposals = run.summary["times"]["proposals"].as_array().unwrap();
    assert!(proposals.len() > 1, "{proposals:?}");
    for proposal in proposals {
        let settings = proposal["settings"].as_array().unwrap();
        let settings: Vec<&str> = settings.iter().map(|s| s.as_str().unwrap()).collect();
        let with = Run::new(program, &format!("{limit}; {}", settings.join("; ")));
        let saves = proposal["saves_s"].as_f64().unwrap();
        assert!((run.duration() - with.duration() - saves).abs() < 1e-9, "{proposal}");
    }
    let faster = proposals.iter().find(|p| p["what"] == "velocity +10 % of Y").unwrap();
    let want = 55.0 / 10.0 - 55.0 / 11.0;
    assert!((faster["saves_s"].as_f64().unwrap() - want).abs() < 0.01, "{faster}, not {want}");
    let line = &run.summary["times"]["most_expensive_lines"][0];
    assert!(line["line"] == 2 && line["helps"]["what"] == "velocity +10 % of Y", "{line}");
}

/// Time measurement (207464587): START and STOP count, READ copies the count to V.G.TIMER, CLEAR does not change that. With SYN the times
/// are those of the motion.
#[test]
fn timers_measure_program_time() {
    let text = "%P\n#TIMER START SYN [ID=2]\nG04 1.5\n#TIMER STOP SYN [ID=2]\nG04 4\n#TIMER START SYN [ID=2]\nG04 0.25\n\
        #TIMER READ SYN [ID=2]\n#MSG [\"%f\", V.G.TIMER[2]]\n#TIMER CLEAR SYN [ID=2]\nG04 1\n#MSG [\"%f\", V.G.TIMER[2]]\n\
        #TIMER READ SYN [ID=2]\n#MSG [\"%f\", V.G.TIMER[2]]\nM30\n";
    let run = kontur_tests::run(text, &[]);
    let said: Vec<f64> = run.diagnostics.iter().map(|d| d.text.parse().unwrap()).collect();
    let want = [1750.0, 1750.0, 0.0];
    assert_eq!(said.len(), 3);
    for (ms, want) in said.iter().zip(want) {
        assert!((ms - want).abs() <= 4.0 * run.cycle_s * 1e3, "{said:?}");
    }
}

/// A program runs from top to bottom, and so does the column `line`, whatever waits for what: the waits of a motion belong to it, and
/// those after another block no longer do.
#[test]
fn lines_never_go_back() {
    for n in 0..count(40) as u64 {
        let mut random = Random::new(seed() * 1000 + n);
        let mut text = "%P\nG90 G01 F6000\n".to_owned();
        for _ in 0..12 {
            let to = random.between(0.0, 40.0);
            text += &match random.below(10) {
                0..2 => format!("G01 X{to:.2}\n"),
                // AX_DEV keeps the path at rest for longer than the program asks for
                2 => format!(
                    "#VIB GUARD ON [MODE=2 FREQ=20 AX_DEV=0.01]\nX{to:.2}\nG04 0.01\nZ{to:.2}\nG04 0.001\nX0\n"
                ),
                3 => format!("G04 {:.3}\n", random.between(0.0, 0.2)),
                4 => format!("X[INDP_SYN G90 G01 FEED=3000 POS={to:.2}]\n"),
                5 => format!("Y[INDP_ASYN G90 G01 FEED=3000 POS={to:.2}]\n#WAIT INDP [Y]\n"),
                6 => format!("#VIB GUARD ON [MODE=1 FREQ={:.1}]\n", random.between(3.0, 20.0)),
                7 => "#VIB GUARD OFF\n".to_owned(),
                8 => "#FLUSH WAIT\n".to_owned(),
                _ => format!("G60 X{to:.2}\n"),
            };
        }
        text += "M30\n";
        let mut inputs = Vec::new();
        let mut t = 0.0;
        for _ in 0..6 {
            t += random.between(0.05, 0.6);
            inputs.push((t, "feedhold", 1.0));
            t += random.between(0.05, 0.3);
            inputs.push((t, "feedhold", 0.0));
        }
        let inputs = if random.chance(0.5) { inputs } else { Vec::new() };
        let run = run_with_inputs(machine(&[]), &text, &inputs);
        assert!(!run.totals.aborted, "{text}{:?}", run.diagnostics);
        let lines: Vec<u32> = run.records.iter().skip(1).map(|r| r.line).collect();
        assert!(lines.is_sorted(), "{n}\n{text}");
    }
}
