//! Labels of a file. Some post-processors write one in every block: numbers that increase from block to block are kept
//! as differences, a million in about 7 MB. Block numbers are kept in the same way, if required.

use super::packed::{Bytes, GROUP};
use super::{EntryId, LabelPlace};
use crate::syntax::ast::LabelKind;
use std::collections::BTreeMap;

/// Approximate memory in bytes of a label outside the increasing ones.
const OTHER_BYTES: usize = 120;

/// A label `N10:`.
#[derive(Clone, Copy, Debug)]
struct Numbered {
    section: u32,
    number: u64,
    place: LabelPlace,
}

impl Numbered {
    fn key(&self) -> (u32, u64) {
        (self.section, self.number)
    }
}

/// A group of labels of one section: the first one, and the position of the packed numbers of the others.
#[derive(Clone, Copy, Debug)]
struct Mark {
    first: Numbered,
    place: usize,
    count: usize,
}

/// Labels by section, added in the order of the text.
#[derive(Clone, Debug, Default)]
pub(in crate::exec::program) struct Labels {
    /// Labels with a number above all before it: sorted by section, number and offset at the same time.
    marks: Vec<Mark>,
    bytes: Bytes,
    last: Option<Numbered>,
    others: BTreeMap<(usize, LabelKind), LabelPlace>,
}

impl Labels {
    /// Approximate memory in bytes.
    pub(in crate::exec::program) fn bytes(&self) -> usize {
        self.bytes.end() + self.marks.len() * size_of::<Mark>() + self.others.len() * OTHER_BYTES
    }

    pub(in crate::exec::program) fn get(
        &self,
        section: usize,
        label: &LabelKind,
    ) -> Option<LabelPlace> {
        if let Some(key) = compact(section, label) {
            let group = self.marks.partition_point(|mark| mark.first.key() <= key).checked_sub(1);
            let found = group.and_then(|i| self.group(i).find(|label| label.key() == key));
            if let Some(label) = found {
                return Some(label.place);
            }
        }
        // a range of one key would need an owned label: labels are short
        self.others.get(&(section, label.clone())).copied()
    }

    /// Adds a label that lies after those added so far and is not among them.
    pub(in crate::exec::program) fn insert(
        &mut self,
        section: usize,
        label: LabelKind,
        place: LabelPlace,
    ) {
        let key = compact(section, &label);
        match key.filter(|key| self.last.is_none_or(|last| last.key() < *key)) {
            Some((section, number)) => self.append(Numbered { section, number, place }),
            None => _ = self.others.insert((section, label), place),
        }
    }

    fn append(&mut self, label: Numbered) {
        let full = |mark: &Mark| mark.count == GROUP || mark.first.section != label.section;
        let group = self.marks.last_mut().filter(|mark| !full(mark));
        if let (Some(mark), Some(before)) = (group, self.last) {
            mark.count += 1;
            self.bytes.push(label.number - before.number);
            self.bytes.push(label.place.position.offset - before.place.position.offset);
            self.bytes.push(label.place.position.line - before.place.position.line);
            self.bytes.push(code(label.place.parent) - code(before.place.parent));
        } else {
            self.marks.push(Mark { first: label, place: self.bytes.end(), count: 1 });
        }
        self.last = Some(label);
    }

    /// The labels of a group.
    fn group(&self, group: usize) -> impl Iterator<Item = Numbered> {
        let Mark { first, place, count } = self.marks[group];
        let (mut label, mut numbers) = (first, self.bytes.from(place));
        (0..count).map(move |i| {
            if i > 0 {
                label.number += numbers.next::<u64>();
                label.place.position.offset += numbers.next::<u64>();
                label.place.position.line += numbers.next::<u32>();
                label.place.parent = parent(code(label.place.parent) + numbers.next::<i64>());
            }
            label
        })
    }

    /// Whether a label lies between two positions.
    pub(super) fn any_between(&self, from: u64, to: u64) -> bool {
        let inside = |place: &LabelPlace| (from..to).contains(&place.position.offset);
        // in a group that begins before `from`, or the first label of the next one
        let next = self.marks.partition_point(|mark| mark.first.place.position.offset < from);
        let before = next.checked_sub(1).into_iter().flat_map(|i| self.group(i));
        before.chain(self.marks.get(next).map(|mark| mark.first)).any(|l| inside(&l.place))
            || self.others.values().any(inside)
    }
}

/// The structure around a label as a number; -1 if there is none.
fn code(parent: Option<EntryId>) -> i64 {
    parent.map_or(-1, i64::from)
}

fn parent(code: i64) -> Option<EntryId> {
    EntryId::try_from(code).ok()
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
    use crate::source::Position;
    use kontur_kit::Random;

    /// Labels are found as in a plain table, whatever the order of their numbers.
    #[test]
    fn labels_are_found_in_any_order() {
        for seed in 0..200 {
            let mut random = Random::new(seed);
            let (mut labels, mut table) = (Labels::default(), BTreeMap::new());
            let mut section = 0;
            for line in 1..random.pick(&[0, 10, 80, 400_u32]) {
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
            for section in 0..=section {
                for number in 0..4100 {
                    for label in
                        [LabelKind::Number(number), LabelKind::Name(format!("A{number}").into())]
                    {
                        let found = labels.get(section, &label).map(|l| (l.position, l.parent));
                        assert_eq!(found, table.get(&(section, label)).copied(), "{seed}");
                    }
                }
            }
            for _ in 0..50 {
                let from = random.below(3000) as u64;
                let to = from + random.below(30) as u64;
                let inside = |at: &Position| (from..to).contains(&at.offset);
                let expected = table.values().any(|(at, _)| inside(at));
                assert_eq!(labels.any_between(from, to), expected, "{seed}: {from} to {to}");
            }
        }
    }
}
