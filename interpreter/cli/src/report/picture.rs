//! The static picture: contour, a close-up of its worst corner or of the largest difference of its passes, path speed
//! and deviations over time.

use super::drawn::Drawn;
use super::recording::Recording;
use super::shown::{Shown, Source};
use super::track::Point;
use super::views::{self, Group, VISIBLE_MM};
use crate::chart::scale::Scale;
use crate::chart::style::{INK, Style};
use crate::chart::svg::{Font, Panel, Svg};
use crate::chart::view::{Mark, View};
use kontur_interpreter::source::text::beginning;

const WIDTH: f64 = 1200.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 1172.0;
/// Number of set points that are compared with the first pass.
const MOST_COMPARED: usize = 2000;
/// Distance in mm up to which the picture does not mention points of a long contour that are left out.
const COARSE_MM: f64 = 0.01;
/// Draws one or several runs.
pub(super) fn draw(runs: &[Drawn]) -> String {
    let mut svg = Svg::new();
    let groups = views::groups(runs);
    head(&mut svg, runs);
    let plane = views::plane(runs);
    let visible = |p: &Point| p.error > VISIBLE_MM;
    let worst = worst(runs).filter(visible);
    let look = worst.or_else(|| farthest(&drawn(runs), &groups, plane).filter(visible));
    let contour_width = if look.is_some() { 590.0 } else { RIGHT - LEFT };
    let panel = Panel {
        left: LEFT,
        top: 100.0,
        width: contour_width,
        height: 450.0,
        x: extent(runs, plane[0]),
        y: extent(runs, plane[1]),
    };
    let panel = panel.equal_scale();
    let scales = |p: &Panel| {
        let [x, y] = plane.map(|i| axis_label(&runs[0].recording, i));
        [Scale::linear(x, p.x), Scale::linear(y, p.y)]
    };
    let width = panel.width;
    let whole = views::contour(runs, &groups, "Contour", scales(&panel));
    whole.draw_from(&mut svg, &panel, |source| views::points(source, runs, plane, width));
    if let Some(look) = look {
        let zoom = zoom_panel(&look, plane, 0.2 * (panel.x.1 - panel.x.0));
        let (a, b) = (panel.at([zoom.x.0, zoom.y.1]), panel.at([zoom.x.1, zoom.y.0]));
        let title = if worst.is_some() { "Largest contour error" } else { "Largest difference" };
        let close = views::contour(runs, &groups, title, scales(&zoom));
        close.draw_from(&mut svg, &zoom, |source| views::points(source, runs, plane, width));
        let size = [(b[0] - a[0]).max(4.0), (b[1] - a[1]).max(4.0)];
        let ink = INK.light;
        svg.clip(&panel);
        svg.rect(a, size, &format!("fill=\"{ink}\" fill-opacity=\"0.05\" stroke=\"{ink}\""));
        svg.end_group();
    }
    let top = legend(&mut svg, &groups, 608.0);
    let bottom = strips(&mut svg, runs, &groups, top + 12.0);
    svg.finish(WIDTH, bottom)
}

fn head(svg: &mut Svg, runs: &[Drawn]) {
    let title = match runs {
        [one] => one.summary.program.clone(),
        several => {
            several.iter().map(|r| r.summary.program.as_str()).collect::<Vec<_>>().join("  ·  ")
        }
    };
    svg.text([LEFT, 36.0], Font::HEAD, &beginning(&title));
    let mut facts = Vec::new();
    if let Some(s) = runs.first().map(|r| &r.summary) {
        facts.push(format!("machine {}", s.machine));
        facts.push(format!("cycle {} ms", f64::from(s.cycle_us) / 1000.0));
    }
    if let [Drawn { summary: s, .. }] = runs {
        facts.push(format!("{:.3} s", s.duration_s));
        facts.push(format!("path {:.3} mm", s.path_length_mm));
        if let Some(e) = s.max_contour_error.as_ref().filter(|e| e.mm > VISIBLE_MM) {
            facts.push(format!("contour error at most {:.4} mm, line {}", e.mm, e.line));
        }
    }
    let within_mm = runs.iter().map(|r| r.recording.within_mm()).fold(0.0, f64::max);
    if within_mm > COARSE_MM {
        facts.push(format!("contour drawn to within {within_mm:.2} mm"));
    }
    svg.text([LEFT, 58.0], Font::FACTS, &facts.join("  ·  "));
}

