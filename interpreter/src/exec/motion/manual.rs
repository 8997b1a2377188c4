//! Manual mode, G200 to G202: there is no operator, so the manual offsets stay 0. Under G201 the path has only its share of the
//! dynamics of the named axes.
//!
//! Source: TF5200 programming manual 206639371, 206633483, tccncprogramming 15556788363; dynamic parameters 248646795.

use crate::diag::Condition;
use crate::exec::block::collected::{GWord, Words};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::report::Subject;
use crate::exec::step::Sync;
use crate::syntax::ast::Group;

impl Decoder {
    /// G200: the path stops and continues at once, because *continue motion* ends the mode. G201 and G202 enable or disable
    /// manual motion of the named axes in parallel with the path, which is limited to P-AXIS-00094 and P-AXIS-00095 meanwhile.
    ///
    /// 20038 for G201 without an axis. The values of the axis words are ignored.
    pub(in crate::exec) fn manual_mode(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        let mut axes: Vec<usize> = words.axes.iter().map(|(axis, _, _)| *axis).collect();
        for (hash, _, _) in words.hashes.iter().filter(|(hash, _, _)| &*hash.name == "ACHSE") {
            let bracket: &[Group] = hash.bracket.as_slice();
            let named = self.names.all_in_command(bracket)?;
            if let Some(axis) =
                named.iter().enumerate().find(|(i, axis)| named[..*i].contains(axis))
            {
                let text = format!("axis {} twice after #ACHSE", self.names.name(*axis.1));
                return Err(Fault::new(Condition::ManualAxisTwice, text, g.span));
            }
            axes.extend(named);
        }
        if g.row.number == 201 && axes.is_empty() {
            return Err(Fault::new(Condition::ManualWithoutAxis, "G201 without an axis", g.span));
        }
        self.motion.limits.changed();
        let text = match g.row.number {
            200 => {
                self.sync(Sync::FlushWait);
                self.motion.manual.fill(false);
                "G200: the axes are not moved by hand, the program continues immediately"
            }
            202 => {
                for (axis, manual) in self.motion.manual.iter_mut().enumerate() {
                    *manual &= !(axes.is_empty() || axes.contains(&axis));
                }
                return Ok(());
            }
            _ => {
                for axis in axes {
                    self.motion.manual[axis] = true;
                }
                "G201: the axes are not moved by hand, the path has its share of their dynamics (P-AXIS-00094, P-AXIS-00095)"
            }
        };
        let fault = Fault::new(Condition::Fallback, text, g.span);
        self.report.note_once(Subject::G(g.row.number), fault);
        Ok(())
    }
}
