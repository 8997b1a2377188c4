//! The shaping chain of an axis as configured by its lists.

use super::curve::Curve;
use crate::args::ResponseArgs;
use crate::console::Console;
use crate::error::Error;
use crate::lists::Lists;
use crate::request::Request;
use crate::run;
use crate::target::keep_apart;
use kontur_filters::iir::AxisFilter;
use kontur_filters::shaping::Shaping;
use kontur_filters::time::CycleTime;
use kontur_interpreter::diag::Severity;
use kontur_interpreter::machine::{Axis, Machine};
use std::sync::Arc;

/// One curve per given axis, and the cycle of the machine.
///
/// The kernel is the one that is on from program start (`filter_fir.enable`, `vib_guard.active`); an HSC filter needs
/// its command and is only mentioned.
pub(super) fn curves(
    args: &ResponseArgs,
    console: &mut Console,
) -> Result<(Vec<Curve>, CycleTime), Error> {
    let request = Request {
        machine: args.machine.clone(),
        settings: args.set.clone(),
        cycle_us: args.cycle_us,
        ..Request::default()
    };
    let lists = Lists::default();
    let loaded = request.machine(&lists);
    let (machine, mut messages) = loaded.map_err(|e| run::announce_lists(e, console))?;
    keep_apart(&lists.read_so_far(), &args.output)?;
    let (chains, found) = machine.chains();
    messages.extend(found);
    for message in &messages {
        console.announce(message);
    }
    let mut curves = Vec::new();
    for name in &args.axis {
        let mut all = machine.all_axes().zip(&chains);
        let Some((axis, chain)) = all.find(|(axis, _)| axis.name().eq_ignore_ascii_case(name))
        else {
            let known: Vec<&str> = machine.all_axes().map(Axis::name).collect();
            let known = known.join(", ");
            return Err(Error::Usage(format!("--axis: no axis `{name}`; the axes are {known}")));
        };
        curves.push(curve(&machine, axis, &chain.filters, console));
    }
    Ok((curves, machine.cycle))
}

/// The curve of the filters and the kernel of an axis.
fn curve(machine: &Machine, axis: &Axis, filters: &[AxisFilter], console: &mut Console) -> Curve {
    let preset = machine.shaped_as(axis).kernel_preset(machine.cycle);
    let fir = preset.fir.filter(|fir| fir.enable);
    // as in a run: an active FIR filter excludes the guard
    let guard = Some(preset.vib_guard).filter(|guard| guard.active && fir.is_none());
    let guard = guard.map(|g| g.settings);
    // settings without a kernel have been reported with their ID
    let kernel = match (guard, fir) {
        (Some(settings), _) => settings.kernel(machine.cycle).ok(),
        (None, Some(fir)) => fir.config.design(machine.cycle).0,
        (None, None) => None,
    };
    let guard = guard.filter(|_| kernel.is_some());
    let name = axis.name();
    let mut parts = Vec::new();
    if let Some(settings) = guard {
        parts.push(format!("guard mode {} {} Hz", settings.mode, settings.freq_hz));
    } else if kernel.is_some() {
        parts.push("FIR filter".to_owned());
    }
    if !filters.is_empty() {
        let count = filters.len();
        parts.push(format!("{count} standard filter{}", if count > 1 { "s" } else { "" }));
    }
    if parts.is_empty() {
        let text = format!("axis {name}: no filter is switched on in its lists");
        console.say(Severity::Note, &text);
        parts.push("no filter".to_owned());
    }
    if preset.hsc.is_some() {
        let text =
            "its HSC filter is only switched on by #FILTER ON [HSC] and not shown; use --hsc-mean";
        console.say(Severity::Note, &format!("axis {name}: {text}"));
    }
    let mut shaping = Shaping::new(filters.to_vec(), 0.0);
    // a chain that has never moved accepts any kernel
    let taken = shaping.set_kernel(kernel.map(Arc::new));
    debug_assert!(taken.is_ok());
    Curve {
        label: format!("{name}: {}", parts.join(", ")),
        shaping,
        guard,
        has_filters: !filters.is_empty(),
        order: None,
    }
}
