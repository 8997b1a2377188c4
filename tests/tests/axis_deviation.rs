//! `AX_DEV` as a promise: over random programs, the filter switched inside some of them, no axis leaves the contour by more
//! than the tolerance and no point of the contour is missed by more, by the program's own column and by the geometry of this
//! package.
//!
//! `COUNT=2000 SEED=7 cargo test --release -p kontur-tests --test all the_tolerance_holds_over_random` takes as many programs of
//! another kind.

mod chords;
mod measure;
mod program;
mod rests;
mod splines;
mod wide;

use kontur_interpreter::diag::Condition;
use kontur_kit::{Random, count, seed};
use kontur_tests::geometry::norm;
use kontur_tests::{machine, run, run_with_inputs};
use measure::{Case, largest, missed, off_contour, recomputed};
use program::{
    Writer, arcs, contoured, dynamics, filter, off, polygon, rounded, short_blocks, splined,
};

/// Rounding of the sums over the kernel; a trace prints two digits less.
const SLACK_MM: f64 = 1e-9;

fn case(seed: u64) -> Case {
    let mut r = Random::new(seed);
    let cycle_us = r.pick(&[500, 1000, 2000]);
    let slope = r.pick(&["TRAPEZ", "SIN2", "HSC", "STEP"]);
    let tolerance_mm = rounded(r.log(1e-3, 1e-1));
    let (command, mut settings, reach) = filter(&mut r, tolerance_mm, cycle_us);
    settings.push(format!("kontur.cycle_time_us={cycle_us}"));
    settings.extend(dynamics(&mut r));
    let mut w = Writer::new();
    w.put("%P");
    let feed = r.log(100.0, 15000.0).round();
    w.put(&format!("G90 G01 F{feed}"));
    w.put(&format!("#SLOPE [TYPE={slope}]"));
    w.put(&command);
    let scale = r.pick(&[0.02, 0.3, 2.0, 15.0]);
    let mut off_mm = 0.0;
    let kind = r.below(6);
    // a rounded corner and a spline end where the filter is switched
    if kind < 4 && r.chance(0.4) {
        w.switch = Some(([off(&command).to_owned(), command.clone()], 1 + r.below(5)));
    }
    match kind {
        0 | 1 => polygon(&mut r, &mut w, scale),
        2 => arcs(&mut r, &mut w, scale.max(0.05)),
        3 => short_blocks(&mut r, &mut w, scale),
        4 => contoured(&mut r, &mut w, scale.max(0.3)),
        _ => off_mm = splined(&mut r, &mut w),
    }
    w.put("M30");
    Case { off_mm, ..w.case(settings, tolerance_mm, reach) }
}

/// Runs the program of a number and judges it; returns the largest deviation of a set point as a share of the tolerance.
fn holds(n: u64, case: &Case) -> f64 {
    let run = run(&case.text, &case.settings);
    let about = || format!("program {n}\n{}\n{:?}", case.text, case.settings);
    assert!(!run.totals.aborted, "{:?}\n{}", run.diagnostics, about());
    let unkept = run.diagnostics.iter().find(|d| d.id == Condition::AxDevNotKept);
    assert_eq!(unkept, None, "{}", about());
    let case = &case.as_driven(&run);
    let own = largest(&run, |a| a.dev.abs());
    let (leaves, k) = recomputed(&run, case);
    // the contour of a spline is known within `off_mm` only
    let (misses, line) = if case.off_mm > 0.0 { (0.0, 0) } else { missed(&run, case) };
    for (what, mm, most_mm) in [
        ("interpolated off the contour", off_contour(&run, case), case.off_mm),
        ("X_dev_mm", own, case.tolerance_mm),
        ("both ways", largest(&run, |a| a.dev_both_ways), case.tolerance_mm),
        (&*format!("leaves in cycle {k}"), leaves, case.within_mm()),
        (&*format!("misses line {line}"), misses, case.tolerance_mm),
    ] {
        assert!(mm <= most_mm + SLACK_MM, "{what}: {mm} mm of {most_mm}\n{}", about());
    }
    own / case.tolerance_mm
}

/// Conformance: V002, V055, V056.
#[test]
fn the_tolerance_holds_over_random_programs() {
    let first = seed() * 1_000_000;
    let shares = (first..first + count(6) as u64).map(|n| holds(n, &case(n)));
    let tightest = shares.fold(0.0, f64::max);
    assert!(tightest > 0.9, "the tolerance is used: {tightest}");
}

/// Arcs of 0.02 mm, one of which was asked to crawl for what another one caused; a rest at a corner under a filter of three
/// cycles, which was met and counted as missed; rounded corners in a row, and arcs with the filter switched between them, run
/// through so slowly that the plan did not look for what is missed.
#[test]
fn random_programs_that_were_wrong() {
    for n in [8_000_031, 8_000_043, 21_000_060, 23_000_025] {
        holds(n, &case(n));
    }
}

