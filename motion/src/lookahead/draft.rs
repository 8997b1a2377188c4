//! A plan that is made again and again under limits of which few change: what it was made for stays with it.

use super::Span;
use crate::cap::Cap;
use crate::queue::Queued;
use std::sync::Arc;

/// A plan with what it was made for: where that stays as it is, so does the plan.
#[derive(Default)]
pub(crate) struct Draft {
    pub(crate) spans: Vec<Span>,
    /// The plan with acceleration zero at its knots, where some of them are passed with another one.
    flat: Option<Vec<Span>>,
    blocks: Vec<Arc<Queued>>,
    feeds: Vec<Cap>,
    caps: Vec<Cap>,
}

impl Draft {
    /// `passing`: what takes the place of a plan, see [`super::passing`].
    pub(super) fn new(
        spans: Vec<Span>,
        passing: Option<Vec<Span>>,
        blocks: &[Arc<Queued>],
        (feeds, caps): (&[Cap], &[Cap]),
    ) -> Self {
        let (spans, flat) = match passing {
            Some(passing) => (passing, Some(spans)),
            None => (spans, None),
        };
        Self { spans, flat, blocks: blocks.to_vec(), feeds: feeds.to_vec(), caps: caps.to_vec() }
    }

    /// A plan of which nothing can be used again.
    pub(super) fn of_spans(spans: Vec<Span>) -> Self {
        Self { spans, ..Self::default() }
    }

    /// The spans inside which nothing else is allowed now.
    pub(super) fn left(
        &self,
        blocks: &[Arc<Queued>],
        (feeds, caps): (&[Cap], &[Cap]),
    ) -> Vec<Span> {
        let same = |i: usize| {
            let [now, before] = [blocks, &self.blocks].map(|list| list.get(i));
            now.zip(before).is_some_and(|(a, b)| Arc::ptr_eq(a, b)) && feeds[i] == self.feeds[i]
        };
        let stays = |span: &&Span| {
            let inside = span.first + 1..span.end;
            (span.first..span.end).all(same) && caps[inside.clone()] == self.caps[inside]
        };
        self.flat.as_ref().unwrap_or(&self.spans).iter().filter(stays).cloned().collect()
    }
}

#[cfg(test)]
mod tests {
    #[expect(unreachable_pub, reason = "written for examples, which are outside of the crate")]
    mod doc {
        include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs"));
    }

    use crate::cap::{Cap, SpeedLimit};
    use crate::lookahead::plan_again;
    use crate::queue::Queued;
    use doc::{Arc, block};
    use kontur_filters::time::CycleTime;
    use proptest::prelude::*;

    proptest! {
        /// Random blocks whose limits are lowered here and there, round after round: a plan made again is to the bit the one
        /// made from nothing.
        #[test]
        fn a_plan_made_again_is_the_plan_made_anew(
            lengths in prop::collection::vec(0.05..3.0f64, 2..40),
            caps in prop::collection::vec(1.0..120.0f64, 40),
            lowered in prop::collection::vec((0..40usize, 0.5..1.0f64, any::<bool>()), 1..12),
        ) {
            let cycle = CycleTime::from_us(1000).unwrap();
            let mut x = 0.0;
            let blocks = lengths.iter().zip(1..).map(|(length, seq)| {
                let from = x;
                x += length;
                Arc::new(Queued::new(block(seq, [from, 0.0], [x, 0.0], 100.0), cycle))
            });
            let blocks: Vec<_> = blocks.collect();
            let n = blocks.len();
            let mut feeds: Vec<Cap> = blocks.iter().map(|b| b.velocity).collect();
            let mut caps: Vec<Cap> =
                caps[..n].iter().map(|v| Cap::new(*v, SpeedLimit::Corner)).chain([Cap::STOP]).collect();
            let mut draft = None;
            for (at, ratio, feed) in lowered {
                let limit = if feed { &mut feeds[at % n] } else { &mut caps[at % n] };
                limit.v_mm_s *= ratio;
                let forced = vec![false; n + 1];
                let plan = |before| {
                    let start = (Cap::STOP, 0.0);
                    plan_again(&blocks, (&feeds, &caps), &forced, start, SpeedLimit::Stop, before)
                };
                let (anew, again) = (plan(None).unwrap(), plan(draft.as_ref()).unwrap());
                prop_assert_eq!(anew.spans.len(), again.spans.len());
                for (a, b) in anew.spans.iter().zip(&again.spans) {
                    prop_assert_eq!((a.first, a.end, a.why_up, a.why_down), (b.first, b.end, b.why_up, b.why_down));
                    prop_assert!(a.profile == b.profile);
                }
                draft = Some(again);
            }
        }
    }
}
