//! Splines through random points, also there and back with sharp turns inside: the contour is the polyline of the unfiltered
//! setpoints, which are on the spline.

use kontur_interpreter::diag::Condition;
use kontur_interpreter::record::AxisRecord;
use kontur_kit::{Random, count, from_polyline, largest, seed};
use kontur_tests::{Run, run, there_and_back};

/// Largest acceleration of the built-in machine in mm/s2: between two setpoints the spline bulges out by `a T^2 / 8` at most.
const ACC_MM_S2: f64 = 6000.0;

fn points(r: &mut Random) -> Vec<[f64; 2]> {
    if r.chance(0.4) {
        let size = r.log(0.3, 30.0);
        return (0..3 + r.below(8)).map(|_| [(); 2].map(|()| r.between(-size, size))).collect();
    }
    there_and_back(r)
}

/// Largest component of the shortest vector from one row of points to the lines between those of another one; the part of it
/// that counts begins so many samples before and ends so many after.
fn furthest(points: &[Vec<f64>], lines: &[Vec<f64>], before: usize, behind: usize) -> f64 {
    let from = |k: usize| {
        let part = &lines[k.saturating_sub(before)..(k + behind + 1).min(lines.len())];
        largest(&from_polyline(&points[k], part))
    };
    let every = 1 + points.len() / 500;
    (0..points.len()).step_by(every).map(from).fold(0.0, f64::max)
}

fn deviation(run: &Run, reach: usize) -> f64 {
    let of = |f: fn(&AxisRecord) -> f64| -> Vec<Vec<f64>> {
        run.records.iter().map(|r| r.axes[..2].iter().map(f).collect()).collect()
    };
    let (contour, set) = (of(|a| a.ipo), of(|a| a.set));
    // from the set path to the contour that the filters hold, and from that to what they make of it
    furthest(&set, &contour, reach, 1).max(furthest(&contour, &set, 1, reach))
}

/// Conformance: V055.
#[test]
fn splines_keep_the_tolerance() {
    for n in 0..count(6) as u64 {
        let mut r = Random::new(seed() * 1_000_000 + n);
        let (mode, freq_hz, tolerance_mm) =
            (1 + r.below(4), r.between(10.0, 60.0), (r.log(3e-3, 0.1) * 1e4).round() / 1e4);
        let slope = r.pick(&["TRAPEZ", "SIN2", "HSC", "STEP"]);
        let cycle_us = r.pick(&[500, 1000]);
        let mut text = format!(
            "%P\n#SLOPE [TYPE={slope}]\n#VIB GUARD ON [MODE={mode} FREQ={freq_hz:.1} AX_DEV={tolerance_mm}]\nG01 F{:.0}\nG151\n",
            r.log(800.0, 20_000.0)
        );
        for [x, y] in points(&mut r) {
            text += &format!("X{x:.3} Y{y:.3}\n");
        }
        let run = run(&format!("{text}G150\nM30\n"), &format!("kontur.cycle_time_us={cycle_us}"));
        // a tip without any radius has no direction: refused
        if run.diagnostics.iter().any(|d| d.id == Condition::Unsupported) {
            continue;
        }
        assert_eq!(run.diagnostics, [], "{n}: {text}");
        let reach = (1.5 / freq_hz / run.cycle_s).ceil() as usize + 4;
        let bulge = ACC_MM_S2 * run.cycle_s * run.cycle_s / 8.0;
        let found = deviation(&run, reach);
        assert!(found <= tolerance_mm + bulge + 1e-6, "{n}: {found} mm\n{text}");
    }
}
