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

mod config;
mod linear;
mod models;
mod quantities;
mod rigid;
mod row;

use crate::time::CycleTime;
pub use config::{ModalConfig, Mode, PlantConfig, PlantModel, SpeedLoop, TwoMassConfig};
use linear::{Continuous, LinearPlant};
pub use quantities::{Disturbance, Measured, PlantError, PlantInput};
pub(crate) use row::{Apart, FewStates, InAxis, PlantOfRow};

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
