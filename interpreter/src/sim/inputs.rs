//! Real-time inputs of a run: override, feedhold, and external influences on single axes.
//!
//! A value holds until the next one of its signal. It acts on an axis from the first cycle on that is not earlier than
//! its time; the path follows its contour unchanged up to that cycle and changes from there.

use crate::diag::{Condition, Diagnostic, rounded};
use crate::machine::table::{axis_drive, channel};
use crate::machine::{Axis, Machine, RapidOverride};
use kontur_filters::control::axis_control::AxisInputs;
use kontur_filters::control::plant::PlantModel;
use kontur_filters::time::CycleTime;
use kontur_motion::realtime::OverrideRatios;
use std::collections::BTreeSet;
use std::fmt;

/// One input of a run. Axes are numbered as in [`Machine::all_axes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Signal {
    /// `override_percent`: real-time override of feed blocks, 0 to 200 %, default 100; also of rapid blocks unless
    /// P-CHAN-00181 says otherwise. P-CHAN-00066 selects the value that it is a percentage of.
    Override,
    /// `rapid_override_percent`: real-time override of rapid blocks (P-CHAN-00181), 0 to 200 %, default 100.
    RapidOverride,
    /// `feedhold`: 1 holds the path, 0 releases it; default 0. P-CHAN-00097 selects the deceleration.
    ///
    /// Assumption: dwells and waits continue under feedhold; it holds the path, and independent axes (P-AXIS-00540).
    Feedhold,
    /// `probe`: 1 is the signal of the probe in measuring runs (G100, G310); default 0.
    Probe,
    /// `X_probe_mm`: position of an axis in mm (deg) at which the probe signals, if the actual position passes it in a
    /// measuring run.
    Surface(usize),
    /// `wear_mm`: wear of a grinding wheel that the PLC would provide (`#OTC` with DISC or AUTO); default 0.
    Wear,
    /// `X_add_mm`: position of the additional interface of an axis in mm (deg), before its filter.
    Additional(usize),
    /// `X_force_mm_s2`: external force on an axis as acceleration of the whole mass in mm/s2 (deg/s2).
    Force(usize),
    /// `X_encoder_offset_mm`: error of the measuring system of the position loop in mm (deg).
    EncoderOffset(usize),
}

impl Signal {
    /// Every signal of a machine with its name.
    pub fn all(machine: &Machine) -> Vec<(String, Self)> {
        let mut all = vec![
            ("override_percent".to_owned(), Self::Override),
            ("rapid_override_percent".to_owned(), Self::RapidOverride),
            ("feedhold".to_owned(), Self::Feedhold),
            ("probe".to_owned(), Self::Probe),
            ("wear_mm".to_owned(), Self::Wear),
        ];
        for (i, axis) in machine.all_axes().enumerate() {
            let unit = if axis.is_linear() { "mm" } else { "deg" };
            let name = axis.name();
            all.push((format!("{name}_add_{unit}"), Self::Additional(i)));
            all.push((format!("{name}_force_{unit}_s2"), Self::Force(i)));
            all.push((format!("{name}_encoder_offset_{unit}"), Self::EncoderOffset(i)));
            if i < machine.axes.len() {
                all.push((format!("{name}_probe_{unit}"), Self::Surface(i)));
            }
        }
        all
    }

    /// Smallest and largest value.
    pub const fn range(self) -> (f64, f64) {
        match self {
            Self::Override | Self::RapidOverride => (0.0, 200.0),
            Self::Feedhold | Self::Probe => (0.0, 1.0),
            Self::Additional(_) | Self::EncoderOffset(_) | Self::Surface(_) | Self::Wear => {
                (-1e6, 1e6)
            }
            Self::Force(_) => (-1e9, 1e9),
        }
    }

