//! Arcs in space by three points, and contour lines by two angles.

use kontur_tests::{Run, run};

/// Set position of X, Y, Z at the end of a line of the program.
fn end(run: &Run, line: u32) -> [f64; 3] {
    let last = run.of_line(line).next_back().unwrap();
    [0, 1, 2].map(|i| last.axes[i].set)
}

fn near(a: [f64; 3], b: [f64; 3], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The program of the page (arc in space, 206116363): every set point lies in the plane of the three points and at their distance from
/// their circumcentre, the arc passes the interim point once, and its length is radius times angle.
#[test]
fn an_arc_through_three_points() {
    let (a, m, e) = ([0.0, 0.0, 30.0], [30.0, 75.0, 15.0], [60.0, 0.0, 0.0]);
    // circumcentre from the lengths of the sides: barycentric weights
    let (ea, ma, ee) = (distance(m, e), distance(a, e), distance(a, m));
    let weight = |x: f64, y: f64, z: f64| x * x * (y * y + z * z - x * x);
    let (wa, wm, we) = (weight(ea, ma, ee), weight(ma, ee, ea), weight(ee, ea, ma));
    let sum = wa + wm + we;
    let centre: [f64; 3] = std::array::from_fn(|i| (wa * a[i] + wm * m[i] + we * e[i]) / sum);
    let radius = distance(a, centre);
    for text in [
        "N20 G90 G01 F2000 X0 Y0 Z30\nN30 G303 I30 J75 K15 X60 Y0 Z0",
        "N20 G90 G01 F2000 X0 Y0 Z30\nN30 G91 G303 I30 J75 K-15 X60 Z-30",
        "V.G.NP[1].V.X=7 G54 G90 G01 F2000 X-7 Y0 Z30\nN30 G303 I23 J75 K15 X53 Y0 Z0",
    ] {
        let run = run(&format!("%P\n{text}\nG90 G01 Z-1\nM30\n"), &[]);
        assert_eq!(run.diagnostics, [], "{text}");
        let arc: Vec<[f64; 3]> = run.of_line(3).map(|r| [0, 1, 2].map(|i| r.axes[i].set)).collect();
        let nearest = arc.iter().map(|p| distance(*p, m)).fold(f64::MAX, f64::min);
        assert!(nearest < 0.05, "the interim point is {nearest} away");
        let length: f64 = arc.windows(2).map(|w| distance(w[0], w[1])).sum();
        // the central angle by the law of cosines; the way through the interim point is the longer one
        let short = 2.0 * libm::asin(0.5 * distance(a, e) / radius);
        let want = radius * (std::f64::consts::TAU - short);
        assert!((length - want).abs() < 0.1, "{length} {want}");
        for p in arc.iter().filter(|p| distance(**p, e) > 0.05) {
            assert!((distance(*p, centre) - radius).abs() < 1e-6, "{p:?}");
        }
        assert!(near(end(&run, 3), e, 0.05));
    }
}

/// Two lines meet at their intersection: 30 deg out of (5, 0), 80 deg into (100, 80) (numbers of 21910), compared with the intersection
/// of two lines by Cramer's rule.
#[test]
fn contour_lines_of_two_angles() {
    let run = run(
        "%P\nG18 G90 G0 X0 Y0 Z0\nF1000 G91 G1 Z10 X5\n#ANG 30\nG90 #ANG 80 Z80 X100\nG04 0.1\nM30\n",
        &[],
    );
    assert_eq!(run.diagnostics, []);
    let (a, b) = (30.0_f64.to_radians(), 80.0_f64.to_radians());
    // z = 10 + s cos a = 80 - t cos b, x = 5 + s sin a = 100 - t sin b
    let det = libm::cos(a) * libm::sin(b) - libm::cos(b) * libm::sin(a);
    let s = (70.0 * libm::sin(b) - 95.0 * libm::cos(b)) / det;
    let corner = [5.0 + s * libm::sin(a), 0.0, 10.0 + s * libm::cos(a)];
    let nearest = run.records.iter().map(|r| distance([0, 1, 2].map(|i| r.axes[i].set), corner));
    assert!(nearest.fold(f64::MAX, f64::min) < 0.02);
    assert!(near(end(&run, 6), [100.0, 0.0, 80.0], 1e-9));
    // the first line has a line of the program of its own
    let first = run.of_line(4).count();
    let second = run.of_line(5).count();
    assert!(first > 100 && second > 100, "{first} {second}");
    for r in run.of_line(4) {
        let (z, x) = (r.axes[2].set - 10.0, r.axes[0].set - 5.0);
        assert!(
            (z * libm::sin(a) - x * libm::cos(a)).abs() < 1e-6 || z > s * libm::cos(a),
            "{z} {x}"
        );
    }
}
