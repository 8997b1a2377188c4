//! Axis values and the dynamic limits of one axis.
//!
//! The first types of any program: values per axis, and the limits to which blocks refer.
//!
//! ```
//! use kontur_motion::axis::{AxisVec, FeedSlope};
//!
//! let at = AxisVec::from_slice(&[10.0, 0.0, -5.0]);
//! assert_eq!(at.len(), 3);
//! // P-AXIS-00001, 00002: 3500 mm/s2; P-AXIS-00195 to 00198: 30 ms
//! let feed = FeedSlope { acc_mm_s2: 3500.0, dec_mm_s2: 3500.0, ramps_s: [0.03; 4] };
//! assert_eq!(feed.acc_mm_s2 / feed.ramps_s[0], 3500.0 / 0.03);
//! ```

use smallvec::SmallVec;
use std::ops::{Deref, DerefMut};

/// Up to this number of axes, values need no allocation.
const INLINE: usize = 8;

/// One value per axis of the channel, in channel order; up to eight axes without allocation.
#[derive(Debug, Default, PartialEq)]
pub struct AxisVec(SmallVec<[f64; INLINE]>);

impl Clone for AxisVec {
    /// Copies bytes; the derived implementation copies value by value.
    #[inline]
    fn clone(&self) -> Self {
        Self(SmallVec::from_slice(&self.0))
    }

    #[inline]
    fn clone_from(&mut self, other: &Self) {
        if self.len() == other.len() {
            self.copy_from_slice(other);
        } else {
            self.0.clear();
            self.0.extend_from_slice(&other.0);
        }
    }
}

impl AxisVec {
    /// `n` zeros.
    #[inline]
    pub fn zeros(n: usize) -> Self {
        if n <= INLINE {
            // copies the whole buffer, whose size is a constant, without a call
            Self(SmallVec::from_buf_and_len([0.0; INLINE], n))
        } else {
            Self(SmallVec::from_elem(0.0, n))
        }
    }

    /// One value per axis, in channel order.
    #[inline]
    pub fn from_slice(values: &[f64]) -> Self {
        Self(SmallVec::from_slice(values))
    }
}

impl Deref for AxisVec {
    type Target = [f64];
    #[inline]
    fn deref(&self) -> &[f64] {
        &self.0
    }
}

impl DerefMut for AxisVec {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}

impl FromIterator<f64> for AxisVec {
    fn from_iter<I: IntoIterator<Item = f64>>(iter: I) -> Self {
        Self(iter.into_iter().collect())
    }
}

/// Non-linear slope of one axis in feed blocks (TRAPEZ, SIN2, HSC).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedSlope {
    /// Acceleration in mm/s2 (P-AXIS-00001).
    pub acc_mm_s2: f64,
    /// Deceleration in mm/s2 (P-AXIS-00002).
    pub dec_mm_s2: f64,
    /// Ramp times t1..t4 in s: acceleration builds up, falls, deceleration builds up, falls
    /// (P-AXIS-00196, 00195, 00198, 00197).
    pub ramps_s: [f64; 4],
}

/// Non-linear slope of one axis in rapid blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RapidSlope {
    /// Acceleration and deceleration in mm/s2 (P-AXIS-00004).
    pub acc_mm_s2: f64,
    /// All four ramp times in s (P-AXIS-00200).
    pub ramp_s: f64,
}

/// Linear slope (STEP) of one axis: two stages with a change-over speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepSlope {
    /// Accelerations below and above the change-over speed in mm/s2.
    pub acc_mm_s2: [f64; 2],
    /// Decelerations below and above the change-over speed in mm/s2.
    pub dec_mm_s2: [f64; 2],
    /// Change-over speed in mm/s.
    pub change_mm_s: f64,
}

/// Braking of one axis in a feedhold with its own parameters (P-CHAN-00097 = 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedholdSlope {
    /// Deceleration of the linear slope in mm/s2 (P-AXIS-00024).
    pub step_dec_mm_s2: f64,
    /// Deceleration of the non-linear slopes in mm/s2 (P-AXIS-00053).
    pub dec_mm_s2: f64,
    /// Ramp time of the non-linear slopes in s (P-AXIS-00081).
    pub ramp_s: f64,
}

