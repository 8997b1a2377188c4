//! Errors of the compensation.

use crate::diag::Condition;
use crate::exec::contour::motion::Motion;
use crate::exec::fault::Fault;

pub(super) type Fallible<T> = Result<T, Box<Fault>>;

/// The contour is too tight for the tool radius: K-0115, or the ID of the vendor for a tool that would run back along a line
/// (90019) or once round an arc (90038).
///
/// Source: TF5200 diagnosis 261669259, 261704075.
pub(super) fn too_tight(condition: Condition, motion: &Motion) -> Box<Fault> {
    let text = "the contour is too tight for the tool radius";
    Fault::new(condition, text, motion.span).in_block(motion.source)
}
