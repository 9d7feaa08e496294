//! The effects of steps on units, CPU Units and the line. Every order has its arm: a missing one would do nothing.

#![deny(clippy::wildcard_enum_match_arm)]

use device::{Device, SiiTiming, Start, TransitionTimes};
use esc::Esc;
use plant::line::LineRefusal;
use plc::{CpuUnit, Io, OperatingMode};
use time::Instant;
use unit_model::{ModelUnit, NotThere};
use wire::AlStatusCode;

use super::Bench;
use super::plugged::ERASED;
use crate::model::{
    ConductOrder, CpuMode, CpuOrder, EventLog, ID_SWITCH, LineOrder, Needs, UnitOrder, UnitSet,
};

impl Bench<'_> {
    /// An order to each of its units. One without power does nothing, unless a hand carries out the order; a switch
    /// that is on cannot be switched on.
    pub(crate) fn unit_order(&mut self, order: &UnitOrder) {
        let units = order.units();
        for at in units.positions(self.count()) {
            match self.why_without_effect(order, at) {
                Some(reason) => self.note_without_effect(&format!("unit {}", at + 1), reason),
                None => self.act_on_unit(order, at),
            }
        }
    }

    fn why_without_effect(&self, order: &UnitOrder, at: usize) -> Option<&'static str> {
        let (no_power, power) = ("has no power", "has power");
        match (order.needs(), self.is_off(at)) {
            (Needs::NoPower, false) => Some(power),
            (Needs::Power, true) => Some(no_power),
            (Needs::PowerForFault(fault), true) => {
                self.unit(at).model().is_fault_of_operation(fault).then_some(no_power)
            }
            (Needs::Nothing, _)
            | (Needs::NoPower, true)
            | (Needs::Power | Needs::PowerForFault(_), false) => None,
        }
    }

    fn act_on_unit(&mut self, order: &UnitOrder, at: usize) {
        match order {
            UnitOrder::Restart { .. } => self.start(at, Start::Restart),
            UnitOrder::CyclePower { .. } | UnitOrder::PowerOn { .. } => self.start(at, Start::PowerOn),
            UnitOrder::PowerOff { .. } => self.power_off(at),
            UnitOrder::ResetErrors { .. } => self.with_unit(at, |unit| unit.reset_errors()),
            UnitOrder::ClearEventLog { log, .. } => {
                self.with_unit(at, |unit| unit.clear_event_log(event_log(*log)));
            }
            UnitOrder::SetIdSwitch { id, .. } => {
                self.with_named(at, |unit| unit.set_switch(ID_SWITCH, id.0.into()));
            }
            UnitOrder::InvertSiiWord { word, .. } => self.invert_sii_word(at, *word),
            UnitOrder::EraseSii { .. } => self.with_slave(at, |_, esc| esc.sii_image_mut().fill(ERASED)),
            UnitOrder::LoadSii { file, .. } => self.load_sii(at, file),
            UnitOrder::Replace { file, .. } => self.replace(at, file),
            UnitOrder::Conduct { conduct: order, .. } => {
                let now = self.now;
                self.with_slave(at, |device, esc| conduct(device, esc, order, now));
            }
            UnitOrder::InjectFault { fault, .. } => self.with_named(at, |unit| unit.inject(fault)),
            UnitOrder::RemoveFault { fault, .. } => self.with_named(at, |unit| unit.remove(fault)),
        }
    }

    pub(crate) fn cpu_order(&mut self, order: &CpuOrder) {
        match order {
            CpuOrder::SetMode { units, mode } => {
                self.each_cpu(units, |cpu| cpu.set_mode(operating_mode(*mode)));
            }
            CpuOrder::StopIoRefreshing { units } => {
                self.each_cpu(units, |cpu| cpu.set_io_refreshing(false));
            }
            CpuOrder::StartIoRefreshing { units } => {
                self.each_cpu(units, |cpu| cpu.set_io_refreshing(true));
            }
            CpuOrder::StopTask { units } => self.each_cpu(units, |cpu| cpu.stop_task()),
            CpuOrder::StartTask { units } => self.each_cpu(units, |cpu| cpu.start_task()),
            CpuOrder::ResetNxBusErrors { units } => self.each_cpu(units, |cpu| cpu.reset_errors()),
            CpuOrder::CycleRackPower { units } => self.each(units, Self::cycle_rack_power),
            CpuOrder::SendNxMessages { units, count } => {
                self.each_cpu(units, |cpu| cpu.load_nx_bus(*count));
            }
            CpuOrder::PowerOffRack { units } => self.each(units, Self::power_off_rack),
            CpuOrder::PowerOnRack { units } => self.each(units, Self::power_on_rack),
            CpuOrder::JumpSystemTime { units, by } => {
                self.each_cpu(units, |cpu| cpu.jump_system_time(*by));
            }
            CpuOrder::SetInputs { unit, bytes } => self.each_cpu(&UnitSet::One(unit.clone()), |cpu| {
                for (input, byte) in cpu.io_mut().c_to_m_mut().iter_mut().zip(&bytes.0) {
                    *input = *byte;
                }
            }),
            CpuOrder::Force { variable, value } => self.set_variable(variable, value, Io::force),
            CpuOrder::Write { variable, value } => self.set_variable(variable, value, Io::write),
            CpuOrder::Release { variable } => self.release(variable),
            CpuOrder::ReleaseAll { units } => self.each_cpu(units, |cpu| cpu.io_mut().release_all()),
            CpuOrder::Load { unit, program } => self.load(unit.position(), program),
        }
    }

    /// Loads a program, as `run` does with a changed file.
    fn load(&mut self, at: usize, file: &str) {
        let program =
            self.brought.programs.iter().find(|loaded| loaded.unit == at && loaded.file.name == file);
        let Some(program) = program.cloned() else { return };
        if !self.cpu_has_power(at) {
            return;
        }
        if let Some(cpu) = self.cpus.get_mut(at) {
            cpu.change_program(Box::new(program.file.program));
        }
    }

    /// A fault that has ended by itself can be ended too.
    pub(crate) fn line_order(&mut self, order: &LineOrder) -> Result<(), LineRefusal> {
        match self.line.order(self.now, order, self.network) {
            Err(LineRefusal::NoFault(name)) => {
                self.notes.tell(self.now, "line", &format!("{name} has ended already"));
                Ok(())
            }
            ordered => ordered,
        }
    }

    fn each(&mut self, units: &UnitSet, order: impl Fn(&mut Self, usize)) {
        units.positions(self.count()).for_each(|at| order(self, at));
    }

    fn with_unit(&mut self, at: usize, order: impl FnOnce(&mut dyn ModelUnit)) {
        if let Some(device) = self.network.device_mut(at) {
            order(&mut **device.unit_mut());
        }
    }

    /// An action on something that the model has by name. The name was checked when the scenario was read.
    fn with_named(&mut self, at: usize, order: impl FnOnce(&mut dyn ModelUnit) -> Result<(), NotThere>) {
        self.with_unit(at, |unit| {
            let _ = order(unit);
        });
    }

    fn with_slave(&mut self, at: usize, order: impl FnOnce(&mut Device<Box<dyn ModelUnit>>, &mut Esc)) {
        if let Some((device, esc)) = self.network.slave_mut(at) {
            order(device, esc);
        }
    }

    fn each_cpu(&mut self, units: &UnitSet, mut order: impl FnMut(&mut CpuUnit)) {
        for at in units.positions(self.count()) {
            if self.cpu_has_power(at) {
                self.cpus.get_mut(at).into_iter().for_each(&mut order);
            }
        }
    }

    /// Whether a CPU Unit has power, so that an order has an effect on it; otherwise the trace says so.
    pub(super) fn cpu_has_power(&mut self, at: usize) -> bool {
        let has_power = self.cpus.get(at).is_some_and(CpuUnit::has_power);
        if !has_power {
            self.note_without_effect(&format!("cpu {}", at + 1), "has no power");
        }
        has_power
    }

    fn note_without_effect(&mut self, who: &str, reason: &str) {
        self.notes.tell(self.now, who, &format!("{reason}: the order has no effect"));
        self.without_effect.push(format!("{who} {reason}"));
    }

    fn invert_sii_word(&mut self, at: usize, word: u16) {
        let first = usize::from(word) * 2;
        self.with_slave(at, |_, esc| {
            if let Some(bytes) = esc.sii_image_mut().get_mut(first..first + 2) {
                bytes.iter_mut().for_each(|byte| *byte = !*byte);
            }
        });
    }

    fn power_off(&mut self, at: usize) {
        self.network.power_off(at, self.now);
        self.notes.tell(self.now, &format!("unit {}", at + 1), "is switched off");
    }

    fn cycle_rack_power(&mut self, at: usize) {
        self.start(at, Start::PowerOn);
        let now = self.now;
        if let Some(cpu) = self.cpus.get_mut(at) {
            cpu.cycle_power(now);
        }
    }

    fn power_off_rack(&mut self, at: usize) {
        self.power_off(at);
        let now = self.now;
        if let Some(cpu) = self.cpus.get_mut(at) {
            cpu.power_off(now);
        }
        self.notes.tell(now, &format!("cpu {}", at + 1), "is switched off");
    }

    fn power_on_rack(&mut self, at: usize) {
        let has_power = self.cpus.get(at).is_some_and(CpuUnit::has_power);
        if has_power && !self.is_off(at) {
            return self.note_without_effect(&format!("cpu {}", at + 1), "has power");
        }
        self.cycle_rack_power(at);
    }

    fn start(&mut self, at: usize, start: Start) {
        self.network.restart(at, self.now, start);
        self.records[at].start();
    }
}

