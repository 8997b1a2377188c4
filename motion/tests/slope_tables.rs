//! Worked examples of the slopes: durations, peaks and segments to the printed digits, and sampled positions.
//!
//! The numbers come from an independent calculation whose end states were checked by numerical integration.

use kontur_motion::profile::{Profile, RampShape, RampedLimits, SlopeLimits, StepAxis, StepLimits};

struct Set {
    acc: f64,
    dec: f64,
    ramps_ms: [f64; 4],
}

const P1: Set = Set { acc: 1000.0, dec: 1000.0, ramps_ms: [50.0; 4] };
const P2: Set = Set { acc: 1200.0, dec: 900.0, ramps_ms: [40.0, 60.0, 30.0, 70.0] };
const P3: Set = Set { acc: 2500.0, dec: 2500.0, ramps_ms: [10.0; 4] };

fn limits(set: &Set, shape: RampShape, constant_ramp_time: bool) -> SlopeLimits {
    let ramps = set.ramps_ms.map(|t| t * 1e-3);
    SlopeLimits::Ramped(RampedLimits::new(shape, constant_ramp_time, set.acc, set.dec, ramps))
}

struct Row {
    id: &'static str,
    set: &'static Set,
    length: f64,
    v0: f64,
    ve: f64,
    vf: f64,
    constant_ramp_time: bool,
    peak: f64,
    duration: f64,
    segments_ms: [f64; 7],
}

#[rustfmt::skip]
const fn row(
    id: &'static str, set: &'static Set, [length, v0, ve, vf]: [f64; 4], constant_ramp_time: bool,
    peak: f64, duration: f64, segments_ms: [f64; 7],
) -> Row {
    Row { id, set, length, v0, ve, vf, constant_ramp_time, peak, duration, segments_ms }
}

#[rustfmt::skip]
const TRAPEZ: [Row; 11] = [
    row("T1", &P1, [100.0, 0.0, 0.0, 100.0], false, 100.0, 1.150000000, [50.0, 50.0, 50.0, 850.0, 50.0, 50.0, 50.0]),
    row("T2", &P1, [10.0, 0.0, 0.0, 100.0], false, 78.077640640, 0.256155281, [50.0, 28.077641, 50.0, 0.0, 50.0, 28.077641, 50.0]),
    row("T3", &P1, [1.0, 0.0, 0.0, 66.666667], false, 17.099759467, 0.116960710, [29.240177, 0.0, 29.240177, 0.0, 29.240177, 0.0, 29.240177]),
    row("T3c", &P1, [1.0, 0.0, 0.0, 66.666667], true, 10.0, 0.200000000, [50.0, 0.0, 50.0, 0.0, 50.0, 0.0, 50.0]),
    row("T4", &P2, [50.0, 0.0, 0.0, 150.0], false, 150.0, 0.533833333, [40.0, 75.0, 60.0, 142.166667, 30.0, 116.666667, 70.0]),
    row("T5", &P2, [8.0, 20.0, 10.0, 100.0], false, 67.378999250, 0.202616696, [35.544901, 0.0, 53.317351, 0.0, 30.0, 13.754444, 70.0]),
    row("T6", &P2, [2.5, 30.0, 5.0, 100.0], false, 35.518954147, 0.112681466, [12.131451, 0.0, 18.197177, 0.0, 24.705851, 0.0, 57.646986]),
    row("T7", &P2, [1.0, 0.0, 0.0, 66.666667], false, 17.774050386, 0.117274745, [21.770959, 0.0, 32.656439, 0.0, 18.854204, 0.0, 43.993143]),
    row("T7c", &P2, [1.0, 0.0, 0.0, 66.666667], true, 10.344827586, 0.200000000, [40.0, 0.0, 60.0, 0.0, 30.0, 0.0, 70.0]),
    row("T8", &P3, [100.0, 0.0, 0.0, 100.0], false, 100.0, 1.050000000, [10.0, 30.0, 10.0, 950.0, 10.0, 30.0, 10.0]),
    row("T9", &P1, [0.05, 0.0, 0.0, 100.0], false, 2.320794417, 0.043088694, [10.772173, 0.0, 10.772173, 0.0, 10.772173, 0.0, 10.772173]),
];

