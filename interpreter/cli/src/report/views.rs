//! Views of a report on its runs: the same in the picture and in the page.

use super::drawn::Drawn;
use super::recording::{Kind, Recording, programmed};
use super::shown::{Contour, Shown, Source, name, short, span, style};
use super::track::Point;
use super::vibration;
use crate::chart::scale::{Scale, label};
use crate::chart::style::Style;
use crate::chart::view::{Line, Points, View};
use kontur_interpreter::summary::Summary;
use std::borrow::Cow;

/// Deviations below this are rounding.
pub(super) const VISIBLE_MM: f64 = 1e-7;
/// Dashes of the actual position.
const ACTUAL: &[u8] = &[4, 3];

/// Curves of one colour: a pass of a single program, or one of several programs.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub(super) run: usize,
    pub(super) pass: Option<usize>,
    pub(super) style: Style,
    pub(super) label: String,
}

impl Group {
    pub(super) fn draws(&self, point: &Point) -> bool {
        self.pass.is_none_or(|pass| pass == point.pass)
    }
}

/// The passes of one run, or the runs.
pub(super) fn groups(runs: &[Drawn]) -> Vec<Group> {
    let of_run = |s: &Summary| s.max_contour_error.as_ref().map_or(0.0, |e| e.mm);
    let errors = runs.iter().any(|r| of_run(&r.summary) > VISIBLE_MM);
    // an empty list does not need a line
    let error = |before: &str, mm: f64| {
        if errors { format!("{before}contour error at most {mm:.4} mm") } else { String::new() }
    };
    if let [one] = runs
        && one.recording.passes.len() > 1
    {
        let of_pass = |(i, p): (usize, &super::recording::Pass)| {
            let lines = format!("set, pass {}, lines {} to {}", i + 1, p.first_line, p.last_line);
            let label = lines + &error(": ", p.error_mm);
            Group { run: 0, pass: Some(i), style: Style::series(i), label }
        };
        return one.recording.passes.iter().enumerate().map(of_pass).collect();
    }
    let of_run = |(i, r): (usize, &Drawn)| {
        let error = error(", ", of_run(&r.summary));
        let name = if runs.len() > 1 { format!("{}, ", short(runs, i)) } else { String::new() };
        let label = format!("set, {name}{:.3} s{error}", r.summary.duration_s);
        Group { run: i, pass: None, style: Style::series(i), label }
    };
    runs.iter().enumerate().map(of_run).collect()
}

/// The contour in a plane: programmed, actual and set.
pub(super) fn contour(
    runs: &[Drawn],
    groups: &[Group],
    title: &str,
    [x, y]: [Scale; 2],
) -> View<Source> {
    let mut lines: Vec<Line<Source>> = (0..runs.len())
        .map(|run| Line {
            name: "programmed".to_owned(),
            style: Style::programmed(),
            points: Source::Contour { what: Contour::Programmed, run, pass: None },
        })
        .collect();
    for what in [Contour::Act, Contour::Set] {
        lines.extend(groups.iter().map(|g| Line {
            name: g.label.clone(),
            style: if what == Contour::Act { g.style.wide(1.0).dashed(ACTUAL) } else { g.style },
            points: Source::Contour { what, run: g.run, pass: g.pass },
        }));
    }
    View { title: title.to_owned(), x, y, equal: true, lines, ..View::default() }
}

/// The actual position in a legend.
pub(super) fn actual() -> Style {
    Style::thin(&crate::chart::style::INK).dashed(ACTUAL)
}

