//! The coupling group of the channel list, which `#ENABLE AX LINK [0]` switches on.

use crate::diag::{Condition, Diagnostic, ValueKind};
use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use crate::machine::table::param::{Param, Whole};

/// Largest number of pairs in a group. Source: TF5200 channel parameters, synchro_data (149192587).
pub(crate) const PAIRS_MAX: u32 = 15;

/// A pair by the logical numbers of its axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DefaultCoupling {
    /// Master axis (P-CHAN-00037).
    pub(crate) master: u32,
    /// Slave axis (P-CHAN-00038).
    pub(crate) slave: u32,
}

/// The pairs of group 0; the reasons for those that are left out go to the diagnostics.
///
/// Source: TF5200 diagnosis, 20438 (251629195), 20440 (251637899), 20441 (251642251), 20442 (251646603).
pub(in crate::machine) fn default_couplings(
    list: &Parameters,
) -> (Vec<DefaultCoupling>, Vec<Diagnostic>) {
    let mut pairs: Vec<DefaultCoupling> = Vec::new();
    let mut wrong = Vec::new();
    for i in 0..PAIRS_MAX {
        let [master_at, slave_at] = [of::COUPLING_MASTER.and(i), of::COUPLING_SLAVE.and(i)];
        let pair = DefaultCoupling { master: list.get(master_at), slave: list.get(slave_at) };
        let DefaultCoupling { master, slave } = pair;
        // Assumption: an entry with the defaults of both is not a pair
        if master == 0 && slave == 0 {
            continue;
        }
        let (condition, at, what) = if master == 0 || slave == 0 {
            let at = if master == 0 { master_at } else { slave_at };
            (Condition::DefaultCouplingNumber, at, "logical axis number 0".to_owned())
        } else if master == slave {
            let what = format!("axis {slave} cannot follow itself");
            (Condition::DefaultCouplingItself, slave_at, what)
        } else if pairs.iter().any(|p| p.slave == slave) {
            let what = format!("axis {slave} already follows another master");
            (Condition::DefaultCouplingSlaveTwice, slave_at, what)
        } else if pairs.iter().any(|p| p.slave == master) {
            let what = format!("the master {master} follows another axis");
            (Condition::DefaultCouplingChain, master_at, what)
        } else if pairs.iter().any(|p| p.master == slave) {
            let what = format!("the slave {slave} is the master of another axis");
            (Condition::DefaultCouplingChain, slave_at, what)
        } else {
            pairs.push(pair);
            continue;
        };
        wrong.push(left_out(list, condition, at, i, &what));
    }
    (pairs, wrong)
}

fn left_out(
    list: &Parameters,
    condition: Condition,
    at: Param<Whole>,
    pair: u32,
    what: &str,
) -> Diagnostic {
    let text = format!("{}: {what}, pair {pair} ignored", at.place());
    let mut diagnostic = Diagnostic::new(condition, text).value(ValueKind::Current, pair, "-");
    let other = [of::COUPLING_MASTER.and(pair), of::COUPLING_SLAVE.and(pair)];
    let setting = list.set_by(at).or_else(|| other.iter().find_map(|at| list.set_by(*at)));
    diagnostic.source = setting.and_then(|setting| setting.at.clone());
    diagnostic
}
