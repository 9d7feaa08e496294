//! The control channel: JSON lines on a Unix socket, by which people and scripts see and steer a twin that runs.
//!
//! [`messages`] are the lines themselves: requests, answers, and the records of a subscription. A [`Socket`] is the place
//! where clients find the twin. [`serve`] answers them on two threads of its own: one moves lines, and never waits for a
//! client or the twin; the other carries out requests, one after the other, through the trait [`Twin`]. A
//! [`client::Client`] is the other end.

pub mod client;
pub mod messages;
mod server;
mod socket;
mod twin;

pub use server::{CLIENTS_MAX, Publisher, Server, serve};
pub use socket::{BindError, Socket, default_folder, running};
pub use twin::{Change, Twin};
