//! Curves with a sharp turn inside, in parts.
//!
//! A block has one path velocity, that of its sharpest point. The curve of an Akima spline that reverses turns within
//! micrometres, and with a single velocity all of it would be as slow as its tip. Such a curve becomes several blocks
//! with the same number, each with the velocity of its part. Their boundaries limit nothing, as direction and curvature
//! are continuous.
//!
//! Curves whose parts would not save half of the time stay whole, so that an ordinary spline keeps the one profile per
//! block that its slope requires. So do blocks with a feed that refers to the whole block (G194), and blocks with a
//! function at every transition (G116, G901).

use crate::block::{Block, Feed};
use crate::limits::{PathExtremes, PathSpeeds};
use crate::path::{Path, PolyPath};

/// Ratio of the time of the whole block at one velocity to that of its parts at which dividing it pays off.
const WORTH: f64 = 2.0;
/// The same ratio for two neighbouring sub-intervals of one part.
const APART: f64 = 1.1;

/// A section of a curve, by its sub-intervals.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: usize,
    to: usize,
    length_mm: f64,
    v_mm_s: f64,
}

impl Stretch {
    fn seconds(&self) -> f64 {
        self.length_mm / self.v_mm_s
    }

    fn and(&self, next: &Self) -> Self {
        Self {
            from: self.from,
            to: next.to,
            length_mm: self.length_mm + next.length_mm,
            v_mm_s: self.v_mm_s.min(next.v_mm_s),
        }
    }
}

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
    if whole * WORTH > programmed {
        return None;
    }
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut least_s = 0.0;
    for cell in 0..curve.cells() {
        let path = Path::Curve(Box::new(curve.section(cell, cell + 1)?));
        let (length_mm, v_mm_s) = (path.length(), speed(&path).highest().min(programmed));
        let mut stretch = Stretch { from: cell, to: cell + 1, length_mm, v_mm_s };
        least_s += stretch.seconds();
        while let Some(before) = stretches.last() {
            let both = before.and(&stretch);
            if both.seconds() > APART * (before.seconds() + stretch.seconds()) {
                break;
            }
            stretch = both;
            stretches.pop();
        }
        stretches.push(stretch);
    }
    if curve.length() / whole < WORTH * least_s {
        return None;
    }
    let last = stretches.len() - 1;
    let part = |(i, stretch): (usize, Stretch)| {
        let path = curve.section(stretch.from, stretch.to)?;
        let feed = match block.feed {
            Feed::Duration(t) => Feed::Duration(t * path.length() / curve.length()),
            feed => feed,
        };
        let end_velocity_mm_s = block.end_velocity_mm_s.filter(|_| i == last);
        Some(Block { path: Path::Curve(Box::new(path)), feed, end_velocity_mm_s, ..block.clone() })
    };
    stretches.into_iter().enumerate().map(part).collect()
}

/// A first check: whether the speeds permitted by centripetal acceleration alone differ enough.
fn is_uneven(curve: &PolyPath) -> bool {
    let (mut sharpest, mut seconds, mut from) = (0.0_f64, 0.0, 0.0);
    for (end, bend) in curve.bends() {
        seconds += (end - from) * bend.sqrt();
        (sharpest, from) = (sharpest.max(bend), end);
    }
    curve.length() * sharpest.sqrt() > WORTH * seconds
}
