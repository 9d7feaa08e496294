//! The unit itself: objects, mapping and refresh behind the slave stack.

use device::{Exchange, ProcessDataAreas, Unit};
use objects::ObjectServer;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

use crate::allocation::{ImageLayout, IoAllocation};
use crate::data_sets::Direction;
use crate::dictionary::UnitObjects;
use crate::exchange::{self, ExchangePlan, StatusToMaster};
use crate::finding::Finding;
use crate::identification::Identification;
use crate::nx_bus::{self, CpuEnd, UnitEnd, UnitHeader};
use crate::pdo_settings::PdoSettings;
use crate::rules;
use crate::status::{NxUnitStatus, SlaveStatus};
use crate::timing::Timing;
use crate::unit_file::UnitFile;

/// How one unit is set up, on its case and by its support software.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitSettings {
    /// Serial number, object 1018:04.
    pub serial: u32,
    /// ID switch, 0x00 to 0xFF. 0x00: the ID is set by software.
    pub id_switch: u8,
    /// ID set by software, in force while the ID switch is at 0x00; 0: none.
    pub software_id: u16,
    /// Whether the unit takes the times that the manual gives.
    pub timing: Timing,
    /// I/O allocation of the CPU Unit.
    pub io_allocation: IoAllocation,
}

impl UnitSettings {
    /// The settings of a unit file; what it leaves out has the value of [`UnitSettings::default`].
    #[must_use]
    pub fn from_unit_file(file: &UnitFile) -> Self {
        Self {
            serial: file.serial.value,
            id_switch: file.id_switch.value,
            software_id: 0,
            timing: file.timing.value,
            io_allocation: file.io_allocation(),
        }
    }

    /// The Explicit Device ID at power-on: the ID switch, or the software ID while it is at 0x00; 0: none.
    #[must_use]
    pub fn explicit_device_id(&self) -> u16 {
        let id = Identification::at_power_on(self.id_switch, self.software_id);
        id.explicit_device_id().unwrap_or(0)
    }
}

impl Default for UnitSettings {
    /// The factory setting with the ID switch at 0x01, as in the manual's example (A-1-2).
    fn default() -> Self {
        Self {
            serial: 1,
            id_switch: 0x01,
            software_id: 0,
            timing: Timing::Exact,
            io_allocation: IoAllocation::factory(),
        }
    }
}

/// An NX-ECT101 in operation.
#[derive(Debug)]
pub struct NxEct101 {
    objects: UnitObjects,
    bus: UnitEnd,
    io: IoAllocation,
    /// What the setting rules found in the I/O allocation at power-on; anything keeps I/O refreshing from
    /// starting, EtherCAT goes on (manual, 8-3-4).
    io_findings: Vec<Finding>,
    /// The mapping as it was at the last PRE-OP to SAFE-OP.
    pdo: PdoSettings,
    /// What the setting rules found in it.
    pdo_findings: Vec<Finding>,
    m_to_c_layout: ImageLayout,
    c_to_m_layout: ImageLayout,
    plan: ExchangePlan,
    /// The data M to C as last received. What is not exchanged stays 0.
    m_to_c: Vec<u8>,
    period: Duration,
    status: SlaveStatus,
}

impl NxEct101 {
    /// Turns a unit on; the other value is the CPU Unit's end of its NX bus. All memory that the unit ever
    /// uses is allocated here.
    #[must_use]
    pub fn power_on(settings: &UnitSettings) -> (Self, CpuEnd) {
        let (bus, cpu_end) = nx_bus::connect(&settings.io_allocation);
        let period = settings.timing.slave_period(settings.io_allocation.total_bytes());
        let identification = Identification::at_power_on(settings.id_switch, settings.software_id);
        let m_to_c_layout = settings.io_allocation.layout(Direction::MToC);
        let mut io_findings = Vec::new();
        rules::check_at_power_on(&settings.io_allocation, &mut io_findings);
        let unit = Self {
            objects: UnitObjects::power_on(settings.serial, identification, period),
            bus,
            io: settings.io_allocation.clone(),
            io_findings,
            pdo: PdoSettings::factory(),
            pdo_findings: Vec::with_capacity(rules::MAX_FINDINGS),
            m_to_c: vec![0; m_to_c_layout.size_bytes()],
            m_to_c_layout,
            c_to_m_layout: settings.io_allocation.layout(Direction::CToM),
            plan: ExchangePlan::empty(),
            period,
            status: SlaveStatus::default(),
        };
        (unit, cpu_end)
    }

