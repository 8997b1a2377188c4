//! The tolerance that a short run uses.
//!
//! A larger tolerance permits larger curves, but not every larger curve is faster: between few edges of unequal length, and
//! next to a rest, the spline that uses all of the tolerance can take longer than one that stays closer to the polygon, or
//! than the polygon itself. What is the fastest depends on the speeds along the whole run, and these are known once it is
//! planned. So a run of up to [`MOST`] blocks is planned with several splines, between the block before it and the one
//! after it, and the fastest one is used: with the tolerances as they are given, with each of a series of smaller limits
//! that is the same for all runs, and without any spline. A larger tolerance adds limits to this series and removes only
//! those below about a tenth of it, so that it is hardly ever slower.
//!
//! Assumption: the path rests before the block before the run and after the one after it, which are long
//! enough for that to be of little effect.
//!
//! Longer runs are judged corner by corner ([`super::worth`]). So are runs under `AX_DEV`, whose plans have to be
//! measured, those with `AUTO_OFF_PATH` or `AUTO_OFF_TRACK`, where another tolerance is another end of the spline, and
//! those with blocks of less than a quarter of a cycle: of many blocks within a cycle the set points show less than the plan, and
//! the fastest plan may be the one whose set points exceed the limits.

use super::edge::{ends_at, programmed, stops_between};
use super::stage::Stage;
use crate::block::Block;
use crate::contouring::{NoContour, Notice};
use crate::junction::Ends;
use crate::limits::{PathExtremes, PathSpeeds};
use crate::planner::{Corners, Planner};
use crate::tolerance::Kernels;
use kontur_filters::time::CycleTime;

/// Largest number of blocks of a run that is planned as a whole.
pub(super) const MOST: usize = 32;
/// Ratio of the limits of the series, the cubic root of 4, and their largest number.
const RATIO: f64 = 1.587_401_051_968_199_4;
const LIMITS: usize = 5;
/// Share of an edge that no spline is further away from the polygon.
const FURTHEST: f64 = 0.25;
/// Shortest block in cycles, at the highest speed.
const SHORTEST: f64 = 0.25;
/// Share of the time that a smaller limit has to save.
const GAIN: f64 = 1e-3;
/// Change of direction treated as none.
const STRAIGHT: f64 = 1e-9;

/// Blocks of a spline, and the corners that stay sharp.
type Splined = (Vec<Block>, Vec<Notice>);

/// Whether a block can be part of a run that is planned as a whole.
pub(super) fn is_comparable(block: &Block, kernels: &Kernels, cycle: CycleTime) -> bool {
    let monitored = kernels.any() && block.tolerance.ax_dev_mm.is_some();
    let fixed = block.spline.is_none_or(|s| s.off_at_path_dev || s.off_at_track_dev);
    !fixed && !monitored && block.contour.is_none() && lasts(block, cycle)
}

/// Whether a block at its highest speed takes [`SHORTEST`] of a cycle at least.
fn lasts(block: &Block, cycle: CycleTime) -> bool {
    let speeds = PathSpeeds::of(block, &PathExtremes::of(&block.path));
    let v_mm_s = speeds.limited(speeds.programmed_mm_s).v_mm_s;
    block.path.length() >= SHORTEST * v_mm_s * cycle.seconds()
}

/// The fastest of the splines of a run between two blocks; `None` instead of a block: the path rests there.
pub(super) fn fastest(
    run: &[Block],
    around: [Option<&Block>; 2],
    kernels: &Kernels,
    cycle: CycleTime,
) -> Splined {
    let timed = |blocks: &[Block], corners: Corners| {
        let [before, after] = around.map(Option::into_iter);
        Planner::time_s(before.chain(blocks).chain(after), kernels, cycle, corners)
    };
    let mut best = splined(run, f64::INFINITY, kernels, cycle);
    let Some(mut least_s) = timed(&best.0, Corners::Limit) else { return best };
    if timed(run, Corners::Free).is_none_or(|free_s| least_s <= (1.0 + GAIN) * free_s) {
        return best;
    }
    let closer = limits(run).map(|limit| splined(run, limit, kernels, cycle));
    for other in closer.chain([sharp(run)]) {
        if let Some(seconds) =
            timed(&other.0, Corners::Limit).filter(|t| *t < (1.0 - GAIN) * least_s)
        {
            (best, least_s) = (other, seconds);
        }
    }
    best
}

