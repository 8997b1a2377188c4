//! Software limits along a path.

use crate::diag::{Condition, ValueKind};
use crate::exec::contour::{Contour, Driven};
use crate::exec::fault::Fault;
use crate::exec::geometry::Geometry;
use crate::exec::motion::state::MotionState;
use crate::exec::names::AxisNames;
use crate::exec::report::Report;
use crate::exec::values::number::LARGEST_MM;
use crate::machine::table::axis_general;
use crate::machine::{Machine, is_outside};
use crate::syntax::ast::Span;
use kontur_motion::path::Path;

/// What a check against the software limits reads.
pub(in crate::exec) struct Limits<'a> {
    ranges_mm: &'a [Option<(f64, f64)>],
    motion: &'a MotionState,
    names: &'a AxisNames,
    machine: &'a Machine,
}

impl Limits<'_> {
    /// 21897 for the slaves of an axis that moves between `low` and `high`.
    fn slaves_outside(&self, master: usize, low: f64, high: f64, at: Span) -> Vec<Fault> {
        let way = &self.motion.independent.way;
        let range = (low + way[master], high + way[master]);
        let slaves = self.motion.couplings.slaves_of(master, range);
        // the travel of a slave is not part of its path
        slaves
            .filter_map(|(slave, low, high)| {
                self.outside(slave, low - way[slave], high - way[slave], None, || at).map(|f| *f)
            })
            .collect()
    }

    /// 21897 for an axis that moves between `low` and `high` and exceeds its limits.
    pub(super) fn outside(
        &self,
        axis: usize,
        low: f64,
        high: f64,
        end: Option<f64>,
        place: impl FnOnce() -> Span,
    ) -> Option<Box<Fault>> {
        if low.to_bits() == high.to_bits() {
            return None;
        }
        let limits = self.ranges_mm[axis]?;
        let outside = |x: f64| is_outside(x, limits);
        // the path does not contain the independent travel of the axis
        let way = self.motion.independent.way[axis];
        let (low, high) = (low + way, high + way);
        // the end of the block is the programmed one
        let (what, x) = match end.map(|end| end + way).filter(|end| outside(*end)) {
            Some(end) => ("target", end),
            None if outside(low) => ("lowest position", low),
            None if outside(high) => ("highest position", high),
            None => return None,
        };
        Some(self.fault(axis, what, x, limits, place()))
    }

    /// 90134 if a motion with calculated ends between `low` and `high` leaves the data format of positions (261939083).
    fn outside_format(&self, axis: usize, low: f64, high: f64, span: Span) -> Option<Box<Fault>> {
        let x = if -low > high { low } else { high };
        if x.abs() <= LARGEST_MM {
            return None;
        }
        let (number, name) = (self.names.number(axis), self.names.name(axis).to_owned());
        let unit = self.machine.axes[axis].increment();
        let text =
            format!("axis {name}: the compensated position {x:.4} is outside the data format");
        Some(Fault::new(Condition::CompensatedOutsideFormat, text, span).with(|d| {
            let d = d.axis(number, name).value(ValueKind::Wrong, x * 1e4, unit);
            d.value(ValueKind::LowerLimit, -LARGEST_MM * 1e4, unit).value(
                ValueKind::UpperLimit,
                LARGEST_MM * 1e4,
                unit,
            )
        }))
    }

    fn fault(
        &self,
        axis: usize,
        what: &str,
        x: f64,
        (least, most): (f64, f64),
        span: Span,
    ) -> Box<Fault> {
        let name = self.names.name(axis).to_owned();
        let (number, unit) = (self.names.number(axis), self.machine.axes[axis].increment());
        // increments have four decimals; digits beyond are rounding
        let shown = (x * 1e7).round() / 1e7;
        let text = format!("axis {name}: {what} {shown} is outside its limits {least} to {most}");
        let limit = if x < least { axis_general::LOWER_LIMIT } else { axis_general::UPPER_LIMIT };
        let fault = Fault::new(Condition::OutsideMotionRange, text, span).with(|d| {
            d.axis(number, name)
                .value(ValueKind::Current, x * 1e4, unit)
                .value(ValueKind::LowerLimit, least * 1e4, unit)
                .value(ValueKind::UpperLimit, most * 1e4, unit)
                .parameter(limit)
        });
        if self.machine.limits_only_warn(axis) { fault.warning() } else { fault }
    }

    /// Checks a path against the software limits (P-AXIS-00177, P-AXIS-00178), including the reversal points of arcs; `place`
    /// is the position of the word of an axis.
    pub(super) fn check(
        &self,
        path: &Path,
        place: impl Fn(usize) -> Option<Span>,
        report: &mut Report,
        span: Span,
    ) {
        for axis in 0..self.ranges_mm.len() {
            let at_rest = path.start()[axis].to_bits() == path.end()[axis].to_bits();
            if path.is_straight() && at_rest {
                continue;
            }
            let Some((low, high)) = path.extent(axis) else { return };
            let end = path.end()[axis];
            let at = || place(axis).unwrap_or(span);
            if let Some(fault) = self.outside(axis, low, high, Some(end), at) {
                report.note(fault);
            }
            report.extend(self.slaves_outside(axis, low, high, at()));
        }
    }

    /// 21897 for a target outside the software limits of its axis.
    pub(super) fn check_target(&self, axis: usize, target: f64, report: &mut Report, at: Span) {
        let Some(limits) = self.ranges_mm[axis] else { return };
        if is_outside(target, limits) {
            report.note(self.fault(axis, "target", target, limits, at));
        }
    }
}

impl Geometry {
    /// The software limits as the program has set them.
    pub(in crate::exec) fn limits<'a>(
        &'a self,
        motion: &'a MotionState,
        names: &'a AxisNames,
        machine: &'a Machine,
    ) -> Limits<'a> {
        Limits { ranges_mm: &self.limits_mm, motion, names, machine }
    }
}

impl Contour {
    /// Checks compensated motions against the software limits, and all motions against the control areas.
    pub(in crate::exec) fn take_outside(&mut self, limits: &Limits<'_>) -> Vec<Fault> {
        let mut faults = Vec::new();
        for Driven { extents_mm, source, span } in self.take_driven() {
            for (axis, (low, high)) in extents_mm.into_iter().enumerate() {
                if let Some(fault) = limits.outside_format(axis, low, high, span) {
                    faults.push(*fault.in_block(source));
                    continue;
                }
                let slaves = limits.slaves_outside(axis, low, high, span);
                let own = limits.outside(axis, low, high, None, || span);
                let all = own.map(|fault| *fault).into_iter().chain(slaves);
                faults.extend(all.map(|fault| *Box::new(fault).in_block(source)));
            }
        }
        faults.extend(self.take_violations());
        faults
    }
}
