//! The planned speed over one span.

use super::chain::{Chain, Phase};
use super::leg::RampLeg;
use super::step::StepLeg;
use smallvec::SmallVec;

/// State of the path coordinate at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Path length since the start of the span in mm.
    pub s_mm: f64,
    /// Path velocity in mm/s.
    pub v_mm_s: f64,
    /// Path acceleration in mm/s2.
    pub a_mm_s2: f64,
    /// Path jerk in mm/s3; 0 where acceleration jumps.
    pub j_mm_s3: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Leg {
    Ramp(RampLeg),
    Step(StepLeg),
}

impl Leg {
    fn at(&self, x: f64) -> State {
        match self {
            Self::Ramp(leg) => leg.at(x),
            Self::Step(leg) => leg.at(x),
        }
    }

    fn duration(&self) -> f64 {
        match self {
            Self::Ramp(leg) => leg.duration(),
            Self::Step(leg) => leg.duration(),
        }
    }

    fn distance(&self) -> f64 {
        match self {
            Self::Ramp(leg) => leg.distance(),
            Self::Step(leg) => leg.distance(),
        }
    }

    fn time_at(&self, s: f64) -> f64 {
        match self {
            Self::Ramp(leg) => leg.time_at(s),
            Self::Step(leg) => leg.time_at(s),
        }
    }

    fn times(&self) -> SmallVec<[f64; 4]> {
        match self {
            Self::Ramp(leg) => SmallVec::from_slice(&leg.times()),
            Self::Step(leg) => leg.times(),
        }
    }
}

/// What a plan has settled about its span.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) length: f64,
    pub(super) v0: f64,
    pub(super) ve: f64,
    pub(super) peak: f64,
    /// The peak is the feed, not the solution for the length.
    pub(super) at_feed: bool,
}

/// The speed over one span; acceleration is zero at start and end (except STEP).
#[derive(Clone, Debug, PartialEq)]
pub struct SpanProfile(Shape);

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Legs(Box<Legs>),
    /// Braking to the feed first, then the rest of the span.
    BrakeFirst(Box<[Legs; 2]>),
    Chain(Chain),
}

/// The part of two in a row in which `at` lies, with what lies before it.
fn part(parts: &[Legs; 2], at: f64, size: impl Fn(&Legs) -> f64) -> (&Legs, f64, f64) {
    let [first, second] = parts;
    if at < size(first) { (first, 0.0, 0.0) } else { (second, first.length, first.duration()) }
}

/// Speed-up, cruise and braking.
#[derive(Clone, Debug, PartialEq)]
struct Legs {
    up: Leg,
    /// Braking, seen backwards from the end of the span.
    down: Leg,
    up_s: f64,
    cruise_s: f64,
    down_s: f64,
    length: f64,
    v_start: f64,
    v_end: f64,
    peak: f64,
}

impl SpanProfile {
    /// Puts two legs together, see [`Legs::assemble`].
    pub(super) fn assemble(
        span: Span,
        distance: f64,
        legs: impl FnOnce(f64) -> (Leg, Leg),
    ) -> Self {
        Self(Shape::Legs(Box::new(Legs::assemble(span, distance, legs))))
    }

    /// Two profiles in a row, the second one from the speed at which the first one ends; `None` for chains.
    pub(super) fn brake_first(first: Self, second: Self) -> Option<Self> {
        match (first.0, second.0) {
            (Shape::Legs(first), Shape::Legs(second)) => {
                Some(Self(Shape::BrakeFirst(Box::new([*first, *second]))))
            }
            _ => None,
        }
    }

    /// A chain of phases of constant jerk.
    pub(crate) fn from_chain(chain: Chain) -> Self {
        Self(Shape::Chain(chain))
    }

    /// The parts before and behind a path length, the acceleration there as it is; `None` with STEP, where a sine-square
    /// ramp would be cut, and with constant ramp times.
    pub(crate) fn split(&self, s_mm: f64) -> Option<(Self, Self)> {
        let (before, behind) = match &self.0 {
            Shape::Legs(p) => p.chain()?.split(s_mm),
            Shape::BrakeFirst(_) => None,
            Shape::Chain(p) => p.split(s_mm),
        }?;
        Some((Self(Shape::Chain(before)), Self(Shape::Chain(behind))))
    }

