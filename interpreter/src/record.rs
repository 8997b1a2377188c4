//! The record of one cycle; traces, summaries and reports are made from these records only.
//!
//! Order of calls: a run passes its cycles to its sink, many at once as columns ([`Rows`]) or one by one as records;
//! [`columns`] reads values from both.
//!
//! ```
//! use kontur_interpreter::record::{CycleRecord, SpeedLimit};
//!
//! // the record of time zero: at rest
//! let record = CycleRecord::default();
//! assert_eq!((record.k, record.path.limit, record.path.v_mm_s), (0, SpeedLimit::default(), 0.0));
//! ```

pub mod columns;
pub(crate) mod facts;
mod quantity;
mod rows;

pub use quantity::{Asked, Quantity};
pub use rows::Rows;
pub(crate) use rows::{AxisColumns, RowBuffer};

use kontur_motion::block::{Block, Feed};
use kontur_motion::path::Path;

/// The reason for the path speed in a cycle (trace column `v_limit`).
pub use kontur_motion::cap::SpeedLimit;

/// The path in one cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PathRecord {
    /// Path length since the start of the program in mm (deg).
    pub s_mm: f64,
    /// Path velocity in mm/s.
    pub v_mm_s: f64,
    /// Path acceleration in mm/s2.
    pub a_mm_s2: f64,
    /// Path jerk in mm/s3.
    pub j_mm_s3: f64,
    /// Reason for the speed.
    pub limit: SpeedLimit,
    /// The block that is interpolated.
    pub motion: Motion,
    /// The spindle that follows the path (tapping), by its index in [`CycleRecord::axes`].
    pub spindle: Option<u8>,
    /// Reason why the path rests; `None` while it moves, and when it reverses or stops without waiting.
    pub rest: Option<Rest>,
}

/// Kind of a block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Motion {
    /// Before the first motion.
    #[default]
    None,
    /// G00.
    Rapid,
    /// Straight line.
    Line,
    /// Circular arc or helix.
    Arc,
    /// Spline or the curve of a rounded corner.
    Curve,
}

impl Motion {
    pub(crate) fn of(block: &Block) -> Self {
        match (&block.feed, &block.path) {
            (Feed::Rapid, _) => Self::Rapid,
            (_, Path::Line(_)) => Self::Line,
            (_, Path::Arc(_) | Path::Tilted(_)) => Self::Arc,
            (_, Path::Curve(_)) => Self::Curve,
        }
    }

    /// Name in results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Rapid => "rapid",
            Self::Line => "line",
            Self::Arc => "arc",
            Self::Curve => "curve",
        }
    }
}

/// Reason why the path rests in a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rest {
    /// G04, `#TIME`.
    Dwell,
    /// Declared durations of M, H, S and T functions.
    Technology,
    /// G60, G360: the actual positions of the axes are not in their windows yet.
    ExactStop,
    /// The set positions of the axes have not arrived yet: `#FLUSH WAIT`, independent axes, a change of filters.
    Flush,
    /// A spindle that is waited for is not at rest, at the mark of a thread or at its position yet.
    Spindle,
    /// End of the program: every axis has been moved to its target, but not every one is in position yet.
    Arrival,
    /// Feedhold or override 0, of the path or of the independent axes that it waits for.
    Held,
}

impl Rest {
    /// All values.
    pub const ALL: [Self; 7] = [
        Self::Dwell,
        Self::Technology,
        Self::ExactStop,
        Self::Flush,
        Self::Spindle,
        Self::Arrival,
        Self::Held,
    ];

    /// Name in results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dwell => "dwell",
            Self::Technology => "technology",
            Self::ExactStop => "exact_stop",
            Self::Flush => "flush",
            Self::Spindle => "spindle",
            Self::Arrival => "arrival",
            Self::Held => "held",
        }
    }
}

