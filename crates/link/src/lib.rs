//! Real media and the real clock: raw, UDP, TAP and in-memory links.
//!
//! A [`FramePort`] carries Ethernet frames; [`open`] makes one from a [`LinkSpec`], [`memory::pair`] makes two
//! that are joined. [`runner::run`] answers the frames of a port through a [`Responder`], first of all, and
//! then tells an [`Observer`], such as the [`Recorder`] that writes them to a pcapng file.
//!
//! This is the only crate below the binary that opens sockets and asks what time it is.

mod clock;
mod filter;
mod losses;
pub mod memory;
mod open;
mod open_error;
mod port;
mod raw;
mod recorder;
pub mod runner;
mod spec;
mod tap;
mod udp;

pub use clock::Clock;
pub use open::open;
pub use open_error::OpenError;
pub use port::{FRAME_BUFFER_BYTES, FramePort};
pub use recorder::{Medium, Recorder, Recording};
pub use runner::{FrameFate, Observer, Responder, Seen, Statistics};
pub use spec::{DEFAULT_UDP_PORT, LinkSpec, NotALink};
