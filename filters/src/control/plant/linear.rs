//! Exact discretisation of a linear plant and its step.

use super::quantities::{Disturbance, Measured, PlantError, PlantInput};
use crate::time::CycleTime;
use nalgebra::{DMatrix, RowDVector};

/// Number of inputs: speed command, additive acceleration, force.
pub(super) const INPUTS: usize = 3;

/// Continuous model `s' = A s + B u`. State 0 is the position of the rigid body; nothing depends on it.
#[derive(Clone, Debug)]
pub(super) struct Continuous {
    pub(super) a: DMatrix<f64>,
    pub(super) b: DMatrix<f64>,
    /// Motor, load and tool point: positions, then speeds, as functions of the state.
    pub(super) positions: [RowDVector<f64>; 3],
    pub(super) speeds: [RowDVector<f64>; 3],
}

impl Continuous {
    /// Whether two measured points can move relative to each other.
    fn differ(&self, a: usize, b: usize) -> bool {
        self.positions[a] != self.positions[b] || self.speeds[a] != self.speeds[b]
    }
}

/// A vector of states: a fixed array for the small models of the usual drives, otherwise on the heap.
pub(super) trait States: AsRef<[f64]> + AsMut<[f64]> + Clone {
    /// One such vector per state: a square matrix.
    type Square: AsRef<[Self]> + std::fmt::Debug + Clone;

    /// The vector with these values.
    fn of(values: &[f64]) -> Self;

    /// One vector for each of `n` states.
    fn square(vector: impl Fn(usize) -> Self, n: usize) -> Self::Square;
}

impl<const N: usize> States for [f64; N] {
    type Square = [Self; N];

    fn of(values: &[f64]) -> Self {
        std::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
    }

    fn square(vector: impl Fn(usize) -> Self, _: usize) -> Self::Square {
        std::array::from_fn(vector)
    }
}

impl States for Vec<f64> {
    type Square = Vec<Self>;

    fn of(values: &[f64]) -> Self {
        values.to_vec()
    }

    fn square(vector: impl Fn(usize) -> Self, n: usize) -> Self::Square {
        (0..n).map(vector).collect()
    }
}

/// Discrete model with its state. The position is kept apart and only moved by increments: an axis at rest stays where
/// it is bit for bit, and the resolution does not depend on the distance from zero.
#[derive(Clone, Debug)]
pub(super) struct LinearPlant<S: States> {
    /// Columns of the matrices.
    pub(super) phi: S::Square,
    pub(super) gamma: [S; INPUTS],
    pub(super) positions: [S; 3],
    pub(super) speeds: [S; 3],
    pub(super) state: S,
    next: S,
    pub(super) base_mm: f64,
    pub(super) disturbance: Option<Disturbance>,
    substep_s: f64,
    substeps: u32,
    pub(super) cycles: u64,
    cycle: CycleTime,
    /// Whether the load can move relative to the motor, and the tool point relative to the load.
    elastic: bool,
    has_tool_point: bool,
}

impl<S: States> LinearPlant<S> {
    /// Substeps per cycle while a force acts inside the cycle.
    const SUBSTEPS: u32 = 4;
    /// States below this magnitude are set to zero, to keep decaying vibrations out of the denormal range.
    pub(super) const NEGLIGIBLE: f64 = 1e-200;

    pub(super) fn new(
        model: &Continuous,
        cycle: CycleTime,
        disturbance: Option<Disturbance>,
    ) -> Result<Self, PlantError> {
        let substeps = if disturbance.is_some() { Self::SUBSTEPS } else { 1 };
        let substep_s = cycle.seconds() / f64::from(substeps);
        let (phi, gamma) = discretise(&model.a, &model.b, substep_s)?;
        let n = model.a.nrows();
        let column = |matrix: &DMatrix<f64>, i: usize| S::of(&matrix.as_slice()[i * n..][..n]);
        let row = |row: &RowDVector<f64>| S::of(row.as_slice());
        Ok(Self {
            phi: S::square(|i| column(&phi, i), n),
            gamma: std::array::from_fn(|i| column(&gamma, i)),
            positions: std::array::from_fn(|i| row(&model.positions[i])),
            speeds: std::array::from_fn(|i| row(&model.speeds[i])),
            state: S::of(&vec![0.0; n]),
            next: S::of(&vec![0.0; n]),
            base_mm: 0.0,
            disturbance,
            substep_s,
            substeps,
            cycles: 0,
            cycle,
            elastic: model.differ(0, 1),
            has_tool_point: model.differ(1, 2),
        })
    }

