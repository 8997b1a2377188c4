//! STEP: the acceleration jumps between levels that depend on the velocity.

use super::fit::{Infeasible, add_rounding_down};
use super::legs::Legs;
use super::phase::Phase;
use super::ramp::RampShape;
use super::row::Profile;
use smallvec::SmallVec;

/// Two-stage limits of one axis, referred to the path (divided by its component of the tangent).
///
/// A limit without stages, such as one of `#VECTOR LIMIT`, has two equal values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepAxis {
    /// Accelerations below and above the change-over velocity in mm/s2.
    pub acc_mm_s2: [f64; 2],
    /// Decelerations below and above the change-over velocity in mm/s2.
    pub dec_mm_s2: [f64; 2],
    /// Change-over velocity in mm/s.
    pub change_mm_s: f64,
}

/// Path limits of the linear slope.
#[derive(Clone, Debug, PartialEq)]
pub struct StepLimits {
    up: Levels,
    down: Levels,
}

impl StepLimits {
    /// The lowest value of all axes at every velocity; at least one axis, values positive.
    ///
    /// Source: TF5200, P-AXIS-00011, 00012, 00282, 00283, 00221; that the weakest axis determines the limit follows
    /// from the path.
    pub fn from_axes(axes: &[StepAxis]) -> Self {
        Self {
            up: Levels::lowest(axes, |axis| axis.acc_mm_s2),
            down: Levels::lowest(axes, |axis| axis.dec_mm_s2),
        }
    }

    /// The same limits with a constant deceleration instead of the levels.
    pub(super) fn with_braking(limits: &Self, dec_mm_s2: f64) -> Self {
        let down = Levels(SmallVec::from_elem(Level { from: 0.0, a: dec_mm_s2 }, 1));
        Self { up: limits.up.clone(), down }
    }

    /// The smaller value of both at every velocity.
    pub(super) fn weaker(a: &Self, b: &Self) -> Self {
        Self { up: a.up.weaker(&b.up), down: a.down.weaker(&b.down) }
    }

    /// `ratio` of the value at every velocity.
    pub(super) fn scaled(&self, ratio: f64) -> Self {
        Self { up: self.up.scaled(ratio), down: self.down.scaled(ratio) }
    }

    pub(super) fn up(&self) -> &Levels {
        &self.up
    }

    pub(super) fn down(&self) -> &Levels {
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
        let vf = vf.max(top);
        let total = |peak: f64| self.up.distance(v0, peak) + self.down.distance(ve, peak);
        let needed = total(top);
        Infeasible::check(needed, length, vf)?;
        let peak = self.peak(top, vf, length - needed);
        let at_feed = peak >= vf;
        let legs = Legs { length, ve, peak, at_feed };
        Ok(legs.profile([self.up.distance(v0, peak), self.down.distance(ve, peak)], |stretch| {
            (self.up.phases(v0, peak, stretch), self.down.phases(ve, peak, stretch))
        }))
    }

    /// Peak above `v`, up to `v_max`, for which accelerating to it and braking back to `v` takes `length`.
    fn peak(&self, mut v: f64, v_max: f64, mut length: f64) -> f64 {
        loop {
            let (a, up_end) = self.up.level(v);
            let (d, down_end) = self.down.level(v);
            let end = up_end.min(down_end).min(v_max);
            let combined = a * d / (a + d);
            let whole = step_distance(v, end, combined);
            if whole > length {
                return add_rounding_down(v, step_gain(v, length, combined)).min(end);
            }
            if end >= v_max {
                return v_max;
            }
            length -= whole;
            v = end;
        }
    }
}

/// Acceleration as a function of velocity: level `i` holds from its velocity to that of the next.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Levels(SmallVec<[Level; 4]>);

#[derive(Clone, Copy, Debug, PartialEq)]
struct Level {
    from: f64,
    a: f64,
}

