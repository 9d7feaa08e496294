//! The parts of a scenario file, with their places.

use serde::Deserialize;
use toml::Spanned;

use super::said::SaidEntry;
use crate::model::{Condition, CpuOrder, LineOrder, MasterOrder, Paths, ScriptUnit, UnitOrder};

/// A scenario file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub(super) title: Spanned<String>,
    pub(super) seed: Option<u64>,
    pub(super) limit: Option<Spanned<String>>,
    pub(super) cycle: Option<Spanned<String>>,
    pub(super) cycle_phase: Option<Spanned<String>>,
    pub(super) capture: Option<String>,
    pub(super) master: Option<Spanned<MasterEntry>>,
    #[serde(default)]
    pub(super) units: Vec<Spanned<ScriptUnit>>,
    pub(super) steps: Vec<Spanned<StepEntry>>,
}

/// The user program of the master.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MasterEntry {
    pub(super) program: Spanned<Paths>,
    pub(super) device_names: Option<Spanned<Vec<String>>>,
    pub(super) task_period: Option<Spanned<String>>,
}

/// One step: orders and conditions are sentences, or typed values.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StepEntry {
    pub(super) at: Option<Spanned<String>>,
    pub(super) after: Option<Spanned<String>>,
    pub(super) when: Option<Spanned<SaidEntry<Condition>>>,
    pub(super) master: Option<Spanned<SaidEntry<MasterOrder>>>,
    pub(super) unit: Option<Spanned<SaidEntry<UnitOrder>>>,
    pub(super) cpu: Option<Spanned<SaidEntry<CpuOrder>>>,
    pub(super) line: Option<Spanned<SaidEntry<LineOrder>>>,
    pub(super) expect: Option<Spanned<SaidEntry<Condition>>>,
    pub(super) never: Option<Spanned<SaidEntry<Condition>>>,
    pub(super) within: Option<Spanned<String>>,
    pub(super) r#for: Option<Spanned<String>>,
    pub(super) until: Option<Spanned<SaidEntry<Condition>>>,
    pub(super) repeat: Option<Spanned<u64>>,
    pub(super) every: Option<Spanned<String>>,
    pub(super) jitter: Option<Spanned<String>>,
    pub(super) random: Option<Spanned<u64>>,
}
