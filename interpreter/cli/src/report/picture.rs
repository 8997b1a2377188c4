//! The still picture: contour, a close look at its worst corner or at the largest difference of its passes, path
//! speed and deviations over time.

use super::recording::{Kind, Point, Recording, programmed};
use super::svg::{COLOURS, FAINT, INK, Panel, Stroke, Svg};
use kontur_interpreter::source::text::beginning;
use kontur_interpreter::summary::Summary;

const WIDTH: f64 = 1200.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 1172.0;
/// Lines of the program are marked in the time plots up to this many changes.
const MOST_MARKS: usize = 60;
/// Set points that are compared with the first pass.
const MOST_COMPARED: usize = 2000;
/// Deviations below this are rounding.
const VISIBLE_MM: f64 = 1e-7;

/// What shares a colour: a pass of a single program, or one of several programs.
struct Group {
    run: usize,
    pass: Option<usize>,
    colour: &'static str,
    label: String,
}

impl Group {
    fn draws(&self, point: &Point) -> bool {
        self.pass.is_none_or(|pass| pass == point.pass)
    }
}

/// Draws one or several runs.
pub(super) fn draw(runs: &[(Recording, Summary)]) -> String {
    let mut svg = Svg::new();
    let groups = groups(runs);
    head(&mut svg, runs);
    let plane = plane(runs);
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
    let names = plane.map(|i| axis_label(&runs[0].0, i));
    contour(&mut svg, &panel, &drawn(runs), &groups, plane, "Contour", &names);
    if let Some(look) = look {
        let zoom = zoom_panel(&look, plane, 0.2 * (panel.x.1 - panel.x.0));
        let (a, b) = (panel.at([zoom.x.0, zoom.y.1]), panel.at([zoom.x.1, zoom.y.0]));
        let close = drawn(runs);
        let title = if worst.is_some() { "Largest contour error" } else { "Largest difference" };
        contour(&mut svg, &zoom, &close, &groups, plane, title, &names);
        let size = [(b[0] - a[0]).max(4.0), (b[1] - a[1]).max(4.0)];
        let lens_style = format!("fill=\"{INK}\" fill-opacity=\"0.05\" stroke=\"{INK}\"");
        svg.clip(&panel);
        svg.rect(a, size, &lens_style);
        svg.end_group();
    }
    legend(&mut svg, &groups);
    let top = 640.0 + 20.0 * (groups.len().div_ceil(2) as f64);
    let bottom = times(&mut svg, runs, &groups, top);
    svg.finish(WIDTH, bottom)
}

fn head(svg: &mut Svg, runs: &[(Recording, Summary)]) {
    let title = match runs {
        [(_, one)] => one.program.clone(),
        several => {
            several.iter().map(|(_, s)| s.program.as_str()).collect::<Vec<_>>().join("  ·  ")
        }
    };
    let style = format!("fill=\"{INK}\" font-size=\"20\" font-weight=\"700\"");
    svg.text([LEFT, 36.0], "start", &style, &beginning(&title));
    let mut facts = Vec::new();
    if let Some((_, s)) = runs.first() {
        facts.push(format!("machine {}", s.machine));
        facts.push(format!("cycle {} ms", f64::from(s.cycle_us) / 1000.0));
    }
    if let [(_, s)] = runs {
        facts.push(format!("{:.3} s", s.duration_s));
        facts.push(format!("path {:.3} mm", s.path_length_mm));
        if let Some(e) = s.max_contour_error.as_ref().filter(|e| e.mm > VISIBLE_MM) {
            facts.push(format!("contour error at most {:.4} mm, line {}", e.mm, e.line));
        }
    }
    let style = format!("fill=\"{FAINT}\" font-size=\"13\"");
    svg.text([LEFT, 58.0], "start", &style, &facts.join("  ·  "));
}

