//! FIR and HSC kernels against reference corner errors, closed forms and the ranges of their parameters.

use super::corner::corner;
use super::reference::{assert_close, rows};
use kontur_filters::fir::{FirConfig, FirKind};
use kontur_filters::hsc::{HscConfig, HscKind};
use kontur_filters::iir::{AxisFilter, FilterConfig};
use kontur_filters::issue::FilterIssue;
use kontur_filters::kernel::{Kernel, KernelFilter};
use kontur_filters::response::{Angle, step_response};
use kontur_filters::time::CycleTime;
use std::sync::Arc;

const MS: CycleTime = CycleTime::DEFAULT;

fn fir(config: FirConfig) -> Kernel {
    let (kernel, issues) = config.design(MS);
    assert_eq!(issues, []);
    kernel.unwrap()
}

fn mean(order: u32) -> Kernel {
    fir(FirConfig { order, ..FirConfig::new(FirKind::MovingAverage) })
}

fn hsc(kind: HscKind) -> HscConfig {
    HscConfig { kind, order: 1, time_constant_us: 10_000, f_hz: 30.0, share_ratio: 1.0 }
}

fn filter(kernel: Kernel) -> KernelFilter {
    KernelFilter::new(Arc::new(kernel), 0.0)
}

/// Conformance: A082.
#[test]
fn kernels_and_corner_errors_of_the_reference() {
    for row in rows("axis_filters_fir_corner") {
        let order: u32 = row.text("order").parse().unwrap();
        let config = match row.text("kernel") {
            "HSC_MEAN/FIR1" => FirConfig::new(FirKind::MovingAverage),
            "FIR2_GAUSS q=1 (sigma=N/5)" => FirConfig::new(FirKind::Gauss),
            "FIR3_SINC fc=30" => FirConfig::new(FirKind::WindowedSinc),
            "FIR3_SINC fc=100" => {
                FirConfig { fcut_hz: 100.0, ..FirConfig::new(FirKind::WindowedSinc) }
            }
            other => panic!("{other}"),
        };
        let kernel = fir(FirConfig { order, ..config });
        assert_close(kernel.taps().len() as f64, row.number("taps"), 0.0, &row);
        assert_close(kernel.delay_cycles(), row.number("delay_cycles"), 1e-13, &row);
        let variance = row.number("variance_cycles2");
        assert_close(kernel.variance_cycles2(), variance, 1e-8 * variance.abs(), &row);
        // A zero of the sine rounds to either side.
        let negative = kernel.taps().iter().filter(|tap| tap.weight < -1e-15).count();
        assert_close(negative as f64, row.number("negative_taps"), 0.0, &row);

        let per_cycle = row.number("feed_mm_min") / 60.0 * row.number("cycle_s");
        let is = corner(&filter(kernel.clone()), per_cycle, 2 * order + 2);
        let want = row.number("contour_error_mm");
        assert_close(is.contour_error, want, 1e-8 * want, &row);
        let want = row.number("corner_distance_mm");
        assert_close(is.corner_distance, want, 1e-8 * want, &row);
        if negative == 0 {
            assert_close(per_cycle * kernel.m1_cycles(), is.contour_error, 1e-9 * want, &row);
        }

        let highest =
            step_response(&mut filter(kernel), order as usize + 2).into_iter().fold(0.0, f64::max);
        assert_close(100.0 * (highest - 1.0), row.number("step_overshoot_pct"), 1e-5, &row);
    }
}

/// E = v T N (N + 2) / (8 (N + 1)) for even, v T (N + 1) / 8 for odd orders; the vendor's sample N = 100 at F1000.
#[test]
fn corner_error_of_the_mean_filter() {
    let per_cycle = 1000.0 / 60.0 * 0.001;
    for (order, printed) in [(10, 0.02273), (50, 0.10621), (100, 0.21040), (200, 0.41874)] {
        let is = corner(&filter(mean(order)), per_cycle, 500);
        let n = f64::from(order);
        assert_close(
            is.contour_error,
            per_cycle * n * (n + 2.0) / (8.0 * (n + 1.0)),
            1e-12,
            &order,
        );
        assert_close(is.contour_error, printed, 5.1e-6, &order);
        assert_close(is.corner_distance, 2.0_f64.sqrt() * is.contour_error, 1e-12, &order);
    }
    let odd = corner(&filter(mean(11)), per_cycle, 500);
    assert_close(odd.contour_error, per_cycle * 12.0 / 8.0, 1e-12, &11);
}

#[test]
fn corner_frequencies_of_the_mean_filter() {
    for (order, printed_hz) in [(10, 40.4), (50, 8.69), (100, 4.39), (200, 2.20)] {
        let response = mean(order).response(Angle::of(printed_hz, MS));
        assert_close(response.magnitude_db(), -3.0103, 0.02, &order);
        let zero = mean(order).response(Angle::of(1000.0 / f64::from(order + 1), MS));
        assert!(zero.magnitude() < 1e-14);
    }
}

