use super::{BlockReader, MemorySources, Position, Source, Sources};
use crate::syntax::ast::Span;
use proptest::prelude::*;
use std::io;
use std::sync::Arc;

fn reader(bytes: &[u8]) -> BlockReader {
    BlockReader::new(MemorySources::new().with("a.nc", bytes).open("a.nc", None).unwrap())
}

type Block = (String, u32, u64);

/// Text, line and offset of every block.
fn blocks(reader: &mut BlockReader) -> Vec<Block> {
    readable(reader).unwrap()
}

/// The same, or the reason why the text is refused.
fn readable(reader: &mut BlockReader) -> Result<Vec<Block>, String> {
    let mut found = Vec::new();
    while let Some(block) = reader.next_block().map_err(|e| e.to_string())? {
        found.push((block.text.to_owned(), block.position.line, block.position.offset));
    }
    Ok(found)
}

fn texts(bytes: &[u8]) -> Vec<String> {
    blocks(&mut reader(bytes)).into_iter().map(|(text, ..)| text).collect()
}

/// Gives a few bytes at a time.
struct Slow(Vec<u8>, usize);

impl Source for Slow {
    fn name(&self) -> Arc<str> {
        Arc::from("slow")
    }

    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        let start = usize::try_from(offset).unwrap().min(self.0.len());
        let rest = &self.0[start..];
        let n = rest.len().min(buffer.len()).min(self.1);
        buffer[..n].copy_from_slice(&rest[..n]);
        Ok(n)
    }
}

#[test]
fn every_line_end_ends_a_block() {
    assert_eq!(texts(b"A\nB\r\nC\rD\0E\x03F"), ["A", "B", "C", "D", "E", "F"]);
    assert_eq!(texts(b"A\n\nB\r\r\nC\n"), ["A", "", "B", "", "C"]);
    assert_eq!(texts(b""), [""; 0]);
    let found = blocks(&mut reader(b"A\r\nBC\nD"));
    let places: Vec<(u32, u64)> = found.iter().map(|(_, line, offset)| (*line, *offset)).collect();
    assert_eq!(places, [(1, 0), (2, 3), (3, 6)]);
}

#[test]
fn byte_order_mark_and_encodings() {
    let mut r = reader(b"\xEF\xBB\xBFX1\n(\xE4)X2\n(\xC3\xA4)X3");
    let mut place = |from, to| {
        let block = r.next_block().unwrap().unwrap();
        let at = block.locate(&Arc::from("f"), Span::new(from, to));
        (block.text.to_owned(), at.line, at.column, at.offset, at.length)
    };
    assert_eq!(place(0, 2), ("X1".to_owned(), 1, 1, 3, 2));
    // Latin-1: two bytes in the text, one in the program. UTF-8: two in both, and one character.
    assert_eq!(place(4, 6), ("(ä)X2".to_owned(), 2, 4, 9, 2));
    assert_eq!(place(4, 6), ("(ä)X3".to_owned(), 3, 4, 16, 2));
}

#[test]
fn continued_lines_are_joined_with_their_places() {
    let program = b"N10 X1 \\\r\n  N20 Y2 \\ \nZ3\nN30";
    let found = blocks(&mut reader(program));
    assert_eq!(found[0], ("N10 X1   Y2  Z3".to_owned(), 1, 0));
    assert_eq!(found[1], ("N30".to_owned(), 4, 25));
    let mut r = reader(program);
    let block = r.next_block().unwrap().unwrap();
    let place = |text: &str| {
        let start = block.text.find(text).unwrap();
        let at = block.locate(&Arc::from("f"), Span::new(start, start + text.len()));
        (at.line, at.column, at.offset, at.text.to_string())
    };
    assert_eq!(place("X1"), (1, 5, 4, "N10 X1 \\".to_owned()));
    assert_eq!(place("Y2"), (2, 7, 16, "  N20 Y2 \\ ".to_owned()));
    assert_eq!(place("Z3"), (3, 1, 22, "Z3".to_owned()));
}

#[test]
fn what_looks_like_a_continuation_and_is_none() {
    assert_eq!(texts(b"X1 ; C:\\dir\\\nY2"), ["X1 ; C:\\dir\\", "Y2"]);
    assert_eq!(texts(b"X1 (a\\\nY2"), ["X1 (a\\", "Y2"]);
    assert_eq!(texts(b"X1 (a) \\\nY2"), ["X1 (a)  Y2"]);
    assert_eq!(texts(b"X1 \\"), ["X1  "]);
    // Empty lines and remarks may come between only while a bracket is open.
    assert_eq!(texts(b"L CYCLE [A=1 \\\n\n; x\n @P1=2]\nX1"), ["L CYCLE [A=1   @P1=2]", "X1"]);
    assert_eq!(texts(b"X1 \\\n\nY2"), ["X1  ", "Y2"]);
}

