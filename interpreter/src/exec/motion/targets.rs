//! Targets of a motion block: from coordinate words to axis positions.

use crate::diag::Condition;
use crate::exec::block::collected::Words;
use crate::exec::block::modal::Modal;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::{OffsetKind, Target};
use crate::exec::geometry::{Geometry, modulo};
use crate::exec::names::AxisNames;
use crate::exec::values::number::LARGEST_MM;
use crate::machine::Machine;
use crate::syntax::ast::{Group, ItemKind, Sign, Span};
use kontur_motion::axis::AxisVec;

/// Targets of one block.
type Targets = smallvec::SmallVec<[Target; 8]>;

/// Largest component of a direction that counts as rounding.
const STRAIGHT: f64 = 1e-12;

impl Geometry {
    /// 20200: a rotated coordinate system requires motion along a main axis that is not in the channel.
    fn turns_within_the_channel(
        &self,
        targets: &[Target],
        words: &Words<'_>,
        names: &AxisNames,
    ) -> Outcome<()> {
        let coordinates = &self.coordinates;
        let frame = coordinates.frame();
        if frame.is_identity() {
            return Ok(());
        }
        for (target, (axis, _, at)) in targets.iter().zip(&words.axes) {
            let Some(main) = coordinates.main_index(target.axis) else { continue };
            let lost = (0..3)
                .any(|i| coordinates.main_axis(i).is_none() && frame.m[i][main].abs() > STRAIGHT);
            if lost {
                let name = names.name(*axis);
                let text = format!(
                    "{name} requires motion of a main axis that is not in the channel: the system is rotated"
                );
                return Err(Fault::new(Condition::AxisOrCommandExpected, text, *at));
            }
        }
        Ok(())
    }

    /// The coordinate of a modulo axis that is reached in the programmed direction from its position; `without`: suppressed
    /// offsets.
    fn unwrapped(
        &self,
        target: &Target,
        words: &Words<'_>,
        position: f64,
        without: Option<&[OffsetKind]>,
        machine: &Machine,
    ) -> Outcome<f64> {
        let turn = words.turns.iter().find(|(axis, _)| *axis == target.axis);
        let turn = if machine.channel.language.shortest_way {
            None
        } else {
            turn.map(|(_, sign)| *sign).transpose().map_err(modulo::two_readings)?
        };
        let offset = match without {
            Some(kinds) => self.coordinates.offset_without(kinds, target.axis),
            None => self.coordinates.active_offset(target.axis),
        };
        // the distance is measured in the coordinate: a mirrored axis turns in the opposite direction
        let bare = position - offset;
        let mirrored = self.coordinates.mirrored(target.axis);
        let from = if mirrored { -bare } else { bare };
        let range_deg = machine.axes[target.axis].modulo_deg();
        Ok(modulo::unwrapped(target.value, turn, from, range_deg))
    }

    /// Diameters must be neither negative nor mirrored.
    ///
    /// Source: TF5200 diagnosis 250554251, 20019. Assumption: the sign of incremental words is their direction.
    fn diameters_fit(
        &self,
        words: &Words<'_>,
        machine: &Machine,
        modal: &Modal,
        names: &AxisNames,
    ) -> Outcome<()> {
        let Some(turned) = modal.diameter else { return Ok(()) };
        for (i, (axis, value, at)) in words.axes.iter().enumerate() {
            let absolute = words.is_absolute(i, modal.absolute);
            if *axis != turned || !machine.axes[*axis].takes_diameters(absolute) {
                continue;
            }
            let mirrored = self.coordinates.mirrored(*axis);
            if mirrored || (absolute && *value < 0.0) {
                let name = names.name(*axis);
                let what = if mirrored { "mirrored" } else { "negative" };
                let text = format!("{name}{value} is a {what} diameter (G51)");
                return Err(Fault::new(Condition::DiameterNegative, text, *at));
            }
        }
        Ok(())
    }
}

impl Decoder {
    /// Applies the coordinate words to the target; returns the previous positions of the axes.
    pub(super) fn program_targets(&mut self, words: &Words<'_>) -> Outcome<AxisVec> {
        for (axis, _, at) in &words.axes {
            self.motion.couplings.moves_no_slave(*axis, &self.names, *at)?;
        }
        let mut start = self.geometry.coordinates.target().clone();
        let mut targets = self.targets_of(words);
        in_format(&targets, words, &self.names)?;
        self.geometry.diameters_fit(words, &self.machine, &self.modal, &self.names)?;
        if self.machine.channel.language.several_words {
            targets = joined(targets);
        }
        targets.extend(self.motion.contour_line.targets.drain(..));
        if !self.machine.channel.language.shortest_way {
            turns_go_forward(&targets, words, &self.names)?;
        }
        self.geometry.turns_within_the_channel(&targets, words, &self.names)?;
        let suppressed = suppressed_offsets(words)?;
        let without = suppressed.as_ref().map(|(kinds, _)| &kinds[..]);
        for target in targets.iter_mut().filter(|t| t.absolute) {
            if self.machine.axes[target.axis].is_modulo() {
                target.value = self.geometry.unwrapped(
                    target,
                    words,
                    start[target.axis],
                    without,
                    &self.machine,
                )?;
            }
        }
        match suppressed {
            Some((_, at)) if targets.iter().any(|t| !t.absolute) => {
                let text = "#SUPPRESS OFFSETS is only valid with G90";
                return Err(Fault::new(Condition::SuppressWithIncremental, text, at));
            }
            Some((kinds, _)) => self.geometry.coordinates.program_without(&kinds, &targets),
            None => self.geometry.coordinates.program(targets.iter().copied()),
        }
        self.motion.follow_masters(&mut self.geometry.coordinates);
        // the travel of a slave is on the path, also at the start of the path
        for slave in self.motion.couplings.slaves() {
            start[slave] = self.geometry.coordinates.target()[slave];
        }
        self.motion.follow_turning_centre(
            &start,
            &self.geometry.coordinates,
            &self.modal,
            &mut self.contour,
            words.axes.first().map_or_else(Span::default, |(_, _, at)| *at),
        )?;
        Ok(start)
    }

