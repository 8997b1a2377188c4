//! The meaning of a program, worked out on its tree.
//!
//! Coordinates are affine maps that are composed for every word: offsets of the machine, then for each coordinate system its position,
//! its rotation and its own offsets, then mirroring, then contour rotation. Only the position of the machine is stored.

use super::map::{Map, UNIT};
use super::path::{Driven, Point};
use super::tree::{Expr, Function, Operator, Program, Statement, Word};
use std::collections::BTreeMap;

/// A zero-offset group without values.
const NO_GROUP: u32 = 7777;

/// Offsets of the machine, or of one coordinate system.
#[derive(Clone, Debug)]
struct Layer {
    place: Map,
    group: u32,
    /// The group came from G159.
    by_value: bool,
    preset: Point,
    /// `#PSET`.
    position: Point,
}

impl Layer {
    fn new(place: Map, group: u32) -> Self {
        Self { place, group, by_value: false, preset: [0.0; 3], position: [0.0; 3] }
    }
}

#[derive(Clone, Debug)]
struct Coordinates {
    /// Tools are in use: not in machine coordinates.
    tools: bool,
    layers: Vec<Layer>,
    mirrored: [bool; 3],
    rotation: Option<(f64, [f64; 2])>,
}

/// State that a subroutine shares with its caller and that a cycle gives back.
#[derive(Clone, Debug)]
pub struct Modal {
    pub path: u32,
    pub plane: u32,
    pub absolute: bool,
    pub absolute_centres: bool,
    /// The last G163 or R.
    pub radius: f64,
    /// G20 to G23.
    mirrors: [bool; 2],
}

/// Where execution continues after a statement.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Flow {
    On,
    Break,
    Continue,
}

pub struct Model<'a> {
    program: &'a Program,
    pub modal: Modal,
    coordinates: Coordinates,
    table: BTreeMap<(u32, usize), f64>,
    pub machine: Point,
    /// Factors of `#SCALE`, kept while scaling is off.
    factors: Point,
    scaled: bool,
    /// Length and offsets of the axes.
    tools: BTreeMap<u32, (f64, Point)>,
    tool: u32,
    /// P parameters, V.P, elements of arrays.
    values: BTreeMap<String, f64>,
    /// V.L and V.CYC of the levels.
    local: Vec<BTreeMap<String, f64>>,
    /// @P of the current cycle.
    passed: Vec<Vec<f64>>,
    pub driven: Driven,
    /// A tool does not fit into an inside corner.
    pub narrow: bool,
    /// Executed blocks.
    pub steps: usize,
}

/// The first, second and third axis of the plane of G17, G18 or G19.
pub fn axes_of(plane: u32) -> [usize; 3] {
    match plane {
        17 => [0, 1, 2],
        18 => [2, 0, 1],
        _ => [1, 2, 0],
    }
}

/// Placement of a coordinate system: shift, then rotations about Z, Y and X.
fn placed([x, y, z, a, b, c]: &[f64; 6]) -> Map {
    Map::shift([*x, *y, *z])
        .then_inner(&Map::turn(0, 1, *c))
        .then_inner(&Map::turn(2, 0, *b))
        .then_inner(&Map::turn(1, 2, *a))
}

/// Variables visible to a level and to those below it.
fn is_local(name: &str) -> bool {
    name.starts_with("V.L.") || name.starts_with("V.CYC.")
}

impl<'a> Model<'a> {
    pub fn new(program: &'a Program) -> Self {
        Self {
            program,
            modal: Modal {
                path: 1,
                plane: 17,
                absolute: true,
                absolute_centres: false,
                radius: 0.0,
                mirrors: [false; 2],
            },
            coordinates: Coordinates {
                tools: true,
                layers: vec![Layer::new(UNIT, 0)],
                mirrored: [false; 3],
                rotation: None,
            },
            tools: BTreeMap::new(),
            tool: 0,
            table: BTreeMap::new(),
            machine: [0.0; 3],
            factors: [1.0; 3],
            scaled: false,
            values: BTreeMap::new(),
            local: vec![BTreeMap::new()],
            passed: Vec::new(),
            driven: Driven::default(),
            narrow: false,
            steps: 0,
        }
    }

    pub fn run(&mut self) -> Point {
        let program = self.program;
        self.all(&program.main);
        self.machine
    }

