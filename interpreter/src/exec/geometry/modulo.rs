//! Absolute positions of modulo axes: the number of turns that belongs to a programmed angle.
//!
//! Positions stay continuous, and the axis never turns by more than one revolution. Without a sign it takes the shortest way.
//! The first sign after the name of the axis is the direction of rotation and not part of the position: `C-200` turns in
//! negative direction to 200 degrees, and `C[-200]` takes the shortest way to 160. With G91 a sign is an ordinary sign.
//!
//! With P-CHAN-00346 every word takes the shortest way, and its sign belongs to the position.
//!
//! Source: TF5200 programming manual, programming modulo axes (208540555), positioning on the shortest way (208549515).
//! Assumptions: of two ways of 180 degrees each the positive one is taken. A sign is the direction under G00, too: the page on
//! modulo axes states that the first sign always is; that on G00 (206075403) states that a rotary axis moves by half a turn at
//! most, which is true for words without a sign. Its text is older than the signs.

use crate::diag::Condition;
use crate::exec::fault::Fault;
use crate::syntax::ast::{Sign, Span};

/// Below this distance the axis counts as at its target and does not turn.
const SAME_DEG: f64 = 1e-7;

/// The position in deg for the word `value` (first sign included), from the current position of an axis that counts modulo
/// `range_deg` (P-AXIS-00126, P-AXIS-00127).
pub(in crate::exec) fn unwrapped(value: f64, turn: Option<Sign>, from: f64, range_deg: f64) -> f64 {
    let angle = if turn == Some(Sign::Minus) { -value } else { value };
    let turns = (from - angle) / range_deg;
    // a half rounds down here: the target is above `from`, in positive direction
    let nearest = angle + (turns + 0.5).floor() * range_deg;
    if (nearest - from).abs() < SAME_DEG {
        return nearest;
    }
    match turn {
        None => nearest,
        Some(Sign::Plus) => angle + turns.ceil() * range_deg,
        Some(Sign::Minus) => angle + turns.floor() * range_deg,
    }
}

/// A sum after the sign of a modulo axis is ambiguous.
pub(in crate::exec) fn two_readings(span: Span) -> Box<Fault> {
    let text = "the first sign after a modulo axis is its direction, not the sign of a term";
    let hint =
        "use brackets: C-[P1+5] turns in the negative direction, C[-P1+5] takes the shortest way";
    Fault::new(Condition::Syntax, text, span).hint(hint)
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "exact values are the point")]
mod tests {
    use super::{Sign, unwrapped};

    /// The examples of the manual, from 0 degrees, and after several turns.
    #[test]
    fn direction_and_shortest_way() {
        for (value, turn, from, to) in [
            (200.0, Some(Sign::Plus), 0.0, 200.0),
            (-200.0, Some(Sign::Minus), 0.0, -160.0),
            (-200.0, Some(Sign::Plus), 0.0, 160.0),
            (200.0, Some(Sign::Minus), 0.0, -200.0),
            (200.0, None, 0.0, -160.0),
            (-200.0, None, 0.0, 160.0),
            (450.0, Some(Sign::Plus), 0.0, 90.0),
            (10.0, None, 350.0, 370.0),
            (0.0, None, 3600.0, 3600.0),
            (350.0, Some(Sign::Plus), 710.0, 710.0),
            (-350.0, Some(Sign::Minus), 710.0, 710.0),
            (180.0, None, 0.0, 180.0),
            (-10.0, Some(Sign::Minus), 365.0, 10.0),
        ] {
            assert_eq!(unwrapped(value, turn, from, 360.0), to, "{value} {turn:?} from {from}");
        }
        // a range of two revolutions
        assert_eq!(unwrapped(350.0, None, 0.0, 720.0), 350.0);
        assert_eq!(unwrapped(370.0, None, 0.0, 720.0), -350.0);
        // rounding must not cause a revolution: at an angle already reached the axis stays where it is
        for (angle, turn) in [(350.0 + 1e-9, Sign::Plus), (-350.0 - 1e-9, Sign::Minus)] {
            for beside in [-2e-9, 2e-9] {
                assert!((unwrapped(angle, Some(turn), 710.0 + beside, 360.0) - 710.0).abs() < 1e-8);
            }
        }
    }
}
