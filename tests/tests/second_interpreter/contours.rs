//! Random contours: tool radius compensation, chamfers and roundings, contour lines by angles.

use super::expressions::decimal;
use super::model::axes_of;
use super::random::{Place, Writer};
use super::tree::{Contour, Expr, Insert, Motion, Statement, Way, Word};

/// Position of a contour, and its direction.
struct Pen {
    plane: u32,
    heading_deg: f64,
}

fn rounded(x: f64) -> f64 {
    (x * 1000.0).round() / 1000.0
}

impl Writer<'_> {
    pub fn contours(&mut self, place: Place) -> Vec<Statement> {
        let plane = if place.turned { 17 } else { self.random.pick(&[17, 17, 18, 19]) };
        let mut all = vec![Statement::Plane(plane), Statement::AbsoluteCentres(false)];
        all.push(self.whole_move());
        let pen = &mut Pen { plane, heading_deg: self.random.between(-180.0, 180.0) };
        match self.random.below(5) {
            // not in turned or mirrored systems
            4 if place.lowest => {
                all.insert(0, Statement::Mirror(20));
                all.push(self.spline());
            }
            0 => all.extend(self.contour_lines(plane)),
            1 => {
                let size = rounded(self.random.between(0.1, 1.5));
                let kind =
                    self.random.pick(&[Insert::Chamfer, Insert::ChamferLength, Insert::Rounding]);
                let first = self.element(pen, 2.0, 0.0);
                self.bend(pen, 120.0);
                all.push(Statement::Corner(kind, size, [first, self.element(pen, 2.0, 0.0)]));
            }
            _ => all.extend(self.compensated(pen, place)),
        }
        all
    }

    /// Turns the direction by a noticeable angle.
    fn bend(&mut self, pen: &mut Pen, most_deg: f64) {
        let by = self.random.between(3.0, most_deg);
        pen.heading_deg += if self.random.chance(0.5) { by } else { -by };
    }

    /// A line or an arc, as increments, several times as long as `size`; `rise` is the largest motion of the third axis.
    fn element(&mut self, pen: &mut Pen, size: f64, rise: f64) -> Motion {
        let [a, b, third] = axes_of(pen.plane);
        let arc = self.random.chance(0.4);
        let mut motion = Motion { number: self.number(), ..Motion::default() };
        motion.absolute = Some(false);
        let (s, c) = libm::sincos(pen.heading_deg.to_radians());
        let (x, y) = if arc {
            let left = self.random.chance(0.5);
            let radius = size * self.random.between(4.0, 9.0);
            let swept = self.random.between(60.0, 200.0);
            let side = if left { 1.0 } else { -1.0 };
            // the end is exact to a thousandth, and the centre on the bisector fits it
            let end = (pen.heading_deg + side * swept).to_radians();
            let (x, y) = (
                rounded(side * radius * (libm::sin(end) - s)),
                rounded(side * radius * (c - libm::cos(end))),
            );
            let height = radius * libm::cos(swept.to_radians() / 2.0);
            let way = libm::hypot(x, y);
            let centre = [x / 2.0 - side * height * y / way, y / 2.0 + side * height * x / way];
            motion.path = Some(if left { 3 } else { 2 });
            let letters = ['I', 'J', 'K'];
            motion.centre = vec![(letters[a], centre[0]), (letters[b], centre[1])];
            pen.heading_deg += side * swept;
            (x, y)
        } else {
            let long = size * self.random.between(6.0, 12.0);
            motion.path = Some(1);
            (rounded(long * c), rounded(long * s))
        };
        let word = |axis: usize, value: f64| Word { axis, value: Expr::Number(value) };
        motion.words = vec![word(a, x), word(b, y)];
        if rise > 0.0 && self.random.chance(0.3) {
            motion.words.push(word(third, decimal(self.random, rise)));
        }
        motion
    }

    fn compensated(&mut self, pen: &mut Pen, place: Place) -> Vec<Statement> {
        let radius = rounded(self.random.between(0.2, 2.0));
        let line = |writer: &mut Self, pen: &Pen| {
            let [a, b, _] = axes_of(pen.plane);
            let mut axes = vec![a, b];
            if writer.random.chance(0.3) {
                axes.reverse();
            }
            // without a motion of its own, G40 would wait for the next motion
            let word = |axis| Word { axis, value: Expr::Number(decimal(writer.random, 30.0)) };
            let words = axes.into_iter().map(word).collect();
            writer.line_to(words, None)
        };
        let approach = line(self, pen);
        let mut elements = Vec::new();
        for _ in 0..1 + self.random.below(5) {
            elements.push(self.element(pen, radius, 5.0));
            if self.random.chance(0.85) {
                self.bend(pen, 110.0);
            }
        }
        // G239 is refused in planes askew to the axes
        let last = if place.lowest { Way::Stays } else { Way::Lines };
        let way = self.random.pick(&[Way::Lines, Way::Perpendicular, last]);
        // within the contour a line leads to the other radius
        let within = 1..elements.len().max(2) - 1;
        let straight = within.rev().find(|i| elements[*i].path == Some(1));
        let changes = way != Way::Perpendicular && self.random.chance(0.4);
        let change = straight
            .filter(|_| changes)
            .map(|i| (i, rounded(radius * self.random.between(0.3, 1.2))))
            // with the same radius nothing changes, and the corners are like all others
            .filter(|(_, other)| (other - radius).abs() > 1e-9);
        let contour = Contour {
            way,
            change,
            left: self.random.chance(0.5),
            by_arcs: self.random.chance(0.5),
            radius,
            in_block: self.random.chance(0.5),
            approach,
            elements,
            exit: line(self, pen),
        };
        vec![Statement::Compensated(contour)]
    }

    /// Points of a spline, far enough apart, as increments or absolute positions: with its start at least three.
    fn spline(&mut self) -> Statement {
        let count = 2 + self.random.below(5);
        let motions = (0..count).map(|_| {
            let word = |axis| {
                let way = self.random.between(1.0, 9.0);
                let way = rounded(if self.random.chance(0.5) { way } else { -way });
                Word { axis, value: Expr::Number(way) }
            };
            let words = [0, 1, 2].map(word).to_vec();
            let absolute = Some(self.random.chance(0.3));
            Motion { number: self.number(), path: Some(1), absolute, words, ..Motion::default() }
        });
        Statement::Spline(motions.collect())
    }

    fn contour_lines(&mut self, plane: u32) -> Vec<Statement> {
        let [a, b, _] = axes_of(plane);
        let word = |axis: usize, value: f64| Word { axis, value: Expr::Number(value) };
        let from: [f64; 3] = std::array::from_fn(|_| decimal(self.random, 20.0));
        let words = (0..3).map(|axis| word(axis, from[axis])).collect();
        let start = self.line_to(words, Some(true));
        if self.random.chance(0.5) {
            // far enough from both axes
            let quarter = self.random.pick(&[0.0, 90.0, 180.0, -90.0]);
            let deg = rounded(quarter + self.random.between(10.0, 80.0));
            let (s, c) = libm::sincos(deg.to_radians());
            let (axis, share) = self.random.pick(&[(a, c), (b, s)]);
            let way = rounded(share * self.random.between(2.0, 15.0));
            let absolute = self.random.chance(0.5);
            let value = if absolute { from[axis] + way } else { way };
            let mut motion = self.line_to(vec![word(axis, value)], Some(absolute));
            motion.angle = Some(deg);
            return vec![Statement::Move(start), Statement::Move(motion)];
        }
        let first = rounded(self.random.between(-180.0, 180.0));
        let turn = self.random.pick(&[1.0, -1.0]) * self.random.between(10.0, 150.0);
        let second = rounded(first + turn);
        let mut to = [from[a], from[b]];
        for deg in [first, second] {
            let (s, c) = libm::sincos(deg.to_radians());
            let long = self.random.between(2.0, 15.0);
            (to[0], to[1]) = (to[0] + long * c, to[1] + long * s);
        }
        let words = vec![word(a, rounded(to[0])), word(b, rounded(to[1]))];
        let one = self.line_to(Vec::new(), Some(true));
        let two = self.line_to(words, Some(true));
        vec![Statement::Move(start), Statement::TwoAngles([first, second], [one, two])]
    }
}
