//! Pictures of curves: panels with linear or logarithmic axes, one legend.

use super::svg::{COLOURS, FAINT, INK, Panel, Stroke, Svg, ticks};
use std::borrow::Cow;

const WIDTH: f64 = 1100.0;
const MARGIN: f64 = 70.0;
const GAP: f64 = 64.0;
const GRID: &str = "#e9ecef";
/// Names longer than this get a line of the legend for themselves.
const LONG_NAME: usize = 66;
/// Dashes tell curves apart when the colours are used up.
const DASHES: [&str; 3] = ["", "7 4", "2 3"];
/// Part of the distance of two places that the points of the series at one of them take.
const DODGE: f64 = 0.5;
/// Dashes of a curve that covers another one.
const OVER: &str = "8 8";

/// A picture.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plot {
    /// Headline.
    pub(crate) title: String,
    /// One line below it.
    pub(crate) subtitle: String,
    /// Names of the series, in their order.
    pub(crate) legend: Vec<String>,
    /// Panels side by side in rows of this many.
    pub(crate) columns: usize,
    /// Height of a row of panels in pixels.
    pub(crate) row_height: f64,
    /// The panels, row by row.
    pub(crate) panels: Vec<Diagram>,
}

/// One panel.
#[derive(Clone, Debug)]
pub(crate) struct Diagram {
    pub(crate) title: String,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
    /// Both directions have the same scale.
    pub(crate) equal: bool,
    pub(crate) lines: Vec<Line>,
    /// Heights of faint horizontal lines.
    pub(crate) levels: Vec<f64>,
}

/// One direction of a panel.
#[derive(Clone, Debug)]
pub(crate) struct Scale {
    pub(crate) label: Cow<'static, str>,
    pub(crate) range: (f64, f64),
    pub(crate) logarithmic: bool,
    /// Names of the places 0, 1, 2, ... of a direction that is no quantity: nothing lies between them.
    pub(crate) categories: Vec<String>,
}

impl Scale {
    /// A linear scale.
    pub(crate) fn linear(label: impl Into<Cow<'static, str>>, range: (f64, f64)) -> Self {
        Self { label: label.into(), range, logarithmic: false, categories: Vec::new() }
    }

    /// A logarithmic scale; both ends are above 0.
    pub(crate) fn logarithmic(label: impl Into<Cow<'static, str>>, range: (f64, f64)) -> Self {
        Self { logarithmic: true, ..Self::linear(label, range) }
    }

    /// Named places side by side.
    pub(crate) fn categories(label: impl Into<Cow<'static, str>>, names: Vec<String>) -> Self {
        let range = (-0.5, names.len() as f64 - 0.5);
        Self { categories: names, ..Self::linear(label, range) }
    }

    /// What is drawn for a value.
    fn drawn(&self, value: f64) -> f64 {
        if self.logarithmic { libm::log10(value) } else { value }
    }

    fn drawn_range(&self) -> (f64, f64) {
        (self.drawn(self.range.0), self.drawn(self.range.1))
    }
}

/// A curve of a series; what is not finite breaks it.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    /// Index into the legend; none: the contour or another thing to compare with.
    pub(crate) series: Option<usize>,
    pub(crate) points: Vec<[f64; 2]>,
}

/// A range around all values with some air, not smaller than `least`.
pub(crate) fn around(values: impl Iterator<Item = f64>, least: f64) -> (f64, f64) {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (-least, least);
    }
    let air = (0.06 * (high - low)).max(0.5 * (least - (high - low)));
    (low - air, high + air)
}

impl Plot {
    /// The SVG file.
    pub(crate) fn draw(&self) -> String {
        let mut svg = Svg::new();
        let style = format!("fill=\"{INK}\" font-size=\"20\" font-weight=\"700\"");
        svg.text([MARGIN, 36.0], "start", &style, &self.title);
        let style = format!("fill=\"{FAINT}\"");
        svg.text([MARGIN, 58.0], "start", &style, &self.subtitle);
        let columns = self.columns.max(1);
        let width =
            (WIDTH - MARGIN - 28.0 - GAP * (columns as f64 - 1.0)) / (columns as f64).max(1.0);
        for (i, diagram) in self.panels.iter().enumerate() {
            let (row, column) = (i / columns, i % columns);
            let panel = Panel {
                left: MARGIN + column as f64 * (width + GAP),
                top: 100.0 + row as f64 * self.row_height,
                width,
                height: self.row_height - 70.0,
                x: diagram.x.drawn_range(),
                y: diagram.y.drawn_range(),
            };
            let panel = if diagram.equal { panel.equal_scale() } else { panel };
            diagram.draw(&mut svg, &panel);
        }
        let rows = self.panels.len().div_ceil(columns);
        let top = 100.0 + rows as f64 * self.row_height;
        let long = self.legend.iter().any(|name| name.chars().count() > LONG_NAME);
        let per_column = self.legend.len().div_ceil(if long { 1 } else { 2 });
        for (i, name) in self.legend.iter().enumerate() {
            let x = MARGIN + if i < per_column { 0.0 } else { 520.0 };
            let y = top + 20.0 * (i % per_column.max(1)) as f64;
            svg.line([x, y - 4.0], [x + 30.0, y - 4.0], stroke(i, 2.2));
            svg.text([x + 38.0, y], "start", &format!("fill=\"{INK}\""), name);
        }
        svg.finish(WIDTH, top + 20.0 * per_column as f64 + 10.0)
    }
}

