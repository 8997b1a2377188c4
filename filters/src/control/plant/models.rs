//! The continuous models as state equations.

use super::config::{ModalConfig, PlantModel, SpeedLoop, TwoMassConfig};
use super::linear::{Continuous, INPUTS};
use super::quantities::PlantError;
use nalgebra::{DMatrix, RowDVector};
use std::f64::consts::TAU;

fn positive(value: f64, what: &'static str) -> Result<(), PlantError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(PlantError::NotPositive(what)) }
}

fn finite(value: f64, what: &'static str) -> Result<(), PlantError> {
    if value.is_finite() { Ok(()) } else { Err(PlantError::NotFinite(what)) }
}

impl SpeedLoop {
    fn check(&self) -> Result<(), PlantError> {
        positive(self.gain_per_s, "gain of the velocity loop")?;
        self.integral_time_s
            .map_or(Ok(()), |t| positive(t, "integral time of the velocity loop"))?;
        positive(self.current_time_s, "time constant of the current loop")
    }
}

/// State equations of a model, `None` for the one without dynamics.
pub(super) fn continuous(model: &PlantModel) -> Result<Option<Continuous>, PlantError> {
    match model {
        PlantModel::Follow => Ok(None),
        PlantModel::Simulated { damping_ratio, natural_rad_s } => {
            simulated(*damping_ratio, *natural_rad_s).map(Some)
        }
        PlantModel::FirstOrder { time_constant_s } => first_order(*time_constant_s).map(Some),
        PlantModel::TwoMass(config) => two_mass(config).map(Some),
        PlantModel::Modal(config) => modal(config).map(Some),
    }
}

/// A row with single entries.
fn row(n: usize, entries: &[(usize, f64)]) -> RowDVector<f64> {
    let mut row = RowDVector::zeros(n);
    for &(i, v) in entries {
        row[i] = v;
    }
    row
}

/// State `[x, v]`. Torque and force act as on a unit mass whose velocity loop has the gain `1/Ta`.
fn first_order(ta: f64) -> Result<Continuous, PlantError> {
    positive(ta, "time constant of the drive")?;
    let rate = 1.0 / ta;
    Ok(rigid(
        DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, -rate]),
        DMatrix::from_row_slice(2, INPUTS, &[0.0, 0.0, 0.0, rate, 1.0, 1.0]),
    ))
}

/// State `[x, v, v'/w0]`. Torque and force enter through the equivalent time constant `2D/w0`.
fn simulated(d: f64, w0: f64) -> Result<Continuous, PlantError> {
    positive(d, "damping of the simulated drive")?;
    positive(w0, "natural frequency of the simulated drive")?;
    #[rustfmt::skip]
    let a = DMatrix::from_row_slice(3, 3, &[
        0.0, 1.0, 0.0,
        0.0, 0.0, w0,
        0.0, -w0, -2.0 * d * w0,
    ]);
    #[rustfmt::skip]
    let b = DMatrix::from_row_slice(3, INPUTS, &[
        0.0, 0.0, 0.0,
        0.0, 0.0, 0.0,
        w0, 2.0 * d, 2.0 * d,
    ]);
    Ok(rigid(a, b))
}

fn rigid(a: DMatrix<f64>, b: DMatrix<f64>) -> Continuous {
    let n = a.nrows();
    let position = row(n, &[(0, 1.0)]);
    let speed = row(n, &[(1, 1.0)]);
    Continuous {
        a,
        b,
        positions: [position.clone(), position.clone(), position],
        speeds: [speed.clone(), speed.clone(), speed],
    }
}

/// Rows of the drive: torque `tau` (as acceleration of the whole mass) and integrator `z`, driven by the speed error
/// `u - v_motor`, where `v_motor` is a row over the state.
fn drive_rows(
    a: &mut DMatrix<f64>,
    b: &mut DMatrix<f64>,
    (z, tau): (usize, usize),
    motor_speed: &RowDVector<f64>,
    config: &SpeedLoop,
) {
    let rate = 1.0 / config.current_time_s;
    let kp = config.gain_per_s;
    for (j, share) in motor_speed.iter().enumerate() {
        a[(tau, j)] -= rate * kp * share;
        a[(z, j)] -= share;
    }
    a[(tau, tau)] -= rate;
    b[(tau, 0)] += rate * kp;
    b[(tau, 1)] += rate;
    b[(z, 0)] += 1.0;
    if let Some(tn) = config.integral_time_s {
        a[(tau, z)] += rate * kp / tn;
    } else {
        // an unused integrator would only grow
        a.row_mut(z).fill(0.0);
        b.row_mut(z).fill(0.0);
    }
}

