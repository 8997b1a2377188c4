//! Tests of `index`.

use super::head::{SAYING, says_nothing};
use super::{Entry, EntryId, Index, Keyword, build};
use crate::exec::options::SkipLevels;
use crate::source::{BlockReader, MemorySources, Position, Sources};
use crate::syntax::ast::LabelKind;
use kontur_kit::{Random, pieces};
use std::fmt::Write as _;
use std::sync::Arc;

fn index(text: &str) -> (Index, Vec<String>) {
    let source = MemorySources::new().with("a.nc", text).open("a.nc", None).unwrap();
    let file: Arc<str> = Arc::from("a.nc");
    let mut reader = BlockReader::new(source);
    let (index, diagnostics) = build(&mut reader, &file, SkipLevels::NONE).unwrap();
    let shown = diagnostics
        .iter()
        .map(|d| format!("{} {}", d.id, d.source.as_ref().map_or(0, |s| s.line)))
        .collect();
    (index, shown)
}

fn entries(index: &Index) -> Vec<Entry> {
    (0..index.entries.len()).map(|id| index.entry(EntryId::try_from(id).unwrap())).collect()
}

#[test]
fn local_subroutines_and_the_main_program() {
    let (i, d) = index("; x\n%L SQUARE (c)\nN10 X1\n%L B\n%MAIN\nX2\nM30\n");
    let names: Vec<_> =
        i.sections.iter().map(|s| (s.name.as_deref(), s.local, s.start.line)).collect();
    let expected = [(Some("SQUARE"), true, 2), (Some("B"), true, 4), (Some("MAIN"), false, 5)];
    assert_eq!(names, expected);
    assert!(d.is_empty());
    let (i, _) = index("(head)\nX1\nM30\n");
    assert_eq!((i.sections.len(), i.sections[0].start.line), (1, 2));
    let (i, _) = index("%LONG\nX1\n");
    assert_eq!(i.sections[0].name.as_deref(), Some("LONG"));
}

#[test]
fn percent_lines_inside_a_program_are_remarks_unless_a_program_follows() {
    let (i, _) = index("%A\nX1\n% remark\nX2\nM30\n");
    assert_eq!(i.sections.len(), 1);
    assert!(i.sections[0].end > 15);
    let (i, _) = index("%A\nX1\nM30\n%B\nX2\nM30\n");
    assert_eq!(i.sections[0].end, 10);
}

#[test]
fn partners_of_control_statements() {
    let (i, d) = index("$IF P1\n$FOR P1=1,2,1\n$ENDFOR\n$ELSEIF P2\n$ELSE\nX1\n$ENDIF\n");
    assert!(d.is_empty(), "{d:?}");
    let entries = entries(&i);
    let next: Vec<_> = entries.iter().map(|e| e.next).collect();
    assert_eq!(next, [Some(3), Some(2), None, Some(4), Some(5), None]);
    assert_eq!(entries[4].end, Some(5));
    assert_eq!(entries[1].parent, Some(0));
    assert_eq!(entries[0].keyword, Keyword::If);
}

#[test]
fn structural_mistakes_have_their_ids() {
    assert_eq!(index("$ENDFOR\n").1, ["20232 1"]);
    assert_eq!(index("X1\n$ELSEIF P1\n").1, ["20216 2"]);
    assert_eq!(index("$ELSE\n").1, ["20214 1"]);
    assert_eq!(index("N1: X1\nN1: X2\n").1, ["20836 2"]);
    assert_eq!(index("$WHILE P1\n$IF P2\n$ENDWHILE\n").1, ["20237 3"]);
    let deep = "$IF 1\n".repeat(65);
    assert_eq!(index(&deep).1, ["20211 65"]);
}

#[test]
fn lines_that_say_nothing_are_words() {
    let says_nothing =
        |line: &str| !line.bytes().any(|b| SAYING.contains(&b)) && says_nothing(line.as_bytes());
    for line in ["X1 Y2", "N10X1", "n5 \tG01 F100 ; feed", "L sub.nc", "x1.5 (a)"] {
        assert!(says_nothing(line), "{line}");
    }
    let others = " X1 ¦ N ¦ N10 ¦ N10: ¦ N10 :X1 ¦ N10[A] X1 ¦ [A] ¦ N[1] ¦ /X1 ¦ %L A ¦ $IF 1 ¦ #IF 1 ¦ N1 #IF 1 ¦ (c) $IF 1 ¦ ; ¦ M30 ¦ X1 m02
X1 \\ ¦ \"A\" ¦ N 1: ¦ ";
    for line in pieces(others) {
        assert!(!says_nothing(line), "{line}");
    }
}

