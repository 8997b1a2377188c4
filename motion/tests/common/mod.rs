//! Machines and programs for the planner's tests.
#![allow(
    dead_code,
    clippy::unwrap_used,
    reason = "a helper of tests, every file uses its own part"
)]

pub(crate) mod events;

use kontur_filters::kernel::{Kernel, Tap};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::{Random, from_polyline, largest};
use kontur_motion::axis::{AxisDynamics, AxisVec, FeedSlope, FeedholdSlope, RapidSlope, StepSlope};
use kontur_motion::block::{Block, ChannelDynamics, Feed, Slope, SlopeKind, Tolerance};
use kontur_motion::cap::SpeedLimit;
use kontur_motion::path::{ArcPath, ArcShape, LinePath, Path};
use kontur_motion::planner::{Next, Planner, Setpoint};
use kontur_motion::tolerance::Kernels;
use std::sync::Arc;

/// Axis of the vendor's defaults: 1000 mm/s2, ramps of 50 ms; 1 m/s.
pub(crate) fn axis(weight: f64) -> AxisDynamics {
    let step = StepSlope { acc_mm_s2: [1000.0; 2], dec_mm_s2: [1000.0; 2], change_mm_s: 100.0 };
    AxisDynamics {
        v_max_mm_s: 1000.0,
        v_rapid_mm_s: 1000.0,
        a_max_mm_s2: 1000.0,
        a_emergency_mm_s2: 1000.0,
        tr_geom_s: 0.01,
        feed: even(1000.0, 0.05),
        rapid: RapidSlope { acc_mm_s2: 1000.0, ramp_s: 0.01 },
        feedhold: FeedholdSlope { step_dec_mm_s2: 2000.0, dec_mm_s2: 2000.0, ramp_s: 0.02 },
        step_feed: step,
        step_rapid: step,
        a_trans_ratio: weight,
        r_trans_ratio: 1.0,
        j_trans_kink_mm_s3: 0.0,
        j_trans_tangential_mm_s3: 0.0,
    }
}

/// A slope with the same acceleration up and down, and equal ramps.
pub(crate) fn even(acc_mm_s2: f64, ramp_s: f64) -> FeedSlope {
    FeedSlope { acc_mm_s2, dec_mm_s2: acc_mm_s2, ramps_s: [ramp_s; 4] }
}

/// Axes with such a slope.
pub(crate) fn machine(
    axes: usize,
    weight: f64,
    acc_mm_s2: f64,
    ramp_s: f64,
) -> Arc<ChannelDynamics> {
    channel(vec![AxisDynamics { feed: even(acc_mm_s2, ramp_s), ..axis(weight) }; axes])
}

pub(crate) fn channel(axes: Vec<AxisDynamics>) -> Arc<ChannelDynamics> {
    Arc::new(ChannelDynamics::new(axes))
}

#[derive(Debug)]
pub(crate) struct Job {
    pub(crate) dynamics: Arc<ChannelDynamics>,
    pub(crate) slope: Slope,
    pub(crate) cycle_us: u32,
    pub(crate) tolerance: Tolerance,
    /// One for each axis, or one for all of them.
    pub(crate) kernels: Vec<Kernel>,
    pub(crate) window: usize,
    /// Cycles at rest before the first motion.
    pub(crate) rest_cycles: usize,
}

impl Job {
    pub(crate) fn new(weight: f64, kind: SlopeKind) -> Self {
        Self {
            dynamics: channel(vec![axis(weight); 2]),
            slope: Slope { kind, ..Slope::default() },
            cycle_us: 1000,
            tolerance: Tolerance::default(),
            kernels: Vec::new(),
            window: 120,
            rest_cycles: 0,
        }
    }

    /// With a vibration guard for all axes.
    pub(crate) fn guarded(
        mut self,
        mode: u8,
        freq_hz: f64,
        damping: f64,
        ax_dev_mm: Option<f64>,
    ) -> Self {
        let cycle = CycleTime::from_us(self.cycle_us).unwrap();
        let guard = VibGuardSettings { mode, freq_hz, damping };
        self.kernels = vec![guard.kernel(cycle).unwrap()];
        self.tolerance = Tolerance { ax_dev_mm, acc_fact: 1.0 };
        self
    }

