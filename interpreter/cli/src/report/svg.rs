//! A small writer of SVG: enough for plots with axes, deterministic to the last digit.

use std::fmt::Write as _;

/// Colours that stay apart in print and for colour-blind eyes.
pub(super) const COLOURS: [&str; 8] =
    ["#1c6dd0", "#d9480f", "#2b8a3e", "#9c36b5", "#0c8599", "#b08900", "#e64980", "#495057"];
/// Text and axes.
pub(super) const INK: &str = "#343a40";
/// Secondary text.
pub(super) const FAINT: &str = "#868e96";
/// Grid lines.
const GRID: &str = "#e9ecef";

/// A picture under way.
#[derive(Debug)]
pub(super) struct Svg {
    body: String,
    clips: u32,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke<'a> {
    pub(super) colour: &'a str,
    pub(super) width: f64,
    /// `stroke-dasharray`, empty for a solid line.
    pub(super) dash: &'a str,
}

/// A rectangle of the picture with data coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) x: (f64, f64),
    pub(super) y: (f64, f64),
}

impl Panel {
    /// Widens the data range so that both directions have the same scale.
    pub(super) fn equal_scale(mut self) -> Self {
        let per_px = ((self.x.1 - self.x.0) / self.width).max((self.y.1 - self.y.0) / self.height);
        let widen = |range: (f64, f64), size: f64| {
            let (middle, half) = (f64::midpoint(range.0, range.1), per_px * size / 2.0);
            (middle - half, middle + half)
        };
        self.x = widen(self.x, self.width);
        self.y = widen(self.y, self.height);
        self
    }

    /// Data to picture coordinates.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.left + (x - self.x.0) / (self.x.1 - self.x.0) * self.width,
            self.top + (self.y.1 - y) / (self.y.1 - self.y.0) * self.height,
        ]
    }
}

impl Svg {
    /// An empty picture.
    pub(super) const fn new() -> Self {
        Self { body: String::new(), clips: 0 }
    }

    /// The file.
    pub(super) fn finish(self, width: f64, height: f64) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" \
             font-family=\"Inter, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif\" font-size=\"12\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.body
        )
    }

    fn push(&mut self, args: std::fmt::Arguments<'_>) {
        // writing to a String cannot fail
        let _ = self.body.write_fmt(args);
        self.body.push('\n');
    }

    /// Text; `anchor` is `start`, `middle` or `end`.
    pub(super) fn text(&mut self, [x, y]: [f64; 2], anchor: &str, style: &str, text: &str) {
        let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        let (x, y) = (px(x), px(y));
        self.push(format_args!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" {style}>{text}</text>"
        ));
    }

    /// A straight line.
    pub(super) fn line(&mut self, a: [f64; 2], b: [f64; 2], stroke: Stroke<'_>) {
        let [x1, y1, x2, y2] = [a[0], a[1], b[0], b[1]].map(px);
        let style = stroke.attributes();
        self.push(format_args!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {style}/>"));
    }

    /// A rectangle; `style` holds fill and stroke.
    pub(super) fn rect(&mut self, [x, y]: [f64; 2], [w, h]: [f64; 2], style: &str) {
        let [x, y, w, h] = [x, y, w, h].map(px);
        self.push(format_args!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" {style}/>"));
    }

    /// A filled circle.
    pub(super) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, colour: &str) {
        let [x, y, r] = [x, y, radius].map(px);
        self.push(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{colour}\"/>"));
    }

    /// Opens a group that shows nothing outside the panel; [`Svg::end_group`] closes it.
    pub(super) fn clip(&mut self, p: &Panel) {
        self.clips += 1;
        let n = self.clips;
        let [x, y, w, h] = [p.left, p.top, p.width, p.height].map(px);
        self.push(format_args!(
            "<clipPath id=\"c{n}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n\
             <g clip-path=\"url(#c{n})\" fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">"
        ));
    }

    /// Closes a group.
    pub(super) fn end_group(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// A line through data points; what moves less than a third of a pixel and what lies outside is left out.
    pub(super) fn curve(
        &mut self,
        panel: &Panel,
        points: impl Iterator<Item = [f64; 2]>,
        stroke: Stroke<'_>,
    ) {
        let mut path = String::new();
        let mut last: Option<[f64; 2]> = None;
        // where the pen is on paper, and a small step it has not drawn yet
        let mut pen: Option<[f64; 2]> = None;
        let mut waiting: Option<[f64; 2]> = None;
        let mut put = |command: char, [x, y]: [f64; 2]| {
            let _ = write!(path, "{command}{} {}", px(x), px(y));
        };
        for p in points {
            if let Some(q) = last.filter(|q| may_cross(panel, *q, p)) {
                let from = pen.unwrap_or_else(|| {
                    put('M', panel.at(q));
                    panel.at(q)
                });
                let to = panel.at(p);
                if (to[0] - from[0]).abs().max((to[1] - from[1]).abs()) < 0.3 {
                    (pen, waiting) = (Some(from), Some(to));
                } else {
                    put('L', to);
                    (pen, waiting) = (Some(to), None);
                }
            } else {
                if let Some(w) = waiting.take() {
                    put('L', w);
                }
                pen = None;
            }
            last = Some(p);
        }
        if let Some(w) = waiting {
            put('L', w);
        }
        if !path.is_empty() {
            let style = stroke.attributes();
            self.push(format_args!("<path d=\"{path}\" fill=\"none\" {style}/>"));
        }
    }

    /// Frame, grid and ticks of a panel, with a title above and units at the axes.
    pub(super) fn axes(&mut self, p: &Panel, title: &str, x_label: &str, y_label: &str) {
        let grid = Stroke { colour: GRID, width: 1.0, dash: "" };
        let (bottom, right) = (p.top + p.height, p.left + p.width);
        let (x_ticks, x_decimals) = ticks(p.x, p.width / 90.0);
        for x in x_ticks {
            let at = p.at([x, p.y.0])[0];
            self.line([at, p.top], [at, bottom], grid);
            let style = format!("fill=\"{FAINT}\" font-size=\"11\"");
            self.text([at, bottom + 15.0], "middle", &style, &tick(x, x_decimals));
        }
        let (y_ticks, y_decimals) = ticks(p.y, p.height / 35.0);
        for y in y_ticks {
            let at = p.at([p.x.0, y])[1];
            self.line([p.left, at], [right, at], grid);
            let style = format!("fill=\"{FAINT}\" font-size=\"11\"");
            self.text([p.left - 6.0, at + 4.0], "end", &style, &tick(y, y_decimals));
        }
        let frame = "fill=\"none\" stroke=\"#ced4da\"";
        self.rect([p.left, p.top], [p.width, p.height], frame);
        let heading = format!("fill=\"{INK}\" font-weight=\"600\" font-size=\"13\"");
        self.text([p.left, p.top - 9.0], "start", &heading, title);
        let unit = format!("fill=\"{FAINT}\" font-size=\"11\"");
        self.text([right, bottom + 30.0], "end", &unit, x_label);
        self.text([p.left - 6.0, p.top - 9.0], "end", &unit, y_label);
    }
}

