//! Control statements, program heads and declarations.

use super::{Expr, Ident, ItemValue, Jump, Place, Span};

/// Control statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// Kind.
    pub kind: ControlKind,
    /// Place.
    pub span: Span,
}

/// Kind of a control statement.
#[derive(Clone, Debug, PartialEq)]
pub enum ControlKind {
    /// `$IF condition`; with `$GOTO target` on the same line, the statement has no `$ENDIF`.
    If {
        /// Condition.
        condition: Expr,
        /// Target of `$IF condition $GOTO target`.
        goto: Option<Jump>,
    },
    /// `$ELSEIF condition`.
    ElseIf(Expr),
    /// `$ELSE`.
    Else,
    /// `$ENDIF`.
    EndIf,
    /// `$SWITCH value`, `$SWITCH P1=value`.
    Switch {
        /// Parameter or variable that is assigned as well.
        target: Option<Place>,
        /// Value.
        value: Expr,
    },
    /// `$CASE value`.
    Case(Expr),
    /// `$DEFAULT`.
    Default,
    /// `$ENDSWITCH`.
    EndSwitch,
    /// `$FOR counter = start, end, step`; the older form has no step.
    For {
        /// Counter.
        counter: Place,
        /// First value.
        start: Expr,
        /// Last value, included.
        end: Expr,
        /// Step.
        step: Option<Expr>,
    },
    /// `$ENDFOR`.
    EndFor,
    /// `$WHILE condition`.
    While(Expr),
    /// `$ENDWHILE`.
    EndWhile,
    /// `$DO`.
    Do,
    /// `$ENDDO`, `$ENDDO condition`.
    EndDo(Option<Expr>),
    /// `$REPEAT`.
    Repeat,
    /// `$UNTIL condition`.
    Until(Expr),
    /// `$BREAK`.
    Break,
    /// `$CONTINUE`.
    Continue,
}

/// Head of a program or local subroutine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramHead {
    /// `%L NAME`.
    pub local: bool,
    /// First word after the head, as written; `% a remark` has the name `a`.
    pub name: Option<Ident>,
    /// Everything after `%` or `%L`, without comment and blanks at the ends.
    pub text: Box<str>,
}

/// One line between `#VAR` and `#ENDVAR`.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// The variable declared; its subscripts are the sizes of the dimensions.
    pub place: Place,
    /// Type (`UNS32`, `STRING`), in upper case.
    pub type_name: Option<Ident>,
    /// `20` of `STRING[20]`.
    pub length: Option<Expr>,
    /// Initial value; a list for arrays.
    pub value: Option<ItemValue>,
    /// Place of the declaration.
    pub span: Span,
}
