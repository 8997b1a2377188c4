//! Speed limits at the transition from one block to the next. Each limit is a separate function; all work axis by axis.
//!
//! At a kink the axis velocity jumps by `v |du_i|`. Sampled with the cycle `T` this is an acceleration of
//! `v |du_i| / T` for one cycle, which is weighted by P-AXIS-00013 (source: TF5200 axis parameters; formula derived).
//!
//! Called for every pair of neighbouring blocks when they enter the planner; [`crate::lookahead`] uses the result as a
//! cap.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::junction::{Ends, transition};
//! use kontur_motion::cap::SpeedLimit;
//!
//! let (along_x, along_y) = (block(1, [0.0, 0.0], [10.0, 0.0], 100.0), block(2, [10.0, 0.0], [10.0, 10.0], 100.0));
//! let (a, b) = (Ends::of(&along_x), Ends::of(&along_y));
//! let cycle = CycleTime::from_us(1000).unwrap();
//! // both axes jump by v; 3500 mm/s2 in a cycle of 1 ms are 3.5 mm/s
//! let cap = transition(&along_x, &along_y, &a, &b, cycle, false);
//! assert!((cap.v_mm_s - 3.5).abs() < 1e-9 && cap.why == SpeedLimit::Corner);
//! ```

use crate::axis::{AxisDynamics, AxisVec};
use crate::block::{Block, Feed, SlopeKind, TransitionJerkMode};
use crate::cap::{Cap, SpeedLimit};
use crate::limits::{contour_acceleration, longest_ramp};
use crate::path::Path;
use kontur_filters::time::CycleTime;
use std::sync::Arc;

/// Direction changes below this are rounding of the program's numbers, not kinks.
pub(crate) const TANGENT: f64 = 1e-9;

/// A block with its tangents and curvatures at both ends.
#[derive(Clone, Debug, Default)]
pub struct Ends {
    /// `dq/ds` at the start.
    pub tangent_in: AxisVec,
    /// `dq/ds` at the end.
    pub tangent_out: AxisVec,
    /// `d2q/ds2` at the start and at the end in 1/mm; `None` for a line, where they are 0. Most blocks are lines, and
    /// many of them are kept in the queue.
    pub curvatures: Option<Box<[AxisVec; 2]>>,
}

impl Ends {
    /// The ends of a block's path.
    pub fn of(block: &Block) -> Self {
        let mut ends = Self::default();
        ends.follow(block);
        ends
    }

    /// Turns these ends into those of a block's path.
    pub(crate) fn follow(&mut self, block: &Block) {
        if let Path::Line(line) = &block.path {
            self.tangent_in.clone_from(line.direction());
            self.tangent_out.clone_from(line.direction());
            self.curvatures = None;
            return;
        }
        let n = block.path.start().len();
        let at = |f: &dyn Fn(&mut [f64])| {
            let mut v = AxisVec::zeros(n);
            f(&mut v);
            v
        };
        let (path, length) = (&block.path, block.path.length());
        self.tangent_in = at(&|v| path.tangent(0.0, v));
        self.tangent_out = at(&|v| path.tangent(length, v));
        self.curvatures = Some(Box::new([0.0, length].map(|s| at(&|v| path.curvature(s, v)))));
    }
}

fn is_rapid(block: &Block) -> bool {
    block.feed == Feed::Rapid
}

/// Acceleration of one axis in mm/s2 that a kink may use within one cycle, without P-CHAN-00117 = 2.
fn kink_acceleration(block: &Block, i: usize, cycle: CycleTime, acc_fact: f64) -> f64 {
    let axis = &block.dynamics.axes[i];
    let rapid = is_rapid(block);
    let acc = contour_acceleration(axis, block.slope, rapid);
    if block.slope.kind == SlopeKind::Step {
        return acc;
    }
    acc * kink_weight(block, axis, rapid, cycle, acc_fact)
}

/// Weight of the acceleration at a kink: P-AXIS-00013, or cycle time / ramp time if it is 0.
///
/// ACC_FACT of an active filter kernel multiplies a valid P-AXIS-00013 only, because the kernel spreads the jump over
/// its length. P-CHAN-00117 = 0 raises the weight to P-AXIS-00154 if P-CHAN-00009 = 1 and the weight is not zero.
fn kink_weight(
    block: &Block,
    axis: &AxisDynamics,
    rapid: bool,
    cycle: CycleTime,
    acc_fact: f64,
) -> f64 {
    if axis.a_trans_ratio > 0.0 {
        let d = &block.dynamics;
        let coupled = d.limit_tangential_jerk && d.transition_jerk == TransitionJerkMode::Coupled;
        let weight =
            if coupled { axis.a_trans_ratio.max(axis.r_trans_ratio) } else { axis.a_trans_ratio };
        weight * acc_fact
    } else {
        let ramp = longest_ramp(axis, rapid);
        if ramp > cycle.seconds() { cycle.seconds() / ramp } else { 1.0 }
    }
}

