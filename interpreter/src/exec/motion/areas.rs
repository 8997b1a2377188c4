//! Control areas: their definition, and the monitoring of motions.
//!
//! The blocks between `#CONTROL AREA BEGIN` and `END` describe the contour of an area and cause no motion. A motion carries the
//! areas that are active in its block. It is checked against them when it is complete, including tool radius compensation and
//! chamfers.
//!
//! Assumptions (the documents are silent): the coordinates of a definition include the active offsets except those of the tool,
//! because the tip of the tool is monitored; a violation ends the program before the motion.
//!
//! Source: TF5200 programming manual (207565195, 207571851); workspace monitoring (291148299, 291161867, 291170571); 21295,
//! 21363, 21797, 50786, 120477, 120484, 120691, 120734, 120736, 120740, 120742, 120743.

use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::{Compensation, PathMode};
use crate::exec::block::collected::Words;
use crate::exec::block::groups::Group;
use crate::exec::block::modal::Modal;
use crate::exec::contour::{Guarded, violated};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::geometry::area::{Area, Base, Violation, overlaps};
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::motion::state::MotionState;
use crate::exec::motion::state::areas::{Areas, Draft, Heading};
use crate::exec::names::AxisNames;
use crate::exec::report::Report;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::path::Path;
use std::sync::Arc;

/// Maximum number of blocks of a polygon. Source: TF5200 workspace monitoring 291148299.
const POLYGON_BLOCKS: usize = 20;
/// Distance in mm below which two points count as equal: coordinates of a closed contour are written with four digits.
const SAME_MM: f64 = 1e-4;

/// An error in a definition or selection for which the documents print no ID.
fn wrong(text: impl Into<String>, span: Span) -> Box<Fault> {
    Fault::new(Condition::AreaWrong, text, span)
}

impl Areas {
    /// `#CONTROL AREA OFF`: one area, or the last one for `None`.
    pub(in crate::exec) fn switch_off(&mut self, number: Option<u32>) {
        let active = &mut self.active;
        match number {
            Some(number) => active.retain(|area| area.number != number),
            None => drop(active.pop()),
        }
    }

    /// `#CONTROL AREA OFF ALL`.
    pub(in crate::exec) fn switch_all_off(&mut self) {
        self.active.clear();
    }

    /// `#CONTROL AREA CLEAR`: deletes one area, or all for `None`; those that are active stay, and their numbers are returned.
    pub(in crate::exec) fn clear(&mut self, number: Option<u32>) -> Vec<u32> {
        let chosen = |area: &u32| number.is_none_or(|number| number == *area);
        let active: Vec<u32> =
            self.active.iter().map(|area| area.number).filter(|area| chosen(area)).collect();
        self.defined.retain(|area, _| !chosen(area) || active.contains(area));
        active
    }

    /// Whether a motion can be monitored: contouring and splines change its path later.
    pub(super) fn fit(&self, shaped: bool, names: &AxisNames, span: Span) -> Outcome<()> {
        let mut active = self.active.iter();
        if shaped && active.len() > 0 {
            let what = "contouring, #HSC or a spline while a control area is active";
            return Err(Fault::unsupported(what, span));
        }
        match active.find(|area| area.axes.iter().any(|axis| !names.has(*axis))) {
            Some(area) => {
                let text = format!("an axis of control area {} has left the channel", area.number);
                Err(Fault::new(Condition::AreaAxisMissing, text, span))
            }
            None => Ok(()),
        }
    }

    /// The areas to check the next motion against; `way`: independent travel of the axes.
    pub(super) fn watch(
        &mut self,
        geometry: &Geometry,
        way: &AxisVec,
        names: &AxisNames,
    ) -> Option<Arc<Guarded>> {
        if self.active.is_empty() {
            return None;
        }
        let offsets_mm = geometry.tip(way);
        let areas = self.active.clone();
        let watch = Guarded { areas, offsets_mm, names: names.all() };
        // shared by consecutive motions
        if self.watch.as_deref() != Some(&watch) {
            self.watch = Some(Arc::new(watch));
        }
        self.watch.clone()
    }

    /// 120742: an axis of an active area moves independently.
    pub(super) fn moves_unwatched(
        &self,
        axis: usize,
        names: &AxisNames,
        span: Span,
    ) -> Outcome<()> {
        if self.is_defining() {
            return Err(wrong("an independent axis in the definition of a control area", span));
        }
        let Some(area) = self.active.iter().find(|area| area.axes.contains(&axis)) else {
            return Ok(());
        };
        let name = names.name(axis);
        let text =
            format!("{name} belongs to control area {}: it cannot move independently", area.number);
        Err(Fault::new(Condition::AreaAxisAlone, text, span))
    }

