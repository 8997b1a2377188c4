//! Random contours that are enlarged or reduced (`#SCALE`).
//!
//! The page describes lines, arcs and helices from the zero point of the active system: in a scaled part nothing else is written except
//! changes of offsets, which are not scaled. Arcs need equal factors in their plane.

use super::expressions::{PARAMETERS, both, decimal, name};
use super::model::axes_of;
use super::random::{Place, Writer};
use super::tree::{Expr, Motion, Operator, Statement, Word};

impl Writer<'_> {
    /// A scaled part, in the middle of the program.
    pub fn scaled(&mut self, place: Place) -> Vec<Statement> {
        let plane = self.random.pick(&[17, 18, 19]);
        let [a, b, third] = axes_of(plane);
        let factor = |writer: &mut Self| writer.random.pick(&[0.25, 0.5, 1.0, 1.25, 2.0, 3.5]);
        let same = factor(self);
        let mut factors = vec![(a, same), (third, factor(self)), (b, same)];
        // an axis without a word keeps its factor, which may differ from that of the other axis
        let arcs = !self.random.chance(0.3);
        if !arcs {
            factors = vec![(self.random.below(3), same)];
        }
        // the length of the tool changes its axis with the plane
        let mut body =
            vec![Statement::AbsoluteCentres(false), Statement::Plane(plane), self.whole_move()];
        for _ in 0..1 + self.random.below(6) {
            match self.random.below(5) {
                0 => body.extend(self.offset()),
                1 | 2 if arcs => body.push(self.scaled_arc([a, b, third])),
                _ => body.push(self.scaled_line(place)),
            }
        }
        vec![Statement::Scaled(self.random.chance(0.5), factors, body), self.whole_move()]
    }

    /// A change of offsets and all axes.
    fn offset(&mut self) -> Vec<Statement> {
        let axis = self.random.below(3);
        let change = match self.random.below(3) {
            0 => Statement::Group(self.random.pick(&[0, 1, 2, 3])),
            1 => Statement::MirrorAxis(axis, self.random.chance(0.5)),
            _ => {
                let value = Expr::Number(decimal(self.random, 3.0));
                Statement::Preset(vec![Word { axis, value }])
            }
        };
        vec![change, self.whole_move()]
    }

    fn scaled_line(&mut self, place: Place) -> Statement {
        let mut axes = vec![2, 0, 1];
        axes.truncate(1 + self.random.below(3));
        let mut words = Vec::new();
        for axis in axes {
            let value = if self.random.chance(0.3) && !place.cycle {
                let parameter = name(format!("P{}", 1 + self.random.below(PARAMETERS as usize)));
                both(Operator::Mod, parameter, Expr::Number(30.0))
            } else {
                Expr::Number(decimal(self.random, 30.0))
            };
            words.push(Word { axis, value });
        }
        let absolute = self.random.pick(&[None, Some(true), Some(false)]);
        Statement::Move(self.line_to(words, absolute))
    }

    /// By its radius, by its centre, or a full circle; in increments, with or without a motion of the third axis.
    fn scaled_arc(&mut self, [a, b, third]: [usize; 3]) -> Statement {
        let (x, y) = (decimal(self.random, 12.0), 0.5 + decimal(self.random, 12.0).abs());
        let way = libm::hypot(x, y);
        let word = |axis, value| Word { axis, value: Expr::Number(value) };
        let letters = [['I', 'J', 'K'][a], ['I', 'J', 'K'][b]];
        let mut arc = Motion {
            path: Some(2 + self.random.below(2) as u32),
            absolute: Some(false),
            words: vec![word(a, x), word(b, y)],
            ..Motion::default()
        };
        match self.random.below(3) {
            0 => {
                let radius = way * self.random.between(0.51, 2.0);
                arc.radius = Some(if self.random.chance(0.5) { radius } else { -radius });
            }
            1 => {
                let height = decimal(self.random, 8.0);
                let centre = [x / 2.0 - height * y / way, y / 2.0 + height * x / way];
                arc.centre = vec![(letters[0], centre[0]), (letters[1], centre[1])];
            }
            _ => {
                arc.words.clear();
                arc.centre = vec![(letters[0], x), (letters[1], y)];
            }
        }
        if self.random.chance(0.4) {
            arc.words.push(word(third, decimal(self.random, 9.0)));
        }
        arc.number = self.number();
        Statement::Move(arc)
    }
}
