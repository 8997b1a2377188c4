//! The shaping chain of an axis: rest, switching, linearity, settling, and the entries of a list.

use super::reference::assert_close;
use kontur_filters::cascade::{Cascade, FilterEntry, ListedPrototype, ListedType};
use kontur_filters::fir::{FirConfig, FirKind};
use kontur_filters::hsc::{HscConfig, HscKind};
use kontur_filters::iir::prototype::Prototype;
use kontur_filters::iir::{AxisFilter, FilterConfig, FilterKind};
use kontur_filters::issue::FilterIssue;
use kontur_filters::kernel::Kernel;
use kontur_filters::response::Angle;
use kontur_filters::ring::Ring;
use kontur_filters::shaping::{Mark, Shaping};
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use proptest::prelude::*;
use std::sync::Arc;

const MS: CycleTime = CycleTime::DEFAULT;
const POSITION_MM: f64 = 1000.123456789;
fn standard(kind: FilterKind, prototype: Prototype, order: u32, share_ratio: f64) -> FilterConfig {
    let time_constant_us = if kind == FilterKind::TimeDelay { 2300 } else { 10_000 };
    let default = FilterConfig::default();
    FilterConfig { kind, prototype, order, share_ratio, time_constant_us, ..default }
}

fn design(config: &FilterConfig) -> AxisFilter {
    AxisFilter::design(config, MS).0.unwrap()
}

fn guard(mode: u8) -> Arc<Kernel> {
    let settings = VibGuardSettings { mode, freq_hz: 40.0, damping: 0.1 };
    Arc::new(settings.kernel(MS).unwrap())
}

/// Every kernel, with every share.
fn kernels() -> Vec<Arc<Kernel>> {
    let mut kernels: Vec<_> = (1..=4).map(guard).collect();
    for share_ratio in [0.0, 0.37, 1.0] {
        for kind in
            [FirKind::MovingAverage, FirKind::Gauss, FirKind::WindowedSinc, FirKind::TimeDelay]
        {
            for order in [1, 41, 100] {
                let config = FirConfig { order, share_ratio, ..FirConfig::new(kind) };
                kernels.push(Arc::new(config.design(MS).0.unwrap()));
            }
        }
        for kind in [HscKind::Mean, HscKind::NoVib] {
            let hsc =
                HscConfig { kind, order: 0, time_constant_us: 20_000, f_hz: 30.0, share_ratio };
            kernels.push(Arc::new(hsc.design(MS).0.unwrap()));
        }
    }
    kernels
}

fn stays(shaping: &mut Shaping, cycles: u32, what: &dyn std::fmt::Debug) {
    for cycle in 0..cycles {
        let y = shaping.step(POSITION_MM);
        assert_eq!(y.to_bits(), POSITION_MM.to_bits(), "cycle {cycle}: {what:?}");
    }
}

#[test]
fn a_standing_axis_keeps_every_bit_in_every_filter() {
    for kind in FilterKind::ALL {
        for share_ratio in [0.0, 0.37, 1.0] {
            let config = standard(kind, Prototype::Bessel, 3, share_ratio);
            let mut shaping = Shaping::new(vec![design(&config)], POSITION_MM);
            stays(&mut shaping, 1_000_000, &config);
            // All prototypes and orders, for a shorter time.
            for prototype in Prototype::ALL {
                for order in 1..=6 {
                    let config = standard(kind, prototype, order, share_ratio);
                    let mut shaping = Shaping::new(vec![design(&config)], POSITION_MM);
                    stays(&mut shaping, 1000, &config);
                }
            }
        }
    }
}

#[test]
fn a_standing_axis_keeps_every_bit_in_every_kernel() {
    for (i, kernel) in kernels().into_iter().enumerate() {
        let mut shaping = Shaping::new(vec![], POSITION_MM);
        shaping.set_kernel(Some(kernel)).unwrap();
        stays(&mut shaping, 1_000_000, &i);
    }
}

