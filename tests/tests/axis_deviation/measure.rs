//! What a run has left of the contour, by the geometry of this package.

use kontur_interpreter::record::{AxisRecord, CycleRecord};
use kontur_kit::from_polyline;
use kontur_tests::Run;
use kontur_tests::geometry::{Piece, Point, deviation, minus, norm};

/// Parts of a piece of the contour whose ends are looked for on the set path.
const POINTS: u32 = 12;

/// A program and what the test knows about it.
#[derive(Clone)]
pub(crate) struct Case {
    pub(crate) text: String,
    pub(crate) settings: Vec<String>,
    pub(crate) tolerance_mm: f64,
    /// Largest distance of the contour from the pieces: 0, or `PATH_DEV` of a spline whose polygon the pieces are.
    pub(crate) off_mm: f64,
    /// Cycles that the filter reaches back.
    pub(crate) reach: usize,
    /// Line number and pieces of every block with motion.
    pub(crate) blocks: Vec<(u32, Vec<Piece>)>,
    /// Rounded corners, which stay sharp where that is faster (K-0146).
    pub(crate) corners: Vec<Corner>,
}

/// A rounded corner between a block and the next one.
#[derive(Clone)]
pub(crate) struct Corner {
    /// Index of the block before it.
    pub(crate) block: usize,
    /// Corner distance in mm.
    pub(crate) distance_mm: f64,
    /// Both sides of the sharp corner, from its distance on.
    pub(crate) sides: [Piece; 2],
}

impl Case {
    /// The contour with its corners as the interpolator passes them: on the curve, or on both sides.
    pub(crate) fn as_driven(&self, run: &Run) -> Self {
        let mut blocks = self.blocks.clone();
        for Corner { block, distance_mm, sides } in &self.corners {
            let corner = sides[1].point(0.0);
            let near = run.records.iter().map(interpolated);
            let near: Vec<Point> =
                near.filter(|p| norm(minus(*p, corner)) < *distance_mm).collect();
            let curve = &self.blocks[*block].1[1..];
            let on = |pieces: &[Piece]| {
                near.iter().filter(|p| deviation(pieces.iter(), **p) < 1e-8).count()
            };
            if on(sides) > on(curve) {
                let before = blocks[*block].1.len() - curve.len();
                blocks[*block].1.truncate(before);
                blocks[*block].1.push(sides[0].clone());
                blocks[*block + 1].1.insert(0, sides[1].clone());
            }
        }
        Self { blocks, corners: Vec::new(), ..self.clone() }
    }

    /// Largest component of the shortest vector from the pieces to a set point.
    pub(crate) fn within_mm(&self) -> f64 {
        if self.off_mm > 0.0 {
            // a vector of three components within the tolerance, and one of length `off_mm`
            3.0_f64.sqrt() * self.tolerance_mm + self.off_mm
        } else {
            self.tolerance_mm
        }
    }
}

/// Largest value of the axes over a run.
pub(crate) fn largest(run: &Run, of: fn(&AxisRecord) -> f64) -> f64 {
    run.records.iter().flat_map(|r| &r.axes[..3]).map(of).fold(0.0, f64::max)
}

/// Largest axis component of the shortest vector from the contour within reach of the filter, over all cycles. A sample
/// on the border of two blocks belongs to both, so the reach may end one block earlier or later.
pub(crate) fn recomputed(run: &Run, case: &Case) -> (f64, u64) {
    let block: Vec<usize> = run
        .records
        .iter()
        .map(|r| case.blocks.partition_point(|b| b.0 <= r.line).saturating_sub(1))
        .collect();
    let mut worst = (0.0, 0);
    for (k, record) in run.records.iter().enumerate() {
        let p = set_point(record);
        let (oldest, newest) = (block[k.saturating_sub(case.reach)], block[k]);
        let mut least = f64::MAX;
        for (early, late) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let last = (newest + late).min(case.blocks.len() - 1);
            let reached = &case.blocks[oldest.saturating_sub(early)..=last];
            least = least.min(deviation(reached.iter().flat_map(|b| &b.1), p));
            if least <= case.within_mm() {
                break;
            }
        }
        if least > worst.0 {
            worst = (least, record.k);
        }
    }
    worst
}