/// Curves of chords, under filters of a few cycles as well: of a plan that another answer had moved by other than whole cycles what it
/// misses was not measured again (one of 25 programs, up to 1.14 times the tolerance).
///
/// `COUNT=2000 SEED=7 cargo test --release -p kontur-tests --test all the_tolerance_holds_over_curves` takes as many.
#[test]
fn the_tolerance_holds_over_curves_of_chords() {
    let first = seed() * 1_000_000;
    let shares = (first..first + count(12) as u64).map(|n| holds(n, &chords::case(n)));
    let tightest = shares.fold(0.0, f64::max);
    assert!(tightest > 0.9, "the tolerance is used: {tightest}");
}

/// A square of 50 mm under `#HSC ON [BSPLINE]`, its corners rounded within `path_dev`.
fn square_spline(slope: &str, feed: f64, path_dev: f64, guard: &str) -> String {
    format!(
        "G90 G01 F{feed}\n#SLOPE [TYPE={slope}]\n{guard}\n#HSC ON [BSPLINE PATH_DEV={path_dev}]\n\
         G01 X50\nG01 Y50\nG01 X0\nG01 Y0\n#HSC OFF\nM30\n"
    )
}

/// The speed that the tolerance leaves to a sharp bend is not that of the whole edge: a rounded square takes hardly longer
/// than the square with its corners, which rests in them if it has to.
#[test]
fn a_sharp_bend_does_not_slow_down_its_edge() {
    let guards = [
        "#VIB GUARD ON [MODE=4 FREQ=6.4 DAMPING=0.14 AX_DEV=0.002]",
        "#VIB GUARD ON [MODE=1 FREQ=20 DAMPING=0.05 AX_DEV=0.01]",
    ];
    for (guard, feed) in guards.into_iter().zip([600.0, 6000.0]) {
        for slope in ["TRAPEZ", "SIN2", "HSC", "STEP"] {
            let rounded = square_spline(slope, feed, 0.01, guard);
            let cornered: String = rounded
                .lines()
                .filter(|l| !l.contains("HSC O"))
                .map(|l| l.to_owned() + "\n")
                .collect();
            let [with, without] = [&rounded, &cornered].map(|text| run(text, &[]).records.len());
            let longer = with as f64 / without as f64;
            assert!(longer <= 1.1, "{slope} {guard}: {with} cycles, with corners {without}");
        }
    }
}

/// What is far smaller than the tolerance changes a corner by as little: a block, a chamfer, a rounding or a contour of some
/// micrometers in it. Both lines were run through at the speed of the corner, up to 80 times as long.
#[test]
fn something_tiny_in_a_corner_changes_little() {
    let mut r = Random::new(seed());
    for n in 0..count(24) {
        let cycle_us = r.pick(&[500, 1000, 2000]);
        let tolerance_mm = rounded(r.log(5e-3, 5e-2));
        let (mode, freq_hz) = (1 + r.below(4), r.log(10.0, 50.0));
        let slope = r.pick(&["TRAPEZ", "SIN2", "HSC", "STEP"]);
        let size = rounded(tolerance_mm * r.log(0.02, 0.2)).max(1e-5);
        let heading = r.between(0.5, 3.0);
        let end = [12.0 + 6.0 * libm::cos(heading), 6.0 * libm::sin(heading)];
        let line = |u: f64| [12.0 + u * libm::cos(heading), u * libm::sin(heading)];
        let [to, behind] = [end, line(size)].map(|p| format!("G01 X{:.6} Y{:.6}", p[0], p[1]));
        let sharp = format!("G01 X12\n{to}");
        let tiny = match n % 4 {
            0 => format!("G01 X{:.6}\n{behind}\n{to}", 12.0 - size),
            1 => format!("G01 X12\nG301 I{size:.5}\n{to}"),
            2 => format!("G01 X12\nG302 I{size:.5}\n{to}"),
            _ => format!("#CONTOUR MODE [DEV PATH_DEV={size:.5}]\nG61 G01 X12\n{to}"),
        };
        let [sharp, tiny] = [sharp, tiny].map(|contour| {
            let text = format!(
                "%P\n#SLOPE [TYPE={slope}]\n#VIB GUARD ON [MODE={mode} FREQ={freq_hz:.3} AX_DEV={tolerance_mm}]\nF6000\n{contour}\nM30\n"
            );
            let run = run(&text, &format!("kontur.cycle_time_us={cycle_us}"));
            // a tiny curve may be given up for the corner itself
            let others = run.diagnostics.iter().filter(|d| d.id != Condition::CornerFaster);
            assert_eq!(others.count(), 0, "{text}");
            (run.records.len(), text)
        });
        // one more corner, which may add a rest as long as the filter
        let rest = (1.5 / freq_hz / (1e-6 * f64::from(cycle_us))).ceil() as usize + 4;
        assert!(tiny.0 <= sharp.0 + rest, "{} cycles, {} with\n{}", sharp.0, tiny.0, tiny.1);
    }
}

