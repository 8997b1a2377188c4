//! Whether a change of speed fits into the length of a span.

/// Relative amount by which the boundary velocities may miss the length before a plan is refused.
pub(super) const LENGTH_SLACK: f64 = 1e-9;

/// The boundary velocities of a span do not fit its length; the look-ahead has to lower one of them.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("speed change requires {needed_mm} mm, the span has {length_mm} mm")]
pub struct Infeasible {
    /// Length of the span in mm.
    pub length_mm: f64,
    /// Length in mm that the change between the boundary velocities needs; infinite if the speed limit is 0.
    pub needed_mm: f64,
}

impl Infeasible {
    pub(super) fn check(needed: f64, length: f64, v_max: f64) -> Result<(), Self> {
        let stuck = length > 0.0 && v_max <= 0.0;
        // written so that NaN is refused
        if !stuck && needed <= length * (1.0 + LENGTH_SLACK) {
            Ok(())
        } else {
            let needed_mm = if stuck { f64::INFINITY } else { needed };
            Err(Self { length_mm: length, needed_mm })
        }
    }
}

/// `v + gain`, never rounded up: at high speed one unit in the last place may cost more than the length.
pub(super) fn add_rounding_down(v: f64, gain: f64) -> f64 {
    let sum = v + gain;
    if sum - v > gain { sum.next_down().max(v) } else { sum }
}
