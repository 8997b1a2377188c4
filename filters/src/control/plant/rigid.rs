//! A rigid plant during a row of cycles under a constant force, driven by the speed command alone.
//!
//! Its step is that of [`LinearPlant`], bit for bit. What is the same in all cycles of a row is computed once: the products with
//! inputs that stay the same, and those with state 0, which is 0 after every step because the position is kept apart.

use super::linear::LinearPlant;
use super::quantities::Measured;

/// See the module.
pub(crate) struct RigidRow<const N: usize> {
    /// First term of the sum of each state: that of state 0.
    first: [f64; N],
    /// Columns of the matrices.
    phi: [[f64; N]; N],
    gamma: [f64; N],
    /// Last term of the sum of each state: that of the other inputs.
    last: [f64; N],
    /// The motor speed as a function of the state, beginning with the term of state 0.
    first_mm_s: f64,
    speed: [f64; N],
    state: [f64; N],
    base_mm: f64,
    /// Measured position in mm and speed in mm/s.
    pub(crate) motor_mm: f64,
    pub(crate) motor_mm_s: f64,
}

impl<const N: usize> RigidRow<N> {
    /// Advances by one cycle under a speed command in mm/s. False, and nothing has changed, if the state would no longer be finite.
    #[expect(clippy::inline_always, reason = "a call would keep the state in memory")]
    #[inline(always)]
    pub(crate) fn advance(&mut self, command_mm_s: f64) -> bool {
        let mut next = self.first;
        for (row, sum) in next.iter_mut().enumerate() {
            for (column, state) in self.phi.iter().zip(&self.state).skip(1) {
                *sum += column[row] * state;
            }
            *sum += self.gamma[row] * command_mm_s;
            *sum += self.last[row];
        }
        let base_mm = self.base_mm + next[0];
        let mut motor_mm_s = self.first_mm_s;
        for (next, share) in next.iter_mut().zip(&self.speed).skip(1) {
            *next = if next.abs() < LinearPlant::<[f64; N]>::NEGLIGIBLE { 0.0 } else { *next };
            motor_mm_s += share * *next;
        }
        // all terms of a position are 0, the first one without a sign
        let motor_mm = base_mm + 0.0;
        let finite = motor_mm.is_finite() && motor_mm_s.is_finite();
        if finite {
            self.state[1..].copy_from_slice(&next[1..]);
            (self.base_mm, self.motor_mm, self.motor_mm_s) = (base_mm, motor_mm, motor_mm_s);
        }
        finite
    }
}

impl<const N: usize> LinearPlant<[f64; N]> {
    /// This plant during a row, if it is rigid and nothing disturbs it.
    pub(super) fn rigid_row(&self, measured: &Measured, force_mm_s2: f64) -> Option<RigidRow<N>> {
        let is_base =
            |(i, share): (usize, &f64)| share.to_bits() == f64::from(u8::from(i == 0)).to_bits();
        let rigid = !self.is_elastic()
            && !self.has_tool_point()
            && self.disturbance.is_none()
            && self.positions[0].iter().enumerate().all(is_base)
            && self.state[0].to_bits() == 0;
        // each sum begins with -0, which keeps the sign of its first product
        let first = |share: f64| -0.0 + share * 0.0;
        let [gamma, acceleration, force] = self.gamma;
        // added in turn to any sum, the first of which is 0 or -0, they give the same as their sum
        let last = |row: usize| acceleration[row] * 0.0 + force[row] * (force_mm_s2 + 0.0);
        rigid.then(|| RigidRow {
            first: self.phi[0].map(first),
            phi: self.phi,
            gamma,
            last: std::array::from_fn(last),
            first_mm_s: first(self.speeds[0][0]),
            speed: self.speeds[0],
            state: self.state,
            base_mm: self.base_mm,
            motor_mm: measured.motor_mm,
            motor_mm_s: measured.motor_mm_s,
        })
    }

    /// Takes the state after a number of cycles of such a row.
    pub(super) fn take(&mut self, row: &RigidRow<N>, cycles: usize) {
        (self.state, self.base_mm) = (row.state, row.base_mm);
        self.cycles += cycles as u64;
    }
}
