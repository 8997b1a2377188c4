//! Random programs that have exactly one meaning by the manual.
//!
//! Where the manual says nothing, nothing is written: after every change of offsets or frames, where a rotation or a system may couple
//! the axes, all of them are programmed absolutely (before it only in increments), arcs have ends that fit their centres, and loops end.

use super::expressions::{PARAMETERS, PASSED, TABLE, both, decimal, name, of};
use super::model::axes_of;
use super::tree::{Expr, Function, Kind, Motion, Operator, Program, Statement, Subroutine, Word};
use kontur_kit::Random;

/// Place of a statement.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Subroutines with smaller numbers may be called.
    pub callable: usize,
    pub cycle: bool,
    /// In a separate file, which does not see local subroutines.
    pub global: bool,
    pub depth: usize,
    pub breaks: bool,
    pub continues: bool,
    /// Coordinate systems in force here and where subroutines may be called.
    pub framed: usize,
    /// A contour rotation stays in its plane.
    pub turned: bool,
    /// Machine coordinates: without changes of offsets or frames.
    pub machine: bool,
    /// In the main program, below all systems and rotations.
    pub lowest: bool,
}

pub struct Writer<'a> {
    pub random: &'a mut Random,
    motions: usize,
    names: usize,
    kinds: Vec<Kind>,
}

pub fn program(random: &mut Random) -> Program {
    let mut writer = Writer { random, motions: 0, names: 0, kinds: Vec::new() };
    let mut subroutines = Vec::new();
    for callable in 0..writer.random.below(4) {
        let kind =
            writer.random.pick(&[Kind::Local, Kind::Global, Kind::LocalCycle, Kind::GlobalCycle]);
        let cycle = matches!(kind, Kind::LocalCycle | Kind::GlobalCycle);
        let global = matches!(kind, Kind::Global | Kind::GlobalCycle);
        let place = Place { callable, cycle, global, ..Place::SUBROUTINE };
        let mut body = vec![Statement::Local("V.L.A".to_owned(), writer.literal())];
        body.extend(writer.statements(place, 4));
        subroutines.push(Subroutine { kind, body });
        writer.kinds.push(kind);
    }
    let mut main = writer.beginning();
    let place = Place { callable: subroutines.len(), ..Place::TOP };
    main.extend(writer.statements(place, 10));
    Program { subroutines, main }
}

impl Place {
    const TOP: Self = Self {
        callable: 0,
        cycle: false,
        global: false,
        depth: 0,
        breaks: false,
        continues: false,
        framed: 0,
        turned: false,
        machine: false,
        lowest: true,
    };

    /// Systems of the caller, and those of the subroutine.
    const SUBROUTINE: Self = Self { framed: 2, lowest: false, ..Self::TOP };

    fn deeper(self) -> Self {
        Self { depth: self.depth + 1, ..self }
    }

    fn loops(self) -> Self {
        Self { breaks: true, continues: true, ..self.deeper() }
    }

    /// Inside a frame that must be left at its end: there is no way out but the end.
    pub fn inside(self) -> Self {
        Self {
            lowest: false,
            breaks: false,
            continues: false,
            framed: self.framed + 1,
            ..self.deeper()
        }
    }
}