/// The views over time, each with all its lines, then the vibration.
pub(super) fn over_time(runs: &[Drawn], groups: &[Group]) -> Vec<Shown> {
    const KINDS: [(&str, &str, &str, &[Kind]); 7] = [
        ("speed", "Path speed", "speed", &[Kind::Speed]),
        ("error", "Contour error", "contour error", &[Kind::ContourError]),
        ("dev", "Deviation from the contour by axis", "deviation", &[Kind::Deviation]),
        ("lag", "Lag", "lag", &[Kind::Lag]),
        ("pos", "Position", "position", &[Kind::Set, Kind::Actual, Kind::Load]),
        ("vel", "Axis velocity", "velocity", &[Kind::Velocity]),
        ("acc", "Axis acceleration", "acceleration", &[Kind::Acceleration]),
    ];
    let mut all = Vec::new();
    for (kind, title, quantity, kinds) in KINDS {
        let lines = if kind == "speed" { speeds(runs, groups) } else { curves(runs, kinds) };
        if lines.is_empty() {
            continue;
        }
        let unit = units(runs, kinds);
        let range = range(runs, kinds);
        let flat = range.0.abs().max(range.1.abs()) < VISIBLE_MM;
        let view = View {
            title: title.to_owned(),
            x: Scale::linear("time in s", span(runs)),
            y: Scale::linear(label(quantity, &unit), with_air(range)),
            lines,
            ..View::default()
        };
        let open = matches!(kind, "speed" | "lag") || (kind == "dev" && !flat);
        all.push(Shown { kind, open, note: String::new(), view });
    }
    all.extend(vibration::views(runs));
    all
}

/// The path speed in the colours of the contour.
fn speeds(runs: &[Drawn], groups: &[Group]) -> Vec<Line<Source>> {
    let line = |g: &Group| {
        let curve = runs[g.run].recording.curves.iter().position(|c| c.kind == Kind::Speed)?;
        let name =
            g.pass.map_or_else(|| name(runs, g.run, "path speed"), |p| format!("pass {}", p + 1));
        Some(Line {
            name,
            style: g.style,
            points: Source::Curve { run: g.run, curve, pass: g.pass },
        })
    };
    groups.iter().filter_map(line).collect()
}

/// One run: an axis has a colour and dashes. Several: a run has a colour, an axis its dashes. Actual values are thin.
fn curves(runs: &[Drawn], kinds: &[Kind]) -> Vec<Line<Source>> {
    let mut lines = Vec::new();
    for (run, r) in runs.iter().enumerate() {
        for (curve, c) in r.recording.curves.iter().enumerate() {
            if !kinds.contains(&c.kind) {
                continue;
            }
            let width = match c.kind {
                Kind::Actual => 0.9,
                Kind::Load => 0.5,
                _ => 1.8,
            };
            let name = name(runs, run, &c.name);
            let style = style(runs, run, c.axis).wide(width);
            lines.push(Line { name, style, points: Source::Curve { run, curve, pass: None } });
        }
    }
    lines
}

/// The units of curves, each once.
fn units(runs: &[Drawn], kinds: &[Kind]) -> String {
    let mut units: Vec<&str> = Vec::new();
    for c in runs.iter().flat_map(|r| &r.recording.curves).filter(|c| kinds.contains(&c.kind)) {
        if !units.contains(&c.unit.as_str()) {
            units.push(&c.unit);
        }
    }
    units.join(", ")
}

/// Smallest and largest value of curves, including 0.
fn range(runs: &[Drawn], kinds: &[Kind]) -> (f64, f64) {
    let all = runs.iter().flat_map(|r| {
        let wanted = r.recording.curves.iter().enumerate().filter(|(_, c)| kinds.contains(&c.kind));
        wanted.flat_map(|(i, _)| r.recording.buckets.iter().map(move |b| b.range[i]))
    });
    all.fold((0.0, 0.0), |m: (f64, f64), r| (m.0.min(r.0), m.1.max(r.1)))
}

/// Room for the numbers of the lines.
fn with_air((low, high): (f64, f64)) -> (f64, f64) {
    let air = (0.16 * (high - low)).max(1e-6);
    (if low < 0.0 { low - air } else { low }, high + air)
}

