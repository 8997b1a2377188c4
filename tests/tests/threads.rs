//! Threads and turning: the spindle and the path in every cycle.

use kontur_kit::largest;
use kontur_tests::{Run, machine, run, run_with_inputs};
use std::f64::consts::TAU;

const Z: usize = 2;
const SPINDLE: usize = 3;

/// Position of Z and angle of the spindle in the cycles of some lines.
fn together(run: &Run, lines: std::ops::RangeInclusive<u32>) -> Vec<(f64, f64)> {
    let of = run.records.iter().filter(|r| lines.contains(&r.line));
    of.map(|r| (r.axes[Z].set, r.axes[SPINDLE].set)).collect()
}

/// Speeds of the spindle in rev/min.
fn rpm(run: &Run) -> Vec<(u32, f64, f64)> {
    let at = |w: &[kontur_interpreter::record::CycleRecord]| {
        let turn = (w[1].axes[SPINDLE].set - w[0].axes[SPINDLE].set) / run.cycle_s / 6.0;
        (w[1].line, w[1].axes[0].set, turn)
    };
    run.records.windows(2).map(at).collect()
}

/// F = S x pitch (tapping, 208104203): in every cycle the spindle has made one revolution per pitch, and turns back with a negative
/// speed.
#[test]
fn tapping_turns_the_spindle_with_the_path() {
    for (text, sense) in [
        ("M19 S200 S.POS0\nG01 Z5 F3000\nG63 Z-20 F300 S200\nZ5 S-200\nG01 Z10 F3000", 1.0),
        ("M19 S200 S.POS0\nG01 Z5 F3000\nG63 Z-20 F300 S-200\nZ5 S200\nG01 Z10 F3000", -1.0),
        ("M5\nG01 Z5 F3000\nG331 Z-20 K1.5 S200\nG332 Z5\nG01 Z10 F3000", 1.0),
        ("M5\nG01 Z5 F3000\nG331 Z-20 K-1.5 S200\nG332 Z5 K-1.5 S200\nG01 Z10 F3000", -1.0),
    ] {
        let run = run(&format!("%P\n{text}\nM30\n"), &[]);
        assert_eq!(run.diagnostics, [], "{text}");
        let tapped = together(&run, 4..=5);
        assert!(tapped.iter().any(|(z, _)| (z + 20.0).abs() < 1e-9));
        for (z, deg) in &tapped {
            let want = sense * (5.0 - z) / 1.5 * 360.0;
            assert!((deg - want).abs() < 1e-6, "{text}: {z} {deg}, not {want}");
        }
        let most = rpm(&run).iter().fold(0.0, |most: f64, (_, _, v)| most.max(v.abs()));
        assert!((most - 200.0).abs() < 1e-6, "{text}: {most}");
        assert!((run.records.last().unwrap().axes[Z].set - 10.0).abs() < 1e-9);
        assert!(run.records.last().unwrap().axes[SPINDLE].set.abs() < 1e-6);
    }
}

/// A spindle that cannot follow slows the path down: its speed and acceleration stay within its list, the pitch is maintained.
#[test]
fn tapping_as_fast_as_the_spindle_can() {
    let settings = "S.getriebe[0]: dynamik.vb_max=3000000, vb_eilgang=3000000, slope_profil.a_beschl=2000, \
                    slope_profil.a_brems=2000";
    let run = run("%P\nG63 Z-40 F3000 S2000\nG01 Z-41 F100\nM30\n", settings);
    assert_eq!(run.said(), ["K-0131"]);
    let tapped = together(&run, 2..=2);
    for (z, deg) in &tapped {
        assert!((deg + z / 1.5 * 360.0).abs() < 1e-6, "{z} {deg}");
    }
    let [_, speed, acc, _] = run.derivatives(SPINDLE).map(|x| largest(&x));
    assert!(speed <= 3000.0 + 1e-6, "{speed} deg/s");
    assert!(acc > 100.0 && acc <= 2000.0 * (1.0 + 1e-6), "{acc} deg/s2");
}

