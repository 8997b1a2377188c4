//! `#CONTOUR MODE`.
//!
//! Source: TF5200 programming manual.

use super::keys::arguments;
use super::range::{at_least, between};
use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::contour::contouring::{ContourParameters, Mode, PtpLimit};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::report::Report;
use crate::exec::values::number::is_true;
use crate::syntax::ast::{Group, ItemKind, ItemValue, Span};
use kontur_motion::block::{BlockLimit, CurveJerk};

arguments! {
    /// Keys of `#CONTOUR MODE`.
    struct ContourArguments {
        dev: Flag "DEV", "", "corners within PATH_DEV, the mode at program start";
        dist: Flag "DIST", "", "corners from PRE_DIST to POST_DIST";
        dist_soft: Flag "DIST_SOFT", "", "rounded as PTP (K-0111)";
        dist_master: Flag "DIST_MASTER", "", "rounded as PTP (K-0111)";
        pos: Flag "POS", "", "as DIST, through an interim point X Y Z (X2.7 or X=2.7)";
        ptp: Flag "PTP", "", "PATH_DEV or PATH_DIST; the one that is written limits the curve, or both";
        auto_dev: Flag "AUTO_DEV", "", "as DEV (K-0111)";
        auto_vel: MaybeNumber "AUTO_VEL", "", "not supported";
        vel: MaybeNumber "VEL", "", "of AUTO_VEL, not supported";
        path_dev: Number "PATH_DEV" in at_least(0.0), "mm", "default 1";
        pre_dist: Number "PRE_DIST" in at_least(0.0), "mm", "default 1";
        post_dist: Number "POST_DIST" in at_least(0.0), "mm", "default 1";
        path_dist: Number "PATH_DIST" in at_least(-1.0), "mm", "of PTP, DIST_SOFT, default 1; negative: no limit";
        relevant_path: Number "RELEVANT_PATH" in at_least(0.0), "mm", "default 0; shorter blocks are skipped";
        track_dev: Number "TRACK_DEV" in between(0.0, 1e6), "deg", "default 0";
        relevant_track: Number "RELEVANT_TRACK" in between(0.0, 1e6), "deg", "default 0";
        remain_part: Number "REMAIN_PART" in between(0.0, 100.0), "%", "default 0; part of a block that remains";
        max_angle: Number "MAX_ANGLE" in between(0.0, 180.0), "deg", "";
        const_vel: MaybeNumber "CONST_VEL", "", "constant velocity in the corner";
        check_jerk: MaybeNumber "CHECK_JERK" in between(0.0, 3.0).whole(), "", "as P-CHAN-00110";
        track_dist: Number "TRACK_DIST", "", "no effect";
        merge: MaybeNumber "MERGE", "", "no effect";
        sym_dist: Number "SYM_DIST" in at_least(-1.0), "mm", "of DIST_MASTER, default 1; older name of PATH_DIST in DIST_SOFT";
        acc_max: Number "ACC_MAX", "", "no effect";
        acc_min: Number "ACC_MIN", "", "no effect";
        ramp_time: Number "RAMP_TIME", "", "no effect";
        dist_weight: Number "DIST_WEIGHT", "", "no effect";
        dist_weigth: Number "DIST_WEIGTH", "", "as DIST_WEIGHT, in the spelling of an older page";
        pre_action: Flag "PRE_ACTION", "", "the block ends before the curve: there functions act, and the path waits for them";
        inter_action: Flag "INTER_ACTION", "", "the block ends between both halves of the curve (default)";
        post_action: Flag "POST_ACTION", "", "the block ends after the curve";
    }
}

impl ContourArguments {
    /// Modes in the command, with their words and positions.
    fn modes(&self) -> Vec<(&'static str, Mode, Span)> {
        let modes = [
            ("DEV", Mode::Dev, self.dev),
            ("AUTO_DEV", Mode::Dev, self.auto_dev),
            ("DIST", Mode::Dist, self.dist),
            ("POS", Mode::Pos, self.pos),
            ("PTP", Mode::Ptp, self.ptp),
            ("DIST_SOFT", Mode::DistSoft, self.dist_soft),
            ("DIST_MASTER", Mode::DistMaster, self.dist_master),
        ];
        modes.into_iter().filter_map(|(word, mode, at)| Some((word, mode, at?))).collect()
    }

