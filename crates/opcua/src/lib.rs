//! OPC UA: clients read, write and watch the variables of CPU Units.
//!
//! `serve` answers clients on a thread of its own, which meets the CPU Unit in `plc::outside` only: no client,
//! however slow or hostile, delays a task period or a frame. There is no security: whoever reaches the port reads and
//! writes.
//!
//! Everything here needs the feature `server`. It is off by default, for the library below it is as large as all that
//! the rest of ectwin uses.

#![cfg(feature = "server")]

mod nodes;
mod server;
mod unit;
mod value;

pub use nodes::NAMESPACE_URI;
pub use server::{Server, serve};