/// Position of a thread before the filters, which delay all passes alike: Z minus the pitch for every revolution, within one pitch, in
/// the steady part of the lines.
fn thread(run: &Run, line: u32, pitch: f64, sense: f64) -> f64 {
    let (low, high) = (-30.0, -10.0);
    let steady: Vec<f64> = run
        .of_line(line)
        .map(|r| (r.axes[Z].ipo, r.axes[SPINDLE].ipo))
        .filter(|(z, _)| (low..=high).contains(z))
        .map(|(z, deg)| z + sense * pitch * deg / 360.0)
        .collect();
    assert!(steady.len() > 20);
    for x in &steady {
        assert!((x - steady[0]).abs() < 1e-7, "the pitch is not kept: {x} {}", steady[0]);
    }
    steady[0].rem_euclid(pitch)
}

/// P-CHAN-00836.
const KEEPS_PITCH: &str = "channel.thread_cutting.ignore_override=1";

/// P-CHAN-00837.
const CHAIN: &str = "channel.thread_cutting.thread_chain=1";

/// A feedhold before the thread delays it: the thread begins at the mark all the same.
#[test]
fn a_feedhold_before_a_thread_delays_it() {
    let text = "%P\nM3 S500\nG33 Z-40 K1.5\nG01 Z-41 F100\nM5\nM30\n";
    let free = run_with_inputs(machine(&[]), text, &[]);
    let inputs = [(0.01, "feedhold", 1.0), (3.0371, "feedhold", 0.0)];
    let late = run_with_inputs(machine(&[]), text, &inputs);
    assert_eq!(late.diagnostics, []);
    assert!(late.records.len() > free.records.len() + 1000);
    assert!(apart(thread(&free, 3, 1.5, 1.0), thread(&late, 3, 1.5, 1.0), 1.5) < 1e-7);
}

/// Consecutive blocks with G33: separate threads, each from the mark (P-CHAN-00837 = 0), or one thread without a stop.
#[test]
fn a_chain_of_threads() {
    let text = "%P\nM3 S500\nG33 Z-15.4 K1.5\nZ-40\nG01 Z-41 F100\nM5\nM30\n";
    let rests = |run: &Run| {
        let before = run.records.iter().filter(|r| matches!(r.line, 3 | 4));
        before.filter(|r| (r.axes[Z].set + 15.4).abs() < 1e-6 && r.path.v_mm_s <= 0.0).count()
    };
    let single = run(text, &[]);
    assert_eq!(single.diagnostics, []);
    assert!(rests(&single) > 1);
    let begins = single.records.iter().position(|r| r.axes[Z].set < -15.4 - 1e-9).unwrap();
    let angle = single.records[begins].axes[SPINDLE].set.rem_euclid(360.0);
    assert!(angle <= 3.0 + 1e-6, "{angle}");
    let chain = run(text, &[CHAIN]);
    assert_eq!(chain.diagnostics, []);
    assert_eq!(rests(&chain), 0);
    let (a, b) = (together(&chain, 3..=3), together(&chain, 4..=4));
    let lies = |(z, deg): &(f64, f64)| z + 1.5 * deg / 360.0;
    assert!((lies(&a[a.len() - 20]) - lies(&b[20])).abs() < 1e-7);
    // another G function releases the spindle
    let run = run("%P\nG63 Z-10 F100 S100\nG01 Z0\nM19 S100 S.POS90\nM5\nM30\n", &[]);
    assert!(run.diagnostics.iter().all(|d| !d.is_error()), "{:?}", run.diagnostics);
}

fn apart(a: f64, b: f64, pitch: f64) -> f64 {
    let d = (a - b).rem_euclid(pitch);
    d.min(pitch - d)
}

