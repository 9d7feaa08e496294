//! The channel from a client's side, with a twin that is a table.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod bench;
mod client;
mod hostile;
mod records;
mod sockets;
mod verbs;
