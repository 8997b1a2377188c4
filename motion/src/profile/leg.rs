//! One change of speed of a TRAPEZ or SIN2 slope: the acceleration rises, stays constant and falls back to zero.
//!
//! A leg always runs from the lower to the higher velocity. A braking leg is its mirror image in time, so the same
//! formulas serve both; only ramp times and plateau differ.

use super::phase::Phase;
use super::ramp::RampShape;
use super::roots::{increasing_root, monotone_cubic};

/// Ramp times below this count as a step of the acceleration; the parameter lists are in whole microseconds.
const SHORTEST_RAMP_S: f64 = 1e-9;

/// Limits of a leg and all quantities that depend on them alone.
///
/// Symbols: plateau `a`, ramp times `t1` (rise) and `t2` (fall), gain of velocity `Δ`. `a (t1 + t2)/2` is the smallest
/// gain that reaches the plateau; a leg below it is *short*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LegLimits {
    shape: RampShape,
    constant_ramp_time: bool,
    a: f64,
    t1: f64,
    t2: f64,
    /// `t1 + t2`.
    ramps: f64,
    /// `a (k1 t1² + t1 t2/2 + k2 t2²)`: distance from rest of the leg that just reaches the plateau.
    shoulder: f64,
    /// `a c (t1² - t2²)`, the part of a full leg that vanishes for equal ramps.
    skew: f64,
    /// Smallest gain of velocity that reaches the plateau.
    gain_full: f64,
    /// `1/a` and `1/gain_full`, stored because divisions dominate the latency of these formulas.
    per_a: f64,
    per_gain_full: f64,
}

/// A ramp time in s, or 0 for a step.
fn counted(ramp_s: f64) -> f64 {
    if ramp_s >= SHORTEST_RAMP_S { ramp_s } else { 0.0 }
}

impl LegLimits {
    pub(super) fn new(
        shape: RampShape,
        constant_ramp_time: bool,
        a: f64,
        rise_s: f64,
        fall_s: f64,
    ) -> Self {
        debug_assert!(a > 0.0 && a.is_finite());
        let (t1, t2) = (counted(rise_s), counted(fall_s));
        let k1 = shape.rise_factor();
        let k2 = 0.5 - k1;
        // c = 1/24 (TRAPEZ), 1/8 - 1/π² (SIN2): both are k1 - 1/8
        let c = k1 - 0.125;
        Self {
            shape,
            constant_ramp_time,
            a,
            t1,
            t2,
            ramps: t1 + t2,
            shoulder: a * (k1 * t1 * t1 + 0.5 * t1 * t2 + k2 * t2 * t2),
            skew: a * c * (t1 - t2) * (t1 + t2),
            gain_full: 0.5 * a * (t1 + t2),
            per_a: 1.0 / a,
            per_gain_full: 2.0 / (a * (t1 + t2)),
        }
    }

    pub(super) fn plateau(&self) -> f64 {
        self.a
    }

    /// Times of the rise to the plateau and of the fall.
    pub(super) fn ramps_s(&self) -> [f64; 2] {
        [self.t1, self.t2]
    }

    /// Time of both ramps if a short leg keeps them, otherwise 0.
    pub(super) fn constant_ramps_s(&self) -> f64 {
        if self.constant_ramp_time { self.ramps } else { 0.0 }
    }

    /// The same shape with another plateau and one time for both ramps.
    pub(super) fn with(&self, a: f64, ramp_s: f64) -> Self {
        Self::new(self.shape, self.constant_ramp_time, a, ramp_s, ramp_s)
    }

    /// The same ramp times with `ratio` of the plateau.
    pub(super) fn scaled(&self, ratio: f64) -> Self {
        Self::new(self.shape, self.constant_ramp_time, ratio * self.a, self.t1, self.t2)
    }

