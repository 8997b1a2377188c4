//! Control statements in the order of the text. A program may consist only of them: a million takes about 6 MB.
//!
//! The last statements are kept unpacked. For earlier ones, position and keyword are packed as differences, and their
//! partners are found again by scanning the statements around them: this works for the usual structure, which ends a
//! few statements later. Where it does not, as in a long loop or after a fault, the whole entry is kept separately.

use super::entry::{Entry, EntryId};
use super::keyword::Keyword;
use super::packed::{Bytes, GROUP, Numbers};
use crate::source::Position;
use smallvec::SmallVec;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Number of statements scanned to find a partner.
const NEAR: usize = 32;

/// The last group read, with the partners of its statements: the next request is usually close to it.
#[derive(Clone, Debug)]
struct Near {
    group: usize,
    entries: Vec<Entry>,
}

/// Start of a group.
#[derive(Clone, Copy, Debug)]
struct Mark {
    position: Position,
    /// Position of the packed numbers.
    place: usize,
    /// Innermost structure around its first statement.
    inside: Option<EntryId>,
}

/// See the module.
#[derive(Debug, Default)]
pub(super) struct Entries {
    marks: Vec<Mark>,
    bytes: Bytes,
    /// Packed statements whose partners the scan does not find.
    special: BTreeMap<EntryId, Entry>,
    /// Statements after the packed ones, each with the innermost structure around it when it was added.
    recent: Vec<(Entry, Option<EntryId>)>,
    near: Mutex<Option<Near>>,
}

/// Effect of a statement on the structure around it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Opens,
    Clause,
    Closes,
    /// None: `#IF` and comments are handled separately.
    None,
}

fn role(keyword: Keyword) -> Role {
    use Keyword::{ConditionalElse, ConditionalEnd, ConditionalIf};
    match keyword {
        ConditionalIf | ConditionalElse | ConditionalEnd => Role::None,
        _ if keyword.closer().is_some() => Role::Opens,
        _ => match keyword.opener().and_then(Keyword::closer) {
            Some(closer) if closer == keyword => Role::Closes,
            Some(_) => Role::Clause,
            None => Role::None,
        },
    }
}

impl Entries {
    pub(super) fn len(&self) -> usize {
        self.packed() + self.recent.len()
    }

    fn packed(&self) -> usize {
        self.marks.len() * GROUP
    }

