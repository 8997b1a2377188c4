//! Limits that differ by rounding are made equal, so that rounding decides nothing: whether blocks are treated as one,
//! whether a speed is cut at a boundary, whether an acceleration may continue beyond it.
//!
//! The limits of a block follow from its direction, and those of a short block vary with the last digits of its
//! coordinates. The two halves of a rounded corner, the parts of a line or arc and the lines on both sides of a small
//! curve have equal limits only up to that.

use super::{ALIKE, Block};

/// Makes limits of neighbouring blocks equal that differ by rounding. `ends`: the speeds at both ends, which stay within
/// the limits.
pub(super) fn level(blocks: &mut [Block], ends: Option<(f64, f64)>) {
    let mut values = Vec::with_capacity(2 * blocks.len());
    let mut each = |limit: fn(&mut Block) -> &mut f64| {
        values.clear();
        values.extend(blocks.iter_mut().map(|block| *limit(block)));
        level_values(&mut values, None);
        blocks.iter_mut().zip(&values).for_each(|(block, value)| *limit(block) = *value);
    };
    each(|block| &mut block.acc);
    each(|block| &mut block.dec);
    each(|block| &mut block.jerks[0]);
    each(|block| &mut block.jerks[1]);
    each(|block| &mut block.jerks[2]);
    each(|block| &mut block.jerks[3]);
    values.clear();
    values.extend(blocks.iter().flat_map(|block| [block.v, block.cap]));
    level_values(&mut values, ends);
    for (block, pair) in blocks.iter_mut().zip(values.chunks_exact(2)) {
        (block.v, block.cap) = (pair[0], pair[1]);
    }
}

/// Gives the smallest value to each run of values that differ from its first one by rounding only, but no smaller one
/// than the value at an end that differs from the run by rounding too.
fn level_values(values: &mut [f64], ends: Option<(f64, f64)>) {
    let count = values.len();
    let mut from = 0;
    while let Some(first) = values.get(from).copied() {
        // most values have nothing alike beside them
        let inside = ends.is_none() || from > 0 && from + 2 < count;
        if inside && values.get(from + 1).is_none_or(|next| !is_alike(first, *next)) {
            from += 1;
            continue;
        }
        let length = values[from..].iter().take_while(|v| is_alike(first, **v)).count().max(1);
        let run = &mut values[from..from + length];
        let mut least = run.iter().copied().fold(f64::INFINITY, f64::min);
        // the last value is that of the end of the stretch, which has no limit of its own
        let is_last = from + length + 1 >= count;
        for (is_here, v) in
            ends.map_or([(false, 0.0); 2], |(v0, v1)| [(from == 0, v0), (is_last, v1)])
        {
            if is_here && is_alike(least, v) {
                least = least.max(v);
            }
        }
        run.fill(least);
        from += length;
    }
}

fn is_alike(a: f64, b: f64) -> bool {
    (a - b).abs() <= ALIKE * a.min(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_kit::Random;

    /// Random limits, some of which are repeated with a relative noise of 1e-9: afterwards neighbours are equal or clearly
    /// different, none is higher than before or lower than by rounding, and a second pass changes nothing.
    #[test]
    fn neighbouring_limits_are_equal_or_clearly_different() {
        let mut r = Random::from_state(3);
        for _ in 0..200 {
            let mut last = 1.0;
            let noisy: Vec<f64> = (0..50)
                .map(|_| {
                    last = if r.chance(0.5) { r.log(1.0, 100.0) } else { last };
                    last * (1.0 + 1e-9 * r.between(-1.0, 1.0))
                })
                .collect();
            let mut values = noisy.clone();
            level_values(&mut values, None);
            for (now, before) in values.iter().zip(&noisy) {
                assert!(*now <= *before && *now >= before * (1.0 - 2.0 * ALIKE));
            }
            for pair in values.windows(2) {
                let differs = (pair[0] - pair[1]).abs() / pair[0];
                assert!(differs == 0.0 || differs > 0.5 * ALIKE, "{pair:?}");
            }
            let once = values.clone();
            level_values(&mut values, None);
            assert!(values == once);
        }
    }

    /// The speed at an end is the limit of the blocks there if it differs by rounding only, and has no effect otherwise.
    #[test]
    fn the_speeds_at_the_ends_stay_within_the_limits() {
        for (v0, v1, least) in [(5.0, 5.0, 5.0), (4.0, 3.0, 5.0 * (1.0 - 1e-9))] {
            let mut values = [5.0, 5.0 * (1.0 - 1e-9), 5.0, f64::INFINITY];
            level_values(&mut values, Some((v0, v1)));
            assert!(values[..3].iter().all(|v| v.to_bits() == f64::to_bits(least)), "{values:?}");
            assert!(values[3].is_infinite());
        }
    }
}
