//! The variables that can be read: one row each.
//!
//! Where a simulator without a control has no such value, kontur chooses one.

use super::path::Path;
use crate::exec::decoder::Decoder;
use crate::exec::fault::Outcome;
use crate::exec::geometry::coordinates::LAST_ZERO_GROUP;
use crate::exec::geometry::tools::Tool;
use crate::exec::geometry::tools::WEAR_UNIT;
use crate::exec::options::Value;

/// One readable variable: its name with `*` for an axis name or index.
type Reader = fn(&Decoder, &Path<'_>) -> Outcome<Value>;

/// One row.
pub(super) struct Row {
    /// Segments in upper case; `*` an axis, `n` a name with an index, `?` anything.
    pub(super) name: &'static [&'static str],
    /// Meaning in one sentence, for `explain`.
    pub(super) meaning: &'static str,
    pub(super) read: Reader,
}

#[expect(clippy::unnecessary_wraps, reason = "a cell of the table may fail")]
fn number(x: f64) -> Outcome<Value> {
    Ok(Value::Number(x))
}

#[expect(clippy::unnecessary_wraps, reason = "a cell of the table may fail")]
fn truth(b: bool) -> Outcome<Value> {
    Ok(Value::truth(b))
}

#[expect(clippy::unnecessary_wraps, reason = "a cell of the table may fail")]
fn text(s: &str) -> Outcome<Value> {
    Ok(Value::Text(s.into()))
}

