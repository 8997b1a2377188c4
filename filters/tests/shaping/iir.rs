//! Standard filters against reference responses, biquads and closed forms.

use super::reference::{Row, assert_close, rows};
use kontur_filters::iir::prototype::Prototype;
use kontur_filters::iir::{AxisFilter, FilterConfig, FilterKind};
use kontur_filters::issue::FilterIssue;
use kontur_filters::response::{Angle, Response, step_response};
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use kontur_kit::Random;
use std::collections::BTreeMap;
use std::f64::consts::PI;

const MS: CycleTime = CycleTime::DEFAULT;

fn config(row: &Row) -> FilterConfig {
    let kind = match row.text("type") {
        "LOWPASS" => FilterKind::LowPass,
        "HIGHPASS" => FilterKind::HighPass,
        "BANDPASS" => FilterKind::BandPass,
        "BANDSTOP" => FilterKind::BandStop,
        "ALLPASS" => FilterKind::AllPass,
        "PT1" => FilterKind::Pt1,
        "PT2" => FilterKind::Pt2,
        "TIME_DELAY" => FilterKind::TimeDelay,
        other => panic!("{other}"),
    };
    let prototype = match row.text("prototype") {
        "BUTTERWORTH" => Prototype::Butterworth,
        "BESSEL" => Prototype::Bessel,
        "CRIT_DAMPING" | "" => Prototype::CritDamping,
        other => panic!("{other}"),
    };
    let default = FilterConfig::default();
    let f_hz = row.optional("fg_f0_hz").unwrap_or(default.f_hz);
    // the reference states the quality of the analog filter; this is the listed one that leads to it
    let centre = PI * f_hz * 0.001;
    let listed = |q: f64| centre / libm::atan(libm::sin(2.0 * centre) / (2.0 * q));
    FilterConfig {
        kind,
        prototype,
        order: row.text("order").parse().unwrap(),
        f_hz,
        q: row.optional("guete").map_or(default.q, listed),
        time_constant_us: row.text("time_constant_us").parse().unwrap_or(default.time_constant_us),
        ..default
    }
}

fn design(config: &FilterConfig) -> AxisFilter {
    AxisFilter::design(config, MS).0.unwrap()
}

fn low_pass(prototype: Prototype, order: u32, f_hz: f64) -> AxisFilter {
    design(&FilterConfig { prototype, order, f_hz, ..FilterConfig::default() })
}

fn at(f_hz: f64) -> Angle {
    Angle::of(f_hz, MS)
}

fn lag(kind: FilterKind, time_constant_us: u32) -> AxisFilter {
    design(&FilterConfig { kind, order: 2, time_constant_us, ..FilterConfig::default() })
}

/// Conformance: A016, A017, A018, A019, A024.
#[test]
fn magnitude_phase_and_delay_of_the_reference() {
    for row in rows("axis_filters_reference") {
        let filter = design(&config(&row));
        for i in 1..=5 {
            let column =
                |name: &str| format!("{name}{i}_{}", if name == "mag" { "db" } else { "deg" });
            // The frequencies of lags are printed rounded: 0.1, 0.5, 1, 2, 10 times 1/(2 pi tau).
            let f_hz =
                row.optional("time_constant_us").filter(|_| row.text("type") != "TIME_DELAY");
            let f_hz = f_hz.map_or_else(
                || row.number(&format!("f{i}_hz")),
                |us| [0.1, 0.5, 1.0, 2.0, 10.0][i - 1] * 1e6 / (2.0 * PI * us),
            );
            let response = filter.response(at(f_hz));
            // The reference prints zeros as -200 dB.
            let magnitude_db = response.magnitude_db().max(-200.0);
            assert_close(magnitude_db, row.number(&column("mag")), 6e-7, &row);
            if let Some(want) = row.optional(&column("phase")) {
                let turn = (response.phase_deg() - want + 180.0).rem_euclid(360.0) - 180.0;
                assert_close(turn, 0.0, 6e-7, &row);
            }
        }
        let want_ms = row.number("dc_group_delay_ms");
        if want_ms.is_finite() && !config(&row).kind.removes_constant_part() {
            // The reference is a difference quotient near 0 Hz; its last digits are those of the quotient.
            assert_close(filter.delay_cycles(), want_ms, 1e-5 * want_ms, &row);
        }
    }
}

