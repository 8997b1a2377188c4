//! Contour lines by angles: `#ANG`.
//!
//! A single line is given by its angle and one coordinate of its end. Two lines are given by two angles and the end of the
//! second line; they meet at their intersection. Assumption: an angle applies only in its own block.
//!
//! Source: TF5200 programming manual, contour line programming; 21892, 21895, 21904, 21910.

use super::state::{ContourLines, FirstLine};
use crate::diag::Condition;
use crate::exec::block::choice::PathMode;
use crate::exec::block::collected::Words;
use crate::exec::block::groups::Group;
use crate::exec::block::modal::Modal;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::geometry::angle::{cos_deg, sin_deg};
use crate::exec::geometry::coordinates::Target;
use crate::exec::report::Report;
use crate::exec::step::SourceRef;
use crate::machine::Machine;
use crate::syntax::ast::Span;

/// Sine of the angle between two lines below which they count as parallel.
const PARALLEL: f64 = 1e-9;

/// Role of a block in contour line programming.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ContourLine {
    /// No contour line, or a single one.
    Single,
    /// The first of two lines; it is executed together with the second one.
    Waits,
    /// The second of two lines. The first one ends at this point of the plane, in mm.
    Corner([f64; 2], SourceRef),
}

impl ContourLines {
    /// 21904 for a first line without its second one at the end of the program.
    pub(in crate::exec) fn end(&mut self, report: &mut Report) {
        if let Some(line) = self.open.take().filter(|line| !line.refused) {
            let text = "the contour line is not followed by a line with #ANG and the end of both";
            let fault = Fault::new(Condition::ContourLineOpen, text, line.span);
            report.note(fault.in_block(line.source));
        }
    }
}

/// The other coordinate of the end of a line from `here` in the direction of `angle`, both in the plane, whose coordinate
/// number `known` (0 or 1) is `value` there; K-0127 if the line does not reach it.
fn end_of_line(angle: f64, here: [f64; 2], known: usize, value: f64, span: Span) -> Outcome<f64> {
    let direction = [cos_deg(angle), sin_deg(angle)];
    let way = value - here[known];
    // the end lies in the direction of the angle, and the line is not parallel to the other axis
    if direction[known] * way <= 0.0 {
        let text = format!("a line of {angle} deg does not reach the coordinate");
        return Err(Fault::new(Condition::ContourLineMissed, text, span));
    }
    Ok(here[1 - known] + way / direction[known] * direction[1 - known])
}

/// Point of the plane in which two lines meet, the first one from `here` and the second one to `end`, by their angles;
/// 21892 if they are parallel, K-0127 if they do not meet on the way to the end.
fn corner_of_lines(
    [before, angle]: [f64; 2],
    here: [f64; 2],
    end: [f64; 2],
    span: Span,
) -> Outcome<[f64; 2]> {
    let [d, direction] = [before, angle].map(|angle| [cos_deg(angle), sin_deg(angle)]);
    let sine = d[0] * direction[1] - d[1] * direction[0];
    if sine.abs() < PARALLEL {
        let text = format!("two contour lines of {before} and {angle} deg never meet");
        return Err(Fault::new(Condition::ContourLineParallel, text, span));
    }
    let way = [end[0] - here[0], end[1] - here[1]];
    let to_corner = (way[0] * direction[1] - way[1] * direction[0]) / sine;
    let to_end = (d[0] * way[1] - d[1] * way[0]) / sine;
    if to_corner <= 0.0 || to_end <= 0.0 {
        let text = "the two contour lines do not meet on the way to the end";
        return Err(Fault::new(Condition::ContourLineMissed, text, span));
    }
    Ok([here[0] + to_corner * d[0], here[1] + to_corner * d[1]])
}

impl ContourLines {
    /// A block without an angle; if it moves, an open first line has ended without its second one.
    fn ends_before(&mut self, words: &Words<'_>) -> Outcome<()> {
        let moves = !words.axes.is_empty() || words.group(Group::Path).is_some();
        match self.open.take_if(|_| moves) {
            Some(line) if !line.refused => {
                let text = "the contour line before it has neither a coordinate nor a second line with #ANG";
                Err(Fault::new(Condition::ContourLineOpen, text, Span::default()))
            }
            _ => Ok(()),
        }
    }

    /// The first of two lines, which has an angle alone.
    fn begin(
        &mut self,
        angle_deg: f64,
        words: &Words<'_>,
        span: Span,
        source: SourceRef,
    ) -> Outcome<ContourLine> {
        let inserts = words.group(Group::Insertion).is_some()
            || words.group(Group::Transition).is_some()
            || words.hashes.iter().any(|(hash, _, _)| &*hash.name != "ANG");
        let refused = inserts || !words.axes.is_empty();
        self.open = Some(FirstLine { angle_deg, span, source, refused });
        if refused {
            let what = "the first of two contour lines with other words of motion";
            return Err(Fault::unsupported(what, span));
        }
        Ok(ContourLine::Waits)
    }

