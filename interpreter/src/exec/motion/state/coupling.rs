//! The groups of coupled axes.

use crate::machine::DefaultCoupling;
use crate::machine::Machine;
use kontur_motion::axis::AxisDynamics;
use std::collections::BTreeMap;

/// A slave and its master.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Pair {
    pub(in crate::exec) slave: usize,
    pub(in crate::exec) master: usize,
    /// 1, or -1 for a slave that mirrors its master.
    pub(in crate::exec) ratio: f64,
    /// Gantry coupling, with monitoring of the actual positions.
    pub(in crate::exec) is_gantry: bool,
}

/// An active pair.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec::motion) struct Follower {
    pub(in crate::exec::motion) pair: Pair,
    /// Positions of both when the group was activated.
    pub(in crate::exec::motion) master_mm: f64,
    pub(in crate::exec::motion) slave_mm: f64,
    /// Displacement of the slave at that time.
    pub(in crate::exec::motion) way_mm: f64,
}

/// The groups of a program.
#[derive(Debug, Default)]
pub(in crate::exec) struct Couplings {
    pub(in crate::exec::motion) groups: BTreeMap<u32, Vec<Pair>>,
    /// In order of activation.
    pub(in crate::exec::motion) active: Vec<(u32, Vec<Follower>)>,
    /// The group that was activated last, also after its deactivation; 0 before the first one (`V.G.AX_LINK.NR`).
    ///
    /// Assumption: the page says "current or last active group", and does not define the value before the first or with
    /// several.
    pub(in crate::exec) last: u32,
}

impl Couplings {
    /// At program start: group 0 is that of the channel list, unless an axis of it is not in the channel.
    pub(in crate::exec::motion) fn of_lists(machine: &Machine) -> Self {
        let axis = |number: u32| machine.axes.iter().position(|axis| axis.number() == number);
        let pair = |listed: &DefaultCoupling| {
            let (slave, master) = (axis(listed.slave)?, axis(listed.master)?);
            Some(Pair { slave, master, ratio: 1.0, is_gantry: false })
        };
        let listed = &machine.channel.default_couplings;
        let pairs: Option<Vec<Pair>> = listed.iter().map(pair).collect();
        let group = pairs.filter(|pairs| !pairs.is_empty()).map(|pairs| (0, pairs));
        Self { groups: group.into_iter().collect(), active: Vec::new(), last: 0 }
    }

    /// Whether no group is active.
    pub(in crate::exec) fn are_off(&self) -> bool {
        self.active.is_empty()
    }

    pub(in crate::exec::motion) fn is_on(&self, group: u32) -> bool {
        self.active.iter().any(|(active, _)| *active == group)
    }

    pub(in crate::exec::motion) fn followers(&self) -> impl Iterator<Item = (u32, &Follower)> {
        self.active.iter().flat_map(|(group, all)| all.iter().map(|f| (*group, f)))
    }

    /// The slaves of active groups, each with its master.
    pub(in crate::exec) fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        self.followers().map(|(_, follower)| (follower.pair.slave, follower.pair.master))
    }

    pub(in crate::exec::motion) fn slaves(&self) -> impl Iterator<Item = usize> {
        self.followers().map(|(_, follower)| follower.pair.slave)
    }

    /// Whether an axis follows a master.
    pub(in crate::exec) fn is_slave(&self, axis: usize) -> bool {
        self.slaves().any(|slave| slave == axis)
    }

    /// The group in which an axis is slave or master.
    pub(in crate::exec) fn group_of(&self, axis: usize) -> Option<u32> {
        let mut of_axis =
            self.followers().filter(|(_, f)| f.pair.slave == axis || f.pair.master == axis);
        of_axis.next().map(|(group, _)| group)
    }

    /// Limits of the masters including those of their slaves.
    pub(in crate::exec::motion) fn limit(&self, axes: &mut [AxisDynamics]) {
        for (_, Follower { pair, .. }) in self.followers() {
            axes[pair.master] = axes[pair.master].with(&axes[pair.slave]);
        }
    }

    /// Position of the slave of a pair when its master has reached `master_mm`.
    pub(in crate::exec::motion) fn slave_at(follower: &Follower, master_mm: f64) -> f64 {
        follower.slave_mm + follower.pair.ratio * (master_mm - follower.master_mm)
    }

    /// The slaves of a master with the range that they cover while it moves from `low` to `high`.
    pub(in crate::exec::motion) fn slaves_of(
        &self,
        master: usize,
        (low, high): (f64, f64),
    ) -> impl Iterator<Item = (usize, f64, f64)> {
        self.followers().filter(move |(_, f)| f.pair.master == master).map(move |(_, f)| {
            let (a, b) = (Self::slave_at(f, low), Self::slave_at(f, high));
            (f.pair.slave, a.min(b), a.max(b))
        })
    }
}
