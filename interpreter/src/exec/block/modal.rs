//! Modal state: settings that stay active until another word of their group replaces them.

use super::choice::{Compensation, Corners, FeedType, LookAhead, PathMode, Plane, Selection};
use super::groups;
use crate::diag::{Condition, Diagnostic};
use crate::exec::fault::{Fault, Outcome};
use crate::machine::table::channel as of;
use crate::machine::{Axis, Channel, INCH_MM};
use crate::syntax::ast::Span;
use kontur_motion::block::{Slope, SlopeKind};

/// An F word with the active unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct FeedWord {
    pub(in crate::exec) value: f64,
    pub(in crate::exec) inch: bool,
}

/// Settings that `#` commands make modally; the end of a cycle keeps them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a key of a command")]
pub(in crate::exec) struct Commanded {
    /// `#SLOPE`.
    pub(in crate::exec) slope: Slope,
    /// Whether selective weights apply (P-CHAN-00001, P-CHAN-00073): from program start, and with the older form of the slope
    /// command. With `#SLOPE` the weights apply to all values.
    pub(in crate::exec) old_slope: bool,
    /// Transition velocity of `#TRANSVELMIN` in mm/s.
    pub(in crate::exec) transition_min_mm_s: f64,
    /// `#TANGFEED`: smallest radius in mm of the arcs whose feed applies at the point of engagement (G11).
    pub(in crate::exec) engagement_radius_mm: f64,
    /// `#TRC [STRETCH_FACTOR]`: reach of the lines at acute outer corners in tool radii.
    pub(in crate::exec) corner_stretch: f64,
    /// `#TRC [REVERSE]`.
    pub(in crate::exec) turns_back: bool,
    /// `#TRC [PERPENDICULAR_RADIUS_CHANGE]`.
    pub(in crate::exec) perpendicular_change: bool,
    /// `#TRC [SUPPRESS_TRC]`: the tool centre follows the contour.
    pub(in crate::exec) compensation_suppressed: bool,
}

/// Everything that G words and F, R, I set modally, and the settings of commands.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a group of two words")]
pub(in crate::exec) struct Modal {
    pub(in crate::exec) path: PathMode,
    pub(in crate::exec) plane: Plane,
    /// G20 to G23: mirroring of the first and the second main axis.
    pub(in crate::exec) mirrored: [bool; 2],
    pub(in crate::exec) inch: bool,
    pub(in crate::exec) absolute: bool,
    pub(in crate::exec) feed_type: FeedType,
    /// F of each feed type, in the order of [`FeedType`].
    pub(in crate::exec) feeds: [Option<FeedWord>; 4],
    pub(in crate::exec) exact_stop: bool,
    pub(in crate::exec) contouring: bool,
    /// G901: a lower feed rate of the next block may be reached after the end of the block.
    pub(in crate::exec) late_braking: bool,
    /// G13.
    pub(in crate::exec) corner_deceleration: bool,
    /// G11: F applies at the point where the tool touches compensated arcs.
    pub(in crate::exec) engagement_feed: bool,
    /// G161: centres in program coordinates.
    pub(in crate::exec) centre_absolute: bool,
    /// G165.
    pub(in crate::exec) centre_correction: bool,
    /// The last programmed R of an arc, in mm.
    pub(in crate::exec) radius_mm: Option<f64>,
    /// The last programmed I, J and K of arcs in their planes, in mm, while they are modal (P-CHAN-00159).
    pub(in crate::exec) centre_mm: [Option<f64>; 3],
    pub(in crate::exec) look_ahead: LookAhead,
    pub(in crate::exec) compensation: Compensation,
    /// Outer corners of tool radius compensation.
    pub(in crate::exec) corners: Corners,
    /// Selection and deselection of tool radius compensation.
    pub(in crate::exec) selection: Selection,
    /// G51: the face turning axis, programmed in diameters.
    pub(in crate::exec) diameter: Option<usize>,
    /// What `#` commands set: the end of a cycle does not restore it.
    pub(in crate::exec) commanded: Commanded,
    /// I of G301/G302 in mm.
    pub(in crate::exec) insertion_mm: Option<f64>,
}

impl Modal {
    /// Millimetres per unit of length in the program.
    pub(in crate::exec) fn unit_mm(&self) -> f64 {
        if self.inch { INCH_MM } else { 1.0 }
    }

    /// Factor from programmed values of an axis to mm (deg).
    pub(in crate::exec) fn axis_unit(&self, axis: &Axis) -> f64 {
        if self.inch && axis.is_linear() { INCH_MM } else { 1.0 }
    }

    /// Unit of tolerance words in mm (P-CHAN-00439).
    pub(in crate::exec) fn tolerance_unit_mm(&self, channel: &Channel) -> f64 {
        if channel.language.contouring_consider_inch { self.unit_mm() } else { 1.0 }
    }