/// Overshoot, settling and steepest slope of every prototype and order.
/// Conformance: A025, A026, A028, A030, A061, A117, A118, A119.
#[test]
fn step_responses_of_the_reference() {
    for row in rows("axis_filters_reference") {
        let config = config(&row);
        let y = step_response(&mut design(&config), 4000);
        for n in [0, 1, 2, 5, 10, 20, 50, 100, 200] {
            assert_close(y[n], row.number(&format!("y{n}")), 1e-11, &row);
        }
        let last = if config.kind.removes_constant_part() { 0.0 } else { 1.0 };
        let highest = y.iter().copied().fold(0.0, f64::max);
        let lowest = y.iter().copied().fold(0.0, f64::min);
        let (over, under) = if last > 0.0 { (highest - 1.0, -lowest) } else { (-lowest, highest) };
        assert_close(100.0 * over.max(0.0), row.number("step_overshoot_pct"), 6e-7, &row);
        if config.kind != FilterKind::BandStop {
            assert_close(100.0 * under, row.number("step_undershoot_pct"), 6e-7, &row);
        }
        for (band, column) in [(0.02, "settle_2pct_cycles"), (0.001, "settle_0p1pct_cycles")] {
            let settled = y.iter().rposition(|y| (y - last).abs() > band).map_or(0, |n| n + 1);
            assert_close(settled as f64, row.number(column), 0.0, &row);
        }
        if config.kind != FilterKind::TimeDelay && last > 0.0 {
            let fg = row
                .optional("fg_f0_hz")
                .unwrap_or(1e6 / (2.0 * PI * f64::from(config.time_constant_us)));
            let steepest = std::iter::once(0.0)
                .chain(y.iter().copied())
                .collect::<Vec<_>>()
                .windows(2)
                .map(|pair| pair[1] - pair[0])
                .fold(0.0, f64::max);
            let slope = steepest / (2.0 * PI * fg * 0.001);
            assert_close(slope, row.number("max_step_slope_over_2pi_fg"), 6e-7, &row);
        }
    }
}

/// A biquad, or the all-pass of a time delay, as numerator and denominator in ascending powers of `1/z`.
#[derive(Clone, Debug)]
struct Rational {
    b: Vec<f64>,
    a: Vec<f64>,
}

impl Rational {
    fn of(row: &Row) -> Self {
        let list = |text: &str| text.split_whitespace().map(|c| c.parse().unwrap()).collect();
        if row.text("type") == "TIME_DELAY" {
            return Self { b: list(row.text("b0")), a: list(row.text("a1")) };
        }
        let b = ["b0", "b1", "b2"].map(|c| row.number(c)).to_vec();
        Self { b, a: vec![1.0, row.number("a1"), row.number("a2")] }
    }

    fn response(&self, at: Angle) -> Response {
        let polynomial = |c: &[f64]| {
            c.iter().zip(0..).fold(Response::constant(0.0), |sum, (c, k)| {
                sum + Response::constant(*c) * Response::delay(f64::from(k), at)
            })
        };
        polynomial(&self.b) / polynomial(&self.a)
    }

    /// Output for an input that was zero before.
    fn filter(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; x.len()];
        for n in 0..x.len() {
            let past = |c: &[f64], s: &[f64]| -> f64 {
                c.iter().enumerate().filter(|&(k, _)| k <= n).map(|(k, c)| c * s[n - k]).sum()
            };
            let recursion = past(&self.a, &y);
            y[n] = past(&self.b, x) - recursion;
        }
        y
    }
}