fn groups(runs: &[(Recording, Summary)]) -> Vec<Group> {
    let colour = |i: usize| COLOURS[i % COLOURS.len()];
    let of_run = |s: &Summary| s.max_contour_error.as_ref().map_or(0.0, |e| e.mm);
    let errors = runs.iter().any(|(_, s)| of_run(s) > VISIBLE_MM);
    // nobody needs to read that there are none
    let error = |before: &str, mm: f64| {
        if errors { format!("{before}contour error at most {mm:.4} mm") } else { String::new() }
    };
    match runs {
        [(run, _)] if run.passes.len() > 1 => (0..run.passes.len())
            .map(|i| {
                let p = run.passes[i];
                let label = format!(
                    "set, pass {}, lines {} to {}{}",
                    i + 1,
                    p.first_line,
                    p.last_line,
                    error(": ", p.error_mm)
                );
                Group { run: 0, pass: Some(i), colour: colour(i), label }
            })
            .collect(),
        _ => runs
            .iter()
            .enumerate()
            .map(|(i, (_, s))| {
                let error = error(", ", of_run(s));
                let name = if runs.len() > 1 { format!("{}, ", s.program) } else { String::new() };
                let label = format!("set, {name}{:.3} s{error}", s.duration_s);
                Group { run: i, pass: None, colour: colour(i), label }
            })
            .collect(),
    }
}

/// The two linear axes that move most, in channel order.
fn plane(runs: &[(Recording, Summary)]) -> [usize; 2] {
    let mut spans: Vec<(f64, usize)> =
        (0..3).map(|i| (extent_of(runs, i).map_or(0.0, |e| e.1 - e.0), i)).collect();
    spans.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let (a, b) = (spans[0].1, spans[1].1);
    [a.min(b), a.max(b)]
}

fn axis_label(run: &Recording, i: usize) -> String {
    let name = run.plane.get(i).and_then(|&a| run.facts.axes.get(a)).map(|a| a.name.as_str());
    format!("{} in mm", name.unwrap_or("-"))
}

fn extent_of(runs: &[(Recording, Summary)], axis: usize) -> Option<(f64, f64)> {
    let values = runs.iter().flat_map(|(r, _)| r.points()).flat_map(|p| [p.ipo[axis], p.set[axis]]);
    values.filter(|v| v.is_finite()).fold(None, |range, v| {
        let (low, high) = range.unwrap_or((v, v));
        Some((f64::min(low, v), f64::max(high, v)))
    })
}

/// The range of an axis with some air around it.
fn extent(runs: &[(Recording, Summary)], axis: usize) -> (f64, f64) {
    let (low, high) = extent_of(runs, axis).unwrap_or((0.0, 1.0));
    let air = (0.06 * (high - low)).max(1e-3);
    (low - air, high + air)
}

fn worst(runs: &[(Recording, Summary)]) -> Option<Point> {
    let found = runs.iter().filter_map(|(r, _)| r.worst);
    found.max_by(|a, b| a.error.total_cmp(&b.error))
}

/// The set point of a group that is farthest from the first group's path, with its distance as error.
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

