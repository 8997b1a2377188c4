use super::*;
use kontur_interpreter::job::AxisFacts;
use kontur_interpreter::record::{AxisRecord, PathRecord};

fn facts() -> Facts {
    let axis = |name: &str| AxisFacts { name: name.to_owned(), ..AxisFacts::default() };
    Facts { cycle_us: 1000, axes: vec![axis("X"), axis("Y")], ..Facts::default() }
}

fn record(k: u64, x: f64, y: f64, v: f64) -> CycleRecord {
    let axis = |p| AxisRecord { ipo: p, set: p, act: p, ..AxisRecord::default() };
    CycleRecord {
        k,
        line: 1,
        path: PathRecord { v_mm_s: v, ..PathRecord::default() },
        axes: vec![axis(x), axis(y)],
        ..CycleRecord::default()
    }
}

fn add(recording: &mut Recording, record: &CycleRecord) {
    recording.add_cycle(record, |axis, quantity| quantity.of(&record.axes[axis]));
}

#[test]
fn long_runs_keep_their_extremes() {
    let mut r = Recording::new(&facts());
    let n = 100_000;
    for k in 0..n {
        let mut record = record(k, k as f64 * 1e-3, 0.0, 10.0);
        if k == 77_777 {
            record.contour_err_mm = 0.5;
            record.axes[1].set = -3.0;
        }
        add(&mut r, &record);
    }
    assert!(r.buckets.len() < MOST_BUCKETS && r.buckets.len() > MOST_BUCKETS / 4);
    // consecutive, up to the last cycle
    assert!(r.buckets.windows(2).all(|w| w[0].last + 1 == w[1].k));
    assert_eq!(r.buckets.last().unwrap().last, n - 1);
    let error = r.curves.iter().position(|c| c.kind == Kind::ContourError).unwrap();
    let most = r.buckets.iter().map(|b| b.range[error].1).fold(0.0, f64::max);
    assert_eq!(most.to_bits(), 0.5_f64.to_bits());
    assert!(r.points().any(|p| p.k == 77_777 && p.set[1] < -2.0));
    assert_eq!(r.worst.map(|p| p.k), Some(77_777));
    assert!(r.points().zip(r.points().skip(1)).all(|(a, b)| a.k < b.k));
}

#[test]
fn passes_end_at_a_stop_where_they_began() {
    let mut r = Recording::new(&facts());
    let mut k = 0;
    for _ in 0..3 {
        for (x, v) in [(0.0, 0.0), (0.5, 5.0), (1.0, 0.0), (0.5, 5.0), (0.0, 0.0)] {
            add(&mut r, &record(k, x, 0.0, v));
            k += 1;
        }
    }
    assert_eq!(r.passes.len(), 3);
    for _ in 0..20 {
        for (x, v) in [(0.5, 5.0), (0.0, 0.0)] {
            add(&mut r, &record(k, x, 0.0, v));
            k += 1;
        }
    }
    assert_eq!(r.passes.len(), 1, "too many to tell apart");
    assert!(r.points().all(|p| p.pass == 0));
}

/// An L with two edges of 1 mm, sampled every 0.3 mm: with a sample missing at the corner, or on the curve that rounds
/// it.
#[test]
fn corners_stay_where_they_are_programmed() {
    for rounded in [false, true] {
        let mut points: Vec<Point> = (0..7)
            .map(|k: u32| {
                let s = f64::from(k) * 0.3;
                let (line, ipo, end) = if s < 1.0 {
                    (1, [s, 0.0, 0.0], [1.0, 0.0, 0.0])
                } else {
                    (2, [1.0, s - 1.0, 0.0], [1.0, 1.0, 0.0])
                };
                let target = Some(end);
                Point { k: u64::from(k), line, ipo, target, ..Point::default() }
            })
            .collect();
        if rounded {
            points[3].ipo = [0.85, 0.1, 0.0];
        }
        let path = programmed(&points, [0, 1]);
        assert_eq!(path.len(), 3);
        let ends = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.8]];
        let apart = |(p, q): (&[f64; 2], &[f64; 2])| libm::hypot(p[0] - q[0], p[1] - q[1]);
        assert!(path.iter().zip(&ends).all(|pair| apart(pair) < 1e-9), "{path:?}");
    }
    // a circle consists of its points
    let arc = vec![Point::default(); 5];
    assert_eq!(programmed(&arc, [0, 1]).len(), 6);
}
