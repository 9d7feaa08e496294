//! From text to what it says: tokens, and the tree of a file.

pub(crate) mod ast;
mod keyword;
mod lexer;
mod literal;
mod parser;
#[cfg(test)]
mod tests;
mod token;

use crate::SOURCE_BYTES_MAX;
use crate::problem::{Problem, Span};
use ast::File;
pub(crate) use literal::date_prefix;

/// How many problems are told of one source; what lies behind the last is not read.
pub(crate) const PROBLEMS_MAX: usize = 20;

/// Reads a file: the tree of what could be read, and what could not.
///
/// A source longer than [`SOURCE_BYTES_MAX`] is not read at all.
pub(crate) fn parse(source: &str) -> (File, Vec<Problem>) {
    if source.len() > SOURCE_BYTES_MAX {
        let size_bytes = source.len();
        let message = format!("the source has {size_bytes} bytes, {SOURCE_BYTES_MAX} are the most");
        return (File::default(), vec![Problem::new(Span::default(), message)]);
    }
    parser::Parser::new(source).file()
}
