//! Links the channel list and the axis lists: `log_achs_nr` = `kopf.achs_nr`.

mod gantry;
mod numbers;

use super::Machine;
use super::axis::Axis;
use super::channel::Channel;
use super::external::ExternalVariables;
use super::kind::{AxisKind, kind_of, logical_number};
use super::parameters::Parameters;
use super::settled::Settled;
use super::table::param::{Place, whole};
use super::table::{ListKind, axis_general, channel as of};
use super::tools;
use crate::diag::{Condition, Diagnostic, Location, Severity};
use kontur_filters::time::CycleTime;

/// One axis or spindle of the channel list.
#[derive(Clone, Debug, PartialEq)]
struct Named {
    name: String,
    number: u32,
    spindle: bool,
    feed: bool,
    /// Place of the number.
    at: Option<Location>,
    /// Place of the name.
    name_at: Option<Location>,
}

/// Axes and spindles of the channel list in its order; gantry slaves under the names of their axis lists.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Names {
    named: Vec<Named>,
    slaves: Vec<(u32, String)>,
}

impl Names {
    /// Logical number of a name, without regard to case.
    pub(super) fn number(&self, name: &str) -> Option<u32> {
        let named = self.named.iter().map(|n| (n.number, &n.name));
        let slaves = self.slaves.iter().map(|(number, name)| (*number, name));
        named.chain(slaves).find(|(_, n)| n.eq_ignore_ascii_case(name)).map(|(number, _)| number)
    }

    /// Name of a logical number.
    pub(super) fn name(&self, number: u32) -> Option<&str> {
        let slave = self.slaves.iter().find(|(n, _)| *n == number).map(|(_, name)| name);
        let named = self.named.iter().find(|n| n.number == number).map(|n| &n.name);
        named.or(slave).map(String::as_str)
    }

    /// Every name.
    pub(super) fn all(&self) -> Vec<&str> {
        let slaves = self.slaves.iter().map(|(_, name)| name.as_str());
        self.named.iter().map(|n| n.name.as_str()).chain(slaves).collect()
    }
}

/// Reads names and numbers from the channel list.
pub(super) fn names(settled: &Settled, diagnostics: &mut Vec<Diagnostic>) -> Names {
    let channel = &settled.channel;
    let mut named = group(channel, &AXES, diagnostics);
    named.append(&mut group(channel, &SPINDLES, diagnostics));
    let mut slaves = Vec::new();
    for list in &settled.axes {
        let number = logical_number(&list.parameters);
        let is_slave = list.parameters.get(axis_general::GANTRY_MASTER) != 0;
        if is_slave && !named.iter().any(|n| n.number == number) {
            let name = list.parameters.get(axis_general::NAME);
            slaves.push((number, name.unwrap_or_else(|| format!("axis {number}"))));
        }
    }
    Names { named, slaves }
}

/// Name and number of one entry of an array of names.
struct EntryKeys {
    name: Place,
    number: Place,
}

/// Maximum number of characters in a name. Source: P-CHAN-00006, P-CHAN-00010.
const NAME_MAX: usize = 16;

/// An array of names in the channel list.
struct GroupKeys {
    /// Its key in messages.
    array: &'static str,
    /// Maximum number of entries.
    size: u32,
    spindles: bool,
    count: Place,
    entry: fn(u32) -> EntryKeys,
}

const AXES: GroupKeys = GroupKeys {
    array: "gruppe[0].achse",
    size: 32,
    spindles: false,
    count: of::AXIS_COUNT.place(),
    entry: |i| EntryKeys {
        name: of::AXIS_NAME.and(i).place(),
        number: of::AXIS_NUMBER.and(i).place(),
    },
};

const SPINDLES: GroupKeys = GroupKeys {
    array: "spindel",
    size: 16,
    spindles: true,
    count: of::SPINDLE_COUNT.place(),
    entry: |i| EntryKeys {
        name: of::SPINDLE_NAME.at(i).place(),
        number: of::SPINDLE_NUMBER.at(i).place(),
    },
};

