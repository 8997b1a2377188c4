//! The active plane of a motion: its axes, its orientation in space, and its tool radius compensation.

use crate::diag::Condition;
use crate::exec::block::choice::{Compensation, Corners};
use crate::exec::block::modal::Modal;
use crate::exec::contour::Compensated;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::motion::state::MotionState;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::path::Tilt;

/// The active plane as a motion needs it.
pub(super) struct InPlane {
    /// Its axes.
    pub(super) plane: [usize; 2],
    /// The coordinate system, if it is oblique to the axes.
    pub(super) tilt: Option<Box<Tilt>>,
    pub(super) compensation: Option<Compensated>,
}

/// The active plane in the frame.
#[derive(Debug)]
pub(super) struct PlaneImage {
    /// Indices of its main axes; with a tilt, those of the coordinate system.
    pub(super) main: [usize; 2],
    pub(super) keeps_sense: bool,
    /// The frame, if the plane is oblique to the axes.
    pub(super) tilt: Option<Box<Tilt>>,
}

impl Geometry {
    /// Orientation of the plane of these main axes in the frame; `way`: independent travel of the axes.
    pub(super) fn image_of_plane(
        &self,
        [a, b, _]: [usize; 3],
        way: &AxisVec,
        span: Span,
    ) -> Outcome<PlaneImage> {
        let frame = self.coordinates.frame();
        if let Some((main, keeps_sense)) = frame.image_of_plane(a, b) {
            return Ok(PlaneImage { main, keeps_sense, tilt: None });
        }
        let axis = |m: usize| self.coordinates.main_axis(m);
        let (Some(x), Some(y), Some(z)) = (axis(0), axis(1), axis(2)) else {
            let text = "a coordinate system rotated in space requires three main axes";
            return Err(Fault::new(Condition::AxisOrCommandExpected, text, span));
        };
        let (axes, origin) = ([x, y, z], self.coordinates.to_machine([0.0; 3]));
        let t_mm = std::array::from_fn(|i| origin[i] - way[axes[i]]);
        let tilt = Some(Box::new(Tilt { axes, m: frame.m, t_mm }));
        Ok(PlaneImage { main: [a, b], keeps_sense: true, tilt })
    }

    /// Axes of the active plane, its coordinate system if it is oblique to the axes, and the compensation.
    pub(super) fn in_plane(
        &self,
        modal: &Modal,
        motion: &MotionState,
        span: Span,
    ) -> Outcome<InPlane> {
        let axis = |m: usize| self.coordinates.main_axis(m);
        let compensated =
            modal.compensation != Compensation::Off && !modal.commanded.compensation_suppressed;
        let PlaneImage { main, keeps_sense, tilt } =
            self.image_of_plane(modal.plane.main_axes(), &motion.independent.way, span)?;
        if compensated && tilt.is_some() && motion.wear.on && motion.wear.radius {
            let what = "#OTC [RADIUS] in a plane askew to the axes";
            return Err(Fault::unsupported(what, span));
        }
        let (Some(first), Some(second)) = (axis(main[0]), axis(main[1])) else {
            if compensated {
                let text = "the plane of the tool radius compensation has no axis in the channel";
                return Err(Fault::new(Condition::AxisOrCommandExpected, text, span));
            }
            return Ok(InPlane { plane: [0, 0], tilt, compensation: None });
        };
        let left = (modal.compensation == Compensation::Left) == keeps_sense;
        let radius = self.tools.active.radius_mm;
        let compensation = compensated.then_some(Compensated {
            distance_mm: if left { radius } else { -radius },
            straight_corners: (modal.corners == Corners::Straight)
                .then_some(modal.commanded.corner_stretch),
            reverse: modal.commanded.turns_back,
            perpendicular_change: modal.commanded.perpendicular_change,
            selection: modal.selection,
            engagement_radius_mm: modal
                .engagement_feed
                .then_some(modal.commanded.engagement_radius_mm),
        });
        Ok(InPlane { plane: [first, second], tilt, compensation })
    }
}
