//! The set path: filtered set points joined by straight lines.

use crate::axis::AxisVec;
use std::ops::Range;

/// Set points of consecutive cycles.
#[derive(Clone, Debug, Default)]
pub(crate) struct SetPath {
    axes: usize,
    first: u64,
    /// The cycle after the last one.
    end: u64,
    /// Coordinates of all axes, cycle after cycle.
    values: Vec<f64>,
    /// Length of the set path in mm at each set point that is measured, from some point before the first.
    ways: Vec<f64>,
}

impl SetPath {
    /// Without set points; the next one is that of cycle `first`.
    pub(crate) fn starting(first: u64, axes: usize) -> Self {
        Self { axes, first, end: first, values: Vec::new(), ways: Vec::new() }
    }

    /// Without set points, with memory for those of the cycles `first..=last`.
    pub(crate) fn of((first, last): (u64, u64), axes: usize) -> Self {
        let count = (last + 1).saturating_sub(first) as usize;
        let (values, ways) = (Vec::with_capacity(count * axes), Vec::with_capacity(count));
        Self { axes, first, end: first, values, ways }
    }

    /// Restarts with the set point of cycle `k` only.
    pub(super) fn restart(&mut self, k: u64, point: &[f64]) {
        (self.axes, self.first, self.end) = (point.len(), k, k);
        self.values.clear();
        self.ways.clear();
        self.push(point);
    }

    pub(crate) fn axes(&self) -> usize {
        self.axes
    }

    /// Adds the set point of the next cycle.
    pub(crate) fn push(&mut self, point: &[f64]) {
        debug_assert_eq!(
            self.first + self.ways.len() as u64,
            self.end,
            "the way up to it is known"
        );
        let way = self.ways.last().map_or(0.0, |way| {
            way + distance(&self.values[self.values.len() - point.len()..], point)
        });
        self.ways.push(way);
        self.append(point);
    }

    /// As [`Self::push`], but what needs lengths requires [`Self::measure`] first.
    pub(super) fn append(&mut self, point: &[f64]) {
        self.values.extend_from_slice(point);
        self.end += 1;
    }

    /// Measures the set path up to the last set point.
    pub(super) fn measure(&mut self) {
        let known = self.first + self.ways.len() as u64;
        for k in known..self.end {
            let way = k.checked_sub(1).and_then(|before| self.line(before).zip(self.ways.last()));
            self.ways.push(way.map_or(0.0, |((a, b), way)| way + distance(a, b)));
        }
    }

    /// The cycle of the first set point.
    pub(super) fn first(&self) -> u64 {
        self.first
    }

    /// Length of the set path in mm up to the set point of cycle `k`, measured from some point before the first.
    pub(super) fn way(&self, k: u64) -> f64 {
        self.ways[(k - self.first) as usize]
    }

    /// The first of some lines, given by the cycles at which they begin, whose end lies not less than `mm` along the set
    /// path; the cycle after them if there is none. Fast if it is one of the first.
    pub(super) fn first_beyond(&self, mm: f64, (from, end): (u64, u64)) -> u64 {
        let ways = &self.ways[(from + 1 - self.first) as usize..][..(end - from) as usize];
        from + leading(ways.len(), |i| ways[i] < mm) as u64
    }

    /// The cycle after the last of some lines, as in [`Self::first_beyond`], that begins not more than `mm` along the
    /// set path; the first one if there is none. Fast if it is one of the last.
    pub(super) fn last_before(&self, mm: f64, (from, end): (u64, u64)) -> u64 {
        let ways = &self.ways[(from - self.first) as usize..][..(end - from) as usize];
        let last = ways.len();
        end - leading(last, |i| ways[last - 1 - i] > mm) as u64
    }

    /// The cycle after the last one.
    pub(crate) fn end(&self) -> u64 {
        self.end
    }

    /// Forgets the set points before cycle `k`; not in every call.
    pub(crate) fn forget_before(&mut self, k: u64) {
        let count = (self.end - self.first) as usize;
        let old = (k.saturating_sub(self.first) as usize).min(count);
        if 2 * old > count {
            self.values.drain(..old * self.axes);
            self.ways.drain(..old.min(self.ways.len()));
            self.first += old as u64;
        }
    }

    pub(crate) fn get(&self, k: u64) -> Option<&[f64]> {
        let at = k.checked_sub(self.first)? as usize * self.axes;
        self.values.get(at..at + self.axes)
    }

    /// Distance in mm of a point from the line that ends at the set point of cycle `k`.
    pub(crate) fn distance(&self, k: u64, point: &[f64]) -> f64 {
        self.to_line(k.saturating_sub(1), point).0.sqrt()
    }

    /// Largest distance in mm of the set points of some cycles from the line through two points.
    pub(crate) fn bulge(&self, cycles: Range<u64>, from: &[f64], to: &[f64]) -> f64 {
        let n = self.axes;
        let (from, to) = (&from[..n], &to[..n]);
        let mut square = 0.0;
        for i in 0..n {
            square += (to[i] - from[i]) * (to[i] - from[i]);
        }
        let mut largest = 0.0_f64;
        for point in cycles.filter_map(|k| self.get(k)) {
            let point = &point[..n];
            let (mut part, mut whole) = (0.0, 0.0);
            for i in 0..n {
                let off = point[i] - from[i];
                part += off * (to[i] - from[i]);
                whole += off * off;
            }
            let on_line = if square > 0.0 { part * part / square } else { 0.0 };
            largest = largest.max(whole - on_line);
        }
        largest.sqrt()
    }