#[rustfmt::skip]
const SIN2: [Row; 8] = [
    row("N1", &P1, [100.0, 0.0, 0.0, 100.0], false, 100.0, 1.150000000, [50.0, 50.0, 50.0, 850.0, 50.0, 50.0, 50.0]),
    row("N2", &P1, [10.0, 0.0, 0.0, 100.0], false, 78.077640640, 0.256155281, [50.0, 28.077641, 50.0, 0.0, 50.0, 28.077641, 50.0]),
    row("N3", &P1, [1.0, 0.0, 0.0, 66.666667], false, 17.099759467, 0.116960710, [29.240177, 0.0, 29.240177, 0.0, 29.240177, 0.0, 29.240177]),
    row("N4", &P2, [50.0, 0.0, 0.0, 150.0], false, 150.0, 0.533977236, [40.0, 75.0, 60.0, 142.310569, 30.0, 116.666667, 70.0]),
    row("N5", &P2, [8.0, 20.0, 10.0, 100.0], false, 67.569583465, 0.203007003, [35.616320, 0.0, 53.424479, 0.0, 30.0, 13.966204, 70.0]),
    row("N6", &P2, [2.5, 30.0, 5.0, 100.0], false, 35.730781313, 0.113543323, [12.362072, 0.0, 18.543109, 0.0, 24.791443, 0.0, 57.846699]),
    row("N7", &P2, [1.0, 0.0, 0.0, 66.666667], false, 17.882874185, 0.117633212, [21.837505, 0.0, 32.756258, 0.0, 18.911834, 0.0, 44.127614]),
    row("N7c", &P2, [1.0, 0.0, 0.0, 66.666667], true, 10.422404129, 0.200000000, [40.0, 0.0, 60.0, 0.0, 30.0, 0.0, 70.0]),
];

fn check(row: &Row, profile: &Profile) {
    let id = row.id;
    assert!((profile.peak() - row.peak).abs() <= 5.1e-10, "{id}: peak {}", profile.peak());
    assert!((profile.duration() - row.duration).abs() <= 5.1e-10, "{id}: {}", profile.duration());
    let segments: Vec<f64> = profile.phases().map(|p| p.0).collect();
    assert_eq!(segments.len(), 7, "{id}");
    for (got, want) in segments.iter().zip(row.segments_ms) {
        assert!((got * 1e3 - want).abs() <= 5.1e-7, "{id}: {segments:?}");
    }
    let end = profile.at(profile.duration());
    assert!((end.s_mm - row.length).abs() <= 1e-12 * row.length, "{id}: end {end:?}");
    assert!((end.v_mm_s - row.ve).abs() <= 1e-12 * row.peak, "{id}: end {end:?}");
    assert!(end.a_mm_s2.abs() <= 1e-9, "{id}: end {end:?}");
}

#[test]
fn trapez_examples() {
    for row in &TRAPEZ {
        let limits = limits(row.set, RampShape::Trapez, row.constant_ramp_time);
        check(row, &limits.plan(row.v0, row.ve, row.vf, row.length).unwrap());
    }
}

#[test]
fn sin2_examples() {
    for row in &SIN2 {
        let limits = limits(row.set, RampShape::Sin2, row.constant_ramp_time);
        check(row, &limits.plan(row.v0, row.ve, row.vf, row.length).unwrap());
    }
}

#[test]
fn leg_distances() {
    let t = limits(&P2, RampShape::Trapez, false);
    assert!((t.up_distance(0.0, 150.0) - 13.775).abs() < 1e-12);
    assert!((t.down_distance(150.0, 0.0) - 14.9).abs() < 1e-12);
    for (v0, ve, peak, up, down) in [
        (20.0, 10.0, 67.378999250, 4.022687489, 3.977312511),
        (30.0, 5.0, 35.518954147, 0.999129412, 1.500870588),
    ] {
        assert!((t.up_distance(v0, peak) - up).abs() < 1e-9);
        assert!((t.down_distance(peak, ve) - down).abs() < 1e-9);
        assert!((t.reach_up(v0, up) - peak).abs() < 1e-7);
        assert!((t.reach_down(ve, down) - peak).abs() < 1e-7);
    }
}

#[test]
fn peak_acceleration_of_constant_ramp_time() {
    let profile = limits(&P1, RampShape::Trapez, true).plan(0.0, 0.0, 66.666667, 1.0).unwrap();
    assert!((profile.at(0.05).a_mm_s2 - 200.0).abs() < 1e-9);
}

#[rustfmt::skip]
const SAMPLED: [[f64; 7]; 11] = [
    [10.0, 0.003333333, 1.000000000, 200.000000, 0.001353384, 0.530968101, 153.144993],
    [20.0, 0.026666667, 4.000000000, 400.000000, 0.019310370, 3.568648552, 452.161048],
    [30.0, 0.089997076, 8.988453392, 569.607095, 0.081004566, 8.993980001, 583.829740],
    [40.0, 0.205028631, 13.684524345, 369.607095, 0.198383982, 14.186843804, 410.228508],
    [50.0, 0.357020896, 16.380595297, 169.607095, 0.355695526, 16.770630482, 113.204124],
    [60.0, 0.525973870, 17.076666250, -30.392905, 0.525984819, 17.097787878, -3.888742],
    [70.0, 0.691887554, 15.772737203, -230.392905, 0.694629572, 16.303300422, -196.789900],
    [80.0, 0.834761948, 12.468808156, -430.392905, 0.842710255, 12.814749470, -489.844210],
    [90.0, 0.934676011, 7.268798583, -539.214191, 0.943634245, 7.223481878, -576.078157],
    [100.0, 0.983736621, 2.876656677, -339.214191, 0.989576416, 2.323433905, -365.161940],
    [110.0, 0.998875811, 0.484514771, -139.214191, 0.999675936, 0.184491321, -78.029666],
];

