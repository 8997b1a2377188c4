//! Random programs of lines, arcs, rounded corners and splines, with the geometry that they draw.

use super::measure::{Case, Corner};
use kontur_kit::Random;
use kontur_tests::geometry::{Piece, Point, direction, dot, minus, norm};

/// A program under construction.
pub(crate) struct Writer {
    pub(crate) text: String,
    pub(crate) line: u32,
    pub(crate) at: Point,
    pub(crate) heading: f64,
    pub(crate) blocks: Vec<(u32, Vec<Piece>)>,
    pub(crate) corners: Vec<Corner>,
    /// Commands that take turns after every so many blocks.
    pub(crate) switch: Option<([String; 2], usize)>,
}

impl Writer {
    pub(crate) fn new() -> Self {
        let (text, blocks, corners) = (String::new(), Vec::new(), Vec::new());
        Self { text, line: 0, at: [0.0; 3], heading: 0.0, blocks, corners, switch: None }
    }

    /// The program, whose contour is known exactly; `reach`: number of cycles that its filter reaches back.
    pub(crate) fn case(self, settings: Vec<String>, tolerance_mm: f64, reach: usize) -> Case {
        let Self { text, blocks, corners, .. } = self;
        Case { text, settings, tolerance_mm, off_mm: 0.0, reach, blocks, corners }
    }

    pub(crate) fn put(&mut self, line: &str) {
        self.text += line;
        self.text.push('\n');
        self.line += 1;
    }

    pub(crate) fn motion(&mut self, line: &str, pieces: Vec<Piece>) {
        self.put(line);
        self.blocks.push((self.line, pieces));
        if let Some((commands, every)) = self.switch.clone()
            && self.blocks.len().is_multiple_of(every)
        {
            self.put(&commands[(self.blocks.len() / every - 1) % 2]);
        }
    }

    /// Straight to `p`, naming only the axes that move.
    pub(crate) fn line_to(&mut self, word: &str, p: Point) {
        let moves = |i: &usize| (p[*i] - self.at[*i]).abs() > 0.0;
        let words: Vec<String> = [0, 1, 2]
            .iter()
            .filter(|i| moves(i))
            .map(|&i| format!("{}{}", "XYZ".as_bytes()[i] as char, p[i]))
            .collect();
        if words.is_empty() {
            return;
        }
        let piece = Piece::Line(self.at, p);
        let d = minus(p, self.at);
        self.heading = libm::atan2(d[1], d[0]);
        self.motion(&format!("{word} {}", words.join(" ")), vec![piece]);
        self.at = p;
    }

    pub(crate) fn arc(&mut self, radius: f64, sweep: f64, climb: f64) {
        let from = self.heading - sweep.signum() * std::f64::consts::FRAC_PI_2;
        let centre = [self.at[0] - radius * libm::cos(from), self.at[1] - radius * libm::sin(from)];
        let z = [self.at[2], self.at[2] + climb];
        let piece = Piece::Helix { centre, radius, from, sweep, z };
        let end = piece.end();
        let word = if sweep > 0.0 { "G03" } else { "G02" };
        let z_word = if climb.abs() > 0.0 { format!(" Z{:.12}", end[2]) } else { String::new() };
        let line = format!(
            "{word} X{:.12} Y{:.12}{z_word} I{:.12} J{:.12}",
            end[0],
            end[1],
            centre[0] - self.at[0],
            centre[1] - self.at[1]
        );
        self.motion(&line, vec![piece]);
        self.at = end;
        self.heading += sweep;
    }
}

pub(crate) fn rounded(x: f64) -> f64 {
    (x * 1e5).round() / 1e5
}

/// Lines with any angle between them, of one to three axes, some of them far shorter than the others.
pub(crate) fn polygon(r: &mut Random, w: &mut Writer, scale: f64) {
    for _ in 0..2 + r.below(14) {
        let size = if r.chance(0.3) { r.log(1e-3, 0.3) } else { r.log(0.3, 3.0) };
        let axes = 1 + r.below(7);
        let step = |i: usize, r: &mut Random| {
            if axes >> i & 1 == 1 { rounded(scale * size * r.between(-1.0, 1.0)) } else { 0.0 }
        };
        let p = [0, 1, 2].map(|i| rounded(w.at[i] + step(i, r)));
        let word = if r.chance(0.1) { "G00" } else { "G01" };
        w.line_to(word, p);
    }
}

/// Lines, circles and helices, half of the transitions tangential.
pub(crate) fn arcs(r: &mut Random, w: &mut Writer, scale: f64) {
    for _ in 0..3 + r.below(8) {
        if r.chance(0.5) {
            w.heading += r.between(-3.0, 3.0);
        }
        let size = scale * r.log(0.1, 3.0);
        if r.chance(0.5) {
            let (s, c) = (libm::sin(w.heading), libm::cos(w.heading));
            let p = [w.at[0] + size * c, w.at[1] + size * s, w.at[2]].map(rounded);
            w.line_to("G01", p);
        } else {
            let sweep = r.between(0.2, 6.2) * r.pick(&[-1.0, 1.0]);
            let climb = if r.chance(0.3) { size * r.between(-1.0, 1.0) } else { 0.0 };
            w.arc(size, sweep, climb);
        }
    }
}

