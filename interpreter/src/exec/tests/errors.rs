//! Error IDs with their positions, the syntax check, and the example programs of the language chapter.

use super::{assert_near, checked, places, run};

#[test]
fn the_check_stops_after_twenty_errors() {
    let text: Vec<String> = (0..40).map(|i| format!("N{i} #FOO")).collect();
    let text = text.join("\n");
    let found = checked(&text);
    assert_eq!(found.iter().filter(|d| d.is_error()).count(), 20);
    assert_eq!(found.last().map(|d| d.id.to_string()).as_deref(), Some("K-0116"));
}

/// The search for the intended command would otherwise take 20 us in each of half a million passes.
#[test]
fn the_check_stops_where_a_loop_repeats_an_error() {
    let found = checked("$WHILE 1\n#FOO\n$ENDWHILE\nM30\n");
    assert_eq!(places(&found)[0].split(' ').next_back(), Some("2:1"));
    assert_eq!(found.len(), 2);
    assert!(found[1].text.contains("10000 times"), "{}", found[1].text);
    // a warning may occur as often as the program raises it
    let warned = "P1=0\n$WHILE P1<20000\nP1=P1+1\nG301 I1\n$ENDWHILE\n#FOO\nM30\n";
    assert_eq!(checked(warned).len(), 2);
}

#[test]
fn the_check_moves_nothing_and_ends() {
    assert!(checked("P1=0\n$WHILE P1<3\nP1=P1+1\nX P1 F100\n$ENDWHILE\n#TIME 5\nM30\n").is_empty());
    // a condition with an error counts as false
    assert_eq!(
        places(&checked("$WHILE P9\nX1\n$ENDWHILE\n$DO\n$ENDDO P9\nM30\n")),
        ["20925 1:8", "20925 5:8"]
    );
}

/// The program of the language chapter that uses the most words.
#[test]
fn squares() {
    let text = include_str!("../../../tests/data/squares.nc");
    let run = run(text);
    let bad: Vec<_> = run.diagnostics.iter().filter(|d| d.is_error()).collect();
    assert!(bad.is_empty(), "{bad:?}");
    assert_near(&run.end, &[0.0, 0.0, 5.0]);
    let ends = run.ends();
    // per pass: Z0, (0,20), (20,20), (20,0), (0,0) on the arc
    let pass: Vec<&Vec<f64>> = ends[1..6].iter().collect();
    assert_near(pass[0], &[0.0, 0.0, 0.0]);
    assert_near(pass[1], &[0.0, 20.0, 0.0]);
    assert_near(pass[2], &[20.0, 20.0, 0.0]);
    assert_near(pass[3], &[20.0, 0.0, 0.0]);
    assert_near(pass[4], &[0.0, 0.0, 0.0]);
    let length = run.blocks()[5].path.length();
    assert!((length - 21.891830).abs() < 1e-6);
    assert_eq!(
        run.messages(),
        [
            "run 1 of 3, F = 1000.000000",
            "run 2 of 3, F = 2000.000000",
            "run 3 of 3, F = 3000.000000"
        ]
    );
}

#[test]
fn what_does_not_run_is_checked_for_its_syntax() {
    // block numbers and control statements as errors, the rest as warnings; #IF and #COMMENT are not affected
    let text = "$IF 0\nX!\n$IF (\nX1\n$ENDIF\n$ELSE\nX1 F100\n$ENDIF\n$FOR P1=2,1,1\nG01 X[1\n$ENDFOR\n$SWITCH 1\n$CASE 2\n#VAR\nV.P.A : UNS32 = 5\n V.P.B :: 4\n#ENDVAR\n$ENDSWITCH\n$GOTO N7\nY?\nN7: X2\n#IF 0\nX!\n#ENDIF\n#COMMENT BEGIN\nX!\n#COMMENT END\nM30\nX!\n";
    let found = checked(text);
    let lines: Vec<_> = found
        .iter()
        .map(|d| (d.id.to_string(), d.source.as_ref().map_or(0, |s| s.line), d.is_error()))
        .collect();
    let mut unreached: Vec<_> =
        lines.iter().filter(|(id, _, _)| id == "K-0118").map(|(_, l, _)| *l).collect();
    unreached.dedup();
    assert_eq!(unreached, [2, 10, 16, 20], "{lines:?}");
    assert!(
        lines.iter().any(|(id, line, error)| id != "K-0118" && *line == 3 && *error),
        "{lines:?}"
    );
    assert_eq!(lines.iter().filter(|(_, _, error)| *error).count(), 1, "{lines:?}");
    // a subroutine that is never called
    let found = checked("%L A\nX!\n%MAIN\nX1 F100\nM30\n");
    assert!(places(&found)[0].starts_with("K-0118 2:") && found.iter().all(|d| !d.is_error()));
    // executed in one pass, skipped in another: examined once
    let text = "$FOR P1=1,2,1\n$IF P1==1\nX P1 F100\n$ELSE\nY1\n$ENDIF\n$ENDFOR\nM30\n";
    assert!(checked(text).is_empty());
}

/// A mistyped name of `--external` would otherwise select the other branch without a message.
#[test]
fn external_variables_without_use_are_named() {
    use super::{machine, run_with};
    use crate::exec::{Access, External, Options, Value};
    use crate::source::MemorySources;
    let external = |name: &str| {
        let variable = External { value: Value::Number(3.0), access: Access::ReadOnly };
        (name.to_owned(), variable)
    };
    let said = |text: &'static str| {
        let external = ["LIMT", "USED"].map(external).into();
        let options = Options { external, ..Options::default() };
        let run = run_with(MemorySources::new().with("main.nc", text), machine(&[]), options);
        run.diagnostics.iter().map(|d| (d.text.clone(), d.hint.clone())).collect::<Vec<_>>()
    };
    let text = "$IF EXIST[V.E.LIMIT]\nX V.E.USED F100\n$ENDIF\nP1=V.E.USED\nM30\n";
    let said = said(text);
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].0.starts_with("V.E.LIMT "), "{said:?}");
    assert!(said[0].1.as_ref().is_some_and(|hint| hint.contains("LIMIT")), "{said:?}");
}

/// Access rights of external variables: 20097 and 20100.
#[test]
fn external_variables_keep_their_rights() {
    use crate::exec::{Access, External, Options, Value};
    let variable = |access| External { value: Value::Number(2.0), access };
    let external = [("R", Access::ReadOnly), ("W", Access::WriteOnly), ("B", Access::ReadWrite)];
    let external = external.map(|(name, access)| (name.to_owned(), variable(access)));
    let places = |text: &str| {
        let options = Options { external: external.clone().into(), ..Options::default() };
        let sources = crate::source::MemorySources::new().with("main.nc", text.to_owned());
        let found = super::run_with(sources, super::machine(&[]), options).diagnostics;
        places(&found.into_iter().filter(crate::diag::Diagnostic::is_error).collect::<Vec<_>>())
    };
    assert_eq!(places("V.E.W=1\nV.E.B=V.E.R\nX V.E.B F100\nM30\n"), [""; 0]);
    assert_eq!(places("X V.E.W F100\nM30\n"), ["20097 1:3"]);
    assert_eq!(places("V.E.R=1\nM30\n"), ["20100 1:1"]);
}

#[test]
fn what_does_not_exist_is_not_changed() {
    for text in ["P7 += 1\nM30\n", "V.P.NEW += 1\nM30\n", "V.G.T_AKT += 1\nM30\n"] {
        assert!(!run(text).diagnostics.is_empty(), "{text}");
        assert_eq!(super::ids(&checked(text)).is_empty(), run(text).ids().is_empty(), "{text}");
    }
}