/// At low corner frequencies direct forms lose digits and drift.
#[test]
fn a_slow_filter_neither_creeps_nor_loses_digits() {
    for f_hz in [0.01, 0.1, 1.0, 15.0] {
        let config = FilterConfig {
            f_hz,
            prototype: Prototype::Butterworth,
            order: 2,
            ..FilterConfig::default()
        };
        let mut shaping = Shaping::new(vec![design(&config)], POSITION_MM);
        stays(&mut shaping, 100_000, &config);
    }
    // On a ramp the output lags by the delay, to a few units in the last place of 1000 mm.
    let config = FilterConfig { order: 4, f_hz: 15.0, ..FilterConfig::default() };
    let mut shaping = Shaping::new(vec![design(&config)], 1000.0);
    let mut lag = 0.0;
    for n in 1..3000 {
        let x = 1000.0 + 0.1 * f64::from(n);
        lag = x - shaping.step(x);
    }
    assert_close(lag, 0.1 * shaping.delay_cycles(), 1e-11, &config);
}

#[test]
fn without_filters_the_input_comes_out() {
    let mut shaping = Shaping::new(vec![], 0.0);
    for x in [-0.0, 1e-320, POSITION_MM, -1e300, 5.0] {
        assert_eq!(shaping.step(x).to_bits(), f64::to_bits(x));
        assert!(shaping.settled(1e-300));
    }
    assert_eq!((shaping.flush_cycles(), shaping.delay_cycles().to_bits()), (0, 0));
}

#[test]
fn switching_at_rest_does_not_jump() {
    let mut shaping = Shaping::new(vec![], 0.0);
    let mut x = 0.0;
    let kernels: Vec<_> = kernels().into_iter().map(Some).collect();
    let sequence = kernels.iter().flat_map(|kernel| [kernel.clone(), None]);
    let mut y = 0.0;
    for (i, kernel) in sequence.chain(kernels.iter().cloned()).enumerate() {
        // Moves, then rests until the change is free of a jump.
        for _ in 0..7 {
            x += 0.0667;
            y = shaping.step(x);
        }
        assert!(kernel.is_none() || !shaping.ready_for(kernel.as_deref()));
        let mut waited = 0;
        while !shaping.ready_for(kernel.as_deref()) {
            y = shaping.step(x);
            waited += 1;
        }
        let longest = shaping.flush_cycles().max(kernel.as_ref().map_or(0, |k| k.length()));
        assert!(waited <= longest, "waited {waited} cycles");
        assert_eq!(y.to_bits(), x.to_bits(), "{i}");
        shaping.set_kernel(kernel).unwrap();
        assert_eq!(shaping.step(x).to_bits(), x.to_bits(), "{i}");
    }
}

#[test]
fn switching_while_moving_is_refused() {
    let mut shaping = Shaping::new(vec![], 0.0);
    shaping.step(1.0);
    assert!(shaping.set_kernel(Some(guard(2))).is_err());
    assert!(shaping.kernel().is_identity());
    assert!((shaping.step(2.0) - 2.0).abs() < f64::EPSILON);
}

#[test]
fn arrival() {
    // CRIT_DAMPING 4 at 15 Hz needs 60 cycles (to 0.1 %) for a step, more for a smaller window.
    let config = FilterConfig { order: 4, f_hz: 15.0, ..FilterConfig::default() };
    let mut shaping = Shaping::new(vec![design(&config)], 0.0);
    let mut cycles = 0;
    loop {
        shaping.step(1.0);
        if shaping.settled(0.001) {
            break;
        }
        cycles += 1;
    }
    assert_eq!(cycles, 60);
    // A kernel has to be flushed as well.
    shaping.settle(0.0);
    shaping.set_kernel(Some(guard(2))).unwrap();
    let length = shaping.flush_cycles();
    for _ in 0..length {
        shaping.step(1e-9);
        assert!(!shaping.settled(1.0));
    }
    shaping.step(1e-9);
    assert!(shaping.settled(1.0));
    // Filters without a constant part come to their own end.
    for kind in [FilterKind::HighPass, FilterKind::BandPass] {
        let config = standard(kind, Prototype::Butterworth, 2, 1.0);
        let mut shaping = Shaping::new(vec![design(&config)], 5.0);
        for _ in 0..3000 {
            shaping.step(7.0);
        }
        assert!(shaping.settled(4e-5));
        assert_close(shaping.step(7.0), 5.0, 1e-9, &config);
    }
}

