//! The verbs of requests: one table, for reading, for messages and for the documentation.

use serde_json::Value;

use super::refusal::Refusal;
use super::verb::Verb;

/// A verb: the member of a request that says what to do.
#[derive(Clone, Copy)]
pub struct VerbRow {
    /// The name of the member.
    pub name: &'static str,
    /// Its value, in words.
    pub value: &'static str,
    /// A request with it.
    pub example: &'static str,
    /// What it does.
    pub meaning: &'static str,
    /// The members of its answer, beside `id`, `ok` and `at_ns`.
    pub answer: &'static [&'static str],
    /// The verb of a value; none: it cannot have this value.
    pub(super) build: fn(Value) -> Option<Verb>,
}

/// All verbs.
pub const VERBS: &[VerbRow] = &[
    VerbRow {
        name: "do",
        value: "a sentence",
        example: r#"{"id":1,"do":"unplug cable 1"}"#,
        meaning: "carries out an order to units, CPU Units or the line",
        answer: &[],
        build: |value| text(value).map(Verb::Do),
    },
    VerbRow {
        name: "expect",
        value: "a sentence",
        example: r#"{"id":2,"expect":"unit 1 is in OP","within":"5s"}"#,
        meaning: "whether a condition is true now, or becomes true `within` a time",
        answer: &["held", "seen"],
        build: |value| text(value).map(|condition| Verb::Expect { condition, within: None }),
    },
    VerbRow {
        name: "status",
        value: "true",
        example: r#"{"id":3,"status":true}"#,
        meaning: "what each unit shows",
        answer: &["link", "units"],
        build: |value| wanted(&value).then_some(Verb::Status),
    },
    VerbRow {
        name: "read",
        value: "a list of variables",
        example: r#"{"id":4,"read":["N1_UINTs_01_M_to_C"]}"#,
        meaning: "the values of device variables, or of elements of them, all of one moment",
        answer: &["values"],
        build: |value| names(value).map(Verb::Read),
    },
    VerbRow {
        name: "write",
        value: "an object with values by variables",
        example: r#"{"id":5,"write":{"N1_UINTs_01_C_to_M[0]":5}}"#,
        meaning: "writes variables once, all in one task period; the program may write them again",
        answer: &["values"],
        build: |value| assignments(value).map(Verb::Write),
    },
    VerbRow {
        name: "force",
        value: "an object with values by variables",
        example: r#"{"id":6,"force":{"N1_UINTs_01_C_to_M[0]":5}}"#,
        meaning: "gives variables a value until they are released, whatever program and unit write",
        answer: &["values"],
        build: |value| assignments(value).map(Verb::Force),
    },
    VerbRow {
        name: "release",
        value: "a list of variables",
        example: r#"{"id":7,"release":["N1_UINTs_01_C_to_M[0]"]}"#,
        meaning: "ends the forcing of variables",
        answer: &["values"],
        build: |value| names(value).map(Verb::Release),
    },
    VerbRow {
        name: "object",
        value: "a unit and an entry",
        example: r#"{"id":8,"object":"N1 1018:04"}"#,
        meaning: "the value of an object, read from the side of the unit: no mailbox is used",
        answer: &["object", "type", "value", "bytes"],
        build: |value| text(value).map(Verb::Object),
    },
    VerbRow {
        name: "subscribe",
        value: "a list of kinds of records",
        example: r#"{"id":9,"subscribe":["state","event","variable:N1_UINTs_01_M_to_C"]}"#,
        meaning: "records of these kinds follow as they occur; `variable:NAME` is a record of each change of a variable",
        answer: &["subscribed"],
        build: |value| names(value).map(Verb::Subscribe),
    },
    VerbRow {
        name: "unsubscribe",
        value: "a list of kinds of records",
        example: r#"{"id":10,"unsubscribe":["state"]}"#,
        meaning: "ends subscriptions; `all` ends all of them",
        answer: &["subscribed"],
        build: |value| names(value).map(Verb::Unsubscribe),
    },
    VerbRow {
        name: "faults",
        value: "true",
        example: r#"{"id":11,"faults":true}"#,
        meaning: "the faults at work: those of units and those of frames",
        answer: &["faults"],
        build: |value| wanted(&value).then_some(Verb::Faults),
    },
    VerbRow {
        name: "clear",
        value: "the name of a fault, or `all`",
        example: r#"{"id":12,"clear":"all"}"#,
        meaning: "ends a fault at work: one of frames by its name, one of a unit as in `Processing of unit 1`",
        answer: &["faults"],
        build: |value| text(value).map(Verb::Clear),
    },
    VerbRow {
        name: "sentences",
        value: "true",
        example: r#"{"id":13,"sentences":true}"#,
        meaning: "all sentences of `do` and `expect`",
        answer: &["sentences"],
        build: |value| wanted(&value).then_some(Verb::Sentences),
    },
];

/// The row of a verb.
pub(super) fn row(name: &str) -> Option<&'static VerbRow> {
    VERBS.iter().find(|row| row.name == name)
}

impl VerbRow {
    /// The verb with a value.
    pub(super) fn with(&self, value: Value) -> Result<Verb, Refusal> {
        let found = kind(&value);
        let wrong = || {
            let message = format!("`{}` takes {}, and not {found}", self.name, self.value);
            Refusal::new(message, format!("such as {}", self.example))
        };
        (self.build)(value).ok_or_else(wrong)
    }
}

fn text(value: Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text),
        _ => None,
    }
}

const fn wanted(value: &Value) -> bool {
    matches!(value, Value::Bool(true))
}

fn names(value: Value) -> Option<Vec<String>> {
    let Value::Array(names) = value else { return None };
    if names.is_empty() { None } else { names.into_iter().map(text).collect() }
}

fn assignments(value: Value) -> Option<Vec<(String, Value)>> {
    match value {
        Value::Object(values) if !values.is_empty() => Some(values.into_iter().collect()),
        _ => None,
    }
}

/// The kind of a JSON value, in words.
pub(super) fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(true) => "true",
        Value::Bool(false) => "false",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(values) if values.is_empty() => "an empty list",
        Value::Array(_) => "this list",
        Value::Object(values) if values.is_empty() => "an empty object",
        Value::Object(_) => "an object",
    }
}
