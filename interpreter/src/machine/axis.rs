//! One axis of the machine: its parameters, and the planner's values derived from them.

mod dynamics;

use super::gears;
use super::inert;
use super::key::Key;
use super::kind::{AxisKind, logical_number, mode};
use super::parameters::Kind;
use super::parameters::{Parameters, Setting};
use super::plausible;
use super::table::param::{Number, Param, Place};
use super::table::{
    Indices, ListKind, axis_control, axis_drive, axis_filters, axis_functions, axis_general,
    misspelt,
};
use super::value;
use crate::diag::{AxisRef, Diagnostic, Location};
use kontur_filters::time::CycleTime;
use kontur_motion::realtime::OverrideRatios;

/// A path axis, a spindle or a gantry slave.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    name: String,
    number: u32,
    kind: AxisKind,
    parameters: Parameters,
    own: Parameters,
    /// Index of the gear stage in force.
    stage: u32,
    /// Computed when the parameters change, since every motion needs them.
    software_limits_mm: Option<(f64, f64)>,
}

impl Axis {
    pub(super) fn new(
        name: String,
        kind: AxisKind,
        parameters: Parameters,
        own: Parameters,
    ) -> Self {
        let number = logical_number(&parameters);
        let stage = gears::at_start(&parameters);
        let mut axis =
            Self { name, number, kind, parameters, own, stage, software_limits_mm: None };
        axis.software_limits_mm = axis.listed_software_limits_mm();
        axis
    }

    /// Name in the NC program (P-CHAN-00006, P-CHAN-00007).
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Logical axis number (P-AXIS-00016).
    pub fn number(&self) -> u32 {
        self.number
    }

