//! K-0119 against brute force: the smallest distance between the tool path and every element of random contours of lines and
//! arcs, sampled densely. Neighbours may also come close to each other away from their corner. A radius that changes grows or
//! shrinks in proportion to the way along its line, or of the line across the contour.

use super::{Step, run};
use kontur_kit::Random;
use kontur_motion::path::Path;
use std::fmt::Write as _;

const SAMPLES: u32 = 800;

/// An element as points with equal spacing.
type Points = Vec<[f64; 2]>;

fn shares() -> impl Iterator<Item = f64> {
    (0..=SAMPLES).map(|i| f64::from(i) / f64::from(SAMPLES))
}

fn line(from: [f64; 2], to: [f64; 2]) -> Points {
    shares().map(|t| [0, 1].map(|i| from[i] + t * (to[i] - from[i]))).collect()
}

fn arc(centre: [f64; 2], radius: f64, start_rad: f64, sweep_rad: f64) -> Points {
    let point = |t: f64| {
        let (sin, cos) = libm::sincos(start_rad + t * sweep_rad);
        [centre[0] + radius * cos, centre[1] + radius * sin]
    };
    shares().map(point).collect()
}

/// Smallest difference of the distance between two point sequences and the tool radius on the first one, and the longest step
/// within them.
fn least(way: &Points, radii: [f64; 2], contour: &Points) -> (f64, f64) {
    let growth = (radii[1] - radii[0]) / f64::from(SAMPLES);
    let far = |(i, a): (usize, &[f64; 2]), b: &[f64; 2]| {
        libm::hypot(a[0] - b[0], a[1] - b[1]) - radii[0] - growth * i as f64
    };
    let length =
        |points: &Points| libm::hypot(points[0][0] - points[1][0], points[0][1] - points[1][1]);
    let step = [length(way) + growth.abs(), length(contour)];
    let mut best = f64::INFINITY;
    // a coarse search, then a fine one around its result: the distance changes by no more than the distance between two points
    let coarse = 20;
    for a in way.iter().enumerate().step_by(coarse) {
        for b in contour.iter().step_by(coarse) {
            best = best.min(far(a, b));
        }
    }
    let reach = coarse as f64 * (step[0] + step[1]);
    for (i, a) in way.iter().enumerate().step_by(coarse) {
        for (j, b) in contour.iter().enumerate().step_by(coarse) {
            if far((i, a), b) > best + reach {
                continue;
            }
            for a in way.iter().enumerate().take(i + coarse).skip(i) {
                for b in &contour[j..(j + coarse).min(contour.len())] {
                    best = best.min(far(a, b));
                }
            }
        }
    }
    (best, step[0] + step[1])
}

/// How the tool radius changes.
#[derive(Clone, Copy, PartialEq)]
enum Change {
    None,
    Along,
    Across,
}

