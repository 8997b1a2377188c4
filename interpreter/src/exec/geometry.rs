//! Positions of programmed points: coordinates, frames, planes, arcs and angles.
//!
//! Owns offsets, coordinate systems and tool data. Otherwise pure geometry, which uses no other module of `exec`.

pub(super) mod angle;
pub(super) mod arc;
pub(super) mod area;
pub(super) mod coordinates;
pub(super) mod frame;
pub(super) mod modulo;
pub(super) mod planar;
pub(super) mod point;
pub(super) mod scale;
pub(super) mod tools;

use crate::diag::Condition;
use crate::exec::fault::{Fault, Outcome};
use crate::machine::{Axis, Machine, ToolKind};
use crate::syntax::ast::Span;
use coordinates::Coordinates;
use kontur_motion::axis::AxisVec;
use scale::Scale;
use tools::Tools;

/// The last arc, for system variables.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LastArc {
    /// Main axes of its plane.
    pub(super) plane: [usize; 2],
    /// Centre relative to the start point.
    pub(super) centre_mm: [f64; 2],
    /// The centre as V.G.I, V.G.J and V.G.K have it: programmed under G161 in coordinates of the program, otherwise relative to
    /// the start. Assumption: that of an arc by its radius is relative, whatever G161.
    pub(super) programmed_mm: [f64; 2],
    /// Shift of the centre by G165.
    pub(super) shift_mm: [f64; 2],
    pub(super) radius_mm: f64,
}

/// State that the geometry owns.
#[derive(Debug)]
pub(super) struct Geometry {
    pub(super) coordinates: Coordinates,
    /// Factors of `#SCALE`.
    pub(super) scale: Scale,
    /// Software limits of the axes (G98, G99), `None` for an axis without.
    pub(super) limits_mm: Vec<Option<(f64, f64)>>,
    pub(super) last_arc: LastArc,
    /// Coordinate system stored last.
    pub(super) last_system: u32,
    /// Whether `#TRAFO` or `#RTCP` is on.
    pub(super) transformation_on: bool,
    /// `#PTP` is active.
    pub(super) direct_on: bool,
    pub(super) tools: Tools,
}

impl Geometry {
    /// At program start, with the zero offsets and the tools of the lists.
    pub(super) fn new(machine: &Machine, start: &AxisVec) -> Self {
        let mut coordinates = Coordinates::new(start);
        let offsets = &machine.zero_offsets;
        for ((group, axis), value) in &offsets.entries {
            if *axis < machine.axes.len() {
                coordinates.set_zero_entry(*group, *axis, *value);
            }
        }
        for (group, axis) in &offsets.excluded {
            coordinates.mask_zero_entry(*group, *axis, true);
        }
        coordinates.use_zero_groups(
            offsets.has_g53,
            machine.channel.offsets.in_systems,
            offsets.start_group,
        );
        Self {
            coordinates,
            scale: Scale::new(machine.axes.len()),
            limits_mm: machine.axes.iter().map(Axis::software_limits_mm).collect(),
            last_arc: LastArc::default(),
            last_system: 1,
            transformation_on: false,
            direct_on: false,
            tools: Tools { table: machine.tools.clone(), ..Tools::default() },
        }
    }

    /// Refuses G41 and G42 with turning tools: the reference point of their tip is programmed, not its centre (287637387), and
    /// their orientation (P-TOOL-00002) is not read.
    pub(in crate::exec) fn compensates_tool(&self, span: Span) -> Outcome<()> {
        if self.tools.active.kind != ToolKind::Turning {
            return Ok(());
        }
        let what = "tool radius compensation of a turning tool (P-TOOL-00001 = 1)";
        Err(Fault::unsupported(what, span))
    }

    /// The axis of the tool length with its direction, 1 or -1: that of `#TLAX`, otherwise the third one of the plane.
    pub(in crate::exec) fn tool_axis(&self, normal: usize) -> Option<(usize, f64)> {
        let third = self.coordinates.main_axis(normal).map(|axis| (axis, 1.0));
        self.tools.length_axis.or(third)
    }

    /// Applies the offsets of the active tool; its length along the third axis of the plane.
    pub(in crate::exec) fn apply_tool(&mut self, [_, _, normal]: [usize; 3]) {
        if self.coordinates.is_without_tools() {
            return;
        }
        let mut offsets = AxisVec::zeros(self.coordinates.target().len());
        if let Some((axis, sign)) = self.tool_axis(normal) {
            offsets[axis] = sign * self.tools.active.length_mm;
        }
        for (axis, value) in &self.tools.active.offsets_mm {
            offsets[*axis] += value;
        }
        self.coordinates.set_tool(offsets);
    }

