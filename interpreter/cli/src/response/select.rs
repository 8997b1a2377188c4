//! From the arguments to the curves.

use super::curve::Curve;
use super::describe;
use crate::args::values::Numbers;
use crate::args::{FILTER_TYPES, PROTOTYPES, ResponseArgs};
use crate::console::Console;
use crate::error::Error;
use crate::table::number;
use kontur_filters::fir::{FirConfig, FirKind, MAX_DELAY_ORDER, MAX_ORDER};
use kontur_filters::hsc::{HscConfig, HscKind};
use kontur_filters::iir::transform::band_edges_hz;
use kontur_filters::iir::{AxisFilter, FilterConfig, FilterKind};
use kontur_filters::issue::{Effect, FilterIssue};
use kontur_filters::kernel::Kernel;
use kontur_filters::shaping::Shaping;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_interpreter::diag::Severity;
use std::sync::Arc;

/// All curves in the order filter, guard, fir, hsc, axis, and their cycle.
pub(super) fn curves(
    args: &ResponseArgs,
    console: &mut Console,
) -> Result<(Vec<Curve>, CycleTime), Error> {
    let (axes, cycle) = if args.axis.is_empty() {
        let cycle = args.cycle_us.map_or(Some(CycleTime::DEFAULT), CycleTime::from_us);
        let cycle = cycle.ok_or_else(|| Error::Usage("--cycle-us: 100 to 20000".to_owned()))?;
        (Vec::new(), cycle)
    } else {
        super::axis::curves(args, console)?
    };
    let mut found = Found { curves: Vec::new(), cycle, console };
    found.filters(args)?;
    for text in &args.guard {
        found.guard(text)?;
    }
    for text in &args.fir {
        found.fir(text)?;
    }
    for order in values(args.hsc_mean.as_ref()) {
        let order = whole(order, "--hsc-mean")?;
        found.hsc(HscKind::Mean, order, 30.0, format!("HSC mean {order}"))?;
    }
    for f_hz in values(args.hsc_novib.as_ref()) {
        found.hsc(HscKind::NoVib, 1, f_hz, format!("HSC NoVib {f_hz} Hz"))?;
    }
    let mut curves = found.curves;
    curves.extend(axes);
    Ok((curves, cycle))
}

fn values(numbers: Option<&Numbers>) -> impl Iterator<Item = f64> + '_ {
    numbers.into_iter().flat_map(|n| n.0.iter().copied())
}

/// A whole number of the range of a list parameter.
fn whole(value: f64, option: &str) -> Result<u32, Error> {
    if value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0 {
        return Ok(value as u32);
    }
    Err(Error::Usage(format!("{option} {value}: a whole number is expected")))
}

/// The curves so far.
struct Found<'a> {
    curves: Vec<Curve>,
    cycle: CycleTime,
    console: &'a mut Console,
}

