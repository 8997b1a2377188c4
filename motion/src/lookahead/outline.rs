//! What every pass reads of a block and of the boundary before it.
//!
//! A window is passed over many times, and again in every round of `AX_DEV`. A block lies in several places of memory, and
//! those of a window do not fit into the first cache of a processor; its outlines do. They depend on the blocks alone and
//! stay valid while the window moves on or its limits are lowered, see [`super::Draft`].

use super::knots::ALIKE;
use super::stretch::rates;
use crate::queue::Queued;
use std::sync::Arc;

/// A block with what it and the boundary before it mean to a plan, as far as no limit of the window is concerned.
#[derive(Clone, Debug)]
pub(super) struct Outline {
    pub(super) queued: Arc<Queued>,
    /// Length in mm.
    pub(super) length: f64,
    /// Gain of the squared speed along the block in mm2/s2, up and down; `None` where its limits have no rates.
    pub(super) gain: Option<(f64, f64)>,
    /// See [`Queued::plans_across`].
    pub(super) plans_across: bool,
    /// See [`Queued::may_brake_late`].
    pub(super) may_brake_late: bool,
    /// Whether the slope is programmed as in the block before.
    pub(super) same_slope: bool,
    /// Whether its rates are those of the block before, up to rounding.
    pub(super) same_rates: bool,
}

impl Outline {
    fn of(queued: &Arc<Queued>, before: Option<&Arc<Queued>>) -> Self {
        let length = queued.length;
        let same = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.abs();
        Self {
            length,
            gain: rates(queued).map(|r| (2.0 * length * r.acc, 2.0 * length * r.dec)),
            plans_across: queued.plans_across(),
            may_brake_late: queued.may_brake_late(),
            same_slope: before.is_some_and(|b| b.block.slope == queued.block.slope),
            same_rates: before.is_some_and(|b| b.slope.has_same_rates(&queued.slope, same)),
            queued: Arc::clone(queued),
        }
    }
}

/// Turns the outlines of an earlier window into those of another one, which mostly begins with the same blocks.
pub(super) fn follow(outlines: &mut Vec<Outline>, window: &[Arc<Queued>]) {
    outlines.truncate(window.len());
    let mut before: Option<&Arc<Queued>> = None;
    let mut same_before = true;
    for (i, queued) in window.iter().enumerate() {
        let place = outlines.get_mut(i);
        let same = place.as_ref().is_some_and(|known| Arc::ptr_eq(&known.queued, queued));
        if !same || !same_before {
            let outline = Outline::of(queued, before);
            match place {
                Some(place) => *place = outline,
                None => outlines.push(outline),
            }
        }
        (before, same_before) = (Some(queued), same);
    }
}
