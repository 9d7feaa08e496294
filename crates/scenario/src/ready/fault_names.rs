//! The names of faults of frames.

use user_file::nearest;

use crate::model::FaultName;

/// The names of the faults in the steps so far, and whether the fault is at work for certain.
#[derive(Clone, Default)]
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

    /// From here on any of them may have been ended.
    pub(super) fn may_have_ended(&mut self) {
        let at_work = self.names.iter_mut().filter(|(_, at_work)| *at_work == AtWork::Yes);
        at_work.for_each(|(_, at_work)| *at_work = AtWork::Maybe);
    }

    /// Another known name that is near this one.
    pub(super) fn nearest(&self, name: &FaultName) -> Option<String> {
        let others =
            self.names.iter().map(|(known, _)| known.as_str()).filter(|known| *known != name.as_str());
        nearest(name.as_str(), &others.collect::<Vec<_>>())
    }
}
