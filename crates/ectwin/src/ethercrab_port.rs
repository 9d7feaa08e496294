//! A link to an ethercrab master in the same process: no socket, no root.

use std::io;
use std::task::Waker;
use std::thread;

use ethercrab::{PduRx, PduTx};
use link::{FramePort, wakes_thread};
use time::Duration;

/// The network side of ethercrab's `PduStorage`, as a port for frames. It belongs to the thread that first
/// receives from it: ethercrab wakes that thread when it has a frame to send.
pub struct EthercrabPort<'s> {
    tx: PduTx<'s>,
    rx: PduRx<'s>,
    receiver: Option<Waker>,
}

impl<'s> EthercrabPort<'s> {
    /// Takes the two halves that `PduStorage::try_split` returns in addition to the `PduLoop`.
    #[must_use]
    pub fn new(tx: PduTx<'s>, rx: PduRx<'s>) -> Self {
        Self { tx, rx, receiver: None }
    }

    fn take_frame(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        // Registered before the check: a frame that becomes ready after the check still wakes the thread.
        let waker = self.receiver.get_or_insert_with(|| wakes_thread(thread::current()));
        self.tx.replace_waker(waker);
        if self.tx.should_exit() {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        let Some(frame) = self.tx.next_sendable_frame() else { return Ok(None) };
        let taken = frame.send_blocking(|bytes| {
            let room = buffer.get_mut(..bytes.len()).ok_or(ethercrab::error::Error::SendFrame)?;
            room.copy_from_slice(bytes);
            Ok(bytes.len())
        });
        taken.map(Some).map_err(io::Error::other)
    }
}

impl FramePort for EthercrabPort<'_> {
    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>> {
        let taken = self.take_frame(buffer)?;
        if taken.is_some() || wait.is_zero() {
            return Ok(taken);
        }
        thread::park_timeout(std::time::Duration::from_nanos(wait.as_nanos()));
        self.take_frame(buffer)
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        self.rx.receive_frame(frame).map(|_| ()).map_err(io::Error::other)
    }

    fn waker(&self) -> Waker {
        wakes_thread(thread::current())
    }
}
