//! Constant cutting speed in force.

use crate::exec::block::collected::Words;
use crate::exec::block::groups::{Act, Group};
use crate::exec::step::CuttingSpeed;

/// G96, G97 and G196 in force.
#[derive(Debug, Default)]
pub(in crate::exec) struct Cutting {
    /// G96 with its S word.
    pub(in crate::exec::motion) speed: Option<CuttingSpeed>,
    /// G96 is in force, whether or not an S word has come.
    pub(in crate::exec::motion) waits: bool,
    /// S of G196 in rev/min.
    pub(in crate::exec::motion) rpm_max: Option<f64>,
}

impl Cutting {
    /// The S words of the main spindle of this block are not speeds in rev/min.
    pub(in crate::exec) fn takes_s_words(&self, words: &Words<'_>) -> bool {
        self.waits
            || words.group(Group::SpindleMode).is_some_and(|g| g.row.act == Act::CuttingSpeedMax)
    }
}
