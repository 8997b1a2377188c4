//! Dynamic limits of the axes under the weights of the program.
//!
//! Every weight refers to the list, never to the previous weight. Values above the limits of the list are capped, with 50130, 120033,
//! 120037 or 120038.
//!
//! An acceleration weighted to 0 becomes the smallest one that the lists allow; the program continues.
//!
//! Source: TF5200 programming manual, G127 to G134, G230 to G233; P-AXIS-00292, 00293, 00008, 00201, 00212; 120028, 120030,
//! 120032, 120034.

use super::weight::Weight;
use crate::diag::Condition;
use crate::exec::block::choice::LookAhead;
use crate::exec::block::modal::Modal;
use crate::machine::{Axis, Channel, Machine};
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::{ChannelDynamics, SlopeKind, VectorLimits};

/// Weights of one axis, 1.0 = 100 %.
#[derive(Clone, Copy, Debug, PartialEq)]
struct AxisWeights {
    velocity: f64,
    acceleration: f64,
    ramp: f64,
    rapid_acceleration: f64,
}

impl AxisWeights {
    const ONE: Self = Self { velocity: 1.0, acceleration: 1.0, ramp: 1.0, rapid_acceleration: 1.0 };
}

/// All weights of the channel.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct Weights {
    axes: Vec<AxisWeights>,
    rapid_velocity: f64,
    geometric_ramp: f64,
    rapid_ramp: f64,
}

impl Weights {
    pub(in crate::exec) fn new(axes: usize) -> Self {
        Self {
            axes: vec![AxisWeights::ONE; axes],
            rapid_velocity: 1.0,
            geometric_ramp: 1.0,
            rapid_ramp: 1.0,
        }
    }

    /// Only the weights of velocities.
    pub(in crate::exec) fn of_velocities(&self) -> Self {
        let velocity = |w: &AxisWeights| AxisWeights { velocity: w.velocity, ..AxisWeights::ONE };
        Self {
            axes: self.axes.iter().map(velocity).collect(),
            geometric_ramp: 1.0,
            rapid_ramp: 1.0,
            ..*self
        }
    }

    /// Sets the weight of one axis or of all.
    pub(in crate::exec) fn set(&mut self, what: Weight, axis: Option<usize>, ratio: f64) {
        let chosen = match axis {
            Some(axis) => axis..axis + 1,
            None => 0..self.axes.len(),
        };
        for w in &mut self.axes[chosen] {
            match what {
                Weight::Velocity => w.velocity = ratio,
                Weight::Acceleration => w.acceleration = ratio,
                Weight::Ramp => w.ramp = ratio,
                Weight::RapidAcceleration => w.rapid_acceleration = ratio,
                Weight::RapidVelocity => self.rapid_velocity = ratio,
                Weight::GeometricRamp => self.geometric_ramp = ratio,
                Weight::RapidRamp => self.rapid_ramp = ratio,
            }
        }
    }
}

/// Lowest weighted acceleration in mm/s2 or deg/s2.
///
/// Assumption: the lowest value of the lists (range of P-AXIS-00001, 00002, 00004); the vendor prints no number.
const ACCELERATION_MIN: f64 = 1.0;

/// Why a limit of an axis differs from the one that its weight requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Cut {
    /// Beyond a limit of the axis list for which no page prints an ID of its own.
    Limited,
    /// The deceleration exceeds the largest one of the axis.
    Deceleration,
    /// The ramp time at the beginning of a deceleration is below the shortest one.
    BrakingRampUp,
    /// The ramp time at the end of a deceleration is below the shortest one.
    BrakingRampDown,
    /// The acceleration would become 0.
    ZeroAcceleration,
    /// The deceleration would become 0.
    ZeroDeceleration,
    /// The value of the first stage of STEP would become 0.
    ZeroFirstStage,
    /// The value of the second stage of STEP would become 0.
    ZeroSecondStage,
}

