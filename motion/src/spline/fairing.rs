//! Removes the noise from the programmed points before they become control points.
//!
//! Coordinates rounded to three decimals are up to 0.9 um off the contour that they describe. With chords of 0.05 mm
//! this turns the edges by a degree, and a spline that takes every point as exact bends there as much as at a radius of
//! a few mm. Each point is therefore moved to a smoothing spline ([`fit`]) of the points around it: by at most
//! [`SHARE`] of the tolerance and [`MOST`], and by at most twice the noise of the points around it. Points on a smooth
//! curve have no noise and stay. The displacement of a point is subtracted from the tolerance of the B-spline at the
//! corners around it: an edge between two points is nowhere further from the programmed one than they are, so the whole
//! stays within the tolerance.
//!
//! Points that stay exactly where they are: both ends of a run, of edges longer than [`LONG_MM`] and of blocks whose
//! conditions differ from those of their neighbour (a new feed rate does not count), and corners, points at which the
//! path turns by more than noise could cause. The points between two of them are smoothed as a separate row. The axes
//! of the feed group move together, the others in a second pass of the same kind. A long row is smoothed in parts of
//! [`CHUNK`] points, each with [`MARGIN`] points on either side, after which their influence on the spline has faded
//! (`e^(-MARGIN / 40)` of the room).

mod fit;
#[cfg(test)]
mod tests;

use super::edge::{Edge, corner, is_feed, turn};
use crate::axis::AxisVec;
use crate::block::Block;
use crate::block::SplineSettings;
use crate::path::{LinePath, Path};
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

/// Share of the tolerance that may be used to remove noise.
const SHARE: f64 = 0.3;
/// Largest displacement of a point in mm (deg): rounding to a ten-thousandth of an inch in three axes is 2.2 um.
const MOST: f64 = 3e-3;
/// Noise in mm (deg) below which points count as smooth: far below any rounding of coordinates, above that of the
/// arithmetic.
const LEAST: f64 = 1e-7;
/// Permitted displacement of a point as a multiple of the noise around it: a rounding step `q` shows as `q / 3`, and
/// half of it is noise.
const CERTAIN: f64 = 2.0;
/// Edges longer than this keep their ends: rounding turns them by less than a tenth of a degree.
const LONG_MM: f64 = 1.0;
/// Change of direction at a corner in rad, in addition to the effect of noise of [`GRAIN_MM`] at three points.
const CORNER_RAD: f64 = 0.35;
const GRAIN_MM: f64 = 1e-3;
/// Smallest distance that is used for two points: in a shorter one noise is the larger part.
const SHORTEST_MM: f64 = 1e-3;
/// Number of points of a long row that are output at once, of those on either side that they are smoothed with, and of
/// those in which one part blends into the next.
const CHUNK: usize = 384;
const MARGIN: usize = 384;
const SEAM: usize = 64;
/// Smallest share of its length that an edge keeps in the direction of the path.
const KEPT: f64 = 0.25;

/// A programmed point of a row.
#[derive(Debug)]
struct Vertex {
    point: AxisVec,
    /// Position on the polygon in mm.
    at: f64,
    /// Largest permitted displacement of the axes of the feed group and of the others.
    room: [f64; 2],
    /// Displacement.
    moved: AxisVec,
    /// Its length over the axes of the feed group and over the others.
    size: [f64; 2],
}

impl Vertex {
    fn new(point: &AxisVec, at: f64) -> Self {
        Self {
            point: point.clone(),
            at,
            room: [0.0; 2],
            moved: AxisVec::zeros(point.len()),
            size: [0.0; 2],
        }
    }
}

/// The fairing stage. It holds at most [`CHUNK`] + [`MARGIN`] blocks of a row, and [`MARGIN`] points before them.
#[derive(Debug, Default)]
pub(super) struct Fairing {
    /// Edges of the row that have not been output.
    edges: VecDeque<Edge>,
    /// Points of the row: those of the edges, and final ones before them.
    row: VecDeque<Vertex>,
    /// Displacement of the last point before the row.
    before: [f64; 2],
    ready: Vec<Block>,
}

