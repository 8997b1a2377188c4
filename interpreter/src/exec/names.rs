//! Names of the axes in the program, which `#CALL AX`, `#PUT AX` and `#SET AX` change.

use super::fault::{Fault, Outcome};
use crate::diag::{Condition, ValueKind};
use crate::machine::Axis;
use crate::syntax::ast::{Group, Ident, ItemKind, Span};

/// Names of the axes in the program.
#[derive(Debug)]
pub(super) struct AxisNames {
    /// `None` for an axis that was released.
    axes: Vec<Option<String>>,
    /// Their logical numbers.
    numbers: Vec<u32>,
    /// Letters of one-letter axes.
    letters: [Option<u8>; 26],
    /// Whether parsed blocks are out of date.
    changed: bool,
}

impl AxisNames {
    /// The names of the lists.
    pub(super) fn new(axes: &[Axis]) -> Self {
        let (names, numbers) = axes.iter().map(|a| (Some(a.name().to_owned()), a.number())).unzip();
        let mut names = Self { axes: names, numbers, letters: [None; 26], changed: false };
        names.find_letters();
        names
    }

    /// Renames an axis; `None` releases it.
    pub(super) fn rename(&mut self, axis: usize, name: Option<String>) {
        self.axes[axis] = name;
        self.find_letters();
        self.changed = true;
    }

    /// Releases all axes.
    pub(super) fn release_all(&mut self) {
        self.axes.fill(None);
        self.find_letters();
        self.changed = true;
    }

    /// Names of the axes in the channel.
    pub(super) fn in_channel(&self) -> impl Iterator<Item = &str> {
        self.axes.iter().flatten().map(String::as_str)
    }

    /// Names of several characters that the parser must recognise, of the axes in the channel and of spindles.
    pub(super) fn long_names<'a>(&self, of_spindles: impl Iterator<Item = &'a str>) -> Vec<String> {
        let long = |name: &&str| name.len() > 1;
        let axes = self.in_channel().filter(long).map(str::to_owned);
        axes.chain(of_spindles.filter(long).map(str::to_owned)).collect()
    }

    /// The names by axis, `?` for a released one.
    pub(super) fn all(&self) -> Vec<String> {
        (0..self.axes.len()).map(|axis| self.name(axis).to_owned()).collect()
    }

    /// Whether names have changed since the last call.
    pub(super) fn take_changed(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    fn find_letters(&mut self) {
        self.letters = [None; 26];
        for (i, name) in self.axes.iter().enumerate() {
            if let Some([letter @ b'A'..=b'Z']) = name.as_deref().map(str::as_bytes) {
                self.letters[usize::from(letter - b'A')] = u8::try_from(i).ok();
            }
        }
    }

    /// Axis of a letter.
    pub(super) fn of_letter(&self, letter: u8) -> Option<usize> {
        let i = usize::from(letter.wrapping_sub(b'A'));
        self.letters.get(i).copied().flatten().map(usize::from)
    }

    /// Axis of a name, in upper or lower case.
    pub(super) fn of_name(&self, name: &str) -> Option<usize> {
        self.axes.iter().position(|n| n.as_deref().is_some_and(|n| n.eq_ignore_ascii_case(name)))
    }

    /// Axis of a name in a `#` command; 20797 if there is none.
    pub(super) fn in_command(&self, name: &Ident) -> Outcome<usize> {
        self.of_name(&name.text).ok_or_else(|| {
            let text = format!("unknown axis `{}`", name.text);
            Fault::new(Condition::AxisNameUnknown, text, name.span).hint(self.hint())
        })
    }

    /// The axes named in groups of a command.
    pub(super) fn all_in_command(&self, groups: &[Group]) -> Outcome<Vec<usize>> {
        let mut axes = Vec::new();
        for item in groups.iter().flat_map(|group| &group.items) {
            match &item.kind {
                ItemKind::Flag(name) => axes.push(self.in_command(name)?),
                ItemKind::Missing => {}
                _ => {
                    let text = "an axis name is expected";
                    return Err(Fault::new(Condition::AxisNameUnknown, text, item.span));
                }
            }
        }
        Ok(axes)
    }

    /// Hint that lists the existing axes.
    pub(super) fn hint(&self) -> String {
        let names: Vec<&str> = self.in_channel().collect();
        if names.is_empty() {
            return "the channel list does not name an axis (gruppe[0].achse[0].bezeichnung)"
                .to_owned();
        }
        format!("axes of the channel: {}", names.join(", "))
    }

    /// Whether an axis is in the channel.
    pub(super) fn has(&self, axis: usize) -> bool {
        self.axes[axis].is_some()
    }

    /// Name of an axis, `?` for a released one.
    pub(super) fn name(&self, axis: usize) -> &str {
        self.axes[axis].as_deref().unwrap_or("?")
    }

    /// Logical number of an axis.
    pub(super) fn number(&self, axis: usize) -> u32 {
        self.numbers[axis]
    }

    /// An axis that is moved twice by one block.
    pub(super) fn twice(&self, axis: usize, span: Span) -> Box<Fault> {
        let (number, name) = (self.numbers[axis], self.name(axis).to_owned());
        let text = format!("axis {name} twice in one block");
        Fault::new(Condition::AxisTwice, text, span)
            .with(|d| d.axis(number, name).value(ValueKind::AxisNumber, number, "-"))
    }

    /// An address that no axis of the channel has.
    pub(super) fn unknown(&self, name: &str, span: Span) -> Box<Fault> {
        let text = format!("the channel has no axis {name}");
        Fault::new(Condition::AxisOrCommandExpected, text, span).hint(self.hint())
    }
}
