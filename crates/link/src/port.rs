//! Source and destination of frames.

use std::io;
use std::task::Waker;

use time::Duration;

use crate::LinkSpec;

/// Room for one frame. Longer than any that an ESC accepts, so that a frame that is too long is received as too
/// long and not as a truncated one.
pub const FRAME_BUFFER_BYTES: usize = 2048;

/// The envelope of a frame on the medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Envelope {
    /// The whole Ethernet frame.
    Ethernet,
    /// A UDP datagram without an Ethernet header, which the port puts before it.
    Udp,
}

/// A medium that carries whole Ethernet frames, from the destination address on, without FCS.
pub trait FramePort: Send {
    /// Starts what the port needs in addition to its frames. Called once, before the first frame: between
    /// opening and this call, a program drops its privileges, which applies only to threads that start later.
    ///
    /// # Errors
    /// No thread can be started.
    fn begin(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Receives the next frame into `buffer` (of [`FRAME_BUFFER_BYTES`]) and returns its length in bytes.
    /// Blocks for `wait` at most; nothing if no frame was received. May return early without a frame.
    ///
    /// # Errors
    /// The medium is gone. [`io::ErrorKind::UnexpectedEof`]: the other end has closed the link.
    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>>;

    /// Sends one frame, without waiting for room.
    ///
    /// # Errors
    /// The frame is lost; the port may still be usable.
    fn send(&mut self, frame: &[u8]) -> io::Result<()>;

    /// The name of the link, with the actual port if port 0 was requested. Nothing if it has no name.
    fn link(&self) -> Option<LinkSpec> {
        None
    }

    /// The envelope of the frames.
    fn envelope(&self) -> Envelope {
        Envelope::Ethernet
    }

    /// Whether the cable to the master has a carrier. A medium without a carrier signal always has it.
    fn carrier(&self) -> bool {
        true
    }

    /// Received frames for which the medium had no room.
    fn dropped(&self) -> u64 {
        0
    }

    /// Lets another thread end a wait in [`FramePort::receive`], the present or else the next one. To be called on the
    /// thread that receives. A port that cannot be woken only waits to the end.
    fn waker(&self) -> Waker {
        Waker::noop().clone()
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

    fn waker(&self) -> Waker {
        (**self).waker()
    }
}
