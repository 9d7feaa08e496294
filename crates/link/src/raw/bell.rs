//! The kernel's notice that some interface has changed.

use std::io;
use std::os::fd::{AsFd, OwnedFd};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use rustix::net::netlink::SocketAddrNetlink;
use rustix::net::{AddressFamily, RecvFlags, SocketFlags, SocketType, bind, recv, socket_with};

/// `RTMGRP_LINK` of rtnetlink(7): interfaces that come, go or change.
const LINKS: u32 = 1;
/// Notices can be lost when the kernel has no room for them.
const LONGEST_SLEEP: Timespec = Timespec { tv_sec: 1, tv_nsec: 0 };

/// A netlink socket that is read for its waking only: what it says is looked up afresh, so that a lost notice costs
/// time and nothing else.
pub(super) struct Bell {
    notices: OwnedFd,
}

impl Bell {
    pub(super) fn new() -> io::Result<Self> {
        let flags = SocketFlags::CLOEXEC | SocketFlags::NONBLOCK;
        // The protocol that is meant where none is named is NETLINK_ROUTE.
        let notices = socket_with(AddressFamily::NETLINK, SocketType::RAW, flags, None)?;
        bind(&notices, &SocketAddrNetlink::new(0, LINKS))?;
        Ok(Self { notices })
    }

    /// Sleeps until something has changed, or for a second. No: the other end of `hung_up` is closed.
    pub(super) fn wait(&self, hung_up: &impl AsFd) -> bool {
        let mut ends = [PollFd::new(&self.notices, PollFlags::IN), PollFd::new(hung_up, PollFlags::IN)];
        let woken = poll(&mut ends, Some(&LONGEST_SLEEP));
        self.drain();
        woken.is_err() || ends[1].revents().is_empty()
    }

    fn drain(&self) {
        let mut notice = [0_u8; 4096];
        // Notices that were lost (ENOBUFS) have been rung for all the same.
        while matches!(recv(&self.notices, &mut notice, RecvFlags::empty()), Ok(_) | Err(Errno::NOBUFS)) {}
    }
}
