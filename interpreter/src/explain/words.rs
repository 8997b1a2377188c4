//! Objects of the control and words of the documents.

use super::{Explanation, Kind};

struct Word {
    name: &'static str,
    meaning: &'static str,
    facts: &'static [(&'static str, &'static str)],
    related: &'static [&'static str],
}

/// Source: TF5200 axis filters (objects), TF5200 feedforward control.
#[rustfmt::skip]
const WORDS: &[Word] = &[
    Word { name: "Active position",
        meaning: "object of the control: set position of an axis before the axis filters, in 0.1 um or 0.0001 deg",
        facts: &[("group", "0x121300 + channel"), ("offset", "0x61 + 0x10000 x axis index"), ("type", "SGN32"), ("column", "X_ipo_mm")],
        related: &["Ft_sollwert_gestern"] },
    Word { name: "Ft_sollwert_gestern",
        meaning: "object of the control: set position of an axis behind the axis filters",
        facts: &[("group", "0x121300 + channel"), ("offset", "0x1C + 0x10000 x axis index"), ("type", "SGN64"), ("column", "X_set_mm")],
        related: &["Active position"] },
    Word { name: "V_SATZ_ANZ",
        meaning: "constant of the control: number of blocks buffered between interpolator and position controller, so that feedforward knows the next set positions",
        facts: &[("here", "5 cycles as soon as an axis of the channel has feedforward and not P-AXIS-00566")],
        related: &["P-AXIS-00566", "P-AXIS-00223", "P-AXIS-00086"] },
    Word { name: "S-0-0296",
        meaning: "SERCOS parameter of the drive: weight of the velocity feedforward; SERCOS drives with their own position control feed forward themselves",
        facts: &[("here", "not simulated; P-AXIS-00833 weights the velocity feedforward inside the drive")],
        related: &["S-0-0348", "P-AXIS-00223", "P-AXIS-00833"] },
    Word { name: "S-0-0348",
        meaning: "SERCOS parameter of the drive: weight of the acceleration feedforward; SERCOS drives with their own position control feed forward themselves",
        facts: &[("here", "not simulated")],
        related: &["S-0-0296", "P-AXIS-00223"] },
    Word { name: "S-0-0104",
        meaning: "SERCOS parameter of the drive: gain of its position controller; feedforward from the control needs the same gain in P-AXIS-00099",
        facts: &[], related: &["P-AXIS-00099"] },
    Word { name: "S-0-0037",
        meaning: "SERCOS parameter of the drive: additive velocity command, named as S_0_0037 in antr.sercos.mdt[i].nc_ref",
        facts: &[("missing", "70350, velocity feedforward with ADD_VEL is off")],
        related: &["70350", "antr.sercos.mdt[i].nc_ref", "P-AXIS-00223"] },
    Word { name: "S-0-0080",
        meaning: "SERCOS parameter of the drive: additive torque command, named as S_0_0080 in antr.sercos.mdt[i].nc_ref",
        facts: &[("missing", "70351, feedforward with ADD_ACC is off")],
        related: &["70351", "antr.sercos.mdt[i].nc_ref", "P-AXIS-00223"] },
];

/// Names of all words.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    WORDS.iter().map(|w| w.name)
}

/// The word with a name, without regard to case; `S_0_0037` is `S-0-0037`.
pub(super) fn find(thing: &str) -> Option<Explanation> {
    let wanted = thing.replace("S_0_", "S-0-");
    let word = WORDS.iter().find(|w| w.name.eq_ignore_ascii_case(&wanted))?;
    Some(Explanation {
        kind: Kind::Word,
        title: word.name.to_owned(),
        meaning: word.meaning.to_owned(),
        facts: word.facts.iter().map(|(name, fact)| (*name, (*fact).to_owned())).collect(),
        notes: Vec::new(),
        example: None,
        related: word.related.iter().map(|s| (*s).to_owned()).collect(),
    })
}
