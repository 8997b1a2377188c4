//! The bracket of an independent axis: `X[INDP_SYN G90 G01 FEED=1000 POS=50]`.

use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::slope::{slope_of_number, slope_type};
use crate::exec::step::Event;
use crate::exec::values::number::whole;
use crate::syntax::ast::{Ident, Item, ItemKind, ItemValue, Span};
use kontur_motion::block::SlopeKind;
use kontur_motion::independent::IndependentSpeed;

/// Contents of the bracket.
#[derive(Debug, Default)]
pub(super) struct Words {
    pub(super) position: Option<(f64, Span)>,
    pub(super) relative: Option<bool>,
    pub(super) rapid: Option<bool>,
    pub(super) speed: Option<(IndependentSpeed, Span)>,
    pub(super) slope: Option<SlopeKind>,
    /// INCL_OFFSETS.
    pub(super) offsets: Option<Span>,
    pub(super) functions: Vec<Event>,
}

/// Words that are valid but not simulated.
const UNSUPPORTED: &[&str] = &["G100", "DRY_RUN", "ACC_WEIGHT", "RAPID_ACC_WEIGHT"];

/// A fault in the words of the bracket.
pub(super) fn wrong(text: impl Into<String>, span: Span) -> Box<Fault> {
    let hint = "X[INDP_SYN G90 G01 FEED=1000 POS=50]";
    Fault::new(Condition::IndependentSyntax, text, span).hint(hint)
}

/// Sets a word that may appear only once.
fn once<T>(slot: &mut Option<T>, value: T, what: &str, span: Span) -> Outcome<()> {
    if slot.replace(value).is_some() {
        let text = format!("{what} twice in a bracket: the last one would be used");
        return Err(Fault::new(Condition::IndependentRedundant, text, span));
    }
    Ok(())
}

impl Words {
    /// The words of a bracket of an axis.
    pub(super) fn read(decoder: &Decoder, axis: usize, items: &[Item]) -> Outcome<Self> {
        let mut words = Self::default();
        let unit_mm_s = decoder.machine.channel.feed.unit_mm_min / 60.0
            * decoder.modal.axis_unit(&decoder.machine.axes[axis]);
        let measuring = decoder.motion.measuring.kind;
        for item in items {
            match &item.kind {
                ItemKind::Missing => {}
                ItemKind::Flag(word) => words.flag(word, measuring, unit_mm_s)?,
                ItemKind::Pair { key, value: ItemValue::Expr(expr) } => {
                    let value = decoder.number(expr)?;
                    words.value(key, value, item.span, unit_mm_s)?;
                }
                ItemKind::Pair { key, value: ItemValue::Name(name) } if key.is("SLOPE_TYPE") => {
                    let Some(kind) = slope_type(&name.text) else {
                        let text = format!("unknown slope type {}", name.text);
                        return Err(wrong(text, name.span));
                    };
                    once(&mut words.slope, kind, "the slope", name.span)?;
                }
                ItemKind::Pair { .. } | ItemKind::Target { .. } | ItemKind::Value(_) => {
                    return Err(wrong("a word of independent axes is expected", item.span));
                }
            }
        }
        Ok(words)
    }

    /// A word without `=`; `kind`: the measuring type.
    fn flag(&mut self, word: &Ident, kind: u32, unit_mm_s: f64) -> Outcome<()> {
        if word.is("G100") && !matches!(kind, 1 | 2 | 7) {
            let text = format!("G100 of an independent axis with measuring type {kind}");
            return Err(Fault::new(Condition::IndependentMeasuring, text, word.span));
        }
        if UNSUPPORTED.iter().any(|w| word.is(w)) {
            let what = format!("{} of an independent axis", word.text);
            return Err(Fault::unsupported(what, word.span));
        }
        if word.is("INCL_OFFSETS") {
            return once(&mut self.offsets, word.span, "INCL_OFFSETS", word.span);
        }
        let (name, number) = word.split_number().unwrap_or((&word.text, f64::NAN));
        let code = whole(number, 0, 65535);
        match (name.to_ascii_uppercase().as_str(), code) {
            ("G", Some(number @ (90 | 91))) => {
                once(&mut self.relative, number == 91, "G90 and G91", word.span)?;
            }
            ("G", Some(number @ (0 | 1))) => {
                once(&mut self.rapid, number == 0, "G00 and G01", word.span)?;
            }
            ("M", Some(number)) => {
                self.functions.push(Event::MFunction { number, value: None });
            }
            ("H", Some(number)) => {
                self.functions.push(Event::HFunction { number, value: None });
            }
            (_, _) if number.is_finite() && !name.eq_ignore_ascii_case("G") => {
                let key = Ident { text: name.into(), span: word.span };
                self.value(&key, number, word.span, unit_mm_s)?;
            }
            _ => return Err(wrong(format!("unknown word `{}`", word.text), word.span)),
        }
        Ok(())
    }

    /// A word with a value; `unit_mm_s`: unit of a feed rate.
    fn value(&mut self, key: &Ident, value: f64, span: Span, unit_mm_s: f64) -> Outcome<()> {
        if UNSUPPORTED.iter().any(|w| key.is(w)) {
            let what = format!("{} of an independent axis", key.text);
            return Err(Fault::unsupported(what, span));
        }
        if key.is("POS") {
            return once(&mut self.position, (value, span), "POS", span);
        }
        if key.is("SLOPE_PROFIL") {
            let number = whole(value, 0, 3);
            let kind = number.and_then(slope_of_number);
            let kind = kind.ok_or_else(|| wrong("use a slope type from 0 to 3", span))?;
            return once(&mut self.slope, kind, "the slope", span);
        }
        // F is the older keyword
        let speed = if key.is("FEED") || key.is("F") {
            IndependentSpeed::Feed(value * unit_mm_s)
        } else if key.is("TIME") {
            IndependentSpeed::Time(value)
        } else if key.is("FEED_MAX_WEIGHT") && value <= 100.0 {
            IndependentSpeed::ShareOfMaximum(value / 100.0)
        } else if key.is("FEED_MAX_WEIGHT") {
            return Err(wrong("use a FEED_MAX_WEIGHT up to 100 %", span));
        } else {
            return Err(wrong(format!("unknown word `{}`", key.text), span));
        };
        if value <= 0.0 || !value.is_finite() {
            return Err(wrong(format!("{} must be above 0", key.text), span));
        }
        if self.speed.replace((speed, span)).is_some() {
            return Err(wrong("more than one of FEED, TIME and FEED_MAX_WEIGHT", span));
        }
        Ok(())
    }

    /// The speed of the motion, by G00, or by G01 and its feed or time.
    pub(super) fn speed_of_motion(&self, span: Span) -> Outcome<IndependentSpeed> {
        match (self.rapid, self.speed) {
            (Some(true), None) => Ok(IndependentSpeed::Rapid),
            (Some(false), Some((speed, _))) => Ok(speed),
            (Some(true), Some((_, at))) => Err(wrong("G00 with a feed or a time", at)),
            (None, _) => Err(wrong("G00 or G01 is missing", span)),
            (Some(false), None) => {
                let text = "FEED, TIME or FEED_MAX_WEIGHT of G01 is missing";
                Err(wrong(text, span))
            }
        }
    }
}
