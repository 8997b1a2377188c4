//! The clock of the trace: rows that wait too long could be lost.

use std::time::Instant;

#[expect(
    clippy::disallowed_methods,
    reason = "what waits too long could be lost; no value depends on it"
)]
pub(super) fn now() -> Instant {
    Instant::now()
}
