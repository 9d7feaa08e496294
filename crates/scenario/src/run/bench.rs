//! What orders act on and conditions look at: units, CPU Units and the line, lent by whoever runs them.

mod looks;
mod orders;
mod plugged;
mod variables;

use device::Network;
use plant::Powered;
use plant::line::{LineFaults, LineOrder, LineRefusal};
use plc::CpuUnits;
use time::Instant;
use unit_model::ModelUnit;

use super::master::Master;
use super::recorded::Recorded;
use super::recording::Recording;
use super::records::Records;
use super::scenario::{Brought, UnitSource};

pub(crate) use looks::state_words;

/// The units of a line with everything that belongs to them, between two moments of their time.
pub(crate) struct Bench<'a> {
    pub(crate) network: &'a mut Network<Box<dyn ModelUnit>>,
    pub(crate) cpus: &'a mut CpuUnits,
    pub(crate) line: &'a mut dyn LineHands,
    /// What each unit has recorded.
    pub(crate) records: &'a mut [Records],
    pub(crate) brought: &'a Brought,
    pub(crate) supply: &'a dyn Supply,
    pub(crate) notes: &'a mut dyn Notes,
    /// None: other masters use the line.
    pub(crate) masters: Option<Masters<'a>>,
    pub(crate) now: Instant,
}

/// The masters of a scenario.
#[derive(Clone, Copy)]
pub(crate) struct Masters<'a> {
    pub(crate) scripted: &'a Master,
    pub(crate) recorded: &'a Recorded,
}

/// Carries out orders on cables and faults of frames.
pub(crate) trait LineHands {
    /// Carries out an order.
    ///
    /// # Errors
    /// [`LineRefusal`]; then nothing has changed.
    fn order(
        &mut self,
        now: Instant,
        order: &LineOrder,
        network: &mut Network<Box<dyn ModelUnit>>,
    ) -> Result<(), LineRefusal>;
}

impl<T: Copy> LineHands for LineFaults<T> {
    fn order(
        &mut self,
        now: Instant,
        order: &LineOrder,
        network: &mut Network<Box<dyn ModelUnit>>,
    ) -> Result<(), LineRefusal> {
        self.order(now, order, network)
    }
}

/// Gives power to units that take the places of others.
pub(crate) trait Supply {
    /// A unit and its CPU Unit with power. `number` counts the units that were brought, from 0.
    fn power(&self, number: usize, unit: &UnitSource, now: Instant) -> Powered;
}

/// Takes down what orders do in addition to their effect.
pub(crate) trait Notes {
    /// A participant, such as `unit 1`, and what it does.
    fn tell(&mut self, now: Instant, who: &str, what: &str);
}

impl Notes for Recording {
    fn tell(&mut self, now: Instant, who: &str, what: &str) {
        self.tell(now, who, what);
    }
}