    /// Unit of an F word with G94 in mm/s.
    pub(in crate::exec) fn feed_unit_mm_s(&self, channel: &Channel) -> f64 {
        self.unit_mm() * channel.feed.unit_mm_min / 60.0
    }

    /// `R1`: the last radius programmed (R, `R1=`, G163), in the active unit (206014219).
    pub(in crate::exec) fn last_radius(&self, span: Span) -> Outcome<f64> {
        let radius_mm = self.radius_mm.ok_or_else(|| {
            let text = "R1 has no value: a radius has not been programmed";
            Fault::new(Condition::Undefined, text, span).hint("write R1=5 before it")
        })?;
        Ok(radius_mm / self.unit_mm())
    }

    pub(in crate::exec) fn feed(&self) -> Option<FeedWord> {
        self.feeds[self.feed_type as usize]
    }

    /// The F word in force in the active unit of length, 0 without one; the time of G93 and the share of G194 have none.
    pub(in crate::exec) fn feed_in_unit(&self) -> f64 {
        let Some(word) = self.feed() else { return 0.0 };
        let has_length = matches!(self.feed_type, FeedType::PerMinute | FeedType::PerRevolution);
        match (word.inch, self.inch) {
            (true, false) if has_length => word.value * INCH_MM,
            (false, true) if has_length => word.value / INCH_MM,
            _ => word.value,
        }
    }

    /// State at program start without presets of the channel list.
    pub(in crate::exec) fn start(slope: SlopeKind, constant_ramp_time: bool) -> Self {
        Self {
            path: PathMode::Linear,
            plane: Plane::Xy,
            mirrored: [false; 2],
            inch: false,
            absolute: true,
            feed_type: FeedType::PerMinute,
            feeds: [None; 4],
            exact_stop: false,
            contouring: false,
            late_braking: false,
            corner_deceleration: false,
            engagement_feed: false,
            centre_absolute: false,
            centre_correction: true,
            radius_mm: None,
            centre_mm: [None; 3],
            commanded: Commanded {
                slope: Slope { kind: slope, optimised: false, constant_ramp_time },
                old_slope: true,
                transition_min_mm_s: 0.0,
                engagement_radius_mm: 0.0,
                corner_stretch: 1.0,
                turns_back: false,
                perpendicular_change: false,
                compensation_suppressed: false,
            },
            look_ahead: LookAhead::Complete,
            compensation: Compensation::Off,
            corners: Corners::Straight,
            selection: Selection::default(),
            diameter: None,
            insertion_mm: None,
        }
    }

    /// Takes the start values of the channel list (P-CHAN-00054, 00063, 00099); reports those that are not simulated.
    pub(in crate::exec) fn presets(&mut self, channel: &Channel) -> Vec<Diagnostic> {
        let mut unknown = Vec::new();
        self.inch = channel.language.inch;
        if let Some(v) = channel.feed.start_mm_s {
            let value = v * 60.0 / channel.feed.unit_mm_min;
            let per_minute = FeedType::PerMinute as usize;
            self.feeds[per_minute] = Some(FeedWord { value, inch: false });
        }
        for (group, g) in &channel.language.g_groups {
            match (group, g) {
                (0, 0) => self.path = PathMode::Rapid,
                (0, 2) => self.path = PathMode::Clockwise,
                (0, 3) => self.path = PathMode::CounterClockwise,
                (4, 18) => self.plane = Plane::Zx,
                (4, 19) => self.plane = Plane::Yz,
                (6, 25) => self.corners = Corners::Straight,
                (6, 26) => self.corners = Corners::Round,
                (12, 70) => self.inch = true,
                (12, 71) => self.inch = false,
                (14, 91) => self.absolute = false,
                (22, 138) => self.selection = Selection::Direct,
                (22, 237) => self.selection = Selection::Perpendicular,
                (22, 238) => self.selection = Selection::InsideCorner,
                (22, 239) => self.selection = Selection::WithoutBlock,
                (23, 161) => self.centre_absolute = true,
                (25, 164) => self.centre_correction = false,
                // start values of the language; feedforward has a separate warning
                (0, 1)
                | (4, 17)
                | (8, 52)
                | (14, 90)
                | (22, 139)
                | (23, 162)
                | (25, 165)
                | (32, 140)
                | (21, _) => {}
                (0, 4) | (8, 51) | (22, 236) | (32, 141) => {
                    let text = format!("prog_start.g_gruppe[{group}].nr {g} is not simulated");
                    let d = Diagnostic::new(Condition::Fallback, text).parameter(of::G_GROUP);
                    unknown.push(d);
                }
                // 149290763, 252656267
                (group, g) => {
                    let what = match groups::row(*g) {
                        Some(_) => "not permitted as a start value",
                        None => "no G function",
                    };
                    let text = format!("prog_start.g_gruppe[{group}].nr {g} is {what}");
                    let d = Diagnostic::new(Condition::PresetFunction, text).parameter(of::G_GROUP);
                    unknown.push(d);
                }
            }
        }
        unknown
    }
}