    /// The kernels of so many axes.
    pub(crate) fn kernels(&self, axes: usize) -> Kernels {
        let of_axis = |i: usize| self.kernels.get(i).or(self.kernels.first());
        Kernels::new((0..axes).map(|i| of_axis(i).map(|k| Arc::new(k.clone()))).collect())
    }

    pub(crate) fn block(&self, seq: u64, path: Path, feed_mm_s: f64) -> Block {
        let feed = Feed::PathVelocity(feed_mm_s);
        let block = Block::new(seq, path, feed, Arc::clone(&self.dynamics));
        Block { slope: self.slope, tolerance: self.tolerance, ..block }
    }

    /// A straight block.
    pub(crate) fn line(&self, seq: u64, from: &[f64], to: &[f64], feed_mm_s: f64) -> Block {
        let [from, to] = [from, to].map(AxisVec::from_slice);
        let line = LinePath::new(from, to, &self.dynamics.feed_axes).unwrap();
        self.block(seq, Path::Line(line), feed_mm_s)
    }

    /// Drives a polyline; the feeds are cycled.
    pub(crate) fn drive<P: AsRef<[f64]>>(&self, points: &[P], feeds_mm_s: &[f64]) -> Vec<Setpoint> {
        let blocks = points.windows(2).enumerate().filter_map(|(i, ends)| {
            let [from, to] = [0, 1].map(|k| AxisVec::from_slice(ends[k].as_ref()));
            let line = LinePath::new(from, to, &self.dynamics.feed_axes)?;
            Some(self.block(i as u64, Path::Line(line), feeds_mm_s[i % feeds_mm_s.len()]))
        });
        self.run(points[0].as_ref(), blocks)
    }

    /// Setpoints from the start to rest, the kernel's length of standstill after them.
    pub(crate) fn run(&self, start: &[f64], blocks: impl Iterator<Item = Block>) -> Vec<Setpoint> {
        let cycle = CycleTime::from_us(self.cycle_us).unwrap();
        let mut planner = Planner::new(cycle, self.window, start);
        planner.set_kernels(self.kernels(start.len()), 0);
        for _ in 0..self.rest_cycles {
            planner.hold(SpeedLimit::Stop);
        }
        let mut blocks = blocks;
        let mut out = vec![planner.setpoint().clone()];
        loop {
            match planner.advance().unwrap() {
                Next::Setpoint => out.push(planner.setpoint().clone()),
                Next::Input => match blocks.next() {
                    Some(b) => planner.push(b),
                    None => planner.finish(),
                },
                Next::Rest | Next::Stopped => break,
            }
            assert!(out.len() < 3_000_000, "a crawl");
        }
        let unkept = planner.take_unkept();
        assert!(unkept.is_empty(), "{unkept:?}");
        out
    }
}

/// Set points of a run: each axis through its kernel, flushed at the end.
pub(crate) fn filtered(out: &[Setpoint], kernels: &[Kernel]) -> Vec<Vec<f64>> {
    let path: Vec<&[f64]> = out.iter().map(|point| &point.position[..]).collect();
    through(&path, kernels)
}

/// Points of successive cycles, each axis through its kernel, flushed at the end.
pub(crate) fn through<P: AsRef<[f64]>>(path: &[P], kernels: &[Kernel]) -> Vec<Vec<f64>> {
    let longest = kernels.iter().map(|k| k.length() as usize).max().unwrap();
    let at = |k: usize, i: usize| path[k.min(path.len() - 1)].as_ref()[i];
    let filtered = |k: usize, i: usize| {
        let x = at(k, i);
        let pull = |t: &Tap| t.weight * (at(k.saturating_sub(t.delay as usize), i) - x);
        x + kernels.get(i).unwrap_or(&kernels[0]).taps().iter().map(pull).sum::<f64>()
    };
    let axes = path[0].as_ref().len();
    (0..path.len() + longest).map(|k| (0..axes).map(|i| filtered(k, i)).collect()).collect()
}

/// Largest axis component of the shortest vector from a polyline to a point.
pub(crate) fn deviation<P: AsRef<[f64]>>(point: &[f64], polyline: &[P]) -> f64 {
    largest(&from_polyline(point, polyline))
}

