//! The acts of a master on one unit, counted.

use time::Instant;

use crate::model::MasterAct;

/// Numbers the acts of all units in their order: several of them can have one time.
#[derive(Debug, Default)]
pub(super) struct Moments(u64);

/// How often something was done, and when first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Done {
    pub(crate) count: u64,
    /// Its time, and its number among all acts.
    pub(crate) first: Option<(Instant, u64)>,
}

/// The acts that are counted.
#[derive(Debug, Default)]
pub(super) struct Acts(Vec<(MasterAct, Done)>);

impl Acts {
    /// Counts this one too.
    pub(super) fn watch(&mut self, act: &MasterAct) {
        if self.done(act).is_none() {
            self.0.push((act.clone(), Done::default()));
        }
    }

    pub(super) fn done(&self, act: &MasterAct) -> Option<&Done> {
        self.0.iter().find(|(known, _)| known == act).map(|(_, done)| done)
    }

    /// The master does each of these now.
    pub(super) fn are_done(
        &mut self,
        now: Instant,
        moments: &mut Moments,
        which: impl Fn(&MasterAct) -> bool,
    ) {
        for (_, done) in self.0.iter_mut().filter(|(act, _)| which(act)) {
            moments.0 += 1;
            done.count += 1;
            done.first.get_or_insert((now, moments.0));
        }
    }
}
