//! An independent axis: one axis with its own timeline, from rest to rest, planned with the profiles of the path.
//!
//! The caller decides when the next block may start (`INDP_SYN`, `INDP_ASYN`, `#WAIT INDP`).
//!
//! Make it at the start of the motion and read its state in each cycle; [`IndependentMove::steer`] applies the override
//! and feedhold of that cycle, [`IndependentMove::stop`] ends the motion early.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::block::SlopeKind;
//! use kontur_motion::independent::{IndependentMove, IndependentSpeed};
//!
//! let cycle = CycleTime::from_us(1000).unwrap();
//! let speed = IndependentSpeed::Feed(100.0);
//! let motion = IndependentMove::new(0.0, -20.0, speed, SlopeKind::Trapez, &axis(), cycle).unwrap();
//! assert!(motion.state(motion.cycles() / 2).v_mm_s < 0.0);
//! assert_eq!(motion.state(motion.cycles()).position_mm, -20.0);
//! ```

use crate::axis::{AxisDynamics, AxisVec, StepSlope};
use crate::block::{Block, ChannelDynamics, Feed, Slope, SlopeKind};
use crate::limits::PathSpeeds;
use crate::path::{LinePath, Path};
use crate::profile::{Infeasible, Profile, SlopeLimits, State};
use crate::queue::Queued;
use crate::realtime::{Override, OverrideMode, OverrideRatios};
use crate::timeline::Moment;
use kontur_filters::time::CycleTime;
use smallvec::{SmallVec, smallvec};
use std::sync::Arc;

/// Speed of an independent axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IndependentSpeed {
    /// `G00`: the rapid velocity of the axis.
    Rapid,
    /// `G01` with `FEED`, in mm/s (deg/s), limited to the maximum velocity of the axis (P-AXIS-00212).
    Feed(f64),
    /// `G01` with `FEED_MAX_WEIGHT`, 1.0 = velocity limit of the axis.
    ShareOfMaximum(f64),
    /// `G01` with `TIME`: duration in s from rest to rest, or as fast as the limits allow if that is not possible.
    ///
    /// Assumption: the time includes speeding up and braking, so that axes with the same time arrive together.
    Time(f64),
}

/// State of an independent axis in one cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IndependentState {
    /// Position in mm (deg).
    pub position_mm: f64,
    /// Velocity in mm/s, with sign.
    pub v_mm_s: f64,
    /// Acceleration in mm/s2, with sign.
    pub a_mm_s2: f64,
}

/// Remaining distance in mm (deg) below which nothing affects a motion any more.
const ARRIVED_MM: f64 = 1e-9;

/// External influences on a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Steering {
    /// Override.
    pub ratios: OverrideRatios,
    /// The value that the override is a percentage of (P-CHAN-00066).
    pub mode: OverrideMode,
    /// Feedhold.
    pub held: bool,
}

/// Profiles in order, each with its start time in s and start distance.
type Course = SmallVec<[(f64, f64, Profile); 1]>;

/// A motion of one axis from rest to rest.
#[derive(Clone, Debug)]
pub struct IndependentMove {
    cycle: CycleTime,
    from_mm: f64,
    to_mm: f64,
    /// `None` if there is no distance to travel.
    limits: Option<(SlopeLimits, PathSpeeds)>,
    course: Course,
    /// Distance at which the axis rests without a course.
    rest_mm: f64,
    steering: Steering,
    /// Whether the course ends at rest before the target, to be resumed from there.
    pauses: bool,
    stopped: bool,
}

impl IndependentMove {
    /// A motion to an absolute target; HSC is treated as TRAPEZ.
    ///
    /// `axis` holds the limits of the lists without the weights of G130..G133, which do not apply to independent axes.
    /// STEP brakes with the deceleration of stage 1 at every speed (Source: TF5200, P-AXIS-00282, 00283).
    ///
    /// # Errors
    /// [`Infeasible`] if the speed is not positive.
    pub fn new(
        from_mm: f64,
        to_mm: f64,
        speed: IndependentSpeed,
        kind: SlopeKind,
        axis: &AxisDynamics,
        cycle: CycleTime,
    ) -> Result<Self, Infeasible> {
        let line = LinePath::new(one(from_mm), one(to_mm), &[]);
        let Some(queued) = line.map(|l| Queued::new(block(l, speed, kind, *axis), cycle)) else {
            return Ok(Self::with(cycle, (from_mm, to_mm), None, Course::new()));
        };
        let mut speeds = queued.speeds;
        let PathSpeeds { programmed_mm_s, axis_mm_s, .. } = speeds;
        let (slope, length) = (queued.slope, queued.length);
        let plan = |v: f64| slope.plan(0.0, 0.0, v, length);
        let mut profile = plan(programmed_mm_s.min(axis_mm_s))?;
        if let IndependentSpeed::Time(time) = speed {
            // the duration falls with the velocity; at `length / time` it is too long
            let (mut low, mut high) = (length / time, axis_mm_s);
            profile = plan(high)?;
            if profile.duration() < time {
                for _ in 0..100 {
                    let middle = 0.5 * (low + high);
                    profile = plan(middle)?;
                    *(if profile.duration() > time { &mut low } else { &mut high }) = middle;
                }
            }
            speeds.programmed_mm_s = profile.peak();
        }
        let course = smallvec![(0.0, 0.0, profile)];
        Ok(Self::with(cycle, (from_mm, to_mm), Some((slope, speeds)), course))
    }

