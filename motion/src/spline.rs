//! B-spline through runs of short linear blocks (`#HSC ON [BSPLINE]`): a stage between program and planner.
//!
//! The path is a cubic B-spline with one knot per control point (source: TF5200, extended HSC programming, control points;
//! Assumption: degree and knots). Where chords follow a contour, the control points are fitted to the programmed points
//! over evened knots ([`fairing`]): rounding and chords of unequal length do not show, and each block is the part of
//! the curve over its own stretch of the polygon. The deviation is certified edge by edge.
//!
//! Elsewhere, at corners and next to edges whose sagitta exceeds the tolerance, the programmed points are the control
//! points, with knots at their distances along the polygon. In Bezier form the piece of an edge has both inner points on
//! that edge, and its ends are on the lines that cut the corners: it is never further from its edge than its ends are,
//! and the deviation follows from the corners alone. Between a fit and such an edge is a corner with control points of
//! its own; on the side of the fit they are inserted as knots, which leaves the fit unchanged.
//!
//! On edges of equal length the deviation is a sixth of an edge times the change of direction: `h^2 / (6 r)` where the
//! polygon follows an arc of radius `r`. A corner with more deviation is pulled back. If the tolerance is only slightly
//! too small, knots at the middles of its edges leave only the corner itself to move back to the programmed point, by
//! as much as necessary; the full distance halves the deviation, and the next knots continue from there. The tolerance
//! is thus used, and a larger one makes the spline neither sharper nor abruptly different. A corner with a tolerance
//! that is small compared with its edges, or with edges of unequal length and a deviation that could exceed the
//! tolerance for any other edges, gets two more control points on either side, at distances `e` and `2 e`; its
//! deviation is then `e/3 sin(theta/2)`, and the spline touches the polygon before and after it (P-CHAN-00129 = 0). Or
//! the spline ends there (`AUTO_OFF_PATH`, decided by the bound for any other edges, which is a quarter of an edge on
//! equal ones). At its ends the spline meets the polygon with its direction and without curvature. Everywhere else
//! position, tangent and curvature are continuous.
//!
//! Whatever the control points: a spline that passes a corner at the distance `d` with a change of direction by `jump`
//! has a curvature of about `jump^2 / (6 d)` there. Below the deviation of the polygon with equal edges a smaller
//! tolerance therefore costs speed, as its square root: the edges become straighter and the corners sharper, and the
//! path speed has a ripple. A corner just short of a reversal stays a corner, as in contouring. So does a corner that
//! is passed faster without the spline ([`worth`]), under `AX_DEV` possibly with a stop. That is judged corner by corner,
//! as if the speed were highest in the middle of each edge: next to a rest a spline may take a few hundredths longer than
//! its corner, and between few edges of unequal length a larger tolerance can be slower than a smaller one. A short run
//! is therefore planned with several tolerances, and the fastest spline is used ([`choice`]).
//!
//! `PATH_DEV` and `TRACK_DEV` limit the total: what a fit uses next to a corner is not available there.
//!
//! A block becomes several ones with its number if its parts permit different speeds or belong to several polynomials.
//!
//! Order of calls, as for [`crate::contouring`]: [`Splining::push`] block by block, [`Splining::flush`] where the path
//! stops; before the first block of a run that does not begin at rest, [`Splining::begin_behind`].
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! use kontur_filters::time::CycleTime;
//! use kontur_motion::block::SplineSettings;
//! use kontur_motion::spline::Splining;
//! use kontur_motion::tolerance::Kernels;
//!
//! // a circle of 10 mm in chords of 10 degrees
//! let point = |i: u64| { let (sin, cos) = libm::sincos(i as f64 * 0.1745); [10.0 * cos, 10.0 * sin] };
//! let mut stage = Splining::new(CycleTime::DEFAULT);
//! let mut out: Vec<Block> = Vec::new();
//! for i in 0..36 {
//!     let mut chord = block(i, point(i), point(i + 1), 100.0);
//!     chord.spline = Some(SplineSettings::default());
//!     out.extend(stage.push(chord, &Kernels::default()));
//! }
//! out.extend(stage.flush(&Kernels::default()));
//! assert!(out.iter().all(|block| !block.path.is_straight()));
//! ```