    /// Targets of the coordinate words in mm or deg.
    fn targets_of(&self, words: &Words<'_>) -> Targets {
        let target = |(i, (axis, value, _)): (usize, &(usize, f64, Span))| {
            let absolute = words.is_absolute(i, self.modal.absolute);
            let unit = self.geometry.coordinate_unit(*axis, absolute, &self.machine, &self.modal);
            Target { axis: *axis, value: value * unit, absolute }
        };
        words.axes.iter().enumerate().map(target).collect()
    }
}

/// Refuses a target outside the data format.
fn in_format(targets: &[Target], words: &Words<'_>, names: &AxisNames) -> Outcome<()> {
    let too_large = targets.iter().position(|t| t.value.abs() > LARGEST_MM);
    let Some((axis, value, at)) = too_large.and_then(|i| words.axes.get(i)) else { return Ok(()) };
    let text = format!("{}{value} is outside the data format", names.name(*axis));
    Err(Fault::new(Condition::CoordinateTooLarge, text, *at))
}

/// The kinds of offsets that `#SUPPRESS OFFSETS` leaves out in the block, and its place.
fn suppressed_offsets(words: &Words<'_>) -> Outcome<Option<(Vec<OffsetKind>, Span)>> {
    let found = words.hashes.iter().find(|(h, _, _)| &*h.name == "SUPPRESS OFFSETS");
    let Some((hash, _, at)) = found else { return Ok(None) };
    let kinds = hash.bracket.as_ref().map_or_else(|| Ok(OffsetKind::ALL.to_vec()), kinds)?;
    Ok(Some((kinds, *at)))
}

/// One target per axis: incremental words are summed, an absolute word replaces those before it.
///
/// Source: P-CHAN-00148 (149346955).
fn joined(targets: Targets) -> Targets {
    let mut all = Targets::new();
    for target in targets {
        match all.iter_mut().find(|t: &&mut Target| t.axis == target.axis) {
            Some(earlier) if target.absolute => *earlier = target,
            Some(earlier) => earlier.value += target.value,
            None => all.push(target),
        }
    }
    all
}

/// The kinds of `#SUPPRESS OFFSETS [ZERO ..]`. Clamping offsets and manual mode do not exist here.
fn kinds(group: &Group) -> Outcome<Vec<OffsetKind>> {
    let wrong = |span| {
        let text = "#SUPPRESS OFFSETS: a kind of offsets is expected";
        Fault::new(Condition::TokenUnknown, text, span)
            .hint("ZERO, ADD_ZERO, PSET, CLAMP, TOOL, MEASURE, MANUAL")
    };
    let mut kinds = Vec::new();
    for item in &group.items {
        let ItemKind::Flag(word) = &item.kind else { return Err(wrong(item.span)) };
        match word.text.to_ascii_uppercase().as_str() {
            "ZERO" => kinds.push(OffsetKind::Zero),
            "ADD_ZERO" => kinds.push(OffsetKind::Additive),
            "PSET" => kinds.push(OffsetKind::Preset),
            "TOOL" => kinds.push(OffsetKind::Tool),
            "MEASURE" => kinds.push(OffsetKind::Measuring),
            "CLAMP" | "MANUAL" => {}
            _ => return Err(wrong(word.span)),
        }
    }
    if group.items.is_empty() { Err(wrong(group.span)) } else { Ok(kinds) }
}

/// 20958: the first sign of a relative word of a modulo axis is the direction of travel; the distance itself is unsigned.
///
/// Source: TF5200 diagnosis 253095819; modulo programming in relative coordinates (tccncprogramming 15557270155).
fn turns_go_forward(targets: &[Target], words: &Words<'_>, names: &AxisNames) -> Outcome<()> {
    for (axis, sign) in &words.turns {
        let is_own = |t: &&Target| t.axis == *axis && !t.absolute;
        let (Some(target), Ok(sign)) = (targets.iter().find(is_own), sign) else { continue };
        let back = match sign {
            Sign::Plus => target.value < 0.0,
            Sign::Minus => target.value > 0.0,
        };
        if back {
            let text = format!("{}: a negative distance after its direction", names.name(*axis));
            let at = words.axes.iter().find(|(a, _, _)| a == axis).map(|(_, _, at)| *at);
            return Err(Fault::new(Condition::WayAfterDirection, text, at.unwrap_or_default()));
        }
    }
    Ok(())
}
