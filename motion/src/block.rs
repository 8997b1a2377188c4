//! Input of the planner: one programmed motion with all its limits.
//!
//! Made from limits ([`crate::axis`]) and geometry ([`crate::path`]), and passed to [`crate::planner::Planner::push`].
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! use kontur_motion::block::{Slope, SlopeKind, Tolerance};
//!
//! let dynamics = Arc::new(ChannelDynamics::new(vec![axis(); 2]));
//! let mut block = Block::new(1, line([0.0, 0.0], [30.0, 40.0]), Feed::PathVelocity(100.0), dynamics);
//! block.slope = Slope { kind: SlopeKind::Hsc, ..Slope::default() };
//! block.tolerance = Tolerance { ax_dev_mm: Some(0.01), ..Tolerance::default() };
//! assert_eq!(block.path.length(), 50.0);
//! ```

mod contour;
mod spare;
mod spline;

use crate::axis::AxisDynamics;
use std::sync::Arc;

pub use contour::{BlockLimit, ContourMode, ContourSettings};
pub use spare::SpareBlocks;
pub use spline::SplineSettings;

/// Shape of the acceleration over time (P-CHAN-00071, `#SLOPE`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SlopeKind {
    /// Linear slope, acceleration jumps.
    #[default]
    Step,
    /// Trapezoidal acceleration, acceleration is zero at block limits.
    Trapez,
    /// Sine-square ramps, acceleration is zero at block limits.
    Sin2,
    /// Trapezoidal acceleration planned across block limits.
    Hsc,
}

/// The slope with its options.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Slope {
    /// Shape.
    pub kind: SlopeKind,
    /// `NO_OPT=0`: profile planned across block limits.
    pub optimised: bool,
    /// P-CHAN-00349 = 1: constant ramp time instead of constant jerk, for TRAPEZ and SIN2, never in rapid blocks.
    pub constant_ramp_time: bool,
}

impl Slope {
    /// Whether the profile of a block may extend beyond its ends with a non-zero acceleration.
    pub(crate) fn plans_across(self) -> bool {
        self.kind != SlopeKind::Step && (self.optimised || !self.keeps_ramp_times())
    }

    /// Whether a small change of speed in a feed block also takes full ramp times.
    pub fn keeps_ramp_times(self) -> bool {
        self.constant_ramp_time && matches!(self.kind, SlopeKind::Trapez | SlopeKind::Sin2)
    }
}

/// Programmed speed of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feed {
    /// G00: at least one axis at its rapid velocity.
    Rapid,
    /// Path velocity in mm/s (G94; G95 already converted).
    PathVelocity(f64),
    /// G93: time for the block in s.
    Duration(f64),
    /// G194: share (0..1) of the largest path velocity that the axes allow.
    ShareOfMaximum(f64),
}

/// Path limits of `#VECTOR LIMIT`; `None`: not limited.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct VectorLimits {
    /// Path velocity in mm/s.
    pub vel_mm_s: Option<f64>,
    /// Path acceleration in mm/s2.
    pub acc_mm_s2: Option<f64>,
    /// Path deceleration in mm/s2.
    pub dec_mm_s2: Option<f64>,
    /// Path jerk in mm/s3.
    pub jerk_mm_s3: Option<f64>,
    /// Centripetal acceleration in mm/s2.
    pub radial_acc_mm_s2: Option<f64>,
    /// Centripetal jerk in mm/s3.
    pub radial_jerk_mm_s3: Option<f64>,
    /// Acceleration of the path at a kink in mm/s2: limits `v |du| / T`.
    pub trans_acc_mm_s2: Option<f64>,
}

/// The rule that P-CHAN-00117 selects for the limits at block transitions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum TransitionJerkMode {
    /// 0: the kink weight is not below the tangential weight (only with P-CHAN-00009 = 1 and a kink weight > 0).
    #[default]
    Coupled,
    /// 1: both weights are independent.
    Independent,
    /// 2: the direct jerk limits apply.
    DirectJerk,
}

/// The limit on the axis jerk caused by the shape of a polynomial (P-CHAN-00110, `CHECK_JERK`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum CurveJerk {
    /// 0: none.
    Unlimited,
    /// 1 (default): the geometric ramp time (P-AXIS-00199). Mode 3 adds kinematic compensation, which is not
    /// implemented here, and is treated as mode 1.
    #[default]
    Geometric,
    /// 2: the longest ramp time of the slope (P-AXIS-00195..00198).
    Ramps,
}

