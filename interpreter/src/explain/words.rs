//! Objects of the control and words of the documents.

use super::explanation::{Explanation, Kind};

pub(super) struct Word {
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
        meaning: "object of the control: set position of an axis after the axis filters",
        facts: &[("group", "0x121300 + channel"), ("offset", "0x1C + 0x10000 x axis index"), ("type", "SGN64"), ("column", "X_set_mm")],
        related: &["Active position"] },
    Word { name: "V_SATZ_ANZ",
        meaning: "constant of the control: number of blocks buffered between interpolator and position controller, which gives feedforward the next set positions",
        facts: &[("here", "5 cycles as soon as an axis of the channel has feedforward without P-AXIS-00566")],
        related: &["P-AXIS-00566", "P-AXIS-00223", "P-AXIS-00086"] },
    Word { name: "S-0-0296",
        meaning: "SERCOS parameter of the drive: weight of the velocity feedforward; SERCOS drives with their own position control have their own feedforward",
        facts: &[("here", "not simulated; P-AXIS-00833 weights the velocity feedforward inside the drive")],
        related: &["S-0-0348", "P-AXIS-00223", "P-AXIS-00833"] },
    Word { name: "S-0-0348",
        meaning: "SERCOS parameter of the drive: weight of the acceleration feedforward; SERCOS drives with their own position control have their own feedforward",
        facts: &[("here", "not simulated")],
        related: &["S-0-0296", "P-AXIS-00223"] },
    Word { name: "S-0-0104",
        meaning: "SERCOS parameter of the drive: gain of its position controller; feedforward in the control requires the same gain in P-AXIS-00099",
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

/// Reasons for the path speed and for waits: values of the trace column `v_limit` and of `run --times`.
#[rustfmt::skip]
const LIMITS: &[Word] = &[
    Word { name: "v_limit",
        meaning: "column of the trace: what limited the path speed in a cycle; while the speed changes, the limit it is changing for",
        facts: &[("values", "feed, axis, corner, curve, ax_dev, lookahead, stop")], related: &["feed", "axis", "corner", "curve", "ax_dev", "lookahead", "stop"] },
    Word { name: "feed",
        meaning: "the programmed feed, with override, is reached (column v_limit, --times)",
        facts: &[("helps", "a higher F, #OVERRIDE, P-CHAN-00181 for rapid")], related: &["P-CHAN-00066"] },
    Word { name: "axis",
        meaning: "an axis is at its velocity limit (column v_limit; axis_v of --times names the axis)",
        facts: &[("helps", "P-AXIS-00212, in rapid P-AXIS-00209; a contour that spreads the travel over the axes")], related: &["P-AXIS-00212", "P-AXIS-00209"] },
    Word { name: "axis_v",
        meaning: "an axis is at its velocity limit (--times)",
        facts: &[("column", "v_limit = axis")], related: &["axis"] },
    Word { name: "axis_a",
        meaning: "the path speed changes with constant acceleration, because an axis is at its acceleration limit (--times)",
        facts: &[("brackets", "the limit the speed is changing for, a value of v_limit"), ("helps", "P-AXIS-00001, 00002, in rapid 00004, with HSC P-AXIS-00008, or G130/G131")], related: &["P-AXIS-00001", "P-AXIS-00002", "P-AXIS-00008"] },
    Word { name: "slope",
        meaning: "the path speed changes while the slope profile builds up or reduces the acceleration (--times)",
        facts: &[("brackets", "the limit the speed is changing for, a value of v_limit"), ("helps", "shorter ramp times P-AXIS-00195 to 00198, in rapid 00200; another #SLOPE")], related: &["#SLOPE", "P-AXIS-00195", "P-AXIS-00196"] },
    Word { name: "corner",
        meaning: "speed at a kink between two blocks, where the axis speeds must jump (column v_limit, --times)",
        facts: &[("helps", "rounding (G261, #CONTOUR MODE, #HSC ON), P-AXIS-00013")], related: &["P-AXIS-00013"] },
    Word { name: "curve",
        meaning: "speed limited by the curvature of the path or its change: centripetal acceleration and geometric jerk of the axes (column v_limit, --times)",
        facts: &[("helps", "P-AXIS-00008, P-AXIS-00199, P-CHAN-00361")], related: &["P-AXIS-00008", "P-AXIS-00199", "P-CHAN-00361"] },
    Word { name: "ax_dev",
        meaning: "speed limited so that the Vibration Guard keeps the tolerance AX_DEV (column v_limit, --times)",
        facts: &[("helps", "a larger AX_DEV, a higher FREQ, a MODE with a shorter kernel")], related: &["#VIB GUARD"] },
    Word { name: "lookahead",
        meaning: "the look-ahead ends here: the path must be able to stop at the end of the known blocks (column v_limit, --times)",
        facts: &[("helps", "P-STUP-00070, P-STUP-00071")], related: &["P-STUP-00070", "P-STUP-00071"] },
    Word { name: "stop",
        meaning: "at rest, or decelerating to or accelerating from a stop (column v_limit); in --times at rest without waiting",
        facts: &[("helps", "use G60 and G04 only where required")], related: &["G60"] },
    Word { name: "dwell",
        meaning: "the path waits for G04 or #TIME (--times)",
        facts: &[], related: &["G04"] },
    Word { name: "technology",
        meaning: "the path waits for M, H, S and T functions for the times declared in the channel list (--times, with --techno-times)",
        facts: &[], related: &["P-CHAN-00040", "P-CHAN-00026", "P-CHAN-00044"] },
    Word { name: "exact_stop",
        meaning: "the path waits at G60, G360 until the actual positions are inside the window (--times)",
        facts: &[("helps", "P-AXIS-00236, P-AXIS-00099, feedforward G135")], related: &["P-AXIS-00236", "G60"] },
    Word { name: "flush",
        meaning: "the path waits until the set positions have arrived: #FLUSH WAIT, reading an external variable, independent axes, a change of filters (--times)",
        facts: &[], related: &["#FLUSH"] },
    Word { name: "spindle",
        meaning: "a thread waits until its spindle stops, or has reached its speed and passes its zero mark (--times)",
        facts: &[], related: &["G33", "G63"] },
    Word { name: "arrival",
        meaning: "the end of the program waits until the actual positions are inside the window (--times, arrival_s of the summary)",
        facts: &[("helps", "P-AXIS-00236, P-AXIS-00099, feedforward G135")], related: &["P-AXIS-00236"] },
    Word { name: "held",
        meaning: "feedhold or override 0 keeps the path at rest (--times, held_s of the summary)",
        facts: &[], related: &[] },
];

/// Every word.
pub(super) fn all() -> impl Iterator<Item = &'static Word> {
    WORDS.iter().chain(LIMITS)
}

/// Names of all words.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    all().map(|w| w.name)
}

/// The word with a name, without regard to case; `S_0_0037` is `S-0-0037`.
pub(super) fn find(thing: &str) -> Option<Explanation> {
    let wanted = thing.replace("S_0_", "S-0-");
    all().find(|w| w.name.eq_ignore_ascii_case(&wanted)).map(explained)
}

/// The explanation of a word.
pub(super) fn explained(word: &Word) -> Explanation {
    Explanation {
        kind: Kind::Word,
        title: word.name.to_owned(),
        meaning: word.meaning.to_owned(),
        facts: word.facts.iter().map(|(name, fact)| (*name, (*fact).to_owned())).collect(),
        notes: Vec::new(),
        example: None,
        related: word.related.iter().map(|s| (*s).to_owned()).collect(),
    }
}
