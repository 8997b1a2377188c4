//! Names and numbers of the axes of a project.

use super::content::Content;
use super::list::{ListText, parameters};
use crate::diag::{Condition, Diagnostic, Severity};
use crate::machine::kind::logical_number;
use crate::machine::lists;
use crate::machine::parameters::Parameters;
use crate::machine::table::{ListKind, channel as of};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Axes with their logical numbers, in the order of the channel.
type Named = Vec<(String, u32)>;

/// The axes of the first channel by their dialogs.
fn of_dialogs(
    content: &Content,
    numbers: &[u32],
    spindle: &[bool],
    said: &mut Vec<Diagnostic>,
) -> Named {
    let mut named: Vec<(u32, String, u32)> = content
        .axes
        .iter()
        .zip(numbers)
        .zip(spindle)
        .filter(|((axis, _), spindle)| {
            !**spindle && axis.channel == Some(1) && !axis.program_name.is_empty()
        })
        .map(|((axis, number), _)| (axis.index, axis.program_name.clone(), *number))
        .collect();
    named.sort_by_key(|(index, ..)| *index);
    if named.iter().zip(0..).any(|((index, ..), place)| *index != place) {
        let places: Vec<String> =
            named.iter().map(|(index, name, _)| format!("{name} {index}")).collect();
        let message = format!(
            "the dialogs of the axes leave places of the channel empty or give one twice (DefaultIndex: {}): they are taken one after the other, the first three are the main axes",
            places.join(", ")
        );
        let warning = Diagnostic::new(Condition::ProjectRead, message).severity(Severity::Warning);
        said.push(warning.hint("number the axes of the channel without gaps"));
    }
    named.into_iter().map(|(_, name, number)| (name, number)).collect()
}

/// The axes by the list of the channel.
fn of_list(list: &ListText) -> Named {
    let channel = parameters(ListKind::Channel, &[list]);
    (0..32)
        .map_while(|i| {
            let number = channel.listed(of::AXIS_NUMBER.and(i).place())?;
            Some((channel.get(of::AXIS_NAME.and(i))?, number as u32))
        })
        .collect()
}

/// Replaces the axes in the list of the channel.
fn enter(list: &mut ListText, named: &Named) {
    let mut entries = format!("gruppe[0].achs_anzahl {}\n", named.len());
    for (i, (name, number)) in named.iter().enumerate() {
        let _ = writeln!(
            entries,
            "gruppe[0].achse[{i}].bezeichnung {name}\ngruppe[0].achse[{i}].log_achs_nr {number}"
        );
    }
    let own: Vec<String> = (0..32)
        .flat_map(|i| {
            ["bezeichnung", "log_achs_nr"].map(|key| format!("gruppe[0].achse[{i}].{key}"))
        })
        .chain(["gruppe[0].achs_anzahl".to_owned()])
        .collect();
    list.replace(&own.iter().map(String::as_str).collect::<Vec<_>>(), &entries);
}

/// K-0141: two axis lists have the same number, others have different ones.
pub(super) fn same_number(content: &Content, numbers: &[u32]) -> Diagnostic {
    let twice = numbers.iter().enumerate().find(|(i, number)| numbers[..*i].contains(*number));
    let number = twice.map_or(0, |(_, number)| *number);
    let names: Vec<String> = content
        .axes
        .iter()
        .zip(numbers)
        .filter(|(_, n)| **n == number)
        .map(|(axis, _)| format!("`{}` of {}", axis.list.name, axis.list.file))
        .collect();
    let message = format!("axis lists with the same kopf.achs_nr {number}: {}", names.join(", "));
    let hint = "give each axis its own number, or remove the surplus list; lists are only numbered in their order if all of them have the same number";
    Diagnostic::new(Condition::ProjectWrong, message).hint(hint)
}

impl Content {
    /// Enters the axes of the first channel from their dialogs, as the tool does, and reports differences from its
    /// list. Empty if no dialog names an axis: the list of the channel then applies.
    pub(super) fn name_axes(
        &mut self,
        numbers: &[u32],
        spindle: &[bool],
        said: &mut Vec<Diagnostic>,
    ) -> Named {
        let named = of_dialogs(self, numbers, spindle, said);
        let list = &mut self.channels[0].list;
        let listed = of_list(list);
        if named.is_empty() || named == listed {
            return named;
        }
        if !listed.is_empty() {
            let names = |of: &Named| -> String {
                let each: Vec<String> =
                    of.iter().map(|(name, number)| format!("{name} ({number})")).collect();
                each.join(", ")
            };
            let message = format!(
                "the dialogs of the axes say {}, the list of the channel says {}: the dialogs count",
                names(&named),
                names(&listed)
            );
            let warning =
                Diagnostic::new(Condition::ProjectRead, message).severity(Severity::Warning);
            said.push(warning.hint("activate the configuration once, or make both say the same"));
        }
        enter(list, &named);
        named
    }

    /// The parameters of each axis list, over those that all axes share.
    pub(super) fn axis_parameters(&self) -> Vec<Parameters> {
        let defaults = self.axis_defaults.as_ref().map(|list| parameters(ListKind::Axis, &[list]));
        self.axes
            .iter()
            .map(|axis| {
                let mut of = defaults.clone().unwrap_or_else(|| Parameters::new(ListKind::Axis));
                of.apply(&lists::read(
                    ListKind::Axis,
                    "",
                    axis.list.text.as_bytes(),
                    &mut Vec::new(),
                ));
                of
            })
            .collect()
    }

    /// The logical numbers of the axes, and a remark if the lists had to be numbered.
    ///
    /// # Errors
    /// K-0140 if only some of the lists have the same number.
    pub(super) fn number_axes(
        &mut self,
        axes: &[Parameters],
    ) -> Result<(Vec<u32>, &'static str), Vec<Diagnostic>> {
        let mut numbers: Vec<u32> = axes.iter().map(logical_number).collect();
        let different = numbers.iter().collect::<BTreeSet<_>>().len();
        if different > 1 && different < numbers.len() {
            return Err(vec![same_number(self, &numbers)]);
        }
        if different < numbers.len() {
            // lists from one prototype, which the tool numbers
            numbers = (1..).take(axes.len()).collect();
            for (axis, number) in self.axes.iter_mut().zip(&numbers) {
                axis.list.replace(&["kopf.achs_nr"], &format!("kopf.achs_nr {number}\n"));
            }
            return Ok((numbers, "; lists with the same kopf.achs_nr, numbered in their order"));
        }
        Ok((numbers, ""))
    }
}

/// The spindles of a channel with their numbers, as they follow the axes in the note.
pub(super) fn spindles_of(channel: &Parameters) -> String {
    let spindles: Vec<String> = (0..16)
        .map_while(|i| {
            let number = channel.listed(of::SPINDLE_NUMBER.at(i))?;
            Some(format!("{} ({number})", channel.get(of::SPINDLE_NAME.at(i))?))
        })
        .collect();
    if spindles.is_empty() {
        return String::new();
    }
    format!(" and the spindles {}", spindles.join(", "))
}
