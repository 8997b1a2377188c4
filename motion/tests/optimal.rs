//! How close the machine time comes to what is possible.
//!
//! The bound is computed here on its own: time-optimal path following of second order on the same polygon with the same
//! axis limits and transition speeds, but without a jerk limit, by a backward and a forward pass on a fine grid.

#![expect(clippy::unwrap_used, reason = "helpers of tests; exact values are meant")]

mod common;

use common::{Job, axis, channel, second_order_time};
use kontur_motion::axis::{AxisDynamics, FeedSlope};
use kontur_motion::block::SlopeKind::{self, Hsc, Sin2, Trapez};

type Point = [f64; 3];

/// Machine-like limits: 4 m/s2, kinks weighted 1.
fn machine(ramp_s: f64) -> AxisDynamics {
    let mut a = axis(1.0);
    a.a_max_mm_s2 = 6000.0;
    a.feed = FeedSlope { acc_mm_s2: 4000.0, dec_mm_s2: 4000.0, ramps_s: [ramp_s; 4] };
    a
}

/// Rows over a wavy surface in chords of 0.2 mm, joined by half circles.
fn surface() -> Vec<Point> {
    let z = |x: f64, y: f64| 2.0 * libm::sin(0.3 * x) * libm::cos(0.2 * y);
    let mut out = Vec::new();
    for row in 0..6 {
        let y = f64::from(row) * 4.0;
        for k in 0..=300 {
            let x = f64::from(if row % 2 == 0 { k } else { 300 - k }) * 0.2;
            out.push([x, y, z(x, y)]);
        }
        let (x, side) = if row % 2 == 0 { (60.0, 1.0) } else { (0.0, -1.0) };
        for k in 1..64 {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(k) / 64.0);
            let (px, py) = (x + side * 2.0 * sin, y + 2.0 - 2.0 * cos);
            out.push([px, py, z(px, py)]);
        }
    }
    out
}

/// Archimedean spiral from 2 to 30 mm in chords of 0.3 mm.
fn spiral() -> Vec<Point> {
    let (mut phi, mut out) = (0.0, Vec::new());
    loop {
        let r = 2.0 + phi;
        if r > 30.0 {
            return out;
        }
        let (sin, cos) = libm::sincos(phi);
        out.push([r * cos, r * sin, 0.0]);
        phi += 0.3 / r;
    }
}

/// Rectangular rings with rounded corners of 2 to 6 mm, corners in chords of 0.1 mm, sides in chords of 0.5 mm.
fn pocket() -> Vec<Point> {
    let mut out = Vec::new();
    for ring in 0..5 {
        let r = 2.0 + f64::from(ring);
        let (hx, hy) = (10.0 + 4.0 * f64::from(ring), 6.0 + 4.0 * f64::from(ring));
        let corners = [(hx, hy, 0.0), (-hx, hy, 1.0), (-hx, -hy, 2.0), (hx, -hy, 3.0)];
        for (i, (cx, cy, quarter)) in corners.into_iter().enumerate() {
            let n = libm::ceil(r * std::f64::consts::FRAC_PI_2 / 0.1) as usize;
            let mut last = None;
            for k in 0..=n {
                let phi = std::f64::consts::FRAC_PI_2 * (quarter + k as f64 / n as f64);
                let (sin, cos) = libm::sincos(phi);
                let p = [cx + r * cos, cy + r * sin, 0.0];
                out.push(p);
                last = Some(p);
            }
            let (nx, ny, nq) = corners[(i + 1) % 4];
            let (sin, cos) = libm::sincos(std::f64::consts::FRAC_PI_2 * nq);
            let (p, q) = (last.unwrap(), [nx + r * cos, ny + r * sin, 0.0]);
            let d = libm::hypot(q[0] - p[0], q[1] - p[1]);
            let m = libm::ceil(d / 0.5) as usize;
            if i < 3 {
                for k in 1..m {
                    let u = k as f64 / m as f64;
                    out.push([p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1]), 0.0]);
                }
            }
        }
    }
    out
}

