use super::{Mode, accepted, parse, parse_as, refused, shape};
use crate::diag::Severity;
use crate::source::{BlockReader, MemorySources, Sources};
use crate::syntax::Parser;
use crate::syntax::ast::{Body, ExprKind, ItemKind, ItemValue, LabelKind, Word, WordKind};
use std::sync::Arc;

fn words(line: &str) -> Vec<Word> {
    match accepted(line).body {
        Body::Words(words) => words,
        body => panic!("{line}: {body:?}"),
    }
}

/// Canonical spelling of an accepted line.
fn printed(line: &str) -> String {
    accepted(line).to_string()
}

/// Rows of a table in `interpreter/tests/syntax`: a line and its result. Other lines are comments.
fn rows(table: &str) -> impl Iterator<Item = (&str, &str)> {
    table.lines().filter_map(|row| row.rsplit_once(" ->")).map(|(line, of)| (line, of.trim_start()))
}

#[test]
fn accepted_lines() {
    let blanks = [("X1 $GOTO N20: ", "X=1 $GOTO N20"), ("  \t", "")];
    for (line, expected) in rows(include_str!("../../../tests/syntax/accepted.txt")).chain(blanks) {
        assert_eq!(printed(line), expected, "{line}");
    }
    assert_eq!(accepted("N10:").label.unwrap().kind, LabelKind::Number(10));
    assert_eq!((accepted("/5 X1").skip, accepted("X1").skip), (Some(5), None));
}

#[test]
fn refused_lines() {
    for (line, expected) in rows(include_str!("../../../tests/syntax/refused.txt")) {
        let found: Vec<String> =
            refused(line).iter().map(|(id, column)| format!("{id}@{column}")).collect();
        assert_eq!(found.join(" "), expected, "{line}");
    }
}

#[test]
fn program_heads() {
    for (line, expected) in rows(include_str!("../../../tests/syntax/heads.txt")) {
        let Body::ProgramHead(head) = accepted(line).body else { panic!("{line}") };
        let local = if head.local { "local " } else { "" };
        let name = head.name.as_ref().map_or("", |n| &*n.text);
        assert_eq!(format!("{local}{name}: {}", head.text).trim_end(), expected, "{line}");
    }
}

#[test]
fn decoration_leaves_no_trace() {
    for group in include_str!("../../../tests/syntax/alike.txt").lines().skip(1) {
        // the lines differ in length: only the spans of the block and similar ones do, which `shape` drops
        let shapes: Vec<_> = group.split('\t').map(|line| shape(&accepted(line))).collect();
        assert!(shapes.len() > 1 && shapes.iter().all(|found| *found == shapes[0]), "{group}");
    }
    assert_eq!(shape(&accepted("#FILTER ON [HSC]")), shape(&accepted("#FILTER ON\t[HSC]")));
}

#[test]
fn precedence() {
    // left to right, and the sign of the literal has the highest precedence: (2**3)**2, (-2)**2
    let value = |line| match words(line).remove(0).kind {
        WordKind::Assign(assign) => assign.value,
        kind => panic!("{kind:?}"),
    };
    let ExprKind::Binary(power) = value("P1=2**3**2").kind else { panic!() };
    assert!(matches!(power.left.kind, ExprKind::Binary(_)));
    let ExprKind::Binary(power) = value("P1=-2**2").kind else { panic!() };
    assert_eq!(power.left.kind, ExprKind::Number(-2.0));
}

#[test]
fn messages_and_hints_fit_the_mistake() {
    for (line, expected) in rows(include_str!("../../../tests/syntax/said.txt")) {
        let (_, diagnostics) = parse(line);
        let (text, hint) = (&diagnostics[0].text, diagnostics[0].hint.as_deref().unwrap_or(""));
        let fits = match expected.strip_prefix("hint: ") {
            Some(part) => hint.contains(part),
            None => text.starts_with(expected),
        };
        assert!(fits, "{line}: {text} ({hint})");
    }
}

#[test]
fn the_rest_of_a_block_with_errors_is_used() {
    for (line, expected) in rows(include_str!("../../../tests/syntax/rest.txt")) {
        let (block, diagnostics) = parse(line);
        assert!(!diagnostics.is_empty(), "{line}");
        assert_eq!(block.to_string(), expected, "{line}");
        assert!(diagnostics.iter().all(|d| d.source.as_ref().is_some_and(|s| s.block.is_some())));
    }
}

