//! Subroutines, cycles and ends of programs.

use super::{EndReason, Event, Options, Run, assert_end, clean, machine, run, run_with};
use crate::source::MemorySources;
use kontur_kit::Random;

fn with(main: &str, name: &str, sub: &str) -> Run {
    let sources = MemorySources::new().with("main.nc", main).with(name, sub);
    run_with(sources, machine(&[]), Options::default())
}

#[test]
fn a_local_subroutine_of_another_name() {
    let run = super::run("%L SIDE\nX1\n%MAIN\nLL SIDES\nM30\n");
    assert_eq!(run.ids(), ["K-0014"]);
    assert!(run.diagnostics[0].hint.as_deref().unwrap().contains("SIDE"));
}

#[test]
fn global_subroutines() {
    let run = with("P1=4\nL sub.nc\nX P2 F100\nM30\n", "sub.nc", "P2=P1*2\nM17\n");
    assert_eq!(run.end, [8.0, 0.0, 0.0]);
    assert!(run.diagnostics.is_empty());
    let run = with("L4712\nM30\n", "4712", "X1 F100\nM29\n");
    assert_eq!(run.end, [1.0, 0.0, 0.0]);
    let run = with("L ../../x.nc\nM30\n", "y.nc", "");
    assert_eq!(run.ids(), ["K-0013"]);
    assert_eq!(run.diagnostics[0].source.as_ref().map(|s| (s.line, s.column)), Some((1, 3)));
}

#[test]
fn local_variables_live_as_long_as_their_level() {
    let run = run(
        "%L A\n#VAR\nV.L.X = 5\n#ENDVAR\nP1 = V.L.X + V.L.Y\n%MAIN\n#VAR\nV.L.Y = 1\n#ENDVAR\nLL A\nP2 = V.L.X\nM30\n",
    );
    assert_eq!(super::places(&run.diagnostics), ["K-0012 11:6"]);
}

#[test]
fn cycles_have_parameters_of_their_own() {
    let cycle = "P1 = 99\nG91 X @P1 Y[@P2*2] F100\n$IF V.G.@P[3].VALID\nZ9\n$ENDIF\n";
    let run = with("P1=1 F100\nL CYCLE [NAME=c.nc @P1=3 @P2=P1+1]\nX P1\nM30\n", "c.nc", cycle);
    assert!(run.diagnostics.is_empty(), "{:?}", super::shown(&run.diagnostics));
    // G90 is back, P1 is the caller's
    assert_eq!(run.end, [1.0, 4.0, 0.0]);
    let run = with("L CYCLE [NAME=c.nc @P1=3 \\\n; the depth\n @P1=4]\nM30\n", "c.nc", "M17\n");
    assert_eq!(run.ids(), ["21379"]);
    // reading creates what was not passed, and says so once (818650763)
    let run = with("L CYCLE [NAME=c.nc]\nM30\n", "c.nc", "X[@P1+2] F100\nX[3*@P1+3]\n");
    assert_eq!((run.ids(), run.end[0]), (vec!["K-0109".to_owned()], 3.0));
    let run = with("L CYCLE [NAME=c.nc]\nM30\n", "c.nc", "X @I F100\n");
    assert_eq!(run.ids(), ["K-0012"]);
}

#[test]
fn implicit_calls() {
    let run = with(
        "#FILE NAME [G80=\"c.nc\"]\nG80 [1, , 3]\nM30\n",
        "c.nc",
        "X @P1 Z @P3 F100\n$IF V.G.@P[2].VALID == 0\nY1\n$ENDIF\n",
    );
    assert!(run.diagnostics.is_empty(), "{:?}", super::shown(&run.diagnostics));
    assert_eq!(run.end, [1.0, 1.0, 3.0]);
    assert_eq!(super::run("G80 [1]\nM30\n").ids(), ["20131"]);
}

#[test]
fn modal_cycles_follow_motions() {
    let run = with(
        "L CYCLE [NAME=c.nc MODAL_MOVE]\nX1 F100\nP1=1\nX2\n#DISABLE MODAL CYCLE\nX3\nM30\n",
        "c.nc",
        "G91 Z1\n",
    );
    assert!(run.diagnostics.is_empty(), "{:?}", super::shown(&run.diagnostics));
    // at the call, and after X1 and X2
    assert_eq!(run.end, [3.0, 0.0, 3.0]);
}

