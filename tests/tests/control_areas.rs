//! Workspaces and protection areas: monitoring compared with the set points of the same program without areas.

use kontur_interpreter::diag::Diagnostic;
use kontur_kit::{Random, count, seed};
use kontur_tests::{Run, run};

/// A body over a polygon that is star-shaped about its middle, or over a circle.
struct Body {
    middle: [f64; 2],
    /// Empty: a circle of this radius.
    corners: Vec<[f64; 2]>,
    radius: f64,
    height: [f64; 2],
}

impl Body {
    fn new(random: &mut Random) -> Self {
        let mut within = |size: f64| (random.between(-size, size) * 100.0).round() / 100.0;
        let (middle, low) = ([within(20.0), within(20.0)], within(10.0));
        let height = [low - 12.5, low + 15.25];
        let radius = (random.between(10.0, 60.0) * 100.0).round() / 100.0;
        let count = random.below(7) + 3;
        let mut corner = |i: usize| {
            let angle =
                std::f64::consts::TAU * (i as f64 + random.between(0.0, 0.4)) / count as f64;
            let distance = random.between(10.0, 70.0);
            [libm::cos(angle), libm::sin(angle)].map(|x| (x * distance * 100.0).round() / 100.0)
        };
        let corners: Vec<[f64; 2]> = (0..count).map(&mut corner).collect();
        let corners = corners.iter().map(|c| [c[0] + middle[0], c[1] + middle[1]]).collect();
        let corners = if random.chance(0.4) { Vec::new() } else { corners };
        Self { middle, corners, radius, height }
    }

    fn definition(&self, purpose: &str) -> String {
        let [x, y] = self.middle;
        let kind = if self.corners.is_empty() { "CIRC" } else { "POLY" };
        let [low, high] = self.height;
        let mut text = format!(
            "#CONTROL AREA BEGIN [ID=7 {purpose} {kind} MIN_EXCUR={low} MAX_EXCUR={high}]\nG90\n"
        );
        if self.corners.is_empty() {
            let r = self.radius;
            text += &format!("G00 X{} Y{y}\nG02 X{} Y{y} I{}\n", x + r, x + r, -r);
        }
        for [x, y] in self.corners.iter().chain(self.corners.first()) {
            text += &format!("G01 X{x} Y{y}\n");
        }
        text + "#CONTROL AREA END\n"
    }

    /// Whether a point is inside, by the angles that the sides subtend at it.
    fn holds(&self, [x, y, z]: [f64; 3]) -> bool {
        let [low, high] = self.height;
        let in_base = if self.corners.is_empty() {
            libm::hypot(x - self.middle[0], y - self.middle[1]) <= self.radius
        } else {
            let seen = |c: &[f64; 2]| libm::atan2(c[1] - y, c[0] - x);
            let ends = self.corners.iter().zip(self.corners.iter().cycle().skip(1));
            let turns: f64 = ends
                .map(|(a, b)| {
                    let turn = seen(b) - seen(a);
                    turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round()
                })
                .sum();
            turns.abs() > std::f64::consts::PI
        };
        in_base && (low..=high).contains(&z)
    }

    /// Whether all points at this distance along the axes and their diagonals are inside, or none of them is.
    fn is_clear(&self, [x, y, z]: [f64; 3], distance: f64) -> bool {
        let steps = [-1.0, 0.0, 1.0];
        let mut all = steps.iter().flat_map(|i| steps.iter().map(move |j| (*i, *j)));
        let inside = self.holds([x, y, z]);
        all.all(|(i, j)| {
            steps.iter().all(|k| {
                self.holds([x + i * distance, y + j * distance, z + k * distance]) == inside
            })
        })
    }
}

/// Lines, rapid motions, arcs and chamfers.
fn contour(random: &mut Random) -> String {
    let mut text = String::new();
    let size = random.pick(&[4.0, 20.0, 80.0]);
    for _ in 0..random.below(6) + 1 {
        let mut within = |size: f64| random.between(-size, size);
        let [x, y] = [within(size), within(size)];
        let [z, i, j] = [within(size / 4.0), within(size / 4.0), within(size / 4.0)];
        text += &match random.below(5) {
            0 => format!("G00 X{x:.3} Y{y:.3}\n"),
            1 => format!("G03 I{i:.3} J{j:.3}\n"),
            2 => format!("G301 I1\nG01 X{x:.3} Y{y:.3}\n"),
            _ => format!("G01 X{x:.3} Y{y:.3} Z{z:.3}\n"),
        };
    }
    text
}

fn points(run: &Run) -> Vec<[f64; 3]> {
    let [x, y, z] = [0, 1, 2].map(|axis| run.axis(axis, |a| a.ipo));
    x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]).collect()
}

/// A program that stays in its area runs the same with it; one that does not moves nothing out of it.
#[test]
fn motions_are_where_the_area_lets_them() {
    let (mut kept, mut ended) = (0, 0);
    for k in 0..count(120) as u64 {
        let mut random = Random::new(seed() + k);
        let body = Body::new(&mut random);
        let purpose = random.pick(&["WORK", "PROT"]);
        let may = |inside: bool| inside == (purpose == "WORK");
        let (setup, contour) = ("F6000\nG00 X2 Y3\nG04 0.01\n", contour(&mut random));
        let free = run(&format!("{setup}G01\n{contour}M30\n"), &[]);
        // chamfers that do not fit
        if free.diagnostics.iter().any(Diagnostic::is_error) {
            continue;
        }
        let free = points(&free);
        let watched = run(
            &format!(
                "{setup}{}#CONTROL AREA ON [ID=7]\nG01\n{contour}M30\n",
                body.definition(purpose)
            ),
            &[],
        );
        let what = format!("seed {}: {contour}", seed() + k);
        let driven = points(&watched);
        // on the way to its start the program is not monitored yet
        let is_start = |p: &[f64; 3]| (p[0] - 2.0).abs() + (p[1] - 3.0).abs() < 1e-9;
        let start = free.iter().position(is_start).unwrap();
        if free[start..].iter().all(|p| may(body.holds(*p)) && body.is_clear(*p, 0.3)) {
            assert!(!watched.diagnostics.iter().any(Diagnostic::is_error), "{what}");
            assert_eq!(driven, free, "{what}");
            kept += 1;
        }
        let wrong = |p: &[f64; 3]| !may(body.holds(*p)) && body.is_clear(*p, 0.01);
        if free[start..].iter().any(wrong) {
            assert!(watched.diagnostics.iter().any(Diagnostic::is_error), "{what}");
            // where the check finds a violation nothing moves at all
            let mut driven = driven.iter().skip_while(|p| !is_start(p));
            assert!(wrong(&free[start]) || !driven.any(wrong), "{what}");
            ended += 1;
        }
    }
    assert!(kept > 5 && ended > 5, "{kept} programs kept to their areas, {ended} did not");
}
