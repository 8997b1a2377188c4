//! Long work that Ctrl-C can stop.

use kontur_interpreter::job::Stop;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// A signal is handled within this time.
const PATIENCE: Duration = Duration::from_millis(50);

/// Stack size of the working thread, that of a main thread.
const STACK_BYTES: usize = 8 << 20;

/// Works in another thread, without the interpreter lock, while this one waits for signals: Ctrl-C stops the work and is
/// raised when it has ended.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    stop: &Stop,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let done = AtomicBool::new(false);
    let waiting = thread::current();
    thread::scope(|scope| {
        let work = || {
            let worked = work();
            done.store(true, Ordering::Release);
            waiting.unpark();
            worked
        };
        let builder = thread::Builder::new().stack_size(STACK_BYTES);
        let worker = builder
            .spawn_scoped(scope, work)
            .map_err(|e| PyRuntimeError::new_err(e.to_string()))?;
        let mut raised = None;
        // a panic ends the worker without a message
        while !done.load(Ordering::Acquire) && !worker.is_finished() {
            py.detach(|| thread::park_timeout(PATIENCE));
            if let Err(signal) = py.check_signals() {
                stop.set();
                raised = Some(signal);
            }
        }
        let worked = py.detach(|| worker.join()).unwrap_or_else(|panic| resume_unwind(panic));
        raised.map_or(Ok(worked), Err)
    })
}
