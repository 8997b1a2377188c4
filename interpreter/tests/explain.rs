//! Output of `explain`, compared with the parameter tables and remarks of the function manuals.

use kontur_interpreter::explain::{Kind, all, explain};
use kontur_interpreter::job::{Job, MachineLists};
use kontur_interpreter::source::MemorySources;
use std::sync::Arc;

/// Fails unless the explanation of `thing` contains each of `parts`.
#[track_caller]
fn says(thing: &str, parts: &[&str]) {
    let text = explain(thing).map_or_else(|near| panic!("{thing}: {near:?}"), |e| e.to_string());
    for part in parts {
        assert!(text.contains(part), "{thing} does not say `{part}`:\n{text}");
    }
}

/// Key, type, range, default and unit of a parameter.
#[track_caller]
fn is(id: &str, key: &str, kind: &str, range: &str, default: &str, unit: &str) {
    let e = explain(id).unwrap();
    let fact = |name: &str| {
        e.facts.iter().find(|(n, _)| *n == name).map(|(_, fact)| fact.clone()).unwrap_or_default()
    };
    assert_eq!(e.title, format!("{id}  {key}"));
    let is = ["type", "range", "default", "unit"].map(fact);
    assert_eq!(is, [kind, range, default, unit], "{id}");
}

const MAX: &str = "maximum of the type";

/// Axis filters, 2.3 and 3.1: prototypes, and which keys matter for which type.
/// Conformance: A002, A010, A085, A093.
#[test]
fn prototypes_and_keys_of_axis_filters() {
    says("filter[0].prototype", &["CRIT_DAMPING 1, BUTTERWORTH 2, BESSEL 3, HSC 5"]);
    says("filter[0].guete", &["for BANDPASS and BANDSTOP only"]);
    says(
        "filter[0].fg_f0",
        &[
            "LOWPASS (start of the stop band)",
            "HIGHPASS (start of the pass band)",
            "centre frequency of BANDPASS and BANDSTOP",
            "first natural frequency of HSC NoVib",
        ],
    );
}

/// Axis filters, 2.1: objects of the control before and after the filters.
/// Conformance: A014, A015.
#[test]
fn objects_of_the_control() {
    says(
        "Active position",
        &["before the axis filters", "0x121300", "0x61 + 0x10000", "SGN32", "0.1 um", "X_ipo_mm"],
    );
    says(
        "Ft_sollwert_gestern",
        &["after the axis filters", "0x121300", "0x1C + 0x10000", "SGN64", "X_set_mm"],
    );
}

/// Axis filters, 2.2: FIR instead of HSC. Conformance: A084.
#[test]
fn fir_is_recommended_instead_of_hsc() {
    for thing in ["#FILTER", "filter[0].prototype"] {
        says(thing, &["FIR filters are recommended instead of HSC", "V3.1.3075.02"]);
    }
}

