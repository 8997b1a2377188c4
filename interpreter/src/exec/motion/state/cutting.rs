//! Active constant cutting speed.

use crate::diag::Condition;
use crate::exec::block::collected::Words;
use crate::exec::block::groups::{Act, Group};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::CuttingSpeed;
use crate::syntax::ast::Span;

/// Active G96, G97 and G196.
#[derive(Debug, Default)]
pub(in crate::exec) struct Cutting {
    /// G96 with its S word.
    pub(in crate::exec::motion) speed: Option<CuttingSpeed>,
    /// Whether G96 is active, with or without an S word so far.
    pub(in crate::exec::motion) waits: bool,
    /// S of G196 in rev/min.
    pub(in crate::exec::motion) rpm_max: Option<f64>,
}

impl Cutting {
    /// Whether G96 is active with a speed.
    pub(in crate::exec) fn is_on(&self) -> bool {
        self.speed.is_some()
    }

    /// The face turning axis of G96.
    pub(in crate::exec) fn axis(&self) -> Option<usize> {
        self.speed.map(|cutting| cutting.axis)
    }

    /// S of G196 in rev/min, 0 without one.
    pub(in crate::exec) fn most_rpm(&self) -> f64 {
        self.rpm_max.unwrap_or_default()
    }

    /// S of G96 in m/min, 0 while it is off.
    pub(in crate::exec) fn speed_m_min(&self) -> f64 {
        self.speed.map_or(0.0, |cutting| cutting.speed_mm_min / 1000.0)
    }

    /// Whether the S words of the main spindle in this block are not speeds in rev/min.
    pub(in crate::exec) fn takes_s_words(&self, words: &Words<'_>) -> bool {
        self.waits
            || words.group(Group::SpindleMode).is_some_and(|g| g.row.act == Act::CuttingSpeedMax)
    }

    /// 20642 for M19 of the main spindle under G96.
    pub(in crate::exec) fn positions_main_spindle(&self, span: Span) -> Outcome<()> {
        if self.speed.is_none() {
            return Ok(());
        }
        let text = "M19 while the cutting speed is constant (G96)";
        Err(Fault::new(Condition::PositioningWithCuttingSpeed, text, span))
    }
}
