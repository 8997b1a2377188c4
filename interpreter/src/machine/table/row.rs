//! One row of the parameter table, and the functions that define it.

use super::raw::{Bound, Raw};
use crate::diag::Condition;

/// The list that a parameter belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ListKind {
    /// The list that names the others (P-STUP).
    StartUp,
    /// Channel list (P-CHAN).
    Channel,
    /// Axis list (P-AXIS).
    Axis,
    /// Tool data (P-TOOL).
    Tool,
    /// Zero offsets (P-ZERO).
    Zero,
    /// External variables (P-EXTV).
    External,
    /// kontur's own settings, `kontur.lis`.
    Kontur,
}

/// The replacement of a value out of range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Correction {
    /// The default.
    Default,
    /// The nearer end of the range.
    Limit,
    /// This value.
    Value(f64),
    /// None: the value stays and switches its function off.
    Keep,
    /// None: the machine is refused.
    Refuse,
}

/// Drive types that the manual names for a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveType {
    /// The simulated drive of the control.
    Simulation,
    /// Drives with an analog interface.
    Conventional,
    /// Drives at bus terminals.
    Terminal,
    /// Drives at the Lightbus.
    Lightbus,
    /// PROFIdrive.
    Profidrive,
    /// SERCOS.
    Sercos,
    /// CANopen.
    Canopen,
    /// Drives of KUKA.
    Kuka,
}

impl DriveType {
    /// As the manual writes it.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Simulation => "Simulation",
            Self::Conventional => "Conventional",
            Self::Terminal => "Terminal",
            Self::Lightbus => "Lightbus",
            Self::Profidrive => "Profidrive",
            Self::Sercos => "SERCOS",
            Self::Canopen => "CANopen",
            Self::Kuka => "KUKA",
        }
    }
}

/// What happens to a value out of range, as documented.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfRange {
    /// ID of the message.
    pub condition: Condition,
    /// How the value is corrected.
    pub correction: Correction,
}

/// Value of a parameter that no list states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Default {
    /// None: the parameter is absent.
    None,
    /// A number.
    Number(f64),
    /// A text.
    Text(&'static str),
    /// The value of another parameter.
    Of(&'static str),
    /// One text per value of the last index.
    PerIndex(&'static [&'static str]),
}

/// One parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// ID (`P-AXIS-00212`); empty if the documents do not print one.
    pub id: &'static str,
    /// Key with `[i]`, `[j]`, `[k]` for indices; empty if the documents do not print it (row for `explain` only).
    pub key: &'static str,
    /// Its list.
    pub list: ListKind,
    /// Data type.
    pub raw: Raw,
    /// Meaning in a few words.
    pub meaning: &'static str,
    /// Lower end of the plausible range.
    pub low: Bound,
    /// Upper end of the plausible range.
    pub high: Bound,
    /// A value with a special meaning outside the range, usually 0 = "as ...".
    pub special: Option<f64>,
    /// Value if no list states it.
    pub default: Default,
    /// Unit for linear axes (and for everything except axes), `-` if none.
    pub unit: &'static str,
    /// Unit for rotary axes and spindles.
    pub unit_rotary: &'static str,
    /// Axis types: letters of `TRS` (translatory, rotary, spindle), empty outside axis lists.
    pub axes: &'static str,
    /// Drive types in the manual, in its order; empty: all. In kontur every simulated drive can use every parameter,
    /// except those of [`needs_simu`](Self::needs_simu).
    pub drives: &'static [DriveType],
    /// A parameter of the vendor's simulated drive that acts with every plant.
    pub every_plant: bool,
    /// Reaction below the range.
    pub below: OutOfRange,
    /// Reaction above the range.
    pub above: OutOfRange,
    /// The range is checked where the function is set up, since it depends on other words.
    pub at_setup: bool,
    /// The key may occur several times in a list; its entries are numbered in their order.
    pub repeated: bool,
    /// Source document.
    pub source: &'static str,
}

/// Reaction where the documents give no ID: limited, with a number of kontur's own.
const UNDOCUMENTED: OutOfRange =
    OutOfRange { condition: Condition::ListRange, correction: Correction::Limit };

const fn row(
    list: ListKind,
    id: &'static str,
    key: &'static str,
    raw: Raw,
    meaning: &'static str,
) -> Row {
    Row {
        id,
        key,
        list,
        raw,
        meaning,
        low: Bound::None,
        high: Bound::None,
        special: None,
        default: Default::None,
        unit: "-",
        unit_rotary: "-",
        axes: "",
        drives: &[],
        every_plant: false,
        below: UNDOCUMENTED,
        above: UNDOCUMENTED,
        at_setup: false,
        repeated: false,
        source: "",
    }
}

