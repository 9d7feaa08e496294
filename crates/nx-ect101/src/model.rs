//! The unit for the crates above: the words of the model, and the view that is independent of models.

use std::path::PathBuf;
use std::sync::Arc;

use coe_kit::history::FIRST_RECORD;
use coe_kit::indicators::Pattern;
use esi::{DeviceDescription, NamedBit};
use objects::ObjectTable;
use time::Duration;
use unit_model::keys::Timing;
use unit_model::{
    AttachedInformation, CurrentError, DataValid, EventCode, EventInfo, EventLevel, EventLog,
    LevelNotChangeable, MemoryDamage, Model, ModelTables, ModelUnit, NotThere, PowerOn, PoweredUnit,
    RecordedEvent, SettingsCheck, SlaveView, StoredLogs, StoredRecord, UnitFiles, UnitSection,
};
use user_file::{Located, Reader, Section};
use variables::VariableTable;

use crate::config::device_config_with;
use crate::description::description;
use crate::events::Event;
use crate::fault::Fault;
use crate::indicators::Indicators;
use crate::memory::{
    ACCESS_RECORDS_MAX, Damage, LogRecord, MemoryAtPowerOn, NonVolatileMemory, SYSTEM_RECORDS_MAX,
};
use crate::model_tables;
use crate::named_bits::NAMED_BITS;
use crate::outage::Outage;
use crate::settings::UnitSettings;
use crate::settings_check;
use crate::tables::object_table;
use crate::timing::slave_period;
use crate::unit::NxEct101;
use crate::unit_file::{self, UnitFile};

/// The model.
pub static MODEL: NxEct101Model = NxEct101Model;

/// The values that are the same for all units.
#[derive(Clone, Copy, Debug)]
pub struct NxEct101Model;

/// The names of the faults, in the order of [`Fault::ALL`].
const FAULTS: [&str; Fault::ALL.len() + Outage::ALL.len()] = {
    let mut names = [""; Fault::ALL.len() + Outage::ALL.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = match at.checked_sub(Fault::ALL.len()) {
            None => Fault::ALL[at].name(),
            Some(outage) => Outage::ALL[outage].name(),
        };
        at += 1;
    }
    names
};
/// An indicator by its name.
type IndicatorRow = (&'static str, fn(&Indicators) -> Pattern);
/// TS has two colours.
const INDICATORS: [IndicatorRow; 6] = [
    ("RUN", |indicators| indicators.run),
    ("ERR", |indicators| indicators.err),
    ("L/A IN", |indicators| indicators.la_in),
    ("L/A OUT", |indicators| indicators.la_out),
    ("TS green", |indicators| indicators.ts_green),
    ("TS red", |indicators| indicators.ts_red),
];
const INDICATOR_NAMES: [&str; INDICATORS.len()] = {
    let mut names = [""; INDICATORS.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = INDICATORS[at].0;
        at += 1;
    }
    names
};
const ID_SWITCH: &str = "ID";

impl Model for NxEct101Model {
    fn name(&self) -> &'static str {
        "nx-ect101"
    }

    fn event(&self, code: EventCode) -> Option<EventInfo> {
        Event::find(code).map(|event| EventInfo { code, name: &event.name, level: event.level })
    }

    fn faults(&self) -> &'static [&'static str] {
        &FAULTS
    }

    fn is_fault_of_operation(&self, fault: &str) -> bool {
        Fault::named(fault).is_some_and(Fault::is_of_operation)
    }

    fn is_single_fault(&self, fault: &str) -> bool {
        Fault::named(fault) == Some(Fault::MessageCommunications)
    }

    fn records_max(&self, log: EventLog) -> Option<usize> {
        match log {
            EventLog::System => Some(SYSTEM_RECORDS_MAX),
            EventLog::Access => Some(ACCESS_RECORDS_MAX),
            EventLog::None => Some(0),
        }
    }

    fn indicators(&self) -> &'static [&'static str] {
        &INDICATOR_NAMES
    }

    fn switches(&self) -> &'static [&'static str] {
        &[ID_SWITCH]
    }

    fn tables(&self) -> &'static ModelTables {
        model_tables::tables()
    }

    fn stored_logs(&self, memory: &[u8]) -> Result<StoredLogs, MemoryDamage> {
        let memory = decoded(memory)?;
        let log = memory.error_log();
        let stored = |log| {
            move |record: &LogRecord| {
                let attached = AttachedInformation::of(&record.details);
                let event = RecordedEvent { code: record.event, level: record.level, attached };
                StoredRecord { log, event, time_ns: record.time_ns }
            }
        };
        let system = log.history().map(stored(EventLog::System));
        let access = log.access.iter().map(stored(EventLog::Access));
        Ok(StoredLogs { serial: memory.serial(), records: system.chain(access).collect() })
    }

    fn every_variable(&self) -> Vec<VariableTable> {
        model_tables::every_variable()
    }
}

