//! Processes that a command has left running, where no namespace ends them.

use std::fs;

use rustix::process::{Pid, Signal, WaitOptions, getpid, kill_process, set_child_subreaper, wait};

/// Processes whose parent ends become children of this one.
pub(super) fn adopt() {
    if let Err(error) = set_child_subreaper(Some(getpid())) {
        tracing::warn!("processes that the command leaves will not be ended: {error}");
    }
}

/// Kills all children, then those that become children by this, until there are none.
pub(super) fn end() {
    loop {
        let children = children();
        if children.is_empty() {
            return;
        }
        for child in children {
            // An error means that it has ended.
            let _ = kill_process(child, Signal::KILL);
        }
        let _ended = wait(WaitOptions::empty());
    }
}

/// The children of this process, also those that have ended and wait to be taken.
fn children() -> Vec<Pid> {
    let id = getpid().as_raw_pid();
    let listed = fs::read_to_string(format!("/proc/{id}/task/{id}/children")).unwrap_or_default();
    listed.split_whitespace().filter_map(|child| child.parse().ok().and_then(Pid::from_raw)).collect()
}
