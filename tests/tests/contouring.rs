//! Rounded corners and splines of programs, judged only by the trace and the programmed geometry.

use kontur_interpreter::diag::Condition;
use kontur_kit::{Random, count, seed};
use kontur_tests::{Run, from_polyline, run, there_and_back};

const SQUARE: [[f64; 2]; 5] = [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0], [0.0, 0.0]];
const CORNERS: [[f64; 2]; 3] = [[20.0, 0.0], [20.0, 20.0], [0.0, 20.0]];

fn square(mode: &str) -> Run {
    let run = run(&format!("%S\nN10 G90 G01 F600\n{mode}\nX20\nY20\nX0\nG260 Y0\nM30\n"), &[]);
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    assert_eq!(run.set(2).last().unwrap()[..], [0.0, 0.0]);
    run
}

/// Distance of the interpolated polyline from a point; at F600 its chords are at most 0.01 mm long.
fn distance(run: &Run, p: [f64; 2]) -> f64 {
    let driven: Vec<Vec<f64>> =
        run.records.iter().map(|r| vec![r.axes[0].ipo, r.axes[1].ipo]).collect();
    let e = from_polyline(&p, &driven);
    libm::hypot(e[0], e[1])
}

fn off_square(p: &[f64]) -> f64 {
    let square: Vec<Vec<f64>> = SQUARE.iter().map(|p| p.to_vec()).collect();
    let e = from_polyline(p, &square);
    libm::hypot(e[0], e[1])
}

/// Messages about functions that are replaced by simpler ones.
fn fallbacks(run: &Run) -> usize {
    run.diagnostics.iter().filter(|d| d.id == Condition::Fallback).count()
}

/// Between chords of length `h` a curve of radius `r` is `h^2 / 8 r` away; on the curve with d = 8/3 0.1 / sin 45 deg = 0.377 mm the
/// smallest radius is 0.2 mm at the speed that the axes allow.
#[test]
fn dev_passes_every_corner_at_its_distance() {
    let run = square("#CONTOUR MODE ON [DEV PATH_DEV=0.1]");
    assert_eq!(fallbacks(&run), 0);
    assert_eq!(run.ids(), Vec::<u32>::new());
    for corner in CORNERS {
        let d = distance(&run, corner);
        assert!((d - 0.1).abs() < 1e-4, "{corner:?}: {d} mm");
    }
    for r in &run.records {
        assert!(off_square(&[r.axes[0].ipo, r.axes[1].ipo]) <= 0.1 + 1e-6);
    }
    assert!(run.records.len() < square("").records.len());
}

/// The middle of the curve itself, at a speed at which the chords do not matter.
#[test]
fn dev_to_a_nanometre() {
    let program = "%S\nG90 G01 F60\nG261\n#CONTOUR MODE [DEV PATH_DEV=0.1]\nX1\nG260 Y1\nM30\n";
    let run = run(program, &["kontur.cycle_time_us=250"]);
    let d = distance(&run, [1.0, 0.0]);
    assert!((d - 0.1).abs() < 1e-6, "{d} mm");
}

/// 1 mm on either side: the middle is 3/8 sin 45 deg = 0.2651650 mm from the corner.
#[test]
fn dist_begins_and_ends_where_asked() {
    let run = square("#CONTOUR MODE ON [DIST PRE_DIST=1 POST_DIST=1]");
    for corner in CORNERS {
        let d = distance(&run, corner);
        assert!((d - 0.265_165_043).abs() < 1e-4, "{corner:?}: {d} mm");
    }
    // off the square only within 1 mm of a corner
    for r in &run.records {
        let p = [r.axes[0].ipo, r.axes[1].ipo];
        let near = CORNERS
            .iter()
            .any(|c| (p[0] - c[0]).abs() <= 1.0 + 1e-9 && (p[1] - c[1]).abs() <= 1.0 + 1e-9);
        assert!(near || off_square(&p) <= 1e-9, "{p:?}");
    }
}