/// Conformance: A011.
#[test]
fn the_chain_multiplies_responses_and_adds_delays() {
    let low = standard(FilterKind::LowPass, Prototype::CritDamping, 4, 1.0);
    let stop = standard(FilterKind::BandStop, Prototype::Butterworth, 2, 0.37);
    let mut shaping = Shaping::new(vec![design(&low), design(&stop)], 0.0);
    shaping.set_kernel(Some(guard(3))).unwrap();
    let parts = [design(&low), design(&stop)];
    let delay: f64 = parts.iter().map(Stage::delay_cycles).sum();
    assert_close(shaping.delay_cycles(), delay + guard(3).delay_cycles(), 1e-12, &"delay");
    let at = Angle::of(17.0, MS);
    let product =
        parts.iter().fold(guard(3).response(at), |product, part| product * part.response(at));
    assert_close(shaping.response(at).magnitude(), product.magnitude(), 1e-15, &"magnitude");
    assert_close(shaping.response(Angle::of(0.0, MS)).magnitude(), 1.0, 1e-14, &"constant");
    // A sine measured after the start-up, against the response.
    let step = 2.0 * std::f64::consts::PI * 17.0 * 0.001;
    let highest = (0..6000)
        .map(|n| (n, shaping.step(libm::sin(step * f64::from(n)))))
        .filter(|&(n, _)| n >= 3000)
        .fold(0.0, |highest: f64, (_, y)| highest.max(y));
    assert_close(highest, product.magnitude(), 1e-4 * highest, &"sine");
}

/// Conformance: A098.
#[test]
fn a_share_of_the_signal_goes_past_the_filter() {
    for kind in FilterKind::ALL {
        let whole = standard(kind, Prototype::Bessel, 2, 1.0);
        let part = FilterConfig { share_ratio: 0.37, ..whole };
        let none = FilterConfig { share_ratio: 0.0, ..whole };
        let [mut whole, mut part, mut none] = [whole, part, none].map(|c| design(&c));
        for n in 0..400_u32 {
            let x = f64::from(n * n % 101) * 0.1;
            let (f, y) = (whole.step(x), part.step(x));
            assert_close(y, x + 0.37 * (f - x), 1e-12, &(kind, n));
            assert_eq!(none.step(x).to_bits(), x.to_bits());
        }
    }
    // Half of the signal past a low-pass leaves -6 dB of the high frequencies.
    let half = standard(FilterKind::LowPass, Prototype::Butterworth, 6, 0.5);
    let floor = design(&half).response(Angle::of(450.0, MS));
    assert_close(floor.magnitude_db(), -6.02, 0.01, &half);
}

/// Conformance: A013, A068, A069, A070, A075, A087.
#[test]
fn entries_of_a_list() {
    let low = FilterEntry { enable: true, order: 4, f_hz: 15.0, ..FilterEntry::default() };
    let hsc = FilterEntry { prototype: ListedPrototype::Hsc, order: 20, ..FilterEntry::default() };
    let typed = |listed_type, entry| FilterEntry { listed_type: Some(listed_type), ..entry };
    let of = |entries: &[FilterEntry]| {
        let cascade = Cascade::design(entries, false, MS);
        (cascade.filters.len(), cascade.hsc.map(|hsc| hsc.kind), cascade.issues)
    };
    assert_eq!(of(&[low, low, low]), (3, None, vec![]));
    assert_eq!(of(&[FilterEntry { enable: false, ..low }]), (0, None, vec![]));
    assert_eq!(of(&[FilterEntry { order: 0, ..low }]), (0, None, vec![]));
    // HSC: the first entry only, without regard to enable; the others may be standard filters.
    assert_eq!(of(&[hsc, low]), (1, Some(HscKind::Mean), vec![]));
    assert_eq!(of(&[low, hsc]), (1, None, vec![(1, FilterIssue::HscNotFirst)]));
    assert_eq!(of(&[hsc, hsc]), (0, Some(HscKind::Mean), vec![(1, FilterIssue::SecondHsc)]));
    // The type must fit the prototype.
    let no_vib = ListedType::Hsc(HscKind::NoVib);
    assert_eq!(of(&[typed(no_vib, hsc)]), (0, Some(HscKind::NoVib), vec![]));
    assert_eq!(of(&[typed(no_vib, low)]), (0, None, vec![(0, FilterIssue::HscPrototype)]));
    let standard = ListedType::Standard(FilterKind::LowPass);
    assert_eq!(of(&[typed(standard, hsc)]), (0, None, vec![(0, FilterIssue::HscPrototype)]));
    let spindle = Cascade::design(&[hsc, low], true, MS);
    assert_eq!(spindle.issues, [(0, FilterIssue::HscOnSpindle)]);
    assert!(spindle.hsc.is_none() && spindle.filters.len() == 1);
    // The default time constant is not a time delay at 1 ms.
    let delay = typed(ListedType::Standard(FilterKind::TimeDelay), low);
    let refused = FilterIssue::TimeConstant { time_constant_us: 10_000, min_us: 0, max_us: 5999 };
    assert_eq!(of(&[delay]), (0, None, vec![(0, refused)]));
}

