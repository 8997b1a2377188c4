//! A trace file written by a separate thread, so that a run does not wait for formatting and disks.
//!
//! Rows are passed to it in batches, and the empty batches are returned: a few of them are all the memory required, and
//! a run that is faster than its file waits. The rows are the same, in the same order, as without a thread.

use super::batch::{Batch, Numbers};
use super::writer::Writer;
use crate::clock::now;
use kontur_interpreter::record::Rows;
use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

/// Number of rows in a batch: with fewer of them, waking the threads costs more than a twentieth of a run.
const ROWS: usize = 1024;
/// Number of batches in circulation.
const BATCHES: usize = 3;
/// Number of rows between two checks of the clock.
const LOOK_EVERY: usize = 16;
/// Longest wait before a batch is handed over, and before the thread flushes.
const PERIOD: Duration = Duration::from_millis(400);

/// A writer on a separate thread.
pub(super) struct Background {
    numbers: Numbers,
    batch: Batch,
    sent: Instant,
    /// `None` once the thread is to end.
    sender: Option<SyncSender<Batch>>,
    spare: Receiver<Batch>,
    thread: Option<JoinHandle<(Writer, io::Result<()>)>>,
}

impl std::fmt::Debug for Background {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Background").field("waiting", &self.batch.len()).finish_non_exhaustive()
    }
}

impl Background {
    /// Moves a writer of rows with these numbers to a thread.
    ///
    /// # Errors
    /// The system's, if no thread can be started.
    pub(super) fn start(writer: Writer, numbers: Numbers) -> io::Result<Self> {
        let (sender, batches) = sync_channel(BATCHES);
        let (back, spare) = sync_channel(BATCHES + 2);
        let thread =
            Builder::new().name("trace".to_owned()).spawn(move || work(writer, &batches, &back))?;
        let (sender, thread) = (Some(sender), Some(thread));
        Ok(Self { numbers, batch: Batch::default(), sent: now(), sender, spare, thread })
    }

    /// Takes every `decimate`-th cycle, from the first one on; false if the thread has ended because of an error, which
    /// [`Self::end`] returns.
    pub(super) fn write(&mut self, rows: &Rows<'_>, decimate: usize) -> bool {
        let before = self.batch.len();
        self.batch.extend(&self.numbers, rows, decimate);
        self.look(before)
    }

    /// Hands the batch over, which had `before` rows, if it is full or has waited long enough.
    fn look(&mut self, before: usize) -> bool {
        let now = self.batch.len();
        let looks = now / LOOK_EVERY > before / LOOK_EVERY;
        if now >= ROWS || looks && self.sent.elapsed() >= PERIOD { self.send() } else { true }
    }

    fn send(&mut self) -> bool {
        let empty = self.spare.try_recv().unwrap_or_default();
        let batch = std::mem::replace(&mut self.batch, empty);
        self.sent = now();
        self.sender.as_ref().is_some_and(|sender| sender.send(batch).is_ok())
    }

    /// Ends the thread when it has written everything; returns the writer, with the error that has stopped it.
    ///
    /// # Errors
    /// If the thread has panicked.
    pub(super) fn end(mut self) -> io::Result<(Writer, io::Result<()>)> {
        self.send();
        self.sender = None;
        let ended = self.thread.take().map(JoinHandle::join);
        let lost = || io::Error::other("the thread that writes the trace has failed");
        ended.and_then(Result::ok).ok_or_else(lost)
    }
}

impl Drop for Background {
    /// Waits for the thread, which removes files that have no name yet.
    fn drop(&mut self) {
        self.sender = None;
        if let Some(thread) = self.thread.take() {
            // a panic has been reported by the thread itself
            drop(thread.join());
        }
    }
}

/// Writes until all senders are gone.
fn work(
    mut writer: Writer,
    batches: &Receiver<Batch>,
    back: &SyncSender<Batch>,
) -> (Writer, io::Result<()>) {
    loop {
        let written = match batches.recv_timeout(PERIOD) {
            Ok(mut batch) => {
                let written = writer.write(&batch);
                batch.clear();
                // a batch that is no longer needed is dropped by the receiver
                drop(back.try_send(batch));
                written
            }
            Err(RecvTimeoutError::Timeout) => writer.flush(),
            Err(RecvTimeoutError::Disconnected) => return (writer, Ok(())),
        };
        if written.is_err() {
            return (writer, written);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::target::Target;
    use crate::trace::csv::{self, CsvWriter, Rows};
    use kontur_interpreter::job::Facts;
    use kontur_interpreter::record::{CycleRecord, columns};

    impl Background {
        fn push(&mut self, k: u64) -> bool {
            let before = self.batch.len();
            self.batch.push(&self.numbers, &CycleRecord { k, ..CycleRecord::default() });
            self.look(before)
        }
    }

    fn start(path: &std::path::Path) -> Background {
        let facts = Facts { cycle_us: 1000, ..Facts::default() };
        let columns = columns::select("s_mm", &facts).unwrap();
        let target = csv::Target::File(Target::create(path).unwrap());
        let writer = Writer::Csv(Box::new(CsvWriter::new(target, Rows::new(&columns, &facts))));
        Background::start(writer, Numbers::of(&columns)).unwrap()
    }

    /// Every record of several batches arrives, in order, including the last ones.
    #[test]
    fn everything_arrives_in_order() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let mut background = start(&path);
        for k in 0..5000 {
            assert!(background.push(k));
        }
        let (writer, written) = background.end().unwrap();
        written.unwrap();
        let Writer::Csv(mut writer) = writer else { panic!("{writer:?}") };
        writer.finish().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let times = text.lines().skip(1).map(|l| l.split(',').next().unwrap().to_owned());
        assert!(times.eq((0..5000).map(|k| format!("{}.{:03}000", k / 1000, k % 1000))));
    }

    /// A run that is abandoned leaves no file.
    #[test]
    fn what_is_dropped_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.csv"), "old").unwrap();
        let mut background = start(&folder.path().join("a.csv"));
        for k in 0..100_000 {
            background.push(k);
        }
        drop(background);
        let left: Vec<_> = std::fs::read_dir(folder.path()).unwrap().collect();
        assert_eq!(left.len(), 1);
        assert_eq!(std::fs::read(folder.path().join("a.csv")).unwrap(), b"old");
    }

    /// With a full disk the run is notified, and the error is the system's.
    #[test]
    #[cfg(target_os = "linux")]
    fn an_error_comes_back() {
        let mut background = start("/dev/full".as_ref());
        let mut k = 0;
        while background.push(k) {
            k += 1;
        }
        let (_, written) = background.end().unwrap();
        assert_eq!(written.unwrap_err().kind(), io::ErrorKind::StorageFull);
    }
}
