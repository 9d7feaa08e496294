//! Faults: their causes, and what the unit has found of them.

use super::{Diagnosis, NX_BUS, Occurrence};
use crate::fault::Fault;

/// Causes.
impl Diagnosis {
    /// The cause of a fault is injected. What the unit finds at once occurs at once.
    pub(crate) fn inject(&mut self, fault: Fault) {
        if fault == Fault::MessageCommunications {
            return self.raise(Occurrence::new(fault.event(), [0, NX_BUS]));
        }
        self.injected.insert(fault);
        if fault.is_found_at_once() {
            self.find(fault);
        }
    }

    /// The injected cause of a fault is gone. What the unit has found stands until its recovery.
    pub(crate) const fn remove(&mut self, fault: Fault) {
        self.injected.remove(fault);
    }

    /// The unit itself sees the cause of a fault, beside what is injected.
    pub(crate) fn see(&mut self, fault: Fault) {
        self.seen.insert(fault);
        self.find(fault);
    }

    /// The unit itself sees it no more.
    pub(crate) const fn see_no_more(&mut self, fault: Fault) {
        self.seen.remove(fault);
    }

    /// Whether a cause of a fault is there.
    pub(crate) const fn is_present(&self, fault: Fault) -> bool {
        self.injected.contains(fault) || self.seen.contains(fault)
    }
}

/// What is found.
impl Diagnosis {
    /// The unit starts and looks for faults.
    pub(super) fn find_at_start(&mut self) {
        self.found.clear();
        for fault in Fault::ALL {
            if self.is_present(fault) && (fault.is_found_at_start() || fault.is_found_at_once()) {
                self.found.insert(fault);
            }
        }
        self.untold = self.found;
    }

    /// Tells the faults that the start has found, each once.
    pub(crate) fn tell_start(&mut self) {
        let untold = core::mem::take(&mut self.untold);
        for fault in untold.iter() {
            self.raise(Occurrence::of_fault(fault));
        }
    }

    /// The unit has found a fault: it is told once.
    pub(crate) fn find(&mut self, fault: Fault) {
        if !self.found.contains(fault) {
            self.found.insert(fault);
            self.raise(Occurrence::of_fault(fault));
        }
    }

    /// A fault is recovered from.
    pub(super) const fn forget(&mut self, fault: Fault) {
        self.found.remove(fault);
        self.untold.remove(fault);
    }

    /// Whether a fault is found that keeps I/O from being refreshed.
    pub(crate) fn stops_io(&self) -> bool {
        self.found.iter().any(Fault::stops_io)
    }

    /// The first of the faults that keep the unit in INIT.
    pub(crate) fn stop_in_init(&self) -> Option<Fault> {
        self.found.iter().find(|fault| fault.stops_in_init())
    }

    /// The faults that were found.
    pub(crate) fn found(&self) -> impl Iterator<Item = Fault> + '_ {
        self.found.iter()
    }
}
