//! Where frames come from and go to.

use std::io;
use std::os::fd::AsFd;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use time::Duration;

use crate::LinkSpec;

/// Room for one frame. Longer than any that an ESC takes, so that one which is too long still arrives as
/// too long and not as a truncated one.
pub const FRAME_BUFFER_BYTES: usize = 2048;

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

    fn carrier(&self) -> bool {
        (**self).carrier()
    }

    fn dropped(&self) -> u64 {
        (**self).dropped()
    }
}

/// Sleeps in the kernel until a descriptor that does not block has bytes, and receives them. `ppoll` rather than
/// a receive time-out, which counts in ticks of up to 10 ms; and no look before it: on one core that call
/// would keep the master from running.
pub(crate) fn receive_from(
    descriptor: &impl AsFd,
    wait: Duration,
    mut receive: impl FnMut() -> io::Result<usize>,
) -> io::Result<Option<usize>> {
    if wait.is_zero() || readable(descriptor, wait)? { unless_none_there(receive()) } else { Ok(None) }
}

fn unless_none_there(received: io::Result<usize>) -> io::Result<Option<usize>> {
    match received {
        Ok(length_bytes) => Ok(Some(length_bytes)),
        Err(error) if matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::Interrupted) => {
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

fn readable(descriptor: &impl AsFd, wait: Duration) -> io::Result<bool> {
    let nanos = wait.as_nanos();
    let timeout = Timespec {
        tv_sec: i64::try_from(nanos / 1_000_000_000).unwrap_or(i64::MAX),
        tv_nsec: (nanos % 1_000_000_000).try_into().unwrap_or(0),
    };
    match poll(&mut [PollFd::new(descriptor, PollFlags::IN)], Some(&timeout)) {
        Ok(ready) => Ok(ready > 0),
        // A signal: the caller looks at its stop flag.
        Err(rustix::io::Errno::INTR) => Ok(false),
        Err(error) => Err(error.into()),
    }
}

const ETHERTYPE_AT: usize = 12;

/// Whether an ESC would look into this frame: EtherCAT, also behind a VLAN tag, or IPv4, which may carry it.
pub(crate) fn may_be_ethercat(frame: &[u8]) -> bool {
    matches!(frame.get(ETHERTYPE_AT..ETHERTYPE_AT + 2), Some([0x88, 0xA4] | [0x81, 0x00] | [0x08, 0x00]))
}