    /// Keys without effect in the command.
    fn without_effect(&self) -> Vec<(&'static str, Span)> {
        let number = |key: Option<(f64, Span)>| key.map(|(_, span)| span);
        let keys = [
            ("MERGE", self.merge.map(|(_, span)| span)),
            ("TRACK_DIST", number(self.track_dist)),
            ("ACC_MAX", number(self.acc_max)),
            ("ACC_MIN", number(self.acc_min)),
            ("RAMP_TIME", number(self.ramp_time)),
            ("DIST_WEIGHT", number(self.dist_weight.or(self.dist_weigth))),
        ];
        keys.into_iter().filter_map(|(key, at)| Some((key, at?))).collect()
    }

    /// The written places of the end of the block.
    fn limits(&self) -> Vec<(&'static str, BlockLimit, Span)> {
        let limits = [
            ("PRE_ACTION", BlockLimit::Before, self.pre_action),
            ("INTER_ACTION", BlockLimit::Within, self.inter_action),
            ("POST_ACTION", BlockLimit::After, self.post_action),
        ];
        limits.into_iter().filter_map(|(name, limit, at)| Some((name, limit, at?))).collect()
    }

    /// Lengths in the command that its mode does not use: the mode, the key and its position. Source: the pages of the modes
    /// (475180811, 475198987, 475214859, 475227019, tccncprogramming 15557305483 and their neighbours).
    fn of_another_mode(&self) -> Vec<(&'static str, &'static str, Span)> {
        let [(word, mode, _)] = self.modes()[..] else { return Vec::new() };
        let used: &[&str] = match mode {
            Mode::Dev => &["PATH_DEV"],
            Mode::Dist | Mode::Pos => &["PRE_DIST", "POST_DIST"],
            Mode::Ptp => &["PATH_DEV", "PATH_DIST"],
            Mode::DistSoft | Mode::DistMaster => &["PATH_DIST", "SYM_DIST"],
        };
        let lengths = [
            ("PATH_DEV", self.path_dev),
            ("PRE_DIST", self.pre_dist),
            ("POST_DIST", self.post_dist),
            ("PATH_DIST", self.path_dist),
            ("SYM_DIST", self.sym_dist),
        ];
        let unused = lengths.into_iter().filter(|(key, _)| !used.contains(key));
        unused.filter_map(|(key, at)| Some((word, key, at?.1))).collect()
    }
}

/// Row of `#CONTOUR MODE`.
pub(super) const CONTOUR_MODE: Row = Row::run("CONTOUR MODE", contour_mode)
    .form("#CONTOUR MODE [ON|OFF] [DEV|DIST|DIST_SOFT|DIST_MASTER|POS|PTP keys]")
    .meaning("how corners are rounded by polynomials; ON also switches contouring on (G261), OFF switches it off (G260)")
    .keys(ContourArguments::KEYS)
    .note("program start: DEV with PATH_DEV 1; a key that is omitted keeps its value")
    .example("#CONTOUR MODE [DEV PATH_DEV=0.05]")
    .related(&["G261", "120129", "120206", "120216", "P-CHAN-00439"]);

/// Smallest `PATH_DEV` and distance in mm: one increment of the language.
const LEAST_MM: f64 = 1e-4;

/// 120129, 120131 for a length below the minimum.
fn at_least_an_increment(
    condition: Condition,
    key: &str,
    given: Option<(f64, Span)>,
    unit: f64,
) -> Outcome<()> {
    match given {
        Some((x, span)) if x * unit < LEAST_MM => {
            let text = format!("{key}={x} is below the minimum of {LEAST_MM} mm");
            Err(Fault::new(condition, text, span).with(|d| {
                d.value(ValueKind::Wrong, x * unit * 1e4, "0.1um").value(
                    ValueKind::LowerLimit,
                    1.0,
                    "0.1um",
                )
            }))
        }
        _ => Ok(()),
    }
}