/// A contour with the blocks N1 to N5 as elements, the radius in each of them, and its program.
fn contour(random: &mut Random, k: usize, change: Change) -> (Vec<Points>, [f64; 6], String) {
    let radius = random.between(0.5, 3.0);
    // with G26 a straight motion is never part of a corner
    let corner = if change == Change::None { ["G25", "G26"][k / 2 % 2] } else { "G26" };
    let side = ["G41", "G42"][k % 2];
    let mode = ["G138", "G139"][k / 4 % 2];
    let mut text = format!("F1000 {corner} {mode}\nV.G.WZ_AKT.R={radius:.6}\n");
    let (mut at, mut heading) = ([0.0, 0.0], random.between(0.0, 360.0));
    let _ = writeln!(text, "G01 X-40 Y-40\n{side} X0 Y0");
    if change == Change::Across {
        text.insert_str(0, "#TRC [PERPENDICULAR_RADIUS_CHANGE=1]\n");
    }
    let mut elements = Vec::new();
    let mut radii = [radius; 6];
    for i in 1..=5 {
        let mut new = String::new();
        let changes = change != Change::None && i > 1 && random.between(0.0, 1.0) < 0.4;
        if changes {
            let radius = random.between(0.5, 5.0);
            new = format!("V.G.WZ_AKT.R={radius:.6} ");
            radii[i..].fill(radius);
        }
        heading += random.between(-150.0, 150.0);
        let (sin, cos) = libm::sincos(heading.to_radians());
        if random.between(0.0, 1.0) < 0.5 || (changes && change == Change::Along) {
            let length = random.between(3.0, 25.0);
            let to = [at[0] + length * cos, at[1] + length * sin];
            let _ = writeln!(text, "N{i} {new}G01 X{:.9} Y{:.9}", to[0], to[1]);
            elements.push(line(at, to));
            at = to;
        } else {
            let bend = random.between(2.0, 20.0);
            let sweep = random.between(20.0, 300.0)
                * if random.between(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
            // the centre of a counter-clockwise arc is to the left of its direction
            let sign = sweep.signum();
            let centre = [at[0] - sign * bend * sin, at[1] + sign * bend * cos];
            let start_rad = libm::atan2(at[1] - centre[1], at[0] - centre[0]);
            let points = arc(centre, bend, start_rad, sweep.to_radians());
            let to = points[points.len() - 1];
            let g = if sweep > 0.0 { "G03" } else { "G02" };
            let _ = writeln!(
                text,
                "N{i} {new}{g} X{:.9} Y{:.9} I{:.9} J{:.9}",
                to[0],
                to[1],
                centre[0] - at[0],
                centre[1] - at[1]
            );
            elements.push(points);
            at = to;
            heading += sweep;
        }
    }
    let _ = writeln!(text, "N9 G40 G01 X{:.6} Y{:.6}\nM30", at[0] + 50.0, at[1] + 50.0);
    (elements, radii, text)
}

#[test]
fn bottlenecks_of_random_contours_are_found_and_no_others() {
    are_found(Change::None);
}

#[test]
fn bottlenecks_for_a_new_radius_are_found_and_no_others() {
    are_found(Change::Along);
    are_found(Change::Across);
}

/// The tool radius at the end of a line of block `n`.
fn after_line(change: Change, current: f64, radii: &[f64; 6], n: usize, length: f64) -> f64 {
    match change {
        Change::None => current,
        Change::Along => radii[n],
        // away from the end of a block, or back to the start of the next one
        Change::Across => {
            let is_old = (current - radii[n]).abs() < 1e-12;
            let next = radii[if is_old { (n + 1).min(5) } else { n }];
            let is_across = ((next - current).abs() - length).abs() < 1e-6;
            if is_across { next } else { current }
        }
    }
}

fn are_found(change: Change) {
    let mut random = Random::new(19);
    // the contour starts below the lines that set up the compensation
    let above = if change == Change::Across { 5 } else { 4 };
    let (mut cut, mut free, mut of_neighbours) = (0, 0, 0);
    for k in 0..300 {
        let (elements, radii, text) = contour(&mut random, k, change);
        let outcome = run(&text);
        let told = match &outcome.diagnostics[..] {
            [] => None,
            [told] if told.id.to_string() == "K-0119" => Some(told),
            // too tight at a corner
            _ => continue,
        };
        let mut found = Vec::new();
        let mut current = radii[1];
        for step in &outcome.steps {
            let Step::Motion { block, source, .. } = step else { continue };
            let Some(n @ 1..=5) = source.block else { continue };
            let (a, b) = (block.path.start(), block.path.end());
            let [from, to] = [a, b].map(|p| [p[0], p[1]]);
            let (way, radius) = if let Path::Arc(way) = &block.path {
                let shape = way.shape();
                let way = arc(shape.centre_mm, way.radius(), way.start_angle(), shape.sweep_rad);
                (way, [current; 2])
            } else {
                let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
                let new = after_line(change, current, &radii, n as usize, length);
                (line(from, to), [std::mem::replace(&mut current, new), new])
            };
            for (i, element) in elements.iter().enumerate() {
                let i = i as u64 + 1;
                // only a line across the contour may cut its own element: an arc about the tool
                let is_across = change == Change::Across && (radius[0] - radius[1]).abs() > 1e-12;
                if i == n && !is_across {
                    continue;
                }
                let (depth, step) = least(&way, radius, element);
                if depth < -1e-4 - 1e-9 {
                    found.push((source.line, i, n.abs_diff(i), depth, step));
                }
            }
        }
        match told {
            None => {
                free += 1;
                assert!(found.is_empty(), "not told: {found:?}\n{text}");
            }
            Some(told) => {
                cut += 1;
                let line = told.source.as_ref().map_or(0, |place| place.line);
                let numbers = |from: &str| {
                    let rest = told.text.split(from).nth(1).unwrap();
                    let end = rest.find(|c: char| c != '.' && !c.is_ascii_digit());
                    rest[..end.unwrap_or(rest.len())].trim_matches('.').parse::<f64>().unwrap()
                };
                let contour = numbers("line ") as u64 - above;
                let depth = numbers("within ") - numbers("radius is ");
                // brute force may miss a cut that is less deep than its step
                let same = found.iter().find(|f| f.0 == line && f.1 == contour);
                if let Some((_, _, apart, by_force, step)) = same {
                    of_neighbours += usize::from(*apart == 1);
                    let slack = step + 1e-4;
                    // where they cross, every distance is 0
                    let crosses = numbers("within ") == 0.0 && *by_force <= depth + slack;
                    assert!(
                        (by_force - depth).abs() <= slack || crosses,
                        "{by_force}: {}\n{text}",
                        told.text
                    );
                } else {
                    assert!(depth > -0.3, "{}: not so, {found:?}\n{text}", told.text);
                }
            }
        }
    }
    assert!(cut > 50 && free > 50 && of_neighbours > 3, "{cut} cut, {free} free, {of_neighbours}");
}