/// Actual position of an axis in the active system without offsets, in mm; the programmed one where nothing has moved.
fn actual_coordinate(d: &Decoder, axis: usize) -> f64 {
    let coordinates = &d.geometry.coordinates;
    let mut position = coordinates.target().clone();
    for (position, actual_mm) in position.iter_mut().zip(d.live.feedback().actual_mm.iter()) {
        *position = *actual_mm;
    }
    coordinates.program_at(&position)[axis]
}

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    Row { name: &["A", "ABS", "*"], meaning: "programmed position of an axis, without offsets", read: |d, p| p.coordinate(d, 2, |d, a| d.geometry.coordinates.programmed(a)) },
    Row { name: &["A", "PROG", "*"], meaning: "last coordinate word of an axis as it is traversed, mirrored and rotated, without offsets", read: |d, p| p.coordinate(d, 2, |d, a| d.geometry.coordinates.traversed_word(a)) },
    Row { name: &["A", "MENT", "*"], meaning: "position of an axis in the values of the program, before mirroring", read: |d, p| p.coordinate(d, 2, |d, a| d.geometry.coordinates.programmed(a)) },
    Row { name: &["A", "ACT_POS", "*"], meaning: "actual position of an axis in the active system, without offsets; motion comes to rest before it is read", read: |d, p| p.coordinate(d, 2, actual_coordinate) },
    Row { name: &["A", "ACS", "ABS", "*"], meaning: "position of an axis with all offsets", read: |d, p| p.axis_position(d) },
    Row { name: &["A", "BZP", "*"], meaning: "reference point offset of an axis (#PSET)", read: |d, p| p.position(d, 2, |d, a| d.geometry.coordinates.preset(a)) },
    Row { name: &["A", "MESS", "*"], meaning: "measured value of an axis", read: |d, p| p.wrapped(d, 2, |d, a| d.motion.measuring.results[a].value) },
    Row { name: &["A", "MERF", "*"], meaning: "1 if the probe has signalled for the axis", read: |d, p| { let a = p.axis(d, 2)?; truth(d.motion.measuring.results[a].signalled) } },
    Row { name: &["A", "MOFFS", "*"], meaning: "offset between target and measured value of an axis", read: |d, p| p.position(d, 2, |d, a| d.motion.measuring.results[a].offset.unwrap_or_default()) },
    Row { name: &["A", "MEIN", "*"], meaning: "measuring offset of an axis applied by G101", read: |d, p| p.position(d, 2, |d, a| d.geometry.coordinates.measuring_offset(a)) },
    Row { name: &["A", "MEAS", "ACS", "VALUE", "*"], meaning: "measured value of an axis in coordinates of the axis", read: |d, p| p.wrapped(d, 4, |d, a| d.motion.measuring.results[a].axis) },
    Row { name: &["A", "MEAS", "PCS", "VALUE", "*"], meaning: "measured value of an axis in coordinates of the program", read: |d, p| p.wrapped(d, 4, |d, a| d.motion.measuring.results[a].program) },
    // axes count as homed at their position, and clamp position offsets are not read
    Row { name: &["A", "RERF", "*"], meaning: "1 if the axis is homed; here always 1", read: |d, p| { p.axis(d, 2)?; truth(true) } },
    Row { name: &["A", "PZV", "*"], meaning: "clamp position offset of an axis; here 0", read: |d, p| { p.axis(d, 2)?; number(0.0) } },
    // axis compensations are not simulated (308731019)
    Row { name: &["A", "CROSS_COMP_INIT", "*"], meaning: "1 if cross compensation of an axis is initialised; here 0", read: not_compensated },
    Row { name: &["A", "CROSS_COMP_ACTIVE", "*"], meaning: "1 if cross compensation of an axis is active; here 0", read: not_compensated },
    Row { name: &["A", "PLANE_COMP_INIT", "*"], meaning: "1 if plane compensation of an axis is initialised; here 0", read: not_compensated },
    Row { name: &["A", "PLANE_COMP_ACTIVE", "*"], meaning: "1 if plane compensation of an axis is active; here 0", read: not_compensated },
    Row { name: &["A", "LEAD_COMP_INIT", "*"], meaning: "1 if leadscrew error compensation of an axis is initialised; here 0", read: not_compensated },
    Row { name: &["A", "LEAD_COMP_ACTIVE", "*"], meaning: "1 if leadscrew error compensation of an axis is active; here 0", read: not_compensated },
    Row { name: &["A", "TEMP_COMP_INIT", "*"], meaning: "1 if temperature compensation of an axis is initialised; here 0", read: not_compensated },
    Row { name: &["A", "TEMP_COMP_ACTIVE", "*"], meaning: "1 if temperature compensation of an axis is active; here 0", read: not_compensated },
    Row { name: &["A", "FRICT_COMP_INIT", "*"], meaning: "1 if friction compensation of an axis is initialised; here 0", read: not_compensated },
    Row { name: &["A", "FRICT_COMP_ACTIVE", "*"], meaning: "1 if friction compensation of an axis is active; here 0", read: not_compensated },
    Row { name: &["A", "CROSSTALK_COMP_INIT", "*"], meaning: "1 if crosstalk compensation of an axis is initialised; here 0", read: not_compensated },
    Row { name: &["A", "CROSSTALK_COMP_ACTIVE", "*"], meaning: "1 if crosstalk compensation of an axis is active; here 0", read: not_compensated },
    // manual mode is not simulated
    Row { name: &["A", "MANUAL_OFFSETS", "*"], meaning: "offset of manual mode of an axis; here 0", read: |d, p| { p.axis(d, 2)?; number(0.0) } },
    Row { name: &["A", "SOFFS", "*"], meaning: "offset of manual mode of an axis (older name); here 0", read: |d, p| { p.axis(d, 2)?; number(0.0) } },
    Row { name: &["G", "AX_LINK", "NR"], meaning: "coupling group switched on last (#ENABLE AX LINK); 0 before the first one", read: |d, _| number(f64::from(d.motion.couplings.last)) },
    Row { name: &["G", "AX_LINK", "ACTIVE"], meaning: "1 while axes are coupled", read: |d, _| truth(!d.motion.couplings.are_off()) },
    Row { name: &["G", "FILE_EXIST"], meaning: "1 if #FILE EXIST has found its file", read: |d, _| truth(d.calls.searched.found.is_some()) },
    Row { name: &["G", "FILE_EXIST_PATH_NAME"], meaning: "folder and name of the file that #FILE EXIST has found; empty without one", read: |d, _| text(d.calls.searched.path()) },
    Row { name: &["G", "FILE_EXIST_DIRECTORY"], meaning: "folder of the file that #FILE EXIST has found, up to its last backslash; empty without one", read: |d, _| text(d.calls.searched.folder()) },
    Row { name: &["TLM", "TIME_FACT"], meaning: "weight of the time in use of the tool; here without effect", read: |d, _| number(d.values.tool_life[0]) },
    Row { name: &["TLM", "DIST_FACT"], meaning: "weight of the distance in use of the tool; here without effect", read: |d, _| number(d.values.tool_life[1]) },
    Row { name: &["G", "MEAS_TYPE"], meaning: "type of measuring runs", read: |d, _| number(f64::from(d.motion.measuring.kind)) },
    Row { name: &["G", "CYCLE_CHANGES_MODAL"], meaning: "1 if changes made by a cycle remain in effect after it", read: |d, _| truth(d.calls.cycle_changes_stay) },
    Row { name: &["G", "RW"], meaning: "distance after the signal of the probe at which edge banding stops", read: |d, _| number(d.motion.measuring.residual_path_mm / d.modal.unit_mm()) },
    Row { name: &["A", "-SWE", "*"], meaning: "negative software limit of an axis in force", read: |d, p| p.position(d, 2, |d, a| limit(d.geometry.limits_mm[a]).0) },
    Row { name: &["A", "+SWE", "*"], meaning: "positive software limit of an axis in force", read: |d, p| p.position(d, 2, |d, a| limit(d.geometry.limits_mm[a]).1) },
    Row { name: &["A", "-SWE_MDS", "*"], meaning: "negative software limit of an axis by its list", read: |d, p| p.position(d, 2, |d, a| limit(d.machine.axes[a].software_limits_mm()).0) },
    Row { name: &["A", "+SWE_MDS", "*"], meaning: "positive software limit of an axis by its list", read: |d, p| p.position(d, 2, |d, a| limit(d.machine.axes[a].software_limits_mm()).1) },
    Row { name: &["A", "REF", "*"], meaning: "reference position of an axis; here 0", read: |d, p| { p.axis(d, 2)?; number(0.0) } },
    Row { name: &["A", "MODE", "*"], meaning: "mode of an axis as bits (P-AXIS-00015)", read: |d, p| { let a = p.axis(d, 2)?; number(f64::from(d.machine.axes[a].mode_bits())) } },
    Row { name: &["A", "MODULO_VALUE", "*"], meaning: "modulo range of an axis in deg; 0 for an axis that is not modulo", read: |d, p| { let a = p.axis(d, 2)?; number(if d.machine.axes[a].is_modulo() { d.machine.axes[a].modulo_deg() } else { 0.0 }) } },
    Row { name: &["G", "BLOCK_NR"], meaning: "block number (N) of the current block", read: |d, _| number(d.calls.info.block_number as f64) },
    Row { name: &["G", "SATZ_NR"], meaning: "block number (N) of the current block (older name)", read: |d, _| number(d.calls.info.block_number as f64) },
    Row { name: &["G", "FEEDRATE"], meaning: "F word in force, in the active unit", read: |d, _| number(d.modal.feed_in_unit()) },
    Row { name: &["G", "FEEDRATE_MODE"], meaning: "G function of the feed type: 93, 94, 95, 194", read: |d, _| number(f64::from(d.modal.feed_type.g())) },
    Row { name: &["G", "FEEDRATE_SCALE"], meaning: "factor from mm/min to the unit of the F word (P-CHAN-00108)", read: |d, _| number(1.0 / d.machine.channel.feed.unit_mm_min) },
    Row { name: &["G", "MASS_MM"], meaning: "1 under G70 (inch)", read: |d, _| truth(d.modal.inch) },
    Row { name: &["G", "MASS_360"], meaning: "scaling of rotary axes; here 0", read: |_, _| number(0.0) },
    Row { name: &["G", "I"], meaning: "centre of the last arc along the first main axis: relative to its start, under G161 absolute", read: |d, _| centre(d, 0) },
    Row { name: &["G", "J"], meaning: "centre of the last arc along the second main axis: relative to its start, under G161 absolute", read: |d, _| centre(d, 1) },
    Row { name: &["G", "K"], meaning: "centre of the last arc along the third main axis: relative to its start, under G161 absolute", read: |d, _| centre(d, 2) },
    Row { name: &["G", "R"], meaning: "radius of the last arc", read: |d, _| number(d.geometry.last_arc.radius_mm / d.modal.unit_mm()) },
    Row { name: &["G", "MERR"], meaning: "correction of the centre of the last arc along main axis i", read: |d, p| {
        let i = p.index(d, 1, 2)?;
        let place = d.geometry.last_arc.plane.iter().position(|m| *m == i as usize);
        number(place.map_or(0.0, |k| d.geometry.last_arc.shift_mm[k]) / d.modal.unit_mm())
    } },
    Row { name: &["G", "NP", "V", "*"], meaning: "zero offset of an axis in group i", read: |d, p| { let g = p.index(d, 1, LAST_ZERO_GROUP)?; p.position(d, 3, |d, a| d.geometry.coordinates.zero_entry(g, a)) } },
    Row { name: &["G", "NP_AKT", "V", "*"], meaning: "zero offset of an axis in force", read: |d, p| p.position(d, 3, |d, a| d.geometry.coordinates.zero_offset(a)) },
    Row { name: &["G", "NP_DEFAULT"], meaning: "group of zero offsets at program start", read: |d, _| number(f64::from(d.machine.zero_offsets.start_group)) },
    Row { name: &["G", "WZ_AKT", "R"], meaning: "radius of the active tool in mm", read: |d, _| number(d.geometry.tools.active.radius_mm) },
    Row { name: &["G", "WZR"], meaning: "radius of the active tool in mm (older name)", read: |d, _| number(d.geometry.tools.active.radius_mm) },
    Row { name: &["G", "WZL"], meaning: "length of the active tool in mm (older name)", read: |d, _| number(d.geometry.tools.active.length_mm) },
    Row { name: &["G", "WZ_AKT", "L"], meaning: "length of the active tool in mm", read: |d, _| number(d.geometry.tools.active.length_mm) },
    Row { name: &["G", "WZ_AKT", "V", "*"], meaning: "offset of the active tool along an axis", read: |d, p| { let a = p.axis(d, 3)?; number(offset(&d.geometry.tools.active, a)) } },
    Row { name: &["G", "WZ_AKT", "P"], meaning: "parameter i of the active tool", read: |d, p| { let i = p.index(d, 2, 1000)?; number(parameter(&d.geometry.tools.active, i)) } },
    Row { name: &["G", "WZ", "R"], meaning: "radius of tool i in mm", read: |d, p| number(p.tool(d)?.radius_mm) },
    Row { name: &["G", "WZ", "L"], meaning: "length of tool i in mm", read: |d, p| number(p.tool(d)?.length_mm) },
    Row { name: &["G", "WZ", "V", "*"], meaning: "offset of tool i along an axis", read: |d, p| { let a = p.axis(d, 3)?; number(offset(&p.tool(d)?, a)) } },
    Row { name: &["G", "WZ", "P"], meaning: "parameter of tool i", read: |d, p| { let i = p.index(d, 2, 1000)?; number(parameter(&p.tool(d)?, i)) } },
    Row { name: &["G", "WZ", "OK"], meaning: "1 if tool i may be used", read: |d, p| { let i = p.index(d, 1, u32::MAX)?; truth(d.geometry.tools.table.get(&i).is_some_and(|t| t.is_valid)) } },
    Row { name: &["G", "WZ", "TYPE"], meaning: "type of tool i (P-TOOL-00001)", read: |d, p| number(f64::from(p.tool(d)?.kind as u32)) },
    Row { name: &["G", "WZ_AKT", "TYPE"], meaning: "type of the active tool (P-TOOL-00001)", read: |d, _| number(f64::from(d.geometry.tools.active.kind as u32)) },
    Row { name: &["G", "WZ", "SPDL_AX_NR"], meaning: "logical number of the spindle to which the dynamic limits of tool i apply", read: |d, p| number(f64::from(p.tool(d)?.spindle)) },
    Row { name: &["G", "WZ_AKT", "SPDL_AX_NR"], meaning: "logical number of the spindle to which the dynamic limits of the active tool apply", read: |d, _| number(f64::from(d.geometry.tools.active.spindle)) },
    Row { name: &["G", "WZ", "ME"], meaning: "unit of the data of tool i; here 0 (mm)", read: |_, _| number(0.0) },
    Row { name: &["G", "WZ_AKT", "WEAR_CONST"], meaning: "wear per distance of the active grinding tool in 0.1 um/m", read: |d, _| number(wear_constant(d)) },
    Row { name: &["G", "OTC_ACTIVE"], meaning: "1 while online tool compensation is on", read: |d, _| truth(d.motion.wear.on) },
    Row { name: &["G", "MAX_NC_BLOCKS_AHEAD"], meaning: "limit of the NC blocks read ahead", read: |d, _| number(d.calls.blocks_ahead[0]) },
    Row { name: &["G", "MAX_MOTION_BLOCKS_AHEAD"], meaning: "limit of the motion blocks read ahead", read: |d, _| number(d.calls.blocks_ahead[1]) },
    Row { name: &["G", "T_AKT"], meaning: "T word in force", read: |d, _| number(f64::from(d.geometry.tools.tool)) },
    Row { name: &["G", "D_AKT"], meaning: "D word in force", read: |d, _| number(f64::from(d.geometry.tools.data)) },
    Row { name: &["G", "TIMER"], meaning: "stored time of timer i in ms (#TIMER)", read: |d, p| { let i = p.index(d, 1, 127)?; number(d.live.latched_ms(i)) } },
    Row { name: &["G", "RANDOM"], meaning: "a random number; here always 0.5, so that runs repeat", read: |_, _| number(0.5) },
    Row { name: &["G", "MAIN_FILE_NAME"], meaning: "file of the main program", read: |d, _| text(&d.calls.info.main_file) },
    Row { name: &["G", "MAIN_PROG_NAME"], meaning: "name of the main program", read: |d, _| text(&d.calls.info.main_program) },
    Row { name: &["G", "FILE_NAME"], meaning: "file of the current program", read: |d, _| text(&d.calls.info.file) },
    Row { name: &["G", "PROG_NAME"], meaning: "name of the current program or subroutine", read: |d, _| text(&d.calls.info.program) },
    Row { name: &["G", "PROG_NR"], meaning: "number of the program; here 0", read: |_, _| number(0.0) },
    Row { name: &["G", "PROG_LEVEL"], meaning: "level of calls, 1 for the main program", read: |d, _| number(f64::from(d.calls.info.level)) },
    Row { name: &["G", "FILE_OFFSET"], meaning: "position of the current block in its file in bytes", read: |d, _| number(d.calls.info.offset as f64) },
    Row { name: &["G", "@P", "VALID"], meaning: "1 if parameter @Pi was passed to the cycle", read: |d, p| p.passed(d) },
    Row { name: &["G", "CNC_VERSION", "MAJOR"], meaning: "first part of the version number of the control", read: |_, _| number(3.0) },
    Row { name: &["G", "CNC_VERSION", "MINOR"], meaning: "second part of the version number of the control", read: |_, _| number(1.0) },
    Row { name: &["G", "CNC_VERSION", "BUILD"], meaning: "third part of the version number of the control", read: |_, _| number(3079.0) },
    Row { name: &["G", "CNC_VERSION", "PATCH"], meaning: "fourth part of the version number of the control", read: |_, _| number(0.0) },
    Row { name: &["G", "ROT_ACTIVE"], meaning: "1 while contour rotation is on", read: |d, _| truth(d.geometry.coordinates.rotation().is_some()) },
    Row { name: &["G", "ROT_ANGLE"], meaning: "angle of contour rotation in deg", read: |d, _| number(d.geometry.coordinates.rotation().map_or(0.0, |r| r.deg)) },
    Row { name: &["G", "ROT_CENTER1"], meaning: "centre of contour rotation along the first main axis", read: |d, _| number(d.geometry.coordinates.rotation().map_or(0.0, |r| r.centre[0]) / d.modal.unit_mm()) },
    Row { name: &["G", "ROT_CENTER2"], meaning: "centre of contour rotation along the second main axis", read: |d, _| number(d.geometry.coordinates.rotation().map_or(0.0, |r| r.centre[1]) / d.modal.unit_mm()) },
    Row { name: &["G", "CS_ACTIVE"], meaning: "1 while a coordinate system is on", read: |d, _| truth(d.geometry.coordinates.systems() > 0) },
    Row { name: &["G", "CS_COUNT"], meaning: "number of coordinate systems that are on", read: |d, _| number(d.geometry.coordinates.systems() as f64) },
    Row { name: &["SPDL_PROG", "SPEED", "s"], meaning: "programmed speed of a spindle in rev/min", read: |d, p| { let i = p.spindle(d, 2)?; number(d.motion.spindles[i].rpm) } },
    Row { name: &["SPDL_PROG", "MOVE_CMD", "s"], meaning: "M function of a spindle in force: 3, 4, 5 or 19", read: |d, p| { let i = p.spindle(d, 2)?; number(f64::from(d.motion.spindles[i].turning.number())) } },
    Row { name: &["SPDL_PROG", "POSITION", "s"], meaning: "programmed position of a spindle in deg", read: |d, p| { let i = p.spindle(d, 2)?; number(d.motion.spindles[i].angle_deg) } },
    Row { name: &["SPDL_PROG", "MAX_SPEED", "s"], meaning: "maximum speed under G96 in rev/min (G196)", read: |d, p| p.of_main_spindle(d, d.motion.cutting.most_rpm()) },
    Row { name: &["SPDL_PROG", "CONST_CUT_SPEED", "s"], meaning: "cutting speed of G96 in m/min", read: |d, p| p.of_main_spindle(d, d.motion.cutting.speed_m_min()) },
    Row { name: &["SPDL_PROG", "DWELL_ROT_COUNT", "s"], meaning: "revolutions of the last G04 with S", read: |d, p| p.of_main_spindle(d, d.motion.dwell_revolutions) },
    Row { name: &["SPDL", "PLC_CONTROL", "s"], meaning: "1 while the PLC moves the spindle; here 0", read: |d, p| { p.spindle(d, 2)?; truth(false) } },
    Row { name: &["SPDL", "NBR_IN_CHANNEL"], meaning: "number of spindles of the channel", read: |d, _| number(d.machine.spindles.len() as f64) },
    Row { name: &["SPDL", "M_FCT_FREE"], meaning: "1 if M functions of the spindle are free; here 0", read: |_, _| truth(false) },
    Row { name: &["SPDL", "LOG_AX_NR", "s"], meaning: "logical number of a spindle", read: |d, p| {
        let i = p.spindle(d, 2)?;
        number(d.motion.spindles[i].index.map_or(0.0, |i| f64::from(d.machine.spindles[i].number())))
    } },
];

