//! A mass on a spring and a damper whose foot follows a set position: a model of an elastic machine.
//!
//! Make the spring, step it once per cycle of a motion, then read the residual amplitude:
//!
//! ```
//! use kontur_filters::analysis::spring::SpringMass;
//! use kontur_filters::time::CycleTime;
//!
//! let mut spring = SpringMass::new(20.0, 0.0, CycleTime::DEFAULT).unwrap();
//! // accelerating for one period leaves nothing, for half a period all of it
//! let deflections: Vec<f64> = (0..50).map(|_| spring.step(1000.0)).collect();
//! assert!(spring.amplitude() < 1e-9);
//! assert!(deflections.iter().all(|q| *q < 1e-9));
//! (0..25).for_each(|_| drop(spring.step(1000.0)));
//! assert!(spring.amplitude() > 0.1);
//! ```

use crate::time::CycleTime;
use crate::vibration::damped_ratio;
use std::f64::consts::TAU;

/// The mass, described by the deflection `q` of its spring in mm: `q'' + 2 D w q' + w^2 q = -a`, with the acceleration `a` of the foot.
///
/// The acceleration is constant over each cycle, as for a set position that the drive interpolates. The solution is
/// therefore exact: the free decaying vibration continues about `q = -a / w^2`, the equilibrium of the spring.
#[derive(Clone, Copy, Debug)]
pub struct SpringMass {
    /// Undamped natural frequency in 1/s.
    w: f64,
    damped_w: f64,
    damping: f64,
    /// `exp(-D w T)`, `sin` and `cos` of the damped angle of a cycle.
    decay: f64,
    sin: f64,
    cos: f64,
    /// Deflection in mm and its speed in mm/s.
    q: f64,
    v: f64,
}

impl SpringMass {
    /// A mass at rest. Undamped natural frequency in Hz, above 0; damping ratio from 0 to below 1. `None` for other
    /// values.
    pub fn new(freq_hz: f64, damping: f64, cycle: CycleTime) -> Option<Self> {
        if !(freq_hz > 0.0 && freq_hz.is_finite() && (0.0..1.0).contains(&damping)) {
            return None;
        }
        let w = TAU * freq_hz;
        let damped_w = w * damped_ratio(damping);
        let (sin, cos) = libm::sincos(damped_w * cycle.seconds());
        let decay = libm::exp(-damping * w * cycle.seconds());
        Some(Self { w, damped_w, damping, decay, sin, cos, q: 0.0, v: 0.0 })
    }

    /// The deflection in mm after a cycle in which the foot accelerates by `a` in mm/s2.
    pub fn step(&mut self, a: f64) -> f64 {
        let rest = -a / (self.w * self.w);
        let (x, v, lean) = (self.q - rest, self.v, self.damping * self.w / self.damped_w);
        self.q =
            rest + self.decay * ((self.cos + lean * self.sin) * x + self.sin / self.damped_w * v);
        self.v = self.decay
            * ((self.cos - lean * self.sin) * v - self.w * self.w / self.damped_w * self.sin * x);
        self.q
    }

    /// Amplitude in mm of the vibration that remains once the foot stops accelerating.
    pub fn amplitude(&self) -> f64 {
        libm::hypot(self.q, (self.v + self.damping * self.w * self.q) / self.damped_w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::response::residual_vibration_ratio;
    use crate::vib_guard::VibGuardSettings;
    use kontur_kit::Oscillator;

    fn cycle() -> CycleTime {
        CycleTime::from_us(1000).unwrap()
    }

    /// A constant acceleration for a time `t` leaves `2 a / w^2 |sin(w t / 2)|` on an undamped spring, 0 if `t` is one
    /// period.
    #[test]
    fn a_rectangle_of_acceleration_leaves_its_closed_form() {
        for (freq_hz, cycles) in [(10.0, 100), (10.0, 37), (12.5, 40), (3.7, 250)] {
            let mut spring = SpringMass::new(freq_hz, 0.0, cycle()).unwrap();
            let most = (0..cycles).map(|_| spring.step(2000.0)).fold(0.0, |m: f64, q| m.max(-q));
            let w = TAU * freq_hz;
            let left = 2.0 * 2000.0 / (w * w) * libm::sin(0.5 * w * f64::from(cycles) * 1e-3).abs();
            assert!((spring.amplitude() - left).abs() < 1e-9 * most.max(1.0), "{freq_hz} {cycles}");
            // a free vibration keeps its amplitude
            for _ in 0..500 {
                spring.step(0.0);
            }
            assert!((spring.amplitude() - left).abs() < 1e-9);
            if cycles == 100 {
                // half a period: twice the static deflection
                assert!((most - 2.0 * 2000.0 / (w * w)).abs() < 1e-6 * most, "{most}");
            }
        }
    }

    /// Against small steps of the differential equation (Runge and Kutta), with damping.
    #[test]
    fn follows_the_differential_equation() {
        let (freq_hz, damping) = (23.0, 0.07);
        let a = |k: u32| 3000.0 * libm::sin(f64::from(k) * 0.11) * f64::from(k % 7);
        let mut spring = SpringMass::new(freq_hz, damping, cycle()).unwrap();
        let mut small = Oscillator::new(freq_hz, damping);
        for k in 0..400 {
            small.advance(a(k), 1e-3, 50);
            assert!((spring.step(a(k)) - small.q).abs() < 1e-9, "{k}");
        }
    }

    /// A velocity jump through a shaper leaves the share that the impulses of the shaper predict; none at the set
    /// frequency.
    #[test]
    fn shapers_leave_what_their_impulses_promise() {
        let settings = VibGuardSettings { mode: 2, freq_hz: 20.0, damping: 0.05 };
        let impulses = settings.kernel(cycle()).unwrap().impulses(cycle());
        let left = |pulses: &[(u64, f64)], freq_hz: f64| {
            let mut spring = SpringMass::new(freq_hz, 0.05, cycle()).unwrap();
            let last = pulses.iter().map(|p| p.0).max().unwrap();
            for k in 0..=last {
                let share: f64 = pulses.iter().filter(|p| p.0 == k).map(|p| p.1).sum();
                spring.step(share * 1e5);
            }
            spring.amplitude()
        };
        let shaped: Vec<(u64, f64)> =
            impulses.iter().map(|i| ((i.time_s * 1e3).round() as u64, i.amplitude)).collect();
        for freq_hz in [14.0, 17.0, 20.0, 26.0] {
            let ratio = left(&shaped, freq_hz) / left(&[(0, 1.0)], freq_hz);
            let promised = residual_vibration_ratio(&impulses, freq_hz, 0.05);
            assert!((ratio - promised).abs() < 1e-9, "{freq_hz}: {ratio} {promised}");
        }
    }

    #[test]
    fn what_is_no_spring() {
        for (freq_hz, damping) in
            [(0.0, 0.1), (-1.0, 0.1), (f64::NAN, 0.1), (10.0, 1.0), (10.0, -0.1)]
        {
            assert!(SpringMass::new(freq_hz, damping, cycle()).is_none());
        }
    }
}
