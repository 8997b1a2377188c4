//! `#HSC`: B-splines through short blocks, or corners rounded within `CONTERROR`.
//!
//! Source: TF5200 programming manual.

use super::contour::{set, switch};
use super::keys::arguments;
use super::range::{at_least, between};
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::contour::contouring::Hsc;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::values::number::whole;
use crate::syntax::ast::Span;
use kontur_motion::block::SplineSettings;

arguments! {
    /// Keys of `#HSC`.
    struct HscArguments {
        bspline: Flag "BSPLINE", "", "the first key: a B-spline through short blocks";
        path_dev: Number "PATH_DEV" in at_least(0.0), "mm", "default of the channel list (P-CHAN-00122, 0.2); 0: not monitored";
        track_dev: Number "TRACK_DEV" in between(0.0, 1e6), "deg", "default of the channel list (P-CHAN-00123, 5); 0: not monitored";
        merge: MaybeNumber "MERGE", "", "no effect";
        auto_off_path: MaybeNumber "AUTO_OFF_PATH", "", "ends the spline";
        auto_off_track: MaybeNumber "AUTO_OFF_TRACK", "", "ends the spline";
        auto_off_g00: MaybeNumber "AUTO_OFF_G00", "", "ends the spline";
        auto_off_g60: MaybeNumber "AUTO_OFF_G60", "", "an exact stop ends the spline, always so here (K-0111 without it)";
        max_path_length: Number "MAX_PATH_LENGTH" in at_least(0.0), "mm", "longer blocks are kept";
        max_angle: Number "MAX_ANGLE" in between(0.0, 180.0), "deg", "sharper corners are kept; 0: unlimited";
        surface: Flag "SURFACE", "", "not supported";
        cos_phi_min: MaybeNumber "COS_PHI_MIN", "", "of OPMODE=2, not supported";
        fact_block_len: MaybeNumber "FACT_BLOCK_LEN", "", "of OPMODE=2, not supported";
        opmode: Number "OPMODE", "", "1: corners within CONTERROR; default until BSPLINE is written";
        conterror: Number "CONTERROR" in at_least(0.0), "mm", "default 0.1";
    }
}

impl HscArguments {
    /// The first key that only a B-spline has.
    fn of_spline(&self) -> Option<(&'static str, Span)> {
        let number = |key: Option<(f64, Span)>| key.map(|(_, span)| span);
        let switch = |key: Option<(Option<f64>, Span)>| key.map(|(_, span)| span);
        let keys = [
            ("PATH_DEV", number(self.path_dev)),
            ("TRACK_DEV", number(self.track_dev)),
            ("MAX_PATH_LENGTH", number(self.max_path_length)),
            ("MAX_ANGLE", number(self.max_angle)),
            ("MERGE", switch(self.merge)),
            ("AUTO_OFF_PATH", switch(self.auto_off_path)),
            ("AUTO_OFF_TRACK", switch(self.auto_off_track)),
            ("AUTO_OFF_G00", switch(self.auto_off_g00)),
            ("AUTO_OFF_G60", switch(self.auto_off_g60)),
        ];
        keys.into_iter().find_map(|(key, at)| Some((key, at?)))
    }

