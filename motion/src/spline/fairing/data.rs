//! The points that the spline is fitted to: programmed points, the virtual ones on long edges, and what either is.

use super::fit;
use super::row::{Row, Vertex};

/// Largest sagitta of an edge as a share of the tolerance.
const SAGITTA: f64 = 1.2;
/// Ratio of a long edge to its neighbour from which on it gets virtual points.
const LONGER: f64 = 3.0;
/// Virtual points: the reach in mm from the end of the edge, growth and largest length in mm of the steps, and the
/// shortest first one.
const ZONE_MM: f64 = 4.0;
const GROWTH: f64 = 1.4;
const LARGEST_MM: f64 = 0.4;
const SMALLEST_MM: f64 = 0.02;
/// Length of a straight middle in steps of its virtual points.
const MIDDLE: f64 = 5.0;
/// Reach of the zone around a kink in which axes outside the feed group round it, as a multiple of the length `l` of the
/// fit: the effect of a kink fades by `exp(-x / (2 l))`.
const AROUND: f64 = 6.0;

/// What a point that the spline is fitted to is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Corner,
    Smooth,
    Virtual,
    /// The start or the end of a straight middle.
    Middle,
}

/// A point that the spline is fitted to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Datum {
    /// The point, or the one before the edge that a virtual point is on.
    pub(super) vertex: usize,
    pub(super) at: f64,
    pub(super) kind: Kind,
    /// Whether axes outside the feed group may round a kink here.
    pub(super) at_kink: bool,
}

/// Coordinate of a datum.
pub(super) fn coordinate(row: &Row<'_>, datum: &Datum, axis: usize) -> f64 {
    let here = &row.vertices[datum.vertex];
    if matches!(datum.kind, Kind::Corner | Kind::Smooth) {
        return here.point[axis];
    }
    let next = &row.vertices[datum.vertex + 1];
    let share = (datum.at - here.at) / (next.at - here.at);
    here.point[axis] + share * (next.point[axis] - here.point[axis])
}

/// Largest distance of a datum from the curve: the smaller one of the edges next to it.
pub(super) fn room(row: &Row<'_>, datum: &Datum) -> [f64; 2] {
    let i = datum.vertex;
    let is_vertex = matches!(datum.kind, Kind::Corner | Kind::Smooth);
    let before = (is_vertex && i > 0).then(|| row.room(i - 1, datum.at_kink));
    let behind = (i + 1 < row.vertices.len()).then(|| row.room(i, datum.at_kink));
    let both = before.into_iter().chain(behind);
    both.fold([f64::INFINITY; 2], |a, b| [a[0].min(b[0]), a[1].min(b[1])])
}

/// Whether the edges can be bent freely: the largest sagitta of every edge exceeds its tolerance.
fn big(row: &Row<'_>, ends: &[usize]) -> Vec<bool> {
    let n = row.vertices.len();
    let mut out = vec![false; n.saturating_sub(1)];
    for (group, axes) in row.groups.iter().enumerate().filter(|(_, axes)| !axes.is_empty()) {
        let mut bends = vec![0.0_f64; n];
        for w in ends.windows(2).filter(|w| w[1] - w[0] >= 2) {
            let own = &row.vertices[w[0]..=w[1]];
            let at: Vec<f64> = own.iter().map(|v| v.at).collect();
            let of_axis = |axis: &usize| own.iter().map(|v| v.point[*axis]).collect();
            let points: Vec<Vec<f64>> = axes.iter().map(of_axis).collect();
            let views: Vec<&[f64]> = points.iter().map(|p| &p[..]).collect();
            for (bend, own) in bends[w[0]..=w[1]].iter_mut().zip(fit::bends(&at, &views)) {
                *bend = bend.max(own);
            }
        }
        for (i, out) in out.iter_mut().enumerate() {
            let h = row.length(i);
            let sagitta = 0.125 * bends[i].max(bends[i + 1]) * h * h;
            *out |= sagitta > SAGITTA * row.chord(i).left()[group];
        }
    }
    out
}

/// The points of a row with the virtual ones.
pub(super) fn data(row: &Row<'_>, stays: &[bool]) -> Vec<Datum> {
    let n = row.vertices.len();
    let is_end = |i: &usize| *i == 0 || i + 1 == n || row.is_corner(*i);
    let ends: Vec<usize> = (0..n).filter(is_end).collect();
    let big = big(row, &ends);
    let mut corner: Vec<bool> = stays.to_vec();
    for i in ends {
        corner[i] = true;
    }
    for i in 1..n - 1 {
        let (h, k) = (row.length(i - 1), row.length(i));
        let no_longer = big[i - 1] && h < LONGER * k || big[i] && k < LONGER * h;
        corner[i] |= big[i - 1] && big[i] || no_longer;
    }
    let mut at_kink = vec![false; n];
    for i in (1..n - 1).filter(|i| row.is_kink(*i)) {
        let at = |k: usize| row.vertices[k].at;
        let zone = AROUND * fit::reach(at(i + 1) - at(i)).min(fit::reach(at(i) - at(i - 1)));
        let from = row.vertices.partition_point(|v| v.at < at(i) - zone);
        let to = row.vertices.partition_point(|v| v.at <= at(i) + zone);
        at_kink[from..to].fill(true);
    }
    let mut out = Vec::with_capacity(n);
    for i in 0..n {
        let Vertex { at, .. } = row.vertices[i];
        let kind = if corner[i] { Kind::Corner } else { Kind::Smooth };
        out.push(Datum { vertex: i, at, kind, at_kink: at_kink[i] });
        if i + 1 < n && big[i] {
            let length = row.length(i);
            let beside =
                |k: usize| (!corner[k]).then(|| row.length(if k == i { i - 1 } else { k }));
            let sides = [beside(i), beside(i + 1)];
            let at_kink = at_kink[i] || at_kink[i + 1];
            let on_edge = |(d, kind): (f64, Kind)| Datum { vertex: i, at: at + d, kind, at_kink };
            out.extend(virtual_points(length, sides).into_iter().map(on_edge));
        }
    }
    out
}

/// Positions of virtual points on an edge that follows a shorter one tangentially at its start, at its end, or both.
fn virtual_points(length: f64, shorter: [Option<f64>; 2]) -> Vec<(f64, Kind)> {
    let both = shorter.iter().all(Option::is_some);
    let side = |beside: Option<f64>| {
        let Some(beside) = beside else { return Vec::new() };
        let step = beside.max(SMALLEST_MM);
        let most = if both { 0.5 * length } else { length - 0.5 * step };
        let next = |(x, step): &(f64, f64)| {
            let step = (GROWTH * step).min(LARGEST_MM);
            Some((x + step, step))
        };
        let points = std::iter::successors(Some((step, step)), next).map(|(x, _)| x);
        points.take_while(|x| *x < most.min(ZONE_MM)).collect::<Vec<f64>>()
    };
    let [start, end] = shorter.map(side);
    let last = |x: &[f64]| x.last().copied().unwrap_or(0.0);
    let largest = shorter.iter().flatten().copied().fold(LARGEST_MM, f64::max);
    let straight = length - last(&start) - last(&end) > MIDDLE * largest;
    let kind = |i: usize, count: usize| {
        if straight && i + 1 == count { Kind::Middle } else { Kind::Virtual }
    };
    let before = start.iter().enumerate().map(|(i, x)| (*x, kind(i, start.len())));
    let behind = end.iter().enumerate().map(|(i, x)| (length - x, kind(i, end.len())));
    before.chain(behind.rev()).collect()
}
