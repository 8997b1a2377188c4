//! The settled parameters of one axis, one channel or the machine: defaults, overwritten by list after list.

use super::key::Key;
use super::lists::List;
use super::table::param::{Number, Optional, Param, Place, Switch, Text, Whole, whole};
use super::table::{self, Default, Indices, ListKind, Row};
use super::value::Value;
use crate::diag::Location;
use std::collections::BTreeMap;

/// A value that a list or an override has set.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Row of the table.
    pub row: &'static Row,
    /// Value in the units of the list.
    pub value: Value,
    /// Where it was set; `None` for the correction of a default.
    pub at: Option<Location>,
}

impl Setting {
    /// Whether it differs from the default of its row; a switch without a printed default is off.
    pub(super) fn is_changed(&self) -> bool {
        match (self.row.default, &self.value) {
            (Default::Text(default), Value::Text(text)) => text != default,
            (Default::Number(default), value) => *value != Value::Number(default),
            (_, value) => *value != Value::Number(0.0),
        }
    }
}

/// Parameters of one kind of list; those that no list states have the default of their row.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    kind: ListKind,
    settings: BTreeMap<(&'static str, Indices), Setting>,
}

impl Parameters {
    /// Without settings: every parameter has its default.
    pub fn new(kind: ListKind) -> Self {
        Self { kind, settings: BTreeMap::new() }
    }

    /// The kind of list.
    pub fn kind(&self) -> ListKind {
        self.kind
    }

    /// Applies the entries of a list; all other values stay.
    pub(crate) fn apply(&mut self, list: &List) {
        for entry in &list.entries {
            let setting =
                Setting { row: entry.row, value: entry.value.clone(), at: Some(entry.at.clone()) };
            self.settings.insert((entry.row.key, entry.indices), setting);
        }
    }

    /// Sets one value.
    pub fn set(&mut self, row: &'static Row, indices: Indices, value: Value, at: Option<Location>) {
        self.settings.insert((row.key, indices), Setting { row, value, at });
    }

    /// Everything that was set, ordered by key and index.
    pub fn settings(&self) -> impl Iterator<Item = (Indices, &Setting)> {
        self.settings.iter().map(|((_, indices), setting)| (*indices, setting))
    }

    /// Value of a key such as `getriebe[0].kv` in the units of the list: the setting, otherwise the default; `None` for
    /// an unknown key and for a parameter with neither.
    ///
    /// For keys given by a user; the code itself reads a [`Param`].
    pub fn raw(&self, key: &str) -> Option<Value> {
        let (row, indices) = Key::parse(key)?.resolve(self.kind)?;
        self.of(row, indices)
    }

    /// The setting of a key such as `getriebe[0].kv`, `None` if it is not set.
    pub fn setting(&self, key: &str) -> Option<&Setting> {
        let (row, indices) = Key::parse(key)?.resolve(self.kind)?;
        self.settings.get(&(row.key, indices))
    }

    /// The value of a parameter in mm (deg), s and ratios.
    pub(in crate::machine) fn get<K: Kind>(&self, param: Param<K>) -> K::Value {
        K::read(self, param.place())
    }

    /// The entries of an array that are set, with their first index.
    pub(super) fn array<V>(
        &self,
        array: Param<impl Kind<Value = Option<V>>>,
    ) -> impl Iterator<Item = (u32, V)> {
        let key = array.place().row.key;
        let set = self.settings().filter(move |(_, setting)| setting.row.key == key);
        set.filter_map(move |(indices, _)| Some((indices[0], self.get(array.at(indices[0]))?)))
    }

    /// The number of a parameter in the units of the list; `None` if neither list nor row has one.
    pub(in crate::machine) fn listed(&self, at: impl Into<Place>) -> Option<f64> {
        let at = at.into();
        self.of(at.row, at.indices)?.number()
    }

    /// The setting of a parameter, `None` if it is not set.
    pub(in crate::machine) fn set_by(&self, at: impl Into<Place>) -> Option<&Setting> {
        let at = at.into();
        self.settings.get(&(at.row.key, at.indices))
    }

    /// The number of a parameter in mm (deg), s and ratios instead of 0.1 um, us and 0.1 %.
    fn converted(&self, at: Place) -> Option<f64> {
        Some(convert(at.row, self.listed(at)?))
    }

    /// Value of a row, see [`raw`](Self::raw).
    pub fn of(&self, row: &'static Row, indices: Indices) -> Option<Value> {
        if let Some(setting) = self.settings.get(&(row.key, indices)) {
            return Some(setting.value.clone());
        }
        match row.default {
            Default::None => None,
            Default::Number(x) => Some(Value::Number(x)),
            Default::Text(text) => Some(Value::Text(text.to_owned())),
            Default::Of(id) => self.of(table::by_id(id)?, indices),
            Default::PerIndex(texts) => {
                let last = row.key.matches('[').count().checked_sub(1)?;
                let text = texts.get(usize::try_from(*indices.get(last)?).ok()?)?;
                Some(Value::Text((*text).to_owned()))
            }
        }
    }
}

/// How values of a kind are read.
pub(crate) trait Kind: Copy {
    /// The type that the code receives.
    type Value;

    /// The value in force.
    fn read(parameters: &Parameters, at: Place) -> Self::Value;
}

impl Kind for Number {
    type Value = f64;

    fn read(parameters: &Parameters, at: Place) -> f64 {
        // the row has a default, see `Param::new`
        parameters.converted(at).unwrap_or_default()
    }
}

impl Kind for Optional {
    type Value = Option<f64>;

    fn read(parameters: &Parameters, at: Place) -> Option<f64> {
        parameters.converted(at)
    }
}

impl Kind for Whole {
    type Value = u32;

    fn read(parameters: &Parameters, at: Place) -> u32 {
        parameters.listed(at).and_then(whole).unwrap_or_default()
    }
}

impl Kind for Switch {
    type Value = bool;

    fn read(parameters: &Parameters, at: Place) -> bool {
        parameters.listed(at).is_some_and(|x| x.abs() > 0.0)
    }
}

impl Kind for Text {
    type Value = Option<String>;

    fn read(parameters: &Parameters, at: Place) -> Option<String> {
        parameters.of(at.row, at.indices)?.text().map(str::to_owned)
    }
}

/// A number of a list in internal units.
///
/// Division is used instead of reciprocal factors, so that the result is the double nearest to the decimal value.
fn convert(row: &Row, x: f64) -> f64 {
    match row.unit {
        "0.1um" | "0.0001mm" => x / 1e4,
        "um" | "um/s" | "0.1%" => x / 1e3,
        "us" => x / 1e6,
        "0.01/s" | "%" => x / 1e2,
        "m/s3" => x * 1e3,
        _ => x,
    }
}