impl UnitFiles for NxEct101Model {
    fn keys(&self) -> Vec<&'static str> {
        unit_file::top_keys().to_vec()
    }

    fn read(&self, reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Option<Arc<dyn UnitSection>> {
        let file = UnitFile::read(reader, file)?;
        Some(Arc::new(file))
    }
}

impl UnitSection for UnitFile {
    fn model(&self) -> &'static dyn Model {
        &MODEL
    }

    fn name(&self) -> &str {
        &self.name.value
    }

    fn storage(&self) -> Option<&Located<PathBuf>> {
        self.storage.as_ref()
    }

    fn node_address(&self) -> u16 {
        UnitSettings::from_unit_file(self).explicit_device_id()
    }

    fn description(&self) -> DeviceDescription {
        description(&UnitSettings::from_unit_file(self))
    }

    fn objects(&self) -> Arc<ObjectTable> {
        object_table()
    }

    fn named_bits(&self) -> &'static [NamedBit] {
        NAMED_BITS
    }

    fn variables(&self) -> VariableTable {
        self.variable_table()
    }

    fn refresh_period(&self) -> Option<Duration> {
        Some(slave_period(self.timing.value, self.io_allocation().total_bytes()))
    }

    fn names_refresh_phase(&self) -> bool {
        self.refresh_phase.is_some()
    }

    fn check_settings(&self) -> Option<SettingsCheck> {
        Some(settings_check::check(self))
    }

    fn check_memory(&self, bytes: &[u8]) -> Result<(), MemoryDamage> {
        decoded(bytes).map(|_| ())
    }

    fn memory_bytes_max(&self, memory: &unit_model::MemoryAtPowerOn) -> usize {
        match found(memory) {
            MemoryAtPowerOn::Stored(memory) => memory.encoded_bytes_max(),
            MemoryAtPowerOn::Factory | MemoryAtPowerOn::Damaged => {
                NonVolatileMemory::factory(&UnitSettings::default()).encoded_bytes_max()
            }
        }
    }

    fn power_on(&self, conditions: &PowerOn) -> PoweredUnit {
        let fast = UnitFile { timing: Located::left_out(Timing::Fast), ..self.clone() };
        let mut settings = UnitSettings::from_unit_file(if conditions.fast { &fast } else { self });
        if self.refresh_phase.is_none() {
            settings.refresh_phase = conditions.refresh_phase;
        }
        let (unit, cpu) = NxEct101::power_on_with(&settings, found(&conditions.memory));
        let config = device_config_with(&settings, unit.memory().sii_image().to_vec());
        PoweredUnit { config, unit: Box::new(unit), cpu }
    }
}

fn decoded(bytes: &[u8]) -> Result<NonVolatileMemory, MemoryDamage> {
    NonVolatileMemory::decode(bytes).map_err(|damage| match damage {
        Damage::NoMemory => MemoryDamage::NoMemory,
        damage => MemoryDamage::Damaged(damage.to_string()),
    })
}

/// The memory that was found. What cannot be decoded is damaged.
fn found(memory: &unit_model::MemoryAtPowerOn) -> MemoryAtPowerOn {
    match memory {
        unit_model::MemoryAtPowerOn::Factory => MemoryAtPowerOn::Factory,
        unit_model::MemoryAtPowerOn::Damaged => MemoryAtPowerOn::Damaged,
        unit_model::MemoryAtPowerOn::Stored(bytes) => match NonVolatileMemory::decode(bytes) {
            Ok(memory) => MemoryAtPowerOn::Stored(Box::new(memory)),
            Err(_) => MemoryAtPowerOn::Damaged,
        },
    }
}

