//! The moment at which a rise has to be left so that its ramp down to zero just keeps the velocity of a block.

use super::{Climb, Touch};
use crate::profile::Phase;
use crate::ride::{Block, SLACK, is_drop};

/// Steps to the moment at which a ramp reaches the velocity of a block, and the step in s below which it is found.
const STEPS: u32 = 8;
const FOUND_S: f64 = 1e-13;
/// Distance in s from that moment at which the outcome is tested.
const ASIDE_S: f64 = 1e-12;

impl Climb<'_> {
    /// Two close moments of a phase, after whose end `touch` is exceeded: with a ramp down to zero from the first one all
    /// limits are kept, from the second one the velocity inside a block is exceeded. Without such moments the whole of
    /// the time axis.
    pub(super) fn around(&self, phase: &Phase, touch: Touch, v_ref: f64) -> (f64, f64) {
        let unknown = (0.0, f64::INFINITY);
        if touch != Touch::Inside {
            return unknown;
        }
        // where no limit drops, a later moment is never better, and the search may begin anywhere
        let from = if is_drop(self.least[self.c], v_ref) { phase.t } else { self.guess(phase) };
        let Some(t) = self.reaches(phase, from) else { return unknown };
        let (within, beyond) = (t - ASIDE_S, t + ASIDE_S);
        let lands = |t| self.lands(self.c, phase.after(t), v_ref);
        let is_between = within > 0.0
            && beyond < phase.t
            && lands(within).is_ok()
            && lands(beyond) == Err(Touch::Inside);
        if is_between { (within, beyond) } else { unknown }
    }

    /// The moment of a phase from which a ramp down to zero ends at the velocity of its block, if it ends there.
    fn guess(&self, phase: &Phase) -> f64 {
        let cell = &self.cells[self.c];
        let gain = cell.v * (1.0 + SLACK) - phase.v;
        let (half, down) = (0.5 / phase.j, 0.5 / cell.jerks[1]);
        let t = if phase.j > 0.0 {
            let square = (gain + phase.a * phase.a * half) / (half + down);
            (square.max(0.0).sqrt() - phase.a) / phase.j
        } else {
            gain / phase.a - phase.a * down
        };
        t.clamp(0.0, phase.t)
    }

    /// The moment of a phase, searched for from moment `t` on, from which a ramp down to zero ends at the velocity of the
    /// block in which it ends.
    fn reaches(&self, phase: &Phase, mut t: f64) -> Option<f64> {
        for _ in 0..STEPS {
            let from = phase.after(t);
            let (cell, v) = self.landing(&from)?;
            // gain of speed over this moment and the ramp, as if the whole ramp had the jerk of this block
            let excess = v - cell.v * (1.0 + SLACK);
            let next = if phase.j > 0.0 {
                let per_square = 0.5 / phase.j + 0.5 / cell.jerks[1];
                let a = (from.a * from.a - excess / per_square).max(0.0).sqrt();
                (a - phase.a) / phase.j
            } else {
                t - excess / from.a
            };
            let step = (next - t).abs();
            t = next.clamp(0.0, phase.t);
            if step <= FOUND_S {
                return Some(t);
            }
        }
        None
    }

    /// Block and speed in which a ramp down to zero from a state ends.
    fn landing(&self, from: &Phase) -> Option<(&Block, f64)> {
        #[cfg(test)]
        crate::closed_forms::add();
        let mut at = *from;
        for c in self.c.. {
            let cell = self.cells.get(c)?;
            let (_, flat) = self.ramp_in(c, &at);
            if flat.s < cell.end {
                return Some((cell, flat.v));
            }
            at = flat;
        }
        None
    }
}
