//! A small writer of SVG: enough for plots with axes, deterministic to the last digit.

use super::scale::Scale;
use super::style::{CARD, FAINT, FRAME, GRID, INK, Style, Tone};
use std::fmt::Write as _;

/// A picture being drawn.
#[derive(Debug)]
pub(crate) struct Svg {
    body: String,
    clips: u32,
}

/// Style of a text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Font {
    pub(crate) tone: &'static Tone,
    pub(crate) size: f64,
    pub(crate) bold: bool,
    /// `start`, `middle` or `end`.
    pub(crate) anchor: &'static str,
    /// Written upwards.
    pub(crate) upward: bool,
}

impl Font {
    /// A headline.
    pub(crate) const HEAD: Self = Self::new(&INK, 20.0).bold();
    /// A title above a panel.
    pub(crate) const TITLE: Self = Self::new(&INK, 13.0).bold();
    /// Names in a legend.
    pub(crate) const NAME: Self = Self::new(&INK, 12.0);
    /// The text below a headline.
    pub(crate) const FACTS: Self = Self::new(&FAINT, 13.0);
    /// Labels of a scale.
    pub(crate) const SCALE: Self = Self::new(&FAINT, 11.0);

    /// Text that begins at its place.
    pub(crate) const fn new(tone: &'static Tone, size: f64) -> Self {
        Self { tone, size, bold: false, anchor: "start", upward: false }
    }

    const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// Text around its place.
    pub(crate) const fn middle(self) -> Self {
        Self { anchor: "middle", ..self }
    }

    /// Text that ends at its place.
    pub(crate) const fn end(self) -> Self {
        Self { anchor: "end", ..self }
    }

    /// Text from below to above.
    pub(crate) const fn upward(self) -> Self {
        Self { upward: true, ..self }
    }
}

/// A rectangle of the picture with data coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) x: (f64, f64),
    pub(crate) y: (f64, f64),
}

impl Panel {
    /// Widens the data range so that both directions have the same scale.
    pub(crate) fn equal_scale(mut self) -> Self {
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
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.left + (x - self.x.0) / (self.x.1 - self.x.0) * self.width,
            self.top + (self.y.1 - y) / (self.y.1 - self.y.0) * self.height,
        ]
    }
}

impl Svg {
    /// An empty picture.
    pub(crate) const fn new() -> Self {
        Self { body: String::new(), clips: 0 }
    }

    /// The file.
    pub(crate) fn finish(self, width: f64, height: f64) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" \
             font-family=\"Inter, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif\" font-size=\"12\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n{}</svg>\n",
            CARD.light, self.body
        )
    }

    fn push(&mut self, args: std::fmt::Arguments<'_>) {
        // writing to a String cannot fail
        let _ = self.body.write_fmt(args);
        self.body.push('\n');
    }

    /// Text in a size and a colour.
    pub(crate) fn text(&mut self, [x, y]: [f64; 2], font: Font, text: &str) {
        let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        let (x, y) = (px(x), px(y));
        let Font { tone, size, bold, anchor, upward } = font;
        let weight = if bold { " font-weight=\"600\"" } else { "" };
        let turn =
            if upward { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
        self.push(format_args!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" fill=\"{}\" font-size=\"{size}\"{weight}{turn}>{text}</text>",
            tone.light
        ));
    }

    /// A straight line.
    pub(crate) fn line(&mut self, a: [f64; 2], b: [f64; 2], style: Style) {
        let [x1, y1, x2, y2] = [a[0], a[1], b[0], b[1]].map(px);
        let style = attributes(style);
        self.push(format_args!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {style}/>"));
    }

    /// A rectangle; `style` holds fill and stroke.
    pub(crate) fn rect(&mut self, [x, y]: [f64; 2], [w, h]: [f64; 2], style: &str) {
        let [x, y, w, h] = [x, y, w, h].map(px);
        self.push(format_args!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" {style}/>"));
    }

    /// A filled circle.
    pub(crate) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, tone: &Tone) {
        let [x, y, r] = [x, y, radius].map(px);
        self.push(format_args!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{}\"/>",
            tone.light
        ));
    }

    /// Opens a group that is clipped to the panel; [`Svg::end_group`] closes it.
    pub(crate) fn clip(&mut self, p: &Panel) {
        self.clips += 1;
        let n = self.clips;
        let [x, y, w, h] = [p.left, p.top, p.width, p.height].map(px);
        self.push(format_args!(
            "<clipPath id=\"c{n}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n\
             <g clip-path=\"url(#c{n})\" fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">"
        ));
    }

    /// Closes a group.
    pub(crate) fn end_group(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// Grid, frame and labels of a panel.
    pub(crate) fn axes(&mut self, p: &Panel, title: &str, x: &Scale, y: &Scale) {
        let grid = Style::thin(&GRID);
        let (bottom, right) = (p.top + p.height, p.left + p.width);
        for (x, text) in x.places(p.x, p.width / 90.0) {
            let at = p.at([x, p.y.0])[0];
            self.line([at, p.top], [at, bottom], grid);
            self.text([at, bottom + 15.0], Font::SCALE.middle(), &text);
        }
        for (y, text) in y.places(p.y, p.height / 35.0) {
            let at = p.at([p.x.0, y])[1];
            self.line([p.left, at], [right, at], grid);
            self.text([p.left - 6.0, at + 4.0], Font::SCALE.end(), &text);
        }
        self.rect(
            [p.left, p.top],
            [p.width, p.height],
            &format!("fill=\"none\" stroke=\"{}\"", FRAME.light),
        );
        self.text([p.left, p.top - 9.0], Font::TITLE, title);
        self.text([f64::midpoint(p.left, right), bottom + 31.0], Font::SCALE.middle(), &x.label);
        let middle = f64::midpoint(p.top, bottom);
        self.text([p.left - 54.0, middle], Font::SCALE.middle().upward(), &y.label);
    }

    /// A line through data points; points that move by less than a third of a pixel or are outside are left out.
    pub(crate) fn curve(
        &mut self,
        panel: &Panel,
        points: impl Iterator<Item = [f64; 2]>,
        style: Style,
    ) {
        let mut path = String::new();
        let mut last: Option<[f64; 2]> = None;
        // last drawn position of the pen, and a small step that is not drawn yet
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
            let style = attributes(style);
            self.push(format_args!("<path d=\"{path}\" fill=\"none\" {style}/>"));
        }
    }
}

fn attributes(style: Style) -> String {
    let dash: Vec<String> = style.dash.iter().map(u8::to_string).collect();
    let dash = if dash.is_empty() {
        String::new()
    } else {
        format!(" stroke-dasharray=\"{}\"", dash.join(" "))
    };
    format!("stroke=\"{}\" stroke-width=\"{}\"{dash}", style.tone.light, style.width)
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

#[cfg(test)]
mod tests {
    use super::*;

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
        svg.text([0.0, 0.0], Font::NAME, "<a&b>");
        assert!(svg.finish(1.0, 1.0).contains("&lt;a&amp;b&gt;"));
    }
}
