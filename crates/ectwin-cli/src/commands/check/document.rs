//! Findings and sizes as data for programs.

use serde::Serialize;
use unit_model::{EventLevel, ExchangedData, SettingsCheck, SettingsFinding};

use crate::failure::Failure;

#[derive(Serialize)]
struct Document<'a> {
    findings: Vec<FindingRow<'a>>,
    sizes: Sizes,
    data_sets: Vec<DataSetRow>,
}

#[derive(Serialize)]
struct FindingRow<'a> {
    event_code: String,
    event_name: &'static str,
    level: EventLevel,
    rule: &'static str,
    side: &'static str,
    direction: &'static str,
    data_set: Option<String>,
    /// The size of the finding on the master's side; none if it concerns no size there.
    pdo_bytes: Option<usize>,
    /// The same on the CPU Unit's side.
    io_bytes: Option<usize>,
    message: &'a str,
    correction: &'a str,
}

#[derive(Serialize)]
struct Sizes {
    m_to_c: DirectionSizes,
    c_to_m: DirectionSizes,
}

/// `pdo_bytes` is the length of the SyncManager, so status PDOs are included.
#[derive(Serialize)]
struct DirectionSizes {
    pdo_bytes: usize,
    io_bytes: usize,
    exchanged_bytes: usize,
}

#[derive(Serialize)]
struct DataSetRow {
    name: &'static str,
    direction: &'static str,
    pdo: String,
    pdo_entries: usize,
    pdo_bytes: usize,
    io_entries: usize,
    io_bytes: usize,
    exchanged_entries: usize,
    exchanged_bytes: usize,
}

/// The document of a model without setting rules, for these lengths from the master and to the master.
pub(super) fn without_rules(outputs: usize, inputs: usize) -> Result<String, Failure> {
    let sizes = |bytes| DirectionSizes { pdo_bytes: bytes, io_bytes: bytes, exchanged_bytes: bytes };
    let sizes = Sizes { m_to_c: sizes(outputs), c_to_m: sizes(inputs) };
    crate::output::json(&Document { findings: Vec::new(), sizes, data_sets: Vec::new() })
}

/// The JSON document.
pub(super) fn of(check: &SettingsCheck) -> Result<String, Failure> {
    let document = Document {
        findings: check.findings.iter().map(FindingRow::of).collect(),
        sizes: Sizes { m_to_c: check.m_to_c.into(), c_to_m: check.c_to_m.into() },
        data_sets: check.data_sets.iter().map(DataSetRow::of).collect(),
    };
    crate::output::json(&document)
}

impl<'a> FindingRow<'a> {
    fn of(finding: &'a SettingsFinding) -> Self {
        Self {
            event_code: finding.event.to_string(),
            event_name: finding.event_name,
            level: finding.level,
            rule: finding.rule,
            side: finding.side,
            direction: finding.direction,
            data_set: finding.data_set.map(|index| format!("{:04X}", index.0)),
            pdo_bytes: finding.pdo_bytes,
            io_bytes: finding.io_bytes,
            message: &finding.message,
            correction: &finding.correction,
        }
    }
}

impl From<unit_model::DirectionSizes> for DirectionSizes {
    fn from(sizes: unit_model::DirectionSizes) -> Self {
        let unit_model::DirectionSizes { pdo_bytes, io_bytes, exchanged_bytes } = sizes;
        Self { pdo_bytes, io_bytes, exchanged_bytes }
    }
}

impl DataSetRow {
    fn of(set: &ExchangedData) -> Self {
        Self {
            name: set.name,
            direction: set.direction,
            pdo: format!("{:04X}", set.pdo.0),
            pdo_entries: set.pdo_entries,
            pdo_bytes: set.pdo_entries * set.entry_bytes,
            io_entries: set.io_entries,
            io_bytes: set.io_entries * set.entry_bytes,
            exchanged_entries: set.exchanged_entries,
            exchanged_bytes: set.exchanged_bytes(),
        }
    }
}
