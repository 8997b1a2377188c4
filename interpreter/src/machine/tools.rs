//! Tool data and zero offsets in the lists of a channel.
//!
//! Source: TF5200 tool data (P-TOOL), TF5200 zero offsets (P-ZERO); start-up list P-STUP-00010, P-STUP-00011.

use super::parameters::{Parameters, Setting};
use super::table::{Indices, tool, with_indices, zero};
use super::value::Value;
use crate::diag::{Condition, Diagnostic};
use std::collections::{BTreeMap, BTreeSet};

/// mm in one inch.
pub(crate) const INCH_MM: f64 = 25.4;

/// Purpose of a tool (P-TOOL-00001).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum ToolKind {
    /// 0.
    #[default]
    Milling,
    /// 1.
    Turning,
    /// 2.
    Grinding,
    /// 3, the wire of an erosion machine.
    Wire,
}

impl ToolKind {
    /// Name in messages.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Milling => "milling",
            Self::Turning => "turning",
            Self::Grinding => "grinding",
            Self::Wire => "wire",
        }
    }
}

/// Limits that a tool sets for its spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SpindleLimits {
    /// Lowest speed in deg/s while it turns (P-TOOL-00013).
    pub(crate) min_deg_s: f64,
    /// Largest speed in deg/s (P-TOOL-00014).
    pub(crate) max_deg_s: f64,
    /// Largest acceleration in deg/s2 (P-TOOL-00015).
    pub(crate) acc_deg_s2: f64,
}

impl Default for SpindleLimits {
    /// The limits of a list without entries.
    fn default() -> Self {
        Self { min_deg_s: 0.0, max_deg_s: 0.001, acc_deg_s2: 1.0 }
    }
}

/// One tool.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tool {
    /// P-TOOL-00004 in mm.
    pub(crate) radius_mm: f64,
    /// P-TOOL-00003 in mm.
    pub(crate) length_mm: f64,
    /// Offsets by the index of the axis in the channel, in mm or deg (P-TOOL-00006).
    pub(crate) offsets_mm: BTreeMap<usize, f64>,
    /// The offsets belong to the machine axes in a coordinate system, too (P-TOOL-00010).
    pub(crate) is_fixed: bool,
    /// Free parameters (P-TOOL-00007).
    pub(crate) parameters: BTreeMap<u32, f64>,
    /// P-TOOL-00005; data written by a program are valid.
    pub(crate) is_valid: bool,
    /// Logical number of the spindle that the tool limits (P-TOOL-00012), 0: none.
    pub(crate) spindle: u32,
    /// Limits for this spindle.
    pub(crate) limits: SpindleLimits,
    /// P-TOOL-00001.
    pub(crate) kind: ToolKind,
    /// Wear of a grinding wheel in mm per mm of way (P-TOOL-00030).
    pub(crate) wear_ratio: f64,
    /// Largest external wear in mm (P-TOOL-00031).
    pub(crate) most_infeed_mm: f64,
    /// Angle between the axis of a grinding wheel and the third main axis in deg (P-TOOL-00138).
    pub(crate) tilt_deg: f64,
}

impl Default for Tool {
    fn default() -> Self {
        Self {
            radius_mm: 0.0,
            length_mm: 0.0,
            offsets_mm: BTreeMap::new(),
            is_fixed: false,
            parameters: BTreeMap::new(),
            is_valid: true,
            spindle: 0,
            limits: SpindleLimits::default(),
            kind: ToolKind::Milling,
            wear_ratio: 0.0,
            most_infeed_mm: 0.0,
            tilt_deg: 0.0,
        }
    }
}

/// Zero offsets of a channel.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ZeroOffsets {
    /// mm or deg by group and index of the axis in the channel (P-ZERO-00003).
    pub(crate) entries: BTreeMap<(u32, usize), f64>,
    /// Entries that their group does not include at program start (P-ZERO-00004).
    pub(crate) excluded: BTreeSet<(u32, usize)>,
    /// Group that is active at program start (P-ZERO-00002).
    pub(crate) start_group: u32,
    /// G53 has the offsets of group 0 (P-ZERO-00001); otherwise it cancels the offsets.
    pub(crate) has_g53: bool,
}

