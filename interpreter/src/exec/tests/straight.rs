//! The fast route of plain motions against the general one. `X 1` is the same word as `X1`, but is processed by the grammar and
//! the general execution: a program with a blank in one word of every line must give the same steps, messages and positions.

use super::random::{LINES, PIECES};
use super::{Options, machine, places, run_with};
use crate::diag::{Condition, Diagnostic};
use crate::exec::check;
use crate::source::MemorySources;
use kontur_kit::{Random, pieces};
use std::fmt::Write;
use std::sync::Arc;

/// A motion block in both spellings.
fn motion(random: &mut Random, number: usize) -> [String; 2] {
    let mut line = match random.below(6) {
        0 => format!("N{number} "),
        1 => format!("N{number}:"),
        2 => "(remark) ".to_owned(),
        _ => String::new(),
    };
    if random.below(2) == 0 {
        line += ["G1 ", "G01", "G0 ", "g1", "G91", "G90 ", "G02", "G1 G1 "][random.below(8)];
    }
    let mut lines = [line.clone(), line];
    let mut changed = false;
    for (letter, one_of) in
        [("X", 2), ("y", 2), ("Z", 2), ("F", 9), ("X", 60), ("A", 99), (" M", 15)]
    {
        if random.below(one_of) > 0 {
            continue;
        }
        let value = match random.below(10) {
            _ if letter == " M" => "8 ".to_owned(),
            0 => "[1+P1*2]".to_owned(),
            1 if letter == "F" => ["0", "-5", "1000000001"][random.below(3)].to_owned(),
            2 if random.below(4) == 0 => "600".to_owned(),
            _ => format!("{}.{}", random.below(30), random.below(1000)),
        };
        // M does not accept a blank, and an error inside a bracket would be in another column
        let blank = letter != " M" && !value.starts_with('[') && (!changed || random.below(2) == 0);
        changed |= blank;
        let (before, behind) = if blank { (" ", " ") } else { ("", "") };
        for (line, (before, behind)) in lines.iter_mut().zip([("", behind), (before, "")]) {
            let _ = write!(line, "{letter}{before}{value}{behind}");
        }
    }
    if random.below(8) == 0 {
        lines = lines.map(|line| line + "(remark (in it)) ; remark");
    } else if random.below(20) == 0 {
        lines = lines.map(|line| line + "(open (in it) ; remark");
    }
    lines
}

/// Words that change the execution of motions, and are valid.
const MODES: &str = r#"G91 ¦ G90 ¦ G60 X1 ¦ G60 ¦ G360 ¦ G261 ¦ G260 ¦ G54 ¦ G53 ¦ G92 X1 ¦ G70 ¦ G71 ¦ G21 ¦ G20 ¦ G18 ¦ G17
G93 F2 X3 ¦ G94 F900 ¦ G95 S100 M3 F1 X2 ¦ G901 ¦ G900 ¦ G116 ¦ G130 X50 ¦ X[OVERRIDE FEED_FACT=50]
#OVERRIDE [FEED_FACT=70] ¦ X[INDP_ASYN G90 G01 FEED=1000 POS=7] ¦ #CS ON [1,2,3,0,0,90] ¦ #CS OFF ALL
#SLOPE [TYPE=STEP] ¦ #HSC ON [BSPLINE] ¦ #HSC OFF ¦ #VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01]
#VIB GUARD OFF ¦ #MSG ["%d", P1] ¦ V.G.WZ[1].R=2 D1 ¦ G41 X5 Y3 ¦ G40 X0 ¦ #CHR=1 ¦ H5 ¦ P1=P1+1
L CYCLE [NAME=c.nc @P1=1 MODAL_MOVE] ¦ #DISABLE MODAL CYCLE ¦ $FOR P2=1,2,1 ¦ $ENDFOR"#;

#[test]
fn plain_motions_do_what_the_words_say() {
    let [lines, words, modes] = [LINES, PIECES, MODES].map(pieces);
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let stops = ["channel.exact_stop_after_g00=1"];
        let machine = machine(if seed % 5 == 0 { &stops } else { &[] });
        let mut texts = [(); 2].map(|()| String::from("%MAIN\nG01 F5000 P1=1\n"));
        for i in 0..60 {
            let other = match (random.below(40), seed % 4) {
                (0, 0) => Some(random.pick(&lines)),
                (1, 0) => Some(random.pick(&words)),
                (2..6, _) => Some(random.pick(&modes)),
                _ => None,
            };
            let lines = match other {
                Some(line) => [line; 2].map(str::to_owned),
                None => motion(&mut random, i),
            };
            for (text, line) in texts.iter_mut().zip(lines) {
                *text += &line;
                text.push('\n');
            }
        }
        let [short, long] = texts.clone().map(|text| {
            let sources = MemorySources::new().with("main.nc", text).with("c.nc", "X @P1\nG91\n");
            // a check also adds up the time of motions that do not become steps
            let max_time_s = if seed % 3 == 0 { 0.03 * seed as f64 } else { f64::INFINITY };
            let options = Options {
                max_blocks: 2000,
                max_blocks_at_rest: 500,
                max_time_s,
                ..Options::default()
            };
            let (checked, _) =
                check(Arc::new(sources.clone()), "main.nc", Arc::clone(&machine), options.clone());
            let run = run_with(sources, Arc::clone(&machine), options);
            // a message of the grammar quotes the text
            let quoting = [Condition::Syntax, Condition::DeclarationCharacter];
            let text = |d: &Diagnostic| match d.id {
                id if quoting.iter().any(|quoting| id == *quoting) => String::new(),
                _ => d.text.clone(),
            };
            let said = |d: &[Diagnostic]| {
                places(d).into_iter().zip(d.iter().map(text)).collect::<Vec<_>>()
            };
            (
                said(&checked.diagnostics),
                said(&run.diagnostics),
                format!("{:#?}", run.steps),
                run.end,
            )
        });
        assert_eq!(short.0, long.0, "check {seed}:\n{}", texts[0]);
        assert_eq!(short.1, long.1, "run {seed}:\n{}", texts[0]);
        assert!(short.2 == long.2, "steps {seed}:\n{}", texts[0]);
        assert_eq!(short.3, long.3, "end {seed}:\n{}", texts[0]);
    }
}