mod choice;
mod edge;
mod fairing;
mod limits;
mod node;
mod pace;
mod polygon;
mod stage;
mod worth;

use crate::block::Block;
use crate::contouring::Notice;
use crate::tolerance::Kernels;
use kontur_filters::time::CycleTime;
use stage::Stage;

/// The spline stage, see the module.
#[derive(Debug)]
pub struct Splining {
    cycle: CycleTime,
    stage: Stage,
    /// The run so far, while it is short enough to be planned as a whole.
    held: Option<Vec<Block>>,
    /// The block before the run, unless the path rests there.
    before: Option<Block>,
    ready: Vec<Block>,
    notices: Vec<Notice>,
}

impl Splining {
    /// An empty stage.
    pub fn new(cycle: CycleTime) -> Self {
        let stage = Stage::new(cycle);
        Self { cycle, stage, held: None, before: None, ready: Vec::new(), notices: Vec::new() }
    }

    /// Whether no block is held.
    pub fn is_empty(&self) -> bool {
        self.held.is_none() && self.stage.is_empty()
    }

    /// Whether [`Self::push`] would return this block at once and unchanged: it is not part of a spline, and no block
    /// is held.
    pub fn passes(&self, block: &Block) -> bool {
        block.spline.is_none() && self.is_empty()
    }

    /// The block before the next run, which the path passes without coming to rest; only while no block is held.
    pub fn begin_behind(&mut self, before: &Block) {
        self.before = Some(before.clone());
    }

    /// Takes a block and returns the final ones. `kernels`: with any of them `ACC_FACT` applies at corners, and
    /// `AX_DEV` if it is programmed.
    pub fn push<'a>(
        &'a mut self,
        block: Block,
        kernels: &Kernels,
    ) -> impl Iterator<Item = Block> + use<'a> {
        if self.is_empty() && choice::is_comparable(&block, kernels, self.cycle) {
            self.held = Some(Vec::new());
        }
        match &mut self.held {
            Some(run)
                if run.len() < choice::MOST
                    && choice::is_comparable(&block, kernels, self.cycle) =>
            {
                run.push(block);
            }
            _ => {
                if block.spline.is_none() {
                    self.choose(Some(&block), kernels);
                } else {
                    self.release(kernels);
                }
                self.ready.extend(self.stage.push(block, kernels));
            }
        }
        self.ready.drain(..)
    }

    /// Returns everything that is held, where the path stops after the last block.
    pub fn flush<'a>(&'a mut self, kernels: &Kernels) -> impl Iterator<Item = Block> + use<'a> {
        self.choose(None, kernels);
        self.ready.extend(self.stage.flush(kernels));
        self.before = None;
        self.ready.drain(..)
    }

    /// Outputs the fastest spline of the run held, which is complete; `after`: the block after it, or `None` if the path
    /// stops there.
    fn choose(&mut self, after: Option<&Block>, kernels: &Kernels) {
        let Some(run) = self.held.take_if(|run| run.len() > 1) else {
            return self.release(kernels);
        };
        let before = self.before.take();
        let (blocks, notices) =
            choice::fastest(&run, [before.as_ref(), after], kernels, self.cycle);
        self.ready.extend(blocks);
        self.notices.extend(notices);
    }

    /// Passes the run held on to the stage.
    fn release(&mut self, kernels: &Kernels) {
        self.before = None;
        for block in self.held.take().into_iter().flatten() {
            self.ready.extend(self.stage.push(block, kernels));
        }
    }

    /// The corners since the last call that stay sharp because the spline would take longer.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        let mut notices = std::mem::take(&mut self.notices);
        notices.extend(self.stage.take_notices());
        notices
    }
}
