//! A 90 degree corner at constant speed through two equal filters: how far the path leaves the contour.

use kontur_filters::stage::Stage;
use kontur_kit::from_polyline;

/// Largest distance from the contour and smallest distance from the corner, both of the path drawn as a polyline
/// (between two samples the path may be further off than at both of them), in the unit of the speed times cycles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) contour_error: f64,
    pub(crate) corner_distance: f64,
}

/// The filtered points while the axes pass the corner (0, 0), reached by x at time 0 and left by y.
pub(crate) fn path<S: Stage + Clone>(stage: &S, per_cycle: f64, cycles: u32) -> Vec<(f64, f64)> {
    let start = -f64::from(cycles) * per_cycle;
    let (mut x_axis, mut y_axis) = (stage.clone(), stage.clone());
    x_axis.settle(start);
    y_axis.settle(0.0);
    (0..=2 * cycles)
        .map(|n| {
            let s = (f64::from(n) - f64::from(cycles)) * per_cycle;
            (x_axis.step(s.min(0.0)), y_axis.step(s.max(0.0)))
        })
        .collect()
}

/// Runs the corner with `per_cycle` mm per cycle, `cycles` before and after it.
pub(crate) fn corner<S: Stage + Clone>(stage: &S, per_cycle: f64, cycles: u32) -> Corner {
    let points = path(stage, per_cycle, cycles);
    let mut worst = Corner { contour_error: 0.0, corner_distance: f64::INFINITY };
    for pair in points.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let at = |t: f64| (from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1));
        // The distance to the nearer leg has its maximum at an end or where both legs are equally far.
        let crossings = [1.0, -1.0].map(|sign| {
            let (before, after) = (from.0 + sign * from.1, to.0 + sign * to.1);
            (before / (before - after)).clamp(0.0, 1.0)
        });
        for t in [0.0, 1.0].into_iter().chain(crossings.into_iter().filter(|t| t.is_finite())) {
            worst.contour_error = worst.contour_error.max(distance(at(t)));
        }
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let foot = -(from.0 * dx + from.1 * dy) / (dx * dx + dy * dy);
        if foot.is_finite() {
            let nearest = at(foot.clamp(0.0, 1.0));
            worst.corner_distance = worst.corner_distance.min(libm::hypot(nearest.0, nearest.1));
        }
    }
    worst
}

/// Distance from the contour: x up to 0 on y = 0, then y from 0 on x = 0.
fn distance((x, y): (f64, f64)) -> f64 {
    let corner = libm::hypot(x, y);
    let first = if x <= 0.0 { y.abs() } else { corner };
    let second = if y >= 0.0 { x.abs() } else { corner };
    first.min(second)
}

/// Largest distance between the path through the corner and the path of the reversed program through it.
pub(crate) fn forward_backward_gap<S: Stage + Clone>(
    stage: &S,
    per_cycle: f64,
    cycles: u32,
) -> f64 {
    let forward = path(stage, per_cycle, cycles);
    // Mirrored at the diagonal the reversed program is the program: x and -y change places.
    let backward: Vec<_> = forward.iter().map(|&(x, y)| [-y, -x]).collect();
    let to_path = |(x, y): (f64, f64)| {
        let off = from_polyline(&[x, y], &backward);
        libm::hypot(off[0], off[1])
    };
    // Away from the ends, where the other path may not reach.
    let near =
        forward.iter().filter(|(x, y)| x.abs().max(y.abs()) < 0.4 * per_cycle * f64::from(cycles));
    near.map(|&point| to_path(point)).fold(0.0, f64::max)
}
