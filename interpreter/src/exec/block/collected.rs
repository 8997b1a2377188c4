//! The words collected from one block.

use crate::diag::Condition;
use crate::exec::block::groups::{Act, Group, Row};
use crate::exec::fault::Fault;
use crate::exec::options::Value;
use crate::exec::report::Report;
use crate::syntax::ast::{Bracket, Call, HashWord, Jump, Return, Sign, Span};
use smallvec::SmallVec;

/// A value with its position in the text.
pub(in crate::exec) type Placed = (f64, Span);

/// A G function of the block.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct GWord {
    pub(in crate::exec) row: &'static Row,
    pub(in crate::exec) value: Option<f64>,
    pub(in crate::exec) span: Span,
}

/// An M or H function of the block.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct Code {
    pub(in crate::exec) number: u32,
    pub(in crate::exec) value: Option<f64>,
    pub(in crate::exec) span: Span,
}

/// An implicit subroutine call.
#[derive(Clone, Debug)]
pub(in crate::exec) struct CycleCall {
    pub(in crate::exec) number: u32,
    /// Values in written order, `None` for an omitted one; without values it is not a cycle.
    pub(in crate::exec) values: Option<Vec<Option<Value>>>,
    pub(in crate::exec) span: Span,
}

/// The words of one block.
#[derive(Debug, Default)]
pub(in crate::exec) struct Words<'b> {
    pub(in crate::exec) g: SmallVec<[GWord; 6]>,
    /// Axis, value as written, position in the text.
    pub(in crate::exec) axes: SmallVec<[(usize, f64, Span); 8]>,
    /// First sign of the words of modulo axes: the direction of rotation; or the position of a sum with a first sign that may
    /// also belong to its first term.
    pub(in crate::exec) turns: SmallVec<[(usize, Result<Sign, Span>); 1]>,
    /// G90 and G91 that apply from their position on (P-CHAN-00116): number of axis words before, and whether absolute.
    pub(in crate::exec) dimensions: SmallVec<[(usize, bool); 2]>,
    /// I, J, K.
    pub(in crate::exec) centre: [Option<Placed>; 3],
    pub(in crate::exec) radius: Option<Placed>,
    pub(in crate::exec::block) feed: Option<Placed>,
    pub(in crate::exec) end_feed: Option<Placed>,
    /// Spindle and speed.
    pub(in crate::exec) speeds: SmallVec<[(usize, f64, Span); 1]>,
    /// Spindle and angle of M19 (`S.POS=180`).
    pub(in crate::exec) angles: SmallVec<[(usize, f64, Span); 1]>,
    /// Spindle and angle of the start of a thread (`S.OFFSET=90`).
    pub(in crate::exec) offsets: SmallVec<[(usize, f64, Span); 1]>,
    pub(in crate::exec::block) tool: Option<Placed>,
    pub(in crate::exec::block) tool_data: Option<Placed>,
    /// A write to `V.G.WZ_AKT`.
    pub(in crate::exec::block) tool_written: Option<(Condition, Span)>,
    pub(in crate::exec) m: SmallVec<[Code; 4]>,
    pub(in crate::exec::block) h: SmallVec<[Code; 1]>,
    pub(in crate::exec::block) cycle: Option<CycleCall>,
    pub(in crate::exec) brackets: SmallVec<[&'b Bracket; 1]>,
    pub(in crate::exec) hashes: SmallVec<[(&'b HashWord, Option<f64>, Span); 1]>,
    pub(in crate::exec::block) call: Option<(&'b Call, Span)>,
    pub(in crate::exec) goto: Option<&'b Jump>,
    /// `#ADD`, the last word.
    pub(in crate::exec::block) addition: Option<(&'b HashWord, Span)>,
    /// Where the last assignment ends.
    pub(in crate::exec::block) assigned_to: Option<u32>,
    /// Target of M17 or M29, if they name one.
    pub(in crate::exec::block) back: Option<(&'b Return, Span)>,
}

impl<'b> Words<'b> {
    /// A G function of this block that moves, measures, dwells or stops.
    pub(in crate::exec) fn of_the_path(&self) -> Option<&GWord> {
        self.g.iter().find(|g| {
            matches!(g.row.group, Group::Path | Group::Measuring) || g.row.act == Act::ExactStopOnce
        })
    }

    /// K-0157 for the first further function or word beside a function that must be alone in its block; its axis words, and for G04 the
    /// S word, belong to it.
    ///
    /// Source: TF5200 programming manual 206132747 (G04), 206266379 (G351); the pages print no ID.
    pub(in crate::exec) fn must_be_alone(&self, g: &GWord, report: &mut Report) {
        let functions = self.g.iter().filter(|other| other.span != g.span).map(|other| other.span);
        let codes = self.m.iter().chain(&self.h).map(|code| code.span);
        let placed = [self.tool, self.tool_data, self.feed, self.end_feed, self.radius];
        let placed = placed.into_iter().chain(self.centre).flatten().map(|(_, span)| span);
        let speeds = self.speeds.iter().filter(|_| g.row.number != 4).map(|(_, _, span)| *span);
        let brackets = self.brackets.iter().map(|bracket| bracket.group.span);
        let others = functions.chain(codes).chain(placed).chain(speeds).chain(brackets);
        if let Some(span) = others.min_by_key(|span| span.start) {
            let text = format!("another word in the block of G{:02}", g.row.number);
            report.note(Fault::new(Condition::NotAlone, text, span));
        }
    }

    /// Whether the signal of a measuring run decides on the jump (G310).
    pub(in crate::exec) fn jumps_on_signal(&self) -> bool {
        self.g.iter().any(|g| g.row.number == 310)
    }

    /// The brackets before one of them.
    pub(in crate::exec) fn brackets_before(
        &self,
        bracket: &Bracket,
    ) -> impl Iterator<Item = &'b Bracket> {
        self.brackets.iter().copied().take_while(move |other| !std::ptr::eq(*other, bracket))
    }

    /// The first word of an axis before a position in the block.
    pub(in crate::exec) fn axis_before(&self, at: Span) -> Option<Span> {
        self.axes.iter().map(|(_, _, span)| *span).find(|span| span.start < at.start)
    }

    /// Whether the axis word with index `i` is absolute; `modal` is the active dimension after the block.
    pub(in crate::exec) fn is_absolute(&self, i: usize, modal: bool) -> bool {
        let last = self.dimensions.iter().rfind(|(place, _)| *place <= i);
        last.map_or(modal, |(_, absolute)| *absolute)
    }

    /// The first G function with this effect.
    pub(in crate::exec) fn with(&self, act: Act) -> Option<&GWord> {
        self.g.iter().find(|g| g.row.act == act)
    }

    /// Whether a G function has this effect.
    pub(in crate::exec) fn has(&self, act: Act) -> bool {
        self.with(act).is_some()
    }

    /// The G function of a group.
    pub(in crate::exec) fn group(&self, group: Group) -> Option<&GWord> {
        self.g.iter().find(|g| g.row.group == group)
    }
}
