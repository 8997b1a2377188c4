//! Entries of a channel list on M, H, S and T functions: when the path waits for them, and for how long.

use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use crate::machine::table::param::{Optional, Param, whole};
use std::collections::{BTreeMap, BTreeSet};

/// Number of spindles in a channel list.
const SPINDLES: u32 = 16;

/// Position relative to the motion of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SpindleMoment {
    /// Before it.
    BeforeMotion,
    /// After it.
    AfterMotion,
}

/// The time by which a function has to be acknowledged.
///
/// Source: TF5200 M and H functions 285997195, 286004619; P-CHAN-00041.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Acknowledged {
    /// NO_SYNCH, MOS and purely informative kinds: the path does not wait.
    Never,
    /// MVS_SVS: before the motion of the block.
    BeforeMotion,
    /// The kinds whose place is not simulated (MVS_SLM, MVS_SLP, MEP_SVS, MET_SVS, MNE_SNS without edge banding): as before the
    /// motion, with a note. Name of the kind, and where the control waits.
    Elsewhere(&'static str, &'static str),
    /// MVS_SNS: called before the motion of the block; the path waits at its end for the remaining time.
    DuringMotion,
    /// MNS_SNS: called after the motion.
    AfterMotion,
}

impl Acknowledged {
    fn of(bits: u32) -> Self {
        let is = |kind: u32| bits & kind != 0;
        if is(of::BEFORE_MOTION) {
            Self::BeforeMotion
        } else if is(of::DURING_MOTION) {
            Self::DuringMotion
        } else if is(of::BEHIND_MOTION) {
            Self::AfterMotion
        } else {
            let kind = of::ELSEWHERE.into_iter().find(|(kind, _, _)| is(*kind));
            kind.map_or(Self::Never, |(_, name, place)| Self::Elsewhere(name, place))
        }
    }
}

/// When the functions of a spindle are executed and whether the path waits until speed, standstill or position is
/// reached; `None` where the list does not state it.
///
/// Source: TF5200 channel parameters, spindle synchronisation (149163787, 287516299); M and H functions 286059787.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SpindleWaits {
    /// M03 (P-CHAN-00045).
    pub(crate) m3: Option<Acknowledged>,
    /// M04 (P-CHAN-00047).
    pub(crate) m4: Option<Acknowledged>,
    /// M05 (P-CHAN-00049).
    pub(crate) m5: Option<Acknowledged>,
    /// M19 (P-CHAN-00043).
    pub(crate) m19: Option<Acknowledged>,
    /// S word (P-CHAN-00081).
    pub(crate) speed: Option<Acknowledged>,
}

impl SpindleWaits {
    fn of(parameters: &Parameters, spindle: u32) -> Self {
        let moment = |array: Param<Optional>| {
            let bits = parameters.get(array.at(spindle)).and_then(whole)?;
            let known = of::BEFORE_MOTION | of::DURING_MOTION | of::BEHIND_MOTION;
            // kinds whose place is not simulated are not waited for
            Some(Acknowledged::of(bits & known))
        };
        Self {
            m3: moment(of::SPINDLE_M3_SYNCHRONISATION),
            m4: moment(of::SPINDLE_M4_SYNCHRONISATION),
            m5: moment(of::SPINDLE_M5_SYNCHRONISATION),
            m19: moment(of::SPINDLE_M19_SYNCHRONISATION),
            speed: moment(of::SPINDLE_SPEED_SYNCHRONISATION),
        }
    }

    /// The entry of the list for an M function.
    pub(crate) fn of_m(self, number: u32) -> Option<Acknowledged> {
        match number {
            3 => self.m3,
            4 => self.m4,
            5 => self.m5,
            _ => self.m19,
        }
    }
}

/// Durations of the functions of a spindle in s, where the list states them above 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SpindleDurations {
    /// M03 (P-CHAN-00044).
    pub(crate) m3: Option<f64>,
    /// M04 (P-CHAN-00046).
    pub(crate) m4: Option<f64>,
    /// M05 (P-CHAN-00048).
    pub(crate) m5: Option<f64>,
    /// M19 (P-CHAN-00042).
    pub(crate) m19: Option<f64>,
    /// S word (P-CHAN-00080).
    pub(crate) speed: Option<f64>,
}