/// A path of many blocks shorter than a cycle, with a corner now and then.
pub(crate) fn short_blocks(r: &mut Random, w: &mut Writer, scale: f64) {
    let length = scale * r.log(2e-3, 5e-2);
    let (mut heading, mut turn) = (0.0, 0.0);
    for _ in 0..20 + r.below(40) {
        if r.chance(0.1) {
            turn = r.between(-0.4, 0.4);
        }
        heading += if r.chance(0.06) { r.between(-3.1, 3.1) } else { turn };
        let l = length * r.between(0.3, 1.0);
        let p = [
            w.at[0] + l * libm::cos(heading),
            w.at[1] + l * libm::sin(heading),
            w.at[2] + 0.2 * l * turn,
        ];
        w.line_to("G01", p.map(|c| (c * 1e6).round() / 1e6));
    }
}

/// A polygon whose corners are rounded by G61 or G261.
pub(crate) fn contoured(r: &mut Random, w: &mut Writer, scale: f64) {
    let n = 3 + r.below(8);
    let mut points = vec![w.at];
    let mut before = [1.0, 0.0, 0.0];
    while points.len() <= n {
        let from = points[points.len() - 1];
        let step = [0, 1, 2].map(|i| scale * r.between(-1.5, 1.5) * if i < 2 { 1.0 } else { 0.3 });
        let p = [0, 1, 2].map(|i| rounded(from[i] + step[i]));
        let u = direction(from, p);
        // neither nearly straight on nor nearly back
        if norm(minus(p, from)) > 0.2 * scale && (-0.9..0.9).contains(&dot(before, u)) {
            points.push(p);
            before = u;
        }
    }
    let directions: Vec<Point> = points.windows(2).map(|p| direction(p[0], p[1])).collect();
    let lengths: Vec<f64> = points.windows(2).map(|p| norm(minus(p[1], p[0]))).collect();
    let shortest = lengths.iter().copied().fold(f64::MAX, f64::min);
    let longest_d = 0.45 * shortest;
    let half_turn = |i: usize| {
        let cos = dot(directions[i], directions[i + 1]);
        ((1.0 - cos) / 2.0).max(0.0).sqrt()
    };
    let flattest = (0..n - 1).map(half_turn).fold(1.0, f64::min);
    let dev = r.chance(0.5);
    let d_of: Vec<f64> = if dev {
        let eps = rounded(0.375 * longest_d * flattest * r.between(0.2, 0.95)).max(2e-4);
        w.put(&format!("#CONTOUR MODE [DEV PATH_DEV={eps}]"));
        (0..n - 1).map(|i| eps / (0.375 * half_turn(i))).collect()
    } else {
        let d = rounded(longest_d * r.between(0.1, 0.95)).max(2e-4);
        w.put(&format!("#CONTOUR MODE [DIST PRE_DIST={d} POST_DIST={d}]"));
        vec![d; n - 1]
    };
    let modal = r.chance(0.5);
    if modal {
        w.put("G261");
    }
    let mut started = 0.0;
    for i in 0..n {
        let (a, b, u) = (points[i], points[i + 1], directions[i]);
        let last = i + 1 == n;
        let rounds = !last && (modal || r.chance(0.6));
        let end = if rounds { d_of[i] } else { 0.0 };
        let on = |s: f64| [0, 1, 2].map(|k| a[k] + s * u[k]);
        let mut pieces = vec![Piece::Line(on(started), on(lengths[i] - end))];
        if rounds {
            pieces.extend(Piece::corner(b, end, u, directions[i + 1]));
        }
        started = end;
        let word = match (modal, rounds) {
            (true, false) => "G260 G01",
            (false, true) => "G61 G01",
            _ => "G01",
        };
        w.line_to(word, b);
        if let Some(block) = w.blocks.last_mut() {
            block.1 = pieces;
        }
        if rounds {
            let beyond = [0, 1, 2].map(|k| b[k] + end * directions[i + 1][k]);
            let sides = [Piece::Line(on(lengths[i] - end), b), Piece::Line(b, beyond)];
            w.corners.push(Corner { block: w.blocks.len() - 1, distance_mm: end, sides });
        }
    }
}