/// Least time in s without a jerk limit.
fn bound(points: &[Point], a: &AxisDynamics, feed: f64, cycle_s: f64) -> f64 {
    const GRID: usize = 40;
    let mut direction = Vec::new();
    for w in points.windows(2) {
        let d: Vec<f64> = (0..3).map(|i| w[1][i] - w[0][i]).collect();
        let l = d.iter().map(|c| c * c).sum::<f64>().sqrt();
        direction.push((d.iter().map(|c| c / l).collect::<Vec<f64>>(), l));
    }
    // squared speed limits at the grid points, acceleration and step between them
    let (mut limit, mut acc, mut step) = (vec![0.0], Vec::new(), Vec::new());
    for (k, (u, l)) in direction.iter().enumerate() {
        let weakest = |limit: f64| {
            u.iter().filter(|c| **c != 0.0).map(|c| limit / c.abs()).fold(f64::INFINITY, f64::min)
        };
        let v = feed.min(weakest(a.v_max_mm_s));
        for g in 0..GRID {
            acc.push(weakest(a.feed.acc_mm_s2));
            step.push(l / GRID as f64);
            limit.push(if g + 1 < GRID { v * v } else { f64::INFINITY });
        }
        let end = limit.len() - 1;
        limit[end] = v * v;
        if let Some((next, _)) = direction.get(k + 1) {
            for (p, q) in u.iter().zip(next) {
                let kink = a.feed.acc_mm_s2 * cycle_s / (q - p).abs();
                limit[end] = limit[end].min(kink * kink);
            }
        } else {
            limit[end] = 0.0;
        }
    }
    // several kinks in one cycle: the speed is below the length between them per cycle, or they count together
    for first in 0..direction.len() - 1 {
        let mut between = 0.0;
        for last in first + 1..direction.len() - 1 {
            between += direction[last].1;
            if between > feed * cycle_s {
                break;
            }
            let turn = |i: usize| (direction[last + 1].0[i] - direction[first].0[i]).abs();
            let largest = (0..3).map(turn).fold(0.0, f64::max);
            let v = (between / cycle_s).max(a.feed.acc_mm_s2 * cycle_s / largest);
            for k in [first, last] {
                let at = (k + 1) * GRID;
                limit[at] = limit[at].min(v * v);
            }
        }
    }
    second_order_time(&mut limit, &acc, &step)
}

fn machine_time(points: &[Point], a: AxisDynamics, kind: SlopeKind, feed: f64) -> f64 {
    let mut job = Job { dynamics: channel(vec![a; 3]), ..Job::new(1.0, kind) };
    job.slope.optimised = kind != Hsc;
    let views: Vec<&[f64]> = points.iter().map(|p| &p[..]).collect();
    let out = job.drive(&views, &[feed]);
    (out.len() - 1) as f64 * 1e-3
}

#[test]
fn machine_time_is_close_to_the_bound() {
    for (name, points, feed) in
        [("surface", surface(), 150.0), ("spiral", spiral(), 250.0), ("pocket", pocket(), 150.0)]
    {
        for (kind, ramp_s, allowed) in [
            (Hsc, 0.02, 0.05),
            (Hsc, 0.001, 0.02),
            (Trapez, 0.02, 0.1),
            (Sin2, 0.02, 0.1),
            (Sin2, 0.001, 0.02),
        ] {
            let a = machine(ramp_s);
            let least = bound(&points, &a, feed, 1e-3);
            let time = machine_time(&points, a, kind, feed);
            println!(
                "{name} {kind:?} ramp {ramp_s}: {time:.3} s, bound {least:.3} s, {:.2} %",
                100.0 * (time / least - 1.0)
            );
            assert!(time <= (1.0 + allowed) * least + 1e-3, "{name} {kind:?} ramp {ramp_s}");
            assert!(time >= least, "the bound is one");
        }
    }
}