impl SpindleDurations {
    fn of(parameters: &Parameters, spindle: u32) -> Self {
        let declared = |array: Param<Optional>| {
            parameters.get(array.at(spindle)).filter(|duration_s| *duration_s > 0.0)
        };
        Self {
            m3: declared(of::SPINDLE_M3_DURATION),
            m4: declared(of::SPINDLE_M4_DURATION),
            m5: declared(of::SPINDLE_M5_DURATION),
            m19: declared(of::SPINDLE_M19_DURATION),
            speed: declared(of::SPINDLE_SPEED_DURATION),
        }
    }
}

/// M and H functions and those of the spindles.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FunctionEntries {
    /// Durations of M functions in s (P-CHAN-00040).
    pub(crate) m_durations_s: BTreeMap<u32, f64>,
    /// Durations of H functions in s (P-CHAN-00026).
    pub(crate) h_durations_s: BTreeMap<u32, f64>,
    /// Duration of a tool request in s (P-CHAN-00072).
    pub(crate) tool_duration_s: Option<f64>,
    /// Axes and spindles to which M functions go (P-CHAN-00039).
    pub(crate) m_outputs: BTreeMap<u32, Box<str>>,
    /// When the path waits for M functions, where the list says so (P-CHAN-00041).
    pub(crate) m_waits: BTreeMap<u32, Acknowledged>,
    /// When the path waits for H functions, if the list states it (P-CHAN-00027).
    pub(crate) h_waits: BTreeMap<u32, Acknowledged>,
    /// M functions that wait for the signal of edge banding (P-CHAN-00041 with MNE_SNS).
    pub(crate) m_at_signal: BTreeSet<u32>,
    /// Durations of the functions of each spindle in s, in the order of the list.
    pub(crate) spindle_durations_s: Vec<SpindleDurations>,
    /// The functions of each spindle for which the path waits, in the order of the list.
    pub(crate) spindle_waits: Vec<SpindleWaits>,
    /// M function of the main spindle at program start: 3 or 4, otherwise it is at rest (P-CHAN-00064).
    pub(crate) spindle_at_start: u32,
}

impl FunctionEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        let waits = |array: Param<Optional>| -> BTreeMap<u32, Acknowledged> {
            p.array(array)
                .filter_map(|(i, bits)| Some((i, Acknowledged::of(whole(bits)?))))
                .collect()
        };
        Self {
            spindle_at_start: p.get(of::M_GROUP),
            m_durations_s: p.array(of::M_DURATION).collect(),
            h_durations_s: p.array(of::H_DURATION).collect(),
            tool_duration_s: p.get(of::TOOL_DURATION),
            m_outputs: p
                .array(of::M_OUTPUT)
                .filter(|(_, name)| !name.is_empty())
                .map(|(m, name)| (m, name.into()))
                .collect(),
            m_waits: waits(of::M_SYNCHRONISATION),
            h_waits: waits(of::H_SYNCHRONISATION),
            m_at_signal: p
                .array(of::M_SYNCHRONISATION)
                .filter_map(|(m, kind)| (whole(kind)? & of::AT_SIGNAL != 0).then_some(m))
                .collect(),
            spindle_durations_s: (0..SPINDLES).map(|i| SpindleDurations::of(p, i)).collect(),
            spindle_waits: (0..SPINDLES).map(|i| SpindleWaits::of(p, i)).collect(),
        }
    }
}

/// The spindles.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SpindleEntries {
    /// Logical number of the main spindle (P-CHAN-00051), `None`: the first one.
    pub(crate) main: Option<u32>,
    /// Name that addresses the main spindle in the NC program (P-CHAN-00053).
    pub(crate) main_name: String,
    /// Spindles that the PLC turns (P-CHAN-00069).
    pub(crate) of_plc: Vec<bool>,
}

impl SpindleEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            main: Some(p.get(of::MAIN_SPINDLE)).filter(|n| *n != 0),
            // a different first letter is replaced (20971)
            main_name: p
                .get(of::MAIN_SPINDLE_NAME)
                .filter(|name| name.starts_with(['S', 's']))
                .unwrap_or_else(|| "S".to_owned()),
            of_plc: (0..SPINDLES).map(|i| p.get(of::PLC_SPINDLE.at(i))).collect(),
        }
    }
}