    pub(super) fn start(&mut self, position_mm: f64) {
        self.state.as_mut().fill(0.0);
        self.base_mm = position_mm;
        self.cycles = 0;
    }

    pub(super) fn shift(&mut self, by_mm: f64) {
        self.base_mm += by_mm;
    }

    pub(super) const fn is_elastic(&self) -> bool {
        self.elastic
    }

    pub(super) const fn has_tool_point(&self) -> bool {
        self.has_tool_point
    }

    /// Advances by one cycle. `rests` is set to whether that changed nothing, bit for bit: with the same input no
    /// further cycle will. A disturbance that changes with time never rests. False if the state is no longer finite;
    /// the last finite measurement then remains.
    #[expect(
        clippy::inline_always,
        reason = "in a row of cycles a call would keep the state in memory"
    )]
    #[inline(always)]
    pub(super) fn advance(
        &mut self,
        input: &PlantInput,
        rests: &mut bool,
        measured: &mut Measured,
    ) -> bool {
        if let Some(d) = self.disturbance {
            let start_s = self.cycle.time_of(self.cycles);
            for i in 0..self.substeps {
                let middle_s = start_s + self.substep_s * (f64::from(i) + 0.5);
                self.substep(input, input.force_mm_s2 + self.disturbance_at(&d, middle_s));
            }
            *rests = false;
        } else {
            // adding 0 turns -0 into 0
            *rests = self.substep(input, input.force_mm_s2 + 0.0);
        }
        self.cycles += 1;
        self.measure(measured)
    }

    fn disturbance_at(&self, d: &Disturbance, time_s: f64) -> f64 {
        let speed = self.value(&self.speeds[1]);
        let share =
            if d.full_speed_mm_s > 0.0 { (speed.abs() / d.full_speed_mm_s).min(1.0) } else { 1.0 };
        let wave = if d.frequency_hz > 0.0 {
            libm::sin(2.0 * std::f64::consts::PI * d.frequency_hz * time_s)
        } else {
            1.0
        };
        d.amplitude_mm_s2 * share * wave
    }

    /// Whether nothing changed.
    #[inline]
    fn substep(&mut self, input: &PlantInput, force_mm_s2: f64) -> bool {
        let inputs: [f64; INPUTS] = [input.speed_mm_s, input.acc_mm_s2, force_mm_s2];
        // plain loops: matrices this small are faster without the dispatch of the library. Each sum begins with -0,
        // which keeps the sign of its first product
        let (state, next) = (self.state.as_mut(), self.next.as_mut());
        let n = next.len();
        let phi = &self.phi.as_ref()[..n];
        for (row, next) in next.iter_mut().enumerate() {
            let mut sum = -0.0;
            for i in 0..n {
                sum += phi[i].as_ref()[row] * state[i];
            }
            for (column, input) in self.gamma.iter().zip(inputs) {
                sum += column.as_ref()[row] * input;
            }
            *next = sum;
        }
        let before_mm = self.base_mm;
        self.base_mm += next[0];
        next[0] = 0.0;
        let mut rests = self.base_mm.to_bits() == before_mm.to_bits();
        for row in 0..n {
            let settled = if next[row].abs() < Self::NEGLIGIBLE { 0.0 } else { next[row] };
            rests &= settled.to_bits() == state[row].to_bits();
            state[row] = settled;
        }
        rests
    }

    /// A linear function of the state; does not allocate.
    #[inline]
    fn value(&self, row: &S) -> f64 {
        let (row, state) = (row.as_ref(), self.state.as_ref());
        let mut sum = -0.0;
        for i in 0..row.len() {
            sum += row[i] * state[i];
        }
        sum
    }

    /// Updates the measurement unless a value is not finite; false in that case.
    #[inline]
    fn measure(&self, measured: &mut Measured) -> bool {
        let (motor_mm, motor_mm_s) = self.point(0);
        if !self.elastic && !self.has_tool_point {
            return Measured::rigid(motor_mm, motor_mm_s).replace(measured);
        }
        let (load_mm, load_mm_s) =
            if self.elastic { self.point(1) } else { (motor_mm, motor_mm_s) };
        let (tcp_mm, tcp_mm_s) =
            if self.has_tool_point { self.point(2) } else { (load_mm, load_mm_s) };
        Measured { motor_mm, motor_mm_s, load_mm, load_mm_s, tcp_mm, tcp_mm_s }.replace(measured)
    }

    /// Position and speed of a measured point.
    #[inline]
    fn point(&self, i: usize) -> (f64, f64) {
        (self.base_mm + self.value(&self.positions[i]), self.value(&self.speeds[i]))
    }
}

