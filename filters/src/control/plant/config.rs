//! The configuration of the simulated axis: its model, dead time and disturbance force.

use super::quantities::Disturbance;
use crate::control::fault::Issue;

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

/// Velocity loop (PI) and current loop (first order) of a drive, per unit of the whole mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedLoop {
    /// Proportional gain in 1/s: acceleration per speed error.
    pub gain_per_s: f64,
    /// Integral time Tn in s; `None`: without an integral part.
    pub integral_time_s: Option<f64>,
    /// Time constant Ti of the current loop in s.
    pub current_time_s: f64,
}

/// Motor and load on a damped spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoMassConfig {
    /// Mass (inertia) of the load over that of the motor.
    pub load_to_motor_ratio: f64,
    /// Free resonance in Hz: motor against load, `sqrt(c (1/J_M + 1/J_L))`.
    pub resonance_hz: f64,
    /// Damping ratio of the free resonance.
    pub damping_ratio: f64,
    /// Loops of the drive, closed by the motor encoder.
    pub speed_loop: SpeedLoop,
}

/// One vibration mode: natural frequency, damping, and participation of each point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Natural frequency in Hz.
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Participation of the motor.
    pub motor: f64,
    /// Participation of the load encoder. Same sign as the motor: a mode of the structure; opposite sign: a mode of the
    /// drive train.
    pub load: f64,
    /// Participation of the tool point.
    pub tool: f64,
    /// Participation of the point at which the disturbance force acts.
    pub disturbance: f64,
}

/// Rigid body of unit mass with vibration modes.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalConfig {
    /// The modes.
    pub modes: Vec<Mode>,
    /// Loops of the drive, closed by the motor encoder.
    pub speed_loop: SpeedLoop,
}

impl ModalConfig {
    /// Rack and pinion axis with a column at 53 Hz and a tool point at 11 Hz, the two dominant vibrations of the
    /// application example of Improved Position Control.
    ///
    /// Assumption: the manual only gives frequencies and amplitudes; the other values are chosen to reproduce both
    /// amplitudes and their reduction.
    pub fn rack_and_pinion() -> Self {
        let column = Mode {
            frequency_hz: 53.0,
            damping_ratio: 0.010,
            motor: 0.20,
            load: 0.20,
            tool: 0.80,
            disturbance: 0.80,
        };
        let tool = Mode {
            frequency_hz: 11.0,
            damping_ratio: 0.020,
            motor: 0.12,
            load: 0.12,
            tool: 2.44,
            disturbance: 0.0,
        };
        Self {
            modes: vec![column, tool],
            speed_loop: SpeedLoop {
                gain_per_s: 200.0,
                integral_time_s: Some(0.030),
                current_time_s: 0.0005,
            },
        }
    }
}
