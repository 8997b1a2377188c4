//! Time budget of the fuzz targets.
//!
//! It counts processor time over all threads: the load of the computer makes no difference.

use cpu_time::ProcessTime;
use std::time::Duration;

/// Time allowed for any input.
const BASE: Duration = Duration::from_secs(4);
/// Additional time per byte of it; instrumented code is ten times slower than usual.
const PER_BYTE: Duration = Duration::from_micros(500);

/// Calls a target and panics if it takes longer than its input allows.
pub fn within_budget(data: &[u8], target: impl FnOnce(&[u8])) {
    let start = ProcessTime::now();
    target(data);
    let (taken, length) = (start.elapsed(), u32::try_from(data.len()).unwrap_or(u32::MAX));
    assert!(taken < BASE + PER_BYTE * length, "{length} bytes took {taken:?}");
}