fn axis_label(run: &Recording, i: usize) -> String {
    let name = run.plane.get(i).and_then(|&a| run.facts.axes.get(a)).map(|a| a.name.as_str());
    name.map_or_else(String::new, |name| format!("{name} in mm"))
}

/// The range of an axis with a margin.
fn extent(runs: &[Drawn], axis: usize) -> (f64, f64) {
    let (low, high) = views::extent_of(runs, axis).unwrap_or((0.0, 1.0));
    let air = (0.06 * (high - low)).max(1e-3);
    (low - air, high + air)
}

fn worst(runs: &[Drawn]) -> Option<Point> {
    let found = runs.iter().filter_map(|r| r.recording.worst);
    found.max_by(|a, b| a.error.total_cmp(&b.error))
}

/// The set point of a group with the largest distance from the path of the first group, which becomes its error.
fn farthest(runs: &[Vec<Point>], groups: &[Group], [x, y]: [usize; 2]) -> Option<Point> {
    let (first, others) = groups.split_first()?;
    let at = |p: &Point| [p.set[x], p.set[y]];
    let path: Vec<[f64; 2]> = runs[first.run].iter().filter(|p| first.draws(p)).map(at).collect();
    let count = others.iter().flat_map(|g| runs[g.run].iter().filter(|p| g.draws(p))).count();
    let points = others.iter().flat_map(|g| runs[g.run].iter().filter(|p| g.draws(p)));
    let apart = points.step_by(count / MOST_COMPARED + 1).map(|p| {
        let away = path.windows(2).map(|w| from_line(at(p), w[0], w[1]));
        Point { error: away.fold(f64::INFINITY, f64::min), ..*p }
    });
    apart.filter(|p| p.error.is_finite()).max_by(|a, b| a.error.total_cmp(&b.error))
}

