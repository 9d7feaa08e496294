//! OPC UA: clients read, write and monitor the variables of CPU Units.
//!
//! `serve` answers clients on a separate thread, which accesses the CPU Unit only through `plc::outside`: no
//! client, however slow or hostile, delays a task period or a frame. There is no security: anyone with access
//! to the port can read and write.
//!
//! Everything here requires the feature `server`. It is off by default, because its library is as large as all
//! other libraries of ectwin together.

#![cfg(feature = "server")]

mod nodes;
mod server;
mod unit;
mod value;

pub use nodes::NAMESPACE_URI;
pub use server::{Server, serve};
