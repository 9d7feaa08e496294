//! What a request asks for.

use serde_json::{Value, json};
use time::Duration;

/// What is to be done.
#[derive(Clone, Debug, PartialEq)]
pub enum Verb {
    /// An order.
    Do(String),
    /// A condition.
    Expect {
        /// Its sentence.
        condition: String,
        /// The time in which it has to become true; none: now.
        within: Option<Duration>,
    },
    /// What the units show.
    Status,
    /// Variables are read.
    Read(Vec<String>),
    /// Variables are written once.
    Write(Vec<(String, Value)>),
    /// Variables get a value until they are released.
    Force(Vec<(String, Value)>),
    /// Variables are released.
    Release(Vec<String>),
    /// An object is read: unit and entry.
    Object(String),
    /// Records of these kinds are sent.
    Subscribe(Vec<String>),
    /// Records of these kinds are not sent any more.
    Unsubscribe(Vec<String>),
    /// The faults at work.
    Faults,
    /// A fault, or `all`, ends.
    Clear(String),
    /// All sentences.
    Sentences,
}

impl Verb {
    /// The name of the verb, its value, and the value of `within`.
    pub(super) fn member(&self) -> (&'static str, Value, Option<Duration>) {
        let object = |values: &[(String, Value)]| Value::Object(values.iter().cloned().collect());
        match self {
            Self::Do(order) => ("do", json!(order), None),
            Self::Expect { condition, within } => ("expect", json!(condition), *within),
            Self::Status => ("status", json!(true), None),
            Self::Read(names) => ("read", json!(names), None),
            Self::Write(values) => ("write", object(values), None),
            Self::Force(values) => ("force", object(values), None),
            Self::Release(names) => ("release", json!(names), None),
            Self::Object(object) => ("object", json!(object), None),
            Self::Subscribe(kinds) => ("subscribe", json!(kinds), None),
            Self::Unsubscribe(kinds) => ("unsubscribe", json!(kinds), None),
            Self::Faults => ("faults", json!(true), None),
            Self::Clear(name) => ("clear", json!(name), None),
            Self::Sentences => ("sentences", json!(true), None),
        }
    }
}
