//! Terminals by single accesses: one of each kind, and a line of them.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

mod bench;
mod description;
mod line;
mod process_data;
mod states;
