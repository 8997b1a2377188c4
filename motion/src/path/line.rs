//! Straight line in all axes.

use crate::axis::AxisVec;

/// A straight line from start to end, `s` measured over the feed axes.
#[derive(Clone, Debug, PartialEq)]
pub struct LinePath {
    start: AxisVec,
    end: AxisVec,
    direction: AxisVec,
    length: f64,
}

/// Length of the difference `end - start` over the feed axes, or over all axes if no feed axis moves.
pub(super) fn feed_length(start: &[f64], end: &[f64], feed_axes: &[bool]) -> f64 {
    let sum = |only_feed: bool| -> f64 {
        start
            .iter()
            .zip(end)
            .enumerate()
            .filter(|(i, _)| !only_feed || feed_axes.get(*i).copied().unwrap_or(true))
            .map(|(_, (a, b))| (b - a) * (b - a))
            .sum()
    };
    let feed = sum(true);
    if feed > 0.0 { feed.sqrt() } else { sum(false).sqrt() }
}

impl LinePath {
    /// A line; `None` if no axis moves.
    pub fn new(start: AxisVec, end: AxisVec, feed_axes: &[bool]) -> Option<Self> {
        let length = feed_length(&start, &end, feed_axes);
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let mut direction = end.clone();
        for (d, a) in direction.iter_mut().zip(start.iter()) {
            *d = (*d - a) / length;
        }
        Some(Self { start, end, direction, length })
    }

    pub(super) fn length(&self) -> f64 {
        self.length
    }

    pub(super) fn start(&self) -> &AxisVec {
        &self.start
    }

    pub(super) fn end(&self) -> &AxisVec {
        &self.end
    }

    /// `dq/ds` of every axis, constant over the line.
    pub fn direction(&self) -> &AxisVec {
        &self.direction
    }

    pub(super) fn position(&self, s: f64, out: &mut [f64]) {
        if s <= 0.0 {
            out.copy_from_slice(&self.start);
        } else if s >= self.length {
            out.copy_from_slice(&self.end);
        } else {
            for (i, o) in out.iter_mut().enumerate() {
                // an axis that does not move keeps its exact bits
                *o = if self.start[i].to_bits() == self.end[i].to_bits() {
                    self.start[i]
                } else {
                    self.start[i] + s * self.direction[i]
                };
            }
        }
    }

    /// The part between two path lengths.
    pub(super) fn section(&self, from: f64, to: f64) -> Self {
        let (mut start, mut end) = (self.start.clone(), self.end.clone());
        self.position(from, &mut start);
        self.position(to, &mut end);
        Self { start, end, direction: self.direction.clone(), length: to - from }
    }

    pub(super) fn nearest(&self, point: &[f64]) -> f64 {
        let (mut dot, mut norm) = (0.0, 0.0);
        for ((p, a), d) in point.iter().zip(self.start.iter()).zip(self.direction.iter()) {
            dot += (p - a) * d;
            norm += d * d;
        }
        (dot / norm).clamp(0.0, self.length)
    }
}