/// Discrete `phi`, `gamma` for inputs held over `h` seconds.
///
/// `exp([[A, B], [0, 0]] h) = [[phi, gamma], [0, 1]]`.
pub(super) fn discretise(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    h: f64,
) -> Result<(DMatrix<f64>, DMatrix<f64>), PlantError> {
    let (n, m) = (a.nrows(), b.ncols());
    let mut block = DMatrix::zeros(n + m, n + m);
    block.view_mut((0, 0), (n, n)).copy_from(&(a * h));
    block.view_mut((0, n), (n, m)).copy_from(&(b * h));
    let e = exponential(&block).ok_or(PlantError::TooStiff)?;
    Ok((e.view((0, 0), (n, n)).into_owned(), e.view((0, n), (n, m)).into_owned()))
}

/// Matrix exponential by scaling and squaring with the diagonal Padé approximant of degree 8.
///
/// With a norm of at most 1 its truncation error is below 1e-18. Arithmetic only, no platform function: traces must be
/// identical everywhere. `None` if the result is not finite.
fn exponential(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    const DEGREE: u32 = 8;
    const MAX_SQUARINGS: u32 = 64;
    let norm =
        matrix.column_iter().map(|c| c.iter().map(|v| v.abs()).sum::<f64>()).fold(0.0, f64::max);
    if !norm.is_finite() {
        return None;
    }
    let mut squarings = 0;
    let mut scale = 1.0;
    while norm * scale > 1.0 && squarings < MAX_SQUARINGS {
        scale *= 0.5;
        squarings += 1;
    }
    let x = matrix * scale;
    let n = x.nrows();
    let mut power = DMatrix::identity(n, n);
    let (mut even, mut odd) = (DMatrix::identity(n, n), DMatrix::zeros(n, n));
    let mut c = 1.0;
    for k in 1..=DEGREE {
        c *= f64::from(DEGREE + 1 - k) / f64::from((2 * DEGREE + 1 - k) * k);
        power = product(&power, &x);
        let sum = if k % 2 == 0 { &mut even } else { &mut odd };
        *sum += &power * c;
    }
    let mut e = (&even - &odd).lu().solve(&(even + odd))?;
    for _ in 0..squarings {
        e = product(&e, &e);
    }
    e.iter().all(|v| v.is_finite()).then_some(e)
}

