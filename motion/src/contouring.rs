//! Polynomial contouring (G61, G261, `#CONTOUR MODE`): a stage between program and planner.
//!
//! At the end of every block with [`Block::contour`] the corner is replaced by a curve ([`blend`]): the block and the
//! next relevant one are shortened by the corner distances, and each part of the curve gets the number of the block that it
//! belongs to ([`BlockLimit`](crate::block::BlockLimit)). Where that is not possible the corner is kept as programmed, and a
//! [`Notice`] gives the reason.
//! The stage holds one such block and the blocks after it that are too short to be relevant, at most [`SKIPPED`] of them.
//!
//! Order of calls: [`Contouring::push`] for each block returns the final blocks and curves; [`Contouring::flush`] where
//! the path stops. Where it only waits ([`Contouring::stop_here`]), [`Contouring::push_behind_stop`] and
//! [`Contouring::flush_behind_stop`] take their places.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::block::{ContourMode, ContourSettings};
//! use kontur_motion::contouring::Contouring;
//! use kontur_motion::tolerance::Kernels;
//!
//! let mut stage = Contouring::new(CycleTime::DEFAULT);
//! let mut first = block(1, [0.0, 0.0], [10.0, 0.0], 100.0);
//! first.contour = Some(ContourSettings::default());
//! let none = Kernels::default();
//! assert_eq!(stage.push(first, &none).count(), 0);
//! let rounded: Vec<Block> = stage.push(block(2, [10.0, 0.0], [10.0, 10.0], 100.0), &none).collect();
//! // what is left of the first block, then the first half of the curve in its name
//! assert!(rounded[0].path.is_straight() && !rounded[1].path.is_straight());
//! let limit = rounded.iter().position(|b| b.seq == 2).unwrap();
//! let corner = rounded[limit].path.start();
//! assert!((10.0 - corner[0] - corner[1]).abs() < 1e-12);
//! // and what is left of the second, whose own end stays as it is
//! assert!(rounded.iter().rposition(|b| b.path.is_straight()) == Some(rounded.len() - 1));
//! assert_eq!(stage.flush().count(), 0);
//! ```

mod blend;
mod notice;
mod parts;
mod rounding;

use crate::block::{Block, ChannelDynamics, ContourMode, ContourSettings, Feed};
use crate::path::Path;
use crate::tolerance::Kernels;
use crate::worth::{Monitored, OnlyPlanned, Part, Passage};
use kontur_filters::time::CycleTime;
use parts::Parts;
pub(crate) use rounding::NEEDLE_RAD;
use rounding::{Curve, curve};
use std::sync::Arc;

pub use notice::{NoContour, Notice};
pub use rounding::is_tangential;

/// Number of consecutive blocks too short to be relevant, after which one of them counts all the same.
const SKIPPED: usize = 100;
/// A remainder of a block between two curves that is shorter than this share of the block counts as rounding.
const ROUNDING: f64 = 1e-12;

/// See [`Passage::corner_share`]. Assumption: where a curve takes more of the filter, the speed that its bends permit is the
/// safer estimate.
const AS_CORNER: f64 = 0.5;

/// A block whose start may already be part of a curve.
#[derive(Debug)]
struct Held {
    block: Block,
    /// Path length at which the remaining part of the block begins.
    from: f64,
}

/// The contouring stage.
#[derive(Debug)]
pub struct Contouring {
    cycle: CycleTime,
    held: Option<Held>,
    skipped: Vec<Block>,
    /// Number of those before a stop at the corner.
    stop: Option<usize>,
    ready: Vec<Block>,
    /// Number of those that belong to the block before the corner and to earlier ones.
    before_limit: usize,
    notices: Vec<Notice>,
    /// Limits as given, and with the jerk check of the settings.
    checked: Option<(Arc<ChannelDynamics>, Arc<ChannelDynamics>)>,
}

