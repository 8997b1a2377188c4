//! Feed rates that change along a motion: corner deceleration (G13), interpolation of the feed rate (G193, G293), and feed rates
//! per revolution under a constant cutting speed (G95 under G96).
//!
//! A motion is divided where its feed rate has changed by one percent. Each piece has the lower of the feed rates at its ends,
//! so that the path is never faster than the printed line; under G95, their mean. The path with tool radius compensation is
//! divided. The pieces are one motion: G116 stops at its ends alone.
//!
//! Source: TF5200 programming manual 206444555, 206449675 (G13: linear along the corrected path, slope STEP only, from the
//! first motion after G13 on), 15556679307 (G193: linear along the path; G293: linear over the time, slope STEP).
//! Assumptions on G13, where the pages are silent: every end of a motion at feed rate is a corner, whatever its angle; after it
//! the path is as fast as its limits allow; elements inserted by the compensation end in the same way as the motion before
//! them.

use super::item::Item;
use super::motion::{Corner, CornerFeed, FeedCourse, Motion};
use kontur_motion::block::{Block, ChannelDynamics, Feed};
use kontur_motion::path::Path;
use std::sync::Arc;

/// Ratio of the speeds of two consecutive pieces of a motion whose speed changes along it.
pub(super) const STEP: f64 = 1.01;

/// Maximum number of pieces of one motion: a speed range of 1 to 20,000; for a larger range the pieces are coarser.
pub(super) const PIECES_MAX: u32 = 1000;

/// The part of a motion with a changing feed rate.
struct Change {
    /// Path lengths in mm.
    at: [f64; 2],
    /// Feed rates at these lengths in mm/s.
    feed: [f64; 2],
    over_time: bool,
}

impl Change {
    fn of(course: FeedCourse, feed: f64, length: f64) -> Option<Self> {
        let (from, over_time) = match course {
            FeedCourse::Corner(Corner { dist_mm, feed: at_corner }) => {
                let end = match at_corner {
                    CornerFeed::Ratio(ratio) => feed * ratio,
                    CornerFeed::MmS(end) => end,
                };
                let falls = dist_mm.min(length);
                let begin = end + (feed - end) * falls / dist_mm;
                let at = [length - falls, length];
                return (end < feed).then_some(Self { at, feed: [begin, end], over_time: false });
            }
            FeedCourse::OverPath(from) => (from, false),
            FeedCourse::OverTime(from) => (from, true),
            FeedCourse::PerRevolution(_) => return None,
        };
        Some(Self { at: [0.0, length], feed: [from, feed], over_time })
    }

    /// Path length at which the feed rate is `v`. At constant acceleration its square is linear in the distance.
    fn place(&self, v: f64) -> f64 {
        let power = |v: f64| if self.over_time { v * v } else { v };
        let [a, b] = self.feed.map(power);
        self.at[0] + (power(v) - a) / (b - a) * (self.at[1] - self.at[0])
    }

    /// Ends and feed rates of the pieces.
    fn pieces(&self) -> Vec<(f64, f64)> {
        let ratio = self.feed[1] / self.feed[0];
        let count =
            (libm::log(ratio).abs() / libm::log(STEP)).ceil().min(f64::from(PIECES_MAX)) as u32;
        let v = |k: u32| self.feed[0] * libm::pow(ratio, f64::from(k) / f64::from(count));
        let end = |k: u32| if k == count { self.at[1] } else { self.place(v(k)) };
        (1..=count).map(|k| (end(k), v(k - 1).min(v(k)))).collect()
    }
}

/// Ends and feed rates of the pieces of a path; `None` if the feed rate is constant.
fn divided(course: FeedCourse, feed: f64, path: &Path) -> Option<Vec<(f64, f64)>> {
    if let FeedCourse::PerRevolution(course) = course {
        return course.pieces(path);
    }
    let change = Change::of(course, feed, path.length())?;
    let mut ends = vec![(change.at[0], feed)];
    ends.extend(change.pieces());
    Some(ends)
}

/// The pieces of a motion; it is not divided if its feed rate is constant.
pub(super) fn pieces(motion: Box<Motion>) -> Vec<Item> {
    let (Some(course), Feed::PathVelocity(feed)) = (motion.course, motion.block.feed) else {
        return vec![Item::Motion(motion)];
    };
    let Some(ends) = divided(course, feed, &motion.block.path) else {
        return vec![Item::Motion(motion)];
    };
    let last = ends.last().map_or(0.0, |(to, _)| *to);
    let inside = inside(&motion.block.dynamics);
    let mut pieces = Vec::with_capacity(ends.len());
    let mut from = 0.0;
    for (to, feed) in ends {
        if to <= from {
            continue;
        }
        let block = &motion.block;
        let Some(path) = block.path.section(from, to) else {
            return vec![Item::Motion(motion)];
        };
        let end_velocity_mm_s = block.end_velocity_mm_s.filter(|_| to >= last);
        let feed = Feed::PathVelocity(feed);
        let is_first = pieces.is_empty();
        let dynamics = Arc::clone(if is_first { &block.dynamics } else { &inside });
        let block =
            Box::new(Block { path, feed, end_velocity_mm_s, dynamics, ..(**block).clone() });
        let events = if is_first { motion.events.clone() } else { Vec::new() };
        pieces.push(Item::Motion(Box::new(Motion { block, events, ..(*motion).clone() })));
        from = to;
    }
    if pieces.is_empty() { vec![Item::Motion(motion)] } else { pieces }
}

/// The limits of the pieces after the first one: the transition to them is none of the program (G116).
fn inside(dynamics: &Arc<ChannelDynamics>) -> Arc<ChannelDynamics> {
    if !dynamics.stop_at_transitions {
        return Arc::clone(dynamics);
    }
    Arc::new(ChannelDynamics { stop_at_transitions: false, ..(**dynamics).clone() })
}