/// True if the filter is on in a line: without one a corner lies between two set points wherever it pleases.
pub(crate) fn is_filtered(case: &Case, line: u32) -> bool {
    let before = case.text.lines().take(line as usize);
    let switch = before.filter(|l| l.starts_with("#VIB GUARD") || l.starts_with("#FILTER")).last();
    switch.is_some_and(|l| l.contains(" ON"))
}

/// Largest distance of a point of the contour from the lines between the set points, over all filtered blocks, with the line of
/// the program. The distance is that of the axis that is furthest away: what is promised is that the set path comes to every
/// point within `AX_DEV` in every axis, while the filters hold it: from the cycle in which the path comes to it until their
/// length after it has gone on.
pub(crate) fn missed(run: &Run, case: &Case) -> (f64, u32) {
    let records = &run.records;
    let mut worst = (0.0, 0);
    let blocks = case.blocks.iter().enumerate();
    for (i, (line_number, pieces)) in blocks.filter(|(_, (line, _))| is_filtered(case, *line)) {
        // a wait at the end of a block can follow a dwell of a later line
        // and a rounded corner before the next block can be part of that
        let behind = case.blocks.get(i + 2).map_or(u32::MAX, |block| block.0);
        let Some(first) = records.iter().position(|r| r.line >= *line_number) else { continue };
        let last = records.iter().rposition(|r| r.line < behind).map_or(first, |k| k.max(first));
        let left = (last + 2).min(records.len() - 1);
        let entered = first.saturating_sub(2);
        for piece in pieces {
            for part in 0..=POINTS {
                let point = piece.point(f64::from(part) / f64::from(POINTS));
                let apart = |k: usize| norm(minus(point, interpolated(&records[k])));
                let line = |k: usize| {
                    let ends = [k, k + 1].map(|k| interpolated(&records[k]).to_vec());
                    from_polyline(&point, &ends).iter().map(|c| c * c).sum::<f64>()
                };
                let least = (entered..left).map(line).fold(f64::INFINITY, f64::min).sqrt();
                // a return over the same points comes later
                let passes = |k: &usize| line(*k).sqrt() <= least + 1e-6;
                let comes = (entered..left).find(passes).unwrap_or(entered);
                // as long as the path rests there
                let rests = |k: &usize| apart(*k) < 1e-9;
                let goes = comes + 1 + (comes + 1..records.len()).take_while(rests).count();
                // a line of the set path more or less at the border does not matter
                let from = comes.saturating_sub(2);
                let until = (goes + case.reach + 3).min(records.len());
                let set: Vec<Point> = records[from..until].iter().map(set_point).collect();
                let lines = set.windows(2).map(|line| least_component(point, line));
                let most = lines.fold(f64::INFINITY, f64::min);
                if most > worst.0 {
                    worst = (most, *line_number);
                }
            }
        }
    }
    worst
}

/// Least value along a line of the largest component of the vector to it: it is reached at an end, or where two components
/// change places, or at a zero of one of them.
fn least_component(point: Point, line: &[Point]) -> f64 {
    let (start, way) = (minus(line[0], point), minus(line[1], line[0]));
    let at = |u: f64| (0..3).fold(0.0, |m: f64, i| m.max((start[i] + u * way[i]).abs()));
    let mut least = at(0.0).min(at(1.0));
    for i in 0..3 {
        for (j, sign) in (0..3).flat_map(|j| [(j, 1.0), (j, -1.0)]) {
            // with itself: where it is zero
            let (a, b) = (start[i] - sign * start[j], way[i] - sign * way[j]);
            let u = -a / b;
            if u > 0.0 && u < 1.0 {
                least = least.min(at(u));
            }
        }
    }
    least
}

fn set_point(record: &CycleRecord) -> Point {
    [0, 1, 2].map(|i| record.axes[i].set)
}

fn interpolated(record: &CycleRecord) -> Point {
    [0, 1, 2].map(|i| record.axes[i].ipo)
}

/// No filter is visible in the unfiltered setpoints: they lie on the geometry that the test has drawn itself.
pub(crate) fn off_contour(run: &Run, case: &Case) -> f64 {
    let pieces: Vec<&Piece> = case.blocks.iter().flat_map(|b| &b.1).collect();
    let every = 1 + run.records.len() / 200;
    let ipo = run.records.iter().step_by(every).map(interpolated);
    ipo.map(|p| deviation(pieces.iter().copied(), p)).fold(0.0, f64::max)
}
