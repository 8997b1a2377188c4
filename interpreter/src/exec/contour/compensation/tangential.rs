//! Tangential selection (G05): arcs of approach and departure.
//!
//! The arc starts or ends where direct selection (G138) would, on the parallel, and touches it there. Its centre is the
//! intersection of the perpendicular bisector of its ends with the line through the end of the contour and the point of the
//! parallel.
//!
//! Source: manual of the kernel, tangential selection and deselection of the tool radius compensation (207837451).

use super::ends::{ends, line};
use super::failure::Fallible;
use crate::diag::Condition;
use crate::exec::contour::motion::Motion;
use crate::exec::fault::Fault;
use crate::exec::geometry::point::{Point, cross, dot, norm, sub};
use kontur_motion::path::{ArcPath, ArcShape, Path};

/// Sine of the angle between chord and tangent below which the arc is a line.
const STRAIGHT: f64 = 1e-9;

/// End of the arc that touches the parallel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Touch {
    /// Departure from the contour.
    Start,
    /// Approach to the contour.
    End,
}

/// The path of a motion between two points, with the direction of the contour at one of them; `None` between equal points.
pub(super) fn way(
    motion: &Motion,
    plane: [usize; 2],
    (from, to): (Point, Point),
    tangent: Point,
    touch: Touch,
) -> Fallible<Option<Path>> {
    let chord = sub(to, from);
    let length = norm(chord);
    if length == 0.0 {
        return Ok(line(motion, plane, from, to));
    }
    if cross(tangent, chord).abs() <= STRAIGHT * length {
        if dot(tangent, chord) > 0.0 {
            return Ok(line(motion, plane, from, to));
        }
        let text = "G05: an arc from a point straight ahead back to the contour does not exist";
        return Err(Fault::new(Condition::Compensation, text, motion.span)
            .hint("start and end at a distance from the contour")
            .in_block(motion.source));
    }
    let (centre_mm, sweep_rad) = match touch {
        Touch::Start => arc(from, tangent, to),
        // the same arc in the opposite direction
        Touch::End => {
            let (centre, sweep) = arc(to, [-tangent[0], -tangent[1]], from);
            (centre, -sweep)
        }
    };
    let shape = ArcShape { plane, centre_mm, sweep_rad };
    let (from, to) = ends(motion, plane, from, to);
    Ok(ArcPath::new(from, to, shape, &motion.block.dynamics.feed_axes).map(Path::Arc))
}

/// Centre and swept angle of the arc with this start direction and this end point beside it.
fn arc(from: Point, direction: Point, to: Point) -> (Point, f64) {
    let chord = sub(to, from);
    let left = [-direction[1], direction[0]];
    let radius = dot(chord, chord) / (2.0 * dot(chord, left));
    let centre = [from[0] + radius * left[0], from[1] + radius * left[1]];
    // twice the angle between tangent and chord
    let sweep = 2.0 * libm::atan2(cross(direction, chord), dot(direction, chord));
    (centre, sweep)
}
