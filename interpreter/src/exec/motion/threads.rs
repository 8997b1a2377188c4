//! Threads: G33 with a rotating spindle, tapping with a spindle that follows the path (G63, G331, G332).
//!
//! Tapping begins and ends at standstill, and the rotation of the spindle follows the distance of the path: both are exact. G33
//! begins when the spindle has reached its speed and passes its zero mark, and then moves at pitch times speed. The ramps at
//! its start and end cut a different pitch, as on the machine. Each block of G33 is a separate thread, unless P-CHAN-00837 or
//! `#TURN` chains them. The override acts on G33 and so changes the pitch, unless P-CHAN-00836, `#TURN` or a chain prevents it;
//! an override and a feedhold are reported when they occur (K-0132).
//!
//! Assumptions: the pitch of a thread at 45 deg or more refers to its other axis only if it is programmed so; the path stops
//! between blocks of tapping; the path stops after the last block of G33; what suppresses the override also suppresses that of
//! the program. The manual states that the sign of S (G63) and of the pitch (G331) distinguishes right-hand from left-hand
//! threads; that the positive sign is the right-hand one is inferred.
//!
//! Source: TF5200 programming manual, tapping (G63), thread cutting with endlessly rotating spindle (G33), settings for
//! turning functions (`#TURN`); TF5200 turning functions, tapping (G331/G332), thread chain; P-CHAN-00836, P-CHAN-00837;
//! 20007, 20032, 20635 to 20637, 21000, 21540, 60303.

mod tapping;
mod turning;

use crate::diag::Condition;
use crate::exec::block::choice::{Compensation, FeedType, PathMode};
use crate::exec::block::collected::Words;
use crate::exec::block::groups::Act;
use crate::exec::block::modal::Modal;
use crate::exec::contour::Contour;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::motion::state::{MotionState, Threads};
use crate::exec::names::AxisNames;
use crate::exec::step::Sync;
use crate::machine::Channel;
use crate::syntax::ast::{ItemKind, Span};
use kontur_motion::block::{Block, Feed};
use kontur_motion::path::Path;
use std::sync::Arc;

/// Smallest and largest pitch in mm. Assumption: the vendor prints no range; 0 is not a pitch.
const PITCH_MM: (f64, f64) = (1e-4, 1e4);

/// Difference in mm below which two pitches count as equal: one may be given in inches.
const PITCH_ROUNDING_MM: f64 = 1e-9;

impl Threads {
    /// The pitch of a path: that of its longest main axis with a pitch.
    fn pitch(
        &self,
        coordinates: &Coordinates,
        names: &AxisNames,
        path: &Path,
        span: Span,
    ) -> Outcome<(usize, f64)> {
        let way = |axis: usize| (path.end()[axis] - path.start()[axis]).abs();
        let mut best: Option<(usize, f64)> = None;
        let pitches = self.pitch_mm.iter().enumerate();
        let absent = |main| coordinates.main_axis(main).is_none();
        if pitches.clone().any(|(main, pitch)| pitch.is_some() && absent(main)) {
            let text = "the channel has no axis for the pitch of the thread (I, J or K)";
            return Err(Fault::new(Condition::PitchAxisMissing, text, span));
        }
        for (main, pitch) in self.pitch_mm.iter().enumerate() {
            let (Some(pitch), Some(axis)) = (pitch, coordinates.main_axis(main)) else {
                continue;
            };
            if way(axis) > 0.0 && best.is_none_or(|(b, _)| way(axis) > way(b)) {
                best = Some((axis, *pitch));
            }
        }
        best.ok_or_else(|| {
            // the centre words of the moved axes, by their names in the channel
            let wanted: Vec<String> = ["I", "J", "K"]
                .iter()
                .enumerate()
                .filter_map(|(main, word)| Some((coordinates.main_axis(main)?, word)))
                .filter(|(axis, _)| way(*axis) > 0.0)
                .map(|(axis, word)| format!("{word} for {}", names.name(axis)))
                .collect();
            let text = match &wanted[..] {
                [] => "a thread moves at least one main axis".to_owned(),
                wanted => format!("the thread has no pitch: {} in mm/rev", wanted.join(" or ")),
            };
            Fault::new(Condition::ThreadPitch, text, span)
        })
    }
}

