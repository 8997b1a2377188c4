//! Trigonometry in degrees with exact values where they are rational.
//!
//! The argument is reduced modulo 360 degrees exactly, so `COS[90]` is 0 and a division by it is detected (20396).

use std::f64::consts::PI;

/// `x` modulo 360, defined as `x - 360 * floor(x / 360)`; exact for every finite `x`.
fn reduced(deg: f64) -> f64 {
    let r = deg % 360.0;
    if r < 0.0 { r + 360.0 } else { r }
}

/// Sine of an angle in degrees; exact at multiples of 30 degrees where the value is rational.
pub(in crate::exec) fn sin_deg(deg: f64) -> f64 {
    let (sign, x) = match reduced(deg) {
        x if x >= 180.0 => (-1.0, x - 180.0),
        x => (1.0, x),
    };
    // reduced to the first quadrant, so that symmetric angles give the same bits
    let x = if x > 90.0 { 180.0 - x } else { x };
    sign * first_quadrant(x)
}

/// Cosine of an angle in degrees.
pub(in crate::exec) fn cos_deg(deg: f64) -> f64 {
    let x = reduced(deg);
    let x = if x > 180.0 { 360.0 - x } else { x };
    if x <= 90.0 { first_quadrant(90.0 - x) } else { -first_quadrant(x - 90.0) }
}

/// Tangent; `None` at the poles.
pub(in crate::exec) fn tan_deg(deg: f64) -> Option<f64> {
    let (s, c) = (sin_deg(deg), cos_deg(deg));
    if c == 0.0 {
        None
    } else if s.abs().to_bits() == c.abs().to_bits() {
        Some(if (s < 0.0) == (c < 0.0) { 1.0 } else { -1.0 })
    } else {
        Some(s / c)
    }
}

/// Sine of 0 to 90 degrees.
fn first_quadrant(x: f64) -> f64 {
    const EXACT: [(f64, f64); 3] = [(0.0, 0.0), (30.0, 0.5), (90.0, 1.0)];
    if let Some((_, value)) = EXACT.iter().find(|(deg, _)| deg.to_bits() == x.abs().to_bits()) {
        return *value;
    }
    // above 45 degrees the cosine of the complement: sin and cos of complementary angles agree in all bits
    if x > 45.0 { libm::cos((90.0 - x) * (PI / 180.0)) } else { libm::sin(x * (PI / 180.0)) }
}

/// Angle in degrees of a value in radians; exact at 45, 90 and 180 degrees, where the product rounds to them.
pub(in crate::exec) fn to_deg(rad: f64) -> f64 {
    rad * (180.0 / PI)
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "exact values are the point")]
mod tests {
    use super::{PI, cos_deg, sin_deg, tan_deg, to_deg};

    #[test]
    fn quarter_turns_and_half_values_are_exact() {
        for turn in -3..=3 {
            let t = 360.0 * f64::from(turn);
            for (deg, s, c) in
                [(0.0, 0.0, 1.0), (90.0, 1.0, 0.0), (180.0, 0.0, -1.0), (270.0, -1.0, 0.0)]
            {
                assert_eq!((sin_deg(t + deg), cos_deg(t + deg)), (s, c), "{deg}");
            }
            assert_eq!([30.0, 150.0, 210.0, 330.0].map(|d| sin_deg(t + d)), [0.5, 0.5, -0.5, -0.5]);
            assert_eq!([60.0, 120.0, 240.0, 300.0].map(|d| cos_deg(t + d)), [0.5, -0.5, -0.5, 0.5]);
        }
        assert_eq!(cos_deg(1e6 * 360.0 + 90.0), 0.0);
        assert_eq!([45.0, 135.0, -45.0].map(tan_deg), [Some(1.0), Some(-1.0), Some(-1.0)]);
        assert_eq!(tan_deg(90.0), None);
        assert_eq!(tan_deg(-90.0), None);
    }

    #[test]
    fn other_angles_agree_with_radians() {
        for k in -720..720 {
            let deg = f64::from(k) * 1.37;
            let rad = deg.to_radians();
            assert!((sin_deg(deg) - libm::sin(rad)).abs() < 1e-14);
            assert!((cos_deg(deg) - libm::cos(rad)).abs() < 1e-14);
        }
    }

    #[test]
    fn parts_of_a_turn_come_back_exactly() {
        assert_eq!([PI, PI / 2.0, PI / 4.0, -PI / 4.0].map(to_deg), [180.0, 90.0, 45.0, -45.0]);
        assert!(to_deg(-0.0).is_sign_negative());
    }
}