#[test]
fn long_lines_are_cut_and_the_next_one_is_found() {
    for characters in [4096_u32, 4097, 16_384, 16_390, 65_536, 300_000] {
        let length = characters as usize;
        for end in ["\n", "\r\n"] {
            let program = format!("A\n{}{end}B", "x".repeat(length));
            for step in [7919, usize::MAX] {
                let mut r = BlockReader::new(Box::new(Slow(program.clone().into_bytes(), step)));
                r.next_block().unwrap();
                let block = r.next_block().unwrap().unwrap();
                assert_eq!((block.text.len(), block.characters), (length.min(4096), characters));
                let long = block.position;
                let block = r.next_block().unwrap().unwrap();
                let offset = (2 + length + end.len()) as u64;
                assert_eq!((block.text, block.position), ("B", Position { offset, line: 3 }));
                r.seek(long);
                assert_eq!(r.next_block().unwrap().unwrap().characters, characters);
                assert_eq!(r.next_block().unwrap().unwrap().text, "B");
                assert!(r.next_block().unwrap().is_none());
            }
        }
    }
}

#[test]
fn endless_continuation_does_not_grow() {
    let mut r = reader(&b"X1 \\\n".repeat(20_000));
    let block = r.next_block().unwrap().unwrap();
    assert!(block.text.len() <= 4096 && block.pieces.len() <= 4096 && block.characters > 4096);
    assert!(r.next_block().unwrap().is_none());
}

#[test]
fn seeking_gives_the_same_blocks_again() {
    let lines: Vec<String> = (0..20_000).map(|i| format!("N{i} X{i}")).collect();
    let program = lines.join("\n");
    let mut r = reader(program.as_bytes());
    let mut places = Vec::new();
    while let Some(block) = r.next_block().unwrap() {
        places.push(block.position);
    }
    for i in [0, 19_999, 5, 5, 10_000, 9_990] {
        r.seek(places[i]);
        let block = r.next_block().unwrap().unwrap();
        assert_eq!((block.text, block.position), (format!("N{i} X{i}").as_str(), places[i]));
    }
}

proptest! {
    /// The result does not depend on how the bytes arrive, and every block can be found again by its position.
    #[test]
    fn blocks_do_not_depend_on_the_way_of_reading(
        parts in prop::collection::vec("[A-C\\\\\u{e4}(\"; \\[]{0,6}|\\r\\n|\\n|\\r|\\x00", 0..30),
        step in 1..9_usize,
        latin in any::<bool>(),
    ) {
        let mut bytes = parts.concat().into_bytes();
        if latin {
            bytes.retain(|b| *b != 0xC3);
        }
        // enough zero bytes are UTF-16, which is refused
        let expected = readable(&mut reader(&bytes));
        let mut slow = BlockReader::new(Box::new(Slow(bytes, step)));
        prop_assert_eq!(&readable(&mut slow), &expected);
        for (text, line, offset) in expected.into_iter().flatten().rev() {
            slow.seek(Position { offset, line });
            prop_assert_eq!(slow.next_block().unwrap().unwrap().text, text);
        }
    }
}

/// Lines that are skipped, or taken unchanged, are the same blocks as those read one by one.
#[test]
fn lines_gone_over_are_blocks() {
    const PARTS: &[&str] = &[
        "X1", "M", " ", "(a)", "\\", "Y-2.5", "\n", "\n", "\n", "\r\n", "\r", "\0", "\x03",
        "\u{e9}",
    ];
    for seed in 0..300 {
        let mut random = kontur_kit::Random::new(seed);
        let long = random.below(2) == 0;
        let mut text = String::from("X1\n");
        for _ in 0..random.below(3000) {
            let part = random.below(if long { 9 } else { PARTS.len() });
            text += PARTS[part];
        }
        let whole = blocks(&mut reader(text.as_bytes()));
        let plain =
            |line: &[u8]| (!line.iter().any(|b| matches!(b, b'\r' | 0 | 3 | b'\\'))).then_some(());
        let mut lines = BlockReader::new(Box::new(Slow(text.clone().into_bytes(), 700)));
        let mut expected = whole.iter();
        loop {
            // either way, or none: at the beginning nothing is in the window yet
            match random.below(3) {
                0 => lines.skip_lines(*b"M\\\xC3", |line| !line.contains(&b'Y')),
                1 => while lines.take_line(plain).is_some() {},
                _ => {}
            }
            let Some(block) = lines.next_block().unwrap() else { break };
            let found = (block.text.to_owned(), block.position.line, block.position.offset);
            assert!(expected.any(|block| *block == found), "{seed}: {found:?}");
        }
    }
}
