//! Entries of a channel list on M, H and S functions: when the path waits for them, and for how long.

use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use crate::machine::table::param::{Optional, Param, whole};

/// Position relative to the motion of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpindleMoment {
    /// Before it.
    BeforeMotion,
    /// After it.
    AfterMotion,
}

/// The time by which a function has to be acknowledged.
///
/// Source: TF5200 M and H functions 285997195, 286004619; P-CHAN-00041.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acknowledged {
    /// NO_SYNCH, MOS and purely informative kinds: the path does not wait.
    Never,
    /// MVS_SVS: before the motion of the block. Assumption: also the kinds whose place is not simulated (MVS_SLM,
    /// MVS_SLP, MEP_SVS, MET_SVS, MNE_SNS without edge banding).
    BeforeMotion,
    /// MVS_SNS: called before the motion of the block; the path waits at its end for the remaining time.
    DuringMotion,
    /// MNS_SNS: called after the motion.
    AfterMotion,
}

impl Acknowledged {
    pub(super) fn of(bits: u32) -> Self {
        let is = |kind: u32| bits & kind != 0;
        if is(of::BEFORE_MOTION) {
            Self::BeforeMotion
        } else if is(of::DURING_MOTION) {
            Self::DuringMotion
        } else if is(of::BEHIND_MOTION) {
            Self::AfterMotion
        } else if is(of::ELSEWHERE) {
            Self::BeforeMotion
        } else {
            Self::Never
        }
    }
}

/// When the functions of a spindle are executed and whether the path waits until speed, standstill or position is
/// reached; `None` where the list does not state it.
///
/// Source: TF5200 channel parameters, spindle synchronisation (149163787, 287516299); M and H functions 286059787.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SpindleWaits {
    /// M03 (P-CHAN-00045).
    pub m3: Option<Acknowledged>,
    /// M04 (P-CHAN-00047).
    pub m4: Option<Acknowledged>,
    /// M05 (P-CHAN-00049).
    pub m5: Option<Acknowledged>,
    /// M19 (P-CHAN-00043).
    pub m19: Option<Acknowledged>,
    /// S word (P-CHAN-00081).
    pub speed: Option<Acknowledged>,
}

impl SpindleWaits {
    pub(super) fn of(parameters: &Parameters, spindle: u32) -> Self {
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
}

impl SpindleWaits {
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
pub struct SpindleDurations {
    /// M03 (P-CHAN-00044).
    pub m3: Option<f64>,
    /// M04 (P-CHAN-00046).
    pub m4: Option<f64>,
    /// M05 (P-CHAN-00048).
    pub m5: Option<f64>,
    /// M19 (P-CHAN-00042).
    pub m19: Option<f64>,
    /// S word (P-CHAN-00080).
    pub speed: Option<f64>,
}

impl SpindleDurations {
    pub(super) fn of(parameters: &Parameters, spindle: u32) -> Self {
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
