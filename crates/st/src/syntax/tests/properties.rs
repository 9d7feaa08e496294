//! No source is too much.
