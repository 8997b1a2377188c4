//! Curves with a sharp turn inside, in parts.
//!
//! A block has one path velocity, that of its sharpest point. The curve of an Akima spline that reverses turns within
//! micrometres, and with a single velocity all of it would be as slow as its tip. Such a curve becomes several blocks
//! with the same number, each with the velocity of its part. Their boundaries limit nothing, as direction and curvature
//! are continuous.
//!
//! Curves whose parts would save little stay whole, as an ordinary spline does. So do blocks with a feed that refers to
//! the whole block (G194), and blocks with a function at every transition (G116, G901).

use crate::block::{Block, Feed};
use crate::limits::{PathExtremes, PathSpeeds};
use crate::path::{Path, PolyPath};
use crate::sections::joined;
use std::ops::Range;

/// Share of the time that a part of its own has to save.
const WORTH: f64 = 0.03;

/// The blocks that replace a block; `None` if it stays whole.
pub(super) fn parts(block: &Block) -> Option<Vec<Block>> {
    let Path::Curve(curve) = &block.path else { return None };
    let whole_by_nature = matches!(block.feed, Feed::ShareOfMaximum(_))
        || block.late_braking
        || block.dynamics.stop_at_transitions;
    if whole_by_nature || !is_uneven(curve) {
        return None;
    }
    let speed = |path: &Path| PathSpeeds::of(block, &PathExtremes::of(path));
    let programmed = speed(&block.path).programmed_mm_s;
    let whole = speed(&block.path).highest().min(programmed);
    if whole * (1.0 + WORTH) > programmed {
        return None;
    }
    let mut end_mm = 0.0;
    let mut sections = Vec::with_capacity(curve.cells());
    for cell in 0..curve.cells() {
        let path = Path::Curve(Box::new(curve.section(cell, cell + 1)?));
        end_mm += path.length();
        sections.push((end_mm, speed(&path).highest().min(programmed)));
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
fn is_uneven(curve: &PolyPath) -> bool {
    let (mut sharpest, mut seconds, mut from) = (0.0_f64, 0.0, 0.0);
    for (end, bend) in curve.bends() {
        seconds += (end - from) * bend.sqrt();
        (sharpest, from) = (sharpest.max(bend), end);
    }
    curve.length() * sharpest.sqrt() > (1.0 + WORTH) * seconds
}