/// Conformance: A002, A099.
#[test]
fn numbers_of_types_and_prototypes() {
    for number in [0, 7, 9, 13, u32::MAX] {
        let refused = FilterIssue::TypeNotPermitted { number };
        assert_eq!(ListedType::from_number(number), Err(refused));
    }
    for (number, kind) in [1, 2, 3, 4, 5, 6, 10, 11].into_iter().zip(FilterKind::ALL) {
        assert_eq!(ListedType::from_number(number), Ok(ListedType::Standard(kind)));
    }
    assert_eq!(ListedType::from_number(8), Ok(ListedType::Hsc(HscKind::Mean)));
    assert_eq!(ListedType::from_number(12), Ok(ListedType::Hsc(HscKind::NoVib)));
    for (number, prototype) in (1..=3).zip(Prototype::ALL) {
        let want = Some(ListedPrototype::Standard(prototype));
        assert_eq!(ListedPrototype::from_number(number), want);
    }
    assert_eq!(ListedPrototype::from_number(5), Some(ListedPrototype::Hsc));
    assert!([0, 4, 6].into_iter().all(|number| ListedPrototype::from_number(number).is_none()));
}

fn any_filter() -> impl Strategy<Value = FilterConfig> {
    let kind = proptest::sample::select(FilterKind::ALL.to_vec());
    let prototype = proptest::sample::select(Prototype::ALL.to_vec());
    (kind, prototype, 1..=6_u32, 2.0..200.0_f64, 1.0..=10.0_f64, 0.0..=1.0_f64, 1000..5999_u32)
        .prop_map(|(kind, prototype, order, f_hz, q, share_ratio, time_constant_us)| FilterConfig {
            kind,
            prototype,
            order,
            f_hz,
            q,
            share_ratio,
            time_constant_us,
        })
}

fn any_kernel() -> impl Strategy<Value = Arc<Kernel>> {
    prop_oneof![
        (1..=4_u8, 1.0..400.0_f64, 0.0..0.6_f64).prop_map(|(mode, freq_hz, damping)| {
            let settings = VibGuardSettings { mode, freq_hz, damping };
            Arc::new(settings.kernel(MS).unwrap())
        }),
        proptest::sample::select(kernels()),
    ]
}

