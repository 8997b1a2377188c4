//! Diagnostics: messages to the user, with ID, position, values and a hint.
//!
//! Vendor conditions have the vendor's number, kontur's own have `K-nnnn`; numbers are never invented inside the
//! vendor's range. All constant properties of a condition are in one table, [`condition`].
//!
//! Order of calls: make a diagnostic from its condition, add position and values, and render it last.
//!
//! ```
//! use kontur_interpreter::diag::{Condition, Diagnostic, ValueKind, render};
//!
//! let said = Diagnostic::new(Condition::FeedZero, "feed is 0 in a motion block")
//!     .value(ValueKind::Current, 0.0, "mm/min");
//! assert!(said.is_error() && said.hint.is_some());
//! assert!(render::text(&said, false).starts_with("error[20008]: feed is 0"));
//! assert!(render::json(&said).contains(r#""id":20008"#));
//! ```

pub mod condition;
mod id;
mod number;
pub mod render;

pub use condition::{Condition, Reaction};
pub use id::{Id, Severity};
pub use number::rounded;

use serde::{Serialize, Serializer};
use std::sync::Arc;

/// A position in a source text.
#[derive(Clone, Debug, PartialEq)]
pub struct Location {
    /// Name of the file as the user gave it.
    pub file: Arc<str>,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// Offset in bytes from the start of the file.
    pub offset: u64,
    /// Length of the marked text in characters, at least 1.
    pub length: u32,
    /// N number of the block.
    pub block: Option<u64>,
    /// The line itself, without its end.
    pub text: Arc<str>,
}

impl Location {
    /// The column after the last marked character, from 1.
    pub fn end_column(&self) -> u32 {
        self.column.max(1).saturating_add(self.length.max(1))
    }
}

impl Serialize for Location {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut s = serializer.serialize_struct("Location", 6)?;
        s.serialize_field("file", &self.file)?;
        s.serialize_field("line", &self.line)?;
        s.serialize_field("column", &self.column)?;
        s.serialize_field("end_column", &self.end_column())?;
        s.serialize_field("offset", &self.offset)?;
        s.serialize_field("block", &self.block)?;
        s.end()
    }
}

/// Meaning of a value of a diagnostic (the vendor's flag, `70-errors` section 2, by name).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ValueKind {
    /// A limit.
    Limit,
    /// The current value.
    Current,
    /// The wrong value.
    Wrong,
    /// The value that was expected.
    Expected,
    /// The value after the correction.
    Corrected,
    /// A logical axis number.
    AxisNumber,
    /// A lower limit.
    LowerLimit,
    /// An upper limit.
    UpperLimit,
    /// A start value.
    StartValue,
    /// A target value.
    TargetValue,
    /// An index or number that identifies something (filter, stage, block).
    Identification,
    /// A state or a word.
    State,
}

/// A number or a word.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Datum {
    /// A number.
    Number(f64),
    /// A word.
    Text(String),
}

impl From<f64> for Datum {
    fn from(v: f64) -> Self {
        Self::Number(v)
    }
}

impl From<u32> for Datum {
    fn from(v: u32) -> Self {
        Self::Number(f64::from(v))
    }
}

impl From<&str> for Datum {
    fn from(v: &str) -> Self {
        Self::Text(v.to_owned())
    }
}

impl From<String> for Datum {
    fn from(v: String) -> Self {
        Self::Text(v)
    }
}

/// One value of a diagnostic.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Value {
    /// Its meaning.
    pub kind: ValueKind,
    /// The value.
    pub value: Datum,
    /// Its unit, `-` if it has none.
    pub unit: &'static str,
}

/// The axis that a diagnostic refers to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisRef {
    /// Logical axis number.
    pub number: u32,
    /// Name in the NC program.
    pub name: String,
}

/// One message to the user.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// The condition.
    pub id: Id,
    /// Severity.
    pub severity: Severity,
    /// Message: quantity, value, limit, axis, parameter, in this order.
    pub text: String,
    /// Position in a program or list.
    pub source: Option<Location>,
    /// The blocks that called the subroutines or cycles it is in, the last call first.
    pub calls: Vec<Location>,
    /// Cycle at which it happened, for conditions of the running machine.
    pub cycle: Option<u64>,
    /// The same in seconds of program time.
    pub time_s: Option<f64>,
    /// Axis concerned.
    pub axis: Option<AxisRef>,
    /// Values, in the vendor's order where documented.
    pub values: Vec<Value>,
    /// Value that replaced a wrong one.
    pub correction: Option<Datum>,
    /// Parameter concerned (`P-AXIS-00236`).
    pub parameter: Option<&'static str>,
    /// What the user can do about it.
    pub hint: Option<String>,
    /// Distinguishes messages with the same ID (`MID` of `#ERROR`).
    pub multiple_id: u32,
}

