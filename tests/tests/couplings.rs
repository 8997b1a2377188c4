//! Axis couplings and set positions of axes in runs of programs: how slaves follow their masters.

use kontur_interpreter::record::CycleRecord;
use kontur_kit::{Random, count, seed};
use kontur_tests::{Run, Settings, machine, run_on, sample_machine};

/// Z is not one of the main axes, so that it can follow; it begins at 5.
const SETUP: &str = "#SET AX [X,1,0][Y,2,1][C,3,3]\n";

fn go(settings: impl Settings, program: &str) -> Run {
    let run = run_on(machine(settings), &format!("{SETUP}{program}\nM30\n"));
    assert_eq!(run.diagnostics, [], "{program}");
    run
}

fn set(run: &Run, axis: usize) -> Vec<f64> {
    run.axis(axis, |a| a.set)
}

/// Lines, arcs and helices of any size, by feed and rapid, from X0 Y0.
fn contour(random: &mut Random) -> String {
    let mut text = String::new();
    for _ in 0..8 {
        let mut within = |size: f64| random.between(-size, size);
        let (x, y, i, j) = (within(40.0), within(40.0), within(10.0), within(10.0));
        text += &match random.below(4) {
            0 => format!("G00 X{x:.3} Y{y:.3}\n"),
            // full circles: X returns to where it was
            1 => format!("G02 I{i:.3} J{j:.3} F3000\n"),
            _ => format!("G01 X{x:.3} Y{y:.3} F{:.0}\n", random.log(500.0, 20_000.0)),
        };
    }
    text
}

/// In every cycle the slave has moved as far as its master, or as far in the other direction; the path is the same as without it.
#[test]
fn slaves_follow() {
    for k in 0..count(30) as u64 {
        let mut random = Random::new(seed() + k);
        let ratio = random.pick(&[1.0, -1.0]);
        let factor = if ratio > 0.0 { "C=X" } else { "[C=X, -1, 1]" };
        let contour = contour(&mut random);
        let run =
            go(&[], &format!("#SET AX LINK [1, {factor}]\nG00 C5\n#ENABLE AX LINK [1]\n{contour}"));
        let (x, z) = (set(&run, 0), set(&run, 2));
        let from = z.iter().position(|z| (z - 5.0).abs() < 1e-12).unwrap();
        for (x, z) in x.iter().zip(&z).skip(from) {
            assert!((z - (5.0 + ratio * x)).abs() < 1e-9, "seed {}: X{x} Z{z}", seed() + k);
        }
        // with the logical numbers of the axes it is the same (207120267)
        let numbers = if ratio > 0.0 { "3 = 1" } else { "[3 = 1, -1, 1]" };
        let by_number =
            format!("#AX LINK NBR [1, {numbers}]\nG00 C5\n#ENABLE AX LINK [1]\n{contour}");
        assert_eq!(set(&go(&[], &by_number), 2), z);
        let alone = go(&[], &format!("G00 C5\n{contour}"));
        let end = |run: &Run| [0, 1].map(|axis| *set(run, axis).last().unwrap());
        assert_eq!(end(&run), end(&alone));
    }
}

/// A machine whose X has the limits of Z takes as long as one that couples a slow Z to X.
#[test]
fn the_path_keeps_the_limits_of_slaves() {
    let of = |axis: &str, program: &str| {
        let slow = "slope_profil: a_beschl=700, a_brems=600, a_grenz=500";
        go(&format!("{axis}.getriebe[0].{slow}"), program).records.len()
    };
    let contour = "G01 X50 F20000\nX20 Y10\nG02 I5 J0\nG00 X0 Y0";
    let with = "#SET AX LINK [1, C=X]\n#ENABLE AX LINK [1]\n";
    let coupled = of("Z", &format!("{with}{contour}"));
    assert_eq!(coupled, of("X", &format!("{with}{contour}")));
    assert!(coupled > of("Z", contour) + 100);
}

/// The deviation of a slave is not measured, that of its master is; after it is released, it is an axis of the path again.
#[test]
fn followers_are_not_measured() {
    let guard = "#VIB GUARD ON [MODE=2 FREQ=20]\n";
    let text = "#SET AX LINK [1, C=X]\n#ENABLE AX LINK [1]\nG01 X20 F3000\nY20\nX0\n\
                #DISABLE AX LINK\nG01 C40\nY0";
    let run = go(&[], &format!("{guard}{text}"));
    let [mut coupled, mut free] = [0, 0];
    for record in &run.records {
        let [x, c] = [0, 2].map(|axis| record.axes[axis].dev);
        assert!(x.is_finite());
        match record.line {
            5..=7 => {
                assert!(c.is_nan(), "line {}: {c}", record.line);
                coupled += 1;
            }
            _ => free += usize::from(c.is_finite()),
        }
    }
    assert!(coupled > 500 && free > 500, "{coupled} {free}");
    let dev = run.records.iter().map(|r| r.axes[2].dev.abs()).fold(0.0, f64::max);
    assert!(dev > 0.01, "{dev}");
    let gantry =
        run_on(sample_machine("gantry", &[]), &format!("%P\n{guard}G01 X20 F3000\nY20\nM30\n"));
    for (k, record) in gantry.records.iter().enumerate() {
        let [x, slave] = [0, 3].map(|axis| record.axes[axis].dev);
        assert!(x.is_finite() && slave.is_nan(), "cycle {k}: {x} {slave}");
    }
}

