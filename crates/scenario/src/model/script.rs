//! A whole scenario as written: units and programs by their files, and steps.

use serde::{Deserialize, Deserializer, Serialize, de};
use time::Duration;

use super::calendar::Calendar;
use super::spelling::{optional_text, text};
use super::step::ScriptStep;

/// Seed of a scenario without one.
const DEFAULT_SEED: u64 = 1;
const DEFAULT_LIMIT: Duration = Duration::from_secs(60);
const DEFAULT_CYCLE: Duration = Duration::from_millis(1);

/// A scenario, written in JSON or built in code. [`Scenario::of`](crate::Scenario::of) makes an executable one from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// What it demonstrates, in one sentence.
    pub title: String,
    /// The seed of its random generator.
    #[serde(default = "default_seed")]
    pub seed: u64,
    /// The time at which it ends, whatever is still waiting.
    #[serde(default = "default_limit", with = "text")]
    pub limit: Duration,
    /// Cycle of the process data, above 0.
    #[serde(default = "default_cycle", with = "text")]
    pub cycle: Duration,
    /// Start of the cycle within its period, from the start of the scenario; none: taken from the seed.
    #[serde(default, with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub cycle_phase: Option<Duration>,
    /// Date and time at which it starts: the system time of object 10F8, and the times in captures.
    #[serde(default, skip_serializing_if = "is_default")]
    pub calendar: Calendar,
    /// A capture whose frames a recorded master sends; none: only the scripted master.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capture: Option<String>,
    /// The user program of the master; none: it only executes the orders of steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub master: Option<ScriptMaster>,
    /// The units of the line, the one next to the master first; none: one unit at its factory setting.
    #[serde(default, deserialize_with = "at_least_one", skip_serializing_if = "Vec::is_empty")]
    pub units: Vec<ScriptUnit>,
    /// The steps, in this order.
    pub steps: Vec<ScriptStep>,
}

fn is_default(calendar: &Calendar) -> bool {
    *calendar == Calendar::default()
}

const fn default_seed() -> u64 {
    DEFAULT_SEED
}

const fn default_limit() -> Duration {
    DEFAULT_LIMIT
}

const fn default_cycle() -> Duration {
    DEFAULT_CYCLE
}

/// An empty list would mean one unit, as if the key were left out.
fn at_least_one<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<ScriptUnit>, D::Error> {
    let units = Vec::deserialize(deserializer)?;
    let none =
        || de::Error::custom("`units` is an empty list: leave it out for one unit at its factory setting");
    if units.is_empty() { Err(none()) } else { Ok(units) }
}

impl Script {
    /// A scenario with only this title: one unit at its factory setting, no steps.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Self {
            title: title.to_owned(),
            seed: DEFAULT_SEED,
            limit: DEFAULT_LIMIT,
            cycle: DEFAULT_CYCLE,
            cycle_phase: None,
            calendar: Calendar::default(),
            capture: None,
            master: None,
            units: Vec::new(),
            steps: Vec::new(),
        }
    }
}

/// A unit, and the program of its CPU Unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ScriptUnit {
    /// A unit file, by its path relative to the scenario.
    File(String),
    /// A unit file, with another program than its own.
    FileWithProgram(FileWithProgram),
    /// The keys of a unit file.
    Keys(toml::Table),
}

/// A unit file, with another program than its own; paths are relative to the scenario.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileWithProgram {
    /// The unit file.
    pub file: String,
    /// The files of the program; none: that of the unit file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub program: Option<Paths>,
}

/// The user program of the master.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScriptMaster {
    /// Its files, relative to the scenario.
    pub program: Paths,
    /// Names of the units as EtherCAT slaves, in the order of the line; names that are left out are made from
    /// the node address.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub device_names: Vec<String>,
    /// Period of its task; none: that of the process data, synchronous with them.
    #[serde(default, with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub task_period: Option<Duration>,
}

/// One path, or several that belong together.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Paths {
    /// A file or a folder.
    One(String),
    /// Files or folders.
    Several(Vec<String>),
}

impl Paths {
    /// All of them, in their order.
    #[must_use]
    pub fn list(&self) -> &[String] {
        match self {
            Self::One(path) => core::slice::from_ref(path),
            Self::Several(paths) => paths,
        }
    }
}
