//! Work on another thread, which the caller starts: the library itself starts none.

use std::sync::{Arc, Mutex, PoisonError};

/// Work for another thread, see [`Run::to_end_on_threads`](crate::job::Run::to_end_on_threads).
pub type Work = Box<dyn FnOnce() + Send>;

/// Passes a value to work on another thread, if `start` can start one.
///
/// # Errors
/// The value, if it cannot.
pub(crate) fn give<T: Send + 'static>(
    value: T,
    work: impl FnOnce(T) + Send + 'static,
    start: impl FnOnce(Work) -> bool,
) -> Result<(), T> {
    let given = Arc::new(Mutex::new(Some(value)));
    let take =
        |given: &Mutex<Option<T>>| given.lock().unwrap_or_else(PoisonError::into_inner).take();
    let taken = Arc::clone(&given);
    let started = start(Box::new(move || {
        if let Some(value) = take(&taken) {
            work(value);
        }
    }));
    if started { Ok(()) } else { take(&given).map_or(Ok(()), Err) }
}
