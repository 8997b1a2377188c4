//! Residual vibration after a shaper, over the real natural frequency of the machine.
//!
//! The vendor's table normalises the set frequency by the real one, its worked example the real one by the set one;
//! table and picture show both.

use super::super::curve::Curve;
use super::answer::{Answer, cycle_text, spread};
use crate::args::ResponseArgs;
use crate::chart::plot::Plot;
use crate::chart::scale::Scale;
use crate::chart::view::{Line, Points, View};
use crate::error::Error;
use crate::table::{Cell, Table};
use kontur_filters::response::{SensitivityBand, residual_vibration_ratio};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;

const STEPS: u32 = 600;
/// The vendor's limit of the residual vibration.
const LIMIT_RATIO: f64 = 0.05;

/// The residual vibration of all curves: rows of the table, and lines over each of the three abscissas.
struct Residuals {
    table: Table,
    legend: Vec<String>,
    /// Over `f_set / f_real - 1` in percent.
    over_real: Vec<Line<Points>>,
    /// Over `f_real / f_set - 1` in percent.
    over_set: Vec<Line<Points>>,
    /// Over the real frequency in Hz.
    over_hz: Vec<Line<Points>>,
}

impl Residuals {
    fn new() -> Self {
        let table = Table::new(&[
            "curve",
            "damping",
            "f_set_hz",
            "f_real_hz",
            "f_set_over_f_real",
            "f_real_over_f_set",
            "residual_ratio",
        ]);
        let (over_real, over_set, over_hz) = Default::default();
        Self { table, legend: Vec::new(), over_real, over_set, over_hz }
    }

    /// Adds a curve on a machine with this damping ratio, from one frequency to another in Hz.
    fn add(&mut self, curve: &Curve, damping: f64, range: (f64, f64), cycle: CycleTime) {
        let set_hz = curve.guard.map(|guard| guard.freq_hz);
        let impulses = curve.shaping.kernel().impulses(cycle);
        let series = self.legend.len();
        let band = set_hz.and_then(|f| SensitivityBand::of(&impulses, f, damping, LIMIT_RATIO));
        self.legend.push(name(curve, damping, band));
        let mut lines = [Vec::new(), Vec::new(), Vec::new()];
        for f_hz in spread(range, STEPS) {
            let ratio = residual_vibration_ratio(&impulses, f_hz, damping);
            let (over_real, over_set) =
                set_hz.map_or((f64::NAN, f64::NAN), |set| (set / f_hz, f_hz / set));
            self.table.push(vec![
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
        let [over_real, over_set, over_hz] = lines.map(|points| Line::series(series, points));
        self.over_real.push(over_real);
        self.over_set.push(over_set);
        self.over_hz.push(over_hz);
    }

    /// Both conventions side by side if every curve has a set frequency, otherwise the real frequency.
    fn panels(over: [Vec<Line<Points>>; 3], all_set: bool) -> Vec<View<Points>> {
        let panel = |title: &str, x: Scale, top: f64, lines| View {
            title: title.to_owned(),
            x,
            y: Scale::linear("residual in %", (0.0, top)),
            lines,
            levels: vec![100.0 * LIMIT_RATIO],
            ..View::default()
        };
        let [over_real, over_set, over_hz] = over;
        if all_set {
            let x = |title| Scale::linear(title, (-40.0, 60.0));
            return vec![
                panel(
                    "Residual over f_set / f_real - 1",
                    x("f_set / f_real - 1 in %"),
                    20.0,
                    over_real,
                ),
                panel(
                    "Residual over f_real / f_set - 1",
                    x("f_real / f_set - 1 in %"),
                    20.0,
                    over_set,
                ),
            ];
        }
        let points = over_hz.iter().flat_map(|line| &line.points);
        let ends =
            points.fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p[0]), high.max(p[0])));
        let x = Scale::logarithmic("real frequency in Hz", ends);
        vec![panel("Residual over the real natural frequency", x, 105.0, over_hz)]
    }
}

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
    let mut residuals = Residuals::new();
    for curve in curves {
        let set_hz = curve.guard.map(|guard| guard.freq_hz);
        let own = curve.guard.map_or(VibGuardSettings::default().damping, |guard| guard.damping);
        let dampings = args.damping.as_ref().map_or_else(|| vec![own], |d| d.0.clone());
        let range = args.range.unwrap_or(set_hz.map_or((1.0, 100.0), |f| (0.5 * f, 2.0 * f)));
        for damping in dampings {
            if !(0.0..1.0).contains(&damping) {
                return Err(Error::Usage(format!("--damping {damping}: 0 to below 1 expected")));
            }
            residuals.add(curve, damping, range, cycle);
        }
    }
    let Residuals { table, legend, over_real, over_set, over_hz } = residuals;
    let all_set = curves.iter().all(|curve| curve.guard.is_some());
    let plot = Plot {
        title: "Residual vibration".to_owned(),
        subtitle: format!("{}; dashed: 5 %; 100 %: the unshaped setpoint", cycle_text(cycle)),
        legend,
        columns: 1,
        row_height: if all_set { 330.0 } else { 480.0 },
        panels: Residuals::panels([over_real, over_set, over_hz], all_set),
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
