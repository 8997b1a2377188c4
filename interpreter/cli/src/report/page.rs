//! The interactive page: one file, no network; data as JSON beside its own script.

use super::recording::{Bucket, Curve, Kind, Point, Recording, programmed};
use super::stops::Stop;
use crate::times::Times;
use crate::trace::fixed::push_fixed;
use kontur_interpreter::summary::Summary;
use serde_json::json;

/// Page with the places `/*STYLE*/`, `/*DATA*/` and `/*SCRIPT*/`.
const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
/// One script in the order in which its parts need each other.
const SCRIPT: &str = concat!(
    include_str!("page/base.js"),
    include_str!("page/legend.js"),
    include_str!("page/contour.js"),
    include_str!("page/plots.js"),
    include_str!("page/program.js"),
    include_str!("page/pointer.js"),
    include_str!("page/around.js"),
);

/// Lines whose times the page knows, the most expensive ones.
const MOST_LINES: usize = 5000;

/// What a page shows of a run beside its curves.
#[derive(Debug)]
pub(super) struct Beside {
    /// Where the time went.
    pub(super) times: Times,
    /// The lines of each source file, as far as they are shown.
    pub(super) texts: Vec<Option<Vec<String>>>,
    /// The part of the run that is drawn, in s.
    pub(super) window: Option<(f64, f64)>,
}

/// The page of one or several runs.
pub(super) fn draw(runs: &[(Recording, Summary)], beside: &[Beside]) -> String {
    let data: Vec<String> = runs.iter().zip(beside).map(|((r, s), b)| run(r, s, b)).collect();
    let title = runs.iter().map(|(_, s)| s.program.as_str()).collect::<Vec<_>>().join(", ");
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    PAGE.replace("/*TITLE*/", &title)
        .replacen("/*STYLE*/", STYLE, 1)
        .replacen("/*SCRIPT*/", SCRIPT, 1)
        .replacen("/*DATA*/", &format!("[{}]", data.join(",\n")), 1)
}

fn run(r: &Recording, s: &Summary, beside: &Beside) -> String {
    let points: Vec<Point> = r.points().copied().collect();
    let names: Vec<&str> = r.plane.iter().map(|&i| r.facts.axes[i].name.as_str()).collect();
    let mut out = Json::new();
    out.text("summary", &safe(&s.json()));
    out.text("files", &safe(&json!(r.facts.files.all()).to_string()));
    out.text("plane", &safe(&json!(names).to_string()));
    out.text("width", &r.width.to_string());
    out.text("passes", &r.passes.len().to_string());
    out.text("within", &format!("{:e}", r.within_mm()));
    let buckets = |value: fn(&Bucket) -> String| join(r.buckets.iter().map(value));
    out.text("k", &buckets(|b| b.k.to_string()));
    out.text("line", &buckets(|b| b.line.to_string()));
    out.text("file", &buckets(|b| b.file.to_string()));
    out.text("block", &buckets(|b| b.block.map_or_else(|| "null".to_owned(), |n| n.to_string())));
    out.text("limit", &buckets(|b| format!("\"{}\"", b.limit.name())));
    out.text("pk", &join(points.iter().map(|p| p.k.to_string())));
    out.text("pline", &join(points.iter().map(|p| p.line.to_string())));
    out.text("pass", &join(points.iter().map(|p| p.pass.to_string())));
    for (name, of) in
        [("ipo", (|p| p.ipo) as fn(&Point) -> [f64; 3]), ("set", |p| p.set), ("act", |p| p.act)]
    {
        let axis = |i: usize| join(points.iter().map(|p| number(of(p)[i])));
        out.text(name, &join((0..r.plane.len()).map(axis)));
    }
    let planes = [[0, 1], [0, 2], [1, 2]].into_iter().filter(|p| p[1] < r.plane.len());
    out.text(
        "programmed",
        &join(planes.map(|plane| {
            let path = programmed(&points, plane);
            join((0..2).map(|i| join(path.iter().map(|p| number(p[i])))))
        })),
    );
    let shown = r.curves.iter().enumerate().filter(|(i, c)| tells_something(r, *i, c));
    out.text("curves", &join(shown.map(|(i, c)| curve(r, i, c))));
    let times = &beside.times;
    let lines = times.lines.get(..MOST_LINES).unwrap_or(&times.lines);
    let times = json!({
        "duration_s": times.duration_s, "reasons": times.reasons, "lines": lines, "axes": times.axes,
    });
    out.text("times", &safe(&times.to_string()));
    out.text("texts", &safe(&json!(beside.texts).to_string()));
    out.text("window", &json!(beside.window).to_string());
    out.text("stops", &join(r.stops.found().iter().map(|s| stop(r, s))));
    out.finish()
}

/// The load of a stiff axis is where its motor is.
fn tells_something(r: &Recording, i: usize, c: &Curve) -> bool {
    let actual = |other: &Curve| other.kind == Kind::Actual && other.axis == c.axis;
    let Some(beside) = r.curves.iter().position(actual).filter(|_| c.kind == Kind::Load) else {
        return true;
    };
    r.buckets.iter().any(|b| b.range[i] != b.range[beside])
}

/// Axis, target, window, then t1, t2 and t3 in cycles.
fn stop(r: &Recording, s: &Stop) -> String {
    let axis = &r.facts.axes[s.axis];
    safe(&json!([axis.name, s.target, axis.window, s.t1, s.t2, s.t3]).to_string())
}

fn curve(r: &Recording, i: usize, c: &Curve) -> String {
    let kind = match c.kind {
        Kind::Speed => "speed",
        Kind::ContourError => "error",
        Kind::Deviation => "dev",
        Kind::Lag => "lag",
        Kind::Velocity => "vel",
        Kind::Acceleration => "acc",
        Kind::Set | Kind::Actual | Kind::Load => "pos",
    };
    let mut out = Json::new();
    out.text("name", &safe(&json!(c.name).to_string()));
    out.text("unit", &safe(&json!(c.unit).to_string()));
    out.text("kind", &format!("\"{kind}\""));
    out.text("low", &join(r.buckets.iter().map(|b| number(b.range[i].0))));
    // a run that keeps every cycle has one value per cycle
    let high = if r.width > 1 {
        join(r.buckets.iter().map(|b| number(b.range[i].1)))
    } else {
        "null".to_owned()
    };
    out.text("high", &high);
    out.finish()
}

/// JSON inside a script element must not end that element.
fn safe(json: &str) -> String {
    json.replace('<', "\\u003c")
}

fn join(items: impl Iterator<Item = String>) -> String {
    let items: Vec<String> = items.collect();
    format!("[{}]", items.join(","))
}

/// Seven decimals without the zeros at the end.
fn number(v: f64) -> String {
    let mut text = Vec::new();
    push_fixed(&mut text, v, 7);
    let text = String::from_utf8_lossy(&text);
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short.is_empty() { "null".to_owned() } else { short.to_owned() }
}

/// An object under construction.
struct Json(String);

impl Json {
    const fn new() -> Self {
        Self(String::new())
    }

    fn text(&mut self, key: &str, value: &str) {
        self.0.push(if self.0.is_empty() { '{' } else { ',' });
        self.0.extend(["\"", key, "\":", value]);
    }

    fn finish(self) -> String {
        self.0 + "}"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_valid() {
        for (v, text) in
            [(0.0, "0"), (-0.5, "-0.5"), (100.0, "100"), (1e-7, "0.0000001"), (f64::NAN, "null")]
        {
            assert_eq!(number(v), text);
        }
    }
}
