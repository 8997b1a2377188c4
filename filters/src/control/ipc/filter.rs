//! Recursive filters of the stages: band-pass, all-pass and oscillator. They are discretised by the bilinear transform,
//! pre-warped to match the analogue filter exactly at the given frequency.
//!
//! All are written in `p = s / K` with the pre-warped `K = w0 / tan(w0 T / 2)`, so that `p = (z - 1) / (z + 1)` and
//! the centre frequency is `W = tan(pi f0 T)`.

use std::f64::consts::PI;

/// Second-order section, direct form 1.
#[derive(Clone, Copy, Debug)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
    x: [f64; 2],
    y: [f64; 2],
}

impl Section {
    /// `(n0 + n1 p + n2 p2) / (d0 + d1 p + d2 p2)`.
    fn bilinear([n0, n1, n2]: [f64; 3], [d0, d1, d2]: [f64; 3]) -> Self {
        let g = d0 + d1 + d2;
        Self {
            b: [(n0 + n1 + n2) / g, 2.0 * (n0 - n2) / g, (n0 - n1 + n2) / g],
            a: [2.0 * (d0 - d2) / g, (d0 - d1 + d2) / g],
            x: [0.0; 2],
            y: [0.0; 2],
        }
    }

    fn step(&mut self, x: f64) -> f64 {
        let [b0, b1, b2] = self.b;
        let [a1, a2] = self.a;
        let y = b0 * x + b1 * self.x[0] + b2 * self.x[1] - a1 * self.y[0] - a2 * self.y[1];
        // keep decaying vibrations out of the denormal range
        let y = if y.abs() < 1e-200 { 0.0 } else { y };
        self.x = [x, self.x[0]];
        self.y = [y, self.y[0]];
        y
    }
}

/// Up to three sections in series.
#[derive(Clone, Debug)]
pub(super) struct Cascade {
    sections: Vec<Section>,
}

impl Cascade {
    pub(super) fn step(&mut self, x: f64) -> f64 {
        self.sections.iter_mut().fold(x, |y, s| s.step(y))
    }

    pub(super) fn clear(&mut self) {
        for s in &mut self.sections {
            s.x = [0.0; 2];
            s.y = [0.0; 2];
        }
    }
}

/// Band-pass of order 1..=3 (2 to 6 poles): Butterworth low-pass of that order, transformed. Gain 1 and phase 0 at the
/// centre.
///
/// Assumption: Butterworth; the manual does not name the prototype here.
pub(super) fn band_pass(order: u32, frequency_hz: f64, quality: f64, cycle_s: f64) -> Cascade {
    let w = libm::tan(PI * frequency_hz * cycle_s);
    let width = w / quality;
    // real pole -1 of the odd orders: p2 + B p + W2
    let mut denominators = Vec::with_capacity(3);
    if order % 2 == 1 {
        denominators.push((width, w * w));
    }
    if order > 1 {
        // pole pair -c +- i s becomes two pairs, the roots of p2 + (c -+ i s) B p + W2
        let (c, s) =
            if order == 2 { (0.5_f64.sqrt(), 0.5_f64.sqrt()) } else { (0.5, 0.75_f64.sqrt()) };
        let (hr, hi) = (0.5 * c * width, 0.5 * s * width);
        let (rr, ri) = complex_sqrt(hr * hr - hi * hi - w * w, -2.0 * hr * hi);
        for (re, im) in [(-hr + rr, hi + ri), (-hr - rr, hi - ri)] {
            denominators.push((-2.0 * re, re * re + im * im));
        }
    }
    let section = |&(d1, d0): &(f64, f64)| Section::bilinear([0.0, width, 0.0], [d0, d1, 1.0]);
    Cascade { sections: denominators.iter().map(section).collect() }
}

/// All-pass of order 1..=3, 90 degrees of lag per order at the frequency: Butterworth polynomial over its mirror.
///
/// Assumption: the same prototype as for the band-pass.
pub(super) fn all_pass(order: u32, frequency_hz: f64, cycle_s: f64) -> Cascade {
    let w = libm::tan(PI * frequency_hz * cycle_s);
    let mut sections = Vec::with_capacity(2);
    if order % 2 == 1 {
        sections.push(Section::bilinear([w, -1.0, 0.0], [w, 1.0, 0.0]));
    }
    if order > 1 {
        let damping = if order == 2 { 2.0_f64.sqrt() } else { 1.0 };
        sections.push(Section::bilinear([w * w, -damping * w, 1.0], [w * w, damping * w, 1.0]));
    }
    Cascade { sections }
}

