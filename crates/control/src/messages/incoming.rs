//! What a client receives: answers, and the records of its subscriptions.

use serde_json::{Map, Value};

use super::answer::Answer;

/// A line from the server.
#[derive(Clone, Debug, PartialEq)]
pub enum Incoming {
    /// The answer to a request.
    Answer(Answer),
    /// A record of a subscription, as in `run --events`.
    Record(Map<String, Value>),
    /// This number of records is missing here: the client was too slow.
    Lost(u64),
}

impl Incoming {
    /// Reads a line.
    ///
    /// # Errors
    /// It is no JSON object, or it begins as an answer and is none.
    pub fn read(line: &str) -> Result<Self, serde_json::Error> {
        let members: Map<String, Value> = serde_json::from_str(line)?;
        if members.contains_key("ok") {
            return serde_json::from_value(Value::Object(members)).map(Self::Answer);
        }
        match members.get("lost").and_then(Value::as_u64) {
            Some(lost) if members.len() == 1 => Ok(Self::Lost(lost)),
            _ => Ok(Self::Record(members)),
        }
    }

    /// The line of lost records, with its end.
    #[must_use]
    pub fn lost_line(count: u64) -> String {
        format!("{{\"lost\":{count}}}\n")
    }
}