/// Matrix product in plain order. That of the library dispatches to kernels that differ between processors in the last
/// bit.
fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(a.nrows(), b.ncols(), |i, j| {
        a.row(i).iter().zip(b.column(j).iter()).map(|(x, y)| x * y).sum()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, relative: f64) -> bool {
        (a - b).abs() <= relative * b.abs().max(1e-300)
    }

    #[test]
    fn first_order_drive_matches_its_closed_form() {
        for (ta, h) in [(0.005, 0.001), (0.012, 0.004), (0.0005, 0.02), (0.3, 0.0001)] {
            let a = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, -1.0 / ta]);
            let b = DMatrix::from_row_slice(2, 1, &[0.0, 1.0 / ta]);
            let (phi, gamma) = discretise(&a, &b, h).unwrap();
            let e = libm::exp(-h / ta);
            assert_eq!((phi[(0, 0)], phi[(1, 0)]), (1.0, 0.0), "nothing depends on the position");
            // where e itself is tiny, compare with 1e-12 of the unit state
            assert!((phi[(1, 1)] - e).abs() <= 1e-12 * e.max(1e-4), "{ta} {h}");
            assert!(close(phi[(0, 1)], ta * -libm::expm1(-h / ta), 1e-12), "{ta} {h}");
            assert!(close(gamma[(1, 0)], -libm::expm1(-h / ta), 1e-12), "{ta} {h}");
            let series = h + ta * libm::expm1(-h / ta);
            assert!(close(gamma[(0, 0)], series, 1e-10), "{ta} {h}: {} {series}", gamma[(0, 0)]);
        }
    }

    /// Fixed arrays and heap vectors give the same states bit for bit, and rest in the same cycle.
    #[test]
    fn the_number_of_states_is_all_that_an_array_knows() {
        let two = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, -200.0]);
        let three = [0.0, 1.0, 0.0, 0.0, 0.0, 100.0, 0.0, -100.0, -120.0];
        agree::<2>(two);
        agree::<3>(DMatrix::from_row_slice(3, 3, &three));
    }

    fn agree<const N: usize>(a: DMatrix<f64>) {
        let b = DMatrix::from_fn(N, INPUTS, |i, j| if i == N - 1 { 70.0 + j as f64 } else { 0.0 });
        let row = |values: [f64; 3]| RowDVector::from_row_slice(&values[..N]);
        let position = row([1.0, 1e-3, 2e-4]);
        let (positions, speed) =
            ([position.clone(), position, row([1.0, 0.0, 0.3])], [0.0, 1.0, 0.1]);
        let model = Continuous { a, b, positions, speeds: [row(speed), row(speed), row([0.0; 3])] };
        let new = |disturbance| {
            let cycle = CycleTime::DEFAULT;
            let array = LinearPlant::<[f64; N]>::new(&model, cycle, disturbance).unwrap();
            (array, LinearPlant::<Vec<f64>>::new(&model, cycle, disturbance).unwrap())
        };
        let force = Disturbance { amplitude_mm_s2: 3.0, frequency_hz: 7.0, full_speed_mm_s: 10.0 };
        for disturbance in [None, Some(force)] {
            let (mut array, mut list) = new(disturbance);
            let (mut rests, mut measured) = ([false; 2], [Measured::default(); 2]);
            for k in 0..60_000_u32 {
                let speed_mm_s = if k < 100 { f64::from(k % 13) } else { 0.0 };
                let input =
                    PlantInput { speed_mm_s, acc_mm_s2: 0.5 * speed_mm_s, ..Default::default() };
                assert!(array.advance(&input, &mut rests[0], &mut measured[0]));
                assert!(list.advance(&input, &mut rests[1], &mut measured[1]));
                assert_eq!(format!("{:?}", measured[0]), format!("{:?}", measured[1]));
                assert_eq!(rests[0], rests[1], "{k}");
            }
            assert_eq!(rests[0], disturbance.is_none());
        }
    }

    #[test]
    fn oscillation_matches_sine_and_cosine() {
        let w = 333.0;
        let a = DMatrix::from_row_slice(2, 2, &[0.0, w, -w, 0.0]);
        let (phi, _) = discretise(&a, &DMatrix::zeros(2, 1), 0.001).unwrap();
        assert!(close(phi[(0, 0)], libm::cos(w * 0.001), 1e-14));
        assert!(close(phi[(0, 1)], libm::sin(w * 0.001), 1e-14));
    }

    #[test]
    fn huge_or_undefined_models_are_refused() {
        let b = DMatrix::zeros(1, 1);
        for a in [f64::NAN, f64::INFINITY, 1e9] {
            assert!(discretise(&DMatrix::from_element(1, 1, a), &b, 1.0).is_err(), "{a}");
        }
    }
}
