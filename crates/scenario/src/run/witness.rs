//! What the master of a line has done, as far as conditions ask for it: by its frames, and by what units report.
//!
//! It sees each frame before the units, and each answer behind them. Without a question it costs a frame one
//! comparison, and it allocates only when a condition begins to ask.

mod acts;
mod exchange;
mod mailbox;
mod unit;

use device::Network;
use plant::Happening;
use time::Instant;
use unit_model::ModelUnit;
use wire::datagrams;

use crate::model::{Condition, MasterAct, Quantity, WhichUnit};
pub(crate) use acts::Done;
use acts::Moments;
pub(crate) use exchange::{Exchange, PERIODS};
use unit::WatchedUnit;

/// The units with which acts of the master are counted.
#[derive(Debug, Default)]
pub struct Witness {
    units: Vec<WatchedUnit>,
    moments: Moments,
}

impl Witness {
    /// Whether nobody asks.
    #[inline]
    #[must_use]
    pub const fn is_idle(&self) -> bool {
        self.units.is_empty()
    }

    /// Counts from now on what a condition asks for, unless it does so already.
    pub fn watch(&mut self, condition: &Condition, network: &Network<Box<dyn ModelUnit>>, now: Instant) {
        match condition {
            Condition::MasterHas { act, .. } => self.watch_act(act, network, now),
            Condition::MasterHasBefore { first, then } => {
                self.watch_act(first, network, now);
                self.watch_act(then, network, now);
            }
            Condition::ProcessDataCome { unit, .. } | Condition::WorkingCounter { unit, .. } => {
                self.watch_unit(unit, network, now);
            }
            Condition::Value { of, .. } => match of {
                Quantity::Acts { act } => self.watch_act(act, network, now),
                Quantity::WorkingCounter { unit }
                | Quantity::MeanPeriod { unit }
                | Quantity::LongestPeriod { unit } => self.watch_unit(unit, network, now),
                _ => {}
            },
            _ => condition.parts().iter().for_each(|part| self.watch(part, network, now)),
        }
    }

    fn watch_act(&mut self, act: &MasterAct, network: &Network<Box<dyn ModelUnit>>, now: Instant) {
        self.watch_unit(act.unit(), network, now);
        let of_act = self.units.iter_mut().find(|unit| unit.position == act.unit().position());
        of_act.into_iter().for_each(|unit| unit.acts.watch(act));
    }

    fn watch_unit(&mut self, unit: &WhichUnit, network: &Network<Box<dyn ModelUnit>>, now: Instant) {
        let position = unit.position();
        if self.units.iter().all(|unit| unit.position != position) {
            self.units.extend(WatchedUnit::beginning_with(network, position, now));
        }
    }

    /// A frame of the master is on its way to the units.
    pub fn frame(&mut self, now: Instant, frame: &[u8], network: &Network<Box<dyn ModelUnit>>) {
        let Self { units, moments } = self;
        for datagram in datagrams(frame) {
            for unit in &mut *units {
                unit.datagram(now, &datagram, network, moments);
            }
        }
        units.iter_mut().for_each(|unit| unit.end_of_frame(now, moments));
    }

    /// A frame returns to the master.
    pub fn answer(&mut self, answer: &[u8]) {
        for datagram in datagrams(answer) {
            self.units.iter_mut().for_each(|unit| unit.answer(&datagram));
        }
    }

    /// Something has happened to a unit.
    pub fn happening(&mut self, happening: &Happening) {
        let Self { units, moments } = self;
        let is_its = |unit: &&mut WatchedUnit| happening.position.map(usize::from) == Some(unit.position);
        units.iter_mut().filter(is_its).for_each(|unit| unit.happening(happening, moments));
    }

    /// Another unit has taken this place.
    pub fn is_replaced(&mut self, position: usize) {
        let is_its = |unit: &&mut WatchedUnit| unit.position == position;
        self.units.iter_mut().filter(is_its).for_each(WatchedUnit::begin_again);
    }

    /// How often, and when first, the master has done something; none: nobody has asked before.
    pub(crate) fn done(&self, act: &MasterAct) -> Option<&Done> {
        let unit = self.units.iter().find(|unit| unit.position == act.unit().position())?;
        unit.acts.done(act)
    }

    /// The process data of a unit; none: nobody has asked before.
    pub(crate) fn exchange(&self, position: usize) -> Option<&Exchange> {
        self.units.iter().find(|unit| unit.position == position).map(|unit| &unit.exchange)
    }
}
