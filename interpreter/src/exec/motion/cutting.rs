//! Turning with a constant cutting speed: G96, G97, G196.
//!
//! The simulation computes the speed in every cycle from the distance between tool and turning centre; in rapid blocks the
//! spindle keeps its speed. A feed rate per revolution (G95) follows the speed.
//!
//! Assumption: the turning centre is where the programmed coordinate of the face turning axis and its G92 offset are 0.
//!
//! Source: TF5200 turning functions, constant cutting speed, constant cutting speed at feed rate per revolution;
//! P-AXIS-00015; 20633, 20642, 20643, 50182, 120167, 120169.

use crate::diag::{Condition, ValueKind, rounded};
use crate::exec::block::choice::{FeedType, PathMode, Plane};
use crate::exec::block::collected::Words;
use crate::exec::block::groups::{Act, Group};
use crate::exec::block::modal::Modal;
use crate::exec::contour::{Contour, CuttingFeed, FeedCourse};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::motion::plane::InPlane;
use crate::exec::motion::state::MotionState;
use crate::exec::names::AxisNames;
use crate::exec::output::Output;
use crate::exec::report::{Report, Subject};
use crate::exec::step::{CuttingSpeed, Event};
use crate::machine::Machine;
use crate::machine::table::axis_general;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::Feed;
use kontur_motion::path::Path;

/// mm in a foot.
const FOOT_MM: f64 = 304.8;

impl MotionState {
    /// Refuses functions that depend on the speed of the main spindle while an override changes it: the pages do not state
    /// which of the two speeds applies.
    pub(in crate::exec) fn no_spindle_override(&self, what: &str, span: Span) -> Outcome<()> {
        if self.spindles[0].is_overridden() {
            let what = format!("{what} with an override of the main spindle (S[OVERRIDE ..])");
            return Err(Fault::unsupported(what, span)
                .hint("write S[OVERRIDE SPEED_FACT=100] to cancel it"));
        }
        Ok(())
    }

    /// Speed of the main spindle in rev/min after the current position.
    pub(in crate::exec) fn spindle_rpm(&self, coordinates: &Coordinates, machine: &Machine) -> f64 {
        match self.cutting.speed {
            Some(cutting) => {
                let at_mm = cutting.held_mm.unwrap_or(coordinates.target()[cutting.axis]);
                cutting.rpm(at_mm - cutting.centre_mm)
            }
            None => self.spindles[0].rpm.abs().min(self.spindles[0].most_rpm(machine)),
        }
    }

    /// Passes the state to the simulation.
    fn report_cutting_speed(&self, contour: &mut Contour) {
        if let (Some(cutting), Some(spindle)) = (self.cutting.speed, self.spindles[0].index) {
            contour.event(Event::CuttingSpeed { spindle, cutting: Some(cutting) });
        }
    }

    /// Called before a motion with a known target. Offsets may have moved the turning centre, and rapid blocks keep the speed
    /// of their start position.
    ///
    /// # Errors
    /// K-0019: a rotated system.
    pub(in crate::exec) fn follow_turning_centre(
        &mut self,
        start: &AxisVec,
        coordinates: &Coordinates,
        modal: &Modal,
        contour: &mut Contour,
        span: Span,
    ) -> Outcome<()> {
        let rapid = modal.path == PathMode::Rapid;
        let Some(cutting) = &mut self.cutting.speed else { return Ok(()) };
        let (axis, known) = (cutting.axis, cutting.centre_mm);
        let changes = rapid != cutting.held_mm.is_some();
        if changes {
            cutting.held_mm = rapid.then(|| start[axis]);
        }
        cutting.centre_mm = centre(coordinates, axis, span)?;
        if changes || (cutting.centre_mm - known).abs() > 1e-9 {
            self.report_cutting_speed(contour);
        }
        Ok(())
    }

