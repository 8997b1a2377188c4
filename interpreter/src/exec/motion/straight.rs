//! The short way of plain straight motions: `N10 G01 X1 Y2 F500` in a row, without a tree and without the words in between.
//!
//! It says and does what [`Decoder::execute_words`] does with the same words, which the tests compare. What the motions of
//! a row have in common is worked out once and holds until another kind of block comes.

use super::InPlane;
use super::state::Straight;
use crate::exec::block::modal::{Compensation, FeedType, PathMode};
use crate::exec::decoder::Decoder;
use crate::exec::fault::Outcome;
use crate::exec::geometry::coordinates::Target;
use crate::syntax::ast::Span;
use crate::syntax::{Plain, PlainValue};
use kontur_motion::block::{Block, Feed};
use kontur_motion::path::{LinePath, Path};
use smallvec::SmallVec;
use std::sync::Arc;

/// The words of a block.
#[derive(Default)]
struct Words {
    path: Option<PathMode>,
    feed: Option<(f64, Span)>,
    targets: SmallVec<[Target; 8]>,
    places: SmallVec<[Span; 8]>,
}

impl Decoder {
    /// Executes a plain block that is nothing but a straight motion, with what it has in common with the block before if
    /// that was one, too. False, and nothing done, if it is more than that.
    pub(in crate::exec) fn straight_motion(
        &mut self,
        plain: &Plain,
        mut shared: Option<Box<Straight>>,
    ) -> bool {
        if shared.is_none() && !self.is_straight() {
            return false;
        }
        let mut words = Words::default();
        if self.straight_words(plain, &mut words).is_none() || words.targets.is_empty() {
            return false;
        }
        let path_mode = words.path.unwrap_or(self.modal.path);
        let feed = words.feed.map_or(self.modal.feed().map(|word| word.value), |(f, _)| Some(f));
        let stops = path_mode == PathMode::Rapid && self.machine.channel.exact_stop_after_g00;
        let moves = match path_mode {
            PathMode::Rapid => !stops,
            PathMode::Linear => feed.is_some_and(|f| f > 0.0),
            _ => false,
        };
        let fits = words.feed.is_none_or(|(f, _)| (0.0..=1e9).contains(&f));
        if !moves || !fits {
            return false;
        }
        let before = (self.modal.path, self.modal.feed());
        self.modal.path = path_mode;
        if let Some(feed) = words.feed {
            let outcome = self.feed(feed);
            self.report.keep(outcome);
        }
        if before != (self.modal.path, self.modal.feed()) {
            shared = None;
        }
        self.straight = self.straight_path(&words, shared, plain.span);
        true
    }

    /// Whether straight motions are nothing but that in the present state.
    fn is_straight(&self) -> bool {
        let modal = &self.modal;
        !modal.inch
            && !modal.exact_stop
            && !modal.contouring
            && !self.motion.threads.cutting
            && !self.motion.left_contour
            && !self.contour.akima.selected
            && !self.motion.contour_line.is_open()
            && self.motion.cutting.speed.is_none()
            && !modal.late_braking
            && !modal.corner_deceleration
            && modal.compensation == Compensation::Off
            && modal.diameter.is_none()
            && modal.feed_type == FeedType::PerMinute
            && modal.feed().is_none_or(|word| !word.inch)
            && self.calls.modal_cycle.is_none()
            && self.motion.independent.is_unused()
            && self.motion.couplings.are_off()
            && self.motion.overrides.are_alike()
            && self.geometry.coordinates.frame().is_identity()
    }

    /// G00 or G01, F and axes; `None` if there is anything else, or twice the same.
    fn straight_words(&self, plain: &Plain, words: &mut Words) -> Option<()> {
        for word in &plain.words {
            let value = match &word.value {
                PlainValue::Code(code) => {
                    let mode = match (word.letter, code) {
                        (b'G', 0) => PathMode::Rapid,
                        (b'G', 1) => PathMode::Linear,
                        _ => return None,
                    };
                    if words.path.replace(mode).is_some() {
                        return None;
                    }
                    continue;
                }
                PlainValue::Number(value) => *value,
                PlainValue::Sum(sum) => self.number(sum).ok()?,
            };
            match self.names.of_letter(word.letter) {
                Some(axis) if !self.machine.axes[axis].is_modulo() => {
                    if words.targets.iter().any(|t| t.axis == axis) {
                        return None;
                    }
                    words.targets.push(Target { axis, value, absolute: self.modal.absolute });
                    words.places.push(word.span);
                }
                None if word.letter == b'F' && words.feed.is_none() => {
                    words.feed = Some((value, word.span));
                }
                _ => return None,
            }
        }
        Some(())
    }

    /// The motion to the targets of a block; what it shares with the next one comes back.
    fn straight_path(
        &mut self,
        words: &Words,
        shared: Option<Box<Straight>>,
        span: Span,
    ) -> Option<Box<Straight>> {
        let coordinates = &mut self.geometry.coordinates;
        let start = coordinates.target().clone();
        coordinates.program(&words.targets);
        let end = coordinates.target().clone();
        let Some(line) = LinePath::new(start, end, &self.motion.feed_axes) else { return shared };
        let path = Path::Line(line);
        let place = |axis| {
            let mut words = words.targets.iter().zip(&words.places);
            words.find(|(target, _)| target.axis == axis).map(|(_, at)| *at)
        };
        self.check_limits(&path, place, span);
        let shared = if let Some(shared) = shared {
            shared
        } else {
            let outcome = self.share(&path, words.places.first().copied().unwrap_or(span));
            self.report.keep(outcome)?
        };
        // of a block with an error nothing moves
        if self.report.failed() && !self.checking {
            return Some(shared);
        }
        let block = Box::new(Block {
            seq: 0,
            path,
            feed: shared.feed,
            feed_ratio: shared.feed_ratio,
            full_override: false,
            end_velocity_mm_s: None,
            late_braking: false,
            slope: shared.slope,
            dynamics: Arc::clone(&shared.dynamics),
            tolerance: shared.tolerance,
            contour: shared.contour,
            spline: shared.spline,
        });
        let in_plane = InPlane { plane: shared.plane, tilt: None, compensation: None };
        self.send(block, in_plane, None, span);
        Some(shared)
    }

    /// What holds for this motion and those that follow.
    fn share(&mut self, path: &Path, at: Span) -> Outcome<Box<Straight>> {
        let feed = self.feed_of(path, at)?;
        let rapid = feed == Feed::Rapid;
        let InPlane { plane, .. } = self.in_plane(at)?;
        Ok(Box::new(Straight {
            feed,
            feed_ratio: self.motion.overrides.ratio(rapid, 0..1),
            slope: self.modal.slope,
            dynamics: self.motion.dynamics(&self.machine, &self.modal, rapid),
            tolerance: self.shaping.tolerance(),
            contour: self.contour.hsc.contour(),
            spline: self.contour.hsc.spline(),
            plane,
        }))
    }
}