/// Axis filters, 3.2 and 3.3.
/// Conformance: A090, A097, A105, A108, A110, A111, A112, A113, A114, A115, A120.
#[test]
fn table_of_axis_filters() {
    let below = "below 0.5 / cycle";
    is("P-AXIS-00319", "filter[i].enable", "BOOLEAN", "0 or 1", "0", "-");
    is("P-AXIS-00067", "filter[i].fg_f0", "REAL64", &format!("0 .. {below}"), "30", "Hz");
    is("P-AXIS-00080", "filter[i].guete", "REAL64", "1 .. 10", "1", "-");
    is("P-AXIS-00164", "filter[i].share_percent", "REAL64", "0 .. 100", "100", "%");
    says("P-AXIS-00140", &["UNS32", "default    0", "6 (LOWPASS, HIGHPASS, ALLPASS)", "200 (HSC)"]);
    says("P-AXIS-00153", &["default    CRIT_DAMPING", "names"]);
    says("P-AXIS-00204", &["1 .. 12", "7, 9 reserved"]);
    says("P-AXIS-00357", &["UNS32", "default    10000", "unit       us"]);
    for n in ["00067", "00080", "00140", "00153", "00164", "00204", "00319", "00357", "00735"] {
        says(&format!("P-AXIS-{n}"), &["axes       T, R, S", "unit"]);
    }
    let own = "lr_param.add_interface";
    says(&format!("{own}.enable"), &["switches the additional interface"]);
    is("P-AXIS-00735", &format!("{own}.filter[i].enable"), "BOOLEAN", "0 or 1", "0", "-");
    says(
        "P-AXIS-00736",
        &["default    2", "PT1, PT2, TIME_DELAY: any order above 0 switches the filter on"],
    );
    is("P-AXIS-00740", &format!("{own}.filter[i].guete"), "REAL64", "1 .. 10", "1", "-");
    says("P-AXIS-00737", &["default    CRIT_DAMPING", "axes       T ("]);
    says(
        "P-AXIS-00738",
        &["default    PT2", "LOWPASS 1", "TIME_DELAY 11", "HSC_SINE", "HSC_MEAN", "HSC_GAUSS"],
    );
    let range = format!("0 (excluded) .. {below}");
    is("P-AXIS-00739", &format!("{own}.filter[i].fg_f0"), "REAL64", &range, "30", "Hz");
    is("P-AXIS-00741", &format!("{own}.filter[i].share_percent"), "REAL64", "0 .. 100", "100", "%");
    says("P-AXIS-00741", &["axes       T ("]);
    says("P-AXIS-00742", &["default    0", "one cycle (PT1, PT2)", "below 6 cycles (TIME_DELAY)"]);
}

/// Improved Position Control, 4.2.
/// Conformance: I037, I038, I040, I047, I048, I049, I051, I052.
#[test]
fn table_of_improved_position_control() {
    let ipc = "lr_param.improved_position_control";
    let filter = |key: &str| format!("{ipc}.stage[i].filter[k].{key}");
    is("P-AXIS-00750", &filter("order"), "UNS32", "1 .. 3", "0", "-");
    says("P-AXIS-00750", &["20 dB per decade and order"]);
    is("P-AXIS-00751", &filter("fg_f0"), "REAL64", "0 (excluded) .. 500", "-1", "Hz");
    is("P-AXIS-00752", &filter("q_factor"), "REAL64", "1 .. 10", "-1", "-");
    says("P-AXIS-00752", &["Q = f0/bandwidth", "raise it step by step"]);
    is("P-AXIS-00758", &format!("{ipc}.enable"), "BOOLEAN", "0 or 1", "0", "-");
    let from_1 = format!("1 .. {MAX}");
    is("P-AXIS-00128", "getriebe[i].multi_gain_n", "UNS32", &from_1, "1", "-");
    is("P-AXIS-00129", "getriebe[i].multi_gain_z", "UNS32", &from_1, "2000", "bit");
    says("P-AXIS-00129", &["1 m/min (1000 deg/min)"]);
    let unit = "um (rotary axes and spindles 0.001deg)";
    is("P-AXIS-00205", "antr.v_reso_denom", "UNS32", &from_1, "36", unit);
    says("P-AXIS-00206", &["antr.v_reso_num", &format!("0 .. {MAX}"), "default    1"]);
    is("P-AXIS-00207", "antr.v_time_base", "UNS16", "0 .. 2", "0", "-");
    // as the documents print them
    for (printed, id) in [
        ("antr.v_time_bae", "P-AXIS-00207"),
        ("v_time_bae", "P-AXIS-00207"),
        ("stages[i].mode", "P-AXIS-00753"),
        ("filter.order", "P-AXIS-00750"),
        ("filter.q_factor", "P-AXIS-00752"),
        ("vorsteuer.jerk_fact_nom", "P-AXIS-00337"),
        ("jerk_fact_nom", "P-AXIS-00337"),
    ] {
        let found = explain(printed).unwrap_or_else(|e| panic!("{printed}: {e:?}"));
        assert!(found.title.starts_with(id), "{printed}: {}", found.title);
    }
    for n in 750..=758 {
        says(
            &format!("P-AXIS-00{n}"),
            &["SERCOS, Profidrive, CANopen; here for every simulated drive"],
        );
    }
}

