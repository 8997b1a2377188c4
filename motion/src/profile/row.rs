//! The speed over a path length: a row of phases, from any planner.

use super::phase::{Phase, State};
use smallvec::SmallVec;
use std::ops::Deref;
use std::sync::Arc;

/// Phases of a profile of TRAPEZ, SIN2 and HSC: two legs of three phases and a cruise.
const USUAL_PHASES: usize = 7;

/// A speed that is never negative, in phases of constant jerk or of one sine-square ramp each.
#[derive(Clone, Debug)]
pub struct Profile {
    end: State,
    duration: f64,
    phases: Phases,
}

/// Phases in order with their start times, possibly with empty ones.
#[derive(Clone, Debug)]
enum Phases {
    /// One at constant speed, as most short blocks have it: what it is follows from the end and the duration. Plans and entries
    /// of the timeline are copied often, and this keeps them small.
    Even,
    /// Shared: plans pass their profiles on.
    Shared(Arc<[(f64, Phase)]>),
}

/// The phases of a profile, to be read.
enum Row<'a> {
    Even([(f64, Phase); 1]),
    Shared(&'a [(f64, Phase)]),
}

impl Deref for Row<'_> {
    type Target = [(f64, Phase)];

    #[inline]
    fn deref(&self) -> &Self::Target {
        match self {
            Self::Even(phase) => phase,
            Self::Shared(phases) => phases,
        }
    }
}

impl PartialEq for Profile {
    fn eq(&self, other: &Self) -> bool {
        let same = match (&self.phases, &other.phases) {
            (Phases::Even, Phases::Even) => true,
            (Phases::Shared(own), Phases::Shared(others)) if Arc::ptr_eq(own, others) => true,
            _ => self.row()[..] == other.row()[..],
        };
        same && self.end == other.end && self.duration == other.duration
    }
}

impl Profile {
    /// Consecutive phases, and the state at their end.
    pub(super) fn new(phases: impl IntoIterator<Item = Phase>, end: State) -> Self {
        let (mut duration, phases) = (0.0, phases.into_iter());
        // collected in place, then copied once: an `Arc` of a chain of iterators would poll each of them for every
        // phase
        let mut timed: SmallVec<[(f64, Phase); USUAL_PHASES]> =
            SmallVec::with_capacity(phases.size_hint().0);
        phases.for_each(|phase| {
            timed.push((duration, phase));
            duration += phase.t;
        });
        Self { phases: Phases::Shared(Arc::from(&timed[..])), duration, end }
    }

    /// A constant speed in mm/s, above 0, over a length, as most short blocks of a run have it.
    #[inline]
    pub(crate) fn even(v_mm_s: f64, length: f64) -> Self {
        let end = State { s_mm: length, v_mm_s, ..State::default() };
        Self { phases: Phases::Even, duration: length / v_mm_s, end }
    }