impl Diagram {
    fn draw(&self, svg: &mut Svg, panel: &Panel) {
        // the frame and the other direction; the ticks of this one follow
        let flat = Panel { x: (0.0, 0.0), ..*panel };
        if self.x.logarithmic {
            svg.axes(&flat, &self.title, &self.x.label, &self.y.label);
            decades(svg, panel, self.x.range);
        } else if self.x.categories.is_empty() {
            svg.axes(panel, &self.title, &self.x.label, &self.y.label);
        } else {
            svg.axes(&flat, &self.title, &self.x.label, &self.y.label);
            self.places(svg, panel);
            return;
        }
        svg.clip(panel);
        for &level in &self.levels {
            let ends = [self.x.range.0, self.x.range.1].map(|x| [self.x.drawn(x), level]);
            let faint = Stroke { colour: FAINT, width: 1.2, dash: "5 4" };
            svg.curve(panel, ends.into_iter(), faint);
        }
        let per_px = (panel.y.1 - panel.y.0) / panel.height;
        for (i, line) in self.lines.iter().enumerate() {
            let reference = Stroke { colour: "#ced4da", width: 5.0, dash: "" };
            let mut stroke = line.series.map_or(reference, |series| stroke(series, 1.8));
            // what lies on an earlier curve leaves it visible
            if self.lines[..i].iter().any(|l| self.covers(line, l, 0.5 * per_px)) {
                stroke.dash = OVER;
            }
            for part in line.points.split(|p| !p.iter().all(|v| v.is_finite())) {
                let points = part.iter().map(|p| [self.x.drawn(p[0]), self.y.drawn(p[1])]);
                svg.curve(panel, points, stroke);
            }
        }
        svg.end_group();
    }

    /// Places with names and, side by side, a point of every series.
    fn places(&self, svg: &mut Svg, panel: &Panel) {
        let style = format!("fill=\"{FAINT}\" font-size=\"11\"");
        for (place, name) in (0_u32..).zip(&self.x.categories) {
            let [x, bottom] = panel.at([f64::from(place), panel.y.0]);
            svg.text([x, bottom + 15.0], "middle", &style, name);
        }
        let step = DODGE / (self.lines.len() as f64).max(1.0);
        for (number, line) in (0_u32..).zip(&self.lines) {
            let aside = step * (f64::from(number) - 0.5 * (self.lines.len() as f64 - 1.0));
            let stroke = line.series.map_or(FAINT, |series| stroke(series, 1.0).colour);
            for point in line.points.iter().filter(|p| p[1].is_finite()) {
                let foot = panel.at([point[0] + aside, panel.y.0.max(0.0)]);
                let at = panel.at([point[0] + aside, self.y.drawn(point[1])]);
                svg.line(foot, at, Stroke { colour: stroke, width: 1.4, dash: "" });
                svg.dot(at, 4.0, stroke);
            }
        }
    }

    /// Two series have the same points, but for `tolerance` upwards.
    fn covers(&self, line: &Line, other: &Line, tolerance: f64) -> bool {
        let same = |(a, b): (&[f64; 2], &[f64; 2])| {
            a[0].to_bits() == b[0].to_bits()
                && (self.y.drawn(a[1]) - self.y.drawn(b[1])).abs() <= tolerance
        };
        line.series.is_some()
            && other.series.is_some()
            && line.points.len() == other.points.len()
            && line.points.iter().zip(&other.points).all(same)
    }
}

fn stroke(series: usize, width: f64) -> Stroke<'static> {
    let dash = DASHES[series / COLOURS.len() % DASHES.len()];
    Stroke { colour: COLOURS[series % COLOURS.len()], width, dash }
}

