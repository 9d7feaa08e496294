//! Digital terminals that consist of hardware only: 1 to 64 inputs or outputs or both, without mailbox and
//! processor; and a coupler, which has neither inputs nor outputs.
//!
//! A [`UnitFile`] or [`TerminalSettings`] select one, [`device_config`] describes it to the slave stack, and a
//! [`Terminal`] moves the levels between process data and its [`Wiring`].

mod bus_wiring;
mod channels;
mod config;
mod description;
mod layout;
mod model;
mod settings;
mod tables;
mod terminal;
mod unit_file;
mod variables;
mod wiring;

pub use bus_wiring::BusWiring;
pub use channels::Channels;
pub use config::device_config;
pub use description::description;
pub use layout::VENDOR_ID;
pub use model::MODEL;
pub use settings::{Ports, TerminalSettings};
pub use terminal::Terminal;
pub use unit_file::{KEYS, UnitFile};
pub use wiring::{BitImages, Wiring};
