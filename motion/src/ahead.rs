//! Setpoints of cycles that are final, read ahead of their output.
//!
//! What follows the planner does with one axis after the other what it would do cycle by cycle: it reads the setpoints of many
//! cycles at once, as columns, and takes them together when everything of them is computed. Reading changes nothing, so what was
//! read and not taken is as if it had never been read.
//!
//! Order of calls: [`Planner::look_ahead`](crate::planner::Planner::look_ahead), then
//! [`Planner::take`](crate::planner::Planner::take) for the first cycles of what was read, with nothing in between.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::ahead::Ahead;
//! use kontur_motion::planner::{Next, Planner};
//!
//! let mut planner = Planner::new(CycleTime::from_us(1000).unwrap(), 10, &[0.0, 0.0]);
//! planner.push(block(7, [0.0, 0.0], [5.0, 0.0], 50.0));
//! planner.finish();
//! assert_eq!(planner.advance().unwrap(), Next::Setpoint);
//! let mut ahead = Ahead::default();
//! planner.look_ahead(20, u64::MAX, &mut ahead);
//! assert_eq!((ahead.len(), planner.setpoint().k), (20, 1));
//! let mut single = planner.clone();
//! for i in 0..ahead.len() {
//!     let mut many = planner.clone();
//!     many.take(&ahead, i);
//!     single.advance().unwrap();
//!     assert_eq!(many.setpoint().position[0].to_bits(), ahead.positions(0)[i].to_bits());
//!     assert_eq!(many.setpoint().position, single.setpoint().position);
//! }
//! ```

use crate::axis::AxisVec;
use crate::cap::SpeedLimit;
use crate::timeline::{PathState, Timeline};
use kontur_filters::time::CycleTime;

/// Setpoints of consecutive cycles.
#[derive(Clone, Debug, Default)]
pub struct Ahead {
    rows: Vec<Row>,
    /// Positions, axis after axis.
    positions: Vec<f64>,
    /// Length of the column of one axis.
    most: usize,
    state: PathState,
}

/// What holds for all axes in a cycle, as in a [`Setpoint`](crate::planner::Setpoint).
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Path length of the program in mm.
    pub s_mm: f64,
    /// Path velocity in mm/s.
    pub v_mm_s: f64,
    /// Path acceleration in mm/s2.
    pub a_mm_s2: f64,
    /// Path jerk in mm/s3.
    pub j_mm_s3: f64,
    /// What holds the speed down.
    pub limit: SpeedLimit,
    /// Number of the block.
    pub seq: u64,
    /// Number of the entry of the timeline in which it lies.
    entry: usize,
}

impl Ahead {
    /// Number of cycles.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no cycles.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Positions of an axis, cycle by cycle.
    pub fn positions(&self, axis: usize) -> &[f64] {
        &self.positions[axis * self.most..][..self.rows.len()]
    }

    /// What holds for all axes in a cycle.
    pub fn row(&self, i: usize) -> Row {
        self.rows[i]
    }

    /// Reads up to `most` cycles from `k` on, as far as the timeline extends, but only up to block `before`.
    pub(crate) fn read(
        &mut self,
        (timeline, cycle): (&Timeline, CycleTime),
        axes: usize,
        mut k: u64,
        most: usize,
        before: u64,
    ) {
        self.rows.clear();
        self.most = most;
        self.positions.resize(axes * most, 0.0);
        if self.state.position.len() != axes {
            self.state.position = AxisVec::zeros(axes);
        }
        let mut entry = 0;
        while self.rows.len() < most
            && let Some(found) = timeline.find(&mut entry, k, cycle)
        {
            let walk = found.walk(cycle);
            // after a stop the next entry may begin more than one cycle later
            loop {
                walk.state(k, &mut self.state);
                if self.state.seq >= before {
                    return;
                }
                let row = self.rows.len();
                for (axis, x) in self.state.position.iter().enumerate() {
                    self.positions[axis * most + row] = *x;
                }
                let PathState { s: s_mm, v: v_mm_s, a: a_mm_s2, j: j_mm_s3, limit, seq, .. } =
                    self.state;
                self.rows.push(Row { s_mm, v_mm_s, a_mm_s2, j_mm_s3, limit, seq, entry });
                k += 1;
                if row + 1 == most || !walk.covers(k) {
                    break;
                }
            }
        }
    }

    /// State of cycle `i`.
    pub(crate) fn state(&self, i: usize, out: &mut PathState) {
        let Row { s_mm: s, v_mm_s: v, a_mm_s2: a, j_mm_s3: j, limit, seq, .. } = self.rows[i];
        for (axis, x) in out.position.iter_mut().enumerate() {
            *x = self.positions[axis * self.most + i];
        }
        (out.s, out.v, out.a, out.j, out.limit, out.seq) = (s, v, a, j, limit, seq);
    }

    /// Number of entries of the timeline that are over in a cycle.
    pub(crate) fn entries(&self, i: usize) -> usize {
        self.rows[i].entry
    }
}
