//! Change of the tool radius along the next line, or perpendicular to the contour (`#TRC [PERPENDICULAR_RADIUS_CHANGE=1]`).
//!
//! Distances from the contour by brute force over random contours.

use super::{Step, run};
use kontur_kit::Random;
use std::fmt::Write as _;

/// Distance of a point from a line between two others.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    let t = t.clamp(0.0, 1.0);
    libm::hypot(p[0] - a[0] - t * d[0], p[1] - a[1] - t * d[1])
}

/// Whether the foot of a point lies between two others.
fn is_beside(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> bool {
    let d = [b[0] - a[0], b[1] - a[1]];
    let t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    (0.0..=1.0).contains(&t)
}

#[test]
fn random_contours_are_nowhere_cut() {
    are_nowhere_cut(false);
    are_nowhere_cut(true);
}

/// `across`: the radius changes perpendicular to the contour instead of along the third element.
fn are_nowhere_cut(across: bool) {
    let option = u8::from(across);
    let mut random = Random::new(7);
    let mut driven = 0;
    for k in 0..300 {
        let mut points = vec![[0.0, 0.0]];
        let mut angle = random.between(0.0, 360.0);
        for _ in 0..4 {
            angle += random.between(-130.0, 130.0);
            let (length, last) = (random.between(25.0, 50.0), points[points.len() - 1]);
            let (sin, cos) = libm::sincos(angle.to_radians());
            points.push([last[0] + length * cos, last[1] + length * sin]);
        }
        let (first, second) = (random.between(1.0, 5.0), random.between(1.0, 5.0));
        let (side, corner) = (["G41", "G42"][k % 2], ["G25", "G26"][k / 2 % 2]);
        let mut text = format!(
            "#TRC [PERPENDICULAR_RADIUS_CHANGE={option}]\nG138 F100\n\
             {corner} V.G.WZ_AKT.R={first:.6}\nX{:.6} Y{:.6}\n{side} X0 Y0\n",
            points[0][0] - 30.0,
            points[0][1]
        );
        for (i, p) in points.iter().enumerate().skip(1) {
            if i == 3 {
                let _ = writeln!(text, "V.G.WZ_AKT.R={second:.6}");
            }
            let _ = writeln!(text, "N{i} X{:.9} Y{:.9}", p[0], p[1]);
        }
        let [x, y] = points[4].map(|p| p + 40.0);
        let _ = writeln!(text, "N9 G40 X{x:.6} Y{y:.6}\nM30");
        let outcome = run(&text);
        if !outcome.diagnostics.is_empty() {
            // too tight for one of the two, or a bottleneck between elements further apart
            continue;
        }
        driven += 1;
        for step in &outcome.steps {
            let Step::Motion { block, source, .. } = step else { continue };
            let Some(at @ 1..=4) = source.block else { continue };
            let at = at as usize;
            // of the arcs about outer corners the ends
            let (a, b) = (block.path.start(), block.path.end());
            let pieces = if block.path.is_straight() { 20 } else { 1 };
            let samples = (0..=pieces).map(|i| {
                let t = f64::from(i) / f64::from(pieces);
                [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
            });
            for p in samples {
                // checked against its neighbours only: elements further away are covered by the warning K-0119
                for i in at.saturating_sub(1).max(1)..=(at + 1).min(4) {
                    let far = distance(p, points[i - 1], points[i]);
                    let changed = i > 2 && at > if across { 2 } else { 3 };
                    let least = if changed { second } else { first.min(second) };
                    assert!(far > least - 1e-6, "{far} instead of {least} at {p:?}\n{text}");
                    // along the third element up to the larger radius, beyond that at corners only
                    if !across && i == 3 && at == 3 && is_beside(p, points[2], points[3]) {
                        let most = first.max(second);
                        assert!(far < most + 1e-6, "{far} beyond {most} at {p:?}\n{text}");
                    }
                }
            }
        }
    }
    assert!(driven > 150, "{driven} of 300 contours were driven");
}