/// Feedforward control, 2 to 4.
/// Conformance: F003, F017, F019, F020, F021, F044, F045.
#[test]
fn remarks_on_feedforward() {
    says("P-AXIS-00337", &["j Ta / Kv^2, the product"]);
    says("P-AXIS-00513", &["setpoint before the delay filter", "110583", "K-0075"]);
    says("P-AXIS-00223", &["XERR (signal 25)", "NSOLL_B (signal 7)", "0x100"]);
    says("getriebe[0].kv", &["S-0-0104"]);
    says("S-0-0296", &["SERCOS", "have their own feedforward"]);
    says("S-0-0348", &["SERCOS", "have their own feedforward"]);
    says("P-AXIS-00223", &["S-0-0296, S-0-0348"]);
    says("V_SATZ_ANZ", &["number of blocks buffered", "5 cycles"]);
    says("P-AXIS-00086", &["raise it for measuring moves"]);
}

/// Feedforward control, 5.2.
/// Conformance: F068, F069, F071, F072, F075, F076, F079, F081, F083, F084, F085.
#[test]
fn table_of_feedforward() {
    let (from_0, from_1) = (format!("0 .. {MAX}"), format!("1 .. {MAX}"));
    says("P-AXIS-00392", &["antr.acc_reference_value", "misprints the key as feed_const_denom"]);
    says("P-AXIS-00092", &["getriebe[i].incr_per_rev", "UNS32", &from_0, "default    1024"]);
    for n in ["00205", "00206", "00207"] {
        says(&format!("P-AXIS-{n}"), &["antr.v_"]);
    }
    says(
        "P-AXIS-00223",
        &[
            "default    NONE",
            "NONE 0x0, VEL 0x1, ACC 0x2, JERK 0x4, ADD_VEL 0x101, ADD_ACC 0x202, ADD_JERK 0x804",
        ],
    );
    is("P-AXIS-00225", "vorsteuer.vs_a_faktor", "SGN32", &from_0, "1", "us");
    says("P-AXIS-00226", &["vorsteuer.vs_a_nenner", "SGN32", "default    1", "110381"]);
    is("P-AXIS-00228", "vorsteuer.vs_v_faktor", "SGN32", &from_0, "1", "-");
    says("P-AXIS-00228", &["0 is a valid weight", "0.7..1"]);
    says("P-AXIS-00229", &["vorsteuer.vs_v_nenner", "SGN32", "default    1", "110123"]);
    is("P-AXIS-00325", "antr.torque_scale_num", "UNS32", &from_1, "1", "-");
    says("P-AXIS-00325", &["SERCOS, Lightbus, CANopen"]);
    is("P-AXIS-00337", "vorsteuer.jerk_fact_num", "UNS32", &from_0, "1", "-");
    says(
        "jerk_fact_nom",
        &["P-AXIS-00337", "vorsteuer.jerk_fact_num", "spells the key jerk_fact_nom"],
    );
    is("P-AXIS-00362", "antr.feed_const_num", "UNS32", &from_1, "1", "0.1um");
    is("P-AXIS-00363", "antr.feed_const_denom", "UNS32", &from_1, "1", "rev");
    for (id, key, drives) in [
        ("P-AXIS-00389", "vorsteuer.velocity_delay_time", "SERCOS, Profidrive, CANopen"),
        (
            "P-AXIS-00390",
            "vorsteuer.acceleration_delay_time",
            "SERCOS, Lightbus, Profidrive, CANopen",
        ),
    ] {
        says(id, &[key, "UNS16", "6 cycles (excluded)", "default    0", "unit       us", drives]);
    }
    let unit = "kg (rotary axes and spindles kg*m2)";
    is("P-AXIS-00391", "getriebe[i].load", "REAL64", &from_0, "0.000001", unit);
    says("P-AXIS-00391", &["at the motor shaft"]);
}