    /// The smallest plateau of these and others, with ramps of the smallest jerk.
    pub(super) fn weakest<'a>(&self, others: impl Iterator<Item = &'a Self>) -> Self {
        let [mut a, mut t1, mut t2] = [self.a, self.t1, self.t2];
        for other in others {
            let least = a.min(other.a);
            let ramp = |own: f64, theirs: f64| counted(least * (own / a).max(theirs / other.a));
            (t1, t2) = (ramp(t1, other.t1), ramp(t2, other.t2));
            a = least;
        }
        Self::new(self.shape, self.constant_ramp_time, a, t1, t2)
    }

    /// Shape, plateau, first and second ramp time, if a short leg has the same jerk.
    pub(super) fn scalable(&self) -> Option<(RampShape, f64, [f64; 2])> {
        (!self.constant_ramp_time).then_some((self.shape, self.a, self.ramps_s()))
    }

    /// Whether plateau and ramp times of both are `same`; false unless both are [scalable](Self::scalable).
    pub(super) fn has_same_rates(&self, other: &Self, same: impl Fn(f64, f64) -> bool) -> bool {
        same(self.a, other.a)
            && !self.constant_ramp_time
            && !other.constant_ramp_time
            && same(self.t1, other.t1)
            && same(self.t2, other.t2)
    }

    /// Whether plateau and ramps differ by at most `ratio`.
    pub(super) fn nearly_equals(&self, other: &Self, ratio: f64) -> bool {
        let near = |x: f64, y: f64| (x - y).abs() <= ratio * x.max(y);
        self.shape == other.shape
            && self.constant_ramp_time == other.constant_ramp_time
            && near(self.a, other.a)
            && near(self.t1, other.t1)
            && near(self.t2, other.t2)
    }

    /// Distance of the leg from `v` to `v + gain`.
    pub(super) fn distance(&self, v: f64, gain: f64) -> f64 {
        if gain >= self.gain_full {
            let plateau = gain * self.per_a;
            v * (plateau + 0.5 * self.ramps) + 0.5 * gain * (plateau + self.t2) + self.skew
        } else if gain <= 0.0 {
            0.0
        } else {
            let ratio = gain * self.per_gain_full;
            if self.constant_ramp_time {
                v * self.ramps + self.shoulder * ratio
            } else {
                ratio.sqrt() * (v * self.ramps + self.shoulder * ratio)
            }
        }
    }

    /// [`Self::distance`] and its derivative with respect to the gain; for a short leg of constant jerk `gain > 0`.
    fn distance_and_slope(&self, v: f64, gain: f64) -> (f64, f64) {
        if gain >= self.gain_full {
            (self.distance(v, gain), (v + gain) * self.per_a + 0.5 * self.t2)
        } else {
            let ratio = gain * self.per_gain_full;
            let root = ratio.sqrt();
            let (linear, cubic) = (v * self.ramps, self.shoulder * ratio);
            (root * (linear + cubic), 0.5 * self.per_gain_full * (linear + 3.0 * cubic) / root)
        }
    }

    /// Duration of a leg with this gain.
    pub(super) fn duration(&self, gain: f64) -> f64 {
        if gain >= self.gain_full {
            gain / self.a + 0.5 * self.ramps
        } else if gain <= 0.0 {
            0.0
        } else if self.constant_ramp_time {
            self.ramps
        } else {
            (gain / self.gain_full).sqrt() * self.ramps
        }
    }

    /// Largest gain of velocity from `v` within `length`.
    pub(super) fn reach(&self, v: f64, length: f64) -> f64 {
        let to_plateau = v * self.ramps + self.shoulder;
        if length >= to_plateau {
            self.quadratic(v, 0.0).root(length).max(self.gain_full)
        } else if length <= 0.0 {
            0.0
        } else if self.constant_ramp_time {
            self.quadratic_short(v, 0.0).root(length).max(0.0)
        } else {
            let root = monotone_cubic(self.shoulder, v * self.ramps, length);
            self.gain_full * root * root
        }
    }

    /// Distance of a full leg from `v` to `v + gain + x` as a polynomial in `x`.
    fn quadratic(&self, v: f64, gain: f64) -> Quadratic {
        let plateau = gain * self.per_a;
        Quadratic {
            c2: 0.5 / self.a,
            c1: (v + gain) / self.a + 0.5 * self.t2,
            c0: v * (plateau + 0.5 * self.ramps) + 0.5 * gain * (plateau + self.t2) + self.skew,
        }
    }

    /// As [`Self::quadratic`] for a short leg of constant ramp time.
    fn quadratic_short(&self, v: f64, gain: f64) -> Quadratic {
        let c1 = self.shoulder / self.gain_full;
        Quadratic { c2: 0.0, c1, c0: v * self.ramps + c1 * gain }
    }

    /// Rise, plateau and fall of the leg from `v` to `v + gain` over `distance` (that of the limits), with its time
    /// scaled by `stretch` (close to 1): velocities stay, distance scales with time.
    ///
    /// Rise and plateau are computed from the start, the fall from the end, so that both ends are met exactly.
    pub(super) fn phases(&self, v: f64, gain: f64, distance: f64, stretch: f64) -> [Phase; 3] {
        let (plateau, ramp, tc) = if gain >= self.gain_full {
            (self.a, 1.0, gain / self.a - 0.5 * self.ramps)
        } else if gain <= 0.0 {
            (0.0, 0.0, 0.0)
        } else if self.constant_ramp_time {
            (self.a * gain / self.gain_full, 1.0, 0.0)
        } else {
            let ratio = (gain / self.gain_full).sqrt();
            (self.a * ratio, ratio, 0.0)
        };
        let a = plateau / stretch;
        let [t1, tc, t2] = [self.t1 * ramp, tc.max(0.0), self.t2 * ramp].map(|t| t * stretch);
        let jerk = |t: f64| if t > 0.0 { a / t } else { 0.0 };
        let rise = Phase::state(0.0, v, 0.0).ramp(self.shape, jerk(t1), t1);
        // a ramp of zero duration is a jump
        let shoulder = rise.end();
        let hold = Phase::state(shoulder.s, shoulder.v, a).ramp(self.shape, 0.0, tc);
        let way = t2 * (v + gain - self.shape.rise_factor() * a * t2);
        let fall = Phase::state(distance * stretch - way, v + gain - 0.5 * a * t2, a);
        [rise, hold, fall.ramp(self.shape, -jerk(t2), t2)]
    }
}