    /// G96, G97 and G196 with the S word of their block.
    pub(in crate::exec) fn cutting_words(
        &mut self,
        words: &Words<'_>,
        geometry: &Geometry,
        modal: &Modal,
        output: &mut Output<'_>,
    ) -> Outcome<()> {
        let g = words.group(Group::SpindleMode);
        let speed = words.speeds.iter().find(|(spindle, _, _)| *spindle == 0).copied();
        if let (Some(Act::CuttingSpeedMax), Some(m)) =
            (g.map(|g| g.row.act), words.m.iter().find(|m| m.number == 19))
        {
            let text = "M19 with G196";
            return Err(Fault::new(Condition::PositioningWithMaximum, text, m.span));
        }
        if let Some(m) = words.m.iter().find(|m| m.number == 19)
            && !matches!(g.map(|g| g.row.act), Some(Act::CuttingSpeed(false)))
        {
            self.cutting.positions_main_spindle(m.span)?;
        }
        match g.map(|g| (g.row.act, g.span)) {
            Some((Act::CuttingSpeedMax, span)) => match speed {
                Some((_, rpm, _)) if rpm > 0.0 && rpm <= 1e6 => {
                    if self.cutting.speed.is_some() {
                        let text = "G196 while G96 is active: the spindle keeps its limit until the next S of G96";
                        output.report.note(Fault::new(Condition::CuttingSpeedMaxLate, text, span));
                    }
                    self.cutting.rpm_max = Some(rpm);
                    Ok(())
                }
                _ => {
                    let text = "G196 requires a speed greater than 0 (S)";
                    Err(Fault::new(Condition::CuttingSpeedMax, text, span))
                }
            },
            Some((Act::CuttingSpeed(false), _)) => {
                if self.cutting.speed.is_some() {
                    // keeps the present speed
                    self.spindles[0].rpm = self.spindle_rpm(&geometry.coordinates, output.machine);
                    self.cutting.speed = None;
                    if let Some(spindle) = self.spindles[0].index {
                        output.contour.event(Event::CuttingSpeed { spindle, cutting: None });
                    }
                }
                self.cutting.waits = false;
                Ok(())
            }
            Some((Act::CuttingSpeed(true), _)) => {
                self.cutting.waits = true;
                self.cut_with(speed.map(|(_, v, at)| (v, at)), geometry, modal, output)
            }
            _ => self.cut_with(speed.map(|(_, v, at)| (v, at)), geometry, modal, output),
        }
    }

    fn cut_with(
        &mut self,
        speed: Option<(f64, Span)>,
        geometry: &Geometry,
        modal: &Modal,
        output: &mut Output<'_>,
    ) -> Outcome<()> {
        let (true, Some((written, at))) = (self.cutting.waits, speed) else { return Ok(()) };
        let unit_mm =
            if output.machine.channel.feed.cuts_in_feet && modal.inch { FOOT_MM } else { 1000.0 };
        if written <= 0.0 || written > 1e6 {
            let text = format!("cutting speed S{written}");
            let condition = if written < 0.0 {
                Condition::CuttingSpeedNegative
            } else {
                Condition::CuttingSpeedZero
            };
            return Err(Fault::new(condition, text, at));
        }
        let axis = geometry.face_turning_axis(
            modal.plane.main_axes(),
            output.machine,
            ("G96", Condition::CuttingWithoutFaceAxis),
            at,
        )?;
        self.no_spindle_override("G96", at)?;
        let listed = self.spindles[0].index.and_then(|i| output.machine.spindles.get(i));
        let Some(most) = listed.map(|s| s.dynamics().v_max_mm_s / 6.0) else {
            return Err(Fault::unsupported("G96 without a spindle in the machine", at));
        };
        let cutting = CuttingSpeed {
            axis,
            centre_mm: centre(&geometry.coordinates, axis, at)?,
            speed_mm_min: written * unit_mm,
            max_rpm: self.cutting.rpm_max.map_or(most, |rpm| rpm.min(most)),
            held_mm: None,
        };
        let radius = geometry.coordinates.target()[axis] - cutting.centre_mm;
        if cutting.speed_mm_min / (std::f64::consts::TAU * radius.abs())
            > cutting.max_rpm * (1.0 + 1e-9)
        {
            let text = format!(
                "{} mm from the turning centre the cutting speed requires more than {} rev/min: limited",
                rounded(radius.abs()),
                rounded(cutting.max_rpm)
            );
            output.report.note(
                Fault::new(Condition::CuttingSpeedLimited, text, at)
                    .with(|d| d.value(ValueKind::Wrong, radius.abs() * 1e4, "0.1um")),
            );
        }
        self.spindles[0].rpm = cutting.rpm(radius);
        self.cutting.speed = Some(cutting);
        self.report_cutting_speed(output.contour);
        Ok(())
    }
}

/// Position of the face turning axis in mm with its tool at the turning centre.
fn centre(coordinates: &Coordinates, axis: usize, span: Span) -> Outcome<f64> {
    coordinates.turning_centre(axis).ok_or_else(|| {
        let what = "a constant cutting speed (G96) whose face turning axis is rotated";
        Fault::unsupported(what, span)
    })
}

