//! Akima splines: a curve through the programmed points with a continuous tangent (G151, `#SPLINE ON`).
//!
//! Each axis is a cubic over the lengths of the chords. The derivative at a point is computed from two chords on either side of
//! it with the weights of Akima (J. ACM 17 (1970) 589, equation 1): a side with similar slopes has more weight. At the ends two
//! chords are extrapolated, or the tangent of the motion before or after, or of the program, is used.
//!
//! Assumptions: the parameter is the chord length over the feed axes, or over all axes if none of them moves; if the weights of
//! both sides are 0, both chords have equal weight; a given tangent has the length 1.
//!
//! A spline of two points needs both tangents (K-0151).
//!
//! Source: TF5200 programming manual, Akima splines (`#AKIMA TRANS`, `#AKIMA STARTVECTOR`, `#AKIMA ENDVECTOR`; 207216267); 120112.
//! Assumption: after a rest there is no direction, and a tangential start is automatic; the vendor asks for a motion before it
//! alone.

mod segment;

use super::motion::Motion;
use crate::diag::Condition;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::path::Path;
pub(super) use segment::Curve;
use segment::{chord, curved};
use std::collections::VecDeque;

/// Number of chords after a segment that determine its end.
const AHEAD: usize = 2;

/// Number of chords before a segment that determine its start.
const BEHIND: usize = 2;

/// Determination of the tangent at an end of a spline.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::exec) enum Transition {
    /// From the points.
    #[default]
    Auto,
    /// That of the motion before or after.
    Tangential,
    /// `#AKIMA STARTVECTOR`, `#AKIMA ENDVECTOR`.
    User,
}

/// One end of splines.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::exec) struct End {
    pub(in crate::exec) transition: Transition,
    /// Components of the tangent by axis; axes without one get theirs from the points.
    vector: Vec<(usize, f64)>,
    /// Whether no spline has begun or ended since the vector was programmed.
    unread: bool,
    /// Whether a spline has begun with it since G151.
    used: bool,
}

impl End {
    /// `#AKIMA STARTVECTOR`, `#AKIMA ENDVECTOR`.
    pub(in crate::exec) fn set_vector(&mut self, vector: Vec<(usize, f64)>) {
        self.unread = !vector.is_empty();
        self.vector = vector;
    }

    /// Whether the program states the tangent, in every axis that moves along the chord.
    fn is_stated(&self, chord: &[f64]) -> bool {
        match self.transition {
            Transition::Auto => false,
            Transition::Tangential => true,
            Transition::User => {
                let named = |axis: usize| self.vector.iter().any(|(named, _)| *named == axis);
                chord.iter().enumerate().all(|(axis, way)| *way == 0.0 || named(axis))
            }
        }
    }

    /// K-0100: a vector that the end of a spline does not have, because it is that of an arc or has another transition.
    fn unused_vector(&self, at_arc: bool, [command, key]: [&str; 2], at: Span) -> Option<Fault> {
        let (why, hint) = match self.transition {
            Transition::User if at_arc && !self.vector.is_empty() => (
                "beside an arc the spline has the tangent of the arc".to_owned(),
                "arcs interrupt a spline tangentially; write G150 before the arc, or G151 after it"
                    .to_owned(),
            ),
            Transition::Auto | Transition::Tangential if self.unread => {
                (format!("{key} is not USER"), format!("write #AKIMA TRANS [{key}=USER]"))
            }
            _ => return None,
        };
        let text = format!("#AKIMA {command} has no effect here: {why}");
        Some(*Fault::new(Condition::Ignored, text, at).hint(hint))
    }

    /// Derivatives of single axes, or of all.
    fn tangent(&self, neighbour: Option<AxisVec>) -> Given {
        match (self.transition, neighbour) {
            (Transition::Auto, _) | (Transition::Tangential, None) => Given::Nothing,
            (Transition::Tangential, Some(direction)) => Given::All(direction),
            (Transition::User, _) => {
                let length = self.vector.iter().map(|(_, x)| x * x).sum::<f64>().sqrt();
                if length <= 0.0 {
                    return Given::Nothing;
                }
                Given::Some(self.vector.iter().map(|(axis, x)| (*axis, x / length)).collect())
            }
        }
    }
}