impl Found<'_> {
    /// Refuses a filter that is off, and reports notes.
    fn report(&mut self, label: &str, issues: &[FilterIssue]) -> Result<(), Error> {
        for issue in issues {
            let text = format!("{label}: {}", describe::issue(issue));
            if issue.effect() == Effect::Off {
                return Err(Error::Usage(text));
            }
            self.console.say(Severity::Note, &text);
        }
        Ok(())
    }

    fn filters(&mut self, args: &ResponseArgs) -> Result<(), Error> {
        let kind_of = |name: &String| FILTER_TYPES.iter().find(|(n, _)| n == name);
        for (name, kind) in args.filter.iter().filter_map(kind_of) {
            for family in families(*kind, args)? {
                let prototypes = if family.lag { &args.prototype[..1] } else { &args.prototype };
                let of = |name: &String| PROTOTYPES.iter().find(|(n, _)| n == name);
                for (prototype_name, prototype) in prototypes.iter().filter_map(of) {
                    let config = FilterConfig { prototype: *prototype, ..family.config };
                    let label = format!("{name}{}", family.label.replace('*', prototype_name));
                    self.filter(&config, label)?;
                }
            }
        }
        Ok(())
    }

    fn filter(&mut self, config: &FilterConfig, label: String) -> Result<(), Error> {
        let (filter, issues) = AxisFilter::design(config, self.cycle);
        self.report(&label, &issues)?;
        let Some(filter) = filter else {
            return Err(Error::Usage(format!("{label}: order 0 switches the filter off")));
        };
        let corrected = issues.iter().any(|issue| issue.effect() == Effect::Corrected);
        let label = if corrected { format!("{label}, corrected") } else { label };
        if matches!(config.kind, FilterKind::BandPass | FilterKind::BandStop) {
            let FilterConfig { f_hz, q, .. } = *config;
            let (low, high) = band_edges_hz(f_hz, q, self.cycle.seconds());
            self.console.say(
                Severity::Note,
                &format!(
                    "{label}: f0 {f_hz} Hz, Q {q}, -3 dB at {} and {} Hz",
                    number(low, 3),
                    number(high, 3)
                ),
            );
        }
        self.curves.push(Curve {
            label,
            shaping: Shaping::new(vec![filter], 0.0),
            guard: None,
            has_filters: true,
            order: None,
        });
        Ok(())
    }

    fn kernel(
        &mut self,
        label: String,
        kernel: Kernel,
        guard: Option<VibGuardSettings>,
        order: Option<f64>,
    ) {
        let mut shaping = Shaping::new(Vec::new(), 0.0);
        // a chain that has never moved accepts any kernel
        let taken = shaping.set_kernel(Some(Arc::new(kernel)));
        debug_assert!(taken.is_ok());
        self.curves.push(Curve { label, shaping, guard, has_filters: false, order });
    }

    fn guard(&mut self, text: &str) -> Result<(), Error> {
        let mut settings = VibGuardSettings::default();
        for (key, value) in pairs(text, "--guard")? {
            match key.to_ascii_uppercase().as_str() {
                "MODE" => {
                    let mode = whole(value, "MODE")?;
                    settings.mode = u8::try_from(mode).unwrap_or(u8::MAX);
                }
                "FREQ" => settings.freq_hz = value,
                "DAMPING" => settings.damping = value,
                _ => return Err(unknown("--guard", key, "MODE, FREQ, DAMPING")),
            }
        }
        let VibGuardSettings { mode, freq_hz, damping } = settings;
        let kernel = settings.kernel(self.cycle).map_err(|e| Error::Usage(e.to_string()))?;
        let label = format!("mode {mode}, {freq_hz} Hz, damping {damping}");
        self.kernel(label, kernel, Some(settings), None);
        Ok(())
    }

    fn fir(&mut self, text: &str) -> Result<(), Error> {
        let (name, rest) = text.split_once(',').unwrap_or((text, ""));
        let kind = match name.trim().to_ascii_uppercase().as_str() {
            "MEAN" => FirKind::MovingAverage,
            "GAUSS" => FirKind::Gauss,
            "SINC" => FirKind::WindowedSinc,
            "DELAY" => FirKind::TimeDelay,
            _ => return Err(unknown("--fir", name, "MEAN, GAUSS, SINC, DELAY")),
        };
        let mut config = FirConfig::new(kind);
        for (key, value) in pairs(rest, "--fir")? {
            match key.to_ascii_uppercase().as_str() {
                "ORDER" => config.order = whole(value, "ORDER")?,
                "ORDER_TIME" => config.order_time_us = whole(value, "ORDER_TIME")?,
                "SHARE" => config.share_ratio = value / 100.0,
                "FCUT" => config.fcut_hz = value,
                "QUALITY" => config.quality = value,
                _ => return Err(unknown("--fir", key, "ORDER, ORDER_TIME, SHARE, FCUT, QUALITY")),
            }
        }
        // the limits of the filter apply to the curve: its name states the order in use
        let asked = format!("ORDER={}", config.order);
        let most = if kind == FirKind::TimeDelay { MAX_DELAY_ORDER } else { MAX_ORDER };
        let order = config.order.min(most);
        let label = format!("FIR {}", text.replace(',', " ").to_ascii_uppercase());
        let label = label.replace(&asked, &format!("ORDER={order}"));
        let (kernel, issues) = config.design(self.cycle);
        self.report(&label, &issues)?;
        if let Some(kernel) = kernel {
            let order = (order > 0).then(|| f64::from(order));
            self.kernel(label, kernel, None, order);
        }
        Ok(())
    }

    fn hsc(&mut self, kind: HscKind, order: u32, f_hz: f64, label: String) -> Result<(), Error> {
        let config = HscConfig { kind, order, time_constant_us: 0, f_hz, share_ratio: 1.0 };
        let (kernel, issues) = config.design(self.cycle);
        self.report(&label, &issues)?;
        if let Some(kernel) = kernel {
            let order = (kind == HscKind::Mean).then(|| f64::from(order));
            self.kernel(label, kernel, None, order);
        }
        Ok(())
    }
}

