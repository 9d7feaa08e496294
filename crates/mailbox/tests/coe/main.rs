//! The CoE server as a master sees it; `Cnnn` is the statement of the conformance list that a test covers.
#![expect(clippy::unwrap_used, reason = "a panic here is a failed test")]

mod bench;
mod complete_access;
mod emergency;
mod headers;
mod information;
mod notes;
mod properties;
mod repeat;
mod sdo;