/// The structure is the same, whether or not plain lines are read as blocks.
#[test]
fn lines_gone_over_are_counted() {
    let plain = "X1 Y2\r\nN5 X3\nX4\rG01 X5 (M)\nX6 \\\n%L X\nX7\0X8\n";
    let text = format!("%A\n{plain}N7: X1\n$IF P1\n{plain}$ENDIF\nM30\n%L B\n{plain}");
    let (i, d) = index(&text);
    assert_eq!(d, ["K-0109 22"]);
    let entries = entries(&i);
    let lines: Vec<_> = entries.iter().map(|e| e.position.line).collect();
    assert_eq!(lines, [11, 20]);
    let offsets: Vec<_> = entries.iter().map(|e| e.position.offset).collect();
    let place = |word: &str| text.find(word).unwrap() as u64;
    assert_eq!(offsets, [place("$IF"), place("$ENDIF")]);
    assert_eq!(i.sections[0].end, place("%L B"));
    assert_eq!(i.sections[1].end, text.len() as u64);
}

#[test]
fn nothing_inside_comment_blocks_counts() {
    let (i, d) = index("#COMMENT BEGIN\n$IF (\n%L X\n#COMMENT END\nX1\n");
    assert!(d.is_empty());
    assert_eq!(i.entries.len(), 2);
    assert_eq!(i.entry(0).end, Some(1));
    assert_eq!(i.sections.len(), 1);
}

#[test]
fn comments_and_their_ends_are_pairs() {
    assert_eq!(index("X1\n#COMMENT BEGIN\nX2\nM30\n").1, ["K-0145 2"]);
    assert_eq!(index("X1\n#COMMENT END\nM30\n").1, ["K-0145 2"]);
    assert!(index("# COMMENT BEGIN\n$IF (\n#\tCOMMENT END\nX1\nM30\n").1.is_empty());
    assert!(index("# IF 1\nX1\n# ELSE\nX2\n# ENDIF\nM30\n").1.is_empty());
    // the first end closes both
    let nested = "#COMMENT BEGIN\n#COMMENT BEGIN\n#COMMENT END\nX1\n#COMMENT END\nM30\n";
    assert_eq!(index(nested).1, ["K-0145 5"]);
}

#[test]
fn a_further_main_program_is_noticed() {
    let further = |text: &str| index(text).0.further.map(|place| place.line);
    assert_eq!(further("%A\nX1\nM30\n%B\nX5\nM30\n%C\nX6\n"), Some(4));
    assert_eq!(further("X1\nM30\n%\n\nG01 X5\n"), Some(3));
    assert_eq!(further("X1\n%B\nX5\nM30\n"), None);
    assert_eq!(further("X1\nM30\n%L B\nX5\nM17\n"), None);
    // the sign that ends a tape
    for end in ["%", "%\n", "%\n\n (end) \n; end", "%\n%\n"] {
        assert_eq!(further(&format!("%\nX1\nM30\n{end}")), None, "{end}");
    }
}

#[test]
fn nothing_inside_cycles_in_real_time_counts() {
    for begin in ["#RT CYCLE", "#rt cycle [ID=1]", "N5 #RT  CYCLE DEF [ID = 2]", "#RT CYCLE ; a"] {
        let text = format!("{begin}\n$IF ONCE 1\n#COMMENT BEGIN\n%L X\n#RT CYCLE END\nX1\n");
        let (i, d) = index(&text);
        assert!(d.is_empty());
        assert_eq!(i.entries.len(), 2, "{begin}");
        assert_eq!(i.entry(0).end, Some(1), "{begin}");
        assert_eq!(i.sections.len(), 1);
    }
    let (i, _) = index("#RT CYCLE START [ID=1]\n$IF 1\n$ENDIF\n#RT CYCLE DELETE [ID=1]\n");
    assert_eq!(i.entries.len(), 2);
}

/// Statements of a program, with their partners as written.
#[derive(Default)]
struct Written {
    text: String,
    lines: u32,
    /// Position, opening statement, next clause, closing statement, structure around it.
    partners: Vec<(Position, [Option<EntryId>; 4])>,
}

impl Written {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
        self.lines += 1;
    }

    fn statement(&mut self, line: &str, around: Option<EntryId>) -> EntryId {
        let id = EntryId::try_from(self.partners.len()).unwrap();
        let position = Position { offset: self.text.len() as u64, line: self.lines + 1 };
        self.partners.push((position, [None, None, None, around]));
        self.line(line);
        id
    }

    /// Some lines with structures among them, inside `around`.
    fn lines(&mut self, random: &mut Random, around: Option<EntryId>, depth: usize) {
        for _ in 0..random.pick(&[0, 1, 2, 5, if depth == 0 { 300 } else { 40 }]) {
            if self.partners.len() > 3000 {
                return;
            }
            match random.below(if depth < 4 { 9 } else { 4 }) {
                0 => self.line("N10 G01 X1"),
                1 => self.line("(a remark)"),
                2 => _ = self.statement("$BREAK", around),
                3 => _ = self.statement("N7 $IF P1 > 2 $GOTO N10", around),
                4 => self.structure(random, around, depth, ["$FOR P1 = 1, 5, 1", "$ENDFOR"], &[]),
                5 => self.structure(random, around, depth, [" $WHILE P1 < 5", "N3 $ENDWHILE"], &[]),
                6 => self.structure(random, around, depth, ["$REPEAT", "$UNTIL P1 == 1"], &[]),
                7 => {
                    let cases = ["$CASE 1", "$CASE 2", "$CASE 3", "$DEFAULT"];
                    let cases = &cases[random.below(4)..];
                    self.structure(random, around, depth, ["$SWITCH P1", "$ENDSWITCH"], cases);
                }
                _ => {
                    let clauses = ["$ELSEIF P1", "/$ELSEIF P2", "$ELSE"];
                    let clauses = &clauses[random.below(4)..];
                    self.structure(random, around, depth, ["$IF P1 == 1", "$ENDIF"], clauses);
                }
            }
        }
    }

    fn structure(
        &mut self,
        random: &mut Random,
        around: Option<EntryId>,
        depth: usize,
        [opens, closes]: [&str; 2],
        clauses: &[&str],
    ) {
        let open = self.statement(opens, around);
        let mut parts = vec![open];
        for line in clauses.iter().chain([&closes]) {
            self.lines(random, Some(open), depth + 1);
            parts.push(self.statement(line, around));
        }
        let end = parts.last().copied();
        for (i, part) in parts.iter().enumerate() {
            let next = parts.get(i + 1).copied();
            self.partners[*part as usize].1 = [Some(open), next, end, around];
        }
    }
}

