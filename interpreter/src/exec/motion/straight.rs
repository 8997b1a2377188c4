//! The fast route for consecutive plain straight motions, such as `N10 G01 X1 Y2 F500`, without a syntax tree and collected
//! words.
//!
//! It reports and does the same as [`Decoder::execute_words`] for the same words; the tests compare both. Everything that
//! consecutive motions have in common is computed once, and reused until another kind of block follows.

use super::plane::InPlane;
use super::state::Straight;
use crate::exec::block::choice::{Compensation, FeedType, PathMode};
use crate::exec::block::modal::Modal;
use crate::exec::contour::PathOf;
use crate::exec::decoder::Decoder;
use crate::exec::fault::Outcome;
use crate::exec::geometry::coordinates::Target;
use crate::exec::output::output;
use crate::exec::values::number::LARGEST_MM;
use crate::machine::Channel;
use crate::machine::is_outside;
use crate::syntax::ast::Span;
use crate::syntax::{Plain, PlainValue, PlainWord};
use kontur_motion::axis::AxisVec;
use kontur_motion::block::{Block, Feed, SpareBlocks};
use kontur_motion::path::{LinePath, Path};
use smallvec::SmallVec;
use std::sync::Arc;

/// The words of a straight motion.
#[derive(Default)]
pub(in crate::exec) struct StraightWords {
    path: Option<PathMode>,
    feed: Option<(f64, Span)>,
    targets: SmallVec<[(Target, Span); 8]>,
    /// The whole block.
    pub(in crate::exec) span: Span,
}

impl Modal {
    /// Whether these words of a straight motion are complete.
    pub(in crate::exec) fn moves_straight(&self, words: &StraightWords, channel: &Channel) -> bool {
        let path_mode = words.path.unwrap_or(self.path);
        let feed = words.feed.map_or(self.feed().map(|word| word.value), |(f, _)| Some(f));
        let stops = path_mode == PathMode::Rapid && channel.language.exact_stop_after_g00;
        let moves = match path_mode {
            PathMode::Rapid => !stops,
            PathMode::Linear => feed.is_some_and(|f| f > 0.0),
            _ => false,
        };
        let fits = words.feed.is_none_or(|(f, _)| (0.0..=1e9).contains(&f));
        moves && fits && !words.targets.is_empty()
    }
}

impl StraightWords {
    /// The words of a plain block if it contains only a straight motion.
    pub(in crate::exec) fn read(decoder: &Decoder, plain: &Plain) -> Option<Self> {
        if !decoder.is_straight() {
            return None;
        }
        let mut words = Self { span: plain.frame.span, ..Self::default() };
        let all = plain.words.iter().all(|word| words.add(decoder, word));
        (all && decoder.modal.moves_straight(&words, &decoder.machine.channel)).then_some(words)
    }

    /// Adds a word of a straight motion: G00 or G01, F or an axis. Returns false for any other word, and for a repetition.
    #[expect(clippy::inline_always, reason = "a call for each word costs as much as the word")]
    #[inline(always)]
    pub(in crate::exec) fn add(&mut self, decoder: &Decoder, word: &PlainWord) -> bool {
        let value = match &word.value {
            PlainValue::Code(code) => {
                let mode = match (word.letter, code) {
                    (b'G', 0) => PathMode::Rapid,
                    (b'G', 1) => PathMode::Linear,
                    _ => return false,
                };
                return self.path.replace(mode).is_none();
            }
            PlainValue::Number(value) => *value,
            PlainValue::Sum(sum) => match decoder.number(sum) {
                Ok(value) => value,
                Err(_) => return false,
            },
        };
        match decoder.names.of_letter(word.letter) {
            Some(axis) if !decoder.machine.axes[axis].is_modulo() => {
                let twice = self.targets.iter().any(|(target, _)| target.axis == axis);
                let target = Target { axis, value, absolute: decoder.modal.absolute };
                self.targets.push((target, word.span));
                !twice && value.abs() <= LARGEST_MM
            }
            None if word.letter == b'F' => self.feed.replace((value, word.span)).is_none(),
            _ => false,
        }
    }
}