impl MotionState {
    /// Tapping drives the spindle in every block until the next G function of its group.
    ///
    /// # Errors
    /// 21000: M3, M4, M5, M19 or a position of the main spindle while G63, G331 or G332 is active (208104203, 413715595).
    pub(in crate::exec) fn leaves_the_spindle(
        &self,
        words: &Words<'_>,
        modal: &Modal,
        channel: &Channel,
    ) -> Outcome<()> {
        let name = match modal.path_mode(words) {
            PathMode::Tapping => "G63",
            PathMode::TapBack => "G332",
            mode if mode.is_tapping() => "G331",
            _ => return Ok(()),
        };
        let brackets = words.brackets.iter();
        let main = brackets.filter(|b| self.spindle_of_name(b.name.as_str(), channel) == Some(0));
        let bracketed = main.flat_map(|b| &b.group.items).filter_map(|item| match &item.kind {
            ItemKind::Flag(word) => {
                let digits = word.text.strip_prefix(['M', 'm'])?;
                Some((Some(digits.parse().ok()?), item.span))
            }
            ItemKind::Pair { key, .. } if key.is("POS") => Some((None, item.span)),
            _ => None,
        });
        let angles = words.angles.iter().filter(|(spindle, ..)| *spindle == 0);
        let angles = angles.map(|(.., span)| (None, *span));
        let functions = words.m.iter().map(|m| (Some(m.number), m.span));
        let mut turning = functions
            .chain(bracketed)
            .chain(angles)
            .filter(|(m, _)| m.is_none_or(|number| matches!(number, 3..=5 | 19)));
        match turning.next() {
            Some((m, span)) => {
                let word = m.map_or("POS".to_string(), |number| format!("M{number:02}"));
                let text = format!("{word} while {name} turns the spindle");
                Err(Fault::new(Condition::TappingSpindleFunction, text, span))
            }
            None => Ok(()),
        }
    }

    /// Refuses another main spindle where something depends on the present one: the pages do not say which of the two it then
    /// follows.
    pub(in crate::exec) fn keeps_main_spindle(&self, modal: &Modal, span: Span) -> Outcome<()> {
        let what = if modal.path.is_tapping() {
            "another main spindle while the spindle turns with the path (tapping)"
        } else if self.cutting.is_on() {
            "another main spindle under G96"
        } else {
            return Ok(());
        };
        Err(Fault::unsupported(what, span))
    }

    /// Functions that cannot be combined with threads.
    fn thread_fits(
        &self,
        words: &Words<'_>,
        coordinates: &Coordinates,
        modal: &Modal,
        contour: &Contour,
        span: Span,
    ) -> Outcome<()> {
        if modal.compensation != Compensation::Off {
            return Err(Fault::unsupported("a thread with tool radius compensation", span));
        }
        if contour.akima.selected {
            return Err(Fault::unsupported("a thread in a spline", span));
        }
        if !coordinates.frame().only_shifts() {
            return Err(Fault::unsupported("a thread in a rotated or mirrored system", span));
        }
        if self.spindles[0].index.is_none() {
            return Err(Fault::unsupported("a thread without a spindle in the machine", span));
        }
        self.no_spindle_override("a thread", span)?;
        self.no_tool_limit("a thread", 0, span)?;
        if modal.path == PathMode::Thread {
            if self.cutting.is_on() {
                // the page does not say whether the path follows the changing speed
                let what = "a thread (G33) with constant cutting speed (G96)";
                return Err(Fault::unsupported(what, span).hint("write G97 before it"));
            }
            return Ok(());
        }
        if modal.feed_type == FeedType::PerRevolution {
            let text = "tapping with the feed per revolution (G95)";
            return Err(Fault::new(Condition::TappingPerRevolution, text, span));
        }
        if self.cutting.speed.is_some() {
            let text = "tapping with constant cutting speed (G96)";
            return Err(Fault::new(Condition::TappingCuttingSpeed, text, span));
        }
        if let Some(g) = words.g.iter().find(|g| g.row.number == 196) {
            let text = "tapping and G196 in one block";
            return Err(Fault::new(Condition::TappingWithSpeedLimit, text, g.span));
        }
        let turns = words.m.iter().find(|m| matches!(m.number, 3..=5 | 19));
        if turns.is_some() || self.spindles[0].is_turning() {
            let text = "tapping requires a stopped spindle: the spindle turns with the path";
            let at = turns.map_or(span, |m| m.span);
            return Err(Fault::new(Condition::SpindleTurns, text, at));
        }
        Ok(())
    }
}

