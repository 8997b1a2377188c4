//! Arithmetic of arcs in a plane: from programmed values to centre and swept angle.
//!
//! Source: TF5200 programming manual, circular interpolation, G161 to G165; P-CHAN-00059, 00060, 00171, 00172.

use super::point::{Point, cross, dot, norm, sub};
use crate::machine::ArcCentre;
use std::f64::consts::TAU;

/// Points closer than this count as equal: half the smallest increment of the language, 0.0001 mm.
const SAME_MM: f64 = 5e-5;

/// Distance by which half a chord may exceed a radius that was rounded to the smallest increment.
const RADIUS_ROUNDING_MM: f64 = 1e-4;

/// Centre and swept angle of an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Arc {
    pub(in crate::exec) centre: Point,
    /// Positive counter-clockwise, in rad; a full turn for a full circle.
    pub(in crate::exec) sweep_rad: f64,
    /// Distance by which G165 shifted the centre, in mm.
    pub(in crate::exec) shift: Point,
}

/// Reason why the arc does not exist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) enum ArcError {
    /// 20036.
    RadiusZero,
    /// 20034.
    FullCircleWithRadius,
    /// K-RADIUS-TOO-SMALL.
    RadiusTooSmall { radius: f64, half_chord: f64 },
    /// G165: the centre is too far from the perpendicular bisector of the chord.
    CentreTooFar { shift: f64, limit: f64 },
    /// 21758 (G164).
    RadiiDiffer { start: f64, end: f64, limit: f64 },
}

/// Angle from `from` to `to` in the sense of rotation, magnitude in (0, 2 pi], signed.
fn sweep(from: Point, to: Point, counter_clockwise: bool) -> f64 {
    let angle = libm::atan2(cross(from, to), dot(from, to));
    if counter_clockwise {
        if angle > 0.0 { angle } else { angle + TAU }
    } else if angle < 0.0 {
        angle
    } else {
        angle - TAU
    }
}

/// An arc by its radius: the shorter arc for a positive radius, the longer one for a negative radius.
pub(in crate::exec) fn by_radius(
    start: Point,
    end: Point,
    radius: f64,
    counter_clockwise: bool,
) -> Result<Arc, ArcError> {
    let chord = sub(end, start);
    let length = norm(chord);
    if length < SAME_MM {
        return Err(ArcError::FullCircleWithRadius);
    }
    if radius == 0.0 {
        return Err(ArcError::RadiusZero);
    }
    let half_chord = 0.5 * length;
    if half_chord - radius.abs() > RADIUS_ROUNDING_MM {
        return Err(ArcError::RadiusTooSmall { radius, half_chord });
    }
    // rounding errors of a half circle, for instance a rotated one, would shift its centre by their square root
    let above = (radius.abs() - half_chord).max(0.0);
    let above = if above < 1e-14 * radius.abs() { 0.0 } else { above };
    // (R - d/2) (R + d/2) instead of R^2 - d^2/4: no cancellation near the half circle
    let height = (above * (radius.abs() + half_chord)).sqrt();
    let side = if counter_clockwise == (radius > 0.0) { height } else { -height };
    let left = [-chord[1] / length, chord[0] / length];
    let centre =
        [0.5 * (start[0] + end[0]) + side * left[0], 0.5 * (start[1] + end[1]) + side * left[1]];
    let sweep_rad = sweep(sub(start, centre), sub(end, centre), counter_clockwise);
    Ok(Arc { centre, sweep_rad, shift: [0.0; 2] })
}

/// An arc by its centre. With `correct` (G165) the centre is shifted to the perpendicular bisector of the chord.
pub(in crate::exec) fn by_centre(
    start: Point,
    end: Point,
    centre: Point,
    counter_clockwise: bool,
    correct: bool,
    limits: &ArcCentre,
) -> Result<Arc, ArcError> {
    let chord = sub(end, start);
    let length = norm(chord);
    if length < SAME_MM {
        if norm(sub(start, centre)) < SAME_MM {
            return Err(ArcError::RadiusZero);
        }
        let sweep_rad = if counter_clockwise { TAU } else { -TAU };
        return Ok(Arc { centre, sweep_rad, shift: [0.0; 2] });
    }
    let (centre, shift) = if correct {
        corrected(start, chord, length, centre, limits)?
    } else {
        radii_agree(start, end, centre, limits)?;
        (centre, [0.0; 2])
    };
    let sweep_rad = sweep(sub(start, centre), sub(end, centre), counter_clockwise);
    Ok(Arc { centre, sweep_rad, shift })
}

/// G165: centre on the perpendicular bisector and its shift.
fn corrected(
    start: Point,
    chord: Point,
    length: f64,
    centre: Point,
    limits: &ArcCentre,
) -> Result<(Point, Point), ArcError> {
    let along = [chord[0] / length, chord[1] / length];
    let middle = [start[0] + 0.5 * chord[0], start[1] + 0.5 * chord[1]];
    let off = sub(centre, middle);
    let distance = off[0] * along[0] + off[1] * along[1];
    let shift = [-distance * along[0], -distance * along[1]];
    let centre = [centre[0] + shift[0], centre[1] + shift[1]];
    let radius = norm(sub(start, centre));
    // both limits must be exceeded: the larger one is decisive
    let limit = limits.shift_mm.max(limits.shift_ratio * radius);
    if distance.abs() > limit {
        return Err(ArcError::CentreTooFar { shift: distance.abs(), limit });
    }
    Ok((centre, shift))
}

