//! G33 with a turning spindle, and chains of such blocks.

use super::{PITCH_ROUNDING_MM, has_full_override};
use crate::diag::{Condition, ValueKind, rounded};
use crate::exec::block::collected::Words;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::motion::spindles::Spindle;
use crate::exec::motion::state::Threads;
use crate::exec::report::{Report, Subject};
use crate::exec::step::{SpindleState, Sync};
use crate::machine::Axis;
use crate::syntax::ast::Span;
use kontur_filters::time::CycleTime;
use kontur_motion::block::Block;
use kontur_motion::junction::{Ends, transition};
use kontur_motion::limits::{PathExtremes, PathSpeeds};
use kontur_motion::path::Path;
use kontur_motion::queue::Queued;

/// Fraction of the thread speed that must be reached: all of it, except for rounding.
const SHORT: f64 = 1.0 - 1e-6;

/// A block of G33.
struct Cut<'a> {
    block: &'a Block,
    /// Index of the spindle.
    spindle: usize,
    /// Speed of the spindle in rev/min, negative for M4.
    rpm: f64,
    pitch_mm: f64,
    /// Place of its start angle.
    offset: Option<Span>,
    span: Span,
}

impl Threads {
    /// Whether a block begins where the last one of a chain has ended.
    fn continues(&self, block: &Block) -> bool {
        let starts = block.path.start();
        let same = |last: &Block| {
            last.path.end().iter().zip(starts.iter()).all(|(a, b)| a.to_bits() == b.to_bits())
        };
        self.turning.chain && self.last.as_deref().is_some_and(same)
    }

    /// A block of the chain that is being cut, or the first of the next one; `unit_mm`: unit of the pitch.
    fn join(
        &mut self,
        cut: &Cut<'_>,
        cycle: CycleTime,
        unit_mm: f64,
        report: &mut Report,
    ) -> Outcome<()> {
        if self.cutting {
            self.continue_chain(cut, cycle, unit_mm, report)?;
        } else if self.continues(cut.block) {
            let text = "the path has stopped within the chain: this block waits for the mark of the spindle like a new thread";
            let hint = "move G04, G60 and commands that stop the path out of the chain";
            report.note(Fault::new(Condition::ThreadBroken, text, cut.span).hint(hint));
        }
        self.last = self.turning.chain.then(|| Box::new(cut.block.clone()));
        self.turned = Some((cut.spindle, cut.rpm));
        self.cut_mm = cut.pitch_mm;
        Ok(())
    }

    /// A further block of a chain of threads.
    ///
    /// Assumption: at a corner and where the pitch changes, which the printed chain does (1212537739), the path slows down as
    /// between other blocks; the pitch of these stretches is reported as not kept.
    fn continue_chain(
        &self,
        cut: &Cut<'_>,
        cycle: CycleTime,
        unit_mm: f64,
        report: &mut Report,
    ) -> Outcome<()> {
        let same = |(spindle, rpm): (usize, f64)| {
            spindle == cut.spindle && rpm.to_bits() == cut.rpm.to_bits()
        };
        if !self.turned.is_some_and(same) {
            let what =
                "a chain of threads in which the spindle, its speed or its direction changes";
            return Err(Fault::unsupported(what, cut.span));
        }
        if let Some(at) = cut.offset {
            let what = "a start angle (OFFSET) within a chain of threads";
            return Err(Fault::unsupported(what, at)
                .hint("the chain starts at the angle of its first block; end it with G00 or #TURN [THREAD_CHAIN=0]"));
        }
        let slows = |last: &Block| slows_between(last, cut.block, cycle);
        let text = if self.last.as_deref().is_some_and(slows) {
            "the thread changes its direction: the path slows down at the corner, the pitch differs there".to_owned()
        } else if (self.cut_mm - cut.pitch_mm).abs() > PITCH_ROUNDING_MM {
            format!(
                "the pitch changes from {} to {} within the chain: it differs until the path has its new speed",
                rounded(self.cut_mm / unit_mm),
                rounded(cut.pitch_mm / unit_mm)
            )
        } else {
            return Ok(());
        };
        let fault = Fault::new(Condition::ThreadBroken, text, cut.span);
        report.note(
            fault.hint("the ramps of both speeds take part of the thread: leave a run-out there"),
        );
        Ok(())
    }
}

