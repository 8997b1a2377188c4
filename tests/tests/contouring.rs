//! Rounded corners and splines of programs, judged only by the trace and the programmed geometry.

use kontur_interpreter::diag::Condition;
use kontur_kit::{Random, count, from_polyline, seed};
use kontur_tests::{Run, run, there_and_back};

/// Messages about functions that are replaced by simpler ones.
fn fallbacks(run: &Run) -> usize {
    run.diagnostics.iter().filter(|d| d.id == Condition::Fallback).count()
}

/// A circle of 10 mm as 60 chords: within PATH_DEV of the polygon, faster, and without kinks.
#[test]
fn spline_through_a_polygonised_circle() {
    let points: Vec<Vec<f64>> = (0..=60)
        .map(|i| {
            let a = 2.0 * std::f64::consts::PI * f64::from(i) / 60.0;
            vec![10.0 * libm::cos(a), 10.0 * libm::sin(a)]
        })
        .collect();
    let chords: String =
        points[1..].iter().map(|p| format!("X{:.9} Y{:.9}\n", p[0], p[1])).collect();
    let drive = |mode: &str| {
        run(&format!("%C\nG90 G00 X10 Y0\nG01 F3000\n{mode}\n{chords}#HSC OFF\nM30\n"), &[])
    };
    let (sharp, smooth) = (drive(""), drive("#HSC ON [BSPLINE PATH_DEV=0.05]"));
    assert!(!smooth.totals.aborted, "{:?}", smooth.diagnostics);
    assert_eq!(fallbacks(&smooth), 0);
    let circle = |r: &Run| -> Vec<Vec<f64>> {
        let on = r.records.iter().filter(|r| r.line > 4);
        on.map(|r| vec![r.axes[0].ipo, r.axes[1].ipo]).collect()
    };
    let driven = circle(&smooth);
    for p in &driven {
        let e = from_polyline(p, &points);
        assert!(libm::hypot(e[0], e[1]) <= 0.05, "{p:?}");
    }
    assert!(smooth.records.len() < sharp.records.len());
    // the direction turns by 6 deg at a kink, within two cycles at most; on the spline, whose curvature is 0.1 per mm, by 0.05 mm * 0.1
    // per mm = 0.29 deg in a cycle
    let sharpest_turn_deg = |p: &[Vec<f64>]| {
        let steps = p.windows(2).map(|w| [w[1][0] - w[0][0], w[1][1] - w[0][1]]);
        let steps: Vec<[f64; 2]> = steps.filter(|d| libm::hypot(d[0], d[1]) > 1e-4).collect();
        let turn = |w: &[[f64; 2]]| {
            let cross = w[0][0] * w[1][1] - w[0][1] * w[1][0];
            libm::atan2(cross, w[0][0] * w[1][0] + w[0][1] * w[1][1]).abs().to_degrees()
        };
        steps.windows(2).map(turn).fold(0.0, f64::max)
    };
    assert!(sharpest_turn_deg(&circle(&sharp)) > 2.9);
    let turn = sharpest_turn_deg(&driven);
    assert!(turn < 0.35, "{turn} deg");
    let end = smooth.set(2).last().unwrap().clone();
    assert!(libm::hypot(end[0] - 10.0, end[1]) < 1e-9, "{end:?}");
}

/// An edge between sharp bends is as fast as its straight part allows: if a long edge lost a tenth of its speed, a larger tolerance would
/// be slower.
#[test]
fn a_larger_path_dev_keeps_long_edges_fast() {
    for feed in [500, 700, 1000] {
        let mut last = usize::MAX;
        for path_dev in ["0.005", "0.01", "0.015", "0.02", "0.03", "0.05", "0.1"] {
            let program = format!(
                "%P\n#SLOPE [TYPE=HSC]\n#HSC ON [BSPLINE PATH_DEV={path_dev}]\nG90 G01 F{feed} X5 Y5\nX5.2 Y30\n\
                 X-15 Y40\n#HSC OFF\nM30\n"
            );
            let run = run(&program, &[]);
            // with the smallest ones a corner is faster
            let other = run.diagnostics.iter().find(|d| d.id != Condition::CornerFaster);
            assert_eq!(other, None);
            let cycles = run.records.len();
            assert!(cycles <= last, "F{feed} {path_dev}: {cycles} cycles after {last}");
            last = cycles;
        }
    }
}