    /// Acceleration in mm/s2 with which the path goes on behind the end: zero, but where the profile was parted.
    pub(crate) fn left_with(&self) -> f64 {
        match &self.0 {
            Shape::Legs(_) | Shape::BrakeFirst(_) => 0.0,
            Shape::Chain(p) => p.at(p.duration()).a_mm_s2,
        }
    }

    /// Duration in s.
    pub fn duration(&self) -> f64 {
        match &self.0 {
            Shape::Legs(p) => p.duration(),
            Shape::BrakeFirst(parts) => parts.iter().map(Legs::duration).sum(),
            Shape::Chain(p) => p.duration(),
        }
    }

    /// Length in mm.
    pub fn length(&self) -> f64 {
        match &self.0 {
            Shape::Legs(p) => p.length,
            Shape::BrakeFirst(parts) => parts.iter().map(|p| p.length).sum(),
            Shape::Chain(p) => p.length(),
        }
    }

    /// Highest velocity in mm/s.
    pub fn peak(&self) -> f64 {
        match &self.0 {
            Shape::Legs(p) => p.peak,
            Shape::BrakeFirst(parts) => parts.iter().map(|p| p.peak).fold(0.0, f64::max),
            Shape::Chain(p) => p.peak(),
        }
    }

    /// Highest velocity in mm/s between two path lengths.
    pub fn highest_between(&self, from_mm: f64, to_mm: f64) -> f64 {
        match &self.0 {
            Shape::Legs(p) => p.highest_between(from_mm, to_mm),
            Shape::BrakeFirst(parts) => {
                let [first, second] = &**parts;
                let cut = first.length;
                if to_mm <= cut {
                    first.highest_between(from_mm, to_mm)
                } else if from_mm >= cut {
                    second.highest_between(from_mm - cut, to_mm - cut)
                } else {
                    let behind = second.highest_between(0.0, to_mm - cut);
                    first.highest_between(from_mm, cut).max(behind)
                }
            }
            Shape::Chain(p) => p.highest_between(from_mm, to_mm),
        }
    }

    /// The lower one of the velocities at the ends in mm/s.
    pub fn lowest(&self) -> f64 {
        match &self.0 {
            Shape::Legs(p) => p.v_start.min(p.v_end),
            Shape::BrakeFirst(parts) => parts[0].v_start.min(parts[1].v_end),
            Shape::Chain(p) => p.at(0.0).v_mm_s.min(p.at(p.duration()).v_mm_s),
        }
    }

    /// Durations of the segments in s, in the order of time.
    ///
    /// TRAPEZ and SIN2: the seven segments I..VII. STEP: one per acceleration level from the lowest, cruise, one
    /// per deceleration level from the highest. Braking to the feed first: those of the braking in front. A speed that follows varying limits: one per phase of constant jerk.
    pub fn segments(&self) -> SmallVec<[f64; 8]> {
        match &self.0 {
            Shape::Legs(p) => p.segments(),
            Shape::BrakeFirst(parts) => parts.iter().flat_map(Legs::segments).collect(),
            Shape::Chain(p) => p.times(),
        }
    }

    /// State at time `t` in s since the start; before the start and after the end the state of that end.
    pub fn at(&self, t: f64) -> State {
        match &self.0 {
            Shape::Legs(p) => p.at(t),
            Shape::BrakeFirst(parts) => {
                let (part, s, before) = part(parts, t, Legs::duration);
                let state = part.at(t - before);
                State { s_mm: s + state.s_mm, ..state }
            }
            Shape::Chain(p) => p.at(t),
        }
    }

    /// State at the end.
    pub(crate) fn end(&self) -> State {
        self.at(self.duration())
    }

