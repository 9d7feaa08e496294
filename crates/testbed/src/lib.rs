//! For tests only: network namespaces, veth pairs, child processes, and the count of skipped tests.
//!
//! A test over a real interface runs in its own network namespace and does not need root for it:
//!
//! ```no_run
//! use ectwin_testbed as testbed;
//!
//! // In a #[test] fn frames_cross_a_wire():
//! testbed::in_network_namespace("frames_cross_a_wire", || {
//!     testbed::add_veth_pair("m0", "u0");
//!     // … open both ends …
//! });
//! ```

mod namespace;
mod process;
mod skip;

pub use namespace::{MasterSide, add_veth_pair, in_network_namespace, ip};
pub use process::Process;
pub use skip::{has_program, python_with, skip};