    /// Applies `#ANG` to the current block.
    pub(super) fn contour_line(
        &mut self,
        words: &Words<'_>,
        geometry: &Geometry,
        machine: &Machine,
        modal: &Modal,
        source: SourceRef,
    ) -> Outcome<ContourLine> {
        let angle = words.hashes.iter().find(|(hash, _, _)| &*hash.name == "ANG");
        let Some((_, angle, span)) = angle else {
            self.ends_before(words)?;
            return Ok(ContourLine::Single);
        };
        let span = *span;
        let Some(angle) = angle.filter(|a| a.is_finite()) else {
            return Err(Fault::new(Condition::Syntax, "#ANG without an angle", span)
                .hint("write the angle to the first axis in deg: #ANG=30"));
        };
        let axes = geometry.axes_of_contour_lines(words, modal, span)?;
        let here = axes.map(|axis| geometry.coordinates.programmed(axis));
        let end = axes.map(|axis| geometry.end_of_contour_line(words, axis, machine, modal));
        match (self.open.take(), end) {
            (None, [None, None]) => self.begin(angle, words, span, source),
            (None, [Some(_), Some(_)]) => {
                let text = "#ANG with both coordinates of the plane";
                Err(Fault::new(Condition::ContourLineTwice, text, span))
            }
            (None, [x, y]) => {
                let given = usize::from(x.is_none());
                let (value, _) = x.or(y).unwrap_or_default();
                let value = end_of_line(angle, here, given, value, span)?;
                self.targets = vec![Target { axis: axes[1 - given], value, absolute: true }];
                Ok(ContourLine::Single)
            }
            (Some(first_line), [Some((x, true)), Some((y, true))]) => {
                if words.group(Group::Insertion).is_some() || words.hashes.len() > 1 {
                    let what = "a chamfer or rounding in a block of two contour lines";
                    return Err(Fault::unsupported(what, span));
                }
                let corner = corner_of_lines([first_line.angle_deg, angle], here, [x, y], span)?;
                Ok(ContourLine::Corner(corner, first_line.source))
            }
            (Some(_), [Some(_), Some(_)]) => {
                let text =
                    "the end point of two contour lines is programmed in relative coordinates";
                Err(Fault::new(Condition::ContourLineRelative, text, span))
            }
            (Some(_), _) => {
                let text = "the second of two contour lines needs both coordinates of the plane";
                Err(Fault::new(Condition::ContourLineOpen, text, span))
            }
        }
    }
}

impl Geometry {
    /// End of a contour line along an axis in the coordinates of the program, and whether it is programmed in absolute ones.
    fn end_of_contour_line(
        &self,
        words: &Words<'_>,
        axis: usize,
        machine: &Machine,
        modal: &Modal,
    ) -> Option<(f64, bool)> {
        let i = words.axes.iter().position(|(a, _, _)| *a == axis)?;
        let absolute = words.is_absolute(i, modal.absolute);
        let value = words.axes[i].1 * self.coordinate_unit(axis, absolute, machine, modal);
        let from = self.coordinates.programmed(axis);
        Some((if absolute { value } else { from + value }, absolute))
    }

    /// The axes of the plane in which `#ANG` draws lines.
    fn axes_of_contour_lines(
        &self,
        words: &Words<'_>,
        modal: &Modal,
        span: Span,
    ) -> Outcome<[usize; 2]> {
        let mode = match words.group(Group::Path).map(|g| g.row.act) {
            Some(crate::exec::block::groups::Act::Path(mode)) => mode,
            _ => modal.path,
        };
        if !matches!(mode, PathMode::Linear | PathMode::Rapid) {
            return Err(Fault::unsupported("#ANG in another motion than a straight one", span));
        }
        let [first, second, _] = modal.plane.main_axes();
        let plane = [first, second].map(|m| self.coordinates.main_axis(m));
        let [Some(first), Some(second)] = plane else {
            let text = "the plane of #ANG has no axis in the channel";
            return Err(Fault::new(Condition::MainAxisMissing, text, span));
        };
        Ok([first, second])
    }
}

impl Decoder {
    /// The first of two lines, while the second one is still to be read.
    pub(super) fn contour_lines(
        &mut self,
        line: &ContourLine,
        words: &Words<'_>,
        span: Span,
    ) -> Outcome<()> {
        let ContourLine::Corner(corner, source) = line else { return Ok(()) };
        let main = self.modal.plane.main_axes();
        let mut first = Words::default();
        for (m, value) in [main[0], main[1]].into_iter().zip(corner) {
            if let Some(axis) = self.geometry.coordinates.main_axis(m) {
                let at = words.axes.first().map_or(span, |(_, _, at)| *at);
                first.axes.push((
                    axis,
                    value / self.geometry.coordinate_unit(axis, true, &self.machine, &self.modal),
                    at,
                ));
            }
        }
        first.dimensions.push((0, true));
        let here = std::mem::replace(&mut self.report.source, *source);
        let outcome = self.motion(&first, false, span);
        self.stop_exactly(&first);
        self.report.source = here;
        outcome
    }
}