    /// Time in s at which path length `s_mm` is reached; the inverse of [`Self::at`], not decreasing.
    pub fn time_at(&self, s_mm: f64) -> f64 {
        match &self.0 {
            Shape::Legs(p) => p.time_at(s_mm),
            Shape::BrakeFirst(parts) => {
                let (part, s, before) = part(parts, s_mm, |p| p.length);
                before + part.time_at(s_mm - s)
            }
            Shape::Chain(p) => p.time_at(s_mm),
        }
    }
}

impl Legs {
    /// Puts the legs together such that they cover the length exactly.
    ///
    /// `distance` is that of both legs unstretched. What is missing is cruised at the peak; a rounding error of
    /// the peak, or legs slightly too long, are taken out by stretching time.
    fn assemble(span: Span, distance: f64, legs: impl FnOnce(f64) -> (Leg, Leg)) -> Self {
        let Span { length, v0, ve, peak, at_feed } = span;
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
        Self {
            up_s: up.duration(),
            down_s: down.duration(),
            v_start: v0,
            v_end: ve,
            up,
            down,
            cruise_s,
            length,
            peak,
        }
    }

    /// Duration in s.
    fn duration(&self) -> f64 {
        self.up_s + self.cruise_s + self.down_s
    }

    /// The same as phases of constant jerk, if it has any.
    fn chain(&self) -> Option<Chain> {
        let (Leg::Ramp(up), Leg::Ramp(down)) = (&self.up, &self.down) else { return None };
        let top = up.distance();
        let cruise = Phase::state(top, self.peak, 0.0).until(self.cruise_s);
        let down = down.phases(0.0)?.map(|p| p.reversed(self.length)).into_iter().rev();
        let phases = up.phases(0.0)?.into_iter().chain([cruise]).chain(down);
        Some(Chain::new(phases.filter(|p| p.t > 0.0), self.length))
    }

    /// Highest velocity in mm/s between two path lengths.
    fn highest_between(&self, from_mm: f64, to_mm: f64) -> f64 {
        let top = self.up.distance();
        if from_mm < self.length - self.down.distance() && to_mm > top {
            return self.peak;
        }
        let at = if to_mm <= top { to_mm } else { from_mm };
        self.at(self.time_at(at)).v_mm_s
    }

    /// Durations of the segments in s, in the order of time.
    ///
    /// TRAPEZ and SIN2: the seven segments I..VII. STEP: one per acceleration level from the lowest, cruise, one
    /// per deceleration level from the highest.
    fn segments(&self) -> SmallVec<[f64; 8]> {
        let mut all = SmallVec::from_slice(&self.up.times());
        all.push(self.cruise_s);
        all.extend(self.down.times().into_iter().rev());
        all
    }

    /// State at time `t` in s since the start; before the start and after the end the state of that end.
    fn at(&self, t: f64) -> State {
        let t = t.clamp(0.0, self.duration());
        let mut state = if t < self.up_s {
            self.up.at(t)
        } else if t < self.up_s + self.cruise_s {
            State {
                s_mm: self.up.distance() + self.peak * (t - self.up_s),
                v_mm_s: self.peak,
                ..State::default()
            }
        } else {
            let left = (self.duration() - t).min(self.down_s);
            let back = self.down.at(left);
            State { s_mm: self.length - back.s_mm, a_mm_s2: -back.a_mm_s2, ..back }
        };
        state.s_mm = state.s_mm.clamp(0.0, self.length);
        state
    }

    /// Time in s at which path length `s_mm` is reached; the inverse of [`Self::at`], not decreasing.
    fn time_at(&self, s_mm: f64) -> f64 {
        if s_mm <= 0.0 {
            return 0.0;
        }
        let to_go = self.length - s_mm;
        if to_go <= 0.0 {
            return self.duration();
        }
        if s_mm < self.up.distance() {
            self.up.time_at(s_mm)
        } else if to_go > self.down.distance() {
            self.up_s + ((s_mm - self.up.distance()) / self.peak).min(self.cruise_s)
        } else {
            self.duration() - self.down.time_at(to_go)
        }
    }
}