/// A spline that turns sharply is slow there and not along its whole block: per mm it takes at most twice as long as the polygon of its
/// points with a stop at each of them.
#[test]
fn a_sharp_turn_does_not_slow_down_the_spline() {
    let mut compared = 0;
    for k in 0..count(60) as u64 {
        let mut random = Random::new(seed() + k);
        let points = there_and_back(&mut random);
        let slope = random.pick(&["STEP", "TRAPEZ", "SIN2", "HSC"]);
        let feed = random.log(2000.0, 20_000.0);
        let blocks = |word: &str| -> String {
            points.iter().map(|p| format!("{word} X{:.3} Y{:.3}\n", p[0], p[1])).collect()
        };
        let head = format!("%P\n#SLOPE [TYPE={slope}]\nG01 F{feed:.0}\n");
        let spline = run(&format!("{head}G151\n{}G150\nM30\n", blocks("")), &[]);
        // a tip with zero radius has no direction: refused
        if spline.diagnostics.iter().any(|d| d.id == Condition::Unsupported) {
            continue;
        }
        assert_eq!(spline.diagnostics, [], "seed {}", seed() + k);
        let polygon = run(&format!("{head}{}M30\n", blocks("G60")), &[]);
        assert_eq!(polygon.diagnostics, [], "seed {}", seed() + k);
        let pace = |run: &Run| run.records.len() as f64 / run.records.last().unwrap().path.s_mm;
        let ratio = pace(&spline) / pace(&polygon);
        assert!(ratio <= 2.0, "seed {}: {slope} {points:?}: {ratio}", seed() + k);
        compared += 1;
    }
    assert!(compared > 0);
}

/// Line and arc that touch, also where the last decimal of a coordinate turns the joint by 1e-7 rad: such transitions are
/// not contoured (475086859), and the path stays on the contour.
#[test]
fn what_touches_is_not_contoured() {
    for x in ["90", "90.00001", "89.99999"] {
        let program = format!(
            "G01 X30 F3000\n#CONTOUR MODE ON [DEV PATH_DEV=0.1]\nG01 X60\nG03 X{x} Y30 I0 J30\n\
             #CONTOUR MODE OFF\nG01 Y60\nM30\n"
        );
        let run = run(&program, &[]);
        assert_eq!(run.ids(), Vec::<u32>::new(), "{x}");
        for r in &run.records {
            let (x, y) = (r.axes[0].ipo, r.axes[1].ipo);
            let off = if y > 30.0 {
                (x - 90.0).abs()
            } else if x > 60.0 {
                (libm::hypot(x - 60.0, y - 30.0) - 30.0).abs()
            } else {
                y.abs()
            };
            assert!(off < 2e-5, "{off} mm at X{x} Y{y}");
        }
    }
}

/// A software limit a micrometre inside the highest position of a run is reported before it moves, one a micrometre outside is
/// not: the curve through an interim point leaves the range of its lines, in its first half as well as in its second.
#[test]
fn a_curve_passes_no_software_limit_in_silence() {
    let mut random = Random::new(seed());
    let mut beyond = 0;
    for _ in 0..count(40) {
        let pre_post = [random.between(1.0, 4.0), random.between(1.0, 4.0)];
        let mode = format!("POS PRE_DIST={:.2} POST_DIST={:.2}", pre_post[0], pre_post[1]);
        let corners = 1 + (random.ratio() * 3.0) as usize;
        let mut program = format!("#CONTOUR MODE ON [{mode}]\nG01 X10 F300\n");
        for _ in 0..corners {
            let (x, y) = (random.between(2.0, 10.0), random.between(-10.0, 10.0));
            program.push_str(&format!("X{x:.3} Y{y:.3}\n"));
        }
        program.push_str("#CONTOUR MODE OFF\nM30\n");
        let free = run(&program, &[]);
        assert!(!free.totals.aborted, "{program}{:?}", free.diagnostics);
        let highest = free.records.iter().map(|r| r.axes[0].ipo).fold(0.0, f64::max);
        beyond += usize::from(highest > 10.01);
        for (limit_mm, fails) in [(highest - 1e-3, true), (highest + 1e-3, false)] {
            let limit = format!("X.kenngr.swe_pos={:.0}", limit_mm * 1e4);
            let found = run(&program, &[limit.as_str()]);
            let told = found.diagnostics.iter().any(|d| d.id == Condition::OutsideMotionRange);
            assert_eq!(told, fails, "{limit}\n{program}{:?}", found.diagnostics);
        }
    }
    assert!(beyond > 10, "{beyond}");
}

