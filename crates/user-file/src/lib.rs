//! What files that users write have in common: their text, what they are instead, their values with places, and their
//! mistakes.
//!
//! [`read_toml`] walks through a TOML file: who reads it asks a [`Reader`] for keys and sections by the functions of
//! [`values`], and everything that is wrong is collected on the way, with its place and the nearest name.
//!
//! A file can be anything: an ESI file, a program in another character set, 200 KB of keys that do not exist. This crate
//! bounds what is said about it, in number and in length.

mod encoding;
mod error;
mod kind;
mod located;
mod mistakes;
mod reader;
mod sample;
mod text;
pub mod values;
mod words;

pub use error::{FileError, FileErrors, Problem};
pub use kind::{Refusal, Wanted, of_another_kind};
pub use located::Located;
pub use mistakes::{MISTAKES_MAX, Mistakes, and_more};
pub use reader::{Reader, Section, Value, read_toml, wrong_type};
pub use text::text;
pub use toml::de::DeValue;
pub use words::{LineNumbers, escaped, line_and_column, shortened, shown};