    pub fn map(&self) -> Map {
        let mut map = UNIT;
        if let (Some((length, offset)), true) = (self.tools.get(&self.tool), self.coordinates.tools)
        {
            let mut offset = *offset;
            offset[axes_of(self.modal.plane)[2]] += length;
            map = Map::shift(offset);
        }
        for layer in &self.coordinates.layers {
            let zero = |axis| self.table.get(&(layer.group, axis)).copied().unwrap_or(0.0);
            let offset: Point =
                std::array::from_fn(|axis| zero(axis) + layer.preset[axis] + layer.position[axis]);
            map = map.then_inner(&layer.place).then_inner(&Map::shift(offset));
        }
        let signs = self.coordinates.mirrored.map(|on| if on { -1.0 } else { 1.0 });
        map = map.then_inner(&Map::scale(signs));
        if let Some((deg, [a, b])) = self.coordinates.rotation {
            let turned = Map::shift([a, b, 0.0])
                .then_inner(&Map::turn(0, 1, deg))
                .then_inner(&Map::shift([-a, -b, 0.0]));
            map = map.then_inner(&turned);
        }
        map
    }

    /// Length of a unit of an axis in the coordinates of the program.
    pub fn unit(&self, axis: usize) -> f64 {
        if self.scaled { self.factors[axis] } else { 1.0 }
    }

    /// A change of the plane ends a contour rotation.
    pub fn plane(&mut self, g: u32) {
        if g != self.modal.plane {
            self.coordinates.rotation = None;
        }
        self.modal.plane = g;
    }

    pub fn select(&mut self, group: u32) {
        (self.layer().group, self.layer().by_value) = (group, group > 6);
    }

    fn layer(&mut self) -> &mut Layer {
        self.coordinates.layers.last_mut().unwrap()
    }

    fn all(&mut self, statements: &[Statement]) -> Flow {
        for statement in statements {
            let flow = self.one(statement);
            if flow != Flow::On {
                return flow;
            }
        }
        Flow::On
    }

