//! Values by which the command line overrides the lists (`--set X.getriebe[0].kv=5000`).

use super::key::Key;
use super::parameters::Parameters;
use super::table::{self, Indices, ListKind, Row, own};
use super::value;
use crate::diag::{Condition, Diagnostic, Location};

/// Shown in messages in place of a file.
pub(super) const OVERRIDE: &str = "--set";

/// One override: target, key and value. Targets are an axis or spindle name, several with commas (`X,Y`), all path axes
/// (`*`), `channel`, `start_up` and `kontur` (with keys that begin with `kontur.`).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    text: String,
    target: String,
    key: String,
    value: String,
}

impl Override {
    /// Target for all path axes.
    pub(super) const EVERY_AXIS: &str = "*";

    /// Parses `TARGET.key=value`.
    ///
    /// # Errors
    /// K-0073 if it does not have this form.
    pub fn parse(text: &str) -> Result<Self, Box<Diagnostic>> {
        let form = || {
            let hint = "write AXIS.key=value, channel.key=value or kontur.key=value";
            Box::new(
                Diagnostic::new(Condition::Setting, format!("`{text}` is not a setting"))
                    .hint(hint),
            )
        };
        let (left, value) = text.split_once('=').ok_or_else(form)?;
        let (left, value) = (left.trim(), value.trim());
        let (target, key) = left.split_once('.').ok_or_else(form)?;
        if target.is_empty() || key.is_empty() || value.is_empty() {
            return Err(form());
        }
        let key = if target.eq_ignore_ascii_case("kontur") { left } else { key };
        let owned = |s: &str| s.to_owned();
        Ok(Self { text: owned(text), target: owned(target), key: owned(key), value: owned(value) })
    }

    /// Axis or spindle names with commas, `*`, `channel`, `start_up` or `kontur`.
    pub fn target(&self) -> &str {
        &self.target
    }

    /// Overrides the value of the lists.
    ///
    /// # Errors
    /// K-0073 for a key or value that does not exist.
    pub(super) fn apply(&self, parameters: &mut Parameters) -> Result<(), Box<Diagnostic>> {
        let (row, indices) = self.resolve(parameters.kind())?;
        let value = value::read(row.raw, &self.value).map_err(|bad| {
            let message = format!("{}: {}", self.key, bad.reason);
            let hint = format!(
                "kontur explain {} states type, range and unit",
                if row.key.is_empty() { row.id } else { row.key }
            );
            Box::new(
                Diagnostic::new(Condition::Setting, message)
                    .hint(hint)
                    .parameter(row)
                    .at(self.location(&self.value)),
            )
        })?;
        parameters.set(row, indices, value, Some(self.location(&self.text)));
        Ok(())
    }

    /// K-0029 if an index is left out: it reads as 0, as in a list.
    pub(super) fn empty_index(&self) -> Option<Diagnostic> {
        let is_empty = Key::parse(&self.key).is_some_and(|key| key.empty_index);
        let text = format!("empty index in `{}`, read as 0", self.key);
        is_empty.then(|| Diagnostic::new(Condition::ListIndex, text).at(self.location(&self.key)))
    }

    /// The parameter that is set, if the key is valid.
    pub fn parameter(&self) -> Option<&'static Row> {
        let kind = match self.target.to_ascii_lowercase().as_str() {
            "channel" => ListKind::Channel,
            "start_up" => ListKind::StartUp,
            "kontur" => ListKind::Kontur,
            "tool" => ListKind::Tool,
            "zero" => ListKind::Zero,
            "external" => ListKind::External,
            _ => ListKind::Axis,
        };
        self.resolve(kind).ok().map(|(row, _)| row)
    }

    /// Whether it sets the cycle (`kontur.cycle_time_us`).
    pub(crate) fn sets_cycle(&self) -> bool {
        self.parameter() == Some(own::CYCLE_TIME.place().row)
    }

    fn resolve(&self, kind: ListKind) -> Result<(&'static Row, Indices), Box<Diagnostic>> {
        let key = Key::parse(&self.key);
        if let Some(found) = key.as_ref().and_then(|key| key.resolve(kind)) {
            return Ok(found);
        }
        let say =
            |message| Diagnostic::new(Condition::Setting, message).at(self.location(&self.key));
        if let Some(beyond) = key.as_ref().and_then(|key| key.beyond(kind)) {
            return Err(Box::new(say(format!("`{}`: {beyond}", self.key))));
        }
        let mut diagnostic = say(format!("`{}` is not a parameter of {}", self.key, self.target));
        if let Some(row) = table::by_id(&self.key).filter(|row| !row.key.is_empty()) {
            return Err(Box::new(diagnostic.hint(format!("write its key, `{}`", row.key))));
        }
        let shape = key.map_or_else(|| self.key.clone(), |key| key.shape);
        if let Some(near) = table::suggestions(Some(kind), &shape).first() {
            diagnostic = diagnostic.hint(if *near == self.key {
                format!("write numbers as indices of `{near}`")
            } else {
                format!("did you mean `{near}`?")
            });
        }
        Err(Box::new(diagnostic))
    }

    /// K-0073 for a target that is neither an axis nor a list.
    pub(super) fn unknown_target(&self, target: &str, names: &[&str]) -> Diagnostic {
        let message = format!("`{target}` is not an axis of the machine");
        let hint = format!(
            "use {} (several separated by commas), * for every path axis, channel, start_up, tool, zero, external or kontur",
            names.join(", ")
        );
        Diagnostic::new(Condition::Setting, message).at(self.location(target)).hint(hint)
    }

    fn location(&self, part: &str) -> Location {
        let start = self.text.find(part).unwrap_or_default();
        let column = self.text[..start].chars().count() + 1;
        Location {
            file: OVERRIDE.into(),
            line: 1,
            column: u32::try_from(column).unwrap_or(u32::MAX),
            offset: start as u64,
            length: u32::try_from(part.chars().count().max(1)).unwrap_or(u32::MAX),
            block: None,
            text: self.text.as_str().into(),
        }
    }
}
