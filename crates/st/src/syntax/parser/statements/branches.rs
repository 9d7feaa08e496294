//! IF and CASE.

use super::super::super::ast::{
    CaseArm, CaseLabel, Expression, ExpressionKind, Literal, Statement, StatementKind,
};
use super::super::super::keyword::Keyword;
use super::super::super::token::Token;
use super::super::{Parsed, Parser};
use super::Place;
use crate::problem::{Problem, Span};

impl Parser<'_> {
    pub(super) fn if_statement(&mut self) -> StatementKind {
        self.open(Keyword::If);
        let mut branches = vec![self.branch("IF")];
        while self.accept_keyword(Keyword::Elsif) {
            branches.push(self.branch("ELSIF"));
        }
        let otherwise = self.otherwise();
        while let Some(word) = self.keyword().filter(|word| matches!(word, Keyword::Elsif | Keyword::Else)) {
            self.tell(Problem::new(self.here(), format!("{} is after the ELSE of its IF", word.word())));
            self.advance();
            if word == Keyword::Elsif {
                self.branch("ELSIF");
            } else {
                self.statements(Place::Body);
            }
        }
        self.close();
        StatementKind::If { branches, otherwise }
    }

    fn branch(&mut self, opener: &str) -> (Expression, Vec<Statement>) {
        let condition = self.condition(Keyword::Then, opener);
        (condition, self.statements(Place::Body))
    }

    /// The statements after ELSE, if it is at this position.
    fn otherwise(&mut self) -> Vec<Statement> {
        let word = self.here();
        if !self.accept_keyword(Keyword::Else) {
            return Vec::new();
        }
        // The two words belong together only if they are in one line.
        let between = Span { start: word.end, end: self.here().start };
        if self.at(Keyword::If) && !self.text(between).contains('\n') {
            self.note_else_if();
        }
        self.statements(Place::Body)
    }

    /// A condition, and the word `ending` after it. One that cannot be read is replaced by TRUE.
    pub(super) fn condition(&mut self, ending: Keyword, opener: &str) -> Expression {
        let start = self.here();
        let read = self.expression().and_then(|condition| self.comparison_for_assignment(condition));
        let Ok(condition) = read else {
            self.recover_behind(ending);
            return placeholder(start);
        };
        self.ending(ending, &format!("after the condition of {opener}"));
        condition
    }

    /// The word that ends the head of a statement; if it is missing or different, the body is read nevertheless.
    pub(super) fn ending(&mut self, ending: Keyword, place: &str) {
        if self.word(ending, place).is_ok() {
            return;
        }
        let is_other = matches!(self.keyword(), Some(Keyword::Then | Keyword::Do | Keyword::Of));
        if is_other || self.token() == Token::Semicolon {
            self.advance();
        } else if !self.begins_statement() {
            self.recover_behind(ending);
        }
    }

    pub(super) fn case_statement(&mut self) -> StatementKind {
        self.open(Keyword::Case);
        let start = self.here();
        let selector = match self.expression() {
            Ok(selector) => {
                self.ending(Keyword::Of, "after the selector of CASE");
                selector
            }
            Err(_) => {
                self.recover_behind(Keyword::Of);
                placeholder(start)
            }
        };
        let arms = self.arms();
        let otherwise = if self.accept_keyword(Keyword::Else) {
            self.accept(Token::Colon);
            self.statements(Place::Body)
        } else {
            Vec::new()
        };
        self.close();
        StatementKind::Case { selector, arms, otherwise }
    }

    fn arms(&mut self) -> Vec<CaseArm> {
        let mut arms = Vec::new();
        loop {
            if self.at_label() {
                let labels = self.labels();
                let body = self.statements(Place::Arm);
                arms.extend(labels.map(|labels| CaseArm { labels, body }));
            } else if !self.ends_here() {
                let problem = self.missing("a label such as `1:` in CASE");
                self.tell(problem);
                self.statements(Place::Arm);
            } else {
                return arms;
            }
        }
    }

    /// Labels with the colon after them; if they are missing, the statements after them are read nevertheless.
    fn labels(&mut self) -> Option<Vec<CaseLabel>> {
        let mut labels = Vec::new();
        let read = loop {
            match self.label() {
                Ok(label) => labels.push(label),
                Err(failed) => break Err(failed),
            }
            if !self.accept(Token::Comma) {
                break self.expect(Token::Colon, "`,` or `:` after a label of CASE").map(|_| ());
            }
        };
        if read.is_err() {
            while !matches!(self.token(), Token::Colon | Token::Semicolon | Token::Keyword(_) | Token::End) {
                self.advance();
            }
            self.accept(Token::Colon);
        }
        read.is_ok().then_some(labels)
    }

    fn label(&mut self) -> Parsed<CaseLabel> {
        let from = self.expression()?;
        if !self.accept(Token::Range) {
            return Ok(CaseLabel::Value(from));
        }
        Ok(CaseLabel::Range(from, self.expression()?))
    }

    /// Whether there is a label of CASE at this position: no statement begins like one.
    pub(super) fn at_label(&self) -> bool {
        match self.token() {
            Token::Integer
            | Token::Based
            | Token::Real
            | Token::Hashed
            | Token::BadNumber
            | Token::String => true,
            Token::Minus | Token::Plus | Token::Keyword(Keyword::True | Keyword::False) => true,
            Token::Name => matches!(self.peek(1), Token::Colon | Token::Comma | Token::Range),
            _ => false,
        }
    }

    fn ends_here(&self) -> bool {
        match self.token() {
            Token::Keyword(word) => word.ends_statements() || word.ends_body(),
            token => token == Token::End,
        }
    }
}

/// Replaces a condition that could not be read.
fn placeholder(start: Span) -> Expression {
    let span = Span { start: start.start, end: start.start };
    Expression { kind: ExpressionKind::Literal(Literal::Bool(true)), span }
}