/// Position monitoring, 2 and 3.2. Conformance: P009, P016, P018.
#[test]
fn table_of_position_monitoring() {
    says("70082", &["P-AXIS-00236", "P-AXIS-00532", "window not reached in time"]);
    let unit = "0.1um (rotary axes and spindles 0.0001deg)";
    // the document prints a range from 0; the control replaces 0 by the default (110087)
    is("P-AXIS-00236", "getriebe[i].window", "SGN32", &format!("1 .. {MAX}"), "500", unit);
    says("P-AXIS-00236", &["500 is 0.05 mm", "three times the lag at standstill"]);
    let range = format!("minimum of the type .. {MAX}");
    is("P-AXIS-00532", "getriebe[i].position_settling_time", "SGN32", &range, "-1", "us");
    says("P-AXIS-00532", &["10000..200000 us", "below 0 P-AXIS-00151"]);
}

/// Vibration Guard, 4 and 6. Conformance: V038, V062, V063, V065, V066, V067.
#[test]
fn table_of_the_vibration_guard() {
    says("#VIB GUARD", &["independent of the FIR filter (#FILTER)", "broad band"]);
    says("#FILTER", &["Independent of the Vibration Guard (#VIB GUARD)", "broad band"]);
    says(
        "#VIB GUARD",
        &[
            "list vib_guard.mode",
            "(vib_guard.freq)",
            "(vib_guard.damping)",
            "vib_guard.active",
            "AX_DEV >= 0 mm, default 0 = no tolerance monitoring (no list key)",
            "ACC_FACT 1..10, default 1 (no list key)",
        ],
    );
    is("P-AXIS-00568", "vib_guard.damping", "REAL64", "0 .. 1", "0.1", "-");
    is("P-AXIS-00571", "vib_guard.mode", "UNS32", "1 .. 4", "1", "-");
    is("P-AXIS-00588", "vib_guard.active", "BOOLEAN", "0 or 1", "0", "-");
    says("P-AXIS-00588", &["from program start"]);
    is("P-AXIS-00589", "vib_guard.freq", "REAL64", &format!("1 .. {MAX}"), "30", "Hz");
    for n in ["00568", "00571", "00588", "00589"] {
        says(&format!("P-AXIS-{n}"), &["axes       T, R, S"]);
    }
}

/// System variables are explained with whatever axis, spindle or index they are written; one that does not exist is not.
#[test]
fn system_variables_have_a_meaning() {
    for (written, title) in [
        ("V.A.ABS.X", "V.A.ABS.X"),
        ("v.a.act_pos.y2", "V.A.ACT_POS.X"),
        ("V.G.NP[3].V.Z", "V.G.NP[i].V.X"),
        ("V.G.WZ_AKT.R", "V.G.WZ_AKT.R"),
        ("V.G.TIMER[7]", "V.G.TIMER[i]"),
        ("V.G.@P[1].VALID", "V.G.@P[i].VALID"),
        ("V.SPDL_PROG.SPEED.S2", "V.SPDL_PROG.SPEED.S"),
    ] {
        assert_eq!(explain(written).unwrap().title, title, "{written}");
    }
    assert!(explain("V.A.NOTHING.X").is_err());
}

/// Commands and functions about which there is nothing to say but how kontur treats them.
#[test]
fn commands_without_a_description_have_a_state() {
    says("#TRAFO ON", &["#TRAFO", "--identity-trafo"]);
    says("#GANTRY", &["refused"]);
    says("#CS DEF ACT", &["#CS DEF ACT", "refused"]);
    says("#MCS TO WCS", &["#MCS TO WCS", "refused"]);
    says("#CS DEF", &["defines a coordinate system"]);
    says("#MCS", &["#MCS"]);
    says("G141", &["contour masking", "refused"]);
    says("#SET DEC LR SOLL", &["kontur check"]);
    says("#ELSE", &["#IF"]);
    assert!(explain("#NOTHING").is_err() && explain("G999").is_err());
}

