//! Subroutines, cycles and ends of programs.

use super::{EndReason, Options, Run, machine, run, run_with};
use crate::source::MemorySources;
use kontur_kit::Random;

fn with(main: &str, name: &str, sub: &str) -> Run {
    let sources = MemorySources::new().with("main.nc", main).with(name, sub);
    run_with(sources, machine(&[]), Options::default())
}

#[test]
fn ends_of_programs() {
    assert_eq!(run("X1 F100\n").ids(), ["K-0003"]);
    assert_eq!(run("X1 F100\n").reason(), EndReason::Finished);
    assert_eq!(run("#FOO\nX1 F100\n").reason(), EndReason::Aborted);
    assert_eq!(
        (run("").ids(), run("X1 F100\n").end),
        (vec!["K-0003".to_owned()], vec![1.0, 0.0, 0.0])
    );
    assert_eq!(super::places(&run("X1 F100\nM17 [MAIN]\n").diagnostics), ["K-0002 2:1"]);
}

fn listed(settings: &[&str], files: &[(&str, &str)]) -> Run {
    let sources = files.iter().fold(MemorySources::new(), |s, (name, text)| s.with(name, *text));
    run_with(sources, machine(settings), Options::default())
}

#[test]
fn a_program_of_the_list_runs_before_every_end() {
    let end = ["channel.final_prog_file=final.nc"];
    let last = ("final.nc", "G90 Z9 F50\n");
    // without M30 it also runs, and the missing end is reported once
    let run = listed(&end, &[("main.nc", "$IF 1\nX1 F100\n$ENDIF\n"), last]);
    assert_eq!((run.ids(), run.ends().len()), (vec!["K-0003".to_owned()], 2));
    let run = listed(&end, &[("main.nc", "X1 F100\nM30\n")]);
    assert_eq!((run.ids(), run.reason()), (vec!["K-0013".to_owned()], EndReason::Aborted));
}

#[test]
fn conditions_of_a_block_that_changes_the_level_name_its_file() {
    let place = |run: &Run| {
        let place = run.diagnostics[0].source.as_ref().unwrap();
        (place.file.to_string(), place.line)
    };
    let run = with("X1 F100\nI5 L sub.nc\nM30\n", "sub.nc", "Y1\n\n\nI5 M17\n");
    assert_eq!(place(&run), ("main.nc".to_owned(), 2));
    assert_eq!(run.diagnostics[1].source.as_ref().map(|s| (&*s.file, s.line)), Some(("sub.nc", 4)));
}

#[test]
fn other_capital_letters_than_the_files_get_a_note() {
    /// Finds files regardless of upper and lower case, as some file systems do.
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

/// Of several blocks with the same number the first one is used, whatever the order of the numbers.
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
        let run = run(&format!(
            "G01 F60000\n$GOTO [BEHIND]\n{}[BEHIND] L SEQUENCE [N{wanted}]\nM30\n",
            blocks.collect::<String>()
        ));
        let repeats = numbers.iter().filter(|n| **n == wanted).count() > 1;
        assert_eq!(run.ids(), vec!["K-0109"; usize::from(repeats)], "{seed}: N{wanted}");
        assert_eq!(run.end, [0.0, first as f64, 0.0], "{seed}: N{wanted}");
    }
}
