//! The demands of the tolerance on the plan.

use super::answered::Answered;
use super::dwell::Shorter;
use super::kernels::Kernels;
use super::places::Places;
use crate::asked::Asked;
use crate::axis::AxisVec;
use crate::queue::Queued;
use kontur_filters::time::CycleTime;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// Number of reductions without effect at one place after which the steps grow.
pub(super) const PATIENCE: u32 = 8;

/// Change of direction in rad within which the delays of the axes are evaluated once.
const TURN: f64 = 0.1;

/// Maximum number of such parts of a stretch.
const MOST_TURNS: f64 = 128.0;

/// The demands of the monitor on the blocks ahead, one entry per boundary or block of the window; they are kept when
/// the window moves on.
#[derive(Clone, Debug)]
pub(crate) struct Demands {
    /// Velocity cap at each boundary in mm/s.
    pub(crate) cap: Vec<f64>,
    /// Full stop at the boundary with this many cycles of dwell.
    pub(crate) stop: Vec<Option<u32>>,
    /// Velocity cap of each block in mm/s.
    pub(crate) feed: Vec<f64>,
    /// Share of its acceleration that each block may use.
    pub(super) acceleration: Vec<f64>,
    /// How often in a row the demand on each boundary was raised: a lower speed without effect, or a longer dwell.
    pub(super) repeats: Vec<u32>,
    /// How often in a row a lower speed of each block had no effect, and the last excess in mm.
    pub(super) slower: Vec<(u32, f64)>,
    /// Excess in mm at each boundary when it was last too fast.
    pub(super) tried: Vec<Option<f64>>,
    /// First boundary without a known even speed, see [`super::foresee`].
    pub(super) foreseen: usize,
    /// The plan for whose excesses even speeds were demanded.
    pub(super) answered: Option<Answered>,
    /// Where the last plan exceeded the tolerance.
    pub(super) places: Places,
}

impl Default for Demands {
    fn default() -> Self {
        Self {
            cap: vec![f64::INFINITY],
            stop: vec![None],
            feed: Vec::new(),
            acceleration: Vec::new(),
            repeats: vec![0],
            slower: Vec::new(),
            tried: vec![None],
            foreseen: 0,
            answered: None,
            places: Places::default(),
        }
    }
}

impl Demands {
    /// Restores earlier demands on blocks that are planned again: they depend on the contour and the filters more than
    /// on the rest of the plan, and the search for them takes many rounds. At the first boundary they are dropped,
    /// because the path reaches it in another state.
    pub(crate) fn again(blocks: impl Iterator<Item = Asked>) -> Self {
        let mut demands = Self::default();
        for Asked { cap, stop, feed, acceleration } in blocks {
            // the boundary before the block; a new one after it
            if let (Some(last), Some(rest), false) =
                (demands.cap.last_mut(), demands.stop.last_mut(), demands.feed.is_empty())
            {
                (*last, *rest) = (cap, stop);
            }
            demands.cap.push(f64::INFINITY);
            demands.stop.push(None);
            demands.repeats.push(0);
            demands.tried.push(None);
            demands.feed.push(feed);
            demands.acceleration.push(acceleration);
            demands.slower.push((0, 0.0));
        }
        demands
    }

    /// The demands on a block and on the boundary before it; `None` if it has not been planned yet.
    pub(crate) fn of(&self, block: usize) -> Option<Asked> {
        Some(Asked {
            feed: *self.feed.get(block)?,
            cap: self.cap[block],
            stop: self.stop[block],
            acceleration: self.acceleration[block],
        })
    }

    /// Adds blocks with the demands known before planning: axes whose filters have different delays leave a straight
    /// line by the speed times the difference, so a line long enough to be traversed at constant speed has a speed
    /// limit.
    pub(crate) fn reach_over(
        &mut self,
        window: &[Arc<Queued>],
        kernels: &Kernels,
        cycle: CycleTime,
    ) {
        let known = self.feed.len();
        self.insert(known, window.len().saturating_sub(known), f64::INFINITY);
        for (queued, feed) in window.iter().zip(&mut self.feed).skip(known) {
            *feed = even_on(queued, kernels, cycle);
        }
    }