/// Passes of G33 cut the same thread whenever they begin, other start angles lie next to it (thread cutting, 400186379), and an override
/// that does not act on G33 (P-CHAN-00836) changes nothing.
#[test]
fn passes_of_a_thread_lie_in_each_other() {
    for (m, sense) in [("M3", 1.0), ("M4", -1.0)] {
        let text = format!(
            "%P\n{m} S611.7\nG33 Z-40 K1.5\nG00 X1\nZ0\nG04 0.1234\nG33 Z-40 K1.5\nG00 Z0\nG33 Z-40 K1.5 S.OFFSET=120\n\
             G00 Z0\nG33 Z-35\nZ-40\nG01 Z-41 F100\nM5\nM30\n"
        );
        for inputs in [&[][..], &[(0.0, "override_percent", 50.0)]] {
            let run = run_with_inputs(machine(&[KEEPS_PITCH]), &text, inputs);
            assert_eq!(run.diagnostics, [], "{text}");
            let passes = [3, 7, 9, 11].map(|line| thread(&run, line, 1.5, sense));
            assert!(apart(passes[0], passes[1], 1.5) < 1e-7, "{passes:?}");
            assert!(apart(passes[0], passes[3], 1.5) < 1e-7, "{passes:?}");
            let third = apart(passes[0] + sense * 0.5, passes[2], 1.5);
            assert!(third < 1e-7, "{passes:?}");
            for (line, z) in [(3, -40.0), (12, -40.0), (13, -41.0)] {
                let last = run.of_line(line).next_back().unwrap().axes[Z].set;
                assert!((last - z).abs() < 1e-9, "line {line}: {last}");
            }
        }
    }
}

/// A pass begins at its start angle, whatever rest `AX_DEV` asks for at the corner before it.
#[test]
fn passes_lie_in_each_other_behind_any_corner() {
    for (freq, ax_dev) in [(15.0, 0.01), (4.0, 0.01), (2.0, 0.001)] {
        let text = format!(
            "%P\nM3 S611.7\n#VIB GUARD ON [MODE=4 FREQ={freq} AX_DEV={ax_dev}]\nG01 Z9 F6000\nG33 Z-50 K1.5\nG01 X20 Z9\nG33 Z-50\nG00 Z9\n\
             G01 X10\nG33 Z-50\nG00 Z10\nZ9\nG04 0.0731\nG33 Z-50\nG01 X0 Z9\nZ9.1\nZ9\nG33 Z-50\nM5\nM30\n"
        );
        let run = run(&text, &[]);
        assert_eq!(run.said(), ["K-0112"], "{text}");
        let passes = [5, 7, 10, 14, 18].map(|line| thread(&run, line, 1.5, 1.0));
        for pass in passes {
            assert!(apart(pass, passes[0], 1.5) < 1e-6, "{freq} Hz: {passes:?}");
        }
    }
}

/// An override that does not act on G33 (P-CHAN-00836) leaves it as it is, whenever it changes.
#[test]
fn an_override_that_does_not_act_leaves_the_thread_alone() {
    for head in
        ["#SLOPE [TYPE=SIN2]", "#SLOPE [TYPE=HSC]\n#VIB GUARD ON [MODE=4 FREQ=15 AX_DEV=0.01]"]
    {
        let text = format!("%P\n{head}\nM3 S611.7\nG01 X3 F3000\nG33 Z-40 K1.5\nG01 X5\nM30\n");
        let line = text.lines().position(|l| l.starts_with("G33")).unwrap() as u32 + 1;
        let alone = thread(&run_with_inputs(machine(&[KEEPS_PITCH]), &text, &[]), line, 1.5, 1.0);
        let steps = (0..400_u32).map(|i| {
            let percent = if i % 2 == 0 { 100.0 } else { 50.0 };
            (f64::from(i) * 0.0137, "override_percent", percent)
        });
        let run = run_with_inputs(machine(&[KEEPS_PITCH]), &text, &steps.collect::<Vec<_>>());
        let pass = thread(&run, line, 1.5, 1.0);
        assert!(apart(pass, alone, 1.5) < 1e-7, "{text}{pass} {alone}");
    }
}