fn biquads() -> Vec<(FilterConfig, Vec<Rational>)> {
    let mut filters: BTreeMap<String, (FilterConfig, Vec<Rational>)> = BTreeMap::new();
    for row in rows("axis_filters_sections") {
        let key = ["type", "prototype", "order", "fg_f0_hz", "guete", "time_constant_us"]
            .map(|column| row.text(column))
            .join(" ");
        let entry = filters.entry(key).or_insert_with(|| (config(&row), Vec::new()));
        entry.1.push(Rational::of(&row));
    }
    filters.into_values().collect()
}

#[test]
fn cascades_have_the_frequency_response_of_the_biquads() {
    for (config, sections) in biquads() {
        let filter = design(&config);
        for f_hz in [0.3, 1.0, 5.0, 14.9, 15.0, 20.0, 30.0, 77.0, 150.0, 333.3, 499.0] {
            let want = sections
                .iter()
                .fold(Response::ONE, |chain, section| chain * section.response(at(f_hz)));
            let error = filter.response(at(f_hz)).gain - want.gain;
            assert_close(libm::hypot(error.re, error.im), 0.0, 1e-10, &(config, f_hz));
        }
    }
}

#[test]
fn cascades_run_like_the_biquads() {
    // A fixed broad-band signal.
    let mut random = Random::new(1);
    let signal: Vec<f64> = (0..2000).map(|_| random.between(-0.5, 0.5)).collect();
    for (config, sections) in biquads() {
        let mut filter = design(&config);
        let want = sections.iter().fold(signal.clone(), |x, section| section.filter(&x));
        for (n, (x, want)) in signal.iter().zip(want).enumerate() {
            assert_close(filter.step(*x), want, 1e-10, &(config, n));
        }
    }
}

#[test]
fn minus_three_decibels_at_the_corner() {
    for prototype in [Prototype::CritDamping, Prototype::Butterworth, Prototype::Bessel] {
        for order in 1..=6 {
            for f_hz in [0.01, 1.0, 15.0, 30.0, 100.0, 499.9] {
                for kind in [FilterKind::LowPass, FilterKind::HighPass] {
                    let config =
                        FilterConfig { kind, prototype, order, f_hz, ..FilterConfig::default() };
                    let magnitude = design(&config).response(at(f_hz)).magnitude();
                    assert_close(magnitude * magnitude, 0.5, 1e-9, &config);
                }
            }
        }
    }
}

/// Conformance: A022.
#[test]
fn a_second_order_lag_is_two_first_order_lags() {
    let (pt1, pt2) = (lag(FilterKind::Pt1, 5000), lag(FilterKind::Pt2, 5000));
    let (mut one, mut two, mut both) = (pt1.clone(), pt1, pt2);
    for n in 0..300 {
        let x = f64::from(n % 7);
        assert_eq!(both.step(x).to_bits(), two.step(one.step(x)).to_bits());
    }
}

/// Conformance: A058, A061.
#[test]
fn lags_are_low_passes_of_their_time_constant() {
    let f_hz = 1e6 / (2.0 * PI * 5000.0);
    // PT2: critical damping of order 2 at sqrt(sqrt(2) - 1) of that frequency; equal up to the prewarping frequency.
    for prototype in [Prototype::CritDamping, Prototype::Butterworth, Prototype::Bessel] {
        let first = low_pass(prototype, 1, f_hz);
        for f in [1.0, 10.0, 31.8, 100.0, 400.0] {
            let error =
                lag(FilterKind::Pt1, 5000).response(at(f)).gain - first.response(at(f)).gain;
            assert_close(libm::hypot(error.re, error.im), 0.0, 1e-12, &f);
        }
    }
    let fine = CycleTime::from_us(100).unwrap();
    let config = FilterConfig { order: 2, time_constant_us: 50_000, ..FilterConfig::default() };
    let slow_hz = 1e6 / (2.0 * PI * 50_000.0);
    let corner = slow_hz * (2.0_f64.sqrt() - 1.0).sqrt();
    let pt2 =
        AxisFilter::design(&FilterConfig { kind: FilterKind::Pt2, ..config }, fine).0.unwrap();
    let low = AxisFilter::design(&FilterConfig { f_hz: corner, ..config }, fine).0.unwrap();
    for f in [0.5, 1.0, 2.05, 5.0, 20.0] {
        let error = pt2.response(Angle::of(f, fine)).gain - low.response(Angle::of(f, fine)).gain;
        assert_close(libm::hypot(error.re, error.im), 0.0, 1e-6, &f);
    }
}