    fn with(
        cycle: CycleTime,
        (from_mm, to_mm): (f64, f64),
        limits: Option<(SlopeLimits, PathSpeeds)>,
        course: Course,
    ) -> Self {
        let (steering, rest_mm) = (Steering::default(), 0.0);
        let (pauses, stopped) = (false, false);
        Self { cycle, from_mm, to_mm, limits, course, rest_mm, steering, pauses, stopped }
    }

    /// Cycles from the start until the axis is finally at rest; `u64::MAX` while it is held.
    pub fn cycles(&self) -> u64 {
        if self.pauses {
            return u64::MAX;
        }
        let end = self.course.last().map_or(0.0, |(start, _, c)| start + c.duration());
        Moment::default().plus(end).next_tick(self.cycle)
    }

    /// State `k` cycles after the start; from [`Self::cycles`] on exactly the target, unless the motion was stopped
    /// before.
    pub fn state(&self, k: u64) -> IndependentState {
        let over = k >= self.cycles();
        if over && !self.stopped {
            return IndependentState { position_mm: self.to_mm, ..IndependentState::default() };
        }
        let State { s_mm, v_mm_s, a_mm_s2, .. } = self.distance(k);
        let sign = if self.to_mm < self.from_mm { -1.0 } else { 1.0 };
        IndependentState {
            position_mm: self.from_mm + sign * s_mm,
            v_mm_s: if over { 0.0 } else { sign * v_mm_s },
            a_mm_s2: if over { 0.0 } else { sign * a_mm_s2 },
        }
    }

    /// Whether the motion rests in cycle `k` and continues when it is released.
    pub fn is_held(&self, k: u64) -> bool {
        let end = self.course.last().map_or(0.0, |(start, _, part)| start + part.duration());
        self.pauses && Moment::default().plus(end).next_tick(self.cycle) <= k
    }

    /// Applies override and feedhold from cycle `k` on; earlier states are not read any more.
    ///
    /// The acceleration is brought to zero first. Where there is no distance left for that (close to the target, SIN2
    /// within a ramp), the motion continues and the change is made in a later cycle, so this must be called in every
    /// one. A braking motion does not accelerate again before its deceleration is zero.
    pub fn steer(&mut self, k: u64, steering: Steering) {
        let Some((_, speeds)) = &self.limits else { return };
        if self.steering == steering || self.stopped || k >= self.cycles() {
            return;
        }
        let feed = |steering: Steering| {
            let Steering { ratios, mode, held } = steering;
            let real_time = Override { ratios: ratios.clamped(), mode };
            if held { 0.0 } else { real_time.velocity(speeds).v_mm_s }
        };
        let (now, feed) = (feed(self.steering), feed(steering));
        if feed.to_bits() == now.to_bits() {
            self.steering = steering;
            return;
        }
        let State { s_mm, a_mm_s2, .. } = self.distance(k);
        let arrives = (self.to_mm - self.from_mm).abs() - s_mm <= ARRIVED_MM;
        let waits = arrives || feed > now && a_mm_s2 < 0.0;
        if !waits && let Some(course) = self.course_from(k, feed) {
            (self.course, self.rest_mm) = (course, s_mm);
            (self.steering, self.pauses) = (steering, feed <= 0.0);
        }
    }