/// Changes of override and feedholds in the middle of it neither lose nor repeat a part of the contour, and the tolerance
/// holds wherever the program does not say that it could not be kept.
#[test]
fn override_and_feedhold_on_a_rounded_square() {
    let guard = "#VIB GUARD ON [MODE=2 FREQ=15 DAMPING=0.1 AX_DEV=0.005]";
    for (n, slope) in ["TRAPEZ", "SIN2", "HSC", "STEP"].into_iter().enumerate() {
        let text = square_spline(slope, 1800.0, 0.02, guard);
        let free = run(&text, &[]);
        for program in 0..count(1) as u64 {
            let mut r = Random::new(seed() * 1000 + 10 * n as u64 + program);
            let mut inputs = Vec::new();
            let mut t = 0.0;
            while t < 8.0 {
                t += r.between(0.05, 0.8);
                inputs.push((t, "override_percent", r.between(20.0, 150.0).round()));
                if r.chance(0.3) {
                    inputs.push((t + 0.01, "feedhold", 1.0));
                    t += r.between(0.2, 0.6);
                    inputs.push((t, "feedhold", 0.0));
                }
            }
            let changed = run_with_inputs(machine(&[]), &text, &inputs);
            assert!(!changed.totals.aborted, "{:?}", changed.diagnostics);
            let [last, free_last] = [&changed, &free].map(|run| run.records.last().unwrap());
            assert!(
                (last.path.s_mm - free_last.path.s_mm).abs() < 1e-6,
                "{slope}: {} mm",
                last.path.s_mm
            );
            for pair in changed.records.windows(2) {
                let step = pair[1].path.s_mm - pair[0].path.s_mm;
                assert!((-1e-9..0.05).contains(&step), "{slope}: {step} mm in cycle {}", pair[1].k);
                let moved = norm([0, 1, 2].map(|i| pair[1].axes[i].ipo - pair[0].axes[i].ipo));
                assert!(moved <= step + 1e-7, "{slope}: {moved} of {step} mm, {}", pair[1].k);
            }
            if changed.diagnostics.iter().all(|d| d.id != Condition::AxDevNotKept) {
                let axes = changed.records.iter().flat_map(|r| &r.axes[..3]);
                let own = axes.map(|a| a.dev_both_ways).fold(0.0, f64::max);
                assert!(own <= 0.005 + SLACK_MM, "{slope}: {own}");
            } else {
                println!("{slope} {program}: not kept before a change, said so");
            }
        }
    }
}

/// Small circles in a few long cycles: nothing of the lines between the set points leaves them, of which only some points are
/// examined by a plan. The distance from a circle is known.
#[test]
fn nothing_leaves_a_small_circle_between_two_set_points() {
    let mut r = Random::new(seed());
    let tolerance_mm = 0.01;
    for n in 0..count(24) {
        let centre = if n == 0 {
            [0.069022, 0.041067]
        } else {
            [r.between(0.02, 0.2), r.between(-0.2, 0.2)].map(|c| (c * 1e6).round() / 1e6)
        };
        let (mode, freq) =
            if n == 0 { (1, 60) } else { (r.pick(&[1, 2, 3, 4]), r.pick(&[30, 60, 90])) };
        let text = format!(
            "%P\n#SLOPE [TYPE=STEP]\n#VIB GUARD ON [MODE={mode} FREQ={freq} AX_DEV={tolerance_mm}]
G02 X0 Y0 I{} J{} F6000\nM30\n",
            centre[0], centre[1]
        );
        let run = run(&text, &["kontur.cycle_time_us=4000"]);
        let set = |k: usize| [0, 1].map(|i| run.records[k].axes[i].set - centre[i]);
        let radius = libm::hypot(centre[0], centre[1]);
        for k in 1..run.records.len() {
            let [from, to] = [set(k - 1), set(k)];
            for part in 0..=200 {
                let u = f64::from(part) / 200.0;
                let at = [0, 1].map(|i| from[i] + u * (to[i] - from[i]));
                let off = 1.0 - radius / libm::hypot(at[0], at[1]);
                let most = off.abs() * at[0].abs().max(at[1].abs());
                assert!(most <= tolerance_mm + SLACK_MM, "cycle {k} + {u}: {most} mm\n{text}");
            }
        }
    }
}
