//! What goes into a plant and what can be measured on it.

/// Disturbance force, sinusoidal or constant, whose amplitude may increase with the speed of the load up to a nominal
/// speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disturbance {
    /// Amplitude as the acceleration of the whole mass in mm/s2.
    pub amplitude_mm_s2: f64,
    /// Frequency in Hz; 0: a constant force.
    pub frequency_hz: f64,
    /// Load speed in mm/s from which the amplitude is reached in full; 0: at any speed.
    pub full_speed_mm_s: f64,
}

/// A plant whose parameters describe no physical system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlantError {
    /// A time constant, frequency, mass ratio or gain that must be positive (and finite) is not.
    #[error("{0} must be positive and finite")]
    NotPositive(&'static str),
    /// A value is not a finite number.
    #[error("{0} must be finite")]
    NotFinite(&'static str),
    /// The exact discretisation has no finite result: the model is far too fast for the cycle.
    #[error("the model cannot be discretised at this cycle time")]
    TooStiff,
}

/// Inputs of the plant in a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlantInput {
    /// Speed command in mm/s, additive velocity included.
    pub speed_mm_s: f64,
    /// Additive torque as acceleration in mm/s2.
    pub acc_mm_s2: f64,
    /// External force as acceleration of the whole mass in mm/s2, in addition to the configured disturbance.
    pub force_mm_s2: f64,
    /// Reference position in mm, for the model without dynamics.
    pub reference_mm: f64,
}

/// What can be measured on the plant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// Motor encoder in mm of axis travel.
    pub motor_mm: f64,
    /// Motor speed in mm/s.
    pub motor_mm_s: f64,
    /// Load (direct) encoder in mm.
    pub load_mm: f64,
    /// Load speed in mm/s.
    pub load_mm_s: f64,
    /// Tool point in mm.
    pub tcp_mm: f64,
    /// Speed of the tool point in mm/s.
    pub tcp_mm_s: f64,
}

impl Measured {
    #[inline]
    pub(crate) fn rigid(position_mm: f64, speed_mm_s: f64) -> Self {
        Self {
            motor_mm: position_mm,
            motor_mm_s: speed_mm_s,
            load_mm: position_mm,
            load_mm_s: speed_mm_s,
            tcp_mm: position_mm,
            tcp_mm_s: speed_mm_s,
        }
    }

    /// Replaces the previous measurement unless a value is not finite; false in that case.
    #[inline] // where it is made, its values are still in registers: as a whole it would be read back before it is written
    pub(super) fn replace(self, before: &mut Self) -> bool {
        let finite = self.is_finite();
        if finite {
            *before = self;
        }
        finite
    }

    /// Whether every value is finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        let Self { motor_mm, motor_mm_s, load_mm, load_mm_s, tcp_mm, tcp_mm_s } = self;
        [motor_mm, motor_mm_s, load_mm, load_mm_s, tcp_mm, tcp_mm_s].iter().all(|v| v.is_finite())
    }
}