    /// EtherCAT Slave Status as the CPU Unit was last told.
    #[must_use]
    pub fn slave_status(&self) -> SlaveStatus {
        self.status
    }

    /// What the setting rules found: in the I/O allocation at power-on, then in the mapping when the master last
    /// asked for SAFE-OP.
    pub fn findings(&self) -> impl Iterator<Item = &Finding> {
        self.io_findings.iter().chain(&self.pdo_findings)
    }

    /// Whether the I/O allocation lets I/O be refreshed.
    fn io_is_refreshed(&self) -> bool {
        self.io_findings.is_empty()
    }

    /// Takes in outputs and tells the status to the CPU Unit.
    fn refresh_m_to_c(&mut self, outputs: Option<&[u8]>) {
        let io_data_active = self.io_is_refreshed();
        if let Some(outputs) = outputs.filter(|_| io_data_active) {
            exchange::copy(&self.plan.m_to_c, outputs, &mut self.m_to_c);
        }
        let header = UnitHeader { status: self.status, io_data_active, error: !io_data_active };
        self.bus.m_to_c.publish(header, &self.m_to_c);
    }

    /// Fills the inputs from the newest data of the CPU Unit.
    fn refresh_c_to_m(&mut self, inputs: &mut [u8]) {
        inputs.fill(0);
        if self.io_is_refreshed() {
            exchange::copy(&self.plan.c_to_m, self.bus.c_to_m.newest().bytes(), inputs);
        }
        let nx_unit = NxUnitStatus {
            c_to_m_valid: self.status.c_to_m_valid,
            m_to_c_valid: self.status.m_to_c_valid,
            ..NxUnitStatus::default()
        };
        let status = StatusToMaster { nx_unit, ..StatusToMaster::default() };
        exchange::put_status(&self.plan.status, status, inputs);
    }
}

impl Unit for NxEct101 {
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        Some(&mut self.objects)
    }

    fn process_data(&self) -> ProcessDataAreas {
        let length = |direction| {
            // Three or six PDOs of at most 1,275 bytes each.
            u16::try_from(self.objects.mapping.size_bytes(direction)).unwrap_or(u16::MAX)
        };
        ProcessDataAreas { outputs_bytes: length(Direction::MToC), inputs_bytes: length(Direction::CToM) }
    }

    fn check_mapping(&mut self, _now: Instant) -> Result<(), AlStatusCode> {
        self.pdo.follow(&self.objects.mapping);
        self.pdo_findings.clear();
        rules::check_at_safe_op(&self.io, &self.pdo, &self.io_findings, &mut self.pdo_findings);
        // All are recorded, the first tells the master. A mismatch has no AL status code: it stops nothing.
        if let Some(code) = self.pdo_findings.iter().find_map(Finding::al_status_code) {
            return Err(code);
        }
        self.plan.rebuild(&self.pdo, &self.m_to_c_layout, &self.c_to_m_layout);
        // What the new mapping does not exchange has its default value again.
        self.m_to_c.fill(0);
        Ok(())
    }

    fn entered(&mut self, _now: Instant, state: AlState) {
        self.objects.state = state;
    }

    fn refresh_period(&self) -> Duration {
        self.period
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        let cpu = self.bus.c_to_m.newest().header;
        self.objects.system_time_ns = cpu.system_time_ns;
        let process_data = matches!(exchange.state, AlState::SafeOp | AlState::Op);
        let refreshing = cpu.refreshing && self.io_is_refreshed();
        self.status = SlaveStatus {
            sdo_enabled: process_data || exchange.state == AlState::PreOp,
            m_to_c_valid: refreshing && exchange.outputs.is_some(),
            c_to_m_valid: refreshing && process_data,
            ..self.status
        };
        self.refresh_m_to_c(exchange.outputs);
        self.refresh_c_to_m(exchange.inputs);
    }

    fn explicit_device_id(&self) -> Option<u16> {
        self.objects.identification.explicit_device_id()
    }

    /// The ID at power-on, then what object 10E0 has set.
    fn station_alias(&self) -> Option<u16> {
        self.objects.identification.station_alias()
    }
}

#[cfg(test)]
mod tests;
