//! Oscillating axes: `X[OSC ON 1ST_POS=-10 2ND_POS=10 FEED=1000]`, `X[OSC OFF]`.
//!
//! An axis oscillates independently of the path. For the program it is at its second position, where every oscillation ends:
//! with OSC OFF, and with everything that waits for the axis - a path that moves it, `#WAIT INDP`, actual positions, the end of
//! the program.
//!
//! Source: TF5200 programming manual, oscillating axes (208621195); functional description (222108427); 21071, 50593, 120470.
//! Assumptions: the axis moves to its first position first; offsets apply only with INCL_OFFSETS, with their values in the
//! block; the first position is EXCUR below ZERO_POS, the second one EXCUR above; FREQ and TIME refer to an oscillation without
//! its dwells; the block after OSC OFF begins when the axis has stopped.

use super::independent::longer_than;
use crate::diag::Condition;
use crate::exec::commands::keys::arguments;
use crate::exec::commands::range::{above_zero, at_least, between};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::{Event, OscillatingMotion, Sync};
use crate::machine::Machine;
use crate::syntax::ast::{Group, Item, Span};
use kontur_motion::independent::IndependentSpeed;

arguments! {
    /// Keys of `X[OSC ..]`.
    struct OscArguments {
        on: Flag "ON", "", "begins";
        osc_on: Flag "OSC_ON", "", "as OSC ON";
        off: Flag "OFF", "", "ends at the second position";
        first: Number "1ST_POS", "mm", "first reversal position";
        second: Number "2ND_POS", "mm", "second reversal position";
        first_rest: Number "1ST_DELT" in at_least(0.0), "s", "dwell at the first position";
        second_rest: Number "2ND_DELT" in at_least(0.0), "s", "dwell at the second position";
        feed: Number "FEED" in at_least(0.0), "mm/min", "";
        frequency: Number "FREQ" in above_zero(), "1/s", "instead of FEED";
        time: Number "TIME" in above_zero(), "s", "of an oscillation, instead of FEED";
        count: Number "NBR_OSC" in between(1.0, u32::MAX as f64).whole().or(Condition::OscillationCount), "", "number of oscillations";
        zero: Number "ZERO_POS", "mm", "centre of both positions, replaces them together with EXCUR";
        excursion: Number "EXCUR", "mm", "excursion from the centre: the first position is ZERO_POS - EXCUR";
        offsets: Flag "INCL_OFFSETS", "", "the positions are those of the program, with its offsets";
        short: Flag "SHORT", "", "not supported";
        instant: Flag "INSTANT", "", "not supported";
    }
}

impl OscArguments {
    /// The first key that is not supported.
    fn unsupported(&self) -> Option<(&'static str, Span)> {
        let number = |key: Option<(f64, Span)>| key.map(|(_, span)| span);
        [
            ("SHORT", self.short),
            ("OFF INSTANT", self.instant),
            ("OFF FEED", self.off.and(number(self.feed))),
        ]
        .into_iter()
        .find_map(|(name, span)| Some((name, span?)))
    }

    /// Both reversal positions as programmed, with their places; `None` if they are not defined.
    fn reversal(&self) -> Option<[(f64, Span); 2]> {
        match (self.first, self.second, self.zero, self.excursion) {
            (Some(first), Some(second), None, None) => Some([first, second]),
            (None, None, Some((zero, at)), Some((excursion, second_at))) => {
                Some([(zero - excursion, at), (zero + excursion, second_at)])
            }
            _ => None,
        }
    }

    /// Speed of a stroke, with a feed rate in `feed`; `None` if none is programmed.
    fn speed(&self, feed: f64, span: Span) -> Outcome<Option<IndependentSpeed>> {
        Ok(match (self.feed, self.frequency, self.time) {
            (Some((f, _)), None, None) if f > 0.0 => Some(IndependentSpeed::Feed(f * feed)),
            (None, Some((f, _)), None) => Some(IndependentSpeed::Time(0.5 / f)),
            (None, None, Some((t, _))) => Some(IndependentSpeed::Time(0.5 * t)),
            (Some(_) | None, None, None) => None,
            _ => {
                let text = "two of FEED, FREQ and TIME";
                return Err(Fault::new(Condition::IndependentSyntax, text, span));
            }
        })
    }
}

