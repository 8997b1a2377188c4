//! The buffer between interpolator and position controller.
//!
//! Feedforward looks ahead, so the position path is delayed: by five interpolator cycles, by one with
//! `feedforward_without_delay` (P-AXIS-00566), by none if no axis of the channel has feedforward. All axes of a channel
//! get the same delay, whether or not G135 is active; they stay synchronous, and switching feedforward causes no jump.
//!
//! Source: TF5200 axis parameters, P-AXIS-00566 (five cycles); TF5200 feedforward control (at least one cycle).
//!
//! Each cycle pushes first, then reads:
//!
//! ```
//! use kontur_filters::control::buffer::{Setpoint, SetpointBuffer};
//!
//! let mut buffer = SetpointBuffer::new(5, 0);
//! buffer.start(0.0);
//! let seen: Vec<f64> = (1..=7)
//!     .map(|k| {
//!         buffer.push(Setpoint { position_mm: f64::from(k), gain: 1.0, jerk_limited: true });
//!         buffer.reference_mm()
//!     })
//!     .collect();
//! assert_eq!(seen, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 2.0]);
//! // two before the reference, itself, and three that feedforward sees in advance
//! assert_eq!(buffer.window().positions_mm, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
//! ```

/// One cycle of one axis as it enters the buffer: flags travel with their position, so that a switch acts on the
/// motion it was programmed for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// Set position in mm.
    pub position_mm: f64,
    /// Feedforward gain 0..=1 ([`FeedforwardConfig::gain`](super::FeedforwardConfig::gain)).
    pub gain: f64,
    /// The motion has a jerk-limited slope (TRAPEZ, SIN2, HSC).
    pub jerk_limited: bool,
}

/// Six successive setpoints around the one for which feedforward is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Two and one cycles before, this cycle, one, two and three cycles after; mm.
    pub positions_mm: [f64; 6],
    /// Gain of the motion in the window.
    pub gain: f64,
    /// Jerk limitation of the motion in the window.
    pub jerk_limited: bool,
}

/// Ring of setpoints with a fixed delay.
#[derive(Clone, Debug)]
pub struct SetpointBuffer {
    ring: [Setpoint; Self::CAPACITY],
    newest: usize,
    delay: usize,
    shift: usize,
    /// Number of consecutive setpoints without feedforward, up to the newest one.
    without_gain: usize,
}

impl SetpointBuffer {
    /// Base delay 5, time offset 4, two setpoints before the reference and the reference itself; rounded up to a power
    /// of two.
    pub(crate) const CAPACITY: usize = 16;
    /// Longest delay in cycles.
    pub(crate) const MAX_DELAY: usize = Self::CAPACITY - 3;

    /// A buffer that delays by `delay_cycles`; feedforward is computed `shift_cycles` before its setpoint. Both are
    /// limited to the capacity of the ring.
    pub fn new(delay_cycles: usize, shift_cycles: usize) -> Self {
        let delay = delay_cycles.min(Self::MAX_DELAY);
        let ring = [Setpoint::default(); Self::CAPACITY];
        Self {
            ring,
            newest: 0,
            delay,
            shift: shift_cycles.min(delay),
            without_gain: Self::CAPACITY,
        }
    }

    /// Delay in cycles.
    pub const fn delay_cycles(&self) -> usize {
        self.delay
    }

    /// Fills the buffer with an axis at rest.
    pub fn start(&mut self, position_mm: f64) {
        self.ring = [Setpoint { position_mm, ..Setpoint::default() }; Self::CAPACITY];
        self.without_gain = Self::CAPACITY;
    }

    /// Whether both buffers will output the same setpoints once they hold the same ones.
    pub(crate) const fn holds_like(&self, other: &Self) -> bool {
        self.delay == other.delay && self.shift == other.shift
    }

    /// Shifts every setpoint by `by_mm`.
    pub(crate) fn shift(&mut self, by_mm: f64) {
        for setpoint in &mut self.ring {
            setpoint.position_mm += by_mm;
        }
    }

    /// Takes the setpoint of this cycle.
    #[inline]
    pub fn push(&mut self, setpoint: Setpoint) {
        self.newest = (self.newest + 1) % Self::CAPACITY;
        self.ring[self.newest] = setpoint;
        let has_gain = setpoint.gain.to_bits() != 0;
        self.without_gain = if has_gain { 0 } else { self.without_gain.saturating_add(1) };
    }

    /// Takes the setpoints of consecutive cycles without feedforward, of slopes with limited jerk or without.
    pub(crate) fn pass(
        &mut self,
        positions_mm: impl DoubleEndedIterator<Item = f64>,
        jerk_limited: bool,
    ) {
        // earlier ones would be overwritten
        let mut newest = [0.0; Self::CAPACITY];
        let mut count = 0;
        for (place, position_mm) in newest.iter_mut().zip(positions_mm.rev()) {
            *place = position_mm;
            count += 1;
        }
        for position_mm in newest[..count].iter().rev() {
            self.push(Setpoint { position_mm: *position_mm, gain: 0.0, jerk_limited });
        }
    }

