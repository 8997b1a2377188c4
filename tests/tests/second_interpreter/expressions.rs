//! Random values and conditions.

use super::random::{Place, Writer};
use super::tree::{Expr, Function, Operator};
use kontur_kit::Random;

pub const TABLE: usize = 5;
pub const PARAMETERS: u32 = 6;
pub const PASSED: usize = 3;

pub fn name(name: impl Into<String>) -> Expr {
    Expr::Name(name.into())
}

pub fn of(function: Function, inner: Expr) -> Expr {
    Expr::Of(function, Box::new(inner))
}

pub fn both(operator: Operator, a: Expr, b: Expr) -> Expr {
    Expr::Both(operator, Box::new(a), Box::new(b))
}

/// With three decimals, and at least a thousandth away from 0.
pub fn decimal(random: &mut Random, most: f64) -> f64 {
    let value = (random.between(-most, most) * 1000.0).round() / 1000.0;
    if value == 0.0 { 0.125 } else { value }
}

impl Writer<'_> {
    pub fn literal(&mut self) -> Expr {
        Expr::Number(decimal(self.random, 9.0))
    }

    /// A value of up to some tens.
    pub fn value(&mut self, place: Place, depth: usize) -> Expr {
        if depth == 0 || self.random.chance(0.3) {
            return self.leaf(place);
        }
        let a = self.value(place, depth - 1);
        let b = self.value(place, depth - 1);
        match self.random.below(16) {
            0 | 1 => both(Operator::Add, a, b),
            2 | 3 => both(Operator::Subtract, a, b),
            4 => both(Operator::Times, a, Expr::Number(decimal(self.random, 2.0))),
            5 => {
                let divisor = both(Operator::Add, of(Function::Abs, b), Expr::Number(1.5));
                both(Operator::Divide, a, divisor)
            }
            6 => both(Operator::Mod, a, Expr::Number(7.5)),
            7 => both(
                Operator::Power,
                both(Operator::Divide, a, Expr::Number(8.0)),
                Expr::Number(2.0),
            ),
            8 => both(Operator::Times, a, of(Function::Sin, b)),
            9 => both(Operator::Times, of(Function::Cos, a), b),
            10 => of(Function::Sqrt, of(Function::Abs, a)),
            11 => {
                let function = self.random.pick(&[Function::Int, Function::Round, Function::Floor]);
                of(function, both(Operator::Times, a, Expr::Number(0.37)))
            }
            12 => of(Function::Minus, a),
            13 => both(self.random.pick(&[Operator::Min, Operator::Max]), a, b),
            14 => {
                let degrees = both(
                    Operator::Angle,
                    a,
                    both(Operator::Add, of(Function::Abs, b), Expr::Number(1.0)),
                );
                both(Operator::Divide, degrees, Expr::Number(9.0))
            }
            _ => both(Operator::Times, self.condition(place, 1), a),
        }
    }

    fn leaf(&mut self, place: Place) -> Expr {
        if self.random.chance(0.4) {
            return self.literal();
        }
        let axis = self.random.pick(&["X", "Y", "Z"]);
        match self.random.below(9) {
            0 if place.cycle => name(format!("@P{}", 1 + self.random.below(PASSED))),
            0 | 1 if !place.cycle => {
                name(format!("P{}", 1 + self.random.below(PARAMETERS as usize)))
            }
            2 => name(self.random.pick(&["V.L.A", "V.CYC.A"])),
            3 => Expr::Element("V.P.TAB".to_owned(), Box::new(self.index())),
            4 if !place.cycle => Expr::Element("P100".to_owned(), Box::new(self.index())),
            5 if !place.cycle => Expr::Indirect(7 + self.random.below(2) as u32),
            6 => name(format!("V.A.BZP.{axis}")),
            7 => name(format!("V.G.NP_AKT.V.{axis}")),
            _ => name(self.random.pick(&["V.P.A", "V.P.B"])),
        }
    }

    pub fn index(&mut self) -> Expr {
        let i = self.random.below(TABLE);
        if self.random.chance(0.5) {
            return Expr::Number(i as f64);
        }
        let part = self.random.below(i + 1);
        both(Operator::Add, Expr::Number(part as f64), Expr::Number((i - part) as f64))
    }

    pub fn condition(&mut self, place: Place, depth: usize) -> Expr {
        if depth > 0 && self.random.chance(0.4) {
            let operator = self.random.pick(&[Operator::And, Operator::Or]);
            let (a, b) = (self.condition(place, depth - 1), self.condition(place, depth - 1));
            return both(operator, a, b);
        }
        let a = self.value(place, 1);
        match self.random.below(5) {
            0 => {
                let whole = of(Function::Int, both(Operator::Times, a, Expr::Number(0.3)));
                both(Operator::Equal, whole, Expr::Number(self.random.below(3) as f64))
            }
            1 => both(Operator::AtMost, a, self.literal()),
            2 => both(Operator::Greater, a, self.value(place, 1)),
            _ => both(Operator::Less, a, self.literal()),
        }
    }

    /// A coordinate within 30 mm.
    pub fn coordinate(&mut self, place: Place) -> Expr {
        if self.random.chance(0.6) {
            return Expr::Number(decimal(self.random, 30.0));
        }
        let value = self.value(place, 2);
        if self.random.chance(0.5) {
            return both(Operator::Mod, value, Expr::Number(30.0));
        }
        both(Operator::Max, Expr::Number(-30.0), both(Operator::Min, Expr::Number(30.0), value))
    }
}