    /// The first axis with a length or an offset of the active tool that a coordinate system turns, unless the tool is fixed:
    /// the pages do not say where it lies then (P-TOOL-00010).
    pub(in crate::exec) fn turned_offset(&self) -> Option<usize> {
        let tool = &self.tools.active;
        if tool.is_fixed || self.coordinates.systems() == 0 {
            return None;
        }
        let turned = |axis: usize| {
            let main = self.coordinates.main_index(axis);
            main.is_some_and(|main| !self.coordinates.keeps_direction(main))
        };
        let offsets = self.coordinates.tool();
        (0..offsets.len()).find(|axis| offsets[*axis] != 0.0 && turned(*axis))
    }

    /// 20136 and 21555 for a plane that lacks one of its axes, or contains a modulo axis.
    pub(in crate::exec) fn plane_has_axes(
        &self,
        main_axes: [usize; 3],
        machine: &Machine,
        span: Span,
    ) -> Outcome<()> {
        let [first, second, _] = main_axes;
        for main in [first, second] {
            let Some(axis) = self.coordinates.main_axis(main) else {
                let text = format!("the channel has no main axis {} of the plane", main + 1);
                return Err(Fault::new(Condition::CompensationWithoutAxis, text, span));
            };
            let axis = &machine.axes[axis];
            if axis.is_modulo() {
                let name = axis.name().to_owned();
                let text = format!("axis {name} of the plane is a modulo axis");
                return Err(Fault::new(Condition::CompensationModulo, text, span)
                    .with(|d| d.axis(axis.number(), name)));
            }
        }
        Ok(())
    }

    /// The axis of the plane that P-AXIS-00015 marks as face turning axis.
    ///
    /// # Errors
    /// `none` if there is none, 20064 if both are marked.
    pub(in crate::exec) fn face_turning_axis(
        &self,
        main_axes: [usize; 3],
        machine: &Machine,
        (function, none): (&str, Condition),
        span: Span,
    ) -> Outcome<usize> {
        let [a, b, _] = main_axes;
        let axes = [a, b].into_iter().filter_map(|m| self.coordinates.main_axis(m));
        let mut marked = axes.filter(|i| machine.axes[*i].is_face_turning());
        let hint = "set the bit 0x40 of P-AXIS-00015 (kenngr.achs_mode) to mark it";
        match (marked.next(), marked.next()) {
            (Some(axis), None) => Ok(axis),
            (Some(_), Some(_)) => {
                let text = format!("{function} requires one face turning axis, the plane has two");
                Err(Fault::new(Condition::TwoFaceTurningAxes, text, span).hint(hint))
            }
            (None, _) => {
                let text = format!("{function} requires a face turning axis, the plane has none");
                Err(Fault::new(none, text, span).hint(hint))
            }
        }
    }

    /// G68, `#ROTATION`; refused if degrees and millimetres would be mixed.
    pub(in crate::exec) fn rotate_plane(
        &mut self,
        machine: &Machine,
        plane: [usize; 2],
        deg: f64,
        centre: [Option<f64>; 2],
        span: Span,
    ) -> Outcome<()> {
        let axis = |main: usize| self.coordinates.main_axis(main);
        let axes = plane.map(|main| axis(main).map(|axis| &machine.axes[axis]));
        if let [Some(first), Some(second)] = axes
            && (first.kind() != second.kind() || first.is_modulo() || second.is_modulo())
        {
            let what = format!("a rotation of the axes {} and {}", first.name(), second.name());
            return Err(Fault::unsupported(what, span).hint("only linear axes can be rotated"));
        }
        self.coordinates.rotate_about(plane, deg, centre, span)
    }

    /// Axis positions of the tip of the tool.
    pub(in crate::exec) fn tip(&self, positions: &AxisVec) -> AxisVec {
        let mut tip = positions.clone();
        for (x, tool) in tip.iter_mut().zip(self.coordinates.tool().iter()) {
            *x -= tool;
        }
        tip
    }

    /// Factor of centres and radii in the plane of these main axes.
    ///
    /// # Errors
    /// The axes of the plane have different factors: the scaled arc would not be an arc.
    pub(in crate::exec) fn scale_of_plane(&self, plane: [usize; 2], span: Span) -> Outcome<f64> {
        let [first, second] = plane.map(|main| self.scale_of_main(main));
        if first.to_bits() == second.to_bits() {
            Ok(first)
        } else {
            Err(Fault::unsupported(
                "an arc in a plane whose axes have different factors (#SCALE)",
                span,
            ))
        }
    }

    /// Factor of a main axis, 1 for one that is missing.
    pub(in crate::exec) fn scale_of_main(&self, main: usize) -> f64 {
        self.coordinates.main_axis(main).map_or(1.0, |axis| self.scale.factor(axis))
    }
}
