//! Values with their places.

use core::ops::Range;

/// A value and its place in the file. The default was left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Located<T> {
    /// The value.
    pub value: T,
    /// The bytes of the file from which it was read; none if it was left out.
    pub span: Option<Range<usize>>,
}

impl<T> Located<T> {
    /// A value with its place in the file.
    #[must_use]
    pub const fn at(span: Range<usize>, value: T) -> Self {
        Self { value, span: Some(span) }
    }

    /// A value that was left out.
    #[must_use]
    pub const fn left_out(value: T) -> Self {
        Self { value, span: None }
    }
}
