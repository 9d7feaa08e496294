//! What answers contain beside `id`, `ok` and `at_ns`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Of `expect`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Held {
    /// Whether the condition was true.
    pub held: bool,
    /// The actual state, if it was not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seen: Option<String>,
}

/// Of `status`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Status {
    /// The link, as in the line `ready`.
    pub link: String,
    /// The units, the one next to the master first.
    pub units: Vec<UnitReport>,
}

/// What a unit shows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct UnitReport {
    /// Its number, from 1.
    pub unit: usize,
    /// Its name.
    pub name: String,
    /// Its model.
    pub model: String,
    /// Whether it is switched on.
    pub power: bool,
    /// Its state, such as `SAFE-OP`.
    pub state: String,
    /// The error indication of AL status.
    pub error: bool,
    /// AL status code, such as `0x001B`.
    pub al_status_code: String,
    /// Its published meaning, unless it is 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub al_status_name: Option<String>,
    /// The pattern of each indicator by its name, as in `ectwin list indicators`.
    pub indicators: BTreeMap<String, String>,
    /// The current errors, the oldest first.
    pub errors: Vec<UnitError>,
    /// The operating mode of its CPU Unit: `RUN` or `PROGRAM`.
    pub mode: String,
    /// Whether each port has a link, by its name: `IN`, `OUT`.
    pub link: BTreeMap<String, bool>,
    /// Counters by their names.
    pub counters: BTreeMap<String, u64>,
}

/// A current error.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct UnitError {
    /// Code of its event, such as `85000000`.
    pub event: String,
    /// Name of its event.
    pub event_name: String,
    /// `minor_fault`, `observation` or `information`.
    pub level: String,
}

/// Of `read`, `write`, `force` and `release`: the variables by their names in the request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Variables {
    /// Each variable.
    pub values: BTreeMap<String, VariableReport>,
}

/// A device variable, or an element of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VariableReport {
    /// Its type, such as `ARRAY[0..14] OF UINT`.
    #[serde(rename = "type")]
    pub variable_type: String,
    /// true or false, a number, a text in the notation of Structured Text, or a list of these.
    pub value: Value,
    /// Whether it can be used for control: `valid`, `invalid`, or why not.
    pub validity: String,
    /// Whether it is forced.
    pub forced: bool,
}

/// Of `object`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObjectReport {
    /// Unit and entry, as in `N1 1018:04`.
    pub object: String,
    /// Its data type, such as `U32`.
    #[serde(rename = "type")]
    pub data_type: String,
    /// A number, true or false, a text; the bytes of another type as text, such as `0A 00`.
    pub value: Value,
    /// Its bytes, in the order of the wire.
    pub bytes: String,
}

/// Of `subscribe` and `unsubscribe`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subscribed {
    /// Everything that is subscribed now: kinds of records, and `variable:NAME`.
    pub subscribed: Vec<String>,
}

/// Of `faults` and `clear`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Faults {
    /// The faults at work.
    pub faults: Vec<ActiveFault>,
}

/// A fault at work.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ActiveFault {
    /// What `clear` takes; none: a fault of frames without a name, which only `all` ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clear: Option<String>,
    /// The sentence that begins it.
    pub sentence: String,
    /// The number of its unit; none: it is a fault of frames.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<usize>,
    /// When it ends by itself, in nanoseconds since power-on of the twin; none: not by the time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ends_at_ns: Option<u64>,
    /// Frames of its kind since it began.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames_seen: Option<u64>,
    /// Those that have met it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames_met: Option<u64>,
}

/// Of `sentences`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sentences {
    /// All sentences, by their tables.
    pub sentences: Vec<SentenceRow>,
}

/// A sentence.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SentenceRow {
    /// What it is about.
    pub about: AboutSentence,
    /// The verb that takes it: `do` or `expect`.
    pub verb: String,
    /// Its words and places, such as `force {variable} to {value}`.
    pub pattern: String,
    /// An example.
    pub example: String,
    /// Its meaning.
    pub meaning: String,
}

/// What a sentence is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AboutSentence {
    /// An order to units.
    Unit,
    /// An order to CPU Units.
    Cpu,
    /// An order to the line: cables and frames.
    Line,
    /// A condition.
    Condition,
}
