//! Orders that do nothing: a cable that is unplugged already, a unit that has no power, the cause of a fault that is there.
//!
//! What steps have changed is known from step to step. Random steps and groups can change anything: after them nothing is
//! known, and in them nothing is refused.

use super::maker::Maker;
use super::problem::Part;
use super::standing::Switch;
use crate::model::{CpuOrder, LineOrder, Order, UnitOrder, UnitSet};

/// The remedy for an order that does nothing.
const WAY_OUT: &str = "remove the step; where it is not known whether it does something, a group accepts it: `{ steps = [ … ] }`";

impl Maker<'_> {
    /// A group or random steps: nothing is known after them.
    pub(super) fn forget_standing(&mut self) {
        self.standing.forget();
    }

    /// Refuses an order that does nothing, and notes what it changes.
    pub(super) fn check_does_something(&mut self, order: &Order, part: Part) {
        let idle = match order {
            Order::Line(order) => self.line_does_nothing(order),
            Order::Unit(order) => self.unit_does_nothing(order),
            Order::Cpu(order) => self.cpu_does_nothing(order),
            Order::Master(_) | Order::Expect(_) => None,
        };
        if let Some(message) = idle {
            self.refuse(part, message, WAY_OUT);
        }
    }

    fn line_does_nothing(&mut self, order: &LineOrder) -> Option<String> {
        let (cable, on, words) = match order {
            LineOrder::Unplug { cable } => (cable, false, "unplugged"),
            LineOrder::Plug { cable } => (cable, true, "plugged"),
            LineOrder::Disturb(_) | LineOrder::End { .. } | LineOrder::BeQuiet => return None,
        };
        let does_something = self.standing.set(Switch::Cable, &[cable.position()], on);
        (!does_something).then(|| format!("{cable} is {words} already, so the order does nothing"))
    }

    fn unit_does_nothing(&mut self, order: &UnitOrder) -> Option<String> {
        let positions = self.positions(&order.units());
        match order {
            UnitOrder::PowerOff { units } => self.switch(Switch::Unit, &positions, false, units),
            UnitOrder::PowerOn { units } => self.switch(Switch::Unit, &positions, true, units),
            UnitOrder::CyclePower { .. } => {
                self.standing.set(Switch::Unit, &positions, true);
                None
            }
            UnitOrder::Replace { .. } => {
                self.standing.set(Switch::Unit, &positions, true);
                self.standing.set(Switch::Cpu, &positions, true);
                self.standing.faults.retain(|(at, _), _| !positions.contains(at));
                None
            }
            UnitOrder::InjectFault { units, fault } => self.inject(units, &positions, fault),
            UnitOrder::RemoveFault { units, fault } => self.repair(units, &positions, fault),
            UnitOrder::Restart { .. }
            | UnitOrder::ResetErrors { .. }
            | UnitOrder::ClearEventLog { .. }
            | UnitOrder::SetIdSwitch { .. }
            | UnitOrder::InvertSiiWord { .. }
            | UnitOrder::EraseSii { .. }
            | UnitOrder::LoadSii { .. }
            | UnitOrder::Conduct { .. } => None,
        }
    }

    fn cpu_does_nothing(&mut self, order: &CpuOrder) -> Option<String> {
        let (units, on) = match order {
            CpuOrder::PowerOffRack { units } => (units, false),
            CpuOrder::PowerOnRack { units } => (units, true),
            CpuOrder::CycleRackPower { units } => {
                let positions = self.positions(units);
                self.standing.set(Switch::Unit, &positions, true);
                self.standing.set(Switch::Cpu, &positions, true);
                return None;
            }
            CpuOrder::SetMode { .. }
            | CpuOrder::StopIoRefreshing { .. }
            | CpuOrder::StartIoRefreshing { .. }
            | CpuOrder::StopTask { .. }
            | CpuOrder::StartTask { .. }
            | CpuOrder::ResetNxBusErrors { .. }
            | CpuOrder::SendNxMessages { .. }
            | CpuOrder::SetInputs { .. }
            | CpuOrder::JumpSystemTime { .. }
            | CpuOrder::Write { .. }
            | CpuOrder::Force { .. }
            | CpuOrder::Release { .. }
            | CpuOrder::ReleaseAll { .. }
            | CpuOrder::Load { .. } => return None,
        };
        let positions = self.positions(units);
        let switches_unit = self.standing.set(Switch::Unit, &positions, on);
        let switches_cpu = self.standing.set(Switch::Cpu, &positions, on);
        let words = if on { "has power" } else { "has no power" };
        (!switches_unit && !switches_cpu)
            .then(|| format!("the CPU Rack of {units} {words} already, so the order does nothing"))
    }

    fn switch(&mut self, switch: Switch, positions: &[usize], on: bool, units: &UnitSet) -> Option<String> {
        let does_something = self.standing.set(switch, positions, on);
        let has = if matches!(units, UnitSet::One(_)) { "has" } else { "have" };
        let words = if on { "power already" } else { "no power already" };
        (!does_something).then(|| format!("{units} {has} {words}, so the order does nothing"))
    }

    fn inject(&mut self, units: &UnitSet, positions: &[usize], fault: &str) -> Option<String> {
        // Units that do not exist are refused elsewhere.
        let mut does_something = positions.is_empty();
        for at in positions {
            let Some(unit) = self.units.get(*at) else { continue };
            let model = unit.file.section().model();
            let (is_single, needs_power) = (model.is_single_fault(fault), model.is_fault_of_operation(fault));
            let is_there = self.standing.is_there(*at, fault);
            does_something |= is_single || is_there != Some(true);
            let has_power = if needs_power { self.standing.is_on(Switch::Unit, *at) } else { Some(true) };
            let place = (*at, fault.to_owned());
            match has_power {
                Some(true) if !is_single => drop(self.standing.faults.insert(place, true)),
                None if is_there != Some(true) => drop(self.standing.faults.remove(&place)),
                Some(_) | None => {}
            }
        }
        (!does_something)
            .then(|| format!("the cause of {fault} is there already in {units}, so the order does nothing"))
    }

    fn repair(&mut self, units: &UnitSet, positions: &[usize], fault: &str) -> Option<String> {
        // Units that do not exist are refused elsewhere.
        let mut does_something = positions.is_empty();
        for at in positions {
            does_something |= self.standing.is_there(*at, fault) != Some(false);
            self.standing.faults.insert((*at, fault.to_owned()), false);
        }
        (!does_something)
            .then(|| format!("there is no cause of {fault} in {units}, so the order does nothing"))
    }

    pub(super) fn positions(&self, units: &UnitSet) -> Vec<usize> {
        units.positions(self.units.len()).collect()
    }
}
