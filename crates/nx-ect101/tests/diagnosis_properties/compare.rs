//! The reports to each side, read back and compared with the model.

use nx_ect101::{ErrorLog, EventLevel, LogRecord};
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;

use crate::log::{ACCESS, HISTORY, Record};
use crate::model::{CURRENT, Error, Model};
use crate::rows::{INFORMATION, MINOR_FAULT, OBSERVATION};
use crate::run::Run;

/// Maximum length in bytes of a memory with full logs, in addition to its EEPROM image: 37 records of 30 bytes,
/// and a header.
const LOGS_BYTES_MAX: usize = 37 * 30 + 32;

impl Run {
    /// A refresh, and its reports to both sides.
    pub(crate) fn refresh(&mut self, time_ns: u64, refreshing: bool) -> TestCaseResult {
        self.bench.refresh(time_ns, refreshing);
        self.model.refresh(time_ns, refreshing);
        prop_assert_eq!(self.bench.cpu.m_to_c.newest().header.error, self.model.has_error());
        prop_assert_eq!(self.bench.read(0x10F8, 0), time_ns.to_le_bytes());
        let (inputs, mapped) = (&self.bench.inputs, &self.model.mapped);
        if inputs.is_empty() {
            return Ok(());
        }
        let new_messages = u8::from(self.model.log.has_new_messages());
        prop_assert_eq!(inputs[mapped.new_messages_at()], new_messages);
        if let Some(at) = mapped.error_status_at() {
            prop_assert_eq!(inputs[at], self.model.error_status);
        }
        Ok(())
    }

    /// All channels, byte for byte.
    pub(crate) fn compare(&mut self) -> TestCaseResult {
        self.compare_history()?;
        self.compare_current_errors()?;
        self.compare_logs()?;
        self.compare_memory()
    }

    /// Object 10F3.
    fn compare_history(&mut self) -> TestCaseResult {
        let Model { log, last_acknowledged, emergencies_enabled, .. } = &self.model;
        let newest_acknowledged =
            if self.reads_last_acknowledged { *last_acknowledged } else { log.newest() };
        let head = [
            vec![0x25],
            vec![log.stored() as u8],
            vec![log.newest()],
            vec![newest_acknowledged],
            vec![log.has_new_messages().into()],
            vec![(*emergencies_enabled).into(), 0],
        ];
        for (sub, expected) in (0..).zip(head) {
            prop_assert_eq!(self.bench.read(0x10F3, sub), expected, "10F3:{:02X}", sub);
        }
        for sub in 0x06..=0x25 {
            let expected = self.model.log.at(sub).map_or_else(|| vec![0; 24], Record::message);
            prop_assert_eq!(self.bench.read(0x10F3, sub), expected, "10F3:{:02X}", sub);
        }
        prop_assert_eq!(self.bench.unit.has_new_messages(), self.model.log.has_new_messages());
        prop_assert_eq!(self.bench.read(0x2100, 0), [0; 4]);
        Ok(())
    }

    /// Objects 2002, 2003 and 2004.
    fn compare_current_errors(&mut self) -> TestCaseResult {
        let status = self.model.error_status;
        for (sub, expected) in (0..).zip([2, status, 0]) {
            prop_assert_eq!(self.bench.read(0x2002, sub), [expected], "2002:{:02X}", sub);
        }
        prop_assert_eq!(self.bench.unit.error_status(), status);
        let lists =
            [(0x2003, OBSERVATION, EventLevel::Observation), (0x2004, MINOR_FAULT, EventLevel::MinorFault)];
        let mut count = 0;
        for (index, number, level) in lists {
            let errors = self.model.errors.iter().filter(|error| error.level == number);
            let expected: Vec<Vec<u8>> = errors.map(Error::bytes).collect();
            let current = self.bench.unit.current_errors(level);
            prop_assert_eq!(current.len(), expected.len());
            count += current.len();
            prop_assert_eq!(self.bench.read(index, 0), [expected.len() as u8]);
            let entries = expected.into_iter().chain(core::iter::repeat(vec![0; 12]));
            for (sub, expected) in (1..=10).zip(entries) {
                prop_assert_eq!(self.bench.read(index, sub), expected, "{:04X}:{:02X}", index, sub);
            }
        }
        prop_assert!(count <= CURRENT);
        prop_assert!(self.bench.unit.current_errors(EventLevel::Information).is_empty());
        Ok(())
    }

    /// Both event logs as support software sees them.
    fn compare_logs(&self) -> TestCaseResult {
        compare_log(self.bench.unit.error_log(), self.model.log.shown())
    }

    /// The stored memory.
    fn compare_memory(&self) -> TestCaseResult {
        let memory = nx_ect101::NonVolatileMemory::decode(&self.bench.stored);
        let memory = memory.map_err(|damage| TestCaseError::fail(damage.to_string()))?;
        prop_assert!(self.bench.stored.len() <= memory.sii_image().len() + LOGS_BYTES_MAX);
        prop_assert_eq!(memory.error_log().system.acknowledged, self.model.stored.acknowledged);
        compare_log(memory.error_log(), self.model.stored.shown())
    }
}

fn compare_log(log: &ErrorLog, [history, access]: [&[Record]; 2]) -> TestCaseResult {
    prop_assert!(log.system.len() <= HISTORY && log.access.len() <= ACCESS);
    prop_assert_eq!(log.history().map(record).collect::<Vec<_>>(), history);
    prop_assert_eq!(log.access.iter().map(record).collect::<Vec<_>>(), access);
    Ok(())
}

fn record(record: &LogRecord) -> Record {
    let level = match record.level {
        EventLevel::Information => INFORMATION,
        EventLevel::Observation => OBSERVATION,
        EventLevel::MinorFault => MINOR_FAULT,
    };
    let (event, details) = (record.event.0, record.details.to_vec());
    Record { event, level, time_ns: record.time_ns, details }
}
