//! Random changes of offsets and frames.

use super::expressions::{both, decimal};
use super::random::{Place, Writer};
use super::tree::{Expr, Operator, Statement, Word};

impl Writer<'_> {
    /// A change of offsets or frames, increments, and all axes.
    fn changed(&mut self, place: Place, change: Statement) -> Vec<Statement> {
        let mut all = vec![change];
        // below all rotations every axis takes over its offset independently
        if place.lowest && self.random.chance(0.4) {
            for _ in 0..self.random.below(4) {
                all.extend(self.lines(place));
            }
            return all;
        }
        for _ in 0..self.random.below(2) {
            let axis = self.random.below(3);
            let words = vec![Word { axis, value: Expr::Number(decimal(self.random, 9.0)) }];
            all.push(Statement::Move(self.line_to(words, Some(false))));
        }
        all.push(self.whole_move());
        all
    }

    pub fn offsets(&mut self, place: Place) -> Vec<Statement> {
        let change = match self.random.below(10) {
            0 => {
                let group = self.random.pick(&[0, 1, 2, 3, 9]);
                let Statement::Move(mut motion) = self.whole_move() else { unreachable!() };
                motion.group = Some(group);
                return vec![Statement::Move(motion)];
            }
            1 | 2 => Statement::Group(self.random.pick(&[0, 1, 2, 3, 9])),
            3 => {
                let axis = self.random.below(3);
                let value = both(Operator::Mod, self.value(place, 1), Expr::Number(9.0));
                Statement::Table(self.random.pick(&[1, 2, 3, 9]), axis, value)
            }
            4 => {
                if self.random.chance(0.5) {
                    Statement::Mirror(20 + self.random.below(4) as u32)
                } else {
                    Statement::MirrorAxis(self.random.below(3), self.random.chance(0.5))
                }
            }
            6 if !place.cycle => Statement::Tool(self.random.below(4) as u32),
            // also in coordinate systems
            7 if place.lowest || (place.framed > 0 && !place.turned && !place.machine) => {
                let mut all = vec![Statement::Mirror(20), self.whole_move()];
                if self.random.chance(0.3) {
                    all.push(Statement::PresetOff);
                } else {
                    let axis = self.random.below(3);
                    let value = Expr::Number(decimal(self.random, 9.0));
                    all.push(Statement::PositionPreset(vec![Word { axis, value }]));
                }
                all.extend(self.lines(place));
                all.push(self.whole_move());
                return all;
            }
            8 if place.lowest => {
                let mut axes = vec![2, 0, 1];
                axes.remove(self.random.below(3));
                let words = self.words(place, &axes);
                let motion = self.line_to(words, Some(true));
                let on = Statement::Suppressed(motion);
                return vec![Statement::Mirror(20), on, self.whole_move()];
            }
            _ => {
                // repeated increments stay small
                let axis = self.random.below(3);
                let value = Expr::Number(decimal(self.random, 3.0));
                Statement::Preset(vec![Word { axis, value }])
            }
        };
        self.changed(place, change)
    }

    pub fn frames(&mut self, place: Place) -> Vec<Statement> {
        let inside = place.inside();
        let (open, close, place) = match self.random.below(6) {
            5 => return self.scaled(place),
            4 if place.lowest => {
                let count = 1 + self.random.below(4);
                let systems = (0..count).map(|_| self.place_of_system()).collect();
                let selected = 1 + self.random.below(count);
                let off = Statement::StackOff(count, self.random.chance(0.5));
                // systems of the two kinds are not combined
                (Statement::Stack(systems, selected), off, Place { framed: 4, ..inside })
            }
            0 => {
                let deg = decimal(self.random, 170.0);
                let centre = [decimal(self.random, 9.0), decimal(self.random, 9.0)];
                let word = self.random.chance(0.5);
                let off = Statement::RotationOff(word);
                (Statement::Rotation(word, deg, centre), off, Place { turned: true, ..inside })
            }
            1 => {
                let place = Place { machine: true, callable: 0, ..inside };
                let mut body = self.statements(place, 3);
                let first = self.whole_move();
                body.insert(0, first);
                let mut all = vec![Statement::Machine(body)];
                all.push(self.whole_move());
                return all;
            }
            _ => {
                let values = self.place_of_system();
                // P-CHAN-00394: with the second angle within a quarter turn there is only one reading
                let all = place.lowest && self.random.chance(0.3);
                let off = Statement::SystemOff(all);
                let on = if self.random.chance(0.5) {
                    Statement::System(values)
                } else {
                    // a number that is not in use (20825)
                    Statement::StoredSystem(inside.framed as u32, values)
                };
                (on, off, inside)
            }
        };
        let mut all = self.changed(inside, open);
        all.extend(self.statements(place, 4));
        all.extend(self.changed(inside, close));
        all
    }

    fn place_of_system(&mut self) -> [f64; 6] {
        let mut values = [0.0; 6];
        for (i, value) in values.iter_mut().enumerate() {
            if i < 3 || self.random.chance(0.6) {
                *value = decimal(self.random, if i < 3 { 9.0 } else { 170.0 });
            }
        }
        values
    }
}
