//! FOR, WHILE and REPEAT.

use super::super::super::ast::{Expression, StatementKind};
use super::super::super::keyword::Keyword;
use super::super::super::token::Token;
use super::super::{Parsed, Parser};
use super::Place;
use crate::problem::Problem;

/// The part between FOR and DO.
struct ForHead {
    variable: Expression,
    from: Expression,
    to: Expression,
    by: Option<Expression>,
}

impl Parser<'_> {
    /// A FOR whose head cannot be read becomes an empty statement; its body is checked nevertheless.
    pub(super) fn for_statement(&mut self) -> StatementKind {
        self.open(Keyword::For);
        let head = self.for_head();
        match &head {
            Ok(head) => {
                let last = if head.by.is_some() { "step" } else { "end value" };
                self.ending(Keyword::Do, &format!("after the {last} of FOR"));
            }
            Err(_) => self.recover_behind(Keyword::Do),
        }
        let body = self.statements(Place::Body);
        self.close();
        head.map_or(StatementKind::Empty, |ForHead { variable, from, to, by }| StatementKind::For {
            variable,
            from,
            to,
            by,
            body,
        })
    }

    fn for_head(&mut self) -> Parsed<ForHead> {
        self.operands = 0;
        if self.token() != Token::Name {
            self.name("a variable after FOR")?;
        }
        let variable = self.variable_or_call()?;
        let sign = self.here();
        if self.accept(Token::Equal) {
            self.tell_assignment(sign);
        } else {
            self.expect(Token::Assign, "`:=` after the variable of FOR")?;
        }
        let from = self.expression()?;
        self.word(Keyword::To, "after the first value of FOR")?;
        let to = self.expression()?;
        if self.token() == Token::Name && self.text(self.here()).len() > 2 {
            self.mend(&[Keyword::By]);
        }
        let by = if self.accept_keyword(Keyword::By) { Some(self.expression()?) } else { None };
        Ok(ForHead { variable, from, to, by })
    }

    pub(super) fn while_statement(&mut self) -> StatementKind {
        self.open(Keyword::While);
        let condition = self.condition(Keyword::Do, "WHILE");
        let body = self.statements(Place::Body);
        self.close();
        StatementKind::While { condition, body }
    }

    pub(super) fn repeat_statement(&mut self) -> StatementKind {
        self.open(Keyword::Repeat);
        let body = self.statements(Place::Body);
        let until = self.until();
        self.close();
        until.map_or(StatementKind::Empty, |until| StatementKind::Repeat { body, until })
    }

    fn until(&mut self) -> Parsed<Expression> {
        self.word(Keyword::Until, "and a condition before END_REPEAT")?;
        let read = self.expression().and_then(|condition| self.comparison_for_assignment(condition));
        let Ok(until) = read else {
            self.recover_behind(Keyword::EndRepeat);
            return read;
        };
        let here = self.here();
        if self.accept(Token::Semicolon) {
            self.tell(Problem::new(
                here,
                "there is a `;` after the condition of UNTIL, where none is permitted",
            ));
        }
        Ok(until)
    }
}
