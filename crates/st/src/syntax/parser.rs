//! From tokens to the tree: a recursive descent that reports missing parts and continues.

mod arguments;
mod block;
mod blocks;
mod configuration;
mod declarations;
mod expressions;
mod file;
mod initials;
mod postfix;
mod spelling;
mod statements;
mod types;

use super::ast::Name;
use super::keyword::Keyword;
use super::lexer::{self, Lexed};
use super::token::{Lexeme, Token};
use crate::problem::{PROBLEMS_SOUGHT, Problem, Span};
use block::Block;

/// Maximum nesting depth of expressions, statements, types and initial values together.
const NESTING_MAX: usize = 64;

/// Maximum number of operands of one expression, so that code that visits its tree needs only a bounded stack.
const OPERANDS_MAX: usize = 500;

/// The part that could not be read has been reported; the caller searches for a position at which to continue.
#[derive(Debug)]
struct Failed;

type Parsed<T> = Result<T, Failed>;

/// Reads one source.
pub(super) struct Parser<'source> {
    source: &'source str,
    /// Start of the file in the source.
    start: usize,
    lexemes: Vec<Lexeme>,
    /// The positions of pragmas.
    pragmas: Vec<Span>,
    /// The token to read next; the last one, the end of the file, is never passed.
    place: usize,
    problems: Vec<Problem>,
    /// Whether the rest of the file is ignored.
    stopped: bool,
    /// Present nesting depth.
    depth: usize,
    /// Number of operands of the expression so far.
    operands: usize,
    /// The open blocks, the innermost last.
    blocks: Vec<Block>,
}

impl<'source> Parser<'source> {
    pub(super) fn new(source: &'source str, start: usize) -> Self {
        let Lexed { lexemes, pragmas, problems } = lexer::lex(source, start);
        Self {
            source,
            start,
            lexemes,
            pragmas,
            place: 0,
            problems,
            stopped: false,
            depth: 0,
            operands: 0,
            blocks: Vec::new(),
        }
    }

    /// The token `ahead` positions from here.
    fn peek(&self, ahead: usize) -> Token {
        self.lexemes.get(self.place + ahead).map_or(Token::End, |lexeme| lexeme.token)
    }

    fn token(&self) -> Token {
        self.peek(0)
    }

    fn at(&self, keyword: Keyword) -> bool {
        self.token() == Token::Keyword(keyword)
    }

    /// The keyword at this position.
    fn keyword(&self) -> Option<Keyword> {
        match self.token() {
            Token::Keyword(keyword) => Some(keyword),
            _ => None,
        }
    }

    /// The position of the token to read.
    fn here(&self) -> Span {
        self.lexemes.get(self.place).map(|lexeme| lexeme.span).unwrap_or_default()
    }

    /// The position of the token before it.
    fn previous(&self) -> Span {
        let before = self.place.checked_sub(1).and_then(|place| self.lexemes.get(place));
        before.map(|lexeme| lexeme.span).unwrap_or_default()
    }

    /// From `start` to the last token that was read.
    fn since(&self, start: Span) -> Span {
        let end = self.previous().end.max(start.start);
        Span { start: start.start, end }
    }

    /// The token before the one to read.
    fn peek_before(&self) -> Option<Token> {
        let before = self.place.checked_sub(1).and_then(|place| self.lexemes.get(place));
        before.map(|lexeme| lexeme.token)
    }