/// State `[x_m, v_m, w d, v_l, z, tau]` with `d = x_m - x_l` and `w` the free resonance, a scaling that keeps the
/// matrix balanced.
fn two_mass(config: &TwoMassConfig) -> Result<Continuous, PlantError> {
    positive(config.load_to_motor_ratio, "mass ratio of load and motor")?;
    positive(config.resonance_hz, "resonance")?;
    finite(config.damping_ratio, "damping of the resonance")?;
    config.speed_loop.check()?;
    let w = TAU * config.resonance_hz;
    // the masses sum to 1; c = w^2 mu, d = 2 D w mu, mu = J_M J_L / (J_M + J_L)
    let load = config.load_to_motor_ratio / (1.0 + config.load_to_motor_ratio);
    let motor = 1.0 - load;
    let damping = 2.0 * config.damping_ratio * w;
    let n = 6;
    let (v_m, d, v_l, z, tau) = (1, 2, 3, 4, 5);
    let mut a = DMatrix::zeros(n, n);
    let mut b = DMatrix::zeros(n, INPUTS);
    a[(0, v_m)] = 1.0;
    a[(d, v_m)] = w;
    a[(d, v_l)] = -w;
    // c/J_M = w^2 J_L since the masses sum to 1, and c/J_L = w^2 J_M
    for (v, share, sign) in [(v_m, load, -1.0), (v_l, motor, 1.0)] {
        a[(v, d)] = sign * w * share;
        a[(v, v_m)] = sign * damping * share;
        a[(v, v_l)] = -sign * damping * share;
    }
    a[(v_m, tau)] = 1.0 / motor;
    b[(v_l, 2)] = 1.0 / load;
    let motor_speed = row(n, &[(v_m, 1.0)]);
    drive_rows(&mut a, &mut b, (z, tau), &motor_speed, &config.speed_loop);
    let load_position = row(n, &[(0, 1.0), (d, -1.0 / w)]);
    let load_speed = row(n, &[(v_l, 1.0)]);
    Ok(Continuous {
        a,
        b,
        positions: [row(n, &[(0, 1.0)]), load_position.clone(), load_position],
        speeds: [motor_speed, load_speed.clone(), load_speed],
    })
}

/// State `[x_r, v_r, z, tau, w1 q1, q1', w2 q2, q2', ..]`.
fn modal(config: &ModalConfig) -> Result<Continuous, PlantError> {
    config.speed_loop.check()?;
    for mode in &config.modes {
        positive(mode.frequency_hz, "frequency of a mode")?;
        finite(mode.damping_ratio, "damping of a mode")?;
        for share in [mode.motor, mode.load, mode.tool, mode.disturbance] {
            finite(share, "participation of a mode")?;
        }
    }
    let n = 4 + 2 * config.modes.len();
    let (x, v, z, tau) = (0, 1, 2, 3);
    let mut a = DMatrix::zeros(n, n);
    let mut b = DMatrix::zeros(n, INPUTS);
    a[(x, v)] = 1.0;
    a[(v, tau)] = 1.0;
    b[(v, 2)] = 1.0;
    let mut positions = [row(n, &[(x, 1.0)]), row(n, &[(x, 1.0)]), row(n, &[(x, 1.0)])];
    let mut speeds = [row(n, &[(v, 1.0)]), row(n, &[(v, 1.0)]), row(n, &[(v, 1.0)])];
    for (i, mode) in config.modes.iter().enumerate() {
        let (q, p) = (4 + 2 * i, 5 + 2 * i);
        let w = TAU * mode.frequency_hz;
        a[(q, p)] = w;
        a[(p, q)] = -w;
        a[(p, p)] = -2.0 * mode.damping_ratio * w;
        a[(p, tau)] = mode.motor;
        b[(p, 2)] = mode.disturbance;
        for (place, share) in [mode.motor, mode.load, mode.tool].into_iter().enumerate() {
            positions[place][q] = share / w;
            speeds[place][p] = share;
        }
    }
    let motor_speed = speeds[0].clone();
    drive_rows(&mut a, &mut b, (z, tau), &motor_speed, &config.speed_loop);
    Ok(Continuous { a, b, positions, speeds })
}
