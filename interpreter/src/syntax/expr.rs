//! Expressions: turns the flat chain of the grammar into a tree, by precedence.

use super::ast::{
    Binary, BinaryOp, Expr, ExprKind, Function, FunctionCall, ParameterIndex, Place, PlaceKind,
    Segment,
};
use super::build::Builder;
use super::problem::Problem;
use super::{OPERATORS_MAX, Rule, number};
use crate::diag::Condition;
use pest::iterators::Pair;

impl BinaryOp {
    /// Level of precedence, 1 (lowest) to 10.
    ///
    /// Assumption: the order of the operators follows C where the programming manual's table could not be read, with
    /// `XOR` between `||` and `&&`.
    pub(crate) fn precedence(self) -> u8 {
        match self {
            Self::Or => 1,
            Self::Xor => 2,
            Self::And => 3,
            Self::Equal
            | Self::NotEqual
            | Self::Less
            | Self::LessEqual
            | Self::Greater
            | Self::GreaterEqual => 4,
            Self::BitOr => 5,
            Self::BitXor => 6,
            Self::BitAnd => 7,
            Self::Add | Self::Subtract => 8,
            Self::Multiply | Self::Divide | Self::Modulo => 9,
            Self::Power => 10,
        }
    }

    /// Whether it is one of `== != < <= > >=`, which cannot be chained.
    pub(crate) fn is_comparison(self) -> bool {
        self.precedence() == Self::Equal.precedence()
    }

    /// The symbol of the operator, or its word if it has no symbol.
    pub(crate) fn symbol(self) -> &'static str {
        match self {
            Self::Or => "||",
            Self::Xor => "XOR",
            Self::And => "&&",
            Self::Equal => "==",
            Self::NotEqual => "!=",
            Self::Less => "<",
            Self::LessEqual => "<=",
            Self::Greater => ">",
            Self::GreaterEqual => ">=",
            Self::BitOr => "|",
            Self::BitXor => "^",
            Self::BitAnd => "&",
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Modulo => "MOD",
            Self::Power => "**",
        }
    }

    /// The operator of a text accepted by the grammar.
    pub(in crate::syntax) fn from_text(text: &str) -> Self {
        match text.to_ascii_uppercase().as_str() {
            "||" | "OR" => Self::Or,
            "XOR" => Self::Xor,
            "&&" | "AND" => Self::And,
            "==" => Self::Equal,
            "!=" => Self::NotEqual,
            "<" => Self::Less,
            "<=" => Self::LessEqual,
            ">" => Self::Greater,
            ">=" => Self::GreaterEqual,
            "|" => Self::BitOr,
            "^" => Self::BitXor,
            "&" => Self::BitAnd,
            "+" => Self::Add,
            "-" => Self::Subtract,
            "*" => Self::Multiply,
            "/" => Self::Divide,
            "MOD" => Self::Modulo,
            _ => Self::Power,
        }
    }
}