/// A filter without its prototype; `*` in the label is replaced by the name of the prototype.
struct Family {
    config: FilterConfig,
    label: String,
    /// Whether it is a lag or delay, which has no prototype.
    lag: bool,
}

/// All combinations of the values that matter for a kind.
fn families(kind: FilterKind, args: &ResponseArgs) -> Result<Vec<Family>, Error> {
    let mut families = Vec::new();
    let lag = matches!(kind, FilterKind::Pt1 | FilterKind::Pt2 | FilterKind::TimeDelay);
    let band = matches!(kind, FilterKind::BandPass | FilterKind::BandStop);
    let one = [1.0];
    let q = if band { &args.q.0[..] } else { &one[..] };
    for &share in &args.share.0 {
        let part = if share < 100.0 { format!(", share {share} %") } else { String::new() };
        let base = FilterConfig { kind, share_ratio: share / 100.0, ..FilterConfig::default() };
        if lag {
            for &time in &args.time.0 {
                let time_constant_us = whole(time, "--time")?;
                let order = if kind == FilterKind::Pt2 { 2 } else { 1 };
                let config = FilterConfig { order, time_constant_us, ..base };
                let label = format!(", {} ms{part}", time / 1000.0);
                families.push(Family { config, label, lag });
            }
            continue;
        }
        for &order in &args.order.0 {
            let order = whole(order, "--order")?;
            for &f_hz in &args.f0.0 {
                for &q in q {
                    let quality = if band { format!(", Q {q}") } else { String::new() };
                    let config = FilterConfig { order, f_hz, q, ..base };
                    let label = format!(" * {order}, {f_hz} Hz{quality}{part}");
                    families.push(Family { config, label, lag });
                }
            }
        }
    }
    Ok(families)
}

/// `KEY=number` separated by commas.
fn pairs<'a>(text: &'a str, option: &str) -> Result<Vec<(&'a str, f64)>, Error> {
    let mut pairs: Vec<(&str, f64)> = Vec::new();
    for part in text.split(',').filter(|part| !part.trim().is_empty()) {
        let pair = part.split_once('=').and_then(|(key, value)| {
            let value: f64 = value.trim().parse().ok()?;
            value.is_finite().then_some((key.trim(), value))
        });
        let Some(pair) = pair else {
            return Err(Error::Usage(format!("{option}: `{part}`: KEY=number expected")));
        };
        if pairs.iter().any(|(key, _)| key.eq_ignore_ascii_case(pair.0)) {
            return Err(Error::Usage(format!("{option}: {} twice", pair.0)));
        }
        pairs.push(pair);
    }
    Ok(pairs)
}

fn unknown(option: &str, word: &str, known: &str) -> Error {
    Error::Usage(format!("{option}: `{word}` is unknown; use one of {known}"))
}
