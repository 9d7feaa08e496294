//! File descriptors: the limit of this process, and detecting that they are used up.

use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
pub(crate) use storage::descriptors_are_exhausted as are_exhausted;

/// Open while the memory of a unit is in a file: the file, the lock on its name, its folder, and one in reserve.
const EACH_UNIT: u64 = 4;
/// Links, servers and everything else, with a margin.
const EVERYTHING_ELSE: u64 = 128;

/// Raises the limit for the files of this number of units, as far as the system permits. If that is
/// insufficient, a unit is refused when its file is opened.
pub(crate) fn make_room(units: usize) {
    let limit = getrlimit(Resource::Nofile);
    let wanted = EVERYTHING_ELSE + EACH_UNIT * units as u64;
    if limit.current.is_some_and(|current| EACH_UNIT * units as u64 > current / 2) {
        let current =
            limit.maximum.map_or(wanted, |maximum| wanted.min(maximum)).max(limit.current.unwrap_or(0));
        let _ = setrlimit(Resource::Nofile, Rlimit { current: Some(current), ..limit });
    }
}