impl Geometry {
    /// G51: the axis whose words are diameters, the face turning axis of the plane; centres and radii of arcs are not affected.
    ///
    /// Assumptions: G92, the words of independent axes and `V.A.ABS` are not affected either.
    ///
    /// Source: TF5200 turning functions, diameter programming; P-AXIS-00058, P-AXIS-00059, P-CHAN-00091; 20042.
    pub(in crate::exec) fn diameter_axis(
        &self,
        plane: Plane,
        machine: &Machine,
        names: &AxisNames,
        report: &mut Report,
        span: Span,
    ) -> Outcome<usize> {
        let none = ("G51", Condition::NoFaceTurningAxis);
        let axis = self.face_turning_axis(plane.main_axes(), machine, none, span)?;
        if machine.channel.offsets.in_diameters {
            let what = "diameter programming with offsets in diameters (P-CHAN-00091)";
            return Err(Fault::unsupported(what, span));
        }
        let listed = &machine.axes[axis];
        if !listed.takes_diameters(true) && !listed.takes_diameters(false) {
            let name = names.name(axis);
            let text = format!("G51 has no effect: axis {name} does not accept diameters");
            let hint = "enable diameters with kenngr.durchm_prog_abs (P-AXIS-00058) and durchm_prog_rel (P-AXIS-00059)";
            let fault = Fault::new(Condition::ListNoEffect, text, span).hint(hint);
            report.note_once(
                Subject::G(51),
                fault.with(|d| d.parameter(axis_general::DIAMETER_ABSOLUTE)),
            );
        }
        Ok(axis)
    }

    /// Factor from a coordinate word of an axis to mm: its unit, halved for diameters, times its scale factor (`#SCALE`).
    pub(in crate::exec) fn coordinate_unit(
        &self,
        axis: usize,
        absolute: bool,
        machine: &Machine,
        modal: &Modal,
    ) -> f64 {
        let halves = modal.diameter == Some(axis) && machine.axes[axis].takes_diameters(absolute);
        let unit = modal.axis_unit(&machine.axes[axis]) * if halves { 0.5 } else { 1.0 };
        unit * self.scale.factor(axis)
    }
}

impl Decoder {
    /// G95 under G96: the mean feed rate of a motion, and how it follows the speed of the spindle; `None` in other modes.
    ///
    /// # Errors
    /// K-0019: the feed rate changes along the motion, and the corner at one of its ends is to be rounded, or its path is that
    /// of tool radius compensation.
    pub(super) fn cutting_feed(
        &self,
        path: &Path,
        feed: Feed,
        rounds: bool,
        in_plane: &InPlane,
        span: Span,
    ) -> Outcome<Option<(Feed, FeedCourse)>> {
        let per_revolution = self.modal.feed_type == FeedType::PerRevolution;
        let other = feed == Feed::Rapid || self.motion.measuring.feed.is_some();
        let Some(mut cutting) = self.motion.cutting.speed.filter(|_| per_revolution && !other)
        else {
            return Ok(None);
        };
        let Some(word) = self.modal.feed().filter(|word| word.value > 0.0) else { return Ok(None) };
        cutting.centre_mm -= self.motion.independent.way[cutting.axis];
        let way_mm = word.value * word.unit_mm(&self.machine, path);
        let course = CuttingFeed { cutting, way_mm };
        let Some(pieces) = course.pieces(path) else {
            return Err(Fault::unsupported("such a range of speeds with G95 under G96", span));
        };
        let beside = if in_plane.compensation.is_some() {
            "tool radius compensation"
        } else if pieces.len() == 1 {
            ""
        } else if rounds
            || self.contour.hsc.contour().is_some()
            || self.contour.has_contoured_corner()
        {
            "contouring"
        } else if self.contour.hsc.spline().is_some() {
            "splines"
        } else {
            ""
        };
        if !beside.is_empty() {
            let what = format!("G95 under G96 with {beside}");
            return Err(Fault::unsupported(what, span));
        }
        let (mut from, mut time_s) = (0.0, 0.0);
        for (to, mm_s) in pieces {
            time_s += (to - from) / mm_s;
            from = to;
        }
        let mean = Feed::PathVelocity(path.length() / time_s);
        Ok(Some((mean, FeedCourse::PerRevolution(course))))
    }
}
