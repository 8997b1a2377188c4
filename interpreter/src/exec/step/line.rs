//! The connection between a program and the machine that runs it on another thread.

use super::Told;
use super::decoded::Decoded;
use kontur_motion::block::SpareBlocks;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};

/// Most steps of a parcel: enough that its hand-over does not count.
const STEPS: usize = 128;

/// Number of parcels that wait to be taken.
const PARCELS: usize = 4;

/// Consecutive steps.
#[derive(Debug, Default)]
struct Parcel {
    decoded: Vec<Decoded>,
    /// Whether the program needs an answer to decode the next one.
    asks: bool,
}

/// The end of the program's thread.
#[derive(Debug)]
pub(in crate::exec) struct Line {
    parcels: SyncSender<Parcel>,
    answers: Receiver<Told>,
    /// Blocks that the machine has left, and those that have arrived.
    spent: Receiver<SpareBlocks>,
    spare: SpareBlocks,
    decoded: Vec<Decoded>,
    /// Whether the machine has been asked during the current step.
    asked: bool,
}

impl Line {
    /// The state of the machine at the step that is being decoded; `None` if that is known or nobody answers any more.
    pub(in crate::exec) fn ask(&mut self) -> Option<Told> {
        if std::mem::replace(&mut self.asked, true) {
            return None;
        }
        self.send(true).then(|| self.answers.recv().ok())?
    }

    /// Hands over a step; false if nobody takes it any more. What the machine has left is added to `spare` sooner or later.
    pub(in crate::exec) fn push(&mut self, decoded: Decoded, spare: &mut SpareBlocks) -> bool {
        self.asked = false;
        self.decoded.push(decoded);
        if !self.spare.is_empty() {
            spare.append(&mut self.spare);
        }
        self.decoded.len() < STEPS || self.send(false)
    }

    /// Hands over what was decoded; `asks`: the program waits for an answer. False if nobody takes it any more.
    pub(in crate::exec) fn send(&mut self, asks: bool) -> bool {
        self.spent.try_iter().for_each(|mut spent| self.spare.append(&mut spent));
        let decoded = std::mem::replace(&mut self.decoded, Vec::with_capacity(STEPS));
        self.parcels.send(Parcel { decoded, asks }).is_ok()
    }
}

/// The end of the machine's thread.
#[derive(Debug)]
pub(crate) struct Ahead {
    parcels: Receiver<Parcel>,
    answers: Sender<Told>,
    spent: Sender<SpareBlocks>,
    decoded: std::vec::IntoIter<Decoded>,
    asked: bool,
}

impl Ahead {
    /// The next step; `told` goes to the program if it needs it, blocks that were left with the next parcel. `None` if the thread
    /// has ended.
    pub(crate) fn next(&mut self, told: &mut Told, left: &mut SpareBlocks) -> Option<Decoded> {
        loop {
            if let Some(decoded) = self.decoded.next() {
                return Some(decoded);
            }
            if !left.is_empty() {
                // at the end of the program nobody needs them
                let _ = self.spent.send(std::mem::take(left));
            }
            if std::mem::take(&mut self.asked) {
                self.answers.send(std::mem::take(told)).ok()?;
            }
            let Parcel { decoded, asks } = self.parcels.recv().ok()?;
            (self.decoded, self.asked) = (decoded.into_iter(), asks);
        }
    }
}

/// The two ends of a connection.
pub(in crate::exec) fn line() -> (Ahead, Line) {
    let (parcels, taken) = sync_channel(PARCELS);
    let (answers, answered) = channel();
    let (left, spent) = channel();
    let line = Line {
        parcels,
        answers: answered,
        spent,
        spare: SpareBlocks::default(),
        decoded: Vec::with_capacity(STEPS),
        asked: false,
    };
    let decoded = Vec::new().into_iter();
    (Ahead { parcels: taken, answers, spent: left, decoded, asked: false }, line)
}
