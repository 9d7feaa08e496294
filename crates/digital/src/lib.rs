//! Digital terminals as they are built in hardware: 1 to 64 inputs or outputs or both, without mailbox and processor;
//! and a coupler, which has neither.
//!
//! [`TerminalSettings`] say which one, [`device_config`] describes it to the slave stack, and a [`Terminal`] moves the
//! levels between process data and its [`Wiring`].

mod channels;
mod config;
mod description;
mod layout;
mod settings;
mod terminal;
mod wiring;

pub use channels::Channels;
pub use config::device_config;
pub use description::description;
pub use layout::VENDOR_ID;
pub use settings::{Ports, TerminalSettings};
pub use terminal::Terminal;
pub use wiring::{BitImages, Wiring};