/// Dynamic limits of one axis, converted to mm (deg) and s, weights G127..G134, G23x already applied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisDynamics {
    /// Hard velocity limit in mm/s (P-AXIS-00212).
    pub v_max_mm_s: f64,
    /// Rapid velocity in mm/s (P-AXIS-00209).
    pub v_rapid_mm_s: f64,
    /// Hard acceleration limit in mm/s2 (P-AXIS-00008).
    pub a_max_mm_s2: f64,
    /// Braking in error stops in mm/s2 (P-AXIS-00003).
    pub a_emergency_mm_s2: f64,
    /// Geometric ramp time in s: bounds axis jerk that comes from the contour (P-AXIS-00199).
    pub tr_geom_s: f64,
    /// Non-linear slope in feed blocks.
    pub feed: FeedSlope,
    /// Non-linear slope in rapid blocks.
    pub rapid: RapidSlope,
    /// Linear slope in feed blocks (P-AXIS-00011, 00012, 00282, 00283, 00221).
    pub step_feed: StepSlope,
    /// Linear slope in rapid blocks (P-AXIS-00005, 00006, 00280, 00281, 00211).
    pub step_rapid: StepSlope,
    /// Feedhold with its own parameters.
    pub feedhold: FeedholdSlope,
    /// Weight of the acceleration allowed at a kink, 0..1; 0 selects cycle time / ramp time (P-AXIS-00013).
    pub a_trans_ratio: f64,
    /// Weight of the jerk allowed at tangential transitions, 0..1 (P-AXIS-00154).
    pub r_trans_ratio: f64,
    /// Direct jerk limit at kinks in mm/s3 (P-AXIS-00339), used with P-CHAN-00117 = 2.
    pub j_trans_kink_mm_s3: f64,
    /// Direct jerk limit at tangential transitions in mm/s3 (P-AXIS-00340), used with P-CHAN-00117 = 2.
    pub j_trans_tangential_mm_s3: f64,
}

impl AxisDynamics {
    /// Feed blocks get the accelerations and ramp times of rapid ones.
    pub fn use_rapid(&mut self) {
        let RapidSlope { acc_mm_s2, ramp_s } = self.rapid;
        self.feed = FeedSlope { acc_mm_s2, dec_mm_s2: acc_mm_s2, ramps_s: [ramp_s; 4] };
        self.step_feed = self.step_rapid;
    }

    /// The limits that hold for this axis and another one that moves the same distance: the lower of each value. Ramps follow the
    /// lower jerk, as those of a path follow the jerks of its axes; the longer ramp time would be slower than either axis needs.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let step = |a: &StepSlope, b: &StepSlope| StepSlope {
            acc_mm_s2: std::array::from_fn(|i| a.acc_mm_s2[i].min(b.acc_mm_s2[i])),
            dec_mm_s2: std::array::from_fn(|i| a.dec_mm_s2[i].min(b.dec_mm_s2[i])),
            change_mm_s: a.change_mm_s.min(b.change_mm_s),
        };
        let (feed, rapid, hold) = (&other.feed, &other.rapid, &other.feedhold);
        let slope =
            |f: &FeedSlope, i: usize| (if i < 2 { f.acc_mm_s2 } else { f.dec_mm_s2 }, f.ramps_s[i]);
        Self {
            v_max_mm_s: self.v_max_mm_s.min(other.v_max_mm_s),
            v_rapid_mm_s: self.v_rapid_mm_s.min(other.v_rapid_mm_s),
            a_max_mm_s2: self.a_max_mm_s2.min(other.a_max_mm_s2),
            a_emergency_mm_s2: self.a_emergency_mm_s2.min(other.a_emergency_mm_s2),
            tr_geom_s: self.tr_geom_s.max(other.tr_geom_s),
            feed: FeedSlope {
                acc_mm_s2: self.feed.acc_mm_s2.min(feed.acc_mm_s2),
                dec_mm_s2: self.feed.dec_mm_s2.min(feed.dec_mm_s2),
                ramps_s: std::array::from_fn(|i| {
                    common_ramp_s(slope(&self.feed, i), slope(feed, i))
                }),
            },
            rapid: RapidSlope {
                acc_mm_s2: self.rapid.acc_mm_s2.min(rapid.acc_mm_s2),
                ramp_s: common_ramp_s(
                    (self.rapid.acc_mm_s2, self.rapid.ramp_s),
                    (rapid.acc_mm_s2, rapid.ramp_s),
                ),
            },
            step_feed: step(&self.step_feed, &other.step_feed),
            step_rapid: step(&self.step_rapid, &other.step_rapid),
            feedhold: FeedholdSlope {
                step_dec_mm_s2: self.feedhold.step_dec_mm_s2.min(hold.step_dec_mm_s2),
                dec_mm_s2: self.feedhold.dec_mm_s2.min(hold.dec_mm_s2),
                ramp_s: common_ramp_s(
                    (self.feedhold.dec_mm_s2, self.feedhold.ramp_s),
                    (hold.dec_mm_s2, hold.ramp_s),
                ),
            },
            a_trans_ratio: self.a_trans_ratio.min(other.a_trans_ratio),
            r_trans_ratio: self.r_trans_ratio.min(other.r_trans_ratio),
            j_trans_kink_mm_s3: self.j_trans_kink_mm_s3.min(other.j_trans_kink_mm_s3),
            j_trans_tangential_mm_s3: self
                .j_trans_tangential_mm_s3
                .min(other.j_trans_tangential_mm_s3),
        }
    }
}

/// Ramp time in s of two axes that accelerate together, each given by its acceleration in mm/s2 and its ramp time in s: with the
/// lower acceleration it gives the lower jerk.
fn common_ramp_s((a, a_ramp_s): (f64, f64), (b, b_ramp_s): (f64, f64)) -> f64 {
    // the axis with the lower jerk
    let (acc, ramp_s, other) =
        if a_ramp_s * b >= b_ramp_s * a { (a, a_ramp_s, b) } else { (b, b_ramp_s, a) };
    if acc <= other { ramp_s } else { ramp_s * (other / acc) }
}