/// One axis in one cycle, in millimetres (degrees for rotary axes) and seconds; for the columns see `docs/trace.md`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisRecord {
    /// Interpolated setpoint.
    pub ipo: f64,
    /// Set position: after filters or Vibration Guard.
    pub set: f64,
    /// Velocity of `set` (backward difference).
    pub vel: f64,
    /// Acceleration of `set` (second difference).
    pub acc: f64,
    /// Jerk of `set` (third difference).
    pub jerk: f64,
    /// `set` minus the interpolated setpoint at the time given by the mean delay of the filters.
    pub err: f64,
    /// Component of the shortest vector from the set point to the contour.
    pub dev: f64,
    /// Largest component in mm (deg) of the two directions that `AX_DEV` bounds: how far the line to the set position
    /// leaves the contour, and by how much the set path has missed the part of the contour that has just left the
    /// filters. Between two cycles the second one may be larger, but without `AX_DEV` not larger than the largest one so
    /// far.
    pub dev_both_ways: f64,
    /// Feedforward speed, at the controller output or as additive velocity of the drive.
    pub ff: f64,
    /// Speed command.
    pub cmd: f64,
    /// Additional speed of Improved Position Control.
    pub vadd: f64,
    /// 1 while the additional speed is at its limit (P-AXIS-00757), else 0.
    pub vadd_limited: f64,
    /// Reference position of the position controller.
    pub reference: f64,
    /// Actual position (motor encoder).
    pub act: f64,
    /// Load position (direct encoder; equal to `act` without one).
    pub load: f64,
    /// `reference - act`.
    pub lag: f64,
    /// Permitted lag of the following-error monitoring (70020), 0 while it is off.
    pub lag_limit: f64,
    /// Additional interface.
    pub add: f64,
    /// Time in s since the set position reached the target of a stop (t1) while the axis settles, until the actual
    /// position is inside the window (t2); then t2 - t1 of the last stop.
    pub settling_s: f64,
    /// Position of the tool point (modal plants; else equal to `load`).
    pub tcp: f64,
    /// Acceleration of the tool point.
    pub tcp_acc: f64,
    /// Programmed end of the interpolated block, before its corner is rounded.
    pub target: f64,
    /// Speed command in the drive's format.
    pub cmd_drive: f64,
    /// Velocity feedforward in the drive's format.
    pub vff_drive: f64,
    /// Additional speed in the drive's format.
    pub vadd_drive: f64,
    /// Torque feedforward in the drive's format.
    pub torque_drive: f64,
    /// Torque feedforward in Nm (N for linear motors).
    pub torque_n_m: f64,
}

/// One row of the trace.
#[derive(Debug, Default, PartialEq)]
pub struct CycleRecord {
    /// Cycle count; the time is `k T`.
    pub k: u64,
    /// Index of the source file in `Simulation::files`.
    pub file: u32,
    /// Line in that file, from 1; 0 before the first motion.
    pub line: u32,
    /// N number of the block, if it has one.
    pub block: Option<u64>,
    /// The path.
    pub path: PathRecord,
    /// Length of the shortest vector from the set point to the contour in mm.
    pub contour_err_mm: f64,
    /// Path axes in channel order, then spindles.
    pub axes: Vec<AxisRecord>,
}

impl CycleRecord {
    /// Sets the deviation of the path axes to NaN where it is not measured.
    pub(crate) fn omit_deviation(&mut self, path_axes: usize) {
        self.contour_err_mm = f64::NAN;
        for axis in self.axes.iter_mut().take(path_axes) {
            (axis.dev, axis.dev_both_ways) = (f64::NAN, f64::NAN);
        }
    }
}

impl Clone for CycleRecord {
    fn clone(&self) -> Self {
        Self { axes: self.axes.clone(), ..*self }
    }

    /// Reuses the memory of the axes.
    fn clone_from(&mut self, other: &Self) {
        let mut axes = std::mem::take(&mut self.axes);
        axes.clone_from(&other.axes);
        *self = Self { axes, ..*other };
    }
}