impl ModelUnit for NxEct101 {
    fn model(&self) -> &'static dyn Model {
        &MODEL
    }

    fn data_valid(&self) -> DataValid {
        let status = self.slave_status();
        DataValid { outputs: status.m_to_c_valid, inputs: status.c_to_m_valid }
    }

    fn take_event(&mut self) -> Option<RecordedEvent> {
        self.take_occurred_event()
    }

    fn injected_faults(&self) -> u32 {
        self.injected_bits()
    }

    fn current_errors(&self, level: EventLevel) -> &[CurrentError] {
        self.current_errors(level)
    }

    fn error_status(&self) -> u8 {
        self.error_status()
    }

    fn has_new_messages(&self) -> bool {
        self.has_new_messages()
    }

    fn reset_errors(&mut self) {
        self.reset_errors();
    }

    fn set_event_level(&mut self, code: EventCode, level: EventLevel) -> Result<(), LevelNotChangeable> {
        self.set_event_level(code, level)
    }

    fn clear_event_log(&mut self, log: EventLog) {
        self.clear_event_log(log);
    }

    fn logged(&self, log: EventLog) -> Vec<EventCode> {
        let records: Vec<&LogRecord> = match log {
            EventLog::System => self.error_log().history().collect(),
            EventLog::Access => self.error_log().access.iter().collect(),
            EventLog::None => Vec::new(),
        };
        records.into_iter().map(|record| record.event).collect()
    }

    fn diagnosis_message(&self, number: u8) -> Option<EventCode> {
        let sub = number.checked_add(FIRST_RECORD - 1)?;
        self.error_log().record_at(sub).map(|record| record.event)
    }

    fn newest_diagnosis_message(&self) -> Option<u8> {
        self.error_log().system.newest.checked_sub(FIRST_RECORD - 1)
    }

    fn inject(&mut self, fault: &str) -> Result<(), NotThere> {
        match Outage::named(fault) {
            Some(outage) => self.begin_outage(outage),
            None => self.inject(Fault::named(fault).ok_or(NotThere)?),
        }
        Ok(())
    }

    fn remove(&mut self, fault: &str) -> Result<(), NotThere> {
        match Outage::named(fault) {
            Some(outage) => self.end_outage(outage),
            None => self.remove(Fault::named(fault).ok_or(NotThere)?),
        }
        Ok(())
    }

    fn set_switch(&mut self, switch: &str, position: u16) -> Result<(), NotThere> {
        let position = u8::try_from(position).map_err(|_| NotThere)?;
        (switch == ID_SWITCH).then(|| self.set_id_switch(position)).ok_or(NotThere)
    }

    fn indicator(&self, name: &str, slave: &SlaveView) -> Option<Pattern> {
        let (_, pattern) = INDICATORS.iter().find(|(known, _)| *known == name)?;
        let SlaveView { al_status, al_status_code, in_port, out_port } = *slave;
        Some(pattern(&self.indicators(al_status, al_status_code, [in_port, out_port])))
    }

    fn take_memory_change(&mut self, sii_image: &[u8], sii_words_written: u32) -> bool {
        self.take_memory_change(sii_image, sii_words_written)
    }

    fn encode_memory(&self, bytes: &mut Vec<u8>) {
        self.memory().encode_into(bytes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_word_of_the_model_means_something_to_a_unit_and_no_other_does() {
        let (mut unit, _cpu) = NxEct101::power_on(&UnitSettings::default());
        let unit: &mut dyn ModelUnit = &mut unit;
        let model = unit.model();
        for fault in model.faults() {
            assert_eq!((unit.inject(fault), unit.remove(fault)), (Ok(()), Ok(())), "{fault}");
            let word = Fault::named(fault).map(|fault| format!("{fault:?}"));
            let word = word.or_else(|| Outage::named(fault).map(|outage| format!("{outage:?}")));
            assert_eq!(word.as_deref(), Some(*fault));
        }
        for indicator in model.indicators() {
            assert!(unit.indicator(indicator, &SlaveView::default()).is_some(), "{indicator}");
        }
        for switch in model.switches() {
            assert_eq!(unit.set_switch(switch, 0xFF), Ok(()), "{switch}");
            assert_eq!(unit.set_switch(switch, 0x100), Err(NotThere), "{switch}");
        }
        assert_eq!(unit.inject("processing"), Err(NotThere));
        assert_eq!(unit.indicator("TS", &SlaveView::default()), None);
        assert_eq!(unit.set_switch("", 1), Err(NotThere));
        assert!(unit.as_model::<NxEct101>().is_some());
    }
}
