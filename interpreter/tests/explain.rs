//! Output of `explain`, compared with the function manuals (rows of `explain.txt`), and its examples.

use kontur_interpreter::explain::{Kind, all, explain};
use kontur_interpreter::job::{Job, MachineLists};
use kontur_interpreter::source::MemorySources;
use std::sync::Arc;

/// What a row states and the explanation does not say.
fn missing(row: &str) -> Vec<String> {
    if let Some((id, parameter)) = row.split_once(" = ").filter(|(id, _)| !id.contains(": ")) {
        let e = explain(id).unwrap();
        let fact = |name| e.facts.iter().find(|(n, _)| *n == name).map(|(_, fact)| &**fact);
        let facts = ["type", "range", "default", "unit"].map(|name| fact(name).unwrap_or_default());
        let found = [&*e.title.replacen(&format!("{id}  "), "", 1), &facts.join(" ¦ ")].join(" ¦ ");
        return if found == parameter { vec![] } else { vec![found] };
    }
    let (things, parts) = row.split_once(": ").unwrap();
    let mut missing = Vec::new();
    for thing in things.split(", ") {
        let text =
            explain(thing).map_or_else(|near| format!("unknown: {near:?}"), |e| e.to_string());
        let absent = parts.split(" ¦ ").filter(|part| !text.contains(part));
        missing.extend(absent.map(|part| format!("{thing} does not say `{part}`:\n{text}")));
    }
    missing
}

#[test]
fn explanations_say_what_the_manuals_say() {
    let rows = include_str!("explain.txt").lines();
    let rows = rows.filter(|row| !row.is_empty() && !row.starts_with("# "));
    let wrong: Vec<String> = rows.flat_map(missing).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for unknown in ["V.A.NOTHING.X", "#NOTHING", "G999"] {
        assert!(explain(unknown).is_err(), "{unknown}");
    }
    assert!(!missing("#MCS: said nowhere").is_empty() && !missing("#NOTHING: x").is_empty());
    assert!(!missing("P-AXIS-00571 = vib_guard.mode ¦ UNS32 ¦ 1 .. 4 ¦ 2 ¦ -").is_empty());
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
const NEEDS_MORE: [(&str, &[&str]); 12] = [
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
    ("G800 .. G839", &["20131"]),
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
