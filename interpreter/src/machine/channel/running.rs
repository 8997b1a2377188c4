//! Parameters that act while the axes move: overrides, threads, measuring and edge banding.

use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use kontur_motion::realtime::OverrideMode;

/// Override of G00 (P-CHAN-00181).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(crate) enum RapidOverride {
    /// One override for G00 and feed.
    #[default]
    NotUsed,
    /// The smaller of the two.
    Minimum,
    /// A separate override for G00.
    Active,
}

/// Overrides and feedhold.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OverrideEntries {
    /// The velocity that the override multiplies (P-CHAN-00066).
    pub(crate) mode: OverrideMode,
    /// Override in G00 (P-CHAN-00181).
    pub(crate) rapid: RapidOverride,
    /// Largest ratio of the external override (P-CHAN-00056), if the list states it.
    ///
    /// Assumption: without an entry nothing is limited, although the vendor's default is 1: the inputs of a run may
    /// contain an override above 100 %, and a message names the default.
    pub(crate) most: Option<f64>,
    /// Feedhold uses separate parameters (P-CHAN-00097).
    pub(crate) own_feed_hold: bool,
}

impl OverrideEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            mode: match p.get(of::OVERRIDE_MODE) {
                0 => OverrideMode::OfReached,
                1 => OverrideMode::OfProgrammed,
                _ => OverrideMode::OfProgrammedWhileReduced,
            },
            rapid: match p.get(of::RAPID_OVERRIDE) {
                0 => RapidOverride::NotUsed,
                1 => RapidOverride::Minimum,
                _ => RapidOverride::Active,
            },
            most: p.set_by(of::MOST_OVERRIDE).map(|_| p.get(of::MOST_OVERRIDE)),
            own_feed_hold: p.get(of::OWN_FEEDHOLD),
        }
    }
}

/// G33.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ThreadEntries {
    /// The override has no effect on G33 (P-CHAN-00836).
    pub(crate) ignore_override: bool,
    /// Consecutive blocks of G33 are one thread (P-CHAN-00837).
    pub(crate) chain: bool,
}

impl ThreadEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self { ignore_override: p.get(of::THREAD_IGNORES_OVERRIDE), chain: p.get(of::THREAD_CHAIN) }
    }
}

/// Measuring runs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MeasuringEntries {
    /// Measuring type at program start, 1 to 7 (P-CHAN-00057).
    pub(crate) kind: u32,
    /// Measuring type 1: a run without a probe signal is an error (P-CHAN-00176).
    pub(crate) missing_signal_is_error: bool,
    /// Runs have the dynamics of feed blocks instead of rapid ones (P-CHAN-00296).
    pub(crate) as_feed: bool,
    /// The probe signal brakes with the deceleration of rapid blocks instead of that of a feedhold (P-CHAN-00214).
    pub(crate) brakes_as_rapid: bool,
}

impl MeasuringEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            kind: p.get(of::MEASURING_TYPE),
            missing_signal_is_error: p.get(of::MISSING_SIGNAL_IS_ERROR),
            as_feed: p.get(of::MEASURES_AS_FEED),
            brakes_as_rapid: p.get(of::PROBE_BRAKING) == 1,
        }
    }
}

/// Edge banding.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BandingEntries {
    /// Way after the signal in edge banding in mm (P-CHAN-00030).
    pub(crate) residual_path_mm: f64,
    /// Edge banding extends over several blocks (P-CHAN-00029).
    pub(crate) over_blocks: bool,
    /// Edge banding skips the rest of the block after its M function (P-CHAN-00149).
    pub(crate) rejects_rest: bool,
}

impl BandingEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            residual_path_mm: p.get(of::RESIDUAL_PATH),
            over_blocks: p.get(of::BANDING_OVER_BLOCKS),
            rejects_rest: p.get(of::BANDING_REJECTS_REST),
        }
    }
}

/// What waits for independent axes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct IndependentEntries {
    /// The path waits for all independent axes in a block, not only for those that it moves (P-CHAN-00451).
    pub(crate) joins_named: bool,
    /// `#WAIT INDP` waits for the windows of all axes (P-CHAN-00297 = 2).
    pub(crate) joins_in_windows: bool,
    /// G60 and G360 also wait for independent axes (P-CHAN-00297 = 1).
    pub(crate) stops_join: bool,
}

impl IndependentEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            joins_named: p.get(of::JOINS_NAMED) == 1,
            joins_in_windows: p.get(of::INDEPENDENT_STOP) == 2,
            stops_join: p.get(of::INDEPENDENT_STOP) == 1,
        }
    }
}
