//! The objects of one unit: which of them only store a value, and which do more.

mod io_entries;

use coe_kit::pdo::PdoObjects;
use objects::{Dictionary, ObjectServer, ObjectTable};
use time::Duration;
use wire::{AlState, ObjectIndex, SdoAbort, SubIndex};

use crate::allocation::ImageLayout;
use crate::diagnosis::{DIAGNOSIS_MESSAGE_BYTES, Diagnosis, current_error_bytes};
use crate::events::EventLevel;
use crate::identification::Identification;
use crate::memory::LogRecord;
use crate::messages::{Message, Messages};
use crate::tables::object_table;
use crate::unit_information::UnitInformation;

use io_entries::UnmappedEntries;

/// Sysmac Observation.
const OBSERVATIONS: u16 = 0x2003;
/// Sysmac Minor Fault.
const MINOR_FAULTS: u16 = 0x2004;

/// The object server of one unit.
#[derive(Debug)]
pub(crate) struct UnitObjects {
    values: Dictionary,
    pub(crate) mapping: PdoObjects,
    /// As of the last PRE-OP to SAFE-OP.
    unmapped: UnmappedEntries,
    pub(crate) identification: Identification,
    pub(crate) messages: Messages,
    pub(crate) diagnosis: Diagnosis,
    /// A status in the refresh has changed since [`UnitObjects::take_status_change`].
    status_changed: bool,
    pub(crate) state: AlState,
    /// Time between two refreshes.
    period: Duration,
}

impl UnitObjects {
    /// The objects when the unit starts.
    pub(crate) fn start(
        serial: u32,
        identification: Identification,
        period: Duration,
        diagnosis: Diagnosis,
    ) -> Self {
        let table = object_table();
        let mapping = PdoObjects::of_table(&table);
        let mut objects = Self {
            values: Dictionary::new(table),
            mapping,
            unmapped: UnmappedEntries::none(),
            identification,
            messages: Messages::default(),
            diagnosis,
            status_changed: false,
            state: AlState::Init,
            period,
        };
        objects.set_serial(serial);
        objects
    }

    /// The unit restarts: everything except the diagnosis has its defaults. Memory is reused, nothing is allocated.
    pub(crate) fn restart(&mut self, serial: u32, identification: Identification) {
        self.values.restore_defaults();
        self.set_serial(serial);
        self.mapping.restore_defaults(self.values.table());
        self.unmapped.clear();
        self.identification = identification;
        self.messages = Messages::default();
        self.status_changed = false;
        self.state = AlState::Init;
    }

    fn set_serial(&mut self, serial: u32) {
        let known = self.values.set_unsigned(ObjectIndex(0x1018), SubIndex(4), u64::from(serial));
        assert!(known, "tables/coe_objects.toml: 1018:04 holds a serial number");
    }

    /// Shows versions of this unit instead of those of the model.
    pub(crate) fn show(&mut self, information: &UnitInformation) {
        for (index, value) in information.coe_values() {
            if let Some(known) = self.values.value_mut(index, SubIndex::ZERO)
                && known.len() == value.len()
            {
                known.copy_from_slice(value);
            }
        }
    }

    /// Whether a master has changed a status in the refresh since the last call: it has read or written a
    /// message, acknowledged or cleared messages of the history, reset errors.
    pub(crate) const fn take_status_change(&mut self) -> bool {
        core::mem::replace(&mut self.status_changed, false)
    }

    /// Reads an entry of the diagnosis objects; none if it only stores a value.
    fn diagnosis_number(&self, index: ObjectIndex, sub: SubIndex) -> Option<u64> {
        let diagnosis = &self.diagnosis;
        let count = |level| diagnosis.current(level).len() as u64;
        Some(match (index.0, sub.0) {
            (0x10F3, 1) => diagnosis.log().system.len() as u64,
            (0x10F3, 2) => diagnosis.log().system.newest.into(),
            (0x10F3, 3) => diagnosis.newest_acknowledged().into(),
            (0x10F3, 4) => diagnosis.has_new_messages().into(),
            (0x10F3, 5) => diagnosis.emergencies_enabled().into(),
            (0x10F8, 0) => diagnosis.time_ns(),
            (0x2002, 1) => diagnosis.error_status().into(),
            (OBSERVATIONS, 0) => count(EventLevel::Observation),
            (MINOR_FAULTS, 0) => count(EventLevel::MinorFault),
            _ => return None,
        })
    }

    /// A record of the history or a current error; zeros if there is none.
    fn read_record(&self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) {
        value.fill(0);
        let at = usize::from(sub.0.saturating_sub(1));
        let error = |level| self.diagnosis.current(level).get(at).map(current_error_bytes);
        match index.0 {
            OBSERVATIONS => copy(error(EventLevel::Observation), value),
            MINOR_FAULTS => copy(error(EventLevel::MinorFault), value),
            _ => {
                let record = self.diagnosis.log().record_at(sub.0);
                copy::<DIAGNOSIS_MESSAGE_BYTES>(record.map(LogRecord::diagnosis_message), value);
            }
        }
    }

