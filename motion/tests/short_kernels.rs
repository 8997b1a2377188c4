//! `AX_DEV` with filters of a few cycles: a contour never takes longer than with a rest in every corner.

use crate::common::{Job, axis, channel, even};
use kontur_filters::kernel::{Kernel, Tap};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::{Pen, Random, environment};
use kontur_motion::axis::StepSlope;
use kontur_motion::block::SlopeKind::{self, Step, Trapez};
use kontur_motion::block::Tolerance;

/// Lengths of the filters in cycles.
const LENGTHS: std::ops::RangeInclusive<u32> = 2..=6;

#[derive(Debug)]
struct Case {
    points: Vec<[f64; 2]>,
    kind: SlopeKind,
    cycle_us: u32,
    feed_mm_s: f64,
    acc_mm_s2: f64,
    ramp_s: f64,
    tolerance_mm: f64,
    kernel: Kernel,
}

/// A vibration guard, or taps of any weight.
fn kernel(r: &mut Random, cycle_us: u32) -> Kernel {
    let cycle = CycleTime::from_us(cycle_us).unwrap();
    loop {
        let kernel = if r.chance(0.5) {
            let mode = 1 + (4.0 * r.ratio()) as u8;
            let freq_hz = r.log(0.08, 1.0) / cycle.seconds();
            VibGuardSettings { mode, freq_hz, damping: r.between(0.0, 0.3) }.kernel(cycle).ok()
        } else {
            let delays = 0..=(r.between(2.0, 7.0) as u32);
            let mut tap = |delay| Tap { delay, weight: r.between(0.02, 1.0) };
            Kernel::from_taps(delays.map(&mut tap))
        };
        if let Some(kernel) =
            kernel.filter(|k| LENGTHS.contains(&k.length()) && !k.has_negative_taps())
        {
            return kernel;
        }
    }
}

impl Case {
    fn new(r: &mut Random) -> Self {
        let kind = [Step, Trapez][(2.0 * r.ratio()) as usize];
        let cycle_us = [250, 500, 1000, 2000, 4000][(5.0 * r.ratio()) as usize];
        let (feed_mm_s, acc_mm_s2) = (r.log(1.0, 300.0), r.log(300.0, 8000.0));
        // a ramp in which the acceleration is reached
        let ramp_s = r.between(0.1, 1.0) * feed_mm_s / acc_mm_s2 / 2.0_f64.sqrt();
        // every line is long enough for the feed
        let least = feed_mm_s * (feed_mm_s / acc_mm_s2 + ramp_s);
        let mut pen = Pen { heading: r.between(-3.1, 3.1), ..Pen::default() };
        let mut points = vec![pen.at];
        for _ in 0..2 + (5.0 * r.ratio()) as usize {
            points.push(pen.go(least * r.log(1.0, 30.0) * 1.01 + 0.01));
            pen.heading += if r.chance(0.3) { r.between(-0.3, 0.3) } else { r.between(-3.1, 3.1) };
        }
        let kernel = kernel(r, cycle_us);
        let tolerance_mm = r.log(1e-4, 1e-1);
        Self { points, kind, cycle_us, feed_mm_s, acc_mm_s2, ramp_s, tolerance_mm, kernel }
    }

    fn cycles(&self) -> usize {
        let a = self.acc_mm_s2;
        let mut machine = axis(1.0);
        machine.feed = even(a, self.ramp_s);
        machine.step_feed = StepSlope { acc_mm_s2: [a; 2], dec_mm_s2: [a; 2], change_mm_s: 100.0 };
        machine.a_max_mm_s2 = 10_000.0;
        let job = Job {
            cycle_us: self.cycle_us,
            dynamics: channel(vec![machine; 2]),
            kernels: vec![self.kernel.clone()],
            tolerance: Tolerance { ax_dev_mm: Some(self.tolerance_mm), acc_fact: 1.0 },
            ..Job::new(1.0, self.kind)
        };
        job.drive(&self.points, &[self.feed_mm_s]).len() - 1
    }

    /// Cycles with a rest in every corner, one cycle longer than the filter is: `L / v + v / a + tr` for every line, up to
    /// the next tick; the weaker axis gives the acceleration, and no ramp is longer than the axis'.
    fn rests(&self) -> usize {
        let lines = self.points.windows(2).map(|w| {
            let d = [w[1][0] - w[0][0], w[1][1] - w[0][1]];
            let length = libm::hypot(d[0], d[1]);
            let steepest = d[0].abs().max(d[1].abs()) / length;
            let acc = self.acc_mm_s2 / steepest;
            let ramp_s = if self.kind == Step { 0.0 } else { self.ramp_s };
            let time = length / self.feed_mm_s + self.feed_mm_s / acc + ramp_s;
            (time / (1e-6 * f64::from(self.cycle_us)) - 1e-9).ceil() as usize
        });
        lines.sum::<usize>() + (self.points.len() - 2) * (self.kernel.length() as usize + 1)
    }
}

/// `COUNT=2000 SEED=7` takes more and others.
#[test]
fn a_rest_in_every_corner_is_never_faster() {
    let mut r = Random::from_state(environment("SEED", 5));
    let mut worst = 0.0_f64;
    for n in 0..environment("COUNT", 300) {
        let case = Case::new(&mut r);
        let (kept, rests) = (case.cycles(), case.rests());
        worst = worst.max(kept as f64 / rests as f64);
        assert!(kept <= rests, "{n}: {kept} cycles, {rests} with rests: {case:?}");
    }
    println!("at most {worst:.3} of the time with rests");
}