/// Blocks before and after the examples of commands that are part of a longer program.
const AROUND: [(&str, &str, &str); 24] = [
    ("$BREAK, $CONTINUE", "$WHILE 1", "$ENDWHILE"),
    ("$DO, $ENDDO", "P1=5\n$DO", ""),
    ("$FOR, $ENDFOR", "", "$ENDFOR"),
    ("$GOTO", "", "[END]"),
    ("$IF, $ELSEIF, $ELSE, $ENDIF", "#VAR\nV.L.N=1\n#ENDVAR", "$ENDIF"),
    ("$REPEAT, $UNTIL", "P1=5\n$REPEAT", ""),
    ("$SWITCH, $CASE, $DEFAULT, $ENDSWITCH", "P1=1", "$CASE 1\n$ENDSWITCH"),
    ("$WHILE, $ENDWHILE", "P1=0", "P1=5\n$ENDWHILE"),
    ("%, %L", "", "M29\n%MAIN"),
    ("#COMMENT", "", "#COMMENT END"),
    ("#CONTROL AREA BEGIN", "", "G01 X50 Y0 F1000\nY50\nX0\nX50 Y0\n#CONTROL AREA END"),
    ("#CS SET", "#CS ADD [WCS] [1,0,0,0,0,0]", ""),
    ("#CS SELECT", "#CS ADD [WCS] [1,0,0,0,0,0]", ""),
    ("#MSG", "P1=3", ""),
    ("#VAR, #ENDVAR, #DELETE", "#VAR\nV.P.NAME=1\n#ENDVAR", ""),
    ("EXIST, SIZEOF", "", "$ENDIF"),
    ("G05", "", "Y20\nX30"),
    ("G310", "#MEAS MODE [5]", ""),
    ("G33", "S500 M03", ""),
    ("L SEQUENCE", "N10 G04 1\nN50 G04 1", ""),
    ("L, LL, L CYCLE", "%L DRILL\nM29\n%MAIN", ""),
    ("M17, M29", "%L SUB", "%MAIN\nLL SUB\n[END]"),
    ("MACRO_CONTENT, MACRO_LENGTH", "\"NAME\" = \"X10\"", ""),
    ("MOD, AND, OR, XOR, NOT, INV", "P1=1\nP2=1", "$ENDIF"),
];

/// Examples for other machines than the built-in one or with files, and their errors here.
const NEEDS_MORE: [(&str, &[&str]); 11] = [
    ("#AX LINK", &["K-0137"]),
    ("#ENABLE AX LINK", &["K-0137"]),
    ("#ERROR", &["455"]),
    ("#IF, #ELSE, #ENDIF", &["21387", "K-0012"]),
    ("#MAIN SPINDLE", &["21306"]),
    ("#OTC", &["21391"]),
    ("#SET AX LINK", &["20797"]),
    ("@P1, @P", &["K-0013"]),
    ("G112", &["3210"]),
    ("G80, G81, G82, G83, G84, G85, G86, G87, G88, G89", &["20131"]),
    ("G96, G97", &["20634"]),
];

/// Every example is a block that runs, where it is not part of a longer program, as it is printed.
#[test]
fn examples_run_as_printed() {
    let (machine, _) = MachineLists::default().load().unwrap();
    let machine = Arc::new(machine);
    let mut wrong = Vec::new();
    let (mut around, mut needing) = (AROUND.to_vec(), NEEDS_MORE.to_vec());
    for e in all(Kind::Command) {
        let Some(example) = &e.example else { continue };
        let mut take = |title: &str| {
            around.iter().position(|(t, ..)| *t == title).map(|i| around.swap_remove(i))
        };
        let (_, before, after) = take(&e.title).unwrap_or_default();
        let place = needing.iter().position(|(t, _)| *t == e.title);
        let expected = place.map_or(&[][..], |i| needing.swap_remove(i).1);
        let text = format!("{before}\n{example}\n{after}\nM30\n");
        let sources = MemorySources::new().with("main.nc", text.clone());
        let checked = Job::new(Arc::clone(&machine), sources, "main.nc").check();
        let errors = checked.diagnostics.iter().filter(|d| d.is_error());
        let errors: Vec<String> = errors.map(|d| d.id.to_string()).collect();
        if errors != expected {
            wrong.push((e.title, text, errors));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(around.is_empty() && needing.is_empty(), "not explained: {around:?} {needing:?}");
}
