//! Where frames come from and go to.

use std::io;

use time::Duration;

use crate::LinkSpec;

/// Room for one frame. Longer than any that an ESC takes, so that one which is too long still arrives as
/// too long and not as a truncated one.
pub const FRAME_BUFFER_BYTES: usize = 2048;

/// What the medium carries a frame in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Envelope {
    /// The whole Ethernet frame.
    Ethernet,
    /// A UDP datagram without an Ethernet header, which the port puts in front.
    Udp,
}

/// A medium that carries whole Ethernet frames, from the destination address on, without FCS.
pub trait FramePort: Send {
    /// Starts what the port needs beside its frames. Called once, before the first frame: between opening and this, a
    /// program drops its privileges, which holds for threads that are started later only.
    ///
    /// # Errors
    /// There is no thread to be had.
    fn begin(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Takes the next frame into `buffer` (of [`FRAME_BUFFER_BYTES`]) and returns its length in bytes. Blocks
    /// for `wait` at most; nothing if no frame came. May return early without a frame.
    ///
    /// # Errors
    /// The medium is gone. [`io::ErrorKind::UnexpectedEof`]: the other end has closed the link.
    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>>;

    /// Sends one frame, without waiting for room.
    ///
    /// # Errors
    /// The frame is lost; the port may still be fine.
    fn send(&mut self, frame: &[u8]) -> io::Result<()>;

    /// The name of the link, with the real port where port 0 was asked for. Nothing if it has no name.
    fn link(&self) -> Option<LinkSpec> {
        None
    }

    /// What frames come in.
    fn envelope(&self) -> Envelope {
        Envelope::Ethernet
    }

    /// Whether the cable to the master carries a signal. A medium without a carrier has it always.
    fn carrier(&self) -> bool {
        true
    }

    /// Frames that came and that the medium had no room for.
    fn dropped(&self) -> u64 {
        0
    }
}

impl<P: FramePort + ?Sized> FramePort for Box<P> {
    fn begin(&mut self) -> io::Result<()> {
        (**self).begin()
    }

    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>> {
        (**self).receive(buffer, wait)
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        (**self).send(frame)
    }

    fn link(&self) -> Option<LinkSpec> {
        (**self).link()
    }

    fn envelope(&self) -> Envelope {
        (**self).envelope()
    }

    fn carrier(&self) -> bool {
        (**self).carrier()
    }

    fn dropped(&self) -> u64 {
        (**self).dropped()
    }
}
