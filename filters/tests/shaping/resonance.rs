//! A band stop against the resonance of a mass on a spring.

use super::corner::path;
use super::figures::band_stop;
use super::reference::assert_close;
use kontur_filters::iir::AxisFilter;
use kontur_filters::iir::prototype::Prototype;
use kontur_filters::stage::Stage;
use std::f64::consts::PI;

/// A mass on a spring of 20 Hz, damping 0.02, its base moved by what a filter gives; exact for a base that moves at
/// constant speed within the cycle.
#[derive(Clone)]
struct Mode {
    filter: Option<AxisFilter>,
    base: f64,
    deviation: f64,
    speed: f64,
}

impl Stage for Mode {
    fn step(&mut self, x: f64) -> f64 {
        let (w, z, t) = (2.0 * PI * 20.0, 0.02, 0.001);
        let damped = w * f64::sqrt(1.0 - z * z);
        let base = self.filter.as_mut().map_or(x, |filter| filter.step(x));
        let base_speed = (base - self.base) / t;
        // relative to the base, whose speed steps at the start of the cycle
        let (d, v) = (self.deviation, self.speed - base_speed);
        let (sin, cos) = libm::sincos(damped * t);
        let decay = libm::exp(-z * w * t);
        let s = (v + z * w * d) / damped;
        self.deviation = decay * (d * cos + s * sin);
        self.speed =
            decay * (-d * damped * sin + s * damped * cos) - z * w * self.deviation + base_speed;
        self.base = base;
        base + self.deviation
    }

    fn settle(&mut self, x: f64) {
        if let Some(filter) = &mut self.filter {
            filter.settle(x);
        }
        (self.base, self.deviation, self.speed) = (x, 0.0, 0.0);
    }

    fn delay_cycles(&self) -> f64 {
        0.0
    }
}

/// A corner that excites a mode of 20 Hz: the overshoot of the band-stop is smaller than the vibration it removes.
/// Conformance: A047.
#[test]
fn a_band_stop_is_better_than_the_resonance() {
    let error = |filter| {
        let mode = Mode { filter, base: 0.0, deviation: 0.0, speed: 0.0 };
        // far enough before the corner for the start to have decayed
        corner_of(&mode, 1000.0 / 60.0 * 0.001, 4000)
    };
    let (plain, stopped) =
        (error(None), error(Some(band_stop(Prototype::Butterworth, 2, 20.0, 4.0))));
    // v / w of an almost undamped mode
    assert_close(plain, 1000.0 / 60.0 / (2.0 * PI * 20.0), 0.1 * plain, &"without");
    assert!(stopped < 0.8 * plain, "{stopped} of {plain}");
}

/// Largest distance from the contour after the corner, where the start no longer rings.
fn corner_of<S: Stage + Clone>(stage: &S, per_cycle: f64, cycles: u32) -> f64 {
    let points = path(stage, per_cycle, cycles);
    let distance = |&(x, y): &(f64, f64)| {
        let corner = libm::hypot(x, y);
        let first = if x <= 0.0 { y.abs() } else { corner };
        let second = if y >= 0.0 { x.abs() } else { corner };
        first.min(second)
    };
    points[cycles as usize - 10..].iter().map(distance).fold(0.0, f64::max)
}
