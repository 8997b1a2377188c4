//! Online tool compensation (`#OTC`): the settings that the simulation needs.
//!
//! Source: TF5200 online tool compensation (213641867, 213655947, 213664139, 213718539, 213774347).

use super::state::wear::WearSource;
use crate::diag::Condition;
use crate::exec::block::modal::Modal;
use crate::exec::contour::Contour;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::motion::state::MotionState;
use crate::exec::step::{Event, WearSetting, WornPart};
use crate::machine::ToolKind;
use crate::syntax::ast::Span;

impl MotionState {
    /// Passes the settings to the simulation: `#OTC ON`, or while it is on, changed tool data or another axis of its length.
    pub(in crate::exec) fn apply_wear(
        &self,
        geometry: &Geometry,
        modal: &Modal,
        contour: &mut Contour,
        span: Span,
    ) -> Outcome<()> {
        let wear = self.wear;
        if !wear.on {
            return Ok(());
        }
        let tool = &geometry.tools.active;
        if tool.kind != ToolKind::Grinding {
            let text = format!("#OTC ON with the data of a {} tool", tool.kind.name());
            return Err(Fault::new(Condition::WearWithoutWheel, text, span));
        }
        if tool.tilt_deg.abs() > 0.0 {
            return Err(Fault::unsupported("#OTC with a tilted grinding wheel", span));
        }
        let part = if wear.radius {
            WornPart::Radius
        } else {
            let normal = modal.plane.main_axes()[2];
            let Some((axis, sign)) = geometry.tool_axis(normal) else {
                let text = "#OTC [LENGTH]: the channel has no axis perpendicular to the plane";
                return Err(Fault::new(Condition::AxisOrCommandExpected, text, span));
            };
            WornPart::Length { axis, sign }
        };
        let by_way = wear.source != WearSource::Outside;
        let from_outside = wear.source != WearSource::Way;
        let setting = WearSetting {
            part,
            wheel: geometry.tools.data,
            ratio: if by_way { wear.ratio.unwrap_or(tool.wear_ratio) } else { 0.0 },
            most_mm: if from_outside { tool.most_infeed_mm } else { 0.0 },
            from_outside,
            acceleration_ratio: wear.acceleration_ratio,
        };
        contour.report_engagement();
        contour.event(Event::Wear(Some(setting)));
        Ok(())
    }
}