/// What a message may name as a parameter: the typed constants of the table, since an ID as text may be wrong.
pub(crate) trait Named {
    /// Its ID (`P-AXIS-00236`).
    fn id(self) -> Option<&'static str>;
}

/// Largest number of characters of a word that a message quotes.
pub(crate) const QUOTED_MAX: usize = 80;

/// A message whose text between backticks has at most [`QUOTED_MAX`] characters.
pub fn shortened(text: String) -> String {
    if text.len() <= QUOTED_MAX {
        return text;
    }
    let mut out = String::new();
    for (i, part) in text.split('`').enumerate() {
        if i > 0 {
            out.push('`');
        }
        match part.char_indices().nth(QUOTED_MAX).filter(|_| i % 2 == 1) {
            Some((end, _)) => out.extend([&part[..end], "..."]),
            None => out.push_str(part),
        }
    }
    out
}

impl Diagnostic {
    /// A diagnostic with severity, hint and parameter of its condition's row and the given message.
    pub fn new(condition: Condition, text: impl Into<String>) -> Self {
        Self::of(condition.row(), condition.id(), text.into())
    }

    /// A condition raised by the program itself with `#ERROR`; its number, 1 to 1000, is defined by the program.
    pub fn programmed(number: u32, text: impl Into<String>) -> Self {
        let id = Id::Vendor(number);
        Self::of(condition::row(id), id, text.into())
    }

    fn of(row: &condition::Row, id: Id, text: String) -> Self {
        Self {
            id,
            severity: row.severity,
            text: shortened(text),
            source: None,
            cycle: None,
            time_s: None,
            axis: None,
            values: Vec::new(),
            correction: None,
            calls: Vec::new(),
            parameter: row.parameter,
            hint: row.hint.map(str::to_owned),
            multiple_id: 0,
        }
    }

    /// Sets a severity that differs from the row's.
    #[must_use]
    pub fn severity(mut self, severity: Severity) -> Self {
        self.severity = severity;
        self
    }

    /// Sets the position.
    #[must_use]
    pub fn at(mut self, source: Location) -> Self {
        self.source = Some(source);
        self
    }

    /// Adds a value.
    #[must_use]
    pub fn value(mut self, kind: ValueKind, value: impl Into<Datum>, unit: &'static str) -> Self {
        self.values.push(Value { kind, value: value.into(), unit });
        self
    }

    /// Sets the axis.
    #[must_use]
    pub fn axis(mut self, number: u32, name: impl Into<String>) -> Self {
        self.axis = Some(AxisRef { number, name: name.into() });
        self
    }

    /// Sets the corrected value.
    #[must_use]
    pub fn corrected(mut self, value: impl Into<Datum>) -> Self {
        self.correction = Some(value.into());
        self
    }

    /// Names a parameter of the lists, if it has an ID (those of `kontur.lis` have none).
    #[must_use]
    pub(crate) fn parameter(mut self, parameter: impl Named) -> Self {
        self.parameter = parameter.id();
        self
    }

    /// Sets the hint.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The reaction; none if an error is only a warning here.
    fn reaction(&self) -> condition::Reaction {
        let row = condition::row(self.id);
        let milder = row.severity == Severity::Error && !self.is_error();
        if milder { condition::Reaction::None } else { row.reaction }
    }

    /// Whether the program or list is refused or aborted.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

impl Serialize for Diagnostic {
    /// The vendor's fields, all present, absent ones null.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let row = condition::row(self.id);
        let (vendor, own) = match self.id {
            Id::Vendor(n) => (Some(n), None),
            Id::Kontur(_) => (None, Some(self.id.to_string())),
        };
        let mut s = serializer.serialize_struct("Diagnostic", 18)?;
        s.serialize_field("id", &vendor)?;
        s.serialize_field("kontur_id", &own)?;
        s.serialize_field("severity", &self.severity)?;
        s.serialize_field("text", &self.text)?;
        s.serialize_field("reaction", &self.reaction().class())?;
        s.serialize_field("remedy", &row.remedy)?;
        s.serialize_field("root", &row.root)?;
        s.serialize_field("multiple_id", &self.multiple_id)?;
        s.serialize_field("source", &self.source)?;
        s.serialize_field("calls", &self.calls)?;
        s.serialize_field("cycle", &self.cycle)?;
        s.serialize_field("time_s", &self.time_s)?;
        s.serialize_field("channel", &1)?;
        s.serialize_field("axis", &self.axis)?;
        s.serialize_field("values", &self.values)?;
        s.serialize_field("correction", &self.correction)?;
        s.serialize_field("parameter", &self.parameter)?;
        s.serialize_field("hint", &self.hint)?;
        s.serialize_field("documented", &matches!(self.id, Id::Vendor(_)))?;
        s.end()
    }
}