/// K-0075 for an offset of an axis that the channel does not have, unless it is 0. The vendor's lists have entries for
/// 32 axes.
fn unused(setting: &Setting, [i, j]: Indices, axes: usize) -> Option<Diagnostic> {
    if setting.value == Value::Number(0.0) {
        return None;
    }
    let key = with_indices(setting.row.key, [i, j]);
    let text = format!("{key}: the channel has only {axes} axes, no effect");
    let hint = "the second index is the index of the axis in the channel list, from 0";
    let mut about = Diagnostic::new(Condition::ListNoEffect, text).hint(hint);
    about.source.clone_from(&setting.at);
    Some(about)
}

/// Tools of a list by the number of the D word. D0 is not a tool; its entries are ignored. `axes`: number of axes in
/// the channel.
pub(super) fn tools(
    list: &Parameters,
    axes: usize,
    diagnostics: &mut Vec<Diagnostic>,
) -> BTreeMap<u32, Tool> {
    let mut tools = BTreeMap::new();
    for (indices, setting) in list.settings() {
        let [i, j] = indices;
        if i == 0 {
            continue;
        }
        let known: &mut Tool = tools.entry(i).or_insert_with(|| tool_of(list, i));
        let scale = scale(list, i);
        if setting.row.key == tool::OFFSET.place().row.key {
            if j as usize >= axes {
                diagnostics.extend(unused(setting, indices, axes));
                continue;
            }
            known.offsets_mm.insert(j as usize, list.get(tool::OFFSET.at(i).and(j)) * scale);
        } else if setting.row.key == tool::PARAMETER.place().row.key {
            known.parameters.insert(j, list.get(tool::PARAMETER.at(i).and(j)));
        }
    }
    tools
}

fn tool_of(list: &Parameters, i: u32) -> Tool {
    let scale = scale(list, i);
    Tool {
        radius_mm: list.get(tool::RADIUS.at(i)) * scale,
        length_mm: list.get(tool::LENGTH.at(i)) * scale,
        is_fixed: list.get(tool::FIXED.at(i)),
        is_valid: list.get(tool::VALID.at(i)),
        kind: match list.get(tool::KIND.at(i)) {
            1 => ToolKind::Turning,
            2 => ToolKind::Grinding,
            3 => ToolKind::Wire,
            _ => ToolKind::Milling,
        },
        spindle: list.get(tool::SPINDLE.at(i)),
        limits: SpindleLimits {
            // the list is in 0.001 deg/s
            min_deg_s: list.get(tool::SPINDLE_MIN.at(i)) / 1e3,
            max_deg_s: list.get(tool::SPINDLE_MAX.at(i)) / 1e3,
            acc_deg_s2: list.get(tool::SPINDLE_ACC.at(i)),
        },
        // the list is in 0.1 um per metre
        wear_ratio: list.get(tool::WEAR.at(i)) * 1e-7,
        most_infeed_mm: list.get(tool::INFEED.at(i)).abs(),
        // the list is in 0.0001 deg
        tilt_deg: list.get(tool::TILT.at(i)) / 1e4,
        ..Tool::default()
    }
}

/// mm per unit of the tool's lengths, which the list gives in steps of 0.0001.
fn scale(list: &Parameters, i: u32) -> f64 {
    if list.get(tool::INCH.at(i)) { INCH_MM } else { 1.0 }
}

/// Zero offsets of a list. `axes`: number of axes in the channel.
pub(super) fn zero_offsets(
    list: &Parameters,
    axes: usize,
    diagnostics: &mut Vec<Diagnostic>,
) -> ZeroOffsets {
    let [offset, exclusion] =
        [zero::OFFSET.place(), zero::EXCLUDED.place()].map(|place| place.row.key);
    let (mut entries, mut excluded) = (BTreeMap::new(), BTreeSet::new());
    for ([i, j], setting) in list.settings() {
        let key = setting.row.key;
        if key != offset && key != exclusion {
            continue;
        }
        if j as usize >= axes {
            diagnostics.extend(unused(setting, [i, j], axes));
        } else if key == offset {
            entries.insert((i, j as usize), list.get(zero::OFFSET.at(i).and(j)));
        } else if list.get(zero::EXCLUDED.at(i).and(j)) {
            excluded.insert((i, j as usize));
        }
    }
    ZeroOffsets {
        entries,
        excluded,
        start_group: list.get(zero::DEFAULT_GROUP),
        has_g53: list.get(zero::G53_IN_USE),
    }
}