/// The given components of a tangent.
#[derive(Clone, Debug)]
enum Given {
    Nothing,
    Some(Vec<(usize, f64)>),
    All(AxisVec),
}

impl Given {
    fn over(self, mut automatic: AxisVec) -> AxisVec {
        match self {
            Self::Nothing => {}
            Self::Some(axes) => axes.into_iter().for_each(|(axis, x)| automatic[axis] = x),
            Self::All(direction) => automatic = direction,
        }
        automatic
    }
}

/// A spline with incomplete segments.
#[derive(Debug)]
struct Run {
    /// Segments that need the chords after them.
    waiting: VecDeque<Box<Motion>>,
    /// Slopes of up to [`BEHIND`] chords before them, then their own.
    slopes: VecDeque<AxisVec>,
    /// The given tangent at the start, until the first segment is complete.
    start: Option<Given>,
    /// Derivative at the start of the first incomplete segment.
    tangent: Option<AxisVec>,
    /// Whether it continues behind an arc.
    behind_arc: bool,
}

/// The stage.
#[derive(Debug, Default)]
pub(in crate::exec) struct Akima {
    pub(in crate::exec) start: End,
    pub(in crate::exec) end: End,
    /// Whether G151 is active.
    pub(in crate::exec) selected: bool,
    /// Whether there was a motion before, which gives the direction of a tangential start.
    pub(super) moved: bool,
    /// Whether an arc has interrupted the spline, which then continues tangentially.
    behind_arc: bool,
    run: Option<Box<Run>>,
}

/// Direction of a path at one of its ends, by its length.
fn direction(path: &Path, end: bool) -> AxisVec {
    let mut direction = path.start().clone();
    path.tangent(if end { path.length() } else { 0.0 }, &mut direction);
    direction
}

impl Run {
    /// Slope of a chord counted from the first incomplete segment; extrapolated beyond the ends.
    fn slope(&self, chord: isize) -> AxisVec {
        let before = self.slopes.len() - self.waiting.len();
        let index = chord + before.cast_signed();
        let last = self.slopes.len().cast_signed() - 1;
        let beyond = |edge: usize, next: usize, steps: f64| {
            let (edge, next) = (&self.slopes[edge], &self.slopes[next]);
            edge.iter().zip(next.iter()).map(|(e, n)| e + (e - n) * steps).collect()
        };
        if self.slopes.len() == 1 {
            return self.slopes[0].clone();
        }
        if index < 0 {
            beyond(0, 1, -index as f64)
        } else if index > last {
            beyond(last.cast_unsigned(), last.cast_unsigned() - 1, (index - last) as f64)
        } else {
            self.slopes[index.cast_unsigned()].clone()
        }
    }

    /// Akima's derivative at the start of a segment.
    fn derivative(&self, segment: isize) -> AxisVec {
        let [a, b, c, d] = [-2, -1, 0, 1].map(|k| self.slope(segment + k));
        (0..a.len())
            .map(|i| {
                let (before, behind) = ((d[i] - c[i]).abs(), (b[i] - a[i]).abs());
                let both = before + behind;
                if both > 0.0 {
                    (before * b[i] + behind * c[i]) / both
                } else {
                    0.5 * (b[i] + c[i])
                }
            })
            .collect()
    }

    /// Completes the first incomplete segment; `end` is given at its end.
    fn complete(&mut self, end: Given) -> Option<Outcome<Curve>> {
        let from = match (self.start.take(), self.tangent.take()) {
            (Some(given), _) => given.over(self.derivative(0)),
            (None, Some(tangent)) => tangent,
            (None, None) => self.derivative(0),
        };
        let to = end.over(self.derivative(1));
        let motion = self.waiting.pop_front()?;
        let before = self.slopes.len() - self.waiting.len();
        for _ in BEHIND..before {
            self.slopes.pop_front();
        }
        let done = curved(motion, &from, &to);
        self.tangent = Some(to);
        Some(done)
    }
}

impl Akima {
    /// G150, G151; a note if the spline has ended without the tangent that the program states for its end.
    pub(in crate::exec) fn select(&mut self, on: bool, at: Span) -> Vec<Fault> {
        let at_arc = std::mem::take(&mut self.behind_arc) && self.run.is_none();
        let ends = self.start.used && !on;
        self.start.used &= on && self.selected;
        self.selected = on;
        if !ends {
            return Vec::new();
        }
        let unused = self.end.unused_vector(at_arc, ["ENDVECTOR", "END"], at);
        self.end.unread = false;
        unused.into_iter().collect()
    }

