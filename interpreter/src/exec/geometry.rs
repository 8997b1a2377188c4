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
pub(super) mod scale;
pub(super) mod tools;

use crate::machine::{Axis, Machine};
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
        coordinates.use_zero_groups(
            offsets.has_g53,
            machine.channel.offsets_in_systems,
            offsets.start_group,
        );
        Self {
            coordinates,
            scale: Scale::new(machine.axes.len()),
            limits_mm: machine.axes.iter().map(Axis::software_limits_mm).collect(),
            last_arc: LastArc::default(),
            last_system: 1,
            transformation_on: false,
            tools: Tools { table: machine.tools.clone(), ..Tools::default() },
        }
    }
}
