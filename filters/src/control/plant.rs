//! The simulated axis: drive and mechanics.
//!
//! Every model is linear, and its step is exact for inputs held over the step: one matrix product per cycle, four with
//! a disturbance force. Not modelled: backlash, Coulomb friction, saturation of the current.
//!
//! Input is the speed command in mm/s, an additive torque as the acceleration it gives the axis, and a disturbance
//! force as the acceleration it gives the whole mass.
//!
//! Order of calls: [`PlantConfig::checked`], [`Plant::start`] at the position of the axis, then [`Plant::advance`] once per cycle.
//!
//! ```
//! use kontur_filters::control::plant::{Plant, PlantConfig, PlantInput, PlantModel};
//! use kontur_filters::time::CycleTime;
//!
//! let model = PlantModel::FirstOrder { time_constant_s: 0.01 };
//! let config = PlantConfig { model, ..PlantConfig::default() };
//! let mut plant = Plant::new(&config, CycleTime::DEFAULT).unwrap();
//! plant.start(0.0);
//! for _ in 0..1000 {
//!     plant.advance(PlantInput { speed_mm_s: 100.0, ..PlantInput::default() });
//! }
//! // 1 s at 100 mm/s, less the time constant
//! assert!((plant.measured().motor_mm - 99.0).abs() < 1e-9);
//! ```

mod linear;
mod models;
mod row;

use super::fault::Issue;
use crate::time::CycleTime;
use linear::{Continuous, LinearPlant};
pub use models::{ModalConfig, Mode, SpeedLoop, TwoMassConfig};
pub(crate) use row::{FewStates, InAxis, PlantOfRow};

/// Kind and parameters of the simulated axis.
#[derive(Clone, Debug, PartialEq)]
pub enum PlantModel {
    /// Actual = set position, one cycle later (P-AXIS-00096 `antr.simu.ist_gleich_soll`).
    Follow,
    /// The vendor's simulated drive (drive type 4): velocity loop of second order.
    ///
    /// Assumption: `v = u / (1 + 2D s/w0 + s2/w0^2)`; the manual's formula is a picture. The vendor discretises with
    /// P-AXIS-00239/00238, here with the true cycle.
    Simulated {
        /// Damping ratio D, below 1 (P-AXIS-00051/00050), default 0.6.
        damping_ratio: f64,
        /// Natural angular frequency w0 in 1/s (P-AXIS-00062/00061), default 100.
        natural_rad_s: f64,
    },
    /// Velocity loop of first order, `dv/dt = (u - v)/Ta`.
    FirstOrder {
        /// Time constant Ta in s.
        time_constant_s: f64,
    },
    /// Motor and load, coupled by a damped spring, with velocity and current loop.
    TwoMass(TwoMassConfig),
    /// Rigid body with any number of vibration modes, with velocity and current loop.
    Modal(ModalConfig),
}

impl PlantModel {
    /// The vendor's default drive: D = 0.6, w0 = 100 1/s.
    pub const VENDOR_DEFAULT: Self = Self::Simulated { damping_ratio: 0.6, natural_rad_s: 100.0 };
}

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

/// The simulated axis as configured.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantConfig {
    /// Drive and mechanics.
    pub model: PlantModel,
    /// Dead time of the speed command in cycles, 0..=5 (P-AXIS-00194), default 0.
    pub dead_time_cycles: usize,
    /// Disturbance force, none by default.
    pub disturbance: Option<Disturbance>,
}

impl Default for PlantConfig {
    fn default() -> Self {
        Self { model: PlantModel::VENDOR_DEFAULT, dead_time_cycles: 0, disturbance: None }
    }
}

impl PlantConfig {
    /// Largest dead time in cycles.
    pub const MAX_DEAD_TIME: usize = 5;

