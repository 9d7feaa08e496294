//! ESCs joined by ports and links: the path of a frame.
//!
//! A segment is a line of ESCs with two ports each. A frame passes the processing unit of each, turns at the
//! first closed loop, and returns. Frames are edited in place; nothing is allocated on their path.

mod activity;
mod datagram;
mod index;
mod positions;
mod segment;

pub use activity::PortActivity;
pub use positions::Positions;
pub use segment::{FrameFate, Segment};
pub use wire::{Defect, FrameKind};
