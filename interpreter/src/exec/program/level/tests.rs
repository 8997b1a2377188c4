//! Tests of `level`: open structures against a text whose nesting the test has written itself.

use super::{Level, Levels};
use crate::exec::options::SkipLevels;
use crate::exec::program::files::{Files, Structures};
use crate::exec::program::index::build;
use crate::exec::program::state::Target;
use crate::source::{BlockReader, MemorySources, Sources};
use crate::syntax::ast::{LabelKind, Span};
use kontur_kit::Random;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::sync::Arc;

/// A label with the lines of the structures around it, the outermost first.
struct Place {
    around: Vec<u32>,
    from: u64,
}

#[derive(Default)]
struct Written {
    text: String,
    /// First word of each line.
    lines: Vec<&'static str>,
    around: Vec<u32>,
    labels: Vec<Place>,
}

impl Written {
    fn line(&mut self, word: &'static str, rest: &str) {
        self.lines.push(word);
        let _ = writeln!(self.text, "{word}{rest}");
    }

    fn blocks(&mut self, random: &mut Random) {
        for _ in 0..random.below(4) {
            let (number, from) = (self.labels.len(), self.text.len() as u64);
            self.labels.push(Place { around: self.around.clone(), from });
            self.line("N", &format!("{number}: X{number}"));
            let room = self.around.len() < 4;
            let structures = [("$IF", " P1", "$ENDIF"), ("$WHILE", " P1", "$ENDWHILE")];
            let (open, condition, close) = random.pick(&structures);
            if room && random.chance(0.6) {
                self.around.push(self.lines.len() as u32 + 1);
                self.line(open, condition);
                self.blocks(random);
                if open == "$IF" && random.chance(0.5) {
                    self.line("$ELSE", "");
                    self.blocks(random);
                }
                self.around.pop();
                self.line(close, "");
            }
        }
    }
}

/// The lines of the open structures, the outermost first; closes them.
fn unwound(levels: &mut Levels) -> Vec<u32> {
    let mut lines = Vec::new();
    while let Some(id) = levels.innermost(|_| true) {
        lines.insert(0, levels[0].index.entry(id).position.line);
        assert!(levels.close_inside(id));
        levels.close(id);
        assert!(!levels.close_inside(id));
    }
    lines
}

/// A jump from any label to any other enters branches of `$IF` alone, and leaves open exactly what is around its target.
#[test]
fn jumps_open_what_is_around_their_target() {
    let (mut entered, mut refused) = (0, 0);
    for seed in 0..60 {
        let mut written = Written::default();
        written.blocks(&mut Random::new(seed));
        let source = MemorySources::new().with("a.nc", &*written.text).open("a.nc", None).unwrap();
        let (index, _) =
            build(&mut BlockReader::new(source), &Arc::from("a.nc"), SkipLevels::NONE).unwrap();
        let index = Arc::new(index);
        let mut files = Files::new(
            Arc::new(MemorySources::new()),
            SkipLevels::NONE,
            BTreeSet::default(),
            Structures::default(),
        );
        let position = |line: u32| {
            let entries = (0..=written.lines.len() as u32).map(|id| index.entry(id));
            (0..).zip(entries).find(|(_, entry)| entry.position.line == line).unwrap().0
        };
        for here in &written.labels {
            for (number, there) in (0..).zip(&written.labels) {
                let mut levels = Levels::default();
                let target = Target { file: 0, section: 0 };
                levels.enter(Level::new(target, Arc::clone(&index), None, None));
                for line in &here.around {
                    levels.open(position(*line), None, &mut files);
                }
                let place = index.label(0, &LabelKind::Number(number)).unwrap();
                let common =
                    here.around.iter().zip(&there.around).take_while(|(a, b)| a == b).count();
                let into = &there.around[common..];
                let allowed = into.iter().all(|line| written.lines[*line as usize - 1] == "$IF");
                let landing = levels[0].landing(here.from, place, "label", Span::default());
                assert_eq!(landing.is_ok(), allowed, "{}", written.text);
                let Ok(landing) = landing else {
                    assert_eq!(unwound(&mut levels), here.around);
                    refused += 1;
                    continue;
                };
                levels.land(landing, here.from, &mut files);
                assert_eq!(levels[0].at.offset, there.from);
                let in_loop = |line: &u32| written.lines[*line as usize - 1] == "$WHILE";
                let again = there.around.iter().any(in_loop) || there.from <= here.from;
                assert_eq!(levels[0].is_repeated(place.position), again);
                assert_eq!(unwound(&mut levels), there.around, "{}", written.text);
                entered += into.len();
            }
        }
    }
    assert!(entered > 100 && refused > 100, "{entered} {refused}");
}
