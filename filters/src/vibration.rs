//! A damped vibration of one mode.

/// Damped over undamped natural frequency, `sqrt(1 - z^2)`, of a damping ratio `z` from -1 to 1.
///
/// Factored, because `1 - z^2` loses half of its digits near 1.
pub(crate) fn damped_ratio(damping: f64) -> f64 {
    ((1.0 - damping) * (1.0 + damping)).sqrt()
}