#[test]
fn the_band_stop_has_its_zero_at_the_centre_and_unit_gain_far_away() {
    for prototype in [Prototype::CritDamping, Prototype::Butterworth, Prototype::Bessel] {
        for order in 1..=3 {
            for (f_hz, q) in [(20.0, 4.0), (20.0, 1.0), (5.0, 10.0), (180.0, 2.0)] {
                let kind = FilterKind::BandStop;
                let config =
                    FilterConfig { kind, prototype, order, f_hz, q, ..FilterConfig::default() };
                let stop = design(&config);
                assert!(stop.response(at(f_hz)).magnitude_db() < -250.0, "{config:?}");
                assert_close(stop.response(at(0.0)).magnitude(), 1.0, 1e-14, &config);
                assert_close(stop.response(at(500.0)).magnitude(), 1.0, 1e-12, &config);
                let pass = design(&FilterConfig { kind: FilterKind::BandPass, ..config });
                assert_close(pass.response(at(f_hz)).magnitude(), 1.0, 1e-12, &config);
            }
        }
    }
}

/// The sum of a over 2 tan(pi fg T): critical damping of order 4 at 15 Hz 18.447 ms, the analog filter 18.461 ms.
#[test]
fn delay_of_slow_signals() {
    for prototype in [Prototype::CritDamping, Prototype::Butterworth, Prototype::Bessel] {
        for order in 1..=6 {
            let sum: f64 = prototype.terms(order).iter().map(|term| term.a).sum();
            let want = sum / (2.0 * libm::tan(PI * 15.0 * 0.001));
            let is = low_pass(prototype, order, 15.0).delay_cycles();
            assert_close(is, want, 1e-12 * want, &(prototype, order));
        }
    }
    let printed = low_pass(Prototype::CritDamping, 4, 15.0).delay_cycles();
    assert_close(printed, 18.447, 5e-4, &"CRIT_DAMPING 4, 15 Hz");
}

#[test]
fn group_delay_is_the_slope_of_the_phase() {
    for (config, _) in biquads() {
        let filter = design(&config);
        for f_hz in [3.0, 27.0, 210.0] {
            let h = 1e-3;
            let phase = |f: f64| filter.response(at(f)).phase_deg();
            let turn = (phase(f_hz + h) - phase(f_hz - h) + 180.0).rem_euclid(360.0) - 180.0;
            let slope_cycles = -turn / 360.0 / (2.0 * h) * 1000.0;
            let delay = filter.response(at(f_hz)).group_delay_cycles();
            assert_close(delay, slope_cycles, 1e-4, &(config, f_hz));
        }
    }
}

/// Conformance: A023, A065, A067.
#[test]
fn a_whole_time_delay_shifts_bit_for_bit() {
    for cycles in 0..6_u32 {
        let config = FilterConfig {
            kind: FilterKind::TimeDelay,
            order: 1,
            time_constant_us: cycles * 1000,
            ..FilterConfig::default()
        };
        let mut filter = design(&config);
        let x: Vec<f64> = (1..50).map(|i| 1000.0 / f64::from(i)).collect();
        filter.settle(x[0]);
        let y: Vec<f64> = x.iter().map(|&x| filter.step(x)).collect();
        let shift = cycles as usize;
        assert_eq!(y[shift..], x[..x.len() - shift]);
        assert!(y[..shift].iter().all(|y| y.to_bits() == x[0].to_bits()));
    }
}

/// Conformance: A062.
#[test]
fn a_time_delay_passes_every_amplitude() {
    for time_constant_us in [1, 300, 400, 499, 500, 501, 1500, 2300, 3700, 5499, 5500, 5999] {
        let filter = lag(FilterKind::TimeDelay, time_constant_us);
        for f_hz in [0.0, 10.0, 100.0, 333.0, 500.0] {
            assert_close(filter.response(at(f_hz)).magnitude(), 1.0, 1e-12, &time_constant_us);
        }
        let cycles = f64::from(time_constant_us) / 1000.0;
        assert_close(filter.delay_cycles(), cycles, 1e-12, &time_constant_us);
    }
}