/// `c2 x² + c1 x + c0` with `c2, c1 >= 0`.
#[derive(Clone, Copy, Debug)]
struct Quadratic {
    c2: f64,
    c1: f64,
    c0: f64,
}

impl Quadratic {
    fn plus(self, other: Self) -> Self {
        Self { c2: self.c2 + other.c2, c1: self.c1 + other.c1, c0: self.c0 + other.c0 }
    }

    /// The root of `... = value` on the increasing branch; 0 if that is negative.
    fn root(self, value: f64) -> f64 {
        let d = value - self.c0;
        if d <= 0.0 {
            0.0
        } else {
            2.0 * d / (self.c1 + (self.c1 * self.c1 + 4.0 * self.c2 * d).sqrt())
        }
    }
}

/// The two legs of a span that meet at the peak velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegPair<'a> {
    pub(super) up: &'a LegLimits,
    pub(super) down: &'a LegLimits,
    pub(super) v0: f64,
    pub(super) ve: f64,
}

impl LegPair<'_> {
    /// Gains of both legs for the peak that uses up `length`; the peak is between `max(v0, ve)`, which only needs
    /// `least`, and `v_max`, which needs `most`.
    ///
    /// With constant ramp time the distance jumps when a leg appears; for a length within the jump the lower peak is
    /// used and the remaining distance is cruised.
    pub(super) fn gains(&self, v_max: f64, length: f64, least: f64, most: f64) -> (f64, f64) {
        let Self { up, down, v0, ve } = *self;
        let top = v0.max(ve);
        let (up_base, down_base) = (top - v0, top - ve);
        let distance = |x: f64| up.distance(v0, up_base + x) + down.distance(ve, down_base + x);

        // narrow the interval to where neither leg changes between short and full
        let (up_knee, down_knee) = (up.gain_full - up_base, down.gain_full - down_base);
        let (mut lo, mut hi) = (0.0, v_max - top);
        let (mut at_lo, mut at_hi) = (least, most);
        for knee in [up_knee.min(down_knee), up_knee.max(down_knee)] {
            if knee > lo && knee < hi {
                let at_knee = distance(knee);
                if at_knee <= length {
                    (lo, at_lo) = (knee, at_knee);
                } else {
                    (hi, at_hi) = (knee, at_knee);
                }
            }
        }
        let (up_full, down_full) = (lo >= up_knee, lo >= down_knee);

        if up.constant_ramp_time || (up_full && down_full) {
            let part = |leg: &LegLimits, full: bool, v: f64, gain: f64| {
                if full { leg.quadratic(v, gain) } else { leg.quadratic_short(v, gain) }
            };
            let sum = part(up, up_full, v0, up_base).plus(part(down, down_full, ve, down_base));
            let x = sum.root(length).clamp(lo, hi);
            (up_base + x, down_base + x)
        } else if !up_full && (down_full || v0 >= ve) {
            let bracket = [(up_base + lo, at_lo), (up_base + hi, at_hi)];
            let gain = short_gain(up, v0, down, ve, !down_full, bracket, length);
            (gain, (v0 - ve) + gain)
        } else {
            let bracket = [(down_base + lo, at_lo), (down_base + hi, at_hi)];
            let gain = short_gain(down, ve, up, v0, !up_full, bracket, length);
            ((ve - v0) + gain, gain)
        }
    }
}

