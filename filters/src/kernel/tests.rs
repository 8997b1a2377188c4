use super::*;

fn kernel(taps: &[(u32, f64)]) -> Kernel {
    Kernel::from_taps(taps.iter().map(|&(delay, weight)| Tap { delay, weight })).unwrap()
}

#[test]
fn taps_are_sorted_merged_and_normalised() {
    let k = kernel(&[(4, 1.0), (0, 1.0), (4, 2.0), (7, 0.0)]);
    assert_eq!(k.taps(), [Tap { delay: 0, weight: 0.25 }, Tap { delay: 4, weight: 0.75 }]);
    assert_eq!(k.length(), 4);
    for n in 1..=1000 {
        let k = kernel(&(0..n).map(|i| (i, 1.0 + f64::from(i))).collect::<Vec<_>>());
        let sum = compensated_sum(k.taps().iter().map(|tap| tap.weight));
        assert!((sum - 1.0).abs() <= f64::EPSILON, "{n} taps sum to {sum:e}");
    }
}

#[test]
fn taps_without_a_normalised_form_are_refused() {
    let of = |weights: &[f64]| {
        Kernel::from_taps(weights.iter().zip(0..).map(|(&weight, delay)| Tap { delay, weight }))
    };
    for weights in [&[][..], &[0.0], &[1.0, -1.0], &[-1.0], &[f64::NAN, 1.0], &[f64::INFINITY]] {
        assert_eq!(of(weights), None, "{weights:?}");
    }
}

/// Three taps 1/4, 1/2, 1/4 at 0, 2, 4 cycles: all moments by hand.
#[test]
fn moments() {
    let k = kernel(&[(0, 0.25), (2, 0.5), (4, 0.25)]);
    let moments = [
        (k.delay_cycles(), 2.0),
        (k.m1_cycles(), 0.5),
        (k.m2_before_cycles2(), 1.0),
        (k.m2_after_cycles2(), 1.0),
        (k.variance_cycles2(), 2.0),
    ];
    for (is, want) in moments {
        assert_eq!(is.to_bits(), f64::to_bits(want));
    }
    // Unsymmetric: 3/4 at 0, 1/4 at 4, mean 1: before = 1/4 * 3^2, after = 3/4 * 1^2.
    let k = kernel(&[(0, 3.0), (4, 1.0)]);
    assert_eq!(k.m2_before_cycles2().to_bits(), f64::to_bits(2.25));
    assert_eq!(k.m2_after_cycles2().to_bits(), f64::to_bits(0.75));
    assert_eq!(k.m1_cycles().to_bits(), f64::to_bits(0.75));
}

#[test]
fn convolution_and_reversal() {
    let pair = kernel(&[(0, 0.75), (3, 0.25)]);
    let twice = pair.convolve(&pair);
    assert_eq!(twice, kernel(&[(0, 0.5625), (3, 0.375), (6, 0.0625)]));
    assert_eq!(pair.reversed(), kernel(&[(0, 0.25), (3, 0.75)]));
    assert_eq!(pair.convolve(&Kernel::identity()), pair);
    let symmetric = pair.convolve(&pair.reversed());
    assert_eq!(symmetric, symmetric.reversed());
    assert!(Kernel::identity().is_identity() && !Kernel::delay(1).is_identity());
}

#[test]
fn a_single_late_tap_is_a_delay_bit_for_bit() {
    let mut filter = KernelFilter::new(Arc::new(Kernel::delay(3)), 0.1);
    let inputs: Vec<f64> = (1..40).map(|i| 1000.0 / f64::from(i)).collect();
    let outputs: Vec<f64> = inputs.iter().map(|&x| filter.step(x)).collect();
    assert_eq!(outputs[..3], [0.1; 3]);
    assert_eq!(outputs[3..], inputs[..inputs.len() - 3]);
}

#[test]
fn the_identity_returns_every_bit() {
    let mut filter = KernelFilter::new(Arc::new(Kernel::identity()), 0.0);
    for x in [-0.0, 1.0e-310, 1000.123456789, -3.0e300] {
        assert_eq!(filter.step(x).to_bits(), f64::to_bits(x));
        assert!(filter.settled());
    }
}

#[test]
fn a_change_waits_until_neither_kernel_remembers_motion() {
    let long = Arc::new(kernel(&[(0, 0.5), (9, 0.5)]));
    let mut filter = KernelFilter::new(Arc::new(Kernel::identity()), 0.0);
    let mut last = 0.0;
    for i in 1..=20 {
        last = filter.step(f64::from(i) * 0.1);
    }
    let refused = filter.set_kernel(Arc::clone(&long));
    assert_eq!(refused, Err(SwitchWhileMoving { rest_cycles: 1, needed_cycles: 10 }));
    for _ in 1..10 {
        assert_eq!(filter.step(last).to_bits(), last.to_bits());
    }
    filter.set_kernel(Arc::clone(&long)).unwrap();
    assert!(filter.settled());
    assert_eq!(filter.step(last).to_bits(), last.to_bits());
    // Back again: the longer of the two decides.
    let moved = last + 1.0;
    for _ in 0..9 {
        assert!((filter.step(moved) - (last + 0.5)).abs() < 1e-15);
        assert!(filter.set_kernel(Arc::new(Kernel::identity())).is_err());
    }
    assert_eq!(filter.step(moved).to_bits(), moved.to_bits());
    filter.set_kernel(Arc::new(Kernel::identity())).unwrap();
}
