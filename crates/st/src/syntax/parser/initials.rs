//! Initial values.

use super::super::ast::{Initial, InitialElement};
use super::super::token::Token;
use super::{Parsed, Parser};

impl Parser<'_> {
    /// The initial value that the whole source is; none if there is a problem.
    pub(in crate::syntax) fn whole_initial(mut self) -> Option<Initial> {
        let initial = self.initial().ok()?;
        (self.token() == Token::End && self.problems.is_empty()).then_some(initial)
    }

    /// An initial value: of one variable, `[…]` of an array, or `(x := 1)` of a structure.
    pub(super) fn initial(&mut self) -> Parsed<Initial> {
        let is_struct = self.token() == Token::OpenParenthesis
            && matches!(self.peek(1), Token::Name | Token::Keyword(_))
            && self.peek(2) == Token::Assign;
        match self.token() {
            Token::OpenBracket => self.deeper(Self::array_initial),
            _ if is_struct => self.deeper(Self::struct_initial),
            _ => self.expression().map(Initial::Expression),
        }
    }

    fn array_initial(&mut self) -> Parsed<Initial> {
        let start = self.advance();
        let mut elements = vec![self.element()?];
        while self.accept(Token::Comma) {
            elements.push(self.element()?);
        }
        self.expect(Token::CloseBracket, "`,` or `]` after the initial value of an element")?;
        Ok(Initial::Array { elements, span: self.since(start) })
    }

    /// `5`, or `3(5)` for three of them.
    fn element(&mut self) -> Parsed<InitialElement> {
        let is_number = matches!(self.token(), Token::Integer | Token::Based | Token::Hashed);
        if !is_number || self.peek(1) != Token::OpenParenthesis {
            return Ok(InitialElement { repeat: None, value: self.initial()? });
        }
        let repeat = Some(self.expression()?);
        let is_struct = self.peek(1) == Token::Name && self.peek(2) == Token::Assign;
        if is_struct {
            // `3(x := 1)` means `3((x := 1))`.
            return Ok(InitialElement { repeat, value: self.initial()? });
        }
        self.advance();
        let value = self.initial()?;
        self.expect(Token::CloseParenthesis, "`)` after the initial value that is repeated")?;
        Ok(InitialElement { repeat, value })
    }

    fn struct_initial(&mut self) -> Parsed<Initial> {
        let start = self.advance();
        let mut members = Vec::new();
        loop {
            let name = self.name("the name of a member")?;
            if !self.assign_sign() {
                let problem = self.missing(&format!("`:=` after the member `{}`", name.text));
                return self.fail(problem);
            }
            members.push((name, self.initial()?));
            if !self.accept(Token::Comma) {
                break;
            }
        }
        self.expect(Token::CloseParenthesis, "`,` or `)` after the initial value of a member")?;
        Ok(Initial::Struct { members, span: self.since(start) })
    }
}
