//! Units of any model: the registry of models, and their words.

mod registry;
mod words;

pub use registry::models;
pub use words::{event, has_fault};