    /// Reads 3000:01 or 3001:01.
    fn read_message(&mut self, index: ObjectIndex, value: &mut [u8]) {
        let message = if index.0 == 0x3000 {
            self.status_changed |= self.messages.c_to_m.has_new();
            self.messages.c_to_m.read()
        } else {
            self.messages.m_to_c.written()
        };
        for (to, from) in value.iter_mut().zip(message) {
            *to = *from;
        }
    }

    /// Writes 3001:01.
    fn write_message(&mut self, value: &[u8]) -> Result<(), SdoAbort> {
        let message: &Message = value.try_into().map_err(|_| SdoAbort::LENGTH_MISMATCH)?;
        self.messages.m_to_c.write(message)?;
        self.status_changed = true;
        Ok(())
    }

    /// 1C32:02 and 1C33:02: in Free-Run the time between two local timer events (manual, A-6-6). The timer runs
    /// only for process data, so below SAFE-OP the value is the manual's default, 0.
    fn cycle_time_ns(&self) -> u64 {
        match self.state {
            AlState::SafeOp | AlState::Op => self.period.as_nanos(),
            _ => 0,
        }
    }

    /// PRE-OP to SAFE-OP: the mapping applies from now on, and every I/O entry has its default.
    pub(crate) fn begin_exchange(&mut self, m_to_c: &ImageLayout, c_to_m: &ImageLayout) {
        self.unmapped.rebuild(&mut self.values, &self.mapping, [m_to_c, c_to_m]);
    }

    /// Copies the I/O entries that the master writes by SDO to the process image M to C.
    pub(crate) fn give_unmapped_entries(&self, image: &mut [u8]) {
        self.unmapped.give(&self.values, image);
    }

    /// Copies the I/O entries that the master reads by SDO from the process image C to M; without an image,
    /// their defaults.
    pub(crate) fn take_unmapped_entries(&mut self, image: Option<&[u8]>) {
        self.unmapped.take(&mut self.values, image);
    }

    /// An object of the device profile area is not accessible by SDO while a PDO contains it (manual, A-6-9).
    fn refuse_mapped(&self, index: ObjectIndex, sub: SubIndex) -> Result<(), SdoAbort> {
        let carried = index.0 >= 0x6000 && self.mapping.is_mapped(index, sub);
        if carried { Err(SdoAbort::LOCAL_CONTROL) } else { Ok(()) }
    }
}

impl ObjectServer for UnitObjects {
    fn table(&self) -> &ObjectTable {
        self.values.table()
    }

    fn read(&mut self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) -> Result<(), SdoAbort> {
        if self.mapping.has(index) {
            return self.mapping.read(index, sub, value);
        }
        self.refuse_mapped(index, sub)?;
        if matches!((index.0, sub.0), (0x3000 | 0x3001, 1)) {
            self.read_message(index, value);
            return Ok(());
        }
        if matches!((index.0, sub.0), (0x10F3, 6..) | (OBSERVATIONS | MINOR_FAULTS, 1..)) {
            self.read_record(index, sub, value);
            return Ok(());
        }
        let number = match (index.0, sub.0) {
            (0x10E0, 1) => u64::from(self.identification.alias_register_value()),
            (0x10E0, 3) => u64::from(self.identification.switch_value()),
            (0x1C32 | 0x1C33, 2) => self.cycle_time_ns(),
            _ => match self.diagnosis_number(index, sub) {
                Some(number) => number,
                None => return self.values.read(index, sub, value),
            },
        };
        for (to, from) in value.iter_mut().zip(number.to_le_bytes()) {
            *to = from;
        }
        Ok(())
    }

    fn write(&mut self, index: ObjectIndex, sub: SubIndex, value: &[u8]) -> Result<(), SdoAbort> {
        if self.mapping.has(index) {
            return self.mapping.write(self.values.table(), index, sub, value);
        }
        self.refuse_mapped(index, sub)?;
        match (index.0, sub.0) {
            (0x10E0, 1) => self.identification.set_software(word(value)?),
            (0x10E0, 3) => self.identification.reload_switch(word(value)?),
            (0x3001, 1) => self.write_message(value),
            (0x10F3, 3) => {
                self.status_changed = true;
                self.diagnosis.acknowledge(value.first().copied().unwrap_or(0))
            }
            (0x10F3, 5) => {
                self.diagnosis.enable_emergencies(word(value)? & 1 != 0);
                Ok(())
            }
            // Commands, whose only value the table has checked; they always read 0 (manual, A-6-7).
            (0x2002, 2) => {
                self.status_changed = true;
                self.diagnosis.reset_errors();
                Ok(())
            }
            (0x2100, 0) => {
                self.status_changed = true;
                self.diagnosis.clear_history();
                Ok(())
            }
            _ => self.values.write(index, sub, value),
        }
    }
}

fn copy<const BYTES: usize>(from: Option<[u8; BYTES]>, value: &mut [u8]) {
    for (to, from) in value.iter_mut().zip(from.into_iter().flatten()) {
        *to = from;
    }
}

fn word(value: &[u8]) -> Result<u16, SdoAbort> {
    value.try_into().map(u16::from_le_bytes).map_err(|_| SdoAbort::LENGTH_MISMATCH)
}

#[cfg(test)]
mod tests;