impl Stroke<'_> {
    fn attributes(&self) -> String {
        let dash = if self.dash.is_empty() {
            String::new()
        } else {
            format!(" stroke-dasharray=\"{}\"", self.dash)
        };
        format!("stroke=\"{}\" stroke-width=\"{}\"{dash}", self.colour, self.width)
    }
}

fn may_cross(panel: &Panel, a: [f64; 2], b: [f64; 2]) -> bool {
    a[0].min(b[0]) <= panel.x.1
        && a[0].max(b[0]) >= panel.x.0
        && a[1].min(b[1]) <= panel.y.1
        && a[1].max(b[1]) >= panel.y.0
}

/// A picture coordinate to a tenth of a pixel.
fn px(v: f64) -> f64 {
    let rounded = (v * 10.0).round() / 10.0;
    // no "-0" in the file
    rounded + 0.0
}

/// Round numbers inside a range, about `wanted` of them, and the decimals they need.
pub(super) fn ticks(range: (f64, f64), wanted: f64) -> (Vec<f64>, usize) {
    let span = range.1 - range.0;
    if !(span > 0.0 && span.is_finite()) {
        return (Vec::new(), 0);
    }
    let rough = span / wanted.max(2.0);
    let power = libm::floor(libm::log10(rough));
    let magnitude = libm::pow(10.0, power);
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * magnitude >= rough).unwrap_or(10.0);
    let step = factor * magnitude;
    let finest = if factor >= 10.0 { power + 1.0 } else { power };
    let decimals = (-finest).clamp(0.0, 12.0) as usize;
    let first = libm::ceil(range.0 / step - 1e-9);
    let values = (0..200).map(|i| (first + f64::from(i)) * step);
    (values.take_while(|v| *v <= range.1 + 1e-9 * span).collect(), decimals)
}

fn tick(v: f64, decimals: usize) -> String {
    let text = format!("{v:.decimals$}");
    if text.trim_start_matches(['-', '0', '.']).is_empty() {
        "0".to_owned()
    } else {
        text.replace('-', "−")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let (t, decimals) = ticks((0.0, 1.0), 5.0);
        assert_eq!((t.len(), decimals), (6, 1));
        let (t, decimals) = ticks((-0.013, 0.021), 4.0);
        assert_eq!(
            t.iter().map(|&v| tick(v, decimals)).collect::<Vec<_>>(),
            ["−0.01", "0", "0.01", "0.02"]
        );
        assert!(ticks((1.0, 1.0), 4.0).0.is_empty());
        assert!(ticks((0.0, f64::NAN), 4.0).0.is_empty());
    }

    #[test]
    fn equal_scale_keeps_the_middle() {
        let p = Panel {
            left: 0.0,
            top: 0.0,
            width: 200.0,
            height: 100.0,
            x: (0.0, 1.0),
            y: (0.0, 1.0),
        }
        .equal_scale();
        let [a, b] = [p.at([0.0, 0.0]), p.at([1.0, 1.0])];
        assert!((b[0] - a[0] - 100.0).abs() < 1e-9 && (a[1] - b[1] - 100.0).abs() < 1e-9);
    }

    #[test]
    fn text_is_escaped() {
        let mut svg = Svg::new();
        svg.text([0.0, 0.0], "start", "", "<a&b>");
        assert!(svg.finish(1.0, 1.0).contains("&lt;a&amp;b&gt;"));
    }
}
