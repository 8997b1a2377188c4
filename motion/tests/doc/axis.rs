// Hidden part of the examples in the documentation: an axis of 1 m/s and 3500 mm/s2, ramps of 30 ms, and a line in X and Y.
pub use kontur_motion::axis::{AxisDynamics, AxisVec, FeedSlope, FeedholdSlope, RapidSlope, StepSlope};
pub use kontur_motion::block::{Block, ChannelDynamics, Feed};
pub use kontur_motion::path::{LinePath, Path};
pub use std::sync::Arc;

pub fn axis() -> AxisDynamics {
    let step = StepSlope { acc_mm_s2: [3500.0; 2], dec_mm_s2: [3500.0; 2], change_mm_s: 1000.0 };
    AxisDynamics {
        v_max_mm_s: 1000.0,
        v_rapid_mm_s: 1000.0,
        a_max_mm_s2: 6000.0,
        a_emergency_mm_s2: 6000.0,
        tr_geom_s: 0.01,
        feed: FeedSlope { acc_mm_s2: 3500.0, dec_mm_s2: 3500.0, ramps_s: [0.03; 4] },
        rapid: RapidSlope { acc_mm_s2: 4000.0, ramp_s: 0.03 },
        step_feed: step,
        step_rapid: step,
        feedhold: FeedholdSlope { step_dec_mm_s2: 3500.0, dec_mm_s2: 3500.0, ramp_s: 0.03 },
        a_trans_ratio: 1.0,
        r_trans_ratio: 1.0,
        j_trans_kink_mm_s3: 1e6,
        j_trans_tangential_mm_s3: 1e6,
    }
}

pub fn line(from: [f64; 2], to: [f64; 2]) -> Path {
    let [from, to] = [from, to].map(|p| AxisVec::from_slice(&p));
    Path::Line(LinePath::new(from, to, &[true; 2]).unwrap())
}

pub fn block(seq: u64, from: [f64; 2], to: [f64; 2], feed_mm_s: f64) -> Block {
    let dynamics = Arc::new(ChannelDynamics::new(vec![axis(); 2]));
    Block::new(seq, line(from, to), Feed::PathVelocity(feed_mm_s), dynamics)
}