    /// A note if the first spline of G151 begins without the tangent that the program states for its start.
    pub(super) fn unused_start(&self, motion: &Motion) -> Option<Fault> {
        let begins = !self.start.used && self.run.is_none();
        begins
            .then(|| {
                self.start.unused_vector(self.behind_arc, ["STARTVECTOR", "START"], motion.span)
            })
            .flatten()
    }

    /// A motion outside splines, while none is in progress: the next one continues tangentially behind an arc.
    pub(super) fn pass(&mut self, motion: &Motion) {
        self.moved = true;
        self.behind_arc = self.selected && !motion.block.path.is_straight();
    }

    /// Whether a spline is in progress.
    pub(in crate::exec) fn runs(&self) -> bool {
        self.run.is_some()
    }

    /// A point of the spline; `before`: the motion before it, unless the path stops.
    pub(super) fn point(
        &mut self,
        motion: Box<Motion>,
        before: Option<&Motion>,
        out: &mut Vec<Curve>,
    ) -> Outcome<()> {
        let tangential = self.start.transition == Transition::Tangential;
        if self.run.is_none() && tangential && !self.moved {
            // reported once
            self.moved = true;
            let text = "a spline with a tangential start requires a motion before it";
            return Err(Fault::new(Condition::SplineWithoutMotion, text, motion.span)
                .in_block(motion.source));
        }
        let (_, slope) = chord(&motion);
        let run = self.run.get_or_insert_with(|| {
            let neighbour = before.map(|before| direction(&before.block.path, true));
            let behind_arc = std::mem::take(&mut self.behind_arc);
            let given = match (behind_arc, &neighbour) {
                (true, Some(direction)) => Given::All(direction.clone()),
                _ => self.start.tangent(neighbour),
            };
            Box::new(Run {
                waiting: VecDeque::new(),
                slopes: VecDeque::new(),
                start: Some(given),
                tangent: None,
                behind_arc,
            })
        });
        (self.start.used, self.start.unread) = (true, false);
        run.waiting.push_back(motion);
        run.slopes.push_back(slope);
        while run.waiting.len() > AHEAD {
            out.extend(run.complete(Given::Nothing).transpose()?);
        }
        Ok(())
    }

    /// End of the spline; `behind`: the motion that follows without a stop.
    pub(super) fn finish(&mut self, behind: Option<&Motion>, out: &mut Vec<Curve>) -> Outcome<()> {
        let Some(mut run) = self.run.take() else { return Ok(()) };
        let neighbour = behind.map(|behind| direction(&behind.block.path, false));
        let is_arc = behind.is_some_and(|b| !b.block.path.is_straight());
        self.behind_arc = self.selected && is_arc;
        if let ([motion], [chord]) = (run.waiting.make_contiguous(), run.slopes.make_contiguous())
            && run.start.is_some()
            && !((run.behind_arc || self.start.is_stated(chord))
                && (self.behind_arc || self.end.is_stated(chord)))
        {
            let text = "a spline of two points whose tangents are not both stated";
            return Err(
                Fault::new(Condition::SplineTooShort, text, motion.span).in_block(motion.source)
            );
        }
        let mut end = match (self.behind_arc, neighbour) {
            (true, Some(direction)) => Given::All(direction),
            (_, neighbour) => self.end.tangent(neighbour),
        };
        while !run.waiting.is_empty() {
            let given = if run.waiting.len() == 1 {
                std::mem::replace(&mut end, Given::Nothing)
            } else {
                Given::Nothing
            };
            out.extend(run.complete(given).transpose()?);
        }
        Ok(())
    }

    /// Discards the last point: its block has an error.
    pub(super) fn drop_last(&mut self) -> bool {
        let Some(run) = &mut self.run else { return false };
        run.slopes.pop_back();
        run.waiting.pop_back().is_some()
    }
}

/// A stop in a spline.
pub(super) fn rest_inside() -> Box<Fault> {
    Fault::unsupported("a stop of the path inside a spline", Span::default())
}