#[test]
fn sampled_positions_of_a_millimetre() {
    for (shape, column) in [(RampShape::Trapez, 1), (RampShape::Sin2, 4)] {
        let profile = limits(&P1, shape, false).plan(0.0, 0.0, 66.666667, 1.0).unwrap();
        for row in SAMPLED {
            let t = row[0] * 1e-3;
            let state = profile.at(t);
            assert!((state.s_mm - row[column]).abs() < 1e-8, "{shape:?} {t} {state:?}");
            assert!((state.v_mm_s - row[column + 1]).abs() < 1e-8, "{shape:?} {t} {state:?}");
            assert!((state.a_mm_s2 - row[column + 2]).abs() < 6e-7, "{shape:?} {t} {state:?}");
            assert!((profile.time_at(state.s_mm) - t).abs() < 1e-12, "{shape:?} {t}");
        }
        let end = profile.at(0.12);
        assert!((end.s_mm - 1.0).abs() < 1e-15 && end.v_mm_s.abs() < 1e-12);
    }
}

fn step(acc: [f64; 2], dec: [f64; 2], change: f64) -> SlopeLimits {
    SlopeLimits::Step(StepLimits::from_axes(&[StepAxis {
        acc_mm_s2: acc,
        dec_mm_s2: dec,
        change_mm_s: change,
    }]))
}

#[test]
fn step_examples() {
    let one = step([1000.0; 2], [1000.0; 2], 100.0);
    let two = step([2000.0, 800.0], [1500.0, 600.0], 100.0);
    #[rustfmt::skip]
    let rows = [
        ("S1", &one, [100.0, 0.0, 0.0, 100.0], 100.0, 1.1, [100.0, 0.0, 900.0, 0.0, 100.0]),
        ("S2", &one, [1.0, 0.0, 0.0, 66.666667], 31.622776602, 0.063245553, [31.622777, 0.0, 0.0, 0.0, 31.622777]),
        ("S3", &two, [100.0, 0.0, 0.0, 200.0], 200.0, 0.660416667, [50.0, 125.0, 252.083333, 166.666667, 66.666667]),
        ("S4", &two, [12.0, 0.0, 0.0, 200.0], 119.283575687, 0.172910429, [50.0, 24.104470, 0.0, 32.139293, 66.666667]),
        ("S5", &two, [8.0, 120.0, 40.0, 200.0], 124.303775371, 0.085886011, [0.0, 5.379719, 0.0, 40.506292, 40.0]),
    ];
    for (id, limits, [length, v0, ve, vf], peak, duration, segments_ms) in rows {
        let profile = limits.plan(v0, ve, vf, length).unwrap();
        assert!((profile.peak() - peak).abs() < 5.1e-10, "{id}: {}", profile.peak());
        assert!((profile.duration() - duration).abs() < 5.1e-10, "{id}: {}", profile.duration());
        let segments: Vec<f64> = profile.phases().map(|p| p.0).collect();
        assert_eq!(segments.len(), 5);
        for (got, want) in segments.iter().zip(segments_ms) {
            assert!((got * 1e3 - want).abs() < 5.1e-7, "{id}: {segments:?}");
        }
        let end = profile.at(profile.duration());
        assert!((end.s_mm - length).abs() < 1e-12 && (end.v_mm_s - ve).abs() < 1e-12, "{id}");
    }
    let refused = two.plan(120.0, 40.0, 200.0, 6.0).unwrap_err();
    assert!((refused.needed_mm - 6.466666667).abs() < 5.1e-10);
}

#[test]
fn the_weakest_axis_rules_at_every_velocity() {
    let axis =
        |a1, a2, change| StepAxis { acc_mm_s2: [a1, a2], dec_mm_s2: [a1, a2], change_mm_s: change };
    let limits = SlopeLimits::Step(StepLimits::from_axes(&[
        axis(2000.0, 500.0, 80.0),
        axis(1000.0, 900.0, 40.0),
    ]));
    // 1000 up to 40, 900 up to 80, 500 above
    let time = 40.0 / 1000.0 + 40.0 / 900.0 + 20.0 / 500.0;
    assert!((limits.up_time(0.0, 100.0) - time).abs() < 1e-15);
    let s = 1600.0 / 2000.0 + 4800.0 / 1800.0 + 3600.0 / 1000.0;
    assert!((limits.down_distance(100.0, 0.0) - s).abs() < 1e-14);
    assert!((limits.reach_up(0.0, s) - 100.0).abs() < 1e-12);
}