/// Distance of a point from the straight segment between two others.
fn from_line(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (way, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = way[0] * way[0] + way[1] * way[1];
    let part = (to[0] * way[0] + to[1] * way[1]) / square;
    let part = if square > 0.0 { part.clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(to[0] - part * way[0], to[1] - part * way[1])
}

/// A window around the worst point: three times its error to either side, but at most `most` mm.
fn zoom_panel(worst: &Point, [x, y]: [usize; 2], most: f64) -> Panel {
    let half = (3.0 * worst.error).min(most);
    let around = |v: f64| (v - half, v + half);
    Panel {
        left: 742.0,
        top: 100.0,
        width: RIGHT - 742.0,
        height: 450.0,
        x: around(worst.set[x]),
        y: around(worst.set[y]),
    }
    .equal_scale()
}

/// The points to draw of every run.
fn drawn(runs: &[Drawn]) -> Vec<Vec<Point>> {
    runs.iter().map(|r| r.recording.points().copied().collect()).collect()
}

/// Draws the legend of the contour; returns its lower end.
fn legend(svg: &mut Svg, groups: &[Group], top: f64) -> f64 {
    let mut entries = vec![
        (Style::programmed(), "programmed"),
        (views::actual(), "actual position (dashed, colour of its set position)"),
    ];
    entries.extend(groups.iter().map(|g| (g.style.wide(2.0), g.label.as_str())));
    let rows = entries.len().div_ceil(2);
    for (i, (style, label)) in entries.into_iter().enumerate() {
        let x = LEFT + if i % 2 == 0 { 0.0 } else { 560.0 };
        let y = top + 20.0 * ((i / 2) as f64);
        svg.line([x, y - 4.0], [x + 26.0, y - 4.0], style);
        svg.text([x + 34.0, y], Font::NAME, label);
    }
    top + 20.0 * rows as f64
}

/// Draws views over time or frequency one below the other; returns the lower end of the picture.
fn strips(svg: &mut Svg, runs: &[Drawn], groups: &[Group], top: f64) -> f64 {
    // a single program: the deviations that AX_DEV bounds, per axis; several: one curve each
    let one = runs.len() == 1;
    let deviates = if one { "dev" } else { "error" };
    let is_flat = |view: &View<Source>| view.y.range.0.abs().max(view.y.range.1.abs()) < 2e-6;
    let wanted = |shown: &Shown| match shown.kind {
        "speed" => true,
        "spectrum" | "spring" => shown.open,
        kind => kind == deviates && !is_flat(&shown.view),
    };
    let mut top = top;
    for mut shown in views::over_time(runs, groups).into_iter().filter(wanted) {
        let panel = Panel {
            left: LEFT,
            top: top + 20.0,
            width: RIGHT - LEFT,
            height: 130.0,
            x: shown.view.x.range,
            y: shown.view.y.range,
        };
        if shown.kind == "speed" || shown.kind == deviates {
            shown.view.stretches = stretches(runs);
        }
        shown
            .view
            .draw_from(svg, &panel, |source| views::points(source, runs, [0, 1], panel.width));
        names(svg, &panel, runs, &shown.view);
        top += 206.0;
    }
    top
}

/// Draws the names of the lines of a view, to the right of its title; with several runs the dashes of the axes, since
/// the colours are those of the contour.
fn names(svg: &mut Svg, panel: &Panel, runs: &[Drawn], view: &View<Source>) {
    let mut entries: Vec<(&str, Style)> = Vec::new();
    for line in &view.lines {
        let axis = match line.points {
            Source::Curve { run, curve, .. } => runs[run].recording.curves[curve].axis,
            Source::Given { axis, .. } | Source::Spring { axis, .. } => Some(axis),
            Source::Contour { .. } => None,
        };
        let Some(axis) = axis.map(|i| runs[0].recording.facts.axes[i].name.as_str()) else {
            continue;
        };
        if entries.iter().all(|(name, _)| *name != axis) {
            let style =
                if runs.len() > 1 { Style { tone: &INK, ..line.style } } else { line.style };
            entries.push((axis, style));
        }
    }
    let mut right = RIGHT;
    for (name, style) in entries.into_iter().rev() {
        svg.text([right, panel.top - 9.0], Font::NAME.end(), name);
        let swatch = right - 7.0 * name.chars().count() as f64 - 6.0;
        svg.line([swatch - 26.0, panel.top - 13.0], [swatch, panel.top - 13.0], style);
        right = swatch - 44.0;
    }
}

/// Changes of the program line, if there is a single program.
fn stretches(runs: &[Drawn]) -> Vec<Mark> {
    let [Drawn { recording: run, .. }] = runs else { return Vec::new() };
    let mut starts: Vec<(f64, u32)> = Vec::new();
    for b in &run.buckets {
        if starts.last().is_none_or(|s| s.1 != b.line) {
            starts.push((run.seconds(b.k), b.line));
        }
    }
    let name = |line: u32| if line > 0 { line.to_string() } else { String::new() };
    starts.into_iter().map(|(at, line)| Mark { at, name: name(line) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_are_compared_with_the_path_of_the_first() {
        let point =
            |pass: usize, x: f64, y: f64| Point { pass, set: [x, y, 0.0], ..Point::default() };
        // the corner at (1, 0), and a path that cuts it
        let runs = [vec![
            point(0, 0.0, 0.0),
            point(0, 1.0, 0.0),
            point(0, 1.0, 1.0),
            point(1, 0.5, 0.0),
            point(1, 0.7, 0.2),
            point(1, 1.0, 0.5),
        ]];
        let group = |pass| Group {
            run: 0,
            pass: Some(pass),
            style: Style::series(pass),
            label: String::new(),
        };
        let far = farthest(&runs, &[group(0), group(1)], [0, 1]).unwrap();
        assert!((far.set[0] - 0.7).abs() < 1e-15 && far.pass == 1, "{far:?}");
        assert!((far.error - 0.2).abs() < 1e-15, "{}", far.error);
        assert_eq!(farthest(&runs, &[group(0)], [0, 1]), None);
        // beyond an end the end point counts, and a segment of zero length is a point
        assert!((from_line([4.0, 4.0], [0.0, 0.0], [1.0, 0.0]) - 5.0).abs() < 1e-15);
        assert!((from_line([3.0, 4.0], [0.0, 0.0], [0.0, 0.0]) - 5.0).abs() < 1e-15);
    }
}
