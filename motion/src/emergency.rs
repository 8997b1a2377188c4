//! Emergency braking along the path: the effect of a fault of reaction class 4 and above on the axes that are still
//! healthy.

use crate::axis::AxisVec;
use crate::queue::Queued;
use std::sync::Arc;

/// Braking with constant deceleration from the present speed, on the already known path.
#[derive(Clone, Debug)]
pub(crate) struct EmergencyBraking {
    /// Blocks from the present one on, with the path length of the program at the start of the whole block.
    path: Vec<(f64, Arc<Queued>)>,
    pub(crate) s: f64,
    pub(crate) v: f64,
    /// Deceleration in mm/s2.
    pub(crate) dec: f64,
}

impl EmergencyBraking {
    /// Brakes as hard as the axes' emergency deceleration (P-AXIS-00003) allows on the tangents of the path.
    pub(crate) fn new(path: Vec<(f64, Arc<Queued>)>, s: f64, v: f64) -> Self {
        let distance = |dec: f64| v * v / (2.0 * dec);
        let mut dec = f64::INFINITY;
        for (start, queued) in &path {
            if dec.is_finite() && *start > s + distance(dec) {
                break;
            }
            let ends = &queued.ends;
            for (i, axis) in queued.block.dynamics.axes.iter().enumerate() {
                let u = ends.tangent_in[i].abs().max(ends.tangent_out[i].abs());
                if u > 0.0 {
                    dec = dec.min(axis.a_emergency_mm_s2 / u);
                }
            }
        }
        Self { path, s, v, dec }
    }

    pub(crate) fn is_over(&self) -> bool {
        self.v <= 0.0 || self.path.is_empty()
    }

    /// One cycle of `t` seconds; fills the position and returns the number of the block.
    pub(crate) fn step(&mut self, t: f64, position: &mut AxisVec) -> Option<u64> {
        let v = (self.v - self.dec * t).max(0.0);
        // in the last cycle it travels v^2 / 2a
        self.s += if v > 0.0 { 0.5 * (self.v + v) * t } else { 0.5 * self.v * self.v / self.dec };
        self.v = v;
        let i = self.path.partition_point(|(start, _)| *start <= self.s).checked_sub(1)?;
        let (start, queued) = &self.path[i];
        queued.block.path.position(self.s - start, position);
        if i + 1 == self.path.len() && self.s >= start + queued.offset + queued.length {
            self.v = 0.0;
        }
        Some(queued.block.seq)
    }
}