#[test]
fn the_bell_and_the_sinc() {
    let gauss = |quality| fir(FirConfig { order: 40, quality, ..FirConfig::new(FirKind::Gauss) });
    assert_close(gauss(1.0).m1_cycles(), 3.100, 5e-4, &"quality 1");
    assert_close(gauss(0.5).m1_cycles(), 1.587, 1e-2, &"quality 0.5");
    let taps = gauss(1.0);
    assert_close(taps.taps()[0].weight / taps.taps()[20].weight, 0.044, 1e-3, &"end tap");
    let sinc =
        fir(FirConfig { order: 40, fcut_hz: 100.0, ..FirConfig::new(FirKind::WindowedSinc) });
    assert_close(sinc.response(Angle::of(100.0, MS)).magnitude(), 0.50, 5e-3, &"cut-off");
    let highest = step_response(&mut filter(sinc), 60).into_iter().fold(0.0, f64::max);
    assert_close(highest - 1.0, 0.064, 5e-4, &"overshoot");
}

/// Conformance: A077.
#[test]
fn no_vibration_blocks_its_frequency() {
    for tenth_hz in 50..=3333 {
        let f_hz = f64::from(tenth_hz) / 10.0;
        let (kernel, issues) = HscConfig { f_hz, ..hsc(HscKind::NoVib) }.design(MS);
        assert_eq!(issues, [], "{f_hz}");
        let kernel = kernel.unwrap();
        assert!(kernel.response(Angle::of(f_hz, MS)).magnitude() < 1e-12, "{f_hz}");
        assert!(!kernel.has_negative_taps(), "{f_hz}");
        assert!(kernel.taps().len() <= 201, "{f_hz}");
        let weights = |kernel: &Kernel| kernel.taps().iter().map(|t| t.weight).collect::<Vec<_>>();
        assert_eq!(weights(&kernel), weights(&kernel.reversed()), "{f_hz}");
    }
    // f0 = 30 Hz: K = 16, outer taps 0.167216 of the others, 35 taps, 1.0e-4 at the second multiple.
    let kernel = hsc(HscKind::NoVib).design(MS).0.unwrap();
    assert_eq!(kernel.taps().len(), 35);
    assert_close(kernel.taps()[0].weight / kernel.taps()[1].weight, 0.167216, 1e-6, &30);
    assert_close(kernel.delay_cycles(), 17.0, 1e-12, &30);
    assert_close(kernel.response(Angle::of(60.0, MS)).magnitude(), 1.0e-4, 1e-5, &60);
    let kernel = HscConfig { f_hz: 20.0, ..hsc(HscKind::NoVib) }.design(MS).0.unwrap();
    assert_eq!(kernel.taps().len(), 51);
    assert_close(kernel.taps()[0].weight / kernel.taps()[1].weight, 0.5, 1e-12, &20);
}

#[test]
fn the_share_keeps_the_delay() {
    for (order, share_ratio) in [(10, 0.37), (11, 0.37), (10, 0.0), (11, 0.0), (1, 0.5)] {
        for kind in [FirKind::MovingAverage, FirKind::Gauss, FirKind::WindowedSinc] {
            let kernel = fir(FirConfig { order, share_ratio, ..FirConfig::new(kind) });
            assert_close(kernel.delay_cycles(), 0.5 * f64::from(order), 1e-12, &(kind, order));
            let whole = fir(FirConfig { order, ..FirConfig::new(kind) });
            let at = Angle::of(40.0, MS);
            let bypass = 1.0 - share_ratio;
            let centred = |kernel: &Kernel| kernel.response(at).magnitude();
            if order % 2 == 0 {
                let want = share_ratio * centred(&whole) + bypass;
                assert_close(centred(&kernel), want, 1e-12, &(kind, order));
            }
        }
    }
    let delay = FirConfig { order: 20, share_ratio: 0.3, ..FirConfig::new(FirKind::TimeDelay) };
    assert_eq!(delay.design(MS), (Some(Kernel::delay(20)), vec![FilterIssue::ShareOfDelay]));
    let half = FirConfig { order: 4, share_ratio: 0.0, ..FirConfig::new(FirKind::MovingAverage) };
    assert_eq!(fir(half), Kernel::delay(2));
}

