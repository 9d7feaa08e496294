//! What the scripted master knows and has done, for conditions and traces.

use plc::Reports;

use crate::model::WhichUnit;

use super::Master;
use super::emergencies::Received;
use super::given_up::{GivenUp, OrderNumber};
use super::last_sdo::LastSdo;
use super::operation::Operation;
use super::raw::Raw;

impl Master {
    pub(crate) fn cycles(&self) -> u64 {
        self.process_data.cycles()
    }

    pub(crate) fn is_idle(&self) -> bool {
        self.operations.iter().all(Operation::is_listening) && self.raw.is_idle()
    }

    pub(crate) fn activity(&self) -> String {
        let frame = || if self.raw.is_idle() { "nothing".to_owned() } else { "a frame".to_owned() };
        self.operations.front().map_or_else(frame, Operation::words)
    }

    /// Whether it has given up an order since its start.
    pub(crate) const fn has_given_up(&self) -> bool {
        self.given_up.any()
    }

    /// Whether it has given up an order since the orders directly before the present step.
    pub(crate) const fn has_given_up_again(&self) -> bool {
        self.given_up.any_again()
    }

    /// The orders that it has given up, also before its last start.
    pub(crate) fn given_up(&self) -> &[GivenUp] {
        self.given_up.all()
    }

    /// The number of the order that a step has given last.
    pub(crate) fn last_order(&self) -> Option<OrderNumber> {
        self.given_up.last()
    }

    /// From now on orders are given: what it gives up later is new.
    pub(crate) const fn mark(&mut self) {
        self.given_up.mark();
    }

    /// The SDO that was ordered last of a unit, or of all units.
    pub(crate) fn last_sdo(&self, unit: Option<&WhichUnit>) -> &LastSdo {
        self.last_sdos.get(unit)
    }

    /// What it has read without any service.
    pub(crate) const fn raw(&self) -> &Raw {
        &self.raw
    }

    /// The working counter of each datagram of process data in the present cycle, and the expected one; empty while none
    /// are exchanged.
    pub(crate) fn working_counters(&self) -> Vec<(Option<u16>, u16)> {
        self.process_data.working_counters()
    }

    /// The emergencies since its start, in the order in which it has read them.
    pub(crate) fn emergencies(&self) -> &[Received] {
        &self.emergencies
    }

    pub(crate) fn inputs(&self, unit: usize) -> &[u8] {
        self.process_data.inputs(unit)
    }

    pub(crate) fn working_counter(&self, unit: usize) -> Option<u16> {
        self.process_data.working_counter(unit)
    }

    /// The reports of its user program.
    pub(crate) const fn told(&self) -> &Reports {
        &self.told
    }

    /// The value of a variable of its user program as text.
    pub(crate) fn program_variable(&self, name: &str) -> Option<String> {
        self.task.as_ref()?.value(name)
    }

    /// The abort codes of SDOs that were refused since the last call.
    pub(crate) fn take_refusals(&mut self) -> Vec<u32> {
        core::mem::take(&mut self.refusals)
    }

    /// Its reports since the last call.
    pub(crate) fn take_story(&mut self) -> Vec<String> {
        std::mem::take(&mut self.story)
    }
}
