//! Jumps within a level, and returns to a position in a higher one.
//!
//! A jump may leave control blocks, which closes them. It may enter branches of `$IF`, which are then executed as if
//! their condition had been true (assumption), but neither loops (21480) nor `$SWITCH`.
//!
//! Assumptions for `M17 [..]`: `JUMPS=1` is the return without brackets; JUMPS beyond the main program causes K-0109,
//! because the documents print no number for this warning; if several blocks have the same number, the first one
//! counts.
//!
//! Source: TF5200 programming manual, `$GOTO` (206915851) and ends of subroutines (206781707).

use super::executor::Executor;
use super::index::{LABEL_MAX, LabelPlace};
use super::level::Landing;
use crate::diag::{Condition, ValueKind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::syntax::ast::{Jump, JumpKind, LabelKind, Return, ReturnLevel, Span};

impl Executor {
    /// The label of a jump; a computed number is rounded like that of a block (206817035).
    fn label_of(&mut self, jump: &Jump) -> Outcome<LabelKind> {
        match &jump.kind {
            JumpKind::Label(LabelKind::Number(number)) if *number > LABEL_MAX => {
                Err(label_too_large(*number as f64, jump.span))
            }
            JumpKind::Label(label) => Ok(label.clone()),
            JumpKind::Number(expr) => {
                let number = self.decoder.number(expr)?;
                match number.round() {
                    n if (0.0..=LABEL_MAX as f64).contains(&n) => Ok(LabelKind::Number(n as u64)),
                    n if n > 0.0 => Err(label_too_large(n, expr.span)),
                    _ => {
                        let text = format!("label N{number}: does not exist in this program");
                        Err(Fault::new(Condition::Label, text, expr.span))
                    }
                }
            }
            JumpKind::Name(place) => match self.decoder.read(place)? {
                Value::Text(name) => Ok(LabelKind::Name(name.trim().to_uppercase().into())),
                Value::Number(_) => {
                    let text = "the variable holds a number, not the name of a label";
                    let hint = "$GOTO NV.E.NAME jumps to the block with this number";
                    Err(Fault::new(Condition::Syntax, text, place.span).hint(hint))
                }
            },
        }
    }

    /// `$GOTO`.
    pub(in crate::exec) fn goto(&mut self, jump: &Jump) {
        let Some(level) = self.levels.len().checked_sub(1) else { return };
        let outcome = self.label_of(jump).and_then(|label| {
            let part = &self.levels[level];
            let Some(place) = part.index.label(part.section, &label) else {
                let text = format!("label {} does not exist in this program", shown(&label));
                let hint = "write a label first in its block: N20: or [NAME]";
                return Err(Fault::new(Condition::Label, text, jump.span).hint(hint));
            };
            let from = self.position.offset;
            part.landing(from, place, &format!("label {}", shown(&label)), jump.span)
        });
        if let Some(landing) = self.decoder.report.keep(outcome) {
            self.levels.land(landing, self.position.offset, &mut self.files);
        }
    }

    /// `M17 [..]`, `M29 [..]`; without a valid target the program continues after the call.
    pub(in crate::exec) fn return_to(&mut self, back: &Return, span: Span) {
        let outcome = self.way_back(back, span);
        let (levels, landing) = self.decoder.report.keep(outcome).unwrap_or((1, None));
        let then = self.leave_levels(levels.max(1));
        match (landing, self.levels.last(), then) {
            (Some(landing), Some(level), _) => {
                let from = level.at.offset;
                self.levels.land(landing, from, &mut self.files);
            }
            (_, _, Some(closing)) => self.close(closing),
            _ => {}
        }
    }

    /// The number of levels that a return leaves, and its target.
    fn way_back(&mut self, back: &Return, span: Span) -> Outcome<(usize, Option<Landing>)> {
        let above = self.levels.len().saturating_sub(1);
        if above == 0 {
            let text = format!("M{} returns to another level or to a label", back.number);
            let text = format!("{text}: there is no level above the main program");
            return Err(Fault::new(Condition::Syntax, text, span)
                .hint("use M30 to end the main program, $GOTO to jump within it"));
        }
        let levels = match &back.level {
            ReturnLevel::Caller => 1,
            ReturnLevel::Main => above,
            ReturnLevel::Jumps(expr) => {
                let levels = self.decoder.whole(expr, "JUMPS", 1, u32::MAX)? as usize;
                if levels > above {
                    let text = format!(
                        "JUMPS={levels}, the main program is {above} up: the program continues there"
                    );
                    let fault = Fault::new(Condition::Odd, text, expr.span).warning();
                    self.decoder.report.note(fault.hint("use MAIN to return to the main program"));
                }
                levels.min(above)
            }
        };
        let Some(jump) = &back.target else { return Ok((levels, None)) };
        let label = self.label_of(jump)?;
        let level = above - levels;
        let place = self.place_of(level, &label, jump.span)?;
        let name = match label {
            LabelKind::Number(n) => format!("block N{n}"),
            LabelKind::Name(_) => format!("label {}", shown(&label)),
        };
        let from = self.levels[level].at.offset;
        Ok((levels, Some(self.levels[level].landing(from, place, &name, jump.span)?)))
    }

    /// A label of a level, otherwise the block with this number.
    fn place_of(&mut self, level: usize, label: &LabelKind, span: Span) -> Outcome<LabelPlace> {
        let (file, section) = (self.levels[level].file, self.levels[level].section);
        if let Some(place) = self.levels[level].index.label(section, label) {
            return Ok(place);
        }
        let program = self.program_of(level);
        if let LabelKind::Number(number) = label {
            self.sequences.learn(&mut self.files, (file, section), span)?;
            let report = &mut self.decoder.report;
            let place = self.sequences.find((file, section), *number, span, report);
            if let Some(place) = place {
                return Ok(place);
            }
            let text = format!("{program} has neither a label nor a block N{number}");
            return Err(Fault::new(Condition::Label, text, span));
        }
        let text = format!("label {} does not exist in {program}", shown(label));
        let hint = "write a label first in its block: N20: or [NAME]";
        Err(Fault::new(Condition::Label, text, span).hint(hint))
    }

    /// Name of the program of a level.
    fn program_of(&self, level: usize) -> String {
        let level = &self.levels[level];
        match &level.index.sections[level.section].name {
            Some(name) => name.to_string(),
            None => self.files.file(level.file).name.to_string(),
        }
    }
}

fn label_too_large(number: f64, span: Span) -> Box<Fault> {
    let text = format!("label N{number} is outside the data format");
    Fault::new(Condition::LabelTooLarge, text, span).with(|d| {
        d.value(ValueKind::Wrong, number, "-").value(ValueKind::LowerLimit, 0.0, "-").value(
            ValueKind::UpperLimit,
            LABEL_MAX as f64,
            "-",
        )
    })
}

/// A label as written.
fn shown(label: &LabelKind) -> String {
    match label {
        LabelKind::Number(n) => format!("N{n}:"),
        LabelKind::Name(name) => format!("[{name}]"),
    }
}
