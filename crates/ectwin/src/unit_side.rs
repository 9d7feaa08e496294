//! The internal side of a unit: its state, its CPU Unit, its faults and logs.

use coe_kit::indicators::{Pattern, PortCondition};
use device::{Device, Network, Start};
use esc::Port;
use plant::{ErrorLog, Indicators};
use plc::{CpuUnit, CpuUnits, Io};
use time::Instant;
use unit_model::{
    CurrentError, EventCode, EventLevel, EventLog, LevelNotChangeable, ModelUnit, NotThere, SlaveView,
};
use wire::{AlState, AlStatus, AlStatusCode};

/// The internal state of a unit, and its CPU Unit.
#[derive(Debug)]
pub struct UnitSide<'a> {
    network: &'a mut Network<Box<dyn ModelUnit>>,
    cpu: &'a mut CpuUnit,
    position: usize,
    now: Instant,
}

impl<'a> UnitSide<'a> {
    /// # Panics
    /// If there is no such unit.
    pub(crate) fn of(
        network: &'a mut Network<Box<dyn ModelUnit>>,
        cpus: &'a mut CpuUnits,
        position: usize,
        now: Instant,
    ) -> Self {
        let count = network.len();
        match cpus.get_mut(position) {
            Some(cpu) if position < count => Self { network, cpu, position, now },
            _ => panic!("there is no unit at position {position}: the line has {count}"),
        }
    }

    fn device(&self) -> &Device<Box<dyn ModelUnit>> {
        match self.network.device(self.position) {
            Some(device) => device,
            None => unreachable!("`UnitSide::of` has found a unit at this position"),
        }
    }

    fn unit(&self) -> &dyn ModelUnit {
        &**self.device().unit()
    }

    fn unit_mut(&mut self) -> &mut dyn ModelUnit {
        match self.network.device_mut(self.position) {
            Some(device) => &mut **device.unit_mut(),
            None => unreachable!("`UnitSide::of` has found a unit at this position"),
        }
    }

    /// The model of the unit.
    #[cfg(feature = "control")]
    pub(crate) fn model(&self) -> &'static dyn unit_model::Model {
        self.unit().model()
    }

    /// Whether the unit is switched on.
    #[cfg(feature = "control")]
    pub(crate) fn has_power(&self) -> bool {
        !self.device().is_off()
    }

    /// A register of one byte, read without the side effects of an access.
    #[cfg(feature = "control")]
    pub(crate) fn register(&self, offset: u16) -> u8 {
        let mut byte = [0];
        self.network.esc(self.position).into_iter().for_each(|esc| esc.look(offset, &mut byte, self.now));
        let [byte] = byte;
        byte
    }

    /// State of the EtherCAT state machine.
    #[must_use]
    pub fn state(&self) -> AlState {
        self.device().al_status().state
    }

    /// State and error indication, as the master reads them.
    #[must_use]
    pub fn al_status(&self) -> AlStatus {
        self.device().al_status()
    }

    /// AL status code, as the master reads it.
    #[must_use]
    pub fn al_status_code(&self) -> AlStatusCode {
        self.device().al_status_code()
    }

    /// The data from the master in the CPU Unit, entry after entry of the I/O allocation.
    #[must_use]
    pub fn outputs(&self) -> &[u8] {
        self.cpu.io().m_to_c()
    }

    /// Sets the data to the master, entry after entry; they are sent in the next task period, unless the user
    /// program writes them too. Excess bytes of `bytes` are ignored.
    pub fn set_inputs(&mut self, bytes: &[u8]) {
        for (input, byte) in self.cpu.io_mut().c_to_m_mut().iter_mut().zip(bytes) {
            *input = *byte;
        }
    }

    /// The unit as one of this model, such as `digital::Terminal`; none if it is another one.
    #[must_use]
    pub fn as_model<M: ModelUnit>(&self) -> Option<&M> {
        self.unit().as_model()
    }

    /// The I/O by data set, as the user program sees it.
    #[must_use]
    pub fn io(&self) -> &Io {
        self.cpu.io()
    }

    /// The I/O by data set, for changes.
    pub fn io_mut(&mut self) -> &mut Io {
        self.cpu.io_mut()
    }

    /// The CPU Unit, for example to change its operating mode.
    pub fn cpu(&mut self) -> &mut CpuUnit {
        self.cpu
    }
}

