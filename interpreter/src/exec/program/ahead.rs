//! A program that is decoded on its own thread, ahead of the machine.
//!
//! Steps are handed over in parcels, of which few exist at a time, so the program is never far ahead. Where it reads
//! the state of the machine it hands over what it has and waits for an answer, see [`Live`](crate::exec::live::Live);
//! the machine answers when it needs the step that is being decoded. So every step is the one that would have been
//! decoded on demand. The thread ends with the program, and as soon as nobody takes its steps any more.

use super::executor::Executor;
use crate::diag::Diagnostic;
use crate::exec::step::{ShapingSetup, Step, Told};
use crate::machine::Machine;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};

/// Most steps of a parcel: enough that its hand-over does not count.
const STEPS: usize = 128;

/// Number of parcels that wait to be taken.
const PARCELS: usize = 4;

/// A step, and what else its decoding has brought about.
#[derive(Debug)]
pub(crate) struct Decoded {
    pub step: Step,
    /// Blocks executed so far.
    pub blocks: u64,
    /// What few steps bring about.
    pub rare: Option<Box<Rare>>,
}

/// See [`Decoded`].
#[derive(Debug)]
pub(crate) struct Rare {
    pub diagnostics: Vec<Diagnostic>,
    /// Files opened.
    pub files: Vec<Opened>,
    /// The machine and its kernels, if `#MACHINE DATA` has changed them.
    pub changed: Option<(Arc<Machine>, ShapingSetup)>,
}

/// A program file, and how it was found.
#[derive(Clone, Debug)]
pub(crate) struct Opened {
    /// Its full name.
    pub name: Arc<str>,
    /// Its name as written.
    pub written: Box<str>,
    /// The file in which that is written; `None`: the main program.
    pub caller: Option<Arc<str>>,
}

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

    /// Hands over a step; false if nobody takes it any more.
    fn push(&mut self, decoded: Decoded) -> bool {
        self.asked = false;
        self.decoded.push(decoded);
        self.decoded.len() < STEPS || self.send(false)
    }

    fn send(&mut self, asks: bool) -> bool {
        let decoded = std::mem::replace(&mut self.decoded, Vec::with_capacity(STEPS));
        self.parcels.send(Parcel { decoded, asks }).is_ok()
    }
}

/// The end of the machine's thread.
#[derive(Debug)]
pub(crate) struct Ahead {
    parcels: Receiver<Parcel>,
    answers: Sender<Told>,
    decoded: std::vec::IntoIter<Decoded>,
    asked: bool,
}

impl Ahead {
    /// The next step; `told` goes to the program if it needs it. `None` if the thread has ended.
    pub(crate) fn next(&mut self, told: &mut Told) -> Option<Decoded> {
        loop {
            if let Some(decoded) = self.decoded.next() {
                return Some(decoded);
            }
            if std::mem::take(&mut self.asked) {
                self.answers.send(std::mem::take(told)).ok()?;
            }
            let Parcel { decoded, asks } = self.parcels.recv().ok()?;
            (self.decoded, self.asked) = (decoded.into_iter(), asks);
        }
    }
}

/// The two ends of a connection between a program and the machine that runs it.
pub(crate) fn connection() -> (Ahead, impl FnOnce(Box<Executor>) + Send + 'static) {
    let (parcels, taken) = sync_channel(PARCELS);
    let (answers, answered) = channel();
    let decoded = Vec::with_capacity(STEPS);
    let line = Line { parcels, answers: answered, decoded, asked: false };
    let work = move |mut executor: Box<Executor>| {
        let live = &mut executor.decoder.live;
        live.connect(line);
        loop {
            let decoded = executor.decode();
            let over = matches!(decoded.step, Step::End { .. });
            let Some(line) = executor.decoder.live.line() else { return };
            if !line.push(decoded) {
                return;
            }
            if over {
                line.send(false);
                return;
            }
        }
    };
    let ahead = Ahead { parcels: taken, answers, decoded: Vec::new().into_iter(), asked: false };
    (ahead, work)
}