impl Levels {
    fn lowest(axes: &[StepAxis], stages: impl Fn(&StepAxis) -> [f64; 2]) -> Self {
        debug_assert!(!axes.is_empty());
        let mut starts: SmallVec<[f64; 4]> = SmallVec::from_slice(&[0.0]);
        starts.extend(axes.iter().map(|axis| axis.change_mm_s).filter(|v| *v > 0.0));
        starts.sort_by(f64::total_cmp);
        starts.dedup();
        let levels = starts.into_iter().map(|from| {
            let value = |axis: &StepAxis| stages(axis)[usize::from(from >= axis.change_mm_s)];
            Level { from, a: axes.iter().map(value).fold(f64::INFINITY, f64::min) }
        });
        Self(levels.collect())
    }

    fn scaled(&self, ratio: f64) -> Self {
        Self(self.0.iter().map(|level| Level { from: level.from, a: ratio * level.a }).collect())
    }

    fn weaker(&self, other: &Self) -> Self {
        let mut starts: SmallVec<[f64; 8]> =
            self.0.iter().chain(&other.0).map(|level| level.from).collect();
        starts.sort_by(f64::total_cmp);
        starts.dedup();
        let at = |from: f64| self.level(from).0.min(other.level(from).0);
        Self(starts.into_iter().map(|from| Level { from, a: at(from) }).collect())
    }

    /// Pieces of the velocity range `v0..=v1`, one per level, empty ones included.
    fn pieces(&self, v0: f64, v1: f64) -> impl Iterator<Item = Piece> + '_ {
        let ends = self.0.iter().skip(1).map(|level| level.from).chain([f64::INFINITY]);
        self.0.iter().zip(ends).map(move |(level, end)| {
            let from = v0.max(level.from).min(v1.max(v0));
            Piece { from, to: v1.min(end).max(from), a: level.a }
        })
    }

    /// Value at `v` and the velocity at which the next level begins.
    fn level(&self, v: f64) -> (f64, f64) {
        let next = self.0.partition_point(|level| level.from <= v).max(1);
        let end = self.0.get(next).map_or(f64::INFINITY, |level| level.from);
        (self.0[next - 1].a, end)
    }

    pub(super) fn distance(&self, v0: f64, v1: f64) -> f64 {
        self.pieces(v0, v1).map(|p| p.distance()).sum()
    }

    pub(super) fn duration(&self, v0: f64, v1: f64) -> f64 {
        self.pieces(v0, v1).map(|p| p.duration()).sum()
    }

    /// The speed-up from `v0` to `v1` as one phase per level, its time scaled by `stretch`.
    fn phases(&self, v0: f64, v1: f64, stretch: f64) -> SmallVec<[Phase; 4]> {
        let mut s = 0.0;
        let pieces = self.pieces(v0, v1).map(|p| Piece { a: p.a / stretch, ..p });
        pieces
            .map(|p| {
                let phase = Phase::state(s, p.from, p.a).ramp(RampShape::Trapez, 0.0, p.duration());
                s += p.distance();
                phase
            })
            .collect()
    }

    pub(super) fn reach(&self, mut v: f64, mut length: f64) -> f64 {
        if length <= 0.0 {
            return v;
        }
        loop {
            let (a, end) = self.level(v);
            let whole = step_distance(v, end, a);
            if whole >= length {
                return add_rounding_down(v, step_gain(v, length, a)).min(end);
            }
            length -= whole;
            v = end;
        }
    }
}

/// Distance from `v` to `w` at constant acceleration.
fn step_distance(v: f64, w: f64, a: f64) -> f64 {
    0.5 * (w - v) * (w + v) / a
}

/// Gain of velocity over a distance at constant acceleration.
fn step_gain(v: f64, length: f64, a: f64) -> f64 {
    let gained = 2.0 * a * length;
    if gained > 0.0 { gained / (v + (v * v + gained).sqrt()) } else { 0.0 }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    from: f64,
    to: f64,
    a: f64,
}

impl Piece {
    fn distance(&self) -> f64 {
        step_distance(self.from, self.to, self.a)
    }

    fn duration(&self) -> f64 {
        (self.to - self.from) / self.a
    }
}
