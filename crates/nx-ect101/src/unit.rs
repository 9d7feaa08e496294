//! The unit itself: objects, mapping and refresh for the slave stack.

mod checks;
mod diagnosis;
mod kept_memory;
mod memory;
mod nx_bus_side;
mod reported;
mod task_watch;

use coe_kit::pdo::PdoSettings;
use device::{Action, Check, Exchange, RefreshCause, SmIndex, Start, Unit};
use nx_bus::{CpuEnd, CpuHeader, SlaveStatus, UnitEnd};
use objects::ObjectServer;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

use crate::allocation::ImageLayout;
use crate::data_sets::Direction;
use crate::diagnosis::Diagnosis;
use crate::dictionary::UnitObjects;
use crate::events::Event;
use crate::exchange::{ExchangePlan, StatusToMaster};
use crate::fault::Fault;
use crate::finding::Finding;
use crate::indicators::Indicator;
use crate::memory::MemoryAtPowerOn;
use crate::nx_objects::nx_objects;
use crate::outage::Outages;
use crate::pdo_settings;
use crate::rules;
use crate::settings::UnitSettings;
use crate::status::NxUnitStatus;
use crate::timing::slave_period;

use kept_memory::KeptMemory;
use reported::Reported;
use task_watch::TaskWatch;

/// An NX-ECT101 in operation.
#[derive(Debug)]
pub struct NxEct101 {
    /// The present settings; the ID switch is read when the unit starts.
    settings: UnitSettings,
    memory: KeptMemory,
    objects: UnitObjects,
    bus: UnitEnd,
    /// The findings of the setting rules in the I/O allocation at power-on; any finding prevents the start of
    /// I/O refreshing, EtherCAT continues (manual, 8-3-4).
    io_findings: Vec<Finding>,
    /// The mapping at the last transition from PRE-OP to SAFE-OP.
    pdo: PdoSettings,
    /// The findings of the setting rules in it.
    pdo_findings: Vec<Finding>,
    m_to_c_layout: ImageLayout,
    c_to_m_layout: ImageLayout,
    plan: ExchangePlan,
    /// The data M to C as last received. Bytes that are not exchanged are 0.
    m_to_c: Vec<u8>,
    /// The data C to M as received in the last period.
    c_to_m: Vec<u8>,
    period: Duration,
    status: SlaveStatus,
    nx_unit_status: NxUnitStatus,
    /// The unit has not reported the findings of its start yet.
    is_starting: bool,
    /// Its processor is running, and it initializes the rest.
    is_initializing: bool,
    task_watch: TaskWatch,
    /// The CPU Unit has done I/O refreshing since the unit started.
    is_initialized: bool,
    /// It has stopped, or has not begun in time: a present cause of NX Unit I/O Communications Error.
    io_communications_lost: bool,
    /// The NX Bus Function Module has stopped I/O refreshing because of an error.
    io_stopped: bool,
    /// Number of error resets of the NX Bus Function Module that the unit has completed.
    error_resets: u32,
    reported: Reported,
    outages: Outages,
}

impl NxEct101 {
    /// Powers a unit on for the first time; the second value is the CPU Unit's end of its NX bus.
    #[must_use]
    pub fn power_on(settings: &UnitSettings) -> (Self, CpuEnd) {
        Self::power_on_with(settings, MemoryAtPowerOn::Factory)
    }

    /// Powers a unit on with this non-volatile memory. The slave stack around it gets its EEPROM from
    /// [`NxEct101::memory`]. All the memory that the unit ever uses is allocated here.
    #[must_use]
    pub fn power_on_with(settings: &UnitSettings, memory: MemoryAtPowerOn) -> (Self, CpuEnd) {
        read_tables();
        let is_damaged = memory == MemoryAtPowerOn::Damaged;
        let (memory, identification) = KeptMemory::power_on(settings, memory);
        let mut diagnosis = Diagnosis::new(memory.contents().error_log().clone());
        if is_damaged {
            diagnosis.see_before_start(Fault::NonVolatileMemory);
        }
        diagnosis.start(settings.event_levels, settings.newest_acknowledged);
        let period = slave_period(settings.timing, settings.io_allocation.total_bytes());
        let m_to_c_layout = settings.io_allocation.layout(Direction::MToC);
        let c_to_m_layout = settings.io_allocation.layout(Direction::CToM);
        let (bus, cpu_end) = nx_bus::connect(m_to_c_layout.size_bytes(), c_to_m_layout.size_bytes());
        let mut io_findings = Vec::new();
        rules::check_at_power_on(&settings.io_allocation, &mut io_findings);
        let serial = memory.contents().serial();
        let mut objects = UnitObjects::start(serial, identification, period, diagnosis);
        objects.show(&settings.information);
        let unit = Self {
            objects,
            memory,
            bus,
            io_findings,
            pdo: pdo_settings::factory(),
            pdo_findings: Vec::with_capacity(rules::MAX_FINDINGS),
            m_to_c: vec![0; m_to_c_layout.size_bytes()],
            m_to_c_layout,
            c_to_m: vec![0; c_to_m_layout.size_bytes()],
            c_to_m_layout,
            plan: ExchangePlan::empty(),
            period,
            status: SlaveStatus::default(),
            nx_unit_status: NxUnitStatus::default(),
            is_starting: true,
            is_initializing: false,
            task_watch: TaskWatch::default(),
            is_initialized: false,
            io_communications_lost: false,
            io_stopped: false,
            error_resets: 0,
            reported: Reported::default(),
            outages: Outages::default(),
            settings: settings.clone(),
        };
        (unit, cpu_end)
    }

