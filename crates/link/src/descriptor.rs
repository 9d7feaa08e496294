//! Receiving from descriptors of the kernel.

use std::io;
use std::os::fd::AsFd;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use time::Duration;

use crate::wake_event::WakeEvent;

/// Waits in the kernel until a non-blocking descriptor has bytes, and receives them. Uses `ppoll` rather than a
/// receive time-out, which counts in ticks of up to 10 ms. `wake` ends the wait. There is no receive attempt before it: on one core
/// that call would keep the master from running.
pub(crate) fn receive_from(
    descriptor: &impl AsFd,
    wake: &WakeEvent,
    wait: Duration,
    mut receive: impl FnMut() -> io::Result<usize>,
) -> io::Result<Option<usize>> {
    if wait.is_zero() || readable(descriptor, wake, wait)? { unless_none_there(receive()) } else { Ok(None) }
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

fn readable(descriptor: &impl AsFd, wake: &WakeEvent, wait: Duration) -> io::Result<bool> {
    let nanos = wait.as_nanos();
    let timeout = Timespec {
        tv_sec: i64::try_from(nanos / 1_000_000_000).unwrap_or(i64::MAX),
        tv_nsec: (nanos % 1_000_000_000).try_into().unwrap_or(0),
    };
    let mut ends = [PollFd::new(descriptor, PollFlags::IN), PollFd::new(wake, PollFlags::IN)];
    match poll(&mut ends, Some(&timeout)) {
        Ok(_) => {
            if !ends[1].revents().is_empty() {
                wake.clear();
            }
            Ok(!ends[0].revents().is_empty())
        }
        // A signal: the caller checks its stop flag.
        Err(rustix::io::Errno::INTR) => Ok(false),
        Err(error) => Err(error.into()),
    }
}

const ETHERTYPE_AT: usize = 12;

/// Whether an ESC would examine this frame: EtherCAT, also after a VLAN tag, or IPv4, which may contain it.
pub(crate) fn may_be_ethercat(frame: &[u8]) -> bool {
    matches!(frame.get(ETHERTYPE_AT..ETHERTYPE_AT + 2), Some([0x88, 0xA4] | [0x81, 0x00] | [0x08, 0x00]))
}