/// A polygon under `#HSC ON [BSPLINE]`: long edges with sharp corners, or short ones with some of them; returns `PATH_DEV`.
pub(crate) fn splined(r: &mut Random, w: &mut Writer) -> f64 {
    let path_dev = rounded(r.log(0.002, 0.5));
    w.put(&format!("#HSC ON [BSPLINE PATH_DEV={path_dev}]"));
    let long = r.chance(0.5);
    let (shortest, longest) = if long { (20.0, 50.0) } else { (0.2, 3.0) };
    let edges = if long { 2 + r.below(3) } else { 5 + r.below(30) };
    let climbs = r.chance(0.5);
    let mut heading = 0.0;
    for _ in 0..edges {
        heading += if long || r.chance(0.15) { r.between(-3.1, 3.1) } else { r.between(-0.3, 0.3) };
        let l = r.between(shortest, longest);
        let climb = if climbs { l * r.between(-0.5, 0.5) } else { 0.0 };
        let d = [l * libm::cos(heading), l * libm::sin(heading), climb];
        w.line_to("G01", [0, 1, 2].map(|i| rounded(w.at[i] + d[i])));
    }
    w.put("#HSC OFF");
    path_dev
}

/// Cycles that the Vibration Guard reaches back, with a few for rounding: half periods of the damped vibration.
pub(crate) fn reach_of_guard(mode: usize, freq_hz: f64, damping: f64, cycle_s: f64) -> usize {
    let half_periods = [1.0, 2.0, 3.0, 2.0][mode - 1];
    let length_s = half_periods * 0.5 / (freq_hz * (1.0 - damping * damping).sqrt());
    (length_s / cycle_s).ceil() as usize + 4
}

/// The command that switches a filter on with the tolerance, list entries for it, and its reach in cycles.
pub(crate) fn filter(
    r: &mut Random,
    tolerance: f64,
    cycle_us: u32,
) -> (String, Vec<String>, usize) {
    let cycle_s = 1e-6 * f64::from(cycle_us);
    let lists = |entries: &[String]| -> Vec<String> {
        ["X", "Y", "Z"]
            .iter()
            .flat_map(|a| entries.iter().map(move |e| format!("{a}.{e}")))
            .collect()
    };
    let kind = r.ratio();
    if kind < 0.6 {
        let mode = 1 + r.below(4);
        // a slow cycle has no kernel for a high frequency
        let highest = (0.4 / cycle_s).min(150.0);
        let (freq, damping) = (rounded(r.log(5.0, highest)), rounded(r.between(0.0, 0.3)));
        let command =
            format!("#VIB GUARD ON [MODE={mode} FREQ={freq} DAMPING={damping} AX_DEV={tolerance}]");
        return (command, Vec::new(), reach_of_guard(mode, freq, damping, cycle_s));
    }
    let order = r.log(2.0, 200.0) as usize;
    if kind < 0.8 {
        let kind = 1 + r.below(4);
        let order = if kind == 4 { order.min(100) } else { order };
        let fcut = rounded(r.log(5.0, 0.3 / cycle_s));
        let (quality, share) = (rounded(r.between(0.3, 1.0)), 10 * (5 + r.below(6)));
        let command = format!(
            "#FILTER ON [ORDER={order} SHARE={share} FCUT={fcut} QUALITY={quality} AX_DEV={tolerance}]"
        );
        return (command, lists(&[format!("filter_fir.type={kind}")]), order);
    }
    let entries = ["prototype=HSC", "type=8", "order=10"].map(|e| format!("filter[0].{e}"));
    (format!("#FILTER ON [HSC ORDER={order} AX_DEV={tolerance}]"), lists(&entries), order)
}

/// The command that switches off what another one has switched on.
pub(crate) fn off(command: &str) -> &'static str {
    match command {
        guard if guard.starts_with("#VIB") => "#VIB GUARD OFF",
        hsc if hsc.contains("[HSC") => "#FILTER OFF [HSC]",
        _ => "#FILTER OFF",
    }
}

pub(crate) fn dynamics(r: &mut Random) -> Vec<String> {
    let mut entries = vec![
        "dynamik.a_max=20000".to_owned(),
        "dynamik.a_emergency=20000".to_owned(),
        format!("dynamik.a_trans_weight={}", r.log(20.0, 1000.0) as u32),
    ];
    for key in ["a_beschl", "a_brems", "a_grenz"] {
        entries.push(format!("slope_profil.{key}={}", r.log(500.0, 8000.0) as u32));
    }
    for key in ["a_stufe_1", "a_stufe_2"] {
        entries.push(format!("lslope_profil.{key}={}", r.log(500.0, 8000.0) as u32));
    }
    let ramp = r.log(5000.0, 100_000.0) as u32;
    for key in ["tr_beschl_zu", "tr_beschl_ab", "tr_brems_zu", "tr_brems_ab", "tr_grenz"] {
        entries.push(format!("slope_profil.{key}={ramp}"));
    }
    ["X", "Y", "Z"]
        .iter()
        .flat_map(|a| entries.iter().map(move |e| format!("{a}.getriebe[0].{e}")))
        .collect()
}