    /// EtherCAT Slave Status, NX object 6003:01. The device variables of the CPU Unit follow it while I/O is refreshed.
    #[must_use]
    pub fn slave_status(&self) -> SlaveStatus {
        self.status
    }

    /// NX Unit Status as last sent to the master.
    #[must_use]
    pub fn nx_unit_status(&self) -> NxUnitStatus {
        self.nx_unit_status
    }

    /// The findings of the setting rules: in the I/O allocation at power-on, then in the mapping at the
    /// master's last request for SAFE-OP.
    pub fn findings(&self) -> impl Iterator<Item = &Finding> {
        self.io_findings.iter().chain(&self.pdo_findings)
    }

    /// Turns the ID switch. The unit reads it at its next start (manual, 3-3).
    pub const fn set_id_switch(&mut self, id_switch: u8) {
        self.settings.id_switch = id_switch;
    }

    /// Whether the I/O allocation, the state of the unit and the NX bus permit I/O refreshing.
    fn io_is_refreshed(&self) -> bool {
        let is_stopped = self.objects.diagnosis.stops_io() || self.io_stopped || self.outages.is_any();
        self.io_findings.is_empty() && !is_stopped
    }

    /// Calculates the status words of both sides (manual, 6-3-2 and 7-5-5).
    fn update_status(&mut self, exchange: &Exchange<'_>, cpu: CpuHeader, io_is_refreshed: bool) {
        let process_data = matches!(exchange.state, AlState::SafeOp | AlState::Op);
        let refreshing = self.is_refreshed_by_cpu() && io_is_refreshed;
        let messages = &self.objects.messages;
        self.status = SlaveStatus {
            sdo_enabled: process_data || exchange.state == AlState::PreOp,
            m_to_c_valid: refreshing && exchange.outputs.is_some(),
            c_to_m_valid: refreshing && process_data,
            in_port_link: exchange.links.in_port,
            out_port_link: exchange.links.out_port,
            new_message: messages.m_to_c.has_new(),
            ready_to_write_message: messages.c_to_m.is_ready(),
        };
        self.nx_unit_status = NxUnitStatus {
            nx_messages_enabled: cpu.messages_enabled,
            c_to_m_valid: self.status.c_to_m_valid,
            m_to_c_valid: self.status.m_to_c_valid,
            new_message: messages.c_to_m.has_new(),
            ready_to_write_message: messages.m_to_c.is_ready(),
        };
    }

    /// Receives outputs and reports the status to the CPU Unit.
    fn refresh_m_to_c(&mut self, outputs: Option<&[u8]>, io_is_refreshed: bool) {
        if io_is_refreshed {
            if let Some(outputs) = outputs {
                self.plan.copies(Direction::MToC).apply(outputs, &mut self.m_to_c);
            }
            self.objects.give_unmapped_entries(&mut self.m_to_c);
        }
        self.bus.m_to_c.publish(self.header(), &self.m_to_c);
    }