impl Straight {
    /// A block along a path.
    fn block(&self, path: Path) -> Block {
        let mut block = Block::new(0, path, self.feed, Arc::clone(&self.dynamics));
        self.hand_to(&mut block);
        block
    }

    /// A block from one position to another, if possible in the memory of an earlier one; `None` if no axis moves.
    #[inline]
    fn block_between(
        &self,
        (start, end): (&AxisVec, &AxisVec),
        feed_axes: &[bool],
        spare: &mut SpareBlocks,
    ) -> Option<Box<Block>> {
        if let Some(mut block) = spare.take() {
            if !block.path.lead(start, end, feed_axes) {
                return None;
            }
            self.hand_to(&mut block);
            return Some(block);
        }
        let line = LinePath::new(start.clone(), end.clone(), feed_axes)?;
        Some(Box::new(self.block(Path::Line(line))))
    }

    /// Gives a block everything but its path.
    fn hand_to(&self, block: &mut Block) {
        let Block {
            seq,
            path: _,
            feed,
            feed_ratio,
            full_override,
            end_velocity_mm_s,
            late_braking,
            slope,
            dynamics,
            tolerance,
            contour,
            spline,
            tangential,
        } = block;
        (*seq, *end_velocity_mm_s) = (0, None);
        (*full_override, *late_braking, *tangential) = (false, false, false);
        (*feed, *feed_ratio, *slope) = (self.feed, self.feed_ratio, self.slope);
        (*tolerance, *contour, *spline) = (self.tolerance, self.contour, self.spline);
        // counting its owners makes the threads wait for each other
        if !Arc::ptr_eq(dynamics, &self.dynamics) {
            *dynamics = Arc::clone(&self.dynamics);
        }
    }
}

impl Decoder {
    /// Executes a block of such words, together with what it has in common with the previous block if that was such a block,
    /// too. With `passed`, the program is only examined: a motion that has everything in common with the previous one does not
    /// become a step, and the time in s that the previous one takes is returned in it.
    pub(in crate::exec) fn straight_motion(
        &mut self,
        words: &StraightWords,
        mut shared: Option<Box<Straight>>,
        passed: Option<&mut Option<f64>>,
    ) {
        let before = (self.modal.path, self.modal.feed());
        self.modal.path = words.path.unwrap_or(self.modal.path);
        if let Some(feed) = words.feed {
            let outcome = self.modal.program_feed(feed, &mut self.report);
            self.report.keep(outcome);
        }
        if before != (self.modal.path, self.modal.feed()) {
            shared = None;
        }
        self.straight = match (passed, shared) {
            (Some(passed), Some(shared)) if self.contour.lets_by() => {
                *passed = self.pass_by(words, &shared);
                Some(shared)
            }
            (_, shared) => self.straight_path(words, shared),
        };
    }

