//! The contour of a run in bounded memory: points that are left out are within a known distance of the lines between
//! those that are kept.

/// One point of the contour: up to three linear axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Point {
    pub(crate) k: u64,
    pub(crate) line: u32,
    pub(crate) pass: usize,
    /// Programmed end of its block, if that is a straight line.
    pub(crate) target: Option<[f64; 3]>,
    pub(crate) error: f64,
    pub(crate) ipo: [f64; 3],
    pub(crate) set: [f64; 3],
    pub(crate) act: [f64; 3],
}

/// Number of points that are collected before some are left out.
const CHUNK: usize = 2048;
/// Largest number of points of a finished track as long as the reduction cannot be seen.
const MOST: usize = 40_000;
/// Largest number of points of any finished track, as with many corners passed repeatedly.
const MOST_OF_ALL: usize = 160_000;
/// Share of the size of the contour from which on a reduction is visible: a pixel.
const VISIBLE: f64 = 1e-3;
/// Distance in mm that is too small to be visible: the last digit of a trace.
const FINEST_MM: f64 = 1e-7;

/// Interpolated, set and actual contour.
///
/// Points are selected by the method of Douglas and Peucker (1973), chunk by chunk, for all three contours together. If
/// there are too many of them, they are selected again with a larger tolerance; the tolerances add up.
#[derive(Clone, Debug)]
pub(super) struct Track {
    kept: Vec<Point>,
    /// Begins with a point that is kept in any case.
    tail: Vec<Point>,
    tolerance_mm: f64,
    within_mm: f64,
    /// Smallest and largest coordinates.
    range_mm: [[f64; 3]; 2],
}

impl Default for Track {
    fn default() -> Self {
        Self {
            kept: Vec::new(),
            tail: Vec::new(),
            tolerance_mm: FINEST_MM,
            within_mm: FINEST_MM,
            range_mm: [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]],
        }
    }
}

impl Track {
    /// Adds the point of the next cycle.
    pub(super) fn add(&mut self, point: Point) {
        let new_pass = self.tail.last().is_some_and(|last| last.pass != point.pass);
        if self.tail.len() >= CHUNK || new_pass {
            self.settle();
        }
        let [least, greatest] = &mut self.range_mm;
        for ((least, greatest), x) in least.iter_mut().zip(greatest).zip(point.ipo) {
            (*least, *greatest) = (least.min(x), greatest.max(x));
        }
        if new_pass {
            // both ends of a pass are kept
            self.kept.append(&mut self.tail);
        }
        self.tail.push(point);
    }

    /// Every point that is kept, in order.
    pub(super) fn points(&self) -> impl Iterator<Item = &Point> {
        self.kept.iter().chain(&self.tail)
    }

    /// Bound in mm of the distance of left-out points from the lines between the others.
    pub(super) const fn within_mm(&self) -> f64 {
        self.within_mm
    }

    /// Merges all points into one pass.
    pub(super) fn one_pass(&mut self) {
        self.kept.iter_mut().chain(&mut self.tail).for_each(|p| p.pass = 0);
    }

    /// Number of points that may be kept before the next selection.
    fn most(&self) -> usize {
        let [least, greatest] = &self.range_mm;
        let size_mm = greatest.iter().zip(least).map(|(high, low)| high - low).fold(0.0, f64::max);
        let next_mm = self.within_mm + 2.0 * self.tolerance_mm;
        if next_mm > VISIBLE * size_mm { MOST_OF_ALL } else { MOST }
    }

    /// Selects points of the tail; its last one becomes the beginning of the next tail.
    fn settle(&mut self) {
        thin(&mut self.tail, self.tolerance_mm);
        let last = self.tail.pop();
        self.kept.append(&mut self.tail);
        self.tail.extend(last);
        while self.kept.len() > self.most() - CHUNK {
            self.tolerance_mm *= 2.0;
            self.within_mm += self.tolerance_mm;
            let mut chosen = Vec::with_capacity(self.kept.len());
            for pass in self.kept.chunk_by(|a, b| a.pass == b.pass) {
                // in parts, which keeps the effort proportional to the number of points
                for part in pass.chunks(CHUNK) {
                    let mut part = part.to_vec();
                    thin(&mut part, self.tolerance_mm);
                    chosen.append(&mut part);
                }
            }
            self.kept = chosen;
        }
    }
}

/// Leaves out every point within a tolerance of the line between its remaining neighbours, on all three contours.
fn thin(points: &mut Vec<Point>, tolerance_mm: f64) {
    if points.len() < 3 {
        return;
    }
    let mut stays = vec![false; points.len()];
    let last = points.len() - 1;
    (stays[0], stays[last]) = (true, true);
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let aside = |i: usize| aside_mm2(&points[i], &points[from], &points[to]);
        let candidates = (from + 1..to).map(|i| (i, aside(i)));
        let Some((farthest, mm2)) = candidates.max_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
        if mm2 > tolerance_mm * tolerance_mm {
            stays[farthest] = true;
            open.extend([(from, farthest), (farthest, to)]);
        }
    }
    let mut stays = stays.iter();
    points.retain(|_| stays.next().is_some_and(|s| *s));
}