impl Cut {
    /// The condition to report.
    pub(in crate::exec) const fn condition(self) -> Condition {
        match self {
            Self::Limited => Condition::DynamicsLimited,
            Self::Deceleration => Condition::DecelerationTooLarge,
            Self::BrakingRampUp => Condition::DecelerationRampUp,
            Self::BrakingRampDown => Condition::DecelerationRampDown,
            Self::ZeroAcceleration => Condition::AccelerationZero,
            Self::ZeroDeceleration => Condition::DecelerationZero,
            Self::ZeroFirstStage => Condition::FirstStageZero,
            Self::ZeroSecondStage => Condition::SecondStageZero,
        }
    }

    /// Whether the value would become 0.
    pub(in crate::exec) const fn is_zero(self) -> bool {
        match self {
            Self::ZeroAcceleration
            | Self::ZeroDeceleration
            | Self::ZeroFirstStage
            | Self::ZeroSecondStage => true,
            Self::Limited | Self::Deceleration | Self::BrakingRampUp | Self::BrakingRampDown => {
                false
            }
        }
    }

    /// The only weight that can cause it; `None` if several can.
    pub(in crate::exec) const fn weight(self) -> Option<Weight> {
        match self {
            Self::Limited => None,
            Self::BrakingRampUp | Self::BrakingRampDown => Some(Weight::Ramp),
            Self::Deceleration
            | Self::ZeroAcceleration
            | Self::ZeroDeceleration
            | Self::ZeroFirstStage
            | Self::ZeroSecondStage => Some(Weight::Acceleration),
        }
    }
}

/// Scales values and records when a limit applies.
#[derive(Default)]
struct Capped {
    cuts: Vec<Cut>,
}

impl Capped {
    fn cut(&mut self, by: Cut) {
        if !self.cuts.contains(&by) {
            self.cuts.push(by);
        }
    }

    /// `value * ratio`, at most `cap` and at least the lowest acceleration; sets `zero` if the result would be 0.
    fn acceleration(
        &mut self,
        value: f64,
        ratio: f64,
        cap: f64,
        (limited, zero): (Cut, Option<Cut>),
    ) -> f64 {
        let least = ACCELERATION_MIN.min(value);
        if value * ratio < least {
            if let Some(zero) = zero {
                self.cut(zero);
            }
            return least;
        }
        self.at_most(value, ratio, cap, limited)
    }

    /// `value * ratio`, at most `cap`.
    fn at_most(&mut self, value: f64, ratio: f64, cap: f64, limited: Cut) -> f64 {
        let scaled = value * ratio;
        // a list value above the cap is not caused by the program
        let cap = cap.max(value.min(scaled));
        if scaled > cap {
            self.cut(limited);
        }
        scaled.min(cap)
    }

    /// `value * ratio`, at least `floor`.
    fn at_least(&mut self, value: f64, ratio: f64, floor: f64, limited: Cut) -> f64 {
        let scaled = value * ratio;
        let floor = floor.min(value.max(scaled));
        if scaled < floor {
            self.cut(limited);
        }
        scaled.max(floor)
    }
}

/// Cuts of the ramp times of the feed, in the order of the list; the pages of the first two are not known.
const RAMPS: [Cut; 4] = [Cut::Limited, Cut::Limited, Cut::BrakingRampUp, Cut::BrakingRampDown];

/// Lowest weighted velocity in mm/s. Source: TF5200 programming manual, G127, G128 and G129: 0 gives 1 um/s.
const VELOCITY_MIN_MM_S: f64 = 0.001;

