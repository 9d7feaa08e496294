//! What orders act on and conditions look at: units, CPU Units and the line, lent by whoever runs them.

mod looks;
mod orders;
mod plugged;
mod settled;
mod variables;

use device::Network;
use plant::Powered;
use plant::line::{ActiveFault, LineFaults, LineOrder, LineRefusal};
use plc::CpuUnits;
use time::Instant;
use unit_model::ModelUnit;

use super::master::Master;
use super::recorded::Recorded;
use super::recording::Recording;
use super::records::Records;
use super::scenario::{Brought, UnitSource};
use super::witness::Witness;
use crate::model::{Condition, Order};
use crate::refused::{Reason, Refused};

pub(crate) use looks::state_words;

/// The units of a line with everything that belongs to them, between two moments of their time.
pub struct Bench<'a> {
    pub(crate) network: &'a mut Network<Box<dyn ModelUnit>>,
    pub(crate) cpus: &'a mut CpuUnits,
    pub(crate) line: &'a mut dyn LineHands,
    /// What each unit has recorded.
    pub(crate) records: &'a mut [Records],
    /// What the master has done.
    pub(crate) witness: &'a mut Witness,
    pub(crate) brought: &'a Brought,
    pub(crate) supply: &'a dyn Supply,
    pub(crate) notes: &'a mut dyn Notes,
    /// None: other masters use the line.
    pub(crate) masters: Option<Masters<'a>>,
    pub(crate) now: Instant,
    /// Units and CPU Units on which an order had no effect, and why.
    pub(crate) without_effect: Vec<String>,
}

/// The parts of a line that runs with other masters than those of scenarios.
pub struct Lent<'a> {
    /// The units.
    pub network: &'a mut Network<Box<dyn ModelUnit>>,
    /// The CPU Units, in the order of the line.
    pub cpus: &'a mut CpuUnits,
    /// Cables and faults of frames.
    pub line: &'a mut dyn LineHands,
    /// What each unit has recorded.
    pub records: &'a mut [Records],
    /// What the master has done.
    pub witness: &'a mut Witness,
    /// What the order brings to the line.
    pub brought: &'a Brought,
    /// Gives power to units that it brings.
    pub supply: &'a dyn Supply,
    /// Takes down what an order does in addition.
    pub notes: &'a mut dyn Notes,
    /// The present time.
    pub now: Instant,
}

impl<'a> From<Lent<'a>> for Bench<'a> {
    fn from(lent: Lent<'a>) -> Self {
        let Lent { network, cpus, line, records, witness, brought, supply, notes, now } = lent;
        let without_effect = Vec::new();
        let masters = None;
        Self { network, cpus, line, records, witness, brought, supply, notes, masters, now, without_effect }
    }
}

impl Bench<'_> {
    /// The present time.
    #[must_use]
    pub const fn now(&self) -> Instant {
        self.now
    }

    /// Orders are given: what is recorded from now on is new.
    pub(crate) fn mark(&mut self) {
        self.records.iter_mut().for_each(Records::mark);
    }

    /// Counts from now on what these conditions ask for.
    pub(crate) fn watch<'c>(&mut self, conditions: impl IntoIterator<Item = &'c Condition>) {
        let Self { network, witness, now, .. } = self;
        conditions.into_iter().for_each(|condition| witness.watch(condition, network, *now));
    }

    /// Carries out an order that has been checked for this line.
    ///
    /// # Errors
    /// [`Reason::NotNow`], [`Reason::WithoutEffect`]; an order to a master is [`Reason::ScriptedMaster`].
    pub fn carry_out(&mut self, order: &Order) -> Result<(), Refused> {
        self.without_effect.clear();
        self.mark();
        match order {
            Order::Unit(order) => self.unit_order(order),
            Order::Cpu(order) => self.cpu_order(order),
            Order::Line(order) => {
                let ordered = self.line.order(self.now, order, self.network);
                return ordered.map_err(|refusal| Refused::new(Reason::NotNow, refusal.to_string(), ""));
            }
            Order::Master(_) | Order::Expect(_) => {
                return Err(Refused::new(Reason::ScriptedMaster, "a line carries out no such order", ""));
            }
        }
        let units = order.clone().unit_words().map(|units| units.set());
        let targets = units.map_or(1, |units| units.positions(self.network.len()).count());
        if self.without_effect.is_empty() || self.without_effect.len() < targets {
            return Ok(());
        }
        let message = format!("{}: the order has no effect", self.without_effect.join(", "));
        Err(Refused::new(Reason::WithoutEffect, message, ""))
    }
}

/// The masters of a scenario.
#[derive(Clone, Copy)]
pub(crate) struct Masters<'a> {
    pub(crate) scripted: &'a Master,
    pub(crate) recorded: &'a Recorded,
}

/// Carries out orders on cables and faults of frames.
pub trait LineHands {
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

    /// Shows each fault of frames that is at work.
    fn each_active(&self, now: Instant, show: &mut dyn FnMut(ActiveFault<'_>));
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

    fn each_active(&self, now: Instant, show: &mut dyn FnMut(ActiveFault<'_>)) {
        self.active(now).for_each(show);
    }
}

/// Gives power to units that take the places of others.
pub trait Supply {
    /// A unit and its CPU Unit with power. `number` counts the units that were brought, from 0.
    fn power(&self, number: usize, unit: &UnitSource, now: Instant) -> Powered;
}

/// Takes down what orders do in addition to their effect.
pub trait Notes {
    /// A participant, such as `unit 1`, and what it does.
    fn tell(&mut self, now: Instant, who: &str, what: &str);
}

impl Notes for Recording {
    fn tell(&mut self, now: Instant, who: &str, what: &str) {
        self.tell(now, who, what);
    }
}