fn issues(config: FilterConfig) -> (bool, Vec<FilterIssue>) {
    let (filter, issues) = AxisFilter::design(&config, MS);
    (filter.is_some(), issues)
}

/// Conformance: A053, A063, A091, A092, A094, A101.
#[test]
fn ranges() {
    let on = FilterConfig { order: 1, ..FilterConfig::default() };
    let of = |kind| FilterConfig { kind, ..on };
    assert_eq!(issues(FilterConfig::default()), (false, vec![]));
    assert_eq!(issues(on), (true, vec![]));
    assert_eq!(
        issues(FilterConfig { order: 7, ..on }),
        (true, vec![FilterIssue::OrderTooHigh { order: 7, used: 6 }])
    );
    assert_eq!(
        issues(FilterConfig { order: 4, ..of(FilterKind::BandStop) }),
        (true, vec![FilterIssue::OrderTooHigh { order: 4, used: 3 }])
    );
    assert_eq!(
        issues(of(FilterKind::Pt2)),
        (true, vec![FilterIssue::OrderCorrected { order: 1, used: 2 }])
    );
    for f_hz in [500.0, 1e9, f64::NAN, f64::INFINITY] {
        let (runs, issues) = issues(FilterConfig { f_hz, ..on });
        assert!(!runs && matches!(issues[..], [FilterIssue::Frequency { .. }]), "{f_hz}");
    }
    for f_hz in [499.9, 0.01] {
        assert_eq!(issues(FilterConfig { f_hz, ..on }), (true, vec![]), "{f_hz}");
    }
    for f_hz in [f64::NEG_INFINITY, -1.0, 0.0, 0.0099] {
        assert_eq!(
            issues(FilterConfig { f_hz, ..on }),
            (true, vec![FilterIssue::FrequencyTooLow { f_hz, used_hz: 0.01 }])
        );
    }
    for (q, runs) in [(0.9, false), (1.0, true), (10.0, true), (10.1, false), (f64::NAN, false)] {
        assert_eq!(issues(FilterConfig { q, ..of(FilterKind::BandStop) }).0, runs, "{q}");
    }
    for (share_ratio, runs) in [(-0.01, false), (0.0, true), (1.0, true), (1.01, false)] {
        assert_eq!(issues(FilterConfig { share_ratio, ..on }).0, runs, "{share_ratio}");
    }
    // PT1, PT2 from one cycle on; a time delay below six.
    for (kind, time_constant_us, runs) in [
        (FilterKind::Pt1, 999, false),
        (FilterKind::Pt1, 1000, true),
        (FilterKind::Pt1, u32::MAX, true),
        (FilterKind::Pt2, 999, false),
        (FilterKind::Pt2, 0, false),
        (FilterKind::TimeDelay, 0, true),
        (FilterKind::TimeDelay, 5999, true),
        (FilterKind::TimeDelay, 6000, false),
        (FilterKind::TimeDelay, 10_000, false),
    ] {
        let (is, issues) = issues(FilterConfig { order: 2, time_constant_us, ..of(kind) });
        assert_eq!(is, runs, "{kind:?} {time_constant_us}");
        let refused = |issue: &FilterIssue| matches!(issue, FilterIssue::TimeConstant { .. });
        assert_eq!(issues.iter().any(refused), !runs);
    }
    assert_eq!(issues(of(FilterKind::AllPass)), (true, vec![FilterIssue::AllPassNotBessel]));
    let bessel = FilterConfig { prototype: Prototype::Bessel, ..of(FilterKind::AllPass) };
    assert_eq!(issues(bessel), (true, vec![]));
    assert_eq!(issues(of(FilterKind::HighPass)), (true, vec![FilterIssue::RemovesConstantPart]));
}
