//! Motion made of phases of constant jerk, evaluated in closed form.

/// Phases of constant jerk.
#[derive(Clone, Debug, Default)]
pub(crate) struct Profile {
    /// Start time, position, velocity, acceleration, jerk of every phase; the last one never ends.
    phases: Vec<[f64; 5]>,
}

impl Profile {
    /// At rest at 0 from `t = 0`.
    pub(crate) fn rest() -> Self {
        Self { phases: vec![[0.0; 5]] }
    }

    /// Appends a phase: `duration_s` with `jerk_mm_s3`.
    pub(crate) fn then(mut self, duration_s: f64, jerk_mm_s3: f64) -> Self {
        let last = self.phases.last_mut().unwrap();
        last[4] = jerk_mm_s3;
        let [t, x, v, a, j] = *last;
        let d = duration_s;
        self.phases.push([
            t + d,
            x + d * (v + d * (a / 2.0 + d * j / 6.0)),
            v + d * (a + d * j / 2.0),
            a + d * j,
            0.0,
        ]);
        self
    }

    /// Changes the speed by `dv` with acceleration `a` and ramps of `ramp_s`, with zero acceleration at both ends.
    pub(crate) fn ramp(self, dv_mm_s: f64, a_mm_s2: f64, ramp_s: f64) -> Self {
        let jerk = a_mm_s2.copysign(dv_mm_s) / ramp_s;
        let hold = dv_mm_s.abs() / a_mm_s2 - ramp_s;
        self.then(ramp_s, jerk).then(hold, 0.0).then(ramp_s, -jerk)
    }

    /// End of the last phase in s.
    pub(crate) fn end_s(&self) -> f64 {
        self.phases.last().unwrap()[0]
    }

    /// Position in mm.
    pub(crate) fn at(&self, t: f64) -> f64 {
        let phase = self.phases.iter().rev().find(|p| p[0] <= t + 1e-12).unwrap();
        let [t0, x, v, a, j] = *phase;
        // after the last phase the axis is at rest or continues at constant speed, exactly
        let (a, v) =
            if t0 == self.end_s() { (0.0, if v.abs() < 1e-9 { 0.0 } else { v }) } else { (a, v) };
        let d = t - t0;
        x + d * (v + d * (a / 2.0 + d * j / 6.0))
    }
}