/// The velocity jumps that a kink between two blocks may cause.
pub(crate) struct Jumps<'a> {
    from: &'a Block,
    /// The block after the kink, unless its limits are those of the block before.
    to: Option<&'a Block>,
    cycle: CycleTime,
    kernel_active: bool,
}

impl<'a> Jumps<'a> {
    pub(crate) fn between(
        from: &'a Block,
        to: &'a Block,
        cycle: CycleTime,
        kernel_active: bool,
    ) -> Self {
        let alike = Arc::ptr_eq(&from.dynamics, &to.dynamics)
            && from.slope == to.slope
            && is_rapid(from) == is_rapid(to)
            && from.tolerance.acc_fact.to_bits() == to.tolerance.acc_fact.to_bits();
        Self { from, to: (!alike).then_some(to), cycle, kernel_active }
    }

    /// The jump of one axis in mm/s.
    pub(crate) fn of(&self, i: usize) -> f64 {
        let jump = self.in_block(self.from, i);
        self.to.map_or(jump, |to| jump.min(self.in_block(to, i)))
    }

    fn in_block(&self, b: &Block, i: usize) -> f64 {
        let t = self.cycle.seconds();
        let fact = if self.kernel_active { b.tolerance.acc_fact } else { 1.0 };
        let acc = if b.dynamics.transition_jerk == TransitionJerkMode::DirectJerk
            && b.slope.kind != SlopeKind::Step
        {
            let axis = &b.dynamics.axes[i];
            (axis.j_trans_kink_mm_s3 * t).min(contour_acceleration(axis, b.slope, is_rapid(b)))
        } else {
            kink_acceleration(b, i, self.cycle, fact)
        };
        acc * t
    }
}

/// Velocity in mm/s at a kink with the tangents `out` of the block before and `into` of the block after it.
pub(crate) fn kink_velocity(
    from: &Block,
    to: &Block,
    out: &[f64],
    into: &[f64],
    cycle: CycleTime,
    kernel_active: bool,
) -> f64 {
    let jumps = Jumps::between(from, to, cycle, kernel_active);
    let mut v = f64::INFINITY;
    let (mut dot, mut n_out, mut n_in, mut jump2) = (0.0, 0.0, 0.0, 0.0);
    let into = &into[..out.len()];
    for i in 0..out.len() {
        let du = (into[i] - out[i]).abs();
        dot += into[i] * out[i];
        n_out += out[i] * out[i];
        n_in += into[i] * into[i];
        jump2 += du * du;
        if du > TANGENT {
            v = v.min(jumps.of(i) / du);
        }
    }
    // a reversal is a stop: the axes pass through zero speed there in any case
    if dot <= -(n_out * n_in).sqrt() * (1.0 - 1e-12) {
        return 0.0;
    }
    let lift =
        from.dynamics.transition_velocity_min_mm_s.min(to.dynamics.transition_velocity_min_mm_s);
    if !to.dynamics.limit_tangential_jerk {
        v = v.max(lift);
    }
    if jump2.sqrt() > TANGENT {
        for d in [&from.dynamics, &to.dynamics] {
            if let Some(acc) = d.vector.trans_acc_mm_s2 {
                v = v.min(acc * cycle.seconds() / jump2.sqrt());
            }
        }
    }
    v
}

