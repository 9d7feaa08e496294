//! The tokens of a source.

use logos::Logos;

use super::keyword::Keyword;
use crate::problem::Span;

/// Reads the tokens of a source one after the other.
pub(crate) type Cursor<'source> = logos::Lexer<'source, Token>;

/// A token with its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Lexeme {
    pub(crate) token: Token,
    pub(crate) span: Span,
}

/// The kind of a token. The notations of other languages are tokens too: the lexer reports how they are written
/// here, and continues with that.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
#[logos(skip r"[\s\u{FEFF}\u{200B}]+")]
pub(crate) enum Token {
    /// A name; letters are those of Unicode, because IEC 61131-3, 6.1.2, takes them from ISO/IEC 10646.
    #[regex(r"[\p{Alphabetic}_][\p{Alphabetic}\p{Nd}_]*")]
    Name,
    /// A name that is a reserved word.
    Keyword(Keyword),
    /// `15`, `1_000`.
    #[regex(r"[0-9][0-9_]*", priority = 20)]
    Integer,
    /// `16#FF`.
    #[regex(r"[0-9][0-9_]*#[0-9A-Za-z_]*")]
    Based,
    /// `1.5`, `1.0E-3`, `1e5`.
    #[regex(r"[0-9][0-9_]*\.[0-9][0-9_]*([eE][+-]?[0-9]+)?", priority = 21)]
    #[regex(r"[0-9][0-9_]*[eE][+-]?[0-9]+", priority = 21)]
    Real,
    /// Digits that are followed by letters.
    #[regex(r"[0-9][0-9_]*[A-Za-z][0-9A-Za-z_]*", priority = 10)]
    BadNumber,
    /// `INT#-5`, `WORD#16#FF`, `T#1h30m15.5s`, `Colour#red`, `D#2024-02-29`.
    #[regex(r"[\p{Alphabetic}_][\p{Alphabetic}\p{Nd}_]*#", priority = 10)]
    #[regex(
        r"[\p{Alphabetic}_][\p{Alphabetic}\p{Nd}_]*#[\p{Alphabetic}_][\p{Alphabetic}\p{Nd}_]*",
        priority = 11
    )]
    #[regex(r"[\p{Alphabetic}_][\p{Alphabetic}\p{Nd}_]*#[+-]?[0-9][0-9_]*#[+-]?[0-9A-Za-z_]*", priority = 12)]
    #[regex(
        r"[\p{Alphabetic}_][\p{Alphabetic}\p{Nd}_]*#[+-]?[0-9][0-9_]*(\.[0-9][0-9_]*)?[eE][+-]?[0-9]+",
        priority = 13
    )]
    #[regex(
        r"[\p{Alphabetic}_][\p{Alphabetic}\p{Nd}_]*#[+-]?[0-9][0-9A-Za-z_]*(\.[0-9][0-9A-Za-z_]*)*",
        priority = 12
    )]
    #[regex(r"(?i:D|DATE|TOD|TIME_OF_DAY|DT|DATE_AND_TIME)#[0-9]+([-:.][0-9]+)+", priority = 14)]
    Hashed,
    /// `%IW0`.
    #[regex(r"%[IQMiqm][XBWDLxbwdl]?[0-9*][0-9.]*")]
    Direct,
    /// The path after AT, which is found by the lexer and not by a pattern.
    Path,

    /// `'…'` as a whole; the pattern is its start.
    #[token("'")]
    String,
    /// `"…"` as a whole; the pattern is its start.
    #[token("\"")]
    WideString,
    /// A string without an end in its line.
    OpenString,
    /// The start of a comment that ends with its line.
    #[token("//")]
    LineComment,
    /// The start of a comment.
    #[token("(*")]
    Comment,
    /// The start of a comment as in C.
    #[token("/*")]
    SlashComment,
    /// The start of a pragma.
    #[token("{")]
    Pragma,

    #[token(":=")]
    Assign,
    #[token("=>")]
    Arrow,
    #[token(":")]
    Colon,
    #[token(";")]
    Semicolon,
    #[token(",")]
    Comma,
    #[token(".")]
    Dot,
    #[token("..")]
    Range,
    #[token("(")]
    OpenParenthesis,
    #[token(")")]
    CloseParenthesis,
    #[token("[")]
    OpenBracket,
    #[token("]")]
    CloseBracket,
    #[token("^")]
    Caret,
    #[token("+")]
    Plus,
    #[token("-")]
    Minus,
    #[token("*")]
    Star,
    #[token("**")]
    Power,
    #[token("/")]
    Slash,
    #[token("&")]
    Ampersand,
    #[token("=")]
    Equal,
    #[token("<>")]
    NotEqual,
    #[token("<")]
    Less,
    #[token("<=")]
    LessOrEqual,
    #[token(">")]
    Greater,
    #[token(">=")]
    GreaterOrEqual,

    #[token("==")]
    ForeignEqual,
    #[token("!=")]
    ForeignNotEqual,
    #[token("&&")]
    ForeignAnd,
    #[token("||")]
    #[token("|")]
    ForeignOr,
    #[token("%")]
    ForeignModulo,
    #[token("!")]
    #[token("~")]
    ForeignNot,
    #[token("+=")]
    #[token("-=")]
    #[token("*=")]
    #[token("/=")]
    ForeignAssign,
    #[token("}")]
    ForeignBrace,

    /// A character that cannot begin a token.
    Unknown,
    /// The end of the file; the last of the tokens.
    End,
}
