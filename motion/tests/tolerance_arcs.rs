//! `AX_DEV` beside and on arcs: what one place requires does not slow down the whole arc.

use crate::common::{self, Job, line};
use crate::tolerance::machine;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Trapez};

/// A blend of a line into an arc with a kink of a sixth of a degree, and two arcs at a corner: a larger tolerance never takes
/// longer, neighbouring ones take nearly the same time, and an arc takes no longer than in five parts.
#[test]
fn arcs_take_no_longer_with_a_larger_tolerance_or_in_one_block() {
    // the centre lies on the bisector, `off` to the left of the chord
    let arc = |from: [f64; 2], to: [f64; 2], off: f64, sense: f64| {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let chord = libm::hypot(dx, dy);
        let centre_mm = [
            0.5 * (from[0] + to[0]) - off * dy / chord,
            0.5 * (from[1] + to[1]) + off * dx / chord,
        ];
        let half = libm::atan2(0.5 * chord, sense * off);
        common::arc(&from, &to, centre_mm, 2.0 * sense * half)
    };
    let blend = [line(&[0.0, 0.0], &[-4.0, -0.7]), arc([-4.0, -0.7], [-5.65, -6.0], 1.424, 1.0)];
    let corner = [
        arc([0.0, 0.0], [-4.2, -2.38], 0.63, -1.0),
        arc([-4.2, -2.38], [-4.18, -1.5], -1.69, -1.0),
    ];
    for paths in [&blend, &corner] {
        for kind in [Hsc, Trapez, Sin2] {
            let mut last: Option<usize> = None;
            for step in 0..11 {
                let ax_dev_mm = 0.02 + 0.001 * f64::from(step);
                let mut job = machine(2, 0.03).guarded(2, 8.0, 0.1, Some(ax_dev_mm));
                job.slope.kind = kind;
                let blocks =
                    paths.iter().zip(0..).map(|(path, i)| job.block(i, path.clone(), 33.0));
                let cycles = job.run(paths[0].start(), blocks).len();
                let (least, most) =
                    last.map_or((0, usize::MAX), |last| (last - last / 25, last + 2));
                assert!(
                    (least..=most).contains(&cycles),
                    "{kind:?} {ax_dev_mm}: {cycles} cycles after {last:?}"
                );
                last = Some(cycles);
                let pieces = paths.iter().flat_map(|path| {
                    let at = |k: i32| path.length() * f64::from(k) / 5.0;
                    (0..5).filter_map(move |k| path.section(at(k), at(k + 1)))
                });
                let blocks = pieces.zip(0..).map(|(path, i)| job.block(i, path, 33.0));
                let divided = job.run(paths[0].start(), blocks).len();
                let most = divided + divided / 100;
                assert!(cycles <= most, "{kind:?} {ax_dev_mm}: {cycles} cycles, divided {divided}");
            }
        }
    }
}

/// Behind a corner with a tolerance follows a circle without one: it is slow only beside the corner.
#[test]
fn an_arc_without_tolerance_is_slow_only_beside_the_corner() {
    const FEED_MM_S: f64 = 60.0;
    let job = machine(2, 0.02).guarded(2, 20.0, 0.1, Some(0.01));
    let line = line(&[0.0, 0.0], &[10.0, 0.0]);
    // to the left, from 45 degrees on
    let off = 4.0 * 0.5_f64.sqrt();
    let centre_mm = [10.0 - off, off];
    let circle = common::arc(&[10.0, 0.0], &[10.0, 0.0], centre_mm, std::f64::consts::TAU);
    let mut last = job.block(1, circle, FEED_MM_S);
    last.tolerance.ax_dev_mm = None;
    let blocks = [job.block(0, line, FEED_MM_S), last];
    let out = job.run(&[0.0; 2], blocks.into_iter());
    let circle: Vec<_> = out.iter().filter(|p| p.seq == 1).collect();
    let fast = circle.iter().filter(|p| p.v_mm_s > 0.99 * FEED_MM_S).count();
    assert!(2 * fast > circle.len(), "{fast} of {} cycles at the feed rate", circle.len());
}

/// With constant ramp times, where every change of speed takes its ramps, a circle takes no longer than with its highest speed as feed
/// rate and without a tolerance.
#[test]
fn a_circle_with_constant_ramp_times_has_one_speed() {
    let circle = common::arc(&[0.0; 2], &[0.0; 2], [2.0, 0.0], -std::f64::consts::TAU);
    for kind in [Trapez, Sin2] {
        let mut job = machine(2, 0.02).guarded(2, 60.0, 0.1, Some(0.02));
        (job.slope.kind, job.slope.constant_ramp_time) = (kind, true);
        let run = |job: &Job, feed: f64| {
            job.run(&[0.0; 2], std::iter::once(job.block(0, circle.clone(), feed)))
        };
        let slow = run(&job, 130.0);
        let top = slow.iter().map(|p| p.v_mm_s).fold(0.0, f64::max);
        assert!(top < 75.0, "{kind:?}: the tolerance limits the speed: {top}");
        job.tolerance.ax_dev_mm = None;
        let free = run(&job, top).len();
        assert!(slow.len() <= free + 2, "{kind:?}: {} of {free} cycles", slow.len());
    }
}
