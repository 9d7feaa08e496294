//! A link in memory: two ports that are joined, for tests and for masters in the same process.

use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::task::{Wake, Waker};

use time::Duration;

use crate::{FRAME_BUFFER_BYTES, FramePort};

/// Number of frames that one direction holds before it refuses more.
pub const CAPACITY_FRAMES: usize = 64;

/// Two ports: one receives what the other sends.
#[must_use]
pub fn pair() -> (MemoryPort, MemoryPort) {
    let (there, back) = (Arc::new(Lane::new()), Arc::new(Lane::new()));
    let one = MemoryPort { incoming: Arc::clone(&back), outgoing: Arc::clone(&there) };
    (one, MemoryPort { incoming: there, outgoing: back })
}

/// One end of a link in memory. Dropping it closes the link: the other end still receives the frames already
/// sent, and then [`io::ErrorKind::UnexpectedEof`].
pub struct MemoryPort {
    incoming: Arc<Lane>,
    outgoing: Arc<Lane>,
}

impl Drop for MemoryPort {
    fn drop(&mut self) {
        self.incoming.close();
        self.outgoing.close();
    }
}

impl FramePort for MemoryPort {
    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>> {
        self.incoming.take(buffer, std::time::Duration::from_nanos(wait.as_nanos()))
    }

    /// # Errors
    /// [`io::ErrorKind::WouldBlock`]: the other end has not taken the last [`CAPACITY_FRAMES`] frames.
    /// [`io::ErrorKind::BrokenPipe`]: it is closed. [`io::ErrorKind::InvalidInput`]: the frame is longer than
    /// [`FRAME_BUFFER_BYTES`].
    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        self.outgoing.put(frame)
    }

    fn waker(&self) -> Waker {
        Waker::from(Arc::clone(&self.incoming))
    }
}

/// One direction: a ring of buffers, allocated once.
struct Lane {
    ring: Mutex<Ring>,
    arrived: Condvar,
}

struct Ring {
    frames: Box<[Slot]>,
    first: usize,
    count: usize,
    closed: bool,
    /// The next wait of the receiver ends at once.
    woken: bool,
}

#[derive(Clone)]
struct Slot {
    length_bytes: usize,
    bytes: [u8; FRAME_BUFFER_BYTES],
}

impl Lane {
    fn new() -> Self {
        let frames = vec![Slot { length_bytes: 0, bytes: [0; FRAME_BUFFER_BYTES] }; CAPACITY_FRAMES];
        let ring =
            Ring { frames: frames.into_boxed_slice(), first: 0, count: 0, closed: false, woken: false };
        Self { ring: Mutex::new(ring), arrived: Condvar::new() }
    }

    /// A thread that panicked with the lock left the ring consistent: each change is one assignment.
    fn lock(&self) -> MutexGuard<'_, Ring> {
        self.ring.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn close(&self) {
        self.lock().closed = true;
        self.arrived.notify_all();
    }

    fn put(&self, frame: &[u8]) -> io::Result<()> {
        self.lock().push(frame)?;
        self.arrived.notify_one();
        Ok(())
    }

    fn take(&self, buffer: &mut [u8], wait: std::time::Duration) -> io::Result<Option<usize>> {
        let nothing_happens = |ring: &mut Ring| ring.count == 0 && !ring.closed && !ring.woken;
        let waited = self.arrived.wait_timeout_while(self.lock(), wait, nothing_happens);
        let (mut ring, _) = waited.unwrap_or_else(PoisonError::into_inner);
        ring.woken = false;
        match ring.pop(buffer) {
            None if ring.closed => Err(io::ErrorKind::UnexpectedEof.into()),
            received => Ok(received),
        }
    }
}

impl Wake for Lane {
    fn wake(self: Arc<Self>) {
        self.wake_by_ref();
    }

    fn wake_by_ref(self: &Arc<Self>) {
        self.lock().woken = true;
        self.arrived.notify_one();
    }
}

