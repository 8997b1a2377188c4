//! Ctrl-C: a run stops after the present cycle or block, so that traces and summary are complete up to there.

use crate::clock::now;
use kontur_interpreter::job::Stop;
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{LazyLock, OnceLock};
use std::time::{Duration, Instant};

/// Nothing is running that would have to be completed.
const IDLE: u8 = 0;
const RUNNING: u8 = 1;
const REQUESTED: u8 = 2;

static STATE: AtomicU8 = AtomicU8::new(IDLE);

/// Set by Ctrl-C: also ends a run that executes blocks without reaching a cycle.
static STOP: LazyLock<Stop> = LazyLock::new(Stop::default);

/// What Ctrl-C sets, for runs to read.
pub(crate) fn stop() -> Stop {
    STOP.clone()
}

/// Exit code of a process that Ctrl-C ended at once, as in shells: 128 + SIGINT.
const ENDED: i32 = 130;

/// When a run was first asked to stop.
static ASKED: OnceLock<Instant> = OnceLock::new();

/// Time within which signals count as one: a supervisor signals a process and then its group.
const TOGETHER: Duration = Duration::from_millis(500);

/// Installs the handler of Ctrl-C. The first Ctrl-C stops a run in an orderly way; without a run, and the second time,
/// it ends the process.
pub(crate) fn listen() {
    let listening = ctrlc::set_handler(|| {
        let asked =
            STATE.compare_exchange(RUNNING, REQUESTED, Ordering::Relaxed, Ordering::Relaxed);
        if asked.is_err() {
            if ASKED.get().is_some_and(|at| at.elapsed() < TOGETHER) {
                return;
            }
            std::process::exit(ENDED);
        }
        ASKED.get_or_init(now);
        STOP.set();
    });
    // without a handler Ctrl-C ends the process at once, as usual
    drop(listening);
}

/// A run in progress; it ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Running;

impl Running {
    pub(crate) fn start() -> Self {
        STATE.store(RUNNING, Ordering::Relaxed);
        Self
    }

    /// Whether Ctrl-C was pressed.
    pub(crate) fn is_interrupted() -> bool {
        STATE.load(Ordering::Relaxed) == REQUESTED
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        STATE.store(IDLE, Ordering::Relaxed);
    }
}