/// Grid lines at 1 to 9 times the powers of ten, numbers at 1, 2 and 5; over less than a decade round numbers.
fn decades(svg: &mut Svg, panel: &Panel, (low, high): (f64, f64)) {
    let bottom = panel.top + panel.height;
    let style = format!("fill=\"{FAINT}\" font-size=\"11\"");
    let mut mark = |value: f64, named: bool| {
        let x = panel.at([libm::log10(value), panel.y.0])[0];
        let grid = Stroke { colour: GRID, width: 1.0, dash: "" };
        svg.line([x, panel.top], [x, bottom], grid);
        if named {
            svg.text([x, bottom + 15.0], "middle", &style, &format!("{value}"));
        }
    };
    if high < 10.0 * low {
        let (values, decimals) = ticks((low, high), panel.width / 90.0);
        let scale = libm::pow(10.0, decimals as f64);
        for value in values {
            mark((value * scale).round() / scale, true);
        }
        return;
    }
    let first = libm::floor(libm::log10(low));
    let wide = high > 1e4 * low;
    for decade in 0..12 {
        for step in 1..10 {
            let power = first + f64::from(decade);
            // divided for negative powers: 0.2 and not 0.2000000000000001
            let value = if power < 0.0 {
                f64::from(step) / libm::pow(10.0, -power)
            } else {
                f64::from(step) * libm::pow(10.0, power)
            };
            if value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9) {
                mark(value, step == 1 || (!wide && matches!(step, 2 | 5)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_have_air_and_a_least_size() {
        assert_eq!(around([1.0, 2.0].into_iter(), 0.1), (0.94, 2.06));
        assert_eq!(around([1.0, f64::NAN, 1.0].into_iter(), 2.0), (0.0, 2.0));
        assert_eq!(around(std::iter::empty(), 1.0), (-1.0, 1.0));
    }

    #[test]
    fn curves_break_at_what_is_no_number() {
        let line = Line {
            series: Some(0),
            points: vec![[1.0, 0.0], [10.0, 1.0], [20.0, f64::NAN], [50.0, 1.0], [100.0, 0.0]],
        };
        let diagram = Diagram {
            title: "a".to_owned(),
            x: Scale::logarithmic("Hz", (1.0, 100.0)),
            y: Scale::linear("", (0.0, 1.0)),
            equal: false,
            lines: vec![line],
            levels: vec![0.5],
        };
        let plot = Plot {
            columns: 1,
            row_height: 300.0,
            legend: vec!["one".to_owned()],
            panels: vec![diagram],
            ..Plot::default()
        };
        let svg = plot.draw();
        let paths: Vec<&str> = svg.lines().filter(|l| l.starts_with("<path")).collect();
        assert_eq!(paths.len(), 3, "a level and two parts");
        for name in [">1<", ">2<", ">50<", ">100<", ">one<"] {
            assert!(svg.contains(name), "{name}");
        }
        assert!(!svg.contains("NaN"));
    }

    /// Between two modes there is nothing: points with names, beside each other where several series have one.
    #[test]
    fn categories_are_points() {
        let line =
            |series, y| Line { series: Some(series), points: vec![[0.0, y], [1.0, 2.0 * y]] };
        let names = vec!["HSC".to_owned(), "TRAPEZ".to_owned()];
        let diagram = Diagram {
            title: String::new(),
            x: Scale::categories("type", names),
            y: Scale::linear("s", (0.0, 4.0)),
            equal: false,
            lines: vec![line(0, 1.0), line(1, 1.0)],
            levels: Vec::new(),
        };
        let plot = Plot { columns: 1, row_height: 300.0, panels: vec![diagram], ..Plot::default() };
        let svg = plot.draw();
        let dots: Vec<&str> = svg.lines().filter(|l| l.starts_with("<circle")).collect();
        assert_eq!(dots.len(), 4);
        assert!((1..4).all(|i| {
            dots[..i].iter().all(|d| d.split(" cy").next() != dots[i].split(" cy").next())
        }));
        assert!(svg.contains(">HSC<") && svg.contains(">TRAPEZ<") && svg.contains(">type<"));
        assert!(!svg.contains("<path"));
    }

    #[test]
    fn a_curve_that_covers_another_is_dashed() {
        let line = |series, y| Line { series: Some(series), points: vec![[0.0, 0.0], [1.0, y]] };
        let diagram = Diagram {
            title: String::new(),
            x: Scale::linear("", (0.0, 1.0)),
            y: Scale::linear("", (0.0, 1.0)),
            equal: false,
            // a panel of 230 px: half a pixel is 0.0022
            lines: vec![line(0, 0.5), line(1, 0.51), line(2, 0.501)],
            levels: Vec::new(),
        };
        let svg = Plot { columns: 1, row_height: 300.0, panels: vec![diagram], ..Plot::default() };
        let svg = svg.draw();
        let dashed: Vec<&str> = svg.lines().filter(|l| l.contains("stroke-dasharray")).collect();
        assert_eq!(dashed.len(), 1);
        assert!(dashed[0].contains(COLOURS[2]), "{dashed:?}");
    }
}