/// `SET_POSITION` moves nothing: speeds and lag are those of the same motions without it, and so is the deviation under a Vibration
/// Guard.
#[test]
fn a_position_that_is_set_moves_nothing() {
    let run = |set: &str, by: f64| {
        let program = format!(
            "#VIB GUARD ON [MODE=2 FREQ=20 AX_DEV=0.05]\nG01 X20 Y5 F8000\n#FLUSH WAIT\nG04 0.5\n{set}\nX{} Y10\nY20\nX{} Y0\n",
            40.0 + by,
            10.0 + by
        );
        go(&[], &program)
    };
    let (with, without) = (run("X[SET_POSITION POS=-300]", -320.0), run("#FLUSH WAIT", 0.0));
    let from = |run: &Run| set(run, 1).iter().position(|y| (y - 5.0).abs() < 1e-12).unwrap();
    let rows = |run: &Run, f: fn(&Run, usize) -> f64| {
        let first = (from(run)..).find(|k| set(run, 1)[*k] > 5.0).unwrap();
        (first..first + 2000).map(|k| f(run, k.min(run.records.len() - 1))).collect::<Vec<_>>()
    };
    let end = |run: &Run| run.records.last().unwrap().axes[0].set;
    let (end_with, end_without) = (end(&with), end(&without));
    let same = |a: Vec<f64>, b: Vec<f64>, shift: f64| {
        for (a, b) in a.into_iter().zip(b) {
            assert!((a - b - shift).abs() < 1e-6, "{a} and {b}");
        }
    };
    let of_set: fn(&Run, usize) -> f64 = |run, k| run.records[k].axes[0].set;
    same(rows(&with, of_set), rows(&without, of_set), end_with - end_without);
    for of in [
        |run: &Run, k: usize| run.records[k].axes[0].lag,
        |run: &Run, k: usize| run.records[k].axes[0].dev,
    ] {
        same(rows(&with, of), rows(&without, of), 0.0);
    }
    let deviation = |run: &Run| run.records.iter().map(|r| r.axes[0].dev.abs()).fold(0.0, f64::max);
    assert!(deviation(&with) > 0.02 && deviation(&with) <= 0.05, "{}", deviation(&with));
}

/// Directly after a motion, while the axis still follows: its lag is unchanged in the cycle in which the position changes, and decays as
/// without the change.
#[test]
fn a_position_that_is_set_leaves_the_lag() {
    let run = |command: &str| go(&[], &format!("G60 G01 X20 F8000\n{command}\nG04 0.1\n"));
    let (with, without) = (run("X[SET_POSITION POS=-300]"), run("G04 0.001"));
    let at = |run: &Run, k: usize| run.records[k].axes[0].lag;
    let changed = set(&with, 0).iter().position(|x| *x < -200.0).unwrap();
    assert!(at(&with, changed - 1) > 1e-3, "it still follows");
    for k in 0..changed + 100 {
        let (a, b) = (at(&with, k), at(&without, k));
        assert!((a - b).abs() < 1e-9, "cycle {k} of {changed}: {a} and {b}");
    }
}

/// `#CHANNEL INIT [ACTPOS]` directly after a motion waits until the axes are in their windows and moves nothing: between two cycles the
/// actual positions do not jump, the set positions jump by at most a window, and incremental motions count from where the axes are.
#[test]
fn actual_positions_are_taken_over_at_rest() {
    let window = machine(&[]).0.axes[0].window_mm();
    for k in 0..count(30) as u64 {
        let mut random = Random::new(seed() + k);
        let mut text = String::from("G91\n");
        let mut ways = [0.0; 2];
        for _ in 0..6 {
            let [x, y] = [(); 2].map(|()| (random.between(-40.0, 40.0) * 1e3_f64).round() / 1e3);
            ways = [ways[0] + x, ways[1] + y];
            let init =
                random.pick(&["", "#CHANNEL INIT [ACTPOS]\n", "#CHANNEL INIT [ACTPOS AX=X]\n"]);
            text += &format!("G01 X{x:.3} Y{y:.3} F{:.0}\n{init}", random.log(500.0, 20_000.0));
        }
        let run = go(&[], &text);
        for (axis, way) in ways.iter().enumerate() {
            let end = *set(&run, axis).last().unwrap();
            assert!((end - way).abs() <= 6.0 * window, "seed {}: {end}, {way}", seed() + k);
            let actual = run.axis(axis, |a| a.act);
            // 20 m/min at 1 ms, and the overshoot of the axis
            assert!(actual.windows(2).all(|w| (w[1] - w[0]).abs() < 0.4), "seed {}", seed() + k);
            let rests = run.records.windows(2).filter(|w| w.iter().all(|r| r.path.v_mm_s <= 0.0));
            let jump = |w: &[CycleRecord]| (w[1].axes[axis].set - w[0].axes[axis].set).abs();
            assert!(rests.map(jump).fold(0.0, f64::max) <= window, "seed {}", seed() + k);
        }
    }
}
