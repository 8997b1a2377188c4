//! P parameters, self-defined variables (`V.P`, `V.L`, `V.S`, `V.CYC`), external variables and cycle parameters.
//!
//! Source: TF5200 programming manual, parameters and variables. Assumptions: array indices begin at 0, a number written
//! to an integer variable is rounded, an index of a P parameter is at most [`INDEX_MAX`] and all arrays together hold
//! at most [`ELEMENTS_MAX`] elements, so that a program cannot exhaust memory.

use super::decoder::Decoder;
use super::expr::{as_number, is_true, whole};
use super::fault::{Fault, Outcome, own};
use super::options::{Access, External, Value};
use super::suggest;
use super::system;
use crate::diag::ValueKind;
use crate::syntax::ast::{
    Declaration, Expr, ItemKind, ItemValue, ParameterIndex, Place, PlaceKind, Segment, Span,
};
use smallvec::SmallVec;
use std::collections::BTreeMap;

/// Highest index of a P parameter.
const INDEX_MAX: u32 = 1_000_000;
/// Elements of all arrays together.
const ELEMENTS_MAX: usize = 4_000_000;
/// Dimensions of an array.
const DIMENSIONS_MAX: usize = 4;

/// Type of a declared variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Type {
    Boolean,
    /// Whole numbers of a range.
    Integer {
        low: i64,
        high: i64,
    },
    Real,
    /// Text of so many characters.
    Text(usize),
}

impl Type {
    fn from_name(name: &str) -> Option<Self> {
        let signed =
            |bits: u32| Self::Integer { low: -(1 << (bits - 1)), high: (1 << (bits - 1)) - 1 };
        let unsigned = |bits: u32| Self::Integer { low: 0, high: (1 << bits) - 1 };
        Some(match name {
            "BOOLEAN" | "BOOL" => Self::Boolean,
            "SGN08" => signed(8),
            "SGN16" => signed(16),
            "SGN32" => signed(32),
            "UNS08" => unsigned(8),
            "UNS16" => unsigned(16),
            "UNS32" => unsigned(32),
            "REAL64" | "REAL" => Self::Real,
            "STRING" => Self::Text(126),
            _ => return None,
        })
    }

    fn zero(self) -> Value {
        match self {
            Self::Text(_) => Value::Text("".into()),
            _ => Value::Number(0.0),
        }
    }

    /// The value as a variable of this type holds it.
    fn converted(self, value: Value, span: Span) -> Outcome<Value> {
        Ok(match self {
            Self::Boolean => Value::truth(is_true(as_number(&value, span)?)),
            Self::Real => Value::Number(as_number(&value, span)?),
            Self::Integer { low, high } => {
                let x = as_number(&value, span)?.round();
                if x < low as f64 || x > high as f64 {
                    let text = format!("{x} is outside {low} to {high}");
                    return Err(Fault::kontur(own::RANGE, text, span));
                }
                Value::Number(x + 0.0)
            }
            Self::Text(length) => match value {
                Value::Text(text) if text.chars().count() > length => {
                    let text = format!("the text is longer than {length} characters");
                    return Err(Fault::kontur(own::RANGE, text, span));
                }
                Value::Text(text) => Value::Text(text),
                Value::Number(_) => {
                    return Err(Fault::kontur(own::SYNTAX, "a text is expected", span));
                }
            },
        })
    }
}

/// A variable.
#[derive(Clone, Debug)]
struct Variable {
    kind: Option<Type>,
    sizes: SmallVec<[usize; 2]>,
    values: Values,
}

/// Its value or values.
#[derive(Clone, Debug)]
enum Values {
    One(Value),
    Many(Vec<Value>),
}

impl Variable {
    /// A variable that its first write creates: it takes the type of what is written.
    fn created(value: Value) -> Self {
        let kind = match value {
            Value::Number(_) => Some(Type::Real),
            Value::Text(_) => None,
        };
        Self { kind, sizes: SmallVec::new(), values: Values::One(value) }
    }

    fn get(&self, subscripts: &[f64], span: Span) -> Outcome<Value> {
        match (&self.values, self.index(subscripts, span)?) {
            (Values::One(value), _) => Ok(value.clone()),
            (Values::Many(values), i) => Ok(values[i].clone()),
        }
    }

    fn set(&mut self, subscripts: &[f64], value: Value, span: Span) -> Outcome<()> {
        let i = self.index(subscripts, span)?;
        let value = match self.kind {
            Some(kind) => kind.converted(value, span)?,
            None => value,
        };
        match &mut self.values {
            Values::One(slot) => *slot = value,
            Values::Many(values) => values[i] = value,
        }
        Ok(())
    }