    /// `#CONTROL AREA BEGIN`.
    pub(in crate::exec) fn begin(
        &mut self,
        heading: Heading,
        modal: &Modal,
        at: &AxisVec,
    ) -> Outcome<()> {
        let Heading { number, span, .. } = heading;
        if modal.path.is_thread() {
            let text = "control area defined while a thread is active (G33, G63)";
            return Err(Fault::new(Condition::AreaInThread, text, span));
        }
        if self.is_defining() {
            let text = "the previous control area has no #CONTROL AREA END";
            return Err(Fault::new(Condition::AreaOpen, text, span));
        }
        if self.is_active(number) {
            return Err(wrong(
                format!("control area {number} is active and cannot be changed"),
                span,
            ));
        }
        if modal.compensation != Compensation::Off {
            return Err(Fault::unsupported("a control area defined under G41 or G42", span));
        }
        let before = at.clone();
        let (named, points) = (Vec::new(), Vec::new());
        self.draft = Some(Box::new(Draft { heading, before, named, points, circle: None }));
        Ok(())
    }

    /// `#CONTROL AREA ON`: one area, or all for `None`.
    pub(in crate::exec) fn switch_on(
        &mut self,
        number: Option<u32>,
        tip: &AxisVec,
        names: &AxisNames,
        span: Span,
    ) -> Outcome<()> {
        let chosen: Vec<Arc<Area>> = match number {
            Some(number) => match self.defined.get(&number) {
                Some(area) => vec![Arc::clone(area)],
                None => return Err(wrong(format!("control area {number} is not defined"), span)),
            },
            None => self.defined.values().cloned().collect(),
        };
        for area in chosen {
            let missing = area.axes.iter().find(|axis| !names.has(**axis));
            if missing.is_some() {
                let text = format!("an axis of control area {} is not in the channel", area.number);
                return Err(Fault::new(Condition::AreaAxisMissing, text, span));
            }
            if !area.admits(tip) {
                let point_mm = area.axes.map(|axis| tip[axis]);
                let violation = Violation { point_mm, at_end: true };
                return Err(violated(&area, violation, &names.all(), span));
            }
            if !self.is_active(area.number) {
                self.active.push(area);
            }
        }
        Ok(())
    }

    /// A block of a definition, with its path if it moves.
    pub(super) fn area_block(
        &mut self,
        path: Option<&Path>,
        words: &Words<'_>,
        geometry: &Geometry,
        modal: &Modal,
        span: Span,
    ) -> Outcome<()> {
        if !modal.absolute {
            return Err(Fault::unsupported("G91 in the definition of a control area", span));
        }
        if let Some(g) = words.group(Group::Compensation).filter(|g| g.row.number != 40) {
            let text = format!("G{} in the definition of a control area", g.row.number);
            return Err(Fault::new(Condition::AreaFunction, text, g.span));
        }
        let end = geometry.tip(geometry.coordinates.target());
        let straight = matches!(modal.path, PathMode::Rapid | PathMode::Linear);
        let Some(draft) = &mut self.draft else { return Ok(()) };
        for (axis, _, _) in &words.axes {
            if !draft.named.contains(axis) {
                draft.named.push(*axis);
            }
        }
        match path {
            Some(circle @ Path::Arc(arc)) if draft.heading.circle => {
                let shape = arc.shape();
                let full = shape.sweep_rad.abs() - std::f64::consts::TAU;
                if draft.circle.is_some() || full.abs() > 1e-9 {
                    return Err(wrong(
                        "the contour of a control area CIRC must be one full circle",
                        span,
                    ));
                }
                let shift = shape.plane.map(|axis| end[axis] - circle.end()[axis]);
                let centre = [0, 1].map(|i| shape.centre_mm[i] + shift[i]);
                draft.circle = Some((shape.plane, centre, arc.radius()));
            }
            _ if straight && draft.circle.is_none() => draft.points.push(end),
            _ if straight => {
                return Err(wrong("a motion after the circle of a control area", span));
            }
            _ => {
                let text = "the contour of a control area POLY must consist of lines (G00, G01)";
                return Err(Fault::new(Condition::AreaOfArcs, text, span));
            }
        }
        Ok(())
    }
}