    /// Approximate memory in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.bytes.end()
            + self.marks.len() * size_of::<Mark>()
            + self.special.len() * 2 * size_of::<Entry>()
    }

    /// Adds a statement after the others; `inside` is the innermost structure around it.
    pub(super) fn push(&mut self, entry: Entry, inside: Option<EntryId>) {
        self.recent.push((entry, inside));
        if self.recent.len() >= 2 * GROUP + NEAR {
            self.pack();
        }
    }

    /// Packs the oldest group; [`NEAR`] other statements follow it.
    fn pack(&mut self) {
        let first = self.packed();
        let group: Vec<_> = self.recent.drain(..GROUP).collect();
        let Some((Entry { position, .. }, inside)) = group.first().copied() else { return };
        self.marks.push(Mark { position, place: self.bytes.end(), inside });
        let mut before = position;
        for (entry, _) in &group {
            let Position { offset, line } = entry.position;
            self.bytes.push(entry.keyword as u8);
            self.bytes.push(offset - before.offset);
            self.bytes.push(line - before.line);
            self.bytes.push(entry.span.start);
            before = entry.position;
        }
        let found = self.found(self.marks.len() - 1);
        for ((id, found), (entry, _)) in (first..).zip(found).zip(group) {
            if found != entry {
                self.special.insert(id as EntryId, entry);
            }
        }
    }

    /// Keyword and position of statements, beginning with `first`.
    fn places(&self, first: EntryId) -> impl Iterator<Item = (EntryId, Entry)> {
        let first = first as usize;
        let behind = first.saturating_sub(self.packed());
        let recent = self.recent.get(behind..).unwrap_or_default().iter().map(|(entry, _)| *entry);
        let groups = first / GROUP..self.marks.len().max(first / GROUP);
        let packed = groups.flat_map(|group| self.group(group)).skip(first % GROUP);
        let packed = packed.take(self.packed().saturating_sub(first));
        (first as EntryId..).zip(packed.chain(recent))
    }

    /// The statements of a group, without their partners.
    fn group(&self, group: usize) -> impl Iterator<Item = Entry> {
        let mut at = self.marks[group].position;
        let mut numbers: Numbers<'_> = self.bytes.from(self.marks[group].place);
        (0..GROUP).map(move |_| {
            let keyword = Keyword::of_code(numbers.next());
            at.offset += numbers.next::<u64>();
            at.line += numbers.next::<u32>();
            let start = numbers.next::<u32>() as usize;
            Entry::alone(at, start, keyword)
        })
    }

    /// The statements of a group, with the partners found by scanning up to [`NEAR`] statements after them.
    fn found(&self, group: usize) -> Vec<Entry> {
        let first = (group * GROUP) as EntryId;
        let mut entries: Vec<Entry> =
            self.places(first).take(GROUP + NEAR).map(|(_, entry)| entry).collect();
        let mut outside = self.marks[group].inside;
        // clauses of the open structures, the outer one first: the one around the group, then those that begin in it
        let mut parts: Vec<SmallVec<[usize; 4]>> = vec![SmallVec::new()];
        for i in 0..entries.len() {
            let id = first + i as EntryId;
            let role = role(entries[i].keyword);
            let open = match parts.len() {
                0 | 1 => outside,
                _ => parts.last().and_then(|p| p.first()).map(|at| first + *at as EntryId),
            };
            if role == Role::Opens {
                (entries[i].open, entries[i].parent) = (Some(id), open);
                parts.push(SmallVec::from_slice(&[i]));
                continue;
            } else if role == Role::None {
                entries[i].parent = open;
                continue;
            }
            let around = open.and_then(|open| match open.checked_sub(first) {
                Some(at) => entries[at as usize].parent,
                None => self.get(open).parent,
            });
            (entries[i].open, entries[i].parent) = (open, around);
            let Some(structure) = parts.last_mut() else { break };
            if let Some(before) = structure.last() {
                entries[*before].next = Some(id);
            }
            structure.push(i);
            if role == Role::Closes {
                for part in structure.drain(..) {
                    entries[part].end = Some(id);
                }
                if parts.len() > 1 {
                    parts.pop();
                } else {
                    outside = around;
                }
            }
        }
        entries.truncate(GROUP);
        entries
    }

    /// Reads a group through the cache.
    fn near<T>(&self, group: usize, read: impl FnOnce(&[Entry]) -> T) -> T {
        let lock = || self.near.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(near) = &*lock()
            && near.group == group
        {
            return read(&near.entries);
        }
        let mut entries = self.found(group);
        let first = (group * GROUP) as EntryId;
        for (id, entry) in self.special.range(first..first + GROUP as EntryId) {
            entries[(id - first) as usize] = *entry;
        }
        let answer = read(&entries);
        *lock() = Some(Near { group, entries });
        answer
    }

    pub(super) fn get(&self, id: EntryId) -> Entry {
        match (id as usize).checked_sub(self.packed()) {
            Some(i) => self.recent[i].0,
            None => match self.special.get(&id) {
                Some(entry) => *entry,
                None => self.near(id as usize / GROUP, |entries| entries[id as usize % GROUP]),
            },
        }
    }

    /// Changes the partners of one statement.
    pub(super) fn change(&mut self, id: EntryId, change: impl FnOnce(&mut Entry)) {
        if let Some(i) = (id as usize).checked_sub(self.packed()) {
            change(&mut self.recent[i].0);
        } else {
            let mut entry = self.get(id);
            change(&mut entry);
            self.special.insert(id, entry);
            self.near = Mutex::default();
        }
    }

    /// The last statement that begins at an offset or before it, and its position.
    pub(super) fn last_up_to(&self, offset: u64) -> Option<(EntryId, Position)> {
        let recent = self.recent.partition_point(|(entry, _)| entry.position.offset <= offset);
        if let Some(last) = recent.checked_sub(1) {
            return Some(((self.packed() + last) as EntryId, self.recent[last].0.position));
        }
        // called for every sequence of motions: an offset before the first mark needs no lock
        if self.marks.first().is_none_or(|first| offset < first.position.offset) {
            return None;
        }
        let begins = |group: usize| self.marks.get(group).map(|mark| mark.position.offset);
        let last =
            self.near.lock().unwrap_or_else(PoisonError::into_inner).as_ref().map(|n| n.group);
        let holds = |group: &usize| {
            begins(*group).is_some_and(|begin| begin <= offset)
                && begins(group + 1).is_none_or(|end| offset < end)
        };
        let group = last.filter(holds).or_else(|| {
            self.marks.partition_point(|mark| mark.position.offset <= offset).checked_sub(1)
        })?;
        self.near(group, |entries| {
            let up_to = entries.partition_point(|entry| entry.position.offset <= offset);
            let last = up_to.checked_sub(1)?;
            Some(((group * GROUP + last) as EntryId, entries[last].position))
        })
    }

    /// Comments, real-time cycles and `#IF` statements.
    pub(super) fn silencing(&self) -> impl Iterator<Item = Entry> {
        let recent = self.recent.iter().map(|(entry, _)| entry);
        let silences = |e: &&Entry| e.keyword.is_silent() || e.keyword == Keyword::ConditionalIf;
        // their partners are not found by the scan: they are special
        self.special.values().chain(recent).filter(silences).copied()
    }
}
