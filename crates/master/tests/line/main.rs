//! The master with slaves of this project, in one process and in virtual time.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

mod allocation;
mod bench;
mod direct_access;
mod exchange;
mod faults;
mod mailbox;
mod search;
mod states;
mod waiting;
