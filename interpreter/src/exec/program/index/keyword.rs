//! Control statements: their words, partners and closing statements.

use crate::diag::Condition;
use crate::syntax::statement_meant;

/// The beginning of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Keyword {
    If,
    /// `$IF .. $GOTO ..`, which does not open a control block.
    IfGoto,
    ElseIf,
    Else,
    EndIf,
    Switch,
    Case,
    Default,
    EndSwitch,
    For,
    EndFor,
    While,
    EndWhile,
    Do,
    EndDo,
    Repeat,
    Until,
    Break,
    Continue,
    CommentBegin,
    CommentEnd,
    /// `#RT CYCLE`: its statements belong to another language.
    RealTimeBegin,
    RealTimeEnd,
    ConditionalIf,
    ConditionalElse,
    ConditionalEnd,
    /// `%` text inside a main program.
    Remark,
}

impl Keyword {
    /// All keywords, in the order of their codes (`keyword as u8`).
    const ALL: [Self; 27] = [
        Self::If,
        Self::IfGoto,
        Self::ElseIf,
        Self::Else,
        Self::EndIf,
        Self::Switch,
        Self::Case,
        Self::Default,
        Self::EndSwitch,
        Self::For,
        Self::EndFor,
        Self::While,
        Self::EndWhile,
        Self::Do,
        Self::EndDo,
        Self::Repeat,
        Self::Until,
        Self::Break,
        Self::Continue,
        Self::CommentBegin,
        Self::CommentEnd,
        Self::RealTimeBegin,
        Self::RealTimeEnd,
        Self::ConditionalIf,
        Self::ConditionalElse,
        Self::ConditionalEnd,
        Self::Remark,
    ];

    /// The keyword with this code.
    pub(super) fn of_code(code: u8) -> Self {
        Self::ALL.get(usize::from(code)).copied().unwrap_or(Self::Remark)
    }

    /// The statement meant by a word that lacks the blank after it, or is misspelt: then only the block itself is
    /// faulty, not its structure.
    pub(super) fn meant_by(word: &str) -> Option<Self> {
        statement_meant(word).and_then(Self::of_control)
    }

    pub(super) fn of_control(word: &str) -> Option<Self> {
        Some(match word {
            "IF" => Self::If,
            "ELSEIF" => Self::ElseIf,
            "ELSE" => Self::Else,
            "ENDIF" => Self::EndIf,
            "SWITCH" => Self::Switch,
            "CASE" => Self::Case,
            "DEFAULT" => Self::Default,
            "ENDSWITCH" => Self::EndSwitch,
            "FOR" => Self::For,
            "ENDFOR" => Self::EndFor,
            "WHILE" => Self::While,
            "ENDWHILE" => Self::EndWhile,
            "DO" => Self::Do,
            "ENDDO" => Self::EndDo,
            "REPEAT" => Self::Repeat,
            "UNTIL" => Self::Until,
            "BREAK" => Self::Break,
            "CONTINUE" => Self::Continue,
            _ => return None,
        })
    }

    /// Spelling.
    pub(in crate::exec) fn text(self) -> &'static str {
        match self {
            Self::If | Self::IfGoto => "$IF",
            Self::ElseIf => "$ELSEIF",
            Self::Else => "$ELSE",
            Self::EndIf => "$ENDIF",
            Self::Switch => "$SWITCH",
            Self::Case => "$CASE",
            Self::Default => "$DEFAULT",
            Self::EndSwitch => "$ENDSWITCH",
            Self::For => "$FOR",
            Self::EndFor => "$ENDFOR",
            Self::While => "$WHILE",
            Self::EndWhile => "$ENDWHILE",
            Self::Do => "$DO",
            Self::EndDo => "$ENDDO",
            Self::Repeat => "$REPEAT",
            Self::Until => "$UNTIL",
            Self::Break => "$BREAK",
            Self::Continue => "$CONTINUE",
            Self::CommentBegin => "#COMMENT BEGIN",
            Self::CommentEnd => "#COMMENT END",
            Self::RealTimeBegin => "#RT CYCLE",
            Self::RealTimeEnd => "#RT CYCLE END",
            Self::ConditionalIf => "#IF",
            Self::ConditionalElse => "#ELSE",
            Self::ConditionalEnd => "#ENDIF",
            Self::Remark => "%",
        }
    }

    /// Whether the blocks up to its end are ignored.
    pub(in crate::exec) fn is_silent(self) -> bool {
        matches!(self, Self::CommentBegin | Self::RealTimeBegin)
    }

    /// The closing statement of a statement that opens a block.
    pub(in crate::exec) fn closer(self) -> Option<Self> {
        Some(match self {
            Self::If => Self::EndIf,
            Self::Switch => Self::EndSwitch,
            Self::For => Self::EndFor,
            Self::While => Self::EndWhile,
            Self::Do => Self::EndDo,
            Self::Repeat => Self::Until,
            Self::ConditionalIf => Self::ConditionalEnd,
            _ => return None,
        })
    }

    /// The opening statement of a clause or a closing statement.
    pub(super) fn opener(self) -> Option<Self> {
        Some(match self {
            Self::ElseIf | Self::Else | Self::EndIf => Self::If,
            Self::Case | Self::Default | Self::EndSwitch => Self::Switch,
            Self::EndFor => Self::For,
            Self::EndWhile => Self::While,
            Self::EndDo => Self::Do,
            Self::Until => Self::Repeat,
            Self::ConditionalElse | Self::ConditionalEnd => Self::ConditionalIf,
            _ => return None,
        })
    }

    /// The message for a clause or a closing statement that does not match the innermost open statement. Source: TF5200
    /// diagnosis manual, 20214 to 20244; those of `$ENDDO` and `$UNTIL` were not found.
    pub(super) fn unexpected(self) -> Condition {
        match self {
            Self::Else => Condition::ElseWithoutIf,
            Self::ElseIf => Condition::ElseIfWithoutIf,
            Self::EndIf => Condition::EndIfWithoutIf,
            Self::Case => Condition::CaseWithoutSwitch,
            Self::Default => Condition::DefaultWithoutSwitch,
            Self::EndSwitch => Condition::EndSwitchWithoutSwitch,
            Self::EndFor => Condition::EndForWithoutFor,
            Self::EndWhile => Condition::EndWhileWithoutWhile,
            _ => Condition::Syntax,
        }
    }

    pub(in crate::exec) fn is_loop(self) -> bool {
        matches!(self, Self::For | Self::While | Self::Do | Self::Repeat)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_those_of_the_keywords() {
        for (code, keyword) in (0..).zip(Keyword::ALL) {
            assert_eq!(keyword as u8, code);
            assert_eq!(Keyword::of_code(code), keyword);
        }
        assert_eq!(Keyword::Remark as usize + 1, Keyword::ALL.len());
    }
}