impl Decoder {
    /// A block of G33.
    pub(super) fn cut_thread(&mut self, path: Path, words: &Words<'_>, span: Span) -> Outcome<()> {
        let modes = self.motion.threads.turning;
        if !modes.chain {
            self.end_thread();
        }
        let (axis, pitch_mm) =
            self.motion.threads.pitch(&self.geometry.coordinates, &self.names, &path, span)?;
        if pitch_mm < 0.0 {
            let text = "the pitch of G33 must not have a sign: M03 and M04 set the direction";
            return Err(Fault::new(Condition::ThreadPitch, text, span));
        }
        if let Some(farther) = farther_than(&path, axis, &self.geometry.coordinates) {
            let [other, name] = [farther, axis].map(|i| self.names.name(i));
            let text = format!(
                "the pitch is that along {name}, although the thread runs farther along {other}: at 45 deg and more it is usually given along {other}"
            );
            self.report.note_once(Subject::G(33), Fault::new(Condition::Odd, text, span));
        }
        let index = turning_spindle(&self.motion.spindles[0], span)?;
        let rev_s =
            self.motion.spindles[0].rpm.abs().min(self.motion.spindles[0].most_rpm(&self.machine))
                / 60.0;
        let way = (path.end()[axis] - path.start()[axis]).abs();
        let feed_mm_s = pitch_mm * rev_s * path.length() / way;
        let dynamics = self.motion.dynamics(&self.machine, &self.modal, false);
        let full = modes.full_override() || has_full_override(words);
        let block = self.thread_block(path, feed_mm_s, dynamics, full);
        keeps_pitch(&block, feed_mm_s, &mut self.report, span)?;
        if !modes.chain {
            thread_is_long_enough(&block, feed_mm_s, self.machine.cycle, (&mut self.report, span));
        }
        let plane = self.geometry.in_plane(&self.modal, &self.motion, span)?;
        if self.report.failed() && !self.checking {
            return Ok(());
        }
        let offset = words.offsets.iter().find(|(spindle, _, _)| *spindle == 0);
        if let Some((_, deg, at)) = offset {
            offset_fits(&self.machine.spindles[index], *deg, *at)?;
        }
        let cut = Cut {
            block: &block,
            spindle: index,
            rpm: self.motion.spindles[0].signed_rpm(),
            pitch_mm,
            offset: offset.map(|(_, _, at)| *at),
            span,
        };
        let unit_mm = self.modal.unit_mm();
        self.motion.threads.join(&cut, self.machine.cycle, unit_mm, &mut self.report)?;
        if !self.motion.threads.cutting {
            let deg = offset.map_or(0.0, |(_, deg, _)| *deg);
            self.begin_thread(&block, index, deg, span);
        }
        self.send(block, plane, None, span);
        Ok(())
    }

    /// The path waits for the spindle at its start angle in deg.
    fn begin_thread(&mut self, block: &Block, spindle: usize, deg: f64, span: Span) {
        let rpm = self.motion.spindles[0].rpm;
        let text = self.motion.begins_elsewhere(&block.path, rpm, &self.machine, &self.shaping);
        if let Some(text) = text {
            let fault = Fault::new(Condition::UnequalKernels, text, span);
            self.report.note_once(Subject::Only, fault);
        }
        let settled = block.tolerance.ax_dev_mm.is_some();
        let state = SpindleState::Mark { deg, full_override: block.full_override, settled };
        self.contour.continue_along(&block.path);
        self.sync(Sync::Spindle { spindle, state });
        self.motion.threads.cutting = true;
    }
}

/// The main axis that a path moves farther than the one of the pitch.
fn farther_than(path: &Path, pitch: usize, coordinates: &Coordinates) -> Option<usize> {
    let way = |axis: usize| (path.end()[axis] - path.start()[axis]).abs();
    let main = (0..3).filter_map(|main| coordinates.main_axis(main));
    main.filter(|axis| way(*axis) > way(pitch) + PITCH_ROUNDING_MM)
        .max_by(|a, b| way(*a).total_cmp(&way(*b)))
}