    /// Fills the inputs with the data of the CPU Unit that were received one period before: the unit processes
    /// them for one T_slave. That is the third T_slave of the I/O response time (manual, 7-9-1); the other two
    /// are the waits for a refresh.
    fn refresh_c_to_m(&mut self, cause: RefreshCause, inputs: &mut [u8], io_is_refreshed: bool) {
        inputs.fill(0);
        let image = io_is_refreshed.then_some(self.c_to_m.as_slice());
        if let Some(image) = image {
            self.plan.copies(Direction::CToM).apply(image, inputs);
        }
        self.objects.take_unmapped_entries(image);
        if cause == RefreshCause::Period {
            self.c_to_m.copy_from_slice(self.bus.c_to_m.newest().bytes());
        }
        let status = StatusToMaster {
            nx_unit: self.nx_unit_status,
            new_messages: self.objects.diagnosis.has_new_messages(),
            sysmac_error: self.objects.diagnosis.error_status(),
        };
        self.plan.put_status(status, inputs);
    }
}

/// Reads the text tables that are otherwise read at first use: now, and not at the first event.
fn read_tables() {
    let _ = (Event::all(), Indicator::all(), nx_objects());
}

impl Unit for NxEct101 {
    /// A master can reset the errors by them.
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        self.look_for_io_communications();
        Some(&mut self.objects)
    }

    fn mapped_bytes(&self, sync_manager: SmIndex) -> u16 {
        let direction = if sync_manager == SmIndex::OUTPUTS { Direction::MToC } else { Direction::CToM };
        // Three or six PDOs of at most 1,275 bytes each.
        u16::try_from(self.objects.mapping.size_bytes(direction.assignment())).unwrap_or(u16::MAX)
    }

    fn check_transition(
        &mut self,
        _now: Instant,
        check: Check,
        found: &[AlStatusCode],
    ) -> Result<(), AlStatusCode> {
        match check {
            Check::Mailbox => self.check_mailbox(found),
            Check::ProcessData => self.check_process_data(found),
            Check::Nothing | Check::Bootstrap | Check::Outputs => Ok(()),
        }
    }

    fn al_error(&mut self, _now: Instant, code: AlStatusCode) -> AlStatusCode {
        self.raise_al_error(code)
    }

    fn restart(&mut self, _now: Instant, start: Start, sii_image: &mut [u8]) -> Option<AlStatusCode> {
        let identification = self.memory.restart(&self.settings, self.objects.identification, sii_image);
        self.objects.restart(self.memory.contents().serial(), identification);
        self.objects.show(&self.settings.information);
        self.pdo_findings.clear();
        self.m_to_c.fill(0);
        self.c_to_m.fill(0);
        self.is_initializing = false;
        self.reported = Reported::default();
        let code = self.restart_diagnosis(start);
        self.leave_nx_bus(false);
        code
    }

    fn initializing(&mut self, _now: Instant) {
        self.is_initializing = true;
    }

    /// The CPU Unit has lost the unit: its I/O data is not active, and that is an error.
    fn power_off(&mut self, _now: Instant) {
        self.leave_nx_bus(true);
    }

    /// A fault that keeps the slave in INIT has priority. The alias is the ID at power-on, then the value set
    /// by object 10E0.
    fn take_action(&mut self) -> Option<Action> {
        let stop_in_init = self.stop_in_init();
        let objects = &mut self.objects;
        self.reported
            .fault(stop_in_init)
            .or_else(|| self.reported.station_alias(objects.identification.station_alias()))
            .or_else(|| objects.take_status_change().then_some(Action::Refresh))
            .or_else(|| objects.diagnosis.take_emergency().map(Action::Emergency))
    }

    fn emergencies_lost(&self) -> u64 {
        self.objects.diagnosis.emergencies_lost()
    }

    fn entered(&mut self, _now: Instant, state: AlState) {
        self.objects.state = state;
        if !matches!(state, AlState::SafeOp | AlState::Op) {
            self.settle_mismatches();
        }
    }

    fn refresh_period(&self) -> Option<Duration> {
        Some(self.period)
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        let cpu = self.bus.c_to_m.newest().header;
        self.objects.diagnosis.set_time(cpu.system_time_ns);
        self.tell_start();
        self.watch_io_communications(exchange.cause, cpu);
        self.follow_nx_bus(cpu);
        self.answer_messages();
        let io_is_refreshed = self.io_is_refreshed();
        self.update_status(&exchange, cpu, io_is_refreshed);
        self.refresh_m_to_c(exchange.outputs, io_is_refreshed);
        self.refresh_c_to_m(exchange.cause, exchange.inputs, io_is_refreshed);
        // Only now, so that no flag is older than a response that the CPU Unit has received.
        self.bus.messages.send();
    }

    fn explicit_device_id(&self) -> Option<u16> {
        self.objects.identification.explicit_device_id()
    }
}

#[cfg(test)]
mod tests;
