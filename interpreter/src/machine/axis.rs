//! One axis of the machine: its parameters and what the planner makes of them.

use super::key::{Indices, Key};
use super::parameters::{Parameters, Setting};
use super::table::ListKind;
use super::value;
use kontur_motion::axis::{AxisDynamics, FeedSlope, FeedholdSlope, RapidSlope, StepSlope};

/// Kind of an axis (P-AXIS-00018).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisKind {
    /// Translatory: mm.
    Linear,
    /// Rotary: degrees.
    Rotary,
    /// Spindle: degrees, speed in rpm.
    Spindle,
}

/// A path axis, a spindle or a gantry slave.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    name: String,
    number: u32,
    kind: AxisKind,
    parameters: Parameters,
    own: Parameters,
    /// Worked out when the parameters change: every motion asks for them.
    software_limits_mm: Option<(f64, f64)>,
}

/// Gear stage that is used; the others are stored only.
const STAGE: &str = "getriebe[0]";

impl Axis {
    pub(super) fn new(
        name: String,
        kind: AxisKind,
        parameters: Parameters,
        own: Parameters,
    ) -> Self {
        let number = logical_number(&parameters);
        let mut axis = Self { name, number, kind, parameters, own, software_limits_mm: None };
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
        if self.kind == AxisKind::Linear { "mm" } else { "deg" }
    }

    /// Linear, rotary or spindle.
    pub fn kind(&self) -> AxisKind {
        self.kind
    }

    /// The axis counts modulo 360 degrees (P-AXIS-00015, bit 0x4).
    pub fn is_modulo(&self) -> bool {
        self.kind != AxisKind::Linear && self.mode_bits() & 0x4 != 0
    }

    /// Logical number of the gantry master (P-AXIS-00070), `None` if the axis is no slave.
    pub fn gantry_master(&self) -> Option<u32> {
        integer(self.raw("kenngr.gantry_ax_nr")).filter(|n| *n != 0)
    }

    fn mode_bits(&self) -> u32 {
        integer(self.raw("kenngr.achs_mode")).unwrap_or_default()
    }

    /// All parameters of the axis list.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Number of a key (`getriebe[0].kv`) in the units of the list; `None` for an unknown key, a text, and a
    /// parameter without default that no list names.
    pub fn raw(&self, key: &str) -> Option<f64> {
        self.parameters.number(key)
    }

    /// Number of a key in mm (deg), s and ratios.
    pub fn converted(&self, key: &str) -> Option<f64> {
        self.parameters.converted(key)
    }

    /// Text of a key.
    pub fn text(&self, key: &str) -> Option<String> {
        self.parameters.text(key)
    }

    /// Switch of a key: set and not 0.
    pub fn flag(&self, key: &str) -> bool {
        self.parameters.flag(key)
    }

    /// Number of a key of `kontur.lis` for this axis (`plant.ta_us` stands for `kontur.axis[n].plant.ta_us`), in mm
    /// (deg), s and ratios.
    pub fn own(&self, key: &str) -> Option<f64> {
        self.own.converted(&self.own_key(key))
    }

    /// Text of a key of `kontur.lis` for this axis.
    pub fn own_text(&self, key: &str) -> Option<String> {
        self.own.text(&self.own_key(key))
    }

    /// Everything that `kontur.lis` sets for this axis.
    pub(super) fn own_settings(&self) -> impl Iterator<Item = (Indices, &Setting)> {
        self.own.settings()
    }

    fn own_key(&self, key: &str) -> String {
        format!("kontur.axis[{}].{key}", self.number)
    }

    /// A number of gear stage 0 in mm (deg), s and ratios. Every key used has a default.
    fn stage(&self, key: &str) -> f64 {
        let value = self.converted(&format!("{STAGE}.{key}"));
        debug_assert!(value.is_some(), "{key} is no number with a default");
        value.unwrap_or_default()
    }

    /// As [`stage`](Self::stage), 0 stands for another value.
    fn stage_or(&self, key: &str, other: f64) -> f64 {
        let value = self.stage(key);
        if value > 0.0 { value } else { other }
    }