/// One array of names. The count in the list applies; Assumption: without a count all named entries are used.
fn group(channel: &Parameters, group: &GroupKeys, diagnostics: &mut Vec<Diagnostic>) -> Vec<Named> {
    let GroupKeys { array, size, spindles, .. } = *group;
    let (count, entry) = (group.count, group.entry);
    let name_at = |i: u32| channel.set_by(entry(i).name);
    let number_at = |i: u32| channel.set_by(entry(i).number);
    let given = (0..size).filter(|i| name_at(*i).is_some()).map(|i| i + 1).max().unwrap_or(0);
    let wanted = match channel.set_by(count) {
        Some(_) => channel.listed(count).and_then(whole).unwrap_or_default(),
        None => given,
    };
    if given > wanted {
        let message =
            format!("{array}[{}]: {count} is {wanted}, further entries are ignored", given - 1);
        let at = name_at(given - 1).and_then(|s| s.at.clone());
        diagnostics.push(error(Condition::ListCount, message, at).parameter(count));
    }
    let mut found = Vec::new();
    for i in 0..wanted.min(size) {
        let Some(name) = name_at(i) else {
            let message = format!("{array}[{i}] has no name (bezeichnung), {count} is {wanted}");
            let at = channel.set_by(count).and_then(|s| s.at.clone());
            diagnostics.push(error(Condition::ListLink, message, at));
            continue;
        };
        let text = name.value.text().unwrap_or_default();
        let Some(number) = number_at(i) else {
            let message = format!("{array}[{i}]: axis {text} has no logical number (log_achs_nr)");
            diagnostics.push(error(Condition::ListLink, message, name.at.clone()));
            continue;
        };
        let value = number.value.number().and_then(whole).unwrap_or_default();
        let at = number.at.clone().or_else(|| name.at.clone());
        let name_at = name.at.clone();
        let name = usable_name(text, value, spindles, name.at.as_ref(), diagnostics);
        let feed = !spindles && channel.get(of::FEED_AXIS.and(i));
        found.push(Named { name, number: value, spindle: spindles, feed, at, name_at });
    }
    found
}

/// Names of path axes begin with A B C U V W X Y Z Q, names of spindles with S; then letters, digits and `_`.
///
/// A wrong first letter, and an axis name that is too long, are replaced as in the control: 20425, 20971 (251585675,
/// 253130635). For other wrong characters the documents give neither a number nor a replacement.
fn usable_name(
    name: &str,
    number: u32,
    spindle: bool,
    at: Option<&Location>,
    diagnostics: &mut Vec<Diagnostic>,
) -> String {
    let letters = if spindle { "S" } else { "ABCUVWXYZQ" };
    let first = name.chars().next().map(|c| c.to_ascii_uppercase());
    let begins = first.is_some_and(|c| letters.contains(c));
    let is_long = name.len() > NAME_MAX;
    if begins && !is_long && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return name.to_owned();
    }
    let what = if spindle { "a spindle" } else { "an axis" };
    let message = format!(
        "`{name}` cannot be the name of {what}: a name must begin with one of {letters}, followed by at most {} letters, digits and _",
        NAME_MAX - 1
    );
    let replaced = match (begins, is_long) {
        (false, _) | (_, true) if !spindle => (Condition::PathAxisName, format!("X{number}")),
        (false, false) if spindle => (Condition::SpindleName, "S".to_owned()),
        _ => {
            diagnostics.push(error(Condition::ListLink, message, at.cloned()));
            return name.to_owned();
        }
    };
    let (condition, used) = replaced;
    let diagnostic = error(condition, format!("{message}; {used} is used"), at.cloned());
    diagnostics.push(diagnostic.axis(number, &*used));
    used
}

fn error(condition: Condition, message: String, at: Option<Location>) -> Diagnostic {
    let mut diagnostic = Diagnostic::new(condition, message);
    diagnostic.source = at;
    diagnostic
}

