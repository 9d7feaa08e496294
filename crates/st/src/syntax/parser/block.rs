//! An open block.

use super::super::keyword::Keyword;
use crate::problem::Span;

/// A block that an `END_…` closes.
pub(super) struct Block {
    pub(super) opener: Keyword,
    pub(super) span: Span,
    /// An `IF` with an `ELSE IF`, which opens a second one: often it should have been ELSIF.
    pub(super) has_else_if: bool,
}

impl Block {
    /// Whether it ends or continues with this word.
    pub(super) fn awaits(&self, keyword: Keyword) -> bool {
        let goes_on = match self.opener {
            Keyword::If => matches!(keyword, Keyword::Elsif | Keyword::Else),
            Keyword::Case => keyword == Keyword::Else,
            Keyword::Repeat => keyword == Keyword::Until,
            _ => false,
        };
        goes_on || self.opener.closer() == Some(keyword)
    }
}
