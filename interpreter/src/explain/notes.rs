//! Remarks, recommendations and examples that do not fit into a row of the parameter table.

/// ID, remark, example value (empty: from the row), related terms.
struct Note(&'static str, &'static str, &'static str, &'static [&'static str]);

/// Source: TF5200 manuals of the functions named in the rows of the table.
#[rustfmt::skip]
const NOTES: &[Note] = &[
    Note("P-AXIS-00003", "0: deceleration with a_max", "", &["P-AXIS-00008"]),
    Note("P-AXIS-00008", "", "6000", &["P-AXIS-00212", "P-AXIS-00001"]),
    Note("P-AXIS-00013", "required for ACC_FACT of #VIB GUARD and #FILTER; 0 means cycle time / ramp time and makes corners slow", "1000", &["#VIB GUARD", "P-CHAN-00117"]),
    Note("P-AXIS-00067", "filters other than LOWPASS, HIGHPASS, ALLPASS, BANDPASS, BANDSTOP and HSC NoVib do not use it; below the lowest frequency: 110361", "21.5", &["P-AXIS-00204", "110361"]),
    Note("P-AXIS-00080", "only used by BANDPASS and BANDSTOP", "3", &["P-AXIS-00067"]),
    Note("P-AXIS-00099", "1000 is 10/s; the lag at constant speed is v / kv. SERCOS: feedforward in the control requires the same gain in the drive (S-0-0104)", "5000", &["110150", "P-AXIS-00223", "S-0-0104"]),
    Note("P-AXIS-00140", "0 switches the filter off; for PT1, PT2 and TIME_DELAY any order above 0 switches the filter on. Used by every type; above the range: 50911", "2", &["P-AXIS-00204", "50911"]),
    Note("P-AXIS-00153", "used by LOWPASS, HIGHPASS, BANDPASS, BANDSTOP and ALLPASS (BESSEL recommended there). BESSEL and BUTTERWORTH low-passes overshoot and are not recommended for positions. FIR filters are recommended instead of HSC from V3.1.3075.02 on", "BUTTERWORTH", &["P-AXIS-00204", "#FILTER"]),
    Note("P-AXIS-00164", "used by every type; the rest of the signal bypasses the filter", "", &[]),
    Note("P-AXIS-00204", "unknown types: 110239, the filter is off", "BANDSTOP", &["P-AXIS-00140", "P-AXIS-00153", "110239", "110500", "110501"]),
    Note("P-AXIS-00212", "1000 um/s is 1 mm/s, 16 666 um/s is 1 m/min", "1000000", &["P-AXIS-00209", "50118", "50119"]),
    Note("P-AXIS-00223", "VEL, ACC, JERK are added to the output of the position controller; ADD_ forms go to additive inputs of the drive (70350, 70351 if it has none). PROFIdrive: output bit 0x100 clear: the value enters the control deviation XERR (signal 25), set: the speed command NSOLL_B (signal 7). SERCOS drives usually have their own feedforward (S-0-0296, S-0-0348)", "VEL | ACC", &["G135", "70350", "70351", "P-AXIS-00255", "P-AXIS-00566"]),
    Note("P-AXIS-00225", "with ACC: Ta = P-AXIS-00225 / P-AXIS-00226 in us, the time constant of the drive", "5000", &["P-AXIS-00226", "110381"]),
    Note("P-AXIS-00226", "the feedforward manual prints 0 inside the range, the diagnosis manual rejects it (110381)", "1", &["P-AXIS-00225", "110381"]),
    Note("P-AXIS-00228", "recommended global weight 0.7..1; above 1 the axis leads. The feedforward manual allows 0, the axis manual names 110122 for it; 0 is a valid weight here", "", &["P-AXIS-00229", "110122", "G136"]),
    Note("P-AXIS-00229", "the feedforward manual prints 0 inside the range, the axis manual rejects it (110123)", "", &["P-AXIS-00228", "110123"]),
    Note("P-AXIS-00236", "500 is 0.05 mm; recommended: at least three times the lag at standstill; 0 becomes the default (110087), although the document gives a range from 0", "100", &["P-AXIS-00532", "70082", "G60"]),
    Note("P-AXIS-00255", "the documented way to enable feedforward in every program; a preset of G group 21 has no effect", "", &["P-CHAN-00063", "G135", "P-AXIS-00256"]),
    Note("P-AXIS-00256", "takes precedence over P-AXIS-00255 (K-0023)", "", &["P-AXIS-00255"]),
    Note("P-AXIS-00320", "DRIVE_DEFAULT: the drive closes the loop for SERCOS, PROFIdrive and CANopen, the CNC for all others. Improved Position Control then requires the additive velocity in the process data (K-0066), and dead band and speed limit of the CNC's controller have no effect; the loop of the drive is simulated with the control law of the CNC and kv. OPEN_POSITION_LOOP modes of spindles are simulated with a closed loop (K-0079), refused for other axes (70345)", "CNC_POSITION_CONTROL", &["P-AXIS-00020", "P-AXIS-00099", "P-AXIS-00395", "K-0066", "K-0079", "70345"]),
    Note("P-AXIS-00337", "expected lag from jerk: j Ta / Kv^2, the product (the manual prints a plus sign between j and Ta). One figure spells the key jerk_fact_nom", "", &["P-AXIS-00338"]),
    Note("P-AXIS-00357", "PT1 and PT2: at least one cycle; TIME_DELAY: below 6 cycles; outside: 50663. HSC: one to 200 cycles; below 50910, above 50911. LOWPASS, HIGHPASS, BANDPASS, BANDSTOP and ALLPASS do not use it", "5000", &["50663", "50910", "50911", "P-AXIS-00204"]),
    Note("P-AXIS-00389", "acts on the additive velocity (ADD_VEL) only", "1500", &["P-AXIS-00223", "70349", "K-0075"]),
    Note("P-AXIS-00390", "acts on the additive acceleration (ADD_ACC) only", "1500", &["P-AXIS-00223", "70348", "K-0075"]),
    Note("P-AXIS-00391", "a value ten thousand times too large is usually kg cm2 entered as kg m2 (K-0024)", "0.000048", &["P-AXIS-00392", "K-0024"]),
    Note("P-AXIS-00392", "0 gives no torque output", "0.45", &["P-AXIS-00325", "P-AXIS-00326"]),
    Note("P-AXIS-00395", "with 0 a speed command is always output; at most the exact-stop window (110528); only effective with position control in the CNC", "20", &["P-AXIS-00236", "P-AXIS-00320", "110528"]),
    Note("P-AXIS-00440", "raise it if a band-stop filter overshoots", "", &["50118", "P-AXIS-00439"]),
    Note("P-AXIS-00532", "recommended: 10000..200000 us; 0 off, below 0 P-AXIS-00151 is used", "200000", &["P-AXIS-00236", "P-AXIS-00151", "70082"]),
    Note("P-AXIS-00566", "with ACC or JERK in P-AXIS-00223: 110624", "", &["110624", "V_SATZ_ANZ"]),
    Note("P-AXIS-00568", "from a decay record: d = ln(A1/A2) of two successive maxima, damping = d / sqrt(d^2 + 4 pi^2). The command key is DAMPING", "", &["#VIB GUARD"]),
    Note("P-AXIS-00571", "1 to 3: unsymmetric, robustness and axis error grow; 4: symmetric, forward and backward paths are equal. The command key is MODE", "2", &["#VIB GUARD", "22062"]),
    Note("P-AXIS-00588", "acts from program start; the command #VIB GUARD has priority", "", &["#VIB GUARD"]),
    Note("P-AXIS-00589", "the command key is FREQ", "40", &["#VIB GUARD"]),
    Note("P-AXIS-00586", "FIR filters are recommended instead of HSC filters", "1", &["#FILTER"]),
    Note("P-AXIS-00736", "default 2 is valid with type PT2", "", &["P-AXIS-00738"]),
    Note("P-AXIS-00750", "the slope is 20 dB per decade and order; the default 0 is outside the range on purpose: no effect until it is set", "1", &["P-AXIS-00758", "K-0025"]),
    Note("P-AXIS-00752", "raise it step by step: a higher Q disturbs the loop less, a lower Q is more robust", "3", &["P-AXIS-00751"]),
    Note("P-AXIS-00751", "INDIRECT: set it slightly above the measured frequency, never below", "53", &["P-AXIS-00752"]),
    Note("P-AXIS-00753", "DIRECT uses the load encoder, INDIRECT the motor speed, SET_POINT the speed command", "DIRECT", &["P-AXIS-00756"]),
    Note("P-AXIS-00754", "raise the weight step by step until the result deteriorates again; weights above 7 are limited (K-0027)", "2", &["P-AXIS-00755", "70603", "K-0027"]),
    Note("P-AXIS-00755", "", "", &["P-AXIS-00754", "70604"]),
    Note("P-AXIS-00756", "lower damping gives a higher additive speed; not used by DIRECT. Builds from V3.1.3132.0 write stage[i].osc_damping", "0.2", &["P-AXIS-00850"]),
    Note("P-AXIS-00757", "0 suppresses the output (K-0026)", "100", &["P-AXIS-00212", "K-0026"]),
    Note("P-AXIS-00758", "set it in the gantry master, not in a slave (70600)", "", &["70600", "P-AXIS-00757"]),
    Note("P-AXIS-00850", "", "0.2", &[]),
    Note("P-CHAN-00035", "", "1", &[]),
    Note("P-CHAN-00036", "", "7", &[]),
    Note("P-CHAN-00063", "groups: 0 motion, 4 plane, 12 units, 14 dimension, 23 arc centre, 25 centre correction", "91", &["P-AXIS-00255"]),
    Note("P-CHAN-00071", "", "1", &["#SLOPE"]),
    Note("P-CHAN-00349", "1: a block shorter than its feed times the ramp times of a change of speed is planned together with the next ones, and then has the lowest limits of them all, also those of weights that are programmed behind it", "1", &["#SLOPE", "P-CHAN-00071"]),
    Note("P-CHAN-00439", "covers AX_DEV and PATH_DEV, only while G70 is active", "", &["#VIB GUARD", "#CONTOUR MODE", "G70"]),
    Note("P-STUP-00001", "", "1", &[]),
];

fn note(id: &str) -> Option<&'static Note> {
    NOTES.iter().find(|n| !id.is_empty() && n.0 == id)
}

/// Remarks on a parameter.
pub(super) fn of(id: &str) -> Vec<String> {
    note(id).map(|n| n.1).filter(|s| !s.is_empty()).map(str::to_owned).into_iter().collect()
}

/// Value of the example line.
pub(super) fn example(id: &str) -> Option<&'static str> {
    note(id).map(|n| n.2).filter(|s| !s.is_empty())
}

/// Related terms.
pub(super) fn related(id: &str) -> Vec<String> {
    note(id).map(|n| n.3).unwrap_or_default().iter().map(|s| (*s).to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::NOTES;
    use crate::explain::explain;
    use crate::machine::table;

    #[test]
    fn notes_belong_to_parameters_and_lead_to_things_that_exist() {
        for n in NOTES {
            assert!(table::by_id(n.0).is_some(), "{}", n.0);
            for thing in n.3 {
                assert!(explain(thing).is_ok(), "{} -> {thing}", n.0);
            }
        }
        assert!(NOTES.iter().enumerate().all(|(i, n)| NOTES[..i].iter().all(|m| m.0 != n.0)));
    }
}
