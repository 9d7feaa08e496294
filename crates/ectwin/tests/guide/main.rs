//! The Rust examples of docs/user, each a file that a reader can copy; crates/ectwin-cli/tests/docs.rs compares
//! them with the pages.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod cpu_events;
mod cpu_programs;
mod cpu_unit;
mod cpu_variables;
#[cfg(feature = "ethercrab")]
mod ethercrab_in_memory;
mod events;
mod frames_in_virtual_time;
mod line_faults;
mod link_in_memory;
mod master_in_virtual_time;
mod messages;
#[cfg(feature = "modbus")]
mod modbus;
mod orders;
mod scenario;
mod scenario_values;
