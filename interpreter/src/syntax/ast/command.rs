//! Commands: words, switches and groups of keys.

use super::{Expr, ParameterIndex, Place, PlaceKind, Span, Word};

/// A name with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ident {
    /// Text; see the module documentation for its case.
    pub text: Box<str>,
    /// Place.
    pub span: Span,
}

impl Ident {
    /// Compares without regard to case.
    pub fn is(&self, other: &str) -> bool {
        self.text.eq_ignore_ascii_case(other)
    }

    /// Splits a name written together with a number, `ID455` or `REV1000.5`, into both.
    pub(crate) fn split_number(&self) -> Option<(&str, f64)> {
        let at = self.text.find(|c: char| c.is_ascii_digit() || c == '.')?;
        let (name, number) = self.text.split_at(at);
        let plain = number.bytes().all(|b| b.is_ascii_digit() || b == b'.');
        if name.is_empty() || !plain {
            return None;
        }
        number.parse().ok().map(|value| (name, value))
    }

    /// Splits a name written together with a parameter, `IDP100`, into both.
    pub(crate) fn split_parameter(&self) -> Option<(&str, Place)> {
        let at = self.text.rfind(['P', 'p']).filter(|at| *at > 0)?;
        let (name, parameter) = self.text.split_at(at);
        let digits = parameter[1..].bytes().all(|b| b.is_ascii_digit());
        let number = parameter[1..].parse().ok().filter(|_| digits)?;
        let index = ParameterIndex::Literal(number);
        let kind = PlaceKind::Parameter { indirections: 0, index, subscripts: Vec::new() };
        Some((name, Place { kind, span: self.span }))
    }
}

/// Plain-text command: `#NAME WORDS [ON|OFF] [WORDS] [arguments | bracket groups]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// Words up to `ON`/`OFF` or the first argument, in upper case: `["VIB", "GUARD"]`.
    pub words: Vec<Ident>,
    /// `ON` (true) or `OFF` (false) after the words.
    pub on: Option<bool>,
    /// Words after `ON`/`OFF`: `ALL` of `#CS OFF ALL`; in upper case.
    pub tail: Vec<Ident>,
    /// Values without bracket: `#TIME 2.5`, `#WAIT FOR V.E.A == 1`, `#DELETE V.P.A, V.P.B`.
    pub arguments: Vec<Expr>,
    /// Bracket groups: `#CS DEF[1][0,0,0]` has two.
    pub groups: Vec<Group>,
    /// Words of the program behind it in its block, as `F500` in `#SLOPE [TYPE=STEP] F500`: an error (20450), after which a
    /// check goes on with them.
    pub behind: Vec<Word>,
    /// Place.
    pub span: Span,
}

impl Command {
    /// Whether it belongs to conditional text: `#IF`, `#ELSE`, `#ENDIF`. What is behind these is reported with the structure of the
    /// file.
    pub(crate) fn is_conditional(&self) -> bool {
        self.words.first().is_some_and(|word| matches!(&*word.text, "IF" | "ELSE" | "ENDIF"))
    }

    /// Place of the first word behind the name that is one of the program, as `X5` in `#TRAFO OFF X5`, or its letter, as in
    /// `#SCENE F=500`: no command has words of a letter and a number.
    pub(crate) fn word_behind(&self) -> Option<Span> {
        let with_number = |word: &&Ident| {
            let mut letters = word.text.bytes();
            letters.next().is_some_and(|b| b.is_ascii_alphabetic())
                && letters.next().is_some_and(|b| b.is_ascii_digit())
        };
        let mut words = self.words.iter().skip(1).chain(&self.tail);
        let letter = words.clone().next_back().filter(|word| word.text.len() == 1);
        let letter = letter.filter(|_| !self.arguments.is_empty());
        words.find(with_number).or(letter).map(|word| word.span)
    }

    /// Whether the words up to `ON`/`OFF` are exactly these (`"CONTOUR MODE"`: separated by one blank).
    pub fn is(&self, name: &str) -> bool {
        let mut words = self.words.iter();
        name.split(' ').all(|part| words.next().is_some_and(|word| &*word.text == part))
            && words.next().is_none()
    }

    /// The words up to `ON`/`OFF`, separated by one blank.
    pub fn name(&self) -> String {
        let mut name = String::new();
        for word in &self.words {
            if !name.is_empty() {
                name.push(' ');
            }
            name.push_str(&word.text);
        }
        name
    }
}

/// Contents of a bracket. Commas, equals signs and `|` between items are not kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Items in written order.
    pub items: Vec<Item>,
    /// Place, brackets included.
    pub span: Span,
}

impl Group {
    /// The first value of a key (upper case).
    pub fn get(&self, key: &str) -> Option<&ItemValue> {
        self.items.iter().find_map(|item| match &item.kind {
            ItemKind::Pair { key: k, value } if &*k.text == key => Some(value),
            _ => None,
        })
    }

    /// Whether the flag (upper case) is written.
    pub fn has(&self, flag: &str) -> bool {
        self.items.iter().any(|item| matches!(&item.kind, ItemKind::Flag(f) if f.is(flag)))
    }
}

/// One item of a bracket.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Kind.
    pub kind: ItemKind,
    /// Place.
    pub span: Span,
}

/// Kind of an item.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// A word alone: `DEV`, `BSPLINE`, `X`, `ID455`; as written.
    Flag(Ident),
    /// `KEY=value`, `KEY value`; `@P1=5` has the key `@P1`. The key is in upper case.
    Pair {
        /// Key.
        key: Ident,
        /// Value.
        value: ItemValue,
    },
    /// A variable that receives a value: `P1=X`, `V.P.POS=Z` of `#GET CMDPOS`.
    Target {
        /// The variable.
        place: Place,
        /// The value it receives.
        value: ItemValue,
    },
    /// A value alone: `["text", P1]`, `[0,0,0]`.
    Value(ItemValue),
    /// An empty item between two commas.
    Missing,
}

/// Value of an item.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemValue {
    /// Expression or string.
    Expr(Expr),
    /// Identifier: `TYPE=HSC`, `AX=Z`, `NAME=file.nc`; as written.
    Name(Ident),
    /// Nested list.
    List(Group),
}