#[test]
fn ends_of_programs() {
    assert_eq!(run("X1 F100\n").ids(), ["K-0003"]);
    assert_eq!(run("X1 F100\n").reason(), EndReason::Finished);
    assert_end("X1 F100\nM30\nX!! this is not looked at", [1.0, 0.0, 0.0]);
    assert_eq!(clean("X1 F100\nM29\n").end[0], 1.0);
    assert_eq!(run("%L A\nM30\n%MAIN\nLL A\nX1 F100\nM30\n").ids(), ["K-0109"]);
    assert_eq!(run("#FOO\nX1 F100\n").reason(), EndReason::Aborted);
    assert_eq!(run("").ids(), ["K-0003"]);
}

#[test]
fn jumps_stay_within_their_program() {
    let run = run("%L A\nN5: X1 F100\n%MAIN\nLL A\n$GOTO N5\nM30\n");
    assert_eq!(super::places(&run.diagnostics), ["K-0015 5:7"]);
}

fn listed(settings: &[&str], files: &[(&str, &str)]) -> Run {
    let sources = files.iter().fold(MemorySources::new(), |s, (name, text)| s.with(name, *text));
    run_with(sources, machine(settings), Options::default())
}

#[test]
fn a_program_of_the_list_runs_before_every_program() {
    let main = ("main.nc", "X P1 F100\nM30\n");
    let start = ["channel.start_init_prog_file=init.nc"];
    let run = listed(&start, &[main, ("init.nc", "P1=7 G91 Z1 F50\nM17\n")]);
    assert!(run.diagnostics.is_empty(), "{:?}", super::shown(&run.diagnostics));
    // its modal state continues: G91 holds in the main program
    assert_eq!(run.ends(), [[0.0, 0.0, 1.0], [7.0, 0.0, 1.0]]);
    // a list may name a program that lies on the control alone
    let run = listed(&start, &[("main.nc", "X2 F100\nM30\n")]);
    assert_eq!((run.ids(), run.ends()), (vec!["K-0013".to_owned()], vec![vec![2.0, 0.0, 0.0]]));
    assert_eq!(run.diagnostics[0].parameter, Some("P-CHAN-00119"));
    assert!(!run.diagnostics[0].is_error() && run.diagnostics[0].hint.is_some());
    // one that is there and is not a program stays an error
    let run = listed(&start, &[main, ("init.nc", "%L ONLY\nM17\n")]);
    assert_eq!((run.ids(), run.blocks().len()), (vec!["K-0014".to_owned()], 0));
}

#[test]
fn a_program_of_the_list_runs_before_every_end() {
    let end = ["channel.final_prog_file=final.nc"];
    let last = ("final.nc", "G90 Z9 F50\n");
    let ends = |main: &str| listed(&end, &[("main.nc", main), last]).ends();
    assert_eq!(ends("X1 F100\nM30\n"), [[1.0, 0.0, 0.0], [1.0, 0.0, 9.0]]);
    assert_eq!(ends("X1 F100\nM29\n").len(), 2);
    assert_eq!(
        ends("%L A\nX2 F100 M30\n%MAIN\nLL A\nX3\nM30\n"),
        [[2.0, 0.0, 0.0], [2.0, 0.0, 9.0]]
    );
    // without M30 it runs too, and the missing end is told once
    let run = listed(&end, &[("main.nc", "$IF 1\nX1 F100\n$ENDIF\n"), last]);
    assert_eq!((run.ids(), run.ends().len()), (vec!["K-0003".to_owned()], 2));
    // an M30 of its own ends it
    let run = listed(&end, &[("main.nc", "X1 F100\nM30\n"), ("final.nc", "Z9\nM30\nZ10\n")]);
    assert_eq!((run.ids(), run.end), (vec!["K-0109".to_owned()], vec![1.0, 0.0, 9.0]));
    let run = listed(&end, &[("main.nc", "X1 F100\nM30\n")]);
    assert_eq!((run.ids(), run.reason()), (vec!["K-0013".to_owned()], EndReason::Aborted));
    assert_eq!(run.diagnostics[0].parameter, Some("P-CHAN-00252"));
}

#[test]
fn m06_calls_the_tool_change_program_at_the_end_of_its_block() {
    let change = ["channel.m6_prog_file=change.nc"];
    let sub = ("change.nc", "Z50 F200\nM17\n");
    let run = listed(&change, &[("main.nc", "X5 M6 T3 F100\nY1\nM30\n"), sub]);
    assert_eq!(run.ends(), [[5.0, 0.0, 0.0], [5.0, 0.0, 50.0], [5.0, 1.0, 50.0]]);
    assert!(!run.events().iter().any(|e| matches!(e, Event::MFunction { number: 6, .. })));
    // the program may name another one
    let main = ("main.nc", "#FILE NAME [M6=\"other.nc\"]\nM06\nM30\n");
    let run = listed(&change, &[main, sub, ("other.nc", "Z3 F100\n")]);
    assert_eq!(run.end[2], 3.0);
    let run = listed(&[], &[("main.nc", "M6\nM30\n")]);
    assert!(run.events().iter().any(|e| matches!(e, Event::MFunction { number: 6, .. })));
    let run = listed(&change, &[("main.nc", "M6 LL A\nM30\n"), sub]);
    assert_eq!(super::places(&run.diagnostics)[0], "22008 1:1");
}

