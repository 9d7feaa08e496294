//! The state of one unit in the scripted master, and the settings that it is going to write, correct or not.

use ::master::{FmmuSettings, ProcessDataArea, SlaveSettings, SyncManagerSettings, registers};
use coe_kit::pdo::{PdoEntry, PdoSettings};
use nx_ect101::unit_file::EntryAddress;
use nx_ect101::{Direction, ObjectIndex, SubIndex, UnitSettings, pdo_settings};

use super::operation::{MailboxChannels, Operation};
use super::process_data::ProcessData;
use crate::model::{Entry, Hex, MasterOrder};

/// One unit as its master sees it.
#[derive(Debug)]
pub(crate) struct Slave {
    unit: usize,
    /// The settings in its description.
    settings: SlaveSettings,
    /// The factory setting of the unit, with the orders of the scenario.
    pdo: PdoSettings,
    /// The writes for PRE-OP, in the order in which they were ordered.
    startup: Vec<Startup>,
    wrong_lengths: Vec<(u8, u16)>,
    wrong_controls: Vec<(u8, u8)>,
    /// It has been taken to INIT since the master started.
    is_reset: bool,
    /// The counter of the last message received from its mailbox.
    received: u8,
}

#[derive(Debug)]
enum Startup {
    Mapping(u16),
    Assignment(u16),
}

impl Slave {
    /// The units of a line, according to their description.
    pub(crate) fn line(units: usize) -> Vec<Self> {
        let settings = SlaveSettings::from_description(&nx_ect101::description(&UnitSettings::default()));
        (0..units).map(|unit| Self::new(unit, settings.clone())).collect()
    }

    fn new(unit: usize, settings: SlaveSettings) -> Self {
        Self {
            unit,
            settings,
            pdo: pdo_settings::factory(),
            startup: Vec::new(),
            wrong_lengths: Vec::new(),
            wrong_controls: Vec::new(),
            is_reset: false,
            received: 0,
        }
    }

    /// The SyncManagers of its mailbox, always correct.
    pub(crate) fn mailbox(&self) -> MailboxChannels {
        let channels = self.settings.mailbox.as_ref().map(|mailbox| (mailbox.out, mailbox.inward));
        channels.unwrap_or_default()
    }

    pub(crate) const fn received(&self) -> u8 {
        self.received
    }

    pub(crate) const fn keep_received(&mut self, counter: u8) {
        self.received = counter;
    }

    /// The settings that the master has written, or will write at the next transition to PRE-OP.
    pub(crate) const fn settings(&self) -> &PdoSettings {
        &self.pdo
    }

    /// Whether the master has not yet taken it to INIT, as it does with every unit that it finds; true once.
    pub(crate) const fn take_reset(&mut self) -> bool {
        !core::mem::replace(&mut self.is_reset, true)
    }

    pub(crate) fn map(&mut self, pdo: u16, entries: &[Entry]) {
        map(&mut self.pdo, pdo, entries);
        self.startup.push(Startup::Mapping(pdo));
    }

    pub(crate) fn assign(&mut self, index: u16, pdos: &[Hex<u16>]) {
        assign(&mut self.pdo, index, pdos);
        self.startup.push(Startup::Assignment(index));
    }

    pub(crate) fn wrong_length(&mut self, number: u8, length_bytes: u16) {
        self.wrong_lengths.push((number, length_bytes));
    }

    pub(crate) fn wrong_control(&mut self, number: u8, control: u8) {
        self.wrong_controls.push((number, control));
    }

    /// Makes all settings correct from the next time on; the PDO settings are kept.
    pub(crate) fn behave(&mut self) {
        self.wrong_lengths.clear();
        self.wrong_controls.clear();
    }

    /// As the unit counts: everything that is assigned, even if it does not belong there.
    fn size_bytes(&self, direction: Direction) -> u16 {
        let size_bytes = self.pdo.size_bytes(direction.assignment(), |_| true);
        u16::try_from(size_bytes).unwrap_or(u16::MAX)
    }

    /// SyncManagers 0 and 1.
    pub(crate) fn set_mailboxes(&self) -> Vec<Operation> {
        let (out, inward) = self.mailbox();
        [out, inward].into_iter().flat_map(|sm| self.set(sm)).collect()
    }

    /// SyncManagers 2 and 3 and the FMMUs of both.
    pub(crate) fn set_process_data(&mut self, process_data: &mut ProcessData) -> Vec<Operation> {
        for direction in Direction::ALL {
            let bits = 8 * u32::from(self.size_bytes(direction));
            self.settings.set_bits(sync_manager(direction), bits);
        }
        let placed = process_data.place(self.unit, &self.settings);
        let areas = &self.settings.process_data;
        let mut operations: Vec<_> = areas.iter().flat_map(|area| self.set(area.sync_manager)).collect();
        let mut behind = placed.first().map_or(0, |fmmu| fmmu.logical_start);
        for area in areas {
            let fmmu = placed.iter().find(|fmmu| fmmu.number == area.fmmu).copied();
            let fmmu = fmmu.unwrap_or_else(|| unused_fmmu(area, behind));
            behind = fmmu.logical_start + u32::from(fmmu.length_bytes);
            operations.push(self.set_fmmu(&fmmu));
        }
        operations
    }

