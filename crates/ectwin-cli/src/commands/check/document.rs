//! Findings and sizes as data for programs.

use nx_ect101::{
    Amount, Configuration, DataSet, DataSetKind, Direction, EventLevel, EventLevels, ExchangedDataSet, Fact,
    Finding, Side, Verdict,
};
use serde::Serialize;

use crate::failure::Failure;

#[derive(Serialize)]
struct Document {
    findings: Vec<FindingRow>,
    sizes: Sizes,
    data_sets: Vec<DataSetRow>,
}

#[derive(Serialize)]
struct FindingRow {
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
    message: String,
    correction: String,
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
pub(super) fn of(
    configuration: &Configuration,
    levels: EventLevels,
    verdict: &Verdict,
) -> Result<String, Failure> {
    let sizes = |direction| DirectionSizes::of(direction, configuration, verdict);
    let document = Document {
        findings: verdict.findings.iter().map(|finding| FindingRow::of(finding, levels)).collect(),
        sizes: Sizes { m_to_c: sizes(Direction::MToC), c_to_m: sizes(Direction::CToM) },
        data_sets: verdict.data_sets.iter().map(DataSetRow::of).collect(),
    };
    crate::output::json(&document)
}

impl FindingRow {
    fn of(finding: &Finding, levels: EventLevels) -> Self {
        let (pdo_bytes, io_bytes) = sizes(finding);
        Self {
            event_code: finding.event.to_string(),
            event_name: finding.event_name(),
            level: finding.level(levels),
            rule: finding.rule.id(),
            side: finding.side.id(),
            direction: finding.direction.id(),
            data_set: finding.data_set.map(|index| format!("{:04X}", index.0)),
            pdo_bytes,
            io_bytes,
            message: finding.message(),
            correction: finding.correction(),
        }
    }
}

/// The sizes of a finding: PDO entries, I/O entries.
fn sizes(finding: &Finding) -> (Option<usize>, Option<usize>) {
    match finding.fact {
        Fact::TxPdosTooLong { size_bytes, .. } => (Some(size_bytes), None),
        Fact::TooMuchData { size_bytes } if finding.side == Side::IoEntry => (None, Some(size_bytes)),
        Fact::TooMuchData { size_bytes } => (Some(size_bytes), None),
        Fact::OneSided { amounts } | Fact::Unequal { amounts } => {
            let of_side = |entries: fn(&Amount) -> usize| {
                let sets = DataSetKind::ALL.into_iter().zip(&amounts);
                let different = sets.filter(|(_, amount)| amount.io_entries != amount.pdo_entries);
                let bytes = different.map(|(kind, amount)| {
                    entries(amount) * usize::from(DataSet::of(finding.direction, kind).entry_bytes)
                });
                Some(bytes.sum())
            };
            (of_side(|amount| amount.pdo_entries), of_side(|amount| amount.io_entries))
        }
        _ => (None, None),
    }
}

impl DirectionSizes {
    fn of(direction: Direction, configuration: &Configuration, verdict: &Verdict) -> Self {
        let sets = || verdict.data_sets.iter().filter(|set| set.data_set.direction == direction);
        Self {
            pdo_bytes: nx_ect101::pdo_settings::size_bytes(&configuration.pdo, direction),
            io_bytes: sets().map(|set| set.io_entries * usize::from(set.data_set.entry_bytes)).sum(),
            exchanged_bytes: sets().map(ExchangedDataSet::exchanged_bytes).sum(),
        }
    }
}

impl DataSetRow {
    fn of(set: &ExchangedDataSet) -> Self {
        let bytes = |entries| entries * usize::from(set.data_set.entry_bytes);
        Self {
            name: &set.data_set.entry_name,
            direction: set.data_set.direction.id(),
            pdo: format!("{:04X}", set.data_set.pdo.0),
            pdo_entries: set.pdo_entries,
            pdo_bytes: bytes(set.pdo_entries),
            io_entries: set.io_entries,
            io_bytes: bytes(set.io_entries),
            exchanged_entries: set.exchanged_entries,
            exchanged_bytes: set.exchanged_bytes(),
        }
    }
}