    /// Unit of its positions: `mm` or `deg`.
    pub fn unit(&self) -> &'static str {
        if self.is_linear() { "mm" } else { "deg" }
    }

    /// Unit of its positions in the control: 0.1 um or 0.0001 deg.
    pub fn increment(&self) -> &'static str {
        if self.is_linear() { "0.1um" } else { "0.0001deg" }
    }

    /// Linear, rotary or spindle.
    pub fn kind(&self) -> AxisKind {
        self.kind
    }

    /// Whether its positions are in mm.
    #[inline]
    pub fn is_linear(&self) -> bool {
        self.kind == AxisKind::Linear
    }

    /// Whether the axis counts modulo its range, 360 degrees by default (P-AXIS-00015, bit 0x4).
    #[inline]
    pub fn is_modulo(&self) -> bool {
        !self.is_linear() && self.mode_bits() & mode::MODULO != 0
    }

    /// Range of a modulo axis in deg (P-AXIS-00126, P-AXIS-00127).
    pub(crate) fn modulo_deg(&self) -> f64 {
        let (lower, upper) = self.modulo_range_deg();
        upper - lower
    }

    /// The position within that range; that of an axis without one as it is.
    ///
    /// Source: P-AXIS-00015, bit 0x4 (TF5264 965899659): when the target is reached the position is reduced to the modulo range.
    pub(crate) fn in_modulo_range(&self, position: f64) -> f64 {
        if !self.is_modulo() {
            return position;
        }
        let (lower, upper) = self.modulo_range_deg();
        let reduced = lower + (position - lower).rem_euclid(upper - lower);
        // an angle just below a full revolution results from rounding
        if upper - reduced < 1e-9 { lower } else { reduced }
    }

    /// Lower and upper end of that range in deg.
    pub(crate) fn modulo_range_deg(&self) -> (f64, f64) {
        (self.get(axis_general::MODULO_LOWER), self.get(axis_general::MODULO_UPPER))
    }

    /// Whether its words may be diameters (P-AXIS-00015, bit 0x40).
    pub(crate) fn is_face_turning(&self) -> bool {
        self.mode_bits() & mode::FACE_TURNING != 0
    }

    /// The axis turns the workpiece under `#CYL` and `#FACE` (P-AXIS-00015, bit 0x200).
    pub(crate) fn is_c_axis(&self) -> bool {
        self.mode_bits() & mode::C_AXIS != 0
    }

    /// The axis is the master of a gantry (P-AXIS-00015, bit 0x10000).
    pub(crate) fn is_gantry_master(&self) -> bool {
        self.mode_bits() & mode::GANTRY_MASTER != 0
    }

    /// Mode of the axis in bits (P-AXIS-00015), see [`mode`].
    pub(crate) fn mode_bits(&self) -> u32 {
        self.get(axis_general::MODE)
    }

    /// Whether its words are diameters under G51, with G90 (P-AXIS-00058) or with G91 (P-AXIS-00059).
    pub(crate) fn takes_diameters(&self, absolute: bool) -> bool {
        let parameter = if absolute {
            axis_general::DIAMETER_ABSOLUTE
        } else {
            axis_general::DIAMETER_RELATIVE
        };
        self.get(parameter)
    }

    /// The part of an override of the channel that applies to independent motions of the axis (P-AXIS-00491): all of it
    /// up to 100 % (the interface of the axis stays at that value), or none; limited by P-AXIS-00109, by default 100 %.
    pub(crate) fn independent_ratios(&self, channel: OverrideRatios) -> OverrideRatios {
        let most = self.get(axis_general::MOST_OVERRIDE);
        let of = |ratio: f64| match self.get(axis_general::INDEPENDENT_OVERRIDE) {
            0 => ratio.min(most),
            1 => ratio.min(most).min(1.0),
            _ => 1.0,
        };
        OverrideRatios { feed: of(channel.feed), rapid: of(channel.rapid) }
    }

    /// Whether the feedhold of the channel holds independent motions of the axis (P-AXIS-00540).
    pub(crate) fn holds_independent(&self) -> bool {
        !self.get(axis_general::INDEPENDENT_FEEDHOLD)
    }

    /// Whether it takes part in measuring runs (P-AXIS-00118).
    pub fn measures(&self) -> bool {
        self.get(axis_general::MEASURES)
    }

    /// Whether it takes part in edge banding (P-AXIS-00098).
    pub(crate) fn bands(&self) -> bool {
        self.get(axis_general::BANDS)
    }

    /// Lag in mm (deg) from which on a measuring run of type 7 considers the axis to be at a fixed stop (P-AXIS-00330,
    /// and the first of P-AXIS-00774, 00769 and 00331 that is not negative); `None`: never.
    pub(crate) fn fixed_stop_lag_mm(&self) -> Option<f64> {
        let limits = [axis_general::STOP_LAG_OF_RUN, axis_general::STOP_LAG_OF_DRIVE];
        let limits = limits.into_iter().chain([axis_general::STOP_LAG]);
        let limit = limits.map(|param| self.get(param)).find(|limit| *limit >= 0.0)?;
        (self.get(axis_general::STOPS) && limit > 0.0).then_some(limit)
    }

    /// Speed of measuring runs of type 2 in mm/s (deg/s), P-AXIS-00215.
    pub(crate) fn measuring_speed_mm_s(&self) -> f64 {
        self.get(axis_general::MEASURING_SPEED)
    }

    /// Logical number of the gantry master (P-AXIS-00070), `None` if the axis is not a slave.
    pub fn gantry_master(&self) -> Option<u32> {
        Some(self.get(axis_general::GANTRY_MASTER)).filter(|n| *n != 0)
    }

    /// All parameters of the axis list.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Number of a key (`getriebe[0].kv`) in the units of the list; `None` for an unknown key, for a text, and for a
    /// parameter without default that no list states.
    ///
    /// For keys given by a user; the code itself reads a [`Param`].
    pub fn raw(&self, key: &str) -> Option<f64> {
        self.parameters.raw(key)?.number()
    }

    /// The value of a parameter of the axis list, or of this axis in `kontur.lis`, in mm (deg), s and ratios.
    pub(super) fn get<K: Kind>(&self, param: Param<K>) -> K::Value {
        match param.place().row.list {
            ListKind::Kontur => self.own.get(param.at(self.number)),
            ListKind::Axis
            | ListKind::Channel
            | ListKind::StartUp
            | ListKind::Tool
            | ListKind::Zero
            | ListKind::External => self.parameters.get(gears::param_of(self.stage, param)),
        }
    }

    /// A number in the units of the axis list.
    pub(super) fn listed(&self, param: impl Into<Place>) -> f64 {
        self.parameters.listed(self.place(param)).unwrap_or_default()
    }

    /// The place of a parameter in the list: that of the gear stage in force, if it is one of a stage.
    pub(super) fn place(&self, param: impl Into<Place>) -> Place {
        gears::of_stage(self.stage, param.into())
    }

    /// Changes to the gear stage with this number (G112); false if the list has none.
    pub(crate) fn change_gear(&mut self, number: u32) -> bool {
        let stage = gears::of_number(&self.parameters, number);
        self.stage = stage.unwrap_or(self.stage);
        stage.is_some()
    }

    /// Number of the gear stage in force.
    pub(crate) fn gear(&self) -> u32 {
        gears::number_of(&self.parameters, self.stage)
    }

    /// The setting of a parameter of the axis list or of this axis in `kontur.lis`, `None` if it is not set.
    pub(super) fn set_by(&self, param: impl Into<Place>) -> Option<&Setting> {
        let place = self.place(param);
        match place.row.list {
            ListKind::Kontur => self.own.set_by(place),
            _ => self.parameters.set_by(place),
        }
    }

    /// All settings of this axis in `kontur.lis`.
    pub(super) fn own_settings(&self) -> impl Iterator<Item = (Indices, &Setting)> {
        self.own.settings()
    }

    /// A number; `other` if it is 0.
    fn get_or(&self, param: Param<Number>, other: f64) -> f64 {
        let value = self.get(param);
        if value > 0.0 { value } else { other }
    }

    /// Whether a speed that the tool does not permit is an error (P-AXIS-00474).
    pub(crate) fn checks_tool_speed(&self) -> bool {
        self.get(axis_general::TOOL_SPEED_CHECKED)
    }

    /// Deviation from its speed, relative to it, within which a spindle has reached it (P-AXIS-00217).
    pub(crate) fn speed_band(&self) -> f64 {
        self.get(axis_functions::SPEED_BAND)
    }

    /// Whether the list configures any feedforward (P-AXIS-00223).
    pub(crate) fn has_feedforward(&self) -> bool {
        self.get(axis_drive::FEEDFORWARD) > 0
    }

    /// Gain of the position controller in 1/s (P-AXIS-00099).
    pub(crate) fn kv_1_s(&self) -> f64 {
        self.get(axis_control::GAIN)
    }

    /// Software limits in mm (P-AXIS-00177, P-AXIS-00178); `None` for spindles and modulo axes, and if they are off
    /// (P-AXIS-00705).
    pub(crate) fn software_limits_mm(&self) -> Option<(f64, f64)> {
        self.software_limits_mm
    }

    fn listed_software_limits_mm(&self) -> Option<(f64, f64)> {
        let off = self.get(axis_functions::LIMIT_CHECK).total_cmp(&0.0).is_eq();
        if self.kind == AxisKind::Spindle || self.is_modulo() || off {
            return None;
        }
        Some((self.get(axis_general::LOWER_LIMIT), self.get(axis_general::UPPER_LIMIT)))
    }

    /// Permitted range of the actual positions in mm for these software limits (P-AXIS-00179).
    pub(crate) fn actual_range_mm(&self, (low, high): (f64, f64)) -> (f64, f64) {
        let tolerance_mm = self.get(axis_general::LIMIT_TOLERANCE);
        (low - tolerance_mm, high + tolerance_mm)
    }

    /// Exact-stop window in mm (P-AXIS-00236).
    pub fn window_mm(&self) -> f64 {
        self.get(axis_control::WINDOW)
    }

    /// Whether a position outside the software limits is only a warning (P-AXIS-00554).
    pub(crate) fn software_limits_only_warn(&self) -> bool {
        self.get(axis_general::LIMIT_BEHAVIOUR).as_deref() == Some("WARNING")
    }

    /// Whether the additional interface accepts external positions (`lr_param.add_interface.enable`).
    pub(crate) fn has_additional_interface(&self) -> bool {
        self.get(axis_filters::ADDITIONAL_INTERFACE)
    }

    /// Difference of input and output below which the filters count as settled, in mm (P-AXIS-00351).
    pub fn filter_window_mm(&self) -> f64 {
        self.get(axis_filters::SETTLED_WINDOW)
    }

    /// Whether a parameter is fixed while a program runs: number, name, kind, drive and master of the axis.
    ///
    /// Assumption: neither the page on `#MACHINE DATA` [TF5200] nor the documentation of these parameters says which
    /// ones they are.
    pub(crate) fn is_read_at_start(key: &str) -> bool {
        const KEYS: [&str; 6] = [
            "kopf.",
            "kenngr.achs_typ",
            "kenngr.achs_mode",
            "kenngr.antr_typ",
            "kenngr.gantry_ax_nr",
            "kenngr.getriebe_stufe",
        ];
        KEYS.iter().any(|start| {
            key.get(..start.len()).is_some_and(|head| head.eq_ignore_ascii_case(start))
        })
    }

    /// Whether the table contains neither this key of an axis list nor a similar one.
    pub(crate) fn is_unknown(key: &str) -> bool {
        Key::parse(key).is_some_and(|key| {
            key.resolve(ListKind::Axis).is_none()
                && misspelt(Some(ListKind::Axis), &key.shape).is_empty()
        })
    }

    /// Overrides a value of the list, as `#MACHINE DATA` at the place `at` does; the executor owns the machine it
    /// changes. The ranges are those of the list. Returns the corrections that the new value causes.
    ///
    /// # Errors
    /// A description of the error in key or value; the axis is unchanged.
    pub(crate) fn change(
        &mut self,
        key: &str,
        value: &str,
        at: Option<Location>,
        cycle: CycleTime,
    ) -> Result<Vec<Diagnostic>, String> {
        let found = Key::parse(key).and_then(|k| k.resolve(ListKind::Axis));
        let (row, indices) =
            found.ok_or_else(|| format!("`{key}` is not a parameter of an axis"))?;
        let value = value::read(row.raw, value).map_err(|bad| format!("{key}: {}", bad.reason))?;
        let axis = AxisRef { number: self.number, name: self.name.clone() };
        let check = |parameters: &mut Parameters| {
            let mut found = Vec::new();
            plausible::check(parameters, cycle, Some(&axis), &mut found);
            inert::check(parameters, Some(&axis), &mut found);
            found
        };
        // a function that is off is found again, but was reported with the list
        let known = check(&mut self.parameters.clone());
        self.parameters.set(row, indices, value, at);
        let mut found = check(&mut self.parameters);
        found.retain(|diagnostic| !known.contains(diagnostic));
        self.software_limits_mm = self.listed_software_limits_mm();
        Ok(found)
    }
}