impl Fairing {
    /// Whether no block is held.
    pub(super) fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// Takes a block and returns the final ones.
    pub(super) fn push(&mut self, block: Block) -> std::vec::Drain<'_, Block> {
        match Edge::new(&block) {
            None => {
                self.end_run();
                self.ready.push(block);
            }
            Some(edge) => self.take(edge),
        }
        self.ready.drain(..)
    }

    /// Returns everything that is held, where the path stops after the last block.
    pub(super) fn flush(&mut self) -> std::vec::Drain<'_, Block> {
        self.end_run();
        self.ready.drain(..)
    }

    fn end_run(&mut self) {
        self.end_row();
        self.before = [0.0; 2];
    }

    fn take(&mut self, edge: Edge) {
        if self.edges.back().is_some_and(|last| stays(last, &edge)) {
            self.end_row();
        }
        let mut at = 0.0;
        if let (Some(last), Some(vertex)) = (self.edges.back(), self.row.back_mut()) {
            vertex.room = room(last, &edge);
            at = vertex.at;
        } else {
            self.row.push_back(Vertex::new(edge.block.path.start(), at));
        }
        at += edge.length.max(SHORTEST_MM);
        self.row.push_back(Vertex::new(edge.block.path.end(), at));
        self.edges.push_back(edge);
        if self.edges.len() >= CHUNK + MARGIN {
            self.put_out(CHUNK);
        }
    }

    /// Ends a row; its last point stays where it is.
    fn end_row(&mut self) {
        self.put_out(self.edges.len());
        let n = self.row.len();
        if n >= 2 {
            self.before = self.row[n - 2].size;
        }
        self.row.clear();
    }

    /// Outputs the first edges of the row.
    fn put_out(&mut self, count: usize) {
        if self.edges.is_empty() {
            return;
        }
        let first = self.row.len() - 1 - self.edges.len();
        self.settle(first..first + count + 1);
        for at in first..first + count {
            let Some(mut edge) = self.edges.pop_front() else { break };
            let (from, to) = (&self.row[at], &self.row[at + 1]);
            let before = if at > 0 { self.row[at - 1].size } else { self.before };
            edge.block.spline = Some(what_is_left(&edge, [before, from.size, to.size]));
            if [from, to].iter().any(|v| v.size.iter().any(|s| *s > 0.0)) {
                let [start, end] = [from, to].map(moved);
                if let Some(line) = LinePath::new(start, end, &edge.block.dynamics.feed_axes) {
                    edge.block.path = Path::Line(line);
                }
            }
            self.ready.push(edge.block);
        }
        let last = self.row.len() - 1 - self.edges.len();
        self.row.drain(..last.saturating_sub(MARGIN));
    }

    /// Moves points of the row, the first of which has been moved already.
    fn settle(&mut self, points: Range<usize>) {
        let Some(edge) = self.edges.front() else { return };
        let feed = |i: &usize| is_feed(&edge.block, *i);
        let groups: (Vec<usize>, Vec<usize>) = (0..edge.direction.len()).partition(feed);
        let groups = [groups.0, groups.1];
        let programmed: Vec<f64> = self.row.iter().map(|v| v.at).collect();
        let mut knots = programmed.clone();
        for (group, axes) in groups.iter().enumerate() {
            let of_axis = |i: &usize| self.row.iter().map(|v| v.point[*i]).collect();
            let coordinates: Vec<Vec<f64>> = axes.iter().map(of_axis).collect();
            let noise = fit::roughness(&programmed, &coordinates);
            let rooms = self.row.iter().zip(noise).map(|(v, noise)| {
                let room = v.room[group].min(CERTAIN * noise);
                if room > LEAST { room } else { 0.0 }
            });
            let rooms: Vec<f64> = rooms.collect();
            if group == 0 {
                evened(&mut knots, &rooms);
            }
            let mut ways = fit::displacements(&knots, &coordinates, &rooms, fit::PATH);
            if group == 0 {
                keep_order(&coordinates, &mut ways);
            }
            self.move_points(group, axes, &points, &ways);
        }
    }

    /// Displaces points of the row along one group of axes.
    fn move_points(
        &mut self,
        group: usize,
        axes: &[usize],
        points: &Range<usize>,
        ways: &[Vec<f64>],
    ) {
        // the first points also have a displacement from the previous part, and those after the last one get one from
        // this part
        let seam = if points.start > 0 { SEAM } else { 0 };
        let until = (points.end + SEAM).min(self.row.len());
        for i in points.start + 1..until {
            let vertex = &mut self.row[i];
            let new = ((i - points.start) as f64 / (seam + 1) as f64).min(1.0);
            let new = new * new * (3.0 - 2.0 * new);
            for (axis, way) in axes.iter().zip(ways) {
                let moved = &mut vertex.moved[*axis];
                *moved += new * (way[i] - *moved);
            }
            vertex.size[group] = axes
                .iter()
                .map(|axis| vertex.moved[*axis] * vertex.moved[*axis])
                .sum::<f64>()
                .sqrt();
        }
    }
}

