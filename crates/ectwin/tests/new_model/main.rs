//! docs/add-a-unit-model.md: a unit model of your own, and a line with it. It counts; the master and the CPU Unit read the
//! count.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod counter;
mod description;
mod line;
mod model;
mod variables;