    /// The course from cycle `k` on with a feed rate: to the target, or to standstill where the feed rate is 0. `None`
    /// if there is none.
    fn course_from(&self, k: u64, feed: f64) -> Option<Course> {
        let (slope, _) = self.limits.as_ref()?;
        let length = (self.to_mm - self.from_mm).abs();
        let State { s_mm, v_mm_s, a_mm_s2, .. } = self.distance(k);
        let (mut t, mut s, mut v) = (self.cycle.time_of(k), s_mm, v_mm_s);
        let mut course = Course::new();
        let settled = slope.settled(v, a_mm_s2);
        let planned = self.course.get(self.part_at(t)).map_or(0.0, |(_, _, part)| part.peak());
        if settled > v && settled > planned * (1.0 + 1e-9) {
            return None;
        }
        if (settled - v).abs() > f64::EPSILON * v {
            let change = slope.change(v, a_mm_s2, settled)?;
            let next = (t + change.duration(), s + change.length(), settled);
            course.push((t, s, change));
            (t, s, v) = next;
        }
        let v = v.max(0.0);
        let left = length - s;
        let profile = if feed > 0.0 && v > feed {
            slope.plan_from_above(v, 0.0, feed, left).ok()?
        } else if feed > 0.0 {
            slope.plan(v, 0.0, feed, left).ok()?
        } else if v > 0.0 {
            let braking = slope.down_distance(v, 0.0);
            slope.plan(v, 0.0, v, (braking < left - ARRIVED_MM).then_some(braking)?).ok()?
        } else {
            return (left > ARRIVED_MM).then_some(course);
        };
        course.push((t, s, profile));
        Some(course)
    }

    /// Brakes from cycle `k` on, wherever the motion ends; states up to `k` stay.
    ///
    /// A positive acceleration is brought to zero first. Where SIN2 is about to reach its speed, a stop takes effect
    /// after that, because the acceleration can only then be zero without more speed.
    ///
    /// # Errors
    /// [`Infeasible`] is an internal error.
    pub fn stop(&mut self, k: u64) -> Result<(), Infeasible> {
        let Some((slope, _)) = self.limits.clone() else { return Ok(()) };
        let t = self.cycle.time_of(k);
        let i = self.part_at(t);
        let state = self.distance(k);
        if self.pauses {
            // it brakes already, or rests
            (self.pauses, self.stopped) = (false, true);
            return Ok(());
        }
        if self.stopped || k >= self.cycles() {
            return Ok(());
        }
        if state.a_mm_s2 < 0.0 {
            // as for a lower override; a motion that brakes for the target already stops over the shortest distance
            if let Some(course) = self.course_from(k, 0.0) {
                self.course.truncate(i + 1);
                self.course.extend(course);
                self.stopped = true;
            }
            return Ok(());
        }
        if k == 0 {
            (self.to_mm, self.limits) = (self.from_mm, None);
            self.course.clear();
            return Ok(());
        }
        let Some((start, s0, span)) = self.course.get(i).cloned() else { return Ok(()) };
        let mut at = (t, state.s_mm);
        let mut v = state.v_mm_s;
        let mut course: Course = smallvec![(start, s0, span.clone())];
        let settled = slope.settled(v, state.a_mm_s2);
        if settled > v {
            if settled > span.peak() * (1.0 + 1e-9) {
                let up: f64 = span.phases().take(3).map(|p| p.0).sum();
                (at, v) = ((start + up, s0 + span.at(up).s_mm), span.peak());
            } else if let Some(change) = slope.change(v, state.a_mm_s2, settled) {
                let next = (at.0 + change.duration(), at.1 + change.length());
                course.push((at.0, at.1, change));
                (at, v) = (next, settled);
            }
        }
        let braking = slope.plan(v, 0.0, v, slope.down_distance(v, 0.0))?;
        course.push((at.0, at.1, braking));
        (self.course, self.stopped) = (course, true);
        Ok(())
    }

    fn part_at(&self, t: f64) -> usize {
        self.course.partition_point(|p| p.0 <= t).max(1) - 1
    }

    fn distance(&self, k: u64) -> State {
        let t = self.cycle.time_of(k);
        let rests = State { s_mm: self.rest_mm, ..State::default() };
        self.course.get(self.part_at(t)).map_or(rests, |(start, s0, profile)| {
            let state = profile.at(t - start);
            State { s_mm: s0 + state.s_mm, ..state }
        })
    }
}

fn one(value: f64) -> AxisVec {
    AxisVec::from_slice(&[value])
}

/// The block of a channel that contains this axis only.
fn block(line: LinePath, speed: IndependentSpeed, kind: SlopeKind, axis: AxisDynamics) -> Block {
    let stage_1 = |s: StepSlope| StepSlope { dec_mm_s2: [s.dec_mm_s2[0]; 2], ..s };
    let axis = AxisDynamics {
        step_feed: stage_1(axis.step_feed),
        step_rapid: stage_1(axis.step_rapid),
        ..axis
    };
    let feed = match speed {
        IndependentSpeed::Rapid => Feed::Rapid,
        IndependentSpeed::Feed(v) => Feed::PathVelocity(v),
        IndependentSpeed::ShareOfMaximum(share) => Feed::ShareOfMaximum(share),
        IndependentSpeed::Time(t) => Feed::Duration(t),
    };
    let block = Block::new(0, Path::Line(line), feed, Arc::new(ChannelDynamics::new(vec![axis])));
    Block { slope: Slope { kind, ..Slope::default() }, ..block }
}
