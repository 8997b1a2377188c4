//! The response to a step from 0 to 1.

use super::super::curve::Curve;
use super::answer::{Answer, cycle_text, labels};
use crate::chart::plot::Plot;
use crate::chart::scale::{Scale, around};
use crate::chart::view::{Line, View};
use crate::table::{Cell, Table};
use kontur_filters::response::step_response;
use kontur_filters::time::CycleTime;

/// Longest response that is computed, in cycles.
const MOST_CYCLES: usize = 20_000;
/// Cycles before the step.
const BEFORE: i64 = 10;

pub(super) fn view(curves: &[Curve], cycle: CycleTime) -> Answer {
    let all: Vec<Vec<f64>> =
        curves.iter().map(|curve| step_response(&mut curve.shaping.clone(), MOST_CYCLES)).collect();
    let cycles = all.iter().map(|y| settled(y)).max().unwrap_or(0);
    let cycles = (cycles + cycles / 5 + 10).min(MOST_CYCLES);
    let mut table = Table::new(&["curve", "t_s", "output"]);
    let mut lines = Vec::new();
    for (series, (curve, outputs)) in curves.iter().zip(&all).enumerate() {
        let time = |k: i64| k as f64 * cycle.seconds();
        let before = (-BEFORE..0).map(|k| (k, 0.0));
        let after = (0..).zip(outputs[..cycles].iter().copied());
        let mut points = Vec::new();
        for (k, output) in before.chain(after) {
            table.push([
                Cell::Word(curve.label.clone()),
                Cell::Number(time(k), 6),
                Cell::Number(output, 9),
            ]);
            // a set position is held for a cycle
            let held = points.last().map_or(output, |last: &[f64; 2]| last[1]);
            points.extend([[1000.0 * time(k), held], [1000.0 * time(k), output]]);
        }
        lines.push(Line::series(series, points));
    }
    let values = lines.iter().flat_map(|l| &l.points).map(|p| p[1]);
    let y = around(values.chain([0.0, 1.0]), 0.1);
    let end = cycles as f64 * 1000.0 * cycle.seconds();
    let panel = View {
        title: "Step from 0 to 1 at time 0".to_owned(),
        x: Scale::linear("time in ms", (-BEFORE as f64 * 1000.0 * cycle.seconds(), end)),
        y: Scale::linear("output, step = 1", y),
        lines,
        levels: vec![0.0, 1.0],
        ..View::default()
    };
    let plot = Plot {
        title: "Step response".to_owned(),
        subtitle: cycle_text(cycle),
        legend: labels(curves),
        columns: 1,
        row_height: 480.0,
        panels: vec![panel],
    };
    Answer { table, plot }
}

/// Cycles until the response stays within 1 % of the step around its end.
fn settled(outputs: &[f64]) -> usize {
    let end = outputs.last().copied().unwrap_or(0.0);
    outputs.iter().rposition(|y| (y - end).abs() > 0.01).map_or(0, |last| last + 1)
}
