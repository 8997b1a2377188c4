//! Offset curves of plane contours, and the elements inserted at their corners.
//!
//! Intersections are found by Newton's method in the path fractions of both elements.

use super::path::{Piece, Point, dot, plus};
use super::tree::{Contour, Insert, Way};

/// The plane of a contour: first, second and third axis.
pub type Plane = [usize; 3];

fn flat(p: Point, [a, b, _]: Plane) -> [f64; 2] {
    [p[a], p[b]]
}

fn cross(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}

fn product(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[0] + p[1] * q[1]
}

fn length(p: [f64; 2]) -> f64 {
    libm::hypot(p[0], p[1])
}

/// Derivative of the position with respect to the path fraction, in the plane.
fn along(piece: &Piece, share: f64, plane: Plane) -> [f64; 2] {
    let (s, c) = libm::sincos(piece.angle * share);
    let turned = plus(plus([0.0; 3], piece.u, -s), piece.v, c);
    flat(plus(piece.rise, turned, piece.angle), plane)
}

fn direction(piece: &Piece, share: f64, plane: Plane) -> [f64; 2] {
    let t = along(piece, share, plane);
    [t[0] / length(t), t[1] / length(t)]
}

/// The point at a distance to the left.
fn left_of(p: [f64; 2], t: [f64; 2], distance: f64) -> [f64; 2] {
    [p[0] - distance * t[1], p[1] + distance * t[0]]
}

/// The offset curve at a distance to the left, with the motion of the third axis.
fn parallel(piece: &Piece, distance: f64, plane: Plane) -> Piece {
    let [a, b, _] = plane;
    let mut shifted = piece.clone();
    if piece.angle == 0.0 {
        let p = left_of(flat(piece.centre, plane), direction(piece, 0.0, plane), distance);
        (shifted.centre[a], shifted.centre[b]) = (p[0], p[1]);
    } else {
        let radius = dot(piece.u, piece.u).sqrt();
        let against_the_clock = cross(flat(piece.u, plane), flat(piece.v, plane)) > 0.0;
        let inwards = if against_the_clock { distance } else { -distance };
        let scaled = |p| plus([0.0; 3], p, 1.0 - inwards / radius);
        (shifted.u, shifted.v) = (scaled(piece.u), scaled(piece.v));
    }
    shifted
}

/// From one path fraction to another; the third axis keeps its whole motion.
fn part(piece: &Piece, from: f64, to: f64, [a, b, _]: Plane) -> Piece {
    let mut cut = piece.clone();
    if piece.angle == 0.0 {
        let start = piece.at(from);
        (cut.centre[a], cut.centre[b]) = (start[a], start[b]);
        (cut.rise[a], cut.rise[b]) = (piece.rise[a] * (to - from), piece.rise[b] * (to - from));
        return Piece::line(cut.number, cut.centre, plus(cut.centre, cut.rise, 1.0));
    }
    let (s, c) = libm::sincos(piece.angle * from);
    let u = plus(plus([0.0; 3], piece.u, c), piece.v, s);
    let v = plus(plus([0.0; 3], piece.v, c), piece.u, -s);
    Piece::arc(cut.number, cut.centre, [u, v], piece.angle * (to - from), cut.rise)
}

/// Path fractions at which two consecutive elements intersect, nearest to their common corner.
fn meet(p: &Piece, q: &Piece, plane: Plane) -> Option<[f64; 2]> {
    let mut best: Option<([f64; 2], f64)> = None;
    for i in 0..36 {
        let (mut s, mut t) = (1.0 - 0.2 * f64::from(i % 6), 0.2 * f64::from(i / 6));
        for _ in 0..60 {
            let (x, y) = (flat(p.at(s), plane), flat(q.at(t), plane));
            let off = [y[0] - x[0], y[1] - x[1]];
            let (dx, dy) = (along(p, s, plane), along(q, t, plane));
            let determinant = cross(dx, dy);
            if determinant.abs() < 1e-12 {
                break;
            }
            s += cross(off, dy) / determinant;
            t += cross(off, dx) / determinant;
        }
        let (x, y) = (flat(p.at(s), plane), flat(q.at(t), plane));
        let apart = length([y[0] - x[0], y[1] - x[1]]);
        let inside = |share: f64| (-1e-9..=1.0 + 1e-9).contains(&share);
        // how far backwards, and how far forwards
        let way = (1.0 - s) * length(along(p, s, plane)) + t * length(along(q, t, plane));
        if apart < 1e-9 && inside(s) && inside(t) && best.is_none_or(|(_, other)| way < other) {
            best = Some(([s, t], way));
        }
    }
    best.map(|(shares, _)| shares)
}

