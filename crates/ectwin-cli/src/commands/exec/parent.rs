//! The parent of a process: when it ends, however that is, the process gets a signal.

use rustix::process::{Pid, Signal, getppid, set_parent_process_death_signal};

/// The signal of a parent's end. Nobody else sends it.
pub(super) const PARENTS_END: Signal = Signal::IO;

/// The parent at the beginning.
pub(super) struct Parent(Option<Pid>);

/// From now on the end of the parent is a signal.
pub(super) fn watch() -> Parent {
    let parent = getppid();
    if let Err(error) = set_parent_process_death_signal(Some(PARENTS_END)) {
        tracing::warn!("the end of the parent process will not be noticed: {error}");
    }
    Parent(parent)
}

impl Parent {
    /// Whether the process is gone. The kernel sends the signal also when only the thread that had started this one ends.
    pub(super) fn is_gone(&self) -> bool {
        getppid() != self.0
    }
}