/// Limits of one axis with its weights, and why they differ from the values requested by the weights.
fn weighted(
    axis: &Axis,
    w: AxisWeights,
    all: &Weights,
    modal: &Modal,
    channel: &Channel,
) -> (AxisDynamics, Vec<Cut>) {
    let mut d = axis.dynamics();
    let mut capped = Capped::default();
    // the active profile decides which value becomes 0
    let stepped = modal.commanded.slope.kind == SlopeKind::Step;
    let stages = [Cut::ZeroFirstStage, Cut::ZeroSecondStage].map(|c| stepped.then_some(c));
    let smooth = [Cut::ZeroAcceleration, Cut::ZeroDeceleration].map(|c| (!stepped).then_some(c));
    let (a_cap, floor) = (axis.a_w_max_mm_s2(), axis.tr_w_min_s());
    // P-CHAN-00001, P-CHAN-00073: selective weights apply to the older command
    let (accelerations, ramps) = if modal.commanded.old_slope {
        (channel.dynamics.acc_selection, channel.dynamics.ramp_selection)
    } else {
        (0, 0)
    };
    let acc =
        |on: u32| if accelerations == 0 || accelerations == on { w.acceleration } else { 1.0 };
    let a_max = d.a_max_mm_s2;
    let limited = Cut::Limited;
    let (rapid, both) = (w.rapid_acceleration, (limited, Some(limited)));
    let braking = if stepped { limited } else { Cut::Deceleration };
    d.feed.acc_mm_s2 = capped.acceleration(d.feed.acc_mm_s2, acc(1), a_cap, (limited, smooth[0]));
    d.feed.dec_mm_s2 = capped.acceleration(d.feed.dec_mm_s2, acc(2), a_cap, (braking, smooth[1]));
    for (i, stage) in stages.into_iter().enumerate() {
        let stage = (limited, stage);
        let (up, down) = (d.step_feed.acc_mm_s2[i], d.step_feed.dec_mm_s2[i]);
        d.step_feed.acc_mm_s2[i] = capped.acceleration(up, acc(1), a_cap, stage);
        d.step_feed.dec_mm_s2[i] = capped.acceleration(down, acc(2), a_cap, stage);
        let (up, down) = (d.step_rapid.acc_mm_s2[i], d.step_rapid.dec_mm_s2[i]);
        d.step_rapid.acc_mm_s2[i] = capped.acceleration(up, rapid, a_max, both);
        d.step_rapid.dec_mm_s2[i] = capped.acceleration(down, rapid, a_max, both);
    }
    d.rapid.acc_mm_s2 = capped.acceleration(d.rapid.acc_mm_s2, rapid, a_max, both);
    for ((k, ramp), cut) in (1..).zip(&mut d.feed.ramps_s).zip(RAMPS) {
        let ratio = if ramps == 0 || ramps == k { w.ramp } else { 1.0 };
        *ramp = capped.at_least(*ramp, ratio, floor, cut);
    }
    d.rapid.ramp_s = capped.at_least(d.rapid.ramp_s, all.rapid_ramp, axis.tr_min_s(), limited);
    d.tr_geom_s *= all.geometric_ramp;
    d.v_max_mm_s =
        capped.at_most(d.v_max_mm_s, w.velocity, d.v_max_mm_s, limited).max(VELOCITY_MIN_MM_S);
    d.v_rapid_mm_s = capped
        .at_most(d.v_rapid_mm_s, all.rapid_velocity, d.v_max_mm_s, limited)
        .max(VELOCITY_MIN_MM_S);
    d.v_rapid_mm_s = d.v_rapid_mm_s.min(d.v_max_mm_s);
    (d, capped.cuts)
}

/// Limits of the channel, and the axes with a limited weight, with the corresponding conditions.
pub(in crate::exec) fn channel_dynamics(
    machine: &Machine,
    weights: &Weights,
    modal: &Modal,
    vector: VectorLimits,
) -> (ChannelDynamics, Vec<(usize, Cut)>) {
    let channel = &machine.channel;
    let mut capped = Vec::new();
    let mut axes = Vec::with_capacity(machine.axes.len());
    for (i, axis) in machine.axes.iter().enumerate() {
        let (dynamics, cuts) = weighted(axis, weights.axes[i], weights, modal, channel);
        axes.push(dynamics);
        capped.extend(cuts.into_iter().map(|cut| (i, cut)));
    }
    let dynamics = ChannelDynamics {
        axes,
        feed_axes: channel.feed.axes.clone(),
        limit_tangential_jerk: channel.dynamics.limit_tangential_jerk,
        transition_jerk: channel.dynamics.transition_jerk,
        curvature_estimate: channel.dynamics.curvature_estimate,
        vector,
        vector_acc_on_arcs: channel.dynamics.vector_acc_on_arcs,
        curve_jerk: channel.dynamics.curve_jerk,
        transition_velocity_min_mm_s: modal.commanded.transition_min_mm_s,
        stop_at_transitions: modal.look_ahead == LookAhead::StopAtTransitions,
        longest_ramps_of: [None; 3],
    };
    (dynamics, capped)
}
