//! From text to its structure: tokens, and the tree of a file.

pub(crate) mod ast;
mod keyword;
mod lexer;
mod literal;
mod parser;
#[cfg(test)]
mod tests;
mod token;

use crate::problem::Problem;
use ast::File;

/// Reads the file that begins at byte `start` of `source` and ends with it: the tree of the parts that could be
/// read, and the problems.
pub(crate) fn parse_from(source: &str, start: usize) -> (File, Vec<Problem>) {
    parser::Parser::new(source, start).file()
}

/// Reads a file.
pub(crate) fn parse(source: &str) -> (File, Vec<Problem>) {
    parse_from(source, 0)
}

/// Reads the initial value that the whole text is.
pub(crate) fn parse_initial(source: &str) -> Option<ast::Initial> {
    parser::Parser::new(source, 0).whole_initial()
}
