//! From text to tokens: comments and pragmas are removed, and notations of other languages are reported.

mod skipped;

use logos::Logos as _;

use super::keyword::Keyword;
use super::token::{Cursor, Lexeme, Token};
use crate::problem::{PROBLEMS_SOUGHT, Problem, Span};

/// The tokens of a source.
pub(crate) struct Lexed {
    /// The last is [`Token::End`], which occurs only there.
    pub(crate) lexemes: Vec<Lexeme>,
    /// The positions of skipped pragmas.
    pub(crate) pragmas: Vec<Span>,
    pub(crate) problems: Vec<Problem>,
}

/// Splits `source` into tokens from byte `start` on. After the maximum number of reported problems, the rest is
/// ignored.
pub(crate) fn lex(source: &str, start: usize) -> Lexed {
    let mut lexed = Lexed { lexemes: Vec::new(), pragmas: Vec::new(), problems: Vec::new() };
    let mut cursor = Token::lexer(source);
    cursor.bump(start);
    while let Some(found) = cursor.next() {
        let token = found.unwrap_or(Token::Unknown);
        lexed.take(token, &mut cursor);
        if lexed.problems.len() >= PROBLEMS_SOUGHT {
            break;
        }
    }
    let end = Span::from(source.len()..source.len());
    lexed.lexemes.push(Lexeme { token: Token::End, span: end });
    lexed
}

impl Lexed {
    fn take(&mut self, token: Token, cursor: &mut Cursor<'_>) {
        let opening = Span::from(cursor.span());
        match token {
            Token::LineComment | Token::Comment | Token::SlashComment => {
                self.problems.extend(skipped::comment(token, cursor));
            }
            Token::Pragma => match skipped::pragma(cursor) {
                Ok(span) => self.pragmas.push(span),
                Err(problem) => self.problems.push(problem),
            },
            Token::String | Token::WideString => {
                let (found, problem) = skipped::string(token, cursor);
                self.problems.extend(problem);
                self.push(found, Span::from(cursor.span()));
            }
            Token::Name => self.name(cursor),
            Token::Unknown => {
                self.unknown(opening, cursor.slice());
                self.push(token, opening);
            }
            _ => match foreign(token, cursor.slice()) {
                Some((meant, help)) => {
                    let message = format!("`{}` is not Structured Text", cursor.slice());
                    self.problems.push(Problem::new(opening, message).help(help));
                    if let Some(meant) = meant {
                        self.push(meant, opening);
                    }
                }
                None => self.push(token, opening),
            },
        }
    }

    fn push(&mut self, token: Token, span: Span) {
        self.lexemes.push(Lexeme { token, span });
    }

    fn name(&mut self, cursor: &mut Cursor<'_>) {
        let token = Keyword::of(cursor.slice()).map_or(Token::Name, Token::Keyword);
        self.push(token, Span::from(cursor.span()));
        if token == Token::Keyword(Keyword::At) {
            self.path(cursor);
        }
    }

    /// The path after AT contains blanks and `//`: it extends to the colon of the type, and never beyond its line.
    fn path(&mut self, cursor: &mut Cursor<'_>) {
        let rest = cursor.remainder();
        let blank = rest.len() - rest.trim_start().len();
        let text = rest.trim_start();
        let scheme = text.find(|character: char| !character.is_ascii_alphanumeric()).unwrap_or(0);
        let Some(path) = text.get(scheme..).and_then(|path| path.strip_prefix("://")) else {
            return;
        };
        let length = path.find([':', ';', '\r', '\n']).unwrap_or(path.len());
        let whole = text.get(..scheme + "://".len() + length).unwrap_or(text).trim_end();
        let start = cursor.span().end + blank;
        self.push(Token::Path, Span::from(start..start + whole.len()));
        cursor.bump(blank + whole.len());
    }

    /// One problem for a run of characters that cannot begin a token.
    fn unknown(&mut self, span: Span, text: &str) {
        let message = format!("the character `{}` has no meaning here", text.escape_debug());
        let continues = self
            .problems
            .last_mut()
            .filter(|last| last.span.end == span.start && last.message.starts_with("the character"));
        match continues {
            Some(last) => last.span.end = span.end,
            None if text.contains(['‘', '’', '“', '”', '`', '´']) => {
                self.problems.push(Problem::new(span, message).help("a string is written `'text'`"));
            }
            None => self.problems.push(Problem::new(span, message)),
        }
    }
}

/// The meaning of a token of another language, and its notation here.
fn foreign(token: Token, text: &str) -> Option<(Option<Token>, String)> {
    let (meant, help) = match token {
        Token::ForeignEqual => (Some(Token::Equal), "a comparison is written `=`"),
        Token::ForeignNotEqual => (Some(Token::NotEqual), "a comparison is written `<>`"),
        Token::ForeignAnd => (Some(Token::Keyword(Keyword::And)), "a conjunction is written `AND` or `&`"),
        Token::ForeignOr => (Some(Token::Keyword(Keyword::Or)), "a disjunction is written `OR`"),
        Token::ForeignModulo => (Some(Token::Keyword(Keyword::Mod)), "a remainder is written `MOD`"),
        Token::ForeignNot => (Some(Token::Keyword(Keyword::Not)), "a negation is written `NOT`"),
        Token::ForeignBrace => (None, "a block ends with a word: END_IF, END_FOR, END_WHILE …"),
        Token::ForeignAssign => {
            let operator = text.trim_end_matches('=');
            return Some((Some(Token::Assign), format!("it is written in full: `x := x {operator} y`")));
        }
        _ => return None,
    };
    Some((meant, help.to_owned()))
}
