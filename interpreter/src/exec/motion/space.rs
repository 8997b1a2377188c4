//! Arcs in space by three points: G303.
//!
//! Source: TF5200 programming manual, arc in space. Assumption: a coordinate of the point in between that is not written
//! is that of the start.

use crate::diag::Condition;
use crate::exec::block::choice::Compensation;
use crate::exec::block::collected::Words;
use crate::exec::block::modal::Modal;
use crate::exec::contour::{Contour, local_ends};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::motion::state::MotionState;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::path::{ArcPath, ArcShape, Path, Tilt, TiltedArc};
use std::f64::consts::TAU;

type Vector = [f64; 3];

/// Sine of the angle between two chords below which the points count as collinear.
const STRAIGHT: f64 = 1e-9;

fn sub(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// Centre, axes of the plane and normal, and angle of the arc from `a` over `m` to `e`; `None` if there is none.
fn through(a: Vector, m: Vector, e: Vector) -> Option<(Vector, [Vector; 3], f64)> {
    let (u, v) = (sub(m, a), sub(e, a));
    let w = cross(u, v);
    let (uu, vv, ww) = (dot(u, u), dot(v, v), dot(w, w));
    if uu <= 0.0 || vv <= 0.0 || ww <= STRAIGHT * STRAIGHT * uu * vv {
        return None;
    }
    // the circle through 0, u and v
    let (wu, vw) = (cross(w, u), cross(v, w));
    let centre: Vector = std::array::from_fn(|i| a[i] + (vv * wu[i] + uu * vw[i]) / (2.0 * ww));
    let first = unit(sub(a, centre));
    let normal = unit(w);
    let second = cross(normal, first);
    let end = sub(e, centre);
    let sweep = libm::atan2(dot(end, second), dot(end, first));
    let sweep = if sweep > 0.0 { sweep } else { sweep + TAU };
    Some((centre, [first, second, normal], sweep))
}

impl Contour {
    /// G303 needs a path without tool radius compensation.
    pub(super) fn permits_arc_in_space(&self, modal: &Modal, span: Span) -> Outcome<()> {
        if modal.compensation != Compensation::Off {
            let text = "an arc in space while tool radius compensation is active";
            return Err(Fault::new(Condition::SpaceArcWithCompensation, text, span));
        }
        if self.compensates() {
            let text =
                "an arc in space after G40: a straight motion must lead away from the contour";
            return Err(Fault::new(Condition::SpaceArcAfterCompensation, text, span));
        }
        Ok(())
    }
}

impl Geometry {
    /// G303: from `from` (programmed: `before`) over I J K to the target.
    pub(super) fn arc_in_space(
        &self,
        (from, before): (AxisVec, Vector),
        words: &Words<'_>,
        modal: &Modal,
        motion: &MotionState,
        span: Span,
    ) -> Outcome<Path> {
        let coordinates = &self.coordinates;
        let main = std::array::from_fn::<_, 3, _>(|m| coordinates.main_axis(m));
        let [Some(x), Some(y), Some(z)] = main else {
            let text = "G303 needs three main axes in the channel";
            return Err(Fault::new(Condition::AxisOrCommandExpected, text, span));
        };
        if self
            .image_of_plane(modal.plane.main_axes(), &motion.independent.way, span)?
            .tilt
            .is_some()
        {
            return Err(Fault::unsupported("G303 in a rotated coordinate system", span));
        }
        let axes = [x, y, z];
        let via = std::array::from_fn(|m| match words.centre[m] {
            Some((value, _)) if modal.absolute => value * modal.unit_mm(),
            Some((value, _)) => before[m] + value * modal.unit_mm(),
            None => before[m],
        });
        let via = coordinates.to_machine(via);
        let via = std::array::from_fn(|m| via[m] - motion.independent.way[axes[m]]);
        let from = motion.independent.on_path(from);
        let target = motion.independent.on_path(self.coordinates.target().clone());
        let point = |p: &AxisVec| axes.map(|axis| p[axis]);
        let Some((centre, plane, sweep_rad)) = through(point(&from), via, point(&target)) else {
            let text =
                "start, interim point (I, J, K) and target of G303 are collinear or coincide";
            return Err(Fault::new(Condition::ArcPoints, text, span));
        };
        let m = std::array::from_fn(|i| [plane[0][i], plane[1][i], plane[2][i]]);
        let tilt = Tilt { axes, m, t_mm: centre };
        let (start, end) = local_ends(&tilt, &from, &target);
        let shape = ArcShape { plane: [x, y], centre_mm: [0.0; 2], sweep_rad };
        let arc = ArcPath::new(start, end, shape, motion.limits.feed_axes()).ok_or_else(|| {
            Fault::new(Condition::ArcRadiusZero, "the radius of the arc is 0", span)
        })?;
        Ok(Path::Tilted(Box::new(TiltedArc::new(arc, tilt, from, target))))
    }
}

#[cfg(test)]
mod tests {
    use super::{dot, sub, through};

    /// The points of the page: the centre is equidistant from all three, and in their plane.
    #[test]
    fn the_circle_of_three_points() {
        let (a, m, e) = ([0.0, 0.0, 30.0], [30.0, 75.0, 15.0], [60.0, 0.0, 0.0]);
        let (centre, [first, second, normal], sweep) = through(a, m, e).unwrap();
        let radius = |p| dot(sub(p, centre), sub(p, centre)).sqrt();
        assert!((radius(a) - radius(m)).abs() < 1e-12 && (radius(a) - radius(e)).abs() < 1e-12);
        assert!(dot(normal, sub(a, centre)).abs() < 1e-12);
        for (angle, want) in [(0.0, a), (sweep, e)] {
            for i in 0..3 {
                let (s, c) = libm::sincos(angle);
                let at = centre[i] + radius(a) * (c * first[i] + s * second[i]);
                assert!((at - want[i]).abs() < 1e-12);
            }
        }
        assert!(through(a, [30.0, 0.0, 15.0], e).is_none());
        assert!(through(a, a, e).is_none());
    }
}