impl Writer<'_> {
    /// Every parameter and variable has a value, so that none is read before it is written.
    fn beginning(&mut self) -> Vec<Statement> {
        let mut all = vec![
            Statement::Local("V.L.A".to_owned(), self.literal()),
            Statement::Local("V.CYC.A".to_owned(), self.literal()),
        ];
        let values = |random: &mut Random| (0..TABLE).map(|_| decimal(random, 9.0)).collect();
        all.push(Statement::Array("V.P.TAB".to_owned(), values(self.random)));
        all.push(Statement::Array("P100".to_owned(), values(self.random)));
        for i in 1..=PARAMETERS {
            all.push(Statement::Assign(name(format!("P{i}")), self.literal()));
        }
        // numbers of parameters
        for i in 7..=8 {
            let number = 1 + self.random.below(PARAMETERS as usize);
            all.push(Statement::Assign(name(format!("P{i}")), Expr::Number(number as f64)));
        }
        for i in ["A", "B"] {
            all.push(Statement::Assign(name(format!("V.P.{i}")), self.literal()));
        }
        for group in [1, 2, 3, 9] {
            let axis = self.random.below(3);
            all.push(Statement::Table(group, axis, self.literal()));
        }
        for tool in 1..=3 {
            let (radius, length) = (self.random.below(5) as f64, decimal(self.random, 20.0));
            let offsets = std::array::from_fn(|_| decimal(self.random, 4.0));
            all.push(Statement::ToolData(tool, radius, length, offsets));
        }
        all.push(self.whole_move());
        all
    }

    fn fresh(&mut self) -> usize {
        self.names += 1;
        self.names
    }

    pub fn number(&mut self) -> usize {
        self.motions += 1;
        self.motions
    }

    pub fn words(&mut self, place: Place, axes: &[usize]) -> Vec<Word> {
        axes.iter().map(|axis| Word { axis: *axis, value: self.coordinate(place) }).collect()
    }

    pub fn line_to(&mut self, words: Vec<Word>, absolute: Option<bool>) -> Motion {
        let path = Some(self.random.below(2) as u32);
        Motion { number: self.number(), path, absolute, words, ..Motion::default() }
    }

    /// All axes, absolutely.
    pub fn whole_move(&mut self) -> Statement {
        let axes = self.random.pick(&[[0, 1, 2], [2, 0, 1], [1, 0, 2]]);
        let literal = |axis| Word { axis, value: Expr::Number(decimal(self.random, 30.0)) };
        let words = axes.map(literal).to_vec();
        Statement::Move(self.line_to(words, Some(true)))
    }

    pub fn statements(&mut self, place: Place, most: usize) -> Vec<Statement> {
        let count = 1 + self.random.below(most);
        let mut all = Vec::new();
        for _ in 0..count {
            all.extend(self.statement(place));
            if place.breaks && self.random.chance(0.15) {
                let condition = self.condition(place, 1);
                let leaves = if place.continues && self.random.chance(0.5) {
                    Statement::Continue
                } else {
                    Statement::Break
                };
                all.push(Statement::If(vec![(condition, vec![leaves])], None));
            }
        }
        all
    }

    fn statement(&mut self, place: Place) -> Vec<Statement> {
        match self.random.below(25) {
            0..=3 => self.lines(place),
            4..=6 => self.arcs(place),
            7 | 8 => self.contours(place),
            9 | 10 => vec![self.assignment(place)],
            11..=14 if !place.machine => self.offsets(place),
            15..=17 if place.framed < 4 && !place.turned && !place.machine => self.frames(place),
            18..=21 if place.depth < 4 => self.control(place),
            22 | 23 if place.callable > 0 && place.framed < 3 && !place.turned => self.call(place),
            _ => self.lines(place),
        }
    }

    pub fn lines(&mut self, place: Place) -> Vec<Statement> {
        let mut axes = vec![0, 1, 2];
        axes.remove(self.random.below(3));
        if self.random.chance(0.5) {
            axes.remove(self.random.below(2));
        }
        let absolute = self.random.pick(&[None, Some(true), Some(false)]);
        let words = self.words(place, &axes);
        let mut all = Vec::new();
        if self.random.chance(0.2) {
            all.push(Statement::Absolute(self.random.chance(0.6)));
        }
        all.push(Statement::Move(self.line_to(words, absolute)));
        if self.random.chance(0.3) {
            // G00 or G01 is in force
            let axis = self.random.below(3);
            let words = self.words(place, &[axis]);
            let number = self.number();
            all.push(Statement::Move(Motion { number, words, ..Motion::default() }));
        }
        if self.random.chance(0.1) && !place.cycle {
            all.push(self.whole_move());
            let axis = self.random.pick(&["X", "Y", "Z"]);
            let to = 1 + self.random.below(PARAMETERS as usize);
            let value = name(format!("V.A.ABS.{axis}"));
            all.push(Statement::Assign(name(format!("P{to}")), value));
        }
        all
    }

    fn arcs(&mut self, place: Place) -> Vec<Statement> {
        let plane = if place.turned { 17 } else { self.random.pick(&[17, 18, 19]) };
        let [a, b, third] = axes_of(plane);
        let letters = [['I', 'J', 'K'][a], ['I', 'J', 'K'][b]];
        // the length of the tool changes its axis with the plane
        let mut all = vec![Statement::Plane(plane), self.whole_move()];
        let path = Some(2 + self.random.below(2) as u32);
        let (x, y) = (decimal(self.random, 12.0), 0.5 + decimal(self.random, 12.0).abs());
        let way = libm::hypot(x, y);
        let mut arc = Motion { path, ..Motion::default() };
        if self.random.chance(0.3) {
            arc.plane = Some(plane);
        }
        // a centre on the bisector of the chord
        let height = decimal(self.random, 8.0);
        // next to the bisector it is corrected, by up to 5 % of the radius and 2 mm (P-CHAN-00059, 00060)
        let aside =
            if self.random.chance(0.3) { 0.03 * libm::hypot(height, way / 2.0) / way } else { 0.0 };
        let aside = self.random.between(-aside, aside);
        let centre =
            [x / 2.0 - height * y / way + aside * x, y / 2.0 + height * x / way + aside * y];
        let word = |axis: usize, value: f64| Word { axis, value: Expr::Number(value) };
        let mut holds = false;
        match self.random.below(4) {
            0 => {
                all.push(Statement::AbsoluteCentres(false));
                arc.centre = vec![(letters[0], x), (letters[1], y)];
            }
            1 => {
                arc.absolute = Some(false);
                arc.words = vec![word(a, x), word(b, y)];
                if self.random.chance(0.5) {
                    let longer = way * self.random.between(0.51, 2.0);
                    let signed = if self.random.chance(0.5) { longer } else { -longer };
                    if self.random.chance(0.4) {
                        all.push(Statement::Radius(longer));
                    } else {
                        arc.radius = Some(signed);
                    }
                    holds = self.random.chance(0.4);
                } else {
                    all.push(Statement::AbsoluteCentres(false));
                    arc.centre = vec![(letters[0], centre[0]), (letters[1], centre[1])];
                }
            }
            _ => {
                let from: [f64; 3] = std::array::from_fn(|_| decimal(self.random, 20.0));
                let words = (0..3).map(|axis| word(axis, from[axis])).collect();
                let absolute_centres = self.random.chance(0.5);
                all.push(Statement::AbsoluteCentres(absolute_centres));
                all.push(Statement::Move(self.line_to(words, Some(true))));
                arc.words = vec![word(a, from[a] + x), word(b, from[b] + y)];
                let base = if absolute_centres { [from[a], from[b]] } else { [0.0; 2] };
                arc.centre =
                    vec![(letters[0], base[0] + centre[0]), (letters[1], base[1] + centre[1])];
            }
        }
        if self.random.chance(0.3) {
            arc.words.push(word(third, decimal(self.random, 9.0)));
        }
        arc.number = self.number();
        let again = Motion { words: vec![word(a, -y * 0.5), word(b, x * 0.5)], ..arc.clone() };
        all.push(Statement::Move(arc));
        if holds {
            // the radius is that of the previous arc
            let number = self.number();
            all.push(Statement::Move(Motion { number, radius: None, ..again }));
        }
        all
    }

    fn assignment(&mut self, place: Place) -> Statement {
        let value = both(Operator::Mod, self.value(place, 3), Expr::Number(9.0));
        let to = match self.random.below(6) {
            0 => name(self.random.pick(&["V.L.A", "V.CYC.A"])),
            1 => name("V.P.A"),
            2 => Expr::Element("V.P.TAB".to_owned(), Box::new(self.index())),
            _ if place.cycle => name(format!("@P{}", 1 + self.random.below(PASSED))),
            3 => Expr::Element("P100".to_owned(), Box::new(self.index())),
            4 => Expr::Indirect(7),
            _ => name(format!("P{}", 1 + self.random.below(PARAMETERS as usize))),
        };
        Statement::Assign(to, value)
    }

    fn control(&mut self, place: Place) -> Vec<Statement> {
        let one = self.fresh();
        match self.random.below(10) {
            9 => {
                let counter = name(format!("V.P.N{one}"));
                let set = Statement::Assign(counter.clone(), Expr::Number(0.0));
                let more = both(Operator::Add, counter.clone(), Expr::Number(1.0));
                let mut body = vec![Statement::Assign(counter.clone(), more)];
                let inside = Place { breaks: false, continues: false, ..place.deeper() };
                body.extend(self.statements(inside, 3));
                let few = Expr::Number(1.0 + self.random.below(3) as f64);
                let again =
                    Statement::Again(80_000 + one, body, both(Operator::Less, counter, few));
                vec![set, again]
            }
            0 | 1 => {
                let mut branches = Vec::new();
                for _ in 0..=self.random.below(3) {
                    let condition = self.condition(place, 2);
                    branches.push((condition, self.statements(place.deeper(), 2)));
                }
                let otherwise = self.random.chance(0.5).then(|| self.statements(place.deeper(), 2));
                vec![Statement::If(branches, otherwise)]
            }
            2 | 3 => {
                let counter =
                    if place.cycle { format!("V.P.I{one}") } else { format!("P{}", 200 + one) };
                let first = self.random.below(7) as f64 - 3.0;
                let step = self.random.pick(&[1.0, 2.0, -1.0, 0.5]);
                let last = first + step * (self.random.below(4) as f64 - 0.75);
                let last = (last * 4.0).round() / 4.0;
                let body = self.statements(place.loops(), 3);
                let bounds = [first, last, step].map(Expr::Number);
                vec![Statement::For(counter, bounds, body)]
            }
            4..=6 => {
                let counter = name(format!("V.P.N{one}"));
                let set = Statement::Assign(counter.clone(), Expr::Number(0.0));
                let more = both(Operator::Add, counter.clone(), Expr::Number(1.0));
                let mut body = vec![Statement::Assign(counter.clone(), more)];
                body.extend(self.statements(place.loops(), 3));
                let few = Expr::Number(1.0 + self.random.below(3) as f64);
                let statement = match self.random.below(3) {
                    0 => {
                        let condition = both(Operator::Less, counter, few);
                        Statement::While(
                            both(Operator::And, condition, self.condition(place, 1)),
                            body,
                        )
                    }
                    1 => Statement::Do(body, both(Operator::Less, counter, few)),
                    _ => {
                        let condition = both(Operator::Greater, counter, few);
                        Statement::Repeat(
                            body,
                            both(Operator::Or, condition, self.condition(place, 1)),
                        )
                    }
                };
                vec![set, statement]
            }
            7 => {
                let value = of(
                    Function::Int,
                    both(Operator::Times, self.value(place, 1), Expr::Number(0.3)),
                );
                let inside = Place { breaks: true, ..place.deeper() };
                let mut cases = Vec::new();
                for case in 0..1 + self.random.below(3) {
                    let body = self.statements(inside, 2);
                    cases.push((Expr::Number(case as f64 - 1.0), body, self.random.chance(0.6)));
                }
                let default = self.statements(inside, 2);
                vec![Statement::Switch(value, cases, default)]
            }
            _ => {
                let condition = self.condition(place, 1);
                let body = self.statements(place.deeper(), 2);
                vec![Statement::Skip(condition, 90_000 + one, body)]
            }
        }
    }

    fn call(&mut self, place: Place) -> Vec<Statement> {
        let number = self.random.below(place.callable);
        let call = match self.kinds[number] {
            Kind::Local | Kind::LocalCycle if place.global => return self.lines(place),
            Kind::Local | Kind::Global if place.cycle => return self.lines(place),
            Kind::Local | Kind::Global => Statement::Call(number),
            Kind::LocalCycle | Kind::GlobalCycle => {
                let values = (0..PASSED).map(|_| self.value(place, 1)).collect();
                Statement::Cycle(number, values)
            }
        };
        // a cycle restores G54, which is a change of offsets
        vec![call, self.whole_move()]
    }
}
