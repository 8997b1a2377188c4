//! Acceleration, cruise and braking over one length.

use super::phase::{Phase, State};
use super::row::Profile;

/// The peak of a plan and the length it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Legs {
    pub(super) length: f64,
    pub(super) ve: f64,
    pub(super) peak: f64,
    /// Whether the peak is the feed rate rather than the solution for the length.
    pub(super) at_feed: bool,
}

impl Legs {
    /// Combines the legs such that they cover the length exactly; the second one is described backwards from the end.
    ///
    /// `up_mm`, `down_mm`: lengths of the legs without stretching. A remaining distance is cruised at the peak. A
    /// rounding error of the peak, or legs that are slightly too long, are compensated by stretching time.
    pub(super) fn profile<Leg>(
        self,
        [up_mm, down_mm]: [f64; 2],
        legs: impl FnOnce(f64) -> (Leg, Leg),
    ) -> Profile
    where
        Leg: IntoIterator<Item = Phase, IntoIter: DoubleEndedIterator>,
    {
        let Self { length, ve, peak, at_feed } = self;
        let distance = up_mm + down_mm;
        let rest = length - distance;
        let rounding = rest < 0.0 || (!at_feed && rest <= 1e-12 * length);
        let (stretch, cruise_s) = if distance > 0.0 && rounding {
            (length / distance, 0.0)
        } else if rest > 0.0 {
            (1.0, rest / peak)
        } else {
            (1.0, 0.0)
        };
        let (up, down) = legs(stretch);
        let cruise = Phase::state(up_mm * stretch, peak, 0.0).until(cruise_s);
        let down = down.into_iter().rev().map(|p| p.reversed(length));
        let end = State { s_mm: length, v_mm_s: ve, ..State::default() };
        Profile::new(up.into_iter().chain([cruise]).chain(down), end)
    }
}