/// A row of an axis list for all axis types.
pub(super) const fn axis(id: &'static str, key: &'static str, raw: Raw, text: &'static str) -> Row {
    let mut r = row(ListKind::Axis, id, key, raw, text);
    r.axes = "TRS";
    r.source = "TF5200 axis parameters";
    r
}

/// A row of a channel list.
pub(super) const fn chan(id: &'static str, key: &'static str, raw: Raw, text: &'static str) -> Row {
    let mut r = row(ListKind::Channel, id, key, raw, text);
    r.source = "TF5200 channel parameters";
    r
}

/// A row of a start-up list.
pub(super) const fn stup(id: &'static str, key: &'static str, raw: Raw, text: &'static str) -> Row {
    let mut r = row(ListKind::StartUp, id, key, raw, text);
    r.source = "TF5200 start-up list";
    r
}

/// A row of a tool list.
pub(super) const fn tool(id: &'static str, key: &'static str, raw: Raw, text: &'static str) -> Row {
    let mut r = row(ListKind::Tool, id, key, raw, text);
    r.source = "TF5200 tool data";
    r
}

/// A row of a list of zero offsets.
pub(super) const fn zero(id: &'static str, key: &'static str, raw: Raw, text: &'static str) -> Row {
    let mut r = row(ListKind::Zero, id, key, raw, text);
    r.source = "TF5200 zero offsets";
    r
}

/// A row of a list of external variables.
pub(super) const fn external(
    id: &'static str,
    key: &'static str,
    raw: Raw,
    text: &'static str,
) -> Row {
    let mut r = row(ListKind::External, id, key, raw, text);
    r.source = "TF5200 external variables 562826251";
    r
}

/// A row of `kontur.lis`.
pub(super) const fn own(key: &'static str, raw: Raw, text: &'static str) -> Row {
    let mut r = row(ListKind::Kontur, "", key, raw, text);
    r.source = "kontur";
    r
}

impl Row {
    /// Plausible range.
    pub(super) const fn range(mut self, low: Bound, high: Bound) -> Self {
        self.low = low;
        self.high = high;
        self
    }

    /// Default number.
    pub(super) const fn default(mut self, value: f64) -> Self {
        self.default = Default::Number(value);
        self
    }

    /// Default that is not a number.
    pub(super) const fn default_is(mut self, value: Default) -> Self {
        self.default = value;
        self
    }

    /// Value with a special meaning outside the range.
    pub(super) const fn special(mut self, value: f64) -> Self {
        self.special = Some(value);
        self
    }

    /// Units for linear and for rotary axes.
    pub(super) const fn unit(mut self, linear: &'static str, rotary: &'static str) -> Self {
        self.unit = linear;
        self.unit_rotary = rotary;
        self
    }

    /// Axis types.
    pub(super) const fn axes(mut self, axes: &'static str) -> Self {
        self.axes = axes;
        self
    }

    /// Drive types.
    pub(super) const fn drives(mut self, drives: &'static [DriveType]) -> Self {
        self.drives = drives;
        self
    }

    /// The parameter of the simulated drive acts with every plant.
    pub(super) const fn every_plant(mut self) -> Self {
        self.every_plant = true;
        self
    }

    /// Whether the parameter acts only with the plant SIMU (`kontur.axis[i].plant.model`), the vendor's simulated drive.
    pub(crate) fn needs_simu(&self) -> bool {
        self.drives == [DriveType::Simulation] && !self.every_plant
    }

    /// Documented reaction below the range.
    pub(super) const fn below(mut self, condition: Condition, correction: Correction) -> Self {
        self.below = OutOfRange { condition, correction };
        self
    }

    /// Documented reaction above the range.
    pub(super) const fn above(mut self, condition: Condition, correction: Correction) -> Self {
        self.above = OutOfRange { condition, correction };
        self
    }

    /// kontur's own reaction on both sides of the range.
    pub(super) const fn outside(mut self, condition: Condition, correction: Correction) -> Self {
        self.below = OutOfRange { condition, correction };
        self.above = self.below;
        self
    }

    /// The range is checked where the function is set up.
    pub(super) const fn at_setup(mut self) -> Self {
        self.at_setup = true;
        self
    }

    /// The key may occur several times.
    pub(super) const fn repeated(mut self) -> Self {
        self.repeated = true;
        self
    }

    /// Source document, if it is not the manual of the list.
    pub(super) const fn source(mut self, source: &'static str) -> Self {
        self.source = source;
        self
    }
}
