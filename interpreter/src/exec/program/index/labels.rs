//! Labels of a file. Some post-processors give one to every block: numbers that rise from block to block are kept in a third
//! of the memory that the others take.

use super::{EntryId, LabelPlace};
use crate::source::Position;
use crate::syntax::ast::LabelKind;
use std::collections::BTreeMap;

/// No structure around a label; there are fewer entries than that.
const NO_PARENT: EntryId = EntryId::MAX;

/// A label `N10:`.
#[derive(Clone, Copy, Debug)]
struct Numbered {
    number: u64,
    offset: u64,
    line: u32,
    section: u32,
    parent: EntryId,
}

impl Numbered {
    fn new(section: u32, number: u64, LabelPlace { position, parent }: LabelPlace) -> Self {
        let Position { offset, line } = position;
        Self { number, offset, line, section, parent: parent.unwrap_or(NO_PARENT) }
    }

    fn key(&self) -> (u32, u64) {
        (self.section, self.number)
    }

    fn place(&self) -> LabelPlace {
        let position = Position { offset: self.offset, line: self.line };
        LabelPlace { position, parent: Some(self.parent).filter(|id| *id != NO_PARENT) }
    }
}

/// Labels by section, entered in the order of the text.
#[derive(Clone, Debug, Default)]
pub(super) struct Labels {
    /// Those whose number is above that of each one before it: sorted by section, number and offset alike.
    rising: Vec<Numbered>,
    others: BTreeMap<(usize, LabelKind), LabelPlace>,
}

impl Labels {
    pub(super) fn len(&self) -> usize {
        self.rising.len() + self.others.len()
    }

    pub(super) fn get(&self, section: usize, label: &LabelKind) -> Option<LabelPlace> {
        if let Some(key) = compact(section, label)
            && let Ok(i) = self.rising.binary_search_by_key(&key, Numbered::key)
        {
            return Some(self.rising[i].place());
        }
        // a range of one key would need an owned label: labels are short
        self.others.get(&(section, label.clone())).copied()
    }

    /// Enters a label that lies behind those entered so far and is not among them.
    pub(super) fn insert(&mut self, section: usize, label: LabelKind, place: LabelPlace) {
        let key = compact(section, &label);
        match key.filter(|key| self.rising.last().is_none_or(|last| last.key() < *key)) {
            Some((section, number)) => self.rising.push(Numbered::new(section, number, place)),
            None => _ = self.others.insert((section, label), place),
        }
    }

    /// True if a label lies between two places.
    pub(super) fn any_between(&self, from: u64, to: u64) -> bool {
        let next = self.rising.partition_point(|label| label.offset < from);
        self.rising.get(next).is_some_and(|label| label.offset < to)
            || self.others.values().any(|label| (from..to).contains(&label.position.offset))
    }
}

/// Section and number of a numbered label.
fn compact(section: usize, label: &LabelKind) -> Option<(u32, u64)> {
    match label {
        LabelKind::Number(number) => Some((u32::try_from(section).ok()?, *number)),
        LabelKind::Name(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_kit::Random;

    /// Whatever the order of the numbers, labels are found as in a plain table.
    #[test]
    fn labels_are_found_in_any_order() {
        for seed in 0..200 {
            let mut random = Random::new(seed);
            let (mut labels, mut table) = (Labels::default(), BTreeMap::new());
            let mut section = 0;
            for line in 1..random.pick(&[0, 10, 80_u32]) {
                let number = match random.below(4) {
                    0 => random.below(100) as u64,
                    _ => 10 * u64::from(line),
                };
                let label = match random.below(8) {
                    0 => LabelKind::Name(format!("A{number}").into()),
                    _ => LabelKind::Number(number),
                };
                section += usize::from(random.below(20) == 0);
                let position = Position { offset: 7 * u64::from(line), line };
                let parent = (random.below(2) == 0).then_some(line);
                if labels.get(section, &label).is_none() {
                    labels.insert(section, label.clone(), LabelPlace { position, parent });
                    table.insert((section, label), (position, parent));
                }
            }
            assert_eq!(labels.len(), table.len());
            for section in 0..=section {
                for number in 0..1000 {
                    for label in
                        [LabelKind::Number(number), LabelKind::Name(format!("A{number}").into())]
                    {
                        let found = labels.get(section, &label).map(|l| (l.position, l.parent));
                        assert_eq!(found, table.get(&(section, label)).copied(), "{seed}");
                    }
                }
            }
            for _ in 0..50 {
                let from = random.below(600) as u64;
                let to = from + random.below(30) as u64;
                let inside = |at: &Position| (from..to).contains(&at.offset);
                let expected = table.values().any(|(at, _)| inside(at));
                assert_eq!(labels.any_between(from, to), expected, "{seed}: {from} to {to}");
            }
        }
    }
}