#[test]
fn where_the_order_comes_from() {
    let of = |kind, order, order_time_us| {
        let config = FirConfig { order, order_time_us, ..FirConfig::new(kind) };
        let (kernel, issues) = config.design(MS);
        (kernel.map(|kernel| kernel.length()), issues)
    };
    let average = FirKind::MovingAverage;
    assert_eq!(of(average, 0, 0), (None, vec![FilterIssue::NoOrder]));
    let short = FilterIssue::OrderTimeBelowCycle { order_time_us: 999, cycle_us: 1000 };
    assert_eq!(of(average, 0, 999), (None, vec![short]));
    assert_eq!(of(average, 0, 1000), (Some(1), vec![]));
    assert_eq!(of(average, 0, 20_499), (Some(20), vec![]));
    assert_eq!(of(average, 0, 20_500), (Some(21), vec![]));
    assert_eq!(of(average, 0, 200_000), (Some(200), vec![]));
    let high = |order, used| vec![FilterIssue::OrderTooHigh { order, used }];
    assert_eq!(of(average, 0, u32::MAX), (Some(200), high(4_294_967, 200)));
    assert_eq!(of(average, 201, 5), (Some(200), high(201, 200)));
    assert_eq!(of(average, 30, 5000), (Some(30), vec![]));
    assert_eq!(of(FirKind::TimeDelay, 100, 0), (Some(100), vec![]));
    assert_eq!(of(FirKind::TimeDelay, 101, 0), (Some(100), high(101, 100)));

    let mut config = FirConfig { order: 7, ..FirConfig::new(average) };
    config.program_order(None, None);
    assert_eq!((config.order, config.order_time_us), (7, 0));
    config.program_order(None, Some(5000));
    assert_eq!(config.design(MS).0.unwrap().length(), 5);
    config.program_order(Some(9), Some(5000));
    assert_eq!(config.design(MS).0.unwrap().length(), 9);
}

#[test]
fn ranges_of_fir_filters() {
    let runs = |config: FirConfig| config.design(MS).0.is_some();
    let sinc = FirConfig { order: 20, ..FirConfig::new(FirKind::WindowedSinc) };
    for (fcut_hz, on) in
        [(0.99, false), (1.0, true), (499.0, true), (500.0, false), (f64::NAN, false)]
    {
        assert_eq!(runs(FirConfig { fcut_hz, ..sinc }), on, "{fcut_hz}");
        // The other types do not look at it.
        assert!(runs(FirConfig { fcut_hz, kind: FirKind::Gauss, ..sinc }));
    }
    let gauss = FirConfig { kind: FirKind::Gauss, ..sinc };
    for (quality, on) in [(0.0, false), (1e-6, true), (1.0, true), (1.01, false), (f64::NAN, false)]
    {
        assert_eq!(runs(FirConfig { quality, ..gauss }), on, "{quality}");
    }
    for (share_ratio, on) in [(-0.1, false), (0.0, true), (1.0, true), (1.1, false)] {
        assert_eq!(runs(FirConfig { share_ratio, ..gauss }), on, "{share_ratio}");
    }
}

/// Conformance: A088, A102, A103.
#[test]
fn ranges_of_hsc_filters() {
    let of = |config: HscConfig| {
        let (kernel, issues) = config.design(MS);
        (kernel.map(|kernel| kernel.length()), issues)
    };
    let time = |kind, time_constant_us| HscConfig { order: 0, time_constant_us, ..hsc(kind) };
    let short = vec![FilterIssue::OrderTimeBelowCycle { order_time_us: 999, cycle_us: 1000 }];
    assert_eq!(of(time(HscKind::Mean, 1000)), (Some(1), vec![]));
    assert_eq!(of(time(HscKind::Mean, 200_000)), (Some(200), vec![]));
    assert_eq!(of(time(HscKind::Mean, 999)), (None, short.clone()));
    assert_eq!(of(time(HscKind::Mean, 0)), (None, vec![FilterIssue::NoOrder]));
    let high = vec![FilterIssue::OrderTooHigh { order: 201, used: 200 }];
    assert_eq!(of(HscConfig { order: 201, ..hsc(HscKind::Mean) }), (Some(200), high));
    // NoVib: order or time only switch on.
    assert_eq!(of(time(HscKind::NoVib, 1000)), (Some(34), vec![]));
    assert_eq!(of(time(HscKind::NoVib, 999)), (None, short));
    assert_eq!(of(HscConfig { order: 5000, ..hsc(HscKind::NoVib) }), (Some(34), vec![]));
    for f_hz in [4.99, 333.4, 0.0, f64::NAN] {
        let (kernel, issues) = of(HscConfig { f_hz, ..hsc(HscKind::NoVib) });
        assert!(
            kernel.is_none() && matches!(issues[..], [FilterIssue::Frequency { .. }]),
            "{f_hz}"
        );
    }
    assert_eq!(of(HscConfig { f_hz: 5.0, ..hsc(HscKind::NoVib) }).0, Some(200));
}

/// Symmetric kernels draw the same path in both directions, a recursive low-pass does not.
#[test]
fn forward_and_backward() {
    let mean = super::corner::forward_backward_gap(&filter(mean(40)), 0.05, 200);
    assert!(mean < 1e-12, "{mean:e}");
    let config = FilterConfig { order: 4, f_hz: 15.0, ..FilterConfig::default() };
    let low_pass = AxisFilter::design(&config, MS).0.unwrap();
    let low_pass = super::corner::forward_backward_gap(&low_pass, 0.05, 400);
    assert!(low_pass > 1e-3, "{low_pass:e}");
}
