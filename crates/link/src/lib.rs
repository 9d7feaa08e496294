//! Real media and the real clock: raw, UDP, TAP and in-memory links.
//!
//! A [`FramePort`] carries Ethernet frames; `open` makes one from a [`LinkSpec`], [`memory::pair`] makes two
//! that are joined. [`runner::run`] answers the frames of a port through a [`Responder`] first, and then passes
//! them to an [`Observer`], such as the [`Recorder`] that writes them to a pcapng file.
//!
//! This is the only crate below the binary that opens sockets and reads a clock. Without its feature `media` it
//! has links in memory only.

mod answers;
#[cfg(feature = "media")]
mod claim;
mod clock;
#[cfg(feature = "media")]
mod descriptor;
#[cfg(feature = "media")]
mod filter;
mod losses;
pub mod memory;
#[cfg(feature = "media")]
mod open;
#[cfg(feature = "media")]
mod open_error;
mod port;
#[cfg(feature = "media")]
mod raw;
mod recorder;
pub mod runner;
mod spec;
#[cfg(feature = "media")]
mod tap;
#[cfg(feature = "media")]
mod udp;
mod wake;
#[cfg(feature = "media")]
mod wake_event;

pub use clock::Clock;
#[cfg(feature = "media")]
pub use open::open;
#[cfg(feature = "media")]
pub use open_error::OpenError;
pub use port::{Envelope, FRAME_BUFFER_BYTES, FramePort};
pub use recorder::{Medium, Recorder, Recording};
pub use runner::{FrameFate, Observer, Responder, Seen, Statistics};
pub use spec::{DEFAULT_UDP_PORT, LinkSpec, NotALink};
pub use wake::wakes_thread;
