//! Time by which a recording begins before the trace.

use super::signals::{Recorded, Trace, statistics};
use realfft::RealFftPlanner;

/// Golden-section steps for the fraction of a cycle: 2 cycles are reduced to a ten-thousandth.
const GOLDEN_STEPS: usize = 21;
/// Number of cycles by which the correlation may be off.
const SLIDE_CYCLES: usize = 50;
/// A fractional shift is used if it reduces the difference to this share.
const BETTER: f64 = 0.95;
/// A periodic motion correlates at many shifts; those with at least this share of the best correlation are candidates.
const NEAR_BEST: f64 = 0.8;
/// Largest number of candidates.
const CANDIDATES: usize = 32;

/// Cycles by which the recording begins earlier, a whole number unless a fraction fits better.
pub(super) fn find(trace: &Trace, recorded: &[Recorded], cycle_s: f64) -> f64 {
    let misfit = |shift_cycles: f64| -> f64 {
        let pairs = trace.columns.iter().zip(recorded);
        pairs.map(|(a, r)| statistics(&trace.times_s, a, r, shift_cycles * cycle_s).rms).sum()
    };
    let candidates = coarse_shifts(trace, recorded, cycle_s);
    let fits = candidates.iter().map(|shift| (*shift, misfit(*shift)));
    // the first of equally good ones has the best correlation
    let best = fits.reduce(|a, b| if b.1 < a.1 { b } else { a });
    fine_shift(&misfit, best.map_or(0.0, |(shift, _)| shift.round()))
}

/// Median step of the times.
pub(super) fn cycle_of(times_s: &[f64]) -> Option<f64> {
    let mut steps: Vec<f64> = times_s.windows(2).map(|w| w[1] - w[0]).collect();
    if steps.len() < 2 {
        return None;
    }
    let middle = steps.len() / 2;
    let (_, median, _) = steps.select_nth_unstable_by(middle, f64::total_cmp);
    Some(*median).filter(|s| *s > 0.0)
}

/// Differences of a signal sampled at equal steps; missing values count as constant.
fn speeds(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let values: Vec<f64> = values.collect();
    let step = |w: &[f64]| if (w[1] - w[0]).is_finite() { w[1] - w[0] } else { 0.0 };
    values.windows(2).map(step).collect()
}

/// Candidate shifts in cycles by which the recording may begin earlier: where the speeds correlate best over all pairs,
/// and where they correlate nearly as well, best first.
///
/// Both signals of every pair are weighted by their energy, so that a fast axis does not dominate the others.
fn coarse_shifts(trace: &Trace, recorded: &[Recorded], cycle_s: f64) -> Vec<f64> {
    let rows = trace.times_s.len();
    let longest =
        recorded.iter().map(|r| (r.end_s() / cycle_s) as usize + 1).max().unwrap_or_default();
    let length = (rows + longest).next_power_of_two();
    let mut planner = RealFftPlanner::<f64>::new();
    let (forward, back) = (planner.plan_fft_forward(length), planner.plan_fft_inverse(length));
    let mut product = forward.make_output_vec();
    for (column, r) in trace.columns.iter().zip(recorded) {
        let count = (r.end_s() / cycle_s) as usize + 1;
        let b = (0..count).map(|k| r.between(k as f64 * cycle_s).unwrap_or(f64::NAN));
        let signals = [speeds(column.iter().copied()), speeds(b)];
        let energy: f64 = signals.iter().map(|s| s.iter().map(|v| v * v).sum::<f64>()).product();
        if energy <= 0.0 {
            continue;
        }
        let [a, b] = signals.map(|mut signal| {
            signal.resize(length, 0.0);
            let mut spectrum = forward.make_output_vec();
            // both buffers have the lengths required by the plan
            let done = forward.process(&mut signal, &mut spectrum);
            debug_assert!(done.is_ok());
            spectrum
        });
        let weight = 1.0 / libm::sqrt(energy);
        for ((p, a), b) in product.iter_mut().zip(&a).zip(&b) {
            *p += a.conj() * b * weight;
        }
    }
    let mut correlation = back.make_output_vec();
    // the two unpaired lines are real up to rounding
    for edge in [0, product.len() - 1] {
        product[edge].im = 0.0;
    }
    let done = back.process(&mut product, &mut correlation);
    debug_assert!(done.is_ok());
    let highest = correlation.iter().copied().fold(0.0, f64::max);
    let at = |i: usize| correlation[i % length];
    let is_peak = |i: &usize| {
        at(*i) >= NEAR_BEST * highest && at(*i) > at(i + length - 1) && at(*i) >= at(i + 1)
    };
    let mut peaks: Vec<usize> = (0..length).filter(is_peak).collect();
    peaks.sort_by(|a, b| at(*b).total_cmp(&at(*a)));
    peaks.truncate(CANDIDATES);
    let shift = |i: usize| {
        // parabola through the peak and its neighbours
        let (before, after) = (at(i + length - 1), at(i + 1));
        let part = 0.5 * (before - after) / (before - 2.0 * at(i) + after);
        let place = i as f64 + if part.is_finite() { part } else { 0.0 };
        if i > longest { place - length as f64 } else { place }
    };
    peaks.into_iter().map(shift).collect()
}

/// The whole number of cycles with the smallest misfit near another one: a channel that begins during the motion shifts
/// the correlation by some cycles.
fn slide(from: f64, misfit: &impl Fn(f64) -> f64) -> f64 {
    let (mut place, mut least) = (from, misfit(from));
    for _ in 0..SLIDE_CYCLES {
        let [a, b] = [place - 1.0, place + 1.0].map(|shift| (shift, misfit(shift)));
        let (next, at_next) = if b.1 < a.1 { b } else { a };
        if at_next >= least {
            break;
        }
        (place, least) = (next, at_next);
    }
    place
}

/// The shift refined by a fraction of a cycle, if that fits better than the whole number.
fn fine_shift(misfit: &impl Fn(f64) -> f64, whole: f64) -> f64 {
    let whole = slide(whole, misfit);
    // golden section: close to the best fit the misfit has a single minimum
    let ratio = 0.5 * (libm::sqrt(5.0) - 1.0);
    let (mut low, mut high) = (whole - 1.0, whole + 1.0);
    let (mut inner, mut outer) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut at_inner, mut at_outer) = (misfit(inner), misfit(outer));
    for _ in 0..GOLDEN_STEPS {
        if at_inner <= at_outer {
            (high, outer, at_outer) = (outer, inner, at_inner);
            inner = high - ratio * (high - low);
            at_inner = misfit(inner);
        } else {
            (low, inner, at_inner) = (inner, outer, at_outer);
            outer = low + ratio * (high - low);
            at_outer = misfit(outer);
        }
    }
    let between = 0.5 * (low + high);
    let rounded = between.round();
    let best = if misfit(rounded) < misfit(whole) { rounded } else { whole };
    if misfit(between) < BETTER * misfit(best) { between } else { best }
}