#[test]
fn conditions_of_a_block_that_changes_the_level_stand_in_its_file() {
    let place = |run: &Run| {
        let place = run.diagnostics[0].source.as_ref().unwrap();
        (place.file.to_string(), place.line)
    };
    let run = with("X1 F100\nI5 L sub.nc\nM30\n", "sub.nc", "Y1\n\n\nI5 M17\n");
    assert_eq!(run.ids(), ["K-0109", "K-0109"]);
    assert_eq!(place(&run), ("main.nc".to_owned(), 2));
    assert_eq!(run.diagnostics[1].source.as_ref().map(|s| (&*s.file, s.line)), Some(("sub.nc", 4)));
}

#[test]
fn calls_without_a_blank() {
    // TF5200 programming manual, global subroutines and parametric calls: `LM06`, `L"name"`, `LV.E.x`
    let sub = "X1 F100\nM17\n";
    assert_eq!(with("LM06\nM30\n", "M06", sub).end[0], 1.0);
    assert_eq!(with("N10 LM06.nc\nM30\n", "M06.nc", sub).end[0], 1.0);
    assert_eq!(with("L\"sub.nc\"\nM30\n", "sub.nc", sub).end[0], 1.0);
    assert_eq!(with("\"TOOL\" = \"sub.nc\"\nL\"TOOL\"\nM30\n", "sub.nc", sub).end[0], 1.0);
    assert_eq!(with("LCYCLE [NAME=sub.nc]\nM30\n", "sub.nc", sub).end[0], 1.0);
    assert_eq!(with("L CYCLE[NAME=sub.nc]\nM30\n", "sub.nc", sub).end[0], 1.0);
    // without a blank after LL the call is global
    assert_eq!(with("LLOCAL\nM30\n", "LOCAL", sub).end[0], 1.0);
    for call in ["LV.E.NAME", "L V.E.NAME"] {
        let run = with(&format!("V.E.NAME = \"sub.nc\"\n{call}\nM30\n"), "sub.nc", sub);
        assert_eq!((run.ids(), run.end[0]), (vec!["K-0110".to_owned()], 1.0), "{call}");
    }
    let run =
        run("%L UP\nX1 F100\n%MAIN\nV.E.NAME = \"UP\"\nLL V.E.NAME\nV.E.N = 5\nL V.E.N\nM30\n");
    assert_eq!(
        (run.ids(), run.end[0]),
        (["K-0110", "K-0110", "K-0002"].map(str::to_owned).to_vec(), 1.0)
    );
}

#[test]
fn a_missing_cycle_of_the_vendor_is_told_as_one() {
    let run = run("L CYCLE [NAME=SysDrill1.ecy @P1=2 \\\n@P2=-10]\nM30\n");
    assert_eq!(run.ids(), ["K-0013"]);
    let hint = run.diagnostics[0].hint.clone().unwrap_or_default();
    assert!(hint.contains("vendor's library") && hint.contains("searched"), "{hint}");
}

#[test]
fn words_of_cycles_are_those_of_the_plane() {
    let cycle = "@P1=@P1*2\nG01 @X=@P1 @Y=2 @Z=-3 F100\nM17\n";
    let end = |plane: &str| {
        let run = with(&format!("{plane}\nL CYCLE [NAME=c.nc @P1=5]\nM30\n"), "c.nc", cycle);
        assert!(run.diagnostics.is_empty(), "{:?}", super::shown(&run.diagnostics));
        run.end
    };
    assert_eq!(end("G17"), [10.0, 2.0, -3.0]);
    // first axis Z, second X, and Y stands on the plane
    assert_eq!(end("G18"), [2.0, -3.0, 10.0]);
    assert_eq!(end("G19"), [-3.0, 10.0, 2.0]);
    // a half circle about the middle of its chord, in every plane
    let arc = "G02 @X=10 @I=5 F100\nM17\n";
    for (plane, wanted) in [("G17", 0), ("G18", 2), ("G19", 1)] {
        let run = with(&format!("{plane}\nL CYCLE [NAME=c.nc]\nM30\n"), "c.nc", arc);
        assert!(run.diagnostics.is_empty(), "{:?}", super::shown(&run.diagnostics));
        let length = run.blocks()[0].path.length();
        assert!((length - 5.0 * std::f64::consts::PI).abs() < 1e-9, "{plane}: {length}");
        assert_eq!(run.end[wanted], 10.0);
    }
    let run = with("L CYCLE [NAME=c.nc]\nM30\n", "c.nc", "@S=1200 M3\nG04 0.1\nM5\nM17\n");
    assert_eq!(run.ids(), [""; 0]);
    let turns = |e: &&Event| format!("{e:?}").contains("rpm: 1200.0");
    assert!(run.events().iter().any(turns), "{:?}", run.events());
}