impl Builder<'_> {
    /// `expression` or `chain`: a sequence of signs, atoms and operators.
    pub(super) fn expression(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let mut operands = Vec::new();
        let mut operators: Vec<BinaryOp> = Vec::new();
        let mut last = None;
        let mut signs = Signs::default();
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::sign => signs.push(&part),
                Rule::operator => {
                    let op = BinaryOp::from_text(part.as_str());
                    self.count_operator(&part);
                    operands.extend(last.take());
                    while let Some(top) = operators.last().copied() {
                        if top.precedence() < op.precedence() {
                            break;
                        }
                        if top.is_comparison() && op.is_comparison() {
                            let span = self.span(&part);
                            let text = "comparisons cannot be chained";
                            self.report(Problem::syntax(span, text).hint("join them with `&&`"));
                        }
                        operators.pop();
                        reduce(&mut operands, top);
                    }
                    operators.push(op);
                }
                _ => {
                    let atom = self.atom(part);
                    last = Some(std::mem::take(&mut signs).apply(atom));
                }
            }
        }
        operands.extend(last);
        while let Some(op) = operators.pop() {
            reduce(&mut operands, op);
        }
        operands.pop().unwrap_or_else(Builder::zero)
    }

    /// `signed_number`.
    pub(super) fn signed_number(&mut self, pair: Pair<'_, Rule>) -> Expr {
        self.expression(pair)
    }

    fn count_operator(&mut self, pair: &Pair<'_, Rule>) {
        self.operators += 1;
        if self.operators == OPERATORS_MAX + 1 {
            let text = format!("more than {OPERATORS_MAX} operators in one block");
            let span = self.span(pair);
            self.report(Problem::new(Condition::Nesting, span, text));
        }
    }

    fn atom(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.span(&pair);
        let kind = match pair.as_rule() {
            Rule::decimal => {
                ExprKind::Number(number::decimal(pair.as_str()).unwrap_or_else(|| {
                    self.report(Problem::syntax(
                        span,
                        "number outside the range of 64-bit floating point",
                    ));
                    f64::MAX
                }))
            }
            Rule::constant => match pair.as_str().to_ascii_uppercase().as_str() {
                "TRUE" => ExprKind::Bool(true),
                "FALSE" => ExprKind::Bool(false),
                "R1" => ExprKind::Radius,
                _ => ExprKind::Pi,
            },
            Rule::string => ExprKind::Text(self.string(&pair)),
            Rule::function => self.function(pair),
            Rule::place => ExprKind::Place(Box::new(self.place(pair))),
            Rule::group => {
                return self.bracket(pair).unwrap_or_else(|_| {
                    self.report_list(span);
                    Expr { span, ..Builder::zero() }
                });
            }
            _ => {
                let inner = pair.into_inner().find(|p| p.as_rule() == Rule::expression);
                let inner = inner.map_or_else(Builder::zero, |p| self.expression(p));
                return Expr { span, ..inner };
            }
        };
        Expr { kind, span }
    }

    fn function(&mut self, pair: Pair<'_, Rule>) -> ExprKind {
        let mut function = Function::Abs;
        let mut arguments = Vec::new();
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::function_name => {
                    function = Function::from_name(part.as_str()).unwrap_or(function);
                }
                Rule::exist_name => function = Function::Exist,
                Rule::listed_code => arguments.push(self.listed_code(&part)),
                Rule::expression => arguments.push(self.expression(part)),
                _ => {}
            }
        }
        ExprKind::Call(Box::new(FunctionCall { function, arguments }))
    }

    /// `listed_code`.
    fn listed_code(&self, pair: &Pair<'_, Rule>) -> Expr {
        let (letter, digits) = pair.as_str().split_at(1);
        let number = digits.parse().unwrap_or(u32::MAX);
        let kind = match letter {
            "M" | "m" => ExprKind::MFunction(number),
            _ => ExprKind::HFunction(number),
        };
        Expr { kind, span: self.span(pair) }
    }

    /// `place`.
    pub(super) fn place(&mut self, pair: Pair<'_, Rule>) -> Place {
        let span = self.span(&pair);
        let kind = match pair.into_inner().next() {
            Some(inner) => self.place_kind(inner),
            None => PlaceKind::Variable(Vec::new()),
        };
        Place { kind, span }
    }

    /// `parameter`, `variable` or `cycle_place`.
    pub(super) fn place_kind(&mut self, pair: Pair<'_, Rule>) -> PlaceKind {
        match pair.as_rule() {
            Rule::parameter => self.parameter(pair),
            Rule::variable => {
                PlaceKind::Variable(pair.into_inner().map(|p| self.segment(p)).collect())
            }
            _ => PlaceKind::Cycle(pair.as_str()[1..].to_ascii_uppercase().into()),
        }
    }

    fn parameter(&mut self, pair: Pair<'_, Rule>) -> PlaceKind {
        let mut indirections = 0;
        let mut index = None;
        let mut subscripts = Vec::new();
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::indirection => indirections += 1,
                Rule::digits => {
                    index =
                        Some(ParameterIndex::Literal(part.as_str().parse().unwrap_or(u32::MAX)));
                }
                Rule::index => {
                    let value = self.index(part);
                    if index.is_none() {
                        index = Some(ParameterIndex::Computed(Box::new(value)));
                    } else {
                        subscripts.push(value);
                    }
                }
                _ => {}
            }
        }
        let index = index.unwrap_or(ParameterIndex::Literal(0));
        PlaceKind::Parameter { indirections, index, subscripts }
    }

    fn segment(&mut self, pair: Pair<'_, Rule>) -> Segment {
        let mut name = "";
        let mut subscripts = Vec::new();
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::segment_name => name = part.as_str(),
                _ => subscripts.push(self.index(part)),
            }
        }
        Segment { name: name.into(), subscripts }
    }

    /// `index`: the expression between brackets.
    pub(super) fn index(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.span(&pair);
        let inner = pair.into_inner().find(|p| p.as_rule() == Rule::expression);
        Expr { span, ..inner.map_or_else(Builder::zero, |p| self.expression(p)) }
    }

    /// Placeholder for an expression that the grammar guarantees; not reached.
    pub(super) fn zero() -> Expr {
        Expr { kind: ExprKind::Number(0.0), span: super::ast::Span::default() }
    }
}

/// Signs before an atom.
#[derive(Default)]
struct Signs {
    negative: bool,
    start: Option<u32>,
}

impl Signs {
    fn push(&mut self, pair: &Pair<'_, Rule>) {
        self.negative ^= pair.as_str() == "-";
        let at = u32::try_from(pair.as_span().start()).unwrap_or(u32::MAX);
        self.start.get_or_insert(at);
    }

    fn apply(self, atom: Expr) -> Expr {
        let mut span = atom.span;
        if let Some(start) = self.start {
            span = super::ast::Span { start, len: span.end() - start };
        }
        let kind = match atom.kind {
            kind if !self.negative => kind,
            ExprKind::Number(v) => ExprKind::Number(-v),
            ExprKind::Negate(inner) => inner.kind,
            kind => ExprKind::Negate(Box::new(Expr { kind, span: atom.span })),
        };
        Expr { kind, span }
    }
}

fn reduce(operands: &mut Vec<Expr>, op: BinaryOp) {
    if let (Some(right), Some(left)) = (operands.pop(), operands.pop()) {
        let span = left.span.to(right.span);
        let kind = ExprKind::Binary(Box::new(Binary { op, left, right }));
        operands.push(Expr { kind, span });
    }
}
