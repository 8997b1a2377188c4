//! Data types of the values in lists, and ends of ranges.

/// Data type of a value in a list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Raw {
    /// Unsigned, 8 bits.
    Uns08,
    /// Unsigned, 16 bits.
    Uns16,
    /// Unsigned, 32 bits.
    Uns32,
    /// Signed, 8 bits.
    Sgn08,
    /// Signed, 16 bits.
    Sgn16,
    /// Signed, 32 bits.
    Sgn32,
    /// Floating point, 64 bits.
    Real64,
    /// 0 or 1.
    Boolean,
    /// Any text.
    Text,
    /// A block of an NC program: the rest of the line.
    Code,
    /// One of these words.
    Word(&'static [&'static str]),
    /// A number or the name of a number.
    Names(&'static [(&'static str, u32)]),
    /// A number or names joined by `|`.
    Flags(&'static [(&'static str, u32)]),
}

impl Raw {
    /// Smallest and largest value of the data type; `None` for texts.
    pub fn limits(self) -> Option<(f64, f64)> {
        match self {
            Self::Uns08 => Some((0.0, 255.0)),
            Self::Uns16 => Some((0.0, 65535.0)),
            Self::Uns32 | Self::Names(_) | Self::Flags(_) => Some((0.0, 4294967295.0)),
            Self::Sgn08 => Some((-128.0, 127.0)),
            Self::Sgn16 => Some((-32768.0, 32767.0)),
            Self::Sgn32 => Some((-2147483648.0, 2147483647.0)),
            Self::Real64 => Some((f64::MIN, f64::MAX)),
            Self::Boolean => Some((0.0, 1.0)),
            Self::Text | Self::Code | Self::Word(_) => None,
        }
    }

    /// Name as the vendor prints it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uns08 => "UNS08",
            Self::Uns16 => "UNS16",
            Self::Uns32 => "UNS32",
            Self::Sgn08 => "SGN08",
            Self::Sgn16 => "SGN16",
            Self::Sgn32 => "SGN32",
            Self::Real64 => "REAL64",
            Self::Boolean => "BOOLEAN",
            Self::Text | Self::Code | Self::Word(_) => "STRING",
            Self::Names(_) => "UNS32 (names accepted)",
            Self::Flags(_) => "STRING (flags, numbers accepted)",
        }
    }
}

/// One end of a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Limited by the data type only.
    None,
    /// This value is permitted.
    At(f64),
    /// This value is no longer permitted.
    Beyond(f64),
    /// The value of another parameter is permitted.
    Of(&'static str),
    /// The value of another parameter is no longer permitted.
    BeyondOf(&'static str),
    /// A multiple of another parameter is permitted.
    Times(f64, &'static str),
    /// The smallest of several parameters is permitted.
    LeastOf(&'static [&'static str]),
    /// The largest of several parameters is permitted.
    GreatestOf(&'static [&'static str]),
    /// This number of cycles, in us, is no longer permitted.
    BeyondCycles(f64),
    /// Depends on other words of the function; checked where the function is set up.
    Text(&'static str),
}

impl std::fmt::Display for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Self::None => write!(f, "limit of the data type"),
            Self::At(x) => write!(f, "{x}"),
            Self::Beyond(x) => write!(f, "{x} (excluded)"),
            Self::Of(id) => write!(f, "{id}"),
            Self::BeyondOf(id) => write!(f, "{id} (excluded)"),
            Self::Times(k, id) => write!(f, "{k} x {id}"),
            Self::LeastOf(ids) => write!(f, "smallest of {}", ids.join(", ")),
            Self::GreatestOf(ids) => write!(f, "largest of {}", ids.join(", ")),
            Self::BeyondCycles(n) => write!(f, "{n} cycles (excluded)"),
            Self::Text(text) => write!(f, "{text}"),
        }
    }
}