impl Decoder {
    /// `X[OSC ..]`; `rest`: the text after the first word.
    pub(in crate::exec) fn oscillating_axis(
        &mut self,
        axis: usize,
        rest: &[Item],
        span: Span,
    ) -> Outcome<()> {
        let title = format!("{}[OSC]", self.names.name(axis));
        // the page scales oscillating axes, but does not define which words are scaled
        if self.geometry.scale.changes(axis) {
            return Err(Fault::unsupported(format!("{title} with #SCALE"), span));
        }
        let group = Group { items: rest.to_vec(), span };
        let keys = OscArguments::read(self, &title, Some(&group))?;
        if let Some((name, at)) = keys.unsupported() {
            return Err(Fault::unsupported(format!("{title} with {name}"), at));
        }
        if self.machine.axes[axis].is_modulo() {
            return Err(Fault::unsupported(format!("{title} of a modulo axis"), span));
        }
        self.motion.couplings.moves_not_coupled(axis, &self.machine, span)?;
        self.motion.areas.moves_unwatched(axis, &self.names, span)?;
        match (keys.on.or(keys.osc_on), keys.off) {
            (Some(_), None) => {
                self.motion.moves_outside_curves(
                    axis,
                    &self.modal,
                    &self.contour,
                    &self.names,
                    span,
                )?;
                self.geometry.moves_untransformed(axis, &self.names, span)?;
                self.oscillation(axis, &keys, span)
            }
            (None, Some(_)) => {
                self.join(vec![axis]);
                Ok(())
            }
            _ => {
                let text = format!("{title} needs ON or OFF");
                Err(Fault::new(Condition::TokenUnknown, text, span))
            }
        }
    }

    fn oscillation(&mut self, axis: usize, keys: &OscArguments, span: Span) -> Outcome<()> {
        let number = self.machine.axes[axis].number();
        let name = self.names.name(axis).to_owned();
        let of_axis = |condition, text: String, at| {
            Fault::new(condition, text, at).with(|d| d.axis(number, name.clone()))
        };
        let Some([(first, at), (second, second_at)]) = keys.reversal() else {
            let text =
                format!("axis {name}: 1ST_POS and 2ND_POS, or ZERO_POS and EXCUR, are required");
            return Err(of_axis(Condition::NoOscillation, text, span));
        };
        if (second - first).abs() <= 0.0 {
            let text = format!("axis {name}: both reversal positions are {first}");
            return Err(of_axis(Condition::NoOscillation, text, second_at));
        }
        let unit = self.modal.axis_unit(&self.machine.axes[axis]);
        let offset_mm = self.geometry.included_offset(axis, "OSC", keys.offsets, &self.names)?;
        let reversal_mm = [first, second].map(|position| position * unit + offset_mm);
        let feed = self.machine.channel.feed.unit_mm_min / 60.0 * unit;
        let Some(speed) = keys.speed(feed, span)? else {
            let text = format!("axis {name}: the oscillation has no feed");
            return Err(of_axis(Condition::OscillationFeed, text, span));
        };
        if let Some(limits) = limited_stroke(&self.machine, axis, reversal_mm, speed) {
            // 50487
            let (number, name) = (self.names.number(axis), self.names.name(axis).to_owned());
            let text = format!("axis {name} oscillates more slowly than programmed: {limits}");
            let fault = Fault::new(Condition::OscillationLimited, text, span);
            self.report.note(fault.with(|d| d.axis(number, name)));
        }
        if self.motion.independent.open.contains(&axis) {
            self.join(vec![axis]);
        }
        // a path in motion stops first
        self.sync(Sync::Halt);
        let limits = self.geometry.limits(&self.motion, &self.names, &self.machine);
        limits.check_target(axis, reversal_mm[0], &mut self.report, at);
        limits.check_target(axis, reversal_mm[1], &mut self.report, second_at);
        let from_mm = self.geometry.coordinates.target()[axis];
        self.geometry.coordinates.place(axis, reversal_mm[1]);
        self.motion.independent.way[axis] += reversal_mm[1] - from_mm;
        let rest = |key: Option<(f64, Span)>| key.map_or(0.0, |(s, _)| s);
        let motion = OscillatingMotion {
            from_mm,
            reversal_mm,
            rest_s: [rest(keys.first_rest), rest(keys.second_rest)],
            speed,
            slope: self.machine.channel.dynamics.slope,
            count: keys.count.map(|(n, _)| n as u32),
            source: self.report.source,
        };
        self.contour.event(Event::Oscillation { axis, motion });
        self.motion.independent.open.push(axis);
        Ok(())
    }
}

/// What the limits of the axis make of the programmed time or feed rate of a stroke; `None` if they allow it.
fn limited_stroke(
    machine: &Machine,
    axis: usize,
    [first, second]: [f64; 2],
    speed: IndependentSpeed,
) -> Option<String> {
    let (dynamics, cycle) = (machine.axes[axis].dynamics(), machine.cycle);
    let slope = machine.channel.dynamics.slope;
    match speed {
        IndependentSpeed::Time(t) => longer_than(t, [first, second], slope, &dynamics, cycle)
            .map(|least_s| format!("a stroke in {t} s requires {least_s} s")),
        IndependentSpeed::Feed(v) if v > dynamics.v_max_mm_s * (1.0 + 1e-9) => {
            Some(format!("a feed of {v} mm/s is limited to {} mm/s", dynamics.v_max_mm_s))
        }
        _ => None,
    }
}
