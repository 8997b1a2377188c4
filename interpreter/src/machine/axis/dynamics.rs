//! Limits of an axis for the planner: speeds, accelerations, ramp times.

use super::Axis;
use crate::machine::table::axis_dynamics as of;
use crate::machine::table::param::{Number, Param};
use kontur_motion::axis::{AxisDynamics, FeedSlope, FeedholdSlope, RapidSlope, StepSlope};

impl Axis {
    /// Dynamic limits as stated in the lists, with weights of 100 %.
    pub fn dynamics(&self) -> AxisDynamics {
        let a_max_mm_s2 = self.get(of::ACC_MAX);
        let step = |acc: [Param<Number>; 2], dec: [Param<Number>; 2], change: Param<Number>| {
            let acc_mm_s2 = acc.map(|param| self.get(param));
            StepSlope {
                acc_mm_s2,
                dec_mm_s2: [self.get_or(dec[0], acc_mm_s2[0]), self.get_or(dec[1], acc_mm_s2[1])],
                change_mm_s: self.get(change),
            }
        };
        let rapid =
            RapidSlope { acc_mm_s2: self.get(of::RAPID_ACC), ramp_s: self.get(of::RAPID_RAMP) };
        let step_rapid = step(
            [of::STEP_RAPID_ACC_1, of::STEP_RAPID_ACC_2],
            [of::STEP_RAPID_DEC_1, of::STEP_RAPID_DEC_2],
            of::STEP_RAPID_CHANGE,
        );
        let rapid_step = step_rapid.acc_mm_s2;
        AxisDynamics {
            v_max_mm_s: self.get(of::SPEED_MAX),
            v_rapid_mm_s: self.get(of::RAPID_SPEED),
            a_max_mm_s2,
            a_emergency_mm_s2: self.get_or(of::EMERGENCY_DEC, a_max_mm_s2),
            tr_geom_s: self.get(of::GEOMETRIC_RAMP),
            feed: FeedSlope {
                acc_mm_s2: self.get(of::FEED_ACC),
                dec_mm_s2: self.get(of::FEED_DEC),
                ramps_s: [of::RAMP_ACC_UP, of::RAMP_ACC_DOWN, of::RAMP_DEC_UP, of::RAMP_DEC_DOWN]
                    .map(|param| self.get(param)),
            },
            rapid,
            step_feed: step(
                [of::STEP_ACC_1, of::STEP_ACC_2],
                [of::STEP_DEC_1, of::STEP_DEC_2],
                of::STEP_CHANGE,
            ),
            step_rapid,
            feedhold: FeedholdSlope {
                step_dec_mm_s2: self
                    .get_or(of::STEP_FEEDHOLD_DEC, rapid_step[0].min(rapid_step[1])),
                dec_mm_s2: self.get_or(of::FEEDHOLD_DEC, rapid.acc_mm_s2),
                ramp_s: self.get_or(of::FEEDHOLD_RAMP, rapid.ramp_s),
            },
            a_trans_ratio: self.get(of::KINK_ACC_WEIGHT),
            r_trans_ratio: self.get(of::TANGENTIAL_JERK_WEIGHT),
            j_trans_kink_mm_s3: self.get(of::KINK_JERK),
            j_trans_tangential_mm_s3: self.get(of::TANGENTIAL_JERK),
        }
    }

    /// Limits the path under G201: P-AXIS-00095 per cent of the highest speed and P-AXIS-00094 per cent of the highest
    /// acceleration (248646795). The rest is kept for the manual motion, whether or not it takes place.
    ///
    /// Assumption: a share of 0 leaves the lowest values of the lists, 1 um/s and 1 mm/s2.
    pub(crate) fn limit_beside_manual_mode(&self, limits: &mut AxisDynamics) {
        let speed = (self.get(of::SPEED_MAX) * self.get(of::PATH_SPEED_SHARE)).max(1e-3);
        let acceleration = (self.get(of::ACC_MAX) * self.get(of::PATH_ACC_SHARE)).max(1.0);
        for v in [&mut limits.v_max_mm_s, &mut limits.v_rapid_mm_s] {
            *v = v.min(speed);
        }
        let (feed, hold) = (&mut limits.feed, &mut limits.feedhold);
        let smooth = [
            &mut limits.a_max_mm_s2,
            &mut feed.acc_mm_s2,
            &mut feed.dec_mm_s2,
            &mut limits.rapid.acc_mm_s2,
            &mut hold.dec_mm_s2,
            &mut hold.step_dec_mm_s2,
        ];
        let steps = [&mut limits.step_feed, &mut limits.step_rapid].into_iter();
        let stages = steps.flat_map(|s| s.acc_mm_s2.iter_mut().chain(&mut s.dec_mm_s2));
        for a in smooth.into_iter().chain(stages) {
            *a = a.min(acceleration);
        }
    }

    /// Upper bound of accelerations under G130 and G131 in mm/s2 (P-AXIS-00292).
    ///
    /// Assumption: without an entry the bound is `a_max`; the table does not print a default.
    pub(crate) fn a_w_max_mm_s2(&self) -> f64 {
        self.get(of::WEIGHTED_ACC_MAX)
    }

    /// Lower bound of ramp times under G132 and G133 in s: P-AXIS-00293, but not below the shortest ramp time
    /// P-AXIS-00201.
    pub(crate) fn tr_w_min_s(&self) -> f64 {
        self.get(of::WEIGHTED_RAMP_MIN).max(self.tr_min_s())
    }

    /// Shortest ramp time in s (P-AXIS-00201); together with `a_max` it gives the jerk limit of the monitor.
    pub(crate) fn tr_min_s(&self) -> f64 {
        self.get(of::SHORTEST_RAMP)
    }
}