    /// Whether the command selects rounded corners (true) or the B-spline; `before` is the state before it.
    ///
    /// # Errors
    /// A mode that is not supported, a change of mode while `#HSC` is on, or a key of the other mode.
    fn rounds_corners(&self, before: &Hsc, stays_on: bool) -> Outcome<bool> {
        let opmode = self.opmode.map(|(mode, span)| (whole(mode, 1, 2), mode, span));
        let other = match (self.bspline, opmode) {
            (Some(span), _) => before.rounds_corners.then_some(span),
            (None, Some((Some(1), _, span))) => (!before.rounds_corners).then_some(span),
            (None, Some((Some(2), _, span))) => Some(span),
            _ => self.surface,
        };
        if let (true, Some(span)) = (stays_on, other) {
            let text = "#HSC: another mode while it is on";
            return Err(Fault::new(Condition::HscModeWhileOn, text, span));
        }
        if let Some(span) = self.surface {
            return Err(Fault::unsupported("#HSC [SURFACE]", span));
        }
        if let Some((_, span)) = self.cos_phi_min.or(self.fact_block_len) {
            return Err(Fault::unsupported("#HSC [OPMODE=2]", span));
        }
        let rounds = match opmode {
            Some((Some(1), _, _)) => true,
            Some((Some(_), _, span)) => return Err(Fault::unsupported("#HSC [OPMODE=2]", span)),
            Some((None, mode, span)) => {
                let text = format!("OPMODE={mode}, allowed: 1 and 2");
                return Err(Fault::new(Condition::Range, text, span));
            }
            None => before.rounds_corners,
        };
        if self.bspline.is_some() {
            return Ok(false);
        }
        if let (true, Some((key, at))) = (rounds, self.of_spline()) {
            let text = format!("#HSC: {key} belongs to the B-spline, whose first key is BSPLINE");
            return Err(Fault::new(Condition::TokenUnknown, text, at));
        }
        Ok(rounds)
    }

    /// Changes the settings that are given as numbers and switches; lengths in `unit`.
    fn set_numbers(&self, hsc: &mut Hsc, unit: f64) {
        set(&mut hsc.spline.path_dev_mm, self.path_dev, unit);
        set(&mut hsc.spline.track_dev_deg, self.track_dev, 1.0);
        set(&mut hsc.spline.max_length_mm, self.max_path_length, unit);
        if let Some((angle_deg, _)) = self.max_angle {
            hsc.spline.max_angle_deg = SplineSettings::angle_limit_deg(angle_deg);
        }
        set(&mut hsc.contour_error_mm, self.conterror, unit);
        switch(&mut hsc.spline.off_at_path_dev, self.auto_off_path);
        switch(&mut hsc.spline.off_at_track_dev, self.auto_off_track);
        switch(&mut hsc.spline.off_at_rapid, self.auto_off_g00);
        switch(&mut hsc.off_at_stop, self.auto_off_g60);
    }
}

/// Row of `#HSC`.
pub(super) const HSC: Row = Row::run("HSC", hsc)
    .form("#HSC [ON|OFF] [BSPLINE keys]   #HSC [ON|OFF] [OPMODE=1 CONTERROR=..]")
    .meaning("fits a B-spline through short blocks; OPMODE=1 rounds corners within CONTERROR")
    .keys(HscArguments::KEYS)
    .note("BSPLINE first removes the rounding noise of the coordinates, within 30 % of the tolerances and at most 3 um")
    .example("#HSC ON [BSPLINE PATH_DEV=0.05]")
    .related(&["120393", "120396"]);

/// `#HSC [ON|OFF] [BSPLINE ..]`, `#HSC [..] [OPMODE= CONTERROR=]`.
fn hsc(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let unit = decoder.modal.tolerance_unit_mm(&decoder.machine.channel);
    let keys = HscArguments::read(decoder, &call.title(), call.command.groups.first())?;
    let mut hsc = decoder.contour.hsc;
    let stays_on = hsc.on && call.command.on != Some(false);
    hsc.rounds_corners = keys.rounds_corners(&hsc, stays_on)?;
    if let (false, Some((_, at))) = (hsc.rounds_corners, keys.conterror) {
        let text = "CONTERROR has no effect on a B-spline: it belongs to OPMODE=1";
        let hint = "write #HSC [OPMODE=1 CONTERROR=..], or PATH_DEV for the B-spline";
        decoder.report.note(Fault::new(Condition::Odd, text, at).hint(hint));
    }
    keys.set_numbers(&mut hsc, unit);
    if let Some((_, span)) = keys.merge {
        let text = "#HSC: MERGE has no effect";
        decoder.report.note_once("HSC MERGE", Fault::new(Condition::Fallback, text, span));
    }
    hsc.on = call.command.on.unwrap_or(hsc.on);
    decoder.contour.hsc = hsc;
    Ok(())
}