    /// Dynamic limits as the lists state them, weighted by 100 %.
    pub fn dynamics(&self) -> AxisDynamics {
        let a_max_mm_s2 = self.stage("dynamik.a_max");
        let step = |acc: [&str; 2], dec: [&str; 2], change: &str| {
            let acc_mm_s2 = acc.map(|key| self.stage(&format!("lslope_profil.{key}")));
            let dec = dec.map(|key| format!("lslope_profil.{key}"));
            StepSlope {
                acc_mm_s2,
                dec_mm_s2: [
                    self.stage_or(&dec[0], acc_mm_s2[0]),
                    self.stage_or(&dec[1], acc_mm_s2[1]),
                ],
                change_mm_s: self.stage(&format!("lslope_profil.{change}")),
            }
        };
        let rapid = RapidSlope {
            acc_mm_s2: self.stage("slope_profil.a_grenz"),
            ramp_s: self.stage("slope_profil.tr_grenz"),
        };
        let step_rapid = step(
            ["a_grenz_stufe_1", "a_grenz_stufe_2"],
            ["d_grenz_stufe_1", "d_grenz_stufe_2"],
            "vb_grenz_stufe_1_2",
        );
        let rapid_step = step_rapid.acc_mm_s2;
        AxisDynamics {
            v_max_mm_s: self.stage("dynamik.vb_max"),
            v_rapid_mm_s: self.stage("vb_eilgang"),
            a_max_mm_s2,
            a_emergency_mm_s2: self.stage_or("dynamik.a_emergency", a_max_mm_s2),
            tr_geom_s: self.stage("dynamik.tr_geom"),
            feed: FeedSlope {
                acc_mm_s2: self.stage("slope_profil.a_beschl"),
                dec_mm_s2: self.stage("slope_profil.a_brems"),
                ramps_s: ["tr_beschl_zu", "tr_beschl_ab", "tr_brems_zu", "tr_brems_ab"]
                    .map(|key| self.stage(&format!("slope_profil.{key}"))),
            },
            rapid,
            step_feed: step(["a_stufe_1", "a_stufe_2"], ["d_stufe_1", "d_stufe_2"], "vb_stufe_1_2"),
            step_rapid,
            feedhold: FeedholdSlope {
                step_dec_mm_s2: self
                    .stage_or("lslope_profil.a_feedh", rapid_step[0].min(rapid_step[1])),
                dec_mm_s2: self.stage_or("slope_profil.a_feedh", rapid.acc_mm_s2),
                ramp_s: self.stage_or("slope_profil.tr_feedh", rapid.ramp_s),
            },
            a_trans_ratio: self.stage("dynamik.a_trans_weight"),
            r_trans_ratio: self.stage("dynamik.r_trans_weight"),
            j_trans_kink_mm_s3: self.stage("dynamik.j_trans_c0"),
            j_trans_tangential_mm_s3: self.stage("dynamik.j_trans_c1"),
        }
    }

    /// Ceiling of accelerations under G130 and G131 in mm/s2 (P-AXIS-00292).
    ///
    /// Assumption: without an entry the ceiling is `a_max`; the table prints no default.
    pub fn a_w_max_mm_s2(&self) -> f64 {
        self.stage("dynamik.a_w_max")
    }

    /// Floor of ramp times under G132 and G133 in s: P-AXIS-00293, never below the shortest ramp time P-AXIS-00201.
    pub fn tr_w_min_s(&self) -> f64 {
        self.stage("dynamik.tr_w_min").max(self.tr_min_s())
    }

    /// Shortest ramp time in s (P-AXIS-00201): with `a_max` the jerk limit of the monitor.
    pub fn tr_min_s(&self) -> f64 {
        self.stage("dynamik.tr_min")
    }

    /// The list names something to feed forward (P-AXIS-00223).
    pub fn has_feedforward(&self) -> bool {
        self.raw("vorsteuer.vorsteuerung").is_some_and(|flags| flags > 0.0)
    }

    /// Gain of the position controller in 1/s (P-AXIS-00099).
    pub fn kv_1_s(&self) -> f64 {
        self.stage("kv")
    }

    /// Software limits in mm (P-AXIS-00177, P-AXIS-00178); `None` for spindles and modulo axes.
    pub fn software_limits_mm(&self) -> Option<(f64, f64)> {
        self.software_limits_mm
    }

    fn listed_software_limits_mm(&self) -> Option<(f64, f64)> {
        if self.kind == AxisKind::Spindle || self.is_modulo() {
            return None;
        }
        Some((self.converted("kenngr.swe_neg")?, self.converted("kenngr.swe_pos")?))
    }

    /// Exact-stop window in mm (P-AXIS-00236).
    pub fn window_mm(&self) -> f64 {
        self.stage("window")
    }

    /// Difference of input and output below which the filters count as settled, in mm (P-AXIS-00351).
    pub fn filter_window_mm(&self) -> f64 {
        self.converted("kenngr.filter_position_window").unwrap_or_default()
    }

    /// Puts a value over the list, as `#MACHINE DATA` does at run time.
    ///
    /// # Errors
    /// What is wrong with key or value; the axis is unchanged.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        let found = Key::parse(key).and_then(|k| k.resolve(ListKind::Axis));
        let (row, indices) = found.ok_or_else(|| format!("`{key}` is no parameter of an axis"))?;
        let value = value::read(row.raw, value).map_err(|bad| format!("{key}: {}", bad.reason))?;
        self.parameters.set(row, indices, value, None);
        self.software_limits_mm = self.listed_software_limits_mm();
        Ok(())
    }
}

/// Logical axis number of an axis list.
pub(super) fn logical_number(parameters: &Parameters) -> u32 {
    integer(parameters.number("kopf.achs_nr")).unwrap_or_default()
}

/// Kind of axis of an axis list.
pub(super) fn kind_of(parameters: &Parameters) -> AxisKind {
    match integer(parameters.number("kenngr.achs_typ")) {
        Some(2) => AxisKind::Rotary,
        Some(4) => AxisKind::Spindle,
        _ => AxisKind::Linear,
    }
}

/// A list number that is a whole number of the type UNS32.
pub(super) fn integer(x: Option<f64>) -> Option<u32> {
    x.filter(|x| (0.0..=f64::from(u32::MAX)).contains(x)).map(|x| x as u32)
}