/// Limits and modes of a channel, shared by a run of blocks and replaced when an NC word changes one of them.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelDynamics {
    /// One entry per axis, in channel order.
    pub axes: Vec<AxisDynamics>,
    /// Members of the feed group (P-CHAN-00011), one flag per axis; the path length is measured over them.
    pub feed_axes: Vec<bool>,
    /// P-CHAN-00009: limit the jerk at tangential transitions.
    pub limit_tangential_jerk: bool,
    /// P-CHAN-00117.
    pub transition_jerk: TransitionJerkMode,
    /// P-CHAN-00245: 0 off, 1 acceleration, 2 geometric ramp time, 3 acceleration, equal in every direction.
    pub curvature_estimate: u8,
    /// P-CHAN-00110.
    pub curve_jerk: CurveJerk,
    /// `#VECTOR LIMIT`.
    pub vector: VectorLimits,
    /// P-CHAN-00350: the path acceleration limit also applies to the centripetal acceleration.
    pub vector_acc_on_arcs: bool,
    /// `#TRANSVELMIN ON`: lower bound of kink velocities in mm/s.
    pub transition_velocity_min_mm_s: f64,
    /// G116: every transition is a stop.
    pub stop_at_transitions: bool,
    /// Main axes by index whose longest ramp time is that of a motion in which they take part (P-CHAN-00758); none outside of
    /// coordinate systems.
    pub longest_ramps_of: [Option<usize>; 3],
}

impl ChannelDynamics {
    /// A channel with these axes, all of them in the feed group, with the limits of the axes only and every mode off.
    pub fn new(axes: Vec<AxisDynamics>) -> Self {
        Self {
            feed_axes: vec![true; axes.len()],
            axes,
            limit_tangential_jerk: false,
            transition_jerk: TransitionJerkMode::default(),
            curvature_estimate: 0,
            curve_jerk: CurveJerk::default(),
            vector: VectorLimits::default(),
            vector_acc_on_arcs: false,
            transition_velocity_min_mm_s: 0.0,
            stop_at_transitions: false,
            longest_ramps_of: [None; 3],
        }
    }
}

/// Tolerance monitoring of a filter kernel (`AX_DEV`, `ACC_FACT` of `#VIB GUARD` and `#FILTER`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Largest deviation of each axis from the contour in mm (deg); `None`: not monitored.
    pub ax_dev_mm: Option<f64>,
    /// Factor 1..10 on the admissible acceleration at kinks.
    pub acc_fact: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { ax_dev_mm: None, acc_fact: 1.0 }
    }
}

/// One programmed motion.
#[derive(Clone, Debug)]
pub struct Block {
    /// Number of the block in order of execution; every sample of the block carries it.
    pub seq: u64,
    /// Geometry over all axes.
    pub path: crate::path::Path,
    /// Programmed speed.
    pub feed: Feed,
    /// Override and path weights on the programmed feed rate, 1.0 = 100 %.
    pub feed_ratio: f64,
    /// The real-time override has no effect on this block (G166); feedhold has.
    pub full_override: bool,
    /// Requested path velocity at the end of the block in mm/s (E word); overrides act on it as on the feed.
    pub end_velocity_mm_s: Option<f64>,
    /// G901: braking to a lower feed rate of the next block may begin after the end of this block. The next block is
    /// entered with at most what its limits allow, whatever its feed rate. Ignored by G00 and HSC.
    pub late_braking: bool,
    /// Slope.
    pub slope: Slope,
    /// Limits.
    pub dynamics: Arc<ChannelDynamics>,
    /// Tolerance monitoring.
    pub tolerance: Tolerance,
    /// Contouring at the end of this block (G61, G261), see [`crate::contouring`].
    pub contour: Option<ContourSettings>,
    /// Part of a run that becomes a spline (`#HSC ON [BSPLINE]`), see [`crate::spline`].
    pub spline: Option<SplineSettings>,
    /// An element inserted at an almost tangential corner: its curvature does not slow the path below the speed that the kink in
    /// its place would permit.
    pub tangential: bool,
}

impl Block {
    /// A motion with the default slope, without override, end velocity, tolerance or smoothing.
    pub fn new(
        seq: u64,
        path: crate::path::Path,
        feed: Feed,
        dynamics: Arc<ChannelDynamics>,
    ) -> Self {
        Self {
            seq,
            path,
            feed,
            feed_ratio: 1.0,
            full_override: false,
            end_velocity_mm_s: None,
            late_braking: false,
            slope: Slope::default(),
            dynamics,
            tolerance: Tolerance::default(),
            contour: None,
            spline: None,
            tangential: false,
        }
    }
}
