//! Expressions: operators and their operands.

use super::super::ast::{BinaryOperator, Expression, ExpressionKind, Literal, Name, UnaryOperator};
use super::super::keyword::Keyword;
use super::super::literal;
use super::super::token::Token;
use super::{OPERANDS_MAX, Parsed, Parser};
use crate::problem::{Problem, Span};

impl Parser<'_> {
    /// Reads a complete expression.
    pub(super) fn expression(&mut self) -> Parsed<Expression> {
        self.operands = 0;
        self.inner_expression()
    }

    /// Reads an expression inside another one.
    pub(super) fn inner_expression(&mut self) -> Parsed<Expression> {
        self.deeper(|parser| parser.binary(0))
    }

    /// Operators from `strength` upward; those of the same strength associate to the left. IEC 61131-3, table 71.
    fn binary(&mut self, strength: u8) -> Parsed<Expression> {
        let start = self.here();
        let mut left = self.unary()?;
        while let Some((operator, found)) = self.binary_operator().filter(|(_, found)| *found >= strength) {
            self.advance();
            let right = Box::new(self.binary(found + 1)?);
            let kind = ExpressionKind::Binary { operator, left: Box::new(left), right };
            left = Expression { kind, span: self.since(start) };
        }
        Ok(left)
    }

    /// The operator at this position, and its precedence.
    fn binary_operator(&self) -> Option<(BinaryOperator, u8)> {
        Some(match self.token() {
            Token::Keyword(Keyword::Or) => (BinaryOperator::Or, 1),
            Token::Keyword(Keyword::Xor) => (BinaryOperator::Xor, 2),
            Token::Keyword(Keyword::And) | Token::Ampersand => (BinaryOperator::And, 3),
            Token::Equal => (BinaryOperator::Equal, 4),
            Token::NotEqual => (BinaryOperator::NotEqual, 4),
            Token::Less => (BinaryOperator::Less, 5),
            Token::LessOrEqual => (BinaryOperator::LessOrEqual, 5),
            Token::Greater => (BinaryOperator::Greater, 5),
            Token::GreaterOrEqual => (BinaryOperator::GreaterOrEqual, 5),
            Token::Plus => (BinaryOperator::Add, 6),
            Token::Minus => (BinaryOperator::Subtract, 6),
            Token::Star => (BinaryOperator::Multiply, 7),
            Token::Slash => (BinaryOperator::Divide, 7),
            Token::Keyword(Keyword::Mod) => (BinaryOperator::Modulo, 7),
            Token::Power => (BinaryOperator::Power, 8),
            _ => return None,
        })
    }

    /// A sign or NOT has a higher precedence than every operator between two operands.
    fn unary(&mut self) -> Parsed<Expression> {
        let start = self.here();
        let operator = match self.token() {
            Token::Minus => UnaryOperator::Minus,
            Token::Plus => UnaryOperator::Plus,
            Token::Keyword(Keyword::Not) if !self.names_an_input() => UnaryOperator::Not,
            _ => return self.operand(),
        };
        self.advance();
        let operand = Box::new(self.deeper(Self::unary)?);
        Ok(Expression { kind: ExpressionKind::Unary { operator, operand }, span: self.since(start) })
    }

    fn operand(&mut self) -> Parsed<Expression> {
        self.count_operand()?;
        let span = self.here();
        match self.token() {
            Token::Name => self.variable_or_call(),
            Token::OpenParenthesis => self.parenthesized(),
            Token::Hashed => self.hashed(),
            Token::Integer => self.number(literal::integer),
            Token::Based => self.number(literal::based),
            Token::Real => self.number(literal::real),
            Token::BadNumber => {
                let problem = bad_number(self.text(span), span);
                self.tell(problem);
                Ok(self.literal(Literal::Integer(0)))
            }
            Token::String => {
                let bytes = self.string_literal(span).unwrap_or_default();
                Ok(self.literal(Literal::String(bytes)))
            }
            Token::OpenString => Ok(self.literal(Literal::String(Vec::new()))),
            Token::Keyword(Keyword::True) => Ok(self.literal(Literal::Bool(true))),
            Token::Keyword(Keyword::False) => Ok(self.literal(Literal::Bool(false))),
            Token::Keyword(Keyword::And | Keyword::Or | Keyword::Xor | Keyword::Mod | Keyword::Not)
            | Token::Ampersand
                if self.peek(1) == Token::OpenParenthesis =>
            {
                self.operator_called()
            }
            _ => {
                let problem = self.no_operand();
                self.fail(problem)
            }
        }
    }

    /// `(In := …` after the token at this position: a call, not an expression in parentheses.
    fn names_an_input(&self) -> bool {
        [1, 2, 3].map(|ahead| self.peek(ahead)) == [Token::OpenParenthesis, Token::Name, Token::Assign]
    }

    /// An operator as a function: `AND(a, b, c)`.
    fn operator_called(&mut self) -> Parsed<Expression> {
        let name = if self.token() == Token::Ampersand { "AND" } else { self.text(self.here()) };
        let span = self.advance();
        let callee = Expression { kind: ExpressionKind::Name(name.to_owned()), span };
        let call = self.call(callee, span)?;
        let span = call.span;
        Ok(Expression { kind: ExpressionKind::Call(call), span })
    }

    /// Limits the tree of one expression.
    pub(super) fn count_operand(&mut self) -> Parsed<()> {
        self.operands += 1;
        if self.operands <= OPERANDS_MAX {
            return Ok(());
        }
        let message = format!("an expression of more than {OPERANDS_MAX} operands");
        self.fail(Problem::new(self.here(), message).help("divide it among several assignments"))
    }

    /// The literal of the token at this position.
    fn literal(&mut self, literal: Literal) -> Expression {
        let span = self.advance();
        Expression { kind: ExpressionKind::Literal(literal), span }
    }

    /// A number that does not fit is reported, and replaced by 0.
    fn number(&mut self, read: impl FnOnce(&str, Span) -> Result<Literal, Problem>) -> Parsed<Expression> {
        let span = self.here();
        let literal = read(self.text(span), span).unwrap_or_else(|problem| {
            self.tell(problem);
            Literal::Integer(0)
        });
        Ok(self.literal(literal))
    }

    fn parenthesized(&mut self) -> Parsed<Expression> {
        self.advance();
        let inner = self.inner_expression()?;
        let inner = self.comparison_for_assignment(inner)?;
        self.expect(Token::CloseParenthesis, "`)` or an operator after the expression in parentheses")?;
        Ok(inner)
    }

    /// `:=` where only a comparison is possible: reported, and read as `=`.
    pub(super) fn comparison_for_assignment(&mut self, left: Expression) -> Parsed<Expression> {
        let here = self.here();
        if !self.accept(Token::Assign) {
            return Ok(left);
        }
        self.tell(Problem::new(here, "`:=` inside an expression").help("a comparison is written `=`"));
        let right = Box::new(self.inner_expression()?);
        let span = left.span.to(right.span);
        let kind = ExpressionKind::Binary { operator: BinaryOperator::Equal, left: Box::new(left), right };
        Ok(Expression { kind, span })
    }

    /// A name followed by `#`: a literal with its type, or an enumeration value.
    fn hashed(&mut self) -> Parsed<Expression> {
        let span = self.here();
        let (prefix, rest) = self.text(span).split_once('#').unwrap_or_default();
        if prefix.eq_ignore_ascii_case("STRING") && rest.is_empty() && self.peek(1) == Token::String {
            self.advance();
            let bytes = self.string_literal(self.here()).unwrap_or_default();
            let literal = self.literal(Literal::String(bytes));
            return Ok(Expression { span: self.since(span), ..literal });
        }
        let is_word = rest.starts_with(|first: char| first.is_alphabetic() || first == '_');
        if let Some(instead) = literal::instead_of(prefix).filter(|_| !is_word) {
            let message = format!("{} literals are not supported", prefix.to_ascii_uppercase());
            return self.fail(Problem::new(span, message).help(format!("write {instead}")));
        }
        if is_word && !literal::is_literal_prefix(prefix) {
            self.advance();
            return Ok(enum_value(prefix, rest, span));
        }
        self.number(|_, span| literal::typed(prefix, rest, span))
    }

    /// The problem that there is no operand at this position.
    fn no_operand(&self) -> Problem {
        let span = self.here();
        match self.token() {
            Token::Direct => Problem::new(span, "directly represented variables are not supported")
                .help("use AT IOBus://… or the variable's name"),
            Token::OpenBracket => Problem::new(span, "a list in brackets has no place here")
                .help("it can be the initial value of an ARRAY"),
            Token::Dot => {
                self.missing("a number").help("a real number has digits on both sides of its point")
            }
            _ if self.place == 0 => self.missing("an expression"),
            _ => {
                let before = self.text(self.previous());
                let shown: String = before.chars().take(40).collect();
                let is_tested = matches!(
                    self.peek_before(),
                    Some(Token::Keyword(Keyword::If | Keyword::Elsif | Keyword::While | Keyword::Until))
                );
                let what = if is_tested { "a condition" } else { "an expression" };
                self.missing(&format!("{what} after `{shown}`"))
            }
        }
    }
}

fn enum_value(prefix: &str, rest: &str, span: Span) -> Expression {
    let first = Span::from(0..prefix.len()).end;
    let type_name =
        Name { text: prefix.to_owned(), span: Span { start: span.start, end: span.start + first } };
    let value = Name { text: rest.to_owned(), span: Span { start: span.start + first + 1, end: span.end } };
    Expression { kind: ExpressionKind::EnumValue { type_name, value }, span }
}

fn bad_number(text: &str, span: Span) -> Problem {
    let problem = Problem::new(span, format!("`{text}` is neither a number nor a name"));
    let lower = text.to_ascii_lowercase();
    match (lower.strip_prefix("0x"), lower.strip_prefix("0b")) {
        (Some(digits), _) => {
            problem.help(format!("to the base 16 it is written `16#{}`", digits.to_ascii_uppercase()))
        }
        (None, Some(digits)) => problem.help(format!("to the base 2 it is written `2#{digits}`")),
        _ if lower.ends_with(['s', 'm', 'h', 'd']) => {
            problem.help(format!("a duration is written `T#{lower}`"))
        }
        _ => problem.help("a name does not begin with a digit"),
    }
}
