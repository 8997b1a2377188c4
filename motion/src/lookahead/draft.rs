//! A plan that is made repeatedly, under limits of which few change or with more blocks appended, stored together with
//! its inputs.
//!
//! The profile of a span depends on its blocks, their feed rates, the caps of the boundaries inside and the speeds at
//! its ends; that of the first span also on its start acceleration. It does not depend on which other boundaries are
//! knots: spans are looked up by their ends.

use super::Span;
use super::outline::{Outline, follow};
use crate::cap::Cap;
use crate::queue::Queued;
use std::sync::Arc;

/// A plan with its inputs: spans with unchanged inputs are reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct Draft {
    pub(crate) spans: Vec<Span>,
    /// The plan with zero acceleration at its knots, if some of them are passed with a different one.
    flat: Option<Vec<Span>>,
    /// Acceleration in mm/s2 at the start of the span of the first block.
    a_start: f64,
    blocks: Vec<Outline>,
    feeds: Vec<Cap>,
    caps: Vec<Cap>,
}

impl Draft {
    /// Takes over a window with its limits, and keeps the spans whose limits stay the same inside.
    pub(super) fn follow(
        &mut self,
        a_start: f64,
        blocks: &[Arc<Queued>],
        (feeds, caps): (&[Cap], &[Cap]),
    ) {
        if let Some(flat) = self.flat.take() {
            self.spans = flat;
        }
        let begins_as_before = a_start.to_bits() == self.a_start.to_bits();
        let same = |i: usize| {
            let known = blocks.get(i).zip(self.blocks.get(i));
            known.is_some_and(|(a, b)| Arc::ptr_eq(a, &b.queued)) && feeds[i] == self.feeds[i]
        };
        self.spans.retain(|span| {
            let inside = span.first + 1..span.end;
            (begins_as_before || span.first > 0)
                && (span.first..span.end).all(same)
                && caps[inside.clone()] == self.caps[inside]
        });
        self.a_start = a_start;
        follow(&mut self.blocks, blocks);
        feeds.clone_into(&mut self.feeds);
        caps.clone_into(&mut self.caps);
    }

    /// The blocks of the window.
    pub(super) fn blocks(&self) -> &[Outline] {
        &self.blocks
    }

    /// `passing`: the plan that replaces `spans`, see [`super::passing`].
    pub(super) fn keep(&mut self, spans: Vec<Span>, passing: Option<Vec<Span>>) {
        (self.spans, self.flat) = match passing {
            Some(passing) => (passing, Some(spans)),
            None => (spans, None),
        };
    }

    /// A plan without reusable spans.
    pub(super) fn of_spans(spans: Vec<Span>) -> Self {
        Self { spans, ..Self::default() }
    }

    /// Drops the first `count` blocks, which are now before the start.
    pub(crate) fn pass(&mut self, count: usize) {
        if count == 0 {
            return;
        }
        if count >= self.blocks.len() {
            *self = Self::default();
            return;
        }
        if let Some(flat) = self.flat.take() {
            self.spans = flat;
        }
        self.spans.retain_mut(|span| {
            let ahead = span.first >= count;
            if ahead {
                (span.first, span.end) = (span.first - count, span.end - count);
            }
            ahead
        });
        // between spans the acceleration is zero
        self.a_start = 0.0;
        self.blocks.drain(..count);
        self.feeds.drain(..count);
        self.caps.drain(..count);
    }
}

#[cfg(test)]
mod tests {
    use super::Draft;
    use crate::block::{Slope, SlopeKind};
    use crate::cap::{Cap, SpeedLimit};
    use crate::example::{Arc, block};
    use crate::lookahead::plan_again;
    use crate::queue::Queued;
    use kontur_filters::time::CycleTime;
    use proptest::prelude::*;

    /// Chords of these lengths and directions; the path acceleration differs from one to the next.
    fn contour(slope: Slope, chords: &[(f64, f64)]) -> Vec<Arc<Queued>> {
        let cycle = CycleTime::from_us(1000).unwrap();
        let mut at = [0.0, 0.0];
        let blocks = chords.iter().zip(1..).map(|((length, angle), seq)| {
            let from = at;
            at = [at[0] + length * libm::cos(*angle), at[1] + length * libm::sin(*angle)];
            let block = block(seq, from, at, 100.0);
            Arc::new(Queued::new(crate::block::Block { slope, ..block }, cycle))
        });
        blocks.collect()
    }

