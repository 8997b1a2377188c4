//! Active axis couplings: slaves that follow their masters.
//!
//! A slave is not part of the path, like an independent axis. Its travel is kept as a displacement ([`Independent::way`]) by
//! which the coordinates of the path are shifted, and the simulation makes it follow the setpoints of its master. It therefore
//! also follows arcs, compensated contours and masters that move independently for a while.
//!
//! Assumptions (the pages are silent): the path stops where a group is switched on or off, because otherwise the slave would
//! jump to the speed of its master; the path respects the limits of the slave in addition to those of the master.
//!
//! Source: TF5200 programming manual, axis couplings (207120267, 207126155, 207133579, 207139467); 20169, 20457, 20467 to 20470,
//! 20472, 20545, 21283 to 21285, 21312, 21481.
//!
//! [`Independent::way`]: super::state::Independent::way

use super::state::MotionState;
use super::state::coupling::{Couplings, Follower, Pair};
use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::Compensation;
use crate::exec::block::modal::Modal;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::names::AxisNames;
use crate::exec::report::Subject;
use crate::exec::step::{Event, Sync};
use crate::machine::Machine;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;

impl Couplings {
    /// `#SET AX LINK`: defines a group, which must not be active.
    pub(in crate::exec) fn define(
        &mut self,
        group: u32,
        pairs: Vec<Pair>,
        span: Span,
    ) -> Outcome<()> {
        if self.is_on(group) {
            let text = format!("coupling group {group} is switched on and cannot be changed");
            return Err(Fault::new(Condition::CouplingGroupActive, text, span)
                .with(|d| d.value(ValueKind::Wrong, group, "-")));
        }
        self.groups.insert(group, pairs);
        Ok(())
    }

    /// A program must not move a slave.
    pub(in crate::exec::motion) fn moves_no_slave(
        &self,
        axis: usize,
        names: &AxisNames,
        at: Span,
    ) -> Outcome<()> {
        let mut followers = self.followers();
        let Some((group, f)) = followers.find(|(_, f)| f.pair.slave == axis) else { return Ok(()) };
        let (name, master) = (names.name(axis), names.name(f.pair.master));
        let text = format!("axis {name} follows {master} in coupling group {group}");
        let (number, name) = (names.number(axis), name.to_owned());
        Err(Fault::new(Condition::SlaveProgrammed, text, at).with(|d| d.axis(number, name)))
    }

    /// 21481 for a coupled axis that is commanded to move independently.
    pub(in crate::exec) fn moves_not_coupled(
        &self,
        axis: usize,
        machine: &Machine,
        span: Span,
    ) -> Outcome<()> {
        let Some(group) = self.group_of(axis) else { return Ok(()) };
        let name = machine.axes[axis].name().to_owned();
        let text = format!("axis {name} is coupled in group {group} and cannot move independently");
        let number = machine.axes[axis].number();
        Err(Fault::new(Condition::CoupledAxisAlone, text, span)
            .with(|d| d.axis(number, name).value(ValueKind::Current, group, "-")))
    }

    /// 20545 for a coupled axis that is to be released, 21312 for one that is to change its position in the channel; only the
    /// first error.
    pub(in crate::exec) fn moves_no_coupled(
        &self,
        mut axes: impl Iterator<Item = usize>,
        machine: &Machine,
        condition: Condition,
        span: Span,
    ) -> Outcome<()> {
        let coupled = axes.find_map(|axis| Some((axis, self.group_of(axis)?)));
        let Some((axis, group)) = coupled else { return Ok(()) };
        let name = machine.axes[axis].name().to_owned();
        let text = format!("axis {name} is coupled in group {group} and cannot be exchanged");
        let number = machine.axes[axis].number();
        Err(Fault::new(condition, text, span).with(|d| d.axis(number, name)))
    }

    /// 20169.
    pub(in crate::exec) fn keep_tool(&self, span: Span) -> Outcome<()> {
        if self.are_off() {
            return Ok(());
        }
        let text = "the tool data cannot change while axes are coupled";
        Err(Fault::new(Condition::ToolWhileCoupled, text, span))
    }
}

impl Modal {
    /// 20457, 120333.
    fn couplings_may_change(&self, span: Span) -> Outcome<()> {
        if self.contouring {
            let text = "axis couplings cannot be switched while contouring is active";
            return Err(Fault::new(Condition::CouplingWithContouring, text, span));
        }
        if self.compensation == Compensation::Off {
            return Ok(());
        }
        let text = "couplings cannot be switched while tool radius compensation is active";
        Err(Fault::new(Condition::CouplingWithCompensation, text, span))
    }
}

impl MotionState {
    /// Moves the slaves along with their masters.
    pub(in crate::exec) fn follow_masters(&mut self, coordinates: &mut Coordinates) {
        if self.couplings.are_off() {
            return;
        }
        let mut target: AxisVec = coordinates.target().clone();
        for (_, follower) in self.couplings.followers() {
            let slave = follower.pair.slave;
            target[slave] = Couplings::slave_at(follower, target[follower.pair.master]);
            let way_mm = follower.way_mm + (target[slave] - follower.slave_mm);
            self.independent.way[slave] = way_mm;
        }
        coordinates.set_target(&target);
    }

