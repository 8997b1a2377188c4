//! The contour at a 90 degree corner passed without slowing down.

use super::super::curve::Curve;
use super::answer::{Answer, cycle_text, labels};
use crate::chart::plot::Plot;
use crate::chart::scale::{Scale, around};
use crate::chart::view::{Line, Points, View};
use crate::error::Error;
use crate::table::{Cell, Table};
use kontur_filters::analysis::corner::CornerPath;
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;

/// More paths than this cannot be distinguished; the picture then shows the error over the order.
const MOST_PATHS: usize = 12;

pub(super) fn view(curves: &[Curve], feed_mm_min: f64, cycle: CycleTime) -> Result<Answer, Error> {
    let speed_mm_s = feed_mm_min / 60.0;
    let mut table = Table::new(&[
        "curve",
        "order",
        "feed_mm_min",
        "contour_error_mm",
        "corner_distance_mm",
        "delay_ms",
    ]);
    let mut paths = Vec::new();
    for curve in curves {
        let path = CornerPath::drive(&curve.shaping, speed_mm_s, cycle).ok_or_else(|| {
            let text = "does not follow its input, so a corner of the path cannot be shown";
            Error::Usage(format!("--corner: {} {text}", curve.label))
        })?;
        table.push(vec![
            Cell::Word(curve.label.clone()),
            curve.order.map_or(Cell::NOTHING, Cell::Given),
            Cell::Given(feed_mm_min),
            Cell::Number(path.contour_error_mm, 9),
            Cell::Number(path.corner_distance_mm, 9),
            Cell::Number(curve.shaping.delay_cycles() * 1000.0 * cycle.seconds(), 6),
        ]);
        paths.push(path);
    }
    let few = curves.len() <= MOST_PATHS;
    let panels = panels(curves, &paths)?;
    let with_errors = || {
        labels(curves)
            .into_iter()
            .zip(&paths)
            .map(|(label, path)| format!("{label}: {:.5} mm", path.contour_error_mm))
            .collect()
    };
    let plot = Plot {
        title: format!("90 degree corner at F{feed_mm_min}"),
        subtitle: format!("constant speed, {}; gray: programmed contour", cycle_text(cycle)),
        legend: if few { with_errors() } else { vec!["contour error".to_owned()] },
        columns: panels.len(),
        row_height: 560.0,
        panels,
    };
    Ok(Answer { table, plot })
}

/// The paths, and the error over the order where filters differ in theirs.
fn panels(curves: &[Curve], paths: &[CornerPath]) -> Result<Vec<View<Points>>, Error> {
    let errors: Option<Vec<[f64; 2]>> = curves
        .iter()
        .zip(paths)
        .map(|(curve, path)| Some([curve.order?, path.contour_error_mm]))
        .collect();
    let over_order = errors.filter(|errors| errors.len() > 2);
    let worst = paths.iter().map(|p| p.contour_error_mm).fold(0.0, f64::max);
    let mut panels = Vec::new();
    let few = curves.len() <= MOST_PATHS;
    if few {
        panels.push(contour(paths, worst));
    }
    if let Some(points) = over_order {
        panels.push(View {
            title: "Contour error over the filter order".to_owned(),
            x: Scale::linear("filter order", around(points.iter().map(|p| p[0]), 2.0)),
            y: Scale::linear(
                "contour error in mm",
                around(points.iter().map(|p| p[1]).chain([0.0]), 1e-6),
            ),
            lines: vec![Line::series(0, points)],
            ..View::default()
        });
    } else if !few {
        let text = format!(
            "--corner: at most {MOST_PATHS} paths in a picture, or filters that differ in their order"
        );
        return Err(Error::Usage(text));
    }
    Ok(panels)
}

/// The paths around the corner, in a window of a few times the error.
fn contour(paths: &[CornerPath], worst: f64) -> View<Points> {
    let reach = (6.0 * worst).max(1e-6);
    let programmed = vec![[-4.0 * reach, 0.0], [0.0, 0.0], [0.0, 4.0 * reach]];
    let mut lines = vec![Line::reference(programmed)];
    lines.extend(
        paths.iter().enumerate().map(|(series, path)| Line::series(series, path.points.clone())),
    );
    View {
        title: "Path around the corner".to_owned(),
        x: Scale::linear("x in mm", (-reach, 0.25 * reach)),
        y: Scale::linear("y in mm", (-0.25 * reach, reach)),
        equal: true,
        lines,
        ..View::default()
    }
}