/// `AX_DEV` is kept at the corner behind a thread, wherever between two cycles the thread begins: on the polyline through the
/// set points, the corner is reached and nothing lies beside both lines by more.
#[test]
fn the_tolerance_holds_behind_a_thread() {
    const SHARES: u32 = 8;
    for (slope, mode, ax_dev) in
        [("TRAPEZ", 4, 0.01), ("STEP", 1, 0.005), ("SIN2", 2, 0.01), ("HSC", 3, 0.02)]
    {
        for share in 0..SHARES {
            // 3.6 deg in a cycle
            let deg = 3.6 * f64::from(share) / f64::from(SHARES);
            let text = format!(
                "%P\n#SLOPE [TYPE={slope}]\n#VIB GUARD ON [MODE={mode} FREQ=15 AX_DEV={ax_dev}]\nM3 S600\nG33 Z-5 K1.5 S.OFFSET={deg}\n\
                 G01 X20 F3000\nM30\n"
            );
            let run = run(&text, &[]);
            let set: Vec<_> =
                run.records.iter().map(|r| (r.axes[0].set, r.axes[Z].set + 5.0)).collect();
            let beside = set.iter().map(|(x, z)| x.abs().min(z.abs())).fold(0.0, f64::max);
            let between = set.windows(2).flat_map(|w| {
                let [(x, z), (to_x, to_z)] = [w[0], w[1]];
                (0..50).map(move |i| {
                    let t = f64::from(i) / 50.0;
                    (x + (to_x - x) * t).abs().max((z + (to_z - z) * t).abs())
                })
            });
            let missed = between.fold(f64::INFINITY, f64::min);
            let most = ax_dev * (1.0 + 1e-9);
            assert!(beside <= most && missed <= most + 1e-4, "{text}{beside} {missed}");
        }
    }
}

const FACE: &str = "X.kenngr.achs_mode=65";

/// The program of the page (constant cutting speed at feed rate per revolution, 400190603) from X60 to X10: n = v / (2 pi x), the path
/// 1.5 mm per revolution, the speed kept in rapid blocks.
#[test]
fn constant_cutting_speed_and_feed_per_revolution() {
    let run = run(
        "%P\nM03 S2000 G01 X60 Z100 F1500\nG196 S2500\nG95 F1.5\nG96 S100\nG04 1\nZ49\nX10\nG00 Z50\nX60\nZ48\nG04 1\nG01 X10\n\
         G97\nG94\nX11 F100\nM30\n",
        &[FACE],
    );
    assert_eq!(run.ids(), [0_u32; 0], "{:?}", run.diagnostics);
    let n = |x: f64| (100_000.0 / (TAU * x)).min(2500.0);
    let speeds = rpm(&run);
    // at X60 during the motion in Z, after the dwell
    for (line, x, v) in speeds.iter().filter(|(line, _, _)| matches!(line, 7 | 8)) {
        // of the previous cycle or of this one
        assert!((v - n(*x)).abs() < 0.01 * n(*x), "line {line}: X{x} {v} {}", n(*x));
    }
    let rapid: Vec<f64> =
        speeds.iter().filter(|(l, _, _)| matches!(l, 9..=11)).map(|s| s.2).collect();
    // in the first cycle it is still rising
    assert!(rapid[1..].iter().all(|v| (v - n(10.0)).abs() < 1e-6), "G00 keeps the speed");
    // the feed per revolution where nothing accelerates: within the step of a hundredth
    let on = run
        .records
        .windows(2)
        .filter(|w| w[1].line == 8 && w[1].axes[0].set < 50.0 && w[1].axes[0].set > 15.0);
    for w in on {
        let turn = (w[1].axes[SPINDLE].set - w[0].axes[SPINDLE].set) / 360.0;
        let feed = (w[0].axes[0].set - w[1].axes[0].set) / turn;
        assert!((feed - 1.5).abs() < 0.04, "X{}: {feed} mm/rev", w[1].axes[0].set);
    }
    // G97 keeps the speed that was reached
    let last = speeds.iter().rfind(|(line, _, _)| *line == 16).unwrap();
    assert!((last.2 - n(10.0)).abs() < 1e-3, "{last:?}");
}