/// Builds the machine; `None` if numbers or names are inconsistent (K-0031).
pub(super) fn machine(
    name: &str,
    cycle: CycleTime,
    settled: Settled,
    names: &Names,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Machine> {
    let before = diagnostics.len();
    numbers::check(&settled, names, diagnostics);
    if diagnostics.iter().skip(before).any(Diagnostic::is_error) {
        return None;
    }
    let Settled { start_up, channel, axes: lists, own, tools, zero, external } = settled;
    let mut lists: Vec<Option<Parameters>> =
        lists.into_iter().map(|l| Some(l.parameters)).collect();
    let mut take = |number: u32| -> Option<Parameters> {
        lists.iter_mut().find(|l| l.as_ref().is_some_and(|p| logical_number(p) == number))?.take()
    };
    let mut axes = Vec::new();
    let mut spindles = Vec::new();
    let mut marked = Vec::new();
    for named in &names.named {
        let parameters = take(named.number)?;
        let kind = kind(&parameters, named, diagnostics);
        let axis = Axis::new(named.name.clone(), kind, parameters, own_of(&own, named.number));
        if named.spindle {
            spindles.push(axis);
        } else {
            marked.push(named.feed);
            axes.push(axis);
        }
    }
    let mut gantry_slaves = Vec::new();
    for (number, name) in &names.slaves {
        let mut parameters = take(*number)?;
        let master = parameters.get(axis_general::GANTRY_MASTER);
        if let Some(master) = axes.iter().find(|a| a.number() == master) {
            gantry::take_over(&mut parameters, master.parameters());
        }
        let kind = kind_of(&parameters);
        gantry_slaves.push(Axis::new(name.clone(), kind, parameters, own_of(&own, *number)));
    }
    note_unnamed(&lists, diagnostics);
    let channel = Channel::new(channel, start_up, marked);
    let tools = tools::tools(&tools, axes.len(), diagnostics);
    let zero_offsets = tools::zero_offsets(&zero, axes.len(), diagnostics);
    Some(Machine {
        name: name.to_owned(),
        cycle,
        axes,
        spindles,
        gantry_slaves,
        channel,
        tools,
        zero_offsets,
        external: ExternalVariables::new(&external, diagnostics),
    })
}

/// Says which lists of axes no channel names.
fn note_unnamed(lists: &[Option<Parameters>], diagnostics: &mut Vec<Diagnostic>) {
    let left: Vec<String> = lists.iter().flatten().map(called).collect();
    // an error in the names may be the reason why a list has none
    if !left.is_empty() && !diagnostics.iter().any(Diagnostic::is_error) {
        let message =
            format!("axis lists not named by a channel, not simulated: {}", left.join(", "));
        let hint = "name them in the channel list (gruppe[0].achse[i]); a gantry slave requires its master \
                    (kenngr.gantry_ax_nr)";
        let note = Diagnostic::new(Condition::ListNoEffect, message).severity(Severity::Note);
        diagnostics.push(note.hint(hint));
    }
}

/// Number and name of an axis list.
fn called(list: &Parameters) -> String {
    let number = logical_number(list);
    list.get(axis_general::NAME).map_or(number.to_string(), |name| format!("{number} ({name})"))
}

/// The entries of `kontur.lis` that concern one axis.
fn own_of(own: &Parameters, number: u32) -> Parameters {
    let mut part = Parameters::new(ListKind::Kontur);
    let of_axis = |key: &str, index: u32| key.starts_with("kontur.axis[i]") && index == number;
    for (indices, setting) in own.settings().filter(|(i, s)| of_axis(s.row.key, i[0])) {
        part.set(setting.row, indices, setting.value.clone(), setting.at.clone());
    }
    part
}

/// The channel list determines what is a spindle; 21238, 110304 if the axis list disagrees.
fn kind(parameters: &Parameters, named: &Named, diagnostics: &mut Vec<Diagnostic>) -> AxisKind {
    let kind = kind_of(parameters);
    if (kind == AxisKind::Spindle) != named.spindle {
        let (condition, is, list) = if named.spindle {
            (Condition::SpindleWithoutType, "a spindle", "no spindle")
        } else {
            (Condition::PathAxisIsSpindle, "a path axis", "a spindle")
        };
        let message = format!(
            "{} is {is} in the channel list and {list} in its axis list (kenngr.achs_typ)",
            named.name
        );
        let at = parameters.set_by(axis_general::KIND).and_then(|s| s.at.clone());
        diagnostics.push(
            error(condition, message, at.or_else(|| named.at.clone()))
                .axis(named.number, &*named.name),
        );
    }
    kind
}
