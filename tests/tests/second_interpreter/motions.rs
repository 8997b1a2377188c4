//! Motions of the model: from words to pieces of the path.

use super::model::{Model, axes_of};
use super::offset;
use super::path::{Piece, Point};
use super::spline;
use super::tree::{Contour, Motion, Statement, Way};
use std::f64::consts::TAU;

impl Model<'_> {
    pub fn motions(&mut self, statement: &Statement) {
        match statement {
            Statement::Move(motion) => {
                let piece = self.motion(motion);
                self.drive(&[piece]);
            }
            Statement::Compensated(contour) => {
                let pieces = self.contour(contour);
                let plane = axes_of(self.modal.plane);
                let way = offset::compensated(contour, &pieces, plane);
                self.narrow |= way.is_none();
                let way = way.unwrap_or_default();
                self.drive(&way);
                if let (Way::Stays, Some(last)) = (contour.way, way.last()) {
                    self.machine = self.map().of(last.at(1.0));
                }
                if contour.way != Way::Lines {
                    let exit = self.motion(&contour.exit);
                    self.drive(&[exit]);
                }
            }
            Statement::Spline(motions) => {
                let lines: Vec<Piece> = motions.iter().map(|motion| self.motion(motion)).collect();
                self.drive(&spline::akima(&lines));
            }
            Statement::Corner(kind, size, [first, second]) => {
                let pieces = [self.motion(first), self.motion(second)];
                let plane = axes_of(self.modal.plane);
                self.drive(&offset::inserted(*kind, *size, &pieces, plane));
            }
            Statement::TwoAngles([first, second], [one, two]) => {
                let piece = self.motion(two);
                let (from, to) = (piece.at(0.0), piece.at(1.0));
                let [a, b, _] = axes_of(self.modal.plane);
                // both lines as normals and distances, solved by Cramer's rule
                let line = |deg: f64, p: Point| {
                    let (s, c) = libm::sincos(deg.to_radians());
                    [-s, c, -s * p[a] + c * p[b]]
                };
                let (l, m) = (line(*first, from), line(*second, to));
                let determinant = l[0] * m[1] - l[1] * m[0];
                let mut corner = from;
                corner[a] = (l[2] * m[1] - l[1] * m[2]) / determinant;
                corner[b] = (l[0] * m[2] - l[2] * m[0]) / determinant;
                let pieces =
                    [Piece::line(one.number, from, corner), Piece::line(two.number, corner, to)];
                self.drive(&pieces);
            }
            Statement::Suppressed(motion) => {
                let mut to = self.machine;
                for word in &motion.words {
                    to[word.axis] = self.value(&word.value);
                }
                self.driven.push(Piece::line(motion.number, self.machine, to));
                self.machine = to;
            }
            _ => unreachable!("{statement:?}"),
        }
    }

    /// Pieces in the coordinates of the program.
    fn drive(&mut self, pieces: &[Piece]) {
        let map = self.map();
        for piece in pieces {
            let piece = piece.moved(&map);
            if piece.length > 1e-9 {
                self.driven.push(piece);
            }
        }
    }

    fn contour(&mut self, contour: &Contour) -> Vec<Piece> {
        let exit = Some(&contour.exit).filter(|_| contour.way == Way::Lines);
        let all = [&contour.approach].into_iter().chain(&contour.elements).chain(exit);
        all.map(|motion| self.motion(motion)).collect()
    }

    /// A motion in the coordinates of the program; the machine is at its end.
    fn motion(&mut self, motion: &Motion) -> Piece {
        self.plane(motion.plane.unwrap_or(self.modal.plane));
        self.modal.absolute = motion.absolute.unwrap_or(self.modal.absolute);
        self.modal.path = motion.path.unwrap_or(self.modal.path);
        if let Some(group) = motion.group {
            self.select(group);
        }
        let map = self.map();
        let from = map.back(self.machine);
        let mut to = from;
        for word in &motion.words {
            let value = self.value(&word.value) * self.unit(word.axis);
            to[word.axis] = if self.modal.absolute { value } else { from[word.axis] + value };
        }
        if let Some(deg) = motion.angle {
            let [a, b, _] = axes_of(self.modal.plane);
            let slope = libm::tan(deg.to_radians());
            let given = |axis| motion.words.iter().any(|word| word.axis == axis);
            if given(a) {
                to[b] = from[b] + (to[a] - from[a]) * slope;
            } else {
                to[a] = from[a] + (to[b] - from[b]) / slope;
            }
        }
        self.machine = map.of(to);
        if self.modal.path < 2 {
            Piece::line(motion.number, from, to)
        } else {
            self.arc(motion, from, to)
        }
    }

    fn arc(&mut self, motion: &Motion, from: Point, to: Point) -> Piece {
        self.modal.radius = motion.radius.unwrap_or(self.modal.radius);
        let [a, b, third] = axes_of(self.modal.plane);
        let against_the_clock = self.modal.path == 3;
        let (dx, dy) = (to[a] - from[a], to[b] - from[b]);
        let way = libm::hypot(dx, dy);
        let centre = if motion.centre.is_empty() {
            let radius = self.modal.radius * self.unit(a);
            // the short arc counter-clockwise has its centre to the left of the chord
            let height = (radius * radius - way * way / 4.0).max(0.0).sqrt();
            let left = if against_the_clock == (radius > 0.0) { height } else { -height };
            let middle = [(from[a] + to[a]) / 2.0, (from[b] + to[b]) / 2.0];
            [middle[0] - left * dy / way, middle[1] + left * dx / way]
        } else {
            let base = if self.modal.absolute_centres { [0.0; 3] } else { from };
            let given = |axis: usize| {
                let letter = ['I', 'J', 'K'][axis];
                let value = motion.centre.iter().find(|(l, _)| *l == letter);
                value.map_or(0.0, |(_, value)| *value) * self.unit(axis)
            };
            let centre = [base[a] + given(a), base[b] + given(b)];
            // G165, in force from the start: the projection of the centre onto the bisector of the chord
            let off = ((centre[0] - (from[a] + to[a]) / 2.0) * dx
                + (centre[1] - (from[b] + to[b]) / 2.0) * dy)
                / (way * way);
            if way > 1e-6 { [centre[0] - off * dx, centre[1] - off * dy] } else { centre }
        };
        let angle_of = |p: Point| libm::atan2(p[b] - centre[1], p[a] - centre[0]);
        let mut angle = angle_of(to) - angle_of(from);
        if !against_the_clock {
            angle = -angle;
        }
        while angle <= 1e-9 {
            angle += TAU;
        }
        while angle > TAU + 1e-9 {
            angle -= TAU;
        }
        // radius vector, and the same rotated by a quarter turn
        let (x, y) = (from[a] - centre[0], from[b] - centre[1]);
        let sense = if against_the_clock { 1.0 } else { -1.0 };
        let (mut u, mut v, mut c, mut rise) = ([0.0; 3], [0.0; 3], from, [0.0; 3]);
        (u[a], u[b], v[a], v[b]) = (x, y, -sense * y, sense * x);
        (c[a], c[b], rise[third]) = (centre[0], centre[1], to[third] - from[third]);
        Piece::arc(motion.number, c, [u, v], angle, rise)
    }
}
