//! The state of one unit in the scripted master, and the settings that it is going to write, correct or not.

use std::sync::Arc;

use ::master::{FmmuSettings, ProcessDataArea, SlaveSettings, StartUpSdo, SyncManagerSettings, registers};
use coe_kit::pdo::{PdoEntry, PdoSettings, assignment_object};
use esi::{KnownDevice, Transition};
use wire::{EntryAddress, ObjectIndex, SubIndex};

use super::operation::{MailboxChannels, Operation};
use super::process_data::ProcessData;
use crate::model::{Entry, Hex, MasterOrder};

/// One unit as its master sees it.
#[derive(Debug)]
pub(crate) struct Slave {
    unit: usize,
    device: Arc<KnownDevice>,
    /// The settings in its description.
    settings: SlaveSettings,
    /// The PDO settings in its description, with the orders of the scenario.
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
    /// The unit at this position of the line, according to its description.
    pub(crate) fn new(unit: usize, device: Arc<KnownDevice>) -> Self {
        Self {
            unit,
            settings: SlaveSettings::from_description(&device.description),
            pdo: PdoSettings::of_description(&device.description),
            device,
            startup: Vec::new(),
            wrong_lengths: Vec::new(),
            wrong_controls: Vec::new(),
            is_reset: false,
            received: 0,
        }
    }

    pub(crate) fn device(&self) -> Arc<KnownDevice> {
        Arc::clone(&self.device)
    }

    /// The SyncManagers of its mailbox, always correct; none without a mailbox.
    pub(crate) fn mailbox(&self) -> Option<MailboxChannels> {
        self.settings.mailbox.as_ref().map(|mailbox| (mailbox.out, mailbox.inward))
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
        map(&mut self.pdo, &self.device, pdo, entries);
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
    fn size_bytes(&self, sync_manager: u8) -> u16 {
        let size_bytes = self.pdo.size_bytes(assignment_object(sync_manager), |_| true);
        u16::try_from(size_bytes).unwrap_or(u16::MAX)
    }

    /// The SyncManagers of the mailbox.
    pub(crate) fn set_mailboxes(&self) -> Vec<Operation> {
        let channels = self.mailbox().into_iter().flat_map(|(out, inward)| [out, inward]);
        channels.flat_map(|sm| self.set(sm)).collect()
    }

    /// The SyncManagers with process data and their FMMUs.
    pub(crate) fn set_process_data(&mut self, process_data: &mut ProcessData) -> Vec<Operation> {
        for at in 0..self.settings.process_data.len() {
            let number = self.settings.process_data[at].sync_manager.number;
            self.settings.set_bits(number, 8 * u32::from(self.size_bytes(number)));
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

    /// The SDOs of PRE-OP: the orders of the scenario, then the commands of the description.
    pub(crate) fn pre_op_sdos(&self) -> Vec<Operation> {
        let ordered = self.startup.iter().flat_map(|startup| self.startup_sdo(startup));
        ordered.chain(self.described_sdos(&[Transition::Ip, Transition::Ps])).collect()
    }

    /// The SDOs on the way to OP.
    pub(crate) fn safe_op_sdos(&self) -> Vec<Operation> {
        self.described_sdos(&[Transition::So]).collect()
    }

    /// Commands of the description. A command that writes the default of its object is skipped, so that the value that a
    /// scenario has written there is kept.
    fn described_sdos<'a>(&'a self, transitions: &'a [Transition]) -> impl Iterator<Item = Operation> + 'a {
        let commands = self.settings.start_up.iter();
        let wanted = commands.filter(|sdo| transitions.contains(&sdo.transition) && !self.is_default(sdo));
        wanted.filter_map(|sdo| {
            let entry = Entry { index: sdo.target.index.0, sub: sdo.target.sub.0 };
            self.download(entry, &sdo.data)
        })
    }

    fn is_default(&self, sdo: &StartUpSdo) -> bool {
        let entry = self.device.objects.entry(sdo.target.index, sdo.target.sub);
        entry.is_some_and(|entry| entry.default == sdo.data)
    }

    /// None without a mailbox.
    fn download(&self, entry: Entry, value: &[u8]) -> Option<Operation> {
        Some(Operation::download(self.unit, self.mailbox()?, entry, value).within_an_order())
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
        let elements = (1..=u8::MAX).zip(&elements).map(|(sub, element)| download(sub, element));
        let operations = core::iter::once(download(0, &[0])).chain(elements).chain([download(0, &[count])]);
        operations.flatten().collect()
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
pub(crate) fn changed_settings(settings: &mut PdoSettings, device: &KnownDevice, order: &MasterOrder) {
    if let MasterOrder::MapPdo { pdo, entries, .. } = order {
        map(settings, device, pdo.0, entries);
    } else if let MasterOrder::AssignPdos { object, pdos, .. } = order {
        assign(settings, object.0, pdos);
    }
}

fn map(settings: &mut PdoSettings, device: &KnownDevice, pdo: u16, entries: &[Entry]) {
    let address = |entry: &Entry| EntryAddress { index: ObjectIndex(entry.index), sub: SubIndex(entry.sub) };
    let entry = |entry: &Entry| PdoEntry::of_table(&device.objects, address(entry));
    settings.map(ObjectIndex(pdo), entries.iter().map(entry));
}

fn assign(settings: &mut PdoSettings, index: u16, pdos: &[Hex<u16>]) {
    settings.assign(ObjectIndex(index), pdos.iter().map(|pdo| ObjectIndex(pdo.0)));
}
