//! Durations against the reference table made with Ruckig 0.19.4 (community version).

use kontur_motion::profile::{MotionState, ThirdOrderLimits, ThirdOrderProfile};

fn state(p_mm: f64, v_mm_s: f64, a_mm_s2: f64) -> MotionState {
    MotionState { p_mm, v_mm_s, a_mm_s2 }
}

/// Integrates phase by phase, independently of the profile's own evaluation.
fn integrate(from: &MotionState, phases: impl Iterator<Item = (f64, f64)>) -> MotionState {
    let MotionState { p_mm: mut p, v_mm_s: mut v, a_mm_s2: mut a } = *from;
    for (t, j) in phases {
        p += v * t + a * t * t / 2.0 + j * t * t * t / 6.0;
        v += a * t + j * t * t / 2.0;
        a += j * t;
    }
    state(p, v, a)
}

#[test]
fn durations_and_end_states_of_the_reference() {
    let text = include_str!("data/ruckig_reference.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut rows = 0;
    for record in reader.records() {
        let record = record.unwrap();
        let id = &record[0];
        let number = |i: usize| record[i].parse::<f64>().unwrap();
        let start = state(number(1), number(2), number(3));
        let target = state(number(4), number(5), number(6));
        let limits = ThirdOrderLimits {
            v_max_mm_s: number(7),
            v_min_mm_s: number(8),
            a_max_mm_s2: number(9),
            a_min_mm_s2: number(10),
            jerk_mm_s3: number(11),
        };
        let profile = match record[12].parse::<f64>() {
            Ok(duration) => ThirdOrderProfile::with_duration(&start, &target, &limits, duration),
            Err(_) => ThirdOrderProfile::fastest(&start, &target, &limits),
        }
        .unwrap_or_else(|error| panic!("{id}: {error}"));
        // R26 starts in its target; the reference leaves it and comes back after 0.2 s
        let duration = if id == "R26" { 0.0 } else { number(13) };
        assert!((profile.duration() - duration).abs() < 1e-9, "{id}: {profile:?}");
        let brake = number(19) + number(20);
        assert!((profile.brake_duration() - brake).abs() < 1e-9, "{id}: {profile:?}");
        let end = integrate(&start, profile.phases());
        assert!((end.p_mm - target.p_mm).abs() < 1e-10, "{id}: {end:?}");
        assert!((end.v_mm_s - target.v_mm_s).abs() < 1e-9, "{id}: {end:?}");
        assert!((end.a_mm_s2 - target.a_mm_s2).abs() < 1e-7, "{id}: {end:?}");
        if record[12].is_empty() && id != "R26" {
            let (low, high) = profile.velocity_range();
            assert!((high - number(14)).abs() < 1e-8, "{id}: {high}");
            assert!((low - number(15)).abs() < 1e-8, "{id}: {low}");
        }
        rows += 1;
    }
    assert_eq!(rows, 39);
}