    /// Demands dwells as long as the filters at the boundaries between some blocks and at both ends, and drops all
    /// other demands there.
    pub(crate) fn rest_over(
        &mut self,
        blocks: Range<usize>,
        window: &[Arc<Queued>],
        kernels: &Kernels,
        cycle: CycleTime,
    ) {
        for b in blocks.clone() {
            self.feed[b] = even_on(&window[b], kernels, cycle);
            (self.acceleration[b], self.slower[b]) = (1.0, (0, 0.0));
        }
        for b in boundaries(&blocks, window) {
            (self.repeats[b], self.tried[b]) = (0, None);
            (self.cap[b], self.stop[b]) = (0.0, Some(kernels.length()));
        }
    }

    /// Number of cycles that a plan, given by the times at which it enters its blocks, has lost for nothing against the
    /// plan for whose excesses even speeds have been demanded, see [`Answered::lost`]; the path can brake within
    /// `brakes` cycles. `None` if there were no such excesses, or in more than a share of the plan.
    pub(crate) fn answer_few(
        &mut self,
        share: f64,
        plan: &[f64],
        brakes: f64,
        kernels: &Kernels,
    ) -> Option<f64> {
        let answered = self.answered.take().filter(|a| a.count() > 0)?;
        let (first, last) = (plan.first()?, plan.last()?);
        let reach = f64::from(kernels.length());
        let few = 0.5 * answered.count() as f64 * reach <= share * (last - first);
        let beside = (1.5 * reach + brakes, 0.5 * reach + brakes);
        few.then(|| answered.lost(plan, beside))
    }

    /// Whether these demands and others lead to the same plan.
    pub(crate) fn are_those_of(&self, other: &Self) -> bool {
        (&self.cap, &self.stop, &self.feed, &self.acceleration)
            == (&other.cap, &other.stop, &other.feed, &other.acceleration)
    }

    /// Whether a line between two dwells has a demanded speed.
    pub(crate) fn slows(&self, shorter: &Shorter) -> bool {
        shorter.between.iter().any(|b| self.feed[*b].is_finite() || self.acceleration[*b] < 1.0)
    }

    /// Shortens dwells; `at_speed`: and drops the demands on the lines between two dwells.
    pub(crate) fn shorten(
        &mut self,
        shorter: &Shorter,
        at_speed: bool,
        window: &[Arc<Queued>],
        kernels: &Kernels,
        cycle: CycleTime,
    ) {
        for b in shorter.between.iter().filter(|_| at_speed) {
            self.feed[*b] = even_on(&window[*b], kernels, cycle);
            (self.acceleration[*b], self.slower[*b]) = (1.0, (0, 0.0));
        }
        for (b, dwell) in &shorter.dwells {
            (self.stop[*b], self.repeats[*b], self.tried[*b]) = (Some(*dwell), 0, None);
        }
    }

    /// Whether [`Self::rest_over`] would not demand any new dwell.
    pub(crate) fn rests_over(
        &self,
        blocks: Range<usize>,
        window: &[Arc<Queued>],
        kernels: &Kernels,
    ) -> bool {
        boundaries(&blocks, window).all(|b| self.stop[b] == Some(kernels.length()))
    }

    /// Inserts `count` blocks before block `at` whose only demand is a speed.
    pub(crate) fn insert(&mut self, at: usize, count: usize, feed: f64) {
        fn fill<T: Clone>(list: &mut Vec<T>, at: usize, count: usize, value: T) {
            list.splice(at..at, std::iter::repeat_n(value, count));
        }
        fill(&mut self.cap, at, count, f64::INFINITY);
        fill(&mut self.stop, at, count, None);
        fill(&mut self.repeats, at, count, 0);
        fill(&mut self.tried, at, count, None);
        fill(&mut self.feed, at, count, feed);
        fill(&mut self.acceleration, at, count, 1.0);
        fill(&mut self.slower, at, count, (0, 0.0));
        self.foreseen = self.foreseen.min(at);
    }