    fn slopes() -> impl Strategy<Value = Slope> {
        let kinds = [SlopeKind::Step, SlopeKind::Trapez, SlopeKind::Sin2, SlopeKind::Hsc];
        (prop::sample::select(kinds.to_vec()), any::<bool>(), any::<bool>()).prop_map(
            |(kind, optimised, constant_ramp_time)| Slope { kind, optimised, constant_ramp_time },
        )
    }

    /// The caps before the blocks, with a stop after the last one.
    fn closed(caps: &[f64]) -> Vec<Cap> {
        let corner = |v: &f64| Cap::new(*v, SpeedLimit::Corner);
        caps.iter().map(corner).chain([Cap::STOP]).collect()
    }

    /// Plans once from scratch and once with a draft.
    fn twice(
        blocks: &[Arc<Queued>],
        limits: (&[Cap], &[Cap]),
        start: (Cap, f64),
        before: Draft,
    ) -> Result<Option<Draft>, TestCaseError> {
        let forced = vec![false; blocks.len() + 1];
        let plan =
            |before: Draft| plan_again(blocks, limits, &forced, start, SpeedLimit::Stop, before);
        let (anew, again) = match (plan(Draft::default()), plan(before)) {
            (Ok(anew), Ok(again)) => (anew, again),
            (anew, again) => {
                prop_assert!(anew.is_err() && again.is_err());
                return Ok(None);
            }
        };
        prop_assert_eq!(anew.spans.len(), again.spans.len());
        for (a, b) in anew.spans.iter().zip(&again.spans) {
            prop_assert_eq!(
                (a.first, a.end, a.why_up, a.why_down),
                (b.first, b.end, b.why_up, b.why_down)
            );
            prop_assert!(a.profile == b.profile);
        }
        Ok(Some(again))
    }

    proptest! {
        /// Random blocks, some of whose limits are lowered in each round: a plan with a draft equals the one from
        /// scratch bit for bit.
        #[test]
        fn a_plan_made_again_is_the_plan_made_anew(
            slope in slopes(),
            chords in prop::collection::vec((0.05..3.0f64, 0.0..1.5f64), 2..40),
            caps in prop::collection::vec(1.0..120.0f64, 40),
            lowered in prop::collection::vec((0..40usize, 0.5..1.0f64, any::<bool>()), 1..12),
        ) {
            let blocks = contour(slope, &chords);
            let n = blocks.len();
            let mut feeds: Vec<Cap> = blocks.iter().map(|b| b.velocity).collect();
            let mut caps = closed(&caps[..n]);
            let mut draft = None;
            for (at, ratio, feed) in lowered {
                let limit = if feed { &mut feeds[at % n] } else { &mut caps[at % n] };
                limit.v_mm_s *= ratio;
                draft = twice(&blocks, (&feeds, &caps), (Cap::STOP, 0.0), draft.unwrap_or_default())?;
            }
        }

        /// A window that moves along a random contour and sometimes stops inside a span, with the acceleration of the
        /// path there: reusing the earlier plan changes no bit.
        #[test]
        fn a_plan_whose_window_moves_on_is_the_plan_made_anew(
            slope in slopes(),
            chords in prop::collection::vec((0.05..3.0f64, 0.0..1.5f64), 100),
            caps in prop::collection::vec(prop_oneof![1.0..120.0f64, 90.0..120.0f64], 100),
            moves in prop::collection::vec((0..25usize, 1..25usize), 1..8),
        ) {
            let blocks = contour(slope, &chords);
            let (mut first, mut end) = (0, 20);
            let (mut start, mut draft) = ((Cap::STOP, 0.0), None::<Draft>);
            for (passed, more) in moves {
                let window = &blocks[first..end];
                let feeds: Vec<Cap> = window.iter().map(|b| b.velocity).collect();
                let planned = twice(window, (&feeds, &closed(&caps[first..end])), start, draft.take().unwrap_or_default())?;
                let Some(mut planned) = planned else { break };
                let passed = passed.min(end - first - 1);
                if let Some(span) = planned.spans.iter().find(|s| s.first < passed && passed <= s.end) {
                    let s_mm = window[span.first..passed].iter().map(|b| b.length).sum();
                    let parted = (passed < span.end).then(|| span.profile.split(s_mm));
                    let Some((profile, _)) = parted.unwrap_or_else(|| Some((span.profile.clone(), span.profile.clone()))) else {
                        break;
                    };
                    let state = profile.end();
                    start = (Cap::new(state.v_mm_s, span.why_down), state.a_mm_s2);
                }
                planned.pass(passed);
                draft = Some(planned);
                (first, end) = (first + passed, (end + more).min(blocks.len()));
            }
        }
    }
}
