//! The built command on its links, as a master and a user see it: carriers, bursts, interfaces that are removed
//! and added, forged senders, and the permissions of the process.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod bench;
mod burst;
mod interfaces;
mod privileges;
mod udp;