/// `#CONTOUR MODE [ON|OFF] [DEV .. ]`: an omitted key keeps its value.
fn contour_mode(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let unit = decoder.modal.tolerance_unit_mm(&decoder.machine.channel);
    let mut settings = decoder.contour.contouring;
    let group = points(decoder, call.command.groups.first(), &mut settings)?;
    let keys = ContourArguments::read(decoder, &call.title(), group.as_ref())?;
    let speed = [("AUTO_VEL", &keys.auto_vel), ("VEL", &keys.vel)];
    let mut speed = speed.into_iter().filter_map(|(name, key)| Some((name, key.as_ref()?.1)));
    if let Some((name, span)) = speed.next() {
        return Err(Fault::unsupported(format!("#CONTOUR MODE [{name}]"), span));
    }
    at_least_an_increment(Condition::PathDevTooSmall, "PATH_DEV", keys.path_dev, unit)?;
    match keys.modes()[..] {
        [] => {}
        [(_, mode, _)] => settings.mode = mode,
        [(first, _, _), (second, _, at), ..] => {
            let text = format!("#CONTOUR MODE: {first} and {second} are different modes");
            return Err(Fault::new(Condition::DuplicateKey, text, at));
        }
    }
    match keys.limits()[..] {
        [] => {}
        [(_, limit, _)] => settings.common.limit = limit,
        [(first, _, _), (second, _, at), ..] => {
            let text = format!("#CONTOUR MODE: {first} and {second} exclude each other");
            return Err(Fault::new(Condition::DuplicateKey, text, at));
        }
    }
    // only POS allows a distance of 0
    if settings.mode != Mode::Pos {
        let condition = Condition::CornerDistanceTooSmall;
        at_least_an_increment(condition, "PRE_DIST", keys.pre_dist, unit)?;
        at_least_an_increment(condition, "POST_DIST", keys.post_dist, unit)?;
    }
    keys.set_numbers(&mut settings, unit);
    check_change_of_mode(decoder, settings.mode, call.span())?;
    decoder.contour.contouring = settings;
    report_unused(&mut decoder.report, &keys, settings.mode, call.span());
    if let Some(on) = call.command.on {
        decoder.modal.contouring = on;
        decoder.modal.exact_stop &= !on;
    }
    Ok(())
}

impl ContourArguments {
    /// Changes the settings that are given as numbers; lengths in `unit`.
    fn set_numbers(&self, settings: &mut ContourParameters, unit: f64) {
        set(&mut settings.path_dev_mm, self.path_dev, unit);
        set(&mut settings.pre_mm, self.pre_dist, unit);
        set(&mut settings.post_mm, self.post_dist, unit);
        let symmetric = matches!(settings.mode, Mode::DistSoft | Mode::DistMaster);
        let path_dist = self.path_dist.or(self.sym_dist.filter(|_| symmetric));
        set(&mut settings.path_dist_mm, path_dist, unit);
        if settings.mode == Mode::Ptp {
            settings.ptp = match (self.path_dev, self.path_dist) {
                (Some(_), None) => PtpLimit::Deviation,
                (None, Some(_)) => PtpLimit::Distance,
                (Some(_), Some(_)) => PtpLimit::Both,
                (None, None) => settings.ptp,
            };
        }
        let common = &mut settings.common;
        set(&mut common.relevant_path_mm, self.relevant_path, unit);
        set(&mut common.track_dev_deg, self.track_dev, 1.0);
        set(&mut common.relevant_track_deg, self.relevant_track, 1.0);
        if let Some((percent, _)) = self.remain_part {
            common.remain_ratio = percent / 100.0;
        }
        set(&mut common.max_angle_deg, self.max_angle, 1.0);
        switch(&mut common.constant_velocity, self.const_vel);
        if let Some((mode, _)) = self.check_jerk {
            common.curve_jerk =
                Some(match crate::exec::values::number::whole(mode.unwrap_or(1.0), 0, 3) {
                    Some(0) => CurveJerk::Unlimited,
                    Some(2) => CurveJerk::Ramps,
                    _ => CurveJerk::Geometric,
                });
        }
    }
}