    #[inline]
    fn row(&self) -> Row<'_> {
        match &self.phases {
            Phases::Even => {
                let cruise = Phase::state(0.0, self.end.v_mm_s, 0.0).until(self.duration);
                Row::Even([(0.0, cruise)])
            }
            Phases::Shared(phases) => Row::Shared(phases),
        }
    }

    /// Consecutive phases over a length.
    pub(crate) fn over(phases: Vec<Phase>, length: f64) -> Self {
        let end = phases.last().map_or_else(State::default, |last| ending(&last.end(), length));
        Self::new(phases, end)
    }

    /// This profile with another one after its end.
    pub(super) fn followed_by(&self, next: &Self) -> Self {
        let length = self.end.s_mm;
        let (own, behind) = (self.row(), next.row());
        let moved = behind.iter().map(|(_, p)| p.placed_at(length + p.s));
        let end = State { s_mm: length + next.end.s_mm, ..next.end };
        Self::new(own.iter().map(|(_, p)| *p).chain(moved), end)
    }

    /// The parts before and after a path length, with the acceleration at that point unchanged; `None` if this cuts a
    /// sine-square ramp, or leaves a ramp that starts with an acceleration.
    pub(crate) fn split(&self, s_mm: f64) -> Option<(Self, Self)> {
        let phases = self.row();
        let i = phases.partition_point(|p| p.1.s <= s_mm).checked_sub(1)?;
        let phase = phases[i].1;
        let t = phase.time_at(s_mm);
        let cut = phase.after(t);
        let curved = phases.iter().any(|(_, p)| p.is_curved());
        if phase.is_curved() || curved && cut.a != 0.0 {
            return None;
        }
        let before = phases[..i].iter().map(|p| p.1).chain([phase.until(t)]);
        let behind = [phase.rest(t)].into_iter().chain(phases[i + 1..].iter().map(|p| p.1));
        let moved = behind.map(|p| p.placed_at((p.s - s_mm).max(0.0)));
        let end = State { s_mm: self.end.s_mm - s_mm, ..self.end };
        Some((Self::new(before, ending(&cut, s_mm)), Self::new(moved, end)))
    }

    /// Duration in s.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Length in mm.
    pub fn length(&self) -> f64 {
        self.end.s_mm
    }

    /// State at the end.
    pub fn end(&self) -> State {
        self.end
    }

    /// Duration in s and mean jerk in mm/s3 of every phase.
    ///
    /// TRAPEZ and SIN2: the seven segments I..VII, or a single cruise if the speed never changes. STEP: one per
    /// acceleration level from the lowest, cruise, one per deceleration level from the highest. Braking to the feed
    /// rate first: those of both parts. A speed along varying limits: as many as needed.
    pub fn phases(&self) -> impl ExactSizeIterator<Item = (f64, f64)> + '_ {
        let phases = self.row();
        (0..phases.len()).map(move |i| (phases[i].1.t, phases[i].1.j))
    }

    /// Highest velocity in mm/s.
    pub fn peak(&self) -> f64 {
        self.highest_inside(0.0, self.length()).max(self.end.v_mm_s)
    }

    /// Highest velocity in mm/s at the phase starts and at the changes from acceleration to braking between two path
    /// lengths; 0 if there are none. In between no velocity exceeds this value and those at the two path lengths.
    pub(crate) fn highest_inside(&self, from_mm: f64, to_mm: f64) -> f64 {
        let phases = self.row();
        let first = phases.partition_point(|p| p.1.s < from_mm);
        let last = phases.partition_point(|p| p.1.s <= to_mm);
        let starts = phases[first..last].iter().map(|p| p.1.v);
        let around = &phases[first.saturating_sub(1)..last];
        let turns = around.iter().filter_map(|p| p.1.turn());
        let inside = turns.filter(|turn| turn.s >= from_mm && turn.s <= to_mm).map(|turn| turn.v);
        starts.chain(inside).fold(0.0, f64::max)
    }

    /// Whether the speed rises again after it has fallen.
    pub(crate) fn rises_after_a_fall(&self) -> bool {
        let phases = self.row();
        let mut accelerations = phases.iter().map(|(_, p)| p.a);
        accelerations.any(|a| a < 0.0) && accelerations.any(|a| a > 0.0)
    }

    /// State at time `t` in s since the start; times outside the profile give the state at its start or end.
    pub fn at(&self, t: f64) -> State {
        if t >= self.duration {
            return self.end;
        }
        match &self.phases {
            // the phase evaluated without its zeros, all but one of which cannot change a bit
            Phases::Even => {
                let way = t.clamp(0.0, self.duration) * self.end.v_mm_s;
                State { s_mm: (0.0 + way).min(self.end.s_mm), ..self.end }
            }
            Phases::Shared(phases) => {
                let next = phases.partition_point(|p| p.0 <= t).max(1);
                let Some((start, phase)) = phases.get(next - 1) else { return self.end };
                let ahead = phases.get(next).map_or(self.end.s_mm, |p| p.1.s);
                phase.state_after(t - start, ahead)
            }
        }
    }

    /// Time in s at which path length `s_mm` is reached; the inverse of [`Self::at`], non-decreasing.
    pub fn time_at(&self, s_mm: f64) -> f64 {
        if s_mm >= self.end.s_mm {
            return self.duration;
        }
        let phases = self.row();
        let i = phases.partition_point(|p| p.1.s <= s_mm).saturating_sub(1);
        phases.get(i).map_or(0.0, |(start, phase)| start + phase.time_at(s_mm))
    }
}

/// The end, at a state, of a profile over a length.
fn ending(at: &Phase, length: f64) -> State {
    // rounding at a stop
    let v_mm_s = at.v.max(0.0);
    State { s_mm: length, v_mm_s, a_mm_s2: at.a, j_mm_s3: 0.0 }
}