/// The index of the spindle if it turns.
///
/// # Errors
/// 20635, 20636: it has no speed, or is at rest.
fn turning_spindle(spindle: &Spindle, span: Span) -> Outcome<usize> {
    let (Some(index), true) = (spindle.index, spindle.rpm.abs() > 0.0) else {
        let text = "G33 requires a turning spindle: M03 or M04 and S before it";
        return Err(Fault::new(Condition::SpindleStandsInThread, text, span));
    };
    if !spindle.is_turning() {
        let text = "G33 while the spindle is at rest: M03 or M04 is missing";
        return Err(Fault::new(Condition::SpindleStoppedInThread, text, span));
    }
    Ok(index)
}

/// Whether the axes and the override permit the speed of the pitch; a programmed override is noted.
fn keeps_pitch(block: &Block, feed_mm_s: f64, report: &mut Report, span: Span) -> Outcome<()> {
    if (block.feed_ratio - 1.0).abs() > 1e-12 {
        let text = format!(
            "the programmed override acts on G33: the pitch of the thread becomes {} %",
            rounded(block.feed_ratio * 100.0)
        );
        report.note_once(Subject::G(33), Fault::new(Condition::ThreadBroken, text, span));
    }
    let speeds = PathSpeeds::of(block, &PathExtremes::of(&block.path));
    if speeds.highest() < feed_mm_s * (1.0 - 1e-9) {
        let text = format!(
            "the thread requires {feed_mm_s:.3} mm/s, the axes reach {:.3} mm/s: the pitch would differ",
            speeds.highest()
        );
        return Err(Fault::new(Condition::ThreadSpeed, text, span));
    }
    Ok(())
}

/// 60303 for an offset angle outside the modulo range of the spindle (259780491).
fn offset_fits(spindle: &Axis, deg: f64, at: Span) -> Outcome<()> {
    let (lower, upper) = spindle.modulo_range_deg();
    if (lower..=upper).contains(&deg) {
        return Ok(());
    }
    let name = spindle.name();
    let text = format!("{name}.OFFSET: {deg} is outside {lower} to {upper} deg");
    Err(Fault::new(Condition::ThreadOffsetRange, text, at).with(|d| {
        d.axis(spindle.number(), name.to_owned())
            .value(ValueKind::Current, deg * 1e4, "0.0001deg")
            .value(ValueKind::LowerLimit, lower * 1e4, "0.0001deg")
            .value(ValueKind::UpperLimit, upper * 1e4, "0.0001deg")
    }))
}

/// Whether the path passes from one block of a chain to the next below the speed of both.
fn slows_between(last: &Block, next: &Block, cycle: CycleTime) -> bool {
    let cap = transition(last, next, &Ends::of(last), &Ends::of(next), cycle, false);
    let speed = |block: &Block| {
        let speeds = PathSpeeds::of(block, &PathExtremes::of(&block.path));
        speeds.limited(speeds.programmed_mm_s).v_mm_s
    };
    cap.v_mm_s < SHORT * speed(last).min(speed(next))
}

/// K-0132 for a thread from standstill to standstill that ends before the path reaches the speed of its pitch.
fn thread_is_long_enough(
    block: &Block,
    feed_mm_s: f64,
    cycle: CycleTime,
    (report, span): (&mut Report, Span),
) {
    let queued = Queued::new(block.clone(), cycle);
    let profile = queued.slope.plan(0.0, 0.0, feed_mm_s, queued.length);
    let Some(reached) = profile.ok().map(|p| p.peak()).filter(|v| *v < feed_mm_s * SHORT) else {
        return;
    };
    let needed =
        queued.slope.up_distance(0.0, feed_mm_s) + queued.slope.down_distance(feed_mm_s, 0.0);
    let text = format!(
        "the thread is too short for its pitch: the path reaches {reached:.3} of {feed_mm_s:.3} mm/s, acceleration and deceleration take {needed:.3} mm"
    );
    report.note(Fault::new(Condition::ThreadBroken, text, span));
}