/// G164: the radii at start and end must agree within the limits.
pub(in crate::exec) fn radii_agree(
    start: Point,
    end: Point,
    centre: Point,
    limits: &ArcCentre,
) -> Result<(), ArcError> {
    let (from, to) = (norm(sub(start, centre)), norm(sub(end, centre)));
    if from < SAME_MM || to < SAME_MM {
        return Err(ArcError::RadiusZero);
    }
    let limit = limits.radius_difference_mm.max(limits.radius_difference_ratio * from);
    if (from - to).abs() > limit {
        return Err(ArcError::RadiiDiffer { start: from, end: to, limit });
    }
    Ok(())
}

/// Swept angle of a helix with a pitch: full turns are added for the best match of the pitch.
pub(in crate::exec) fn with_turns(sweep_rad: f64, height: f64, pitch: f64) -> f64 {
    let turns = (height / pitch).abs() - sweep_rad.abs() / TAU;
    sweep_rad + TAU.copysign(sweep_rad) * turns.round().max(0.0)
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "exact values are the point")]
mod tests {
    use super::{Arc, ArcError, by_centre, by_radius, with_turns};
    use crate::machine::ArcCentre;
    use std::f64::consts::{FRAC_PI_3, PI, TAU};

    const LIMITS: ArcCentre = ArcCentre {
        shift_mm: 2.0,
        shift_ratio: 0.05,
        radius_difference_mm: 0.005,
        radius_difference_ratio: 0.001,
    };

    fn assert_arc(arc: Result<Arc, ArcError>, centre: [f64; 2], sweep_rad: f64) {
        let arc = arc.unwrap();
        assert!((arc.centre[0] - centre[0]).abs() < 1e-6, "{arc:?}");
        assert!((arc.centre[1] - centre[1]).abs() < 1e-6, "{arc:?}");
        assert!((arc.sweep_rad - sweep_rad).abs() < 1e-9, "{arc:?}");
    }

    #[test]
    fn radius_form() {
        let h = 8.660254;
        let arc = |r, ccw| by_radius([0.0, 0.0], [10.0, 0.0], r, ccw);
        assert_arc(arc(10.0, false), [5.0, -h], -FRAC_PI_3);
        assert_arc(arc(-10.0, false), [5.0, h], -5.0 * FRAC_PI_3);
        assert_arc(arc(10.0, true), [5.0, h], FRAC_PI_3);
        assert_arc(arc(-10.0, true), [5.0, -h], 5.0 * FRAC_PI_3);
        // a radius rounded down to the increment gives a half circle
        assert_arc(arc(4.99995, true), [5.0, 0.0], PI);
        assert_eq!(arc(4.0, true), Err(ArcError::RadiusTooSmall { radius: 4.0, half_chord: 5.0 }));
        let full = by_radius([1.0, 1.0], [1.0, 1.0], 10.0, true);
        assert_eq!(full, Err(ArcError::FullCircleWithRadius));
    }

    #[test]
    fn the_arc_of_the_rounded_square() {
        let arc = by_radius([20.0, 0.0], [0.0, 0.0], 15.0, false).unwrap();
        assert!((arc.centre[0] - 10.0).abs() < 1e-9 && (arc.centre[1] - 11.180340).abs() < 1e-6);
        assert!((arc.sweep_rad.to_degrees() + 83.620630).abs() < 1e-6);
        assert!((arc.sweep_rad.abs() * 15.0 - 21.891830).abs() < 1e-6);
    }

    #[test]
    fn centre_form_with_correction() {
        let arc = |c| by_centre([0.0, 0.0], [10.0, 0.0], c, false, true, &LIMITS);
        // the centre lies above the chord, the arc passes over it: more than half a turn
        assert_arc(arc([5.0, 0.2]), [5.0, 0.2], -(PI + 2.0 * libm::atan(0.2 / 5.0)));
        assert_eq!(arc([5.0, 0.2]).unwrap().shift, [0.0, 0.0]);
        let shifted = arc([5.1, 0.0]);
        assert_arc(shifted, [5.0, 0.0], -PI);
        assert!((shifted.unwrap().shift[0] + 0.1).abs() < 1e-12);
        // 2.5 mm is beyond 2 mm and beyond 5 % of the radius
        let far = arc([7.5, 0.0]).unwrap_err();
        assert!(
            matches!(far, ArcError::CentreTooFar { shift, limit } if (shift - 2.5).abs() < 1e-12 && (limit - 2.0).abs() < 1e-12)
        );
    }

    #[test]
    fn full_circles_have_no_correction() {
        let ccw = by_centre([3.0, 4.0], [3.0, 4.0], [0.0, 0.0], true, true, &LIMITS);
        assert_arc(ccw, [0.0, 0.0], TAU);
        let nothing = by_centre([3.0, 4.0], [3.0, 4.0], [3.0, 4.0], true, true, &LIMITS);
        assert_eq!(nothing, Err(ArcError::RadiusZero));
    }

    #[test]
    fn without_correction_the_radii_must_agree() {
        let arc = |c| by_centre([0.0, 0.0], [10.0, 0.0], c, true, false, &LIMITS);
        assert_arc(arc([5.002, 0.0]), [5.002, 0.0], PI);
        assert!(matches!(arc([5.1, 0.0]), Err(ArcError::RadiiDiffer { .. })));
        assert_eq!(arc([0.0, 0.0]), Err(ArcError::RadiusZero));
    }

    #[test]
    fn a_pitch_adds_whole_turns() {
        assert!((with_turns(TAU, 10.0, 2.0) - 5.0 * TAU).abs() < 1e-12);
        assert!((with_turns(-PI, 5.0, 2.0) + PI + 2.0 * TAU).abs() < 1e-12);
        assert!((with_turns(PI, 0.5, 2.0) - PI).abs() < 1e-12);
    }
}
