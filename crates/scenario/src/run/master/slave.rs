//! What the scripted master knows of one unit, and what it is going to set, right or wrong.

use nx_ect101::unit_file::EntryAddress;
use nx_ect101::{Assignment, Direction, ObjectIndex, PdoEntry, PdoSettings, SubIndex, layout};

use super::operation::Operation;
use crate::model::MasterOrder;

/// One unit as its master sees it.
#[derive(Debug)]
pub(crate) struct Slave {
    unit: usize,
    /// What the unit has by the factory setting, with the orders of the scenario.
    pdo: PdoSettings,
    /// What has to be written in PRE-OP, in the order in which it was told.
    startup: Vec<Startup>,
    wrong_lengths: Vec<(u8, u16)>,
    wrong_controls: Vec<(u8, u8)>,
    /// It was taken to INIT since the master has started.
    is_reset: bool,
}

#[derive(Debug)]
enum Startup {
    Mapping(u16),
    Assignment(Direction, u16),
}

/// A SyncManager as it is set.
struct SyncManager {
    number: u8,
    start: u16,
    length_bytes: u16,
    control: u8,
}

impl Slave {
    pub(crate) fn new(unit: usize) -> Self {
        Self {
            unit,
            pdo: PdoSettings::factory(),
            startup: Vec::new(),
            wrong_lengths: Vec::new(),
            wrong_controls: Vec::new(),
            is_reset: false,
        }
    }

    /// What the master has set, or sets the next time that PRE-OP is passed.
    pub(crate) const fn settings(&self) -> &PdoSettings {
        &self.pdo
    }

    /// Whether the master has yet to take it to INIT, as it does with every unit that it finds; the first time.
    pub(crate) const fn take_reset(&mut self) -> bool {
        !core::mem::replace(&mut self.is_reset, true)
    }

    pub(crate) fn map(&mut self, pdo: u16, entries: &[(u16, u8)]) {
        map(&mut self.pdo, pdo, entries);
        self.startup.push(Startup::Mapping(pdo));
    }

    pub(crate) fn assign(&mut self, index: u16, pdos: &[u16]) {
        if let Some(direction) = assign(&mut self.pdo, index, pdos) {
            self.startup.push(Startup::Assignment(direction, index));
        }
    }

    pub(crate) fn wrong_length(&mut self, number: u8, length_bytes: u16) {
        self.wrong_lengths.push((number, length_bytes));
    }

    pub(crate) fn wrong_control(&mut self, number: u8, control: u8) {
        self.wrong_controls.push((number, control));
    }

    /// Sets everything right from the next time on; the PDO settings stay.
    pub(crate) fn behave(&mut self) {
        self.wrong_lengths.clear();
        self.wrong_controls.clear();
    }

    pub(crate) fn outputs_bytes(&self) -> u16 {
        self.size_bytes(Direction::MToC)
    }

    pub(crate) fn inputs_bytes(&self) -> u16 {
        self.size_bytes(Direction::CToM)
    }

    /// As the unit counts: whatever is assigned, also what has no place there.
    fn size_bytes(&self, direction: Direction) -> u16 {
        let entries = self.pdo.assigned(direction).flat_map(|pdo| self.pdo.entries(pdo));
        let bits: usize = entries.map(|entry| usize::from(entry.bit_length)).sum();
        u16::try_from(bits.div_ceil(8)).unwrap_or(u16::MAX)
    }

    /// SyncManagers 0 and 1.
    pub(crate) fn set_mailboxes(&self) -> Vec<Operation> {
        let length_bytes = layout::MAILBOX_BYTES;
        let receive = SyncManager {
            number: 0,
            start: layout::MAILBOX_RECEIVE_START,
            length_bytes,
            control: layout::MAILBOX_RECEIVE_CONTROL,
        };
        let send = SyncManager {
            number: 1,
            start: layout::MAILBOX_SEND_START,
            length_bytes,
            control: layout::MAILBOX_SEND_CONTROL,
        };
        [receive, send].into_iter().flat_map(|sm| self.set(sm)).collect()
    }

    /// SyncManagers 2 and 3 and the FMMUs of both.
    pub(crate) fn set_process_data(&self, logical: u32) -> Vec<Operation> {
        let (outputs_bytes, inputs_bytes) = (self.outputs_bytes(), self.inputs_bytes());
        let outputs = SyncManager {
            number: 2,
            start: layout::OUTPUTS_START,
            length_bytes: outputs_bytes,
            control: layout::OUTPUTS_CONTROL,
        };
        let inputs = SyncManager {
            number: 3,
            start: layout::INPUTS_START,
            length_bytes: inputs_bytes,
            control: layout::INPUTS_CONTROL,
        };
        let mut operations: Vec<_> = [outputs, inputs].into_iter().flat_map(|sm| self.set(sm)).collect();
        let behind = logical + u32::from(outputs_bytes);
        operations.push(self.set_fmmu(0, logical, outputs_bytes, layout::OUTPUTS_START, 2));
        operations.push(self.set_fmmu(1, behind, inputs_bytes, layout::INPUTS_START, 1));
        operations
    }

