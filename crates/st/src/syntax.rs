//! From text to what it says: tokens, and the tree of a file.

pub(crate) mod ast;
