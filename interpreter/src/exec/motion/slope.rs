//! Names and numbers of the slope types.

use kontur_motion::block::SlopeKind;

/// Types in the order of P-CHAN-00071.
const TYPES: [(&str, SlopeKind); 4] = [
    ("STEP", SlopeKind::Step),
    ("TRAPEZ", SlopeKind::Trapez),
    ("SIN2", SlopeKind::Sin2),
    ("HSC", SlopeKind::Hsc),
];

/// Slope type for a word.
pub(in crate::exec) fn slope_type(name: &str) -> Option<SlopeKind> {
    TYPES.iter().find(|(n, _)| n.eq_ignore_ascii_case(name)).map(|(_, kind)| *kind)
}

/// Slope type for a number, as in P-CHAN-00071.
pub(in crate::exec) fn slope_of_number(number: u32) -> Option<SlopeKind> {
    TYPES.get(number as usize).map(|(_, kind)| *kind)
}