fn conduct(device: &mut Device<Box<dyn ModelUnit>>, esc: &mut Esc, order: &ConductOrder, now: Instant) {
    match order {
        ConductOrder::EveryTransition { time } => {
            device.conduct_mut().transition_times = TransitionTimes::every(*time);
        }
        ConductOrder::Transition { transition, time } => {
            device.conduct_mut().transition_times.set(transition, *time);
        }
        ConductOrder::SiiCommands { time } if time.is_zero() => esc.set_sii_timing(SiiTiming::Immediate),
        ConductOrder::SiiCommands { time } => esc.set_sii_timing(SiiTiming::Busy(*time)),
        ConductOrder::SiiBusy { time } => esc.keep_sii_busy(now, now + *time),
        ConductOrder::Sdos { time } => device.set_response_time(*time),
        ConductOrder::Refuse { state, al_status_code } => {
            device.conduct_mut().refusals.set(*state, Some(AlStatusCode(al_status_code.0)));
        }
        ConductOrder::IgnoreAcknowledges => device.conduct_mut().ignores_acknowledge = true,
        ConductOrder::Behave => device.behave(esc),
    }
}

const fn event_log(log: EventLog) -> unit_model::EventLog {
    match log {
        EventLog::System => unit_model::EventLog::System,
        EventLog::Access => unit_model::EventLog::Access,
    }
}

const fn operating_mode(mode: CpuMode) -> OperatingMode {
    match mode {
        CpuMode::Run => OperatingMode::Run,
        CpuMode::Program => OperatingMode::Program,
    }
}
