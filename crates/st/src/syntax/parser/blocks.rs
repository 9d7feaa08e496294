//! Open blocks, the words that close them, and where reading continues after an error.

use super::super::keyword::Keyword;
use super::super::token::Token;
use super::block::Block;
use super::{Parsed, Parser, spelling};
use crate::problem::{Problem, Span};

impl Parser<'_> {
    /// Opens the block whose first word is at this position, and returns that position.
    pub(super) fn open(&mut self, opener: Keyword) -> Span {
        let span = self.advance();
        self.blocks.push(Block { opener, span, has_else_if: false });
        span
    }

    /// Records that the innermost block continues with ELSE directly followed by IF.
    pub(super) fn note_else_if(&mut self) {
        if let Some(block) = self.blocks.last_mut() {
            block.has_else_if = true;
        }
    }

    /// Closes the innermost block. Another block's end that matches no open block was meant for this one.
    pub(super) fn close(&mut self) {
        let Some(closer) = self.blocks.last().and_then(|block| block.opener.closer()) else { return };
        self.mend(&[closer]);
        let is_closed = self.accept_keyword(closer);
        let Some(block) = self.blocks.pop() else { return };
        if is_closed {
            return;
        }
        let (opener, line) = (block.opener.word(), self.line(block.span));
        let mut problem = self.missing(&format!("`{}` for the {opener} of line {line}", closer.word()));
        if block.has_else_if {
            problem = problem.help("`ELSE IF` opens a second IF; one more branch is written ELSIF");
        }
        self.tell(problem);
        let ends = self.keyword().filter(|found| found.word().starts_with("END_") || found.ends_statements());
        if ends.is_some_and(|found| !self.is_awaited(found)) {
            self.advance();
        }
    }

    /// Whether an open block ends or continues with this word.
    pub(super) fn is_awaited(&self, keyword: Keyword) -> bool {
        self.blocks.iter().any(|block| block.awaits(keyword))
    }

    /// Whether the innermost block is a statement.
    pub(super) fn is_inside_statement(&self) -> bool {
        self.blocks.last().is_some_and(|block| block.opener.opens_statement())
    }

    /// The word that closes the innermost block.
    fn innermost_closer(&self) -> Option<Keyword> {
        self.blocks.last().and_then(|block| block.opener.closer())
    }

    /// Continues after the next semicolon, or at a word that begins or ends something.
    pub(super) fn recover(&mut self) {
        loop {
            match self.token() {
                Token::End => return,
                Token::Semicolon => {
                    self.advance();
                    return;
                }
                Token::Keyword(word) if stands_out(word) => return,
                _ => self.advance(),
            };
        }
    }

    /// Continues after `word`, unless a semicolon or a word that begins or ends something comes before it.
    pub(super) fn recover_behind(&mut self, word: Keyword) {
        loop {
            match self.token() {
                Token::End | Token::Semicolon => return,
                Token::Keyword(found) if found == word => {
                    self.advance();
                    return;
                }
                Token::Keyword(found) if stands_out(found) => return,
                _ => self.advance(),
            };
        }
    }

    /// Reads `word`, even if it is misspelt. `place` is the part before it, for the message.
    pub(super) fn word(&mut self, word: Keyword, place: &str) -> Parsed<()> {
        self.mend(&[word]);
        if self.accept_keyword(word) {
            return Ok(());
        }
        let mut problem = self.missing_behind(&format!("`{}` {place}", word.word()));
        let (before, here) = (self.previous(), self.here());
        if self.pragmas.iter().any(|pragma| before.end <= pragma.start && pragma.end <= here.start) {
            problem = problem.help("text in `{…}` is a pragma and is ignored; blocks are written with words");
        }
        let operators = [Keyword::And, Keyword::Or, Keyword::Xor, Keyword::Mod];
        let is_name = self.token() == Token::Name;
        if let Some(operator) = spelling::nearest(self.text(here), &operators).filter(|_| is_name) {
            problem = problem.did_you_mean(operator.word());
        }
        self.fail(problem)
    }

    /// A missing part is reported at the position of the wrong one, or after the last token if that is in another line.
    fn missing_behind(&self, what: &str) -> Problem {
        let mut problem = self.missing(what);
        let before = self.previous();
        if self.line(before) != self.line(self.here()) {
            problem.span = Span { start: before.end, end: before.end };
        }
        problem
    }

    /// Accepts a misspelt word, such as `ENDIF`, as the one of `candidates` that it resembles, and reports it.
    pub(super) fn mend(&mut self, candidates: &[Keyword]) -> bool {
        if self.token() != Token::Name {
            return false;
        }
        let span = self.here();
        let text = self.text(span);
        let parted = self.parted_end(text);
        let Some(meant) = parted.or_else(|| spelling::nearest(text, candidates)) else { return false };
        let message = format!("`{text}` is not a word of the language");
        self.tell(Problem::new(span, message).did_you_mean(meant.word()));
        if parted.is_some() && matches!(self.peek(1), Token::Keyword(word) if word.closer().is_some()) {
            self.advance();
        }
        if let Some(lexeme) = self.lexemes.get_mut(self.place) {
            lexeme.token = Token::Keyword(meant);
        }
        true
    }

    /// The block that `END` alone, or `END IF`, closes.
    fn parted_end(&self, text: &str) -> Option<Keyword> {
        if !text.eq_ignore_ascii_case("END") {
            return None;
        }
        match self.peek(1) {
            Token::Keyword(word) if word.closer().is_some() => word.closer(),
            _ => self.innermost_closer(),
        }
    }
}

/// Whether reading can continue at this word after an error.
fn stands_out(word: Keyword) -> bool {
    word.opens_statement() || word.ends_statements() || word.ends_body()
}
