//! One unit and its CPU Unit behind real frames, in virtual time.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

mod bench;
mod exchange;
mod messages;
mod timing;
mod variables;
