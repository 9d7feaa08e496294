//! Calls and their arguments.

use super::super::ast::{Argument, Call, Expression};
use super::super::keyword::Keyword;
use super::super::token::Token;
use super::{Parsed, Parser};
use crate::problem::Span;

impl Parser<'_> {
    /// The arguments after `callee`, which began at `start`.
    pub(super) fn call(&mut self, callee: Expression, start: Span) -> Parsed<Call> {
        self.advance();
        let mut arguments = Vec::new();
        if self.token() != Token::CloseParenthesis {
            arguments.push(self.argument()?);
            while self.accept(Token::Comma) {
                arguments.push(self.argument()?);
            }
        }
        self.expect(Token::CloseParenthesis, "`,` or `)` after an argument")?;
        Ok(Call { callee: Box::new(callee), arguments, span: self.since(start) })
    }

    fn argument(&mut self) -> Parsed<Argument> {
        let negated = self.at(Keyword::Not) && self.peek(1) == Token::Name && self.peek(2) == Token::Arrow;
        if negated {
            self.advance();
        }
        match self.peek(1) {
            Token::Arrow => {
                let name = self.name("the name of an output")?;
                self.advance();
                let is_left_aside = matches!(self.token(), Token::Comma | Token::CloseParenthesis);
                let to = if is_left_aside { None } else { Some(self.inner_expression()?) };
                Ok(Argument::Output { name, negated, to })
            }
            Token::Assign => {
                let name = self.name("the name of an input")?;
                self.advance();
                Ok(Argument::Input { name, value: self.inner_expression()? })
            }
            _ => self.inner_expression().map(Argument::Positional),
        }
    }
}