/// How a corner is passed.
enum Corner {
    /// Path fractions at which the elements are cut.
    Cut([f64; 2]),
    /// The tool does not fit.
    Narrow,
    Smooth,
    /// How far the tangents are extended to the ends of a line.
    Lines(f64),
    Arc(f64),
}

fn corner(before: &Piece, after: &Piece, distance: f64, contour: &Contour, plane: Plane) -> Corner {
    let (u, w) = (direction(before, 1.0, plane), direction(after, 0.0, plane));
    let turn = cross(u, w);
    if turn.abs() < 1e-9 && product(u, w) > 0.0 {
        return Corner::Smooth;
    }
    if turn * distance > 0.0 {
        let (p, q) = (parallel(before, distance, plane), parallel(after, distance, plane));
        return meet(&p, &q, plane).map_or(Corner::Narrow, Corner::Cut);
    }
    let angle = libm::atan2(turn.abs(), product(u, w));
    if contour.by_arcs {
        return Corner::Arc(angle);
    }
    Corner::Lines(contour.radius * libm::tan(angle / 2.0).min(1.0))
}

/// The position with other coordinates in the plane.
fn placed(at: Point, p: [f64; 2], [a, b, _]: Plane) -> Point {
    let mut at = at;
    (at[a], at[b]) = (p[0], p[1]);
    at
}

/// The point perpendicular to an end of an element.
fn above(element: &Piece, share: f64, distance: f64, plane: Plane) -> Point {
    let p = flat(element.at(share), plane);
    let p = left_of(p, direction(element, share, plane), distance);
    placed(element.at(share), p, plane)
}

/// The path of the tool centre: approach, contour and, where the program knows it (G139), exit, all in the plane except for the third
/// axis; `None` where the tool does not fit between two elements.
pub fn compensated(contour: &Contour, pieces: &[Piece], plane: Plane) -> Option<Vec<Piece>> {
    let side = |radius: f64| if contour.left { radius } else { -radius };
    let distance = side(contour.radius);
    let (approach, rest) = pieces.split_first().unwrap();
    let (exit, elements) = match contour.way {
        Way::Lines => rest.split_last().map(|(exit, elements)| (Some(exit), elements)).unwrap(),
        Way::Perpendicular | Way::Stays => (None, rest),
    };
    let (first, last) = (&elements[0], elements.last().unwrap());
    let start = above(first, 0.0, distance, plane);
    let mut all = if contour.way == Way::Perpendicular {
        let up = Piece::line(first.number, first.at(0.0), start);
        vec![approach.clone(), up]
    } else {
        vec![Piece::line(
            approach.number,
            approach.at(0.0),
            placed(approach.at(1.0), flat(start, plane), plane),
        )]
    };
    let mut end = distance;
    match contour.change {
        None => all.extend(parallels(contour, elements, distance, plane)?),
        Some((i, radius)) => {
            // element i leads from its own corner at one distance to that at the other; extended tangents stay outside it
            let (line, number) = (&elements[i], elements[i].number);
            end = side(radius);
            let other = Contour { radius, ..contour.clone() };
            let mut before = parallels(contour, &elements[..=i], distance, plane)?;
            let mut after = parallels(&other, &elements[i..], end, plane)?;
            let (from, to) = (before.pop().unwrap().at(0.0), after.remove(0).at(1.0));
            let (foot, head) = (above(line, 0.0, distance, plane), above(line, 1.0, end, plane));
            let t = direction(line, 0.0, plane);
            let ahead = |p: Point, q: Point| {
                let (p, q) = (flat(p, plane), flat(q, plane));
                product([q[0] - p[0], q[1] - p[1]], t) > 0.0
            };
            all.extend(before);
            let mut way = vec![from];
            way.extend(ahead(from, foot).then_some(foot));
            way.extend(ahead(head, to).then_some(head));
            way.push(to);
            if !way.is_sorted_by(|p, q| !ahead(*q, *p)) {
                return None;
            }
            all.extend(way.windows(2).map(|two| Piece::line(number, two[0], two[1])));
            all.extend(after);
        }
    }
    let stop = above(last, 1.0, end, plane);
    match (contour.way, exit) {
        (Way::Perpendicular, _) => all.push(Piece::line(last.number, stop, last.at(1.0))),
        (_, Some(exit)) => all.push(Piece::line(exit.number, stop, exit.at(1.0))),
        (_, None) => {}
    }
    Some(all)
}

