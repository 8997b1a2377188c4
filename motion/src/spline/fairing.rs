//! From the programmed points to the control points of the spline.
//!
//! Programmed points as control points give a fair curve only if they are evenly spaced and exact. The control point of
//! a smooth curve is its blossom at three neighbouring knots: it differs from the point of the curve by terms that
//! depend on both chords, in nanometres, but a third derivative sees them. Coordinates rounded to three decimals are up
//! to 0.9 um off the contour that they describe. The control points are therefore fitted ([`fit`]) to the points, over
//! knots that are evened out ([`knots`]). Points that are no further apart than a share of the tolerance are passed
//! over. Which points stay control points is decided in [`build`]; for everything else the deviation is certified edge
//! by edge ([`certificate`]).
//!
//! The axes of the feed group and the others are fitted over the same knots, with a tolerance for each.
//!
//! Knots and blocks are independent: the part of a block is the spline over its own stretch of the polygon.
//!
//! A long run is fitted in windows of [`CHUNK`] points, each with [`MARGIN`] points on either side, after which their
//! influence has faded (less than 10 nm, and 0.2 % of the speed, for chords of 0.02 mm with three decimals). Windows meet
//! at a corner, or one blends into the next over [`SEAM`] control points. Where the deviation of the seam cannot be
//! certified, the control points of the earlier window are used up to its end, which is a programmed point.

mod build;
mod certificate;
mod data;
mod fit;
mod knots;
mod row;
#[cfg(test)]
mod tests;

use super::edge::{Edge, Part, ends_at, programmed, stops_between};
use super::node::Node;
use crate::axis::AxisVec;
use crate::block::{Block, SplineSettings};
use build::built;
use row::{Chord, Groups, Row, Vertex, apart, groups, rooms, tighter};
use smallvec::SmallVec;
use std::collections::VecDeque;

/// Number of points of a long run that are output at once, of those on either side that they are fitted with, and of
/// those in which one window blends into the next.
const CHUNK: usize = 192;
const MARGIN: usize = 192;
const SEAM: usize = 32;
/// Largest number of points in a row that are passed over.
const PASSED: usize = 16;
/// The end of a block this close to a knot moves there, as a share of the knot interval and in mm: evened knots of almost
/// equal chords hardly differ from their ends, and a block is then one polynomial.
const NEAR: f64 = 0.05;
const NEAR_MM: f64 = 1e-3;

/// What the stage outputs.
#[derive(Debug)]
pub(super) enum Out {
    /// A leg of the control polygon of the spline.
    Edge(Box<Edge>),
    /// The spline ends.
    End,
    /// A block outside of splines.
    Block(Box<Block>),
}

/// A block of the run with its stretch of the polygon.
#[derive(Debug)]
struct Stretch {
    block: Block,
    from: f64,
    until: f64,
    /// Share of it that has been output.
    given: f64,
}

/// A block that ends at a point that is passed over.
#[derive(Debug)]
struct Passed {
    block: Block,
    off: [f64; 2],
}

/// The stage. It holds at most [`CHUNK`] + [`MARGIN`] points of a run, and [`MARGIN`] points before them.
#[derive(Debug, Default)]
pub(super) struct Fairing {
    vertices: Vec<Vertex>,
    groups: Groups,
    /// The first point with a control point that has not been output, except for the one there.
    first: usize,
    /// Blocks after the last point.
    passed: Vec<Passed>,
    /// Blocks of the run that have not been output completely.
    stretches: VecDeque<Stretch>,
    /// The control points of the previous window from a few before `first` on, if it has to blend into the next one; and
    /// the number of the one at `first`.
    before: (Vec<Node>, usize),
    /// The last control point that has been output.
    last: Option<Node>,
    ready: Vec<Out>,
}