/// Largest squared distance of a point from the line between two others, over the three contours and the programmed
/// one: the end of a block is left out only if all its points are.
fn aside_mm2(p: &Point, a: &Point, b: &Point) -> f64 {
    let of = |value: fn(&Point) -> &[f64; 3]| from_line_mm2(value(p), value(a), value(b));
    let contours = of(|p| &p.ipo).max(of(|p| &p.set)).max(of(|p| &p.act));
    contours.max(of(|p| p.target.as_ref().unwrap_or(&p.ipo)))
}

fn from_line_mm2(p: &[f64; 3], a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let (mut along, mut length2) = (0.0, 0.0);
    for i in 0..3 {
        along += (p[i] - a[i]) * (b[i] - a[i]);
        length2 += (b[i] - a[i]) * (b[i] - a[i]);
    }
    let part = if length2 > 0.0 { (along / length2).clamp(0.0, 1.0) } else { 0.0 };
    (0..3).map(|i| p[i] - a[i] - part * (b[i] - a[i])).map(|d| d * d).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A winding path with rests: each of 200,000 points is within the stated distance of the track.
    #[test]
    fn what_is_left_out_is_within_the_stated_distance() {
        let at = |k: u64| -> Point {
            let t = k as f64 * 1e-3;
            let set = [30.0 * libm::sin(t), 20.0 * libm::sin(2.7 * t + 0.3), 0.1 * t];
            let act = set.map(|v| v + 0.02 * libm::sin(30.0 * t));
            Point { k, ipo: set, set, act, ..Point::default() }
        };
        let mut track = Track::default();
        let count = 200_000;
        for k in 0..count {
            track.add(at(k));
        }
        let kept: Vec<&Point> = track.points().collect();
        assert!(kept.len() <= MOST && kept.len() > MOST / 8, "{}", kept.len());
        assert!(kept.windows(2).all(|w| w[0].k < w[1].k));
        assert!((kept[0].k, kept[kept.len() - 1].k) == (0, count - 1));
        let mut worst: f64 = 0.0;
        for w in kept.windows(2) {
            for k in w[0].k + 1..w[1].k {
                worst = worst.max(aside_mm2(&at(k), w[0], w[1]).sqrt());
            }
        }
        assert!(worst <= track.within_mm() * (1.0 + 1e-9), "{worst} of {}", track.within_mm());
        assert!(track.within_mm() < 0.01, "{}", track.within_mm());
    }

    /// A comb with 12,000 teeth of 1 mm on 10 mm, passed repeatedly: its corners are kept, although there are more of
    /// them than in a contour with invisible reduction.
    #[test]
    fn corners_stay_where_their_loss_would_be_seen() {
        let corner = |i: u64| {
            let (tooth, part) = ((i / 4) % 5, i % 4);
            let x = 2.0 * tooth as f64 + [0.0, 1.0, 1.0, 2.0][part as usize];
            [x, if part < 2 { 0.0 } else { 1.0 }, 0.0]
        };
        let mut track = Track::default();
        let corners = 48_000;
        for k in 0..corners * 4 {
            let (from, to) = (corner(k / 4), corner(k / 4 + 1));
            // every corner is cut
            let part = [0.002, 0.34, 0.67, 0.998][(k % 4) as usize];
            let set = [0, 1, 2].map(|a| from[a] + part * (to[a] - from[a]));
            track.add(Point { k, target: Some(to), ipo: set, set, act: set, ..Point::default() });
        }
        assert!(track.within_mm() < 0.05, "{}", track.within_mm());
        assert!(track.points().count() <= MOST_OF_ALL);
        // all programmed lines are along X or Y, except for the way back to the first tooth
        let ends: Vec<[f64; 3]> = track.points().filter_map(|p| p.target).collect();
        let slanted = |w: &&[[f64; 3]]| {
            let [x, y] = [0, 1].map(|axis| (w[0][axis] - w[1][axis]).abs());
            x > 0.0 && y > 0.0 && x < 5.0
        };
        let slanted = ends.windows(2).find(slanted);
        assert!(slanted.is_none(), "{slanted:?}");
    }

    /// A square of 400,000 cycles needs only a few points, exact to the last digit, and its corners are kept.
    #[test]
    fn straight_lines_need_their_ends() {
        let corners = [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0], [0.0, 0.0]];
        let mut track = Track::default();
        for k in 0..=400_000_u64 {
            let s = k as f64 / 1e5;
            let i = (s as usize).min(3);
            let part = s - i as f64;
            let set = [0, 1, 2].map(|a| {
                corners[i].get(a).map_or(0.0, |from| from + part * (corners[i + 1][a] - from))
            });
            track.add(Point { k, ipo: set, set, act: set, ..Point::default() });
        }
        assert!(track.points().count() < 400 + CHUNK, "{}", track.points().count());
        for corner in &corners {
            assert!(track.points().any(|p| p.set[..2] == corner[..]), "{corner:?}");
        }
        assert!(track.within_mm() <= FINEST_MM);
    }
}