    /// Whether straight motions need nothing else in the present state.
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
            && self.motion.areas.are_idle()
            && self.motion.overrides.are_alike()
            && self.geometry.coordinates.frame().is_identity()
            && !self.geometry.scale.is_on()
    }

    /// The motion to the targets of a block; returns what it shares with the next one.
    fn straight_path(
        &mut self,
        words: &StraightWords,
        shared: Option<Box<Straight>>,
    ) -> Option<Box<Straight>> {
        let coordinates = &mut self.geometry.coordinates;
        let start = coordinates.target().clone();
        let offsets = shared.as_ref().map(|shared| &shared.offsets[..]);
        coordinates.program_with(offsets, words.targets.iter().map(|(target, _)| *target));
        let (block, shared) = if let Some(shared) = shared {
            let ends = (&start, self.geometry.coordinates.target());
            let feed_axes = self.motion.limits.feed_axes();
            let Some(block) = shared.block_between(ends, feed_axes, &mut self.spare) else {
                return Some(shared);
            };
            self.check_line(&start, words);
            (block, shared)
        } else {
            let end = self.geometry.coordinates.target().clone();
            let path = Path::Line(LinePath::new(start, end, self.motion.limits.feed_axes())?);
            self.check_line(path.start(), words);
            let at = words.targets.first().map_or(words.span, |(_, at)| *at);
            let outcome = self.share(&path, at);
            let shared = self.report.keep(outcome)?;
            (self.spare.place(shared.block(path)), shared)
        };
        // a block with an error causes no motion
        if self.report.failed() && !self.checking {
            return Some(shared);
        }
        let in_plane = InPlane { plane: shared.plane, tilt: None, compensation: None };
        self.send(block, in_plane, None, words.span);
        Some(shared)
    }

    /// Replaces the previous motion by the motion to the targets of a block; returns the time of the previous one if there is a
    /// motion.
    fn pass_by(&mut self, words: &StraightWords, shared: &Straight) -> Option<f64> {
        let coordinates = &mut self.geometry.coordinates;
        let start = coordinates.target().clone();
        let targets = words.targets.iter().map(|(target, _)| *target);
        coordinates.program_with(Some(&shared.offsets), targets);
        let ends = (&start[..], &coordinates.target()[..]);
        let time_s = self.contour.pass_by(
            ends,
            self.motion.limits.feed_axes(),
            self.report.source,
            words.span,
        )?;
        self.moved = true;
        self.check_line(&start, words);
        Some(time_s)
    }

    /// Checks the line from a position to the targets of a block against the software limits. No other axes move, because the
    /// frame is the identity and no axis has moved independently.
    fn check_line(&mut self, start: &[f64], words: &StraightWords) {
        let end = self.geometry.coordinates.target();
        let inside = |axis: usize| {
            let limits = self.geometry.limits_mm[axis];
            limits.is_none_or(|l| !is_outside(start[axis], l) && !is_outside(end[axis], l))
        };
        if words.targets.iter().all(|(target, _)| inside(target.axis))
            || self.contour.path_of_next(&self.modal) == PathOf::Tool
        {
            return;
        }
        let end = end.clone();
        let place = |axis| {
            let at = words.targets.iter().find(|(target, _)| target.axis == axis);
            at.map_or(words.span, |(_, at)| *at)
        };
        let limits = self.geometry.limits(&self.motion, &self.names, &self.machine);
        for axis in 0..end.len() {
            let (from, to) = (start[axis], end[axis]);
            let (low, high) = (from.min(to), from.max(to));
            if let Some(fault) = limits.outside(axis, low, high, Some(to), || place(axis)) {
                self.report.note(fault);
            }
        }
    }

    /// State valid for this motion and the following ones.
    fn share(&mut self, path: &Path, at: Span) -> Outcome<Box<Straight>> {
        let feed = self.motion.feed_of(
            path,
            &self.geometry.coordinates,
            &self.modal,
            output!(self),
            at,
        )?;
        let rapid = feed == Feed::Rapid;
        let InPlane { plane, .. } = self.geometry.in_plane(&self.modal, &self.motion, at)?;
        self.motion.update_ramps(&self.geometry.coordinates, &self.machine.channel);
        Ok(Box::new(Straight {
            feed,
            feed_ratio: self.motion.overrides.ratio(rapid, 0..1),
            slope: self.modal.commanded.slope,
            dynamics: self.motion.dynamics(&self.machine, &self.modal, rapid),
            tolerance: self.shaping.tolerance(),
            contour: self.contour.hsc.contour(),
            spline: self.motion.spline_settings(&self.geometry.coordinates, &self.contour),
            plane,
            offsets: self.geometry.coordinates.active_offsets(),
        }))
    }
}
