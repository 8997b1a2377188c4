//! Words that other controls give another meaning: what this dialect means by them.

/// Hint for a G number that is not assigned here.
pub(super) fn unknown_g(number: u32) -> Option<&'static str> {
    Some(match number {
        28 | 30 => "reference points of other controls do not exist here; G74 homes, G53 cancels offsets",
        43 | 44 | 49 => "tool length is selected by D here (D0 cancels)",
        7 | 64 => "contouring is G261 with #CONTOUR MODE here",
        15 | 16 => "polar coordinates of other controls do not exist here",
        50 => "#SCALE scales here",
        65 | 66 | 67 => "subroutines are called by L, LL and L CYCLE here",
        73 | 76 => "drilling cycles are L CYCLE calls here",
        _ => return None,
    })
}

/// Hint for a letter that is no word here.
pub(super) fn letter(letter: u8) -> &'static str {
    match letter {
        b'M' => "M needs a number",
        b'P' => "a parameter is assigned: P1=5",
        _ => "words are G M H T D F E S I J K R L N, the axes, P.. = and V... =",
    }
}

/// M functions of other controls.
pub(super) fn m_function(number: u32) -> Option<&'static str> {
    match number {
        98 => Some("M98 calls no subroutine here: L file or LL NAME does"),
        99 => Some("M99 ends no subroutine here: M17 or M29 does"),
        _ => None,
    }
}