#[test]
fn a_cycle_calls_the_cycle_that_a_parameter_names() {
    let sources = MemorySources::new()
        .with("main.nc", "L CYCLE [NAME=outer.nc @P1=\"inner.nc\" @P2=4]\nM30\n")
        .with("outer.nc", "L CYCLE [NAME=@P1 @P1=@P2+1]\nM17\n")
        .with("inner.nc", "@X=@P1 F100\nM17\n");
    let run = run_with(sources, machine(&[]), Options::default());
    assert_eq!((run.ids(), run.end[0]), (vec![], 5.0));
}

#[test]
fn cycle_variables_are_seen_from_their_level_downwards() {
    // validity and visibility of V.CYC: main programs may declare them, the most local one counts
    let sources = MemorySources::new()
        .with(
            "main.nc",
            "#VAR\nV.CYC.A = 1\n#ENDVAR\nL CYCLE [NAME=c.nc]\nX V.CYC.A F100\nP1 = EXIST[V.CYC.B]\nY P1\nM30\n",
        )
        .with("c.nc", "Z V.CYC.A F100\n#VAR\nV.CYC.A = 7\nV.CYC.B = 2\n#ENDVAR\nL deeper.nc\nM17\n")
        .with("deeper.nc", "G91 Z[V.CYC.A + V.CYC.B]\nG90\nM17\n");
    let run = run_with(sources, machine(&[]), Options::default());
    assert_eq!((run.ids(), run.end), (vec![], vec![1.0, 0.0, 10.0]));
}

#[test]
fn other_capital_letters_than_the_files_get_a_note() {
    /// Finds files whatever the case of their letters, as some file systems do.
    struct Lenient(MemorySources);
    impl crate::source::Sources for Lenient {
        fn open(
            &self,
            name: &str,
            caller: Option<&str>,
        ) -> Result<Box<dyn crate::source::Source>, crate::source::OpenError> {
            self.0.open(if caller.is_some() { "Sub.nc" } else { name }, caller)
        }
    }
    let sources =
        MemorySources::new().with("main.nc", "L SUB.NC\nM30\n").with("Sub.nc", "X1 F100\nM17\n");
    let run = run_with(Lenient(sources), machine(&[]), Options::default());
    assert_eq!((run.ids(), run.end[0]), (vec!["K-0109".to_owned()], 1.0));
}

/// A sequence of blocks of another program. Those of the same one are programs of the suite.
#[test]
fn block_sequences_of_another_file() {
    let sub = "X100\nN5 X1\nN6 Y2\nN7 Z3\nM17\n";
    let run = with("G01 F1000\nL SEQUENCE [NAME=\"sub.nc\" N5 N6]\nM30\n", "sub.nc", sub);
    assert_eq!((run.ids(), run.end), (vec![], vec![1.0, 2.0, 0.0]));
}

/// Of several blocks with a number the first one counts, in whatever order the numbers are written.
#[test]
fn sequences_begin_at_the_first_block_of_their_number() {
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let numbers: Vec<usize> = (0..400)
            .map(|i| if random.chance(0.8) { 10 * (i % 150) } else { random.below(2000) })
            .collect();
        let blocks = numbers.iter().zip(1..).map(|(n, y)| format!("N{n} Y{y}\n"));
        let wanted = random.pick(&numbers);
        let first = numbers.iter().position(|n| *n == wanted).unwrap() + 1;
        let run = clean(&format!(
            "G01 F60000\n$GOTO [BEHIND]\n{}[BEHIND] L SEQUENCE [N{wanted}]\nM30\n",
            blocks.collect::<String>()
        ));
        assert_eq!(run.end, [0.0, first as f64, 0.0], "{seed}: N{wanted}");
    }
}

