//! Words of a block: their units and start values, what may be repeated, offsets and tools.

use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use crate::machine::table::param::whole;
use std::collections::BTreeMap;

/// Words of a block and their start values.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "one switch per parameter of the list")]
pub(crate) struct LanguageEntries {
    /// Programs start in inch (P-CHAN-00054).
    pub(crate) inch: bool,
    /// Tolerance words are inch under G70 (P-CHAN-00439).
    pub(crate) contouring_consider_inch: bool,
    /// Start values of G groups (P-CHAN-00063): group and G number; a preset of group 21 (feedforward) has no effect.
    pub(crate) g_groups: BTreeMap<u32, u32>,
    /// Implicit G60 after G00 (P-CHAN-00235).
    pub(crate) exact_stop_after_g00: bool,
    /// Several G90 and G91 in a block, each effective from its position on (P-CHAN-00116).
    pub(crate) several_dimensions: bool,
    /// Several words of an axis in a motion block (P-CHAN-00148, with P-CHAN-00116).
    pub(crate) several_words: bool,
    /// Absolute words of modulo axes always take the shortest way (P-CHAN-00346).
    pub(crate) shortest_way: bool,
    /// Chamfers and roundings are not available (P-CHAN-00273).
    pub(crate) no_chamfers: bool,
    /// I, J and K of arcs are modal (P-CHAN-00159).
    pub(crate) modal_centres: bool,
}

impl LanguageEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            inch: p.get(of::INCH),
            contouring_consider_inch: p.get(of::CONTOURING_INCH),
            g_groups: p
                .array(of::G_GROUP)
                .filter_map(|(group, g)| Some((group, whole(g)?)))
                .collect(),
            exact_stop_after_g00: p.get(of::EXACT_STOP_AFTER_G00),
            several_dimensions: p.get(of::SEVERAL_DIMENSIONS),
            several_words: p.get(of::SEVERAL_DIMENSIONS) && p.get(of::SEVERAL_WORDS),
            shortest_way: p.get(of::SHORTEST_WAY),
            no_chamfers: p.get(of::NO_CHAMFERS),
            modal_centres: p.get(of::MODAL_CENTRES),
        }
    }
}

/// Offsets, limits and tools that words select.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "one switch per parameter of the list")]
pub(crate) struct OffsetEntries {
    /// Offsets of axes that are not main axes belong to their coordinate system (P-CHAN-00397).
    pub(crate) in_systems: bool,
    /// The limits of the axis lists bound those of G98 and G99 (P-CHAN-00498).
    pub(crate) limits_bounded: bool,
    /// Offsets of a face turning axis are diameters (P-CHAN-00091).
    pub(crate) in_diameters: bool,
    /// The offsets of a tool are moved with its D word (P-CHAN-00100).
    pub(crate) tools_at_once: bool,
    /// T also selects the tool data of its number (P-CHAN-00014).
    pub(crate) tool_data_with_tool: bool,
    /// The channel is flushed before T (P-CHAN-00106).
    pub(crate) flush_before_tool: bool,
    /// The channel is flushed before D (P-CHAN-00271).
    pub(crate) flush_before_tool_data: bool,
}

impl OffsetEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            in_systems: p.get(of::OFFSETS_IN_SYSTEMS),
            limits_bounded: p.get(of::LIMITS_BOUNDED),
            in_diameters: p.get(of::OFFSETS_IN_DIAMETERS),
            tools_at_once: p.get(of::TOOL_OFFSETS_AT_ONCE),
            tool_data_with_tool: p.get(of::TOOL_DATA_WITH_TOOL),
            flush_before_tool: p.get(of::FLUSH_BEFORE_TOOL),
            flush_before_tool_data: p.get(of::FLUSH_OF_TOOL_DATA).as_deref() == Some("FAW_D"),
        }
    }
}