    fn text(&self, span: Span) -> &'source str {
        self.source.get(span.range()).unwrap_or_default()
    }

    /// Advances by one token.
    fn advance(&mut self) -> Span {
        let span = self.here();
        if self.token() != Token::End {
            self.place += 1;
        }
        span
    }

    /// Advances if this is the next token.
    fn accept(&mut self, token: Token) -> bool {
        let stands_here = self.token() == token;
        if stands_here {
            self.advance();
        }
        stands_here
    }

    fn accept_keyword(&mut self, keyword: Keyword) -> bool {
        self.accept(Token::Keyword(keyword))
    }

    /// Reports a problem, but only one for each position: consequential problems help no user.
    fn tell(&mut self, problem: Problem) {
        if self.stopped {
            return;
        }
        let is_known = self.problems.iter().any(|known| known.span.start == problem.span.start);
        if !is_known && self.problems.len() < PROBLEMS_SOUGHT {
            self.problems.push(problem);
        }
        if self.problems.len() >= PROBLEMS_SOUGHT {
            self.stop();
        }
    }

    /// Ignores the rest of the file.
    fn stop(&mut self) {
        self.stopped = true;
        self.place = self.lexemes.len().saturating_sub(1);
    }

    /// Reports a problem and fails.
    fn fail<T>(&mut self, problem: Problem) -> Parsed<T> {
        self.tell(problem);
        Err(Failed)
    }

    /// The problem that `what` is missing here: "expected … after …, found …".
    fn missing(&self, what: &str) -> Problem {
        let span = self.here();
        Problem::new(span, format!("expected {what}, found {}", self.found()))
    }

    /// The token to read, in the words of a message.
    fn found(&self) -> String {
        match self.token() {
            Token::End => "the end of the file".to_owned(),
            Token::OpenString => "a string without an end".to_owned(),
            Token::Keyword(keyword) => format!("`{}`", keyword.word()),
            _ => {
                let text = self.text(self.here());
                let shown: String = text.chars().take(40).collect();
                let more = if shown.len() < text.len() { "…" } else { "" };
                format!("`{shown}{more}`")
            }
        }
    }

    /// Advances past `token`, or reports that `what` is missing.
    fn expect(&mut self, token: Token, what: &str) -> Parsed<Span> {
        if self.token() == token {
            return Ok(self.advance());
        }
        let problem = self.missing(what);
        self.fail(problem)
    }

    /// Reads a name. `what`, the kind of the name, is used in the message.
    fn name(&mut self, what: &str) -> Parsed<Name> {
        let span = self.here();
        let text = self.text(span);
        match self.token() {
            Token::Name => {
                self.advance();
                Ok(Name { text: text.to_owned(), span })
            }
            Token::Keyword(keyword) => {
                let message = format!("expected {what}, found the reserved word `{}`", keyword.word());
                self.fail(Problem::new(span, message))
            }
            Token::BadNumber => {
                let message = format!("expected {what}, found `{text}`");
                self.fail(Problem::new(span, message).help("a name does not begin with a digit"))
            }
            _ => {
                let problem = self.missing(what);
                self.fail(problem)
            }
        }
    }

    /// Reads the name of a new item: not a word of the language.
    fn new_name(&mut self, what: &str) -> Parsed<Name> {
        let is_declared =
            matches!(self.peek(1), Token::Colon | Token::Comma | Token::Assign | Token::Keyword(Keyword::At));
        if let (Some(word), true) = (self.keyword(), is_declared) {
            let message = format!("`{}` is a reserved word and cannot be {what}", word.word());
            let span = self.advance();
            self.tell(Problem::new(span, message));
            return Ok(Name { text: self.text(span).to_owned(), span });
        }
        let name = self.name(what)?;
        if spelling::is_type_word(&name.text) {
            let message = format!("`{}` is the name of a type and cannot be {what}", name.text);
            self.tell(Problem::new(name.span, message));
        }
        Ok(name)
    }

    /// Reads something that is nested one level deeper.
    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.depth >= NESTING_MAX {
            let help = format!("{NESTING_MAX} levels are the most");
            self.tell(Problem::new(self.here(), "nested too deeply").help(help));
            self.stop();
            return Err(Failed);
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    /// The semicolon that ends `what`. A missing one is reported directly after the last token, where it belongs.
    fn semicolon(&mut self, what: &str) -> Parsed<()> {
        // A string without an end contains its semicolon.
        if self.accept(Token::Semicolon) || self.peek_before() == Some(Token::OpenString) {
            return Ok(());
        }
        if self.token() == Token::Unknown {
            return Err(Failed);
        }
        let end = self.previous().end;
        let mut problem = Problem::new(Span { start: end, end }, format!("expected `;` after {what}"));
        problem.help = self.semicolon_help();
        self.fail(problem)
    }

    /// The likely meaning of the token at the position of a semicolon.
    fn semicolon_help(&self) -> Option<String> {
        let help = match self.token() {
            Token::Keyword(Keyword::Then) => "THEN belongs to IF or ELSIF",
            Token::Keyword(Keyword::Do) => "DO belongs to FOR or WHILE",
            Token::Keyword(Keyword::Of) => "OF belongs to CASE",
            Token::CloseParenthesis => "this `)` has no `(`",
            Token::CloseBracket => "this `]` has no `[`",
            Token::Dot => "a real number has digits on both sides of its point",
            Token::Caret => "a power is written `**`",
            _ => return None,
        };
        Some(help.to_owned())
    }

    /// The line of a position in its file, counted from 1.
    fn line(&self, span: Span) -> usize {
        let before = self.source.get(self.start..span.start as usize).unwrap_or_default();
        before.matches('\n').count() + 1
    }
}
