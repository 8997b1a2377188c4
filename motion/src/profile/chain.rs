//! A speed over path length as a chain of phases of constant jerk.

use super::span::State;
use smallvec::SmallVec;

/// A phase of constant jerk, from its state at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Phase {
    /// Path length at the start in mm.
    pub(crate) s: f64,
    /// Velocity there in mm/s.
    pub(crate) v: f64,
    /// Acceleration there in mm/s2.
    pub(crate) a: f64,
    /// Jerk in mm/s3.
    pub(crate) j: f64,
    /// Duration in s.
    pub(crate) t: f64,
}

impl Phase {
    /// The state `t` s after the start, as the start of a phase without duration.
    pub(crate) fn after(&self, t: f64) -> Self {
        let Self { s, v, a, j, .. } = *self;
        Self {
            s: s + t * (v + t * (0.5 * a + t * j / 6.0)),
            v: v + t * (a + 0.5 * t * j),
            a: a + t * j,
            j: 0.0,
            t: 0.0,
        }
    }

    pub(crate) fn end(&self) -> Self {
        self.after(self.t)
    }

    /// Time in `0..=t` at which `s` is reached; the velocity must not be negative.
    pub(crate) fn time_at(&self, s: f64) -> f64 {
        let want = s - self.s;
        if want <= 0.0 {
            return 0.0;
        }
        let whole = self.end().s - self.s;
        if want >= whole {
            return self.t;
        }
        let (mut low, mut high) = (0.0, self.t);
        let mut t = self.t * want / whole;
        for _ in 0..60 {
            let at = self.after(t);
            let miss = at.s - self.s - want;
            if miss > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let newton = t - miss / at.v;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - t).abs() <= 1e-16 * self.t {
                return next;
            }
            t = next;
        }
        t
    }

    /// Highest velocity of the phase.
    pub(crate) fn peak(&self) -> f64 {
        let ends = self.v.max(self.end().v);
        let turn = -self.a / self.j;
        if turn > 0.0 && turn < self.t { ends.max(self.after(turn).v) } else { ends }
    }
}

/// Phases in order with the times at which they start.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chain {
    phases: Vec<(f64, Phase)>,
    duration: f64,
    length: f64,
}

impl Chain {
    pub(crate) fn new(phases: impl IntoIterator<Item = Phase>, length: f64) -> Self {
        let mut duration = 0.0;
        let mut timed = Vec::new();
        for phase in phases {
            timed.push((duration, phase));
            duration += phase.t;
        }
        Self { phases: timed, duration, length }
    }

    pub(super) fn duration(&self) -> f64 {
        self.duration
    }

    pub(super) fn length(&self) -> f64 {
        self.length
    }

    pub(super) fn at(&self, t: f64) -> State {
        let i = self.phases.partition_point(|p| p.0 <= t).saturating_sub(1);
        let Some((start, phase)) = self.phases.get(i) else { return State::default() };
        let now = phase.after((t - start).clamp(0.0, phase.t));
        // rounding at a stop
        State { s_mm: now.s, v_mm_s: now.v.max(0.0), a_mm_s2: now.a, j_mm_s3: phase.j }
    }

    pub(super) fn time_at(&self, s: f64) -> f64 {
        let i = self.phases.partition_point(|p| p.1.s <= s).saturating_sub(1);
        self.phases.get(i).map_or(0.0, |(start, phase)| start + phase.time_at(s))
    }

    pub(super) fn times(&self) -> SmallVec<[f64; 8]> {
        self.phases.iter().map(|p| p.1.t).collect()
    }

    pub(super) fn peak(&self) -> f64 {
        self.phases.iter().map(|p| p.1.peak()).fold(0.0, f64::max)
    }

    pub(super) fn highest_between(&self, from: f64, to: f64) -> f64 {
        let first = self.phases.partition_point(|p| p.1.s <= from).saturating_sub(1);
        let last = self.phases.partition_point(|p| p.1.s < to);
        self.phases[first..last].iter().map(|p| p.1.peak()).fold(0.0, f64::max)
    }
}
