//! Curves with a sharp turn inside, in parts.
//!
//! A block has one path velocity, that of its sharpest point. The curve of an Akima spline that reverses turns within
//! micrometres, and with a single velocity all of it would be as slow as its tip. Such a curve, and any other one that
//! bends more in one place than elsewhere, becomes several blocks with the same number, each with the velocity of its
//! part. Their boundaries limit nothing, as direction and curvature are continuous.
//!
//! Curves whose parts would save little stay whole. So do blocks with a feed that refers to the whole block (G194), and
//! blocks with a function at every transition (G116, G901).

use crate::block::{Block, Feed};
use crate::limits::{PathExtremes, PathSpeeds};
use crate::path::{Path, PolyPath};
use crate::sections::joined;
use std::ops::Range;

/// Share of the time that a part of its own has to save.
const WORTH: f64 = 0.03;
/// The same for the whole curve under `AX_DEV`: parts raise the speed at which the path comes to a sharp bend, and the
/// planner has to take that back.
const MONITORED_WORTH: f64 = 1.0;

/// The blocks that replace a block; `None` if it stays whole.
pub(super) fn parts(block: &Block) -> Option<Vec<Block>> {
    let Path::Curve(curve) = &block.path else { return None };
    let whole_by_nature = matches!(block.feed, Feed::ShareOfMaximum(_))
        || block.late_braking
        || block.dynamics.stop_at_transitions;
    let worth = if block.tolerance.ax_dev_mm.is_some() { MONITORED_WORTH } else { WORTH };
    if whole_by_nature || !is_uneven(curve, worth) {
        return None;
    }
    let speed = |path: &Path| PathSpeeds::of(block, &PathExtremes::of(path));
    let programmed = speed(&block.path).programmed_mm_s;
    let whole = speed(&block.path).highest().min(programmed);
    if whole * (1.0 + worth) > programmed {
        return None;
    }
    let (mut end_mm, mut least_s) = (0.0, 0.0);
    let mut sections = Vec::with_capacity(curve.cells());
    for cell in 0..curve.cells() {
        let path = Path::Curve(Box::new(curve.section(cell, cell + 1)?));
        let v_mm_s = speed(&path).highest().min(programmed);
        end_mm += path.length();
        least_s += path.length() / v_mm_s;
        sections.push((end_mm, v_mm_s));
    }
    if curve.length() / whole < (1.0 + worth) * least_s {
        return None;
    }
    let groups = joined(sections, WORTH);
    let last = groups.len().checked_sub(1).filter(|last| *last > 0)?;
    let part = |(i, range): (usize, Range<usize>)| {
        let path = curve.section(range.start, range.end)?;
        let feed = match block.feed {
            Feed::Duration(t) => Feed::Duration(t * path.length() / curve.length()),
            feed => feed,
        };
        let end_velocity_mm_s = block.end_velocity_mm_s.filter(|_| i == last);
        Some(Block { path: Path::Curve(Box::new(path)), feed, end_velocity_mm_s, ..block.clone() })
    };
    groups.into_iter().enumerate().map(part).collect()
}

/// A first check: whether the speeds permitted by centripetal acceleration alone differ enough.
fn is_uneven(curve: &PolyPath, worth: f64) -> bool {
    let (mut sharpest, mut seconds, mut from) = (0.0_f64, 0.0, 0.0);
    for (end, bend) in curve.bends() {
        seconds += (end - from) * bend.sqrt();
        (sharpest, from) = (sharpest.max(bend), end);
    }
    curve.length() * sharpest.sqrt() > (1.0 + worth) * seconds
}