/// Offset curves of consecutive elements, with the elements inserted at their corners.
fn parallels(
    contour: &Contour,
    elements: &[Piece],
    distance: f64,
    plane: Plane,
) -> Option<Vec<Piece>> {
    let mut all = Vec::new();
    let place = |at: Point, p: [f64; 2]| placed(at, p, plane);
    let mut from = 0.0;
    for (i, element) in elements.iter().enumerate() {
        let end = element.at(1.0);
        let aside = parallel(element, distance, plane);
        let next = elements.get(i + 1);
        let kind = next.map(|next| corner(element, next, distance, contour, plane));
        // a line that is extended keeps the motion of its third axis, an arc gets a line at its end
        let prolonged = |piece: &Piece, reach: f64| {
            let is_line = piece.angle == 0.0;
            if is_line { reach / length(along(piece, 0.0, plane)) } else { 0.0 }
        };
        let to = match kind {
            Some(Corner::Cut([s, _])) => s,
            Some(Corner::Lines(reach)) => 1.0 + prolonged(element, reach),
            _ => 1.0,
        };
        all.push(part(&aside, from, to, plane));
        from = 0.0;
        match kind {
            Some(Corner::Cut([_, t])) => from = t,
            Some(Corner::Lines(reach)) => {
                let next = next.unwrap();
                from = -prolonged(next, reach);
                let (u, w) = (direction(element, 1.0, plane), direction(next, 0.0, plane));
                let start = flat(aside.at(to), plane);
                let after = flat(parallel(next, distance, plane).at(from), plane);
                let (p, q) = (
                    left_of(flat(end, plane), u, distance),
                    left_of(flat(end, plane), w, distance),
                );
                let ahead = [p[0] + reach * u[0], p[1] + reach * u[1]];
                let back = [q[0] - reach * w[0], q[1] - reach * w[1]];
                for two in [start, ahead, back, after].windows(2) {
                    let (p, q) = (place(end, two[0]), place(end, two[1]));
                    all.push(Piece::line(element.number, p, q));
                }
            }
            Some(Corner::Arc(angle)) => {
                let t = direction(element, 1.0, plane);
                let zero = [0.0; 3];
                let u = place(zero, left_of([0.0; 2], t, distance));
                // the tool leaves the way it came
                let v = plus(zero, place(zero, t), contour.radius);
                all.push(Piece::arc(element.number, end, [u, v], angle, zero));
            }
            Some(Corner::Narrow) => return None,
            Some(Corner::Smooth) | None => {}
        }
    }
    Some(all)
}

/// Two motions and the element inserted between them.
pub fn inserted(kind: Insert, size: f64, [before, after]: &[Piece; 2], plane: Plane) -> Vec<Piece> {
    let [a, b, _] = plane;
    let (u, w) = (direction(before, 1.0, plane), direction(after, 0.0, plane));
    let turn = cross(u, w);
    let whole = |piece: &Piece| length(along(piece, 0.0, plane));
    // fraction of an element between its end and the point at this straight-line distance from that end
    let share = |piece: &Piece, back: f64| {
        if piece.angle == 0.0 {
            return back / whole(piece);
        }
        let radius = dot(piece.u, piece.u).sqrt();
        2.0 * libm::asin(back / 2.0 / radius) / piece.angle
    };
    let mut back = size;
    if kind == Insert::ChamferLength {
        // the base of the triangle is the inserted line: nearly as long as the distance times a factor
        for _ in 0..200 {
            let (p, q) = (before.at(1.0 - share(before, back)), after.at(share(after, back)));
            let base = plus(p, q, -1.0);
            back *= size / dot(base, base).sqrt();
        }
    }
    let inwards = if turn > 0.0 { size } else { -size };
    let [s, t] = if kind == Insert::Rounding {
        let (p, q) = (parallel(before, inwards, plane), parallel(after, inwards, plane));
        meet(&p, &q, plane).expect("the rounding fits")
    } else {
        [1.0 - share(before, back), share(after, back)]
    };
    let (first, second) = (part(before, 0.0, s, plane), part(after, t, 1.0, plane));
    let (p, q) = (first.at(1.0), second.at(0.0));
    let between = if kind == Insert::Rounding {
        let centre = left_of(flat(p, plane), direction(before, s, plane), inwards);
        let mut c = p;
        (c[a], c[b]) = (centre[0], centre[1]);
        let u = plus(p, c, -1.0);
        let (from, to) = (direction(before, s, plane), direction(after, t, plane));
        let mut v = [0.0; 3];
        (v[a], v[b]) = (from[0] * size, from[1] * size);
        let turned = libm::atan2(turn.signum() * cross(from, to), product(from, to));
        let turned = if turned < 0.0 { turned + std::f64::consts::TAU } else { turned };
        Piece::arc(after.number, c, [u, v], turned, [0.0; 3])
    } else {
        Piece::line(after.number, p, q)
    };
    vec![first, between, second]
}
