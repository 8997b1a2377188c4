//! The interactive page: one file, no network; data as JSON next to its script.

use super::drawn::Drawn;
use super::recording::{Bucket, Curve, Recording, programmed};
use super::shown::short;
use super::stops::Stop;
use super::track::Point;
use super::vibration;
use super::views;
use crate::chart::scale::{Scale, steps};
use crate::chart::style::{DASHES, variables};
use crate::chart::view::MOST_STRETCHES;
use crate::times::Times;
use crate::trace::fixed::Cells;
use serde_json::json;

/// Page with the placeholders `/*STYLE*/`, `/*DATA*/` and `/*SCRIPT*/`.
const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
/// The script, its parts in the order of their dependencies.
const SCRIPT: &str = concat!(
    include_str!("page/base.js"),
    include_str!("page/legend.js"),
    include_str!("page/contour.js"),
    include_str!("page/plots.js"),
    include_str!("page/spring.js"),
    include_str!("page/program.js"),
    include_str!("page/pointer.js"),
    include_str!("page/around.js"),
);

/// Number of lines whose times are part of the page, the most expensive ones.
const MOST_LINES: usize = 5000;
/// Pairs of axes for the contour, in the order of the buttons.
const PLANES: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];

/// Data of a run that a page shows in addition to its curves.
#[derive(Debug)]
pub(super) struct Beside {
    /// Times by line and reason.
    pub(super) times: Times,
    /// The lines of each source file, as far as they are displayed.
    pub(super) texts: Vec<Option<Vec<String>>>,
    /// The part of the run that is drawn, in s.
    pub(super) window: Option<(f64, f64)>,
}

/// The page of one or several runs.
pub(super) fn draw(runs: &[Drawn], beside: &[Beside]) -> String {
    let title = runs.iter().map(|r| r.summary.program.as_str()).collect::<Vec<_>>().join(", ");
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let groups = views::groups(runs);
    let scale = || Scale::linear("", (0.0, 0.0));
    let chart = json!({
        "steps": steps(), "dashes": DASHES, "most_stretches": MOST_STRETCHES,
        "contour": views::contour(runs, &groups, "Contour", [scale(), scale()]),
        "plane": PLANES.iter().position(|p| *p == views::plane(runs)),
        "actual": views::actual(),
        "views": views::over_time(runs, &groups),
    });
    let all: Vec<String> = runs.iter().zip(beside).map(|(r, b)| run(runs, r, b)).collect();
    let mut data = Json::new();
    data.text("chart", &safe(&chart.to_string()));
    data.text("runs", &format!("[{}]", all.join(",\n")));
    PAGE.replace("/*TITLE*/", &title)
        .replacen("/*STYLE*/", &(variables() + STYLE), 1)
        .replacen("/*SCRIPT*/", SCRIPT, 1)
        .replacen("/*DATA*/", &data.finish(), 1)
}

fn run(runs: &[Drawn], drawn: &Drawn, beside: &Beside) -> String {
    let Drawn { recording: r, summary: s, .. } = drawn;
    let points: Vec<Point> = r.points().copied().collect();
    let mut names: Vec<&str> = r.plane.iter().map(|&i| r.facts.axes[i].name.as_str()).collect();
    // a single axis is drawn along a line
    let drawn_axes = r.plane.len().max(if r.plane.is_empty() { 0 } else { 2 });
    names.resize(drawn_axes, "");
    let mut out = Json::new();
    out.text("summary", &safe(&s.json()));
    let index = runs.iter().position(|r| std::ptr::eq(r, drawn)).unwrap_or_default();
    out.text("name", &safe(&json!(short(runs, index)).to_string()));
    out.text("files", &safe(&json!(r.facts.files.all()).to_string()));
    out.text("plane", &safe(&json!(names).to_string()));
    out.text("width", &r.width.to_string());
    out.text("passes", &r.passes.len().to_string());
    out.text("within", &format!("{:e}", r.within_mm()));
    stretches(&mut out, r);
    out.text("pk", &join(points.iter().map(|p| p.k.to_string())));
    out.text("pline", &join(points.iter().map(|p| p.line.to_string())));
    out.text("pass", &join(points.iter().map(|p| p.pass.to_string())));
    for (name, of) in
        [("ipo", (|p| p.ipo) as fn(&Point) -> [f64; 3]), ("set", |p| p.set), ("act", |p| p.act)]
    {
        let axis = |i: usize| join(points.iter().map(|p| number(of(p)[i])));
        out.text(name, &join((0..drawn_axes).map(axis)));
    }
    let planes = PLANES.into_iter().filter(|p| p[1] < drawn_axes);
    out.text(
        "programmed",
        &join(planes.map(|plane| {
            let path = programmed(&points, plane);
            join((0..2).map(|i| join(path.iter().map(|p| number(p[i])))))
        })),
    );
    out.text("passed", &join(r.buckets.iter().map(|b| b.pass.to_string())));
    out.text("curves", &join(r.curves.iter().enumerate().map(|(i, c)| curve(r, i, c))));
    let acceleration = |a: &Vec<f64>| join(a.iter().map(|v| rounded(*v, 3)));
    out.text("accelerations", &join(r.accelerations.iter().map(acceleration)));
    let model = |axis: usize| {
        let settings = vibration::model(runs, axis);
        let axis = &r.facts.axes[axis];
        let (unit, name) = (axis.unit(), &axis.name);
        json!({ "name": name, "unit": unit, "hz": settings.freq_hz, "damping": settings.damping })
    };
    out.text(
        "models",
        &safe(&json!((0..r.facts.axes.len()).map(model).collect::<Vec<_>>()).to_string()),
    );
    out.text("worst", &json!(r.worst.map(|p| (p.error, p.set))).to_string());
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

/// The columns of the stretches of time that are drawn: beginning, place in the program, limit of the speed.
fn stretches(out: &mut Json, r: &Recording) {
    let buckets = |value: fn(&Bucket) -> String| join(r.buckets.iter().map(value));
    out.text("k", &buckets(|b| b.k.to_string()));
    out.text("last", &r.buckets.last().map_or(0, |b| b.last).to_string());
    out.text("line", &buckets(|b| b.line.to_string()));
    out.text("file", &buckets(|b| b.file.to_string()));
    out.text("block", &buckets(|b| b.block.map_or_else(|| "null".to_owned(), |n| n.to_string())));
    out.text("limit", &buckets(|b| format!("\"{}\"", b.limit.name())));
}

/// Axis, target, window, then t1, t2 and t3 in cycles.
fn stop(r: &Recording, s: &Stop) -> String {
    let axis = &r.facts.axes[s.axis];
    safe(&json!([axis.name, s.target, axis.window, s.t1, s.t2, s.t3]).to_string())
}

fn curve(r: &Recording, i: usize, c: &Curve) -> String {
    let mut out = Json::new();
    out.text("name", &safe(&json!(c.name).to_string()));
    out.text("unit", &safe(&json!(c.unit).to_string()));
    out.text("low", &join(r.buckets.iter().map(|b| number(b.range[i].0))));
    // if every cycle is kept there is one value per cycle
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
    let mut list = String::from("[");
    for (i, item) in items.enumerate() {
        if i > 0 {
            list.push(',');
        }
        list += &item;
    }
    list.push(']');
    list
}

/// Seven decimals without the zeros at the end.
fn number(v: f64) -> String {
    rounded(v, 7)
}

fn rounded(v: f64, decimals: u8) -> String {
    let mut text = Cells::default();
    text.push_fixed(v, decimals);
    let text = String::from_utf8_lossy(text.as_bytes());
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
