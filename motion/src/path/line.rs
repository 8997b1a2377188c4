//! Straight line in all axes.

use crate::axis::AxisVec;

/// A straight line from start to end, `s` measured over the feed axes.
#[derive(Clone, Debug, PartialEq)]
pub struct LinePath {
    start: AxisVec,
    end: AxisVec,
    direction: AxisVec,
    /// Sum of the squares of the direction.
    norm: f64,
    length: f64,
}

/// Length of the difference `end - start` over the feed axes, or over all axes if no feed axis moves.
pub(super) fn feed_length(start: &[f64], end: &[f64], feed_axes: &[bool]) -> f64 {
    let (mut feed, mut all) = (0.0, 0.0);
    let n = start.len();
    let end = &end[..n];
    for i in 0..n {
        let square = (end[i] - start[i]) * (end[i] - start[i]);
        all += square;
        if feed_axes.get(i).copied().unwrap_or(true) {
            feed += square;
        }
    }
    if feed > 0.0 { feed.sqrt() } else { f64::sqrt(all) }
}

/// [`feed_length`] of a line along which some axis moves.
fn moving_length(start: &[f64], end: &[f64], feed_axes: &[bool]) -> Option<f64> {
    let length = feed_length(start, end, feed_axes);
    (length > 0.0).then_some(length)
}

impl LinePath {
    /// A line; `None` if no axis moves.
    pub fn new(start: AxisVec, end: AxisVec, feed_axes: &[bool]) -> Option<Self> {
        let length = moving_length(&start, &end, feed_axes)?;
        let direction = AxisVec::zeros(start.len());
        let mut line = Self { direction, start, end, norm: 0.0, length };
        line.aim();
        Some(line)
    }

    /// Turns this line into the one between other ends over the same axes; false, and unchanged, if no axis moves along
    /// that one.
    pub fn lead(&mut self, start: &[f64], end: &[f64], feed_axes: &[bool]) -> bool {
        let Some(length) = moving_length(start, end, feed_axes) else { return false };
        self.start.copy_from_slice(start);
        self.end.copy_from_slice(end);
        self.length = length;
        self.aim();
        true
    }

    /// Number of axes.
    pub(super) fn axes(&self) -> usize {
        self.start.len()
    }

    /// Sets the direction from start to end.
    fn aim(&mut self) {
        let n = self.start.len();
        let (start, end, direction) = (&self.start[..n], &self.end[..n], &mut self.direction[..n]);
        self.norm = 0.0;
        for i in 0..n {
            let share = (end[i] - start[i]) / self.length;
            direction[i] = share;
            self.norm += share * share;
        }
    }

    pub(super) fn length(&self) -> f64 {
        self.length
    }

    pub(crate) fn start(&self) -> &AxisVec {
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
            // the numbers of axes that occur have loops of known length
            match out.len() {
                2 => self.inside(s, &mut out[..2]),
                3 => self.inside(s, &mut out[..3]),
                4 => self.inside(s, &mut out[..4]),
                _ => self.inside(s, out),
            }
        }
    }

    /// As [`Self::position`], between start and end.
    #[inline]
    fn inside(&self, s: f64, out: &mut [f64]) {
        let n = out.len();
        let (start, end) = (&self.start[..n], &self.end[..n]);
        let direction = &self.direction[..n];
        for i in 0..n {
            // an axis that does not move keeps its exact bits
            let at_rest = start[i].to_bits() == end[i].to_bits();
            out[i] = if at_rest { start[i] } else { start[i] + s * direction[i] };
        }
    }

    /// The part between two path lengths.
    pub(super) fn section(&self, from: f64, to: f64) -> Self {
        let (mut start, mut end) = (self.start.clone(), self.end.clone());
        self.position(from, &mut start);
        self.position(to, &mut end);
        let direction = self.direction.clone();
        Self { start, end, direction, norm: self.norm, length: to - from }
    }

    /// Vector to `point` from the point nearest to it, and the square of its length.
    #[inline]
    pub(super) fn vector_to(&self, point: &[f64], out: &mut [f64]) -> f64 {
        // the numbers of axes that occur have loops of known length
        match point.len() {
            2 => self.away(&point[..2], &mut out[..2]),
            3 => self.away(&point[..3], &mut out[..3]),
            4 => self.away(&point[..4], &mut out[..4]),
            _ => self.away(point, out),
        }
    }

    /// As [`Self::vector_to`], where the number of axes is known to the compiler.
    #[expect(clippy::inline_always, reason = "a call would not know the number of axes")]
    #[inline(always)]
    pub(crate) fn away(&self, point: &[f64], out: &mut [f64]) -> f64 {
        let n = point.len();
        let s = self.foot(point);
        let (from, s) = if s >= self.length { (&self.end, 0.0) } else { (&self.start, s.max(0.0)) };
        let (from, direction, out) = (&from[..n], &self.direction[..n], &mut out[..n]);
        let mut square = 0.0;
        for i in 0..n {
            let away = (point[i] - from[i]) - s * direction[i];
            out[i] = away;
            square += away * away;
        }
        square
    }

    pub(super) fn nearest(&self, point: &[f64]) -> f64 {
        self.foot(point).clamp(0.0, self.length)
    }

    /// Relation of this path to another line, for distances from points of that line.
    #[inline]
    pub(crate) fn along<'a>(&'a self, line: (&'a [f64], &'a [f64])) -> Along<'a> {
        let from = self.foot(line.0);
        Along { path: self, line, from, way: self.foot(line.1) - from }
    }

    /// Foot of the perpendicular from a point on the line through start and end, in mm of path length.
    #[inline]
    fn foot(&self, point: &[f64]) -> f64 {
        let n = point.len();
        let (start, direction) = (&self.start[..n], &self.direction[..n]);
        let mut dot = 0.0;
        for i in 0..n {
            dot += (point[i] - start[i]) * direction[i];
        }
        dot / self.norm
    }
}

