//! What the words of a block do, in the order of execution: plane, unit and dimension; tool, offsets and frames; feed,
//! spindle, weights and modes; functions before the motion; motion or dwell; functions after it.
//!
//! Assumption: this order; the vendor documents only that the order of words in the block counts for nothing.

use super::decoder::Decoder;
use super::fault::{Fault, Outcome, own};
use super::groups::{self, Act, Group};
use super::insertion::Kind;
use super::modal::{Compensation, FeedType, FeedWord, LookAhead, Plane};
use super::spindles::Turning;
use super::step::{Event, Sync};
use super::words::{Code, CycleCall, GWord, Placed, Words};
use crate::diag::ValueKind;
use crate::syntax::ast::{Call, Label, Span, Word};

/// What follows a block.
#[derive(Debug)]
pub(super) enum After<'b> {
    Next,
    Call(&'b Call, Span),
    Cycle(CycleCall),
    /// M06 with a program of its own.
    ToolChange(Span),
    Goto(&'b Label),
    /// M17, M29.
    Return,
    /// M02, M30.
    End,
}

/// How M functions act that are more than a number for the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MKind {
    Before,
    After,
    Stop { optional: bool },
    End,
    Return,
    Spindle,
    ToolChange,
}

fn m_kind(number: u32) -> MKind {
    match number {
        0 => MKind::Stop { optional: false },
        1 => MKind::Stop { optional: true },
        2 | 30 => MKind::End,
        17 | 29 => MKind::Return,
        3 | 4 | 19 => MKind::Spindle,
        5 => MKind::After,
        6 => MKind::ToolChange,
        _ => MKind::Before,
    }
}

