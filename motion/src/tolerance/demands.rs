//! What the tolerance asks of the plan.

use super::kernels::Kernels;
use crate::asked::Asked;
use crate::axis::AxisVec;
use crate::queue::Queued;
use kontur_filters::time::CycleTime;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// Times that a place is made slower without effect after which the steps grow.
pub(super) const PATIENCE: u32 = 8;

/// Change of direction in rad over which the delays of the axes are looked at once.
const TURN: f64 = 0.1;

/// Parts of a stretch at most in which they are looked at.
const MOST_TURNS: f64 = 128.0;

/// What the monitor asks of the blocks ahead, one entry per boundary or block of the window; it stays with them when the
/// window moves on.
#[derive(Clone, Debug)]
pub(crate) struct Demands {
    /// Velocity cap at each boundary.
    pub(crate) cap: Vec<f64>,
    /// Full stop at the boundary with this many cycles of dwell.
    pub(crate) stop: Vec<Option<u32>>,
    /// Velocity cap of each block.
    pub(crate) feed: Vec<f64>,
    /// Part of its acceleration that each block may use.
    pub(super) acceleration: Vec<f64>,
    /// How often in a row more was asked of each boundary: a lower speed without effect, or a longer dwell.
    pub(super) repeats: Vec<u32>,
    /// How often in a row a lower speed of each block was without effect, and the excess then.
    pub(super) slower: Vec<(u32, f64)>,
    /// Speed and excess at each boundary when it was last found too fast.
    pub(super) tried: Vec<Option<(f64, f64)>>,
    /// First boundary whose even speed is not known yet, see [`super::even::foresee`].
    pub(super) foreseen: usize,
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
        }
    }
}

impl Demands {
    /// What was asked of blocks before, when they are planned once more: it depends on the contour and the filters more than
    /// on the rest of the plan, and the search for it takes many rounds. The path gets to the first block in another state.
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

    /// What is asked of a block and of the boundary before it; `None` if it has not been planned yet.
    pub(crate) fn of(&self, block: usize) -> Option<Asked> {
        Some(Asked {
            feed: *self.feed.get(block)?,
            cap: self.cap[block],
            stop: self.stop[block],
            acceleration: self.acceleration[block],
        })
    }

    /// Adds what is known of blocks before they are planned: axes whose filters have different delays leave a straight line
    /// by the speed times the difference, so a line long enough to be traversed at constant speed has its own speed.
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

    /// Asks for rests as long as the filters are at the boundaries between some blocks, and at both ends of them, and for nothing
    /// else there.
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

    /// True if [`Self::rest_over`] would ask for no rest that is not asked for already.
    pub(crate) fn rests_over(
        &self,
        blocks: Range<usize>,
        window: &[Arc<Queued>],
        kernels: &Kernels,
    ) -> bool {
        boundaries(&blocks, window).all(|b| self.stop[b] == Some(kernels.length()))
    }

    /// Makes room for `count` blocks before block `at`, held to nothing but a speed.
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

    /// Makes room for the parts of a block in its place.
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

    /// Forgets the first blocks, which are final. The boundary after them has only what is asked of it from now on.
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

    /// The blocks with the acceleration that is left to them.
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

/// Boundaries inside a window that begin or end one of some blocks; not those between parts of a block.
fn boundaries(blocks: &Range<usize>, window: &[Arc<Queued>]) -> impl Iterator<Item = usize> {
    let inside = blocks.start.max(1)..=blocks.end.min(window.len() - 1);
    inside.filter(|b| window[b - 1].block.seq != window[*b].block.seq)
}

/// Speed in mm/s that filters with different delays leave to a block long enough to be run through evenly, where it leaves most;
/// infinite for any other block.
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

/// Number of parts of a stretch over each of which its direction hardly changes.
pub(super) fn turns(bend: f64, length: f64) -> u32 {
    (bend * length / TURN).ceil().clamp(1.0, MOST_TURNS) as u32
}

/// How many steps to take at once where so many have been without effect.
pub(super) fn hurry(before: u32) -> u32 {
    let rows = before / PATIENCE;
    1 + rows * rows
}
