//! A request: an `id` of the client's choice, and one verb.

use serde_json::{Map, Value};
use time::Duration;

use super::LINE_BYTES_MAX;
use super::members::Members;
use super::refusal::{Refusal, shortened};
use super::verb::Verb;
use super::verbs::{self, VERBS};

const ID: &str = "id";
const WITHIN: &str = "within";

/// A request.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Any JSON value; the answer has the same one.
    pub id: Value,
    /// What is to be done.
    pub verb: Verb,
}

/// A line that is no request, with its `id` as far as it can be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Unread {
    /// The `id` of the answer; null if the line has none.
    pub id: Value,
    /// Why.
    pub refusal: Refusal,
}

impl Request {
    /// Reads a line, with or without its end.
    ///
    /// # Errors
    /// [`Unread`].
    pub fn read(line: &[u8]) -> Result<Self, Unread> {
        let members = members(line).map_err(|refusal| Unread { id: Value::Null, refusal })?;
        let id = members.iter().find(|(name, _)| name == ID).map_or(Value::Null, |(_, id)| id.clone());
        match verb(members) {
            Ok(verb) => Ok(Self { id, verb }),
            Err(refusal) => Err(Unread { id, refusal }),
        }
    }

    /// The line of the request, with its end.
    #[must_use]
    pub fn line(&self) -> String {
        let (name, value, within) = self.verb.member();
        let mut members = Map::new();
        members.insert(ID.to_owned(), self.id.clone());
        members.insert(name.to_owned(), value);
        members.extend(within.map(|within| (WITHIN.to_owned(), Value::String(within.to_string()))));
        format!("{}\n", Value::Object(members))
    }
}

/// The members of a line, none of them twice.
fn members(line: &[u8]) -> Result<Vec<(String, Value)>, Refusal> {
    if line.len() > LINE_BYTES_MAX {
        return Err(too_long());
    }
    let text = core::str::from_utf8(line).map_err(|error| {
        let message = format!("the line is not UTF-8: byte {}", error.valid_up_to() + 1);
        Refusal::new(message, "send JSON in UTF-8")
    })?;
    let Members(members) = serde_json::from_str(text).map_err(|error| no_object(&error))?;
    let mut names: Vec<&str> = members.iter().map(|(name, _)| name.as_str()).collect();
    names.sort_unstable();
    match names.windows(2).find(|pair| matches!(pair, [a, b] if a == b)) {
        Some(doubled) => {
            let name = shortened(doubled.first().copied().unwrap_or_default());
            Err(Refusal::new(format!("the request has `{name}` twice"), "send two requests"))
        }
        None => Ok(members),
    }
}

/// A line that is too long to be a request.
pub(crate) fn too_long() -> Refusal {
    Refusal::new(format!("a request has more than {LINE_BYTES_MAX} bytes"), "send several requests")
}

fn no_object(error: &serde_json::Error) -> Refusal {
    let help = format!("a request is one JSON object in one line, such as {}", example());
    // The position is in this line, whatever the number of the line is.
    let words = error.to_string();
    let reason = words.split(" at line ").next().unwrap_or_default();
    Refusal::new(format!("no request: {reason} (column {})", error.column()), help)
}

fn example() -> &'static str {
    VERBS.first().map_or("", |row| row.example)
}

fn verb(members: Vec<(String, Value)>) -> Result<Verb, Refusal> {
    let mut verb = None;
    let mut within = None;
    for (name, value) in members {
        match (name.as_str(), verbs::row(&name)) {
            (_, Some(row)) => {
                if let Some((before, _)) = verb.replace((row.name, row.with(value))) {
                    let message = format!("a request has one verb, and this one has `{before}` and `{name}`");
                    return Err(Refusal::new(message, "send two requests"));
                }
            }
            (ID, None) => {}
            (WITHIN, None) => within = Some(duration(&value)?),
            (_, None) => return Err(Refusal::unknown("key", &name, &keys())),
        }
    }
    match (verb, within) {
        (None, _) => {
            let names: Vec<_> = VERBS.iter().map(|row| row.name).collect();
            let message = format!("the request has no verb: one of {}", names.join(", "));
            Err(Refusal::new(message, format!("such as {}", example())))
        }
        (Some((_, verb)), None) => verb,
        (Some((name, verb)), Some(_)) => match verb? {
            Verb::Expect { condition, .. } => Ok(Verb::Expect { condition, within }),
            _ => Err(Refusal::new(format!("`{name}` has no `{WITHIN}`"), "only `expect` has it")),
        },
    }
}

fn keys() -> Vec<&'static str> {
    VERBS.iter().map(|row| row.name).chain([ID, WITHIN]).collect()
}

fn duration(value: &Value) -> Result<Duration, Refusal> {
    let read = value.as_str().and_then(|text| text.parse().ok());
    read.ok_or_else(|| {
        let message = format!("`{WITHIN}` takes a duration, and not {}", verbs::kind(value));
        Refusal::new(message, "a number and ns, us, ms or s, such as \"5s\" or \"100ms\"")
    })
}
