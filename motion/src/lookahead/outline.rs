//! What every pass reads of a block and of the boundary before it.
//!
//! A window is passed over many times, and again in every round of `AX_DEV`. A block lies in several places of memory, and
//! those of a window do not fit into the first cache of a processor; its outlines do. They depend on the blocks alone and
//! stay valid while the window moves on or its limits are lowered, see [`super::Draft`].

use crate::profile::{Rates, SlopeLimits};
use crate::queue::Queued;
use std::sync::Arc;

/// Relative difference up to which limits of two blocks count as equal: rounding.
pub(super) const ALIKE: f64 = 1e-6;

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
    likeness: Likeness,
}

/// What the slope of a block has in common with that of the block before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Likeness {
    Nothing,
    /// How it is programmed.
    Programmed,
    /// Its rates as well, up to rounding.
    Rates,
}

impl Likeness {
    fn of(queued: &Queued, before: &Queued) -> Self {
        let same = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.abs();
        if queued.block.slope != before.block.slope {
            Self::Nothing
        } else if before.slope.has_same_rates(&queued.slope, same) {
            Self::Rates
        } else {
            Self::Programmed
        }
    }
}

impl Outline {
    fn of(queued: &Arc<Queued>, before: Option<&Arc<Queued>>) -> Self {
        let length = queued.length;
        Self {
            length,
            gain: rates(queued).map(|r| (2.0 * length * r.acc, 2.0 * length * r.dec)),
            plans_across: queued.plans_across(),
            may_brake_late: queued.may_brake_late(),
            likeness: before.map_or(Likeness::Nothing, |before| Likeness::of(queued, before)),
            queued: Arc::clone(queued),
        }
    }

    /// Whether the slope is programmed as in the block before.
    pub(super) fn same_slope(&self) -> bool {
        self.likeness >= Likeness::Programmed
    }

    /// Whether the rates are also those of the block before, up to rounding.
    pub(super) fn same_rates(&self) -> bool {
        self.likeness == Likeness::Rates
    }
}

/// Rates of the limits of a block; `None` with STEP and with constant ramp times.
pub(super) fn rates(block: &Queued) -> Option<Rates> {
    match &block.slope {
        SlopeLimits::Ramped(limits) => limits.rates(),
        SlopeLimits::Step(_) => None,
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