impl Ring {
    fn push(&mut self, frame: &[u8]) -> io::Result<()> {
        if self.closed {
            return Err(io::ErrorKind::BrokenPipe.into());
        }
        let capacity = self.frames.len();
        if self.count == capacity {
            return Err(io::ErrorKind::WouldBlock.into());
        }
        let slot = self.frames.get_mut((self.first + self.count) % capacity);
        let room = slot.and_then(|slot| Some((&mut slot.length_bytes, slot.bytes.get_mut(..frame.len())?)));
        let (length_bytes, bytes) = room.ok_or(io::ErrorKind::InvalidInput)?;
        bytes.copy_from_slice(frame);
        *length_bytes = frame.len();
        self.count += 1;
        Ok(())
    }

    /// Takes the oldest frame; a frame longer than `buffer` is cut off, as by a socket.
    fn pop(&mut self, buffer: &mut [u8]) -> Option<usize> {
        if self.count == 0 {
            return None;
        }
        let slot = self.frames.get(self.first)?;
        let length_bytes = slot.length_bytes.min(buffer.len());
        buffer.get_mut(..length_bytes)?.copy_from_slice(slot.bytes.get(..length_bytes)?);
        self.first = (self.first + 1) % self.frames.len();
        self.count -= 1;
        Some(length_bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOON: Duration = Duration::from_secs(10);
    const NEVER: Duration = Duration::from_secs(100_000);

    #[test]
    fn what_one_end_sends_the_other_receives_in_order() {
        let (mut one, mut other) = pair();
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        for length in [1usize, 60, 1514] {
            one.send(&vec![0xA5; length]).unwrap();
        }
        for length in [1, 60, 1514] {
            assert_eq!(other.receive(&mut buffer, SOON).unwrap(), Some(length));
            assert!(buffer[..length].iter().all(|byte| *byte == 0xA5));
        }
        assert_eq!(other.receive(&mut buffer, Duration::ZERO).unwrap(), None);
    }

    #[test]
    fn a_waiting_end_is_woken_by_a_frame() {
        let (mut one, mut other) = pair();
        let waiting = std::thread::spawn(move || other.receive(&mut [0; FRAME_BUFFER_BYTES], SOON).unwrap());
        one.send(&[1, 2, 3]).unwrap();
        assert_eq!(waiting.join().unwrap(), Some(3));
    }

    #[test]
    fn a_wait_or_the_next_one_is_ended_by_the_waker() {
        let (_one, mut other) = pair();
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        let waker = other.waker();
        waker.wake_by_ref();
        assert_eq!(other.receive(&mut buffer, NEVER).unwrap(), None);
        let waiting = std::thread::spawn(move || other.receive(&mut buffer, NEVER).unwrap());
        waker.wake();
        assert_eq!(waiting.join().unwrap(), None);
    }

    #[test]
    fn a_full_link_refuses_and_keeps_what_it_has() {
        let (mut one, mut other) = pair();
        for number in 0..CAPACITY_FRAMES {
            one.send(&[number as u8]).unwrap();
        }
        assert_eq!(one.send(&[0xFF]).unwrap_err().kind(), io::ErrorKind::WouldBlock);
        let mut buffer = [0; 4];
        for number in 0..CAPACITY_FRAMES {
            assert_eq!(other.receive(&mut buffer, Duration::ZERO).unwrap(), Some(1));
            assert_eq!(buffer[0], number as u8);
        }
    }

    #[test]
    fn a_closed_link_delivers_what_is_on_its_way_and_then_says_so() {
        let (mut one, mut other) = pair();
        one.send(&[7]).unwrap();
        drop(one);
        let mut buffer = [0; 4];
        assert_eq!(other.receive(&mut buffer, SOON).unwrap(), Some(1));
        assert_eq!(other.receive(&mut buffer, SOON).unwrap_err().kind(), io::ErrorKind::UnexpectedEof);
        assert_eq!(other.send(&[7]).unwrap_err().kind(), io::ErrorKind::BrokenPipe);
    }

    #[test]
    fn a_frame_that_no_buffer_holds_is_refused() {
        let (mut one, _other) = pair();
        let error = one.send(&[0; FRAME_BUFFER_BYTES + 1]).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
    }
}