    fn index(&self, subscripts: &[f64], span: Span) -> Outcome<usize> {
        if subscripts.len() != self.sizes.len() {
            let text = format!(
                "{} subscript(s) are written, the variable has {} dimension(s)",
                subscripts.len(),
                self.sizes.len()
            );
            return Err(Fault::kontur(own::RANGE, text, span));
        }
        let mut index = 0;
        for (x, size) in subscripts.iter().zip(&self.sizes) {
            let high = u32::try_from(size - 1).unwrap_or(u32::MAX);
            let Some(i) = whole(*x, 0, high) else {
                let text = format!("subscript {x} is outside 0 to {high}");
                return Err(Fault::kontur(own::RANGE, text, span)
                    .with(|d| d.value(ValueKind::Current, *x, "-")));
            };
            index = index * size + i as usize;
        }
        Ok(index)
    }

    fn elements(&self) -> usize {
        match &self.values {
            Values::One(_) => 0,
            Values::Many(values) => values.len(),
        }
    }
}

type Table = BTreeMap<Box<str>, Variable>;

/// What belongs to one call of a cycle.
#[derive(Clone, Debug, Default)]
struct CycleScope {
    /// Own P parameters.
    parameters: BTreeMap<u32, Variable>,
    /// `V.CYC`.
    variables: Table,
    /// `@P1`, `@X`, ... by the name behind `@`.
    passed: BTreeMap<Box<str>, Value>,
}

/// All variables of a program.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables {
    parameters: BTreeMap<u32, Variable>,
    program: Table,
    shared: Table,
    /// One table per program level.
    locals: Vec<Table>,
    cycles: Vec<CycleScope>,
    external: BTreeMap<String, External>,
    elements: usize,
}