/// The part of a curve that belongs to a block keeps the limits that the program set for it: of the path (`#VECTOR LIMIT`) and of the
/// axes (G127). The speeds are those of the trace.
#[test]
fn a_curve_keeps_the_limits_of_both_blocks() {
    let mut random = Random::new(seed());
    let mut rounded = 0;
    for _ in 0..count(24) {
        let pick = |random: &mut Random, of: usize| (random.ratio() * of as f64) as usize;
        let mode = [
            "DEV PATH_DEV=1",
            "POS PRE_DIST=2 POST_DIST=2",
            "PTP PATH_DIST=3",
            "DIST PRE_DIST=2 POST_DIST=2",
            "DEV PATH_DEV=1 CONST_VEL",
        ][pick(&mut random, 5)];
        let slope = ["STEP", "TRAPEZ", "SIN2", "HSC"][pick(&mut random, 4)];
        // limit, its end, and the speed in mm/s that it permits along X or Y
        let (limit, off, most) = [
            ("#VECTOR LIMIT ON [VEL=1000]", "#VECTOR LIMIT OFF", 1000.0 / 60.0),
            ("G127 X3 Y3 Z3", "G127 X100 Y100 Z100", f64::NAN),
        ][pick(&mut random, 2)];
        let side = random.between(20.0, 60.0);
        let slow_first = random.ratio() < 0.5;
        let (first, second) = if slow_first { (limit, off) } else { ("", limit) };
        let program = format!(
            "#SLOPE [TYPE={slope}]\n#CONTOUR MODE ON [{mode}]\n{first}\nG01 Y{side:.3} F9000\n{second}\n\
             X{side:.3}\n#CONTOUR MODE OFF\nM30\n"
        );
        let contoured = run(&program, &[]);
        assert!(!contoured.totals.aborted, "{program}{:?}", contoured.diagnostics);
        let lines = if slow_first { 0..=4 } else { 6..=6 };
        let steps = contoured
            .records
            .windows(2)
            .filter(|w| lines.contains(&w[1].line) && lines.contains(&w[0].line));
        let speed = |w: &[kontur_interpreter::record::CycleRecord]| {
            let d = [0, 1].map(|i| w[1].axes[i].ipo - w[0].axes[i].ipo);
            libm::hypot(d[0], d[1]) / contoured.cycle_s
        };
        let fastest = steps.map(speed).fold(0.0, f64::max);
        // what the same words permit on a straight line
        let alone = run(&format!("{limit}\nG01 X{side:.3} F9000\nM30\n"), &[]);
        let straight = alone.records.windows(2).map(speed).fold(0.0, f64::max);
        assert!(most.is_nan() || (straight - most).abs() < 0.01, "{straight}");
        // of the axes: at 45 degrees the path is faster than either
        let permitted = if most.is_nan() { straight * std::f64::consts::SQRT_2 } else { straight };
        assert!(fastest <= 1.001 * permitted, "{fastest} of {permitted} mm/s\n{program}");
        assert!(fastest > 0.5 * straight, "{fastest} of {straight} mm/s\n{program}");
        rounded += u32::from(contoured.diagnostics.iter().all(|d| d.id != Condition::CornerFaster));
    }
    assert!(rounded > 6, "{rounded}");
}
