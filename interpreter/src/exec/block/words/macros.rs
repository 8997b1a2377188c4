//! Macros: definitions take effect while the words of a block are collected.

use crate::diag::{Condition, ValueKind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::program::state::Calls;
use crate::exec::report::Report;
use crate::machine::Channel;
use crate::machine::table::channel as of;
use crate::suggest;
use crate::syntax::ast::{MacroDefinition, Span};

impl Calls {
    /// `"NAME" = "NC code"`.
    pub(super) fn define_macro(
        &mut self,
        definition: &MacroDefinition,
        channel: &Channel,
        report: &mut Report,
        span: Span,
    ) -> Outcome<()> {
        let name = definition.name.trim_ascii();
        macro_fits(channel, name, &definition.text, span, report)?;
        let before = self.macros.insert(name.into(), definition.text.clone());
        // blocks that contain the earlier text must be parsed again
        self.macros_changed |= before.as_ref() != Some(&definition.text);
        Ok(())
    }
}

impl Calls {
    /// A macro without a definition in the blocks before.
    pub(super) fn undefined_macro(&self, name: &str, span: Span) -> Box<Fault> {
        let text = format!("macro \"{name}\" is not defined");
        let known = self.macros.keys().map(|k| &**k);
        let fault = Fault::new(Condition::Undefined, text, span);
        match suggest::hint(name, known) {
            _ if self.macros.contains_key(name.trim_ascii()) => {
                fault.hint("it is defined in this block and valid from the next block on")
            }
            Some(hint) => fault.hint(hint),
            None => fault.hint(
                "define it before its use: \"NAME\" = \"NC code\", or in the channel list (makro_def)",
            ),
        }
    }
}

/// Checks the length of the name and the text of a macro (P-CHAN-00511, 00512).
///
/// Assumption: the pages print an ID for the name only; a text beyond its limit is used, with the warning K-RANGE.
fn macro_fits(
    channel: &Channel,
    name: &str,
    text: &str,
    span: Span,
    report: &mut Report,
) -> Outcome<()> {
    for (what, written, most, condition, parameter) in [
        (
            "name",
            name,
            channel.macros.name_length,
            Condition::MacroNameLength,
            of::MACRO_NAME_LENGTH,
        ),
        ("text", text, channel.macros.text_length, Condition::Range, of::MACRO_TEXT_LENGTH),
    ] {
        let length = written.chars().count();
        if length > most as usize {
            let text = format!("the {what} of the macro has {length} characters, maximum: {most}");
            let fault = Fault::new(condition, text, span)
                .with(|d| d.value(ValueKind::UpperLimit, most, "-").parameter(parameter));
            if condition != Condition::Range {
                return Err(fault);
            }
            report.note(fault.warning());
        }
    }
    Ok(())
}
