//! An answer: the `id` of its request, whether it was done, and what was asked for.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::refusal::Refusal;

/// An answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The `id` of the request; null if the request had none.
    pub id: Value,
    /// Whether it was done.
    pub ok: bool,
    /// When: nanoseconds since power-on of the twin. A request that is refused has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_ns: Option<u64>,
    /// Why it was refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<Refusal>,
    /// What was asked for: the members that its verb has.
    #[serde(flatten)]
    pub content: Map<String, Value>,
}

impl Answer {
    /// The request was done; its content is a JSON object.
    #[must_use]
    pub fn done(id: Value, at_ns: u64, content: &impl Serialize) -> Self {
        let content = match serde_json::to_value(content) {
            Ok(Value::Object(content)) => content,
            Ok(_) | Err(_) => Map::new(),
        };
        Self { id, ok: true, at_ns: Some(at_ns), error: None, content }
    }

    /// The request was refused, and nothing has changed.
    #[must_use]
    pub fn refused(id: Value, refusal: Refusal) -> Self {
        Self { id, ok: false, at_ns: None, error: Some(refusal), content: Map::new() }
    }

    /// The content as one of the types of this module.
    ///
    /// # Errors
    /// [`Refusal`]: the one of the server, or the content is that of another verb.
    pub fn content<T: DeserializeOwned>(self) -> Result<T, Refusal> {
        if !self.ok {
            return Err(self.error.unwrap_or_default());
        }
        serde_json::from_value(Value::Object(self.content))
            .map_err(|error| Refusal::new(format!("the answer is not the expected one: {error}"), ""))
    }

    /// The line of the answer, with its end.
    #[must_use]
    pub fn line(&self) -> String {
        // Members with text as names and values of JSON can always be written.
        let json = serde_json::to_string(self).unwrap_or_default();
        format!("{json}\n")
    }
}