/// Limits of the series in mm below the largest deviation that a spline of the run can have, from large to small.
fn limits(run: &[Block]) -> impl Iterator<Item = f64> {
    let given = run.iter().filter_map(|block| block.spline).map(|settings| settings.path_dev_mm);
    let largest = given.map(|d| if d > 0.0 { d } else { f64::INFINITY }).fold(0.0, f64::max);
    let longest = run.iter().map(|block| block.path.length()).fold(0.0, f64::max);
    let top = largest.min(FURTHEST * longest);
    let step = libm::log(RATIO);
    let first = (libm::log(top) / step).ceil() - 1.0;
    (0..LIMITS).map(move |k| libm::exp(step * (first - k as f64))).filter(|limit| *limit > 0.0)
}

/// The spline of a run with its tolerances, none of them above a limit in mm.
fn splined(run: &[Block], limit_mm: f64, kernels: &Kernels, cycle: CycleTime) -> Splined {
    let mut stage = Stage::new(cycle);
    let mut blocks = Vec::with_capacity(run.len());
    for block in run {
        let mut block = block.clone();
        if let Some(settings) = block.spline.as_mut().filter(|_| limit_mm.is_finite()) {
            let given = settings.path_dev_mm;
            settings.path_dev_mm = if given > 0.0 { given.min(limit_mm) } else { limit_mm };
        }
        blocks.extend(stage.push(block, kernels));
    }
    blocks.extend(stage.flush(kernels));
    (blocks, stage.take_notices())
}

/// The run as programmed, and the corners that a spline would round.
fn sharp(run: &[Block]) -> Splined {
    let corners = run.windows(2).filter(|pair| is_rounded(&pair[0], &pair[1]));
    let notices = corners.map(|pair| Notice { seq: pair[0].seq, reason: NoContour::Slower });
    (run.to_vec(), notices.collect())
}

/// Whether there is a corner between two blocks at which a spline does not end.
fn is_rounded(from: &Block, to: &Block) -> bool {
    let [out_of, into] = [from, to].map(Ends::of);
    let bends = out_of.tangent_out.iter().zip(into.tangent_in.iter());
    let points = [from.path.start(), to.path.start(), to.path.end()].map(|p| &p[..]);
    programmed(from).is_some()
        && !stops_between(from, to)
        && bends.into_iter().any(|(a, b)| (a - b).abs() > STRAIGHT)
        && programmed(to).is_some_and(|settings| !ends_at(points, to, &settings))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::SplineSettings;
    use crate::example::block;

    /// Corners are at 0 (right angle), 1 (none), 2 (reversal) and 3 (right angle, `MAX_ANGLE` of the next block is 80 deg).
    #[test]
    fn only_corners_that_a_spline_would_round_are_named() {
        let points = [[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [5.0, 6.0], [5.0, 2.0], [9.0, 2.0]];
        let run: Vec<Block> = (0..5)
            .map(|i| {
                let max_angle_deg = if i == 4 { 80.0 } else { 180.0 };
                let spline = Some(SplineSettings { max_angle_deg, ..SplineSettings::default() });
                Block { spline, ..block(i as u64, points[i], points[i + 1], 100.0) }
            })
            .collect();
        let (blocks, notices) = sharp(&run);
        assert_eq!(blocks.len(), run.len());
        assert_eq!(notices, [Notice { seq: 0, reason: NoContour::Slower }]);
    }
}