    fn one(&mut self, statement: &Statement) -> Flow {
        self.steps += 1;
        assert!(self.steps < 100_000, "the program does not end");
        match statement {
            Statement::Assign(to, value) => {
                let value = self.value(value);
                self.assign(to, value);
            }
            Statement::Move(_)
            | Statement::Compensated(_)
            | Statement::Spline(_)
            | Statement::Corner(..)
            | Statement::TwoAngles(..)
            | Statement::Suppressed(_) => self.motions(statement),
            Statement::Local(name, value) => {
                let value = self.value(value);
                self.local.last_mut().unwrap().insert(name.clone(), value);
            }
            Statement::Array(name, values) => {
                for (i, value) in values.iter().enumerate() {
                    self.values.insert(format!("{name}[{i}]"), *value);
                }
            }
            Statement::Plane(g) => self.plane(*g),
            Statement::Absolute(absolute) => self.modal.absolute = *absolute,
            Statement::Radius(radius) => self.modal.radius = *radius,
            Statement::AbsoluteCentres(on) => self.modal.absolute_centres = *on,
            Statement::Group(group) => self.select(*group),
            Statement::Table(group, axis, value) => {
                let value = self.value(value);
                self.table.insert((*group, *axis), value);
            }
            Statement::Preset(words) => {
                let before = if self.modal.absolute { 0.0 } else { 1.0 };
                for Word { axis, value } in words {
                    let value = self.value(value);
                    let preset = &mut self.layer().preset[*axis];
                    *preset = before * *preset + value;
                }
            }
            Statement::PositionPreset(words) => {
                let here = self.map().back(self.machine);
                for Word { axis, value } in words {
                    let value = self.value(value);
                    self.layer().position[*axis] += here[*axis] - value;
                }
            }
            Statement::PresetOff => self.layer().position = [0.0; 3],
            Statement::ToolData(number, _, length, offsets) => {
                self.tools.insert(*number, (*length, *offsets));
            }
            Statement::Tool(number) => self.tool = *number,
            Statement::Mirror(g) => {
                self.modal.mirrors = [[21, 23].contains(g), [22, 23].contains(g)];
                let mirrored = &mut self.coordinates.mirrored;
                (mirrored[0], mirrored[1]) = (self.modal.mirrors[0], self.modal.mirrors[1]);
                if *g == 20 {
                    mirrored[2] = false;
                }
            }
            Statement::MirrorAxis(axis, on) => self.coordinates.mirrored[*axis] = *on,
            Statement::Rotation(_, deg, centre) => {
                self.plane(17);
                self.coordinates.rotation = Some((*deg, *centre));
            }
            Statement::RotationOff(_) => self.coordinates.rotation = None,
            Statement::System(values) | Statement::StoredSystem(_, values) => {
                self.coordinates.layers.push(Layer::new(placed(values), NO_GROUP));
            }
            Statement::Stack(systems, selected) => {
                let layers = systems.iter().map(|values| Layer::new(placed(values), NO_GROUP));
                self.coordinates.layers.extend(layers.take(*selected));
            }
            // it lies below all others
            Statement::StackOff(..) => self.coordinates.layers.truncate(1),
            Statement::SystemOff(all) => {
                let left = self.coordinates.layers.len() - 1;
                self.coordinates.layers.truncate(if *all { 1 } else { left.max(1) });
            }
            Statement::Machine(body) => {
                let bare = Coordinates {
                    tools: false,
                    layers: vec![Layer::new(UNIT, NO_GROUP)],
                    mirrored: [false; 3],
                    rotation: None,
                };
                let before = std::mem::replace(&mut self.coordinates, bare);
                let flow = self.all(body);
                self.coordinates = before;
                return flow;
            }
            Statement::Scaled(_, factors, body) => {
                for (axis, factor) in factors {
                    self.factors[*axis] = *factor;
                }
                self.scaled = true;
                let flow = self.all(body);
                self.scaled = false;
                return flow;
            }
            Statement::Break => return Flow::Break,
            Statement::Continue => return Flow::Continue,
            Statement::Call(number) => self.call(*number),
            Statement::Cycle(number, values) => {
                let passed = values.iter().map(|value| self.value(value)).collect();
                self.passed.push(passed);
                let (modal, group) = (self.modal.clone(), self.layer().group);
                self.call(*number);
                // P-CHAN-00210: G functions without values return to their previous state
                if !self.layer().by_value {
                    self.select(group);
                }
                if self.modal.mirrors != modal.mirrors {
                    let [x, y] = modal.mirrors;
                    (self.coordinates.mirrored[0], self.coordinates.mirrored[1]) = (x, y);
                }
                self.modal = modal;
                self.passed.pop();
            }
            _ => return self.control(statement),
        }
        Flow::On
    }

    fn call(&mut self, number: usize) {
        let subroutine = &self.program.subroutines[number];
        self.local.push(BTreeMap::new());
        self.all(&subroutine.body);
        self.local.pop();
    }

    fn control(&mut self, statement: &Statement) -> Flow {
        match statement {
            Statement::If(branches, otherwise) => {
                for (condition, body) in branches {
                    if self.holds(condition) {
                        return self.all(body);
                    }
                }
                otherwise.as_ref().map_or(Flow::On, |body| self.all(body))
            }
            Statement::For(counter, bounds, body) => {
                let [first, last, step] = bounds.clone().map(|bound| self.value(&bound));
                let name = Expr::Name(counter.clone());
                self.assign(&name, first);
                loop {
                    let now = self.value(&name);
                    if if step > 0.0 { now > last } else { now < last } {
                        return Flow::On;
                    }
                    if self.all(body) == Flow::Break {
                        return Flow::On;
                    }
                    let now = self.value(&name);
                    self.assign(&name, now + step);
                }
            }
            Statement::While(condition, body) => {
                while self.holds(condition) && self.all(body) != Flow::Break {}
                Flow::On
            }
            Statement::Do(body, condition) => {
                while self.all(body) != Flow::Break && self.holds(condition) {}
                Flow::On
            }
            Statement::Repeat(body, condition) => {
                while self.all(body) != Flow::Break && !self.holds(condition) {}
                Flow::On
            }
            Statement::Again(_, body, condition) => loop {
                let flow = self.all(body);
                if flow != Flow::On || !self.holds(condition) {
                    return flow;
                }
            },
            Statement::Switch(value, cases, default) => {
                let value = self.value(value);
                let first =
                    cases.iter().position(|(case, _, _)| (self.value(case) - value).abs() < 0.001);
                for (_, body, ends) in cases.iter().skip(first.unwrap_or(cases.len())) {
                    match self.all(body) {
                        Flow::On if *ends => return Flow::On,
                        Flow::Break => return Flow::On,
                        Flow::On => {}
                        Flow::Continue => return Flow::Continue,
                    }
                }
                match self.all(default) {
                    Flow::Continue => Flow::Continue,
                    _ => Flow::On,
                }
            }
            Statement::Skip(condition, _, body) => {
                if self.holds(condition) {
                    Flow::On
                } else {
                    self.all(body)
                }
            }
            _ => unreachable!("{statement:?}"),
        }
    }

