//! Standard filters that are changed while an axis rests.

use kontur_filters::iir::prototype::Prototype;
use kontur_filters::iir::{AxisFilter, FilterConfig, FilterKind};
use kontur_filters::shaping::{Origin, Shaping};
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use proptest::prelude::*;

fn low_pass(order: u32, f_hz: f64) -> AxisFilter {
    let (kind, prototype) = (FilterKind::LowPass, Prototype::CritDamping);
    let config = FilterConfig { kind, prototype, order, f_hz, ..FilterConfig::default() };
    AxisFilter::design(&config, CycleTime::DEFAULT).0.unwrap()
}

proptest! {
    /// An axis that is still a little away from its input when a filter is changed or switched on continues from its
    /// position and reaches the input: no step of a low-pass of at least 2 Hz is larger than the first step of its
    /// response to the whole distance.
    #[test]
    fn a_changed_filter_continues_from_where_the_axis_is(
        order in 1..=4_u32, before_hz in 2.0..20.0_f64, after_hz in 2.0..20.0_f64, cycles in 1..400_u32, added: bool,
    ) {
        let mut shaping = Shaping::new(vec![low_pass(order, before_hz)], 0.0);
        let mut y = 0.0;
        for _ in 0..cycles {
            y = shaping.step(10.0);
        }
        let left = 10.0 - y;
        let (filters, origins) = if added {
            (vec![low_pass(order, before_hz), low_pass(order, after_hz)], vec![Origin::Same(0), Origin::New])
        } else {
            (vec![low_pass(order, after_hz)], vec![Origin::Changed(0)])
        };
        shaping.change_filters(filters, &origins);
        // the first cycle of the step response of a low-pass of first order: 1 - exp(-2 pi f T)
        let most = 1.0 - libm::exp(-std::f64::consts::TAU * 20.0 * 1e-3);
        let next = shaping.step(10.0);
        prop_assert!((next - y).abs() <= most * left + 1e-9, "{} of {left}", next - y);
        for _ in 0..5000 {
            y = shaping.step(10.0);
        }
        prop_assert!((y - 10.0).abs() < 1e-6);
    }

    /// A shift of the coordinate at standstill changes nothing but the coordinate: the axis stays, and a later motion is the
    /// one without the shift, moved by it. That includes filters that block constants, and shares of them.
    #[test]
    fn a_shift_moves_nothing_but_the_coordinate(
        kinds in prop::collection::vec(0..4_usize, 1..=3), share_ratio in 0.2..1.0_f64, f_hz in 3.0..30.0_f64, by in -100.0..100.0_f64,
    ) {
        const KINDS: [FilterKind; 4] =
            [FilterKind::LowPass, FilterKind::HighPass, FilterKind::BandPass, FilterKind::BandStop];
        let filter = |i: &usize| {
            let config =
                FilterConfig { kind: KINDS[*i], order: 1, f_hz, share_ratio, ..FilterConfig::default() };
            AxisFilter::design(&config, CycleTime::DEFAULT).0.unwrap()
        };
        let mut plain = Shaping::new(kinds.iter().map(filter).collect(), 0.0);
        for _ in 0..20_000 {
            plain.step(10.0);
        }
        let mut shifted = plain.clone();
        shifted.shift(by);
        for target in [10.0, 10.0, 25.0] {
            for _ in 0..500 {
                let (y, moved) = (plain.step(target), shifted.step(target + by));
                prop_assert!((moved - by - y).abs() < 1e-8, "{moved} instead of {}", y + by);
            }
        }
    }
}