/// `w0^2 / (s2 + 2 D w0 s + w0^2)`: speed of a load suspended from a motor of the given speed. At its frequency the
/// gain is `1 / (2D)`, the phase -90 degrees.
pub(super) fn oscillator(frequency_hz: f64, damping_ratio: f64, cycle_s: f64) -> Cascade {
    let w = libm::tan(PI * frequency_hz * cycle_s);
    let section = Section::bilinear([w * w, 0.0, 0.0], [w * w, 2.0 * damping_ratio * w, 1.0]);
    Cascade { sections: vec![section] }
}

/// Principal square root of `re + i im`.
fn complex_sqrt(re: f64, im: f64) -> (f64, f64) {
    let r = (re * re + im * im).sqrt();
    let root_re = (0.5 * (r + re)).max(0.0).sqrt();
    let root_im = (0.5 * (r - re)).max(0.0).sqrt().copysign(im);
    (root_re, root_im)
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: f64 = 1e-3;

    /// Amplitude and phase in degrees, from the settled response to a cosine.
    fn response(mut cascade: Cascade, f: f64) -> (f64, f64) {
        let (mut re, mut im) = (0.0, 0.0);
        let settle = 40_000;
        let n = 10_000;
        for k in 0..settle + n {
            let phase = 2.0 * PI * f * T * f64::from(k);
            let y = cascade.step(libm::cos(phase));
            if k >= settle {
                re += y * libm::cos(phase);
                im -= y * libm::sin(phase);
            }
        }
        let scale = 2.0 / f64::from(n);
        (f64::hypot_of(re * scale, im * scale), libm::atan2(im, re).to_degrees())
    }

    trait Hypot {
        fn hypot_of(re: f64, im: f64) -> f64;
    }
    impl Hypot for f64 {
        fn hypot_of(re: f64, im: f64) -> f64 {
            libm::hypot(re, im)
        }
    }

    #[test]
    fn band_pass_has_gain_one_and_no_phase_at_its_centre() {
        for order in 1..=3 {
            for (f, q) in [(53.0, 10.0), (11.0, 3.0), (200.0, 1.0)] {
                let (gain, phase) = response(band_pass(order, f, q, T), f);
                assert!((gain - 1.0).abs() < 1e-9, "order {order} {f} Hz: {gain}");
                assert!(phase.abs() < 1e-6, "order {order} {f} Hz: {phase}");
            }
        }
    }

    /// Analogue law with both edges mapped: `|H|^2 = 1/(1 + x^2n)`, `x = Q (W/w - w/W)` in pre-warped frequencies.
    #[test]
    fn band_pass_is_butterworth() {
        for order in 1..=3_i32 {
            for f in [5.0, 30.0, 47.0, 50.0, 60.0, 120.0, 400.0] {
                let (f0, q) = (53.0, 4.0);
                let (gain, _) = response(band_pass(order.unsigned_abs(), f0, q, T), f);
                let (w, w0) = (libm::tan(PI * f * T), libm::tan(PI * f0 * T));
                let x = q * (w / w0 - w0 / w);
                let want = 1.0 / (1.0 + libm::pow(x, 2.0 * f64::from(order))).sqrt();
                assert!((gain - want).abs() < 1e-9, "order {order}, {f} Hz: {gain} {want}");
            }
        }
    }

    #[test]
    fn all_pass_turns_by_ninety_degrees_per_order() {
        for (order, phase_at_f0) in [(1, -90.0), (2, 180.0), (3, 90.0)] {
            let (gain, phase) = response(all_pass(order, 50.0, T), 50.0);
            assert!((gain - 1.0).abs() < 1e-9);
            let turned = libm::remainder(phase - phase_at_f0, 360.0);
            assert!(turned.abs() < 1e-6, "order {order}: {phase}");
            let (gain, _) = response(all_pass(order, 50.0, T), 130.0);
            assert!((gain - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn oscillator_at_its_frequency() {
        for d in [0.2, 0.05] {
            let (gain, phase) = response(oscillator(11.0, d, T), 11.0);
            assert!((gain - 0.5 / d).abs() < 1e-8, "{gain}");
            assert!((phase + 90.0).abs() < 1e-6, "{phase}");
        }
        assert!((response(oscillator(11.0, 0.2, T), 0.1).0 - 1.0).abs() < 1e-4, "follows slowly");
    }
}
