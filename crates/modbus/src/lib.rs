//! Modbus TCP: outside PLC runtimes read, write and force the variables of CPU Units.
//!
//! A [`ModbusMap`] gives each variable its addresses; they do not depend on the I/O allocation. [`serve`]
//! answers clients on a separate thread, which accesses the CPU Unit only through [`plc::outside`]: no client,
//! however slow or hostile, delays a task period or a frame.
//!
//! The frames are those of *MODBUS Messaging on TCP/IP Implementation Guide* V1.0b, function codes and exceptions those
//! of *MODBUS Application Protocol Specification* V1.1b3.

mod addresses;
mod answer;
mod connection;
mod exception;
mod map;
mod request;
mod server;
mod unit;

pub use map::{MapRow, ModbusMap, Table};
pub use server::{CONNECTIONS_MAX, Server, serve};