/// A path and another line, see [`LinePath::along`].
#[derive(Clone, Copy)]
pub(crate) struct Along<'a> {
    path: &'a LinePath,
    line: (&'a [f64], &'a [f64]),
    /// Foot of the perpendicular from the start of the line in mm of path length, and its movement along the line.
    from: f64,
    way: f64,
}

impl Along<'_> {
    /// Positions on the line, as shares of its length, at which the nearest point of the path reaches the start and the
    /// end of the path; in no particular order, and possibly outside the line.
    #[inline]
    pub(crate) fn ends(&self) -> [f64; 2] {
        [(0.0 - self.from) / self.way, (self.path.length - self.from) / self.way]
    }

    /// Coefficients of the squared distance of `from + u * (to - from)` from the path, `c[0] + c[1] u + c[2] u^2`, on
    /// the range of `u` around `at` in which the nearest point stays inside the path or at one of its ends.
    pub(crate) fn square(&self, at: f64) -> [f64; 3] {
        let ((from, to), path) = (self.line, self.path);
        let n = from.len();
        let foot = self.from + at * self.way;
        let (end, along) = if foot <= 0.0 {
            (&path.start, 0.0)
        } else if foot >= path.length {
            (&path.end, 0.0)
        } else {
            (&path.start, 1.0)
        };
        let (end, direction) = (&end[..n], &path.direction[..n]);
        let (foot, way) = (along * self.from, along * self.way);
        let mut c = [0.0; 3];
        for i in 0..n {
            let aside = (from[i] - end[i]) - foot * direction[i];
            let change = (to[i] - from[i]) - way * direction[i];
            c[0] += aside * aside;
            c[1] += 2.0 * aside * change;
            c[2] += change * change;
        }
        c
    }
}

#[cfg(test)]
mod tests {
    use super::LinePath;
    use crate::axis::AxisVec;
    use crate::path::{ArcPath, ArcShape, Path};
    use proptest::prelude::*;

    fn line(start: &[f64], end: &[f64]) -> Option<Path> {
        let [start, end] = [start, end].map(AxisVec::from_slice);
        LinePath::new(start, end, &[true, true, false]).map(Path::Line)
    }

    fn arc() -> Path {
        let [start, end] = [[1.0, 0.0], [0.0, 1.0]].map(|p| AxisVec::from_slice(&p));
        let sweep_rad = std::f64::consts::FRAC_PI_2;
        let shape = ArcShape { plane: [0, 1], centre_mm: [0.0; 2], sweep_rad };
        Path::Arc(ArcPath::new(start, end, shape, &[]).unwrap())
    }

    /// Coordinates of up to ten axes, more than a list holds without allocation; some axes do not move.
    fn ends() -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
        let axis = (-1e3..1e3f64, prop_oneof![Just(0.0), -1e2..1e2f64]);
        prop::collection::vec(axis, 1..10)
            .prop_map(|axes| axes.into_iter().map(|(from, way)| (from, from + way)).unzip())
    }

    proptest! {
        /// Whatever the path was before, it is the line that would be made anew; without motion it stays as it was.
        #[test]
        fn a_path_led_elsewhere_is_a_new_line(before in ends(), after in ends()) {
            for mut path in line(&before.0, &before.1).into_iter().chain([arc()]) {
                let unchanged = path.clone();
                let leads = path.lead(&after.0, &after.1, &[true, true, false]);
                let anew = line(&after.0, &after.1);
                prop_assert_eq!(leads, anew.is_some());
                prop_assert_eq!(format!("{path:?}"), format!("{:?}", anew.unwrap_or(unchanged)));
            }
        }

        /// No point of the line is nearer than the one from which the vector starts, and one of many is almost as near.
        #[test]
        fn the_vector_starts_at_the_nearest_point(
            (start, end) in ends(),
            aside in prop::collection::vec(-50.0..50.0f64, 10),
        ) {
            let Some(path) = line(&start, &end) else { return Ok(()) };
            let point: Vec<f64> = start.iter().zip(&aside).map(|(start, aside)| start + aside).collect();
            let mut vector = vec![0.0; point.len()];
            let square = path.vector_to(&point, &mut vector);
            prop_assert!((vector.iter().map(|v| v * v).sum::<f64>() - square).abs() <= 1e-9 * square);
            let distance = |i: u32| {
                let u = f64::from(i) / 2000.0;
                let away = |k: usize| start[k] + u * (end[k] - start[k]) - point[k];
                (0..point.len()).map(|k| away(k) * away(k)).sum::<f64>().sqrt()
            };
            let least = (0..=2000).map(distance).fold(f64::INFINITY, f64::min);
            let step = start.iter().zip(&end).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt() / 2000.0;
            prop_assert!(square.sqrt() <= least + 1e-9, "{} {least}", square.sqrt());
            prop_assert!(square.sqrt() >= least - step, "{} {least}", square.sqrt());
        }
    }
}