impl Decoder {
    /// End of G33: the path stops, and no longer follows the spindle.
    pub(in crate::exec) fn end_thread(&mut self) {
        if std::mem::take(&mut self.motion.threads.cutting) {
            self.sync(Sync::ThreadEnd);
        }
    }

    /// A block of G33, G63, G331 or G332.
    pub(in crate::exec) fn thread_motion(&mut self, words: &Words<'_>, span: Span) -> Outcome<()> {
        let mode = self.modal.path;
        self.motion.thread_fits(
            words,
            &self.geometry.coordinates,
            &self.modal,
            &self.contour,
            span,
        )?;
        if let Some((_, at)) = words.end_feed {
            let text = "E in a thread: its speed is that of the pitch";
            return Err(Fault::new(Condition::Syntax, text, at));
        }
        let start = self.program_targets(words)?;
        let end = self.geometry.coordinates.target().clone();
        for (main, word) in words.centre.iter().enumerate() {
            let Some((pitch, at)) = word else { continue };
            let pitch_mm = pitch * self.modal.unit_mm();
            if !(PITCH_MM.0..=PITCH_MM.1).contains(&pitch_mm.abs()) {
                let text = format!(
                    "the pitch {pitch} of a thread is outside {} to {} mm",
                    PITCH_MM.0, PITCH_MM.1
                );
                return Err(Fault::new(Condition::ThreadPitch, text, *at));
            }
            if let (Some(cut), PathMode::TapBack) = (self.motion.threads.pitch_mm[main], mode)
                && (cut - pitch_mm).abs() > PITCH_ROUNDING_MM
            {
                // 413715595: the tool leaves the thread that it has cut
                let text = format!(
                    "the pitch {pitch} of G332 must be that of the thread, {}",
                    cut / self.modal.unit_mm()
                );
                return Err(Fault::new(Condition::ThreadPitch, text, *at));
            }
            self.motion.threads.pitch_mm[main] = Some(pitch_mm);
        }
        let Some(path) = self.motion.line(start, end) else {
            let Some((axis, _, at)) = words.axes.first().filter(|_| mode.is_tapping()) else {
                return Ok(());
            };
            let name = self.names.name(*axis).to_owned();
            let text = format!("tapping without travel of axis {name}");
            let number = self.machine.axes[*axis].number();
            return Err(
                Fault::new(Condition::TappingWithoutWay, text, *at).with(|d| d.axis(number, name))
            );
        };
        let place = |axis| words.axes.iter().find(|(a, _, _)| *a == axis).map(|(_, _, at)| *at);
        let limits = self.geometry.limits(&self.motion, &self.names, &self.machine);
        limits.check(&path, place, &mut self.report, span);
        self.join(self.motion.independent.moved_by(&path));
        if mode == PathMode::Thread {
            self.cut_thread(path, words, span)
        } else {
            self.tap(path, has_full_override(words), span)
        }
    }

    fn thread_block(
        &self,
        path: Path,
        feed_mm_s: f64,
        dynamics: Arc<kontur_motion::block::ChannelDynamics>,
        full_override: bool,
    ) -> Box<Block> {
        let moved = (0..path.start().len())
            .filter(|a| path.start()[*a].to_bits() != path.end()[*a].to_bits());
        let feed_ratio =
            if full_override { 1.0 } else { self.motion.overrides.ratio(false, moved) };
        Box::new(Block {
            seq: 0,
            path,
            feed: Feed::PathVelocity(feed_mm_s),
            feed_ratio,
            full_override,
            end_velocity_mm_s: None,
            late_braking: false,
            slope: self.modal.commanded.slope,
            dynamics,
            tolerance: self.shaping.tolerance(),
            contour: None,
            spline: None,
            tangential: false,
        })
    }
}

/// G166 in the block.
fn has_full_override(words: &Words<'_>) -> bool {
    words.has(Act::FullOverride)
}
