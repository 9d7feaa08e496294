//! Orders that find nothing to do. They are accepted, because files use them to be sure, and the report names them.

use super::maker::Maker;
use super::standing::Switch;
use crate::model::{CpuMode, CpuOrder, Expectation, LineOrder, MasterOrder, Mode, Order, UnitSet};
use crate::run::Warning;

impl Maker<'_> {
    /// Warns of an order that finds nothing to do, and notes what it changes.
    pub(super) fn warn_if_idle(&mut self, order: &Order, line: usize, text: &str) {
        let found = match order {
            Order::Master(order) => self.master_finds_nothing(order),
            Order::Cpu(order) => self.cpu_finds_nothing(order),
            Order::Line(order) => self.line_finds_nothing(order),
            Order::Expect(Expectation { mode: Mode::Within(limit), .. }) if limit.is_zero() => {
                Some("a `within` of 0 looks once, as an `expect` without it".to_owned())
            }
            Order::Unit(_) | Order::Expect(_) => None,
        };
        if let Some(message) = found {
            self.warnings.push(Warning { line, text: text.to_owned(), message });
        }
    }

    fn master_finds_nothing(&mut self, order: &MasterOrder) -> Option<String> {
        let standing = &mut self.standing;
        match order {
            MasterOrder::StopProcessData => {
                let was_stopped = core::mem::replace(&mut standing.is_stopped, true);
                was_stopped.then(|| idle("the process data are stopped already"))
            }
            MasterOrder::Take { .. } | MasterOrder::ExchangeProcessData { .. } | MasterOrder::Restart => {
                standing.is_stopped = false;
                None
            }
            MasterOrder::Request { .. }
            | MasterOrder::SetOutputs { .. }
            | MasterOrder::MapPdo { .. }
            | MasterOrder::AssignPdos { .. }
            | MasterOrder::SetSyncManagerLength { .. }
            | MasterOrder::SetSyncManagerControl { .. }
            | MasterOrder::WriteSdo { .. }
            | MasterOrder::ReadSdo { .. }
            | MasterOrder::WriteRegister { .. }
            | MasterOrder::WriteRegisterInHalves { .. }
            | MasterOrder::ReadCompleteSdo { .. }
            | MasterOrder::WriteCompleteSdo { .. }
            | MasterOrder::WriteSdoInSegments { .. }
            | MasterOrder::ReadObjectList { .. }
            | MasterOrder::DescribeObject { .. }
            | MasterOrder::DescribeEntry { .. }
            | MasterOrder::ReadRegister { .. }
            | MasterOrder::SendMailboxMessage { .. }
            | MasterOrder::SendFrame { .. }
            | MasterOrder::UseMailboxCounter { .. }
            | MasterOrder::ReadNoMailbox
            | MasterOrder::ReadNoEmergencies
            | MasterOrder::Behave => None,
        }
    }

    fn line_finds_nothing(&mut self, order: &LineOrder) -> Option<String> {
        match order {
            LineOrder::Disturb(_) => self.standing.has_frame_fault = true,
            LineOrder::BeQuiet => {
                let had_fault = core::mem::replace(&mut self.standing.has_frame_fault, false);
                let is_idle = !had_fault && self.standing.is_known();
                return is_idle.then(|| idle("no step has begun a fault of frames"));
            }
            LineOrder::Unplug { .. } | LineOrder::Plug { .. } | LineOrder::End { .. } => {}
        }
        None
    }

    fn cpu_finds_nothing(&mut self, order: &CpuOrder) -> Option<String> {
        match order {
            CpuOrder::SetMode { units, mode } => {
                let name = if *mode == CpuMode::Run { "RUN" } else { "PROGRAM" };
                self.turn(Switch::Run, units, *mode == CpuMode::Run, &format!("in {name} mode"))
            }
            // An error can stop them too: an order to start is never certain to find nothing.
            CpuOrder::StopIoRefreshing { units } => {
                self.turn(Switch::Refreshing, units, false, "without I/O refreshing")
            }
            CpuOrder::StartIoRefreshing { units } => {
                let _ = self.turn(Switch::Refreshing, units, true, "");
                None
            }
            CpuOrder::StopTask { units } => self.turn(Switch::Task, units, false, "without its task"),
            CpuOrder::StartTask { units } => {
                let _ = self.turn(Switch::Task, units, true, "");
                None
            }
            CpuOrder::CycleRackPower { units }
            | CpuOrder::PowerOffRack { units }
            | CpuOrder::PowerOnRack { units } => {
                for switch in [Switch::Run, Switch::Refreshing, Switch::Task] {
                    let _ = self.turn(switch, units, true, "");
                }
                None
            }
            CpuOrder::Force { variable, .. } => {
                self.standing.forced.insert(variable.clone());
                None
            }
            CpuOrder::Release { variable } => {
                let is_forced = self.standing.forced.iter().any(|forced| base(forced) == base(variable));
                let is_idle = !is_forced && self.standing.is_known();
                is_idle.then(|| idle(&format!("no step has forced {variable}")))
            }
            CpuOrder::ReleaseAll { .. } => {
                let is_idle = self.standing.forced.is_empty() && self.standing.is_known();
                is_idle.then(|| idle("no step has forced a variable"))
            }
            CpuOrder::ResetNxBusErrors { .. }
            | CpuOrder::SendNxMessages { .. }
            | CpuOrder::SetInputs { .. }
            | CpuOrder::JumpSystemTime { .. }
            | CpuOrder::Write { .. }
            | CpuOrder::Load { .. } => None,
        }
    }

    fn turn(&mut self, switch: Switch, units: &UnitSet, on: bool, words: &str) -> Option<String> {
        let positions = self.positions(units);
        let does_something = self.standing.set(switch, &positions, on);
        let (units, are) = match units {
            UnitSet::One(unit) => (format!("the CPU Unit of {unit}"), "is"),
            units @ (UnitSet::All | UnitSet::Several(_)) => (format!("the CPU Units of {units}"), "are"),
        };
        (!does_something).then(|| idle(&format!("{units} {are} {words} already")))
    }
}

fn idle(found: &str) -> String {
    format!("{found}, so the order does nothing")
}

/// The variable of an element.
fn base(variable: &str) -> &str {
    variable.split(['[', '.']).next().unwrap_or(variable)
}