impl Decoder {
    /// Executes a block of words.
    pub(super) fn execute_words<'b>(&mut self, written: &'b [Word], span: Span) -> After<'b> {
        let mut words = Words::default();
        self.collect(written, &mut words);
        self.dialect_guard(&words);
        self.planes_and_units(&words);
        let takes_axes = self.axis_functions(&words);
        self.tools_and_offsets(&words, takes_axes);
        let preset = self.position_presets(&words);
        self.feeds_and_modes(&words, takes_axes);
        // behind G04 the S word is a number of revolutions
        if words.group(Group::Path).is_none_or(|g| g.row.act != Act::Dwell) {
            for (i, speed, span) in &words.speeds {
                self.speed(*i, *speed, *span);
            }
        }
        self.functions_before(&words);
        for bracket in &words.brackets {
            let outcome = self.bracket(bracket);
            self.keep(outcome);
        }
        if !preset {
            self.motion_or_dwell(&words, takes_axes, span);
        }
        self.join_synchronous();
        self.functions_after(&words)
    }

    fn planes_and_units(&mut self, words: &Words<'_>) {
        for g in &words.g {
            match g.row.act {
                Act::Plane(plane) => self.set_plane(plane, g.span),
                Act::Inch(inch) => self.modal.inch = inch,
                Act::Absolute(absolute) => self.modal.absolute = absolute,
                // before G41 in the same block
                Act::Corners(corners) => self.modal.corners = corners,
                _ => {}
            }
        }
    }

    fn set_plane(&mut self, plane: Plane, span: Span) {
        if plane != self.modal.plane && self.modal.compensation != Compensation::Off {
            let text = "the plane cannot be changed while tool radius compensation is active";
            self.note(Fault::vendor(20133, text, span));
            return;
        }
        if plane != self.modal.plane && self.coordinates.rotation().is_some() {
            let text = "the change of plane switches the contour rotation off";
            self.note(Fault::kontur(own::ODD, text, span).warning());
            self.coordinates.set_rotation(None);
        }
        self.modal.plane = plane;
    }

    /// The G function that takes the axis words of the block as its arguments.
    fn axis_functions(&mut self, words: &Words<'_>) -> Option<GWord> {
        let mut found: Option<GWord> = None;
        for g in words.g.iter().filter(|g| groups::takes_axes(g.row)) {
            if let Some(first) = found {
                let text = format!(
                    "G{} and G{} in one block: both need the axis words",
                    first.row.number, g.row.number
                );
                self.note(Fault::kontur(own::SYNTAX, text, g.span));
            } else {
                found = Some(*g);
            }
        }
        let motion = words.group(Group::Path).filter(|g| matches!(g.row.act, Act::Path(_)));
        if let (Some(g), Some(motion), false) = (found, motion, words.axes.is_empty()) {
            let text = format!(
                "G{:02} beside G{}: the axis words are arguments of G{}, not targets",
                motion.row.number, g.row.number, g.row.number
            );
            self.note(Fault::kontur(own::SYNTAX, text, motion.span));
        }
        found
    }

    fn tools_and_offsets(&mut self, words: &Words<'_>, takes_axes: Option<GWord>) {
        if let Some((number, span)) = words.tool {
            self.select_tool(number, span);
        }
        if let Some((number, span)) = words.tool_data {
            self.select_tool_data(number, span);
        }
        for g in &words.g {
            let outcome = match g.row.act {
                Act::ZeroGroup(group) => {
                    self.coordinates.select_zero_group(group);
                    Ok(())
                }
                Act::ZeroGroupValue => Self::zero_group(g).map(|group| {
                    self.coordinates.select_zero_group(group);
                }),
                Act::Mirror(first, second) => {
                    self.mirror(first, second);
                    Ok(())
                }
                Act::RotateOff => {
                    self.coordinates.set_rotation(None);
                    Ok(())
                }
                _ => Ok(()),
            };
            self.keep(outcome);
        }
        let Some(g) = takes_axes else { return };
        let outcome = match g.row.act {
            Act::ZeroGroupAxes => self.zero_group_of_axes(&g, words),
            Act::Preset => self.preset(&g, words),
            Act::MirrorAxes => self.mirror_axes(&g, words),
            Act::Rotate => self.rotate(&g, words),
            Act::SoftwareLimits(positive) => self.software_limits(&g, words, positive),
            _ => Ok(()),
        };
        self.keep(outcome);
    }

    /// `#PSET X10`, `#PRESET X0`, `#PRESET`: true if the axis words of the block belong to one of them.
    fn position_presets(&mut self, words: &Words<'_>) -> bool {
        let named = |h: &str| words.hashes.iter().find(|(hash, _, _)| &*hash.name == h);
        let (sets, at) = match (named("PSET"), named("PRESET")) {
            (Some((_, _, at)), _) => (true, *at),
            (None, Some((_, _, at))) => (false, *at),
            (None, None) => return false,
        };
        let conflicts =
            !self.coordinates.frame().is_identity() || self.modal.compensation != Compensation::Off;
        if conflicts {
            let text = "#PSET and #PRESET do not go with mirroring, rotation, #CS or tool radius compensation";
            self.note(Fault::kontur(own::SYNTAX, text, at));
            return true;
        }
        for (axis, value, _) in &words.axes {
            let value = sets.then(|| value * self.axis_unit(*axis));
            self.coordinates.preset_position(*axis, value);
        }
        if words.axes.is_empty() && !sets {
            for axis in 0..self.machine.axes.len() {
                self.coordinates.preset_position(axis, None);
            }
        } else if words.axes.is_empty() {
            self.note(Fault::kontur(own::SYNTAX, "#PSET without axis words", at));
        }
        true
    }

    /// G98, G99: until the end of the program.
    fn software_limits(&mut self, g: &GWord, words: &Words<'_>, positive: bool) -> Outcome<()> {
        Self::needs_axes(g, words)?;
        for (axis, value, span) in &words.axes {
            let value_mm = value * self.axis_unit(*axis);
            match &mut self.limits_mm[*axis] {
                Some((_, high)) if positive => *high = value_mm,
                Some((low, _)) => *low = value_mm,
                None => {
                    let text = format!("axis {} has no software limits", self.axis_name(*axis));
                    self.note(Fault::kontur(own::IGNORED, text, *span));
                }
            }
        }
        Ok(())
    }

    fn zero_group(g: &GWord) -> Outcome<u32> {
        let value = g.value.unwrap_or_default();
        super::expr::whole(value, 0, 999).ok_or_else(|| {
            let text = format!("zero-offset group {value} does not exist");
            Fault::kontur(own::RANGE, text, g.span)
        })
    }

    fn needs_axes(g: &GWord, words: &Words<'_>) -> Outcome<()> {
        if words.axes.is_empty() {
            let text = format!("G{} without axis words", g.row.number);
            return Err(Fault::vendor(20003, text, g.span));
        }
        Ok(())
    }

    fn zero_group_of_axes(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        Self::needs_axes(g, words)?;
        let group = Self::zero_group(g)?;
        // 0 takes the offset of the axis in, 1 leaves it out
        for (axis, value, _) in &words.axes {
            let masked = super::expr::is_true(*value);
            self.coordinates.mask_zero_entry(group, *axis, masked);
        }
        Ok(())
    }

    /// G92: absolute with G90, added with G91.
    fn preset(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        Self::needs_axes(g, words)?;
        for (axis, value, _) in &words.axes {
            let value_mm = value * self.axis_unit(*axis);
            let before = if self.modal.absolute { 0.0 } else { self.coordinates.preset(*axis) };
            self.coordinates.set_preset(*axis, before + value_mm);
        }
        Ok(())
    }

    fn mirror(&mut self, first: bool, second: bool) {
        for (main, mirrored) in [(0, first), (1, second)] {
            if let Some(axis) = self.coordinates.main_axis(main) {
                self.coordinates.set_mirrored(axis, mirrored);
            }
        }
        if !first && !second {
            for axis in 0..self.machine.axes.len() {
                self.coordinates.set_mirrored(axis, false);
            }
        }
    }

    fn mirror_axes(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        Self::needs_axes(g, words)?;
        for (axis, value, span) in &words.axes {
            let mirrored = match value {
                v if v.total_cmp(&1.0).is_eq() => false,
                v if v.total_cmp(&-1.0).is_eq() => true,
                _ => {
                    let text = format!("mirroring is switched by 1 and -1, not by {value}");
                    return Err(Fault::vendor(20860, text, *span)
                        .with(|d| d.value(ValueKind::Wrong, *value, "-")));
                }
            };
            self.coordinates.set_mirrored(*axis, mirrored);
        }
        Ok(())
    }

    fn rotate(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        let main = self.modal.plane.main_axes();
        let mut centre: [Option<f64>; 2] = [None; 2];
        for (axis, value, span) in &words.axes {
            match self.coordinates.main_index(*axis) {
                Some(m) if m == main[0] => centre[0] = Some(value * self.axis_unit(*axis)),
                Some(m) if m == main[1] => centre[1] = Some(value * self.axis_unit(*axis)),
                _ => {
                    let name = self.axis_name(*axis).to_owned();
                    let text = format!("axis {name} is not in the plane of the rotation");
                    let number = self.machine.axes[*axis].number();
                    return Err(Fault::vendor(22156, text, *span)
                        .with(|d| d.axis(number, name).value(ValueKind::AxisNumber, number, "-")));
                }
            }
        }
        let deg = words.radius.map_or(0.0, |(deg, _)| deg);
        let plane = [main[0], main[1]];
        self.set_rotation(plane, deg, centre, g.span)
    }

    fn feeds_and_modes(&mut self, words: &Words<'_>, takes_axes: Option<GWord>) {
        for g in &words.g {
            if let Act::FeedType(feed_type) = g.row.act {
                self.modal.feed_type = feed_type;
                if feed_type == FeedType::Time {
                    // one time per use of G93
                    self.modal.feeds[feed_type as usize] = None;
                }
            }
        }
        if let Some(feed) = words.feed {
            let outcome = self.feed(feed);
            self.keep(outcome);
        }
        for g in &words.g {
            let outcome = self.mode(g, words);
            self.keep(outcome);
        }
        if let Some(g) = takes_axes {
            let outcome = match g.row.act {
                Act::WeightOfAxes(weight) => self.weights_of_axes(&g, weight, words),
                Act::FeedforwardWeights => self.feedforward_weights(&g, words),
                _ => Ok(()),
            };
            self.keep(outcome);
        }
        self.insertions(words);
    }

    fn feed(&mut self, (value, span): Placed) -> Outcome<()> {
        let most = if self.modal.feed_type == FeedType::ShareOfMaximum { 100.0 } else { 1e9 };
        if !(0.0..=most).contains(&value) {
            let text = format!("F{value} is outside 0 to {most}");
            return Err(Fault::kontur(own::RANGE, text, span));
        }
        self.unsay("20008");
        let word = FeedWord { value, inch: self.modal.inch };
        self.modal.feeds[self.modal.feed_type as usize] = Some(word);
        Ok(())
    }

    /// Modes without axis words.
    fn mode(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        match g.row.act {
            Act::ExactStop(on) => {
                self.modal.exact_stop = on;
                self.modal.contouring &= !on;
            }
            Act::Contour(on) => {
                self.modal.contouring = on;
                self.modal.exact_stop &= !on;
            }
            Act::CentreAbsolute(on) => self.modal.centre_absolute = on,
            Act::CentreCorrection(on) => self.modal.centre_correction = on,
            Act::WeightOfAll(weight) => {
                let ratio = Self::weight_ratio(weight, (g.value.unwrap_or_default(), g.span))?;
                self.set_weight(weight, None, ratio, g.span);
            }
            Act::Feedforward(on) if self.feedforward.on != on => {
                self.feedforward.on = on;
                self.feedforward_event();
            }
            Act::StopAtTransitions(stop) => {
                let mode = if stop { LookAhead::StopAtTransitions } else { LookAhead::Complete };
                if self.modal.look_ahead != mode {
                    self.modal.look_ahead = mode;
                    self.dynamics_changed();
                }
            }
            Act::LookAheadFunctions => {
                let value = g.value.unwrap_or_default();
                if super::expr::whole(value, 0, 14).is_none() {
                    let text = format!("G115={value}, allowed are 0 to 14");
                    return Err(Fault::vendor(20151, text, g.span)
                        .with(|d| d.value(ValueKind::Wrong, value, "-")));
                }
                let text = "G115: single functions of the look-ahead cannot be switched off";
                self.note_once("G115", Fault::kontur(own::IGNORED, text, g.span));
            }
            Act::Compensation(side) => self.compensation(side, g.span),
            Act::PerpendicularSelection(on) => self.modal.perpendicular_selection = on,
            Act::Radius => {
                let radius = g.value.unwrap_or_default() * self.unit_mm();
                self.modal.radius_mm = Some(radius);
            }
            Act::Ignored(why) => {
                let text = format!("G{:02} has no effect: {why}", g.row.number);
                let key = format!("G{}", g.row.number);
                self.note_once(&key, Fault::kontur(own::IGNORED, text, g.span));
            }
            Act::ExactStopOnce if words.axes.is_empty() => {
                return Err(Fault::vendor(20003, "G60 without motion", g.span));
            }
            _ => {}
        }
        Ok(())
    }

    fn insertions(&mut self, words: &Words<'_>) {
        let mut request = None;
        for g in &words.g {
            let kind = match g.row.act {
                Act::Chamfer => Kind::Chamfer,
                Act::Rounding => Kind::Rounding,
                _ => continue,
            };
            let written = words.centre[0].map(|(i, span)| (i * self.unit_mm(), span));
            if let Some((size, _)) = written {
                self.modal.insertion_mm = Some(size);
            }
            match self.modal.insertion_mm {
                Some(size) if size > 0.0 => request = Some((kind, size, g.span)),
                _ => {
                    let text = format!("G{} without a size (I)", g.row.number);
                    self.note(Fault::vendor(20012, text, g.span));
                }
            }
        }
        let mut feed = None;
        for (hash, value, span) in &words.hashes {
            let kind = match &*hash.name {
                "FRC" => {
                    feed = value.map(|v| (v, *span));
                    continue;
                }
                "PSET" | "PRESET" | "SUPPRESS OFFSETS" => continue,
                "CHR" => Kind::Chamfer,
                "CHF" => Kind::ChamferLength,
                "RND" => Kind::Rounding,
                other => {
                    self.note(Fault::unsupported(format!("#{other}"), *span));
                    continue;
                }
            };
            match value.map(|v| v * self.unit_mm()) {
                Some(size) if size > 0.0 => request = Some((kind, size, *span)),
                _ => {
                    let text = format!("#{} without a size", hash.name);
                    self.note(Fault::kontur(own::RANGE, text, *span));
                }
            }
        }
        if let Some((kind, size, at)) = request {
            let feed_mm_s = feed.map(|(f, _)| f * self.feed_unit_mm_s());
            self.insert(kind, size, feed_mm_s, at);
        } else if let Some((_, at)) = feed {
            let text = "#FRC without chamfer or rounding has no effect";
            self.note(Fault::kontur(own::ODD, text, at).warning());
        }
    }

    fn speed(&mut self, index: usize, value: f64, span: Span) {
        if !(0.0..=1e6).contains(&value) {
            let text = format!("spindle speed {value} is outside 0 to 1000000 rev/min");
            self.note(Fault::kontur(own::RANGE, text, span));
            return;
        }
        self.spindles[index].rpm = value;
        if self.spindles[index].is_turning()
            && let Some(event) = self.spindles[index].motion_event()
        {
            self.event(event);
        }
        self.spindle_warning(index, span);
    }

    pub(super) fn spindle_warning(&mut self, index: usize, span: Span) {
        if self.spindles[index].index.is_none() {
            let text = "the machine has no spindle: speeds are remembered, nothing turns";
            self.note_once("spindle", Fault::kontur(own::IGNORED, text, span));
        }
    }

    fn functions_before(&mut self, words: &Words<'_>) {
        for m in &words.m {
            match m_kind(m.number) {
                MKind::Before => self.m_function(m),
                MKind::ToolChange if self.tool_change_file.is_none() => self.m_function(m),
                MKind::Spindle => self.turn_main_spindle(m),
                _ => {}
            }
        }
        for h in &words.h {
            self.event(Event::HFunction { number: h.number, value: h.value });
        }
    }

    fn m_function(&mut self, m: &Code) {
        if let Some(text) = super::dialect::m_function(m.number) {
            let key = format!("M{}", m.number);
            self.note_once(&key, Fault::kontur(own::DIALECT, text, m.span));
        }
        self.event(Event::MFunction { number: m.number, value: m.value });
    }

    fn turn_main_spindle(&mut self, m: &Code) {
        self.turn_spindle(0, m.number, m.value);
        self.spindle_warning(0, m.span);
        if self.spindles[0].index.is_none() {
            self.event(Event::MFunction { number: m.number, value: m.value });
        }
    }

    /// M3, M4, M5, M19 of one spindle.
    pub(super) fn turn_spindle(&mut self, index: usize, number: u32, value: Option<f64>) {
        self.spindles[index].turning = match number {
            3 => Turning::Clockwise,
            4 => Turning::CounterClockwise,
            19 => Turning::Positioned { deg: value.unwrap_or(0.0) },
            _ => Turning::Stopped,
        };
        if let Some(event) = self.spindles[index].motion_event() {
            self.event(event);
        }
    }

    fn functions_after<'b>(&mut self, words: &Words<'b>) -> After<'b> {
        let mut after = After::Next;
        for m in &words.m {
            match m_kind(m.number) {
                MKind::After => {
                    self.turn_spindle(0, m.number, m.value);
                    if self.spindles[0].index.is_none() {
                        self.event(Event::MFunction { number: m.number, value: m.value });
                    }
                }
                MKind::Stop { optional } => self.sync(Sync::ProgramStop { optional }),
                MKind::End => after = After::End,
                MKind::Return if !matches!(after, After::End) => after = After::Return,
                _ => {}
            }
        }
        if !matches!(after, After::Next) {
            return after;
        }
        let tool_change = words
            .m
            .iter()
            .find(|m| m_kind(m.number) == MKind::ToolChange && self.tool_change_file.is_some());
        if let (Some(m), true) = (tool_change, words.call.is_some() || words.cycle.is_some()) {
            let text = "M06 calls a subroutine: a second call in its block";
            self.note(Fault::vendor(22008, text, m.span));
        }
        if let Some((call, span)) = words.call {
            return After::Call(call, span);
        }
        if let Some(cycle) = &words.cycle {
            return After::Cycle(cycle.clone());
        }
        if let Some(m) = tool_change {
            return After::ToolChange(m.span);
        }
        match words.goto {
            Some(label) => After::Goto(label),
            None => After::Next,
        }
    }

    /// Words that other dialects give another meaning: once per program and word.
    fn dialect_guard(&mut self, words: &Words<'_>) {
        for g in &words.g {
            match g.row.number {
                22 | 23 | 70 | 71 | 351 => self.dialect.unit_or_mirror = true,
                n if n >= 127 => self.dialect.own = true,
                _ => {}
            }
            let known = if matches!(g.row.number, 20 | 21) {
                self.dialect.unit_or_mirror
            } else {
                self.dialect.own
            };
            if let (false, Some(text)) = (known, super::dialect::g_function(g.row.number)) {
                let key = format!("dialect G{}", g.row.number);
                self.note_once(&key, Fault::kontur(own::DIALECT, text, g.span));
            }
        }
        if let (false, Some((_, span))) = (self.dialect.own, words.end_feed) {
            let text =
                "E is the feed at the end of the block in this dialect, not an extruder axis";
            self.note_once("dialect E", Fault::kontur(own::DIALECT, text, span));
        }
    }
}
