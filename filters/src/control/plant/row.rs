//! The plant during a row of cycles: in its axis, or apart from it.
//!
//! Apart from its axis, a plant of few states has a fixed size and is read and written by nobody else: the compiler keeps its state
//! in registers from cycle to cycle.

use super::linear::LinearPlant;
use super::quantities::{Measured, PlantInput};
use super::rigid::RigidRow;
use super::{Dynamics, Plant};

/// Where the plant is while its axis runs through a row of cycles. `own` is the plant in the axis.
pub(crate) trait PlantOfRow {
    /// As [`Plant::measured`].
    fn measured<'a>(&'a self, own: &'a Plant) -> &'a Measured;

    /// As [`Plant::rests`].
    fn rests(&self, own: &Plant) -> bool;

    /// As [`Plant::advance`].
    fn advance(&mut self, own: &mut Plant, input: PlantInput) -> bool;
}

/// In its axis.
pub(crate) struct InAxis;

impl PlantOfRow for InAxis {
    #[inline]
    fn measured<'a>(&'a self, own: &'a Plant) -> &'a Measured {
        own.measured()
    }

    #[inline]
    fn rests(&self, own: &Plant) -> bool {
        own.rests()
    }

    #[inline]
    fn advance(&mut self, own: &mut Plant, input: PlantInput) -> bool {
        own.advance(input)
    }
}

/// A plant of `N` states without dead time, apart from its axis.
pub(crate) struct Apart<const N: usize> {
    linear: LinearPlant<[f64; N]>,
    measured: Measured,
    rests: bool,
}

impl<const N: usize> PlantOfRow for Apart<N> {
    #[inline]
    fn measured<'a>(&'a self, _: &'a Plant) -> &'a Measured {
        &self.measured
    }

    #[inline]
    fn rests(&self, _: &Plant) -> bool {
        self.rests
    }

    #[inline]
    fn advance(&mut self, _: &mut Plant, input: PlantInput) -> bool {
        self.linear.advance(&input, &mut self.rests, &mut self.measured)
    }
}

impl<const N: usize> Apart<N> {
    /// The same plant in motion under this acceleration by a force in mm/s2, if all its measured points move as one.
    pub(crate) fn rigid_row(&self, force_mm_s2: f64) -> Option<RigidRow<N>> {
        self.linear.rigid_row(&self.measured, force_mm_s2)
    }

    /// Takes the state of that plant after a number of cycles.
    pub(crate) fn take(&mut self, row: &RigidRow<N>, cycles: usize) {
        self.linear.take(row, cycles);
        self.measured = Measured::rigid(row.motor_mm, row.motor_mm_s);
        self.rests = false;
    }
}

/// A plant apart from its axis, by its number of states.
pub(crate) enum FewStates {
    Two(Apart<2>),
    Three(Apart<3>),
}

impl Plant {
    /// A copy apart from the axis, if the plant has few states and no dead time.
    #[inline]
    pub(crate) fn few_states(&self) -> Option<FewStates> {
        let Self { dynamics, dead_time_cycles: 0, measured, rests, .. } = self else { return None };
        let (measured, rests) = (*measured, *rests);
        match dynamics {
            Dynamics::Two(linear) => {
                Some(FewStates::Two(Apart { linear: linear.clone(), measured, rests }))
            }
            Dynamics::Three(linear) => {
                Some(FewStates::Three(Apart { linear: linear.clone(), measured, rests }))
            }
            Dynamics::Follow { .. } | Dynamics::Many(_) => None,
        }
    }

    /// Takes the state of such a copy.
    #[inline]
    pub(crate) fn put_back(&mut self, apart: FewStates) {
        let dynamics;
        (dynamics, self.measured, self.rests) = match apart {
            FewStates::Two(Apart { linear, measured, rests }) => {
                (Dynamics::Two(linear), measured, rests)
            }
            FewStates::Three(Apart { linear, measured, rests }) => {
                (Dynamics::Three(linear), measured, rests)
            }
        };
        self.dynamics = dynamics;
    }
}
