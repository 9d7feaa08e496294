//! The setting rules evaluated for a unit file: findings, their places in the file, and the resulting exchange.

use core::ops::Range;

use wire::ObjectIndex;

use crate::event::{EventCode, EventLevel};

/// The result of the setting rules.
#[derive(Clone, Debug)]
pub struct SettingsCheck {
    /// All findings, in the order of the rules.
    pub findings: Vec<SettingsFinding>,
    /// The reaction of the unit to these settings, in a few words.
    pub consequence: String,
    /// From the master to the CPU Unit.
    pub m_to_c: DirectionSizes,
    /// From the CPU Unit to the master.
    pub c_to_m: DirectionSizes,
    /// The data sets, in the order of their objects.
    pub data_sets: Vec<ExchangedData>,
}

impl SettingsCheck {
    /// Whether a finding is an error, not only a warning.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.findings.iter().any(|finding| finding.level == EventLevel::MinorFault)
    }
}

/// A setting rule that is not satisfied. Words without a comment are those of data for programs.
#[derive(Clone, Debug)]
pub struct SettingsFinding {
    /// The event that it raises.
    pub event: EventCode,
    /// The name of the event.
    pub event_name: &'static str,
    /// The level of the event, as the user has set it.
    pub level: EventLevel,
    /// The rule.
    pub rule: &'static str,
    /// The kind of settings.
    pub side: &'static str,
    /// The direction of the data.
    pub direction: &'static str,
    /// The object of the data set; none if it concerns no data set, or several at once.
    pub data_set: Option<ObjectIndex>,
    /// Its size on the master's side; none if it concerns no size there.
    pub pdo_bytes: Option<usize>,
    /// The same on the CPU Unit's side.
    pub io_bytes: Option<usize>,
    /// The violation for people: place, value and limit, without a full stop.
    pub message: String,
    /// The correction for people, a sentence.
    pub correction: String,
    /// The places in the file that cause it; none if the file leaves all of them to the factory setting.
    pub places: Vec<FilePlace>,
}

/// A part of a unit file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePlace {
    /// Its bytes in the text.
    pub span: Range<usize>,
    /// What is wrong there, in a few words.
    pub label: String,
}

/// The lengths of a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DirectionSizes {
    /// Length of the SyncManager, with status PDOs.
    pub pdo_bytes: usize,
    /// Length of what the CPU Unit has allocated.
    pub io_bytes: usize,
    /// Length of what is exchanged.
    pub exchanged_bytes: usize,
}

/// The exchanged part of a data set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExchangedData {
    /// Its name.
    pub name: &'static str,
    /// Its direction, as in data for programs.
    pub direction: &'static str,
    /// Its PDO.
    pub pdo: ObjectIndex,
    /// Length of one entry.
    pub entry_bytes: usize,
    /// Entries that the assigned PDO maps.
    pub pdo_entries: usize,
    /// Entries that the CPU Unit has allocated.
    pub io_entries: usize,
    /// Entries that are exchanged.
    pub exchanged_entries: usize,
}

impl ExchangedData {
    /// Length of what is exchanged.
    #[must_use]
    pub const fn exchanged_bytes(&self) -> usize {
        self.exchanged_entries * self.entry_bytes
    }
}
