//! The numeric quantities of an axis, each by its name, and sets of them.

use super::AxisRecord;

/// Makes [`Quantity`] from the fields of [`AxisRecord`].
macro_rules! quantities {
    ($($name:ident is $field:ident,)*) => {
        /// A quantity of an axis in a cycle: a field of [`AxisRecord`], where its meaning and unit are documented.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Quantity {
            $(
                #[doc = concat!("[`AxisRecord::", stringify!($field), "`].")]
                $name,
            )*
        }

        impl Quantity {
            /// Every quantity.
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            /// Its value in a record.
            #[inline]
            pub const fn of(self, record: &AxisRecord) -> f64 {
                match self {
                    $(Self::$name => record.$field,)*
                }
            }

            /// Its element in a record.
            #[inline]
            pub(crate) const fn of_mut(self, record: &mut AxisRecord) -> &mut f64 {
                match self {
                    $(Self::$name => &mut record.$field,)*
                }
            }
        }
    };
}

quantities! {
    Ipo is ipo,
    Set is set,
    Vel is vel,
    Acc is acc,
    Jerk is jerk,
    Err is err,
    Dev is dev,
    DevBothWays is dev_both_ways,
    Ff is ff,
    Cmd is cmd,
    Vadd is vadd,
    VaddLimited is vadd_limited,
    Reference is reference,
    Act is act,
    Load is load,
    Lag is lag,
    LagLimit is lag_limit,
    Add is add,
    Settling is settling_s,
    Tcp is tcp,
    TcpAcc is tcp_acc,
    Target is target,
    CmdDrive is cmd_drive,
    VffDrive is vff_drive,
    VaddDrive is vadd_drive,
    TorqueDrive is torque_drive,
    TorqueNm is torque_n_m,
}

impl Quantity {
    /// Number of quantities.
    pub(crate) const COUNT: usize = Self::ALL.len();

    const fn bit(self) -> u32 {
        1 << self as u32
    }
}

/// A set of quantities, such as those that somebody reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Asked(u32);

impl Asked {
    /// None of them.
    pub const NONE: Self = Self(0);
    /// All of them.
    pub const ALL: Self = Self((1 << Quantity::COUNT) - 1);

    /// These.
    pub fn of(quantities: &[Quantity]) -> Self {
        Self(quantities.iter().fold(0, |bits, quantity| bits | quantity.bit()))
    }

    /// Those of both sets.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether the quantity is in the set.
    #[inline]
    pub const fn has(self, quantity: Quantity) -> bool {
        self.0 & quantity.bit() != 0
    }

    /// Whether both sets have a quantity in common.
    pub(crate) const fn has_any(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// Each of them.
    pub(crate) fn each(self) -> impl Iterator<Item = Quantity> {
        let mut left = self.0;
        // bit by bit, as there are mostly few of them
        std::iter::from_fn(move || {
            let quantity = Quantity::ALL.get(left.trailing_zeros() as usize).copied()?;
            left &= left - 1;
            Some(quantity)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each quantity is a different element of the record.
    #[test]
    fn every_quantity_has_its_place() {
        let mut record = AxisRecord::default();
        for (quantity, x) in Quantity::ALL.iter().zip(1..) {
            *quantity.of_mut(&mut record) = f64::from(x);
        }
        let values = Quantity::ALL.iter().map(|quantity| quantity.of(&record));
        assert!(values.eq((1..).take(Quantity::COUNT).map(f64::from)));
        // a record has nothing else
        assert_eq!(size_of::<AxisRecord>(), Quantity::COUNT * size_of::<f64>());
    }

    #[test]
    fn sets_hold_what_they_are_made_of() {
        let some = Asked::of(&[Quantity::Ipo, Quantity::TorqueNm]);
        assert!(some.each().eq([Quantity::Ipo, Quantity::TorqueNm]));
        assert!(some.and(Asked::of(&[Quantity::Set])).each().count() == 3);
        assert!(Asked::ALL.each().eq(Quantity::ALL.iter().copied()));
        assert!(!Asked::NONE.has_any(Asked::ALL) && some.has_any(Asked::ALL));
    }
}