/// G functions without values are restored at the end of a cycle, those with values or axes stay (P-CHAN-00210, 476043659).
#[test]
fn what_a_cycle_changes() {
    let table = "V.G.NP[1].V.X=100\nV.G.NP[2].V.X=10\nF1000\nG54\n";
    let end = |settings: &[&str], before: &str, cycle: &str, after: &str| {
        let files = [
            ("main.nc", format!("{table}{before}\nL CYCLE [NAME=c.nc]\n{after}\nM30\n")),
            ("c.nc", format!("{cycle}\nM17\n")),
            ("d.nc", "G55 G91\nM17\n".to_owned()),
        ];
        let files: Vec<(&str, &str)> = files.iter().map(|(n, t)| (*n, t.as_str())).collect();
        let run = listed(settings, &files);
        assert!(run.ids().is_empty(), "{:?}", super::shown(&run.diagnostics));
        run.end
    };
    let x = |before: &str, cycle: &str| end(&[], before, cycle, "G71 X1 Y2")[0];
    assert_eq!(x("", "G55"), 101.0);
    assert_eq!(x("", "G53"), 101.0);
    assert_eq!(x("G159=2", "G54"), 11.0);
    assert_eq!(x("", "G159=2"), 11.0);
    assert_eq!(x("", "G92 X5"), 106.0);
    assert_eq!(x("G71", "G21"), 101.0);
    assert_eq!(x("G71 G21", "G20"), 99.0);
    assert_eq!(x("G71", "G351 X-1"), 99.0);
    assert_eq!(x("", "#RETAIN CYCLE CHANGES\nG55"), 11.0);
    // the inner cycle's own matter
    assert_eq!(x("", "#RETAIN CYCLE CHANGES\nL CYCLE [NAME=d.nc]\nG55"), 11.0);
    assert_eq!(x("", "G55\nL CYCLE [NAME=d.nc]"), 101.0);
    // a system that stays open keeps its offset
    assert_eq!(x("#CS ON [1,0,0]", "G55"), 102.0);
    assert_eq!(x("", "#CS ON [1,0,0]\nG55"), 112.0);
    assert_eq!(end(&["channel.cycle_changes_modal=1"], "", "G55 G91", "X1")[0], 1.0);
    // the variable is the parameter
    assert_eq!(
        end(&["channel.cycle_changes_modal=1"], "V.G.CYCLE_CHANGES_MODAL=0", "G55", "X1")[0],
        101.0
    );
    assert_eq!(x("V.G.CYCLE_CHANGES_MODAL=1", "G55"), 11.0);
    assert_eq!(x("", "G55\nV.G.CYCLE_CHANGES_MODAL=1"), 11.0);
    assert_eq!(x("P1=V.G.CYCLE_CHANGES_MODAL G92 XP1", "G55"), 101.0);
}

/// Source: channel parameters 476043659. G135 and G151 have no values; G136 has axis names and stays.
#[test]
fn the_end_of_a_cycle_gives_feedforward_and_splines_back() {
    let last = |before: &str, cycle: &str| {
        let main = format!("{before}\nL CYCLE [NAME=c.nc]\nM30\n");
        let cycle = format!("{cycle}\nM17\n");
        let run =
            listed(&["X,Y,Z.vorsteuer.vs_v_faktor=1000"], &[("main.nc", &main), ("c.nc", &cycle)]);
        let feedforward = |e: &&Event| matches!(e, Event::Feedforward { .. });
        match run.events().into_iter().rfind(feedforward) {
            Some(Event::Feedforward { on, weight_ratios }) => Some((*on, weight_ratios[0])),
            _ => None,
        }
    };
    assert_eq!(last("G137", "G135"), Some((false, 1.0)));
    assert_eq!(last("G135", "G137"), Some((true, 1.0)));
    assert_eq!(last("G135", "G137\nG136 X80"), Some((true, 0.8)));
    assert_eq!(last("G137", "#RETAIN CYCLE CHANGES\nG135"), Some((true, 1.0)));
    let spline = |cycle: &str, after: &str| {
        let main = format!("G01 X0 F100\nL CYCLE [NAME=c.nc]\n{after}\nM30\n");
        let cycle = format!("{cycle}\nM17\n");
        let run = listed(&[], &[("main.nc", &main), ("c.nc", &cycle)]);
        run.blocks().iter().map(|b| b.path.is_straight()).collect::<Vec<_>>()
    };
    assert_eq!(spline("G151 X1 Y1\nX2 Y0", "X3 Y1\nX4 Y0"), [false, false, true, true]);
    assert_eq!(spline("G91", "G151 G90 X3 Y1\nX4 Y0"), [false, false]);
}
