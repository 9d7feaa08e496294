//! Variables: names, members and elements; and calls of them.

use super::super::ast::{Expression, ExpressionKind};
use super::super::token::Token;
use super::{Parsed, Parser, spelling};
use crate::problem::{Problem, Span};

impl Parser<'_> {
    /// A name with everything that follows it: `a.b[1, 2].c`, `f(x)`.
    pub(super) fn variable_or_call(&mut self) -> Parsed<Expression> {
        let start = self.here();
        let name = self.name("a variable")?;
        let mut whole = Expression { kind: ExpressionKind::Name(name.text), span: name.span };
        loop {
            whole = match self.token() {
                Token::Dot => self.member(whole, start)?,
                Token::OpenBracket => self.element_of(whole, start)?,
                Token::OpenParenthesis => {
                    let call = self.call(whole, start)?;
                    let span = call.span;
                    return self.nothing_behind_a_call(Expression { kind: ExpressionKind::Call(call), span });
                }
                Token::Caret => {
                    let problem = Problem::new(self.here(), "pointers are not supported");
                    let is_power = matches!(
                        self.peek(1),
                        Token::Integer | Token::Real | Token::Name | Token::OpenParenthesis
                    );
                    let help =
                        if is_power { "a power is written `**`" } else { spelling::INSTEAD_OF_A_POINTER };
                    return self.fail(problem.help(help));
                }
                _ => return Ok(whole),
            };
        }
    }

    fn member(&mut self, of: Expression, start: Span) -> Parsed<Expression> {
        self.advance();
        self.count_operand()?;
        if self.token() == Token::Integer {
            let bit = self.text(self.here());
            let variable = self.text(of.span);
            let problem = Problem::new(self.here(), format!("a bit cannot be accessed as `.{bit}`"));
            return self.fail(problem.help(format!("use TestABit({variable}, {bit})")));
        }
        let member = self.name("the name of a member after `.`")?;
        let kind = ExpressionKind::Member { of: Box::new(of), member };
        Ok(Expression { kind, span: self.since(start) })
    }

    fn element_of(&mut self, of: Expression, start: Span) -> Parsed<Expression> {
        self.advance();
        let mut indices = vec![self.inner_expression()?];
        while self.accept(Token::Comma) {
            indices.push(self.inner_expression()?);
        }
        self.count_operand()?;
        self.expect(Token::CloseBracket, "`,` or `]` after an index")?;
        let kind = ExpressionKind::Index { of: Box::new(of), indices };
        Ok(Expression { kind, span: self.since(start) })
    }

    fn nothing_behind_a_call(&mut self, call: Expression) -> Parsed<Expression> {
        if !matches!(self.token(), Token::Dot | Token::OpenBracket | Token::OpenParenthesis) {
            return Ok(call);
        }
        let problem = Problem::new(self.here(), "nothing can be selected from the result of a call");
        self.fail(
            problem.help("assign the result to a variable first, or read the output of the function block"),
        )
    }
}