/// Events and faults.
impl UnitSide<'_> {
    /// The cause of a fault appears. Some faults are detected immediately, others when the unit starts or when
    /// the master requests a state (manual, 8-3-4, detection timing).
    ///
    /// # Panics
    /// If the model has no fault of this name.
    pub fn inject(&mut self, fault: impl AsRef<str>) {
        self.expect_fault(fault.as_ref(), |unit, fault| unit.inject(fault));
    }

    /// The cause of a fault disappears. Its effect remains until the recovery in the manual.
    ///
    /// # Panics
    /// If the model has no fault of this name.
    pub fn remove(&mut self, fault: impl AsRef<str>) {
        self.expect_fault(fault.as_ref(), |unit, fault| unit.remove(fault));
    }

    fn expect_fault(&mut self, fault: &str, act: impl Fn(&mut dyn ModelUnit, &str) -> Result<(), NotThere>) {
        let unit = self.unit_mut();
        if act(unit, fault).is_err() {
            let model = unit.model();
            panic!("{} has no fault {fault}; it has {}", model.name(), model.faults().join(", "));
        }
    }

    /// The current errors of a level, the oldest first: objects 2003 and 2004.
    #[must_use]
    pub fn current_errors(&self, level: EventLevel) -> &[CurrentError] {
        self.unit().current_errors(level)
    }

    /// Sysmac Error Status, object 2002:01: bit 4 observation, bit 5 minor fault.
    #[must_use]
    pub fn error_status(&self) -> u8 {
        self.unit().error_status()
    }

    /// Number of emergency messages lost since power-on: there was no room, or no mailbox.
    #[must_use]
    pub fn emergencies_lost(&self) -> u64 {
        self.device().emergencies_lost()
    }

    /// The system event log, which is the diagnosis history 10F3, and the access event log.
    #[must_use]
    pub fn error_log(&self) -> &ErrorLog {
        plant::error_log(self.unit())
    }

    /// Changes the level of an event, effective from the next start of the unit (manual, 6-5-1).
    ///
    /// # Errors
    /// [`LevelNotChangeable`]: the manual permits changes of 39160000 and 39170000, to minor fault and observation.
    pub fn set_event_level(&mut self, code: EventCode, level: EventLevel) -> Result<(), LevelNotChangeable> {
        self.unit_mut().set_event_level(code, level)
    }

    /// A user resets the errors from the CPU Unit (manual, 8-6). An error whose cause persists occurs again.
    pub fn reset_errors(&mut self) {
        self.unit_mut().reset_errors();
    }

    /// A user clears a log from the CPU Unit: Event Log Cleared (90400000).
    pub fn clear_event_log(&mut self, log: EventLog) {
        self.unit_mut().clear_event_log(log);
    }
}

/// Indicators.
impl UnitSide<'_> {
    /// The present pattern of each indicator (manual, 3-2). [`Indicators::lights`] shows which of them are lit
    /// at a point in time.
    #[must_use]
    pub fn indicators(&self) -> Indicators {
        plant::indicators(self.unit(), &self.slave_view())
    }

    /// What an indicator does now, by the name that the model gives it; none if the model has no such indicator.
    #[must_use]
    pub fn indicator(&self, name: &str) -> Option<Pattern> {
        self.unit().indicator(name, &self.slave_view())
    }

    /// What an indicator shows: no light without power.
    #[cfg(feature = "control")]
    pub(crate) fn pattern(&self, name: &str) -> Pattern {
        if self.device().is_off() { Pattern::NotLit } else { self.indicator(name).unwrap_or_default() }
    }

    fn slave_view(&self) -> SlaveView {
        let [in_port, out_port] = [Port::In, Port::Out].map(|port| self.port(port));
        SlaveView { al_status: self.al_status(), al_status_code: self.al_status_code(), in_port, out_port }
    }

    pub(crate) fn port(&self, port: Port) -> PortCondition {
        plant::port_condition(self.network, self.position, port, self.now)
    }
}

/// Actions on the unit by hand.
impl UnitSide<'_> {
    /// Restarts the unit, like support software: NX Unit Restart (94B80000).
    pub fn restart(&mut self) {
        self.network.restart(self.position, self.now, Start::Restart);
    }

    /// Switches the unit off and on again. The contents of its non-volatile memory are kept.
    pub fn cycle_power(&mut self) {
        self.network.restart(self.position, self.now, Start::PowerOn);
    }

    /// Switches the power of the CPU Rack off and on again: that of the unit and of its CPU Unit.
    pub fn cycle_rack_power(&mut self) {
        self.cycle_power();
        self.cpu.cycle_power(self.now);
    }

    /// Turns the ID switch. The unit reads it when it starts (manual, 3-3).
    ///
    /// # Panics
    /// If the model has no ID switch.
    pub fn set_id_switch(&mut self, id_switch: u8) {
        let unit = self.unit_mut();
        assert!(unit.set_switch("ID", id_switch.into()).is_ok(), "{} has no ID switch", unit.model().name());
    }
}
