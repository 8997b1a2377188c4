//! Distances from polylines, by trying every segment.

/// Shortest vector from a polyline to a point.
///
/// # Panics
/// If the polyline has no point.
pub fn from_polyline<P: AsRef<[f64]>>(point: &[f64], polyline: &[P]) -> Vec<f64> {
    let mut best = (f64::INFINITY, 0, 0.0);
    for (k, ends) in polyline.windows(2).enumerate() {
        let (start, end) = (ends[0].as_ref(), ends[1].as_ref());
        let (mut length2, mut dot, mut square) = (0.0, 0.0, 0.0);
        for ((a, b), p) in start.iter().zip(end).zip(point) {
            length2 += (b - a) * (b - a);
            dot += (b - a) * (p - a);
        }
        let share: f64 = if length2 > 0.0 { dot / length2 } else { 0.0 };
        let share = share.clamp(0.0, 1.0);
        for ((a, b), p) in start.iter().zip(end).zip(point) {
            let off = p - a - share * (b - a);
            square += off * off;
        }
        if square < best.0 {
            best = (square, k, share);
        }
    }
    let (_, k, share) = best;
    let (a, b) = (polyline[k].as_ref(), polyline[(k + 1).min(polyline.len() - 1)].as_ref());
    a.iter().zip(b).zip(point).map(|((a, b), p)| p - a - share * (b - a)).collect()
}

/// Largest component of a vector, or value of a row, without its sign.
pub fn largest(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |most: f64, component| most.max(component.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter square, and a point twice in a row.
    #[test]
    fn the_nearest_segment_counts() {
        let corner = [[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [4.0, 4.0]];
        for (point, want) in [
            ([2.0, 1.0], [0.0, 1.0]),
            ([3.5, 2.0], [-0.5, 0.0]),
            ([-3.0, -4.0], [-3.0, -4.0]),
            ([5.0, 6.0], [1.0, 2.0]),
        ] {
            assert_eq!(from_polyline(&point, &corner), want, "{point:?}");
        }
        assert!((largest(&[1.0, -3.0, 2.0]) - 3.0).abs() <= 0.0);
    }
}