    /// The SDOs of PRE-OP: what the scenario orders, then the reset of errors that the ESI asks for.
    pub(crate) fn startup_sdos(&self) -> Vec<Operation> {
        let mut operations: Vec<_> =
            self.startup.iter().flat_map(|startup| self.startup_sdo(startup)).collect();
        operations.push(Operation::download(self.unit, (0x2002, 2), &[1]).within_an_order());
        operations
    }

    fn startup_sdo(&self, startup: &Startup) -> Vec<Operation> {
        match startup {
            Startup::Mapping(pdo) => {
                let element = |entry: &PdoEntry| {
                    u32::from(entry.index.0) << 16
                        | u32::from(entry.sub.0) << 8
                        | u32::from(entry.bit_length & 0xFF)
                };
                let elements = self.pdo.entries(ObjectIndex(*pdo)).iter().map(element);
                self.write_list(*pdo, elements.map(|element| element.to_le_bytes().to_vec()).collect())
            }
            Startup::Assignment(direction, index) => {
                let pdos = self.pdo.assignment(*direction).iter();
                self.write_list(*index, pdos.map(|pdo| pdo.0.to_le_bytes().to_vec()).collect())
            }
        }
    }

    /// Subindex 0 to 0, the elements, subindex 0 to their number.
    fn write_list(&self, index: u16, elements: Vec<Vec<u8>>) -> Vec<Operation> {
        let download =
            |sub, value: &[u8]| Operation::download(self.unit, (index, sub), value).within_an_order();
        let count = elements.len() as u8;
        let mut operations = vec![download(0, &[0])];
        operations.extend((1..).zip(&elements).map(|(sub, element)| download(sub, element)));
        operations.push(download(0, &[count]));
        operations
    }

    fn set(&self, sm: SyncManager) -> [Operation; 2] {
        let wrong = |list: &[(u8, u16)]| {
            list.iter().rev().find(|(number, _)| *number == sm.number).map(|wrong| wrong.1)
        };
        let length_bytes = wrong(&self.wrong_lengths).unwrap_or(sm.length_bytes);
        let control = self.wrong_controls.iter().rev().find(|(number, _)| *number == sm.number);
        let control = control.map_or(sm.control, |wrong| wrong.1);
        let enable = u8::from(length_bytes > 0);
        let ([s0, s1], [l0, l1]) = (sm.start.to_le_bytes(), length_bytes.to_le_bytes());
        let offset = 0x0800 + 8 * u16::from(sm.number);
        [
            Operation::write(self.unit, offset + 6, vec![0]).within_an_order(),
            Operation::write(self.unit, offset, vec![s0, s1, l0, l1, control, 0, enable, 0])
                .within_an_order(),
        ]
    }

    fn set_fmmu(&self, number: u16, logical: u32, length_bytes: u16, start: u16, kind: u8) -> Operation {
        let mut fmmu = logical.to_le_bytes().to_vec();
        fmmu.extend(length_bytes.to_le_bytes());
        fmmu.extend([0, 7]);
        fmmu.extend(start.to_le_bytes());
        fmmu.extend([0, kind, u8::from(length_bytes > 0), 0, 0, 0]);
        Operation::write(self.unit, 0x0600 + 16 * number, fmmu).within_an_order()
    }
}

/// The PDO settings behind an order that maps or assigns.
pub(crate) fn changed_settings(settings: &mut PdoSettings, order: &MasterOrder) {
    match order {
        MasterOrder::Map(_, pdo, entries) => map(settings, *pdo, entries),
        MasterOrder::Assign(_, index, pdos) => drop(assign(settings, *index, pdos)),
        _ => {}
    }
}

fn map(settings: &mut PdoSettings, pdo: u16, entries: &[(u16, u8)]) {
    let address = |&(index, sub): &(u16, u8)| EntryAddress { index: ObjectIndex(index), sub: SubIndex(sub) };
    settings.map(ObjectIndex(pdo), entries.iter().map(address).map(PdoEntry::at));
}

/// The direction of the assignment object; none if it is none.
fn assign(settings: &mut PdoSettings, index: u16, pdos: &[u16]) -> Option<Direction> {
    let direction = Direction::ALL.into_iter().find(|&way| Assignment::of(way).object.0 == index)?;
    settings.assign(direction, pdos.iter().copied().map(ObjectIndex));
    Some(direction)
}
