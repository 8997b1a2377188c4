//! Two vibrations too far apart for one Vibration Guard: the guard on one of them, a band-stop filter of the axis list on
//! the other.
//!
//! A FIR filter cannot be combined with the guard on one axis, a standard filter of the list can. Together they leave
//! the product of their separate residuals: that of the impulses of the guard, and the magnitude of the filter response
//! at the frequency.

use super::task::{Task, command};
use crate::table::number;
use kontur_filters::analysis::tuning::{Choice, VibrationBand};
use kontur_filters::iir::prototype::Prototype;
use kontur_filters::iir::{AxisFilter, FilterConfig, FilterKind};
use kontur_filters::response::Angle;
use kontur_filters::stage::Stage as _;

/// Order of the band-stop filter: flat enough for some percent of uncertainty.
const ORDER: u32 = 2;
/// Number of frequencies of a band at which the product is evaluated.
const STEPS: u32 = 40;

/// Guard and filter with their residual.
struct Pair {
    guard: Choice,
    stop: FilterConfig,
    delay_cycles: f64,
    /// Worst residual over the band of the guard and over that of the filter.
    left: [f64; 2],
}

/// The band of some estimates, and the highest quality of a band-stop around it.
fn stop_of(band: VibrationBand) -> FilterConfig {
    let f_hz = (100.0 * (band.low_hz * band.high_hz).sqrt()).round() / 100.0;
    // the edges of the stop band are two and a half times as far apart as the frequencies
    let q = f_hz / (2.5 * (band.high_hz - band.low_hz)).max(0.25 * f_hz);
    FilterConfig {
        kind: FilterKind::BandStop,
        prototype: Prototype::Butterworth,
        order: ORDER,
        f_hz,
        q: (10.0 * q.clamp(1.0, 10.0)).round() / 10.0,
        ..FilterConfig::default()
    }
}

fn pair(task: &Task, on_guard: VibrationBand, on_stop: VibrationBand) -> Option<Pair> {
    let stop = stop_of(on_stop);
    let filter = AxisFilter::design(&stop, task.cycle).0?;
    let over = |band: VibrationBand, choice: &Choice| {
        let width = band.high_hz - band.low_hz;
        (0..=STEPS)
            .map(|i| band.low_hz + width * f64::from(i) / f64::from(STEPS))
            .map(|f| {
                let guard = task.left_of(choice, (f, band.damping)).unwrap_or(1.0);
                guard * filter.response(Angle::of(f, task.cycle)).magnitude()
            })
            .fold(0.0, f64::max)
    };
    let pairs = (1..=4).filter_map(|mode| {
        let guard = on_guard.best(mode, task.cycle)?;
        let left = [over(on_guard, &guard), over(on_stop, &guard)];
        Some(Pair { guard, stop, delay_cycles: filter.delay_cycles() + guard.delay_cycles, left })
    });
    // the shortest kernel of those within the limit, otherwise the smallest residual
    pairs.reduce(|a, b| {
        let [wa, wb] = [&a, &b].map(|p| p.left[0].max(p.left[1]));
        let [ka, kb] = [wa, wb].map(|w| w <= task.limit_ratio);
        let better = match (ka, kb) {
            (true, true) => b.guard.corner_error_s < a.guard.corner_error_s,
            (false, false) => wb < wa,
            (_, keeps) => keeps,
        };
        if better { b } else { a }
    })
}

/// The answer for frequencies that fall into two groups, `None` if they do not.
pub(super) fn answer(task: &Task) -> Option<String> {
    let mut bands: Vec<(f64, f64)> = task.bands_hz.clone();
    bands.sort_by(|a, b| a.0.total_cmp(&b.0));
    let gap = |i: &usize| bands[i + 1].0 / bands[*i].1;
    let widest = (0..bands.len().checked_sub(1)?).max_by(|a, b| gap(a).total_cmp(&gap(b)))?;
    let group = |part: &[(f64, f64)]| VibrationBand {
        low_hz: part.iter().map(|b| b.0).fold(f64::INFINITY, f64::min),
        high_hz: part.iter().map(|b| b.1).fold(0.0, f64::max),
        damping: task.band.damping,
    };
    let (low, high) = (group(&bands[..=widest]), group(&bands[widest + 1..]));
    let both = [pair(task, low, high), pair(task, high, low)];
    let worst = |p: &Pair| p.left[0].max(p.left[1]);
    let best =
        both.into_iter().flatten().reduce(|a, b| if worst(&b) < worst(&a) { b } else { a })?;
    let keeps = worst(&best) <= task.limit_ratio;
    let FilterConfig { f_hz, q, order, .. } = best.stop;
    let cycle_ms = 1000.0 * task.cycle.seconds();
    let percent = |x: f64| number(100.0 * x, 2);
    let set = best.guard.settings.freq_hz;
    Some(format!(
        "\nproposal  {}\n          filter[0].enable 1, .type 4, .prototype BUTTERWORTH, .order {order}, .fg_f0 {f_hz}, .guete {q}\n          \
         no mode alone keeps {} %: the guard on {} Hz and a band stop of the axis list on {f_hz} Hz leave {} % of the\n          \
         first and {} % of the second{}; delay {} ms. The band stop overshoots: judge it with `kontur response`\n",
        command(&best.guard.settings, &task.tolerance()),
        100.0 * task.limit_ratio,
        number(set, 2),
        percent(best.left[0]),
        percent(best.left[1]),
        if keeps { "" } else { " (more than requested, but the minimum)" },
        number(best.delay_cycles * cycle_ms, 1),
    ))
}