/// A resolved place.
enum Target<'a> {
    Parameter(u32, Subscripts),
    Own(Class, Name<'a>, Subscripts),
    External(String),
    Cycle(&'a str),
    System(&'a [Segment]),
}

type Subscripts = SmallVec<[f64; 2]>;
type Name<'a> = std::borrow::Cow<'a, str>;

/// Class of self-defined variables.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Class {
    Program,
    Local,
    Shared,
    Cycle,
}

impl Variables {
    pub(super) fn new(external: BTreeMap<String, External>) -> Self {
        Self { external, locals: vec![Table::new()], ..Self::default() }
    }

    /// Enters a program level.
    pub(super) fn enter_level(&mut self) {
        self.locals.push(Table::new());
    }

    /// Leaves a program level: its local variables are gone.
    pub(super) fn leave_level(&mut self) {
        let gone = self.locals.pop().unwrap_or_default();
        self.elements -= gone.values().map(Variable::elements).sum::<usize>();
    }

    /// Enters a cycle with the parameters passed to it.
    pub(super) fn enter_cycle(&mut self, passed: BTreeMap<Box<str>, Value>) {
        self.cycles.push(CycleScope { passed, ..CycleScope::default() });
    }

    pub(super) fn leave_cycle(&mut self) {
        let gone = self.cycles.pop().unwrap_or_default();
        let variables = gone.variables.values().map(Variable::elements).sum::<usize>();
        let parameters = gone.parameters.values().map(Variable::elements).sum::<usize>();
        self.elements -= variables + parameters;
    }

    /// Whether a cycle parameter was passed; `None` outside cycles.
    pub(super) fn passed(&self, name: &str) -> Option<bool> {
        Some(self.cycles.last()?.passed.contains_key(name))
    }

    fn parameters(&self) -> &BTreeMap<u32, Variable> {
        self.cycles.last().map_or(&self.parameters, |c| &c.parameters)
    }

    fn parameters_mut(&mut self) -> &mut BTreeMap<u32, Variable> {
        self.cycles.last_mut().map_or(&mut self.parameters, |c| &mut c.parameters)
    }

    fn find(&self, class: Class, name: &str) -> Option<&Variable> {
        match class {
            Class::Program => self.program.get(name),
            Class::Shared => self.shared.get(name),
            Class::Cycle => self.cycles.last()?.variables.get(name),
            Class::Local => self.locals.iter().rev().find_map(|table| table.get(name)),
        }
    }

    fn find_mut(&mut self, class: Class, name: &str) -> Option<&mut Variable> {
        match class {
            Class::Program => self.program.get_mut(name),
            Class::Shared => self.shared.get_mut(name),
            Class::Cycle => self.cycles.last_mut()?.variables.get_mut(name),
            Class::Local => self.locals.iter_mut().rev().find_map(|table| table.get_mut(name)),
        }
    }

    /// The table in which a declaration stands now.
    fn table(&mut self, class: Class) -> Option<&mut Table> {
        match class {
            Class::Program => Some(&mut self.program),
            Class::Shared => Some(&mut self.shared),
            Class::Cycle => self.cycles.last_mut().map(|c| &mut c.variables),
            Class::Local => self.locals.last_mut(),
        }
    }

    fn names(&self, class: Class) -> Vec<&str> {
        let tables: Vec<&Table> = match class {
            Class::Program => vec![&self.program],
            Class::Shared => vec![&self.shared],
            Class::Cycle => self.cycles.last().map(|c| &c.variables).into_iter().collect(),
            Class::Local => self.locals.iter().collect(),
        };
        tables.into_iter().flat_map(|t| t.keys().map(|k| &**k)).collect()
    }
}

/// Class of the first segment, if it is one of self-defined variables.
fn class(segment: &str) -> Option<(Class, &'static str)> {
    const CLASSES: [(&str, Class); 4] =
        [("P", Class::Program), ("L", Class::Local), ("S", Class::Shared), ("CYC", Class::Cycle)];
    CLASSES.iter().find(|(n, _)| n.eq_ignore_ascii_case(segment)).map(|(n, c)| (*c, *n))
}

fn undefined(what: &str, span: Span) -> Box<Fault> {
    Fault::kontur(own::UNDEFINED, format!("{what} has no value"), span)
}

/// `G04 P500` of other controls is a value read from P500 here.
fn undefined_parameter(index: u32, span: Span) -> Box<Fault> {
    undefined(&format!("P{index}"), span).hint(format!(
        "P is a parameter in this dialect, not an address: P{index}=5 assigns a value"
    ))
}

impl Decoder {
    fn subscripts(&self, exprs: &[Expr]) -> Outcome<Subscripts> {
        exprs.iter().map(|e| self.number(e)).collect()
    }

    fn resolve<'a>(&self, place: &'a Place) -> Outcome<Target<'a>> {
        match &place.kind {
            PlaceKind::Parameter { indirections, index, subscripts } => {
                let index = self.parameter_index(index, *indirections, place.span)?;
                Ok(Target::Parameter(index, self.subscripts(subscripts)?))
            }
            PlaceKind::Cycle(name) => Ok(Target::Cycle(name)),
            PlaceKind::Variable(segments) => self.resolve_variable(segments),
        }
    }

    fn resolve_variable<'a>(&self, segments: &'a [Segment]) -> Outcome<Target<'a>> {
        let first = segments.first().map_or("", |s| &*s.name);
        let rest = segments.get(1..).unwrap_or_default();
        if first.eq_ignore_ascii_case("E") {
            return Ok(Target::External(self.external_name(rest)?));
        }
        let Some((class, _)) = class(first) else { return Ok(Target::System(segments)) };
        if let [only] = rest {
            let subscripts = self.subscripts(&only.subscripts)?;
            return Ok(Target::Own(class, Name::Borrowed(&only.name), subscripts));
        }
        let mut subscripts = Subscripts::new();
        let mut name = String::new();
        for segment in rest {
            if !name.is_empty() {
                name.push('.');
            }
            name.push_str(&segment.name);
            subscripts.extend(self.subscripts(&segment.subscripts)?);
        }
        Ok(Target::Own(class, Name::Owned(name), subscripts))
    }

    fn external_name(&self, segments: &[Segment]) -> Outcome<String> {
        use std::fmt::Write as _;
        let mut name = String::new();
        for segment in segments {
            if !name.is_empty() {
                name.push('.');
            }
            name.push_str(&segment.name);
            for x in self.subscripts(&segment.subscripts)? {
                // writing to a String cannot fail
                let _ = write!(name, "[{}]", x.round());
            }
        }
        Ok(name)
    }

    fn parameter_index(
        &self,
        index: &ParameterIndex,
        indirections: u32,
        span: Span,
    ) -> Outcome<u32> {
        let checked = |x: f64| {
            whole(x, 1, INDEX_MAX).ok_or_else(|| {
                let text = format!("P{x} does not exist, indices are 1 to {INDEX_MAX}");
                Fault::kontur(own::RANGE, text, span)
            })
        };
        let mut index = match index {
            ParameterIndex::Literal(n) => checked(f64::from(*n))?,
            ParameterIndex::Computed(expr) => checked(self.number(expr)?)?,
        };
        for _ in 0..indirections {
            let value = match self.variables.parameters().get(&index) {
                Some(variable) => variable.get(&[], span)?,
                None => return Err(undefined_parameter(index, span)),
            };
            index = checked(as_number(&value, span)?)?;
        }
        Ok(index)
    }

    /// Value of a place.
    pub(super) fn read(&self, place: &Place) -> Outcome<Value> {
        let span = place.span;
        match self.resolve(place)? {
            Target::Parameter(index, subscripts) => match self.variables.parameters().get(&index) {
                Some(variable) => variable.get(&subscripts, span),
                None if !subscripts.is_empty() => Err(undeclared_array(index, span)),
                None => Err(undefined_parameter(index, span)),
            },
            Target::Own(class, name, subscripts) => match self.variables.find(class, &name) {
                Some(variable) => variable.get(&subscripts, span),
                None => Err(self.unknown(class, &name, span)),
            },
            Target::External(name) => match self.variables.external.get(&name) {
                Some(External { access: Access::WriteOnly, .. }) => {
                    Err(Fault::vendor(20097, format!("V.E.{name} may not be read"), span))
                }
                Some(external) => Ok(external.value.clone()),
                None => {
                    let known = self.variables.external.keys().map(String::as_str);
                    let hint = suggest::hint(&name, known);
                    let fault = undefined(&format!("V.E.{name}"), span);
                    Err(match hint {
                        Some(hint) => fault.hint(hint),
                        None => fault.hint("external variables get their values from --external"),
                    })
                }
            },
            Target::Cycle(name) => self.cycle_parameter(name, span),
            Target::System(segments) => system::read(self, segments, span),
        }
    }

    fn cycle_parameter(&self, name: &str, span: Span) -> Outcome<Value> {
        let Some(scope) = self.variables.cycles.last() else {
            let text = format!("@{name} exists only inside a cycle");
            return Err(Fault::kontur(own::UNDEFINED, text, span));
        };
        scope.passed.get(name).cloned().ok_or_else(|| {
            undefined(&format!("@{name}"), span).hint(format!("test V.G.@{name}.VALID first"))
        })
    }

    fn unknown(&self, class: Class, name: &str, span: Span) -> Box<Fault> {
        let letter = match class {
            Class::Program => "P",
            Class::Local => "L",
            Class::Shared => "S",
            Class::Cycle => "CYC",
        };
        let fault = undefined(&format!("V.{letter}.{name}"), span);
        match suggest::nearest(name, self.variables.names(class)) {
            Some(near) => fault.hint(format!("did you mean `V.{letter}.{near}`?")),
            None => fault,
        }
    }

    /// Writes a place; a text may go to variables, not to P parameters.
    pub(super) fn write(&mut self, place: &Place, value: Value, value_span: Span) -> Outcome<()> {
        let span = place.span;
        match self.resolve(place)? {
            Target::Parameter(index, subscripts) => {
                let number = Value::Number(as_number(&value, value_span)?);
                let table = self.variables.parameters_mut();
                match table.get_mut(&index) {
                    Some(variable) => variable.set(&subscripts, number, span),
                    None if !subscripts.is_empty() => Err(undeclared_array(index, span)),
                    None => {
                        table.insert(index, Variable::created(number));
                        Ok(())
                    }
                }
            }
            Target::Own(class, name, subscripts) => {
                if let Some(variable) = self.variables.find_mut(class, &name) {
                    return variable.set(&subscripts, value, value_span);
                }
                let by_write = matches!(class, Class::Program | Class::Shared);
                if !by_write || !subscripts.is_empty() {
                    let fault = self.unknown(class, &name, span);
                    return Err(fault.hint("declare it between #VAR and #ENDVAR"));
                }
                if let Some(table) = self.variables.table(class) {
                    table.insert((&*name).into(), Variable::created(value));
                }
                Ok(())
            }
            Target::External(name) => self.write_external(name, value, span),
            Target::Cycle(name) => {
                let text = format!("@{name} may not be written");
                Err(Fault::vendor(20100, text, span))
            }
            Target::System(segments) => system::write(self, segments, &value, span),
        }
    }

    fn write_external(&mut self, name: String, value: Value, span: Span) -> Outcome<()> {
        match self.variables.external.get_mut(&name) {
            Some(External { access: Access::ReadOnly, .. }) => {
                Err(Fault::vendor(20100, format!("V.E.{name} may not be written"), span))
            }
            Some(external) => {
                external.value = value;
                Ok(())
            }
            None => {
                let text = format!("V.E.{name} is not configured, the program created it");
                self.note(Fault::kontur(own::EXTERNAL_CREATED, text, span));
                let access = Access::ReadWrite;
                self.variables.external.insert(name, External { value, access });
                Ok(())
            }
        }
    }

    /// Whether a variable or parameter exists.
    pub(super) fn exists(&self, place: &Place) -> Outcome<bool> {
        Ok(match self.resolve(place)? {
            Target::Parameter(index, _) => self.variables.parameters().contains_key(&index),
            Target::Own(class, name, _) => self.variables.find(class, &name).is_some(),
            Target::External(name) => self.variables.external.contains_key(&name),
            Target::Cycle(name) => self.variables.passed(name).unwrap_or(false),
            Target::System(segments) => system::read(self, segments, place.span).is_ok(),
        })
    }

    /// Sizes of the dimensions of an array; none for a scalar.
    pub(super) fn dimensions(&self, place: &Place) -> Outcome<Vec<usize>> {
        let found = match self.resolve(place)? {
            Target::Parameter(index, _) => self.variables.parameters().get(&index),
            Target::Own(class, name, _) => self.variables.find(class, &name),
            _ => None,
        };
        Ok(found.map(|v| v.sizes.to_vec()).unwrap_or_default())
    }

    /// `#DELETE`.
    pub(super) fn delete(&mut self, place: &Place) -> Outcome<()> {
        let span = place.span;
        let removed = match self.resolve(place)? {
            Target::Parameter(index, _) => self.variables.parameters_mut().remove(&index),
            Target::Own(class, name, _) => {
                let gone = self.variables.table(class).and_then(|table| table.remove(&*name));
                if gone.is_none() {
                    return Err(self.unknown(class, &name, span));
                }
                gone
            }
            Target::External(_) | Target::Cycle(_) | Target::System(_) => {
                let text = "only self-defined variables can be deleted";
                return Err(Fault::vendor(20100, text, span));
            }
        };
        self.variables.elements -= removed.map_or(0, |v| v.elements());
        Ok(())
    }

    /// One line between `#VAR` and `#ENDVAR`.
    pub(super) fn declare(&mut self, declaration: &Declaration) -> Outcome<()> {
        let span = declaration.place.span;
        let kind = self.declared_type(declaration)?;
        let (target, class_of) = match &declaration.place.kind {
            PlaceKind::Parameter { indirections, index, .. } => {
                let index = self.parameter_index(index, *indirections, span)?;
                (format!("{index}"), None)
            }
            PlaceKind::Variable(segments) => {
                let first = segments.first().map_or("", |s| &*s.name);
                let Some((class, _)) = class(first) else {
                    let text = format!("variables of class V.{first} cannot be declared");
                    return Err(Fault::vendor(21218, text, span));
                };
                let names: Vec<&str> = segments[1..].iter().map(|s| &*s.name).collect();
                (names.join("."), Some(class))
            }
            PlaceKind::Cycle(_) => {
                return Err(Fault::kontur(own::SYNTAX, "a variable is expected", span));
            }
        };
        let sizes = self.sizes(&declaration.place)?;
        let count: usize = sizes.iter().product();
        if sizes.len() > DIMENSIONS_MAX {
            let text = format!("arrays have at most {DIMENSIONS_MAX} dimensions");
            return Err(Fault::kontur(own::RANGE, text, span));
        }
        if !sizes.is_empty() && self.variables.elements.saturating_add(count) > ELEMENTS_MAX {
            let text = format!("all arrays together hold at most {ELEMENTS_MAX} elements");
            return Err(Fault::kontur(own::RANGE, text, span));
        }
        let values = self.start_values(declaration, kind, &sizes, count)?;
        let variable = Variable { kind: Some(kind), sizes, values };
        let exists = match class_of {
            None => {
                let index = target.parse().unwrap_or(0);
                let table = self.variables.parameters_mut();
                // a parameter created by a write may become an array
                let known = table.get(&index).is_some_and(|v| v.sizes == variable.sizes);
                if !known {
                    self.insert_parameter(index, variable);
                }
                known
            }
            Some(class) => self.insert_variable(class, &target, variable, span)?,
        };
        if exists {
            let text = "already declared: it keeps its value";
            self.note_once("redeclared", Fault::kontur(own::ODD, text, span));
        }
        Ok(())
    }

    fn insert_parameter(&mut self, index: u32, variable: Variable) {
        self.variables.elements += variable.elements();
        if let Some(old) = self.variables.parameters_mut().insert(index, variable) {
            self.variables.elements -= old.elements();
        }
    }

    /// True if the variable existed before.
    fn insert_variable(
        &mut self,
        class: Class,
        name: &str,
        variable: Variable,
        span: Span,
    ) -> Outcome<bool> {
        let elements = variable.elements();
        let Some(table) = self.variables.table(class) else {
            let text = "V.CYC variables exist only inside a cycle";
            return Err(Fault::vendor(21218, text, span));
        };
        if table.contains_key(name) {
            return Ok(true);
        }
        table.insert(name.into(), variable);
        self.variables.elements += elements;
        Ok(false)
    }

    fn declared_type(&self, declaration: &Declaration) -> Outcome<Type> {
        let Some(name) = &declaration.type_name else {
            let text = matches!(
                &declaration.value,
                Some(ItemValue::Expr(e)) if matches!(self.value(e), Ok(Value::Text(_)))
            );
            return Ok(if text { Type::Text(126) } else { Type::Real });
        };
        let kind = Type::from_name(&name.text.to_ascii_uppercase()).ok_or_else(|| {
            Fault::vendor(20908, format!("unknown type {}", name.text), name.span)
                .hint("types are BOOLEAN, SGN08 to SGN32, UNS08 to UNS32, REAL64, STRING[n]")
        })?;
        match (&declaration.length, kind) {
            (Some(length), Type::Text(_)) => {
                Ok(Type::Text(self.whole(length, "the length of a text", 0, 126)? as usize))
            }
            _ => Ok(kind),
        }
    }

    fn sizes(&self, place: &Place) -> Outcome<SmallVec<[usize; 2]>> {
        let high = u32::try_from(ELEMENTS_MAX).unwrap_or(u32::MAX);
        let size = |e: &Expr| self.whole(e, "the size of a dimension", 1, high).map(|n| n as usize);
        match &place.kind {
            PlaceKind::Parameter { subscripts, .. } => subscripts.iter().map(size).collect(),
            PlaceKind::Variable(segments) => {
                segments.iter().flat_map(|s| &s.subscripts).map(size).collect()
            }
            PlaceKind::Cycle(_) => Ok(SmallVec::new()),
        }
    }

    fn start_values(
        &self,
        declaration: &Declaration,
        kind: Type,
        sizes: &[usize],
        count: usize,
    ) -> Outcome<Values> {
        let one = |e: &Expr| kind.converted(self.value(e)?, e.span);
        if sizes.is_empty() {
            return Ok(Values::One(match &declaration.value {
                None => kind.zero(),
                Some(ItemValue::Expr(e)) => one(e)?,
                Some(ItemValue::Name(n)) => {
                    return Err(Fault::kontur(own::SYNTAX, "a value is expected", n.span));
                }
                Some(ItemValue::List(g)) => {
                    return Err(Fault::kontur(own::SYNTAX, "a single value is expected", g.span));
                }
            }));
        }
        let mut values = Vec::new();
        match &declaration.value {
            None => {}
            Some(ItemValue::List(group)) => {
                for item in &group.items {
                    match &item.kind {
                        ItemKind::Value(ItemValue::Expr(e)) => values.push(one(e)?),
                        ItemKind::Missing => values.push(kind.zero()),
                        _ => {
                            let text = "a value is expected";
                            return Err(Fault::kontur(own::SYNTAX, text, item.span));
                        }
                    }
                }
            }
            Some(ItemValue::Expr(e)) => values.push(one(e)?),
            Some(ItemValue::Name(n)) => {
                return Err(Fault::kontur(own::SYNTAX, "a value is expected", n.span));
            }
        }
        if values.len() > count {
            let text = format!("{} values for {count} elements", values.len());
            return Err(Fault::kontur(own::RANGE, text, declaration.span));
        }
        values.resize(count, kind.zero());
        Ok(Values::Many(values))
    }
}

fn undeclared_array(index: u32, span: Span) -> Box<Fault> {
    Fault::vendor(20921, format!("P{index} is not declared as an array"), span)
        .hint(format!("declare it between #VAR and #ENDVAR: P{index}[size]"))
}
