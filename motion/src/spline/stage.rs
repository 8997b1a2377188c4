//! The spline of a run, block by block, with the tolerances as they are given.
//!
//! It holds a few edges in addition to those of [`super::fairing`], and the part of the [`BEHIND`] before them that it
//! needs.

use super::edge::{Corner, Curve, Edge, Part, reach};
use super::fairing::{Fairing, Out};
use super::limits::{self, Stretch};
use super::pace;
use super::polygon::ControlPolygon;
use crate::block::{Block, Feed};
use crate::contouring::{NoContour, Notice};
use crate::path::piece;
use crate::tolerance::Kernels;
use kontur_filters::time::CycleTime;
use std::collections::VecDeque;
use std::ops::Range;

/// Number of edges after the present one that influence its piece.
const AHEAD: usize = 5;
/// Rounds in which corners are judged ([`worth`]).
const ROUNDS: usize = 2;
/// Number of edges before the present one that influence its piece.
const BEHIND: usize = 3;
/// Largest share of an edge for `e`, so that the control points added at both ends stay in order. It is below a
/// quarter, where edges halved twice have the same control points.
const SHARE: f64 = 0.245;
/// Edges around a corner whose lengths differ by at most this ratio can be halved: each halving reduces the deviation
/// by at least a third. With other edges the control points would crowd at the ends of short edges.
const EVEN: f64 = 2.0;

/// Edges that determine a piece.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) edges: Range<usize>,
    /// Whether the spline begins with the first of them, and ends with the last.
    pub(super) from_start: bool,
    pub(super) to_end: bool,
}

/// See the module.
#[derive(Debug)]
pub(super) struct Stage {
    pub(super) cycle: CycleTime,
    fairing: Fairing,
    pub(super) run: VecDeque<Edge>,
    /// Number of leading edges that have their curves as if every corner of the run were rounded.
    curved: usize,
    /// Number of leading edges of which the corner at the start has been compared with its spline.
    compared: usize,
    /// Number of leading edges of which the corner has been judged, for each of the rounds after that.
    judged: [usize; ROUNDS],
    /// Number of leading edges that have been output.
    done: usize,
    /// Whether the first edge in the buffer is the first of the run.
    from_start: bool,
    /// Whether the last edge in the buffer is the last of the run.
    to_end: bool,
    /// The last part of the spline, if its end is not settled.
    held: Option<Stretch>,
    ready: Vec<Block>,
    notices: Vec<Notice>,
}

impl Stage {
    /// Holds nothing.
    pub(super) fn new(cycle: CycleTime) -> Self {
        Self {
            cycle,
            fairing: Fairing::default(),
            run: VecDeque::new(),
            curved: 0,
            compared: 0,
            judged: [0; ROUNDS],
            done: 0,
            from_start: false,
            to_end: false,
            held: None,
            ready: Vec::new(),
            notices: Vec::new(),
        }
    }

    /// Whether no block is held.
    pub(super) fn is_empty(&self) -> bool {
        self.run.is_empty() && self.fairing.is_empty()
    }

