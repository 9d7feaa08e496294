//! Statements: lists of them, assignments and calls.

mod branches;
mod loops;

use super::super::ast::{Expression, ExpressionKind, Statement, StatementKind};
use super::super::keyword::Keyword;
use super::super::token::Token;
use super::{Parsed, Parser};
use crate::problem::{Problem, Span};

/// The place of a list of statements.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// In a program organization unit, or in another statement.
    Body,
    /// In an arm of CASE, which ends at the next label.
    Arm,
}

impl Parser<'_> {
    /// Statements up to a word that ends them, which is not read.
    pub(super) fn statements(&mut self, place: Place) -> Vec<Statement> {
        let mut statements = Vec::new();
        loop {
            self.mend_statement();
            if !self.is_inside_statement() && self.skip_unsupported() {
                continue;
            }
            if self.blocks.is_empty() && self.at_configuration() {
                return statements;
            }
            if self.statements_end() || (place == Place::Arm && self.at_label()) {
                return statements;
            }
            let before = self.place;
            match self.deeper(Self::statement) {
                // One empty statement has the same meaning as a million of them.
                Ok(Statement { kind: StatementKind::Empty, .. }) if ends_empty(&statements) => {}
                Ok(statement) => statements.push(statement),
                Err(_) => self.recover(),
            }
            if self.place == before {
                self.advance();
            }
        }
    }

    /// Whether there is a word that ends statements at this position; one that closes nothing is reported and ignored.
    fn statements_end(&mut self) -> bool {
        while let Some(word) = self.keyword().filter(|word| word.ends_statements()) {
            if self.is_inside_statement() {
                return true;
            }
            self.tell(Problem::new(self.here(), format!("`{}` closes nothing", word.word())));
            self.advance();
            self.accept(Token::Semicolon);
        }
        self.token() == Token::End || self.keyword().is_some_and(Keyword::ends_body)
    }

    /// Replaces a misspelt word at the start of a statement by the word that it resembles, if no statement
    /// begins like this.
    pub(super) fn mend_statement(&mut self) {
        let begins_statement = matches!(
            self.peek(1),
            Token::Assign
                | Token::OpenParenthesis
                | Token::OpenBracket
                | Token::Dot
                | Token::Equal
                | Token::Colon
                | Token::Comma
                | Token::Range
                | Token::Caret
                | Token::Arrow
        );
        if self.token() == Token::Name && !begins_statement {
            self.mend(STATEMENT_WORDS);
        }
    }

    fn statement(&mut self) -> Parsed<Statement> {
        let start = self.here();
        let kind = match self.token() {
            Token::Semicolon => {
                let span = self.advance();
                return Ok(Statement { kind: StatementKind::Empty, span });
            }
            Token::Keyword(word) => self.worded_statement(word)?,
            Token::Name => self.assignment_or_call()?,
            Token::Direct => {
                self.operands = 0;
                let problem = Problem::new(start, "directly represented variables are not supported");
                return self.fail(problem.help("use AT IOBus://… or the variable's name"));
            }
            _ => {
                let problem = self.missing("a statement");
                return self.fail(problem);
            }
        };
        let span = self.since(start);
        self.end_statement(&kind);
        Ok(Statement { kind, span })
    }

    fn worded_statement(&mut self, word: Keyword) -> Parsed<StatementKind> {
        let kind = match word {
            Keyword::If => return Ok(self.if_statement()),
            Keyword::Case => return Ok(self.case_statement()),
            Keyword::For => return Ok(self.for_statement()),
            Keyword::While => return Ok(self.while_statement()),
            Keyword::Repeat => return Ok(self.repeat_statement()),
            Keyword::Exit => StatementKind::Exit,
            Keyword::Continue => StatementKind::Continue,
            Keyword::Return => StatementKind::Return,
            _ => {
                let is_name = matches!(self.peek(1), Token::Assign | Token::Dot | Token::OpenBracket);
                let problem = if is_name {
                    let message = format!("`{}` is a reserved word and cannot be a name", word.word());
                    Problem::new(self.here(), message)
                } else {
                    self.missing("a statement")
                };
                return self.fail(problem);
            }
        };
        self.advance();
        Ok(kind)
    }

    fn assignment_or_call(&mut self) -> Parsed<StatementKind> {
        self.operands = 0;
        let target = self.variable_or_call()?;
        let sign = self.here();
        match (self.token(), target.kind) {
            (Token::Assign | Token::Equal, kind) => {
                let to = Expression { kind, span: target.span };
                if self.token() == Token::Equal {
                    self.tell_assignment(sign);
                }
                self.advance();
                let value = self.expression()?;
                self.no_second_assignment()?;
                Ok(StatementKind::Assign { to, value })
            }
            (_, ExpressionKind::Call(call)) => Ok(StatementKind::Call(call)),
            _ => {
                let problem = self.no_statement(target.span);
                self.fail(problem)
            }
        }
    }

    /// `=`, or an operator of another language, at the position of `:=`.
    fn tell_assignment(&mut self, sign: Span) {
        // `==` has been reported as a comparison, which it is not here.
        self.problems.retain(|problem| problem.span.start != sign.start);
        let message = format!("expected `:=`, found `{}`", self.text(sign));
        self.tell(Problem::new(sign, message).help("an assignment is written `:=`"));
    }

    fn no_second_assignment(&mut self) -> Parsed<()> {
        if self.token() != Token::Assign {
            return Ok(());
        }
        let problem = Problem::new(self.here(), "an assignment has no value that could be assigned");
        self.fail(problem.help("write an assignment for each variable; a comparison is written `=`"))
    }

    /// The problem that there is a variable at the position of a statement.
    fn no_statement(&self, target: Span) -> Problem {
        let name = self.text(target);
        let shown: String = name.chars().take(40).collect();
        match self.token() {
            Token::Semicolon | Token::End => {
                Problem::new(target, format!("`{shown}` alone is not a statement"))
                    .help(format!("a call is written `{shown}()`, an assignment `{shown} := …`"))
            }
            Token::Colon => {
                self.missing(&format!("`:=` after `{shown}`")).help("an assignment is written `:=`")
            }
            _ => self.missing(&format!("`:=` or `(` after `{shown}`")),
        }
    }

    /// The semicolon after a statement.
    fn end_statement(&mut self, kind: &StatementKind) {
        let what = match kind {
            StatementKind::Empty if self.token() != Token::Semicolon => return,
            StatementKind::Empty => "the statement",
            StatementKind::Assign { .. } => "the assignment",
            StatementKind::Call(_) => "the call",
            StatementKind::If { .. } => "END_IF",
            StatementKind::Case { .. } => "END_CASE",
            StatementKind::For { .. } => "END_FOR",
            StatementKind::While { .. } => "END_WHILE",
            StatementKind::Repeat { .. } => "END_REPEAT",
            StatementKind::Exit => "EXIT",
            StatementKind::Continue => "CONTINUE",
            StatementKind::Return => "RETURN",
        };
        // A block whose end is missing has been reported; there is no semicolon after it either.
        let is_simple = matches!(self.peek_before(), Some(Token::Keyword(word)) if what == word.word());
        let is_block = what.starts_with("END_");
        if is_block && !is_simple && self.token() != Token::Semicolon {
            return;
        }
        if self.semicolon(what).is_err() && !self.begins_statement() {
            self.recover();
        }
    }

    /// Whether there is a statement, or the end of a list of them, at the position of a missing semicolon.
    fn begins_statement(&self) -> bool {
        match self.token() {
            Token::End => true,
            Token::Keyword(word) => word.opens_statement() || word.ends_statements() || word.ends_body(),
            Token::Name => matches!(
                self.peek(1),
                Token::Assign | Token::OpenParenthesis | Token::OpenBracket | Token::Dot | Token::Colon
            ),
            // The label of the next arm.
            Token::Integer | Token::Based | Token::Hashed => {
                matches!(self.peek(1), Token::Colon | Token::Comma | Token::Range)
            }
            _ => false,
        }
    }
}

fn ends_empty(statements: &[Statement]) -> bool {
    matches!(statements.last(), Some(Statement { kind: StatementKind::Empty, .. }))
}

/// The words that a misspelt one at the start of a statement may mean.
const STATEMENT_WORDS: &[Keyword] = &[
    Keyword::If,
    Keyword::Elsif,
    Keyword::Else,
    Keyword::EndIf,
    Keyword::Case,
    Keyword::EndCase,
    Keyword::For,
    Keyword::EndFor,
    Keyword::While,
    Keyword::EndWhile,
    Keyword::Repeat,
    Keyword::Until,
    Keyword::EndRepeat,
    Keyword::Exit,
    Keyword::Continue,
    Keyword::Return,
    Keyword::EndVar,
    Keyword::EndProgram,
    Keyword::EndFunction,
    Keyword::EndFunctionBlock,
    Keyword::Program,
    Keyword::Function,
    Keyword::FunctionBlock,
    Keyword::Var,
    Keyword::VarInput,
    Keyword::VarOutput,
];