    /// Whether no setpoint of the buffer has feedforward: the gain of every window is then 0.
    pub(crate) const fn is_without_gain(&self) -> bool {
        self.without_gain >= Self::CAPACITY
    }

    /// Setpoint `age - ahead` cycles ago, not beyond the newest one.
    #[inline]
    fn at(&self, age: usize, ahead: usize) -> &Setpoint {
        let age = age.saturating_sub(ahead);
        &self.ring[(self.newest + Self::CAPACITY - age) % Self::CAPACITY]
    }

    /// Position the controller works on in this cycle, mm.
    #[inline]
    pub fn reference_mm(&self) -> f64 {
        self.at(self.delay, 0).position_mm
    }

    /// The positions in mm on which the controller will work in the next cycles, as far as they are in the buffer now: as many as
    /// the delay has cycles.
    pub(crate) fn waiting_mm(&self) -> [f64; Self::CAPACITY] {
        let age = |i: usize| self.delay.saturating_sub(1 + i);
        std::array::from_fn(|i| self.at(age(i), 0).position_mm)
    }

    /// The setpoints from which feedforward is computed.
    ///
    /// A flag belongs to the motion that leads to its setpoint. The window reaches three cycles ahead. If one flag
    /// holds for everything that moves in the window, that flag counts: a motion that starts from rest is fed forward
    /// from its first difference on. If the flags change while the axis moves, those of the coming cycle count.
    pub fn window(&self) -> Window {
        let centre = self.delay - self.shift;
        let all = [
            self.at(centre + 2, 0),
            self.at(centre + 1, 0),
            self.at(centre, 0),
            self.at(centre, 1),
            self.at(centre, 2),
            self.at(centre, 3),
        ];
        let moves = |pair: &&[&Setpoint]| (pair[1].position_mm - pair[0].position_mm).abs() > 0.0;
        let same = |a: &Setpoint, b: &Setpoint| {
            a.gain.to_bits() == b.gain.to_bits() && a.jerk_limited == b.jerk_limited
        };
        let mut flags = all[3];
        let mut moving = all.windows(2).filter(moves).map(|pair| pair[1]);
        if let Some(first) = moving.next()
            && moving.all(|other| same(first, other))
        {
            flags = first;
        }
        Window {
            positions_mm: all.map(|s| s.position_mm),
            gain: flags.gain,
            jerk_limited: flags.jerk_limited,
        }
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::float_cmp, reason = "exact values are what is tested")]

    use super::*;

    fn at(position_mm: f64) -> Setpoint {
        Setpoint { position_mm, gain: position_mm / 100.0, jerk_limited: position_mm > 6.0 }
    }

    #[test]
    fn delays_by_its_depth_and_looks_ahead() {
        for delay in [0, 1, 5] {
            let mut buffer = SetpointBuffer::new(delay, 0);
            buffer.start(0.0);
            for k in 0..40_u32 {
                buffer.push(at(f64::from(k)));
                let want = f64::from(k) - delay as f64;
                assert_eq!(buffer.reference_mm(), want.max(0.0), "delay {delay}, cycle {k}");
            }
        }
        let mut buffer = SetpointBuffer::new(5, 0);
        (0..20).for_each(|k| buffer.push(at(f64::from(k))));
        let window = buffer.window();
        assert_eq!(window.positions_mm, [12.0, 13.0, 14.0, 15.0, 16.0, 17.0]);
        assert_eq!(
            (window.gain, window.jerk_limited),
            (0.15, true),
            "flags of the coming cycle while they change"
        );
    }

    /// At the start of a motion its flags count from its first appearance in the window, at the end until its last.
    #[test]
    fn flags_belong_to_the_motion() {
        let mut buffer = SetpointBuffer::new(5, 0);
        buffer.start(0.0);
        let mut gains = Vec::new();
        for k in 0..20_u32 {
            let moving = (5..10).contains(&k);
            let position_mm = f64::from(k.clamp(4, 9) - 4);
            let gain = if moving { 0.8 } else { 0.0 };
            buffer.push(Setpoint { position_mm, gain, jerk_limited: moving });
            let window = buffer.window();
            let moves = window.positions_mm.windows(2).any(|w| w[0] != w[1]);
            gains.push((moves, window.gain, window.jerk_limited));
        }
        for (moves, gain, limited) in gains {
            assert_eq!((gain, limited), if moves { (0.8, true) } else { (0.0, false) });
        }
    }

    #[test]
    fn time_offset_takes_feedforward_before_its_setpoint() {
        let mut buffer = SetpointBuffer::new(8, 3);
        (0..20).for_each(|k| buffer.push(at(f64::from(k))));
        assert_eq!(buffer.reference_mm(), 11.0);
        assert_eq!(buffer.window().positions_mm[2], 14.0, "three cycles later than the reference");
    }
}