/// `DIST_SOFT` begins and ends only while contouring is off, and is not for gantry masters.
fn check_change_of_mode(decoder: &Decoder, mode: Mode, span: Span) -> Outcome<()> {
    let old = decoder.contour.contouring.mode;
    let soft = old == Mode::DistSoft || mode == Mode::DistSoft;
    if decoder.modal.contouring && soft && old != mode {
        let text = "#CONTOUR MODE to or from DIST_SOFT while contouring is active (G261)";
        return Err(Fault::new(Condition::SoftContouringActive, text, span));
    }
    let master = decoder.machine.axes.iter().find(|axis| axis.is_gantry_master());
    if let (Mode::DistSoft, Some(master)) = (mode, master) {
        let text = format!("#CONTOUR MODE [DIST_SOFT]: {} is a gantry master", master.name());
        return Err(Fault::new(Condition::SoftContouringOfMaster, text, span));
    }
    Ok(())
}

/// Notes about keys that change nothing, and about modes whose curve is not published.
fn report_unused(report: &mut Report, keys: &ContourArguments, mode: Mode, span: Span) {
    for (key, span) in keys.without_effect() {
        let text = format!("#CONTOUR MODE: {key} has no effect");
        report.note_once(key, Fault::new(Condition::Fallback, text, span));
    }
    for (mode, key, span) in keys.of_another_mode() {
        let text = format!("#CONTOUR MODE: {mode} does not use {key}");
        report.note_once(
            format!("{mode} {key}").as_str(),
            Fault::new(Condition::Fallback, text, span),
        );
    }
    if let Some(span) = keys.auto_dev {
        let text = "#CONTOUR MODE: AUTO_DEV has the curve of DEV, whose length does not depend on the speed";
        report.note_once("AUTO_DEV", Fault::new(Condition::Fallback, text, span));
    }
    if matches!(mode, Mode::DistSoft | Mode::DistMaster) {
        let text = "#CONTOUR MODE: the curve of this mode is not published, corners are rounded as with PTP";
        report.note_once("DIST_SOFT", Fault::new(Condition::Fallback, text, span));
    }
}

/// Applies a number if it is given, converted from its unit.
pub(super) fn set(slot: &mut f64, written: Option<(f64, Span)>, unit: f64) {
    if let Some((x, _)) = written {
        *slot = x * unit;
    }
}

/// Applies a switch if it is given: a key without a value switches on.
pub(super) fn switch(slot: &mut bool, written: Option<(Option<f64>, Span)>) {
    if let Some((x, _)) = written {
        *slot = x.is_none_or(is_true);
    }
}

/// Removes the coordinates of an interim point from the bracket; the remaining items are keys.
fn points(
    decoder: &Decoder,
    group: Option<&Group>,
    settings: &mut ContourParameters,
) -> Outcome<Option<Group>> {
    let Some(group) = group else { return Ok(None) };
    let mut rest = Group { items: Vec::new(), span: group.span };
    let mut written = [false; 3];
    for item in &group.items {
        let main_axis = |name: &str| decoder.names.of_name(name).filter(|axis| *axis < 3);
        let point = match &item.kind {
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } => match main_axis(&key.text) {
                Some(axis) => Some((axis, decoder.number(expr)?)),
                None => None,
            },
            // `X2.7`
            ItemKind::Flag(word) => word
                .split_number()
                .and_then(|(name, number)| main_axis(name).map(|axis| (axis, number))),
            _ => None,
        };
        let Some((axis, value)) = point else {
            rest.items.push(item.clone());
            continue;
        };
        if std::mem::replace(&mut written[axis], true) {
            let text = format!("#CONTOUR MODE: {} is given twice", decoder.names.name(axis));
            return Err(Fault::new(Condition::DuplicateKey, text, item.span));
        }
        if !decoder.geometry.coordinates.frame().is_identity() {
            let what = "an interim point of #CONTOUR MODE in a frame";
            return Err(Fault::unsupported(what, item.span));
        }
        let value = value * decoder.modal.axis_unit(&decoder.machine.axes[axis]);
        settings.point_mm[axis] = Some(value + decoder.geometry.coordinates.active_offset(axis));
    }
    Ok(Some(rest))
}
