//! Vibration Guard kernels against the reference tables and closed forms.

use crate::reference::{assert_close, rows};
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::{VibGuardError, VibGuardSettings};
use std::collections::BTreeMap;

const MS: CycleTime = CycleTime::DEFAULT;

fn kernel(mode: u8, freq_hz: f64, damping: f64) -> Kernel {
    VibGuardSettings { mode, freq_hz, damping }.kernel(MS).unwrap()
}

#[test]
fn kernels_are_those_of_the_reference() {
    let mut references: BTreeMap<(u8, String, String), Vec<(u32, f64)>> = BTreeMap::new();
    for row in rows("vibguard_kernels") {
        let key = (
            row.text("mode").parse().unwrap(),
            row.text("freq_hz").into(),
            row.text("damping").into(),
        );
        let tap = (row.text("tap").parse().unwrap(), row.number("amplitude"));
        references.entry(key).or_default().push(tap);
    }
    for ((mode, freq, damping), taps) in references {
        let kernel = kernel(mode, freq.parse().unwrap(), damping.parse().unwrap());
        let delays: Vec<u32> = kernel.taps().iter().map(|tap| tap.delay).collect();
        let want: Vec<u32> = taps.iter().map(|tap| tap.0).collect();
        assert_eq!(delays, want, "mode {mode}, {freq} Hz, damping {damping}");
        for (tap, (_, amplitude)) in kernel.taps().iter().zip(taps) {
            assert_close(tap.weight, amplitude, 1e-12, &(mode, &freq, &damping, tap));
        }
    }
}

#[test]
fn mode_4_is_symmetric_bit_for_bit() {
    for freq_hz in [1.0, 7.3, 30.0, 40.0, 166.7, 250.0, 333.0, 499.0] {
        for damping in [0.0, 0.05, 0.1, 0.5, 0.9] {
            let Ok(kernel) = (VibGuardSettings { mode: 4, freq_hz, damping }).kernel(MS) else {
                continue;
            };
            assert_eq!(kernel, kernel.reversed());
        }
    }
}

#[test]
fn no_weight_is_negative() {
    for mode in 1..=4 {
        for freq in 1..=480 {
            for damping in 0..=99 {
                let settings = VibGuardSettings {
                    mode,
                    freq_hz: f64::from(freq),
                    damping: f64::from(damping) / 100.0,
                };
                if let Ok(kernel) = settings.kernel(MS) {
                    assert!(!kernel.has_negative_taps(), "{settings:?}");
                }
            }
        }
    }
}

#[test]
fn settings_without_a_kernel() {
    let of = |mode, freq_hz, damping| VibGuardSettings { mode, freq_hz, damping }.kernel(MS);
    for mode in [0, 5, 255] {
        assert_eq!(of(mode, 30.0, 0.1), Err(VibGuardError::Mode { mode }));
    }
    for freq_hz in [0.0, 0.999, -1.0, f64::INFINITY] {
        assert_eq!(of(1, freq_hz, 0.1), Err(VibGuardError::Frequency { freq_hz }));
    }
    assert!(matches!(of(1, f64::NAN, 0.1), Err(VibGuardError::Frequency { .. })));
    for damping in [-0.01, 1.01] {
        assert_eq!(of(1, 30.0, damping), Err(VibGuardError::Damping { damping }));
    }
    assert!(matches!(of(1, 30.0, f64::NAN), Err(VibGuardError::Damping { .. })));
    // The damped period is infinite, half a period is below the cycle, the kernel is too long.
    for (freq_hz, damping) in [(30.0, 1.0), (30.0, 0.995), (600.0, 0.1), (500.1, 0.0)] {
        assert_eq!(of(2, freq_hz, damping), Err(VibGuardError::NotRealisable { freq_hz, damping }));
    }
    let slow = VibGuardSettings { mode: 3, freq_hz: 1.0, damping: 0.0 };
    assert_eq!(slow.kernel(MS).unwrap().length(), 1500);
    let fine = CycleTime::from_us(100).unwrap();
    assert_eq!(slow.kernel(fine).unwrap().length(), 15_000);
    let longer = VibGuardSettings { damping: 0.5, ..slow };
    let refused = VibGuardError::NotRealisable { freq_hz: 1.0, damping: 0.5 };
    assert_eq!(longer.kernel(fine), Err(refused));
    // Half a period of exactly one cycle is the shortest.
    assert_eq!(of(1, 500.0, 0.0).unwrap().length(), 1);
}