impl Draft {
    /// The area of a complete definition; `plane`: axes of the active plane, for a polygon.
    fn area(
        self,
        plane: Option<[usize; 2]>,
        coordinates: &Coordinates,
        names: &AxisNames,
        span: Span,
    ) -> Outcome<Area> {
        let Self { heading, named, points, circle, .. } = self;
        let Heading { number, purpose, low_mm, high_mm, height_axis, .. } = heading;
        let (plane, base) = if let Some(plane) = plane {
            let plane = area_plane(coordinates, plane, &named, span)?;
            (plane, polygon(&points, plane, span)?)
        } else {
            if named.iter().any(|axis| coordinates.main_index(*axis).is_none()) {
                let text = "the base of a control area CIRC must be in main axes";
                return Err(Fault::new(Condition::AreaCircleAxis, text, span));
            }
            let Some((plane, centre_mm, radius_mm)) = circle else {
                return Err(wrong("a control area CIRC needs a full circle", span));
            };
            (plane, Base::Circle { centre_mm, radius_mm })
        };
        let third = || {
            (0..3).find_map(|main| {
                let axis = coordinates.main_axis(main)?;
                (!plane.contains(&axis)).then_some(axis)
            })
        };
        let Some(height) = height_axis.or_else(third) else {
            return Err(wrong("a control area without an axis for its height", span));
        };
        if plane.contains(&height) {
            let text = format!("axis {} of EXCUR belongs to the base", names.name(height));
            return Err(Fault::new(Condition::AreaHeightInBase, text, span));
        }
        Ok(Area { number, purpose, base, axes: [plane[0], plane[1], height], low_mm, high_mm })
    }
}

impl MotionState {
    /// `#CONTROL AREA END`.
    pub(in crate::exec) fn end_area(
        &mut self,
        geometry: &mut Geometry,
        modal: &Modal,
        names: &AxisNames,
        report: &mut Report,
        span: Span,
    ) -> Outcome<()> {
        let Some(draft) = self.areas.draft.take() else {
            let text = "#CONTROL AREA END without BEGIN, ignored";
            report.note(Fault::new(Condition::AreaNotBegun, text, span));
            return Ok(());
        };
        geometry.coordinates.set_target(&draft.before);
        let plane = if draft.heading.circle {
            None
        } else {
            Some(geometry.in_plane(modal, self, span)?.plane)
        };
        let area = draft.area(plane, &geometry.coordinates, names, span)?;
        self.areas.defined.insert(area.number, Arc::new(area));
        Ok(())
    }
}

/// The closed polygon through points.
fn polygon(points: &[AxisVec], plane: [usize; 2], span: Span) -> Outcome<Base> {
    let mut corners: Vec<[f64; 2]> =
        points.iter().map(|point| plane.map(|axis| point[axis])).collect();
    if corners.len() > POLYGON_BLOCKS {
        let text =
            format!("{} blocks in a control area POLY, maximum: {POLYGON_BLOCKS}", corners.len());
        return Err(Fault::new(Condition::AreaPoints, text, span));
    }
    let last = corners.pop();
    let closed = matches!((corners.first(), last), (Some(first), Some(last))
        if [0, 1].iter().all(|i| (first[*i] - last[*i]).abs() <= SAME_MM));
    if !closed || corners.len() < 3 {
        let text =
            "the contour of a control area POLY must be closed and have at least three corners";
        return Err(wrong(text, span));
    }
    if overlaps(&corners) {
        let text = "sides of a control area POLY cross each other";
        return Err(Fault::new(Condition::AreaOverlaps, text, span));
    }
    Ok(Base::Polygon(corners))
}

/// Axes of a polygon: those of the plane, or two others that its blocks name.
///
/// The pages print both 21363 and 21797 for a third axis; 21797 is from later builds, which support areas of other axes.
fn area_plane(
    coordinates: &Coordinates,
    plane: [usize; 2],
    named: &[usize],
    span: Span,
) -> Outcome<[usize; 2]> {
    if named.len() > 2 {
        let text = format!("{} axes in the contour of a control area, allowed: 2", named.len());
        return Err(Fault::new(Condition::AreaAxes, text, span)
            .with(|d| d.value(ValueKind::Wrong, named.len() as f64, "-")));
    }
    let main = |axis: &usize| coordinates.main_index(*axis);
    match *named {
        [a, b] if main(&a).is_none() && main(&b).is_none() => Ok([a, b]),
        [a] if main(&a).is_none() => {
            let text = "a control area of other axes requires two of them in its contour";
            Err(Fault::new(Condition::AreaOneAxis, text, span))
        }
        _ if named.iter().all(|axis| plane.contains(axis)) => Ok(plane),
        _ => {
            let text = "the contour of a control area must be in the main axes of its plane";
            Err(Fault::new(Condition::AreaAxis, text, span))
        }
    }
}