    /// The configuration with the documented corrections: 80044 (damping), 110040 (dead time).
    pub fn checked(mut self) -> (Self, Vec<Issue>) {
        let mut issues = Vec::new();
        if let PlantModel::Simulated { damping_ratio, .. } = &mut self.model
            && *damping_ratio >= 1.0
        {
            issues.push(Issue::SimulationDamping { damping_ratio: *damping_ratio });
            *damping_ratio = 0.999;
        }
        if self.dead_time_cycles > Self::MAX_DEAD_TIME {
            let cycles = u32::try_from(self.dead_time_cycles).unwrap_or(u32::MAX);
            issues.push(Issue::DeadTime { cycles });
            self.dead_time_cycles = Self::MAX_DEAD_TIME;
        }
        (self, issues)
    }
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
    fn rigid(position_mm: f64, speed_mm_s: f64) -> Self {
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
    fn replace(self, before: &mut Self) -> bool {
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

/// The simulated axis with its state.
#[derive(Clone, Debug)]
pub struct Plant {
    dynamics: Dynamics,
    dead_time: [f64; PlantConfig::MAX_DEAD_TIME + 1],
    dead_time_cycles: usize,
    measured: Measured,
    rests: bool,
}

/// The model by its number of states, which is small for the drives of most machines.
#[derive(Clone, Debug)]
enum Dynamics {
    Follow { cycle_s: f64 },
    Two(LinearPlant<[f64; 2]>),
    Three(LinearPlant<[f64; 3]>),
    Many(Box<LinearPlant<Vec<f64>>>),
}

impl Dynamics {
    fn new(
        model: &Continuous,
        cycle: CycleTime,
        disturbance: Option<Disturbance>,
    ) -> Result<Self, PlantError> {
        Ok(match model.a.nrows() {
            2 => Self::Two(LinearPlant::new(model, cycle, disturbance)?),
            3 => Self::Three(LinearPlant::new(model, cycle, disturbance)?),
            _ => Self::Many(Box::new(LinearPlant::new(model, cycle, disturbance)?)),
        })
    }
}

impl Plant {
    /// Builds the discrete model once; steps do not compute it again.
    ///
    /// # Errors
    /// [`PlantError`] if a parameter is not physical.
    pub fn new(config: &PlantConfig, cycle: CycleTime) -> Result<Self, PlantError> {
        let dynamics = match models::continuous(&config.model)? {
            None => Dynamics::Follow { cycle_s: cycle.seconds() },
            Some(model) => Dynamics::new(&model, cycle, config.disturbance)?,
        };
        Ok(Self {
            dynamics,
            dead_time: [0.0; PlantConfig::MAX_DEAD_TIME + 1],
            dead_time_cycles: config.dead_time_cycles.min(PlantConfig::MAX_DEAD_TIME),
            measured: Measured::default(),
            rests: false,
        })
    }

    /// Puts the plant at rest at a position; no transient follows.
    pub fn start(&mut self, position_mm: f64) {
        self.dead_time.fill(0.0);
        self.measured = Measured::rigid(position_mm, 0.0);
        self.rests = false;
        match &mut self.dynamics {
            Dynamics::Follow { .. } => {}
            Dynamics::Two(linear) => linear.start(position_mm),
            Dynamics::Three(linear) => linear.start(position_mm),
            Dynamics::Many(linear) => linear.start(position_mm),
        }
    }

    /// Shifts the coordinate of the plant by `by_mm`; nothing moves.
    pub(crate) fn shift(&mut self, by_mm: f64) {
        let m = &mut self.measured;
        for position_mm in [&mut m.motor_mm, &mut m.load_mm, &mut m.tcp_mm] {
            *position_mm += by_mm;
        }
        self.rests = false;
        match &mut self.dynamics {
            Dynamics::Follow { .. } => {}
            Dynamics::Two(linear) => linear.shift(by_mm),
            Dynamics::Three(linear) => linear.shift(by_mm),
            Dynamics::Many(linear) => linear.shift(by_mm),
        }
    }

    /// The measured values at the start of the cycle.
    pub const fn measured(&self) -> &Measured {
        &self.measured
    }

    /// Whether the model separates the load from the motor.
    pub(crate) fn is_elastic(&self) -> bool {
        match &self.dynamics {
            Dynamics::Follow { .. } => false,
            Dynamics::Two(linear) => linear.is_elastic(),
            Dynamics::Three(linear) => linear.is_elastic(),
            Dynamics::Many(linear) => linear.is_elastic(),
        }
    }

    /// Whether the model separates the tool point from the load.
    pub fn has_tool_point(&self) -> bool {
        match &self.dynamics {
            Dynamics::Follow { .. } => false,
            Dynamics::Two(linear) => linear.has_tool_point(),
            Dynamics::Three(linear) => linear.has_tool_point(),
            Dynamics::Many(linear) => linear.has_tool_point(),
        }
    }

    /// Whether the last cycle changed nothing, bit for bit; while the input stays the same, no later one will.
    pub const fn rests(&self) -> bool {
        self.rests
    }

    /// Advances by one cycle. False if the state is no longer finite; the last finite measurement then remains.
    #[inline]
    pub fn advance(&mut self, mut input: PlantInput) -> bool {
        if self.dead_time_cycles > 0 {
            self.dead_time.copy_within(..self.dead_time_cycles, 1);
            self.dead_time[0] = input.speed_mm_s;
            input.speed_mm_s = self.dead_time[self.dead_time_cycles];
        }
        let (rests, measured) = (&mut self.rests, &mut self.measured);
        match &mut self.dynamics {
            Dynamics::Follow { cycle_s } => {
                let step_mm = input.reference_mm - measured.motor_mm;
                *rests = step_mm.to_bits() == 0;
                Measured::rigid(input.reference_mm, step_mm / *cycle_s).replace(measured)
            }
            Dynamics::Two(linear) => linear.advance(&input, rests, measured),
            Dynamics::Three(linear) => linear.advance(&input, rests, measured),
            Dynamics::Many(linear) => linear.advance(&input, rests, measured),
        }
    }
}

#[cfg(test)]
mod tests;