fn any_shaping() -> impl Strategy<Value = Shaping> {
    (proptest::collection::vec(any_filter(), 0..3), proptest::option::of(any_kernel())).prop_map(
        |(filters, kernel)| {
            let mut shaping = Shaping::new(filters.iter().map(design).collect(), 0.0);
            shaping.set_kernel(kernel).unwrap();
            shaping
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn chains_are_linear(
        shaping in any_shaping(),
        a in proptest::collection::vec(-10.0..10.0_f64, 300),
        b in proptest::collection::vec(-10.0..10.0_f64, 300),
        factor in -3.0..3.0_f64,
    ) {
        let [mut of_a, mut of_b, mut of_sum] = [shaping.clone(), shaping.clone(), shaping];
        for (a, b) in a.into_iter().zip(b) {
            let sum = of_a.step(a) + factor * of_b.step(b);
            prop_assert!((of_sum.step(a + factor * b) - sum).abs() < 1e-9);
        }
    }

    /// Compared with a chain that is stepped and never takes a way that is undone.
    #[test]
    fn a_row_that_is_taken_back_was_never_run(
        shaping in any_shaping(),
        rows in proptest::collection::vec((1..=Ring::ROOM, -1.0..1.0_f64, any::<bool>()), 1..12),
    ) {
        let (mut stepped, mut rows_run, mut mark) = (shaping.clone(), shaping, Mark::default());
        let mut x = 0.0;
        for (cycles, speed, rests) in rows {
            let way = |astray: f64| {
                let speed = if rests { 0.0 } else { speed };
                move |k: usize| x + astray + speed * (k + 1) as f64
            };
            rows_run.mark(&mut mark);
            let mut astray: Vec<f64> = (0..cycles).map(way(0.5)).collect();
            rows_run.run(&mut astray);
            rows_run.return_to(&mark, cycles);
            let mut row: Vec<f64> = (0..cycles).map(way(0.0)).collect();
            let wanted: Vec<u64> = row.iter().map(|x| stepped.step(*x).to_bits()).collect();
            x = row[cycles - 1];
            rows_run.run(&mut row);
            let seen: Vec<u64> = row.iter().map(|y| y.to_bits()).collect();
            prop_assert_eq!(seen, wanted);
            prop_assert_eq!(stepped.flushed(), rows_run.flushed());
        }
    }

    #[test]
    fn after_settling_nothing_moves(
        mut shaping in any_shaping(),
        noise in proptest::collection::vec(-10.0..10.0_f64, 50),
        x in -1e4..1e4_f64,
    ) {
        for x in noise {
            shaping.step(x);
        }
        shaping.settle(x);
        prop_assert!(shaping.settled(1e-12));
        for _ in 0..100 {
            prop_assert_eq!(shaping.step(x).to_bits(), x.to_bits());
        }
    }

    /// A long ramp comes out as the same ramp, later by the delay.
    #[test]
    fn kernels_delay_a_ramp(kernel in any_kernel(), per_cycle in -1.0..1.0_f64) {
        let mut shaping = Shaping::new(vec![], 0.0);
        let delay = kernel.delay_cycles();
        let length = kernel.length();
        shaping.set_kernel(Some(kernel)).unwrap();
        let mut lag = 0.0;
        for n in 0..=length + 10 {
            let x = per_cycle * f64::from(n);
            lag = x - shaping.step(x);
        }
        prop_assert!((lag - per_cycle * delay).abs() < 1e-9);
    }

    #[test]
    fn weights_sum_to_one(kernel in any_kernel()) {
        let response = kernel.response(Angle::of(0.0, MS));
        prop_assert!((response.magnitude() - 1.0).abs() < 1e-14);
        prop_assert!((response.group_delay_cycles() - kernel.delay_cycles()).abs() < 1e-9);
    }
}

/// Tap by tap: `sum w exp(-i w d)`.
#[test]
fn the_response_of_a_kernel_is_its_fourier_sum() {
    for kernel in kernels() {
        for f_hz in [0.0, 3.0, 41.0, 333.0] {
            let sum = kernel.taps().iter().fold((0.0, 0.0), |(re, im), tap| {
                let angle = -2.0 * std::f64::consts::PI * f_hz * 0.001 * f64::from(tap.delay);
                (re + tap.weight * libm::cos(angle), im + tap.weight * libm::sin(angle))
            });
            let got = kernel.response(Angle::of(f_hz, MS));
            assert_close(got.magnitude(), libm::hypot(sum.0, sum.1), 1e-9, &f_hz);
            if got.magnitude() > 1e-3 {
                let turned = got.phase_deg() - libm::atan2(sum.1, sum.0).to_degrees();
                assert!((libm::cos(turned.to_radians()) - 1.0).abs() < 1e-9, "{f_hz} Hz: {turned}");
            }
        }
    }
}

proptest! {
    /// While the chain rests, a cycle repeats the output and may be skipped, but still counts.
    #[test]
    fn a_cycle_left_out_is_the_one_before(
        mode in 1_u8..=4,
        filtered: bool,
        sets in prop::collection::vec((-1_i32..=1, 1_u32..150), 1..8),
    ) {
        let filters = if filtered {
            vec![design(&standard(FilterKind::LowPass, Prototype::Bessel, 2, 0.0))]
        } else {
            Vec::new()
        };
        let longer = Kernel::delay(100);
        let mut every = Shaping::new(filters, 0.0);
        every.set_kernel(Some(guard(mode))).unwrap();
        let mut seldom = every.clone();
        let mut before: f64 = 0.0;
        for (set, cycles) in sets {
            for _ in 0..cycles {
                let set = f64::from(set);
                if seldom.rests_under(set) {
                    seldom.rest(1);
                } else {
                    before = seldom.step(set);
                }
                prop_assert_eq!(every.step(set).to_bits(), before.to_bits());
            }
            // skipped cycles count as rest for a longer kernel
            let ready = [&every, &seldom].map(|chain| chain.ready_for(Some(&longer)));
            prop_assert_eq!(ready[0], ready[1]);
        }
    }
}
