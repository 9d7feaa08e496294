//! File descriptors: how many this process may have, and what is left of a call that got none.

use std::io;

use rustix::io::Errno;
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};

/// Open as long as a unit has its memory in a file: the file, and the lock on its name.
const EACH_UNIT: u64 = 2;
/// Links, servers and all else, generously.
const EVERYTHING_ELSE: u64 = 128;

/// Makes room for the files of so many units, as far as the system lets us. Where it is too little, a unit is refused
/// when its file is opened.
pub(crate) fn make_room(units: usize) {
    let limit = getrlimit(Resource::Nofile);
    let wanted = EVERYTHING_ELSE + EACH_UNIT * units as u64;
    if limit.current.is_some_and(|current| EACH_UNIT * units as u64 > current / 2) {
        let current =
            limit.maximum.map_or(wanted, |maximum| wanted.min(maximum)).max(limit.current.unwrap_or(0));
        let _ = setrlimit(Resource::Nofile, Rlimit { current: Some(current), ..limit });
    }
}

/// Whether a call has failed for want of a file descriptor.
pub(crate) fn are_exhausted(error: &io::Error) -> bool {
    [Errno::MFILE, Errno::NFILE].iter().any(|errno| error.raw_os_error() == Some(errno.raw_os_error()))
}
