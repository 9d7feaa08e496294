//! The lines of the channel: one JSON object each. Server and client share these types.

mod answer;
mod content;
mod incoming;
mod members;
mod refusal;
mod request;
#[cfg(test)]
mod tests;
mod verb;
mod verbs;

pub use answer::Answer;
pub use content::{
    AboutSentence, ActiveFault, Faults, Held, ObjectReport, SentenceRow, Sentences, Status, Subscribed,
    UnitError, UnitReport, VariableReport, Variables,
};
pub use incoming::Incoming;
pub use refusal::Refusal;
pub(crate) use request::too_long;
pub use request::{Request, Unread};
pub use verb::Verb;
pub use verbs::{VERBS, VerbRow};

/// Maximum length of a request in bytes, without its end of line.
pub const LINE_BYTES_MAX: usize = 1 << 16;