/// Partners are the statements that were written, however many lie between them.
#[test]
fn partners_are_found_in_long_programs() {
    let mut most = 0;
    for seed in 0..60 {
        let mut written = Written::default();
        written.lines(&mut Random::new(seed), None, 0);
        let (index, found) = index(&written.text);
        assert!(found.is_empty(), "{seed}: {found:?}");
        let entries = entries(&index);
        most = most.max(entries.len());
        assert_eq!(entries.len(), written.partners.len());
        for (id, (entry, (position, partners))) in (0..).zip(entries.iter().zip(&written.partners))
        {
            assert_eq!(entry.position, *position);
            assert_eq!([entry.open, entry.next, entry.end, entry.parent], *partners, "{seed} {id}");
            assert_eq!(index.at(*position), Some(id));
            let beside = Position { offset: position.offset + 1, ..*position };
            assert_eq!(index.at(beside), None);
        }
    }
    assert!(most > 1000, "{most}");
}

/// A long program with a label and a statement on every other line does not reach any limit to their number.
#[test]
fn every_block_of_a_long_program_may_have_a_label() {
    const COUNT: u64 = 300_000;
    let text: String = (0..COUNT).fold(String::new(), |mut text, n| {
        let _ = writeln!(text, "N{n}: X1\n$BREAK");
        text
    });
    let (index, found) = index(&text);
    assert!(found.is_empty(), "{found:?}");
    for n in [0, 1, COUNT / 2, COUNT - 1] {
        let line = u32::try_from(2 * n + 1).unwrap();
        let label = index.label(0, &LabelKind::Number(n)).map(|place| place.position.line);
        assert_eq!(label, Some(line));
        let statement = index.entry(EntryId::try_from(n).unwrap());
        assert_eq!((statement.keyword, statement.position.line), (Keyword::Break, line + 1));
    }
}

/// Statements with faults among them mean the same whatever follows them and wherever they are.
#[test]
fn mistakes_mean_the_same_in_long_programs() {
    let lines = pieces(
        "$IF 1 ¦ $ENDIF ¦ $ELSE ¦ $ELSEIF 1 ¦ $FOR P1=1,2,1 ¦ $ENDFOR ¦ $WHILE 1 ¦ $ENDWHILE ¦ #IF 1 ¦ #ELSE ¦ #ENDIF ¦ #COMMENT BEGIN
#COMMENT END ¦ #RT CYCLE ¦ #RT CYCLE END ¦ $SWITCH 1 ¦ $CASE 1 ¦ $ENDSWITCH ¦ %A ¦ %L B ¦ $DO",
    );
    for seed in 0..300 {
        let mut random = Random::new(seed);
        // few enough to be kept unpacked
        let few: Vec<_> = (0..40).map(|_| random.pick(&lines)).collect();
        let few = few.join("\n") + "\n";
        let before = "$BREAK\n".repeat(random.below(40));
        let (short, _) = index(&format!("%M\n{few}"));
        let (long, _) = index(&format!("%M\n{before}{few}{}", "$BREAK\n".repeat(100)));
        let (begins, offset) = (before.lines().count(), before.len() as u64);
        let shifted = |id: Option<EntryId>| id.map(|id| id + EntryId::try_from(begins).unwrap());
        for (id, entry) in (0..).zip(entries(&short)) {
            let other = long.entry(shifted(Some(id)).unwrap());
            let expected = Entry {
                position: other.position,
                span: other.span,
                open: shifted(entry.open),
                next: shifted(entry.next),
                end: shifted(entry.end),
                parent: shifted(entry.parent),
                ..entry
            };
            assert_eq!(other, expected, "{seed} {id}\n{few}");
            assert_eq!(other.position.offset, offset + entry.position.offset);
        }
    }
}