/// Numbers separated by blanks.
pub(crate) fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(|n| n.parse().unwrap()).collect()
}

/// Points separated by semicolons.
pub(crate) fn points(text: &str) -> Vec<Vec<f64>> {
    text.split(';').map(numbers).collect()
}

/// A line of all axes.
pub(crate) fn line(from: &[f64], to: &[f64]) -> Path {
    let [from, to] = [from, to].map(AxisVec::from_slice);
    Path::Line(LinePath::new(from, to, &[]).unwrap())
}

/// An arc of the first two axes.
pub(crate) fn arc(from: &[f64], to: &[f64], centre_mm: [f64; 2], sweep_rad: f64) -> Path {
    let shape = ArcShape { plane: [0, 1], centre_mm, sweep_rad };
    let [from, to] = [from, to].map(AxisVec::from_slice);
    Path::Arc(ArcPath::new(from, to, shape, &[]).unwrap())
}

fn vector(path: &Path, of: impl Fn(&mut [f64])) -> Vec<f64> {
    let mut vector = path.start().to_vec();
    of(&mut vector);
    vector
}

/// Point of a path.
pub(crate) fn at(path: &Path, s_mm: f64) -> Vec<f64> {
    vector(path, |v| path.position(s_mm, v))
}

/// Direction of a path.
pub(crate) fn tangent(path: &Path, s_mm: f64) -> Vec<f64> {
    vector(path, |v| path.tangent(s_mm, v))
}

/// Curvature vector of a path in 1/mm.
pub(crate) fn curvature(path: &Path, s_mm: f64) -> Vec<f64> {
    vector(path, |v| path.curvature(s_mm, v))
}

/// Length of a vector.
pub(crate) fn norm(v: &[f64]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Distance of two points.
pub(crate) fn apart(p: &[f64], q: &[f64]) -> f64 {
    p.iter().zip(q).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Points of a contour of lines: corners, gentle bends, or up to `chords` chords of arcs.
pub(crate) fn contour(r: &mut Random, chords: u32) -> Vec<[f64; 3]> {
    let kinds = [(2.8, 0.05, 20.0, 20), (0.2, 0.05, 5.0, 20), (0.03, 0.1, 0.3, chords)];
    let (turn, low, high, most) = r.pick(&kinds);
    let count = 3 + (r.ratio() * f64::from(most)) as usize;
    let (mut at, mut heading) = ([0.0_f64; 3], 6.3 * r.ratio());
    let curve = turn * r.between(-0.5, 0.5);
    let mut out = vec![at];
    for _ in 0..count {
        heading += curve + turn * r.between(-0.5, 0.5);
        let (sin, cos) = libm::sincos(heading);
        let l = r.log(low, high);
        at = [at[0] + l * cos, at[1] + l * sin, at[2] + 0.2 * l * r.between(-1.0, 1.0)];
        out.push(at);
    }
    out
}

/// Points on a circle about the origin in equal chords of about `chord`, twice round.
pub(crate) fn circle(radius: f64, chord: f64) -> Vec<Vec<f64>> {
    let n = libm::round(2.0 * std::f64::consts::PI * radius / chord);
    (0..=2 * n as usize)
        .map(|k| {
            let (sin, cos) = libm::sincos(2.0 * std::f64::consts::PI * k as f64 / n);
            vec![radius * cos, radius * sin]
        })
        .collect()
}

/// Number of setpoints and the peaks of their second and third differences, in mm/s2 and mm/s3.
pub(crate) fn peaks(out: &[Setpoint], cycle_us: u32) -> (usize, f64, f64) {
    let t = f64::from(cycle_us) * 1e-6;
    let p = |k: usize, i: usize| out[k.min(out.len() - 1)].position[i];
    let (mut acc, mut jerk) = (0.0_f64, 0.0_f64);
    for k in 0..out.len() {
        for i in 0..2 {
            let a = |k: usize| (p(k + 2, i) - 2.0 * p(k + 1, i) + p(k, i)) / (t * t);
            acc = acc.max(a(k).abs());
            jerk = jerk.max((a(k + 1) - a(k)).abs() / t);
        }
    }
    (out.len(), acc, jerk)
}