    /// A pair to be activated.
    fn pair_fits(
        &self,
        group: u32,
        pair: &Pair,
        coordinates: &Coordinates,
        machine: &Machine,
        span: Span,
    ) -> Outcome<()> {
        let axes = &machine.axes;
        let (slave, master) = (&axes[pair.slave], &axes[pair.master]);
        let of = |condition, axis: usize, text: String, value: Option<u32>| {
            let (number, name) = (axes[axis].number(), axes[axis].name().to_owned());
            Err(Fault::new(condition, text, span).with(|d| {
                let d = d.axis(number, name);
                match value {
                    Some(value) => d.value(ValueKind::Current, value, "-"),
                    None => d,
                }
            }))
        };
        if self.manual[pair.slave] {
            let text =
                format!("axis {} is in manual mode (G201): it cannot be a slave", slave.name());
            return of(Condition::SlaveInManualMode, pair.slave, text, None);
        }
        if coordinates.main_index(pair.slave).is_some() {
            let text = format!("axis {} is a main axis and cannot be a slave", slave.name());
            return of(Condition::SlaveIsMainAxis, pair.slave, text, None);
        }
        if slave.kind() != master.kind() {
            let text = format!("{} and {} are of different types", slave.name(), master.name());
            return of(Condition::CoupledTypes, pair.slave, text, Some(group));
        }
        if slave.is_modulo() != master.is_modulo() {
            let text = format!("{} and {} have different modes", slave.name(), master.name());
            return of(Condition::CoupledModes, pair.slave, text, Some(group));
        }
        for (active, follower) in self.couplings.followers() {
            let (condition, axis, what) = if follower.pair.slave == pair.slave {
                (Condition::SlaveIsActiveSlave, pair.slave, "is a slave")
            } else if follower.pair.master == pair.slave {
                (Condition::SlaveIsActiveMaster, pair.slave, "is a master")
            } else if follower.pair.slave == pair.master {
                (Condition::MasterIsActiveSlave, pair.master, "is a slave")
            } else {
                continue;
            };
            let text = format!("axis {} {what} in coupling group {active}", axes[axis].name());
            return of(condition, axis, text, Some(active));
        }
        Ok(())
    }
}

impl Decoder {
    /// `#ENABLE AX LINK`.
    pub(in crate::exec) fn switch_couplings_on(&mut self, group: u32, span: Span) -> Outcome<()> {
        self.modal.couplings_may_change(span)?;
        let Some(pairs) = self.motion.couplings.groups.get(&group).cloned() else {
            let text = format!("coupling group {group} is not defined");
            return Err(Fault::new(Condition::CouplingGroupUndefined, text, span));
        };
        if self.motion.couplings.is_on(group) {
            return Ok(());
        }
        for pair in &pairs {
            self.motion.pair_fits(group, pair, &self.geometry.coordinates, &self.machine, span)?;
        }
        self.sync(Sync::FlushWait);
        let target = self.geometry.coordinates.target();
        let way = &self.motion.independent.way;
        let follower = |pair: &Pair| Follower {
            pair: *pair,
            master_mm: target[pair.master],
            slave_mm: target[pair.slave],
            way_mm: way[pair.slave],
        };
        let followers: Vec<Follower> = pairs.iter().map(follower).collect();
        for Follower { pair, master_mm, .. } in &followers {
            let Pair { slave, master, ratio, .. } = *pair;
            self.contour.event(Event::Couple { slave, master, ratio, master_mm: *master_mm });
        }
        if pairs.iter().any(|pair| pair.is_gantry) {
            let text = "the actual positions of gantry couplings are not monitored";
            self.report.note_once(Subject::Gantry, Fault::new(Condition::Ignored, text, span));
        }
        self.motion.couplings.active.push((group, followers));
        self.motion.couplings.last = group;
        self.motion.limits.changed();
        self.note_followers(span);
        Ok(())
    }

    /// `#DISABLE AX LINK`: one group, or the one that was activated last.
    pub(in crate::exec) fn switch_couplings_off(
        &mut self,
        group: Option<u32>,
        span: Span,
    ) -> Outcome<()> {
        self.modal.couplings_may_change(span)?;
        let active = &self.motion.couplings.active;
        let place = match group {
            Some(group) => active.iter().position(|(active, _)| *active == group),
            None => active.len().checked_sub(1),
        };
        if let Some(place) = place {
            self.sync(Sync::FlushWait);
            let (_, followers) = self.motion.couplings.active.remove(place);
            for follower in followers {
                self.contour.event(Event::Uncouple { slave: follower.pair.slave });
            }
            self.motion.limits.changed();
        }
        Ok(())
    }

    /// `#AX LINK OFF ALL`.
    pub(in crate::exec) fn switch_all_couplings_off(&mut self, span: Span) -> Outcome<()> {
        self.modal.couplings_may_change(span)?;
        while !self.motion.couplings.are_off() {
            self.switch_couplings_off(None, span)?;
        }
        Ok(())
    }
}
