//! ESI files are read as they are meant, and what is wrong with one is found.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod devices;
mod files;
mod rules;