/// Axis compensations: 0, with a check of the axis.
fn not_compensated(d: &Decoder, p: &Path<'_>) -> Outcome<Value> {
    p.axis(d, 2)?;
    truth(false)
}

fn limit(software_limits_mm: Option<(f64, f64)>) -> (f64, f64) {
    software_limits_mm.unwrap_or((-1e9, 1e9))
}

fn offset(tool: &Tool, axis: usize) -> f64 {
    tool.offsets_mm.get(&axis).copied().unwrap_or(0.0)
}

/// Wear constant of the tool in use by distance, in 0.1 um/m, as written.
fn wear_constant(d: &Decoder) -> f64 {
    (d.geometry.tools.active.wear_ratio / WEAR_UNIT * 1e9).round() / 1e9
}

fn parameter(tool: &Tool, index: u32) -> f64 {
    tool.parameters.get(&index).copied().unwrap_or(0.0)
}

/// Centre of the last arc along a main axis, as I, J and K give it.
///
/// Assumption: the page (207916683) calls it the coordinate of the circular programming, so it is absolute for arcs under G161.
fn centre(d: &Decoder, main: usize) -> Outcome<Value> {
    let place = d.geometry.last_arc.plane.iter().position(|m| *m == main);
    number(place.map_or(0.0, |k| d.geometry.last_arc.programmed_mm[k]) / d.modal.unit_mm())
}