    /// Replaces a block by its parts.
    pub(crate) fn divide(
        &mut self,
        block: usize,
        parts: &[Arc<Queued>],
        kernels: &Kernels,
        cycle: CycleTime,
    ) {
        self.insert(block + 1, parts.len() - 1, self.feed[block]);
        for (feed, part) in self.feed[block..].iter_mut().zip(parts) {
            *feed = feed.min(even_on(part, kernels, cycle));
        }
    }

    /// Drops the first blocks, which are final. The boundary after them starts without demands.
    pub(crate) fn pass(&mut self, blocks: usize) {
        self.cap.drain(..blocks);
        self.stop.drain(..blocks);
        self.repeats.drain(..blocks);
        self.tried.drain(..blocks);
        self.feed.drain(..blocks);
        self.acceleration.drain(..blocks);
        self.slower.drain(..blocks);
        (self.cap[0], self.stop[0], self.tried[0]) = (f64::INFINITY, None, None);
        self.repeats[0] = 0;
        self.foreseen = self.foreseen.saturating_sub(blocks);
    }

    /// The blocks with their reduced accelerations.
    pub(crate) fn soften<'a>(&self, window: &'a [Arc<Queued>]) -> Cow<'a, [Arc<Queued>]> {
        if self.acceleration.iter().all(|ratio| *ratio >= 1.0) {
            return Cow::Borrowed(window);
        }
        let soften = |(queued, ratio): (&Arc<Queued>, &f64)| {
            if *ratio >= 1.0 {
                return Arc::clone(queued);
            }
            let mut soft = Queued::clone(queued);
            soft.slope = soft.slope.scaled(*ratio);
            Arc::new(soft)
        };
        Cow::Owned(window.iter().zip(&self.acceleration).map(soften).collect())
    }
}

/// Boundaries inside a window at which one of some blocks begins or ends, except those between parts of a block.
fn boundaries(blocks: &Range<usize>, window: &[Arc<Queued>]) -> impl Iterator<Item = usize> {
    let inside = blocks.start.max(1)..=blocks.end.min(window.len() - 1);
    inside.filter(|b| window[b - 1].block.seq != window[*b].block.seq)
}

/// Speed limit in mm/s that filters with different delays impose on a block long enough to be traversed at constant
/// speed, at its most favourable place; infinite for any other block.
fn even_on(queued: &Queued, kernels: &Kernels, cycle: CycleTime) -> f64 {
    let tolerance = queued.block.tolerance.ax_dev_mm.filter(|_| kernels.unequal);
    let Some(tolerance) = tolerance else { return f64::INFINITY };
    let mut tangent = AxisVec::zeros(queued.ends.tangent_in.len());
    let mut speed_at = |s: f64| {
        queued.block.path.tangent(queued.offset + s, &mut tangent);
        kernels.speed_along(&tangent, tolerance, cycle)
    };
    let parts = turns(queued.bend, queued.length);
    let places = (0..=parts).map(|i| queued.length * f64::from(i) / f64::from(parts));
    let speed = places.map(&mut speed_at).fold(0.0, f64::max);
    let is_long = speed * f64::from(kernels.length()) * cycle.seconds() <= queued.length;
    if is_long { speed } else { f64::INFINITY }
}

/// Number of parts of a stretch within each of which its direction hardly changes.
pub(super) fn turns(bend: f64, length: f64) -> u32 {
    (bend * length / TURN).ceil().clamp(1.0, MOST_TURNS) as u32
}

/// Number of steps to take at once after `before` reductions without effect.
pub(super) fn hurry(before: u32) -> u32 {
    let rows = before / PATIENCE;
    1 + rows * rows
}