/// The points of a line in a picture of `pixels`, the contour in a plane.
pub(super) fn points<'a>(
    source: &'a Source,
    runs: &[Drawn],
    plane: [usize; 2],
    pixels: f64,
) -> Cow<'a, [[f64; 2]]> {
    match source {
        Source::Given { points, .. } => Cow::Borrowed(points),
        Source::Curve { run, curve, pass } => {
            Cow::Owned(over_pixels(&runs[*run].recording, *curve, *pass, pixels))
        }
        Source::Spring { run, axis } => Cow::Owned(vibration::deflection(runs, *run, *axis)),
        Source::Contour { what, run, pass } => {
            let all = runs[*run].recording.points().filter(|p| pass.is_none_or(|i| i == p.pass));
            let all: Vec<Point> = all.copied().collect();
            let of = |value: fn(&Point) -> [f64; 3]| -> Points {
                all.iter().map(|p| plane.map(|i| value(p)[i])).collect()
            };
            Cow::Owned(match what {
                Contour::Programmed => programmed(&all, plane),
                Contour::Set => of(|p| p.set),
                Contour::Act => of(|p| p.act),
            })
        }
    }
}

/// The two linear axes that move most, in channel order.
pub(super) fn plane(runs: &[Drawn]) -> [usize; 2] {
    let mut spans: Vec<(f64, usize)> =
        (0..3).map(|i| (extent_of(runs, i).map_or(0.0, |e| e.1 - e.0), i)).collect();
    spans.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let (a, b) = (spans[0].1, spans[1].1);
    [a.min(b), a.max(b)]
}

/// The range of an axis over all runs.
pub(super) fn extent_of(runs: &[Drawn], axis: usize) -> Option<(f64, f64)> {
    let values =
        runs.iter().flat_map(|r| r.recording.points()).flat_map(|p| [p.ipo[axis], p.set[axis]]);
    values.filter(|v| v.is_finite()).fold(None, |range, v| {
        let (low, high) = range.unwrap_or((v, v));
        Some((f64::min(low, v), f64::max(high, v)))
    })
}

/// A curve over time: smallest and largest value per pixel in the order of their times, or of each bucket if there are
/// fewer.
fn over_pixels(run: &Recording, curve: usize, pass: Option<usize>, pixels: f64) -> Points {
    let per_px = (run.buckets.len() as f64 / pixels).max(1.0);
    let mut points: Points = Vec::new();
    // in a bucket of several cycles the order of the two values is unknown: begin with the one next to the previous
    // point
    let put = |points: &mut Points, [least, greatest]: [[f64; 2]; 2]| {
        let falls = least[0].to_bits() == greatest[0].to_bits()
            && points.last().is_some_and(|p| (p[1] - greatest[1]).abs() < (p[1] - least[1]).abs());
        let greatest_first = falls || greatest[0] < least[0];
        points.extend(if greatest_first { [greatest, least] } else { [least, greatest] });
    };
    let (mut pixel, mut end, mut extremes) = (None, None, None::<[[f64; 2]; 2]>);
    for (i, bucket) in run.buckets.iter().enumerate() {
        if pass.is_some_and(|p| p != bucket.pass) {
            continue;
        }
        let (low, high) = bucket.range[curve];
        let t = run.seconds(bucket.k);
        let this = Some(libm::floor(i as f64 / per_px));
        match &mut extremes {
            Some([least, greatest]) if this == pixel => {
                if low < least[1] {
                    *least = [t, low];
                }
                if high > greatest[1] {
                    *greatest = [t, high];
                }
            }
            _ => {
                let before = extremes.replace([[t, low], [t, high]]);
                if let Some(before) = before {
                    put(&mut points, before);
                }
                pixel = this;
            }
        }
        end = Some((bucket, low, high));
    }
    if let Some(last) = extremes {
        put(&mut points, last);
    }
    // up to its last cycle
    if let Some((bucket, low, high)) = end.filter(|(bucket, ..)| bucket.last > bucket.k) {
        let t = run.seconds(bucket.last);
        put(&mut points, [[t, low], [t, high]]);
    }
    points
}
