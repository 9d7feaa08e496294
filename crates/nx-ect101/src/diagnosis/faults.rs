//! Faults: their causes, and which of them the unit has found.

use wire::AlStatusCode;

use super::{Diagnosis, NX_BUS, Occurrence};
use crate::fault::{Fault, FaultSet};

/// Causes.
impl Diagnosis {
    /// The cause of a fault is injected. A fault that the unit detects immediately occurs immediately.
    pub(crate) fn inject(&mut self, fault: Fault) {
        if fault == Fault::MessageCommunications {
            return self.raise(Occurrence::new(fault.event(), [0, NX_BUS]));
        }
        self.forget_bygone(fault);
        self.injected.insert(fault);
        if fault.is_found_at_once() {
            self.find(fault);
        }
    }

    /// The injected cause of a fault is removed. A fault that the unit has found remains until its recovery.
    pub(crate) const fn remove(&mut self, fault: Fault) {
        self.injected.remove(fault);
    }

    /// Whether any cause is injected.
    pub(crate) fn has_injected(&self) -> bool {
        self.injected != FaultSet::default()
    }

    /// Whether the cause of this fault is injected.
    pub(crate) const fn is_injected(&self, fault: Fault) -> bool {
        self.injected.contains(fault)
    }

    /// The unit itself detects the cause of a fault, in addition to injected causes.
    pub(crate) fn see(&mut self, fault: Fault) {
        self.forget_bygone(fault);
        self.seen.insert(fault);
        self.find(fault);
    }

    /// The unit itself detects the cause of a fault before it starts; the start finds the fault.
    pub(crate) const fn see_before_start(&mut self, fault: Fault) {
        self.seen.insert(fault);
    }

    /// A fault that a reset would clear ends with its cause: it occurs again when the cause returns.
    fn forget_bygone(&mut self, fault: Fault) {
        if fault.goes_with_reset() && !self.is_present(fault) {
            self.forget(fault);
        }
    }

    /// The unit no longer detects the cause.
    pub(crate) const fn see_no_more(&mut self, fault: Fault) {
        self.seen.remove(fault);
    }

    /// Whether there is a cause of a fault.
    pub(crate) const fn is_present(&self, fault: Fault) -> bool {
        self.injected.contains(fault) || self.seen.contains(fault)
    }
}

/// Finding faults.
impl Diagnosis {
    /// The unit starts and checks for faults.
    pub(super) fn find_at_start(&mut self) {
        self.found.clear();
        for fault in Fault::ALL {
            if self.is_present(fault) && (fault.is_found_at_start() || fault.is_found_at_once()) {
                self.found.insert(fault);
            }
        }
        self.untold = self.found;
    }

    /// Reports the faults that the start has found, each once.
    pub(crate) fn tell_start(&mut self) {
        let untold = core::mem::take(&mut self.untold);
        for fault in untold.iter() {
            self.raise(Occurrence::of_fault(fault));
        }
    }

    /// The unit has found a fault: it is reported once.
    pub(crate) fn find(&mut self, fault: Fault) {
        if !self.found.contains(fault) {
            self.found.insert(fault);
            self.raise(Occurrence::of_fault(fault));
        }
    }

    /// The errors are reset. A fault whose cause is gone and that persists until the start remains an error and
    /// does not occur again.
    pub(super) fn reset_faults(&mut self) {
        for fault in self.found.iter() {
            match (self.is_present(fault), fault.goes_with_reset()) {
                (false, true) => self.forget(fault),
                _ if self.untold.contains(fault) => {}
                (true, _) => self.raise(Occurrence::of_fault(fault)),
                (false, false) => self.list(fault.row(), &Occurrence::of_fault(fault)),
            }
        }
    }

    /// The unit has recovered from a fault.
    pub(super) const fn forget(&mut self, fault: Fault) {
        self.found.remove(fault);
        self.untold.remove(fault);
    }

    /// Whether a fault has been found that prevents I/O refreshing.
    pub(crate) fn stops_io(&self) -> bool {
        self.found.iter().any(Fault::stops_io)
    }

    /// The AL status code of the faults that keep the unit in INIT: of the first one that has a code;
    /// [`AlStatusCode::NO_ERROR`] if none has.
    pub(crate) fn stop_in_init(&self) -> Option<AlStatusCode> {
        let mut stopping = self.found.iter().filter(|fault| fault.stops_in_init()).peekable();
        stopping.peek()?;
        Some(stopping.find_map(Fault::al_status_code).unwrap_or(AlStatusCode::NO_ERROR))
    }

    /// The faults that have been found.
    pub(crate) fn found(&self) -> impl Iterator<Item = Fault> + '_ {
        self.found.iter()
    }
}