/// Keys keep their values across commands and modes; PATH_DEV starts with 1 mm.
#[test]
fn keys_persist() {
    let d = |mode: &str| distance(&square(mode), CORNERS[0]);
    assert!((d("G261") - 1.0).abs() < 1e-4);
    let kept = "#CONTOUR MODE [DEV PATH_DEV=0.1]\n#CONTOUR MODE [DIST PRE_DIST=2 POST_DIST=2]\n\
                #CONTOUR MODE ON [DEV]";
    assert!((d(kept) - 0.1).abs() < 1e-4);
    let dist = "#CONTOUR MODE [DIST PRE_DIST=2 POST_DIST=2]\n#CONTOUR MODE [DEV]\n\
                #CONTOUR MODE ON [DIST]";
    assert!((d(dist) - 2.0 * 0.265_165_043).abs() < 1e-4);
}

/// G61 acts only at the end of its block; OPMODE=1 contours with CONTERROR.
#[test]
fn once_and_the_old_form() {
    let program = "%S\nG90 G01 F600\n#CONTOUR MODE [PATH_DEV=0.1]\nX20\nG61 Y20\nX0\nY0\nM30\n";
    let once = run(program, &[]);
    assert!((distance(&once, CORNERS[1]) - 0.1).abs() < 1e-4);
    for r in &once.records {
        let p = [r.axes[0].ipo, r.axes[1].ipo];
        let near = (p[0] - 20.0).abs() < 1.0 && (p[1] - 20.0).abs() < 1.0;
        assert!(near || off_square(&p) <= 1e-9, "{p:?}");
    }
    let old = square("#HSC ON [OPMODE=1 CONTERROR=0.2]");
    assert!((distance(&old, CORNERS[0]) - 0.2).abs() < 1e-4);
    assert_eq!(fallbacks(&old), 0);
}

/// An exact stop and a flush leave the corner as programmed.
#[test]
fn stops_suppress_contouring() {
    for (at, stop) in [("G60", ""), ("", "#FLUSH WAIT\n")] {
        let program = format!(
            "%S\nG90 G01 F600\n#CONTOUR MODE ON [PATH_DEV=0.1]\n{at} X20\n{stop}G261 Y20\nG260 X0\nM30\n"
        );
        let run = run(&program, &[]);
        assert!(!run.totals.aborted, "{:?}", run.diagnostics);
        assert!(run.set(2).contains(&vec![20.0, 0.0]), "{at}{stop}");
        assert_eq!(run.set(2).last().unwrap()[..], [0.0, 20.0]);
    }
}

/// `#FLUSH CONTINUE` leaves the corner where it is and does not stop: this corner is passed like that of G260, the next one is
/// rounded. Source: TF5200 programming manual 207042443.
#[test]
fn flush_continue_keeps_its_corner() {
    let drive = |first: &str, second: &str| {
        run(
            &format!(
                "%S\nG90 G01 F600\n#CONTOUR MODE ON [PATH_DEV=0.1]\n{first}\nX20\n{second}\nG261 Y20\nX0\nG260\nM30\n"
            ),
            &[],
        )
    };
    let (kept, sharp) = (drive("", "#FLUSH CONTINUE"), drive("G260", ""));
    assert_eq!(kept.diagnostics, []);
    let way = |run: &Run| run.set(2).iter().map(|p| p.to_vec()).collect::<Vec<_>>();
    assert_eq!(way(&kept), way(&sharp));
    let corner = |run: &Run, p: [f64; 2]| {
        let e = from_polyline(&p, &way(run));
        libm::hypot(e[0], e[1])
    };
    assert!((corner(&kept, [20.0, 20.0]) - 0.1).abs() < 1e-3);
    assert!((corner(&drive("", ""), [20.0, 0.0]) - 0.1).abs() < 1e-3);
}

/// The records name all blocks in their order.
#[test]
fn lines_stay_in_order() {
    let run = square("#CONTOUR MODE ON [DEV PATH_DEV=0.1]");
    let mut lines: Vec<u32> = run.records.iter().map(|r| r.line).collect();
    assert!(lines.windows(2).all(|w| w[0] <= w[1]));
    lines.dedup();
    assert!(lines.ends_with(&[4, 5, 6, 7]), "{lines:?}");
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
