//! Content of a view, independent of its size: axes, lines, levels, marks.

use super::scale::Scale;
use super::style::{CARD, FAINT, SHADE, Style};
use super::svg::{Font, Panel, Svg};
use serde::Serialize;
use std::borrow::Cow;

/// Share of the distance between two positions that the points of the series at one of them may occupy.
const DODGE: f64 = 0.5;
/// More stretches than this cannot be distinguished.
pub(crate) const MOST_STRETCHES: usize = 60;

/// A view; `S` is the source of the points of a line.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct View<S> {
    pub(crate) title: String,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
    /// Both directions have the same scale.
    pub(crate) equal: bool,
    /// Later lines are drawn over earlier ones.
    pub(crate) lines: Vec<Line<S>>,
    /// Heights of faint horizontal lines.
    pub(crate) levels: Vec<f64>,
    /// Faint vertical lines with names.
    pub(crate) marks: Vec<Mark>,
    /// Named parts of the horizontal direction, up to where the next one begins.
    #[serde(skip)]
    pub(crate) stretches: Vec<Mark>,
}

/// A line of a view.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Line<S> {
    /// Name in the legend of the view; empty if it needs none.
    pub(crate) name: String,
    pub(crate) style: Style,
    pub(crate) points: S,
}

/// A position with a name.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Mark {
    pub(crate) at: f64,
    pub(crate) name: String,
}

/// Points as they are; a value that is not finite breaks the line.
pub(crate) type Points = Vec<[f64; 2]>;

impl<S> Default for View<S> {
    fn default() -> Self {
        Self {
            title: String::new(),
            x: Scale::default(),
            y: Scale::default(),
            equal: false,
            lines: Vec::new(),
            levels: Vec::new(),
            marks: Vec::new(),
            stretches: Vec::new(),
        }
    }
}

impl Line<Points> {
    /// One of several series.
    pub(crate) fn series(i: usize, points: Points) -> Self {
        Self { name: String::new(), style: Style::series(i), points }
    }

    /// The contour, or another thing to compare with.
    pub(crate) fn reference(points: Points) -> Self {
        Self { name: String::new(), style: Style::programmed(), points }
    }
}

impl View<Points> {
    /// Draws the view into a panel.
    pub(crate) fn draw(&self, svg: &mut Svg, panel: &Panel) {
        self.draw_from(svg, panel, |points| Cow::Borrowed(points));
    }
}

impl<S> View<S> {
    /// Draws the view into a panel, with the points that `points` returns for a line.
    pub(crate) fn draw_from<'a>(
        &'a self,
        svg: &mut Svg,
        panel: &Panel,
        points: impl Fn(&'a S) -> Cow<'a, [[f64; 2]]>,
    ) {
        self.draw_stretches(svg, panel);
        svg.axes(panel, &self.title, &self.x, &self.y);
        if !self.x.categories.is_empty() {
            self.places(svg, panel, points);
            return;
        }
        svg.clip(panel);
        let faint = Style::thin(&FAINT).wide(1.2).dashed(&[5, 4]);
        for &level in &self.levels {
            let level = self.y.drawn(level);
            svg.curve(panel, [[panel.x.0, level], [panel.x.1, level]].into_iter(), faint);
        }
        for line in &self.lines {
            for part in points(&line.points).split(|p| !p.iter().all(|v| v.is_finite())) {
                let drawn = part.iter().map(|p| [self.x.drawn(p[0]), self.y.drawn(p[1])]);
                svg.curve(panel, drawn, line.style);
            }
        }
        svg.end_group();
        for (i, mark) in (0_u8..).zip(&self.marks) {
            let x = panel.at([self.x.drawn(mark.at), panel.y.0])[0];
            svg.line([x, panel.top], [x, panel.top + panel.height], faint);
            // names of neighbours lie below each other
            let y = panel.top + 13.0 + 13.0 * f64::from(i % 4);
            svg.text([x + 4.0, y], Font::SCALE, &mark.name);
        }
    }

    /// Shades every second stretch, with its name where there is room.
    fn draw_stretches(&self, svg: &mut Svg, panel: &Panel) {
        if self.stretches.len() > MOST_STRETCHES {
            return;
        }
        let at = |x: f64| panel.at([self.x.drawn(x), 0.0])[0];
        for (i, stretch) in self.stretches.iter().enumerate() {
            let (x, end) = (at(stretch.at), panel.left + panel.width);
            let next = self.stretches.get(i + 1).map_or(end, |next| at(next.at));
            let shade = if i % 2 == 0 { &SHADE } else { &CARD };
            let size = [next - x, panel.height];
            svg.rect([x, panel.top], size, &format!("fill=\"{}\"", shade.light));
            if next - x > 7.0 * stretch.name.len() as f64 + 4.0 {
                let at = [f64::midpoint(x, next), panel.top + 12.0];
                svg.text(at, Font::new(&FAINT, 10.0).middle(), &stretch.name);
            }
        }
    }

    /// Positions with names and, side by side, a point of every series.
    fn places<'a>(
        &'a self,
        svg: &mut Svg,
        panel: &Panel,
        points: impl Fn(&'a S) -> Cow<'a, [[f64; 2]]>,
    ) {
        let step = DODGE / (self.lines.len() as f64).max(1.0);
        for (number, line) in (0_u32..).zip(&self.lines) {
            let aside = step * (f64::from(number) - 0.5 * (self.lines.len() as f64 - 1.0));
            for point in points(&line.points).iter().filter(|p| p[1].is_finite()) {
                let foot = panel.at([point[0] + aside, panel.y.0.max(0.0)]);
                let at = panel.at([point[0] + aside, self.y.drawn(point[1])]);
                svg.line(foot, at, line.style.wide(1.4));
                svg.dot(at, 4.0, line.style.tone);
            }
        }
    }
}

/// Smallest and largest value of every stretch, which keeps all peaks: about `most` points.
pub(crate) fn thinned(points: impl ExactSizeIterator<Item = [f64; 2]>, most: usize) -> Points {
    let stretch = points.len().div_ceil(most / 2).max(1);
    if stretch == 1 {
        return points.collect();
    }
    let all: Points = points.collect();
    let extremes = |part: &[[f64; 2]]| {
        let low = part.iter().copied().reduce(|a, b| if b[1] < a[1] { b } else { a });
        let high = part.iter().copied().reduce(|a, b| if b[1] > a[1] { b } else { a });
        let mut pair: Points = low.into_iter().chain(high).collect();
        pair.sort_by(|a, b| a[0].total_cmp(&b[0]));
        pair
    };
    all.chunks(stretch).flat_map(extremes).collect()
}
