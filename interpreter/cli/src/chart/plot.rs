//! Pictures of several views: a headline, panels, one legend.

use super::style::{INK, Style};
use super::svg::{Font, Panel, Svg};
use super::view::{Points, View};

const WIDTH: f64 = 1100.0;
const MARGIN: f64 = 76.0;
const GAP: f64 = 84.0;
/// Names longer than this get a separate line of the legend.
const LONG_NAME: usize = 66;

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
    pub(crate) panels: Vec<View<Points>>,
}

impl Plot {
    /// The SVG file.
    pub(crate) fn draw(&self) -> String {
        let mut svg = Svg::new();
        svg.text([MARGIN, 36.0], Font::HEAD, &self.title);
        svg.text([MARGIN, 58.0], Font::FACTS, &self.subtitle);
        let columns = self.columns.max(1);
        let width =
            (WIDTH - MARGIN - 28.0 - GAP * (columns as f64 - 1.0)) / (columns as f64).max(1.0);
        for (i, view) in self.panels.iter().enumerate() {
            let (row, column) = (i / columns, i % columns);
            let panel = Panel {
                left: MARGIN + column as f64 * (width + GAP),
                top: 100.0 + row as f64 * self.row_height,
                width,
                height: self.row_height - 76.0,
                x: view.x.drawn_range(),
                y: view.y.drawn_range(),
            };
            let panel = if view.equal { panel.equal_scale() } else { panel };
            view.draw(&mut svg, &panel);
        }
        let rows = self.panels.len().div_ceil(columns);
        let top = 100.0 + rows as f64 * self.row_height;
        let long = self.legend.iter().any(|name| name.chars().count() > LONG_NAME);
        let per_column = self.legend.len().div_ceil(if long { 1 } else { 2 });
        for (i, name) in self.legend.iter().enumerate() {
            let x = MARGIN + if i < per_column { 0.0 } else { 520.0 };
            let y = top + 20.0 * (i % per_column.max(1)) as f64;
            svg.line([x, y - 4.0], [x + 30.0, y - 4.0], Style::series(i).wide(2.2));
            svg.text([x + 38.0, y], Font::new(&INK, 12.0), name);
        }
        svg.finish(WIDTH, top + 20.0 * per_column as f64 + 10.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::scale::Scale;
    use crate::chart::style::SERIES;
    use crate::chart::view::Line;

    fn svg(view: View<Points>) -> String {
        Plot { columns: 1, row_height: 300.0, panels: vec![view], ..Plot::default() }.draw()
    }

    #[test]
    fn curves_break_at_what_is_no_number() {
        let points = vec![[1.0, 0.0], [10.0, 1.0], [20.0, f64::NAN], [50.0, 1.0], [100.0, 0.0]];
        let view = View {
            title: "a".to_owned(),
            x: Scale::logarithmic("frequency in Hz", (1.0, 100.0)),
            y: Scale::linear("gain", (0.0, 1.0)),
            lines: vec![Line::series(0, points)],
            levels: vec![0.5],
            ..View::default()
        };
        let svg = svg(view);
        let paths: Vec<&str> = svg.lines().filter(|l| l.starts_with("<path")).collect();
        assert_eq!(paths.len(), 3, "a level and two parts");
        for name in [">1<", ">2<", ">50<", ">100<", ">frequency in Hz<", ">gain<"] {
            assert!(svg.contains(name), "{name}");
        }
        assert!(!svg.contains("NaN"));
    }

    /// Values of a mode: points with names, side by side for several series, without a line between them.
    #[test]
    fn categories_are_points() {
        let line = |series, y| Line::series(series, vec![[0.0, y], [1.0, 2.0 * y]]);
        let names = vec!["HSC".to_owned(), "TRAPEZ".to_owned()];
        let svg = svg(View {
            x: Scale::categories("type", names),
            y: Scale::linear("time in s", (0.0, 4.0)),
            lines: vec![line(0, 1.0), line(1, 1.0)],
            ..View::default()
        });
        let dots: Vec<&str> = svg.lines().filter(|l| l.starts_with("<circle")).collect();
        assert_eq!(dots.len(), 4);
        assert!((1..4).all(|i| {
            dots[..i].iter().all(|d| d.split(" cy").next() != dots[i].split(" cy").next())
        }));
        assert!(svg.contains(">HSC<") && svg.contains(">TRAPEZ<") && svg.contains(">type<"));
        assert!(!svg.contains("<path"));
    }

    /// A line on top of an earlier one leaves that one visible: only the first is solid.
    #[test]
    fn later_lines_are_dashed() {
        let points = vec![[0.0, 0.0], [1.0, 0.5]];
        let svg = svg(View {
            x: Scale::linear("", (0.0, 1.0)),
            y: Scale::linear("", (0.0, 1.0)),
            lines: (0..3).map(|i| Line::series(i, points.clone())).collect(),
            ..View::default()
        });
        let dashed: Vec<&str> = svg.lines().filter(|l| l.contains("stroke-dasharray")).collect();
        assert_eq!(dashed.len(), 2);
        assert!(
            dashed.iter().zip(&SERIES[1..]).all(|(l, tone)| l.contains(tone.light)),
            "{dashed:?}"
        );
    }
}
