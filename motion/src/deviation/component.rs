//! The vector from a point to a line with the smallest largest component.
//!
//! The shortest vector to a set path jumps where two of its lines are equally near, and its largest component jumps
//! with it: which line counts then depends on the last cycle of the path. The minimum of the largest component does not
//! jump.

use crate::axis::AxisVec;

/// Sets `vector` to the one from `point` to a line whose largest component is smallest; returns that component.
///
/// Along the line the largest component is convex and piecewise linear. A falling and a rising piece enclose the
/// minimum; where they meet another piece may be larger still, and replaces one of them until none is.
pub(super) fn least(point: &[f64], line: (&[f64], &[f64]), vector: &mut AxisVec) -> f64 {
    let at = |u: f64| Piece::largest(point, line, u);
    let (mut falling, mut rising) = (at(0.0).1, at(1.0).0);
    let mut u = if falling.slope < 0.0 { 1.0 } else { 0.0 };
    // every component has two pieces, and each of them is used at most once
    for _ in 0..2 * point.len() {
        if falling.slope >= 0.0 || rising.slope <= 0.0 {
            break;
        }
        u = falling.meets(&rising);
        let (left, right) = at(u);
        if left.slope <= 0.0 && right.slope >= 0.0 {
            break;
        } else if right.slope < 0.0 {
            falling = right;
        } else {
            rising = left;
        }
    }
    for (i, v) in vector.iter_mut().enumerate() {
        *v = line.0[i] + u * (line.1[i] - line.0[i]) - point[i];
    }
    vector.iter().fold(0.0, |m, c| m.max(c.abs()))
}

/// A linear piece of the largest component: its value at a position on the line and its slope.
#[derive(Clone, Copy)]
struct Piece {
    u: f64,
    value: f64,
    slope: f64,
}

impl Piece {
    /// The largest component at a position: its pieces to the left and to the right.
    fn largest(point: &[f64], line: (&[f64], &[f64]), u: f64) -> (Self, Self) {
        let pieces = (0..point.len()).map(|i| {
            let way = line.1[i] - line.0[i];
            let value = line.0[i] + u * way - point[i];
            let sign = if value == 0.0 { way.signum() } else { value.signum() };
            (value.abs(), sign * way)
        });
        let none = Self { u, value: f64::NEG_INFINITY, slope: 0.0 };
        pieces.fold((none, none), |(mut left, mut right), (value, slope)| {
            let more = |than: &Self| value.total_cmp(&than.value);
            if more(&left).then(left.slope.total_cmp(&slope)).is_gt() {
                left = Self { u, value, slope };
            }
            if more(&right).then(slope.total_cmp(&right.slope)).is_gt() {
                right = Self { u, value, slope };
            }
            (left, right)
        })
    }

    /// Position at which a falling piece meets a rising one.
    fn meets(&self, rising: &Self) -> f64 {
        let along = |piece: &Self| piece.value - piece.slope * piece.u;
        ((along(self) - along(rising)) / (rising.slope - self.slope)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// None of 2,000 points on the line is nearer, and one of them is almost as near.
        #[test]
        fn no_point_of_the_line_is_nearer(
            [point, from, to] in prop::array::uniform3(prop::array::uniform3(-1.0..1.0f64)),
        ) {
            let mut vector = AxisVec::zeros(3);
            let found = least(&point, (&from, &to), &mut vector);
            let of = |i: u32| {
                let u = f64::from(i) / 2000.0;
                let component = |c: usize| (from[c] + u * (to[c] - from[c]) - point[c]).abs();
                (0..3).map(component).fold(0.0, f64::max)
            };
            let many = (0..=2000).map(of).fold(f64::INFINITY, f64::min);
            prop_assert!(found <= many + 1e-12, "{found} {many}");
            prop_assert!(found >= many - 1e-3, "{found} {many}");
        }
    }
}
