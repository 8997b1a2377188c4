//! The clock of outputs and interrupts: rows that wait too long could be lost, and signals at once are one.

use std::time::Instant;

#[expect(
    clippy::disallowed_methods,
    reason = "when something is written, and how a run ends; no value depends on it"
)]
pub(crate) fn now() -> Instant {
    Instant::now()
}