    /// The SDOs of PRE-OP: the orders of the scenario, then the reset of errors that the ESI requires.
    pub(crate) fn startup_sdos(&self) -> Vec<Operation> {
        let mut operations: Vec<_> =
            self.startup.iter().flat_map(|startup| self.startup_sdo(startup)).collect();
        operations.push(self.download(Entry { index: 0x2002, sub: 2 }, &[1]));
        operations
    }

    fn download(&self, entry: Entry, value: &[u8]) -> Operation {
        Operation::download(self.unit, self.mailbox(), entry, value).within_an_order()
    }

    fn startup_sdo(&self, startup: &Startup) -> Vec<Operation> {
        match startup {
            Startup::Mapping(pdo) => {
                let elements =
                    self.pdo.entries(ObjectIndex(*pdo)).iter().map(|entry| PdoEntry::element(*entry));
                self.write_list(*pdo, elements.map(|element| element.to_le_bytes().to_vec()).collect())
            }
            Startup::Assignment(index) => {
                let pdos = self.pdo.assignment(ObjectIndex(*index)).iter();
                self.write_list(*index, pdos.map(|pdo| pdo.0.to_le_bytes().to_vec()).collect())
            }
        }
    }

    /// Subindex 0 to 0, the elements, subindex 0 to their number.
    fn write_list(&self, index: u16, elements: Vec<Vec<u8>>) -> Vec<Operation> {
        let download = |sub, value: &[u8]| self.download(Entry { index, sub }, value);
        let count = elements.len() as u8;
        let mut operations = vec![download(0, &[0])];
        operations.extend((1..).zip(&elements).map(|(sub, element)| download(sub, element)));
        operations.push(download(0, &[count]));
        operations
    }

    fn set(&self, mut sm: SyncManagerSettings) -> [Operation; 2] {
        let wrong_length = self.wrong_lengths.iter().rev().find(|(number, _)| *number == sm.number);
        let wrong_control = self.wrong_controls.iter().rev().find(|(number, _)| *number == sm.number);
        sm.length_bytes = wrong_length.map_or(sm.length_bytes, |(_, length_bytes)| *length_bytes);
        sm.control = wrong_control.map_or(sm.control, |(_, control)| *control);
        sm.activate = u8::from(sm.length_bytes > 0);
        let offset = registers::sync_manager(sm.number);
        [
            Operation::write(self.unit, offset + registers::SYNC_MANAGER_ACTIVATE, vec![0]).within_an_order(),
            Operation::write(self.unit, offset, sm.pack().to_vec()).within_an_order(),
        ]
    }

    fn set_fmmu(&self, fmmu: &FmmuSettings) -> Operation {
        Operation::write(self.unit, registers::fmmu(fmmu.number), fmmu.pack().to_vec()).within_an_order()
    }
}

/// The SyncManager of a direction.
const fn sync_manager(direction: Direction) -> u8 {
    match direction {
        Direction::MToC => 2,
        Direction::CToM => 3,
    }
}

/// The FMMU of an area without process data: it is written nevertheless, and maps nothing.
fn unused_fmmu(area: &ProcessDataArea, logical_start: u32) -> FmmuSettings {
    FmmuSettings {
        number: area.fmmu,
        logical_start,
        logical_stop_bit: 7,
        physical_start: area.sync_manager.start,
        kind: area.direction.fmmu_kind(),
        ..FmmuSettings::default()
    }
}

/// The PDO settings after an order that maps or assigns.
pub(crate) fn changed_settings(settings: &mut PdoSettings, order: &MasterOrder) {
    if let MasterOrder::MapPdo { pdo, entries, .. } = order {
        map(settings, pdo.0, entries);
    } else if let MasterOrder::AssignPdos { object, pdos, .. } = order {
        assign(settings, object.0, pdos);
    }
}

fn map(settings: &mut PdoSettings, pdo: u16, entries: &[Entry]) {
    let address = |entry: &Entry| EntryAddress { index: ObjectIndex(entry.index), sub: SubIndex(entry.sub) };
    settings.map(ObjectIndex(pdo), entries.iter().map(address).map(pdo_settings::entry_at));
}

fn assign(settings: &mut PdoSettings, index: u16, pdos: &[Hex<u16>]) {
    settings.assign(ObjectIndex(index), pdos.iter().map(|pdo| ObjectIndex(pdo.0)));
}