/// Gain of a short leg of constant jerk from `v`, such that it and the other leg from `w` use up `length`.
///
/// The unknown is `λ`, the ratio of the ramp times of the short leg to the full ones: the gain is `g λ²`, the distance
/// a cubic in `λ`. The total is increasing and convex in `λ` (so is the other leg, given `w <= v` if it is short), so
/// Newton's method converges from any start. `bracket`: smallest and largest gain with the total at both.
fn short_gain(
    leg: &LegLimits,
    v: f64,
    other: &LegLimits,
    w: f64,
    other_short: bool,
    bracket: [(f64, f64); 2],
    length: f64,
) -> f64 {
    let linear = v * leg.ramps;
    let cubic = leg.shoulder;
    let full = leg.gain_full;
    let offset = v - w;
    if other_short && offset <= 0.0 {
        // equal end velocities: both legs shrink in proportion
        let k = (full / other.gain_full).sqrt();
        let c3 = cubic + other.shoulder * k * k * k;
        let root = monotone_cubic(c3, v * (leg.ramps + other.ramps * k), length);
        return full * root * root;
    }
    let [(lo, at_lo), (hi, at_hi)] = bracket;
    let (lo, hi) = ((lo / full).sqrt(), (hi / full).sqrt());
    // start from a cubic through both ends with the correct slope at λ = 0
    let c3 = (at_hi - at_lo - linear * (hi - lo)) / (hi * hi * hi - lo * lo * lo);
    let guess = monotone_cubic(c3, linear, length - at_lo + lo * (linear + c3 * lo * lo));
    let root = increasing_root(lo, hi, guess, 1e-10, |x| {
        let gain = full * x * x;
        let (other, slope) = other.distance_and_slope(w, offset + gain);
        let value = x * (linear + cubic * x * x) + other - length;
        (value, linear + 3.0 * cubic * x * x + 2.0 * full * x * slope)
    });
    full * root * root
}