/// Velocity in mm/s at a transition with a curvature jump (P-CHAN-00009 = 1, non-linear slopes). The axis acceleration
/// jumps by `v^2 |dq''|`, which P-AXIS-00154 or P-AXIS-00340 limits.
pub(crate) fn curvature_step_velocity(
    from: &Block,
    to: &Block,
    a: &Ends,
    b: &Ends,
    cycle: CycleTime,
) -> f64 {
    if !to.dynamics.limit_tangential_jerk
        || from.slope.kind == SlopeKind::Step
        || to.slope.kind == SlopeKind::Step
    {
        return f64::INFINITY;
    }
    // what is inserted in place of a kink counts as straight
    let curvature = |block: &Block, ends: &Ends, at: usize, i: usize| {
        ends.curvatures.as_ref().filter(|_| !block.tangential).map_or(0.0, |c| c[at][i])
    };
    if a.curvatures.is_none() && b.curvatures.is_none() {
        return f64::INFINITY;
    }
    let t = cycle.seconds();
    let mut v2 = f64::INFINITY;
    for i in 0..a.tangent_out.len() {
        let dk = (curvature(to, b, 0, i) - curvature(from, a, 1, i)).abs();
        if dk <= TANGENT {
            continue;
        }
        for block in [from, to] {
            let axis = &block.dynamics.axes[i];
            let acc = contour_acceleration(axis, block.slope, is_rapid(block));
            let jump = if block.dynamics.transition_jerk == TransitionJerkMode::DirectJerk {
                (axis.j_trans_tangential_mm_s3 * t).min(acc)
            } else if axis.r_trans_ratio > 0.0 {
                axis.r_trans_ratio * acc
            } else {
                let ramp = longest_ramp(axis, is_rapid(block));
                if ramp > t { acc * t / ramp } else { acc }
            };
            v2 = v2.min(jump / dk);
        }
    }
    v2.sqrt()
}

/// P-CHAN-00245: curvature at the joint of two lines, estimated by the circle through the three points.
///
/// `kappa = 2 sin(alpha) / |P2 - P0|`. Mode 1 limits `v^2 kappa` by the acceleration of the axes in the direction of
/// the curvature, mode 2 limits `v^3 kappa^2` by their geometric jerk. Mode 3 limits `v^2 kappa` by the weakest moving
/// axis in every direction, so that a circle has a single speed (source: TF5200, P-CHAN-00245; Assumption: the
/// estimator).
pub(crate) fn estimated_curvature_velocity(from: &Block, to: &Block, a: &Ends, b: &Ends) -> f64 {
    let mode = to.dynamics.curvature_estimate;
    if mode == 0 || !from.path.is_straight() || !to.path.is_straight() {
        return f64::INFINITY;
    }
    let (mut cross2, mut dot, mut chord2) = (0.0, 0.0, 0.0);
    let n = a.tangent_out.len();
    for i in 0..n {
        dot += a.tangent_out[i] * b.tangent_in[i];
        let c = to.path.end()[i] - from.path.start()[i];
        chord2 += c * c;
        for k in i + 1..n {
            let c = a.tangent_out[i] * b.tangent_in[k] - a.tangent_out[k] * b.tangent_in[i];
            cross2 += c * c;
        }
    }
    let sin = libm::sin(libm::atan2(cross2.sqrt(), dot));
    let kappa = 2.0 * sin / chord2.sqrt();
    if kappa <= TANGENT {
        return f64::INFINITY;
    }
    // the change of direction is along (b - a); its components share the centripetal acceleration
    let jump: AxisVec = (0..n).map(|i| b.tangent_in[i] - a.tangent_out[i]).collect();
    let norm = jump.iter().map(|c| c * c).sum::<f64>().sqrt();
    let moves = |i: usize| {
        [jump[i], a.tangent_out[i], b.tangent_in[i]][..if mode == 3 { 3 } else { 1 }]
            .iter()
            .any(|c| c.abs() > TANGENT)
    };
    (0..n)
        .filter(|&i| moves(i))
        .map(|i| {
            let axis = &to.dynamics.axes[i];
            let acc = contour_acceleration(axis, to.slope, is_rapid(to));
            if mode == 3 {
                return (acc / kappa).sqrt();
            }
            let share = jump[i].abs() / norm;
            if mode == 2 && axis.tr_geom_s > 0.0 {
                libm::cbrt(acc / (axis.tr_geom_s * kappa * kappa * share))
            } else {
                (acc / (kappa * share)).sqrt()
            }
        })
        .fold(f64::INFINITY, f64::min)
}

/// Velocity cap at the boundary of two blocks with its reason; the programmed velocities of the blocks and at their ends are not
/// included.
pub fn transition(
    from: &Block,
    to: &Block,
    a: &Ends,
    b: &Ends,
    cycle: CycleTime,
    kernel_active: bool,
) -> Cap {
    let mut cap = Cap::new(f64::INFINITY, SpeedLimit::Feed);
    let mut take = |v: f64, why: SpeedLimit| cap = cap.lower(Cap::new(v, why));
    take(
        kink_velocity(from, to, &a.tangent_out, &b.tangent_in, cycle, kernel_active),
        SpeedLimit::Corner,
    );
    take(curvature_step_velocity(from, to, a, b, cycle), SpeedLimit::Curve);
    take(estimated_curvature_velocity(from, to, a, b), SpeedLimit::Curve);
    if to.dynamics.stop_at_transitions {
        take(0.0, SpeedLimit::Stop);
    }
    cap
}
