//! The channel: start values of a program and limits of the path, grouped by the room that reads them.

pub(super) mod couplings;
pub(super) mod functions;
pub(super) mod language;
pub(super) mod path;
pub(super) mod programs;
pub(super) mod running;

use super::parameters::Parameters;
use super::table::{channel as of, channel_hsc};
use couplings::{DefaultCoupling, default_couplings};
use functions::{FunctionEntries, SpindleEntries};
use kontur_motion::block::SplineSettings;
use language::{LanguageEntries, OffsetEntries};
use path::{ArcCentre, FeedEntries, PathEntries, look_ahead, spline};
use programs::{MacroEntries, ProgramEntries, VariableEntries};
use running::{
    BandingEntries, IndependentEntries, MeasuringEntries, OverrideEntries, ThreadEntries,
};

/// Handling of a message to the diagnosis receiver (P-CHAN-00518).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(crate) enum DiagnosisMessages {
    /// It is written.
    #[default]
    Standard,
    /// It is discarded.
    Disabled,
    /// It is discarded with the warning 22194.
    Warning,
    /// It is discarded with the error 22195.
    Error,
}

/// The channel with its start values.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Words of a block.
    pub(crate) language: LanguageEntries,
    /// Offsets and tools.
    pub(crate) offsets: OffsetEntries,
    /// F words.
    pub(crate) feed: FeedEntries,
    /// Dynamics of the path.
    pub(crate) dynamics: PathEntries,
    /// Limits of arcs whose centre and end point do not match.
    pub(crate) arc_centre: ArcCentre,
    /// M and H functions and those of the spindles.
    pub(crate) functions: FunctionEntries,
    /// Spindles.
    pub(crate) spindles: SpindleEntries,
    /// Subroutines.
    pub(crate) programs: ProgramEntries,
    /// Macros.
    pub(crate) macros: MacroEntries,
    /// Variables of a program.
    pub(crate) variables: VariableEntries,
    /// Overrides and feedhold.
    pub(crate) overrides: OverrideEntries,
    /// G33.
    pub(crate) threads: ThreadEntries,
    /// Measuring runs.
    pub(crate) measuring: MeasuringEntries,
    /// Edge banding.
    pub(crate) banding: BandingEntries,
    /// What waits for independent axes.
    pub(crate) independent: IndependentEntries,
    /// Axes of the channel, one bit each, whose positions outside the software limits are a warning (P-CHAN-00147).
    pub(crate) limit_warnings: u32,
    /// Number of blocks in the look-ahead of the planner (P-CHAN-00650 and 00653, or P-STUP-00070 and 00071), 10 to 10 000; default
    /// 120.
    pub(crate) look_ahead_blocks: u32,
    /// Settings of `#HSC [BSPLINE]` at program start (P-CHAN-00122 to 00130).
    pub(crate) spline: SplineSettings,
    /// The feed of B-splines is that of the feed group instead of the main axes (P-CHAN-00240).
    pub(crate) spline_feed_of_group: bool,
    /// Shortest length and smallest radius in mm of a tool that D accepts (P-CHAN-00156, P-CHAN-00157); 0: any.
    pub(crate) least_tool_mm: [f64; 2],
    /// Messages to the diagnosis receiver (P-CHAN-00518).
    pub(crate) diagnosis_messages: DiagnosisMessages,
    /// Coupling group 0 as defined by the list (P-CHAN-00037, P-CHAN-00038).
    pub(crate) default_couplings: Vec<DefaultCoupling>,
    parameters: Parameters,
    start_up: Parameters,
}

impl Channel {
    /// `feed_axes`: the path axes that the list marks as members of the feed group.
    pub(super) fn new(parameters: Parameters, start_up: Parameters, feed_axes: Vec<bool>) -> Self {
        let p = &parameters;
        Self {
            language: LanguageEntries::of(p),
            offsets: OffsetEntries::of(p),
            feed: FeedEntries::of(p, feed_axes),
            dynamics: PathEntries::of(p),
            arc_centre: ArcCentre::of(p),
            functions: FunctionEntries::of(p),
            spindles: SpindleEntries::of(p),
            programs: ProgramEntries::of(p),
            macros: MacroEntries::of(p),
            variables: VariableEntries::of(p),
            overrides: OverrideEntries::of(p),
            threads: ThreadEntries::of(p),
            measuring: MeasuringEntries::of(p),
            banding: BandingEntries::of(p),
            independent: IndependentEntries::of(p),
            limit_warnings: p.get(of::LIMIT_WARNINGS),
            look_ahead_blocks: look_ahead(p, &start_up),
            spline: spline(p),
            spline_feed_of_group: p.get(channel_hsc::FEED_GROUP),
            least_tool_mm: [p.get(of::MIN_TOOL_LENGTH), p.get(of::MIN_TOOL_RADIUS)],
            diagnosis_messages: match p.get(of::DIAGNOSIS_MESSAGES).as_deref() {
                Some("DISABLED") => DiagnosisMessages::Disabled,
                Some("WARNING") => DiagnosisMessages::Warning,
                Some("ERROR") => DiagnosisMessages::Error,
                _ => DiagnosisMessages::Standard,
            },
            default_couplings: default_couplings(p).0,
            parameters,
            start_up,
        }
    }

    /// All parameters of the channel list.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// All parameters of the start-up list.
    pub fn start_up(&self) -> &Parameters {
        &self.start_up
    }
}
