//! The setting rules evaluated for a unit file, in words of data for programs and for people.

mod consequence;
mod places;

use unit_model::{DirectionSizes, ExchangedData, SettingsCheck, SettingsFinding};

use crate::data_sets::{DataSet, DataSetKind, Direction};
use crate::finding::{Amount, Fact, Finding};
use crate::pdo_settings;
use crate::rule_kind::Side;
use crate::settings::{EventLevels, UnitSettings};
use crate::unit_file::UnitFile;
use crate::verdict::{Configuration, ExchangedDataSet, Verdict};

/// Evaluates the rules.
pub(crate) fn check(file: &UnitFile) -> SettingsCheck {
    let configuration = Configuration::from_unit_file(file);
    let levels = UnitSettings::from_unit_file(file).event_levels;
    let verdict = configuration.check();
    let sizes = |direction| direction_sizes(direction, &configuration, &verdict);
    SettingsCheck {
        findings: verdict.findings.iter().map(|found| finding(found, levels, file)).collect(),
        consequence: consequence::of(&verdict, |finding| finding.level(levels)),
        m_to_c: sizes(Direction::MToC),
        c_to_m: sizes(Direction::CToM),
        data_sets: verdict.data_sets.iter().map(exchanged).collect(),
    }
}

fn finding(finding: &Finding, levels: EventLevels, file: &UnitFile) -> SettingsFinding {
    let (pdo_bytes, io_bytes) = sizes(finding);
    SettingsFinding {
        event: finding.event,
        event_name: finding.event_name(),
        level: finding.level(levels),
        rule: finding.rule.id(),
        side: finding.side.id(),
        direction: finding.direction.id(),
        data_set: finding.data_set,
        pdo_bytes,
        io_bytes,
        message: finding.message(),
        correction: finding.correction(),
        places: places::of(file, finding),
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
                let different = sets.filter(|(_, amount)| amount.is_unequal());
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

fn direction_sizes(direction: Direction, configuration: &Configuration, verdict: &Verdict) -> DirectionSizes {
    let sets = || verdict.data_sets.iter().filter(|set| set.data_set.direction == direction);
    DirectionSizes {
        pdo_bytes: pdo_settings::size_bytes(&configuration.pdo, direction),
        io_bytes: sets().map(|set| set.io_entries * usize::from(set.data_set.entry_bytes)).sum(),
        exchanged_bytes: sets().map(ExchangedDataSet::exchanged_bytes).sum(),
    }
}

fn exchanged(set: &ExchangedDataSet) -> ExchangedData {
    ExchangedData {
        name: &set.data_set.entry_name,
        direction: set.data_set.direction.id(),
        pdo: set.data_set.pdo,
        entry_bytes: set.data_set.entry_bytes.into(),
        pdo_entries: set.pdo_entries,
        io_entries: set.io_entries,
        exchanged_entries: set.exchanged_entries,
    }
}