impl Fairing {
    /// Whether no block is held.
    pub(super) fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// Takes a block and returns what is final.
    pub(super) fn push(&mut self, block: Block) -> std::vec::Drain<'_, Out> {
        if programmed(&block).is_none() {
            self.end_run();
            self.ready.push(Out::Block(Box::new(block)));
        } else {
            self.take(block);
        }
        self.ready.drain(..)
    }

    /// Returns everything that is held, where the path stops after the last block.
    pub(super) fn flush(&mut self) -> std::vec::Drain<'_, Out> {
        self.end_run();
        self.ready.drain(..)
    }

    fn take(&mut self, block: Block) {
        let last = self.passed.last().map(|p| &p.block).or(self.stretches.back().map(|s| &s.block));
        if last.is_some_and(|last| stops_between(last, &block)) {
            self.end_run();
        }
        if self.vertices.is_empty() {
            self.groups = groups(&block);
            self.start(block.path.start().clone());
        }
        let Some(kept) = self.vertices.last() else { return };
        let off = self.distance(&kept.point, block.path.end());
        let room = block.spline.map_or([0.0; 2], |settings| rooms(&settings));
        if off[0] <= room[0] && off[1] <= room[1] && self.passed.len() < PASSED {
            self.passed.push(Passed { block, off });
            return;
        }
        self.keep(block);
    }

    fn start(&mut self, point: AxisVec) {
        let chord = Chord { settings: SplineSettings::default(), off: [0.0; 2] };
        self.vertices.push(Vertex { point, at: 0.0, chord, stays: true });
    }

    fn distance(&self, p: &[f64], q: &[f64]) -> [f64; 2] {
        [apart(p, q, &self.groups[0]), apart(p, q, &self.groups[1])]
    }

    /// Keeps the end of a block as a point of the run.
    fn keep(&mut self, block: Block) {
        let Some(kept) = self.vertices.last() else { return };
        let length = apart(&kept.point, block.path.end(), &self.groups[0]);
        let is_close = |chord: Chord| {
            let room = rooms(&chord.settings);
            chord.off[0] <= room[0] && chord.off[1] <= room[1]
        };
        // the feed axes may have returned to the point, or the tolerance may have changed
        if length < 0.1 * block.path.length() || !self.chord(&block).is_some_and(is_close) {
            self.keep_passed();
        }
        let Some(chord) = self.chord(&block) else { return };
        if let [.., before, kept] = &self.vertices[..]
            && ends_at([&before.point, &kept.point, block.path.end()], &block, &chord.settings)
        {
            let point = kept.point.clone();
            let passed = std::mem::take(&mut self.passed);
            self.end_run();
            self.passed = passed;
            self.groups = groups(&block);
            self.start(point);
        }
        self.push_vertex(block, chord);
        if self.vertices.len() > self.first + CHUNK + MARGIN {
            self.put_out(false);
        }
    }

    fn push_vertex(&mut self, block: Block, mut chord: Chord) {
        let Some(kept) = self.vertices.last() else { return };
        let point = block.path.end().clone();
        let (from, length) = (kept.at, apart(&kept.point, &point, &self.groups[0]));
        let count = self.passed.len();
        let taken = chord.off[0].min(0.5 * length);
        let mut last = from;
        for (k, passed) in self.passed.drain(..).enumerate() {
            let until = from + taken * (k + 1) as f64 / count as f64;
            self.stretches.push_back(Stretch {
                block: passed.block,
                from: last,
                until,
                given: 0.0,
            });
            last = until;
        }
        if count > 1 {
            // their stretches are as far from the point as they are themselves, to any side
            chord.off = chord.off.map(|off| 2.0 * off);
        }
        let until = from + length;
        self.stretches.push_back(Stretch { block, from: last, until, given: 0.0 });
        self.vertices.push(Vertex { point, at: until, chord, stays: false });
    }

    /// Keeps the points that would be passed over.
    fn keep_passed(&mut self) {
        for Passed { block, .. } in std::mem::take(&mut self.passed) {
            self.keep(block);
        }
    }

    /// The edge from the last point to the end of a block.
    fn chord(&self, block: &Block) -> Option<Chord> {
        let mut chord = Chord { settings: block.spline?, off: [0.0; 2] };
        for passed in &self.passed {
            chord.settings = tighter(passed.block.spline?, &chord.settings);
            chord.off = std::array::from_fn(|k| chord.off[k].max(passed.off[k]));
        }
        Some(chord)
    }

    /// Ends the run at the last programmed point.
    fn end_run(&mut self) {
        if let Some(Passed { block, .. }) = self.passed.pop() {
            self.end_at(block);
        }
        if self.vertices.len() > 1 {
            self.put_out(true);
        }
        if !self.vertices.is_empty() {
            self.ready.push(Out::End);
        }
        self.vertices.clear();
        self.stretches.clear();
        self.first = 0;
        self.before = (Vec::new(), 0);
        self.last = None;
    }

    /// Ends the run with a block that is so short that its end would be passed over: instead, the last kept point is.
    fn end_at(&mut self, block: Block) {
        let end = block.path.end().clone();
        let (Some(kept), Some(chord)) = (self.vertices.pop(), self.chord(&block)) else { return };
        let Some(before) = self.vertices.last() else {
            // nothing but such blocks
            let passed = self.passed.drain(..).map(|p| p.block).chain([block]);
            self.ready.extend(passed.map(Box::new).map(Out::Block));
            return;
        };
        let start = before.at;
        let (old, new) = (kept.at - start, apart(&before.point, &end, &self.groups[0]));
        if new < 0.5 * old {
            self.vertices.push(kept);
            self.keep_passed();
            self.keep(block);
            return;
        }
        let shifted = self.distance(&kept.point, &end);
        let settings = tighter(kept.chord.settings, &chord.settings);
        let off = |k: usize| kept.chord.off[k].max(shifted[k] + chord.off[k]);
        let chord = Chord { settings, off: std::array::from_fn(off) };
        let taken = chord.off[0].min(0.5 * new);
        let scale = (new - taken) / old;
        for stretch in self.stretches.iter_mut().rev().take_while(|s| s.from >= start) {
            stretch.from = start + scale * (stretch.from - start);
            stretch.until = start + scale * (stretch.until - start);
        }
        let mut from = self.stretches.back().map_or(start, |s| s.until);
        let count = self.passed.len() + 1;
        let blocks = self.passed.drain(..).map(|p| p.block).chain([block]);
        for (k, block) in blocks.enumerate() {
            let until = start + new - taken * (count - k - 1) as f64 / count as f64;
            self.stretches.push_back(Stretch { block, from, until, given: 0.0 });
            from = until;
        }
        self.vertices.push(Vertex { point: end, at: start + new, chord, stays: false });
    }

    /// Outputs the control points of the next points, or of all.
    fn put_out(&mut self, to_end: bool) {
        while self.first + 1 < self.vertices.len() {
            let row = Row { vertices: &self.vertices, groups: &self.groups };
            let window = built(&row);
            let (before, cut) = std::mem::take(&mut self.before);
            let mut whole = to_end;
            let (nodes, start) = if before.is_empty() {
                let start = window.nodes.iter().position(|n| n.place == (self.first, 0));
                (window.nodes, start.unwrap_or(0))
            } else if let Some(blended) = window.blended(&row, &before, (cut, self.first), SEAM) {
                blended
            } else {
                whole = true;
                (before, cut)
            };
            let (end, smooth) = if whole { (nodes.len() - 1, false) } else { self.cut(&nodes) };
            for pair in nodes[start..=end].windows(2) {
                self.put_out_leg(&pair[0], &pair[1]);
            }
            self.first = nodes[end].place.0;
            if smooth {
                self.before = (nodes, end);
            } else {
                self.vertices[self.first].stays = true;
            }
            self.forget();
            if !to_end {
                break;
            }
        }
    }

    /// The control point at which a window ends, and whether the next one blends into it there.
    fn cut(&self, nodes: &[Node]) -> (usize, bool) {
        let ends = self.first + CHUNK / 2..=self.first + CHUNK;
        let corner = nodes.iter().rposition(|n| n.is_corner && ends.contains(&n.place.0));
        let at = nodes.iter().position(|n| n.place == (self.first + CHUNK, 0));
        match (corner, at) {
            (Some(corner), _) => (corner, false),
            (None, Some(at)) => (at, !nodes[at].is_corner),
            (None, None) => (nodes.len() - 1, false),
        }
    }

    /// Drops the points that the next window does not need, and counts points and distances from there.
    fn forget(&mut self) {
        let count = self.first.saturating_sub(MARGIN);
        let start = self.vertices[count].at;
        self.vertices.drain(..count);
        self.first -= count;
        for vertex in &mut self.vertices {
            vertex.at -= start;
        }
        for stretch in &mut self.stretches {
            stretch.from -= start;
            stretch.until -= start;
        }
        let (nodes, cut) = &mut self.before;
        let old = cut.saturating_sub(build::BEHIND);
        nodes.drain(..old);
        *cut -= old;
        for node in nodes.iter_mut().chain(&mut self.last) {
            node.knot -= start;
            node.place.0 = node.place.0.saturating_sub(count);
        }
    }

    /// Outputs a leg of the control polygon with the parts of the blocks along it.
    fn put_out_leg(&mut self, from: &Node, to: &Node) {
        let interval = to.knot - from.knot;
        let near = NEAR_MM.min(NEAR * interval);
        let mut parts: SmallVec<[Part; 2]> = SmallVec::new();
        let mut at = from.knot;
        loop {
            let next = self.stretches.get(1).map(|next| next.until);
            let front = self.stretches.front_mut().filter(|_| at < to.knot);
            let Some(stretch) = front else { break };
            let until = stretch.until;
            // a block that ends close to a knot ends there, unless the next one would vanish
            let is_near = (until - to.knot).abs() <= near;
            let snaps = is_near && next.is_none_or(|n| n - to.knot > 0.5 * (n - until));
            let last = until <= to.knot || snaps;
            let end = if snaps { to.knot } else { until.min(to.knot) };
            let share =
                if last { 1.0 - stretch.given } else { (end - at) / (until - stretch.from) };
            stretch.given += share;
            let block = stretch.block.clone();
            parts.push(Part { block, until: (end - from.knot) / interval, share, last });
            at = end;
            if last {
                self.stretches.pop_front();
            }
        }
        let of_last = self.last.as_ref().map_or([0.0; 2], |last| last.off);
        let off = std::array::from_fn(|k| of_last[k].max(from.off[k]));
        let settings = self.left(from, off);
        self.ready.extend(Edge::new(from, to, parts, settings).map(Box::new).map(Out::Edge));
        self.last = Some(to.clone());
    }

    /// The settings of the corner at a control point, with what the spline may still deviate there.
    fn left(&self, corner: &Node, off: [f64; 2]) -> SplineSettings {
        let i = corner.place.0;
        let behind = self.vertices.get(i + 1).map(|v| v.chord);
        let before = if i > 0 { self.vertices.get(i).map(|v| v.chord) } else { None };
        let mut chords = before.into_iter().chain(behind);
        let Some(first) = chords.next() else { return SplineSettings::default() };
        let own = chords.fold(first, |a, b| Chord {
            settings: tighter(a.settings, &b.settings),
            off: std::array::from_fn(|k| a.off[k].max(b.off[k])),
        });
        let left = |dev: f64, k: usize| {
            if dev > 0.0 { (dev - own.off[k] - off[k]).max(f64::MIN_POSITIVE) } else { dev }
        };
        SplineSettings {
            path_dev_mm: left(own.settings.path_dev_mm, 0),
            track_dev_deg: left(own.settings.track_dev_deg, 1),
            ..own.settings
        }
    }
}
