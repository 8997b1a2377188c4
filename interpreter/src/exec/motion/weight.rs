//! Weights of limits in the program. Source: TF5200 programming manual, G127 to G134, G230 to G233.

/// The quantity that the G function of a weight changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Weight {
    /// G127, G128.
    Velocity,
    /// G129.
    RapidVelocity,
    /// G130, G131.
    Acceleration,
    /// G132, G133.
    Ramp,
    /// G134.
    GeometricRamp,
    /// G230, G231.
    RapidAcceleration,
    /// G233.
    RapidRamp,
}