/// Blocks between which the path rests are separate threads, each from the mark: exact stop, dwell, flush.
#[test]
fn a_rest_in_a_thread_waits_for_the_mark_again() {
    for rest in ["G360", "", "#FLUSH"] {
        let dwell = if rest.is_empty() { "G04 0.0377" } else { rest };
        let text = format!(
            "%P\nM3 S500\n{rest}\nG33 Z-5 K1.5\n{dwell}\nG33 Z-40\nG01 Z-41 F100\nM5\nM30\n"
        );
        let run = run(&text, &[]);
        assert_eq!(run.diagnostics, [], "{text}");
        let begins = run.records.iter().position(|r| r.line == 6 && r.axes[Z].set < -5.0).unwrap();
        // since the mark the spindle has turned for one cycle at most: 3 deg at 500 rev/min
        let angle = run.records[begins].axes[SPINDLE].set.rem_euclid(360.0);
        assert!(angle <= 3.0 + 1e-6, "{angle}");
    }
}

/// Z and the spindle are in the same place of the thread only after the same filters and with the same lag: K-0112 reports where not, and
/// then Z is off by what delay and lag give; equal entries in both give no message.
#[test]
fn tapping_with_filters_and_lags() {
    let low_pass = "filter[0]: enable=1, type=1, order=1, time_constant=20000";
    let guard = "vib_guard: active=1, mode=2, freq=20";
    let half = "getriebe[0].kv=2500";
    let by_speed = "getriebe[0].dyn_kv: dyn_kv_active=1, kv1=2500, kv2=2500";
    // S600 and 1.5 mm: 15 mm/s; kv 25/s instead of 50/s are 20 ms more
    for (axes, entries, before, told, actual_mm) in [
        ("X,Y,Z", low_pass, "", true, None),
        ("X,Y,Z,S", low_pass, "", false, Some(0.0)),
        ("X,Y,Z", guard, "", true, None),
        ("X,Y,Z,S", guard, "", false, Some(0.0)),
        ("Z", half, "", true, Some(0.3)),
        ("Z,S", half, "", false, Some(0.0)),
        ("Z", by_speed, "", true, Some(0.3)),
        ("Z,S", by_speed, "", false, Some(0.0)),
        ("", "", "G135\n", true, Some(0.3)),
        ("", "", "G135\nS[G135]\n", false, Some(0.0)),
        ("", "", "", false, Some(0.0)),
    ] {
        let settings = if axes.is_empty() { String::new() } else { format!("{axes}.{entries}") };
        let run = run(&format!("%P\n{before}G331 Z-10 K1.5 S600\nG332 Z0\nM30\n"), &settings);
        let id = kontur_interpreter::diag::Condition::UnequalKernels;
        // unequal axes of the path give another message, without a place of tapping
        let said = run.diagnostics.iter().filter(|d| d.id == id && d.text.contains("tapping"));
        assert_eq!(said.count(), usize::from(told), "{settings:?}: {:?}", run.diagnostics);
        let apart = run.records.iter().map(|r| {
            let (z, s) = (&r.axes[Z], &r.axes[SPINDLE]);
            (z.act + 1.5 * s.act / 360.0).abs()
        });
        let most = apart.fold(0.0, f64::max);
        if let Some(want) = actual_mm {
            assert!((most - want).abs() < 1e-3, "{settings:?} {before}: {most} {want}");
        } else {
            assert!(most > 0.05, "{settings:?}: {most}");
        }
    }
}