/// Evens out the distances between points within their noise, which is as large along the path as across. A spline
/// through unevenly spaced points has an uneven curvature, however well they are placed on the curve.
fn evened(knots: &mut [f64], rooms: &[f64]) {
    let numbers: Vec<f64> = (0..knots.len()).map(|i| i as f64).collect();
    let step = |i: usize| if i > 0 { knots[i] - knots[i - 1] } else { 0.0 };
    let mut rooms = rooms.to_vec();
    for (i, room) in rooms.iter_mut().enumerate() {
        let next = if i + 1 < knots.len() { step(i + 1) } else { 0.0 };
        *room = room.min(KEPT * step(i).min(next));
    }
    let ways = fit::displacements(&numbers, &[knots.to_vec()], &rooms, fit::STEPS);
    for (knot, way) in knots.iter_mut().zip(ways.iter().flatten()) {
        *knot += way;
    }
}

/// The point after its displacement.
fn moved(v: &Vertex) -> AxisVec {
    v.point.iter().zip(v.moved.iter()).map(|(p, d)| p + d).collect()
}

/// Whether the point between two edges stays where it is.
fn stays(a: &Edge, b: &Edge) -> bool {
    let (p, q) = (&a.block, &b.block);
    let same = Arc::ptr_eq(&p.dynamics, &q.dynamics) || p.dynamics == q.dynamics;
    let same = same
        && p.spline == q.spline
        && p.slope == q.slope
        && p.tolerance == q.tolerance
        && p.contour == q.contour
        && p.full_override == q.full_override
        && p.late_braking == q.late_braking
        && p.end_velocity_mm_s.is_none()
        && std::mem::discriminant(&p.feed) == std::mem::discriminant(&q.feed);
    let noise_rad = 2.0 * GRAIN_MM * (a.length.recip() + b.length.recip());
    !same
        || a.length.max(b.length) > LONG_MM
        || corner(a, b).is_none()
        || turn(a, b).angle_rad > CORNER_RAD + noise_rad
}

/// Permitted displacement of the point between two edges, regardless of the noise.
fn room(a: &Edge, b: &Edge) -> [f64; 2] {
    let SplineSettings { path_dev_mm, track_dev_deg, .. } = b.settings;
    let most = |dev: f64| if dev > 0.0 { MOST.min(SHARE * dev) } else { MOST };
    // along the path the other axes follow the feed group
    let follow =
        if track_dev_deg > 0.0 { most(track_dev_deg) / pace(a).max(pace(b)) } else { MOST };
    [most(path_dev_mm).min(follow), most(track_dev_deg)]
}

/// Movement of the fastest axis outside the feed group per mm of path.
fn pace(edge: &Edge) -> f64 {
    let axes = edge.direction.iter().enumerate().filter(|(i, _)| !is_feed(&edge.block, *i));
    axes.map(|(_, u)| u.abs()).fold(0.0, f64::max)
}

/// The tolerances that remain after the displacements of the points around the corner at the start of an edge.
fn what_is_left(edge: &Edge, sizes: [[f64; 2]; 3]) -> SplineSettings {
    let largest = |group: usize| sizes.iter().map(|s| s[group]).fold(0.0, f64::max);
    let settings = edge.settings;
    let left = |dev: f64, taken: f64| if dev > 0.0 { dev - taken } else { dev };
    SplineSettings {
        path_dev_mm: left(settings.path_dev_mm, largest(0)),
        track_dev_deg: left(settings.track_dev_deg, largest(1) + largest(0) * pace(edge)),
        ..settings
    }
}

/// Revokes the displacements of both ends of an edge that would vanish or reverse: for the shortest edges they are a
/// large part of the length.
fn keep_order(points: &[Vec<f64>], ways: &mut [Vec<f64>]) {
    let count = points.first().map_or(0, Vec::len);
    let mut i = 0;
    while i + 1 < count {
        let (before, behind) = (i.saturating_sub(1), (i + 2).min(count - 1));
        let (mut along, mut chord2, mut length2) = (0.0, 0.0, 0.0);
        for (p, d) in points.iter().zip(ways.iter()) {
            let (old, chord) = (p[i + 1] - p[i], p[behind] - p[before]);
            along += (old + d[i + 1] - d[i]) * chord;
            chord2 += chord * chord;
            length2 += old * old;
        }
        let moves = fit::size(ways, i) > 0.0 || fit::size(ways, i + 1) > 0.0;
        if moves && along < KEPT * (chord2 * length2).sqrt() {
            for d in ways.iter_mut() {
                (d[i], d[i + 1]) = (0.0, 0.0);
            }
            // the edge before it has changed
            i = before;
        } else {
            i += 1;
        }
    }
}
