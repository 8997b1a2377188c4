//! Tests of `index`.

use super::head::{SAYING, says_nothing};
use super::{Index, Keyword, build};
use crate::exec::options::SkipLevels;
use crate::source::{BlockReader, MemorySources, Sources};
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
    let next: Vec<_> = i.entries.iter().map(|e| e.next).collect();
    assert_eq!(next, [Some(3), Some(2), None, Some(4), Some(5), None]);
    assert_eq!(i.entries[4].end, Some(5));
    assert_eq!(i.entries[1].parent, Some(0));
    assert_eq!(i.entries[0].keyword, Keyword::If);
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
    for line in [
        "",
        " X1",
        "N",
        "N10",
        "N10:",
        "N10 :X1",
        "N10[A] X1",
        "[A]",
        "N[1]",
        "/X1",
        "%L A",
        "$IF 1",
        "#IF 1",
        "N1 #IF 1",
        "(c) $IF 1",
        ";",
        "M30",
        "X1 m02",
        "X1 \\",
        "\"A\"",
        "N 1:",
    ] {
        assert!(!says_nothing(line), "{line}");
    }
}

/// The same structure, whether or not plain lines were read as blocks.
#[test]
fn lines_gone_over_are_counted() {
    let plain = "X1 Y2\r\nN5 X3\nX4\rG01 X5 (M)\nX6 \\\n%L X\nX7\0X8\n";
    let text = format!("%A\n{plain}N7: X1\n$IF P1\n{plain}$ENDIF\nM30\n%L B\n{plain}");
    let (i, d) = index(&text);
    assert_eq!(d, ["K-0109 22"]);
    let lines: Vec<_> = i.entries.iter().map(|e| e.position.line).collect();
    assert_eq!(lines, [11, 20]);
    let offsets: Vec<_> = i.entries.iter().map(|e| e.position.offset).collect();
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
    assert_eq!(i.entries[0].end, Some(1));
    assert_eq!(i.sections.len(), 1);
}
