//! What files that users write have in common: their text, what they are instead, and their mistakes.
//!
//! A file can be anything: an ESI file, a program in another character set, 200 KB of keys that do not exist. This crate
//! bounds what is said about it, in number and in length.

mod kind;
mod mistakes;
mod sample;
mod text;
mod words;

pub use kind::{Refusal, Wanted, of_another_kind};
pub use mistakes::{MISTAKES_MAX, Mistakes, and_more};
pub use text::text;
pub use words::{escaped, line_and_column, shown};