    /// Takes a block and returns the final ones. `kernels`: with any of them `ACC_FACT` applies at corners, and
    /// `AX_DEV` if it is programmed.
    pub(super) fn push<'a>(
        &'a mut self,
        block: Block,
        kernels: &Kernels,
    ) -> impl Iterator<Item = Block> + use<'a> {
        let mut fairing = std::mem::take(&mut self.fairing);
        for out in fairing.push(block) {
            self.take(out, kernels);
        }
        self.fairing = fairing;
        self.ready.drain(..)
    }

    /// Returns everything that is held, where the path stops after the last block.
    pub(super) fn flush<'a>(
        &'a mut self,
        kernels: &Kernels,
    ) -> impl Iterator<Item = Block> + use<'a> {
        let mut fairing = std::mem::take(&mut self.fairing);
        for out in fairing.flush() {
            self.take(out, kernels);
        }
        self.fairing = fairing;
        self.end_run(kernels);
        self.ready.drain(..)
    }

    /// The corners since the last call that stay sharp because the spline would take longer.
    pub(super) fn take_notices(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    fn take(&mut self, out: Out, kernels: &Kernels) {
        let mut edge = match out {
            Out::Edge(edge) => *edge,
            Out::End => {
                self.end_run(kernels);
                return;
            }
            Out::Block(block) => {
                self.ready.push(*block);
                return;
            }
        };
        if let Some(last) = self.run.back().filter(|_| edge.corner.programmed) {
            edge.corner.reach = reach(last, &edge);
        }
        self.from_start |= self.run.is_empty();
        self.settle([edge.length, edge.interval]);
        self.run.push_back(edge);
        self.advance(kernels);
    }

    /// Completes the corner at the start of the last edge, which also depends on length and interval of the next edge.
    fn settle(&mut self, [next, next_interval]: [f64; 2]) {
        let Some(at) = self.run.len().checked_sub(2) else { return };
        let (from, to) = (&self.run[at], &self.run[at + 1]);
        let (h, k) = (from.length, to.length);
        let g = if at > 0 { self.run[at - 1].length } else { h };
        let lengths = [g, h, k, next];
        let shortest = lengths.into_iter().fold(f64::INFINITY, f64::min);
        let even = lengths.iter().all(|l| *l <= EVEN * shortest);
        let fitted = from.fitted || to.fitted;
        let most = SHARE * if fitted { from.interval.min(to.interval) } else { h.min(k) };
        // a fit runs through its end at almost, but not exactly, the speed 1 of its parameter
        let speed = |edge: &Edge, inner: f64| {
            if edge.fitted { 3.0 * edge.length / (2.0 * edge.interval + inner) } else { 1.0 }
        };
        let before = if at > 0 { self.run[at - 1].interval } else { from.interval };
        let fastest = speed(from, before).max(speed(to, next_interval)).max(1.0);
        let Corner { programmed, reach, e, .. } = &mut self.run[at + 1].corner;
        if *programmed && fitted {
            *e = Some((6.0 * *reach / fastest).min(most));
        } else if reach.is_finite() {
            let exact = 6.0 * *reach;
            *e = (!even || exact < most).then_some(exact.min(most));
        }
    }

    fn end_run(&mut self, kernels: &Kernels) {
        if let Some(last) = self.run.back() {
            // mirrored at the end
            self.settle([last.length, last.interval]);
        }
        self.to_end = true;
        self.advance(kernels);
        self.run.clear();
        (self.curved, self.compared, self.judged, self.done) = (0, 0, [0; ROUNDS], 0);
        (self.from_start, self.to_end) = (false, false);
    }

    /// Outputs the edges that are decided; at the end of the run all of them.
    fn advance(&mut self, kernels: &Kernels) {
        let to_end = self.to_end;
        let decided = |ahead: usize, of: usize| if to_end { of } else { of.saturating_sub(ahead) };
        while self.curved < decided(AHEAD, self.run.len()) {
            let span = self.span(self.curved);
            self.run[self.curved].curves = self.curves(self.curved, &span);
            self.curved += 1;
        }
        while self.compared < self.curved {
            let programmed = self.compared > 0 && self.run[self.compared].corner.programmed;
            let slower = programmed && !self.is_worth(self.compared, kernels);
            let corner = &mut self.run[self.compared].corner;
            corner.slower = slower;
            corner.sharp_since = (slower && corner.e.is_some()).then_some(0);
            self.compared += 1;
        }
        let mut known = self.compared;
        for round in 1..=ROUNDS {
            for at in self.judged[round - 1]..decided(AHEAD - 1, known) {
                let Corner { slower, sharp_since, .. } = self.run[at].corner;
                if slower && sharp_since.is_none() && self.gains_as_end(at, round, kernels) {
                    self.run[at].corner.sharp_since = Some(round);
                }
                self.judged[round - 1] = at + 1;
            }
            known = self.judged[round - 1];
        }
        while self.done < decided(AHEAD - 1, self.judged[ROUNDS - 1]) {
            self.put_out();
        }
    }

    /// The edges that determine the piece of an edge if every corner is rounded.
    pub(super) fn span(&self, edge: usize) -> Span {
        let start = edge.saturating_sub(BEHIND);
        // the corner after these edges is complete
        let end = (edge + AHEAD - 1).min(self.run.len());
        Span {
            edges: start..end,
            from_start: self.from_start && start == 0,
            to_end: self.to_end && end == self.run.len(),
        }
    }

    /// The part of these edges between the sharp corners next to the edge.
    pub(super) fn between(edge: usize, span: &Span, is_sharp: impl Fn(&usize) -> bool) -> Span {
        let (start, end) = (span.edges.start, span.edges.end);
        let before = (start..=edge).rev().find(&is_sharp);
        let after = (edge + 1..end).find(&is_sharp);
        Span {
            edges: before.unwrap_or(start)..after.unwrap_or(end),
            from_start: before.is_some() || span.from_start,
            to_end: after.is_some() || span.to_end,
        }
    }

    /// Outputs the piece of the next edge.
    fn put_out(&mut self) {
        let edge = self.done;
        if self.run[edge].corner.sharp_since.is_some() {
            let seq = self.run[edge - 1].as_last().seq;
            self.notices.push(Notice { seq, reason: NoContour::Slower });
        }
        let mut curves = std::mem::take(&mut self.run[edge].curves);
        let whole = self.span(edge);
        let span = Self::between(edge, &whole, |i| self.run[*i].corner.sharp_since.is_some());
        if span != whole {
            curves = self.curves(edge, &span);
        }
        let leg = &self.run[edge];
        if curves.is_empty() {
            if let Some(last) = self.held.take() {
                last.put_out(&mut self.ready);
            }
            self.ready.extend(straight(&leg.block, &leg.parts));
        } else {
            let mut stretches = Stretch::over(leg.parts.iter().cloned(), curves);
            if let Some(mut last) = self.held.take() {
                let start = (&leg.block.path.start()[..], leg.length);
                limits::settle(&mut last, &mut stretches, start, self.cycle);
                last.put_out(&mut self.ready);
            }
            if self.run.get(edge + 1).is_some_and(|next| next.corner.moves_limit()) {
                self.held = stretches.pop();
            }
            for stretch in stretches {
                stretch.put_out(&mut self.ready);
            }
        }
        if self.run.get(edge + 1).is_some_and(|next| next.corner.sharp_since.is_some())
            && let Some(last) = self.ready.last_mut()
        {
            // nor is it rounded by contouring, which has another tolerance
            last.contour = None;
        }
        self.done += 1;
        if self.done > BEHIND {
            self.run.pop_front();
            self.from_start = false;
            let Self { curved, compared, judged, done, .. } = self;
            for count in [curved, compared, done].into_iter().chain(judged) {
                *count -= 1;
            }
        }
    }

    /// The spline over an edge: one curve, or one for each part with a different speed; none over an edge between two
    /// sharp corners.
    pub(super) fn curves(&self, edge: usize, span: &Span) -> Vec<Curve> {
        if span.from_start && span.to_end && span.edges.len() == 1 {
            return Vec::new();
        }
        let polygon = ControlPolygon::around(&self.run, edge, span);
        let Edge { block, parts, .. } = &self.run[edge];
        let mut start = if span.from_start && edge == span.edges.start {
            block.path.start().clone()
        } else {
            polygon.joint(polygon.first)
        };
        let end = if span.to_end && edge + 1 == span.edges.end {
            block.path.end().clone()
        } else {
            polygon.joint(polygon.last)
        };
        let ends = parts[..parts.len() - 1].iter().map(|part| part.until);
        let stretches = polygon.stretches(ends);
        let mut out: Vec<Curve> = Vec::with_capacity(parts.len());
        for (k, (part, pieces)) in parts.iter().zip(stretches).enumerate() {
            let Some(last) = pieces.last() else { continue };
            let here = if k + 1 < parts.len() { piece::point(last, 1.0) } else { end.clone() };
            let from = std::mem::replace(&mut start, here.clone());
            let curves = pace::curves(&part.block, pieces, [from, here], self.cycle);
            out.extend(curves.into_iter().map(|curve| Curve { part: k, ..curve }));
        }
        out
    }
}

/// The parts of a straight leg.
fn straight<'a>(leg: &'a Block, parts: &'a [Part]) -> impl Iterator<Item = Block> + 'a {
    let mut from = 0.0;
    parts.iter().filter_map(move |part| {
        let Part { block, until, share, last } = part;
        let length = leg.path.length();
        let line = leg.path.section(from * length, until * length)?;
        from = *until;
        let mut block = Block { path: line, ..block.clone() };
        if let Feed::Duration(t) = block.feed {
            block.feed = Feed::Duration(t * share);
        }
        if !last {
            (block.end_velocity_mm_s, block.contour) = (None, None);
        }
        Some(block)
    })
}
