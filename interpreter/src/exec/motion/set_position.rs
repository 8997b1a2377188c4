//! `X[SET_POSITION POS=100]`, `X[SET_POSITION OFFSET=-5]`: assigns another position to an axis at standstill, without motion.
//!
//! As for independent axes, the coordinates of the path do not contain the jump ([`Independent::way`]), so that they stay
//! continuous. The simulation adds it to the path. Zero offsets and coordinate systems do not change: the program continues
//! from the new position.
//!
//! Assumption: the path stops and every axis settles in its window first, so that no following error is lost with the old
//! position.
//!
//! Source: TF5200 programming manual, setting an axis position in the channel (482566155).
//!
//! [`Independent::way`]: super::state::Independent::way

use crate::diag::Condition;
use crate::exec::commands::keys::arguments;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::Sync;
use crate::syntax::ast::{Group, Item, Span};

arguments! {
    /// Keys of `X[SET_POSITION]`.
    struct SetPositionArguments {
        position: Number "POS", "mm", "the new position of the axis, without offsets";
        offset: Number "OFFSET", "mm", "instead of POS: change of the position";
    }
}

impl Decoder {
    /// `X[SET_POSITION ..]`; `rest`: the text after the first word.
    pub(in crate::exec) fn set_position(
        &mut self,
        axis: usize,
        rest: &[Item],
        span: Span,
    ) -> Outcome<()> {
        self.motion.couplings.moves_not_coupled(axis, &self.machine, span)?;
        let title = format!("{}[SET_POSITION]", self.names.name(axis));
        if self.geometry.scale.changes(axis) {
            return Err(Fault::unsupported(format!("{title} with #SCALE"), span));
        }
        let group = Group { items: rest.to_vec(), span };
        let keys = SetPositionArguments::read(self, &title, Some(&group))?;
        if self.motion.independent.open.contains(&axis) {
            self.join(vec![axis]);
        }
        let unit = self.modal.axis_unit(&self.machine.axes[axis]);
        let target = self.geometry.coordinates.target()[axis];
        let offset_mm = match (keys.position, keys.offset) {
            (Some((position, _)), None) => position * unit - target,
            (None, Some((offset, _))) => offset * unit,
            (position, _) => {
                let number = if position.is_none() { "needs" } else { "takes only one of" };
                let text = format!("{title} {number} POS or OFFSET");
                let hint = format!("write {}[SET_POSITION POS=100]", self.names.name(axis));
                return Err(Fault::new(Condition::TokenUnknown, text, span).hint(hint));
            }
        };
        self.shift_position(axis, offset_mm, false);
        Ok(())
    }

    /// Replaces the setpoint of an axis at standstill; `moves`: the axis follows.
    pub(in crate::exec) fn shift_position(&mut self, axis: usize, offset_mm: f64, moves: bool) {
        self.sync(Sync::SetPosition { axis, offset_mm, moves });
        let mut target = self.geometry.coordinates.target().clone();
        target[axis] += offset_mm;
        self.motion.independent.way[axis] += offset_mm;
        self.geometry.coordinates.set_target(&target);
    }
}
