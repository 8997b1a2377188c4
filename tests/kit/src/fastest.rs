//! Time-optimal motion along a path, without a jerk limit.

/// Fastest time in s along a path without a jerk limit, by a backward and a forward pass: `limit` holds the squares of the
/// speeds allowed at the points of a grid (mm2/s2) and is lowered to those reached, `acc` in mm/s2 and `step` in mm belong
/// to the intervals between them.
pub fn second_order_time(limit: &mut [f64], acc: &[f64], step: &[f64]) -> f64 {
    let n = acc.len();
    for k in (0..n).rev() {
        limit[k] = limit[k].min(limit[k + 1] + 2.0 * acc[k] * step[k]);
    }
    for k in 0..n {
        limit[k + 1] = limit[k + 1].min(limit[k] + 2.0 * acc[k] * step[k]);
    }
    (0..n).map(|k| 2.0 * step[k] / (limit[k].sqrt() + limit[k + 1].sqrt())).sum()
}
