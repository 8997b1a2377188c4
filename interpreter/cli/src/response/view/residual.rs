//! Residual vibration after a shaper, over the real natural frequency of the machine.
//!
//! The vendor's table normalises the set frequency by the real one, its worked example the real one by the set one;
//! table and picture show both.

use super::super::curve::Curve;
use super::answer::{Answer, cycle_text, spread};
use crate::Error;
use crate::args::ResponseArgs;
use crate::chart::plot::Plot;
use crate::chart::scale::Scale;
use crate::chart::view::{Line, Points, View};
use crate::table::{Cell, Table};
use kontur_filters::response::{SensitivityBand, residual_vibration_ratio};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;

const STEPS: u32 = 600;
/// The vendor's limit of the residual vibration.
const LIMIT_RATIO: f64 = 0.05;

pub(super) fn view(
    args: &ResponseArgs,
    curves: &[Curve],
    cycle: CycleTime,
) -> Result<Answer, Error> {
    if let Some(curve) = curves.iter().find(|curve| curve.has_filters) {
        return Err(Error::Usage(format!(
            "--residual: {} contains standard filters, which have no last impulse; use --guard, --fir, --hsc-mean or --hsc-novib",
            curve.label
        )));
    }
    let mut table = Table::new(&[
        "curve",
        "damping",
        "f_set_hz",
        "f_real_hz",
        "f_set_over_f_real",
        "f_real_over_f_set",
        "residual_ratio",
    ]);
    let all_set = curves.iter().all(|curve| curve.guard.is_some());
    let (mut legend, mut real, mut inverse, mut hertz) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for curve in curves {
        let set_hz = curve.guard.map(|guard| guard.freq_hz);
        let own = curve.guard.map_or(VibGuardSettings::default().damping, |guard| guard.damping);
        let dampings = args.damping.as_ref().map_or_else(|| vec![own], |d| d.0.clone());
        let impulses = curve.shaping.kernel().impulses(cycle);
        let range = args.range.unwrap_or(set_hz.map_or((1.0, 100.0), |f| (0.5 * f, 2.0 * f)));
        for damping in dampings {
            if !(0.0..1.0).contains(&damping) {
                return Err(Error::Usage(format!("--damping {damping}: 0 to below 1 expected")));
            }
            let series = legend.len();
            let band = set_hz.and_then(|f| SensitivityBand::of(&impulses, f, damping, LIMIT_RATIO));
            legend.push(name(curve, damping, band));
            let mut lines = [Vec::new(), Vec::new(), Vec::new()];
            for f_hz in spread(range, STEPS) {
                let ratio = residual_vibration_ratio(&impulses, f_hz, damping);
                let (over_real, over_set) =
                    set_hz.map_or((f64::NAN, f64::NAN), |set| (set / f_hz, f_hz / set));
                table.push(vec![
                    Cell::Word(curve.label.clone()),
                    Cell::Given(damping),
                    set_hz.map_or(Cell::NOTHING, Cell::Given),
                    Cell::Number(f_hz, 6),
                    Cell::Number(over_real, 6),
                    Cell::Number(over_set, 6),
                    Cell::Number(ratio, 9),
                ]);
                lines[0].push([100.0 * (over_real - 1.0), 100.0 * ratio]);
                lines[1].push([100.0 * (over_set - 1.0), 100.0 * ratio]);
                lines[2].push([f_hz, 100.0 * ratio]);
            }
            let [a, b, c] = lines.map(|points| Line::series(series, points));
            inverse.push(a);
            real.push(b);
            hertz.push(c);
        }
    }
    let panel = |title: &str, x: Scale, top: f64, lines| View {
        title: title.to_owned(),
        x,
        y: Scale::linear("residual in %", (0.0, top)),
        lines,
        levels: vec![100.0 * LIMIT_RATIO],
        ..View::default()
    };
    let ends = |lines: &[Line<Points>]| {
        let points = lines.iter().flat_map(|l| &l.points);
        points.fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p[0]), high.max(p[0])))
    };
    let deviation = (-40.0, 60.0);
    let panels = if all_set {
        vec![
            panel(
                "Residual over f_set / f_real - 1",
                Scale::linear("f_set / f_real - 1 in %", deviation),
                20.0,
                inverse,
            ),
            panel(
                "Residual over f_real / f_set - 1",
                Scale::linear("f_real / f_set - 1 in %", deviation),
                20.0,
                real,
            ),
        ]
    } else {
        let x = Scale::logarithmic("real frequency in Hz", ends(&hertz));
        vec![panel("Residual over the real natural frequency", x, 105.0, hertz)]
    };
    let plot = Plot {
        title: "Residual vibration".to_owned(),
        subtitle: format!("{}; dashed: 5 %; 100 %: the unshaped setpoint", cycle_text(cycle)),
        legend,
        columns: 1,
        row_height: if all_set { 330.0 } else { 480.0 },
        panels,
    };
    Ok(Answer { table, plot })
}

/// Name with the permitted deviations for 5 %, by both conventions.
fn name(curve: &Curve, damping: f64, band: Option<SensitivityBand>) -> String {
    let percent = |(low, high): (f64, f64)| format!("{:+.1}/{:+.1} %", 100.0 * low, 100.0 * high);
    let limits = band.map_or_else(String::new, |band| {
        format!(
            "; 5 %: {} set/real, {} real/set",
            percent(band.set_over_real()),
            percent(band.real_over_set())
        )
    });
    let own = curve.guard.is_some_and(|guard| (guard.damping - damping).abs() < 1e-12);
    let machine = if own { String::new() } else { format!(", machine {damping}") };
    format!("{}{machine}{limits}", curve.label)
}