    /// The reason why the signal has no effect on this machine.
    fn without_effect(self, machine: &Machine) -> Option<Diagnostic> {
        let warning = |text: String| Diagnostic::new(Condition::InputNoEffect, text);
        match self {
            Self::RapidOverride if machine.channel.overrides.rapid == RapidOverride::NotUsed => {
                let text =
                    "rapid override without effect: one override applies to both feed and rapid";
                let hint = "set channel.g00_override_mode to ACTIVE or MINIMUM_OF_G0_G1";
                Some(warning(text.to_owned()).parameter(channel::RAPID_OVERRIDE).hint(hint))
            }
            Self::Additional(i) => {
                let of = |axis: &Axis| {
                    let name = axis.name();
                    let text = format!(
                        "the additional interface of axis {name} is off: its input has no effect"
                    );
                    let hint = format!("set {name}.lr_param.add_interface.enable=1");
                    warning(text).axis(axis.number(), name).hint(hint)
                };
                let on = |a: &&Axis| !a.has_additional_interface();
                machine.all_axes().nth(i).filter(on).map(of)
            }
            Self::Force(i) => {
                let chain = machine.chains().0.into_iter().nth(i)?;
                let axis = machine.all_axes().nth(i)?;
                (chain.control.plant.model == PlantModel::Follow).then(|| {
                    let name = axis.name();
                    let text =
                        format!("axis {name} follows its set position: a force has no effect");
                    warning(text).axis(axis.number(), name).parameter(axis_drive::SIMU_FOLLOWS)
                })
            }
            _ => None,
        }
    }
}

/// A new value of a signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    time_s: f64,
    signal: Signal,
    value: f64,
}

impl Change {
    /// A value that holds from a program time in s on.
    ///
    /// # Errors
    /// A description of the error; feedhold and probe are 0 or 1.
    pub fn new(time_s: f64, signal: Signal, value: f64) -> Result<Self, String> {
        let (low, high) = signal.range();
        let switch = matches!(signal, Signal::Feedhold | Signal::Probe);
        let whole = !switch || value.fract().abs() <= 0.0;
        if whole && (low..=high).contains(&value) {
            Ok(Self { time_s, signal, value })
        } else if switch {
            Err(format!("{value}, expected 0 or 1"))
        } else {
            Err(format!("{value}, allowed: {low} to {high}"))
        }
    }

    /// Program time in s from which the value holds.
    pub const fn time_s(&self) -> f64 {
        self.time_s
    }

    /// The signal.
    pub const fn signal(&self) -> Signal {
        self.signal
    }
}

/// External influences on the speed of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SpeedChange {
    Feedhold,
    /// Ratio of the override.
    Override(f64),
}

/// Changes in the order of time; an error ends the run.
pub type Changes = Box<dyn Iterator<Item = Result<Change, Box<Diagnostic>>> + Send>;

/// The values in force and those to come.
pub(super) struct Inputs {
    changes: Changes,
    next: Option<Change>,
    feed_ratio: f64,
    rapid_ratio: f64,
    pub(super) feedhold: bool,
    /// Whether the probe signals.
    pub(super) probe: bool,
    /// External wear of a grinding wheel.
    pub(super) wear_mm: f64,
    /// Conditions that are reported once.
    told: BTreeSet<Condition>,
    /// Position at which the probe signals, for each path axis.
    pub(super) surfaces_mm: Vec<Option<f64>>,
    pub(super) axes: Vec<AxisInputs>,
    seen: BTreeSet<Signal>,
}

impl fmt::Debug for Inputs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Inputs").field("next", &self.next).finish_non_exhaustive()
    }
}

impl Inputs {
    /// No inputs, for this number of axes.
    pub(super) fn none(axes: usize) -> Self {
        Self {
            changes: Box::new(std::iter::empty()),
            next: None,
            feed_ratio: 1.0,
            rapid_ratio: 1.0,
            feedhold: false,
            probe: false,
            wear_mm: 0.0,
            told: BTreeSet::new(),
            surfaces_mm: Vec::new(),
            axes: vec![AxisInputs::default(); axes],
            seen: BTreeSet::new(),
        }
    }

    /// Takes the source of the changes.
    pub(super) fn connect(&mut self, changes: Changes) -> Result<(), Box<Diagnostic>> {
        self.changes = changes;
        self.fetch()
    }

    fn fetch(&mut self) -> Result<(), Box<Diagnostic>> {
        self.next = None;
        self.next = self.changes.next().transpose()?;
        Ok(())
    }

    /// Whether no value will ever change any more.
    pub(super) const fn is_over(&self) -> bool {
        self.next.is_none()
    }

