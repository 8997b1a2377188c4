//! IDs that the documents print but that are not raised here: data for `explain`.

use super::row::{
    Reaction::{self, AbruptStop, ControlledStop, FeedHold, JobAbort, None, ProgramAbort},
    Row,
};
use crate::diag::id::{
    Id::{self, Kontur, Vendor},
    Severity::{self, Error, Warning},
};

#[expect(clippy::too_many_arguments, reason = "one table row, read as a line")]
const fn documented(
    id: Id,
    name: &'static str,
    severity: Severity,
    reaction: Reaction,
    remedy: u8,
    root: u8,
    meaning: &'static str,
    cause: &'static str,
) -> Row {
    Row {
        id,
        name,
        severity,
        reaction,
        remedy,
        root,
        meaning,
        cause,
        hint: Option::None,
        parameter: Option::None,
        note: "",
    }
}

/// A row with a remark.
const fn noted(row: Row, note: &'static str) -> Row {
    Row { note, ..row }
}

/// The rows, ordered by ID.
#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    documented(Vendor(2100), "", Error, ProgramAbort, 7, 2, "diagnosis file cannot be written", "#DIAGNOSIS"),
    documented(Vendor(20747), "", Error, ProgramAbort, 3, 1, "too many subroutine files", ""),
    documented(Vendor(21141), "", Error, ProgramAbort, 3, 1, "command not allowed in a manual block", ""),
    documented(Vendor(21218), "", Error, ProgramAbort, 3, 1, "variable type not available", "V.L where the configuration does not permit it"),
    documented(Vendor(21777), "", Error, ProgramAbort, 3, 1, "keyword index outside the data format", ""),
    documented(Vendor(22145), "", Error, JobAbort, 3, 1, "key twice (#DIAGNOSIS)", ""),
    documented(Vendor(50544), "", Error, FeedHold, 1, 0, "vendor-internal slope diagnosis", ""),
    documented(Vendor(50605), "", Warning, None, 1, 0, "order of the position filter is odd", "P-AXIS-00622"),
    documented(Vendor(50606), "", Warning, None, 1, 0, "type of the position filter is invalid", "P-AXIS-00621"),
    documented(Vendor(50608), "", Warning, None, 1, 0, "order of the speed filter is odd", "P-AXIS-00623"),
    documented(Vendor(50694), "", Error, FeedHold, 7, 0, "setpoint outside the number range", ""),
    documented(Vendor(50974), "", Error, ControlledStop, 6, 0, "setpoint outside the valid range", ""),
    documented(Vendor(70023), "", Error, AbruptStop, 6, 11, "direction monitoring tripped", "wrong sign of command or encoder"),
    noted(documented(Vendor(70081), "", Error, ControlledStop, 6, 11, "exact-stop window not reached in time (older manual, see 70082)", "P-AXIS-00151"), "older manuals; 70082 is raised here"),
    documented(Vendor(70099), "", Error, AbruptStop, 6, 11, "setpoint jump at enable too large", "00108"),
    documented(Vendor(70195), "", Error, ControlledStop, 6, 11, "software limit cannot be kept (setpoint monitoring)", "00520/00521, braking with 00003"),
    documented(Vendor(70269), "", Error, AbruptStop, 7, 11, "no command velocity in the telegram", "00320"),
    documented(Vendor(70449), "", Error, AbruptStop, 7, 11, "feature bit without P-0-4077", ""),
    documented(Vendor(70451), "", Error, ControlledStop, 6, 11, "filter time constant (controller filter)", "00357/00742"),
    documented(Vendor(70480), "", Warning, None, 1, 11, "00519/00779 set, no actual velocity in the telegram", ""),
    documented(Vendor(70569), "", Error, ControlledStop, 5, 11, "gantry coupling only at standstill", ""),
    documented(Vendor(70645), "", Error, ProgramAbort, 3, 11, "axis transformation out of range", "00370"),
    documented(Vendor(90018), "", Error, ProgramAbort, 6, 1, "tool radius compensation: radii of an arc differ", ""),
    documented(Vendor(110119), "", Warning, None, 1, 2, "parameter is 0, set to its minimum", "P-AXIS-00023"),
    documented(Vendor(110228), "", Error, JobAbort, 7, 2, "axis number in the list is not that of the axis, list rejected", "P-AXIS-00016"),
    documented(Vendor(110329), "", Warning, None, 1, 2, "timeout smaller than the window time, corrected", "P-AXIS-00290, P-AXIS-00291"),
    noted(documented(Vendor(110380), "", Warning, None, 1, 2, "numerator of the acceleration feedforward is 0", "P-AXIS-00225"), "the feedforward manual allows a numerator of 0, so P-AXIS-00225 = 0 is a valid weight here"),
    documented(Vendor(110558), "", Warning, None, 1, 2, "parameter is 0, corrected", "P-AXIS-00469"),
    documented(Vendor(110573), "", Warning, None, 1, 2, "parameter above its maximum, limited", "P-AXIS-00497"),
    noted(documented(Vendor(110580), "", Warning, None, 1, 2, "gear ratio: output revolutions are 0 (printed on one page; 110579 is raised)", "P-AXIS-00512"), "printed on one page of the diagnosis manual for P-AXIS-00512 = 0; raised here is 110579"),
    documented(Vendor(110700), "", Warning, None, 1, 2, "invalid value, function off", "P-AXIS-00584"),
    documented(Vendor(120146), "", Warning, None, 1, 0, "tangential transition with AUTO_VEL", ""),
    documented(Vendor(120393), "", Error, ProgramAbort, 6, 0, "order of the block length filter invalid", "#HSC[...]"),
    documented(Vendor(120396), "", Error, ProgramAbort, 6, 0, "order of the angle filter invalid", "#HSC[...]"),
    documented(Vendor(120630), "", Warning, None, 1, 0, "rapid ramp time too large", "G233"),
    documented(Vendor(1000044), "", Error, JobAbort, 6, 2, "job to interpret a list failed in the decoder", ""),
    documented(Kontur(5), "K-PERCENT", Error, ProgramAbort, 3, 0, "`%` head malformed", "20193 and 21313 are raised in its place"),
];
