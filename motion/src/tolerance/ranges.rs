//! Ranges of cycles, first and last cycle included.

/// Cycles measured at a time.
pub(super) const CHUNK: u64 = 8192;

/// The parts of a time range, in whole cycles, that lie within any of the given ranges of cycles. `passed`: number of
/// those that ended before an earlier time range began.
pub(super) fn within_of<'a>(
    among: &'a [(u64, u64)],
    passed: &mut usize,
    (from, to): (f64, f64),
) -> impl Iterator<Item = (u64, u64)> + use<'a> {
    let (from, to) = (from.floor().max(0.0) as u64, to.ceil() as u64);
    while among.get(*passed).is_some_and(|range| range.1 < from) {
        *passed += 1;
    }
    let inside = among[*passed..].iter().take_while(move |range| range.0 <= to);
    inside.map(move |range| (range.0.max(from), range.1.min(to)))
}

/// Splits a range of cycles, so that long stretches need little memory.
pub(super) fn chunks(from: u64, to: u64) -> impl Iterator<Item = (u64, u64)> {
    let starts = std::iter::successors(Some(from), |from| Some(from + CHUNK + 1));
    starts.take_while(move |from| *from <= to).map(move |from| (from, to.min(from + CHUNK)))
}

/// Ranges of cycles in order; those less than `reach` apart are merged.
pub(super) fn joined(mut ranges: Vec<(u64, u64)>, reach: u64) -> Vec<(u64, u64)> {
    ranges.sort_unstable();
    let mut out: Vec<(u64, u64)> = Vec::new();
    for (from, to) in ranges {
        match out.last_mut().filter(|last| from <= last.1.saturating_add(reach)) {
            Some(last) => last.1 = last.1.max(to),
            None => out.push((from, to)),
        }
    }
    out
}
