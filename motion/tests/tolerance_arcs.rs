//! `AX_DEV` on contours of lines and arcs, checked by the geometry of each block.

use crate::common::{Job, axis, channel, filtered};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::{Random, count, seed};
use kontur_motion::axis::AxisVec;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Trapez};
use kontur_motion::block::Tolerance;
use kontur_motion::path::{ArcPath, ArcShape, LinePath, Path};

/// The geometry of a block: a line between two points, or an arc with centre, radius, start angle and sweep.
enum Piece {
    Line([f64; 2], [f64; 2]),
    Arc { centre: [f64; 2], radius: f64, from: f64, sweep: f64 },
}

/// Shortest vector from a piece to a point.
fn vector(piece: &Piece, p: &[f64]) -> [f64; 2] {
    match piece {
        Piece::Line(a, b) => {
            let d = [b[0] - a[0], b[1] - a[1]];
            let l2 = d[0] * d[0] + d[1] * d[1];
            let u = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / l2;
            let u = u.clamp(0.0, 1.0);
            [p[0] - a[0] - u * d[0], p[1] - a[1] - u * d[1]]
        }
        Piece::Arc { centre, radius, from, sweep } => {
            let angle = libm::atan2(p[1] - centre[1], p[0] - centre[0]);
            let turn = 2.0 * std::f64::consts::PI;
            let ahead = ((angle - from) * sweep.signum()).rem_euclid(turn);
            let at = |a: f64| {
                [p[0] - centre[0] - radius * libm::cos(a), p[1] - centre[1] - radius * libm::sin(a)]
            };
            let size = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
            let mut best = at(*from);
            for a in [from + sweep, from + sweep.signum() * ahead.min(sweep.abs())] {
                if size(at(a)) < size(best) {
                    best = at(a);
                }
            }
            best
        }
    }
}

/// Lines and arcs, half of the transitions tangential.
fn contour(r: &mut Random, scale: f64) -> (Vec<Piece>, Vec<Path>) {
    let (mut pieces, mut paths) = (Vec::new(), Vec::new());
    let (mut p, mut heading) = ([0.0, 0.0], 0.0);
    for _ in 0..3 + (r.ratio() * 8.0) as usize {
        if r.ratio() < 0.5 {
            heading += r.between(-3.0, 3.0);
        }
        let start = AxisVec::from_slice(&p);
        if r.ratio() < 0.5 {
            let l = scale * r.log(0.1, 3.0);
            let q = [p[0] + l * libm::cos(heading), p[1] + l * libm::sin(heading)];
            paths.push(Path::Line(LinePath::new(start, AxisVec::from_slice(&q), &[]).unwrap()));
            pieces.push(Piece::Line(p, q));
            p = q;
        } else {
            let radius = scale * r.log(0.1, 3.0);
            let sweep = r.between(0.2, 6.2) * if r.ratio() < 0.5 { 1.0 } else { -1.0 };
            let from = heading - f64::signum(sweep) * std::f64::consts::FRAC_PI_2;
            let centre = [p[0] - radius * libm::cos(from), p[1] - radius * libm::sin(from)];
            let to = from + sweep;
            let q = [centre[0] + radius * libm::cos(to), centre[1] + radius * libm::sin(to)];
            let shape = ArcShape { plane: [0, 1], centre_mm: centre, sweep_rad: sweep };
            let end = AxisVec::from_slice(&q);
            paths.push(Path::Arc(ArcPath::new(start, end, shape, &[]).unwrap()));
            pieces.push(Piece::Arc { centre, radius, from, sweep });
            (p, heading) = (q, heading + sweep);
        }
    }
    (pieces, paths)
}

#[test]
fn lines_and_arcs_keep_the_tolerance() {
    let count = count(60);
    let mut r = Random::from_state(seed());
    for case in 0..count {
        let scale = [0.05, 0.5, 5.0, 30.0][(r.ratio() * 4.0) as usize];
        let (pieces, paths) = contour(&mut r, scale);
        let tol = r.log(1e-3, 1e-1);
        let kind = [Trapez, Sin2, Hsc][(r.ratio() * 3.0) as usize];
        let cycle_us = [500, 1000, 2000][(r.ratio() * 3.0) as usize];
        let mode = 1 + (r.ratio() * 4.0) as u8;
        let (freq_hz, damping) = (r.log(5.0, 150.0), r.between(0.0, 0.3));
        let feed = r.between(5.0, 200.0);
        let mut a = axis(1.0);
        a.feed.acc_mm_s2 = r.log(500.0, 8000.0);
        a.feed.dec_mm_s2 = r.log(500.0, 8000.0);
        a.feed.ramps_s = [r.log(0.005, 0.1); 4];
        let mut job = Job { cycle_us, dynamics: channel(vec![a; 2]), ..Job::new(1.0, kind) };
        let cycle = CycleTime::from_us(cycle_us).unwrap();
        let kernel = VibGuardSettings { mode, freq_hz, damping }.kernel(cycle).unwrap();
        job.tolerance = Tolerance { ax_dev_mm: Some(tol), acc_fact: 1.0 };
        job.kernel = Some(kernel.clone());
        let blocks: Vec<_> = paths
            .into_iter()
            .enumerate()
            .map(|(i, path)| job.block(i as u64, path, feed))
            .collect();
        let out = job.run(&[0.0, 0.0], blocks.into_iter());
        let (last, reach) = (out.len() - 1, kernel.length() as usize);
        let block = |k: usize| out[k.clamp(1, last)].seq as usize;
        for (k, p) in filtered(&out, &kernel).iter().enumerate() {
            let shortest = |pieces: &[Piece]| {
                let size = |v: &[f64; 2]| v[0] * v[0] + v[1] * v[1];
                let v =
                    pieces.iter().map(|q| vector(q, p)).min_by(|a, b| size(a).total_cmp(&size(b)));
                v.map_or(0.0, |v| v[0].abs().max(v[1].abs()))
            };
            let reached = &pieces[block(k.saturating_sub(reach))..=block(k)];
            let dev = shortest(&pieces).min(shortest(reached));
            assert!(
                dev <= tol,
                "case {case}: {dev} > {tol}, cycle {k} {kind:?} mode {mode} {freq_hz} Hz z {damping} {cycle_us} us feed {feed}"
            );
        }
    }
}
