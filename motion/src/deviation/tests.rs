//! The nearest line of a set path, compared with a search over every line; a tolerance that comes late.

use super::*;
use crate::example::block;
use crate::planner::{Next, Planner};
use kontur_filters::time::CycleTime;
use proptest::prelude::*;
use std::collections::VecDeque;

/// The shortest vector from a point to the line between two others.
fn aside(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let way = [0, 1].map(|i| to[i] - from[i]);
    let off = [0, 1].map(|i| point[i] - from[i]);
    let square = way[0] * way[0] + way[1] * way[1];
    let share = if square > 0.0 { (way[0] * off[0] + way[1] * off[1]) / square } else { 0.0 };
    [0, 1].map(|i| share.clamp(0.0, 1.0) * way[i] - off[i])
}

fn length(v: &[f64; 2]) -> f64 {
    libm::hypot(v[0], v[1])
}

proptest! {
    /// The nearest line is found; where every line counts that may be the nearest, all of them are.
    #[test]
    fn no_line_of_the_set_path_is_nearer(
        steps in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 3..40),
        point in prop::array::uniform2(-3.0..3.0f64),
        (ahead, rests) in (0.0..0.5f64, prop::bool::ANY),
        (skip, more) in (0_u64..4, 0_u64..4),
        near in prop::option::of(0_u64..60),
        late in 0_usize..40,
    ) {
        let (mut at, mut points) = ([0.0; 2], vec![[0.0; 2]]);
        for (step, i) in steps.iter().zip(0..) {
            // a path with cycles in which it rests
            let scale = if rests && i % 5 > 2 { 0.0 } else { 0.3 };
            at = [at[0] + scale * (step[0] + ahead), at[1] + scale * step[1]];
            points.push(at);
        }
        let mut set = SetPath::starting(7, 2);
        for (i, point) in points.iter().enumerate() {
            if i < late {
                set.append(point);
            } else {
                set.measure();
                set.push(point);
            }
        }
        set.measure();
        let (first, last) = (7 + skip, 7 + steps.len() as u64 + more);
        let lines: Vec<_> = points.windows(2).map(|p| aside(point, p[0], p[1])).collect();
        let lines = &lines[skip.min(lines.len() as u64) as usize..];
        for wary_mm in [0.0, f64::INFINITY] {
            let mut out = Excursion::none(2);
            let found = set.misses(&point, (first, last), near, wary_mm, &mut out);
            let least = lines.iter().map(length).fold(f64::INFINITY, f64::min);
            let Some((k, vector)) = found else {
                prop_assert!(lines.is_empty());
                continue;
            };
            let nearest = [vector[0], vector[1]];
            prop_assert!((length(&nearest) - least).abs() < 1e-12, "{nearest:?} {least}");
            let of_it = lines[(k - 1 - first) as usize];
            prop_assert!((length(&of_it) - least).abs() < 1e-12, "{k}");
            if wary_mm > 0.0 {
                prop_assert_eq!(&*out.vector, &nearest[..]);
                continue;
            }
            // lines as near as the rule requires, with less and with more than rounding
            let within = |share: f64| {
                let near = lines.iter().filter(move |v| length(v) <= (1.0 + share) * least);
                [0, 1].map(|i| near.clone().fold(0.0, |m: f64, v| m.max(v[i].abs())))
            };
            let (few, many) = (within(ALIKE - 1e-9), within(ALIKE + 1e-9));
            for i in 0..2 {
                let out = out.vector[i].abs();
                prop_assert!(out >= few[i] - 1e-12 && out <= many[i] + 1e-12, "{out} {few:?}");
            }
        }
    }
}

/// A meter that measures only set points until there is a tolerance then finds what one finds that has measured
/// everything from the beginning on, wherever the tolerance comes: also of corners that have been cut before.
#[test]
fn a_late_tolerance_finds_what_was_missed_before() {
    let corners = [[4.0, 0.0], [4.0, 3.0], [1.0, 2.0], [5.0, 2.2], [5.0, 6.0], [0.0, 6.5]];
    let mut cut = 0;
    for tolerated_from in (1..1000).step_by(7) {
        let mut planner = Planner::new(CycleTime::from_us(1000).unwrap(), 10, &[0.0, 0.0]);
        planner.report_changes(true);
        let mut from = [0.0; 2];
        for (to, seq) in corners.into_iter().zip(1..) {
            planner.push(block(seq, from, to, 50.0));
            from = to;
        }
        planner.finish();
        let mut meters = [Meter::default(), Meter::default()];
        meters[0].set_points_only();
        let tell = |meters: &mut [Meter; 2], what: What| {
            for meter in meters {
                meter.take(Change(what.clone()));
            }
        };
        let at = Some((0, AxisVec::zeros(2)));
        tell(&mut meters, What::Kernels { reach_cycles: 20, differ: false, at });
        // set points: the mean of the last cycles
        let mut held = VecDeque::from([[0.0; 2]; 20]);
        let mut vectors = [[0.0; 2]; 2];
        while planner.advance().unwrap() == Next::Setpoint {
            planner.take_changes().for_each(|Change(what)| tell(&mut meters, what));
            let setpoint = planner.setpoint();
            let (k, path) = (setpoint.k, [0, 1].map(|axis| setpoint.position[axis]));
            if k == tolerated_from {
                tell(&mut meters, What::Tolerance(1e-3));
            }
            held.rotate_left(1);
            held[19] = path;
            let set = [0, 1].map(|axis| held.iter().map(|point| point[axis]).sum::<f64>() / 20.0);
            let lengths =
                [0, 1].map(|i| meters[i].filtered(k, &set, &path, &mut vectors[i]).to_bits());
            assert_eq!(lengths[0], lengths[1], "{tolerated_from} {k}");
            assert_eq!(vectors[0][..], vectors[1][..], "{tolerated_from} {k}");
            let [late, always] = [0, 1].map(|i| meters[i].excursion());
            assert_eq!(late, always.filter(|_| k >= tolerated_from), "{tolerated_from} {k}");
            let since = k.checked_sub(tolerated_from);
            let missed = late.is_some_and(|found| found.iter().any(|mm| mm.abs() > 0.01));
            cut += u32::from(missed && since.is_some_and(|since| since < 20));
        }
    }
    assert!(cut > 100, "{cut}");
}
