//! Returns to another level or to a place of it: `M17 [..]`, `M29 [..]`.

use super::{assert_end, clean, places, run};

/// Two levels above the main program; `back` ends the deeper one.
fn nested(back: &str) -> String {
    format!(
        "%L DEEP\nX1\n{back}\nX99\n%L MID\nG91 Z1\nG90 LL DEEP\nX50\nN7 Y1\n[OWN] M17\n\
         %MAIN\nF1000 LL MID\nX60\nN40 [AFTER] Y5\nN50 Y6\nN60: Y7\nM30\n"
    )
}

#[track_caller]
fn ends(back: &str, expected: &[[f64; 3]]) {
    assert_eq!(clean(&nested(back)).ends(), expected, "{back}");
}

#[test]
fn the_level_is_that_of_the_call_unless_the_return_says_otherwise() {
    let deep = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]];
    let main = |x: f64| [[x, 5.0, 1.0], [x, 6.0, 1.0], [x, 7.0, 1.0]];
    let mid = [[50.0, 0.0, 1.0], [50.0, 1.0, 1.0]];
    let at_60 = [[60.0, 0.0, 1.0]];
    for back in ["M17", "M17 []", "M29 [JUMPS=1]"] {
        ends(back, &[&deep[..], &mid, &[[60.0, 1.0, 1.0]], &main(60.0)].concat());
    }
    for back in ["M17 [MAIN]", "M29[ main ]", "M017 [JUMPS=2]", "P1=2 M17 [JUMPS=P1]"] {
        ends(back, &[&deep[..], &at_60, &main(60.0)].concat());
    }
}

#[test]
fn a_return_leads_to_a_label_or_a_block() {
    let deep = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]];
    let tail = |from: usize| &[[1.0, 5.0, 1.0], [1.0, 6.0, 1.0], [1.0, 7.0, 1.0]][from..];
    for back in
        ["M17 [MAIN [AFTER]]", "M29 [JUMPS=2 [after]]", "M17 [MAIN N40]", "M17[JUMPS=2 NP9]"]
    {
        ends(&format!("P9=40 {back}"), &[&deep[..], tail(0)].concat());
    }
    ends("M17 [MAIN N50]", &[&deep[..], tail(1)].concat());
    ends("M17 [MAIN N60]", &[&deep[..], tail(2)].concat());
    // within the level of the call
    ends(
        "M17 [N7]",
        &[
            &deep[..],
            &[[1.0, 1.0, 1.0], [60.0, 1.0, 1.0]],
            &[[60.0, 5.0, 1.0], [60.0, 6.0, 1.0], [60.0, 7.0, 1.0]],
        ]
        .concat(),
    );
    ends(
        "M17 [[OWN]]",
        &[&deep[..], &[[60.0, 0.0, 1.0]], &[[60.0, 5.0, 1.0], [60.0, 6.0, 1.0], [60.0, 7.0, 1.0]]]
            .concat(),
    );
}

#[test]
fn a_label_goes_before_a_block_with_its_number() {
    let sub = "%L S\nM17 [N5]\n%MAIN\nF1000 LL S\nN5 X1\nN5: X2\nM30\n";
    assert_eq!(clean(sub).ends(), [[2.0, 0.0, 0.0]]);
}

#[test]
fn backwards_and_out_of_loops() {
    // the loop of the main program is left, the subroutine runs three times
    let text = "%L S\nP1=P1+1 G91 X1\nG90\n$IF P1<3\nM17 [MAIN N20]\n$ENDIF\nM17 [[OUT]]\n\
                %MAIN\nP1=0 F1000\nN20 Y=P1\n$WHILE 1\nLL S\nX99\n$ENDWHILE\n[OUT] Z1\nM30\n";
    let run = clean(text);
    assert_eq!(run.end, [3.0, 2.0, 1.0]);
    assert!(run.ends().iter().all(|end| end[0] < 4.0));
}

#[test]
fn a_loop_of_the_level_stays_open_if_the_place_is_inside_it() {
    let text =
        "%L S\nM17 [N30]\n%MAIN\nF1000\n$FOR P1=1,3,1\nLL S\nX99\nN30 G91 Y1\nG90\n$ENDFOR\nM30\n";
    assert_end(text, [0.0, 3.0, 0.0]);
}

#[test]
fn a_branch_of_if_may_be_entered_and_a_loop_not() {
    let text = |body: &str| format!("%L S\nM17 [N30]\n%MAIN\nF1000 LL S\n{body}\nM30\n");
    assert_eq!(
        clean(&text("$IF 0\nX1\nN30 X2\n$ELSE\nX3\n$ENDIF\nY1")).ends(),
        [[2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]
    );
    for (body, id) in [
        ("$WHILE 0\nN30 X2\n$ENDWHILE", "21480 2:6"),
        ("$WHILE 0\n$IF 1\nX1\n$ENDIF\nN30 X2\n$ENDWHILE", "21480 2:6"),
        ("$SWITCH 1\n$CASE 2\nN30 X2\n$ENDSWITCH", "K-0016 2:6"),
        ("#COMMENT BEGIN\nN30 X2\n#COMMENT END", "K-0015 2:6"),
    ] {
        assert_eq!(places(&run(&text(body)).diagnostics), [id], "{body}");
    }
    // the block lies after what is closed before it
    assert_end(&text("$WHILE 0\nX1\n$ENDWHILE\nN30 X2"), [2.0, 0.0, 0.0]);
    assert_end(&text("#COMMENT BEGIN\n#COMMENT END\nN30 X2"), [2.0, 0.0, 0.0]);
}

#[test]
fn variables_of_the_levels_left_are_gone() {
    let text = "%L DEEP\nM17 [MAIN N9]\n%L MID\n#VAR\nV.L.A=1\n#ENDVAR\nLL DEEP\nM17\n\
                %MAIN\nF1000 LL MID\nN9 X=V.L.A\nM30\n";
    assert_eq!(places(&run(text).diagnostics), ["K-0012 11:6"]);
}

#[test]
fn more_levels_than_there_are_lead_to_the_main_program_with_a_warning() {
    let run = run(&nested("M17 [JUMPS=7 N50]"));
    assert_eq!(places(&run.diagnostics), ["K-0109 3:12"]);
    assert!(!run.diagnostics[0].is_error());
    assert_eq!(run.end, [1.0, 7.0, 1.0]);
}

#[test]
fn faults() {
    for (back, id) in [
        ("M17 [JUMPS=0]", "K-0009 3:12"),
        ("M17 [JUMPS=1.5]", "K-0009 3:12"),
        ("M17 [MAIN N41]", "K-0015 3:11"),
        ("M17 [MAIN [OWN]]", "K-0015 3:11"),
        ("M17 [AFTER]", "K-0002 3:6"),
        ("M17 [MAIN JUMPS=1]", "K-0002 3:11"),
        ("M17 M17 [MAIN]", "20765 3:5"),
    ] {
        assert_eq!(places(&run(&nested(back)).diagnostics), [id], "{back}");
    }
    assert_eq!(places(&run("X1 F100\nM17 [MAIN]\n").diagnostics), ["K-0002 2:1"]);
}