#[test]
fn declarations_and_branches_not_taken() {
    let declared = include_str!("../../../tests/syntax/declarations.txt");
    let not_taken = include_str!("../../../tests/syntax/not_taken.txt");
    for (table, mode, refused) in
        [(declared, Mode::Declaration, "X10"), (not_taken, Mode::Inactive, "$IF P1=")]
    {
        for (line, expected) in rows(table) {
            let (block, diagnostics) = parse_as(line, mode);
            assert!(diagnostics.is_empty(), "{line}: {diagnostics:?}");
            assert_eq!(block.to_string(), expected, "{line}");
        }
        assert!(!parse_as(refused, mode).1.is_empty());
    }
}

#[test]
fn too_deep_and_too_long() {
    let ids = |line: &str| {
        let mut ids: Vec<String> = refused(line).into_iter().map(|(id, _)| id).collect();
        ids.dedup();
        ids
    };
    assert_eq!(ids(&format!("X{}1{}", "[".repeat(1900), "]".repeat(1900))), ["20386"]);
    assert_eq!(ids(&"[".repeat(10_000)), ["20301"]);
    assert_eq!(ids(&format!("X1{}", "+1".repeat(1500))), ["K-0006"]);
    assert_eq!(ids(&format!("X{}", "-".repeat(3000))), ["K-0002"]);
    assert_eq!(ids(&format!("X{}5", "-".repeat(3000))), [""; 0]);
    assert_eq!(ids(&"X".repeat(3000)), ["K-0002"]);
    assert_eq!(ids(&format!("X{}", "SIN[".repeat(900))), ["20386"]);
    assert_eq!(ids(&format!("{}(", "(".repeat(3900))), [""; 0]);
    assert_eq!(ids(&format!("; {}", "x".repeat(4050))), ["20301"]);
    assert!(!parse(&format!("; {}", "x".repeat(4050))).1[0].is_error());
    assert!(parse(&format!("; {}", "x".repeat(5000))).1[0].is_error());
}

#[test]
fn items_keep_their_kind() {
    let Body::Command(command) = accepted("#E [ID455 NAME=a.nc A [1,2] \"t\" K P1]").body else {
        panic!()
    };
    let items = &command.groups[0].items;
    assert!(matches!(&items[0].kind, ItemKind::Flag(f) if f.split_number() == Some(("ID", 455.0))));
    assert!(
        matches!(command.groups[0].get("NAME"), Some(ItemValue::Name(n)) if &*n.text == "a.nc")
    );
    assert!(matches!(command.groups[0].get("A"), Some(ItemValue::List(l)) if l.items.len() == 2));
    assert!(matches!(&items[3].kind, ItemKind::Value(ItemValue::Expr(_))));
    assert!(command.is("E") && command.groups[0].has("id455"));
}

#[test]
fn notes_and_warnings() {
    let found = |line: &str| {
        let (_, diagnostics) = parse(line);
        diagnostics.iter().map(|d| (d.id.to_string(), d.severity)).collect::<Vec<_>>()
    };
    assert_eq!(found("#A [B=1 | C=2]"), [("K-0002".to_owned(), Severity::Note)]);
    assert_eq!(found("% Größe"), [("K-0001".to_owned(), Severity::Warning)]);
}

#[test]
fn errors_in_continued_lines_name_the_line() {
    let source = MemorySources::new().with("a.nc", "\r\nX1 \\\r\n N20 Y[1+*2]\r\n#A [B \\\n C]");
    let mut reader = BlockReader::new(source.open("a.nc", None).unwrap());
    let mut diagnostics = Vec::new();
    let parser = Parser::default();
    while let Some(raw) = reader.next_block().unwrap() {
        parser.block(&raw, &Arc::from("a.nc"), &mut diagnostics);
    }
    let place = diagnostics[0].source.as_ref().unwrap();
    assert_eq!((place.line, place.column, &*place.text), (3, 10, " N20 Y[1+*2]"));
    assert_eq!(diagnostics[1].severity, Severity::Note);
    assert_eq!(diagnostics.len(), 2);
}
