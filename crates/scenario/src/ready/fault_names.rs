//! The names of faults of frames.

use crate::model::FaultName;

/// The names of the faults in the steps so far, and whether the fault is at work for certain.
#[derive(Default)]
pub(super) struct FaultNames {
    names: Vec<(FaultName, AtWork)>,
}

/// Whether a fault is at work at a step.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum AtWork {
    Yes,
    /// It may have ended by itself.
    Maybe,
    /// A step has ended it.
    No,
}

impl FaultNames {
    pub(super) fn of(&self, name: &FaultName) -> Option<AtWork> {
        self.names.iter().find(|(known, _)| known == name).map(|(_, at_work)| *at_work)
    }

    pub(super) fn set(&mut self, name: &FaultName, at_work: AtWork) {
        self.names.retain(|(known, _)| known != name);
        self.names.push((name.clone(), at_work));
    }

    pub(super) fn end_all(&mut self) {
        self.names.iter_mut().for_each(|(_, at_work)| *at_work = AtWork::No);
    }

    /// The known name that is most like this one, if one is.
    pub(super) fn nearest(&self, name: &FaultName) -> Option<&FaultName> {
        let likeness = |known: &FaultName| strsim::jaro_winkler(known.as_str(), name.as_str());
        let known = self.names.iter().map(|(known, _)| (likeness(known), known));
        let nearest = known.max_by(|(a, _), (b, _)| a.total_cmp(b));
        nearest.filter(|(likeness, _)| *likeness >= 0.8).map(|(_, known)| known)
    }
}
