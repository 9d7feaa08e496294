//! The kernel's notice that some interface has changed.

use std::io;
use std::os::fd::{AsFd, OwnedFd};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use rustix::net::netlink::SocketAddrNetlink;
use rustix::net::{AddressFamily, RecvFlags, SocketFlags, SocketType, bind, recv, socket_with};

/// `RTMGRP_LINK` of rtnetlink(7): interfaces that are added, removed or changed.
const LINKS: u32 = 1;
/// Notices can be lost when the kernel has no room for them.
const LONGEST_SLEEP: Timespec = Timespec { tv_sec: 1, tv_nsec: 0 };

/// A netlink socket that is used only to wake the thread: the contents of a notice are looked up again, so that
/// a lost notice costs only time.
pub(super) struct Bell {
    notices: OwnedFd,
}

impl Bell {
    pub(super) fn new() -> io::Result<Self> {
        let flags = SocketFlags::CLOEXEC | SocketFlags::NONBLOCK;
        // If no protocol is given, it is NETLINK_ROUTE.
        let notices = socket_with(AddressFamily::NETLINK, SocketType::RAW, flags, None)?;
        bind(&notices, &SocketAddrNetlink::new(0, LINKS))?;
        Ok(Self { notices })
    }

    /// Waits until something has changed, or for a second. False: the other end of `hung_up` is closed.
    pub(super) fn wait(&self, hung_up: &impl AsFd) -> bool {
        let mut ends = [PollFd::new(&self.notices, PollFlags::IN), PollFd::new(hung_up, PollFlags::IN)];
        let woken = poll(&mut ends, Some(&LONGEST_SLEEP));
        self.drain();
        woken.is_err() || ends[1].revents().is_empty()
    }

    fn drain(&self) {
        let mut notice = [0_u8; 4096];
        // Notices that were lost (ENOBUFS) have rung the bell too.
        while matches!(recv(&self.notices, &mut notice, RecvFlags::empty()), Ok(_) | Err(Errno::NOBUFS)) {}
    }
}
