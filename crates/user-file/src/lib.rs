//! The common part of reading user files: their text, their kind if it is the wrong one, their values with
//! places, and their mistakes.
//!
//! [`read_toml`] reads a TOML file: its caller gets keys and sections from a [`Reader`] with the functions of
//! [`values`]. All mistakes are collected on the way, with their places and the nearest names.
//!
//! A file can be anything: an ESI file, a program in another character set, 200 KB of unknown keys. This crate
//! limits the messages about it, in number and in length.

mod encoding;
mod error;
mod field_names;
mod kind;
mod located;
mod mistakes;
mod reader;
mod sample;
mod structured_text;
mod text;
mod typed;
pub mod values;
mod words;

pub use error::{FileError, FileErrors, Problem, did_you_mean, nearest};
pub use field_names::field_names;
pub use kind::{Refusal, Wanted, of_another_kind};
pub use located::Located;
pub use mistakes::{MISTAKES_MAX, Mistakes, and_more};
pub use reader::{Reader, Section, Value, read_toml, wrong_type};
pub use text::{exact_text, text};
pub use toml::de::DeValue;
pub use words::{
    LineNumbers, counted, escaped, hides_text, line_and_column, on_one_line, shortened, shown, times,
};
