//! The unit between a master, a CPU Unit and a memory, through its public interfaces.

use device::{Action, Check, Exchange, PortLinks, RefreshCause, SmIndex, Start, Unit};
use nx_bus::{CpuEnd, CpuHeader};
use nx_ect101::{
    EventCode, EventLevel, MemoryAtPowerOn, NewestAcknowledged, NonVolatileMemory, NxEct101, UnitSettings,
};
use time::Instant;
use wire::{AlState, AlStatusCode};

use crate::sdo::Sdo;
use crate::settings::{IoSetting, PdoSetting};

const NOW: Instant = Instant::ZERO;

/// A unit with power, and its environment.
#[derive(Debug)]
pub(crate) struct Bench {
    pub(crate) unit: NxEct101,
    pub(crate) cpu: CpuEnd,
    sdo: Sdo,
    pub(crate) settings: UnitSettings,
    sii_image: Vec<u8>,
    pub(crate) state: AlState,
    pub(crate) inputs: Vec<u8>,
    /// The bytes of the memory as last stored.
    pub(crate) stored: Vec<u8>,
    /// The fault that the unit has reported.
    reported_fault: Option<AlStatusCode>,
}

impl Bench {
    /// The first power-on; the user has set these events to observation.
    pub(crate) fn power_on(
        io: &IoSetting,
        newest_acknowledged: NewestAcknowledged,
        observations: &[u32],
    ) -> Self {
        let io_allocation = io.allocation.clone();
        let mut settings = UnitSettings { io_allocation, newest_acknowledged, ..UnitSettings::default() };
        for &event in observations {
            let levels = &mut settings.event_levels;
            levels.set(EventCode(event), EventLevel::Observation).expect("a level that can be changed");
        }
        let (unit, cpu) = NxEct101::power_on(&settings);
        let sii_image = unit.memory().sii_image().to_vec();
        let mut bench = Self {
            unit,
            cpu,
            sdo: Sdo::new(),
            settings,
            sii_image,
            state: AlState::Init,
            inputs: Vec::new(),
            stored: Vec::new(),
            reported_fault: None,
        };
        bench.store();
        bench
    }

    /// A power cycle: the unit finds the bytes that were stored, or cannot read them.
    pub(crate) fn cycle_power(&mut self, damaged: bool) {
        let memory = match NonVolatileMemory::decode(&self.stored).expect("what a unit has stored") {
            _ if damaged => MemoryAtPowerOn::Damaged,
            memory => MemoryAtPowerOn::Stored(Box::new(memory)),
        };
        (self.unit, self.cpu) = NxEct101::power_on_with(&self.settings, memory);
        self.reported_fault = None;
        self.state = AlState::Init;
    }

    /// Stores the memory if the unit requests it.
    pub(crate) fn store(&mut self) {
        if self.unit.take_memory_change(&self.sii_image, 0) {
            self.unit.memory().encode_into(&mut self.stored);
        }
    }

    pub(crate) fn restart(&mut self, start: Start) -> Option<u16> {
        let code = self.unit.restart(NOW, start, &mut self.sii_image);
        self.reported_fault = None;
        self.enter(AlState::Init);
        code.map(|code| code.0)
    }

    pub(crate) fn fault(&self) -> Option<u16> {
        self.unit.stop_in_init().map(|code| code.0)
    }

    pub(crate) fn emergencies_lost(&self) -> u64 {
        self.unit.emergencies_lost()
    }

    pub(crate) fn enter(&mut self, state: AlState) {
        self.unit.entered(NOW, state);
        self.state = state;
    }

    pub(crate) fn al_error(&mut self, code: u16) -> u16 {
        self.unit.al_error(NOW, AlStatusCode(code)).0
    }

    pub(crate) fn check(&mut self, check: Check, found: &[u16]) -> Result<(), u16> {
        let found: Vec<AlStatusCode> = found.iter().copied().map(AlStatusCode).collect();
        self.unit.check_transition(NOW, check, &found).map_err(|code| code.0)
    }

    pub(crate) fn refresh(&mut self, time_ns: u64, refreshing: bool) {
        let header =
            CpuHeader { refreshing, messages_enabled: true, system_time_ns: time_ns, ..CpuHeader::default() };
        self.cpu.c_to_m.publish(header, &[]);
        let has_inputs = matches!(self.state, AlState::SafeOp | AlState::Op);
        let inputs_bytes = if has_inputs { self.unit.mapped_bytes(SmIndex::INPUTS) } else { 0 };
        self.inputs.clear();
        self.inputs.resize(usize::from(inputs_bytes), 0xEE);
        let (cause, links, inputs) = (RefreshCause::Period, PortLinks::default(), &mut self.inputs);
        self.unit.refresh(NOW, Exchange { cause, state: self.state, links, outputs: None, inputs });
    }

    /// The bytes of all waiting emergency messages, `most` at most.
    pub(crate) fn take_emergencies(&mut self, most: usize) -> Vec<[u8; 8]> {
        let mut emergencies = Vec::new();
        while emergencies.len() < most {
            match self.unit.take_action() {
                Some(Action::Emergency(emergency)) => emergencies.push(emergency.pack()),
                Some(Action::Fault(code)) => self.reported_fault = Some(code),
                Some(Action::FaultEnded) => self.reported_fault = None,
                Some(Action::StationAlias(_) | Action::Refresh) => {}
                None => {
                    assert_eq!(self.reported_fault, self.unit.stop_in_init(), "the stack knows the fault");
                    break;
                }
            }
        }
        emergencies
    }

    pub(crate) fn write(&mut self, index: u16, sub: u8, value: &[u8]) -> Result<(), u32> {
        self.sdo.download(self.unit.objects().expect("a unit with a mailbox"), index, sub, value)
    }

    pub(crate) fn read(&mut self, index: u16, sub: u8) -> Vec<u8> {
        let objects = self.unit.objects().expect("a unit with a mailbox");
        self.sdo.upload(objects, index, sub).expect("an entry that exists")
    }

    /// Writes mapping and assignment objects with the sequence of masters.
    pub(crate) fn map(&mut self, setting: &PdoSetting) {
        for (index, elements, width) in [
            (0x1C12, &setting.assigned_rx, 2),
            (0x1C13, &setting.assigned_tx, 2),
            (0x1601, &setting.rx, 4),
            (0x1A01, &setting.tx, 4),
        ] {
            self.write(index, 0, &[0]).expect("it can be cleared");
            for (sub, element) in (1..).zip(elements) {
                self.write(index, sub, &element.to_le_bytes()[..width]).expect("it can be set");
            }
            self.write(index, 0, &[elements.len() as u8]).expect("there is room");
        }
    }
}