    /// Sum of the angles in rad between the lines that end at the set points of some cycles; those known so far.
    pub(crate) fn turn(&self, cycles: Range<u64>) -> f64 {
        let n = self.axes;
        let mut before: Option<AxisVec> = None;
        let mut sum = 0.0;
        for k in cycles {
            let (Some(from), Some(to)) = (k.checked_sub(1).and_then(|k| self.get(k)), self.get(k))
            else {
                continue;
            };
            let mut along = AxisVec::zeros(n);
            let mut square = 0.0;
            for i in 0..n {
                along[i] = to[i] - from[i];
                square += along[i] * along[i];
            }
            if square > 0.0 {
                let scale = 1.0 / f64::sqrt(square);
                along.iter_mut().for_each(|c| *c *= scale);
                if let Some(before) = &before {
                    // the chord of the angle
                    let chord = along
                        .iter()
                        .zip(before.iter())
                        .map(|(a, b)| (a - b) * (a - b))
                        .sum::<f64>();
                    sum += 2.0 * libm::asin((0.5 * chord.sqrt()).min(1.0));
                }
                before = Some(along);
            }
        }
        sum
    }

    /// The shortest vector from a point to the lines between all set points.
    pub(crate) fn shortest(&self, point: &[f64]) -> AxisVec {
        let lines = self.first..self.end().saturating_sub(1);
        let nearest =
            lines.min_by(|a, b| self.to_line(*a, point).0.total_cmp(&self.to_line(*b, point).0));
        let mut vector = AxisVec::zeros(self.axes);
        if let Some(k) = nearest {
            self.aside(k, point, &mut vector);
        }
        vector
    }

    /// Square of the distance in mm2 of a point from the line between cycle `k` and cycle `k + 1`, and the position on
    /// the line.
    pub(super) fn to_line(&self, k: u64, point: &[f64]) -> (f64, f64) {
        let Some((a, b)) = self.line(k) else { return (f64::INFINITY, 0.0) };
        // the numbers of axes that occur have loops of known length
        match point.len() {
            2 => foot(&a[..2], &b[..2], &point[..2]),
            3 => foot(&a[..3], &b[..3], &point[..3]),
            4 => foot(&a[..4], &b[..4], &point[..4]),
            _ => foot(a, b, point),
        }
    }

    /// The shortest vector from a point to the line between cycle `k` and cycle `k + 1`.
    pub(super) fn aside(&self, k: u64, point: &[f64], vector: &mut [f64]) {
        let n = self.axes;
        let Some((a, b)) = self.line(k) else { return };
        let u = self.to_line(k, point).1;
        let (a, b, point, vector) = (&a[..n], &b[..n], &point[..n], &mut vector[..n]);
        for i in 0..n {
            vector[i] = a[i] + u * (b[i] - a[i]) - point[i];
        }
    }

    /// The set points of cycle `k` and cycle `k + 1`.
    #[inline]
    fn line(&self, k: u64) -> Option<(&[f64], &[f64])> {
        let at = k.checked_sub(self.first)? as usize * self.axes;
        Some(self.values.get(at..at + 2 * self.axes)?.split_at(self.axes))
    }
}

/// Distance in mm between two points.
#[inline]
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    // the numbers of axes that occur have loops of known length
    match a.len() {
        2 => apart(&a[..2], &b[..2]),
        3 => apart(&a[..3], &b[..3]),
        4 => apart(&a[..4], &b[..4]),
        _ => apart(a, b),
    }
}

#[inline]
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let b = &b[..a.len()];
    let mut square = 0.0;
    for i in 0..a.len() {
        square += (b[i] - a[i]) * (b[i] - a[i]);
    }
    square.sqrt()
}

/// Square of the distance in mm2 of a point from the line between two others, and the position on the line.
#[inline]
fn foot(a: &[f64], b: &[f64], point: &[f64]) -> (f64, f64) {
    let n = a.len();
    let (b, point) = (&b[..n], &point[..n]);
    let (mut dot, mut norm) = (0.0, 0.0);
    for i in 0..n {
        let d = b[i] - a[i];
        dot += (point[i] - a[i]) * d;
        norm += d * d;
    }
    let u = if norm > 0.0 { (dot / norm).clamp(0.0, 1.0) } else { 0.0 };
    let mut d2 = 0.0;
    for i in 0..n {
        let c = a[i] + u * (b[i] - a[i]) - point[i];
        d2 += c * c;
    }
    (d2, u)
}

/// How many of `count` items, from the first one on, have a property that none has after one that has not. Takes steps
/// that double, so that few leading items take few looks.
fn leading(count: usize, has: impl Fn(usize) -> bool) -> usize {
    let (mut known, mut step) = (0, 1);
    while known < count && has((known + step).min(count) - 1) {
        known = (known + step).min(count);
        step *= 2;
    }
    // the last step went too far
    let (mut low, mut high) = (known, (known + step).min(count).saturating_sub(1).max(known));
    while low < high {
        let mid = low.midpoint(high);
        if has(mid) {
            low = mid + 1;
        } else {
            high = mid;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::leading;
    use proptest::prelude::*;
    use std::cell::Cell;

    proptest! {
        /// The same as one item after the other, with a number of looks that grows with the logarithm of the result.
        #[test]
        fn leading_items_are_counted_with_few_looks(count in 0..3000_usize, share in 0.0..=1.0f64) {
            let expected = (share * share * count as f64) as usize;
            let looks = Cell::new(0);
            let found = leading(count, |i| {
                looks.set(looks.get() + 1);
                i < expected
            });
            prop_assert_eq!(found, expected);
            prop_assert!(looks.get() <= 2 * (expected + 1).ilog2() + 3, "{} {expected}", looks.get());
        }
    }
}
