//! The control areas that a motion of a contour must not violate.
//!
//! Source: TF5200 workspace monitoring (291148299); 120484.

use crate::diag::{Condition, ValueKind};
use crate::exec::fault::Fault;
use crate::exec::geometry::area::{Area, Purpose, Violation};
use crate::exec::step::SourceRef;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::path::Path;
use std::sync::Arc;

/// The areas that a motion is checked against.
#[derive(Debug, PartialEq)]
pub(in crate::exec) struct Guarded {
    pub(in crate::exec) areas: Vec<Arc<Area>>,
    /// Offset from the path to the tip of the tool.
    pub(in crate::exec) offsets_mm: AxisVec,
    /// Names of the axes.
    pub(in crate::exec) names: Vec<String>,
}

impl Guarded {
    /// The areas that a motion violates.
    pub(in crate::exec) fn fault(
        &self,
        path: &Path,
        source: SourceRef,
        span: Span,
    ) -> Option<Fault> {
        let (area, violation) = self.areas.iter().find_map(|area| {
            let violation = area.violation(path, &self.offsets_mm)?;
            Some((area, violation))
        })?;
        Some(*violated(area, violation, &self.names, span).in_block(source))
    }
}

/// 120484, K-0147.
pub(in crate::exec) fn violated(
    area: &Area,
    violation: Violation,
    names: &[String],
    span: Span,
) -> Box<Fault> {
    let condition = match (area.purpose, violation.at_end) {
        (Purpose::Workspace, true) => Condition::OutsideWorkspace,
        _ => Condition::AreaViolated,
    };
    let place: Vec<String> = area
        .axes
        .iter()
        .zip(violation.point_mm)
        .map(|(axis, x)| format!("{}{}", names[*axis], (x * 1e4).round() / 1e4))
        .collect();
    let text = match area.purpose {
        Purpose::Workspace => format!("{} is outside workspace {}", place.join(" "), area.number),
        Purpose::Protection => format!("{} is in protection area {}", place.join(" "), area.number),
    };
    Fault::new(condition, text, span).with(|d| d.value(ValueKind::Current, area.number, "-"))
}