    /// Whether the next change is due at a time.
    pub(super) fn is_due(&self, time_s: f64, cycle: CycleTime) -> bool {
        // a margin of a billionth of a cycle: times are decimal numbers, cycles binary ones
        let late = time_s + 1e-9 * cycle.seconds();
        self.next.is_some_and(|c| c.time_s <= late)
    }

    /// Applies the changes due at a time; true if there were any.
    ///
    /// # Errors
    /// The error of the source of the changes; the values stay.
    pub(super) fn take_due(
        &mut self,
        time_s: f64,
        machine: &Machine,
        notes: &mut Vec<Diagnostic>,
    ) -> Result<bool, Box<Diagnostic>> {
        let mut any = false;
        let limited = |ratio: f64| ratio.min(machine.channel.overrides.most.unwrap_or(ratio));
        while self.is_due(time_s, machine.cycle)
            && let Some(Change { signal, value, .. }) = self.next
        {
            any = true;
            if self.seen.insert(signal) {
                notes.extend(signal.without_effect(machine));
            }
            if matches!(signal, Signal::Override | Signal::RapidOverride) {
                notes.extend(self.largest_override_report(value / 100.0, machine));
            }
            match signal {
                Signal::Override => self.feed_ratio = limited(value / 100.0),
                Signal::RapidOverride => self.rapid_ratio = limited(value / 100.0),
                Signal::Feedhold => self.feedhold = value > 0.0,
                Signal::Probe => self.probe = value > 0.0,
                Signal::Wear => self.wear_mm = value,
                Signal::Surface(i) => {
                    let axes = self.surfaces_mm.len().max(i + 1);
                    self.surfaces_mm.resize(axes, None);
                    self.surfaces_mm[i] = Some(value);
                }
                Signal::Additional(i) => self.axis(i).additional_mm = value,
                Signal::Force(i) => self.axis(i).force_mm_s2 = value,
                Signal::EncoderOffset(i) => self.axis(i).encoder_offset_mm = value,
            }
            self.fetch()?;
        }
        Ok(any)
    }

    /// Whether the limit of the external wear has not been reported yet; true once.
    pub(super) fn reports_wear_limit(&mut self) -> bool {
        self.told.insert(Condition::WearLimited)
    }

    /// The message, once, that an override is limited (P-CHAN-00056), or would be on a control without an entry in its
    /// list.
    fn largest_override_report(&mut self, ratio: f64, machine: &Machine) -> Option<Diagnostic> {
        let listed = machine.channel.overrides.most;
        if ratio <= listed.unwrap_or(1.0) || !self.told.insert(Condition::OverrideLimited) {
            return None;
        }
        let [asked, most] = [ratio, listed.unwrap_or(1.0)].map(|r| rounded(100.0 * r));
        let text = match listed {
            Some(_) => format!("override of {asked} % limited to {most} %"),
            None => {
                format!(
                    "override of {asked} %: without max_vb_override the control allows {most} %"
                )
            }
        };
        Some(Diagnostic::new(Condition::OverrideLimited, text))
    }

    fn axis(&mut self, i: usize) -> &mut AxisInputs {
        if i >= self.axes.len() {
            self.axes.resize(i + 1, AxisInputs::default());
        }
        &mut self.axes[i]
    }

    /// Whether the inputs keep a thread from beginning; `full_override`: the override does not act on it.
    pub(super) fn bar(&self, full_override: bool) -> bool {
        self.feedhold || (self.feed_ratio <= 0.0 && !full_override)
    }

    /// The input because of which the path does not have the speed that a thread needs.
    pub(super) fn changes_speed(&self, full_override: bool) -> Option<SpeedChange> {
        if self.feedhold {
            return Some(SpeedChange::Feedhold);
        }
        let changed = self.feed_ratio.to_bits() != 1.0_f64.to_bits();
        (changed && !full_override).then_some(SpeedChange::Override(self.feed_ratio))
    }

    /// Overrides of feed and rapid blocks (P-CHAN-00181).
    pub(super) fn ratios(&self, mode: RapidOverride) -> OverrideRatios {
        let (feed, own) = (self.feed_ratio, self.rapid_ratio);
        let rapid = match mode {
            RapidOverride::NotUsed => feed,
            RapidOverride::Minimum => feed.min(own),
            RapidOverride::Active => own,
        };
        OverrideRatios { feed, rapid }
    }
}