impl Contouring {
    /// An empty stage.
    pub fn new(cycle: CycleTime) -> Self {
        let (skipped, ready, notices) = (Vec::new(), Vec::new(), Vec::new());
        Self {
            cycle,
            held: None,
            skipped,
            stop: None,
            ready,
            before_limit: 0,
            notices,
            checked: None,
        }
    }

    /// Whether [`Self::push`] would return this block at once and alone: no corner at it is rounded, and no block is
    /// held.
    pub fn passes(&self, block: &Block) -> bool {
        block.contour.is_none() && self.held.is_none()
    }

    /// Takes a block and returns the final ones. `kernels`: the filters of the axes, for `ACC_FACT` and `AX_DEV` at
    /// corners.
    pub fn push<'a>(
        &'a mut self,
        block: Block,
        kernels: &Kernels,
    ) -> impl Iterator<Item = Block> + use<'a> {
        self.take(block, kernels);
        self.ready.drain(..)
    }

    /// Lets the path stop after the block pushed last, if a corner there may become a curve; the stop is then at the end of
    /// the block before the curve. False if it is not, or if the path already stops before that block.
    pub fn stop_here(&mut self) -> bool {
        let here = self.skipped.len();
        let may = self.held.is_some() && self.stop.is_none_or(|stop| stop == here);
        if may {
            self.stop = Some(here);
        }
        may
    }

    /// As [`Self::push`] after [`Self::stop_here`]: the blocks before the stop, and those after it. Both are empty while the
    /// block after the corner is not known.
    pub fn push_behind_stop(&mut self, block: Block, kernels: &Kernels) -> [Vec<Block>; 2] {
        self.take(block, kernels);
        self.parted()
    }

    /// Returns everything that is held, where the path stops after the last block.
    pub fn flush(&mut self) -> impl Iterator<Item = Block> + '_ {
        self.keep_corner();
        self.ready.drain(..)
    }

    /// As [`Self::flush`] after [`Self::stop_here`].
    pub fn flush_behind_stop(&mut self) -> [Vec<Block>; 2] {
        self.keep_corner();
        self.parted()
    }

    fn keep_corner(&mut self) {
        if let Some(held) = self.held.take() {
            self.notice(held.block.seq, NoContour::NothingFollows);
            self.emit_sharp(held);
        }
    }

    /// The held block, with its corner as programmed, and the short ones after it.
    fn emit_sharp(&mut self, held: Held) {
        self.emit(held, None);
        let before_stop = self.stop.take().unwrap_or_default().min(self.skipped.len());
        self.ready.extend(self.skipped.drain(..before_stop));
        self.before_limit = self.ready.len();
        self.ready.append(&mut self.skipped);
    }

    fn parted(&mut self) -> [Vec<Block>; 2] {
        let after = self.ready.split_off(self.before_limit.min(self.ready.len()));
        self.before_limit = 0;
        [std::mem::take(&mut self.ready), after]
    }

    /// The corners since the last call that were not contoured as programmed.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    fn notice(&mut self, seq: u64, reason: NoContour) {
        self.notices.push(Notice { seq, reason });
    }

    fn take(&mut self, block: Block, kernels: &Kernels) {
        let waits = self.held.take().and_then(|held| Some((held.block.contour?, held)));
        let Some((settings, held)) = waits else {
            self.hold(Held { block, from: 0.0 });
            return;
        };
        if !relevant(&block, &settings) && self.skipped.len() < SKIPPED {
            self.skipped.push(block);
            self.held = Some(held);
            return;
        }
        let seq = held.block.seq;
        let mut from = 0.0;
        match self.rounded(&held, &block, &settings, kernels) {
            Ok(Some((curve, parts))) => {
                let soft = matches!(
                    settings.mode,
                    ContourMode::DistSoft { .. } | ContourMode::DistMaster { .. }
                );
                if soft {
                    self.notice(seq, NoContour::ModeReplaced);
                }
                self.emit(held, Some(curve.pre_mm));
                let of_held = parts.iter().filter(|(part, _)| part.seq == seq).count();
                self.before_limit = self.ready.len() + of_held;
                self.ready.extend(parts.into_iter().map(|(part, _)| part));
                self.skipped.clear();
                self.stop = None;
                from = curve.post_mm;
            }
            refused => {
                if let Err(reason) = refused {
                    self.notice(seq, reason);
                }
                self.emit_sharp(held);
            }
        }
        self.hold(Held { block, from });
    }

    /// The curve at the corner between the held block and the next relevant one, with its blocks and their speeds in mm/s; `None`
    /// if nothing is to be rounded there.
    fn rounded(
        &mut self,
        held: &Held,
        block: &Block,
        settings: &ContourSettings,
        kernels: &Kernels,
    ) -> Result<Option<(Curve, Parts)>, NoContour> {
        let Some(curve) = curve(held, &self.skipped, block, settings)? else { return Ok(None) };
        let parts = self.parts(&held.block, block, &curve, settings);
        // an interim point and an end speed are programmed explicitly
        let demanded = matches!(settings.mode, ContourMode::Pos { .. })
            || held.block.end_velocity_mm_s.is_some();
        let monitored = match Monitored::between([&held.block, block], kernels, self.cycle) {
            Ok(monitored) if !demanded => monitored,
            Ok(_) | Err(OnlyPlanned) => return Ok(Some((curve, parts))),
        };
        let passage = Passage {
            from: &held.block,
            bridged: &self.skipped,
            to: block,
            cycle: self.cycle,
            kernel_active: kernels.any(),
            monitored,
            corner_share: AS_CORNER,
        };
        let bent = passage.monitored.is_some();
        let timed = |(block, v_mm_s): &(Block, f64)| match &block.path {
            Path::Curve(path) => Some(Part::of(path, path.length(), *v_mm_s, bent)),
            _ => None,
        };
        let timed: Vec<Part> = parts.iter().filter_map(timed).collect();
        let corner = held.block.path.end();
        let interim = curve.blend.interim();
        let off = corner.iter().zip(interim.iter()).map(|(c, i)| (i - c).abs());
        let off_mm = off.fold(0.0, f64::max);
        if passage.is_worth(&timed, [curve.pre_mm, curve.post_mm], off_mm) {
            Ok(Some((curve, parts)))
        } else {
            Err(NoContour::Slower)
        }
    }

    /// A block whose end is not rounded is final.
    fn hold(&mut self, held: Held) {
        if held.block.contour.is_some() {
            self.held = Some(held);
        } else {
            self.emit(held, None);
        }
    }

    /// Outputs the remaining part of a block after the curve at its start and, `pre` mm before its end, the one at its
    /// end.
    fn emit(&mut self, Held { mut block, from }: Held, pre: Option<f64>) {
        let whole = block.path.length();
        let to = whole - pre.unwrap_or(0.0);
        if to - from <= ROUNDING * whole {
            return;
        }
        if from > 0.0 || pre.is_some() {
            block.feed = speed(&block);
            if let Some(path) = block.path.section(from, to) {
                block.path = path;
            }
        }
        block.contour = None;
        self.ready.push(block);
    }
}

/// Feed of a block that is shortened: a duration is converted to the speed it means.
fn speed(block: &Block) -> Feed {
    match block.feed {
        Feed::Duration(t) => Feed::PathVelocity(block.path.length() / t),
        feed => feed,
    }
}

fn is_feed(block: &Block, i: usize) -> bool {
    block.dynamics.feed_axes.get(i).copied().unwrap_or(true)
}

/// Whether a block is long enough to be the block after a corner.
fn relevant(block: &Block, settings: &ContourSettings) -> bool {
    let (start, end) = (block.path.start(), block.path.end());
    let track = (0..start.len())
        .filter(|&i| !is_feed(block, i))
        .map(|i| (end[i] - start[i]).abs())
        .fold(0.0, f64::max);
    block.path.length() >= settings.relevant_path_mm || track > settings.relevant_track_deg
}
