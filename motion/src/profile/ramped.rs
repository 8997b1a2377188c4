//! TRAPEZ and SIN2: the acceleration builds up and falls in ramps.

use super::fit::Infeasible;
use super::leg::{LegLimits, LegPair};
use super::legs::Legs;
use super::ramp::RampShape;
use super::row::Profile;

/// Path limits of a non-linear slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RampedLimits {
    up: LegLimits,
    down: LegLimits,
}

/// The values of a slope whose ramps become shorter with the change of acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rates {
    /// Shape of the ramps.
    pub(crate) shape: RampShape,
    /// Acceleration in mm/s2.
    pub(crate) acc: f64,
    /// Deceleration in mm/s2, positive.
    pub(crate) dec: f64,
    /// Ramp times `t1..t4` in s.
    pub(crate) ramps: [f64; 4],
}

impl Rates {
    /// The smaller accelerations with ramps of the smaller jerk.
    pub(crate) fn weaker(&self, other: &Self) -> Self {
        let plateaus = |r: &Self| [r.acc, r.acc, r.dec, r.dec];
        let (own, others) = (plateaus(self), plateaus(other));
        let ramp = |i: usize| {
            own[i].min(others[i]) * (self.ramps[i] / own[i]).max(other.ramps[i] / others[i])
        };
        Self {
            shape: self.shape,
            acc: own[0].min(others[0]),
            dec: own[2].min(others[2]),
            ramps: std::array::from_fn(ramp),
        }
    }

    /// Whether accelerations and ramp times differ by at most the given ratio.
    pub(crate) fn nearly_equals(&self, other: &Self, ratio: f64) -> bool {
        let near = |x: f64, y: f64| (x - y).abs() <= ratio * x.max(y);
        near(self.acc, other.acc)
            && near(self.dec, other.dec)
            && self.ramps.iter().zip(&other.ramps).all(|(x, y)| near(*x, *y))
    }
}

impl RampedLimits {
    /// Limits referred to the path.
    ///
    /// `acc_mm_s2`, `dec_mm_s2`: plateaus, positive. `ramps_s`: `t1..t4`, the times in which the acceleration builds up
    /// and falls and the deceleration builds up and falls; below one nanosecond they count as a step.
    /// `constant_ramp_time` (P-CHAN-00349 = 1): a speed change too small for the plateau keeps its ramp times and
    /// lowers the plateau; otherwise it keeps the jerk and shortens the ramps.
    ///
    /// Source: TF5200, P-CHAN-00071, P-CHAN-00349, P-AXIS-00001, 00002, 00195..00198.
    pub fn new(
        shape: RampShape,
        constant_ramp_time: bool,
        acc_mm_s2: f64,
        dec_mm_s2: f64,
        ramps_s: [f64; 4],
    ) -> Self {
        let [t1, t2, t3, t4] = ramps_s;
        Self {
            up: LegLimits::new(shape, constant_ramp_time, acc_mm_s2, t1, t2),
            // braking is the mirror image in time: its last ramp comes first
            down: LegLimits::new(shape, constant_ramp_time, dec_mm_s2, t4, t3),
        }
    }

    pub(super) fn with_braking(&self, dec_mm_s2: f64, ramp_s: f64) -> Self {
        Self { up: self.up, down: self.down.with(dec_mm_s2, ramp_s) }
    }

    /// Time in s of the longer change of speed with constant ramp times (P-CHAN-00349 = 1); 0 without them.
    pub(crate) fn constant_ramps_s(&self) -> f64 {
        self.up.constant_ramps_s().max(self.down.constant_ramps_s())
    }

    /// Plateaus and ramp times; `None` with constant ramp times (P-CHAN-00349 = 1).
    pub(crate) fn rates(&self) -> Option<Rates> {
        let (shape, acc, [t1, t2]) = self.up.scalable()?;
        let (_, dec, [t4, t3]) = self.down.scalable()?;
        Some(Rates { shape, acc, dec, ramps: [t1, t2, t3, t4] })
    }

    /// Accelerations times `ratio`, positive, with the same ramp times.
    pub(super) fn scaled(&self, ratio: f64) -> Self {
        Self { up: self.up.scaled(ratio), down: self.down.scaled(ratio) }
    }

    /// The weakest of these and others, leg by leg.
    pub(super) fn weakest<'a>(&self, others: impl Iterator<Item = &'a Self> + Clone) -> Self {
        Self {
            up: self.up.weakest(others.clone().map(|other| &other.up)),
            down: self.down.weakest(others.map(|other| &other.down)),
        }
    }

    pub(super) fn all(&self, other: &Self, f: impl Fn(&LegLimits, &LegLimits) -> bool) -> bool {
        f(&self.up, &other.up) && f(&self.down, &other.down)
    }

    pub(super) fn up(&self) -> &LegLimits {
        &self.up
    }

    pub(super) fn down(&self) -> &LegLimits {
        &self.down
    }

    pub(super) fn plan(
        &self,
        v0: f64,
        ve: f64,
        vf: f64,
        length: f64,
    ) -> Result<Profile, Infeasible> {
        let top = v0.max(ve);
        let distances = |up_gain: f64, down_gain: f64| {
            (self.up.distance(v0, up_gain), self.down.distance(ve, down_gain))
        };
        let (needed_up, needed_down) = distances(top - v0, top - ve);
        let vf = vf.max(top);
        Infeasible::check(needed_up + needed_down, length, vf)?;
        if length > 0.0 && vf <= v0.min(ve) {
            return Ok(Profile::even(vf, length));
        }
        let mut gains = (vf - v0, vf - ve);
        let mut parts = distances(gains.0, gains.1);
        let mut peak = vf;
        let at_feed = parts.0 + parts.1 <= length;
        if !at_feed {
            let pair = LegPair { up: &self.up, down: &self.down, v0, ve };
            gains = pair.gains(vf, length, needed_up + needed_down, parts.0 + parts.1);
            parts = distances(gains.0, gains.1);
            peak = (v0 + gains.0).clamp(top, vf);
        }
        let legs = Legs { length, ve, peak, at_feed };
        Ok(legs.profile([parts.0, parts.1], |stretch| {
            let up = self.up.phases(v0, gains.0, parts.0, stretch);
            (up, self.down.phases(ve, gains.1, parts.1, stretch))
        }))
    }
}
