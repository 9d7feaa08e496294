//! What a scenario file is made of, with the places of its parts.

use serde::Deserialize;
use toml::Spanned;

/// A scenario file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct File {
    pub(crate) title: Spanned<String>,
    pub(crate) seed: Option<u64>,
    pub(crate) limit: Option<Spanned<String>>,
    pub(crate) cycle: Option<Spanned<String>>,
    pub(crate) cycle_phase: Option<Spanned<String>>,
    pub(crate) capture: Option<String>,
    pub(crate) master: Option<Spanned<MasterEntry>>,
    #[serde(default)]
    pub(crate) units: Vec<Spanned<UnitEntry>>,
    pub(crate) steps: Vec<Spanned<StepEntry>>,
}

/// One step.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StepEntry {
    pub(crate) at: Option<Spanned<String>>,
    pub(crate) after: Option<Spanned<String>>,
    pub(crate) when: Option<Spanned<String>>,
    pub(crate) master: Option<Spanned<String>>,
    pub(crate) unit: Option<Spanned<String>>,
    pub(crate) cpu: Option<Spanned<String>>,
    pub(crate) line: Option<Spanned<String>>,
    pub(crate) expect: Option<Spanned<String>>,
    pub(crate) never: Option<Spanned<String>>,
    pub(crate) within: Option<Spanned<String>>,
    pub(crate) r#for: Option<Spanned<String>>,
    pub(crate) until: Option<Spanned<String>>,
    pub(crate) repeat: Option<Spanned<u64>>,
    pub(crate) every: Option<Spanned<String>>,
    pub(crate) jitter: Option<Spanned<String>>,
    pub(crate) random: Option<Spanned<u64>>,
}

/// How a scenario names a unit.
#[derive(Deserialize)]
#[serde(untagged)]
pub(crate) enum UnitEntry {
    /// A unit file.
    Path(String),
    /// A unit file, and another program than its own.
    File(FileEntry),
    /// The keys of a unit file.
    Table(toml::Table),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FileEntry {
    pub(crate) file: String,
    pub(crate) program: Option<Paths>,
}

/// One path, or several that belong together.
#[derive(Deserialize)]
#[serde(untagged)]
pub(crate) enum Paths {
    One(String),
    Several(Vec<String>),
}

impl Paths {
    pub(crate) fn list(self) -> Vec<String> {
        match self {
            Self::One(path) => vec![path],
            Self::Several(paths) => paths,
        }
    }
}

/// What a scenario says of the master.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MasterEntry {
    pub(crate) program: Spanned<Paths>,
    pub(crate) device_names: Option<Spanned<Vec<String>>>,
    pub(crate) task_period: Option<Spanned<String>>,
}