    fn assign(&mut self, to: &Expr, value: f64) {
        let key = self.key(to);
        if is_local(&key) {
            let level = self.local.iter().rposition(|level| level.contains_key(&key));
            let level = level.unwrap_or(self.local.len() - 1);
            self.local[level].insert(key, value);
        } else if let Some(number) = key.strip_prefix("@P") {
            let number: usize = number.parse().unwrap();
            self.passed.last_mut().unwrap()[number - 1] = value;
        } else {
            self.values.insert(key, value);
        }
    }

    /// Where a value is stored.
    fn key(&self, expr: &Expr) -> String {
        match expr {
            Expr::Name(name) => name.clone(),
            Expr::Element(name, index) => format!("{name}[{}]", self.value(index)),
            Expr::Indirect(number) => format!("P{}", self.values[&format!("P{number}")]),
            _ => unreachable!("{expr:?}"),
        }
    }

    fn holds(&self, condition: &Expr) -> bool {
        self.value(condition).abs() >= 0.5
    }

    pub fn value(&self, expr: &Expr) -> f64 {
        match expr {
            Expr::Number(x) => *x,
            Expr::Of(function, inner) => {
                let x = self.value(inner);
                match function {
                    Function::Sin => libm::sin(x.to_radians()),
                    Function::Cos => libm::cos(x.to_radians()),
                    Function::Abs => x.abs(),
                    Function::Sqrt => x.sqrt(),
                    Function::Int => x.trunc(),
                    Function::Round => x.round(),
                    Function::Floor => x.floor(),
                    Function::Minus => -x,
                }
            }
            Expr::Both(operator, a, b) => {
                let (a, b) = (self.value(a), self.value(b));
                let truth = |x: bool| if x { 1.0 } else { 0.0 };
                match operator {
                    Operator::Add => a + b,
                    Operator::Subtract => a - b,
                    Operator::Times => a * b,
                    Operator::Divide => a / b,
                    Operator::Mod => a % b,
                    Operator::Power => libm::pow(a, b),
                    Operator::Less => truth(a < b),
                    Operator::Greater => truth(a > b),
                    Operator::AtMost => truth(a <= b),
                    Operator::Equal => truth(a == b),
                    Operator::And => truth(a.abs() >= 0.5 && b.abs() >= 0.5),
                    Operator::Or => truth(a.abs() >= 0.5 || b.abs() >= 0.5),
                    Operator::Min => a.min(b),
                    Operator::Max => a.max(b),
                    Operator::Angle => libm::atan2(a, b).to_degrees(),
                }
            }
            Expr::Name(name) => self.named(name),
            Expr::Element(..) | Expr::Indirect(_) => self.values[&self.key(expr)],
        }
    }

    fn named(&self, name: &str) -> f64 {
        let axis = |name: &str| "XYZ".find(name).unwrap();
        let layer = self.coordinates.layers.last().unwrap();
        if let Some(name) = name.strip_prefix("V.A.ABS.") {
            self.map().back(self.machine)[axis(name)]
        } else if let Some(name) = name.strip_prefix("V.A.BZP.") {
            layer.preset[axis(name)]
        } else if let Some(name) = name.strip_prefix("V.G.NP_AKT.V.") {
            self.table.get(&(layer.group, axis(name))).copied().unwrap_or(0.0)
        } else if let Some(number) = name.strip_prefix("@P") {
            self.passed.last().unwrap()[number.parse::<usize>().unwrap() - 1]
        } else if is_local(name) {
            let found = self.local.iter().rev().find_map(|level| level.get(name));
            *found.unwrap_or_else(|| panic!("{name}"))
        } else {
            *self.values.get(name).unwrap_or_else(|| panic!("{name}"))
        }
    }
}