/// Distance of a point from the straight way between two others.
fn from_line(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (way, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = way[0] * way[0] + way[1] * way[1];
    let part = (to[0] * way[0] + to[1] * way[1]) / square;
    let part = if square > 0.0 { part.clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(to[0] - part * way[0], to[1] - part * way[1])
}

/// A window around the worst point, three times its error to either side but at most `most` mm.
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
fn drawn(runs: &[(Recording, Summary)]) -> Vec<Vec<Point>> {
    runs.iter().map(|(r, _)| r.points().copied().collect()).collect()
}

fn contour(
    svg: &mut Svg,
    panel: &Panel,
    runs: &[Vec<Point>],
    groups: &[Group],
    plane: [usize; 2],
    title: &str,
    names: &[String; 2],
) {
    svg.axes(panel, title, &names[0], &names[1]);
    svg.clip(panel);
    let wide = Stroke { colour: "#ced4da", width: 5.0, dash: "" };
    for points in runs {
        svg.curve(panel, programmed(points, plane).into_iter(), wide);
    }
    for (actual, width, dash) in [(true, 1.0, "3 3"), (false, 1.7, "")] {
        for group in groups {
            let points = runs[group.run].iter().filter(|p| group.draws(p));
            let at = points.map(|p| if actual { p.act } else { p.set });
            let stroke = Stroke { colour: group.colour, width, dash };
            svg.curve(panel, at.map(|p| [p[plane[0]], p[plane[1]]]), stroke);
        }
    }
    svg.end_group();
}

fn legend(svg: &mut Svg, groups: &[Group]) {
    let style = format!("fill=\"{INK}\"");
    let mut entries: Vec<(Stroke<'_>, &str)> =
        vec![(Stroke { colour: "#ced4da", width: 5.0, dash: "" }, "programmed")];
    let actual = Stroke { colour: INK, width: 1.0, dash: "3 3" };
    entries.push((actual, "actual position (dashed, colour of its set position)"));
    for g in groups {
        entries.push((Stroke { colour: g.colour, width: 2.0, dash: "" }, &g.label));
    }
    for (i, (stroke, label)) in entries.into_iter().enumerate() {
        let x = LEFT + if i % 2 == 0 { 0.0 } else { 560.0 };
        let y = 605.0 + 20.0 * ((i / 2) as f64);
        svg.line([x, y - 4.0], [x + 26.0, y - 4.0], stroke);
        svg.text([x + 34.0, y], "start", &style, label);
    }
}

/// Path speed and, if there are any, deviations over time; gives the lower end of the picture.
fn times(svg: &mut Svg, runs: &[(Recording, Summary)], groups: &[Group], top: f64) -> f64 {
    let end = runs.iter().map(|(_, s)| s.duration_s).fold(0.0, f64::max).max(1e-6);
    let panel = |top: f64, y: (f64, f64)| Panel {
        left: LEFT,
        top,
        width: RIGHT - LEFT,
        height: 130.0,
        x: (0.0, end),
        y,
    };
    let range = |kinds: &[Kind]| {
        let all = runs.iter().flat_map(|(r, _)| {
            let wanted = r.curves.iter().enumerate().filter(|(_, c)| kinds.contains(&c.kind));
            wanted.flat_map(|(i, _)| r.buckets.iter().map(move |b| b.range[i]))
        });
        let (low, high) = all.fold((0.0, 0.0), |m: (f64, f64), r| (m.0.min(r.0), m.1.max(r.1)));
        // room for the numbers of the lines
        let air = (0.16 * (high - low)).max(1e-6);
        (if low < 0.0 { low - air } else { low }, high + air)
    };
    let speed = panel(top + 20.0, range(&[Kind::Speed]));
    marks(svg, &speed, runs);
    // one program: what AX_DEV bounds, axis by axis; several: one curve each
    let one = runs.len() == 1;
    let kind = if one { Kind::Deviation } else { Kind::ContourError };
    let deviates = runs.iter().any(|(r, _)| {
        let wanted = r.curves.iter().enumerate().filter(|(_, c)| c.kind == kind);
        let mut ranges = wanted.flat_map(|(i, _)| r.buckets.iter().map(move |b| b.range[i]));
        ranges.any(|(low, high)| low.abs().max(high.abs()) > VISIBLE_MM)
    });
    svg.axes(&speed, "Path speed", if deviates { "" } else { "time in s" }, "mm/s");
    svg.clip(&speed);
    for g in groups {
        let run = &runs[g.run].0;
        let stroke = Stroke { colour: g.colour, width: 1.5, dash: "" };
        svg.curve(&speed, over_time(run, 0, g.pass).into_iter(), stroke);
    }
    svg.end_group();
    if !deviates {
        return top + 210.0;
    }
    let deviation = panel(top + 210.0, range(&[kind]));
    marks(svg, &deviation, runs);
    let title = if one { "Deviation from the contour by axis" } else { "Contour error" };
    svg.axes(&deviation, title, "time in s", "mm");
    let mut labels = Vec::new();
    svg.clip(&deviation);
    for (r, (run, _)) in runs.iter().enumerate() {
        let curves = run.curves.iter().enumerate().filter(|(_, c)| c.kind == kind);
        for (n, (i, curve)) in curves.enumerate() {
            let colour = COLOURS[if one { n + 3 } else { r } % COLOURS.len()];
            let stroke = Stroke { colour, width: 1.3, dash: "" };
            svg.curve(&deviation, over_time(run, i, None).into_iter(), stroke);
            if one {
                labels.push((colour, curve.name.clone()));
            }
        }
    }
    svg.end_group();
    for (i, (colour, name)) in labels.iter().rev().enumerate() {
        let style = format!("fill=\"{colour}\" font-weight=\"700\"");
        svg.text([RIGHT - 18.0 * i as f64, deviation.top - 9.0], "end", &style, name);
    }
    top + 400.0
}

/// A curve over time: smallest and largest value per pixel, or of each bucket where there are fewer.
fn over_time(run: &Recording, curve: usize, pass: Option<usize>) -> Vec<[f64; 2]> {
    let per_px = (run.buckets.len() as f64 / (RIGHT - LEFT)).max(1.0);
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut pixel = None;
    for (i, bucket) in run.buckets.iter().enumerate() {
        if pass.is_some_and(|p| p != bucket.pass) {
            continue;
        }
        let (low, high) = bucket.range[curve];
        let t = run.seconds(bucket.k);
        let this = Some(libm::floor(i as f64 / per_px));
        if this == pixel
            && let [.., bottom, top] = points.as_mut_slice()
        {
            bottom[1] = bottom[1].min(low);
            top[1] = top[1].max(high);
        } else {
            pixel = this;
            points.extend([[t, low], [t, high]]);
        }
    }
    points
}

/// Where the line of the program changes, with the line's number where there is room.
fn marks(svg: &mut Svg, panel: &Panel, runs: &[(Recording, Summary)]) {
    let [(run, _)] = runs else { return };
    let mut starts: Vec<(f64, u32)> = Vec::new();
    for b in &run.buckets {
        if starts.last().is_none_or(|s| s.1 != b.line) {
            starts.push((panel.at([run.seconds(b.k), 0.0])[0], b.line));
        }
    }
    if starts.len() > MOST_MARKS {
        return;
    }
    let end = panel.left + panel.width;
    for (i, &(x, line)) in starts.iter().enumerate() {
        let next = starts.get(i + 1).map_or(end, |n| n.0);
        let shade = if i % 2 == 0 { "#f8f9fa" } else { "#ffffff" };
        let size = [next - x, panel.height];
        svg.rect([x, panel.top], size, &format!("fill=\"{shade}\""));
        let text = line.to_string();
        if line > 0 && next - x > 7.0 * text.len() as f64 + 4.0 {
            let style = "fill=\"#adb5bd\" font-size=\"10\"";
            let at = [f64::midpoint(x, next), panel.top + 12.0];
            svg.text(at, "middle", style, &text);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_are_compared_with_the_path_of_the_first() {
        let point =
            |pass: usize, x: f64, y: f64| Point { pass, set: [x, y, 0.0], ..Point::default() };
        // the corner in (1, 0), and what cuts it
        let runs = [vec![
            point(0, 0.0, 0.0),
            point(0, 1.0, 0.0),
            point(0, 1.0, 1.0),
            point(1, 0.5, 0.0),
            point(1, 0.7, 0.2),
            point(1, 1.0, 0.5),
        ]];
        let group =
            |pass| Group { run: 0, pass: Some(pass), colour: COLOURS[0], label: String::new() };
        let far = farthest(&runs, &[group(0), group(1)], [0, 1]).unwrap();
        assert!((far.set[0] - 0.7).abs() < 1e-15 && far.pass == 1, "{far:?}");
        assert!((far.error - 0.2).abs() < 1e-15, "{}", far.error);
        assert_eq!(farthest(&runs, &[group(0)], [0, 1]), None);
        // beyond an end the end counts, and a way without length is a point
        assert!((from_line([4.0, 4.0], [0.0, 0.0], [1.0, 0.0]) - 5.0).abs() < 1e-15);
        assert!((from_line([3.0, 4.0], [0.0, 0.0], [0.0, 0.0]) - 5.0).abs() < 1e-15);
    }
}
