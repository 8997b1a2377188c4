//! Cycles in a row: an axis that runs through many at once gives the same output as one that is stepped, bit for bit,
//! also with faults in the middle of rows.

use super::rest::{configs, stretches};
use kontur_filters::control::axis_control::Shown;
use kontur_filters::control::monitor::LagMonitorType;
use kontur_filters::control::plant::PlantModel;
use kontur_filters::control::{
    AxisControl, AxisControlConfig, AxisInputs, ControlOutput, FeedforwardMode,
};
use kontur_filters::kernel::{Kernel, KernelFilter, Tap};
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use proptest::prelude::*;
use std::sync::Arc;

/// Runs the first cycles of a row, up to the first fault; what is shown of them, from number `shown_from` on.
fn run(
    axis: &mut AxisControl,
    row: &[f64],
    gain: f64,
    jerk_limited: bool,
    shown_from: usize,
) -> (usize, Vec<(usize, ControlOutput)>) {
    let before = axis.clone();
    let mut shown = Vec::new();
    let mut count = axis.run(row, gain, jerk_limited, shown_from, |i: usize, of: &Shown<'_>| {
        shown.push((i, of.output()));
    });
    while count < row.len() {
        *axis = before.clone();
        shown.clear();
        let again =
            axis.run(&row[..count], gain, jerk_limited, shown_from, |i: usize, of: &Shown<'_>| {
                shown.push((i, of.output()));
            });
        if again == count {
            break;
        }
        count = again;
    }
    (count, shown)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn a_row_is_its_cycles(
        config in configs(),
        stretches in stretches(),
        lengths in prop::collection::vec(1..300_usize, 1..9),
        last_only in any::<bool>(),
    ) {
        let mut single = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
        let mut rows = single.clone();
        let (mut set_mm, mut inputs) = (0.0, AxisInputs::default());
        let mut lengths = lengths.into_iter().cycle();
        for (cycles, speed, gain, jerk_limited, change) in stretches {
            match change {
                0 => inputs.force_mm_s2 = 40.0 - inputs.force_mm_s2,
                1 => inputs.additional_mm = 0.1 - inputs.additional_mm,
                2 => inputs.encoder_offset_mm = 0.01 - inputs.encoder_offset_mm,
                3 => [&mut single, &mut rows].into_iter().for_each(|a| a.expect_stop(set_mm)),
                4 => [&mut single, &mut rows].into_iter().for_each(AxisControl::halt),
                5 => [&mut single, &mut rows].into_iter().for_each(AxisControl::open_loop),
                _ => {}
            }
            single.set_inputs(inputs);
            rows.set_inputs(inputs);
            let path: Vec<f64> = (0..cycles)
                .map(|k| {
                    // an occasional jump, which the monitors of the set position report
                    set_mm += if k % 97 == 96 { 30.0 * speed } else { speed };
                    set_mm
                })
                .collect();
            let mut left = &path[..];
            while !left.is_empty() {
                let row = &left[..lengths.next().unwrap().min(left.len())];
                let shown_from = if last_only { row.len() - 1 } else { 0 };
                let (count, shown) = run(&mut rows, row, gain, jerk_limited, shown_from);
                let mut shown = shown.into_iter().peekable();
                for (i, x) in row[..count].iter().enumerate() {
                    let output = single.step(*x, gain, jerk_limited);
                    prop_assert!(i + 1 == count || single.faults().is_empty());
                    if let Some((_, seen)) = shown.next_if(|(at, _)| *at == i) {
                        prop_assert_eq!(format!("{seen:?}"), format!("{output:?}"));
                    } else {
                        prop_assert!(last_only && i + 1 < count);
                    }
                }
                prop_assert!(shown.next().is_none());
                prop_assert_eq!(single.faults(), rows.faults());
                prop_assert_eq!(single.distance_mm().to_bits(), rows.distance_mm().to_bits());
                left = &left[count..];
            }
        }
    }

    /// Rows without feedforward before cycles with it, on a rigid drive that nothing else acts on: the setpoints that the first
    /// window with feedforward holds have the slope that they were made with.
    #[test]
    fn feedforward_behind_a_row_knows_its_slope(
        delay_cycles in 0..4_usize,
        mode in prop::sample::select(&[1_u16, 2, 3][..]),
        jerk_limited in any::<bool>(),
        (speed, steeper) in (0.01..0.2_f64, 0.0..1e-3_f64),
        length in 8..60_usize,
    ) {
        let mut config = AxisControlConfig::new(1e4, 1e9, 1e12);
        config.position.kv_per_s = 50.0;
        config.feedforward.mode = FeedforwardMode::from_bits_truncate(mode);
        config.lag.kind = LagMonitorType::Off;
        config.plant.model = PlantModel::FirstOrder { time_constant_s: 0.005 };
        config.plant.dead_time_cycles = 0;
        config.delay_cycles = delay_cycles;
        let mut single = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
        let mut rows = single.clone();
        let mut set_mm = 0.0;
        for part in 0..6_u32 {
            let gain = f64::from(part % 2);
            let path: Vec<f64> = (0..length)
                .map(|k| {
                    // the motion before ends with the row, and the first windows with feedforward contain that end
                    let moves = gain.to_bits() == 0 || k > 4;
                    set_mm += if moves { speed + steeper * k as f64 } else { 0.0 };
                    set_mm
                })
                .collect();
            let (count, shown) = run(&mut rows, &path, gain, jerk_limited, 0);
            prop_assert_eq!(count, length);
            for (x, (_, seen)) in path.iter().zip(shown) {
                let output = single.step(*x, gain, jerk_limited);
                prop_assert_eq!(format!("{seen:?}"), format!("{output:?}"));
            }
        }
    }

    /// For any division of the inputs into rows; the reference is the sum over the taps as defined.
    #[test]
    fn a_kernel_in_rows_is_its_sum(
        taps in prop::collection::vec((0..40_u32, 0.1..1.0), 1..7),
        steps in prop::collection::vec(prop_oneof![2 => Just(0.0), 3 => -1.0..1.0], 1..900),
        lengths in prop::collection::vec(1..700_usize, 1..5),
    ) {
        let taps = taps.into_iter().map(|(delay, weight)| Tap { delay, weight });
        let kernel = Arc::new(Kernel::from_taps(taps).unwrap());
        let mut filter = KernelFilter::new(Arc::clone(&kernel), 5.0);
        let inputs: Vec<f64> = steps
            .iter()
            .scan(5.0, |x, step| {
                *x += step;
                Some(*x)
            })
            .collect();
        let mut outputs = inputs.clone();
        let mut left = &mut outputs[..];
        for length in lengths.into_iter().cycle() {
            let (row, rest) = left.split_at_mut(length.min(left.len()));
            filter.run(row);
            left = rest;
            if left.is_empty() {
                break;
            }
        }
        for (k, output) in outputs.iter().enumerate() {
            let past = |delay: u32| k.checked_sub(delay as usize).map_or(5.0, |k| inputs[k]);
            let pull = |tap: &Tap| tap.weight * (past(tap.delay) - inputs[k]);
            let sum = match kernel.taps() {
                [tap] => past(tap.delay),
                taps => inputs[k] + taps.iter().map(pull).sum::<f64>(),
            };
            prop_assert_eq!(output.to_bits(), sum.to_bits(), "cycle {}", k);
        }
    }
}
